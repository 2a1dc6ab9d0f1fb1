//! A solved law: the shape s(x) of a segment with all its derivatives.
//!
//! Between joints a curve is one analytic function. It may be written in two ways, from either side, that meet without a jump
//! ([`Part`]): near an end only the distance from that end keeps its digits.

use super::bernstein::Bernstein;
use super::local::Local;
use std::ops::Range;

/// s, s', s'', s''' at x.
pub type Values = [f64; 4];

/// One analytic function between two joints.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Part {
    /// A polynomial.
    Polynomial(Bernstein),
    /// Waves and a polynomial of low degree, written from the start up to `split` and from the end behind it.
    Waves {
        /// Where the one form takes over from the other.
        split: f64,
        /// s by x.
        early: Local,
        /// 1 − s by 1 − x.
        late: Local,
    },
}

impl Part {
    /// A part that needs only the form from the start.
    pub(super) fn early(local: Local) -> Self {
        Part::Waves { split: f64::INFINITY, early: local, late: Local::default() }
    }

    /// A part that needs only the form from the end.
    pub(super) fn late(local: Local) -> Self {
        Part::Waves { split: f64::NEG_INFINITY, early: Local::default(), late: local }
    }

    #[inline]
    fn at(&self, x: f64) -> Values {
        match self {
            Part::Polynomial(polynomial) => polynomial.at(x),
            Part::Waves { split, early, .. } if x <= *split => early.at(x),
            Part::Waves { late, .. } => {
                let [value, first, second, third] = late.at(1.0 - x);
                [1.0 - value, first, -second, third]
            }
        }
    }

    fn derivative(&self, x: f64, order: u32) -> f64 {
        match self {
            Part::Polynomial(polynomial) => polynomial.derivative(x, order),
            Part::Waves { split, early, .. } if x <= *split => early.derivative(x, order),
            Part::Waves { late, .. } => {
                let from_end = late.derivative(1.0 - x, order);
                match order {
                    0 => 1.0 - from_end,
                    _ if order.is_multiple_of(2) => -from_end,
                    _ => from_end,
                }
            }
        }
    }
}

/// A solved law: s(x) over x in [0, 1], in units of the travel and the width of its segment.
///
/// s runs from 0 to 1, but for a polynomial of given ends ([`super::polynomial::hermite`]). Between its joints every derivative
/// is exact.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    joints: Vec<f64>,
    parts: Vec<Part>,
    inflection: Option<f64>,
    humps: bool,
}

impl Curve {
    /// A curve without joints.
    pub(super) fn smooth(part: Part) -> Self {
        Self { joints: Vec::new(), parts: vec![part], inflection: None, humps: false }
    }

    /// The straight line s = x.
    #[must_use]
    pub fn line() -> Self {
        let line = Local::polynomial(0.0, [0.0, 1.0, 0.0, 0.0]);
        Self::smooth(Part::Waves { split: 0.5, early: line.clone(), late: line })
    }

    /// A curve of parts that meet at joints, one joint fewer than parts; with the place of its inflection, and whether its
    /// acceleration has two humps.
    pub(super) fn of_parts(joints: Vec<f64>, parts: Vec<Part>, inflection: f64, humps: bool) -> Self {
        Self { joints, parts, inflection: Some(inflection), humps }
    }

    /// The inner places, 0 < x < 1 and growing, where some derivative jumps. A curve has one part more than joints.
    #[must_use]
    pub fn joints(&self) -> &[f64] {
        &self.joints
    }

    /// Where the acceleration was made to change its sign, of a law that has such a place to choose.
    #[must_use]
    pub fn inflection(&self) -> Option<f64> {
        self.inflection
    }

    /// Whether the acceleration keeps one sign on both sides of the inflection, in two humps: legal, but seldom wanted. Another
    /// inflection or a polynomial avoids it.
    #[must_use]
    pub fn humps(&self) -> bool {
        self.humps
    }

    /// s, s', s'', s''' of a part at x within it, its ends included; of no part 0.
    #[must_use]
    #[inline]
    pub fn at(&self, part: usize, x: f64) -> Values {
        self.parts.get(part).map_or([0.0; 4], |part| part.at(x))
    }

    /// The derivative of any order of a part at x within it, its ends included; of order 0 s itself, of no part 0.
    #[must_use]
    pub fn derivative(&self, part: usize, x: f64, order: u32) -> f64 {
        self.parts.get(part).map_or(0.0, |part| part.derivative(x, order))
    }

    /// How a part is written.
    pub(super) fn part(&self, part: usize) -> Option<&Part> {
        self.parts.get(part)
    }

    /// The part that holds x; at a joint the later one.
    #[must_use]
    pub fn part_of(&self, x: f64) -> usize {
        self.joints.iter().filter(|joint| **joint <= x).count()
    }

    /// First and last x of a part.
    #[must_use]
    pub fn range_of(&self, part: usize) -> (f64, f64) {
        let joint = |index: Option<usize>| index.and_then(|index| self.joints.get(index)).copied();
        (joint(part.checked_sub(1)).unwrap_or(0.0), joint(Some(part)).unwrap_or(1.0))
    }

    /// How many parts there are, at least one.
    #[must_use]
    pub fn parts(&self) -> usize {
        self.parts.len()
    }

    /// The parts in groups in which every derivative up to an order is continuous.
    #[must_use]
    pub fn smooth_to(&self, order: u32) -> Vec<Range<usize>> {
        let mut breaks: Vec<usize> = vec![0];
        breaks.extend((1..self.parts()).filter(|part| (0..=order).any(|order| self.jumps(*part, order))));
        let ends = breaks.iter().copied().skip(1).chain(std::iter::once(self.parts()));
        breaks.iter().copied().zip(ends).map(|(first, end)| first..end).collect()
    }

    /// Whether a derivative jumps between a part and the one before it.
    pub(super) fn jumps(&self, part: usize, order: u32) -> bool {
        let Some(joint) = part.checked_sub(1).and_then(|before| self.joints.get(before)) else { return false };
        let (left, right) = (self.derivative(part - 1, *joint, order), self.derivative(part, *joint, order));
        let sizes = (0..self.parts()).flat_map(|part| {
            let (low, high) = self.range_of(part);
            [low, 0.5 * (low + high), high].map(|x| self.derivative(part, x, order).abs())
        });
        (left - right).abs() > ROUNDING * sizes.fold(0.0, f64::max)
    }
}

/// A jump smaller than this share of a derivative's size is rounding: that is 1e-14, and what jumps by so little does not
/// matter to a cam.
const ROUNDING: f64 = 1e-9;

//! A solved law: the shape s(x) of a segment with all its derivatives.
//!
//! Between joints a curve is one analytic function. It may be written in two ways, from either side, that meet without a jump
//! ([`CurvePart`]): near an end only the distance from that end keeps its digits.

use super::bernstein::{Bernstein, Values};
use super::expression_shapes::{FormulaShape, HarmonicSeries};
use super::local::LocalPiece;
use super::rest_to_rest::RestToRest;
use std::ops::Range;
use std::sync::Arc;

/// One analytic function between two joints.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum CurvePart {
    /// A polynomial.
    Polynomial(Bernstein),
    /// Waves and a polynomial of low degree, written from the start up to `split` and from the end after it.
    Waves {
        /// Where the one form takes over from the other.
        split: f64,
        /// s by x.
        early: LocalPiece,
        /// 1 − s by 1 − x.
        late: LocalPiece,
    },
    /// A polynomial over a stretch of the segment, by the share of the stretch.
    Stretch {
        /// Where the stretch begins, and its width.
        range: (f64, f64),
        polynomial: Bernstein,
    },
    /// Harmonics of the segment.
    Harmonics(Arc<HarmonicSeries>),
    /// A formula.
    Formula(Arc<FormulaShape>),
    /// The motion of a cam whose elastic load moves as another part.
    Polydyne(Arc<PolydyneShape>),
    /// A polynomial from rest to rest by its jerk.
    RestToRest(Arc<RestToRest>),
}

/// s + first s' + second s'': the motion of a cam under which an elastic load moves as s, a polydyne cam (D. A. Stoddart, "Polydyne cam
/// design", Machine Design, 1953).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PolydyneShape {
    pub(super) load: CurvePart,
    pub(super) first: f64,
    pub(super) second: f64,
}

impl PolydyneShape {
    /// Value and three derivatives.
    pub(super) fn values_at(&self, x: f64) -> Values {
        let [s, v, a, j] = self.load.values_at(x);
        let (fourth, fifth) = (self.load.derivative(x, 4), self.load.derivative(x, 5));
        [[s, v, a], [v, a, j], [a, j, fourth], [j, fourth, fifth]]
            .map(|[own, next, after]| own + self.first * next + self.second * after)
    }

    /// The derivative of an order.
    pub(super) fn derivative(&self, x: f64, order: u32) -> f64 {
        let [own, next, after] = [order, order + 1, order + 2].map(|order| self.load.derivative(x, order));
        own + self.first * next + self.second * after
    }
}

impl CurvePart {
    /// A part that needs only the form from the start.
    pub(super) fn early(local: LocalPiece) -> Self {
        CurvePart::Waves { split: f64::INFINITY, early: local, late: LocalPiece::default() }
    }

    /// A part that needs only the form from the end.
    pub(super) fn late(local: LocalPiece) -> Self {
        CurvePart::Waves { split: f64::NEG_INFINITY, early: LocalPiece::default(), late: local }
    }

    #[inline]
    pub(super) fn values_at(&self, x: f64) -> Values {
        match self {
            CurvePart::Polynomial(polynomial) => polynomial.values_at(x),
            CurvePart::Waves { split, early, .. } if x <= *split => early.values_at(x),
            CurvePart::Waves { late, .. } => {
                let [value, first, second, third] = late.values_at(1.0 - x);
                [1.0 - value, first, -second, third]
            }
            CurvePart::Stretch { range: (from, width), polynomial } => {
                let [value, first, second, third] = polynomial.values_at((x - from) / width);
                [value, first / width, second / width / width, third / width / width / width]
            }
            CurvePart::Harmonics(harmonics) => [0, 1, 2, 3].map(|order| harmonics.derivative(x, order)),
            CurvePart::Formula(formula) => formula.values_at(x),
            CurvePart::Polydyne(loaded) => loaded.values_at(x),
            CurvePart::RestToRest(polynomial) => polynomial.values_at(x),
        }
    }

    /// Cells in which its extremes are separated: the derivatives of five waves over a segment have twenty, those of a cubic
    /// acceleration two.
    pub(super) fn cells(&self) -> u32 {
        match self {
            CurvePart::Polynomial(_) | CurvePart::Waves { .. } | CurvePart::RestToRest(_) => 64,
            CurvePart::Stretch { .. } => 4,
            CurvePart::Harmonics(_) | CurvePart::Formula(_) => 32,
            CurvePart::Polydyne(loaded) => loaded.load.cells(),
        }
    }

    pub(super) fn derivative(&self, x: f64, order: u32) -> f64 {
        match self {
            CurvePart::Polynomial(polynomial) => polynomial.derivative(x, order),
            CurvePart::Waves { split, early, .. } if x <= *split => early.derivative(x, order),
            CurvePart::Waves { late, .. } => {
                let from_end = late.derivative(1.0 - x, order);
                match order {
                    0 => 1.0 - from_end,
                    _ if order.is_multiple_of(2) => -from_end,
                    _ => from_end,
                }
            }
            CurvePart::Stretch { range: (from, width), polynomial } => {
                (0..order).fold(polynomial.derivative((x - from) / width, order), |product, _| product / width)
            }
            CurvePart::Harmonics(harmonics) => harmonics.derivative(x, order),
            CurvePart::Formula(formula) => formula.derivative(x, order),
            CurvePart::Polydyne(loaded) => loaded.derivative(x, order),
            CurvePart::RestToRest(polynomial) => polynomial.derivative(x, order),
        }
    }
}

/// A solved law: s(x) over x in [0, 1], in units of the travel and the width of its segment.
///
/// s runs from 0 to 1, but for a polynomial of given ends ([`super::polynomial::hermite`]). Between its joints every derivative
/// is exact.
#[derive(Debug, Clone, PartialEq)]
pub struct LawCurve {
    joints: Vec<f64>,
    parts: Vec<CurvePart>,
    inflection: Option<f64>,
    humps: bool,
    /// Largest number of parts that are treated as one.
    together: usize,
}

impl LawCurve {
    /// A curve without joints.
    pub(super) fn smooth(part: CurvePart) -> Self {
        Self::of_many(Vec::new(), vec![part], usize::MAX)
    }

    /// A curve of parts that meet at joints, of which at most so many are treated as one: a curve with many extremes is searched
    /// stretch by stretch.
    pub(super) fn of_many(joints: Vec<f64>, parts: Vec<CurvePart>, together: usize) -> Self {
        Self { joints, parts, inflection: None, humps: false, together: together.max(1) }
    }

    /// A part that holds for the whole segment, cut into equal stretches.
    pub(super) fn cut(part: &CurvePart, stretches: u32) -> Self {
        let count = stretches.max(1);
        let joints = (1..count).map(|joint| f64::from(joint) / f64::from(count)).collect();
        Self::of_many(joints, (0..count).map(|_| part.clone()).collect(), 1)
    }

    /// The straight line s = x.
    #[must_use]
    pub fn line() -> Self {
        let line = LocalPiece::polynomial(0.0, [0.0, 1.0, 0.0, 0.0]);
        Self::smooth(CurvePart::Waves { split: 0.5, early: line.clone(), late: line })
    }

    /// A curve of parts that meet at joints, one joint fewer than parts; with the place of its inflection, and whether its
    /// acceleration has two humps.
    pub(super) fn of_parts(joints: Vec<f64>, parts: Vec<CurvePart>, inflection: f64, humps: bool) -> Self {
        Self { inflection: Some(inflection), humps, ..Self::of_many(joints, parts, usize::MAX) }
    }

    /// The curve with other parts.
    pub(super) fn with_parts(&self, part: impl Fn(&CurvePart) -> CurvePart) -> Self {
        Self { parts: self.parts.iter().map(part).collect(), ..self.clone() }
    }

    /// The inner places, 0 < x < 1 and growing, where some derivative jumps, or where a curve of many waves is cut. A curve has one
    /// part more than joints.
    #[must_use]
    pub fn joints(&self) -> &[f64] {
        &self.joints
    }

    /// Where the acceleration changes its sign, for a law whose inflection can be chosen.
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
    pub fn values_at(&self, part: usize, x: f64) -> Values {
        self.parts.get(part).map_or([0.0; 4], |part| part.values_at(x))
    }

    /// The derivative of any order of a part at x within it, its ends included; of order 0 s itself, of no part 0.
    #[must_use]
    pub fn derivative(&self, part: usize, x: f64, order: u32) -> f64 {
        self.parts.get(part).map_or(0.0, |part| part.derivative(x, order))
    }

    /// How a part is written.
    pub(super) fn part(&self, part: usize) -> Option<&CurvePart> {
        self.parts.get(part)
    }

    /// The part that holds x; at a joint the later one.
    #[must_use]
    pub fn part_of(&self, x: f64) -> usize {
        self.joints.partition_point(|joint| *joint <= x)
    }

    /// The part in `parts` (not empty) that holds x or is nearest to it; at a joint the later one.
    #[must_use]
    pub fn part_within(&self, x: f64, parts: &Range<usize>) -> usize {
        let joints = self.joints.get(parts.start..parts.end.saturating_sub(1)).unwrap_or_default();
        parts.start + joints.partition_point(|joint| *joint <= x)
    }

    /// First and last x of a part.
    #[must_use]
    pub fn range_of(&self, part: usize) -> (f64, f64) {
        let [low, high] = [part.checked_sub(1), Some(part)].map(|joint| joint.and_then(|joint| self.joints.get(joint)));
        (low.copied().unwrap_or(0.0), high.copied().unwrap_or(1.0))
    }

    /// How many parts there are, at least one.
    #[must_use]
    pub fn parts(&self) -> usize {
        self.parts.len()
    }

    /// The parts in groups in which every derivative up to an order is continuous.
    #[must_use]
    pub fn smooth_to(&self, order: u32) -> Vec<Range<usize>> {
        let sizes: Vec<(u32, f64)> = (0..=order).map(|order| (order, self.size(order))).collect();
        let own = sizes.first().map_or(0.0, |size| size.1);
        let mut breaks: Vec<usize> = vec![0];
        for part in 1..self.parts() {
            let full = breaks.last().is_some_and(|first| part - first >= self.together);
            if full
                || sizes.iter().any(|(order, size)| {
                    self.jumps_by(part, *order) > ROUNDING * size + self.rounding_at(part, *order, own)
                })
            {
                breaks.push(part);
            }
        }
        let ends = breaks.iter().copied().skip(1).chain(std::iter::once(self.parts()));
        breaks.iter().copied().zip(ends).map(|(first, end)| first..end).collect()
    }

    /// The first part at whose beginning a derivative jumps.
    pub(super) fn first_jump(&self, order: u32) -> Option<usize> {
        let size = self.size(order);
        (1..self.parts()).find(|part| self.jumps_by(*part, order) > ROUNDING * size)
    }

    /// Cells in which the extremes of a part are separated.
    pub(crate) fn cells(&self, part: usize) -> u32 {
        self.parts.get(part).map_or(1, CurvePart::cells)
    }

    /// The size of the jump of a derivative between a part and the one before it.
    pub(super) fn jumps_by(&self, part: usize, order: u32) -> f64 {
        let Some(joint) = part.checked_sub(1).and_then(|before| self.joints.get(before)) else { return 0.0 };
        (self.derivative(part - 1, *joint, order) - self.derivative(part, *joint, order)).abs()
    }

    /// What rounding of a value of this size leaves of a derivative between a part and the one before it: a spline of many knots is as smooth
    /// as one of few.
    fn rounding_at(&self, part: usize, order: u32, size: f64) -> f64 {
        let [before, after] = [part.saturating_sub(1), part].map(|part| {
            let (low, high) = self.range_of(part);
            high - low
        });
        let width = after.min(before);
        (0..order).fold(OF_VALUES * size, |rounding, _| rounding / width)
    }

    /// The size of a derivative, at the ends and the middles of the parts.
    fn size(&self, order: u32) -> f64 {
        let sizes = (0..self.parts()).flat_map(|part| {
            let (low, high) = self.range_of(part);
            [low, 0.5 * (low + high), high].map(|x| self.derivative(part, x, order).abs())
        });
        sizes.fold(0.0, f64::max)
    }
}

/// Rounding of the values of a spline, as a share of them, with what its equations add.
const OF_VALUES: f64 = 256.0 * f64::EPSILON;

/// A jump smaller than this share of a derivative's size is rounding: that is 1e-14, and what jumps by so little does not
/// matter to a cam.
const ROUNDING: f64 = 1e-9;

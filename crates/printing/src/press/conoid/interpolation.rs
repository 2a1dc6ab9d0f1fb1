//! How the law is interpolated along the axis: cubic splines through the sections, in the axial position, or in a
//! function of the speed that belongs to it.
//!
//! Splines in the position z swing between sections whose speeds lie far apart: the law changes with the ratio of two speeds
//! rather than with their difference. In t = asinh(v/c), v being the speed n, or n² where the shift is linear in that, the
//! speeds that grow by a factor lie evenly, and at v ≪ c, and beyond the ends of the cam, t is smooth in z all the same. A
//! crowned roller needs that: straight strips from section to section would have a ridge at each section.

use super::{Conoid, SurfaceExtremes};
use crate::press::machine::Shift;
use camgen_kernel::motion::Jet;
use camgen_kernel::numeric::spline::{Spline, cubic_at, interval_of};
use camgen_kernel::refusal::Refusal;

/// The values c that are tried, as shares of the largest v.
const SHARES: [f64; 6] = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125];
/// Share of a force that is rounding, and of the largest one: a force that small is nothing.
const ROUNDING: f64 = 1e-9;
/// Share of the largest weight of a section in a slope below which a weight is rounding: they fall by 3.7 from one section to the next.
const NEGLIGIBLE: f64 = 1e-18;

/// The variable in which the splines are cubic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Variable {
    /// The place along the axis.
    Place,
    /// asinh(a + b z), z in m: a, b.
    Speed(f64, f64),
}

impl Variable {
    /// The variable at an axial position, m, and its first three derivatives by it.
    fn jet(self, z: f64) -> [f64; 4] {
        match self {
            Self::Place => [z, 1.0, 0.0, 0.0],
            Self::Speed(a, b) => {
                let y = a + b * z;
                let square = 1.0 + y * y;
                let root = square.sqrt();
                [
                    libm::asinh(y),
                    b / root,
                    -b * b * y / (square * root),
                    b * b * b * (2.0 * y * y - 1.0) / (square * square * root),
                ]
            }
        }
    }
}

/// The share of each section in the law at an axial position.
#[derive(Debug, Clone)]
pub(super) struct Weights {
    /// The variable at the sections.
    knots: Vec<f64>,
    /// For each interval the cubics of all sections, so that a position is looked up once for all of them.
    cubics: Vec<Vec<[f64; 4]>>,
    /// For each section the shares of all in the slope there, from the first on that has one.
    slope_shares: Vec<(usize, Vec<f64>)>,
    variable: Variable,
}

impl Weights {
    /// The weights for sections at these axial positions, m.
    pub(super) fn new(positions: &[f64], variable: Variable) -> Self {
        let knots: Vec<f64> = positions.iter().map(|z| variable.jet(*z)[0]).collect();
        let mut cubics = vec![Vec::with_capacity(knots.len()); knots.len().saturating_sub(1)];
        for index in 0..knots.len() {
            let values: Vec<f64> = (0..knots.len()).map(|other| f64::from(u8::from(other == index))).collect();
            let spline = Spline::not_a_knot(&knots, &values);
            cubics.iter_mut().zip(spline.cubics()).for_each(|(interval, cubic)| interval.push(*cubic));
        }
        let slope_shares = (0..knots.len()).map(|knot| shares_at(&knots, &cubics, knot)).collect();
        Self { knots, cubics, slope_shares, variable }
    }

    /// Where an axial position, m, lies: the interval, and how far behind its first section the variable is, with its first three
    /// derivatives by the position.
    pub(super) fn place(&self, z: f64) -> (usize, [f64; 4]) {
        let [t, t1, t2, t3] = self.variable.jet(z);
        let interval = interval_of(&self.knots, t);
        let knot = self.knots.get(interval).copied().unwrap_or(f64::NAN);
        (interval, [t - knot, t1, t2, t3])
    }

    /// The width of an interval in the variable.
    pub(super) fn width_of(&self, interval: usize) -> f64 {
        let [from, to] = [interval, interval + 1].map(|knot| self.knots.get(knot).copied().unwrap_or(f64::NAN));
        to - from
    }

    /// The larger width of the intervals next to a section.
    pub(super) fn width_at(&self, section: usize) -> f64 {
        self.width_of(section).max(section.checked_sub(1).map_or(0.0, |before| self.width_of(before)))
    }

    /// The slopes by the variable at every section of what has these values there.
    pub(super) fn slopes(&self, values: &[Jet]) -> Vec<Jet> {
        let mut slopes = Vec::with_capacity(self.slope_shares.len());
        for (first, shares) in &self.slope_shares {
            let terms = values.iter().skip(*first).zip(shares);
            slopes.push(terms.fold(Jet::default(), |sum, (value, share)| sum.plus(value.scaled(*share))));
        }
        slopes
    }

    /// The weights at an axial position, m, and their first three derivatives by it, section by section.
    pub(super) fn jets_at(&self, z: f64) -> impl Iterator<Item = [f64; 4]> + '_ {
        let (interval, [behind, t1, t2, t3]) = self.place(z);
        self.cubics.get(interval).into_iter().flatten().map(move |cubic| {
            let [w, w1, w2, w3] = cubic_at(cubic, behind);
            // Faà di Bruno's rule.
            [w, w1 * t1, w2 * t1 * t1 + w1 * t2, w3 * t1 * t1 * t1 + 3.0 * w2 * t1 * t2 + w1 * t3]
        })
    }

    /// Whether the splines are cubic in the axial position itself.
    pub(super) fn are_in_place(&self) -> bool {
        self.variable == Variable::Place
    }
}

/// The shares of all sections in the slope at one, by the cubics of the intervals; those that are rounding are left out at either end.
fn shares_at(knots: &[f64], cubics: &[Vec<[f64; 4]>], section: usize) -> (usize, Vec<f64>) {
    let interval = section.min(cubics.len().saturating_sub(1));
    let [knot, first] = [section, interval].map(|index| knots.get(index).copied().unwrap_or(f64::NAN));
    let behind = knot - first;
    let all: Vec<f64> = cubics.get(interval).into_iter().flatten().map(|cubic| cubic_at(cubic, behind)[1]).collect();
    let least = NEGLIGIBLE * all.iter().fold(0.0_f64, |most, share| most.max(share.abs()));
    let first = all.iter().position(|share| share.abs() > least).unwrap_or(0);
    let last = all.iter().rposition(|share| share.abs() > least).map_or(0, |last| last + 1);
    (first, all.get(first..last).unwrap_or_default().to_vec())
}

impl Conoid {
    /// Sized, with the splines along the axis that leave the least between the sections of those that some radius lets keep
    /// the limits, where the splines in the axial position leave more than straight strips.
    pub(super) fn interpolated(self) -> Result<Self, Refusal> {
        if self.speeds.len() < 3 || !self.is_worse_than_strips() {
            return self.sized();
        }
        let mut all = Vec::with_capacity(SHARES.len());
        for weights in SHARES.iter().filter_map(|share| self.by_speed(*share)) {
            let mut conoid = Self { weights, ..self.clone() };
            // What was found with other splines is found anew.
            conoid.found = SurfaceExtremes { strips: conoid.found.strips, ..SurfaceExtremes::default() };
            all.push(conoid);
        }
        all.retain(|conoid| conoid.residual_between().force < self.residual_between().force);
        all.sort_by(|a, b| a.residual_between().force.total_cmp(&b.residual_between().force));
        let sized = all.into_iter().filter_map(|conoid| conoid.sized().ok());
        let kept = sized.into_iter().find(|conoid| conoid.smallest_prime_radius.is_some());
        kept.map_or_else(|| self.sized(), Ok)
    }

    /// Splines in asinh(v/c) with c a share of the largest v.
    fn by_speed(&self, share: f64) -> Option<Weights> {
        let ends = [*self.speeds.first()?, *self.speeds.last()?];
        let [first, last] = match self.data.shift {
            Shift::Linear => ends,
            Shift::Square | Shift::Variable => ends.map(|rpm| rpm * rpm),
        };
        let scale = share * last;
        let variable = Variable::Speed(first / scale, (last - first) / (self.data.axial_travel * scale));
        (last > first).then(|| Weights::new(&self.positions, variable))
    }

    /// Whether straight strips from section to section would leave less between the sections.
    #[must_use]
    pub fn is_worse_than_strips(&self) -> bool {
        let inertia = self.press.largest_inertia(self.speeds.last().copied().unwrap_or(0.0));
        self.residual_between().force > self.residual_of_strips().force * (1.0 + ROUNDING) + ROUNDING * inertia
    }

    /// Whether the law is interpolated by the speed instead of the axial position.
    #[must_use]
    pub fn interpolates_speed(&self) -> bool {
        !self.weights.are_in_place()
    }
}

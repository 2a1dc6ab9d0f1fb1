//! The law of the bottom by the crank angle, for a bed that is moved by a yoke or by any other linkage.
//!
//! The air force equals the inertia force m ω² a at every crank angle φ of a reversal when the bottom is at
//!
//! ```text
//! Δx = L h(A a) − (x + e),   h(u) = 1 − (1 + u)^(−1/k)                                                        (10g)
//! ```
//!
//! with a = −x'' of the bed and its overrun x, both m. For a yoke a = x = r sin φ and this is equation (10), which is kept in its
//! own form ([`BottomLaw`]). The sum x + Δx = L h(A a) depends on a alone: all forces hold for any linkage with a instead of
//! x. With κ = a'/x' at the start of the reversal and c = L A κ/k the law starts with the slope (c − 1) x', and
//!
//! ```text
//! Δx = (c − 1) x + c (a/κ − x) + c (a/κ)(g(A a) − 1),   g(u) = h(u)/(u/k)
//! ```
//!
//! keeps its digits where its two terms cancel.

use super::PlainBuffer;
use super::bottom_law::{BottomLaw, ColumnRule, SERIES_LIMIT, column_for, g_minus_one};
use crate::press::bed_motion::{Overrun, StrokeEnd};
use camgen_kernel::numeric::extremum::{self, Extremum};
use camgen_kernel::numeric::root;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Cells of a reversal in which an extremum is searched.
const CELLS: u32 = 96;

/// The law at one speed with one column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CrankLaw {
    /// The law for a bed that is moved by a yoke, x = r sin φ.
    Yoke(BottomLaw),
    /// The law for a bed that is moved by any other linkage, at one end of its stroke.
    Linkage(LinkageLaw),
}

/// The law for an end of the stroke of a linkage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkageLaw {
    /// Motion of the bed.
    pub end: StrokeEnd,
    /// A, 1/m.
    pub loading: f64,
    /// Polytropic exponent k.
    pub exponent: f64,
    /// Column L, m.
    pub column: f64,
    /// Lead e, m.
    pub lead: f64,
    /// c − 1.
    pub start_slope: f64,
}

impl LinkageLaw {
    /// The law for loading A > 0 (1/m), exponent k ≥ 1 and lead e ≥ 0 (m). The column `Matched` starts the law with slope 0, L = k/(A κ);
    /// `Return` has the bottom back at the dead point.
    #[must_use]
    pub fn new(loading: f64, exponent: f64, end: StrokeEnd, column: ColumnRule, lead: f64) -> Self {
        let matched = exponent / (loading * end.start_ratio());
        let (column, start_slope) = match column {
            ColumnRule::Matched => (matched, 0.0),
            ColumnRule::Return => {
                let length = fixed_column(loading, exponent, &end);
                (length, (length - matched) / matched)
            }
            ColumnRule::Length(length) => (length, (length - matched) / matched),
        };
        Self { end, loading, exponent, column, lead, start_slope }
    }

    /// Δx and its first four derivatives by the crank angle in [0, φ_b], m.
    #[must_use]
    pub fn at(&self, angle: f64) -> [f64; 5] {
        self.of_bed(&self.end.at(angle))
    }

    /// Those where the bed is in this state.
    fn of_bed(&self, bed: &Overrun) -> [f64; 5] {
        let ([x, x1, x2, x3, x4, ..], [a, a1, a2, a3, a4]) = (bed.x, bed.deceleration());
        let (p, loading, c) = (1.0 / self.exponent, self.loading, 1.0 + self.start_slope);
        let (u, share) = (loading * a, c / self.end.start_ratio());
        let log = libm::log1p(u);
        let fall = libm::expm1(-(p + 1.0) * log);
        let [excess, excess1] = bed.excess;
        let value = if u < SERIES_LIMIT {
            self.start_slope * x + c * excess + share * a * g_minus_one(u.max(0.0), p)
        } else {
            -self.column * libm::expm1(-p * log) - x
        };
        // G' = dL h/da over c/κ and its derivatives by a.
        let first = 1.0 + fall;
        let second = -loading * (p + 1.0) * first / (1.0 + u);
        let third = -second * loading * (p + 2.0) / (1.0 + u);
        let fourth = -third * loading * (p + 3.0) / (1.0 + u);
        let square = a1 * a1;
        [
            value - self.lead,
            self.start_slope * x1 + c * excess1 + share * a1 * fall,
            share * (first * a2 + second * square) - x2,
            share * (first * a3 + 3.0 * second * a1 * a2 + third * square * a1) - x3,
            share
                * (first * a4
                    + second * (4.0 * a1 * a3 + 3.0 * a2 * a2)
                    + 6.0 * third * square * a2
                    + fourth * square * square)
                - x4,
        ]
    }

    /// Overrun with its first two derivatives by the crank angle, deceleration with its first, and Δx with its first two, m.
    #[must_use]
    pub fn travels(&self, angle: f64) -> ([f64; 3], [f64; 2], [f64; 3]) {
        let bed = self.end.at(angle);
        let ([x, x1, x2, ..], [a, a1, ..], [value, first, second, ..]) = (bed.x, bed.deceleration(), self.of_bed(&bed));
        ([x, x1, x2], [a, a1], [value, first, second])
    }

    /// The bottom that retreats before the piston outside the reversal, Δx = −(e + x), and its first three derivatives.
    #[must_use]
    pub fn retreat(&self, angle: f64) -> [f64; 4] {
        let [x, x1, x2, x3, ..] = self.end.at(angle).x;
        [-(self.lead + x), -x1, -x2, -x3]
    }
}

/// Column of a plain buffer whose air balances the bed at the dead point, equation (7) with a instead of r, m.
pub(super) fn fixed_column(loading: f64, exponent: f64, end: &StrokeEnd) -> f64 {
    let [a, ..] = end.at(end.dead()).deceleration();
    column_for(end.stroke(), loading * a, exponent)
}

/// Cells in which the column of least torque is searched, and its bounds in matched columns.
const COLUMNS: (u32, [f64; 2]) = (24, [0.25, 8.0]);

/// The column with the least largest torque of the air on the camshaft, m, between a quarter and eight times the matched one.
///
/// The torque u Δx' is linear in L, so that its largest size is a convex function of L: one golden search finds it.
#[must_use]
pub fn least_torque_column(loading: f64, exponent: f64, end: &StrokeEnd) -> f64 {
    let matched = LinkageLaw::new(loading, exponent, *end, ColumnRule::Matched, 0.0).column;
    let largest =
        |column: f64| LinkageLaw::new(loading, exponent, *end, ColumnRule::Length(column), 0.0).largest_torque();
    let (cells, bounds) = COLUMNS;
    let range = bounds.map(|times| times * matched);
    extremum::largest_without_slope(|column| -largest(column), range.into(), cells, extremum::TO_ROUNDING).at
}

impl From<BottomLaw> for CrankLaw {
    fn from(law: BottomLaw) -> Self {
        Self::Yoke(law)
    }
}

impl CrankLaw {
    /// The law of a yoke.
    #[must_use]
    pub fn of_yoke(&self) -> Option<&BottomLaw> {
        match self {
            Self::Yoke(law) => Some(law),
            Self::Linkage(_) => None,
        }
    }

    /// A, 1/m.
    #[must_use]
    pub fn loading(&self) -> f64 {
        match self {
            Self::Yoke(law) => law.loading,
            Self::Linkage(law) => law.loading,
        }
    }

    /// Polytropic exponent k.
    #[must_use]
    pub fn exponent(&self) -> f64 {
        match self {
            Self::Yoke(law) => law.exponent,
            Self::Linkage(law) => law.exponent,
        }
    }

    /// Column L, m.
    #[must_use]
    pub fn column(&self) -> f64 {
        match self {
            Self::Yoke(law) => law.column,
            Self::Linkage(law) => law.column,
        }
    }

    /// Lead e, m.
    #[must_use]
    pub fn lead(&self) -> f64 {
        match self {
            Self::Yoke(law) => law.lead,
            Self::Linkage(law) => law.lead,
        }
    }

    /// c − 1: the slope dΔx/dx at the start.
    #[must_use]
    pub fn start_slope(&self) -> f64 {
        match self {
            Self::Yoke(law) => law.start_slope,
            Self::Linkage(law) => law.start_slope,
        }
    }

    /// Whether the bottom retreats before the piston in front of the reversal: over the lead, unless the port shuts in it.
    #[must_use]
    pub fn retreats(&self) -> bool {
        match self {
            Self::Yoke(law) => law.retreat() > 0.0,
            Self::Linkage(law) => law.lead > 0.0,
        }
    }

    /// The largest residual force that a law leaves by itself on either way, over 2 p0 F, at its overrun, m: half of a loop of the air where it
    /// levels both ways; `None` where it leaves nothing on the way in.
    #[must_use]
    pub fn half_loop(&self) -> Option<Extremum> {
        let law = self.of_yoke()?;
        let air = law.level.as_ref()?;
        Some(extremum::largest_without_slope(
            |x| {
                let [on_way_in, back] = air.pressures(air.length(law.loading * x));
                0.5 * (on_way_in - back)
            },
            (0.0, law.stroke),
            CELLS,
            extremum::TO_ROUNDING,
        ))
    }

    /// Crank angle that the reversal takes, rad.
    #[must_use]
    pub fn angle(&self) -> f64 {
        match self {
            Self::Yoke(_) => PI,
            Self::Linkage(law) => law.end.angle(),
        }
    }

    /// The widest blend, rad: it reaches to the dead point from that side on which it is nearer.
    #[must_use]
    pub fn widest_blend(&self) -> f64 {
        match self {
            Self::Yoke(_) => PI,
            Self::Linkage(law) => 2.0 * law.end.dead().min(law.end.angle() - law.end.dead()),
        }
    }

    /// Overrun at the dead point, m.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        match self {
            Self::Yoke(law) => law.stroke,
            Self::Linkage(law) => law.end.stroke(),
        }
    }

    /// Largest deceleration of the bed over the square of the crank speed, m.
    #[must_use]
    pub fn largest_deceleration(&self) -> f64 {
        match self {
            Self::Yoke(law) => law.stroke,
            Self::Linkage(law) => law.end.largest_deceleration().value,
        }
    }

    /// Speed of the bed by the crank angle at the start of the reversal, m/rad.
    #[must_use]
    pub fn start_speed(&self) -> f64 {
        match self {
            Self::Yoke(law) => law.stroke,
            Self::Linkage(law) => law.end.at(0.0).x[1],
        }
    }

    /// Overrun x and deceleration a at a crank angle of the reversal, m.
    #[must_use]
    pub fn bed(&self, angle: f64) -> [f64; 2] {
        match self {
            Self::Yoke(law) => {
                let x = law.stroke * libm::sin(if angle > FRAC_PI_2 { PI - angle } else { angle });
                [x, x]
            }
            Self::Linkage(law) => {
                let bed = law.end.at(angle);
                [bed.x[0], bed.deceleration()[0].max(0.0)]
            }
        }
    }

    /// Overrun x at a crank angle of the reversal with its first two derivatives, m.
    #[must_use]
    pub fn travel(&self, angle: f64) -> [f64; 3] {
        match self {
            Self::Yoke(law) => {
                let [x, _] = self.bed(angle);
                [x, law.stroke * libm::cos(angle), -x]
            }
            Self::Linkage(law) => {
                let [x, first, second, ..] = law.end.at(angle).x;
                [x, first, second]
            }
        }
    }

    /// Whether the air returns at each overrun the work that it took there on the way in.
    #[must_use]
    pub fn is_symmetric(&self) -> bool {
        match self {
            Self::Yoke(law) => law.level.is_none(),
            Self::Linkage(law) => law.end.symmetric(),
        }
    }

    /// Overrun of the bed at any crank angle, in strokes. A yoke lets the bed go outside the reversal, where it runs at constant speed, and
    /// the part of its path about its other end is not known; a linkage holds it all the time.
    #[must_use]
    pub fn place(&self, angle: f64) -> f64 {
        let turn = angle.rem_euclid(TAU);
        match self {
            Self::Yoke(_) if turn <= PI => libm::sin(turn),
            Self::Yoke(_) if turn > PI + FRAC_PI_2 => turn - TAU,
            Self::Yoke(_) => PI - turn,
            Self::Linkage(law) => law.end.at(angle).x[0] / law.end.stroke(),
        }
    }

    /// The crank angle, rad, at which a growing deceleration reaches a value (m) up to its largest.
    #[must_use]
    pub fn where_decelerated(&self, deceleration: f64) -> f64 {
        match self {
            Self::Yoke(law) => libm::asin((deceleration / law.stroke).min(1.0)),
            Self::Linkage(law) => {
                let largest = law.end.largest_deceleration();
                if deceleration >= largest.value {
                    return largest.at;
                }
                root::bracketed(|angle| law.end.at(angle).deceleration()[0] - deceleration, 0.0, largest.at, 0.0)
                    .unwrap_or(0.0)
            }
        }
    }

    /// Δx at a crank angle of the reversal where the forces balance, m.
    #[must_use]
    pub fn displacement(&self, angle: f64) -> f64 {
        match self {
            Self::Yoke(law) => law.displacement(self.bed(angle)[0]),
            Self::Linkage(law) => law.at(angle)[0],
        }
    }

    /// Pressure ratio p/p0 at a crank angle of the reversal with the bottom at Δx, equation (8) with lead.
    #[must_use]
    pub fn pressure_ratio(&self, angle: f64, displacement: f64) -> f64 {
        let [_, deceleration] = self.bed(angle);
        self.pressure_ratio_off(angle, deceleration, displacement - self.displacement(angle))
    }

    /// Pressure ratio at a crank angle where the bed decelerates by this much (m) and the bottom is this far (m, towards the piston) from where
    /// the forces balance. There the ratio is 1 + A a, so that an exact bottom has an exact force; a law that levels both ways has the ratio
    /// of the respective way, with the dead point where the law has it.
    #[must_use]
    pub fn pressure_ratio_off(&self, angle: f64, deceleration: f64, off: f64) -> f64 {
        if let Self::Yoke(BottomLaw { level: Some(air), column, loading, .. }) = self {
            let length = air.length(loading * deceleration);
            let [on_way_in, back] = air.pressures(length - off / column);
            return if angle > FRAC_PI_2 { back } else { on_way_in };
        }
        let balanced = 1.0 + self.loading() * deceleration;
        if off == 0.0 {
            return balanced;
        }
        balanced * libm::exp(-self.exponent() * libm::log1p(-off / self.air_left(deceleration)))
    }

    /// Length of the air where it balances a deceleration a (m), m: L (1 + A a)^(−1/k).
    #[must_use]
    pub fn air_left(&self, deceleration: f64) -> f64 {
        match self {
            Self::Yoke(law) => law.air_left(deceleration),
            Self::Linkage(law) => law.column * libm::exp(-libm::log1p(law.loading * deceleration) / law.exponent),
        }
    }

    /// The Δx of largest size over the reversal, m, with the overrun there, m.
    #[must_use]
    pub fn largest_displacement(&self) -> (f64, f64) {
        match self {
            Self::Yoke(law) => law.largest_displacement(),
            Self::Linkage(law) => {
                let range = (0.0, law.end.angle());
                let of =
                    |sign: f64| extremum::largest(|at| sign * law.at(at)[0], |at| sign * law.at(at)[1], range, CELLS);
                let (up, down) = (of(1.0), of(-1.0));
                let at = if up.value > down.value { up.at } else { down.at };
                (law.end.at(at).x[0], law.at(at)[0])
            }
        }
    }

    /// Largest residual force of a plain buffer with a fixed bottom, its column by (7), over 2 p0 F: where, rad of crank angle, and how
    /// much. For a linkage it is searched in φ, since (9) has no closed extremum there.
    #[must_use]
    pub fn residual_of_fixed_bottom(&self) -> Extremum {
        match self {
            Self::Yoke(law) => {
                let (x, value) = PlainBuffer::new(law.loading, law.exponent, law.stroke).largest_residual();
                Extremum { at: libm::asin(x / law.stroke), value }
            }
            Self::Linkage(law) => {
                let range = (0.0, law.end.angle());
                let [up, down] = [1.0, -1.0].map(|sign| {
                    extremum::largest(
                        |at| sign * law.fixed_bottom(at).0,
                        |at| sign * law.fixed_bottom(at).1,
                        range,
                        CELLS,
                    )
                });
                if up.value > down.value { up } else { down }
            }
        }
    }

    /// Air of that plain buffer over 2 p0 F at a crank angle of the reversal.
    #[must_use]
    pub fn air_of_fixed_bottom(&self, angle: f64) -> f64 {
        let [x, a] = self.bed(angle);
        match self {
            Self::Yoke(law) => PlainBuffer::new(law.loading, law.exponent, law.stroke).air(x),
            Self::Linkage(law) => law.loading * a - law.fixed_bottom(angle).0,
        }
    }
}

impl LinkageLaw {
    /// Torque of the air on the camshaft over 2 p0 F, m, A a Δx', and its slope by the crank angle.
    fn torque(&self, angle: f64) -> (f64, f64) {
        let ([a, a1, ..], [_, bottom1, bottom2, ..]) = (self.end.at(angle).deceleration(), self.at(angle));
        (self.loading * a * bottom1, self.loading * (a1 * bottom1 + a * bottom2))
    }

    /// Its largest size over the reversal, m.
    fn largest_torque(&self) -> f64 {
        let range = (0.0, self.end.angle());
        let [up, down] = [1.0, -1.0].map(|sign| {
            extremum::largest(|at| sign * self.torque(at).0, |at| sign * self.torque(at).1, range, CELLS).value
        });
        extremum::larger(up, down)
    }

    /// Inertia less air of a plain buffer with a fixed bottom over 2 p0 F, and its slope by the crank angle.
    fn fixed_bottom(&self, angle: f64) -> (f64, f64) {
        let column = fixed_column(self.loading, self.exponent, &self.end);
        let bed = self.end.at(angle);
        let ([x, x1, ..], [a, a1, ..]) = (bed.x, bed.deceleration());
        let air = libm::expm1(-self.exponent * libm::log1p(-x / column));
        let slope = self.exponent * (1.0 + air) * x1 / (column - x);
        (self.loading * a - air, self.loading * a1 - slope)
    }
}

#[cfg(test)]
mod tests;

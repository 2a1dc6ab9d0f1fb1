//! Motions: the cam angle, or the overrun of the bed, to the follower's lift and its derivatives.
//!
//! A motion is smooth on each of its pieces and may jump between them. A motion is sampled piece by piece, so that
//! both sides of a break are available: there is no evaluation "at" a break without saying from which side.

pub(crate) mod brake_disc;
pub mod counter_torque;
mod eccentric;
pub mod equation_18;
pub mod formula;
pub mod laws;
pub mod program;
mod raised;
mod reversal;
mod transition;

pub use brake_disc::BrakeDisc;
pub use eccentric::EccentricCircle;
pub use equation_18::WedgeMotion;
pub use raised::Raised;
pub use reversal::{MotionError, Reversal, ReversalLaw, State};
pub use transition::Transition;

use std::f64::consts::TAU;

/// What a lift is: the travel of a translating follower or the swing of an oscillating one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quantity {
    /// Metres.
    Length,
    /// Radians.
    Angle,
}

impl Quantity {
    /// For a message.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Quantity::Length => "a length",
            Quantity::Angle => "an angle",
        }
    }
}

/// Lift and its derivatives by the cam angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Jet {
    /// Lift s, m or rad, counted from the lowest point of the motion.
    pub s: f64,
    /// ds/dθ, m/rad.
    pub ds: f64,
    /// d²s/dθ², m/rad².
    pub dds: f64,
    /// d³s/dθ³, m/rad³.
    pub ddds: f64,
}

impl Jet {
    /// The jet with value and derivatives multiplied by a factor.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self { s: self.s * factor, ds: self.ds * factor, dds: self.dds * factor, ddds: self.ddds * factor }
    }

    /// The jet by θ = ratio · φ of a jet by φ.
    #[must_use]
    pub fn by_angle_times(self, ratio: f64) -> Self {
        let n = 1.0 / ratio;
        Self { s: self.s, ds: self.ds * n, dds: self.dds * n * n, ddds: self.ddds * n * n * n }
    }

    /// The sum of two jets.
    #[must_use]
    pub fn plus(self, other: Self) -> Self {
        Self { s: self.s + other.s, ds: self.ds + other.ds, dds: self.dds + other.dds, ddds: self.ddds + other.ddds }
    }

    /// The jet of the mirrored motion s(−θ).
    #[must_use]
    pub fn mirrored(self) -> Self {
        Self { ds: -self.ds, ddds: -self.ddds, ..self }
    }
}

/// A stretch of cam angle on which a motion is smooth up to and including its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// First cam angle, rad.
    pub start: f64,
    /// Last cam angle, rad; the next piece starts here.
    pub end: f64,
    /// The follower rests.
    pub dwell: bool,
}

/// Turns up to which an angle is shifted turn by turn, so that each shift is the same subtraction whatever the number of
/// turns; beyond, whole turns are taken off at once.
const TURNS_ONE_BY_ONE: f64 = 16.0;

/// Cells of a movement: pressure angle and curvature have a handful of extrema on it.
const CELLS: u32 = 32;

/// A follower motion: over one turn of the cam, or over the stroke of a cam that is run over once and back.
pub trait Motion: std::fmt::Debug + Send + Sync {
    /// The pieces in order; together they cover exactly one period, a turn starting anywhere in (−2π, 2π).
    fn pieces(&self) -> &[Piece];

    /// The jet at a value of the parameter within a piece, its ends included.
    fn jet(&self, piece: usize, parameter: f64) -> Jet;

    /// Whether a follower runs on a piece; else it only closes the outline, and what a follower feels or presses there does not
    /// matter.
    fn is_rolled(&self, _piece: usize) -> bool {
        true
    }

    /// Whether a follower runs on every piece.
    fn is_rolled_throughout(&self) -> bool {
        (0..self.distinct().len()).all(|piece| self.is_rolled(piece))
    }

    /// Whether the lift is a length or an angle.
    fn quantity(&self) -> Quantity {
        Quantity::Length
    }

    /// After how much the motion repeats itself: a turn, or `None` for a cam that is run over once and back.
    fn period(&self) -> Option<f64> {
        Some(TAU)
    }

    /// First and second derivative of the parameter by the angle of the shaft that gives the time: the cam's own, or the crank's
    /// of a plate on the bed.
    fn pace(&self, _parameter: f64) -> (f64, f64) {
        (1.0, 0.0)
    }

    /// The position where the lift is 0, in the coordinate in which the motion was specified, m or rad.
    fn origin(&self) -> Option<f64> {
        None
    }

    /// The program of segments that it is, if it is one.
    fn program(&self) -> Option<&program::Program> {
        None
    }

    /// Equal lobes of a turn, at least 1: so often the motion repeats itself, with as many pieces in each.
    fn lobes(&self) -> u32 {
        1
    }

    /// The pieces of the first lobe: what holds on them holds on all.
    fn distinct(&self) -> &[Piece] {
        let pieces = self.pieces();
        let count = usize::try_from(self.lobes()).ok().and_then(|lobes| pieces.len().checked_div(lobes));
        count.and_then(|count| pieces.get(..count)).unwrap_or(pieces)
    }

    /// The piece that a piece repeats, turned, or in its mirror where that is told; itself where it repeats none.
    fn repeats(&self, piece: usize) -> (usize, bool) {
        (piece.checked_rem(self.distinct().len()).unwrap_or(piece), false)
    }

    /// In how many cells the extremes on a piece of what a follower does are told apart.
    fn cells(&self, piece: usize) -> u32 {
        let dwells = self.pieces().get(piece).is_some_and(|piece| piece.dwell);
        if dwells { 1 } else { CELLS }
    }

    /// First and last value of the parameter.
    fn range(&self) -> (f64, f64) {
        let pieces = self.pieces();
        (pieces.first().map_or(0.0, |p| p.start), pieces.last().map_or(TAU, |p| p.end))
    }

    /// The piece that holds a cam angle, and the angle shifted by whole turns into it, or, where nothing repeats, to the
    /// nearer end. At a break the later piece. What is not a finite number is taken to the start.
    fn locate(&self, angle: f64) -> (usize, f64) {
        let pieces = self.pieces();
        let (start, end) = self.range();
        let mut inside = if angle.is_finite() { angle } else { start };
        if let Some(period) = self.period() {
            if (inside - start).abs() > TURNS_ONE_BY_ONE * period {
                inside = start + (inside - start).rem_euclid(period);
            }
            while inside < start {
                inside += period;
            }
            while inside >= end {
                inside -= period;
            }
        } else {
            inside = inside.min(end);
        }
        // Adding a turn may round onto the end of the last piece; it then is the start of the first.
        inside = inside.max(start);
        let index = pieces.iter().rposition(|p| p.start <= inside).unwrap_or(0);
        (index, inside)
    }
}

/// The pieces of a motion that repeat none, not in the mirror either, with their numbers: what is as large in the mirror is looked for on
/// these.
pub fn own_pieces(motion: &dyn Motion) -> impl Iterator<Item = (usize, &Piece)> {
    motion.distinct().iter().enumerate().filter(|(index, _)| motion.repeats(*index).0 == *index)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::buffer::bottom_law::{BottomLaw, Column};

    fn bottom_law(q: f64, column: Column, lead: f64) -> BottomLaw {
        BottomLaw::new((q - 1.0) / 0.18, 1.35, 0.18, column, lead)
    }

    /// Every law of the house: the contract below walks this list.
    fn laws() -> Vec<(String, Box<dyn Motion>)> {
        let mut motions: Vec<(String, Box<dyn Motion>)> =
            vec![("eccentric".into(), Box::new(EccentricCircle::new(0.01, 0.05)))];
        let width = 20.0_f64.to_radians();
        for (q, column) in [(2.0, Column::Matched), (5.0, Column::Return), (2.0, Column::Length(0.2))] {
            for transition in [Transition::None, Transition::RunUp { width }, Transition::Blend { width }] {
                for lobes in [1, 2, 3] {
                    let law =
                        ReversalLaw { bottom_law: bottom_law(q, column, 0.0).into(), lever: 1.5, lobes, transition };
                    let name = format!("{column:?} {transition:?}, {lobes} lobes");
                    motions.push((name, Box::new(Reversal::new(law).expect("fits into a turn"))));
                }
            }
        }
        let transition = Transition::RunUp { width };
        let law =
            ReversalLaw { bottom_law: bottom_law(2.0, Column::Matched, 0.01).into(), lever: 1.0, lobes: 1, transition };
        motions.push(("lead".into(), Box::new(Reversal::new(law).expect("fits"))));
        motions.push(("brake disc".into(), Box::new(brake_disc::tests::disc())));
        // Laws that are analytic on each of their pieces, as the differences below ask.
        for name in ["cycloidal", "s-curve", "parabola-line"] {
            let law = laws::named(name);
            let segments = [(law, 2.0, 1e-4), (None, 1.0, 0.0), (law, 3.0, 0.0), (None, 0.0, 0.0)];
            motions.push((name.into(), Box::new(program::Program::new(Quantity::Length, 0.0, &segments))));
        }
        motions
    }

    #[test]
    fn pieces_cover_one_turn_and_every_angle_is_found() {
        for (name, law) in laws() {
            let pieces = law.pieces();
            let turn = pieces[pieces.len() - 1].end - pieces[0].start;
            assert!((turn - TAU).abs() < 1e-14, "{name}: {turn}");
            for pair in pieces.windows(2) {
                assert_eq!(pair[0].end, pair[1].start, "{name}");
                assert!(pair[0].start < pair[0].end, "{name}");
            }
            for i in 0..720 {
                let angle = f64::from(i).to_radians() * 0.5;
                let (index, inside) = law.locate(angle);
                assert!(pieces[index].start <= inside && inside <= pieces[index].end, "{name} at {angle}");
            }
        }
    }

    /// Infinite, huge and undefined angles are located too, in no time.
    #[test]
    fn any_angle_ends_in_a_piece() {
        for (name, law) in laws() {
            for angle in [1e300, -1e300, 1e18, -1e9, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 5e-324] {
                let (index, inside) = law.locate(angle);
                let piece = law.pieces()[index];
                assert!(piece.start <= inside && inside <= piece.end, "{name} at {angle}: {inside}");
            }
        }
    }

    /// A piece that repeats another is as long, and has its lift and derivatives turned or in the mirror, but for the rounding of the angle.
    #[test]
    fn pieces_repeat_what_they_say() {
        let mut mirrored = 0;
        for (name, law) in laws() {
            for (index, piece) in law.pieces().iter().enumerate() {
                let (other, in_mirror) = law.repeats(index);
                let own = law.pieces()[other];
                assert!(other <= index && law.repeats(other) == (other, false), "{name}: {index} repeats {other}");
                assert!((piece.end - piece.start - (own.end - own.start)).abs() < 1e-12, "{name}: {index}");
                mirrored += usize::from(in_mirror);
                for i in 0..=50 {
                    let along = (piece.end - piece.start) * f64::from(i) / 50.0;
                    let jet = law.jet(index, piece.start + along);
                    let wanted = if in_mirror {
                        law.jet(other, own.end - along).mirrored()
                    } else {
                        law.jet(other, own.start + along)
                    };
                    let pairs =
                        [(jet.s, wanted.s), (jet.ds, wanted.ds), (jet.dds, wanted.dds), (jet.ddds, wanted.ddds)];
                    for (own, wanted) in pairs {
                        assert!((own - wanted).abs() < 1e-10 * (1.0 + wanted.abs()), "{name}: {index} at {along}");
                    }
                }
            }
        }
        assert!(mirrored > 10, "{mirrored}");
    }

    #[test]
    fn lift_is_never_below_zero_and_touches_it() {
        for (name, law) in laws() {
            let mut least = f64::INFINITY;
            for (index, piece) in law.pieces().iter().enumerate() {
                for i in 0..=1000 {
                    let angle = piece.start + (piece.end - piece.start) * f64::from(i) / 1000.0;
                    least = least.min(law.jet(index, angle).s);
                }
            }
            assert!((-1e-16..1e-6).contains(&least), "{name}: {least}");
        }
    }

    /// Each derivative against the central difference of the one before, fourth order in the step; the tolerance is
    /// the rounding of the difference (1e-16 of the size over the step) plus its truncation.
    #[test]
    fn derivatives_belong_to_their_values() {
        let h = 2.5e-4;
        for (name, law) in laws() {
            for (index, piece) in law.pieces().iter().enumerate() {
                for i in 1..40 {
                    let angle = piece.start + (piece.end - piece.start) * f64::from(i) / 40.0;
                    if angle - 2.0 * h < piece.start || angle + 2.0 * h > piece.end {
                        continue;
                    }
                    let at = |n: f64| law.jet(index, angle + n * h);
                    let difference = |f: fn(Jet) -> f64| {
                        (8.0 * (f(at(1.0)) - f(at(-1.0))) - (f(at(2.0)) - f(at(-2.0)))) / (12.0 * h)
                    };
                    let jet = at(0.0);
                    for (order, exact, by_difference) in [
                        (1, jet.ds, difference(|j| j.s)),
                        (2, jet.dds, difference(|j| j.ds)),
                        (3, jet.ddds, difference(|j| j.dds)),
                    ] {
                        assert!(
                            (exact - by_difference).abs() < 1e-9 * (1.0 + exact.abs()),
                            "{name} at {angle}, order {order}: {exact} {by_difference}"
                        );
                    }
                }
            }
        }
    }
}

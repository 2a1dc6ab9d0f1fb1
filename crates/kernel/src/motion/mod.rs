//! Motions: the cam angle, the travel of a plate, or the overrun of the bed, to the follower's lift and its derivatives.
//!
//! A motion is smooth on each of its pieces and may jump between them. A motion is sampled piece by piece, so that
//! both sides of a break are available: there is no evaluation "at" a break without saying from which side.

pub mod counter_torque;
mod eccentric;
pub mod formula;
pub mod given;
pub mod jump;
pub mod laws;
mod named_stretch;
pub mod program;

pub use eccentric::EccentricCircle;
pub use named_stretch::NamedStretch;

use std::f64::consts::TAU;

/// What a lift is: the travel of a translating follower or the swing of an oscillating one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
///
/// ```
/// # use camgen_kernel as camgen;
/// use camgen::{Jet, Motion, Piece};
/// use std::f64::consts::TAU;
///
/// /// A harmonic of 20 mm, smooth all round.
/// #[derive(Debug)]
/// struct Harmonic;
///
/// impl Motion for Harmonic {
///     fn pieces(&self) -> &[Piece] {
///         &[Piece { start: 0.0, end: TAU, dwell: false }]
///     }
///
///     fn jet(&self, _piece: usize, angle: f64) -> Jet {
///         let (sin, cos) = angle.sin_cos();
///         Jet { s: 1.0 - cos, ds: sin, dds: cos, ddds: -sin }.scaled(0.010)
///     }
/// }
///
/// // `Spec::builder("harmonic").roller(0.012).motion(Harmonic)` makes a cam of it.
/// assert!((Harmonic.jet(0, TAU / 2.0).s - 0.020).abs() < 1e-15);
/// ```
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

    /// Whether its parameter is the travel of a plate, m, and its rates are by that: no shaft gives the time.
    fn is_by_travel(&self) -> bool {
        false
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

    /// Its stretches as people name them, in their order over the whole range.
    fn named_stretches(&self) -> Vec<NamedStretch> {
        named_stretch::by_lift(self)
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

    /// The piece that a piece repeats, turned, or mirrored where that is stated; itself where it repeats none.
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
        let index = pieces.partition_point(|p| p.start <= inside).saturating_sub(1);
        (index, inside)
    }
}

/// The pieces of a motion that repeat none, not in the mirror either, with their numbers: what is as large in the mirror is looked for on
/// these.
pub fn own_pieces(motion: &dyn Motion) -> impl Iterator<Item = (usize, &Piece)> {
    motion.distinct().iter().enumerate().filter(|(index, _)| motion.repeats(*index).0 == *index)
}

#[cfg(any(test, feature = "contract"))]
pub mod contract;

//! The law of motion.

use super::task::{LawError, Parameters, SegmentEnd};

/// Velocities, in units of travel over width, that differ by less are equal.
const SAME_VELOCITY: f64 = 1e-9;

/// How the acceleration rises and falls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ramp {
    /// Like a quarter of a sine.
    Sine,
    /// In a straight line.
    Straight,
}

/// A half: the acceleration grows over a, is constant over b, falls over c and is 0 over d, a + b + c + d = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Half {
    pub(super) ramp: Ramp,
    pub(super) fractions: [f64; 4],
}

/// Amplitudes of the sines of 1, 2, 3 and 5 waves over the segment in x − Σ b sin(2πkx).
pub(super) type Sines = [f64; 4];

/// How a law is solved: the families.
#[derive(Debug, Clone, Copy)]
pub(super) enum LawFamily {
    /// The straight line.
    Line,
    /// This number of conditions at each end.
    Polynomial(usize),
    /// Two halves.
    Halves(fn(&Parameters) -> Result<Half, LawError>),
    /// Sines over the whole segment.
    Sines(fn(&Parameters) -> Result<Sines, LawError>),
    /// From rest to a turn only.
    DoubleHarmonic,
}

/// A law of motion.
#[derive(Debug)]
pub struct Law {
    /// Its name in files and code.
    pub name: &'static str,
    /// Other names of it.
    pub aliases: &'static [&'static str],
    /// Its formula between rests, for a list.
    pub formula: &'static str,
    /// How many of its derivatives are continuous between two rests, with its own parameters.
    pub continuity: u32,
    pub(super) shape: LawFamily,
}

impl Law {
    /// Whether it has a curve between such ends.
    #[must_use]
    pub fn serves(&self, from: SegmentEnd, to: SegmentEnd) -> bool {
        let turns = from == SegmentEnd::Turn || to == SegmentEnd::Turn;
        let (v0, v1) = (from.velocity(), to.velocity());
        let equal = (v0 - v1).abs() <= SAME_VELOCITY;
        match self.shape {
            LawFamily::Halves(_) => true,
            LawFamily::Polynomial(_) => !turns,
            LawFamily::Sines(_) => !turns && equal,
            LawFamily::Line => !turns && equal && (v0 - 1.0).abs() <= SAME_VELOCITY,
            LawFamily::DoubleHarmonic => {
                matches!((from, to), (SegmentEnd::Rest, SegmentEnd::Turn) | (SegmentEnd::Turn, SegmentEnd::Rest))
            }
        }
    }

    /// Whether it leads from rest to rest.
    #[must_use]
    pub fn serves_rests(&self) -> bool {
        self.serves(SegmentEnd::Rest, SegmentEnd::Rest)
    }
}

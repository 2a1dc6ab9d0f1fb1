//! A task for a law: its ends, inflection and parameters; and why it may fail.

use crate::refusal::Refusal;
use crate::text::Text;
use std::fmt;

/// How a segment begins or ends (VDI 2143: R, G, U).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum SegmentEnd {
    /// Velocity and acceleration 0: a dwell.
    #[default]
    Rest,
    /// A constant velocity, with acceleration 0.
    Moving {
        /// In units of travel over width of the segment: 1 is that of a straight line. Finite.
        velocity: f64,
    },
    /// Velocity 0, any acceleration: a reversal.
    Turn,
}

impl SegmentEnd {
    /// The velocity there, in units of travel over width.
    #[must_use]
    pub fn velocity(self) -> f64 {
        if let SegmentEnd::Moving { velocity } = self { velocity } else { 0.0 }
    }
}

impl std::fmt::Display for SegmentEnd {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            SegmentEnd::Rest => f.write_str("rest"),
            SegmentEnd::Moving { velocity } => write!(f, "{velocity} times the segment's mean velocity"),
            SegmentEnd::Turn => f.write_str("a turn"),
        }
    }
}

/// Where the acceleration changes its sign: the share λ of the segment before it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Inflection {
    /// Where the jerk is continuous from rest to rest or turn; half-way between equal halves, and where the jerk jumps or is 0
    /// on either side anyway.
    #[default]
    Smooth,
    /// There, 0.000001 ≤ λ ≤ 0.999999.
    At(f64),
    /// Where the acceleration at the turn is the one given; of two turns, at the later.
    Match {
        /// In units of travel over width squared. Finite.
        acceleration: f64,
    },
}

/// Parameters of some laws; the others ignore them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Parameters {
    /// For scca: the shares of a half in which the acceleration rises as a sine, is constant, falls as a cosine, and is 0. Each
    /// 0 or at least 0.000001, the sum 1, the last below 1; a quarter each when absent.
    pub fractions: Option<[f64; 4]>,
    /// For parabola-line and sine-line: the share of the segment with constant velocity, 0 ≤ d ≤ 0.999999; a half when absent.
    pub line: Option<f64>,
    /// For triple-harmonic: the acceleration's amplitudes of one, two and three waves over the segment, scaled together so that
    /// the travel is 1; 9π/4, 0, −3π/4 when absent, whose jerk is 0 at both ends.
    pub amplitudes: Option<[f64; 3]>,
    /// For s-curve: the share of a half in which the acceleration grows, 0.000001 ≤ a ≤ ½, and that in which it falls; a quarter when
    /// absent.
    pub ramp: Option<f64>,
}

/// A segment for a law to solve, of travel 1 and width 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LawTask {
    /// How it begins.
    pub from: SegmentEnd,
    /// How it ends.
    pub to: SegmentEnd,
    /// Where its acceleration changes its sign.
    pub inflection: Inflection,
    /// The parameters of the law.
    pub parameters: Parameters,
}

impl LawTask {
    /// From one end to another, everything else as usual.
    #[must_use]
    pub fn between(from: SegmentEnd, to: SegmentEnd) -> Self {
        Self { from, to, ..Self::default() }
    }
}

/// Why a law does not solve a task, or a segment cannot be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{refusal}")]
pub struct LawError {
    /// The input that decides it, as the keys of a segment name it: "law", "inflection", a parameter of the law.
    pub input: &'static str,
    /// What is wrong.
    pub refusal: Refusal,
}

impl LawError {
    pub(crate) fn new(input: &'static str, what: impl Into<String>) -> Self {
        Self { input, refusal: Refusal::new(what) }
    }

    pub(crate) fn remedy(self, remedy: impl Into<Text>) -> Self {
        Self { refusal: self.refusal.remedy(remedy), ..self }
    }

    /// That a parameter is out of its range.
    pub(super) fn parameter(name: &'static str, expected: &str, found: impl fmt::Display) -> Self {
        Self::new(name, format!("{name} must be {expected}, not {found}"))
    }
}

/// The ends of a task, in words that follow "cannot".
pub(super) fn between(from: SegmentEnd, to: SegmentEnd) -> String {
    match (from, to) {
        (SegmentEnd::Rest, SegmentEnd::Rest) => "start and end at rest".into(),
        (SegmentEnd::Rest, to) => format!("end at {to}"),
        (from, SegmentEnd::Rest) => format!("start at {from}"),
        (from, to) => format!("start at {from} and end at {to}"),
    }
}

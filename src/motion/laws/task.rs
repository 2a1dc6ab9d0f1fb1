//! What is asked of a law: its ends, its inflection, its own numbers; and why it may refuse.

/// How a segment begins or ends (VDI 2143: R, G, U).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum End {
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

impl End {
    /// The velocity there, in units of travel over width.
    #[must_use]
    pub fn velocity(self) -> f64 {
        if let End::Moving { velocity } = self { velocity } else { 0.0 }
    }
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            End::Rest => f.write_str("rest"),
            End::Moving { velocity } => write!(f, "{velocity} of the segment's mean velocity"),
            End::Turn => f.write_str("a turn"),
        }
    }
}

/// Where the acceleration changes its sign: the share λ of the segment that lies before.
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

/// Numbers that some laws have; the others do not look at them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Parameters {
    /// Of scca: the shares of a half in which the acceleration rises as a sine, is constant, falls as a cosine, and is 0. Each
    /// 0 or at least 0.000001, the sum 1, the last below 1; a quarter each when absent.
    pub fractions: Option<[f64; 4]>,
    /// Of parabola-line and sine-line: the share of the way that is a straight line, 0 ≤ d ≤ 0.999999; a half when absent.
    pub line: Option<f64>,
    /// Of triple-harmonic: the acceleration's amplitudes of one, two and three waves over the segment, scaled together so that
    /// the travel is 1; 9π/4, 0, −3π/4 when absent, whose jerk is 0 at both ends.
    pub amplitudes: Option<[f64; 3]>,
    /// Of s-curve: the share of a half in which the acceleration grows, 0.000001 ≤ a ≤ ½, and that in which it falls; a quarter when
    /// absent.
    pub ramp: Option<f64>,
}

/// A segment for a law to solve, of travel 1 and width 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Task {
    /// How it begins.
    pub from: End,
    /// How it ends.
    pub to: End,
    /// Where its acceleration changes its sign.
    pub inflection: Inflection,
    /// The law's own numbers.
    pub parameters: Parameters,
}

impl Task {
    /// From one end to another, everything else as usual.
    #[must_use]
    pub fn between(from: End, to: End) -> Self {
        Self { from, to, ..Self::default() }
    }
}

/// Why a law does not solve a task.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LawError {
    /// The law has no curve between such ends.
    #[error("{law} cannot {}; laws that can: {}", between(*.from, *.to), .others.join(", "))]
    CannotServe {
        /// The law.
        law: &'static str,
        /// How the segment begins.
        from: End,
        /// How it ends.
        to: End,
        /// Every law that serves these ends.
        others: Vec<&'static str>,
    },
    /// An inflection is asked for of a law that has none to choose.
    #[error("{law} has no inflection to choose: only laws of two halves have one")]
    NoInflection {
        /// The law.
        law: &'static str,
    },
    /// The inflection is not inside the segment.
    #[error("the inflection must be at least 0.000001 and at most 0.999999, not {found}")]
    Inflection {
        /// As given.
        found: f64,
    },
    /// The acceleration at a turn is to be matched, and no end is a turn.
    #[error("an inflection that matches an acceleration needs a turn at one end")]
    NoTurn,
    /// No inflection gives the acceleration at the turn.
    #[error(
        "no inflection of {law} gives an acceleration of {acceleration} at the turn (in travel over width squared)"
    )]
    NoMatch {
        /// The law.
        law: &'static str,
        /// The acceleration asked for, in units of travel over width squared.
        acceleration: f64,
    },
    /// A number of the task is infinite or undefined.
    #[error("{what} must be a finite number, not {found}")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// As given.
        found: f64,
    },
    /// A number of the law's own is out of its range.
    #[error("{name} must be {expected}, not {found}")]
    Parameter {
        /// Its name.
        name: &'static str,
        /// Its range.
        expected: &'static str,
        /// As given.
        found: String,
    },
}

/// What a law should do between two ends.
fn between(from: End, to: End) -> String {
    match (from, to) {
        (End::Rest, End::Rest) => "start and end at rest".into(),
        (End::Rest, to) => format!("end at {to}"),
        (from, End::Rest) => format!("start at {from}"),
        (from, to) => format!("start at {from} and end at {to}"),
    }
}

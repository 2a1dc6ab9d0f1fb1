//! Why a shaft is refused or has no answer, with what would pass.

use super::{LEAST_DISTANCE, MOST_MODES, MOST_ORDER, MOST_PANELS, MOST_RATIO, MOST_STATIONS};

/// A part of a shaft, for a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Part {
    /// [`super::Segment`].
    Segment,
    /// [`super::Support`].
    Support,
    /// [`super::Disc`].
    Disc,
    /// A place that was asked about: of a load, a speed.
    Asked,
}

impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Segment => "segment",
            Self::Support => "support",
            Self::Disc => "disc",
            Self::Asked => "question",
        })
    }
}

/// Why a shaft is refused, or a question about it. An index counts from 0, its message from 1; values are SI.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShaftError {
    /// There is nothing to bend.
    #[error("the shaft has no segment: it needs at least one")]
    NoSegments,
    /// It would fall or swing.
    #[error("the shaft has {found} supports: it needs at least two")]
    FewSupports {
        /// How many there are.
        found: usize,
    },
    /// Together they would be a clamp of no certain stiffness.
    #[error(
        "supports {} and {} are {distance} m apart, at {at} m: they must be more than {LEAST_DISTANCE} m apart",
        first + 1,
        second + 1
    )]
    SupportsTogether {
        /// The left one.
        first: usize,
        /// The right one.
        second: usize,
        /// Place of the left one, m.
        at: f64,
        /// m.
        distance: f64,
    },
    /// Beside the shaft.
    #[error("{part} {} is at {at} m: it must be within 0…{length} m, the length of the shaft", index + 1)]
    Outside {
        /// What.
        part: Part,
        /// Which.
        index: usize,
        /// m.
        at: f64,
        /// Length of the shaft, m.
        length: f64,
    },
    /// No wall is left.
    #[error("segment {} has a bore of {bore} m in a diameter of {diameter} m: the bore must be smaller", index + 1)]
    Bore {
        /// Which.
        index: usize,
        /// m.
        bore: f64,
        /// m; any smaller bore passes.
        diameter: f64,
    },
    /// A length, diameter, modulus or stiffness.
    #[error("the {name} of {part} {} is {value}: it must be a number above 0", index + 1)]
    NotPositive {
        /// What.
        part: Part,
        /// Which.
        index: usize,
        /// Of what.
        name: &'static str,
        /// Found, SI.
        value: f64,
    },
    /// A bore, density, mass, inertia or speed; 0 passes.
    #[error("the {name} of {part} {} is {value}: it must be a number of at least 0", index + 1)]
    Negative {
        /// What.
        part: Part,
        /// Which.
        index: usize,
        /// Of what.
        name: &'static str,
        /// Found, SI.
        value: f64,
    },
    /// An unbalance.
    #[error("the {name} of {part} {} is {value}: it must be a number", index + 1)]
    NotFinite {
        /// What.
        part: Part,
        /// Which.
        index: usize,
        /// Of what.
        name: &'static str,
        /// Found, SI.
        value: f64,
    },
    /// No elastic material has it: −1 < ν ≤ ½.
    #[error("Poisson's ratio of segment {} is {value}: it must be above -1 and at most 0.5", index + 1)]
    Poisson {
        /// Which.
        index: usize,
        /// Found.
        value: f64,
    },
    /// No body has it: I_p = ∫ r² dm = 2 I_t − 2 ∫ x² dm.
    #[error(
        "disc {} has a polar inertia of {polar} kg m², more than twice its diametral one: it can be at most {most} kg m²",
        index + 1
    )]
    Polar {
        /// Which.
        index: usize,
        /// kg m².
        polar: f64,
        /// 2 I_t, kg m².
        most: f64,
    },
    /// The work grows with the cube of their number.
    #[error("the shaft has {found} panels between its steps, supports and discs: at most {MOST_PANELS}")]
    Panels {
        /// How many there are.
        found: usize,
    },
    /// A massless shaft without a disc.
    #[error(
        "the shaft has no mass that can move: a density above 0, or a disc away from the rigid supports, gives it one"
    )]
    NoMass,
    /// A massless shaft has only the modes its discs make; a thin disc in forward whirl has none by turning.
    #[error("the shaft has {exist} critical speeds: number {asked} does not exist")]
    NoSuchMode {
        /// The number asked for, from 1.
        asked: usize,
        /// How many there are.
        exist: usize,
    },
    /// Its digits are gone: the relative error of 1/ω_j² is about ε (ω_j/ω_1)².
    #[error("critical speed {mode} is more than {MOST_RATIO} times the first: it is lost in rounding; ask for {} at most", mode - 1)]
    ModeTooHigh {
        /// The first that is too high, from 1.
        mode: usize,
    },
    /// Of the load polynomials.
    #[error("the order is {order}: it must be 1…{MOST_ORDER}")]
    Order {
        /// Found.
        order: usize,
    },
    /// The numbers of the shaft are beyond those of a computer.
    #[error("the numbers of the shaft leave the range of the arithmetic: check its units")]
    Range,
    /// So many modes are no question of a shaft.
    #[error("{asked} modes: at most {MOST_MODES}")]
    Modes {
        /// Found.
        asked: usize,
    },
    /// The shaft would hold more waves than a mode below the wall.
    #[error("{speed} rad/s is far above every critical speed that is told: the response is lost in rounding")]
    TooFast {
        /// rad/s.
        speed: f64,
    },
    /// At a critical speed the steady response is without bound.
    #[error("{speed} rad/s is a critical speed: the steady response has no bound there")]
    Resonance {
        /// rad/s.
        speed: f64,
    },
    /// The paper's integral equation is one of two supports.
    #[error("the shaft has {found} supports: the paper's method knows two, the exact one any number")]
    PaperSupports {
        /// How many there are.
        found: usize,
    },
    /// Stations of the paper's method.
    #[error("{stations} stations: 1…{MOST_STATIONS}")]
    Stations {
        /// Found.
        stations: usize,
    },
    /// The iteration turns from one mode to the other.
    #[error("no end after {rounds} rounds: two critical speeds lie close together; the exact method tells them apart")]
    CloseSpeeds {
        /// How many were made.
        rounds: usize,
    },
    /// Correction planes at one place.
    #[error("both planes are at {at} m: two planes must be apart")]
    PlanesTogether {
        /// m.
        at: f64,
    },
    /// Two equal weights cannot cancel so much.
    #[error(
        "two weights of {weight} kg m cannot cancel an unbalance of {unbalance} kg m: they must be {least} kg m each"
    )]
    WeightsTooLight {
        /// Of each, kg m.
        weight: f64,
        /// kg m.
        unbalance: f64,
        /// Half of the unbalance, kg m.
        least: f64,
    },
}

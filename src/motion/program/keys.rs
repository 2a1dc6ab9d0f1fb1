//! The keys of `[motion]`, `[motion.fourier]` and `[[motion.segment]]`.

use crate::document::Presence::{Default, Optional, Required};
use crate::document::cams::MAKE;
use crate::document::range::{LARGEST_NUMBER, LEAST_RPM, LONGEST};
use crate::document::{Bounds, Columns, Field, LengthOrAngle, Occurs, Points, Section, above, within};
use crate::motion::laws::spline;
use crate::units::Dimension::{Angle, Frequency};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The law that holds a position.
pub(super) const DWELL: &str = "dwell";
/// The law that is the polynomial of its ends.
pub(super) const POLYNOMIAL: &str = "polynomial";
/// The law that is a spline through points.
pub(super) const SPLINE: &str = "spline";
/// The law that is a formula.
pub(super) const EXPRESSED: &str = "formula";
/// The law that is a table.
pub(super) const TABULATED: &str = "table";
/// The law of a segment without the key `law`.
pub(super) const USUAL: &str = "cycloidal";

/// Positions of a lever are counted from any zero: two turns each way hold every one.
pub(super) const LARGEST_SWING: f64 = 2.0 * TAU;
/// Positions, m or rad.
const POSITION: (Bounds, Bounds) = (within(-LONGEST, LONGEST), within(-LARGEST_SWING, LARGEST_SWING));
/// Most lobes: more would be teeth.
const MOST_LOBES: f64 = 100.0;

pub(super) const RPM: Field<f64> = Field::number(
    "rpm",
    "speed of the cam, 0.001 to 100000; forces and contact stress need it",
    Optional("120"),
    within(LEAST_RPM, LARGEST_NUMBER),
);
pub(super) const START: Field<LengthOrAngle> = Field::length_or_angle(
    "start",
    "position at the start, or what a formula, a series, points or a table are counted from; a length for a translating follower, an angle for a swinging one",
    Required("0 mm"),
    POSITION.0,
    POSITION.1,
);
pub(super) const AT: Field<f64> =
    Field::quantity("at", "cam angle of the first segment", Default("0 deg"), Angle, within(-TAU, TAU));
pub(super) const REPEAT: Field<f64> = Field::number(
    "repeat",
    "equal lobes, a whole number to 100: the segments fill 360 deg over it",
    Default("1"),
    within(1.0, MOST_LOBES),
);

pub(super) const FORMULA: Field<String> = Field::text(
    "formula",
    "instead of segments: the position above start in its unit, by the cam angle th from at, rad: + - * / ^ sin cos tan asin acos atan sqrt exp log pi e",
    Optional("20*(1-cos(th))/2"),
);
pub(super) const POINTS: Field<Points> = Field::points(
    "points",
    "instead of segments: cam angles from at on and positions above start, three or more, joined by a periodic spline",
    Optional("[[\"0 deg\", \"0 mm\"], [\"120 deg\", \"20 mm\"], [\"240 deg\", \"5 mm\"]]"),
    (Angle, within(-TAU, 2.0 * TAU)),
    POSITION,
);
pub(super) const DEGREE: Field<f64> = Field::number(
    "degree",
    "of the spline through points: 5 (least jerk) or 3 (least acceleration, the jerk jumps)",
    Default("5"),
    within(3.0, 5.0),
);
pub(super) const TABLE: Field<Arc<Columns>> = Field::columns(
    "table",
    "instead of segments: a file of rows `angle, position`, deg from at and in the unit of start above it, joined by a periodic spline",
    Optional("lift.csv"),
);

/// `[motion]`.
pub(crate) const SECTION: Section = Section {
    path: "motion",
    about: "a motion program, instead of a press: for `camgen make`",
    occurs: Occurs::Optional,
    cams: &[MAKE],
    keys: &[RPM.key, START.key, AT.key, REPEAT.key, FORMULA.key, POINTS.key, DEGREE.key, TABLE.key],
};

pub(super) const LAW: Field<String> = Field::text(
    "law",
    "\"dwell\", \"polynomial\" (by the states at both ends), \"spline\", \"formula\", \"table\" or a law, cycloidal when absent; a name that is none is answered with the list",
    Optional(USUAL),
);
pub(super) const OVER: Field<f64> = Field::quantity(
    "over",
    "cam angle it takes; the last segment may leave it out",
    Optional("90 deg"),
    Angle,
    above(0.0, TAU),
);
pub(super) const UNTIL: Field<f64> = Field::quantity(
    "until",
    "cam angle at which it ends, instead of over",
    Optional("210 deg"),
    Angle,
    within(-TAU, 2.0 * TAU),
);
pub(super) const TO: Field<LengthOrAngle> =
    Field::length_or_angle("to", "position at its end; not of a dwell", Optional("20 mm"), POSITION.0, POSITION.1);
pub(super) const BY: Field<LengthOrAngle> = Field::length_or_angle(
    "by",
    "by how much the position grows, instead of to",
    Optional("20 mm"),
    POSITION.0,
    POSITION.1,
);
pub(super) const VELOCITY: Field<String> = Field::text(
    "velocity",
    "at its end, by angle or time (needs rpm), or \"auto\": of least jerk between polynomials and splines; of constant-velocity its own, in place of over or to",
    Optional("-0.3 mm/deg"),
);
pub(super) const ACCELERATION: Field<String> = Field::text(
    "acceleration",
    "at its end, 0 when absent, or \"auto\"; other ones need polynomials",
    Optional("2 mm/rad2"),
);
pub(super) const JERK: Field<String> =
    Field::text("jerk", "at its end, where polynomials are to keep it", Optional("0 mm/rad3"));
pub(super) const END: Field<EndOf> = Field::words(
    "end",
    "\"rest\", \"turn\" (velocity 0, any acceleration) or \"moving\" (with a velocity); moving where one is given",
    Optional("turn"),
    &["rest", "turn", "moving"],
    &[EndOf::Rest, EndOf::Turn, EndOf::Moving],
);
pub(super) const INFLECTION: Field<String> = Field::text(
    "inflection",
    "where the acceleration changes sign: a share of the segment, \"smooth\", or \"match\" (the neighbour's acceleration at a turn)",
    Default("smooth"),
);
pub(super) const FRACTIONS: Field<Vec<f64>> = Field::numbers(
    "fractions",
    "of scca: shares of a half with the acceleration rising, constant, falling and 0; their sum is 1",
    Optional("[0.25, 0.25, 0.25, 0.25]"),
    within(0.0, 1.0),
);
pub(super) const LINE: Field<f64> = Field::number(
    "line",
    "of parabola-line and sine-line: share of constant velocity",
    Optional("0.5"),
    within(0.0, 1.0),
);
pub(super) const AMPLITUDES: Field<Vec<f64>> = Field::numbers(
    "amplitudes",
    "of triple-harmonic: of the acceleration's three waves, scaled together",
    Optional("[7, 0, -2.4]"),
    within(-LARGEST_NUMBER, LARGEST_NUMBER),
);
pub(super) const RAMP: Field<f64> = Field::number(
    "ramp",
    "of s-curve: share of a half in which the acceleration grows",
    Optional("0.25"),
    within(0.0, 0.5),
);

pub(super) const COSINES: Field<Vec<f64>> = Field::numbers(
    "cos",
    "amplitudes of cos th, cos 2 th, … in the unit of start, th the cam angle from at, times repeat",
    Optional("[-10, 0.5]"),
    within(-LARGEST_NUMBER, LARGEST_NUMBER),
);
pub(super) const SINES: Field<Vec<f64>> = Field::numbers(
    "sin",
    "amplitudes of sin th, sin 2 th, …",
    Optional("[0, 1.5]"),
    within(-LARGEST_NUMBER, LARGEST_NUMBER),
);

/// `[motion.fourier]`.
pub(crate) const FOURIER: Section = Section {
    path: "motion.fourier",
    about: "a Fourier series above start, instead of segments",
    occurs: Occurs::Optional,
    cams: &[MAKE],
    keys: &[COSINES.key, SINES.key],
};

pub(super) const NATURAL_FREQUENCY: Field<f64> = Field::quantity(
    "natural_frequency",
    "of the load on its train",
    Required("40 Hz"),
    Frequency,
    above(0.0, LARGEST_NUMBER),
);
pub(super) const DAMPING: Field<f64> =
    Field::number("damping", "share of the critical damping", Default("0"), within(0.0, 1.0));
pub(super) const OWN_RPM: Field<f64> = Field::number(
    "rpm",
    "speed for which the cam is made, motion.rpm when absent",
    Optional("120"),
    within(LEAST_RPM, LARGEST_NUMBER),
);

/// `[motion.polydyne]`.
pub(crate) const POLYDYNE: Section = Section {
    path: "motion.polydyne",
    about: "the motion is that of an elastic load, and the cam is made so that the load makes it",
    occurs: Occurs::Optional,
    cams: &[MAKE],
    keys: &[NATURAL_FREQUENCY.key, DAMPING.key, OWN_RPM.key],
};

pub(super) const SHAPE: Field<String> = Field::text(
    "formula",
    "of the law \"formula\": the share of the travel by the share x of the angle, from 0 to 1",
    Optional("x^3*(10-15*x+6*x^2)"),
);
pub(super) const INNER: Field<Points> = Field::points(
    "points",
    "of the law \"spline\": cam angles and positions on its way",
    Optional("[[\"30 deg\", \"4 mm\"], [\"60 deg\", \"15 mm\"]]"),
    (Angle, within(-TAU, 2.0 * TAU)),
    POSITION,
);
pub(super) const SHARES: Field<Arc<Columns>> = Field::columns(
    "table",
    "of the law \"table\": a file of rows of the share of the angle and that of the travel, each from 0 to 1",
    Optional("law.csv"),
);
pub(super) const ENDS: Field<spline::Ends> = Field::words(
    "ends",
    "of the law \"table\": \"free\" (a polynomial to degree 5 comes back exactly) or \"rest\"",
    Default("free"),
    &["free", "rest"],
    &[spline::Ends::Free, spline::Ends::Rest],
);
pub(super) const MINIMISE: Field<Goal> = Field::words(
    "minimise",
    "of the law \"polynomial\" from rest to rest: what its coefficients make least; residual is the peak acceleration without vibration behind the segment",
    Optional("peak-acceleration"),
    &["peak-acceleration", "peak-jerk", "rms-acceleration", "residual"],
    &[Goal::PeakAcceleration, Goal::PeakJerk, Goal::RmsAcceleration, Goal::Residual],
);
pub(super) const OF_OPTIMUM: Field<f64> = Field::number(
    "degree",
    "of a polynomial with minimise, a whole number from 7; an even one is no better than the odd one below",
    Optional("9"),
    within(7.0, 15.0),
);
pub(super) const RATIO: Field<f64> = Field::number(
    "ratio",
    "of minimise = \"residual\": natural periods of the load that the segment takes",
    Optional("2.5"),
    within(0.1, 100.0),
);
pub(super) const ROBUST: Field<bool> = Field::boolean(
    "robust",
    "of minimise = \"residual\": little vibration beside the ratio too; degree 9 or more",
    Default("false"),
);

/// `[[motion.segment]]`.
pub(crate) const SEGMENT: Section = Section {
    path: "motion.segment",
    about: "a segment of the program; states are those at its end",
    occurs: Occurs::Repeated,
    cams: &[MAKE],
    keys: &[
        LAW.key,
        OVER.key,
        UNTIL.key,
        TO.key,
        BY.key,
        VELOCITY.key,
        ACCELERATION.key,
        JERK.key,
        END.key,
        INFLECTION.key,
        FRACTIONS.key,
        LINE.key,
        AMPLITUDES.key,
        RAMP.key,
        SHAPE.key,
        INNER.key,
        SHARES.key,
        ENDS.key,
        MINIMISE.key,
        OF_OPTIMUM.key,
        RATIO.key,
        ROBUST.key,
    ],
};

/// What the end of a segment is said to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EndOf {
    Rest,
    Turn,
    Moving,
}

/// What a polynomial is said to make least.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Goal {
    PeakAcceleration,
    PeakJerk,
    RmsAcceleration,
    Residual,
}

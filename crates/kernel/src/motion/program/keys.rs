//! The keys of `[motion]`, `[motion.fourier]` and `[[motion.segment]]`.

use crate::document::Presence::{Default, Optional, Required};
use crate::document::cams::{MAKE, WEDGE};
use crate::document::range::{LARGEST_NUMBER, LEAST_RPM, LONGEST, TURNS_FORWARD};
use crate::document::{Bounds, Columns, Field, KeySection, LengthOrAngle, Occurrence, PointList, above, within};
use crate::motion::laws::spline;
use crate::units::Dimension::{Angle, Frequency, Length};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The law that keeps a position.
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

/// Positions of a lever are measured from any zero: two turns in each direction include all of them.
pub(super) const LARGEST_SWING: f64 = 2.0 * TAU;
/// Positions, m or rad.
const POSITION: (Bounds, Bounds) = (within(-LONGEST, LONGEST), within(-LARGEST_SWING, LARGEST_SWING));
/// Places of a program, rad, or m of a plate.
const PLACE: (Bounds, Bounds) = (within(-TAU, 2.0 * TAU), within(-LONGEST, LONGEST));
/// Most lobes: more would be teeth.
const MOST_LOBES: f64 = 100.0;

pub(super) const RPM: Field<f64> = Field::number(
    "rpm",
    "speed of the cam, 0.001 to 100000; forces and contact stress need it",
    Optional("120"),
    within(LEAST_RPM, LARGEST_NUMBER),
)
.hint(TURNS_FORWARD)
.also(&["speed", "n", "rotational_speed", "revolutions"]);
pub(super) const START: Field<LengthOrAngle> = Field::length_or_angle(
    "start",
    "position at the start, or the zero from which a formula, series, points or table is measured; a length for a follower on a straight path, an angle for a swinging one",
    Required("0 mm"),
    POSITION.0,
    POSITION.1,
)
.also(&["position", "start_position", "initial_position"]);
pub(super) const AT: Field<f64> = Field::quantity(
    "at",
    "cam angle of the first segment; a formula, a series, points and table rows are shifted by it, too",
    Default("0 deg"),
    Angle,
    within(-TAU, TAU),
)
.also(&["start_angle", "phase"]);
pub(super) const REPEAT: Field<f64> = Field::number(
    "repeat",
    "number of equal lobes, 1 to 100; the segments fill 360 deg / repeat",
    Default("1"),
    within(1.0, MOST_LOBES),
)
.also(&["lobes", "cycles", "number_of_lobes"]);
pub(super) const STROKE: Field<f64> = Field::quantity(
    "stroke",
    "travel of a plate (cam.body = \"wedge\"), in the place of a turn: angles of the program are then lengths along it",
    Optional("100 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[WEDGE])
.also(&["travel"]);
pub(super) const MEASURED_AT: Field<MeasuredAt> = Field::words(
    "measured_at",
    "what positions of a swinging follower are: \"pivot\" (angles of its arm), \"roller\" (lengths along the arc of its roller) or \"output\" (lengths along the arc at output_arm)",
    Optional("roller"),
    &["pivot", "roller", "output"],
    &[MeasuredAt::Pivot, MeasuredAt::Roller, MeasuredAt::Output],
);
pub(super) const OUTPUT_ARM: Field<f64> = Field::quantity(
    "output_arm",
    "arm of a swinging follower at whose end positions are lengths along its arc; measured_at is then output when absent",
    Optional("150 mm"),
    Length,
    above(0.0, LONGEST),
);

pub(super) const FORMULA: Field<String> = Field::text(
    "formula",
    "instead of segments: position above start, in the unit of start, as a function of th, the cam angle from at in rad: + - * / ^ sin cos tan asin acos atan sqrt exp log pi e; of a plate a function of x, its travel in the unit of start",
    Optional("20*(1-cos(th))/2"),
);
pub(super) const POINTS: Field<PointList> = Field::points(
    "points",
    "instead of segments: three or more pairs of a cam angle (from at on) and a position above start, joined by a periodic spline",
    Optional("[[\"0 deg\", \"0 mm\"], [\"120 deg\", \"20 mm\"], [\"240 deg\", \"5 mm\"]]"),
    PLACE,
    POSITION,
);
pub(super) const DEGREE: Field<f64> = Field::number(
    "degree",
    "degree of the spline through points: 5 (least jerk) or 3 (least acceleration, the jerk jumps)",
    Default("5"),
    within(3.0, 5.0),
);
pub(super) const TABLE: Field<Arc<Columns>> = Field::columns(
    "table",
    "instead of segments: a file with rows `angle, position`, in degrees from at and in the unit of start above start where its headings name no other units, joined by a periodic spline",
    Optional("lift.csv"),
)
.also(&["file", "csv", "data"]);
/// What happens where a turn has no rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RestOfTurn {
    /// The position is kept.
    Dwell,
}

/// How the curve goes from row to row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RowShape {
    /// With the least ∫(s''')², wherever that leads.
    Natural,
    /// Between the positions of two neighbours; of the curves with a continuous acceleration that do so, that of least ∫(s''')² with
    /// sufficient conditions. Where a continuous acceleration needs it, the curve slows down or stops at a row: then the size of the
    /// acceleration and the continuity of the jerk give way, neither the rows nor the continuity of the acceleration.
    Monotonic,
}

pub(super) const COLUMNS: Field<Vec<String>> = Field::texts(
    "columns",
    "for table: the columns of angle and position, by heading or by number from 1; one column with step",
    Optional("[1, 2]"),
);
pub(super) const UNIT: Field<String> = Field::text(
    "unit",
    "for table: the unit of its positions, or of its angles where it is an angle (\"rad\"), or both (\"rad, in\"); deg and the unit of start when absent",
    Optional("in"),
);
pub(super) const SCALE: Field<f64> = Field::number(
    "scale",
    "for table: a factor of its positions",
    Optional("1.5"),
    within(-LARGEST_NUMBER, LARGEST_NUMBER),
);
pub(super) const RATIO_OF_ANGLES: Field<f64> = Field::number(
    "ratio",
    "for table: turns of the shaft whose angles it has for each turn of the cam; 2 for crank degrees of a four-stroke engine",
    Optional("2"),
    above(0.0, LARGEST_NUMBER),
);
pub(super) const STEP: Field<f64> = Field::quantity(
    "step",
    "for table: angle from row to row of one column",
    Optional("1 deg"),
    Angle,
    above(0.0, TAU),
);
pub(super) const LIFT: Field<LengthOrAngle> = Field::length_or_angle(
    "lift",
    "for table: its positions are shares of this, from 0 to 1, or percent by their heading",
    Optional("8 mm"),
    POSITION.0,
    POSITION.1,
);
pub(super) const OVER_ROWS: Field<f64> = Field::quantity(
    "over",
    "for table: its angles are shares of this, from 0 to 1",
    Optional("360 deg"),
    Angle,
    above(0.0, TAU),
);
pub(super) const MIRROR: Field<bool> = Field::boolean(
    "mirror",
    "for table and points: they are one half of a lobe, which is mirrored at its highest end",
    Optional("true"),
);
pub(super) const REST: Field<RestOfTurn> = Field::words(
    "rest",
    "for table and points: \"dwell\" keeps the position where the turn has no rows; refused when absent",
    Optional("dwell"),
    &["dwell"],
    &[RestOfTurn::Dwell],
);
pub(super) const BETWEEN: Field<RowShape> = Field::words(
    "shape",
    "for table and points: \"natural\" (least jerk through the rows) or \"monotonic\" (never above or below two neighbours)",
    Optional("monotonic"),
    &["natural", "monotonic"],
    &[RowShape::Natural, RowShape::Monotonic],
);
pub(super) const SMOOTH: Field<String> = Field::text(
    "smooth",
    "for table and points: largest deviation from every row, for which the curve of least jerk is taken; \"auto\": half of the rounding seen in their digits",
    Optional("3 um"),
);

/// `[motion]`.
pub const SECTION: KeySection = KeySection {
    path: "motion",
    about: "a motion program, instead of a press: for `camgen make`",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[
        RPM.key,
        START.key,
        AT.key,
        REPEAT.key,
        STROKE.key,
        MEASURED_AT.key,
        OUTPUT_ARM.key,
        FORMULA.key,
        POINTS.key,
        DEGREE.key,
        TABLE.key,
        COLUMNS.key,
        UNIT.key,
        SCALE.key,
        RATIO_OF_ANGLES.key,
        STEP.key,
        LIFT.key,
        OVER_ROWS.key,
        MIRROR.key,
        REST.key,
        BETWEEN.key,
        SMOOTH.key,
    ],
};

pub(super) const LAW: Field<String> = Field::text(
    "law",
    "\"dwell\", \"polynomial\" (from the states at both ends), \"spline\", \"formula\", \"table\" or the name of a law (camgen laws lists them); cycloidal when absent",
    Optional(USUAL),
)
.also(&["type", "kind", "curve", "motion", "profile"]);
pub(super) const OVER: Field<LengthOrAngle> = Field::angle_or_length(
    "over",
    "cam angle of the segment, or its length along a plate; the last segment may omit it",
    Optional("90 deg"),
    above(0.0, TAU),
    above(0.0, LONGEST),
)
.also(&["angle", "duration", "width", "length", "range", "cam_angle"]);
pub(super) const UNTIL: Field<LengthOrAngle> = Field::angle_or_length(
    "until",
    "cam angle, or place along a plate, at which it ends, instead of over",
    Optional("210 deg"),
    PLACE.0,
    PLACE.1,
)
.also(&["end_angle", "to_angle"]);
pub(super) const TO: Field<LengthOrAngle> =
    Field::length_or_angle("to", "position at its end; not for a dwell", Optional("20 mm"), POSITION.0, POSITION.1)
        .also(&["lift", "stroke", "height", "travel", "rise", "position", "target", "end_position"]);
pub(super) const BY: Field<LengthOrAngle> =
    Field::length_or_angle("by", "change of the position, instead of to", Optional("20 mm"), POSITION.0, POSITION.1)
        .also(&["change", "delta"]);
pub(super) const BEGINS: Field<bool> = Field::words(
    "start",
    "for the laws \"polynomial\" and \"spline\": \"continued\", with velocity and acceleration of the segment before, also where that ends in a turn, or \"free\": the acceleration follows from the other conditions and may jump",
    Default("continued"),
    &["continued", "free"],
    &[false, true],
);
pub(super) const VELOCITY: Field<String> = Field::text_or_number(
    "velocity",
    "at its end, per angle, per second (needs rpm) or along a plate per length, or \"auto\": least jerk between polynomials and splines; for constant-velocity its velocity, instead of over or to",
    Optional("-0.3 mm/deg"),
);
pub(super) const ACCELERATION: Field<String> = Field::text_or_number(
    "acceleration",
    "at its end, 0 when absent, or \"auto\"; other values need polynomials",
    Optional("2 mm/rad2"),
);
pub(super) const JERK: Field<String> =
    Field::text_or_number("jerk", "at its end, for polynomials; free when absent", Optional("0 mm/rad3"));
pub(super) const END: Field<EndWord> = Field::words(
    "end",
    "state at its end: \"rest\", \"turn\" (velocity 0, free acceleration) or \"moving\"; moving when a velocity is given; at a turn parabola, parabola-line and sine-line hold or shed their acceleration as between rests, straight ramps and the modified trapezoid begin at full acceleration, and other laws of two halves fall as one cosine",
    Optional("turn"),
    &["rest", "turn", "moving"],
    &[EndWord::Rest, EndWord::Turn, EndWord::Moving],
);
pub(super) const INFLECTION: Field<String> = Field::text_or_number(
    "inflection",
    "where the acceleration changes sign: a share of the segment, \"smooth\", or \"match\" (the neighbour's acceleration at a turn); when absent, \"match\" at a turn before a formula or a table, where that is possible",
    Default("smooth"),
);
pub(super) const FRACTIONS: Field<Vec<f64>> = Field::numbers(
    "fractions",
    "for scca: shares of a half in which the acceleration rises, is constant, falls and is 0; their sum is 1",
    Optional("[0.25, 0.25, 0.25, 0.25]"),
    within(0.0, 1.0),
);
pub(super) const LINE: Field<f64> = Field::number(
    "line",
    "for parabola-line and sine-line: share of constant velocity",
    Optional("0.5"),
    within(0.0, 1.0),
);
pub(super) const AMPLITUDES: Field<Vec<f64>> = Field::numbers(
    "amplitudes",
    "for triple-harmonic: amplitudes of the three waves of the acceleration; only their ratios matter",
    Optional("[7, 0, -2.4]"),
    within(-LARGEST_NUMBER, LARGEST_NUMBER),
);
pub(super) const RAMP: Field<f64> = Field::number(
    "ramp",
    "for s-curve: share of a half in which the acceleration rises",
    Optional("0.25"),
    within(0.0, 0.5),
);

pub(super) const COSINES: Field<Vec<f64>> = Field::numbers(
    "cos",
    "amplitudes of cos th, cos 2 th, … in the unit of start; th is the cam angle from at, times repeat",
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
pub const FOURIER: KeySection = KeySection {
    path: "motion.fourier",
    about: "the position above start as a Fourier series, instead of segments",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[COSINES.key, SINES.key],
};

pub(super) const NATURAL_FREQUENCY: Field<f64> = Field::quantity(
    "natural_frequency",
    "natural frequency of the load on its elastic train",
    Required("40 Hz"),
    Frequency,
    above(0.0, LARGEST_NUMBER),
);
pub(super) const DAMPING: Field<f64> = Field::number(
    "damping",
    "damping ratio of the load against the frame: share of the critical damping",
    Default("0"),
    within(0.0, 1.0),
);
pub(super) const OWN_RPM: Field<f64> = Field::number(
    "rpm",
    "speed for which the cam is made, motion.rpm when absent",
    Optional("120"),
    within(LEAST_RPM, LARGEST_NUMBER),
)
.hint(TURNS_FORWARD);

/// `[motion.polydyne]`.
pub const POLYDYNE: KeySection = KeySection {
    path: "motion.polydyne",
    about: "the motion is that of an elastic load; the cam is made so that the load follows it",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[NATURAL_FREQUENCY.key, DAMPING.key, OWN_RPM.key],
};

pub(super) const SHAPE: Field<String> = Field::text(
    "formula",
    "for the law \"formula\": share of the travel as a function of x, the share of the angle or length, both from 0 to 1",
    Optional("x^3*(10-15*x+6*x^2)"),
);
pub(super) const INNER: Field<PointList> = Field::points(
    "points",
    "for the law \"spline\": cam angles, or places along a plate, and positions between its ends",
    Optional("[[\"30 deg\", \"4 mm\"], [\"60 deg\", \"15 mm\"]]"),
    PLACE,
    POSITION,
);
pub(super) const SHARES: Field<Arc<Columns>> = Field::columns(
    "table",
    "for the law \"table\": a file with rows of two shares, of the angle or length and of the travel, each from 0 to 1",
    Optional("law.csv"),
);
pub(super) const ENDS: Field<spline::SplineEnds> = Field::words(
    "ends",
    "for the law \"table\": \"free\" (polynomials up to degree 5 are reproduced exactly) or \"rest\"",
    Default("free"),
    &["free", "rest"],
    &[spline::SplineEnds::Free, spline::SplineEnds::Rest],
);
pub(super) const BETWEEN_ROWS: Field<RowShape> = Field::words(
    "shape",
    "for the laws \"spline\" and \"table\": \"natural\" (least jerk through the rows) or \"monotonic\" (never above or below two neighbours)",
    Optional("monotonic"),
    &["natural", "monotonic"],
    &[RowShape::Natural, RowShape::Monotonic],
);
pub(super) const SMOOTH_ROWS: Field<String> = Field::text(
    "smooth",
    "for the laws \"spline\" and \"table\": largest deviation of the position from every row between the ends, for which the curve of least jerk is taken; \"auto\": half of the rounding seen in their digits",
    Optional("3 um"),
);
pub(super) const MINIMISE: Field<ObjectiveWord> = Field::words(
    "minimise",
    "for the law \"polynomial\" from rest to rest: what to minimise; residual is the peak acceleration without vibration after the segment",
    Optional("peak-acceleration"),
    &["peak-acceleration", "peak-jerk", "rms-acceleration", "residual"],
    &[
        ObjectiveWord::PeakAcceleration,
        ObjectiveWord::PeakJerk,
        ObjectiveWord::RmsAcceleration,
        ObjectiveWord::Residual,
    ],
);
pub(super) const OF_OPTIMUM: Field<f64> = Field::number(
    "degree",
    "degree of a polynomial with minimise, 7 to 15; an even degree is no better than the odd one below it",
    Optional("9"),
    within(7.0, 15.0),
);
pub(super) const RATIO: Field<f64> = Field::number(
    "ratio",
    "for minimise = \"residual\": duration of the segment in natural periods of the load",
    Optional("2.5"),
    within(0.1, 100.0),
);
pub(super) const ROBUST: Field<bool> = Field::boolean(
    "robust",
    "for minimise = \"residual\": little vibration near the ratio too; needs degree 9 or more",
    Default("false"),
);

/// `[[motion.segment]]`.
pub const SEGMENT: KeySection = KeySection {
    path: "motion.segment",
    about: "a segment of the program; velocity, acceleration and jerk are those at its end",
    occurs: Occurrence::Repeated,
    cams: &[MAKE],
    keys: &[
        LAW.key,
        OVER.key,
        UNTIL.key,
        TO.key,
        BY.key,
        BEGINS.key,
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
        BETWEEN_ROWS.key,
        SMOOTH_ROWS.key,
        MINIMISE.key,
        OF_OPTIMUM.key,
        RATIO.key,
        ROBUST.key,
    ],
};

/// The word for where positions of a swinging follower are measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum MeasuredAt {
    Pivot,
    Roller,
    Output,
}

/// The word for the state at the end of a segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum EndWord {
    Rest,
    Turn,
    Moving,
}

/// The word for what a polynomial minimises.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ObjectiveWord {
    PeakAcceleration,
    PeakJerk,
    RmsAcceleration,
    Residual,
}

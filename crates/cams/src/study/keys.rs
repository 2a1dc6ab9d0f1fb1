//! The keys of a study file.

use super::kind::{Goal, StudyKind};
use super::parameter::Scale;
use super::sampling::Sampling;
use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::{Field, KeySection, Occurrence, above, within};
use camgen_kernel::units::Dimension;

/// Most rows of a study: their numbers are exact as `f64`.
pub(super) const MOST_ROWS: f64 = 9e15;
/// Largest number in a constraint.
const LARGEST: f64 = 1e300;

pub(super) const NAME: Field<String> = Field::text("name", "what the page calls the study", Required("my study"));
pub(super) const BASE: Field<String> = Field::text(
    "base",
    "machine file of which every design is made: an embedded name, or a path from the folder of the study",
    Required("feeder"),
);
pub(super) const KIND: Field<StudyKind> = Field::words(
    "kind",
    "what is studied: every combination of values, random designs, or the designs that no other beats",
    Required("sweep"),
    &["sweep", "monte-carlo", "pareto"],
    &[StudyKind::Sweep, StudyKind::MonteCarlo, StudyKind::Pareto],
);
pub(super) const COMMAND: Field<String> = Field::text(
    "command",
    "command that makes the cam of a design; without it make where the base has a motion, else rotary",
    Optional("make"),
);
pub(super) const RPM: Field<f64> = Field::number(
    "rpm",
    "speed, as --rpm of the command; without it that of the base",
    Optional("120"),
    above(0.0, 1e5),
);
pub(super) const TOLERANCE: Field<f64> = Field::quantity(
    "tolerance",
    "tolerance of the outlines, where a column needs them",
    Default("5 um"),
    Dimension::Length,
    above(0.0, 1e-3),
);
pub(super) const SET: Field<Vec<String>> =
    Field::texts("set", "keys of the base that all designs have, as --set", Optional("[\"cam.thickness=20mm\"]"));
pub(super) const ROWS: Field<f64> =
    Field::number("rows", "number of random designs", Optional("1000"), within(1.0, MOST_ROWS));
pub(super) const SAMPLING: Field<Sampling> = Field::words(
    "sampling",
    "how random designs are spread",
    Default("latin-hypercube"),
    &["latin-hypercube", "random"],
    &[Sampling::LatinHypercube, Sampling::Random],
)
.also(&["sobol"]);
pub(super) const SEED: Field<f64> =
    Field::number("seed", "start of the random numbers, a whole number", Default("1"), within(0.0, MOST_ROWS));
pub(super) const COLUMNS: Field<Vec<String>> = Field::texts(
    "columns",
    "figures of the JSON report, by their paths",
    Required("[\"cam.base_radius_mm\", \"checks.pressure_angle.value\"]"),
);

/// The keys before the first table.
pub(super) const ROOT: KeySection = KeySection {
    path: "",
    about: "",
    occurs: Occurrence::Once,
    cams: &[],
    keys: &[
        NAME.key,
        BASE.key,
        KIND.key,
        COMMAND.key,
        RPM.key,
        TOLERANCE.key,
        SET.key,
        ROWS.key,
        SAMPLING.key,
        SEED.key,
        COLUMNS.key,
    ],
};

pub(super) const KEY: Field<String> = Field::text(
    "key",
    "key of the base that varies, by its dotted path; rpm is the speed as --rpm",
    Required("follower.roller.radius"),
);
pub(super) const VALUES: Field<Vec<String>> =
    Field::texts("values", "the values themselves", Optional("[\"12 mm\", \"14 mm\", \"16 mm\"]"));
pub(super) const FROM: Field<String> =
    Field::text_or_number("from", "first value, or the least of a distribution", Optional("10 mm"));
pub(super) const TO: Field<String> =
    Field::text_or_number("to", "last value, or the largest of a distribution", Optional("20 mm"));
pub(super) const STEPS: Field<f64> =
    Field::number("steps", "number of values from the first to the last", Optional("11"), within(2.0, MOST_ROWS));
pub(super) const SCALE: Field<Scale> = Field::words(
    "scale",
    "equal steps, or equal ratios",
    Optional("linear"),
    &["linear", "log"],
    &[Scale::Linear, Scale::Log],
);
pub(super) const MEAN: Field<String> =
    Field::text_or_number("mean", "mean of a normal distribution", Optional("15 mm"));
pub(super) const DEVIATION: Field<String> = Field::text_or_number(
    "deviation",
    "standard deviation of a normal distribution, cut off at from and to where these are given",
    Optional("0.01 mm"),
);

pub(super) const PARAMETER: KeySection = KeySection {
    path: "parameter",
    about: "a key that varies",
    occurs: Occurrence::Repeated,
    cams: &[],
    keys: &[KEY.key, VALUES.key, FROM.key, TO.key, STEPS.key, SCALE.key, MEAN.key, DEVIATION.key],
};

pub(super) const COLUMN: Field<String> =
    Field::text("column", "figure of the JSON report, by its path", Required("checks.pressure_angle.value"));
pub(super) const AT_LEAST: Field<f64> =
    Field::number("at_least", "least value, in the unit of the column", Optional("0"), within(-LARGEST, LARGEST));
pub(super) const AT_MOST: Field<f64> =
    Field::number("at_most", "largest value, in the unit of the column", Optional("30"), within(-LARGEST, LARGEST));

pub(super) const CONSTRAINT: KeySection = KeySection {
    path: "constraint",
    about: "a limit that a design must keep",
    occurs: Occurrence::Repeated,
    cams: &[],
    keys: &[COLUMN.key, AT_LEAST.key, AT_MOST.key],
};

pub(super) const GOAL: Field<Goal> = Field::words(
    "goal",
    "which values are better",
    Default("least"),
    &["least", "largest"],
    &[Goal::Least, Goal::Largest],
);

pub(super) const OBJECTIVE: KeySection = KeySection {
    path: "objective",
    about: "a figure by which designs are compared",
    occurs: Occurrence::Repeated,
    cams: &[],
    keys: &[COLUMN.key, GOAL.key],
};

/// The tables of a study file.
pub const SECTIONS: &[&KeySection] = &[&ROOT, &PARAMETER, &CONSTRAINT, &OBJECTIVE];

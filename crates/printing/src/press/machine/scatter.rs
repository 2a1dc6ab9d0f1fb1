//! How far presses differ from the one a cam is cut for: half widths of the parameters, and how they are drawn.

use crate::press::cams::{CONOID, ROTARY, SCATTER, TRANSLATING};
use crate::press::scatter::monte_carlo::{CUSTOMARY, Distribution, Sampling};
use crate::press::scatter::reset::ScrewRule;
use camgen_kernel::document::Presence::Default;
use camgen_kernel::document::{Bounds, Field, KeySection, Occurrence, Reader, TableReader, within};
use camgen_kernel::units::Dimension::{Angle, Length};
use std::f64::consts::PI;

/// Largest half width of a share: a value may not vanish.
const SHARE: Bounds = within(0.0, 0.5);
/// Largest half width of the air lost.
const LOST: Bounds = within(0.0, 0.45);
/// Longest half width of a length, m.
const LENGTH: Bounds = within(0.0, 1.0);
/// Most draws.
const MOST_SAMPLES: f64 = 1e6;
/// Largest seed that a number of a file keeps all digits of.
const LARGEST_SEED: f64 = 9_007_199_254_740_992.0;

const EXPONENT: Field<f64> = Field::number(
    "polytropic_exponent",
    "half width of the polytropic exponent, a bare number",
    Default("0.05"),
    within(0.0, 1.0),
);
const AMBIENT: Field<f64> =
    Field::share("ambient_pressure", "half width of the ambient pressure: weather and height", Default("3 %"), SHARE);
const MASS: Field<f64> = Field::share("mass", "half width of the moving mass: the forme", Default("5 %"), SHARE);
const SPEED: Field<f64> = Field::share("speed", "half width of the speed of the main shaft", Default("1 %"), SHARE);
const COLUMN: Field<f64> =
    Field::quantity("column", "half width of the air column as it is built", Default("1 mm"), Length, LENGTH);
const LEAD: Field<f64> =
    Field::quantity("lead", "half width of the place at which the port shuts", Default("0.2 mm"), Length, LENGTH);
const AIR_LOST: Field<f64> =
    Field::share("air_lost", "most of the air that is lost, a share of its mass", Default("1 %"), LOST);
const CLOSING: Field<f64> = Field::share(
    "closing_pressure",
    "half width of the pressure at which the port closes, over the ambient pressure",
    Default("1 %"),
    SHARE,
);
const PHASE: Field<f64> = Field::quantity(
    "phase",
    "half width of the angle of the cam on its shaft, in crank angle, at most 5 deg",
    Default("0.1 deg"),
    Angle,
    within(0.0, 5.0 * PI / 180.0 * (1.0 + 1e-12)),
);
const SCREW: Field<f64> =
    Field::quantity("screw", "half width of the error with which the screw is set", Default("0.1 mm"), Length, LENGTH);
const DISTRIBUTION: Field<Distribution> = Field::words(
    "distribution",
    "distribution of every parameter over its band: \"uniform\", \"triangular\" or \"normal\" (the half width is two standard deviations)",
    Default("uniform"),
    &["uniform", "triangular", "normal"],
    &[Distribution::Uniform, Distribution::Triangular, Distribution::Normal],
);
const SAMPLES: Field<f64> = Field::number(
    "samples",
    "presses that are drawn, a whole number up to 1000000; 0 draws none",
    Default("20000"),
    within(0.0, MOST_SAMPLES),
);
const SEED: Field<f64> = Field::number(
    "seed",
    "seed of the draws, a whole number: the same seed draws the same presses",
    Default("1"),
    within(0.0, LARGEST_SEED),
);
const RESET: Field<ScrewRule> = Field::words(
    "reset",
    "setting of the screw in each press: \"end\" (no residual force at the end of the stroke), \"level\" (the least largest one) or \"none\"",
    Default("end"),
    &["none", "end", "level"],
    &[ScrewRule::None, ScrewRule::End, ScrewRule::Level],
);

/// `[scatter]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "scatter",
    about: "how far presses differ from the one the cam is cut for: half widths",
    occurs: Occurrence::Optional,
    cams: &[ROTARY, TRANSLATING, CONOID, SCATTER],
    keys: &[
        EXPONENT.key,
        AMBIENT.key,
        MASS.key,
        SPEED.key,
        COLUMN.key,
        LEAD.key,
        AIR_LOST.key,
        CLOSING.key,
        PHASE.key,
        SCREW.key,
        DISTRIBUTION.key,
        SAMPLES.key,
        SEED.key,
        RESET.key,
    ],
};

/// A whole number of a key.
fn whole(table: &TableReader<'_>, field: &Field<f64>) -> Option<u64> {
    let value = table.get(field)?;
    if value.fract() != 0.0 {
        let typed = table.typed(field);
        table.fail(field, format!("`scatter.{}` must be a whole number: {typed}", field.key.name), None);
        return None;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number within its bounds")]
    Some(value as u64)
}

pub(super) fn read(reader: &Reader<'_>) -> Option<Sampling> {
    let Some(table) = reader.find(&SECTION) else { return Some(CUSTOMARY) };
    let (samples, seed) = (whole(&table, &SAMPLES), whole(&table, &SEED));
    let fields = [&EXPONENT, &AMBIENT, &MASS, &SPEED, &COLUMN, &LEAD, &AIR_LOST, &CLOSING, &PHASE, &SCREW];
    let mut half_widths = [0.0; 10];
    for (half_width, field) in half_widths.iter_mut().zip(fields) {
        *half_width = table.get(field)?;
    }
    Some(Sampling {
        half_widths,
        distribution: table.get(&DISTRIBUTION)?,
        samples: u32::try_from(samples?).ok()?,
        seed: seed?,
        rule: table.get(&RESET)?,
    })
}

//! What the analyses of a press look at by default.

use crate::document::Presence::{Default, Optional};
use crate::document::range::{LARGEST_NUMBER, LEAST_RPM, STIFFEST};
use crate::document::{Field, KeySection, Occurrence, Reader, above, within};
use crate::domains::press::buffer::regime::Reset;
use crate::domains::press::cams::{REGIMES, SPRING};
use crate::units::Dimension::Stiffness;

/// Other speeds of a press.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RegimesData {
    /// Speeds of the main shaft, rpm.
    pub speeds: Vec<f64>,
    /// The condition that the reset of the column keeps.
    pub reset: Option<Reset>,
}

const SPEEDS: Field<Vec<f64>> = Field::numbers(
    "rpm",
    "speeds of the main shaft at which the press runs with one cam",
    Optional("[20, 25, 30, 35]"),
    within(LEAST_RPM, LARGEST_NUMBER),
);
const RESET: Field<Reset> = Field::words(
    "reset",
    "condition of the reset of the column: \"end\" (no residual force at the end of the stroke), \"half\" or \"level\"",
    Default("end"),
    &["end", "half", "level"],
    &[Reset::End, Reset::Half, Reset::Level],
);

/// `[regimes]`.
pub(super) const REGIMES_SECTION: KeySection = KeySection {
    path: "regimes",
    about: "one cam of a press at other speeds",
    occurs: Occurrence::Optional,
    cams: &[REGIMES],
    keys: &[SPEEDS.key, RESET.key],
};

const STIFFNESS: Field<f64> = Field::quantity(
    "stiffness",
    "stiffness of each of the two springs under the bottoms",
    Optional("82.5 kgf/cm"),
    Stiffness,
    above(0.0, STIFFEST),
);

/// `[spring_buffer]`.
pub(super) const SPRING_SECTION: KeySection = KeySection {
    path: "spring_buffer",
    about: "buffers whose bottoms rest on springs instead of a cam",
    occurs: Occurrence::Optional,
    cams: &[SPRING],
    keys: &[STIFFNESS.key],
};

pub(super) fn read(reader: &Reader<'_>) -> (RegimesData, Option<f64>) {
    let regimes = reader.table(&REGIMES_SECTION);
    let data = RegimesData { speeds: regimes.get(&SPEEDS).unwrap_or_default(), reset: regimes.get(&RESET) };
    (data, reader.table(&SPRING_SECTION).get(&STIFFNESS))
}

//! The limits of a brake.

use crate::brake::{BRAKE, BRAKE_CAM};
use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::range::HIGHEST_STRESS;
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, above, within};
use camgen_kernel::units::Dimension::Pressure;

/// The limits of a brake.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrakeLimits {
    /// Largest change of the tension over the roll, divided by the largest tension.
    pub tension_spread: f64,
    /// Largest stress in the web, Pa.
    pub web_stress: Option<f64>,
}

const TENSION_SPREAD: Field<f64> = Field::number(
    "tension_spread",
    "largest change of the web tension over the roll, as a share of the largest tension",
    Default("0.05"),
    within(0.0, 1.0),
)
.only(&[BRAKE, BRAKE_CAM]);
const WEB_STRESS: Field<f64> = Field::quantity(
    "web_stress",
    "largest stress in the web; only reported when absent",
    Optional("10 MPa"),
    Pressure,
    above(0.0, HIGHEST_STRESS),
)
.only(&[BRAKE]);

/// The keys of a brake in `[limits]`.
pub(in crate::brake) const SECTION: KeySection = KeySection {
    path: "limits",
    about: "",
    occurs: Occurrence::Once,
    cams: &[],
    keys: &[TENSION_SPREAD.key, WEB_STRESS.key],
};

/// Reads the limits of a brake.
pub(in crate::brake) fn read(reader: &Reader<'_>) -> Option<BrakeLimits> {
    let table = reader.table(&SECTION);
    Some(BrakeLimits { tension_spread: table.get(&TENSION_SPREAD)?, web_stress: table.get(&WEB_STRESS) })
}

//! What a shaft must keep.

use crate::shaft::SHAFT;
use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::range::{LARGEST_NUMBER, LONGEST};
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, above};
use camgen_kernel::units::Dimension::{Angle, Length};
use std::f64::consts::FRAC_PI_2;

/// Limits of a shaft.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShaftLimits {
    /// Largest speed over the first critical one.
    pub critical_speed_ratio: f64,
    /// Largest lift error under load, m.
    pub lift_error: Option<f64>,
    /// Largest slope at a support, rad.
    pub support_slope: Option<f64>,
    /// Grade of balance, mm/s.
    pub balance_grade: Option<f64>,
}

const CRITICAL_SPEED_RATIO: Field<f64> = Field::number(
    "critical_speed_ratio",
    "largest speed of the shaft over its first critical speed",
    Default("0.7"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[SHAFT]);
const LIFT_ERROR: Field<f64> = Field::quantity(
    "lift_error",
    "how far the follower may be low while shaft and supports deflect; only reported when absent",
    Optional("0.1 mm"),
    Length,
    above(0.0, LONGEST),
)
.only(&[SHAFT]);
const SUPPORT_SLOPE: Field<f64> = Field::quantity(
    "support_slope",
    "largest slope of the shaft at a support; only reported when absent",
    Optional("0.001 rad"),
    Angle,
    above(0.0, FRAC_PI_2),
)
.only(&[SHAFT]);
const BALANCE_GRADE: Field<f64> = Field::number(
    "balance_grade",
    "grade of balance G of ISO 21940-11, mm/s: 0.4, 1, 2.5, 6.3, 16, 40, 100, 250, 630, 1600 or 4000; only reported when absent",
    Optional("16"),
    above(0.0, LARGEST_NUMBER),
)
.only(&[SHAFT]);

/// The keys that are added to `[limits]`.
pub(in crate::shaft) const SECTION: KeySection = KeySection {
    path: "limits",
    about: "",
    occurs: Occurrence::Once,
    cams: &[],
    keys: &[CRITICAL_SPEED_RATIO.key, LIFT_ERROR.key, SUPPORT_SLOPE.key, BALANCE_GRADE.key],
};

/// Reads the limits of a shaft.
pub(in crate::shaft) fn read(reader: &Reader<'_>) -> Option<ShaftLimits> {
    let table = reader.table(&SECTION);
    Some(ShaftLimits {
        critical_speed_ratio: table.get(&CRITICAL_SPEED_RATIO)?,
        lift_error: table.get(&LIFT_ERROR),
        support_slope: table.get(&SUPPORT_SLOPE),
        balance_grade: table.get(&BALANCE_GRADE),
    })
}

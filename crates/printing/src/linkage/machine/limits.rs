//! What a linkage must keep.

use crate::linkage::LINKAGE;
use camgen_kernel::document::Presence::Default;
use camgen_kernel::document::range::LARGEST_NUMBER;
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, above, within};
use camgen_kernel::units::Dimension::Angle;
use std::f64::consts::FRAC_PI_2;

/// The limits of a linkage.
#[derive(Debug, Clone, Copy, PartialEq, std::default::Default)]
pub struct LinkageLimits {
    /// Least transmission angle of the drag link, rad.
    pub transmission_angle: f64,
    /// Largest angle of the connecting rod from the line of the slider, rad.
    pub rod_angle: f64,
    /// Least coupler and follower over the driving crank.
    pub link_ratio: f64,
}

const TRANSMISSION_ANGLE: Field<f64> = Field::quantity(
    "transmission_angle",
    "least angle between coupler and driven crank of the drag link",
    Default("45 deg"),
    Angle,
    within(0.0, FRAC_PI_2),
)
.only(&[LINKAGE]);
const ROD_ANGLE: Field<f64> = Field::quantity(
    "rod_angle",
    "largest angle of the connecting rod from the line of the slider",
    Default("30 deg"),
    Angle,
    above(0.0, FRAC_PI_2),
)
.only(&[LINKAGE]);
const LINK_RATIO: Field<f64> = Field::number(
    "link_ratio",
    "least coupler and driven crank over the driving crank",
    Default("0.5"),
    within(0.0, LARGEST_NUMBER),
)
.only(&[LINKAGE]);

/// The keys that are added to `[limits]`.
pub(in crate::linkage) const SECTION: KeySection = KeySection {
    path: "limits",
    about: "",
    occurs: Occurrence::Once,
    cams: &[],
    keys: &[TRANSMISSION_ANGLE.key, ROD_ANGLE.key, LINK_RATIO.key],
};

pub(super) fn read(reader: &Reader<'_>) -> Option<LinkageLimits> {
    let table = reader.table(&SECTION);
    Some(LinkageLimits {
        transmission_angle: table.get(&TRANSMISSION_ANGLE)?,
        rod_angle: table.get(&ROD_ANGLE)?,
        link_ratio: table.get(&LINK_RATIO)?,
    })
}

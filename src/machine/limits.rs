//! The limits of a cam.

use crate::document::Presence::{Default, Optional};
use crate::document::range::{LARGEST_NUMBER, LONGEST};
use crate::document::{Field, Occurs, Reader, Section, above, within};
use crate::units::Dimension::{Angle, Length, Pressure};
use std::f64::consts::FRAC_PI_2;

/// Highest limit of contact pressure that is accepted, Pa: a hundred times what steel withstands.
const HIGHEST_STRESS: f64 = 1e12;

/// The limits of a cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest |pressure angle|, rad.
    pub pressure_angle: f64,
    /// Smallest convex radius of the pitch curve over the roller radius.
    pub min_convex_pitch_radius_over_roller: f64,
    /// Radius of the tool that must get into the concave parts, m.
    pub cutter_radius: Option<f64>,
    /// Least metal between bore and profile, m.
    pub wall: f64,
    /// Largest pressure in the contact of roller and cam, Pa.
    pub contact_stress: Option<f64>,
}

const PRESSURE_ANGLE: Field<f64> = Field::quantity(
    "pressure_angle",
    "largest angle between the roller's path and the normal, at most 90 deg",
    Default("30 deg"),
    Angle,
    above(0.0, FRAC_PI_2),
);
const MIN_CONVEX: Field<f64> = Field::number(
    "min_convex_pitch_radius_over_roller",
    "smallest convex radius of the pitch curve over the roller radius",
    Default("2.0"),
    within(0.0, LARGEST_NUMBER),
);
const CUTTER_RADIUS: Field<f64> = Field::quantity(
    "cutter_radius",
    "radius of the tool the shop cuts with; concave parts must let it in",
    Optional("10 mm"),
    Length,
    above(0.0, LONGEST),
);
const WALL: Field<f64> = Field::quantity(
    "wall",
    "least metal between bore and profile, or between the flanks of a plate",
    Default("0 mm"),
    Length,
    within(0.0, LONGEST),
);
const CONTACT_STRESS: Field<f64> = Field::quantity(
    "contact_stress",
    "largest pressure between roller and cam (Hertz)",
    Optional("1200 MPa"),
    Pressure,
    above(0.0, HIGHEST_STRESS),
);

/// `[limits]`.
pub(super) const SECTION: Section = Section {
    path: "limits",
    about: "what a cam must keep",
    occurs: Occurs::Once,
    cams: &[],
    keys: &[PRESSURE_ANGLE.key, MIN_CONVEX.key, CUTTER_RADIUS.key, WALL.key, CONTACT_STRESS.key],
};

pub(super) fn read(reader: &Reader<'_>) -> Option<Limits> {
    let table = reader.table(&SECTION);
    Some(Limits {
        pressure_angle: table.get(&PRESSURE_ANGLE)?,
        min_convex_pitch_radius_over_roller: table.get(&MIN_CONVEX)?,
        cutter_radius: table.get(&CUTTER_RADIUS),
        wall: table.get(&WALL)?,
        contact_stress: table.get(&CONTACT_STRESS),
    })
}

//! The follower: a translating roller.

use super::{CONOID, HEAVIEST, LARGEST_FORCE, LONGEST, ROTARY};
use crate::document::Presence::{Default, Optional, Required};
use crate::document::{Field, Occurs, Reader, Section, above, within};
use crate::units::Dimension::{Force, Length, Mass};

/// Shape of a roller's rim along its axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Crown {
    /// A sphere of the roller's radius.
    Sphere,
    /// Straight.
    Cylinder,
}

/// The translating roller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollerData {
    /// Radius, m.
    pub radius: f64,
    /// Offset of its path from the shaft, m.
    pub offset: f64,
    /// Mass that moves with it along its path, kg.
    pub mass: Option<f64>,
    /// Force that presses it onto the cam beside the air, N.
    pub preload: Option<f64>,
    /// Shape of its rim on a conoid.
    pub crown: Crown,
    /// Width of a cylindrical rim, m.
    pub width: Option<f64>,
}

/// Radius of the roller, which is also that of a plate's roller unless it has its own.
pub(super) const RADIUS: Field<f64> =
    Field::quantity("radius", "radius of the roller", Required("30 mm"), Length, above(0.0, LONGEST));
/// Offset of its path from the shaft, which the disc must reach.
pub(super) const OFFSET: Field<f64> = Field::quantity(
    "offset",
    "distance of its path from the shaft, positive against the rotation of the cam",
    Default("0 mm"),
    Length,
    within(-LONGEST, LONGEST),
)
.only(&[ROTARY, CONOID]);
const MASS: Field<f64> = Field::quantity(
    "mass",
    "of all that moves with the roller along its path; asks for the check force_closure",
    Optional("40 kg"),
    Mass,
    above(0.0, HEAVIEST),
);
const PRELOAD: Field<f64> = Field::quantity(
    "preload",
    "spring or weight that presses the roller onto the cam beside the air",
    Optional("1600 N"),
    Force,
    within(0.0, LARGEST_FORCE),
);
const CROWN: Field<Crown> = Field::words(
    "crown",
    "shape of its rim: \"sphere\", or \"cylinder\", which needs a width and is checked for edge contact",
    Default("sphere"),
    &["sphere", "cylinder"],
    &[Crown::Sphere, Crown::Cylinder],
)
.only(&[CONOID]);
const WIDTH: Field<f64> =
    Field::quantity("width", "width of a cylindrical rim", Optional("20 mm"), Length, above(0.0, LONGEST))
        .only(&[CONOID]);

/// `[follower.roller]`.
pub(super) const SECTION: Section = Section {
    path: "follower.roller",
    about: "the follower: a translating roller",
    occurs: Occurs::Once,
    cams: &[],
    keys: &[RADIUS.key, OFFSET.key, MASS.key, PRELOAD.key, CROWN.key, WIDTH.key],
};

pub(super) fn read(reader: &Reader<'_>) -> Option<RollerData> {
    let table = reader.table(&SECTION);
    let crown = table.get(&CROWN);
    if crown == Some(Crown::Cylinder) && !table.has(&WIDTH) {
        let help = Some("add follower.roller.width".into());
        table.fail(&CROWN, "a cylindrical roller needs a width".into(), help);
    }
    Some(RollerData {
        radius: table.get(&RADIUS)?,
        offset: table.get(&OFFSET)?,
        mass: table.get(&MASS),
        preload: table.get(&PRELOAD),
        crown: crown?,
        width: table.get(&WIDTH),
    })
}

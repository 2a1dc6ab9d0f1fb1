//! The linear cam of a press: a plate that rides on the bed.

use crate::press::cams::TRANSLATING;
use crate::press::motion::equation_18::{EfficiencyModel, ExactOn};
use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::range::LONGEST;
use camgen_kernel::document::{Bounds, Field, Key, KeySection, Occurrence, Reader, above, within};
use camgen_kernel::units::Dimension::{Angle, Length};
use std::f64::consts::{FRAC_PI_2, PI};

/// The cam plate on the bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TranslatingData {
    /// Arm of the roller l1, m.
    pub roller_arm: f64,
    /// Arm of the bottom l2, m.
    pub bottom_arm: f64,
    /// Angle Δ between the roller's velocity and the line of the bed at ψ = 0, rad.
    pub delta: f64,
    /// Friction angle ρ, rad.
    pub friction_angle: f64,
    /// Efficiency η.
    pub efficiency: f64,
    /// Model of the efficiency.
    pub efficiency_model: EfficiencyModel,
    /// Where the forces balance, unless a flag says so.
    pub balance: Option<ExactOn>,
    /// Radius of the roller, m.
    pub roller_radius: f64,
    /// Height of the plate over both flanks where it is highest, m; chosen automatically when not given.
    pub plate_height: Option<f64>,
}

const LENGTH: Bounds = above(0.0, LONGEST);
/// A shorter arm has no room for its own pivot, m.
const SHORTEST_ARM: f64 = 1e-3;
const ARM: Bounds = within(SHORTEST_ARM, LONGEST);

const ROLLER_ARM: Field<f64> =
    Field::quantity("roller_arm", "arm l1 from the pivot to the roller", Required("300 mm"), Length, ARM);
const BOTTOM_ARM: Field<f64> =
    Field::quantity("bottom_arm", "arm l2 from the pivot to the cylinder's bottom", Required("300 mm"), Length, ARM);
const DELTA: Field<f64> = Field::quantity(
    "delta",
    "angle between the roller's velocity and the line of the bed, at most 180 deg",
    Required("90 deg"),
    Angle,
    above(0.0, PI),
);
const FRICTION_ANGLE: Field<f64> = Field::quantity(
    "friction_angle",
    "friction angle, 0 deg to 90 deg",
    Default("0 deg"),
    Angle,
    within(0.0, FRAC_PI_2),
);
const EFFICIENCY: Field<f64> =
    Field::number("efficiency", "efficiency of the bell crank, above 0, at most 1", Default("1"), above(0.0, 1.0));
const MODEL: Field<EfficiencyModel> = Field::words(
    "efficiency_model",
    "\"consistent\" or \"printed\" (as in the paper)",
    Default("consistent"),
    &["consistent", "printed"],
    &[EfficiencyModel::Consistent, EfficiencyModel::Printed],
);
const BALANCE: Field<ExactOn> = Field::words(
    "balance",
    "where the forces balance: \"braking\" or \"return\", exact in that direction of the bed, or \"level\" (also \"mean\"), half of the friction left in each; --balance replaces it",
    Optional("level"),
    &["braking", "return", "level", "mean"],
    &[ExactOn::Braking, ExactOn::Return, ExactOn::Mean, ExactOn::Mean],
);
const ROLLER_RADIUS: Field<f64> = Field::quantity(
    "roller_radius",
    "radius of its roller; follower.roller.radius when absent",
    Optional("30 mm"),
    Length,
    LENGTH,
);
const ROLLER_DIAMETER: Key =
    ROLLER_RADIUS.diameter("roller_diameter", "diameter of its roller, in the place of its radius", "60 mm");
const PLATE_HEIGHT: Field<f64> = Field::quantity(
    "plate_height",
    "height over both flanks where it is largest; chosen automatically when absent",
    Optional("120 mm"),
    Length,
    LENGTH,
);

/// `[translating]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "translating",
    about: "the linear cam of a press, a plate that rides on the bed",
    occurs: Occurrence::Optional,
    cams: &[TRANSLATING],
    keys: &[
        ROLLER_ARM.key,
        BOTTOM_ARM.key,
        DELTA.key,
        FRICTION_ANGLE.key,
        EFFICIENCY.key,
        MODEL.key,
        BALANCE.key,
        ROLLER_RADIUS.key,
        ROLLER_DIAMETER,
        PLATE_HEIGHT.key,
    ],
};

/// Reads the plate; its roller has the radius of the follower's roller unless the table gives one.
pub(super) fn read(reader: &Reader<'_>, roller_radius: Option<f64>) -> Option<TranslatingData> {
    let table = reader.find(&SECTION)?;
    let roller_radius = table.get(&ROLLER_RADIUS).or(roller_radius);
    if roller_radius.is_none() && !table.has(&ROLLER_RADIUS) {
        let message = "the plate needs a roller: neither this table nor [follower.roller] gives its radius";
        table.fail(&ROLLER_RADIUS, message.into(), Some("add translating.roller_radius or roller_diameter".into()));
    }
    Some(TranslatingData {
        roller_arm: table.get(&ROLLER_ARM)?,
        bottom_arm: table.get(&BOTTOM_ARM)?,
        delta: table.get(&DELTA)?,
        friction_angle: table.get(&FRICTION_ANGLE)?,
        efficiency: table.get(&EFFICIENCY)?,
        efficiency_model: table.get(&MODEL)?,
        balance: table.get(&BALANCE),
        roller_radius: roller_radius?,
        plate_height: table.get(&PLATE_HEIGHT),
    })
}

//! The compensating cam: a second disc on the camshaft whose spring takes the torque of the first.

use crate::press::cams::ROTARY;
use camgen_cams::machine::{CamData, FollowerData, Keyway, Machine};
use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::range::{HEAVIEST, LARGEST_FORCE, LARGEST_NUMBER, LEAST_RPM, LONGEST, STIFFEST};
use camgen_kernel::document::{Field, Key, KeySection, Occurrence, Reader, above, within};
use camgen_kernel::follower::{Crown, RollerData, TranslatingRoller};
use camgen_kernel::units::Dimension::{Angle, Force, Length, Mass, Stiffness};
use std::f64::consts::PI;
use std::sync::Arc;

/// `[compensator]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompensatorData {
    /// Rate of the spring, N/m.
    pub spring_rate: f64,
    /// Force of the spring at the lowest lift of the disc, N.
    pub preload: f64,
    /// Radius of the roller, m.
    pub roller_radius: f64,
    /// Base radius, m; `None` is `auto`.
    pub base_radius: Option<f64>,
    /// Angle from the follower of the first disc to its own, in the direction of the cam angle, rad.
    pub angle: f64,
    /// Mass that moves with its follower, kg.
    pub mass: Option<f64>,
}

const SPRING_RATE: Field<f64> =
    Field::quantity("spring_rate", "rate of its spring", Required("100 N/mm"), Stiffness, above(0.0, STIFFEST));
const PRELOAD: Field<f64> = Field::quantity(
    "preload",
    "force of its spring where the disc is lowest, above 0: without it the law has a corner",
    Required("10 kN"),
    Force,
    above(0.0, LARGEST_FORCE),
);
const ROLLER_RADIUS: Field<f64> =
    Field::quantity("roller_radius", "radius of its roller", Default("30 mm"), Length, above(0.0, LONGEST));
const ROLLER_DIAMETER: Key =
    ROLLER_RADIUS.diameter("roller_diameter", "diameter of its roller, in the place of its radius", "60 mm");
const BASE_RADIUS: Field<Option<f64>> = Field::words_or_quantity(
    "base_radius",
    "\"auto\", the smallest that keeps the limits, in whole millimetres, or a length",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, above(0.0, LONGEST), Some),
);
const BASE_DIAMETER: Key =
    BASE_RADIUS.diameter("base_diameter", "diameter of the base circle, in the place of its radius", "90 mm");
const ANGLE: Field<f64> = Field::quantity(
    "angle",
    "angle of its follower from the first one in the direction of the cam angle; an opposite follower unloads the bearings",
    Default("180 deg"),
    Angle,
    within(-2.0 * PI, 2.0 * PI),
);
const MASS: Field<f64> = Field::quantity(
    "mass",
    "mass of all that moves with its follower; the torque of its inertia is reported as torque left",
    Optional("40 kg"),
    Mass,
    above(0.0, HEAVIEST),
);

const SPEEDS: Field<Vec<f64>> = Field::numbers(
    "rpm",
    "speeds of the main shaft for which the report has the preload; 4/7, 5/7 and 6/7 of that of the cam when absent",
    Optional("[20, 25, 30]"),
    within(LEAST_RPM, LARGEST_NUMBER),
);

/// The speeds for which preloads are reported, rpm.
pub(super) fn speeds(reader: &Reader<'_>) -> Vec<f64> {
    reader.find(&SECTION).and_then(|table| table.get(&SPEEDS)).unwrap_or_default()
}

/// `[compensator]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "compensator",
    about: "a second disc on the camshaft whose spring takes the torque of the first",
    occurs: Occurrence::Optional,
    cams: &[ROTARY],
    keys: &[
        SPRING_RATE.key,
        PRELOAD.key,
        ROLLER_RADIUS.key,
        ROLLER_DIAMETER,
        BASE_RADIUS.key,
        BASE_DIAMETER,
        ANGLE.key,
        MASS.key,
        SPEEDS.key,
    ],
};

pub(super) fn read(reader: &Reader<'_>) -> Option<CompensatorData> {
    let table = reader.find(&SECTION)?;
    Some(CompensatorData {
        spring_rate: table.get(&SPRING_RATE)?,
        preload: table.get(&PRELOAD)?,
        roller_radius: table.get(&ROLLER_RADIUS)?,
        base_radius: table.get(&BASE_RADIUS)?,
        angle: table.get(&ANGLE)?,
        mass: table.get(&MASS),
    })
}

impl CompensatorData {
    /// A machine as the compensating cam has it: its own follower, base radius and number, and the keyway where it lies when the
    /// disc is on the shaft.
    #[must_use]
    pub fn machine_of(&self, machine: &Machine) -> Machine {
        let roller = RollerData { radius: self.roller_radius, offset: 0.0, crown: Crown::Sphere, width: None };
        let follower = FollowerData {
            arm: None,
            path: SECTION.path,
            shape: Arc::new(TranslatingRoller::new(1.0, 0.0, self.roller_radius)),
            mass: self.mass,
            preload: Some(self.preload),
            spring_rate: self.spring_rate,
            crown_radius: None,
            roller: Some(roller),
            face: None,
            place: None,
        };
        // The angle of the disc is counted from its own follower, the keyway on the shaft is one.
        let keyway = machine.cam.keyway.map(|keyway| Keyway { angle: keyway.angle - self.angle, ..keyway });
        let cam = CamData { base_radius: self.base_radius, keyway, ..machine.cam };
        let mut title = machine.title.clone();
        title.part_number = title.part_number.map(|number| format!("{number}-{}", SECTION.path));
        let mut own = machine.clone();
        (own.follower, own.cam, own.title) = (follower, cam, title);
        own
    }
}

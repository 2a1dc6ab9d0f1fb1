//! The compensating cam: a second disc on the camshaft whose spring takes the torque of the first.

use super::disc::CamData;
use super::settings::STIFFEST;
use super::{FollowerData, Machine};
use crate::document::Presence::{Default, Optional, Required};
use crate::document::cams::ROTARY;
use crate::document::range::{HEAVIEST, LARGEST_FORCE, LONGEST};
use crate::document::{Field, Occurs, Reader, Section, above, within};
use crate::follower::{Crown, RollerData, TranslatingRoller};
use crate::units::Dimension::{Angle, Force, Length, Mass, Stiffness};
use std::f64::consts::PI;
use std::sync::Arc;

/// `[compensator]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompensatorData {
    /// Rate of the spring, N/m.
    pub spring_rate: f64,
    /// Force of the spring at the lowest place of the disc, N.
    pub preload: f64,
    /// Radius of the roller, m.
    pub roller_radius: f64,
    /// Base radius, m; `None` is `auto`.
    pub base_radius: Option<f64>,
    /// Where its follower stands, from that of the first disc in the sense of the cam angle, rad.
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
const BASE_RADIUS: Field<Option<f64>> = Field::words_or_quantity(
    "base_radius",
    "\"auto\", the smallest that keeps the limits, in whole millimetres, or a length",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, above(0.0, LONGEST), Some),
);
const ANGLE: Field<f64> = Field::quantity(
    "angle",
    "where its follower stands, from the first one in the sense of the cam angle; opposite it unloads the bearings",
    Default("180 deg"),
    Angle,
    within(-2.0 * PI, 2.0 * PI),
);
const MASS: Field<f64> = Field::quantity(
    "mass",
    "of all that moves with its follower; its inertia is told as torque left",
    Optional("40 kg"),
    Mass,
    above(0.0, HEAVIEST),
);

/// `[compensator]`.
pub(super) const SECTION: Section = Section {
    path: "compensator",
    about: "a second disc on the camshaft whose spring takes the torque of the first",
    occurs: Occurs::Optional,
    cams: &[ROTARY],
    keys: &[SPRING_RATE.key, PRELOAD.key, ROLLER_RADIUS.key, BASE_RADIUS.key, ANGLE.key, MASS.key],
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

impl Machine {
    /// The compensating cam, when it is described.
    #[must_use]
    pub fn compensator(&self) -> Option<&CompensatorData> {
        self.compensator.as_ref()
    }

    /// The machine as the compensating cam has it: its own follower, base radius and number, and the keyway where it lies when the
    /// disc is on the shaft. `None` when no compensator is described.
    #[must_use]
    pub fn of_compensator(&self) -> Option<Self> {
        let data = self.compensator?;
        let roller = RollerData { radius: data.roller_radius, offset: 0.0, crown: Crown::Sphere, width: None };
        let follower = FollowerData {
            path: SECTION.path,
            shape: Arc::new(TranslatingRoller::new(1.0, 0.0, data.roller_radius)),
            mass: data.mass,
            preload: Some(data.preload),
            spring_rate: data.spring_rate,
            crown_radius: None,
            roller: Some(roller),
            face: None,
            place: None,
        };
        // The angle of the disc is counted from its own follower, the keyway on the shaft is one.
        let keyway = self.cam.keyway.map(|keyway| super::Keyway { angle: keyway.angle - data.angle, ..keyway });
        let cam = CamData { base_radius: data.base_radius, keyway, ..self.cam };
        let mut title = self.title.clone();
        title.part_number = title.part_number.map(|number| format!("{number}-{}", SECTION.path));
        Some(Self { follower, cam, title, ..self.clone() })
    }
}

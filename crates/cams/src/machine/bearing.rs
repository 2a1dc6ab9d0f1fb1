//! The bearing of a roller, with the ratings of its catalogue.

use camgen_kernel::document::Presence::{Default, Optional, Required};
use camgen_kernel::document::cams::MAKE;
use camgen_kernel::document::range::{HEAVIEST, LARGEST_FORCE, LARGEST_NUMBER};
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, above, within};
use camgen_kernel::follower::FollowerData;
use camgen_kernel::units::Dimension::{Force, Inertia};

/// The exponent of the life of roller bearings (ISO 281:2007).
const OF_ROLLERS: f64 = 10.0 / 3.0;

/// The bearing of a roller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BearingData {
    /// Dynamic load rating C as a track roller, N.
    pub dynamic_rating: f64,
    /// Static load rating C0 as a track roller, N.
    pub static_rating: Option<f64>,
    /// Exponent p of the life: 10/3 of rollers and needles, 3 of balls.
    pub exponent: f64,
    /// Speed that the catalogue permits, rpm.
    pub limiting_speed: Option<f64>,
    /// Moment of inertia of the part that turns, kg·m².
    pub inertia: Option<f64>,
    /// Coefficient of friction between roller and cam.
    pub friction: f64,
}

const DYNAMIC_RATING: Field<f64> = Field::quantity(
    "dynamic_rating",
    "dynamic load rating C of the roller as a track roller (the catalogue's value for a rim that is not held by a housing)",
    Required("20 kN"),
    Force,
    above(0.0, LARGEST_FORCE),
)
.also(&["c"]);
const STATIC_RATING: Field<f64> = Field::quantity(
    "static_rating",
    "static load rating C0 of the roller as a track roller",
    Optional("22 kN"),
    Force,
    above(0.0, LARGEST_FORCE),
)
.also(&["c0"]);
const EXPONENT: Field<f64> = Field::number(
    "exponent",
    "exponent of the life, ISO 281: 3 for ball bearings; 10/3 for needles and rollers when absent",
    Optional("3"),
    within(1.0, 10.0),
);
const LIMITING_SPEED: Field<f64> = Field::number(
    "limiting_speed",
    "speed of the roller that its catalogue permits, rpm",
    Optional("6000"),
    above(0.0, LARGEST_NUMBER),
);
const ROLLER_INERTIA: Field<f64> = Field::quantity(
    "inertia",
    "moment of inertia of the rim that turns: for where the roller slips",
    Optional("0.00004 kg*m2"),
    Inertia,
    above(0.0, HEAVIEST),
);
const FRICTION: Field<f64> =
    Field::number("friction", "coefficient of friction between roller and cam", Default("0.1"), above(0.0, 2.0));

const fn section(path: &'static str) -> KeySection {
    KeySection {
        path,
        about: "the bearing of the roller: its life (ISO 281), speed and slip",
        occurs: Occurrence::Optional,
        cams: &[MAKE],
        keys: &[
            DYNAMIC_RATING.key,
            STATIC_RATING.key,
            EXPONENT.key,
            LIMITING_SPEED.key,
            ROLLER_INERTIA.key,
            FRICTION.key,
        ],
    }
}

/// `[follower.roller.bearing]`.
pub(super) const OF_ROLLER: KeySection = section("follower.roller.bearing");
/// `[follower.swinging-roller.bearing]`.
pub(super) const OF_SWINGING_ROLLER: KeySection = section("follower.swinging-roller.bearing");

/// Refuses the bearing of a roller on a plate, whose speed is not known.
pub(super) fn refuse_for_plate(reader: &Reader<'_>) {
    for table in [&OF_ROLLER, &OF_SWINGING_ROLLER].into_iter().filter_map(|section| reader.find(section)) {
        let message = "the life of a bearing follows from the speed of the cam, and that of a plate is not known";
        table.fail(&DYNAMIC_RATING, message.into(), Some("leave the table of the bearing out".into()));
    }
}

/// The bearing of the roller of a file.
pub(super) fn read(reader: &Reader<'_>, follower: &FollowerData) -> Option<BearingData> {
    let sections = [&OF_ROLLER, &OF_SWINGING_ROLLER];
    let found = sections.into_iter().filter_map(|section| Some((section, reader.find(section)?)));
    let (section, table) = found.last()?;
    let own = section.path.strip_suffix(".bearing").unwrap_or(section.path);
    if own != follower.path {
        let message = format!("the follower is that of [{}], which has no roller with this bearing", follower.path);
        table.fail(
            &DYNAMIC_RATING,
            message,
            Some(format!("give the follower [{own}], or leave [{}] out", section.path)),
        );
        return None;
    }
    Some(BearingData {
        dynamic_rating: table.get(&DYNAMIC_RATING)?,
        static_rating: table.get(&STATIC_RATING),
        exponent: table.get(&EXPONENT).unwrap_or(OF_ROLLERS),
        limiting_speed: table.get(&LIMITING_SPEED),
        inertia: table.get(&ROLLER_INERTIA),
        friction: table.get(&FRICTION)?,
    })
}

//! The errors of a cam and its follower as they are made: what a drawing calls tolerances, each with one value.

use camgen_kernel::document::Presence::{Default, Optional};
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, TableReader, cams, within};
use camgen_kernel::follower::{Element, FollowerData};
use camgen_kernel::units::Dimension::{Angle, Length};
use std::f64::consts::TAU;

/// `[as_made]`: errors of a disc and its follower, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsMadeData {
    /// By how much the radius of the roller is larger, m.
    pub roller_radius: f64,
    /// By how much pivot or guide is farther from the shaft, m.
    pub centre_distance: f64,
    /// By how much pivot or guide lies farther to the side, against the rotation of the cam, m.
    pub offset: f64,
    /// By how much the profile lies off the shaft, m.
    pub eccentricity: f64,
    /// Direction on the cam in which it lies off, counted as the cam angle is, rad.
    pub eccentricity_at: f64,
    /// By how much the cam is ahead on its shaft, rad.
    pub angle: f64,
    /// Depth to which profile and roller together are worn all round, m.
    pub wear: f64,
    /// Root mean square of the waviness of the profile along its normal, m.
    pub waviness: f64,
    /// Least and largest number of waves in a turn.
    pub waves: (u32, u32),
    /// Which of the random waves it has.
    pub draw: f64,
    /// By how much the speed is higher, as a share.
    pub speed: f64,
    /// By how much the force is larger that presses the follower on, as a share.
    pub load: f64,
}

/// Largest error that counts as one, m: what is left out goes with its square.
const LARGEST: f64 = 1e-3;
/// Largest error of an angle, rad: five degrees.
const LARGEST_ANGLE: f64 = 0.087_266_462_599_716_47;
/// Most waves in a turn.
const MOST_WAVES: f64 = 200.0;

/// An error that may have either sign.
const fn either_way(name: &'static str, about: &'static str) -> Field<f64> {
    Field::quantity(name, about, Default("0 mm"), Length, within(-LARGEST, LARGEST))
}

/// A size of an error.
const fn size(name: &'static str, about: &'static str) -> Field<f64> {
    Field::quantity(name, about, Default("0 mm"), Length, within(0.0, LARGEST))
}

const ROLLER_RADIUS: Field<f64> =
    either_way("roller_radius", "by how much the radius of the roller is larger than its nominal one");
const CENTRE_DISTANCE: Field<f64> = either_way(
    "centre_distance",
    "by how much the pivot of the follower, or the guide of one on a straight path, is farther from the shaft",
);
const OFFSET: Field<f64> =
    either_way("offset", "by how much that pivot or guide lies farther to the side, against the rotation of the cam");
const ECCENTRICITY: Field<f64> = size("eccentricity", "distance of the centre of the profile from the shaft");
const ECCENTRICITY_AT: Field<f64> = Field::quantity(
    "eccentricity_at",
    "direction of that distance on the cam, counted as the cam angle is",
    Default("0 deg"),
    Angle,
    within(-TAU, TAU),
);
const ANGLE: Field<f64> = Field::quantity(
    "angle",
    "by how much the cam is ahead on its shaft",
    Default("0 deg"),
    Angle,
    within(-LARGEST_ANGLE, LARGEST_ANGLE),
);
const WEAR: Field<f64> = size("wear", "depth to which profile and roller together are worn, the same all round");
const WAVINESS: Field<f64> = size(
    "waviness",
    "waviness of the profile along its normal, root mean square: waves of equal height and random phase",
);
const WAVES_FROM: Field<f64> =
    Field::number("waves_from", "least number of waves in a turn of the cam", Default("15"), within(2.0, MOST_WAVES));
const WAVES_TO: Field<f64> =
    Field::number("waves_to", "largest number of waves in a turn of the cam", Default("50"), within(2.0, MOST_WAVES));
const DRAW: Field<f64> = Field::number(
    "draw",
    "which random phases the waves have: another number, other phases",
    Optional("0.5"),
    within(-1e9, 1e9),
);
const SPEED: Field<f64> =
    Field::share("speed", "by how much the speed is higher than that of the design", Default("0 %"), within(-0.5, 0.5));
const LOAD: Field<f64> = Field::share(
    "load",
    "by how much the force is larger that presses the follower on: the pressure of the air of a press, preloads",
    Default("0 %"),
    within(-0.5, 0.5),
);

/// `[as_made]`.
pub(super) const SECTION: KeySection = KeySection {
    path: "as_made",
    about: "errors of the cam and its follower as they are made: what they do to lift, acceleration and forces is the section as_made of the report; nothing that is cut changes",
    occurs: Occurrence::Optional,
    cams: cams::DISCS,
    keys: &[
        ROLLER_RADIUS.key,
        CENTRE_DISTANCE.key,
        OFFSET.key,
        ECCENTRICITY.key,
        ECCENTRICITY_AT.key,
        ANGLE.key,
        WEAR.key,
        WAVINESS.key,
        WAVES_FROM.key,
        WAVES_TO.key,
        DRAW.key,
        SPEED.key,
        LOAD.key,
    ],
};

/// The errors of a file.
pub(super) fn read(reader: &Reader<'_>, follower: &FollowerData, body: &str) -> Option<AsMadeData> {
    let table = reader.find(&SECTION)?;
    let rolls = matches!(follower.shape.element(), Element::Roller { radius } if radius != 0.0);
    if !rolls && table.get(&ROLLER_RADIUS).is_some_and(|error| error != 0.0) {
        table.fail(&ROLLER_RADIUS, "the follower has no roller".to_owned(), Some("leave it out".into()));
    }
    if body != cams::MAKE {
        let message = format!("the errors of a cam as it is made are computed for a disc, and this is a {body}");
        reader.fail(message, Some("leave [as_made] out, or give cam.body = \"disc\"".into()));
    }
    let (from, to) = (whole(&table, &WAVES_FROM)?, whole(&table, &WAVES_TO)?);
    if from > to {
        let message = format!("the least number of waves, {from}, is larger than the largest, {to}");
        table.fail(&WAVES_FROM, message, Some(format!("at most {to}, or a larger waves_to")));
    }
    Some(AsMadeData {
        roller_radius: table.get(&ROLLER_RADIUS)?,
        centre_distance: table.get(&CENTRE_DISTANCE)?,
        offset: table.get(&OFFSET)?,
        eccentricity: table.get(&ECCENTRICITY)?,
        eccentricity_at: table.get(&ECCENTRICITY_AT)?,
        angle: table.get(&ANGLE)?,
        wear: table.get(&WEAR)?,
        waviness: table.get(&WAVINESS)?,
        waves: (from, to),
        draw: table.get(&DRAW).unwrap_or_default(),
        speed: table.get(&SPEED)?,
        load: table.get(&LOAD)?,
    })
}

/// A number of waves.
fn whole(table: &TableReader<'_>, field: &Field<f64>) -> Option<u32> {
    let number = table.get(field)?;
    if number.fract() != 0.0 {
        table.fail(field, format!("as_made.{} must be a whole number", field.key.name), None);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "2 to 200")]
    Some(number as u32)
}

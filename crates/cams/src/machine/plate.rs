//! The plate of a linear cam, which travels out and back under its follower.

use super::{bearing, dynamics, limits};
use camgen_kernel::document::Presence::Default;
use camgen_kernel::document::cams::{MAKE, WEDGE};
use camgen_kernel::document::range::LONGEST;
use camgen_kernel::document::{Bounds, Field, KeySection, Occurrence, Reader, TableReader, above, within};
use camgen_kernel::follower::{Element, FollowerData};
use camgen_kernel::motion::{Jet, Quantity};
use camgen_kernel::units::Dimension::{Angle, Length};
use std::f64::consts::FRAC_PI_3;

/// The plate of a linear cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlateData {
    /// Length along its travel, m; `None` is `auto`.
    pub length: Option<f64>,
    /// Height from its back to where its flank is lowest, m; `None` is `auto`.
    pub height: Option<f64>,
    /// Length of the level flank before the motion begins, m; `None` is `auto`.
    pub run_in: Option<f64>,
    /// Angle of the follower's path from the direction across the travel, rad: positive where a growing lift moves the follower towards
    /// the far end of the plate.
    pub drive_angle: f64,
}

const LENGTH_RANGE: Bounds = above(0.0, LONGEST);
/// Steepest path of a follower, rad: beyond it the level run-in alone presses on the guide more than on the follower.
const STEEPEST: f64 = FRAC_PI_3;

const LENGTH: Field<Option<f64>> = Field::words_or_quantity(
    "length",
    "length of a plate along its travel; \"auto\": that of run-in, stroke and as much behind it, in whole millimetres",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, LENGTH_RANGE, Some),
)
.only(&[WEDGE])
.also(&["plate_length"]);
const HEIGHT: Field<Option<f64>> = Field::words_or_quantity(
    "height",
    "height of a plate from its back to where its flank is lowest; \"auto\": that of the lift and the wall, at least the radius of the roller, in whole millimetres",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, LENGTH_RANGE, Some),
)
.only(&[WEDGE])
.also(&["plate_height"]);
const RUN_IN: Field<Option<f64>> = Field::words_or_quantity(
    "run_in",
    "length of the level flank of a plate before its motion begins; \"auto\": the radius of the roller, at least 5 mm",
    Default("auto"),
    (&["auto"], &[None]),
    (Length, LENGTH_RANGE, Some),
)
.only(&[WEDGE])
.also(&["runin", "flat", "start_length"]);
const DRIVE_ANGLE: Field<f64> = Field::quantity(
    "drive_angle",
    "angle of the follower's path on a plate from the direction across its travel, -60 deg to 60 deg; positive where a growing lift moves it towards the far end of the plate",
    Default("0 deg"),
    Angle,
    within(-STEEPEST, STEEPEST),
)
.only(&[WEDGE])
.also(&["drive", "path_angle", "inclination"]);

/// The keys of `[cam]` that only a plate has.
pub(super) const SECTION: KeySection = KeySection {
    path: "cam",
    about: "",
    occurs: Occurrence::Once,
    cams: &[MAKE],
    keys: &[LENGTH.key, HEIGHT.key, RUN_IN.key, DRIVE_ANGLE.key],
};

pub(super) fn read(table: &TableReader<'_>) -> Option<PlateData> {
    Some(PlateData {
        length: table.get(&LENGTH)?,
        height: table.get(&HEIGHT)?,
        run_in: table.get(&RUN_IN)?,
        drive_angle: table.get(&DRIVE_ANGLE)?,
    })
}

/// Why a follower does not run on a plate, and what would; `None` of one that does.
pub(super) fn misfit(follower: &FollowerData) -> Option<(String, &'static str)> {
    let path = follower.path;
    let roller = "give [follower.roller]";
    if follower.shape.quantity() == Quantity::Angle {
        let why = format!("a plate moves its follower along a straight path, and that of [{path}] swings");
        return Some((why, roller));
    }
    if follower.shape.element() == Element::Face {
        let why = format!(
            "a plate that travels does not turn: the face of [{path}] keeps one direction on it, and touches only where the flank \
             has just this slope, so that no flank moves it by a program"
        );
        return Some((why, roller));
    }
    let beside = follower.shape.touch(0.0, &Jet::default()).curve.point.y != 0.0;
    (follower.place.is_some() || beside).then(|| {
        let why = format!("a plate has no shaft from which the path of [{path}] could be offset");
        (why, "leave the offset out; cam.drive_angle inclines the path")
    })
}

/// Refuses what a file says of a cam that turns and that has no meaning for a plate.
pub(super) fn refuse_turning(reader: &Reader<'_>, follower: &FollowerData) {
    dynamics::refuse_for_plate(reader);
    bearing::refuse_for_plate(reader);
    limits::refuse_for_plate(reader);
    if follower.mass.is_some() {
        let message = format!("the mass of [{}] acts by the speed of the plate, which is not known", follower.path);
        reader.fail(message, Some("leave it out: the forces on a plate are those at rest".into()));
    }
}

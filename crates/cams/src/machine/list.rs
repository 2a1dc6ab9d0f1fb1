//! The tables of a machine file.

use super::{
    ROOT, as_made, barrel, bearing, cutting, disc, dynamics, hole_pattern, limits, output, part_features, plate, title,
    track, turret,
};
use camgen_kernel::document::KeySection;
use camgen_kernel::follower::FOLLOWERS;
use camgen_kernel::motion::program;

/// The tables of a machine file before those of the followers, in the order of the template.
const MOTION_TABLES: &[&KeySection] =
    &[&ROOT, &program::keys::SECTION, &program::keys::FOURIER, &program::keys::POLYDYNE, &program::keys::SEGMENT];

/// The tables after those of the followers.
const BODY_TABLES: &[&KeySection] = &[
    &bearing::OF_ROLLER,
    &bearing::OF_SWINGING_ROLLER,
    &dynamics::SPRING,
    &dynamics::GUIDE,
    &dynamics::VIBRATION,
    &dynamics::FLYWHEEL,
    &disc::SECTION,
    &track::SECTION,
    &barrel::SECTION,
    &turret::SECTION,
    &plate::SECTION,
    &disc::KEYWAY,
    &part_features::HUB,
    &part_features::TIMING_MARK,
    &hole_pattern::SECTION,
    &track::COUNTER,
    &as_made::SECTION,
    &limits::SECTION,
    &title::SECTION,
    &cutting::SECTION,
    &output::SECTION,
];

/// The tables of a machine file, and one for each kind of follower.
#[must_use]
pub fn sections() -> Vec<&'static KeySection> {
    let followers = FOLLOWERS.iter().map(|kind| kind.section);
    MOTION_TABLES.iter().copied().chain(followers).chain(BODY_TABLES.iter().copied()).collect()
}

//! The key of a conical roller.

use crate::body::BodyKeys;
use crate::machine::{CamData, FollowerData, MachineParts};
use camgen_kernel::document::Presence::Default;
use camgen_kernel::document::cams::MAKE;
use camgen_kernel::document::{Field, KeySection, Occurrence, Reader, within};
use camgen_kernel::units::Dimension::Angle;
use std::f64::consts::PI;

/// Least and largest half angle, rad: below, the roller is a cylinder; beyond, it is pushed out of its groove.
const LEAST: f64 = 0.1 * PI / 180.0;
pub(super) const LARGEST: f64 = 0.25 * PI;

/// Half angle of the roller, rad; `None` where its cone points at the axis of the cam.
#[derive(Debug, Clone, Copy)]
pub(super) struct HalfAngle(pub(super) Option<f64>);

const HALF_ANGLE: Field<Option<f64>> = Field::words_or_quantity(
    "roller_half_angle",
    "angle between axis and surface of a conical roller, whose radius is that on the outside of the cam; \"auto\": the cone points at the axis of the cam, so that the roller does not slide while it rests",
    Default("auto"),
    (&["auto"], &[None]),
    (Angle, within(LEAST, LARGEST), Some),
)
.only(&[super::TAPERED.keys]);

const SECTION: KeySection =
    KeySection { path: "cam", about: "", occurs: Occurrence::Once, cams: &[MAKE], keys: &[HALF_ANGLE.key] };

pub(super) const KEYS: BodyKeys = BodyKeys { section: &SECTION, read };

fn read(reader: &Reader<'_>, _: (Option<&CamData>, Option<&FollowerData>), parts: &mut MachineParts) {
    if let Some(half_angle) = reader.table(&SECTION).get(&HALF_ANGLE) {
        parts.set(HalfAngle(half_angle));
    }
}

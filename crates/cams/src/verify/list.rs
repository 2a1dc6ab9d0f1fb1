//! The list of checks, in the order of reports.

use super::check::CheckEntry::{self, Figure, File};
use super::{
    balance, bore, cutter_path, felt, file, flank, groove_width, lead_in, outline, plate_ends, rolling, solid, sphere,
    swept, tangency,
};
use crate::body::barrel::measures as barrel;
use crate::body::closure;
use crate::body::disc::residual_vibration;
use crate::body::globoid::measures as globoid;
use crate::body::{flank_switch, roller_bearing};
use crate::check::{
    contact_stress, continuity, curvature, cutter_radius, face_width, force_closure, guide, jump_speed, noise, outlier,
    overshoot, pivot_clearance, pressure_angle, size, wall,
};

/// Every check of the core, in the order of the report.
pub const CHECKS: &[CheckEntry] = &[
    File(&file::LAYER),
    File(&file::UNITS),
    File(&file::READABLE),
    File(&file::DUPLICATES),
    File(&file::CONTOURS),
    File(&file::CLOSED),
    File(&solid::SOLIDS),
    File(&solid::SHELL),
    File(&solid::WALLS),
    File(&solid::THICKNESS),
    File(&solid::VOLUME),
    File(&solid::HOLES),
    File(&solid::HUB),
    Figure(&continuity::CHECK),
    Figure(&outlier::CHECK),
    Figure(&overshoot::CHECK),
    Figure(&noise::CHECK),
    Figure(&pressure_angle::CHECK),
    Figure(&curvature::UNDERCUT),
    Figure(&curvature::MIN_CONVEX_RADIUS),
    Figure(&face_width::CHECK),
    Figure(&cutter_radius::CHECK),
    File(&cutter_path::CHECK),
    Figure(&wall::CHECK),
    Figure(&size::CHECK),
    Figure(&pivot_clearance::CHECK),
    File(&plate_ends::ENDS),
    File(&tangency::CHECK),
    File(&outline::CHECK),
    File(&rolling::CHECK),
    File(&swept::UNROLLED),
    File(&swept::FLANK_SURFACE),
    File(&swept::SOLID_SHELL),
    File(&swept::SOLID_VOLUME),
    File(&groove_width::CHECK),
    File(&bore::CHECK),
    File(&lead_in::CHECK),
    File(&sphere::ROLLING_FLANK),
    File(&flank::CHECK),
    Figure(&force_closure::CHECK),
    Figure(&jump_speed::CHECK),
    Figure(&flank_switch::CHECK),
    Figure(&barrel::PLANE_OFFSET),
    Figure(&globoid::MESHING),
    Figure(&closure::CHECK),
    Figure(&guide::CHECK),
    Figure(&contact_stress::CHECK),
    Figure(&roller_bearing::LIFE),
    Figure(&roller_bearing::SPEED),
    Figure(&roller_bearing::SLIP),
    Figure(&residual_vibration::CHECK),
    File(&felt::CHECK),
    File(&balance::CHECK),
];

//! The checks of a press.

pub mod air;
pub mod balanced;
pub mod column;
pub mod compensator;
pub mod contact_life;
pub mod fixed_bottom;
pub mod residual;
pub mod springs;

use super::conoid::checks as conoid;
use super::wedge::roller_clearance;
use camgen_cams::check::Check;
use camgen_cams::domain::Added;

/// All of them, in the order of reports.
pub(super) const CHECKS: &[Added<&Check>] = &[
    Added { after: "pressure_angle", entries: &[&conoid::AXIAL_FORCE] },
    Added { after: "wall", entries: &[&roller_clearance::CHECK] },
    Added { after: "flank", entries: &[&conoid::AXIAL_REACH, &conoid::CYLINDER_CONTACT] },
    Added { after: "vibration", entries: &[&residual::CHECK, &air::AIR, &balanced::RUN_UP] },
    Added { after: "acceleration", entries: &[&conoid::BETWEEN_SECTIONS] },
    Added {
        after: "balance",
        entries: &[
            &compensator::CHECK,
            &contact_life::CHECK,
            &air::ADDED_VOLUME,
            &fixed_bottom::FIXED_BOTTOM,
            &column::CHECK,
            &air::CLOSING,
            &fixed_bottom::SCATTER,
            &fixed_bottom::HALF_LOOP,
            &fixed_bottom::LOSSES,
            &fixed_bottom::SETTING,
            &springs::STRESS,
            &springs::COILS,
            &springs::WIRE,
            &springs::INDEX,
            &springs::SURGE,
            &springs::BUCKLING,
        ],
    },
];

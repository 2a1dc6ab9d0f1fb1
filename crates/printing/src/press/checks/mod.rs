//! The checks of a press.

pub mod added_volume;
pub mod air;
pub(super) mod balanced;
pub mod buckling;
pub mod closing;
pub mod column;
pub mod compensator;
pub mod contact_life;
pub mod fixed_bottom;
pub mod half_loop;
pub mod losses;
pub mod residual;
pub mod run_up;
pub mod scatter;
pub mod setting;
pub mod spring_coils;
pub mod spring_stress;
pub mod surge;

use super::conoid::{between_sections, cylinder_contact, shift};
use super::wedge::roller_clearance;
use camgen_cams::check::Check;
use camgen_cams::domain::Added;

/// All of them, in the order of reports.
pub(super) const CHECKS: &[Added<&Check>] = &[
    Added { after: "pressure_angle", entries: &[&shift::AXIAL_FORCE] },
    Added { after: "wall", entries: &[&roller_clearance::CHECK] },
    Added { after: "flank", entries: &[&shift::AXIAL_REACH, &cylinder_contact::CHECK] },
    Added { after: "vibration", entries: &[&residual::CHECK, &air::CHECK, &run_up::CHECK] },
    Added { after: "acceleration", entries: &[&between_sections::CHECK] },
    Added {
        after: "balance",
        entries: &[
            &compensator::CHECK,
            &contact_life::CHECK,
            &added_volume::CHECK,
            &fixed_bottom::CHECK,
            &column::CHECK,
            &closing::CHECK,
            &scatter::CHECK,
            &half_loop::CHECK,
            &losses::CHECK,
            &setting::CHECK,
            &spring_stress::CHECK,
            &spring_coils::COILS,
            &spring_coils::WIRE,
            &spring_coils::INDEX,
            &surge::CHECK,
            &buckling::CHECK,
        ],
    },
];

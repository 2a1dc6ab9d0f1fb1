//! The checks of a press.

pub mod air;
pub mod column;
pub mod compensator;
pub mod contact_life;
pub mod fixed_bottom;
pub mod residual;
pub mod run_up;
pub mod springs;

use super::conoid::{between_sections, cylinder_contact, shift};
use super::load::ForceBalanced;
use super::wedge::roller_clearance;
use camgen_cams::check::{Check, Measures, Subject};
use camgen_cams::domain::Added;

/// All of them, in the order of reports.
pub(super) const CHECKS: &[Added<&Check>] = &[
    Added { after: "pressure_angle", entries: &[&shift::AXIAL_FORCE] },
    Added { after: "wall", entries: &[&roller_clearance::CHECK] },
    Added { after: "flank", entries: &[&shift::AXIAL_REACH, &cylinder_contact::CHECK] },
    Added { after: "vibration", entries: &[&residual::CHECK, &air::AIR, &run_up::CHECK] },
    Added { after: "acceleration", entries: &[&between_sections::CHECK] },
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

/// The measures of every disc that balances the inertia force of the bed by the air.
pub(super) fn of_balance(balanced: &dyn ForceBalanced, of: &mut Measures<'_>, subject: &Subject<'_>) {
    of.add(&residual::CHECK, |written| residual::measure(balanced, written, subject));
    of.add(&air::AIR, |_| balanced.least_air().map(|least| air::least_length(&least, subject)));
    of.add(&column::CHECK, |_| {
        column::measure(&balanced.columns(), subject.machine, |press, rpm| Some(press.rotary_law(rpm).ok()?.column()))
    });
    of.add(&run_up::CHECK, |_| balanced.run_up().map(|run_up| run_up::measure(&run_up)));
}

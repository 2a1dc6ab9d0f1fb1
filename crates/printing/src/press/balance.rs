//! What a cam of a press is for: that the air balances the inertia of the bed. The measures on which its verdicts rest.

use crate::press::MachineOfPress;
use crate::press::buffer::Cylinder;
use crate::press::buffer::crank_law::CrankLaw;
use crate::press::load::USEFUL;
use crate::press::report::ReversalOfBed;
use camgen_cams::machine::Machine;
use camgen_cams::report::{Section, degrees};
use camgen_kernel::document::NamedChoice;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::digits::three_digits_down;
use camgen_kernel::numeric::root;

/// Share of the air at the end of the stroke that an error of the bottom may take so that the residual stays below
/// a share of the largest inertia.
///
/// With air a under the piston an error e of the bottom changes the force (1 + A x) by its multiple (1 − e/a)^(−k) − 1, which
/// grows with x; over the inertia A r it is largest at the end of the stroke. Under a linkage it is so where the deceleration is
/// largest.
fn share_of_air(law: &CrankLaw, share: f64) -> f64 {
    let end = law.loading() * law.largest_deceleration();
    -libm::expm1(-libm::log1p(share * end / (1.0 + end)) / law.exponent())
}

/// By how much the bottom may miss a law, m, so that the residual stays a useful one.
pub(super) fn allowed_error(cylinder: &Cylinder, law: &CrankLaw) -> f64 {
    let share = USEFUL * cylinder.residual_fixed_bottom(law) / cylinder.largest_load(law);
    law.air_left(law.largest_deceleration()) * share_of_air(law, share)
}

/// The section on the reversal of a bed that is not moved by a yoke.
pub(crate) fn reversal_of_bed(machine: &Machine) -> Option<Section> {
    let (end, start) = machine.stroke_end()?;
    let reversal = ReversalOfBed {
        end: end.end().word().to_owned(),
        start_deg: degrees(start),
        angle_deg: end.angle().to_degrees(),
        dead_point_deg: end.dead().to_degrees(),
        largest_deceleration_deg: end.largest_deceleration().at.to_degrees(),
        overrun_mm: MILLIMETRES * end.stroke(),
        overrun_left_mm: MILLIMETRES * end.overrun_at_end(),
    };
    Some(reversal.section())
}

/// Ratio of the speeds that are tried downwards, and how many.
const SLOWER: f64 = 0.8;
const SPEEDS: usize = 60;

/// The highest speed below `from` (rpm) at which an error may be as large as `error` (m); three digits.
pub(super) fn fitting_speed(allowed: impl Fn(f64) -> f64, from: f64, error: f64) -> Option<f64> {
    let mut tried = std::iter::successors(Some(from), |rpm| Some(SLOWER * rpm)).take(SPEEDS);
    let slow = tried.find(|rpm| allowed(*rpm) - error > 0.0)?;
    let speed = root::bracketed(|rpm| allowed(rpm) - error, slow, slow / SLOWER, 0.0).unwrap_or(slow);
    let rounded = three_digits_down(speed);
    (allowed(rounded) - error >= 0.0).then_some(rounded)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::press::buffer::bottom_law::{BottomLaw, ColumnRule};

    /// By equation (8) itself: with the bottom as far off as allowed, half of what a fixed bottom leaves is left at the end of
    /// the stroke, and less before.
    #[test]
    fn an_allowed_error_leaves_half_of_a_fixed_bottom() {
        let cylinder = Machine::load("dpi", &[]).expect("valid").0.press().expect("a press").cylinder();
        for (rpm, column) in [(35.0, ColumnRule::Matched), (350.0, ColumnRule::Matched), (35.0, ColumnRule::Return)] {
            let law = BottomLaw::new(cylinder.loading(rpm), 1.35, 0.18, column, 0.0);
            let error = allowed_error(&cylinder, &law.into());
            let left = |x: f64| {
                let air = law.column - x - law.displacement(x) - error;
                cylinder.unit_force() * (libm::pow(law.column / air, 1.35) - 1.0 - law.loading * x)
            };
            let half = 0.5 * cylinder.residual_fixed_bottom(&law.into());
            // The air is a difference of lengths up to ten thousand times as long.
            assert!((left(0.18) / half - 1.0).abs() < 1e-8, "{rpm} rpm: {} {half}", left(0.18));
            assert!(left(0.09) < half);
        }
    }
}

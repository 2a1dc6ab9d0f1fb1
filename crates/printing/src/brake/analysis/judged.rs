//! The measures of a brake for its checks.

use super::braking::{LoadedBrake, TensionRange};
use super::spread;
use crate::brake::checks::{BELT_RANGE, FRAME_REACH, GRIP, SELF_LOCKING, TENSION, WEB_STRESS};
use crate::brake::machine::{BeltMode, BrakeMachine, BrakeModel};
use crate::brake::mechanics::{Brake, PaperRoll};
use camgen_cams::check::Measure;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{KeyChange, Length, Remedy, text};

/// Largest friction / friction at which the brake jams.
const LOCKING: f64 = 1.0 / 1.5;
/// The radius down to which the frame is followed to find its reach, as a share of the smallest radius.
const BEYOND: f64 = 1e-3;

/// The measures; with a disc the tension is judged as cut, by the disc.
pub(super) fn measures(
    machine: &BrakeMachine,
    braking: &LoadedBrake<'_>,
    tensions: &TensionRange,
    disc: bool,
) -> Vec<Measure> {
    let (data, limits) = (&machine.data, &machine.limits);
    let TensionRange { least, largest } = tensions;
    let mut all = Vec::new();
    if !disc {
        let note = text!(
            "{} N at {}, {} N at {}",
            format_args!("{:.2}", least.value),
            Length::mm(MILLIMETRES * least.at),
            format_args!("{:.2}", largest.value),
            Length::mm(MILLIMETRES * largest.at)
        );
        let remedy = "a disc on the frame's shaft holds it (--cam with [brake.cam]), or another frame (--synthesize)";
        let value = spread(least.value, largest.value);
        let note = if value > limits.tension_spread { note.and("; ", remedy) } else { note };
        all.push(TENSION.measure(value, Some(limits.tension_spread)).noted(note));
    }
    all.push(self_locking(braking));
    if data.model == BrakeModel::Printed && data.mode == BeltMode::Slip {
        let [full, run_down] = &braking.ends;
        let ratios = [braking.regulated(full), braking.regulated(run_down)];
        let [first, last] = ratios;
        let note = format!("V_z/V by (9): {first:.6} on the full roll, {last:.6} on the run-down roll");
        all.push(BELT_RANGE.measure(first.min(last), Some(0.0)).noted(note));
    }
    if data.mode == BeltMode::NoSlip {
        all.push(grip(braking));
    }
    if let Some(web) = &data.web {
        let stress = 1e-6 * web.stress(largest.value.max(if disc { data.tension } else { 0.0 }));
        let limit = limits.web_stress.map(|limit| 1e-6 * limit);
        all.push(WEB_STRESS.measure(stress, limit));
    }
    all.push(frame_reach(braking.brake));
    all
}

/// The friction divided by that at which the brake jams: 0 where it never jams.
fn self_locking(braking: &LoadedBrake<'_>) -> Measure {
    let friction = braking.brake.friction();
    let worst = braking.largest(|pose| pose.locking_friction().map_or(0.0, |lock| friction / lock));
    let note = if worst.value > 0.0 {
        let (lock, radius) = (friction / worst.value, MILLIMETRES * worst.at);
        let place =
            text!("the brake jams with a friction of {} at {}", format_args!("{:.4}", lock), Length::mm(radius));
        let remedy =
            "turn the roll the other way (brake.rotation), or move the pivot to the other side of the tight span";
        if worst.value > LOCKING { place.and("; ", remedy) } else { place }
    } else {
        "the brake does not jam at any friction".into()
    };
    SELF_LOCKING.measure(worst.value, Some(LOCKING)).noted(note)
}

/// The radius down to which the frame follows the roll.
fn frame_reach(brake: &Brake) -> Measure {
    let roll = *brake.roll();
    let further = PaperRoll { smallest_radius: BEYOND * roll.smallest_radius, ..roll };
    let made = Brake::new(*brake.frame(), further, brake.friction(), brake.rotation());
    let (reach, note) = match &made {
        Ok(_) => (further.smallest_radius, "the frame follows the roll to its smallest radius and beyond".to_owned()),
        Err(wall) => (wall.radius().unwrap_or(roll.smallest_radius), wall.to_string()),
    };
    let limit = Some(MILLIMETRES * roll.smallest_radius);
    FRAME_REACH.measure(MILLIMETRES * reach, limit).noted(note)
}

/// The tension that a belt without slip can hold, divided by the wanted one, and the weight that keeps the limit.
fn grip(braking: &LoadedBrake<'_>) -> Measure {
    let (data, brake) = (braking.data, braking.brake);
    let worst = braking.least(|pose| braking.grip(pose) / data.tension);
    let weight = braking.largest(|pose| match data.model {
        BrakeModel::Consistent => brake.weight_for(data.tension, pose),
        BrakeModel::Printed => brake.weight_for_printed(data.tension, pose),
    });
    let needed = data.grip * weight.value;
    let note = text!(
        "least at {}; holding {} times the wanted tension over the whole roll needs a weight of {} N: {}",
        Length::mm(MILLIMETRES * worst.at),
        data.grip,
        format_args!("{:.2}", needed),
        Remedy::new([KeyChange::new("brake.weight", format!("{:.2} N", (100.0 * needed).ceil() / 100.0))])
    );
    GRIP.measure(worst.value, Some(data.grip)).noted(note)
}

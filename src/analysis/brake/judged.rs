//! What a brake must keep, as measures for the checks.

use super::braking::Braking;
use super::{BELT_RANGE, FRAME_REACH, GRIP, Measure, SELF_LOCKING, TENSION, WEB_STRESS, spread};
use crate::brake::{Brake, Roll, Stand};
use crate::geometry::MILLIMETRES;
use crate::machine::{BeltMode, BrakeMachine, BrakeModel};
use crate::numeric::extremum::Extremum;
use crate::report::shown;

/// Largest friction over that at which the brake jams.
const LOCKING: f64 = 1.0 / 1.5;
/// Of the smallest radius, the one to which the frame is followed to see how far it reaches.
const BEYOND: f64 = 1e-3;

/// Of a brake; with a disc the tension is judged as cut, by the disc.
pub(super) fn measures(
    machine: &BrakeMachine,
    braking: &Braking<'_>,
    ((least, largest), disc): ((Extremum, Extremum), bool),
) -> Vec<Measure> {
    let (data, limits) = (&machine.data, &machine.limits);
    let mut all = Vec::new();
    if !disc {
        let note = format!(
            "{:.2} N at {} mm, {:.2} N at {} mm",
            least.value,
            shown(MILLIMETRES * least.at),
            largest.value,
            shown(MILLIMETRES * largest.at)
        );
        let remedy = "; a disc on the frame's shaft holds it (--cam with [brake.cam]), or another frame (--synthesize)";
        let value = spread(least.value, largest.value);
        let note = if value > limits.tension_spread { note + remedy } else { note };
        all.push(measure(TENSION, value, Some(limits.tension_spread), "1", note));
    }
    all.push(self_locking(braking));
    if data.model == BrakeModel::Printed && data.mode == BeltMode::Slip {
        let [full, run_down] = &braking.ends;
        let ratios = [braking.regulated(full), braking.regulated(run_down)];
        let [first, last] = ratios;
        let note = format!("V_z/V by (9): {first:.6} on the full roll, {last:.6} where it has run down");
        all.push(measure(BELT_RANGE, first.min(last), Some(0.0), "1", note));
    }
    if data.mode == BeltMode::NoSlip {
        all.push(grip(braking));
    }
    if let Some(web) = &data.web {
        let stress = 1e-6 * web.stress(largest.value.max(if disc { data.tension } else { 0.0 }));
        let limit = limits.web_stress.map(|limit| 1e-6 * limit);
        all.push(Measure { check: WEB_STRESS, value: stress, limit, unit: "MPa", note: None });
    }
    all.push(frame_reach(braking.brake));
    all
}

fn measure(check: &'static str, value: f64, limit: Option<f64>, unit: &'static str, note: String) -> Measure {
    Measure { check, value, limit, unit, note: Some(note) }
}

/// The friction over that at which the brake jams: 0 where none does.
fn self_locking(braking: &Braking<'_>) -> Measure {
    let friction = braking.brake.friction();
    let share = |stand: &Stand| stand.locking_friction().map_or(0.0, |lock| friction / lock);
    let worst = braking.largest(share);
    let note = if worst.value > 0.0 {
        let (lock, radius) = (friction / worst.value, MILLIMETRES * worst.at);
        let place = format!("it jams with a friction of {lock:.4} at {} mm", shown(radius));
        let remedy =
            "; turn the roll the other way (brake.rotation), or move the pivot to the other side of the tight span";
        if worst.value > LOCKING { place + remedy } else { place }
    } else {
        "no friction jams it".into()
    };
    measure(SELF_LOCKING, worst.value, Some(LOCKING), "1", note)
}

/// The radius down to which the frame follows the roll.
fn frame_reach(brake: &Brake) -> Measure {
    let roll = *brake.roll();
    let further = Roll { smallest_radius: BEYOND * roll.smallest_radius, ..roll };
    let made = Brake::new(*brake.frame(), further, brake.friction(), brake.rotation());
    let (reach, note) = match &made {
        Ok(_) => (further.smallest_radius, "it follows the roll as far as it runs down, and further".to_owned()),
        Err(wall) => (wall.radius().unwrap_or(roll.smallest_radius), wall.to_string()),
    };
    let limit = Some(MILLIMETRES * roll.smallest_radius);
    measure(FRAME_REACH, MILLIMETRES * reach, limit, "mm", note)
}

/// What a belt without slip grips over the wanted tension, and the weight that keeps the limit.
fn grip(braking: &Braking<'_>) -> Measure {
    let (data, brake) = (braking.data, braking.brake);
    let worst = braking.least(|stand| braking.grip(stand) / data.tension);
    let weight = |stand: &Stand| match data.model {
        BrakeModel::Consistent => brake.weight_for(data.tension, stand),
        BrakeModel::Printed => brake.weight_for_printed(data.tension, stand),
    };
    let needed = data.grip * braking.largest(weight).value;
    let note = format!(
        "least at {} mm; {} times the wanted tension over the whole roll needs {needed:.2} N: brake.weight = \"{:.2} N\"",
        shown(MILLIMETRES * worst.at),
        data.grip,
        (100.0 * needed).ceil() / 100.0
    );
    measure(GRIP, worst.value, Some(data.grip), "1", note)
}

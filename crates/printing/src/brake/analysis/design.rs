//! A frame designed for a roll, and a frame as a table of a machine file.

use super::sections::FRICTION_CHANGE;
use crate::brake::mechanics::synthesis::{self, DesignedBrake, FrameAim, FrameTask};
use crate::brake::mechanics::{Brake, BrakeError, BrakeFrame, PaperRoll, RollRotation};
use camgen_cams::report::Section;
use camgen_kernel::document::NamedChoice;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;
use serde_json::json;

/// Limit of the coordinates from the roll's axis, in largest radii of the roll.
const REACH: f64 = 8.0 / 3.0;
/// Distance between pulley, pivot and roll, as a share of the largest radius.
const CLEARANCE: f64 = 1.0 / 30.0;
/// Generations of the search: they find a frame within 0.05 % in a fraction of a second.
const GENERATIONS: u32 = 300;
/// Steps to which places are rounded, m: finer ones where the frame needs it.
const STEPS: [f64; 3] = [1e-3, 1e-4, 1e-5];
/// Largest increase of the spread of the tension by rounding, as a share of the largest tension.
const ROUNDING: f64 = 5e-4;

/// The goal of the design of a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrameGoal {
    /// Least spread of the tension over the roll.
    Level,
    /// Least spread over the roll and the friction ± 20 % together.
    Robust,
}

impl NamedChoice for FrameGoal {
    const ALL: &'static [(&'static str, Self)] = &[("level", Self::Level), ("robust", Self::Robust)];
}

impl FrameGoal {
    fn aim(self, friction: f64) -> FrameAim {
        match self {
            Self::Level => FrameAim::Level,
            Self::Robust => {
                FrameAim::Robust { from: (1.0 - FRICTION_CHANGE) * friction, to: (1.0 + FRICTION_CHANGE) * friction }
            }
        }
    }
}

/// The best frame for a roll, its sense and pulleys of a radius, m; places in whole millimetres, or finer where it needs that.
pub(super) fn designed(
    (roll, rotation, pulley_radius): (PaperRoll, RollRotation, f64),
    friction: f64,
    goal: FrameGoal,
    seed: u64,
) -> Result<DesignedBrake, Refusal> {
    let task = FrameTask {
        roll,
        friction,
        rotation,
        pulley_radius,
        reach: REACH * roll.largest_radius,
        clearance: CLEARANCE * roll.largest_radius,
        aim: goal.aim(friction),
        generations: GENERATIONS,
        seed,
    };
    let best = synthesis::synthesise(&task)?;
    let kept = STEPS.into_iter().filter_map(|step| rounded(&best.brake, step, &task).ok());
    let kept = kept.into_iter().find(|found| found.spread <= best.spread + ROUNDING);
    Ok(kept.unwrap_or(best))
}

fn rounded(brake: &Brake, step: f64, task: &FrameTask) -> Result<DesignedBrake, BrakeError> {
    // A quotient is the number nearest to the decimal one.
    let per_metre = (1.0 / step).round();
    let place = |at: [f64; 2]| at.map(|value| (value * per_metre).round() / per_metre + 0.0);
    let frame = brake.frame();
    let frame = BrakeFrame {
        pivot: place(frame.pivot),
        right_pulley: place(frame.right_pulley),
        left_pulley: place(frame.left_pulley),
        centre_of_gravity: place(frame.centre_of_gravity),
        pulley_radius: frame.pulley_radius,
    };
    let brake = Brake::new(frame, task.roll, task.friction, task.rotation)?;
    let spread = synthesis::spread(task, &brake);
    Ok(DesignedBrake { brake, spread })
}

/// The frame as lines of a machine file.
pub(super) fn lines(brake: &Brake) -> Vec<String> {
    let frame = brake.frame();
    let length = |metres: f64| {
        let millimetres = (1e9 * metres).round() / 1e6;
        format!("\"{} mm\"", millimetres + 0.0)
    };
    let pair = |name: &str, [x, y]: [f64; 2]| format!("{name} = [{}, {}]", length(x), length(y));
    vec![
        "[brake.frame]".into(),
        pair("pivot", frame.pivot),
        pair("right_pulley", frame.right_pulley),
        pair("left_pulley", frame.left_pulley),
        pair("centre_of_gravity", frame.centre_of_gravity),
        format!("pulley_radius = {}", length(frame.pulley_radius)),
    ]
}

/// The section of the report on a design.
pub(super) fn section(found: &DesignedBrake, goal: FrameGoal) -> Section {
    let (frame, brake) = (found.brake.frame(), &found.brake);
    let mm = |at: [f64; 2]| at.map(|value| MILLIMETRES * value);
    let value = json!({
        "goal": goal.word(),
        "spread": found.spread,
        "pivot_mm": mm(frame.pivot),
        "right_pulley_mm": mm(frame.right_pulley),
        "left_pulley_mm": mm(frame.left_pulley),
        "centre_of_gravity_mm": mm(frame.centre_of_gravity),
        "pulley_radius_mm": MILLIMETRES * frame.pulley_radius,
        "rotation": if brake.rotation() == RollRotation::Clockwise { "cw" } else { "ccw" },
    });
    let over = match goal {
        FrameGoal::Level => "over the roll".to_owned(),
        FrameGoal::Robust => {
            let friction = brake.friction();
            let (least, most) = ((1.0 - FRICTION_CHANGE) * friction, (1.0 + FRICTION_CHANGE) * friction);
            format!("over the roll and a friction from {least:.4} to {most:.4} together")
        }
    };
    let mut words = lines(brake);
    words.push(format!("# tension within {:.4} % {over}; weight = \"auto\"", 100.0 * found.spread));
    Section::new("design", &value).with_words(words)
}

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
/// Steps to which points are rounded, m: finer ones where the frame needs it.
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

/// What a frame is designed for.
pub(super) struct FrameNeeds {
    pub(super) roll: PaperRoll,
    pub(super) rotation: RollRotation,
    /// Radius of the pulleys, m.
    pub(super) pulley_radius: f64,
}

/// The best frame for a roll; points in whole millimetres, or finer if the frame needs that.
pub(super) fn designed(
    needs: &FrameNeeds,
    friction: f64,
    goal: FrameGoal,
    seed: u64,
) -> Result<DesignedBrake, Refusal> {
    let FrameNeeds { roll, rotation, pulley_radius } = *needs;
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
    let frame = brake.frame();
    let frame = BrakeFrame {
        pivot: frame.pivot.map(|metres| to_step(metres, per_metre)),
        right_pulley: frame.right_pulley.map(|metres| to_step(metres, per_metre)),
        left_pulley: frame.left_pulley.map(|metres| to_step(metres, per_metre)),
        centre_of_gravity: frame.centre_of_gravity.map(|metres| to_step(metres, per_metre)),
        pulley_radius: frame.pulley_radius,
    };
    let brake = Brake::new(frame, task.roll, task.friction, task.rotation)?;
    let spread = synthesis::spread(task, &brake);
    Ok(DesignedBrake { brake, spread })
}

/// A length of a whole number of steps, never −0.
fn to_step(metres: f64, steps_per_metre: f64) -> f64 {
    (metres * steps_per_metre).round() / steps_per_metre + 0.0
}

/// The frame as lines of a machine file.
pub(super) fn lines(brake: &Brake) -> Vec<String> {
    let frame = brake.frame();
    let points = [
        ("pivot", frame.pivot),
        ("right_pulley", frame.right_pulley),
        ("left_pulley", frame.left_pulley),
        ("centre_of_gravity", frame.centre_of_gravity),
    ];
    let mut lines = vec!["[brake.frame]".to_owned()];
    for (name, [x, y]) in points {
        lines.push(format!("{name} = [{}, {}]", quoted_length(x), quoted_length(y)));
    }
    lines.push(format!("pulley_radius = {}", quoted_length(frame.pulley_radius)));
    lines
}

fn quoted_length(metres: f64) -> String {
    let millimetres = (1e9 * metres).round() / 1e6;
    format!("\"{} mm\"", millimetres + 0.0)
}

/// The section of the report on a design.
pub(super) fn section(found: &DesignedBrake, goal: FrameGoal) -> Section {
    let (frame, brake) = (found.brake.frame(), &found.brake);
    let value = json!({
        "goal": goal.word(),
        "spread": found.spread,
        "pivot_mm": frame.pivot.map(|metres| MILLIMETRES * metres),
        "right_pulley_mm": frame.right_pulley.map(|metres| MILLIMETRES * metres),
        "left_pulley_mm": frame.left_pulley.map(|metres| MILLIMETRES * metres),
        "centre_of_gravity_mm": frame.centre_of_gravity.map(|metres| MILLIMETRES * metres),
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

//! Golden numbers of 30-digit arithmetic, first principles, random frames, and every refusal.

mod disc;
mod frames;
mod golden;
mod properties;
mod refusals;

use super::*;

/// Relative.
#[track_caller]
fn close(got: f64, want: f64, tolerance: f64) {
    assert!((got / want - 1.0).abs() < tolerance, "{got} is not {want}: {:e}", got / want - 1.0);
}

const ROLL: PaperRoll = PaperRoll { largest_radius: 0.6, smallest_radius: 0.05 };

/// `roll`: round numbers.
fn frame() -> BrakeFrame {
    BrakeFrame {
        pivot: [-1.1, 0.55],
        right_pulley: [0.5, 0.45],
        left_pulley: [-0.55, 0.45],
        centre_of_gravity: [0.1, 0.55],
        pulley_radius: 0.06,
    }
}

fn brake() -> Brake {
    Brake::new(frame(), ROLL, 0.25, RollRotation::Clockwise).expect("reaches")
}

#[track_caller]
fn at(brake: &Brake, radius: f64) -> FramePose {
    brake.at(radius).expect("within the roll")
}

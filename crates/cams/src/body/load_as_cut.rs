//! What presses a follower onto its cam, as far as a written outline shows it.

use camgen_kernel::motion::Jet;
use nalgebra::Vector2;

/// The load of a cam with the follower where an outline puts it.
pub trait LoadAsCut {
    /// Size of the residual force that the force balance leaves, N, at a parameter of a piece of the motion, with the follower `moved` (m)
    /// along its path from where the motion puts it, touching the cam where its normal is this unit vector out of the metal; 0 where
    /// nothing is to balance.
    fn unbalanced(&self, at: (usize, f64), moved: f64, normal: Vector2<f64>) -> f64;

    /// Parameters at which it may jump.
    fn jumps(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Force of the cam on the follower along its path, N, or its moment about the pivot of one that swings, N·m, and the torque of the
    /// shaft against it, N·m, at a parameter of a piece whose lift is known; `None` where no force is known.
    fn force_and_torque(&self, _at: (usize, f64), _lift: Jet) -> Option<[f64; 2]> {
        None
    }

    /// Whether the follower is that of another disc on the shaft, whose torque is that of both: so it is of the counter disc of a pair.
    fn is_of_another_disc(&self) -> bool {
        false
    }
}

//! Loads: the forces that press the follower onto the cam, and the force balance that the motion is made for. A cam may be without a load.

pub mod guide;
mod pressing;

pub use pressing::Pressing;

use crate::table::LoadState;
use camgen_kernel::motion::Jet;
use camgen_kernel::profile::extremes::JumpRange;
use std::fmt;
use std::sync::Arc;

/// A load on the follower of a disc cam. Parameters are those of the motion it belongs to.
pub trait Load: fmt::Debug + Send + Sync {
    /// The closed ranges of the parameter in which it acts on the first lobe: at their ends it may jump, to what it is inside.
    fn acting(&self) -> Vec<JumpRange>;

    /// Force that presses the follower onto the cam along its path, N; spring, weight and inertia of the follower itself
    /// come on top.
    fn pressing(&self, piece: usize, at: f64) -> f64 {
        self.pressing_when(piece, at, 0.0)
    }

    /// The force with the follower `moved` (m) along its path from where the motion puts it, N.
    fn pressing_when(&self, piece: usize, at: f64, moved: f64) -> f64;

    /// By how much the motion is above the law that the load is for, along the follower's path, m.
    fn added_lift(&self, _piece: usize, _at: f64) -> f64 {
        0.0
    }

    /// The residual force that the force balance leaves, N, with the follower `moved` (m) along its path from where the motion puts it; 0
    /// of a load that is not to be balanced.
    fn residual(&self, _piece: usize, _at: f64, _moved: f64) -> f64 {
        0.0
    }

    /// The residual force at another speed and under another load, N: given the square of the speed and the load, each over that of the
    /// design. The same as [`Self::residual`] where the load is not to be balanced.
    fn residual_as_made(&self, piece: usize, at: f64, moved: f64, _square_and_load: [f64; 2]) -> f64 {
        self.residual(piece, at, moved)
    }

    /// Largest force that the load is to balance, N; 0 where there is no such force.
    fn largest(&self) -> f64 {
        0.0
    }

    /// What moves behind the follower, at a place, with the lift of the motion there; `None` where it has no state of its own.
    fn state_and_lift(&self, _piece: usize, _at: f64) -> Option<(Arc<dyn LoadState>, Jet)> {
        None
    }
}

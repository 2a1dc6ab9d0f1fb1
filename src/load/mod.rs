//! Loads: what presses the follower onto the cam, and the force balance the motion is made for. A cam may have no load.

mod air_buffer;

pub use air_buffer::AirBuffer;
pub(crate) use air_buffer::air_law;

use crate::motion::State;
use crate::profile::extremes::Acting;
use crate::report::Section;
use nalgebra::Vector2;

/// A load on the follower of a disc cam. Parameters are those of the motion it belongs to.
pub trait Load: std::fmt::Debug + Send + Sync {
    /// The closed ranges of the parameter in which it acts: at their ends it may jump, to what it is inside.
    fn acting(&self) -> Vec<Acting>;

    /// Force that presses the follower onto the cam along its path, N; spring, weight and inertia of the follower itself
    /// come on top.
    fn pressing(&self, piece: usize, at: f64) -> f64;

    /// The residual force that the force balance leaves, inertia less air, N, with the follower `moved` (m) along its path from where
    /// the motion puts it and touching where the cam's normal (a unit vector out of the metal) is.
    fn residual(&self, piece: usize, at: f64, moved: f64, normal: Vector2<f64>) -> f64;

    /// The state of the machine.
    fn state(&self, piece: usize, at: f64) -> State;

    /// Largest inertia force that the load counteracts, N.
    fn largest(&self) -> f64;

    /// Residual force without a cam, N.
    fn left_without_cam(&self) -> f64;

    /// What the load contributes to the report.
    fn section(&self) -> Section;
}

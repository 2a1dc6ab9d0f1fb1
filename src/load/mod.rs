//! Loads: what presses the follower onto the cam, and what the cam has to balance. A cam without a load is still a cam.

mod air_buffer;

pub use air_buffer::AirBuffer;
pub(crate) use air_buffer::air_law;

use crate::motion::State;
use crate::report::Section;
use nalgebra::Vector2;

/// A load on the follower of a disc cam. Parameters are those of the motion it belongs to.
pub trait Load: std::fmt::Debug + Send + Sync {
    /// Force that presses the follower onto the cam along its path, N; spring, weight and inertia of the follower itself
    /// come on top.
    fn pressing(&self, piece: usize, at: f64) -> f64;

    /// |what must be balanced − what the cam balances|, N, with the follower `moved` (m) along its path from where the motion
    /// wants it and touching where the cam's normal (a unit vector out of the metal) is.
    fn residual(&self, piece: usize, at: f64, moved: f64, normal: Vector2<f64>) -> f64;

    /// Where the machine stands.
    fn state(&self, piece: usize, at: f64) -> State;

    /// Largest force that must be balanced, N.
    fn largest(&self) -> f64;

    /// What would be left of it without a cam, N.
    fn left_without_cam(&self) -> f64;

    /// What the load tells of itself in the report.
    fn section(&self) -> Section;
}

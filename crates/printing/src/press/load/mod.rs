//! The load of the cams of a press: air that is to balance the inertia of the bed.

use camgen_kernel::text::{Remedy, Text};
mod air_buffer;
mod shaft_work;

pub use air_buffer::AirBuffer;
pub(crate) use air_buffer::{air_law, balance_of, balance_row, closed_at};
pub use shaft_work::ShaftWork;

use camgen_kernel::numeric::root;
use camgen_kernel::profile::Worst;

/// The lift that a run-up adds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunUp {
    /// Travel of the bottom between dwell and start of the reversal, m.
    pub travel: f64,
    /// Stroke of the bed, m.
    pub stroke: f64,
    /// A width of the run-up whose travel is no longer than the stroke, rad of crank angle.
    pub width: f64,
}

impl RunUp {
    /// A run-up of a width before a law that starts with this slope and curvature by the crank angle, m: the travel of the quintic is
    /// |0.4 v w − a w²/20| (see `motion`).
    pub(crate) fn new(stroke: f64, width: f64, slope: f64, curvature: f64) -> Self {
        Self::along(stroke, width, |width| (0.4 * slope * width - curvature * width * width / 20.0).abs())
    }

    /// A run-up of a width, with the travel of the bottom by the width, m.
    pub(crate) fn along(stroke: f64, width: f64, travel: impl Fn(f64) -> f64) -> Self {
        let widest = root::bracketed(|width| travel(width) - stroke, 0.0, width, 0.0).unwrap_or(width);
        Self { travel: travel(width), stroke, width: widest }
    }
}

/// The force balance a cam is made for, N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance {
    /// Largest inertia force of the bed.
    pub inertia: f64,
    /// Residual force of a plain buffer with fixed bottom: without a cam.
    pub without_cam: f64,
    /// The forces balance in neither direction of the bed; the residual is equal in both.
    pub mean: bool,
}

/// Conditions under which an outline would keep the bottom off the piston, and the residual below half of the residual without a cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AsCut {
    /// Up to this speed of the main shaft, rpm; `None` where no lower one is enough.
    pub speed: Option<f64>,
    /// Within this tolerance, m.
    pub tolerance: f64,
}

/// The air column of a speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColumnAtSpeed {
    /// Its length where the reversal begins, m.
    pub length: f64,
    /// Speed of the main shaft, rpm.
    pub rpm: f64,
}

/// Share of what a fixed bottom leaves that a useful cam stays below.
pub const USEFUL: f64 = 0.5;

/// A cam that is made for a force balance, in the directions of the bed in which the forces are to balance.
pub trait ForceBalanced {
    /// The force balance that it is made for.
    fn balance(&self) -> Balance;

    /// Largest residual force of the motion itself, N, as if it were cut without error.
    fn residual_of_motion(&self) -> Worst;

    /// Largest residual force in the direction of the bed in which the forces are not to balance, N; `None` where they are to balance in both.
    fn residual_of_other_direction(&self) -> Option<Worst> {
        None
    }

    /// Changes, each of which alone brings the residual force of that direction below the residual without a cam.
    fn remedies_of_other_way(&self) -> Vec<Remedy> {
        Vec::new()
    }

    /// A change that leaves less in both directions where the forces balance in neither.
    fn remedy_of_mean(&self) -> Option<Text> {
        None
    }

    /// A speed and a tolerance that would keep the bottom off the piston where an outline within a tolerance (m) may miss the motion.
    fn as_cut(&self, _tolerance: f64) -> Option<AsCut> {
        None
    }

    /// Least air between piston and bottom while the bottom moves, m; `None` without air.
    fn least_air(&self) -> Option<Worst>;

    /// The air columns that it is made with.
    fn columns(&self) -> Vec<ColumnAtSpeed>;

    /// The lift that the run-up adds; `None` without one.
    fn run_up(&self) -> Option<RunUp>;
}

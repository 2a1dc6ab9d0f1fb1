//! Loads: what presses the follower onto the cam, and the force balance the motion is made for. A cam may have no load.

mod air_buffer;
pub mod guide;
mod pressing;
mod shaft_work;

pub use air_buffer::AirBuffer;
pub(crate) use air_buffer::{air_law, balance_of, balance_row, closed_at};
pub use pressing::Pressing;
pub use shaft_work::ShaftWork;

use crate::motion::counter_torque::Work;
use crate::motion::{Jet, State};
use crate::numeric::root;
use crate::profile::Worst;
use crate::profile::extremes::Acting;
use crate::report::Section;
use crate::table::BalanceRow;
use std::sync::Arc;

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
    /// Of a width before a law that starts with this slope and curvature by the crank angle, m: the travel of the quintic is
    /// |0.4 v w − a w²/20| (see `motion`).
    pub(crate) fn new(stroke: f64, width: f64, [slope, curvature]: [f64; 2]) -> Self {
        Self::along(stroke, width, |width| (0.4 * slope * width - curvature * width * width / 20.0).abs())
    }

    /// Of a width, with the travel of the bottom by the width, m.
    pub(crate) fn along(stroke: f64, width: f64, travel: impl Fn(f64) -> f64) -> Self {
        let beyond = |width: f64| travel(width) - stroke;
        Self { travel: travel(width), stroke, width: root::bracketed(beyond, 0.0, width, 0.0).unwrap_or(width) }
    }
}

/// A load on the follower of a disc cam. Parameters are those of the motion it belongs to.
pub trait Load: std::fmt::Debug + Send + Sync {
    /// The closed ranges of the parameter in which it acts on the first lobe: at their ends it may jump, to what it is inside.
    fn acting(&self) -> Vec<Acting>;

    /// Force that presses the follower onto the cam along its path, N; spring, weight and inertia of the follower itself
    /// come on top.
    fn pressing(&self, piece: usize, at: f64) -> f64 {
        self.pressing_in(&self.state(piece, at))
    }

    /// The same in a state of the machine.
    fn pressing_in(&self, state: &State) -> f64;

    /// The same with the follower `moved` (m) along its path from where the motion puts it.
    fn pressing_when(&self, piece: usize, at: f64, moved: f64) -> f64;

    /// What the motion is raised by over the law that the load is for, along the follower's path, m.
    fn raised(&self, _piece: usize, _at: f64) -> f64 {
        0.0
    }

    /// The residual force that the force balance leaves, inertia less air, N, with the follower `moved` (m) along its path from where
    /// the motion puts it.
    fn residual(&self, piece: usize, at: f64, moved: f64) -> f64 {
        self.residual_in(&self.state(piece, at), moved)
    }

    /// The same in a state of the machine.
    fn residual_in(&self, state: &State, moved: f64) -> f64;

    /// The forces that are to balance in a state of the machine, where the follower is as the motion has it.
    fn balance_row(&self, state: &State) -> BalanceRow;

    /// The state of the machine.
    fn state(&self, piece: usize, at: f64) -> State;

    /// The same, and the lift of the motion that it belongs to.
    fn state_and_lift(&self, piece: usize, at: f64) -> (State, Jet);

    /// Overrun of the bed at any angle of the crank, rad, in strokes.
    fn place(&self, crank: f64) -> f64;

    /// Largest inertia force that the load counteracts, N.
    fn largest(&self) -> f64;

    /// Residual force without a cam, N.
    fn left_without_cam(&self) -> f64;

    /// Least air between piston and bottom while the bottom moves, m; `None` without air.
    fn least_air(&self) -> Option<Worst>;

    /// The lift that a run-up before the load begins adds; `None` without one.
    fn run_up(&self) -> Option<RunUp>;

    /// The work of the shaft on the follower under this load, a preload (N), and a mass (kg) at an angular speed of the cam (rad/s);
    /// `None` where it is not known.
    fn shaft_work(&self, _preload: f64, _mass: (f64, f64)) -> Option<Arc<dyn Work>> {
        None
    }

    /// What the load contributes to the report.
    fn section(&self) -> Section;
}

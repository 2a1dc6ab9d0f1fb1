//! The roller of a barrel under force.

use super::contact::{AxisLine, RollerPath};
use super::{Barrel, FlankSide};
use crate::body::in_groove::{GrooveContact, InGroove};
use camgen_kernel::motion::Motion;

impl Barrel {
    /// Contact length of roller and flank, m: from the roller's inner end, or the floor, to the outer edge of the flank.
    fn length_of_contact(&self, axis: &AxisLine, flank: FlankSide) -> f64 {
        let at = |radius: f64| axis.on_cylinder(self.signed(flank), radius).map(|found| found.line.v);
        let [inner, _] = self.touched(axis);
        at(self.floor()).zip(at(self.outer)).map_or(0.0, |(floor, outer)| outer - inner.max(floor)).max(0.0)
    }
}

impl InGroove for Barrel {
    fn motion(&self) -> &dyn Motion {
        &*self.motion
    }

    fn rpm(&self) -> Option<f64> {
        self.rpm
    }

    fn roller(&self) -> f64 {
        self.roller
    }

    fn contacts(&self, (piece, angle): (usize, f64), lifting: bool) -> Vec<GrooveContact> {
        let lift = self.motion.jet(piece, angle);
        let axis = self.path.at(&lift);
        let [inner, outer] = self.touched(&axis);
        let middle = 0.5 * (inner + outer);
        let line = axis.point(middle);
        let (leverage, carrier_turn) = match self.path {
            RollerPath::Straight { .. } => (1.0, [0.0; 2]),
            RollerPath::Arm { arm, side, .. } => (arm, [side * lift.ds, side * lift.dds]),
        };
        // The flank that lifts lies below.
        let curvatures = [-self.distances[1], self.distances[0]].map(|distance| {
            let flank = |v: f64| axis.point(v).reduced_curvature(&axis, distance) - distance.abs().recip();
            self.roller.recip() + flank(inner).max(flank(middle)).max(flank(outer))
        });
        vec![GrooveContact {
            roller: 0,
            length: self.length_of_contact(&axis, if lifting { FlankSide::Lower } else { FlankSide::Upper }),
            pressure_angle: self.path.pressure_angle(&lift, middle),
            leverage,
            curvatures,
            by_path: [line.speed, line.speed_slope(&axis)].map(|speed| speed / self.roller),
            carrier_turn,
        }]
    }
}

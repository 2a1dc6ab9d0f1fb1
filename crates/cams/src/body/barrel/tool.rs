//! The barrel under a tool of a machine with four axes.

use super::contact::AxisLine;
use super::{Barrel, FlankSide};
use crate::body::swept::{TurnedCam, TurnedFlank};
use camgen_kernel::geometry::MILLIMETRES;

impl Barrel {
    /// Radius of a tool as wide as the groove, m.
    pub(super) fn widest(&self) -> f64 {
        0.5 * self.distances.iter().sum::<f64>()
    }

    /// Distance of the axis of a tool of a radius (m) above the roller's centre line, m: next to a flank, or in the middle between both.
    pub(super) fn tool_offset(&self, flank: Option<FlankSide>, tool: f64) -> f64 {
        flank.map_or(0.5 * (self.distances[0] - self.distances[1]), |flank| {
            let distance = self.signed(flank);
            distance - distance.signum() * tool
        })
    }

    /// Where the groove is half as deep, from the axis, m.
    pub(super) fn half_deep(&self) -> f64 {
        self.outer - 0.5 * self.depth
    }

    fn axis_at(&self, a_deg: f64) -> AxisLine {
        let (piece, angle) = self.motion.locate((self.sense() * a_deg).to_radians());
        self.axis(piece, angle)
    }
}

impl TurnedCam for Barrel {
    fn widest_tool(&self) -> f64 {
        self.widest()
    }

    fn depth(&self) -> f64 {
        self.depth
    }

    fn outside(&self) -> f64 {
        self.outer
    }

    fn joints(&self) -> Vec<f64> {
        let lobes = self.motion.lobes();
        let turn = std::f64::consts::TAU / f64::from(lobes);
        let start = self.motion.range().0;
        let of_lobe = |lobe: u32| {
            let ends = self.motion.pieces().iter().map(|piece| piece.end - start);
            ends.map(move |end| f64::from(lobe) * turn + end).collect::<Vec<f64>>()
        };
        let all = (0..lobes).flat_map(of_lobe).map(|at| (start + at).to_degrees());
        std::iter::once(start.to_degrees()).chain(all).map(|at| self.sense() * at).collect()
    }

    fn tool_place(&self, flank: Option<TurnedFlank>, tool: f64, a_deg: f64) -> [f64; 2] {
        let axis = self.axis_at(a_deg);
        let (sin, cos) = axis.point(axis.at_distance(self.half_deep())).slope;
        let side = flank.map(|flank| match flank {
            TurnedFlank::Upper => FlankSide::Upper,
            TurnedFlank::Lower => FlankSide::Lower,
        });
        let away = self.tool_offset(side, tool);
        // Y of a machine with X along the cam and Z outwards is against the angle of the drawing.
        let beside = -self.sense() * (axis.across[0] - away * sin);
        [axis.along[0] + away * cos, beside].map(|length| MILLIMETRES * length)
    }

    fn across(&self, a_deg: f64, [along, beside]: [f64; 2]) -> f64 {
        let axis = self.axis_at(a_deg);
        let of = |from_axis: f64| {
            let (sin, cos) = axis.point(axis.at_distance(from_axis)).slope;
            along * cos + self.sense() * beside * sin
        };
        let [floor, outside] = [self.floor(), self.outer].map(of);
        if floor.abs() > outside.abs() { floor } else { outside }
    }
}

//! The barrel under a tool of a machine with four axes.

use super::{Barrel, BarrelLine, BarrelRoller};
use crate::body::swept::{FlankSide, RollerLine, TurnedCam};
use camgen_kernel::geometry::MILLIMETRES;

impl<R: BarrelRoller> Barrel<R> {
    /// Where the groove is half as deep, from the axis, m.
    pub(super) fn half_deep(&self) -> f64 {
        self.outer - 0.5 * self.depth
    }

    fn axis_at(&self, a_deg: f64) -> R::Line {
        let (piece, angle) = self.groove.motion.locate((self.groove.sense() * a_deg).to_radians());
        self.axis(piece, angle)
    }
}

impl<R: BarrelRoller> TurnedCam for Barrel<R> {
    fn widest_tool(&self) -> f64 {
        self.groove.widest_tool()
    }

    fn depth(&self) -> f64 {
        self.depth
    }

    fn outside(&self) -> f64 {
        self.outer
    }

    fn joints(&self) -> Vec<f64> {
        let lobes = self.groove.motion.lobes();
        let turn = std::f64::consts::TAU / f64::from(lobes);
        let start = self.groove.motion.range().0;
        let of_lobe = |lobe: u32| {
            let ends = self.groove.motion.pieces().iter().map(|piece| piece.end - start);
            ends.map(move |end| f64::from(lobe) * turn + end).collect::<Vec<f64>>()
        };
        let all = (0..lobes).flat_map(of_lobe).map(|at| (start + at).to_degrees());
        std::iter::once(start.to_degrees()).chain(all).map(|at| self.groove.sense() * at).collect()
    }

    fn tool_place(&self, flank: Option<FlankSide>, tool: f64, a_deg: f64) -> [f64; 2] {
        let axis = self.axis_at(a_deg);
        let (sin, cos) = axis.point(axis.axis().at_distance(self.half_deep())).slope;
        let away = self.groove.tool_offset(flank, tool);
        // Y of a machine with X along the cam and Z outwards is against the angle of the drawing.
        let beside = -self.groove.sense() * (axis.axis().across[0] - away * sin);
        [axis.axis().along[0] + away * cos, beside].map(|length| MILLIMETRES * length)
    }

    fn across(&self, a_deg: f64, [along, beside]: [f64; 2]) -> f64 {
        let axis = self.axis_at(a_deg);
        let of = |from_axis: f64| {
            let (sin, cos) = axis.point(axis.axis().at_distance(from_axis)).slope;
            along * cos + self.groove.sense() * beside * sin
        };
        let [floor, outside] = [self.floor(), self.outer].map(of);
        if floor.abs() > outside.abs() { floor } else { outside }
    }
}

//! The buffers at the two ends of the stroke: force of the air and travel of the bottoms during the reversal.

use crate::press::bed_motion::{End, Linkage, StrokeEnd, turned};
use crate::press::buffer::Cylinder;
use crate::press::buffer::crank_law::CrankLaw;
use crate::press::machine::Press;

/// The air where a buffer acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct AirForce {
    /// Force of the air, N, with the sign of the inertia force that it balances.
    pub(super) force: f64,
    /// Δx of the bottom, m.
    pub(super) displacement: f64,
}

/// A pair of cylinders at an end of the stroke.
#[derive(Debug, Clone, Copy)]
struct BufferPair {
    end: StrokeEnd,
    cylinder: Cylinder,
    law: CrankLaw,
}

impl BufferPair {
    fn new(press: &Press, linkage: Linkage, rpm: f64, end: End) -> Option<Self> {
        let end = StrokeEnd::new(linkage, press.bed.crank_radius, end)?;
        let press = Press { stroke_end: Some(end), ..*press };
        Some(Self { end, cylinder: press.cylinder(), law: press.bottom_law(rpm) })
    }
}

/// The buffers of both ends, each with cylinders and law of its own; between them they take the whole turn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Buffers([BufferPair; 2]);

impl Buffers {
    /// The buffers of a press whose bed is moved by this linkage, at a speed of its main shaft, rpm; `None` where no buffer can balance it.
    pub(super) fn new(press: &Press, linkage: Linkage, rpm: f64) -> Option<Self> {
        Some(Self([
            BufferPair::new(press, linkage, rpm, End::Outer)?,
            BufferPair::new(press, linkage, rpm, End::Inner)?,
        ]))
    }

    /// With the driving crank at θ from the base.
    pub(super) fn force_at(&self, theta: f64) -> Option<AirForce> {
        let buffer = self.0.iter().find(|buffer| turned(theta - buffer.end.start()) <= buffer.end.angle())?;
        let angle = turned(theta - buffer.end.start());
        let displacement = buffer.law.displacement(angle);
        let [x, _] = buffer.law.bed(angle);
        // By the gas itself: p V^k with the piston at x and the bottom at Δx.
        let (column, k) = (buffer.law.column(), buffer.law.exponent());
        let left = column - (x + buffer.law.lead()) - displacement;
        let force = buffer.cylinder.unit_force() * libm::expm1(k * libm::log(column / left));
        let sign = if buffer.end.end() == End::Outer { 1.0 } else { -1.0 };
        Some(AirForce { force: sign * force, displacement })
    }
}

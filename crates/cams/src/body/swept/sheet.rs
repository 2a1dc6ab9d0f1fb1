//! Marks that the review sheets of swept cams share.

use crate::machine::Machine;
use crate::report::sheet::{Dimensions, Mark};
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::Vector2;

/// A dimension between two points, mm, whose line stands off in a direction.
pub(crate) fn dimension(from: Vector2<f64>, to: Vector2<f64>, away: Vector2<f64>, text: String) -> Mark {
    Mark::Distance { from, to, away, text }
}

/// The diameter of the bore with its fit, above the point at which the axis leaves the cam, mm; `None` without a bore.
pub(crate) fn bore_mark(machine: &Machine, top: Vector2<f64>) -> Option<Mark> {
    let radius = MILLIMETRES * machine.cam.bore_radius?;
    let fit = machine.cam.bore_fit.map_or(String::new(), |fit| format!(" {fit}"));
    let text = format!("Ø{}{fit}", machine.units().dimension(2.0 * radius));
    let half = Vector2::new(radius, 0.0);
    Some(dimension(top - half, top + half, Vector2::new(0.0, 1.0), text))
}

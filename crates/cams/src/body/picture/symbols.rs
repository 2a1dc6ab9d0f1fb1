//! The usual symbols of a mechanism: the frame, what holds a pivot, springs.

use crate::report::mechanism::line;
use crate::report::sheet::SheetShape;
use nalgebra::Vector2;

/// Height of what holds a pivot, over half the width of its foot.
pub(super) const FOOT: f64 = 1.6;
/// Least length of a drawn spring over half its width, and the turns of one.
pub(super) const SPRING_SOLID: f64 = 2.5;
const COILS: u32 = 6;
/// Turns of a spring about a pivot, and the places of one that are drawn.
const SPIRAL_TURNS: f64 = 2.75;
const SPIRAL_PLACES: u32 = 66;
/// Strokes of the hatching of the frame.
const STROKES: u32 = 6;

/// What holds a pivot at a place, with half the width of its foot, mm, above it (1) or below it (-1).
#[must_use]
pub fn bracket(place: Vector2<f64>, (foot, above): (f64, f64)) -> Vec<SheetShape> {
    let high = above * FOOT * foot;
    let corners = [(0.0, 0.0), (-foot, high), (foot, high), (0.0, 0.0)];
    let triangle = SheetShape::Path(corners.map(|(x, y)| place + Vector2::new(x, y)).to_vec());
    std::iter::once(triangle).chain(frame(place + Vector2::new(0.0, high), (1.5 * foot, above))).collect()
}

/// The frame at a place: a line of half this length, hatched above (1) or below (-1).
pub(super) fn frame(place: Vector2<f64>, (half, above): (f64, f64)) -> Vec<SheetShape> {
    let step = 2.0 * half / f64::from(STROKES);
    let stroke = |index: u32| {
        let x = place.x - half + step * f64::from(index);
        line((x, place.y), (x + step, place.y + above * step))
    };
    std::iter::once(line((place.x - half, place.y), (place.x + half, place.y)))
        .chain((0..STROKES).map(stroke))
        .collect()
}

/// A spring of unit length along x, of half this width, mm.
pub(super) fn coil(half: f64) -> SheetShape {
    let step = 1.0 / f64::from(2 * COILS);
    let corner = |index: u32| {
        let side = if index.is_multiple_of(2) { half } else { -half };
        Vector2::new((f64::from(index) + 0.5) * step, side)
    };
    let mut points = vec![Vector2::zeros()];
    points.extend((0..2 * COILS).map(corner));
    points.push(Vector2::new(1.0, 0.0));
    SheetShape::Path(points)
}

/// A spring about a pivot, from a hub of this radius to what holds it above, mm.
pub(super) fn spiral(hub: f64, reach: f64) -> SheetShape {
    let at = |index: u32| {
        let share = f64::from(index) / f64::from(SPIRAL_PLACES);
        let (sin, cos) = libm::sincos((share - 1.0) * SPIRAL_TURNS * std::f64::consts::TAU);
        // It ends above the pivot.
        Vector2::new(-sin, cos) * (hub + share * (reach - hub))
    };
    SheetShape::Path((0..=SPIRAL_PLACES).map(at).collect())
}

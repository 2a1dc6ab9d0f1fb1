//! A cubic curve that turns little by its own length: points, and where a normal of another curve meets it.

use super::cubic::Cubic;
use nalgebra::Vector2;

/// Newton steps for a length or a crossing, which converge at once on a curve that turns little and runs evenly.
const STEPS: u32 = 24;
/// A parameter is found when it moves by no more than this.
const SETTLED: f64 = 1e-16;
/// Beyond its ends by more than this, as a parameter, no crossing is looked for.
const BEYOND: f64 = 1.0;

/// A part of a cubic curve.
#[derive(Debug, Clone, Copy)]
pub(super) struct CubicPath {
    cubic: Cubic,
    /// Length, mm.
    pub(super) length: f64,
}

impl CubicPath {
    /// The parts of a cubic curve with a length above 0.
    pub(super) fn parts(cubic: &Cubic) -> impl Iterator<Item = Self> {
        let parts = cubic.smooth_parts().into_iter().map(|(cubic, _)| Self { cubic, length: cubic.length_to(1.0) });
        parts.filter(|path| path.length > 0.0)
    }

    pub(super) fn start(&self) -> Vector2<f64> {
        self.cubic.points[0]
    }

    /// The parameter at a length from the start, mm.
    fn parameter(&self, length: f64) -> f64 {
        let mut t = length / self.length;
        if !(t > 0.0 && t < 1.0) {
            return t.clamp(0.0, 1.0);
        }
        for _ in 0..STEPS {
            let next = t - (self.cubic.length_to(t) - length) / self.cubic.derivatives(t)[1].norm();
            let next = if next.is_finite() { next.clamp(0.0, 1.0) } else { t };
            let moved = (next - t).abs();
            t = next;
            if moved <= SETTLED + f64::EPSILON * t {
                break;
            }
        }
        t
    }

    /// The length from the start up to a parameter, going on straight beyond the ends.
    fn length_at(&self, t: f64) -> f64 {
        if t <= 0.0 {
            t * self.cubic.derivatives(0.0)[1].norm()
        } else if t >= 1.0 {
            self.length + (t - 1.0) * self.cubic.derivatives(1.0)[1].norm()
        } else {
            self.cubic.length_to(t)
        }
    }

    /// Point and unit tangent at a length from the start, mm.
    pub(super) fn point_and_tangent(&self, length: f64) -> (Vector2<f64>, Vector2<f64>) {
        self.cubic.point_and_tangent(self.parameter(length))
    }

    /// The interval in which the curvature lies between two lengths, 1/mm.
    pub(super) fn curvature_between(&self, from: f64, to: f64) -> (f64, f64) {
        self.cubic.curvature_between(self.parameter(from), self.parameter(to))
    }

    /// As [`super::edge_path::EdgePath::hit`].
    pub(super) fn hit(&self, point: Vector2<f64>, direction: Vector2<f64>) -> Option<(f64, f64)> {
        // Ahead of the line the product with its left is positive.
        let left = Vector2::new(-direction.y, direction.x);
        let [first, last] = [0.0, 1.0].map(|t| (self.cubic.derivatives(t)[0] - point).dot(&left));
        let mut t = (first / (first - last)).clamp(-BEYOND, 1.0 + BEYOND);
        for _ in 0..STEPS {
            let [place, slope, _] = self.cubic.derivatives(t);
            let rate = slope.dot(&left);
            if !(rate > 0.0) {
                return None;
            }
            let next = (t - (place - point).dot(&left) / rate).clamp(-BEYOND, 1.0 + BEYOND);
            let moved = (next - t).abs();
            t = next;
            if moved <= SETTLED + f64::EPSILON * t.abs() {
                break;
            }
        }
        let away = (self.cubic.derivatives(t)[0] - point).dot(&direction);
        away.is_finite().then(|| (away, self.length_at(t)))
    }

    /// The length from the start to the place nearest to a point, mm.
    pub(super) fn nearest(&self, point: Vector2<f64>) -> f64 {
        self.length_at(self.cubic.nearest_parameter(point))
    }

    /// The largest distance from a point between two lengths, mm.
    pub(super) fn farthest_from(&self, point: Vector2<f64>, from: f64, to: f64) -> f64 {
        self.cubic.farthest_from(point, self.parameter(from), self.parameter(to))
    }
}

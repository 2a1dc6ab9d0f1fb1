//! Where a block's drawing is placed: an affine map of the plane, with the heights.

use nalgebra::{Vector2, Vector3};

/// Skewness up to which a map counts as a similarity, so that arcs stay arcs: rounding.
const SKEW: f64 = 1e-12;

/// An affine map of the plane of the drawing, and of the heights above it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BlockPlacement {
    /// Images of the unit vectors.
    x: Vector2<f64>,
    y: Vector2<f64>,
    origin: Vector2<f64>,
    /// Height of the origin, and what a height is multiplied by.
    height: f64,
    upwards: f64,
}

impl BlockPlacement {
    /// The identity.
    pub(super) fn unchanged() -> Self {
        Self { x: Vector2::x(), y: Vector2::y(), origin: Vector2::zeros(), height: 0.0, upwards: 1.0 }
    }

    /// Seen from behind (an extrusion along −Z): x and the heights are reversed, by the arbitrary axis rule of the DXF
    /// reference.
    pub(super) fn from_behind() -> Self {
        Self { x: -Vector2::x(), upwards: -1.0, ..Self::unchanged() }
    }

    /// Scaled, turned by an angle (rad) and moved, in this order.
    pub(super) fn of(scale: Vector3<f64>, angle: f64, moved: Vector3<f64>) -> Self {
        let (sin, cos) = quarter_exact(angle);
        Self {
            x: Vector2::new(cos, sin) * scale.x,
            y: Vector2::new(-sin, cos) * scale.y,
            origin: moved.xy(),
            height: moved.z,
            upwards: scale.z,
        }
    }

    /// A translation.
    pub(super) fn moved(by: Vector3<f64>) -> Self {
        Self { origin: by.xy(), height: by.z, ..Self::unchanged() }
    }

    /// This map applied after another.
    pub(super) fn after(&self, first: &Self) -> Self {
        Self {
            x: self.direction(first.x),
            y: self.direction(first.y),
            origin: self.point(first.origin),
            height: self.height(first.height),
            upwards: self.upwards * first.upwards,
        }
    }

    pub(super) fn direction(&self, v: Vector2<f64>) -> Vector2<f64> {
        self.x * v.x + self.y * v.y
    }

    pub(super) fn point(&self, p: Vector2<f64>) -> Vector2<f64> {
        self.origin + self.direction(p)
    }

    pub(super) fn height(&self, z: f64) -> f64 {
        self.height + self.upwards * z
    }

    /// Whether it maps the plane onto a line or a point.
    pub(super) fn is_degenerate(&self) -> bool {
        !(self.x.perp(&self.y).abs() > SKEW * self.x.norm() * self.y.norm())
    }

    /// Whether it mirrors the plane.
    pub(super) fn mirrors(&self) -> bool {
        self.x.perp(&self.y) < 0.0
    }

    /// Whether circles stay circles.
    pub(super) fn keeps_circles(&self) -> bool {
        let (x, y) = (self.x.norm(), self.y.norm());
        (x - y).abs() <= SKEW * x && self.x.dot(&self.y).abs() <= SKEW * x * y
    }

    pub(super) fn is_finite(&self) -> bool {
        let all = [self.x, self.y, self.origin];
        all.iter().all(|v| v.x.is_finite() && v.y.is_finite()) && self.height.is_finite() && self.upwards.is_finite()
    }
}

/// Sine and cosine of an angle (rad), exact for whole quarters of a turn.
fn quarter_exact(angle: f64) -> (f64, f64) {
    let quarters = angle / std::f64::consts::FRAC_PI_2;
    if quarters != quarters.round() {
        return (libm::sin(angle), libm::cos(angle));
    }
    match quarters.rem_euclid(4.0) {
        1.0 => (1.0, 0.0),
        2.0 => (0.0, -1.0),
        3.0 => (-1.0, 0.0),
        _ => (0.0, 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_are_applied_one_after_the_other() {
        let point = Vector2::new(3.0, 4.0);
        let turned = BlockPlacement::of(Vector3::new(2.0, 2.0, 2.0), 90_f64.to_radians(), Vector3::new(1.0, 1.0, 5.0));
        assert_eq!(turned.point(point), Vector2::new(-7.0, 7.0));
        assert_eq!(turned.height(1.0), 7.0);
        assert!(turned.keeps_circles() && !turned.mirrors() && !turned.is_degenerate());
        let behind = BlockPlacement::from_behind().after(&turned);
        assert_eq!(behind.point(point), Vector2::new(7.0, 7.0));
        assert_eq!(behind.height(1.0), -7.0);
        assert!(behind.keeps_circles() && behind.mirrors());
        let oblong = BlockPlacement::of(Vector3::new(2.0, -1.0, 1.0), 0.3, Vector3::zeros());
        assert!(!oblong.keeps_circles() && oblong.mirrors());
        assert!(BlockPlacement::of(Vector3::new(2.0, 0.0, 1.0), 0.3, Vector3::zeros()).is_degenerate());
    }
}

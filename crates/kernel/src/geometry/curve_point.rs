//! A point of a plane curve with everything that follows from its first three derivatives.

use nalgebra::Vector2;

/// A vector rotated by an angle of which sine and cosine are given.
#[inline]
#[must_use]
pub fn rotated(v: Vector2<f64>, sin: f64, cos: f64) -> Vector2<f64> {
    Vector2::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y)
}

/// A vector rotated by 90° to the left.
#[inline]
#[must_use]
pub fn left_of(v: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-v.y, v.x)
}

/// A point of a plane curve with its tangent and curvature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurvePoint {
    /// The point.
    pub point: Vector2<f64>,
    /// Unit tangent in the direction of growing parameter.
    pub tangent: Vector2<f64>,
    /// Arc length per unit of the parameter; negative where an offset has turned back on itself.
    pub speed: f64,
    /// Curvature, positive where the curve turns left.
    pub curvature: f64,
    /// Derivative of the curvature by the arc length.
    pub curvature_slope: f64,
}

impl CurvePoint {
    /// From the first three derivatives by the parameter.
    ///
    /// κ = C'×C''/ℓ³ and dκ/dt = C'×C'''/ℓ³ − 3 κ (C'·C'')/ℓ², ℓ = |C'|.
    #[must_use]
    pub fn from_derivatives(
        point: Vector2<f64>,
        first: Vector2<f64>,
        second: Vector2<f64>,
        third: Vector2<f64>,
    ) -> Self {
        let speed = first.norm();
        let cube = speed * speed * speed;
        let curvature = first.perp(&second) / cube;
        let by_parameter = first.perp(&third) / cube - 3.0 * curvature * first.dot(&second) / (speed * speed);
        Self { point, tangent: first / speed, speed, curvature, curvature_slope: by_parameter / speed }
    }

    /// The unit normal to the right of the tangent: outward for a curve that runs counter-clockwise.
    #[must_use]
    pub fn outward(&self) -> Vector2<f64> {
        Vector2::new(self.tangent.y, -self.tangent.x)
    }

    /// The curve in a unit `factor` times smaller, 1000 for millimetres.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            point: self.point * factor,
            tangent: self.tangent,
            speed: self.speed * factor,
            curvature: self.curvature / factor,
            curvature_slope: self.curvature_slope / (factor * factor),
        }
    }

    /// The parallel curve at `distance` to the left (inward), with the same parameter.
    ///
    /// With m = 1 − κ·distance: speed × m, curvature / m, curvature slope / m³.
    #[must_use]
    pub fn offset_inward(&self, distance: f64) -> Self {
        let m = 1.0 - self.curvature * distance;
        Self {
            point: self.point - self.outward() * distance,
            tangent: self.tangent,
            speed: self.speed * m,
            curvature: self.curvature / m,
            curvature_slope: self.curvature_slope / (m * m * m),
        }
    }
}

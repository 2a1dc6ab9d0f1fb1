//! Allowed errors of the direction and the curvature of a chain.

use super::CurvePoint;

/// Allowed errors of a chain of arcs or polynomials at one place of the curve, in addition to the distance.
///
/// The heading of an outline is the velocity of a follower and its curvature the acceleration: to first order
/// δs' = (ℓ/cos α) δheading and δs'' = −(ℓ²/cos α) δκ, ℓ = ds/dθ of the outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChainTolerance {
    /// Largest angle between the tangents, rad; infinite where it does not matter.
    pub heading: f64,
    /// Largest difference of the curvatures, over the unit of the curve; infinite where it does not matter.
    pub curvature: f64,
    /// How far the middle of the allowed curvatures lies above that of the curve.
    pub middle: f64,
    /// The derivatives of the middle and of the logarithm of the largest difference by the length.
    pub slopes: [f64; 2],
}

/// A radius may be off by at most this share of itself: beyond it the curvatures of both sides differ too much for one band.
const MOST_OF_RADIUS: f64 = 0.6;

impl ChainTolerance {
    /// Only the distance matters.
    pub const ANY: Self = Self::symmetric(f64::INFINITY, f64::INFINITY);

    /// Errors of the heading and of the curvature that are equal on both sides, and change little along an arc.
    #[must_use]
    pub const fn symmetric(heading: f64, curvature: f64) -> Self {
        Self { heading, curvature, middle: 0.0, slopes: [0.0; 2] }
    }

    /// Errors of the heading and of the radius of curvature, at a point of a convex curve: the acceleration under a flat face is the
    /// radius but for terms without it, so that near a small radius the curvature may be off by much, and more upwards than downwards.
    ///
    /// With u = κ e, e the error of the radius, the curvatures from κ/(1 + u) to κ/(1 − u) are allowed; the middle lies κ u²/(1 − u²)
    /// above κ, the ends κ u/(1 − u²) from it.
    #[must_use]
    pub fn of_radius(heading: f64, error: f64, point: &CurvePoint) -> Self {
        let (kappa, slope) = (point.curvature, point.curvature_slope);
        let share = kappa * error;
        let u = share.min(MOST_OF_RADIUS);
        let (square, rest) = (u * u, 1.0 - u * u);
        // By κ with e fixed, or with u fixed where it is the largest.
        let (middle, growth) = if share < MOST_OF_RADIUS {
            (square * (3.0 - square) / (rest * rest), 2.0 / (kappa * rest))
        } else {
            (square / rest, 1.0 / kappa)
        };
        Self {
            heading,
            curvature: kappa * u / rest,
            middle: kappa * square / rest,
            slopes: [slope * middle, slope * growth],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    /// The ends of the band are the curvatures of the radii that are off by the error, and its slopes are those between two points.
    #[test]
    fn a_radius_off_by_its_error_is_at_an_end_of_the_band() {
        let at = |along: f64| {
            let curvature = 0.02 + 0.003 * along;
            let (point, tangent) = (Vector2::zeros(), Vector2::x());
            CurvePoint { point, tangent, speed: 1.0, curvature, curvature_slope: 0.003 }
        };
        let step = 1e-4;
        for error in [0.5, 5.0, 25.0, 29.0, 40.0] {
            let band = |along: f64| ChainTolerance::of_radius(1.0, error, &at(along));
            let here = band(0.0);
            let allowed = f64::min(error, 0.6 * 50.0);
            for (side, radius) in [(-1.0, 50.0 + allowed), (1.0, 50.0 - allowed)] {
                let end = 0.02 + here.middle + side * here.curvature;
                assert!((end * radius - 1.0).abs() < 1e-12, "{error}: {end} {radius}");
            }
            let (before, after) = (band(-step), band(step));
            let [middle, growth] = here.slopes;
            let slope = |a: f64, b: f64| (b - a) / (2.0 * step);
            assert!((slope(before.middle, after.middle) / middle - 1.0).abs() < 1e-6, "{error}");
            let logarithm = slope(before.curvature.ln(), after.curvature.ln());
            assert!((logarithm / growth - 1.0).abs() < 1e-6, "{error}: {logarithm} {growth}");
        }
    }
}

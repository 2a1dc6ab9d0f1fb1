//! By how much the direction and the curvature of a chain may miss those of the curve it follows.

/// What a chain of arcs or polynomials may miss a curve by at one place, beside the distance.
///
/// A follower feels the heading of an outline as its velocity and the curvature as its acceleration: to first order
/// δs' = (ℓ/cos α) δheading and δs'' = −(ℓ²/cos α) δκ, ℓ = ds/dθ of the outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allowed {
    /// Largest angle between the tangents, rad; infinite where it does not matter.
    pub heading: f64,
    /// Largest difference of the curvatures, over the unit of the curve; infinite where it does not matter.
    pub curvature: f64,
}

impl Allowed {
    /// Nothing but the distance matters.
    pub const ANY: Self = Self { heading: f64::INFINITY, curvature: f64::INFINITY };
}

//! The centre line of a roller at a cam angle, and the contact with both flanks at each of its places.
//!
//! A place C(v) of the line with the direction a moves by V = |V| t + s a with the cam angle, as seen from the cam. The flank touches the roller where the
//! normal is n = a × t; the flanks are X = C ± r n. The normal changes by −τ t − q a with the cam angle and by −χ_v t along the roller. Folds and
//! curvatures of every such flank follow from s, τ, q and χ_v; a body states these.

/// A place of the centre line with the contact there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LinePoint {
    /// Along the roller, m.
    pub(crate) v: f64,
    /// Sine and cosine of χ, the angle between t and the circumference of the cam.
    pub(crate) slope: (f64, f64),
    /// |V| across the roller, m.
    pub(crate) speed: f64,
    /// s, how fast the place moves along the roller, m.
    pub(crate) slide: f64,
    /// τ, how fast the normal turns about the roller.
    pub(crate) turn: f64,
    /// χ_v, 1/m.
    pub(crate) turn_along: f64,
    /// q, how fast the normal tips along the roller.
    pub(crate) tip: f64,
}

/// Steps of a flank: along t and along a with the cam angle, and along t with v; along a a step with v is 1.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlankSteps {
    pub(crate) across: f64,
    pub(crate) along: f64,
    pub(crate) across_by_v: f64,
}

impl FlankSteps {
    /// The area of the flank by the cam angle and by v: 0 where it folds.
    pub(crate) fn area(&self) -> f64 {
        self.across - self.along * self.across_by_v
    }
}

/// The centre line of a roller at a cam angle.
pub(crate) trait RollerLine {
    /// The contact at a place along the roller, m.
    fn point(&self, v: f64) -> LinePoint;

    /// Derivative of |V| at a place by the cam angle, m.
    fn speed_slope(&self, point: &LinePoint) -> f64;

    /// The reduced curvature of the line of contact on the flank at a signed distance, 1/m: 1/r and both principal curvatures of the flank, convex
    /// positive. The shape of a surface that holds a straight line for both roller and flank is the change of the normal along t for a step along t.
    fn reduced_curvature(&self, point: &LinePoint, distance: f64) -> f64 {
        let steps = point.steps(distance);
        // A step along a: by the angle −by_v/area, by v across/area.
        let along = point.tip * steps.across_by_v / steps.area();
        1.0 / distance.abs() - distance.signum() * (along + point.bend_across(&steps))
    }

    /// That curvature with a roller of a radius, m, in the place of one that fills the groove.
    fn curvature_under(&self, point: &LinePoint, distance: f64, roller: f64) -> f64 {
        roller.recip() + (self.reduced_curvature(point, distance) - distance.abs().recip())
    }

    /// The smallest distance from the centre line, m, above it (sign 1) or below it (−1), at which the flank folds over itself.
    fn folds_at(&self, point: &LinePoint, sign: f64) -> f64 {
        point.folds_at(sign)
    }

    /// Radius at a place along a roller, or distance of a flank, m, whose radius is given on the outside of the cam.
    fn radius_at(&self, _v: f64, radius: f64) -> f64 {
        radius
    }

    /// Angle between the normal of a flank and the path of the roller, rad, whose angle in the plane across the roller is given.
    fn normal_angle(&self, in_plane: f64) -> f64 {
        in_plane
    }

    /// Length of a line along the roller's surface over that along its axis.
    fn slant(&self) -> f64 {
        1.0
    }
}

impl LinePoint {
    /// The steps of the flank at a signed distance, m.
    pub(crate) fn steps(&self, distance: f64) -> FlankSteps {
        FlankSteps {
            across: self.speed - distance * self.turn,
            along: self.slide - distance * self.tip,
            across_by_v: -distance * self.turn_along,
        }
    }

    /// How fast the normal of a flank turns along t for a step along t, by the angle 1/area and by v −along/area, 1/m.
    pub(crate) fn bend_across(&self, steps: &FlankSteps) -> f64 {
        (steps.along * self.turn_along - self.turn) / steps.area()
    }

    /// The smallest distance from the centre line, m, above it (sign 1) or below it (−1), at which the flank folds over itself; infinite where it never does.
    pub(crate) fn folds_at(&self, sign: f64) -> f64 {
        // The area of the flank by the cam angle and by v is |V| − d (τ − s χ_v) − d² q χ_v.
        let linear = -sign * (self.turn - self.turn_along * self.slide);
        smallest_root(self.speed, linear, -self.tip * self.turn_along)
    }
}

/// The smallest positive root d of a + b d + c d² with a > 0; infinite where there is none.
fn smallest_root(a: f64, b: f64, c: f64) -> f64 {
    let root = (b * b - 4.0 * a * c).sqrt();
    // In the form without cancellation: 2a/(−b ± root).
    let roots = [2.0 * a / (-b + root), 2.0 * a / (-b - root)];
    roots.into_iter().filter(|d| *d > 0.0).fold(f64::INFINITY, f64::min)
}

//! Which dimension of a roller's place may be chosen together with the size of the cam, and the places at which a pressure angle is kept.
//!
//! Seen from the follower, the shaft is a point q of the plane, and each limit of the pressure angle at each cam angle a straight
//! line that q must not cross: where the shaft may be is a convex region, and the smallest cam is that of its point nearest to the
//! roller at rest.

use super::{Carrier, Follower};
use crate::motion::Jet;
use nalgebra::Vector2;

/// The dimension that may be chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FollowerPlacement {
    /// The offset of a roller on a straight path; q = (u0, ε), seen from the centre of the roller at rest.
    Offset {
        /// Radius of the roller, m; 0 for a knife edge.
        radius: f64,
    },
    /// The distance of the pivot from the shaft; q = a (cos ψ0, sin ψ0), seen from the pivot with the arm at rest along the first axis.
    Pivot {
        /// Length of the arm from the pivot to the centre of the roller, m.
        arm: f64,
        /// Radius of the roller, m.
        radius: f64,
        /// 1 trailing, −1 leading.
        side: f64,
    },
}

/// A condition normal·q ≥ least on the place q of the shaft, with its derivatives by the parameter of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HalfPlane {
    /// Of the order of 1.
    pub normal: Vector2<f64>,
    /// The bound, m.
    pub least: f64,
    /// Derivative of the normal.
    pub normal_slope: Vector2<f64>,
    /// Derivative of `least`.
    pub least_slope: f64,
}

impl FollowerPlacement {
    /// The roller's centre at rest, m: the prime radius is the distance of q from it.
    #[must_use]
    pub fn of_roller(self) -> Vector2<f64> {
        match self {
            FollowerPlacement::Offset { .. } => Vector2::zeros(),
            FollowerPlacement::Pivot { arm, .. } => Vector2::new(arm, 0.0),
        }
    }

    /// Where the shaft may be for a pressure angle α ≤ `limit`, rad, or, `falling`, α ≥ −`limit`, at a lift.
    ///
    /// A roller with u = u0 + s has tan α = (s' − ε)/u. On an arm l with X = a cos ψ0 and Y = a sin ψ0, a cos ψ = X cos s − Y sin s and
    /// a sin ψ = X sin s + Y cos s, so that tan α = [l s' + τ (l − a cos ψ)]/(a sin ψ) is linear in X and Y as well. Both are taken times
    /// cos `limit`, so that 90° is no exception.
    #[must_use]
    pub fn condition(self, lift: &Jet, limit: f64, falling: bool) -> HalfPlane {
        let way = if falling { -1.0 } else { 1.0 };
        let (sine, cosine) = (libm::sin(limit), libm::cos(limit));
        match self {
            FollowerPlacement::Offset { .. } => HalfPlane {
                normal: Vector2::new(sine, way * cosine),
                least: way * cosine * lift.ds - sine * lift.s,
                normal_slope: Vector2::zeros(),
                least_slope: way * cosine * lift.dds - sine * lift.ds,
            },
            FollowerPlacement::Pivot { arm, side, .. } => {
                let (t, c) = (sine, way * side * cosine);
                let (sin, cos) = (libm::sin(lift.s), libm::cos(lift.s));
                let normal = Vector2::new(c * cos + t * sin, t * cos - c * sin);
                HalfPlane {
                    normal,
                    least: way * cosine * arm * (lift.ds + side),
                    normal_slope: Vector2::new(normal.y, -normal.x) * lift.ds,
                    least_slope: way * cosine * arm * lift.dds,
                }
            }
        }
    }

    /// The pressure angle at a lift with the shaft at a place, rad.
    #[must_use]
    pub fn pressure_angle(self, lift: &Jet, shaft: Vector2<f64>) -> f64 {
        match self {
            FollowerPlacement::Offset { .. } => libm::atan2(lift.ds - shaft.y, shaft.x + lift.s),
            FollowerPlacement::Pivot { arm, side, .. } => {
                let (sin, cos) = libm::sincos(lift.s);
                let (along, across) = (shaft.x * cos - shaft.y * sin, shaft.x * sin + shaft.y * cos);
                libm::atan2(arm * lift.ds + side * (arm - along), across)
            }
        }
    }

    /// The place of the shaft for a choice and a prime radius, m; `None` where there is no such place.
    #[must_use]
    pub fn shaft(self, choice: f64, prime_radius: f64) -> Option<Vector2<f64>> {
        match self {
            FollowerPlacement::Offset { .. } => {
                let square = (prime_radius - choice) * (prime_radius + choice);
                (square > 0.0).then(|| Vector2::new(square.sqrt(), choice))
            }
            FollowerPlacement::Pivot { arm, .. } => {
                let cosine = (choice * choice + arm * arm - prime_radius * prime_radius) / (2.0 * choice * arm);
                let square = (1.0 - cosine) * (1.0 + cosine);
                (square > 0.0).then(|| Vector2::new(cosine, square.sqrt()) * choice)
            }
        }
    }

    /// The dimension chosen by a place of the shaft: offset or pivot distance, m.
    #[must_use]
    pub fn chosen(self, shaft: Vector2<f64>) -> f64 {
        match self {
            FollowerPlacement::Offset { .. } => shaft.y,
            FollowerPlacement::Pivot { .. } => shaft.norm(),
        }
    }

    /// The choice that a follower of this kind has made, as a place relative to its carrier, m.
    #[must_use]
    pub fn chosen_by(self, follower: &dyn Follower) -> f64 {
        match (self, follower.carrier()) {
            (FollowerPlacement::Pivot { .. }, Carrier::Arm { pivot }) => pivot.norm(),
            // The centre of a translating roller is at the offset from the path through the shaft.
            _ => follower.touch(0.0, &Jet::default()).curve.point.y,
        }
    }

    /// Least and largest choice, m, on a cam of a prime radius of at most this, m.
    #[must_use]
    pub fn choices(self, prime_radius: f64) -> (f64, f64) {
        match self {
            FollowerPlacement::Offset { .. } => (-prime_radius, prime_radius),
            FollowerPlacement::Pivot { arm, .. } => ((arm - prime_radius).max(0.0), arm + prime_radius),
        }
    }

    /// The key of the follower's table for it, and its name.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            FollowerPlacement::Offset { .. } => "offset",
            FollowerPlacement::Pivot { .. } => "pivot_distance",
        }
    }
}

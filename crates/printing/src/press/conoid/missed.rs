//! Errors of the follower's motion on a curve instead of the exact cut of a section, to first order.
//!
//! The cut of a section is touched by rollers at different axial positions. What a curve misses of its heading and
//! curvature gives the errors δs' = (ℓ/cos α) δheading and δs'' = −(ℓ²/cos α) δκ, ℓ the speed of the cut and α the angle between its
//! normal and the roller's path.

use super::{Conoid, Slice};
use camgen_cams::body::surface::{BESIDE, Heading, RateErrors};
use camgen_kernel::geometry::points::{Interpolant, MotionErrors};
use camgen_kernel::geometry::{CurvePoint, MILLIMETRES};
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::interpolated::{FollowerOnTable, up_to};
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Newton steps from a point to the cam angle of its foot.
const FOOT_STEPS: u32 = 6;
/// Cosine of the pressure angle below which no motion is transmitted.
const LEAST_COSINE: f64 = 1e-3;
/// Places in an interval of a table, both ends among them.
const PLACES: u32 = 5;

impl Conoid {
    /// Errors of a heading against the exact cut at z (m) of a clockwise cam; the law is looked at so
    /// far from their cam angle, rad.
    pub(super) fn rate_errors_at(&self, z: f64, heading: Heading, inwards: f64) -> Option<RateErrors> {
        let (point, tangent, curvature) = heading;
        let (frame, at) = self.foot(z, point, inwards)?;
        let path = Vector2::new(libm::cos(at), libm::sin(at));
        let along = frame.speed / frame.outward().dot(&path).max(LEAST_COSINE);
        Some(RateErrors {
            velocity: along * frame.tangent.perp(&tangent),
            acceleration: -along * frame.speed * (curvature - frame.curvature),
            at,
        })
    }

    /// The point of the cut at z (m) whose normal passes through a point (m), and its cam angle.
    fn foot(&self, z: f64, point: Vector2<f64>, inwards: f64) -> Option<(CurvePoint, f64)> {
        let slice = self.slice(z);
        let mut angle = libm::atan2(point.y, point.x);
        for _ in 0..FOOT_STEPS {
            let (piece, inside) = slice.locate(angle + inwards);
            let (frame, _) = self.cut(piece, inside - inwards, z)?;
            let away = point - frame.point;
            let run = frame.speed * (1.0 + frame.curvature * away.dot(&frame.outward()));
            let ahead = away.dot(&frame.tangent) / run;
            if !(ahead.abs() < TAU) {
                return None;
            }
            angle += ahead;
            if ahead.abs() < f64::EPSILON {
                break;
            }
        }
        let (piece, inside) = slice.locate(angle + inwards);
        self.cut(piece, inside - inwards, z).map(|(frame, _)| (frame, inside))
    }
}

/// The follower of a section on tables of its cut, or of the path of the roller's centre.
#[derive(Debug)]
pub struct FollowerOnSection<'a> {
    conoid: &'a Conoid,
    /// Place along the axis, m.
    z: f64,
    /// Whether the tables give the path of the centre, on which the roller runs as on a disc.
    centre: bool,
}

impl<'a> FollowerOnSection<'a> {
    /// At an axial position, m.
    #[must_use]
    pub fn new(conoid: &'a Conoid, z: f64, centre: bool) -> Self {
        Self { conoid, z, centre }
    }

    /// The errors at an angle of an interval.
    fn off(&self, curve: &Interpolant, interval: usize, place: u32) -> Option<[f64; 2]> {
        let (from, to) = curve.range(interval)?;
        let point = curve.point_at(interval, from + (to - from) * f64::from(place) / f64::from(PLACES - 1))?;
        let inwards = match place {
            0 => BESIDE,
            place if place + 1 == PLACES => -BESIDE,
            _ => 0.0,
        };
        let given = (point.point / MILLIMETRES, point.tangent, MILLIMETRES * point.curvature);
        self.conoid
            .rate_errors_at(self.z, given, inwards)
            .map(|errors| [errors.velocity.abs(), errors.acceleration.abs()])
    }
}

impl FollowerOnSection<'_> {
    /// The largest errors in an interval; infinite where the follower leaves the section.
    fn largest_off(&self, curve: &Interpolant, interval: usize) -> [f64; 2] {
        if curve.range(interval).is_none_or(|(from, to)| from >= to) {
            return [0.0; 2];
        }
        let mut largest = [0.0_f64; 2];
        for place in 0..PLACES {
            let Some([velocity, acceleration]) = self.off(curve, interval, place) else { return [f64::INFINITY; 2] };
            largest = [largest[0].max(velocity), largest[1].max(acceleration)];
        }
        largest
    }
}

impl MotionErrors for FollowerOnSection<'_> {
    fn errors(&self, curve: &Interpolant, wanted: [bool; 2], limit: [f64; 2]) -> Vec<[f64; 2]> {
        if self.centre {
            let slice = self.conoid.slice(self.z);
            return FollowerOnTable::new(self.conoid.plane_of(&slice), 0.0).errors(curve, wanted, limit);
        }
        up_to(curve.count(), limit, |interval| {
            let [velocity, acceleration] = self.largest_off(curve, interval);
            [if wanted[0] { velocity } else { 0.0 }, if wanted[1] { acceleration } else { 0.0 }]
        })
    }

    fn step(&self, at: &CurvePoint) -> f64 {
        let slice = self.conoid.slice(self.z);
        if self.centre {
            return FollowerOnTable::new(self.conoid.plane_of(&slice), 0.0).step(at);
        }
        let Some((_, angle)) = self.conoid.foot(self.z, at.point / MILLIMETRES, 0.0) else { return 0.0 };
        (acceleration_beside(&slice, angle, BESIDE) - acceleration_beside(&slice, angle, -BESIDE)).abs()
    }
}

/// The acceleration at a cam angle by the piece of the motion that is `away` (rad) from it.
fn acceleration_beside(slice: &Slice<'_>, angle: f64, away: f64) -> f64 {
    let (piece, inside) = slice.locate(angle + away);
    let (start, end) = slice.pieces().get(piece).map_or((inside, inside), |own| (own.start, own.end));
    slice.jet(piece, (inside - away).clamp(start, end)).dds
}

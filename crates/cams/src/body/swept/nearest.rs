//! The cam angle at which a roller comes nearest to a point of the cam, by Newton's method, and how the point lies to the flank there.

use super::SweptGeometry;
use super::flanks::{FlankMiss, FlankSide};
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::Vector3;

/// A step below this, rad, ends the search.
const AT_REST: f64 = 1e-14;

/// A point seen along the centre line of a roller, with two derivatives by the cam angle.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SeenPoint {
    /// Of the point from the line, m: along the circumference, and across the roller upwards.
    pub(crate) off: [f64; 2],
    pub(crate) first: [f64; 2],
    pub(crate) second: [f64; 2],
    /// Sine and cosine of the angle between the roller's axis and the plane across that of the cam.
    pub(crate) rise: (f64, f64),
}

/// Where a roller comes nearest to a point.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NearestRoller {
    /// Cam angle, rad, of any turn.
    pub(crate) at: f64,
    pub(crate) seen: SeenPoint,
}

/// How far the search goes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Descent {
    /// Longest step, rad: a longer one could lead to where the roller's axis, without its end, passes the point on the far side of the cam.
    pub(crate) longest: f64,
    /// Most steps, and most halvings of one.
    pub(crate) steps: usize,
}

impl SeenPoint {
    /// Square of the distance, m².
    pub(crate) fn square(&self) -> f64 {
        self.off[0] * self.off[0] + self.off[1] * self.off[1]
    }
}

impl Descent {
    /// The nearest place from a cam angle on.
    pub(crate) fn from(&self, start: f64, see: impl Fn(f64) -> SeenPoint) -> NearestRoller {
        let (mut at, mut seen) = (start, see(start));
        for _ in 0..self.steps {
            let ([a, b], [da, db], [dda, ddb]) = (seen.off, seen.first, seen.second);
            let (slope, bend) = (a * da + b * db, da * da + db * db + a * dda + b * ddb);
            let mut by = (slope / if bend > 0.0 { bend } else { da * da + db * db }).clamp(-self.longest, self.longest);
            let mut next = see(at - by);
            // A step that does not come nearer is halved.
            for _ in 0..self.steps {
                if next.square() <= seen.square() {
                    break;
                }
                by *= 0.5;
                next = see(at - by);
            }
            if next.square() > seen.square() {
                break;
            }
            (at, seen) = (at - by, next);
            if by.abs() <= AT_REST {
                break;
            }
        }
        NearestRoller { at, seen }
    }
}

/// How a point (mm) of a flank lies to the nearest flank, by the roller rolled past it.
pub(crate) fn miss<B: SweptGeometry>(body: &B, point: Vector3<f64>) -> FlankMiss {
    let groove = body.groove();
    let sense = groove.sense();
    let NearestRoller { at, seen } = body.nearest(Vector3::new(point.x, sense * point.y, point.z) / MILLIMETRES);
    let [across, up] = seen.off;
    let away = libm::hypot(across, up);
    let flank = if up > 0.0 { FlankSide::Upper } else { FlankSide::Lower };
    let (sin, cos) = libm::sincos(at);
    let (rise, run) = seen.rise;
    // Out of the metal, towards the centre line of the roller.
    let (in_plane, round) = (-up * rise, -across);
    let outward = Vector3::new(in_plane * cos - round * sin, sense * (in_plane * sin + round * cos), -up * run) / away;
    FlankMiss { value: MILLIMETRES * (away - groove.signed(flank).abs()), at: groove.motion.locate(at).1, outward }
}

//! Where a conical roller touches the flanks of a barrel cam.
//!
//! The roller's axis points at that of the cam: a = e_r, and its place C at v moves by V = (0, v, z') with the cam angle θ. Its radius is ρ(v), with the slope
//! k = ρ'. As the axis turns with a' = e_θ, a point C + ρ m of the roller, m across the axis, moves by V + ρ (a' − (m · a') a) as far as that matters; the
//! normal of the cone is (m − k a)/√(1 + k²). Where both are at right angles the roller touches the flank: m · (V + k ρ a') = 0, as V has no part
//! along a. So m = ±n with n = (0, −sin χ, cos χ) and tan χ = z'/(v + k ρ), and the flanks are X = C ± ρ n. For k = 0 they are those of a cylinder.
//!
//! With the signed distance d = ±ρ, its slope δ = d', t = (0, cos χ, sin χ) and e = (a + δ n)/√(1 + k²) the flank moves by
//! X_θ = (S − d χ_θ) t + d sin χ √(1 + k²) e and X_v = −d χ_v t + √(1 + k²) e, with S = v cos χ + z' sin χ. The normal N = (n − δ a)/√(1 + k²) changes by
//! √(1 + k²) N_θ = −(χ_θ + δ cos χ) t + sin χ √(1 + k²) e and √(1 + k²) N_v = −χ_v t.

use crate::body::barrel::{AxisLine, BarrelLine, OffsetPoint};
use crate::body::swept::{LinePoint, RollerLine};

/// The roller's centre line at a cam angle, with its cone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ConeLine {
    pub(super) axis: AxisLine,
    /// Radius of the roller on the outside of the cam, m.
    pub(super) radius: f64,
    /// k, the tangent of the half angle: positive where the roller is thinner inside.
    pub(super) taper: f64,
    /// Radius of that outside, m.
    pub(super) outer: f64,
}

impl BarrelLine for ConeLine {
    fn axis(&self) -> &AxisLine {
        &self.axis
    }

    fn without_offset(&self) -> Self {
        *self
    }

    fn offset(&self, v: f64, distance: f64) -> OffsetPoint {
        // The centre line itself is a curve on the outside, not a flank.
        let (size, sign) = if distance == 0.0 { (self.radius, 0.0) } else { (distance.abs(), distance.signum()) };
        let radius = self.radius_at(v, size);
        OffsetPoint { line: self.contact(v, radius), distance: sign * radius, widening: sign * self.taper }
    }
}

impl ConeLine {
    /// The contact of a cone whose radius at a place is given, m.
    fn contact(&self, v: f64, radius: f64) -> LinePoint {
        let [_, rise, second] = self.axis.along;
        let run = v + self.taper * radius;
        let square = run * run + rise * rise;
        let size = square.sqrt();
        let (sin, cos) = (rise / size, run / size);
        LinePoint {
            v,
            slope: (sin, cos),
            speed: v * cos + rise * sin,
            slide: 0.0,
            turn: second * run / square,
            turn_along: -rise * self.slant() * self.slant() / square,
            tip: -sin,
        }
    }

    /// The sum of both principal curvatures of the flank at a signed distance, 1/m, as the normal N counts them.
    fn sum_of_curvatures(&self, point: &LinePoint, distance: f64) -> f64 {
        let (sin, cos) = point.slope;
        let sign = distance.signum();
        let distance = sign * self.radius_at(point.v, distance.abs());
        let bend = 2.0 * sin * distance * point.turn_along - point.turn - sign * self.taper * cos;
        bend / (self.slant() * point.steps(distance).area())
    }
}

impl RollerLine for ConeLine {
    fn point(&self, v: f64) -> LinePoint {
        self.contact(v, self.radius_at(v, self.radius))
    }

    fn speed_slope(&self, point: &LinePoint) -> f64 {
        let (sin, cos) = point.slope;
        let [_, rise, second] = self.axis.along;
        (rise * cos - point.v * sin) * point.turn + second * sin
    }

    fn reduced_curvature(&self, point: &LinePoint, distance: f64) -> f64 {
        let across = (self.slant() * self.radius_at(point.v, distance.abs())).recip();
        across - distance.signum() * self.sum_of_curvatures(point, distance)
    }

    fn curvature_under(&self, point: &LinePoint, distance: f64, roller: f64) -> f64 {
        (self.slant() * roller).recip() - distance.signum() * self.sum_of_curvatures(point, distance)
    }

    /// As a distance on the outside.
    fn folds_at(&self, point: &LinePoint, sign: f64) -> f64 {
        point.folds_at(sign) + self.taper * (self.outer - point.v)
    }

    fn radius_at(&self, v: f64, radius: f64) -> f64 {
        radius + self.taper * (v - self.outer)
    }

    /// The normal leans from the plane across the roller by the half angle.
    fn normal_angle(&self, in_plane: f64) -> f64 {
        libm::acos(libm::cos(in_plane) / self.slant()).copysign(in_plane)
    }

    fn slant(&self) -> f64 {
        libm::hypot(1.0, self.taper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::barrel::RollerPath;
    use camgen_kernel::motion::Jet;
    use nalgebra::Vector3;

    const OUTER: f64 = 0.065;

    fn lift(angle: f64) -> Jet {
        let (sin, cos) = libm::sincos(angle);
        Jet { s: 0.02 * (1.0 - cos), ds: 0.02 * sin, dds: 0.02 * cos, ddds: -0.02 * sin }
    }

    fn line(angle: f64) -> ConeLine {
        let axis = RollerPath::Straight { offset: 0.0 }.at(&lift(angle));
        ConeLine { axis, radius: 0.010, taper: 0.2, outer: OUTER }
    }

    fn turned(v: Vector3<f64>, angle: f64) -> Vector3<f64> {
        let (sin, cos) = libm::sincos(angle);
        Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z)
    }

    /// A point of a flank, and its normal up, in space.
    fn flank(angle: f64, v: f64, distance: f64) -> (Vector3<f64>, Vector3<f64>) {
        let line = line(angle);
        let OffsetPoint { line: point, distance, widening } = line.offset(v, distance);
        let (sin, cos) = point.slope;
        let place = Vector3::new(v, -distance * sin, line.axis.along[0] + distance * cos);
        (turned(place, angle), turned(Vector3::new(-widening, -sin, cos), angle).normalize())
    }

    /// How far a point is outside of the cone as the cam stands at an angle: by its distance from the axis and from the apex, without any contact.
    fn outside_of_cone(point: Vector3<f64>, angle: f64) -> f64 {
        let seen = turned(point, -angle);
        let line = line(angle);
        let (across, up) = (seen.y, seen.z - line.axis.along[0]);
        let half_angle = libm::atan(line.taper);
        let from_apex = seen.x - (OUTER - line.radius / line.taper);
        libm::hypot(across, up) * libm::cos(half_angle) - from_apex * libm::sin(half_angle)
    }

    /// The roller at every angle stays on one side of the flank and touches it at the angle of its contact: the flank is the envelope of the cones.
    #[test]
    fn no_cone_enters_the_metal_and_one_touches_it() {
        for i in 0..24 {
            for v in [0.054, 0.060, OUTER] {
                for distance in [0.010, -0.010] {
                    let angle = 0.26 * f64::from(i) + 0.05;
                    let (point, _) = flank(angle, v, distance);
                    assert!(outside_of_cone(point, angle).abs() < 1e-15, "{angle} {v}");
                    let least = (-400..=400).map(|step| outside_of_cone(point, angle + 1e-3 * f64::from(step)));
                    let least = least.fold(f64::INFINITY, f64::min);
                    assert!(least > -1e-12, "{angle} {v} {distance}: {least:e}");
                }
            }
        }
    }

    /// Slopes on a cylinder against central differences; the normal against the cross product of two of them; area and curvature against their own.
    #[test]
    fn slopes_areas_and_curvatures_are_those_of_the_points() {
        for i in 0..24 {
            let (angle, v, h) = (0.26 * f64::from(i) + 0.05, 0.058, 1e-5);
            for distance in [0.010, -0.012] {
                let found = line(angle).on_cylinder(distance, 0.060).expect("a point");
                let [before, after] = [-h, h].map(|by| line(angle + by).on_cylinder(distance, 0.060).expect("a point"));
                let slope =
                    [1.0 + (after.ahead - before.ahead) / (2.0 * h), (after.height - before.height) / (2.0 * h)];
                assert!((found.by_angle[0] - slope[0]).abs() < 1e-8 && (found.by_angle[1] - slope[1]).abs() < 1e-9);
                let [(p, m), (q, n), (r, k), (s, l)] =
                    [(-h, 0.0), (h, 0.0), (0.0, -h), (0.0, h)].map(|(by, out)| flank(angle + by, v + out, distance));
                let (by_angle, by_v) = ((q - p) / (2.0 * h), (s - r) / (2.0 * h));
                let (n_angle, n_v) = ((n - m) / (2.0 * h), (l - k) / (2.0 * h));
                let (_, normal) = flank(angle, v, distance);
                assert!(normal.dot(&by_angle).abs() < 1e-9 && normal.dot(&by_v).abs() < 1e-7, "{angle} {distance}");
                // Along the circumference and outwards is downwards by the right hand.
                let area = by_angle.cross(&by_v).dot(&normal);
                let line = line(angle);
                let OffsetPoint { line: point, distance: away, .. } = line.offset(v, distance);
                assert!((area + line.slant() * point.steps(away).area()).abs() < 1e-8, "{angle} {distance}: {area}");
                let sum = (n_angle.cross(&by_v) + by_angle.cross(&n_v)).dot(&normal) / area;
                let due = 1.0 / (line.slant() * away.abs()) - distance.signum() * sum;
                let found = line.reduced_curvature(&point, distance);
                assert!((found - due).abs() < 1e-5 * due.abs(), "{angle} {distance} {found} {due}");
            }
        }
    }

    /// A cone that narrows to a cylinder has its flanks, folds and curvatures.
    #[test]
    fn without_a_taper_it_is_the_cylinder() {
        for i in 0..24 {
            let cone = ConeLine { taper: 0.0, ..line(0.26 * f64::from(i)) };
            for distance in [0.010, -0.012] {
                let [found, due] = [cone.on_cylinder(distance, 0.060), cone.axis.on_cylinder(distance, 0.060)]
                    .map(|found| found.map(|found| (found.ahead, found.height, found.by_angle)));
                assert!(found.is_some() && found == due, "{found:?} {due:?}");
                let (point, due) = (cone.point(0.058), cone.axis.point(0.058));
                assert!((point.speed - due.speed).abs() < 1e-16);
                let curvatures =
                    [cone.reduced_curvature(&point, distance), cone.axis.reduced_curvature(&due, distance)];
                assert!((curvatures[0] - curvatures[1]).abs() < 1e-11 * curvatures[0].abs(), "{curvatures:?}");
                let folds = [cone.folds_at(&point, distance.signum()), due.folds_at(distance.signum())];
                assert!(folds[0] == folds[1] || (folds[0] / folds[1] - 1.0).abs() < 1e-12, "{folds:?}");
            }
        }
    }
}

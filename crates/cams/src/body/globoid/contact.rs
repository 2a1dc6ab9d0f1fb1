//! Where the cylindrical rollers of a turret touch the flanks of a globoid cam.
//!
//! The turret's axis passes that of the cam (z) at a distance D and at right angles. Seen from the cam the centre line of a roller at a cam angle θ lies
//! in the plane of e_r and e_z: C(v) = (D − v cos ψ) e_r + v sin ψ e_z with the distance v from the turret's axis and the turret angle ψ. Its direction
//! is a = −cos ψ e_r + sin ψ e_z; across it in the same plane lies w = sin ψ e_r + cos ψ e_z. Its points move by V = R e_θ + v ψ' w by the cam angle,
//! with R = D − v cos ψ, and the flank touches the roller where the normal is n = a × V/|a × V|: n = −sin χ e_θ + cos χ w with tan χ = v ψ'/R. The flanks are
//! X = C ± r n, and χ is the pressure angle.

use crate::body::swept::{LinePoint, RollerLine};
use nalgebra::Vector3;

/// Steps to the place of a flank at a distance from the turret's axis, and the step over that distance at which they end.
const STEPS: usize = 24;
const LAST_STEP: f64 = 1e-15;

/// The centre line of a roller at a cam angle: the turret angle with two derivatives by the cam angle, and the distance of both axes, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TurretLine {
    pub(super) distance: f64,
    pub(super) angle: [f64; 3],
}

/// A point of a flank, m, as (along e_r, along e_θ, along e_z) of the cam angle, with its derivative by the cam angle in the same directions, the
/// distance from the turret's axis in the plane through the cam's axis kept.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FlankPoint {
    pub(super) place: Vector3<f64>,
    pub(super) by_angle: Vector3<f64>,
    /// The point of the roller's centre line at this contact.
    pub(super) line: LinePoint,
}

impl FlankPoint {
    /// Its polar angle less the cam angle, rad.
    pub(super) fn ahead(&self) -> f64 {
        libm::atan2(self.place.y, self.place.x)
    }

    /// Distance from the axis of the cam, m.
    pub(super) fn radius(&self) -> f64 {
        self.place.xy().norm()
    }

    /// The angle about the turret's axis at which it lies in the plane through the axis of the cam, rad.
    pub(super) fn about_turret(&self, distance: f64) -> f64 {
        libm::atan2(self.place.z, distance - self.radius())
    }

    /// Derivative of its polar angle by the cam angle.
    pub(super) fn polar_rate(&self) -> f64 {
        (self.place.x * self.by_angle.y - self.place.y * self.by_angle.x) / self.place.xy().norm_squared()
    }
}

impl TurretLine {
    /// Distance R of a place of the centre line from the axis of the cam, m.
    pub(super) fn run(&self, v: f64) -> f64 {
        self.distance - v * libm::cos(self.angle[0])
    }

    /// The flank at a signed distance from a place of the centre line (m, positive above).
    pub(super) fn flank(&self, line: &LinePoint, distance: f64) -> Vector3<f64> {
        let (sin, cos) = libm::sincos(self.angle[0]);
        let (tilt, lean) = line.slope;
        let run = self.distance - line.v * cos;
        Vector3::new(run + distance * lean * sin, -distance * tilt, line.v * sin + distance * lean * cos)
    }

    /// Where the flank at a signed distance from the centre line (m) is at a distance from the turret's axis in the plane through the axis of the cam, m;
    /// `None` where it is not.
    pub(super) fn at_distance(&self, distance: f64, from_turret: f64) -> Option<FlankPoint> {
        let (sin, cos) = libm::sincos(self.angle[0]);
        let along = Vector3::new(-cos, 0.0, sin);
        let gradient = |place: &Vector3<f64>| {
            let radius = place.xy().norm();
            let off = self.distance - radius;
            Vector3::new(-off * place.x / radius, -off * place.y / radius, place.z)
        };
        let away = |place: &Vector3<f64>| {
            let off = self.distance - place.xy().norm();
            0.5 * (off * off + place.z * place.z - from_turret * from_turret)
        };
        let direction = |line: &LinePoint| {
            let (tilt, lean) = line.slope;
            Vector3::new(tilt * sin, lean, tilt * cos)
        };
        let mut v = from_turret;
        for _ in 0..STEPS {
            let line = self.point(v);
            let place = self.flank(&line, distance);
            let by_v = along - direction(&line) * (distance * line.turn_along);
            let step = away(&place) / gradient(&place).dot(&by_v);
            v -= step;
            if step.abs() <= LAST_STEP * from_turret {
                break;
            }
        }
        let line = self.point(v);
        let place = self.flank(&line, distance);
        let steps = line.steps(distance);
        let tangent = direction(&line);
        let (by_angle, by_v) = (tangent * steps.across + along * steps.along, along + tangent * steps.across_by_v);
        let outwards = gradient(&place);
        let rate = outwards.dot(&by_v);
        if !(v > 0.0 && self.run(v) > 0.0 && rate > 0.0 && away(&place).abs() <= 1e-12 * from_turret * from_turret) {
            return None;
        }
        Some(FlankPoint { place, by_angle: by_angle - by_v * (outwards.dot(&by_angle) / rate), line })
    }
}

impl RollerLine for TurretLine {
    /// At a distance from the turret's axis.
    fn point(&self, v: f64) -> LinePoint {
        let [angle, by, second] = self.angle;
        let (sin, cos) = libm::sincos(angle);
        let run = self.distance - v * cos;
        let rise = v * by;
        let square = run * run + rise * rise;
        let speed = square.sqrt();
        let (tilt, lean) = (rise / speed, run / speed);
        LinePoint {
            v,
            slope: (tilt, lean),
            speed,
            slide: 0.0,
            turn: (v * second * run - rise * v * sin * by) / square - sin,
            turn_along: by * self.distance / square,
            tip: tilt * cos + by * lean,
        }
    }

    fn speed_slope(&self, point: &LinePoint) -> f64 {
        let [angle, by, second] = self.angle;
        let (tilt, lean) = point.slope;
        lean * point.v * libm::sin(angle) * by + tilt * point.v * second
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Modified sine of 60° in 120° from −30°, at 50°, as in general-cams: its values at 40 digits.
    fn line() -> TurretLine {
        let pi = std::f64::consts::PI;
        let (beta, x) = (120.0_f64.to_radians(), 50.0 / 120.0);
        // Middle piece of the modified sine: s = (2 + π x − 9/4 sin((4πx + π)/3))/(4 + π).
        let phase = (4.0 * pi * x + pi) / 3.0;
        let s = (2.0 + pi * x - 2.25 * libm::sin(phase)) / (4.0 + pi);
        let v = (pi - 3.0 * pi * libm::cos(phase)) / (4.0 + pi);
        let a = 4.0 * pi * pi * libm::sin(phase) / (4.0 + pi);
        let rise = 60.0_f64.to_radians();
        TurretLine { distance: 0.120, angle: [rise * (s - 0.5), rise * v / beta, rise * a / (beta * beta)] }
    }

    #[test]
    fn the_flanks_are_those_of_general_cams() {
        let line = line();
        let point = line.point(0.050);
        let (sin, cos) = libm::sincos(50.0_f64.to_radians());
        for (distance, due) in [
            (0.012, [49.064_704_392_288_77, 48.925_307_130_921_79, 2.661_502_560_770_312]),
            (-0.012, [41.659_203_343_315_49, 59.195_235_847_170_23, -17.726_903_909_006_36]),
        ] {
            let place = line.flank(&point, distance) * 1e3;
            let found = [place.x * cos - place.y * sin, place.x * sin + place.y * cos, place.z];
            for (found, due) in found.into_iter().zip(due) {
                assert!((found - due).abs() < 1e-12 * 100.0, "{found} {due}");
            }
        }
    }

    /// A turret angle with its derivatives, smooth in the cam angle.
    fn at(angle: f64) -> TurretLine {
        let (sin, cos) = libm::sincos(angle);
        TurretLine { distance: 0.120, angle: [0.5 * angle - 0.4 - 0.2 * sin, 0.5 - 0.2 * cos, 0.2 * sin] }
    }

    /// A flank point in space, by (cam angle, v).
    fn in_space(angle: f64, v: f64, distance: f64) -> Vector3<f64> {
        let line = at(angle);
        turned(line.flank(&line.point(v), distance), angle)
    }

    fn turned(place: Vector3<f64>, angle: f64) -> Vector3<f64> {
        let (sin, cos) = libm::sincos(angle);
        Vector3::new(place.x * cos - place.y * sin, place.x * sin + place.y * cos, place.z)
    }

    /// Slopes at a kept distance from the turret's axis against central differences; the area against the cross product of two of them; the curvature
    /// against the change of the normal.
    #[test]
    fn slopes_areas_and_curvatures_are_those_of_the_points() {
        for i in 0..12 {
            let angle = 0.2 * f64::from(i) + 0.05;
            for distance in [0.010, -0.012] {
                let h = 1e-5;
                let of = |angle: f64| turned(at(angle).at_distance(distance, 0.055).expect("a point").place, angle);
                let found = at(angle).at_distance(distance, 0.055).expect("a point");
                let slope = (of(angle + h) - of(angle - h)) / (2.0 * h);
                assert!((slope - turned(found.by_angle, angle)).norm() < 1e-9, "{angle} {distance}");
                let (line, v) = (at(angle), 0.052);
                let by_angle = (in_space(angle + h, v, distance) - in_space(angle - h, v, distance)) / (2.0 * h);
                let by_v = (in_space(angle, v + h, distance) - in_space(angle, v - h, distance)) / (2.0 * h);
                let point = line.point(v);
                let found = by_angle.cross(&by_v).norm();
                assert!((found - point.steps(distance).area().abs()).abs() < 1e-8, "{angle} {distance}");
                // Mean curvature by the normal: trace of its change over steps of the surface.
                let normal = |angle: f64, v: f64| {
                    let line = at(angle);
                    let (point, next) = (line.point(v), 1e-3);
                    turned(line.flank(&point, next) - line.flank(&point, 0.0), angle) / next
                };
                let n_angle = (normal(angle + h, v) - normal(angle - h, v)) / (2.0 * h);
                let n_v = (normal(angle, v + h) - normal(angle, v - h)) / (2.0 * h);
                let n = normal(angle, v);
                let trace = (n_angle.cross(&by_v) + by_angle.cross(&n_v)).dot(&n) / by_angle.cross(&by_v).dot(&n);
                let due = 1.0 / distance.abs() - distance.signum() * trace;
                let found = line.reduced_curvature(&point, distance);
                assert!((found - due).abs() < 1e-5 * due.abs(), "{angle} {distance} {found} {due}");
            }
        }
    }

    /// At the distance at which the flank folds its area vanishes, and nowhere before.
    #[test]
    fn the_flank_folds_where_its_area_vanishes() {
        for i in 0..12 {
            let line = at(0.5 * f64::from(i));
            let point = line.point(0.055);
            for sign in [1.0, -1.0] {
                let fold = point.folds_at(sign);
                let until = if fold.is_finite() { fold } else { 10.0 };
                assert!((0..100).all(|k| point.steps(sign * until * 0.01 * f64::from(k)).area() > 0.0));
                assert!(!fold.is_finite() || point.steps(sign * fold).area().abs() < 1e-12 * (1.0 + fold * fold));
            }
        }
    }
}

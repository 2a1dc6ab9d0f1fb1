//! Where a cylindrical roller touches the flanks of a barrel cam.
//!
//! Seen from the cam the roller's centre line at a cam angle θ is v ↦ (v, y, z): v along the radius at θ, y against the rotation, z along the axis
//! of the cam. Its points move by V = (−y, v + y', z') by the cam angle, and the flank touches the roller where the normal is n = a × V/|a × V| with
//! the direction a = (1, 0, 0) of the roller's axis: n = (0, −sin χ, cos χ) with tan χ = z'/(v + y'). The flanks are X = C ± r n.

use crate::body::swept::{LinePoint, RollerLine};
use camgen_kernel::motion::Jet;

/// Steps to the place of a flank on a cylinder, and the step over its radius at which they end.
const STEPS: usize = 20;
const LAST_STEP: f64 = 1e-15;

/// How the roller is carried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum RollerPath {
    /// Along the axis of the cam, at a distance from the radius, m, positive against the rotation.
    Straight {
        /// The distance, m.
        offset: f64,
    },
    /// On an arm about an axis parallel to that of the roller, across the axis of the cam in the middle of its swing.
    Arm {
        /// From the pivot to the roller, m.
        arm: f64,
        /// Of the pivot from the axis of the cam, m.
        pivot: f64,
        /// 1 where the roller is behind its pivot in the sense of rotation, −1 where it is before it.
        side: f64,
        /// The whole swing, rad.
        swing: f64,
    },
}

/// The roller's centre line at a cam angle: place against the rotation and along the axis with two derivatives by the cam angle, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct AxisLine {
    pub(crate) across: [f64; 3],
    pub(crate) along: [f64; 3],
}

/// A point of a flank, m, with its derivatives by the cam angle and by the radius of the cylinder on which it lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FlankPoint {
    /// Angle less the cam angle, rad.
    pub(crate) ahead: f64,
    /// Height, m.
    pub(crate) height: f64,
    /// Derivatives of the angle in the cam and of the height by the cam angle, the radius kept.
    pub(crate) by_angle: [f64; 2],
    /// The roller's place that touches there.
    pub(crate) line: LinePoint,
}

/// A place of the flank at a distance from the centre line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OffsetPoint {
    pub(crate) line: LinePoint,
    /// Signed distance from the centre line, m, positive above, and its derivative along it.
    pub(crate) distance: f64,
    pub(crate) widening: f64,
}

/// The centre line of a roller in a cylinder, with the flanks that its form gives.
pub(crate) trait BarrelLine: RollerLine + Sized {
    fn axis(&self) -> &AxisLine;

    /// The line as if its roller pointed at the axis of the cam.
    fn without_offset(&self) -> Self;

    /// The flank whose signed distance on the outside is given, m, at a place along the roller.
    fn offset(&self, v: f64, distance: f64) -> OffsetPoint;

    /// Where that flank meets the cylinder of a radius, m; `None` where it does not.
    fn on_cylinder(&self, distance: f64, radius: f64) -> Option<FlankPoint> {
        let mut v = radius;
        for _ in 0..STEPS {
            let (across, slope) = self.offset(v, distance).across(self.axis());
            let rate = v + across * slope;
            let step = 0.5 * (v * v + across * across - radius * radius) / rate;
            v -= step;
            if step.abs() <= LAST_STEP * radius {
                break;
            }
        }
        let axis = self.axis();
        let point = self.offset(v, distance);
        let OffsetPoint { line, distance, widening } = point;
        let (across, outwards) = point.across(axis);
        let rate = v + across * outwards;
        let miss = v * v + across * across - radius * radius;
        if !(v > 0.0 && rate > 0.0 && miss.abs() <= 1e-12 * radius * radius) {
            return None;
        }
        let (sin, cos) = line.slope;
        // With the place along the roller kept, then along the cylinder.
        let across_turn = axis.across[1] - distance * cos * line.turn;
        let along_turn = axis.along[1] - distance * sin * line.turn;
        let moved = -across * across_turn / rate;
        let by_across = across_turn + outwards * moved;
        let by_height = along_turn + (widening * cos - distance * sin * line.turn_along) * moved;
        Some(FlankPoint {
            ahead: libm::atan2(across, v),
            height: axis.along[0] + distance * cos,
            by_angle: [1.0 + (v * by_across - across * moved) / (radius * radius), by_height],
            line,
        })
    }
}

impl OffsetPoint {
    /// Its place across, m, and the derivative of that along the roller.
    fn across(&self, axis: &AxisLine) -> (f64, f64) {
        let (sin, cos) = self.line.slope;
        (axis.across[0] - self.distance * sin, -self.widening * sin - self.distance * cos * self.line.turn_along)
    }
}

impl RollerPath {
    /// The roller's centre line at a lift.
    pub(crate) fn at(&self, lift: &Jet) -> AxisLine {
        match *self {
            RollerPath::Straight { offset } => {
                AxisLine { across: [offset, 0.0, 0.0], along: [lift.s, lift.ds, lift.dds] }
            }
            RollerPath::Arm { arm, pivot, side, swing } => {
                let (sin, cos) = libm::sincos(lift.s - 0.5 * swing);
                let (square, second) = (lift.ds * lift.ds, lift.dds);
                AxisLine {
                    across: [
                        side * (pivot - arm * cos),
                        side * arm * sin * lift.ds,
                        side * arm * (cos * square + sin * second),
                    ],
                    along: [
                        arm * (sin + libm::sin(0.5 * swing)),
                        arm * cos * lift.ds,
                        arm * (cos * second - sin * square),
                    ],
                }
            }
        }
    }

    /// Direction in which the roller moves with a growing lift, across and along, a unit vector.
    fn drive(&self, lift: &Jet) -> (f64, f64) {
        match *self {
            RollerPath::Straight { .. } => (0.0, 1.0),
            RollerPath::Arm { side, swing, .. } => {
                let (sin, cos) = libm::sincos(lift.s - 0.5 * swing);
                (side * sin, cos)
            }
        }
    }

    /// Pressure angle at a point of the centre line, rad, signed: positive where the lift grows.
    pub(crate) fn pressure_angle(&self, lift: &Jet, point: &LinePoint) -> f64 {
        let (sin, cos) = point.slope;
        let (across, along) = self.drive(lift);
        let (normal, tangent) = (-sin * across + cos * along, cos * across + sin * along);
        libm::atan2(tangent, normal)
    }
}

impl AxisLine {
    /// Where the centre line is at a distance from the axis of the cam, as a place along it, m; NaN where it never is so near.
    pub(crate) fn at_distance(&self, from_axis: f64) -> f64 {
        let beside = self.across[0];
        ((from_axis - beside) * (from_axis + beside)).sqrt()
    }
}

impl BarrelLine for AxisLine {
    fn axis(&self) -> &AxisLine {
        self
    }

    fn without_offset(&self) -> Self {
        let [_, by, second] = self.across;
        Self { across: [0.0, by, second], ..*self }
    }

    fn offset(&self, v: f64, distance: f64) -> OffsetPoint {
        OffsetPoint { line: self.point(v), distance, widening: 0.0 }
    }
}

impl RollerLine for AxisLine {
    fn point(&self, v: f64) -> LinePoint {
        let (run, rise) = (v + self.across[1], self.along[1]);
        let square = run * run + rise * rise;
        let speed = square.sqrt();
        LinePoint {
            v,
            slope: (rise / speed, run / speed),
            speed,
            slide: -self.across[0],
            turn: (self.along[2] * run - rise * self.across[2]) / square,
            turn_along: -rise / square,
            tip: -(rise / speed),
        }
    }

    fn speed_slope(&self, point: &LinePoint) -> f64 {
        let (sin, cos) = point.slope;
        cos * self.across[2] + sin * self.along[2]
    }

    fn reduced_curvature(&self, point: &LinePoint, distance: f64) -> f64 {
        // With χ_v |V| = −sin χ the bend along the roller follows from that across it.
        let across = point.bend_across(&point.steps(distance));
        let by_v = distance * point.turn_along;
        1.0 / distance.abs() - distance.signum() * (by_v * (by_v * across - point.turn_along) + across)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STRAIGHT: RollerPath = RollerPath::Straight { offset: 0.0 };

    /// Cycloidal, 40 mm in 120°, at 1 rad.
    fn lift() -> Jet {
        let (h, b) = (0.040, 120.0_f64.to_radians());
        let (x, tau) = (1.0 / b, std::f64::consts::TAU);
        Jet {
            s: h * (x - libm::sin(tau * x) / tau),
            ds: h / b * (1.0 - libm::cos(tau * x)),
            dds: h / (b * b) * tau * libm::sin(tau * x),
            ddds: h / (b * b * b) * tau * tau * libm::cos(tau * x),
        }
    }

    /// Values from numerical differentiation at 40 digits.
    #[test]
    fn the_flanks_are_those_of_general_cams() {
        let axis = STRAIGHT.at(&lift());
        let (sin, cos) = axis.point(0.050).slope;
        let (across, height) = (-0.010 * sin, axis.along[0] + 0.010 * cos);
        assert!((1e3 * libm::hypot(0.050, across) - 50.364_868_453_246_41).abs() < 1e-11);
        assert!((1.0 + libm::atan2(across, 0.050) - 0.879_556_923_597_340_3).abs() < 1e-13);
        assert!((1e3 * height - 26.161_352_605_231_86).abs() < 1e-11);
        for (distance, angle, height) in [
            (0.010, 0.899_200_914_242_356_7, 26.461_223_060_400_79),
            (-0.010, 1.100_799_085_757_643, 9.939_167_533_502_41),
        ] {
            let found = axis.on_cylinder(distance, 0.056).expect("a point");
            assert!((1.0 + found.ahead - angle).abs() < 1e-13, "{found:?}");
            assert!((1e3 * found.height - height).abs() < 1e-11, "{found:?}");
        }
        let curvature = axis.reduced_curvature(&axis.point(0.050), 0.010);
        assert!((1e-3 * curvature - 0.103_580_372_325_9).abs() < 1e-11, "{curvature}");
    }

    /// The area of a flank, by the cross product of differences, vanishes where the flank folds.
    #[test]
    fn the_flank_folds_where_its_area_vanishes() {
        let path = RollerPath::Straight { offset: 0.004 };
        let at = |angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            path.at(&Jet { s: 0.02 * (1.0 - cos), ds: 0.02 * sin, dds: 0.02 * cos, ddds: -0.02 * sin })
        };
        // A point of the flank in space, by the cam angle and v.
        let place = |angle: f64, v: f64, distance: f64| {
            let axis = at(angle);
            let (tilt, lean) = axis.point(v).slope;
            let (sin, cos) = libm::sincos(angle);
            let across = axis.across[0] - distance * tilt;
            nalgebra::Vector3::new(v * cos - across * sin, v * sin + across * cos, axis.along[0] + distance * lean)
        };
        for i in 0..24 {
            let (angle, v, h) = (0.26 * f64::from(i) + 0.05, 0.05, 1e-6);
            for sign in [1.0, -1.0] {
                let fold = at(angle).point(v).folds_at(sign);
                assert!(fold > 0.0);
                let distance = sign * fold.min(10.0);
                let by_angle = (place(angle + h, v, distance) - place(angle - h, v, distance)) / (2.0 * h);
                let by_v = (place(angle, v + h, distance) - place(angle, v - h, distance)) / (2.0 * h);
                let area = by_angle.cross(&by_v).norm();
                // Far away differences have no digits left.
                assert!(fold > 1.0 || area < 1e-6, "{angle} {sign} {fold} {area}");
            }
        }
    }

    /// Slopes on the cylinder against central differences, for a straight path with an offset and an arm.
    #[test]
    fn slopes_are_those_of_the_points() {
        let arm = RollerPath::Arm { arm: 0.12, pivot: 0.118, side: 1.0, swing: 0.4 };
        for (path, size) in [(RollerPath::Straight { offset: 0.004 }, 1.0), (arm, 10.0)] {
            let at = |angle: f64| {
                let (sin, cos) = libm::sincos(angle);
                Jet { s: 0.02 * (1.0 - cos), ds: 0.02 * sin, dds: 0.02 * cos, ddds: -0.02 * sin }.scaled(size)
            };
            for i in 0..24 {
                let angle = 0.26 * f64::from(i) + 0.05;
                for distance in [0.010, -0.012] {
                    let of = |angle: f64| path.at(&at(angle)).on_cylinder(distance, 0.060).expect("a point");
                    let (h, found) = (1e-5, of(angle));
                    let (before, after) = (of(angle - h), of(angle + h));
                    let turn = 1.0 + (after.ahead - before.ahead) / (2.0 * h);
                    let rise = (after.height - before.height) / (2.0 * h);
                    assert!((found.by_angle[0] - turn).abs() < 1e-8, "{angle} {found:?} {turn}");
                    assert!((found.by_angle[1] - rise).abs() < 1e-9, "{angle} {found:?} {rise}");
                }
            }
        }
    }
}

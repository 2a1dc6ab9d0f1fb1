//! The swinging roller: a roller on an arm about a pivot.

use super::{
    CROWN_DIAMETER, CROWN_RADIUS, Carrier, Element, Follower, FollowerData, FollowerKind, FollowerPlacement, INERTIA,
    Touch,
};
use crate::document::Presence::{Default, Required};
use crate::document::cams::MAKE;
use crate::document::range::LONGEST;
use crate::document::{Bounds, Field, Key, KeySection, Occurrence, TableReader, above};
use crate::geometry::{CurvePoint, left_of, rotated};
use crate::motion::{Jet, Quantity};
use crate::units::Dimension::Length;
use nalgebra::Vector2;
use std::f64::consts::PI;
use std::sync::Arc;

const LENGTH: Bounds = above(0.0, LONGEST);

const RADIUS: Field<f64> =
    Field::quantity("radius", "radius of the roller", Required("16 mm"), Length, LENGTH).also(&["size", "r"]);
const DIAMETER: Key = RADIUS.diameter("diameter", "diameter of the roller, in the place of its radius", "32 mm");
const ARM: Field<f64> = Field::quantity("arm", "arm from the pivot to the roller", Required("110 mm"), Length, LENGTH)
    .also(&["length", "arm_length", "lever"]);
const PIVOT_DISTANCE: Field<Option<f64>> = Field::words_or_quantity(
    "pivot_distance",
    "from the shaft to the pivot; \"auto\": that of the smallest cam",
    Required("140 mm"),
    (&["auto"], &[None]),
    (Length, LENGTH, Some),
)
.also(&["centre_distance", "center_distance", "distance"]);
const SIDE: Field<f64> = Field::words(
    "side",
    "\"trailing\" (the roller behind its pivot, seen in the rotation of the cam) or \"leading\"",
    Default("trailing"),
    &["trailing", "leading"],
    &[1.0, -1.0],
);

/// `[follower.swinging-roller]`.
pub(super) const KIND: FollowerKind = FollowerKind { section: &SECTION, quantity: Quantity::Angle, read };

const SECTION: KeySection = KeySection {
    path: "follower.swinging-roller",
    about: "the follower: a roller on a swinging arm",
    occurs: Occurrence::Optional,
    cams: &[MAKE],
    keys: &[RADIUS.key, DIAMETER, ARM.key, PIVOT_DISTANCE.key, SIDE.key, INERTIA.key, CROWN_RADIUS.key, CROWN_DIAMETER],
};

fn read(table: &TableReader<'_>) -> Option<FollowerData> {
    let (arm, radius, side) = (table.get(&ARM)?, table.get(&RADIUS)?, table.get(&SIDE)?);
    let given = table.get(&PIVOT_DISTANCE)?;
    let place = given.is_none().then_some(FollowerPlacement::Pivot { arm, radius, side });
    let shape = SwingingRoller::new(arm, given.unwrap_or(arm), radius, side);
    let (mass, crown_radius) = (table.get(&INERTIA), table.get(&CROWN_RADIUS));
    Some(FollowerData { mass, crown_radius, place, arm: Some(arm), ..FollowerData::new(SECTION.path, Arc::new(shape)) })
}

/// By which share the prime radius must stay within the triangle of arm and pivot distance: at its ends arm and
/// line of centres are one line, and the roller could swing to either side.
const REACH_MARGIN: f64 = 1e-6;

/// A roller on an arm l about a pivot at the distance a from the shaft.
///
/// Its centre is a·û(θ) − l (cos ψ û + τ sin ψ n̂), ψ = ψ0 + lift the angle at the pivot between arm and line of centres,
/// cos ψ0 = (a² + l² − R_p²)/(2 a l); τ = 1 for a trailing roller, −1 for a leading one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SwingingRoller {
    arm: f64,
    pivot_distance: f64,
    side: f64,
    radius: f64,
    prime_radius: f64,
    /// ψ0, rad.
    start: f64,
}

impl SwingingRoller {
    /// Arm, pivot distance and roller radius in m; side 1 trailing, −1 leading. Until the cam is sized, its arm is square to the line of
    /// shaft and pivot.
    #[must_use]
    pub fn new(arm: f64, pivot_distance: f64, radius: f64, side: f64) -> Self {
        let square = libm::hypot(arm, pivot_distance);
        Self { arm, pivot_distance, side, radius, prime_radius: square, start: PI / 2.0 }
    }
}

impl Follower for SwingingRoller {
    fn element(&self) -> Element {
        Element::Roller { radius: self.radius }
    }

    fn quantity(&self) -> Quantity {
        Quantity::Angle
    }

    fn touch(&self, angle: f64, lift: &Jet) -> Touch {
        let (sin, cos) = libm::sincos(angle);
        self.touch_turned(angle, sin, cos, lift)
    }

    fn point_turned(&self, _: f64, sin: f64, cos: f64, lift: &Jet) -> (Vector2<f64>, Vector2<f64>) {
        let (l, t) = (self.arm, self.side);
        let (sp, cp) = libm::sincos(self.start + lift.s);
        let pivot = Vector2::new(self.pivot_distance, 0.0);
        (rotated(Vector2::new(-l * cp, -l * t * sp) + pivot, sin, cos), rotated(Vector2::new(sp, -t * cp), sin, cos))
    }

    fn touch_turned(&self, _: f64, sin: f64, cos: f64, lift: &Jet) -> Touch {
        let (a, l, t) = (self.pivot_distance, self.arm, self.side);
        let psi = self.start + lift.s;
        let (sp, cp) = libm::sincos(psi);
        let [d1, d2, d3] = [lift.ds, lift.dds, lift.ddds];
        // The arm −l (cos ψ, τ sin ψ) in the turning frame, and its derivatives by θ at fixed frame.
        let arm = [
            Vector2::new(-l * cp, -l * t * sp),
            Vector2::new(l * sp * d1, -l * t * cp * d1),
            Vector2::new(l * (sp * d2 + cp * d1 * d1), -l * t * (cp * d2 - sp * d1 * d1)),
            Vector2::new(
                l * (sp * d3 + 3.0 * cp * d1 * d2 - sp * d1 * d1 * d1),
                -l * t * (cp * d3 - 3.0 * sp * d1 * d2 - cp * d1 * d1 * d1),
            ),
        ];
        // A quarter turn for each derivative of the frame: (f)' = f' + J f.
        let [p0, p1, p2, p3] = arm;
        let p0 = p0 + Vector2::new(a, 0.0);
        let first = p1 + left_of(p0);
        let second = p2 + left_of(p1) * 2.0 - p0;
        let third = p3 + left_of(p2) * 3.0 - p1 * 3.0 - left_of(p0);
        let [point, first, second, third, drive] =
            [p0, first, second, third, Vector2::new(sp, -t * cp)].map(|v| rotated(v, sin, cos));
        let curve = CurvePoint::from_derivatives(point, first, second, third);
        Touch { curve, drive, drive_turn: 1.0 + t * d1 }
    }

    fn leverage(&self, _: &Jet) -> f64 {
        self.arm
    }

    fn parameter_of(&self, point: Vector2<f64>, _: Vector2<f64>) -> f64 {
        let (a, l) = (self.pivot_distance, self.arm);
        let cosine = (a * a + l * l - point.norm_squared()) / (2.0 * a * l);
        let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
        libm::atan2(point.y, point.x) - libm::atan2(-l * self.side * sine, a - l * cosine)
    }

    fn carrier(&self) -> Carrier {
        Carrier::Arm { pivot: Vector2::new(self.pivot_distance, 0.0) }
    }

    fn prime_radius(&self) -> Option<f64> {
        Some(self.prime_radius)
    }

    fn place(&self) -> Option<FollowerPlacement> {
        Some(FollowerPlacement::Pivot { arm: self.arm, radius: self.radius, side: self.side })
    }

    /// |C'|² = a² + l² k² − 2 a l k cos ψ, k = 1 + τψ' the rate at which the arm turns on the cam.
    fn speed_slopes(&self, lift: &Jet) -> Option<[f64; 2]> {
        let (a, l) = (self.pivot_distance, self.arm);
        let (turn, turn_slope) = (1.0 + self.side * lift.ds, self.side * lift.dds);
        let (sine, cosine) = libm::sincos(self.start + lift.s);
        let square = a * a + l * l * turn * turn - 2.0 * a * l * turn * cosine;
        let half_slope = l * l * turn * turn_slope - a * l * (turn_slope * cosine - turn * sine * lift.ds);
        Some([half_slope / square.sqrt(), turn_slope])
    }

    fn sized(&self, prime_radius: f64) -> Option<Box<dyn Follower>> {
        let (least, largest) = self.prime_radii();
        if !(least..=largest).contains(&prime_radius) {
            return None;
        }
        let (a, l) = (self.pivot_distance, self.arm);
        let cosine = (a * a + l * l - prime_radius * prime_radius) / (2.0 * a * l);
        Some(Box::new(Self { prime_radius, start: libm::acos(cosine), ..*self }))
    }

    fn of_radius(&self, radius: f64) -> Option<Arc<dyn Follower>> {
        Some(Arc::new(Self { radius, ..*self }))
    }

    fn prime_radii(&self) -> (f64, f64) {
        let (a, l) = (self.pivot_distance, self.arm);
        ((a - l).abs() * (1.0 + REACH_MARGIN), (a + l) * (1.0 - REACH_MARGIN))
    }

    /// ψ stays between 0 and π.
    fn reach(&self) -> (f64, f64) {
        (-self.start, PI - self.start)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Motion;
    use crate::motion::laws::named;
    use crate::motion::program::Program;
    use crate::profile::Curves;

    /// 20° modified by a program, at 75° and 215°: pitch point, profile point, pressure angle, pitch radius, computed with 40
    /// digits by another program (rise 3-4-5 in 120°, dwell 30°, return 3-4-5 150°, dwell 60°; a 140, l 110, Rp 80, r 16 mm).
    #[test]
    fn return_of_a_known_lever() {
        let rise = named("3-4-5");
        let swing = 20.0_f64.to_radians();
        let deg = |degrees: f64| degrees.to_radians();
        let segments =
            [(rise, deg(120.0), swing), (None, deg(30.0), swing), (rise, deg(150.0), 0.0), (None, deg(60.0), 0.0)];
        let program = Program::new(Quantity::Angle, 0.0, &segments).expect("a program");
        let leading = SwingingRoller {
            arm: 0.11,
            pivot_distance: 0.14,
            side: -1.0,
            radius: 0.016,
            prime_radius: 0.08,
            start: libm::acos((0.14_f64 * 0.14 + 0.11 * 0.11 - 0.08 * 0.08) / (2.0 * 0.14 * 0.11)),
        };
        assert!((leading.start.to_degrees() - 34.771_944_031_948_59).abs() < 1e-12);
        let curves = Curves { motion: &program, follower: &leading };
        let (piece, angle) = program.locate(deg(215.0));
        let contact = curves.contact(piece, angle);
        let profile = curves.profile(piece, angle);
        let near = |a: f64, b: f64, tolerance: f64| assert!((a - b).abs() < tolerance, "{a} {b}");
        near(1e3 * contact.curve.point.x, -7.182_799_046_242_997, 1e-11);
        near(1e3 * contact.curve.point.y, -103.626_121_976_129_2, 1e-11);
        near(1e3 * profile.point.x, -9.888_444_372_619_773, 1e-11);
        near(1e3 * profile.point.y, -87.856_547_366_525_53, 1e-11);
        near(contact.pressure_angle.to_degrees(), -21.978_132_399_867_23, 1e-11);
        near(1e3 / contact.curve.curvature, 92.124_351_257_734_28, 1e-9);
        near(1e3 * contact.curve.speed, 110.848_375_633_932_9, 1e-10);
    }
}

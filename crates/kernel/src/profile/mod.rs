//! Motion and follower together: every curve of a cam with exact derivatives, and its worst places.
//!
//! Curves here are functions of the motion's parameter, the cam angle or the overrun of the bed; nothing is sampled. SI units
//! and radians. What follows from the follower's touch (profile, pressure angle, undercut, size) is derived here once, for
//! every follower.

pub mod boundary;
pub mod envelope;
pub mod extremes;
pub mod followed;
pub mod interpolated;
pub mod outline;
pub mod placing;
pub mod size;

use crate::follower::{Element, Follower, Touch};
use crate::geometry::CurvePoint;
use crate::motion::{Jet, Motion, own_pieces};
use crate::numeric::extremum;
use nalgebra::Vector2;

/// Motion and follower together: every curve of a cam.
#[derive(Debug, Clone, Copy)]
pub struct Curves<'a> {
    /// The motion.
    pub motion: &'a dyn Motion,
    /// The follower.
    pub follower: &'a dyn Follower,
}

/// The follower and its motion at one value of the parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Lift and its derivatives.
    pub lift: Jet,
    /// The follower's curve: the pitch curve of a roller, the profile under a face.
    pub curve: CurvePoint,
    /// Unit vector in which the element moves when the lift grows.
    pub drive: Vector2<f64>,
    /// Angle from the outward normal to the direction of motion, rad: positive where the lift grows (centred follower).
    pub pressure_angle: f64,
    /// Its derivative by the parameter.
    pub pressure_angle_slope: f64,
}

/// The worst place of a cam: a value, and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Worst {
    /// The value there.
    pub value: f64,
    /// The motion's parameter: cam angle in rad, or overrun in m.
    pub at: f64,
    /// Place along the axis, m; 0 for a plane cam.
    pub z: f64,
}

impl Worst {
    /// Smaller than any value, at no particular place.
    pub const NONE: Self = Self { value: f64::NEG_INFINITY, at: 0.0, z: 0.0 };

    /// The larger of two, the first of equals.
    #[must_use]
    pub fn or_larger(self, next: Self) -> Self {
        if next.value > self.value { next } else { self }
    }
}

impl Contact {
    /// A follower with this lift at a parameter of its motion.
    #[must_use]
    pub fn new(follower: &dyn Follower, parameter: f64, lift: Jet) -> Self {
        let touch = follower.touch(parameter, &lift);
        let (curve, drive, normal) = (touch.curve, touch.drive, touch.curve.outward());
        // The normal turns at the rate κ ℓ of the tangent, the drive at its own rate.
        Self {
            lift,
            curve,
            drive,
            pressure_angle: libm::atan2(normal.perp(&drive), normal.dot(&drive)),
            pressure_angle_slope: touch.drive_turn - curve.curvature * curve.speed,
        }
    }
}

impl<'a> Curves<'a> {
    /// The follower at a parameter of a piece of the motion.
    #[must_use]
    pub fn touch(&self, piece: usize, parameter: f64) -> Touch {
        self.follower.touch(parameter, &self.motion.jet(piece, parameter))
    }

    /// The follower's curve and the pressure angle at a parameter of a piece of the motion.
    #[must_use]
    pub fn contact(&self, piece: usize, parameter: f64) -> Contact {
        Contact::new(self.follower, parameter, self.motion.jet(piece, parameter))
    }

    /// The profile at a parameter of a piece: the parallel of the follower's curve.
    #[must_use]
    pub fn profile(&self, piece: usize, parameter: f64) -> CurvePoint {
        self.touch(piece, parameter).curve.offset_inward(self.offset())
    }

    /// Radius of curvature under a face, m, signed: not positive where the profile has turned back on itself; and its derivative by
    /// the parameter.
    #[must_use]
    pub fn face_radius(&self, piece: usize, parameter: f64) -> (f64, f64) {
        self.face_radius_of(parameter, &self.motion.jet(piece, parameter))
    }

    /// The radius of curvature under a face, and its derivative, for a given lift.
    pub(crate) fn face_radius_of(&self, parameter: f64, lift: &Jet) -> (f64, f64) {
        let curve = self.follower.touch(parameter, lift).curve;
        let turn = self.follower.on_face(lift).map_or(1.0, |face| face.turn);
        // ℓ = ρ β', which is right where κ = 1/ρ is not; dρ/dθ = −κ' ℓ/κ².
        let radius = curve.speed / turn;
        (radius, -curve.curvature_slope * curve.speed * radius * radius)
    }

    /// Distance of the profile inwards from the follower's curve, m.
    #[must_use]
    pub fn offset(&self) -> f64 {
        self.follower.element().offset()
    }

    /// 1 where the metal lies inside of the follower's curve, −1 where it lies around it.
    #[must_use]
    pub fn metal_side(&self) -> f64 {
        if self.offset() < 0.0 { -1.0 } else { 1.0 }
    }

    /// Radius of the roller, m, whichever side of it the metal is on; `None` under a flat face or a knife edge.
    #[must_use]
    pub fn roller_radius(&self) -> Option<f64> {
        match self.element() {
            Element::Roller { radius } => Some(radius.abs()).filter(|radius| *radius > 0.0),
            Element::Face => None,
        }
    }

    /// The element that touches the cam.
    #[must_use]
    pub fn element(&self) -> Element {
        self.follower.element()
    }

    /// This motion under another follower.
    #[must_use]
    pub fn with<'b>(&self, follower: &'b dyn Follower) -> Curves<'b>
    where
        'a: 'b,
    {
        Curves { motion: self.motion, follower }
    }
}

/// Cells in which the extreme lifts of a piece are searched: a piece has at most two extrema.
const LIFT_CELLS: u32 = 64;

/// Smallest and largest lift of a motion, m or rad.
#[must_use]
pub fn lifts(motion: &dyn Motion) -> (f64, f64) {
    let all = own_pieces(motion).map(|(index, piece)| {
        let [most, least] = extremum::largest_of_both_signs(
            |at| {
                let jet = motion.jet(index, at);
                [jet.s, jet.ds, jet.dds]
            },
            (piece.start, piece.end),
            LIFT_CELLS,
        );
        (-least.value, most.value)
    });
    all.fold((f64::INFINITY, 0.0), |(low, high), (least, top)| (low.min(least), high.max(top)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::follower::TranslatingRoller;
    use crate::motion::EccentricCircle;

    /// The eccentric circle has everything in closed form: pitch curve and profile are circles about (e, 0), the
    /// pressure angle has sin α = −(e/ρ) sin θ.
    #[test]
    fn eccentric_circle_in_closed_form() {
        let (e, rho, roller) = (0.012, 0.06, 0.015);
        let curves =
            Curves { motion: &EccentricCircle::new(e, rho), follower: &TranslatingRoller::new(rho - e, 0.0, roller) };
        for i in 0..360 {
            let angle = f64::from(i).to_radians();
            let contact = curves.contact(0, angle);
            let profile = curves.profile(0, angle);
            let centre = Vector2::new(e, 0.0);
            assert!(((contact.curve.point - centre).norm() - rho).abs() < 1e-16);
            assert!(((profile.point - centre).norm() - (rho - roller)).abs() < 1e-16);
            assert!((contact.curve.curvature * rho - 1.0).abs() < 1e-13);
            assert!((profile.curvature * (rho - roller) - 1.0).abs() < 1e-13);
            assert!((contact.curve.curvature_slope * rho * rho).abs() < 1e-12);
            let sine = -e / rho * libm::sin(angle);
            assert!((libm::sin(contact.pressure_angle) - sine).abs() < 1e-14);
            let slope = -e / rho * libm::cos(angle) / libm::cos(contact.pressure_angle);
            assert!((contact.pressure_angle_slope - slope).abs() < 1e-13);
        }
    }

    /// A law with lift a θ: an Archimedean spiral as pitch curve of a centred follower.
    #[derive(Debug)]
    struct Spiral(f64);

    impl Motion for Spiral {
        fn pieces(&self) -> &[crate::motion::Piece] {
            const WHOLE: [crate::motion::Piece; 1] =
                [crate::motion::Piece { start: 0.0, end: std::f64::consts::TAU, dwell: false }];
            &WHOLE
        }
        fn jet(&self, _: usize, angle: f64) -> Jet {
            Jet { s: self.0 * angle, ds: self.0, dds: 0.0, ddds: 0.0 }
        }
    }

    /// R = R_p + a θ: tan α = a/R, κ = (R² + 2 a²)/(R² + a²)^(3/2), its slope by differentiating that by hand.
    #[test]
    fn archimedean_spiral_in_closed_form() {
        let (prime, a, roller) = (0.08, 0.011, 0.02);
        let curves = Curves { motion: &Spiral(a), follower: &TranslatingRoller::new(prime, 0.0, roller) };
        for i in 0..=360 {
            let angle = f64::from(i).to_radians();
            let contact = curves.contact(0, angle);
            let r = prime + a * angle;
            let square = r * r + a * a;
            let curvature = (r * r + 2.0 * a * a) / libm::pow(square, 1.5);
            let by_angle =
                a * (2.0 * r / libm::pow(square, 1.5) - 3.0 * r * (r * r + 2.0 * a * a) / libm::pow(square, 2.5));
            assert!((contact.pressure_angle - libm::atan2(a, r)).abs() < 1e-15);
            assert!((contact.curve.curvature / curvature - 1.0).abs() < 1e-14);
            assert!((contact.curve.curvature_slope / (by_angle / square.sqrt()) - 1.0).abs() < 1e-12);
            let profile = curves.profile(0, angle);
            assert!((1.0 / profile.curvature - (1.0 / curvature - roller)).abs() < 1e-15);
        }
    }

    /// An offset roller at rest runs on a circle about the shaft with tan α = −ε/u; on the spiral tan α = (a − ε)/u and
    /// κ = [(a−ε)(2a−ε) + u²]/[(a−ε)² + u²]^(3/2).
    #[test]
    fn offset_roller_in_closed_form() {
        let (prime, offset, roller) = (0.08, 0.03, 0.02);
        for a in [0.0, 0.011] {
            let curves = Curves { motion: &Spiral(a), follower: &TranslatingRoller::new(prime, offset, roller) };
            for i in 0..=36 {
                let angle = f64::from(10 * i).to_radians();
                let contact = curves.contact(0, angle);
                let u = (prime * prime - offset * offset).sqrt() + a * angle;
                let b = a - offset;
                let curvature = (b * (2.0 * a - offset) + u * u) / libm::pow(b * b + u * u, 1.5);
                assert!((contact.pressure_angle - libm::atan2(b, u)).abs() < 1e-15);
                assert!((contact.curve.curvature / curvature - 1.0).abs() < 1e-14);
                if a == 0.0 {
                    assert!((contact.curve.point.norm() - prime).abs() < 1e-16);
                    assert!((curves.profile(0, angle).point.norm() - (prime - roller)).abs() < 1e-16);
                    assert!((1.0 / contact.curve.curvature - prime).abs() < 1e-15);
                }
            }
        }
    }

    /// Curvature slope of pitch curve and profile against central differences, offset follower included.
    #[test]
    fn frame_derivatives_belong_to_the_curve() {
        #[derive(Debug)]
        struct SineLift;
        impl Motion for SineLift {
            fn pieces(&self) -> &[crate::motion::Piece] {
                const WHOLE: [crate::motion::Piece; 1] =
                    [crate::motion::Piece { start: 0.0, end: std::f64::consts::TAU, dwell: false }];
                &WHOLE
            }
            fn jet(&self, _: usize, a: f64) -> Jet {
                let (sin, cos) = (libm::sin(3.0 * a), libm::cos(3.0 * a));
                Jet { s: 0.004 * (1.0 + sin), ds: 0.012 * cos, dds: -0.036 * sin, ddds: -0.108 * cos }
            }
        }
        let curves = Curves { motion: &SineLift, follower: &TranslatingRoller::new(0.1, 0.02, 0.01) };
        let h = 1e-3;
        for i in 0..90 {
            let angle = 0.07 * f64::from(i);
            let pitch = |n: f64| curves.contact(0, angle + n * h).curve;
            let profile = |n: f64| curves.profile(0, angle + n * h);
            for frame in [&pitch as &dyn Fn(f64) -> CurvePoint, &profile] {
                let here = frame(0.0);
                let point = |n| frame(n).point;
                let tangent = ((point(1.0) - point(-1.0)) * 8.0 - (point(2.0) - point(-2.0))) / (12.0 * h);
                assert!((tangent - here.tangent * here.speed).norm() < 1e-10);
                let k = |n| frame(n).curvature;
                let slope = (8.0 * (k(1.0) - k(-1.0)) - (k(2.0) - k(-2.0))) / (12.0 * h * here.speed);
                assert!((slope - here.curvature_slope).abs() < 1e-5 * (1.0 + slope.abs()), "{slope} {here:?}");
            }
            let alpha = |n: f64| curves.contact(0, angle + n * h).pressure_angle;
            let slope = (8.0 * (alpha(1.0) - alpha(-1.0)) - (alpha(2.0) - alpha(-2.0))) / (12.0 * h);
            assert!((slope - curves.contact(0, angle).pressure_angle_slope).abs() < 1e-9);
        }
    }
}

//! The cam as exact curves: pitch curve, normal, curvature, pressure angle, profile.
//!
//! Curves here are functions of the law's parameter, the cam angle or the overrun of the bed, with exact derivatives;
//! nothing is sampled. SI units and radians.

pub mod between;
pub mod conoid;
pub mod envelope;
pub mod extremes;
pub mod plate;
pub mod rotary;
pub mod size;

use crate::follower::Follower;
use crate::law::{Jet, Law};
use crate::machine::Machine;
use nalgebra::Vector2;
use serde::Serialize;

/// A point of a plane curve with what belongs to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// The point.
    pub point: Vector2<f64>,
    /// Unit tangent in the direction of growing parameter.
    pub tangent: Vector2<f64>,
    /// Arc length per unit of the parameter; negative where an offset has turned back on itself.
    pub speed: f64,
    /// Curvature, positive where the curve turns left.
    pub curvature: f64,
    /// Derivative of the curvature by the arc length.
    pub curvature_slope: f64,
}

impl Frame {
    /// From the first three derivatives by the parameter.
    ///
    /// κ = C'×C''/ℓ³ and dκ/dt = C'×C'''/ℓ³ − 3 κ (C'·C'')/ℓ², ℓ = |C'|.
    #[must_use]
    pub fn from_derivatives(
        point: Vector2<f64>,
        first: Vector2<f64>,
        second: Vector2<f64>,
        third: Vector2<f64>,
    ) -> Self {
        let speed = first.norm();
        let cube = speed * speed * speed;
        let curvature = first.perp(&second) / cube;
        let by_parameter = first.perp(&third) / cube - 3.0 * curvature * first.dot(&second) / (speed * speed);
        Self { point, tangent: first / speed, speed, curvature, curvature_slope: by_parameter / speed }
    }

    /// The unit normal to the right of the tangent: outward for a curve that runs counter-clockwise.
    #[must_use]
    pub fn outward(&self) -> Vector2<f64> {
        Vector2::new(self.tangent.y, -self.tangent.x)
    }

    /// The same curve in a unit `factor` times smaller, 1000 for millimetres.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            point: self.point * factor,
            tangent: self.tangent,
            speed: self.speed * factor,
            curvature: self.curvature / factor,
            curvature_slope: self.curvature_slope / (factor * factor),
        }
    }

    /// The parallel curve at `distance` to the left (inward), same parameter.
    ///
    /// With m = 1 − κ·distance: speed × m, curvature / m, curvature slope / m³.
    #[must_use]
    pub fn offset_inward(&self, distance: f64) -> Self {
        let m = 1.0 - self.curvature * distance;
        Self {
            point: self.point - self.outward() * distance,
            tangent: self.tangent,
            speed: self.speed * m,
            curvature: self.curvature / m,
            curvature_slope: self.curvature_slope / (m * m * m),
        }
    }
}

/// Law and follower together: every curve of a cam.
#[derive(Debug, Clone)]
pub struct Curves<L, F> {
    /// The law.
    pub law: L,
    /// The follower.
    pub follower: F,
}

/// What is known at one cam angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Lift and its derivatives.
    pub lift: Jet,
    /// The pitch curve.
    pub pitch: Frame,
    /// Angle from the outward normal to the drive direction, rad: positive where the lift grows (centred follower).
    pub pressure_angle: f64,
    /// Its derivative by the cam angle.
    pub pressure_angle_slope: f64,
}

/// The curves of a cam of any kind.
pub type AnyCurves<'a> = Curves<&'a dyn Law, &'a dyn Follower>;

/// A place on a cam, as reports tell it.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Place {
    /// Cam angle, degrees in [0, 360).
    pub cam_deg: Option<f64>,
    /// Overrun of the bed, mm.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x_mm: Option<f64>,
}

impl Place {
    /// At a cam angle in rad.
    #[must_use]
    pub fn at_angle(angle: f64) -> Self {
        let degrees = angle.to_degrees() % 360.0;
        let positive = if degrees < 0.0 { degrees + 360.0 } else { degrees };
        // A hair below zero rounds up to a whole turn.
        let cam_deg = if positive >= 360.0 { 0.0 } else { positive + 0.0 };
        Self { cam_deg: Some(cam_deg), x_mm: None }
    }

    /// At an overrun in m.
    #[must_use]
    pub fn at_overrun(x: f64) -> Self {
        Self { cam_deg: None, x_mm: Some(1e3 * x + 0.0) }
    }
}

/// In degrees or millimetres, as a person reads it.
impl std::fmt::Display for Place {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.cam_deg, self.x_mm) {
            (Some(degrees), _) => write!(formatter, "{degrees:.3}°"),
            (None, Some(x)) => write!(formatter, "x = {x:.3} mm"),
            (None, None) => formatter.write_str("–"),
        }
    }
}

/// What checks and drawings want to know of a cam, whatever its kind.
pub trait Cam: Sync {
    /// The machine it is for.
    fn machine(&self) -> &Machine;

    /// Speed of the main shaft, rpm.
    fn rpm(&self) -> f64;

    /// What it is called: "rotary cam".
    fn kind(&self) -> &'static str;

    /// Law and follower.
    fn curves(&self) -> AnyCurves<'_>;

    /// Where a value of the parameter is.
    fn place(&self, parameter: f64) -> Place;

    /// The parameter at which a point of the drawing (m) lies.
    fn parameter_at(&self, point: Vector2<f64>) -> f64;

    /// Whether a point of the drawing (m) lies on an end of the cam, where its outline has corners.
    fn ends_at(&self, _: Vector2<f64>) -> bool {
        false
    }

    /// Ways in which the roller meets the drawing: as it is, or with the drawing mirrored about X.
    fn mirrored(&self) -> &'static [bool];

    /// Force between roller and cam along the normal, N.
    fn contact_force(&self, piece: usize, parameter: f64) -> f64;

    /// Force that presses the roller onto the cam along its path, N; `None` when the machine file does not tell what
    /// beside the air does.
    fn closing_force(&self, piece: usize, parameter: f64) -> Option<f64>;

    /// |inertia − air and cam| with the roller `moved` (m) along its path from where the law wants it, and touching the
    /// cam where its normal (a unit vector out of the metal) is, N; 0 outside the reversal.
    fn unbalanced(&self, piece: usize, parameter: f64, moved: f64, normal: Vector2<f64>) -> f64;

    /// Least metal behind the profile, m, when there is something behind it.
    fn wall(&self) -> Option<f64>;

    /// Room between two rollers that face each other, m, and where it is least; `None` where there is only one.
    fn roller_clearance(&self) -> Option<(f64, Place)> {
        None
    }

    /// Straight edges of the drawing (m) that no roller touches.
    fn edges(&self) -> Vec<[Vector2<f64>; 2]> {
        Vec::new()
    }

    /// What would keep the limits of pressure angle and curvature.
    fn remedy(&self) -> Option<String>;
}

impl<L: Law, F: Follower> Curves<L, F> {
    /// Pitch curve and pressure angle at a cam angle of a piece of the law.
    #[must_use]
    pub fn contact(&self, piece: usize, angle: f64) -> Contact {
        let lift = self.law.jet(piece, angle);
        let pitch = self.follower.pitch(angle, &lift);
        let frame = Frame::from_derivatives(pitch.point, pitch.first, pitch.second, pitch.third);
        let normal = frame.outward();
        // The normal turns at the rate κ ℓ of the tangent, the drive at its own rate.
        Contact {
            lift,
            pitch: frame,
            pressure_angle: libm::atan2(normal.perp(&pitch.drive), normal.dot(&pitch.drive)),
            pressure_angle_slope: pitch.drive_turn - frame.curvature * frame.speed,
        }
    }

    /// The profile at a cam angle of a piece: the parallel curve at the roller's radius.
    #[must_use]
    pub fn profile(&self, piece: usize, angle: f64) -> Frame {
        self.contact(piece, angle).pitch.offset_inward(self.follower.roller_radius())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::follower::TranslatingRoller;
    use crate::law::EccentricCircle;

    /// The eccentric circle has everything in closed form: pitch curve and profile are circles about (e, 0), the
    /// pressure angle has sin α = −(e/ρ) sin θ.
    #[test]
    fn eccentric_circle_in_closed_form() {
        let (e, rho, roller) = (0.012, 0.06, 0.015);
        let curves =
            Curves { law: EccentricCircle::new(e, rho), follower: TranslatingRoller::new(rho - e, 0.0, roller) };
        for i in 0..360 {
            let angle = f64::from(i).to_radians();
            let contact = curves.contact(0, angle);
            let profile = curves.profile(0, angle);
            let centre = Vector2::new(e, 0.0);
            assert!(((contact.pitch.point - centre).norm() - rho).abs() < 1e-16);
            assert!(((profile.point - centre).norm() - (rho - roller)).abs() < 1e-16);
            assert!((contact.pitch.curvature * rho - 1.0).abs() < 1e-13);
            assert!((profile.curvature * (rho - roller) - 1.0).abs() < 1e-13);
            assert!((contact.pitch.curvature_slope * rho * rho).abs() < 1e-12);
            let sine = -e / rho * libm::sin(angle);
            assert!((libm::sin(contact.pressure_angle) - sine).abs() < 1e-14);
            let slope = -e / rho * libm::cos(angle) / libm::cos(contact.pressure_angle);
            assert!((contact.pressure_angle_slope - slope).abs() < 1e-13);
        }
    }

    /// A law with lift a θ: an Archimedean spiral as pitch curve of a centred follower.
    struct Spiral(f64);

    impl Law for Spiral {
        fn pieces(&self) -> &[crate::law::Piece] {
            const WHOLE: [crate::law::Piece; 1] =
                [crate::law::Piece { start: 0.0, end: std::f64::consts::TAU, dwell: false }];
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
        let curves = Curves { law: Spiral(a), follower: TranslatingRoller::new(prime, 0.0, roller) };
        for i in 0..=360 {
            let angle = f64::from(i).to_radians();
            let contact = curves.contact(0, angle);
            let r = prime + a * angle;
            let square = r * r + a * a;
            let curvature = (r * r + 2.0 * a * a) / libm::pow(square, 1.5);
            let by_angle =
                a * (2.0 * r / libm::pow(square, 1.5) - 3.0 * r * (r * r + 2.0 * a * a) / libm::pow(square, 2.5));
            assert!((contact.pressure_angle - libm::atan2(a, r)).abs() < 1e-15);
            assert!((contact.pitch.curvature / curvature - 1.0).abs() < 1e-14);
            assert!((contact.pitch.curvature_slope / (by_angle / square.sqrt()) - 1.0).abs() < 1e-12);
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
            let curves = Curves { law: Spiral(a), follower: TranslatingRoller::new(prime, offset, roller) };
            for i in 0..=36 {
                let angle = f64::from(10 * i).to_radians();
                let contact = curves.contact(0, angle);
                let u = (prime * prime - offset * offset).sqrt() + a * angle;
                let b = a - offset;
                let curvature = (b * (2.0 * a - offset) + u * u) / libm::pow(b * b + u * u, 1.5);
                assert!((contact.pressure_angle - libm::atan2(b, u)).abs() < 1e-15);
                assert!((contact.pitch.curvature / curvature - 1.0).abs() < 1e-14);
                if a == 0.0 {
                    assert!((contact.pitch.point.norm() - prime).abs() < 1e-16);
                    assert!((curves.profile(0, angle).point.norm() - (prime - roller)).abs() < 1e-16);
                    assert!((1.0 / contact.pitch.curvature - prime).abs() < 1e-15);
                }
            }
        }
    }

    /// Curvature slope of pitch curve and profile against central differences, offset follower included.
    #[test]
    fn frame_derivatives_belong_to_the_curve() {
        struct Wave;
        impl Law for Wave {
            fn pieces(&self) -> &[crate::law::Piece] {
                const WHOLE: [crate::law::Piece; 1] =
                    [crate::law::Piece { start: 0.0, end: std::f64::consts::TAU, dwell: false }];
                &WHOLE
            }
            fn jet(&self, _: usize, a: f64) -> Jet {
                let (sin, cos) = (libm::sin(3.0 * a), libm::cos(3.0 * a));
                Jet { s: 0.004 * (1.0 + sin), ds: 0.012 * cos, dds: -0.036 * sin, ddds: -0.108 * cos }
            }
        }
        let curves = Curves { law: Wave, follower: TranslatingRoller::new(0.1, 0.02, 0.01) };
        let h = 1e-3;
        for i in 0..90 {
            let angle = 0.07 * f64::from(i);
            let pitch = |n: f64| curves.contact(0, angle + n * h).pitch;
            let profile = |n: f64| curves.profile(0, angle + n * h);
            for frame in [&pitch as &dyn Fn(f64) -> Frame, &profile] {
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

    #[test]
    fn angles_are_told_within_one_turn() {
        for (angle, degrees) in [(0.0, 0.0), (-std::f64::consts::FRAC_PI_2, 270.0), (7.0, 7.0_f64.to_degrees() - 360.0)]
        {
            assert!((Place::at_angle(angle).cam_deg.expect("an angle") - degrees).abs() < 1e-12);
        }
        assert_eq!(Place::at_angle(-1e-18).cam_deg.map(f64::to_bits), Some(0.0_f64.to_bits()));
    }
}

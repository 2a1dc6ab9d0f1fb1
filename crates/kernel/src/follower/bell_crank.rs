//! The bell crank whose roller runs under a plate on the bed.

use super::{Element, Follower, Touch};
use crate::geometry::CurvePoint;
use crate::motion::Jet;
use nalgebra::Vector2;

/// A roller on the arm l1 of a lever whose other arm l2 moves the bottom by Δx, sin ψ = Δx/l2.
///
/// In the frame of the bed the roller of the upper flank is at X = x + l1 (sin(Δ+ψ) − sin Δ), a + l1 (cos Δ − cos(Δ+ψ)),
/// a above the bed's axis at x = ψ = 0. This is the roller of the lower flank, mirrored, so that the outline
/// runs counter-clockwise with growing x and the metal lies to the left as in a disc cam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BellCrank {
    /// Roller arm l1, m.
    pub roller_arm: f64,
    /// Bottom arm l2, m.
    pub bottom_arm: f64,
    /// Δ, rad.
    pub delta: f64,
    /// Δx of the bottom at lift 0, m.
    pub lowest: f64,
    /// Distance a of the roller from the bed's axis at Δx = 0, m.
    pub axis_distance: f64,
    /// Radius of the roller, m.
    pub roller_radius: f64,
}

impl BellCrank {
    /// ψ and its first three derivatives by x.
    fn lever(&self, lift: &Jet) -> [f64; 4] {
        let s = (self.lowest + lift.s) / self.bottom_arm;
        let [d1, d2, d3] = [lift.ds, lift.dds, lift.ddds].map(|d| d / self.bottom_arm);
        // From cos ψ ψ' = s', differentiated twice more.
        let cos = ((1.0 - s) * (1.0 + s)).sqrt();
        let first = d1 / cos;
        let second = (d2 + s * first * first) / cos;
        let third = (d3 + 3.0 * s * first * second + cos * first * first * first) / cos;
        [libm::asin(s), first, second, third]
    }

    /// Place of the roller along the plate, and its distance from the axis, m.
    fn roller(&self, x: f64, psi: f64) -> (f64, f64) {
        let l = self.roller_arm;
        // Differences of sine and cosine by products, exact for a small ψ: sin θ − sin Δ = 2 cos(Δ + ψ/2) sin(ψ/2).
        let (half, middle) = (libm::sin(0.5 * psi), self.delta + 0.5 * psi);
        (x + 2.0 * l * libm::cos(middle) * half, self.axis_distance + 2.0 * l * libm::sin(middle) * half)
    }
}

impl Follower for BellCrank {
    fn element(&self) -> Element {
        Element::Roller { radius: self.roller_radius }
    }

    fn touch(&self, x: f64, lift: &Jet) -> Touch {
        let [psi, first, second, third] = self.lever(lift);
        let theta = self.delta + psi;
        let (sin, cos) = libm::sincos(theta);
        let l = self.roller_arm;
        let (along, up) = self.roller(x, psi);
        // d(l sin θ) = l cos θ ψ', d(−l cos θ) = l sin θ ψ'.
        let square = first * first;
        let (second_cos, second_sin) = (second, square);
        let (third_cos, third_sin) = (third - square * first, 3.0 * first * second);
        let curve = CurvePoint::from_derivatives(
            Vector2::new(along, -up),
            Vector2::new(1.0 + l * cos * first, -l * sin * first),
            Vector2::new(l * (cos * second_cos - sin * second_sin), -l * (sin * second_cos + cos * second_sin)),
            Vector2::new(l * (cos * third_cos - sin * third_sin), -l * (sin * third_cos + cos * third_sin)),
        );
        Touch { curve, drive: Vector2::new(cos, -sin), drive_turn: -first }
    }

    fn point_turned(&self, x: f64, _: f64, _: f64, lift: &Jet) -> (Vector2<f64>, Vector2<f64>) {
        let [psi, ..] = self.lever(lift);
        let (sin, cos) = libm::sincos(self.delta + psi);
        let (along, up) = self.roller(x, psi);
        (Vector2::new(along, -up), Vector2::new(cos, -sin))
    }

    fn leverage(&self, lift: &Jet) -> f64 {
        let s = (self.lowest + lift.s) / self.bottom_arm;
        // dψ/dΔx = 1/(l2 cos ψ).
        self.roller_arm / (self.bottom_arm * ((1.0 - s) * (1.0 + s)).sqrt())
    }

    fn parameter_of(&self, centre: Vector2<f64>, _: Vector2<f64>) -> f64 {
        let up = -centre.y - self.axis_distance;
        let theta = libm::acos(libm::cos(self.delta) - up / self.roller_arm);
        centre.x - self.roller_arm * (libm::sin(theta) - libm::sin(self.delta))
    }
}

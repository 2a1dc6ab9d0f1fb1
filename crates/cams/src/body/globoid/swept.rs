//! The globoid as a body with swept flanks: the rollers rolled past any point, its round faces and its volume.

use super::{End, FlankCurve, Globoid};
use crate::body::swept::{FlankMiss, FlankSide, RoundFace, RoundForm, SweptFlanks, TurnedCam, integrate_smooth, miss};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::numeric::quadrature;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// Panels of eight points over the depth of the groove.
const PANELS_DEEP: u32 = 2;

impl Globoid {
    /// Volume of the whole blank, m³: within the tube of the floor, and what lies between both tubes.
    fn blank(&self) -> f64 {
        let (distance, end) = (self.turret.distance, self.end_angle);
        let (sin, cos) = libm::sincos(end);
        let within = |tube: f64| {
            // π ∫ (D − w cos φ)² w cos φ dφ
            let first = 2.0 * distance * distance * sin;
            let second = 2.0 * distance * tube * (end + sin * cos);
            let third = tube * tube * (2.0 * sin - 2.0 / 3.0 * sin * sin * sin);
            PI * tube * (first - second + third)
        };
        let (outer, floor) = (self.outside, self.floor);
        let squares = floor * floor - outer * outer;
        let cubes = floor * floor * floor - outer * outer * outer;
        within(floor) + TAU * (squares * distance * end - 2.0 / 3.0 * cubes * sin)
    }

    /// Area of the groove of a roller on the torus at a distance from the turret's axis, m²: ∮ w (D φ − w sin φ) du round it, with the polar angle u.
    fn groove_area(&self, from_turret: f64, roller: f64) -> f64 {
        let height = |about: f64| from_turret * (self.turret.distance * about - from_turret * libm::sin(about));
        let of = |flank: FlankSide| {
            let curve = FlankCurve { flank, roller, from_turret };
            let ends = [End::Bottom, End::Top].map(|end| self.passes(curve, end).unwrap_or(f64::NAN));
            let mut area = 0.0;
            for (from, to) in self.smooth_parts(ends) {
                let value = |angle: f64| {
                    let found = self.edge(curve, angle);
                    found
                        .map_or(f64::NAN, |found| height(found.about_turret(self.turret.distance)) * found.polar_rate())
                };
                area += integrate_smooth(value, (from, to));
            }
            let polar = |angle: f64| self.edge(curve, angle).map_or(f64::NAN, |found| angle + found.ahead());
            (area, ends.map(polar))
        };
        let ((upper, [enters, leaves]), (lower, [later, last])) = (of(FlankSide::Upper), of(FlankSide::Lower));
        // Along the ends, from where the upper flank passes them to where the lower one does.
        upper - lower + height(-self.end_angle) * (enters - later) - height(self.end_angle) * (leaves - last)
    }

    /// The parts of a range of cam angles, of any turn, within the pieces of the motion.
    fn smooth_parts(&self, [from, to]: [f64; 2]) -> Vec<(f64, f64)> {
        let start = self.groove.motion.range().0;
        let mut parts = Vec::new();
        let mut turns = ((from - start) / TAU).floor();
        while start + turns * TAU < to {
            for piece in self.groove.motion.pieces() {
                let part = ((piece.start + turns * TAU).max(from), (piece.end + turns * TAU).min(to));
                if part.1 > part.0 {
                    parts.push(part);
                }
            }
            turns += 1.0;
        }
        parts
    }

    /// Volume without holes, mm³.
    pub(super) fn volume(&self) -> f64 {
        let area =
            |from: f64| (0..self.turret.advance).map(|roller| self.groove_area(from, f64::from(roller))).sum::<f64>();
        let cut = quadrature::integrate(area, (self.outside, self.floor), PANELS_DEEP);
        (self.blank() - cut) * MILLIMETRES * MILLIMETRES * MILLIMETRES
    }
}

impl SweptFlanks for Globoid {
    fn turned(&self) -> Result<&dyn TurnedCam, &'static str> {
        Err("its flanks lie in space: -two-axes.csv has the places of the tool")
    }

    fn miss(&self, point: Vector3<f64>) -> FlankMiss {
        miss(self, point)
    }

    fn form(&self) -> RoundForm {
        let major = MILLIMETRES * self.turret.distance;
        let torus = |from: f64| RoundFace::Torus { major, minor: MILLIMETRES * from };
        let rim = |from: f64, end: f64| {
            let (radius, height) = self.rim(from);
            (MILLIMETRES * radius, end * MILLIMETRES * height)
        };
        let cone = |end: f64| RoundFace::Cone { between: [rim(self.outside, end), rim(self.floor, end)] };
        let (radius, height) = rim(self.floor, 1.0);
        RoundForm {
            faces: vec![torus(self.outside), torus(self.floor), cone(-1.0), cone(1.0)],
            rim: radius,
            ends: (-height, height),
            volume: self.volume(),
        }
    }
}

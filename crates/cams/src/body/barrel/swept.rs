//! The barrel as a body with swept flanks: the roller rolled past any point, and the curves of the developed view.

use super::{Barrel, BarrelLine, BarrelRoller};
use crate::body::Layer;
use crate::body::swept::{
    Descent, FlankMiss, FlankSide, NearestRoller, RoundFace, RoundForm, SeenPoint, SweptFlanks, TurnedCam,
    integrate_smooth,
};
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;

/// Cam angles to either side of a point at which the roller is tried first, their distance over that of the flank from the roller's path, and steps to
/// the nearest one.
const TRIED: i32 = 4;
const APART: f64 = 0.3;
const STEPS: usize = 12;
const AT_REST: f64 = 1e-14;

/// The curves of the developed view with their layers: both flanks on the outside, and the centre line of the roller there.
pub(super) const CURVES: [(Option<FlankSide>, Layer); 3] =
    [(Some(FlankSide::Upper), Layer::FlankUpper), (Some(FlankSide::Lower), Layer::FlankLower), (None, Layer::Pitch)];

/// The cam angles about a polar angle at which a roller is tried first, whose longest step is given, rad.
pub(crate) fn tried_about(polar: f64, longest: f64) -> impl Iterator<Item = f64> {
    (-TRIED..=TRIED).map(move |i| polar + APART * longest * f64::from(i))
}

/// Where a roller comes nearest to a point at a polar angle, in steps no longer than given, rad.
pub(super) fn nearest_about(polar: f64, longest: f64, see: impl Fn(f64) -> SeenPoint) -> NearestRoller {
    let tried = tried_about(polar, longest).map(|angle| (angle, see(angle)));
    let start = tried.reduce(|a, b| if b.1.square() < a.1.square() { b } else { a });
    let start = start.map_or(polar, |(angle, _)| angle);
    Descent { longest, steps: STEPS }.from(start, see)
}

impl<R: BarrelRoller> Barrel<R> {
    /// Point (mm) and unit tangent of a flank, or of the centre line of the roller, in the developed view at a piece and cam angle: x along the outer circumference, growing with the cam angle
    /// if the cam turns clockwise; y along the axis.
    pub(super) fn developed_at(&self, flank: Option<FlankSide>, place: (usize, f64)) -> (Vector2<f64>, Vector2<f64>) {
        let (point, slope) = self.developed_with_slope(flank, place);
        (point, slope.normalize())
    }

    /// The point of [`Self::developed_at`], mm, and its derivative with respect to the cam angle, mm/rad.
    fn developed_with_slope(&self, flank: Option<FlankSide>, place: (usize, f64)) -> (Vector2<f64>, Vector2<f64>) {
        let distance = flank.map_or(0.0, |flank| self.groove.signed(flank));
        let nowhere = Vector2::repeat(f64::NAN);
        let Some(found) = self.axis(place.0, place.1).on_cylinder(distance, self.outer) else {
            return (nowhere, nowhere);
        };
        let x = |value: f64| self.groove.sense() * self.outer * value;
        let slope = Vector2::new(x(found.by_angle[0]), found.by_angle[1]);
        (Vector2::new(x(place.1 + found.ahead), found.height) * MILLIMETRES, slope * MILLIMETRES)
    }

    /// Where the roller comes nearest to a point of the cam, m.
    pub(super) fn nearest_roller(&self, point: Vector3<f64>) -> NearestRoller {
        let polar = libm::atan2(point.y, point.x);
        let longest = self.groove.farther() / point.xy().norm();
        nearest_about(polar, longest, |angle| self.see(point, angle))
    }

    /// A point (m) seen along the roller at a cam angle.
    fn see(&self, point: Vector3<f64>, angle: f64) -> SeenPoint {
        let (piece, inside) = self.groove.motion.locate(angle);
        let line = self.axis(piece, inside);
        let axis = line.axis();
        let (sin, cos) = libm::sincos(angle);
        let (along, across) = (point.x * cos + point.y * sin, point.y * cos - point.x * sin);
        SeenPoint {
            off: [across - axis.across[0], point.z - axis.along[0]],
            first: [-along - axis.across[1], -axis.along[1]],
            second: [-across - axis.across[2], -axis.along[2]],
            rise: (0.0, 1.0),
        }
    }

    /// Volume of the groove, m³: on each cylinder the area between the two flanks, ∮ z dφ.
    fn groove_volume(&self) -> f64 {
        let (floor, outer) = (self.floor(), self.outer);
        let on = |radius: f64| {
            let height = |side, place: (usize, f64)| {
                self.edge(side, radius, place).map_or(f64::NAN, |found| found.height * found.by_angle[0])
            };
            let areas = self.groove.motion.pieces().iter().enumerate().map(|(index, piece)| {
                let area =
                    |angle: f64| height(FlankSide::Upper, (index, angle)) - height(FlankSide::Lower, (index, angle));
                integrate_smooth(area, (piece.start, piece.end))
            });
            radius * areas.sum::<f64>()
        };
        camgen_kernel::numeric::quadrature::integrate(on, (floor, outer), 1)
    }

    /// Volume without holes, mm³.
    pub(super) fn volume(&self) -> f64 {
        let blank = 0.5 * TAU * self.outer * self.outer * (self.ends.1 - self.ends.0);
        (blank - self.groove_volume()) * MILLIMETRES * MILLIMETRES * MILLIMETRES
    }

    /// The first cam angle of the motion with its piece, and the last.
    pub(super) fn turn(&self) -> [(usize, f64); 2] {
        let pieces = self.groove.motion.pieces();
        let (start, end) = self.groove.motion.range();
        [(0, start), (pieces.len().saturating_sub(1), end)]
    }
}

impl<R: BarrelRoller> SweptFlanks for Barrel<R> {
    fn turned(&self) -> Result<&dyn TurnedCam, &'static str> {
        self.roller.without_tool().map_or(Ok(self), Err)
    }

    fn miss(&self, point: Vector3<f64>) -> FlankMiss {
        R::miss(self, point)
    }

    fn form(&self) -> RoundForm {
        RoundForm {
            faces: [self.outer, self.floor()]
                .map(|radius| RoundFace::Cylinder { radius: MILLIMETRES * radius })
                .to_vec(),
            rim: MILLIMETRES * self.outer,
            ends: (MILLIMETRES * self.ends.0, MILLIMETRES * self.ends.1),
            volume: self.volume(),
        }
    }

    fn developed(&self) -> Vec<(Layer, [Vector2<f64>; 2])> {
        let ends = |flank| self.turn().map(|place| self.developed_at(flank, place).0);
        CURVES.map(|(flank, layer)| (layer, ends(flank))).to_vec()
    }

    fn developed_miss(&self, layer: Layer, point: Vector2<f64>) -> (f64, f64) {
        let Some((flank, _)) = CURVES.into_iter().find(|(_, other)| *other == layer) else { return (f64::NAN, 0.0) };
        let (start, end) = self.groove.motion.range();
        let at = |angle: f64| {
            let (piece, inside) = self.groove.motion.locate(angle);
            let (place, slope) = self.developed_with_slope(flank, (piece, inside));
            // The point of an angle beyond the turn of the motion.
            let shift = MILLIMETRES * self.groove.sense() * self.outer * (angle - inside);
            (place + Vector2::new(shift, 0.0), slope)
        };
        let away = |angle: f64| (point - at(angle).0).norm();
        let within = |angle: f64| angle.clamp(start - 1e-9, end + 1e-9);
        let polar = point.x / (MILLIMETRES * self.groove.sense() * self.outer);
        let step = APART * self.groove.farther() / self.outer;
        let tried = (-TRIED..=TRIED).map(|i| within(polar + step * f64::from(i)));
        let mut angle = tried.min_by(|a, b| away(*a).total_cmp(&away(*b))).unwrap_or(polar);
        for _ in 0..STEPS {
            let (place, slope) = at(angle);
            let mut by = (point - place).dot(&slope) / slope.norm_squared();
            // A step that does not come nearer is halved.
            while by.abs() > AT_REST && !(away(within(angle + by)) < away(angle)) {
                by *= 0.5;
            }
            if by.abs() <= AT_REST {
                break;
            }
            angle = within(angle + by);
        }
        (away(angle), self.groove.motion.locate(angle).1)
    }
}

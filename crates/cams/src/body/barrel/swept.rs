//! The barrel as a body with swept flanks: the roller rolled past any point, and the curves of the developed view.

use super::Barrel;
use crate::body::Layer;
use crate::body::swept::{FlankMiss, RoundFace, RoundForm, SweptFlanks, TurnedCam};
use crate::machine::Rotation;
use camgen_kernel::geometry::MILLIMETRES;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::TAU;

/// Cam angles to either side of a point at which the roller is tried first, their distance over that of the flank from the roller's path, and steps to
/// the nearest one.
const TRIED: i32 = 4;
const APART: f64 = 0.3;
const STEPS: usize = 12;
const AT_REST: f64 = 1e-14;

/// A flank.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FlankSide {
    /// Its metal lies above the roller.
    Upper,
    /// Its metal lies below.
    Lower,
}

impl FlankSide {
    pub(super) const BOTH: [Self; 2] = [Self::Upper, Self::Lower];
}

/// A curve of the developed view.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BarrelCurve {
    /// A flank on the outside.
    Flank(FlankSide),
    /// The centre line of the roller on the outside.
    Pitch,
}

impl BarrelCurve {
    /// All of them.
    pub(super) const ALL: [Self; 3] = [Self::Flank(FlankSide::Upper), Self::Flank(FlankSide::Lower), Self::Pitch];

    /// Its layer.
    #[must_use]
    pub fn layer(self) -> Layer {
        match self {
            Self::Flank(FlankSide::Upper) => Layer::FlankUpper,
            Self::Flank(FlankSide::Lower) => Layer::FlankLower,
            Self::Pitch => Layer::Pitch,
        }
    }

    fn of(layer: Layer) -> Option<Self> {
        Self::ALL.into_iter().find(|curve| curve.layer() == layer)
    }
}

impl Barrel {
    /// 1 where the drawing is that of a cam that turns clockwise, −1 where it is mirrored.
    pub(super) fn sense(&self) -> f64 {
        if self.machine.cam.rotation == Rotation::Clockwise { 1.0 } else { -1.0 }
    }

    /// Point (mm) and unit tangent of a curve of the developed view at a piece and cam angle: x along the outer circumference, growing with the cam angle
    /// if the cam turns clockwise; y along the axis.
    pub(super) fn developed_at(&self, curve: BarrelCurve, place: (usize, f64)) -> (Vector2<f64>, Vector2<f64>) {
        let (point, slope) = self.developed_with_slope(curve, place);
        (point, slope.normalize())
    }

    /// The point of [`Self::developed_at`], mm, and its derivative with respect to the cam angle, mm/rad.
    fn developed_with_slope(&self, curve: BarrelCurve, place: (usize, f64)) -> (Vector2<f64>, Vector2<f64>) {
        let distance = match curve {
            BarrelCurve::Flank(side) => self.signed(side),
            BarrelCurve::Pitch => 0.0,
        };
        let nowhere = Vector2::repeat(f64::NAN);
        let Some(found) = self.axis(place.0, place.1).on_cylinder(distance, self.outer) else {
            return (nowhere, nowhere);
        };
        let x = |value: f64| self.sense() * self.outer * value;
        let slope = Vector2::new(x(found.by_angle[0]), found.by_angle[1]);
        (Vector2::new(x(place.1 + found.ahead), found.height) * MILLIMETRES, slope * MILLIMETRES)
    }

    /// The cam angle, within the turn of the motion, at which the roller comes nearest to a point of the cam, m, with the point's distance across and
    /// along from the centre line there, m.
    fn nearest(&self, point: Vector3<f64>) -> (f64, [f64; 2]) {
        let polar = libm::atan2(point.y, point.x);
        let radius = point.xy().norm();
        let apart = |angle: f64| {
            let (piece, inside) = self.motion.locate(angle);
            let axis = self.axis(piece, inside);
            let (sin, cos) = libm::sincos(angle);
            let (along, across) = (point.x * cos + point.y * sin, point.y * cos - point.x * sin);
            let off = [across - axis.across[0], point.z - axis.along[0]];
            let first = [-along - axis.across[1], -axis.along[1]];
            let second = [-across - axis.across[2], -axis.along[2]];
            (off, first, second)
        };
        let square = |off: [f64; 2]| off[0] * off[0] + off[1] * off[1];
        let longest = self.distances[0].max(self.distances[1]) / radius;
        let step = APART * longest;
        let tried = (-TRIED..=TRIED).map(|i| polar + step * f64::from(i)).map(|angle| (angle, apart(angle)));
        let start = tried.reduce(|a, b| if square(b.1.0) < square(a.1.0) { b } else { a });
        let (mut at, mut here) = start.unwrap_or_else(|| (polar, apart(polar)));
        for _ in 0..STEPS {
            let ([a, b], [da, db], [dda, ddb]) = here;
            let (slope, bend) = (a * da + b * db, da * da + db * db + a * dda + b * ddb);
            let steepest = slope / (da * da + db * db);
            // A longer step could lead to where the roller's axis, without its end, passes the point on the far side of the cam.
            let mut by = (if bend > 0.0 { slope / bend } else { steepest }).clamp(-longest, longest);
            // A step that does not come nearer is halved.
            let mut next = apart(at - by);
            for _ in 0..STEPS {
                if square(next.0) <= square(here.0) {
                    break;
                }
                by *= 0.5;
                next = apart(at - by);
            }
            if square(next.0) > square(here.0) {
                break;
            }
            (at, here) = (at - by, next);
            if by.abs() <= AT_REST {
                break;
            }
        }
        (at, here.0)
    }

    /// Volume of the groove, m³: on each cylinder the area between the two flanks, ∮ z dφ.
    fn groove_volume(&self) -> f64 {
        let (floor, outer) = (self.floor(), self.outer);
        let on = |radius: f64| {
            let of = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
                let area = |angle: f64| {
                    let edge =
                        |side| self.edge(side, radius, (index, angle)).map_or(f64::NAN, |p| p.height * p.by_angle[0]);
                    edge(FlankSide::Upper) - edge(FlankSide::Lower)
                };
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a turn has few panels")]
                let panels = ((piece.end - piece.start) * PANELS_PER_RADIAN).ceil().max(1.0) as u32;
                camgen_kernel::numeric::quadrature::integrate(area, (piece.start, piece.end), panels)
            };
            radius * self.motion.pieces().iter().enumerate().map(of).sum::<f64>()
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
        let pieces = self.motion.pieces();
        let (start, end) = self.motion.range();
        [(0, start), (pieces.len().saturating_sub(1), end)]
    }
}

/// Panels of eight points for a radian of cam angle.
const PANELS_PER_RADIAN: f64 = 4.0;

impl SweptFlanks for Barrel {
    fn turned(&self) -> Option<&dyn TurnedCam> {
        Some(self)
    }

    fn miss(&self, point: Vector3<f64>) -> FlankMiss {
        let sense = self.sense();
        let own = Vector3::new(point.x, sense * point.y, point.z) / MILLIMETRES;
        let (at, [across, along]) = self.nearest(own);
        let away = libm::hypot(across, along);
        let side = if along > 0.0 { FlankSide::Upper } else { FlankSide::Lower };
        let (sin, cos) = libm::sincos(at);
        // Out of the metal, towards the centre line of the roller.
        let inwards = Vector3::new(across * sin, -sense * across * cos, -along) / away;
        let angle = self.motion.locate(at).1;
        FlankMiss { value: MILLIMETRES * (away - self.signed(side).abs()), at: angle, outward: inwards }
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
        let of = |curve: BarrelCurve| (curve.layer(), self.turn().map(|place| self.developed_at(curve, place).0));
        BarrelCurve::ALL.map(of).to_vec()
    }

    fn developed_miss(&self, layer: Layer, point: Vector2<f64>) -> (f64, f64) {
        let Some(curve) = BarrelCurve::of(layer) else { return (f64::NAN, 0.0) };
        let (start, end) = self.motion.range();
        let at = |angle: f64| {
            let (piece, inside) = self.motion.locate(angle);
            let (place, slope) = self.developed_with_slope(curve, (piece, inside));
            // The point of an angle beyond the turn of the motion.
            let shift = MILLIMETRES * self.sense() * self.outer * (angle - inside);
            (place + Vector2::new(shift, 0.0), slope)
        };
        let away = |angle: f64| (point - at(angle).0).norm();
        let within = |angle: f64| angle.clamp(start - 1e-9, end + 1e-9);
        let polar = point.x / (MILLIMETRES * self.sense() * self.outer);
        let step = APART * self.distances[0].max(self.distances[1]) / self.outer;
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
        (away(angle), self.motion.locate(angle).1)
    }
}

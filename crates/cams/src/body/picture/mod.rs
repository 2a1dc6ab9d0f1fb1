//! The mechanism of a turning cam as it moves, for a picture: cam, follower, and the press behind it.
//!
//! All is shown in the frame of the machine, the shaft at the origin. A cam of a press has its follower's path along +x, and behind
//! it the cylinder with its bottom, the air, and the bed with its crank; any other has it upwards.

mod symbols;

pub use symbols::bracket;

use super::Part;
use crate::machine::{Machine, Rotation};
use crate::report::mechanism::{CoordinateTrack, MechanismView, RigidPart, circle, line, rectangle};
use crate::report::sheet::SheetShape;
use camgen_kernel::follower::{Carrier, Element};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;
use symbols::{FOOT, SPRING_SOLID, coil, frame, spiral};

/// What is not modelled of any cam.
pub const RIGID: &[&str] = &[
    "Elasticity: shaft, lever, follower and contact are rigid, so that vibration and bending under load are not shown.",
    "Clearance and wear: bearings, guides and the roller have no play and keep their size.",
    "Speed: the shaft turns at constant speed; starting, stopping and the fluctuation of the drive are not modelled.",
    "Temperature: all sizes are those of the drawing.",
];

/// Share of the prime radius and of the roller by which stems and guides reach beyond what moves.
const MARGIN: f64 = 0.12;
/// Sweep of the arrow of rotation, degrees.
const SWEEP: f64 = 70.0;
/// Half the thickness of a stem or arm over the roller's radius.
const STEM: f64 = 0.22;
/// A knife edge is shown with the stem of a roller of this share of the cam, ground to a point of half this angle, rad.
const KNIFE_OVER_CAM: f64 = 0.12;
const KNIFE: f64 = 0.26;

/// The follower at a place of a turn, in the frame of a clockwise cam, m and rad.
#[derive(Debug, Clone, Copy)]
pub struct FollowerPose {
    /// Cam angle, rad.
    pub angle: f64,
    /// Cam angle in degrees, as the table has it.
    pub cam_deg: f64,
    /// Point of the follower's curve.
    pub curve: Vector2<f64>,
    /// Normal out of the metal there.
    pub outward: Vector2<f64>,
}

/// The roller of the follower of a turning cam over a turn, mm.
#[derive(Debug)]
pub struct FollowerTrack {
    /// Centres of the roller.
    pub rollers: Vec<Vector2<f64>>,
    /// Its radius.
    pub radius: f64,
    /// Largest radius of the cam.
    pub reach: f64,
}

/// The mechanism that a follower drives, in the picture.
pub trait DrivenMechanism {
    /// Its shapes, back to front.
    fn shapes(&self, driven: &FollowerTrack, cover: &mut Cover) -> Vec<RigidPart>;

    /// What is simplified in the picture.
    fn notes(&self) -> Vec<String>;
}

/// A second roller or face of the same follower.
pub struct SecondContact {
    pub(crate) element: Element,
    /// Its places at the angles of the first.
    pub(crate) places: Vec<FollowerPose>,
    /// The profile of its own disc, which turns with the first, m; empty where it runs on the same part.
    pub(crate) profile: Vec<Vector2<f64>>,
}

/// What is shown of a turning cam.
pub struct Scene<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// What of the follower touches the cam.
    pub element: Element,
    /// What carries it.
    pub carrier: Carrier,
    /// The part that turns.
    pub part: &'a Part,
    /// The follower at each sample of the turn.
    pub places: Vec<FollowerPose>,
    /// A second roller or face of the same follower.
    pub second: Option<SecondContact>,
    /// The mechanism that the follower drives; its path then lies along +x.
    pub behind: Option<Box<dyn DrivenMechanism>>,
    /// Speed of the shaft of the cam, rad/s.
    pub shaft_speed: Option<f64>,
    /// Speed of the machine, rpm.
    pub rpm: Option<f64>,
    /// Whether a spring presses the follower on.
    pub spring: bool,
}

/// Extents of the picture so far.
#[derive(Debug, Clone, Copy)]
pub struct Cover(pub Extents);

impl Cover {
    /// Of nothing yet.
    #[must_use]
    pub fn nothing() -> Self {
        Self(Extents { least: Vector2::repeat(f64::INFINITY), largest: Vector2::repeat(f64::NEG_INFINITY) })
    }

    /// Extends it to a box.
    pub fn add(&mut self, x: (f64, f64), y: (f64, f64)) {
        let box_ = Extents { least: Vector2::new(x.0, y.0), largest: Vector2::new(x.1, y.1) };
        self.0 = self.0.with(&box_);
    }

    /// With a margin all round.
    #[must_use]
    pub fn with_margin(self, margin: f64) -> Extents {
        let margin = Vector2::repeat(margin);
        Extents { least: self.0.least - margin, largest: self.0.largest + margin }
    }
}

impl Scene<'_> {
    /// +1 for a cam that turns clockwise, −1 for the other.
    fn sense(&self) -> f64 {
        match self.machine.cam.rotation {
            Rotation::Clockwise => 1.0,
            Rotation::CounterClockwise => -1.0,
        }
    }

    /// A vector in the frame of the follower, x along û and y along n̂, in the frame of the machine.
    fn shown(&self, local: Vector2<f64>) -> Vector2<f64> {
        let across = self.sense() * local.y;
        if self.behind.is_some() { Vector2::new(local.x, across) } else { Vector2::new(-across, local.x) }
    }

    /// Direction of the follower's path, degrees.
    fn path_deg(&self) -> f64 {
        if self.behind.is_some() { 0.0 } else { 90.0 }
    }

    /// A vector of the cam's frame in that of the follower.
    fn local(placed: &FollowerPose, vector: Vector2<f64>) -> Vector2<f64> {
        let along = Vector2::new(libm::cos(placed.angle), libm::sin(placed.angle));
        Vector2::new(vector.dot(&along), along.perp(&vector))
    }

    /// The points of the follower's curve in the follower's frame, mm.
    fn locals(&self) -> Vec<Vector2<f64>> {
        Self::locals_of(&self.places)
    }

    fn locals_of(places: &[FollowerPose]) -> Vec<Vector2<f64>> {
        places.iter().map(|placed| Self::local(placed, placed.curve) * MILLIMETRES).collect()
    }

    /// The tracks of points of the follower's frame.
    fn tracks(&self, points: &[Vector2<f64>]) -> (CoordinateTrack, CoordinateTrack) {
        let (x, y): (Vec<f64>, Vec<f64>) = points.iter().map(|p| self.shown(*p)).map(|p| (p.x, p.y)).unzip();
        (x.into(), y.into())
    }

    /// The view: its parts from the back to the front, and what is below the cam, if anything, added by `more`.
    pub fn view(&self, more: impl FnOnce(&mut Vec<RigidPart>, &mut Cover)) -> MechanismView {
        let (mut parts, mut cover) = (Vec::new(), Cover::nothing());
        let radius = self.largest_radius();
        cover.add((-radius, radius), (-1.2 * radius, radius));
        more(&mut parts, &mut cover);
        parts.extend(self.follower(&mut cover));
        parts.extend(self.second.iter().flat_map(|second| self.second_disc(second, &mut cover)));
        parts.extend(self.cam());
        parts.extend(self.touching(self.element, &self.places));
        if let Some(second) = &self.second {
            parts.extend(self.touching(second.element, &second.places));
            parts.extend(self.second_face(second));
            self.add_second(second, &mut cover);
        }
        let size = cover.0.largest - cover.0.least;
        MechanismView {
            rpm: self.rpm,
            shaft_speed: self.shaft_speed,
            returns: false,
            place: "cam_deg",
            at: self.places.iter().map(|placed| placed.cam_deg).collect(),
            turn_deg: self.places.iter().map(|placed| placed.cam_deg).collect(),
            extents: cover.with_margin(0.03 * size.x.max(size.y)),
            parts,
        }
    }

    /// Largest radius of the profile, mm, at the places.
    fn largest_radius(&self) -> f64 {
        let offset = self.element.offset();
        let of = |placed: &FollowerPose| MILLIMETRES * (placed.curve - placed.outward * offset).norm();
        let blank = self.part.track.as_ref().and_then(|track| track.blank).unwrap_or(0.0);
        self.places.iter().map(of).fold(blank, f64::max)
    }

    fn cam(&self) -> Vec<RigidPart> {
        let shapes = self.part.rims().into_iter().map(|rim| SheetShape::Entity(rim.curve)).collect();
        let turn = self.turns();
        let bore = MILLIMETRES * self.machine.cam.bore_radius.unwrap_or(0.0);
        let edge = self.places.first().map_or(0.0, |placed| placed.curve.norm() - self.element.offset());
        // θ = 0 is the +X axis of the drawing.
        let mark = vec![line((bore, 0.0), (MILLIMETRES * edge, 0.0))];
        let cross = 0.15 * (MILLIMETRES * edge).max(bore);
        let axis = vec![line((-cross, 0.0), (cross, 0.0)), line((0.0, -cross), (0.0, cross))];
        let arrow = self.arrow(bore + 0.4 * (MILLIMETRES * edge - bore).max(0.0));
        vec![
            RigidPart::new("cam", shapes).turned(turn.clone()),
            RigidPart::new("arrow", arrow),
            RigidPart::new("mark", mark).turned(turn),
            RigidPart::new("ground", axis).named("cam", 0.0, -1.04 * self.largest_radius()),
        ]
    }

    /// How far the cam has turned, degrees.
    fn turns(&self) -> Vec<f64> {
        self.places.iter().map(|placed| self.path_deg() - self.sense() * placed.cam_deg).collect()
    }

    /// The other disc of a pair, behind the first, with the arm of its roller.
    fn second_disc(&self, second: &SecondContact, cover: &mut Cover) -> Vec<RigidPart> {
        if second.profile.is_empty() {
            return Vec::new();
        }
        let sense = self.sense();
        let on_drawing = |point: &Vector2<f64>| Vector2::new(point.x, sense * point.y) * MILLIMETRES;
        let profile: Vec<Vector2<f64>> = second.profile.iter().map(on_drawing).collect();
        let radius = profile.iter().map(Vector2::norm).fold(0.0, f64::max);
        cover.add((-radius, radius), (-radius, radius));
        let arm = match self.carrier {
            Carrier::Arm { pivot } => self.arm(pivot * MILLIMETRES, &Self::locals_of(&second.places), cover),
            _ => Vec::new(),
        };
        arm.into_iter().chain([RigidPart::new("cam", vec![SheetShape::Path(profile)]).turned(self.turns())]).collect()
    }

    /// How the cam turns: an arc about the shaft with a head.
    fn arrow(&self, radius: f64) -> Vec<SheetShape> {
        let on = |degrees: f64, radius: f64| {
            let angle = degrees.to_radians();
            Vector2::new(radius * libm::cos(angle), radius * libm::sin(angle))
        };
        let (sweep, head) = (-self.sense() * SWEEP, 0.16 * radius);
        let (start, end) = (270.0 - 0.5 * sweep, 270.0 + 0.5 * sweep);
        let back = end - sweep.signum() * (1.6 * head / radius).to_degrees();
        vec![
            SheetShape::Arc(on(start, radius), on(end, radius), libm::tan(0.25 * sweep.to_radians())),
            SheetShape::Path(vec![on(back, radius - head), on(end, radius), on(back, radius + head)]),
        ]
    }

    /// With the second roller or face.
    fn add_second(&self, second: &SecondContact, cover: &mut Cover) {
        let margin = self.roller();
        for at in Self::locals_of(&second.places).iter().map(|p| self.shown(*p)) {
            // With its name below it.
            cover.add((at.x - margin, at.x + margin), (at.y - 1.5 * margin, at.y + margin));
        }
    }

    /// The second face, which is parallel to the first.
    fn second_face(&self, second: &SecondContact) -> Option<RigidPart> {
        if self.element != Element::Face {
            return None;
        }
        let (x, y) = self.tracks(&Self::locals_of(&second.places));
        let half = 0.6 * self.largest_radius();
        Some(
            RigidPart::new("follower", vec![line((0.0, -half), (0.0, half))])
                .at(x, y)
                .turned(self.normals(&second.places)),
        )
    }

    /// The directions of the normals at some places, degrees.
    fn normals(&self, places: &[FollowerPose]) -> Vec<f64> {
        places
            .iter()
            .map(|placed| {
                let normal = Self::local(placed, placed.outward);
                self.path_deg() + self.sense() * libm::atan2(normal.y, normal.x).to_degrees()
            })
            .collect()
    }

    /// The roller or the contact on a face, with the normal there.
    fn touching(&self, element: Element, places: &[FollowerPose]) -> Vec<RigidPart> {
        let locals = Self::locals_of(places);
        let (x, y) = self.tracks(&locals);
        let normal = self.normals(places);
        match element {
            Element::Roller { radius: 0.0 } => {
                let reach = 2.0 * self.roller();
                vec![RigidPart::new("normal", vec![line((-0.5 * reach, 0.0), (reach, 0.0))]).at(x, y).turned(normal)]
            }
            Element::Roller { radius } => {
                let radius = MILLIMETRES * radius.abs();
                let roller = vec![circle(0.0, 0.0, radius), circle(0.0, 0.0, 0.12 * radius)];
                let lines = vec![line((-radius, 0.0), (1.9 * radius, 0.0))];
                vec![
                    RigidPart::new("roller", roller).at(x.clone(), y.clone()).named("roller", 0.0, -1.15 * radius),
                    RigidPart::new("normal", lines).at(x, y).turned(normal),
                ]
            }
            Element::Face => {
                let reach = 0.25 * locals.iter().map(|p| p.x).fold(0.0, f64::max);
                vec![RigidPart::new("normal", vec![line((-0.3 * reach, 0.0), (reach, 0.0))]).at(x, y).turned(normal)]
            }
        }
    }

    /// What carries the element.
    fn follower(&self, cover: &mut Cover) -> Vec<RigidPart> {
        let locals = self.locals();
        match (self.carrier, self.element, &self.behind) {
            (Carrier::Arm { pivot }, Element::Face, _) => self.swinging_face(pivot * MILLIMETRES, &locals, cover),
            (Carrier::Arm { pivot }, ..) => self.arm(pivot * MILLIMETRES, &locals, cover),
            (_, _, Some(behind)) => {
                let rollers: Vec<Vector2<f64>> = locals.iter().map(|p| self.shown(*p)).collect();
                let radius = MILLIMETRES * self.element.offset();
                behind.shapes(&FollowerTrack { rollers, radius, reach: self.largest_radius() }, cover)
            }
            (Carrier::Stem { offset, tilt }, ..) => self.face((MILLIMETRES * offset, tilt), &locals, cover),
            (Carrier::Straight, _, None) => self.stem(&locals, cover),
        }
    }

    /// Radius of the roller, or of the symbol of a knife edge, mm.
    fn roller(&self) -> f64 {
        let radius = MILLIMETRES * self.element.offset().abs();
        if radius > 0.0 { radius } else { KNIFE_OVER_CAM * self.largest_radius() }
    }

    /// A stem on a straight path between two guides.
    fn stem(&self, locals: &[Vector2<f64>], cover: &mut Cover) -> Vec<RigidPart> {
        let radius = self.roller();
        let (low, high) = range(locals.iter().map(|p| p.x));
        let half = STEM * radius;
        let start = (high + radius * (1.0 + MARGIN)).max(self.largest_radius() + half);
        let length = start + 3.0 * radius - low;
        let (x, y) = self.tracks(locals);
        let stem = if self.element.offset() == 0.0 {
            let point = half / libm::tan(KNIFE);
            let corners = [(0.0, 0.0), (point, half), (length, half), (length, -half), (point, -half), (0.0, 0.0)];
            vec![SheetShape::Path(corners.map(|(x, y)| Vector2::new(x, y)).to_vec())]
        } else {
            vec![rectangle((0.0, length), (-half, half))]
        };
        let offset = locals.first().map_or(0.0, |p| self.shown(*p).x);
        let guides = [-1.0, 1.0].map(|side| {
            let (from, to) = (offset + side * 1.25 * half, offset + side * (2.5 * half + 0.5 * radius));
            rectangle((from, to), (start, start + 1.5 * radius))
        });
        let top = start + 3.0 * radius + high - low;
        cover.add((offset - radius, offset + radius), (low, top));
        let mut parts = vec![RigidPart::new("ground", guides.to_vec())];
        parts.extend(self.spring_on((locals, length), 0.55 * radius, cover));
        parts.push(RigidPart::new("follower", stem).at(x, y).turned(self.path_deg()));
        parts
    }

    /// The spring between the end of a stem, so far above the points of the follower, and the frame above it; of half this width, mm.
    fn spring_on(&self, (foots, length): (&[Vector2<f64>], f64), half: f64, cover: &mut Cover) -> Vec<RigidPart> {
        let (low, high) = range(foots.iter().map(|foot| foot.x + length));
        if !self.spring || !low.is_finite() {
            return Vec::new();
        }
        let top = high + SPRING_SOLID * half;
        let ends: Vec<Vector2<f64>> = foots.iter().map(|foot| Vector2::new(foot.x + length, foot.y)).collect();
        let stretch: Vec<f64> = ends.iter().map(|end| top - end.x).collect();
        let middle = ends.first().map_or(0.0, |end| self.shown(*end).x);
        let (x, y) = self.tracks(&ends);
        cover.add((middle - 2.0 * half, middle + 2.0 * half), (low, top + half));
        let spring = RigidPart::new("spring", vec![coil(half)]).at(x, y).turned(self.path_deg());
        vec![
            RigidPart::new("ground", frame(Vector2::new(middle, top), (2.0 * half, 1.0))),
            RigidPart { stretch: stretch.into(), ..spring },
        ]
    }

    /// A flat face at an angle (rad) with its stem at a distance from the shaft, mm.
    fn face(&self, (offset, tilt): (f64, f64), locals: &[Vector2<f64>], cover: &mut Cover) -> Vec<RigidPart> {
        let (sin, cos) = (libm::sin(tilt), libm::cos(tilt));
        // Where the stem meets the face: on its line, at the offset.
        let foot = |p: &Vector2<f64>| Vector2::new((p.x * cos + p.y * sin - offset * sin) / cos, offset);
        let feet: Vec<Vector2<f64>> = locals.iter().map(foot).collect();
        let (low, high) = range(feet.iter().map(|p| p.x));
        let touched = |(p, foot): (&Vector2<f64>, &Vector2<f64>)| (p.y - foot.y) * cos - (p.x - foot.x) * sin;
        let (least, most) = range(locals.iter().zip(&feet).map(touched));
        let size = range(locals.iter().map(|p| p.x * cos + p.y * sin)).0;
        let half = least.abs().max(most.abs()) + 0.15 * size;
        let thick = 0.06 * size;
        let start = self.largest_radius().max(high) + 2.0 * thick;
        let length = start + 0.4 * size - low;
        let (x, y) = self.tracks(&feet);
        let plate = if tilt == 0.0 {
            rectangle((0.0, thick), (-half, half))
        } else {
            let sin = self.sense() * sin;
            let corners = [(0.0, -half), (thick, -half), (thick, half), (0.0, half), (0.0, -half)];
            let at = |(x, y): (f64, f64)| Vector2::new(x * cos - y * sin, x * sin + y * cos);
            SheetShape::Path(corners.map(at).to_vec())
        };
        // Into a tilted plate, behind whose corner there would be a gap.
        let from = if tilt == 0.0 { thick } else { 0.0 };
        let shapes = vec![plate, rectangle((from, length), (-thick, thick))];
        let middle = feet.first().map_or(0.0, |foot| self.shown(*foot).x);
        let guides = [-1.0, 1.0].map(|side| {
            let (from, to) = (middle + side * 1.3 * thick, middle + side * 4.0 * thick);
            rectangle((from, to), (start + thick, start + thick + 0.2 * size))
        });
        cover.add((middle - half, middle + half), (low - half * sin.abs(), start + 0.4 * size + high - low));
        let mut parts = vec![RigidPart::new("ground", guides.to_vec())];
        parts.extend(self.spring_on((&feet, length), 3.0 * thick, cover));
        parts.push(RigidPart::new("follower", shapes).at(x, y).turned(self.path_deg()));
        parts
    }

    /// A flat face on an arm about a pivot, mm: a bar on the face's side away from the cam, from the pivot past the farthest contact.
    fn swinging_face(&self, pivot: Vector2<f64>, locals: &[Vector2<f64>], cover: &mut Cover) -> Vec<RigidPart> {
        let normals: Vec<Vector2<f64>> = self.places.iter().map(|placed| Self::local(placed, placed.outward)).collect();
        // Along the face from the pivot to the contact.
        let along = |(p, normal): (&Vector2<f64>, &Vector2<f64>)| {
            let tangent = Vector2::new(-normal.y, normal.x);
            tangent * tangent.dot(&(p - pivot)).signum()
        };
        let ways: Vec<Vector2<f64>> = locals.iter().zip(&normals).map(along).collect();
        let back = -pivot.normalize();
        let turn: Vec<f64> = ways
            .iter()
            .map(|way| self.path_deg() + 180.0 + self.sense() * libm::atan2(back.perp(way), back.dot(way)).to_degrees())
            .collect();
        let farthest = locals.iter().zip(&ways).map(|(p, way)| way.dot(&(p - pivot))).fold(0.0, f64::max);
        let (place, thick) = (self.shown(pivot), 0.05 * pivot.norm());
        let (Some(first), Some(way), Some(normal)) = (locals.first(), ways.first(), normals.first()) else {
            return Vec::new();
        };
        // The face in the frame of the arm, x along it: its height, and the side on which the metal is.
        let metal = self.sense() * way.perp(normal);
        let height = metal * normal.dot(&(first - pivot));
        let length = 1.08 * farthest;
        let bar = rectangle((0.0, length), (height, height + metal.signum() * thick));
        let hub = circle(0.0, 0.0, 0.6 * thick.max(height.abs()));
        let ends = locals.iter().zip(&ways).map(|(_, way)| self.shown(pivot + way * length));
        let (xs, ys): (Vec<f64>, Vec<f64>) = ends.map(|end| (end.x, end.y)).unzip();
        let ((left, right), (bottom, top)) = (range(xs.into_iter()), range(ys.into_iter()));
        let (foot, around) = (1.5 * thick, thick + height.abs());
        cover.add((left - around, right + around), (bottom - around, top + around));
        cover.add((place.x - 1.5 * foot, place.x + 1.5 * foot), (place.y, place.y + 2.2 * foot));
        let arm = RigidPart::new("follower", vec![line((0.0, 0.0), (0.0, height)), bar, hub]);
        self.on_pivot(arm.at(place.x, place.y).turned(turn), place, (foot, 0.6 * thick.max(height.abs())))
    }

    /// An arm from a pivot to the roller, mm.
    fn arm(&self, pivot: Vector2<f64>, locals: &[Vector2<f64>], cover: &mut Cover) -> Vec<RigidPart> {
        let half = STEM * MILLIMETRES * self.element.offset().abs();
        let arm = locals.first().map_or(0.0, |p| (p - pivot).norm());
        // Counted from the line to the shaft: an arm swings by less than half a turn from it.
        let turn: Vec<f64> = locals
            .iter()
            .map(|p| {
                let (from, back) = (p - pivot, -pivot.normalize());
                let swung = libm::atan2(back.perp(&from), back.dot(&from)).to_degrees();
                self.path_deg() + 180.0 + self.sense() * swung
            })
            .collect();
        let place = self.shown(pivot);
        let (x, y) = (place.x, place.y);
        let foot = 2.2 * half.max(0.02 * arm);
        let (low, high) = range(locals.iter().map(|p| self.shown(*p).x));
        let roller = MILLIMETRES * self.element.offset().abs();
        cover.add((low - roller, high + roller), (0.0, 0.0));
        let tops = range(locals.iter().map(|p| self.shown(*p).y));
        cover.add((x - 1.5 * foot, x + 1.5 * foot), (tops.0 - roller, (y + 2.2 * foot).max(tops.1 + roller)));
        let part = RigidPart::new("follower", vec![rectangle((0.0, arm), (-half, half)), circle(0.0, 0.0, 1.6 * half)]);
        self.on_pivot(part.at(x, y).turned(turn), place, (foot, 1.6 * half))
    }

    /// An arm with what holds its pivot, and the spring about it; sizes of foot and hub, mm.
    fn on_pivot(&self, arm: RigidPart, place: Vector2<f64>, (foot, hub): (f64, f64)) -> Vec<RigidPart> {
        let spring = self.spring.then(|| RigidPart::new("spring", vec![spiral(hub, FOOT * foot)]).at(place.x, place.y));
        let pin = RigidPart::new("pin", vec![circle(place.x, place.y, 0.35 * hub)]);
        let ground = RigidPart::new("ground", bracket(place, (foot, 1.0)));
        [Some(ground), spring, Some(arm), Some(pin)].into_iter().flatten().collect()
    }
}

/// Smallest and largest of some numbers.
pub fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
}

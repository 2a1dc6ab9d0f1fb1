//! The linkage in its positions, in millimetres: O2 at the origin, the slider's outward direction along +x.

use super::least_transmission;
use crate::press::bed_motion::{Linkage, Pose};
use crate::press::buffer::Bed;
use crate::press::machine::LinkageData;
use camgen_cams::report::plot::figure;
use camgen_cams::report::scheme::{Scheme, SchemeDimension, SchemeJoint, SchemeLabel, SchemePose, Stroke, StrokeKind};
use camgen_cams::report::{degrees, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Sides of the slider over the crank O2C.
pub(super) const SLIDER: [f64; 2] = [0.32, 0.2];
/// Width and height of the slotted link of a yoke over the crank O2C.
pub(super) const SLOT: [f64; 2] = [0.32, 2.4];
/// How far the slider's line goes beyond the slider, over the crank O2C.
const BEYOND: f64 = 0.1;
/// Points of a path over a turn: on a drawing they look like a curve.
const POINTS: u32 = 180;
/// Colours of the links.
const DRIVING: usize = 1;
const COUPLER: usize = 3;
const DRIVEN: usize = 0;
const ROD: usize = 2;

/// A linkage with its lengths.
pub(super) struct LinkagePicture<'a> {
    pub(super) data: &'a LinkageData,
    /// O2C, mm.
    pub(super) crank: f64,
    pose: Pose,
}

/// Where its joints are, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Places {
    /// O1, A and B of a six-bar.
    pub(super) drag_link: Option<[Vector2<f64>; 3]>,
    /// C.
    pub(super) crank: Vector2<f64>,
    /// D.
    pub(super) slider: Vector2<f64>,
}

impl<'a> LinkagePicture<'a> {
    /// Where the file gives no length of the driving crank O1A it is as long as O2C.
    pub(super) fn new(data: &'a LinkageData, bed: &Bed) -> Self {
        let crank_ratio = data.driving_crank.map_or(1.0, |driving| bed.crank_radius / driving);
        let pose = Pose { base_angle: data.base_angle, crank_ratio };
        Self { data, crank: MILLIMETRES * bed.crank_radius, pose }
    }

    /// At an angle of the driving crank from the base, rad.
    pub(super) fn places(&self, theta: f64) -> Places {
        let joints = self.data.linkage.joints(theta, self.pose);
        Places {
            drag_link: joints.drag_link.map(|joints| {
                [joints.shaft, joints.driving, joints.driven].map(|joint| self.crank * Vector2::from(joint))
            }),
            crank: self.crank * Vector2::from(joints.crank),
            slider: self.crank * Vector2::from(joints.slider),
        }
    }

    /// O1A, mm.
    pub(super) fn driving_crank(&self) -> f64 {
        self.crank / self.pose.crank_ratio
    }

    /// The path of a joint over a turn.
    pub(super) fn path(&self, joint: impl Fn(&Places) -> Vector2<f64>) -> Vec<Vector2<f64>> {
        (0..=POINTS).map(|i| joint(&self.places(TAU * (f64::from(i % POINTS) / f64::from(POINTS))))).collect()
    }

    /// The paths of A, B and C, as far as there are such joints.
    pub(super) fn paths(&self) -> Vec<(&'static str, Vec<Vector2<f64>>)> {
        let mut paths = vec![("path of C", self.path(|places| places.crank))];
        if self.data.linkage.drag_link().is_some() {
            let a = self.path(|places| places.drag_link.map_or_else(Vector2::zeros, |[_, a, _]| a));
            let b = self.path(|places| places.drag_link.map_or_else(Vector2::zeros, |[.., b]| b));
            paths.extend([("path of A", a), ("path of B", b)]);
        }
        paths
    }

    /// Half the sides of what is moved at D, mm.
    fn half_body(&self) -> Vector2<f64> {
        let sides = if self.data.linkage == Linkage::Yoke { SLOT } else { SLIDER };
        0.5 * self.crank * Vector2::from(sides)
    }

    /// The line of the slider, as far as the slider goes, and a little more at either end.
    pub(super) fn guide(&self) -> [Vector2<f64>; 2] {
        let ends = self.data.linkage.dead_points().map(|theta| self.places(theta).slider);
        let more = Vector2::new(self.half_body().x + BEYOND * self.crank, 0.0);
        let [outer, inner] = ends;
        [inner.inf(&outer) - more, inner.sup(&outer) + more]
    }

    /// Extents of the joints over a turn and of the slider, mm.
    pub(super) fn covered(&self) -> Extents {
        let slider = self.half_body();
        let guide = self.guide().into_iter().flat_map(|end| [end - slider, end + slider]);
        let paths: Vec<Vector2<f64>> = self.paths().into_iter().flat_map(|(_, path)| path).chain(guide).collect();
        Extents {
            least: paths.iter().fold(Vector2::repeat(f64::INFINITY), |low, point| low.inf(point)),
            largest: paths.iter().fold(Vector2::repeat(f64::NEG_INFINITY), |high, point| high.sup(point)),
        }
    }

    /// What the pictures assume of lengths that the file does not give.
    pub(super) fn assumed(&self) -> Option<String> {
        let open = self.data.linkage.drag_link().is_some() && self.data.driving_crank.is_none();
        open.then(|| {
            let length = shown(self.crank);
            format!("O1A is drawn as long as O2C, {length} mm: the machine file has no linkage.driving_crank.")
        })
    }
}

/// The linkage in its two dead points and where its worst angle is.
pub(super) fn scheme(lying: &LinkagePicture<'_>) -> Scheme {
    let data = lying.data;
    let [outer, inner] = data.linkage.dead_points();
    let mut moments = vec![("outer dead point".to_owned(), outer), ("inner dead point".to_owned(), inner)];
    if let Some((angle, theta)) = least_transmission(&data.linkage) {
        moments.push((format!("least transmission angle, {}°", shown(angle.to_degrees())), theta));
    } else if data.linkage.slider().is_some() {
        let angle = shown(data.linkage.largest_rod_angle().to_degrees());
        moments.push((format!("steepest rod, {angle}°"), data.linkage.steepest_rod()));
    }
    let stands = moments.iter().map(|(name, theta)| {
        let crank = shown(degrees(data.to_line(*theta)));
        stand(lying, format!("{name}: driving crank at {crank}°"), &lying.places(*theta))
    });
    let mut poses: Vec<SchemePose> = stands.collect();
    if let Some(first) = poses.first_mut() {
        first.labels = lengths(lying, &lying.places(outer));
        first.dimensions = stroke_dimension(lying);
    }
    let mut notes = vec![match data.linkage {
        Linkage::SixBar(..) => "O1A drives; AB coupler, O2B with O2C driven crank, CD rod; dashed: paths of A, B, C.",
        Linkage::CrankSlider(_) => "O2C drives; CD rod; dashed: path of C.",
        Linkage::Yoke => "O2C drives the slotted link of the bed; dashed: path of C.",
    }];
    let assumed = lying.assumed();
    notes.extend(assumed.as_deref());
    Scheme { poses, notes: notes.into_iter().map(str::to_owned).collect() }
}

/// The lengths of the links, next to their middles.
fn lengths(lying: &LinkagePicture<'_>, places: &Places) -> Vec<SchemeLabel> {
    let (o2, c, d) = (Vector2::zeros(), places.crank, places.slider);
    let mut all = Vec::new();
    let mut link = |name: &str, a: Vector2<f64>, b: Vector2<f64>, share: f64, towards: [f64; 2]| {
        let length = (b - a).norm();
        if length > 1e-6 {
            let text = format!("{name} {}", figure(length));
            all.push(SchemeLabel { text, at: a + share * (b - a), towards: Vector2::from(towards) });
        }
    };
    link("O2C", o2, c, 0.5, [0.2, -1.0]);
    if lying.data.linkage != Linkage::Yoke {
        link("CD", c, d, 0.5, [0.2, -1.0]);
    }
    if let Some([o1, a, b]) = places.drag_link {
        link("O1A", o1, a, 0.5, [-0.3, 1.0]);
        link("AB", a, b, 0.5, [0.0, 1.0]);
        link("O2B", o2, b, 0.5, [-1.0, 0.3]);
        link("O1O2", o1, o2, 0.5, [-0.5, -1.0]);
    }
    all
}

/// The stroke between the dead points, below the position.
fn stroke_dimension(lying: &LinkagePicture<'_>) -> Vec<SchemeDimension> {
    let [outer, inner] = lying.data.linkage.dead_points().map(|theta| lying.places(theta).slider);
    let text = format!("stroke {}", figure((outer - inner).norm()));
    vec![SchemeDimension { ends: [inner, outer], lane: 1, text }]
}

fn stroke(name: &'static str, kind: StrokeKind, points: &[Vector2<f64>]) -> Stroke {
    Stroke { name, kind, points: points.to_vec() }
}

fn joint(letter: &'static str, at: Vector2<f64>, fixed: bool, towards: Vector2<f64>) -> SchemeJoint {
    SchemeJoint { letter, at, fixed, towards }
}

fn stand(lying: &LinkagePicture<'_>, name: String, places: &Places) -> SchemePose {
    let (o2, c, d) = (Vector2::zeros(), places.crank, places.slider);
    let mut strokes: Vec<Stroke> =
        lying.paths().iter().map(|(name, points)| stroke(name, StrokeKind::Path, points)).collect();
    strokes.push(stroke("line of the slider", StrokeKind::Guide, &lying.guide()));
    let (a, b) = (lying.half_body(), Vector2::new(lying.half_body().x, -lying.half_body().y));
    strokes.push(stroke("bed", StrokeKind::Body, &[d - a, d + b, d + a, d - b, d - a]));
    if lying.data.linkage != Linkage::Yoke {
        strokes.push(stroke("rod", StrokeKind::Link(ROD), &[c, d]));
    }
    let mut joints = vec![joint("C", c, false, Vector2::new(0.0, 1.0))];
    if lying.data.linkage != Linkage::Yoke {
        joints.push(joint("D", d, false, Vector2::new(1.0, 1.0)));
    }
    if let Some([o1, a, b]) = places.drag_link {
        strokes.push(stroke("coupler", StrokeKind::Link(COUPLER), &[a, b]));
        strokes.push(stroke("driven crank", StrokeKind::Link(DRIVEN), &[b, o2, c]));
        strokes.push(stroke("driving crank", StrokeKind::Link(DRIVING), &[o1, a]));
        joints.extend([
            joint("O1", o1, true, Vector2::new(-1.0, -1.0)),
            joint("A", a, false, Vector2::new(0.0, 1.0)),
            joint("B", b, false, Vector2::new(0.0, 1.0)),
        ]);
    } else {
        strokes.push(stroke("driving crank", StrokeKind::Link(DRIVING), &[o2, c]));
    }
    joints.push(joint("O2", o2, true, Vector2::new(1.0, -1.0)));
    SchemePose { name, strokes, joints, ..SchemePose::default() }
}

//! The review sheet of a conoid: the sections over each other, coloured by speed, and the cam seen isometrically.

use super::Conoid;
use crate::body::{Drawn, Part};
use crate::geometry::contour::Extents;
use crate::geometry::{Entity, MILLIMETRES};
use crate::machine::Rotation;
use crate::motion::Motion;
use crate::report::Report;
use crate::report::sheet::{Group, LINE_SPACING, Pen, Shape, Sheet, TEXT_OVER_WIDTH, rounded, with_facts};
use nalgebra::Vector2;

/// Most speeds that are named one by one.
const MOST_NAMED: usize = 8;
/// Points of a turn and lines along the axis in the isometric view, and points of each such line.
const TURN: u32 = 180;
const RULERS: u32 = 24;
const RULER: u32 = 24;

/// Colour for a share in [0, 1]: from blue for the slowest to red for the fastest.
fn colour(share: f64) -> String {
    let mix = |from: f64, to: f64| (from + (to - from) * share).round();
    format!("rgb({},{},{})", mix(30.0, 200.0), mix(90.0, 40.0), mix(180.0, 30.0))
}

/// The review sheet.
#[must_use]
pub(super) fn sheet(conoid: &Conoid, drawn: &Drawn, report: &Report) -> Sheet {
    let parts = &drawn.parts;
    let plan = parts.iter().map(|part| part.outline.contour.extents()).reduce(|a, b| a.with(&b));
    let plan = plan.unwrap_or(Extents { least: Vector2::zeros(), largest: Vector2::zeros() });
    let gap = 0.12 * plan.size().x;
    let view = View { conoid, turned: conoid.machine.cam.rotation == Rotation::CounterClockwise };
    let cuts = conoid.cuts();
    let (low, high) = conoid.ends();
    let rings: Vec<Vec<Vector2<f64>>> = cuts.iter().map(|(_, z, _)| view.ring(*z)).collect();
    let ends: Vec<Vec<Vector2<f64>>> = [low, high].iter().map(|z| view.ring(*z)).collect();
    let rulers: Vec<Vec<Vector2<f64>>> = (0..RULERS).map(|i| view.ruler(i, (low, high))).collect();
    let seen = rings.iter().chain(&ends).chain(&rulers).flatten();
    let start = Extents { least: Vector2::repeat(f64::INFINITY), largest: Vector2::repeat(f64::NEG_INFINITY) };
    let seen = seen.fold(start, |extents, p| extents.with(&Extents { least: *p, largest: *p }));
    // The view stands to the right of the plan, its middle as high as the plan's.
    let shift = Vector2::new(
        plan.largest.x + gap - seen.least.x,
        0.5 * (plan.least.y + plan.largest.y - seen.least.y - seen.largest.y),
    );
    let moved = |points: &Vec<Vector2<f64>>| Shape::Path(points.iter().map(|p| p + shift).collect());
    let seen = Extents { least: seen.least + shift, largest: seen.largest + shift };
    let margin = Vector2::repeat(0.3 * gap);
    let both = plan.with(&seen);
    let mut drawn = Extents { least: both.least - margin, largest: both.largest + margin };
    let pen = Pen { text: TEXT_OVER_WIDTH * drawn.size().x };
    // The key of the colours stands above the plan; of many sections every few are named.
    let every = cuts.len().div_ceil(MOST_NAMED);
    #[expect(clippy::cast_precision_loss, reason = "a few sections")]
    let key = LINE_SPACING * pen.text * (cuts.len().div_ceil(every) as f64 + 1.0);
    drawn.largest.y += (key - (drawn.largest.y - plan.largest.y)).max(0.0);

    let (first, last) = (conoid.speeds.first().copied().unwrap_or(0.0), conoid.speeds.last().copied().unwrap_or(0.0));
    let mut groups = vec![
        Group::new("axis", "axes", axes(&plan)),
        Group::new(
            "bore",
            "bore",
            parts.first().map_or_else(Vec::new, |part: &Part| part.holes().into_iter().map(Shape::Entity).collect()),
        ),
        Group::new("isometric", "isometric view", ends.iter().chain(&rulers).map(moved).collect()),
    ];
    #[expect(clippy::cast_precision_loss, reason = "a few sections")]
    let sections = cuts.iter().zip(parts).zip(&rings).enumerate().map(|(index, (((rpm, z, _), part), ring))| {
        let share = if last > first { (rpm - first) / (last - first) } else { 1.0 };
        let y = drawn.largest.y - LINE_SPACING * pen.text * ((index / every) as f64 + 1.0);
        let swatch = Vector2::new(drawn.least.x, y + 0.35 * pen.text);
        let words = format!("{} rpm, z = {} mm", rounded(*rpm), rounded(MILLIMETRES * z));
        let mut shapes = vec![Shape::Entity(Entity::Polyline(part.outline.contour.clone())), moved(ring)];
        if index % every == 0 {
            shapes.push(Shape::Line(swatch, swatch + Vector2::new(2.0 * pen.text, 0.0)));
            shapes.push(pen.words(drawn.least.x + 2.6 * pen.text, y, words));
        }
        let label = format!("section for {} rpm", rounded(*rpm));
        Group { id: format!("section-{index}"), class: "section", label, colour: Some(colour(share)), shapes }
    });
    groups.extend(sections);
    with_facts(&pen, report, &drawn, groups)
}

fn axes(plan: &Extents) -> Vec<Shape> {
    vec![
        Shape::Line(Vector2::new(plan.least.x, 0.0), Vector2::new(plan.largest.x, 0.0)),
        Shape::Line(Vector2::new(0.0, plan.least.y), Vector2::new(0.0, plan.largest.y)),
    ]
}

/// The isometric view, mm.
struct View<'a> {
    conoid: &'a Conoid,
    turned: bool,
}

impl View<'_> {
    fn seen(&self, point: Vector2<f64>, z: f64) -> Vector2<f64> {
        let y = if self.turned { -point.y } else { point.y };
        // Isometric: x and y at 30° to either side, z upwards.
        let half = 0.5;
        let root = 0.5 * 3.0_f64.sqrt();
        Vector2::new((point.x - y) * root, z - (point.x + y) * half) * MILLIMETRES
    }

    fn at(&self, share: f64, z: f64) -> Vector2<f64> {
        let law = self.conoid.slice(z);
        let (first, last) = law.range();
        let (piece, angle) = law.locate(first + (last - first) * share);
        let point = self.conoid.cut(piece, angle, z).map_or_else(Vector2::zeros, |(frame, _)| frame.point);
        self.seen(point, z)
    }

    fn ring(&self, z: f64) -> Vec<Vector2<f64>> {
        (0..=TURN).map(|i| self.at(f64::from(i % TURN) / f64::from(TURN), z)).collect()
    }

    fn ruler(&self, index: u32, (low, high): (f64, f64)) -> Vec<Vector2<f64>> {
        let share = f64::from(index) / f64::from(RULERS);
        (0..=RULER).map(|i| self.at(share, low + (high - low) * f64::from(i) / f64::from(RULER))).collect()
    }
}

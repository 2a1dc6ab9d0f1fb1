//! The review sheet of a conoid: the sections over each other, coloured by speed, and the cam seen isometrically.

use super::Conoid;
use crate::body::sheet::{axes, bore, overall, turning};
use crate::body::{Drawn, Part};
use crate::geometry::contour::Extents;
use crate::geometry::{Entity, MILLIMETRES};
use crate::machine::Rotation;
use crate::motion::Motion;
use crate::motion::Reversal;
use crate::report::sheet::{Facts, Group, Mark, PlaceTable, Shape, View, rounded};
use nalgebra::Vector2;

/// Most speeds that are named one by one.
const MOST_NAMED: usize = 8;
/// Room between plan and isometric view, and width of that view, over the width of the plan.
const GAP_OVER_WIDTH: f64 = 0.12;
const PICTURE_OVER_WIDTH: f64 = 0.62;
/// Points of a turn and lines along the axis in the isometric view, and points of each such line.
const TURN: u32 = 180;
const RULERS: u32 = 24;
const RULER: u32 = 24;

/// Colour for a share in [0, 1]: from blue for the slowest to red for the fastest.
fn colour(share: f64) -> String {
    let mix = |from: f64, to: f64| (from + (to - from) * share).round();
    format!("rgb({},{},{})", mix(30.0, 200.0), mix(90.0, 40.0), mix(180.0, 30.0))
}

/// What the review sheet shows.
#[must_use]
pub(super) fn view(conoid: &Conoid, drawn: &Drawn) -> View {
    let parts = &drawn.parts;
    let plan = parts.iter().map(|part| part.outline.contour.extents()).reduce(|a, b| a.with(&b));
    let plan = plan.unwrap_or(Extents { least: Vector2::zeros(), largest: Vector2::zeros() });
    let gap = GAP_OVER_WIDTH * plan.size().x;
    let seen = Isometric { conoid, turned: conoid.machine.cam.rotation == Rotation::CounterClockwise };
    let cuts = conoid.cuts();
    let (low, high) = conoid.ends();
    let rings: Vec<Vec<Vector2<f64>>> = cuts.iter().map(|(_, z, _)| seen.ring(*z)).collect();
    let ends: Vec<Vec<Vector2<f64>>> = [low, high].iter().map(|z| seen.ring(*z)).collect();
    let rulers: Vec<Vec<Vector2<f64>>> = (0..RULERS).map(|i| seen.ruler(i, (low, high))).collect();
    let points = rings.iter().chain(&ends).chain(&rulers).flatten();
    let start = Extents { least: Vector2::repeat(f64::INFINITY), largest: Vector2::repeat(f64::NEG_INFINITY) };
    let solid = points.fold(start, |extents, p| extents.with(&Extents { least: *p, largest: *p }));
    // A picture of the solid, not to scale, above the plan and in its middle.
    let share = PICTURE_OVER_WIDTH * plan.size().x / solid.size().x.max(f64::MIN_POSITIVE);
    let shift = Vector2::new(
        0.5 * (plan.least.x + plan.largest.x) - 0.5 * share * (solid.least.x + solid.largest.x),
        plan.largest.y + gap - share * solid.least.y,
    );
    let moved = |points: &Vec<Vector2<f64>>| Shape::Path(points.iter().map(|p| p * share + shift).collect());
    let holes =
        parts.first().map_or_else(Vec::new, |part: &Part| part.holes().into_iter().map(Shape::Entity).collect());
    let mut groups = vec![
        Group::new("axis", "axes", axes(&plan)),
        Group::new("bore", "bore", holes),
        Group::new("isometric", "isometric view, not to scale", ends.iter().chain(&rulers).map(moved).collect()).told(),
    ];
    // Of many sections every few are named.
    let every = cuts.len().div_ceil(MOST_NAMED);
    let (first, last) = (conoid.speeds.first().copied().unwrap_or(0.0), conoid.speeds.last().copied().unwrap_or(0.0));
    let colours = |rpm: f64| colour(if last > first { (rpm - first) / (last - first) } else { 1.0 });
    let sections = cuts.iter().zip(parts).enumerate().map(|(index, ((rpm, z, _), part))| {
        let label = format!("section for {} rpm, z = {} mm", rounded(*rpm), rounded(MILLIMETRES * z));
        Group {
            id: format!("section-{index}"),
            class: "section",
            label,
            colour: Some(colours(*rpm)),
            shapes: vec![Shape::Entity(Entity::Polyline(part.outline.contour.clone()))],
            in_legend: index % every == 0 || index + 1 == cuts.len(),
        }
    });
    groups.extend(sections);
    let seen_at = cuts.iter().zip(&rings).enumerate().map(|(index, ((rpm, ..), ring))| Group {
        id: format!("seen-{index}"),
        colour: Some(colours(*rpm)),
        ..Group::new("seen", "section in the isometric view", vec![moved(ring)])
    });
    groups.extend(seen_at);
    View {
        groups,
        marks: marks(conoid, parts, &plan),
        tables: vec![sections_table(conoid, parts)],
        facts: Facts { thickness_mm: Some(MILLIMETRES * (high - low)), ..Facts::of(&conoid.machine, None) },
        ..View::default()
    }
}

/// Dimensions, bore and rotation.
fn marks(conoid: &Conoid, parts: &[Part], plan: &Extents) -> Vec<Mark> {
    let base = parts.iter().map(|part| part.outline.contour.extents().largest.x).fold(0.0, f64::max);
    let marks = [
        overall(plan),
        bore(&conoid.machine, parts.first().and_then(|part| part.balancing.as_ref())),
        turning(&conoid.machine, 0.7 * base, base, "θ = 0, φ = 0"),
    ];
    marks.concat()
}

/// Speed, place and extents of each section.
fn sections_table(conoid: &Conoid, parts: &[Part]) -> PlaceTable {
    let row = |((rpm, z, _), part): ((f64, f64, &Reversal), &Part)| {
        let size = part.outline.contour.extents().size();
        let area = part.area_and_moment().0;
        let cells = [rpm, MILLIMETRES * z, size.x, size.y];
        cells.iter().map(|value| rounded(*value)).chain([format!("{area:.1}")]).collect()
    };
    PlaceTable {
        title: "Sections: speed, place along the axis, width, height, area".into(),
        heads: ["n, rpm", "z, mm", "width, mm", "height, mm", "area, mm²"].map(str::to_owned).to_vec(),
        rows: conoid.cuts().into_iter().zip(parts).map(row).collect(),
        every: 1,
    }
}

/// The isometric view, mm.
struct Isometric<'a> {
    conoid: &'a Conoid,
    turned: bool,
}

impl Isometric<'_> {
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

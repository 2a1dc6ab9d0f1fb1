//! The drawing for manufacture of a round cam with grooves: the section through its axis and the view of its end, with their sizes.

use super::{SweptDrawing, SweptGroove};
use crate::body::part;
use crate::body::part_drawing::fits::{ViewPlacement, bore_words, keyway_depth, keyway_frame};
use crate::body::part_drawing::proposals::{PROPOSED, SQUARE};
use crate::body::part_features::direction;
use crate::body::part_tolerance::PartTolerance;
use crate::report::sheet::{
    Dimensions, FeatureFrame, Mark, PROPOSED_ROUGHNESS, ShapeGroup, SheetShape, SheetView, ToleranceSign, extents_of,
};
use camgen_kernel::geometry::contour::{Contour, Extents, Vertex};
use camgen_kernel::geometry::solid::axial_section::{AxialCurve, axial_section};
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Distance of the end view from the section, over the largest radius.
const GAP: f64 = 0.6;
/// Distance of the lines of the hatch, mm, and over the largest radius.
const HATCH: f64 = 3.0;
const HATCH_OVER_RADIUS: f64 = 0.03;
/// How far axes reach beyond a view, over the largest radius.
const AXIS_BEYOND: f64 = 0.12;
/// A direction that misses the axes of the end view.
const ASIDE: f64 = std::f64::consts::FRAC_PI_4;

/// The two views of a round cam on the sheet, mm.
pub(crate) struct RoundViews {
    /// The section: the axis level, z to the right, ψ = 0 upwards.
    pub(crate) section: Extents,
    /// The largest radius.
    pub(crate) radius: f64,
    /// The end view.
    pub(crate) end: ViewPlacement,
    /// The curves of the section: distance from the axis, and z.
    pub(crate) curves: Vec<AxialCurve>,
}

impl RoundViews {
    /// What both cover.
    pub(crate) fn extents(&self) -> Extents {
        let right = self.end.centre.x + self.radius;
        Extents { least: self.section.least, largest: Vector2::new(right, self.section.largest.y) }
    }
}

/// Adds section and end view of the solid, with the sizes that every round cam has.
pub(crate) fn add_round_views(
    groove: &SweptGroove,
    tolerance: PartTolerance,
    swept: &SweptDrawing,
    view: &mut SheetView,
) -> RoundViews {
    let units = groove.machine.units();
    let curves = axial_section(&swept.solid.boundary, Vector2::x());
    let section = add_section(&curves, view);
    let radius = section.largest.y.max(-section.least.y);
    let centre = Vector2::new(section.largest.x + (1.0 + GAP) * radius, 0.0);
    // From the end of the least z in the first angle, from the other one in the third: ψ = 0 upwards in both.
    let way = if units == LengthUnit::Millimetre { 1.0 } else { -1.0 };
    let end = ViewPlacement { centre, x: Vector2::y(), y: Vector2::x() * way };
    let views = RoundViews { section, radius, end, curves };
    add_end_view(groove, &views, view);
    view.marks.extend(common_marks(groove, tolerance, &views));
    view.notes.push("z = 0 and ψ = 0 as in the tables and the solid; ψ = 0 upwards in both views; grooves are not shown in the end view".into());
    views
}

/// The section with its hatch: what it covers.
fn add_section(curves: &[AxialCurve], view: &mut SheetView) -> Extents {
    let on_paper = |point: &Vector2<f64>| Vector2::new(point.y, point.x);
    let (mut flanks, mut edges, mut lines) = (Vec::new(), Vec::new(), Vec::new());
    for curve in curves {
        let points: Vec<Vector2<f64>> = curve.points.iter().map(on_paper).collect();
        lines.extend(points.iter().copied().zip(points.iter().copied().skip(1)));
        let group = if curve.is_flank { &mut flanks } else { &mut edges };
        group.push(SheetShape::Path(points));
    }
    let group = |id: &str, class, label: &'static str, shapes| ShapeGroup {
        id: id.into(),
        ..ShapeGroup::new(class, label, shapes)
    };
    let outlines = [group("section-A", "side", "edges of the section", edges)];
    let field = extents_of(&outlines);
    let [outlines] = outlines;
    let radius = field.largest.y;
    let hatch = hatch_within(&lines, &field, HATCH.max(HATCH_OVER_RADIUS * radius));
    let beyond = AXIS_BEYOND * radius;
    let axis = SheetShape::Line(Vector2::new(field.least.x - beyond, 0.0), Vector2::new(field.largest.x + beyond, 0.0));
    view.groups.extend([
        group("hatch-A", "hatch metal", "cut surface", hatch),
        outlines,
        group("ends-A", "side", "edges of the bore", ends_of_bore(curves)),
        group("flanks-A", "cut-flank", "flanks in the section", flanks),
        group("axis-A", "axis", "axis", vec![axis]),
    ]);
    // Beside the middle, along which the axis of a turret may lie.
    let left = Extents { largest: Vector2::new(0.5 * (field.least.x + field.largest.x), field.largest.y), ..field };
    view.marks.push(Mark::Caption { view: left, text: "A–A".into() });
    field
}

/// The edges of the bore behind the plane, at both ends of the cam: between the innermost points of the section.
fn ends_of_bore(curves: &[AxialCurve]) -> Vec<SheetShape> {
    let ends = || curves.iter().flat_map(|curve| curve.points.iter());
    let (low, high) =
        ends().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| (low.min(point.y), high.max(point.y)));
    let innermost = |height: f64, side: f64| {
        let there = ends().filter(|point| (point.y - height).abs() < 1e-6 && point.x * side > 0.0);
        there.map(|point| point.x).min_by(|a, b| a.abs().total_cmp(&b.abs()))
    };
    let line = |height: f64| {
        let (upper, lower) = (innermost(height, 1.0)?, innermost(height, -1.0)?);
        Some(SheetShape::Line(Vector2::new(height, lower), Vector2::new(height, upper)))
    };
    [low, high].into_iter().filter_map(line).collect()
}

/// Lines at 45° within closed lines, all on one grid of the sheet.
fn hatch_within(lines: &[(Vector2<f64>, Vector2<f64>)], field: &Extents, step: f64) -> Vec<SheetShape> {
    // On the line y = x + c the value of y − x is c.
    let level = |point: &Vector2<f64>| point.y - point.x;
    let spread = step * std::f64::consts::SQRT_2;
    let (low, high) = (field.least.y - field.largest.x, field.largest.y - field.least.x);
    let mut shapes = Vec::new();
    let mut number = (low / spread).ceil();
    while number * spread <= high {
        let c = number * spread;
        let mut crossed: Vec<f64> = Vec::new();
        for (from, to) in lines {
            let (a, b) = (level(from) - c, level(to) - c);
            if (a >= 0.0) != (b >= 0.0) {
                crossed.push(from.x + (to.x - from.x) * (a / (a - b)));
            }
        }
        crossed.sort_by(f64::total_cmp);
        for ends in crossed.chunks_exact(2) {
            let &[from, to] = ends else { continue };
            shapes.push(SheetShape::Line(Vector2::new(from, from + c), Vector2::new(to, to + c)));
        }
        number += 1.0;
    }
    shapes
}

/// The view of an end: its rim, the largest circle, the bore with its keyway, axes and the cutting line.
fn add_end_view(groove: &SweptGroove, views: &RoundViews, view: &mut SheetView) {
    let RoundViews { radius, end, .. } = views;
    let mut circles = vec![SheetShape::Entity(Entity::Circle(end.centre, *radius))];
    let bore = part::bore(&groove.machine).map(|bore| match bore {
        Entity::Circle(_, radius) => SheetShape::Entity(Entity::Circle(end.centre, radius)),
        other => SheetShape::Entity(Entity::Polyline(on_view(&other.contour(), end))),
    });
    circles.extend(bore);
    let beyond = radius * (1.0 + AXIS_BEYOND);
    let axes = [Vector2::x(), Vector2::y()]
        .map(|along| SheetShape::Line(end.centre - along * beyond, end.centre + along * beyond));
    view.groups.extend([
        ShapeGroup { id: "end".into(), ..ShapeGroup::new("side", "end of the cam, grooves not shown", circles) },
        ShapeGroup { id: "end-axes".into(), ..ShapeGroup::new("axis", "axes", axes.to_vec()) },
    ]);
    let ends = [-1.0, 1.0].map(|way| end.centre + Vector2::y() * (way * radius));
    view.marks.push(Mark::CuttingLine { ends, sight: -end.turned(Vector2::y()), letter: "A" });
}

/// A contour of the part in a view that may mirror it.
fn on_view(contour: &Contour, view: &ViewPlacement) -> Contour {
    let sense = view.x.perp(&view.y).signum();
    let vertex = |vertex: &Vertex| Vertex::new(view.at(vertex.point), sense * vertex.bulge().unwrap_or(0.0));
    Contour { vertices: contour.vertices.iter().map(vertex).collect() }
}

/// Length, bore and keyway, the datums, and the frames of flanks and faces.
fn common_marks(groove: &SweptGroove, tolerance: PartTolerance, views: &RoundViews) -> Vec<Mark> {
    let machine = &groove.machine;
    let units = machine.units();
    let RoundViews { section, end, curves, .. } = views;
    let (left, right) = (section.least.x, section.largest.x);
    let mut marks = Vec::new();
    let below = |from: f64, to: f64, line: u32, text: String| Mark::Size {
        from: Vector2::new(from, section.least.y),
        to: Vector2::new(to, section.least.y),
        away: -Vector2::y(),
        view: *section,
        line,
        text,
        datum: None,
        is_half: false,
    };
    let to_zero = format!("{} (TED) to z = 0", units.dimension(right));
    marks.push(below(0.0, right, 1, to_zero));
    marks.push(below(left, right, 2, format!("{} h11{PROPOSED}", units.dimension(right - left))));
    let rim = outermost_at(curves, right);
    marks.push(Mark::Datum { at: Vector2::new(right, -0.8 * rim), towards: Vector2::new(1.0, -0.2), letter: "C" });
    if let Some(bore) = machine.cam.bore_radius {
        let radius = MILLIMETRES * bore;
        let places = [-ASIDE, ASIDE - std::f64::consts::PI, ASIDE + std::f64::consts::FRAC_PI_2].map(|angle| {
            let (sin, cos) = libm::sincos(angle);
            let ray = Vector2::new(cos, sin);
            (end.centre + ray * radius, ray)
        });
        marks.push(Mark::Tolerance(FeatureFrame {
            places: places.to_vec(),
            above: bore_words(machine, bore),
            sign: None,
            cells: Vec::new(),
            behind: String::new(),
            datum: Some("A"),
        }));
        marks.push(Mark::Tolerance(FeatureFrame {
            places: vec![
                (Vector2::new(right, 0.7 * rim), Vector2::new(1.0, 0.3)),
                (Vector2::new(left, 0.7 * rim), Vector2::new(-1.0, 0.3)),
            ],
            above: String::new(),
            sign: Some(ToleranceSign::Perpendicular),
            cells: vec![units.zone(SQUARE), "A".into()],
            behind: String::new(),
            datum: None,
        }));
    }
    marks.extend(keyway_frame(machine, end));
    if let (Some(bore), Some(keyway)) = (machine.cam.bore_radius, machine.cam.keyway) {
        let along = end.turned(direction(machine, keyway.angle));
        let at = end.centre + along * (MILLIMETRES * (bore + keyway.depth));
        let text = format!("{} over the bore", keyway_depth(machine, bore, &keyway));
        marks.push(Mark::Label { class: "dimension", at, towards: along + Vector2::new(-0.6, 0.0), text });
    }
    let flank_places = flank_places(curves);
    let datums = [machine.cam.bore_radius.map(|_| "A"), machine.cam.keyway.map(|_| "B"), Some("C")];
    let zone = units.zone(MILLIMETRES * tolerance.width);
    marks.push(Mark::Tolerance(FeatureFrame {
        places: flank_places.clone(),
        above: "flanks, by the solid".into(),
        sign: Some(ToleranceSign::Surface),
        cells: std::iter::once(zone).chain(datums.into_iter().flatten().map(str::to_owned)).collect(),
        behind: String::new(),
        datum: None,
    }));
    let roughness = machine.title.surface_roughness.clone();
    let text = roughness.unwrap_or_else(|| format!("{PROPOSED_ROUGHNESS}{PROPOSED}"));
    marks.push(Mark::Roughness { places: flank_places.into_iter().rev().collect(), text });
    marks
}

/// The largest distance from the axis of the section at a height, mm.
fn outermost_at(curves: &[AxialCurve], height: f64) -> f64 {
    let points = curves.iter().flat_map(|curve| &curve.points);
    points.filter(|point| (point.y - height).abs() < 1e-6).map(|point| point.x).fold(0.0, f64::max)
}

/// Points of the flanks in the section, the upper half first, with directions out of the part.
fn flank_places(curves: &[AxialCurve]) -> Vec<(Vector2<f64>, Vector2<f64>)> {
    let middles = curves.iter().filter(|curve| curve.is_flank).filter_map(|curve| {
        let point = curve.points.get(curve.points.len() / 2)?;
        Some(Vector2::new(point.y, point.x))
    });
    let mut places: Vec<(Vector2<f64>, Vector2<f64>)> =
        middles.map(|at| (at, Vector2::new(-0.3, 1.0) * at.y.signum())).collect();
    places.sort_by(|a, b| b.0.y.total_cmp(&a.0.y));
    places
}

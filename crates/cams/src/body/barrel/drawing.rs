//! The drawing of a barrel: section, end view, and the development of its outside.

use super::sheet::tables;
use super::{Barrel, BarrelRoller};
use crate::body::Layer;
use crate::body::part_drawing::proposals::{DEPTH, PROPOSED, WIDTH};
use crate::body::part_tolerance::PartTolerance;
use crate::body::swept::SweptDrawing;
use crate::body::swept::drawing::{RoundViews, add_round_views};
use crate::report::sheet::{Dimensions, Mark, ShapeGroup, SheetShape, SheetView, extents_of, rounded};
use camgen_kernel::geometry::contour::Extents;
use camgen_kernel::geometry::solid::axial_section::AxialCurve;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use nalgebra::Vector2;

/// Distance of the development below the section, over the radius of the outside.
const GAP: f64 = 1.0;
/// A curve of the section this near to the floor lies on it, mm.
const ON_FLOOR: f64 = 1e-3;
/// Parts of a turn that are marked at the development, and how long the marks are over its length.
const PARTS: u32 = 12;
const TICK: f64 = 0.006;

/// Adds the views, sizes and tables.
pub(super) fn fill<R: BarrelRoller>(barrel: &Barrel<R>, swept: &SweptDrawing, view: &mut SheetView) {
    let units = barrel.groove.machine.units();
    let views = add_round_views(&barrel.groove, PartTolerance::of(barrel), swept, view);
    let (outer, floor) = (MILLIMETRES * barrel.outer, MILLIMETRES * barrel.floor());
    let section = views.section;
    let left = |from: f64, to: f64, line: u32, text: String| Mark::Size {
        from: Vector2::new(section.least.x, from),
        to: Vector2::new(section.least.x, to),
        away: -Vector2::x(),
        view: section,
        line,
        text,
        datum: None,
        is_half: false,
    };
    view.marks.push(left(-outer, outer, 1, format!("Ø{} h11{PROPOSED}", units.dimension(2.0 * outer))));
    view.marks.push(Mark::Label {
        class: "dimension",
        at: middle_of_floor(&views, floor),
        towards: Vector2::new(0.3, 1.0),
        text: format!("groove {} {}{PROPOSED} deep", units.toleranced(outer - floor), units.limits(DEPTH)),
    });
    add_development(barrel, swept, views.extents().least - Vector2::new(0.0, GAP * outer), view);
    view.tables = tables(barrel);
}

/// The middle of the floor of the groove in the upper half of the section, on the sheet.
fn middle_of_floor(views: &RoundViews, floor: f64) -> Vector2<f64> {
    let is_floor = |curve: &&AxialCurve| curve.points.iter().all(|point| (point.x - floor).abs() < ON_FLOOR);
    let points = views.curves.iter().filter(is_floor).flat_map(|curve| &curve.points);
    let (low, high) =
        points.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| (low.min(point.y), high.max(point.y)));
    Vector2::new(0.5 * (low + high), floor)
}

/// The development below a point, at whose x it begins.
fn add_development<R: BarrelRoller>(
    barrel: &Barrel<R>,
    swept: &SweptDrawing,
    corner: Vector2<f64>,
    view: &mut SheetView,
) {
    let units = barrel.groove.machine.units();
    let shapes_on = |layer: Layer| -> Vec<SheetShape> {
        let entities = swept.developed.iter().filter(|(other, _)| *other == layer);
        let shape = |entity: &Entity| match entity {
            Entity::Segment(segment) => SheetShape::Arc(segment.start, segment.end, segment.bulge),
            other => SheetShape::Entity(other.clone()),
        };
        entities.map(|(_, entity)| shape(entity)).collect()
    };
    let group = |id: &str, class, label: &'static str, layer| ShapeGroup {
        id: id.into(),
        ..ShapeGroup::new(class, label, shapes_on(layer))
    };
    let mut groups = vec![
        group("development", "side", "developed outside", Layer::Blank),
        group("upper-flank", "cut-flank", "upper flank on the outside", Layer::FlankUpper),
        group("lower-flank", "cut-flank", "lower flank on the outside", Layer::FlankLower),
        group("centre-line", "axis", "centre line of the groove", Layer::Pitch),
    ];
    let own = extents_of(&groups);
    let by = Vector2::new(corner.x - own.least.x, corner.y - own.largest.y);
    for shape in groups.iter_mut().flat_map(|group| &mut group.shapes) {
        *shape = moved(shape, by);
    }
    let field = Extents { least: own.least + by, largest: own.largest + by };
    view.groups.extend(groups);
    let size = |from: Vector2<f64>, to: Vector2<f64>, away: Vector2<f64>, line: u32, text: String| Mark::Size {
        from,
        to,
        away,
        view: field,
        line,
        text,
        datum: None,
        is_half: false,
    };
    let (low, high) = (field.least, field.largest);
    let across =
        format!("{} = 360° on Ø{}", units.dimension(high.x - low.x), units.dimension(2.0 * MILLIMETRES * barrel.outer));
    view.marks.push(size(low, Vector2::new(high.x, low.y), -Vector2::y(), 1, across));
    let zero = Vector2::new(low.x, by.y);
    view.marks.push(Mark::Label { class: "axis", at: zero, towards: Vector2::new(-1.0, 0.1), text: "z = 0".into() });
    add_angles(barrel, &field, by.x, view);
    view.notes.push("development of the outside, seen from outside".into());
    let width = MILLIMETRES * barrel.groove.width();
    let roller = MILLIMETRES * barrel.groove.roller;
    let text = format!(
        "groove {} {}{PROPOSED} wide, roller Ø{}",
        units.toleranced(width),
        units.limits(WIDTH),
        units.dimension(2.0 * roller)
    );
    let at = low_flank(swept, by);
    view.marks.extend(at.map(|at| Mark::Label { class: "dimension", at, towards: -Vector2::y(), text }));
}

/// The lowest point of the lower flank in the development, on the sheet.
fn low_flank(swept: &SweptDrawing, by: Vector2<f64>) -> Option<Vector2<f64>> {
    let on_flank = swept.developed.iter().filter(|(layer, _)| *layer == Layer::FlankLower);
    let starts = on_flank.filter_map(|(_, entity)| match entity {
        Entity::Segment(segment) => Some(segment.start + by),
        Entity::Polyline(_) | Entity::Circle(..) => None,
    });
    starts.min_by(|a, b| a.y.total_cmp(&b.y))
}

/// Marks of the polar angle along the upper edge of the development; ψ = 0 lies at `zero`.
fn add_angles<R: BarrelRoller>(barrel: &Barrel<R>, field: &Extents, zero: f64, view: &mut SheetView) {
    let turn = field.size().x;
    let mut ticks = Vec::new();
    for part in 0..=PARTS {
        let x = field.least.x + turn * f64::from(part) / f64::from(PARTS);
        let edge = Vector2::new(x, field.largest.y);
        ticks.push(SheetShape::Line(edge, edge + Vector2::new(0.0, TICK * turn)));
        let psi = ((x - zero) / (MILLIMETRES * barrel.outer)).to_degrees();
        view.marks.push(Mark::Label {
            class: "axis",
            at: edge + Vector2::new(0.0, TICK * turn),
            towards: Vector2::y(),
            text: format!("{}°", rounded((1e3 * psi).round() / 1e3 + 0.0)),
        });
    }
    view.groups.push(ShapeGroup { id: "angles".into(), ..ShapeGroup::new("axis", "polar angle ψ", ticks) });
}

/// A shape at another place.
fn moved(shape: &SheetShape, by: Vector2<f64>) -> SheetShape {
    match shape {
        SheetShape::Entity(entity) => SheetShape::Entity(entity.moved(by)),
        SheetShape::Line(a, b) => SheetShape::Line(a + by, b + by),
        SheetShape::Arc(a, b, bulge) => SheetShape::Arc(a + by, b + by, *bulge),
        SheetShape::Path(points) => SheetShape::Path(points.iter().map(|point| point + by).collect()),
        other => other.clone(),
    }
}

//! What the review sheet of a barrel shows: the developed view with its flanks, a section along the axis, and tables of places of both flanks.

use super::{Barrel, FlankSide};
use crate::body::sheet::{keyway_note, tolerance_note};
use crate::body::{Drawn, Layer};
use crate::report::sheet::Dimensions;
use crate::report::sheet::{Mark, PlaceTable, ShapeGroup, SheetShape, SheetView, TitleFacts, rounded};
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use nalgebra::Vector2;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Distance of the section from the developed view, over the radius of the outside.
const GAP: f64 = 0.5;
/// Rows of the finest table of places over a turn.
const ROWS: u32 = 72;

/// What the review sheet shows.
pub(super) fn view(barrel: &Barrel, drawn: &Drawn) -> SheetView {
    let swept = drawn.swept.as_deref();
    let of = |layer: Layer| -> Vec<SheetShape> {
        let entities = swept.into_iter().flat_map(|swept| &swept.developed).filter(|(other, _)| *other == layer);
        let shape = |entity: &Entity| match entity {
            Entity::Segment(segment) => SheetShape::Arc(segment.start, segment.end, segment.bulge),
            other => SheetShape::Entity(other.clone()),
        };
        entities.map(|(_, entity)| shape(entity)).collect()
    };
    let flank = |id: &str, label: &str, layer: Layer| ShapeGroup {
        id: id.into(),
        ..ShapeGroup::new("profile", label, of(layer)).with_legend()
    };
    let mut view = SheetView {
        groups: vec![
            ShapeGroup { id: "blank".into(), ..ShapeGroup::new("side", "developed blank", of(Layer::Blank)) },
            flank("upper-flank", "flank above the roller, on the outside", Layer::FlankUpper),
            flank("lower-flank", "flank below the roller, on the outside", Layer::FlankLower),
            ShapeGroup::new("pitch-curve", "centre line of the roller", of(Layer::Pitch)).with_legend(),
        ],
        tables: tables(barrel),
        facts: TitleFacts {
            thickness_mm: Some(MILLIMETRES * (barrel.ends.1 - barrel.ends.0)),
            ..TitleFacts::of(&barrel.machine, swept.map(|swept| mass(barrel, swept.solid.volume)))
        },
        notes: tolerance_note(&barrel.machine).into_iter().chain(keyway_note(&barrel.machine)).collect(),
        ..SheetView::default()
    };
    let sense = if barrel.is_clockwise() { "clockwise" } else { "counter-clockwise" };
    view.notes
        .push(format!("Developed view of the outside, seen from outside; the barrel turns {sense} seen from above."));
    developed_marks(barrel, &mut view);
    section(barrel, &mut view);
    view
}

fn mass(barrel: &Barrel, volume: f64) -> f64 {
    volume / (MILLIMETRES * MILLIMETRES * MILLIMETRES) * barrel.machine.cam.density()
}

/// Lengths of the developed view, and the roller in its groove at the start.
fn developed_marks(barrel: &Barrel, view: &mut SheetView) {
    let units = barrel.machine.units();
    let start = barrel.motion.range().0;
    let x = |angle: f64| MILLIMETRES * barrel.sense() * barrel.outer * angle;
    let (left, right) = (x(start).min(x(start + TAU)), x(start).max(x(start + TAU)));
    let (low, high) = (MILLIMETRES * barrel.ends.0, MILLIMETRES * barrel.ends.1);
    let at = Vector2::new;
    view.marks.push(Mark::Distance {
        from: at(left, low),
        to: at(right, low),
        away: at(0.0, -1.0),
        text: format!("{} = 360°", units.dimension(right - left)),
    });
    let to_zero = (at(left, 0.0), format!("{} to z = 0", units.dimension(-low)));
    for (to, text) in [to_zero, (at(left, high), units.dimension(high - low))] {
        view.marks.push(Mark::Distance { from: at(left, low), to, away: at(-1.0, 0.0), text });
    }
    let (piece, angle) = barrel.motion.locate(0.0);
    let axis = barrel.axis(piece, angle);
    let centre = at(x(0.0), MILLIMETRES * axis.along[0]);
    let radius = MILLIMETRES * barrel.roller;
    let roller = vec![SheetShape::Entity(Entity::Circle(centre, radius))];
    view.groups.push(ShapeGroup::new("roller", "roller at θ = 0", roller).with_legend());
    let width = MILLIMETRES * barrel.distances.iter().sum::<f64>();
    view.marks.push(Mark::Label {
        class: "dimension",
        at: centre,
        towards: at(0.6, 0.8),
        text: format!(
            "θ = 0, z = 0: groove {} wide, roller Ø{}",
            units.dimension(width),
            units.dimension(2.0 * radius)
        ),
    });
}

/// The section along the axis at θ = 0, to the right of the developed view.
fn section(barrel: &Barrel, view: &mut SheetView) {
    let units = barrel.machine.units();
    let (outer, floor) = (MILLIMETRES * barrel.outer, MILLIMETRES * barrel.floor());
    let (low, high) = (MILLIMETRES * barrel.ends.0, MILLIMETRES * barrel.ends.1);
    let right = crate::report::sheet::extents_of(&view.groups).largest.x + (GAP + 1.0) * outer;
    let at = |x: f64, z: f64| Vector2::new(right + x, z);
    let mut shapes = Vec::new();
    // The groove as it is cut at θ = 0 on one side, and half a turn later on the other.
    for (side, angle) in [(1.0, 0.0), (-1.0, 0.5 * TAU)] {
        let place = barrel.motion.locate(angle);
        let height =
            |flank, radius: f64| barrel.edge(flank, radius, place).map_or(f64::NAN, |found| MILLIMETRES * found.height);
        let [upper, lower] = FlankSide::BOTH.map(|flank| height(flank, barrel.outer));
        let points = [at(0.0, low), at(side * outer, low), at(side * outer, lower), at(side * floor, lower)];
        let more = [at(side * floor, upper), at(side * outer, upper), at(side * outer, high), at(0.0, high)];
        shapes.push(SheetShape::Path(points.into_iter().chain(more).collect()));
    }
    view.groups.push(ShapeGroup {
        id: "section".into(),
        ..ShapeGroup::new("side", "section along the axis at θ = 0", shapes)
    });
    let bore = barrel.machine.cam.bore_radius.map(|radius| MILLIMETRES * radius);
    let hidden: Vec<SheetShape> =
        bore.iter().flat_map(|radius| [*radius, -radius]).map(|x| SheetShape::Line(at(x, low), at(x, high))).collect();
    view.groups.push(ShapeGroup { id: "section-bore".into(), ..ShapeGroup::new("hidden", "hidden edges", hidden) });
    let beyond = 0.1 * outer;
    let axis = vec![SheetShape::Line(at(0.0, low - beyond), at(0.0, high + beyond))];
    view.groups.push(ShapeGroup::new("axis", "axis of the barrel", axis).with_legend());
    let distance = |from: Vector2<f64>, to: Vector2<f64>, way: f64, text: String| Mark::Distance {
        from,
        to,
        away: Vector2::new(0.0, way),
        text,
    };
    view.marks.push(distance(at(-outer, low), at(outer, low), -1.0, format!("Ø{}", units.dimension(2.0 * outer))));
    view.marks.push(distance(
        at(floor, high),
        at(outer, high),
        1.0,
        format!("{} deep", units.dimension(outer - floor)),
    ));
    if let Some(radius) = bore {
        let fit = barrel.machine.cam.bore_fit.map_or(String::new(), |fit| format!(" {fit}"));
        view.marks.push(distance(
            at(-radius, high),
            at(radius, high),
            1.0,
            format!("Ø{}{fit}", units.dimension(2.0 * radius)),
        ));
    }
}

/// Angle and height of both flanks on the outside and at the floor.
fn tables(barrel: &Barrel) -> Vec<PlaceTable> {
    let units = barrel.machine.units();
    let row = |index: u32| {
        let degrees = 360.0 * f64::from(index) / f64::from(ROWS);
        let place = barrel.motion.locate(degrees.to_radians());
        let mut cells = vec![rounded(degrees)];
        for radius in [barrel.outer, barrel.floor()] {
            for flank in FlankSide::BOTH {
                let found = barrel.edge(flank, radius, place);
                let [angle, height] = found.map_or([f64::NAN; 2], |found| {
                    [barrel.sense() * (degrees + found.ahead.to_degrees()), MILLIMETRES * found.height]
                });
                cells.extend([format!("{angle:.4}"), units.cell(height)]);
            }
        }
        cells
    };
    let rows: Arc<[Vec<String>]> = (0..ROWS).map(row).collect();
    let [outside, floor] = [barrel.outer, barrel.floor()].map(|radius| units.dimension(MILLIMETRES * radius));
    let heads = ["θ", "φ above", "z above", "φ below", "z below", "φ above", "z above", "φ below", "z below"];
    let of = |every: usize| PlaceTable {
        title: format!(
            "Both flanks, first on R {outside}, then on the floor R {floor}: angle φ, °, and height z, {}",
            units.symbol()
        ),
        heads: heads.map(str::to_owned).to_vec(),
        rows: Arc::clone(&rows),
        every,
    };
    [1, 2, 3, 6].map(of).to_vec()
}

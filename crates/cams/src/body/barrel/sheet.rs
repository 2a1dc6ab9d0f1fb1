//! What the review sheet of a barrel shows: the developed view with its flanks, a section along the axis, and tables of places of both flanks.

use super::{Barrel, BarrelLine, BarrelRoller};
use crate::body::Layer;
use crate::body::swept::sheet::{bore_mark, dimension};
use crate::body::swept::{FlankSide, SweptDrawing};
use crate::report::sheet::{Dimensions, Mark, PlaceTable, ShapeGroup, SheetShape, SheetView, rounded};
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use nalgebra::Vector2;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Distance of the section from the developed view, over the radius of the outside.
const GAP: f64 = 0.5;
/// Rows of the finest table of places over a turn.
const ROWS: u32 = 72;

/// Adds what the review sheet shows.
pub(super) fn fill<R: BarrelRoller>(barrel: &Barrel<R>, swept: Option<&SweptDrawing>, view: &mut SheetView) {
    let of = |layer: Layer| -> Vec<SheetShape> {
        let entities = swept.into_iter().flat_map(|swept| &swept.developed).filter(|(other, _)| *other == layer);
        let shape = |entity: &Entity| match entity {
            Entity::Segment(segment) => SheetShape::Arc(segment.start, segment.end, segment.bulge),
            other => SheetShape::Entity(other.clone()),
        };
        entities.map(|(_, entity)| shape(entity)).collect()
    };
    let flank = |id: &str, label: &'static str, layer: Layer| ShapeGroup {
        id: id.into(),
        ..ShapeGroup::new("profile", label, of(layer)).with_legend()
    };
    view.groups.extend([
        ShapeGroup { id: "blank".into(), ..ShapeGroup::new("side", "developed blank", of(Layer::Blank)) },
        flank("upper-flank", "flank above the roller, on the outside", Layer::FlankUpper),
        flank("lower-flank", "flank below the roller, on the outside", Layer::FlankLower),
        ShapeGroup::new("pitch-curve", "centre line of the roller", of(Layer::Pitch)).with_legend(),
    ]);
    view.tables = tables(barrel);
    let sense = if barrel.groove.is_clockwise() { "clockwise" } else { "counter-clockwise" };
    view.notes.push(
        format!("Developed view of the outside, seen from outside; the barrel turns {sense} seen from above.").into(),
    );
    developed_marks(barrel, view);
    section(barrel, view);
}

/// Lengths of the developed view, and the roller in its groove at the start.
fn developed_marks<R: BarrelRoller>(barrel: &Barrel<R>, view: &mut SheetView) {
    let units = barrel.groove.machine.units();
    let start = barrel.groove.motion.range().0;
    let x = |angle: f64| MILLIMETRES * barrel.groove.sense() * barrel.outer * angle;
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
    let (piece, angle) = barrel.groove.motion.locate(0.0);
    let axis = barrel.axis(piece, angle);
    let centre = at(x(0.0), MILLIMETRES * axis.axis().along[0]);
    let radius = MILLIMETRES * barrel.groove.roller;
    let roller = vec![SheetShape::Entity(Entity::Circle(centre, radius))];
    view.groups.push(ShapeGroup::new("roller", "roller at θ = 0", roller).with_legend());
    let width = MILLIMETRES * barrel.groove.width();
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
fn section<R: BarrelRoller>(barrel: &Barrel<R>, view: &mut SheetView) {
    let units = barrel.groove.machine.units();
    let (outer, floor) = (MILLIMETRES * barrel.outer, MILLIMETRES * barrel.floor());
    let (low, high) = (MILLIMETRES * barrel.ends.0, MILLIMETRES * barrel.ends.1);
    let right = crate::report::sheet::extents_of(&view.groups).largest.x + (GAP + 1.0) * outer;
    let at = |x: f64, z: f64| Vector2::new(right + x, z);
    let mut shapes = Vec::new();
    // The groove as it is cut at θ = 0 on one side, and half a turn later on the other.
    for (side, angle) in [(1.0, 0.0), (-1.0, 0.5 * TAU)] {
        let place = barrel.groove.motion.locate(angle);
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
    let bore = barrel.groove.machine.cam.bore_radius.map(|radius| MILLIMETRES * radius);
    let hidden: Vec<SheetShape> =
        bore.iter().flat_map(|radius| [*radius, -radius]).map(|x| SheetShape::Line(at(x, low), at(x, high))).collect();
    view.groups.push(ShapeGroup { id: "section-bore".into(), ..ShapeGroup::new("hidden", "hidden edges", hidden) });
    let beyond = 0.1 * outer;
    let axis = vec![SheetShape::Line(at(0.0, low - beyond), at(0.0, high + beyond))];
    view.groups.push(ShapeGroup::new("axis", "axis of the barrel", axis).with_legend());
    let (up, down) = (Vector2::new(0.0, 1.0), Vector2::new(0.0, -1.0));
    view.marks.push(dimension(at(-outer, low), at(outer, low), down, format!("Ø{}", units.dimension(2.0 * outer))));
    view.marks.push(dimension(
        at(floor, high),
        at(outer, high),
        up,
        format!("{} deep", units.dimension(outer - floor)),
    ));
    view.marks.extend(bore_mark(&barrel.groove.machine, at(0.0, high)));
}

/// Angle and height of both flanks on the outside and at the floor.
pub(super) fn tables<R: BarrelRoller>(barrel: &Barrel<R>) -> Vec<PlaceTable> {
    let units = barrel.groove.machine.units();
    let row = |index: u32| {
        let degrees = 360.0 * f64::from(index) / f64::from(ROWS);
        let place = barrel.groove.motion.locate(degrees.to_radians());
        let mut cells = vec![rounded(degrees)];
        for radius in [barrel.outer, barrel.floor()] {
            for flank in FlankSide::BOTH {
                let found = barrel.edge(flank, radius, place);
                let [angle, height] = found.map_or([f64::NAN; 2], |found| {
                    [barrel.groove.sense() * (degrees + found.ahead.to_degrees()), MILLIMETRES * found.height]
                });
                cells.extend([format!("{angle:.4}"), units.cell(height)]);
            }
        }
        cells
    };
    let rows = PlaceTable::regular_rows((0..ROWS).map(row));
    let [outside, floor] = [barrel.outer, barrel.floor()].map(|radius| units.dimension(MILLIMETRES * radius));
    let heads = ["θ °", "ψ upper", "z upper", "ψ lower", "z lower", "ψ upper", "z upper", "ψ lower", "z lower"];
    let of = |every: usize| PlaceTable {
        title: format!(
            "Upper and lower flank (TED): on R {outside}, then on the floor R {floor}: polar angle ψ, °, and height z, {}",
            units.symbol()
        ),
        remarks: Vec::new(),
        heads: heads.map(str::to_owned).to_vec(),
        rows: Arc::clone(&rows),
        every,
    };
    [1, 2, 3, 6].map(of).to_vec()
}

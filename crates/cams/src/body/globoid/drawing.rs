//! The drawing of a globoid: section, end view, and the place of the turret.

use super::Globoid;
use super::sheet::tables;
use crate::body::part_drawing::proposals::{DEPTH, PROPOSED, WIDTH};
use crate::body::part_tolerance::PartTolerance;
use crate::body::swept::SweptDrawing;
use crate::body::swept::drawing::add_round_views;
use crate::report::sheet::{Dimensions, Mark, ShapeGroup, SheetShape, SheetView, rounded};
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use nalgebra::Vector2;

/// Radius of the circle that marks the axis of the turret, over its distance, and how far its axes reach.
const MARK: f64 = 0.02;
const AXIS_BEYOND: f64 = 0.1;

/// Adds the views, sizes and tables.
pub(super) fn fill(globoid: &Globoid, swept: &SweptDrawing, view: &mut SheetView) {
    let units = globoid.groove.machine.units();
    let views = add_round_views(&globoid.groove, PartTolerance::of(globoid), swept, view);
    let section = views.section;
    let [distance, outside, floor] =
        [globoid.turret.distance, globoid.outside, globoid.floor].map(|length| MILLIMETRES * length);
    let centre = Vector2::new(0.0, distance);
    let beyond = AXIS_BEYOND * distance;
    view.groups.extend([ShapeGroup {
        id: "turret".into(),
        ..ShapeGroup::new(
            "axis",
            "axis of the turret",
            vec![
                SheetShape::Entity(Entity::Circle(centre, MARK * distance)),
                SheetShape::Line(centre - Vector2::x() * beyond, centre + Vector2::x() * beyond),
                SheetShape::Line(Vector2::new(0.0, -section.largest.y - beyond), centre + Vector2::y() * beyond),
            ],
        )
    }]);
    view.marks.push(Mark::Label {
        class: "axis",
        at: centre,
        towards: Vector2::new(1.0, 0.3),
        text: format!("axis of the turret, {} (TED) from the axis of the cam", units.dimension(distance)),
    });
    let rims =
        [globoid.rim(globoid.outside), globoid.rim(globoid.floor)].map(|(r, z)| [MILLIMETRES * r, MILLIMETRES * z]);
    let [[outer, _], [rim, _]] = rims;
    let size_at = |x: f64, radius: f64, text: String| Mark::Size {
        from: Vector2::new(x, -radius),
        to: Vector2::new(x, radius),
        away: Vector2::x() * if x < 0.0 { -1.0 } else { 1.0 },
        view: section,
        line: 1,
        text,
        datum: None,
        is_half: false,
    };
    view.marks.push(size_at(section.largest.x, rim, format!("Ø{} h11{PROPOSED}", units.dimension(2.0 * rim))));
    view.marks.push(size_at(section.least.x, outer, format!("(Ø{})", units.dimension(2.0 * outer))));
    let on_turret = |radius: f64, share: f64| {
        let (sin, cos) = libm::sincos(share * globoid.end_angle);
        centre - Vector2::new(radius * sin, radius * cos)
    };
    for (radius, share, text) in [
        (outside, 0.75, format!("R{} (TED) about the turret", units.dimension(outside))),
        (floor, 0.35, format!("floor R{} {}{PROPOSED}", units.toleranced(floor), units.limits(DEPTH))),
    ] {
        let at = on_turret(radius, share);
        view.marks.push(Mark::Label { class: "dimension", at, towards: (centre - at).normalize(), text });
    }
    let width = MILLIMETRES * globoid.groove.width();
    let roller = MILLIMETRES * globoid.groove.roller;
    view.notes.push(
        format!(
            "grooves {} {}{PROPOSED} wide at right angles to their rollers, {} rollers Ø{}; a turn of the cam moves the turret on by {}°",
            units.toleranced(width),
            units.limits(WIDTH),
            globoid.turret.rollers,
            units.dimension(2.0 * roller),
            rounded(globoid.turret.index().to_degrees())
        )
        .into(),
    );
    view.notes.push(
        format!("conical ends 2 × {}°", rounded((0.5 * std::f64::consts::PI - globoid.end_angle).to_degrees())).into(),
    );
    view.tables = tables(globoid);
}

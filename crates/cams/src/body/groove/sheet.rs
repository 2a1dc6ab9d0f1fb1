//! What the review sheet of a groove or a ring shows: the disc under the same roller, with the other flank, the blank and the groove's section.

use super::{Groove, RING};
use crate::body::sheet::name_profile;
use crate::body::{Body, Drawn, Layer};
use crate::report::sheet::Dimensions;
use crate::report::sheet::{Mark, ShapeGroup, SheetShape, SheetView};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Extents;
use camgen_kernel::profile::outline::OutlineError;
use nalgebra::Vector2;

/// Distance of the section from the front view, over the radius of the blank.
const GAP: f64 = 0.12;

/// What the review sheet shows.
pub(super) fn view(groove: &Groove, drawn: &Drawn) -> Result<SheetView, OutlineError> {
    let mut view = groove.disc.view_within(&groove.disc, drawn)?;
    let Some(part) = drawn.parts.first() else { return Ok(view) };
    let rims = part.rims();
    let of = |layer: Layer| -> Vec<SheetShape> {
        rims.iter().filter(|rim| rim.layer == layer).map(|rim| SheetShape::Entity(rim.curve.clone())).collect()
    };
    // From the back to the front: metal, the groove in it, and what stands within the groove.
    let ring = *groove.kind == RING;
    let mut back = vec![ShapeGroup { id: "blank".into(), ..ShapeGroup::new("profile", "blank", of(Layer::Blank)) }];
    let outer = of(Layer::GrooveOuter);
    if !outer.is_empty() {
        back.push(ShapeGroup { id: "outer-flank".into(), ..ShapeGroup::new("bore", "outer flank", outer) });
    }
    for group in view.groups.iter_mut().filter(|group| group.class == "profile") {
        (group.class, group.label) =
            if ring { ("bore", group.label.clone()) } else { ("profile", "inner flank".into()) };
    }
    view.groups.splice(0..0, back);
    if !ring {
        name_profile(&mut view.tables, "Inner flank");
    }
    let units = groove.machine().units();
    let blank = MILLIMETRES * groove.blank_radius;
    let up_left = Vector2::new(-0.8, 0.6);
    let label =
        |at: Vector2<f64>, towards: Vector2<f64>, text: String| Mark::Label { class: "dimension", at, towards, text };
    view.marks.push(label(up_left * blank, up_left, format!("blank Ø{}", units.dimension(2.0 * blank))));
    if let Some(width) = groove.width() {
        let text = format!(
            "groove {} wide, roller Ø{}",
            units.dimension(MILLIMETRES * width),
            units.dimension(roller(groove))
        );
        let at =
            part.outlines().nth(1).and_then(|(_, outline)| outline.contour.vertices.first()).map(|vertex| vertex.point);
        let at = at.unwrap_or_else(Vector2::zeros);
        view.marks.push(label(at, at.try_normalize(0.0).unwrap_or_else(Vector2::x), text));
    }
    section(groove, &part.extents(), &mut view);
    Ok(view)
}

/// Diameter of the roller, mm.
fn roller(groove: &Groove) -> f64 {
    2.0 * MILLIMETRES * groove.disc.curves().roller_radius().unwrap_or(f64::NAN)
}

/// The section through the axis at θ = 0, next to the front view: how deep the groove is, and where its flanks are.
fn section(groove: &Groove, front: &Extents, view: &mut SheetView) {
    let machine = groove.machine();
    let units = machine.units();
    let Some(thickness) = machine.cam.thickness.map(|thickness| MILLIMETRES * thickness) else { return };
    let depth = machine.cam.track.groove_depth.map_or(thickness, |depth| MILLIMETRES * depth);
    let depth = if *groove.kind == RING { thickness } else { depth };
    let blank = MILLIMETRES * groove.blank_radius;
    let taken = crate::report::sheet::extents_of(&view.groups).with(front);
    let left = taken.largest.x + GAP * blank;
    let right = left + thickness;
    let line =
        |from: (f64, f64), to: (f64, f64)| SheetShape::Line(Vector2::new(from.0, from.1), Vector2::new(to.0, to.1));
    let (piece, angle) = groove.motion.locate(0.0);
    let radii: Vec<f64> = groove
        .flanks
        .iter()
        .map(|flank| MILLIMETRES * groove.curves_of(flank).profile(piece, angle).point.norm())
        .collect();
    let bottom = right - depth;
    let mut shapes = vec![line((left, -blank), (left, blank)), line((left, blank), (right, blank))];
    shapes.push(line((left, -blank), (right, -blank)));
    let inner = if radii.len() > 1 { radii.first().copied() } else { None };
    let outer = radii.last().copied().unwrap_or(blank);
    // Above the axis: the face inside of the groove, its two walls and its bottom, and the face outside of it.
    for side in [1.0, -1.0] {
        shapes.push(line((right, side * outer), (right, side * blank)));
        shapes.push(line((bottom, side * outer), (right, side * outer)));
        match inner {
            Some(inner) => {
                shapes.push(line((bottom, side * inner), (right, side * inner)));
                shapes.push(line((bottom, side * inner), (bottom, side * outer)));
                shapes.push(line((right, 0.0), (right, side * inner)));
            }
            None => shapes.push(line((left, 0.0), (left, side * outer))),
        }
    }
    view.groups
        .push(ShapeGroup { id: "section-of-groove".into(), ..ShapeGroup::new("side", "section at θ = 0", shapes) });
    let bore = machine.cam.bore_radius.map(|radius| MILLIMETRES * radius);
    let hidden: Vec<SheetShape> =
        bore.iter().flat_map(|radius| [*radius, -radius]).map(|y| line((left, y), (right, y))).collect();
    view.groups.push(ShapeGroup { id: "section-bore".into(), ..ShapeGroup::new("hidden", "hidden edges", hidden) });
    let distance = |from: Vector2<f64>, to: Vector2<f64>, way: f64, text: String| Mark::Distance {
        from,
        to,
        away: Vector2::new(0.0, way),
        text,
    };
    let low = |x: f64| Vector2::new(x, -blank);
    view.marks.push(distance(low(left), low(right), -1.0, units.dimension(thickness)));
    if *groove.kind != RING && depth < thickness {
        let top = |x: f64| Vector2::new(x, blank);
        view.marks.push(distance(top(bottom), top(right), 1.0, format!("{} deep", units.dimension(depth))));
    }
}

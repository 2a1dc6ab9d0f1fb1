//! What the review sheet of a groove or a ring shows: the disc under the same roller, with the other flank and the blank.

use super::{Groove, RING};
use crate::body::{Body, Drawn, Layer};
use crate::report::sheet::Dimensions;
use crate::report::sheet::{Mark, ShapeGroup, SheetShape, SheetView};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::outline::OutlineError;
use nalgebra::Vector2;

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
    Ok(view)
}

/// Diameter of the roller, mm.
fn roller(groove: &Groove) -> f64 {
    2.0 * MILLIMETRES * groove.disc.curves().roller_radius().unwrap_or(f64::NAN)
}

//! What report and sheet say of a yoke.

use super::Yoke;
use crate::body::Body;
use crate::body::disc::Disc;
use crate::body::part::point_as_turned;
use crate::report::sheet::Dimensions;
use crate::report::sheet::{Mark, ShapeGroup, SheetShape, SheetView};
use crate::report::{Section, Topic};
use camgen_kernel::follower::Element;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::text::{Length, text};
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Half the length at which a face is shown, over the breadth.
const FACE_OVER_BREADTH: f64 = 0.3;

/// Between what the breadth is measured.
fn between(yoke: &Yoke) -> &'static str {
    match yoke.disc.curves().element() {
        Element::Face => "the faces",
        Element::Roller { .. } => "the near sides of the rollers",
    }
}

/// The section `yoke`.
pub(super) fn section(yoke: &Yoke) -> Section {
    let breadth = MILLIMETRES * yoke.breadth;
    let roller = yoke.disc.curves().roller_radius().map(|radius| MILLIMETRES * radius);
    let centres = roller.map(|radius| breadth + 2.0 * radius);
    let value = serde_json::json!({ "breadth_mm": breadth, "roller_distance_mm": centres });
    let between_centres = centres.map(|centres| text!(", {} between centres", Length::mm(centres)));
    let words = text!("breadth {} between {}{}", Length::mm(breadth), between(yoke), between_centres);
    let breadth = text!("{} between {}", Length::mm(breadth).brief(), between(yoke));
    Section::new("yoke", &value).with_words(vec![words]).with_fact(Topic::new(15, "yoke"), breadth)
}

/// The two faces or rollers as they are at θ = 0, with the distance between them.
pub(super) fn add_breadth(yoke: &Yoke, view: &mut SheetView) {
    let half = FACE_OVER_BREADTH * MILLIMETRES * yoke.breadth;
    let of = |disc: &Disc, at: f64| {
        let (piece, angle) = disc.curves().motion.locate(at);
        let curve = disc.curves().touch(piece, angle).curve;
        let [centre, outward] =
            [curve.point * MILLIMETRES, curve.outward()].map(|vector| point_as_turned(disc.machine(), vector));
        if let Some(radius) = disc.curves().roller_radius() {
            let radius = MILLIMETRES * radius;
            return (SheetShape::Entity(Entity::Circle(centre, radius)), centre - outward * radius);
        }
        let along = Vector2::new(-outward.y, outward.x) * half;
        (SheetShape::Line(centre - along, centre + along), centre)
    };
    let ((first, at), (second, opposite)) = (of(&yoke.disc, 0.0), of(&yoke.opposite, PI));
    let legend = "faces or rollers of the yoke, at θ = 0";
    view.groups.push(ShapeGroup::new("arm", legend, vec![first, second]).with_legend());
    let units = yoke.disc.machine().units();
    let text = format!("yoke {} between {}", units.dimension(MILLIMETRES * yoke.breadth), between(yoke));
    // Faces that are tilted are not across the path.
    let across = yoke.disc.curves().motion.locate(0.0);
    let tilted = yoke.disc.curves().contact(across.0, across.1).pressure_angle != 0.0;
    let mark = if yoke.disc.curves().roller_radius().is_none() && tilted {
        Mark::Label { class: "arm", at, towards: Vector2::new(1.0, 0.3), text }
    } else {
        Mark::Distance { from: opposite, to: at, away: Vector2::new(0.0, -1.0), text }
    };
    view.marks.push(mark);
}

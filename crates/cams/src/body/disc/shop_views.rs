//! What a shop needs on the sheet of a disc in addition to its front view: the arm of the follower, the side view, the start of the cut and the
//! tolerance of the profile.

use super::Disc;
use crate::body::Part;
use crate::body::part::point_as_turned;
use crate::body::part_tolerance::PartTolerance;
use crate::body::sheet::{self, tolerance_frame};
use crate::report::sheet::Dimensions;
use crate::report::sheet::{Mark, ShapeGroup, SheetShape};
use camgen_kernel::follower::{Carrier, Element};
use camgen_kernel::geometry::contour::Extents;
use camgen_kernel::geometry::{Entity, MILLIMETRES, polar};
use camgen_kernel::motion::Jet;
use camgen_kernel::profile::lifts;
use camgen_kernel::profile::outline::Outline;
use nalgebra::Vector2;

/// Radius of the circle of a pivot, mm.
const PIVOT: f64 = 2.0;
/// Distance of the side view from the front view, over the width of the cam.
const SIDE_GAP: f64 = 0.1;

/// What the origin of the cam angle is on the part.
pub(super) fn zero_of(disc: &Disc) -> &'static str {
    match disc.follower().carrier() {
        Carrier::Arm { .. } => "axes; θ = 0: towards the pivot",
        Carrier::Straight | Carrier::Stem { .. } => "axes; θ = 0: along the follower's path",
    }
}

/// The pivot of a swinging follower with its arm at both ends of its swing, as they are at θ = 0, and what they measure.
pub(super) fn arm(disc: &Disc) -> (Vec<ShapeGroup>, Vec<Mark>) {
    let Carrier::Arm { pivot } = disc.follower().carrier() else { return (Vec::new(), Vec::new()) };
    let units = disc.machine.units();
    let turned = |point| point_as_turned(&disc.machine, point * MILLIMETRES);
    let pivot = turned(pivot);
    let label = |at, towards: Vector2<f64>, text| Mark::Label { class: "arm", at, towards, text };
    let mut shapes = vec![SheetShape::Entity(Entity::Circle(pivot, PIVOT))];
    let distance = format!("pivot, {} from the shaft", units.dimension(pivot.norm()));
    let mut marks = vec![label(pivot, Vector2::new(1.0, 0.3), distance)];
    if let Element::Roller { radius } = disc.curves().element() {
        let (low, high) = lifts(disc.curves().motion);
        let end = |lift| turned(disc.follower().touch(0.0, &Jet { s: lift, ..Jet::default() }).curve.point);
        let ends = [end(low), end(high)];
        shapes.extend(ends.map(|end| SheetShape::Line(pivot, end)));
        shapes.extend(ends.map(|end| SheetShape::Entity(Entity::Circle(end, MILLIMETRES * radius))));
        let length = format!("arm {}", units.dimension((ends[0] - pivot).norm()));
        marks.push(label(0.5 * (pivot + ends[0]), Vector2::new(0.0, -1.0), length));
        marks.extend(
            ends.into_iter().zip(["lowest", "highest"]).map(|(end, name)| label(end, end - pivot, name.into())),
        );
    }
    (vec![ShapeGroup::new("arm", "arm at both ends of its swing, at θ = 0", shapes).with_legend()], marks)
}

/// The disc seen from the side, next to the front view.
pub(super) fn side_view(disc: &Disc, part: Option<&Part>, front: &Extents) -> (Vec<ShapeGroup>, Vec<Mark>) {
    // Of a part with a groove or a hole for the roller a section shows more.
    let Some(outline) = part.filter(|part| part.track.is_none()).map(Part::extents) else {
        return (Vec::new(), Vec::new());
    };
    let Some(thickness) = disc.machine.cam.thickness.map(|thickness| MILLIMETRES * thickness) else {
        return (Vec::new(), Vec::new());
    };
    // An arm lies to the right of the cam.
    let gap = SIDE_GAP * outline.size().x;
    let left = match disc.follower().carrier() {
        Carrier::Arm { .. } => front.least.x - gap - thickness,
        Carrier::Straight | Carrier::Stem { .. } => front.largest.x + gap,
    };
    sheet::side_view(
        left,
        &outline,
        (thickness, disc.machine.units()),
        disc.machine.cam.bore_radius.map(|radius| MILLIMETRES * radius),
    )
}

/// The path of the tool to the start of the cut, where one is drawn.
pub(super) fn lead_in(part: &Part) -> Option<ShapeGroup> {
    let shape = SheetShape::Entity(Entity::Segment(part.outline.lead_in?));
    Some(ShapeGroup::new("lead-in", "lead-in", vec![shape]).with_legend())
}

/// Where the cut starts, and the tolerance and the roughness of the profile.
pub(super) fn of_profile(disc: &Disc, outline: &Outline) -> Vec<Mark> {
    let start = outline.contour.edges().next().map(|first| {
        let along = first.start_tangent();
        Mark::Start { at: first.start(), along, outward: Vector2::new(along.y, -along.x), text: "start of cut".into() }
    });
    // In steps of 30° from an angle that misses the axes.
    let places = |from_deg: f64| {
        let angle = |index: u32| (f64::from(30 * index) + from_deg).to_radians();
        let rays: Vec<Vector2<f64>> =
            (0..12).map(|index| libm::sincos(angle(index))).map(|(sin, cos)| Vector2::new(cos, sin)).collect();
        let radii = polar::outermost(&outline.contour, &rays);
        rays.into_iter().zip(radii).filter_map(|(ray, radius)| Some((ray * radius?, ray))).collect()
    };
    let frame = Some(tolerance_frame(
        &disc.machine,
        PartTolerance::of(disc),
        places(225.0),
        disc.machine.cam.keyway.map(|_| "B"),
    ));
    let roughness = &disc.machine.title.surface_roughness;
    let roughness = roughness.as_ref().map(|text| Mark::Roughness { places: places(135.0), text: text.clone() });
    start.into_iter().chain(frame).chain(roughness).collect()
}

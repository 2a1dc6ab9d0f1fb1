//! The front view of a plane part: outlines, holes, hub, joint, and everything that is named on it.

use super::fits::{ViewPlacement, fitted, is_at_zero, keyway_depth, keyway_frame};
use super::proposals::{POSITION, PROPOSED, WIDTH};
use crate::body::part_features::direction;
use crate::body::part_tolerance::PartTolerance;
use crate::body::sheet::tolerance_frame;
use crate::body::{Body, Layer, Part};
use crate::machine::{HolePattern, Machine, MillingDirection, Rotation, TimingMark};
use crate::report::sheet::{
    Dimensions, FeatureFrame, Mark, PROPOSED_ROUGHNESS, ShapeGroup, SheetShape, SheetView, ToleranceSign, TurningArc,
    rounded,
};
use camgen_kernel::geometry::contour::{Contour, Extents, Segment};
use camgen_kernel::geometry::{Entity, MILLIMETRES, polar};
use nalgebra::Vector2;

/// Half the angle of the arrow of the rotation, degrees.
const TURNING: f64 = 12.0;
/// Polar angles at which that arrow may lie, degrees, and its distance from the part as a share of the radius there.
const TURNING_AT: [f64; 8] = [45.0, 135.0, 225.0, 315.0, 30.0, 150.0, 210.0, 330.0];
const TURNING_BEYOND: f64 = 0.12;
/// How far an axis reaches beyond the part, as a share of its size, and beyond a hole, as a share of its radius.
const AXIS_BEYOND: f64 = 0.02;
const HOLE_BEYOND: f64 = 0.4;
/// Holes of a pattern from which on their circle is drawn whole.
const WHOLE_CIRCLE: u32 = 3;

/// Adds the front view of a part.
pub(super) fn add(body: &dyn Body, part: &Part, view: &mut SheetView) {
    let machine = body.machine();
    let front = part.extents();
    view.groups = outlines(part);
    view.groups.extend(hub_group(part));
    view.groups.extend(joint_group(machine, part));
    view.groups.extend(line_mark_group(machine));
    view.groups.push(axes(&front));
    view.groups.extend(axes_of_holes(machine));
    view.marks = marks(body, part);
}

/// The hole by which a cam is set on its shaft: the first with a tolerance class that is named so.
pub(super) fn timing_hole(machine: &Machine) -> Option<&HolePattern> {
    let is_timing = |pattern: &&HolePattern| {
        pattern.fit.is_some() && pattern.count == 1 && pattern.purpose.as_deref() == Some("timing")
    };
    machine.holes.iter().find(is_timing)
}

fn outlines(part: &Part) -> Vec<ShapeGroup> {
    let mut groups = Vec::new();
    for rim in part.rims() {
        let (class, id, label) = match rim.layer {
            Layer::Blank => ("side", "blank", "blank"),
            Layer::Bore => ("side", "bore", "bore and holes"),
            layer => ("outline", if layer == Layer::CamProfile { "profile" } else { layer.name() }, "profile"),
        };
        let shape = SheetShape::Entity(rim.curve);
        groups.push(ShapeGroup { id: id.into(), ..ShapeGroup::new(class, label, vec![shape]) });
    }
    groups
}

/// The hub: hidden if it stands out behind the part alone.
fn hub_group(part: &Part) -> Option<ShapeGroup> {
    let hub = part.hub?;
    let circle = SheetShape::Entity(Entity::Circle(Vector2::zeros(), hub.radius));
    let class = if hub.in_front > 0.0 { "side" } else { "hidden" };
    Some(ShapeGroup { id: "hub".into(), ..ShapeGroup::new(class, "hub", vec![circle]) })
}

/// The joint of a part in two halves, from the bore to the edge on both sides.
fn joint_group(machine: &Machine, part: &Part) -> Option<ShapeGroup> {
    let along = direction(machine, machine.features.split?);
    let bore = MILLIMETRES * machine.cam.bore_radius.unwrap_or(0.0);
    let lines = [along, -along].map(|ray| Some(SheetShape::Line(ray * bore, ray * outermost(part, ray)?)));
    let group = ShapeGroup::new("side", "joint of the halves", lines.into_iter().flatten().collect());
    Some(ShapeGroup { id: "split".into(), ..group })
}

/// A timing mark that is a line on the front face.
fn line_mark_group(machine: &Machine) -> Option<ShapeGroup> {
    let TimingMark::Line { angle, from, to } = machine.features.timing_mark? else { return None };
    let along = direction(machine, angle) * MILLIMETRES;
    let group = ShapeGroup::new("side", "timing mark", vec![SheetShape::Line(along * from, along * to)]);
    Some(ShapeGroup { id: "timing-mark".into(), ..group })
}

fn axes(front: &Extents) -> ShapeGroup {
    let beyond = AXIS_BEYOND * front.size().max();
    let lines = vec![
        SheetShape::Line(Vector2::new(front.least.x - beyond, 0.0), Vector2::new(front.largest.x + beyond, 0.0)),
        SheetShape::Line(Vector2::new(0.0, front.least.y - beyond), Vector2::new(0.0, front.largest.y + beyond)),
    ];
    ShapeGroup::new("axis", "axes", lines)
}

/// The circles on which holes of the machine file lie, and the radial axes of the holes; of a single hole only the arc through it.
fn axes_of_holes(machine: &Machine) -> Option<ShapeGroup> {
    let mut shapes = Vec::new();
    for pattern in &machine.holes {
        let (circle, reach) = (MILLIMETRES * pattern.circle_radius, MILLIMETRES * pattern.radius * (1.0 + HOLE_BEYOND));
        let is_whole = pattern.count >= WHOLE_CIRCLE;
        if is_whole {
            shapes.push(SheetShape::Entity(Entity::Circle(Vector2::zeros(), circle)));
        }
        for centre in pattern.centres() {
            let along = direction(machine, libm::atan2(centre.y, centre.x));
            shapes.push(SheetShape::Line(along * (circle - reach), along * (circle + reach)));
            if !is_whole {
                let half = reach / circle;
                let turned = |angle: f64| {
                    let (sin, cos) = libm::sincos(angle);
                    Vector2::new(along.x * cos - along.y * sin, along.x * sin + along.y * cos) * circle
                };
                let segment = Segment { start: turned(-half), end: turned(half), bulge: libm::tan(0.5 * half) };
                shapes.push(SheetShape::Entity(Entity::Segment(segment)));
            }
        }
    }
    let group = ShapeGroup::new("axis", "axes of holes", shapes);
    (!machine.holes.is_empty()).then(|| ShapeGroup { id: "hole-axes".into(), ..group })
}

/// The dimensions, frames and names of the front view.
fn marks(body: &dyn Body, part: &Part) -> Vec<Mark> {
    let machine = body.machine();
    let units = machine.units();
    let roughness = machine.title.surface_roughness.clone();
    let roughness = roughness.unwrap_or_else(|| format!("{PROPOSED_ROUGHNESS}{PROPOSED}"));
    let mut marks = vec![
        tolerance_frame(machine, PartTolerance::of(body), outward_places(part, 105.0), datum_b(machine)),
        Mark::Roughness { places: outward_places(part, 165.0), text: roughness },
    ];
    marks.extend(start_of_cut(machine, part));
    marks.extend(keyway_frame(machine, &ViewPlacement::FRONT));
    if let (Some(bore), Some(keyway)) = (machine.cam.bore_radius, machine.cam.keyway)
        && !is_at_zero(machine, &keyway)
    {
        let along = direction(machine, keyway.angle);
        let text = format!("{} over the bore", keyway_depth(machine, bore, &keyway));
        let deep = along * (MILLIMETRES * (bore + keyway.depth));
        marks.push(Mark::Label { class: "dimension", at: deep, towards: along, text });
    }
    for pattern in &machine.holes {
        marks.extend(hole_mark(machine, pattern));
    }
    let holes = part.balancing.as_ref().map_or(&[][..], |balancing| balancing.holes.as_slice());
    marks.extend(holes.iter().map(|(centre, radius)| Mark::Label {
        class: "dimension",
        at: centre + Vector2::new(*radius, 0.0),
        towards: Vector2::new(1.0, 0.3),
        text: format!("Ø{}", units.dimension(2.0 * radius)),
    }));
    if let Some(track) = part.track.as_ref().filter(|track| track.depth.is_some()) {
        marks.extend(groove_width(body, track.others.first().map(|flank| &flank.outline.contour)));
    }
    marks.extend(timing_mark_label(machine, part));
    marks.extend(joint_label(machine, part));
    let arcs = TURNING_AT.into_iter().map(|degrees| rotation_arc(machine, part, degrees)).collect();
    marks.push(Mark::Turning { class: "rotation", arcs, text: "rotation".into() });
    marks
}

/// The start of the cut, with the direction in which the program of camgen cuts.
fn start_of_cut(machine: &Machine, part: &Part) -> Option<Mark> {
    let first = part.outline.contour.edges().next()?;
    let along = first.start_tangent();
    // Of a contour that is drawn counter-clockwise, the metal of a disc lies on the left, that of a groove's inner flank too.
    let outward = Vector2::new(along.y, -along.x);
    let is_hollow = part.track.as_ref().is_some_and(|track| track.first.1);
    // A cutter that turns clockwise climbs with the metal on its right.
    let is_climb = machine.cutting().direction == MillingDirection::Climb;
    let along = if is_climb == is_hollow { along } else { -along };
    let way = if is_climb { "climb" } else { "conventional" };
    Some(Mark::Start { at: first.start(), along, outward, text: format!("start of cut ({way})") })
}

/// The letter of the second datum: the keyway, or the timing hole of a part without one.
fn datum_b(machine: &Machine) -> Option<&'static str> {
    let has_keyway = machine.cam.bore_radius.is_some() && machine.cam.keyway.is_some();
    (has_keyway || timing_hole(machine).is_some()).then_some("B")
}

/// The arc of the arrow that shows the rotation of the cam, outside the part near a polar angle, degrees.
fn rotation_arc(machine: &Machine, part: &Part, degrees: f64) -> TurningArc {
    let sense = if machine.cam.rotation == Rotation::Clockwise { -1.0 } else { 1.0 };
    let reach = reach_near(part, degrees);
    TurningArc {
        radius: reach + TURNING_BEYOND * reach,
        from_deg: degrees - sense * TURNING,
        sweep_deg: sense * 2.0 * TURNING,
    }
}

/// The largest radius of a part about a direction, degrees, mm.
fn reach_near(part: &Part, degrees: f64) -> f64 {
    let ray = |step: i32| {
        let (sin, cos) = libm::sincos((degrees + 5.0 * f64::from(step)).to_radians());
        Vector2::new(cos, sin)
    };
    let rays: Vec<Vector2<f64>> = (-4..=4).map(ray).collect();
    let largest = |contour: &Contour| polar::outermost(contour, &rays).into_iter().flatten().fold(0.0, f64::max);
    part.rims().iter().map(|rim| largest(&rim.curve.contour())).fold(0.0, f64::max)
}

/// The largest radius of a part in a direction, mm.
fn outermost(part: &Part, ray: Vector2<f64>) -> Option<f64> {
    let radii =
        part.rims().into_iter().filter_map(|rim| polar::outermost(&rim.curve.contour(), &[ray]).pop().flatten());
    radii.reduce(f64::max)
}

/// Points of the outermost profile with the directions outwards, from an angle that misses the axes.
fn outward_places(part: &Part, from_deg: f64) -> Vec<(Vector2<f64>, Vector2<f64>)> {
    let angle = |index: u32| (f64::from(15 * index) + from_deg).to_radians();
    let rays: Vec<Vector2<f64>> =
        (0..5).map(|index| libm::sincos(angle(index))).map(|(sin, cos)| Vector2::new(cos, sin)).collect();
    let flank = part.outlines().map(|(_, outline)| &outline.contour).last().unwrap_or(&part.outline.contour);
    let radii = polar::outermost(flank, &rays);
    rays.into_iter().zip(radii).filter_map(|(ray, radius)| Some((ray * radius?, ray))).collect()
}

/// Size, number and exact position of the holes of a pattern, at the first of them, with the frame of their position if they have a tolerance class.
fn hole_mark(machine: &Machine, pattern: &HolePattern) -> Option<Mark> {
    let units = machine.units();
    let centre = direction(machine, pattern.angle) * (MILLIMETRES * pattern.circle_radius);
    let towards = centre.try_normalize(0.0)?;
    let radius = MILLIMETRES * pattern.radius;
    let size = match pattern.fit {
        Some(fit) => fitted(machine, 2.0 * radius, Some(fit), ""),
        None => units.dimension(2.0 * radius),
    };
    let number = if pattern.count > 1 { format!("{} × ", pattern.count) } else { String::new() };
    let spaced = if pattern.count > 2 { ", equally spaced" } else { "" };
    let purpose = pattern.purpose.as_ref().map_or_else(String::new, |purpose| format!(", {purpose}"));
    let degrees = libm::atan2(centre.y, centre.x).to_degrees().rem_euclid(360.0);
    let circle = units.dimension(2.0 * MILLIMETRES * pattern.circle_radius);
    let text = format!("{number}Ø{size} through{purpose}, circle Ø{circle}, ψ {}°{spaced}", rounded(degrees));
    if pattern.fit.is_none() || machine.cam.bore_radius.is_none() {
        return Some(Mark::Label { class: "dimension", at: centre + towards * radius, towards, text });
    }
    let has_keyway = machine.cam.keyway.is_some();
    let is_datum = !has_keyway && timing_hole(machine) == Some(pattern);
    let zone = format!("Ø{}", units.zone(POSITION));
    let datums = if datum_b(machine).is_some() && !is_datum { vec!["A", "B"] } else { vec!["A"] };
    let across = Vector2::new(-towards.y, towards.x);
    Some(Mark::Tolerance(FeatureFrame {
        places: [towards, (towards + across).normalize(), (towards - across).normalize()]
            .map(|ray| (centre + ray * radius, ray))
            .to_vec(),
        above: format!("{text} (TED)"),
        sign: Some(ToleranceSign::Position),
        cells: std::iter::once(zone).chain(datums.into_iter().map(str::to_owned)).collect(),
        behind: PROPOSED.trim().into(),
        datum: is_datum.then_some("B"),
    }))
}

/// The text at a timing mark that is not a hole.
fn timing_mark_label(machine: &Machine, part: &Part) -> Option<Mark> {
    let (at, towards, what) = match machine.features.timing_mark? {
        TimingMark::Line { angle, from, to } => {
            let along = direction(machine, angle);
            (along * (0.5 * MILLIMETRES * (from + to)), along, "timing mark, engraved on this face".to_owned())
        }
        TimingMark::Notch { angle, depth } => {
            let (along, blank) = (direction(machine, angle), part.track.as_ref()?.blank?);
            let depth = machine.units().dimension(MILLIMETRES * depth);
            (along * blank, along, format!("timing notch 90°, {depth} deep"))
        }
    };
    let degrees = libm::atan2(towards.y, towards.x).to_degrees().rem_euclid(360.0);
    Some(Mark::Label { class: "dimension", at, towards, text: format!("{what}, ψ {}°", rounded(degrees)) })
}

fn joint_label(machine: &Machine, part: &Part) -> Option<Mark> {
    let along = direction(machine, machine.features.split?);
    let degrees = libm::atan2(along.y, along.x).to_degrees().rem_euclid(360.0);
    let at = along * outermost(part, along)?;
    let text = format!("joint of the two halves, ψ {}°", rounded(degrees));
    Some(Mark::Label { class: "dimension", at, towards: along, text })
}

/// The width of a groove at its outer flank, with the roller that runs in it.
fn groove_width(body: &dyn Body, outer: Option<&Contour>) -> Option<Mark> {
    let machine = body.machine();
    let units = machine.units();
    let cuts = body.cuts();
    let offset = |index: usize| Some(MILLIMETRES * cuts.get(index)?.curves?.offset().abs());
    let width = offset(0)? + offset(1)?;
    let roller = MILLIMETRES * machine.follower.shape.element().offset().abs();
    let (sin, cos) = libm::sincos(-0.6);
    let ray = Vector2::new(cos, sin);
    let at = polar::outermost(outer?, &[ray]).pop().flatten()?;
    let text = format!(
        "groove {} {}{PROPOSED} all along, roller Ø{}",
        units.toleranced(width),
        units.limits(WIDTH),
        units.dimension(2.0 * roller)
    );
    Some(Mark::Label { class: "dimension", at: ray * at, towards: ray, text })
}

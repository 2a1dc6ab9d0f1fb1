//! The drawing for manufacture of a part of even thickness: front view, true sections, sizes, tolerances, and the table of its profile.

use super::part_tolerance::PartTolerance;
use super::sheet::{length_cell, rays_of, tables_of, tolerance_frame, touched};
use super::{Body, Drawn, Layer, Part, curves};
use crate::body::part::point_as_turned;
use crate::machine::{HolePattern, Keyway, Machine, Rotation, parallel_key};
use crate::report::sheet::{Dimensions, Mark, PlaceRow, ShapeGroup, SheetShape, SheetView, ToleranceSign, TurningArc};
use camgen_kernel::geometry::contour::{Contour, Extents};
use camgen_kernel::geometry::section::{Section, SectionLayer, section};
use camgen_kernel::geometry::{Entity, MILLIMETRES, polar};
use camgen_kernel::motion::Quantity;
use camgen_kernel::profile::Curves;
use camgen_kernel::text::Text;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Groups of the review sheet that a drawing of the part has not: what belongs to the mechanism or to the check of the profile.
const OF_MECHANISM: [&str; 8] =
    ["roller", "arm", "pitch-curve", "base-circle", "prime-circle", "lost-motion", "link", "isometric-roller"];
/// Distance of a section from the front view, mm at true size, and over the size of a small part.
const GAP: f64 = 42.0;
const GAP_BESIDE: f64 = 34.0;
const GAP_OVER_SIZE: f64 = 0.6;
/// Distance of the lines of a hatch, mm at true size, and over the size of the part.
const HATCH: f64 = 3.0;
const HATCH_OVER_SIZE: f64 = 0.016;
/// Deviations that are proposed, mm: of the thickness, the depth of a groove, its width; of keyway and faces.
const THICKNESS: [f64; 2] = [-0.1, 0.1];
const DEPTH: [f64; 2] = [0.0, 0.1];
const WIDTH: [f64; 2] = [0.0, 0.02];
const SYMMETRY: f64 = 0.03;
const SQUARE: f64 = 0.02;
/// Behind what nobody has given.
const PROPOSED: &str = " *";
const PROPOSED_NOTE: &str = "* and the frames of tolerances: proposed by camgen, to be confirmed at release";
/// Half the angle of the arrow of the rotation, degrees.
const TURNING: f64 = 12.0;
/// Polar angles at which that arrow may lie, degrees, and how far it lies from the part, as a share of the radius there.
const TURNING_AT: [f64; 8] = [45.0, 135.0, 225.0, 315.0, 30.0, 150.0, 210.0, 330.0];
const TURNING_BEYOND: f64 = 0.12;
/// How far an axis reaches beyond the part, as a share of its size.
const AXIS_BEYOND: f64 = 0.02;
/// Places of a turn at which the motion is looked at for the places of inspection.
const PLACES: u32 = 720;
/// A lift within this share of the largest is at its end.
const LEVEL: f64 = 1e-6;

/// What a drawing shows of a body whose review sheet shows the part in full.
pub(super) fn without_mechanism(mut view: SheetView) -> SheetView {
    view.groups.retain(|group| !OF_MECHANISM.contains(&group.class));
    view.marks.retain(|mark| match mark {
        Mark::Label { class, .. } | Mark::Angle { class, .. } | Mark::Turning { class, .. } => {
            !OF_MECHANISM.contains(class)
        }
        _ => true,
    });
    view.lost.clear();
    view.notes.push(PROPOSED_NOTE.into());
    view
}

/// What the drawing of a plane part shows; `review` is what its review sheet shows.
pub(super) fn of_plane_part(body: &dyn Body, drawn: &Drawn, review: SheetView) -> SheetView {
    let (Some(part), Some(curves)) = (drawn.parts.first(), curves(body)) else { return without_mechanism(review) };
    let machine = body.machine();
    let front = part.extents();
    let mut view = SheetView { facts: review.facts, notes: notes(body, part, review.notes), ..SheetView::default() };
    view.groups = front_groups(part, &front);
    view.groups.extend(pitch_circles(machine));
    view.marks = front_marks(body, part, &front);
    if let Some(thickness) = machine.cam.thickness.map(|thickness| MILLIMETRES * thickness) {
        add_sections(machine, part, &front, thickness, &mut view);
    }
    let table = ProfileTable::of(machine, part, curves);
    view.marks.extend(table.flags());
    view.tables = table.tables();
    view
}

/// The outlines, the bore and the axes.
fn front_groups(part: &Part, front: &Extents) -> Vec<ShapeGroup> {
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
    let beyond = AXIS_BEYOND * front.size().max();
    let axes = vec![
        SheetShape::Line(Vector2::new(front.least.x - beyond, 0.0), Vector2::new(front.largest.x + beyond, 0.0)),
        SheetShape::Line(Vector2::new(0.0, front.least.y - beyond), Vector2::new(0.0, front.largest.y + beyond)),
    ];
    groups.push(ShapeGroup::new("axis", "axes", axes));
    groups
}

/// The circles on which holes of the machine file lie.
fn pitch_circles(machine: &Machine) -> Option<ShapeGroup> {
    let circle = |pattern: &HolePattern| {
        SheetShape::Entity(Entity::Circle(Vector2::zeros(), MILLIMETRES * pattern.circle_radius))
    };
    let circles: Vec<SheetShape> = machine.holes.iter().map(circle).collect();
    let group = ShapeGroup::new("axis", "circles of holes", circles);
    (!machine.holes.is_empty()).then(|| ShapeGroup { id: "hole-circles".into(), ..group })
}

/// What is named on the front view.
fn front_marks(body: &dyn Body, part: &Part, front: &Extents) -> Vec<Mark> {
    let machine = body.machine();
    let units = machine.units();
    let places = |from_deg: f64| outward_places(part, from_deg);
    let mut marks = vec![tolerance_frame(machine, PartTolerance::of(body), places(105.0))];
    let roughness = machine.title.surface_roughness.clone();
    let roughness = roughness.unwrap_or_else(|| format!("{}{PROPOSED}", crate::report::sheet::PROPOSED_ROUGHNESS));
    marks.push(Mark::Roughness { places: places(165.0), text: roughness });
    marks.extend(part.outline.contour.edges().next().map(|first| {
        let along = first.start_tangent();
        let right = Vector2::new(along.y, -along.x);
        // Away from the metal of a disc, out of the groove of a groove.
        Mark::Start { at: first.start(), along, outward: right }
    }));
    marks.extend(keyway_marks(machine));
    marks.extend(machine.holes.iter().filter_map(|pattern| hole_label(machine, pattern)));
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
    let arcs = TURNING_AT.into_iter().map(|degrees| rotation_arc(machine, part, degrees)).collect();
    marks.push(Mark::Turning { class: "rotation", arcs, text: "rotation".into() });
    let right = Vector2::new(front.largest.x, 0.0);
    marks.push(Mark::Label { class: "axis", at: right, towards: Vector2::new(1.0, 0.5), text: "ψ = 0".into() });
    marks
}

/// The arc of the arrow that shows how the cam turns, outside the part near a polar angle, degrees.
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
    let of = |contour: &Contour| polar::outermost(contour, &rays).into_iter().flatten().fold(0.0, f64::max);
    part.rims().iter().map(|rim| of(&rim.curve.contour())).fold(0.0, f64::max)
}

/// Places of the outermost profile with the directions outwards, from an angle that misses the axes.
fn outward_places(part: &Part, from_deg: f64) -> Vec<(Vector2<f64>, Vector2<f64>)> {
    let angle = |index: u32| (f64::from(15 * index) + from_deg).to_radians();
    let rays: Vec<Vector2<f64>> =
        (0..5).map(|index| libm::sincos(angle(index))).map(|(sin, cos)| Vector2::new(cos, sin)).collect();
    let flank = part.outlines().map(|(_, outline)| &outline.contour).last().unwrap_or(&part.outline.contour);
    let radii = polar::outermost(flank, &rays);
    rays.into_iter().zip(radii).filter_map(|(ray, radius)| Some((ray * radius?, ray))).collect()
}

/// The width of the keyway and its symmetry, at the keyway.
fn keyway_marks(machine: &Machine) -> Vec<Mark> {
    let (Some(bore), Some(keyway)) = (machine.cam.bore_radius, machine.cam.keyway) else { return Vec::new() };
    let units = machine.units();
    let along = point_as_turned(machine, Vector2::new(libm::cos(keyway.angle), libm::sin(keyway.angle)));
    let side = Vector2::new(-along.y, along.x);
    let out = MILLIMETRES * (bore + 0.5 * keyway.depth);
    let corner = along * out - side * (0.5 * MILLIMETRES * keyway.width);
    let width = MILLIMETRES * keyway.width;
    let fit = machine.cam.keyway_fit.and_then(|fit| Some((fit, fit.deviations(keyway.width)?)));
    let text = match fit {
        Some((fit, limits)) => {
            format!("{} {fit} {}", units.toleranced(width), units.limits(limits.map(|limit| MILLIMETRES * limit)))
        }
        None => format!("{} P9{PROPOSED}", units.dimension(width)),
    };
    let upper = along * out + side * (0.5 * MILLIMETRES * keyway.width);
    let mut marks = vec![
        Mark::Label { class: "dimension", at: corner, towards: along * 0.7 - side, text },
        Mark::Tolerance {
            sign: ToleranceSign::Symmetry,
            places: vec![(corner, along * 0.4 - side), (upper, along * 0.4 + side)],
            cells: vec![units.zone(SYMMETRY), "A".into()],
            behind: String::new(),
        },
        Mark::Datum { at: upper, towards: along * 0.5 + side, letter: "B" },
    ];
    if !is_in_section(machine, &keyway) {
        let deep = along * (MILLIMETRES * (bore + keyway.depth));
        let text = format!("{} over the bore", keyway_depth(machine, bore, &keyway));
        marks.push(Mark::Label { class: "dimension", at: deep, towards: along, text });
    }
    marks
}

/// The size, number and place of the holes of a pattern, at the first of them.
fn hole_label(machine: &Machine, pattern: &HolePattern) -> Option<Mark> {
    let units = machine.units();
    let centre = point_as_turned(machine, pattern.centres().next()?) * MILLIMETRES;
    let towards = centre.try_normalize(0.0)?;
    let radius = MILLIMETRES * pattern.radius;
    let number = if pattern.count > 1 { format!("{} × ", pattern.count) } else { String::new() };
    let fit = pattern.fit.and_then(|fit| Some((fit, fit.deviations(2.0 * pattern.radius)?)));
    let size = match fit {
        Some((fit, limits)) => {
            let limits = units.limits(limits.map(|limit| MILLIMETRES * limit));
            format!("Ø{} {fit} {limits}", units.toleranced(2.0 * radius))
        }
        None => format!("Ø{}", units.dimension(2.0 * radius)),
    };
    let purpose = pattern.purpose.as_ref().map_or_else(String::new, |purpose| format!(", {purpose}"));
    let angle = libm::atan2(centre.y, centre.x).to_degrees().rem_euclid(360.0);
    let text = format!(
        "{number}{size} through{purpose}: circle Ø{}, ψ {}°",
        units.dimension(2.0 * MILLIMETRES * pattern.circle_radius),
        crate::report::sheet::rounded(angle)
    );
    Some(Mark::Label { class: "dimension", at: centre + towards * radius, towards, text })
}

/// Whether the section A–A shows how deep a keyway is.
fn is_in_section(machine: &Machine, keyway: &Keyway) -> bool {
    let along = point_as_turned(machine, Vector2::new(libm::cos(keyway.angle), libm::sin(keyway.angle)));
    along.x > 1.0 - 1e-9
}

/// From the far side of the bore to the bottom of its keyway, with the limits of DIN 6885-1 where it is that of a standard key.
fn keyway_depth(machine: &Machine, bore: f64, keyway: &Keyway) -> String {
    let units = machine.units();
    let depth = MILLIMETRES * (2.0 * bore + keyway.depth);
    let standard = parallel_key::standard(2.0 * bore, keyway.width, keyway.depth);
    let (deeper, proposed) = standard.map_or((DEPTH[1], PROPOSED), |standard| (MILLIMETRES * standard.deeper, ""));
    format!("{} {}{proposed}", units.toleranced(depth), units.limits([0.0, deeper]))
}

/// The width of a groove at its outer flank, with the roller that runs in it.
fn groove_width(body: &dyn Body, outer: Option<&Contour>) -> Option<Mark> {
    let units = body.machine().units();
    let cuts = body.cuts();
    let offset = |index: usize| Some(MILLIMETRES * cuts.get(index)?.curves?.offset().abs());
    let roller = MILLIMETRES * curves(body)?.roller_radius()?;
    let width = offset(0)? + offset(1)?;
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

/// Where a section lies on the sheet: how its coordinates, along the cutting line and in height, become those of the drawing.
struct SectionPlace {
    letter: &'static str,
    /// Direction of the cutting line in the front view; the part is seen from its left.
    along: Vector2<f64>,
    origin: Vector2<f64>,
    across: Vector2<f64>,
    upwards: Vector2<f64>,
}

impl SectionPlace {
    fn at(&self, place: Vector2<f64>) -> Vector2<f64> {
        self.origin + self.across * place.x + self.upwards * place.y
    }

    fn sight(&self) -> Vector2<f64> {
        Vector2::new(self.along.y, -self.along.x)
    }

    /// The section along ψ = 0, below the front view: seen from above in the first angle, from below in the third.
    fn below(units: LengthUnit, front: &Extents, gap: f64, thickness: f64) -> Self {
        let top = front.least.y - gap;
        let is_first = units == LengthUnit::Millimetre;
        let across = if is_first { Vector2::x() } else { -Vector2::x() };
        let upwards = if is_first { -Vector2::y() } else { Vector2::y() };
        let origin = Vector2::new(0.0, if is_first { top } else { top - thickness });
        Self { letter: "A", along: across, origin, across, upwards }
    }

    /// The section square to it, at the right of the front view: seen from the left in the first angle, from the right in the third.
    fn beside(units: LengthUnit, front: &Extents, gap: f64, thickness: f64) -> Self {
        let left = front.largest.x + gap;
        let is_first = units == LengthUnit::Millimetre;
        let across = if is_first { Vector2::y() } else { -Vector2::y() };
        let upwards = if is_first { Vector2::x() } else { -Vector2::x() };
        let origin = Vector2::new(if is_first { left } else { left + thickness }, 0.0);
        Self { letter: "B", along: across, origin, across, upwards }
    }
}

/// The layers of a part, each with the rims that bound it.
fn layers(part: &Part, thickness: f64) -> (Vec<Contour>, Vec<bool>, Vec<SectionLayer>) {
    let rims = part.rims();
    let contours = rims.iter().map(|rim| rim.curve.contour()).collect();
    let is_flank = rims.iter().map(|rim| !matches!(rim.layer, Layer::Blank | Layer::Bore)).collect();
    let all: Vec<usize> = (0..rims.len()).collect();
    let depth = part.track.as_ref().and_then(|track| track.depth).filter(|depth| *depth < thickness);
    let layers = match depth {
        None => vec![SectionLayer { rims: all, low: 0.0, high: thickness }],
        Some(depth) => {
            let through: Vec<usize> =
                rims.iter().enumerate().filter(|(_, rim)| rim.depth.is_none()).map(|(index, _)| index).collect();
            let floor = thickness - depth;
            vec![
                SectionLayer { rims: through, low: 0.0, high: floor },
                SectionLayer { rims: all, low: floor, high: thickness },
            ]
        }
    };
    (contours, is_flank, layers)
}

/// The section along ψ = 0, and of a part with flanks of its own the one square to it.
fn add_sections(machine: &Machine, part: &Part, front: &Extents, thickness: f64, view: &mut SheetView) {
    let units = machine.units();
    let size = front.size().max();
    let gap = |wanted: f64| wanted.min(GAP_OVER_SIZE * size).max(0.13 * size);
    let (contours, is_flank, layers) = layers(part, thickness);
    let first = SectionPlace::below(units, front, gap(GAP), thickness);
    let cut = section(&contours, &layers, first.along);
    let field = add_section(&first, &cut, &is_flank, size, view);
    view.marks.push(cutting_line(&first, [Vector2::new(front.least.x, 0.0), Vector2::new(front.largest.x, 0.0)]));
    view.marks.extend(section_sizes(machine, part, &field, thickness));
    if part.track.is_some() {
        let second = SectionPlace::beside(units, front, gap(GAP_BESIDE), thickness);
        let cut = section(&contours, &layers, second.along);
        add_section(&second, &cut, &is_flank, size, view);
        let ends = [Vector2::new(0.0, front.least.y), Vector2::new(0.0, front.largest.y)];
        view.marks.push(cutting_line(&second, ends));
    }
}

fn cutting_line(place: &SectionPlace, ends: [Vector2<f64>; 2]) -> Mark {
    Mark::CuttingLine { ends, sight: place.sight(), letter: place.letter }
}

/// The lines of a section with its hatch, its axis and its name; the field that it takes.
fn add_section(place: &SectionPlace, cut: &Section, is_flank: &[bool], size: f64, view: &mut SheetView) -> Extents {
    let (mut flanks, mut edges) = (Vec::new(), Vec::new());
    for edge in &cut.edges {
        let line = SheetShape::Line(place.at(edge.from), place.at(edge.to));
        let of_flank = edge.rim.and_then(|rim| is_flank.get(rim)).copied().unwrap_or(false);
        if of_flank { flanks.push(line) } else { edges.push(line) }
    }
    let step = HATCH.max(HATCH_OVER_SIZE * size).min(0.05 * size);
    let hatch: Vec<SheetShape> = cut
        .cut
        .iter()
        .flat_map(|field| {
            let [one, other] = [place.at(field.least), place.at(field.largest)];
            hatched(&Extents { least: one.inf(&other), largest: one.sup(&other) }, step)
        })
        .collect();
    let name = |kind: &str| format!("{kind}-{}", place.letter);
    let group =
        |id: String, class, label: &'static str, shapes| ShapeGroup { id, ..ShapeGroup::new(class, label, shapes) };
    let lines = [group(name("section"), "side", "edges of the section", edges)];
    let field = crate::report::sheet::extents_of(&lines);
    let [line] = lines;
    let beyond = 0.15 * (field.size().x.min(field.size().y));
    let (low, high) = (field.least.add_scalar(-beyond), field.largest.add_scalar(beyond));
    let axis = if place.across.x == 0.0 {
        SheetShape::Line(Vector2::new(low.x, 0.0), Vector2::new(high.x, 0.0))
    } else {
        SheetShape::Line(Vector2::new(0.0, low.y), Vector2::new(0.0, high.y))
    };
    view.groups.extend([
        group(name("hatch"), "hatch metal", "cut surface", hatch),
        line,
        group(name("flanks"), "cut-flank", "flanks in the section", flanks),
        group(name("axis"), "axis", "axis", vec![axis]),
    ]);
    view.marks.push(Mark::Caption { view: field, text: format!("{0}–{0}", place.letter) });
    field
}

/// Lines at 45° within a rectangle, all of them on one grid of the sheet.
fn hatched(field: &Extents, step: f64) -> Vec<SheetShape> {
    let (low, high) = (field.least, field.largest);
    let spread = step * std::f64::consts::SQRT_2;
    let (first, last) = ((low.y - high.x) / spread, (high.y - low.x) / spread);
    #[expect(clippy::cast_possible_truncation, reason = "a few hundred lines")]
    let numbers = (first.ceil() as i32)..=(last.floor() as i32);
    let line = |number: i32| {
        // y = x + c
        let c = f64::from(number) * spread;
        let (from, to) = (low.x.max(low.y - c), high.x.min(high.y - c));
        (to - from > 1e-6).then(|| SheetShape::Line(Vector2::new(from, from + c), Vector2::new(to, to + c)))
    };
    numbers.filter_map(line).collect()
}

/// The sizes that the section has: thickness, bore with its keyway, depth of the groove, blank; the faces square to the bore.
fn section_sizes(machine: &Machine, part: &Part, field: &Extents, thickness: f64) -> Vec<Mark> {
    let units = machine.units();
    let (low, high) = (field.least, field.largest);
    let mut marks = Vec::new();
    let size = |from: Vector2<f64>, to: Vector2<f64>, away: Vector2<f64>, line: u32, text: String| Mark::Size {
        from,
        to,
        away,
        view: *field,
        line,
        text,
        datum: None,
    };
    // The face on the side that the front view shows is the upper one of the part.
    let face = if units == LengthUnit::Millimetre { low.y } else { high.y };
    let inward = if units == LengthUnit::Millimetre { 1.0 } else { -1.0 };
    if let Some(depth) = part.track.as_ref().and_then(|track| track.depth).filter(|depth| *depth < thickness) {
        let floor = Vector2::new(low.x, face + inward * depth);
        let text = format!("{} {}{PROPOSED}", units.toleranced(depth), units.limits(DEPTH));
        marks.push(size(Vector2::new(low.x, face), floor, -Vector2::x(), 1, text));
    }
    if let Some(blank) = part.track.as_ref().and_then(|track| track.blank) {
        let text = format!("Ø{} h11{PROPOSED}", units.dimension(2.0 * blank));
        marks.push(size(Vector2::new(-blank, low.y), Vector2::new(blank, low.y), -Vector2::y(), 1, text));
    }
    marks.extend(bore_sizes(machine, field));
    // Its text gives way to those of the bore.
    let text = format!("{} {}{PROPOSED}", units.toleranced(thickness), units.limits(THICKNESS));
    marks.push(size(Vector2::new(high.x, low.y), high, Vector2::x(), 1, text));
    marks
}

/// The sizes of the bore and its keyway above the section, and the face square to the bore.
fn bore_sizes(machine: &Machine, field: &Extents) -> Vec<Mark> {
    let Some(bore) = machine.cam.bore_radius else { return Vec::new() };
    let (low, high) = (field.least, field.largest);
    let units = machine.units();
    let mut marks = Vec::new();
    let radius = MILLIMETRES * bore;
    let top = |x: f64| Vector2::new(x, high.y);
    let mut line = 1;
    if let Some(keyway) = machine.cam.keyway.filter(|keyway| is_in_section(machine, keyway)) {
        let bottom = top(radius + MILLIMETRES * keyway.depth);
        marks.push(Mark::Size {
            from: top(-radius),
            to: bottom,
            away: Vector2::y(),
            view: *field,
            line,
            text: keyway_depth(machine, bore, &keyway),
            datum: None,
        });
        line += 1;
    }
    let text = match machine.cam.bore_fit.and_then(|fit| Some((fit, fit.deviations(2.0 * bore)?))) {
        Some((fit, limits)) => {
            let limits = units.limits(limits.map(|limit| MILLIMETRES * limit));
            format!("Ø{} {fit} {limits}", units.toleranced(2.0 * radius))
        }
        None => format!("Ø{} H7{PROPOSED}", units.dimension(2.0 * radius)),
    };
    marks.push(Mark::Size {
        from: top(-radius),
        to: top(radius),
        away: Vector2::y(),
        view: *field,
        line,
        text,
        datum: Some("A"),
    });
    let on_face = |share: f64| (Vector2::new(low.x + share * (high.x - low.x), high.y), Vector2::y());
    marks.push(Mark::Tolerance {
        sign: ToleranceSign::Perpendicular,
        places: vec![on_face(0.85), on_face(0.92), on_face(0.1)],
        cells: vec![units.zone(SQUARE), "A".into()],
        behind: String::new(),
    });
    marks
}

/// What a shop has to know that no line shows.
fn notes(body: &dyn Body, part: &Part, of_review: Vec<Text>) -> Vec<Text> {
    let machine = body.machine();
    let units = machine.units();
    let mut notes: Vec<Text> = vec!["ψ = 0 along +x of the DXF; ψ grows counter-clockwise".into()];
    if let (Some(bore), Some(keyway)) = (machine.cam.bore_radius, machine.cam.keyway)
        && parallel_key::standard(2.0 * bore, keyway.width, keyway.depth).is_some()
    {
        notes.push("keyway DIN 6885-1, through".into());
    }
    if part.track.as_ref().is_some_and(|track| track.depth.is_some()) {
        notes.push("groove open on the side seen in the front view".into());
    }
    if part.track.is_none() {
        let size = part.outline.contour.extents().size();
        let rounded = |value: f64| units.dimension((10.0 * value).round() / 10.0);
        notes.push(format!("encloses {} × {} along x, y of the DXF", rounded(size.x), rounded(size.y)).into());
    }
    notes.extend(of_review);
    notes.push(PROPOSED_NOTE.into());
    notes
}

/// The table of a part's profiles, with the places of inspection.
struct ProfileTable {
    heads: Vec<String>,
    remarks: Vec<String>,
    rows: Vec<PlaceRow>,
    /// Names of the places of inspection, where they lie on the first profile, and the directions out of the metal.
    inspected: Vec<(String, Vector2<f64>, Vector2<f64>)>,
}

impl ProfileTable {
    fn of(machine: &Machine, part: &Part, curves: Curves<'_>) -> Self {
        let units = machine.units();
        let unit = units.symbol();
        let flanks: Vec<(Layer, &Contour)> =
            part.outlines().map(|(layer, outline)| (layer, &outline.contour)).collect();
        let (degrees, rays) = rays_of();
        let changes = changes(machine, curves);
        let all: Vec<Vector2<f64>> = rays.iter().copied().chain(changes.iter().map(|change| change.ray)).collect();
        let radii: Vec<Vec<Option<f64>>> = flanks.iter().map(|(_, contour)| polar::outermost(contour, &all)).collect();
        let first = radii.first().cloned().unwrap_or_default();
        let touches = touched(machine, curves, &rays, first.get(..rays.len()).unwrap_or_default());
        let with_lift = flanks.len() == 1;
        let swings = curves.motion.quantity() == Quantity::Angle;
        let lift = |at: Option<f64>| {
            let lift = at.map(|at| {
                let (piece, angle) = curves.motion.locate(at);
                curves.motion.jet(piece, angle).s
            });
            match lift {
                Some(lift) if swings => format!("{:.3}", lift.to_degrees() + 0.0),
                lift => length_cell(lift.map(|lift| MILLIMETRES * lift), units),
            }
        };
        let row = |index: usize, psi: String, at: Option<f64>| {
            let of_flanks = radii.iter().map(|radii| length_cell(radii.get(index).copied().flatten(), units));
            let theta = at.map_or_else(|| "–".into(), |at| format!("{:.1}", tenths(at.to_degrees())));
            let cells = std::iter::once(psi).chain(of_flanks).chain([theta]).chain(with_lift.then(|| lift(at)));
            cells.collect::<Vec<String>>()
        };
        let mut rows: Vec<(f64, PlaceRow)> = degrees
            .iter()
            .enumerate()
            .map(|(index, psi)| {
                let at = touches.get(index).copied().flatten();
                (*psi, PlaceRow::regular(index, row(index, format!("{psi:.0}"), at)))
            })
            .collect();
        let mut inspected = Vec::new();
        for (number, place) in inspection_places(machine, curves).into_iter().enumerate() {
            let Some(index) = nearest_free(&rows, place, degrees.len()) else { continue };
            let name = format!("P{}", number + 1);
            if let (Some((_, row)), Some(ray)) = (rows.get_mut(index), rays.get(index)) {
                row.flag = Some(name.clone());
                let radius = first.get(index).copied().flatten().unwrap_or(0.0);
                let is_inner =
                    flanks.first().is_some_and(|(layer, _)| matches!(layer, Layer::GrooveInner | Layer::RibInner));
                inspected.push((name, ray * radius, if is_inner { -ray } else { *ray }));
            }
        }
        for (index, change) in changes.iter().enumerate() {
            // Of an undercut profile the place may lie off the outline that is left.
            let radius = first.get(rays.len() + index).copied().flatten();
            if radius.is_none_or(|radius| (radius - change.radius).abs() > OFF_OUTLINE) {
                continue;
            }
            let cells = row(rays.len() + index, format!("{:.2}", change.psi), Some(change.at));
            rows.push((change.psi, PlaceRow { cells, number: None, flag: None }));
        }
        rows.sort_by(|a, b| a.0.total_cmp(&b.0));
        let of_flank = |(layer, _): &(Layer, &Contour)| match (flanks.len(), layer.word()) {
            (1, _) => format!("R {unit}"),
            (_, word) => format!("R {word}"),
        };
        let heads = std::iter::once("ψ °".to_owned()).chain(flanks.iter().map(of_flank)).chain(["θ °".to_owned()]);
        let heads =
            heads.chain(with_lift.then(|| if swings { "s °".to_owned() } else { format!("s {unit}") })).collect();
        let lift = if with_lift { ", s lift" } else { "" };
        let remarks = vec![format!("θ cam angle of contact{lift}. Grey: change of segment. P1 to P5: inspect there.")];
        Self { heads, remarks, rows: rows.into_iter().map(|(_, row)| row).collect(), inspected }
    }

    fn tables(&self) -> Vec<crate::report::sheet::PlaceTable> {
        tables_of("Profile R at polar angle ψ (TED)", &self.heads, &self.remarks, self.rows.clone())
    }

    fn flags(&self) -> Vec<Mark> {
        let flag = |(name, at, outward): &(String, Vector2<f64>, Vector2<f64>)| Mark::Flag {
            at: *at,
            outward: *outward,
            name: name.clone(),
        };
        self.inspected.iter().map(flag).collect()
    }
}

/// An angle, degrees, that is written with one decimal: 359.96 is 0.
fn tenths(degrees: f64) -> f64 {
    ((10.0 * degrees).round() / 10.0).rem_euclid(360.0)
}

/// The row at an equal distance that is nearest to a polar angle, degrees, and has no flag.
fn nearest_free(rows: &[(f64, PlaceRow)], psi: f64, count: usize) -> Option<usize> {
    let apart = |other: f64| ((psi - other + 180.0).rem_euclid(360.0) - 180.0).abs();
    let free = rows.iter().take(count).enumerate().filter(|(_, (_, row))| row.flag.is_none());
    free.min_by(|(_, a), (_, b)| apart(a.0).total_cmp(&apart(b.0))).map(|(index, _)| index)
}

/// A change of segment: the cam angle, rad, and the polar angle of the place that is touched there, degrees.
struct MotionChange {
    at: f64,
    psi: f64,
    /// Its distance from the shaft, mm.
    radius: f64,
    ray: Vector2<f64>,
}

/// A place of the profile farther from the outline than this, mm, is not on it.
const OFF_OUTLINE: f64 = 0.1;
/// Most changes of segment that a table shows.
const MOST_CHANGES: usize = 12;

/// The changes of segment of a motion; none of one with more than a table has room for.
fn changes(machine: &Machine, curves: Curves<'_>) -> Vec<MotionChange> {
    let stretches = curves.motion.named_stretches();
    if stretches.len() < 2 || stretches.len() > MOST_CHANGES {
        return Vec::new();
    }
    let change = |at: f64| {
        let (psi, ray) = polar_place(machine, curves, at)?;
        let (piece, angle) = curves.motion.locate(at);
        let radius = MILLIMETRES * curves.profile(piece, angle).point.norm();
        let is_between = (psi / 5.0 - (psi / 5.0).round()).abs() > 2e-3;
        is_between.then_some(MotionChange { at, psi, radius, ray })
    };
    stretches.iter().filter_map(|stretch| change(stretch.from)).collect()
}

/// The polar angle of the place of the profile that is touched at a cam angle, degrees, and its direction.
fn polar_place(machine: &Machine, curves: Curves<'_>, at: f64) -> Option<(f64, Vector2<f64>)> {
    let (piece, angle) = curves.motion.locate(at);
    let ray = point_as_turned(machine, curves.profile(piece, angle).point).try_normalize(0.0)?;
    Some((libm::atan2(ray.y, ray.x).to_degrees().rem_euclid(360.0), ray))
}

/// The polar angles, degrees, at which a part is inspected: where the rise is fastest, on the upper dwell, at the start of the return, at the greatest
/// pressure angle, and on the lower dwell.
fn inspection_places(machine: &Machine, curves: Curves<'_>) -> Vec<f64> {
    let angles: Vec<f64> = (0..PLACES).map(|index| TAU * f64::from(index) / f64::from(PLACES)).collect();
    let contacts = angles.iter().map(|at| {
        let (piece, angle) = curves.motion.locate(*at);
        curves.contact(piece, angle)
    });
    let contacts: Vec<(f64, f64, f64)> =
        contacts.map(|found| (found.lift.s, found.lift.ds, found.pressure_angle.abs())).collect();
    let greatest = |value: fn(&(f64, f64, f64)) -> f64| {
        let found = contacts.iter().enumerate().max_by(|a, b| value(a.1).total_cmp(&value(b.1)));
        found.map_or(0, |(index, _)| index)
    };
    let (lowest, highest) = contacts
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (lift, ..)| (low.min(*lift), high.max(*lift)));
    let near = LEVEL * (highest - lowest);
    let is_high = |index: usize| contacts.get(index).is_some_and(|(lift, ..)| *lift >= highest - near);
    let is_low = |index: usize| contacts.get(index).is_some_and(|(lift, ..)| *lift <= lowest + near);
    let [upper_start, upper_end] = run_around(greatest(|found| found.0), contacts.len(), is_high);
    let [lower_start, lower_end] = run_around(greatest(|found| -found.0), contacts.len(), is_low);
    let middle = |[from, to]: [usize; 2]| from + (to - from) / 2;
    let places = [
        greatest(|found| found.1),
        middle([upper_start, upper_end]),
        upper_end,
        greatest(|found| found.2),
        middle([lower_start, lower_end]),
    ];
    let psi = |index: usize| {
        let at = angles.get(index % angles.len()).copied()?;
        Some(polar_place(machine, curves, at)?.0)
    };
    places.into_iter().filter_map(psi).collect()
}

/// The first and the last index of the run of places, all alike, that a place lies in; the last may be beyond the turn.
fn run_around(at: usize, count: usize, is_alike: impl Fn(usize) -> bool) -> [usize; 2] {
    let back = (1..count).take_while(|step| is_alike((at + count - step) % count)).count();
    let forth = (1..count).take_while(|step| is_alike((at + step) % count)).count();
    let first = (at + count - back) % count;
    [first, first + (back + forth).min(count - 1)]
}

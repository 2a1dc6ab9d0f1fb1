//! True sections of a plane part, with their sizes.

use super::fits::{bore_words, is_at_zero, keyway_depth};
use super::proposals::{DEPTH, HUB, PROPOSED, SQUARE, THICKNESS};
use crate::body::Part;
use crate::body::part_features::StandingRim;
use crate::machine::Machine;
use crate::report::sheet::{
    Dimensions, FeatureFrame, Mark, ShapeGroup, SheetShape, SheetView, ToleranceSign, extents_of,
};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::{Contour, Extents};
use camgen_kernel::geometry::section::{SectionLayer, section};
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Distance of a section from the front view, mm at true size, and over the size of a small part.
const GAP: f64 = 42.0;
const GAP_BESIDE: f64 = 34.0;
const GAP_OVER_SIZE: f64 = 0.6;
const LEAST_GAP_OVER_SIZE: f64 = 0.13;
/// Distance of the lines of a hatch, mm at true size, and over the size of the part.
const HATCH: f64 = 3.0;
const HATCH_OVER_SIZE: f64 = 0.016;
const MOST_HATCH_OVER_SIZE: f64 = 0.05;
/// How far the axis reaches beyond a section, as a share of its smaller side.
const AXIS_BEYOND: f64 = 0.15;
/// Shares of the width of a face at which the frame of its squareness may stand.
const ON_FACE: [f64; 3] = [0.85, 0.92, 0.1];

/// Where a section lies on the sheet: how its coordinates, along the cutting line and in height, become those of the drawing.
pub(super) struct SectionPlace {
    pub(super) letter: &'static str,
    /// Direction of the cutting line in the front view; the part is seen from its left.
    pub(super) along: Vector2<f64>,
    origin: Vector2<f64>,
    across: Vector2<f64>,
    upwards: Vector2<f64>,
}

impl SectionPlace {
    pub(super) fn at(&self, place: Vector2<f64>) -> Vector2<f64> {
        self.origin + self.across * place.x + self.upwards * place.y
    }

    pub(super) fn sight(&self) -> Vector2<f64> {
        Vector2::new(self.along.y, -self.along.x)
    }

    /// The section along ψ = 0, below the front view: seen from above in the first angle, from below in the third.
    pub(super) fn below(units: LengthUnit, front: &Extents, gap: f64, [low, high]: [f64; 2]) -> Self {
        let top = front.least.y - gap;
        let is_first = units == LengthUnit::Millimetre;
        let across = if is_first { Vector2::x() } else { -Vector2::x() };
        let upwards = if is_first { -Vector2::y() } else { Vector2::y() };
        let origin = Vector2::new(0.0, if is_first { top + low } else { top - high });
        Self { letter: "A", along: across, origin, across, upwards }
    }

    /// The section square to it, at the right of the front view: seen from the left in the first angle, from the right in the third.
    fn beside(units: LengthUnit, front: &Extents, gap: f64, [low, high]: [f64; 2]) -> Self {
        let left = front.largest.x + gap;
        let is_first = units == LengthUnit::Millimetre;
        let across = if is_first { Vector2::y() } else { -Vector2::y() };
        let upwards = if is_first { Vector2::x() } else { -Vector2::x() };
        let origin = Vector2::new(if is_first { left - low } else { left + high }, 0.0);
        Self { letter: "B", along: across, origin, across, upwards }
    }
}

/// A part as its sections need it.
struct SectionedPart {
    contours: Vec<Contour>,
    /// Which of them a follower runs on.
    is_flank: Vec<bool>,
    layers: Vec<SectionLayer>,
    /// Lowest and highest z, mm.
    ends: [f64; 2],
}

impl SectionedPart {
    fn new(part: &Part, thickness: f64) -> Self {
        let rims = part.standing_rims(thickness);
        let mut heights: Vec<f64> = rims.iter().flat_map(|rim| [rim.wall.low, rim.wall.high]).collect();
        heights.sort_by(f64::total_cmp);
        heights.dedup();
        let mut layers = Vec::new();
        for ends in heights.windows(2) {
            let &[low, high] = ends else { continue };
            let stands = |rim: &StandingRim| rim.wall.low <= low && rim.wall.high >= high;
            let rims = rims.iter().enumerate().filter(|(_, rim)| stands(rim)).map(|(index, _)| index).collect();
            layers.push(SectionLayer { rims, low, high });
        }
        Self {
            is_flank: rims.iter().map(|rim| rim.is_flank).collect(),
            contours: rims.into_iter().map(|rim| rim.wall.contour).collect(),
            layers,
            ends: [heights.first().copied().unwrap_or(0.0), heights.last().copied().unwrap_or(thickness)],
        }
    }
}

/// Adds the section along ψ = 0, and of a part with flanks of its own the one square to it.
pub(super) fn add(machine: &Machine, part: &Part, thickness: f64, view: &mut SheetView) {
    let units = machine.units();
    let front = part.extents();
    let size = front.size().max();
    let gap = |wanted: f64| wanted.min(GAP_OVER_SIZE * size).max(LEAST_GAP_OVER_SIZE * size);
    let sectioned = SectionedPart::new(part, thickness);
    let first = SectionPlace::below(units, &front, gap(GAP), sectioned.ends);
    let field = add_section(&first, &sectioned, size, view);
    view.marks.push(cutting_line(&first, [Vector2::new(front.least.x, 0.0), Vector2::new(front.largest.x, 0.0)]));
    view.marks.extend(sizes(machine, part, (&first, &field), thickness));
    if part.track.is_some() {
        let second = SectionPlace::beside(units, &front, gap(GAP_BESIDE), sectioned.ends);
        add_section(&second, &sectioned, size, view);
        let ends = [Vector2::new(0.0, front.least.y), Vector2::new(0.0, front.largest.y)];
        view.marks.push(cutting_line(&second, ends));
    }
}

fn cutting_line(place: &SectionPlace, ends: [Vector2<f64>; 2]) -> Mark {
    Mark::CuttingLine { ends, sight: place.sight(), letter: place.letter }
}

/// The lines of a section with its hatch, its axis and its name; the field that it takes.
fn add_section(place: &SectionPlace, part: &SectionedPart, size: f64, view: &mut SheetView) -> Extents {
    let cut = section(&part.contours, &part.layers, place.along);
    let (mut flanks, mut edges) = (Vec::new(), Vec::new());
    for edge in &cut.edges {
        let line = SheetShape::Line(place.at(edge.from), place.at(edge.to));
        let of_flank = edge.rim.and_then(|rim| part.is_flank.get(rim)).copied().unwrap_or(false);
        if of_flank { flanks.push(line) } else { edges.push(line) }
    }
    let step = HATCH.max(HATCH_OVER_SIZE * size).min(MOST_HATCH_OVER_SIZE * size);
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
    let field = extents_of(&lines);
    let [line] = lines;
    let beyond = AXIS_BEYOND * (field.size().x.min(field.size().y));
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
pub(super) fn hatched(field: &Extents, step: f64) -> Vec<SheetShape> {
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

/// A size of the section on a line beside it.
struct SectionSize {
    from: Vector2<f64>,
    to: Vector2<f64>,
    away: Vector2<f64>,
    line: u32,
    text: String,
}

impl SectionSize {
    fn mark(self, field: &Extents) -> Mark {
        let Self { from, to, away, line, text } = self;
        Mark::Size { from, to, away, view: *field, line, text, datum: None, is_half: false }
    }
}

/// The sizes of the section A–A: thickness, hub, depth of the groove, blank, bore with its keyway; the faces square to the bore.
fn sizes(machine: &Machine, part: &Part, (place, field): (&SectionPlace, &Extents), thickness: f64) -> Vec<Mark> {
    let units = machine.units();
    let (left, right) = (field.least.x, field.largest.x);
    let level = |z: f64| place.at(Vector2::new(0.0, z)).y;
    let mut sizes = Vec::new();
    // On the left, from the front face.
    let mut left_line = 1;
    if let Some(depth) = part.track.as_ref().and_then(|track| track.depth).filter(|depth| *depth < thickness) {
        let text = format!("{} {}{PROPOSED}", units.toleranced(depth), units.limits(DEPTH));
        let [from, to] = [thickness, thickness - depth].map(|z| Vector2::new(left, level(z)));
        sizes.push(SectionSize { from, to, away: -Vector2::x(), line: left_line, text });
        left_line += 1;
    }
    let (mut above, mut below) = (1, 1);
    let mut next_line = |is_above: bool| {
        let line = if is_above { &mut above } else { &mut below };
        *line += 1;
        *line - 1
    };
    if let Some(hub) = part.hub {
        let is_in_front = hub.in_front > 0.0;
        let end = if is_in_front { thickness + hub.in_front } else { -hub.behind };
        let is_above = level(end) > level(0.5 * thickness);
        let [from, to] = [-hub.radius, hub.radius].map(|x| Vector2::new(x, level(end)));
        let text = format!("Ø{} {}{PROPOSED}", units.toleranced(2.0 * hub.radius), units.limits(HUB));
        let away = if is_above { Vector2::y() } else { -Vector2::y() };
        sizes.push(SectionSize { from, to, away, line: next_line(is_above), text });
        let text = format!("{} {}{PROPOSED}", units.toleranced(thickness + hub.length()), units.limits(THICKNESS));
        let [from, to] = [-hub.behind, thickness + hub.in_front].map(|z| Vector2::new(-hub.radius, level(z)));
        sizes.push(SectionSize { from, to, away: -Vector2::x(), line: left_line, text });
        left_line += 1;
        if hub.behind > 0.0 && is_in_front {
            let text = units.dimension(hub.in_front);
            let [from, to] = [thickness, end].map(|z| Vector2::new(left, level(z)));
            sizes.push(SectionSize { from, to, away: -Vector2::x(), line: left_line, text });
        }
    }
    if let Some(blank) = part.track.as_ref().and_then(|track| track.blank) {
        let text = format!("Ø{} h11{PROPOSED}", units.dimension(2.0 * blank));
        let bottom = level(0.0).min(level(thickness));
        let [from, to] = [-blank, blank].map(|x| Vector2::new(x, bottom));
        sizes.push(SectionSize { from, to, away: -Vector2::y(), line: next_line(false), text });
    }
    let mut marks: Vec<Mark> = sizes.into_iter().map(|size| size.mark(field)).collect();
    let upper_face = level(0.0).max(level(thickness));
    marks.extend(bore_sizes(machine, field, next_line(true)));
    if machine.cam.bore_radius.is_some() {
        let places = ON_FACE.map(|share| (Vector2::new(left + share * (right - left), upper_face), Vector2::y()));
        marks.push(Mark::Tolerance(FeatureFrame {
            places: places.to_vec(),
            above: String::new(),
            sign: Some(ToleranceSign::Perpendicular),
            cells: vec![units.zone(SQUARE), "A".into()],
            behind: String::new(),
            datum: None,
        }));
    }
    // Its text gives way to those of the bore.
    let text = format!("{} {}{PROPOSED}", units.toleranced(thickness), units.limits(THICKNESS));
    let [from, to] = [0.0, thickness].map(|z| Vector2::new(right, level(z)));
    marks.push(SectionSize { from, to, away: Vector2::x(), line: 1, text }.mark(field));
    marks.extend(chamfer_label(machine, field));
    marks
}

/// The sizes of the bore and its keyway above the section, from a line on.
fn bore_sizes(machine: &Machine, field: &Extents, mut line: u32) -> Vec<Mark> {
    let Some(bore) = machine.cam.bore_radius else { return Vec::new() };
    let mut marks = Vec::new();
    let radius = MILLIMETRES * bore;
    let top = |x: f64| Vector2::new(x, field.largest.y);
    let keyway = machine.cam.keyway.filter(|keyway| is_at_zero(machine, keyway));
    if let Some(keyway) = keyway {
        let text = keyway_depth(machine, bore, &keyway);
        let bottom = top(radius + MILLIMETRES * keyway.depth);
        marks.push(SectionSize { from: top(-radius), to: bottom, away: Vector2::y(), line, text }.mark(field));
        line += 1;
    }
    marks.push(Mark::Size {
        from: top(-radius),
        to: top(radius),
        away: Vector2::y(),
        view: *field,
        line,
        text: bore_words(machine, bore),
        datum: Some("A"),
        // The keyway has cut the other edge away.
        is_half: keyway.is_some(),
    });
    marks
}

/// The chamfers at both ends of the bore.
fn chamfer_label(machine: &Machine, field: &Extents) -> Option<Mark> {
    let (bore, chamfer) = (machine.cam.bore_radius?, machine.features.chamfer?);
    let text = format!("2 × {} × 45°", machine.units().dimension(MILLIMETRES * chamfer));
    let at = Vector2::new(-MILLIMETRES * bore, field.least.y);
    Some(Mark::Label { class: "dimension", at, towards: Vector2::new(-1.0, -1.0), text })
}

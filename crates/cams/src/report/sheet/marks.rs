//! Labels, dimensions and arrows at the size of the lettering.

use super::paper::rectangle;
use super::placing::{OccupiedPaper, field_near, filling, half_field};
use super::{FeatureFrame, Mark, ShapeGroup, SheetShape, TextAnchor, ToleranceSign, TurningArc, font, words};
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Over the lettering of a sheet, mm: texts, arrow heads, the distance of a dimension line from what it measures and from the next.
const TEXT: f64 = font::SMALLEST;
const HEAD: f64 = 2.8;
const APART: f64 = 7.0;
/// The same of the sizes of a view, with how far an extension line begins from the edge and goes on behind the dimension line.
const FIRST: f64 = 10.0;
const NEXT: f64 = 8.0;
const OFF: f64 = 1.0;
const BEYOND: f64 = 1.5;
/// How far a half dimension line goes on beyond the middle, mm.
const BEYOND_MIDDLE: f64 = 6.0;
/// Size of the letters of views and cutting lines, mm: capitals of 5 mm.
const VIEW_NAME: f64 = 5.0 / font::CAPITAL;
/// Length of the strokes at the ends of a cutting line, and of its arrows, mm.
const CUT_STROKE: f64 = 6.0;
const CUT_ARROW: f64 = 7.0;
/// Distance of the name of a view from it, mm.
const CAPTION: f64 = 8.0;
const CAPTION_BESIDE: f64 = 14.0;
/// Distance of a cutting line from the view, mm.
const CUT_OFF: f64 = 4.0;
/// Radius of the dot at a place of inspection, mm.
const DOT: f64 = 0.7;
const DOT_CORNERS: u32 = 16;
/// Width of a head over its length.
const SLENDER: f64 = 0.3;
/// Distances of a text from its place that are tried, in the same unit, the nearest first.
const DISTANCES: [f64; 12] = [2.0, 3.5, 5.5, 8.0, 11.0, 15.0, 20.0, 27.0, 36.0, 50.0, 70.0, 100.0];
/// Farther ones for what found no place, with as many times the directions.
const FARTHER: [f64; 4] = [60.0, 85.0, 120.0, 150.0];
const MORE: u32 = 4;
/// Directions that are tried, to either side of the wanted one.
const DIRECTIONS: u32 = 24;
/// Height of a frame over that of its letters (ISO 7083: 2).
const CELL: f64 = 2.0;
/// Height of the line of text above a frame over that of its letters, and length of the stem of a datum below it, mm.
const ABOVE_FRAME: f64 = 1.7;
const DATUM_STEM: f64 = 5.0;
/// Distances of a frame or a ring from its place that are tried, mm, and degrees to either side of the direction outwards.
const LEADERS: [f64; 6] = [9.0, 13.0, 18.0, 25.0, 34.0, 46.0];
const TURNS: [f64; 9] = [0.0, 12.0, -12.0, 28.0, -28.0, 42.0, -42.0, 60.0, -60.0];
/// Share of a leader near its place in which other texts may lie.
const LEADER_START: f64 = 0.02;
/// A text farther away than this is tied to its place with a line.
const TIED: f64 = 3.0;

/// The pen with which marks are drawn.
pub(super) struct Marker<'a> {
    /// The occupied parts of the paper.
    pub(super) taken: &'a mut OccupiedPaper,
    /// What the view covers, mm of paper.
    pub(super) covered: Extents,
    /// Dimension lines so far on each side.
    pub(super) lines: [f64; 2],
    /// Texts of marks with a fixed place: they are placed when all lines are known.
    pub(super) texts: Vec<Mark>,
}

/// A datum at the left end of a dimension line: a triangle in line with the arrow, and its letter in a frame.
fn datum_at(end: Vector2<f64>, letter: &str, size: f64) -> Vec<SheetShape> {
    let side = CELL * size;
    let tip = end - Vector2::new(HEAD, 0.0);
    let half = Vector2::new(0.0, 0.5 * HEAD);
    let corner = tip - Vector2::new(1.5 + side, 0.5 * side);
    let mut shapes = rectangle(&Extents { least: corner, largest: corner.add_scalar(side) });
    shapes.push(SheetShape::Triangle([tip, end + half, end - half]));
    shapes.push(SheetShape::Line(tip, tip - Vector2::new(1.5, 0.0)));
    let base = corner + Vector2::new(0.5 * side, 0.5 * side - 0.35 * size);
    shapes.push(words(base, size, TextAnchor::Middle, letter));
    shapes
}

/// The point of a field nearest to a place.
fn nearest_corner(field: &Extents, at: Vector2<f64>) -> Vector2<f64> {
    at.sup(&field.least).inf(&field.largest)
}

/// A datum below a frame: a triangle on the frame, and the letter in a box.
fn datum_below(at: Vector2<f64>, letter: &str) -> Vec<SheetShape> {
    let side = CELL * TEXT;
    let tip = at - Vector2::new(0.0, HEAD);
    let half = Vector2::new(0.5 * HEAD, 0.0);
    let corner = at - Vector2::new(0.5 * side, DATUM_STEM + side);
    let mut shapes = rectangle(&Extents { least: corner, largest: corner.add_scalar(side) });
    shapes.push(SheetShape::Triangle([tip, at + half, at - half]));
    shapes.push(SheetShape::Line(tip, at - Vector2::new(0.0, DATUM_STEM)));
    let base = corner + Vector2::new(0.5 * side, 0.5 * side - 0.35 * TEXT);
    shapes.push(words(base, TEXT, TextAnchor::Middle, letter));
    shapes
}

fn triangle(tip: Vector2<f64>, along: Vector2<f64>, length: f64) -> SheetShape {
    let (back, side) = (tip - along * length, Vector2::new(-along.y, along.x) * (0.5 * SLENDER * length));
    SheetShape::Triangle([tip, back + side, back - side])
}

/// A text where there is room for it, with its leader.
pub(in crate::report) fn label(
    taken: &mut OccupiedPaper,
    lettering: f64,
    at: Vector2<f64>,
    towards: Vector2<f64>,
    text: &str,
) -> Vec<SheetShape> {
    let size = TEXT * lettering;
    let Some((field, leader)) = place(taken, lettering, at, towards, (half_field(text, size), TIED)) else {
        return Vec::new();
    };
    let shapes: Vec<SheetShape> = std::iter::once(filling(&field, size, text)).chain(leader).collect();
    for shape in &shapes {
        taken.put(shape);
    }
    shapes
}

/// How free the place of a text must be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Room {
    /// Of lines and texts, with a leader that crosses no text.
    Free,
    /// As free, but farther away or in directions between.
    Farther,
    /// The leader may cross texts.
    CrossedTexts,
    /// The text may cover lines as well.
    CoveredLines,
}

/// A field of these half sides as near to a place as there is one, and the leader of a field farther away than `tied` (over the lettering of an
/// A4, mm). What a shop must read is never left out: where nothing is free, the leader crosses texts, then the text covers lines.
fn place(
    taken: &OccupiedPaper,
    lettering: f64,
    at: Vector2<f64>,
    towards: Vector2<f64>,
    sizes: (Vector2<f64>, f64),
) -> Option<(Extents, Option<SheetShape>)> {
    [Room::Free, Room::Farther, Room::CrossedTexts, Room::CoveredLines]
        .into_iter()
        .find_map(|room| place_in(room, taken, lettering, (at, towards), sizes))
}

fn place_in(
    room: Room,
    taken: &OccupiedPaper,
    lettering: f64,
    (at, towards): (Vector2<f64>, Vector2<f64>),
    (half, tied): (Vector2<f64>, f64),
) -> Option<(Extents, Option<SheetShape>)> {
    let wanted = libm::atan2(towards.y, towards.x);
    let (farther, directions): (&[f64], u32) =
        if room == Room::Free { (&[], DIRECTIONS) } else { (&FARTHER, MORE * DIRECTIONS) };
    for &distance in DISTANCES.iter().chain(farther) {
        for index in 0..directions {
            // 0, +1, −1, +2, −2, …
            let step = f64::from(index.div_ceil(2)) * if index % 2 == 0 { -1.0 } else { 1.0 };
            let angle = wanted + step * std::f64::consts::TAU / f64::from(directions);
            let along = Vector2::new(libm::cos(angle), libm::sin(angle));
            let field = field_near(at, along, distance * lettering, half);
            let nearest = at.sup(&field.least).inf(&field.largest);
            let apart = (nearest - at).norm();
            let is_free = if room == Room::CoveredLines { taken.free_of_texts(&field) } else { taken.free(&field) };
            if apart > distance * lettering * 1.01 + 1e-9 || !is_free {
                continue;
            }
            let tied = apart > tied * lettering;
            let towards = (at - nearest) / apart.max(1e-9);
            if tied && matches!(room, Room::Free | Room::Farther) && !taken.clear(at, nearest) {
                continue;
            }
            return Some((field, tied.then(|| SheetShape::Line(at, nearest + towards * (0.4 * lettering)))));
        }
    }
    None
}

/// The sign of a tolerance, ISO 1101, in a square with this lower left corner.
fn tolerance_sign(sign: ToleranceSign, corner: Vector2<f64>, side: f64) -> Vec<SheetShape> {
    let at = |x: f64, y: f64| corner + Vector2::new(x, y) * side;
    let line = |from: (f64, f64), to: (f64, f64)| SheetShape::Line(at(from.0, from.1), at(to.0, to.1));
    match sign {
        ToleranceSign::Profile | ToleranceSign::ProfileAllAround => {
            vec![SheetShape::Arc(at(0.85, 0.3), at(0.15, 0.3), 1.0)]
        }
        ToleranceSign::Perpendicular => vec![line((0.2, 0.22), (0.8, 0.22)), line((0.5, 0.22), (0.5, 0.8))],
        ToleranceSign::Parallel => vec![line((0.2, 0.2), (0.55, 0.8)), line((0.45, 0.2), (0.8, 0.8))],
        ToleranceSign::Symmetry => {
            vec![line((0.32, 0.3), (0.68, 0.3)), line((0.2, 0.5), (0.8, 0.5)), line((0.32, 0.7), (0.68, 0.7))]
        }
        ToleranceSign::Surface => {
            vec![SheetShape::Arc(at(0.85, 0.3), at(0.15, 0.3), 1.0), line((0.15, 0.3), (0.85, 0.3))]
        }
        ToleranceSign::Position => vec![
            SheetShape::Entity(Entity::Circle(at(0.5, 0.5), 0.22 * side)),
            line((0.15, 0.5), (0.85, 0.5)),
            line((0.5, 0.15), (0.5, 0.85)),
        ],
    }
}

/// An arrow along a size.
fn arrow(tip: Vector2<f64>, along: Vector2<f64>) -> SheetShape {
    triangle(tip, along, HEAD)
}

impl Marker<'_> {
    /// The groups of a mark whose places are millimetres of paper.
    pub(super) fn groups(&mut self, mark: &Mark) -> Vec<ShapeGroup> {
        let (class, shapes) = match mark {
            Mark::Label { class, at, towards, text } => (*class, self.label(*at, *towards, text)),
            Mark::Distance { from, to, away, text } => ("dimension", self.distance(*from, *to, *away, text)),
            Mark::Radius { centre, to, text } => ("dimension", self.radius("dimension", *centre, *to, text)),
            Mark::Angle { class, corner, from, to, radius, text } => {
                (*class, self.angle(class, *corner, [*from, *to], *radius, text))
            }
            Mark::Size { .. } => ("dimension", self.size(mark)),
            Mark::Flag { at, outward, name } => ("dimension", self.flag(*at, *outward, name)),
            Mark::CuttingLine { ends, sight, letter } => return self.cutting_line(*ends, *sight, letter),
            Mark::Caption { view, text } => ("facts", self.caption(view, text)),
            Mark::Tolerance(frame) => ("dimension", self.tolerance(frame)),
            Mark::Roughness { places, text } => ("dimension", self.roughness(places, text)),
            Mark::Start { at, along, outward, text } => ("dimension", self.start(*at, *along, *outward, text)),
            Mark::Datum { at, towards, letter } => ("dimension", self.datum(*at, *towards, letter)),
            Mark::Turning { class, arcs, text } => (*class, self.turning(class, arcs, text)),
        };
        vec![ShapeGroup { id: String::new(), class, label: class.into(), colour: None, shapes, in_legend: false }]
    }

    fn put(&mut self, shapes: &[SheetShape]) {
        for shape in shapes {
            self.taken.put(shape);
        }
    }

    fn label(&mut self, at: Vector2<f64>, towards: Vector2<f64>, text: &str) -> Vec<SheetShape> {
        label(self.taken, 1.0, at, towards, text)
    }

    /// A dimension line outside of the view, with its extension lines.
    fn distance(&mut self, from: Vector2<f64>, to: Vector2<f64>, away: Vector2<f64>, text: &str) -> Vec<SheetShape> {
        let size = TEXT;
        let upright = away.x != 0.0;
        let number = self.lines.get_mut(usize::from(upright));
        let line = number.map_or(0.0, |number| {
            *number += 1.0;
            *number
        });
        let covered = if away.x + away.y < 0.0 { self.covered.least } else { self.covered.largest };
        let moved = |point: Vector2<f64>| {
            let place = covered + away * (APART * line);
            if upright { Vector2::new(place.x, point.y) } else { Vector2::new(point.x, place.y) }
        };
        let (a, b) = (moved(from), moved(to));
        let (length, along) = ((b - a).norm(), (b - a).normalize());
        let mut shapes: Vec<SheetShape> = [(from, a), (to, b)]
            .into_iter()
            .map(|(point, end)| SheetShape::Line(point + away * 1.0, end + away * 1.5))
            .collect();
        let inside = length > 3.0 * HEAD;
        let head = if inside { along } else { -along };
        shapes.push(triangle(a, -head, HEAD));
        shapes.push(triangle(b, head, HEAD));
        let (half, middle) = (0.5 * font::width(text, size), 0.5 * (a + b));
        if upright {
            // The text is in a gap of the line.
            let gap = along * (0.75 * size);
            shapes.push(SheetShape::Line(a, middle - gap));
            shapes.push(SheetShape::Line(middle + gap, b));
            shapes.push(words(middle - Vector2::new(0.0, 0.35 * size), size, TextAnchor::Middle, text));
        } else if 2.0 * (half + HEAD) < length {
            let gap = along * (half + 0.5 * size);
            shapes.push(SheetShape::Line(a, middle - gap));
            shapes.push(SheetShape::Line(middle + gap, b));
            shapes.push(words(middle - Vector2::new(0.0, 0.35 * size), size, TextAnchor::Middle, text));
        } else {
            shapes.push(SheetShape::Line(a, b));
            // To the right where there is paper, else to the left.
            let apart = Vector2::new(1.5 * HEAD, 0.35 * size);
            let right = words(a.sup(&b) + Vector2::new(apart.x, -apart.y), size, TextAnchor::Start, text);
            let is_free = right.text_field().is_some_and(|field| self.taken.free(&field));
            let left = words(a.inf(&b) - apart, size, TextAnchor::End, text);
            shapes.push(if is_free { right } else { left });
        }
        self.put(&shapes);
        shapes
    }

    /// A dimension line beside a view, the text above it (ISO 129-1), with the datum that its axis or middle is.
    fn size(&mut self, mark: &Mark) -> Vec<SheetShape> {
        let Mark::Size { from, to, away, view, line, text, datum, is_half } = mark else { return Vec::new() };
        let size = TEXT;
        let upright = away.x != 0.0;
        let edge = if away.x + away.y < 0.0 { view.least } else { view.largest };
        let distance = FIRST + NEXT * (f64::from(*line) - 1.0);
        let moved = |point: &Vector2<f64>| {
            let place = edge + away * distance;
            if upright { Vector2::new(place.x, point.y) } else { Vector2::new(point.x, place.y) }
        };
        let (a, b) = (moved(from), moved(to));
        let (a, b) = if (b - a).sum() >= 0.0 { (a, b) } else { (b, a) };
        let (length, along) = ((b - a).norm(), if upright { Vector2::y() } else { Vector2::x() });
        let extension =
            |(point, end): (&Vector2<f64>, Vector2<f64>)| SheetShape::Line(point + away * OFF, end + away * BEYOND);
        let wide = font::width(text, size);
        if *is_half {
            return self.half_size((moved(from), moved(to)), extension((from, moved(from))), text, *datum);
        }
        let mut shapes: Vec<SheetShape> = [(from, moved(from)), (to, moved(to))].map(extension).to_vec();
        let is_inside = length > 3.0 * HEAD;
        let head = if is_inside { along } else { -along };
        shapes.extend([arrow(a, -head), arrow(b, head)]);
        let lift = 0.35 * size;
        // A text stands above its line; where it is wider than the line, the line goes on below it.
        let (start, text_at, anchor) = if upright {
            // The text stands on a shelf at the upper end, or at the lower one where there is no room.
            let beyond = along * (2.5 * HEAD);
            let reach = away * (wide + 0.5 * size);
            let text_on = |end: Vector2<f64>| Vector2::new(end.x + 0.5 * reach.x, end.y + lift);
            let is_free = |end: &Vector2<f64>| {
                let field = words(text_on(*end), size, TextAnchor::Middle, text.clone()).text_field();
                field.is_some_and(|field| self.taken.free(&field))
            };
            let ends = [b + beyond, a - beyond];
            let end = ends.into_iter().find(is_free).unwrap_or(ends[0]);
            let other = if end == ends[0] { a } else { b };
            let other = if is_inside {
                other
            } else if end == ends[0] {
                a - beyond
            } else {
                b + beyond
            };
            shapes.push(SheetShape::Line(other, end));
            shapes.push(SheetShape::Line(end, end + reach));
            (end, text_on(end), TextAnchor::Middle)
        } else if is_inside && wide + 2.0 * HEAD < length {
            shapes.push(SheetShape::Line(a, b));
            (a, 0.5 * (a + b) + Vector2::new(0.0, lift), TextAnchor::Middle)
        } else {
            let before = if is_inside { a } else { a - along * (2.0 * HEAD) };
            let end = b + along * (2.0 * HEAD + wide + 0.5 * size);
            shapes.push(SheetShape::Line(before, end));
            (before, b + Vector2::new(2.0 * HEAD, lift), TextAnchor::Start)
        };
        shapes.push(words(text_at, size, anchor, text.clone()));
        if let Some(letter) = datum.filter(|_| !upright) {
            shapes.extend(datum_at(start, letter, size));
        }
        self.put(&shapes);
        shapes
    }

    /// A level dimension line with an arrow at its first end alone, which goes on a little beyond the middle.
    fn half_size(
        &mut self,
        (from, to): (Vector2<f64>, Vector2<f64>),
        extension: SheetShape,
        text: &str,
        datum: Option<&'static str>,
    ) -> Vec<SheetShape> {
        let along = (to - from).normalize();
        let beyond_middle = 0.5 * (to - from).norm() + BEYOND_MIDDLE;
        let length = beyond_middle.max(font::width(text, TEXT) + 2.0 * HEAD);
        let text_at = from + along * (0.5 * (length + HEAD)) + Vector2::new(0.0, 0.35 * TEXT);
        let mut shapes = vec![
            extension,
            arrow(from, -along),
            SheetShape::Line(from, from + along * length),
            words(text_at, TEXT, TextAnchor::Middle, text),
        ];
        if let Some(letter) = datum {
            shapes.extend(datum_at(from, letter, TEXT));
        }
        self.put(&shapes);
        shapes
    }

    /// A dot on the profile and its name in a ring.
    fn flag(&mut self, at: Vector2<f64>, outward: Vector2<f64>, name: &str) -> Vec<SheetShape> {
        let size = TEXT;
        let radius = 0.5 * font::width(name, size) + 0.3 * size;
        let half = Vector2::repeat(radius);
        let Some((field, _)) =
            LEADERS.iter().find_map(|distance| self.field_out(at, outward, (*distance, half), &nearest_corner))
        else {
            return Vec::new();
        };
        let centre = 0.5 * (field.least + field.largest);
        let corner = |index: u32| {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(index) / f64::from(DOT_CORNERS));
            at + Vector2::new(cos, sin) * DOT
        };
        let mut shapes = vec![
            SheetShape::Area((0..DOT_CORNERS).map(corner).collect()),
            SheetShape::Entity(Entity::Circle(centre, radius)),
            words(centre - Vector2::new(0.0, 0.34 * size), size, TextAnchor::Middle, name),
        ];
        if let Some(along) = (centre - at).try_normalize(0.0) {
            shapes.push(SheetShape::Line(at, centre - along * radius));
        }
        self.put(&shapes);
        // No text lies on the dot.
        self.put(&[SheetShape::Entity(Entity::Circle(at, DOT))]);
        shapes
    }

    /// The strokes at both ends of a cutting line, with the arrows of sight and the letters.
    fn cutting_line(&mut self, ends: [Vector2<f64>; 2], sight: Vector2<f64>, letter: &str) -> Vec<ShapeGroup> {
        let [from, to] = ends;
        let Some(along) = (to - from).try_normalize(0.0) else { return Vec::new() };
        let (mut strokes, mut arrows) = (Vec::new(), Vec::new());
        for (end, outwards) in [(from, -along), (to, along)] {
            let end = end + outwards * CUT_OFF;
            strokes.push(SheetShape::Line(end, end + outwards * CUT_STROKE));
            let middle = end + outwards * (0.5 * CUT_STROKE);
            let tail = middle - sight * CUT_ARROW;
            arrows.push(SheetShape::Line(tail, middle));
            arrows.push(arrow(middle, sight));
            let half = 0.5 * font::CAPITAL * VIEW_NAME;
            let centre = tail - sight * (1.6 * half) + outwards * (2.0 * half);
            let base = centre - Vector2::new(0.0, half);
            arrows.push(words(base, VIEW_NAME, TextAnchor::Middle, letter));
        }
        self.put(&strokes);
        self.put(&arrows);
        let group =
            |class: &'static str, shapes| ShapeGroup { id: String::new(), ..ShapeGroup::new(class, class, shapes) };
        vec![group("cutting-line", strokes), group("dimension", arrows)]
    }

    /// The name of a view: above a tall one, at the left of a wide one.
    fn caption(&mut self, view: &Extents, text: &str) -> Vec<SheetShape> {
        let middle = 0.5 * (view.least + view.largest);
        let (at, anchor) = if view.size().x > view.size().y {
            let base = middle.y - 0.5 * font::CAPITAL * VIEW_NAME;
            (Vector2::new(view.least.x - CAPTION_BESIDE, base), TextAnchor::End)
        } else {
            (Vector2::new(middle.x, view.largest.y + CAPTION), TextAnchor::Middle)
        };
        let shapes = vec![words(at, VIEW_NAME, anchor, text)];
        self.put(&shapes);
        shapes
    }

    /// Leaves a text for later.
    fn defer(&mut self, class: &'static str, at: Vector2<f64>, towards: Vector2<f64>, text: &str) {
        self.texts.push(Mark::Label { class, at, towards, text: text.into() });
    }

    fn radius(&mut self, class: &'static str, centre: Vector2<f64>, to: Vector2<f64>, text: &str) -> Vec<SheetShape> {
        let along = (to - centre).normalize();
        let shapes = vec![SheetShape::Line(centre, to), triangle(to, along, HEAD)];
        self.put(&shapes);
        self.defer(class, centre + (to - centre) * 0.6, Vector2::new(-along.y, along.x), text);
        shapes
    }

    fn angle(
        &mut self,
        class: &'static str,
        corner: Vector2<f64>,
        sides: [Vector2<f64>; 2],
        radius: f64,
        text: &str,
    ) -> Vec<SheetShape> {
        let [from, to] = sides;
        let sweep = libm::atan2(from.perp(&to), from.dot(&to));
        let arc = SheetShape::Arc(corner + from * radius, corner + to * radius, libm::tan(0.25 * sweep));
        let shapes = vec![arc];
        self.put(&shapes);
        let half = libm::atan2(from.y, from.x) + 0.5 * sweep;
        let middle = Vector2::new(libm::cos(half), libm::sin(half));
        self.defer(class, corner + middle * radius, middle, text);
        shapes
    }

    /// A frame of cells, the first with the sign, where there is room for it.
    /// The frame with its size above, its datum below, and the arrow to its feature.
    fn tolerance(&mut self, frame: &FeatureFrame) -> Vec<SheetShape> {
        let size = TEXT;
        let (high, inset) = (CELL * size, 0.5 * size);
        let wide = |cell: &String| (font::width(cell, size) + 2.0 * inset).max(high);
        let widths: Vec<f64> = std::iter::once(high).chain(frame.cells.iter().map(wide)).collect();
        // A size without a frame stands on a line.
        let Some(sign) = frame.sign else { return self.size_on_line(frame) };
        let framed: f64 = widths.iter().sum();
        let word = if frame.behind.is_empty() { 0.0 } else { font::width(&frame.behind, size) + inset };
        let above = if frame.above.is_empty() { 0.0 } else { ABOVE_FRAME * size };
        let below = if frame.datum.is_some() { DATUM_STEM + high } else { 0.0 };
        let width = (framed + word).max(font::width(&frame.above, size));
        let half = 0.5 * Vector2::new(width, high + above + below);
        let is_overhanging = width > framed + word;
        // An arrow starts at a side of the frame if a datum hangs below it.
        let start = |field: &Extents, at: Vector2<f64>| {
            if frame.datum.is_none() {
                return nearest_corner(field, at);
            }
            let right = field.least.x + framed + word;
            let middle = field.least.y + below + 0.5 * high;
            if at.y > field.largest.y {
                Vector2::new(at.x.clamp(field.least.x, right), field.largest.y)
            } else if at.x < 0.5 * (field.least.x + right) {
                Vector2::new(field.least.x, middle)
            } else if is_overhanging {
                // At the end of the line on which the text stands.
                Vector2::new(field.largest.x, middle + 0.5 * high)
            } else {
                Vector2::new(right, middle)
            }
        };
        let Some((field, arrow)) = self.pointing(&frame.places, half, start) else { return Vec::new() };
        let low = field.least + Vector2::new(0.0, below);
        let base = low.y + 0.5 * (high - size) + 0.15 * size;
        let right = low.x + framed;
        let level = |y: f64| SheetShape::Line(Vector2::new(low.x, y), Vector2::new(right, y));
        let mut shapes = vec![level(low.y), level(low.y + high)];
        shapes.extend(tolerance_sign(sign, low, high));
        let mut x = low.x;
        shapes.push(SheetShape::Line(Vector2::new(x, low.y), Vector2::new(x, low.y + high)));
        for (width, text) in widths.iter().zip(std::iter::once("").chain(frame.cells.iter().map(String::as_str))) {
            if !text.is_empty() {
                shapes.push(words(Vector2::new(x + 0.5 * width, base), size, TextAnchor::Middle, text));
            }
            x += width;
            shapes.push(SheetShape::Line(Vector2::new(x, low.y), Vector2::new(x, low.y + high)));
        }
        if !frame.behind.is_empty() {
            shapes.push(words(Vector2::new(right + inset, base), size, TextAnchor::Start, frame.behind.clone()));
        }
        if is_overhanging {
            let top = Vector2::new(right, low.y + high);
            shapes.push(SheetShape::Line(top, Vector2::new(field.largest.x, top.y)));
        }
        if !frame.above.is_empty() {
            let at = Vector2::new(low.x, low.y + high + 0.45 * size);
            shapes.push(words(at, size, TextAnchor::Start, frame.above.clone()));
        }
        if let Some(letter) = frame.datum {
            shapes.extend(datum_below(Vector2::new(low.x + 0.5 * framed, low.y), letter));
        }
        if let ([SheetShape::Line(_, knee), _], ToleranceSign::ProfileAllAround) = (&arrow, sign) {
            // The ring at the frame: all around (ISO 1101).
            shapes.push(SheetShape::Entity(Entity::Circle(*knee, 0.3 * size)));
        }
        shapes.extend(arrow);
        self.put(&shapes);
        shapes
    }

    /// A size on a line, with its datum below, and the arrow to its feature.
    fn size_on_line(&mut self, frame: &FeatureFrame) -> Vec<SheetShape> {
        let below = if frame.datum.is_some() { DATUM_STEM + CELL * TEXT } else { 0.0 };
        let width = font::width(&frame.above, TEXT);
        let half = 0.5 * Vector2::new(width, ABOVE_FRAME * TEXT + below);
        let start = |field: &Extents, at: Vector2<f64>| {
            let x = if at.x < 0.5 * (field.least.x + field.largest.x) { field.least.x } else { field.largest.x };
            Vector2::new(x, field.least.y + below)
        };
        let Some((field, arrow)) = self.pointing(&frame.places, half, start) else { return Vec::new() };
        let line = field.least + Vector2::new(0.0, below);
        let mut shapes = vec![
            SheetShape::Line(line, line + Vector2::new(width, 0.0)),
            words(line + Vector2::new(0.0, 0.45 * TEXT), TEXT, TextAnchor::Start, frame.above.clone()),
        ];
        if let Some(letter) = frame.datum {
            shapes.extend(datum_below(line + Vector2::new(0.5 * width, 0.0), letter));
        }
        shapes.extend(arrow);
        self.put(&shapes);
        shapes
    }

    /// A free field of these half sides out of one of some places, each with the direction outwards, and the arrow from it to that place.
    fn pointing(
        &self,
        places: &[(Vector2<f64>, Vector2<f64>)],
        half: Vector2<f64>,
        start: impl Fn(&Extents, Vector2<f64>) -> Vector2<f64>,
    ) -> Option<(Extents, [SheetShape; 2])> {
        let found = LEADERS.iter().find_map(|distance| {
            places.iter().find_map(|(at, towards)| {
                let (field, end) = self.field_out(*at, *towards, (*distance, half), &start)?;
                Some((*at, field, end))
            })
        });
        let (at, field, end) = found?;
        let arrow = arrow(at, (at - end).normalize());
        Some((field, [SheetShape::Line(at, end), arrow]))
    }

    /// A free field of these half sides at a distance from a place, and the start of the leader at it.
    fn field_out(
        &self,
        at: Vector2<f64>,
        towards: Vector2<f64>,
        (distance, half): (f64, Vector2<f64>),
        start: &impl Fn(&Extents, Vector2<f64>) -> Vector2<f64>,
    ) -> Option<(Extents, Vector2<f64>)> {
        TURNS.iter().find_map(|degrees| {
            let (sin, cos) = libm::sincos(f64::to_radians(*degrees));
            let along = Vector2::new(towards.x * cos - towards.y * sin, towards.x * sin + towards.y * cos);
            let field = field_near(at, along, distance, half);
            let end = start(&field, at);
            let near = at + (end - at) * LEADER_START;
            (self.taken.free(&field) && self.taken.clear(near, end)).then_some((field, end))
        })
    }

    /// The sign of a roughness on a line, where there is room for it; its sizes over the lettering are those of ISO 21920-1, annex A.
    fn roughness(&mut self, places: &[(Vector2<f64>, Vector2<f64>)], text: &str) -> Vec<SheetShape> {
        let size = TEXT;
        let (short, long) = (1.4 * size, 3.0 * size);
        // The legs lean by 30° from upright.
        let lean = libm::tan(std::f64::consts::FRAC_PI_6);
        let after = (short + long) * lean;
        let width = after + font::width(text, size) + 0.6 * size;
        let Some((field, arrow)) = self.pointing(places, 0.5 * Vector2::new(width, long), nearest_corner) else {
            return Vec::new();
        };
        let at = |x: f64, y: f64| field.least + Vector2::new(x, y);
        let foot = short * lean;
        let mut shapes = vec![
            SheetShape::Path(vec![at(0.0, short), at(foot, 0.0), at(after, long), at(width, long)]),
            SheetShape::Line(at(0.0, short), at(2.0 * foot, short)),
            SheetShape::Line(at(0.0, 0.0), at(width, 0.0)),
            words(at(after + 0.3 * size, long - 1.5 * size), size, TextAnchor::Start, text),
        ];
        shapes.extend(arrow);
        self.put(&shapes);
        shapes
    }

    /// A tick across the profile, and an arrow beside it.
    fn start(&mut self, at: Vector2<f64>, along: Vector2<f64>, outward: Vector2<f64>, text: &str) -> Vec<SheetShape> {
        let beside = at + outward * 1.5;
        let end = beside + along * (2.0 * HEAD);
        let shapes = vec![
            SheetShape::Line(at - outward * 1.5, at + outward * 2.5),
            SheetShape::Line(beside, end),
            triangle(end, along, HEAD),
        ];
        self.put(&shapes);
        self.defer("dimension", at + outward * 2.5, outward, text);
        shapes
    }

    fn datum(&mut self, at: Vector2<f64>, towards: Vector2<f64>, letter: &str) -> Vec<SheetShape> {
        let size = TEXT;
        let half = Vector2::repeat(0.5 * CELL * size);
        let Some((field, leader)) = place(self.taken, 1.0, at, towards, (half, 0.0)) else { return Vec::new() };
        let mut shapes = rectangle(&field);
        let base = Vector2::new(0.5 * (field.least.x + field.largest.x), field.least.y + half.y - 0.35 * size);
        shapes.push(words(base, size, TextAnchor::Middle, letter));
        if let Some(SheetShape::Line(from, to)) = leader {
            // The base of the triangle lies on what is the datum.
            let along = (to - from).normalize();
            let (tip, side) = (from + along * HEAD, Vector2::new(-along.y, along.x) * (0.5 * HEAD));
            shapes.push(SheetShape::Triangle([tip, from + side, from - side]));
            shapes.push(SheetShape::Line(tip, to));
        }
        self.put(&shapes);
        shapes
    }

    /// The first arrow on free paper; if there is none, the first within the view; if there is none, the first.
    fn turning(&mut self, class: &'static str, arcs: &[TurningArc], text: &str) -> Vec<SheetShape> {
        let is_free = |arc: &&TurningArc| self.taken.free(&arc.extents());
        let is_within = |arc: &&TurningArc| self.taken.contains(&arc.extents());
        let found = arcs.iter().find(is_free).or_else(|| arcs.iter().find(is_within)).or_else(|| arcs.first());
        let Some(arc) = found.copied() else { return Vec::new() };
        let shapes = arc.arrow();
        self.put(&shapes);
        let middle = arc.from_deg + 0.5 * arc.sweep_deg;
        self.defer(class, polar_point(middle, arc.radius), polar_point(middle, 1.0), text);
        shapes
    }
}

/// The point at a polar angle, degrees, and a radius.
fn polar_point(degrees: f64, radius: f64) -> Vector2<f64> {
    let (sin, cos) = libm::sincos(degrees.to_radians());
    Vector2::new(radius * cos, radius * sin)
}

impl TurningArc {
    /// The arc with a head at its end.
    fn arrow(&self) -> Vec<SheetShape> {
        let (radius, end) = (self.radius, self.from_deg + self.sweep_deg);
        let ahead = libm::copysign((HEAD / radius).to_degrees(), self.sweep_deg);
        let half = 0.5 * SLENDER * HEAD;
        vec![
            SheetShape::Arc(
                polar_point(self.from_deg, radius),
                polar_point(end, radius),
                libm::tan(0.25 * self.sweep_deg.to_radians()),
            ),
            SheetShape::Triangle([
                polar_point(end, radius - half),
                polar_point(end, radius + half),
                polar_point(end + ahead, radius),
            ]),
        ]
    }

    /// The field that the arrow covers.
    fn extents(&self) -> Extents {
        let start = polar_point(self.from_deg, self.radius);
        let fields = self.arrow().into_iter().filter_map(|shape| shape.extents());
        fields.fold(Extents { least: start, largest: start }, |all, field| all.with(&field))
    }
}

//! Labels, dimensions and arrows at the size of the lettering.

use super::placing::{Taken, beside, filling, half_field};
use super::{Group, Mark, Shape, TextAnchor, font, words};
use crate::geometry::contour::Extents;
use nalgebra::Vector2;

/// Over the lettering of an A4, mm: texts, arrow heads, the distance of a dimension line from what it measures and from the next.
const TEXT: f64 = 3.0;
const HEAD: f64 = 2.8;
const APART: f64 = 7.0;
/// Width of a head over its length.
const SLENDER: f64 = 0.3;
/// How far from its place a text may stand, in the same measure, the nearest first.
const DISTANCES: [f64; 12] = [2.0, 3.5, 5.5, 8.0, 11.0, 15.0, 20.0, 27.0, 36.0, 50.0, 70.0, 100.0];
/// Directions that are tried, to either side of the wanted one.
const DIRECTIONS: u32 = 24;
/// A text farther than this is tied to its place with a line.
const TIED: f64 = 3.0;

/// The pen with which marks are drawn.
pub(super) struct Marker<'a> {
    /// Size of the lettering over that of an A4.
    pub(super) lettering: f64,
    /// What stands already.
    pub(super) taken: &'a mut Taken,
    /// What the view covers, mm of paper.
    pub(super) covered: Extents,
    /// Dimension lines so far on each side.
    pub(super) lines: [f64; 2],
}

fn triangle(tip: Vector2<f64>, along: Vector2<f64>, length: f64) -> Shape {
    let (back, side) = (tip - along * length, Vector2::new(-along.y, along.x) * (0.5 * SLENDER * length));
    Shape::Triangle([tip, back + side, back - side])
}

/// A text where there is room for it, with its leader.
pub(in crate::report) fn label(
    taken: &mut Taken,
    lettering: f64,
    at: Vector2<f64>,
    towards: Vector2<f64>,
    text: &str,
) -> Vec<Shape> {
    let size = TEXT * lettering;
    let half = half_field(text, size);
    let wanted = libm::atan2(towards.y, towards.x);
    for distance in DISTANCES {
        for index in 0..DIRECTIONS {
            // 0, +1, −1, +2, −2, …
            let step = f64::from(index.div_ceil(2)) * if index % 2 == 0 { -1.0 } else { 1.0 };
            let angle = wanted + step * std::f64::consts::TAU / f64::from(DIRECTIONS);
            let along = Vector2::new(libm::cos(angle), libm::sin(angle));
            let field = beside(at, along, distance * lettering, half);
            let nearest = at.sup(&field.least).inf(&field.largest);
            let apart = (nearest - at).norm();
            if apart > distance * lettering * 1.01 + 1e-9 || !taken.free(&field) {
                continue;
            }
            let tied = apart > TIED * lettering;
            let towards = (at - nearest) / apart.max(1e-9);
            let leader = Shape::Line(at, nearest + towards * (0.4 * lettering));
            if tied && !taken.clear(at, nearest) {
                continue;
            }
            let mut shapes = vec![filling(&field, size, text)];
            if tied {
                shapes.push(leader);
            }
            for shape in &shapes {
                taken.put(shape);
            }
            return shapes;
        }
    }
    Vec::new()
}

impl Marker<'_> {
    /// The groups of a mark whose places are millimetres of paper.
    pub(super) fn groups(&mut self, mark: &Mark) -> Vec<Group> {
        let (class, shapes) = match mark {
            Mark::Label { class, at, towards, text } => (*class, self.label(*at, *towards, text)),
            Mark::Distance { from, to, away, text } => ("dimension", self.distance(*from, *to, *away, text)),
            Mark::Radius { centre, to, text } => ("dimension", self.radius(*centre, *to, text)),
            Mark::Angle { class, corner, from, to, radius, text } => {
                (*class, self.angle(*corner, [*from, *to], *radius, text))
            }
            Mark::Turning { class, radius, from_deg, sweep_deg, text } => {
                (*class, self.turning(*radius, *from_deg, *sweep_deg, text))
            }
        };
        vec![Group { id: String::new(), class, label: class.into(), colour: None, shapes, in_legend: false }]
    }

    fn put(&mut self, shapes: &[Shape]) {
        for shape in shapes {
            self.taken.put(shape);
        }
    }

    fn label(&mut self, at: Vector2<f64>, towards: Vector2<f64>, text: &str) -> Vec<Shape> {
        label(self.taken, self.lettering, at, towards, text)
    }

    /// A dimension line outside of the view, with its extension lines.
    fn distance(&mut self, from: Vector2<f64>, to: Vector2<f64>, away: Vector2<f64>, text: &str) -> Vec<Shape> {
        let (k, size) = (self.lettering, TEXT * self.lettering);
        let upright = away.x != 0.0;
        let number = self.lines.get_mut(usize::from(upright));
        let line = number.map_or(0.0, |number| {
            *number += 1.0;
            *number
        });
        let covered = if away.x + away.y < 0.0 { self.covered.least } else { self.covered.largest };
        let moved = |point: Vector2<f64>| {
            let place = covered + away * (APART * k * line);
            if upright { Vector2::new(place.x, point.y) } else { Vector2::new(point.x, place.y) }
        };
        let (a, b) = (moved(from), moved(to));
        let (length, along) = ((b - a).norm(), (b - a).normalize());
        let mut shapes: Vec<Shape> = [(from, a), (to, b)]
            .into_iter()
            .map(|(point, end)| Shape::Line(point + away * (1.0 * k), end + away * (1.5 * k)))
            .collect();
        let inside = length > 3.0 * HEAD * k;
        let head = if inside { along } else { -along };
        shapes.push(triangle(a, -head, HEAD * k));
        shapes.push(triangle(b, head, HEAD * k));
        let (half, middle) = (0.5 * font::width(text, size), 0.5 * (a + b));
        if upright {
            // The text stands in a gap of the line.
            let gap = along * (0.75 * size);
            shapes.push(Shape::Line(a, middle - gap));
            shapes.push(Shape::Line(middle + gap, b));
            shapes.push(words(middle - Vector2::new(0.0, 0.35 * size), size, TextAnchor::Middle, text));
        } else if 2.0 * (half + HEAD * k) < length {
            let gap = along * (half + 0.5 * size);
            shapes.push(Shape::Line(a, middle - gap));
            shapes.push(Shape::Line(middle + gap, b));
            shapes.push(words(middle - Vector2::new(0.0, 0.35 * size), size, TextAnchor::Middle, text));
        } else {
            shapes.push(Shape::Line(a, b));
            let beside = a.sup(&b) + Vector2::new(1.5 * HEAD * k, -0.35 * size);
            shapes.push(words(beside, size, TextAnchor::Start, text));
        }
        self.put(&shapes);
        shapes
    }

    fn radius(&mut self, centre: Vector2<f64>, to: Vector2<f64>, text: &str) -> Vec<Shape> {
        let along = (to - centre).normalize();
        let mut shapes = vec![Shape::Line(centre, to), triangle(to, along, HEAD * self.lettering)];
        self.put(&shapes);
        shapes.extend(self.label(centre + (to - centre) * 0.6, Vector2::new(-along.y, along.x), text));
        shapes
    }

    fn angle(&mut self, corner: Vector2<f64>, sides: [Vector2<f64>; 2], radius: f64, text: &str) -> Vec<Shape> {
        let [from, to] = sides;
        let sweep = libm::atan2(from.perp(&to), from.dot(&to));
        let arc = Shape::Arc(corner + from * radius, corner + to * radius, libm::tan(0.25 * sweep));
        let mut shapes = vec![arc];
        self.put(&shapes);
        let half = libm::atan2(from.y, from.x) + 0.5 * sweep;
        let middle = Vector2::new(libm::cos(half), libm::sin(half));
        shapes.extend(self.label(corner + middle * radius, middle, text));
        shapes
    }

    fn turning(&mut self, radius: f64, from_deg: f64, sweep_deg: f64, text: &str) -> Vec<Shape> {
        let on = |degrees: f64, radius: f64| {
            let angle = degrees.to_radians();
            Vector2::new(radius * libm::cos(angle), radius * libm::sin(angle))
        };
        let sense = libm::copysign(1.0, sweep_deg);
        let end = from_deg + sweep_deg;
        let (head, half) = (HEAD * self.lettering, 0.5 * SLENDER * HEAD * self.lettering);
        let ahead = sense * (head / radius).to_degrees();
        let mut shapes = vec![
            Shape::Arc(on(from_deg, radius), on(end, radius), libm::tan(0.25 * sweep_deg.to_radians())),
            Shape::Triangle([on(end, radius - half), on(end, radius + half), on(end + ahead, radius)]),
        ];
        self.put(&shapes);
        let middle = from_deg + 0.5 * sweep_deg;
        shapes.extend(self.label(on(middle, radius), on(middle, 1.0), text));
        shapes
    }
}

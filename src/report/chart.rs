//! A log-log chart, e.g. of computing time against residual force.

use super::sheet::{Group, Pen, STROKE_OVER_TEXT, Shape, Sheet, TextAnchor};
use crate::geometry::Entity;
use crate::geometry::contour::{Contour, Extents};
use nalgebra::Vector2;

/// Size of the field, mm.
const FIELD: Vector2<f64> = Vector2::new(180.0, 110.0);
/// From one panel to the next, mm.
const PITCH: f64 = 135.0;
/// Height of the text, mm.
const TEXT: f64 = 3.0;
/// Width of a letter over its height, on the safe side.
const LETTER: f64 = 0.65;
/// Radius of a point, mm.
const POINT: f64 = 1.2;

/// A point of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Across, above 0.
    pub x: f64,
    /// Up, above 0.
    pub y: f64,
    /// The text beside it.
    pub label: String,
    /// On the Pareto front: no other point is lower without lying further right.
    pub best: bool,
}

/// Marks the points of the Pareto front: no other one is better in both directions.
pub fn mark_front(points: &mut [Point]) {
    let all: Vec<(f64, f64)> = points.iter().map(|p| (p.x, p.y)).collect();
    for point in points {
        let beaten = |&(x, y): &(f64, f64)| x <= point.x && y <= point.y && (x < point.x || y < point.y);
        point.best = !all.iter().any(beaten);
    }
}

/// Decades that hold all values.
fn decades(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let (low, high) = (libm::log10(low).floor(), libm::log10(high).ceil());
    if high > low { (low, high) } else { (low, low + 1.0) }
}

/// Values against the same quantity across.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// What is shown upwards, with its unit.
    pub y_name: &'static str,
    /// The points.
    pub points: Vec<Point>,
}

/// The chart, a panel below the other; points that are not above 0 cannot be shown and are left out.
#[must_use]
pub fn chart(title: &str, x_name: &str, panels: &[Panel]) -> Sheet {
    let pen = Pen { text: TEXT };
    let fits = |p: &&Point| p.x > 0.0 && p.y > 0.0 && (p.x * p.y).is_finite();
    let x = decades(panels.iter().flat_map(|panel| &panel.points).filter(fits).map(|p| p.x));
    let mut groups = Vec::new();
    let mut bottom = 0.0;
    for (number, panel) in (1_u32..).zip(panels) {
        bottom = -f64::from(number - 1) * PITCH;
        let shown: Vec<&Point> = panel.points.iter().filter(fits).collect();
        let y = decades(shown.iter().map(|p| p.y));
        let share = |value: f64, (low, high): (f64, f64)| (libm::log10(value) - low) / (high - low);
        let at = |p: &Point| Vector2::new(FIELD.x * share(p.x, x), bottom + FIELD.y * share(p.y, y));
        let dot = |p: &Point| Shape::Entity(Entity::Polyline(Contour::circle(at(p), POINT)));
        let mut best: Vec<&Point> = shown.iter().copied().filter(|p| p.best).collect();
        best.sort_by(|a, b| a.x.total_cmp(&b.x).then(b.y.total_cmp(&a.y)));
        let mut front: Vec<Shape> = best.iter().map(|p| dot(p)).collect();
        front.push(Shape::Path(best.iter().map(|p| at(p)).collect()));
        let others = shown.iter().filter(|p| !p.best).map(|p| dot(p)).collect();
        let words = vec![
            pen.middle(Vector2::new(0.5 * FIELD.x, bottom - 3.5 * TEXT), x_name),
            pen.words(-6.0 * TEXT, bottom + FIELD.y + 0.9 * TEXT, panel.y_name),
        ];
        let group = |id: &'static str, label: &str, shapes| {
            let group = Group::new(id, label, shapes);
            // A name stands once in a file.
            if number == 1 { group } else { Group { id: format!("{id}-{number}"), ..group } }
        };
        groups.extend([
            group("axis", "grid", grid(&pen, x, y, bottom)),
            group("other", "other settings", others),
            group("roller", "Pareto front", front),
            group("labels", "labels", labels(&shown, at)),
            group("facts", "names", words),
        ]);
    }
    groups.push(Group::new("title", "title", vec![pen.words(-6.0 * TEXT, FIELD.y + 3.0 * TEXT, title)]));
    Sheet {
        title: title.into(),
        extents: Extents {
            least: Vector2::new(-7.0 * TEXT, bottom - 5.0 * TEXT),
            largest: FIELD + Vector2::new(3.0 * TEXT, 6.0 * TEXT),
        },
        stroke: STROKE_OVER_TEXT * TEXT,
        groups,
    }
}

/// The lines of the decades with their names.
fn grid(pen: &Pen, x: (f64, f64), y: (f64, f64), bottom: f64) -> Vec<Shape> {
    let mut grid = Vec::new();
    for (range, along) in [(x, true), (y, false)] {
        let mut decade = range.0;
        while decade <= range.1 {
            let place = (decade - range.0) / (range.1 - range.0);
            let name = format!("{:e}", libm::pow(10.0, decade));
            if along {
                let across = FIELD.x * place;
                grid.push(Shape::Line(Vector2::new(across, bottom), Vector2::new(across, bottom + FIELD.y)));
                grid.push(pen.middle(Vector2::new(across, bottom - 1.5 * TEXT), name));
            } else {
                let up = bottom + FIELD.y * place;
                grid.push(Shape::Line(Vector2::new(0.0, up), Vector2::new(FIELD.x, up)));
                let place = Vector2::new(-0.5 * TEXT, up - 0.35 * TEXT);
                grid.push(Shape::Text { at: place, height: TEXT, anchor: TextAnchor::End, text: name });
            }
            decade += 1.0;
        }
    }
    grid
}

/// The names of the points: to the right where there is room, else to the left; where neither is free a point has none.
fn labels(shown: &[&Point], at: impl Fn(&Point) -> Vector2<f64>) -> Vec<Shape> {
    let height = 0.8 * TEXT;
    let mut taken: Vec<(Vector2<f64>, Vector2<f64>)> = Vec::new();
    let mut labels = Vec::new();
    // Those of the front first.
    let named = shown.iter().filter(|p| p.best).chain(shown.iter().filter(|p| !p.best));
    for p in named {
        #[expect(clippy::cast_precision_loss, reason = "a few words")]
        let width = LETTER * height * p.label.chars().count() as f64;
        let place = |step: f64| at(p) + Vector2::new(step * 1.8 * POINT, 0.3 * TEXT);
        let free = |step: f64| {
            let start = place(step).x + if step < 0.0 { -width } else { 0.0 };
            let field = (Vector2::new(start, place(step).y), Vector2::new(start + width, place(step).y + height));
            let inside = start >= 0.0 && start + width <= FIELD.x;
            let apart = |(low, high): &(Vector2<f64>, Vector2<f64>)| {
                field.1.x <= low.x || field.0.x >= high.x || field.1.y <= low.y || field.0.y >= high.y
            };
            (inside && taken.iter().all(apart)).then_some((step, field))
        };
        let Some((step, field)) = free(1.0).or_else(|| free(-1.0)) else { continue };
        taken.push(field);
        let anchor = if step < 0.0 { TextAnchor::End } else { TextAnchor::Start };
        labels.push(Shape::Text { at: place(step), height, anchor, text: p.label.clone() });
    }
    labels
}

//! A log-log chart, e.g. of computing time against residual force.

use super::sheet::{Group, Pen, STROKE_OVER_TEXT, Shape, Sheet, TextAnchor};
use crate::geometry::Entity;
use crate::geometry::contour::{Contour, Extents};
use nalgebra::Vector2;

/// Size of the field, mm.
const FIELD: Vector2<f64> = Vector2::new(180.0, 110.0);
/// Height of the text, mm.
const TEXT: f64 = 3.0;
/// Width of a label, mm.
const LABEL: f64 = 25.0;
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

/// The chart; points that are not above 0 cannot be shown and are left out.
#[must_use]
pub fn chart(title: &str, x_name: &str, y_name: &str, points: &[Point]) -> Sheet {
    let shown: Vec<&Point> = points.iter().filter(|p| p.x > 0.0 && p.y > 0.0 && (p.x * p.y).is_finite()).collect();
    let (x, y) = (decades(shown.iter().map(|p| p.x)), decades(shown.iter().map(|p| p.y)));
    let share = |value: f64, (low, high): (f64, f64)| (libm::log10(value) - low) / (high - low);
    let at = |p: &Point| Vector2::new(FIELD.x * share(p.x, x), FIELD.y * share(p.y, y));
    let pen = Pen { text: TEXT };
    let grid = grid(&pen, x, y);
    let dot = |p: &Point| Shape::Entity(Entity::Polyline(Contour::circle(at(p), POINT)));
    let mut best: Vec<&Point> = shown.iter().copied().filter(|p| p.best).collect();
    best.sort_by(|a, b| a.x.total_cmp(&b.x).then(b.y.total_cmp(&a.y)));
    let mut front: Vec<Shape> = best.iter().map(|p| dot(p)).collect();
    front.push(Shape::Path(best.iter().map(|p| at(p)).collect()));
    let others = shown.iter().filter(|p| !p.best).map(|p| dot(p)).collect();
    let labels = labels(&shown, at);
    let words = vec![
        pen.words(0.0, FIELD.y + 2.0 * TEXT, title),
        pen.middle(Vector2::new(0.5 * FIELD.x, -3.5 * TEXT), x_name),
        pen.words(-6.0 * TEXT, FIELD.y + 0.6 * TEXT, y_name),
    ];
    Sheet {
        title: title.into(),
        extents: Extents {
            least: Vector2::new(-7.0 * TEXT, -5.0 * TEXT),
            largest: FIELD + Vector2::new(3.0 * TEXT, 5.0 * TEXT),
        },
        stroke: STROKE_OVER_TEXT * TEXT,
        groups: vec![
            Group::new("axis", "grid", grid),
            Group::new("other", "other settings", others),
            Group::new("roller", "Pareto front", front),
            Group::new("labels", "labels", labels),
            Group::new("facts", "names", words),
        ],
    }
}

/// The lines of the decades with their names.
fn grid(pen: &Pen, x: (f64, f64), y: (f64, f64)) -> Vec<Shape> {
    let mut grid = Vec::new();
    for (range, along) in [(x, true), (y, false)] {
        let mut decade = range.0;
        while decade <= range.1 {
            let place = (decade - range.0) / (range.1 - range.0);
            let name = format!("{:e}", libm::pow(10.0, decade));
            if along {
                let across = FIELD.x * place;
                grid.push(Shape::Line(Vector2::new(across, 0.0), Vector2::new(across, FIELD.y)));
                grid.push(pen.middle(Vector2::new(across, -1.5 * TEXT), name));
            } else {
                let up = FIELD.y * place;
                grid.push(Shape::Line(Vector2::new(0.0, up), Vector2::new(FIELD.x, up)));
                let place = Vector2::new(-0.5 * TEXT, up - 0.35 * TEXT);
                grid.push(Shape::Text { at: place, height: TEXT, anchor: TextAnchor::End, text: name });
            }
            decade += 1.0;
        }
    }
    grid
}

/// The names of the points.
fn labels(shown: &[&Point], at: impl Fn(&Point) -> Vector2<f64>) -> Vec<Shape> {
    // Of points that lie on each other the first is named.
    let mut named: Vec<Vector2<f64>> = Vec::new();
    let mut labels = Vec::new();
    for p in shown {
        let near = |other: &Vector2<f64>| (other.y - at(p).y).abs() < TEXT && (other.x - at(p).x).abs() < LABEL;
        if named.iter().any(near) {
            continue;
        }
        named.push(at(p));
        let right = at(p).x < 0.7 * FIELD.x;
        let (step, anchor) = if right { (1.0, TextAnchor::Start) } else { (-1.0, TextAnchor::End) };
        let place = at(p) + Vector2::new(step * 1.8 * POINT, 0.3 * TEXT);
        labels.push(Shape::Text { at: place, height: 0.8 * TEXT, anchor, text: p.label.clone() });
    }
    labels
}

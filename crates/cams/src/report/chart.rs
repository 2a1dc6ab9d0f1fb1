//! A log-log chart on a sheet of paper, e.g. of computing time against residual force.

use super::page::{PAGE, PicturePage};
use super::sheet::placing::{OccupiedPaper, field_near, filling, half_field};
use super::sheet::{ShapeGroup, Sheet, SheetShape, TextAnchor, words};
use super::style::{NAME, SMALL as LABEL, TEXT};
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Radius of a point, mm.
const POINT: f64 = 1.0;
/// Room of a panel for the names of its lines: to the left, above, below, to the right, mm.
const LEFT: f64 = 16.0;
const ABOVE: f64 = 10.0;
const BELOW: f64 = 14.0;
const RIGHT: f64 = 4.0;
/// From a point to its label in points, and how many directions are tried.
const NEAR: [f64; 4] = [1.6, 3.0, 5.0, 8.0];
const DIRECTIONS: u32 = 16;

/// A point of a chart.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartPoint {
    /// Across, above 0.
    pub x: f64,
    /// Up, above 0.
    pub y: f64,
    /// The text next to it.
    pub label: String,
    /// On the Pareto front: no other point is lower without lying further right.
    pub best: bool,
}

/// Marks the points of the Pareto front: no other one is better in both directions.
pub fn mark_front(points: &mut [ChartPoint]) {
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
pub struct ChartPanel {
    /// What is shown upwards, with its unit.
    pub y_name: &'static str,
    /// The points.
    pub points: Vec<ChartPoint>,
}

/// Panels one below the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// The answer with its figure.
    pub title: String,
    /// What is compared, and for what.
    pub subtitle: String,
    /// What is shown across in every panel, with its unit.
    pub x_name: &'static str,
    /// The panels.
    pub panels: Vec<ChartPanel>,
}

/// The chart on a sheet; points that are not above 0 cannot be shown and are left out.
#[must_use]
pub fn sheet(Chart { title, subtitle, x_name, panels }: &Chart, mark: &str) -> Sheet {
    let mut page = PicturePage::new(PAGE, title, subtitle, mark);
    let body = page.body;
    let mut top = body.largest.y;
    let fits = |p: &&ChartPoint| p.x > 0.0 && p.y > 0.0 && (p.x * p.y).is_finite();
    let x = decades(panels.iter().flat_map(|panel| &panel.points).filter(fits).map(|p| p.x));
    #[expect(clippy::cast_precision_loss, reason = "a few panels")]
    let each = (top - body.least.y) / panels.len().max(1) as f64;
    for (index, panel) in panels.iter().enumerate() {
        let field = Extents {
            least: Vector2::new(body.least.x + LEFT, top - each + BELOW),
            largest: Vector2::new(body.largest.x - RIGHT, top - ABOVE),
        };
        let shown: Vec<&ChartPoint> = panel.points.iter().filter(fits).collect();
        // A name occurs once in a file.
        let named = |group: ShapeGroup| ShapeGroup { id: format!("{}-{index}", group.id), ..group };
        page.extend(panel_groups(panel.y_name, x_name, &shown, x, &field).into_iter().map(named));
        top -= each;
    }
    page.sheet()
}

/// One panel in its field.
fn panel_groups(y_name: &str, x_name: &str, shown: &[&ChartPoint], x: (f64, f64), field: &Extents) -> Vec<ShapeGroup> {
    let y = decades(shown.iter().map(|p| p.y));
    let share = |value: f64, (low, high): (f64, f64)| (libm::log10(value) - low) / (high - low);
    let at = |p: &ChartPoint| field.least + field.size().component_mul(&Vector2::new(share(p.x, x), share(p.y, y)));
    let dot = |p: &ChartPoint| SheetShape::Entity(Entity::Circle(at(p), POINT));
    let mut best: Vec<&ChartPoint> = shown.iter().copied().filter(|p| p.best).collect();
    best.sort_by(|a, b| a.x.total_cmp(&b.x).then(b.y.total_cmp(&a.y)));
    let mut front = between_rings(&best.iter().map(|p| at(p)).collect::<Vec<_>>());
    front.extend(best.iter().map(|p| dot(p)));
    let others: Vec<SheetShape> = shown.iter().filter(|p| !p.best).map(|p| dot(p)).collect();
    let grid = grid(x, y, field);
    let mut taken = OccupiedPaper::none(*field);
    for shape in grid.iter().chain(&front).chain(&others) {
        taken.put(shape);
    }
    let labels = labels(shown, at, &mut taken);
    let names = vec![
        words(Vector2::new(field.largest.x, field.least.y - 3.0 * TEXT), NAME, TextAnchor::End, x_name),
        words(Vector2::new(field.least.x - LEFT, field.largest.y + 0.8 * TEXT), NAME, TextAnchor::Start, y_name),
    ];
    vec![
        ShapeGroup { class: "tick", ..ShapeGroup::new("grid", "grid", grid) },
        ShapeGroup { class: "other", ..ShapeGroup::new("other", "other settings", others) },
        ShapeGroup { class: "front", ..ShapeGroup::new("front", "Pareto front", front) },
        ShapeGroup { class: "facts", ..ShapeGroup::new("labels", "labels", labels) },
        ShapeGroup { class: "strong", ..ShapeGroup::new("names", "names", names) },
    ]
}

/// The lines from each ring to the next, from rim to rim.
fn between_rings(centres: &[Vector2<f64>]) -> Vec<SheetShape> {
    let apart = |a: &Vector2<f64>, b: &Vector2<f64>| {
        let step = b - a;
        let along = step / step.norm().max(1e-9) * POINT;
        (step.norm() > 2.0 * POINT).then(|| SheetShape::Line(a + along, b - along))
    };
    centres.iter().zip(centres.iter().skip(1)).filter_map(|(a, b)| apart(a, b)).collect()
}

/// A power of ten as it is read: 0.01, 100, 10⁵.
fn power_of_ten(exponent: f64) -> String {
    if (-3.0..=4.0).contains(&exponent) {
        return libm::pow(10.0, exponent).to_string();
    }
    let raised = |letter: char| match letter {
        '-' => '⁻',
        digit => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit as usize - '0' as usize).unwrap_or(digit),
    };
    format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
}

/// The lines of the decades with their names.
fn grid(x: (f64, f64), y: (f64, f64), field: &Extents) -> Vec<SheetShape> {
    let mut grid = Vec::new();
    for (range, along) in [(x, true), (y, false)] {
        let mut decade = range.0;
        while decade <= range.1 {
            let place = field.least + field.size() * ((decade - range.0) / (range.1 - range.0));
            let name = power_of_ten(decade);
            if along {
                let (low, high) = (field.least.y, field.largest.y);
                grid.push(SheetShape::Line(Vector2::new(place.x, low), Vector2::new(place.x, high)));
                grid.push(words(Vector2::new(place.x, low - 1.4 * TEXT), TEXT, TextAnchor::Middle, name));
            } else {
                let (left, right) = (field.least.x, field.largest.x);
                grid.push(SheetShape::Line(Vector2::new(left, place.y), Vector2::new(right, place.y)));
                let name_at = Vector2::new(left - 0.5 * TEXT, place.y - 0.35 * TEXT);
                grid.push(words(name_at, TEXT, TextAnchor::End, name));
            }
            decade += 1.0;
        }
    }
    grid
}

/// The names of the points, those of the front first, next to the point where there is room; without room a point has no name.
fn labels(
    shown: &[&ChartPoint],
    at: impl Fn(&ChartPoint) -> Vector2<f64>,
    taken: &mut OccupiedPaper,
) -> Vec<SheetShape> {
    let mut labels = Vec::new();
    let named = shown.iter().filter(|p| p.best).chain(shown.iter().filter(|p| !p.best));
    for p in named {
        let half = half_field(&p.label, LABEL);
        let places = NEAR.iter().flat_map(|near| (0..DIRECTIONS).map(move |direction| (near * POINT, direction)));
        let free = places.into_iter().find_map(|(distance, direction)| {
            let angle = f64::from(direction) * std::f64::consts::TAU / f64::from(DIRECTIONS);
            let along = Vector2::new(libm::cos(angle), libm::sin(angle));
            let field = field_near(at(p), along, distance, half);
            taken.free(&field).then_some(field)
        });
        let Some(field) = free else { continue };
        let label = filling(&field, LABEL, &p.label);
        taken.put(&label);
        labels.push(label);
    }
    labels
}

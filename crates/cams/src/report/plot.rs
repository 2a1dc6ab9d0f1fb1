//! Curves over a common quantity, panel below panel on a sheet of paper.

use super::scheme::Scheme;
use super::sheet::paper::{PAPERS, PaperSize, SheetBorder, frame_and_grid};
use super::sheet::scheme;
use super::sheet::{STROKE, ShapeGroup, Sheet, SheetShape, TextAnchor, font, rounded, words};
use super::trace::round_step;
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Height of the texts and of the title, mm.
const TEXT: f64 = 2.8;
const TITLE: f64 = 4.5;
/// Room of a panel for values and names: to the left, above, below; and for the names of the curves to the right, mm.
const LEFT: f64 = 17.0;
const ABOVE: f64 = 9.0;
const BELOW: f64 = 11.0;
const NAMES: f64 = 34.0;
/// Length of the line that leads from a curve to its name, mm.
const LEADER: f64 = 4.0;
/// Most lines across for the values of a panel, and along.
const LINES: f64 = 7.0;
const PLACES: f64 = 10.0;
/// Colours of the curves, dark enough for white paper.
const COLOURS: [&str; 10] =
    ["#0a5cad", "#b3541e", "#17692b", "#7a3ea1", "#b3261e", "#00808a", "#8a6d00", "#c2185b", "#37474f", "#5d8a00"];
/// Radius of a mark, mm.
const MARK: f64 = 1.1;
/// Width of the panels where a mechanism is drawn next to them, mm: the rest is enough for a press at 1:5.
const COLUMN: f64 = 165.0;
/// The colour of the curve to compare with.
pub const GREY: usize = 8;

/// A curve of a plot.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotCurve {
    /// Its name, written at its end; empty where another curve of the same colour has it.
    pub name: String,
    /// Which of the colours it has.
    pub colour: usize,
    /// Drawn as a thick line.
    pub bold: bool,
    /// Place and value, in the order of the places; a single one is a mark, which the name of the panel explains.
    pub points: Vec<[f64; 2]>,
}

/// Curves of one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotPanel {
    /// The quantity with its unit, and what thin and thick lines are.
    pub name: String,
    /// The curves.
    pub curves: Vec<PlotCurve>,
}

/// Panels below each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plot {
    /// Head of the sheet.
    pub title: String,
    /// What the places of the panels are, with their unit.
    pub places: String,
    /// The panels over these places.
    pub panels: Vec<PlotPanel>,
    /// Panels over places of their own below them: what their places are, and the panel.
    pub own: Vec<(String, PlotPanel)>,
    /// A mechanism next to the panels, on a larger sheet.
    pub scheme: Option<Scheme>,
}

/// The plot on a sheet; values that are not finite are left out.
#[must_use]
pub fn sheet(plot: &Plot, mark: &str) -> Sheet {
    let paper = PAPERS.get(usize::from(plot.scheme.is_some())).copied().unwrap_or(PaperSize {
        name: "",
        size: Vector2::repeat(1.0),
        lettering: &[],
        border: SheetBorder::Iso,
    });
    let frame = paper.frame(Vector2::zeros());
    let mut groups = frame_and_grid(&paper, Vector2::zeros());
    let room = frame.size().x - 4.0 * TEXT;
    let (lines, size) = font::fitted(&plot.title, TITLE, room, 3.0 * TITLE);
    let mut top = frame.largest.y - 2.0 * TEXT;
    let mut heads = Vec::new();
    for line in lines {
        top -= font::LEADING * size;
        heads.push(words(Vector2::new(frame.least.x + 2.0 * TEXT, top), size, TextAnchor::Start, line));
    }
    let foot = frame.least + Vector2::new(2.0 * TEXT, 1.5 * TEXT);
    heads.push(words(foot, TEXT, TextAnchor::Start, mark));
    groups.push(ShapeGroup { class: "facts", ..ShapeGroup::new("title", "title", heads) });
    let mechanism = plot.scheme.as_ref();
    let field = Extents {
        least: Vector2::new(frame.least.x, frame.least.y + 4.0 * TEXT),
        largest: Vector2::new(if mechanism.is_some() { frame.least.x + COLUMN } else { frame.largest.x }, top - TEXT),
    };
    groups.extend(below_each_other(plot, &field));
    if let Some(scheme) = mechanism {
        let least = Vector2::new(field.largest.x + 2.0 * TEXT, field.least.y);
        let field = Extents { least, largest: Vector2::new(frame.largest.x - 2.0 * TEXT, field.largest.y) };
        groups.extend(scheme::draw(scheme, &field, colour_of));
    }
    Sheet {
        title: plot.title.clone(),
        extents: Extents { least: Vector2::zeros(), largest: paper.size },
        stroke: STROKE,
        scale: 1.0,
        groups,
    }
}

/// The panels in their field, all as high.
fn below_each_other(plot: &Plot, field: &Extents) -> Vec<ShapeGroup> {
    let common = range(plot.panels.iter().flat_map(places_of));
    let panels = plot.panels.iter().map(|panel| (&plot.places, panel, common));
    let own = plot.own.iter().map(|(places, panel)| (places, panel, range(places_of(panel))));
    #[expect(clippy::cast_precision_loss, reason = "a few panels")]
    let each = field.size().y / (plot.panels.len() + plot.own.len()).max(1) as f64;
    let mut upper = field.largest.y;
    let mut groups = Vec::new();
    for (index, (places, panel, along)) in panels.chain(own).enumerate() {
        let inner = Extents {
            least: Vector2::new(field.least.x + LEFT, upper - each + BELOW),
            largest: Vector2::new(field.largest.x - NAMES, upper - ABOVE),
        };
        if let Some(along) = along {
            groups.extend(draw(panel, index, places, along, &inner));
        }
        upper -= each;
    }
    groups
}

fn places_of(panel: &PlotPanel) -> impl Iterator<Item = f64> + '_ {
    panel.curves.iter().flat_map(finite).map(|[place, _]| place)
}

fn finite(curve: &PlotCurve) -> impl Iterator<Item = [f64; 2]> + '_ {
    curve.points.iter().copied().filter(|point| point.iter().all(|value| value.is_finite()))
}

/// The least and the largest of some values, where they differ.
fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    (high > low && (high - low).is_finite()).then_some((low, high))
}

/// The range of values of a panel: from 0 on, unless that would leave more than half of it empty.
fn values_of(panel: &PlotPanel) -> (f64, f64) {
    let values = || panel.curves.iter().flat_map(finite).map(|[_, value]| value);
    let far = |(low, high): &(f64, f64)| low * high > 0.0 && high - low < low.abs().min(high.abs());
    let own = range(values()).filter(far);
    own.or_else(|| range(values().chain([0.0]))).unwrap_or((-1.0, 1.0))
}

/// One panel in its field.
fn draw(panel: &PlotPanel, index: usize, places: &str, along: (f64, f64), field: &Extents) -> Vec<ShapeGroup> {
    let (low, high) = values_of(panel);
    let step = round_step(high - low, LINES);
    let across = ((low / step).floor() * step, (high / step).ceil() * step);
    let at = |place: f64, value: f64| {
        let share = Vector2::new((place - along.0) / (along.1 - along.0), (value - across.0) / (across.1 - across.0));
        field.least + field.size().component_mul(&share)
    };
    let mut grid = Vec::new();
    let mut value = across.0;
    while value <= across.1 + 0.5 * step {
        grid.push(SheetShape::Line(at(along.0, value), at(along.1, value)));
        let (text, size) = (rounded((value / step).round() * step), TEXT);
        let (text, size) = font::fitted_in_one(&text, size, LEFT - 3.0);
        let place = at(along.0, value) - Vector2::new(0.5, 0.35) * size;
        grid.push(words(place, size, TextAnchor::End, text));
        value += step;
    }
    let step = round_step(along.1 - along.0, PLACES);
    let mut place = (along.0 / step).ceil() * step;
    while place <= along.1 + 1e-9 * step {
        grid.push(SheetShape::Line(at(place, across.0), at(place, across.1)));
        let below = at(place, across.0) - Vector2::new(0.0, 1.3 * TEXT);
        grid.push(words(below, TEXT, TextAnchor::Middle, rounded((place / step).round() * step)));
        place += step;
    }
    let (head, size) = font::fitted_in_one(&panel.name, TEXT, field.size().x + NAMES - TEXT);
    let below = Vector2::new(0.5 * (field.least.x + field.largest.x), field.least.y - 2.8 * TEXT);
    let names = vec![
        words(Vector2::new(field.least.x, field.largest.y + 0.8 * TEXT), size, TextAnchor::Start, head),
        words(below, TEXT, TextAnchor::Middle, places),
    ];
    let named = |group: ShapeGroup| ShapeGroup { id: format!("{}-{index}", group.id), ..group };
    let mut groups =
        vec![named(ShapeGroup { class: "trace-grid", ..ShapeGroup::new("grid", "lines of the diagram", grid) })];
    groups.extend(panel.curves.iter().enumerate().map(|(number, curve)| ShapeGroup {
        id: format!("curve-{index}-{number}"),
        class: match (is_mark(curve), curve.bold) {
            (true, _) => "curve-mark",
            (false, true) => "curve-bold",
            (false, false) => "curve",
        },
        label: if curve.name.is_empty() { &panel.name } else { &curve.name }.clone().into(),
        colour: Some(colour(curve).into()),
        shapes: shapes(curve, &at),
        in_legend: false,
    }));
    groups.extend(labels(panel, index, field.least.y, &at));
    groups.push(named(ShapeGroup { class: "facts", ..ShapeGroup::new("names", "names of the diagram", names) }));
    groups
}

/// Whether a curve is a single place.
fn is_mark(curve: &PlotCurve) -> bool {
    curve.points.len() == 1
}

fn shapes(curve: &PlotCurve, at: &impl Fn(f64, f64) -> Vector2<f64>) -> Vec<SheetShape> {
    let mut places = finite(curve).map(|[place, value]| at(place, value));
    if is_mark(curve) {
        places.map(|place| SheetShape::Entity(Entity::Circle(place, MARK))).collect()
    } else {
        vec![SheetShape::Path(places.by_ref().collect())]
    }
}

fn colour(curve: &PlotCurve) -> &'static str {
    colour_of(curve.colour)
}

fn colour_of(which: usize) -> &'static str {
    COLOURS.get(which % COLOURS.len()).copied().unwrap_or_default()
}

/// The names of the curves to the right of their ends, pushed apart, each with a line in the colour of its curve.
fn labels(panel: &PlotPanel, index: usize, bottom: f64, at: &impl Fn(f64, f64) -> Vector2<f64>) -> Vec<ShapeGroup> {
    let mut ends: Vec<(&PlotCurve, Vector2<f64>)> = panel
        .curves
        .iter()
        .filter(|curve| !curve.name.is_empty() && !is_mark(curve))
        .filter_map(|curve| finite(curve).last().map(|[place, value]| (curve, at(place, value))))
        .collect();
    ends.sort_by(|a, b| b.1.y.total_cmp(&a.1.y));
    let mut heights = push_apart(&ends.iter().map(|(_, end)| end.y).collect::<Vec<_>>(), font::LEADING * TEXT);
    // No name next to those of the places.
    let below = heights.last().map_or(0.0, |lowest| (bottom + 0.5 * TEXT - lowest).max(0.0));
    for height in &mut heights {
        *height += below;
    }
    let right = ends.iter().map(|(_, end)| end.x).fold(f64::NEG_INFINITY, f64::max);
    let label = |(number, ((curve, end), height)): (usize, (&(&PlotCurve, Vector2<f64>), &f64))| {
        let start = Vector2::new(right + LEADER, *height);
        let (text, size) = font::fitted_in_one(&curve.name, TEXT, NAMES - LEADER - 2.0);
        let place = start + Vector2::new(0.3 * TEXT, -0.35 * size);
        ShapeGroup {
            id: format!("name-{index}-{number}"),
            class: "curve",
            label: format!("name of {}", curve.name).into(),
            colour: Some(colour(curve).into()),
            shapes: vec![SheetShape::Line(*end, start), words(place, size, TextAnchor::Start, text)],
            in_legend: false,
        }
    };
    ends.iter().zip(&heights).enumerate().map(label).collect()
}

/// Decreasing heights at least this far apart, each as near to its own as the others allow; a cluster stays about its middle.
fn push_apart(wanted: &[f64], least: f64) -> Vec<f64> {
    // A cluster: the sum of the tops that its heights would need, and their number.
    let mut clusters: Vec<(f64, f64)> = Vec::new();
    let top = |(sum, count): (f64, f64)| sum / count;
    for height in wanted {
        let mut cluster = (*height, 1.0);
        while let Some(above) = clusters.last().copied()
            && top(above) - least * above.1 < top(cluster)
        {
            clusters.pop();
            cluster = (above.0 + cluster.0 + least * above.1 * cluster.1, above.1 + cluster.1);
        }
        clusters.push(cluster);
    }
    let mut heights = Vec::with_capacity(wanted.len());
    for cluster in clusters {
        let mut member = 0.0;
        while member < cluster.1 {
            heights.push(top(cluster) - least * member);
            member += 1.0;
        }
    }
    heights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_pushed_apart_and_stay_in_order() {
        for wanted in [vec![], vec![5.0], vec![9.0, 5.0, 1.0], vec![5.0, 5.0, 5.0], vec![8.0, 7.5, 7.0, 1.0, 0.5]] {
            let placed = push_apart(&wanted, 2.0);
            assert_eq!(placed.len(), wanted.len());
            assert!(placed.windows(2).all(|two| two[0] - two[1] >= 2.0 - 1e-12), "{wanted:?}: {placed:?}");
            let middle = |heights: &[f64]| heights.iter().sum::<f64>();
            assert!((middle(&placed) - middle(&wanted)).abs() < 1e-9, "about their middle: {placed:?}");
        }
        assert_eq!(push_apart(&[9.0, 5.0, 1.0], 2.0), [9.0, 5.0, 1.0]);
    }

    #[test]
    fn a_plot_draws_what_is_finite_and_names_its_curves() {
        let curve = |name: &str, slope: f64| PlotCurve {
            name: name.into(),
            colour: 7,
            bold: true,
            points: (0..=10).map(|i| [f64::from(i), if i == 3 { f64::NAN } else { slope * f64::from(i) }]).collect(),
        };
        let panel = PlotPanel { name: "force, N".into(), curves: vec![curve("a", 1.0), curve("b", -2.0)] };
        let flat = PlotPanel { name: "nothing".into(), curves: vec![curve("c", 0.0)] };
        let plot = Plot { title: "t".into(), places: "x, mm".into(), panels: vec![panel, flat], ..Plot::default() };
        let sheet = sheet(&plot, "mark");
        let paths = sheet.groups.iter().flat_map(|group| &group.shapes);
        let lengths: Vec<usize> = paths
            .filter_map(|shape| if let SheetShape::Path(points) = shape { Some(points.len()) } else { None })
            .collect();
        assert_eq!(lengths, [10, 10, 10]);
        let names: Vec<String> =
            sheet.groups.iter().filter(|group| group.id.starts_with("name-")).map(|g| g.label.to_string()).collect();
        assert_eq!(names, ["name of a", "name of b", "name of c"]);
    }
}

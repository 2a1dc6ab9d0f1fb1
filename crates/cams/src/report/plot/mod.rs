//! Pictures of analyses: curves over a quantity, bars and small multiples on a sheet of paper, with the answer as their title.
//!
//! A picture is data; [`super::style`] decides how it looks.

mod bars;
mod multiples;
mod panel;
mod table;

use super::page::{LARGE_PAGE, PAGE, PicturePage};
use super::scheme::Scheme;
use super::sheet::{Sheet, scheme};
pub use super::style::{PictureColour, figure};
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Width of the plots where a mechanism is drawn next to them, over that of the page: the rest is enough for a press at 1:5.
const COLUMN: f64 = 0.47;
/// Height of a mechanism above the plots, over that of the page.
const ABOVE: f64 = 0.42;
/// Room between the plots and what is next to them, mm over the lettering.
const GAP: f64 = 6.0;
/// Width of a table next to the plots, mm over the lettering.
const TABLE: f64 = 62.0;

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum CurveStroke {
    /// A thick line.
    #[default]
    Bold,
    /// A thin line.
    Thin,
    /// A thin dashed line.
    Dashed,
}

/// A curve of a plot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlotCurve {
    /// Its name, written at its end; empty where the panel's name says it.
    pub name: String,
    /// Its colour.
    pub colour: PictureColour,
    /// Its line.
    pub stroke: CurveStroke,
    /// Place and value, in the order of the places.
    pub points: Vec<[f64; 2]>,
}

impl PlotCurve {
    /// A thick line in one of the eight colours.
    #[must_use]
    pub fn new(name: impl Into<String>, colour: usize, points: Vec<[f64; 2]>) -> Self {
        Self { name: name.into(), colour: PictureColour::Line(colour), stroke: CurveStroke::Bold, points }
    }

    /// A thin grey line to compare with.
    #[must_use]
    pub fn grey(name: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self { name: name.into(), colour: PictureColour::Grey, stroke: CurveStroke::Thin, points }
    }

    /// The curve with another line.
    #[must_use]
    pub fn stroked(self, stroke: CurveStroke) -> Self {
        Self { stroke, ..self }
    }
}

/// A point with its text next to it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlotPoint {
    /// Place and value.
    pub at: [f64; 2],
    /// What is said of it; empty where the dot alone says it.
    pub text: String,
    /// Its colour.
    pub colour: PictureColour,
    /// Drawn as a ring: where two curves meet, or what was chosen.
    pub ring: bool,
}

impl PlotPoint {
    /// A dot with a text.
    #[must_use]
    pub fn dot(at: [f64; 2], colour: usize, text: impl Into<String>) -> Self {
        Self { at, text: text.into(), colour: PictureColour::Line(colour), ring: false }
    }

    /// A ring with a text.
    #[must_use]
    pub fn ring(at: [f64; 2], text: impl Into<String>) -> Self {
        Self { at, text: text.into(), colour: PictureColour::Ink, ring: true }
    }
}

/// A line across a panel at a place, such as the speed for which a cam was cut.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlotLine {
    /// The place.
    pub at: f64,
    /// What is there.
    pub text: String,
    /// Whether it is dashed: a border rather than a setting.
    pub dashed: bool,
}

/// The quantity that a band limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BandAxis {
    /// Places.
    Places,
    /// Values.
    #[default]
    Values,
}

/// A part of a panel: beyond a limit, or where something is better.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PlotBand {
    /// What it limits.
    pub axis: BandAxis,
    /// From here; −∞ from the edge.
    pub from: f64,
    /// Up to here; ∞ to the edge.
    pub to: f64,
    /// The reason, or what is better.
    pub text: String,
    /// Its colour: one of [`PictureColour::Limit`] is hatched.
    pub colour: PictureColour,
}

impl PlotBand {
    /// Values above a limit.
    #[must_use]
    pub fn above(limit: f64, reason: impl Into<String>) -> Self {
        Self {
            axis: BandAxis::Values,
            from: limit,
            to: f64::INFINITY,
            text: reason.into(),
            colour: PictureColour::Limit,
        }
    }

    /// Values below a limit.
    #[must_use]
    pub fn below(limit: f64, reason: impl Into<String>) -> Self {
        Self { from: f64::NEG_INFINITY, to: limit, ..Self::above(limit, reason) }
    }

    /// Places at which something is better.
    #[must_use]
    pub fn better(from: f64, to: f64, colour: usize, text: impl Into<String>) -> Self {
        Self { axis: BandAxis::Places, from, to, text: text.into(), colour: PictureColour::Line(colour) }
    }
}

/// Curves of one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct PlotPanel {
    /// The quantity with its unit, above its axis.
    pub name: String,
    /// The curves.
    pub curves: Vec<PlotCurve>,
    /// Points on them.
    pub points: Vec<PlotPoint>,
    /// Lines across, at places.
    pub lines: Vec<PlotLine>,
    /// Parts of it.
    pub bands: Vec<PlotBand>,
    /// Its height over that of the others.
    pub height: f64,
}

impl Default for PlotPanel {
    fn default() -> Self {
        Self {
            name: String::new(),
            curves: Vec::new(),
            points: Vec::new(),
            lines: Vec::new(),
            bands: Vec::new(),
            height: 1.0,
        }
    }
}

impl PlotPanel {
    /// A panel of curves.
    #[must_use]
    pub fn new(name: impl Into<String>, curves: Vec<PlotCurve>) -> Self {
        Self { name: name.into(), curves, ..Self::default() }
    }
}

/// A row of bars.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BarRow {
    /// What it is of.
    pub name: String,
    /// Its condition, such as a half width.
    pub note: String,
    /// The light bar behind.
    pub before: f64,
    /// The dark bar in front.
    pub after: f64,
    /// A cell at the right.
    pub cell: String,
    /// A bar of its own at the right, with its text: a share from 0 to 1.
    pub share: Option<(f64, String)>,
}

/// Bars, two to a row: before and after.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BarChart {
    /// The quantity with its unit.
    pub name: String,
    /// What the light bars are, and the dark ones.
    pub keys: [String; 2],
    /// Head of the cells, and of the shares.
    pub heads: [String; 2],
    /// The rows, the largest first.
    pub rows: Vec<BarRow>,
}

/// A range of values with a middle.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpanRow {
    /// What it is of.
    pub name: String,
    /// Least, marked and largest value.
    pub values: [f64; 3],
    /// The text of the marked value.
    pub text: String,
    /// Its colour.
    pub colour: PictureColour,
}

/// Ranges below each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SpanChart {
    /// The quantity with its unit, and what the marks are.
    pub name: String,
    /// The rows.
    pub rows: Vec<SpanRow>,
    /// Values beyond a limit.
    pub limit: Option<(f64, String)>,
}

/// A small plot among others.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SmallPlot {
    /// Its name.
    pub name: String,
    /// Its curve.
    pub points: Vec<[f64; 2]>,
    /// The point that is labelled.
    pub peak: Option<PlotPoint>,
    /// What is said below it at the left, and whether that is better than the design's own.
    pub figure: (String, bool),
    /// What is said below it at the right.
    pub note: String,
    /// The design's own: its curve is grey in all others.
    pub is_own: bool,
}

/// Small plots on one scale, the design's own curve in grey behind each.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SmallPlots {
    /// The quantity with its unit.
    pub name: String,
    /// The plots in their order.
    pub plots: Vec<SmallPlot>,
    /// How many stand in a row at the most; 0 for a page of their own.
    pub in_a_row: usize,
    /// What was left out, and why.
    pub left_out: String,
}

/// A row of a table next to plots.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SideRow {
    /// Its cells: the first is its name.
    pub cells: Vec<String>,
    /// A tint that says the same as the band of a panel.
    pub tint: Option<PictureColour>,
}

/// A table next to plots: what to set.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SideTable {
    /// Its head.
    pub title: String,
    /// Names of the columns.
    pub heads: Vec<String>,
    /// Its rows.
    pub rows: Vec<SideRow>,
    /// What tints and dashes mean, a sentence each.
    pub notes: Vec<String>,
}

/// A picture of an analysis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plot {
    /// The answer with its figure.
    pub title: String,
    /// Machine, conditions and rule.
    pub subtitle: String,
    /// What the places of the panels are, with their unit.
    pub places: String,
    /// Bars above everything else.
    pub bars: Option<BarChart>,
    /// Ranges below them.
    pub spans: Option<SpanChart>,
    /// Small plots.
    pub small: Option<SmallPlots>,
    /// The panels over the places.
    pub panels: Vec<PlotPanel>,
    /// Panels over places of their own below them: what their places are, and the panel.
    pub own: Vec<(String, PlotPanel)>,
    /// A table next to everything.
    pub table: Option<SideTable>,
    /// A mechanism next to everything, on a larger sheet.
    pub scheme: Option<Scheme>,
}

/// The picture on a sheet; values that are not finite are left out.
#[must_use]
pub fn sheet(plot: &Plot, mark: &str) -> Sheet {
    let paper = if plot.scheme.is_some() { LARGE_PAGE } else { PAGE };
    let mut page = PicturePage::new(paper, &plot.title, &plot.subtitle, mark);
    let k = page.k;
    let mut field = page.body;
    if let Some(scheme) = &plot.scheme {
        let draw = |page: &mut PicturePage, field: &Extents| {
            page.extend(scheme::draw(scheme, field, |colour| PictureColour::Line(colour).line()));
        };
        if scheme.poses.len() == 1 {
            // Long and low: above the plots, which stand in two columns.
            let border = field.largest.y - ABOVE * field.size().y;
            draw(&mut page, &Extents { least: Vector2::new(field.least.x, border + GAP * k), largest: field.largest });
            field.largest.y = border;
            two_columns(&mut page, plot, field);
            return page.sheet();
        }
        let border = field.least.x + COLUMN * field.size().x;
        draw(&mut page, &Extents { least: Vector2::new(border + GAP * k, field.least.y), largest: field.largest });
        field.largest.x = border;
    }
    if let Some(table) = &plot.table {
        let width = TABLE * k;
        let beside = Extents { least: Vector2::new(field.largest.x - width, field.least.y), largest: field.largest };
        table::draw(&mut page, table, &beside);
        field.largest.x -= width + GAP * k;
    }
    below_each_other(&mut page, plot, field);
    page.sheet()
}

/// The panels over common places at the left, those over their own at the right.
fn two_columns(page: &mut PicturePage, plot: &Plot, field: Extents) {
    let gap = GAP * page.k;
    let middle = 0.5 * (field.least.x + field.largest.x);
    let (mut left, mut right) = (field, field);
    if !plot.panels.is_empty() && !plot.own.is_empty() {
        (left.largest.x, right.least.x) = (middle - gap, middle + gap);
    }
    below_each_other(page, &Plot { own: Vec::new(), ..plot.clone() }, left);
    below_each_other(page, &Plot { own: plot.own.clone(), ..Plot::default() }, right);
}

/// Heights of bars, ranges and small plots over that of a panel.
const BARS: f64 = 3.2;
const SPANS: f64 = 1.1;
const SMALL_PLOTS: f64 = 1.6;

/// Everything in its field, from above.
fn below_each_other(page: &mut PicturePage, plot: &Plot, field: Extents) {
    let panels = panel::stack(plot);
    let (own, shared): (Vec<_>, Vec<_>) = panels.iter().partition(|panel| panel.is_own());
    // Panels over places of their own stand next to each other where nothing else is beside.
    let in_pairs = own.len() > 1 && !shared.is_empty() && plot.scheme.is_none();
    let rows: Vec<&[&panel::StackedPanel<'_>]> = own.chunks(if in_pairs { 2 } else { 1 }).collect();
    let fixed = shared.iter().map(|panel| panel.around(page.k)).sum::<f64>()
        + rows.iter().map(|row| around_of(row, page.k)).sum::<f64>();
    let share = |present: bool, height: f64| if present { height } else { 0.0 };
    let shares = [
        share(plot.bars.is_some(), BARS),
        share(plot.spans.is_some(), SPANS),
        plot.small.as_ref().map_or(0.0, |small| SMALL_PLOTS * multiples::rows(small)),
    ];
    let all = shares.iter().sum::<f64>()
        + shared.iter().map(|panel| panel.height()).sum::<f64>()
        + rows.iter().map(|row| tallest_of(row)).sum::<f64>();
    let each = (field.size().y - fixed).max(0.0) / all.max(1e-9);
    let mut top = field.largest.y;
    let mut next = |height: f64| {
        let part =
            Extents { least: Vector2::new(field.least.x, top - height), largest: Vector2::new(field.largest.x, top) };
        top -= height;
        part
    };
    let [bars, spans, small] = shares;
    // Bars and ranges below each other have their names in one column.
    let names = bars::name_width(plot.bars.as_ref(), plot.spans.as_ref(), page.k);
    if let Some(chart) = &plot.bars {
        bars::draw(page, chart, names, &next(each * bars));
    }
    if let Some(chart) = &plot.spans {
        bars::draw_spans(page, chart, names, &next(each * spans));
    }
    let stacked: Vec<&panel::StackedPanel<'_>> =
        if in_pairs { shared.clone() } else { shared.iter().chain(&own).copied().collect() };
    let sides = panel::sides(&stacked, page.k, field.size().x);
    let room = page.k;
    for panel in shared {
        panel.draw(page, &next(panel.around(room) + each * panel.height()), sides);
    }
    if let Some(chart) = &plot.small {
        multiples::draw(page, chart, &next(each * small));
    }
    for row in rows {
        let part = next(around_of(row, room) + each * tallest_of(row));
        if !in_pairs {
            for panel in row {
                panel.draw(page, &part, sides);
            }
            continue;
        }
        let width = 0.5 * (part.size().x - GAP * room);
        for (index, panel) in row.iter().enumerate() {
            let least = part.least.x + if index == 0 { 0.0 } else { width + GAP * room };
            let cell = Extents {
                least: Vector2::new(least, part.least.y),
                largest: Vector2::new(least + width, part.largest.y),
            };
            panel.draw(page, &cell, panel::sides(&[*panel], room, width));
        }
    }
}

/// Height of the tallest panel of a row over that of the others, and the most room about one, mm.
fn tallest_of(row: &[&panel::StackedPanel<'_>]) -> f64 {
    row.iter().map(|panel| panel.height()).fold(0.0, f64::max)
}

fn around_of(row: &[&panel::StackedPanel<'_>], k: f64) -> f64 {
    row.iter().map(|panel| panel.around(k)).fold(0.0, f64::max)
}

/// The points of a curve that can be drawn.
pub(super) fn finite(points: &[[f64; 2]]) -> impl Iterator<Item = [f64; 2]> + '_ {
    points.iter().copied().filter(|point| point.iter().all(|value| value.is_finite()))
}

/// The least and the largest of some values, where they differ.
pub(super) fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
    (high > low && (high - low).is_finite()).then_some((low, high))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sheet::SheetShape;

    #[test]
    fn a_plot_draws_what_is_finite_and_names_its_curves() {
        let curve = |name: &str, slope: f64| {
            let points =
                (0..=10).map(|i| [f64::from(i), if i == 3 { f64::NAN } else { slope * f64::from(i) }]).collect();
            PlotCurve::new(name, 7, points)
        };
        let panel = PlotPanel::new("force, N", vec![curve("a", 1.0), curve("b", -2.0)]);
        let flat = PlotPanel::new("nothing", vec![curve("c", 0.0)]);
        let plot = Plot { title: "t".into(), places: "x, mm".into(), panels: vec![panel, flat], ..Plot::default() };
        let sheet = sheet(&plot, "mark");
        let paths = sheet.groups.iter().flat_map(|group| &group.shapes);
        let lengths: Vec<usize> = paths
            .filter_map(|shape| if let SheetShape::Path(points) = shape { Some(points.len()) } else { None })
            .collect();
        assert_eq!(lengths, [10, 10, 10]);
        let texts: Vec<&str> = sheet
            .groups
            .iter()
            .flat_map(|group| &group.shapes)
            .filter_map(|shape| if let SheetShape::Text { text, .. } = shape { Some(text.as_str()) } else { None })
            .collect();
        for text in ["t", "force, N", "nothing", "x, mm", "a", "b", "c", "mark"] {
            assert!(texts.contains(&text), "{text}: {texts:?}");
        }
    }
}

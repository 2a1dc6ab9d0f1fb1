//! The sheet of a motion diagram: the panels one below the other, the segments above them, the axis, what the lines are, and the title block.

use super::labels::SIZE;
use super::panel::{DrawnPanel, NUMBERS, PanelPaper, TITLES};
use super::{DiagramPanel, DiagramSegment, MotionDiagram, figure, notes};
use crate::report::Report;
use crate::report::sheet::block::{self, TitleBlock};
use crate::report::sheet::paper::{PaperSize, SheetBorder, frame_and_grid, papers};
use crate::report::sheet::{
    STROKE, ShapeGroup, Sheet, SheetKind, SheetShape, TextAnchor, TitleFacts, font, rounded, words,
};
use crate::report::trace::round_step;
use camgen_kernel::geometry::contour::Extents;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// The sheet.
const PAPER: &str = "A3";
/// Paper of a diagram in inches.
const PAPER_IN_INCHES: &str = "B";
/// Room to the right of the panels, mm.
const RIGHT: f64 = 6.0;
/// Room for the names of the segments above the panels, for the axis below them, and between two panels, mm.
const STRIP: f64 = 9.0;
const AXIS: f64 = 10.5;
const GAP: f64 = 1.6;
/// Height of the notes at the left of the title block, mm.
const NOTES: f64 = 56.0;
/// Room between the frame and what is in it, mm.
const PAD: f64 = 2.5;
/// Degrees between the lines of the grid of a turn, and most lines of that of a travel.
const EVERY: f64 = 30.0;
const PLACES: f64 = 12.0;
/// A limit farther from the values than this many times the largest is not shown.
const NEAR: f64 = 2.0;

/// The motion diagram of a cam on its sheet; `deviation` is what the title block of its drawing has for the outline.
#[must_use]
pub fn sheet(diagram: &MotionDiagram, report: &Report, facts: &TitleFacts, deviation: &str, number: &str) -> Sheet {
    let name = if diagram.units == LengthUnit::Inch { PAPER_IN_INCHES } else { PAPER };
    let paper = papers(diagram.units).iter().find(|paper| paper.name == name).copied();
    let paper = paper.unwrap_or(PaperSize { name: "", size: Vector2::repeat(1.0), border: SheetBorder::Iso });
    let frame = paper.frame(Vector2::zeros());
    let mut groups = frame_and_grid(&paper, Vector2::zeros());
    let field = Extents {
        least: Vector2::new(frame.least.x + PAD + TITLES + NUMBERS, frame.least.y + NOTES + AXIS),
        largest: Vector2::new(frame.largest.x - RIGHT, frame.largest.y - STRIP),
    };
    let grid = grid(diagram);
    let panels = panels(diagram, report, &field, &grid);
    let mut remarks = diagram.notes.clone();
    for (panel, drawn) in diagram.panels.iter().zip(&panels) {
        remarks.extend(clipped(diagram, panel, drawn));
    }
    if !report.not_modelled.is_empty() {
        remarks.push(format!("Not modelled: {}", report.not_modelled.join(" ")));
    }
    groups.extend(panels.into_iter().flat_map(|panel| panel.groups));
    groups.push(segments(diagram, &field));
    groups.push(axis(diagram, &grid, &field));
    let corner = Vector2::new(frame.largest.x, frame.least.y);
    let below = Extents { least: frame.least, largest: corner + Vector2::new(-block::WIDTH, NOTES) };
    groups.push(ShapeGroup {
        id: "diagram-rule".into(),
        ..ShapeGroup::new(
            "rule",
            "rules",
            vec![SheetShape::Line(Vector2::new(below.least.x, below.largest.y), below.largest)],
        )
    });
    groups.extend(notes::groups(diagram, &remarks, &below));
    let block = TitleBlock {
        facts,
        report,
        paper: &paper,
        scale: String::new(),
        kind: SheetKind::Review,
        document: "motion diagram",
        number,
        file_deviates: deviation.into(),
    };
    groups.extend(block.groups(corner));
    Sheet {
        title: format!("{}, motion diagram", report.title()),
        extents: Extents { least: Vector2::zeros(), largest: paper.size },
        stroke: STROKE,
        scale: 1.0,
        groups,
    }
}

fn panels(diagram: &MotionDiagram, report: &Report, field: &Extents, grid: &[f64]) -> Vec<DrawnPanel> {
    #[expect(clippy::cast_precision_loss, reason = "a few panels")]
    let each = field.size().y / diagram.panels.len().max(1) as f64;
    let mut top = field.largest.y;
    let mut drawn = Vec::new();
    for (index, panel) in diagram.panels.iter().enumerate() {
        let field = Extents {
            least: Vector2::new(field.least.x, top - each + GAP),
            largest: Vector2::new(field.largest.x, top),
        };
        let limits = limits(panel, report);
        drawn.push(PanelPaper { diagram, panel, index, field, limits: &limits, grid }.draw());
        top -= each;
    }
    drawn
}

/// The limits of a panel that are near its values.
fn limits(panel: &DiagramPanel, report: &Report) -> Vec<(f64, String)> {
    let Some(check) = panel.column.0.strip_suffix("_deg").filter(|check| *check == "pressure_angle") else {
        return Vec::new();
    };
    let limit = report.checks.iter().find(|finding| finding.check == check).and_then(|finding| finding.limit);
    let values = || panel.law.iter().flatten().map(|[_, value]| *value);
    let largest = values().map(f64::abs).fold(0.0, f64::max);
    let near = |limit: &f64| *limit > 0.0 && *limit < NEAR * largest;
    let Some(limit) = limit.filter(near) else { return Vec::new() };
    let signs = [1.0, -1.0].into_iter().filter(|sign| values().any(|value| sign * value > 0.3 * largest));
    signs.map(|sign| (sign * limit, format!("limit {}°", figure(limit)))).collect()
}

/// A note on a panel that does not show all of its values.
fn clipped(diagram: &MotionDiagram, panel: &DiagramPanel, drawn: &DrawnPanel) -> Option<String> {
    let DiagramPanel { name, unit, .. } = panel;
    let window = drawn.window.clipped.then_some(drawn.window)?;
    Some(if panel.radius {
        let beyond = panel.extremes.iter().filter(|extreme| extreme.overall && !window.holds(extreme.value));
        let usual = format!("{name}: shown up to {} {unit}, infinite where the curve is straight", figure(window.high));
        let all: Vec<String> =
            std::iter::once(usual).chain(beyond.map(|extreme| diagram.words(panel, extreme))).collect();
        format!("{}.", all.join("; "))
    } else {
        format!("{name}: clipped at {} {unit}; labels give the true values.", figure(window.high.max(-window.low)))
    })
}

/// The places of the grid.
fn grid(diagram: &MotionDiagram) -> Vec<f64> {
    let (first, last) = diagram.range;
    let step = if diagram.turns { EVERY } else { round_step(last - first, PLACES) };
    let mut places = Vec::new();
    let mut number = (first / step).ceil();
    while number * step <= last + 1e-9 * step {
        places.push(number * step);
        number += 1.0;
    }
    places
}

fn across(diagram: &MotionDiagram, field: &Extents, place: f64) -> f64 {
    let (first, last) = diagram.range;
    field.least.x + field.size().x * (place - first) / (last - first)
}

/// The names of the segments above the panels, and the lines between them.
fn segments(diagram: &MotionDiagram, field: &Extents) -> ShapeGroup {
    let (low, high) = (field.largest.y, field.largest.y + STRIP - 1.2);
    let mut shapes = Vec::new();
    let of = |DiagramSegment { number, range, name, .. }: &DiagramSegment| {
        let [left, right] = [range.0, range.1].map(|place| across(diagram, field, place));
        let texts = [format!("{number}: {name}"), number.to_string()];
        let fits = |text: &String| font::width(text, SIZE) <= right - left - 1.6;
        let text = texts.into_iter().find(fits);
        let at = Vector2::new(0.5 * (left + right), low + 0.5 * (high - low) - 0.36 * SIZE);
        (left, text.map(|text| words(at, SIZE, TextAnchor::Middle, text)))
    };
    let right = field.largest.x;
    for (left, text) in diagram.segments.iter().map(of).chain([(right, None)]) {
        shapes.push(SheetShape::Line(Vector2::new(left, low), Vector2::new(left, high)));
        shapes.extend(text);
    }
    ShapeGroup { id: "diagram-segments".into(), ..ShapeGroup::new("rule", "segments of the motion", shapes) }
}

/// The numbers and the name of the common axis.
fn axis(diagram: &MotionDiagram, grid: &[f64], field: &Extents) -> ShapeGroup {
    let y = field.least.y + GAP - 1.3 * SIZE;
    let number = |place: &f64| {
        let at = Vector2::new(across(diagram, field, *place), y);
        words(at, SIZE, TextAnchor::Middle, rounded(*place))
    };
    let mut shapes: Vec<SheetShape> = grid.iter().map(number).collect();
    let middle = Vector2::new(0.5 * (field.least.x + field.largest.x), y - 1.35 * SIZE);
    shapes.push(words(middle, SIZE, TextAnchor::Middle, diagram.places));
    ShapeGroup { id: "diagram-axis".into(), ..ShapeGroup::new("facts", "axis", shapes) }
}

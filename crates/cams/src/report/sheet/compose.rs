//! A sheet from what a body shows: the smallest standard sheet at true size that holds it all, else a reduction.

use super::block::{self, TitleBlock};
use super::marks::Marker;
use super::panels::{self, PanelWriter, SheetPanel};
use super::paper::{ENLARGEMENTS, PaperSize, REDUCTIONS, frame_and_grid, papers, rectangle};
use super::placing::OccupiedPaper;
use super::{Mark, STROKE, ShapeGroup, Sheet, SheetShape, SheetView, TextAnchor, TitleFacts, font, words};
use crate::report::trace::{self, Trace};
use crate::report::{Finding, Report, failed};
use camgen_kernel::geometry::contour::Extents;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;
use std::borrow::Cow;

/// Over the lettering of an A4, mm: room about the lines of a view, for each dimension line; height of the diagram
/// and of the stamp; room between panels and frame.
const ROOM: Vector2<f64> = Vector2::new(10.0, 9.0);
const DIMENSION_ROOM: f64 = 7.0;
const DIAGRAM: f64 = 50.0;
const STAMP: f64 = 17.0;
const PAD: f64 = 3.0;
/// What covers less than this at true size, mm, is too small to be read.
const SMALL: f64 = 60.0;

/// Contents of a sheet other than view and report.
#[derive(Debug, Clone, Copy)]
pub struct SheetExtras<'a> {
    /// How far the profile of the file lies from the exact one, in words.
    pub file_deviates: &'a str,
    /// Which sheet of how many it is: "1/1".
    pub number: &'static str,
    /// A diagram below the view.
    pub traces: &'a [Trace],
    /// The checks that a reader of paper needs.
    pub checks: &'a [Finding],
    /// How many checks of the written files passed that are not listed.
    pub passed_otherwise: usize,
}

/// The regions of a sheet, millimetres of paper; the origin is that of the drawing.
struct Layout {
    paper: &'static PaperSize,
    scale: f64,
    k: f64,
    /// Lower left corner of the page.
    corner: Vector2<f64>,
    view: Extents,
    diagram: Option<Extents>,
    stamp: Option<Extents>,
    /// Panels with their upper left corners.
    panels: Vec<(Vector2<f64>, SheetPanel)>,
}

/// The sheet of a view.
#[must_use]
pub fn compose(view: &SheetView, report: &Report, extras: &SheetExtras<'_>) -> Sheet {
    let view = &with_missing_letters(view, report);
    let view = &in_unit(view, report.units);
    let papers = papers(report.units);
    let covered = super::extents_of(&view.groups);
    let covered = if covered.size().iter().all(|size| size.is_finite() && *size >= 0.0) {
        covered
    } else {
        Extents { least: Vector2::zeros(), largest: Vector2::zeros() }
    };
    let attempt = |scale: f64, paper: &'static PaperSize, k: f64| LayoutAttempt {
        view,
        report,
        extras,
        covered,
        paper,
        scale,
        k,
    };
    let fitting = |partly: bool| {
        let scales = REDUCTIONS.iter().map(|reduction| 1.0 / reduction);
        let sheets = scales.flat_map(|scale| papers.iter().map(move |paper| (scale, paper)));
        let tried = sheets.flat_map(|(scale, paper)| paper.lettering.iter().map(move |k| attempt(scale, paper, *k)));
        let fits = tried.into_iter().find_map(|tried| tried.layout(partly))?;
        // A small cam is enlarged as far as its sheet allows, a very small one on the next larger sheet.
        let is_small = covered.size().max() < SMALL;
        let from = papers.iter().position(|paper| paper.name == fits.paper.name).unwrap_or(0);
        let larger = papers.iter().skip(from).take(if is_small { 2 } else { 1 });
        let enlarged = larger.flat_map(|paper| ENLARGEMENTS.iter().map(move |scale| (paper, scale)));
        let mut attempts = enlarged.filter(|_| fits.scale >= 1.0).map(|(paper, scale)| {
            let k = if paper.name == fits.paper.name { Some(fits.k) } else { paper.lettering.first().copied() };
            attempt(*scale, paper, k.unwrap_or(fits.k)).layout(partly)
        });
        attempts.find_map(|found| found).or(Some(fits))
    };
    // Where no sheet holds every panel, those that do not fit are left out: the report has them.
    match fitting(false).or_else(|| fitting(true)) {
        Some(layout) => layout.sheet(view, report, extras, covered),
        None => Sheet { title: report.title(), extents: covered, stroke: STROKE, scale: 1.0, groups: Vec::new() },
    }
}

/// What ASME Y14.5 has on a drawing in inches.
const INCHES: &str = "UNLESS OTHERWISE SPECIFIED, DIMENSIONS ARE IN INCHES";

/// The view with its words in the unit of the sheet.
fn in_unit(view: &SheetView, units: LengthUnit) -> Cow<'_, SheetView> {
    if units == LengthUnit::Millimetre {
        return Cow::Borrowed(view);
    }
    let mut view = view.clone();
    for label in view.groups.iter_mut().map(|group| &mut group.label) {
        *label = label.in_unit(units).into();
    }
    view.notes =
        std::iter::once(INCHES.into()).chain(view.notes.iter().map(|note| note.in_unit(units).into())).collect();
    Cow::Owned(view)
}

/// The view with a note of the letters that would be boxes.
fn with_missing_letters<'a>(view: &'a SheetView, report: &Report) -> Cow<'a, SheetView> {
    let missing = font::missing(&(report.title() + &view.facts.title.all().concat()));
    if missing.is_empty() {
        return Cow::Borrowed(view);
    }
    let codes: Vec<String> = missing.iter().map(|letter| format!("U+{:04X}", u32::from(*letter))).collect();
    let mut view = view.clone();
    view.notes.push(format!("letters that are missing in the font of this sheet: {}", codes.join(", ")).into());
    Cow::Owned(view)
}

struct LayoutAttempt<'a> {
    view: &'a SheetView,
    report: &'a Report,
    extras: &'a SheetExtras<'a>,
    covered: Extents,
    paper: &'static PaperSize,
    scale: f64,
    k: f64,
}

impl LayoutAttempt<'_> {
    /// The layout, or `None` where it does not fit; `partly`: without the panels that do not fit.
    fn layout(&self, partly: bool) -> Option<Layout> {
        let k = self.k;
        let frame = self.paper.frame(Vector2::zeros()).size();
        let upright = self.paper.size.x < self.paper.size.y;
        let diagram = if self.extras.traces.is_empty() { 0.0 } else { DIAGRAM * k };
        let stamp = if self.report.passed() { 0.0 } else { STAMP * k };
        let needed = self.covered.size() * self.scale + 2.0 * k * ROOM + self.dimensions();
        let block = Vector2::new(block::WIDTH, block::HEIGHT) * k;
        let (room, stacks) = if upright {
            let wide = 0.5 * (frame.x - 3.0 * PAD * k);
            let below = frame.y - block.y - diagram - stamp - needed.y - PAD * k;
            (Vector2::new(frame.x, needed.y), vec![(wide, below), (wide, below)])
        } else {
            let column = (block.x - 2.0 * PAD * k, frame.y - block.y - PAD * k);
            (Vector2::new(frame.x - block.x, frame.y - diagram - stamp), vec![column])
        };
        if needed.x > room.x || needed.y > room.y {
            return None;
        }
        let panels = self.panels(&stacks, partly)?;
        Some(self.arrange(panels, diagram, stamp, upright))
    }

    /// Room for the dimension lines to the left and below, mm of paper.
    fn dimensions(&self) -> Vector2<f64> {
        let room = self.view.marks.iter().map(|mark| match mark {
            Mark::Distance { away, .. } => away.map(|part| if part == 0.0 { 0.0 } else { DIMENSION_ROOM * self.k }),
            _ => Vector2::zeros(),
        });
        room.sum()
    }

    /// Every panel with its column and its distance from the top, the tables of places as fine as there is room for.
    fn panels(&self, stacks: &[(f64, f64)], partly: bool) -> Option<Vec<(usize, f64, SheetPanel)>> {
        let choices = self.view.tables.iter().map(Some).chain(self.view.tables.is_empty().then_some(None));
        let tried = choices.map(|table| flow(self.list(stacks.first()?.0, table), stacks, partly));
        tried.flatten().next()
    }

    fn list(&self, width: f64, table: Option<&super::PlaceTable>) -> Vec<SheetPanel> {
        let writer = || PanelWriter::new(self.k, width);
        let mut list = vec![
            panels::checks(writer(), self.extras.checks, self.extras.passed_otherwise, self.report.units),
            panels::figures(writer(), self.report),
            panels::legend(writer(), self.view),
        ];
        if !(self.view.notes.is_empty() && self.view.lost.is_empty() && self.report.notes.is_empty()) {
            list.push(panels::notes(writer(), self.view, self.report));
        }
        list.extend(table.map(|table| panels::places(writer(), table)));
        list
    }

    /// The regions, once it is known that all fits.
    fn arrange(&self, panels: Vec<(usize, f64, SheetPanel)>, diagram: f64, stamp: f64, upright: bool) -> Layout {
        let (k, covered) = (self.k, self.covered);
        let frame = self.paper.frame(Vector2::zeros());
        let block = Vector2::new(block::WIDTH, block::HEIGHT) * k;
        let deepest = panels.iter().map(|(_, down, panel)| down + panel.height).fold(0.0, f64::max);
        // On an upright sheet the panels are above the title block, otherwise to the right of the view.
        let low = if upright { frame.least.y + block.y + deepest + PAD * k } else { frame.least.y };
        let right = if upright { frame.largest.x } else { frame.largest.x - block.x };
        let region = Extents { least: Vector2::new(frame.least.x, low), largest: Vector2::new(right, frame.largest.y) };
        let view = Extents {
            least: region.least + Vector2::new(0.0, diagram),
            largest: region.largest - Vector2::new(0.0, stamp),
        };
        // The dimensions are to the left and below: the lines themselves are moved to the other side by half of that.
        let middle = 0.5 * (covered.least + covered.largest) * self.scale - 0.5 * self.dimensions();
        // The origin of the drawing stays where it is; the page moves about it.
        let corner = middle - 0.5 * (view.least + view.largest);
        let moved = |field: Extents| Extents { least: field.least + corner, largest: field.largest + corner };
        let left = |column: usize| {
            #[expect(clippy::cast_precision_loss, reason = "two stacks")]
            let column = column as f64;
            if upright { frame.least.x + PAD * k + column * 0.5 * (frame.size().x - PAD * k) } else { right + PAD * k }
        };
        let top = if upright { low } else { frame.largest.y - PAD * k };
        Layout {
            paper: self.paper,
            scale: self.scale,
            k,
            corner,
            view: moved(view),
            diagram: (diagram > 0.0).then(|| {
                moved(Extents { least: region.least, largest: Vector2::new(right, region.least.y + diagram) })
            }),
            stamp: (stamp > 0.0).then(|| {
                moved(Extents { least: Vector2::new(frame.least.x, view.largest.y), largest: region.largest })
            }),
            panels: panels
                .into_iter()
                .map(|(column, down, panel)| (corner + Vector2::new(left(column), top - down), panel))
                .collect(),
        }
    }
}

/// The diagrams in equal parts of a field.
fn in_a_row(field: &Extents, traces: &[Trace], k: f64) -> Vec<ShapeGroup> {
    #[expect(clippy::cast_precision_loss, reason = "a few diagrams")]
    let each = field.size().x / traces.len().max(1) as f64;
    let mut left = field.least.x;
    let mut groups = Vec::new();
    for trace in traces {
        let part =
            Extents { least: Vector2::new(left, field.least.y), largest: Vector2::new(left + each, field.largest.y) };
        groups.extend(trace::within(&part, k, trace));
        left += each;
    }
    groups
}

/// Puts panels into stacks one below the other; `None` where they do not fit.
fn flow(list: Vec<SheetPanel>, stacks: &[(f64, f64)], partly: bool) -> Option<Vec<(usize, f64, SheetPanel)>> {
    let (mut column, mut down, mut placed) = (0, 0.0, Vec::new());
    for panel in list {
        while down + panel.height > stacks.get(column).map_or(f64::INFINITY, |(_, height)| *height) {
            (column, down) = (column + 1, 0.0);
        }
        if column >= stacks.len() {
            return partly.then_some(placed);
        }
        let top = down;
        down += panel.height;
        placed.push((column, top, panel));
    }
    Some(placed)
}

impl Layout {
    fn sheet(self, view: &SheetView, report: &Report, extras: &SheetExtras<'_>, covered: Extents) -> Sheet {
        let (k, scale) = (self.k, self.scale);
        let mut groups = frame_and_grid(self.paper, self.corner);
        let frame = self.paper.frame(self.corner);
        let mut taken = OccupiedPaper::none(self.view);
        for group in &view.groups {
            let shapes: Vec<SheetShape> = group.shapes.iter().map(|shape| shape.scaled(scale)).collect();
            for shape in &shapes {
                taken.put(shape);
            }
            let (id, label, colour) = (group.id.clone(), group.label.clone(), group.colour.clone());
            groups.push(ShapeGroup { id, label, colour, shapes, ..*group });
        }
        let ruler = ruler(&self.view, k, report.units);
        for shape in &ruler {
            taken.put(shape);
        }
        groups.push(ShapeGroup::new("scale", "ruler of the paper", ruler));
        groups.extend(self.marks(view, covered, &mut taken));
        groups.extend(self.diagram.iter().flat_map(|field| in_a_row(field, extras.traces, k)));
        if let Some(field) = self.stamp {
            groups.extend(stamp(&field, k, report));
        }
        groups.push(ShapeGroup::new("rule", "rules", rules(&self.view, self.diagram.as_ref(), &frame, k)));
        for (corner, panel) in self.panels {
            groups.extend(panel.at(corner));
        }
        let block = TitleBlock {
            facts: &view.facts,
            report,
            paper: self.paper,
            scale: if scale < 1.0 { format!("1:{}", (1.0 / scale).round()) } else { format!("{scale}:1") },
            document: "review sheet",
            number: extras.number,
            file_deviates: extras.file_deviates.into(),
        };
        groups.extend(block.groups(Vector2::new(frame.largest.x, frame.least.y), k));
        Sheet {
            title: report.title(),
            extents: Extents { least: self.corner, largest: self.corner + self.paper.size },
            stroke: STROKE * k.min(1.4),
            scale,
            groups: with_unique_ids(groups),
        }
    }

    fn marks(&self, view: &SheetView, covered: Extents, taken: &mut OccupiedPaper) -> Vec<ShapeGroup> {
        let scale = self.scale;
        let covered = Extents { least: covered.least * scale, largest: covered.largest * scale };
        let mut marker = Marker { lettering: self.k, taken, covered, lines: [0.0; 2], texts: Vec::new() };
        // Dimension lines come first, then what has a fixed place and datums; the texts take the rest, the longest first, since their leaders
        // are the longest as well and find no way between the others.
        let is_text =
            |mark: &&Mark| matches!(mark, Mark::Label { .. } | Mark::Tolerance { .. } | Mark::Roughness { .. });
        let (texts, mut fixed): (Vec<&Mark>, Vec<&Mark>) = view.marks.iter().partition(is_text);
        fixed.sort_by_key(|mark| match mark {
            Mark::Distance { .. } => 0,
            Mark::Datum { .. } => 2,
            _ => 1,
        });
        let mut groups: Vec<ShapeGroup> = fixed.iter().flat_map(|mark| marker.groups(&mark.scaled(scale))).collect();
        let mut texts: Vec<Mark> =
            std::mem::take(&mut marker.texts).into_iter().chain(texts.iter().map(|mark| mark.scaled(scale))).collect();
        texts.sort_by_key(|mark| std::cmp::Reverse(mark.letters()));
        groups.extend(texts.iter().flat_map(|mark| marker.groups(mark)));
        groups
    }
}

/// A name occurs once in a file; groups without a name get one.
fn with_unique_ids(mut groups: Vec<ShapeGroup>) -> Vec<ShapeGroup> {
    let mut used = std::collections::BTreeMap::new();
    for group in &mut groups {
        let wanted = if group.id.is_empty() { group.class.to_owned() } else { group.id.clone() };
        let count: &mut u32 = used.entry(wanted.clone()).or_insert(0);
        *count += 1;
        group.id = if *count == 1 { wanted } else { format!("{wanted}-{count}") };
    }
    groups
}

/// The line between view and diagram.
fn rules(view: &Extents, diagram: Option<&Extents>, frame: &Extents, k: f64) -> Vec<SheetShape> {
    let mut lines = Vec::new();
    if view.largest.x < frame.largest.x - k {
        lines.push(SheetShape::Line(
            Vector2::new(view.largest.x, frame.least.y),
            Vector2::new(view.largest.x, frame.largest.y),
        ));
    }
    lines.extend(diagram.map(|field| {
        SheetShape::Line(Vector2::new(field.least.x, field.largest.y), Vector2::new(field.largest.x, field.largest.y))
    }));
    lines
}

/// Length of the ruler, mm of paper.
const RULER: f64 = 100.0;
/// Length of the ruler of a sheet in inches, inches of paper.
const RULER_INCHES: f64 = 4.0;

/// A ruler in the lower left corner of the view, by which a print is measured.
fn ruler(view: &Extents, k: f64, units: LengthUnit) -> Vec<SheetShape> {
    let (length, text) = match units {
        LengthUnit::Millimetre => (RULER, format!("{RULER} mm on paper")),
        LengthUnit::Inch => (units.millimetres() * RULER_INCHES, format!("{RULER_INCHES} in on paper")),
    };
    let start = view.least + Vector2::new(3.0, 2.0) * k;
    let tick = 1.5 * k;
    let mut shapes = vec![SheetShape::Line(start, start + Vector2::new(length, 0.0))];
    for tenth in 0..=10 {
        let foot = start + Vector2::new(length * f64::from(tenth) / 10.0, 0.0);
        let long = if tenth % 5 == 0 { 1.6 } else { 1.0 };
        shapes.push(SheetShape::Line(foot, foot + Vector2::new(0.0, long * tick)));
    }
    let end = start + Vector2::new(length + 2.0 * k, 0.0);
    shapes.push(words(end, 2.6 * k, TextAnchor::Start, text));
    shapes
}

/// The stamp on the sheet of a cam that breaks a limit.
fn stamp(field: &Extents, k: f64, report: &Report) -> Vec<ShapeGroup> {
    let inner = Extents { least: field.least.add_scalar(2.0 * k), largest: field.largest.add_scalar(-2.0 * k) };
    let failed = failed(&report.checks);
    let room = inner.size().x - 4.0 * k;
    let middle = 0.5 * (inner.least.x + inner.largest.x);
    let (head, size) = font::fitted_in_one("NOT FOR MANUFACTURE", 6.5 * k, room);
    let mut shapes = rectangle(&inner);
    let base = inner.largest.y - 1.2 * k - font::ASCENT * size;
    shapes.push(words(Vector2::new(middle, base), size, TextAnchor::Middle, head));
    let text = if failed.is_empty() {
        "there is no outline that could be cut".to_owned()
    } else {
        format!("failed: {}", failed.join(", "))
    };
    let (text, small) = font::fitted_in_one(&text, 3.5 * k, room);
    let base = inner.least.y + 1.0 * k + font::DESCENT * small;
    shapes.push(words(Vector2::new(middle, base), small, TextAnchor::Middle, text));
    vec![ShapeGroup::new("stamp", "stamp", shapes)]
}

impl Mark {
    /// The letters of a text. A frame or a sign counts as the longest: it is left out where there is no room.
    fn letters(&self) -> usize {
        if let Mark::Label { text, .. } = self { text.chars().count() } else { usize::MAX }
    }

    /// The mark on paper at a scale.
    fn scaled(&self, scale: f64) -> Self {
        let mut mark = self.clone();
        match &mut mark {
            Mark::Label { at, .. } | Mark::Datum { at, .. } | Mark::Start { at, .. } => *at *= scale,
            Mark::Tolerance { places, .. } | Mark::Roughness { places, .. } => {
                for (at, _) in places.iter_mut() {
                    *at *= scale;
                }
            }
            Mark::Distance { from, to, .. } => {
                *from *= scale;
                *to *= scale;
            }
            Mark::Radius { centre, to, .. } => {
                *centre *= scale;
                *to *= scale;
            }
            Mark::Angle { corner, radius, .. } => {
                *corner *= scale;
                *radius *= scale;
            }
            Mark::Turning { radius, .. } => *radius *= scale,
        }
        mark
    }
}

impl TitleFacts {
    /// The facts about a machine.
    #[must_use]
    pub fn of(machine: &crate::machine::Machine, mass_kg: Option<f64>) -> Self {
        Self {
            title: machine.title.clone(),
            material: machine.material_name().map(str::to_owned),
            thickness_mm: machine.cam.thickness.map(|thickness| 1e3 * thickness),
            mass_kg,
        }
    }
}

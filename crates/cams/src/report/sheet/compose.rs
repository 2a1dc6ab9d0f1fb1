//! A sheet from what a body shows: the smallest standard sheet at true size that holds it all, else a reduction.

use super::block::{self, TitleBlock};
use super::marks::Marker;
use super::panels::{self, PanelWriter, SheetPanel};
use super::paper::{ENLARGEMENTS, PaperSize, REDUCTIONS, frame_and_grid, papers, rectangle};
use super::placing::OccupiedPaper;
use super::{
    FeatureFrame, Mark, STROKE, ShapeGroup, Sheet, SheetKind, SheetShape, SheetView, TextAnchor, TitleFacts, font,
    words,
};
use crate::report::trace::{self, Trace};
use crate::report::{Finding, Report, failed};
use camgen_kernel::geometry::contour::Extents;
use camgen_kernel::text::Text;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;
use std::borrow::Cow;

/// Room about the lines of a view of a review sheet and of a drawing, for each dimension line; height of the diagram and of the stamp; room between panels
/// and frame, mm.
const ROOM: Vector2<f64> = Vector2::new(10.0, 9.0);
const ROOM_OF_DRAWING: Vector2<f64> = Vector2::new(30.0, 18.0);
const DIMENSION_ROOM: f64 = 7.0;
const DIAGRAM: f64 = 56.0;
const STAMP: f64 = 19.0;
const PAD: f64 = 3.0;
/// What covers less than this at true size, mm, is too small to be read.
const SMALL: f64 = 60.0;

/// Contents of a sheet other than view and report.
#[derive(Debug, Clone, Copy)]
pub struct SheetExtras<'a> {
    /// What the sheet is for.
    pub kind: SheetKind,
    /// The files that belong to the part, a text each.
    pub files: &'a [String],
    /// How far the profile of the file lies from the exact one, in words.
    pub file_deviates: &'a str,
    /// Which sheet of how many it is: "1/1".
    pub number: &'a str,
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
    let attempt = |scale: f64, paper: &'static PaperSize| LayoutAttempt { view, report, extras, covered, paper, scale };
    let fitting = |partly: bool| {
        let scales = REDUCTIONS.iter().map(|reduction| 1.0 / reduction);
        let sheets = scales.flat_map(|scale| papers.iter().map(move |paper| (scale, paper)));
        let fits = sheets.map(|(scale, paper)| attempt(scale, paper)).find_map(|tried| tried.layout(partly))?;
        // A small cam is enlarged as far as its sheet allows, a very small one on the next larger sheet.
        let is_small = covered.size().max() < SMALL;
        let from = papers.iter().position(|paper| paper.name == fits.paper.name).unwrap_or(0);
        let larger = papers.iter().skip(from).take(if is_small { 2 } else { 1 });
        let enlarged = larger.flat_map(|paper| ENLARGEMENTS.iter().map(move |scale| (paper, scale)));
        let mut attempts = enlarged.filter(|_| fits.scale >= 1.0).map(|(paper, scale)| attempt(*scale, paper));
        attempts.find_map(|tried| tried.layout(partly)).or(Some(fits))
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
}

impl LayoutAttempt<'_> {
    /// The layout, or `None` where it does not fit; `partly`: without the panels that do not fit.
    fn layout(&self, partly: bool) -> Option<Layout> {
        let frame = self.paper.frame(Vector2::zeros()).size();
        let diagram = if self.extras.traces.is_empty() { 0.0 } else { DIAGRAM };
        let stamp = if self.report.passed() { 0.0 } else { STAMP };
        let around = if self.extras.kind.is_drawing() { ROOM_OF_DRAWING } else { ROOM };
        let needed = self.covered.size() * self.scale + 2.0 * around + self.dimensions();
        let room = Vector2::new(frame.x - block::WIDTH, frame.y - diagram - stamp);
        if needed.x > room.x || needed.y > room.y {
            return None;
        }
        let height = frame.y - block::height(self.extras.kind) - PAD;
        let panels = self.panels(block::WIDTH - 2.0 * PAD, height, partly)?;
        Some(self.arrange(panels, diagram, stamp))
    }

    /// Room for the dimension lines to the left and below, mm of paper.
    fn dimensions(&self) -> Vector2<f64> {
        let room = self.view.marks.iter().map(|mark| match mark {
            Mark::Distance { away, .. } => away.map(|part| if part == 0.0 { 0.0 } else { DIMENSION_ROOM }),
            _ => Vector2::zeros(),
        });
        room.sum()
    }

    /// Every panel with its distance from the top, the tables of places as fine as there is room for.
    fn panels(&self, width: f64, height: f64, partly: bool) -> Option<Vec<(f64, SheetPanel)>> {
        // A setup sheet has all of its tables.
        let has_choice = matches!(self.extras.kind, SheetKind::Drawing | SheetKind::Inspection);
        let tables = if has_choice { self.view.tables.as_slice() } else { &[] };
        let mut choices = tables.iter().map(Some).chain(tables.is_empty().then_some(None));
        choices.find_map(|table| stack(self.list(width, table), height, partly))
    }

    fn list(&self, width: f64, table: Option<&super::PlaceTable>) -> Vec<SheetPanel> {
        let writer = || PanelWriter::new(width);
        let notes = |of_report| {
            let has_notes = !(self.view.notes.is_empty() && self.view.lost.is_empty() && of_report == &[] as &[Text]);
            has_notes.then(|| panels::notes(writer(), self.view, self.report, of_report))
        };
        let table = table.map(|table| panels::places(writer(), table));
        let files = (!self.extras.files.is_empty()).then(|| panels::files(writer(), self.extras.files));
        match self.extras.kind {
            // What camgen assumed is for the reviewer: the drawing has what follows from it.
            SheetKind::Drawing | SheetKind::Pair => table.into_iter().chain(files).chain(notes(&[])).collect(),
            SheetKind::Setup => {
                let tables = self.view.tables.iter().map(|table| panels::places(writer(), table));
                tables.chain([panels::legend(writer(), self.view)]).chain(notes(&[])).collect()
            }
            SheetKind::Inspection => table.into_iter().chain(notes(&[])).collect(),
            SheetKind::Review => {
                let checks =
                    panels::checks(writer(), self.extras.checks, self.extras.passed_otherwise, self.report.units);
                let facts = [checks, panels::figures(writer(), self.report), panels::legend(writer(), self.view)];
                facts.into_iter().chain(notes(&self.report.notes)).collect()
            }
        }
    }

    /// The regions, once it is known that all fits.
    fn arrange(&self, panels: Vec<(f64, SheetPanel)>, diagram: f64, stamp: f64) -> Layout {
        let frame = self.paper.frame(Vector2::zeros());
        let right = frame.largest.x - block::WIDTH;
        let region = Extents { least: frame.least, largest: Vector2::new(right, frame.largest.y) };
        let view = Extents {
            least: region.least + Vector2::new(0.0, diagram),
            largest: region.largest - Vector2::new(0.0, stamp),
        };
        // The dimensions are to the left and below: the lines themselves are moved to the other side by half of that.
        let middle = 0.5 * (self.covered.least + self.covered.largest) * self.scale - 0.5 * self.dimensions();
        // The origin of the drawing stays where it is; the page moves about it.
        let corner = middle - 0.5 * (view.least + view.largest);
        let moved = |field: Extents| Extents { least: field.least + corner, largest: field.largest + corner };
        let top = corner + Vector2::new(right + PAD, frame.largest.y - PAD);
        Layout {
            paper: self.paper,
            scale: self.scale,
            corner,
            view: moved(view),
            diagram: (diagram > 0.0).then(|| {
                moved(Extents { least: region.least, largest: Vector2::new(right, region.least.y + diagram) })
            }),
            stamp: (stamp > 0.0).then(|| {
                moved(Extents { least: Vector2::new(frame.least.x, view.largest.y), largest: region.largest })
            }),
            panels: panels.into_iter().map(|(down, panel)| (top - Vector2::new(0.0, down), panel)).collect(),
        }
    }
}

/// The diagrams in equal parts of a field.
fn in_a_row(field: &Extents, traces: &[Trace]) -> Vec<ShapeGroup> {
    #[expect(clippy::cast_precision_loss, reason = "a few diagrams")]
    let each = field.size().x / traces.len().max(1) as f64;
    let mut left = field.least.x;
    let mut groups = Vec::new();
    for trace in traces {
        let part =
            Extents { least: Vector2::new(left, field.least.y), largest: Vector2::new(left + each, field.largest.y) };
        groups.extend(trace::within(&part, trace));
        left += each;
    }
    groups
}

/// Puts panels one below the other; `None` where they do not fit.
fn stack(list: Vec<SheetPanel>, height: f64, partly: bool) -> Option<Vec<(f64, SheetPanel)>> {
    let (mut down, mut placed) = (0.0, Vec::new());
    for panel in list {
        if down + panel.height > height {
            return partly.then_some(placed);
        }
        let top = down;
        down += panel.height;
        placed.push((top, panel));
    }
    Some(placed)
}

impl Layout {
    fn sheet(self, view: &SheetView, report: &Report, extras: &SheetExtras<'_>, covered: Extents) -> Sheet {
        let scale = self.scale;
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
        let ruler = ruler(&self.view, report.units);
        for shape in &ruler {
            taken.put(shape);
        }
        groups.push(ShapeGroup::new("scale", "ruler of the paper", ruler));
        groups.extend(self.marks(view, covered, &mut taken));
        groups.extend(self.diagram.iter().flat_map(|field| in_a_row(field, extras.traces)));
        if let Some(field) = self.stamp {
            groups.extend(stamp(&field, report));
        }
        groups.push(ShapeGroup::new("rule", "rules", rules(&self.view, self.diagram.as_ref(), &frame)));
        for (corner, panel) in self.panels {
            groups.extend(panel.at(corner));
        }
        let block = TitleBlock {
            facts: &view.facts,
            report,
            paper: self.paper,
            scale: if scale < 1.0 { format!("1:{}", (1.0 / scale).round()) } else { format!("{scale}:1") },
            kind: extras.kind,
            document: extras.kind.document(),
            number: extras.number,
            file_deviates: extras.file_deviates.into(),
        };
        groups.extend(block.groups(Vector2::new(frame.largest.x, frame.least.y)));
        Sheet {
            title: report.title(),
            extents: Extents { least: self.corner, largest: self.corner + self.paper.size },
            stroke: self.paper.stroke(),
            scale,
            groups: with_unique_ids(groups),
        }
    }

    fn marks(&self, view: &SheetView, covered: Extents, taken: &mut OccupiedPaper) -> Vec<ShapeGroup> {
        let scale = self.scale;
        let covered = Extents { least: covered.least * scale, largest: covered.largest * scale };
        let mut marker = Marker { taken, covered, lines: [0.0; 2], texts: Vec::new() };
        // Dimension lines come first, then what has a fixed place and datums; the texts take the rest, the longest first, since their leaders
        // are the longest as well and find no way between the others.
        let is_text = |mark: &&Mark| {
            matches!(mark, Mark::Label { .. } | Mark::Flag { .. } | Mark::Tolerance(_) | Mark::Roughness { .. })
        };
        let (texts, mut fixed): (Vec<&Mark>, Vec<&Mark>) = view.marks.iter().partition(is_text);
        fixed.sort_by_key(|mark| match mark {
            Mark::Distance { .. } | Mark::Size { .. } | Mark::CuttingLine { .. } | Mark::Caption { .. } => 0,
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
fn rules(view: &Extents, diagram: Option<&Extents>, frame: &Extents) -> Vec<SheetShape> {
    let mut lines = Vec::new();
    if view.largest.x < frame.largest.x - 1.0 {
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
fn ruler(view: &Extents, units: LengthUnit) -> Vec<SheetShape> {
    let (length, text) = match units {
        LengthUnit::Millimetre => (RULER, format!("{RULER} mm on paper")),
        LengthUnit::Inch => (units.millimetres() * RULER_INCHES, format!("{RULER_INCHES} in on paper")),
    };
    let start = view.least + Vector2::new(3.0, 2.0);
    let tick = 1.5;
    let mut shapes = vec![SheetShape::Line(start, start + Vector2::new(length, 0.0))];
    for tenth in 0..=10 {
        let foot = start + Vector2::new(length * f64::from(tenth) / 10.0, 0.0);
        let long = if tenth % 5 == 0 { 1.6 } else { 1.0 };
        shapes.push(SheetShape::Line(foot, foot + Vector2::new(0.0, long * tick)));
    }
    let end = start + Vector2::new(length + 2.0, 0.0);
    shapes.push(words(end, font::SMALLEST, TextAnchor::Start, text));
    shapes
}

/// The stamp on the sheet of a cam that breaks a limit.
fn stamp(field: &Extents, report: &Report) -> Vec<ShapeGroup> {
    let inner = Extents { least: field.least.add_scalar(2.0), largest: field.largest.add_scalar(-2.0) };
    let failed = failed(&report.checks);
    let room = inner.size().x - 4.0;
    let middle = 0.5 * (inner.least.x + inner.largest.x);
    let (head, size) = font::fitted_in_one("NOT FOR MANUFACTURE", 6.5, room);
    let mut shapes = rectangle(&inner);
    let base = inner.largest.y - 1.2 - font::ASCENT * size;
    shapes.push(words(Vector2::new(middle, base), size, TextAnchor::Middle, head));
    let text = if failed.is_empty() {
        "there is no outline that could be cut".to_owned()
    } else {
        format!("failed: {}", failed.join(", "))
    };
    let (text, small) = font::fitted_in_one(&text, font::SMALLEST, room);
    let base = inner.least.y + 1.0 + font::DESCENT * small;
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
            Mark::Label { at, .. } | Mark::Datum { at, .. } | Mark::Start { at, .. } | Mark::Flag { at, .. } => {
                *at *= scale;
            }
            Mark::Tolerance(FeatureFrame { places, .. }) | Mark::Roughness { places, .. } => {
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
            Mark::Turning { arcs, .. } => arcs.iter_mut().for_each(|arc| arc.radius *= scale),
            Mark::Size { from, to, view, .. } => {
                for place in [from, to, &mut view.least, &mut view.largest] {
                    *place *= scale;
                }
            }
            Mark::Caption { view, .. } => {
                view.least *= scale;
                view.largest *= scale;
            }
            Mark::CuttingLine { ends, .. } => *ends = ends.map(|end| end * scale),
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
            material: match machine.cam.material {
                Some(material) if material.needs_a_grade() => Some("steel for hardening *".into()),
                _ => machine.material_name().map(str::to_owned),
            },
            thickness_mm: machine.cam.thickness.map(|thickness| 1e3 * thickness),
            mass_kg,
            presumed_treatment: machine.cam.material.and_then(|material| material.presumed_treatment()),
        }
    }
}

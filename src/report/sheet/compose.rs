//! A sheet from what a body shows: the smallest standard sheet at true size that holds it all, else a reduction.

use super::block::{self, Block};
use super::marks::Marker;
use super::panels::{self, Panel, Writer};
use super::paper::{PAPERS, Paper, REDUCTIONS, furniture, rectangle};
use super::placing::Taken;
use super::{Facts, Group, Mark, STROKE, Shape, Sheet, TextAnchor, View, font, words};
use crate::geometry::contour::Extents;
use crate::report::trace::{self, Trace};
use crate::report::{Report, failed};
use nalgebra::Vector2;
use std::borrow::Cow;

/// Over the lettering of an A4, mm: room about the lines of a view, for each dimension line; height of the diagram
/// and of the stamp; room between panels and frame.
const ROOM: Vector2<f64> = Vector2::new(10.0, 9.0);
const DIMENSION_ROOM: f64 = 7.0;
const DIAGRAM: f64 = 50.0;
const STAMP: f64 = 17.0;
const PAD: f64 = 3.0;

/// What a sheet tells besides view and report.
#[derive(Debug, Clone, Copy)]
pub struct Extras<'a> {
    /// The tolerance of the profile, in words.
    pub profile_tolerance: &'a str,
    /// A diagram below the view.
    pub traces: &'a [Trace],
}

/// The regions of a sheet, millimetres of paper; the origin is that of the drawing.
struct Layout<'a> {
    paper: &'a Paper,
    scale: f64,
    k: f64,
    /// Lower left corner of the page.
    corner: Vector2<f64>,
    view: Extents,
    diagram: Option<Extents>,
    stamp: Option<Extents>,
    /// Panels with their upper left corners.
    panels: Vec<(Vector2<f64>, Panel)>,
}

/// The sheet of a view.
#[must_use]
pub fn compose(view: &View, report: &Report, extras: &Extras<'_>) -> Sheet {
    let view = &with_missing_letters(view, report);
    let covered = view.extents();
    let covered = if covered.size().iter().all(|size| size.is_finite() && *size >= 0.0) {
        covered
    } else {
        Extents { least: Vector2::zeros(), largest: Vector2::zeros() }
    };
    let fitting = |partly: bool| {
        let scales = REDUCTIONS.iter().map(|reduction| 1.0 / reduction);
        let sheets = scales.flat_map(|scale| PAPERS.iter().map(move |paper| (scale, paper)));
        let tried = sheets.flat_map(|(scale, paper)| {
            paper.lettering.iter().map(move |k| Tried { view, report, extras, covered, paper, scale, k: *k })
        });
        tried.into_iter().find_map(|tried| tried.layout(partly))
    };
    // Where no sheet holds every panel, those that do not fit are left out: the report has them.
    match fitting(false).or_else(|| fitting(true)) {
        Some(layout) => layout.sheet(view, report, extras, covered),
        None => Sheet { title: report.title(), extents: covered, stroke: STROKE, scale: 1.0, groups: Vec::new() },
    }
}

/// The view with a note of the letters that would be boxes.
fn with_missing_letters<'a>(view: &'a View, report: &Report) -> Cow<'a, View> {
    let missing = font::missing(&(report.title() + &view.facts.title.all().concat()));
    if missing.is_empty() {
        return Cow::Borrowed(view);
    }
    let codes: Vec<String> = missing.iter().map(|letter| format!("U+{:04X}", u32::from(*letter))).collect();
    let mut view = view.clone();
    view.notes.push(format!("letters that the font of this sheet does not have: {}", codes.join(", ")));
    Cow::Owned(view)
}

struct Tried<'a> {
    view: &'a View,
    report: &'a Report,
    extras: &'a Extras<'a>,
    covered: Extents,
    paper: &'a Paper,
    scale: f64,
    k: f64,
}

impl<'a> Tried<'a> {
    /// Where all stands, or nothing where it does not fit; `partly`: without the panels that do not fit.
    fn layout(&self, partly: bool) -> Option<Layout<'a>> {
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
        Some(self.placed(panels, diagram, stamp, upright))
    }

    /// Room for the dimension lines to the left and below, mm of paper.
    fn dimensions(&self) -> Vector2<f64> {
        let room = self.view.marks.iter().map(|mark| match mark {
            Mark::Distance { away, .. } => away.map(|part| if part == 0.0 { 0.0 } else { DIMENSION_ROOM * self.k }),
            _ => Vector2::zeros(),
        });
        room.sum()
    }

    /// Every panel with its column and its way down, the tables of places as fine as there is room for.
    fn panels(&self, stacks: &[(f64, f64)], partly: bool) -> Option<Vec<(usize, f64, Panel)>> {
        let choices = self.view.tables.iter().map(Some).chain(self.view.tables.is_empty().then_some(None));
        let tried = choices.map(|table| flow(self.list(stacks.first()?.0, table), stacks, partly));
        tried.flatten().next()
    }

    fn list(&self, width: f64, table: Option<&super::PlaceTable>) -> Vec<Panel> {
        let writer = || Writer::new(self.k, width);
        let mut list = vec![
            panels::checks(writer(), self.report),
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
    fn placed(&self, panels: Vec<(usize, f64, Panel)>, diagram: f64, stamp: f64, upright: bool) -> Layout<'a> {
        let (k, covered) = (self.k, self.covered);
        let frame = self.paper.frame(Vector2::zeros());
        let block = Vector2::new(block::WIDTH, block::HEIGHT) * k;
        let deepest = panels.iter().map(|(_, down, panel)| down + panel.height).fold(0.0, f64::max);
        // Upright, the panels stand on the title block; else they hang beside the view.
        let low = if upright { frame.least.y + block.y + deepest + PAD * k } else { frame.least.y };
        let right = if upright { frame.largest.x } else { frame.largest.x - block.x };
        let region = Extents { least: Vector2::new(frame.least.x, low), largest: Vector2::new(right, frame.largest.y) };
        let view = Extents {
            least: region.least + Vector2::new(0.0, diagram),
            largest: region.largest - Vector2::new(0.0, stamp),
        };
        // The dimensions stand to the left and below: the lines themselves are moved to the other side by half of that.
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
fn beside_each_other(field: &Extents, traces: &[Trace], k: f64) -> Vec<Group> {
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
fn flow(list: Vec<Panel>, stacks: &[(f64, f64)], partly: bool) -> Option<Vec<(usize, f64, Panel)>> {
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

impl Layout<'_> {
    fn sheet(self, view: &View, report: &Report, extras: &Extras<'_>, covered: Extents) -> Sheet {
        let (k, scale) = (self.k, self.scale);
        let mut groups = furniture(self.paper, self.corner);
        let frame = self.paper.frame(self.corner);
        let mut taken = Taken::none(self.view);
        for group in &view.groups {
            let shapes: Vec<Shape> = group.shapes.iter().map(|shape| shape.scaled(scale)).collect();
            for shape in &shapes {
                taken.put(shape);
            }
            let (id, label, colour) = (group.id.clone(), group.label.clone(), group.colour.clone());
            groups.push(Group { id, label, colour, shapes, ..*group });
        }
        let ruler = ruler(&self.view, k);
        for shape in &ruler {
            taken.put(shape);
        }
        groups.push(Group::new("scale", "ruler of the paper", ruler));
        groups.extend(self.marks(view, covered, &mut taken));
        groups.extend(self.diagram.iter().flat_map(|field| beside_each_other(field, extras.traces, k)));
        if let Some(field) = self.stamp {
            groups.extend(stamp(&field, k, report));
        }
        groups.push(Group::new("rule", "rules", rules(&self.view, self.diagram.as_ref(), &frame, k)));
        for (corner, panel) in self.panels {
            groups.extend(panel.at(corner));
        }
        let block = Block {
            facts: &view.facts,
            report,
            paper: self.paper,
            scale: if scale < 1.0 { format!("1:{}", (1.0 / scale).round()) } else { "1:1".into() },
            profile_tolerance: extras.profile_tolerance.into(),
        };
        groups.extend(block.groups(Vector2::new(frame.largest.x, frame.least.y), k));
        Sheet {
            title: report.title(),
            extents: Extents { least: self.corner, largest: self.corner + self.paper.size },
            stroke: STROKE * k.min(1.4),
            scale,
            groups: named(groups),
        }
    }

    fn marks(&self, view: &View, covered: Extents, taken: &mut Taken) -> Vec<Group> {
        let scale = self.scale;
        let covered = Extents { least: covered.least * scale, largest: covered.largest * scale };
        let mut marker = Marker { lettering: self.k, taken, covered, lines: [0.0; 2] };
        // What has a fixed place comes first; the labels take what is left.
        let (free, fixed): (Vec<&Mark>, Vec<&Mark>) =
            view.marks.iter().partition(|mark| matches!(mark, Mark::Label { .. }));
        fixed.into_iter().chain(free).flat_map(|mark| marker.groups(&mark.scaled(scale))).collect()
    }
}

/// A name stands once in a file; groups of one style that have none get one.
fn named(mut groups: Vec<Group>) -> Vec<Group> {
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
fn rules(view: &Extents, diagram: Option<&Extents>, frame: &Extents, k: f64) -> Vec<Shape> {
    let mut lines = Vec::new();
    if view.largest.x < frame.largest.x - k {
        lines.push(Shape::Line(
            Vector2::new(view.largest.x, frame.least.y),
            Vector2::new(view.largest.x, frame.largest.y),
        ));
    }
    lines.extend(diagram.map(|field| {
        Shape::Line(Vector2::new(field.least.x, field.largest.y), Vector2::new(field.largest.x, field.largest.y))
    }));
    lines
}

/// Length of the ruler, mm of paper.
const RULER: f64 = 100.0;

/// A ruler in the lower left corner of the view, by which a print is measured.
fn ruler(view: &Extents, k: f64) -> Vec<Shape> {
    let start = view.least + Vector2::new(3.0, 2.0) * k;
    let tick = 1.5 * k;
    let mut shapes = vec![Shape::Line(start, start + Vector2::new(RULER, 0.0))];
    for tenth in 0..=10 {
        let foot = start + Vector2::new(RULER * f64::from(tenth) / 10.0, 0.0);
        let long = if tenth % 5 == 0 { 1.6 } else { 1.0 };
        shapes.push(Shape::Line(foot, foot + Vector2::new(0.0, long * tick)));
    }
    let end = start + Vector2::new(RULER + 2.0 * k, 0.0);
    shapes.push(words(end, 2.6 * k, TextAnchor::Start, format!("{RULER} mm on paper")));
    shapes
}

/// What nobody can overlook on the sheet of a cam that breaks a limit.
fn stamp(field: &Extents, k: f64, report: &Report) -> Vec<Group> {
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
    vec![Group::new("stamp", "stamp", shapes)]
}

impl Mark {
    /// The mark on paper at a scale.
    fn scaled(&self, scale: f64) -> Self {
        let mut mark = self.clone();
        match &mut mark {
            Mark::Label { at, .. } => *at *= scale,
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

impl Facts {
    /// The facts with what a title block can tell of a machine.
    #[must_use]
    pub fn of(machine: &crate::machine::Machine, mass_kg: Option<f64>) -> Self {
        Self {
            title: machine.title.clone(),
            material: machine.cam.material.map(|material| material.name().to_owned()),
            thickness_mm: machine.cam.thickness.map(|thickness| 1e3 * thickness),
            mass_kg,
        }
    }
}

//! One panel: grid, curves, marks and labels in a field of paper.

use super::clipped::{ValueWindow, lines};
use super::labels::{MARK, SIZE, around, label};
use super::{DiagramExtreme, DiagramPanel, DiagramRun, Impulse, MotionDiagram};
use crate::report::sheet::paper::rectangle;
use crate::report::sheet::placing::OccupiedPaper;
use crate::report::sheet::{ShapeGroup, SheetShape, TextAnchor, font, rounded, words};
use crate::report::trace::round_step;
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// Room to the left of a panel for its name, and for the numbers of its values, mm.
pub(super) const TITLES: f64 = 38.0;
pub(super) const NUMBERS: f64 = 17.0;
/// Lines across for the values of a panel, at most: the most for which there is room.
const LINES: [f64; 5] = [5.0, 4.0, 3.0, 2.0, 1.0];
/// Least distance of two of them, so that their numbers are apart, mm.
const LEAST_STEP: f64 = 1.2 * SIZE;
/// Room above and below a curve, mm, and where labels need a band of their own.
const PAD: f64 = 1.4;
const BAND: f64 = 6.0;
/// Length and width of the head of an arrow, mm.
const HEAD: Vector2<f64> = Vector2::new(0.9, 2.2);
/// Room between the frame of a panel and its labels, mm.
const INSET: f64 = 0.4;

/// A panel and its place on the paper.
pub(super) struct PanelPaper<'a> {
    pub(super) diagram: &'a MotionDiagram,
    pub(super) panel: &'a DiagramPanel,
    /// Number of the panel, from the top.
    pub(super) index: usize,
    /// Inside of its frame.
    pub(super) field: Extents,
    /// Limits that are shown, with their words.
    pub(super) limits: &'a [(f64, String)],
    /// Places of the grid.
    pub(super) grid: &'a [f64],
}

/// What is drawn of a panel, and whether each label that must be seen is.
pub(super) struct DrawnPanel {
    pub(super) groups: Vec<ShapeGroup>,
    pub(super) window: ValueWindow,
    complete: bool,
}

/// From places and values to paper.
struct PanelScale {
    field: Extents,
    range: (f64, f64),
    window: ValueWindow,
    /// Room below and above the window.
    pads: [f64; 2],
}

impl PanelScale {
    fn x(&self, place: f64) -> f64 {
        let (first, last) = self.range;
        self.field.least.x + self.field.size().x * (place - first) / (last - first)
    }

    fn at(&self, place: f64, value: f64) -> Vector2<f64> {
        let [below, above] = self.pads;
        let height = self.field.size().y - below - above;
        let share = (value - self.window.low) / (self.window.high - self.window.low);
        Vector2::new(self.x(place), self.field.least.y + below + height * share)
    }

    /// As [`Self::at`], a value beyond the window at its edge.
    fn within(&self, place: f64, value: f64) -> Vector2<f64> {
        self.at(place, value.clamp(self.window.low, self.window.high))
    }
}

impl PanelPaper<'_> {
    /// The panel, with bands for its labels where they find no room between the curves.
    pub(super) fn draw(&self) -> DrawnPanel {
        let narrow = self.attempt([PAD; 2]);
        if narrow.complete { narrow } else { self.attempt([BAND; 2]) }
    }

    fn attempt(&self, pads: [f64; 2]) -> DrawnPanel {
        let (panel, diagram) = (self.panel, self.diagram);
        let limits: Vec<f64> = self.limits.iter().map(|(limit, _)| *limit).collect();
        let window = ValueWindow::of(panel, &limits);
        let scale = PanelScale { field: self.field, range: diagram.range, window, pads };
        let [law, cut] = [&panel.law, &panel.cut].map(|runs| self.paths(runs, &scale));
        let impulses: Vec<SheetShape> = panel.impulses.iter().flat_map(|impulse| arrow(impulse, &scale)).collect();
        let limit_lines: Vec<SheetShape> = self.limits.iter().map(|(limit, _)| level(&scale, *limit)).collect();
        let mark = |extreme: &DiagramExtreme| {
            SheetShape::Entity(Entity::Circle(scale.within(extreme.place, extreme.value), MARK))
        };
        let marks: Vec<SheetShape> = self.marked(&window).map(mark).collect();
        let room =
            Extents { least: self.field.least.add_scalar(INSET), largest: self.field.largest.add_scalar(-INSET) };
        let mut taken = OccupiedPaper::none(room);
        [&law, &cut, &impulses, &limit_lines, &marks].into_iter().flatten().for_each(|shape| taken.put(shape));
        let (labels, complete) = self.labels(&scale, &mut taken);
        let fields: Vec<Extents> = labels.iter().filter_map(SheetShape::text_field).collect();
        let (grid, zero, numbers) = self.grid(&scale, &fields);
        let titled = self.title();
        let separators = diagram.segments.iter().map(|segment| segment.range.0).filter(|at| *at > diagram.range.0);
        let upright = |at: f64| {
            let x = scale.x(at);
            around(Vector2::new(x, self.field.least.y), Vector2::new(x, self.field.largest.y), &fields)
        };
        let group = |class: &'static str, what: &str, shapes: Vec<SheetShape>| ShapeGroup {
            id: format!("diagram-{what}-{}", self.index),
            label: format!("{}: {}", panel.name, what.replace('-', " ")).into(),
            ..ShapeGroup::new(class, "", shapes)
        };
        let limit = ShapeGroup { colour: Some("#b3261e".into()), ..group("curve", "limit", limit_lines) };
        let marks = ShapeGroup { colour: Some("#222222".into()), ..group("curve", "marks", marks) };
        let groups = vec![
            group("trace-grid", "grid", grid),
            group("rule", "frame", [rectangle(&self.field), zero].concat()),
            group("rule", "segments", separators.flat_map(upright).collect()),
            limit,
            group("trace-cut", "as-cut", cut),
            group("trace-motion", "by-the-motion", law),
            group("dimension", "infinite", impulses),
            marks,
            group("dimension", "labels", labels),
            group("trace-grid", "numbers", numbers),
            group("facts", "title", titled),
        ];
        let groups = groups.into_iter().filter(|group| !group.shapes.is_empty()).collect();
        DrawnPanel { groups, window, complete }
    }

    fn paths(&self, runs: &[DiagramRun], scale: &PanelScale) -> Vec<SheetShape> {
        let (first, last) = self.diagram.range;
        let lines = lines(runs, &scale.window, self.panel.radius, last - first);
        let path = |line: DiagramRun| {
            SheetShape::Path(line.into_iter().map(|[place, value]| scale.at(place, value)).collect())
        };
        lines.into_iter().map(path).collect()
    }

    /// The extremes that are marked: a radius beyond the window is where no curve is.
    fn marked(&self, window: &ValueWindow) -> impl Iterator<Item = &DiagramExtreme> {
        let (window, radius) = (*window, self.panel.radius);
        self.panel.extremes.iter().filter(move |extreme| !radius || window.holds(extreme.value))
    }

    /// The labels of extremes, impulses and limits, and whether those of the whole diagram all found room.
    fn labels(&self, scale: &PanelScale, taken: &mut OccupiedPaper) -> (Vec<SheetShape>, bool) {
        let (mut shapes, mut complete) = (Vec::new(), true);
        let (overall, others): (Vec<&DiagramExtreme>, Vec<&DiagramExtreme>) =
            self.marked(&scale.window).partition(|extreme| extreme.overall);
        for extreme in overall.into_iter().chain(others) {
            let at = scale.within(extreme.place, extreme.value);
            let found = label(taken, at, extreme.upwards, &self.diagram.words(self.panel, extreme), extreme.overall);
            complete &= !(found.is_empty() && extreme.overall);
            shapes.extend(found);
        }
        for impulse in &self.panel.impulses {
            shapes.extend(label(taken, tip(impulse, scale), !impulse.upwards, "∞", false));
        }
        for (limit, text) in self.limits {
            let at = scale.at(scale.range.1, *limit) - Vector2::new(0.1 * self.field.size().x, 0.0);
            shapes.extend(label(taken, at, *limit > 0.0, text, false));
        }
        (shapes, complete)
    }

    /// The lines of the grid, that of zero, and the numbers of the values.
    fn grid(&self, scale: &PanelScale, fields: &[Extents]) -> (Vec<SheetShape>, Vec<SheetShape>, Vec<SheetShape>) {
        let (mut grid, mut zero, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
        let (first, last) = self.diagram.range;
        for place in self.grid.iter().filter(|place| **place > first && **place < last) {
            let x = scale.x(*place);
            let ends = [self.field.least.y, self.field.largest.y].map(|y| Vector2::new(x, y));
            grid.extend(around(ends[0], ends[1], fields));
        }
        let range = scale.window.high - scale.window.low;
        let is_apart = |step: &f64| (scale.at(first, *step) - scale.at(first, 0.0)).y.abs() >= LEAST_STEP;
        let steps = LINES.into_iter().map(|lines| round_step(range, lines));
        let step = steps.clone().find(is_apart).or_else(|| steps.clone().next_back()).unwrap_or(range);
        let mut number = (scale.window.low / step).ceil();
        while number * step <= scale.window.high + 1e-9 * step {
            let [from, to] = [first, last].map(|place| scale.at(place, number * step));
            if number == 0.0 { &mut zero } else { &mut grid }.extend(around(from, to, fields));
            let base = from - Vector2::new(0.4 * SIZE, 0.36 * SIZE);
            let (least, largest) = (self.field.least.y, self.field.largest.y);
            let inside = base.y - font::DESCENT * SIZE >= least - 0.6 && base.y + font::ASCENT * SIZE <= largest + 0.6;
            if inside {
                let text = rounded(number * step);
                let (text, size) = font::fitted_in_one(&text, SIZE, NUMBERS - 0.8 * SIZE);
                numbers.push(words(base, size, TextAnchor::End, text));
            }
            number += 1.0;
        }
        (grid, zero, numbers)
    }

    /// The name of the quantity with its unit, to the left of the numbers.
    fn title(&self) -> Vec<SheetShape> {
        let text = format!("{}, {}", self.panel.name, self.panel.unit);
        let room = Vector2::new(TITLES - 2.0, self.field.size().y);
        let (lines, size) = font::fitted(&text, 1.15 * SIZE, room.x, room.y);
        let x = self.field.least.x - NUMBERS - TITLES;
        #[expect(clippy::cast_precision_loss, reason = "a few lines")]
        let tall = size * (font::ASCENT + font::LEADING * (lines.len() - 1) as f64);
        let mut y = 0.5 * (self.field.least.y + self.field.largest.y) + 0.5 * tall - font::ASCENT * size;
        let mut shapes = Vec::new();
        for line in lines {
            shapes.push(words(Vector2::new(x, y), size, TextAnchor::Start, line));
            y -= font::LEADING * size;
        }
        shapes
    }
}

/// A level line across the panel.
fn level(scale: &PanelScale, value: f64) -> SheetShape {
    let (first, last) = scale.range;
    SheetShape::Line(scale.at(first, value), scale.at(last, value))
}

/// Where the arrow of an impulse ends: at the frame.
fn tip(impulse: &Impulse, scale: &PanelScale) -> Vector2<f64> {
    let y = if impulse.upwards { scale.field.largest.y } else { scale.field.least.y };
    Vector2::new(scale.x(impulse.place), y)
}

/// An arrow from zero to the frame.
fn arrow(impulse: &Impulse, scale: &PanelScale) -> Vec<SheetShape> {
    let (foot, tip) = (scale.within(impulse.place, 0.0), tip(impulse, scale));
    let back = tip - Vector2::new(0.0, libm::copysign(HEAD.y, tip.y - foot.y));
    let side = Vector2::new(0.5 * HEAD.x, 0.0);
    vec![SheetShape::Line(foot, back), SheetShape::Triangle([tip, back + side, back - side])]
}

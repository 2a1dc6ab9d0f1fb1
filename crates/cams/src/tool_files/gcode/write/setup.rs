//! The setup sheet of a program: blank, zero, start, clamping area, the tool, and the cuts in their order with their times.

use super::super::blank::Blank;
use super::super::plan::entry::{Descent, Entry};
use super::super::plan::milling::{LevelCut, MillingPass, MillingProgram};
use super::home;
use crate::machine::Coolant;
use crate::report::sheet::{
    Dimensions, Mark, PlaceTable, ShapeGroup, SheetExtras, SheetKind, SheetShape, SheetView, TitleFacts, compose,
};
use crate::report::shown;
use crate::verify::WrittenOutline;
use crate::write::{Rendering, svg};
use camgen_kernel::document::NamedChoice;
use camgen_kernel::geometry::blocks::Block;
use camgen_kernel::geometry::contour::Extents;
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{Length, Text, text};
use nalgebra::Vector2;

/// What is added to the stem of its name.
pub(in super::super) const SHEET: &str = "-setup.svg";

/// Rows of the table of cuts; further depths are counted in a remark.
const MOST_ROWS: usize = 24;
/// Distance of the clamps from the profile, mm.
const CLEAR: f64 = 2.0;
/// Half the length of the cross at the zero, as a share of what is shown.
const CROSS: f64 = 0.12;

/// The sheet of the program of a part.
pub(in super::super) fn sheet(cam: &Rendering<'_>, program: &MillingProgram) -> Result<Vec<u8>, Refusal> {
    let outlines: Vec<&WrittenOutline> =
        program.cuts.iter().filter_map(|cut| cam.outlines.iter().find(|outline| outline.cut == *cut)).collect();
    let view = Setup { cam, program, outlines }.view();
    let deviates = svg::deviation_words(&cam.fit, cam.report.units);
    let extras = SheetExtras {
        kind: SheetKind::Setup,
        files: &[],
        file_deviates: &deviates,
        number: "1/1",
        traces: &[],
        checks: &[],
        passed_otherwise: 0,
    };
    svg::fill(&compose(&view, cam.report, &extras), cam.template, true, &cam.report.mark())
}

struct Setup<'a> {
    cam: &'a Rendering<'a>,
    program: &'a MillingProgram,
    outlines: Vec<&'a WrittenOutline>,
}

impl Setup<'_> {
    fn view(&self) -> SheetView {
        let machine = self.cam.body.machine();
        let mut groups: Vec<ShapeGroup> = Vec::new();
        if let Some(blank) = &self.program.blank {
            groups.push(
                ShapeGroup { id: "blank".into(), ..ShapeGroup::new("side", "blank", of_blank(blank)) }.with_legend(),
            );
        }
        let outline = |outline: &&WrittenOutline| SheetShape::Entity(Entity::Polyline(outline.contour.clone()));
        groups.push(ShapeGroup::new("outline", "outline", self.outlines.iter().map(outline).collect()).with_legend());
        let path = ShapeGroup::new("lead-in", "path of the finishing passes", self.path());
        groups.push(ShapeGroup { id: "program-path".into(), ..path }.with_legend());
        let (clamped, clamping) = self.clamping();
        if let Some(radius) = clamped {
            let circle = vec![SheetShape::Entity(Entity::Circle(Vector2::zeros(), radius))];
            groups.push(
                ShapeGroup { id: "clamping".into(), ..ShapeGroup::new("hidden", "limit of the clamps", circle) }
                    .with_legend(),
            );
        }
        let shown = crate::report::sheet::extents_of(&groups);
        let half = CROSS * shown.size().max();
        let [x, y] = [Vector2::new(half, 0.0), Vector2::new(0.0, half)];
        let cross = vec![SheetShape::Line(-x, x), SheetShape::Line(-y, y)];
        groups.push(ShapeGroup { id: "zero".into(), ..ShapeGroup::new("axis", "zero", cross) }.with_legend());
        SheetView {
            groups,
            marks: self.marks(),
            tables: vec![self.tool(), self.cuts()],
            facts: TitleFacts::of(machine, None),
            notes: self.notes(clamping),
            lost: Vec::new(),
        }
    }

    /// The passes at size, to the first and from the last point at their depth.
    fn path(&self) -> Vec<SheetShape> {
        let mut shapes = Vec::new();
        let passes =
            self.program.level_cuts().filter(|(pass, cut, _)| !pass.is_roughing && cut.pass < self.outlines.len());
        let mut drawn = Vec::new();
        for (pass, cut, descent) in passes {
            if drawn.contains(&cut.pass) {
                continue;
            }
            drawn.push(cut.pass);
            let mut from = pass.start;
            let way_in = [descent.at, pass.level_start(), pass.start];
            let way_in = if descent.is_away { &way_in[..] } else { &way_in[1..] };
            shapes.push(SheetShape::Path(way_in.to_vec()));
            for block in &pass.blocks {
                shapes.push(match block {
                    Block::Line { to } => SheetShape::Line(from, *to),
                    Block::Arc { to, centre, left } => {
                        let arc = super::super::plan::milling::arc(from, *to, *centre, *left);
                        SheetShape::Arc(arc.start, arc.end, arc.bulge)
                    }
                });
                from = block.to();
            }
        }
        shapes
    }

    /// Radius about the zero inside or outside of which the clamps are free of the cutter, mm, and the sentence about it.
    fn clamping(&self) -> (Option<f64>, Text) {
        let hollow = self.program.blank.is_none();
        if matches!(self.program.blank, Some(Blank::Rectangle(_))) {
            return (None, text!("clamp inside the outline, {} clear of it", Length::mm(CLEAR)));
        }
        let trees: Vec<EdgeTree> = self.outlines.iter().map(|outline| EdgeTree::new(&outline.contour)).collect();
        if hollow {
            let far = |outline: &&WrittenOutline| {
                let ends = outline.contour.edges().flat_map(|edge| [edge.start().norm(), edge.middle().norm()]);
                ends.fold(0.0, f64::max)
            };
            let radius = self.outlines.iter().map(far).fold(0.0, f64::max) + CLEAR;
            return (Some(radius), text!("clamp outside Ø{} about the zero", Length::mm(2.0 * radius)));
        }
        let nearest = trees.iter().filter_map(|tree| tree.nearest(Vector2::zeros())).map(|nearest| nearest.foot.norm());
        let radius = nearest.fold(f64::INFINITY, f64::min) - CLEAR;
        if radius > 0.0 && radius.is_finite() {
            (
                Some(radius),
                text!(
                    "clamp inside Ø{} about the zero: a washer and a screw through the bore",
                    Length::mm(2.0 * radius)
                ),
            )
        } else {
            (None, text!("clamp inside the outline, {} clear of it", Length::mm(CLEAR)))
        }
    }

    fn marks(&self) -> Vec<Mark> {
        let units = self.cam.report.units;
        let up = Vector2::new(1.0, 1.0).normalize();
        let label = |at: Vector2<f64>, towards: Vector2<f64>, text: String| Mark::Label {
            class: "dimensions",
            at,
            towards,
            text,
        };
        let mut marks = vec![label(Vector2::zeros(), up, "X0 Y0 Z0 on the upper face".into())];
        if let Some((pass, _, descent)) = self.program.level_cuts().next() {
            let [x, y] = [descent.at.x, descent.at.y].map(|at| units.cell(at));
            let towards = descent.at.try_normalize(1e-9).unwrap_or(up);
            marks.push(label(descent.at, towards, format!("start X{x} Y{y}")));
            let along = (pass.level_start() - descent.at).try_normalize(1e-9);
            marks.extend(along.map(|along| Mark::Start {
                at: descent.at,
                along,
                outward: towards,
                text: "start of the program".into(),
            }));
        }
        if let Some(blank) = &self.program.blank {
            let (size, sign) = match blank {
                Blank::Round(radius) => {
                    let corner = Vector2::new(*radius, *radius);
                    (Extents { least: -corner, largest: corner }, "Ø")
                }
                Blank::Rectangle(extents) => (*extents, ""),
            };
            let low = size.least;
            let text = |length: f64| format!("{sign}{}", units.dimension((length * 1e2).round() / 1e2));
            let width = (Vector2::new(size.largest.x, low.y), Vector2::new(0.0, -1.0), size.size().x);
            let height = (Vector2::new(low.x, size.largest.y), Vector2::new(-1.0, 0.0), size.size().y);
            let is_round = matches!(blank, Blank::Round(_));
            for (to, away, length) in [Some(width), Some(height).filter(|_| !is_round)].into_iter().flatten() {
                // The dimension of a circle is between its extreme points.
                let middle = Vector2::new(0.0, if is_round { -low.y } else { 0.0 });
                marks.push(Mark::Distance { from: low + middle, to: to + middle, away, text: text(length) });
            }
        }
        marks
    }

    /// The tool that the program presumes.
    fn tool(&self) -> PlaceTable {
        let (program, units) = (self.program, self.cam.report.units);
        let cutting = &program.cutting;
        let number = cutting.tool.map_or_else(|| "by hand".to_owned(), |tool| format!("T{tool}"));
        let diameter = match program.cutter {
            Some(radius) => format!("Ø{}", units.dimension(2.0 * MILLIMETRES * radius)),
            None => format!("below Ø{}", units.dimension(2.0 * program.largest_kept().unwrap_or(0.0))),
        };
        let depth = program.depths.last().copied().unwrap_or(0.0);
        let reach = format!("{} {}", units.dimension(depth + MILLIMETRES * cutting.clearance), units.symbol());
        let speed = cutting.spindle.map_or_else(|| "by hand".to_owned(), |speed| format!("{} 1/min", shown(speed)));
        let heads = ["tool", "diameter", "free length at least", "spindle", "coolant"].map(str::to_owned).to_vec();
        let coolant = cutting.coolant.word_of_key().to_owned();
        table("Tool", heads, Vec::new(), vec![vec![number, diameter, reach, speed, coolant]])
    }

    /// The cuts in their order.
    fn cuts(&self) -> PlaceTable {
        let (program, units) = (self.program, self.cam.report.units);
        let feed = |speed: f64| shown(units.of_mm(60.0 * MILLIMETRES * speed));
        let all: Vec<(&MillingPass, LevelCut, Descent)> = program.level_cuts().collect();
        let row = |(index, (pass, cut, descent)): (usize, &(&MillingPass, LevelCut, Descent))| {
            vec![
                (index + 1).to_string(),
                pass.words.clone(),
                units.cell(-cut.depth),
                way_down(pass, cut, descent).to_owned(),
                feed(program.cutting.feed),
                hundredths(program.minutes(pass, descent)),
            ]
        };
        let rows: Vec<Vec<String>> = all.iter().enumerate().take(MOST_ROWS).map(row).collect();
        let total: f64 = all.iter().map(|(pass, _, descent)| program.minutes(pass, descent)).sum();
        let unit = units.symbol();
        let down = feed(program.cutting.plunge_feed);
        let noun = if all.len() == 1 { "cut" } else { "cuts" };
        let mut remarks = vec![format!(
            "{} {noun}, {} min at the feeds, rapid moves not counted; feed down {down} {unit}/min",
            all.len(),
            hundredths(total)
        )];
        if all.len() > MOST_ROWS {
            remarks.push(format!("the first {MOST_ROWS} of them"));
        }
        let heads = ["no.", "cut", &format!("Z, {unit}"), "down", &format!("feed, {unit}/min"), "min"];
        table("Cuts in their order", heads.map(str::to_owned).to_vec(), remarks, rows)
    }

    fn notes(&self, clamping: Text) -> Vec<Text> {
        let program = self.program;
        let cutting = &program.cutting;
        let plunges = program.passes.iter().any(|pass| pass.entry == Entry::Plunge);
        let heights = text!(
            "moves in X and Y at Z {}, fast down to Z {}",
            Length::mm(MILLIMETRES * cutting.safe_height),
            Length::mm(MILLIMETRES * cutting.clearance)
        );
        let home = match home(program) {
            None => text!("Z first goes to its reference point (G28)"),
            Some(z) => text!("Z first goes to {} of the machine", Length::mm(MILLIMETRES * z)),
        };
        let mut notes = vec![
            text!(
                "control {}; set by hand: the zero G54, the tool and its length, {}",
                program.controller.word(),
                match program.cutter {
                    Some(_) => "no radius: the program is the path of its centre",
                    None => "and its radius, by which the control keeps it on the profile",
                }
            ),
            clamping,
            heights,
            home,
        ];
        if let Some(extents) = program.extents() {
            let depth = program.depths.last().copied().unwrap_or(0.0);
            notes.push(text!(
                "tool's point: X {} to {}, Y {} to {}, Z {} to {}",
                Length::mm(extents.least.x),
                Length::mm(extents.largest.x),
                Length::mm(extents.least.y),
                Length::mm(extents.largest.y),
                Length::mm(-depth),
                Length::mm(MILLIMETRES * cutting.safe_height)
            ));
        }
        if plunges {
            notes.push(text!("the cutter goes straight down where a pass starts: drill there before, or use one that cuts at its centre"));
        }
        if program.blank.is_some() {
            notes.push(text!("nothing may stand beside the blank where the program starts"));
        }
        notes.push(text!("bore, keyway and holes are not in the program"));
        notes
    }
}

fn table(title: &str, heads: Vec<String>, remarks: Vec<String>, rows: Vec<Vec<String>>) -> PlaceTable {
    PlaceTable { title: title.to_owned(), remarks, heads, rows: PlaceTable::regular_rows(rows), every: 1 }
}

fn of_blank(blank: &Blank) -> Vec<SheetShape> {
    match blank {
        Blank::Round(radius) => vec![SheetShape::Entity(Entity::Circle(Vector2::zeros(), *radius))],
        Blank::Rectangle(Extents { least, largest }) => {
            let corners =
                [*least, Vector2::new(largest.x, least.y), *largest, Vector2::new(least.x, largest.y), *least];
            vec![SheetShape::Path(corners.to_vec())]
        }
    }
}

/// A time with two decimals.
fn hundredths(minutes: f64) -> String {
    shown((1e2 * minutes).round() / 1e2)
}

/// How the cutter reaches the depth of a cut.
fn way_down(pass: &MillingPass, cut: &LevelCut, descent: &Descent) -> &'static str {
    match &pass.entry {
        _ if !descent.ramp.is_empty() => "ramp",
        Entry::Outside(_) => "beside the blank",
        _ if cut.before >= cut.depth => "in the cut",
        _ => "straight",
    }
}

impl Coolant {
    /// Its word in a machine file.
    fn word_of_key(self) -> &'static str {
        match self {
            Self::Off => "off",
            Self::Mist => "mist",
            Self::Flood => "flood",
        }
    }
}

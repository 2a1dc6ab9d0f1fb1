//! What the control of a milling machine makes of a written program, compared with the exact cam.
//!
//! The moves are as they are read back from the bytes. Between the upper face and the depth every level pass must close round a flank of the
//! part: what the cutter leaves along it is followed along the exact profile, as for the path of a cutter (`cutter_path`), or is farther out by `cut.allowance`. Each
//! flank must be cut to the full depth, ramps, lead-ins and lead-outs must keep clear of the metal, and no rapid move may go below the upper face, nor any
//! move straight down into the blank.

use super::super::blank::Blank;
use super::super::read::{CutterMove, CutterProgram, CutterSide, MoveKind};
use super::cutting::{SAME_DEPTH, as_designed, leaves_its_path, not_too_deep_at_once};
use super::entry::{is_ramp, not_too_steep, of_plunge};
use super::program::{JudgedProgram, ProgramFault, WrittenProgram, remarks};
use super::turned;
use crate::body::{Cut, Layer, groove_width};
use crate::check::{Check, CheckExplanation, CheckScope};
use crate::machine::{CutterEntry, MillingDirection};
use crate::report::{Bound, Finding, Verdict, shown};
use crate::verify::{Evidence, left_behind, moved_inwards, place};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::{Contour, Edge, Segment};
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::geometry::lead_in;
use camgen_kernel::text::{Length, Text, text};
use nalgebra::Vector2;

pub(in super::super) const CHECK: Check = Check {
    name: "program",
    on: CheckScope::ToolFile,
    unit: "mm",
    about: "The largest distance between the exact profile and what the cutter leaves along the passes of the program as its control reads \
            it, in both directions; also how deep a lead-in or lead-out cuts into the cam. Every flank must be cut to its depth, and no rapid \
            move may go below the upper face, nor any move straight down into the blank.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max distance between the parallel of each pass at the cutter's radius and the exact profile",
        usual: "the tolerance, on the side of --side",
        change: "a finer --tolerance, more cut.decimals, or another --start",
    },
};

/// Places nearer than this are one, mm: far below the numbers of a program.
const SAME_PLACE: f64 = 1e-7;
/// Depths of lead-ins and lead-outs are found to within this share of the tolerance.
const FINE_SHARE: f64 = 0.1;

/// The finding where there is no program.
pub(in super::super) fn no_program(evidence: &Evidence<'_>, why: String) -> Finding {
    failure(evidence, ProgramFault::new(why))
}

fn failure(evidence: &Evidence<'_>, fault: ProgramFault) -> Finding {
    let found = CHECK.found(fault.value, Some(evidence.tolerance_mm), Verdict::Fail);
    let place = fault.at.map_or(found.place, |at| place(evidence.body, at));
    Finding { place, note: Some(fault.why.into()), ..found }
}

/// The finding on the programs of a cam.
pub(in super::super) fn judge(evidence: &Evidence<'_>, programs: &[WrittenProgram]) -> Option<Finding> {
    let limit = evidence.tolerance_mm;
    let mut worst: Option<JudgedProgram> = None;
    for written in programs {
        match judged(evidence, written).and_then(|found| as_designed(evidence, written).map(|()| found)) {
            Err(fault) => return Some(failure(evidence, fault)),
            Ok(next) if worst.as_ref().is_none_or(|worst| next.value > worst.value) => worst = Some(next),
            Ok(_) => {}
        }
    }
    let worst = worst?;
    let found = CHECK.found(worst.value, Some(limit), Verdict::Pass);
    Some(Finding { place: place(evidence.body, worst.at), note: Some(worst.note), ..found })
}

/// Whether radius compensation is on for at least half of the level cutting moves.
pub(in super::super) fn keeps_its_cutter(program: &CutterProgram) -> bool {
    let level = |moved: &&CutterMove| {
        moved.kind != MoveKind::Rapid && moved.from[2] < 0.0 && moved.is_level() && !moved.is_upright()
    };
    let cuts = program.moves.iter().filter(level).count();
    let kept = program.moves.iter().filter(level).filter(|moved| moved.side != CutterSide::Centre).count();
    // A cam turned under its tool has passes instead of moves, without compensation.
    program.turned.is_empty() && 2 * kept >= cuts
}

/// A pass: moves at one depth, without those before and behind it.
struct LevelPass<'m> {
    /// mm below the upper face.
    depth: f64,
    /// The ramp to its depth.
    ramp: &'m [CutterMove],
    moves: &'m [CutterMove],
    /// The side of the cutter as it goes down.
    side_before: CutterSide,
}

/// The passes of a program, in the order of its moves.
fn passes(program: &CutterProgram) -> Result<Vec<LevelPass<'_>>, ProgramFault> {
    let mut passes = Vec::new();
    let mut first = None;
    for (index, moved) in program.moves.iter().enumerate() {
        let deepest = moved.from[2].min(moved.to[2]);
        let cuts = deepest < -SAME_PLACE;
        let line = moved.line;
        if moved.kind == MoveKind::Rapid {
            let leaves = moved.is_upright() && moved.to[2] > moved.from[2];
            if cuts && !leaves {
                return Err(ProgramFault::new(format!("a rapid move in line {line} goes below the upper face")));
            }
        } else if cuts && is_ramp(moved) {
            not_too_steep(moved)?;
        } else if cuts && !moved.is_level() && !moved.is_upright() {
            return Err(ProgramFault::new(format!("a move in line {line} rises across the part below the upper face")));
        }
        let plunges = cuts && moved.to[2] < moved.from[2] && moved.kind != MoveKind::Rapid;
        let goes_on = |next: &CutterMove| {
            let down = next.to[2] < next.from[2];
            next.kind != MoveKind::Rapid && (down || (next.is_level() && !next.is_upright()))
        };
        if plunges && !program.moves.get(index + 1).is_some_and(goes_on) {
            return Err(ProgramFault::new(format!("the cutter goes down in line {line}, and no pass begins there")));
        }
        let level = cuts && moved.is_level() && moved.kind != MoveKind::Rapid;
        match (level, first) {
            (true, None) => first = Some(index),
            (false, Some(start)) => {
                passes.extend(pass(program, start, index));
                first = None;
            }
            _ => {}
        }
    }
    passes.extend(first.and_then(|start| pass(program, start, program.moves.len())));
    if passes.is_empty() { Err(ProgramFault::new("the program cuts nothing")) } else { Ok(passes) }
}

fn pass(program: &CutterProgram, start: usize, end: usize) -> Option<LevelPass<'_>> {
    let moves = program.moves.get(start..end)?;
    let before = program.moves.get(..start)?;
    let sloping = before.iter().rev().take_while(|moved| is_ramp(moved)).count();
    let ramp = before.get(start - sloping..)?;
    let side_before = before.last().map_or(CutterSide::Centre, |moved| moved.side);
    Some(LevelPass { depth: -moves.first()?.to[2], ramp, moves, side_before })
}

/// What the first pass of a program leaves, counter-clockwise; `None` where it does not close, or the way round it leaves nothing.
pub(in super::super) fn left_by(written: &WrittenProgram) -> Option<Contour> {
    let passes = passes(written.program.as_ref().ok()?).ok()?;
    let pass = ClosedPass::of(passes.first()?).ok()?;
    match written.cutter {
        Some(radius) => moved_inwards(&pass.contour, radius),
        None => Some(pass.contour),
    }
}

/// The moves of a pass that close, and those before and behind them.
struct ClosedPass<'m> {
    ramp: &'m [CutterMove],
    way_in: &'m [CutterMove],
    round: &'m [CutterMove],
    way_out: &'m [CutterMove],
    contour: Contour,
    /// Whether the loop runs counter-clockwise.
    left: bool,
    /// The side of the cutter as it goes down.
    side_before: CutterSide,
}

impl<'m> ClosedPass<'m> {
    fn of(pass: &LevelPass<'m>) -> Result<Self, ProgramFault> {
        let moves = pass.moves;
        let line = moves.first().map_or(0, |moved| moved.line);
        let meets = |start: usize, end: usize| {
            let (start, end) = (moves.get(start)?.start(), moves.get(end)?.end());
            Some((start - end).norm() < SAME_PLACE)
        };
        let closing = |start: usize| (start..moves.len()).rev().find(|end| meets(start, *end) == Some(true));
        let found = (0..moves.len()).find_map(|start| Some((start, closing(start)?)));
        let open = || ProgramFault::new(format!("the pass from line {line} on does not close round the cam"));
        let (start, end) = found.ok_or_else(open)?;
        let (way_in, rest) = moves.split_at_checked(start).ok_or_else(open)?;
        let (round, way_out) = rest.split_at_checked(end + 1 - start).ok_or_else(open)?;
        let edges: Vec<Segment> = round.iter().flat_map(CutterMove::segments).collect();
        let contour = Contour::from_edges(edges.into_iter().map(Edge::Segment));
        let left = contour.area_and_centroid().0 > 0.0;
        let contour = if left { contour } else { contour.reversed() };
        Ok(Self { ramp: pass.ramp, way_in, round, way_out, contour, left, side_before: pass.side_before })
    }

    /// The edges of its lead-in and lead-out.
    fn ways(&self) -> impl Iterator<Item = Edge> + '_ {
        self.way_in.iter().chain(self.way_out).flat_map(CutterMove::segments).map(Edge::Segment)
    }

    /// Half of the largest difference of the radii of an arc, mm: by so much controls may differ in what they make of it.
    fn uncertain(&self) -> f64 {
        self.round.iter().map(|moved| 0.5 * moved.radii_differ()).fold(0.0, f64::max)
    }
}

/// The result for a program.
fn judged(evidence: &Evidence<'_>, written: &WrittenProgram) -> Result<JudgedProgram, ProgramFault> {
    let program = written.program.as_ref().map_err(|why| ProgramFault::new(why.clone()))?;
    if !program.turned.is_empty() {
        return turned::judged(evidence, written, program);
    }
    let (cuts, limit) = (evidence.body.cuts(), evidence.tolerance_mm);
    fits_between(&cuts, written)?;
    let passes = passes(program)?;
    let mut worst = (0.0, Vector2::zeros());
    let mut reached = vec![Reached::default(); cuts.len()];
    let mut paths: Vec<(Contour, bool)> = Vec::new();
    let mut closed = Vec::with_capacity(passes.len());
    let mut ramps = Vec::with_capacity(passes.len());
    for pass in &passes {
        let found = ClosedPass::of(pass)?;
        let Along { hollow, value, is_roughing } =
            along(evidence, written, &found, (&mut worst, &mut reached, pass.depth))?;
        sides(written, &found, hollow)?;
        if !slotted(&cuts, written) {
            sense(evidence, &found, hollow)?;
        }
        if !is_roughing && !paths.iter().any(|(known, _)| *known == found.contour) {
            paths.push((found.contour.clone(), hollow));
        }
        ramps.push(if is_roughing { 0.0 } else { value });
        closed.push(found);
    }
    let metal: Vec<EdgeTree> = paths
        .iter()
        .map(|(contour, hollow)| if *hollow { EdgeTree::new(&contour.reversed()) } else { EdgeTree::new(contour) })
        .collect();
    let trees = if slotted(&cuts, written) { &[][..] } else { metal.as_slice() };
    for way in closed.iter().flat_map(ClosedPass::ways) {
        let deep = trees.iter().map(|tree| lead_in::depth(tree, &way, FINE_SHARE * limit)).fold(0.0, f64::max);
        if deep > limit {
            let why = format!("a lead-in or lead-out cuts {} mm into the cam", shown(deep));
            return Err(ProgramFault { why, value: deep, at: Some(way.start()) });
        }
    }
    if written.cutter.is_some() {
        for (pass, value) in closed.iter().zip(&ramps) {
            pass.ramp_is_clear(trees, (*value, limit))?;
        }
    }
    let design = evidence.body.machine().cutting();
    let plunges = match design.entry {
        CutterEntry::Plunge => Text::default(),
        CutterEntry::Auto => {
            let is_plate = cuts.iter().any(|cut| cut.curves.is_some_and(|curves| curves.motion.period().is_none()));
            let outer = paths.iter().filter(|(_, hollow)| !hollow && groove_width(&cuts).is_none());
            let (off, margin) = (written.cutter.unwrap_or(0.0), MILLIMETRES * design.blank_margin());
            let blank = Blank::around(outer.flat_map(|(path, _)| path.edges()), (off, margin), is_plate);
            let radius = written.cutter.or(written.kept).or(written.presumed).unwrap_or(0.0);
            of_plunge(&program.moves, blank.as_ref(), (radius, written.knows_blank))?
        }
    };
    let room =
        if written.cutter.is_none() { cleared(&closed, &metal, (written.kept, limit))? } else { Text::default() };
    deep_enough(&cuts, written, &reached)?;
    if program.side_at_end != CutterSide::Centre {
        return Err(ProgramFault::new("the program ends while the control keeps the cutter beside its path"));
    }
    let blocks = program.moves.len();
    let how = match written.cutter {
        Some(radius) => text!("the centre of a cutter Ø{}", Length::mm(2.0 * radius)),
        None => "the profile, along which the control keeps its cutter".into(),
    };
    let unknown = text!("{}{}{}{}", room, plunges, remarks(evidence.body, written), leaves_its_path(program, limit));
    let (depth, passes) = (passes.iter().map(|pass| pass.depth).fold(0.0, f64::max), passes.len());
    let noun = if passes == 1 { "pass" } else { "passes" };
    let note = text!(
        "{}, {} moves in {} {} to {}, as the control reads them{}",
        how,
        blocks,
        passes,
        noun,
        Length::mm(depth),
        unknown
    );
    Ok(JudgedProgram { value: worst.0, at: worst.1, note })
}

/// Radii of cutters up to which their way is judged where none is given, mm, and halvings in which the largest one is found.
const LARGEST_KEPT: f64 = 25.0;
const RADIUS_HALVINGS: u32 = 20;
/// The least radius of a cutter that can be meant, mm.
const LEAST_KEPT: f64 = 0.05;

/// What a note says of the room of a cutter while the control takes up its radius; a fault if a given one, or any, cuts into the metal there.
fn cleared(
    closed: &[ClosedPass<'_>],
    metal: &[EdgeTree],
    (radius, limit): (Option<f64>, f64),
) -> Result<Text, ProgramFault> {
    let ways: Vec<TakingUp> = closed.iter().flat_map(|pass| [pass.taking_up(), pass.ending()]).collect();
    let deepest = |radius: f64| {
        let depths = ways.iter().map(|way| (way.depth(metal, (radius, FINE_SHARE * limit)), way.at()));
        depths.fold((0.0, None), |worst, next| if next.0 > worst.0 { next } else { worst })
    };
    if let Some(radius) = radius {
        let (deep, at) = deepest(radius);
        if deep <= limit {
            return Ok(Text::default());
        }
        let (diameter, depth) = (shown(2.0 * radius), shown(deep));
        let why = format!(
            "a cutter Ø{diameter} mm cuts {depth} mm into the cam as the control takes up its radius or ends it"
        );
        return Err(ProgramFault { why, value: deep, at });
    }
    if deepest(LARGEST_KEPT).0 <= limit {
        return Ok(Text::default());
    }
    let (mut clear, mut wide) = (0.0, LARGEST_KEPT);
    for _ in 0..RADIUS_HALVINGS {
        let middle = 0.5 * (clear + wide);
        *(if deepest(middle).0 <= limit { &mut clear } else { &mut wide }) = middle;
    }
    if clear < LEAST_KEPT {
        let why = "every cutter cuts into the cam as the control takes up its radius or ends it".to_owned();
        return Err(ProgramFault { why, value: f64::INFINITY, at: deepest(wide).1 });
    }
    let largest = (TENTHS * clear).floor() / TENTHS;
    Ok(text!(
        "; a cutter of a radius up to {} is clear of the cam there, --cutter-diameter judges another",
        Length::mm(largest)
    ))
}

/// Radii are named in tenths of a millimetre.
const TENTHS: f64 = 10.0;

/// The way of a cutter at the end of a pass on which the control takes up its radius, in the sense towards the profile.
struct TakingUp {
    /// Before the control does so: of the centre itself.
    plain: Vec<Segment>,
    /// From there on.
    kept: Vec<Segment>,
    /// 1 if the cutter is on the left of this way, −1 if on the right.
    side: f64,
    /// Whether the radius was taken up before the cutter went down.
    is_taken_up: bool,
    /// The end on the profile.
    end: Vector2<f64>,
}

impl TakingUp {
    fn depth(&self, metal: &[EdgeTree], (radius, fine): (f64, f64)) -> f64 {
        let mut centre = self.plain.clone();
        if !self.is_taken_up {
            centre.extend(lead_in::path_of_centre(&self.kept, self.side, radius));
        }
        if self.plain.is_empty() && self.kept.is_empty() && !self.is_taken_up {
            // The cutter goes down on the profile.
            centre.push(Segment { start: self.end, end: self.end, bulge: 0.0 });
        }
        lead_in::depth_along(metal, &centre, radius, fine)
    }

    fn at(&self) -> Option<Vector2<f64>> {
        self.plain.iter().chain(&self.kept).map(|segment| segment.start).next()
    }
}

impl ClosedPass<'_> {
    /// Refuses a ramp of the cutter's centre that goes deeper into the metal than the tolerance, with what its pass is off already, mm. Without metal on either
    /// side of a path, as in a groove that the cutter fills, it must keep to the path itself.
    fn ramp_is_clear(&self, metal: &[EdgeTree], (value, limit): (f64, f64)) -> Result<(), ProgramFault> {
        /// Points of a line at which its distance from the path is taken.
        const COMPARED: u32 = 8;
        let path = if metal.is_empty() { Some(EdgeTree::new(&self.contour)) } else { None };
        for moved in self.ramp {
            let Some(way) = moved.segments().first().copied() else { continue };
            let deep = match &path {
                None => lead_in::depth_along(metal, &[way], 0.0, FINE_SHARE * limit),
                Some(path) => (0..=COMPARED)
                    .map(|index| way.point_and_tangent(f64::from(index) / f64::from(COMPARED)).0)
                    .map(|point| path.nearest(point).map_or(f64::INFINITY, |nearest| (nearest.foot - point).norm()))
                    .fold(0.0, f64::max),
            };
            if value + deep > limit {
                let why = format!("the ramp in line {} cuts {} mm into the cam", moved.line, shown(value + deep));
                return Err(ProgramFault { why, value: value + deep, at: Some(way.start) });
            }
        }
        Ok(())
    }

    /// The way in.
    fn taking_up(&self) -> TakingUp {
        let is_plain = |moved: &&CutterMove| moved.side == CutterSide::Centre;
        let plain = self.way_in.iter().take_while(is_plain).count();
        let (plain, kept) = self.way_in.split_at_checked(plain).unwrap_or_default();
        TakingUp {
            plain: self.ramp.iter().chain(plain).flat_map(CutterMove::segments).collect(),
            kept: kept.iter().flat_map(CutterMove::segments).collect(),
            side: self.side(),
            is_taken_up: self.side_before != CutterSide::Centre,
            end: self.round.first().map_or_else(Vector2::zeros, CutterMove::start),
        }
    }

    /// The way out, in the sense towards the profile.
    fn ending(&self) -> TakingUp {
        let kept = self.way_out.iter().take_while(|moved| moved.side != CutterSide::Centre).count();
        // The move that ends the compensation leads from beside the profile to the path itself.
        let ending = (kept + 1).min(self.way_out.len());
        let (kept_moves, plain) = self.way_out.split_at_checked(ending).unwrap_or_default();
        let segments = |moves: &[CutterMove]| -> Vec<Segment> { moves.iter().flat_map(CutterMove::segments).collect() };
        TakingUp {
            plain: lead_in::reversed(&segments(plain)),
            kept: lead_in::reversed(&segments(kept_moves)),
            side: -self.side(),
            is_taken_up: kept == self.way_out.len(),
            end: self.round.first().map_or_else(Vector2::zeros, CutterMove::start),
        }
    }

    /// 1 if the control keeps the cutter on the left of the pass, −1 if on the right.
    fn side(&self) -> f64 {
        if self.round.first().is_some_and(|moved| moved.side == CutterSide::Left) { 1.0 } else { -1.0 }
    }
}

/// How deep a flank is cut so far, mm.
#[derive(Debug, Clone, Copy, Default)]
struct Reached {
    /// To its size.
    finished: f64,
    /// With the allowance.
    roughed: f64,
}

/// The flank that a pass is along.
struct Along {
    /// Whether the metal lies around it.
    hollow: bool,
    /// How far it is off, mm.
    value: f64,
    /// Whether it keeps the allowance on it.
    is_roughing: bool,
}

/// A pass along the flanks that it cuts: at least one, and none wrongly; a roughing pass is off by the allowance.
fn along(
    evidence: &Evidence<'_>,
    written: &WrittenProgram,
    pass: &ClosedPass<'_>,
    (worst, reached, depth): (&mut (f64, Vector2<f64>), &mut [Reached], f64),
) -> Result<Along, ProgramFault> {
    let (cuts, uncertain) = (evidence.body.cuts(), pass.uncertain());
    let limit = evidence.tolerance_mm - uncertain;
    let radius = written.cutter.unwrap_or(0.0);
    let allowance = MILLIMETRES * evidence.body.machine().cutting().allowance;
    let line = pass.round.first().map_or(0, |moved| moved.line);
    if pass.ramp.iter().any(|moved| moved.side != CutterSide::Centre) {
        let why =
            format!("the ramp before line {line} is run with the compensation of the radius (G41, G42): write G40");
        return Err(ProgramFault::new(why));
    }
    let mut nearest: Option<ProgramFault> = None;
    let mut found = None;
    for (index, cut) in written.cuts.iter().filter_map(|index| Some((*index, cuts.get(*index)?))) {
        let at_size = |radius: f64| {
            let left =
                left_behind(evidence, index, (radius, written.middle), &pass.contour).map_err(ProgramFault::new)?;
            left.ok_or_else(|| ProgramFault::new("the cam has no profile here"))
        };
        let left = at_size(radius)?;
        let own = reached.get_mut(index);
        if left.kept && left.distance <= limit {
            let value = left.distance + uncertain;
            if value > worst.0 {
                *worst = (value, left.at);
            }
            if let Some(own) = own {
                not_too_deep_at_once(evidence, line, (own.finished.max(own.roughed), depth))?;
                own.finished = own.finished.max(depth);
            }
            found = Some(Along { hollow: cut.is_hollow(), value, is_roughing: false });
            continue;
        }
        if allowance > 0.0 && found.is_none() {
            let rough = at_size(radius + allowance)?;
            if rough.kept && rough.distance <= limit {
                if let Some(own) = own {
                    not_too_deep_at_once(evidence, line, (own.roughed, depth))?;
                    own.roughed = own.roughed.max(depth);
                }
                let value = rough.distance + uncertain;
                found = Some(Along { hollow: cut.is_hollow(), value, is_roughing: true });
                continue;
            }
        }
        if nearest.as_ref().is_none_or(|other| left.distance < other.value) {
            let off = shown(left.distance + uncertain);
            let fault = left.fault.map_or_else(String::new, |fault| format!("; {fault}"));
            let why = format!("the pass from line {line} on leaves another cam, off by {off} mm{fault}");
            nearest = Some(ProgramFault { why, value: left.distance + uncertain, at: Some(left.at) });
        }
    }
    found.ok_or_else(|| nearest.unwrap_or_else(|| ProgramFault::new("the cam has no such flank")))
}

/// The side on which the control keeps its cutter: none where the path is that of the centre, else that without metal, all the way round.
fn sides(written: &WrittenProgram, pass: &ClosedPass<'_>, hollow: bool) -> Result<(), ProgramFault> {
    // Counter-clockwise the metal is on the left, unless it lies around.
    let wanted = match (written.cutter, pass.left == hollow) {
        (Some(_), _) => CutterSide::Centre,
        (None, true) => CutterSide::Left,
        (None, false) => CutterSide::Right,
    };
    let word = |side: CutterSide| match side {
        CutterSide::Centre => "on its path (G40)",
        CutterSide::Left => "on the left of its path (G41)",
        CutterSide::Right => "on the right of its path (G42)",
    };
    match pass.round.iter().find(|moved| moved.side != wanted) {
        None => Ok(()),
        Some(moved) => {
            let (is, wanted) = (word(moved.side), word(wanted));
            Err(ProgramFault::new(format!("in line {} the cutter is {is}; it must be {wanted}", moved.line)))
        }
    }
}

/// The sense of milling must be that of the design: a cutter that climbs has the metal on its right.
fn sense(evidence: &Evidence<'_>, pass: &ClosedPass<'_>, hollow: bool) -> Result<(), ProgramFault> {
    let is = if pass.left == hollow { MillingDirection::Climb } else { MillingDirection::Conventional };
    let wanted = evidence.body.machine().cutting().direction;
    if is == wanted {
        return Ok(());
    }
    let word = |sense: MillingDirection| match sense {
        MillingDirection::Climb => "climb",
        MillingDirection::Conventional => "conventional",
    };
    let line = pass.round.first().map_or(0, |moved| moved.line);
    let (is, wanted) = (word(is), word(wanted));
    Err(ProgramFault::new(format!("the pass from line {line} on is {is} milling; cut.direction is {wanted}")))
}

/// Whether the cutter is as wide as the groove: it touches both flanks wherever it is on its path.
fn slotted(cuts: &[Cut<'_>], written: &WrittenProgram) -> bool {
    let width = groove_width(cuts).map(|width| MILLIMETRES * width);
    width.zip(written.cutter).is_some_and(|(width, cutter)| (width - 2.0 * cutter).abs() < SAME_PLACE)
}

/// A cutter in a groove must not be wider than it.
fn fits_between(cuts: &[Cut<'_>], written: &WrittenProgram) -> Result<(), ProgramFault> {
    let width = groove_width(cuts).map(|width| MILLIMETRES * width);
    match width.zip(written.cutter) {
        Some((width, cutter)) if 2.0 * cutter > width + SAME_PLACE => {
            let (cutter, width) = (shown(2.0 * cutter), shown(width));
            Err(ProgramFault::new(format!("a cutter Ø{cutter} mm is wider than the groove of {width} mm")))
        }
        _ => Ok(()),
    }
}

/// Every flank must be cut to the depth, and no deeper.
fn deep_enough(cuts: &[Cut<'_>], written: &WrittenProgram, reached: &[Reached]) -> Result<(), ProgramFault> {
    let Some(depth) = written.depth else { return Ok(()) };
    for index in &written.cuts {
        let (Some(cut), Some(found)) = (cuts.get(*index), reached.get(*index)) else { continue };
        let found = found.finished;
        if (found - depth).abs() > SAME_DEPTH {
            let which = match cut.layer {
                Layer::CamProfile => "the profile".to_owned(),
                layer => format!("the {} flank", layer.word()),
            };
            let (found, depth) = (shown(found), shown(depth));
            return Err(ProgramFault::new(format!("{which} is cut {found} mm deep, and must be {depth} mm deep")));
        }
    }
    Ok(())
}

//! Programs for a milling machine, in no control's words yet: passes along the flanks of a part, with lead-ins and lead-outs.
//!
//! The path is drawn anew, within what the rounding of its numbers leaves of the tolerance. With a cutter it is that of the cutter's centre,
//! else the profile, along which the control keeps its own cutter. Bore, keyway and holes are not in it. With `cut.allowance` a roughing pass along the path
//! offset by it precedes at every depth; the finishing passes then go to the full depth.

use super::super::blank::Blank;
use super::entry::{self, Descent, Entry};
use crate::body::swept::TurnedCam;
use crate::body::{Body, Cut, DrawError, Drawn, LoadAsCut, Part, Request, groove_width, start};
use crate::machine::{Controller, CutterEntry, CuttingData, MillingDirection, RadiusCompensation};
use crate::report::shown;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::blocks::{Block, Grid};
use camgen_kernel::geometry::contour::{Contour, Edge, Extents, Segment};
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::geometry::lead_in::{self, LeadInForm, depth};
use camgen_kernel::numeric::parallel;
use camgen_kernel::profile::outline::{Fit, Outline, OutlineError, SegmentKind, Side};
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;
use std::f64::consts::{FRAC_PI_8, TAU};

/// The program for a part.
#[derive(Debug, Clone, PartialEq)]
pub struct MillingProgram {
    /// Which of the parts of a drawing it is of.
    pub part: usize,
    /// Which of the cuts of the body its passes are along.
    pub cuts: Vec<usize>,
    /// The control.
    pub controller: Controller,
    /// Decimals of its numbers.
    pub decimals: u32,
    /// The unit of its lengths; here they are in mm, on the grid of its numbers.
    pub units: LengthUnit,
    /// Feeds, speeds and heights.
    pub cutting: CuttingData,
    /// Radius of the cutter whose centre is moved, m; `None` where the control keeps its cutter on the profile.
    pub cutter: Option<f64>,
    /// The finishing passes, then the roughing passes.
    pub passes: Vec<MillingPass>,
    /// The depths, mm below the upper face, from the first on.
    pub depths: Vec<f64>,
    /// The passes at their depths, in the order in which they are cut.
    pub order: Vec<LevelCut>,
    /// The blank, outside of which the cutter goes down, mm; `None` where no pass does.
    pub(in super::super) blank: Option<Blank>,
    /// The path of a cam that is turned under its tool, in the place of passes.
    pub turned: Option<TurnedPath>,
    /// Share of the tolerance for smoothing by the control, m; the path is drawn within the rest.
    pub smoothing: f64,
}

/// A pass at a depth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelCut {
    /// Index of the pass.
    pub pass: usize,
    /// Depth that is cut already along its path, mm.
    pub before: f64,
    /// Its depth, mm.
    pub depth: f64,
}

impl MillingProgram {
    /// The grid of its numbers.
    #[must_use]
    pub fn grid(&self) -> Grid {
        Grid::of_lengths(self.decimals, self.units)
    }

    /// The passes at their depths, in the order in which they are cut, with the way down to each.
    pub fn level_cuts(&self) -> impl Iterator<Item = (&MillingPass, LevelCut, Descent)> {
        self.order.iter().filter_map(|cut| {
            let pass = self.passes.get(cut.pass)?;
            Some((pass, *cut, pass.entry.descent(pass.level_start(), (cut.before, cut.depth), self.grid())))
        })
    }
}

impl MillingProgram {
    /// Time of a pass with its way down at the feeds, min.
    #[must_use]
    pub fn minutes(&self, pass: &MillingPass, descent: &Descent) -> f64 {
        let cutting = &self.cutting;
        let mut down = (MILLIMETRES * cutting.clearance - descent.z).abs();
        let mut from = (descent.at, descent.z);
        for to in &descent.ramp {
            down += libm::hypot((to.0 - from.0).norm(), to.1 - from.1);
            from = *to;
        }
        let mut along = (pass.level_start() - from.0).norm() + (pass.start - pass.level_start()).norm();
        let mut at = pass.start;
        for block in &pass.blocks {
            along += match block {
                Block::Line { to } => (to - at).norm(),
                Block::Arc { to, centre, left } => arc(at, *to, *centre, *left).length(),
            };
            at = block.to();
        }
        along += pass.compensated.map_or(0.0, |ends| (ends.to - at).norm());
        (along / cutting.feed + down / cutting.plunge_feed) / MILLIMETRES / 60.0
    }

    /// The radius below which a cutter must be that the control keeps on the profile, mm; `None` where the program moves its centre.
    #[must_use]
    pub fn largest_kept(&self) -> Option<f64> {
        self.passes.iter().filter_map(|pass| pass.compensated).map(|ends| ends.largest_radius).reduce(f64::min)
    }

    /// The smallest rectangle that holds all paths of the tool's point, mm; where the control keeps the cutter, of the largest one that it may keep.
    #[must_use]
    pub fn extents(&self) -> Option<Extents> {
        let mut all: Option<Extents> = None;
        let mut take = |next: Extents| all = Some(all.map_or(next, |all| all.with(&next)));
        let point = |at: Vector2<f64>| Extents { least: at, largest: at };
        for (pass, _, descent) in self.level_cuts() {
            take(point(descent.at));
            descent.ramp.iter().for_each(|(at, _)| take(point(*at)));
            take(point(pass.level_start()));
            take(point(pass.start));
            if let Some(ends) = pass.compensated {
                take(point(ends.to));
            }
            let mut from = pass.start;
            for block in &pass.blocks {
                let segment = match block {
                    Block::Line { to } => Segment { start: from, end: *to, bulge: 0.0 },
                    Block::Arc { to, centre, left } => arc(from, *to, *centre, *left),
                };
                take(segment.extents());
                from = block.to();
            }
        }
        let by = Vector2::repeat(self.largest_kept().unwrap_or(0.0));
        all.map(|all| Extents { least: all.least - by, largest: all.largest + by })
    }
}

/// The arc between two points about a centre.
pub(in super::super) fn arc(start: Vector2<f64>, end: Vector2<f64>, centre: Vector2<f64>, left: bool) -> Segment {
    let (from, to) = (start - centre, end - centre);
    let turn = libm::atan2(from.perp(&to), from.dot(&to));
    let sweep = match (left, turn > 0.0) {
        (true, false) => turn + TAU,
        (false, true) => turn - TAU,
        _ => turn,
    };
    Segment { start, end, bulge: libm::tan(0.25 * sweep) }
}

impl MillingPass {
    /// Where it begins at its depth, mm: with the way on which the control takes up the radius of its cutter.
    #[must_use]
    pub fn level_start(&self) -> Vector2<f64> {
        self.compensated.map_or(self.start, |ends| ends.from)
    }
}

/// The path of a tool over a cam that an axis of the machine turns.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnedPath {
    /// The letter of the axis: C of a disc that is ground, A of a barrel that is milled.
    pub axis: char,
    /// Once round each, at every depth.
    pub rounds: Vec<TurnedRound>,
}

/// Once round a cam that is turned.
#[derive(Debug, Clone, PartialEq)]
pub struct TurnedRound {
    /// What it is along, for a reader.
    pub words: String,
    /// Angle of the axis, degrees, and X and Y of the tool, mm; a control goes straight in all from row to row. Y is 0 where the axis is C.
    pub rows: Vec<[f64; 3]>,
    /// Lengths of the path on the cam from row to row, mm.
    pub lengths: Vec<f64>,
    /// Where the tool goes down, X and Y, mm.
    pub away: [f64; 2],
}

/// Once round a flank.
#[derive(Debug, Clone, PartialEq)]
pub struct MillingPass {
    /// What it is along, for a reader: "outer flank".
    pub words: String,
    /// Whether it is a roughing pass, which keeps `cut.allowance` on the flank.
    pub is_roughing: bool,
    /// How the cutter reaches its depth.
    pub entry: Entry,
    /// Whether the cutter is on the left of its path (G41), else on the right.
    pub cutter_left: bool,
    /// How the control takes up the radius of its cutter, if it keeps the cutter on the profile.
    pub compensated: Option<Compensation>,
    /// Where the cutter goes down, mm.
    pub start: Vector2<f64>,
    /// To the flank, round it, and away from it.
    pub blocks: Vec<Block>,
}

/// The ends of a pass on which the control keeps its cutter, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Compensation {
    /// Where the cutter goes down; from here to the start of the pass the control takes up its radius.
    pub from: Vector2<f64>,
    /// Where it ends the compensation.
    pub to: Vector2<f64>,
    /// The largest radius of a cutter that keeps clear of the metal on both.
    pub largest_radius: f64,
}

/// Why there is no program.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MillingError {
    /// The cutter has no path, as the check of its radius says, too.
    #[error(transparent)]
    Cutter(OutlineError),
    /// Of any other cause.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

/// Steps of the grid by which rounded arcs may lie off the ones that were drawn.
const ROUNDING: f64 = 2.0;
/// Least share of the tolerance that rounding must leave to the arcs.
const LEAST_SHARE: f64 = 0.2;
/// Radii of lead-ins and lead-outs that are tried, mm, the largest first.
const LEADS: [f64; 6] = [5.0, 2.5, 1.2, 0.6, 0.3, 0.1];
/// The same where the control keeps its cutter on the profile: its radius must be smaller.
const COMPENSATED_LEADS: [f64; 4] = [10.0, 5.0, 2.5, 1.2];
/// A lead-in of this many radii of the cutter is large enough for every control.
const LARGER: f64 = 1.1;
/// Lengths of the straight ways on which the control takes up its compensation, over the size of the lead-in, in the order in which they are tried.
const APPROACHES: [f64; 3] = [1.0, 2.0, 4.0];
/// A cutter whose radius is not given must be smaller than this share of the distance from the start of the lead-in to its end: the radius of an arc.
const COMPENSATED_SHARE: f64 = std::f64::consts::FRAC_1_SQRT_2;
/// Share of that from which on a lead-in is taken at once, and the least radius of a cutter for which one is of use, mm.
const WHOLLY: f64 = 0.999;
const LEAST_COMPENSATED: f64 = 0.5;
/// Halvings in which the largest radius is found.
const RADIUS_HALVINGS: u32 = 20;
/// Depth below which a lead-in only touches the flank, as a share of the tolerance.
const TOUCHES: f64 = 0.1;
/// Radii that differ by less are equal, m.
const SAME_RADIUS: f64 = 1e-9;
/// Largest number of a program for FANUC.
const LARGEST_PROGRAM: u32 = 9999;
/// Most passes, and most blocks of a program.
const MOST_PASSES: f64 = 1000.0;
/// Share of the tolerance for chords in the place of arcs: all of them, or those of ramps alone.
const CHORD_SHARE: f64 = 0.5;
const RAMP_SHARE: f64 = 0.25;
const MOST_BLOCKS: usize = 200_000;

/// Why a cam is not milled from a plate.
#[must_use]
pub fn unfit(body: &dyn Body) -> Option<&'static str> {
    let leans = "its flank leans along the axis: a cutter that is moved round one section of it cuts into the next";
    body.surface().map(|_| leans).or(body.swept().and_then(|swept| swept.turned().err()))
}

/// A body that is turned under its tool.
fn turned(body: &dyn Body) -> Option<&dyn TurnedCam> {
    body.swept()?.turned().ok()
}

/// The radius of a cutter as wide as the groove of a body, m.
#[must_use]
pub fn widest_cutter(body: &dyn Body) -> Option<f64> {
    let across = || groove_width(&body.cuts()).map(|width| 0.5 * width);
    turned(body).map(TurnedCam::widest_tool).or_else(across)
}

/// Width of the rib that a cutter of a radius (m) leaves between its passes along both flanks of a groove, m; `None` where they meet.
#[must_use]
pub fn rib_between(body: &dyn Body, cutter: Option<f64>) -> Option<f64> {
    let left = 2.0 * widest_cutter(body)? - 4.0 * cutter?;
    (left > SAME_RADIUS).then_some(left)
}

/// The radius of the cutter of a request whose centre is moved, m: in a groove that of a cutter as wide as the groove where none is given.
#[must_use]
pub fn cutter_of(body: &dyn Body, request: &Request) -> Option<f64> {
    let moved = body.machine().cutting().compensation == RadiusCompensation::Program;
    request.cutter_radius.or_else(|| widest_cutter(body)).filter(|_| moved || turned(body).is_some())
}

/// How deep a cut of a body is milled, mm: `[cut] depth`, the depth of its groove, or through its thickness.
#[must_use]
pub fn depth_of(body: &dyn Body) -> Option<f64> {
    let cutting = body.machine().cutting();
    let of_cut = body.cuts().first().and_then(|cut| cut.depth).or_else(|| Some(turned(body)?.depth()));
    let through = || body.machine().cam.thickness.map(|thickness| thickness + cutting.overrun);
    cutting.depth.or(of_cut).or_else(through).map(|depth| MILLIMETRES * depth)
}

/// The programs that mill all parts of a body; none where they were not requested.
///
/// # Errors
/// [`MillingError`] when the cutter does not get into a concave part, the tolerance is too fine for the control, no depth is known, or no way
/// to the flank is free.
pub fn programs(body: &dyn Body, request: &Request) -> Result<Vec<MillingProgram>, MillingError> {
    let Some(asked) = request.milling else { return Ok(Vec::new()) };
    if let Some(why) = unfit(body) {
        return Err(Refusal::new(why).into());
    }
    let cutting = body.machine().cutting();
    let controller = asked.controller.unwrap_or(cutting.controller);
    let units = body.machine().units();
    let decimals = cutting.decimals.unwrap_or(controller.decimals(units));
    let cutter = cutter_of(body, request);
    let grid = Grid::of_lengths(decimals, units);
    let smoothing = smoothing(controller, request);
    if cutter.is_none() {
        can_keep_its_cutter(controller, &cutting)?;
    }
    let chords = chord_share(body, &cutting, cutter);
    let finishing = drawn(body, request, (cutter, decimals, smoothing, chords), 0.0)?;
    let roughing = match cutting.allowance {
        0.0 => None,
        allowance => Some(roughed(body, request, (cutter, decimals, smoothing, chords), allowance)?),
    };
    let drawn = &finishing.drawn;
    let depths = depths(body, &cutting, grid)?;
    let of_counter = body.load().is_some_and(LoadAsCut::is_of_another_disc);
    let mut first = 0;
    let mut programs = Vec::with_capacity(drawn.parts.len());
    for (part, drawn_part) in drawn.parts.iter().enumerate() {
        let cuts: Vec<usize> = (first..first + drawn_part.outlines().count()).collect();
        first += cuts.len();
        let size = (cutter, grid);
        let ((mut passes, blank), roughs) = match &roughing {
            None => (passes(body, request, (&finishing, drawn_part, &cuts), size)?, Vec::new()),
            Some(rough) => {
                let part = rough.drawn.parts.get(part).ok_or_else(|| Refusal::new("the roughing pass has no path"))?;
                let (roughs, _) = passes(body, request, (rough, part, &cuts), size)?;
                (passes(body, request, (&finishing, drawn_part, &cuts), size)?, roughs)
            }
        };
        let order = order(&depths, (passes.len(), roughs.len()), cutting.finish_passes);
        passes.extend(roughs);
        let number = numbered(cutting.program, part + usize::from(of_counter));
        let (cutting, depths) = (CuttingData { program: number, ..cutting.clone() }, depths.clone());
        let turned = None;
        let program = MillingProgram {
            part,
            cuts,
            controller,
            decimals,
            units,
            cutting,
            cutter,
            passes,
            depths,
            order,
            blank,
            turned,
            smoothing,
        };
        has_few_blocks(&program)?;
        programs.push(program);
    }
    Ok(programs)
}

/// Refuses a program of more blocks than a control or a reader takes.
fn has_few_blocks(program: &MillingProgram) -> Result<(), Refusal> {
    let blocks: usize = program.level_cuts().map(|(pass, _, descent)| pass.blocks.len() + descent.ramp.len()).sum();
    if blocks <= MOST_BLOCKS {
        return Ok(());
    }
    let what = format!("the program would have {blocks} blocks, more than {MOST_BLOCKS}");
    let remedy = if program.cutting.arcs {
        "give a larger cut.depth_per_pass, or a coarser --tolerance"
    } else {
        "give a coarser --tolerance, a larger cut.depth_per_pass, or cut.arcs = true"
    };
    Err(Refusal::new(what).remedy(remedy))
}

/// Refuses a program along which the control keeps its cutter where it cannot.
fn can_keep_its_cutter(controller: Controller, cutting: &CuttingData) -> Result<(), Refusal> {
    let remedy = match cutting.compensation {
        RadiusCompensation::Control => "give cut.compensation = \"program\" and --cutter-diameter",
        RadiusCompensation::Program => "give --cutter-diameter",
    };
    if controller == Controller::Grbl {
        let what = "grbl has no compensation of the cutter's radius (G41, G42), by which the program would keep its cutter on the profile";
        return Err(Refusal::new(what).remedy(remedy));
    }
    if !cutting.arcs {
        let what = "cut.arcs = false: controls stop at inner corners between chords while they keep the cutter on the profile (G41, G42)";
        return Err(Refusal::new(what).remedy(remedy));
    }
    Ok(())
}

/// Share of the tolerance for chords.
fn chord_share(body: &dyn Body, cutting: &CuttingData, cutter: Option<f64>) -> f64 {
    let cuts = body.cuts();
    let ramps = groove_width(&cuts).is_some() || cuts.iter().any(Cut::is_hollow);
    match (cutting.arcs, cutting.entry) {
        (false, _) => CHORD_SHARE,
        (true, CutterEntry::Auto) if ramps && cutter.is_some() => RAMP_SHARE,
        (true, _) => 0.0,
    }
}

/// The paths of the roughing passes: those of a cutter that is larger by the allowance, or parallels of the profile.
fn roughed(
    body: &dyn Body,
    request: &Request,
    (cutter, decimals, smoothing, chords): (Option<f64>, u32, f64, f64),
    allowance: f64,
) -> Result<DrawnPaths, MillingError> {
    let shown_allowance = shown(MILLIMETRES * allowance);
    if let (Some(width), Some(cutter)) = (groove_width(&body.cuts()), cutter)
        && cutter + allowance > 0.5 * width + SAME_RADIUS
    {
        let [width, diameter] = [width, 2.0 * cutter].map(|length| shown(MILLIMETRES * length));
        let most = (0.5 * MILLIMETRES * width_left(&body.cuts(), cutter)).max(0.0);
        let what = format!(
            "cut.allowance of {shown_allowance} mm: a cutter of diameter {diameter} mm has no room for it on both flanks of a groove of {width} mm"
        );
        let remedy = format!("give a cut.allowance of at most {} mm, or a smaller --cutter-diameter", shown(most));
        return Err(Refusal::new(what).remedy(remedy).into());
    }
    let size = cutter.unwrap_or(0.0) + allowance;
    let drawn = drawn(body, request, (Some(size), decimals, smoothing, chords), allowance);
    drawn.map_err(|why| match why {
        MillingError::Cutter(why) => {
            let what = format!("cut.allowance of {shown_allowance} mm: the roughing pass has no path there: {why}");
            Refusal::new(what).remedy("give a smaller cut.allowance, or a smaller --cutter-diameter").into()
        }
        other => other,
    })
}

/// Width of a groove that a cutter of a radius leaves free, m.
fn width_left(cuts: &[Cut<'_>], cutter: f64) -> f64 {
    groove_width(cuts).map_or(f64::INFINITY, |width| width - 2.0 * cutter)
}

/// The passes at their depths: all at each depth; with roughing passes those at each depth, then the finishing passes at the full depth. Spring passes follow.
fn order(depths: &[f64], (finishing, roughing): (usize, usize), finish_passes: u32) -> Vec<LevelCut> {
    let mut order = Vec::new();
    let at_each_depth = if roughing > 0 { finishing..finishing + roughing } else { 0..finishing };
    let mut before = 0.0;
    for depth in depths {
        order.extend(at_each_depth.clone().map(|pass| LevelCut { pass, before, depth: *depth }));
        before = *depth;
    }
    let deepest = before;
    // Without roughing the first finishing pass at full depth is the last of those at each depth.
    let mut cut = if roughing > 0 { 0.0 } else { deepest };
    for _ in u32::from(roughing == 0)..finish_passes {
        order.extend((0..finishing).map(|pass| LevelCut { pass, before: cut, depth: deepest }));
        cut = deepest;
    }
    order
}

/// A drawing with the largest distance of chords from its paths, mm.
struct DrawnPaths {
    drawn: Drawn,
    chords: f64,
    /// Stock that its paths keep on the flanks, m.
    allowance: f64,
}

/// The number of a further program of a design: a control keeps one program of a number.
fn numbered(first: u32, further: usize) -> u32 {
    let further = u32::try_from(further).unwrap_or(0);
    (first.saturating_sub(1) + further) % LARGEST_PROGRAM + 1
}

/// The part of the tolerance reserved for path smoothing by the control, m.
pub(super) fn smoothing(controller: Controller, request: &Request) -> f64 {
    controller.smoothing_share() * request.fit.band().1
}

/// The drawing within the tolerance that remains after rounding, smoothing and chords, with paths of a cutter's centre if the program moves it, or if it keeps
/// stock.
fn drawn(
    body: &dyn Body,
    request: &Request,
    (cutter, decimals, smoothing, chords): (Option<f64>, u32, f64, f64),
    allowance: f64,
) -> Result<DrawnPaths, MillingError> {
    let (middle, band) = request.fit.band();
    let half = band - smoothing;
    let rounding = ROUNDING * Grid::of_lengths(decimals, body.machine().units()).step() / MILLIMETRES;
    if half - rounding < LEAST_SHARE * half {
        let sides = request.fit.tolerance / half;
        let least = 1e6 * sides * rounding / (1.0 - LEAST_SHARE);
        let what = format!(
            "numbers of {decimals} decimals keep no tolerance of {} um: they need {} um",
            shown(1e6 * request.fit.tolerance),
            shown(least)
        );
        let remedy = "give a coarser --tolerance, or cut.decimals that the control takes";
        return Err(Refusal::new(what).remedy(remedy).into());
    }
    if middle != 0.0 && cutter.is_none() {
        let what = "the control keeps its cutter on a profile that lies on both sides of the exact one";
        return Err(Refusal::new(what).remedy("leave --side out, or give --cutter-diameter").into());
    }
    if middle != 0.0 && allowance == 0.0 && one_pass(&body.cuts(), cutter) {
        let what = "a cutter as wide as its groove cuts both flanks in one pass, on either side";
        return Err(Refusal::new(what).remedy("leave --side out, or give a smaller --cutter-diameter").into());
    }
    let room = half - rounding;
    let fit = Fit { tolerance: room * (1.0 - chords), side: Side::Both, laid: SegmentKind::Arcs, ..request.fit };
    let cutter_radius = cutter.map(|radius| radius - middle);
    let fine = Request { fit, cutter_radius, flank: false, lead_in: None, ..request.without_tool_files() };
    let drawn = body.draw(&fine).map_err(|error| match error {
        DrawError::NoOutline(why) => Refusal::new(why),
        DrawError::Refused(refusal) => refusal,
    })?;
    if let Some(Err(error)) = drawn.cutter_paths().find(|path| path.is_err()) {
        return Err(MillingError::Cutter(error.clone()));
    }
    let drawn = start::started(body, &fine, drawn)?;
    Ok(DrawnPaths { drawn, chords: MILLIMETRES * room * chords, allowance })
}

/// Whether the cutter is as wide as the groove between these cuts.
fn one_pass(cuts: &[Cut<'_>], cutter: Option<f64>) -> bool {
    groove_width(cuts).zip(cutter).is_some_and(|(width, cutter)| (width - 2.0 * cutter).abs() < SAME_RADIUS)
}

/// The depths of the passes, mm.
pub(super) fn depths(body: &dyn Body, cutting: &CuttingData, grid: Grid) -> Result<Vec<f64>, Refusal> {
    let depth = depth_of(body).ok_or_else(|| {
        let refusal = Refusal::new("the depth of the cut is not known");
        refusal.remedy("give cam.thickness, or cut.depth")
    })?;
    let per_pass = cutting.depth_per_pass.map_or(depth, |depth| MILLIMETRES * depth);
    let count = (depth / per_pass - 1e-9).ceil().max(1.0);
    if count > MOST_PASSES {
        let what =
            format!("{} mm in passes of {} mm are more than {MOST_PASSES} passes", shown(depth), shown(per_pass));
        let least = shown(1.001 * depth / MOST_PASSES);
        return Err(Refusal::new(what).remedy(format!("give a cut.depth_per_pass of at least {least} mm")));
    }
    let mut depths = Vec::new();
    while f64::from(u32::try_from(depths.len()).unwrap_or(u32::MAX)) < count {
        let number = f64::from(u32::try_from(depths.len() + 1).unwrap_or(u32::MAX));
        depths.push(grid.nearest(depth * number / count));
    }
    Ok(depths)
}

/// What a pass is planned from.
struct Flank<'a> {
    words: String,
    /// The path, in the sense of the cut.
    path: Contour,
    /// Whether the cutter is on the left of the profile.
    cutter_left: bool,
    /// Edges of all paths, the metal on their left.
    metal: &'a [EdgeTree],
    /// The blank outside of which the cutter goes down; `None` where it goes down a ramp.
    blank: Option<Blank>,
    cutting: &'a CuttingData,
    /// Largest distance of chords from the path, mm.
    chords: f64,
    is_roughing: bool,
}

/// A pass along every flank of a part, or one along both of a groove.
fn passes(
    body: &dyn Body,
    request: &Request,
    (paths, part, cuts): (&DrawnPaths, &Part, &[usize]),
    (cutter, grid): (Option<f64>, Grid),
) -> Result<(Vec<MillingPass>, Option<Blank>), MillingError> {
    let all = body.cuts();
    let (drawn, chords, allowance) = (&paths.drawn, paths.chords, paths.allowance);
    let cutting = &body.machine().cutting();
    let of_part: Vec<&Cut<'_>> = cuts.iter().filter_map(|index| all.get(*index)).collect();
    let width = groove_width(&all);
    if let (Some(width), Some(cutter)) = (width, cutter)
        && cutter > 0.5 * width + SAME_RADIUS
    {
        let (width, cutter) = (shown(MILLIMETRES * width), shown(2.0 * MILLIMETRES * cutter));
        let what = format!("a cutter of diameter {cutter} mm does not fit into a groove of {width} mm");
        return Err(Refusal::new(what).remedy("give a smaller --cutter-diameter, or leave it out").into());
    }
    let paths: Vec<&Outline> = match cutter {
        _ if cutter.is_some() || allowance > 0.0 => {
            let paths = drawn.cutter_paths().flatten().enumerate();
            paths.filter(|(index, _)| cuts.contains(index)).map(|(_, path)| path).collect()
        }
        _ => part.outlines().map(|(_, outline)| outline).collect(),
    };
    let single = one_pass(&all, cutter);
    let hollow = |cut: &Cut<'_>| cut.is_hollow();
    let ways: Vec<Contour> = of_part
        .iter()
        .zip(&paths)
        .map(|(cut, path)| if hollow(cut) { path.contour.reversed() } else { path.contour.clone() })
        .collect();
    let metal: Vec<EdgeTree> = if single { Vec::new() } else { parallel::map(&ways, EdgeTree::new) };
    let climb = cutting.direction == MillingDirection::Climb;
    let is_plate = |cut: &Cut<'_>| cut.curves.is_some_and(|curves| curves.motion.period().is_none());
    let outer = of_part.iter().zip(&ways).filter(|(cut, _)| width.is_none() && !hollow(cut));
    let off = MILLIMETRES * (cutter.unwrap_or(0.0) + allowance);
    let blank = Blank::around(
        outer.flat_map(|(_, way)| way.edges()),
        (off, MILLIMETRES * cutting.blank_margin()),
        of_part.iter().any(|cut| is_plate(cut)),
    );
    let room = width.filter(|_| !single).map(|width| MILLIMETRES * (width - 2.0 * cutter.unwrap_or(0.0)));
    let mut found = Vec::new();
    for (cut, way) in of_part.iter().zip(&ways) {
        // With the metal on its left the cutter is on the right of the profile.
        let path = if climb { way.reversed() } else { way.clone() };
        let path = if is_plate(cut) { path.started_where_flattest() } else { path };
        let words = match (single, cut.name, hollow(cut)) {
            (true, ..) => "both flanks of the groove".to_owned(),
            (_, "", true) => "inside".to_owned(),
            (_, "", false) => "profile".to_owned(),
            (_, name, _) => format!("{name} flank"),
        };
        let is_roughing = allowance > 0.0;
        let words = if is_roughing { format!("{words}, roughing") } else { words };
        let blank = blank.filter(|_| !hollow(cut));
        let flank = Flank { words, path, cutter_left: climb, metal: &metal, blank, cutting, chords, is_roughing };
        found.push(flank.pass(request, (cutter, room), grid)?);
        if single {
            break;
        }
    }
    Ok((found, blank))
}

/// Shares of the way on which the control takes up its compensation that are tried for a ramp.
const SHARES: [f64; 4] = [1.0, 0.75, 0.5, 0.25];
/// Least distance of chords from their arcs, mm.
const LEAST_CHORDS: f64 = 1e-5;

/// A lead-in and a lead-out, with the ways on which the control takes up its compensation and ends it.
struct Leads {
    to: Segment,
    from: Segment,
    compensated: Option<Compensation>,
}

/// The largest radius up to a wanted one, mm, that is clear.
fn largest(wanted: f64, is_clear: impl Fn(f64) -> bool) -> f64 {
    if is_clear(wanted) {
        return wanted;
    }
    let (mut clear, mut wide) = (0.0, wanted);
    for _ in 0..RADIUS_HALVINGS {
        let middle = 0.5 * (clear + wide);
        *(if is_clear(middle) { &mut clear } else { &mut wide }) = middle;
    }
    clear
}

impl Flank<'_> {
    /// The pass, with a lead-in and a lead-out that keep clear of the metal.
    fn pass(
        &self,
        request: &Request,
        (cutter, room): (Option<f64>, Option<f64>),
        grid: Grid,
    ) -> Result<MillingPass, Refusal> {
        let refused =
            || Refusal::new("the path has edges that are neither arcs nor lines").remedy("please report this");
        let edges = self.path.segments().ok_or_else(refused)?;
        let (Some(first), Some(last)) = (edges.first(), edges.last()) else { return Err(refused()) };
        let round = self.blocks(&edges, grid);
        let at = grid.point(first.start);
        let tolerance = request.fit.tolerance_mm();
        let leads = self.leads(request, (first, last), (cutter, room), tolerance)?;
        let (words, cutter_left, is_roughing) = (self.words.clone(), self.cutter_left, self.is_roughing);
        let ramps = self.cutting.entry == CutterEntry::Auto && self.blank.is_none();
        let (compensated, start, blocks) = match leads {
            None => (None, at, round),
            Some(Leads { to, from, compensated }) => {
                let (to, from) = (Segment { end: at, ..to }, Segment { start: at, ..from });
                let way_out = self.blocks(&[from], grid);
                if ramps && compensated.is_none() {
                    // The ramp itself arrives along the path.
                    (None, at, [round, way_out].concat())
                } else {
                    let ends = |ends: Compensation| Compensation {
                        from: grid.point(ends.from),
                        to: grid.point(ends.to),
                        ..ends
                    };
                    let blocks = [self.blocks(&[to], grid), round, way_out].concat();
                    (compensated.map(ends), grid.point(to.start), blocks)
                }
            }
        };
        let pass = MillingPass { words, is_roughing, entry: Entry::Plunge, cutter_left, compensated, start, blocks };
        let entry = match self.cutting.entry {
            CutterEntry::Plunge => Entry::Plunge,
            CutterEntry::Auto => self.entry(&pass, (&edges, leads.as_ref()), (request, cutter, tolerance), grid)?,
        };
        Ok(MillingPass { entry, ..pass })
    }

    /// The blocks of edges: arcs, or chords.
    fn blocks(&self, edges: &[Segment], grid: Grid) -> Vec<Block> {
        if self.cutting.arcs {
            return grid.blocks(edges);
        }
        let corners = entry::chords(edges, self.chords, grid);
        corners.into_iter().skip(1).map(|to| Block::Line { to }).collect()
    }

    /// How the cutter reaches the depth of a pass: outside the blank, down a ramp along the path, or on the way on which the control takes up its radius.
    fn entry(
        &self,
        pass: &MillingPass,
        (edges, leads): (&[Segment], Option<&Leads>),
        (request, cutter, tolerance): (&Request, Option<f64>, f64),
        grid: Grid,
    ) -> Result<Entry, Refusal> {
        let kept = pass
            .compensated
            .map(|ends| request.cutter_radius.map_or(ends.largest_radius, |radius| MILLIMETRES * radius));
        // In the path of the centre the size of the cutter is taken into account.
        let judged = kept.unwrap_or(0.0);
        let is_free = |way: &Segment| {
            lead_in::depth_along(self.metal, std::slice::from_ref(way), judged, TOUCHES * tolerance) <= tolerance
        };
        let start = pass.level_start();
        let refused = |what: String| {
            let remedy =
                "give another --start, or cut.entry = \"plunge\" for a blank that is drilled where the pass starts";
            Err(Refusal::new(what).remedy(remedy))
        };
        if let Some(blank) = &self.blank {
            let back = match (pass.compensated, leads, edges.first()) {
                (Some(ends), ..) => (ends.from - pass.start).normalize(),
                (None, Some(leads), _) => -leads.to.start_tangent(),
                (None, None, Some(first)) => {
                    let along = first.start_tangent();
                    Vector2::new(-along.y, along.x) * if self.cutter_left { 1.0 } else { -1.0 }
                }
                (None, None, None) => Vector2::x(),
            };
            let radius = kept.or(cutter.map(|radius| MILLIMETRES * radius)).unwrap_or(0.0);
            return match entry::outside(blank, (start, back), radius, is_free) {
                Some(at) => Ok(Entry::Outside(grid.point(at))),
                None => refused(format!("no way from outside the blank to the {} is free for the cutter", self.words)),
            };
        }
        if let Some(ends) = pass.compensated {
            // To and fro before the control takes up the radius, on as long a part of that way as is free.
            let other = SHARES.iter().map(|share| grid.point(ends.from + (pass.start - ends.from) * *share));
            let mut free = other.filter(|other| is_free(&Segment { start: ends.from, end: *other, bulge: 0.0 }));
            return match free.next() {
                Some(other) => Ok(Entry::Ramp { lap: vec![ends.from, other, ends.from], whole: true }),
                None => refused(format!("no ramp before the {} is free for the cutter", self.words)),
            };
        }
        Ok(Entry::Ramp { lap: entry::chords(edges, self.chords.max(LEAST_CHORDS), grid), whole: false })
    }

    /// The lead-in and the lead-out; `None` where the cutter goes down on the path itself.
    fn leads(
        &self,
        request: &Request,
        ends: (&Segment, &Segment),
        (cutter, room): (Option<f64>, Option<f64>),
        tolerance: f64,
    ) -> Result<Option<Leads>, Refusal> {
        if self.metal.is_empty() {
            return Ok(None);
        }
        let least = if cutter.is_none() { LARGER * MILLIMETRES * request.cutter_radius.unwrap_or(0.0) } else { 0.0 };
        let (form, sizes) = match request.lead_in {
            Some(asked) => (asked.form, vec![MILLIMETRES * asked.size]),
            None if cutter.is_none() => {
                let larger = (least > COMPENSATED_LEADS[0]).then_some(least);
                let smallest = (least > 0.0).then_some(least);
                (LeadInForm::Arc, larger.into_iter().chain(COMPENSATED_LEADS).chain(smallest).collect())
            }
            None => (LeadInForm::Arc, LEADS.to_vec()),
        };
        let fits = |size: &&f64| **size >= least && room.is_none_or(|room| **size <= room);
        if cutter.is_none() {
            let radius = request.cutter_radius.map(|radius| MILLIMETRES * radius);
            let all = sizes.iter().filter(fits).map(|size| self.lead(ends, form, *size));
            if let Some(leads) = self.compensated(all, radius, tolerance) {
                return Ok(Some(leads));
            }
        } else {
            let mut all = sizes.iter().filter(fits).map(|size| self.lead(ends, form, *size));
            if let Some([to, from]) = all.find(|leads| leads.iter().all(|lead| self.is_free(lead, tolerance))) {
                return Ok(Some(Leads { to, from, compensated: None }));
            }
        }
        if cutter.is_some() && request.lead_in.is_none() {
            return Ok(None);
        }
        let what = format!("no lead-in to the {} is free for the cutter", self.words);
        let remedy = if cutter.is_none() {
            "give cut.compensation = \"program\" and --cutter-diameter: the program of a cutter that is known can go down on the path itself"
        } else {
            "give another --start or a smaller --lead-in"
        };
        Err(Refusal::new(what).remedy(remedy))
    }

    /// The lead-in to and the lead-out from the start of the path, on the side of the cutter.
    fn lead(&self, (first, last): (&Segment, &Segment), form: LeadInForm, size: f64) -> [Segment; 2] {
        let at = first.start;
        let (along, off) = (first.start_tangent(), last.end_tangent());
        let side = if self.cutter_left { 1.0 } else { -1.0 };
        let away = |along: Vector2<f64>| Vector2::new(-along.y, along.x) * side;
        match form {
            LeadInForm::Tangent => [
                Segment { start: at - along * size, end: at, bulge: 0.0 },
                Segment { start: at, end: at + off * size, bulge: 0.0 },
            ],
            LeadInForm::Arc => {
                let bulge = side * libm::tan(FRAC_PI_8);
                let to = Segment { start: at + (away(along) - along) * size, end: at, bulge };
                [to, Segment { start: at, end: at + (away(off) + off) * size, bulge }]
            }
        }
    }

    /// The first of some leads that keep a cutter of a radius (mm) clear of the metal, from the point at which it goes down on; without a radius the first that
    /// do so for every cutter smaller than the lead-in, or those with room for the largest one.
    fn compensated(
        &self,
        all: impl Iterator<Item = [Segment; 2]>,
        radius: Option<f64>,
        tolerance: f64,
    ) -> Option<Leads> {
        let mut best: Option<Leads> = None;
        for ([to, from], stretch) in all.flat_map(|leads| APPROACHES.map(|stretch| (leads, stretch))) {
            let size = (to.start - to.end).norm();
            let (before, after) = (to.start_tangent() * (stretch * size), from.end_tangent() * (stretch * size));
            let ends = [to.start - before, from.end + after];
            let lead_in = [Segment { start: ends[0], end: to.start, bulge: 0.0 }, to];
            let lead_out = [from, Segment { start: from.end, end: ends[1], bulge: 0.0 }];
            if !lead_in.iter().chain(&lead_out).all(|way| self.is_free(way, tolerance)) {
                continue;
            }
            let usual = COMPENSATED_SHARE * size;
            let wanted = radius.map_or(usual, |radius| radius.max(usual));
            let is_clear = |radius: f64| self.is_clear([&lead_in, &lead_out], radius, tolerance);
            let largest_radius = largest(wanted, is_clear);
            let leads =
                Leads { to, from, compensated: Some(Compensation { from: ends[0], to: ends[1], largest_radius }) };
            let is_enough = match radius {
                Some(radius) => largest_radius >= radius,
                None => largest_radius >= WHOLLY * usual,
            };
            if is_enough {
                return Some(leads);
            }
            let room = |leads: &Leads| leads.compensated.map_or(0.0, |ends| ends.largest_radius);
            if radius.is_none() && largest_radius > best.as_ref().map_or(LEAST_COMPENSATED, room) {
                best = Some(leads);
            }
        }
        best
    }

    /// Whether a cutter of a radius, mm, only touches the metal while the control takes up its radius and ends it.
    fn is_clear(&self, [lead_in, lead_out]: [&[Segment; 2]; 2], radius: f64, tolerance: f64) -> bool {
        let side = if self.cutter_left { 1.0 } else { -1.0 };
        let ways = [
            lead_in::path_of_centre(lead_in, side, radius),
            lead_in::path_of_centre(&lead_in::reversed(lead_out), -side, radius),
        ];
        ways.iter().all(|way| lead_in::depth_along(self.metal, way, radius, TOUCHES * tolerance) <= tolerance)
    }

    /// Whether a lead-in only touches the metal.
    fn is_free(&self, lead: &Segment, tolerance: f64) -> bool {
        let deep = |tree: &EdgeTree| depth(tree, &Edge::Segment(*lead), TOUCHES * tolerance);
        self.metal.iter().all(|tree| deep(tree) <= tolerance)
    }
}

//! Every setting made in rounds: the time of each stage, and the errors of what is made.

use crate::body::Points;
use crate::body::{RateTolerance, Request};
use crate::pipeline::Cam;
use crate::report::{Rolled, failed, shown};
use crate::tool_files::dxf::{self, proof};
use crate::tool_files::points;
use crate::verify::{WrittenOutline, rolling};
use crate::write::{Rendering, View, csv, step, svg};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::points::{Interpolant, PointCoordinates, PointInterpolation, PointStep};
use camgen_kernel::profile::outline::{Fit, SegmentKind};
use camgen_kernel::refusal::Refusal;
use serde::Serialize;
use std::fmt;
use std::time::Duration;

/// Rows of the point table.
const SAMPLES: u32 = 720;
/// Most rounds over all settings: every setting is made once in each round, so that other work of the computer affects all of them equally.
const MOST_ROUNDS: usize = 5;
/// No round is begun that would end after this, by the time of the one before it.
const BUDGET: Duration = Duration::from_secs(8);

/// What a measurement needs of its caller: camgen itself looks at no clock.
pub struct TradeRun<'a> {
    /// The time since any fixed moment.
    pub clock: &'a dyn Fn() -> Duration,
    /// Hears how many steps are done, of at most how many.
    pub progress: &'a mut dyn FnMut(usize, usize),
}

impl fmt::Debug for TradeRun<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TradeRun").finish_non_exhaustive()
    }
}

/// The time since any fixed moment.
pub type TradeClock<'a> = &'a dyn Fn() -> Duration;

/// One setting, measured. Times are the least of the rounds.
#[derive(Debug, Clone, Serialize)]
pub(super) struct TradeRow {
    pub(super) setting: String,
    /// The flags of the command that make it; `None` of a law that no flag asks for.
    pub(super) flags: Option<String>,
    pub(super) entity: Entity,
    /// Place among the settings that keep the limits, from 1, the one that costs the shop least.
    pub(super) rank: Option<usize>,
    /// Along the outline at the feed of the machine file.
    pub(super) machining_s: f64,
    pub(super) law_us: f64,
    pub(super) outline_us: f64,
    pub(super) checks_us: f64,
    pub(super) dxf_us: f64,
    pub(super) svg_us: f64,
    pub(super) step_us: Option<f64>,
    pub(super) csv_us: f64,
    /// The sum of the stages.
    pub(super) total_us: f64,
    pub(super) arcs: usize,
    pub(super) bytes: usize,
    pub(super) law_error_mm: f64,
    pub(super) deviation_mm: f64,
    pub(super) residual_n: f64,
    /// Arcs, lines and spans of an outline, or rows of a table.
    pub(super) pieces: usize,
    /// Largest gap under the rolled follower.
    pub(super) rolled_mm: Option<f64>,
    pub(super) velocity_error_mm_per_rad: Option<f64>,
    pub(super) acceleration_error_mm_per_rad2: Option<f64>,
    /// At the speed of the cam, where it is known.
    pub(super) acceleration_error_m_per_s2: Option<f64>,
    pub(super) acceleration_share: Option<f64>,
    /// Roller force times velocity error, at its largest, on the camshaft.
    pub(super) torque_error_nm: Option<f64>,
    /// The checks of the setting that fail.
    pub(super) failed: Vec<String>,
    /// Least and largest total of a round.
    pub(super) total_low_us: f64,
    pub(super) total_high_us: f64,
}

/// What an outline is written as; every control reads arcs, fewer read splines, and a table of points is read by its interpolation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Entity {
    Arcs,
    Splines,
    Points,
}

/// Times of one round, µs.
#[derive(Debug, Clone, Copy)]
struct RoundTimes {
    law: f64,
    outline: f64,
    dxf: f64,
    /// Writing, reading back and checking.
    proof: f64,
    svg: Option<f64>,
    step: Option<f64>,
    csv: Option<f64>,
}

impl RoundTimes {
    fn total(&self) -> f64 {
        let formats = [self.svg, self.step, self.csv].into_iter().flatten().sum::<f64>();
        self.law + self.outline + self.proof + formats
    }
}

/// A law, solved once for every setting that uses it.
pub struct TradeLaw {
    /// Solves it again, to measure how long that takes.
    pub solve: Box<dyn Fn() -> Result<Cam, Refusal>>,
    /// The solved cam.
    pub cam: Cam,
    /// Largest distance from the exact law, mm.
    pub error_mm: f64,
    /// The residual force of the law itself, without an outline, N.
    pub residual_n: f64,
}

impl fmt::Debug for TradeLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TradeLaw").field("cam", &self.cam).field("error_mm", &self.error_mm).finish_non_exhaustive()
    }
}

/// One setting of the ladder.
#[derive(Debug)]
pub struct TradeSetting {
    /// What the rows call it.
    pub name: String,
    /// The flags of the command that make it, where there are some.
    pub flags: Option<String>,
    /// Its law, by number.
    pub law: usize,
    /// Tolerance of the outline, m.
    pub tolerance: f64,
    /// What is made.
    pub made: TradeProduct,
}

/// The product of a setting.
#[derive(Debug, Clone, Copy)]
pub enum TradeProduct {
    /// An outline, which may also keep the acceleration to a share of its largest.
    Outline {
        /// Of which segments.
        laid: SegmentKind,
        /// Share of the largest acceleration that is kept.
        share: Option<f64>,
    },
    /// A table of points, in x and y by equal chord error, which may also keep the acceleration to a share of its largest.
    Points {
        /// How a machine goes between them.
        between: PointInterpolation,
        /// Share of the largest acceleration that is kept.
        share: Option<f64>,
    },
}

impl Entity {
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Arcs => "arcs",
            Self::Splines => "splines",
            Self::Points => "points",
        }
    }
}

impl TradeProduct {
    fn entity(self) -> Entity {
        match self {
            Self::Outline { laid: SegmentKind::Arcs, .. } => Entity::Arcs,
            Self::Outline { laid: SegmentKind::Splines, .. } => Entity::Splines,
            Self::Points { .. } => Entity::Points,
        }
    }
}

/// The limits that the advice must keep.
#[derive(Debug, Clone, Copy)]
pub struct TradeLimits {
    /// Largest residual force, N; `None` of a cam without load.
    pub residual: Option<f64>,
    /// Largest error of the acceleration over its largest.
    pub acceleration: Option<f64>,
}

impl TradeLimits {
    pub(super) fn words(self) -> String {
        let force = self.residual.map(|residual| format!("{} N", shown(residual)));
        let share = self.acceleration.map(|share| format!("{} % of the acceleration", shown(100.0 * share)));
        force.into_iter().chain(share).collect::<Vec<_>>().join(" and ")
    }

    /// The remaining value, with a setting, of the quantity that is limited first.
    pub(super) fn left(self, row: &TradeRow) -> f64 {
        if self.residual.is_some() { row.residual_n } else { row.acceleration_share.unwrap_or(f64::INFINITY) }
    }

    /// What remains, in words.
    pub(super) fn left_words(self, row: &TradeRow) -> String {
        let left = self.left(row);
        if self.residual.is_some() { format!("{} N", shown(left)) } else { format!("{} % of it", shown(100.0 * left)) }
    }

    /// Whether a row keeps them, can be asked for, and passes its own checks.
    fn keeps(self, row: &TradeRow) -> bool {
        let share = self.acceleration.is_none_or(|limit| row.acceleration_share.is_some_and(|share| share <= limit));
        self.residual.is_none_or(|limit| row.residual_n <= limit)
            && share
            && row.failed.is_empty()
            && row.flags.is_some()
    }
}

/// Time of some work, µs, and its result.
///
/// # Errors
/// As for the work.
pub fn timed<T>(clock: TradeClock<'_>, work: impl FnOnce() -> Result<T, Refusal>) -> Result<(f64, T), Refusal> {
    let start = clock();
    let made = work()?;
    Ok((1e6 * clock().saturating_sub(start).as_secs_f64(), made))
}

/// Rows, in how many rounds they were measured, and why settings are missing.
pub(super) struct TradeMeasurement {
    pub(super) rows: Vec<TradeRow>,
    pub(super) rounds: usize,
    pub(super) missing: Vec<String>,
}

/// Rounds over all settings. The rows are of the first one; the others only measure its times again. A setting that cannot be made is left out;
/// where none can, the reason of the first is the error.
pub(super) fn measure(
    laws: &[TradeLaw],
    settings: &[TradeSetting],
    limits: TradeLimits,
    TradeRun { clock, progress }: TradeRun<'_>,
) -> Result<TradeMeasurement, Refusal> {
    let mut rows: Vec<TradeRow> = Vec::with_capacity(settings.len());
    let mut times: Vec<Vec<RoundTimes>> = Vec::with_capacity(settings.len());
    let (mut made, mut missing, mut first_refusal) = (Vec::new(), Vec::new(), None);
    let (start, mut rounds, mut done) = (clock(), 0, 0);
    let mut last = Duration::ZERO;
    while rounds < MOST_ROUNDS && (rounds == 0 || clock().saturating_sub(start) + last <= BUDGET) {
        let begun = clock();
        let solved = laws.iter().map(|law| Ok(timed(clock, &law.solve)?.0)).collect::<Result<Vec<f64>, Refusal>>()?;
        let now: Vec<&TradeSetting> = if rounds == 0 { settings.iter().collect() } else { made.clone() };
        for (number, setting) in now.into_iter().enumerate() {
            let (Some(law), Some(law_us)) = (laws.get(setting.law), solved.get(setting.law)) else { continue };
            done += 1;
            progress(done, MOST_ROUNDS * settings.len());
            match one_round(clock, law, setting, *law_us) {
                Ok((row, now)) if rounds == 0 => {
                    rows.push(row);
                    times.push(vec![now]);
                    made.push(setting);
                }
                Ok((_, now)) => times.get_mut(number).into_iter().for_each(|times| times.push(now)),
                Err(why) => {
                    missing.push(format!("{} cannot be made: {why}", setting.name));
                    first_refusal = first_refusal.or(Some(why));
                }
            }
        }
        if let (true, Some(why)) = (made.is_empty(), first_refusal.take()) {
            return Err(why);
        }
        rounds += 1;
        last = clock().saturating_sub(begun);
    }
    rows.iter_mut().zip(&times).for_each(|(row, times)| row.take(times));
    for (place, index) in ranking(&rows, limits).into_iter().enumerate() {
        if let Some(row) = rows.get_mut(index) {
            row.rank = Some(place + 1);
        }
    }
    Ok(TradeMeasurement { rows, rounds, missing })
}

/// The rows that keep the limits, by number, the one first that costs the shop least: by what it is written as, its pieces, its bytes, and what it
/// leaves. No time of this computer is among them, so the order is the same in every run.
fn ranking(rows: &[TradeRow], limits: TradeLimits) -> Vec<usize> {
    let mut keep: Vec<(usize, &TradeRow)> = rows.iter().enumerate().filter(|(_, row)| limits.keeps(row)).collect();
    keep.sort_by(|(_, a), (_, b)| {
        let [first, second] = [a, b].map(|row| (row.entity, row.pieces, row.bytes));
        first.cmp(&second).then(limits.left(a).total_cmp(&limits.left(b)))
    });
    keep.into_iter().map(|(index, _)| index).collect()
}

impl TradeRow {
    /// Nothing measured yet.
    fn new(law: &TradeLaw, setting: &TradeSetting, law_us: f64, step_us: Option<f64>) -> Self {
        Self {
            setting: setting.name.clone(),
            flags: setting.flags.clone(),
            entity: setting.made.entity(),
            rank: None,
            machining_s: 0.0,
            law_us,
            outline_us: 0.0,
            checks_us: 0.0,
            dxf_us: 0.0,
            svg_us: 0.0,
            step_us,
            csv_us: 0.0,
            total_us: 0.0,
            arcs: 0,
            bytes: 0,
            law_error_mm: law.error_mm,
            deviation_mm: 0.0,
            residual_n: 0.0,
            pieces: 0,
            rolled_mm: None,
            velocity_error_mm_per_rad: None,
            acceleration_error_mm_per_rad2: None,
            acceleration_error_m_per_s2: None,
            acceleration_share: None,
            torque_error_nm: None,
            failed: Vec::new(),
            total_low_us: 0.0,
            total_high_us: 0.0,
        }
    }

    /// The least time of every stage: other work of the computer only adds to it.
    fn take(&mut self, times: &[RoundTimes]) {
        let least = |of: fn(&RoundTimes) -> f64| times.iter().map(of).fold(f64::INFINITY, f64::min);
        self.law_us = least(|t| t.law);
        self.outline_us = least(|t| t.outline);
        // The proof writes the file once more: where other work disturbed the first writing in every round, the proof limits its time.
        let proof_us = least(|t| t.proof);
        self.dxf_us = least(|t| t.dxf).min(proof_us);
        self.checks_us = proof_us - self.dxf_us;
        self.svg_us = least(|t| t.svg.unwrap_or(0.0));
        self.step_us = self.step_us.map(|_| least(|t| t.step.unwrap_or(0.0)));
        self.csv_us = least(|t| t.csv.unwrap_or(0.0));
        let formats = self.svg_us + self.step_us.unwrap_or(0.0) + self.csv_us;
        self.total_us = self.law_us + self.outline_us + proof_us + formats;
        self.total_low_us = least(RoundTimes::total);
        self.total_high_us = times.iter().map(RoundTimes::total).fold(0.0, f64::max);
    }
}

/// One setting from the outline on, once.
fn one_round(
    clock: TradeClock<'_>,
    law: &TradeLaw,
    setting: &TradeSetting,
    law_us: f64,
) -> Result<(TradeRow, RoundTimes), Refusal> {
    match setting.made {
        TradeProduct::Outline { laid, share } => {
            let rates = [None, share.map(RateTolerance::Share)];
            let request = Request { rates, ..Request::within(Fit { laid, ..Fit::from(setting.tolerance) }) };
            outline(clock, law, setting, law_us, request)
        }
        TradeProduct::Points { between, share } => {
            let asked = Points {
                form: Some(PointCoordinates::Plane),
                step: Some(PointStep::Chord),
                between,
                ..Points::default()
            };
            let rates = [None, share.map(RateTolerance::Share)];
            points(
                clock,
                law,
                setting,
                law_us,
                Request { points: Some(asked), rates, ..Request::within(setting.tolerance) },
            )
        }
    }
}

/// An outline of arcs or splines with its files.
fn outline(
    clock: TradeClock<'_>,
    law: &TradeLaw,
    setting: &TradeSetting,
    law_us: f64,
    request: Request,
) -> Result<(TradeRow, RoundTimes), Refusal> {
    let (outline, drawing) = timed(clock, || law.cam.draw(request).map_err(Refusal::of))?;
    let parts = drawing.drawn().map(|drawn| drawn.parts.as_slice()).unwrap_or_default();
    let (dxf, _) = timed(clock, || {
        let files = parts.iter().map(|part| proof::write(part, dxf::Version::R2000).map_err(Refusal::of));
        files.collect::<Result<Vec<_>, _>>()
    })?;
    let deviation = parts.iter().map(|part| part.outline.deviation).fold(0.0, f64::max);
    let (proof, proven) = timed(clock, || drawing.prove().map_err(Refusal::of))?;
    let report = Box::new(proven.report());
    let rendering = proven.rendering(&report, SAMPLES, svg::TEMPLATE).map_err(Refusal::of)?;
    let ([svg, step, csv], sizes) = formats(clock, &rendering)?;
    let bytes: usize = proven.cut_files().iter().map(Vec::len).sum();
    let times = RoundTimes { law: law_us, outline, dxf, proof, svg, step, csv };
    let contour = proven.outlines().first().map(|outline| &outline.contour);
    let row = TradeRow {
        arcs: contour.map_or(0, Contour::arcs),
        pieces: contour.map_or(0, |contour| contour.vertices.len()),
        machining_s: contour.map_or(0.0, |contour| machining(law, contour)),
        failed: names(failed(proven.findings())),
        bytes: bytes + sizes,
        deviation_mm: deviation,
        torque_error_nm: torque_error(law, proven.outlines()),
        ..rolled(TradeRow::new(law, setting, law_us, step), law, proven.rolled())
    };
    Ok((row, times))
}

/// A table of points, and the motion of the follower on the curve that a control makes of it.
fn points(
    clock: TradeClock<'_>,
    law: &TradeLaw,
    setting: &TradeSetting,
    law_us: f64,
    request: Request,
) -> Result<(TradeRow, RoundTimes), Refusal> {
    let body = law.cam.body();
    let request = request.resolved(body).map_err(Refusal::of)?;
    let whole = law.cam.draw(Request::within(setting.tolerance)).map_err(Refusal::of)?;
    let drawn = whole.drawn().ok_or_else(|| Refusal::new("there is no outline"))?;
    let (placing, tables) = timed(clock, || points::tables(body, &request, drawn).map_err(Refusal::of))?;
    let Some(table) = tables.first() else { return Err(Refusal::new("there is no table of points")) };
    let (writing, bytes) = timed(clock, || Ok(points::write(body, table)))?;
    let (checking, (outline, rolled_on)) = timed(clock, || {
        let read = points::read(&bytes).map_err(Refusal::new)?;
        let curve = Interpolant::new(&read.rows, read.form, read.between, read.closed);
        let contour = Contour::from_edges(curve.edges().unwrap_or_default());
        let outline = WrittenOutline { cut: 0, z: 0.0, contour, others: Vec::new() };
        let found = rolling::roll_all(body, std::slice::from_ref(&outline), 1e3 * setting.tolerance).pop();
        Ok((outline, found))
    })?;
    let times = RoundTimes {
        law: law_us,
        outline: placing,
        dxf: writing,
        proof: writing + checking,
        svg: None,
        step: None,
        csv: None,
    };
    let row = TradeRow {
        pieces: table.rows.rows.len(),
        failed: names(failed(whole.prove().map_err(Refusal::of)?.findings())),
        machining_s: machining(law, &outline.contour),
        bytes: bytes.len(),
        deviation_mm: table.rows.error,
        torque_error_nm: torque_error(law, &[outline]),
        ..rolled(TradeRow::new(law, setting, law_us, None), law, rolled_on.as_ref())
    };
    Ok((row, times))
}

fn names(checks: Vec<&str>) -> Vec<String> {
    checks.into_iter().map(str::to_owned).collect()
}

/// Seconds along an outline at the feed of the machine file.
fn machining(law: &TradeLaw, contour: &Contour) -> f64 {
    contour.length() / (MILLIMETRES * law.cam.body().machine().cutting().feed)
}

/// A row with the results of rolling.
fn rolled(row: TradeRow, law: &TradeLaw, rolled: Option<&Rolled>) -> TradeRow {
    let as_cut = rolled.and_then(|rolled| rolled.as_cut);
    TradeRow {
        rolled_mm: rolled.map(|rolled| rolled.gap_mm.abs()),
        velocity_error_mm_per_rad: as_cut.map(|error| error.velocity_error.0),
        acceleration_error_mm_per_rad2: as_cut.map(|error| error.acceleration_error.0),
        acceleration_error_m_per_s2: as_cut
            .filter(|error| !error.swings)
            .and_then(|error| error.acceleration(error.acceleration_error.0)),
        acceleration_share: as_cut.and_then(|error| error.acceleration_share()),
        // The residual force of the law itself does not depend on the outline.
        residual_n: rolled.map_or(0.0, |rolled| rolled.residual_max_n).max(law.residual_n),
        ..row
    }
}

/// Largest roller force times velocity error over the rows of the table, N·m; `None` of a plate, which turns nothing.
fn torque_error(law: &TradeLaw, outlines: &[WrittenOutline]) -> Option<f64> {
    let table = csv::table(law.cam.body(), None, outlines, SAMPLES);
    let [force, motion, cut] = ["roller_force_n", "velocity_mm_per_rad", "velocity_cut_mm_per_rad"]
        .map(|name| table.columns.iter().position(|column| *column == name));
    let (force, motion, cut) = (force?, motion?, cut?);
    let rows = table.rows.iter();
    let errors = rows.filter_map(|row| Some(1e-3 * row.get(force)? * (row.get(cut)? - row.get(motion)?)));
    Some(errors.map(f64::abs).fold(0.0, f64::max))
}

/// Times of the formats other than the cut file that the cam can have, and the bytes of all.
fn formats(clock: TradeClock<'_>, rendering: &Rendering<'_>) -> Result<([Option<f64>; 3], usize), Refusal> {
    let (mut times, mut sizes) = ([None; 3], 0);
    let views: [&View; 3] = [&svg::FORMAT, &step::FORMAT, &csv::FORMAT];
    for (view, time) in views.into_iter().zip(&mut times) {
        if (view.unfit)(rendering.body).is_none() {
            let (micros, files) = timed(clock, || (view.write)(rendering).map_err(Refusal::of))?;
            *time = Some(micros);
            sizes += files.iter().map(Vec::len).sum::<usize>();
        }
    }
    Ok((times, sizes))
}

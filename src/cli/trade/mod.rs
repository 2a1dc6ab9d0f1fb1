//! `camgen trade`: speed against accuracy, measured on the user's computer.

mod settings;
mod shaft;
mod tell;

use super::args::{CamKind, TradeArgs};
use super::progress::Progress;
use super::put::put;
use super::{Failure, Outcome, print};
use camgen::body::points::{self, Points};
use camgen::body::{RateTolerance, Request};
use camgen::document::Input;
use camgen::geometry::contour::Contour;
use camgen::geometry::points::{Between, Form, Interpolant, Step};
use camgen::machine::Machine;
use camgen::pipeline::Cam;
use camgen::profile::outline::{Fit, Laid};
use camgen::report::{Rolled, shown};
use camgen::verify::{WrittenOutline, rolling};
use camgen::write::files::Output;
use camgen::write::number::{names, shortest};
use camgen::write::record::{Run, refuse_kept, stage_recorded};
use camgen::write::{self, dxf, json, proof, svg};
use camgen::write::{FORMATS, Rendering};
use serde::Serialize;
use std::time::Instant;

/// Rows of the point table.
const SAMPLES: u32 = 720;
/// Rounds over all settings, at the least and at the most: every setting is made once in each, so that what else the computer does
/// falls on all of them alike.
const LEAST_ROUNDS: usize = 7;
const MOST_ROUNDS: usize = 40;
/// Rounds over which the order of the settings must not have changed.
const UNCHANGED: usize = 5;
/// Largest residual force by default, as a share of the largest inertia.
const SHARE: f64 = 1e-4;
/// Largest error of the acceleration of a motion program by default, as a share: that of `--accuracy standard`.
const ACCELERATION: f64 = 0.05;
/// The machine of the flags where none is given, and the program that is measured then.
const PRESS: &str = "dpi";
const PROGRAM: &str = "feeder";

/// One setting, measured: medians over the rounds.
#[derive(Debug, Clone, Serialize)]
struct Row {
    setting: String,
    law_us: f64,
    outline_us: f64,
    checks_us: f64,
    dxf_us: f64,
    svg_us: f64,
    step_us: Option<f64>,
    csv_us: f64,
    total_us: f64,
    arcs: usize,
    bytes: usize,
    law_error_mm: f64,
    deviation_mm: f64,
    residual_n: f64,
    /// Arcs, lines and spans of an outline, or rows of a table.
    pieces: usize,
    /// Largest gap under the rolled follower.
    rolled_mm: Option<f64>,
    velocity_error_mm_per_rad: Option<f64>,
    acceleration_error_mm_per_rad2: Option<f64>,
    acceleration_share: Option<f64>,
    /// Roller force times velocity error, at its largest, on the camshaft.
    torque_error_nm: Option<f64>,
    /// Quartiles of the total: half of the rounds lie between them.
    total_low_us: f64,
    total_high_us: f64,
}

/// Times of one round, µs.
#[derive(Debug, Clone, Copy)]
struct Times {
    law: f64,
    outline: f64,
    dxf: f64,
    /// Writing, reading back and checking.
    proof: f64,
    svg: Option<f64>,
    step: Option<f64>,
    csv: Option<f64>,
}

impl Times {
    fn total(&self) -> f64 {
        let formats = [self.svg, self.step, self.csv].into_iter().flatten().sum::<f64>();
        self.law + self.outline + self.proof + formats
    }
}

/// A law, solved once for every setting that uses it.
struct Law {
    solve: Box<dyn Fn() -> Result<Cam, Failure>>,
    cam: Cam,
    error_mm: f64,
    /// What it leaves of itself, without an outline, N.
    residual_n: f64,
}

/// One setting of the ladder.
struct Setting {
    name: String,
    /// Its law, by number.
    law: usize,
    /// Tolerance of the outline, m.
    tolerance: f64,
    made: Made,
}

/// What is made of a cam.
#[derive(Debug, Clone, Copy)]
enum Made {
    /// An outline, which may also keep the acceleration to a share of its largest.
    Outline { laid: Laid, share: Option<f64> },
    /// A table of points, in x and y by equal chord error, which may also keep the acceleration to a share of its largest.
    Points { between: Between, share: Option<f64> },
}

/// What the advice must keep.
#[derive(Debug, Clone, Copy)]
struct Limits {
    /// Largest residual force, N; `None` of a cam without load.
    residual: Option<f64>,
    /// Largest error of the acceleration over its largest.
    acceleration: Option<f64>,
}

impl Limits {
    fn words(self) -> String {
        let force = self.residual.map(|residual| format!("{} N", shown(residual)));
        let share = self.acceleration.map(|share| format!("{} % of the acceleration", shown(100.0 * share)));
        force.into_iter().chain(share).collect::<Vec<_>>().join(" and ")
    }

    /// What a setting leaves of what is limited first.
    fn left(self, row: &Row) -> f64 {
        if self.residual.is_some() { row.residual_n } else { row.acceleration_share.unwrap_or(f64::INFINITY) }
    }

    /// The same in words.
    fn left_words(self, row: &Row) -> String {
        let left = self.left(row);
        if self.residual.is_some() { format!("{} N", shown(left)) } else { format!("{} % of it", shown(100.0 * left)) }
    }

    fn keeps(self, row: &Row) -> bool {
        let share = self.acceleration.is_none_or(|limit| row.acceleration_share.is_some_and(|share| share <= limit));
        self.residual.is_none_or(|limit| row.residual_n <= limit) && share
    }
}

#[derive(Debug, Serialize)]
struct TradeReport<'a> {
    schema: u32,
    command: &'static str,
    cam: &'static str,
    machine: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    rpm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    residual_limit_n: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    acceleration_limit: Option<f64>,
    rounds: usize,
    ranking_stable: bool,
    rows: &'a [Row],
    advice: String,
    files: Vec<String>,
}

pub(super) fn run(args: &TradeArgs) -> Result<Outcome, Failure> {
    if args.kind == CamKind::Shaft {
        return shaft::run(args);
    }
    let (machine, name) = if args.kind == CamKind::Make && args.common.machine == PRESS {
        args.common.machine_of(PROGRAM)?
    } else {
        args.common.machine()?
    };
    let Traded { kind, rpm, laws, settings, limits } = traded(args, &machine)?;
    let at = rpm.map_or(String::new(), |rpm| format!("-{}rpm", names(&[rpm]).concat()));
    let stem = args.name.clone().unwrap_or_else(|| format!("{name}-trade-{kind}{at}"));
    let output = |ending: &str, bytes: Vec<u8>| Output { name: format!("{stem}.{ending}"), bytes };
    if !args.overwrite && !args.common.told.dry_run {
        refuse_kept(&args.out, &["csv", "svg"].map(|ending| output(ending, Vec::new()))).map_err(Failure::new)?;
    }
    let Measured { rows, rounds, stable } = measured(args, &laws, &settings, limits)?;
    let advice = tell::advice(&rows, limits, stable);
    let against = if limits.residual.is_some() { "force" } else { "gap" };
    let speed = rpm.map_or(String::new(), |rpm| format!(" at {} rpm", shortest(rpm)));
    let title = format!("{}: time against {against} and acceleration of a {}{speed}", machine.name(), tell::noun(kind));
    let picture = svg::write(&tell::picture(&rows, limits, &title), svg::TEMPLATE).map_err(Failure::new)?;
    let outputs = vec![output("csv", tell::table(&rows).into_bytes()), output("svg", picture)];
    let mut inputs = machine.inputs(kind);
    inputs.push(Input::word("command", format!("trade {kind}")));
    inputs.extend(rpm.map(|rpm| Input::number("rpm", rpm)));
    let files = named(args, &outputs);
    let report = TradeReport {
        schema: 1,
        command: "trade",
        cam: kind,
        machine: machine.name(),
        rpm,
        residual_limit_n: limits.residual,
        acceleration_limit: limits.acceleration,
        rounds,
        ranking_stable: stable,
        rows: &rows,
        advice,
        files,
    };
    let show = || {
        if args.common.told.json {
            let bytes = json::write(&report).map_err(Failure::new)?;
            print(&String::from_utf8_lossy(&bytes))
        } else if args.common.told.quiet {
            Ok(())
        } else {
            print(&tell::words(&report))
        }
    };
    written(args, outputs, &Run { stem: &stem, inputs: &inputs, overwrite: args.overwrite }, show)?;
    Ok(Outcome::Fine)
}

/// What is measured, and what the advice must keep.
struct Traded {
    kind: &'static str,
    rpm: Option<f64>,
    laws: Vec<Law>,
    settings: Vec<Setting>,
    limits: Limits,
}

fn traded(args: &TradeArgs, machine: &Machine) -> Result<Traded, Failure> {
    if args.kind == CamKind::Make {
        if args.residual.is_some() {
            return Err(Failure(
                "--residual belongs to the cams of a press: a motion program balances no force".into(),
            ));
        }
        let rpm = args.common.rpm.first().map(|_| args.common.one_speed(machine)).transpose()?;
        let (laws, settings) = settings::of_program(machine, rpm)?;
        let limits = Limits { residual: None, acceleration: Some(args.acceleration.unwrap_or(ACCELERATION)) };
        let of_file = machine.motion().and_then(|(_, rpm)| rpm);
        return Ok(Traded { kind: "make", rpm: rpm.or(of_file), laws, settings, limits });
    }
    let rpm = args.common.one_speed(machine)?;
    let (kind, (laws, settings)) = match args.kind {
        CamKind::Translating => ("translating", settings::translating(machine, rpm)?),
        _ => ("rotary", settings::rotary(machine, rpm)?),
    };
    let inertia = machine.press().map_err(Failure::new)?.largest_inertia(rpm);
    let limits = Limits { residual: Some(args.residual.unwrap_or(SHARE * inertia)), acceleration: args.acceleration };
    Ok(Traded { kind, rpm: Some(rpm), laws, settings, limits })
}

/// Where the files go; none in a dry run.
fn named(args: &TradeArgs, outputs: &[Output]) -> Vec<String> {
    let outputs = if args.common.told.dry_run { &[] } else { outputs };
    outputs.iter().map(|output| args.out.join(&output.name).display().to_string()).collect()
}

/// Tells, and writes the files; none in a dry run.
fn written(
    args: &TradeArgs,
    outputs: Vec<Output>,
    run: &Run<'_>,
    show: impl Fn() -> Result<(), Failure>,
) -> Result<(), Failure> {
    if args.common.told.dry_run {
        return show();
    }
    let stage =
        |place| stage_recorded(place, outputs, run).map(|(staged, notes)| (notes, staged)).map_err(Failure::new);
    put(&args.out, stage, |_| show())
}

/// Time of some work, µs, and what it made.
fn timed<T>(work: impl FnOnce() -> Result<T, Failure>) -> Result<(f64, T), Failure> {
    let start = Instant::now();
    let made = work()?;
    Ok((1e6 * start.elapsed().as_secs_f64(), made))
}

/// Rows, and how they were found.
struct Measured {
    rows: Vec<Row>,
    rounds: usize,
    /// Whether the order of the rows that keep the limit has settled, and the first of them is faster than the others beyond its spread.
    stable: bool,
}

fn measured(args: &TradeArgs, laws: &[Law], settings: &[Setting], limits: Limits) -> Result<Measured, Failure> {
    let progress = Progress::of_steps(args.common.told.shows_progress(), MOST_ROUNDS * settings.len());
    progress.stage("measuring; it ends when the order has settled");
    measure(laws, settings, limits, &progress)
}

/// Rounds over all settings, until their order has settled.
fn measure(laws: &[Law], settings: &[Setting], limits: Limits, progress: &Progress) -> Result<Measured, Failure> {
    let mut rows: Vec<Row> = Vec::with_capacity(settings.len());
    let mut times: Vec<Vec<Times>> = vec![Vec::new(); settings.len()];
    let (mut order, mut unchanged) = (Vec::new(), 0);
    for round in 1..=MOST_ROUNDS {
        let solved = laws.iter().map(|law| Ok(timed(&law.solve)?.0)).collect::<Result<Vec<f64>, Failure>>()?;
        for (setting, measured) in settings.iter().zip(&mut times) {
            let (Some(law), Some(law_us)) = (laws.get(setting.law), solved.get(setting.law)) else { continue };
            let (row, now) = one_round(law, setting, *law_us)?;
            measured.push(now);
            progress.step();
            if round == 1 {
                rows.push(row);
            }
        }
        rows.iter_mut().zip(&times).for_each(|(row, times)| row.take(times));
        let now = ranking(&rows, limits);
        unchanged = if now == order { unchanged + 1 } else { 0 };
        order = now;
        if round >= LEAST_ROUNDS && unchanged >= UNCHANGED && told_apart(&rows, &order) {
            return Ok(Measured { rows, rounds: round, stable: true });
        }
    }
    Ok(Measured { rows, rounds: MOST_ROUNDS, stable: false })
}

/// The rows that keep the limit, by number, the fastest first.
fn ranking(rows: &[Row], limits: Limits) -> Vec<usize> {
    let mut keep: Vec<(usize, f64)> =
        rows.iter().enumerate().filter(|(_, row)| limits.keeps(row)).map(|(i, row)| (i, row.total_us)).collect();
    keep.sort_by(|a, b| a.1.total_cmp(&b.1));
    keep.into_iter().map(|(index, _)| index).collect()
}

/// Whether three quarters of the rounds of the first row were faster than three quarters of those of the second.
fn told_apart(rows: &[Row], order: &[usize]) -> bool {
    let row = |place: usize| order.get(place).and_then(|index| rows.get(*index));
    match (row(0), row(1)) {
        (Some(first), Some(second)) => first.total_high_us < second.total_low_us,
        _ => true,
    }
}

/// The value below which a share of the values lies.
fn quantile(values: impl Iterator<Item = f64>, share: f64) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "40 rounds"
    )]
    let index = (share * sorted.len().saturating_sub(1) as f64).round() as usize;
    sorted.get(index).copied().unwrap_or(0.0)
}

impl Row {
    /// Nothing measured yet.
    fn of(law: &Law, setting: &Setting, law_us: f64, step_us: Option<f64>) -> Self {
        Self {
            setting: setting.name.clone(),
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
            acceleration_share: None,
            torque_error_nm: None,
            total_low_us: 0.0,
            total_high_us: 0.0,
        }
    }

    /// Medians and quartiles of the rounds so far.
    fn take(&mut self, times: &[Times]) {
        let median = |of: fn(&Times) -> f64| quantile(times.iter().map(of), 0.5);
        self.law_us = median(|t| t.law);
        self.outline_us = median(|t| t.outline);
        self.checks_us = median(|t| (t.proof - t.dxf).max(0.0));
        self.dxf_us = median(|t| t.dxf);
        self.svg_us = median(|t| t.svg.unwrap_or(0.0));
        self.step_us = self.step_us.map(|_| median(|t| t.step.unwrap_or(0.0)));
        self.csv_us = median(|t| t.csv.unwrap_or(0.0));
        self.total_us = median(Times::total);
        self.total_low_us = quantile(times.iter().map(Times::total), 0.25);
        self.total_high_us = quantile(times.iter().map(Times::total), 0.75);
    }
}

/// One setting from the outline on, once.
fn one_round(law: &Law, setting: &Setting, law_us: f64) -> Result<(Row, Times), Failure> {
    match setting.made {
        Made::Outline { laid, share } => {
            let rates = [None, share.map(RateTolerance::Share)];
            let request = Request { rates, ..Request::within(Fit { laid, ..Fit::from(setting.tolerance) }) };
            outline(law, setting, law_us, request)
        }
        Made::Points { between, share } => {
            let asked = Points { form: Some(Form::Plane), step: Some(Step::Chord), between, ..Points::default() };
            let rates = [None, share.map(RateTolerance::Share)];
            points(law, setting, law_us, Request { points: Some(asked), rates, ..Request::within(setting.tolerance) })
        }
    }
}

/// An outline of arcs or splines with its files.
fn outline(law: &Law, setting: &Setting, law_us: f64, request: Request) -> Result<(Row, Times), Failure> {
    let (outline, drawing) = timed(|| law.cam.draw(request).map_err(Failure::new))?;
    let parts = drawing.drawn().map(|drawn| drawn.parts.as_slice()).unwrap_or_default();
    let write = |part| proof::write(part, dxf::Version::R2000).map_err(Failure::new);
    let (dxf, _) = timed(|| parts.iter().map(write).collect::<Result<Vec<_>, _>>())?;
    let deviation = parts.iter().map(|part| part.outline.deviation).fold(0.0, f64::max);
    let (proof, proven) = timed(|| drawing.prove().map_err(Failure::new))?;
    let report = Box::new(proven.report());
    let rendering = proven.rendering(&report, SAMPLES, svg::TEMPLATE).map_err(Failure::new)?;
    let ([svg, step, csv], sizes) = formats(&rendering)?;
    let bytes: usize = proven.cut_files().iter().map(Vec::len).sum();
    let times = Times { law: law_us, outline, dxf, proof, svg, step, csv };
    let contour = proven.outlines().first().map(|outline| &outline.contour);
    let row = Row {
        arcs: contour.map_or(0, Contour::arcs),
        pieces: contour.map_or(0, |contour| contour.vertices.len()),
        bytes: bytes + sizes,
        deviation_mm: deviation,
        torque_error_nm: torque_error(law, proven.outlines()),
        ..rolled(Row::of(law, setting, law_us, step), law, proven.rolled())
    };
    Ok((row, times))
}

/// A table of points, and what the follower does on the curve that a control makes of it.
fn points(law: &Law, setting: &Setting, law_us: f64, request: Request) -> Result<(Row, Times), Failure> {
    let body = law.cam.body();
    let request = request.resolved(body).map_err(Failure::new)?;
    let whole = law.cam.draw(setting.tolerance).map_err(Failure::new)?;
    let parts = whole.drawn().map(|drawn| drawn.parts.as_slice()).unwrap_or_default();
    let (placing, tables) = timed(|| points::tables(body, &request, parts).map_err(Failure::new))?;
    let Some(table) = tables.first() else { return Err(Failure("there is no table of points".into())) };
    let (writing, bytes) = timed(|| Ok(write::points::write(body, table)))?;
    let (checking, (outline, rolled_on)) = timed(|| {
        let read = write::points::read(&bytes).map_err(Failure)?;
        let curve = Interpolant::new(&read.rows, read.form, read.between, read.closed);
        let contour = Contour::of(curve.edges().unwrap_or_default());
        let curves = body.plane();
        let found = curves.map(|curves| rolling::roll(body, curves, &contour, 1e3 * setting.tolerance));
        Ok((WrittenOutline { z: 0.0, contour, beside: Vec::new() }, found))
    })?;
    let times = Times {
        law: law_us,
        outline: placing,
        dxf: writing,
        proof: writing + checking,
        svg: None,
        step: None,
        csv: None,
    };
    let row = Row {
        pieces: table.rows.rows.len(),
        bytes: bytes.len(),
        deviation_mm: table.rows.error,
        torque_error_nm: torque_error(law, &[outline]),
        ..rolled(Row::of(law, setting, law_us, None), law, rolled_on.as_ref())
    };
    Ok((row, times))
}

/// What rolling has shown, in a row.
fn rolled(row: Row, law: &Law, rolled: Option<&Rolled>) -> Row {
    let felt = rolled.and_then(|rolled| rolled.felt);
    Row {
        rolled_mm: rolled.map(|rolled| rolled.gap_mm.abs()),
        velocity_error_mm_per_rad: felt.map(|felt| felt.velocity_error.0),
        acceleration_error_mm_per_rad2: felt.map(|felt| felt.acceleration_error.0),
        acceleration_share: felt.and_then(|felt| felt.acceleration_share()),
        // The residual force of the law itself does not depend on the outline.
        residual_n: rolled.map_or(0.0, |rolled| rolled.residual_max_n).max(law.residual_n),
        ..row
    }
}

/// Largest roller force times velocity error over the rows of the table, N·m; `None` of a plate, which turns nothing.
fn torque_error(law: &Law, outlines: &[WrittenOutline]) -> Option<f64> {
    let table = write::csv::table(law.cam.body(), None, outlines, SAMPLES);
    let column = |name: &str| table.columns.iter().position(|column| *column == name);
    let [force, motion, cut] = ["roller_force_n", "velocity_mm_per_rad", "velocity_cut_mm_per_rad"].map(column);
    let (force, motion, cut) = (force?, motion?, cut?);
    let of_row = |row: &Vec<f64>| Some(1e-3 * row.get(force)? * (row.get(cut)? - row.get(motion)?));
    Some(table.rows.iter().filter_map(of_row).map(f64::abs).fold(0.0, f64::max))
}

/// Times of the formats beside the cut file, those that the cam can have, and the bytes of all.
fn formats(rendering: &Rendering<'_>) -> Result<([Option<f64>; 3], usize), Failure> {
    let (mut times, mut sizes) = ([None; 3], 0);
    for (name, time) in ["svg", "step", "csv"].into_iter().zip(&mut times) {
        let fits = FORMATS.iter().find(|format| format.name == name && (format.unfit)(rendering.body).is_none());
        if let Some(format) = fits {
            let (micros, files) = timed(|| (format.write)(rendering).map_err(Failure::new))?;
            *time = Some(micros);
            sizes += files.iter().map(Vec::len).sum::<usize>();
        }
    }
    Ok((times, sizes))
}

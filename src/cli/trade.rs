//! `camgen trade`: speed against accuracy, measured on the user's computer.

use super::args::{CamKind, TradeArgs};
use super::{Failure, Outcome, print};
use camgen::body::wedge::Wedge;
use camgen::machine::Machine;
use camgen::motion::equation_18::{BottomMotion, ExactOn, Solver, Way};
use camgen::pipeline::{Cam, Spec};
use camgen::report::chart::{self, Point};
use camgen::report::sheet::Sheet;
use camgen::report::shown;
use camgen::write::files::{Output, write_all};
use camgen::write::number::{names, shortest};
use camgen::write::{FORMATS, Rendering};
use camgen::write::{dxf, json, proof, svg};
use serde::Serialize;
use std::time::Instant;

/// Surface tolerances of the ladder, m, from coarse to fine; those of `--accuracy` by their names.
const TOLERANCES: [(&str, f64); 9] = [
    ("100 µm", 100e-6),
    ("50 µm (draft)", 50e-6),
    ("10 µm", 10e-6),
    ("5 µm (standard)", 5e-6),
    ("1 µm", 1e-6),
    ("0.5 µm (fine)", 0.5e-6),
    ("0.1 µm", 0.1e-6),
    ("0.05 µm", 0.05e-6),
    ("0.01 µm", 0.01e-6),
];
/// Tolerances of the differential equation, by name in mm and in m, and stations of the paper's method.
const ODE: [(&str, f64); 4] = [("1e-3", 1e-6), ("1e-6", 1e-9), ("1e-9", 1e-12), ("1e-12", 1e-15)];
const STATIONS: [u32; 4] = [18, 180, 1800, 18_000];
/// Tolerance of the outline on the ladder of the law, m.
const LAW_LADDER_TOLERANCE: f64 = 1e-6;
/// Rows of the point table.
const SAMPLES: u32 = 720;
/// Rounds over all settings, at the least and at the most: every setting is made once in each, so that what else the computer does
/// falls on all of them alike.
const LEAST_ROUNDS: usize = 7;
const MOST_ROUNDS: usize = 40;
/// Rounds over which the order of the settings must not have changed.
const UNCHANGED: usize = 5;
/// Places at which two motions are compared.
const PLACES: u32 = 360;
/// Largest residual force by default, as a share of the largest inertia.
const SHARE: f64 = 1e-4;

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
}

#[derive(Debug, Serialize)]
struct TradeReport<'a> {
    schema: u32,
    command: &'static str,
    cam: &'static str,
    machine: &'a str,
    rpm: f64,
    residual_limit_n: f64,
    rounds: usize,
    ranking_stable: bool,
    rows: &'a [Row],
    advice: String,
    files: Vec<String>,
}

pub(super) fn run(args: &TradeArgs) -> Result<Outcome, Failure> {
    let (machine, name) = args.common.machine()?;
    let rpm = args.common.one_speed(&machine)?;
    let (laws, settings) = match args.kind {
        CamKind::Rotary => rotary(&machine, rpm)?,
        CamKind::Translating => translating(&machine, rpm)?,
    };
    let kind = match args.kind {
        CamKind::Rotary => "rotary",
        CamKind::Translating => "translating",
    };
    let inertia = machine.press().map_err(Failure::new)?.bed.largest_inertia(rpm);
    let limit = args.residual.unwrap_or(SHARE * inertia);
    let Measured { rows, rounds, stable } = measure(&laws, &settings, limit)?;
    let advice = advice(&rows, limit, stable);
    let stem = args.name.clone().unwrap_or_else(|| format!("{name}-trade-{kind}-{}rpm", names(&[rpm]).concat()));
    let title = format!("{}: time against residual force of a {kind} cam at {} rpm", machine.name(), shortest(rpm));
    let picture = svg::write(&picture(&rows, &title), svg::TEMPLATE).map_err(Failure::new)?;
    let outputs = [
        Output { name: format!("{stem}.csv"), bytes: table(&rows).into_bytes() },
        Output { name: format!("{stem}.svg"), bytes: picture },
    ];
    write_all(&args.out, &outputs).map_err(Failure::new)?;
    let files = outputs.iter().map(|output| args.out.join(&output.name).display().to_string()).collect();
    let report = TradeReport {
        schema: 1,
        command: "trade",
        cam: kind,
        machine: machine.name(),
        rpm,
        residual_limit_n: limit,
        rounds,
        ranking_stable: stable,
        rows: &rows,
        advice,
        files,
    };
    if args.common.json {
        let bytes = json::write(&report).map_err(Failure::new)?;
        print(&String::from_utf8_lossy(&bytes))?;
    } else if !args.common.quiet {
        print(&words(&report))?;
    }
    Ok(Outcome::Fine)
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

/// Rounds over all settings, until their order has settled.
fn measure(laws: &[Law], settings: &[Setting], limit: f64) -> Result<Measured, Failure> {
    let mut rows: Vec<Row> = Vec::with_capacity(settings.len());
    let mut times: Vec<Vec<Times>> = vec![Vec::new(); settings.len()];
    let (mut order, mut unchanged) = (Vec::new(), 0);
    for round in 1..=MOST_ROUNDS {
        let solved = laws.iter().map(|law| Ok(timed(&law.solve)?.0)).collect::<Result<Vec<f64>, Failure>>()?;
        for (setting, measured) in settings.iter().zip(&mut times) {
            let (Some(law), Some(law_us)) = (laws.get(setting.law), solved.get(setting.law)) else { continue };
            let (row, now) = one_round(law, setting, *law_us)?;
            measured.push(now);
            if round == 1 {
                rows.push(row);
            }
        }
        rows.iter_mut().zip(&times).for_each(|(row, times)| row.take(times));
        let now = ranking(&rows, limit);
        unchanged = if now == order { unchanged + 1 } else { 0 };
        order = now;
        if round >= LEAST_ROUNDS && unchanged >= UNCHANGED && told_apart(&rows, &order) {
            return Ok(Measured { rows, rounds: round, stable: true });
        }
    }
    Ok(Measured { rows, rounds: MOST_ROUNDS, stable: false })
}

/// The rows that keep the limit, by number, the fastest first.
fn ranking(rows: &[Row], limit: f64) -> Vec<usize> {
    let mut keep: Vec<(usize, f64)> =
        rows.iter().enumerate().filter(|(_, row)| row.residual_n <= limit).map(|(i, row)| (i, row.total_us)).collect();
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
    let (outline, drawing) = timed(|| law.cam.draw(setting.tolerance).map_err(Failure::new))?;
    let parts = drawing.drawn().map(|drawn| drawn.parts.as_slice()).unwrap_or_default();
    let write = |part| proof::write(part, dxf::Version::R2000).map_err(Failure::new);
    let (dxf, _) = timed(|| parts.iter().map(write).collect::<Result<Vec<_>, _>>())?;
    let deviation = parts.iter().map(|part| part.outline.deviation).fold(0.0, f64::max);
    let (proof, proven) = timed(|| drawing.prove().map_err(Failure::new))?;
    let report = proven.report();
    let rendering = proven.rendering(&report, SAMPLES, svg::TEMPLATE).map_err(Failure::new)?;
    let ([svg, step, csv], sizes) = formats(&rendering)?;
    let bytes: usize = proven.cut_files().iter().map(Vec::len).sum();
    let times = Times { law: law_us, outline, dxf, proof, svg, step, csv };
    let row = Row {
        setting: setting.name.clone(),
        law_us,
        outline_us: 0.0,
        checks_us: 0.0,
        dxf_us: 0.0,
        svg_us: 0.0,
        step_us: step,
        csv_us: 0.0,
        total_us: 0.0,
        arcs: proven.outlines().iter().map(|outline| outline.contour.arcs()).sum(),
        bytes: bytes + sizes,
        law_error_mm: law.error_mm,
        deviation_mm: deviation,
        // The residual force of the law itself does not depend on the outline.
        residual_n: proven.rolled().map_or(0.0, |rolled| rolled.residual_max_n).max(law.residual_n),
        total_low_us: 0.0,
        total_high_us: 0.0,
    };
    Ok((row, times))
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

type Ladder = (Vec<Law>, Vec<Setting>);

/// The surface ladder with the first law.
fn ladder() -> Vec<Setting> {
    TOLERANCES.iter().map(|(name, tolerance)| Setting { name: (*name).into(), law: 0, tolerance: *tolerance }).collect()
}

/// The disc cam over the ladder; its law is a closed form, exact to rounding.
fn rotary(machine: &Machine, rpm: f64) -> Result<Ladder, Failure> {
    let machine = machine.clone();
    let solve = move || Spec::rotary(machine.clone(), rpm).solve().map_err(Failure::new);
    let law = Law { cam: solve()?, solve: Box::new(solve), error_mm: 0.0, residual_n: 0.0 };
    Ok((vec![law], ladder()))
}

/// The plate: the surface ladder with the finest law, then the law's own ladder at 1 µm. Every law is solved once a round.
fn translating(machine: &Machine, rpm: f64) -> Result<Ladder, Failure> {
    let [.., (_, finest)] = ODE;
    let solve = |solver: Solver| Wedge::solve(machine, rpm, solver, ExactOn::Braking).map_err(Failure::new);
    let truth = solve(Solver::Ode { tolerance: finest })?;
    let law = |solver: Solver| {
        let (machine, plate) = (machine.clone(), solve(solver)?);
        let spec = move || Spec::translating(machine.clone(), rpm, solver, ExactOn::Braking);
        let solve = move || spec().solve().map_err(Failure::new);
        let (error_mm, residual_n) = (1e3 * apart(&truth, &plate), plate.residual_max(Way::Braking).value);
        Ok(Law { cam: solve()?, solve: Box::new(solve), error_mm, residual_n })
    };
    let ode = |(name, tolerance): &(&str, f64)| (format!("ode {name} mm, 1 µm"), Solver::Ode { tolerance: *tolerance });
    let paper = |stations: &u32| (format!("paper {stations}, 1 µm"), Solver::Paper { stations: *stations });
    let of_law: Vec<(String, Solver)> = ODE.iter().map(ode).chain(STATIONS.iter().map(paper)).collect();
    let mut laws = vec![law(Solver::Ode { tolerance: finest })?];
    let mut settings = ladder();
    for (name, solver) in of_law {
        let is_finest = solver == Solver::Ode { tolerance: finest };
        if !is_finest {
            laws.push(law(solver)?);
        }
        let number = if is_finest { 0 } else { laws.len() - 1 };
        settings.push(Setting { name, law: number, tolerance: LAW_LADDER_TOLERANCE });
    }
    Ok((laws, settings))
}

/// Largest distance of two motions over the stroke, m.
fn apart(a: &Wedge, b: &Wedge) -> f64 {
    let at = |motion: &BottomMotion, x: f64| motion.at(x, false)[0];
    let off = |i: u32| {
        let x = a.stroke() * f64::from(i) / f64::from(PLACES);
        (at(a.motion().motion(), x) - at(b.motion().motion(), x)).abs()
    };
    (0..=PLACES).map(off).fold(0.0, f64::max)
}

/// Which setting to take. Where several cannot be told apart by their times, it is the one of them that leaves least.
fn advice(rows: &[Row], limit: f64, stable: bool) -> String {
    let order = ranking(rows, limit);
    let ranked: Vec<&Row> = order.iter().filter_map(|index| rows.get(*index)).collect();
    let words = |row: &Row| {
        format!(
            "{} is the cheapest setting that leaves no more than {} N: it leaves {} N for {:.2} ms",
            row.setting,
            shown(limit),
            shown(row.residual_n),
            1e-3 * row.total_us
        )
    };
    match ranked.as_slice() {
        [] => nothing_keeps(rows, limit),
        [first, ..] if stable => words(first),
        [first, ..] => {
            let alike: Vec<&&Row> = ranked.iter().filter(|row| row.total_low_us <= first.total_high_us).collect();
            let names: Vec<&str> = alike.iter().map(|row| &*row.setting).collect();
            let least = alike.iter().min_by(|a, b| a.residual_n.total_cmp(&b.residual_n));
            let best: &Row = least.map_or(first, |row| row);
            if alike.len() > 1 {
                let names = names.join(", ");
                let why = format!("the times of {names} cannot be told apart on this computer now");
                format!("{}; {why}: of them it leaves least", words(best))
            } else {
                format!("{}; the order of the slower settings did not settle", words(best))
            }
        }
    }
}

/// No setting keeps the limit: which comes nearest, and whether a finer one could.
fn nothing_keeps(rows: &[Row], limit: f64) -> String {
    let Some(least) = rows.iter().min_by(|a, b| a.residual_n.total_cmp(&b.residual_n)) else {
        return "nothing was measured".into();
    };
    format!(
        "no setting leaves less than {} N; {} leaves least, {} N for {:.2} ms",
        shown(limit),
        least.setting,
        shown(least.residual_n),
        1e-3 * least.total_us
    )
}

const COLUMNS: [&str; 16] = [
    "setting",
    "law_us",
    "outline_us",
    "checks_us",
    "dxf_us",
    "svg_us",
    "step_us",
    "csv_us",
    "total_us",
    "arcs",
    "bytes",
    "law_error_mm",
    "deviation_mm",
    "residual_n",
    "total_low_us",
    "total_high_us",
];

fn table(rows: &[Row]) -> String {
    let mut text = COLUMNS.join(",");
    text.push('\n');
    for row in rows {
        let step = row.step_us.map_or(String::new(), |time| format!("{time:.2}"));
        text.push_str(&format!(
            "\"{}\",{:.2},{:.2},{:.2},{:.2},{:.2},{step},{:.2},{:.2},{},{},{:e},{:e},{:e},{:.2},{:.2}\n",
            row.setting,
            row.law_us,
            row.outline_us,
            row.checks_us,
            row.dxf_us,
            row.svg_us,
            row.csv_us,
            row.total_us,
            row.arcs,
            row.bytes,
            row.law_error_mm,
            row.deviation_mm,
            row.residual_n,
            row.total_low_us,
            row.total_high_us
        ));
    }
    text
}

fn words(report: &TradeReport<'_>) -> String {
    let mut lines = vec![
        format!(
            "{} · {} cam at {} rpm: time by stage, µs, median of {} rounds; half of the totals lie in the spread",
            report.machine, report.cam, report.rpm, report.rounds
        ),
        format!(
            "  {:<22} {:>8} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>8} {:>13} {:>5} {:>8} {:>10} {:>10} {:>10}",
            "setting",
            "law",
            "outline",
            "checks",
            "dxf",
            "svg",
            "step",
            "csv",
            "total",
            "spread",
            "arcs",
            "bytes",
            "law err/mm",
            "off/mm",
            "left/N"
        ),
    ];
    for row in report.rows {
        let step = row.step_us.map_or("–".to_owned(), |time| format!("{time:.0}"));
        let spread = format!("{:.0}…{:.0}", row.total_low_us, row.total_high_us);
        lines.push(format!(
            "  {:<22} {:>8.0} {:>8.0} {:>8.0} {:>7.0} {:>7.0} {step:>7} {:>7.0} {:>8.0} {spread:>13} {:>5} {:>8} {:>10.1e} {:>10.1e} {:>10.3e}",
            row.setting, row.law_us, row.outline_us, row.checks_us, row.dxf_us, row.svg_us, row.csv_us, row.total_us,
            row.arcs, row.bytes, row.law_error_mm, row.deviation_mm, row.residual_n
        ));
    }
    lines.push(format!("  {}", report.advice));
    lines.extend(report.files.iter().map(|file| format!("    {file}")));
    lines.push(String::new());
    lines.join("\n")
}

/// Total time against residual force, with the Pareto front.
fn picture(rows: &[Row], title: &str) -> Sheet {
    let point = |row: &Row| Point { x: row.total_us, y: row.residual_n, label: row.setting.clone(), best: false };
    let mut points: Vec<Point> = rows.iter().map(point).collect();
    chart::mark_front(&mut points);
    chart::chart(title, "total time, µs", "residual force, N", &points)
}

//! `camgen trade`: speed against accuracy, measured on the user's computer.

use super::args::{CamKind, TradeArgs};
use super::{Failure, Outcome, print};
use camgen::body::wedge::Wedge;
use camgen::machine::Machine;
use camgen::motion::equation_18::{BottomMotion, ExactOn, Solver, Way};
use camgen::pipeline::{Cam, Spec};
use camgen::report::chart::{self, Point};
use camgen::report::sheet::Sheet;
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
/// Runs of a stage; the median counts.
const RUNS: usize = 7;
/// Places at which two motions are compared.
const PLACES: u32 = 360;
/// Largest residual force by default, as a share of the largest inertia.
const SHARE: f64 = 1e-4;

/// One setting, measured.
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
}

#[derive(Debug, Serialize)]
struct TradeReport<'a> {
    schema: u32,
    command: &'static str,
    cam: &'static str,
    machine: &'a str,
    rpm: f64,
    residual_limit_n: f64,
    rows: &'a [Row],
    advice: String,
    files: Vec<String>,
}

pub(super) fn run(args: &TradeArgs) -> Result<Outcome, Failure> {
    let (machine, name) = args.common.machine()?;
    let rpm = args.common.one_speed(&machine)?;
    let rows = match args.kind {
        CamKind::Rotary => rotary(&machine, rpm)?,
        CamKind::Translating => translating(&machine, rpm)?,
    };
    let kind = match args.kind {
        CamKind::Rotary => "rotary",
        CamKind::Translating => "translating",
    };
    let inertia = machine.press().map_err(Failure::new)?.bed.largest_inertia(rpm);
    let limit = args.residual.unwrap_or(SHARE * inertia);
    let advice = advice(&rows, limit);
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

/// Median time of a few runs, µs, and what the last of them made.
fn timed<T>(mut work: impl FnMut() -> Result<T, Failure>) -> Result<(f64, T), Failure> {
    let mut times = Vec::with_capacity(RUNS);
    let mut made = None;
    for _ in 0..RUNS {
        let start = Instant::now();
        made = Some(work()?);
        times.push(1e6 * start.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    match (times.get(RUNS / 2), made) {
        (Some(median), Some(made)) => Ok((*median, made)),
        _ => Err(Failure("nothing was measured".into())),
    }
}

/// One setting from the outline on.
fn measure(cam: &Cam, setting: String, (law_us, law_error): (f64, f64), tolerance: f64) -> Result<Row, Failure> {
    let (outline_us, drawing) = timed(|| cam.draw(tolerance).map_err(Failure::new))?;
    let parts = drawing.drawn().map(|drawn| drawn.parts.as_slice()).unwrap_or_default();
    let write = |part| proof::write(part, dxf::Version::R2000).map_err(Failure::new);
    let (dxf_us, _) = timed(|| parts.iter().map(write).collect::<Result<Vec<_>, _>>())?;
    let (proof_us, proven) = timed(|| drawing.clone().prove().map_err(Failure::new))?;
    let report = proven.report();
    let rendering = proven.rendering(&report, SAMPLES, svg::TEMPLATE).map_err(Failure::new)?;
    let ([svg_us, step_us, csv_us], sizes) = formats(&rendering)?;
    let bytes: usize = proven.cut_files().iter().map(Vec::len).sum();
    Ok(Row {
        setting,
        law_us,
        outline_us,
        checks_us: (proof_us - dxf_us).max(0.0),
        dxf_us,
        svg_us: svg_us.unwrap_or(0.0),
        step_us,
        csv_us: csv_us.unwrap_or(0.0),
        total_us: law_us + outline_us + proof_us + [svg_us, step_us, csv_us].into_iter().flatten().sum::<f64>(),
        arcs: proven.outlines().iter().map(|outline| outline.contour.arcs()).sum(),
        bytes: bytes + sizes,
        law_error_mm: law_error,
        deviation_mm: parts.iter().map(|part| part.outline.deviation).fold(0.0, f64::max),
        residual_n: proven.rolled().map_or(0.0, |rolled| rolled.residual_max_n),
    })
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

/// The disc cam over the ladder; its law is a closed form, exact to rounding.
fn rotary(machine: &Machine, rpm: f64) -> Result<Vec<Row>, Failure> {
    let (law_us, cam) = timed(|| Spec::rotary(machine.clone(), rpm).solve().map_err(Failure::new))?;
    let row = |(name, tolerance): &(&str, f64)| measure(&cam, (*name).into(), (law_us, 0.0), *tolerance);
    TOLERANCES.iter().map(row).collect()
}

/// The plate: the surface ladder with the finest law, then the law's own ladder at 1 µm.
fn translating(machine: &Machine, rpm: f64) -> Result<Vec<Row>, Failure> {
    let solve = |solver: Solver| Wedge::solve(machine, rpm, solver, ExactOn::Braking).map_err(Failure::new);
    let [.., (_, finest)] = ODE;
    let truth = solve(Solver::Ode { tolerance: finest })?;
    let of = |name: String, solver: Solver, tolerance: f64| {
        let spec = || Spec::translating(machine.clone(), rpm, solver, ExactOn::Braking);
        let (law_us, cam) = timed(|| spec().solve().map_err(Failure::new))?;
        let plate = solve(solver)?;
        let row = measure(&cam, name, (law_us, 1e3 * apart(&truth, &plate)), tolerance)?;
        // The residual force of the law itself does not depend on the outline.
        Ok(Row { residual_n: row.residual_n.max(plate.residual_max(Way::Braking).value), ..row })
    };
    let ladder =
        TOLERANCES.iter().map(|(name, tolerance)| of((*name).into(), Solver::Ode { tolerance: finest }, *tolerance));
    let solvers = ODE.iter().map(|(name, tolerance)| {
        of(format!("ode {name} mm, 1 µm"), Solver::Ode { tolerance: *tolerance }, LAW_LADDER_TOLERANCE)
    });
    let paper = STATIONS.iter().map(|stations| {
        of(format!("paper {stations}, 1 µm"), Solver::Paper { stations: *stations }, LAW_LADDER_TOLERANCE)
    });
    ladder.chain(solvers).chain(paper).collect()
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

fn advice(rows: &[Row], limit: f64) -> String {
    let keeps = rows.iter().filter(|row| row.residual_n <= limit);
    match keeps.min_by(|a, b| a.total_us.total_cmp(&b.total_us)) {
        Some(row) => format!(
            "{} is the cheapest setting that leaves no more than {:.3} N: it leaves {:.3} N for {:.2} ms",
            row.setting,
            limit,
            row.residual_n,
            1e-3 * row.total_us
        ),
        None => {
            format!("no setting leaves less than {limit:.3} N; the residual force does not depend on the tolerance")
        }
    }
}

const COLUMNS: [&str; 14] = [
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
];

fn table(rows: &[Row]) -> String {
    let mut text = COLUMNS.join(",");
    text.push('\n');
    for row in rows {
        let step = row.step_us.map_or(String::new(), |time| format!("{time:.2}"));
        text.push_str(&format!(
            "\"{}\",{:.2},{:.2},{:.2},{:.2},{:.2},{step},{:.2},{:.2},{},{},{:e},{:e},{:e}\n",
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
            row.residual_n
        ));
    }
    text
}

fn words(report: &TradeReport<'_>) -> String {
    let mut lines = vec![
        format!(
            "{} · {} cam at {} rpm: time by stage, µs, median of {RUNS} runs",
            report.machine, report.cam, report.rpm
        ),
        format!(
            "  {:<22} {:>8} {:>8} {:>8} {:>7} {:>7} {:>7} {:>7} {:>8} {:>5} {:>8} {:>10} {:>10} {:>10}",
            "setting",
            "law",
            "outline",
            "checks",
            "dxf",
            "svg",
            "step",
            "csv",
            "total",
            "arcs",
            "bytes",
            "law err/mm",
            "off/mm",
            "left/N"
        ),
    ];
    for row in report.rows {
        let step = row.step_us.map_or("–".to_owned(), |time| format!("{time:.0}"));
        lines.push(format!(
            "  {:<22} {:>8.0} {:>8.0} {:>8.0} {:>7.0} {:>7.0} {step:>7} {:>7.0} {:>8.0} {:>5} {:>8} {:>10.1e} {:>10.1e} {:>10.3e}",
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

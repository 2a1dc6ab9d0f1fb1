//! `camgen trade`: speed against accuracy, measured here and now on the user's machine.

use super::args::{CamKind, TradeArgs};
use super::{Failure, Outcome, print};
use camgen::cam::Cam;
use camgen::cam::plate::Plate;
use camgen::cam::rotary::Rotary;
use camgen::checks::{self, Subject, rolling};
use camgen::drawing::sheet::{self, Sheet};
use camgen::drawing::solid::solid;
use camgen::drawing::{self, Part, Report, Table};
use camgen::law::translating::{Exact, Motion, Solver, Way};
use camgen::machine::Machine;
use camgen::output::files::{Output, write_all};
use camgen::output::number::shortest;
use camgen::output::{csv, dxf, json, proof, step, svg};
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
/// Runs of a stage; the median counts.
const RUNS: usize = 7;
/// Places at which two motions are compared.
const PLACES: u32 = 360;
/// Force that may be left when none is asked for, as a share of the largest inertia.
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
    let limit = args.residual.unwrap_or(SHARE * machine.bed.largest_inertia(rpm));
    let advice = advice(&rows, limit);
    let stem = args.name.clone().unwrap_or_else(|| format!("{name}-trade-{kind}-{}rpm", shortest(rpm)));
    let title = format!("{}: what a {kind} cam costs and leaves at {} rpm", machine.name, shortest(rpm));
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
        machine: &machine.name,
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

/// How a cam is drawn and told, for the stages behind the law.
struct Stages<'a> {
    cam: &'a dyn Cam,
    part: &'a dyn Fn(f64) -> Result<Part, Failure>,
    report: &'a dyn Fn(&Part, rolling::Rolled) -> Report,
    sheet: &'a dyn Fn(&Part, &Report) -> Result<Sheet, Failure>,
    table: &'a dyn Fn() -> Table,
}

impl Stages<'_> {
    /// One setting from the outline on.
    fn measure(&self, setting: String, (law_us, law_error): (f64, f64), tolerance: f64) -> Result<Row, Failure> {
        let (outline_us, part) = timed(|| (self.part)(tolerance))?;
        let (dxf_us, written) = timed(|| proof::write(&part, dxf::Version::R2000).map_err(Failure::new))?;
        let tolerance_mm = 1e3 * tolerance;
        let (checks_us, (rolled, _)) = timed(|| {
            let rolled = rolling::roll(self.cam, &written.outline, tolerance_mm);
            let outline = Some(&written.outline);
            let balancing = part.balancing.as_ref();
            let findings =
                checks::run(&Subject { cam: self.cam, outline, rolled: Some(&rolled), balancing, tolerance_mm });
            Ok((rolled, findings))
        })?;
        let residual = rolled.residual_max_n;
        let report = (self.report)(&part, rolled);
        let (svg_us, preview) =
            timed(|| svg::write(&(self.sheet)(&part, &report)?, svg::TEMPLATE).map_err(Failure::new))?;
        let (csv_us, table) = timed(|| Ok(csv::write(&(self.table)())))?;
        let solid =
            self.cam.machine().cam.thickness.map(|thickness| {
                timed(|| Ok(step::write(&solid(&part, 1e3 * thickness).map_err(Failure::new)?, "cam")))
            });
        let (step_us, solid) = solid.transpose()?.map_or((None, 0), |(time, bytes)| (Some(time), bytes.len()));
        Ok(Row {
            setting,
            law_us,
            outline_us,
            checks_us,
            dxf_us,
            svg_us,
            step_us,
            csv_us,
            total_us: law_us + outline_us + checks_us + dxf_us + svg_us + step_us.unwrap_or(0.0) + csv_us,
            arcs: part.outline.contour.vertices.iter().filter(|vertex| vertex.bulge != 0.0).count(),
            bytes: written.bytes.len() + preview.len() + table.len() + solid,
            law_error_mm: law_error,
            deviation_mm: part.outline.deviation,
            residual_n: residual,
        })
    }
}

/// The disc cam over the ladder; its law is a closed form, exact to rounding.
fn rotary(machine: &Machine, rpm: f64) -> Result<Vec<Row>, Failure> {
    let (law_us, rotary) = timed(|| Rotary::solve(machine, rpm).map_err(Failure::new))?;
    let stages = Stages {
        cam: &rotary,
        part: &|tolerance| drawing::part(&rotary, tolerance).map_err(Failure::new),
        report: &|part, rolled| drawing::report(&rotary, Some(part), Some(rolled), 0.0, Vec::new()),
        sheet: &|part, report| sheet::disc(&rotary, part, report).map_err(Failure::new),
        table: &|| drawing::table(&rotary, 720),
    };
    let row = |(name, tolerance): &(&str, f64)| stages.measure((*name).into(), (law_us, 0.0), *tolerance);
    TOLERANCES.iter().map(row).collect()
}

/// The plate: the surface ladder with the finest law, then the law's own ladder at 1 µm.
fn translating(machine: &Machine, rpm: f64) -> Result<Vec<Row>, Failure> {
    let solve = |solver: Solver| Plate::solve(machine, rpm, solver, Exact::Braking).map_err(Failure::new);
    let [.., (_, finest)] = ODE;
    let truth = solve(Solver::Ode { tolerance: finest })?;
    let measure = |name: String, solver: Solver, tolerance: f64| {
        let (law_us, plate) = timed(|| solve(solver))?;
        let error = 1e3 * apart(&truth, &plate);
        // What the law itself leaves is no matter of the outline.
        let law_residual = plate.residual_max(Way::Braking).0;
        let stages = Stages {
            cam: &plate,
            part: &|tolerance| drawing::plate_part(&plate, tolerance).map_err(Failure::new),
            report: &|part, rolled| drawing::plate_report(&plate, Some(part), Some(rolled), 0.0, Vec::new()),
            sheet: &|part, report| sheet::plate(&plate, part, report).map_err(Failure::new),
            table: &|| drawing::plate_table(&plate, 720),
        };
        let row = stages.measure(name, (law_us, error), tolerance)?;
        Ok(Row { residual_n: row.residual_n.max(law_residual), ..row })
    };
    let mut rows: Vec<Row> = Vec::new();
    for (name, tolerance) in TOLERANCES {
        rows.push(measure(name.into(), Solver::Ode { tolerance: finest }, tolerance)?);
    }
    for (name, tolerance) in ODE {
        rows.push(measure(format!("ode {name} mm, 1 µm"), Solver::Ode { tolerance }, 1e-6)?);
    }
    for stations in STATIONS {
        rows.push(measure(format!("paper {stations}, 1 µm"), Solver::Paper { stations }, 1e-6)?);
    }
    Ok(rows)
}

/// Largest distance of two motions over the stroke, m.
fn apart(a: &Plate, b: &Plate) -> f64 {
    let at = |motion: &Motion, x: f64| motion.at(x, false)[0];
    let off = |i: u32| {
        let x = a.stroke() * f64::from(i) / f64::from(PLACES);
        (at(a.curves.law.motion(), x) - at(b.curves.law.motion(), x)).abs()
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
        None => format!("no setting leaves less than {limit:.3} N; what is left is not a matter of the tolerance"),
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

/// Total time against the force that is left, with the Pareto front.
fn picture(rows: &[Row], title: &str) -> Sheet {
    let point =
        |row: &Row| sheet::Point { x: row.total_us, y: row.residual_n, label: row.setting.clone(), best: false };
    let mut points: Vec<sheet::Point> = rows.iter().map(point).collect();
    sheet::mark_front(&mut points);
    sheet::chart(title, "total time, µs", "force left, N", &points)
}

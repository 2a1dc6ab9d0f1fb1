//! `camgen trade shaft`: stations of the paper's method, and orders of the exact one, against the error of the first critical speed.

use super::super::args::TradeArgs;
use super::super::{Failure, Outcome, print};
use super::{named, quantile, timed, written};
use camgen::document::Input;
use camgen::machine::ShaftMachine;
use camgen::report::chart::{self, Panel, Point};
use camgen::report::shown;
use camgen::shaft::{Beam, MOST_ORDER, Shaft, Whirl, exact, paper};
use camgen::write::files::Output;
use camgen::write::record::{Run, refuse_kept};
use camgen::write::{json, svg};
use serde::Serialize;
use std::f64::consts::PI;

/// Stations and orders that are tried.
const STATIONS: [usize; 6] = [9, 18, 36, 180, 1800, 18_000];
const ORDERS: [usize; 5] = [3, 4, 5, 8, 10];
/// Rounds over all settings; their median is told.
const ROUNDS: usize = 15;
/// Largest error that the advice keeps by default, as a share.
const SHARE: f64 = 1e-3;
/// The machine of `camgen shaft`: the press of the other kinds has none.
const MACHINE: &str = "press-cylinder";

/// A setting, measured.
#[derive(Debug, Clone, Serialize)]
struct Row {
    setting: String,
    n1_rpm: f64,
    /// Of the first critical speed, relative.
    error: f64,
    time_us: f64,
}

#[derive(Debug, Serialize)]
struct Report<'a> {
    schema: u32,
    command: &'static str,
    machine: &'a str,
    n1_rpm: f64,
    rows: &'a [Row],
    advice: String,
    files: Vec<String>,
}

/// How one setting finds the first critical speed, rad/s.
enum Setting {
    Paper(usize),
    Exact(Option<usize>),
}

impl Setting {
    fn name(&self) -> String {
        match self {
            Self::Paper(stations) => format!("paper {stations}"),
            Self::Exact(Some(order)) => format!("exact {order}"),
            Self::Exact(None) => "exact auto".into(),
        }
    }

    fn solve(&self, shaft: &Shaft) -> Result<f64, Failure> {
        match self {
            Self::Paper(stations) => Ok(paper::first_critical(shaft, *stations).map_err(Failure::new)?.speed),
            Self::Exact(order) => {
                let modes = exact::modes(shaft, Whirl::Planar, 1, *order).map_err(Failure::new)?;
                Ok(modes.modes.first().map_or(f64::NAN, |mode| mode.speed))
            }
        }
    }
}

pub(super) fn run(args: &TradeArgs) -> Result<Outcome, Failure> {
    if args.residual.is_some() || args.acceleration.is_some() {
        return Err(Failure("--residual and --acceleration belong to a cam, not to a shaft".into()));
    }
    let file = if args.common.machine == "dpi" { MACHINE } else { &args.common.machine };
    let (machine, name) = ShaftMachine::load(file, &args.common.set).map_err(Failure::new)?;
    // The paper's own model, so that only its stations are measured.
    let own = machine.shaft();
    let shaft = Shaft::new(own.segments().to_vec(), own.supports().to_vec(), own.discs().to_vec(), Beam::Euler)
        .map_err(Failure::new)?;
    let stem = args.name.clone().unwrap_or_else(|| format!("{name}-trade-shaft"));
    let output = |ending: &str, bytes: Vec<u8>| Output { name: format!("{stem}.{ending}"), bytes };
    if !args.overwrite && !args.common.told.dry_run {
        refuse_kept(&args.out, &["csv", "svg"].map(|ending| output(ending, Vec::new()))).map_err(Failure::new)?;
    }
    let (truth, rows) = measured(&shaft)?;
    let title = format!("{}: time against the error of the first critical speed", machine.name());
    let picture = svg::write(&picture(&rows, &title), svg::TEMPLATE).map_err(Failure::new)?;
    let outputs = vec![output("csv", table(&rows).into_bytes()), output("svg", picture)];
    let mut inputs = machine.inputs().to_vec();
    inputs.push(Input::word("command", "trade shaft"));
    let files = named(args, &outputs);
    let advice = advice(&rows);
    let report =
        Report { schema: 1, command: "trade", machine: machine.name(), n1_rpm: truth, rows: &rows, advice, files };
    let show = || {
        if args.common.told.json {
            let bytes = json::write(&report).map_err(Failure::new)?;
            print(&String::from_utf8_lossy(&bytes))
        } else if args.common.told.quiet {
            Ok(())
        } else {
            print(&words(&report))
        }
    };
    written(args, outputs, &Run { stem: &stem, inputs: &inputs, overwrite: args.overwrite }, show)?;
    Ok(Outcome::Fine)
}

/// The first critical speed to rounding, rpm, and every setting.
fn measured(shaft: &Shaft) -> Result<(f64, Vec<Row>), Failure> {
    let paper = shaft.supports().len() == 2;
    let settings: Vec<Setting> = STATIONS
        .iter()
        .filter(|_| paper)
        .map(|stations| Setting::Paper(*stations))
        .chain(ORDERS.iter().map(|order| Setting::Exact(Some(*order))))
        .chain([Setting::Exact(None)])
        .collect();
    let truth = Setting::Exact(Some(MOST_ORDER)).solve(shaft)?;
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); settings.len()];
    let mut speeds = vec![f64::NAN; settings.len()];
    for _ in 0..ROUNDS {
        for ((setting, times), speed) in settings.iter().zip(&mut times).zip(&mut speeds) {
            let (time, found) = timed(|| setting.solve(shaft))?;
            times.push(time);
            *speed = found;
        }
    }
    let row = |((setting, times), speed): ((&Setting, &Vec<f64>), &f64)| Row {
        setting: setting.name(),
        n1_rpm: 30.0 / PI * speed,
        error: (speed / truth - 1.0).abs(),
        time_us: quantile(times.iter().copied(), 0.5),
    };
    Ok((30.0 / PI * truth, settings.iter().zip(&times).zip(&speeds).map(row).collect()))
}

fn advice(rows: &[Row]) -> String {
    let of = |limit: f64| {
        let keep = rows.iter().filter(|row| row.error <= limit);
        keep.min_by(|a, b| a.time_us.total_cmp(&b.time_us))
    };
    let words = |row: &Row| format!("{} is off by {:.1e} in {:.0} µs", row.setting, row.error, row.time_us);
    match (of(SHARE), of(1e-9)) {
        (Some(rough), Some(fine)) => {
            format!("cheapest within {} %: {}; to nine digits: {}", shown(100.0 * SHARE), words(rough), words(fine))
        }
        (Some(rough), None) => format!("cheapest within {} %: {}", shown(100.0 * SHARE), words(rough)),
        _ => format!("no setting is within {} %", shown(100.0 * SHARE)),
    }
}

fn table(rows: &[Row]) -> String {
    let mut text = "setting,n1_rpm,error,time_us\n".to_owned();
    for row in rows {
        text.push_str(&format!("\"{}\",{},{:e},{:.2}\n", row.setting, row.n1_rpm, row.error, row.time_us));
    }
    text
}

fn words(report: &Report<'_>) -> String {
    let mut lines = vec![
        format!(
            "{} · first critical speed {:.6} rpm (Euler beam, planar); median of {ROUNDS} rounds",
            report.machine, report.n1_rpm
        ),
        format!("  {:<14} {:>16} {:>10} {:>10}", "setting", "n1/rpm", "error", "time/µs"),
    ];
    lines.extend(
        report.rows.iter().map(|row| {
            format!("  {:<14} {:>16.6} {:>10.1e} {:>10.1}", row.setting, row.n1_rpm, row.error, row.time_us)
        }),
    );
    lines.push(format!("  {}", report.advice));
    lines.extend(report.files.iter().map(|file| format!("    {file}")));
    lines.push(String::new());
    lines.join("\n")
}

/// Time against error; what is exact to rounding cannot be shown on its scale.
fn picture(rows: &[Row], title: &str) -> camgen::report::sheet::Sheet {
    let point = |row: &Row| Point { x: row.time_us, y: row.error, label: row.setting.clone(), best: false };
    let mut points: Vec<Point> = rows.iter().map(point).collect();
    chart::mark_front(&mut points);
    chart::chart(title, "time, µs", &[Panel { y_name: "error of the first critical speed", points }])
}

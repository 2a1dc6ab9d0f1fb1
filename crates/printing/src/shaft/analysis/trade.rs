//! Speed against accuracy of the first critical speed: stations of the paper's method, and orders of the exact one.

use super::load::{CamOnShaft, CamUnderLoad};
use crate::shaft::machine::ShaftMachine;
use crate::shaft::mechanics::exact::Statics;
use crate::shaft::mechanics::{Beam, MOST_ORDER, Shaft, Whirl, exact, paper};
use camgen_cams::analysis::{Analysis, Picture};
use camgen_cams::body::Kind;
use camgen_cams::report::ReportLine;
use camgen_cams::report::chart::{self, Chart, ChartPanel, ChartPoint};
use camgen_cams::report::{Section, Speeds, shown};
use camgen_cams::table::Table;
use camgen_cams::trade::COMMAND;
use camgen_cams::trade::LeftOver;
use camgen_cams::trade::measure::{TradeClock, timed};
use camgen_kernel::document::Input;
use camgen_kernel::refusal::Refusal;
use serde::Serialize;
use std::f64::consts::PI;
use std::time::Duration;

/// The first critical speed.
pub const KIND: Kind =
    Kind { command: COMMAND, noun: "time and accuracy of the first critical speed", keys: super::KIND.keys };

/// Stations and orders that are tried.
const STATIONS: [usize; 6] = [9, 18, 36, 180, 1800, 18_000];
const ORDERS: [usize; 5] = [3, 4, 5, 8, 10];
/// Rounds over all settings; the least time is reported.
const ROUNDS: usize = 5;
/// Largest error that the advice keeps by default, as a share.
const SHARE: f64 = 1e-3;
/// A setting, measured.
#[derive(Debug, Clone, Serialize)]
struct ShaftTradeRow {
    setting: String,
    /// The flags of `camgen shaft` that ask for it.
    flags: String,
    /// Stations, or the order of the exact method: what decides between settings.
    pieces: usize,
    n1_rpm: f64,
    /// Of the first critical speed, relative.
    error: f64,
    time_us: f64,
}

#[expect(clippy::cast_precision_loss, reason = "stations")]
fn pieces(row: &ShaftTradeRow) -> f64 {
    row.pieces as f64
}

/// How one setting finds the first critical speed, rad/s.
#[derive(Debug, Clone, Copy)]
enum ShaftTradeSetting {
    Paper(usize),
    Exact(Option<usize>),
}

impl ShaftTradeSetting {
    fn name(&self) -> String {
        match self {
            Self::Paper(stations) => format!("paper {stations}"),
            Self::Exact(Some(order)) => format!("exact {order}"),
            Self::Exact(None) => "exact auto".into(),
        }
    }

    fn flags(&self) -> String {
        match self {
            Self::Paper(stations) => format!("--solver paper --stations {stations}"),
            Self::Exact(Some(order)) => format!("--order {order}"),
            Self::Exact(None) => "--order auto".into(),
        }
    }

    /// Stations, or the order; the order that is found is at most the largest.
    fn pieces(&self) -> usize {
        match self {
            Self::Paper(stations) => *stations,
            Self::Exact(order) => order.unwrap_or(MOST_ORDER),
        }
    }

    fn solve(&self, shaft: &Shaft) -> Result<f64, Refusal> {
        match self {
            Self::Paper(stations) => Ok(paper::first_critical(shaft, *stations).map_err(Refusal::of)?.speed),
            Self::Exact(order) => {
                let modes = exact::modes(shaft, Whirl::Planar, 1, *order).map_err(Refusal::of)?;
                Ok(modes.modes.first().map_or(f64::NAN, |mode| mode.speed))
            }
        }
    }
}

/// What the deflection of its shaft leaves of the balance of a press at a speed of its main shaft (rpm); `None` without a press, or where the cam is
/// cut for its shaft.
#[must_use]
pub fn left_by_shaft(machine: &ShaftMachine, rpm: f64) -> Option<LeftOver> {
    let carried = CamOnShaft::solve(machine, &[rpm]).ok()??;
    let statics = Statics::new(machine.shaft(), machine.data.cam_at?).ok()?;
    let residual = CamUnderLoad::new(&carried, &statics, &machine.data)?.residual?;
    let about = "the deflection of the camshaft (`camgen shaft`); shaft.compensate = true cuts the cam for it";
    Some(LeftOver::of_force("shaft", residual.value, about))
}

/// Every setting for the shaft of a machine, by a clock that gives the time since any fixed moment.
///
/// # Errors
/// [`Refusal`] when the shaft has no critical speed.
pub fn analysis(machine: &ShaftMachine, clock: &dyn Fn() -> Duration) -> Result<Analysis, Refusal> {
    // The model of the paper, so that only the effect of its stations is measured.
    let (own, carried) = (machine.shaft(), CamOnShaft::solve(machine, &[])?);
    let discs = carried.map_or_else(|| own.discs().to_vec(), |carried| super::discs(machine, &carried));
    let shaft =
        Shaft::new(own.segments().to_vec(), own.supports().to_vec(), discs, Beam::Euler).map_err(Refusal::of)?;
    let (truth, rows) = measure(&shaft, clock)?;
    let subtitle = format!("{}: time against the error of the first critical speed", machine.name());
    let mut inputs = machine.inputs().to_vec();
    inputs.push(Input::word("command", "trade shaft"));
    let advice = advice(&rows);
    let names = rows.iter().map(|row| row.setting.clone()).collect();
    let columns: [camgen_cams::table::ListedColumn<ShaftTradeRow>; 4] =
        [("pieces", pieces), ("n1_rpm", |row| row.n1_rpm), ("error", |row| row.error), ("time_us", |row| row.time_us)];
    Ok(Analysis {
        kind: &KIND,
        variant: "",
        machine: machine.name().to_owned(),
        speeds: Speeds::Any(()),
        inputs,
        sections: vec![
            Section::new("n1_rpm", &truth),
            Section::new("rows", &rows).with_words(describe(truth, &rows, &advice)),
            Section::new("advice", &advice),
        ],
        measures: Vec::new(),
        notes: Vec::new(),
        tables: vec![("", Table { words: Some(("setting", names)), ..Table::listed(&columns, &rows) })],
        by: &[],
        along: "time_us",
        picture: Picture::Chart(chart_of(&rows, advice.clone(), subtitle)),
        mechanism: None,
        document: None,
        diagrams: &[],
        not_modelled: Vec::new(),
    })
}

/// The first critical speed to rounding, rpm, and every setting.
fn measure(shaft: &Shaft, clock: TradeClock<'_>) -> Result<(f64, Vec<ShaftTradeRow>), Refusal> {
    let paper = shaft.supports().len() == 2;
    let settings: Vec<ShaftTradeSetting> = STATIONS
        .iter()
        .filter(|_| paper)
        .map(|stations| ShaftTradeSetting::Paper(*stations))
        .chain(ORDERS.iter().map(|order| ShaftTradeSetting::Exact(Some(*order))))
        .chain([ShaftTradeSetting::Exact(None)])
        .collect();
    let truth = ShaftTradeSetting::Exact(Some(MOST_ORDER)).solve(shaft)?;
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); settings.len()];
    let mut speeds = vec![f64::NAN; settings.len()];
    for _ in 0..ROUNDS {
        for ((setting, times), speed) in settings.iter().zip(&mut times).zip(&mut speeds) {
            let (time, found) = timed(clock, || setting.solve(shaft))?;
            times.push(time);
            *speed = found;
        }
    }
    let mut rows = Vec::with_capacity(settings.len());
    for ((setting, times), speed) in settings.iter().zip(&times).zip(&speeds) {
        rows.push(ShaftTradeRow {
            setting: setting.name(),
            flags: setting.flags(),
            pieces: setting.pieces(),
            n1_rpm: 30.0 / PI * speed,
            error: (speed / truth - 1.0).abs(),
            time_us: times.iter().copied().fold(f64::INFINITY, f64::min),
        });
    }
    Ok((30.0 / PI * truth, rows))
}

fn cheapest_within(rows: &[ShaftTradeRow], limit: f64) -> Option<&ShaftTradeRow> {
    rows.iter().filter(|row| row.error <= limit).min_by_key(|row| row.pieces)
}

impl ShaftTradeRow {
    fn describe_error(&self) -> String {
        format!("{} is off by {} ({})", self.setting, shown(self.error), self.flags)
    }
}

fn advice(rows: &[ShaftTradeRow]) -> String {
    let percent = shown(100.0 * SHARE);
    let Some(rough) = cheapest_within(rows, SHARE) else { return format!("no setting is within {percent} %") };
    let advice = format!("cheapest within {percent} %: {}", rough.describe_error());
    match cheapest_within(rows, 1e-9) {
        Some(fine) => format!("{advice}; to nine digits: {}", fine.describe_error()),
        None => advice,
    }
}

fn describe(truth: f64, rows: &[ShaftTradeRow], advice: &str) -> Vec<ReportLine> {
    let first =
        format!("first critical speed {} rpm (Euler beam, planar); time the least of {ROUNDS} rounds", shown(truth));
    let head = ReportLine::row(format!("{:<14} {:>16} {:>10} {:>10}", "setting", "n1/rpm", "error", "time/µs"));
    let mut lines = vec![first.into(), head];
    for row in rows {
        let (speed, error) = (shown(row.n1_rpm), shown(row.error));
        lines.push(ReportLine::row(format!("{:<14} {:>16} {:>10} {:>10.1}", row.setting, speed, error, row.time_us)));
    }
    lines.push(advice.to_owned().into());
    lines
}

/// Time against error; what is exact to rounding cannot be shown on its scale.
fn chart_of(rows: &[ShaftTradeRow], title: String, subtitle: String) -> Chart {
    let mut points: Vec<ChartPoint> = rows
        .iter()
        .map(|row| ChartPoint { x: row.time_us, y: row.error, label: row.setting.clone(), best: false })
        .collect();
    chart::mark_front(&mut points);
    let panels = vec![ChartPanel { y_name: "error of the first critical speed", points }];
    Chart { title, subtitle, x_name: "time, µs", panels }
}

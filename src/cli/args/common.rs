//! Flags of every command about a cam.

use super::super::Failure;
use super::super::input_files;
use super::super::text::Page;
use super::parse::{RateLimit, Speed, acceleration_error, accuracy, speed, tolerance, velocity_error, word};
use camgen::analysis::size::FreeDimension;
use camgen::body::{Accuracy, RateTolerance};
use camgen::catalogue::catalogue;
use camgen::domains::press::MachineOfPress;
use camgen::domains::press::bed_motion::End;
use camgen::machine::{Embedded, Machine};
use clap::{Args, ValueHint};
use std::io::IsTerminal;

/// How a report is printed.
#[derive(Debug, Args)]
pub(in crate::cli) struct ReportArgs {
    /// Print the report as JSON and nothing else
    #[arg(long)]
    pub(in crate::cli) json: bool,

    /// Print the whole report: every check, all digits, what is not modelled
    #[arg(long, short)]
    pub(in crate::cli) verbose: bool,

    /// Print no report
    #[arg(long, short)]
    pub(in crate::cli) quiet: bool,

    /// Solve, draw and check, print the report, and write no files
    #[arg(long)]
    pub(in crate::cli) dry_run: bool,

    /// Run again whenever the machine file changes, until Ctrl-C
    #[arg(long)]
    pub(in crate::cli) watch: bool,

    /// No colours on the terminal (also: the environment variable `NO_COLOR`)
    #[arg(long)]
    pub(in crate::cli) no_color: bool,
}

/// How close an outline is to its exact curve.
#[derive(Debug, Args)]
pub(in crate::cli) struct AccuracyArgs {
    /// Largest distance of the outline from the exact curve, along its normal [default: 5um]
    #[arg(long, value_name = "LENGTH", value_parser = tolerance, allow_hyphen_values = true, conflicts_with = "accuracy")]
    pub(in crate::cli) tolerance: Option<f64>,

    /// Named tolerances: draft (50 µm), standard (5 µm and 5 % of the acceleration) or fine (0.5 µm and 1 %); `camgen trade`
    /// measures what each costs
    #[arg(long, value_name = "NAME", ignore_case = true, value_parser = accuracy())]
    pub(in crate::cli) accuracy: Option<Accuracy>,

    /// Largest error of the follower's velocity as cut: a share of the motion's largest (2%), a quantity (mm/rad, mm/s, m/s,
    /// rad/rad, rad/s), or none [default: none]
    #[arg(long, value_name = "ERROR", value_parser = velocity_error, allow_hyphen_values = true)]
    pub(in crate::cli) tolerance_velocity: Option<RateLimit>,

    /// Largest error of the follower's acceleration as cut: a share of the motion's largest (5%), a quantity (mm/rad2, m/s2,
    /// rad/rad2, rad/s2), or none [default: 5%]
    #[arg(long, value_name = "ERROR", value_parser = acceleration_error, allow_hyphen_values = true)]
    pub(in crate::cli) tolerance_acceleration: Option<RateLimit>,
}

/// The machine of a press that is not named.
const PRESS: &str = "dpi";

/// Flags of every command about a cam.
#[derive(Debug, Args)]
pub(in crate::cli) struct CommonArgs {
    /// An embedded machine or the path of a machine file; `make` needs one with a motion [default: dpi; none for make]
    #[arg(value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: Option<String>,

    /// Main-shaft speed the cam is cut for (for `make` the speed of the cam), rpm [default: that of the machine file]
    #[arg(long, value_name = "N", value_delimiter = ',', value_parser = speed, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Vec<Speed>,

    #[command(flatten)]
    pub(in crate::cli) accuracy: AccuracyArgs,

    /// End of the bed's stroke that has the buffers; needs [linkage] in the machine file [default: outer]
    #[arg(long, value_name = "END", ignore_case = true, value_parser = word::<End>())]
    pub(in crate::cli) end: Option<End>,

    /// What is chosen with the base radius, for a motion program: offset or pivot_distance, in the place of what the file gives
    #[arg(long, value_name = "LIST", value_delimiter = ',', ignore_case = true, value_parser = word::<FreeDimension>())]
    pub(in crate::cli) free: Vec<FreeDimension>,

    /// Override one key of the machine file, e.g. --set follower.roller.diameter=50mm; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub(in crate::cli) set: Vec<String>,

    #[command(flatten)]
    pub(in crate::cli) report: ReportArgs,
}

/// The machine with its buffers at an end of the stroke, and the stem of its files, which names the inner end.
pub(in crate::cli) fn at_end(
    end: Option<End>,
    (machine, name): (Machine, String),
) -> Result<(Machine, String), Failure> {
    let Some(end) = end else { return Ok((machine, name)) };
    let name = if end == End::Inner { format!("{name}-inner") } else { name };
    Ok((machine.at_end(end).map_err(Failure::new)?, name))
}

/// The machine of a file with overrides. An embedded one of which nothing is cut is refused with the command for which it is.
pub(in crate::cli) fn machine_of_a_cam(name: &str, overrides: &[String]) -> Result<(Machine, String), Failure> {
    let embedded = catalogue().embedded.iter().find(|embedded| embedded.name == name);
    match embedded.filter(|embedded| !matches!(embedded.command, "make" | "rotary")) {
        Some(Embedded { command, .. }) => {
            Err(Failure(format!("`{name}` describes no cam; the command for it is `camgen {command} {name}`")))
        }
        None => input_files::machine(name, overrides),
    }
}

/// The machine of a file with overrides, and with what is left free to be chosen.
pub(in crate::cli) fn machine_with_free(
    name: &str,
    overrides: &[String],
    free: &[FreeDimension],
) -> Result<(Machine, String), Failure> {
    let loaded = machine_of_a_cam(name, overrides)?;
    if free.is_empty() {
        return Ok(loaded);
    }
    let table = loaded.0.follower_table();
    let place = free.iter().map(|free| match free {
        FreeDimension::Offset => format!("{table}.offset=auto"),
        FreeDimension::Pivot => format!("{table}.pivot_distance=auto"),
    });
    let all: Vec<String> = overrides.iter().cloned().chain(place).chain(["cam.base_radius=auto".to_owned()]).collect();
    input_files::machine(name, &all)
}

impl CommonArgs {
    /// The machine as it is named, or the default one.
    pub(in crate::cli) fn machine_name(&self) -> &str {
        self.machine.as_deref().unwrap_or(PRESS)
    }

    /// The machine of another file, with these overrides.
    pub(in crate::cli) fn machine_of(&self, name: &str) -> Result<(Machine, String), Failure> {
        self.machine_with(name, &self.set)
    }

    /// The machine of a file with these overrides, and what is left free.
    pub(in crate::cli) fn machine_with(&self, name: &str, overrides: &[String]) -> Result<(Machine, String), Failure> {
        at_end(self.end, machine_with_free(name, overrides, &self.free)?)
    }

    /// The one speed of a cam that is not a conoid.
    pub(in crate::cli) fn one_speed(&self, machine: &Machine) -> Result<f64, Failure> {
        match self.rpm.as_slice() {
            [] => Ok(machine.press().map_err(Failure::new)?.design_rpm),
            [Speed::One(rpm)] => Ok(*rpm),
            [Speed::Range(..)] => Err(Failure("this cam is cut for one speed, not for a range".into())),
            [Speed::One(whole), Speed::One(rest)] if rest.fract() == 0.0 && *rest < 10.0 => Err(Failure(format!(
                "this cam is cut for one speed, not for {whole} and {rest} rpm; of one speed write --rpm {whole}.{rest}, with a decimal point"
            ))),
            more => Err(Failure(format!("this cam is cut for one speed, not {}", more.len()))),
        }
    }
}

impl AccuracyArgs {
    /// Tolerance of the outline, m.
    pub(in crate::cli) fn tolerance(&self) -> f64 {
        self.tolerance.unwrap_or_else(|| self.accuracy.unwrap_or_default().tolerance())
    }

    /// Tolerances of velocity and acceleration, and whether a cam that exceeds each of them is refused: a default one is only
    /// reported.
    pub(in crate::cli) fn rates(&self) -> ([Option<RateTolerance>; 2], [bool; 2]) {
        let named = self.accuracy.unwrap_or_default().acceleration();
        let asked = [(self.tolerance_velocity, None), (self.tolerance_acceleration, named)];
        let rates = asked.map(|(rate, default)| match rate {
            Some(RateLimit::Any) => None,
            Some(RateLimit::Within(rate)) => Some(rate),
            None => default,
        });
        (rates, asked.map(|(rate, _)| rate.is_some()))
    }

    /// The tolerances for a file to check: only those that were given.
    pub(in crate::cli) fn demanded(&self) -> ([Option<RateTolerance>; 2], [bool; 2]) {
        let ([velocity, acceleration], strict) = self.rates();
        let asked = self.accuracy.is_some() || self.tolerance_acceleration.is_some();
        ([velocity, acceleration.filter(|_| asked)], strict)
    }
}

impl ReportArgs {
    /// How the report is laid out on standard output.
    pub(in crate::cli) fn page(&self) -> Page {
        let terminal = std::io::stdout().is_terminal();
        let colour = terminal && !self.no_color && std::env::var_os("NO_COLOR").is_none();
        let width = terminal.then(terminal_size::terminal_size).flatten().map(|(width, _)| usize::from(width.0));
        Page { colour, width }
    }

    /// Whether the summary is printed, and not the whole report, JSON or nothing.
    pub(in crate::cli) fn is_summary(&self) -> bool {
        !(self.json || self.quiet || self.verbose)
    }

    /// Whether progress is shown: a person waits at a terminal.
    pub(in crate::cli) fn shows_progress(&self) -> bool {
        !self.quiet && std::io::stderr().is_terminal()
    }
}

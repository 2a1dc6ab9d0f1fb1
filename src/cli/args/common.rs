//! Flags of every command about a cam.

use super::super::Failure;
use super::super::text::Page;
use super::parse::{Rate, Speed, acceleration_error, speed, tolerance, velocity_error};
use camgen::body::RateTolerance;
use camgen::linkage::End;
use camgen::machine::Machine;
use clap::{Args, ValueEnum, ValueHint};
use std::io::IsTerminal;

/// Named tolerances of those that `trade` measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Accuracy {
    /// 50 µm: for a first look.
    Draft,
    /// 5 µm and 5 % of the acceleration: for milling.
    Standard,
    /// 0.5 µm and 1 % of the acceleration: for grinding.
    Fine,
}

/// How a report is told.
#[derive(Debug, Args)]
pub(in crate::cli) struct ToldArgs {
    /// Print the report as JSON and nothing else
    #[arg(long)]
    pub(in crate::cli) json: bool,

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

/// How near an outline keeps to its exact curve.
#[derive(Debug, Args)]
pub(in crate::cli) struct AccuracyArgs {
    /// Largest distance of the outline from the exact curve, along its normal [default: 5um]
    #[arg(long, value_name = "LENGTH", value_parser = tolerance, allow_hyphen_values = true, conflicts_with = "accuracy")]
    pub(in crate::cli) tolerance: Option<f64>,

    /// Named tolerances: draft (50 µm), standard (5 µm and 5 % of the acceleration) or fine (0.5 µm and 1 %); `camgen trade`
    /// measures what each costs
    #[arg(long, value_name = "NAME", ignore_case = true)]
    pub(in crate::cli) accuracy: Option<Accuracy>,

    /// Largest error of the follower's velocity as cut: a share of the motion's largest (2%), a quantity (mm/rad, mm/s, m/s,
    /// rad/rad, rad/s), or none [default: none]
    #[arg(long, value_name = "ERROR", value_parser = velocity_error, allow_hyphen_values = true)]
    pub(in crate::cli) tolerance_velocity: Option<Rate>,

    /// Largest error of the follower's acceleration as cut: a share of the motion's largest (5%), a quantity (mm/rad2, m/s2,
    /// rad/rad2, rad/s2), or none [default: 5%]
    #[arg(long, value_name = "ERROR", value_parser = acceleration_error, allow_hyphen_values = true)]
    pub(in crate::cli) tolerance_acceleration: Option<Rate>,
}

/// Flags of every command about a cam.
#[derive(Debug, Args)]
pub(in crate::cli) struct CommonArgs {
    /// An embedded machine or the path of a machine file; `make` needs a file with a motion
    #[arg(default_value = "dpi", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Main-shaft speed the cam is cut for (for `make` the speed of the cam), rpm [default: that of the machine file]
    #[arg(long, value_name = "N", value_delimiter = ',', value_parser = speed, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Vec<Speed>,

    #[command(flatten)]
    pub(in crate::cli) accuracy: AccuracyArgs,

    /// End of the bed's stroke at which the buffers stand; only with [linkage] in the machine file [default: outer]
    #[arg(long, value_name = "END", ignore_case = true)]
    pub(in crate::cli) end: Option<EndOf>,

    /// Overrides one key of the machine file, e.g. --set follower.roller.radius=25mm; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub(in crate::cli) set: Vec<String>,

    #[command(flatten)]
    pub(in crate::cli) told: ToldArgs,
}

/// An end of the stroke of the bed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum EndOf {
    /// Where the bed is farthest from the shaft of the crank.
    Outer,
    /// Where it is nearest.
    Inner,
}

impl EndOf {
    /// The machine with its buffers there, and the word that names its files: the inner end has a name of its own.
    pub(in crate::cli) fn of(
        end: Option<Self>,
        (machine, name): (Machine, String),
    ) -> Result<(Machine, String), Failure> {
        match end {
            None => Ok((machine, name)),
            Some(Self::Outer) => Ok((machine.at_end(End::Outer).map_err(Failure::new)?, name)),
            Some(Self::Inner) => Ok((machine.at_end(End::Inner).map_err(Failure::new)?, format!("{name}-inner"))),
        }
    }
}

impl CommonArgs {
    /// The machine with its overrides, and the word that names its files.
    pub(in crate::cli) fn machine(&self) -> Result<(Machine, String), Failure> {
        self.machine_of(&self.machine)
    }

    /// The same of another file than that given as the machine.
    pub(in crate::cli) fn machine_of(&self, name: &str) -> Result<(Machine, String), Failure> {
        EndOf::of(self.end, Machine::load(name, &self.set).map_err(Failure::new)?)
    }

    /// The one speed of a cam that is not a conoid.
    pub(in crate::cli) fn one_speed(&self, machine: &Machine) -> Result<f64, Failure> {
        match self.rpm.as_slice() {
            [] => Ok(machine.press().map_err(Failure::new)?.design_rpm),
            [Speed::One(rpm)] => Ok(*rpm),
            [Speed::Range(..)] => Err(Failure("this cam is cut for one speed, not for a range".into())),
            more => Err(Failure(format!("this cam is cut for one speed, not {}", more.len()))),
        }
    }
}

impl AccuracyArgs {
    /// Tolerance of the outline, m.
    pub(in crate::cli) fn tolerance(&self) -> f64 {
        match (self.tolerance, self.accuracy) {
            (Some(tolerance), _) => tolerance,
            (None, Some(Accuracy::Draft)) => 50e-6,
            (None, None | Some(Accuracy::Standard)) => 5e-6,
            (None, Some(Accuracy::Fine)) => 0.5e-6,
        }
    }

    /// Tolerances of velocity and acceleration, and whether a cam that does not keep each of them is refused: a default one is told
    /// only.
    pub(in crate::cli) fn rates(&self) -> ([Option<RateTolerance>; 2], [bool; 2]) {
        let named = match self.accuracy {
            Some(Accuracy::Draft) => None,
            None | Some(Accuracy::Standard) => Some(RateTolerance::Share(0.05)),
            Some(Accuracy::Fine) => Some(RateTolerance::Share(0.01)),
        };
        let asked = |rate: Option<Rate>, default| match rate {
            Some(Rate::Any) => None,
            Some(Rate::Within(rate)) => Some(rate),
            None => default,
        };
        let strict = [self.tolerance_velocity.is_some(), self.tolerance_acceleration.is_some()];
        ([asked(self.tolerance_velocity, None), asked(self.tolerance_acceleration, named)], strict)
    }

    /// The same of a file that somebody wrote: what was not asked for is not held against it.
    pub(in crate::cli) fn demanded(&self) -> ([Option<RateTolerance>; 2], [bool; 2]) {
        let ([velocity, acceleration], strict) = self.rates();
        let asked = self.accuracy.is_some() || self.tolerance_acceleration.is_some();
        ([velocity, acceleration.filter(|_| asked)], strict)
    }
}

impl ToldArgs {
    /// How the report is laid out on standard output.
    pub(in crate::cli) fn page(&self) -> Page {
        let terminal = std::io::stdout().is_terminal();
        let colour = terminal && !self.no_color && std::env::var_os("NO_COLOR").is_none();
        let width = terminal.then(terminal_size::terminal_size).flatten().map(|(width, _)| usize::from(width.0));
        Page { colour, width }
    }

    /// Whether a person is waiting at a terminal, who is shown how far the work is.
    pub(in crate::cli) fn shows_progress(&self) -> bool {
        !self.quiet && std::io::stderr().is_terminal()
    }
}

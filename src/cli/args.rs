//! What the user typed.

use super::Failure;
use camgen::body::RateTolerance;
use camgen::machine::{Machine, valid_rpm};
use camgen::motion::equation_18::ExactOn;
use camgen::units::{self, Dimension};
use camgen::write::by_name;
use camgen::write::dxf::Version;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::io::IsTerminal;
use std::path::PathBuf;

/// Cam profiles a CNC shop can cut.
///
/// Solves the motion a cam must give, offsets it for the roller, checks the geometry and writes DXF, SVG, STEP and CSV.
/// Exit code: 0 fine, 1 a check failed (nothing is written without --force), 2 bad input.
#[derive(Debug, Parser)]
#[command(name = "camgen", version, max_term_width = 110)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Disc cam for one speed: moves the bottom of the air buffers so that the air force equals the inertia force
    Rotary(RotaryArgs),
    /// Wedge cam: a plate that rides on the bed and moves the bottom through a bell crank, by equation (18)
    Translating(TranslatingArgs),
    /// Three-dimensional cam for many speeds, shifted along its axis as the speed changes: sections and a solid
    Conoid(ConoidArgs),
    /// Disc cam of any motion: a program of segments and a follower, both from a file
    Make(MakeArgs),
    /// Speed against accuracy, measured on this computer: time by stage, arcs, bytes, true error and residual force
    Trade(TradeArgs),
    /// Check a DXF file, also one edited or written by another program: is it one closed outline that gives the motion?
    Check(CheckArgs),
    /// The machine files embedded in the program
    Machines(MachinesArgs),
    /// Print a commented machine file to start from
    Init,
    /// Print what a check means; without a name, all of them
    Explain(ExplainArgs),
    /// Print the JSON schema of machine files, for editors
    Schema,
}

#[derive(Debug, Args)]
pub(super) struct ExplainArgs {
    /// Name of the check, as in reports
    pub(super) check: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct MakeArgs {
    #[command(flatten)]
    pub(super) common: CommonArgs,

    #[command(flatten)]
    pub(super) files: FileArgs,

    #[command(flatten)]
    pub(super) cutter: CutterArgs,
}

/// The cutter of a disc cam.
#[derive(Debug, Args)]
pub(super) struct CutterArgs {
    /// Also writes the path of the centre of a cutter of this radius, as STEM-cutter.dxf
    #[arg(long, value_name = "RADIUS", value_parser = cutter)]
    pub(super) cutter: Option<f64>,
}

/// Flags of every command about a cam.
#[derive(Debug, Args)]
pub(super) struct CommonArgs {
    /// An embedded machine or the path of a machine file; `make` needs a file with a motion
    #[arg(default_value = "dpi")]
    pub(super) machine: String,

    /// Main-shaft speed the cam is cut for (for `make` the speed of the cam), rpm [default: that of the machine file]
    #[arg(long, value_name = "N", value_delimiter = ',', value_parser = speed, allow_hyphen_values = true)]
    pub(super) rpm: Vec<Speed>,

    /// Largest distance of the outline from the exact curve, along its normal [default: 5um]
    #[arg(long, value_name = "LENGTH", value_parser = tolerance, allow_hyphen_values = true, conflicts_with = "accuracy")]
    pub(super) tolerance: Option<f64>,

    /// Named tolerances: draft (50 µm), standard (5 µm and 5 % of the acceleration) or fine (0.5 µm and 1 %); `camgen trade`
    /// measures what each costs
    #[arg(long, value_name = "NAME")]
    pub(super) accuracy: Option<Accuracy>,

    /// Largest error of the follower's velocity as cut: a share of the motion's largest (2%), a quantity (mm/rad, mm/s, m/s,
    /// rad/rad, rad/s), or none [default: none]
    #[arg(long, value_name = "ERROR", value_parser = velocity_error, allow_hyphen_values = true)]
    pub(super) tolerance_velocity: Option<Rate>,

    /// Largest error of the follower's acceleration as cut: a share of the motion's largest (5%), a quantity (mm/rad2, m/s2,
    /// rad/rad2, rad/s2), or none [default: 5%]
    #[arg(long, value_name = "ERROR", value_parser = acceleration_error, allow_hyphen_values = true)]
    pub(super) tolerance_acceleration: Option<Rate>,

    /// Overrides one key of the machine file, e.g. --set follower.roller.radius=25mm; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub(super) set: Vec<String>,

    /// Print the report as JSON and nothing else
    #[arg(long)]
    pub(super) json: bool,

    /// Print no report
    #[arg(long, short)]
    pub(super) quiet: bool,

    /// No colours on the terminal (also: the environment variable `NO_COLOR`)
    #[arg(long)]
    pub(super) no_color: bool,
}

impl CommonArgs {
    /// The machine with its overrides, and the word that names its files.
    pub(super) fn machine(&self) -> Result<(Machine, String), Failure> {
        Machine::load(&self.machine, &self.set).map_err(Failure::new)
    }

    /// The one speed of a cam that is not a conoid.
    pub(super) fn one_speed(&self, machine: &Machine) -> Result<f64, Failure> {
        match self.rpm.as_slice() {
            [] => Ok(machine.press().map_err(Failure::new)?.design_rpm),
            [Speed::One(rpm)] => Ok(*rpm),
            [Speed::Range(..)] => Err(Failure("this cam is cut for one speed, not for a range".into())),
            more => Err(Failure(format!("this cam is cut for one speed, not {}", more.len()))),
        }
    }

    /// Tolerance of the outline, m.
    pub(super) fn tolerance(&self) -> f64 {
        match (self.tolerance, self.accuracy) {
            (Some(tolerance), _) => tolerance,
            (None, Some(Accuracy::Draft)) => 50e-6,
            (None, None | Some(Accuracy::Standard)) => 5e-6,
            (None, Some(Accuracy::Fine)) => 0.5e-6,
        }
    }

    /// Tolerances of velocity and acceleration, and whether a cam that does not keep each of them is refused: a default one is told
    /// only.
    pub(super) fn rates(&self) -> ([Option<RateTolerance>; 2], [bool; 2]) {
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

    /// Whether the report may be coloured.
    pub(super) fn colour(&self) -> bool {
        !self.no_color && std::env::var_os("NO_COLOR").is_none() && std::io::stdout().is_terminal()
    }
}

#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    /// The DXF file
    pub(super) file: PathBuf,

    /// Kind of cam the file should hold, by the command that makes it [default: rotary; make for a motion program]
    #[arg(long, value_name = "KIND")]
    pub(super) cam: Option<Checked>,

    /// Direction of the bed in which the forces of a plate balance
    #[arg(long, value_name = "WAY", default_value = "braking")]
    pub(super) balance: Balanced,

    /// Speed of the section of a conoid that a DXF file should hold, one of those of --rpm
    #[arg(long, value_name = "RPM", value_parser = rpm, allow_hyphen_values = true)]
    pub(super) section: Option<f64>,

    /// Residual force by which the sections of a conoid were chosen, as given to conoid --rpm A..B
    #[arg(long, value_name = "FORCE", value_parser = force)]
    pub(super) residual: Option<f64>,

    #[command(flatten)]
    pub(super) common: CommonArgs,
}

/// A kind of cam that `check` knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Checked {
    Rotary,
    Translating,
    Conoid,
    Make,
}

/// A kind of cam that `trade` knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum CamKind {
    Rotary,
    Translating,
}

#[derive(Debug, Args)]
pub(super) struct RotaryArgs {
    #[command(flatten)]
    pub(super) common: CommonArgs,

    #[command(flatten)]
    pub(super) files: FileArgs,

    #[command(flatten)]
    pub(super) cutter: CutterArgs,
}

#[derive(Debug, Args)]
pub(super) struct TranslatingArgs {
    #[command(flatten)]
    pub(super) common: CommonArgs,

    #[command(flatten)]
    pub(super) files: FileArgs,

    /// How equation (18) is solved: ode (a differential equation, to a thousandth of a nanometre) or paper (station by station with
    /// the backward difference (25))
    #[arg(long, value_name = "SOLVER", default_value = "ode")]
    pub(super) solver: SolverKind,

    /// Stations of the paper's solver over the stroke; its error is about 18 mm over their number [default: 1800]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub(super) stations: Option<u32>,

    /// Direction of the bed in which the forces balance, or mean: equal residual forces in both
    #[arg(long, value_name = "WAY", default_value = "braking")]
    pub(super) balance: Balanced,
}

#[derive(Debug, Args)]
pub(super) struct TradeArgs {
    /// Kind of cam: rotary or translating
    #[arg(default_value = "rotary", value_name = "KIND")]
    pub(super) kind: CamKind,

    #[command(flatten)]
    pub(super) common: CommonArgs,

    /// Largest residual force: the advice is the cheapest setting that keeps it [default: 0.01 % of the largest inertia]
    #[arg(long, value_name = "FORCE", value_parser = force)]
    pub(super) residual: Option<f64>,

    /// Largest error of the acceleration that the advice keeps, as a share of the motion's largest, e.g. 2%
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    pub(super) acceleration: Option<f64>,

    /// Directory for the table and the picture, created when missing
    #[arg(long, value_name = "DIR", default_value = "output")]
    pub(super) out: PathBuf,

    /// File stem [default: MACHINE-trade-KIND-RPMrpm]
    #[arg(long, value_name = "STEM", value_parser = stem)]
    pub(super) name: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct ConoidArgs {
    #[command(flatten)]
    pub(super) common: CommonArgs,

    #[command(flatten)]
    pub(super) files: FileArgs,

    /// Largest residual force at the speeds between the sections; --rpm A..B takes the fewest sections that keep it
    #[arg(long, value_name = "FORCE", value_parser = force)]
    pub(super) residual: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum SideOf {
    Both,
    Inside,
    Outside,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum LaidOf {
    Arcs,
    Spline,
}

/// Named tolerances of those that `trade` measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Accuracy {
    /// 50 µm: for a first look.
    Draft,
    /// 5 µm and 5 % of the acceleration: for milling.
    Standard,
    /// 0.5 µm and 1 % of the acceleration: for grinding.
    Fine,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum SolverKind {
    Ode,
    Paper,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Balanced {
    Braking,
    Return,
    Mean,
}

impl Balanced {
    pub(super) fn exact_on(self) -> ExactOn {
        match self {
            Balanced::Braking => ExactOn::Braking,
            Balanced::Return => ExactOn::Return,
            Balanced::Mean => ExactOn::Mean,
        }
    }
}

/// What is written, where, and how.
#[derive(Debug, Args)]
pub(super) struct FileArgs {
    /// What to write: dxf, svg, step, csv, json, points, and stl of a conoid [default: dxf,svg,step,csv]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = format)]
    pub(super) format: Option<Vec<String>>,

    /// Directory for the files, created when missing
    #[arg(long, value_name = "DIR", default_value = "output")]
    pub(super) out: PathBuf,

    /// File stem [default: MACHINE-COMMAND-RPMrpm]
    #[arg(long, value_name = "STEM", value_parser = stem)]
    pub(super) name: Option<String>,

    /// Version of the DXF file: r12, r2000, r2010 or r2013
    #[arg(long, value_name = "VERSION", default_value = "r2000", value_parser = dxf_version)]
    pub(super) dxf_version: Version,

    /// Rows of the CSV table over one turn of the cam, or steps of x over the stroke of a plate
    #[arg(long, value_name = "N", default_value = "720", value_parser = clap::value_parser!(u32).range(1..=10_000_000))]
    pub(super) samples: u32,

    /// Template of the SVG review sheet instead of the built-in one, templates/sheet.svg
    #[arg(long, value_name = "FILE")]
    pub(super) template: Option<PathBuf>,

    /// Side of the exact curve the outline keeps to: both, inside (never metal in the way) or outside (never cut too deep)
    #[arg(long, value_name = "SIDE", default_value = "both")]
    pub(super) side: SideOf,

    /// What the curved parts of the outline are: arcs, which every control reads, or spline: cubic SPLINEs without steps of curvature
    #[arg(long, value_name = "KIND", default_value = "arcs")]
    pub(super) outline: LaidOf,

    /// Write the files although a check failed (the exit code stays 1)
    #[arg(long)]
    pub(super) force: bool,

    #[command(flatten)]
    pub(super) points: PointsArgs,
}

/// The table of --format points, STEM-points.csv: as many points as it takes to keep --tolerance between them.
#[derive(Debug, Args)]
pub(super) struct PointsArgs {
    /// Curve of --format points: profile, centre (of the roller), or cutter (the centre of the cutter or wheel of --cutter)
    /// [default: profile]
    #[arg(long, value_name = "CURVE", help_heading = "Points")]
    pub(super) points_of: Option<PointsOf>,

    /// Its coordinates: polar (angle about the shaft, radius) or xy [default: polar; xy of a plate]
    #[arg(long, value_name = "FORM", help_heading = "Points")]
    pub(super) points_as: Option<PointsAs>,

    /// Its places: angle (equal angles about the shaft) or chord (the same error in every interval, fewer points) [default: angle;
    /// chord on a plate]
    #[arg(long, value_name = "STEP", help_heading = "Points")]
    pub(super) points_step: Option<PointsStep>,

    /// How the control interpolates between two points: linear (polar: the radius linear in the angle; xy: a straight line) or
    /// cubic (the cubic spline of the radius over the angle, or of x and y over the sum of the chords) [default: linear]
    #[arg(long, value_name = "WAY", help_heading = "Points")]
    pub(super) points_between: Option<PointsBetween>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum PointsOf {
    Profile,
    Centre,
    Cutter,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum PointsAs {
    Polar,
    Xy,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum PointsStep {
    Angle,
    Chord,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum PointsBetween {
    Linear,
    Cubic,
}

#[derive(Debug, Args)]
pub(super) struct MachinesArgs {
    #[command(subcommand)]
    pub(super) what: Option<MachinesCommand>,
}

#[derive(Debug, Subcommand)]
pub(super) enum MachinesCommand {
    /// List their names
    List,
    /// Print one of them, as a file to start from
    Show {
        /// Its name
        name: String,
    },
}

/// A tolerance of velocity or acceleration, or that there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Rate {
    Any,
    Within(RateTolerance),
}

/// A unit of velocity or acceleration: its name, whether it is of a swing, whether it is by the time, and its size in m or rad.
type RateUnit = (&'static str, bool, bool, f64);

const VELOCITIES: [RateUnit; 5] = [
    ("mm/rad", false, false, 1e-3),
    ("mm/s", false, true, 1e-3),
    ("m/s", false, true, 1.0),
    ("rad/rad", true, false, 1.0),
    ("rad/s", true, true, 1.0),
];
const ACCELERATIONS: [RateUnit; 5] = [
    ("mm/rad2", false, false, 1e-3),
    ("mm/s2", false, true, 1e-3),
    ("m/s2", false, true, 1.0),
    ("rad/rad2", true, false, 1.0),
    ("rad/s2", true, true, 1.0),
];

fn velocity_error(text: &str) -> Result<Rate, String> {
    rate(text, &VELOCITIES)
}

fn acceleration_error(text: &str) -> Result<Rate, String> {
    rate(text, &ACCELERATIONS)
}

fn share(text: &str) -> Result<f64, String> {
    match rate(text, &ACCELERATIONS)? {
        Rate::Within(RateTolerance::Share(share)) => Ok(share),
        _ => Err("must be a share, e.g. 2%".into()),
    }
}

fn rate(text: &str, units: &[RateUnit]) -> Result<Rate, String> {
    if text.trim() == "none" {
        return Ok(Rate::Any);
    }
    let text = text.trim().replace('²', "2").replace('^', "");
    // An e belongs to the number.
    let begins_unit = |c: char| c == '%' || c.is_alphabetic() && !matches!(c, 'e' | 'E');
    let end = text.find(begins_unit).unwrap_or(text.len());
    let (number, unit) = text.split_at(end);
    let known: Vec<&str> = units.iter().map(|(name, ..)| *name).collect();
    let known = known.join(", ");
    let value = units::parse_bare(number.trim()).map_err(|error| format!("{error}; e.g. 5%, none, or {known}"))?;
    if !(value > 0.0) {
        return Err("must be above 0".into());
    }
    let unit = unit.trim();
    if unit == "%" {
        return if value <= 100.0 {
            Ok(Rate::Within(RateTolerance::Share(value / 100.0)))
        } else {
            Err("must be at most 100%".into())
        };
    }
    match units.iter().find(|(name, ..)| *name == unit) {
        Some((_, swing, by_time, size)) => {
            Ok(Rate::Within(RateTolerance::Rate { value: value * size, swing: *swing, by_time: *by_time }))
        }
        None if unit.is_empty() => Err(format!("has no unit; it is a share (5%), none, or in one of {known}")),
        None => Err(format!("unknown unit `{unit}`; it is a share (5%), none, or in one of {known}")),
    }
}

/// A speed, or `A..B` from one to another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Speed {
    One(f64),
    Range(f64, f64),
}

fn speed(text: &str) -> Result<Speed, String> {
    match text.split_once("..") {
        None => rpm(text).map(Speed::One),
        Some((from, to)) => {
            let (from, to) = (rpm(from)?, rpm(to)?);
            if from < to {
                Ok(Speed::Range(from, to))
            } else {
                Err("a range goes from the slower to the faster speed".into())
            }
        }
    }
}

fn force(text: &str) -> Result<f64, String> {
    let quantity = units::parse(text, Dimension::Force)
        .map_err(|error| format!("{error}; a force has one of {}", Dimension::Force.unit_list()))?;
    if quantity.si > 0.0 { Ok(quantity.si) } else { Err("must be above 0".into()) }
}

fn rpm(text: &str) -> Result<f64, String> {
    let number =
        units::parse_bare(text).map_err(|error| format!("{error}; a speed is a bare number, e.g. --rpm 35"))?;
    valid_rpm(number)
}

/// Coarsest tolerance, m: a cam that is off by more than a millimetre is of no use.
const COARSEST: f64 = 1e-3;

fn tolerance(text: &str) -> Result<f64, String> {
    let quantity = units::parse(text, Dimension::Length)
        .map_err(|error| format!("{error}; a tolerance is a length with one of {}", Dimension::Length.unit_list()))?;
    if quantity.si > 0.0 && quantity.si <= COARSEST {
        Ok(quantity.si)
    } else {
        Err(format!("must be above 0 and at most {}", quantity.in_same_unit(COARSEST)))
    }
}

fn cutter(text: &str) -> Result<f64, String> {
    let quantity = units::parse(text, Dimension::Length)
        .map_err(|error| format!("{error}; a radius is a length with one of {}", Dimension::Length.unit_list()))?;
    if quantity.si > 0.0 && quantity.si <= 1.0 {
        Ok(quantity.si)
    } else {
        Err(format!("must be above 0 and at most {}", quantity.in_same_unit(1.0)))
    }
}

fn format(text: &str) -> Result<String, String> {
    if let Some(format) = by_name().find(|format| format.name.eq_ignore_ascii_case(text)) {
        return Ok(format.name.to_owned());
    }
    let known: Vec<&str> = by_name().map(|format| format.name).collect();
    Err(format!("no such format; one of {}", known.join(", ")))
}

fn dxf_version(text: &str) -> Result<Version, String> {
    Version::ALL.iter().find(|(name, _)| name.eq_ignore_ascii_case(text)).map(|(_, version)| *version).ok_or_else(
        || {
            let known: Vec<&str> = Version::ALL.iter().map(|(name, _)| *name).collect();
            format!("no such version; one of {}", known.join(", "))
        },
    )
}

/// A stem names files in the output directory and must not lead out of it.
fn stem(text: &str) -> Result<String, String> {
    let bad = |c: char| c.is_control() || "/\\:*?\"<>|".contains(c);
    if text.is_empty() || text.starts_with('.') || text.contains(bad) {
        return Err("a file stem has no path separators, no control characters and no leading dot; see --out".into());
    }
    Ok(text.to_owned())
}

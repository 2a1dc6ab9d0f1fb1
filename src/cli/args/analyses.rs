//! Flags of the commands that analyse a machine and cut nothing.

use super::common::{AccuracyArgs, EndOf, ToldArgs};
use super::files::{LaidArgs, OutArgs};
use super::parse::{
    Order, crank_step, force, format, lift, order, power_share, rpm, segment_angle, stiffness, stiffnesses,
};
use camgen::document::LengthOrAngle;
use clap::{Args, ValueEnum, ValueHint};

/// Flags of every analysis.
#[derive(Debug, Args)]
pub(in crate::cli) struct AnalysisArgs {
    /// Overrides one key of the machine file, e.g. --set buffer.lead=10mm; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub(in crate::cli) set: Vec<String>,

    /// What to write: csv, svg, json, html (the report with its curves), pdf and, of a linkage or a brake, toml (its table of a machine
    /// file) [default: csv,svg]; with a cam also what that can have
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = format)]
    pub(in crate::cli) format: Option<Vec<String>>,

    #[command(flatten)]
    pub(in crate::cli) to: OutArgs,

    #[command(flatten)]
    pub(in crate::cli) told: ToldArgs,
}

/// What the reset of a column keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum ResetOf {
    End,
    Half,
    Level,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct RegimesArgs {
    /// An embedded machine or the path of a machine file
    #[arg(default_value = "dpi", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Speeds of the main shaft, rpm [default: those of the file, else 4, 5, 6 and 7 sevenths of the design speed]
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Vec<f64>,

    /// Speed the cam is cut for, rpm [default: the design speed]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) cut_for: Option<f64>,

    /// What the reset keeps: end (no residual force at the end of the stroke), half (the paper's rule: half of the largest one there)
    /// or level (as much there as at the worst place, which is least)
    /// [default: that of the file, else end]
    #[arg(long, value_name = "RULE", ignore_case = true)]
    pub(in crate::cli) reset: Option<ResetOf>,

    /// End of the bed's stroke at which the buffers stand; only with [linkage] in the machine file [default: outer]
    #[arg(long, value_name = "END", ignore_case = true)]
    pub(in crate::cli) end: Option<EndOf>,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct SpringArgs {
    /// An embedded machine or the path of a machine file
    #[arg(default_value = "dpi", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Stiffness of each of the two springs, e.g. 68kgf/cm,165kgf/cm [default: that of the file, else 1.125, 1.375 and
    /// 2.75 times the least one]
    #[arg(long, value_name = "STIFFNESS,…", value_delimiter = ',', value_parser = stiffness, allow_hyphen_values = true)]
    pub(in crate::cli) stiffness: Vec<f64>,

    /// Largest residual force at the design speed: also takes the stiffness that leaves it, e.g. 50kgf
    #[arg(long, value_name = "FORCE", value_parser = force, allow_hyphen_values = true)]
    pub(in crate::cli) residual: Option<f64>,

    /// Speeds of the main shaft, rpm [default: the design speed]
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Vec<f64>,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

/// How the law of a drive is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum DriveSolver {
    Energy,
    Paper,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct DriveArgs {
    /// An embedded machine or the path of a machine file with the table [drive]
    #[arg(default_value = "dp", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// energy (in closed form) or paper (the paper's sections, of second order in the step)
    #[arg(long, value_name = "SOLVER", default_value = "energy", ignore_case = true)]
    pub(in crate::cli) solver: DriveSolver,

    /// Crank angle from row to row, and of the paper's sections, 0.01deg to 90deg
    #[arg(long, value_name = "ANGLE", default_value = "10deg", value_parser = crank_step, allow_hyphen_values = true)]
    pub(in crate::cli) step: f64,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

/// What a drag link is designed for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum GoalOf {
    Equal,
    Symmetric,
    Least,
}

/// What a design keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum KeepOf {
    Symmetric,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct LinkageArgs {
    /// An embedded machine or the path of a machine file with the table [linkage]
    #[arg(default_value = "dpi-six-bar", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Speed of the main shaft, rpm [default: the design speed]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Option<f64>,

    /// Designs the drag link for the slider of the file: equal (largest accelerations equal at both ends), symmetric (also as long out as
    /// back) or least (the least largest acceleration within [limits]), and prints it as a table to paste
    #[arg(long, value_name = "GOAL", ignore_case = true)]
    pub(in crate::cli) synthesize: Option<GoalOf>,

    /// With --synthesize least: as long out as back
    #[arg(long, value_name = "WHAT", ignore_case = true)]
    pub(in crate::cli) keep: Option<KeepOf>,

    /// With --synthesize least: largest peak of power over that of the crank-slider alone, e.g. 0.831
    #[arg(long, value_name = "SHARE", value_parser = power_share, allow_hyphen_values = true)]
    pub(in crate::cli) power_limit: Option<f64>,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

/// How critical speeds are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum ShaftSolver {
    Exact,
    Paper,
}

/// How a shaft whirls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum WhirlOf {
    Forward,
    Planar,
    Backward,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct ShaftArgs {
    /// An embedded machine or the path of a machine file with the table [shaft]
    #[arg(default_value = "press-cylinder", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Speed of the main shaft of a press, of the cam of a motion program, or of a shaft alone, rpm [default: that of the file]; several are
    /// the sections of the conoid of the file
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Vec<f64>,

    /// How many critical speeds, 1 to 12 [default: 3, or as many as there are; 1 with --solver paper]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=12))]
    pub(in crate::cli) modes: Option<u8>,

    /// Whirl with the shaft, in a plane, or against the shaft
    #[arg(long, value_name = "WAY", default_value = "forward", ignore_case = true)]
    pub(in crate::cli) whirl: WhirlOf,

    /// exact (to rounding) or paper (the paper's iteration: one critical speed, two supports, without shear and gyroscopic moments)
    #[arg(long, value_name = "SOLVER", default_value = "exact", ignore_case = true)]
    pub(in crate::cli) solver: ShaftSolver,

    /// Stations of --solver paper, 1 to 1000000 [default: 18]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(in crate::cli) stations: Option<u32>,

    /// Order of the load polynomials of --solver exact, 1 to 24, or auto: as many as leave rounding only
    #[arg(long, value_name = "N", default_value = "auto", value_parser = order)]
    pub(in crate::cli) order: Order,

    /// Gives every elastic support these stiffnesses in turn, e.g. "1e8 N/m .. 1e9 N/m"
    #[arg(long, value_name = "FROM..TO", value_parser = stiffnesses, allow_hyphen_values = true)]
    pub(in crate::cli) sweep: Option<(f64, f64)>,

    /// Equal steps of the sweep, 1 to 1000 [default: 10]
    #[arg(long, value_name = "N", requires = "sweep", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(in crate::cli) steps: Option<u32>,

    /// Rows of the tables, along the shaft and over a turn of the cam
    #[arg(long, value_name = "N", default_value_t = 360, value_parser = clap::value_parser!(u32).range(8..=100_000))]
    pub(in crate::cli) samples: u32,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

/// What a frame is designed for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum FrameOf {
    Level,
    Robust,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct BrakeArgs {
    /// An embedded machine or the path of a machine file with the table [brake]
    #[arg(default_value = "roll", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Also cuts the disc of [brake.cam] that holds the tension over the whole roll; its files are STEM-cam.*
    #[arg(long)]
    pub(in crate::cli) cam: bool,

    /// Designs the frame for the roll, the friction and the pulleys of the file: level (least change of the tension over the roll) or
    /// robust (over the roll and a friction of ± 20 % together), and prints it as a table to paste [default of the flag: level]
    #[arg(long, value_name = "GOAL", ignore_case = true, num_args = 0..=1, require_equals = true, default_missing_value = "level", conflicts_with = "cam")]
    pub(in crate::cli) synthesize: Option<FrameOf>,

    /// Random start of --synthesize
    #[arg(long, value_name = "N", default_value_t = 1, requires = "synthesize")]
    pub(in crate::cli) seed: u64,

    /// Equal steps of the roll's radius in the table
    #[arg(long, value_name = "N", default_value_t = 110, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(in crate::cli) samples: u32,

    #[command(flatten)]
    pub(in crate::cli) accuracy: AccuracyArgs,

    #[command(flatten)]
    pub(in crate::cli) laid: LaidArgs,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

/// What may be left open beside the base radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum FreeOf {
    Offset,
    #[value(alias = "pivot_distance", alias = "arm")]
    PivotDistance,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct SizeArgs {
    /// The path of a file with [motion] and a follower, or an embedded one
    #[arg(value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// What may be chosen beside the base radius: offset (of a roller or a knife edge on a straight path) or pivot-distance (of an
    /// arm; also called arm) [default: what the file leaves to auto]
    #[arg(long, value_name = "LIST", value_delimiter = ',', ignore_case = true)]
    pub(in crate::cli) free: Vec<FreeOf>,

    /// Speed of the cam, rpm [default: that of the file]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Option<f64>,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

#[derive(Debug, Args)]
pub(in crate::cli) struct LawsArgs {
    /// The path of a file with [motion] and a follower, or an embedded one; without it only the laws themselves are told
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: Option<String>,

    /// Travel of the segment, a length or an angle [default: that of the largest segment from rest to rest of the file, else 30mm]
    #[arg(long, value_name = "LIFT", value_parser = lift, allow_hyphen_values = true)]
    pub(in crate::cli) lift: Option<LengthOrAngle>,

    /// Cam angle of the segment [default: that of the same segment, else 120deg]
    #[arg(long, value_name = "ANGLE", value_parser = segment_angle, allow_hyphen_values = true)]
    pub(in crate::cli) over: Option<f64>,

    /// Speed of the cam, rpm [default: that of the file]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Option<f64>,

    /// Column of the table to sort by, the least first; its beginning is enough [default: ca, the peak acceleration]
    #[arg(long, value_name = "COLUMN")]
    pub(in crate::cli) sort: Option<String>,

    /// Print the table as CSV in place of the report; with --svg both are written as files only
    #[arg(long, conflicts_with = "json")]
    pub(in crate::cli) csv: bool,

    /// Print the picture as SVG in place of the report
    #[arg(long, conflicts_with = "json")]
    pub(in crate::cli) svg: bool,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

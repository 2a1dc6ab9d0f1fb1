//! What the user typed.

mod analyses;
mod common;
mod files;
mod help;
mod later;
mod parse;

pub(super) use analyses::{
    AnalysisArgs, BrakeArgs, DriveArgs, DriveSolver, FrameOf, FreeOf, GoalOf, LawsArgs, LinkageArgs, RegimesArgs,
    ResetOf, ShaftArgs, ShaftSolver, SizeArgs, SpringArgs, WhirlOf,
};
pub(super) use common::{AccuracyArgs, CommonArgs, EndOf, ToldArgs};
pub(super) use files::{
    CutterArgs, FileArgs, LaidArgs, LaidOf, OutArgs, PointsArgs, PointsAs, PointsBetween, PointsOf, PointsStep, SideOf,
};
pub(super) use later::Later;
pub(super) use parse::{Order, Speed};

use camgen::motion::equation_18::ExactOn;
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use clap_complete::Shell;
use parse::{force, share};
pub(super) use parse::{rpm, stem, tolerance};
use std::path::PathBuf;

/// Cams a CNC shop can cut: solved exactly, drawn as tangent arcs, proved on the written file
///
/// From a motion, a follower and limits camgen solves the exact cam, draws its outline within a stated tolerance, proves it by
/// rolling the follower on the file as written, and writes DXF, SVG, STEP and CSV.
///
/// Exit code: 0 fine; 1 a check failed, and nothing is written without --force; 2 bad input.
#[derive(Debug, Parser)]
#[command(name = "camgen", version, max_term_width = 110, after_help = help::CAMGEN)]
pub(super) struct Cli {
    #[command(subcommand)]
    pub(super) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Disc cam of a press for one speed
    ///
    /// The cam moves the bottom of the air buffers so that the air force equals the inertia force of the bed.
    #[command(after_help = help::ROTARY)]
    Rotary(Later<RotaryArgs>),
    /// Wedge cam of a press: a plate on the bed, by equation (18)
    ///
    /// The plate rides on the bed and moves the bottom through a bell crank with a roller on each flank.
    #[command(after_help = help::TRANSLATING)]
    Translating(Later<TranslatingArgs>),
    /// Three-dimensional cam of a press for many speeds
    ///
    /// The cam is shifted along its axis as the speed changes; it is written as sections and as a solid.
    #[command(after_help = help::CONOID)]
    Conoid(Later<ConoidArgs>),
    /// Disc cam of any motion under any follower, from a file
    ///
    /// The file has a program of segments, `[motion]` and `[[motion.segment]]`, and a follower.
    #[command(after_help = help::MAKE)]
    Make(Later<DiscArgs>),
    /// One cam of a press at other speeds: the column is reset, or air is added
    ///
    /// The cam stays as it is cut. Equations (14) and (15) give the column and the volume for each speed, and the residual force that
    /// is left then.
    #[command(after_help = help::REGIMES)]
    Regimes(Later<RegimesArgs>),
    /// Buffers of a press whose bottoms rest on springs, without a cam
    ///
    /// Equations (26) to (28): travel of the springs, air, residual force and setting of the screw, for each stiffness and speed.
    #[command(after_help = help::SPRING)]
    Spring(Later<SpringArgs>),
    /// Drive of a bed without a cam: the speed of the crank that plain buffers ask for
    ///
    /// The drive slows down so that the crank carries nothing while plain buffers brake the bed.
    #[command(after_help = help::DRIVE)]
    Drive(Later<DriveArgs>),
    /// Linkage that moves a bed: dead points, accelerations, transmission angles, torque
    ///
    /// A crank-slider, or a six-bar whose drag link turns the crank of the slider unevenly.
    #[command(after_help = help::LINKAGE)]
    Linkage(Later<LinkageArgs>),
    /// The shaft under a cam, or alone: critical speeds, lift error, unbalance
    ///
    /// What bending and twist of the shaft take off the lift, and the force that this leaves, for the cam of the file.
    #[command(after_help = help::SHAFT)]
    Shaft(Later<ShaftArgs>),
    /// Belt brake of a paper roll: web tension, and the disc that holds it
    ///
    /// What a hinged frame with a belt makes of the tension, the paper's equations beside it, frames that hold it by themselves, and a
    /// disc on the frame's shaft that holds it exactly.
    #[command(after_help = help::BRAKE)]
    Brake(Later<BrakeArgs>),
    /// Smallest disc for a motion program, and which limit binds it
    ///
    /// Base radius, and offset or pivot distance where they are left open; how the size changes with the place of the follower.
    #[command(after_help = help::SIZE)]
    Size(Later<SizeArgs>),
    /// Every law of motion at the numbers of a design, in one table
    ///
    /// Peaks of velocity, acceleration and jerk; with a file also pressure angle, size, forces, jump speed, vibration and harmonics.
    #[command(after_help = help::LAWS)]
    Laws(Later<LawsArgs>),
    /// Two disc cams in one HTML report, beside each other
    ///
    /// Both mechanisms move together, the curves lie over each other, and the differences are marked.
    #[command(after_help = help::SIDE_BY_SIDE)]
    SideBySide(Later<super::side_by_side::SideBySideArgs>),
    /// Is this DXF or STEP file that cam, and if not, why?
    ///
    /// The file may have been edited or written by another program. The follower is rolled on what it holds.
    #[command(after_help = help::CHECK)]
    Check(Later<CheckArgs>),
    /// Speed against accuracy, measured on this computer
    ///
    /// Arcs, splines and tables of points side by side: time of each stage, pieces, bytes, true error and residual force.
    #[command(after_help = help::TRADE)]
    Trade(Later<TradeArgs>),
    /// The machine files that camgen carries
    #[command(after_help = help::MACHINES)]
    Machines(MachinesArgs),
    /// A commented machine file to start from
    #[command(after_help = help::INIT)]
    Init(InitArgs),
    /// What a check means, how it is made, usual limits, what to change
    #[command(after_help = help::EXPLAIN)]
    Explain(ExplainArgs),
    /// The JSON schema of machine files, for editors
    #[command(after_help = help::SCHEMA)]
    Schema,
    /// Completions for a shell
    #[command(after_help = help::COMPLETIONS)]
    Completions(CompletionsArgs),
    /// Manual pages
    #[command(after_help = help::MAN)]
    Man(ManArgs),
}

impl Command {
    /// The files that `--watch` looks at, when it is asked for: the machine file, and the file that is checked.
    pub(super) fn watched(&self) -> Option<Vec<PathBuf>> {
        let (common, more) = match self {
            Command::Rotary(Later(RotaryArgs { disc: args, .. })) | Command::Make(Later(args)) => {
                (&args.common, args.files.to.template.as_ref())
            }
            Command::Translating(Later(args)) => (&args.common, args.files.to.template.as_ref()),
            Command::Conoid(Later(args)) => (&args.common, args.files.to.template.as_ref()),
            Command::Check(Later(args)) => {
                let machine = args.design.as_ref().unwrap_or(&args.common.machine);
                return args.common.told.watch.then(|| vec![PathBuf::from(machine), args.file.clone()]);
            }
            Command::Trade(Later(args)) => (&args.common, None),
            other => return other.analysis_watched(),
        };
        common.told.watch.then(|| std::iter::once(PathBuf::from(&common.machine)).chain(more.cloned()).collect())
    }

    /// The same of an analysis.
    fn analysis_watched(&self) -> Option<Vec<PathBuf>> {
        if let Command::Laws(Later(LawsArgs { machine: Some(machine), analysis, .. })) = self {
            return analysis.told.watch.then(|| vec![PathBuf::from(machine)]);
        }
        let (machine, args) = match self {
            Command::Regimes(Later(args)) => (&args.machine, &args.analysis),
            Command::Spring(Later(args)) => (&args.machine, &args.analysis),
            Command::Drive(Later(args)) => (&args.machine, &args.analysis),
            Command::Linkage(Later(args)) => (&args.machine, &args.analysis),
            Command::Shaft(Later(args)) => (&args.machine, &args.analysis),
            Command::Brake(Later(args)) => (&args.machine, &args.analysis),
            Command::Size(Later(args)) => (&args.machine, &args.analysis),
            _ => return None,
        };
        let files = || std::iter::once(PathBuf::from(machine)).chain(args.to.template.clone()).collect();
        args.told.watch.then(files)
    }
}

#[derive(Debug, Args)]
pub(super) struct InitArgs {
    /// File to write; printed when it is left out. A file that is there is never replaced
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) file: Option<PathBuf>,

    /// For camgen make, with this follower: roller, swinging-roller, flat, swinging-flat or knife [default: a press]
    #[arg(long, value_name = "FOLLOWER")]
    pub(super) follower: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct CompletionsArgs {
    /// The shell
    #[arg(value_name = "SHELL", ignore_case = true)]
    pub(super) shell: Shell,
}

#[derive(Debug, Args)]
pub(super) struct ManArgs {
    /// A command; the page of camgen itself when it is left out
    #[arg(value_name = "COMMAND")]
    pub(super) command: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct ExplainArgs {
    /// Name of the check, as in reports; all in short when it is left out
    pub(super) check: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct RotaryArgs {
    #[command(flatten)]
    pub(super) disc: DiscArgs,

    /// Also makes a second disc whose spring takes the torque of the camshaft, with these keys of the table [compensator], e.g.
    /// spring_rate=100N/mm,preload=10kN; its files are STEM-compensator.*
    #[arg(long, value_name = "KEY=VALUE,…", value_delimiter = ',')]
    pub(super) compensator: Vec<String>,
}

#[derive(Debug, Args)]
pub(super) struct DiscArgs {
    #[command(flatten)]
    pub(super) common: CommonArgs,

    #[command(flatten)]
    pub(super) files: FileArgs,

    #[command(flatten)]
    pub(super) cutter: CutterArgs,
}

#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    /// The DXF or STEP file
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) file: PathBuf,

    /// Kind of cam the file should hold, by the command that makes it [default: rotary; make for a motion program]
    #[arg(long, value_name = "KIND", ignore_case = true)]
    pub(super) cam: Option<Checked>,

    /// The file of a motion program, as given to make, in place of MACHINE
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, conflicts_with_all = ["machine", "cam"])]
    pub(super) design: Option<String>,

    /// Direction of the bed in which the forces of a plate balance
    #[arg(long, value_name = "WAY", default_value = "braking", ignore_case = true)]
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
    Compensator,
    Translating,
    Conoid,
    Make,
    Brake,
}

/// A kind of cam that `trade` knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum CamKind {
    Rotary,
    Translating,
    /// The disc cam of a motion program.
    Make,
    /// The first critical speed of a shaft, press-cylinder by default.
    Shaft,
}

#[derive(Debug, Args)]
pub(super) struct TranslatingArgs {
    #[command(flatten)]
    pub(super) common: CommonArgs,

    #[command(flatten)]
    pub(super) files: FileArgs,

    /// How equation (18) is solved: ode (a differential equation, to a thousandth of a nanometre) or paper (station by station with
    /// the backward difference (25))
    #[arg(long, value_name = "SOLVER", default_value = "ode", ignore_case = true)]
    pub(super) solver: SolverKind,

    /// Stations of the paper's solver over the stroke; its error is about 18 mm over their number [default: 1800]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    pub(super) stations: Option<u32>,

    /// Direction of the bed in which the forces balance, or mean: equal residual forces in both
    #[arg(long, value_name = "WAY", default_value = "braking", ignore_case = true)]
    pub(super) balance: Balanced,
}

#[derive(Debug, Args)]
pub(super) struct TradeArgs {
    /// Kind of cam: rotary, translating or make (a motion program, by default feeder); or shaft: the first critical speed of the shaft of a file (by default press-cylinder)
    #[arg(default_value = "rotary", value_name = "KIND", ignore_case = true)]
    pub(super) kind: CamKind,

    #[command(flatten)]
    pub(super) common: CommonArgs,

    /// Largest residual force: the advice is the cheapest setting that keeps it [default: 0.01 % of the largest inertia; none of a motion program]
    #[arg(long, value_name = "FORCE", value_parser = force)]
    pub(super) residual: Option<f64>,

    /// Largest error of the acceleration that the advice keeps, as a share of the motion's largest, e.g. 2%
    /// [default: 5% of a motion program]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    pub(super) acceleration: Option<f64>,

    /// Directory for the table and the picture, created when missing
    #[arg(long, value_name = "DIR", default_value = "output")]
    pub(super) out: PathBuf,

    /// File stem [default: MACHINE-trade-KIND-RPMrpm]
    #[arg(long, value_name = "STEM", value_parser = stem)]
    pub(super) name: Option<String>,

    /// Replace files that were edited, or not written by camgen; its own are replaced without
    #[arg(long)]
    pub(super) overwrite: bool,
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

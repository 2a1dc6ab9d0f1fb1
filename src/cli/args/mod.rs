//! What the user typed.

mod analyses;
mod brake;
mod common;
mod deferred;
mod files;
mod help;
pub(crate) mod parse;
mod serve;
mod side_by_side;
mod study;

pub(crate) use analyses::{
    AnalysisArgs, CompareArgs, DriveArgs, ImportArgs, ImportAs, ImportForm, LawsArgs, RegimesArgs, ScatterArgs,
    SizeArgs, SpringArgs,
};
pub(crate) use analyses::{LinkageArgs, LinkageGoal};
pub(crate) use analyses::{ShaftArgs, ShaftSolver};
pub(crate) use brake::BrakeArgs;
pub(super) use common::{AccuracyArgs, CommonArgs, ReportArgs, at_end, machine_of_a_cam, machine_with_free};
pub(super) use deferred::DeferredArgs;
pub(super) use files::{CutterArgs, FileArgs, OutlineArgs, OutputArgs, PointsArgs};
pub(super) use parse::Order;
pub(super) use parse::{LawOrSpline, Speed, gauge_follower};
pub(super) use serve::ServeArgs;
pub(super) use side_by_side::SideBySideArgs;
pub(super) use study::StudyArgs;

use camgen::analysis::size::FreeDimension;
use camgen::domains::press::bed_motion::End;
use camgen::domains::press::motion::equation_18::ExactOn;
use camgen::units::LengthUnit;
use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use clap_complete::Shell;
pub(super) use parse::rpm;
use parse::{cutter_diameter, cutter_radius, force, share, speed, word};
use std::path::PathBuf;

/// Cams a CNC shop can cut: solved exactly, drawn as tangent arcs, proved on the written file
///
/// From a motion, a follower and limits camgen solves the exact cam, draws its outline within a stated tolerance, proves it by
/// rolling the follower on the file as written, and writes DXF, SVG, STEP and CSV.
///
/// Exit code: 0 fine; 1 a check failed, and nothing is written without --force; 2 bad input.
#[derive(Debug, Parser)]
#[command(name = "camgen", version, max_term_width = 110, override_help = help::OVERVIEW)]
pub(super) struct Cli {
    /// Tables of a machine file may also lie in this folder; repeatable
    #[arg(long, global = true, value_name = "DIR", value_hint = ValueHint::DirPath)]
    pub(super) allow_path: Vec<PathBuf>,

    #[command(subcommand)]
    pub(super) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Disc cam of a press for one speed
    ///
    /// The cam moves the bottom of the air buffers so that the air force equals the inertia force of the bed.
    #[command(after_help = help::ROTARY)]
    Rotary(DeferredArgs<RotaryArgs>),
    /// Linear cam of a press: a plate on the bed, by equation (18)
    ///
    /// The plate rides on the bed and moves the bottom through a bell crank with a roller on each flank.
    #[command(after_help = help::TRANSLATING)]
    Translating(DeferredArgs<TranslatingArgs>),
    /// Three-dimensional cam of a press for many speeds
    ///
    /// The cam is shifted along its axis as the speed changes; it is written as sections and as a solid.
    #[command(after_help = help::CONOID)]
    Conoid(DeferredArgs<ConoidArgs>),
    /// Disc cam of any motion under any follower, from a file
    ///
    /// The file has a program of segments, `[motion]` and `[[motion.segment]]`, and a follower.
    #[command(after_help = help::MAKE)]
    Make(DeferredArgs<DiscArgs>),
    /// One cam of a press at other speeds: the column is reset, or air is added
    ///
    /// The cam stays as it is cut. Equations (14) and (15) give the column and the volume for each speed, and the residual force that
    /// is left then.
    #[command(after_help = help::REGIMES)]
    Regimes(DeferredArgs<RegimesArgs>),
    /// Buffers of a press whose bottoms rest on springs, without a cam
    ///
    /// Equations (26) to (28): travel of the springs, air, residual force and setting of the screw, for each stiffness and speed.
    #[command(after_help = help::SPRING)]
    Spring(DeferredArgs<SpringArgs>),
    /// What is left of a cam of a press in practice: machines that differ, and the screw
    ///
    /// Mass, speed, weather, air and setting differ from those the cam is cut for: what each leaves, what the screw takes back, and what a fixed
    /// bottom leaves in the same presses.
    #[command(after_help = help::SCATTER)]
    Scatter(DeferredArgs<ScatterArgs>),
    /// Drive of a bed without a cam: the crank speed that plain buffers need
    ///
    /// The drive slows down so that the crank carries no load while plain buffers brake the bed.
    #[command(after_help = help::DRIVE)]
    Drive(DeferredArgs<DriveArgs>),
    /// Linkage that moves a bed: dead points, accelerations, transmission angles, torque
    ///
    /// A crank-slider, or a six-bar whose drag link turns the crank of the slider unevenly.
    #[command(after_help = help::LINKAGE)]
    Linkage(DeferredArgs<LinkageArgs>),
    /// The shaft under a cam, or alone: critical speeds, lift error, unbalance
    ///
    /// How much bending and twist of the shaft reduce the lift, and the residual force that results, for the cam of the file.
    #[command(after_help = help::SHAFT)]
    Shaft(DeferredArgs<ShaftArgs>),
    /// Belt brake of a paper roll: web tension, and the disc that holds it
    ///
    /// Web tension with a belt on a hinged frame, compared with the paper's equations; frames that hold it by themselves, and a disc on
    /// the frame's shaft that holds it exactly.
    #[command(after_help = help::BRAKE)]
    Brake(DeferredArgs<BrakeArgs>),
    /// Smallest disc for a motion program, and the limit that decides it
    ///
    /// Base radius, and offset or pivot distance where they are left open; how the size changes with the place of the follower.
    #[command(after_help = help::SIZE)]
    Size(DeferredArgs<SizeArgs>),
    /// Every law of motion at the numbers of a design, in one table
    ///
    /// Peaks of velocity, acceleration and jerk; with a file also pressure angle, size, forces, jump speed, vibration and harmonics.
    #[command(after_help = help::LAWS)]
    Laws(DeferredArgs<LawsArgs>),
    /// An old cam as a design: a lift table, an outline or measured points to a design file
    ///
    /// Finds the dwells and the law of each rise and return, within a stated deviation; what no law follows becomes a spline. The design file is one
    /// that `camgen make` takes as it is.
    #[command(after_help = help::IMPORT)]
    Import(DeferredArgs<ImportArgs>),
    /// A measured cam against the exact one: deviations, waviness, what the follower feels
    ///
    /// The points are a table of x and y, or of angle and radius; the angle, and where asked for the centre, with which they agree best is found first.
    #[command(after_help = help::COMPARE)]
    Compare(DeferredArgs<CompareArgs>),
    /// Two disc cams in one HTML report, side by side
    ///
    /// Both mechanisms move together, the curves are overlaid, and the differences are marked.
    #[command(after_help = help::SIDE_BY_SIDE)]
    SideBySide(DeferredArgs<SideBySideArgs>),
    /// Whether a DXF or STEP file is the cam of a design, and if not, why
    ///
    /// The file may have been edited or written by another program. The follower is rolled on the outline in the file.
    #[command(after_help = help::CHECK)]
    Check(DeferredArgs<CheckArgs>),
    /// Speed against accuracy, measured on this computer
    ///
    /// Arcs, splines and tables of points side by side: time of each stage, pieces, bytes, true error and residual force.
    #[command(after_help = help::TRADE)]
    Trade(DeferredArgs<TradeArgs>),
    /// Sweeps, Monte Carlo and Pareto fronts: a row of figures for each of many designs
    ///
    /// A study file names a base, the keys that vary and the figures that are wanted. An interrupted run is continued by the same command.
    #[command(after_help = help::STUDY)]
    Study(DeferredArgs<StudyArgs>),
    /// The live page on this computer: a design changed in the browser
    ///
    /// The page has the engine of this program. It reads the machine file again when it changes, writes it back with its comments, and writes
    /// files all or none. Without FILE it begins with all embedded designs.
    #[command(after_help = help::SERVE)]
    Serve(DeferredArgs<ServeArgs>),
    /// The machine files built into camgen
    #[command(after_help = help::MACHINES)]
    Machines(MachinesArgs),
    /// A commented machine file to start from
    #[command(after_help = help::INIT)]
    Init(InitArgs),
    /// What a check means, how it is calculated, usual limits, what to change
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
    /// The files that `--watch` watches, when it is given: the machine file, and the file that is checked.
    pub(super) fn watched(&self) -> Option<Vec<PathBuf>> {
        let (common, more) = match self {
            Command::Rotary(DeferredArgs(RotaryArgs { disc: args, .. })) | Command::Make(DeferredArgs(args)) => {
                (&args.common, args.files.to.template.as_ref())
            }
            Command::Translating(DeferredArgs(args)) => (&args.common, args.files.to.template.as_ref()),
            Command::Conoid(DeferredArgs(args)) => (&args.common, args.files.to.template.as_ref()),
            Command::Check(DeferredArgs(args)) => {
                let machine = args.design.as_deref().unwrap_or(args.common.machine_name());
                return args.common.report.watch.then(|| vec![PathBuf::from(machine), args.file.clone()]);
            }
            other => return other.analysis_watched(),
        };
        common
            .report
            .watch
            .then(|| std::iter::once(PathBuf::from(common.machine_name())).chain(more.cloned()).collect())
    }

    /// The watched files of an analysis.
    fn analysis_watched(&self) -> Option<Vec<PathBuf>> {
        if let Command::Laws(DeferredArgs(LawsArgs { machine: Some(machine), analysis, .. })) = self {
            return analysis.report.watch.then(|| vec![PathBuf::from(machine)]);
        }
        if let Command::Import(DeferredArgs(args)) = self {
            return args.report.watch.then(|| vec![args.file.clone()]);
        }
        if let Command::Trade(DeferredArgs(args)) = self {
            let machine = args.target().1.unwrap_or("dpi");
            return args.analysis.report.watch.then(|| vec![PathBuf::from(machine)]);
        }
        let (machine, args) = match self {
            Command::Regimes(DeferredArgs(args)) => (&args.machine, &args.analysis),
            Command::Spring(DeferredArgs(args)) => (&args.machine, &args.analysis),
            Command::Scatter(DeferredArgs(args)) => (&args.machine, &args.analysis),
            Command::Drive(DeferredArgs(args)) => (&args.machine, &args.analysis),
            Command::Linkage(DeferredArgs(args)) => (&args.machine, &args.analysis),
            Command::Shaft(DeferredArgs(args)) => (&args.machine, &args.analysis),
            Command::Brake(DeferredArgs(args)) => (&args.machine, &args.analysis),
            Command::Size(DeferredArgs(args)) => (&args.machine, &args.analysis),
            Command::Compare(DeferredArgs(args)) => (&args.machine, &args.analysis),
            _ => return None,
        };
        args.report.watch.then(|| std::iter::once(PathBuf::from(machine)).chain(args.to.template.clone()).collect())
    }
}

#[derive(Debug, Args)]
pub(super) struct InitArgs {
    /// File to write; an existing file is never replaced [default: print it]
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(super) file: Option<PathBuf>,

    /// A motion program for camgen make with this follower: roller, swinging-roller, flat, swinging-flat or knife [default: a press]
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
    /// A command; the page of camgen itself when omitted
    #[arg(value_name = "COMMAND")]
    pub(super) command: Option<String>,
}

#[derive(Debug, Args)]
pub(super) struct ExplainArgs {
    /// Name of the check, as in reports; lists all checks when omitted
    pub(super) check: Option<String>,

    /// List all checks with their meaning, a line each
    #[arg(long, short)]
    pub(super) verbose: bool,
}

#[derive(Debug, Args)]
pub(super) struct RotaryArgs {
    #[command(flatten)]
    pub(super) disc: DiscArgs,

    /// Also make a second disc whose spring balances the torque of the camshaft, with these keys of the table [compensator], e.g.
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

    /// Kind of cam the file should contain, named by the command that makes it [default: rotary; make for a motion program]; without MACHINE
    /// that of the record next to the file, or of the hash in the file
    #[arg(long, value_name = "KIND", ignore_case = true)]
    pub(super) cam: Option<CheckTarget>,

    /// The file of a motion program, as given to make, instead of MACHINE
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, conflicts_with_all = ["machine", "cam"])]
    pub(super) design: Option<String>,

    /// How the report is printed: text, or json as with --json
    #[arg(long, value_name = "FORMAT", default_value = "text", ignore_case = true)]
    pub(super) format: ReportFormat,

    /// Layer of the outline in a DXF file [default: CAM_PROFILE; without that layer the outermost closed contour]
    #[arg(long, value_name = "NAME")]
    pub(super) layer: Option<String>,

    /// Radius of the cutter, when the file is the path of its centre [default: that of the record next to the file]
    #[arg(long, value_name = "RADIUS", value_parser = cutter_radius, conflicts_with = "cutter_diameter")]
    pub(super) cutter_radius: Option<f64>,

    /// Diameter of the cutter, when the file holds the path of its centre
    #[arg(long, value_name = "DIAMETER", value_parser = cutter_diameter)]
    pub(super) cutter_diameter: Option<f64>,

    /// Direction of the bed in which the forces of a plate balance [default: that of the file, else braking]
    #[arg(long, value_name = "DIRECTION", ignore_case = true, value_parser = word::<ExactOn>())]
    pub(super) balance: Option<ExactOn>,

    /// Speed of the section of a conoid that a DXF file should contain, one of those of --rpm
    #[arg(long, value_name = "RPM", value_parser = rpm, allow_hyphen_values = true)]
    pub(super) section: Option<f64>,

    /// Residual force for which the sections of a conoid were chosen, as given to conoid --rpm A..B
    #[arg(long, value_name = "FORCE", value_parser = force)]
    pub(super) residual: Option<f64>,

    /// Unit that a DXF file is to be in, and of the report: mm or inch [default: that of the record next to the file, output.units, mm]
    #[arg(long, value_name = "UNIT", ignore_case = true, value_parser = word::<LengthUnit>())]
    pub(super) units: Option<LengthUnit>,

    #[command(flatten)]
    pub(super) common: CommonArgs,
}

/// How a report is printed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ReportFormat {
    Text,
    Json,
}

/// A kind of cam that `check` knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum CheckTarget {
    Rotary,
    Compensator,
    Translating,
    Conoid,
    Make,
    Brake,
}

/// A kind of cam that `trade` knows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum TradeTarget {
    Rotary,
    Translating,
    /// The sections of a conoid, over a range of speeds.
    Conoid,
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

    /// Direction of the bed in which the forces balance, or level (also mean): equal residual forces in both [default: that of the file, else braking]
    #[arg(long, value_name = "DIRECTION", ignore_case = true, value_parser = word::<ExactOn>())]
    pub(super) balance: Option<ExactOn>,
}

#[derive(Debug, Args)]
pub(super) struct TradeArgs {
    /// A machine or motion program, embedded or the path of a file; or, before it, a kind: rotary, translating, conoid (its sections), make (a motion
    /// program, by default feeder) or shaft (the first critical speed, by default press-cylinder) [default: rotary]
    #[arg(value_name = "KIND|FILE", value_hint = ValueHint::FilePath)]
    pub(super) kind: Option<String>,

    /// An embedded machine or the path of a machine file, after a kind
    #[arg(value_hint = ValueHint::FilePath)]
    pub(super) machine: Option<String>,

    /// Main-shaft speed the cam is cut for (for `make` the speed of the cam), rpm, or A..B for a conoid [default: that of the machine file]
    #[arg(long, value_name = "N", value_parser = speed, allow_hyphen_values = true)]
    pub(super) rpm: Option<Speed>,

    /// End of the bed's stroke that has the buffers; needs [linkage] in the machine file [default: outer]
    #[arg(long, value_name = "END", ignore_case = true, value_parser = word::<End>())]
    pub(super) end: Option<End>,

    /// What is chosen with the base radius, for a motion program: offset or pivot_distance, in the place of what the file gives
    #[arg(long, value_name = "LIST", value_delimiter = ',', ignore_case = true, value_parser = word::<FreeDimension>())]
    pub(super) free: Vec<FreeDimension>,

    /// Largest residual force: the advice is the cheapest setting that keeps it [default: 0.01 % of the largest inertia force; none for a motion program]
    #[arg(long, value_name = "FORCE", value_parser = force)]
    pub(super) residual: Option<f64>,

    /// Largest error of the acceleration that the advice keeps, as a share of the motion's largest, e.g. 2%
    /// [default: 5%, as --accuracy standard]
    #[arg(long, value_name = "SHARE", value_parser = share, allow_hyphen_values = true)]
    pub(super) acceleration: Option<f64>,

    #[command(flatten)]
    pub(super) analysis: AnalysisArgs,
}

impl TradeArgs {
    /// The kind, where it is named, and the file, where one is.
    pub(super) fn target(&self) -> (Option<TradeTarget>, Option<&str>) {
        let first = self.kind.as_deref();
        let kind = first.and_then(|word| TradeTarget::from_str(word, true).ok());
        let file = if kind.is_some() { None } else { first };
        (kind, file.or(self.machine.as_deref()))
    }
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

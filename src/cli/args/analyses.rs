//! Flags of the commands that analyse a machine and cut nothing.

use super::common::ReportArgs;
use super::files::OutputArgs;
use super::parse::power_share;
use super::parse::{
    LawOrSpline, crank_step, cutter_diameter, cutter_radius, force, format, law, law_or_spline, lift, rpm,
    segment_angle, stiffness, word,
};
use super::parse::{Order, order, stiffnesses};
use camgen::analysis::compare::ComparisonFit;
use camgen::analysis::compare::measured::PointsOf;
use camgen::analysis::import::ImportFit;
use camgen::analysis::size::FreeDimension;
use camgen::document::LengthOrAngle;
use camgen::domains::press::analysis::drive;
use camgen::domains::press::bed_motion::End;
use camgen::domains::press::buffer::regime::Reset;
use camgen::domains::press::scatter::monte_carlo::Distribution;
use camgen::domains::press::scatter::reset::ScrewRule;
use camgen::domains::shaft::mechanics::Whirl;
use camgen::motion::laws::Law;
use clap::ValueEnum;
use clap::{Args, ValueHint};
use std::path::PathBuf;

/// Flags of every analysis.
#[derive(Debug, Args)]
pub(crate) struct AnalysisArgs {
    /// Override one key of the machine file, e.g. --set buffer.lead=10mm; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub(in crate::cli) set: Vec<String>,

    /// Formats to write: csv, svg, json, html (the report with its curves), pdf and, for a linkage or a brake, toml (its table for a
    /// machine file); with a cam also the formats of a cam [default: csv,svg]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = format)]
    pub(in crate::cli) format: Option<Vec<String>>,

    #[command(flatten)]
    pub(in crate::cli) to: OutputArgs,

    #[command(flatten)]
    pub(in crate::cli) report: ReportArgs,
}

#[derive(Debug, Args)]
pub(crate) struct RegimesArgs {
    /// An embedded machine or the path of a machine file
    #[arg(default_value = "dpi", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Speeds of the main shaft, rpm [default: those of the file, else 4/7, 5/7, 6/7 and 7/7 of the design speed]
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Vec<f64>,

    /// Speed the cam is cut for, rpm [default: the design speed]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) cut_for: Option<f64>,

    /// Buffers with fixed bottoms, sized alone: column, residual force and bore for each speed and for other end pressures
    #[arg(long, conflicts_with = "cut_for")]
    pub(in crate::cli) without_cam: bool,

    /// Rule for the residual force at the end of the stroke after the reset: end (zero there), half (the paper's rule: half of the
    /// largest) or level (as large there as at the worst other place, which gives the smallest maximum)
    /// [default: that of the file, else end]
    #[arg(long, value_name = "RULE", ignore_case = true, value_parser = word::<Reset>())]
    pub(in crate::cli) reset: Option<Reset>,

    /// End of the bed's stroke that has the buffers; needs [linkage] in the machine file [default: outer]
    #[arg(long, value_name = "END", ignore_case = true, value_parser = word::<End>())]
    pub(in crate::cli) end: Option<End>,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

#[derive(Debug, Args)]
pub(crate) struct SpringArgs {
    /// An embedded machine or the path of a machine file
    #[arg(default_value = "dpi", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Stiffness of each of the two springs, e.g. 68kgf/cm,165kgf/cm [default: that of the file, else 1.125, 1.375 and
    /// 2.75 times the smallest possible one]
    #[arg(long, value_name = "STIFFNESS,…", value_delimiter = ',', value_parser = stiffness, allow_hyphen_values = true)]
    pub(in crate::cli) stiffness: Vec<f64>,

    /// Largest residual force at the design speed: adds the stiffness that leaves exactly this force, e.g. 50kgf
    #[arg(long, value_name = "FORCE", value_parser = force, allow_hyphen_values = true)]
    pub(in crate::cli) residual: Option<f64>,

    /// Speeds of the main shaft, rpm [default: the design speed]
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Vec<f64>,

    /// Find the thinnest standard wire for each spring; needs spring_buffer.body.stress
    #[arg(long)]
    pub(in crate::cli) design: bool,

    /// End of the bed's stroke that has the buffers; needs [linkage] in the machine file [default: outer]
    #[arg(long, value_name = "END", ignore_case = true, value_parser = word::<End>())]
    pub(in crate::cli) end: Option<End>,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

#[derive(Debug, Args)]
pub(crate) struct ScatterArgs {
    /// An embedded machine or the path of a machine file
    #[arg(default_value = "dpi", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Speed the cam is cut for, rpm [default: the design speed]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Option<f64>,

    /// One machine that differs: a deviation (mass=5%, column=-2mm), a true value with its unit (mass=1020kg, speed=34rpm), or the true
    /// exponent (polytropic_exponent=1.40); repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub(in crate::cli) fault: Vec<String>,

    /// Half width of a parameter, as a key of the table [scatter], e.g. --vary mass=8%; repeatable
    #[arg(long, value_name = "KEY=HALF")]
    pub(in crate::cli) vary: Vec<String>,

    /// Setting of the screw in each press: none, end (no residual force at the end of the stroke) or level (the least largest one)
    /// [default: that of the file, else end]
    #[arg(long, value_name = "RULE", ignore_case = true, value_parser = word::<ScrewRule>())]
    pub(in crate::cli) reset: Option<ScrewRule>,

    /// Distribution of every parameter over its band: uniform, triangular, or normal with the half width as two standard deviations
    /// [default: that of the file, else uniform]
    #[arg(long, value_name = "NAME", ignore_case = true, value_parser = word::<Distribution>())]
    pub(in crate::cli) distribution: Option<Distribution>,

    /// Presses that are drawn, 0 to 1000000 [default: that of the file, else 20000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    pub(in crate::cli) samples: Option<u32>,

    /// Seed of the draws [default: that of the file, else 1]
    #[arg(long, value_name = "N")]
    pub(in crate::cli) seed: Option<u64>,

    /// End of the bed's stroke that has the buffers; needs [linkage] in the machine file [default: outer]
    #[arg(long, value_name = "END", ignore_case = true, value_parser = word::<End>())]
    pub(in crate::cli) end: Option<End>,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

#[derive(Debug, Args)]
pub(crate) struct DriveArgs {
    /// An embedded machine or the path of a machine file with the table [drive]
    #[arg(default_value = "dp", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// energy (in closed form) or paper (the paper's sections, of second order in the step)
    #[arg(long, value_name = "SOLVER", default_value = "energy", ignore_case = true, value_parser = word::<drive::DriveSolver>())]
    pub(in crate::cli) solver: drive::DriveSolver,

    /// Crank angle between rows, and of the paper's sections, 0.01deg to 90deg
    #[arg(long, value_name = "ANGLE", default_value = "10deg", value_parser = crank_step, allow_hyphen_values = true)]
    pub(in crate::cli) step: f64,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

/// The goal of the design of a drag link.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum LinkageGoal {
    Equal,
    Symmetric,
    Least,
}

/// The condition that a design keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum LinkageSymmetry {
    Symmetric,
}

#[derive(Debug, Args)]
pub(crate) struct LinkageArgs {
    /// An embedded machine or the path of a machine file with the table [linkage]
    #[arg(default_value = "dpi-six-bar", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Speed of the main shaft, rpm [default: the design speed]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Option<f64>,

    /// Design the drag link for the slider of the file and print it as a table to paste: equal (equal largest accelerations at both ends),
    /// symmetric (also equal times out and back) or least (the smallest largest acceleration within [limits])
    #[arg(long, value_name = "GOAL", ignore_case = true)]
    pub(in crate::cli) synthesize: Option<LinkageGoal>,

    /// With --synthesize least: equal times out and back
    #[arg(long, value_name = "WHAT", ignore_case = true)]
    pub(in crate::cli) keep: Option<LinkageSymmetry>,

    /// With --synthesize least: largest peak power, divided by that of the crank-slider alone, e.g. 0.831
    #[arg(long, value_name = "SHARE", value_parser = power_share, allow_hyphen_values = true)]
    pub(in crate::cli) power_limit: Option<f64>,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

/// How critical speeds are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShaftSolver {
    Exact,
    Paper,
}

#[derive(Debug, Args)]
pub(crate) struct ShaftArgs {
    /// An embedded machine or the path of a machine file with the table [shaft]
    #[arg(default_value = "press-cylinder", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Speed of the main shaft of a press, of the cam of a motion program, or of a shaft alone, rpm; several speeds are
    /// those of the sections of a conoid [default: that of the file]
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Vec<f64>,

    /// How many critical speeds, 1 to 12 [default: 3, or as many as there are; 1 with --solver paper]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=12))]
    pub(in crate::cli) modes: Option<u8>,

    /// Direction of whirl: with the shaft, in a plane, or against the shaft
    #[arg(long, value_name = "DIRECTION", default_value = "forward", ignore_case = true, value_parser = word::<Whirl>())]
    pub(in crate::cli) whirl: Whirl,

    /// exact (to rounding) or paper (the paper's iteration: one critical speed, two supports, without shear and gyroscopic moments)
    #[arg(long, value_name = "SOLVER", default_value = "exact", ignore_case = true)]
    pub(in crate::cli) solver: ShaftSolver,

    /// Stations of --solver paper, 1 to 1000000 [default: 18]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(in crate::cli) stations: Option<u32>,

    /// Order of the load polynomials of --solver exact, 1 to 24, or auto: as high as needed to leave only rounding
    #[arg(long, value_name = "N", default_value = "auto", value_parser = order)]
    pub(in crate::cli) order: Order,

    /// Give every elastic support these stiffnesses in turn, e.g. "1e8 N/m .. 1e9 N/m"
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

#[derive(Debug, Args)]
pub(crate) struct SizeArgs {
    /// The path of a file with [motion] and a follower, or an embedded one
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// What may be chosen in addition to the base radius: offset (of a roller or a knife edge on a straight path) or pivot_distance (of an
    /// arm; also called pivot-distance or arm) [default: what the file leaves to auto]
    #[arg(long, value_name = "LIST", value_delimiter = ',', ignore_case = true, value_parser = word::<FreeDimension>())]
    pub(in crate::cli) free: Vec<FreeDimension>,

    /// Speed of the cam, rpm [default: that of the file]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Option<f64>,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

/// The ball of a measuring machine, if measured points are its centres.
#[derive(Debug, Args)]
pub(crate) struct BallArgs {
    /// Radius of the ball, if the points are its centres; half of --ball-diameter [default: 0, points on the profile]
    #[arg(long = "ball", value_name = "RADIUS", value_parser = cutter_radius, allow_hyphen_values = true)]
    ball_radius: Option<f64>,

    /// Diameter of that ball, in the place of its radius
    #[arg(long, value_name = "DIAMETER", conflicts_with = "ball_radius", value_parser = cutter_diameter, allow_hyphen_values = true)]
    ball_diameter: Option<f64>,
}

impl BallArgs {
    /// Its radius, m.
    pub(in crate::cli) fn radius(&self) -> Option<f64> {
        self.ball_radius.or(self.ball_diameter)
    }
}

#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    /// The measured points: a table of x and y, or of angle and radius, in millimetres and degrees, of lines of text
    #[arg(value_name = "MEASURED", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) measured: PathBuf,

    /// The path of a file with [motion] and a follower, or an embedded one
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    #[command(flatten)]
    pub(in crate::cli) ball: BallArgs,

    /// What is fitted before deviations are measured: angle (about the shaft), centre (angle and centre) or none
    #[arg(long, value_name = "WHAT", default_value = "angle", ignore_case = true, value_parser = word::<ComparisonFit>())]
    pub(in crate::cli) fit: ComparisonFit,

    /// Which flank of a body with several: inner or outer
    #[arg(long, value_name = "FLANK")]
    pub(in crate::cli) flank: Option<String>,

    /// Speed of the cam, rpm [default: that of the file]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Option<f64>,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

#[derive(Debug, Args)]
pub(crate) struct ImportArgs {
    /// A lift table, measured points (x and y, or angle and radius) as lines of text, or the outline of a cam as DXF or STEP
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) file: PathBuf,

    /// What FILE is, where it is not seen: table, outline or points
    #[arg(long, value_name = "WHAT", ignore_case = true)]
    pub(in crate::cli) from: Option<ImportForm>,

    /// Second numbers of FILE: lift, or radii of the profile or of the pitch curve (path of the roller's centre)
    /// [default: by its headings]
    #[arg(long = "as", value_name = "WHAT", ignore_case = true)]
    pub(in crate::cli) taken_as: Option<ImportAs>,

    /// Curve of the points: profile or centre (of the roller) [default: by their headings; profile for x and y]
    #[arg(long, value_name = "CURVE", ignore_case = true, value_parser = word::<PointsOf>())]
    pub(in crate::cli) points_of: Option<PointsOf>,

    /// The follower that ran on the cam, or that of the design, with the keys of its table: roller,diameter=24mm,offset=3mm; knife; flat;
    /// swinging-roller,diameter=32mm,arm=110mm,pivot_distance=140mm,side=trailing; swinging-flat,pivot_distance=150mm,face_offset=8mm
    /// [default: a roller of 30 mm for a table; needed for an outline and points]
    #[arg(long, value_name = "KIND,KEY=VALUE,…", value_delimiter = ',')]
    pub(in crate::cli) follower: Vec<String>,

    /// The only laws that may be recognised; with spline among them what none of them follows becomes a spline [default: all, and spline]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = law_or_spline)]
    pub(in crate::cli) law: Vec<LawOrSpline>,

    /// Largest deviation of the design from any row, point or place of the outline, e.g. 3um; an angle for a follower that swings is possible
    /// [default: 0.7 of the rounding of a table, five times the noise of points, 10um of an outline]
    #[arg(long, value_name = "DEVIATION", value_parser = lift, allow_hyphen_values = true)]
    pub(in crate::cli) deviation: Option<LengthOrAngle>,

    #[command(flatten)]
    pub(in crate::cli) ball: BallArgs,

    /// What is found of the position of the cam: angle (the first rise then begins at 0 deg), centre (angle and centre, from the dwells) or none
    /// [default: angle for points, none for a table and an outline]
    #[arg(long, value_name = "WHAT", ignore_case = true, value_parser = word::<ImportFit>())]
    pub(in crate::cli) fit: Option<ImportFit>,

    /// Layer of the outline in a DXF file [default: CAM_PROFILE; without that layer the only closed contour]
    #[arg(long, value_name = "NAME")]
    pub(in crate::cli) layer: Option<String>,

    #[command(flatten)]
    pub(in crate::cli) table: LiftTableArgs,

    /// Speed of the cam for the design, rpm [default: none]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Option<f64>,

    /// Set one key of the design, of the cam, its limits and everything but the motion, e.g. --set cam.thickness=20mm; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub(in crate::cli) set: Vec<String>,

    /// Formats to write: toml (the design file), csv (the imported positions and the design), svg (both and their residuals), json, html, pdf
    /// [default: toml,csv,svg]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = format)]
    pub(in crate::cli) format: Option<Vec<String>>,

    #[command(flatten)]
    pub(in crate::cli) to: OutputArgs,

    #[command(flatten)]
    pub(in crate::cli) report: ReportArgs,
}

/// What a file to import is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum ImportForm {
    Table,
    Outline,
    Points,
}

/// Meaning of the second numbers of a file to import.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum ImportAs {
    Lift,
    Profile,
    Pitch,
}

/// How a lift table is read, as the keys of the same names in [motion] say.
#[derive(Debug, Args)]
pub(in crate::cli) struct LiftTableArgs {
    /// Of a table: the columns of angle and position, by heading or by number from 1; one column with --step
    #[arg(long, value_name = "ANGLE,POSITION", value_delimiter = ',')]
    pub(in crate::cli) columns: Vec<String>,

    /// Of a table: the unit of its positions, or of its angles where it is an angle (rad), or both ("rad, in") [default: deg and mm, or as its headings say]
    #[arg(long, value_name = "UNIT")]
    pub(in crate::cli) unit: Option<String>,

    /// Of a table: a factor of its positions
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub(in crate::cli) scale: Option<String>,

    /// Of a table: turns of the shaft whose angles it has for each turn of the cam; 2 for crank degrees of a four-stroke engine
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    pub(in crate::cli) ratio: Option<String>,

    /// Of a list of positions: angle from row to row
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    pub(in crate::cli) step: Option<String>,

    /// Of a table: its positions are shares of this, from 0 to 1, or percent by their heading
    #[arg(long, value_name = "LIFT", allow_hyphen_values = true)]
    pub(in crate::cli) lift: Option<String>,

    /// Of a table: its angles are shares of this, from 0 to 1
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    pub(in crate::cli) over: Option<String>,

    /// Of a table: it is one half of a lobe, which is mirrored at its highest end
    #[arg(long)]
    pub(in crate::cli) mirror: bool,

    /// Of a table: what the follower does where the turn has no rows: dwell
    #[arg(long, value_name = "WHAT")]
    pub(in crate::cli) rest: Option<String>,

    /// Of a table: number of equal lobes, of which it has one
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub(in crate::cli) repeat: Option<String>,
}

#[derive(Debug, Args)]
pub(crate) struct LawsArgs {
    /// The path of a file with [motion] and a follower, or an embedded one; without it only the laws themselves are listed
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

    /// The laws to compare, in any order [default: all]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = law)]
    pub(in crate::cli) laws: Vec<&'static Law>,

    /// What is chosen with the base radius for each law: offset or pivot_distance, in the place of what the file gives
    #[arg(long, value_name = "LIST", value_delimiter = ',', ignore_case = true, value_parser = word::<FreeDimension>())]
    pub(in crate::cli) free: Vec<FreeDimension>,

    /// Column to sort by, the smallest value first; the start of its name is enough [default: ca, the peak acceleration, with
    /// the laws whose acceleration jumps last]
    #[arg(long, value_name = "COLUMN")]
    pub(in crate::cli) sort: Option<String>,

    /// Print the table as CSV instead of the report; with --svg as well, both are only written as files
    #[arg(long, conflicts_with = "json")]
    pub(in crate::cli) csv: bool,

    /// Print the picture as SVG instead of the report
    #[arg(long, conflicts_with = "json")]
    pub(in crate::cli) svg: bool,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

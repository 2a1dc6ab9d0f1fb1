//! Flags of the commands that write files.

use super::parse::{bare_cutter, cutter_diameter, cutter_radius, dxf_version, format, samples, start, stem, word};
use camgen::body::PointCurve;
use camgen::geometry::points::{PointCoordinates, PointInterpolation, PointStep};
use camgen::machine::Controller;
use camgen::profile::outline::{SegmentKind, Side};
use camgen::tool_files::dxf::Version;
use camgen::units::LengthUnit;
use clap::{Args, ValueHint};
use std::path::PathBuf;

/// The cutter of a disc cam.
#[derive(Debug, Args)]
pub(in crate::cli) struct CutterArgs {
    /// Also write the path of the centre of a cutter of this diameter, as STEM-cutter.dxf: 8mm for an Ø8 mm end mill
    #[arg(long, value_name = "DIAMETER", value_parser = cutter_diameter)]
    pub(in crate::cli) cutter_diameter: Option<f64>,

    /// The radius of the cutter in place of its diameter: 4mm for an Ø8 mm end mill
    #[arg(long, value_name = "RADIUS", value_parser = cutter_radius, conflicts_with = "cutter_diameter")]
    pub(in crate::cli) cutter_radius: Option<f64>,

    /// Refused: it does not say whether it is a diameter or a radius.
    #[arg(long, hide = true, value_name = "LENGTH", num_args = 0..=1, default_missing_value = "", value_parser = bare_cutter)]
    pub(in crate::cli) cutter: Option<f64>,
}

/// Where files are written, and what they may replace.
#[derive(Debug, Args)]
pub(in crate::cli) struct OutputArgs {
    /// Directory for the files, created when missing
    #[arg(long, value_name = "DIR", default_value = "output", value_hint = ValueHint::DirPath)]
    pub(in crate::cli) out: PathBuf,

    /// File stem [default: MACHINE-COMMAND-RPMrpm]
    #[arg(long, value_name = "STEM", value_parser = stem)]
    pub(in crate::cli) name: Option<String>,

    /// Unit of the lengths in files and reports: mm or inch. STEP files stay in mm, which they state, and JSON reports, whose names have their units
    /// [default: output.units, mm]
    #[arg(long, value_name = "UNIT", ignore_case = true, value_parser = word::<LengthUnit>())]
    pub(in crate::cli) units: Option<LengthUnit>,

    /// Template of the SVG sheets instead of the built-in one, templates/sheet.svg
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) template: Option<PathBuf>,

    /// Write the files although a check failed (the exit code stays 1)
    #[arg(long)]
    pub(in crate::cli) force: bool,

    /// Also replace files that were edited or not written by camgen; unchanged files of camgen are always replaced
    #[arg(long)]
    pub(in crate::cli) overwrite: bool,
}

/// How an outline is drawn and its DXF file is written.
#[derive(Debug, Args)]
pub(in crate::cli) struct OutlineArgs {
    /// Version of the DXF file: r12, r2000, r2010 or r2013
    #[arg(long, value_name = "VERSION", default_value = "r2000", value_parser = dxf_version)]
    pub(in crate::cli) dxf_version: Version,

    /// Side of the exact curve on which the outline stays: both, inside (never too much metal) or outside (never too little metal)
    #[arg(long, value_name = "SIDE", default_value = "both", ignore_case = true, value_parser = word::<Side>())]
    pub(in crate::cli) side: Side,

    /// How curved parts of the outline are drawn: arcs, which every control reads, or spline (cubic SPLINEs without steps of curvature)
    #[arg(long, value_name = "KIND", default_value = "arcs", ignore_case = true, value_parser = word::<SegmentKind>())]
    pub(in crate::cli) outline: SegmentKind,

    /// Cam angle at which the outline starts [default: the middle of the longest dwell at the lowest lift, or where the outline is flattest]
    #[arg(long, value_name = "ANGLE", value_parser = start, allow_hyphen_values = true)]
    pub(in crate::cli) start: Option<f64>,

    /// Also draw the path of the tool to the start, on layer `LEAD_IN`: a straight line, tangent LENGTH, or a quarter of a circle, arc RADIUS
    /// [default of the size: 5mm]
    #[arg(long, num_args = 1..=2, value_names = ["FORM", "SIZE"])]
    pub(in crate::cli) lead_in: Option<Vec<String>>,
}

/// What is written, where, and how.
#[derive(Debug, Args)]
pub(in crate::cli) struct FileArgs {
    /// Formats to write: dxf, svg, step, csv, json, html (the moving report), pdf (drawing, review sheet and motion diagram), diagram (the motion diagram as SVG), points, gcode (a program for a milling machine), servo-csv, servo-xyva (CODESYS), servo-twincat and servo-isg (tables for a servo drive), inspect (places for a measuring machine), gauge (the lift of a gauge follower), and stl for a conoid
    /// [default: dxf,svg,step,csv]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = format)]
    pub(in crate::cli) format: Option<Vec<String>>,

    /// Rows of the CSV table over one turn of the cam, or steps of x over the stroke of a plate [default: 720]
    #[arg(long, value_name = "N", value_parser = samples)]
    pub(in crate::cli) samples: Option<u32>,

    /// With --format html: the report has the library in it as WebAssembly, so that the design can be changed in the page
    #[arg(long)]
    pub(in crate::cli) live: bool,

    #[command(flatten)]
    pub(in crate::cli) outline: OutlineArgs,

    #[command(flatten)]
    pub(in crate::cli) to: OutputArgs,

    #[command(flatten)]
    pub(in crate::cli) points: PointsArgs,

    /// Control of the program of --format gcode: linuxcnc, fanuc, sinumerik, heidenhain, grbl or mach3 [default: cut.controller, linuxcnc]
    #[arg(long, value_name = "CONTROL", ignore_case = true, value_parser = word::<Controller>())]
    pub(in crate::cli) controller: Option<Controller>,

    /// Diameter of the ball of the probe whose centres --format inspect gives, and of the usual --gauge [default: 3mm]
    #[arg(long, value_name = "DIAMETER", value_parser = cutter_diameter)]
    pub(in crate::cli) ball_diameter: Option<f64>,

    /// Follower of --format gauge: ball DIAMETER, roller DIAMETER, or flat [default: ball of --ball-diameter]
    #[arg(long, num_args = 1..=2, value_names = ["FORM", "DIAMETER"])]
    pub(in crate::cli) gauge: Option<Vec<String>>,
}

/// The table of --format points, STEM-points.csv: as many points as needed to keep --tolerance between them.
#[derive(Debug, Args)]
pub(in crate::cli) struct PointsArgs {
    /// Curve of --format points: profile, centre (of the roller), or cutter (the centre of the cutter or wheel of --cutter-diameter)
    /// [default: profile]
    #[arg(long, value_name = "CURVE", help_heading = "Points", ignore_case = true, value_parser = word::<PointCurve>())]
    pub(in crate::cli) points_of: Option<PointCurve>,

    /// Coordinates of the points: polar (angle about the shaft, radius) or xy [default: polar; xy of a plate]
    #[arg(long, value_name = "FORM", help_heading = "Points", ignore_case = true, value_parser = word::<PointCoordinates>())]
    pub(in crate::cli) points_as: Option<PointCoordinates>,

    /// Spacing of the points: angle (equal angles about the shaft) or chord (equal error in every interval, fewer points) [default: angle;
    /// chord on a plate]
    #[arg(long, value_name = "STEP", help_heading = "Points", ignore_case = true, value_parser = word::<PointStep>())]
    pub(in crate::cli) points_step: Option<PointStep>,

    /// How the control interpolates between two points: linear (polar: the radius linear in the angle; xy: a straight line) or
    /// cubic (the cubic spline of the radius over the angle, or of x and y over the sum of the chords) [default: linear]
    #[arg(long, value_name = "INTERPOLATION", help_heading = "Points", ignore_case = true, value_parser = word::<PointInterpolation>())]
    pub(in crate::cli) points_between: Option<PointInterpolation>,
}

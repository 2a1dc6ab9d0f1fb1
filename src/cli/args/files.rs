//! Flags of the commands that write files.

use super::parse::{cutter, dxf_version, format, samples, stem};
use camgen::write::dxf::Version;
use clap::{Args, ValueEnum, ValueHint};
use std::path::PathBuf;

/// The cutter of a disc cam.
#[derive(Debug, Args)]
pub(in crate::cli) struct CutterArgs {
    /// Also writes the path of the centre of a cutter of this radius, as STEM-cutter.dxf
    #[arg(long, value_name = "RADIUS", value_parser = cutter)]
    pub(in crate::cli) cutter: Option<f64>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum SideOf {
    Both,
    Inside,
    Outside,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum LaidOf {
    Arcs,
    Spline,
}

/// Where files are written, and over what.
#[derive(Debug, Args)]
pub(in crate::cli) struct OutArgs {
    /// Directory for the files, created when missing
    #[arg(long, value_name = "DIR", default_value = "output", value_hint = ValueHint::DirPath)]
    pub(in crate::cli) out: PathBuf,

    /// File stem [default: MACHINE-COMMAND-RPMrpm]
    #[arg(long, value_name = "STEM", value_parser = stem)]
    pub(in crate::cli) name: Option<String>,

    /// Template of the SVG review sheet instead of the built-in one, templates/sheet.svg
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) template: Option<PathBuf>,

    /// Write the files although a check failed (the exit code stays 1)
    #[arg(long)]
    pub(in crate::cli) force: bool,

    /// Replace files that were edited, or not written by camgen; its own are replaced without
    #[arg(long)]
    pub(in crate::cli) overwrite: bool,
}

/// How an outline is drawn and its DXF file is written.
#[derive(Debug, Args)]
pub(in crate::cli) struct LaidArgs {
    /// Version of the DXF file: r12, r2000, r2010 or r2013
    #[arg(long, value_name = "VERSION", default_value = "r2000", value_parser = dxf_version)]
    pub(in crate::cli) dxf_version: Version,

    /// Side of the exact curve the outline keeps to: both, inside (never metal in the way) or outside (never cut too deep)
    #[arg(long, value_name = "SIDE", default_value = "both", ignore_case = true)]
    pub(in crate::cli) side: SideOf,

    /// What the curved parts of the outline are: arcs, which every control reads, or spline: cubic SPLINEs without steps of curvature
    #[arg(long, value_name = "KIND", default_value = "arcs", ignore_case = true)]
    pub(in crate::cli) outline: LaidOf,
}

/// What is written, where, and how.
#[derive(Debug, Args)]
pub(in crate::cli) struct FileArgs {
    /// What to write: dxf, svg, step, csv, json, html (the moving report), pdf (the review sheet), points, and stl of a conoid
    /// [default: dxf,svg,step,csv]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = format)]
    pub(in crate::cli) format: Option<Vec<String>>,

    /// Rows of the CSV table over one turn of the cam, or steps of x over the stroke of a plate
    #[arg(long, value_name = "N", default_value = "720", value_parser = samples)]
    pub(in crate::cli) samples: u32,

    #[command(flatten)]
    pub(in crate::cli) laid: LaidArgs,

    #[command(flatten)]
    pub(in crate::cli) to: OutArgs,

    #[command(flatten)]
    pub(in crate::cli) points: PointsArgs,
}

/// The table of --format points, STEM-points.csv: as many points as it takes to keep --tolerance between them.
#[derive(Debug, Args)]
pub(in crate::cli) struct PointsArgs {
    /// Curve of --format points: profile, centre (of the roller), or cutter (the centre of the cutter or wheel of --cutter)
    /// [default: profile]
    #[arg(long, value_name = "CURVE", help_heading = "Points", ignore_case = true)]
    pub(in crate::cli) points_of: Option<PointsOf>,

    /// Its coordinates: polar (angle about the shaft, radius) or xy [default: polar; xy of a plate]
    #[arg(long, value_name = "FORM", help_heading = "Points", ignore_case = true)]
    pub(in crate::cli) points_as: Option<PointsAs>,

    /// Its places: angle (equal angles about the shaft) or chord (the same error in every interval, fewer points) [default: angle;
    /// chord on a plate]
    #[arg(long, value_name = "STEP", help_heading = "Points", ignore_case = true)]
    pub(in crate::cli) points_step: Option<PointsStep>,

    /// How the control interpolates between two points: linear (polar: the radius linear in the angle; xy: a straight line) or
    /// cubic (the cubic spline of the radius over the angle, or of x and y over the sum of the chords) [default: linear]
    #[arg(long, value_name = "WAY", help_heading = "Points", ignore_case = true)]
    pub(in crate::cli) points_between: Option<PointsBetween>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum PointsOf {
    Profile,
    Centre,
    Cutter,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum PointsAs {
    Polar,
    Xy,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum PointsStep {
    Angle,
    Chord,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum PointsBetween {
    Linear,
    Cubic,
}

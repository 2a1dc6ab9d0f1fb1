//! What the user typed of `camgen side-by-side`.

use super::parse::{rpm, stem, tolerance};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct SideBySideArgs {
    /// First design: a machine (embedded or a file), whose disc cam is shown, or the file of a motion program
    #[arg(value_name = "A")]
    pub(in crate::cli) first: String,

    /// Second design
    #[arg(value_name = "B")]
    pub(in crate::cli) second: String,

    /// Speed of both: of the main shaft of a press, of the cam of a motion program, rpm [default: that of each file]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Option<f64>,

    /// Largest distance of the outlines from the exact curves [default: 5um]
    #[arg(long, value_name = "LENGTH", value_parser = tolerance, allow_hyphen_values = true)]
    pub(in crate::cli) tolerance: Option<f64>,

    /// Override one key of both files; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub(in crate::cli) set: Vec<String>,

    /// Directory for the file, created when missing
    #[arg(long, value_name = "DIR", default_value = "output")]
    pub(in crate::cli) out: PathBuf,

    /// File stem [default: A-B-side-by-side]
    #[arg(long, value_name = "STEM", value_parser = stem)]
    pub(in crate::cli) name: Option<String>,

    /// Also replace a file that was edited or not written by camgen; an unchanged file of camgen is always replaced
    #[arg(long)]
    pub(in crate::cli) overwrite: bool,

    /// Print both reports as JSON, a list of two, and nothing else
    #[arg(long)]
    pub(in crate::cli) json: bool,

    /// Print both whole reports
    #[arg(long, short)]
    pub(in crate::cli) verbose: bool,

    /// Print nothing
    #[arg(long, short)]
    pub(in crate::cli) quiet: bool,
}

//! What the user typed of `camgen serve`.

use super::parse::{rpm, tolerance};
use clap::{Args, ValueHint};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct ServeArgs {
    /// Machine files, or names of embedded ones, each in a tab of its own [default: a page with all embedded designs]
    #[arg(value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) files: Vec<String>,

    /// Speed the cam is cut for, rpm [default: that of the file]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    pub(in crate::cli) rpm: Option<f64>,

    /// Largest distance of the outlines from the exact curves [default: 5um]
    #[arg(long, value_name = "LENGTH", value_parser = tolerance, allow_hyphen_values = true)]
    pub(in crate::cli) tolerance: Option<f64>,

    /// Directory for the files that the page writes, created when missing
    #[arg(long, value_name = "DIR", default_value = "output", value_hint = ValueHint::DirPath)]
    pub(in crate::cli) out: PathBuf,

    /// Port on this computer's own address, 127.0.0.1 [default: a free one]
    #[arg(long, value_name = "PORT", default_value = "0", hide_default_value = true)]
    pub(in crate::cli) port: u16,

    /// End by itself after so many seconds [default: at Ctrl+C]
    #[arg(long = "for", value_name = "SECONDS")]
    pub(in crate::cli) seconds: Option<u64>,

    /// Also replace files that were edited or not written by camgen; unchanged files of camgen are always replaced
    #[arg(long)]
    pub(in crate::cli) overwrite: bool,
}

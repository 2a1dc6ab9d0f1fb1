//! What the user typed of `camgen study`.

use super::parse::stem;
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(in crate::cli) struct StudyArgs {
    /// An embedded study (feeder-roller, feeder-as-made, feeder-scatter, lever-pareto) or the path of a study file
    #[arg(value_name = "STUDY")]
    pub(in crate::cli) study: String,

    /// Print the text of an embedded study, as a file to start from
    #[arg(long)]
    pub(in crate::cli) show: bool,

    /// Directory for the files, created when missing
    #[arg(long, value_name = "DIR", default_value = "output")]
    pub(in crate::cli) out: PathBuf,

    /// File stem [default: that of the study file]
    #[arg(long, value_name = "STEM", value_parser = stem)]
    pub(in crate::cli) name: Option<String>,

    /// Also write a page with histograms, the scatter of each figure against each and the front
    #[arg(long)]
    pub(in crate::cli) page: bool,

    /// Also write the table as Parquet; needs a program built with `--features parquet`
    #[arg(long)]
    pub(in crate::cli) parquet: bool,

    /// Also replace a table that was changed or not written by camgen; an unchanged table of camgen is always replaced
    #[arg(long)]
    pub(in crate::cli) overwrite: bool,

    /// Begin anew in the place of an interrupted run, which is else continued
    #[arg(long)]
    pub(in crate::cli) restart: bool,

    /// Say how many designs there are and what they need, and make none
    #[arg(long)]
    pub(in crate::cli) dry_run: bool,

    /// Print the summary as JSON and nothing else
    #[arg(long)]
    pub(in crate::cli) json: bool,

    /// Print nothing
    #[arg(long, short)]
    pub(in crate::cli) quiet: bool,
}

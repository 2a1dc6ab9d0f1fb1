//! What the user typed of `camgen brake`.

use super::parse::word;
use super::{AccuracyArgs, AnalysisArgs, OutlineArgs};
use camgen::domains::brake::analysis::FrameGoal;
use clap::{Args, ValueHint};

#[derive(Debug, Args)]
pub(crate) struct BrakeArgs {
    /// An embedded machine or the path of a machine file with the table [brake]
    #[arg(default_value = "roll", value_hint = ValueHint::FilePath)]
    pub(in crate::cli) machine: String,

    /// Also make the disc of [brake.cam] that holds the tension over the whole roll; its files are STEM-cam.*
    #[arg(long)]
    pub(in crate::cli) cam: bool,

    /// Design the frame for the roll, the friction and the pulleys of the file and print it as a table to paste: level (smallest change of
    /// the tension over the roll) or robust (over the roll and ± 20 % of friction together) [without a value: level]
    #[arg(long, value_name = "GOAL", ignore_case = true, num_args = 0..=1, require_equals = true, default_missing_value = "level", conflicts_with = "cam", value_parser = word::<FrameGoal>())]
    pub(in crate::cli) synthesize: Option<FrameGoal>,

    /// Seed of the random numbers of --synthesize
    #[arg(long, value_name = "N", default_value_t = 1, requires = "synthesize")]
    pub(in crate::cli) seed: u64,

    /// Equal steps of the roll's radius in the table
    #[arg(long, value_name = "N", default_value_t = 110, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(in crate::cli) samples: u32,

    #[command(flatten)]
    pub(in crate::cli) accuracy: AccuracyArgs,

    #[command(flatten)]
    pub(in crate::cli) outline: OutlineArgs,

    #[command(flatten)]
    pub(in crate::cli) analysis: AnalysisArgs,
}

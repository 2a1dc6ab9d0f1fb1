//! `camgen side-by-side`: two disc cams in one HTML report, moved by one cursor, with their differences marked.

use super::args::{rpm, stem, tolerance};
use super::put::put;
use super::text::{self, Page};
use super::{Failure, Outcome, print, tell};
use camgen::body::{RateTolerance, Request};
use camgen::document::Input;
use camgen::machine::Machine;
use camgen::pipeline::{Cam, Output, Proven, Spec};
use camgen::report::Report;
use camgen::write::record::{Run, refuse_kept, stage_recorded};
use camgen::write::{html, json, svg};
use clap::Args;
use std::path::PathBuf;

/// Tolerance of the outlines by default, m, and of the acceleration as cut, as for the commands that make a cam.
const TOLERANCE: f64 = 5e-6;
const ACCELERATION: f64 = 0.05;
/// Rows of the tables: every half degree.
const SAMPLES: u32 = 720;

#[derive(Debug, Args)]
pub(super) struct SideBySideArgs {
    /// Machine (an embedded one or a file), of which the disc cam is taken, or file of a motion program
    #[arg(value_name = "A")]
    first: String,

    /// The other
    #[arg(value_name = "B")]
    second: String,

    /// Speed of both: of the main shaft of a press, of the cam of a motion program, rpm [default: that of each file]
    #[arg(long, value_name = "N", value_parser = rpm, allow_hyphen_values = true)]
    rpm: Option<f64>,

    /// Largest distance of the outlines from the exact curves [default: 5um]
    #[arg(long, value_name = "LENGTH", value_parser = tolerance, allow_hyphen_values = true)]
    tolerance: Option<f64>,

    /// Overrides one key of both files; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,

    /// Directory for the file, created when missing
    #[arg(long, value_name = "DIR", default_value = "output")]
    out: PathBuf,

    /// File stem [default: A-B-side-by-side]
    #[arg(long, value_name = "STEM", value_parser = stem)]
    name: Option<String>,

    /// Replace a file that was edited, or not written by camgen; its own are replaced without
    #[arg(long)]
    overwrite: bool,

    /// Print both reports as JSON, a list of two, and nothing else
    #[arg(long)]
    json: bool,

    /// Print nothing
    #[arg(long, short)]
    quiet: bool,
}

/// Solves, draws and proves both, and writes the page also where a check failed: it is a report, and says so.
pub(super) fn run(args: &SideBySideArgs) -> Result<Outcome, Failure> {
    let ((a, first), (b, second)) = (args.solved(&args.first)?, args.solved(&args.second)?);
    let stem = args.name.clone().unwrap_or_else(|| format!("{first}-{second}-side-by-side"));
    let name = format!("{stem}.html");
    if !args.overwrite {
        refuse_kept(&args.out, &[Output { name: name.clone(), bytes: Vec::new() }]).map_err(Failure::new)?;
    }
    let (a, b) = (args.proven(&a)?, args.proven(&b)?);
    let [mut one, mut two] = [&a, &b].map(|proven| Box::new(proven.report()));
    if let Some(why) = a.no_outline().or(b.no_outline()) {
        tell(&format!("refused: {why}; there is no outline to show"));
        args.show(&[&one, &two])?;
        return Ok(Outcome::CheckFailed);
    }
    for report in [&mut one, &mut two] {
        report.files = vec![args.out.join(&name).display().to_string()];
    }
    let page = {
        let shown = a.rendering(&one, SAMPLES, svg::TEMPLATE).map_err(Failure::new)?;
        let beside = b.rendering(&two, SAMPLES, svg::TEMPLATE).map_err(Failure::new)?;
        html::side_by_side(&shown, &beside).map_err(Failure::new)?
    };
    let inputs = [("first", &one), ("second", &two)]
        .map(|(side, report)| Input::word(side, format!("{}, {}", report.machine, report.inputs_hash())));
    let run = Run { stem: &stem, inputs: &inputs, overwrite: args.overwrite };
    let outputs = vec![Output { name, bytes: page }];
    let stage =
        |place| stage_recorded(place, outputs, &run).map(|(staged, notes)| (notes, staged)).map_err(Failure::new);
    put(&args.out, stage, |_| args.show(&[&one, &two]))?;
    Ok(if a.passed() && b.passed() { Outcome::Fine } else { Outcome::CheckFailed })
}

impl SideBySideArgs {
    /// The disc cam of a file, and the word that names its files.
    fn solved(&self, name: &str) -> Result<(Cam, String), Failure> {
        let (machine, stem) = Machine::load(name, &self.set).map_err(Failure::new)?;
        let spec = match (machine.press().map(|press| press.design_rpm), machine.motion()) {
            (Err(_), Some(_)) => Spec::of_program(machine, self.rpm),
            (design, _) => {
                let rpm = self.rpm.map_or(design, Ok).map_err(Failure::new)?;
                Some(Spec::rotary(machine, rpm).alone())
            }
        };
        let spec = spec.ok_or_else(|| Failure(format!("{name} has neither a press nor a motion")))?;
        Ok((spec.solve().map_err(|error| Failure(format!("{name}: {error}")))?, stem))
    }

    fn proven<'c>(&self, cam: &'c Cam) -> Result<Proven<'c>, Failure> {
        let rates = [None, Some(RateTolerance::Share(ACCELERATION))];
        let request = Request { rates, strict: [false; 2], ..Request::within(self.tolerance.unwrap_or(TOLERANCE)) };
        cam.draw(request).and_then(camgen::pipeline::Drawing::prove).map_err(Failure::new)
    }

    fn show(&self, reports: &[&Report]) -> Result<(), Failure> {
        if self.json {
            let bytes = json::write(&reports).map_err(Failure::new)?;
            return print(&String::from_utf8_lossy(&bytes));
        }
        if self.quiet {
            return Ok(());
        }
        reports.iter().try_for_each(|report| print(&text::report(report, Page::here())))
    }
}

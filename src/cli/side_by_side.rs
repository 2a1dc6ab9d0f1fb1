//! `camgen side-by-side`: two disc cams in one HTML report with a common cursor and their differences marked.

use super::args::{SideBySideArgs, machine_of_a_cam};
use super::put::put;
use super::text::{self, Beside, Page, Written};
use super::{Failure, Outcome, print, print_message};
use camgen::body::{RateTolerance, Request};
use camgen::document::Input;
use camgen::domains::press::MachineOfPress;
use camgen::domains::press::SpecOfPress;
use camgen::pipeline::{Assembly, AssemblyDrawing, Output, ProvenAssembly, Spec};
use camgen::report::Report;
use camgen::write::record::{WriteInputs, refuse_protected, stage_recorded};
use camgen::write::{html, json, svg};

/// Tolerance of the outlines by default, m, and of the acceleration as cut, as for the commands that make a cam.
const TOLERANCE: f64 = 5e-6;
const ACCELERATION: f64 = 0.05;
/// Rows of the tables: every half degree.
const SAMPLES: u32 = 720;

/// Solves, draws and proves both, and writes the page even where a check failed: it is a report and shows the failure.
pub(super) fn run(args: &SideBySideArgs) -> Result<Outcome, Failure> {
    let ((a, first), (b, second)) = (args.solved(&args.first)?, args.solved(&args.second)?);
    let stem = args.name.clone().unwrap_or_else(|| format!("{first}-{second}-side-by-side"));
    let name = format!("{stem}.html");
    if !args.overwrite {
        refuse_protected(&args.out, &[Output { name: name.clone(), bytes: Vec::new() }]).map_err(Failure::new)?;
    }
    let (a, b) = (args.proven(&a)?, args.proven(&b)?);
    let [mut one, mut two] = [&a, &b].map(|proven| Box::new(proven.report()));
    if let Some(why) = a.no_outline().or(b.no_outline()) {
        print_message(&format!("refused: {why}; there is no outline to show"));
        args.show(&[&one, &two])?;
        return Ok(Outcome::CheckFailed);
    }
    for report in [&mut one, &mut two] {
        report.files = vec![camgen::report::listed_path(&args.out.join(&name))];
    }
    let page = {
        let shown = a.first().rendering(&one, SAMPLES, svg::TEMPLATE).map_err(Failure::new)?;
        let second = b.first().rendering(&two, SAMPLES, svg::TEMPLATE).map_err(Failure::new)?;
        html::side_by_side(&shown, &second).map_err(Failure::new)?
    };
    let inputs = [("first", &one), ("second", &two)]
        .map(|(side, report)| Input::word(side, format!("{}, {}", report.machine, report.inputs_hash())));
    let run = WriteInputs { stem: &stem, machine: "", inputs: &inputs, overwrite: args.overwrite };
    let outputs = vec![Output { name, bytes: page }];
    let stage =
        |place| stage_recorded(place, outputs, &run).map(|(staged, notes)| (notes, staged)).map_err(Failure::new);
    put(&args.out, stage, |_| args.show(&[&one, &two]))?;
    Ok(if a.passed() && b.passed() { Outcome::Fine } else { Outcome::CheckFailed })
}

impl SideBySideArgs {
    /// The disc cam of a file with the cams that belong to it, and the stem of its files.
    fn solved(&self, name: &str) -> Result<(Assembly, String), Failure> {
        let (machine, stem) = machine_of_a_cam(name, &self.set)?;
        let spec = match (machine.press().map(|press| press.design_rpm), machine.motion()) {
            (Err(_), Some(_)) => Spec::of_program(machine, self.rpm),
            (design, _) => {
                let rpm = self.rpm.map_or(design, Ok).map_err(Failure::new)?;
                Some(Spec::rotary(machine, rpm))
            }
        };
        let spec = spec.ok_or_else(|| Failure(format!("{name} has neither a press nor a motion")))?;
        if spec.machine().program().is_some_and(|program| program.stroke().is_some()) {
            return Err(Failure(format!("{name}: side-by-side compares cams that turn, and this one is a plate")));
        }
        Ok((spec.assemble().map_err(|error| Failure(format!("{name}: {error}")))?, stem))
    }

    fn proven(&self, cams: &Assembly) -> Result<ProvenAssembly, Failure> {
        let rates = [None, Some(RateTolerance::Share(ACCELERATION))];
        let request = Request { rates, strict: [false; 2], ..Request::within(self.tolerance.unwrap_or(TOLERANCE)) };
        cams.draw(request).and_then(AssemblyDrawing::prove).map_err(Failure::new)
    }

    fn show(&self, reports: &[&Report]) -> Result<(), Failure> {
        if self.json {
            let bytes = json::write(&reports).map_err(Failure::new)?;
            return print(&String::from_utf8_lossy(&bytes));
        }
        if self.quiet {
            return Ok(());
        }
        let beside = Beside { written: Written::Listed, remedy: None };
        let texts: Vec<String> = if self.verbose {
            reports.iter().map(|report| text::report(report, Page::here())).collect()
        } else {
            reports.iter().map(|report| text::half_summary(report, beside, Page::here())).collect()
        };
        print(&texts.join("\n"))
    }
}

//! `camgen check`: the proof for a DXF file that may have been edited or written by another program.

use super::analyses::of_brake;
use super::args::{CheckArgs, Checked};
use super::cams::{of_conoid, of_program};
use super::progress::Progress;
use super::{Failure, Outcome, print, print_painted, text};
use camgen::body::Request;
use camgen::body::wedge::LAW_TOLERANCE;
use camgen::document::file::bytes_of;
use camgen::machine::{BrakeMachine, Wanted};
use camgen::motion::equation_18::Solver;
use camgen::pipeline::{Error, Spec};
use camgen::reading::LARGEST_FILE;
use camgen::report::Section;
use camgen::write::json;
use std::path::Path;

pub(super) fn run(args: &CheckArgs) -> Result<Outcome, Failure> {
    let spec = spec(args)?;
    let bytes = read(&args.file)?;
    let progress = Progress::of_stages(args.common.told.shows_progress());
    progress.stage("solving");
    let cam = spec.solve().map_err(Failure::new)?;
    progress.stage("rolling on the file");
    let file = args.file.display().to_string();
    let accuracy = &args.common.accuracy;
    let (rates, strict) = accuracy.demanded();
    let request = Request { rates, strict, ..Request::within(accuracy.tolerance()) };
    let checked = match args.section {
        Some(rpm) => cam.check_section(&bytes, rpm, request),
        None => cam.check(&bytes, request),
    };
    let mut report = checked.map_err(|error| match error {
        Error::Read(error) => Failure(format!("`{file}` is {error}")),
        Error::Step(error) => Failure(format!("`{file}` is {error}")),
        Error::Section(why) => Failure(format!("{why} (--section RPM)")),
        other => Failure::new(other),
    })?;
    drop(progress);
    report.sections.insert(0, Section::new("file", &file));
    if args.common.told.json {
        let json = json::write(&report).map_err(Failure::new)?;
        print(&String::from_utf8_lossy(&json))?;
    } else if !args.common.told.quiet {
        print_painted(&text::check_report(&file, &report, args.common.told.page()))?;
    }
    Ok(if report.passed() { Outcome::Fine } else { Outcome::CheckFailed })
}

/// The cam that the file should hold.
fn spec(args: &CheckArgs) -> Result<Spec, Failure> {
    if args.cam == Some(Checked::Brake) {
        let (machine, _) =
            BrakeMachine::load(&args.common.machine, &args.common.set, Wanted::Disc).map_err(Failure::new)?;
        if !args.common.rpm.is_empty() || args.common.end.is_some() {
            return Err(Failure(
                "--rpm and --end belong to the cams of a press: the disc of a brake has no speed".into(),
            ));
        }
        return of_brake(&machine).map(|(spec, _)| spec);
    }
    if let Some(design) = &args.design {
        let (machine, _) = args.common.machine_of(design)?;
        return of_program(&args.common, (machine, design));
    }
    let (machine, _) = args.common.machine()?;
    let of_a_program = machine.press().is_err() && machine.motion().is_some();
    match args.cam.unwrap_or(if of_a_program { Checked::Make } else { Checked::Rotary }) {
        Checked::Make => of_program(&args.common, (machine, &args.common.machine)),
        Checked::Rotary => {
            let rpm = args.common.one_speed(&machine)?;
            Ok(Spec::rotary(machine, rpm).alone())
        }
        Checked::Compensator => {
            let rpm = args.common.one_speed(&machine)?;
            Ok(Spec::compensator(machine, rpm))
        }
        Checked::Translating => {
            let (rpm, solver) = (args.common.one_speed(&machine)?, Solver::Ode { tolerance: LAW_TOLERANCE });
            Ok(Spec::translating(machine, rpm, solver, args.balance.exact_on()))
        }
        Checked::Conoid => of_conoid(&args.common, machine, args.residual),
        Checked::Brake => Err(Failure("the disc of a brake is read from a file with [brake]".into())),
    }
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    bytes_of(path, LARGEST_FILE).map_err(|why| Failure(format!("cannot read `{}`: {why}", path.display())))
}

//! `camgen check`: the proof for a DXF file that may have been edited or written by another program.

use super::args::{CheckArgs, Checked};
use super::cams::{of_conoid, of_program};
use super::progress::Progress;
use super::{Failure, Outcome, print, text};
use camgen::body::wedge::LAW_TOLERANCE;
use camgen::motion::equation_18::Solver;
use camgen::pipeline::{Error, Spec};
use camgen::report::Section;
use camgen::write::json;
use std::io::Read;
use std::path::Path;

/// Largest DXF file that is read, bytes: far more than any cut file needs.
const LARGEST_FILE: u64 = 1 << 28;

pub(super) fn run(args: &CheckArgs) -> Result<Outcome, Failure> {
    let (machine, _) = args.common.machine()?;
    let bytes = read(&args.file)?;
    let of_a_program = machine.press().is_err() && machine.motion().is_some();
    let spec = match args.cam.unwrap_or(if of_a_program { Checked::Make } else { Checked::Rotary }) {
        Checked::Make => of_program(&args.common, machine)?,
        Checked::Rotary => {
            let rpm = args.common.one_speed(&machine)?;
            Spec::rotary(machine, rpm).alone()
        }
        Checked::Compensator => {
            let rpm = args.common.one_speed(&machine)?;
            Spec::compensator(machine, rpm)
        }
        Checked::Translating => {
            let (rpm, solver) = (args.common.one_speed(&machine)?, Solver::Ode { tolerance: LAW_TOLERANCE });
            Spec::translating(machine, rpm, solver, args.balance.exact_on())
        }
        Checked::Conoid => of_conoid(&args.common, machine, args.residual)?,
    };
    let progress = Progress::of_stages(args.common.told.shows_progress());
    progress.stage("solving");
    let cam = spec.solve().map_err(Failure::new)?;
    progress.stage("rolling on the file");
    let file = args.file.display().to_string();
    let tolerance = args.common.tolerance();
    let checked = match args.section {
        Some(rpm) => cam.check_section(&bytes, rpm, tolerance),
        None => cam.check(&bytes, tolerance),
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
        print(&text::check_report(&file, &report, args.common.told.page()))?;
    }
    Ok(if report.passed() { Outcome::Fine } else { Outcome::CheckFailed })
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    let cannot = |why: String| Failure(format!("cannot read `{}`: {why}", path.display()));
    if path.is_dir() {
        return Err(cannot("it is a directory".into()));
    }
    let file = std::fs::File::open(path).map_err(|error| cannot(error.to_string()))?;
    let mut bytes = Vec::new();
    file.take(LARGEST_FILE + 1).read_to_end(&mut bytes).map_err(|error| cannot(error.to_string()))?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(cannot(format!("it is larger than {LARGEST_FILE} bytes")));
    }
    Ok(bytes)
}

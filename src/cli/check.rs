//! `camgen check`: the proof for a DXF file that somebody else may have had in hand.

use super::args::{CamKind, CheckArgs};
use super::{Failure, Outcome, print, text};
use camgen::cam::Cam;
use camgen::cam::plate::{LAW_TOLERANCE, Plate};
use camgen::cam::rotary::Rotary;
use camgen::checks::rolling::Rolled;
use camgen::checks::{self, Finding, file};
use camgen::law::translating::Solver;
use camgen::reading;
use serde::Serialize;
use std::io::Read;
use std::path::Path;

/// Largest DXF file that is read, bytes: ten million lines of a cut file are not one.
const LARGEST_FILE: u64 = 1 << 28;

/// The report of a checked file.
#[derive(Debug, Serialize)]
pub(super) struct CheckReport {
    schema: u32,
    command: &'static str,
    pub(super) file: String,
    pub(super) machine: String,
    pub(super) cam: &'static str,
    pub(super) rpm: f64,
    pub(super) checks: Vec<Finding>,
    rolling: Option<Rolled>,
}

pub(super) fn run(args: &CheckArgs) -> Result<Outcome, Failure> {
    let (machine, _) = args.common.machine()?;
    let rpm = args.common.one_speed(&machine)?;
    let bytes = read(&args.file)?;
    let tolerance_mm = 1e3 * args.common.tolerance();
    let reading = reading::read(&bytes, file::join_reach(tolerance_mm))
        .map_err(|error| Failure(format!("`{}` is {error}", args.file.display())))?;
    let cam: Box<dyn Cam> = match args.cam {
        CamKind::Rotary => Box::new(Rotary::solve(&machine, rpm).map_err(Failure::new)?),
        CamKind::Translating => {
            let solver = Solver::Ode { tolerance: LAW_TOLERANCE };
            Box::new(Plate::solve(&machine, rpm, solver, args.balance.exact()).map_err(Failure::new)?)
        }
    };
    let (checks, rolling) = file::check(&*cam, &reading, tolerance_mm);
    let passed = checks::passed(&checks);
    let report = CheckReport {
        schema: 1,
        command: "check",
        file: args.file.display().to_string(),
        machine: machine.name,
        cam: cam.kind(),
        rpm,
        checks,
        rolling,
    };
    if args.common.json {
        let json = serde_json::to_string_pretty(&report).map_err(Failure::new)?;
        print(&format!("{json}\n"))?;
    } else if !args.common.quiet {
        print(&text::check_report(&report, passed, args.common.colour()))?;
    }
    Ok(if passed { Outcome::Fine } else { Outcome::CheckFailed })
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

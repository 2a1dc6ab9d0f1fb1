//! `camgen rotary`: solve, check, write, report.

use super::args::RotaryArgs;
use super::{Failure, Outcome, print, tell, text};
use camgen::cam::rotary::Rotary;
use camgen::checks::{self, Subject};
use camgen::drawing::outline::OutlineError;
use camgen::drawing::{self, Part, Report};
use camgen::machine::Machine;
use camgen::output::files::{Output, write_all};
use camgen::output::formats::{FORMATS, Job};
use camgen::output::number::shortest;
use camgen::output::{json, svg};
use std::io::IsTerminal;

pub(super) fn run(args: &RotaryArgs) -> Result<Outcome, Failure> {
    let (machine, machine_name) = Machine::load(&args.machine, &args.set).map_err(Failure::new)?;
    let rpm = match args.rpm.as_slice() {
        [] => machine.design_rpm,
        [rpm] => *rpm,
        more => return Err(Failure(format!("a rotary cam is cut for one speed, not {}", more.len()))),
    };
    let template = match &args.template {
        None => svg::TEMPLATE.to_owned(),
        Some(path) => std::fs::read_to_string(path)
            .map_err(|error| Failure(format!("cannot read the template `{}`: {error}", path.display())))?,
    };
    let rotary = Rotary::solve(&machine, rpm).map_err(Failure::new)?;
    let (part, no_outline) = match drawing::part(&rotary, args.tolerance) {
        Ok(part) => (Some(part), None),
        Err(undercut @ OutlineError::Undercut { .. }) => (None, Some(undercut)),
        Err(error) => return Err(Failure::new(error)),
    };
    let outline = part.as_ref().map(|part| &part.outline.contour);
    let findings = checks::run(&Subject { rotary: &rotary, outline });
    let passed = checks::passed(&findings);
    let mut report = drawing::report(&rotary, part.as_ref(), args.tolerance, findings);

    match &part {
        Some(part) if passed || args.force => {
            let stem = args.name.clone().unwrap_or_else(|| format!("{machine_name}-rotary-{}rpm", shortest(rpm)));
            write(args, &rotary, part, &mut report, &stem, &template)?;
        }
        Some(_) => tell("refused: a check failed, nothing was written (--force writes all the same)"),
        None => {
            let why = no_outline.map(|error| error.to_string()).unwrap_or_default();
            tell(&format!("refused: {why}, nothing was written, with --force neither"));
        }
    }
    if args.json {
        let bytes = json::write(&report).map_err(Failure::new)?;
        print(&String::from_utf8_lossy(&bytes))?;
    } else if !args.quiet {
        let colour = !args.no_color && std::env::var_os("NO_COLOR").is_none() && std::io::stdout().is_terminal();
        print(&text::report(&report, colour))?;
    }
    Ok(if passed { Outcome::Fine } else { Outcome::CheckFailed })
}

fn write(
    args: &RotaryArgs,
    rotary: &Rotary,
    part: &Part,
    report: &mut Report,
    stem: &str,
    template: &str,
) -> Result<(), Failure> {
    let formats: Vec<_> = FORMATS.iter().enumerate().filter(|(index, _)| args.format.contains(index)).collect();
    let name = |extension: &str| format!("{stem}.{extension}");
    report.files = formats.iter().map(|(_, (ext, _))| args.out.join(name(ext)).display().to_string()).collect();
    let job = Job { rotary, part, report, dxf_version: args.dxf_version, samples: args.samples, template };
    let outputs: Result<Vec<Output>, Failure> = formats
        .iter()
        .map(|(_, (ext, render))| Ok(Output { name: name(ext), bytes: render(&job).map_err(Failure::new)? }))
        .collect();
    write_all(&args.out, &outputs?).map_err(Failure::new)?;
    Ok(())
}

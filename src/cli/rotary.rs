//! `camgen rotary`: solve, check, write, report.

use super::args::RotaryArgs;
use super::{Failure, Outcome, print, tell, text};
use camgen::cam::rotary::Rotary;
use camgen::checks::{self, Subject, rolling};
use camgen::drawing::outline::OutlineError;
use camgen::drawing::{self, Entity, Layer, Part, Report};
use camgen::output::files::{Output, write_all};
use camgen::output::formats::{DEFAULT_FORMATS, FORMATS, Job};
use camgen::output::number::shortest;
use camgen::output::proof::{self, Written};
use camgen::output::{dxf, json, svg};

pub(super) fn run(args: &RotaryArgs) -> Result<Outcome, Failure> {
    let (mut machine, machine_name) = args.common.machine()?;
    let rpm = args.common.one_speed(&machine)?;
    let tolerance = args.common.tolerance;
    let template = match &args.template {
        None => svg::TEMPLATE.to_owned(),
        Some(path) => std::fs::read_to_string(path)
            .map_err(|error| Failure(format!("cannot read the template `{}`: {error}", path.display())))?,
    };
    if let Some(radius) = args.cutter {
        // The cutter that is asked for is the one that has to get in.
        let limit = &mut machine.limits.cutter_radius;
        *limit = Some(limit.map_or(radius, |other| other.max(radius)));
    }
    let rotary = Rotary::solve(&machine, rpm).map_err(Failure::new)?;
    let (part, no_outline) = match drawing::part(&rotary, tolerance) {
        Ok(part) => (Some(part), None),
        Err(undercut @ OutlineError::Undercut(_)) => (None, Some(undercut)),
        Err(error) => return Err(Failure::new(error)),
    };
    // The proof is of the bytes that would be cut from, not of what they were made of.
    let written = part.as_ref().map(|part| proof::write(part, args.dxf_version)).transpose().map_err(Failure::new)?;
    let tolerance_mm = 1e3 * tolerance;
    let outline = written.as_ref().map(|written| &written.outline);
    let rolled = outline.map(|outline| rolling::roll(&rotary, outline, tolerance_mm));
    let balancing = part.as_ref().and_then(|part| part.balancing.as_ref());
    let findings = checks::run(&Subject { rotary: &rotary, outline, rolled: rolled.as_ref(), balancing, tolerance_mm });
    let passed = checks::passed(&findings);
    let mut report = drawing::report(&rotary, part.as_ref(), rolled, tolerance, findings);

    match (&part, &written) {
        (Some(part), Some(written)) if passed || args.force => {
            let stem = args.name.clone().unwrap_or_else(|| format!("{machine_name}-rotary-{}rpm", shortest(rpm)));
            write(args, &rotary, part, written, &mut report, &stem, &template)?;
        }
        (Some(_), _) => tell("refused: a check failed, nothing was written (--force writes all the same)"),
        (None, _) => {
            let why = no_outline.map(|error| error.to_string()).unwrap_or_default();
            tell(&format!("refused: {why}; nothing was written, with --force neither"));
        }
    }
    if args.common.json {
        let bytes = json::write(&report).map_err(Failure::new)?;
        print(&String::from_utf8_lossy(&bytes))?;
    } else if !args.common.quiet {
        print(&text::report(&report, args.common.colour()))?;
    }
    Ok(if passed { Outcome::Fine } else { Outcome::CheckFailed })
}

/// Whether a format is written: asked for, or usual and possible.
fn wanted(args: &RotaryArgs, rotary: &Rotary, index: usize, name: &str) -> bool {
    match &args.format {
        Some(asked) => asked.contains(&index),
        None if name == "step" && rotary.machine.cam.thickness.is_none() => {
            tell("no STEP file: cam.thickness is not given");
            false
        }
        None => DEFAULT_FORMATS.contains(&name),
    }
}

fn write(
    args: &RotaryArgs,
    rotary: &Rotary,
    part: &Part,
    written: &Written,
    report: &mut Report,
    stem: &str,
    template: &str,
) -> Result<(), Failure> {
    let formats: Vec<_> =
        FORMATS.iter().enumerate().filter(|(index, (name, _))| wanted(args, rotary, *index, name)).collect();
    let mut names: Vec<String> = formats.iter().map(|(_, (extension, _))| format!("{stem}.{extension}")).collect();
    let cutter = match args.cutter {
        Some(radius) => {
            let path = drawing::cutter_path(rotary, radius, args.common.tolerance).map_err(Failure::new)?;
            let entities = [(Layer::CutterPath, Entity::Polyline(path.contour))];
            names.push(format!("{stem}-cutter.dxf"));
            Some(dxf::write(&entities, args.dxf_version))
        }
        None => None,
    };
    report.files = names.iter().map(|name| args.out.join(name).display().to_string()).collect();
    let job = Job { rotary, part, report, dxf: &written.bytes, samples: args.samples, template };
    let rendered: Result<Vec<Vec<u8>>, Failure> =
        formats.iter().map(|(_, (_, render))| render(&job).map_err(Failure::new)).collect();
    let outputs: Vec<Output> = names
        .into_iter()
        .zip(rendered?.into_iter().chain(cutter))
        .map(|(name, bytes)| Output { name, bytes })
        .collect();
    write_all(&args.out, &outputs).map_err(Failure::new)?;
    Ok(())
}

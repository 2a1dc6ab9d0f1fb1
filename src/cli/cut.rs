//! What every command that cuts a plane cam does: draw, prove, check, write, report.

use super::args::{CommonArgs, FileArgs, STL, SideOf};
use super::{Failure, Outcome, print, tell, text};
use camgen::cam::Cam;
use camgen::checks::rolling::Rolled;
use camgen::checks::{self, Finding, Subject, rolling};
use camgen::drawing::outline::{Fit, OutlineError, Side};
use camgen::drawing::{Part, Report, Sheet, Table};
use camgen::output::files::{Output, write_all};
use camgen::output::formats::{DEFAULT_FORMATS, FORMATS, Job};
use camgen::output::number::shortest;
use camgen::output::proof::{self, Written};
use camgen::output::{json, svg};

type MakeReport<'a> = &'a dyn Fn(Option<&Part>, Option<Rolled>, Vec<Finding>) -> Report;

/// A cam and how its drawing, report and tables are made.
pub(super) struct Cut<'a> {
    pub(super) cam: &'a dyn Cam,
    pub(super) common: &'a CommonArgs,
    pub(super) files: &'a FileArgs,
    pub(super) template: &'a str,
    pub(super) stem: &'a str,
    pub(super) part: &'a dyn Fn() -> Result<Part, OutlineError>,
    pub(super) report: MakeReport<'a>,
    pub(super) sheet: &'a dyn Fn(&Part, &Report) -> Result<Sheet, OutlineError>,
    pub(super) table: &'a dyn Fn() -> Table,
    /// Files beside those of the formats.
    pub(super) more: &'a dyn Fn() -> Result<Vec<Output>, Failure>,
}

impl FileArgs {
    pub(super) fn fit(&self, tolerance: f64) -> Fit {
        let side = match self.side {
            SideOf::Both => Side::Both,
            SideOf::Inside => Side::Inside,
            SideOf::Outside => Side::Outside,
        };
        Fit { tolerance, side }
    }

    pub(super) fn stem(&self, machine: &str, command: &str, rpm: f64) -> String {
        self.name.clone().unwrap_or_else(|| format!("{machine}-{command}-{}rpm", shortest(rpm)))
    }
}

/// The sheet the preview is put into.
pub(super) fn template(files: &FileArgs) -> Result<String, Failure> {
    match &files.template {
        None => Ok(svg::TEMPLATE.to_owned()),
        Some(path) => std::fs::read_to_string(path)
            .map_err(|error| Failure(format!("cannot read the template `{}`: {error}", path.display()))),
    }
}

pub(super) fn cut(job: &Cut<'_>) -> Result<Outcome, Failure> {
    let (common, files) = (job.common, job.files);
    if files.format.iter().flatten().any(|name| *name == STL) {
        return Err(Failure("the format stl is for a conoid; a plane cam has step".into()));
    }
    let (part, no_outline) = match (job.part)() {
        Ok(part) => (Some(part), None),
        Err(refusal @ (OutlineError::Undercut(_) | OutlineError::Thin { .. })) => (None, Some(refusal)),
        Err(error) => return Err(Failure::new(error)),
    };
    // The proof is of the bytes that would be cut from, not of what they were made of.
    let written = part.as_ref().map(|part| proof::write(part, files.dxf_version)).transpose().map_err(Failure::new)?;
    let tolerance_mm = 1e3 * common.tolerance();
    let outline = written.as_ref().map(|written| &written.outline);
    let rolled = outline.map(|outline| rolling::roll(job.cam, outline, tolerance_mm));
    let balancing = part.as_ref().and_then(|part| part.balancing.as_ref());
    let findings = checks::run(&Subject { cam: job.cam, outline, rolled: rolled.as_ref(), balancing, tolerance_mm });
    let passed = checks::passed(&findings);
    let mut report = (job.report)(part.as_ref(), rolled, findings);

    match (&part, &written) {
        (Some(part), Some(written)) if passed || files.force => write(job, part, written, &mut report)?,
        (Some(_), _) => tell("refused: a check failed, nothing was written (--force writes all the same)"),
        (None, _) => {
            let why = no_outline.map(|error| error.to_string()).unwrap_or_default();
            tell(&format!("refused: {why}; nothing was written, with --force neither"));
        }
    }
    if common.json {
        let bytes = json::write(&report).map_err(Failure::new)?;
        print(&String::from_utf8_lossy(&bytes))?;
    } else if !common.quiet {
        print(&text::report(&report, common.colour()))?;
    }
    Ok(if passed { Outcome::Fine } else { Outcome::CheckFailed })
}

/// Whether a format is written: asked for, or usual and possible.
fn wanted(job: &Cut<'_>, name: &str) -> bool {
    match &job.files.format {
        Some(asked) => asked.contains(&name),
        None if name == "step" && job.cam.machine().cam.thickness.is_none() => {
            tell("no STEP file: cam.thickness is not given");
            false
        }
        None => DEFAULT_FORMATS.contains(&name),
    }
}

fn write(job: &Cut<'_>, part: &Part, written: &Written, report: &mut Report) -> Result<(), Failure> {
    let files = job.files;
    let formats: Vec<_> = FORMATS.iter().filter(|(name, _)| wanted(job, name)).collect();
    let more = (job.more)()?;
    let own = formats.iter().map(|(extension, _)| format!("{}.{extension}", job.stem));
    let names: Vec<String> = own.chain(more.iter().map(|output| output.name.clone())).collect();
    report.files = names.iter().map(|name| files.out.join(name).display().to_string()).collect();
    let report: &Report = report;
    let rendering = Job {
        part,
        report,
        dxf: &written.bytes,
        thickness: job.cam.machine().cam.thickness,
        sheet: &|| (job.sheet)(part, report),
        table: job.table,
        template: job.template,
    };
    let rendered: Result<Vec<Vec<u8>>, Failure> =
        formats.iter().map(|(_, render)| render(&rendering).map_err(Failure::new)).collect();
    let outputs: Vec<Output> = names
        .into_iter()
        .zip(rendered?.into_iter().chain(more.into_iter().map(|output| output.bytes)))
        .map(|(name, bytes)| Output { name, bytes })
        .collect();
    write_all(&files.out, &outputs).map_err(Failure::new)?;
    Ok(())
}

//! Judges the path of a cutter, and the files of a cam whose flanks a roller sweeps, that somebody else may have written.

use crate::body::Layer;
use crate::check::CheckScope;
use crate::reading::step::is_step;
use crate::reading::{Chain, Reading, read_with_outline};
use crate::report::Finding;
use crate::tool_files::tool_file::{ExpectedFile, FileError, JudgedFile, SolvedCam, best_of_cuts};
use crate::verify::{self, CHECKS, Evidence, WrittenPath, WrittenSwept, join_reach};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;

/// Judges the path of a cutter.
///
/// # Errors
/// [`FileError`] when it is not a DXF file, or the radius of the cutter is not known.
pub fn judge_path(cam: &SolvedCam<'_>, file: &ExpectedFile<'_>, bytes: &[u8]) -> Result<JudgedFile, FileError> {
    let layer = Layer::CutterPath.name();
    let reading = read_with_outline(bytes, join_reach(cam.tolerance_mm()), Some(layer)).map_err(FileError::Read)?;
    judge_path_as_read(cam, file, reading)
}

/// Judges the path of a cutter that was found in a file.
///
/// # Errors
/// [`FileError`] when the radius of the cutter is not known.
pub fn judge_path_as_read(
    cam: &SolvedCam<'_>,
    file: &ExpectedFile<'_>,
    reading: Reading,
) -> Result<JudgedFile, FileError> {
    let radius = file.cutter.or(cam.request.cutter_radius).ok_or_else(|| {
        let refusal = Refusal::new("the file holds the path of a cutter and does not give its radius");
        FileError::Cutter(refusal.remedy("give the radius of the cutter"))
    })?;
    let (lead_ins, others): (Vec<Chain>, Vec<Chain>) = reading.others.iter().cloned().partition(verify::is_lead_in);
    let contour = match (reading.chains.as_slice(), others.as_slice()) {
        (_, [other, ..]) => Err(format!("{} would be cut and is no part of the path", other.names())),
        ([chain], []) if chain.closed => Ok(chain.counter_clockwise()),
        _ => Err("the path is not one closed contour".to_owned()),
    };
    let (middle, _) = cam.request.fit.band();
    let foreign = [reading];
    best_of_cuts(cam, file, |cut| {
        let (radius, middle, lead_ins) = (MILLIMETRES * radius, MILLIMETRES * middle, lead_ins.clone());
        let path = [WrittenPath { cut, radius, middle, contour: contour.clone(), lead_ins }];
        Ok(judged_by(&Evidence { foreign: &foreign, cutter_paths: &path, ..cam.evidence()? }))
    })
}

/// Judges the solid, or the developed view, of a cam whose flanks a roller sweeps in space; with what it is.
///
/// # Errors
/// [`FileError::Read`] when it cannot be read, or the cam has no developed view.
pub fn judge_swept(cam: &SolvedCam<'_>, bytes: &[u8]) -> Result<(&'static str, JudgedFile), FileError> {
    let body = cam.body;
    let (what, read) = if is_step(bytes) {
        ("solid", WrittenSwept::of_solid(body, bytes, cam.tolerance_mm()))
    } else if body.swept().is_some_and(|flanks| flanks.developed().is_empty()) {
        let refusal = Refusal::new("the outside of this cam cannot be developed: its STEP file is what can be checked");
        return Err(FileError::Read(refusal.remedy("give the STEP file")));
    } else {
        ("developed view", WrittenSwept::of_unrolled(body, bytes, join_reach(cam.tolerance_mm())))
    };
    let swept = read.map_err(FileError::Read)?;
    Ok((what, judged_by(&Evidence { swept: Some(&swept), ..cam.evidence()? })))
}

/// The findings on the file alone, not on the cam.
fn judged_by(evidence: &Evidence<'_>) -> JudgedFile {
    let findings = verify::run(evidence).into_iter().filter(is_of_file).collect();
    JudgedFile { findings, ..JudgedFile::default() }
}

fn is_of_file(finding: &Finding) -> bool {
    CHECKS
        .iter()
        .any(|check| check.name == finding.check && matches!(check.on, CheckScope::File | CheckScope::ToolFile))
}

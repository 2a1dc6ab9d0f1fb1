//! The proof of a cutter's path, of a solid that a roller sweeps and of other files that were edited or written by another program.

use super::{Cam, Error, diagnosis, report};
use crate::body::{Layer, Request};
use crate::check::CheckScope;
use crate::reading::{self, Chain};
use crate::report::{Finding, Inputs, Report, Section, Verdict};
use crate::tool_files::{ExpectedFile, SolvedCam, ToolFile};
use crate::verify::{self, CHECKS, Evidence, WrittenPath, WrittenSwept, join_reach};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;

impl Cam {
    /// Whether a DXF file holds the path of a cutter of this cam.
    pub(super) fn check_cutter_path(
        &self,
        bytes: &[u8],
        expected: &ExpectedFile<'_>,
        request: &Request,
    ) -> Result<Report, Error> {
        let radius = expected.cutter.or(request.cutter_radius).ok_or_else(|| {
            let refusal = Refusal::new("the file holds the path of a cutter and does not give its radius");
            Error::Cutter(refusal.remedy("give the radius of the cutter"))
        })?;
        let tolerance_mm = MILLIMETRES * request.fit.tolerance;
        let layer = Layer::CutterPath.name();
        let reading = reading::read_with_outline(bytes, join_reach(tolerance_mm), Some(layer)).map_err(Error::Read)?;
        let (lead_ins, others): (Vec<Chain>, Vec<Chain>) = reading.others.iter().cloned().partition(verify::is_lead_in);
        let contour = match (reading.chains.as_slice(), others.as_slice()) {
            (_, [other, ..]) => Err(format!("{} would be cut and is no part of the path", other.names())),
            ([chain], []) if chain.closed => Ok(chain.counter_clockwise()),
            _ => Err("the path is not one closed contour".to_owned()),
        };
        let (middle, _) = request.fit.band();
        let foreign = [reading];
        let judged = |cut: usize| -> Result<Vec<Finding>, Error> {
            let (radius, middle, lead_ins) = (MILLIMETRES * radius, MILLIMETRES * middle, lead_ins.clone());
            let path = [WrittenPath { cut, radius, middle, contour: contour.clone(), lead_ins }];
            let evidence = self.nothing_written(tolerance_mm, request)?;
            Ok(verify::run(&Evidence { foreign: &foreign, cutter_paths: &path, ..evidence }))
        };
        let checks = self.best_of_cuts(expected, judged)?;
        Ok(self.report_on("path of a cutter", request, checks.into_iter().filter(is_of_file).collect()))
    }

    /// Whether a file is the solid, or the developed view, of this cam, whose flanks a roller sweeps in space.
    pub(super) fn check_swept(&self, bytes: &[u8], request: &Request) -> Result<Report, Error> {
        let tolerance_mm = MILLIMETRES * request.fit.tolerance;
        let body = self.body();
        let (what, read) = if reading::step::is_step(bytes) {
            ("solid", WrittenSwept::of_solid(body, bytes, tolerance_mm))
        } else if body.swept().is_some_and(|flanks| flanks.developed().is_empty()) {
            let refusal =
                Refusal::new("the outside of this cam cannot be developed: its STEP file is what can be checked");
            return Err(Error::Read(refusal.remedy("give the STEP file")));
        } else {
            ("developed view", WrittenSwept::of_unrolled(body, bytes, join_reach(tolerance_mm)))
        };
        let swept = read.map_err(Error::Read)?;
        let evidence = self.nothing_written(tolerance_mm, request)?;
        let checks = verify::run(&Evidence { swept: Some(&swept), ..evidence });
        Ok(self.report_on(what, request, checks.into_iter().filter(is_of_file).collect()))
    }

    /// Whether a file that a machine runs is one of this cam.
    pub(super) fn check_tool_file(
        &self,
        file: &dyn ToolFile,
        bytes: &[u8],
        expected: &ExpectedFile<'_>,
        request: &Request,
    ) -> Result<Report, Error> {
        let judged = file.judge(&SolvedCam { body: self.body(), request }, expected, bytes)?;
        let checks: Vec<Finding> = judged.finding.into_iter().collect();
        let cause = diagnosis::of(self, (0, None), judged.outline.as_ref(), (&checks, request.fit.tolerance));
        let mut report = self.report_on(file.noun(), request, checks);
        report.sections.extend(cause);
        Ok(report)
    }

    /// The findings on the cut of this name, or the first that a file fits, of a part with several flanks.
    fn best_of_cuts(
        &self,
        expected: &ExpectedFile<'_>,
        judged: impl Fn(usize) -> Result<Vec<Finding>, Error>,
    ) -> Result<Vec<Finding>, Error> {
        let cuts = self.body().cuts();
        let named = expected.cut.and_then(|name| cuts.iter().position(|cut| cut.name == name));
        let wanted = named.map_or(0..cuts.len(), |named| named..named + 1);
        let failed = |checks: &[Finding]| checks.iter().any(|finding| finding.verdict == Verdict::Fail);
        let first = judged(wanted.start)?;
        for cut in wanted.skip(1).filter(|_| failed(&first)) {
            let next = judged(cut)?;
            if !failed(&next) {
                return Ok(next);
            }
        }
        Ok(first)
    }

    /// The evidence of a file without an outline.
    fn nothing_written(&self, tolerance_mm: f64, request: &Request) -> Result<Evidence<'_>, Error> {
        Ok(Evidence {
            strict: request.strict,
            ..Evidence::without_files(
                self.body(),
                tolerance_mm,
                request.resolved(self.body()).map_err(Error::Draw)?.fit.motion,
            )
        })
    }

    /// The report on a file that is not the outline itself.
    fn report_on(&self, what: &str, request: &Request, checks: Vec<Finding>) -> Report {
        let sections = vec![Section::new("cam", &self.body().kind().noun)];
        let whole = report(self.body(), Inputs::of(&self.inputs_for(request)), sections, checks);
        let noun = format!("{what} of a {}", whole.noun).into();
        Report { command: "check".into(), noun, not_modelled: Vec::new(), ..whole }
    }
}

/// Whether a finding is on the file and not on the cam.
fn is_of_file(finding: &Finding) -> bool {
    CHECKS
        .iter()
        .any(|check| check.name == finding.check && matches!(check.on, CheckScope::File | CheckScope::ToolFile))
}

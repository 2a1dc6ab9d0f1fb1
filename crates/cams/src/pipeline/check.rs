//! The proof of a file that was edited, or written by another program.

use super::{Cam, Error, FileKind, diagnosis, file_kind, report};
use crate::body::conjugate::COUNTER;
use crate::body::{Body, Cut, Layer, Request};
use crate::reading::step::{FaceLoop, FlankShape, HubShape, SolidForm, StepBoundary, StepFile, StepPlacement};
use crate::reading::{self, Chain, OutlinePlace, Reading, step};
use crate::report::{
    CUT_BESIDE, CUTTER_PATH_NOUN, FileVerdict, Finding, Inputs, NOT_JUDGED, Report, ReportLine, Rolled, Section,
    Verdict, shown,
};
use crate::tool_files::dxf::{judge_path, judge_path_as_read, judge_swept};
use crate::tool_files::section::{CutSection, section};
use crate::tool_files::{ExpectedFile, JudgedFile, SolvedCam};
use crate::verify::{self, Evidence, WrittenOutline, WrittenSolid, join_reach, rolling, shell_reach};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::profile::outline::MotionTolerance;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::Text;
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

/// A contour whose extents are nearer to those of the cam than this many tolerances is compared with it, wherever it lies in its file.
const NEAR_EXTENTS: f64 = 4.0;

/// Whether a DXF file has the path of a cutter and no outline.
fn is_cutter_path(reading: &Reading) -> bool {
    let has = |layer: Layer| reading.layers.iter().any(|name| name.eq_ignore_ascii_case(layer.name()));
    has(Layer::CutterPath) && !has(Layer::CamProfile)
}

impl Cam {
    /// Whether a DXF file, also one that was edited or written by another program, holds the outline of this cam within a
    /// tolerance (m, or with tolerances of the follower's motion, a [`Request`]), or a STEP file its solid. A conoid of several sections is
    /// cut from several DXF files: see [`Cam::check_section`].
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{Machine, Spec, Verdict};
    ///
    /// let cam = |lift: &str| -> Result<_, Box<dyn std::error::Error>> {
    ///     let (machine, _) = Machine::load("valve", &[format!("motion.segment[0].to={lift}")])?;
    ///     Ok(Spec::of_program(machine, None).ok_or("no motion")?.solve()?)
    /// };
    /// let other = cam("8.9 mm")?.draw(5e-6)?.prove()?.cut_files()[0].clone();
    /// let report = cam("9 mm")?.check(&other, 10e-6)?;
    /// let failed = report.checks.iter().find(|finding| finding.verdict == Verdict::Fail).ok_or("a failed check")?;
    /// println!("{}: {} {} at {}", failed.check, failed.value, failed.unit, failed.place);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Cam::check_file`].
    pub fn check(&self, bytes: &[u8], request: impl Into<Request>) -> Result<Report, Error> {
        self.check_file(bytes, &ExpectedFile::default(), request)
    }

    /// As [`Cam::check`], with what the file should hold where the cam has more than one file, and how it is read. A path of a cutter, a
    /// table of points or for a servo drive and a program for a milling machine are recognised and checked as such.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{ExpectedFile, Machine, Request, Spec};
    ///
    /// let (machine, _) = Machine::load("feeder", &[])?;
    /// let cam = Spec::of_program(machine, None).ok_or("no motion")?.solve()?;
    /// let dxf = cam.draw(5e-6)?.prove()?.cut_files()[0].clone();
    /// let other = String::from_utf8(dxf)?.replace("CAM_PROFILE", "CONTOUR").into_bytes();
    /// // The outermost closed contour is the outline of a file without that layer.
    /// assert!(cam.check(&other, 5e-6)?.passed());
    /// assert!(cam.check_file(&other, &ExpectedFile { layer: Some("CONTOUR"), ..ExpectedFile::default() }, 5e-6)?.passed());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Read`] when the bytes are not a DXF or a STEP file, a table of points or a program;
    /// [`Error::Section`] for a DXF file and a conoid of several sections, when there is no such section or outline, and for its solid where
    /// errors of the motion are requested; [`Error::Cutter`] for the path of a cutter of unknown radius; [`Error::Draw`] when the follower
    /// does not have such a velocity or acceleration.
    pub fn check_file(
        &self,
        bytes: &[u8],
        expected: &ExpectedFile<'_>,
        request: impl Into<Request>,
    ) -> Result<Report, Error> {
        let request = request.into();
        let plain = file_kind::plain(bytes);
        let bytes = &*plain;
        let kind = FileKind::of(bytes);
        kind.of_body(self.body()).map_err(Error::Read)?;
        let swept = self.body().swept().is_some();
        match kind {
            FileKind::Step | FileKind::Dxf if swept => {
                let (what, judged) = judge_swept(&self.solved(&request), bytes)?;
                return Ok(self.report_on(what, &request, judged));
            }
            FileKind::Step if expected.section.is_some() => {
                let refusal = Refusal::new("a STEP file holds the solid of all sections");
                return Err(Error::Section(refusal.remedy("give no section")));
            }
            FileKind::Step => return self.check_solid(bytes, &request),
            FileKind::Tool(file) => {
                let judged = file.judge(&self.solved(&request), expected, bytes)?;
                return Ok(self.report_on(file.facts().noun, &request, judged));
            }
            FileKind::Dxf | FileKind::Shown(_) => {}
        }
        self.check_drawing(bytes, expected, request)
    }

    /// The cam as files are compared with it.
    fn solved<'a>(&'a self, request: &'a Request) -> SolvedCam<'a> {
        SolvedCam { body: self.body(), request }
    }

    /// The report on a file that is not the outline itself.
    fn report_on(&self, what: &str, request: &Request, judged: JudgedFile) -> Report {
        let JudgedFile { findings, outline, .. } = judged;
        let mut sections = vec![Section::new("cam", &self.body().kind().noun)];
        sections.extend(diagnosis::of(self, (0, None), outline.as_ref(), (&findings, request.fit.tolerance)));
        let whole = report(self.body(), Inputs::of(&self.inputs_for(request)), sections, findings);
        let noun = format!("{what} of a {}", whole.noun).into();
        Report { command: "check".into(), noun, not_modelled: Vec::new(), ..whole }
    }

    /// The report on a DXF file.
    fn check_drawing(&self, bytes: &[u8], expected: &ExpectedFile<'_>, request: Request) -> Result<Report, Error> {
        if let Some(name) = expected.cut {
            return self.check_cut(bytes, name, request);
        }
        let reach = join_reach(request.fit.tolerance_mm());
        let reading = reading::read_outermost(bytes, reach, expected.layer).map_err(Error::Read)?;
        if expected.layer.is_none() && is_cutter_path(&reading) {
            let judged = judge_path(&self.solved(&request), expected, bytes)?;
            return Ok(self.report_on(CUTTER_PATH_NOUN, &request, judged));
        }
        let section = section(self.body(), expected.section)?;
        if section.is_none() && self.is_one_file() {
            let cuts = self.body().cuts();
            let of = |cut: &Cut<'_>| reading::read_with_outline(bytes, reach, Some(cut.layer.name()));
            let readings = cuts.iter().map(of).collect::<Result<Vec<_>, _>>().map_err(Error::Read)?;
            return self.check_outlines(&readings, (0, None), &request);
        }
        let cut = self.one_cut(section)?;
        let as_it_is = self.check_outlines(std::slice::from_ref(&reading), (cut, section), &request)?;
        if FileVerdict::of(&as_it_is) != FileVerdict::NotThisCam {
            return Ok(as_it_is);
        }
        if let Some(radius) = expected.cutter.filter(|_| !expected.cutter_is_recorded) {
            let as_path = self.check_as_path(reading.clone(), (radius, expected), (cut, section), &request)?;
            if as_path.as_ref().is_some_and(|report| FileVerdict::of(report) != FileVerdict::NotThisCam) {
                return Ok(as_path.unwrap_or(as_it_is));
            }
        }
        if expected.layer.is_none()
            && let Some(elsewhere) = self.outline_elsewhere(bytes, reading, cut, &request)?
        {
            let found = self.check_outlines(std::slice::from_ref(&elsewhere), (cut, section), &request)?;
            if FileVerdict::of(&found) == FileVerdict::ThisCamBut {
                return Ok(found);
            }
        }
        Ok(as_it_is)
    }

    /// The report on a file whose outline is the path of the centre of a cutter of a radius (m); `None` where it is not a closed contour
    /// of arcs and lines. A path with nothing beside it is judged as camgen writes it; one with other contours as the part that it cuts.
    fn check_as_path(
        &self,
        mut reading: Reading,
        (radius, expected): (f64, &ExpectedFile<'_>),
        (cut, section): (usize, Option<CutSection>),
        request: &Request,
    ) -> Result<Option<Report>, Error> {
        let [chain] = reading.chains.as_slice() else { return Ok(None) };
        if !chain.closed {
            return Ok(None);
        }
        let taken = format!(
            "the outermost contour is taken for the path of the centre of a cutter of Ø{} mm",
            shown(2.0 * MILLIMETRES * radius)
        );
        if reading.others.iter().all(verify::is_lead_in) {
            let has_bore = self.body().machine().cam.bore_radius.is_some();
            let judged = judge_path_as_read(&self.solved(request), expected, reading)?;
            let report = self.report_on(CUTTER_PATH_NOUN, request, judged);
            let without = has_bore.then(|| "; the file has no bore, which is cut by another one".to_owned());
            let note = Text::from(format!("{taken}{}", without.unwrap_or_default()));
            return Ok(Some(Report { notes: [vec![note], report.notes].concat(), ..report }));
        }
        let hollow = self.body().cuts().get(cut).is_some_and(Cut::is_hollow);
        let (path, radius_mm) = (chain.counter_clockwise(), MILLIMETRES * radius);
        let moved = if hollow {
            verify::moved_inwards(&path.reversed(), radius_mm).map(|moved| moved.reversed())
        } else {
            verify::moved_inwards(&path, radius_mm)
        };
        let Some(moved) = moved else { return Ok(None) };
        let sources = chain.sources.clone();
        reading.chains = vec![Chain { sources, ..Chain::of(&moved) }];
        let report = self.check_outlines(std::slice::from_ref(&reading), (cut, section), request)?;
        let noun = format!("{CUTTER_PATH_NOUN} of a {}", report.noun).into();
        Ok(Some(Report { noun, notes: [vec![Text::from(taken)], report.notes].concat(), ..report }))
    }

    /// The reading of a file in which the outline of a cut lies elsewhere than expected: on another layer than the one it should be
    /// on, within another contour, or on a layer that is off where nothing else would be cut as the outline.
    fn outline_elsewhere(
        &self,
        bytes: &[u8],
        reading: Reading,
        cut: usize,
        request: &Request,
    ) -> Result<Option<Reading>, Error> {
        let tolerance_mm = request.fit.tolerance_mm();
        let Some(own) = diagnosis::drawn(self.body(), cut, request.fit.tolerance) else { return Ok(None) };
        let wanted = own.extents();
        let fits = |chain: &Chain| {
            let found = chain.contour().extents();
            let off = (found.least - wanted.least).amax().max((found.largest - wanted.largest).amax());
            chain.closed && off <= NEAR_EXTENTS * tolerance_mm
        };
        if let Some(index) = reading.others.iter().position(fits) {
            let layers = reading.others.get(index).map(Chain::layers).unwrap_or_default();
            return Ok(Some(reading.with_outline(index, OutlinePlace::Elsewhere(layers))));
        }
        if reading.chains.iter().any(|chain| chain.closed) {
            return Ok(None);
        }
        let hidden = reading::read_hidden(bytes, join_reach(tolerance_mm), None).map_err(Error::Read)?;
        Ok(hidden.and_then(|hidden| match hidden.chains.as_slice() {
            [chain] if fits(chain) => {
                let layers = chain.layers();
                Some(Reading { outline: OutlinePlace::Hidden(layers), ..hidden })
            }
            _ => {
                let index = hidden.others.iter().position(fits)?;
                let layers = hidden.others.get(index).map(Chain::layers).unwrap_or_default();
                Some(hidden.with_outline(index, OutlinePlace::Hidden(layers)))
            }
        }))
    }

    /// Whether it has several outlines, all in one file, each on a layer of its own.
    fn is_one_file(&self) -> bool {
        let cuts = self.body().cuts();
        cuts.len() > 1 && cuts.iter().all(|cut| cuts.iter().filter(|other| other.layer == cut.layer).count() == 1)
    }

    /// Whether a DXF file holds the outline of this name, of a cam that has several at one place ([`Cut::name`]), within a tolerance (m, or a
    /// [`Request`]).
    ///
    /// # Errors
    /// [`Error::Read`] when the bytes are not a DXF file; [`Error::Section`] when the cam has no such outline; [`Error::Draw`] as
    /// for [`Cam::check`].
    pub fn check_cut(&self, bytes: &[u8], name: &str, request: impl Into<Request>) -> Result<Report, Error> {
        let cut = self.body().cuts().iter().position(|cut| cut.name == name);
        let cut = cut.ok_or_else(|| {
            let refusal = Refusal::new(format!("there is no outline `{name}`"));
            Error::Section(refusal.remedy(format!("give one of {}", self.names())))
        })?;
        let request = request.into();
        let reach = join_reach(request.fit.tolerance_mm());
        let layer = self.is_one_file().then(|| self.body().cuts().get(cut).map(|cut| cut.layer.name())).flatten();
        let reading = reading::read_outermost(bytes, reach, layer).map_err(Error::Read)?;
        self.check_outlines(&[reading], (cut, None), &request)
    }

    /// The names of its outlines.
    fn names(&self) -> String {
        self.body().cuts().iter().map(|cut| cut.name).collect::<Vec<_>>().join(", ")
    }

    /// The cut of a section, or the only one.
    pub(super) fn one_cut(&self, section: Option<CutSection>) -> Result<usize, Error> {
        match section {
            Some(section) => Ok(section.cut),
            None if self.body().cuts().len() > 1 => {
                let noun = self.body().kind().noun;
                let refusal = Refusal::new(format!("a {noun} has a file for each outline"));
                Err(Error::Section(refusal.remedy(format!("give one of {}", self.names()))))
            }
            None => Ok(0),
        }
    }

    /// Whether a DXF file holds the section of this conoid for a speed (rpm, one of those it was solved for, or as in a file
    /// name, to six digits), within a tolerance (m, or a [`Request`]).
    ///
    /// # Errors
    /// [`Error::Read`] when the bytes are not a DXF file; [`Error::Section`] when the cam has no such section; [`Error::Draw`] as
    /// for [`Cam::check`].
    pub fn check_section(&self, bytes: &[u8], rpm: f64, request: impl Into<Request>) -> Result<Report, Error> {
        self.check_file(bytes, &ExpectedFile { section: Some(rpm), ..ExpectedFile::default() }, request)
    }

    /// The report on the outlines of a file, from this cut of the body on.
    fn check_outlines(
        &self,
        readings: &[Reading],
        (cut, section): (usize, Option<CutSection>),
        request: &Request,
    ) -> Result<Report, Error> {
        let tolerance_mm = request.fit.tolerance_mm();
        let motion = request.resolved(self.body()).map_err(Error::Draw)?.fit.motion;
        let z = section.map_or(0.0, |section| section.z);
        let body = self.body();
        let all = body.cuts();
        let layers: Vec<&str> = all.iter().map(|cut| cut.layer.name()).filter(|_| self.is_one_file()).collect();
        let outline = |(index, reading): (usize, &Reading)| match reading.chains.as_slice() {
            [chain] if chain.closed => {
                let (contour, others) = (chain.counter_clockwise(), reading.beside(&layers));
                Some(WrittenOutline { cut: cut + index, z, contour, others })
            }
            _ => None,
        };
        let outlines: Vec<WrittenOutline> = readings.iter().enumerate().filter_map(outline).collect();
        let rolled = rolling::roll_all(body, &outlines, tolerance_mm);
        let evidence = Evidence {
            outlines: &outlines,
            rolled: &rolled,
            foreign: readings,
            strict: request.strict,
            ..Evidence::without_files(body, tolerance_mm, motion)
        };
        let checks = verify::run(&evidence);
        let [more, missing] = verify::counted_beside(&evidence).unwrap_or_default();
        let hidden = readings.iter().any(|reading| matches!(reading.outline, OutlinePlace::Hidden(_)));
        let beside = CutBeside { more, missing, hidden };
        let mut sections = vec![Section::new("cam", &body.kind().noun)];
        sections.extend(section.map(|section| Section::new("section", &section)));
        sections.push(Section::new("rolling", &rolled.first()));
        sections.push(Section::new(CUT_BESIDE, &beside));
        let found = outlines.first().map(|outline| &outline.contour);
        sections.extend(diagnosis::of(
            self,
            (cut, section.map(|section| section.rpm)),
            found,
            (&checks, request.fit.tolerance),
        ));
        let whole = report(body, Inputs::of(&self.inputs_for(request)), sections, checks);
        let noun = match section {
            Some(section) => format!("section for {} rpm of a {}", section.rpm, whole.noun).into(),
            None => whole.noun.clone(),
        };
        Ok(Report { command: "check".into(), noun, not_modelled: Vec::new(), ..whole })
    }

    fn check_solid(&self, bytes: &[u8], request: &Request) -> Result<Report, Error> {
        let tolerance_mm = request.fit.tolerance_mm();
        let motion = request.resolved(self.body()).map_err(Error::Draw)?.fit.motion;
        let body = self.body();
        let asked = request.rates.iter().zip(request.strict).any(|(rate, strict)| rate.is_some() && strict);
        if asked && body.surface().is_some() {
            let noun = body.kind().noun;
            let what = format!("errors of the follower's motion are not found on the solid of a {noun}");
            return Err(Error::Section(Refusal::new(what).remedy("give the DXF file of a section")));
        }
        let file = step::read(bytes).map_err(Error::Read)?;
        if body.kind().keys == COUNTER.keys && file.bodies.len() == 2 {
            let what = "the assembly of both discs, which are made and proved one by one";
            return Err(Error::Read(
                Refusal::new(what).remedy("check STEM-main.step and STEM-counter.step of the same run"),
            ));
        }
        let flank = if body.surface().is_some() { FlankShape::Patches } else { FlankShape::Upright };
        let failed = |checks: &[Finding]| checks.iter().any(|finding| finding.verdict == Verdict::Fail);
        let judged = self.judge_solid(file.clone(), flank, (tolerance_mm, motion), request);
        let mut sections =
            vec![Section::new("cam", &body.kind().noun), Section::new("rolling", &judged.rolled.first())];
        if failed(&judged.checks) {
            sections.extend(self.why_another_solid(&file, flank, &judged, (tolerance_mm, motion), request));
        }
        let SolidJudgement { checks, .. } = judged;
        let whole = report(body, Inputs::of(&self.inputs_for(request)), sections, checks);
        let noun = format!("solid of a {}", whole.noun).into();
        Ok(Report { command: "check".into(), noun, not_modelled: Vec::new(), ..whole })
    }

    /// Why a solid is not that of this cam: it lies elsewhere, its outline is another one, or it has splines that cannot be read exactly.
    fn why_another_solid(
        &self,
        file: &StepFile,
        flank: FlankShape,
        judged: &SolidJudgement,
        limits: (f64, MotionTolerance),
        request: &Request,
    ) -> Option<Section> {
        let told = |words: String| Section::new("diagnosis", &[&words]).with_words(vec![words.clone()]);
        let passes = |judged: &SolidJudgement| !judged.checks.iter().any(|finding| finding.verdict == Verdict::Fail);
        let boundary_judged = |boundary: StepBoundary| {
            let moved = StepFile { boundary, placement: None, ..file.clone() };
            self.judge_solid(moved, flank, limits, request)
        };
        if let Some(placement) = &file.placement
            && passes(&boundary_judged(placement.unplaced.clone()))
        {
            let words = placement.words();
            return Some(told(format!("It would be this cam {words}: a placement in the file puts it there")));
        }
        // What differs is not the outline: another bore, more holes.
        let is_outline =
            judged.checks.iter().any(|finding| finding.check == "outline" && finding.verdict == Verdict::Pass);
        let lies_there =
            judged.checks.iter().any(|finding| finding.check == "thickness" && finding.verdict == Verdict::Pass);
        if self.body().surface().is_some() || is_outline && lies_there {
            return None;
        }
        let is_upright = |form: &SolidForm| form.strange.is_empty() && !form.under.is_empty() && !form.above.is_empty();
        let (from, _) = self.body().height().unwrap_or_default();
        let mut of_outline = None;
        for (axes, turned) in orientations() {
            let boundary = StepPlacement::moved(&file.boundary, Vector3::zeros(), axes);
            let form = step::form(&boundary, flank, shell_reach(limits.0));
            if !is_upright(&form) {
                continue;
            }
            let up = form.low.first().map_or(0.0, |low| from - low);
            let moved = boundary_judged(StepPlacement::moved(&boundary, Vector3::z() * up, Matrix3::identity()));
            // Turned over it lies below the plane on which it was; where it lies along its axis is no other matter then.
            let is_moved = up.abs() > limits.0 && turned.is_empty();
            let by = if is_moved { format!("moved by {:.4} mm along its axis", -up) } else { String::new() };
            let words = if turned.is_empty() { by } else { turned.to_owned() };
            if passes(&moved) && !words.is_empty() {
                return Some(told(format!("It would be this cam {words}: the rest of the solid is right")));
            }
            if of_outline.is_none() {
                let outline = moved.outlines.first().map(|outline| &outline.contour);
                let found = diagnosis::of(self, (0, None), outline, (&moved.checks, request.fit.tolerance));
                of_outline = found.map(|found| (turned, found));
            }
        }
        match of_outline {
            Some(("", found)) => return Some(found),
            Some((turned, found)) => {
                let and = |line: &ReportLine| ReportLine::from(format!("The solid is {turned}. {}", line.text));
                return Some(Section { words: found.words.iter().map(and).collect(), ..found });
            }
            None => {}
        }
        (judged.form.unread_splines > 0 && judged.outlines.is_empty()).then(|| {
            let count = judged.form.unread_splines;
            let words = format!(
                "the solid cannot be judged: {count} of its faces and edges are splines that are no exact lines, circles, planes or \
                 cylinders; save it as AP214 with analytic surfaces, or give the DXF file"
            );
            Section::new(NOT_JUDGED, &[&words]).with_words(vec![words.clone()])
        })
    }

    /// Every check of a solid, where it lies, and what rolling on its outline has shown.
    fn judge_solid(
        &self,
        file: StepFile,
        flank: FlankShape,
        (tolerance_mm, motion): (f64, MotionTolerance),
        request: &Request,
    ) -> SolidJudgement {
        let body = self.body();
        let reach = shell_reach(tolerance_mm);
        let (bare, hub) = match hub_of(body) {
            Some(hub) => {
                let (bare, off) = hub.taken_off(&file.boundary, reach);
                (Some(bare), Some(off))
            }
            None => (None, None),
        };
        let form = step::form(bare.as_ref().unwrap_or(&file.boundary), flank, reach);
        let outlines = solid_outlines(body, &form);
        let rolled = rolling::roll_all(body, &outlines, tolerance_mm);
        let solid = WrittenSolid { file, form, hub };
        let checks = verify::run(&Evidence {
            outlines: &outlines,
            rolled: &rolled,
            solid: Some(&solid),
            strict: request.strict,
            ..Evidence::without_files(body, tolerance_mm, motion)
        });
        SolidJudgement { form: solid.form, outlines, checks, rolled }
    }
}

/// The hub of the design of a disc.
fn hub_of(body: &dyn Body) -> Option<HubShape> {
    let is_disc = body.surface().is_none()
        && body.swept().is_none()
        && body.follower_motion().is_some_and(|motion| motion.period().is_some());
    let hub = body.machine().features.hub.filter(|_| is_disc)?;
    let (low, high) = body.height()?;
    let ends = [low - MILLIMETRES * hub.behind, high + MILLIMETRES * hub.in_front];
    Some(HubShape { radius: MILLIMETRES * hub.radius, ends, faces: [low, high] })
}

/// How what a file would cut differs from the part, apart from the outline.
#[derive(Debug, Clone, Copy, Serialize)]
struct CutBeside {
    /// Contours that are not the part.
    more: usize,
    /// Contours of the part that are missing.
    missing: usize,
    /// Whether the outline lies on a layer that is off or frozen.
    hidden: bool,
}

/// What was found of a solid.
struct SolidJudgement {
    form: SolidForm,
    outlines: Vec<WrittenOutline>,
    checks: Vec<Finding>,
    rolled: Vec<Rolled>,
}

/// The rotations that bring the axis of a solid upright which lies along another axis or upside down, each with how the solid is turned;
/// first the one that leaves it as it is.
fn orientations() -> [(Matrix3<f64>, &'static str); 6] {
    [
        (Matrix3::identity(), ""),
        (Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, -1.0, 0.0), "turned by 90° about X, its axis along Y"),
        (Matrix3::new(1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0), "turned by −90° about X, its axis along Y"),
        (Matrix3::new(0.0, 0.0, -1.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0), "turned by 90° about Y, its axis along X"),
        (Matrix3::new(0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0), "turned by −90° about Y, its axis along X"),
        (Matrix3::new(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0), "turned over about X"),
    ]
}

/// The outlines of the cuts of a body in a solid, with the holes beside them; none where there are not as many as there should be.
fn solid_outlines(body: &dyn Body, form: &SolidForm) -> Vec<WrittenOutline> {
    let contours = |runs: &[FaceLoop], outer: bool| -> Vec<Contour> {
        let of = |run: &FaceLoop| match run {
            FaceLoop::Contour(contour) if (contour.area_and_centroid().0 > 0.0) == outer => Some(contour.clone()),
            _ => None,
        };
        runs.iter().filter_map(of).collect()
    };
    let reversed = |holes: Vec<Contour>| holes.into_iter().map(|hole| hole.reversed());
    let cuts = body.cuts();
    if !cuts.iter().any(Cut::is_hollow) {
        return match contours(&form.under, true).as_slice() {
            [contour] if body.surface().is_none() => {
                let others = reversed(contours(&form.under, false)).map(|hole| Chain::of(&hole)).collect();
                vec![WrittenOutline { cut: 0, z: 0.0, contour: contour.clone(), others }]
            }
            _ => Vec::new(),
        };
    }
    // From the bore outwards: the blank is outermost, and the flanks are next to it.
    let mut all: Vec<Contour> = contours(&form.above, true);
    all.extend(reversed(contours(&form.above, false)));
    all.sort_by(|a, b| a.area_and_centroid().0.total_cmp(&b.area_and_centroid().0));
    let Some(first) = all.len().checked_sub(1 + cuts.len()) else { return Vec::new() };
    let (within, rest) = all.split_at(first);
    let (flanks, blank) = rest.split_at(cuts.len());
    let others: Vec<Chain> = within.iter().chain(blank).map(Chain::of).collect();
    let outline = |(cut, contour): (usize, &Contour)| WrittenOutline {
        cut,
        z: 0.0,
        contour: contour.clone(),
        others: others.clone(),
    };
    flanks.iter().enumerate().map(outline).collect()
}

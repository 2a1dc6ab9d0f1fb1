//! The proof of a file that was edited, or written by another program.

use super::{Cam, Error, FileKind, diagnosis, report};
use crate::body::conjugate::COUNTER;
use crate::body::{Body, Cut, Layer, Request};
use crate::reading::step::{FaceLoop, FlankShape, HubShape, SolidForm, StepFile};
use crate::reading::{self, Chain, Reading, step};
use crate::report::{Finding, Inputs, Report, Rolled, Section, Verdict};
use crate::tool_files::dxf::{judge_path, judge_swept};
use crate::tool_files::section::{CutSection, section};
use crate::tool_files::{ExpectedFile, JudgedFile, SolvedCam};
use crate::verify::{self, Evidence, WrittenOutline, WrittenSolid, join_reach, rolling, shell_reach};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::profile::outline::MotionTolerance;
use camgen_kernel::refusal::Refusal;

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
    /// assert!(!cam.check(&other, 5e-6)?.passed());
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
        let reading = reading::read_with_outline(bytes, reach, expected.layer).map_err(Error::Read)?;
        if expected.layer.is_none() && is_cutter_path(&reading) {
            let judged = judge_path(&self.solved(&request), expected, bytes)?;
            return Ok(self.report_on("path of a cutter", &request, judged));
        }
        let section = section(self.body(), expected.section)?;
        if section.is_none() && self.is_one_file() {
            let cuts = self.body().cuts();
            let of = |cut: &Cut<'_>| reading::read_with_outline(bytes, reach, Some(cut.layer.name()));
            let readings = cuts.iter().map(of).collect::<Result<Vec<_>, _>>().map_err(Error::Read)?;
            return self.check_outlines(&readings, (0, None), &request);
        }
        let cut = self.one_cut(section)?;
        self.check_outlines(&[reading], (cut, section), &request)
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
        let reading = reading::read_with_outline(bytes, reach, layer).map_err(Error::Read)?;
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
        let checks = verify::run(&Evidence {
            outlines: &outlines,
            rolled: &rolled,
            foreign: readings,
            strict: request.strict,
            ..Evidence::without_files(body, tolerance_mm, motion)
        });
        let mut sections = vec![Section::new("cam", &body.kind().noun)];
        sections.extend(section.map(|section| Section::new("section", &section)));
        sections.push(Section::new("rolling", &rolled.first()));
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
        let elsewhere = file.placement.clone().map(|placement| (placement, file.clone()));
        let (checks, rolled) = self.judge_solid(file, flank, (tolerance_mm, motion), request);
        let failed = |checks: &[Finding]| checks.iter().any(|finding| finding.verdict == Verdict::Fail);
        let mut sections = vec![Section::new("cam", &body.kind().noun), Section::new("rolling", &rolled.first())];
        if let Some((placement, file)) = elsewhere.filter(|_| failed(&checks)) {
            let words = format!("It would be this cam {}: a placement in the file puts it there", placement.words());
            let unplaced = StepFile { boundary: placement.unplaced, placement: None, ..file };
            if !failed(&self.judge_solid(unplaced, flank, (tolerance_mm, motion), request).0) {
                sections.push(Section::new("diagnosis", &[&words]).with_words(vec![words.clone()]));
            }
        }
        let whole = report(body, Inputs::of(&self.inputs_for(request)), sections, checks);
        let noun = format!("solid of a {}", whole.noun).into();
        Ok(Report { command: "check".into(), noun, not_modelled: Vec::new(), ..whole })
    }

    /// Every check of a solid, where it lies, and what rolling on its outline has shown.
    fn judge_solid(
        &self,
        file: StepFile,
        flank: FlankShape,
        (tolerance_mm, motion): (f64, MotionTolerance),
        request: &Request,
    ) -> (Vec<Finding>, Vec<Rolled>) {
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
        (checks, rolled)
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

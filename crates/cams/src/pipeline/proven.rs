//! A drawing with its proof: the bytes of its cut files, and what every check found of them.

use super::{Cam, Drawing, Error, report};
use crate::body::{Body, DrawingEvidence, Drawn, Request};
use crate::check::Measure;
use crate::report::{Finding, Inputs, LazyReport, Report, Rolled, Section, passed, warning};
use crate::table::Table;
use crate::tool_files::dxf::{DxfForm, ProvedCuts, Version};
use crate::tool_files::{DrawnCam, Format, Listed, ProvedFile, ProvedToolFile, ToolFile, prove, tool_files};
use crate::verify::{self, Evidence, WrittenOutline, rolling};
use crate::write::Rendering;
use crate::write::csv;
use camgen_kernel::document::Input;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::text;
use std::ops::Deref;
use std::sync::Arc;

/// A cam whose cut files were written to memory, read back, and checked. A copy shares all of it.
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::{Machine, Spec, Verdict};
///
/// let (machine, _) = Machine::load("feeder", &["limits.pressure_angle=20 deg".to_owned(), "cam.base_radius=40 mm".to_owned()])?;
/// let proven = Spec::of_program(machine, None).ok_or("no motion")?.solve()?.draw(10e-6)?.prove()?;
/// assert!(!proven.passed());
/// for finding in proven.findings().iter().filter(|finding| finding.verdict == Verdict::Fail) {
///     println!("{}: {:.2} {}, limit {:?}", finding.check, finding.value, finding.unit, finding.limit);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Proven(Arc<ProvenData>);

/// All data of a proven cam, shared by its copies.
#[derive(Debug)]
struct ProvenData {
    cam: Cam,
    request: Request,
    /// Everything that determines the part.
    inputs: Vec<Input>,
    /// Their hash.
    hashed: Inputs,
    drawn: Result<Drawn, String>,
    /// The files to cut from, and what was read of them.
    cuts: ProvedCuts,
    /// What was requested for machines to run, with the findings of its judges.
    tool_files: Vec<ProvedToolFile>,
    rolled: Vec<Rolled>,
    findings: Vec<Finding>,
}

impl Drawing {
    /// The body that it is of.
    pub(super) fn body(&self) -> &dyn Body {
        self.cam.body()
    }

    /// Writes the cut files to memory as R2000, reads the outlines back from their bytes, and checks the cam.
    ///
    /// # Errors
    /// [`Error::Proof`] when the bytes do not hold what was drawn: a fault of camgen.
    pub fn prove(self) -> Result<Proven, Error> {
        self.prove_as(Version::default())
    }

    /// As [`Drawing::prove`], in another version of DXF.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{Spec, Version};
    ///
    /// # let motion = camgen::motion::EccentricCircle::new(0.005, 0.040);
    /// let cam = Spec::builder("eccentric").roller(0.010).base_radius(0.030).motion(motion)?.solve()?;
    /// let proven = cam.draw(5e-6)?.prove_as(Version::R12)?;
    /// let dxf = String::from_utf8_lossy(&proven.cut_files()[0]);
    /// assert!(dxf.contains("AC1009"));
    /// # Ok::<(), camgen::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Drawing::prove`].
    pub fn prove_as(self, version: Version) -> Result<Proven, Error> {
        let written = self.written(version)?;
        Ok(self.judged(written, &[]))
    }

    /// The files to cut from in memory, as they are read back.
    pub(super) fn written(&self, version: Version) -> Result<ProvedCuts, Error> {
        let form = DxfForm { version, units: self.body().machine().units() };
        let mark = Inputs::of(&self.inputs).to_string();
        ProvedCuts::of_drawing(&self.drawn_cam(), form, &mark).map_err(Error::Proof)
    }

    /// The cam as its files are written of it.
    fn drawn_cam(&self) -> DrawnCam<'_> {
        DrawnCam { body: self.body(), request: &self.request, drawn: self.drawn() }
    }

    /// Every check, of what was written, with the cams that are cut with it.
    pub(super) fn judged(self, cuts: ProvedCuts, of_others: &[Measure]) -> Proven {
        let body = self.cam.body();
        let hashed = Inputs::of(&self.inputs);
        let tolerance_mm = MILLIMETRES * self.request.fit.tolerance;
        let rolled = rolling::roll_all(body, cuts.outlines(), tolerance_mm);
        let evidence = Evidence {
            drawn: self.drawn(),
            outlines: cuts.outlines(),
            rolled: &rolled,
            cutter_paths: cuts.written_paths(),
            of_others,
            swept: cuts.swept(),
            strict: self.request.strict,
            ..Evidence::without_files(body, tolerance_mm, self.request.fit.motion)
        };
        let tool_files = prove(self.tool_files.clone(), &self.drawn_cam(), &evidence, &hashed.to_string());
        let of_tool_files: Vec<Finding> = tool_files.iter().flat_map(ProvedToolFile::findings).cloned().collect();
        let findings = verify::run(&Evidence { of_tool_files: &of_tool_files, ..evidence });
        let Drawing { cam, request, inputs, drawn, .. } = self;
        Proven(Arc::new(ProvenData { cam, request, inputs, hashed, drawn, cuts, tool_files, rolled, findings }))
    }
}

impl Proven {
    /// What every check found.
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        &self.0.findings
    }

    /// Whether there is an outline and no check failed.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.0.drawn.is_ok() && passed(&self.0.findings)
    }

    /// Why it has no outline, where it has none.
    #[must_use]
    pub fn no_outline(&self) -> Option<&str> {
        self.0.drawn.as_ref().err().map(String::as_str)
    }

    /// What was drawn.
    ///
    /// # Errors
    /// [`Error::NoOutline`] when there is nothing to write.
    pub(super) fn outlined(&self) -> Result<&Drawn, Error> {
        self.0.drawn.as_ref().map_err(|why| Error::NoOutline(why.clone()))
    }

    /// Everything that determines the part.
    pub(super) fn inputs(&self) -> &[Input] {
        &self.0.inputs
    }

    /// Tolerance of its outlines, mm.
    #[must_use]
    pub fn tolerance_mm(&self) -> f64 {
        MILLIMETRES * self.0.request.fit.tolerance
    }

    /// The cam it proves.
    #[must_use]
    pub fn body(&self) -> &dyn Body {
        self.0.cam.body()
    }

    /// What was drawn.
    #[must_use]
    pub fn drawn(&self) -> Option<&Drawn> {
        self.0.drawn.as_ref().ok()
    }

    /// The bytes of the cut files, as they were proved.
    #[must_use]
    pub fn cut_files(&self) -> &[Vec<u8>] {
        self.0.cuts.cuts()
    }

    /// The outlines as another program would find them in the cut files.
    #[must_use]
    pub fn outlines(&self) -> &[WrittenOutline] {
        self.0.cuts.outlines()
    }

    /// What rolling the follower on the written outline has shown, of a plane cam.
    #[must_use]
    pub fn rolled(&self) -> Option<&Rolled> {
        self.0.rolled.first()
    }

    /// The report, without files.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{Machine, Report, Spec};
    ///
    /// let (machine, _) = Machine::load("feeder", &[])?;
    /// let proven = Spec::of_program(machine, None).ok_or("no motion")?.solve()?.draw(10e-6)?.prove()?;
    /// let json = serde_json::to_string_pretty(&proven.report())?;
    /// // Another program reads it back.
    /// let report: Report = serde_json::from_str(&json)?;
    /// assert_eq!(report.machine, "Feeder");
    /// assert!(report.section("outline").is_some() && report.passed());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn report(&self) -> Report {
        self.report_with(Vec::new(), self.no_outline())
    }

    /// The files of this kind, where they were requested with the drawing.
    fn tool_file(&self, file: &dyn ToolFile) -> Option<&ProvedToolFile> {
        self.0.tool_files.iter().find(|proved| proved.file().facts().check.name == file.facts().check.name)
    }

    /// The cam as its files are written of it.
    fn drawn_cam(&self) -> DrawnCam<'_> {
        DrawnCam { body: self.body(), request: &self.0.request, drawn: self.drawn() }
    }

    /// What its files are judged by.
    fn evidence(&self) -> Evidence<'_> {
        let request = &self.0.request;
        Evidence {
            drawn: self.drawn(),
            outlines: self.outlines(),
            rolled: &self.0.rolled,
            strict: request.strict,
            ..Evidence::without_files(self.body(), self.tolerance_mm(), request.fit.motion)
        }
    }

    /// The endings of the names of the files of a format.
    ///
    /// # Errors
    /// [`Error::NoOutline`] when there is nothing to write.
    pub fn endings(&self, format: &Format) -> Result<Vec<String>, Error> {
        let drawn = self.outlined()?;
        Ok(match format.source {
            Listed::View(view) => (view.endings)(drawn),
            Listed::Cut(cut) => (cut.endings)(drawn),
            Listed::Tool(file) => {
                let proved = self.tool_file(file);
                proved.map_or_else(Vec::new, |proved| proved.endings(format.name, &self.drawn_cam()))
            }
        })
    }

    /// The files of a format: of one that a machine runs those that were proved.
    pub(super) fn written_in(&self, format: &Format, rendering: &Rendering<'_>) -> Result<Vec<Vec<u8>>, Refusal> {
        let file = match format.source {
            Listed::View(view) => return (view.write)(rendering),
            Listed::Cut(cut) => return Ok(bytes_of(&(cut.files)(&self.0.cuts, rendering)?)),
            Listed::Tool(file) => file,
        };
        let proved = self.tool_file(file).ok_or_else(|| Refusal::new(file.facts().not_planned))?;
        let files = if warning(&self.0.findings).is_some() {
            proved.files_under(&rendering.report.mark(), format.name, &self.drawn_cam(), &self.evidence())?
        } else {
            proved.files(format.name)?
        };
        let mut all = bytes_of(&files);
        all.extend(proved.sheets(rendering)?);
        Ok(all)
    }

    /// The sections of the report with these figures, by their paths; `None` for all.
    pub(super) fn sections(&self, wanted: Option<&[String]>) -> Vec<Section> {
        let rolled = &self.0.rolled;
        let found = DrawingEvidence { drawn: self.drawn(), rolled, tolerance_mm: self.tolerance_mm(), wanted };
        let mut sections = self.body().sections(&found);
        sections.extend(tool_files().filter_map(|file| self.tool_file(file)?.section().cloned()));
        sections
    }

    /// The report with more sections, and with the reason why there is no outline of a cam that belongs to it.
    pub(super) fn report_with(&self, more: Vec<Section>, no_outline: Option<&str>) -> Report {
        let sections = self.sections(None).into_iter().chain(more).collect();
        let mut report = report(self.body(), self.0.hashed.clone(), sections, self.0.findings.clone());
        report.notes.extend(no_outline.map(|why| text!("there is no outline: {}", why)));
        report
    }

    /// The report, made when it is first read.
    #[must_use]
    pub fn lazy_report(&self) -> LazyReport {
        let proven = self.clone();
        LazyReport::new(Box::new(move || proven.report()))
    }

    /// The point table with so many rows over a turn of the cam, or steps over the stroke of a plate.
    ///
    /// ```
    /// # use camgen_cams as camgen;
    /// use camgen::{Machine, Spec};
    ///
    /// let (machine, _) = Machine::load("feeder", &[])?;
    /// let proven = Spec::of_program(machine, None).ok_or("no motion")?.solve()?.draw(10e-6)?.prove()?;
    /// let table = proven.table(360);
    /// let column = |name: &str| table.columns.iter().position(|column| *column == name).ok_or("no such column");
    /// let (angle, lift) = (column("cam_deg")?, column("lift_mm")?);
    /// assert_eq!((table.rows.len(), table.rows[90][angle]), (360, 90.0));
    /// assert!(table.rows.iter().all(|row| row[lift] < 30.001));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn table(&self, samples: u32) -> Table {
        csv::table(self.body(), None, self.outlines(), samples)
    }

    /// The cam as the formats see it, with a report and the template of the sheet.
    ///
    /// # Errors
    /// [`Error::NoOutline`] when there is nothing to write.
    pub fn rendering<'a>(
        &'a self,
        report: &'a (dyn Deref<Target = Report> + Sync),
        samples: u32,
        template: &'a str,
    ) -> Result<Rendering<'a>, Error> {
        let drawn = self.outlined()?;
        let body = self.0.cam.body();
        Ok(Rendering {
            body,
            other_cams: &[],
            drawn,
            outlines: self.outlines(),
            fit: self.0.request.fit,
            cutter_radius: self.0.request.cutter_radius,
            findings: &self.0.findings,
            report,
            samples,
            template,
            part_files: &[],
            #[cfg(feature = "live")]
            live: None,
            created: None,
        })
    }
}

/// The bytes of files.
fn bytes_of(files: &[ProvedFile]) -> Vec<Vec<u8>> {
    files.iter().map(|file| file.bytes().to_vec()).collect()
}

//! A drawing with its proof: the bytes of its cut files, and what every check found of them.

use super::{Cam, Drawing, Error, report};
use crate::body::{Body, DrawingEvidence, Drawn, Request};
use crate::check::Measure;
use crate::report::{Finding, Inputs, LazyReport, Report, Rolled, Section, passed, warning};
use crate::table::Table;
use crate::tool_files::{DrawnCam, Format, Listed, ProvedToolFile, ToolFile, prove, tool_files};
use crate::verify::{self, Evidence, WrittenOutline, WrittenPath, WrittenSwept, rolling};
use crate::write::Rendering;
use crate::write::csv;
use crate::write::dxf::{DxfForm, Version};
use crate::write::{proof, step};
use camgen_kernel::document::Input;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::outline::{Outline, OutlineError};
use camgen_kernel::refusal::Refusal;
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
    /// The bytes of the cut files, one for each part.
    cut_files: Vec<Vec<u8>>,
    /// What was requested for machines to run, with the findings of its judges.
    tool_files: Vec<ProvedToolFile>,
    version: Version,
    outlines: Vec<WrittenOutline>,
    rolled: Vec<Rolled>,
    findings: Vec<Finding>,
}

/// The cut files of a drawing in memory, and what is in them.
pub(super) struct WrittenCuts {
    swept: Option<WrittenSwept>,
    cut_files: Vec<Vec<u8>>,
    outlines: Vec<WrittenOutline>,
    rolled: Vec<Rolled>,
    inputs: Inputs,
}

impl WrittenCuts {
    /// The outlines as read back.
    pub(super) fn outlines(&self) -> &[WrittenOutline] {
        &self.outlines
    }
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
        Ok(self.judged(version, written, &[]))
    }

    /// The cut files in memory as they are read back, and what rolling on the first shows.
    pub(super) fn written(&self, version: Version) -> Result<WrittenCuts, Error> {
        let body = self.cam.body();
        let inputs = Inputs::of(&self.inputs);
        let mark = inputs.to_string();
        let form = DxfForm { version, units: body.machine().units() };
        let (mut cut_files, mut outlines) = (Vec::new(), Vec::new());
        for part in self.drawn.iter().flat_map(|drawn| &drawn.parts) {
            // The proof is of the bytes that would be cut, not of the drawing they were made from.
            let written = proof::write_marked(part, form, &mark).map_err(Error::Proof)?;
            cut_files.push(written.bytes);
            for contour in written.outlines {
                let (cut, others) = (outlines.len(), written.others.clone());
                outlines.push(WrittenOutline { cut, z: part.z, contour, others });
            }
        }
        let tolerance_mm = MILLIMETRES * self.request.fit.tolerance;
        let mut swept = None;
        for drawing in self.drawn.iter().filter_map(|drawn| drawn.swept.as_deref()) {
            let solid = step::write(&drawing.solid, "", None);
            let mut read = WrittenSwept::of_solid(body, &solid, tolerance_mm).map_err(Error::Proof)?;
            if !drawing.developed.is_empty() {
                let unrolled = proof::developed(&drawing.developed, form, &mark).map_err(Error::Proof)?;
                read = read.with(WrittenSwept::of_unrolled(body, &unrolled, proof::JOIN).map_err(Error::Proof)?);
                cut_files.push(unrolled);
            }
            swept = Some(read);
        }
        let rolled = rolling::roll_all(body, &outlines, tolerance_mm);
        Ok(WrittenCuts { swept, cut_files, outlines, rolled, inputs })
    }

    /// The paths of a cutter as another program would read them.
    fn written_paths(&self, version: Version) -> Vec<WrittenPath> {
        let (middle, _) = self.request.fit.band();
        let form = DxfForm { version, units: self.cam.body().machine().units() };
        let paths = self.drawn.iter().flat_map(Drawn::cutter_paths).enumerate();
        let written_path = |(cut, outline): (usize, &Result<Outline, OutlineError>)| {
            let read = match outline {
                Ok(outline) => proof::cutter_path(outline, form).map_err(|error| error.to_string()),
                Err(error) => Err(error.to_string()),
            };
            let (contour, lead_ins) = match read {
                Ok((contour, lead_ins)) => (Ok(contour), lead_ins),
                Err(why) => (Err(why), Vec::new()),
            };
            let radius = self.request.cutter_radius?;
            Some(WrittenPath { cut, radius: MILLIMETRES * radius, middle: MILLIMETRES * middle, contour, lead_ins })
        };
        paths.filter_map(written_path).collect()
    }

    /// Every check, of what was written, with the cams that are cut with it.
    pub(super) fn judged(self, version: Version, written: WrittenCuts, of_others: &[Measure]) -> Proven {
        let WrittenCuts { swept, cut_files, outlines, rolled, inputs: hashed } = written;
        let body = self.cam.body();
        let tolerance_mm = MILLIMETRES * self.request.fit.tolerance;
        let cutter_paths = self.written_paths(version);
        let evidence = Evidence {
            drawn: self.drawn.as_ref().ok(),
            outlines: &outlines,
            rolled: &rolled,
            cutter_paths: &cutter_paths,
            of_others,
            swept: swept.as_ref(),
            strict: self.request.strict,
            ..Evidence::without_files(body, tolerance_mm, self.request.fit.motion)
        };
        let drawn_cam = DrawnCam { body, request: &self.request, drawn: self.drawn.as_ref().ok() };
        let tool_files = prove(self.tool_files, &drawn_cam, &evidence, &hashed.to_string());
        let of_tool_files: Vec<Finding> = tool_files.iter().filter_map(ProvedToolFile::finding).cloned().collect();
        let findings = verify::run(&Evidence { of_tool_files: &of_tool_files, ..evidence });
        let (cam, request, inputs, drawn) = (self.cam, self.request, self.inputs, self.drawn);
        Proven(Arc::new(ProvenData {
            cam,
            request,
            inputs,
            hashed,
            drawn,
            cut_files,
            tool_files,
            version,
            outlines,
            rolled,
            findings,
        }))
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
        &self.0.cut_files
    }

    /// The outlines as another program would find them in the cut files.
    #[must_use]
    pub fn outlines(&self) -> &[WrittenOutline] {
        &self.0.outlines
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
        self.0.tool_files.iter().find(|proved| proved.file().check().name == file.check().name)
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
            outlines: &self.0.outlines,
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
            Listed::Tool(file) => file,
        };
        let proved = self.tool_file(file).ok_or_else(|| file.not_planned())?;
        let files = if warning(&self.0.findings).is_some() {
            proved.files_under(&rendering.report.mark(), format.name, &self.drawn_cam(), &self.evidence())?
        } else {
            proved.files(format.name)?
        };
        if files.is_empty() {
            return Err(file.not_planned());
        }
        let mut all: Vec<Vec<u8>> = files.iter().map(|file| file.bytes().to_vec()).collect();
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
        report.notes.extend(no_outline.map(|why| format!("there is no outline: {why}")));
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
        csv::table(self.body(), None, &self.0.outlines, samples)
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
        let (body, cut_files, dxf_version) = (self.0.cam.body(), &self.0.cut_files, self.0.version);
        Ok(Rendering {
            body,
            other_cams: &[],
            drawn,
            outlines: &self.0.outlines,
            cut_files,
            fit: self.0.request.fit,
            cutter_radius: self.0.request.cutter_radius,
            dxf_version,
            findings: &self.0.findings,
            report,
            samples,
            template,
            #[cfg(feature = "live")]
            live: None,
            created: None,
        })
    }
}

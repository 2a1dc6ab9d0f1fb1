//! A drawing with its proof: the bytes of its cut files, and what every check found of them.

use super::{Cam, Drawing, Error, report};
use crate::body::gauge;
use crate::body::inspection::{self, InspectionList};
use crate::body::milling::{self, MillingProgram, TurnedPath};
use crate::body::points::{PointErrors, PointTable, by_travel, swings};
use crate::body::servo::ServoTable;
use crate::body::{Body, DrawingEvidence, Drawn, Request};
use crate::check::Measure;
use crate::reading::gauge as read_gauge;
use crate::reading::gcode::{self as read_gcode, CutterMove, MoveKind};
use crate::reading::servo as read_servo;
use crate::report::{
    AsCutError, Finding, Inputs, LazyReport, PointMeasures, ProgramMeasures, Report, Rolled, Section, passed,
};
use crate::table::Table;
use crate::verify::WrittenInspection;
use crate::verify::{
    self, Evidence, WrittenOutline, WrittenPath, WrittenPoints, WrittenProgram, WrittenServo, WrittenSwept, rolling,
};
use crate::write::Rendering;
use crate::write::csv;
use crate::write::dxf::{DxfForm, Version};
use crate::write::gauge as write_gauge;
use crate::write::inspection as write_inspection;
use crate::write::{gcode, points, proof, servo, step};
use camgen_kernel::document::{Input, NamedChoice};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::points::{Interpolant, PointInterpolation};
use camgen_kernel::profile::outline::{Outline, OutlineError};
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
    /// The bytes of the tables of points, one for each part, when they were requested.
    points: Vec<Vec<u8>>,
    /// The bytes of the programs for a milling machine, one for each part, when they were requested.
    programs: Vec<Vec<u8>>,
    /// The tables for servo drives by their formats, when they were requested.
    servo: Vec<(&'static str, Vec<u8>)>,
    /// The lists of places for a measuring machine with their files, when they were requested.
    inspections: Vec<(InspectionList, Vec<Vec<u8>>)>,
    /// The lift table of a gauge follower, when it was requested.
    gauge: Option<Vec<u8>>,
    /// The figures of those programs, for the report.
    program_measures: Vec<ProgramMeasures>,
    /// The figures of those tables, for the report.
    point_measures: Vec<PointMeasures>,
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
        let point_measures = self.points.iter().flatten().map(|table| measures(body, table)).collect();
        let (points, tables) = written_points(body, &self.request, self.points);
        let (programs, read_programs) =
            written_programs(body, &self.request, self.drawn.as_ref().ok(), &hashed.to_string());
        let (servo, read_servo) = written_servo(body, self.servo.as_ref(), &hashed.to_string());
        let (inspections, places) = written_inspections(body, &self.request, &hashed.to_string());
        let gauge =
            gauge::table(body, &self.request).map(|table| write_gauge::write(body, &table, &hashed.to_string()));
        let read_gauge = gauge.as_deref().map(read_gauge::read);
        let program_measures = program_measures(self.drawn.as_ref().ok(), read_programs.as_ref());
        let findings = verify::run(&Evidence {
            drawn: self.drawn.as_ref().ok(),
            outlines: &outlines,
            rolled: &rolled,
            cutter_paths: &cutter_paths,
            points: tables.as_ref(),
            programs: read_programs.as_ref(),
            servo: read_servo.as_ref(),
            inspections: &places,
            gauge: read_gauge.as_ref(),
            of_others,
            swept: swept.as_ref(),
            strict: self.request.strict,
            ..Evidence::without_files(body, tolerance_mm, self.request.fit.motion)
        });
        let (cam, request, inputs, drawn) = (self.cam, self.request, self.inputs, self.drawn);
        Proven(Arc::new(ProvenData {
            cam,
            request,
            inputs,
            hashed,
            drawn,
            cut_files,
            points,
            programs,
            servo,
            inspections,
            gauge,
            program_measures,
            point_measures,
            version,
            outlines,
            rolled,
            findings,
        }))
    }
}

/// The tables of points in memory, and the curves that a control makes of their bytes; none when they were not requested.
#[expect(clippy::type_complexity, reason = "bytes, and what is read in them")]
fn written_points(
    body: &dyn Body,
    request: &Request,
    tables: Result<Vec<PointTable>, String>,
) -> (Vec<Vec<u8>>, Option<Result<Vec<WrittenPoints>, String>>) {
    let tables = match tables {
        Ok(tables) if tables.is_empty() => return (Vec::new(), None),
        Ok(tables) => tables,
        Err(why) => return (Vec::new(), Some(Err(why))),
    };
    let files: Vec<Vec<u8>> = tables.iter().map(|table| points::write(body, table)).collect();
    let read = |(table, bytes): (PointTable, &Vec<u8>)| {
        let curve = points::read(bytes)
            .and_then(|read| read.goes_round().map(|()| read))
            .map(|read| Interpolant::new(&table.turned(&read.rows), read.form, read.between, read.closed));
        WrittenPoints { table, cutter: request.cutter_radius, curve }
    };
    let written = tables.into_iter().zip(&files).map(read).collect();
    (files, Some(Ok(written)))
}

/// The programs for a milling machine in memory, and what their control reads in their bytes; none when they were not requested.
#[expect(clippy::type_complexity, reason = "bytes, and what is read in them")]
fn written_programs(
    body: &dyn Body,
    request: &Request,
    drawn: Option<&Drawn>,
    mark: &str,
) -> (Vec<Vec<u8>>, Option<Result<Vec<WrittenProgram>, String>>) {
    let programs = match drawn.map(|drawn| &drawn.programs) {
        Some(Ok(programs)) if !programs.is_empty() => programs,
        Some(Err(why)) => return (Vec::new(), Some(Err(why.clone()))),
        _ => return (Vec::new(), None),
    };
    let files: Vec<Vec<u8>> = programs.iter().map(|program| gcode::write(body, program, &[mark.to_owned()])).collect();
    let read = |(program, bytes): (&MillingProgram, &Vec<u8>)| WrittenProgram {
        cuts: program.cuts.clone(),
        cutter: program.cutter.map(|radius| MILLIMETRES * radius),
        kept: request.cutter_radius.filter(|_| program.cutter.is_none()).map(|radius| MILLIMETRES * radius),
        middle: MILLIMETRES * request.fit.band().0,
        depth: milling::depth_of(body),
        program: read_gcode::read_for(bytes, Some(program.controller)).map_err(|why| why.to_string()),
    };
    let written = programs.iter().zip(&files).map(read).collect();
    (files, Some(Ok(written)))
}

/// The tables for servo drives in memory, and what is read in their bytes; none when they were not requested.
#[expect(clippy::type_complexity, reason = "bytes, and what is read in them")]
fn written_servo(
    body: &dyn Body,
    table: Option<&ServoTable>,
    mark: &str,
) -> (Vec<(&'static str, Vec<u8>)>, Option<Result<Vec<WrittenServo>, String>>) {
    let Some(table) = table else { return (Vec::new(), None) };
    let files = servo::write(body, table, mark);
    let read = files.iter().map(|(format, bytes)| WrittenServo { format, table: read_servo::read(bytes) }).collect();
    (files, Some(Ok(read)))
}

/// The lists of places for a measuring machine in memory, and what is read in the bytes of each of their files; none when they were not requested.
#[expect(clippy::type_complexity, reason = "bytes, and what is read in them")]
fn written_inspections(
    body: &dyn Body,
    request: &Request,
    mark: &str,
) -> (Vec<(InspectionList, Vec<Vec<u8>>)>, Vec<WrittenInspection>) {
    let (mut lists, mut read) = (Vec::new(), Vec::new());
    for list in inspection::lists(body, request) {
        let files = write_inspection::write(body, &list, mark);
        read.extend(files.iter().map(|bytes| WrittenInspection::of(list.cut, bytes)));
        lists.push((list, files));
    }
    (lists, read)
}

/// The figures of programs as they were read, for the report.
fn program_measures(drawn: Option<&Drawn>, read: Option<&Result<Vec<WrittenProgram>, String>>) -> Vec<ProgramMeasures> {
    let (Some(Ok(programs)), Some(Ok(read))) = (drawn.map(|drawn| &drawn.programs), read) else { return Vec::new() };
    let of = |(program, written): (&MillingProgram, &WrittenProgram)| {
        let found = written.program.as_ref().ok()?;
        let moves = &found.moves;
        if let (Some(path), false) = (&program.turned, found.turned.is_empty()) {
            return Some(turned_measures(program, path));
        }
        let at_feed = || moves.iter().filter(|moved| moved.kind != MoveKind::Rapid);
        let along: f64 = at_feed().flat_map(CutterMove::segments).map(|segment| segment.length()).sum();
        let down: f64 = at_feed().map(|moved| (moved.to[2] - moved.from[2]).abs()).sum();
        let seconds = (along / program.cutting.feed + down / program.cutting.plunge_feed) / MILLIMETRES;
        Some(ProgramMeasures {
            controller: program.controller.word(),
            moves: moves.len(),
            passes: program.depths.len() * program.passes.len(),
            depth_mm: program.depths.last().copied().unwrap_or(0.0),
            length_mm: along + down,
            minutes: seconds / 60.0,
        })
    };
    programs.iter().zip(read).filter_map(of).collect()
}

/// The figures of a program that turns the cam under its tool.
fn turned_measures(program: &MillingProgram, path: &TurnedPath) -> ProgramMeasures {
    let depths = program.depths.len();
    let around: f64 = path.rounds.iter().flat_map(|round| &round.lengths).sum();
    #[expect(clippy::cast_precision_loss, reason = "at most a thousand passes")]
    let length_mm = depths as f64 * around;
    ProgramMeasures {
        controller: program.controller.word(),
        moves: depths * path.rounds.iter().map(|round| round.rows.len()).sum::<usize>(),
        passes: depths * path.rounds.len(),
        depth_mm: program.depths.last().copied().unwrap_or(0.0),
        length_mm,
        minutes: length_mm / (MILLIMETRES * program.cutting.feed) / 60.0,
    }
}

/// The figures of a table, for the report.
fn measures(body: &dyn Body, table: &PointTable) -> PointMeasures {
    let swings = swings(body);
    let by_travel = by_travel(body);
    let sizes = AsCutError::sizes(swings, by_travel);
    let [velocity, acceleration] = match table.errors {
        PointErrors::Known([velocity, acceleration]) => {
            [sizes[0] * velocity, sizes[1] * acceleration].map(|error| Some(error).filter(|error| error.is_finite()))
        }
        PointErrors::Unknown(_) => [None; 2],
    };
    PointMeasures {
        rpm: table.rpm,
        rows: table.rows.rows.len(),
        interpolation: if table.wish.between == PointInterpolation::Linear { "linear" } else { "cubic" },
        tolerance_mm: table.wish.tolerance,
        error_mm: table.rows.error,
        swings,
        by_travel,
        velocity_error: velocity,
        acceleration_error: acceleration,
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

    /// The sections of the report with these figures, by their paths; `None` for all.
    pub(super) fn sections(&self, wanted: Option<&[String]>) -> Vec<Section> {
        let ProvenData { rolled, point_measures, program_measures, .. } = &*self.0;
        let found = DrawingEvidence { drawn: self.drawn(), rolled, tolerance_mm: self.tolerance_mm(), wanted };
        let mut sections = self.body().sections(&found);
        sections.extend(PointMeasures::section(point_measures));
        sections.extend(ProgramMeasures::section(program_measures));
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
            points: &self.0.points,
            programs: &self.0.programs,
            servo: &self.0.servo,
            inspections: &self.0.inspections,
            gauge: self.0.gauge.as_deref(),
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

//! A drawing with its proof: the bytes of its cut files, and what every check found of them.

use super::{Cam, Drawing, Error, FileSet, Writing, file_set, report};
use crate::body::disc::AtSpeed;
use crate::body::points::{Judged, PointTable, swings};
use crate::body::{Body, Drawn, Found, Request, torque};
use crate::document::Input;
use crate::geometry::MILLIMETRES;
use crate::geometry::points::{Between, Interpolant};
use crate::numeric::parallel;
use crate::profile::lifts;
use crate::report::{Compensation, Finding, Inputs, PointMeasures, PreloadAt, Report, Rolled, Told, passed};
use crate::table::Table;
use crate::verify::{self, Evidence, WrittenOutline, WrittenPath, WrittenPoints, rolling};
use crate::write::Rendering;
use crate::write::csv;
use crate::write::dxf::Version;
use crate::write::{points, proof};
use std::ops::Deref;

/// A cam whose cut files were written to memory, read back, and checked.
#[derive(Debug)]
pub struct Proven<'c> {
    pub(super) cam: &'c Cam,
    request: Request,
    /// Everything that determines the part.
    pub(super) inputs: Vec<Input>,
    /// Their hash.
    hashed: Inputs,
    pub(super) drawn: Result<Drawn, String>,
    /// The bytes of the cut files, one for each part.
    cut_files: Vec<Vec<u8>>,
    /// The bytes of the tables of points, one for each part, when they were requested.
    points: Vec<Vec<u8>>,
    /// What the report tells of them.
    points_told: Vec<PointMeasures>,
    version: Version,
    outlines: Vec<WrittenOutline>,
    rolled: Option<Rolled>,
    findings: Vec<Finding>,
    /// The disc that takes its torque.
    second: Option<Box<Self>>,
}

/// The cut files of a drawing in memory, and what is in them.
struct Written {
    cut_files: Vec<Vec<u8>>,
    outlines: Vec<WrittenOutline>,
    rolled: Option<Rolled>,
    inputs: Inputs,
}

impl<'c> Drawing<'c> {
    /// Writes the cut files to memory as R2000, reads the outlines back from their bytes, and checks the cam.
    ///
    /// # Errors
    /// [`Error::Proof`] when the bytes do not hold what was drawn: a fault of camgen.
    pub fn prove(self) -> Result<Proven<'c>, Error> {
        self.prove_as(Version::default())
    }

    /// As [`Drawing::prove`], in another version of DXF.
    ///
    /// # Errors
    /// As [`Drawing::prove`].
    pub fn prove_as(self, version: Version) -> Result<Proven<'c>, Error> {
        let mut drawing = self;
        let second = drawing.second.take().map(|second| || second.prove_as(version));
        let (written, second) = parallel::both(|| drawing.written(version), second);
        let second = second.transpose()?.map(Box::new);
        drawing.judged(version, written?, second)
    }

    /// The cut files in memory as they are read back, and what rolling on the first shows.
    fn written(&self, version: Version) -> Result<Written, Error> {
        let body = self.cam.body();
        let inputs = Inputs::of(&self.inputs);
        let mark = inputs.to_string();
        let (mut cut_files, mut outlines) = (Vec::new(), Vec::new());
        for part in self.drawn.iter().flat_map(|drawn| &drawn.parts) {
            // The proof is of the bytes that would be cut, not of the drawing they were made from.
            let written = proof::write_marked(part, version, &mark)?;
            cut_files.push(written.bytes);
            outlines.push(WrittenOutline { z: part.z, contour: written.outline, beside: written.beside });
        }
        let tolerance_mm = MILLIMETRES * self.request.fit.tolerance;
        let plane = body.plane().zip(outlines.first());
        let rolled = plane.map(|(curves, outline)| rolling::roll(body, curves, &outline.contour, tolerance_mm));
        Ok(Written { cut_files, outlines, rolled, inputs })
    }

    /// Every check, of what was written.
    fn judged(self, version: Version, written: Written, second: Option<Box<Proven<'c>>>) -> Result<Proven<'c>, Error> {
        let Written { cut_files, outlines, rolled, inputs: hashed } = written;
        let body = self.cam.body();
        let tolerance_mm = MILLIMETRES * self.request.fit.tolerance;
        let (middle, _) = self.request.fit.band();
        let path = self.drawn.as_ref().ok().and_then(|drawn| drawn.cutter_path.as_ref()).zip(self.request.cutter);
        let cutter_path = path.map(|(outline, radius)| {
            let contour = match outline {
                Ok(outline) => proof::cutter_path(&outline.contour, version).map_err(|error| error.to_string()),
                Err(error) => Err(error.to_string()),
            };
            WrittenPath { radius: MILLIMETRES * radius, middle: MILLIMETRES * middle, contour }
        });
        let points_told = self.points.iter().flatten().map(|table| measures(body, table)).collect();
        let (points, tables) = written_points(body, &self.request, self.points);
        let findings = verify::run(&Evidence {
            body,
            drawn: self.drawn.as_ref().ok(),
            outlines: &outlines,
            rolled: rolled.as_ref(),
            foreign: None,
            cutter_path: cutter_path.as_ref(),
            points: tables.as_ref(),
            compensator: second.as_ref().map(|second| second.findings.as_slice()),
            solid: None,
            tolerance_mm,
            motion: self.request.fit.motion,
            strict: self.request.strict,
        });
        let (cam, request, inputs, drawn) = (self.cam, self.request, self.inputs, self.drawn);
        Ok(Proven {
            cam,
            request,
            inputs,
            hashed,
            drawn,
            cut_files,
            points,
            points_told,
            version,
            outlines,
            rolled,
            findings,
            second,
        })
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
            .map(|read| Interpolant::new(&table.turned(&read.rows), read.form, read.between, read.closed));
        WrittenPoints { table, cutter: request.cutter, curve }
    };
    let written = tables.into_iter().zip(&files).map(read).collect();
    (files, Some(Ok(written)))
}

fn preload_at(at: &AtSpeed) -> PreloadAt {
    PreloadAt {
        rpm: at.rpm,
        preload_n: at.preload,
        torque_before_max_nm: at.before,
        torque_unchanged_max_nm: at.unchanged,
        torque_after_max_nm: at.after,
    }
}

/// What the report tells of a table.
fn measures(body: &dyn Body, table: &PointTable) -> PointMeasures {
    let swings = swings(body);
    let unit = if swings { 1.0 } else { MILLIMETRES };
    let [velocity, acceleration] = match table.felt {
        Judged::Errors(errors) => errors.map(|error| Some(unit * error).filter(|error| error.is_finite())),
        Judged::Not(_) => [None; 2],
    };
    PointMeasures {
        rpm: table.rpm,
        rows: table.rows.rows.len(),
        interpolation: if table.wish.between == Between::Linear { "linear" } else { "cubic" },
        tolerance_mm: table.wish.tolerance,
        error_mm: table.rows.error,
        swings,
        velocity_error: velocity,
        acceleration_error: acceleration,
    }
}

impl Proven<'_> {
    /// What every check found.
    #[must_use]
    pub fn findings(&self) -> &[Finding] {
        &self.findings
    }

    /// Whether there is an outline and no check failed.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.drawn.is_ok() && passed(&self.findings) && self.second.as_ref().is_none_or(|second| second.passed())
    }

    /// Why there is no outline, when there is none.
    #[must_use]
    pub fn no_outline(&self) -> Option<&str> {
        self.drawn.as_ref().err().map(String::as_str).or(self.second.as_ref().and_then(|second| second.no_outline()))
    }

    /// The disc that takes its torque, where there is one.
    #[must_use]
    pub fn second(&self) -> Option<&Proven<'_>> {
        self.second.as_deref()
    }

    /// What that disc does, for the report.
    fn compensation(&self) -> Option<Compensation> {
        let (second, (_, told)) = (self.second.as_deref()?, self.cam.second.as_ref()?);
        let (body, machine) = (second.cam.body(), self.cam.body().machine());
        let (curves, data) = (body.plane()?, machine.compensator()?);
        let both = self.outlines.first().zip(second.outlines.first());
        let part = second.drawn().and_then(|drawn| drawn.parts.first());
        let tolerance_mm = MILLIMETRES * self.request.fit.tolerance;
        let prime_radius_mm = MILLIMETRES * curves.follower.prime_radius()?;
        Some(Compensation {
            lift_max_mm: MILLIMETRES * lifts(curves.motion).1,
            prime_radius_mm,
            base_radius_mm: prime_radius_mm - MILLIMETRES * data.roller_radius,
            roller_radius_mm: MILLIMETRES * data.roller_radius,
            angle_deg: data.angle.to_degrees(),
            work_j: told.work,
            spring_force_max_n: told.spring_force,
            torque_before_max_nm: told.before,
            torque_after_max_nm: told.after,
            torque_as_cut_max_nm: both
                .and_then(|(first, second)| torque::left((self.cam.body(), &first.contour), (body, &second.contour))),
            preload_by_rpm: told.by_speed.iter().map(preload_at).collect(),
            outline: part.map(|part| part.measures(tolerance_mm, |_| false)),
            rolling: second.rolled.clone(),
            checks: second.findings.clone(),
        })
    }

    /// The cam it proves.
    #[must_use]
    pub fn body(&self) -> &dyn Body {
        self.cam.body()
    }

    /// What was drawn.
    #[must_use]
    pub fn drawn(&self) -> Option<&Drawn> {
        self.drawn.as_ref().ok()
    }

    /// The bytes of the cut files, as they were proved.
    #[must_use]
    pub fn cut_files(&self) -> &[Vec<u8>] {
        &self.cut_files
    }

    /// The outlines as another program would find them in the cut files.
    #[must_use]
    pub fn outlines(&self) -> &[WrittenOutline] {
        &self.outlines
    }

    /// What rolling the follower on the written outline has shown, of a plane cam.
    #[must_use]
    pub fn rolled(&self) -> Option<&Rolled> {
        self.rolled.as_ref()
    }

    /// The report, without files.
    #[must_use]
    pub fn report(&self) -> Report {
        let body = self.cam.body();
        let found = Found {
            drawn: self.drawn(),
            rolled: self.rolled.as_ref(),
            tolerance_mm: MILLIMETRES * self.request.fit.tolerance,
        };
        let mut sections = body.sections(&found);
        sections.extend(PointMeasures::section(&self.points_told));
        sections.extend(self.compensation().map(|told| told.section()));
        let mut report = report(body, self.hashed.clone(), sections, self.findings.clone());
        report.notes.extend(self.no_outline().map(|why| format!("there is no outline: {why}")));
        report
    }

    /// The same, made when somebody looks into it.
    #[must_use]
    pub fn told(&self) -> Told<'_> {
        Told::new(Box::new(|| self.report()))
    }

    /// The point table with so many rows over a turn of the cam, or steps over the stroke of a plate.
    #[must_use]
    pub fn table(&self, samples: u32) -> Table {
        csv::table(self.cam.body(), self.second_body(), &self.outlines, samples)
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
        let drawn = self.drawn.as_ref().map_err(|why| Error::NoOutline(why.clone()))?;
        let (body, cut_files, dxf_version) = (self.cam.body(), &self.cut_files, self.version);
        Ok(Rendering {
            body,
            second: self.second.as_ref().map(|second| (second.cam.body(), second.outlines())),
            drawn,
            outlines: &self.outlines,
            cut_files,
            points: &self.points,
            fit: self.request.fit,
            dxf_version,
            findings: &self.findings,
            report,
            samples,
            template,
            created: None,
        })
    }

    fn second_body(&self) -> Option<&dyn Body> {
        self.second.as_ref().map(|second| second.cam.body())
    }

    /// Makes the files in memory.
    ///
    /// # Errors
    /// [`Error::Refused`] when a check failed and `writing.force` is not set; [`Error::NoOutline`], [`Error::Unfit`],
    /// [`Error::Format`].
    pub fn files(&self, writing: &Writing) -> Result<FileSet<'_>, Error> {
        file_set::files(self, writing)
    }
}

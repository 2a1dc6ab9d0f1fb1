//! The proof of a cutter's path and of a table of points that were edited or written by another program.

use super::check::CutSection;
use super::{Cam, Error, ExpectedFile, diagnosis, heads, report};
use crate::body::milling::{depth_of, widest_cutter};
use crate::body::points::{
    PointCurve, PointErrors, PointTable, largest_errors, motion_errors, radius_of_roller, traced,
};
use crate::body::{Layer, Request};
use crate::reading::gauge as read_gauge;
use crate::reading::gcode::{self, CutterProgram, CutterSide, MoveKind};
use crate::reading::servo;
use crate::reading::table as read_table;
use crate::reading::{self, Chain};
use crate::report::{Finding, Inputs, Report, Section, Verdict};
use crate::verify::{
    self, Evidence, WrittenInspection, WrittenPath, WrittenPoints, WrittenProgram, WrittenServo, WrittenSwept,
    join_reach,
};
use crate::write::points;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::points::{Interpolant, PointInterpolation, PointRows, PointTableSpec};
use camgen_kernel::refusal::Refusal;

/// Whether radius compensation is on for at least half of the level cutting moves.
fn keeps_its_cutter(program: &CutterProgram) -> bool {
    let level = |moved: &&gcode::CutterMove| {
        moved.kind != MoveKind::Rapid && moved.from[2] < 0.0 && moved.is_level() && !moved.is_upright()
    };
    let cuts = program.moves.iter().filter(level).count();
    let kept = program.moves.iter().filter(level).filter(|moved| moved.side != CutterSide::Centre).count();
    // A cam turned under its tool has passes instead of moves, without compensation.
    program.turned.is_empty() && 2 * kept >= cuts
}

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
        Ok(self.report_on("path of a cutter", request, checks))
    }

    /// Whether a table of points is one of this cam.
    pub(super) fn check_points(
        &self,
        bytes: &[u8],
        expected: &ExpectedFile<'_>,
        request: &Request,
    ) -> Result<Report, Error> {
        let not_a_table = |why: String| Error::Read(Refusal::new(format!("not a table of points: {why}")));
        let read = points::read(bytes).map_err(not_a_table)?;
        let stated = points::stated(bytes);
        let cutter = expected.cutter.or(request.cutter_radius).or(stated.cutter);
        let section = self.section(expected.section)?;
        let text = String::from_utf8_lossy(bytes);
        let judged = |cut: usize| self.judged_points((cut, section), (&read, stated, cutter, &text), request);
        let checks = match section {
            Some(section) => judged(section.cut)?,
            None => self.best_of_cuts(expected, judged)?,
        };
        Ok(self.report_on("table of points", request, checks))
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
        Ok(self.report_on(what, request, checks))
    }

    /// Whether a program for a milling machine cuts this cam.
    pub(super) fn check_program(
        &self,
        bytes: &[u8],
        expected: &ExpectedFile<'_>,
        request: &Request,
    ) -> Result<Report, Error> {
        let program = gcode::read_for(bytes, Some(self.body().machine().cutting().controller))
            .map_err(|why| Error::Read(why.context("not a program that can be checked")))?;
        let kept = keeps_its_cutter(&program);
        let cuts = self.body().cuts();
        let cutter = match expected.cutter.or(request.cutter_radius).or_else(|| widest_cutter(self.body())) {
            _ if kept => None,
            Some(cutter) => Some(MILLIMETRES * cutter),
            None => {
                let refusal = Refusal::new("the program moves the centre of a cutter and does not give its radius");
                return Err(Error::Cutter(refusal.remedy("give the radius of the cutter")));
            }
        };
        let given = expected.cutter.or(request.cutter_radius).filter(|_| kept);
        let programs = Ok(vec![WrittenProgram {
            cuts: (0..cuts.len()).collect(),
            cutter,
            kept: given.map(|radius| MILLIMETRES * radius),
            middle: MILLIMETRES * request.fit.band().0,
            depth: depth_of(self.body()),
            program: Ok(program),
        }]);
        let evidence = self.nothing_written(MILLIMETRES * request.fit.tolerance, request)?;
        let checks = verify::run(&Evidence { programs: Some(&programs), ..evidence });
        let alone = cuts.len() == 1 && cuts.iter().all(|cut| cut.curves.is_some() && !cut.is_hollow());
        let left = programs.as_ref().ok().and_then(|all| all.first()).filter(|_| alone).and_then(verify::left_by);
        let cause = diagnosis::of(self, (0, None), left.as_ref(), (&checks, request.fit.tolerance));
        let mut report = self.report_on("program", request, checks);
        report.sections.extend(cause);
        Ok(report)
    }

    /// Whether a table for a servo drive moves it as this cam moves its follower.
    pub(super) fn check_servo(&self, bytes: &[u8], request: &Request) -> Result<Report, Error> {
        let body = self.body();
        let text = String::from_utf8_lossy(bytes);
        let table = servo::read(bytes).and_then(|rows| heads::of_servo(body, &text, &rows).map_or(Ok(rows), Err));
        let tables = Ok(vec![WrittenServo { format: "the table", table }]);
        let evidence = self.nothing_written(MILLIMETRES * request.fit.tolerance, request)?;
        let checks = verify::run(&Evidence { servo: Some(&tables), ..evidence });
        Ok(self.report_on("table for a servo drive", request, checks))
    }

    /// Whether a list of places for a measuring machine is one of this cam.
    pub(super) fn check_places(
        &self,
        bytes: &[u8],
        expected: &ExpectedFile<'_>,
        request: &Request,
    ) -> Result<Report, Error> {
        let tolerance_mm = MILLIMETRES * request.fit.tolerance;
        let text = String::from_utf8_lossy(bytes);
        let checks = self.best_of_cuts(expected, |cut| {
            let mut list = WrittenInspection::of(cut, bytes);
            list.places = list
                .places
                .and_then(|places| heads::of_places(self.body(), &text, list.ball_radius).map_or(Ok(places), Err));
            let list = [list];
            Ok(verify::run(&Evidence { inspections: &list, ..self.nothing_written(tolerance_mm, request)? }))
        })?;
        Ok(self.report_on("list of places", request, checks))
    }

    /// Whether the lift table of a gauge follower is one of this cam.
    pub(super) fn check_gauge(&self, bytes: &[u8], request: &Request) -> Result<Report, Error> {
        let body = self.body();
        let text = String::from_utf8_lossy(bytes);
        let rows = read_gauge::read(bytes).and_then(|rows| heads::of_gauge(body, &text, &rows).map_or(Ok(rows), Err));
        let evidence = self.nothing_written(MILLIMETRES * request.fit.tolerance, request)?;
        let checks = verify::run(&Evidence { gauge: Some(&rows), ..evidence });
        Ok(self.report_on("lift table of a gauge follower", request, checks))
    }

    /// Whether a table of numbers is one of this cam.
    pub(super) fn check_table(&self, bytes: &[u8], request: &Request) -> Result<Report, Error> {
        let table = read_table::read(bytes);
        let evidence = self.nothing_written(MILLIMETRES * request.fit.tolerance, request)?;
        let checks = verify::run(&Evidence { table: Some(&table), ..evidence });
        Ok(self.report_on("table", request, checks))
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

    /// The findings on a table of points of a cut.
    fn judged_points(
        &self,
        (cut_index, section): (usize, Option<CutSection>),
        (read, stated, cutter, text): (&points::ReadPoints, points::StatedCurve, Option<f64>, &str),
        request: &Request,
    ) -> Result<Vec<Finding>, Error> {
        let tolerance_mm = MILLIMETRES * request.fit.tolerance;
        let evidence = self.nothing_written(tolerance_mm, request)?;
        let cuts = self.body().cuts();
        let cut = cuts.get(cut_index);
        let placed = |rows: &[[f64; 2]]| -> Result<(Vec<f64>, bool), String> {
            read.goes_round()?;
            let cut = cut.ok_or("the cam has no such cut")?;
            let path = traced(self.body(), cut, stated.curve, cutter).map_err(|error| error.to_string())?;
            let curve = Interpolant::new(rows, read.form, read.between, read.closed);
            path.places_of(&curve).map(|places| (places, path.is_closed())).map_err(|error| error.to_string())
        };
        let flipped = cut.is_some_and(|cut| cut.mirrored == [true]);
        let mut table = PointTable {
            rpm: section.map(|section| section.rpm),
            cut: cut_index,
            curve: stated.curve,
            radius: match stated.curve {
                PointCurve::Profile => None,
                PointCurve::Centre => radius_of_roller(self.body()),
                PointCurve::Cutter => cutter,
            },
            wish: PointTableSpec { form: read.form, step: stated.step, between: read.between, tolerance: tolerance_mm },
            allowed: [evidence.motion.velocity, evidence.motion.acceleration],
            errors: PointErrors::Known([0.0; 2]),
            closed: read.closed,
            flipped,
            rows: PointRows {
                rows: read.rows.clone(),
                places: Vec::new(),
                corners: 0,
                jumps: 0,
                intervals: read.rows.len().saturating_sub(1),
                error: 0.0,
            },
        };
        let rows = table.turned(&read.rows);
        let tables = placed(&rows).and_then(|(places, closed)| {
            if closed != read.closed {
                return Err("the table does not say that its last row is the first point again".to_owned());
            }
            table.rows.places = places;
            let curve = Ok(Interpolant::new(&rows, read.form, read.between, read.closed));
            Ok(vec![WrittenPoints { table, cutter, curve }])
        });
        let checks = verify::run(&Evidence { points: Some(&tables), ..evidence });
        let kept = checks.iter().find(|finding| finding.check == "points" && finding.verdict != Verdict::Fail);
        let stated = kept.zip(tables.as_ref().ok().and_then(|tables| tables.first())).and_then(|(found, written)| {
            let table = self.as_read(written, found.value)?;
            heads::of_points(self.body(), text, (&table, read.units, tolerance_mm))
        });
        Ok(stated.map_or(checks, |why| verify::run(&Evidence { points: Some(&Err(why)), ..evidence })))
    }

    /// A table of points with the figures of its head computed from its rows; `error` is their distance, mm.
    fn as_read(&self, written: &WrittenPoints, error: f64) -> Option<PointTable> {
        let (mut table, curve) = (written.table.clone(), written.curve.as_ref().ok()?);
        let cuts = self.body().cuts();
        let cut = cuts.get(table.cut)?;
        table.errors = match motion_errors(self.body(), cut, table.curve, written.cutter) {
            Ok(feel) => PointErrors::Known(largest_errors(&*feel, curve, table.wish.between)),
            Err(why) => PointErrors::Unknown(why),
        };
        let rows = &mut table.rows;
        rows.error = error;
        let twice = rows.rows.windows(2).filter(|pair| pair[0] == pair[1]).count();
        rows.intervals -= twice;
        rows.corners = match table.wish.between {
            PointInterpolation::Cubic => twice,
            PointInterpolation::Linear => traced(self.body(), cut, table.curve, written.cutter).ok()?.corners(),
        };
        Some(table)
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
        let of_file: Vec<_> = checks.into_iter().filter(|finding| verify::is_of_file(&finding.check)).collect();
        let sections = vec![Section::new("cam", &self.body().kind().noun)];
        let whole = report(self.body(), Inputs::of(&self.inputs_for(request)), sections, of_file);
        let noun = format!("{what} of a {}", whole.noun).into();
        Report { command: "check".into(), noun, not_modelled: Vec::new(), ..whole }
    }
}

//! A table of points that somebody else may have written: which curve it gives, by its head, and where its rows lie on that curve.

use super::head::contradiction;
use super::judge::{WrittenPoints, judge, no_table};
use super::plan::{PointErrors, PointTable, largest_errors, motion_errors, traced};
use super::read::{ReadPoints, StatedCurve, read, stated};
use crate::body::{Body, PointCurve, radius_of_roller};
use crate::report::{Finding, Verdict};
use crate::tool_files::tool_file::{FileError, SolvedCam};
use crate::verify::Evidence;
use camgen_kernel::geometry::points::{Interpolant, PointInterpolation, PointRows, PointTableSpec};
use camgen_kernel::refusal::Refusal;
use std::borrow::Cow;

/// A table as it was read.
pub(super) struct ForeignTable<'t> {
    text: Cow<'t, str>,
    rows: ReadPoints,
    stated: StatedCurve,
    /// Radius of the cutter, m, where one is given.
    cutter: Option<f64>,
}

impl<'t> ForeignTable<'t> {
    /// Reads a table; a cutter that is given goes before the one that the table states.
    pub(super) fn read(bytes: &'t [u8], cutter: Option<f64>) -> Result<Self, FileError> {
        let not_a_table = |why: String| FileError::Read(Refusal::new(format!("not a table of points: {why}")));
        let rows = read(bytes).map_err(not_a_table)?;
        let stated = stated(bytes);
        Ok(Self { text: String::from_utf8_lossy(bytes), rows, stated, cutter: cutter.or(stated.cutter) })
    }

    /// The finding on it as the table of a cut, with the speed of the cut where it is a section.
    pub(super) fn judge(
        &self,
        cam: &SolvedCam<'_>,
        cut: usize,
        rpm: Option<f64>,
    ) -> Result<Option<Finding>, FileError> {
        let evidence = cam.evidence()?;
        let written = match self.placed(&evidence, cut, rpm) {
            Ok(written) => written,
            Err(why) => return Ok(Some(no_table(evidence.tolerance_mm, why))),
        };
        let Some(finding) = judge(&evidence, std::slice::from_ref(&written)) else { return Ok(None) };
        if finding.verdict == Verdict::Fail {
            return Ok(Some(finding));
        }
        let table = self.with_figures(evidence.body, written, finding.value);
        let contradicted = table
            .and_then(|table| contradiction(evidence.body, &self.text, &table, self.rows.units, evidence.tolerance_mm));
        Ok(Some(contradicted.map_or(finding, |why| no_table(evidence.tolerance_mm, why))))
    }

    /// The table with the places of its rows on the curve that it gives.
    fn placed(&self, evidence: &Evidence<'_>, cut_index: usize, rpm: Option<f64>) -> Result<WrittenPoints, String> {
        let (body, read) = (evidence.body, &self.rows);
        let cuts = body.cuts();
        let cut = cuts.get(cut_index);
        let tolerance = evidence.tolerance_mm;
        let mut table = PointTable {
            rpm,
            cut: cut_index,
            curve: self.stated.curve,
            radius: match self.stated.curve {
                PointCurve::Profile => None,
                PointCurve::Centre => radius_of_roller(body),
                PointCurve::Cutter => self.cutter,
            },
            wish: PointTableSpec { form: read.form, step: self.stated.step, between: read.between, tolerance },
            allowed: [evidence.motion.velocity, evidence.motion.acceleration],
            errors: PointErrors::Known([0.0; 2]),
            closed: read.closed,
            flipped: cut.is_some_and(|cut| cut.mirrored == [true]),
            rows: PointRows {
                rows: read.rows.clone(),
                places: Vec::new(),
                corners: 0,
                jumps: 0,
                intervals: read.rows.len().saturating_sub(1),
                error: 0.0,
            },
        };
        read.goes_round()?;
        let curve = Interpolant::new(&table.turned(&read.rows), read.form, read.between, read.closed);
        let cut = cut.ok_or("the cam has no such cut")?;
        let path = traced(body, cut, table.curve, self.cutter).map_err(|error| error.to_string())?;
        table.rows.places = path.places_of(&curve).map_err(|error| error.to_string())?;
        if path.is_closed() != read.closed {
            return Err("the table does not say that its last row is the first point again".to_owned());
        }
        Ok(WrittenPoints { table, cutter: self.cutter, curve: Ok(curve) })
    }

    /// A table with the figures of its head computed from its rows; `error` is their distance, mm.
    fn with_figures(&self, body: &dyn Body, written: WrittenPoints, error: f64) -> Option<PointTable> {
        let (mut table, curve) = (written.table, written.curve.ok()?);
        let cuts = body.cuts();
        let cut = cuts.get(table.cut)?;
        table.errors = match motion_errors(body, cut, table.curve, self.cutter) {
            Ok(feel) => PointErrors::Known(largest_errors(&*feel, &curve, table.wish.between)),
            Err(why) => PointErrors::Unknown(why),
        };
        let rows = &mut table.rows;
        rows.error = error;
        let twice = rows.rows.windows(2).filter(|pair| pair[0] == pair[1]).count();
        rows.intervals -= twice;
        rows.corners = match table.wish.between {
            PointInterpolation::Cubic => twice,
            PointInterpolation::Linear => traced(body, cut, table.curve, self.cutter).ok()?.corners(),
        };
        Some(table)
    }
}

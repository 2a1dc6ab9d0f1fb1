//! Tables as CSV: a header line, then numbers, the shortest that round-trip, unquoted, behind a word where rows have names. Where there is no
//! value a cell is `NaN`.

use super::number::push_shortest;
use super::{Format, FormatError, OfAnalysis, When, fits_all};
use crate::body::Body;
use crate::geometry::MILLIMETRES;
use crate::motion::{Jet, Quantity};
use crate::profile::followed::Followed;
use crate::table::{self, Row, Table};
use crate::verify::WrittenOutline;

/// Most rows of a point table: a cam angle of six seconds from one to the next.
pub const MOST_ROWS: u32 = 200_000;

/// The point table.
pub const FORMAT: Format = Format {
    name: "csv",
    when: When::Usual,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".csv".into()],
    write: |cam| {
        let rows = rows(cam.body, cam.second.map(|(body, _)| body), cam.outlines, cam.samples);
        Ok(vec![of_cam(&rows)?])
    },
    of_analysis: Some(OfAnalysis {
        endings: |analysis| analysis.tables.iter().map(|(ending, _)| format!("{ending}.csv")).collect(),
        write: |account| Ok(account.analysis.tables.iter().map(|(_, table)| write(table)).collect()),
    }),
};

/// The point table of a cam, with what its follower does on the outline as written, and with the torque of a second disc on its
/// shaft.
#[must_use]
pub fn table(body: &dyn Body, second: Option<&dyn Body>, outlines: &[WrittenOutline], samples: u32) -> Table {
    Table::of(&rows(body, second, outlines, samples))
}

fn rows(body: &dyn Body, second: Option<&dyn Body>, outlines: &[WrittenOutline], samples: u32) -> Vec<Row> {
    let mut rows = body.rows(samples);
    if let Some(second) = second {
        for row in &mut rows {
            let at = row.cam_deg.map(f64::to_radians);
            row.torque_of_second = at.and_then(|at| second.force_and_torque(at)).map(|[_, torque]| torque);
        }
    }
    if let (Some(curves), Some(outline)) = (body.plane(), outlines.first()) {
        let motion = curves.motion;
        let followed = Followed::on(curves, &outline.contour, body.mirrored());
        for row in &mut rows {
            let place = row.cam_deg.map(f64::to_radians).or(row.bed.map(|bed| bed.x / MILLIMETRES));
            let law = row.at.zip(row.lift.or(row.swing));
            let followed = place.and_then(|place| Some((place, followed.beside_law(place, law)?)));
            let cut = followed.map(|(place, cut)| {
                let (first, second) = motion.pace(place);
                [cut.ds * first, cut.dds * first * first + cut.ds * second]
            });
            // Of a press only: what is left of the forces of a plate depends on the slope as cut, too, and is not told.
            if let (Some(state), Some(law)) = (&row.state, row.lift.or(row.swing)) {
                let moved = |cut: Jet| (cut.s - law.s) * curves.follower.leverage(&law);
                let left = followed.map(|(_, cut)| body.unbalanced_in(state, moved(cut)));
                row.residual_cut = Some(left.unwrap_or(f64::NAN));
            }
            row.swings = motion.quantity() == Quantity::Angle;
            row.cut = Some(cut.unwrap_or([f64::NAN; 2]));
        }
    }
    rows
}

/// Bytes of most numbers with what stands between two.
const NUMBER: usize = 16;

/// The rows of a cam as text, in which every value is a number, but where there may be none.
///
/// # Errors
/// [`FormatError::NotFinite`].
fn of_cam(rows: &[Row]) -> Result<Vec<u8>, FormatError> {
    let columns = table::columns(rows);
    let strict: Vec<bool> = columns.iter().map(|column| !table::may_lack(column)).collect();
    let names: Vec<&str> = columns.iter().map(|(name, _)| *name).collect();
    let mut text = text_of(&names, rows.len());
    for (index, row) in rows.iter().enumerate() {
        for (place, (column, strict)) in columns.iter().zip(&strict).enumerate() {
            let value = table::value(row, column);
            if value.is_nan() && *strict {
                return Err(FormatError::NotFinite { column: column.0, row: index + 1 });
            }
            push_cell(&mut text, place, value);
        }
        text.push(b'\n');
    }
    Ok(text)
}

/// The line of names, and room for so many rows.
fn text_of(names: &[&str], rows: usize) -> Vec<u8> {
    let mut text = Vec::with_capacity(NUMBER * (rows + 1) * names.len());
    text.extend_from_slice(names.join(",").as_bytes());
    text.push(b'\n');
    text
}

/// Adds a number at its place in a line.
fn push_cell(text: &mut Vec<u8>, place: usize, value: f64) {
    if place > 0 {
        text.push(b',');
    }
    push_shortest(text, value);
}

/// The table as text with line feeds.
#[must_use]
pub fn write(table: &Table) -> Vec<u8> {
    let (name, words) = table.words.as_ref().map_or((None, &[][..]), |(name, words)| (Some(*name), words.as_slice()));
    let names: Vec<&str> = name.into_iter().chain(table.columns.iter().copied()).collect();
    let mut text = text_of(&names, table.rows.len());
    let mut words = words.iter();
    for row in &table.rows {
        if let Some(word) = words.next() {
            text.extend_from_slice(word.as_bytes());
            text.push(b',');
        }
        row.iter().enumerate().for_each(|(place, value)| push_cell(&mut text, place, *value));
        text.push(b'\n');
    }
    text
}

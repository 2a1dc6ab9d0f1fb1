//! Tables as CSV: a header line, then numbers, unquoted, in the shortest form that reads back exactly, after a name where rows have names.
//! A cell without a value is `NaN`.

use super::number::shortest;
use super::{AnalysisFormat, FormatSelection, View, fits_all};
use crate::body::{Body, torque};
use crate::table::{self, Row, Table};
use crate::verify::WrittenOutline;
use camgen_kernel::motion::{Jet, Quantity};
use camgen_kernel::profile::followed::FollowerOnChain;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;
use std::borrow::Cow;

/// Most rows of a point table: one every six seconds of cam angle.
pub const MOST_ROWS: u32 = 200_000;

/// The point table.
pub const FORMAT: View = View {
    name: "csv",
    when: FormatSelection::Usual,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".csv".into()],
    write: |cam| {
        let rows = rows(cam.body, cam.other_cams.first().map(|(body, _)| *body), cam.outlines, cam.samples);
        Ok(vec![of_cam(&rows, cam.body.machine().units())?])
    },
    of_analysis: Some(AnalysisFormat {
        endings: |analysis| analysis.tables.iter().map(|(ending, _)| format!("{ending}.csv")).collect(),
        write: |account| {
            Ok(account.analysis.tables.iter().map(|(_, table)| write(table, account.report.units)).collect())
        },
    }),
};

/// The point table of a cam, with the motion of its follower on the outline as written, and with the torque of a second disc on its
/// shaft.
#[must_use]
pub fn table(body: &dyn Body, second: Option<&dyn Body>, outlines: &[WrittenOutline], samples: u32) -> Table {
    Table::from_rows(&rows(body, second, outlines, samples))
}

/// The further tables of a body.
pub const FURTHER: View = View {
    name: "further tables",
    when: FormatSelection::Drawn,
    flank: false,
    unfit: fits_all,
    endings: |drawn| drawn.swept.iter().flat_map(|swept| swept.tables.iter().map(|name| (*name).to_owned())).collect(),
    write: |cam| {
        let units = cam.body.machine().units();
        Ok(cam.body.further_tables(cam.samples, cam.cutter_radius).iter().map(|table| write(table, units)).collect())
    },
    of_analysis: None,
};

fn rows(body: &dyn Body, second: Option<&dyn Body>, outlines: &[WrittenOutline], samples: u32) -> Vec<Row> {
    let mut rows = body.rows(samples);
    if let Some(second) = second.filter(|second| torque::has_own_torque(*second)) {
        for row in &mut rows {
            let at = row.cam_deg.map(f64::to_radians);
            row.torque_of_second = at.and_then(|at| torque::force_and_torque(second, at)).map(|[_, torque]| torque);
        }
    }
    let cuts = body.cuts();
    let first = cuts.first().and_then(|cut| Some((cut.curves?, cut.mirrored)));
    if let (Some((curves, mirrored)), Some(outline)) = (first, outlines.first()) {
        let motion = curves.motion;
        let followed = FollowerOnChain::on(curves, &outline.contour, mirrored);
        for row in &mut rows {
            let place = row.cam_deg.map(f64::to_radians).or(row.parameter);
            let law = row.at.zip(row.lift.or(row.swing));
            let followed = place.and_then(|place| Some((place, followed.at_known_lift(place, law)?)));
            let cut = followed.map(|(place, cut)| {
                let (first, second) = motion.pace(place);
                [cut.ds * first, cut.dds * first * first + cut.ds * second]
            });
            if let (Some(state), Some(law)) = (&row.load, row.lift.or(row.swing)) {
                let moved = |cut: Jet| (cut.s - law.s) * curves.follower.leverage(&law);
                let left = followed.map(|(_, cut)| state.residual(moved(cut)));
                row.residual_cut = Some(left.unwrap_or(f64::NAN));
            }
            row.swings = motion.quantity() == Quantity::Angle;
            row.cut = Some(cut.unwrap_or([f64::NAN; 2]));
        }
    }
    rows
}

/// The rows of a cam as text; every value must be a number, except where a value may be missing.
///
/// # Errors
/// [`Refusal`] when a value of the table is missing.
fn of_cam(rows: &[Row], units: LengthUnit) -> Result<Vec<u8>, Refusal> {
    let columns = table::columns(rows);
    let (names, powers): (Vec<Cow<'_, str>>, Vec<i32>) = columns.iter().map(|column| units.column(column.name)).unzip();
    let mut text = names.join(",") + "\n";
    for (index, row) in rows.iter().enumerate() {
        for (column, power) in columns.iter().zip(&powers) {
            let value = table::value(row, column);
            if value.is_nan() && !table::may_lack(column) {
                let (row, name) = (index + 1, column.name);
                return Err(Refusal::new(format!(
                    "row {row} of the table has no number in column {name}; nothing was written"
                ))
                .remedy("please report this"));
            }
            push_cell(&mut text, &shortest(units.of_mm_to(value, *power)));
        }
        end_line(&mut text);
    }
    Ok(text.into_bytes())
}

fn push_cell(text: &mut String, cell: &str) {
    text.push_str(cell);
    text.push(',');
}

/// A word as a cell; in quotes where it has a comma, a quote or a line break.
fn quoted(word: &str) -> Cow<'_, str> {
    if word.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", word.replace('"', "\"\"")).into()
    } else {
        word.into()
    }
}

/// A line feed instead of the last comma.
fn end_line(text: &mut String) {
    text.pop();
    text.push('\n');
}

/// The table, of millimetres, as text with line feeds, its lengths in a unit, which the names of the columns have.
#[must_use]
pub fn write(table: &Table, units: LengthUnit) -> Vec<u8> {
    let first = table.words.iter().map(|(name, words)| (*name, words));
    let powers: Vec<i32> = table.columns.iter().map(|column| units.column(column).1).collect();
    let before = |column: &'static str| table.more_words.iter().filter(move |words| words.before == column);
    let mut names: Vec<Cow<'_, str>> = first.clone().map(|(name, _)| name.into()).collect();
    for column in &table.columns {
        names.extend(before(column).map(|words| words.name.into()).chain([units.column(column).0]));
    }
    let mut text = names.join(",") + "\n";
    for (index, row) in table.rows.iter().enumerate() {
        let word = |words: &'_ [String]| quoted(words.get(index).map_or("", String::as_str)).into_owned();
        first.clone().for_each(|(_, words)| push_cell(&mut text, &word(words)));
        for ((column, value), power) in table.columns.iter().zip(row).zip(&powers) {
            before(column).for_each(|column| push_cell(&mut text, &word(&column.words)));
            push_cell(&mut text, &shortest(units.of_mm_to(*value, *power)));
        }
        end_line(&mut text);
    }
    text.into_bytes()
}

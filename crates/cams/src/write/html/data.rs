//! What the page shows of a cam, as JSON: numbers rounded to what can be seen, everything else as in the report.

use super::super::csv;
use super::super::path_data::PathData;
use super::super::{AnalysisRendering, Rendering};
use super::{panels, units};
use crate::analysis::Analysis;
use crate::body::Part;
use crate::report::diagram::Diagram;
use crate::report::mechanism::{CoordinateTrack, MechanismView, MovingMechanism, RigidPart, RingSolid};
use crate::report::{Bound, Finding, Place, Report, Section, Verdict, shown, worst_first};
use crate::table::Table;
use camgen_kernel::text::Text;
use serde_json::{Map, Value, json};

/// Most steps of a turn, and most rows of the table over all sections.
const STEPS: u32 = 720;
const ROWS: u32 = 1800;
/// Fewest rows of a section.
const FEWEST: u32 = 120;
/// Digits of a number in the table.
const DIGITS: usize = 7;
/// Shapes, in steps of a tenth of a micrometre.
const DATA: PathData = PathData { decimals: 4, cubics: false };
/// Decimals of a place, mm, and of an angle, degrees.
const PLACES: f64 = 1e4;
const ANGLES: f64 = 1e5;

/// A number, whole numbers without a point; what is not finite is null.
fn number(value: f64) -> Value {
    #[expect(clippy::cast_possible_truncation, reason = "whole and small")]
    if value.is_finite() && value == value.trunc() && value.abs() < 1e15 {
        return Value::from(value as i64);
    }
    // What is not finite becomes null.
    Value::from(value)
}

/// A number rounded to significant digits.
fn digits(value: f64) -> Value {
    number(format!("{value:.*e}", DIGITS - 1).parse().unwrap_or(f64::NAN))
}

fn rounded(values: &[f64], scale: f64) -> Value {
    values.iter().map(|value| number((value * scale).round() / scale)).collect()
}

/// Everything that the page shows of a cam.
pub(super) fn of(cam: &Rendering<'_>) -> Value {
    let (body, report) = (cam.body, cam.report);
    // The outlines are those read back from the cut files.
    let mut drawn = cam.drawn.clone();
    let drawn_contours = drawn.parts.iter_mut().flat_map(Part::outlines_mut).map(|outline| &mut outline.contour);
    for (contour, outline) in drawn_contours.zip(cam.outlines) {
        contour.clone_from(&outline.contour);
    }
    let sections = u32::try_from(drawn.parts.len()).unwrap_or(1).max(1);
    let steps = cam.samples.clamp(1, STEPS).min((ROWS / sections).max(FEWEST));
    let mechanism = body.mechanism(&drawn, steps);
    let table = csv::table(body, cam.other_cams.first().map(|(body, _)| *body), cam.outlines, steps);
    let roller = crate::body::radius_of_roller(body).map(|radius| radius * camgen_kernel::geometry::MILLIMETRES);
    let mut page = report_page(report);
    page["pictureNotes"] = json!(mechanism.notes);
    page["views"] =
        json!(views(&panels::OF_A_CAM.iter().collect::<Vec<_>>(), &mechanism, &table, (&report.checks, roller)));
    page["solid"] = mechanism.solid.as_ref().map_or(Value::Null, solid);
    page
}

/// The diagrams of an analysis: its own first.
fn of_an_analysis(analysis: &Analysis) -> Vec<&'static Diagram> {
    analysis.diagrams.iter().chain(panels::OF_AN_ANALYSIS).collect()
}

/// Everything that the page shows of an analysis: its curves are views, without a mechanism where nothing moves.
pub(super) fn of_analysis(account: &AnalysisRendering<'_>) -> Value {
    let (analysis, report) = (account.analysis, account.report);
    let views = analysis.tables.last().map_or_else(Vec::new, |(_, table)| match &analysis.mechanism {
        Some(mechanism) => {
            let table = growing(table, analysis.along);
            views(&of_an_analysis(analysis), mechanism, &table, (&report.checks, None))
        }
        None => curves(analysis, table, &report.checks),
    });
    let notes = analysis.mechanism.as_ref().map(|mechanism| &mechanism.notes);
    let mut page = report_page(report);
    page["pictureNotes"] = json!(notes.map_or_else(Vec::new, Vec::clone));
    page["views"] = json!(views);
    page["solid"] = Value::Null;
    page
}

/// A table whose rows are in the order of growing values of a column, as the page needs to look places up.
fn growing(table: &Table, along: &str) -> Table {
    let column = table.columns.iter().position(|name| *name == along).unwrap_or(0);
    let place = |row: Option<&Vec<f64>>| row.and_then(|row| row.get(column)).copied();
    let mut table = table.clone();
    if place(table.rows.first()) > place(table.rows.last()) {
        table.rows.reverse();
    }
    table
}

/// A view of each of the curves that are distinguished by the first value of a row.
fn curves(analysis: &Analysis, table: &Table, checks: &[Finding]) -> Vec<Value> {
    let apart = analysis.by.len();
    let first = |row: &Vec<f64>| row.iter().take(apart).map(|value| value.to_bits()).collect::<Vec<u64>>();
    let names = table.columns.get(apart..).unwrap_or_default();
    let of = |rows: &[Vec<f64>]| {
        let values = rows.first().map(Vec::as_slice).unwrap_or_default();
        let name = |(by, value): (&&str, &f64)| format!("{} {}", shown(*value), units::named(by).unit);
        let names_of: Vec<String> = analysis.by.iter().zip(values).map(name).collect();
        let along = names.iter().position(|name| *name == analysis.along).unwrap_or(0);
        let rows: Vec<Vec<f64>> = rows.iter().map(|row| row.get(apart..).unwrap_or_default().to_vec()).collect();
        let at: Vec<f64> = rows.iter().filter_map(|row| row.get(along).copied()).collect();
        let mut view = columns(names, &rows);
        view["name"] = json!(names_of.join(", "));
        view["rpm"] = Value::Null;
        view["shaftSpeed"] = Value::Null;
        view["returns"] = Value::Bool(true);
        view["place"] = json!(analysis.along);
        view["at"] = rounded(&at, ANGLES);
        view["turn"] = rounded(&at, ANGLES);
        view["box"] = json!([0, 0, 1, 1]);
        view["parts"] = json!([]);
        view["panels"] = match table.words {
            None => json!(panels::of(&valued(names, &rows), &of_an_analysis(analysis), analysis.along, (checks, None))),
            // Rows that are named are a list, not a curve.
            Some(_) => json!([]),
        };
        view["words"] = json!(table.words);
        view
    };
    if table.words.is_some() {
        return vec![of(&table.rows)];
    }
    table.rows.chunk_by(|a, b| first(a) == first(b)).map(of).collect()
}

/// What the page shows of any report.
pub(super) fn report_page(report: &Report) -> Value {
    json!({
        "title": report.title(),
        "machine": report.machine,
        "noun": report.noun,
        "command": report.command,
        "speeds": report.speeds().trim(),
        "passed": report.passed(),
        "inputs": report.inputs,
        "checks": worst_first(report.checks.clone()).iter().map(check).collect::<Vec<Value>>(),
        "sections": report.sections.iter().map(section).collect::<Vec<Value>>(),
        "notes": report.notes.iter().map(Text::to_string).collect::<Vec<_>>(),
        "notModelled": report.not_modelled,
        "files": report.files.iter().filter_map(|file| file.rsplit(['/', '\\']).next()).collect::<Vec<&str>>(),
        "notRun": not_run(report),
    })
}

pub(super) fn check(finding: &Finding) -> Value {
    let place = (finding.place != Place::default()).then(|| finding.place.text().to_string());
    json!({
        "check": finding.check,
        "about": finding.about,
        "value": digits(finding.readable()),
        "limit": finding.limit.map(digits),
        "side": finding.bound.map(Bound::words),
        "unit": units::shown(&finding.unit),
        "place": place,
        "camDeg": finding.place.cam_deg,
        "xMm": finding.place.x_mm,
        "verdict": finding.verdict,
        "margin": finding.margin(),
        "asCut": finding.is_as_cut,
        "note": finding.note.as_ref().map(Text::to_string),
    })
}

/// Checks that could not be judged, and what they need.
fn not_run(report: &Report) -> Vec<Value> {
    let silent = report.checks.iter().filter(|finding| finding.verdict == Verdict::Info && !finding.value.is_finite());
    silent.filter_map(|finding| Some(json!([finding.check, finding.note.as_ref()?.to_string()]))).collect()
}

/// A section with its values one by one: name, value, unit.
fn section(section: &Section) -> Value {
    let (mut values, mut tables) = (Vec::new(), Vec::new());
    let value = match &section.value {
        Value::Object(map) => {
            let (lists, rest): (Map<String, Value>, Map<String, Value>) =
                map.clone().into_iter().partition(|(_, value)| is_list(value));
            tables.extend(lists.iter().map(|(key, rows)| list(key, rows)));
            Value::Object(rest)
        }
        other => other.clone(),
    };
    flatten(&section.key, &value, &mut values);
    // The values have the rows as a table.
    let sentences = section.words.iter().filter(|line| !line.is_row);
    let words: Vec<String> = sentences.map(|line| line.text.to_string()).collect();
    json!({"key": section.key, "title": units::words(&section.key), "words": words, "values": values, "tables": tables})
}

/// Whether a value is a list of objects of plain values: a table.
fn is_list(value: &Value) -> bool {
    let plain = |value: &Value| !value.is_object() && !value.is_array();
    let row = |row: &Value| row.as_object().is_some_and(|row| row.values().all(plain));
    value.as_array().is_some_and(|rows| rows.len() > 1 && rows.iter().all(row))
}

/// A list of objects with its heads, name and unit.
fn list(name: &str, rows: &Value) -> Value {
    let rows: Vec<&Map<String, Value>> = rows.as_array().into_iter().flatten().filter_map(Value::as_object).collect();
    let keys: Vec<&String> = rows.first().map(|row| row.keys().collect()).unwrap_or_default();
    let heads: Vec<Value> = keys.iter().map(|key| json!([units::words(key), units::named(key).unit])).collect();
    let cell = |value: Option<&Value>| match value {
        Some(Value::Number(number)) => number.as_f64().map_or(Value::Null, digits),
        Some(other) => other.clone(),
        None => Value::Null,
    };
    let cells: Vec<Vec<Value>> =
        rows.iter().map(|row| keys.iter().map(|key| cell(row.get(key.as_str()))).collect()).collect();
    json!({"name": units::words(name), "heads": heads, "rows": cells})
}

fn flatten(name: &str, value: &Value, found: &mut Vec<Value>) {
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| flatten(key, value, found)),
        Value::Array(list) if list.iter().any(Value::is_object) => {
            for (index, value) in list.iter().enumerate() {
                let mut inner = Vec::new();
                flatten(name, value, &mut inner);
                for entry in inner {
                    let label = entry.get(0).and_then(Value::as_str).unwrap_or_default().to_owned();
                    found.push(json!([format!("{} {}: {label}", units::words(name), index + 1), entry[1], entry[2]]));
                }
            }
        }
        Value::Null => {}
        Value::Number(number) => {
            let value = number.as_f64().map_or(Value::Null, digits);
            found.push(json!([units::words(name), value, units::named(name).unit]));
        }
        Value::Array(list) => {
            let all: Vec<Value> = list.iter().map(|value| value.as_f64().map_or(value.clone(), digits)).collect();
            found.push(json!([units::words(name), all, units::named(name).unit]));
        }
        other => found.push(json!([units::words(name), other, ""])),
    }
}

/// The checks whose limits are drawn, and the radius of the roller, mm.
type PlottedLimits<'a> = (&'a [Finding], Option<f64>);

fn views(known: &[&Diagram], mechanism: &MovingMechanism, table: &Table, held: PlottedLimits<'_>) -> Vec<Value> {
    let each = table.rows.len() / mechanism.views.len().max(1);
    let of = |(view, rows): (&MechanismView, &[Vec<f64>])| view_of(known, view, (&table.columns, rows), held);
    mechanism.views.iter().zip(table.rows.chunks(each.max(1))).map(of).collect()
}

fn view_of(
    known: &[&Diagram],
    view: &MechanismView,
    (names, rows): (&[&'static str], &[Vec<f64>]),
    held: PlottedLimits<'_>,
) -> Value {
    let extents = view.extents;
    let size = extents.size();
    let mut shown = columns(names, rows);
    shown["name"] = json!(view.rpm.map(|rpm| format!("{rpm} rpm")));
    shown["rpm"] = json!(view.rpm);
    shown["shaftSpeed"] = json!(view.shaft_speed);
    shown["returns"] = json!(view.returns);
    shown["place"] = json!(view.place);
    shown["at"] = rounded(&view.at, ANGLES);
    shown["turn"] = rounded(&view.turn_deg, ANGLES);
    shown["box"] = rounded(&[extents.least.x, -extents.largest.y, size.x, size.y], PLACES);
    shown["parts"] = json!(view.parts.iter().map(rigid).collect::<Vec<Value>>());
    shown["panels"] = json!(panels::of(&valued(names, rows), known, view.place, held));
    shown
}

/// The columns that have a value in some row: a crank-slider has no transmission angle.
fn valued(names: &[&'static str], rows: &[Vec<f64>]) -> Vec<&'static str> {
    let has = |index: usize| rows.iter().any(|row| row.get(index).is_some_and(|value| !value.is_nan()));
    names.iter().enumerate().filter(|(index, _)| has(*index)).map(|(_, name)| *name).collect()
}

/// The values of a table by their names, and the label and unit of each.
fn columns(names: &[&'static str], rows: &[Vec<f64>]) -> Value {
    let column = |index: usize| -> Vec<Value> {
        rows.iter().map(|row| digits(row.get(index).copied().unwrap_or(f64::NAN))).collect()
    };
    let columns: Map<String, Value> =
        names.iter().enumerate().map(|(index, name)| ((*name).to_owned(), column(index).into())).collect();
    let kind = |name: &&'static str| {
        let named = units::named(name);
        ((*name).to_owned(), json!([units::words(name), named.unit, named.order]))
    };
    let kinds: Map<String, Value> = names.iter().map(kind).collect();
    json!({"columns": columns, "kinds": kinds})
}

fn track(track: &CoordinateTrack, scale: f64) -> Value {
    match track {
        CoordinateTrack::Still(value) => number((value * scale).round() / scale),
        CoordinateTrack::Moving(values) => rounded(values, scale),
    }
}

fn rigid(part: &RigidPart) -> Value {
    let name = part.name.as_ref().map(|(name, at)| json!([name, number(at.x), number(-at.y)]));
    let mut moving_part = json!({
        "role": part.role,
        "name": name,
        "path": part.shapes.iter().map(|shape| DATA.shape(shape)).collect::<String>(),
        "x": track(&part.x, PLACES),
        "y": track(&part.y, PLACES),
        "turn": track(&part.turn_deg, ANGLES),
        "stretch": track(&part.stretch, PLACES),
        "pressure": part.pressure_bar.as_ref().map(|pressure| track(pressure, ANGLES)),
    });
    if part.height != CoordinateTrack::Still(1.0) {
        moving_part["height"] = track(&part.height, PLACES);
    }
    moving_part
}

/// Decimals of the surface, mm: it is only looked at.
const SURFACE: f64 = 1e2;

fn solid(solid: &RingSolid) -> Value {
    let ring = |(z, points): &(f64, Vec<nalgebra::Vector2<f64>>)| {
        let flat: Vec<f64> = points.iter().flat_map(|point| [point.x, point.y]).collect();
        json!({"z": number((z * SURFACE).round() / SURFACE), "points": rounded(&flat, SURFACE)})
    };
    json!({
        "rings": solid.rings.iter().map(ring).collect::<Vec<Value>>(),
        "bore": solid.bore,
        "roller": solid.roller,
        "sections": solid.sections,
    })
}

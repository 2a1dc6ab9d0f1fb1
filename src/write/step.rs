//! The solid as a STEP file: AP214, millimetres, ASCII.
//!
//! truck-stepio numbers and writes topology and geometry; its frame is not used, because its product has no name, its
//! texts are not escaped and its faces are of a kind CAD systems do not read without a message. The frame is written here.

use super::number::push_shortest;
use super::{Format, FormatError, Rendering, When};
use crate::geometry::solid::{Curve, FaceSurface, Place, Solid, SolidError, SplineCurve, SplineSurface, conical};
use crate::numeric::decimal::push_whole;
use std::fmt::{Formatter, Result, Write};
use truck_modeling::{Point3, Vector3};
use truck_stepio::out::{DisplayByStep, StepCurve, StepLength, StepModel, StepSurface};

/// The solid.
pub const FORMAT: Format = Format {
    name: "step",
    when: When::Usual,
    flank: true,
    unfit: |body| body.height().is_none().then_some("cam.thickness is not given"),
    endings: |_| vec![".step".into()],
    write: |cam| Ok(vec![write_marked(&solid(cam)?, &cam.report.title(), cam.created, &cam.report.mark())]),
    of_analysis: None,
};

fn solid(cam: &Rendering<'_>) -> std::result::Result<Solid, FormatError> {
    let (low, high) = cam.body.height().unwrap_or_default();
    let Some(part) = cam.drawn.parts.first() else { return Err(SolidError::NotClosed("no part".into()).into()) };
    match &cam.drawn.flank {
        Some(flank) => Ok(conical(&flank.patches, &part.hole_contours(), (low, high), flank.volume)?),
        None => Ok(part.solid(high - low)?),
    }
}

/// Bytes of the entities that an edge brings with it.
const ROOM: usize = 640;
/// Bytes of the frame with usual names.
const FRAME_ROOM: usize = 4096;
/// How the frame begins that truck writes; the entities behind it begin with number 16.
const FRAME: &str = "#1 = APPLICATION_PROTOCOL_DEFINITION";
/// What truck writes behind the number of a face, and what stands there in its place.
const FACE: &str = " = FACE_SURFACE('', ";
const ADVANCED_FACE: &str = " = ADVANCED_FACE('', ";
/// The last second of the year 9999: later years have no place in a date of ISO 8601.
pub const LATEST: u64 = 253_402_300_799;

/// The time stamp of FILE_NAME, by ISO 8601; without a time, or after [`LATEST`], the empty text, which the schema allows
/// and which says that no time is known.
fn time_stamp(created: Option<u64>) -> String {
    let Some(seconds) = created.filter(|seconds| *seconds <= LATEST) else { return String::new() };
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    // Days from 1 March of year 0, the first day of a cycle of 400 years; in a year that begins with March the lengths of
    // the months are those of 153 days for five of them (Hinnant, chrono-compatible low-level date algorithms).
    let days = days + 719_468;
    let (cycle, day) = (days / 146_097, days % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    let year = year + 400 * cycle + next;
    let (hour, minute, second) = (second / 3_600, second / 60 % 60, second % 60);
    format!("{year:04}-{month:02}-{day:02}T{hour:02}:{minute:02}:{second:02}+00:00")
}

/// Adds a real of a STEP file to a text: shortest, with its decimal point.
fn push_real(text: &mut Vec<u8>, value: f64) {
    let from = text.len();
    push_shortest(text, value);
    let own = text.get(from..).unwrap_or_default();
    let pointed = own.contains(&b'.');
    match own.iter().position(|byte| *byte == b'e') {
        Some(mantissa) => {
            let at = from + mantissa;
            text.splice(at..=at, if pointed { &b"E"[..] } else { b".E" }.iter().copied());
        }
        None if pointed => {}
        None => text.push(b'.'),
    }
}

/// Adds reals with a comma between two.
fn push_reals(text: &mut Vec<u8>, values: impl IntoIterator<Item = f64>) {
    for (index, value) in values.into_iter().enumerate() {
        text.extend_from_slice(if index > 0 { b", " } else { b"" });
        push_real(text, value);
    }
}

/// Adds parts of a line to a text: words, and the numbers of entities behind them.
fn push_line(text: &mut Vec<u8>, parts: &[(&str, usize)], end: &str) {
    for (words, index) in parts {
        text.extend_from_slice(words.as_bytes());
        push_whole(text, *index as u64);
    }
    text.extend_from_slice(end.as_bytes());
}

/// Adds the line of an entity of three reals.
fn push_triple(text: &mut Vec<u8>, index: usize, kind: &str, reals: [f64; 3]) {
    push_line(text, &[("#", index)], kind);
    push_reals(text, reals);
    text.extend_from_slice(b"));\n");
}

fn push_point(text: &mut Vec<u8>, index: usize, point: Point3) {
    push_triple(text, index, " = CARTESIAN_POINT('', (", point.into());
}

fn push_direction(text: &mut Vec<u8>, index: usize, direction: Vector3) {
    push_triple(text, index, " = DIRECTION('', (", direction.into());
}

/// Adds AXIS2_PLACEMENT_3D with its point and directions, in the lines from `index` on.
fn push_placement(text: &mut Vec<u8>, index: usize, origin: Point3, axis: Vector3, along: Vector3) {
    let (a, b, c) = (index + 1, index + 2, index + 3);
    push_line(text, &[("#", index), (" = AXIS2_PLACEMENT_3D('', #", a), (", #", b), (", #", c)], ");\n");
    push_point(text, a, origin);
    push_direction(text, b, axis);
    push_direction(text, c, along);
}

/// Bytes of an entity with the entities it brings with it, mostly.
const LINES: usize = 384;

/// Writes lines that a function puts together: each write through a formatter costs more than a number.
fn write_lines(f: &mut Formatter<'_>, push: impl FnOnce(&mut Vec<u8>)) -> Result {
    let mut text = Vec::with_capacity(LINES);
    push(&mut text);
    f.write_str(std::str::from_utf8(&text).map_err(|_| std::fmt::Error)?)
}

impl StepLength for Curve {
    fn step_length(&self) -> usize {
        match self {
            Curve::Line { .. } => 4,
            Curve::Circle { .. } => 5,
            Curve::Spline(spline) => 1 + spline.controls.len(),
        }
    }
}

impl StepCurve for Curve {
    fn same_sense(&self) -> bool {
        match self {
            Curve::Line { .. } | Curve::Spline(_) => true,
            Curve::Circle { clockwise, .. } => !clockwise,
        }
    }
}

impl DisplayByStep for Curve {
    fn fmt(&self, index: usize, f: &mut Formatter<'_>) -> Result {
        write_lines(f, |text| push_curve(text, index, self))
    }
}

fn push_curve(text: &mut Vec<u8>, index: usize, curve: &Curve) {
    let next = index + 1;
    match curve {
        Curve::Line { origin, direction } => {
            let (vector, unit) = (index + 2, index + 3);
            push_line(text, &[("#", index), (" = LINE('', #", next), (", #", vector)], ");\n");
            push_point(text, next, *origin);
            push_line(text, &[("#", vector), (" = VECTOR('', #", unit)], ", 1.);\n");
            push_direction(text, unit, *direction);
        }
        Curve::Circle { centre, radius, .. } => {
            push_line(text, &[("#", index), (" = CIRCLE('', #", next)], ", ");
            push_real(text, *radius);
            text.extend_from_slice(b");\n");
            push_placement(text, next, *centre, Vector3::unit_z(), Vector3::unit_x());
        }
        Curve::Spline(SplineCurve { knots, controls }) => {
            push_line(text, &[("#", index)], " = B_SPLINE_CURVE_WITH_KNOTS('', 3, (");
            push_numbered(text, next, controls.len());
            text.extend_from_slice(b"), .UNSPECIFIED., .F., .F., (");
            push_multiplicities(text, knots);
            text.extend_from_slice(b"), (");
            push_values(text, knots);
            text.extend_from_slice(b"), .UNSPECIFIED.);\n");
            controls.iter().zip(next..).for_each(|(point, at)| push_point(text, at, *point));
        }
    }
}

/// Adds `#7, #8, #9`.
fn push_numbered(text: &mut Vec<u8>, from: usize, count: usize) {
    for index in from..from + count {
        push_line(text, &[(if index > from { ", #" } else { "#" }, index)], "");
    }
}

/// Adds the multiplicities of a knot vector.
fn push_multiplicities(text: &mut Vec<u8>, knots: &[f64]) {
    for (index, run) in knots.chunk_by(|a, b| a == b).enumerate() {
        push_line(text, &[(if index > 0 { ", " } else { "" }, run.len())], "");
    }
}

/// Adds the values of a knot vector, each once.
fn push_values(text: &mut Vec<u8>, knots: &[f64]) {
    push_reals(text, knots.chunk_by(|a, b| a == b).filter_map(|run| run.first().copied()));
}

impl StepLength for FaceSurface {
    fn step_length(&self) -> usize {
        match self {
            FaceSurface::Plane { .. } | FaceSurface::Cylinder { .. } => 5,
            FaceSurface::Spline(spline) => 1 + spline.controls.iter().map(Vec::len).sum::<usize>(),
        }
    }
}

impl StepSurface for FaceSurface {}

impl DisplayByStep for FaceSurface {
    fn fmt(&self, index: usize, f: &mut Formatter<'_>) -> Result {
        write_lines(f, |text| push_surface(text, index, self))
    }
}

fn push_surface(text: &mut Vec<u8>, index: usize, surface: &FaceSurface) {
    let next = index + 1;
    match surface {
        FaceSurface::Plane { origin, normal, along } => {
            push_line(text, &[("#", index), (" = PLANE('', #", next)], ");\n");
            push_placement(text, next, *origin, *normal, *along);
        }
        FaceSurface::Cylinder { origin, radius } => {
            push_line(text, &[("#", index), (" = CYLINDRICAL_SURFACE('', #", next)], ", ");
            push_real(text, *radius);
            text.extend_from_slice(b");\n");
            push_placement(text, next, *origin, Vector3::unit_z(), Vector3::unit_x());
        }
        FaceSurface::Spline(SplineSurface { u, v, controls }) => {
            push_line(text, &[("#", index)], " = B_SPLINE_SURFACE_WITH_KNOTS('', 3, 3, (");
            let mut from = next;
            for row in controls {
                text.extend_from_slice(if from > next { b", (" } else { b"(" });
                push_numbered(text, from, row.len());
                text.push(b')');
                from += row.len();
            }
            text.extend_from_slice(b"), .UNSPECIFIED., .F., .F., .F., (");
            push_multiplicities(text, u);
            text.extend_from_slice(b"), (");
            push_multiplicities(text, v);
            text.extend_from_slice(b"), (");
            push_values(text, u);
            text.extend_from_slice(b"), (");
            push_values(text, v);
            text.extend_from_slice(b"), .UNSPECIFIED.);\n");
            controls.iter().flatten().zip(next..).for_each(|(point, at)| push_point(text, at, *point));
        }
    }
}

impl StepLength for Place {
    fn step_length(&self) -> usize {
        1
    }
}

/// A vertex is written here so that its digits are those of the drawing.
impl DisplayByStep for Place {
    fn fmt(&self, index: usize, f: &mut Formatter<'_>) -> Result {
        write_lines(f, |text| push_point(text, index, self.0))
    }
}

/// Text in a STEP file: quotes doubled, runs of what is not ASCII as `\X2\…\X0\` or `\X4\…\X0\` (ISO 10303-21),
/// control characters left out. An apostrophe before a comma or a parenthesis is written by its code: OpenCASCADE 7.8
/// takes a doubled one there for the end of the text.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    // Hexadecimal digits of a character of the open run; 0 outside of one.
    let mut open = 0;
    let text: Vec<char> = text.chars().filter(|c| !c.is_control()).collect();
    for (index, c) in text.iter().copied().enumerate() {
        let code = u32::from(c);
        let digits = if c.is_ascii() {
            0
        } else if code <= 0xFFFF {
            4
        } else {
            8
        };
        if digits != open {
            if open != 0 {
                out.push_str("\\X0\\");
            }
            if digits != 0 {
                out.push_str(if digits == 4 { "\\X2\\" } else { "\\X4\\" });
            }
            open = digits;
        }
        match (digits, c) {
            (0, '\'') => {
                let next = text.iter().skip(index + 1).find(|c| **c != ' ');
                out.push_str(if matches!(next, Some(',' | ')')) { "\\X\\27" } else { "''" });
            }
            (0, '\\') => out.push_str("\\\\"),
            (0, c) => out.push(c),
            (digits, _) => out.push_str(&format!("{code:0digits$X}")),
        }
    }
    if open != 0 {
        out.push_str("\\X0\\");
    }
    out
}

/// The solid under a product name, with the time of its making where it is known (seconds since 1970 UTC, up to [`LATEST`]).
#[must_use]
pub fn write(solid: &Solid, product: &str, created: Option<u64>) -> Vec<u8> {
    write_marked(solid, product, created, "")
}

/// As [`write`](write()), with a remark in the description of the file.
#[must_use]
pub fn write_marked(solid: &Solid, product: &str, created: Option<u64>, remark: &str) -> Vec<u8> {
    let boundary = &solid.boundary;
    let edges: usize = boundary.boundaries.iter().map(|shell| shell.edges.len()).sum();
    let name = escaped(product);
    let remark = if remark.is_empty() { String::new() } else { format!(", '{}'", escaped(remark)) };
    let (version, time) = (env!("CARGO_PKG_VERSION"), time_stamp(created));
    let mut text = String::with_capacity(FRAME_ROOM + ROOM * edges);
    // A String takes all that is written to it.
    _ = write!(
        text,
        "ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('{name}'{remark}), '2;1');
FILE_NAME('{name}', '{time}', (''), (''), 'camgen {version}', 'camgen', '');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));
ENDSEC;
DATA;
#1 = APPLICATION_PROTOCOL_DEFINITION('international standard', 'automotive_design', 2000, #2);
#2 = APPLICATION_CONTEXT('core data for automotive mechanical design processes');
#3 = SHAPE_DEFINITION_REPRESENTATION(#4, #10);
#4 = PRODUCT_DEFINITION_SHAPE('', '', #5);
#5 = PRODUCT_DEFINITION('design', '', #6, #9);
#6 = PRODUCT_DEFINITION_FORMATION('', '', #7);
#7 = PRODUCT('{name}', '{name}', '', (#8));
#8 = PRODUCT_CONTEXT('', #2, 'mechanical');
#9 = PRODUCT_DEFINITION_CONTEXT('part definition', #2, 'design');
#10 = ADVANCED_BREP_SHAPE_REPRESENTATION('{name}', (#16), #11);
#11 = (GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#15)) GLOBAL_UNIT_ASSIGNED_CONTEXT((#12, #13, #14)) REPRESENTATION_CONTEXT('', '3D'));
#12 = (LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI., .METRE.));
#13 = (NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($, .RADIAN.));
#14 = (NAMED_UNIT(*) SI_UNIT($, .STERADIAN.) SOLID_ANGLE_UNIT());
#15 = UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-06), #12, 'distance_accuracy_value', 'confusion accuracy');
"
    );
    _ = write!(Entities { text: &mut text }, "{}", StepModel::from(boundary));
    // The category comes after the last of truck's entities, which stand in the order of their numbers.
    let category = text.trim_end().rsplit('\n').next().and_then(number).unwrap_or(16) + 1;
    _ = write!(
        text,
        "#{category} = PRODUCT_RELATED_PRODUCT_CATEGORY('part', '', (#7));
ENDSEC;
END-ISO-10303-21;
"
    );
    text.into_bytes()
}

/// Takes the entities that truck writes, without its frame, and with faces of the kind that CAD systems read.
struct Entities<'a> {
    text: &'a mut String,
}

impl Write for Entities<'_> {
    /// truck writes its frame in one part, and the kind of an entity whole.
    fn write_str(&mut self, part: &str) -> Result {
        if part.starts_with(FRAME) {
            return Ok(());
        }
        self.text.push_str(if part == FACE { ADVANCED_FACE } else { part });
        Ok(())
    }
}

/// The number of an entity, from its line.
fn number(line: &str) -> Option<u64> {
    let digits = line.strip_prefix('#')?.bytes().take_while(u8::is_ascii_digit);
    digits.map(|digit| u64::from(digit - b'0')).reduce(|number, digit| 10 * number + digit)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The dates of GNU date for these seconds.
    #[test]
    fn the_time_is_the_one_given_or_none() {
        for (seconds, text) in [
            (0, "1970-01-01T00:00:00+00:00"),
            (951_782_400, "2000-02-29T00:00:00+00:00"),
            (1_795_309_323, "2026-11-22T01:02:03+00:00"),
            (4_107_542_399, "2100-02-28T23:59:59+00:00"),
            (4_107_542_400, "2100-03-01T00:00:00+00:00"),
            (LATEST, "9999-12-31T23:59:59+00:00"),
        ] {
            assert_eq!(time_stamp(Some(seconds)), text);
        }
        assert_eq!(time_stamp(None), "");
        assert_eq!(time_stamp(Some(LATEST + 1)), "");
    }

    #[test]
    fn reals_have_a_point_and_texts_are_escaped() {
        for (value, text) in [(1.0, "1."), (-0.0, "0."), (0.1, "0.1"), (1.5e-17, "1.5E-17"), (2e-9, "2.E-9")] {
            let mut real = Vec::new();
            push_real(&mut real, value);
            assert_eq!(String::from_utf8(real), Ok(text.to_owned()));
        }
        assert_eq!(escaped("It's ДПИ\\\u{1}\n"), "It''s \\X2\\0414041F0418\\X0\\\\\\");
        assert_eq!(escaped("a', (b'), 'c'"), "a\\X\\27, (b\\X\\27), ''c''");
        assert_eq!(escaped("𝜑é"), "\\X4\\0001D711\\X0\\\\X2\\00E9\\X0\\");
    }
}

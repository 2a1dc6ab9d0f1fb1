//! The solid as a STEP file: AP214, millimetres, ASCII.
//!
//! truck-stepio numbers and writes topology and geometry; its frame is not used, because its product has no name, its
//! texts are not escaped and its faces are of a kind CAD systems do not read without a message. The frame is written here.

use super::number::shortest;
use super::{Format, FormatError, Rendering, When};
use crate::geometry::solid::{Boundary, Curve, FaceSurface, Solid, SolidError, SplineCurve, SplineSurface, conical};
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
/// First entity truck writes; the frame takes the numbers below.
const FIRST: &str = "#16 = ";
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

/// A real of a STEP file: shortest, with its decimal point.
fn real(value: f64) -> String {
    let mut text = String::with_capacity(24);
    push_real(&mut text, value);
    text
}

/// Adds the same to a text.
fn push_real(text: &mut String, value: f64) {
    let from = text.len();
    text.push_str(&shortest(value));
    let own = text.get(from..).unwrap_or_default();
    let pointed = own.bytes().any(|byte| byte == b'.');
    match own.bytes().position(|byte| byte == b'e') {
        Some(mantissa) => {
            let exponent = text.split_off(from + mantissa);
            text.push_str(if pointed { "E" } else { ".E" });
            text.push_str(exponent.trim_start_matches('e'));
        }
        None if pointed => {}
        None => text.push('.'),
    }
}

/// Writes a line of an entity of three reals.
fn triple(f: &mut Formatter<'_>, index: usize, kind: &str, reals: [f64; 3]) -> Result {
    let mut text = String::with_capacity(128);
    for part in ["#", &index.to_string(), " = ", kind, "('', ("] {
        text.push_str(part);
    }
    for (value, after) in reals.into_iter().zip([", ", ", ", "));\n"]) {
        push_real(&mut text, value);
        text.push_str(after);
    }
    f.write_str(&text)
}

fn point(f: &mut Formatter<'_>, index: usize, p: Point3) -> Result {
    triple(f, index, "CARTESIAN_POINT", p.into())
}

fn direction(f: &mut Formatter<'_>, index: usize, v: Vector3) -> Result {
    triple(f, index, "DIRECTION", v.into())
}

/// AXIS2_PLACEMENT_3D with its point and directions, in the lines from `index` on.
fn placement(f: &mut Formatter<'_>, index: usize, origin: Point3, axis: Vector3, along: Vector3) -> Result {
    let (a, b, c) = (index + 1, index + 2, index + 3);
    writeln!(f, "#{index} = AXIS2_PLACEMENT_3D('', #{a}, #{b}, #{c});")?;
    point(f, a, origin)?;
    direction(f, b, axis)?;
    direction(f, c, along)
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
        let next = index + 1;
        match self {
            Curve::Line { origin, direction: along } => {
                let (vector, unit) = (index + 2, index + 3);
                writeln!(f, "#{index} = LINE('', #{next}, #{vector});")?;
                point(f, next, *origin)?;
                writeln!(f, "#{vector} = VECTOR('', #{unit}, 1.);")?;
                direction(f, unit, *along)
            }
            Curve::Circle { centre, radius, .. } => {
                writeln!(f, "#{index} = CIRCLE('', #{next}, {});", real(*radius))?;
                placement(f, next, *centre, Vector3::unit_z(), Vector3::unit_x())
            }
            Curve::Spline(SplineCurve { knots, controls }) => {
                let (places, (counts, knots)) = (numbered(next, controls.len()), multiplicities(knots));
                writeln!(
                    f,
                    "#{index} = B_SPLINE_CURVE_WITH_KNOTS('', 3, ({places}), .UNSPECIFIED., .F., .F., ({counts}), \
                     ({knots}), .UNSPECIFIED.);"
                )?;
                controls.iter().zip(next..).try_for_each(|(p, at)| point(f, at, *p))
            }
        }
    }
}

/// `#7, #8, #9`.
fn numbered(from: usize, count: usize) -> String {
    (from..from + count).map(|at| format!("#{at}")).collect::<Vec<_>>().join(", ")
}

/// Multiplicities and values of a knot vector.
fn multiplicities(knots: &[f64]) -> (String, String) {
    let runs: Vec<&[f64]> = knots.chunk_by(|a, b| a == b).collect();
    let counts: Vec<String> = runs.iter().map(|run| run.len().to_string()).collect();
    let values: Vec<String> = runs.iter().filter_map(|run| run.first()).map(|value| real(*value)).collect();
    (counts.join(", "), values.join(", "))
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
        let next = index + 1;
        match self {
            FaceSurface::Plane { origin, normal, along } => {
                writeln!(f, "#{index} = PLANE('', #{next});")?;
                placement(f, next, *origin, *normal, *along)
            }
            FaceSurface::Cylinder { origin, radius } => {
                writeln!(f, "#{index} = CYLINDRICAL_SURFACE('', #{next}, {});", real(*radius))?;
                placement(f, next, *origin, Vector3::unit_z(), Vector3::unit_x())
            }
            FaceSurface::Spline(SplineSurface { u, v, controls }) => {
                let mut from = next;
                let mut rows = Vec::with_capacity(controls.len());
                for row in controls {
                    rows.push(format!("({})", numbered(from, row.len())));
                    from += row.len();
                }
                let ((u_counts, u), (v_counts, v)) = (multiplicities(u), multiplicities(v));
                writeln!(
                    f,
                    "#{index} = B_SPLINE_SURFACE_WITH_KNOTS('', 3, 3, ({}), .UNSPECIFIED., .F., .F., .F., ({u_counts}), \
                     ({v_counts}), ({u}), ({v}), .UNSPECIFIED.);",
                    rows.join(", ")
                )?;
                let places = controls.iter().flatten();
                places.zip(next..).try_for_each(|(p, at)| point(f, at, *p))
            }
        }
    }
}

/// A vertex, written here so that its digits are those of the drawing.
#[derive(Debug, Clone, Copy)]
struct Place(Point3);

impl StepLength for Place {
    fn step_length(&self) -> usize {
        1
    }
}

impl DisplayByStep for Place {
    fn fmt(&self, index: usize, f: &mut Formatter<'_>) -> Result {
        point(f, index, self.0)
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
    let boundary = with_places(&solid.boundary);
    let edges: usize = boundary.boundaries.iter().map(|shell| shell.edges.len()).sum();
    let mut written = String::with_capacity(ROOM * edges);
    // A String takes all that is written to it.
    _ = write!(written, "{}", StepModel::from(&boundary));
    let start = written.find(FIRST).unwrap_or(0);
    let data = written.get(start..).unwrap_or_default().replace("= FACE_SURFACE(", "= ADVANCED_FACE(");
    // The category comes after the last of truck's entities, which stand in the order of their numbers.
    let category = data.trim_end().rsplit('\n').next().and_then(number).unwrap_or(16) + 1;
    let name = escaped(product);
    let remark = if remark.is_empty() { String::new() } else { format!(", '{}'", escaped(remark)) };
    let (version, time) = (env!("CARGO_PKG_VERSION"), time_stamp(created));
    format!(
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
{data}#{category} = PRODUCT_RELATED_PRODUCT_CATEGORY('part', '', (#7));
ENDSEC;
END-ISO-10303-21;
"
    )
    .into_bytes()
}

/// The number of an entity, from its line.
fn number(line: &str) -> Option<u64> {
    let digits = line.strip_prefix('#')?.bytes().take_while(u8::is_ascii_digit);
    digits.map(|digit| u64::from(digit - b'0')).reduce(|number, digit| 10 * number + digit)
}

fn with_places(boundary: &Boundary) -> truck_topology::compress::CompressedSolid<Place, Curve, FaceSurface> {
    let shell = |shell: &truck_topology::compress::CompressedShell<Point3, Curve, FaceSurface>| {
        truck_topology::compress::CompressedShell {
            vertices: shell.vertices.iter().map(|point| Place(*point)).collect(),
            edges: shell.edges.clone(),
            faces: shell.faces.clone(),
        }
    };
    truck_topology::compress::CompressedSolid { boundaries: boundary.boundaries.iter().map(shell).collect() }
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
            assert_eq!(real(value), text);
        }
        assert_eq!(escaped("It's ДПИ\\\u{1}\n"), "It''s \\X2\\0414041F0418\\X0\\\\\\");
        assert_eq!(escaped("a', (b'), 'c'"), "a\\X\\27, (b\\X\\27), ''c''");
        assert_eq!(escaped("𝜑é"), "\\X4\\0001D711\\X0\\\\X2\\00E9\\X0\\");
    }
}

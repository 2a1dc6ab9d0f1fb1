//! The solid as a STEP file: AP214, millimetres, ASCII.
//!
//! truck-stepio numbers and writes topology and geometry. Its frame has a product without a name and texts that are not escaped, its faces
//! are of a kind that CAD systems accept only with a message, and its reals have ten digits: camgen writes these itself.

use super::number::shortest;
use super::{FormatSelection, Rendering, View};
use camgen_kernel::geometry::solid::{
    CheckedSolid, EdgeCurve, FaceSurface, SolidVertex, SplineCurve, SplineSurface, TruckBoundary, flank_solid,
    not_closed,
};
use camgen_kernel::refusal::Refusal;
use chrono::{DateTime, SecondsFormat};
use std::fmt::{Formatter, Result};
use truck_modeling::{Point3, Vector3};
use truck_stepio::out::{
    DisplayByStep, IndexSliceDisplay, SliceDisplay, StepCurve, StepLength, StepModel, StepSurface,
};
use truck_topology::compress::{CompressedEdge, CompressedFace, CompressedShell, CompressedSolid};

/// The solid.
pub const FORMAT: View = View {
    name: "step",
    when: FormatSelection::Usual,
    flank: true,
    unfit: |body| body.height().is_none().then_some("cam.thickness is not given, which a solid needs: set it"),
    endings: |_| vec![".step".into()],
    write: |cam| Ok(vec![write_marked(&solid(cam)?, &cam.report.title(), cam.created, &cam.report.mark())]),
    of_analysis: None,
};

fn solid(cam: &Rendering<'_>) -> std::result::Result<CheckedSolid, Refusal> {
    let (low, high) = cam.body.height().unwrap_or_default();
    if let Some(swept) = &cam.drawn.swept {
        return Ok(swept.solid.clone());
    }
    let Some(part) = cam.drawn.parts.first() else { return Err(not_closed("no part")) };
    match &cam.drawn.flank {
        Some(flank) => flank_solid(&flank.patches, &part.hole_contours(), (low, high), flank.volume),
        None => part.solid(high - low),
    }
}

/// Number of the solid, behind the entities of the frame.
const SOLID: usize = 16;
/// The last second of the year 9999: a date of ISO 8601 has four digits for the year.
pub const LATEST: u64 = 253_402_300_799;

/// The time stamp of FILE_NAME, by ISO 8601; without a time, or after [`LATEST`], the empty text, which the schema allows
/// and which means that no time is known.
fn time_stamp(created: Option<u64>) -> String {
    let seconds = created.filter(|seconds| *seconds <= LATEST).and_then(|seconds| i64::try_from(seconds).ok());
    let date = seconds.and_then(|seconds| DateTime::from_timestamp(seconds, 0));
    date.map_or_else(String::new, |date| date.to_rfc3339_opts(SecondsFormat::Secs, false))
}

/// A real of a STEP file: shortest, with its decimal point.
pub(super) fn real(value: f64) -> String {
    let text = shortest(value);
    match text.split_once('e') {
        Some((mantissa, exponent)) if mantissa.contains('.') => format!("{mantissa}E{exponent}"),
        Some((mantissa, exponent)) => format!("{mantissa}.E{exponent}"),
        None if text.contains('.') => text,
        None => format!("{text}."),
    }
}

/// Reals with a comma between two.
fn reals(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(real).collect::<Vec<_>>().join(", ")
}

/// The line of an entity of three reals: a point or a direction.
fn triple(f: &mut Formatter<'_>, index: usize, kind: &str, values: [f64; 3]) -> Result {
    writeln!(f, "#{index} = {kind}('', ({}));", reals(values))
}

fn point(f: &mut Formatter<'_>, index: usize, point: Point3) -> Result {
    triple(f, index, "CARTESIAN_POINT", point.into())
}

fn direction(f: &mut Formatter<'_>, index: usize, direction: Vector3) -> Result {
    triple(f, index, "DIRECTION", direction.into())
}

/// AXIS2_PLACEMENT_3D with its point and directions, in the lines from `index` on.
fn placement(f: &mut Formatter<'_>, index: usize, origin: Point3, axis: Vector3, along: Vector3) -> Result {
    let (a, b, c) = (index + 1, index + 2, index + 3);
    writeln!(f, "#{index} = AXIS2_PLACEMENT_3D('', #{a}, #{b}, #{c});")?;
    point(f, a, origin)?;
    direction(f, b, axis)?;
    direction(f, c, along)
}

/// Multiplicities and values of a knot vector, each value once.
fn multiplicities(knots: &[f64]) -> (Vec<usize>, String) {
    let runs = || knots.chunk_by(|a, b| a == b);
    (runs().map(<[f64]>::len).collect(), reals(runs().filter_map(|run| run.first().copied())))
}

/// A part of a solid as it is written: the traits of the writer are of another crate than the solid.
#[derive(Debug, Clone, Copy)]
struct InStep<'a, T>(&'a T);

/// The solid, of parts that can be written.
fn in_step(
    solid: &TruckBoundary,
) -> CompressedSolid<InStep<'_, SolidVertex>, InStep<'_, EdgeCurve>, InStep<'_, FaceSurface>> {
    let boundaries = solid.boundaries.iter().map(|shell| CompressedShell {
        vertices: shell.vertices.iter().map(InStep).collect(),
        edges: shell
            .edges
            .iter()
            .map(|edge| CompressedEdge { vertices: edge.vertices, curve: InStep(&edge.curve) })
            .collect(),
        faces: shell
            .faces
            .iter()
            .map(|face| CompressedFace {
                boundaries: face.boundaries.clone(),
                orientation: face.orientation,
                surface: InStep(&face.surface),
            })
            .collect(),
    });
    CompressedSolid { boundaries: boundaries.collect() }
}

impl StepLength for InStep<'_, EdgeCurve> {
    fn step_length(&self) -> usize {
        match self.0 {
            EdgeCurve::Line { .. } => 4,
            EdgeCurve::Circle { .. } => 5,
            EdgeCurve::Spline(spline) => 1 + spline.controls.len(),
        }
    }
}

impl StepCurve for InStep<'_, EdgeCurve> {
    fn same_sense(&self) -> bool {
        !matches!(self.0, EdgeCurve::Circle { clockwise: true, .. })
    }
}

impl DisplayByStep for InStep<'_, EdgeCurve> {
    fn fmt(&self, index: usize, f: &mut Formatter<'_>) -> Result {
        let next = index + 1;
        match self.0 {
            EdgeCurve::Line { origin, direction: along } => {
                let (vector, unit) = (index + 2, index + 3);
                writeln!(f, "#{index} = LINE('', #{next}, #{vector});")?;
                point(f, next, *origin)?;
                writeln!(f, "#{vector} = VECTOR('', #{unit}, 1.);")?;
                direction(f, unit, *along)
            }
            EdgeCurve::Circle { centre, radius, .. } => {
                writeln!(f, "#{index} = CIRCLE('', #{next}, {});", real(*radius))?;
                placement(f, next, *centre, Vector3::unit_z(), Vector3::unit_x())
            }
            EdgeCurve::Spline(SplineCurve { knots, controls }) => {
                let places = IndexSliceDisplay(next..next + controls.len());
                let (counts, knots) = multiplicities(knots);
                let counts = SliceDisplay(&counts);
                write!(f, "#{index} = B_SPLINE_CURVE_WITH_KNOTS('', 3, {places}, .UNSPECIFIED., .F., .F., ")?;
                writeln!(f, "{counts}, ({knots}), .UNSPECIFIED.);")?;
                controls.iter().zip(next..).try_for_each(|(control, at)| point(f, at, *control))
            }
        }
    }
}

impl StepLength for InStep<'_, FaceSurface> {
    fn step_length(&self) -> usize {
        match self.0 {
            FaceSurface::Spline(spline) => 1 + spline.controls.iter().map(Vec::len).sum::<usize>(),
            _ => 5,
        }
    }
}

impl StepSurface for InStep<'_, FaceSurface> {}

impl DisplayByStep for InStep<'_, FaceSurface> {
    fn fmt(&self, index: usize, f: &mut Formatter<'_>) -> Result {
        let next = index + 1;
        match self.0 {
            FaceSurface::Plane { origin, normal, along } => {
                writeln!(f, "#{index} = PLANE('', #{next});")?;
                placement(f, next, *origin, *normal, *along)
            }
            FaceSurface::Cylinder { origin, radius } => {
                writeln!(f, "#{index} = CYLINDRICAL_SURFACE('', #{next}, {});", real(*radius))?;
                placement(f, next, *origin, Vector3::unit_z(), Vector3::unit_x())
            }
            FaceSurface::Cone { at: (z, radius), angle } => {
                writeln!(f, "#{index} = CONICAL_SURFACE('', #{next}, {}, {});", real(*radius), real(angle.abs()))?;
                let up = Vector3::new(0.0, 0.0, angle.signum());
                placement(f, next, Point3::new(0.0, 0.0, *z), up, Vector3::unit_x())
            }
            FaceSurface::Torus { major, minor } => {
                writeln!(f, "#{index} = TOROIDAL_SURFACE('', #{next}, {}, {});", real(*major), real(*minor))?;
                placement(f, next, Point3::new(0.0, 0.0, 0.0), Vector3::unit_z(), Vector3::unit_x())
            }
            FaceSurface::Spline(SplineSurface { u, v, controls }) => {
                let mut from = next;
                let row = |row: &Vec<Point3>| {
                    from += row.len();
                    IndexSliceDisplay(from - row.len()..from)
                };
                let rows: Vec<_> = controls.iter().map(row).collect();
                let rows = SliceDisplay(&rows);
                let ((u_counts, u), (v_counts, v)) = (multiplicities(u), multiplicities(v));
                let (u_counts, v_counts) = (SliceDisplay(&u_counts), SliceDisplay(&v_counts));
                write!(f, "#{index} = B_SPLINE_SURFACE_WITH_KNOTS('', 3, 3, {rows}, .UNSPECIFIED., .F., .F., .F., ")?;
                writeln!(f, "{u_counts}, {v_counts}, ({u}), ({v}), .UNSPECIFIED.);")?;
                controls.iter().flatten().zip(next..).try_for_each(|(control, at)| point(f, at, *control))
            }
        }
    }
}

impl StepLength for InStep<'_, SolidVertex> {
    fn step_length(&self) -> usize {
        1
    }
}

impl DisplayByStep for InStep<'_, SolidVertex> {
    fn fmt(&self, index: usize, f: &mut Formatter<'_>) -> Result {
        point(f, index, self.0.0)
    }
}

/// Text in a STEP file: quotes doubled, runs of what is not ASCII as `\X2\…\X0\` or `\X4\…\X0\` (ISO 10303-21),
/// control characters left out. An apostrophe before a comma or a parenthesis is written by its code: OpenCASCADE 7.8
/// takes a doubled one there for the end of the text.
pub(super) fn escaped(text: &str) -> String {
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

/// The entities of a solid, which is the first of them, from a number on, and how many they are.
pub(super) fn solid_entities(solid: &CheckedSolid, from: usize) -> (String, usize) {
    let model = StepModel::from(&in_step(&solid.boundary)).to_string();
    let start = model.find(&format!("#{SOLID} = ")).unwrap_or_default();
    let data = model.get(start..).unwrap_or_default().replace(" = FACE_SURFACE(", " = ADVANCED_FACE(");
    // Each entity of truck has a line of its own.
    let count = data.lines().count();
    if from == SOLID {
        return (data, count);
    }
    let mut parts = data.split('#');
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let digits = part.find(|c: char| !c.is_ascii_digit()).unwrap_or(part.len());
        let (number, rest) = part.split_at(digits);
        let number = number.parse::<usize>().map_or(0, |number| number + from - SOLID);
        text.push_str(&format!("#{number}{rest}"));
    }
    (text, count)
}

/// The solid under a product name, with the time of its making where known (seconds since 1970 UTC, up to [`LATEST`]).
#[must_use]
pub fn write(solid: &CheckedSolid, product: &str, created: Option<u64>) -> Vec<u8> {
    write_marked(solid, product, created, "")
}

/// As [`write`](write()), with a remark in the description of the file.
#[must_use]
pub fn write_marked(solid: &CheckedSolid, product: &str, created: Option<u64>, remark: &str) -> Vec<u8> {
    let (data, count) = solid_entities(solid, SOLID);
    let category = SOLID + count;
    let name = escaped(product);
    let shape = format!("ADVANCED_BREP_SHAPE_REPRESENTATION('{name}', (#16), #11)");
    let data = format!("{data}#{category} = PRODUCT_RELATED_PRODUCT_CATEGORY('part', '', (#7));\n");
    exchange_file((product, created, remark), &shape, &data)
}

/// A file of one product: with the time of its making where known and a remark in the description of the file, with the representation of its shape
/// and with the entities from number 16 on, a line each.
pub(super) fn exchange_file(
    (product, created, remark): (&str, Option<u64>, &str),
    shape: &str,
    entities: &str,
) -> Vec<u8> {
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
#10 = {shape};
#11 = (GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#15)) GLOBAL_UNIT_ASSIGNED_CONTEXT((#12, #13, #14)) REPRESENTATION_CONTEXT('', '3D'));
#12 = (LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI., .METRE.));
#13 = (NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($, .RADIAN.));
#14 = (NAMED_UNIT(*) SI_UNIT($, .STERADIAN.) SOLID_ANGLE_UNIT());
#15 = UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-06), #12, 'distance_accuracy_value', 'confusion accuracy');
{entities}ENDSEC;
END-ISO-10303-21;
"
    )
    .into_bytes()
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

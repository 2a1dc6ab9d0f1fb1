//! The solid as a STEP file: AP214, millimetres, ASCII.
//!
//! Topology and geometry are numbered and written as truck-stepio does it, which the tests compare; by itself it takes four times as
//! long. Its frame has a product without a name and texts that are not escaped, and its faces are of a kind that CAD systems do not read
//! without a message: those are our own.

use super::number::{PLAIN, push_shortest};
use super::{Format, FormatError, Rendering, When};
use crate::geometry::solid::{Curve, FaceSurface, Shell, Solid, SolidError, SplineCurve, SplineSurface, conical};
use crate::numeric::decimal::push_whole;
use std::io::Write as _;
use truck_modeling::{Point3, Vector3};
use truck_topology::compress::{CompressedEdge, CompressedFace};

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

fn solid(cam: &Rendering<'_>) -> Result<Solid, FormatError> {
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
/// Number of the solid, behind the entities of the frame.
const SOLID: usize = 16;
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
    if value == 0.0 || PLAIN.contains(&value.abs()) {
        #[expect(clippy::cast_possible_truncation, reason = "it fits into 64 bits")]
        let whole = value as i64;
        #[expect(clippy::cast_precision_loss, reason = "of a whole number nothing is lost")]
        text.extend_from_slice(if whole as f64 == value { b"." } else { b"" });
        return;
    }
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
    // Most are those of the two axes.
    match direction {
        Vector3 { x: 0.0, y: 0.0, z: 1.0 } => push_line(text, &[("#", index)], " = DIRECTION('', (0., 0., 1.));\n"),
        Vector3 { x: 1.0, y: 0.0, z: 0.0 } => push_line(text, &[("#", index)], " = DIRECTION('', (1., 0., 0.));\n"),
        other => push_triple(text, index, " = DIRECTION('', (", other.into()),
    }
}

/// Adds AXIS2_PLACEMENT_3D with its point and directions, in the lines from `index` on.
fn push_placement(text: &mut Vec<u8>, index: usize, origin: Point3, axis: Vector3, along: Vector3) {
    let (a, b, c) = (index + 1, index + 2, index + 3);
    push_line(text, &[("#", index), (" = AXIS2_PLACEMENT_3D('', #", a), (", #", b), (", #", c)], ");\n");
    push_point(text, a, origin);
    push_direction(text, b, axis);
    push_direction(text, c, along);
}

/// The end of an entity whose last value is a logical one.
fn ends_with(value: bool) -> &'static str {
    if value { ", .T.);\n" } else { ", .F.);\n" }
}

/// Entities of a curve with what it refers to.
fn curve_entities(curve: &Curve) -> usize {
    match curve {
        Curve::Line { .. } => 4,
        Curve::Circle { .. } => 5,
        Curve::Spline(spline) => 1 + spline.controls.len(),
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

/// Entities of a surface with what it refers to.
fn surface_entities(surface: &FaceSurface) -> usize {
    match surface {
        FaceSurface::Plane { .. } | FaceSurface::Cylinder { .. } => 5,
        FaceSurface::Spline(spline) => 1 + spline.controls.iter().map(Vec::len).sum::<usize>(),
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

/// Numbers of the first of all entities of a kind: faces with their bounds, edges, vertices, surfaces, curves, points.
struct Numbers {
    edges: usize,
    vertices: usize,
    surfaces: usize,
    curves: usize,
    points: usize,
    end: usize,
}

/// Entities of a face with its bounds: each has its loop and the uses of its edges.
fn face_entities(face: &CompressedFace<FaceSurface>) -> usize {
    1 + face.boundaries.iter().map(|bound| 2 + bound.len()).sum::<usize>()
}

impl Numbers {
    fn of(shell: &Shell, faces: usize) -> Self {
        let edges = faces + shell.faces.iter().map(face_entities).sum::<usize>();
        let vertices = edges + shell.edges.len();
        let surfaces = vertices + shell.vertices.len();
        let curves = surfaces + shell.faces.iter().map(|face| surface_entities(&face.surface)).sum::<usize>();
        let points = curves + shell.edges.iter().map(|edge| curve_entities(&edge.curve)).sum::<usize>();
        Self { edges, vertices, surfaces, curves, points, end: points + shell.vertices.len() }
    }
}

/// Adds a solid of one shell, whose number this is; the number behind its last entity.
fn push_solid(text: &mut Vec<u8>, shell: &Shell, index: usize) -> usize {
    let faces = index + 2;
    let numbers = Numbers::of(shell, faces);
    push_line(text, &[("#", index), (" = MANIFOLD_SOLID_BREP('', #", index + 1)], ");\n");
    push_line(text, &[("#", index + 1)], " = CLOSED_SHELL('', (");
    let mut at = faces;
    for face in &shell.faces {
        push_line(text, &[(if at > faces { ", #" } else { "#" }, at)], "");
        at += face_entities(face);
    }
    text.extend_from_slice(b"));\n");
    let (mut at, mut surface) = (faces, numbers.surfaces);
    for face in &shell.faces {
        push_face(text, at, face, (surface, numbers.edges));
        at += face_entities(face);
        surface += surface_entities(&face.surface);
    }
    let mut curve = numbers.curves;
    for (edge, at) in shell.edges.iter().zip(numbers.edges..) {
        push_edge(text, at, edge, (numbers.vertices, curve));
        curve += curve_entities(&edge.curve);
    }
    for (at, point) in (numbers.vertices..numbers.surfaces).zip(numbers.points..) {
        push_line(text, &[("#", at), (" = VERTEX_POINT('', #", point)], ");\n");
    }
    let mut at = numbers.surfaces;
    for face in &shell.faces {
        push_surface(text, at, &face.surface);
        at += surface_entities(&face.surface);
    }
    for edge in &shell.edges {
        push_curve(text, at, &edge.curve);
        at += curve_entities(&edge.curve);
    }
    shell.vertices.iter().zip(at..).for_each(|(vertex, at)| push_point(text, at, vertex.0));
    numbers.end
}

/// Adds a face with its bounds; of its surface the number, and that of the first edge.
fn push_face(text: &mut Vec<u8>, index: usize, face: &CompressedFace<FaceSurface>, (surface, edges): (usize, usize)) {
    push_line(text, &[("#", index)], " = ADVANCED_FACE('', (");
    let mut at = index + 1;
    for bound in &face.boundaries {
        push_line(text, &[(if at > index + 1 { ", #" } else { "#" }, at)], "");
        at += 2 + bound.len();
    }
    push_line(text, &[("), #", surface)], ends_with(face.orientation));
    let mut at = index + 1;
    for bound in &face.boundaries {
        let (ring, uses) = (at + 1, at + 2);
        push_line(text, &[("#", at), (" = FACE_BOUND('', #", ring)], ends_with(face.orientation));
        push_line(text, &[("#", ring)], " = EDGE_LOOP('', (");
        push_numbered(text, uses, bound.len());
        text.extend_from_slice(b"));\n");
        for (used, at) in bound.iter().zip(uses..) {
            let edge = edges + used.index;
            push_line(text, &[("#", at), (" = ORIENTED_EDGE('', *, *, #", edge)], ends_with(used.orientation));
        }
        at = uses + bound.len();
    }
}

/// Adds an edge; of the first vertex the number, and that of its curve.
fn push_edge(text: &mut Vec<u8>, index: usize, edge: &CompressedEdge<Curve>, (vertices, curve): (usize, usize)) {
    let (start, end) = (vertices + edge.vertices.0, vertices + edge.vertices.1);
    let clockwise = matches!(edge.curve, Curve::Circle { clockwise: true, .. });
    let parts = [("#", index), (" = EDGE_CURVE('', #", start), (", #", end), (", #", curve)];
    push_line(text, &parts, ends_with(!clockwise));
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
    let mut text = Vec::with_capacity(FRAME_ROOM + ROOM * edges);
    // A text in memory takes all that is written.
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
    // A part has no voids: it is one shell.
    let category = boundary.boundaries.first().map_or(SOLID, |shell| push_solid(&mut text, shell, SOLID));
    _ = write!(
        text,
        "#{category} = PRODUCT_RELATED_PRODUCT_CATEGORY('part', '', (#7));
ENDSEC;
END-ISO-10303-21;
"
    );
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::{Contour, Cubic, Edge, Segment};
    use crate::geometry::solid::{Place, prism};
    use nalgebra::Vector2;
    use std::fmt::{Formatter, Result};
    use truck_stepio::out::{DisplayByStep, StepCurve, StepLength, StepModel, StepSurface};

    fn as_text(f: &mut Formatter<'_>, push: impl FnOnce(&mut Vec<u8>)) -> Result {
        let mut text = Vec::new();
        push(&mut text);
        f.write_str(std::str::from_utf8(&text).map_err(|_| std::fmt::Error)?)
    }

    impl StepLength for Curve {
        fn step_length(&self) -> usize {
            curve_entities(self)
        }
    }

    impl StepCurve for Curve {
        fn same_sense(&self) -> bool {
            !matches!(self, Curve::Circle { clockwise: true, .. })
        }
    }

    impl DisplayByStep for Curve {
        fn fmt(&self, index: usize, f: &mut Formatter<'_>) -> Result {
            as_text(f, |text| push_curve(text, index, self))
        }
    }

    impl StepLength for FaceSurface {
        fn step_length(&self) -> usize {
            surface_entities(self)
        }
    }

    impl StepSurface for FaceSurface {}

    impl DisplayByStep for FaceSurface {
        fn fmt(&self, index: usize, f: &mut Formatter<'_>) -> Result {
            as_text(f, |text| push_surface(text, index, self))
        }
    }

    impl StepLength for Place {
        fn step_length(&self) -> usize {
            1
        }
    }

    impl DisplayByStep for Place {
        fn fmt(&self, index: usize, f: &mut Formatter<'_>) -> Result {
            as_text(f, |text| push_point(text, index, self.0))
        }
    }

    /// Faces, edges and vertices are numbered and written as by truck, but for the kind of a face.
    #[test]
    fn topology_is_as_truck_writes_it() {
        let at = Vector2::new;
        let arch = Cubic { points: [at(40.0, 0.0), at(40.0, 30.0), at(-40.0, 30.0), at(-40.0, 0.0)] };
        let bottom = Segment { start: at(-40.0, 0.0), end: at(40.0, 0.0), bulge: 0.5 };
        let outline = Contour::of([Edge::Cubic(arch), Edge::Segment(bottom)]);
        let hole = Contour::circle(at(0.0, 3.0), 5.0).reversed();
        let area = outline.area_and_centroid().0 + hole.area_and_centroid().0;
        let solid = prism(&[outline, hole], area, 12.0).expect("a solid");
        let mut text = Vec::new();
        let end = push_solid(&mut text, &solid.boundary.boundaries[0], SOLID);
        let text = String::from_utf8(text).expect("ASCII");
        let other = StepModel::from(&solid.boundary).to_string().replace("FACE_SURFACE(", "ADVANCED_FACE(");
        let frame = other.find("#16 = ").expect("the first entity behind the frame");
        assert_eq!(text, other[frame..]);
        assert!(text.lines().last().is_some_and(|line| line.starts_with(&format!("#{} = ", end - 1))));
    }

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

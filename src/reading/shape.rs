//! What the kinds of entities cut, in their own coordinates.

use super::curve::Bezier;
use super::record::{Fault, Record, fault};
use super::spline;
use crate::geometry::contour::{Contour, Segment, Vertex};
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Kinds that tell a reader something and cut nothing.
const INFORMATION: &[&str] = &[
    "ACAD_TABLE",
    "ARCALIGNEDTEXT",
    "ARC_DIMENSION",
    "ATTDEF",
    "ATTRIB",
    "CAMERA",
    "DGNUNDERLAY",
    "DIMENSION",
    "DWFUNDERLAY",
    "GEOPOSITIONMARKER",
    "HATCH",
    "IMAGE",
    "LARGE_RADIAL_DIMENSION",
    "LEADER",
    "LIGHT",
    "MTEXT",
    "MULTILEADER",
    "OLE2FRAME",
    "OLEFRAME",
    "PDFUNDERLAY",
    "POINT",
    "POSITIONMARKER",
    "RTEXT",
    "SUN",
    "TEXT",
    "TOLERANCE",
    "VIEWPORT",
    "WIPEOUT",
];

/// Bits of the flags (70) of a POLYLINE.
const CLOSED: i64 = 1;
const SPLINE_FIT: i64 = 4;
const SPATIAL: i64 = 8;
const MESH: i64 = 16 | 64;
/// Bits of the flags of a VERTEX.
const FRAME_OF_SPLINE: i64 = 16;
const OF_SPATIAL: i64 = 32;
const OF_MESH: i64 = 64 | 128;

/// Ends of a closed polyline that are one, mm: the side between them has no length.
const REPEATED: f64 = 1e-6;

/// A part of what is cut.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Piece {
    Segment(Segment),
    Curve(Bezier),
}

/// What an entity cuts.
#[derive(Debug, Default)]
pub(super) struct Shape {
    /// In a row, each from where the one before ends.
    pub(super) pieces: Vec<Piece>,
    /// Coordinates are those of somebody who sees the drawing from behind.
    pub(super) from_behind: bool,
    /// Heights that its points have.
    pub(super) heights: Vec<f64>,
    /// Widest that the line is drawn, mm.
    pub(super) width: f64,
}

impl Shape {
    fn of(segments: impl IntoIterator<Item = Segment>, height: f64) -> Self {
        Self { pieces: segments.into_iter().map(Piece::Segment).collect(), heights: vec![height], ..Self::default() }
    }
}

/// Whether it tells a reader something and cuts nothing.
pub(super) fn is_information(record: &Record<'_>) -> bool {
    record.is_one_of(INFORMATION)
}

/// What an entity cuts; `vertices` are those of a POLYLINE. `None` when its kind is not known to be cut.
pub(super) fn shape(record: &Record<'_>, vertices: &[Record<'_>]) -> Result<Option<Shape>, Fault> {
    let curved = |(curves, heights): (Vec<Bezier>, Vec<f64>)| Shape {
        pieces: curves.into_iter().map(Piece::Curve).collect(),
        heights,
        ..Shape::default()
    };
    Ok(Some(match record.kind().as_str() {
        "LINE" => line(record)?,
        "ARC" => arc(record)?,
        "CIRCLE" => circle(record)?,
        "LWPOLYLINE" => lightweight_polyline(record)?,
        "POLYLINE" => polyline(record, vertices)?,
        "ELLIPSE" => curved(spline::ellipse(record)?),
        "SPLINE" => curved(spline::spline(record)?),
        _ => return Ok(None),
    }))
}

fn line(record: &Record<'_>) -> Result<Shape, Fault> {
    let (start, end) = (record.point(10)?, record.point(11)?);
    let segment = Segment { start: start.xy(), end: end.xy(), bulge: 0.0 };
    Ok(Shape { heights: vec![start.z, end.z], ..Shape::of([segment], 0.0) })
}

fn radius(record: &Record<'_>) -> Result<f64, Fault> {
    let radius = record.needed(40)?;
    if radius < 0.0 { fault("has a radius below 0") } else { Ok(radius) }
}

fn circle(record: &Record<'_>) -> Result<Shape, Fault> {
    let (centre, radius) = (record.point(10)?, radius(record)?);
    let circle = Contour::circle(centre.xy(), radius);
    Ok(Shape {
        from_behind: record.is_seen_from_behind()?,
        ..Shape::of(circle.segments().unwrap_or_default(), centre.z)
    })
}

fn arc(record: &Record<'_>) -> Result<Shape, Fault> {
    let (centre, radius) = (record.point(10)?, radius(record)?);
    let (from, to) = (record.needed(50)?, record.needed(51)?);
    let swept = (to - from).rem_euclid(360.0);
    // From 0 to 360 degrees is all round.
    let swept = if swept == 0.0 && from != to { 360.0 } else { swept };
    let on = |degrees: f64| {
        let angle = degrees.to_radians();
        centre.xy() + Vector2::new(libm::cos(angle), libm::sin(angle)) * radius
    };
    let segment = |start: Vector2<f64>, end: Vector2<f64>, swept: f64| Segment {
        start,
        end,
        bulge: libm::tan(0.25 * swept.to_radians()),
    };
    let end = if swept == 360.0 { on(from) } else { on(to) };
    let segments = if swept > 180.0 {
        let middle = on(from + 0.5 * swept);
        vec![segment(on(from), middle, 0.5 * swept), segment(middle, end, 0.5 * swept)]
    } else {
        vec![segment(on(from), end, swept)]
    };
    Ok(Shape { from_behind: record.is_seen_from_behind()?, ..Shape::of(segments, centre.z) })
}

/// The sides of a polyline; a closed one may repeat its first vertex as its last.
fn sides(mut vertices: Vec<Vertex>, closed: bool) -> Result<Vec<Segment>, Fault> {
    if vertices.len() < 2 {
        return fault("has fewer than two vertices");
    }
    let repeats = match (vertices.first(), vertices.last()) {
        (Some(first), Some(last)) => vertices.len() > 2 && (last.point - first.point).norm() <= REPEATED,
        _ => false,
    };
    if closed && repeats {
        vertices.pop();
    }
    let mut segments: Vec<Segment> = Contour { vertices }.segments().unwrap_or_default();
    if !closed {
        segments.pop();
    }
    Ok(segments)
}

fn lightweight_polyline(record: &Record<'_>) -> Result<Shape, Fault> {
    let mut vertices: Vec<[Option<f64>; 5]> = Vec::new();
    for group in record.groups {
        let place = match group.code {
            10 => 0,
            20 => 1,
            42 => 2,
            40 => 3,
            41 => 4,
            _ => continue,
        };
        if place == 0 {
            vertices.push([None; 5]);
        }
        // What stands before the first vertex belongs to none.
        let Some(slot) = vertices.last_mut().and_then(|vertex| vertex.get_mut(place)) else { continue };
        if slot.replace(group.value.real()?).is_some() {
            return fault(format!("tells group {} twice for a vertex", group.code));
        }
    }
    let told = record.whole(90, i64::try_from(vertices.len()).unwrap_or(i64::MAX))?;
    if usize::try_from(told) != Ok(vertices.len()) {
        return fault(format!("has {} vertices and says that they are {told}", vertices.len()));
    }
    let widths = vertices.iter().flat_map(|[.., start, end]| [start, end]).flatten();
    let width = widths.fold(record.real(43, 0.0)?.abs(), |widest, width| widest.max(width.abs()));
    let vertex = |[x, y, bulge, ..]: &[Option<f64>; 5]| match (x, y) {
        (Some(x), Some(y)) => Ok(Vertex::new(Vector2::new(*x, *y), bulge.unwrap_or(0.0))),
        _ => fault("has a vertex of which only x is told"),
    };
    let vertices: Vec<Vertex> = vertices.iter().map(vertex).collect::<Result<_, _>>()?;
    let segments = sides(vertices, record.whole(70, 0)? & CLOSED != 0)?;
    Ok(Shape { from_behind: record.is_seen_from_behind()?, width, ..Shape::of(segments, record.real(38, 0.0)?) })
}

fn polyline(record: &Record<'_>, vertices: &[Record<'_>]) -> Result<Shape, Fault> {
    let flags = record.whole(70, 0)?;
    if flags & MESH != 0 {
        return fault("is a mesh");
    }
    let spatial = flags & SPATIAL != 0;
    let elevation = record.real(30, 0.0)?;
    let mut heights = if spatial { Vec::new() } else { vec![elevation] };
    let mut width = record.real(40, 0.0)?.abs().max(record.real(41, 0.0)?.abs());
    let mut found = Vec::with_capacity(vertices.len());
    for vertex in vertices {
        let (point, bulge, kind) = (vertex.point(10)?, vertex.real(42, 0.0)?, vertex.whole(70, 0)?);
        if kind & FRAME_OF_SPLINE != 0 {
            // Some readers take them for the outline.
            return fault(if flags & SPLINE_FIT != 0 {
                "is fitted by a spline and keeps the points of its frame, which lie off the line"
            } else {
                "has points of a spline's frame among its vertices, which lie off the line"
            });
        }
        if kind & OF_MESH != 0 || kind & OF_SPATIAL != 0 && !spatial {
            return fault("has vertices that belong to a mesh or a line in space");
        }
        if spatial && bulge != 0.0 {
            return fault("is a line in space with arcs");
        }
        if spatial || point.z != 0.0 {
            heights.push(point.z);
        }
        width = width.max(vertex.real(40, 0.0)?.abs()).max(vertex.real(41, 0.0)?.abs());
        found.push(Vertex::new(point.xy(), bulge));
    }
    let segments = sides(found, flags & CLOSED != 0)?;
    let from_behind = if spatial { false } else { record.is_seen_from_behind()? };
    Ok(Shape { from_behind, heights, width, ..Shape::of(segments, 0.0) })
}

/// An arc as curves, for a map under which it does not stay one.
pub(super) fn as_curves(segment: &Segment) -> Vec<Bezier> {
    if segment.bulge == 0.0 {
        return vec![Bezier::polynomial(&[segment.start, segment.end])];
    }
    let centre = segment.centre();
    let a = segment.start - centre;
    let b = Vector2::new(-a.y, a.x);
    let mut curves = Bezier::ellipse(centre, (a, b), (0.0, segment.sweep().clamp(-2.0 * PI, 2.0 * PI)));
    // The ends as they are told.
    if let Some(pole) = curves.first_mut().and_then(|curve| curve.poles.first_mut()) {
        *pole = [segment.start.x, segment.start.y, 1.0];
    }
    if let Some(pole) = curves.last_mut().and_then(|curve| curve.poles.last_mut()) {
        *pole = [segment.end.x, segment.end.y, 1.0];
    }
    curves
}

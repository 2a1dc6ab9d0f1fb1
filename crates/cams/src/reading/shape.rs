//! What each kind of entity cuts, in its own coordinates.

use super::curve::Bezier;
use super::record::{EntityFault, EntityRecord, fault};
use super::spline;
use camgen_kernel::geometry::contour::{Contour, Segment, Vertex};
use nalgebra::Vector2;
use std::f64::consts::PI;

/// Kinds that carry information and are not cut.
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

/// Ends of a closed polyline nearer than this count as one, mm: the side between them has no length.
const REPEATED: f64 = 1e-6;

/// A part of what is cut.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ShapePiece {
    Segment(Segment),
    Curve(Bezier),
}

/// What an entity cuts.
#[derive(Debug, Default)]
pub(super) struct EntityShape {
    /// In a row, each starting where the one before ends.
    pub(super) pieces: Vec<ShapePiece>,
    /// Whether the coordinates are those of a viewer behind the drawing.
    pub(super) from_behind: bool,
    /// Heights of its points.
    pub(super) heights: Vec<f64>,
    /// Largest width with which the line is drawn, mm.
    pub(super) width: f64,
}

impl EntityShape {
    fn of(segments: impl IntoIterator<Item = Segment>, height: f64) -> Self {
        Self {
            pieces: segments.into_iter().map(ShapePiece::Segment).collect(),
            heights: vec![height],
            ..Self::default()
        }
    }
}

/// Whether it carries information and is not cut.
pub(super) fn is_information(record: &EntityRecord<'_>) -> bool {
    record.is_one_of(INFORMATION)
}

/// The kinds of entities that are cut, with the classes that their groups belong to.
const CUT: [(&str, &[&str]); 7] = [
    ("LINE", &["AcDbLine"]),
    ("ARC", &["AcDbCircle", "AcDbArc"]),
    ("CIRCLE", &["AcDbCircle"]),
    ("LWPOLYLINE", &["AcDbPolyline"]),
    ("POLYLINE", &["AcDb2dPolyline", "AcDb3dPolyline", "AcDbVertex", "AcDb2dVertex", "AcDb3dPolylineVertex"]),
    ("ELLIPSE", &["AcDbEllipse"]),
    ("SPLINE", &["AcDbSpline"]),
];

/// What an entity cuts; `vertices` are those of a POLYLINE. `None` where it is unknown whether its kind is cut.
pub(super) fn shape(
    record: &EntityRecord<'_>,
    vertices: &[EntityRecord<'_>],
) -> Result<Option<EntityShape>, EntityFault> {
    let curved = |(curves, heights): (Vec<Bezier>, Vec<f64>)| EntityShape {
        pieces: curves.into_iter().map(ShapePiece::Curve).collect(),
        heights,
        ..EntityShape::default()
    };
    let kind = record.kind();
    let Some((_, classes)) = CUT.iter().find(|(name, _)| *name == kind) else { return Ok(None) };
    let outside = |record: &EntityRecord<'_>| record.outside_its_class(classes);
    if let Some(class) = std::iter::once(record).chain(vertices).find_map(outside) {
        return fault(format!("has a part of another class, {class}, which other readers leave out"));
    }
    Ok(Some(match kind.as_str() {
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

fn line(record: &EntityRecord<'_>) -> Result<EntityShape, EntityFault> {
    let (start, end) = (record.point(10)?, record.point(11)?);
    let segment = Segment { start: start.xy(), end: end.xy(), bulge: 0.0 };
    Ok(EntityShape { heights: vec![start.z, end.z], ..EntityShape::of([segment], 0.0) })
}

fn radius(record: &EntityRecord<'_>) -> Result<f64, EntityFault> {
    let radius = record.required_real(40)?;
    if radius < 0.0 { fault("has a negative radius") } else { Ok(radius) }
}

fn circle(record: &EntityRecord<'_>) -> Result<EntityShape, EntityFault> {
    let (centre, radius) = (record.point(10)?, radius(record)?);
    let circle = Contour::circle(centre.xy(), radius);
    Ok(EntityShape {
        from_behind: record.is_seen_from_behind()?,
        ..EntityShape::of(circle.segments().unwrap_or_default(), centre.z)
    })
}

fn arc(record: &EntityRecord<'_>) -> Result<EntityShape, EntityFault> {
    let (centre, radius) = (record.point(10)?, radius(record)?);
    let (from, to) = (record.required_real(50)?, record.required_real(51)?);
    let swept = (to - from).rem_euclid(360.0);
    // From 0 to 360 degrees is a full circle.
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
    Ok(EntityShape { from_behind: record.is_seen_from_behind()?, ..EntityShape::of(segments, centre.z) })
}

/// The sides of a polyline; a closed one may repeat its first vertex as its last.
fn sides(mut vertices: Vec<Vertex>, closed: bool) -> Result<Vec<Segment>, EntityFault> {
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

fn lightweight_polyline(record: &EntityRecord<'_>) -> Result<EntityShape, EntityFault> {
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
        // Groups before the first vertex belong to no vertex.
        let Some(slot) = vertices.last_mut().and_then(|vertex| vertex.get_mut(place)) else { continue };
        if slot.replace(group.value.real()?).is_some() {
            return fault(format!("has group {} twice for a vertex", group.code));
        }
    }
    let stated = record.whole(90, i64::try_from(vertices.len()).unwrap_or(i64::MAX))?;
    if usize::try_from(stated) != Ok(vertices.len()) {
        return fault(format!("has {} vertices, but states that there are {stated}", vertices.len()));
    }
    let widths = vertices.iter().flat_map(|[.., start, end]| [start, end]).flatten();
    let width = widths.fold(record.real(43, 0.0)?.abs(), |widest, width| widest.max(width.abs()));
    let vertex = |[x, y, bulge, ..]: &[Option<f64>; 5]| match (x, y) {
        (Some(x), Some(y)) => Ok(Vertex::new(Vector2::new(*x, *y), bulge.unwrap_or(0.0))),
        _ => fault("has a vertex with x but without y"),
    };
    let vertices: Vec<Vertex> = vertices.iter().map(vertex).collect::<Result<_, _>>()?;
    let segments = sides(vertices, record.whole(70, 0)? & CLOSED != 0)?;
    Ok(EntityShape {
        from_behind: record.is_seen_from_behind()?,
        width,
        ..EntityShape::of(segments, record.real(38, 0.0)?)
    })
}

fn polyline(record: &EntityRecord<'_>, vertices: &[EntityRecord<'_>]) -> Result<EntityShape, EntityFault> {
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
                "is a spline-fit polyline that still contains its control points, which do not lie on the curve"
            } else {
                "has control points of a spline among its vertices, which do not lie on the curve"
            });
        }
        if kind & OF_MESH != 0 || kind & OF_SPATIAL != 0 && !spatial {
            return fault("has vertices of a mesh or of a polyline in space");
        }
        if spatial && bulge != 0.0 {
            return fault("is a polyline in space with arcs");
        }
        if spatial || point.z != 0.0 {
            heights.push(point.z);
        }
        width = width.max(vertex.real(40, 0.0)?.abs()).max(vertex.real(41, 0.0)?.abs());
        found.push(Vertex::new(point.xy(), bulge));
    }
    let segments = sides(found, flags & CLOSED != 0)?;
    let from_behind = if spatial { false } else { record.is_seen_from_behind()? };
    Ok(EntityShape { from_behind, heights, width, ..EntityShape::of(segments, 0.0) })
}

/// An arc as curves, for a map that does not keep circles.
pub(super) fn as_curves(segment: &Segment) -> Vec<Bezier> {
    if segment.bulge == 0.0 {
        return vec![Bezier::polynomial(&[segment.start, segment.end])];
    }
    let centre = segment.centre();
    let a = segment.start - centre;
    let b = Vector2::new(-a.y, a.x);
    let mut curves = Bezier::ellipse(centre, (a, b), (0.0, segment.sweep().clamp(-2.0 * PI, 2.0 * PI)));
    // The ends as the file gives them.
    if let Some(pole) = curves.first_mut().and_then(|curve| curve.poles.first_mut()) {
        *pole = [segment.start.x, segment.start.y, 1.0];
    }
    if let Some(pole) = curves.last_mut().and_then(|curve| curve.poles.last_mut()) {
        *pole = [segment.end.x, segment.end.y, 1.0];
    }
    curves
}

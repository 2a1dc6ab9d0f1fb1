//! Reads a DXF file back into chains of arcs and lines: what `write` wrote, or what another program made of it.
//!
//! The entities of layer `CAM_PROFILE` are taken for the outline, joined end to end; what does not fit a single closed
//! outline is kept and reported, not repaired. LWPOLYLINE, POLYLINE, LINE, ARC and CIRCLE are read exactly, SPLINE as chords
//! that turn by less than a shop's kink.

mod groups;
mod join;
mod spline;
pub mod step;

pub use join::Chain;

use crate::geometry::contour::{Contour, Segment, Vertex};
use dxf::entities::{Entity, EntityType};
use dxf::enums::Units;
use nalgebra::Vector2;

/// Layer of the outline.
pub const OUTLINE_LAYER: &str = "CAM_PROFILE";

/// Largest tilt of an entity's plane: rounding of a unit vector.
const TILT: f64 = 1e-9;

/// The unit a file states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// `$INSUNITS` = 4.
    Millimetres,
    /// `$INSUNITS` = 0 or absent.
    Untold,
    /// Anything else.
    Other(&'static str),
}

/// What was read.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The unit it is in.
    pub unit: Unit,
    /// The chains on the layer of the outline, joined; one closed one is what it should be.
    pub chains: Vec<Chain>,
    /// Middles of segments that lie on another one, mm.
    pub duplicates: Vec<Vector2<f64>>,
    /// Places of segments without length, mm.
    pub points: Vec<Vector2<f64>>,
    /// Kinds of entities on that layer that cannot be read as arcs and lines.
    pub unreadable: Vec<String>,
    /// Names of the layers that are not empty.
    pub layers: Vec<String>,
    /// Number of splines, which are read as chords.
    pub splines: usize,
}

/// Why a file cannot be read.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// It does not end as a DXF file ends.
    #[error("not a whole DXF file: it does not end with EOF")]
    CutShort,
    /// It is not DXF.
    #[error("not a DXF file: {0}")]
    NotDxf(String),
    /// It holds a number that is not finite.
    #[error("an entity holds a number that is not finite, or beyond every drawing")]
    NotFinite,
}

/// Reads a DXF file; ends nearer than `join` (mm) are one.
///
/// # Errors
/// [`ReadError`] when the bytes are not a DXF file.
pub fn read(bytes: &[u8], join: f64) -> Result<Reading, ReadError> {
    let binary = bytes.starts_with(b"AutoCAD Binary DXF");
    if !binary && !bytes.trim_ascii_end().ends_with(b"EOF") {
        return Err(ReadError::CutShort);
    }
    let kept = groups::kept(bytes)?;
    let drawing = dxf::Drawing::load(&mut kept.as_slice()).map_err(|error| ReadError::NotDxf(error.to_string()))?;
    let unit = match drawing.header.default_drawing_units {
        Units::Millimeters => Unit::Millimetres,
        Units::Unitless => Unit::Untold,
        Units::Inches => Unit::Other("inches"),
        Units::Centimeters => Unit::Other("centimetres"),
        Units::Meters => Unit::Other("metres"),
        _ => Unit::Other("another unit than millimetres"),
    };
    // What lies in paper space is not cut.
    let model = || drawing.entities().filter(|entity| !entity.common.is_in_paper_space);
    let on_outline = |entity: &&Entity| entity.common.layer.eq_ignore_ascii_case(OUTLINE_LAYER);
    let mut layers: Vec<String> = model().map(|entity| entity.common.layer.clone()).collect();
    layers.sort();
    layers.dedup();
    let mut raw = Raw::default();
    for entity in model().filter(on_outline) {
        raw.add(entity);
    }
    // Entities on other layers are cut as well, and must not repeat the outline.
    let mut others = Raw::default();
    for entity in model().filter(|entity| !on_outline(entity)) {
        others.add(entity);
    }
    if raw
        .pieces
        .iter()
        .flatten()
        .any(|s| ![s.start.x, s.start.y, s.end.x, s.end.y, s.bulge].iter().all(|v| v.is_finite()))
    {
        return Err(ReadError::NotFinite);
    }
    let joined = join::join(raw.pieces, &others.pieces.concat(), join);
    Ok(Reading {
        unit,
        chains: joined.chains,
        duplicates: joined.duplicates,
        points: joined.points,
        unreadable: raw.unreadable,
        layers,
        splines: raw.splines,
    })
}

/// Segments as they stand in the file: each piece is one entity.
#[derive(Default)]
struct Raw {
    pieces: Vec<Vec<Segment>>,
    unreadable: Vec<String>,
    splines: usize,
}

impl Raw {
    fn add(&mut self, entity: &Entity) {
        let normal = match &entity.specific {
            EntityType::LwPolyline(line) => line.extrusion_direction.clone(),
            EntityType::Polyline(line) => line.normal.clone(),
            EntityType::Arc(arc) => arc.normal.clone(),
            EntityType::Circle(circle) => circle.normal.clone(),
            _ => dxf::Vector::z_axis(),
        };
        if normal.x.abs() + normal.y.abs() > TILT * normal.z.abs() {
            self.unreadable.push("an entity that does not lie in the plane of the drawing".into());
            return;
        }
        let mut segments = match (exact(&entity.specific), &entity.specific) {
            (Some(segments), _) => segments,
            (None, EntityType::Spline(line)) => {
                let Some(segments) = spline::chords(line) else {
                    self.unreadable.push("SPLINE without control points".into());
                    return;
                };
                self.splines += 1;
                segments
            }
            // Text and points cut nothing, but on the layer of the outline they are unexpected.
            (None, other) => {
                let name = format!("{other:?}");
                let kind: String = name.chars().take_while(char::is_ascii_alphanumeric).collect();
                self.unreadable.push(kind.to_uppercase());
                return;
            }
        };
        if let EntityType::Polyline(line) = &entity.specific {
            // A mesh or a fitted curve has vertices that are not on the outline.
            if line.flags & !0b1000_0001 != 0 {
                self.unreadable.push("POLYLINE that is a mesh or a fitted curve".into());
                segments.clear();
            }
        }
        self.pieces.push(segments);
    }
}

/// The segments of an entity that is made of arcs and lines; `None` of any other.
fn exact(entity: &EntityType) -> Option<Vec<Segment>> {
    Some(match entity {
        EntityType::LwPolyline(line) => {
            let vertices = line.vertices.iter().map(|v| (v.x, v.y, v.bulge));
            mirrored(chain(vertices, line.is_closed()), line.extrusion_direction.z)
        }
        EntityType::Polyline(line) => {
            let vertices = line.vertices().map(|v| (v.location.x, v.location.y, v.bulge));
            mirrored(chain(vertices, line.is_closed()), line.normal.z)
        }
        EntityType::Line(line) => {
            vec![Segment {
                start: Vector2::new(line.p1.x, line.p1.y),
                end: Vector2::new(line.p2.x, line.p2.y),
                bulge: 0.0,
            }]
        }
        EntityType::Arc(arc) => {
            let centre = Vector2::new(arc.center.x, arc.center.y);
            let sweep = (arc.end_angle - arc.start_angle).rem_euclid(360.0).to_radians();
            let on = |degrees: f64| {
                let angle = degrees.to_radians();
                centre + Vector2::new(libm::cos(angle), libm::sin(angle)) * arc.radius
            };
            let segment =
                Segment { start: on(arc.start_angle), end: on(arc.end_angle), bulge: libm::tan(0.25 * sweep) };
            mirrored(vec![segment], arc.normal.z)
        }
        EntityType::Circle(circle) => {
            let centre = Vector2::new(circle.center.x, circle.center.y);
            mirrored(Contour::circle(centre, circle.radius).segments().collect(), circle.normal.z)
        }
        _ => return None,
    })
}

fn chain(vertices: impl Iterator<Item = (f64, f64, f64)>, closed: bool) -> Vec<Segment> {
    let vertices: Vec<Vertex> = vertices.map(|(x, y, bulge)| Vertex { point: Vector2::new(x, y), bulge }).collect();
    let mut segments: Vec<Segment> = Contour { vertices }.segments().collect();
    if !closed {
        segments.pop();
    }
    segments
}

/// Seen from behind (extrusion along −Z, as mirroring leaves it) x and the sense of every arc are reversed.
fn mirrored(segments: Vec<Segment>, normal_z: f64) -> Vec<Segment> {
    if normal_z >= 0.0 {
        return segments;
    }
    let flip = |point: Vector2<f64>| Vector2::new(-point.x, point.y);
    segments.into_iter().map(|s| Segment { start: flip(s.start), end: flip(s.end), bulge: -s.bulge }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawing(entities: Vec<(&str, EntityType)>, unit: Units) -> Vec<u8> {
        let mut drawing = dxf::Drawing::new();
        drawing.header.version = dxf::enums::AcadVersion::R2000;
        drawing.header.default_drawing_units = unit;
        for (layer, specific) in entities {
            let mut entity = Entity::new(specific);
            entity.common.layer = layer.into();
            drawing.add_entity(entity);
        }
        let mut bytes = Vec::new();
        drawing.save(&mut bytes).expect("saved");
        bytes
    }

    fn point(x: f64, y: f64) -> dxf::Point {
        dxf::Point::new(x, y, 0.0)
    }

    fn slot() -> Vec<(&'static str, EntityType)> {
        let line = |a, b| ("CAM_PROFILE", EntityType::Line(dxf::entities::Line::new(a, b)));
        let arc =
            |x, from, to| ("CAM_PROFILE", EntityType::Arc(dxf::entities::Arc::new(point(x, 0.0), 10.0, from, to)));
        vec![
            line(point(0.0, -10.0), point(40.0, -10.0)),
            // Out of order and one of them the wrong way round.
            line(point(40.0, 10.0), point(0.0, 10.0)),
            arc(40.0, 270.0, 90.0),
            arc(0.0, 90.0, 270.0),
        ]
    }

    #[test]
    fn a_heap_of_lines_and_arcs_becomes_one_closed_chain() {
        let reading = read(&drawing(slot(), Units::Millimeters), 1e-6).expect("read");
        assert_eq!((reading.unit, reading.chains.len()), (Unit::Millimetres, 1));
        let chain = &reading.chains[0];
        assert!(chain.closed && chain.segments.len() == 4);
        let (area, _) = chain.contour().area_and_centroid();
        assert!((area.abs() - (800.0 + 100.0 * std::f64::consts::PI)).abs() < 1e-9, "{area}");
        assert!(reading.duplicates.is_empty() && reading.unreadable.is_empty());
    }

    #[test]
    fn what_is_wrong_is_kept_and_told() {
        let mut twice = slot();
        twice.push(slot().remove(2));
        let reading = read(&drawing(twice, Units::Inches), 1e-6).expect("read");
        assert_eq!(reading.unit, Unit::Other("inches"));
        assert_eq!((reading.duplicates.len(), reading.chains.len()), (1, 1));
        assert!((reading.duplicates[0] - Vector2::new(50.0, 0.0)).norm() < 1e-9);

        let mut open = slot();
        open.remove(0);
        let reading = read(&drawing(open, Units::Unitless), 1e-6).expect("read");
        assert_eq!((reading.unit, reading.chains.len(), reading.chains[0].closed), (Unit::Untold, 1, false));

        let mut two = slot();
        two.push(("CAM_PROFILE", EntityType::Circle(dxf::entities::Circle::new(point(20.0, 0.0), 3.0))));
        two.push(("CAM_PROFILE", EntityType::Text(dxf::entities::Text::default())));
        two.push(("BORE", EntityType::Circle(dxf::entities::Circle::new(point(20.0, 0.0), 3.0))));
        let reading = read(&drawing(two, Units::Millimeters), 1e-6).expect("read");
        assert_eq!((reading.chains.len(), reading.unreadable.as_slice()), (2, ["TEXT".to_owned()].as_slice()));
        assert_eq!(reading.layers, ["BORE", "CAM_PROFILE"]);
    }

    #[test]
    fn a_spline_is_read_as_chords() {
        let mut spline = dxf::entities::Spline { degree_of_curve: 2, ..Default::default() };
        // A circle as a rational spline of second degree.
        let w = std::f64::consts::FRAC_1_SQRT_2;
        for (i, (x, y)) in
            [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1), (1, 0)].into_iter().enumerate()
        {
            spline.control_points.push(point(50.0 * f64::from(x), 50.0 * f64::from(y)));
            spline.weight_values.push(if i % 2 == 0 { 1.0 } else { w });
        }
        spline.knot_values = vec![0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0];
        let bytes = drawing(vec![("CAM_PROFILE", EntityType::Spline(spline))], Units::Millimeters);
        let reading = read(&bytes, 1e-6).expect("read");
        assert_eq!((reading.splines, reading.chains.len()), (1, 1));
        let contour = reading.chains[0].contour();
        assert!(reading.chains[0].closed);
        assert!((contour.area_and_centroid().0 - 2500.0 * std::f64::consts::PI).abs() < 1e-2);
        assert!(contour.tangent_breaks().iter().all(|turn| turn.abs().to_degrees() < 0.05));
    }

    /// Points so far apart that their distance is no number, and a weight that outgrows every point.
    #[test]
    fn a_spline_beyond_every_number_is_told() {
        let spline = |far: f64, weight: f64| {
            let control_points = vec![point(0.0, 0.0), point(far, -far), point(-far, far)];
            let knot_values = vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
            let weight_values = vec![1.0, weight, 1e-300];
            dxf::entities::Spline {
                degree_of_curve: 2,
                control_points,
                knot_values,
                weight_values,
                ..Default::default()
            }
        };
        let read = |spline| read(&drawing(vec![("CAM_PROFILE", EntityType::Spline(spline))], Units::Millimeters), 1e-6);
        for (far, weight) in [(1e300, 1.0), (f64::NAN, 1.0), (1.0, 1e300), (1.0, f64::NAN)] {
            assert_eq!(read(spline(far, weight)), Err(ReadError::NotFinite), "{far} {weight}");
        }
        // The last point has no weight to speak of and stands where no number can.
        let reading = read(spline(1e15, 1e-300)).expect("numbers");
        assert!(reading.chains.iter().all(|chain| chain.segments.iter().all(|segment| segment.end.norm().is_finite())));
    }

    #[test]
    fn what_is_not_dxf_is_told_without_a_panic() {
        let whole = drawing(slot(), Units::Millimeters);
        assert_eq!(read(b"", 1e-6), Err(ReadError::CutShort));
        assert_eq!(read(b"hello", 1e-6), Err(ReadError::CutShort));
        assert!(matches!(read(b"hello\nEOF", 1e-6), Err(ReadError::NotDxf(_))));
        assert!(matches!(read(&[0xff; 64], 1e-6), Err(ReadError::CutShort)));
        for cut in (0..whole.len()).step_by(whole.len() / 97) {
            let mut bytes = whole[..cut].to_vec();
            bytes.extend_from_slice(b"\n  0\nEOF\n");
            // Either it is told, or what is left is read; it never panics.
            let _ = read(&bytes, 1e-6);
        }
    }
}

//! The cut file: DXF in four versions, ASCII, millimetres or inches, with nothing in it but the lines to cut.
//!
//! Written by hand: a cut file needs two entities, and every reader must take it without a repair. R12 is the old
//! flat form with POLYLINE; the later ones have handles and owners for every table, record and object, the two block
//! records of model and paper space with their layouts, and LWPOLYLINE.

mod objects;
mod tables;
mod tags;

use crate::body::Layer;
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::{Contour, Extents};
use camgen_kernel::geometry::cubics::{CurveRun, runs};
use camgen_kernel::profile::outline::Outline;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;
use std::borrow::Cow;
use tags::{DxfTags, handle};

/// The file of a cutter's path.
#[must_use]
pub fn cutter_path(path: &Outline, form: impl Into<DxfForm>) -> Vec<u8> {
    let lead_in = path.lead_in.map(|segment| (Layer::LeadIn, Entity::Segment(segment)));
    let chain = (Layer::CutterPath, Entity::Polyline(path.contour.clone()));
    write(&std::iter::once(chain).chain(lead_in).collect::<Vec<_>>(), form)
}

/// Version of a DXF file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Version {
    /// AC1009.
    R12,
    /// AC1015.
    #[default]
    R2000,
    /// AC1024.
    R2010,
    /// AC1027.
    R2013,
}

impl Version {
    /// Every version with its name on the command line.
    pub const ALL: [(&'static str, Version); 4] =
        [("r12", Version::R12), ("r2000", Version::R2000), ("r2010", Version::R2010), ("r2013", Version::R2013)];

    fn code(self) -> &'static str {
        match self {
            Version::R12 => "AC1009",
            Version::R2000 => "AC1015",
            Version::R2010 => "AC1024",
            Version::R2013 => "AC1027",
        }
    }
}

/// How a DXF file is written. A version alone is one in millimetres.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct DxfForm {
    /// Its version.
    pub version: Version,
    /// The unit of its lengths, which it states.
    pub units: LengthUnit,
}

impl From<Version> for DxfForm {
    fn from(version: Version) -> Self {
        Self { version, units: LengthUnit::Millimetre }
    }
}

/// Bytes of a file of one outline of arcs.
const ROOM: usize = 1 << 14;

/// The entities, mm, in the unit of a file. No other place of the writer converts a length of what is cut.
pub(super) fn in_units(entities: &[(Layer, Entity)], units: LengthUnit) -> Cow<'_, [(Layer, Entity)]> {
    match units {
        LengthUnit::Millimetre => Cow::Borrowed(entities),
        LengthUnit::Inch => entities.iter().map(|(layer, entity)| (*layer, entity.scaled(units.of_mm(1.0)))).collect(),
    }
}

/// The entities, mm, as a DXF file.
#[must_use]
pub fn write(entities: &[(Layer, Entity)], form: impl Into<DxfForm>) -> Vec<u8> {
    let DxfForm { version, units } = form.into();
    let entities = &*in_units(entities, units);
    let extents = entities.iter().map(|(_, entity)| entity.extents()).reduce(|a, b| a.with(&b));
    let extents = extents.unwrap_or(Extents { least: Vector2::zeros(), largest: Vector2::zeros() });
    let mut layers: Vec<Layer> = entities.iter().map(|(layer, _)| *layer).collect();
    layers.sort_unstable();
    layers.dedup();
    // The header holds the first free handle, which is known only at the end: it is written last, put first.
    let mut body = DxfTags { text: Vec::with_capacity(ROOM), version, units, next_handle: handle::FIRST_FREE };
    if body.modern() {
        body.section("CLASSES", |_| {});
    }
    body.section("TABLES", |tags| tables::tables(tags, &layers, &extents));
    if body.modern() {
        body.section("BLOCKS", blocks);
    }
    body.section("ENTITIES", |tags| {
        for (layer, entity) in entities {
            write_entity(tags, *layer, entity);
        }
    });
    if body.modern() {
        body.section("OBJECTS", |tags| objects::objects(tags, &extents));
    }
    body.text(0, "EOF");
    let mut head = DxfTags { text: Vec::with_capacity(ROOM), version, units, next_handle: body.next_handle };
    header(&mut head, &extents);
    head.text.extend_from_slice(&body.text);
    head.text
}

/// The file with a comment as its first line, which every reader skips.
#[must_use]
pub fn marked(file: Vec<u8>, comment: &str) -> Vec<u8> {
    // A line feed would end the comment, and begin a group.
    let comment: String = comment.chars().filter(|c| c.is_ascii() && !c.is_control()).collect();
    if comment.is_empty() { file } else { [format!("999\n{comment}\n").into_bytes(), file].concat() }
}

fn header(tags: &mut DxfTags, extents: &Extents) {
    let next_handle = tags.next_handle;
    tags.section("HEADER", |tags| {
        tags.text(9, "$ACADVER");
        tags.text(1, tags.version.code());
        if tags.modern() {
            tags.text(9, "$DWGCODEPAGE");
            tags.text(3, "ANSI_1252");
        }
        tags.text(9, "$INSBASE");
        tags.point_3d(10, Vector2::zeros());
        tags.text(9, "$EXTMIN");
        tags.point_3d(10, extents.least);
        tags.text(9, "$EXTMAX");
        tags.point_3d(10, extents.largest);
        tags.text(9, "$LIMMIN");
        tags.point(10, extents.least);
        tags.text(9, "$LIMMAX");
        tags.point(10, extents.largest);
        tags.text(9, "$CLAYER");
        tags.text(8, "0");
        // Decimal lengths; the unit is stated twice, because some readers look at one, some at the other.
        tags.text(9, "$LUNITS");
        tags.integer(70, 2);
        if tags.modern() {
            tags.text(9, "$HANDSEED");
            tags.handle(5, next_handle);
        }
        tags.text(9, "$INSUNITS");
        let (unit, system) = match tags.units {
            LengthUnit::Millimetre => (4, 1),
            LengthUnit::Inch => (1, 0),
        };
        tags.integer(70, unit);
        tags.text(9, "$MEASUREMENT");
        tags.integer(70, system);
    });
}

fn blocks(tags: &mut DxfTags) {
    for (name, record, begin, end) in [
        ("*Model_Space", handle::MODEL_SPACE, handle::MODEL_SPACE_BEGIN, handle::MODEL_SPACE_END),
        ("*Paper_Space", handle::PAPER_SPACE, handle::PAPER_SPACE_BEGIN, handle::PAPER_SPACE_END),
    ] {
        tags.record("BLOCK", 5, begin, record, &["AcDbEntity"]);
        if name == "*Paper_Space" {
            tags.integer(67, 1);
        }
        tags.text(8, "0");
        tags.text(100, "AcDbBlockBegin");
        tags.text(2, name);
        tags.integer(70, 0);
        tags.point_3d(10, Vector2::zeros());
        tags.text(3, name);
        tags.text(1, "");
        tags.record("ENDBLK", 5, end, record, &["AcDbEntity"]);
        if name == "*Paper_Space" {
            tags.integer(67, 1);
        }
        tags.text(8, "0");
        tags.text(100, "AcDbBlockEnd");
    }
}

/// Handle, owner and layer of an entity in model space.
fn begin_entity(tags: &mut DxfTags, kind: &str, layer: Layer, subclass: &str) -> u32 {
    let own = tags.new_handle();
    tags.record(kind, 5, own, handle::MODEL_SPACE, &["AcDbEntity"]);
    tags.text(8, layer.name());
    if tags.modern() {
        tags.text(100, subclass);
    }
    own
}

fn write_entity(tags: &mut DxfTags, layer: Layer, entity: &Entity) {
    match entity {
        // A polyline has arcs and lines.
        Entity::Polyline(contour) if contour.cubics() > 0 => {
            for run in runs(contour) {
                curve(tags, layer, &run);
            }
        }
        Entity::Polyline(contour) if tags.modern() => lightweight_polyline(tags, layer, contour),
        Entity::Polyline(contour) => old_polyline(tags, layer, contour),
        Entity::Circle(centre, radius) => {
            begin_entity(tags, "CIRCLE", layer, "AcDbCircle");
            tags.point_3d(10, *centre);
            tags.real(40, *radius);
        }
        Entity::Segment(segment) => curve(tags, layer, &CurveRun::Segment(*segment)),
    }
}

/// One curve of an outline with splines.
fn curve(tags: &mut DxfTags, layer: Layer, run: &CurveRun) {
    match run {
        CurveRun::Segment(segment) if segment.bulge == 0.0 => {
            begin_entity(tags, "LINE", layer, "AcDbLine");
            tags.point_3d(10, segment.start);
            tags.point_3d(11, segment.end);
        }
        CurveRun::Segment(segment) => {
            begin_entity(tags, "ARC", layer, "AcDbCircle");
            tags.point_3d(10, segment.centre());
            tags.real(40, segment.radius().abs());
            if tags.modern() {
                tags.text(100, "AcDbArc");
            }
            let (from, to) = segment.angles();
            tags.real(50, from);
            tags.real(51, to);
        }
        CurveRun::Spline(spline) => {
            begin_entity(tags, "SPLINE", layer, "AcDbSpline");
            // It lies in a plane, whose normal points up.
            for (code, value) in [(210, 0.0), (220, 0.0), (230, 1.0)] {
                tags.real(code, value);
            }
            tags.integer(70, PLANAR);
            tags.integer(71, 3);
            tags.text(72, &spline.knots.len().to_string());
            tags.text(73, &spline.controls.len().to_string());
            tags.integer(74, 0);
            // How near two knots, control or fit points count as one: as AutoCAD writes it.
            for (code, value) in [(42, 1e-9), (43, 1e-10), (44, 1e-10)] {
                tags.real(code, value);
            }
            spline.knots.iter().for_each(|knot| tags.real(40, *knot));
            spline.controls.iter().for_each(|control| tags.point_3d(10, *control));
        }
    }
}

/// Flag of a SPLINE that lies in a plane.
const PLANAR: i64 = 8;

fn lightweight_polyline(tags: &mut DxfTags, layer: Layer, contour: &Contour) {
    begin_entity(tags, "LWPOLYLINE", layer, "AcDbPolyline");
    tags.text(90, &contour.vertices.len().to_string());
    tags.integer(70, 1);
    tags.real(43, 0.0);
    for vertex in &contour.vertices {
        tags.point(10, vertex.point);
        tags.bulge(vertex.bulge().unwrap_or(f64::NAN));
    }
}

fn old_polyline(tags: &mut DxfTags, layer: Layer, contour: &Contour) {
    begin_entity(tags, "POLYLINE", layer, "");
    tags.integer(66, 1);
    tags.point_3d(10, Vector2::zeros());
    tags.integer(70, 1);
    for vertex in &contour.vertices {
        tags.text(0, "VERTEX");
        tags.text(8, layer.name());
        tags.point_3d(10, vertex.point);
        tags.bulge(vertex.bulge().unwrap_or(f64::NAN));
    }
    tags.text(0, "SEQEND");
    tags.text(8, layer.name());
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::geometry::contour::{Bend, Vertex};

    fn slot() -> Vec<(Layer, Entity)> {
        let at = |x: f64, y: f64, bulge: f64| Vertex::new(Vector2::new(x, y), bulge);
        let vertices = vec![at(0.0, -10.0, 0.0), at(40.0, -10.0, 1.0), at(40.0, 10.0, 0.0), at(0.0, 10.0, 1.0)];
        vec![
            (Layer::CamProfile, Entity::Polyline(Contour { vertices })),
            (Layer::Bore, Entity::Circle(Vector2::new(20.0, 0.0), 4.5)),
        ]
    }

    /// The dxf crate reads back what was written, to the last bit of twelve decimals.
    #[test]
    fn reads_back_in_every_version() {
        for (name, version) in Version::ALL {
            let bytes = write(&slot(), version);
            let drawing = dxf::Drawing::load(&mut bytes.as_slice()).unwrap_or_else(|e| panic!("{name}: {e}"));
            let entities: Vec<_> = drawing.entities().collect();
            assert_eq!(entities.len(), 2, "{name}");
            assert_eq!(entities[0].common.layer, "CAM_PROFILE");
            let vertices: Vec<(f64, f64, f64)> = match &entities[0].specific {
                dxf::entities::EntityType::LwPolyline(line) => {
                    assert!(line.is_closed());
                    line.vertices.iter().map(|v| (v.x, v.y, v.bulge)).collect()
                }
                dxf::entities::EntityType::Polyline(line) => {
                    assert!(line.is_closed());
                    line.vertices().map(|v| (v.location.x, v.location.y, v.bulge)).collect()
                }
                other => panic!("{name}: {other:?}"),
            };
            assert_eq!(vertices, [(0.0, -10.0, 0.0), (40.0, -10.0, 1.0), (40.0, 10.0, 0.0), (0.0, 10.0, 1.0)]);
            assert!(matches!(&entities[1].specific, dxf::entities::EntityType::Circle(c) if c.radius == 4.5));
            assert_eq!(drawing.header.default_drawing_units, dxf::enums::Units::Millimeters, "{name}");
        }
    }

    /// A file in inches states them, and its numbers times 25.4 are the millimetres that were drawn.
    #[test]
    fn inches_are_stated_and_read_back_as_the_millimetres_that_were_drawn() {
        for (name, version) in Version::ALL {
            let bytes = write(&slot(), DxfForm { version, units: LengthUnit::Inch });
            let drawing = dxf::Drawing::load(&mut bytes.as_slice()).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(drawing.header.default_drawing_units, dxf::enums::Units::Inches, "{name}");
            let radius = drawing.entities().find_map(|entity| match &entity.specific {
                dxf::entities::EntityType::Circle(circle) => Some(circle.radius),
                _ => None,
            });
            assert!((25.4 * radius.expect("a bore") - 4.5).abs() < 1e-10, "{name}: {radius:?}");
            let text = String::from_utf8(bytes.clone()).expect("ASCII");
            assert!(text.contains("$MEASUREMENT\n 70\n0\n") && text.contains("$INSUNITS\n 70\n1\n"), "{name}");
            let read = crate::reading::read(&bytes, 1e-9).expect("read");
            let contour = read.chains.first().expect("an outline").contour();
            let far = contour.vertices.iter().map(|vertex| vertex.point.x).fold(0.0, f64::max);
            assert!((far - 40.0).abs() < 1e-10, "{name}: {far}");
        }
    }

    /// FreeCAD 0.20 takes `42 0.0` for an arc without a radius and drops the edge; without the group it is a line.
    #[test]
    fn only_arcs_have_a_bulge() {
        let (tiny, arc) = (1e-13, 0.414_213_562_373);
        for (name, version) in Version::ALL {
            let mut entities = slot();
            if let Some((_, Entity::Polyline(contour))) = entities.first_mut() {
                contour.vertices[0].bend = Bend::Arc(tiny);
                contour.vertices[1].bend = Bend::Arc(-arc);
            }
            let text = String::from_utf8(write(&entities, version)).expect("ASCII");
            let (_, written) = text.split_once("ENTITIES").expect("a section of entities");
            let (written, _) = written.split_once("ENDSEC").expect("its end");
            let lines: Vec<&str> = written.lines().skip(1).collect();
            let bulges = lines.chunks(2).filter(|pair| pair[0].trim() == "42").map(|pair| pair[1]);
            assert_eq!(bulges.collect::<Vec<_>>(), ["-0.414213562373", "1.0"], "{name}");
        }
    }

    #[test]
    fn codes_alternate_with_values_and_handles_are_unique() {
        for (name, version) in Version::ALL {
            let text = String::from_utf8(write(&slot(), version)).expect("ASCII");
            assert!(text.is_ascii() && text.ends_with("  0\nEOF\n"), "{name}");
            let lines: Vec<&str> = text.lines().collect();
            assert_eq!(lines.len() % 2, 0);
            let mut handles = Vec::new();
            for pair in lines.chunks(2) {
                let code: u16 = pair[0].trim().parse().expect("a group code");
                if code == 5 && pair[1] != format!("{:X}", 0) {
                    handles.push(u32::from_str_radix(pair[1], 16).expect("a handle"));
                }
            }
            let seed = if version == Version::R12 { u32::MAX } else { handles.remove(0) };
            assert!(handles.iter().all(|handle| *handle < seed), "{name}");
            let count = handles.len();
            handles.sort_unstable();
            handles.dedup();
            assert_eq!(handles.len(), count, "{name}");
        }
    }
}

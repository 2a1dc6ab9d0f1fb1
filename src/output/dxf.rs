//! The cut file: DXF in four versions, ASCII, millimetres, nothing in it but what is cut.
//!
//! Written by hand: a cut file needs two entities, and every reader must take it without a repair. R12 is the old
//! flat form with POLYLINE; the later ones have handles and owners for every table, record and object, the two block
//! records of model and paper space with their layouts, and LWPOLYLINE.

use super::number::plain;
use crate::contour::{Contour, Extents};
use crate::drawing::{Entity, Layer};
use nalgebra::Vector2;

/// Version of a DXF file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
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

/// Decimals of coordinates and bulges: 1e-12 mm lies in the rounding of a metre; a bulge cut to six decimals would move
/// a long arc by 0.06 µm.
const DECIMALS: usize = 12;

/// Handles of what every file has; entities and layers take the free ones behind.
mod handle {
    pub(super) const BLOCK_RECORDS: u32 = 0x1;
    pub(super) const LAYERS: u32 = 0x2;
    pub(super) const STYLES: u32 = 0x3;
    pub(super) const LINETYPES: u32 = 0x5;
    pub(super) const VIEWS: u32 = 0x6;
    pub(super) const UCS: u32 = 0x7;
    pub(super) const VIEWPORTS: u32 = 0x8;
    pub(super) const APPLICATIONS: u32 = 0x9;
    pub(super) const DIMENSION_STYLES: u32 = 0xA;
    pub(super) const ROOT: u32 = 0xC;
    pub(super) const GROUPS: u32 = 0xD;
    pub(super) const PLOT_STYLES: u32 = 0xE;
    pub(super) const PLOT_STYLE_NORMAL: u32 = 0xF;
    pub(super) const LAYER_ZERO: u32 = 0x10;
    pub(super) const STYLE_STANDARD: u32 = 0x11;
    pub(super) const APPLICATION_ACAD: u32 = 0x12;
    pub(super) const LINETYPE_BY_BLOCK: u32 = 0x14;
    pub(super) const LINETYPE_BY_LAYER: u32 = 0x15;
    pub(super) const LINETYPE_CONTINUOUS: u32 = 0x16;
    pub(super) const LAYOUTS: u32 = 0x1A;
    pub(super) const PAPER_SPACE: u32 = 0x1B;
    pub(super) const PAPER_SPACE_BEGIN: u32 = 0x1C;
    pub(super) const PAPER_SPACE_END: u32 = 0x1D;
    pub(super) const LAYOUT_PAPER: u32 = 0x1E;
    pub(super) const MODEL_SPACE: u32 = 0x1F;
    pub(super) const MODEL_SPACE_BEGIN: u32 = 0x20;
    pub(super) const MODEL_SPACE_END: u32 = 0x21;
    pub(super) const LAYOUT_MODEL: u32 = 0x22;
    pub(super) const DIMENSION_STYLE_STANDARD: u32 = 0x27;
    pub(super) const VIEWPORT_ACTIVE: u32 = 0x29;
    pub(super) const FIRST_FREE: u32 = 0x30;
}

/// A growing file of group codes and values.
struct Tags {
    text: String,
    version: Version,
    next_handle: u32,
}

impl Tags {
    fn text(&mut self, code: u16, value: &str) {
        self.text.push_str(&format!("{code:>3}\n{value}\n"));
    }

    fn integer(&mut self, code: u16, value: impl Into<i64>) {
        self.text(code, &value.into().to_string());
    }

    fn real(&mut self, code: u16, value: f64) {
        self.text(code, &plain(value, DECIMALS));
    }

    fn handle(&mut self, code: u16, value: u32) {
        self.text(code, &format!("{value:X}"));
    }

    fn point(&mut self, code: u16, point: Vector2<f64>) {
        self.real(code, point.x);
        self.real(code + 10, point.y);
    }

    fn point_3d(&mut self, code: u16, point: Vector2<f64>) {
        self.point(code, point);
        self.real(code + 20, 0.0);
    }

    fn modern(&self) -> bool {
        self.version != Version::R12
    }

    fn new_handle(&mut self) -> u32 {
        self.next_handle += 1;
        self.next_handle - 1
    }

    /// Handle, owner and subclass of a table record or object, where the version has them.
    fn record(&mut self, kind: &str, handle_code: u16, own: u32, owner: u32, subclasses: &[&str]) {
        self.text(0, kind);
        if self.modern() {
            self.handle(handle_code, own);
            self.handle(330, owner);
            for subclass in subclasses {
                self.text(100, subclass);
            }
        }
    }

    fn section(&mut self, name: &str, content: impl FnOnce(&mut Self)) {
        self.text(0, "SECTION");
        self.text(2, name);
        content(self);
        self.text(0, "ENDSEC");
    }

    fn table(&mut self, name: &str, own: u32, count: usize, content: impl FnOnce(&mut Self)) {
        self.text(0, "TABLE");
        self.text(2, name);
        if self.modern() {
            self.handle(5, own);
            self.handle(330, 0);
            self.text(100, "AcDbSymbolTable");
        }
        self.text(70, &count.to_string());
        if self.modern() && name == "DIMSTYLE" {
            self.text(100, "AcDbDimStyleTable");
        }
        content(self);
        self.text(0, "ENDTAB");
    }

    /// A record of a symbol table with its name.
    fn named(&mut self, kind: &str, own: u32, owner: u32, subclass: &str, name: &str) {
        let code = if kind == "DIMSTYLE" { 105 } else { 5 };
        self.record(kind, code, own, owner, &["AcDbSymbolTableRecord", subclass]);
        self.text(2, name);
    }
}

/// The entities as a DXF file.
#[must_use]
pub fn write(entities: &[(Layer, Entity)], version: Version) -> Vec<u8> {
    let extents = entities.iter().map(|(_, entity)| entity.extents()).reduce(|a, b| a.with(&b));
    let extents = extents.unwrap_or(Extents { least: Vector2::zeros(), largest: Vector2::zeros() });
    let mut layers: Vec<Layer> = entities.iter().map(|(layer, _)| *layer).collect();
    layers.sort_unstable();
    layers.dedup();
    // The header holds the first free handle, which is known only at the end: it is written last, put first.
    let mut body = Tags { text: String::new(), version, next_handle: handle::FIRST_FREE };
    if body.modern() {
        body.section("CLASSES", |_| {});
    }
    body.section("TABLES", |tags| tables(tags, &layers, &extents));
    if body.modern() {
        body.section("BLOCKS", blocks);
    }
    body.section("ENTITIES", |tags| {
        for (layer, entity) in entities {
            write_entity(tags, *layer, entity);
        }
    });
    if body.modern() {
        body.section("OBJECTS", |tags| objects(tags, &extents));
    }
    body.text(0, "EOF");
    let mut head = Tags { text: String::new(), version, next_handle: body.next_handle };
    header(&mut head, &extents);
    head.text.push_str(&body.text);
    head.text.into_bytes()
}

fn header(tags: &mut Tags, extents: &Extents) {
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
        // Decimal lengths; millimetres twice, because readers look at one or the other.
        tags.text(9, "$LUNITS");
        tags.integer(70, 2);
        if tags.modern() {
            tags.text(9, "$HANDSEED");
            tags.handle(5, next_handle);
        }
        tags.text(9, "$INSUNITS");
        tags.integer(70, 4);
        tags.text(9, "$MEASUREMENT");
        tags.integer(70, 1);
    });
}

fn tables(tags: &mut Tags, layers: &[Layer], extents: &Extents) {
    tags.table("VPORT", handle::VIEWPORTS, 1, |tags| viewport(tags, extents));
    let linetypes: &[(&str, u32, &str)] = if tags.modern() {
        &[
            ("ByBlock", handle::LINETYPE_BY_BLOCK, ""),
            ("ByLayer", handle::LINETYPE_BY_LAYER, ""),
            ("Continuous", handle::LINETYPE_CONTINUOUS, "Solid line"),
        ]
    } else {
        &[("CONTINUOUS", handle::LINETYPE_CONTINUOUS, "Solid line")]
    };
    tags.table("LTYPE", handle::LINETYPES, linetypes.len(), |tags| {
        for (name, own, description) in linetypes {
            tags.named("LTYPE", *own, handle::LINETYPES, "AcDbLinetypeTableRecord", name);
            tags.integer(70, 0);
            tags.text(3, description);
            tags.integer(72, 65);
            tags.integer(73, 0);
            tags.real(40, 0.0);
        }
    });
    tags.table("LAYER", handle::LAYERS, layers.len() + 1, |tags| {
        layer_record(tags, handle::LAYER_ZERO, "0", 7);
        for layer in layers {
            let own = tags.new_handle();
            let colour = match layer {
                Layer::CamProfile => 7,
                Layer::Bore => 1,
                Layer::CutterPath => 3,
            };
            layer_record(tags, own, layer.name(), colour);
        }
    });
    tags.table("STYLE", handle::STYLES, 1, |tags| {
        let name = if tags.modern() { "Standard" } else { "STANDARD" };
        tags.named("STYLE", handle::STYLE_STANDARD, handle::STYLES, "AcDbTextStyleTableRecord", name);
        tags.integer(70, 0);
        tags.real(40, 0.0);
        tags.real(41, 1.0);
        tags.real(50, 0.0);
        tags.integer(71, 0);
        tags.real(42, 2.5);
        tags.text(3, "txt");
        tags.text(4, "");
    });
    tags.table("VIEW", handle::VIEWS, 0, |_| {});
    tags.table("UCS", handle::UCS, 0, |_| {});
    tags.table("APPID", handle::APPLICATIONS, 1, |tags| {
        tags.named("APPID", handle::APPLICATION_ACAD, handle::APPLICATIONS, "AcDbRegAppTableRecord", "ACAD");
        tags.integer(70, 0);
    });
    tags.table("DIMSTYLE", handle::DIMENSION_STYLES, 1, |tags| {
        let name = if tags.modern() { "Standard" } else { "STANDARD" };
        let (own, owner) = (handle::DIMENSION_STYLE_STANDARD, handle::DIMENSION_STYLES);
        tags.named("DIMSTYLE", own, owner, "AcDbDimStyleTableRecord", name);
        tags.integer(70, 0);
    });
    if tags.modern() {
        tags.table("BLOCK_RECORD", handle::BLOCK_RECORDS, 2, |tags| {
            for (name, own, layout) in [
                ("*Model_Space", handle::MODEL_SPACE, handle::LAYOUT_MODEL),
                ("*Paper_Space", handle::PAPER_SPACE, handle::LAYOUT_PAPER),
            ] {
                tags.named("BLOCK_RECORD", own, handle::BLOCK_RECORDS, "AcDbBlockTableRecord", name);
                tags.handle(340, layout);
            }
        });
    }
}

/// The view a program opens with: the whole part with a little air.
fn viewport(tags: &mut Tags, extents: &Extents) {
    const AIR: f64 = 1.1;
    let name = if tags.modern() { "*Active" } else { "*ACTIVE" };
    tags.named("VPORT", handle::VIEWPORT_ACTIVE, handle::VIEWPORTS, "AcDbViewportTableRecord", name);
    tags.integer(70, 0);
    tags.point(10, Vector2::zeros());
    tags.point(11, Vector2::new(1.0, 1.0));
    tags.point(12, (extents.least + extents.largest) * 0.5);
    tags.point(13, Vector2::zeros());
    tags.point(14, Vector2::new(10.0, 10.0));
    tags.point(15, Vector2::new(10.0, 10.0));
    tags.point(16, Vector2::zeros());
    tags.real(36, 1.0);
    tags.point_3d(17, Vector2::zeros());
    tags.real(40, AIR * extents.size().max().max(1.0));
    tags.real(41, 1.0);
    tags.real(42, 50.0);
    tags.real(43, 0.0);
    tags.real(44, 0.0);
    tags.real(50, 0.0);
    tags.real(51, 0.0);
    for (code, value) in [(71, 0), (72, 1000), (73, 1), (74, 3), (75, 0), (76, 0), (77, 0), (78, 0)] {
        tags.integer(code, value);
    }
}

fn layer_record(tags: &mut Tags, own: u32, name: &str, colour: i64) {
    tags.named("LAYER", own, handle::LAYERS, "AcDbLayerTableRecord", name);
    tags.integer(70, 0);
    tags.integer(62, colour);
    tags.text(6, if tags.modern() { "Continuous" } else { "CONTINUOUS" });
    if tags.modern() {
        tags.integer(370, -3);
        tags.handle(390, handle::PLOT_STYLE_NORMAL);
    }
}

fn blocks(tags: &mut Tags) {
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
fn begin_entity(tags: &mut Tags, kind: &str, layer: Layer, subclass: &str) -> u32 {
    let own = tags.new_handle();
    tags.record(kind, 5, own, handle::MODEL_SPACE, &["AcDbEntity"]);
    tags.text(8, layer.name());
    if tags.modern() {
        tags.text(100, subclass);
    }
    own
}

fn write_entity(tags: &mut Tags, layer: Layer, entity: &Entity) {
    match entity {
        Entity::Polyline(contour) if tags.modern() => lightweight_polyline(tags, layer, contour),
        Entity::Polyline(contour) => old_polyline(tags, layer, contour),
        Entity::Circle(centre, radius) => {
            begin_entity(tags, "CIRCLE", layer, "AcDbCircle");
            tags.point_3d(10, *centre);
            tags.real(40, *radius);
        }
    }
}

fn lightweight_polyline(tags: &mut Tags, layer: Layer, contour: &Contour) {
    begin_entity(tags, "LWPOLYLINE", layer, "AcDbPolyline");
    tags.text(90, &contour.vertices.len().to_string());
    tags.integer(70, 1);
    tags.real(43, 0.0);
    for vertex in &contour.vertices {
        tags.point(10, vertex.point);
        tags.real(42, vertex.bulge);
    }
}

fn old_polyline(tags: &mut Tags, layer: Layer, contour: &Contour) {
    begin_entity(tags, "POLYLINE", layer, "");
    tags.integer(66, 1);
    tags.point_3d(10, Vector2::zeros());
    tags.integer(70, 1);
    for vertex in &contour.vertices {
        tags.text(0, "VERTEX");
        tags.text(8, layer.name());
        tags.point_3d(10, vertex.point);
        tags.real(42, vertex.bulge);
    }
    tags.text(0, "SEQEND");
    tags.text(8, layer.name());
}

fn dictionary(tags: &mut Tags, own: u32, owner: u32, entries: &[(&str, u32)]) {
    tags.record("DICTIONARY", 5, own, owner, &["AcDbDictionary"]);
    tags.integer(281, 1);
    for (name, entry) in entries {
        tags.text(3, name);
        tags.handle(350, *entry);
    }
}

fn objects(tags: &mut Tags, extents: &Extents) {
    dictionary(
        tags,
        handle::ROOT,
        0,
        &[
            ("ACAD_GROUP", handle::GROUPS),
            ("ACAD_LAYOUT", handle::LAYOUTS),
            ("ACAD_PLOTSTYLENAME", handle::PLOT_STYLES),
        ],
    );
    dictionary(tags, handle::GROUPS, handle::ROOT, &[]);
    dictionary(
        tags,
        handle::LAYOUTS,
        handle::ROOT,
        &[("Layout1", handle::LAYOUT_PAPER), ("Model", handle::LAYOUT_MODEL)],
    );
    tags.record("ACDBDICTIONARYWDFLT", 5, handle::PLOT_STYLES, handle::ROOT, &["AcDbDictionary"]);
    tags.integer(281, 1);
    tags.text(3, "Normal");
    tags.handle(350, handle::PLOT_STYLE_NORMAL);
    tags.text(100, "AcDbDictionaryWithDefault");
    tags.handle(340, handle::PLOT_STYLE_NORMAL);
    tags.record("ACDBPLACEHOLDER", 5, handle::PLOT_STYLE_NORMAL, handle::PLOT_STYLES, &[]);
    layout(tags, "Layout1", handle::LAYOUT_PAPER, handle::PAPER_SPACE, 1, extents);
    layout(tags, "Model", handle::LAYOUT_MODEL, handle::MODEL_SPACE, 0, extents);
}

fn layout(tags: &mut Tags, name: &str, own: u32, block: u32, tab: i64, extents: &Extents) {
    tags.record("LAYOUT", 5, own, handle::LAYOUTS, &["AcDbPlotSettings"]);
    tags.text(1, "");
    tags.text(2, "none_device");
    tags.text(4, "");
    tags.text(6, "");
    for code in [40, 41, 42, 43] {
        tags.real(code, 0.0);
    }
    // A4.
    tags.real(44, 210.0);
    tags.real(45, 297.0);
    for code in [46, 47, 48, 49, 140, 141] {
        tags.real(code, 0.0);
    }
    tags.real(142, 1.0);
    tags.real(143, 1.0);
    // Of the model tab; paper in millimetres.
    tags.integer(70, if tab == 0 { 1024 } else { 0 });
    tags.integer(72, 1);
    tags.integer(73, 0);
    tags.integer(74, 5);
    tags.text(7, "");
    tags.integer(75, 16);
    tags.real(147, 1.0);
    tags.real(148, 0.0);
    tags.real(149, 0.0);
    tags.text(100, "AcDbLayout");
    tags.text(1, name);
    tags.integer(70, 1);
    tags.integer(71, tab);
    tags.point(10, extents.least);
    tags.point(11, extents.largest);
    tags.point_3d(12, Vector2::zeros());
    tags.point_3d(14, extents.least);
    tags.point_3d(15, extents.largest);
    tags.real(146, 0.0);
    tags.point_3d(13, Vector2::zeros());
    tags.point_3d(16, Vector2::new(1.0, 0.0));
    tags.point_3d(17, Vector2::new(0.0, 1.0));
    tags.integer(76, 0);
    tags.handle(330, block);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contour::Vertex;

    fn slot() -> Vec<(Layer, Entity)> {
        let at = |x: f64, y: f64, bulge: f64| Vertex { point: Vector2::new(x, y), bulge };
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

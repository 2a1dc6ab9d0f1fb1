//! The symbol tables: line types, layers, styles, the view a program opens with.

use super::tags::{DxfTags, handle};
use crate::body::Layer;
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

pub(super) fn tables(tags: &mut DxfTags, layers: &[Layer], extents: &Extents) {
    tags.table("VPORT", handle::VIEWPORTS, 1, |tags| viewport(tags, extents));
    linetypes(tags);
    tags.table("LAYER", handle::LAYERS, layers.len() + 1, |tags| {
        layer_record(tags, handle::LAYER_ZERO, "0", 7);
        for layer in layers {
            let own = tags.new_handle();
            let colour = match layer {
                Layer::CamProfile
                | Layer::GrooveInner
                | Layer::GrooveOuter
                | Layer::RibInner
                | Layer::RibOuter
                | Layer::FlankUpper
                | Layer::FlankLower => 7,
                Layer::Pitch => 4,
                Layer::Bore => 1,
                Layer::Blank => 8,
                Layer::CutterPath => 3,
                Layer::LeadIn => 5,
            };
            layer_record(tags, own, layer.name(), colour);
        }
    });
    text_style(tags);
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

fn linetypes(tags: &mut DxfTags) {
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
}

fn text_style(tags: &mut DxfTags) {
    tags.table("STYLE", handle::STYLES, 1, |tags| {
        let name = if tags.modern() { "Standard" } else { "STANDARD" };
        tags.named("STYLE", handle::STYLE_STANDARD, handle::STYLES, "AcDbTextStyleTableRecord", name);
        tags.integer(70, 0);
        tags.real(40, 0.0);
        tags.real(41, 1.0);
        tags.real(50, 0.0);
        tags.integer(71, 0);
        tags.setting(42, 2.5);
        tags.text(3, "txt");
        tags.text(4, "");
    });
}

/// The view a program opens with: the whole part with a small margin.
fn viewport(tags: &mut DxfTags, extents: &Extents) {
    const AIR: f64 = 1.1;
    let name = if tags.modern() { "*Active" } else { "*ACTIVE" };
    tags.named("VPORT", handle::VIEWPORT_ACTIVE, handle::VIEWPORTS, "AcDbViewportTableRecord", name);
    tags.integer(70, 0);
    tags.point(10, Vector2::zeros());
    tags.point(11, Vector2::new(1.0, 1.0));
    tags.point(12, (extents.least + extents.largest) * 0.5);
    tags.point(13, Vector2::zeros());
    for code in [14, 24, 15, 25] {
        tags.setting(code, 10.0);
    }
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

fn layer_record(tags: &mut DxfTags, own: u32, name: &str, colour: i64) {
    tags.named("LAYER", own, handle::LAYERS, "AcDbLayerTableRecord", name);
    tags.integer(70, 0);
    tags.integer(62, colour);
    tags.text(6, if tags.modern() { "Continuous" } else { "CONTINUOUS" });
    if tags.modern() {
        tags.integer(370, -3);
        tags.handle(390, handle::PLOT_STYLE_NORMAL);
    }
}

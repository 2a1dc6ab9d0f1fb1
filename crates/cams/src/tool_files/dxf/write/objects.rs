//! The objects that later versions require: the root dictionary, plot styles and layouts.

use super::tags::{DxfTags, handle};
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

fn dictionary(tags: &mut DxfTags, own: u32, owner: u32, entries: &[(&str, u32)]) {
    tags.record("DICTIONARY", 5, own, owner, &["AcDbDictionary"]);
    tags.integer(281, 1);
    for (name, entry) in entries {
        tags.text(3, name);
        tags.handle(350, *entry);
    }
}

pub(super) fn objects(tags: &mut DxfTags, extents: &Extents) {
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

fn layout(tags: &mut DxfTags, name: &str, own: u32, block: u32, tab: i64, extents: &Extents) {
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

//! Group codes and values, handles and owners: the grammar of the file.

use super::Version;
use crate::write::number::plain;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// Decimals of coordinates and bulges: 1e-12 mm, or 3e-11 mm of inches, lies in the rounding of a metre; a bulge cut to six decimals would move
/// a long arc by 0.06 µm.
const DECIMALS: usize = 12;

/// Handles of the objects that every file has; entities and layers take those after them.
pub(super) mod handle {
    pub(in super::super) const BLOCK_RECORDS: u32 = 0x1;
    pub(in super::super) const LAYERS: u32 = 0x2;
    pub(in super::super) const STYLES: u32 = 0x3;
    pub(in super::super) const LINETYPES: u32 = 0x5;
    pub(in super::super) const VIEWS: u32 = 0x6;
    pub(in super::super) const UCS: u32 = 0x7;
    pub(in super::super) const VIEWPORTS: u32 = 0x8;
    pub(in super::super) const APPLICATIONS: u32 = 0x9;
    pub(in super::super) const DIMENSION_STYLES: u32 = 0xA;
    pub(in super::super) const ROOT: u32 = 0xC;
    pub(in super::super) const GROUPS: u32 = 0xD;
    pub(in super::super) const PLOT_STYLES: u32 = 0xE;
    pub(in super::super) const PLOT_STYLE_NORMAL: u32 = 0xF;
    pub(in super::super) const LAYER_ZERO: u32 = 0x10;
    pub(in super::super) const STYLE_STANDARD: u32 = 0x11;
    pub(in super::super) const APPLICATION_ACAD: u32 = 0x12;
    pub(in super::super) const LINETYPE_BY_BLOCK: u32 = 0x14;
    pub(in super::super) const LINETYPE_BY_LAYER: u32 = 0x15;
    pub(in super::super) const LINETYPE_CONTINUOUS: u32 = 0x16;
    pub(in super::super) const LAYOUTS: u32 = 0x1A;
    pub(in super::super) const PAPER_SPACE: u32 = 0x1B;
    pub(in super::super) const PAPER_SPACE_BEGIN: u32 = 0x1C;
    pub(in super::super) const PAPER_SPACE_END: u32 = 0x1D;
    pub(in super::super) const LAYOUT_PAPER: u32 = 0x1E;
    pub(in super::super) const MODEL_SPACE: u32 = 0x1F;
    pub(in super::super) const MODEL_SPACE_BEGIN: u32 = 0x20;
    pub(in super::super) const MODEL_SPACE_END: u32 = 0x21;
    pub(in super::super) const LAYOUT_MODEL: u32 = 0x22;
    pub(in super::super) const DIMENSION_STYLE_STANDARD: u32 = 0x27;
    pub(in super::super) const VIEWPORT_ACTIVE: u32 = 0x29;
    pub(in super::super) const FIRST_FREE: u32 = 0x30;
}

/// A growing file of group codes and values.
pub(super) struct DxfTags {
    pub(super) text: Vec<u8>,
    pub(super) version: Version,
    pub(super) units: LengthUnit,
    pub(super) next_handle: u32,
}

impl DxfTags {
    /// A code is right-aligned in three columns.
    pub(super) fn text(&mut self, code: u16, value: &str) {
        self.text.extend_from_slice(format!("{code:>3}\n{value}\n").as_bytes());
    }

    pub(super) fn integer(&mut self, code: u16, value: impl Into<i64>) {
        self.text(code, &value.into().to_string());
    }

    pub(super) fn real(&mut self, code: u16, value: f64) {
        self.text(code, &plain(value, DECIMALS));
    }

    /// A length of the settings for display, mm.
    pub(super) fn setting(&mut self, code: u16, millimetres: f64) {
        self.real(code, self.units.of_mm(millimetres));
    }

    /// The bulge of a vertex, of an arc only: FreeCAD's importer drops an edge of bulge 0 as a degenerate arc, and every reader
    /// takes a vertex without the group for the start of a line.
    pub(super) fn bulge(&mut self, value: f64) {
        let value = plain(value, DECIMALS);
        if value != "0.0" {
            self.text(42, &value);
        }
    }

    pub(super) fn handle(&mut self, code: u16, value: u32) {
        self.text(code, &format!("{value:X}"));
    }

    pub(super) fn point(&mut self, code: u16, point: Vector2<f64>) {
        self.real(code, point.x);
        self.real(code + 10, point.y);
    }

    pub(super) fn point_3d(&mut self, code: u16, point: Vector2<f64>) {
        self.point(code, point);
        self.real(code + 20, 0.0);
    }

    pub(super) fn modern(&self) -> bool {
        self.version != Version::R12
    }

    pub(super) fn new_handle(&mut self) -> u32 {
        self.next_handle += 1;
        self.next_handle - 1
    }

    /// Handle, owner and subclass of a table record or object, where the version has them.
    pub(super) fn record(&mut self, kind: &str, handle_code: u16, own: u32, owner: u32, subclasses: &[&str]) {
        self.text(0, kind);
        if self.modern() {
            self.handle(handle_code, own);
            self.handle(330, owner);
            for subclass in subclasses {
                self.text(100, subclass);
            }
        }
    }

    pub(super) fn section(&mut self, name: &str, content: impl FnOnce(&mut Self)) {
        self.text(0, "SECTION");
        self.text(2, name);
        content(self);
        self.text(0, "ENDSEC");
    }

    pub(super) fn table(&mut self, name: &str, own: u32, count: usize, content: impl FnOnce(&mut Self)) {
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
    pub(super) fn named(&mut self, kind: &str, own: u32, owner: u32, subclass: &str, name: &str) {
        let code = if kind == "DIMSTYLE" { 105 } else { 5 };
        self.record(kind, code, own, owner, &["AcDbSymbolTableRecord", subclass]);
        self.text(2, name);
    }
}

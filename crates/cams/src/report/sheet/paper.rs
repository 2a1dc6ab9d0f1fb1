//! Sheets of ISO 5457 and of ASME Y14.1, and scales of ISO 5455.

use super::{STROKE, ShapeGroup, SheetShape, TextAnchor};
use camgen_kernel::geometry::contour::Extents;
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

/// A sheet of paper, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaperSize {
    /// "A4".
    pub name: &'static str,
    /// Width and height, mm, lengthwise (ISO 5457).
    pub size: Vector2<f64>,
    /// Its border.
    pub border: SheetBorder,
}

/// The border of a sheet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum SheetBorder {
    /// By ISO 5457: fields of 50 mm from the centring marks, numbers from the left, letters from the top.
    #[default]
    Iso,
    /// By ASME Y14.1: so many equal zones along and up, numbers from the right, letters from below.
    Asme {
        /// Margins at the sides and at the top and bottom, mm.
        margin: [f64; 2],
        /// Zones along and up.
        zones: [u32; 2],
    },
}

/// The sheets, the smallest first.
pub const PAPERS: &[PaperSize] = &[
    PaperSize { name: "A3", size: Vector2::new(420.0, 297.0), border: SheetBorder::Iso },
    PaperSize { name: "A2", size: Vector2::new(594.0, 420.0), border: SheetBorder::Iso },
    PaperSize { name: "A1", size: Vector2::new(841.0, 594.0), border: SheetBorder::Iso },
];

/// An inch, mm.
const INCH: f64 = 25.4;

/// A sheet of ASME Y14.1 of a size and with margins, in.
const fn asme(name: &'static str, [width, height]: [f64; 2], [beside, above]: [f64; 2], zones: [u32; 2]) -> PaperSize {
    let border = SheetBorder::Asme { margin: [beside * INCH, above * INCH], zones };
    PaperSize { name, size: Vector2::new(width * INCH, height * INCH), border }
}

/// The sheets of a drawing in inches, the smallest first.
pub const PAPERS_IN_INCHES: &[PaperSize] = &[
    asme("B", [17.0, 11.0], [0.62, 0.38], [4, 2]),
    asme("C", [22.0, 17.0], [0.75, 0.5], [4, 4]),
    asme("D", [34.0, 22.0], [0.5, 1.0], [8, 4]),
];

/// The sheets of drawings in a unit, the smallest first.
#[must_use]
pub fn papers(units: LengthUnit) -> &'static [PaperSize] {
    match units {
        LengthUnit::Millimetre => PAPERS,
        LengthUnit::Inch => PAPERS_IN_INCHES,
    }
}

/// Enlargements of ISO 5455, the largest first: a length on the sheet is this many true lengths.
pub const ENLARGEMENTS: &[f64] = &[10.0, 5.0, 2.0];

/// Reductions of ISO 5455: a length on the sheet is a true length over this.
pub const REDUCTIONS: &[f64] =
    &[1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5, 2e5, 5e5, 1e6, 2e6, 5e6];

/// Thickness of a thin line of a small sheet, and the width of the largest one, mm: A3 and B.
const THIN: f64 = 0.18;
const LARGEST_OF_THIN: f64 = 440.0;

/// Margins of ISO 5457: the left one to file the sheet by.
const FILING: f64 = 20.0;
const MARGIN: f64 = 10.0;
/// Width of the border of the grid reference.
const BORDER: f64 = 5.0;
/// Length of a field of the grid reference, and height of its letters.
const FIELD: f64 = 50.0;
const LETTER: f64 = super::font::SMALLEST;

impl PaperSize {
    /// Thickness of a thin line, mm (ISO 128: the next group of lines on sheets larger than A3).
    #[must_use]
    pub fn stroke(&self) -> f64 {
        if self.size.x > LARGEST_OF_THIN { STROKE } else { THIN }
    }

    /// The frame within a page whose lower left corner lies at a place.
    #[must_use]
    pub fn frame(&self, corner: Vector2<f64>) -> Extents {
        let (low, high) = match self.border {
            SheetBorder::Iso => (Vector2::new(FILING, MARGIN), Vector2::new(MARGIN, MARGIN)),
            SheetBorder::Asme { margin: [beside, above], .. } => {
                (Vector2::new(beside, above), Vector2::new(beside, above))
            }
        };
        Extents { least: corner + low, largest: corner + self.size - high }
    }
}

/// The four sides of a rectangle.
pub(in crate::report) fn rectangle(rect: &Extents) -> Vec<SheetShape> {
    let [a, c] = [rect.least, rect.largest];
    let [b, d] = [Vector2::new(c.x, a.y), Vector2::new(a.x, c.y)];
    vec![SheetShape::Line(a, b), SheetShape::Line(b, c), SheetShape::Line(c, d), SheetShape::Line(d, a)]
}

/// Frame, border with the grid reference, and centring marks.
pub(in crate::report) fn frame_and_grid(paper: &PaperSize, corner: Vector2<f64>) -> Vec<ShapeGroup> {
    let frame = paper.frame(corner);
    let outer = Extents { least: frame.least.add_scalar(-BORDER), largest: frame.largest.add_scalar(BORDER) };
    // The centring marks of ISO 5457 lie on the axes of the sheet, whose left margin is wider.
    let middle = match paper.border {
        SheetBorder::Iso => corner + 0.5 * paper.size,
        SheetBorder::Asme { .. } => 0.5 * (frame.least + frame.largest),
    };
    let mut marks = vec![
        SheetShape::Line(Vector2::new(middle.x, outer.least.y), Vector2::new(middle.x, frame.least.y)),
        SheetShape::Line(Vector2::new(middle.x, frame.largest.y), Vector2::new(middle.x, outer.largest.y)),
        SheetShape::Line(Vector2::new(outer.least.x, middle.y), Vector2::new(frame.least.x, middle.y)),
        SheetShape::Line(Vector2::new(frame.largest.x, middle.y), Vector2::new(outer.largest.x, middle.y)),
    ];
    marks.extend(rectangle(&frame));
    let mut grid = rectangle(&outer);
    for (along, across) in [(0, 1), (1, 0)] {
        let side = |index: usize, which: &Vector2<f64>| which.as_slice().get(index).copied().unwrap_or(0.0);
        let (low, high, centre) = (side(along, &frame.least), side(along, &frame.largest), side(along, &middle));
        let edges = match paper.border {
            SheetBorder::Iso => fields_from(centre, [low, high]),
            SheetBorder::Asme { zones: [beside, above], .. } => {
                equal_zones([low, high], if along == 0 { beside } else { above })
            }
        };
        let is_asme = paper.border != SheetBorder::Iso;
        let strips = [
            (side(across, &outer.least), side(across, &frame.least)),
            (side(across, &frame.largest), side(across, &outer.largest)),
        ];
        let count = edges.len() - 1;
        for (from, to) in strips {
            let point = |a: f64, b: f64| if along == 0 { Vector2::new(a, b) } else { Vector2::new(b, a) };
            let inner = edges.get(1..count).unwrap_or_default();
            grid.extend(inner.iter().map(|edge| SheetShape::Line(point(*edge, from), point(*edge, to))));
            for (index, (a, b)) in edges.iter().zip(edges.iter().skip(1)).enumerate() {
                let at = point(0.5 * (a + b), 0.5 * (from + to)) - Vector2::new(0.0, 0.36 * LETTER);
                // Numbers from the left, letters from the top; of ASME Y14.1 both from the lower right corner.
                let turned = is_asme == (along == 0);
                let place = if turned { count - 1 - index } else { index };
                let text = if along == 0 { (place + 1).to_string() } else { letter(place) };
                grid.push(SheetShape::Text { at, height: LETTER, anchor: TextAnchor::Middle, text });
            }
        }
    }
    vec![ShapeGroup::new("grid-reference", "grid reference", grid), ShapeGroup::new("frame", "frame", marks)]
}

/// Edges of fields of 50 mm from the centring marks, as many as ISO 5457 has for the sheet; the outermost take the rest.
fn fields_from(centre: f64, [low, high]: [f64; 2]) -> Vec<f64> {
    let fields = ((0.5 * (high - low)) / FIELD).round().max(1.0);
    let mut edges = vec![low];
    let mut step = -(fields - 1.0);
    while step <= fields - 1.0 {
        edges.push(centre + step * FIELD);
        step += 1.0;
    }
    edges.push(high);
    edges
}

/// Edges of so many equal zones.
fn equal_zones([low, high]: [f64; 2], zones: u32) -> Vec<f64> {
    (0..=zones).map(|index| low + (high - low) * f64::from(index) / f64::from(zones.max(1))).collect()
}

/// Letters of the grid reference, without I and O.
fn letter(index: usize) -> String {
    "ABCDEFGHJKLMNPQRSTUVWXYZ".chars().nth(index).map_or_else(|| (index + 1).to_string(), String::from)
}

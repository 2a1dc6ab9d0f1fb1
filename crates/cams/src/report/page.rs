//! The page of a picture: the answer as its title, what it holds for, and the command in the foot; and the pen that draws on it.

use super::sheet::{STROKE, ShapeGroup, Sheet, SheetShape, TextAnchor, font, words};
use super::style::{PictureColour, SMALL, SUBTITLE, TITLE};
use camgen_kernel::geometry::contour::Extents;
use nalgebra::Vector2;

/// A page and the size of its lettering over that of an A4.
#[derive(Debug, Clone, Copy)]
pub(super) struct PagePaper {
    size: Vector2<f64>,
    lettering: f64,
}

/// A4, lengthwise.
pub(super) const PAGE: PagePaper = PagePaper { size: Vector2::new(297.0, 210.0), lettering: 1.0 };
/// A3: a mechanism next to the plots needs room.
pub(super) const LARGE_PAGE: PagePaper = PagePaper { size: Vector2::new(420.0, 297.0), lettering: 1.2 };

/// Margin of a page over its lettering, mm.
const MARGIN: f64 = 8.0;

/// A page that is drawn.
#[derive(Debug)]
pub(super) struct PicturePage {
    title: String,
    paper: PagePaper,
    /// Size of the lettering over that of an A4.
    pub(super) k: f64,
    /// The field below the head and above the foot, mm.
    pub(super) body: Extents,
    groups: Vec<ShapeGroup>,
}

impl PicturePage {
    /// A page with its head and foot.
    pub(super) fn new(paper: PagePaper, title: &str, subtitle: &str, foot: &str) -> Self {
        let k = paper.lettering;
        let margin = MARGIN * k;
        let room = paper.size.x - 2.0 * margin;
        let body = Extents { least: Vector2::repeat(margin), largest: paper.size.add_scalar(-margin) };
        let mut page = Self { title: title.to_owned(), paper, k, body, groups: Vec::new() };
        let mut top = paper.size.y - 0.6 * margin;
        for (class, text, size, most) in [("heading", title, TITLE * k, 2.0), ("second", subtitle, SUBTITLE * k, 2.0)] {
            if text.is_empty() {
                continue;
            }
            let (lines, size) = font::fitted(text, size, room, (most - 1.0) * font::LEADING * size + size);
            let mut shapes = Vec::new();
            for line in lines {
                top -= font::LEADING * size;
                shapes.push(words(Vector2::new(margin, top), size, TextAnchor::Start, line));
            }
            top -= 0.15 * size;
            page.add(class, if class == "heading" { "title" } else { "subtitle" }, None, shapes);
        }
        page.body.largest.y = top - 2.0 * k;
        if !foot.is_empty() {
            let (foot, size) = font::fitted_in_one(foot, SMALL * k, room);
            let at = Vector2::new(margin, 0.75 * margin);
            page.add("second", "foot", None, vec![words(at, size, TextAnchor::Start, foot)]);
            page.body.least.y += 0.5 * margin;
        }
        page
    }

    /// Draws shapes in front of what is there; nothing where there are none.
    pub(super) fn add(&mut self, class: &'static str, label: &str, colour: Option<&str>, shapes: Vec<SheetShape>) {
        if shapes.is_empty() {
            return;
        }
        self.groups.push(ShapeGroup {
            id: format!("{class}-{}", self.groups.len()),
            class,
            label: label.to_owned().into(),
            colour: colour.map(str::to_owned),
            shapes,
            in_legend: false,
        });
    }

    /// Draws groups that something else made.
    pub(super) fn extend(&mut self, groups: impl IntoIterator<Item = ShapeGroup>) {
        self.groups.extend(groups);
    }

    /// A text in a colour, with a halo that keeps it readable on lines.
    pub(super) fn label(&mut self, colour: PictureColour, label: &str, texts: Vec<SheetShape>) {
        self.add("direct", label, Some(colour.text()), texts);
    }

    /// The sheet.
    pub(super) fn sheet(self) -> Sheet {
        Sheet {
            title: self.title,
            extents: Extents { least: Vector2::zeros(), largest: self.paper.size },
            stroke: STROKE * self.k,
            scale: 1.0,
            groups: self.groups,
        }
    }
}

/// The corners of a field, as an area.
pub(super) fn area(field: &Extents) -> SheetShape {
    let [a, c] = [field.least, field.largest];
    SheetShape::Area(vec![a, Vector2::new(c.x, a.y), c, Vector2::new(a.x, c.y)])
}

/// Distance of the lines of a hatched field, mm.
const HATCH: f64 = 2.2;

/// Lines across a field at 45°.
pub(super) fn hatch(field: &Extents) -> Vec<SheetShape> {
    let size = field.size();
    if !(size.x > 0.0 && size.y > 0.0 && size.x + size.y < 1e4) {
        return Vec::new();
    }
    let mut lines = Vec::new();
    let mut along = HATCH - size.y;
    while along < size.x {
        // From the lower edge, or the left side, up to the upper edge, or the right side.
        let (from, to) = (along.max(0.0), (along + size.y).min(size.x));
        let on = |x: f64| field.least + Vector2::new(x, x - along);
        lines.push(SheetShape::Line(on(from), on(to)));
        along += HATCH;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hatching_stays_in_its_field() {
        for (width, height) in [(30.0, 4.0), (4.0, 30.0), (10.0, 10.0)] {
            let field = Extents { least: Vector2::new(5.0, 7.0), largest: Vector2::new(5.0 + width, 7.0 + height) };
            let lines = hatch(&field);
            assert!(lines.len() > 4);
            for line in &lines {
                let SheetShape::Line(a, b) = line else { panic!("a line") };
                for end in [a, b] {
                    assert!(end.iter().zip(field.least.iter()).all(|(x, low)| x >= &(low - 1e-9)), "{end}");
                    assert!(end.iter().zip(field.largest.iter()).all(|(x, high)| x <= &(high + 1e-9)), "{end}");
                }
                assert!(((b - a).x - (b - a).y).abs() < 1e-9);
            }
        }
        assert!(hatch(&Extents { least: Vector2::zeros(), largest: Vector2::zeros() }).is_empty());
    }
}

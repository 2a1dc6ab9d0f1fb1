//! The review sheet as SVG at true size: one user unit is a millimetre, arcs are arcs, y is flipped once, in the
//! coordinates.

use super::path_data::PathData;
use super::{Format, FormatError, OfAnalysis, Rendering, When, fits_all};
use crate::body;
use crate::geometry::contour::Segment;
use crate::geometry::{Entity, MILLIMETRES};
use crate::profile::outline::Fit;
use crate::report::sheet::{Extras, Group, Shape, Sheet, TextAnchor, compose, font};
use crate::report::{plot, shown};
use nalgebra::Vector2;
use std::borrow::Cow;
use svg::node::element;

/// The review sheet.
pub const FORMAT: Format = Format {
    name: "svg",
    when: When::Usual,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".svg".into()],
    write: |cam| Ok(vec![fill(&sheet(cam)?, cam.template, true, &cam.report.mark())?]),
    of_analysis: Some(OfAnalysis {
        endings: |_| vec![".svg".into()],
        write: |account| {
            let sheet = plot::sheet(&account.analysis.plot, &account.report.mark());
            Ok(vec![fill(&sheet, account.template, true, &account.report.mark())?])
        },
    }),
};

/// The review sheet of a proven cam.
///
/// # Errors
/// [`FormatError`] when a curve for viewing cannot be drawn.
pub fn sheet(cam: &Rendering<'_>) -> Result<Sheet, FormatError> {
    let view = cam.body.view(cam.drawn)?;
    let outline = cam.outlines.first().map(|outline| &outline.contour);
    let second = cam.second.and_then(|(body, outlines)| Some((body, &outlines.first()?.contour)));
    let traces = outline.map_or_else(Vec::new, |outline| body::traces((cam.body, outline), second));
    let profile_tolerance = tolerance_words(&cam.fit);
    Ok(compose(&view, cam.report, &Extras { profile_tolerance: &profile_tolerance, traces: &traces }))
}

/// The zone in which the profile must lie, in words.
fn tolerance_words(fit: &Fit) -> String {
    let (middle, half) = fit.band();
    let [low, high] = [middle - half, middle + half].map(|limit| shown(MILLIMETRES * limit));
    if middle == 0.0 { format!("±{high} mm to exact curve") } else { format!("{low} to {high} mm to exact curve") }
}

/// The sheet used when none is given.
pub const TEMPLATE: &str = include_str!("../../templates/sheet.svg");

/// Classes of the groups that show an outline: they tell their scale.
const OUTLINES: [&str; 2] = ["profile", "section"];
/// Decimals of a coordinate: a nanometre.
const DECIMALS: usize = 6;

/// Why a template cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum TemplateError {
    /// It has no placeholder for the drawing.
    #[error("the template has no {{{{drawing}}}}: nothing would be drawn")]
    NoDrawing,
    /// It has an unknown placeholder.
    #[error("the template has the unknown placeholder {{{{{0}}}}}; known are {KNOWN}")]
    Unknown(String),
}

const KNOWN: &str = "width, height, left, top, stroke, thick, heavy, dash, dot, title, drawing";

/// The coordinates of the sheet.
const DATA: PathData = PathData { decimals: DECIMALS };

/// Bytes of a sheet of a usual cam.
const ROOM: usize = 1 << 17;

fn number(value: f64) -> String {
    DATA.number(value)
}

/// Fills a template with the sheet.
///
/// # Errors
/// [`TemplateError`] when a placeholder is missing or unknown.
pub fn write(sheet: &Sheet, template: &str) -> Result<Vec<u8>, TemplateError> {
    fill(sheet, template, true, "")
}

/// As [`write`], with a comment before the root, whatever the template; `told`: every text tells its length, so that a viewer with
/// another font keeps it.
pub(super) fn fill(sheet: &Sheet, template: &str, told: bool, comment: &str) -> Result<Vec<u8>, TemplateError> {
    let size = sheet.extents.size();
    let dashes = |parts: &[f64]| parts.iter().map(|n| number(n * sheet.stroke)).collect::<Vec<_>>().join(" ");
    let push = |text: &mut Vec<u8>, name: &str| {
        let value = match name {
            "width" => number(size.x),
            "height" => number(size.y),
            "left" => number(sheet.extents.least.x),
            // Upwards in the drawing, downwards in the file.
            "top" => number(-sheet.extents.largest.y),
            "stroke" => number(sheet.stroke),
            "thick" => number(2.0 * sheet.stroke),
            "heavy" => number(4.0 * sheet.stroke),
            "dash" => dashes(&[24.0, 6.0, 4.0, 6.0]),
            "dot" => dashes(&[8.0, 8.0]),
            "title" => escaped(&sheet.title),
            "drawing" => {
                for (index, shown) in sheet.groups.iter().enumerate() {
                    text.extend_from_slice(if index > 0 { b"\n" } else { b"" });
                    push_group(text, shown, sheet.scale, told);
                }
                return Ok(());
            }
            _ => return Err(TemplateError::Unknown(name.to_owned())),
        };
        text.extend_from_slice(value.as_bytes());
        Ok(())
    };
    if !template.contains("{{drawing}}") {
        return Err(TemplateError::NoDrawing);
    }
    // The comment that explains the placeholders belongs to the template and is left out of the sheet.
    let mut text = Vec::with_capacity(template.len() + ROOM);
    let template = without_comments(template);
    let mut rest = template.as_str();
    if !comment.is_empty() {
        rest = push_comment(&mut text, rest, comment);
    }
    while let Some((before, behind)) = rest.split_once("{{") {
        let (name, after) = behind.split_once("}}").unwrap_or((behind, ""));
        text.extend_from_slice(before.as_bytes());
        push(&mut text, name.trim())?;
        rest = after;
    }
    text.extend_from_slice(rest.as_bytes());
    Ok(text)
}

/// Adds the declaration of XML that a template may begin with, and a comment behind it; what is left of the template.
fn push_comment<'a>(text: &mut Vec<u8>, template: &'a str, comment: &str) -> &'a str {
    let declared = template.strip_prefix("<?xml").and_then(|behind| behind.split_once("?>"));
    if let Some((declaration, _)) = declared {
        for part in ["<?xml", declaration, "?>\n"] {
            text.extend_from_slice(part.as_bytes());
        }
    }
    for part in ["<!-- ", comment, " -->\n"] {
        text.extend_from_slice(part.as_bytes());
    }
    declared.map_or(template, |(_, rest)| rest.trim_ascii_start())
}

fn without_comments(template: &str) -> String {
    let mut text = String::new();
    let mut rest = template;
    while let Some((before, behind)) = rest.split_once("<!--") {
        text.push_str(before);
        rest = behind.split_once("-->").map_or("", |(_, after)| after.trim_start_matches('\n'));
    }
    text.push_str(rest);
    text
}

/// Text that may stand in XML: escaped, control characters left out.
fn escaped(text: &str) -> String {
    let mut out = Vec::new();
    push_escaped(&mut out, text);
    String::from_utf8(out).unwrap_or_default()
}

/// Whether XML has a place for a character: for no control and neither of the two noncharacters.
fn is_printable(c: char) -> bool {
    !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}')
}

/// A text without what XML has no place for.
fn printable(text: &str) -> Cow<'_, str> {
    if text.chars().all(is_printable) { text.into() } else { text.chars().filter(|c| is_printable(*c)).collect() }
}

/// Adds a text without what XML has no place for, escaped.
fn push_escaped(out: &mut Vec<u8>, text: &str) {
    if text.bytes().all(|byte| matches!(byte, b' '..=b'~') && !matches!(byte, b'&' | b'<' | b'>')) {
        return out.extend_from_slice(text.as_bytes());
    }
    for c in text.chars().filter(|c| is_printable(*c)) {
        let mut own = [0; 4];
        let escaped = match c {
            '&' => "&amp;",
            '<' => "&lt;",
            '>' => "&gt;",
            c => c.encode_utf8(&mut own),
        };
        out.extend_from_slice(escaped.as_bytes());
    }
}

/// Adds an attribute whose value is written by a function.
fn attribute(out: &mut Vec<u8>, name: &str, value: impl FnOnce(&mut Vec<u8>)) {
    for part in [" ", name, "=\""] {
        out.extend_from_slice(part.as_bytes());
    }
    value(out);
    out.push(b'"');
}

/// Adds attributes that are numbers; of each what stands before its number.
fn numbers(out: &mut Vec<u8>, values: &[(&str, f64)]) {
    for (begin, value) in values {
        out.extend_from_slice(begin.as_bytes());
        DATA.push_number(out, *value);
        out.push(b'"');
    }
}

/// Adds a group of shapes, each on a line of its own. Its many shapes are written into its tag: as elements of their own they took half of
/// the time of a sheet.
fn push_group(out: &mut Vec<u8>, group: &Group, scale: f64, told: bool) {
    let mut node = element::Group::new()
        .set("id", group.id.as_str())
        .set("class", group.class)
        .set("inkscape:groupmode", "layer")
        .set("inkscape:label", printable(&group.label).as_ref());
    if let Some(colour) = &group.colour {
        node = node.set("stroke", colour.as_str());
    }
    if OUTLINES.contains(&group.class) {
        node = node.set("data-scale", number(scale));
    }
    let tag = node.to_string();
    if group.shapes.is_empty() {
        return out.extend_from_slice(tag.as_bytes());
    }
    out.extend_from_slice(tag.trim_end_matches("/>").as_bytes());
    out.extend_from_slice(b">\n");
    for shape in &group.shapes {
        push_shape(out, shape, told);
        out.push(b'\n');
    }
    out.extend_from_slice(b"</g>");
}

fn push_shape(out: &mut Vec<u8>, shape: &Shape, told: bool) {
    let element = match shape {
        Shape::Entity(Entity::Polyline(_)) | Shape::Arc(..) => "<path",
        Shape::Entity(Entity::Circle(..)) => "<circle",
        Shape::Line(..) => "<line",
        Shape::Path(_) => "<polyline",
        Shape::Triangle(_) => "<polygon",
        Shape::Text { at, height, anchor, text } => return push_words(out, (*at, *height, *anchor), text, told),
    };
    out.extend_from_slice(element.as_bytes());
    match shape {
        Shape::Entity(Entity::Polyline(contour)) => attribute(out, "d", |out| DATA.push_contour(out, contour)),
        Shape::Entity(Entity::Circle(centre, radius)) => {
            numbers(out, &[(" cx=\"", centre.x), (" cy=\"", -centre.y), (" r=\"", *radius)]);
        }
        Shape::Line(a, b) => {
            numbers(out, &[(" x1=\"", a.x), (" x2=\"", b.x), (" y1=\"", -a.y), (" y2=\"", -b.y)]);
        }
        Shape::Path(points) => attribute(out, "points", |out| DATA.push_places(out, points, b' ')),
        Shape::Arc(start, end, bulge) => {
            let segment = Segment { start: *start, end: *end, bulge: *bulge };
            attribute(out, "d", |out| DATA.push_open_arc(out, &segment));
        }
        Shape::Triangle(corners) => attribute(out, "points", |out| DATA.push_places(out, corners, b' ')),
        Shape::Text { .. } => {}
    }
    out.extend_from_slice(b"/>");
}

/// Adds a text at a place, of a height, on its anchor.
fn push_words(out: &mut Vec<u8>, (at, height, anchor): (Vector2<f64>, f64, TextAnchor), text: &str, told: bool) {
    let anchor = match anchor {
        TextAnchor::Start => "start",
        TextAnchor::Middle => "middle",
        TextAnchor::End => "end",
    };
    out.extend_from_slice(br#"<text font-size=""#);
    DATA.push_number(out, height);
    out.extend_from_slice(if told {
        br#"" lengthAdjust="spacingAndGlyphs" text-anchor=""#
    } else {
        br#"" text-anchor=""#
    });
    out.extend_from_slice(anchor.as_bytes());
    if told {
        out.extend_from_slice(br#"" textLength=""#);
        DATA.push_number(out, font::width(text, height));
    }
    out.extend_from_slice(br#"" x=""#);
    DATA.push_number(out, at.x);
    out.extend_from_slice(br#"" xml:space="preserve" y=""#);
    DATA.push_number(out, -at.y);
    out.extend_from_slice(b"\">\n");
    push_escaped(out, text);
    out.extend_from_slice(b"\n</text>");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::{Contour, Extents};

    fn sheet(title: &str) -> Sheet {
        let contour = Contour::circle(Vector2::new(1.0, 2.0), 5.0);
        let shapes = vec![
            Shape::Entity(Entity::Polyline(contour)),
            Shape::Text { at: Vector2::zeros(), height: 2.0, anchor: TextAnchor::Middle, text: title.into() },
        ];
        Sheet {
            title: title.into(),
            extents: Extents { least: Vector2::new(-10.0, -20.0), largest: Vector2::new(30.0, 40.0) },
            stroke: 0.1,
            scale: 1.0,
            groups: vec![Group::new("profile", "profile", shapes)],
        }
    }

    #[test]
    fn size_is_true_and_y_flipped_once() {
        let text = String::from_utf8(write(&sheet("x"), TEMPLATE).expect("filled")).expect("UTF-8");
        assert!(text.contains(r#"width="40mm" height="60mm" viewBox="-10 -40 40 60""#), "{text}");
        assert!(text.contains("M6,-2 A5,5 0 0 0 1,-7 A5,5 0 0 0 -4,-2"), "{text}");
        assert!(!text.contains("{{"));
    }

    #[test]
    fn words_are_escaped_and_cleaned() {
        let text = String::from_utf8(write(&sheet("a<b>&\u{1}\u{7f}\"Ю\""), TEMPLATE).expect("filled")).expect("UTF-8");
        assert!(text.contains("a&lt;b&gt;&amp;") && text.contains('Ю'));
        assert!(!text.chars().any(|c| c.is_control() && c != '\n'));
    }

    #[test]
    fn a_template_that_cannot_be_filled_is_told() {
        assert_eq!(write(&sheet("x"), "<svg/>"), Err(TemplateError::NoDrawing));
        assert_eq!(write(&sheet("x"), "{{drawing}}{{colour}}"), Err(TemplateError::Unknown("colour".into())));
    }
}

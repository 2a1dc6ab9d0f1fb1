//! The sheets as SVG at true size: one user unit is a millimetre, arcs are arcs, y is flipped once, in the
//! coordinates.

use super::path_data::PathData;
use super::template;
use super::{AnalysisFormat, FormatSelection, PartFile, Rendering, View, fits_all};
use crate::body;
use crate::machine::Catalogue;
use crate::report::sheet::{ShapeGroup, Sheet, SheetExtras, SheetKind, SheetShape, TextAnchor, compose, font};
use crate::report::{Finding, Verdict, shown};
use camgen_kernel::geometry::contour::{Contour, Segment};
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::profile::outline::Fit;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units::LengthUnit;
use svg::node::{self, Node, element};

/// The drawing of the part and its review sheet.
pub const FORMAT: View = View {
    name: "svg",
    when: FormatSelection::Usual,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".svg".into(), "-review.svg".into()],
    write: |cam| {
        let sheets = [drawing(cam, "1/2")?, review(cam, "2/2")?];
        sheets.iter().map(|sheet| fill(sheet, cam.template, true, &cam.report.mark())).collect()
    },
    of_analysis: Some(AnalysisFormat {
        endings: |analysis| analysis.picture.endings().iter().map(|ending| format!("{ending}.svg")).collect(),
        write: |account| {
            let mark = account.report.mark();
            let sheets = account.analysis.sheets(&mark);
            sheets.iter().map(|(_, sheet)| fill(sheet, account.template, true, &mark)).collect()
        },
    }),
};

/// The drawing from which a shop makes the part of a proven cam, as one of several sheets, such as "1/2".
///
/// # Errors
/// [`Refusal`] when a curve for viewing cannot be drawn.
pub fn drawing(cam: &Rendering<'_>, number: &str) -> Result<Sheet, Refusal> {
    let view = cam.body.part_view(cam.drawn).map_err(Refusal::of)?;
    let file_deviates = deviation_words(&cam.fit, cam.report.units);
    let files: Vec<String> = cam.part_files.iter().map(PartFile::words).collect();
    let extras = SheetExtras {
        kind: SheetKind::Drawing,
        files: &files,
        file_deviates: &file_deviates,
        number,
        traces: &[],
        checks: &[],
        passed_otherwise: 0,
    };
    Ok(compose(&view, cam.report, &extras))
}

/// The review sheet of a proven cam, as one of several sheets.
///
/// # Errors
/// [`Refusal`] when a curve for viewing cannot be drawn.
pub fn review(cam: &Rendering<'_>, number: &str) -> Result<Sheet, Refusal> {
    let view = cam.body.view(cam.drawn).map_err(Refusal::of)?;
    let outline = cam.outlines.first().map(|outline| &outline.contour);
    let second = cam.other_cams.first().and_then(|(body, outlines)| Some((*body, &outlines.first()?.contour)));
    let traces = outline.map_or_else(Vec::new, |outline| body::traces((cam.body, outline), second));
    let file_deviates = deviation_words(&cam.fit, cam.report.units);
    let (checks, passed_otherwise) = listed_checks(&cam.report.checks, cam.body.machine().catalogue());
    let extras = SheetExtras {
        kind: SheetKind::Review,
        files: &[],
        file_deviates: &file_deviates,
        number,
        traces: &traces,
        checks: &checks,
        passed_otherwise,
    };
    Ok(compose(&view, cam.report, &extras))
}

/// The findings that a sheet lists, and how many others passed: figures about the bytes of the files are for the report, where they passed.
pub(crate) fn listed_checks(all: &[Finding], catalogue: &Catalogue) -> (Vec<Finding>, usize) {
    let is_listed = |finding: &&Finding| finding.verdict != Verdict::Pass || !catalogue.reads_files(&finding.check);
    let checks: Vec<Finding> = all.iter().filter(is_listed).cloned().collect();
    let passed_otherwise = all.len() - checks.len();
    (checks, passed_otherwise)
}

/// How far the profile of the file may lie from the exact one, in words.
pub(crate) fn deviation_words(fit: &Fit, units: LengthUnit) -> String {
    let (middle, half) = fit.band();
    let [low, high] = [middle - half, middle + half].map(|limit| shown(units.of_mm(MILLIMETRES * limit)));
    let unit = units.symbol();
    if middle == 0.0 { format!("at most {high} {unit}") } else { format!("{low} {unit} to {high} {unit} outwards") }
}

/// The sheet used when none is given.
pub const TEMPLATE: &str = include_str!("../../templates/sheet.svg");

/// Classes of the groups that show an outline: they state their scale.
const OUTLINES: [&str; 3] = ["profile", "section", "outline"];
/// Classes of the groups whose colour fills their shapes.
const FILLED: [&str; 2] = ["area", "dot"];
/// Decimals of a coordinate: a nanometre.
const DECIMALS: usize = 6;

const KNOWN: &str = "width, height, left, top, stroke, thick, heavy, dash, dot, font, title, drawing";
/// The letters of sheets, embedded: a viewer may not have the font that they are measured in.
const FONT_RULE: &str = include_str!("../../templates/fonts/sheet-font.css");

/// The coordinates of the sheet.
const DATA: PathData = PathData { decimals: DECIMALS, cubics: false };
const DATA_OF_PDF: PathData = PathData { cubics: true, ..DATA };

fn number(value: f64) -> String {
    DATA.number(value)
}

/// Fills a template with the sheet.
///
/// # Errors
/// [`Refusal`] when a placeholder is missing or unknown.
pub fn write(sheet: &Sheet, template: &str) -> Result<Vec<u8>, Refusal> {
    fill(sheet, template, true, "")
}

/// As [`write`], with a comment before the root, whatever the template; with `with_lengths` every text states its length, so that a viewer with
/// another font keeps it.
pub(crate) fn fill(sheet: &Sheet, template: &str, with_lengths: bool, comment: &str) -> Result<Vec<u8>, Refusal> {
    let size = sheet.extents.size();
    let dashes = |parts: &[f64]| parts.iter().map(|n| number(n * sheet.stroke)).collect::<Vec<_>>().join(" ");
    let drawing =
        || sheet.groups.iter().map(|group| layer(group, sheet.scale, with_lengths).to_string()).collect::<Vec<_>>();
    let value = |name: &str| match name {
        "width" => Ok(number(size.x)),
        "height" => Ok(number(size.y)),
        "left" => Ok(number(sheet.extents.least.x)),
        // Upwards in the drawing is downwards in the file.
        "top" => Ok(number(-sheet.extents.largest.y)),
        "stroke" => Ok(number(sheet.stroke)),
        "thick" => Ok(number(2.0 * sheet.stroke)),
        "heavy" => Ok(number(4.0 * sheet.stroke)),
        "dash" => Ok(dashes(&[24.0, 6.0, 4.0, 6.0])),
        "dot" => Ok(dashes(&[8.0, 8.0])),
        // A PDF gets the whole font from elsewhere.
        "font" => Ok(if with_lengths { FONT_RULE.trim_end().to_owned() } else { String::new() }),
        "title" => Ok(node::Text::new(printable(&sheet.title)).to_string()),
        "drawing" => Ok(drawing().join("\n")),
        _ => Err(Refusal::new(format!("the template has the unknown placeholder {{{{{name}}}}}"))
            .remedy(format!("known are {KNOWN}"))),
    };
    // The comment that explains the placeholders belongs to the template and is left out of the sheet.
    let bare = without_comments(template, |_| String::new());
    if template != TEMPLATE {
        let in_its_lines = without_comments(template, |comment| comment.chars().filter(|c| *c == '\n').collect());
        template::check(&in_its_lines)?;
    }
    let (mut text, mut rest) = marked(&bare, comment);
    while let Some((before, behind)) = rest.split_once("{{") {
        let (name, after) = behind.split_once("}}").unwrap_or((behind, ""));
        text.push_str(before);
        text.push_str(&value(name.trim())?);
        rest = after;
        if text.len() > template::LARGEST_SHEET {
            return Err(Refusal::new("the sheet in this template is larger than 20 MiB"));
        }
    }
    text.push_str(rest);
    Ok(text.into_bytes())
}

/// The declaration of XML that a template may begin with, with a comment behind it, and what is left of the template.
fn marked<'a>(template: &'a str, comment: &str) -> (String, &'a str) {
    if comment.is_empty() {
        return (String::new(), template);
    }
    let comment = node::Comment::new(comment);
    match template.strip_prefix("<?xml").and_then(|behind| behind.split_once("?>")) {
        Some((declaration, rest)) => (format!("<?xml{declaration}?>\n{comment}\n"), rest.trim_ascii_start()),
        None => (format!("{comment}\n"), template),
    }
}

/// A template with something in the place of each comment and the line feeds behind it.
fn without_comments(template: &str, instead: impl Fn(&str) -> String) -> String {
    let mut text = String::new();
    let mut rest = template;
    while let Some((before, behind)) = rest.split_once("<!--") {
        text.push_str(before);
        let after = behind.split_once("-->").map_or("", |(_, after)| after.trim_start_matches('\n'));
        text.push_str(&instead(behind.strip_suffix(after).unwrap_or(behind)));
        rest = after;
    }
    text.push_str(rest);
    text
}

/// A text without the characters that XML does not allow: control characters and the two noncharacters.
fn printable(text: &str) -> String {
    text.chars().filter(|c| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}')).collect()
}

/// A group of shapes as a layer of Inkscape.
fn layer(group: &ShapeGroup, scale: f64, with_lengths: bool) -> element::Group {
    let mut node = element::Group::new()
        .set("id", group.id.as_str())
        .set("class", group.class)
        .set("inkscape:groupmode", "layer")
        .set("inkscape:label", printable(&group.label.to_string()));
    if let Some(colour) = &group.colour {
        // Texts take `color` where their class says so.
        node = if FILLED.contains(&group.class) {
            node.set("fill", colour.as_str())
        } else {
            node.set("stroke", colour.as_str()).set("color", colour.as_str())
        };
    }
    if OUTLINES.contains(&group.class) {
        node = node.set("data-scale", number(scale));
    }
    group.shapes.iter().fold(node, |node, shape| node.add(shape_element(shape, with_lengths)))
}

fn shape_element(shape: &SheetShape, with_lengths: bool) -> Box<dyn Node> {
    let data = if with_lengths { DATA } else { DATA_OF_PDF };
    match shape {
        SheetShape::Entity(Entity::Polyline(contour)) => element::Path::new().set("d", data.contour(contour)).into(),
        SheetShape::Entity(Entity::Circle(centre, radius)) if data.cubics => {
            element::Path::new().set("d", data.contour(&Contour::circle(*centre, *radius))).into()
        }
        SheetShape::Entity(Entity::Circle(centre, radius)) => {
            let circle = element::Circle::new().set("cx", number(centre.x)).set("cy", number(-centre.y));
            circle.set("r", number(*radius)).into()
        }
        SheetShape::Entity(Entity::Segment(segment)) => element::Path::new().set("d", data.open_arc(segment)).into(),
        SheetShape::Line(a, b) => {
            let line = element::Line::new().set("x1", number(a.x)).set("y1", number(-a.y));
            line.set("x2", number(b.x)).set("y2", number(-b.y)).into()
        }
        SheetShape::Path(points) => element::Polyline::new().set("points", data.places(points, " ")).into(),
        SheetShape::Arc(start, end, bulge) => {
            let segment = Segment { start: *start, end: *end, bulge: *bulge };
            element::Path::new().set("d", data.open_arc(&segment)).into()
        }
        SheetShape::Triangle(corners) => element::Polygon::new().set("points", data.places(corners, " ")).into(),
        SheetShape::Area(corners) => element::Polygon::new().set("points", data.places(corners, " ")).into(),
        SheetShape::Text { at, height, anchor, text } => {
            let anchor = match anchor {
                TextAnchor::Start => "start",
                TextAnchor::Middle => "middle",
                TextAnchor::End => "end",
            };
            // Blanks at its ends are dropped by readers: the crate `svg` puts the text on a line of its own.
            let mut node = element::Text::new(printable(text))
                .set("x", number(at.x))
                .set("y", number(-at.y))
                .set("font-size", number(*height))
                .set("text-anchor", anchor);
            if with_lengths {
                let width = number(font::width(text, *height));
                node = node.set("textLength", width).set("lengthAdjust", "spacingAndGlyphs");
            }
            node.into()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::geometry::contour::Extents;
    use nalgebra::Vector2;

    fn sheet(title: &str) -> Sheet {
        let contour = Contour::circle(Vector2::new(1.0, 2.0), 5.0);
        let shapes = vec![
            SheetShape::Entity(Entity::Polyline(contour)),
            SheetShape::Text { at: Vector2::zeros(), height: 2.0, anchor: TextAnchor::Middle, text: title.into() },
        ];
        Sheet {
            title: title.into(),
            extents: Extents { least: Vector2::new(-10.0, -20.0), largest: Vector2::new(30.0, 40.0) },
            stroke: 0.1,
            scale: 1.0,
            groups: vec![ShapeGroup::new("profile", "profile", shapes)],
        }
    }

    #[test]
    fn size_is_true_and_y_flipped_once() {
        let text = String::from_utf8(write(&sheet("x"), TEMPLATE).expect("filled")).expect("UTF-8");
        assert!(text.contains(r#"width="40mm" height="60mm" viewBox="-10 -40 40 60""#), "{text}");
        assert!(text.contains("M6,-2 A5,5 0 0 0 1,-7 A5,5 0 0 0 -4,-2"), "{text}");
        assert!(!text.contains("{{"));
    }

    /// Line ends about a text that were kept would be blanks: a digit would be drawn at a third of its width.
    #[test]
    fn a_text_has_no_blanks_at_its_ends() {
        let text = String::from_utf8(write(&sheet("7"), TEMPLATE).expect("filled")).expect("UTF-8");
        let document = roxmltree::Document::parse(&text).expect("XML");
        let digit = document.descendants().find(|node| node.has_tag_name("text")).expect("a text");
        assert_eq!(digit.text().map(str::trim), Some("7"));
        let kept = digit.ancestors().any(|node| node.attributes().any(|attribute| attribute.name() == "space"));
        assert!(!kept, "{text}");
    }

    #[test]
    fn words_are_escaped_and_cleaned() {
        let text = String::from_utf8(write(&sheet("a<b>&\u{1}\u{7f}\"Ю\""), TEMPLATE).expect("filled")).expect("UTF-8");
        assert!(text.contains("a&lt;b&gt;&amp;") && text.contains('Ю'));
        assert!(!text.chars().any(|c| c.is_control() && c != '\n'));
    }

    #[test]
    fn a_template_that_cannot_be_filled_is_refused() {
        let what = |template: &str| write(&sheet("x"), template).expect_err("refused").what;
        assert_eq!(what("<svg/>"), "the template has no placeholder {{drawing}}, so nothing would be drawn");
        assert_eq!(what("<svg>{{drawing}}{{colour}}</svg>"), "the template has the unknown placeholder {{colour}}");
    }
}

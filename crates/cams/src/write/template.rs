//! What a template of the review sheet may contain. It is a file of somebody else: it must not read files, run scripts, or make a viewer or the
//! conversion to PDF work for minutes.

use camgen_kernel::refusal::Refusal;
use roxmltree::{Document, Node};

/// Elements of SVG that draw at a cost in proportion to their text.
const ELEMENTS: [&str; 21] = [
    "svg",
    "g",
    "path",
    "rect",
    "circle",
    "ellipse",
    "line",
    "polyline",
    "polygon",
    "text",
    "tspan",
    "title",
    "desc",
    "defs",
    "style",
    "metadata",
    "linearGradient",
    "radialGradient",
    "stop",
    "clipPath",
    "image",
];
const SVG: &str = "http://www.w3.org/2000/svg";
/// Images that may be embedded.
const IMAGES: [&str; 3] = ["data:image/png;base64,", "data:image/jpeg;base64,", "data:image/jpg;base64,"];
/// Elements inside each other at the most.
const DEEPEST: usize = 64;
/// Where a drawing is put in.
const DRAWING: &str = "{{drawing}}";
/// Largest sheet, bytes.
pub(super) const LARGEST_SHEET: usize = 20 << 20;

/// That a template, without its comments, draws the drawing once and nothing that reads files or has no bound.
pub(super) fn check(template: &str) -> Result<(), Refusal> {
    let of_template = |why: Refusal| why.context("the template cannot be used");
    let document = Document::parse(template)
        .map_err(|error| of_template(Refusal::of(error).remedy("give a well-formed SVG without DOCTYPE")))?;
    let place = |node: Node<'_, '_>| format!("line {}", document.text_pos_at(node.range().start).row);
    match template.matches(DRAWING).count() {
        0 => {
            return Err(Refusal::new(format!("the template has no placeholder {DRAWING}, so nothing would be drawn")));
        }
        1 => {}
        more => {
            return Err(
                Refusal::new(format!("the template has the placeholder {DRAWING} {more} times")).remedy("give it once")
            );
        }
    }
    for node in document.descendants() {
        if node.is_text() && node.text().is_some_and(|text| text.contains(DRAWING)) {
            let holds = node.parent().is_some_and(|parent| ["svg", "g"].contains(&parent.tag_name().name()));
            if !holds {
                return Err(of_template(
                    Refusal::new(format!("{DRAWING} stands in an element that does not draw"))
                        .at(place(node))
                        .remedy("put it into <svg> or <g>"),
                ));
            }
        }
        if node.is_pi() {
            return Err(of_template(
                Refusal::new("a processing instruction can name a file").at(place(node)).remedy("leave it out"),
            ));
        }
        if node.is_element() {
            element(node).map_err(|why| of_template(why.at(place(node))))?;
        }
    }
    let drawn =
        document.descendants().any(|node| node.text().is_some_and(|text| node.is_text() && text.contains(DRAWING)));
    if !drawn {
        return Err(of_template(
            Refusal::new(format!("{DRAWING} is not the content of an element")).remedy("put it into <svg> or <g>"),
        ));
    }
    Ok(())
}

/// That an element is one of those that have a bound; elements of other namespaces are not drawn.
fn element(node: Node<'_, '_>) -> Result<(), Refusal> {
    let name = node.tag_name().name();
    if node.ancestors().count() > DEEPEST {
        return Err(Refusal::new(format!("<{name}> is more than {DEEPEST} elements deep")));
    }
    if node.tag_name().namespace().is_some_and(|space| space != SVG) {
        return Ok(());
    }
    if !ELEMENTS.contains(&name) {
        return Err(
            Refusal::new(format!("a template may not have <{name}>")).remedy(format!("use {}", ELEMENTS.join(", ")))
        );
    }
    for attribute in node.attributes() {
        let (key, value) = (attribute.name(), attribute.value());
        if key.to_ascii_lowercase().starts_with("on") {
            return Err(Refusal::new(format!("`{key}` runs a script")).remedy("leave it out"));
        }
        if key == "href" {
            reference(name, value)?;
        }
        if ["filter", "mask"].contains(&key) {
            return Err(Refusal::new(format!("a {key} has no bound")).remedy("leave it out"));
        }
        if key == "clip-path" || value.contains("clip-path") {
            let nested = node.ancestors().any(|outer| outer.tag_name().name() == "clipPath");
            if nested {
                return Err(Refusal::new("a clip path inside a clip path has no bound").remedy("clip once"));
            }
        }
        // The d of a path and the points of a polygon are numbers.
        let is_data = ["d", "points"].contains(&key) || (name == "image" && key == "href");
        if !is_data {
            style(value)?;
        }
    }
    if name == "style" {
        let text: String =
            node.descendants().filter_map(|part| if part.is_text() { part.text() } else { None }).collect();
        style(&text)?;
        if text.contains("clip-path") {
            return Err(Refusal::new("a style may not clip").remedy("give the attribute clip-path to one element"));
        }
    }
    Ok(())
}

/// That a reference stays in the file: an image that is embedded, or an element of the template.
fn reference(element: &str, value: &str) -> Result<(), Refusal> {
    let fits = if element == "image" {
        IMAGES.iter().any(|start| value.trim_start().starts_with(start))
    } else {
        value.starts_with('#')
    };
    if fits {
        return Ok(());
    }
    let shown: String = value.chars().take(60).collect();
    Err(Refusal::new(format!("<{element}> refers to `{shown}`, which is not in the template"))
        .remedy("embed an image as data:image/png;base64,… or data:image/jpeg;base64,…"))
}

/// That a style, or the value of an attribute, refers to nothing outside of the file and to no filter or mask.
fn style(text: &str) -> Result<(), Refusal> {
    let lower = text.to_ascii_lowercase();
    let close: String = without_css_comments(&lower).split_whitespace().collect();
    if let Some(word) = ["@import", "filter:", "mask:", "mask-image", "expression(", "javascript:"]
        .iter()
        .find(|word| close.contains(**word))
    {
        return Err(Refusal::new(format!("`{word}` is not allowed in a template")).remedy("leave it out"));
    }
    // An escape can spell any of these words.
    if close.contains('\\') {
        return Err(
            Refusal::new("a backslash is not allowed in the style of a template").remedy("write the word in full")
        );
    }
    let outside = close.split("url(").skip(1).any(|target| !target.trim_start_matches(['"', '\'']).starts_with('#'));
    if outside {
        return Err(Refusal::new("url(…) refers to something that is not in the template").remedy("leave it out"));
    }
    Ok(())
}

fn without_css_comments(text: &str) -> String {
    let mut parts = text.split("/*");
    let first = parts.next().unwrap_or_default().to_owned();
    first + &parts.filter_map(|part| part.split_once("*/")).map(|(_, behind)| behind).collect::<String>()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(inside: &str) -> Result<(), Refusal> {
        check(&format!("<svg xmlns=\"{SVG}\" xmlns:xlink=\"http://www.w3.org/1999/xlink\">{inside}{DRAWING}</svg>"))
    }

    #[test]
    fn a_company_s_frame_is_allowed() {
        for inside in [
            "<defs><linearGradient id=\"a\"><stop offset=\"0\"/></linearGradient></defs><rect fill=\"url(#a)\"/>",
            "<clipPath id=\"c\"><path d=\"M0 0h9v9z\"/></clipPath><g clip-path=\"url(#c)\"><circle r=\"4\"/></g>",
            "<image href=\"data:image/png;base64,iVBORw0KGgo=\"/>",
            "<style><![CDATA[.a { fill: none }]]></style><text class=\"a\">Drawn {{title}}</text>",
            "<x:namedview xmlns:x=\"http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd\" pagecolor=\"#fff\"/>",
        ] {
            with(inside).unwrap_or_else(|why| panic!("{inside}: {why}"));
        }
    }

    #[test]
    fn what_reads_files_or_has_no_bound_is_refused_at_its_line() {
        for (inside, part) in [
            ("<image href=\"/etc/passwd\"/>", "/etc/passwd"),
            ("<image xlink:href=\"/dev/zero\"/>", "/dev/zero"),
            ("<image xlink:href=\"file:///etc/passwd\"/>", "not in the template"),
            ("<image href=\"data:image/svg+xml;base64,PHN2Zy8+\"/>", "image/svg"),
            ("<filter id=\"f\"/>", "<filter>"),
            ("<mask id=\"m\"/>", "<mask>"),
            ("<pattern id=\"p\"/>", "<pattern>"),
            ("<use href=\"#a\"/>", "<use>"),
            ("<script>1</script>", "<script>"),
            ("<foreignObject/>", "<foreignObject>"),
            ("<rect filter=\"blur(1000)\"/>", "filter"),
            ("<rect style=\"fil\\74 er: blur(9)\"/>", "backslash"),
            ("<style>.a { filter/**/ : blur(9px) }</style>", "filter:"),
            ("<?xml-stylesheet href=\"x.css\"?>", "processing"),
            ("<rect onclick=\"go()\"/>", "script"),
            ("<rect style=\"fill: url( 'http://x/y#a')\"/>", "url"),
            ("<rect style=\"filter : url(#a)\"/>", "filter:"),
            ("<style>@import 'x.css';</style>", "@import"),
            ("<style>.a { clip-path: url(#c) }</style>", "clip"),
            ("<clipPath id=\"c\"><rect clip-path=\"url(#c)\"/></clipPath>", "inside a clip path"),
            ("<text>", "well-formed"),
            (DRAWING, "2 times"),
        ] {
            let why = with(inside).expect_err(inside).to_string();
            assert!(why.contains(part), "{inside}: {why}");
        }
        let deep = [vec!["<g>"; 70].concat(), vec!["</g>"; 70].concat()].concat();
        assert!(with(&deep).expect_err("deep").to_string().contains("deep"));
        let entity = format!("<!DOCTYPE svg [<!ENTITY a \"aaaa\">]><svg xmlns=\"{SVG}\">&a;{DRAWING}</svg>");
        assert!(check(&entity).is_err());
        for elsewhere in ["<svg title=\"{{drawing}}\"/>", "<svg><style>{{drawing}}</style></svg>"] {
            let template = elsewhere.replacen("<svg", &format!("<svg xmlns=\"{SVG}\""), 1);
            assert!(check(&template).expect_err(elsewhere).to_string().contains("put it into"), "{elsewhere}");
        }
        let third = check(&format!("<svg xmlns=\"{SVG}\">\n\n<use/>{DRAWING}</svg>")).expect_err("no use").to_string();
        assert!(third.contains("line 3"), "{third}");
    }
}

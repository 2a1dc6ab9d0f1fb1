//! The sheets as PDF: the SVG of each on a page of its size, with the font in the file.

use super::{AnalysisFormat, FormatSelection, Rendering, View, diagram, fits_all, svg};
use crate::report::sheet::Sheet;
use crate::report::sheet::font::FONT;
use camgen_kernel::refusal::Refusal;
use krilla::Document;
use krilla::geom::Size;
use krilla::metadata::Metadata;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};
use std::sync::Arc;

/// All sheets of a cam, for printing.
pub const FORMAT: View = View {
    name: "pdf",
    when: FormatSelection::Asked,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".pdf".into()],
    write: |cam: &Rendering<'_>| {
        let count = if diagram::fits(cam.body) { 3 } else { 2 };
        let number = |index: u32| format!("{index}/{count}");
        let mut sheets = vec![svg::drawing(cam, &number(1))?, svg::review(cam, &number(2))?];
        sheets.extend(diagram::numbered(cam, &number(3))?);
        Ok(vec![write_pages(&sheets, cam.template)?])
    },
    of_analysis: Some(AnalysisFormat {
        endings: |analysis| analysis.picture.endings().iter().map(|ending| format!("{ending}.pdf")).collect(),
        write: |account| {
            let sheets = account.analysis.sheets(&account.report.mark());
            sheets.iter().map(|(_, sheet)| write(sheet, account.template)).collect()
        },
    }),
};

/// Points of PDF in a millimetre.
const POINTS: f64 = 72.0 / 25.4;

/// Pixels of all images of a template at the most: they are unpacked to be written.
const MOST_PIXELS: f32 = 50e6;

fn pixels(group: &usvg::Group) -> f32 {
    let of = |node: &usvg::Node| match node {
        usvg::Node::Image(image) => image.size().width() * image.size().height(),
        usvg::Node::Group(group) => pixels(group),
        _ => 0.0,
    };
    group.children().iter().map(of).sum()
}

/// A sheet as PDF.
///
/// # Errors
/// [`Refusal`] when a placeholder of the template is missing or unknown, or what it gives cannot be converted.
pub fn write(sheet: &Sheet, template: &str) -> Result<Vec<u8>, Refusal> {
    write_pages(std::slice::from_ref(sheet), template)
}

/// Sheets as PDF, a page each; the title of the file is that of the first.
///
/// # Errors
/// As [`write()`].
pub fn write_pages(sheets: &[Sheet], template: &str) -> Result<Vec<u8>, Refusal> {
    let mut document = Document::new();
    let title = sheets.first().map(|sheet| sheet.title.clone()).unwrap_or_default();
    document.set_metadata(Metadata::new().title(title));
    for sheet in sheets {
        add_page(&mut document, sheet, template)?;
    }
    document.finish().map_err(|error| Refusal::new(format!("the PDF cannot be written: {error:?}")))
}

fn add_page(document: &mut Document, sheet: &Sheet, template: &str) -> Result<(), Refusal> {
    let text = svg::fill(sheet, template, false, "")?;
    let mut fonts = usvg::fontdb::Database::new();
    fonts.load_font_data(FONT.to_vec());
    // Nothing outside of the sheet is read.
    let images = usvg::ImageHrefResolver { resolve_string: Box::new(|_, _| None), ..Default::default() };
    let options = usvg::Options { fontdb: Arc::new(fonts), image_href_resolver: images, ..Default::default() };
    let tree = usvg::Tree::from_data(&text, &options).map_err(|error| {
        Refusal::of(error).context("the sheet in this template is not an SVG that can be converted to PDF")
    })?;
    if pixels(tree.root()) > MOST_PIXELS {
        return Err(
            Refusal::new("the images of the template have more than 50 million pixels").remedy("embed smaller ones")
        );
    }
    let size = sheet.extents.size() * POINTS;
    #[expect(clippy::cast_possible_truncation, reason = "a size of paper")]
    let size = Size::from_wh(size.x as f32, size.y as f32);
    let size = size.ok_or_else(|| Refusal::new("the PDF cannot be written: the page has no size"))?;
    let mut page = document.start_page_with(PageSettings::new(size));
    let mut surface = page.surface();
    surface.draw_svg(&tree, size, SvgSettings::default());
    surface.finish();
    page.finish();
    Ok(())
}

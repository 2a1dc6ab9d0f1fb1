//! The review sheet as PDF: the SVG of the sheet on a page of its size, with the font in the file.

use super::{Format, FormatError, OfAnalysis, Rendering, When, fits_all, svg};
use crate::report::plot;
use crate::report::sheet::Sheet;
use crate::report::sheet::font::FONT;
use krilla::Document;
use krilla::geom::Size;
use krilla::metadata::Metadata;
use krilla::page::PageSettings;
use krilla_svg::{SurfaceExt, SvgSettings};
use std::sync::Arc;

/// The review sheet, for printing.
pub const FORMAT: Format = Format {
    name: "pdf",
    when: When::Asked,
    flank: false,
    unfit: fits_all,
    endings: |_| vec![".pdf".into()],
    write: |cam: &Rendering<'_>| Ok(vec![write(&svg::sheet(cam)?, cam.template)?]),
    of_analysis: Some(OfAnalysis {
        endings: |_| vec![".pdf".into()],
        write: |account| {
            let sheet = plot::sheet(&account.analysis.plot, &account.report.mark());
            Ok(vec![write(&sheet, account.template)?])
        },
    }),
};

/// Points of PDF in a millimetre.
const POINTS: f64 = 72.0 / 25.4;

/// Why there is no PDF.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PdfError {
    /// The sheet, in the template given, is no SVG.
    #[error("the sheet in this template is no SVG that a PDF can be made of: {0}")]
    NoSvg(String),
    /// The page cannot be written.
    #[error("the PDF cannot be written: {0}")]
    NotWritten(String),
}

/// A sheet as PDF.
///
/// # Errors
/// [`FormatError::Template`] and [`FormatError::Pdf`].
pub fn write(sheet: &Sheet, template: &str) -> Result<Vec<u8>, FormatError> {
    let text = svg::fill(sheet, template, false, "")?;
    let mut fonts = usvg::fontdb::Database::new();
    fonts.load_font_data(FONT.to_vec());
    let options = usvg::Options { fontdb: Arc::new(fonts), ..Default::default() };
    let tree = usvg::Tree::from_data(&text, &options).map_err(|error| PdfError::NoSvg(error.to_string()))?;
    let size = sheet.extents.size() * POINTS;
    #[expect(clippy::cast_possible_truncation, reason = "a size of paper")]
    let size = Size::from_wh(size.x as f32, size.y as f32);
    let size = size.ok_or_else(|| PdfError::NotWritten("the page has no size".into()))?;
    let mut document = Document::new();
    document.set_metadata(Metadata::new().title(sheet.title.clone()));
    let mut page = document.start_page_with(PageSettings::new(size));
    let mut surface = page.surface();
    surface.draw_svg(&tree, size, SvgSettings::default());
    surface.finish();
    page.finish();
    document.finish().map_err(|error| PdfError::NotWritten(format!("{error:?}")).into())
}

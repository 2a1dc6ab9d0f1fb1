//! The motion diagram as SVG: a sheet of its own.

use super::{FormatSelection, Rendering, View, svg};
use crate::body::Body;
use crate::body::motion_diagram::motion_diagram;
use crate::report::motion_diagram;
use crate::report::sheet::Sheet;
use camgen_kernel::refusal::Refusal;

/// The motion diagram.
pub const FORMAT: View = View {
    name: "diagram",
    when: FormatSelection::Asked,
    flank: false,
    unfit,
    endings: |_| vec!["-diagram.svg".into()],
    write: |cam| match sheet(cam)? {
        Some(sheet) => Ok(vec![svg::fill(&sheet, cam.template, true, &cam.report.mark())?]),
        None => Err(Refusal::new("the motion diagram is of a cam with one motion")),
    },
    of_analysis: None,
};

/// Whether a body has a motion diagram.
#[cfg(feature = "pdf")]
pub(super) fn fits(body: &dyn Body) -> bool {
    unfit(body).is_none()
}

/// A cam whose sections differ has a motion for each of them.
fn unfit(body: &dyn Body) -> Option<&'static str> {
    let moves = || body.follower_motion().is_some() && body.row_on(0, 0.0).is_some();
    (!moves()).then_some("its sections have motions of their own")
}

/// The motion diagram of a proven cam; `None` of one that has no single motion.
///
/// # Errors
/// [`Refusal`] when a curve of its drawing cannot be drawn, from which its title block is.
pub fn sheet(cam: &Rendering<'_>) -> Result<Option<Sheet>, Refusal> {
    numbered(cam, "1/1")
}

/// The motion diagram as one of several sheets, such as "3/3".
pub(super) fn numbered(cam: &Rendering<'_>, number: &str) -> Result<Option<Sheet>, Refusal> {
    let outline = cam.outlines.first().map(|outline| &outline.contour);
    let Some(diagram) = motion_diagram(cam.body, outline) else { return Ok(None) };
    let facts = cam.body.view(cam.drawn).map_err(Refusal::of)?.facts;
    Ok(Some(motion_diagram::sheet(
        &diagram,
        cam.report,
        &facts,
        &svg::deviation_words(&cam.fit, cam.report.units),
        number,
    )))
}

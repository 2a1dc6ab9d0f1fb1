//! The files to cut from in memory, and what is read in their bytes.

use super::proof::{self, JOIN};
use super::write::{DxfForm, cutter_path, marked};
use crate::body::Drawn;
use crate::tool_files::tool_file::{DrawnCam, ProvedFile};
use crate::verify::{WrittenOutline, WrittenPath, WrittenSwept};
use crate::write::step;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::outline::{Outline, OutlineError};
use camgen_kernel::refusal::Refusal;

/// The files of a drawing as they were read back. There is no other way to one than [`ProvedCuts::of_drawing`].
#[derive(Debug)]
pub struct ProvedCuts {
    cuts: Vec<Vec<u8>>,
    outlines: Vec<WrittenOutline>,
    swept: Option<WrittenSwept>,
    paths: Vec<Result<Vec<u8>, Refusal>>,
    written_paths: Vec<WrittenPath>,
}

impl ProvedCuts {
    /// Writes the files of a drawing to memory and reads them back.
    ///
    /// # Errors
    /// [`Refusal`] when the bytes do not hold what was drawn.
    pub fn of_drawing(cam: &DrawnCam<'_>, form: DxfForm, mark: &str) -> Result<Self, Refusal> {
        let (mut cuts, mut outlines) = (Vec::new(), Vec::new());
        for part in cam.drawn.iter().flat_map(|drawn| &drawn.parts) {
            // The proof is of the bytes that would be cut, not of the drawing they were made from.
            let written = proof::write_marked(part, form, mark)?;
            cuts.push(written.bytes);
            for contour in written.outlines {
                let (cut, others) = (outlines.len(), written.others.clone());
                outlines.push(WrittenOutline { cut, z: part.z, contour, others });
            }
        }
        let tolerance_mm = MILLIMETRES * cam.request.fit.tolerance;
        let mut swept = None;
        for drawing in cam.drawn.iter().filter_map(|drawn| drawn.swept.as_deref()) {
            let solid = step::write(&drawing.solid, "", None);
            let mut read = WrittenSwept::of_solid(cam.body, &solid, tolerance_mm)?;
            if !drawing.developed.is_empty() {
                let unrolled = proof::developed(&drawing.developed, form, mark)?;
                read = read.with(WrittenSwept::of_unrolled(cam.body, &unrolled, JOIN)?);
                cuts.push(unrolled);
            }
            swept = Some(read);
        }
        let (mut paths, mut written_paths) = (Vec::new(), Vec::new());
        for (cut, path) in cam.drawn.iter().copied().flat_map(Drawn::cutter_paths).enumerate() {
            written_paths.extend(read_path(cam, cut, path, form));
            paths.push(path.as_ref().map(|outline| cutter_path(outline, form)).map_err(|error| error.clone().into()));
        }
        Ok(Self { cuts, outlines, swept, paths, written_paths })
    }

    /// The bytes of the files to cut parts from.
    #[must_use]
    pub fn cuts(&self) -> &[Vec<u8>] {
        &self.cuts
    }

    /// The outlines as another program would find them in these files.
    #[must_use]
    pub fn outlines(&self) -> &[WrittenOutline] {
        &self.outlines
    }

    /// What is read of flanks that a roller sweeps in space.
    #[must_use]
    pub fn swept(&self) -> Option<&WrittenSwept> {
        self.swept.as_ref()
    }

    /// The paths of a cutter as another program would find them.
    #[must_use]
    pub fn written_paths(&self) -> &[WrittenPath] {
        &self.written_paths
    }

    /// The files of the parts, after a comment.
    pub(super) fn cuts_after(&self, endings: &[String], comment: &str) -> Vec<ProvedFile> {
        let named = endings.iter().zip(&self.cuts);
        named.map(|(ending, bytes)| ProvedFile::read_back(ending.clone(), marked(bytes.clone(), comment))).collect()
    }

    /// The files of the paths, after a comment.
    pub(super) fn paths_after(&self, endings: &[String], comment: &str) -> Result<Vec<ProvedFile>, Refusal> {
        let mut files = Vec::with_capacity(self.paths.len());
        for (ending, path) in endings.iter().zip(&self.paths) {
            files.push(ProvedFile::read_back(ending.clone(), marked(path.clone()?, comment)));
        }
        Ok(files)
    }
}

/// A path as another program would read it; `None` without a cutter.
fn read_path(
    cam: &DrawnCam<'_>,
    cut: usize,
    path: &Result<Outline, OutlineError>,
    form: DxfForm,
) -> Option<WrittenPath> {
    let (middle, _) = cam.request.fit.band();
    let read = match path {
        Ok(outline) => proof::cutter_path(outline, form).map_err(|error| error.to_string()),
        Err(error) => Err(error.to_string()),
    };
    let (contour, lead_ins) = match read {
        Ok((contour, lead_ins)) => (Ok(contour), lead_ins),
        Err(why) => (Err(why), Vec::new()),
    };
    let radius = MILLIMETRES * cam.request.cutter_radius?;
    Some(WrittenPath { cut, radius, middle: MILLIMETRES * middle, contour, lead_ins })
}

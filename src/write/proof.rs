//! The cut file in memory, as it would be on disk, and the outline read back from its bytes.

use super::dxf::{self, Version};
use crate::body::{Layer, Part};
use crate::geometry::contour::Contour;
use crate::profile::outline::Outline;
use crate::reading::{self, Chain, ReadError};

/// Ends nearer than this are one, mm: far above twelve decimals, far below any segment.
const JOIN: f64 = 1e-9;

/// A written cut file.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// The outline another program would find in them.
    pub outline: Contour,
    /// What else it would find to be cut.
    pub beside: Vec<Chain>,
}

/// The bytes do not hold the outline that was put in: a fault of camgen.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ProofError {
    /// The file cannot be read.
    #[error("the DXF file as written cannot be read back: {0}")]
    Unreadable(#[from] ReadError),
    /// It does not hold one closed outline.
    #[error("the DXF file as written does not hold one closed outline; please report this")]
    NotOneOutline,
}

/// Writes the cut drawing to memory and reads its outline back.
///
/// # Errors
/// [`ProofError`] when what was written is not what was drawn.
pub fn write(part: &Part, version: Version) -> Result<Written, ProofError> {
    let bytes = dxf::write(&part.entities(), version);
    let reading = reading::read(&bytes, JOIN)?;
    let clean = reading.duplicates.is_empty() && reading.points.is_empty() && reading.unreadable.is_empty();
    match reading.chains.as_slice() {
        [chain] if chain.closed && clean => Ok(Written { bytes, outline: chain.contour(), beside: reading.beside }),
        _ => Err(ProofError::NotOneOutline),
    }
}

/// The path of a cutter as another program would find it in its file.
///
/// # Errors
/// [`ProofError`] when what was written is not what was drawn.
pub fn cutter_path(outline: &Outline, version: Version) -> Result<Contour, ProofError> {
    let bytes = dxf::cutter_path(outline, version);
    // The reader takes the layer of the outline for what is cut.
    let text = String::from_utf8_lossy(&bytes).replace(Layer::CutterPath.name(), Layer::CamProfile.name());
    let reading = reading::read(text.as_bytes(), JOIN)?;
    match reading.chains.as_slice() {
        [chain] if chain.closed && reading.duplicates.is_empty() && reading.points.is_empty() => Ok(chain.contour()),
        _ => Err(ProofError::NotOneOutline),
    }
}

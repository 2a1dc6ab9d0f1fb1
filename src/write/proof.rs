//! The cut file in memory, as it would be on disk, and the outline read back from its bytes.

use super::dxf::{self, Version};
use crate::body::Part;
use crate::geometry::contour::Contour;
use crate::reading::{self, ReadError};

/// Ends nearer than this are one, mm: far above twelve decimals, far below any segment.
const JOIN: f64 = 1e-9;

/// A written cut file.
#[derive(Debug, Clone, PartialEq)]
pub struct Written {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// The outline another program would find in them.
    pub outline: Contour,
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
        [chain] if chain.closed && clean => Ok(Written { bytes, outline: chain.contour() }),
        _ => Err(ProofError::NotOneOutline),
    }
}

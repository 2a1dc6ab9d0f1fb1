//! The flank of a body whose sections differ, as it is drawn.

use camgen_kernel::geometry::solid::SplineSurface;
use camgen_kernel::refusal::{Refusal, WorkBound};

/// The flank with its proof.
#[derive(Debug, Clone, PartialEq)]
pub struct Flank {
    /// Patches in the order of the drawing's polar angle, u the angle (rad), v the place along the axis (mm).
    pub patches: Vec<SplineSurface>,
    /// Largest distance from the exact surface at the middles of the spans, mm.
    pub deviation: f64,
    /// Volume within the flank, mm³.
    pub volume: f64,
}

/// Spline cells of the flanks of a barrel or globoid; each is compared with the exact flank at 64 points or more.
const CELLS: WorkBound = WorkBound { what: "spline cells of the flanks", most: 12_000 };

/// Refuses more cells than a command can compare in its time.
///
/// # Errors
/// [`Refusal`] with the number and the bound.
pub(super) fn refuse_too_many(patches: &[SplineSurface]) -> Result<(), Refusal> {
    let spans = |knots: &[f64]| knots.windows(2).filter(|pair| pair[1] > pair[0]).count();
    let cells = patches.iter().map(|patch| spans(&patch.u) * spans(&patch.v)).sum();
    CELLS.allow(cells).map_err(|refusal| refusal.remedy("give a coarser --tolerance"))
}

//! The flank of a body whose sections differ, as it is drawn.

use camgen_kernel::geometry::solid::SplineSurface;

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

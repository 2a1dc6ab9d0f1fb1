//! What judging a program for a machine gives.

use nalgebra::Vector2;

/// A program that is not one of the cam.
pub(super) struct ProgramFault {
    pub(super) why: String,
    /// mm.
    pub(super) value: f64,
    pub(super) at: Option<Vector2<f64>>,
}

impl ProgramFault {
    pub(super) fn new(why: impl Into<String>) -> Self {
        Self { why: why.into(), value: f64::INFINITY, at: None }
    }
}

/// A program that was judged.
pub(super) struct JudgedProgram {
    /// Largest distance, mm.
    pub(super) value: f64,
    pub(super) at: Vector2<f64>,
    pub(super) note: String,
}

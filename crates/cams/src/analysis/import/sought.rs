//! What an import may find.

use camgen_kernel::motion::laws::Law;

/// What may be found.
#[derive(Debug, Clone)]
pub(super) struct Sought<'a> {
    pub(super) laws: &'a [&'static Law],
    /// A stretch that no law follows becomes a spline.
    pub(super) spline: bool,
    /// m or rad.
    pub(super) deviation: f64,
    /// The angle of the cam is not known.
    pub(super) any_turn: bool,
    /// Positions count from the lowest one.
    pub(super) from_lowest: bool,
}

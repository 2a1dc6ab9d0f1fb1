//! What readers of a motion return in the place of a value that is at fault.

/// Stands for a fault that has been reported already.
pub(super) struct FaultReported;

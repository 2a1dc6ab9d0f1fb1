//! The motions of the cams of a press.

pub mod equation_18;
mod raised;
mod reversal;
mod transition;

pub use equation_18::WedgeMotion;
pub use raised::RaiseSeries;
pub use reversal::{AirState, Reversal, ReversalLaw, ReversalState};
pub use transition::Transition;

use camgen_kernel::motion::{Jet, Motion, NamedStretch, Piece, own_pieces};

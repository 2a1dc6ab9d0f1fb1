//! Design to drawing.

pub mod arcs;
pub mod outline;

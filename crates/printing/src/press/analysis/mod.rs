//! The analyses of a press.

mod at_speeds;
pub mod drive;
pub mod plain;
pub mod regimes;
pub mod spring;
pub mod trade;
mod trial_bottoms;

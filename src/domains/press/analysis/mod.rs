//! The analyses of a press.

pub mod drive;
pub mod plain;
pub mod regimes;
pub mod spring;
pub mod trade;

//! camgen: cam profiles a CNC shop can cut.
#![forbid(unsafe_code)]

pub mod buffer;
pub mod cam;
pub mod contour;
pub mod drawing;
pub mod follower;
pub mod law;
pub mod machine;
pub mod numeric;
pub mod units;

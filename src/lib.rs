//! camgen: cam profiles a CNC shop can cut.
#![forbid(unsafe_code)]

pub mod units;

pub mod numeric;

pub mod document;

pub mod geometry;

pub mod buffer;

pub mod motion;

pub mod follower;

pub mod machine;

pub mod profile;

pub mod report;

pub mod table;

pub mod load;

pub mod body;

pub mod reading;

pub mod verify;

pub mod write;

pub mod pipeline;

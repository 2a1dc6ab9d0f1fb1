//! camgen: cam profiles a CNC shop can cut.
//!
//! The library is a pipeline, and the modules below are its rooms in order: a room knows only those before it.
//!
//! ```text
//! units → document → numeric → buffer → law → follower → machine → cam → contour → reading → checks → drawing → output
//! ```
//!
//! Two doors: [`machine::Machine`] in, [`drawing`] out. Numbers are SI and radians until `drawing`, millimetres from
//! there on. The library never prints, never exits, and does not panic on input.
//!
//! ```
//! use camgen::cam::rotary::Rotary;
//! use camgen::drawing;
//! use camgen::machine::Machine;
//!
//! let (machine, _) = Machine::load("dpi", &[])?;
//! let cam = Rotary::solve(&machine, 35.0)?;
//! let part = drawing::part(&cam, 5e-6)?;
//! assert!(part.outline.deviation <= 0.005);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![forbid(unsafe_code)]

pub mod units;

pub mod document;

pub mod numeric;

pub mod buffer;

pub mod law;

pub mod follower;

pub mod machine;

pub mod cam;

pub mod contour;

pub mod reading;

pub mod checks;

pub mod drawing;

pub mod output;

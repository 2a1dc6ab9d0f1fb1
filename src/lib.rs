//! camgen: cam profiles a CNC shop can cut.
//!
//! A cam passes through one pipeline; each step is a method of the result before it. Nothing can be written that was not
//! proved: the cut file is written to memory, read back from its bytes, and the follower is rolled on what was read.
//!
//! ```text
//! Spec ─ solve ─► Cam ─ draw(tolerance) ─► Drawing ─ prove ─► Proven ─ files ─► FileSet ─ commit ─► files, Report
//! ```
//!
//! The disc cam of the embedded press for 35 rpm, in memory:
//!
//! ```
//! use camgen::{Machine, Spec, Writing};
//!
//! let (machine, name) = Machine::load("dpi", &[])?;
//! let cam = Spec::rotary(machine, 35.0).solve()?;
//! let proven = cam.draw(5e-6)?.prove()?;
//! assert!(proven.passed());
//! let files = proven.files(&Writing::to("output", name).formats(&["dxf", "csv"]))?;
//! assert!(files.bytes(".dxf").is_some_and(|dxf| dxf.ends_with(b"EOF\n")));
//! // `files.commit()?` would write them, all or none.
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A cam without a press, from a motion of your own: implement [`Motion`], or take a program of segments, and put the rest
//! together with [`Spec::builder`]:
//!
//! ```
//! use camgen::{Program, Quantity, Spec, law};
//! use std::f64::consts::PI;
//!
//! // Up 20 mm in 90°, rest for 30°, down in 120°, rest.
//! let (up, down) = (law("cycloidal"), law("3-4-5"));
//! let motion = Program::new(
//!     Quantity::Length,
//!     0.0,
//!     &[(up, PI / 2.0, 0.02), (None, PI / 6.0, 0.0), (down, 2.0 * PI / 3.0, 0.0), (None, 2.0 * PI / 3.0, 0.0)],
//! );
//! let cam = Spec::builder("lifter").roller(0.012).bore_radius(0.010).motion(motion)?.solve()?;
//! assert!(cam.draw(5e-6)?.prove()?.passed());
//! # Ok::<(), camgen::Error>(())
//! ```
//!
//! Numbers are SI and radians; what is drawn is in millimetres, and every name of a value that is not SI ends in its unit.
//! The library never prints, never exits, and does not panic on input.
//!
//! The items on this page are the public interface. The modules behind them are described in ARCHITECTURE.md; they are
//! reachable, for tests, but may change with any version.
#![forbid(unsafe_code)]

#[doc(hidden)]
pub mod units;

#[doc(hidden)]
pub mod numeric;

#[doc(hidden)]
pub mod document;

#[doc(hidden)]
pub mod geometry;

#[doc(hidden)]
pub mod linkage;

#[doc(hidden)]
pub mod shaft;

#[doc(hidden)]
pub mod brake;

#[doc(hidden)]
pub mod buffer;

#[doc(hidden)]
pub mod motion;

#[doc(hidden)]
pub mod follower;

#[doc(hidden)]
pub mod machine;

#[doc(hidden)]
pub mod profile;

#[doc(hidden)]
pub mod report;

#[doc(hidden)]
pub mod table;

#[doc(hidden)]
pub mod load;

#[doc(hidden)]
pub mod body;

#[doc(hidden)]
pub mod analysis;

#[doc(hidden)]
pub mod reading;

#[doc(hidden)]
pub mod verify;

#[doc(hidden)]
pub mod write;

#[doc(hidden)]
pub mod pipeline;

#[doc(inline)]
pub use analysis::Analysis;
#[doc(inline)]
pub use body::{Drawn, Part, Request};
#[doc(inline)]
pub use follower::{Element, Follower, Touch};
#[doc(inline)]
pub use geometry::CurvePoint;
#[doc(inline)]
pub use geometry::contour::{Contour, Vertex};
#[doc(inline)]
pub use machine::{Machine, MachineError};
#[doc(inline)]
pub use motion::equation_18::{ExactOn, Solver};
#[doc(inline)]
pub use motion::laws::{Law, named as law};
#[doc(inline)]
pub use motion::program::Program;
#[doc(inline)]
pub use motion::{Jet, Motion, Piece, Quantity};
#[doc(inline)]
pub use pipeline::{Builder, Cam, Drawing, Error, FileSet, Judged, Output, Proven, Spec, Writing};
#[doc(inline)]
pub use profile::outline::{Fit, Outline, Side};
#[doc(inline)]
pub use report::{Finding, Place, Report, Rolled, Section, Speeds, Told, Verdict};
#[doc(inline)]
pub use table::Table;
#[doc(inline)]
pub use write::dxf::Version;

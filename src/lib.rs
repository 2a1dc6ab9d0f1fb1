//! camgen makes profiles of cams that a CNC shop can cut. It solves a motion, finds the size of the cam, draws its outline to a tolerance,
//! and proves the cut file on its own bytes: the file is written to memory, read back, and the follower is rolled on what was read. Only
//! what was proved can be written.
//!
//! # The pipeline
//!
//! Each step is a method of the result before it.
//!
//! ```text
//! Spec ─ solve ─► Cam ─ draw(tolerance) ─► Drawing ─ prove ─► Proven ─ files ─► FileSet ─ commit ─► files, Report
//! ```
//!
//! | Step | What it is |
//! |---|---|
//! | [`Machine`] | everything that is known of the machine, every value in range: from a file, an embedded file, or [`Spec::builder`] |
//! | [`Spec`] | the cam to be made: a machine and a motion |
//! | [`Cam`] | the solved cam, exact curves; also checks files of others ([`Cam::check`]) |
//! | [`Drawing`] | its outline in arcs or splines, within a [`Request`] |
//! | [`Proven`] | what every check found ([`Proven::findings`]), the [`Report`], the [`Table`] of points |
//! | [`FileSet`] | the files in memory, written all or none |
//!
//! Each of them owns what it needs: it can be kept, returned from a function and sent to another thread.
//! Numbers are in SI units and radians. What is drawn is in millimetres, and the name of every value that is not SI ends in its unit.
//! The library never prints, never exits, and does not panic on input.
//!
//! # A cam from a machine file
//!
//! A machine file with a motion program describes a cam completely. [`Machine::load`] takes the path of a file or the name of an embedded
//! one, and overrides of its keys. `camgen init --follower NAME` writes a commented file to start from.
//!
//! ```
//! use camgen::{Machine, Spec, Writing};
//!
//! let (machine, name) = Machine::load("feeder", &["follower.roller.radius=14 mm".to_owned()])?;
//! let cam = Spec::of_program(machine, None).ok_or("the file has no motion")?.solve()?;
//! let proven = cam.draw(10e-6)?.prove()?;
//! assert!(proven.passed());
//! let files = proven.files(&Writing::to("output", name).formats(&["dxf", "csv"]))?;
//! assert!(files.bytes(".dxf").is_some_and(|dxf| dxf.ends_with(b"EOF\n")));
//! // `files.commit()?` would write them, all or none.
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A cam from code
//!
//! Take a [`Program`] of segments with [`law`]s, or implement [`Motion`], and put the rest together with [`Spec::builder`], which has a
//! method for every follower: [`roller`](Builder::roller), [`swinging_roller`](Builder::swinging_roller),
//! [`flat_face`](Builder::flat_face), [`swinging_flat_face`](Builder::swinging_flat_face), [`knife_edge`](Builder::knife_edge).
//!
//! ```
//! use camgen::{Program, Quantity, Spec, law};
//! use std::f64::consts::PI;
//!
//! // Up 20 mm in 90°, rest for 30°, down in 120°, rest.
//! let (up, down) = (Some(law("cycloidal")?), Some(law("3-4-5")?));
//! let motion = Program::new(
//!     Quantity::Length,
//!     0.0,
//!     &[(up, PI / 2.0, 0.02), (None, PI / 6.0, 0.02), (down, 2.0 * PI / 3.0, 0.0), (None, 2.0 * PI / 3.0, 0.0)],
//! )?;
//! let cam = Spec::builder("lifter").roller(0.012).bore_radius(0.010).motion(motion)?.solve()?;
//! assert!(cam.draw(5e-6)?.prove()?.passed());
//! # Ok::<(), camgen::Error>(())
//! ```
//!
//! # Checking a file
//!
//! [`Cam::check`] reads a DXF or STEP file, also one that was edited or written by another program, and rolls the follower on it. Of a file
//! that is another cam the report says what would explain it: mirrored, turned, in inches, the cam of another speed. To look into a DXF
//! file without a cam, use [`reading::read`].
//!
//! ```
//! use camgen::{Machine, Spec};
//!
//! let (machine, _) = Machine::load("valve", &[])?;
//! let cam = Spec::of_program(machine, None).ok_or("the file has no motion")?.solve()?;
//! // In place of `std::fs::read("valve.dxf")?`:
//! let dxf = cam.draw(5e-6)?.prove()?.cut_files()[0].clone();
//! assert!(cam.check(&dxf, 10e-6)?.passed());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Analyses
//!
//! An analysis is one function from a machine to an [`Analysis`]: figures, tables, curves. [`Judged`] applies the checks to it and writes
//! its files.
//!
//! | Analysis | Function |
//! |---|---|
//! | the smallest disc of a motion, and what binds it | [`analysis::size::analysis`] |
//! | every law of motion at the numbers of a design | [`analysis::laws::analysis`] |
#![cfg_attr(
    feature = "printing",
    doc = "| one cam of a press at other speeds | [`domains::press::analysis::regimes::analysis`] |"
)]
#![cfg_attr(
    feature = "printing",
    doc = "| buffers of a press on springs instead of a cam | [`domains::press::analysis::spring::analysis`] |"
)]
#![cfg_attr(
    feature = "printing",
    doc = "| the drive of a bed without a cam | [`domains::press::analysis::drive::analysis`] |"
)]
#![cfg_attr(feature = "printing", doc = "| the linkage that moves a bed | [`domains::linkage::analysis::analysis`] |")]
#![cfg_attr(feature = "printing", doc = "| the shaft under a cam | [`domains::shaft::analysis::analysis`] |")]
#![cfg_attr(feature = "printing", doc = "| the belt brake of a paper roll | [`domains::brake::analysis::analysis`] |")]
//!
//! ```
//! use camgen::{Judged, Machine, Writing, analysis::size};
//!
//! let (machine, name) = Machine::load("feeder", &[])?;
//! let judged = Judged::new(size::analysis(&machine, &[], None)?);
//! println!("{}", judged.report().title());
//! let files = judged.files(&Writing::to("output", name))?;
//! assert!(!files.outputs().is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
#![cfg_attr(feature = "printing", doc = include_str!("press.md"))]
//!
//! # Cams that belong together
//!
//! An [`Assembly`] is several cams that are drawn, proved and written together or not at all. [`Spec::assemble`] makes the cams that a
//! machine file describes to be made with the first one; [`Assembly::with`] adds any other.
//!
//! ```
//! use camgen::{Assembly, Machine, Spec, Writing};
//!
//! let solved = |name: &str| -> Result<_, Box<dyn std::error::Error>> {
//!     let (machine, _) = Machine::load(name, &[])?;
//!     Ok(Spec::of_program(machine, None).ok_or("no motion")?.solve()?)
//! };
//! let assembly = Assembly::from(solved("feeder")?).with("lever", solved("lever")?);
//! let files = assembly.draw(20e-6)?.prove()?.files(&Writing::to("output", "both").formats(&["dxf"]))?;
//! let names: Vec<&str> = files.outputs().iter().map(|file| file.name.as_str()).collect();
//! assert_eq!(names, ["both.dxf", "both-lever.dxf"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Features
//!
//! All are on by default. With `default-features = false` the library solves, draws, proves and writes disc cams as DXF, SVG, STEP, STL, CSV,
//! points and JSON.
//!
//! | Feature | Brings |
//! |---|---|
//! | `press`, `linkage`, `shaft`, `brake` | each the domains of printing machines, the module [`domains`]: the flat-bed press, the linkage that moves its bed, the shaft under a cam, the belt brake of a paper roll |
//! | `html` | the format `html`, a moving report, and the module `engine` |
//! | `live` | `Writing::live`: the moving report with the library in it |
//! | `pdf` | the format `pdf`, the review sheet and the motion diagram |
//! | `second-reader` | a second DXF reader that shares no code with the first also reads each cut file |
//! | `cli` | the program `camgen` |
//!
//! # Modules
//!
//! What most programs need is on this page. The modules contain the rest, and may change with any version. They are in three crates that
//! this one puts together, `camgen-kernel`, `camgen-cams` and `camgen-printing`. Each module uses only those before it:
//!
//! - numbers, units, files: [`refusal`], [`units`], [`numeric`], [`document`]
//! - curves: [`geometry`], [`motion`], [`follower`], [`profile`]
//! - what is cut: [`machine`], [`load`], [`body`], [`analysis`]
//! - what is found: [`report`], [`table`], [`check`], [`verify`]
//! - files: [`reading`], [`mod@write`], [`tool_files`]
//! - all of it together: [`pipeline`], [`mod@trade`], [`domain`], [`catalogue`], [`study`], `engine` (with the feature `html`), [`domains`]
//!
//! ARCHITECTURE.md describes them.
#![forbid(unsafe_code)]

#[doc(inline)]
pub use camgen_kernel::{document, follower, geometry, motion, numeric, profile, refusal, text, units};

#[cfg(feature = "html")]
#[doc(inline)]
pub use camgen_cams::engine;
#[doc(inline)]
pub use camgen_cams::{
    analysis, body, catalogue, check, domain, load, machine, pipeline, reading, report, study, table, tool_files,
    trade, verify, write,
};

/// The domains of printing machines. To be linked with them is to know their machines: they register themselves.
#[cfg(feature = "printing")]
#[doc(inline)]
pub use camgen_printing as domains;

#[doc(inline)]
pub use camgen_kernel::{
    Contour, CurvePoint, Element, Fit, Follower, Jet, Law, Motion, Outline, Piece, Program, Quantity, Refusal,
    SampleCurve, Side, Smooth, Touch, Vertex, law,
};
#[doc(no_inline)]
pub use nalgebra::{Vector2, Vector3};

#[doc(inline)]
pub use camgen_cams::{
    Accuracy, Analysis, ArmSide, Assembly, AssemblyDrawing, AssemblyReport, Builder, Cam, Drawing, Drawn, Error,
    ExpectedFile, FileKind, FileSet, Finding, FlatFaceFollower, GuideData, Judged, Keyway, KnifeEdgeFollower,
    LazyReport, Machine, MachineError, Material, Output, Part, Place, PlaceChoice, Proven, ProvenAssembly, Report,
    Request, Rolled, RollerFollower, Section, Spec, Speeds, SpringData, SwingingFaceFollower, SwingingRollerFollower,
    Table, Title, TriedChanges, Verdict, Version, VibrationData, Writing,
};

#[cfg(feature = "printing")]
#[doc(inline)]
pub use camgen_printing::brake::BuilderOfBrake;
#[cfg(feature = "printing")]
#[doc(inline)]
pub use camgen_printing::linkage::{BuilderOfLinkage, MachineOfLinkage};
#[cfg(feature = "printing")]
#[doc(inline)]
pub use camgen_printing::press::motion::equation_18::{ExactOn, Solver};
#[cfg(feature = "printing")]
#[doc(inline)]
pub use camgen_printing::press::{BuilderOfPress, MachineOfPress, SpecOfPress};
#[cfg(feature = "printing")]
#[doc(inline)]
pub use camgen_printing::shaft::{BuilderOfShaft, MachineOfShaft};

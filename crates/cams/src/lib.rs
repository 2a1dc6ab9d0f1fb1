//! The cams of camgen: from a machine file to bodies, drawings, proved files and studies, for every machine that has no crate of its own.
//!
//! Users take the crate `camgen`, on whose first page all of this is; the modules may change with any version. Each uses only those
//! before it: [`machine`], [`report`], [`table`], [`load`], [`check`], [`body`], [`analysis`], [`reading`], [`verify`], [`mod@write`],
//! [`tool_files`], [`pipeline`], [`mod@trade`], [`domain`], [`catalogue`], [`study`], `engine` (with the feature `html`). What comes before is in
//! [`camgen_kernel`], whose modules are here, too.
//!
//! A crate with a kind of machine that this one does not know brings [domains](domain) and [registers](register) them; what is linked with
//! it has them.
#![forbid(unsafe_code)]

pub mod machine;

pub mod report;

pub mod table;

pub mod load;

pub mod check;

pub mod body;

pub mod analysis;

pub mod reading;

pub mod verify;

pub mod write;

pub mod tool_files;

pub mod pipeline;
pub mod trade;

pub mod domain;

pub mod catalogue;
pub mod study;

#[cfg(feature = "html")]
pub mod engine;

#[doc(no_inline)]
pub use camgen_kernel::{
    Contour, CurvePoint, Element, Fit, Follower, Jet, Law, Motion, Outline, Piece, Program, Quantity, Refusal,
    SampleCurve, Side, Smooth, Touch, Vector2, Vector3, Vertex, law,
};
#[doc(no_inline)]
pub use camgen_kernel::{document, follower, geometry, motion, numeric, profile, refusal, units};

#[doc(inline)]
pub use analysis::Analysis;
#[doc(inline)]
pub use body::{Accuracy, Drawn, Part, Request};
#[doc(no_inline)]
pub use inventory;
#[doc(inline)]
pub use machine::{GuideData, Keyway, Machine, MachineError, Material, SpringData, Title, VibrationData};
#[doc(inline)]
pub use pipeline::{
    ArmSide, Assembly, AssemblyDrawing, AssemblyReport, Builder, Cam, Drawing, Error, ExpectedFile, FileKind, FileSet,
    FlatFaceFollower, Judged, KnifeEdgeFollower, Output, PlaceChoice, Proven, ProvenAssembly, RollerFollower, Spec,
    SwingingFaceFollower, SwingingRollerFollower, TriedChanges, Writing,
};
#[doc(inline)]
pub use report::{Finding, LazyReport, Place, Report, Rolled, Section, Speeds, Verdict};
#[doc(inline)]
pub use table::Table;
#[doc(inline)]
pub use tool_files::dxf::Version;

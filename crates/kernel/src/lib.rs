//! The kernel of camgen: what is known before there is a cam. Documents whose numbers have units, curves, motions, followers, and the
//! profile that a motion and a follower have together. Nothing here knows what is cut, or a file of a cam.
//!
//! Users take the crate `camgen`, on whose first page all of this is; the modules may change with any version. Each uses only those
//! before it: [`units`], [`text`](mod@text), [`refusal`], [`numeric`], [`document`], [`geometry`], [`motion`], [`follower`], [`profile`].
#![forbid(unsafe_code)]

pub mod units;

pub mod text;

pub mod refusal;

pub mod numeric;

pub mod document;

pub mod geometry;

pub mod motion;

pub mod follower;

pub mod profile;

#[doc(inline)]
pub use follower::{Element, Follower, Touch};
#[doc(inline)]
pub use geometry::CurvePoint;
#[doc(inline)]
pub use geometry::contour::{Contour, Vertex};
#[doc(inline)]
pub use motion::laws::{Law, law};
#[doc(inline)]
pub use motion::program::Program;
pub use motion::program::rows::samples::{SampleCurve, Smooth};
#[doc(inline)]
pub use motion::{Jet, Motion, Piece, Quantity};
#[doc(no_inline)]
pub use nalgebra::{Vector2, Vector3};
#[doc(inline)]
pub use profile::outline::{Fit, Outline, Side};
#[doc(inline)]
pub use refusal::Refusal;

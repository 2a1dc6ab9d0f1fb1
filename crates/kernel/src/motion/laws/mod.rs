//! Laws of motion: the shape s(x) of a segment, from 0 to 1 over x from 0 to 1, with derivatives of any order.
//!
//! A law knows x and nothing else: no angles, no followers. [`Law::solve`] makes the [`LawCurve`] for the ends of a segment: at
//! rest, moving with a constant velocity, or at a turn. A new law is a constant in the file of its family and one line in
//! [`LAWS`].

mod bernstein;
mod curve;
mod entire;
mod expression_shapes;
mod halves;
mod law;
mod list;
mod local;
pub mod optimum;
mod peaks;
pub mod polynomial;
mod ramps;
mod rest_to_rest;
mod sines;
mod spectrum;
pub mod spline;
mod task;
#[cfg(test)]
mod tests;

pub use bernstein::Values;
pub use curve::LawCurve;
pub use entire::{from_formula, from_harmonics};
pub use law::Law;
pub use list::{LAWS, LINE, law, named};
pub use peaks::LawPeaks;
pub use spectrum::AccelerationSpectrum;
pub(in crate::motion) use spectrum::residual_peak;
pub use task::{Inflection, LawError, LawTask, Parameters, SegmentEnd};

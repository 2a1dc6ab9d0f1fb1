//! Root finding, extrema, quadrature, splines, banded systems, longer numbers and differential equations.
//!
//! Knows numbers only; every method cites its source.

pub mod banded;
pub mod double;
pub mod extremum;
pub mod quadrature;
pub mod root;
pub mod series;
pub mod spline;
pub mod taylor;

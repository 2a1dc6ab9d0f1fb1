//! Root finding, extrema, quadrature, splines, banded systems, longer numbers, differential equations, threads.
//!
//! Knows numbers only; every method cites its source.

pub mod banded;
pub mod bernstein;
pub mod blocks;
pub mod chebyshev;
pub mod chebyshev_series;
pub(crate) mod decimal;
pub mod digits;
pub mod double;
pub mod extremum;
pub mod least_jerk;
pub mod least_peak;
pub mod legendre;
pub mod linear;
pub mod parallel;
pub mod power_series;
pub mod quadrature;
pub mod root;
pub mod series;
pub mod simplex;
pub mod spline;
pub mod taylor;

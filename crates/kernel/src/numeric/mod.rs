//! Root finding, extrema, quadrature, splines, banded systems, longer numbers, differential equations, threads.
//!
//! Knows numbers only; every method cites its source.

pub mod banded;
pub mod bernstein;
pub mod blocks;
pub mod bounded;
pub mod bounded_jerk;
pub mod chebyshev;
pub mod chebyshev_series;
pub mod digits;
pub mod double;
pub mod extremum;
pub mod least_jerk;
pub mod least_peak;
pub mod legendre;
pub mod linear;
pub mod outlier;
pub mod parallel;
pub mod quadrature;
pub mod root;
pub mod scatter;
pub mod series;
pub mod simplex;
pub mod spline;

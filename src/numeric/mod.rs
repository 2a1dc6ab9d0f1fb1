//! Root finding, extrema and quadrature. Knows numbers only; every method cites its source.

pub mod extremum;
pub mod quadrature;
pub mod root;

//! The values of a law at a place.

/// s, s', s'', s''' at x.
pub type Values = [f64; 4];

//! The ranges of a machine file, SI: what lies beyond is a slip of the pen, not a machine.

/// Longest length, m: a cam of a kilometre.
pub const LONGEST: f64 = 1e3;
/// Heaviest mass, kg.
pub const HEAVIEST: f64 = 1e7;
/// Highest pressure, Pa.
pub const HIGHEST_PRESSURE: f64 = 1e9;
/// Largest force, N.
pub const LARGEST_FORCE: f64 = 1e9;
/// Highest speed (rpm), ratio or lever.
pub const LARGEST_NUMBER: f64 = 1e5;
/// Slowest speed, rpm: slower, the air column of a press is longer than anything on earth.
pub const LEAST_RPM: f64 = 1e-3;
/// Thinnest disc, m: CAD systems take less than a micrometre for nothing.
pub const THINNEST: f64 = 1e-6;

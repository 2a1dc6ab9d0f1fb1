//! The ranges of a machine file, SI: a value beyond them is a typing error, not a machine.

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
/// Slowest speed, rpm: at less, the air column of a press would be thousands of kilometres long.
pub const LEAST_RPM: f64 = 1e-3;
/// Thinnest disc, m: CAD systems treat less than a micrometre as zero.
pub const THINNEST: f64 = 1e-6;

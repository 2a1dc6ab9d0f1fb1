//! The ranges of a machine file, SI: a value beyond them is a typing error, not a machine.

/// Longest length, m: a cam of a kilometre.
pub const LONGEST: f64 = 1e3;
/// Heaviest mass, kg.
pub const HEAVIEST: f64 = 1e7;
/// Highest pressure, Pa.
pub const HIGHEST_PRESSURE: f64 = 1e9;
/// Highest limit of a stress, Pa: a hundred times what steel withstands.
pub const HIGHEST_STRESS: f64 = 1e12;
/// Largest force, N.
pub const LARGEST_FORCE: f64 = 1e9;
/// Stiffest spring, N/m.
pub const STIFFEST: f64 = 1e12;
/// Highest speed (rpm), ratio or lever.
pub const LARGEST_NUMBER: f64 = 1e5;
/// Slowest speed, rpm: at less, the air column of a press would be thousands of kilometres long.
pub const LEAST_RPM: f64 = 1e-3;
/// What is right where a speed is negative.
pub const TURNS_FORWARD: &str = "a speed is above 0; cam.rotation = \"cw\" or \"ccw\" says which way the cam turns";
/// Thinnest disc, m: CAD systems treat less than a micrometre as zero.
pub const THINNEST: f64 = 1e-6;

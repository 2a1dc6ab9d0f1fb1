//! Kinds of cam, and analyses, as keys name the ones on which they have an effect.

/// The disc cam of a press.
pub const ROTARY: &str = "rotary";
/// The wedge cam: the plate that rides on the bed.
pub const TRANSLATING: &str = "translating";
/// The three-dimensional cam for many speeds.
pub const CONOID: &str = "conoid";
/// The disc cam of any motion.
pub const MAKE: &str = "make";
/// One cam of a press at other speeds.
pub const REGIMES: &str = "regimes";
/// Buffers of a press on springs.
pub const SPRING: &str = "spring";
/// The drive of a bed without a cam.
pub const DRIVE: &str = "drive";
/// The linkage that moves a bed.
pub const LINKAGE: &str = "linkage";

/// The shaft under a cam.
pub const SHAFT: &str = "shaft";

/// The belt brake of a paper roll.
pub const BRAKE: &str = "brake";
/// The disc that holds its tension.
pub const BRAKE_CAM: &str = "brake-cam";

/// The kinds that turn about a shaft.
pub const TURNING: &[&str] = &[ROTARY, CONOID, MAKE, BRAKE_CAM];
/// Disc cams.
pub const DISCS: &[&str] = &[ROTARY, MAKE, BRAKE_CAM];
/// What is analysed and not cut: a key that is of every cam has no effect there.
pub const ANALYSES: &[&str] = &[REGIMES, SPRING, DRIVE, LINKAGE, SHAFT, BRAKE];
/// The cams of a press.
pub const OF_A_PRESS: &[&str] = &[ROTARY, TRANSLATING, CONOID];
/// Whatever the bed and its air act on.
pub const OF_A_BED: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SPRING, DRIVE, LINKAGE];
/// Whatever a linkage moves.
pub const OF_A_LINKAGE: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, LINKAGE];
/// Whatever has air.
pub const OF_AIR: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SPRING, DRIVE, LINKAGE];
/// Whatever runs at a speed of the main shaft.
pub const OF_A_SPEED: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SPRING, LINKAGE];
/// Whatever has a column of air.
pub const OF_A_COLUMN: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, DRIVE, LINKAGE];
/// Whatever the law of a bottom acts on.
pub const OF_A_LAW: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, LINKAGE];
/// Whatever depends on the design of a press.
pub const OF_A_DESIGN: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SPRING, LINKAGE];

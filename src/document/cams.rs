//! Kinds of cam, as keys name the ones on which they have an effect.

/// The disc cam of a press.
pub const ROTARY: &str = "rotary";
/// The wedge cam: the plate that rides on the bed.
pub const TRANSLATING: &str = "translating";
/// The three-dimensional cam for many speeds.
pub const CONOID: &str = "conoid";
/// The disc cam of any motion.
pub const MAKE: &str = "make";

/// The kinds that turn about a shaft.
pub const TURNING: &[&str] = &[ROTARY, CONOID, MAKE];
/// Disc cams.
pub const DISCS: &[&str] = &[ROTARY, MAKE];
/// The cams of a press.
pub const OF_A_PRESS: &[&str] = &[ROTARY, TRANSLATING, CONOID];

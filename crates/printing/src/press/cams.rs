//! The cams of a press and its analyses, as keys name the ones on which they have an effect.

use camgen_kernel::document::cams::CamKind;
use camgen_kernel::document::cams::{EVEN, OF_A_DISC_WITH_A_RATED_ROLLER, OF_A_SURFACE};

/// The disc cam of a press.
pub const ROTARY: &str = "rotary";
/// The wedge cam: the plate that rides on the bed.
pub const TRANSLATING: &str = "translating";
/// The three-dimensional cam for many speeds.
pub const CONOID: &str = "conoid";
/// One cam of a press at other speeds.
pub const REGIMES: &str = "regimes";
/// Buffers of a press on springs.
pub const SPRING: &str = "spring";
/// What is left of a cam of a press in practice.
pub const SCATTER: &str = "scatter";
/// The drive of a bed without a cam.
pub const DRIVE: &str = "drive";

/// Analyses of the motion of the bed.
const BED_MOTION: &str = "analyses of the motion of the bed";
/// The classes of an analysis of the motion of the bed.
pub const OF_BED_MOTION: &[&str] = &[BED_MOTION];

/// The kinds.
pub const KINDS: &[CamKind] = &[
    CamKind::cam(ROTARY, OF_A_DISC_WITH_A_RATED_ROLLER),
    CamKind::cam(TRANSLATING, EVEN),
    CamKind::cam(CONOID, OF_A_SURFACE),
    CamKind::analysis(REGIMES),
    CamKind::analysis(SPRING),
    CamKind::analysis(SCATTER),
    CamKind::analysis(DRIVE),
];

/// The cams of a press.
pub const OF_A_PRESS: &[&str] = &[ROTARY, TRANSLATING, CONOID];
/// Kinds on which the bed and its air have an effect.
pub const OF_A_BED: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SPRING, SCATTER, DRIVE, BED_MOTION];
/// Kinds with air buffers.
pub const OF_AIR: &[&str] = OF_A_BED;
/// Kinds that depend on the speed of the main shaft.
pub const OF_A_SPEED: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SPRING, SCATTER, BED_MOTION];
/// Kinds with an air column.
pub const OF_A_COLUMN: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SCATTER, DRIVE, BED_MOTION];
/// Kinds whose air columns have a limit.
pub const OF_A_COLUMN_LIMIT: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SPRING, SCATTER];
/// Kinds on which the law of the bottom has an effect.
pub const OF_A_LAW: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SCATTER, BED_MOTION];
/// Kinds that depend on the design of a press.
pub const OF_A_DESIGN: &[&str] = &[ROTARY, TRANSLATING, CONOID, REGIMES, SPRING, SCATTER, BED_MOTION];

//! Kinds of cam, and analyses, as keys name the ones on which they have an effect.

/// The disc cam of any motion.
pub const MAKE: &str = "make";

/// A kind of cam, or an analysis, as keys name it.
#[derive(Debug, Clone, Copy)]
pub struct CamKind {
    /// Its name.
    pub name: &'static str,
    /// The classes it belongs to: a key that names one of them has an effect on it.
    pub classes: &'static [&'static str],
    /// Whether it is an analysis: nothing is cut, and keys for every cam have no effect on it.
    pub analysis: bool,
}

impl CamKind {
    /// A kind of cam.
    #[must_use]
    pub const fn cam(name: &'static str, classes: &'static [&'static str]) -> Self {
        Self { name, classes, analysis: false }
    }

    /// An analysis, of which nothing is cut.
    #[must_use]
    pub const fn analysis(name: &'static str) -> Self {
        Self::classed_analysis(name, &[])
    }

    /// What is analysed and not cut, of these classes.
    #[must_use]
    pub const fn classed_analysis(name: &'static str, classes: &'static [&'static str]) -> Self {
        Self { name, classes, analysis: true }
    }
}

const TURNS: &str = "cams that turn";
const DISC: &str = "disc cams";
const ONE_THICKNESS: &str = "cams of one thickness";
const SURFACE: &str = "cams whose sections differ";

/// The classes of a disc cam.
pub const OF_A_DISC: &[&str] = &[TURNS, DISC];
/// The classes of a disc cam whose thickness is a key.
pub const OF_A_DISC_WITH_THICKNESS: &[&str] = &[TURNS, DISC, ONE_THICKNESS];
/// The classes of a cam that turns and whose sections differ.
pub const OF_A_SURFACE: &[&str] = &[TURNS, SURFACE];
/// The kinds that turn about a shaft.
pub const TURNING: &[&str] = &[TURNS];
/// Disc cams.
pub const DISCS: &[&str] = &[DISC];
/// Cams that are as thick everywhere.
pub const EVEN: &[&str] = &[ONE_THICKNESS];
/// Cams whose sections differ along their axis.
pub const SURFACES: &[&str] = &[SURFACE];

/// A ring around the roller of any motion.
pub const RING: &str = "ring";
/// A groove for the roller of any motion.
pub const GROOVE: &str = "groove";

/// A pair of discs for two rollers of one follower, of any motion.
pub const CONJUGATE: &str = "conjugate";

/// The bodies of a motion program as a file names them, and as keys do: all of them belong to the class [`MAKE`].
pub const BODIES: &[&str] = &["disc", RING, GROOVE, CONJUGATE];
/// The same bodies, as keys name them.
pub const BODY_KINDS: &[&str] = &[MAKE, RING, GROOVE, CONJUGATE];

/// The classes of a disc of a motion program.
const OF_A_PROGRAM: &[&str] = &[MAKE, TURNS, DISC, ONE_THICKNESS];
/// The classes of a body within which a roller runs.
const OF_A_TRACK: &[&str] = &[MAKE, TURNS, ONE_THICKNESS];

/// The kinds of cam of the core.
pub const KINDS: &[CamKind] = &[
    CamKind::cam(MAKE, OF_A_PROGRAM),
    CamKind::cam(RING, OF_A_TRACK),
    CamKind::cam(GROOVE, OF_A_TRACK),
    CamKind::cam(CONJUGATE, OF_A_PROGRAM),
];

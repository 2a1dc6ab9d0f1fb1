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
const BASED: &str = "cams with a base circle";
const RATED: &str = "cams whose roller may have a rating";
const GROOVED: &str = "cams whose rollers run in a groove";
const ROUND_A_CYLINDER: &str = "cams with a groove round a cylinder";

/// The classes of a disc cam.
pub const OF_A_DISC: &[&str] = &[TURNS, DISC, BASED];
/// The classes of a disc cam whose thickness is a key and whose roller may have a rating.
pub const OF_A_DISC_WITH_A_RATED_ROLLER: &[&str] = &[TURNS, DISC, ONE_THICKNESS, BASED, RATED];
/// The classes of a cam that turns and whose sections differ.
pub const OF_A_SURFACE: &[&str] = &[TURNS, SURFACE, BASED];
/// The kinds that turn about a shaft.
pub const TURNING: &[&str] = &[TURNS];
/// Cams with a base circle.
pub const WITH_A_BASE: &[&str] = &[BASED];
/// Cams whose roller may have a rating.
pub const WITH_A_RATED_ROLLER: &[&str] = &[MAKE, RATED];
/// Cams whose rollers run in a groove.
pub const WITH_A_GROOVE: &[&str] = &[GROOVED];
/// Cams with a groove round a cylinder.
pub const CYLINDERS: &[&str] = &[ROUND_A_CYLINDER];
/// Cams that are turned to a radius of the outside.
pub const WITH_AN_OUTSIDE: &[&str] = &[RING, ROUND_A_CYLINDER];
/// Disc cams.
pub const DISCS: &[&str] = &[DISC];
/// Cams of discs that may have holes, a hub and a timing mark.
pub const WITH_HOLES: &[&str] = &[DISC, GROOVE];
/// Cams that are as thick everywhere.
pub const EVEN: &[&str] = &[ONE_THICKNESS];
/// Cams that are cut from a plate along one outline or more.
pub const FLAT: &[&str] = &[DISC, ONE_THICKNESS];
/// Cams whose sections differ along their axis.
pub const SURFACES: &[&str] = &[SURFACE];

/// A ring around the roller of any motion.
pub const RING: &str = "ring";
/// A groove for the roller of any motion.
pub const GROOVE: &str = "groove";

/// A pair of discs for two rollers of one follower, of any motion.
pub const CONJUGATE: &str = "conjugate";

/// A wall between two rollers of one follower, of any motion.
pub const RIB: &str = "rib";
/// A disc between two faces or rollers of one follower, of a motion whose second half turn is the first one upside down.
pub const YOKE: &str = "yoke";
/// A cylinder with a groove round its outside, of any motion.
pub const BARREL: &str = "barrel";
/// A hollow round body that moves a turret on, of any motion that indexes.
pub const GLOBOID: &str = "globoid";
/// A plate that travels out and back under its follower, of any motion.
pub const WEDGE: &str = "wedge";

/// What a file calls the body of a motion program that is a disc.
pub const DISC_BODY: &str = "disc";

/// The classes of a disc of a motion program.
const OF_A_PROGRAM: &[&str] = &[MAKE, TURNS, DISC, ONE_THICKNESS, BASED];
/// The classes of a body within which a roller runs.
const OF_A_TRACK: &[&str] = &[MAKE, TURNS, ONE_THICKNESS, BASED];
/// The classes of a disc with a groove.
const OF_A_GROOVE: &[&str] = &[MAKE, TURNS, ONE_THICKNESS, BASED, GROOVED];
/// The classes of a body with a groove round a cylinder.
const OF_A_CYLINDER: &[&str] = &[MAKE, TURNS, GROOVED, ROUND_A_CYLINDER];
/// The classes of a body with grooves in another round blank.
const OF_A_ROUND_BLANK: &[&str] = &[MAKE, TURNS, GROOVED];
/// The classes of a body that travels.
const OF_A_PLATE: &[&str] = &[MAKE, ONE_THICKNESS];

/// The bodies of a motion program, which all belong to the class [`MAKE`]: what a file calls each, and its kind of cam. The first is
/// the usual one.
const PROGRAM_BODIES: &[(&str, CamKind)] = &[
    (DISC_BODY, CamKind::cam(MAKE, OF_A_PROGRAM)),
    (RING, CamKind::cam(RING, OF_A_TRACK)),
    (GROOVE, CamKind::cam(GROOVE, OF_A_GROOVE)),
    (CONJUGATE, CamKind::cam(CONJUGATE, OF_A_PROGRAM)),
    (RIB, CamKind::cam(RIB, OF_A_TRACK)),
    (YOKE, CamKind::cam(YOKE, OF_A_PROGRAM)),
    (BARREL, CamKind::cam(BARREL, OF_A_CYLINDER)),
    ("tapered-barrel", CamKind::cam("tapered-barrel", OF_A_CYLINDER)),
    (GLOBOID, CamKind::cam(GLOBOID, OF_A_ROUND_BLANK)),
    (WEDGE, CamKind::cam(WEDGE, OF_A_PLATE)),
];

/// The bodies of a motion program as a file names them.
pub const BODIES: &[&str] = &{
    let mut names = [""; PROGRAM_BODIES.len()];
    let mut index = 0;
    while index < PROGRAM_BODIES.len() {
        names[index] = PROGRAM_BODIES[index].0;
        index += 1;
    }
    names
};
/// The same bodies, as keys name them.
pub const BODY_KINDS: &[&str] = &{
    let mut names = [""; PROGRAM_BODIES.len()];
    let mut index = 0;
    while index < PROGRAM_BODIES.len() {
        names[index] = PROGRAM_BODIES[index].1.name;
        index += 1;
    }
    names
};
/// Whether the body of a motion program, as keys name it, is one of these kinds or classes.
#[must_use]
pub fn is_body_of(body: &str, cams: &[&str]) -> bool {
    let mut kinds = PROGRAM_BODIES.iter().map(|(_, kind)| kind).filter(|kind| kind.name == body);
    kinds.any(|kind| cams.contains(&kind.name) || cams.iter().any(|class| kind.classes.contains(class)))
}

/// The kinds of cam of the core.
pub const KINDS: &[CamKind] = &{
    let mut kinds = [PROGRAM_BODIES[0].1; PROGRAM_BODIES.len()];
    let mut index = 0;
    while index < PROGRAM_BODIES.len() {
        kinds[index] = PROGRAM_BODIES[index].1;
        index += 1;
    }
    kinds
};

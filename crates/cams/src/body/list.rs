//! The bodies of motion programs.

use super::disc::{self, Disc};
use super::groove::{self, Groove};
use super::{BodyKeys, Kind, ProgramCams, barrel, conjugate, globoid, rib, tapered, wedge, yoke};
use crate::machine::Machine;
use camgen_kernel::document::cams;
use camgen_kernel::motion::{Motion, given};
use camgen_kernel::refusal::Refusal;
use std::sync::Arc;

/// Solves a body for a motion, at a speed of the cam (rpm) where it is known.
pub type SolveProgram = fn(&Machine, &Arc<dyn Motion>, Option<f64>) -> Result<ProgramCams, Refusal>;

/// A body of a motion program, chosen by `cam.body`.
#[derive(Debug)]
pub struct ProgramBody {
    /// Its kind, whose keys are those of the body's name.
    pub kind: &'static Kind,
    /// Whether its outline is that of a disc about a base circle, so that it has the size of one.
    pub has_base_circle: bool,
    /// How it is solved.
    pub solve: SolveProgram,
    /// The keys that only it has and that its folder reads.
    pub keys: Option<&'static BodyKeys>,
}

impl ProgramBody {
    /// A body about a base circle.
    const fn based(kind: &'static Kind, solve: SolveProgram) -> Self {
        Self { kind, has_base_circle: true, solve, keys: None }
    }

    /// A body without a base circle.
    const fn without_base(kind: &'static Kind, solve: SolveProgram) -> Self {
        Self { kind, has_base_circle: false, solve, keys: None }
    }

    const fn with_keys(self, keys: &'static BodyKeys) -> Self {
        Self { keys: Some(keys), ..self }
    }
}

/// Every body of a motion program: a new one is a folder, and a line here and in [`cams`](camgen_kernel::document::cams).
pub const BODIES: &[ProgramBody] = &[
    ProgramBody::based(&disc::GENERAL, |machine, motion, rpm| {
        Ok(ProgramCams::alone(Disc::of_motion(machine, Arc::clone(motion), rpm)?))
    }),
    ProgramBody::based(&groove::RING, |machine, motion, rpm| {
        Ok(ProgramCams::alone(Groove::ring(machine, motion, rpm)?))
    }),
    ProgramBody::based(&groove::GROOVE, |machine, motion, rpm| {
        Ok(ProgramCams::alone(Groove::between_flanks(machine, motion, rpm)?))
    }),
    ProgramBody::based(&conjugate::MAIN, conjugate::pair),
    ProgramBody::based(&rib::RIB, |machine, motion, rpm| Ok(ProgramCams::alone(rib::Rib::of(machine, motion, rpm)?))),
    ProgramBody::based(&yoke::YOKE, |machine, motion, rpm| {
        Ok(ProgramCams::alone(yoke::Yoke::of(machine, motion, rpm)?))
    }),
    ProgramBody::without_base(&barrel::BARREL, barrel::solve),
    ProgramBody::without_base(&tapered::TAPERED, tapered::solve).with_keys(&tapered::KEYS),
    ProgramBody::without_base(&globoid::GLOBOID, |machine, motion, rpm| {
        Ok(ProgramCams::alone(globoid::Globoid::of(machine, motion, rpm)?))
    }),
    ProgramBody::without_base(&wedge::WEDGE, |machine, motion, rpm| {
        Ok(ProgramCams::alone(wedge::Wedge::at_speed(machine, motion, rpm)?))
    }),
];

/// Refuses figures of a disc for a machine whose body is not a disc.
///
/// # Errors
/// [`Refusal`] where the body has no base circle.
pub(crate) fn needs_base_circle(machine: &Machine, what: &str) -> Result<(), Refusal> {
    let other = BODIES.iter().find(|body| body.kind.keys == machine.body() && !body.has_base_circle);
    let Some(other) = other else { return Ok(()) };
    let refusal = Refusal::new(format!("{what} is that of a disc, and this is a {}", other.kind.noun));
    Err(refusal.remedy("`camgen make` reports the sizes and angles of other bodies"))
}

/// The disc whose base radius sizes the body of `machine`, sized for the whole body.
///
/// # Errors
/// [`Refusal`] when motion and follower do not fit each other, or no radius keeps the limits.
pub(crate) fn sized_disc(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<Disc, Refusal> {
    match machine.body() {
        cams::CONJUGATE => conjugate::main(machine, motion, rpm),
        cams::GROOVE => Groove::sized_disc(machine, motion, rpm),
        cams::RIB => rib::Rib::sized_middle(machine, motion, rpm),
        cams::YOKE => yoke::Yoke::sized_disc(machine, motion, rpm),
        _ => Disc::of_motion(machine, Arc::clone(motion), rpm),
    }
}

/// Kinds that are made with one of these.
pub const MADE_WITH: &[&Kind] = &[&conjugate::COUNTER];

/// Solves the body of a motion that a machine names.
///
/// # Errors
/// [`Refusal`] if there is no such cam, or a motion given by code contradicts itself.
pub fn of_motion(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<ProgramCams, Refusal> {
    let named = BODIES.iter().find(|body| body.kind.keys == machine.body());
    let body = named.ok_or_else(|| Refusal::new(format!("no body is called {}", machine.body())))?;
    // Motions of files were checked when read.
    if motion.program().is_none() {
        given::check(&**motion)?;
    }
    (body.solve)(machine, motion, rpm)
}

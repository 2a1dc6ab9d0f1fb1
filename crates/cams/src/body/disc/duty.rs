//! The duty of a disc in a machine that the core does not know.

use super::Disc;
use crate::body::Kind;
use crate::body::picture::DrivenMechanism;
use crate::check::{Measures, Subject};
use crate::load::Load;
use crate::machine::Machine;
use crate::report::{Rolled, Section, Shaft};
use camgen_kernel::motion::Motion;
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::Text;
use std::fmt;
use std::sync::Arc;

/// The duty of a disc in its machine.
pub trait Duty: fmt::Debug + Send + Sync {
    /// Its kind.
    fn kind(&self) -> &'static Kind;

    /// Its position in its machine, for the report.
    fn mounting(&self, _machine: &Machine) -> Option<Section> {
        None
    }

    /// Sections of the report on its duty.
    fn sections(&self, _disc: &Disc) -> Vec<Section> {
        Vec::new()
    }

    /// The forces of its machine with the disc as rolled, where it was rolled on, for the report.
    fn forces(&self, _disc: &Disc, _rolled: Option<&Rolled>) -> Option<Section> {
        None
    }

    /// Takes the figures that only such a disc has.
    fn measures(&self, _disc: &Disc, _of: &mut Measures<'_>, _subject: &Subject<'_>) {}

    /// A change with which its motion keeps `limits.continuity`, tried before it is named.
    fn smoother(&self, _machine: &Machine) -> Option<Text> {
        None
    }

    /// The mechanism that its follower drives, for the picture, at so many steps of a turn.
    fn driven_mechanism(&self, _disc: &Disc, _samples: u32) -> Option<Box<dyn DrivenMechanism>> {
        None
    }

    /// What is not modelled of its machine, a sentence each.
    fn not_modelled(&self, _machine: &Machine) -> &'static [&'static str] {
        &[]
    }

    /// The camshaft, where it does not turn as fast as the main shaft of its machine.
    fn shaft(&self, _disc: &Disc) -> Option<Shaft> {
        None
    }

    /// The largest error of the lift along the follower's path that the machine permits, m, and what sets it.
    fn permitted_path_error(&self, _disc: &Disc) -> Option<(f64, &'static str)> {
        None
    }

    /// The label on the sheet at the origin of the cam angle.
    fn angle_origin(&self) -> &'static str {
        "θ = 0"
    }
}

/// Duty, load and speeds of a disc.
#[derive(Debug, Clone, Default)]
pub struct Purpose {
    /// Its duty; without one it is the disc of a motion.
    pub duty: Option<Arc<dyn Duty>>,
    /// Its load.
    pub load: Option<Arc<dyn Load>>,
    /// The speed for which it is reported, rpm.
    pub rpm: Option<f64>,
    /// Angular speed of the cam, rad/s, where it is known.
    pub speed: Option<f64>,
}

impl Disc {
    /// The cam of any motion under the machine's follower, for a purpose, sized.
    ///
    /// # Errors
    /// [`Refusal`] when motion and follower do not fit each other or no radius keeps the limits.
    pub fn for_purpose(machine: &Machine, motion: Arc<dyn Motion>, purpose: Purpose) -> Result<Self, Refusal> {
        let Purpose { duty, load, rpm, speed } = purpose;
        let bare = Self::unsized_of(machine, motion);
        let kind = duty.as_ref().map_or(bare.kind, |duty| duty.kind());
        Self { kind, rpm, speed, load, duty, ..bare }.sized()
    }
}

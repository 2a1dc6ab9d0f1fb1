//! Why a brake is refused or has no answer, with the radius where it ends and what would help.

use super::PaperRoll;
use camgen_kernel::numeric::digits::three_digits_down;
use camgen_kernel::refusal::Refusal;
use std::f64::consts::TAU;

/// A pulley of the frame, for a message.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pulley {
    /// p1.
    Right,
    /// p2.
    Left,
}

impl std::fmt::Display for Pulley {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Right => "right",
            Self::Left => "left",
        })
    }
}

/// Why a brake, or a query about it, is refused. Values are SI; radii are roll radii.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BrakeError {
    /// d_i ≤ R + ρ.
    #[error(
        "the {pulley} pulley meets the roll at a radius of {} mm; move it outwards, or make the pulleys smaller",
        millimetres(*radius)
    )]
    PulleyMeetsRoll {
        /// Which.
        pulley: Pulley,
        /// m.
        radius: f64,
    },
    /// The pulleys meet on the far side of the roll.
    #[error(
        "the pulleys pass each other behind the roll at a radius of {} mm; set them less far around it, or move the \
         pivot",
        millimetres(*radius)
    )]
    PulleysPass {
        /// Just before, m.
        radius: f64,
    },
    /// a ≤ 0. It comes at the largest radius only: a taut belt that is longer than the distance of the pulleys stays so, because the
    /// frame changes neither.
    #[error(
        "the belt leaves the roll at a radius of {} mm; set the pulleys further around it, or further apart",
        millimetres(*radius)
    )]
    BeltLeavesRoll {
        /// m.
        radius: f64,
    },
    /// q1 + q2 = 0: the frame turns without end for no change of the radius.
    #[error(
        "the frame comes to a dead point at a radius of {} mm, where the spans cross on a line through the pivot, and does not \
         follow the roll down to {} mm; move the pivot away from that line",
        millimetres(*radius), millimetres(*smallest)
    )]
    DeadPoint {
        /// m.
        radius: f64,
        /// Radius that was to be reached, m.
        smallest: f64,
    },
    /// (1 + ε1) q_t + q_s ≤ 0: friction alone presses the belt on.
    #[error(
        "the brake jams at a radius of {} mm with a friction of {friction}; move the pivot to the other side of the \
         tight span, \
         or turn the roll the other way",
        millimetres(*radius)
    )]
    Jams {
        /// m.
        radius: f64,
        /// The friction coefficient.
        friction: f64,
    },
    /// h1 ≤ 0.
    #[error(
        "the weight no longer presses the belt on at a radius of {} mm; move the centre of gravity away from the pivot",
        millimetres(*radius)
    )]
    WeightLifts {
        /// m.
        radius: f64,
    },
    /// The frame could not be computed down to the smallest radius.
    #[error(
        "the frame cannot be followed below a radius of {} mm, to {} mm; check its dimensions",
        millimetres(*radius), millimetres(*smallest)
    )]
    NotReached {
        /// Last radius that was reached, m.
        radius: f64,
        /// Radius that was to be reached, m.
        smallest: f64,
    },
    /// An input is out of its range, or no frame is found.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

impl From<BrakeError> for Refusal {
    fn from(error: BrakeError) -> Self {
        match error {
            BrakeError::Refused(refusal) => refusal,
            wall => Self::of(wall),
        }
    }
}

impl BrakeError {
    /// The radius of the roll at which the frame can go no further, m.
    #[must_use]
    pub fn radius(&self) -> Option<f64> {
        match *self {
            Self::PulleyMeetsRoll { radius, .. }
            | Self::BeltLeavesRoll { radius }
            | Self::PulleysPass { radius }
            | Self::DeadPoint { radius, .. }
            | Self::Jams { radius, .. }
            | Self::WeightLifts { radius }
            | Self::NotReached { radius, .. } => Some(radius),
            _ => None,
        }
    }
}

/// Millimetres to the micrometre.
pub(super) fn millimetres(metres: f64) -> f64 {
    (1e6 * metres).round() / 1e3
}

/// Refuses a length, a speed, a modulus, a friction or a tension (SI) that is not above 0.
pub(super) fn positive(name: &str, value: f64) -> Result<(), Refusal> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Refusal::new(format!("the {name} is {value}")).remedy("it must be a number above 0"))
}

/// Refuses a coordinate or a strain that is not finite.
pub(super) fn finite(name: &str, value: f64) -> Result<(), Refusal> {
    if value.is_finite() {
        return Ok(());
    }
    Err(Refusal::new(format!("the {name} is {value}")).remedy("it must be a finite number"))
}

/// Refuses a roll (m) whose radius does not become smaller.
pub(super) fn shrinking(roll: &PaperRoll) -> Result<(), Refusal> {
    let PaperRoll { largest_radius: largest, smallest_radius: smallest } = *roll;
    if smallest < largest {
        return Ok(());
    }
    Err(Refusal::new(format!("the smallest radius of the roll is {} mm", millimetres(smallest)))
        .remedy(format!("it must be below the largest, {} mm", millimetres(largest))))
}

/// That a disc would turn past its start, with its turns for a turn of the frame by an angle (rad).
#[must_use]
pub fn turned_too_far(turns_per_frame_turn: f64, turn: f64) -> Refusal {
    let disc = (turns_per_frame_turn * turn).to_degrees();
    Refusal::new(format!("the disc would turn by {disc:.1} deg, a whole turn or more"))
        .remedy(format!("give a turns_per_frame_turn of {} at most", three_digits_down(TAU / turn)))
}

//! Why a brake is refused or has no answer, with the radius where it ends and what would help.

use crate::numeric::digits::three_digits_down;

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

/// Why a brake is refused, or a question about it. Values are SI; a radius is that of the roll.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BrakeError {
    /// A coordinate or a strain.
    #[error("the {name} is {value}: it must be a finite number")]
    NotFinite {
        /// Of what.
        name: &'static str,
        /// Found.
        value: f64,
    },
    /// A length, speed, modulus, friction or tension.
    #[error("the {name} is {value}: it must be a number above 0")]
    NotPositive {
        /// Of what.
        name: &'static str,
        /// Found, SI.
        value: f64,
    },
    /// The roll does not run down.
    #[error(
        "the smallest radius of the roll is {} mm: it must be below the largest, {} mm",
        millimetres(*smallest), millimetres(*largest)
    )]
    RollOrder {
        /// m.
        smallest: f64,
        /// m.
        largest: f64,
    },
    /// An angle of wrap that no single belt has.
    #[error("the wrap is {} deg: it must be above 0 and below 360 deg", millimetres(wrap.to_degrees()) / 1e3)]
    Wrap {
        /// rad.
        wrap: f64,
    },
    /// d_i ≤ R + ρ.
    #[error(
        "the {pulley} pulley meets the roll at a radius of {} mm: move it outwards, or make the pulleys smaller",
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
        "the pulleys pass each other behind the roll at a radius of {} mm: set them less far round it, or move the pivot",
        millimetres(*radius)
    )]
    PulleysPass {
        /// Just before, m.
        radius: f64,
    },
    /// a ≤ 0. It comes at the largest radius only: a taut belt that is longer than the distance of the pulleys stays so, because the
    /// frame changes neither.
    #[error(
        "the belt leaves the roll at a radius of {} mm: set the pulleys further round it, or further apart",
        millimetres(*radius)
    )]
    BeltLeavesRoll {
        /// m.
        radius: f64,
    },
    /// q1 + q2 = 0: the frame turns without end for no change of the radius.
    #[error(
        "the frame comes to a dead point at a radius of {} mm, where the spans cross on a line through the pivot, and does not \
         follow the roll down to {} mm: move the pivot away from that line",
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
        "the brake jams at a radius of {} mm with a friction of {friction}: move the pivot to the other side of the tight span, \
         or turn the roll the other way",
        millimetres(*radius)
    )]
    Jams {
        /// m.
        radius: f64,
        /// The friction coefficient it was asked for.
        friction: f64,
    },
    /// h1 ≤ 0.
    #[error(
        "the weight no longer presses the belt on at a radius of {} mm: move the centre of gravity away from the pivot",
        millimetres(*radius)
    )]
    WeightLifts {
        /// m.
        radius: f64,
    },
    /// The arithmetic has an end before the roll has.
    #[error(
        "the frame cannot be followed below a radius of {} mm, to {} mm: its dimensions are out of all proportion",
        millimetres(*radius), millimetres(*smallest)
    )]
    NotReached {
        /// Last radius that was reached, m.
        radius: f64,
        /// Radius that was to be reached, m.
        smallest: f64,
    },
    /// A question about another radius.
    #[error(
        "a radius of {} mm is outside the roll, {}…{} mm",
        millimetres(*radius), millimetres(*smallest), millimetres(*largest)
    )]
    OutsideRoll {
        /// m.
        radius: f64,
        /// m.
        smallest: f64,
        /// m.
        largest: f64,
    },
    /// The disc would turn past its start.
    #[error(
        "the disc would turn by {:.1} deg, a whole turn or more: turns_per_frame_turn at most {}",
        turn.to_degrees(), three_digits_down(*most)
    )]
    CamTurn {
        /// rad.
        turn: f64,
        /// Any ratio below passes.
        most: f64,
    },
    /// Nothing found within the limits has no wall.
    #[error(
        "no frame within {} mm of the roll's axis brakes the whole roll: allow a larger reach, or smaller pulleys",
        millimetres(*reach)
    )]
    NoFrame {
        /// m.
        reach: f64,
    },
}

impl BrakeError {
    /// The radius of the roll at which a wall stands, m.
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
fn millimetres(metres: f64) -> f64 {
    (1e6 * metres).round() / 1e3
}

pub(super) fn positive(name: &'static str, value: f64) -> Result<(), BrakeError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(BrakeError::NotPositive { name, value }) }
}

pub(super) fn finite(name: &'static str, value: f64) -> Result<(), BrakeError> {
    if value.is_finite() { Ok(()) } else { Err(BrakeError::NotFinite { name, value }) }
}

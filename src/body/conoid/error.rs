//! Why there is no conoid.

use crate::machine::{NoPress, NoRoller};
use crate::motion::MotionError;
use crate::profile::size::NoRadius;

/// Why there is no conoid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConoidError {
    /// The machine file has no table `[conoid]`.
    #[error("the machine file has no [conoid] table: a conoid needs axial_travel, mode and shift")]
    NotDescribed,
    /// It describes no press.
    #[error(transparent)]
    NoPress(#[from] NoPress),
    /// Its follower is not a roller.
    #[error(transparent)]
    NoRoller(#[from] NoRoller),
    /// Two sections for one speed would lie in one plane.
    #[error("the speed {rpm} is asked for twice; each speed has one section")]
    Twice {
        /// The speed, rpm.
        rpm: f64,
    },
    /// Two sections would lie nearly in one plane.
    #[error("the speeds {first} and {second} are too close together: their sections would lie {apart_mm:e} mm apart")]
    TooNear {
        /// The slower, rpm.
        first: f64,
        /// The faster, rpm.
        second: f64,
        /// Their distance along the axis, mm.
        apart_mm: f64,
    },
    /// A residual force between the sections below what rounding leaves of the balance.
    #[error(
        "a residual force of {limit:e} N lies in the rounding of the balance: give a --residual of at least {least:.1e} N"
    )]
    TooFine {
        /// What was asked for, N.
        limit: f64,
        /// The least that can be asked for, N.
        least: f64,
    },
    /// A range of speeds that no number of sections covers.
    #[error(
        "{most} evenly spaced sections from {from} to {to} rpm leave more than {limit} N between them; give a larger \
         --residual, or a narrower range of speeds in --rpm"
    )]
    TooManySections {
        /// The most that are tried.
        most: u32,
        /// The slowest speed, rpm.
        from: f64,
        /// The fastest, rpm.
        to: f64,
        /// What was asked for, N.
        limit: f64,
    },
    /// No speed at all.
    #[error("a conoid needs at least one speed")]
    NoSpeed,
    /// The parts of the motion do not fit together.
    #[error("{0}; see transition.width, buffer.lead and cam.cam_turns_per_crank_turn")]
    Motion(#[from] MotionError),
    /// `auto` found no radius.
    #[error(
        "{0}: relax limits.pressure_angle or limits.min_convex_pitch_radius_over_roller, make conoid.axial_travel longer \
         (the surface may be too sharp along the axis), or give cam.base_radius"
    )]
    Size(#[from] NoRadius),
}

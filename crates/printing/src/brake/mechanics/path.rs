//! The path of the frame as the roll runs down, from station to station.
//!
//! R is a function of the turn φ (`belt`), with dR/dφ = −(q1 + q2)/a: the walk is along φ, so that a dead point, where the path over R
//! would turn back, is passed like any other radius and found by the sign of q1 + q2.

use super::belt::{Belt, BeltState};
use super::{BrakeError, PaperRoll};
use std::f64::consts::PI;

/// Longest step of the frame, rad: from a tangent of one degree Newton's method closes the belt in three or four steps.
const MOST_TURN: f64 = PI / 180.0;

/// Steps in addition to the equal steps of the radius: a whole turn of the frame in longest steps.
const MOST_STEPS: usize = 400;

/// Halvings of a step to the limit of the movement in it: from a degree to 1e-18 rad.
const HALVINGS: usize = 54;

/// What may end the path, apart from the geometry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Grip {
    pub(super) friction: f64,
    /// The tight span is the left one.
    pub(super) left_is_tight: bool,
}

impl Grip {
    /// q_t and q_s.
    pub(super) fn arms(self, place: &BeltState) -> (f64, f64) {
        if self.left_is_tight { (place.left_arm, place.right_arm) } else { (place.right_arm, place.left_arm) }
    }

    /// q_t + (q_t + q_s)/ε1, m: moment about the pivot over web tension.
    pub(super) fn resisting_arm(self, place: &BeltState) -> f64 {
        let (tight, slack) = self.arms(place);
        tight + (tight + slack) / libm::expm1(place.wrap * self.friction)
    }

    /// The belt there, unless the frame can go no further.
    pub(super) fn check(self, place: BeltState, smallest: f64) -> Result<BeltState, BrakeError> {
        let radius = place.radius;
        if !(place.wrap.is_finite() && place.length.is_finite() && place.both_arms().is_finite()) {
            Err(BrakeError::NotReached { radius, smallest })
        } else if place.wrap <= 0.0 {
            Err(BrakeError::BeltLeavesRoll { radius })
        } else if place.both_arms() <= 0.0 {
            Err(BrakeError::DeadPoint { radius, smallest })
        } else if !(self.resisting_arm(&place) > 0.0) {
            Err(BrakeError::Jams { radius, friction: self.friction })
        } else if !(place.weight_arm > 0.0) {
            Err(BrakeError::WeightLifts { radius })
        } else {
            Ok(place)
        }
    }
}

/// The belt at the stations, the largest radius first; the last is at the smallest radius or just below. At least `stations` steps.
///
/// # Errors
/// The limit of the movement before the smallest radius, with its radius.
pub(super) fn walk(
    belt: &Belt,
    first: BeltState,
    grip: Grip,
    roll: PaperRoll,
    stations: u32,
) -> Result<Vec<BeltState>, BrakeError> {
    let smallest = roll.smallest_radius;
    let step = (roll.largest_radius - smallest) / f64::from(stations);
    let mut here = grip.check(first, smallest)?;
    let mut places = vec![here];
    for _ in 0..MOST_STEPS + usize::try_from(stations).unwrap_or(0) {
        if here.radius <= smallest {
            return Ok(places);
        }
        let turn = (-step / here.radius_by_turn()).min(MOST_TURN);
        here = match next(belt, &here, turn, grip, smallest) {
            Ok(place) => place,
            Err(wall) => before_wall(belt, here, turn, wall, grip, smallest)?,
        };
        places.push(here);
    }
    Err(BrakeError::NotReached { radius: here.radius, smallest })
}

/// The belt a turn further on.
fn next(belt: &Belt, here: &BeltState, turn: f64, grip: Grip, smallest: f64) -> Result<BeltState, BrakeError> {
    // Past a whole turn between the pulleys their angle begins at 0 again, and the belt would have to pass between them.
    if belt.opening_at(here.turn) - belt.opening_at(here.turn + turn) > PI {
        return Err(BrakeError::PulleysPass { radius: here.radius });
    }
    let place = belt.at_turn(here.turn + turn, here.radius + turn * here.radius_by_turn())?;
    grip.check(place, smallest)
}

/// The last state before the limit within a turn, if that is past the smallest radius.
fn before_wall(
    belt: &Belt,
    here: BeltState,
    turn: f64,
    wall: BrakeError,
    grip: Grip,
    smallest: f64,
) -> Result<BeltState, BrakeError> {
    let (mut before, mut wall, mut low, mut high) = (here, wall, 0.0, turn);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        match next(belt, &here, middle, grip, smallest) {
            Ok(place) => (before, low) = (place, middle),
            Err(error) => (wall, high) = (error, middle),
        }
    }
    if before.radius <= smallest { Ok(before) } else { Err(wall) }
}

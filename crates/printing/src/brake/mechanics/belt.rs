//! The taut belt between the pulleys of a hinged frame and the roll, at one radius and one turn of the frame.
//!
//! With d_i = |p_i|, R' = R + ρ, S_i = √((d_i − R')(d_i + R')), β_i = atan2(S_i, R') the belt leaves the roll at n1 = arg p1 + β1
//! and n2 = arg p2 − β2, and
//!
//! ```text
//! a = n2 − n1,  ℓ = R' a + S1 + S2,  ∂ℓ/∂R = a,  ∂ℓ/∂θ = −(q1 + q2)
//! N1 = (R' p1 + S1 ⊥p1)/d1²,  N2 = (R' p2 − S2 ⊥p2)/d2²,  q1 = R − O·N1,  q2 = O·N2 − R
//! ```
//!
//! The frame's turn is counted as φ = |θ|, from 0 at the largest radius: it only grows as the roll runs down, ∂ℓ/∂φ = q1 + q2 > 0.
//! With the pivot on the right the arms and θ change their sign (`side`), nothing else does.

use super::{BrakeError, BrakeFrame, Pulley};
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// Steps of the search for a radius. Bisection alone needs 53; Newton's method four.
const MOST_STEPS: usize = 120;

/// Rounding of the belt's length, a sum of four terms, as a share of the length and of R'.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Error of the length that is rounding at the end of a search, as a share of the length and of the radius.
const CLOSED: f64 = 1e-12;

/// The frame with its belt.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Belt {
    pub(super) pivot: Vector2<f64>,
    /// From the pivot, at θ = 0: right pulley, left pulley, centre of gravity.
    pub(super) right: Vector2<f64>,
    pub(super) left: Vector2<f64>,
    pub(super) centre: Vector2<f64>,
    pub(super) pulley_radius: f64,
    /// Sign of q1 + q2 at the largest radius: −1 with the pivot on the right.
    pub(super) side: f64,
    /// ℓ, m.
    pub(super) length: f64,
}

/// The belt at a radius and a turn, whether its length fits or not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct BeltState {
    pub(super) radius: f64,
    /// φ = |θ|, rad.
    pub(super) turn: f64,
    /// a, rad; not above 0 where the belt is off the roll.
    pub(super) wrap: f64,
    /// ℓ, m.
    pub(super) length: f64,
    /// q1, q2, h1, m.
    pub(super) right_arm: f64,
    pub(super) left_arm: f64,
    pub(super) weight_arm: f64,
}

impl BeltState {
    /// q1 + q2.
    pub(super) fn both_arms(&self) -> f64 {
        self.right_arm + self.left_arm
    }

    /// dR/dφ along the roll.
    pub(super) fn radius_by_turn(&self) -> f64 {
        -self.both_arms() / self.wrap
    }
}

/// Where the parts of the frame are.
pub(super) struct FrameParts {
    /// Right pulley, from the roll's axis.
    pub(super) right: Vector2<f64>,
    /// Left pulley, from the roll's axis.
    pub(super) left: Vector2<f64>,
    /// Centre of gravity, from the pivot.
    pub(super) centre: Vector2<f64>,
}

pub(super) fn distance(from: Vector2<f64>, to: Vector2<f64>) -> f64 {
    libm::hypot(from.x - to.x, from.y - to.y)
}

pub(super) fn turned(part: Vector2<f64>, angle: f64) -> Vector2<f64> {
    let (sine, cosine) = libm::sincos(angle);
    Vector2::new(cosine * part.x - sine * part.y, sine * part.x + cosine * part.y)
}

/// N of a span: along the pulley's direction by R'/d, across it by ±S/d.
fn normal(pulley: Vector2<f64>, along: f64, across: f64, distance: f64) -> Vector2<f64> {
    let scale = 1.0 / (distance * distance);
    Vector2::new((along * pulley.x - across * pulley.y) * scale, (along * pulley.y + across * pulley.x) * scale)
}

/// Angle from the right pulley to the left about the roll's axis, 0…2π.
fn opening(right: Vector2<f64>, left: Vector2<f64>) -> f64 {
    let angle = libm::atan2(right.perp(&left), right.dot(&left));
    if angle < 0.0 { angle + TAU } else { angle }
}

impl Belt {
    /// The angle between the pulleys about the roll's axis at a turn, 0…2π.
    pub(super) fn opening_at(&self, turn: f64) -> f64 {
        let FrameParts { right, left, .. } = self.parts(turn);
        opening(right, left)
    }

    /// The belt of a frame at the largest radius of a roll, and its state there.
    pub(super) fn new(frame: &BrakeFrame, radius: f64) -> Result<(Self, BeltState), BrakeError> {
        let pivot = Vector2::from(frame.pivot);
        let mut belt = Self {
            pivot,
            right: Vector2::from(frame.right_pulley) - pivot,
            left: Vector2::from(frame.left_pulley) - pivot,
            centre: Vector2::from(frame.centre_of_gravity) - pivot,
            pulley_radius: frame.pulley_radius,
            side: 1.0,
            length: 0.0,
        };
        let first = belt.place(radius, 0.0)?;
        (belt.side, belt.length) = (if first.both_arms() < 0.0 { -1.0 } else { 1.0 }, first.length);
        Ok((belt, belt.place(radius, 0.0)?))
    }

    /// Where the parts of the frame are at a turn φ.
    pub(super) fn parts(&self, turn: f64) -> FrameParts {
        let angle = -self.side * turn;
        FrameParts {
            right: self.pivot + turned(self.right, angle),
            left: self.pivot + turned(self.left, angle),
            centre: turned(self.centre, angle),
        }
    }

    /// The state at a radius and a turn.
    ///
    /// # Errors
    /// [`BrakeError::PulleyMeetsRoll`] where a pulley reaches into the roll.
    pub(super) fn place(&self, radius: f64, turn: f64) -> Result<BeltState, BrakeError> {
        let FrameParts { right, left, centre } = self.parts(turn);
        let inner = radius + self.pulley_radius;
        let (d1, d2) = (libm::hypot(right.x, right.y), libm::hypot(left.x, left.y));
        for (pulley, distance) in [(Pulley::Right, d1), (Pulley::Left, d2)] {
            if !(distance > inner) {
                return Err(BrakeError::PulleyMeetsRoll { pulley, radius });
            }
        }
        let [s1, s2] = [d1, d2].map(|distance| ((distance - inner) * (distance + inner)).sqrt());
        let wrap = opening(right, left) - libm::atan2(s1, inner) - libm::atan2(s2, inner);
        let (n1, n2) = (normal(right, inner, s1, d1), normal(left, inner, -s2, d2));
        Ok(BeltState {
            radius,
            turn,
            wrap,
            length: inner * wrap + s1 + s2,
            right_arm: self.side * (radius - self.pivot.dot(&n1)),
            left_arm: self.side * (self.pivot.dot(&n2) - radius),
            weight_arm: self.side * centre.x,
        })
    }

    /// The rounding of the belt's length at a radius.
    fn rounding(&self, radius: f64) -> f64 {
        ROUNDING * (self.length + radius + self.pulley_radius)
    }

    /// The state at a turn, from a guess of its radius. ∂ℓ/∂R = a > 0 and ∂a/∂R = 1/S1 + 1/S2 > 0: there is one, and Newton's method
    /// converges from above; below, and where it leaves the bracket, that is halved.
    ///
    /// # Errors
    /// [`BrakeError::PulleyMeetsRoll`] if the belt is too long to close there, [`BrakeError::BeltLeavesRoll`] where it is too short.
    pub(super) fn at_turn(&self, turn: f64, guess: f64) -> Result<BeltState, BrakeError> {
        let FrameParts { right, left, .. } = self.parts(turn);
        let (d1, d2) = (libm::hypot(right.x, right.y), libm::hypot(left.x, left.y));
        let (mut low, mut high) = (-self.pulley_radius, d1.min(d2) - self.pulley_radius);
        let nearer = if d1 < d2 { Pulley::Right } else { Pulley::Left };
        let mut radius = if guess > low && guess < high { guess } else { 0.5 * (low + high) };
        let mut miss = f64::NAN;
        for _ in 0..MOST_STEPS {
            let place = self.place(radius, turn)?;
            miss = place.length - self.length;
            let on = place.wrap > 0.0;
            if on && miss.abs() <= self.rounding(radius) {
                return Ok(place);
            }
            if on && miss > 0.0 {
                high = radius;
            } else {
                low = radius;
            }
            let newton = radius - miss / place.wrap;
            let next = if on && newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - radius).abs() <= f64::EPSILON * (radius.abs() + self.pulley_radius) {
                break;
            }
            radius = next;
        }
        let place = self.place(radius, turn)?;
        if place.wrap > 0.0 && miss.abs() <= CLOSED * (self.length + radius.abs()) {
            Ok(place)
        } else if miss > 0.0 {
            Err(BrakeError::BeltLeavesRoll { radius })
        } else {
            Err(BrakeError::PulleyMeetsRoll { pulley: nearer, radius })
        }
    }

    /// The belt at a radius between two turns, at `low` too short or just fitting, at `high` too long; from a guess.
    pub(super) fn at_radius(&self, radius: f64, low: f64, high: f64, guess: f64) -> Result<BeltState, BrakeError> {
        let (mut low, mut high) = (low, high);
        let mut turn = guess.clamp(low, high);
        for _ in 0..MOST_STEPS {
            // With a pulley in the roll the needed length is infinite.
            let place = self.place(radius, turn).ok();
            let miss = place.map_or(f64::INFINITY, |place| place.length - self.length);
            if let Some(place) = place.filter(|_| miss.abs() <= self.rounding(radius)) {
                return Ok(place);
            }
            if miss > 0.0 {
                high = turn;
            } else {
                low = turn;
            }
            let newton = turn - miss / place.map_or(1.0, |place| place.both_arms());
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - turn).abs() <= f64::EPSILON * turn {
                break;
            }
            turn = next;
        }
        self.place(radius, turn)
    }
}

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
    pub(super) pivot: [f64; 2],
    /// From the pivot, at θ = 0: right pulley, left pulley, centre of gravity.
    pub(super) right: [f64; 2],
    pub(super) left: [f64; 2],
    pub(super) centre: [f64; 2],
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

pub(super) fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let ([ax, ay], [bx, by]) = (a, b);
    [ax - bx, ay - by]
}

pub(super) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    let ([ax, ay], [bx, by]) = (a, b);
    ax * bx + ay * by
}

fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    let ([ax, ay], [bx, by]) = (a, b);
    ax * by - ay * bx
}

pub(super) fn size(a: [f64; 2]) -> f64 {
    let [x, y] = a;
    libm::hypot(x, y)
}

fn turned([x, y]: [f64; 2], (sine, cosine): (f64, f64)) -> [f64; 2] {
    [cosine * x - sine * y, sine * x + cosine * y]
}

/// N of a span: along the pulley's direction by R'/d, across it by ±S/d.
fn normal([x, y]: [f64; 2], along: f64, across: f64, distance: f64) -> [f64; 2] {
    let scale = 1.0 / (distance * distance);
    [(along * x - across * y) * scale, (along * y + across * x) * scale]
}

/// Angle from the right pulley to the left about the roll's axis, 0…2π.
fn opening(right: [f64; 2], left: [f64; 2]) -> f64 {
    let angle = libm::atan2(cross(right, left), dot(right, left));
    if angle < 0.0 { angle + TAU } else { angle }
}

impl Belt {
    /// The angle between the pulleys about the roll's axis at a turn, 0…2π.
    pub(super) fn opening_at(&self, turn: f64) -> f64 {
        let [right, left, _] = self.parts(turn);
        opening(right, left)
    }

    /// The belt of a frame at the largest radius of a roll, and its place there.
    pub(super) fn new(frame: &BrakeFrame, radius: f64) -> Result<(Self, BeltState), BrakeError> {
        let mut belt = Self {
            pivot: frame.pivot,
            right: minus(frame.right_pulley, frame.pivot),
            left: minus(frame.left_pulley, frame.pivot),
            centre: minus(frame.centre_of_gravity, frame.pivot),
            pulley_radius: frame.pulley_radius,
            side: 1.0,
            length: 0.0,
        };
        let first = belt.place(radius, 0.0)?;
        (belt.side, belt.length) = (if first.both_arms() < 0.0 { -1.0 } else { 1.0 }, first.length);
        Ok((belt, belt.place(radius, 0.0)?))
    }

    /// Where the parts of the frame are at a turn φ: pulleys and centre of gravity from the roll's axis, the last from the pivot.
    pub(super) fn parts(&self, turn: f64) -> [[f64; 2]; 3] {
        let angle = libm::sincos(-self.side * turn);
        let [ox, oy] = self.pivot;
        let about = |part: [f64; 2]| {
            let [x, y] = turned(part, angle);
            [ox + x, oy + y]
        };
        [about(self.right), about(self.left), turned(self.centre, angle)]
    }

    /// The place at a radius and a turn.
    ///
    /// # Errors
    /// [`BrakeError::PulleyMeetsRoll`] where a pulley reaches into the roll.
    pub(super) fn place(&self, radius: f64, turn: f64) -> Result<BeltState, BrakeError> {
        let [right, left, [centre_x, _]] = self.parts(turn);
        let inner = radius + self.pulley_radius;
        let (d1, d2) = (size(right), size(left));
        for (pulley, distance) in [(Pulley::Right, d1), (Pulley::Left, d2)] {
            if !(distance > inner) {
                return Err(BrakeError::PulleyMeetsRoll { pulley, radius });
            }
        }
        let span = |distance: f64| ((distance - inner) * (distance + inner)).sqrt();
        let (s1, s2) = (span(d1), span(d2));
        let wrap = opening(right, left) - libm::atan2(s1, inner) - libm::atan2(s2, inner);
        let (n1, n2) = (normal(right, inner, s1, d1), normal(left, inner, -s2, d2));
        Ok(BeltState {
            radius,
            turn,
            wrap,
            length: inner * wrap + s1 + s2,
            right_arm: self.side * (radius - dot(self.pivot, n1)),
            left_arm: self.side * (dot(self.pivot, n2) - radius),
            weight_arm: self.side * centre_x,
        })
    }

    /// The rounding of the belt's length at a radius.
    fn rounding(&self, radius: f64) -> f64 {
        ROUNDING * (self.length + radius + self.pulley_radius)
    }

    /// The place at a turn, from a guess of its radius. ∂ℓ/∂R = a > 0 and ∂a/∂R = 1/S1 + 1/S2 > 0: there is one, and Newton's method
    /// converges from above; below, and where it leaves the bracket, that is halved.
    ///
    /// # Errors
    /// [`BrakeError::PulleyMeetsRoll`] where the belt is too long for the place, [`BrakeError::BeltLeavesRoll`] where it is too short.
    pub(super) fn at_turn(&self, turn: f64, guess: f64) -> Result<BeltState, BrakeError> {
        let [right, left, _] = self.parts(turn);
        let (mut low, mut high) = (-self.pulley_radius, size(right).min(size(left)) - self.pulley_radius);
        let nearer = if size(right) < size(left) { Pulley::Right } else { Pulley::Left };
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

    /// The place at a radius between two turns of which the first leaves the belt too short or just fitting, and the second too
    /// long; from a guess.
    pub(super) fn at_radius(&self, radius: f64, (low, high): (f64, f64), guess: f64) -> Result<BeltState, BrakeError> {
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

//! The bottom moved by a wedge cam, station by station, as in the paper: (18) with the slope by the backward
//! difference (25), solved for Δx at one overrun after the other.
//!
//! # The bracket
//!
//! With the slope (y − y₀)/h the right side of (18) grows with y as long as the flank does not jam: the air force grows,
//! and so does T. Written without the fraction, so that a jam is not a pole,
//!
//! ```text
//! G(y) = (A a − P) (s₋ − σ q) − P C (σ s₊ + q)/η
//! ```
//!
//! falls through zero once. At y₀, where σ = 0, the two laws of unequal efficiencies give the side: G > 0 as the rising
//! law has it means a root above, G < 0 as the falling law has it one below, and neither a lever that sticks, y = y₀. From
//! there the bracket is widened, doubling, until G has changed its sign, but never past the Δx at which the flank jams, the
//! roller moves along the bed or arm or column are used up: there the solution ends, see `wall`. Chandrupatla's method
//! ([`camgen_kernel::numeric::root`]) then closes in, superlinearly and never leaving the bracket.

use super::mechanism::{ARM_SHARE, ExactOn, Mechanism, Trend};
use super::wall;
use camgen_kernel::numeric::root;
use camgen_kernel::numeric::spline::Spline;
use camgen_kernel::refusal::{Refusal, WorkBound};

/// Share of the column, and of the distance to a jam, that is kept free.
const MARGIN: f64 = 1e-12;
/// sin θ below which it is the bed's line, not friction, that stops the flank.
const IN_LINE: f64 = 1e-3;
/// First width of the bracket over the step in x, and doublings from there: far past any wall.
const FIRST_WIDTH: f64 = 0.05;
const DOUBLINGS: u32 = 80;

/// Stations of a solution.
const STATIONS: WorkBound = WorkBound { what: "stations", most: 300_000 };

/// Stations with the bottom's Δx.
#[derive(Debug, Clone, PartialEq)]
pub struct Stations {
    /// Overruns, m, from 0 to r.
    pub overruns: Vec<f64>,
    /// Δx there, m.
    pub bottoms: Vec<f64>,
    spline: Spline,
}

impl Stations {
    /// Solves (18) at `count` stations equally spaced in x, after the one at x = 0.
    ///
    /// # Errors
    /// The wall that a station runs into.
    pub fn new(mechanism: &Mechanism, count: u32) -> Result<Self, Refusal> {
        STATIONS.allow(usize::try_from(count).unwrap_or(usize::MAX))?;
        let stroke = mechanism.bottom_law.stroke();
        let (mut overruns, mut bottoms) = (vec![0.0], vec![0.0]);
        let (mut before, mut bottom) = (0.0, 0.0);
        for station in 1..=count {
            let x = stroke * (f64::from(station) / f64::from(count));
            bottom = solve(mechanism, x, x - before, bottom)?;
            overruns.push(x);
            bottoms.push(bottom);
            before = x;
        }
        let spline = Spline::not_a_knot(&overruns, &bottoms);
        Ok(Self { overruns, bottoms, spline })
    }

    /// Δx and its first three derivatives by x, SI: a cubic spline through the stations.
    #[must_use]
    pub fn at(&self, x: f64) -> [f64; 4] {
        self.spline.values_at(x)
    }
}

/// A station: (18) with the slope by the backward difference.
struct StationEquation<'a> {
    mechanism: &'a Mechanism,
    x: f64,
    step: f64,
    before: f64,
    q: f64,
}

impl StationEquation<'_> {
    /// The margin until the flank jams, and until the roller moves along the bed's line, for the directions in which the
    /// forces balance.
    fn free(&self, y: f64) -> f64 {
        let lever = self.mechanism.lever(y);
        let sigma = (y - self.before) / (self.step * lever.ratio);
        let (braking, returning) = (lever.minus - sigma * self.q, lever.plus + sigma * self.q);
        match self.mechanism.exact_on {
            ExactOn::Braking => braking,
            ExactOn::Return => returning,
            ExactOn::Mean => braking.min(returning),
        }
    }

    /// G with the efficiencies of a side.
    fn remainder(&self, y: f64, side: Trend) -> f64 {
        let (mechanism, q) = (self.mechanism, self.q);
        let lever = mechanism.lever(y);
        let sigma = (y - self.before) / (self.step * lever.ratio);
        let (braking, returning) = mechanism.efficiencies(side);
        let (air, load, c) = (mechanism.air(self.x, y), mechanism.load(self.x), lever.ratio);
        let in_way = |plus: f64, minus: f64, q: f64, eta: f64| {
            (load - air) * (minus - sigma * q) - air * c * (sigma * plus + q) / eta
        };
        match mechanism.exact_on {
            ExactOn::Braking => in_way(lever.plus, lever.minus, q, braking),
            ExactOn::Return => in_way(lever.minus, lever.plus, -q, returning),
            ExactOn::Mean => {
                let (first, second) = (lever.minus - sigma * q, lever.plus + sigma * q);
                in_way(lever.plus, lever.minus, q, braking) * second
                    + in_way(lever.minus, lever.plus, -q, returning) * first
            }
        }
    }

    /// Δx at which the air is used up.
    fn column(&self) -> f64 {
        self.mechanism.bottom_law.column() * (1.0 - MARGIN) - self.x
    }

    /// The furthest Δx on a side before the solution ends, and why it ends there.
    fn furthest(&self, side: Trend) -> (f64, fn(&Self) -> Refusal) {
        let m = self.mechanism;
        let (line, arm) = (m.furthest_before_line(side), ARM_SHARE * m.bottom_arm);
        let sign = if side == Trend::Falling { -1.0 } else { 1.0 };
        let mut least: (f64, fn(&Self) -> Refusal) =
            (arm, |station| wall::arm(station.x, station.mechanism.bottom_arm));
        if line < arm {
            least = (line, |station| wall::line(station.x));
        }
        let column = self.column();
        if side == Trend::Rising && column < least.0 {
            least = (column, |station| wall::column(station.x));
        }
        (sign * least.0, least.1)
    }

    fn solve(&self) -> Result<f64, Refusal> {
        if !(self.free(self.before) > 0.0) {
            return Err(wall::jam(self.x));
        }
        // Where the piston would meet the bottom at rest the air drives it back.
        let start = self.before.min(self.column());
        let (side, sign) = if start < self.before {
            if !(self.remainder(start, Trend::Falling) < 0.0) {
                return Err(wall::column(self.x));
            }
            (Trend::Falling, -1.0)
        } else if self.remainder(self.before, Trend::Rising) > 0.0 {
            (Trend::Rising, 1.0)
        } else if self.remainder(self.before, Trend::Falling) < 0.0 {
            (Trend::Falling, -1.0)
        } else {
            return Ok(self.before);
        };
        let (furthest, end) = self.furthest(side);
        let mut near = start;
        let mut width = FIRST_WIDTH * self.step;
        for _ in 0..DOUBLINGS {
            let mut far = start + sign * width;
            let at_wall = sign * (far - furthest) >= 0.0;
            if at_wall {
                far = furthest;
            }
            let mut jams = false;
            if !(self.free(far) > 0.0) {
                let jam = root::bracketed(|y| self.free(y), near, far, 0.0).unwrap_or(near);
                far = jam + (near - jam) * MARGIN.sqrt();
                jams = true;
            }
            if sign * self.remainder(far, side) <= 0.0 {
                let root = root::bracketed(|y| self.remainder(y, side), near, far, 0.0);
                return root.map_err(|_| wall::unnamed(self.x));
            }
            if jams {
                let in_line = self.mechanism.lever(far).sine < IN_LINE;
                return Err(if in_line { wall::line(self.x) } else { wall::jam(self.x) });
            }
            if at_wall {
                return Err(end(self));
            }
            near = far;
            width *= 2.0;
        }
        Err(wall::unnamed(self.x))
    }
}

/// Δx at the overrun x, a step after a station with the bottom at `before`.
fn solve(mechanism: &Mechanism, x: f64, step: f64, before: f64) -> Result<f64, Refusal> {
    StationEquation { mechanism, x, step, before, q: libm::sin(mechanism.friction_angle) }.solve()
}

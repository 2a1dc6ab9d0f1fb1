//! The bottom of a translating cam station by station, as the paper has it: (18) with the slope by the backward
//! difference (25), solved for Δx at one overrun after the other.
//!
//! # The bracket
//!
//! With the slope (y − y₀)/h, right less left side of (18) grows with y as long as the flank does not jam: the air force
//! grows, and so does T. Written without the fraction, so that the jam is no pole,
//!
//! ```text
//! G(y) = (A x − P) (s₋ − σ q) − P C (σ s₊ + q)/η
//! ```
//!
//! At y = −x there is no air force and G = A x (s₋ − σ q) > 0. Where the flank jams, s₋ = σ q, G = −P C (σ s₊ + q)/η < 0;
//! that place is bracketed first, between y₀, where σ = 0, and the end of arm or column; where the flank cannot jam the
//! column ends the bracket, P → ∞. Between the two the sign changes once, and Chandrupatla's method
//! ([`crate::numeric::root`]) closes in on it, superlinearly and never leaving the bracket. With unequal efficiencies G
//! jumps down at σ = 0; a change of sign in the jump is a lever that sticks, y = y₀.

use super::equation::{Exact, Mechanism, Side};
use super::wall::Wall;
use crate::numeric::root;
use crate::numeric::spline::Spline;

/// Share of arm and column that is kept free at the ends of a bracket.
const MARGIN: f64 = 1e-12;

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
    /// The [`Wall`] a station runs into.
    pub fn new(mechanism: &Mechanism, count: u32) -> Result<Self, Wall> {
        let stroke = mechanism.balance.stroke;
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
        self.spline.at(x)
    }
}

/// Δx at the overrun x, a step h after a station with the bottom at `before`.
fn solve(mechanism: &Mechanism, x: f64, step: f64, before: f64) -> Result<f64, Wall> {
    let x_mm = 1e3 * x;
    let q = libm::sin(mechanism.friction_angle);
    let (arm, column) = (mechanism.bottom_arm * (1.0 - MARGIN), mechanism.balance.column * (1.0 - MARGIN));
    let low = (-x).max(-arm);
    let high = (column - x).min(arm);
    if !(high > before.max(low)) {
        return Err(Wall::Column { x_mm });
    }
    let sigma = |y: f64, ratio: f64| (y - before) / (step * ratio);
    // What is left until the flank jams, for either direction of the friction.
    let free = |y: f64| {
        let lever = mechanism.lever(y);
        let sigma = sigma(y, lever.ratio);
        match mechanism.exact {
            Exact::Braking => lever.minus - sigma * q,
            Exact::Return => lever.plus + sigma * q,
            Exact::Mean => (lever.minus - sigma * q).min(lever.plus + sigma * q),
        }
    };
    if !(free(before) > 0.0) {
        return Err(Wall::Jam { x_mm });
    }
    let jam = |from: f64, to: f64| {
        if free(to) > 0.0 { to } else { root::bracketed(free, from, to, 0.0).unwrap_or(from) }
    };
    let (low, high) = (jam(before.max(low), low), jam(before, high));
    let remainder = |y: f64| {
        let lever = mechanism.lever(y);
        let sigma = sigma(y, lever.ratio);
        let side = if y > before { Side::Rising } else { Side::Falling };
        let (braking, returning) = mechanism.efficiencies(side);
        let (air, load, c) = (mechanism.air(x, y), mechanism.balance.loading * x, lever.ratio);
        let in_way = |plus: f64, minus: f64, q: f64, eta: f64| {
            (load - air) * (minus - sigma * q) - air * c * (sigma * plus + q) / eta
        };
        match mechanism.exact {
            Exact::Braking => in_way(lever.plus, lever.minus, q, braking),
            Exact::Return => in_way(lever.minus, lever.plus, -q, returning),
            Exact::Mean => {
                let (first, second) = (lever.minus - sigma * q, lever.plus + sigma * q);
                in_way(lever.plus, lever.minus, q, braking) * second
                    + in_way(lever.minus, lever.plus, -q, returning) * first
            }
        }
    };
    root::bracketed(remainder, low, high, 0.0).map_err(|_| Wall::Jam { x_mm })
}

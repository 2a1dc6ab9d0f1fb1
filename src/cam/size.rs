//! The smallest prime radius that keeps every limit, solved.

use super::{Curves, extremes};
use crate::follower::Follower;
use crate::law::Law;
use crate::numeric::root;

/// What a radius must keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Required {
    /// Largest |pressure angle|, rad.
    pub pressure_angle: f64,
    /// Smallest convex radius of the pitch curve, m.
    pub convex_pitch_radius: f64,
    /// Prime radius below which nothing is tried, m.
    pub least: f64,
}

/// Doublings from the least radius before giving up: 1 µm to 1e9 m.
const DOUBLINGS: u32 = 50;

/// Rounds of solving each limit in turn. A limit may be broken anew by the radius another one asked for only where it
/// is not monotone in the radius; each round then starts above the last.
const ROUNDS: u32 = 8;

/// No radius keeps the limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("no base radius keeps the limits")]
pub struct NoRadius;

/// The smallest prime radius (m) at which the disc made by `follower` keeps every limit.
///
/// Both the pressure angle and the curvature fall as the radius grows, so each limit is a root in the radius.
///
/// # Errors
/// [`NoRadius`] when no radius up to 1e9 m does.
pub fn smallest_prime_radius<L: Law, F: Follower>(
    law: &L,
    follower: impl Fn(f64) -> F,
    required: &Required,
) -> Result<f64, NoRadius> {
    let curves = |radius: f64| Curves { law, follower: follower(radius) };
    let pressure = |radius: f64| extremes::pressure_angle(&curves(radius)).value - required.pressure_angle;
    let curvature =
        |radius: f64| extremes::convex_pitch_curvature(&curves(radius)).value * required.convex_pitch_radius - 1.0;
    let limits: [&dyn Fn(f64) -> f64; 2] = [&pressure, &curvature];
    let mut radius = required.least;
    for _ in 0..ROUNDS {
        for limit in limits {
            radius = first_at_or_above(radius, limit)?;
        }
        if limits.iter().all(|limit| limit(radius) <= 0.0) {
            return Ok(radius);
        }
    }
    Err(NoRadius)
}

/// The first radius from `low` on at which `excess` is not positive.
fn first_at_or_above(low: f64, excess: impl Fn(f64) -> f64) -> Result<f64, NoRadius> {
    // A NaN is no pass: it says that the curve does not exist at this radius.
    if excess(low) <= 0.0 {
        return Ok(low);
    }
    let (mut failing, mut passing) = (low, 2.0 * low);
    for _ in 0..DOUBLINGS {
        if excess(passing) <= 0.0 {
            let mut radius = root::bracketed(&excess, failing, passing, 0.0).map_err(|_| NoRadius)?;
            // The root is known to an ulp; stand on the side that passes.
            while excess(radius) > 0.0 && radius < passing {
                radius *= 1.0 + 4.0 * f64::EPSILON;
            }
            return Ok(radius);
        }
        (failing, passing) = (passing, 2.0 * passing);
    }
    Err(NoRadius)
}

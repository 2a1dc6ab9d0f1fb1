//! The smallest prime radius that keeps every limit, solved.

use super::{Curves, extremes, lifts};
use crate::follower::{Element, Follower};
use crate::machine::{CamData, Limits};
use crate::motion::Motion;
use crate::numeric::root;

/// Whole millimetres an automatic base radius is rounded up to, m; rounding noise of 1 nm is not a millimetre.
const BASE_STEP: f64 = 1e-3;
const BASE_STEP_NOISE: f64 = 1e-6;

/// What a radius must keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Required {
    /// Largest |pressure angle|, rad.
    pub pressure_angle: f64,
    /// Smallest convex radius of the follower's curve, m.
    pub convex_radius: f64,
    /// Prime radius below which nothing is tried, m.
    pub least: f64,
}

impl Required {
    /// What the limits of a machine file and the bore require of a disc under a follower.
    #[must_use]
    pub fn of(limits: &Limits, cam: &CamData, follower: &dyn Follower) -> Self {
        let offset = follower.element().offset();
        // Without a limit for the wall there must still be some.
        let wall = if limits.wall > 0.0 { limits.wall } else { BASE_STEP };
        let least_base = cam.bore_reach().map_or(BASE_STEP, |reach| reach + wall);
        Self {
            pressure_angle: limits.pressure_angle,
            convex_radius: limits.min_convex_pitch_radius_over_roller.max(1.0) * offset,
            least: (least_base + offset).max(follower.prime_radii().0),
        }
    }
}

/// The base radius that `auto` makes of the smallest one, m: the next whole millimetre.
#[must_use]
pub fn rounded_up(base_radius: f64) -> f64 {
    let steps = (base_radius / BASE_STEP - BASE_STEP_NOISE).ceil();
    // A quotient keeps "69 mm" the number nearest to 0.069.
    steps / (1.0 / BASE_STEP)
}

/// Doublings from the least radius before giving up: 1 µm to 1e9 m.
const DOUBLINGS: u32 = 50;

/// Growth from one radius to the next under a follower whose reach is limited: what passes may lie between two that do not.
const STEP_IN_REACH: f64 = 1.01;
/// As many of these as doublings would be: 1.01 to the 3500 is 2 to the 50.
const STEPS_IN_REACH: u32 = 3500;

/// Rounds of solving each limit in turn. A limit may be broken again by the radius that another one needs only where it
/// is not monotone in the radius; each round then starts above the last.
const ROUNDS: u32 = 8;

/// No radius keeps the limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("no base radius keeps the limits")]
pub struct NoRadius;

/// The largest lift that a follower of limited reach has to follow, m or rad; any other can follow every lift.
#[must_use]
pub fn largest_lift_in_reach(motion: &dyn Motion, follower: &dyn Follower) -> f64 {
    if follower.reach().1.is_finite() { lifts(motion).1 } else { 0.0 }
}

/// The smallest prime radius (m) at which the disc made by the follower keeps every limit.
///
/// Both the pressure angle and the curvature fall as the radius grows, so each limit is a root in the radius.
///
/// # Errors
/// [`NoRadius`] when no radius up to 1e9 m does.
pub fn smallest_prime_radius(
    motion: &dyn Motion,
    follower: &dyn Follower,
    required: &Required,
) -> Result<f64, NoRadius> {
    let top = largest_lift_in_reach(motion, follower);
    // Out of reach does not pass.
    let at = |radius: f64, excess: &dyn Fn(Curves<'_>) -> f64| {
        let follower = follower.sized(radius).filter(|follower| top <= follower.reach().1);
        follower.map_or(f64::NAN, |follower| excess(Curves { motion, follower: &*follower }))
    };
    let pressure = |radius: f64| at(radius, &|curves| extremes::pressure_angle(curves).value - required.pressure_angle);
    let curvature = |radius: f64| {
        at(radius, &|curves| match curves.element() {
            Element::Roller { .. } => extremes::convex_curvature(curves).value * required.convex_radius - 1.0,
            // The profile under a face must not turn back on itself.
            Element::Face => -extremes::least_radius(curves).value / radius,
        })
    };
    let limits: [&dyn Fn(f64) -> f64; 2] = [&pressure, &curvature];
    let largest = follower.prime_radii().1;
    let mut radius = required.least;
    for _ in 0..ROUNDS {
        for limit in limits {
            radius = first_at_or_above(radius, largest, limit)?;
        }
        if limits.iter().all(|limit| limit(radius) <= 0.0) {
            return Ok(radius);
        }
    }
    Err(NoRadius)
}

/// The first radius from `low` on at which `excess` is not positive.
fn first_at_or_above(low: f64, largest: f64, excess: impl Fn(f64) -> f64) -> Result<f64, NoRadius> {
    // A NaN does not pass: the curve does not exist at this radius.
    if excess(low) <= 0.0 {
        return Ok(low);
    }
    let (growth, steps) = if largest.is_finite() { (STEP_IN_REACH, STEPS_IN_REACH) } else { (2.0, DOUBLINGS) };
    let (mut failing, mut passing) = (low, growth * low);
    for _ in 0..steps {
        if excess(passing) <= 0.0 {
            // Where the radius before is out of reach there is no sign to bracket: this one is the first known to pass.
            if excess(failing).is_nan() {
                return Ok(passing);
            }
            let mut radius = root::bracketed(&excess, failing, passing, 0.0).map_err(|_| NoRadius)?;
            // The root is known to an ulp; take the side that passes.
            while excess(radius) > 0.0 && radius < passing {
                radius *= 1.0 + 4.0 * f64::EPSILON;
            }
            return Ok(radius);
        }
        (failing, passing) = (passing, growth * passing);
    }
    Err(NoRadius)
}

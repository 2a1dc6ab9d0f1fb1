//! By how much thicker a shaft would keep a limit.

use super::{Found, yielding};
use crate::numeric::root;
use crate::shaft::exact;

/// A shaft so many times as thick at the most.
const LARGEST: f64 = 8.0;
/// From one that is tried to the next.
const GROWTH: f64 = 1.08;
/// Digits of a factor, rounded upwards.
const DIGITS: f64 = 1e3;

/// The smallest factor on every diameter at which a function of it is not above 0, rounded upwards; `None` where none is found up to the
/// largest. A very thick shaft may be too heavy for its supports, so that it is looked for from below.
fn factor(excess: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let value = |factor: f64| excess(factor).unwrap_or(f64::NAN);
    let tried = std::iter::successors(Some(GROWTH), |factor| Some(factor * GROWTH));
    let passing = tried.take_while(|factor| *factor <= LARGEST).find(|factor| value(*factor) <= 0.0)?;
    let found = root::bracketed(value, passing / GROWTH, passing, 1e-9).ok()?;
    let rounded = (found * DIGITS).ceil() / DIGITS;
    Some(if value(rounded) <= 0.0 { rounded } else { passing })
}

/// For a first critical speed (rad/s) at the least.
pub(super) fn for_speed(found: &Found<'_>, least: f64) -> Option<f64> {
    factor(|factor| {
        let shaft = found.shaft.scaled(factor).ok()?;
        let modes = exact::modes(&shaft, found.asked.whirl, 1, None).ok()?;
        Some(least - modes.modes.first()?.speed)
    })
}

/// For a lift error (m) at the most.
pub(super) fn for_lift(found: &Found<'_>, most: f64) -> Option<f64> {
    let under = found.under.as_ref()?;
    factor(|factor| Some(under.lift_on(&yielding(found, factor)?.0) - most))
}

/// For a slope (rad) at the supports at the most.
pub(super) fn for_slope(found: &Found<'_>, most: f64) -> Option<f64> {
    let under = found.under.as_ref()?;
    factor(|factor| Some(under.slope_on(&yielding(found, factor)?, &found.shaft) - most))
}

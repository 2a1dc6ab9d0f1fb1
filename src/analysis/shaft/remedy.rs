//! By how much thicker a shaft would keep a limit.

use super::{Found, yielding};
use crate::numeric::root;
use crate::shaft::exact;

/// A shaft so many times as thick at the most.
const LARGEST: f64 = 8.0;
/// Digits of a factor, rounded upwards.
const DIGITS: f64 = 1e3;

/// The factor on every diameter at which a function of it falls to 0, rounded upwards; `None` where none up to the largest does.
fn factor(excess: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let value = |factor: f64| excess(factor).unwrap_or(f64::NAN);
    if !(value(LARGEST) <= 0.0) {
        return None;
    }
    let found = root::bracketed(value, 1.0, LARGEST, 1e-9).ok()?;
    Some((found * DIGITS).ceil() / DIGITS)
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

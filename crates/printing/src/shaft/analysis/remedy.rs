//! By how much thicker a shaft would keep a limit.

use super::load::CamOnShaft;
use super::{ShaftResults, discs, yielding};
use crate::shaft::mechanics::{Whirl, exact};
use camgen_kernel::numeric::root;
use std::f64::consts::PI;

/// Largest factor on the diameters of the shaft.
const LARGEST: f64 = 8.0;
/// From one that is tried to the next.
const GROWTH: f64 = 1.08;
/// Digits of a factor, rounded upwards.
const DIGITS: f64 = 1e3;

/// The smallest factor on every diameter at which a function of it is not above 0, rounded upwards; `None` where no factor up to the
/// largest will do. A very thick shaft may be too heavy for its supports, so the search starts with the smallest.
fn factor(excess: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let tried = std::iter::successors(Some(GROWTH), |factor| Some(factor * GROWTH));
    let mut tried = tried.take_while(|factor| *factor <= LARGEST);
    let passing = tried.find(|factor| excess(*factor).is_some_and(|excess| excess <= 0.0))?;
    let from = passing / GROWTH;
    let found = root::bracketed(|factor| excess(factor).unwrap_or(f64::NAN), from, passing, 1e-9).ok()?;
    let rounded = (found * DIGITS).ceil() / DIGITS;
    Some(if excess(rounded).is_some_and(|excess| excess <= 0.0) { rounded } else { passing })
}

/// For a first critical speed (rad/s) at least.
pub(super) fn for_speed(found: &ShaftResults<'_>, least: f64) -> Option<f64> {
    factor(|factor| {
        let shaft = found.shaft.scaled(factor).ok()?;
        let modes = exact::modes(&shaft, Whirl::Forward, 1, None).ok()?;
        Some(least - modes.modes.first()?.speed)
    })
}

/// Tries for a speed that passes.
const TRIES: usize = 8;

/// A speed of the main shaft, or of a shaft alone, rpm, that keeps the limit of the critical speed; another speed may have another cam,
/// so that each is tried.
pub(super) fn slower(found: &ShaftResults<'_>) -> Option<f64> {
    let limit = found.machine.limits.critical_speed_ratio;
    let own = found.carried.as_ref().map_or(&found.asked.rpm, |carried| &carried.rpm);
    let (highest, mut ratio) = (own.iter().copied().fold(0.0, f64::max), found.speed? / found.spectrum.forward);
    let mut rpm = highest;
    for _ in 0..TRIES {
        rpm = rounded_down(rpm * limit / ratio);
        if own.len() > 1 {
            return Some(rpm);
        }
        let (shaft, speed) = match CamOnShaft::solve(found.machine, &[rpm]).ok()? {
            None => (found.shaft.clone(), rpm * PI / 30.0),
            Some(carried) => {
                (found.machine.data.shaft.with_discs(discs(found.machine, &carried)).ok()?, carried.speed?)
            }
        };
        ratio = speed / exact::modes(&shaft, Whirl::Forward, 1, None).ok()?.modes.first()?.speed;
        if ratio <= limit {
            return Some(rpm);
        }
    }
    None
}

/// Rounded down to four digits.
fn rounded_down(value: f64) -> f64 {
    let digit = libm::pow(10.0, 3.0 - libm::log10(value).floor());
    (value * digit).floor() / digit
}

/// For a lift error (m) at most.
pub(super) fn for_lift(found: &ShaftResults<'_>, most: f64) -> Option<f64> {
    let under = found.under.as_ref()?;
    factor(|factor| Some(under.lift_on(&yielding(found, factor)?.0) - most))
}

/// For a slope (rad) at the supports at most.
pub(super) fn for_slope(found: &ShaftResults<'_>, most: f64) -> Option<f64> {
    let under = found.under.as_ref()?;
    factor(|factor| {
        let (yielding, statics) = yielding(found, factor)?;
        Some(under.slope_on(&yielding, &statics, &found.shaft) - most)
    })
}

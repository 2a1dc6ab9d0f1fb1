//! Limits of a shaft's input, checked before any computation.

use super::error::out_of_range;
use super::panels::{Panels, SAME_PLACE};
use super::{LEAST_DISTANCE, MOST_PANELS, Shaft, ShaftDisc, ShaftSegment, Support};
use camgen_kernel::refusal::Refusal;
use std::fmt::Display;

/// Rounding of a decimal number and of its double: I_p of a thin disc is 2 I_t.
const ROUNDING: f64 = 1e-9;

/// Panels are made last: they want everything else in order.
pub(super) fn check(shaft: &Shaft) -> Result<(), Refusal> {
    if shaft.segments().is_empty() {
        return Err(Refusal::new("the shaft has no segment").remedy("it needs at least one"));
    }
    shaft.segments().iter().enumerate().try_for_each(|(index, segment)| check_segment(index, segment))?;
    let length = shaft.length();
    if !length.is_finite() {
        return Err(out_of_range());
    }
    shaft.supports().iter().enumerate().try_for_each(|(index, support)| check_support(index, support, length))?;
    check_apart(shaft.supports())?;
    shaft.discs().iter().enumerate().try_for_each(|(index, disc)| check_disc(index, disc, length))
}

/// Checks the merged shaft.
pub(super) fn check_panels(shaft: &Shaft) -> Result<(), Refusal> {
    let found = Panels::new(shaft, &[]).panels.len();
    if found <= MOST_PANELS {
        return Ok(());
    }
    Err(Refusal::new(format!("the shaft has {found} panels between its steps, supports and discs"))
        .remedy(format!("it may have {MOST_PANELS} at most")))
}

/// Refuses a value (SI) of a part that does not fit, with what would.
fn required(fits: bool, name: &str, part: impl Display, value: f64, range: &str) -> Result<(), Refusal> {
    if fits {
        return Ok(());
    }
    Err(Refusal::new(format!("the {name} of {part} is {value}")).remedy(format!("it must be {range}")))
}

fn positive(part: impl Display, name: &str, value: f64) -> Result<(), Refusal> {
    required(value > 0.0 && value.is_finite(), name, part, value, "a number above 0")
}

fn not_negative(part: impl Display, name: &str, value: f64) -> Result<(), Refusal> {
    required(value >= 0.0 && value.is_finite(), name, part, value, "a number of at least 0")
}

/// A position on a shaft of this length; past its end by no more than the rounding of a sum of lengths.
pub(super) fn within(part: impl Display, at: f64, length: f64) -> Result<(), Refusal> {
    let past = SAME_PLACE * length;
    if at >= -past && at <= length + past {
        return Ok(());
    }
    Err(Refusal::new(format!("{part} is at {at} m"))
        .remedy(format!("it must be within 0…{length} m, the length of the shaft")))
}

fn check_segment(index: usize, segment: &ShaftSegment) -> Result<(), Refusal> {
    let ShaftSegment { length, diameter, bore, modulus, density, poisson } = *segment;
    let number = index + 1;
    let part = format_args!("segment {number}");
    for (name, value) in [("length", length), ("diameter", diameter), ("modulus", modulus)] {
        positive(part, name, value)?;
    }
    for (name, value) in [("bore", bore), ("density", density)] {
        not_negative(part, name, value)?;
    }
    if bore >= diameter {
        return Err(Refusal::new(format!("{part} has a bore of {bore} m in a diameter of {diameter} m"))
            .remedy("the bore must be smaller"));
    }
    // −1 < ν ≤ ½: no elastic material has another one.
    required(poisson > -1.0 && poisson <= 0.5, "Poisson's ratio", part, poisson, "above -1 and at most 0.5")?;
    // The fourth power of a diameter in the wrong unit overflows; a bore next to the diameter leaves an area of 0.
    let made = [segment.second_moment(), segment.second_moment() * modulus, segment.area(), segment.mass()];
    let fits = made.iter().take(3).all(|value| *value > 0.0) && made.iter().all(|value| value.is_finite());
    if fits { Ok(()) } else { Err(out_of_range()) }
}

fn check_support(index: usize, support: &Support, length: f64) -> Result<(), Refusal> {
    let number = index + 1;
    within(format_args!("support {number}"), support.at, length)?;
    support.stiffness.map_or(Ok(()), |stiffness| positive(format_args!("support {number}"), "stiffness", stiffness))
}

fn check_apart(supports: &[Support]) -> Result<(), Refusal> {
    if supports.len() < 2 {
        return Err(Refusal::new(format!("the shaft has {} supports", supports.len())).remedy("it needs at least two"));
    }
    let mut order: Vec<(usize, f64)> = supports.iter().map(|support| support.at).enumerate().collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1));
    for ((first, at), (second, next)) in order.iter().copied().zip(order.iter().copied().skip(1)) {
        let distance = next - at;
        if distance <= LEAST_DISTANCE {
            let (first, second) = (first + 1, second + 1);
            return Err(Refusal::new(format!("supports {first} and {second} are {distance} m apart"))
                .at(format!("{at} m"))
                .remedy(format!("they must be more than {LEAST_DISTANCE} m apart")));
        }
    }
    Ok(())
}

fn check_disc(index: usize, disc: &ShaftDisc, length: f64) -> Result<(), Refusal> {
    let number = index + 1;
    let part = format_args!("disc {number}");
    within(part, disc.at, length)?;
    let inertias = [("diametral inertia", disc.diametral_inertia), ("polar inertia", disc.polar_inertia)];
    for (name, value) in [("mass", disc.mass)].into_iter().chain(inertias) {
        not_negative(part, name, value)?;
    }
    for value in disc.unbalance {
        required(value.is_finite(), "unbalance", part, value, "a number")?;
    }
    // I_p = ∫ r² dm = 2 I_t − 2 ∫ x² dm of any body.
    let most = 2.0 * disc.diametral_inertia;
    if disc.polar_inertia > most * (1.0 + ROUNDING) {
        let polar = disc.polar_inertia;
        return Err(Refusal::new(format!(
            "{part} has a polar inertia of {polar} kg m², more than twice its diametral one"
        ))
        .remedy(format!("it can be at most {most} kg m²")));
    }
    Ok(())
}

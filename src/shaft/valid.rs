//! What a shaft must be before anything is asked about it.

use super::panels::{Panels, SAME_PLACE};
use super::{Disc, LEAST_DISTANCE, MOST_PANELS, Part, Segment, Shaft, ShaftError, Support};

/// Rounding of a decimal number and of its double: I_p of a thin disc is 2 I_t.
const ROUNDING: f64 = 1e-9;

/// Panels are made last: they want everything else in order.
pub(super) fn check(shaft: &Shaft) -> Result<(), ShaftError> {
    if shaft.segments().is_empty() {
        return Err(ShaftError::NoSegments);
    }
    shaft.segments().iter().enumerate().try_for_each(|(index, segment)| check_segment(index, segment))?;
    let length = shaft.length();
    if !length.is_finite() {
        return Err(ShaftError::Range);
    }
    shaft.supports().iter().enumerate().try_for_each(|(index, support)| check_support(index, support, length))?;
    check_apart(shaft.supports())?;
    shaft.discs().iter().enumerate().try_for_each(|(index, disc)| check_disc(index, disc, length))
}

/// Of the merged shaft.
pub(super) fn check_panels(shaft: &Shaft) -> Result<(), ShaftError> {
    let found = Panels::new(shaft, &[]).panels.len();
    if found > MOST_PANELS { Err(ShaftError::Panels { found }) } else { Ok(()) }
}

fn positive(part: Part, index: usize, name: &'static str, value: f64) -> Result<(), ShaftError> {
    if value > 0.0 && value.is_finite() { Ok(()) } else { Err(ShaftError::NotPositive { part, index, name, value }) }
}

fn not_negative(part: Part, index: usize, name: &'static str, value: f64) -> Result<(), ShaftError> {
    if value >= 0.0 && value.is_finite() { Ok(()) } else { Err(ShaftError::Negative { part, index, name, value }) }
}

/// A place on a shaft of this length; past its end by no more than the rounding of a sum of lengths.
pub(super) fn within(part: Part, index: usize, at: f64, length: f64) -> Result<(), ShaftError> {
    let past = SAME_PLACE * length;
    if at >= -past && at <= length + past { Ok(()) } else { Err(ShaftError::Outside { part, index, at, length }) }
}

fn check_segment(index: usize, segment: &Segment) -> Result<(), ShaftError> {
    let Segment { length, diameter, bore, modulus, density, poisson } = *segment;
    for (name, value) in [("length", length), ("diameter", diameter), ("modulus", modulus)] {
        positive(Part::Segment, index, name, value)?;
    }
    for (name, value) in [("bore", bore), ("density", density)] {
        not_negative(Part::Segment, index, name, value)?;
    }
    if bore >= diameter {
        return Err(ShaftError::Bore { index, bore, diameter });
    }
    if !(poisson > -1.0 && poisson <= 0.5) {
        return Err(ShaftError::Poisson { index, value: poisson });
    }
    // The fourth power of a diameter in the wrong unit overflows; a bore next to the diameter leaves an area of 0.
    let made = [segment.second_moment(), segment.second_moment() * modulus, segment.area(), segment.mass()];
    let fits = made.iter().take(3).all(|value| *value > 0.0) && made.iter().all(|value| value.is_finite());
    if fits { Ok(()) } else { Err(ShaftError::Range) }
}

fn check_support(index: usize, support: &Support, length: f64) -> Result<(), ShaftError> {
    within(Part::Support, index, support.at, length)?;
    support.stiffness.map_or(Ok(()), |stiffness| positive(Part::Support, index, "stiffness", stiffness))
}

fn check_apart(supports: &[Support]) -> Result<(), ShaftError> {
    if supports.len() < 2 {
        return Err(ShaftError::FewSupports { found: supports.len() });
    }
    let mut order: Vec<(usize, f64)> = supports.iter().map(|support| support.at).enumerate().collect();
    order.sort_by(|a, b| a.1.total_cmp(&b.1));
    for ((first, at), (second, next)) in order.iter().copied().zip(order.iter().copied().skip(1)) {
        let distance = next - at;
        if distance <= LEAST_DISTANCE {
            return Err(ShaftError::SupportsTogether { first, second, at, distance });
        }
    }
    Ok(())
}

fn check_disc(index: usize, disc: &Disc, length: f64) -> Result<(), ShaftError> {
    within(Part::Disc, index, disc.at, length)?;
    let inertias = [("diametral inertia", disc.diametral_inertia), ("polar inertia", disc.polar_inertia)];
    for (name, value) in [("mass", disc.mass)].into_iter().chain(inertias) {
        not_negative(Part::Disc, index, name, value)?;
    }
    for value in disc.unbalance {
        if !value.is_finite() {
            return Err(ShaftError::NotFinite { part: Part::Disc, index, name: "unbalance", value });
        }
    }
    let most = 2.0 * disc.diametral_inertia;
    if disc.polar_inertia > most * (1.0 + ROUNDING) {
        return Err(ShaftError::Polar { index, polar: disc.polar_inertia, most });
    }
    Ok(())
}

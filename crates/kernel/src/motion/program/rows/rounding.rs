//! To what the numbers of rows are rounded.

use crate::numeric::scatter::range;

/// Most decimals that are looked for.
const MOST_DECIMALS: i32 = 12;
/// Rounding of decimals in binary, and of their sums and conversions, as a share of the last decimal.
const BINARY: f64 = 1e-4;
/// The sixth difference, to which a smooth curve hardly adds; windows of it in which nothing moves are below this share of a step.
const DIFFERENCE: [f64; 7] = [1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0];
const ROUNDED_OFF: f64 = 1e-9;
/// Of fewer nothing is concluded.
const FEWEST_DIFFERENCES: usize = 8;
/// A coarser step than that of the decimals is believed where chance would make all values its multiples less often than this.
const CHANCE: f64 = 1e-6;
/// As many of so many steps of a straight line are equal at least.
const MOST_EQUAL: (usize, usize) = (3, 4);
/// Largest divisor of the smallest difference that is tried as the step.
const MOST_PARTS: u32 = 12;
/// Share of the last decimal by which rounding of the written numbers moves a multiple of a coarser step.
const HALF: f64 = 0.51;

/// The step of which all values are multiples: that of their decimals, or a coarser one (thousandths of an inch, written in millimetres with
/// four decimals). 0 where they have too many decimals to be rounded.
#[must_use]
pub fn step(values: &[f64]) -> f64 {
    let largest = values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    let Some(decimals) = (0..=MOST_DECIMALS).find(|decimals| {
        let power = libm::pow(10.0, f64::from(*decimals));
        let noise = BINARY.max(8.0 * f64::EPSILON * largest * power);
        noise < HALF && values.iter().all(|value| (value * power - (value * power).round()).abs() <= noise)
    }) else {
        return 0.0;
    };
    let fine = libm::pow(10.0, f64::from(-decimals));
    if is_ramp(values, fine) {
        return fine;
    }
    let found = common_divisor(values, fine).or_else(|| coarser(values, fine));
    found.filter(|step| looks_rounded(values, *step)).unwrap_or(fine)
}

/// The largest number of the last decimal of which all values are multiples, as 0.002 is of rows with three decimals.
fn common_divisor(values: &[f64], fine: f64) -> Option<f64> {
    let units = values.iter().map(|value| (value / fine).round().abs()).filter(|units| *units > 0.0);
    let mut all: Vec<f64> = units.collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    let divisor = all.iter().fold(0.0_f64, |divisor, units| {
        let (mut a, mut b) = (divisor, *units);
        while b > 0.0 {
            (a, b) = (b, a % b);
        }
        a
    });
    // Chance makes one of so many numbers a multiple.
    let chance = all.iter().fold(1.0_f64, |chance, _| chance / divisor.max(1.0));
    (divisor > 1.0 && chance < CHANCE).then_some(divisor * fine)
}

/// Whether values leave a smooth curve as rounding to a step makes them: those of some laws, as a parabola's, are multiples of a step and do not.
fn looks_rounded(values: &[f64], step: f64) -> bool {
    let off = values.windows(DIFFERENCE.len()).map(|window| {
        let sum: f64 = window.iter().zip(DIFFERENCE).map(|(value, weight)| weight * value).sum();
        let square: f64 = DIFFERENCE.iter().map(|weight| weight * weight).sum();
        sum.abs() / square.sqrt() / step
    });
    let moving: Vec<f64> = off.filter(|off| *off > ROUNDED_OFF).collect();
    let rounded = moving.iter().filter(|off| **off > 0.1).count();
    moving.len() < FEWEST_DIFFERENCES || 2 * rounded > moving.len()
}

/// Whether values go from the lowest to the highest one in steps of which most are equal: these are then those of a straight line, some of whose
/// rows may be left out. Rounding to such a step would show some of the values between them twice.
fn is_ramp(values: &[f64], fine: f64) -> bool {
    let (low, high) = range(values);
    let (moving, resting): (Vec<_>, Vec<_>) =
        values.iter().zip(values.iter().skip(1)).partition(|(a, b)| (*b - *a).abs() > 0.5 * fine);
    let sizes: Vec<f64> = moving.iter().map(|(a, b)| (*b - *a).abs()).collect();
    let least = sizes.iter().copied().fold(f64::INFINITY, f64::min);
    let equal = sizes.iter().filter(|size| **size - least <= 2.0 * (1.0 + BINARY) * fine).count();
    let (low, high) = (low + 0.5 * fine, high - 0.5 * fine);
    MOST_EQUAL.1 * equal >= MOST_EQUAL.0 * sizes.len() && !resting.iter().any(|(a, _)| **a > low && **a < high)
}

/// A step above that of the decimals of which all values are multiples, as far as the last decimal tells.
fn coarser(values: &[f64], fine: f64) -> Option<f64> {
    let mut sorted: Vec<f64> = values.iter().map(|value| value.abs()).collect();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup();
    sorted.retain(|value| *value > 0.5 * fine);
    let pairs = sorted.iter().zip(sorted.iter().skip(1)).map(|(a, b)| b - a);
    let least = pairs.chain(sorted.first().copied()).fold(f64::INFINITY, f64::min);
    (1..=MOST_PARTS).map(|parts| least / f64::from(parts)).find_map(|step| {
        if step < 1.5 * fine {
            return None;
        }
        // The step is known the better the more of them a value is.
        let (mut step, mut known, mut chance) = (step, HALF * fine, 1.0);
        for value in &sorted {
            let count = (value / step).round().max(1.0);
            let within = HALF * fine + count * known;
            if (value - count * step).abs() > within {
                return None;
            }
            chance *= (2.0 * within / step).min(1.0);
            if HALF * fine / count < known {
                (step, known) = (value / count, HALF * fine / count);
            }
        }
        (chance < CHANCE).then_some(step)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rounded(step: f64, decimals: u32) -> Vec<f64> {
        let power = 10_f64.powi(i32::try_from(decimals).expect("few"));
        (0..360)
            .map(|i| 4.5 - 4.5 * f64::from(i).to_radians().cos())
            .map(|value| ((value / step).round() * step * power).round() / power)
            .collect()
    }

    #[test]
    fn the_rounding_of_rows_is_found() {
        for (step_of, decimals) in
            [(0.001, 3), (0.0254, 4), (0.0254, 5), (0.01, 2), (0.01, 5), (0.005, 3), (0.1, 1), (1e-4, 4)]
        {
            let found = step(&rounded(step_of, decimals));
            assert!((found / step_of - 1.0).abs() < 1e-2, "{step_of} in {decimals}: {found}");
        }
        // A few values of many decimals are multiples of nothing else.
        for count in [8, 12, 20] {
            let few: Vec<f64> = rounded(1e-3, 3).into_iter().step_by(360 / count).collect();
            assert!((step(&few) / 1e-3 - 1.0).abs() < 1e-9, "{count}: {}", step(&few));
        }
        // A ramp between two rests, and one without them, is not rounded to its own steps.
        for slope in [0.164_304_3, 0.0777] {
            let ramp = |rests: i32| -> Vec<f64> {
                let clamped = (-rests..23 + rests).map(|i| f64::from(i.clamp(0, 22)));
                clamped.map(|i| (slope * i * 1e3).round() / 1e3).collect()
            };
            let without: Vec<f64> = ramp(8)
                .into_iter()
                .enumerate()
                .filter(|(at, _)| ![12, 13, 20].contains(at))
                .map(|(_, row)| row)
                .collect();
            assert!((step(&without) - 1e-3).abs() < 1e-9, "{slope}");
            assert!((step(&ramp(0)) - 1e-3).abs() < 1e-9 && (step(&ramp(8)) - 1e-3).abs() < 1e-9, "{slope}");
        }
        // Even numbers of the last decimal.
        for (step_of, decimals) in [(0.002, 3), (0.02, 2), (0.0004, 4)] {
            let found = step(&rounded(step_of, decimals));
            assert!((found / step_of - 1.0).abs() < 1e-9, "{step_of} in {decimals}: {found}");
        }
        // Rows of an exact parabola are multiples of a step, and not rounded to it.
        for (lift, rows) in [(20.0, 30), (24.0, 24), (18.0, 40)] {
            let law = |i: i32| {
                let x = f64::from(i.clamp(0, rows)) / f64::from(rows);
                if x < 0.5 { 2.0 * lift * x * x } else { lift - 2.0 * lift * (1.0 - x) * (1.0 - x) }
            };
            let all: Vec<f64> = (-rows..2 * rows).map(|i| (law(i) * 1e6).round() / 1e6).collect();
            assert!(step(&all) < 1e-3, "{lift}: {}", step(&all));
        }
        // All digits: no rounding that matters.
        let exact: Vec<f64> = (0..90).map(|i| 4.5 * f64::from(i).to_radians().sin()).collect();
        assert!(step(&exact) < 1e-11);
        assert_eq!(step(&[0.0, 20.0, 5.0]), 1.0);
    }
}

//! By how much numbers scatter about a smooth curve.

/// The normal distribution: its standard deviation over the median of its sizes.
pub const OF_MEDIAN: f64 = 1.4826;
/// Neighbours on each side of a value; a polynomial of degree 5 goes through all of them.
const EACH_SIDE: usize = 3;
/// Fewest values that are off their neighbours: of fewer the median says too little.
const FEWEST: usize = 84;
/// Blocks of a list in which its scatter may differ, as that of a flank does from that of a dwell.
const BLOCKS: usize = 4;
/// How many times larger the scatter of a block is then.
const MUCH: f64 = 1.5;
/// A value that is off by a smaller share of the largest is not.
const DIGITS: f64 = 1e-12;
/// What scatters leaves values above and below the polynomials of their neighbours by turns: 83 % of pairs by the normal distribution, half of
/// them where the remainder is that of a smooth curve.
const ALTERNATE: f64 = 0.7;

/// How far a value (place, value) is from the polynomial through others, over what scatter with a standard deviation of 1 makes of that;
/// `None` where two places are equal.
#[must_use]
pub fn off_neighbours((x, y): (f64, f64), others: &[(f64, f64)]) -> Option<f64> {
    let (mut off, mut square) = (y, 1.0);
    for (node, (at, value)) in others.iter().enumerate() {
        let rest = others.iter().enumerate().filter(|(other, _)| *other != node);
        let weight: f64 = rest.map(|(_, (other, _))| (x - other) / (at - other)).product();
        off -= weight * value;
        square += weight * weight;
    }
    (square.is_finite() && square > 0.0).then(|| off / square.sqrt())
}

/// The least and the largest of some values.
#[must_use]
pub fn range(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(*value), high.max(*value)))
}

/// The value in the middle; 0 of none.
pub fn median(values: &mut [f64]) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// Standard deviation of the scatter of values (place, value) in the order of their places, that of a block of them where it is much larger; `None`
/// where they are too few, or where what polynomials through their neighbours leave is no scatter. Values that rest exactly count for nothing.
#[must_use]
pub fn scatter(values: &[(f64, f64)]) -> Option<f64> {
    let size = values.iter().fold(0.0_f64, |most, (_, value)| most.max(value.abs()));
    let off = values.windows(2 * EACH_SIDE + 1).filter_map(|window| {
        let (before, own, after) = (window.get(..EACH_SIDE)?, window.get(EACH_SIDE)?, window.get(EACH_SIDE + 1..)?);
        off_neighbours(*own, &[before, after].concat())
    });
    // What rests leaves the rounding of sums.
    let moving: Vec<f64> = off.filter(|off| off.abs() > DIGITS * size).collect();
    let block = (2 * FEWEST).max(moving.len() / BLOCKS);
    let last = moving.get(moving.len().saturating_sub(block)..).unwrap_or_default();
    let largest = moving.chunks(block).chain([last]).filter_map(of_block).reduce(f64::max)?;
    // The largest of several is too large by chance.
    Some(of_block(&moving).filter(|all| largest < MUCH * all).unwrap_or(largest))
}

/// Standard deviation of what a block of values is off its neighbours, where that is scatter.
fn of_block(off: &[f64]) -> Option<f64> {
    let alternate = off.windows(2).filter(|pair| matches!(pair, [a, b] if a * b < 0.0)).count();
    let mut sizes: Vec<f64> = off.iter().map(|off| off.abs()).collect();
    #[expect(clippy::cast_precision_loss, reason = "few values")]
    let is_scatter = off.len() >= FEWEST && alternate as f64 >= ALTERNATE * (off.len() - 1) as f64;
    is_scatter.then(|| OF_MEDIAN * median(&mut sizes))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Normally distributed numbers by twelve even ones each, of Lehmer's generator.
    fn normal(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            let mut draw = || {
                state = state * 48_271 % 2_147_483_647;
                f64::from(u32::try_from(state).expect("31 bits")) / 2_147_483_647.0
            };
            (0..12).map(|_| draw()).sum::<f64>() - 6.0
        }
    }

    fn rows(count: u32, of: impl FnMut(f64) -> f64) -> Vec<(f64, f64)> {
        let places: Vec<f64> = (0..count).map(|at| f64::from(at) / f64::from(count)).collect();
        let values: Vec<f64> = places.iter().copied().map(of).collect();
        places.into_iter().zip(values).collect()
    }

    #[test]
    fn scatter_has_the_standard_deviation_of_what_was_added() {
        for (seed, sigma) in [(1, 3e-3), (7, 1e-5), (42, 0.1)] {
            let mut noise = normal(seed);
            let found = scatter(&rows(720, |x| 10.0 * libm::sin(TAU * x) + sigma * noise())).expect("scatter");
            assert!((found / sigma - 1.0).abs() < 0.15, "{found} of {sigma}");
        }
    }

    #[test]
    fn a_smooth_curve_and_few_values_do_not_scatter() {
        assert_eq!(scatter(&rows(360, |x| 10.0 * libm::sin(3.0 * TAU * x))).filter(|found| *found > 1e-12), None);
        // Truncation of the polynomials alone, far above the digits.
        assert_eq!(scatter(&rows(120, |x| libm::exp(libm::sin(9.0 * TAU * x)))), None);
        let mut noise = normal(3);
        assert_eq!(scatter(&rows(60, |x| x + noise())), None);
        // A ramp in exact steps.
        assert_eq!(scatter(&rows(360, |x| x * 360.0)).filter(|found| *found > 1e-9), None);
    }

    #[test]
    fn scatter_of_a_part_is_seen() {
        let mut noise = normal(11);
        let found = scatter(&rows(360, |x| libm::sin(TAU * x) + if x < 0.5 { 5e-3 * noise() } else { 0.0 }));
        assert!((found.expect("scatter") / 5e-3 - 1.0).abs() < 0.25, "{found:?}");
    }

    #[test]
    fn rounding_is_scatter_of_less_than_half_a_step() {
        let found = scatter(&rows(360, |x| (1e3 * 10.0 * libm::sin(TAU * x)).round() / 1e3)).expect("scatter");
        // Even numbers of one step have 0.29 of it; those of both flanks of a sine go together.
        assert!((0.25e-3..0.5e-3).contains(&found), "{found}");
    }
}

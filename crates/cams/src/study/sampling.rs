//! Random numbers of a study: each depends on the seed, the row and the parameter alone, so that any row can be made by itself, in any
//! process.
//!
//! The bits are SipHash-1-3 of the counters. A Latin hypercube divides the range of each parameter into as many equal shares as there are
//! rows and puts one row into each; which one is a permutation of the numbers of the rows that is computed for one number at a time: a
//! Feistel network over the next power of four, repeated until the result is the number of a row (Black and Rogaway, Ciphers with
//! arbitrary finite domains, 2002). Sobol sequences of published crates are made in their order only, or in `f32`; with them a shard of a
//! study would have to walk all rows before it.

use siphasher::sip::SipHasher13;
use std::hash::Hasher;

/// How random designs are spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// One row in each of as many equal shares of each parameter as there are rows.
    LatinHypercube,
    /// Independent rows.
    Random,
}

/// Rounds of the Feistel network: four make a permutation that no test of a study tells from a random one (Luby and Rackoff, 1988).
const ROUNDS: u64 = 4;
/// What the numbers are for.
const PLACE: u64 = 1;
const ROUND: u64 = 2;

/// The bits of some counters.
fn bits(seed: u64, purpose: u64, counters: [u64; 3]) -> u64 {
    let mut hasher = SipHasher13::new_with_keys(seed, purpose);
    for counter in counters {
        hasher.write_u64(counter);
    }
    hasher.finish()
}

/// A number within (0, 1), of 52 bits and never at an end.
#[expect(clippy::cast_precision_loss, reason = "52 bits")]
fn unit(bits: u64) -> f64 {
    const SHARES: f64 = (1_u64 << 52) as f64;
    ((bits >> 12) as f64 + 0.5) / SHARES
}

/// The place of a row in the range of a parameter, within (0, 1).
#[must_use]
#[expect(clippy::cast_precision_loss, reason = "at most 9e15 rows")]
pub fn share(sampling: Sampling, seed: u64, (row, rows): (u64, u64), parameter: u64) -> f64 {
    let inside = unit(bits(seed, PLACE, [parameter, row, 0]));
    match sampling {
        Sampling::Random => inside,
        Sampling::LatinHypercube => {
            let place = (permuted(seed, parameter, (row, rows)) as f64 + inside) / rows as f64;
            // The sum may be rounded up to the end of the last share.
            place.min(1.0 - f64::EPSILON / 2.0)
        }
    }
}

/// The number of a row after a permutation of all of them.
fn permuted(seed: u64, parameter: u64, (row, rows): (u64, u64)) -> u64 {
    // Half of the bits of the largest number, rounded up.
    let half = (u64::BITS - rows.saturating_sub(1).leading_zeros()).div_ceil(2).max(1);
    let mask = (1 << half) - 1;
    let mut number = row;
    loop {
        let (mut left, mut right) = (number >> half, number & mask);
        for round in 0..ROUNDS {
            (left, right) = (right, left ^ (bits(seed, ROUND, [parameter, round, right]) & mask));
        }
        number = (left << half) | right;
        if number < rows {
            return number;
        }
    }
}

/// Steps of Halley's method: each triples the digits of the start, of which three are right.
const STEPS: u32 = 3;

/// The normal variate below which a share of all lies, for a share within (0, 1).
///
/// The start is formula 26.2.23 of Abramowitz and Stegun, right to 4.5e-4.
#[must_use]
pub fn normal(share: f64) -> f64 {
    let tail = share.min(1.0 - share);
    let t = libm::sqrt(-2.0 * libm::log(tail));
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    let below = 1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308));
    // Negative: the lower tail, where no digits are lost.
    let mut x = above / below - t;
    for _ in 0..STEPS {
        let density = libm::exp(-0.5 * x * x) / libm::sqrt(std::f64::consts::TAU);
        let step = (normal_share(x) - tail) / density;
        x -= step / (1.0 + 0.5 * x * step);
    }
    if share < 0.5 { x } else { -x }
}

/// The share of normal variates below a value.
#[must_use]
pub fn normal_share(x: f64) -> f64 {
    0.5 * libm::erfc(-x * std::f64::consts::FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_permutation_has_every_row_once() {
        for rows in [1_u64, 2, 3, 16, 17, 1000, 4097] {
            let mut all: Vec<u64> = (0..rows).map(|row| permuted(7, 2, (row, rows))).collect();
            all.sort_unstable();
            assert!(all.into_iter().eq(0..rows), "{rows}");
        }
    }

    #[test]
    fn a_latin_hypercube_has_one_row_in_each_share() {
        let rows = 1000;
        for parameter in 0..3 {
            let shares = (0..rows).map(|row| share(Sampling::LatinHypercube, 1, (row, rows), parameter));
            let mut shares: Vec<f64> = shares.collect();
            shares.sort_by(f64::total_cmp);
            let inside =
                |(cell, share): (u32, &f64)| (f64::from(cell)..f64::from(cell + 1)).contains(&(1000.0 * share));
            assert!((0..).zip(&shares).all(inside));
        }
    }

    /// The mean and the scatter of independent numbers, and their correlation, to four times their own scatter.
    #[test]
    fn numbers_are_spread_evenly_and_are_independent() {
        for sampling in [Sampling::Random, Sampling::LatinHypercube] {
            let rows = 20_000;
            let of = |parameter| -> Vec<f64> {
                (0..rows).map(|row| share(sampling, 3, (row, rows), parameter) - 0.5).collect()
            };
            let (a, b) = (of(0), of(1));
            let n = f64::from(u32::try_from(rows).expect("small"));
            let mean = |values: &mut dyn Iterator<Item = f64>| values.sum::<f64>() / n;
            let root = n.sqrt();
            assert!(mean(&mut a.iter().copied()).abs() < 4.0 * (1.0_f64 / 12.0).sqrt() / root);
            assert!((mean(&mut a.iter().map(|x| x * x)) - 1.0 / 12.0).abs() < 4.0 * (1.0_f64 / 180.0).sqrt() / root);
            assert!(mean(&mut a.iter().zip(&b).map(|(x, y)| x * y)).abs() < 4.0 / 12.0 / root);
            // Of consecutive rows as well.
            assert!(mean(&mut a.windows(2).map(|two| two[0] * two[1])).abs() < 4.0 / 12.0 / root);
        }
    }

    /// Abramowitz and Stegun, table 26.1 and 26.5: Φ(1), Φ(2), Φ(3), and far tails by mpmath.
    #[test]
    fn normal_variates_are_those_of_the_tables() {
        for (x, share) in [
            (-1.0, 0.158_655_253_931_457_05),
            (-2.0, 0.022_750_131_948_179_21),
            (-3.0, 0.001_349_898_031_630_094_6),
            (-8.0, 6.220_960_574_271_785e-16),
            (0.0, 0.5),
        ] {
            assert!((normal(share) - x).abs() < 4e-15 * (1.0 + x.abs()), "{x}: {}", normal(share));
            assert!(x < -4.0 || (normal(1.0 - share) + x).abs() < 1e-12, "{x}");
        }
        for tail in [1e-300, 1e-100, 1e-10, 0.3, 0.499_999] {
            assert!((normal_share(normal(tail)) / tail - 1.0).abs() < 1e-11, "{tail}");
        }
    }
}

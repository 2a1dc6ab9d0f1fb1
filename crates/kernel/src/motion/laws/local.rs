//! A polynomial of low degree plus waves, in the distance from where a piece of a law begins.

use super::bernstein::Values;

/// turn·(τ − sin τ) + rise·(1 − cos τ) with τ = harmonic · pace · t.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LocalWave {
    /// Its number of the pace.
    pub(super) harmonic: u32,
    /// Of τ − sin τ.
    pub(super) turn: f64,
    /// Of 1 − cos τ.
    pub(super) rise: f64,
}

/// Up to this angle of the fastest wave s is summed as a power series: beyond, the closed form has lost 3 bits of one wave, and
/// of waves whose lowest powers cancel no more than the use of a law requires.
const SERIES_LIMIT: f64 = 1.0;
/// Even and odd coefficients of the power series, in pairs: the first one left out is 1/22!, 1e-21, of the limit's power.
const PAIRS: u32 = 11;
/// A coefficient smaller than this share of what it is the sum of is 0 and its rounding.
const CANCELLED: f64 = 16.0 * f64::EPSILON;

/// A piece of a law by the distance t from its own beginning.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct LocalPiece {
    /// Where t = 0.
    from: f64,
    polynomial: [f64; 4],
    /// Angular speed of the first harmonic.
    pace: f64,
    /// In order of increasing harmonic.
    waves: Vec<LocalWave>,
    /// The power series serves up to here.
    near: f64,
    series: Vec<[f64; 2]>,
}

impl LocalPiece {
    /// A polynomial by t = x − from.
    pub(super) fn polynomial(from: f64, polynomial: [f64; 4]) -> Self {
        Self { from, polynomial, ..Self::default() }
    }

    /// A polynomial and waves of growing harmonics of a pace.
    pub(super) fn waves(from: f64, polynomial: [f64; 4], pace: f64, waves: &[LocalWave]) -> Self {
        let mut local = Self { from, polynomial, pace, waves: waves.to_vec(), ..Self::default() };
        // A single 1 − cos τ = 2 sin²(τ/2) keeps its digits, and inside a law s is not small.
        if from == 0.0 && (waves.len() > 1 || waves.iter().any(|wave| wave.turn != 0.0)) {
            let fastest = waves.last().map_or(0.0, |wave| f64::from(wave.harmonic)) * pace;
            local.near = SERIES_LIMIT / fastest;
            local.series = local.power_series();
        }
        local
    }

    /// The coefficients of t⁰, t¹, …: −sin and −cos by their own series, added to the polynomial's.
    fn power_series(&self) -> Vec<[f64; 2]> {
        let mut powers: Vec<f64> = self.waves.iter().map(|_| 1.0).collect();
        let mut polynomial = self.polynomial.iter();
        let mut coefficient = |power: u32| {
            let first = polynomial.next().copied().unwrap_or(0.0);
            let (mut sum, mut size) = (first, first.abs());
            for (wave, paces) in self.waves.iter().zip(&mut powers) {
                let sign = if matches!(power % 4, 2 | 3) { 1.0 } else { -1.0 };
                let amplitude = if power.is_multiple_of(2) { wave.rise } else { wave.turn };
                if power > 1 {
                    sum += sign * amplitude * *paces;
                    size += (amplitude * *paces).abs();
                }
                *paces *= f64::from(wave.harmonic) * self.pace / f64::from(power + 1);
            }
            if sum.abs() <= CANCELLED * size { 0.0 } else { sum }
        };
        (0..PAIRS).map(|pair| [coefficient(2 * pair), coefficient(2 * pair + 1)]).collect()
    }

    /// Value and three derivatives.
    #[inline]
    pub(super) fn values_at(&self, x: f64) -> Values {
        let t = x - self.from;
        let [p0, p1, p2, p3] = self.polynomial;
        let (mut value, mut first) = (p0 + t * (p1 + t * (p2 + t * p3)), p1 + t * (2.0 * p2 + t * (3.0 * p3)));
        let (mut second, mut third) = (2.0 * p2 + 6.0 * p3 * t, 6.0 * p3);
        if self.waves.is_empty() {
            return [value, first, second, third];
        }
        let (sin, cos) = libm::sincos(0.5 * self.pace * t);
        // sin and cos of half the wave's angle.
        let (mut half, mut reached) = ((sin, cos), 1);
        for wave in &self.waves {
            while reached < wave.harmonic {
                half = (half.0 * cos + half.1 * sin, half.1 * cos - half.0 * sin);
                reached += 1;
            }
            let pace = f64::from(wave.harmonic) * self.pace;
            // 1 − cos τ, sin τ, cos τ.
            let versed = 2.0 * half.0 * half.0;
            let (sine, cosine) = (2.0 * half.0 * half.1, (half.1 - half.0) * (half.1 + half.0));
            let (turn, rise) = (wave.turn, wave.rise);
            value += turn * (pace * t - sine) + rise * versed;
            first += pace * (turn * versed + rise * sine);
            second += pace * pace * (turn * sine + rise * cosine);
            third += pace * pace * pace * (turn * cosine - rise * sine);
        }
        if t <= self.near && !self.series.is_empty() {
            value = self.by_series(t);
        }
        [value, first, second, third]
    }

    fn by_series(&self, t: f64) -> f64 {
        let square = t * t;
        let [even, odd] =
            self.series.iter().rev().fold([0.0; 2], |[even, odd], [p, q]| [even * square + p, odd * square + q]);
        even + t * odd
    }

    /// The acceleration of the polynomial at x, and its slope.
    pub(super) fn acceleration_line(&self, x: f64) -> (f64, f64) {
        let [_, _, square, cube] = self.polynomial;
        (2.0 * square + 6.0 * cube * (x - self.from), 6.0 * cube)
    }

    /// The acceleration of the waves about x, as amplitudes of sin and cos of a pace times the distance from there.
    pub(super) fn acceleration_waves(&self, x: f64) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        let t = x - self.from;
        self.waves.iter().map(move |wave| {
            let pace = f64::from(wave.harmonic) * self.pace;
            let (sin, cos) = libm::sincos(pace * t);
            let square = pace * pace;
            (pace, square * (wave.turn * cos - wave.rise * sin), square * (wave.turn * sin + wave.rise * cos))
        })
    }

    /// The derivative of an order.
    pub(super) fn derivative(&self, x: f64, order: u32) -> f64 {
        if let Some(known) = usize::try_from(order).ok().and_then(|order| self.values_at(x).get(order).copied()) {
            return known;
        }
        let waves = self.waves.iter().map(|wave| {
            let pace = f64::from(wave.harmonic) * self.pace;
            let (sin, cos) = libm::sincos(pace * (x - self.from));
            // The derivatives of −sin τ and of −cos τ.
            let (turn, rise) = match order % 4 {
                0 => (-sin, -cos),
                1 => (-cos, sin),
                2 => (sin, cos),
                _ => (cos, -sin),
            };
            (0..order).fold(wave.turn * turn + wave.rise * rise, |product, _| product * pace)
        });
        waves.sum()
    }
}

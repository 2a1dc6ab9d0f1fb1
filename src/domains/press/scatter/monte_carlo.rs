//! A press drawn many times: the residual force that a share of all presses stays below.
//!
//! Sample j takes parameter i from output 16 j + i + 1 of SplitMix64 (Steele, Lea & Flood, OOPSLA 2014), so that every sample is known
//! without those before it, and a run is the same on any number of processors.

use super::error::ScatterError;
use super::fault::{Fault, FrozenBuffer, Station};
use super::normal;
use super::parameter::{HalfWidths, Parameter};
use super::reset::ScrewRule;
use crate::document::NamedChoice;
use crate::numeric::parallel;

/// The distribution of every parameter over its band.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Distribution {
    /// Everywhere in the band alike.
    #[default]
    Uniform,
    /// Rising to the middle.
    Triangular,
    /// Normal, the half width two standard deviations.
    Normal,
}

impl NamedChoice for Distribution {
    const ALL: &'static [(&'static str, Self)] =
        &[("uniform", Self::Uniform), ("triangular", Self::Triangular), ("normal", Self::Normal)];
}

impl Distribution {
    /// The deviation over the half width for a number V in (0, 1).
    fn deviation(self, v: f64) -> f64 {
        match self {
            Self::Uniform => 2.0 * v - 1.0,
            Self::Triangular if v < 0.5 => libm::sqrt(2.0 * v) - 1.0,
            Self::Triangular => 1.0 - libm::sqrt(2.0 * (1.0 - v)),
            Self::Normal => 0.5 * normal::inverse(v),
        }
    }

    /// Its variance over the square of the half width; that of `air_lost` is of the size of the deviation.
    #[must_use]
    pub fn variance(self, of: Parameter) -> f64 {
        match (self, of) {
            (Self::Uniform, Parameter::AirLost) => 1.0 / 12.0,
            (Self::Uniform, _) => 1.0 / 3.0,
            (Self::Triangular, Parameter::AirLost) => 1.0 / 18.0,
            (Self::Triangular, _) => 1.0 / 6.0,
            (Self::Normal, Parameter::AirLost) => 0.25 * (1.0 - std::f64::consts::FRAC_2_PI),
            (Self::Normal, _) => 0.25,
        }
    }
}

/// How a press is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sampling {
    /// Half widths.
    pub half_widths: HalfWidths,
    /// Their distribution.
    pub distribution: Distribution,
    /// N.
    pub samples: u32,
    /// Seed of the generator.
    pub seed: u64,
    /// The setting of the screw of every press.
    pub rule: ScrewRule,
}

/// The customary bands of a machine file that gives none.
pub const CUSTOMARY: Sampling = Sampling {
    half_widths: [0.05, 0.03, 0.05, 0.01, 1e-3, 2e-4, 0.01, 0.01, 0.1 * std::f64::consts::PI / 180.0, 1e-4],
    distribution: Distribution::Uniform,
    samples: 20_000,
    seed: 1,
    rule: ScrewRule::End,
};

/// Outputs of the generator that a sample takes.
const OUTPUTS: u64 = 16;

/// The number V in (0, 1) of a sample and a parameter.
#[must_use]
pub fn number(seed: u64, sample: u64, parameter: u64) -> f64 {
    const STEP: u64 = 0x9E37_79B9_7F4A_7C15;
    let output = OUTPUTS.wrapping_mul(sample).wrapping_add(parameter + 1);
    let z = seed.wrapping_add(STEP.wrapping_mul(output));
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    let z = z ^ (z >> 31);
    #[expect(clippy::cast_precision_loss, reason = "53 bits")]
    let bits = (z >> 11) as f64;
    (bits + 0.5) / 9_007_199_254_740_992.0
}

impl Sampling {
    /// The press of a sample, and the error of its screw, m.
    #[must_use]
    pub fn press(&self, exponent: f64, sample: u64) -> (Fault, f64) {
        let (mut fault, mut screw) = (Fault::none(exponent), 0.0);
        for ((index, parameter), half_width) in (0_u64..).zip(Parameter::ALL).zip(self.half_widths) {
            let deviation = half_width * self.distribution.deviation(number(self.seed, sample, index));
            match parameter {
                Parameter::Screw => screw = deviation,
                Parameter::AirLost => fault = parameter.changed(fault, deviation.abs()),
                _ => fault = parameter.changed(fault, deviation),
            }
        }
        (fault, screw)
    }
}

/// Largest residual force of every sample, N, in growing order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Samples {
    /// As the presses are built.
    pub as_built: Vec<f64>,
    /// After the reset of each.
    pub reset: Vec<f64>,
    /// A fixed bottom in the same presses, after its reset.
    pub fixed: Vec<f64>,
}

/// A buffer with its stations.
struct Stationed {
    buffer: FrozenBuffer,
    at: Vec<Station>,
    /// Of the bed, N.
    friction: f64,
}

impl Stationed {
    /// Largest residual force after a reset whose screw is off by so much, m. A fixed bottom has no law by which it could be levelled, and
    /// is set to its end.
    fn after(&self, fault: &Fault, rule: ScrewRule, screw: f64) -> Result<f64, ScatterError> {
        let still = Fault { phase: 0.0, ..*fault };
        let column = match rule {
            ScrewRule::None => fault.column,
            rule => self.buffer.setting(&still, rule)? + screw,
        };
        self.largest(&fault.with_column(column))
    }

    fn largest(&self, fault: &Fault) -> Result<f64, ScatterError> {
        self.buffer.fits(fault)?;
        Ok(self.buffer.largest_at(fault, &self.at, self.friction))
    }
}

/// Draws the presses of a cam, whose beds have this friction, N.
///
/// # Errors
/// When a press cannot be: its column is used up, or no column balances its end.
pub fn draw(cam: &FrozenBuffer, sampling: &Sampling, friction: f64) -> Result<Samples, ScatterError> {
    let fixed = cam.with_fixed_bottom();
    let cam = Stationed { buffer: *cam, at: cam.stations_of_cam(), friction };
    let fixed = Stationed { buffer: fixed, at: fixed.stations_of_fixed_bottom(), friction };
    let of_fixed = if sampling.rule == ScrewRule::None { ScrewRule::None } else { ScrewRule::End };
    let one = |sample: &u32| -> Result<[f64; 3], ScatterError> {
        let (fault, screw) = sampling.press(cam.buffer.exponent, u64::from(*sample));
        let built = cam.largest(&fault)?;
        let reset = if sampling.rule == ScrewRule::None { built } else { cam.after(&fault, sampling.rule, screw)? };
        Ok([built, reset, fixed.after(&fault, of_fixed, screw)?])
    };
    let numbers: Vec<u32> = (0..sampling.samples).collect();
    let all: Vec<[f64; 3]> = parallel::map(&numbers, one).into_iter().collect::<Result<_, _>>()?;
    let sorted = |of: fn(&[f64; 3]) -> f64| {
        let mut sizes: Vec<f64> = all.iter().map(of).collect();
        sizes.sort_by(f64::total_cmp);
        sizes
    };
    Ok(Samples {
        as_built: sorted(|[built, ..]| *built),
        reset: sorted(|[_, reset, _]| *reset),
        fixed: sorted(|[.., fixed]| *fixed),
    })
}

/// The value of rank ⌈q N⌉ of sorted samples, and those of ranks q N ∓ 1.96 √(N q (1−q)), rounded outwards: the 95 % interval of the
/// percentile. `None` without samples.
#[must_use]
pub fn percentile(sorted: &[f64], q: f64) -> Option<[f64; 3]> {
    if sorted.is_empty() {
        return None;
    }
    #[expect(clippy::cast_precision_loss, reason = "at most millions")]
    let count = sorted.len() as f64;
    let spread = 1.96 * libm::sqrt(count * q * (1.0 - q));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the ranks")]
    let at = |rank: f64| sorted.get((rank.clamp(1.0, count) as usize).checked_sub(1)?).copied();
    // A rounding of q N must not lift its rank.
    let rank = (q * count - 1e-9).ceil();
    Some([at(rank)?, at((q * count - spread).floor())?, at((q * count + spread).ceil())?])
}

//! A press drawn many times: the residual force that a share of all presses stays below.
//!
//! Sample j takes parameter i from output 16 j + i + 1 of SplitMix64 (Steele, Lea & Flood, OOPSLA 2014), so that every sample is known
//! without those before it, and a run is the same on any number of processors.

use super::bed_path::BedPath;
use super::error::ScatterError;
use super::fault::{Fault, FrozenBuffer, Station};
use super::normal;
use super::parameter::{HalfWidths, Parameter};
use super::reset::ScrewRule;
use camgen_kernel::document::NamedChoice;
use camgen_kernel::numeric::parallel;

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

    /// Its variance / (half width)²; for `air_lost`, of the size of the deviation.
    #[must_use]
    pub fn variance(self, parameter: Parameter) -> f64 {
        match (self, parameter) {
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
    /// Largest force per unit phase error over the stations, N/rad.
    phase: f64,
    /// Of the bed, N.
    friction: f64,
    is_cam: bool,
}

/// Relative rounding error of an upper bound.
const ROUNDING: f64 = 1e-9;

impl Stationed {
    fn new(buffer: &FrozenBuffer, is_cam: bool, friction: f64) -> Self {
        let at = if is_cam { buffer.stations_of_cam() } else { buffer.stations_of_fixed_bottom() };
        let phase = at.iter().map(|station| station.phase.abs()).fold(0.0, f64::max) * buffer.unit_force;
        Self { buffer: *buffer, at, phase, friction, is_cam }
    }

    /// The press after a reset with a screw error, m.
    fn set(&self, fault: &Fault, rule: ScrewRule, screw: f64) -> Result<Fault, ScatterError> {
        if rule == ScrewRule::None {
            return Ok(*fault);
        }
        let still = Fault { phase: 0.0, ..*fault };
        Ok(fault.with_column(self.buffer.setting(&still, rule)? + screw))
    }

    fn largest(&self, fault: &Fault) -> Result<f64, ScatterError> {
        self.buffer.fits(fault)?;
        Ok(self.buffer.largest_at(fault, &self.at, self.friction))
    }

    /// Upper bound of [`Self::largest`], N: from closed-form extremes over the stroke if known, in a tenth of its time.
    fn bound(&self, fault: &Fault) -> Result<f64, ScatterError> {
        let left = match (&self.buffer.path, self.is_cam) {
            _ if self.buffer.level.is_some() => return self.largest(fault),
            (_, true) => {
                let [least, largest] = self.buffer.extremes_by_load(fault)?;
                largest.value.max(-least.value)
            }
            (BedPath::Yoke { .. }, false) => {
                self.buffer.fits(fault)?;
                self.buffer.largest_of_fixed(fault)
            }
            (BedPath::Linkage(_), false) => return self.largest(fault),
        };
        Ok((left + self.phase * fault.phase.abs() + self.friction) * (1.0 + ROUNDING))
    }
}

/// A cam and a fixed bottom in the same presses. The fixed bottom is reset by `end`: without a law it cannot be levelled.
struct Rivals<'a> {
    cam: Stationed,
    fixed: Stationed,
    sampling: &'a Sampling,
}

impl<'a> Rivals<'a> {
    fn new(cam: &FrozenBuffer, sampling: &'a Sampling, friction: f64) -> Self {
        let fixed = Stationed::new(&cam.with_fixed_bottom(), false, friction);
        Self { cam: Stationed::new(cam, true, friction), fixed, sampling }
    }

    /// The press of a sample with the cam as built, with the cam after its reset, and with the fixed bottom after its own reset.
    fn presses(&self, sample: u32) -> Result<[(&Stationed, Fault); 3], ScatterError> {
        let (fault, screw) = self.sampling.press(self.cam.buffer.exponent, u64::from(sample));
        let rule = self.sampling.rule;
        let of_fixed = if rule == ScrewRule::None { rule } else { ScrewRule::End };
        Ok([
            (&self.cam, fault),
            (&self.cam, self.cam.set(&fault, rule, screw)?),
            (&self.fixed, self.fixed.set(&fault, of_fixed, screw)?),
        ])
    }

    fn samples(&self) -> Vec<u32> {
        (0..self.sampling.samples).collect()
    }
}

/// Draws the presses of a cam, whose beds have this friction, N.
///
/// # Errors
/// When a press cannot be: its column is used up, or no column balances its end.
pub fn draw(cam: &FrozenBuffer, sampling: &Sampling, friction: f64) -> Result<Samples, ScatterError> {
    let rivals = Rivals::new(cam, sampling, friction);
    let all = parallel::map(&rivals.samples(), |sample| -> Result<[f64; 3], ScatterError> {
        let [built, reset, fixed] = rivals.presses(*sample)?.map(|(body, fault)| body.largest(&fault));
        Ok([built?, reset?, fixed?])
    });
    let mut samples = Samples::default();
    for sizes in all {
        let [built, reset, fixed] = sizes?;
        samples.as_built.push(built);
        samples.reset.push(reset);
        samples.fixed.push(fixed);
    }
    for sizes in [&mut samples.as_built, &mut samples.reset, &mut samples.fixed] {
        sizes.sort_by(f64::total_cmp);
    }
    Ok(samples)
}

/// P95 of the largest residual forces of the sampled presses, N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftInPractice {
    /// The cam as built.
    pub as_built: f64,
    /// The cam after the reset of each press.
    pub reset: f64,
    /// A fixed bottom after its own reset.
    pub fixed: f64,
}

/// The percentile of [`LeftInPractice`].
pub const SHARE: f64 = 0.95;

/// P95 of the presses sampled by [`draw`], in a fraction of its time; `None` if there are too few.
///
/// # Errors
/// As [`draw`].
pub fn left_in_practice(
    cam: &FrozenBuffer,
    sampling: &Sampling,
    friction: f64,
) -> Result<Option<LeftInPractice>, ScatterError> {
    let rivals = Rivals::new(cam, sampling, friction);
    let samples = rivals.samples();
    if !has_percentile(samples.len(), SHARE) {
        return Ok(None);
    }
    let all = parallel::map(&samples, |sample| -> Result<[f64; 3], ScatterError> {
        let [built, reset, fixed] = rivals.presses(*sample)?.map(|(body, fault)| body.bound(&fault));
        Ok([built?, reset?, fixed?])
    });
    let mut bounds = [Vec::new(), Vec::new(), Vec::new()];
    for sizes in all {
        bounds.iter_mut().zip(sizes?).for_each(|(list, bound)| list.push(bound));
    }
    let [built, reset, fixed] = bounds;
    Ok(Some(LeftInPractice {
        as_built: ranked(&built, |sample| {
            rivals.presses(*sample).and_then(|[(body, fault), ..]| body.largest(&fault))
        })?,
        reset: ranked(&reset, |sample| rivals.presses(*sample).and_then(|[_, (body, fault), _]| body.largest(&fault)))?,
        fixed: ranked(&fixed, |sample| rivals.presses(*sample).and_then(|[.., (body, fault)]| body.largest(&fault)))?,
    }))
}

/// The percentile [`SHARE`] of sizes with known upper bounds; only sizes whose bound reaches it are computed.
fn ranked(bounds: &[f64], size: impl Fn(&u32) -> Result<f64, ScatterError> + Sync) -> Result<f64, ScatterError> {
    let count = bounds.len() + 1 - rank(bounds.len(), SHARE);
    let mut order: Vec<(f64, u32)> = bounds.iter().copied().zip(0..).collect();
    let (mut largest, mut rest): (Vec<f64>, &mut [(f64, u32)]) = (Vec::new(), &mut order);
    // The first chunk fills the ranks; behind it most bounds are below the `count`th largest size so far, which can only grow.
    let mut chunk = count;
    while !rest.is_empty() {
        let at = chunk.min(rest.len()) - 1;
        rest.select_nth_unstable_by(at, |a, b| b.0.total_cmp(&a.0));
        let (next, after) = rest.split_at_mut(at + 1);
        let least = largest.get(count - 1).copied().unwrap_or(f64::NEG_INFINITY);
        let next: Vec<u32> = next.iter().filter(|(bound, _)| *bound >= least).map(|(_, sample)| *sample).collect();
        if next.is_empty() {
            break;
        }
        largest.extend(parallel::map(&next, &size).into_iter().collect::<Result<Vec<_>, _>>()?);
        largest.sort_by(|a, b| b.total_cmp(a));
        largest.truncate(count);
        (rest, chunk) = (after, count.div_ceil(LATER_CHUNKS));
    }
    Ok(largest.get(count - 1).copied().unwrap_or(f64::NAN))
}

/// Into how many parts the chunks behind the first one are divided: each may end the search.
const LATER_CHUNKS: usize = 4;

/// Whether at least one of `count` presses is beyond the percentile of a share.
#[must_use]
pub fn has_percentile(count: usize, share: f64) -> bool {
    #[expect(clippy::cast_precision_loss, reason = "at most a million")]
    let beyond = (1.0 - share) * count as f64;
    beyond >= 1.0 - 1e-9
}

/// ⌈q N⌉.
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "at most a million"
)]
fn rank(count: usize, q: f64) -> usize {
    // Rounding of q N must not raise the rank.
    (q * count as f64 - 1e-9).ceil().max(1.0) as usize
}

/// The samples of rank ⌈q N⌉ and of ranks q N ∓ 1.96 √(N q (1−q)), rounded outwards: the 95 % interval of the
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
    let [low, high] =
        [(q * count - spread).floor(), (q * count + spread).ceil()].map(|rank| rank.clamp(1.0, count) as usize);
    let [middle, low, high] = [rank(sorted.len(), q), low, high].map(|rank| sorted.get(rank.checked_sub(1)?).copied());
    Some([middle?, low?, high?])
}

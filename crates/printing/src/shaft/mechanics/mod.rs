//! A shaft of round sections on rigid or elastic supports, with discs: critical speeds, deflection, unbalance.
//!
//! The source is a Soviet article on pairs of printing cylinders, of which only the tail is left; its author and title are
//! lost. It takes the critical speeds from Birger's integral equation, x from one support to the other:
//!
//! ```text
//! y = ω² (K_0 + K_c)                                                                              (2), (3)
//! K_0 = ∫₀ˣ∫₀^{x1} A/(EJ) dx dx1 − (x/l) ∫₀ˡ∫₀^{x1} A/(EJ) dx dx1        the bent shaft                  (4)
//! A   = ∫₀ˣ∫₀^{x1} m y dx dx1 − (x/l) ∫₀ˡ∫₀^{x1} m y dx dx1              its moment for ω² = 1           (5)
//! K_c = (1/k1)(1 − x/l) A2/l + (1/k2)(x/l)(A1 − A2/l)                    the yielding supports           (6)
//! A1  = ∫₀ˡ m y dx,  A2 = ∫₀ˡ∫₀ˣ m y dx1 dx                                                         (7), (8)
//! ```
//!
//! [`paper`] solves it as the article does, by stations; [`exact`] solves the same equation by unit loads, to rounding.
//!
//! # Where the paper errs
//!
//! 1. **Its six speeds do not belong to one rotor.** 1/ω² is convex in 1/k. From 13600, 10800 and 3800 rpm at k = ∞, 1e9 and
//!    1e8 N/m its slope is at most 288.8 kg at k = ∞ and at least 582.2 kg for k → 0; their ratio would be at most 0.496,
//!    and is 0.811 for a uniform beam. They are not a test here.
//! 2. **Pressure is not mass.** The paper adds the line load between two cylinders to m(x) as q/g, and every speed falls to
//!    0.36. A constant load has no inertia, and the stiffness of the contact *raises* the mode in which the cylinders move
//!    against each other. It is not modelled.
//! 3. **It leaves out gyroscopic moments, at most 2 %, and forgets shear, which is larger.** For a slender pinned beam the
//!    one is +½(πD/4l)², the other −2.93 times that. So [`Beam::Timoshenko`] is the rule.
//! 4. **Supports at the two ends only.** With supports further in, a symmetric start of the iteration misses a
//!    lower rocking mode: ∅50 × 1.6 m on 1e5 N/m at 0.6 and 1.0 m runs critical at 371 rpm, not 850.
//!
//! SI throughout: m, N/m, kg, rad/s. Lateral vibration in one plane, or the whirl of a round shaft at its own speed. Without
//! damping, axial load, and bearings stiffer in one direction.

mod columns;
mod curve;
mod eigen;
mod error;
pub mod exact;
mod legendre;
mod panels;
pub mod paper;
pub mod unbalance;
mod valid;

pub use curve::DeflectionCurve;
pub use error::ShaftError;

use camgen_kernel::document::NamedChoice;
use camgen_kernel::refusal::Refusal;
use std::f64::consts::PI;

/// Two supports must be further apart than this, m: nearer, they clamp, with a stiffness that is rounding.
pub const LEAST_DISTANCE: f64 = 1e-6;

/// Panels of a shaft: its steps, supports and discs cut it. Fifty, Timoshenko, forward, take 0.3 s.
pub const MOST_PANELS: usize = 50;

/// Modes requested at once: the thirtieth of a uniform beam stands at 900 times the first, and every twenty cost a cut.
pub const MOST_MODES: usize = 30;

/// The highest order of the load polynomials that may be fixed.
pub const MOST_ORDER: usize = 24;

/// ω_j/ω_1 of the highest mode that is reported: the relative error of 1/ω_j² is ε (ω_j/ω_1)², 2e-8 there. Where a thin disc in forward
/// whirl makes a negative 1/ω² larger than the first, which then replaces ω_1.
pub const MOST_RATIO: f64 = 1e4;

/// Stations of the paper's method: at 18 000 its error is 1e-8, and it takes longer than the exact one.
pub const MOST_STATIONS: usize = 100_000;

/// A length of one section and material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShaftSegment {
    /// m, above 0.
    pub length: f64,
    /// m, above 0.
    pub diameter: f64,
    /// m, at least 0 and below the diameter.
    pub bore: f64,
    /// E, Pa, above 0.
    pub modulus: f64,
    /// ρ, kg/m³; 0 is a massless shaft.
    pub density: f64,
    /// ν, −1 < ν ≤ ½.
    pub poisson: f64,
}

impl ShaftSegment {
    /// A, m².
    #[must_use]
    pub fn area(&self) -> f64 {
        0.25 * PI * (self.diameter - self.bore) * (self.diameter + self.bore)
    }

    /// J about a diameter, m⁴; the polar one is twice this.
    #[must_use]
    pub fn second_moment(&self) -> f64 {
        self.area() * (self.diameter * self.diameter + self.bore * self.bore) / 16.0
    }

    /// G = E/(2(1 + ν)), Pa.
    #[must_use]
    pub fn shear_modulus(&self) -> f64 {
        0.5 * self.modulus / (1.0 + self.poisson)
    }

    /// κ: the part of the area that carries shear. G. R. Cowper, "The shear coefficient in Timoshenko's beam theory",
    /// Journal of Applied Mechanics 33 (1966) 335–340, hollow circle, with q = bore/diameter.
    #[must_use]
    pub fn shear_coefficient(&self) -> f64 {
        let (nu, q) = (self.poisson, self.bore / self.diameter);
        let (square, sum) = (q * q, 1.0 + q * q);
        6.0 * (1.0 + nu) * sum * sum / ((7.0 + 6.0 * nu) * sum * sum + (20.0 + 12.0 * nu) * square)
    }

    /// ρ A l, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        self.density * self.area() * self.length
    }

    /// Whether a cut between the two would be none.
    fn continues(&self, other: &Self) -> bool {
        Self { length: other.length, ..*self } == *other
    }
}

/// A bearing: it holds the shaft across, and lets it turn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Place from the left end, m.
    pub at: f64,
    /// N/m, above 0; `None` is rigid.
    pub stiffness: Option<f64>,
}

/// A rigid body on the shaft at one position: a cam, a gear, a weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShaftDisc {
    /// Place from the left end, m.
    pub at: f64,
    /// kg.
    pub mass: f64,
    /// I_t about a diameter through its centre, kg m².
    pub diametral_inertia: f64,
    /// I_p about the shaft, kg m²; at most 2 I_t.
    pub polar_inertia: f64,
    /// Mass × offset of its centre, kg m, in two directions that turn with the shaft.
    pub unbalance: [f64; 2],
}

/// Which theory of the beam.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Beam {
    /// With shear and the rotary inertia of the sections.
    #[default]
    Timoshenko,
    /// Without either: the paper's.
    Euler,
}

/// How a turning shaft vibrates at a critical speed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Whirl {
    /// In a plane; nothing turns, so no gyroscopic moments. The paper's.
    Planar,
    /// The bent line turns with the shaft, as unbalance turns it; gyroscopic moments stiffen.
    #[default]
    Forward,
    /// The whirl turns against the shaft; gyroscopic moments soften.
    Backward,
}

impl NamedChoice for Whirl {
    const ALL: &'static [(&'static str, Self)] =
        &[("forward", Self::Forward), ("planar", Self::Planar), ("backward", Self::Backward)];
}

impl Whirl {
    /// Couples of a turning slope, over ω² ψ: (I_t − γ I_p), with γ = shaft speed / whirl speed.
    fn gamma(self) -> f64 {
        match self {
            Self::Planar => 0.0,
            Self::Forward => 1.0,
            Self::Backward => -1.0,
        }
    }
}

/// The side of a step on which a section is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StepSide {
    /// The section that ends there.
    Left,
    /// The section that begins there.
    Right,
}

/// A shaft in order: every value in range, neighbouring segments of one section merged.
#[derive(Debug, Clone, PartialEq)]
pub struct Shaft {
    segments: Vec<ShaftSegment>,
    supports: Vec<Support>,
    discs: Vec<ShaftDisc>,
    beam: Beam,
}

impl Shaft {
    /// A shaft of segments from left to right; supports and discs in any order.
    ///
    /// # Errors
    /// [`Refusal`] with the part that is wrong and what would pass.
    pub fn new(
        segments: Vec<ShaftSegment>,
        supports: Vec<Support>,
        discs: Vec<ShaftDisc>,
        beam: Beam,
    ) -> Result<Self, Refusal> {
        let mut shaft = Self { segments, supports, discs, beam };
        valid::check(&shaft)?;
        shaft.segments = merged(&shaft.segments);
        valid::check_panels(&shaft)?;
        Ok(shaft)
    }

    /// From left to right, neighbours of one section merged.
    #[must_use]
    pub fn segments(&self) -> &[ShaftSegment] {
        &self.segments
    }

    /// In the order given.
    #[must_use]
    pub fn supports(&self) -> &[Support] {
        &self.supports
    }

    /// In the order given.
    #[must_use]
    pub fn discs(&self) -> &[ShaftDisc] {
        &self.discs
    }

    /// The theory.
    #[must_use]
    pub fn beam(&self) -> Beam {
        self.beam
    }

    /// L, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.segments.iter().map(|segment| segment.length).sum()
    }

    /// Mass of the segments and the discs, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        let segments: f64 = self.segments.iter().map(ShaftSegment::mass).sum();
        segments + self.discs.iter().map(|disc| disc.mass).sum::<f64>()
    }

    /// Diameter and bore at x, m; at a step, of the side requested. Outside of the shaft, of the nearer end.
    #[must_use]
    pub fn section_at(&self, x: f64, side: StepSide) -> (f64, f64) {
        // A position given by its decimal number is the step that a sum of lengths makes.
        let same = panels::SAME_PLACE * self.length();
        let mut right = 0.0;
        let mut last = (0.0, 0.0);
        for segment in &self.segments {
            right += segment.length;
            last = (segment.diameter, segment.bore);
            let here = match side {
                StepSide::Left => x <= right + same,
                StepSide::Right => x < right - same,
            };
            if here {
                break;
            }
        }
        last
    }

    /// Where the section or the material changes, m, from left to right; the ends are none.
    #[must_use]
    pub fn steps(&self) -> Vec<f64> {
        let ends = self.segments.iter().scan(0.0, |at, segment| {
            *at += segment.length;
            Some(*at)
        });
        ends.take(self.segments.len().saturating_sub(1)).collect()
    }

    /// Twist between two positions under 1 N m: Σ l/(G J_p), rad/(N m). What lies outside of the shaft is rigid.
    #[must_use]
    pub fn twist_compliance(&self, a: f64, b: f64) -> f64 {
        let (low, high) = (a.min(b), a.max(b));
        let (mut left, mut sum) = (0.0, 0.0);
        for segment in &self.segments {
            let right = left + segment.length;
            let length = (high.min(right) - low.max(left)).max(0.0);
            sum += length / (2.0 * segment.shear_modulus() * segment.second_moment());
            left = right;
        }
        sum
    }

    /// The same shaft with these discs.
    ///
    /// # Errors
    /// As [`Shaft::new`].
    pub fn with_discs(&self, discs: Vec<ShaftDisc>) -> Result<Self, Refusal> {
        Self::new(self.segments.clone(), self.supports.clone(), discs, self.beam)
    }

    /// The same shaft with this stiffness, N/m, at every elastic support.
    ///
    /// # Errors
    /// As [`Shaft::new`].
    pub fn with_stiffness(&self, stiffness: f64) -> Result<Self, Refusal> {
        let mut supports = self.supports.clone();
        for support in &mut supports {
            support.stiffness = support.stiffness.map(|_| stiffness);
        }
        Self::new(self.segments.clone(), supports, self.discs.clone(), self.beam)
    }

    /// The same shaft with every diameter and bore times this factor; the compliance of bending falls with its fourth power.
    ///
    /// # Errors
    /// As [`Shaft::new`].
    pub fn scaled(&self, factor: f64) -> Result<Self, Refusal> {
        let mut segments = self.segments.clone();
        for segment in &mut segments {
            segment.diameter *= factor;
            segment.bore *= factor;
        }
        Self::new(segments, self.supports.clone(), self.discs.clone(), self.beam)
    }
}

/// Neighbours of one section as one segment.
fn merged(segments: &[ShaftSegment]) -> Vec<ShaftSegment> {
    let mut all: Vec<ShaftSegment> = Vec::new();
    for segment in segments {
        match all.last_mut() {
            Some(last) if last.continues(segment) => last.length += segment.length,
            _ => all.push(*segment),
        }
    }
    all
}

#[cfg(test)]
mod tests;

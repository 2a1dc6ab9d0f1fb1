//! Equation (18): the forces of a cam that rides on the bed and moves the bottom through a bell crank.
//!
//! ```text
//! A a = P · {1 + λ cos ψ · sin(α+ρ)/(η sin[θ−(α+ρ)])},   P = (L/(L−x−Δx))^k − 1                     (18) over 2 p0 F
//! sin ψ = Δx/l2,   θ = Δ + ψ,   dΔx/dx = λ cos ψ · sin α/sin(θ−α)                                  (19), (21)–(24)
//! ```
//!
//! The deceleration a of the bed over the square of the crank speed is a function of its position, x itself under the yoke of the paper
//! ([`PlaceLaw`]). With C = λ cos ψ, σ = (dΔx/dx)/C = sin α/sin(θ−α), s± = sin(θ±ρ), q = sin ρ the fraction of (18) is
//!
//! ```text
//! T = sin(α+ρ)/sin(θ−α−ρ) = (σ s₊ + q)/(s₋ − σ q),   and back   σ = (T s₋ − q)/(s₊ + T q)
//! ```
//!
//! so that neither α nor any angle but the given ones is needed, and without friction T is σ. Solved for the slope, with
//! B = A a/P − 1:  dΔx/dx = C (η B s₋ − C q)/(C s₊ + η B q). On the return ρ changes its sign.

use crate::press::buffer::place_law::PlaceLaw;
use camgen_kernel::document::NamedChoice;
use camgen_kernel::numeric::series::tape::{ElementaryFunction, Tape, TapeNumber};
use std::f64::consts::{FRAC_PI_2, PI};

/// Share of the bottom's arm that may be used: beyond, ψ is over 87° and roundings of Δx are multiplied in the force.
pub(super) const ARM_SHARE: f64 = 0.999;

/// How the efficiency enters equation (18).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EfficiencyModel {
    /// The loss is on the driven side: η while the cam drives the lever, 1/η while the air does.
    Consistent,
    /// η throughout, as the paper prints it.
    Printed,
}

/// Direction of the bed in which the forces balance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ExactOn {
    /// While the bed is braked.
    Braking,
    /// While it is accelerated back.
    Return,
    /// In neither: at every x the residuals of the two are opposite and equal.
    Mean,
}

impl NamedChoice for ExactOn {
    const ALL: &'static [(&'static str, Self)] =
        &[("braking", Self::Braking), ("return", Self::Return), ("mean", Self::Mean), ("level", Self::Mean)];
}

/// A direction of the bed's motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BedDirection {
    /// x grows: the bed is braked.
    Braking,
    /// x falls: the bed is accelerated back.
    Return,
}

/// Direction of the bottom while x grows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trend {
    /// Δx grows.
    Rising,
    /// Δx falls.
    Falling,
    /// The lever sticks.
    Stuck,
}

/// The bell crank between plate and bottom, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mechanism {
    /// Loading A, exponent k and column L, and the bed's deceleration a(x) over its stroke.
    pub bottom_law: PlaceLaw,
    /// Arm of the bottom l2, m.
    pub bottom_arm: f64,
    /// λ = l2/l1.
    pub arm_ratio: f64,
    /// Δ, rad, in (0, π).
    pub delta: f64,
    /// ρ, rad, in [0, π/2).
    pub friction_angle: f64,
    /// η in (0, 1].
    pub efficiency: f64,
    /// How the efficiency enters.
    pub model: EfficiencyModel,
    /// Direction in which the forces balance.
    pub exact_on: ExactOn,
}

/// The geometry of the lever at a Δx.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lever {
    /// C = λ cos ψ.
    pub(super) ratio: f64,
    /// sin θ.
    pub(super) sine: f64,
    /// cos θ.
    pub(super) cosine: f64,
    /// sin(θ+ρ).
    pub(super) plus: f64,
    /// sin(θ−ρ).
    pub(super) minus: f64,
}

impl Mechanism {
    /// The two efficiencies of (18), while the bed is braked and on the return.
    pub(super) fn efficiencies(&self, side: Trend) -> (f64, f64) {
        let eta = self.efficiency;
        match (self.model, side) {
            (EfficiencyModel::Printed, _) => (eta, eta),
            (EfficiencyModel::Consistent, Trend::Rising) => (eta, 1.0 / eta),
            (EfficiencyModel::Consistent, Trend::Falling) => (1.0 / eta, eta),
            (EfficiencyModel::Consistent, Trend::Stuck) => (1.0, 1.0),
        }
    }

    /// Whether the slope has another law where Δx falls than where it rises. Without friction the mean of the two
    /// directions does not: both sides have the same two losses.
    pub(super) fn two_sided(&self) -> bool {
        self.model == EfficiencyModel::Consistent
            && self.efficiency < 1.0
            && !(self.exact_on == ExactOn::Mean && self.friction_angle == 0.0)
    }

    /// Size of the Δx at which the roller moves along the bed's line, sin θ = 0, on a side: ψ = −Δ or π − Δ. Infinite where
    /// the arm ends before.
    pub(super) fn furthest_before_line(&self, side: Trend) -> f64 {
        let left = if side == Trend::Falling { self.delta } else { PI - self.delta };
        if left < FRAC_PI_2 { self.bottom_arm * libm::sin(left) } else { f64::INFINITY }
    }

    pub(super) fn lever(&self, bottom: f64) -> Lever {
        let sin_psi = bottom / self.bottom_arm;
        let cos_psi = ((1.0 - sin_psi) * (1.0 + sin_psi)).sqrt();
        let (delta, rho) = (self.delta, self.friction_angle);
        let [sine, cosine, plus, minus] = [delta, delta + FRAC_PI_2, delta + rho, delta - rho]
            .map(|angle| libm::sin(angle) * cos_psi + libm::cos(angle) * sin_psi);
        Lever { ratio: self.arm_ratio * cos_psi, sine, cosine, plus, minus }
    }

    /// P = (L/(L−x−Δx))^k − 1: the air force over 2 p0 F; NaN when the column is used up.
    #[must_use]
    pub fn air(&self, x: f64, bottom: f64) -> f64 {
        libm::expm1(-self.bottom_law.exponent() * libm::log1p(-(x + bottom) / self.bottom_law.column()))
    }

    /// A a: the inertia force over 2 p0 F.
    #[must_use]
    pub fn load(&self, x: f64) -> f64 {
        self.bottom_law.loading() * self.bottom_law.deceleration(x)
    }

    /// ψ, rad, by (19).
    #[must_use]
    pub fn psi(&self, bottom: f64) -> f64 {
        libm::asin(bottom / self.bottom_arm)
    }

    /// α, rad, the slope of the pitch curve, by (21).
    #[must_use]
    pub fn slope_angle(&self, bottom: f64, slope: f64) -> f64 {
        let lever = self.lever(bottom);
        let sigma = slope / lever.ratio;
        libm::atan2(sigma * lever.sine, 1.0 + sigma * lever.cosine)
    }

    /// The side of a slope; a slope of exactly 0 is a lever that sticks.
    #[must_use]
    pub fn trend_of(slope: f64) -> Trend {
        if slope > 0.0 {
            Trend::Rising
        } else if slope < 0.0 {
            Trend::Falling
        } else {
            Trend::Stuck
        }
    }

    /// T and η of (18) for a direction of the bed.
    fn fraction(&self, lever: &Lever, slope: f64, side: Trend, way: BedDirection) -> (f64, f64) {
        let (sigma, q) = (slope / lever.ratio, libm::sin(self.friction_angle));
        let (braking, returning) = self.efficiencies(side);
        match way {
            BedDirection::Braking => ((sigma * lever.plus + q) / (lever.minus - sigma * q), braking),
            BedDirection::Return => ((sigma * lever.minus - q) / (lever.plus + sigma * q), returning),
        }
    }

    /// Left side less right side of (18), over 2 p0 F, at overrun x with the bottom at Δx and the slope dΔx/dx.
    ///
    /// Where a lever sticks in the direction in which the forces are to balance, its friction takes up the difference: the
    /// residual is 0 as far as the losses reach, and the excess beyond them. In the other direction it is taken without loss.
    #[must_use]
    pub fn residual(&self, x: f64, bottom: f64, slope: f64, way: BedDirection) -> f64 {
        self.residual_on(Self::trend_of(slope), x, bottom, slope, way)
    }

    /// The residual force of a flank that was to move the bottom as `side` says, whatever its own slope.
    #[must_use]
    pub fn residual_on(&self, side: Trend, x: f64, bottom: f64, slope: f64, way: BedDirection) -> f64 {
        let (lever, air, load) = (self.lever(bottom), self.air(x, bottom), self.load(x));
        let (fraction, efficiency) = self.fraction(&lever, slope, side, way);
        let balanced = matches!(
            (self.exact_on, way),
            (ExactOn::Braking, BedDirection::Braking) | (ExactOn::Return, BedDirection::Return)
        );
        if side == Trend::Stuck && balanced && self.two_sided() {
            let [a, b] = [self.efficiency, 1.0 / self.efficiency]
                .map(|efficiency| load - air * (1.0 + lever.ratio * fraction / efficiency));
            if a.min(b) <= 0.0 && a.max(b) >= 0.0 {
                0.0
            } else if a.abs() < b.abs() {
                a
            } else {
                b
            }
        } else {
            load - air * (1.0 + lever.ratio * fraction / efficiency)
        }
    }

    /// Normal force of one roller on its flank over p0 F, equation (17), by the bed's direction; on the return ρ has the other
    /// sign and η changes sides.
    #[must_use]
    pub fn normal_force(&self, side: Trend, way: BedDirection, x: f64, bottom: f64, slope: f64) -> f64 {
        let lever = self.lever(bottom);
        let (sigma, q) = (slope / lever.ratio, libm::sin(self.friction_angle));
        let (braking, returning) = self.efficiencies(side);
        let (left, efficiency) = match way {
            BedDirection::Braking => (lever.minus - sigma * q, braking),
            BedDirection::Return => (lever.plus + sigma * q, returning),
        };
        // sin(θ−α−ρ) over sin(θ−α) is (s₋ − σ q)/sin θ, and 1/sin(θ−α) is √(1 + 2 σ cos θ + σ²)/sin θ.
        let stretch = (1.0 + 2.0 * sigma * lever.cosine + sigma * sigma).sqrt();
        self.air(x, bottom) * lever.ratio * libm::cos(self.friction_angle) * stretch / (left * efficiency)
    }

    /// The right-hand side for x > 0, in units of the stroke.
    pub(super) fn tape(&self, side: Trend) -> Tape {
        let law = &self.bottom_law;
        Tape::recorded(|x, y| {
            let air = ((x + y) * (law.stroke() / law.column())).apply(ElementaryFunction::PowerLessOne(law.exponent()));
            let decelerated = self.share(x).map_or(x, |share| x * share);
            self.slope(decelerated * (law.loading() * law.stroke()) / air, y, side)
        })
    }

    /// The right-hand side about x = 0, where y = x w and the state is w.
    pub(super) fn starting_tape(&self, side: Trend) -> Tape {
        let law = &self.bottom_law;
        Tape::recorded(|x, w| {
            let argument = (w + 1.0) * (law.stroke() / law.column());
            let air = argument.apply(ElementaryFunction::PowerLessOneOverAbscissa(law.exponent()));
            let at_origin = law.loading() * law.stroke();
            let load = self.share(x).map_or_else(|| x.constant(at_origin), |share| share * at_origin);
            self.slope(load / air, x * w, side)
        })
    }

    /// a/x from the overrun in strokes; `None` under a yoke, where it is 1.
    fn share<'t>(&self, x: TapeNumber<'t>) -> Option<TapeNumber<'t>> {
        Some(self.bottom_law.in_line()?.share(x, self.bottom_law.stroke()))
    }

    /// dΔx/dx from A a/P and Δx (in strokes). Without friction it is η B and does not depend on the lever.
    fn slope<'t>(&self, ratio: TapeNumber<'t>, y: TapeNumber<'t>, side: Trend) -> TapeNumber<'t> {
        let surplus = ratio + -1.0;
        let (braking, returning) = self.efficiencies(side);
        if self.friction_angle == 0.0 {
            let efficiency = match self.exact_on {
                ExactOn::Braking => braking,
                ExactOn::Return => returning,
                ExactOn::Mean => 2.0 / (1.0 / braking + 1.0 / returning),
            };
            return if efficiency == 1.0 { surplus } else { surplus * efficiency };
        }
        let sin_psi = y * (self.bottom_law.stroke() / self.bottom_arm);
        let cos_psi = (sin_psi * sin_psi * -1.0 + 1.0).apply(ElementaryFunction::Root);
        let c = cos_psi * self.arm_ratio;
        let [plus, minus] = [self.delta + self.friction_angle, self.delta - self.friction_angle]
            .map(|angle| cos_psi * libm::sin(angle) + sin_psi * libm::cos(angle));
        let q = libm::sin(self.friction_angle);
        match self.exact_on {
            ExactOn::Braking => one_way(surplus, c, plus, minus, braking, q),
            ExactOn::Return => one_way(surplus, c, minus, plus, returning, -q),
            ExactOn::Mean => both_ways(surplus, c, plus, minus, 1.0 / braking, 1.0 / returning, q),
        }
    }
}

/// C (η B s₋ − C q)/(C s₊ + η B q).
fn one_way<'t>(
    b: TapeNumber<'t>,
    c: TapeNumber<'t>,
    plus: TapeNumber<'t>,
    minus: TapeNumber<'t>,
    efficiency: f64,
    q: f64,
) -> TapeNumber<'t> {
    let driven = b * efficiency;
    c * ((driven * minus - c * q) / (c * plus + driven * q))
}

/// C σ with a T(ρ) + b T(−ρ) = 2 B/C: the root near 0 of
///
/// ```text
/// σ² [C q (a s₊ − b s₋) + 2 B q²] + σ [C (a s₊² + b s₋² + (a+b) q²) + 2 B q (s₊ − s₋)] + C q (a s₊ − b s₋) − 2 B s₊ s₋
/// ```
fn both_ways<'t>(
    b: TapeNumber<'t>,
    c: TapeNumber<'t>,
    plus: TapeNumber<'t>,
    minus: TapeNumber<'t>,
    first: f64,
    second: f64,
    q: f64,
) -> TapeNumber<'t> {
    let twice = b * 2.0;
    let lean = c * (plus * (first * q) - minus * (second * q));
    let quadratic = lean + twice * (q * q);
    let squares = plus * plus * first + minus * minus * second + (first + second) * q * q;
    let linear = c * squares + twice * ((plus - minus) * q);
    let minus_constant = twice * (plus * minus) - lean;
    let root = (linear * linear + quadratic * minus_constant * 4.0).apply(ElementaryFunction::Root);
    c * (minus_constant * 2.0 / (linear + root))
}

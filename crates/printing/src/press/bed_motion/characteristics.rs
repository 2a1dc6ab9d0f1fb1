//! What a bed drive is worth: dead points, stroke, largest accelerations, power and speed, without units.
//!
//! The names C⁺, C⁻, K_c, K_φ and the "kinetic power" are by V. O. Kuznetsov (1997); their normalisation is derived here
//! and fixed by his printed 6.58 and 5.92: with the drive's speed ω and the stroke S the acceleration is C S (ω/π)², the peak of
//! power m ω³ S² W/π³. C is π²/2 and W is π³/8 for a harmonic motion; no motion has C < 4.
//!
//! Extremes are roots of the next derivative between the points of a grid; where that derivative only dips towards zero within a
//! cell, its own extreme decides whether two roots hide there.

use super::{Linkage, turned};
use camgen_kernel::numeric::extremum::Extremum;
use camgen_kernel::numeric::root;
use std::f64::consts::{PI, TAU};

/// Cells of a turn.
const CELLS: u32 = 96;

/// x and its derivatives up to the fourth.
type MotionDerivatives = [f64; 5];

/// A point of the grid of one turn.
pub(crate) struct GridPoint {
    /// Angle of the driving crank, rad.
    theta: f64,
    /// x and its derivatives there.
    motion: MotionDerivatives,
}

/// The figures of a linkage; angles of the driving crank from the base (from the slider's line without a drag link), in [0, 2π).
#[derive(Debug, Clone, PartialEq)]
pub struct Characteristics {
    /// θ of the outer dead point, rad: x is largest.
    pub outer: f64,
    /// θ of the inner dead point, rad.
    pub inner: f64,
    /// Stroke S in units of O2C.
    pub stroke: f64,
    /// Zeros of x'' in the order of θ, rad. Their number counts the reversals of the force: two, or no buffer law fits.
    pub zeros: Vec<f64>,
    /// C⁺ = π² max(−x'')/S, near the outer dead point, and its θ.
    pub outer_acceleration: Extremum,
    /// C⁻ = π² max(x'')/S, near the inner dead point, and its θ.
    pub inner_acceleration: Extremum,
    /// K_c = C⁺/C⁻.
    pub acceleration_ratio: f64,
    /// φ1, rad: from the outer dead point to the inner one.
    pub forward_angle: f64,
    /// K_φ = φ1/(2π − φ1).
    pub time_ratio: f64,
    /// W = π³ max|x' x''|/S², and its θ.
    pub power: Extremum,
    /// Velocity coefficient max|x'| π/S (π/2 for a harmonic motion), and its θ.
    pub velocity: Extremum,
}

impl Characteristics {
    /// C, the larger of C⁺ and C⁻.
    #[must_use]
    pub fn acceleration(&self) -> f64 {
        self.outer_acceleration.value.max(self.inner_acceleration.value)
    }
}

/// A linkage compared with its crank-slider without drag link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkageComparison {
    /// C/C0 − 1: change of the largest force at the same speed and stroke, as a share.
    pub acceleration: f64,
    /// W/W0 − 1: change of the peak of power.
    pub power: f64,
    /// √(C0/C) − 1: how much faster the drive may turn at equal force.
    pub speed: f64,
}

/// The grid of one turn; it closes with the very numbers it began with.
pub(crate) fn grid(linkage: &Linkage) -> Vec<GridPoint> {
    let mut points = Vec::new();
    for cell in 0..=CELLS {
        let theta = TAU * (f64::from(cell) / f64::from(CELLS));
        points.push(GridPoint { theta, motion: linkage.motion(turned(theta)) });
    }
    points
}

/// Roots of `value` over the turn, in [0, 2π) and in order; `slope` is its derivative.
pub(crate) fn roots(
    linkage: &Linkage,
    grid: &[GridPoint],
    value: impl Fn(&MotionDerivatives) -> f64,
    slope: impl Fn(&MotionDerivatives) -> f64,
) -> Vec<f64> {
    let mut brackets = Vec::new();
    for [before, behind] in grid.array_windows() {
        let (low, high) = (before.theta, behind.theta);
        // 0 counts as positive, so that a root on a point of the grid is found in one of its two cells.
        let starts_negative = value(&before.motion) < 0.0;
        if starts_negative != (value(&behind.motion) < 0.0) {
            brackets.push([low, high]);
            continue;
        }
        let toward = if starts_negative { -1.0 } else { 1.0 };
        if toward * slope(&before.motion) < 0.0
            && toward * slope(&behind.motion) > 0.0
            && let Ok(middle) = root::bracketed(|theta| slope(&linkage.motion(theta)), low, high, 0.0)
            && toward * value(&linkage.motion(turned(middle))) < 0.0
        {
            brackets.extend([[low, middle], [middle, high]]);
        }
    }
    let mut found = Vec::new();
    for [low, high] in brackets {
        if let Ok(root) = root::bracketed(|theta| value(&linkage.motion(turned(theta))), low, high, 0.0) {
            found.push(turned(root));
        }
    }
    found.sort_by(f64::total_cmp);
    found.dedup();
    found
}

/// Places where x'' is extreme.
pub(crate) fn jerk_zeros(linkage: &Linkage, grid: &[GridPoint]) -> Vec<f64> {
    roots(linkage, grid, |m| m[3], |m| m[4])
}

/// Places where x' x'' is extreme: x''² + x' x''' = 0.
pub(crate) fn power_extremes(linkage: &Linkage, grid: &[GridPoint]) -> Vec<f64> {
    roots(linkage, grid, |m| m[2] * m[2] + m[1] * m[3], |m| 3.0 * m[2] * m[3] + m[1] * m[4])
}

/// The largest of a value over crank angles.
fn largest(places: &[f64], value: impl Fn(f64) -> f64) -> Extremum {
    let none = Extremum { at: f64::NAN, value: f64::NAN };
    places.iter().fold(none, |best, at| {
        let value = value(*at);
        if value > best.value || best.value.is_nan() { Extremum { at: *at, value } } else { best }
    })
}

/// Zeros of x'': between neighbouring extremes it is monotone, so there is one wherever it changes sign, and no other.
fn acceleration_zeros(linkage: &Linkage, extremes: &[f64]) -> Vec<f64> {
    let next = extremes.iter().skip(1).copied().chain(extremes.first().map(|first| first + TAU));
    let mut zeros = Vec::new();
    for (low, high) in extremes.iter().zip(next) {
        if (linkage.position(*low)[2] < 0.0) != (linkage.position(high)[2] < 0.0)
            && let Ok(zero) = root::bracketed(|theta| linkage.position(theta)[2], *low, high, 0.0)
        {
            zeros.push(turned(zero));
        }
    }
    zeros.sort_by(f64::total_cmp);
    zeros
}

/// The figures of a linkage that has passed [`Linkage::check`].
#[must_use]
pub fn characteristics(linkage: &Linkage) -> Characteristics {
    let grid = grid(linkage);
    let [outer, inner] = linkage.dead_points();
    let stroke = linkage.stroke();
    let extremes = jerk_zeros(linkage, &grid);
    let zeros = acceleration_zeros(linkage, &extremes);
    let normal = PI * PI / stroke;
    let outer_acceleration = largest(&extremes, |theta| -normal * linkage.position(theta)[2]);
    let inner_acceleration = largest(&extremes, |theta| normal * linkage.position(theta)[2]);
    let power = largest(&power_extremes(linkage, &grid), |theta| {
        let motion = linkage.position(theta);
        PI * normal / stroke * (motion[1] * motion[2]).abs()
    });
    let velocity = largest(&zeros, |theta| PI / stroke * linkage.position(theta)[1].abs());
    let forward_angle = turned(inner - outer);
    Characteristics {
        outer,
        inner,
        stroke,
        zeros,
        outer_acceleration,
        inner_acceleration,
        acceleration_ratio: outer_acceleration.value / inner_acceleration.value,
        forward_angle,
        time_ratio: forward_angle / (TAU - forward_angle),
        power,
        velocity,
    }
}

/// A linkage compared with its crank-slider alone (a yoke and a crank-slider are compared with themselves).
#[must_use]
pub fn compared(linkage: &Linkage) -> LinkageComparison {
    let plain = linkage.slider().map_or(Linkage::Yoke, Linkage::CrankSlider);
    let (own, plain) = (characteristics(linkage), characteristics(&plain));
    let share = own.acceleration() / plain.acceleration();
    LinkageComparison {
        acceleration: share - 1.0,
        power: own.power.value / plain.power.value - 1.0,
        speed: (1.0 / share).sqrt() - 1.0,
    }
}

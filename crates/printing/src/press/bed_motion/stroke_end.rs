//! The bed at one end of its stroke: how far it overruns while the linkage brakes it and brings it back.
//!
//! With y = ±x, positive at the outer end and negative at the inner one, the reversal of an end runs from φ_a to φ_b, the zeros of
//! y'' on either side of the dead point φ_d. There the bed overruns by y(φ) − y(φ_a) and is decelerated by a = −y'' ≥ 0, both of
//! the length of the crank: the inertia force is m ω² a. For a yoke the two are one, r sin φ; for any other linkage they are
//! not, and a need not be largest at the dead point.

use super::{Linkage, characteristics, turned};
use camgen_kernel::document::NamedChoice;
use camgen_kernel::numeric::extremum::Extremum;
use camgen_kernel::numeric::root;
use std::f64::consts::{PI, TAU};

/// Coefficients of the series about the start of the reversal.
const TERMS: usize = 16;
/// Crank angle up to which that series is summed at most, rad.
const NEAR: f64 = 0.05;

/// An end of the stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum End {
    /// Where the bed is farthest from the shaft of the crank.
    #[default]
    Outer,
    /// Where it is nearest.
    Inner,
}

impl NamedChoice for End {
    const ALL: &'static [(&'static str, Self)] = &[("outer", Self::Outer), ("inner", Self::Inner)];
}

impl End {
    /// +1 at the outer end, −1 at the inner one.
    fn sign(self) -> f64 {
        match self {
            Self::Outer => 1.0,
            Self::Inner => -1.0,
        }
    }

    /// The other one.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Outer => Self::Inner,
            Self::Inner => Self::Outer,
        }
    }
}

/// The bed at a crank angle of the reversal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overrun {
    /// Overrun x and its first six derivatives by the crank angle, m; a = −x''.
    pub x: [f64; 7],
    /// a/κ − x with its first derivative, κ = a'/x' at the start of the reversal: 0 for a yoke, and of second order at the start.
    pub excess: [f64; 2],
}

impl Overrun {
    /// Deceleration a over the square of the crank speed, with its first four derivatives by the crank angle, m.
    #[must_use]
    pub fn deceleration(&self) -> [f64; 5] {
        let [_, _, second, third, fourth, fifth, sixth] = self.x;
        [-second, -third, -fourth, -fifth, -sixth]
    }
}

/// The reversal of the bed at one end of its stroke, by the crank angle φ = θ − θ_a from its start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrokeEnd {
    linkage: Linkage,
    /// Length of the slider's crank O2C, m.
    radius: f64,
    end: End,
    /// θ_a, rad.
    start: f64,
    /// φ_d, rad: where the bed is at rest.
    dead: f64,
    /// φ_b, rad: where the reversal ends.
    angle: f64,
    /// Largest a, m, and where.
    largest: Extremum,
    /// y(φ_a), m.
    place: f64,
    /// x at the dead point and at the end of the reversal, m.
    ends: [f64; 2],
    /// The return mirrors the outward motion.
    symmetric: bool,
    /// Series of x about the start, m.
    series: [f64; TERMS],
    /// Crank angle up to which it is summed, rad.
    near: f64,
}

impl StrokeEnd {
    /// The end of the stroke of a linkage whose slider has a crank of this length, m. `None` where the acceleration of the bed
    /// changes its sign more than twice in a turn: then no buffer at an end takes a whole reversal.
    ///
    /// The linkage is one that has passed [`Linkage::check`].
    #[must_use]
    pub fn new(linkage: Linkage, radius: f64, end: End) -> Option<Self> {
        let found = characteristics(&linkage);
        let &[first, second] = found.zeros.as_slice() else { return None };
        let (dead, largest) = match end {
            End::Outer => (found.outer, found.outer_acceleration),
            End::Inner => (found.inner, found.inner_acceleration),
        };
        // The zero before the dead point is the start.
        let start = if turned(dead - first) < turned(dead - second) { first } else { second };
        let symmetric = match linkage {
            Linkage::Yoke => true,
            Linkage::CrankSlider(slider) => slider.offset_ratio == 0.0,
            Linkage::SixBar(..) => false,
        };
        let to_dead = turned(dead - start);
        let whole = if symmetric { 2.0 * to_dead } else { turned(first + second - 2.0 * start) };
        let scale = end.sign() * radius;
        let mut series = linkage.series::<TERMS>(start).0.map(|coefficient| scale * coefficient);
        let place = std::mem::take(&mut series[0]);
        // a is 0 at the start, its rounding is not.
        series[2] = 0.0;
        let mut made = Self {
            linkage,
            radius,
            end,
            start,
            dead: to_dead,
            angle: whole,
            largest: Extremum {
                at: turned(largest.at - start),
                value: largest.value * radius * found.stroke / (PI * PI),
            },
            place,
            ends: [0.0; 2],
            symmetric,
            series,
            near: near(&series),
        };
        made.ends = [to_dead, whole].map(|angle| made.at(angle).x[0]);
        Some(made)
    }

    /// Which end it is.
    #[must_use]
    pub fn end(&self) -> End {
        self.end
    }

    /// The linkage.
    #[must_use]
    pub fn linkage(&self) -> &Linkage {
        &self.linkage
    }

    /// Length of the slider's crank O2C, m.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// ±x of the slider at the start of the reversal, m, with the sign of the end.
    pub(crate) fn place(&self) -> f64 {
        self.place
    }

    /// θ_a, rad: the driving crank at the start of the reversal, from the base (from the slider's line without a drag link).
    #[must_use]
    pub fn start(&self) -> f64 {
        self.start
    }

    /// φ_d, rad: the crank angle of the dead point from the start of the reversal.
    #[must_use]
    pub fn dead(&self) -> f64 {
        self.dead
    }

    /// Crank angle that the reversal takes, rad.
    #[must_use]
    pub fn angle(&self) -> f64 {
        self.angle
    }

    /// Largest deceleration a of the reversal, m, and its crank angle.
    #[must_use]
    pub fn largest_deceleration(&self) -> Extremum {
        self.largest
    }

    /// Overrun at the dead point, m.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        self.ends[0]
    }

    /// Overrun at the end of the reversal, m: not 0 unless the motion is symmetric.
    #[must_use]
    pub fn overrun_at_end(&self) -> f64 {
        self.ends[1]
    }

    /// Whether the return mirrors the outward motion, to the last bit.
    #[must_use]
    pub fn symmetric(&self) -> bool {
        self.symmetric
    }

    /// κ = a'/x' at the start of the reversal: 1 for a yoke.
    #[must_use]
    pub fn start_ratio(&self) -> f64 {
        -6.0 * self.series[3] / self.series[1]
    }

    /// The bed at a crank angle φ, rad, also outside the reversal.
    #[must_use]
    pub fn at(&self, angle: f64) -> Overrun {
        if self.symmetric && angle > self.dead {
            let Overrun { mut x, mut excess } = self.at(2.0 * self.dead - angle);
            for odd in x.iter_mut().skip(1).step_by(2) {
                *odd = -*odd;
            }
            excess[1] = -excess[1];
            return Overrun { x, excess };
        }
        let scale = self.end.sign() * self.radius;
        let mut x = self.linkage.motion::<7>(turned(self.start + angle)).map(|derivative| scale * derivative);
        let ratio = self.start_ratio();
        if angle.abs() > self.near {
            x[0] -= self.place;
            return Overrun { x, excess: [-x[2] / ratio - x[0], -x[3] / ratio - x[1]] };
        }
        let (mut second, mut excess) = ([0.0; TERMS], [0.0; TERMS]);
        let terms = self.series.iter().zip(self.series.iter().skip(2)).zip(&mut second).zip(&mut excess);
        for (order, (((own, above), second), excess)) in terms.enumerate() {
            #[expect(clippy::cast_precision_loss, reason = "a dozen")]
            let twice = (order + 1) as f64 * (order + 2) as f64;
            *second = twice * above;
            if order >= 2 {
                *excess = -twice * above / ratio - own;
            }
        }
        x[0] = sum(&self.series, angle)[0];
        x[2] = sum(&second, angle)[0];
        Overrun { x, excess: sum(&excess, angle) }
    }

    /// The crank angles before and after the reversal at which the bed is still, or again, this far (m) from the start of its overrun;
    /// `None` where its stroke is shorter.
    #[must_use]
    pub fn ahead(&self, travel: f64) -> Option<[f64; 2]> {
        let [outer, inner] = self.linkage.dead_points();
        let other = match self.end {
            End::Outer => inner,
            End::Inner => outer,
        };
        let after = turned(other - self.start);
        let before = root::bracketed(|angle| self.at(angle).x[0] + travel, after - TAU, 0.0, 0.0).ok()?;
        if self.symmetric {
            return Some([before, self.angle - before]);
        }
        let behind = root::bracketed(|angle| self.at(angle).x[0] + travel, self.dead, after, 0.0).ok()?;
        Some([before, behind])
    }
}

/// A series and its slope at an angle, by Horner's scheme.
fn sum(series: &[f64; TERMS], angle: f64) -> [f64; 2] {
    let mut sum = [0.0, 0.0];
    for coefficient in series.iter().rev() {
        let [value, slope] = sum;
        sum = [value * angle + coefficient, slope * angle + value];
    }
    sum
}

/// Crank angle up to which the last terms of a series are roundings of its first, rad.
fn near(series: &[f64; TERMS]) -> f64 {
    let &[_, first, .., before, last] = series;
    [(before, 13.0), (last, 14.0)].into_iter().fold(NEAR, |near, (coefficient, power)| {
        let share = f64::EPSILON * (first / coefficient).abs();
        if share.is_finite() { near.min(libm::pow(share, 1.0 / power)) } else { near }
    })
}

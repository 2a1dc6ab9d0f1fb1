//! Bed drives of a press: the yoke, the crank-slider, and the six-bar whose crank is turned unevenly by a drag link.
//!
//! V. O. Kuznetsov (1997) compares a crank-slider (КПМ-4/2) with a six-bar (КПМ-6/2) in which a double crank O1–A–B–O2 turns
//! the crank O2–C of the same slider. He prints no formula; all kinematics is derived here. It has his accelerations and
//! shares, not his K_c = 1.96 and 1.506 of the plain crank-slider: exact kinematics gives 1.9115 and 1.5.
//!
//! Lengths of the drag link are in units of the driving crank O1A, lengths of the slider in units of its crank O2C:
//!
//! ```text
//! λ1 = O1O2, λ2 = AB, λ3 = O2B (over O1A);   λ5 = CD (rod), λ6 = offset of the slider's line (over O2C)
//! θ  angle of the driving crank O1A from the base O1→O2, ψ of O2B from the base, β = ψ + δ of O2C from the slider's line
//! d² = 1 + λ1² − 2 λ1 cos θ                                    d = O2A
//! O2B = u (A − O2) + v (A − O2 turned by +90°),   u = (d² + λ3² − λ2²)/(2 d²)
//! v  = ± √([(λ2 + λ3)² − d²][d² − (λ2 − λ3)²])/(2 d²)          Heron; + for the leading branch
//! x  = cos β + √(λ5² − (sin β − λ6)²)
//! ```
//!
//! so cos β and sin β are algebraic in cos θ and sin θ, and truncated power series give every derivative exactly, without an
//! inverse function. δ is the angle from O2B to O2C plus the inclination of the base to the slider's line: only the sum acts.
//! A mirror image turns (θ, δ, λ6) and the branch round.

pub mod characteristics;
mod error;
mod in_line;
mod stroke_end;

pub use characteristics::{Characteristics, LinkageComparison, characteristics, compared};
pub use error::{DragLinkRemedies, Passing};
pub use in_line::InLine;
pub use stroke_end::{End, Overrun, StrokeEnd};

use camgen_kernel::numeric::series::{PowerSeries, SeriesCoefficient};
use camgen_kernel::refusal::Refusal;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// The crank-slider O2–C–D; lengths in units of its crank O2C.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slider {
    /// λ5 = CD/O2C.
    pub rod_ratio: f64,
    /// λ6: the slider's line passes O2 at this distance, positive to the left of the slider's outward direction.
    pub offset_ratio: f64,
}

/// Which of the two ways a drag link can be put together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Branch {
    /// O2B runs ahead of O2A by an angle in (0, π).
    #[default]
    Leading,
    /// O2B runs behind O2A.
    Trailing,
}

impl Branch {
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Leading => 1.0,
            Self::Trailing => -1.0,
        }
    }
}

/// The double crank O1–A–B–O2; lengths in units of the driving crank O1A.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DragLink {
    /// λ1 = O1O2.
    pub base: f64,
    /// λ2 = AB.
    pub coupler: f64,
    /// λ3 = O2B.
    pub follower: f64,
    /// δ, rad: the angle from O2B to O2C plus the inclination of the base O1→O2 to the slider's line.
    pub turn: f64,
    /// The branch in which it is assembled.
    pub branch: Branch,
}

/// A bed drive.
///
/// The functions of this room want one that has passed [`Linkage::check`]; of another they give NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Linkage {
    /// A crank roller in a slotted link: x = cos θ, with the outer dead point at θ = 0. The limit λ5 → ∞ of a crank-slider.
    Yoke,
    /// The crank itself drives: ψ = β = θ.
    CrankSlider(Slider),
    /// A drag link turns the crank of the slider.
    SixBar(DragLink, Slider),
}

/// Places of a drag link's joints, in units of O2C, O2 in the origin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DragLinkJoints {
    /// O1, the shaft of the driving crank.
    pub shaft: [f64; 2],
    /// A, the pin of the driving crank.
    pub driving: [f64; 2],
    /// B, the pin of the follower.
    pub driven: [f64; 2],
}

/// Places of the joints for a drawing, in units of the crank O2C: O2 in the origin, the slider's outward direction along +x.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Joints {
    /// O1, A and B of a six-bar.
    pub drag_link: Option<DragLinkJoints>,
    /// C, the pin of the slider's crank.
    pub crank: [f64; 2],
    /// D, the pin of the slider; for a yoke the foot of C on the slider's line.
    pub slider: [f64; 2],
}

/// Position of a mechanism in a drawing; its motion does not depend on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// α6, rad: inclination of the base O1→O2 to the slider's line.
    pub base_angle: f64,
    /// λ4 = O2C/O1A.
    pub crank_ratio: f64,
}

/// Angle of the follower crank and its derivatives by the driving crank's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crank {
    /// ψ, rad; continuous over any number of turns.
    pub angle: f64,
    /// ψ' = dψ/dθ.
    pub first: f64,
    /// ψ''.
    pub second: f64,
}

/// An angle in [0, 2π).
pub(crate) fn turned(angle: f64) -> f64 {
    let rest = angle - TAU * (angle / TAU).floor();
    if rest >= TAU { 0.0 } else { rest }
}

impl Slider {
    /// Whether the rod lets the crank through: λ5 > 1 + |λ6|.
    ///
    /// # Errors
    /// [`Refusal`] with the rod and the offset that would pass.
    pub fn check(&self) -> Result<(), Refusal> {
        let Self { rod_ratio, offset_ratio } = *self;
        finite("rod ratio", rod_ratio)?;
        finite("offset ratio", offset_ratio)?;
        let least_rod = 1.0 + offset_ratio.abs();
        if rod_ratio > least_rod {
            Ok(())
        } else {
            let largest_offset = rod_ratio - 1.0;
            let or_offset = if largest_offset > 0.0 {
                format!(", or the offset ratio within ±{largest_offset}")
            } else {
                String::new()
            };
            Err(Refusal::new(format!(
                "the rod is {rod_ratio} cranks long and its line passes {offset_ratio} cranks from the shaft"
            ))
            .remedy(format!("the rod ratio must be above {least_rod}{or_offset}")))
        }
    }

    /// Stroke S in units of O2C: √((λ5+1)² − λ6²) − √((λ5−1)² − λ6²), written without the difference.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        let Self { rod_ratio, offset_ratio } = *self;
        let [outer, inner] =
            [rod_ratio + 1.0, rod_ratio - 1.0].map(|length| ((length - offset_ratio) * (length + offset_ratio)).sqrt());
        4.0 * rod_ratio / (outer + inner)
    }

    /// Crank angles β, rad, of the outer and the inner dead point: sin β = λ6/(λ5 + 1) and β = π + asin(λ6/(λ5 − 1)).
    #[must_use]
    pub fn dead_points(&self) -> [f64; 2] {
        let Self { rod_ratio, offset_ratio } = *self;
        [libm::asin(offset_ratio / (rod_ratio + 1.0)), PI + libm::asin(offset_ratio / (rod_ratio - 1.0))]
    }

    /// x of the slider from series of cos β and sin β.
    pub(crate) fn slide<T: SeriesCoefficient, const N: usize>(
        &self,
        cos: PowerSeries<N, T>,
        sin: PowerSeries<N, T>,
    ) -> PowerSeries<N, T> {
        let rise = sin - T::constant(self.offset_ratio);
        cos + (-(rise * rise) + T::constant(self.rod_ratio * self.rod_ratio)).sqrt()
    }
}

fn finite(name: &str, value: f64) -> Result<(), Refusal> {
    if value.is_finite() {
        return Ok(());
    }
    Err(Refusal::new(format!("the {name} is {value}")).remedy("it must be a finite number"))
}

/// λ1, λ2, λ3 and cos δ, sin δ as numbers of one kind.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Links<T> {
    pub(crate) base: T,
    pub(crate) coupler: T,
    pub(crate) follower: T,
    pub(crate) turn: [T; 2],
    pub(crate) sign: f64,
}

impl<T: SeriesCoefficient> Links<T> {
    /// cos ψ and sin ψ as series about θ.
    fn follower_crank<const N: usize>(&self, theta: f64) -> (PowerSeries<N, T>, PowerSeries<N, T>) {
        let Self { base, coupler, follower, .. } = *self;
        let two = T::constant(2.0);
        let (cos, sin) = PowerSeries::<N, T>::cos_sin(theta);
        // A − O2 and d².
        let along = cos - base;
        let square = cos * -(two * base) + (T::constant(1.0) + base * base);
        let (sum, difference) = (coupler + follower, coupler - follower);
        let heron = (-square + sum * sum) * (square - difference * difference);
        let inverse = PowerSeries::constant(T::constant(0.5)) / (square * follower);
        let u = (square - sum * difference) * inverse;
        let v = heron.sqrt() * inverse * T::constant(self.sign);
        (along * u - sin * v, sin * u + along * v)
    }

    /// cos β and sin β as series about θ.
    pub(crate) fn crank<const N: usize>(&self, theta: f64) -> (PowerSeries<N, T>, PowerSeries<N, T>) {
        let (cos, sin) = self.follower_crank(theta);
        let [turn_cos, turn_sin] = self.turn;
        (cos * turn_cos - sin * turn_sin, sin * turn_cos + cos * turn_sin)
    }
}

impl DragLink {
    /// Whether both cranks turn fully (Grashof with the base shortest): λ1 < 1, |λ2 − λ3| < 1 − λ1, 1 + λ1 < λ2 + λ3.
    #[must_use]
    pub fn turns(&self) -> bool {
        let Self { base, coupler, follower, turn, .. } = *self;
        let lengths = base >= 0.0 && [coupler, follower].iter().all(|length| *length > 0.0 && length.is_finite());
        lengths
            && turn.is_finite()
            && base < 1.0
            && (coupler - follower).abs() < 1.0 - base
            && 1.0 + base < coupler + follower
    }

    /// Refuses a drag link that does not turn.
    ///
    /// # Errors
    /// [`Refusal`] with the links that would pass.
    pub fn check(&self) -> Result<(), Refusal> {
        let Self { base, coupler, follower, turn, .. } = *self;
        if self.turns() {
            return Ok(());
        }
        finite("turn", turn)?;
        let lengths = [("coupler ratio", coupler, coupler > 0.0), ("follower ratio", follower, follower > 0.0)];
        for (name, value, fits) in lengths.into_iter().chain([("base ratio", base, base >= 0.0)]) {
            if !(fits && value.is_finite()) {
                return Err(Refusal::new(format!("the {name} is {value}"))
                    .remedy("it must be a finite number above 0 (a base may be 0)"));
            }
        }
        let remedies = self.remedies();
        Err(if base >= 1.0 {
            Refusal::new(format!("the base is {base} driving cranks long, and must be shorter than the crank"))
                .remedy(format!("a base {} turns", remedies.base))
        } else {
            let fault = if (coupler - follower).abs() >= 1.0 - base {
                format!("differ by 1 − the base {base} or more")
            } else {
                format!("do not reach over 1 + the base {base}")
            };
            Refusal::new(format!("coupler {coupler} and follower {follower} {fault}"))
                .remedy(format!("{remedies} would turn"))
        })
    }

    /// λ1, λ2 and λ3 that turn, each with the other two as they are.
    #[must_use]
    pub fn remedies(&self) -> DragLinkRemedies {
        let Self { coupler, follower, .. } = *self;
        DragLinkRemedies {
            base: Passing {
                above: 0.0,
                below: 1.0_f64.min(1.0 - (coupler - follower).abs()).min(coupler + follower - 1.0),
            },
            coupler: self.passing_beside(follower),
            follower: self.passing_beside(coupler),
        }
    }

    /// What turns for one of coupler and follower, with the base and the other one as they are.
    fn passing_beside(&self, other: f64) -> Passing {
        let base = self.base;
        Passing {
            above: (other - (1.0 - base)).max(1.0 + base - other),
            below: if base < 1.0 { other + (1.0 - base) } else { 0.0 },
        }
    }

    fn links(&self) -> Links<f64> {
        let turn = [libm::cos(self.turn), libm::sin(self.turn)];
        Links { base: self.base, coupler: self.coupler, follower: self.follower, turn, sign: self.branch.sign() }
    }

    /// ψ at θ: θ and two angles that return, arg(A − O2) − θ and the angle of O2B before O2A.
    fn follower_angle(&self, theta: f64) -> f64 {
        let Self { base, coupler, follower, .. } = *self;
        let (cos, sin) = (libm::cos(theta), libm::sin(theta));
        let square = 1.0 + base * base - 2.0 * base * cos;
        let (sum, difference) = (coupler + follower, coupler - follower);
        let heron = (sum * sum - square) * (square - difference * difference);
        let before = libm::atan2(heron.sqrt(), square - sum * difference);
        theta + libm::atan2(base * sin, 1.0 - base * cos) + self.branch.sign() * before
    }

    /// θ at which the follower crank is at ψ, by the mirror image of A in O1B, mended by one step of Newton's method.
    fn driving_angle(&self, psi: f64) -> f64 {
        let Self { base, coupler, follower, .. } = *self;
        let driven = [base + follower * libm::cos(psi), follower * libm::sin(psi)];
        let reach = libm::hypot(driven[0], driven[1]);
        let open = libm::acos((1.0 + reach * reach - coupler * coupler) / (2.0 * reach));
        let toward = libm::atan2(driven[1], driven[0]);
        // cross(A − O2, B − O2) has the sign of the branch.
        let (before, behind) = (toward - open, toward + open);
        let [cross_before, cross_behind] = [before, behind].map(|theta| {
            let along = libm::cos(theta) - base;
            self.branch.sign() * (along * driven[1] - libm::sin(theta) * (driven[0] - base))
        });
        let theta = if cross_before > cross_behind { before } else { behind };
        let crank = self.crank(theta);
        let miss = turned(crank.angle - psi + PI) - PI;
        turned(theta - miss / crank.first)
    }

    /// ψ and its derivatives by θ: ψ' = cos ψ (sin ψ)' − sin ψ (cos ψ)'.
    pub(crate) fn crank(&self, theta: f64) -> Crank {
        let (cos, sin) = self.links().follower_crank::<3>(theta);
        let ([cos, cos1, cos2], [sin, sin1, sin2]) = (cos.derivatives(), sin.derivatives());
        Crank { angle: self.follower_angle(theta), first: cos * sin1 - sin * cos1, second: cos * sin2 - sin * cos2 }
    }

    /// cos μ of the angle at B for a distance d = O2A.
    pub(crate) fn transmission_cosine(&self, distance: f64) -> f64 {
        let Self { coupler, follower, .. } = *self;
        (coupler * coupler + follower * follower - distance * distance) / (2.0 * coupler * follower)
    }

    /// Transmission angle μ between coupler and follower, rad, folded into [0, π/2], at a driving crank angle θ.
    #[must_use]
    pub fn transmission_angle(&self, theta: f64) -> f64 {
        let square = 1.0 + self.base * self.base - 2.0 * self.base * libm::cos(theta);
        libm::acos(self.transmission_cosine(square.sqrt()).abs())
    }

    /// The extremes of the transmission angle as it lies, folded into [0, π/2], rad: at θ = 0 and at θ = π, where O2A is
    /// shortest and longest. The smaller one is the worst of a turn.
    #[must_use]
    pub fn transmission_angles(&self) -> [f64; 2] {
        [1.0 - self.base, 1.0 + self.base].map(|distance| libm::acos(self.transmission_cosine(distance).abs()))
    }
}

impl Linkage {
    /// A crank-slider that turns: λ5 and λ6.
    ///
    /// # Errors
    /// [`Refusal`] with the rod and the offset that would pass.
    pub fn crank_slider(rod_ratio: f64, offset_ratio: f64) -> Result<Self, Refusal> {
        Self::CrankSlider(Slider { rod_ratio, offset_ratio }).check()
    }

    /// A six-bar that turns.
    ///
    /// # Errors
    /// [`Refusal`] for the first inequality violated, with the values that would pass.
    pub fn six_bar(drag_link: DragLink, slider: Slider) -> Result<Self, Refusal> {
        Self::SixBar(drag_link, slider).check()
    }

    /// The linkage itself if it turns.
    ///
    /// # Errors
    /// [`Refusal`] for the first inequality violated, with the values that would pass.
    pub fn check(self) -> Result<Self, Refusal> {
        match self {
            Self::Yoke => {}
            Self::CrankSlider(slider) => slider.check()?,
            Self::SixBar(drag_link, slider) => {
                slider.check()?;
                drag_link.check()?;
            }
        }
        Ok(self)
    }

    /// Its crank-slider; none for a yoke.
    #[must_use]
    pub fn slider(&self) -> Option<Slider> {
        match *self {
            Self::Yoke => None,
            Self::CrankSlider(slider) | Self::SixBar(_, slider) => Some(slider),
        }
    }

    /// Its drag link; none but for a six-bar.
    #[must_use]
    pub fn drag_link(&self) -> Option<DragLink> {
        match *self {
            Self::Yoke | Self::CrankSlider(_) => None,
            Self::SixBar(drag_link, _) => Some(drag_link),
        }
    }

    /// x as a power series about θ.
    fn series<const N: usize>(&self, theta: f64) -> PowerSeries<N> {
        let (crank, slider) = match self {
            Self::Yoke => return PowerSeries::cos_sin(theta).0,
            Self::CrankSlider(slider) => (PowerSeries::cos_sin(theta), slider),
            Self::SixBar(drag_link, slider) => (drag_link.links().crank(theta), slider),
        };
        slider.slide(crank.0, crank.1)
    }

    /// x and its first N − 1 derivatives.
    fn motion<const N: usize>(&self, theta: f64) -> [f64; N] {
        self.series(theta).derivatives()
    }

    /// Place of the bed x and its first five derivatives by θ at the driving crank's angle θ, rad, in units of the slider's
    /// crank O2C. x grows outward: from the shaft O2 to the slider's pin, for a yoke to the crank pin.
    #[must_use]
    pub fn position(&self, theta: f64) -> [f64; 6] {
        self.motion(theta)
    }

    /// Angle ψ of the crank that carries O2C (ψ = θ without a drag link) and its first two derivatives by θ.
    #[must_use]
    pub fn crank(&self, theta: f64) -> Crank {
        match self {
            Self::Yoke | Self::CrankSlider(_) => Crank { angle: theta, first: 1.0, second: 0.0 },
            Self::SixBar(drag_link, _) => drag_link.crank(theta),
        }
    }

    /// Angle β of O2C from the slider's line at θ, rad.
    #[must_use]
    pub fn slider_crank_angle(&self, theta: f64) -> f64 {
        self.crank(theta).angle + self.drag_link().map_or(0.0, |drag_link| drag_link.turn)
    }

    /// θ of the outer dead point (x largest) and of the inner one, rad, in [0, 2π): exact, from the dead points of the slider.
    #[must_use]
    pub fn dead_points(&self) -> [f64; 2] {
        match self {
            Self::Yoke => [0.0, PI],
            Self::CrankSlider(slider) => slider.dead_points().map(turned),
            Self::SixBar(drag_link, slider) => {
                slider.dead_points().map(|beta| drag_link.driving_angle(beta - drag_link.turn))
            }
        }
    }

    /// Stroke S in units of O2C; a drag link does not change it.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        self.slider().map_or(2.0, |slider| slider.stroke())
    }

    /// Transmission angle of the drag link at θ, rad, folded into [0, π/2].
    #[must_use]
    pub fn transmission_angle(&self, theta: f64) -> Option<f64> {
        Some(self.drag_link()?.transmission_angle(theta))
    }

    /// Its extremes at θ = 0 and θ = π, rad.
    #[must_use]
    pub fn transmission_angles(&self) -> Option<[f64; 2]> {
        Some(self.drag_link()?.transmission_angles())
    }

    /// Angle χ of the rod to the slider's line at θ, rad: sin χ = (sin β − λ6)/λ5; 0 for a yoke.
    #[must_use]
    pub fn rod_angle(&self, theta: f64) -> f64 {
        self.slider().map_or(0.0, |slider| {
            libm::asin((libm::sin(self.slider_crank_angle(theta)) - slider.offset_ratio) / slider.rod_ratio)
        })
    }

    /// Largest |χ| of a turn, rad: asin((1 + |λ6|)/λ5).
    #[must_use]
    pub fn largest_rod_angle(&self) -> f64 {
        self.slider().map_or(0.0, |slider| libm::asin((1.0 + slider.offset_ratio.abs()) / slider.rod_ratio))
    }

    /// θ at which the rod has its largest angle, rad: β = ∓90° for an offset to the left or right.
    #[must_use]
    pub fn steepest_rod(&self) -> f64 {
        let beta = if self.slider().is_some_and(|slider| slider.offset_ratio > 0.0) { -FRAC_PI_2 } else { FRAC_PI_2 };
        self.drag_link().map_or(turned(beta), |drag_link| drag_link.driving_angle(beta - drag_link.turn))
    }

    /// Places of the joints at θ for a drawing, in units of O2C.
    #[must_use]
    pub fn joints(&self, theta: f64, pose: Pose) -> Joints {
        let crank = along(self.slider_crank_angle(theta), 1.0);
        let [x] = self.motion(theta);
        let drag_link = self.drag_link().map(|drag_link| {
            let unit = 1.0 / pose.crank_ratio;
            let shaft = along(pose.base_angle, -drag_link.base * unit);
            let arm = along(theta + pose.base_angle, unit);
            DragLinkJoints {
                shaft,
                driving: [shaft[0] + arm[0], shaft[1] + arm[1]],
                driven: along(drag_link.follower_angle(theta) + pose.base_angle, drag_link.follower * unit),
            }
        });
        Joints { drag_link, crank, slider: [x, self.slider().map_or(0.0, |slider| slider.offset_ratio)] }
    }
}

/// The vector of a link of this length at an angle, rad.
fn along(angle: f64, length: f64) -> [f64; 2] {
    [length * libm::cos(angle), length * libm::sin(angle)]
}

#[cfg(test)]
pub(crate) mod tests;

//! The brake without slip: the belt holds the roll's surface at V_z, a little slower than the web, and the web stretches.
//!
//! The mass flow of the web is equal everywhere: with ε_w wound into the roll and ε = P/(δ b E) before the printing nip,
//!
//! ```text
//! V_z/V = (1 + ε_w)/(1 + ε)         P_strain = δ b E ((1 + ε_w) V/V_z − 1)
//! (14) β = 1 − ε = 1 − σ/E          (15) Δl = σ l/E
//! ```
//!
//! (14) is the first order of the first, without ε_w. The belt slips as soon as P_strain exceeds what the weight grips, so that the
//! tension over V_z/V is this line up to the plateau of [`super::Brake::tension`]. dP/P = −(1/ε) dβ/β: a hundredth of a per cent of
//! speed is several per cent of tension, ε_w enters one to one, and E as it is. The paper does not say so.

use super::error::{finite, positive};
use camgen_kernel::refusal::Refusal;
use std::f64::consts::PI;

/// The web.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Web {
    /// δ, m.
    pub thickness: f64,
    /// b, m.
    pub width: f64,
    /// E at the speed of the pull, Pa.
    pub modulus: f64,
    /// V, m/s.
    pub speed: f64,
    /// ε_w, above −1.
    pub wound_strain: f64,
    /// l from the roll to the printing nip, m, for (15).
    pub length: Option<f64>,
}

impl Web {
    /// The web, with every number checked.
    ///
    /// # Errors
    /// [`Refusal`] with the name of the number.
    pub fn checked(self) -> Result<Self, Refusal> {
        let all = [
            ("web thickness", self.thickness),
            ("web width", self.width),
            ("modulus", self.modulus),
            ("web speed", self.speed),
            ("stiffness of the web", self.stiffness()),
            ("web length", self.length.unwrap_or(1.0)),
        ];
        all.into_iter().try_for_each(|(name, value)| positive(name, value))?;
        finite("wound strain", self.wound_strain)?;
        positive("wound strain plus 1", 1.0 + self.wound_strain)?;
        Ok(self)
    }

    /// δ b E, N: tension over strain.
    #[must_use]
    pub fn stiffness(&self) -> f64 {
        self.thickness * self.width * self.modulus
    }

    /// ε at a tension, N.
    #[must_use]
    pub fn strain(&self, tension: f64) -> f64 {
        tension / self.stiffness()
    }

    /// σ, Pa.
    #[must_use]
    pub fn stress(&self, tension: f64) -> f64 {
        tension / (self.thickness * self.width)
    }

    /// β = V_z/V of (14), of first order and for a roll wound without strain.
    #[must_use]
    pub fn belt_speed_printed(&self, tension: f64) -> f64 {
        1.0 - self.strain(tension)
    }

    /// V_z/V that makes a tension, N.
    #[must_use]
    pub fn belt_speed(&self, tension: f64) -> f64 {
        (1.0 + self.wound_strain) / (1.0 + self.strain(tension))
    }

    /// P_strain, N: the tension at V_z/V with a belt that does not slip; infinite where it stands still, negative where it would push.
    #[must_use]
    pub fn tension(&self, belt_speed: f64) -> f64 {
        // (1 + ε_w)/β − 1 without the difference of two numbers near 1.
        self.stiffness() * ((1.0 - belt_speed) + self.wound_strain) / belt_speed
    }

    /// P, N, of a brake that can hold `grip`, N, at V_z/V: strain up to the grip, then a plateau that no belt speed changes.
    #[must_use]
    pub fn tension_within(&self, grip: f64, belt_speed: f64) -> f64 {
        if belt_speed > 0.0 { self.tension(belt_speed).min(grip) } else { grip }
    }

    /// −d ln P/d ln β = 1/ε of the first order: by how many per cent a per cent of belt speed changes the tension.
    #[must_use]
    pub fn sensitivity(&self, tension: f64) -> f64 {
        1.0 / self.strain(tension)
    }

    /// Δl of (15), m, where the length is known.
    #[must_use]
    pub fn stretch(&self, tension: f64) -> Option<f64> {
        Some(self.strain(tension) * self.length?)
    }

    /// The power P V of the web, W, split into belt drive (P V_z) and heat (P (V − V_z)).
    #[must_use]
    pub fn powers(&self, tension: f64, belt_speed: f64) -> (f64, f64) {
        let power = tension * self.speed;
        (power * belt_speed, power * (1.0 - belt_speed))
    }

    /// J of the roll, kg m², with a density, kg/m³, outside a core of its own (m): ½ π ρ b (R⁴ − R_core⁴).
    #[must_use]
    pub fn inertia(&self, density: f64, radius: f64, core: f64) -> f64 {
        let (outer, inner) = (radius * radius, core * core);
        0.5 * PI * density * self.width * (outer - inner) * (outer + inner)
    }

    /// J V̇/R², N: the increase of the tension at an acceleration of the machine, m/s².
    #[must_use]
    pub fn acceleration_tension(&self, inertia: f64, radius: f64, acceleration: f64) -> f64 {
        inertia * acceleration / (radius * radius)
    }
}

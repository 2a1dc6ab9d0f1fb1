//! The machine of the drive-speed law except its bore, and the values with which it closes.

use crate::press::buffer::bottom_law::SERIES_LIMIT;
use crate::press::buffer::{CYLINDERS, total_area};
use camgen_kernel::numeric::root;
use camgen_kernel::refusal::Refusal;

/// Bed, crank and buffers, but for the bore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BufferedBed {
    /// Mass of the bed, kg.
    pub bed_mass: f64,
    /// Crank radius r, m.
    pub crank_radius: f64,
    /// Lead angle φ_в, rad, ≥ 0: how long the bed is braked before the crank turns it.
    pub lead_angle: f64,
    /// Speed v0 of the bed before braking, m/s.
    pub bed_speed: f64,
    /// Air column L at the start of compression, m.
    pub column: f64,
    /// Ambient pressure p0, Pa, absolute.
    pub ambient_pressure: f64,
    /// Polytropic exponent k ≥ 1.
    pub exponent: f64,
}

/// Σ (k)_(n−1) zⁿ/n! for n ≥ 2 = [(1−z)^(1−k) − 1]/(k−1) − z for 0 ≤ z < 1; with L − x = L (1 − z) the work is 2 p0 F L of it.
pub(super) fn compression(z: f64, k: f64) -> f64 {
    if z < SERIES_LIMIT {
        let (mut term, mut sum, mut n) = (z, 0.0, 1.0);
        loop {
            term *= z * (k + n - 1.0) / (n + 1.0);
            sum += term;
            // Written so that a NaN ends it too.
            if !(term > f64::EPSILON * 0.125 * sum) {
                return sum;
            }
            n += 1.0;
        }
    }
    compression_of_log(-libm::log1p(-z), k)
}

/// The compression by τ = −ln(1 − z).
fn compression_of_log(log: f64, k: f64) -> f64 {
    let power = k - 1.0;
    let gas = if power == 0.0 { log } else { libm::expm1(power * log) / power };
    gas + libm::expm1(-log)
}

/// That an input (SI) is not above 0.
pub(super) fn not_positive(name: &str, value: f64) -> Refusal {
    Refusal::new(format!("the {name} is {value}")).remedy("it must be a finite number above 0")
}

impl BufferedBed {
    /// Whole overrun x_e = r (1 + φ_в), m.
    #[must_use]
    pub fn stroke(&self) -> f64 {
        self.crank_radius * (1.0 + self.lead_angle)
    }

    /// Energy of the bed before braking, J.
    #[must_use]
    pub fn energy(&self) -> f64 {
        0.5 * self.bed_mass * self.bed_speed * self.bed_speed
    }

    /// Area of one piston, m², with which the buffers just take the bed's energy over the stroke.
    #[must_use]
    pub fn closing_area(&self) -> f64 {
        self.energy()
            / (f64::from(CYLINDERS)
                * self.ambient_pressure
                * self.column
                * compression(self.stroke() / self.column, self.exponent))
    }

    /// Column, m, with which buffers of a given piston area (m²) just take the bed's energy; `None` where it would exceed the
    /// stroke by less than rounding.
    ///
    /// Over 2 p0 F x_e the work is `compression`/z, z = x_e/L: it rises from 0 without bound, so there is one root.
    #[must_use]
    pub fn closing_column(&self, piston_area: f64) -> Option<f64> {
        let (k, stroke) = (self.exponent, self.stroke());
        let wanted = self.energy() / (self.ambient_pressure * total_area(piston_area) * stroke);
        // e^−36 is the last change of 1 − z that L/(L − x_e) can show; 1e-12 a column of a million million strokes.
        let log = root::bracketed(
            |log| {
                let z = -libm::expm1(-log);
                let gas = if z < SERIES_LIMIT { compression(z, k) } else { compression_of_log(log, k) };
                gas / z - wanted
            },
            1e-12,
            36.0,
            0.0,
        )
        .ok()?;
        Some(stroke / -libm::expm1(-log))
    }

    /// Ambient pressure, Pa, with which buffers of a given piston area (m²) just take the bed's energy: the work is
    /// proportional to it.
    #[must_use]
    pub fn closing_pressure(&self, piston_area: f64) -> f64 {
        self.ambient_pressure * self.closing_area() / piston_area
    }

    pub(super) fn check(&self) -> Result<(), Refusal> {
        for (name, value) in [
            ("bed mass", self.bed_mass),
            ("crank radius", self.crank_radius),
            ("bed speed", self.bed_speed),
            ("air column", self.column),
            ("ambient pressure", self.ambient_pressure),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(not_positive(name, value));
            }
        }
        if !(self.lead_angle >= 0.0 && self.lead_angle.is_finite()) {
            return Err(Refusal::new(format!("the lead angle is {} rad", self.lead_angle))
                .remedy("it must be a finite number from 0"));
        }
        if !(self.exponent >= 1.0 && self.exponent.is_finite()) {
            return Err(Refusal::new(format!("the polytropic exponent is {}", self.exponent))
                .remedy("it must be a finite number from 1"));
        }
        // Nearer the force at the end is beyond any machine.
        if !(self.column > self.stroke() * (1.0 + 1e-9)) {
            let (column, stroke) = (1e3 * self.column, 1e3 * self.stroke());
            let what = format!("the air column of {column} mm is used up within the stroke of {stroke} mm");
            return Err(Refusal::new(what).remedy("give a longer one"));
        }
        Ok(())
    }
}

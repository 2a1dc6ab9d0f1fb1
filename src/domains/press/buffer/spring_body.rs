//! The coil spring under a bottom: wire, coils, stress and surge of a helical compression spring of round wire.
//!
//! Rate G d⁴/(8 D³ n), shear stress 8 F D K/(π d³) with A. M. Wahl's factor K = (4 i − 1)/(4 i − 4) + 0.615/i of the index i = D/d, first
//! natural frequency between plates d/(2π n D²) √(G/(2ρ)) (Shigley's Mechanical Engineering Design, 9th ed., ch. 10).

use std::f64::consts::PI;

/// Shear modulus of spring steel, Pa, and its density, kg/m³.
const SHEAR_MODULUS: f64 = 81.5e9;
const DENSITY: f64 = 7850.0;
/// Coils that are ground flat and do not give way.
const DEAD_COILS: f64 = 2.0;

/// What is given of a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpringShape {
    /// Index i = D/d: the wire is the thinnest that keeps the stress.
    Index(f64),
    /// Diameter of the wire d and mean diameter of the coils D, m.
    Wire {
        /// d.
        wire: f64,
        /// D.
        coil: f64,
    },
}

/// A spring for a force and a rate; m, N, Pa, Hz.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringBody {
    /// Diameter of the wire d.
    pub wire: f64,
    /// Mean diameter of the coils D.
    pub coil: f64,
    /// Coils that give way, n.
    pub coils: f64,
    /// Largest shear stress.
    pub stress: f64,
    /// First natural frequency.
    pub surge: f64,
    /// Length with all coils touching.
    pub solid_length: f64,
}

/// Wahl's factor of an index.
fn wahl(index: f64) -> f64 {
    (4.0 * index - 1.0) / (4.0 * index - 4.0) + 0.615 / index
}

impl SpringBody {
    /// The spring of a rate (N/m) under a largest force (N), with an allowable stress (Pa).
    #[must_use]
    pub fn new(shape: SpringShape, force: f64, rate: f64, allowable: f64) -> Self {
        let (wire, index) = match shape {
            SpringShape::Index(index) => (libm::sqrt(8.0 * force * index * wahl(index) / (PI * allowable)), index),
            SpringShape::Wire { wire, coil } => (wire, coil / wire),
        };
        let coil = index * wire;
        let coils = SHEAR_MODULUS * wire / (8.0 * rate * index * index * index);
        Self {
            wire,
            coil,
            coils,
            stress: 8.0 * force * coil * wahl(index) / (PI * wire * wire * wire),
            surge: wire / (2.0 * PI * coils * coil * coil) * libm::sqrt(SHEAR_MODULUS / (2.0 * DENSITY)),
            solid_length: (coils + DEAD_COILS) * wire,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By 34-digit arithmetic, outside of the project; and the same spring by its wire and coils.
    #[test]
    fn golden_spring() {
        let body = SpringBody::new(SpringShape::Index(6.0), 10_644.05, 66_685.22, 700e6);
        for (got, golden) in
            [(1e3 * body.wire, 17.058_427_05), (body.coils, 12.064_887_17), (body.surge, 48.942_298_51)]
        {
            assert!((got / golden - 1.0).abs() < 1e-7, "{got} {golden}");
        }
        assert!((body.stress / 700e6 - 1.0).abs() < 1e-14);
        let same = SpringShape::Wire { wire: body.wire, coil: body.coil };
        let same = SpringBody::new(same, 10_644.05, 66_685.22, 1.0);
        assert!((same.coils / body.coils - 1.0).abs() < 1e-13 && (same.stress / 700e6 - 1.0).abs() < 1e-13);
    }

    /// Shigley's Mechanical Engineering Design, 9th ed., example 10–1, with its own figures: music wire of 0.037 in, mean diameter 0.400 in, 12.5 coils
    /// in all of which 10.5 give way, squared ends; rate 4.13 lbf/in by its G of 11.85 Mpsi. The rate here is by the G of this module.
    #[test]
    fn a_published_spring() {
        let (inch, pound) = (0.0254, 4.448_221_615_260_5);
        let (wire, coil) = (0.037 * inch, 0.400 * inch);
        let rate = 4.13 * pound / inch * SHEAR_MODULUS / (11.85e6 * 6_894.757_293_168);
        let body = SpringBody::new(SpringShape::Wire { wire, coil }, pound, rate, 1.0);
        assert!((body.coils / 10.5 - 1.0).abs() < 2e-3, "{}", body.coils);
    }
}

//! The coil spring under a bottom: wire, coils, stress and surge of a helical compression spring of round wire.
//!
//! Rate G d⁴/(8 D³ n), shear stress 8 F D K/(π d³) with A. M. Wahl's factor K = (4 i − 1)/(4 i − 4) + 0.615/i of the index i = D/d, first
//! natural frequency between plates d/(2π n D²) √(G/(2ρ)) (Shigley's Mechanical Engineering Design, 9th ed., ch. 10). Between plates it buckles
//! from the deflection L0 C1 [1 − √(1 − C2 (D/(½ L0))²)] on, C1 = E/(2 (E − G)), C2 = 2π² (E − G)/(2 G + E) (eq. 10–10 there, after A. M. Wahl).

use std::f64::consts::PI;

/// Shear modulus of spring steel, Pa, and its density, kg/m³.
const SHEAR_MODULUS: f64 = 81.5e9;
const DENSITY: f64 = 7850.0;
/// Modulus of elasticity of spring steel, Pa (EN 10270-1).
const ELASTICITY: f64 = 206e9;
/// Share of the deflection that is left between the coils at its end (eq. 10–20 there).
const CLASH_ALLOWANCE: f64 = 0.15;
/// Effective free length between parallel plates / with hinged ends.
const BETWEEN_PLATES: f64 = 0.5;
/// Coils that are ground flat and do not give way.
const DEAD_COILS: f64 = 2.0;

/// What is given of a spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpringShape {
    /// Index i = D/d: the wire is the thinnest that keeps the stress.
    Index(f64),
    /// Index i: the wire is the thinnest standard one that keeps the stress.
    Standard(f64),
    /// Mean diameter of the coils D, m: the wire is the thinnest standard one that keeps the stress.
    StandardFor(f64),
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
    /// Length without a force.
    pub free_length: f64,
    /// Largest deflection over that at which the spring buckles; 0 where it never does.
    pub buckling: f64,
}

/// Diameters of drawn wire up to 20 mm and of bars above, mm: the preferred ones of EN 10270-1 and EN 10060.
const STANDARD_WIRES: [f64; 48] = [
    0.5, 0.56, 0.63, 0.7, 0.8, 0.9, 1.0, 1.1, 1.25, 1.4, 1.6, 1.8, 2.0, 2.25, 2.5, 2.8, 3.2, 3.6, 4.0, 4.5, 5.0, 5.6,
    6.3, 7.0, 8.0, 9.0, 10.0, 11.0, 12.5, 14.0, 16.0, 18.0, 20.0, 22.0, 25.0, 28.0, 30.0, 32.0, 36.0, 40.0, 45.0, 50.0,
    55.0, 60.0, 70.0, 80.0, 90.0, 100.0,
];
/// A wire that is found to be a standard one within this share is that one.
const SAME_WIRE: f64 = 1e-12;

/// The thinnest standard wire that is not thinner than this, m; `None` beyond the thickest.
fn standard(wire: f64) -> Option<f64> {
    STANDARD_WIRES.into_iter().map(|mm| mm / 1e3).find(|standard| *standard >= wire * (1.0 - SAME_WIRE))
}

/// The thinnest standard wire in coils of a mean diameter (m) that keeps something, m; the thickest that they have room for where none does.
fn standard_for(coil: f64, keeps: impl Fn(f64) -> bool) -> f64 {
    let mut thickest = None;
    for wire in STANDARD_WIRES.into_iter().map(|mm| mm / 1e3).filter(|wire| coil >= 2.0 * wire) {
        if keeps(wire) {
            return wire;
        }
        thickest = Some(wire);
    }
    thickest.unwrap_or(0.5 * coil)
}

/// The wire of an index, m, that a force, N, brings to its allowable stress, Pa.
fn thinnest(index: f64, force: f64, allowable: f64) -> f64 {
    libm::sqrt(8.0 * force * index * wahl(index) / (PI * allowable))
}

/// Shear stress of a wire in coils of a mean diameter, m, under a force, N.
fn stress_of(force: f64, coil: f64, wire: f64) -> f64 {
    8.0 * force * coil * wahl(coil / wire) / (PI * wire * wire * wire)
}

/// Deflection over that at which a spring of a free length and a mean diameter buckles between plates; 0 where it never does.
fn buckling(free: f64, coil: f64, deflection: f64) -> f64 {
    let stiffer = ELASTICITY - SHEAR_MODULUS;
    let slenderness = BETWEEN_PLATES * free / coil;
    let least = 2.0 * PI * PI * stiffer / (2.0 * SHEAR_MODULUS + ELASTICITY);
    let inside = 1.0 - least / (slenderness * slenderness);
    if inside < 0.0 {
        return 0.0;
    }
    let critical = free * ELASTICITY / (2.0 * stiffer) * (1.0 - libm::sqrt(inside));
    deflection / critical
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
            SpringShape::Index(index) => (thinnest(index, force, allowable), index),
            SpringShape::Standard(index) => {
                let thinnest = thinnest(index, force, allowable);
                (standard(thinnest).unwrap_or(thinnest), index)
            }
            SpringShape::StandardFor(coil) => {
                let wire = standard_for(coil, |wire| stress_of(force, coil, wire) <= allowable);
                (wire, coil / wire)
            }
            SpringShape::Wire { wire, coil } => (wire, coil / wire),
        };
        let coil = index * wire;
        let coils = SHEAR_MODULUS * wire / (8.0 * rate * index * index * index);
        let (solid_length, deflection) = ((coils + DEAD_COILS) * wire, force / rate);
        let free_length = solid_length + (1.0 + CLASH_ALLOWANCE) * deflection;
        Self {
            wire,
            coil,
            coils,
            stress: 8.0 * force * coil * wahl(index) / (PI * wire * wire * wire),
            surge: wire / (2.0 * PI * coils * coil * coil) * libm::sqrt(SHEAR_MODULUS / (2.0 * DENSITY)),
            solid_length,
            free_length,
            buckling: buckling(free_length, coil, deflection),
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

    /// A published spring: G, N/mm², wire and mean diameter of the coils, mm, rate, N/mm, coils that give way.
    type RatedSpring = (&'static str, f64, [f64; 2], f64, f64);

    const INCH: f64 = 25.4;
    const POUND: f64 = 4.448_221_615_260_5;
    const PSI: f64 = 6_894.757_293_168e-6;

    /// Rates of published springs, by their own G, within the digits that are printed.
    const RATED: &[RatedSpring] = &[
        (
            "Budynas & Nisbett, Shigley's Mechanical Engineering Design, 9th ed., example 10–1",
            11.85e6 * PSI,
            [0.037 * INCH, 0.400 * INCH],
            4.13 * POUND / INCH,
            10.5,
        ),
        ("the same, 10th ed., problem 10–3, by its solutions", 81e3, [2.5, 28.5], 1.314, 13.0),
        (
            "the same, 8th ed., problem 10–3, by its solutions",
            11.75e6 * PSI,
            [0.105 * INCH, 1.120 * INCH],
            11.55 * POUND / INCH,
            11.0,
        ),
        (
            "Faires, Design of Machine Elements, problem 271, by its solutions: 2850 lb over 3 in",
            10.5e6 * PSI,
            [INCH, 5.0 * INCH],
            950.0 * POUND / INCH,
            11.05,
        ),
        ("S. Singh, Machine Design I, example 8.1", 84e3, [4.25, 34.0], 6.25, 14.0),
        ("S. Singh, Machine Design I, example 8.3", 84e3, [3.0, 18.0], 9.72, 15.0),
        ("S. Singh, Machine Design I, example 8.7", 84e3, [8.0, 48.0], 61.85, 6.29),
        ("S. Singh, Machine Design I, example 8.8", 85e3, [4.0, 19.36], 12.5, 30.0),
    ];

    #[test]
    fn rates_of_published_springs() {
        for &(source, shear, [wire, coil], rate, coils) in RATED {
            let shape = SpringShape::Wire { wire: 1e-3 * wire, coil: 1e-3 * coil };
            let body = SpringBody::new(shape, 1.0, 1e3 * rate * SHEAR_MODULUS / (1e6 * shear), 1.0);
            // Three digits are printed, or whole coils.
            assert!((body.coils / coils - 1.0).abs() < 5e-3, "{source}: {} coils", body.coils);
        }
    }

    /// Published stresses by Wahl's factor: force, N, index, wire, mm, stress, N/mm², and the digits of the printed one.
    #[test]
    fn stresses_of_published_springs() {
        for (source, force, index, wire, stress, printed) in [
            ("S. Singh, Machine Design I, example 8.3", 40.0, 6.0, 3.0, 85.05, 1e-4),
            ("the same, the load that yields", 305.7, 6.0, 3.0, 650.0, 2e-4),
            ("S. Singh, Machine Design I, example 8.8", 1000.0, 4.84, 4.0, 1018.54, 2e-3),
            ("Faires, Design of Machine Elements, problem 271", 2850.0 * POUND, 5.0, INCH, 47.55e3 * PSI, 2e-4),
        ] {
            let shape = SpringShape::Wire { wire: 1e-3 * wire, coil: 1e-3 * wire * index };
            let got = 1e-6 * SpringBody::new(shape, force, 1e4, 1.0).stress;
            assert!((got / stress - 1.0).abs() < printed, "{source}: {got} is not {stress}");
        }
        // The thinnest wire of an index and a stress.
        for (source, force, index, stress, wire) in [
            ("S. Singh, Machine Design I, example 8.1", 300.0, 8.0, 420.0, 4.15),
            ("S. Singh, Machine Design I, example 8.5", 5301.4, 6.0, 600.0, 13.0),
            ("S. Singh, Machine Design I, example 8.7", 1484.4, 6.0, 500.0, 7.54),
        ] {
            let got = 1e3 * SpringBody::new(SpringShape::Index(index), force, 1e4, 1e6 * stress).wire;
            assert!((got - wire).abs() < 0.01, "{source}: {got} is not {wire}");
        }
        // Shigley's Mechanical Engineering Design, 10th ed., problem 10–1: Wahl's factor is 1.36 % above Bergsträsser's at 4, and 0.743 % at 12.
        for (index, percent) in [(4.0, 1.36), (12.0, 0.743)] {
            let other = (4.0 * index + 2.0) / (4.0 * index - 3.0);
            assert!((100.0 * (1.0 - other / wahl(index)) - percent).abs() < 5e-3, "{index}");
        }
    }

    /// Shigley's Mechanical Engineering Design, 10th ed., problem 10–3: coils of 28.5 mm between plates buckle from a free length of 149.9 mm on, by his
    /// rounded 2.63 D/½ for steel; the moduli of this module make it 2.58. At that length the spring buckles when it is deflected by E/(2 (E − G)) of it.
    #[test]
    fn where_springs_buckle() {
        let longest = |coil: f64| {
            let lengths = (1..100_000).map(|i| 1e-5 * f64::from(i));
            lengths.take_while(|free| buckling(*free, coil, 1e-3) == 0.0).last().unwrap_or(0.0)
        };
        let found = 1e3 * longest(28.5e-3);
        assert!((found / 149.9 - 1.0).abs() < 0.02, "{found}");
        let critical = 1e-3 / buckling(1e-3 * found + 2e-5, 28.5e-3, 1e-3);
        assert!((critical / (1e-3 * found) - 206.0 / 249.0).abs() < 0.02, "{critical}");
        assert!(buckling(0.4, 28.5e-3, 1e-3) > buckling(0.3, 28.5e-3, 1e-3) * 0.9);
    }

    #[test]
    fn a_standard_wire_keeps_the_stress() {
        let thinnest = SpringBody::new(SpringShape::Index(6.0), 10_644.05, 66_685.22, 700e6);
        let body = SpringBody::new(SpringShape::Standard(6.0), 10_644.05, 66_685.22, 700e6);
        assert_eq!((body.wire, body.coil / body.wire), (0.018, 6.0));
        assert!(body.stress < 700e6 && body.wire > thinnest.wire);
        // The rate is kept: by the formula as printed.
        let rate = SHEAR_MODULUS * libm::pow(body.wire, 4.0) / (8.0 * libm::pow(body.coil, 3.0) * body.coils);
        assert!((rate / 66_685.22 - 1.0).abs() < 1e-13);
        // Singh's wire of 4.15 mm (example 8.1) becomes the next one of the standard, 4.5 mm; the thickest bar has no next one.
        assert_eq!(standard(4.15e-3), Some(4.5e-3));
        assert_eq!((standard(0.018), standard(0.101)), (Some(0.018), None));
        assert!(STANDARD_WIRES.is_sorted());
        let on_coil = SpringBody::new(SpringShape::StandardFor(0.108), 10_644.05, 66_685.22, 700e6);
        assert!(on_coil.wire == 0.018 && (on_coil.coil / 0.108 - 1.0).abs() < 1e-15, "{on_coil:?}");
        assert!(stress_of(10_644.05, 0.108, 0.016) > 700e6);
    }
}

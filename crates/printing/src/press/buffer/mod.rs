//! The air buffer: cylinder to pressure, force and sizing, equations (1)–(15) and (26)–(28) of the paper.
//!
//! [`CYLINDERS`] cylinders at each end of the bed brake it over its overrun x; the air follows p·vᵏ = const. All pressures are
//! absolute. Knows the bed's overrun, not the angles of any cam.

pub mod bottom_law;
pub mod camshaft;
pub mod crank_law;
pub mod drive;
pub mod energy;
pub mod level_air;
pub mod place_law;
pub mod regime;
pub mod spring;
pub mod spring_body;

use camgen_cams::report::Shaft;
use crank_law::CrankLaw;
use std::f64::consts::PI;

/// Cylinders at each end of the bed, braking it together.
pub const CYLINDERS: u32 = 2;

/// Area of all pistons at one end of the bed, m², from the area of one.
#[must_use]
pub fn total_area(piston_area: f64) -> f64 {
    f64::from(CYLINDERS) * piston_area
}

/// Bore of a cylinder, m, from the area of its piston.
#[must_use]
pub fn bore_of(piston_area: f64) -> f64 {
    (4.0 * piston_area / PI).sqrt()
}

/// The bed and the crank that reverses it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bed {
    /// Mass, kg.
    pub mass: f64,
    /// Crank radius r, m: the whole overrun.
    pub crank_radius: f64,
    /// Turns of the crank for one turn of the main shaft.
    pub crank_turns_per_main_shaft_turn: f64,
}

impl Bed {
    /// Angular speed ω of the crank, rad/s, at a speed of the main shaft in revolutions per minute.
    #[must_use]
    pub fn crank_speed(&self, rpm: f64) -> f64 {
        2.0 * PI * rpm * self.crank_turns_per_main_shaft_turn / 60.0
    }

    /// The shaft of a cam with these lobes, one for each turn of the crank, if it does not turn as fast as the main shaft.
    #[must_use]
    pub fn shaft(&self, name: &'static str, lobes: u32) -> Option<Shaft> {
        let turns_per_main_shaft_turn = self.crank_turns_per_main_shaft_turn / f64::from(lobes.max(1));
        (turns_per_main_shaft_turn != 1.0).then(|| Shaft { name: name.into(), turns_per_main_shaft_turn })
    }

    /// Largest inertia force m ω² r of a bed that is moved by a yoke, N: equation (1) at the end of the overrun.
    #[must_use]
    pub fn largest_inertia(&self, rpm: f64) -> f64 {
        self.inertia(rpm, self.crank_radius)
    }

    /// Inertia force m ω² a, N, at a deceleration a over the square of the crank speed, m.
    #[must_use]
    pub fn inertia(&self, rpm: f64, deceleration: f64) -> f64 {
        let omega = self.crank_speed(rpm);
        self.mass * omega * omega * deceleration
    }
}

/// The equal cylinders at one end of the bed, sized at the design speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    /// Area F of the piston of one cylinder, m².
    pub piston_area: f64,
    /// Polytropic exponent k.
    pub exponent: f64,
    /// Ambient pressure p0, Pa, absolute.
    pub ambient_pressure: f64,
    /// A at the design speed, 1/m.
    design_loading: f64,
    design_rpm: f64,
}

impl Cylinder {
    /// Sizes the cylinders so that the air of the end pressure holds the bed at x = r at the design speed,
    /// equations (3), (4) and (13): A = (q − 1)/r.
    #[must_use]
    pub fn sized(bed: &Bed, design_rpm: f64, exponent: f64, ambient_pressure: f64, end_pressure: f64) -> Self {
        Self::sized_for(bed, bed.crank_radius, design_rpm, exponent, ambient_pressure, end_pressure)
    }

    /// Sizes the cylinders for a = largest deceleration / (crank speed)², m: A = (q − 1)/a.
    #[must_use]
    pub fn sized_for(
        bed: &Bed,
        deceleration: f64,
        design_rpm: f64,
        exponent: f64,
        ambient_pressure: f64,
        end_pressure: f64,
    ) -> Self {
        let piston_area =
            bed.inertia(design_rpm, deceleration) / (f64::from(CYLINDERS) * (end_pressure - ambient_pressure));
        let design_loading = (end_pressure / ambient_pressure - 1.0) / deceleration;
        Self { piston_area, exponent, ambient_pressure, design_loading, design_rpm }
    }

    /// Bore `D_a` of one cylinder, m.
    #[must_use]
    pub fn bore(&self) -> f64 {
        bore_of(self.piston_area)
    }

    /// Volume of all cylinders, m³, over a length, m.
    #[must_use]
    pub fn volume(&self, length: f64) -> f64 {
        total_area(self.piston_area) * length
    }

    /// A = m ω²/(2 p0 F) of equation (11) at a speed, 1/m: grows with the square of the speed.
    #[must_use]
    pub fn loading(&self, rpm: f64) -> f64 {
        let ratio = rpm / self.design_rpm;
        self.design_loading * ratio * ratio
    }

    /// Net force of all pistons, N, at a pressure ratio p/p0, with ambient pressure on their other side.
    #[must_use]
    pub fn force(&self, pressure_ratio: f64) -> f64 {
        self.unit_force() * (pressure_ratio - 1.0)
    }

    /// Largest inertia force of the bed, N, by the loading of a law.
    #[must_use]
    pub fn largest_load(&self, law: &CrankLaw) -> f64 {
        law.loading() * law.largest_deceleration() * self.unit_force()
    }

    /// Largest size of the residual force of a plain buffer with fixed bottom and column by (7) at the speed of a law, N.
    #[must_use]
    pub fn residual_fixed_bottom(&self, law: &CrankLaw) -> f64 {
        law.residual_of_fixed_bottom().value * self.unit_force()
    }

    /// 2 p0 F, N: what every dimensionless force is multiplied by.
    #[must_use]
    pub fn unit_force(&self) -> f64 {
        self.ambient_pressure * total_area(self.piston_area)
    }
}

/// A buffer with a fixed bottom, its column by (7) so that the end pressure is right at x = r.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlainBuffer {
    /// Column L at the start of compression, m.
    pub column: f64,
    loading: f64,
    exponent: f64,
}

impl PlainBuffer {
    /// Column by (7) for the loading A: `h_a` = r.
    #[must_use]
    pub fn new(loading: f64, exponent: f64, crank_radius: f64) -> Self {
        let column = bottom_law::column_for(crank_radius, loading * crank_radius, exponent);
        Self { column, loading, exponent }
    }

    /// Air force over 2 p0 F at overrun x, equation (9).
    #[must_use]
    pub fn air(&self, x: f64) -> f64 {
        libm::expm1(-self.exponent * libm::log1p(-x / self.column))
    }

    /// Where the residual A x − air is largest, and its value over 2 p0 F.
    ///
    /// The residual is concave in x and zero at both ends; its slope A − (k/L)(L/(L−x))^(k+1) vanishes at
    /// x = L (1 − c^(−1/(k+1))), c = L A/k.
    #[must_use]
    pub fn largest_residual(&self) -> (f64, f64) {
        let c = self.column * self.loading / self.exponent;
        let x = -self.column * libm::expm1(-libm::log(c) / (self.exponent + 1.0));
        (x, self.loading * x - self.air(x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::units::KILOGRAM_FORCE;

    /// The machine of the reference numbers: press ДПИ, inferred from the figures of the paper.
    pub(crate) fn reference(end_pressure_at: f64) -> (Bed, Cylinder) {
        let bed = Bed { mass: 978.2, crank_radius: 0.18, crank_turns_per_main_shaft_turn: 3.0 };
        let cylinder = Cylinder::sized(&bed, 35.0, 1.35, 98_066.5, end_pressure_at * 98_066.5);
        (bed, cylinder)
    }

    /// Numbers spread evenly, the same in every run: SplitMix64 (Steele, Lea & Flood, OOPSLA 2014).
    pub(crate) struct Random(pub(crate) u64);

    impl Random {
        /// In [low, high).
        pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
            self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let mut z = self.0;
            z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
            let bits = u32::try_from((z ^ (z >> 31)) >> 32).expect("32 bits");
            low + (high - low) * (f64::from(bits) / 4_294_967_296.0)
        }

        /// In [low, high), the logarithm spread evenly.
        pub(crate) fn of_size(&mut self, low: f64, high: f64) -> f64 {
            libm::exp(self.between(libm::log(low), libm::log(high)))
        }
    }

    #[test]
    fn the_paper_s_machine_has_the_paper_s_speed_and_force() {
        let (bed, cylinder) = reference(2.0);
        assert!((bed.crank_speed(35.0) * bed.crank_radius - 1.979).abs() < 5e-4, "bed speed, about 2 m/s");
        assert!((bed.largest_inertia(35.0) / KILOGRAM_FORCE - 2170.8).abs() < 0.05, "P_max in kgf");
        // (11) from its own terms is (13).
        let omega = bed.crank_speed(35.0);
        let by_11 = bed.mass * omega * omega / cylinder.unit_force();
        assert!((cylinder.loading(35.0) / by_11 - 1.0).abs() < 1e-15);
        assert!((cylinder.bore() / 0.3717 - 1.0).abs() < 1e-3, "bore {}", cylinder.bore());
    }

    #[test]
    fn a_plain_buffer_leaves_the_known_share_of_the_force() {
        for (end_pressure, share) in [(2.0, 0.150), (5.0, 0.336)] {
            let (bed, cylinder) = reference(end_pressure);
            let loading = cylinder.loading(35.0);
            let plain = PlainBuffer::new(loading, cylinder.exponent, bed.crank_radius);
            let (x, residual) = plain.largest_residual();
            let got = residual / (loading * bed.crank_radius);
            assert!((got - share).abs() < 5e-4, "q = {end_pressure}: {got}");
            for other in [0.9 * x, 1.1 * x] {
                assert!(loading * other - plain.air(other) < residual);
            }
            let end = loading * bed.crank_radius - plain.air(bed.crank_radius);
            assert!(end.abs() < 1e-14 * end_pressure, "balanced at the end: {end}");
        }
    }
}

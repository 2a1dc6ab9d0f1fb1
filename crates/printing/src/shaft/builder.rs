//! The shaft under a cam put together in code.

use super::mechanics::{Beam, ShaftDisc, ShaftSegment, Support};
use super::{ShaftData, ShaftLimits, ShaftMachine};
use camgen_cams::pipeline::{Builder, Error, OF_BUILDER};
use camgen_cams::write::number::{shortest, with_unit};

/// The shaft under a cam put together in code: methods of the [`Builder`].
pub trait BuilderOfShaft: Sized {
    /// The shaft that carries the cam.
    ///
    /// ```
    /// use camgen::domains::shaft::ShaftData;
    /// use camgen::domains::shaft::mechanics::{Beam, ShaftSegment, Shaft, Support};
    /// use camgen::machine::Material::Steel;
    /// use camgen::{BuilderOfShaft, MachineOfShaft, Program, Quantity, Spec, law};
    ///
    /// let steel = |length, diameter| ShaftSegment {
    ///     length,
    ///     diameter,
    ///     bore: 0.0,
    ///     modulus: Steel.modulus(),
    ///     density: Steel.density(),
    ///     poisson: Steel.poisson(),
    /// };
    /// let supports = vec![Support { at: 0.02, stiffness: Some(5e8) }, Support { at: 0.28, stiffness: None }];
    /// let shaft = Shaft::new(vec![steel(0.1, 0.03), steel(0.2, 0.04)], supports, vec![], Beam::Timoshenko)?;
    /// let machine = Spec::builder("on a shaft")
    ///     .roller(0.012)
    ///     .bore_radius(0.020)
    ///     .shaft(&ShaftData { shaft, cam_at: Some(0.15), drive_at: None, compensate: false })
    ///     .machine()?;
    /// assert_eq!(machine.shaft().map(|data| data.shaft.segments().len()), Some(2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    fn shaft(self, data: &ShaftData) -> Self;

    /// What the shaft must keep.
    #[must_use]
    fn shaft_limits(self, limits: ShaftLimits) -> Self;

    /// The shaft as a machine, every value in range, for its [analysis](super::analysis::analysis): with its cam where a bed is given, else alone.
    ///
    /// # Errors
    /// [`Error::Machine`] with all faults.
    fn shaft_machine(self) -> Result<ShaftMachine, Error>;
}

impl BuilderOfShaft for Builder {
    fn shaft(self, data: &ShaftData) -> Self {
        let ShaftData { shaft, cam_at, drive_at, compensate } = data;
        let beam = match shaft.beam() {
            Beam::Timoshenko => "timoshenko",
            Beam::Euler => "euler",
        };
        let builder = self
            .set("shaft.beam", beam)
            .length("shaft.cam_at", *cam_at)
            .length("shaft.drive_at", *drive_at)
            .set("shaft.compensate", if *compensate { "true" } else { "false" });
        let builder = shaft.segments().iter().fold(builder, with_segment);
        let builder = shaft.supports().iter().fold(builder, with_support);
        shaft.discs().iter().fold(builder, with_disc)
    }

    fn shaft_limits(self, limits: ShaftLimits) -> Self {
        let ShaftLimits { critical_speed_ratio, lift_error, support_slope, balance_grade } = limits;
        self.number("limits.critical_speed_ratio", critical_speed_ratio)
            .length("limits.lift_error", lift_error)
            .angle("limits.support_slope", support_slope)
            .number("limits.balance_grade", balance_grade)
    }

    fn shaft_machine(self) -> Result<ShaftMachine, Error> {
        let (text, keys) = self.into_source();
        Ok(ShaftMachine::from_toml(OF_BUILDER, &text, &keys)?)
    }
}

fn with_segment(builder: Builder, segment: &ShaftSegment) -> Builder {
    builder.add_table(
        "shaft.segment",
        &[
            ("length", &with_unit(segment.length, "m")),
            ("diameter", &with_unit(segment.diameter, "m")),
            ("bore", &with_unit(segment.bore, "m")),
            ("modulus", &with_unit(segment.modulus, "Pa")),
            ("density", &with_unit(segment.density, "kg/m3")),
            ("poisson", &shortest(segment.poisson)),
        ],
    )
}

fn with_support(builder: Builder, support: &Support) -> Builder {
    let stiffness = support.stiffness.map_or_else(|| "rigid".to_owned(), |stiffness| with_unit(stiffness, "N/m"));
    builder.add_table("shaft.support", &[("at", &with_unit(support.at, "m")), ("stiffness", &stiffness)])
}

fn with_disc(builder: Builder, disc: &ShaftDisc) -> Builder {
    let [x, y] = disc.unbalance;
    builder.add_table(
        "shaft.disc",
        &[
            ("at", &with_unit(disc.at, "m")),
            ("mass", &with_unit(disc.mass, "kg")),
            ("diametral_inertia", &with_unit(disc.diametral_inertia, "kg*m2")),
            ("polar_inertia", &with_unit(disc.polar_inertia, "kg*m2")),
            ("unbalance", &with_unit(1e3 * libm::hypot(x, y), "kg*mm")),
            ("angle", &with_unit(libm::atan2(y, x), "rad")),
        ],
    )
}

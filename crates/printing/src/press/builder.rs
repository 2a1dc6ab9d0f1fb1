//! A press put together in code: the tables of a press and its cams as methods of the [`Builder`].

use super::buffer::Bed;
use super::buffer::bottom_law::ColumnRule;
use super::machine::{
    AirColumn, CompensatorData, ConoidData, ConoidMode, DriveData, DriveMachine, Shift, TranslatingData,
};
use super::motion::Transition;
use super::motion::equation_18::{EfficiencyModel, ExactOn};
use camgen_cams::pipeline::{Builder, Error, OF_BUILDER};

/// The air buffers of a press: `[buffer]`. Pressures are absolute.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BufferData {
    /// Polytropic exponent k.
    pub polytropic_exponent: f64,
    /// Pressure of the air around, Pa.
    pub ambient_pressure: f64,
    /// Pressure at the end of the compression at the design speed, Pa.
    pub end_pressure: f64,
    /// Air column.
    pub column: AirColumn,
    /// Travel of the piston inside the cylinder before the reversal starts, m.
    pub lead: f64,
}

/// A press put together in code: methods of the [`Builder`].
///
/// The tables of a press. What they describe is cut with [`Spec::rotary`](super::SpecOfPress::rotary), [`Spec::translating`](super::SpecOfPress::translating),
/// [`Spec::conoid`](super::SpecOfPress::conoid) and [`Spec::compensator`](super::SpecOfPress::compensator).
pub trait BuilderOfPress: Sized {
    /// The bed and the crank that reverses it.
    ///
    /// ```
    /// use camgen::domains::press::BufferData;
    /// use camgen::domains::press::buffer::{Bed, bottom_law::ColumnRule};
    /// use camgen::domains::press::machine::AirColumn;
    /// use camgen::{BuilderOfPress, Spec, SpecOfPress, units::TECHNICAL_ATMOSPHERE};
    ///
    /// let machine = Spec::builder("press")
    ///     .bed(Bed { mass: 978.2, crank_radius: 0.180, crank_turns_per_main_shaft_turn: 3.0 })
    ///     .buffer(BufferData {
    ///         polytropic_exponent: 1.35,
    ///         ambient_pressure: TECHNICAL_ATMOSPHERE,
    ///         end_pressure: 2.0 * TECHNICAL_ATMOSPHERE,
    ///         column: AirColumn::Of(ColumnRule::Matched),
    ///         lead: 0.0,
    ///     })
    ///     .design_speed(35.0)
    ///     .roller(0.030)
    ///     .bore_radius(0.025)
    ///     .machine()?;
    /// let cam = Spec::rotary(machine, 35.0).solve()?;
    /// assert!(cam.draw(10e-6)?.prove()?.passed());
    /// # Ok::<(), camgen::Error>(())
    /// ```
    #[must_use]
    fn bed(self, bed: Bed) -> Self;

    /// The air buffers.
    #[must_use]
    fn buffer(self, buffer: BufferData) -> Self;

    /// Speed of the main shaft for which the cylinders are sized, rpm.
    #[must_use]
    fn design_speed(self, rpm: f64) -> Self;

    /// The transition between dwell and reversal.
    #[must_use]
    fn transition(self, transition: Transition) -> Self;

    /// Equal lobes of the disc: turns of the crank for one turn of the cam.
    #[must_use]
    fn lobes(self, lobes: u32) -> Self;

    /// Travel of the roller for a travel of the cylinder's bottom.
    #[must_use]
    fn lever(self, ratio: f64) -> Self;

    /// Largest residual force over the largest inertia force of the bed.
    #[must_use]
    fn residual_share(self, share: f64) -> Self;

    /// Longest air column, m.
    #[must_use]
    fn largest_column(self, length: f64) -> Self;

    /// The wedge cam on the bed, a plate with a flank on either side: for [`Spec::translating`](super::SpecOfPress::translating).
    #[must_use]
    fn wedge(self, wedge: TranslatingData) -> Self;

    /// The conoid, a three-dimensional cam for several speeds: for [`Spec::conoid`](super::SpecOfPress::conoid).
    #[must_use]
    fn conoid(self, conoid: ConoidData) -> Self;

    /// The compensating cam, which takes the torque of the disc cam: for [`Spec::compensator`](super::SpecOfPress::compensator), and made with the
    /// disc cam by [`Spec::assemble`](camgen_cams::Spec::assemble).
    #[must_use]
    fn compensator(self, compensator: CompensatorData) -> Self;

    /// The drive of a bed without a cam: for [`Builder::drive_machine`](BuilderOfPress::drive_machine).
    #[must_use]
    fn drive(self, drive: DriveData) -> Self;

    /// The drive as a machine, every value in range, for its [analysis](super::analysis::drive::analysis). Its air column has a given length.
    ///
    /// # Errors
    /// [`Error::Machine`] with all faults.
    fn drive_machine(self) -> Result<DriveMachine, Error>;
}

impl BuilderOfPress for Builder {
    fn bed(self, bed: Bed) -> Self {
        let Bed { mass, crank_radius, crank_turns_per_main_shaft_turn } = bed;
        self.quantity("bed.mass", mass, "kg")
            .length("bed.crank_radius", crank_radius)
            .number("bed.crank_turns_per_main_shaft_turn", crank_turns_per_main_shaft_turn)
    }

    fn buffer(self, buffer: BufferData) -> Self {
        let BufferData { polytropic_exponent, ambient_pressure, end_pressure, column, lead } = buffer;
        let builder = self
            .number("buffer.polytropic_exponent", polytropic_exponent)
            .quantity("buffer.ambient_pressure", ambient_pressure, "Pa")
            .quantity("buffer.end_pressure", end_pressure, "Pa")
            .length("buffer.lead", lead);
        match column {
            AirColumn::Of(ColumnRule::Matched) => builder.set("buffer.column", "matched"),
            AirColumn::Of(ColumnRule::Return) => builder.set("buffer.column", "return"),
            AirColumn::Of(ColumnRule::Length(length)) => builder.length("buffer.column", length),
            AirColumn::LeastTorque => builder.set("buffer.column", "least-torque"),
        }
    }

    fn design_speed(self, rpm: f64) -> Self {
        self.number("design.rpm", rpm)
    }

    fn transition(self, transition: Transition) -> Self {
        match transition {
            Transition::None => self.set("transition.kind", "none"),
            Transition::RunUp { width } => self.set("transition.kind", "run-up").angle("transition.width", width),
            Transition::Blend { width } => self.set("transition.kind", "blend").angle("transition.width", width),
        }
    }

    fn lobes(self, lobes: u32) -> Self {
        self.number("cam.cam_turns_per_crank_turn", 1.0 / f64::from(lobes))
    }

    fn lever(self, ratio: f64) -> Self {
        self.number("cam.lever", ratio)
    }

    fn residual_share(self, share: f64) -> Self {
        self.number("limits.residual_share", share)
    }

    fn largest_column(self, length: f64) -> Self {
        self.length("limits.column", length)
    }

    fn wedge(self, wedge: TranslatingData) -> Self {
        let TranslatingData { roller_arm, bottom_arm, delta, friction_angle, efficiency, .. } = wedge;
        let model = match wedge.efficiency_model {
            EfficiencyModel::Consistent => "consistent",
            EfficiencyModel::Printed => "printed",
        };
        let balanced = match wedge.balance {
            Some(ExactOn::Mean) => self.set("translating.balance", "level"),
            Some(ExactOn::Braking) => self.set("translating.balance", "braking"),
            _ => self,
        };
        balanced
            .length("translating.roller_arm", roller_arm)
            .length("translating.bottom_arm", bottom_arm)
            .angle("translating.delta", delta)
            .angle("translating.friction_angle", friction_angle)
            .number("translating.efficiency", efficiency)
            .set("translating.efficiency_model", model)
            .length("translating.roller_radius", wedge.roller_radius)
            .length("translating.plate_height", wedge.plate_height)
    }

    fn conoid(self, conoid: ConoidData) -> Self {
        let mode = match conoid.mode {
            ConoidMode::Adjusted => "adjusted",
            ConoidMode::Fixed => "fixed",
        };
        let shift = match conoid.shift {
            Shift::Linear => "linear",
            Shift::Square => "square",
            Shift::Variable => "v",
        };
        self.length("conoid.axial_travel", conoid.axial_travel)
            .set("conoid.mode", mode)
            .set("conoid.shift", shift)
            .length("conoid.overhang", conoid.overhang)
    }

    fn compensator(self, compensator: CompensatorData) -> Self {
        let CompensatorData { spring_rate, preload, roller_radius, base_radius, angle, mass } = compensator;
        self.quantity("compensator.spring_rate", spring_rate, "N/m")
            .quantity("compensator.preload", preload, "N")
            .length("compensator.roller_radius", roller_radius)
            .length("compensator.base_radius", base_radius)
            .angle("compensator.angle", angle)
            .quantity("compensator.mass", mass, "kg")
    }

    fn drive(self, drive: DriveData) -> Self {
        let DriveData { lead_angle, bed_speed, motor_ratio, inertia, bore } = drive;
        self.angle("drive.lead_angle", lead_angle)
            .quantity("drive.bed_speed", bed_speed, "m/s")
            .number("drive.motor_ratio", motor_ratio)
            .quantity("drive.inertia", inertia, "kg*m2")
            .length("drive.bore", bore)
    }

    fn drive_machine(self) -> Result<DriveMachine, Error> {
        let (text, keys) = self.into_source();
        Ok(DriveMachine::from_toml(OF_BUILDER, &text, &keys)?)
    }
}

//! A belt brake put together in code.

use super::machine::{BeltMode, BrakeCam, BrakeLimits, BrakeMachine, BrakeModel, BrakeOutput};
use super::mechanics::{BrakeFrame, PaperRoll, RollRotation, Web};
use camgen_cams::machine::{Catalogue, MachineSource};
use camgen_cams::pipeline::{Builder, Error, OF_BUILDER};
use camgen_cams::write::number::with_unit;

/// What a belt brake is to do: `[brake]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BrakeSettings {
    /// With or without slip.
    pub mode: BeltMode,
    /// Whose equations.
    pub model: BrakeModel,
    /// Wanted tension of the web, N.
    pub tension: f64,
    /// Coefficient of friction between belt and roll.
    pub friction: f64,
    /// Weight of the frame with its load, N; that with which the full roll has the wanted tension when absent.
    pub weight: Option<f64>,
    /// Rotation of the roll.
    pub rotation: RollRotation,
    /// Speed of a slipping belt / web speed.
    pub belt_speed_ratio: f64,
    /// Least tension that a belt without slip can hold, over the wanted tension.
    pub grip: f64,
    /// Acceleration of the web while the machine speeds up, m/s².
    pub acceleration: f64,
}

/// A belt brake put together in code: methods of the [`Builder`].
pub trait BuilderOfBrake: Sized {
    /// What a belt brake is to do. Its parts are [`Builder::paper_roll`](BuilderOfBrake::paper_roll) with [`Builder::brake_frame`](BuilderOfBrake::brake_frame), or [`Builder::brake_ends`](BuilderOfBrake::brake_ends).
    ///
    /// ```
    /// use camgen::{BuilderOfBrake, Spec};
    /// use camgen::catalogue::catalogue;
    /// use camgen::domains::brake::machine::{BeltMode, BrakeModel};
    /// use camgen::domains::brake::mechanics::{BrakeFrame, PaperRoll, RollRotation};
    /// use camgen::domains::brake::{BrakeOutput, BrakeSettings};
    ///
    /// let brake = Spec::builder("roll")
    ///     .brake(BrakeSettings {
    ///         mode: BeltMode::Slip,
    ///         model: BrakeModel::Consistent,
    ///         tension: 300.0,
    ///         friction: 0.25,
    ///         weight: None,
    ///         rotation: RollRotation::Clockwise,
    ///         belt_speed_ratio: 0.0,
    ///         grip: 1.5,
    ///         acceleration: 0.0,
    ///     })
    ///     .paper_roll(PaperRoll { largest_radius: 0.6, smallest_radius: 0.05 }, None)
    ///     .brake_frame(BrakeFrame {
    ///         pivot: [-1.1, 0.55],
    ///         right_pulley: [0.5, 0.45],
    ///         left_pulley: [-0.55, 0.45],
    ///         centre_of_gravity: [0.1, 0.55],
    ///         pulley_radius: 0.06,
    ///     })
    ///     .brake_machine(catalogue(), BrakeOutput::Figures)?;
    /// assert_eq!(brake.data().tension, 300.0);
    /// # Ok::<(), camgen::Error>(())
    /// ```
    #[must_use]
    fn brake(self, brake: BrakeSettings) -> Self;

    /// The roll, and the density of its paper (kg/m³), which its inertia needs.
    #[must_use]
    fn paper_roll(self, roll: PaperRoll, density: Option<f64>) -> Self;

    /// The web, which a belt without slip stretches.
    #[must_use]
    fn web(self, web: Web) -> Self;

    /// The hinged frame that follows the roll.
    #[must_use]
    fn brake_frame(self, frame: BrakeFrame) -> Self;

    /// Replaces a frame: the angles of wrap (rad) on the full roll and on the run-down roll, and the press force on the run-down roll
    /// over that on the full roll.
    #[must_use]
    fn brake_ends(self, wrap: [f64; 2], press_ratio: f64) -> Self;

    /// The disc on the shaft of the frame that holds the tension; its roller is [`Builder::roller`].
    #[must_use]
    fn brake_cam(self, cam: BrakeCam) -> Self;

    /// What the brake must keep.
    #[must_use]
    fn brake_limits(self, limits: BrakeLimits) -> Self;

    /// The brake as a machine, every value in range, for its [analysis](super::analysis::analysis) and its [disc](super::spec).
    ///
    /// # Errors
    /// [`Error::Machine`] with all faults.
    fn brake_machine(self, catalogue: &'static Catalogue, wanted: BrakeOutput) -> Result<BrakeMachine, Error>;
}

impl BuilderOfBrake for Builder {
    fn brake(self, brake: BrakeSettings) -> Self {
        let mode = match brake.mode {
            BeltMode::Slip => "slip",
            BeltMode::NoSlip => "no-slip",
        };
        let model = match brake.model {
            BrakeModel::Consistent => "consistent",
            BrakeModel::Printed => "printed",
        };
        let rotation = match brake.rotation {
            RollRotation::Clockwise => "cw",
            RollRotation::CounterClockwise => "ccw",
        };
        self.set("brake.mode", mode)
            .set("brake.model", model)
            .quantity("brake.tension", brake.tension, "N")
            .number("brake.friction", brake.friction)
            .quantity("brake.weight", brake.weight, "N")
            .set("brake.rotation", rotation)
            .number("brake.belt_speed_ratio", brake.belt_speed_ratio)
            .number("brake.grip", brake.grip)
            .quantity("brake.acceleration", brake.acceleration, "m/s2")
    }

    fn paper_roll(self, roll: PaperRoll, density: Option<f64>) -> Self {
        self.length("brake.roll.largest_radius", roll.largest_radius)
            .length("brake.roll.smallest_radius", roll.smallest_radius)
            .quantity("brake.roll.density", density, "kg/m3")
    }

    fn web(self, web: Web) -> Self {
        let Web { thickness, width, modulus, speed, wound_strain, length } = web;
        self.length("brake.web.thickness", thickness)
            .length("brake.web.width", width)
            .quantity("brake.web.modulus", modulus, "Pa")
            .quantity("brake.web.speed", speed, "m/s")
            .number("brake.web.wound_strain", wound_strain)
            .length("brake.web.length", length)
    }

    fn brake_frame(self, frame: BrakeFrame) -> Self {
        let points = [
            ("brake.frame.pivot", frame.pivot),
            ("brake.frame.right_pulley", frame.right_pulley),
            ("brake.frame.left_pulley", frame.left_pulley),
            ("brake.frame.centre_of_gravity", frame.centre_of_gravity),
        ];
        let builder = points.into_iter().fold(self, |builder, (key, point)| with_pair(builder, key, point, "m"));
        builder.length("brake.frame.pulley_radius", frame.pulley_radius)
    }

    fn brake_ends(self, wrap: [f64; 2], press_ratio: f64) -> Self {
        with_pair(self, "brake.ends.wrap", wrap, "rad").number("brake.ends.press_ratio", press_ratio)
    }

    fn brake_cam(self, cam: BrakeCam) -> Self {
        self.number("brake.cam.turns_per_frame_turn", cam.turns_per_frame_turn)
            .quantity("brake.cam.spring_rate", cam.spring_rate, "N/m")
            .quantity("brake.cam.preload", cam.preload, "N")
    }

    fn brake_limits(self, limits: BrakeLimits) -> Self {
        let BrakeLimits { tension_spread, web_stress } = limits;
        self.number("limits.tension_spread", tension_spread).quantity("limits.web_stress", web_stress, "Pa")
    }

    fn brake_machine(self, catalogue: &'static Catalogue, wanted: BrakeOutput) -> Result<BrakeMachine, Error> {
        let (text, keys) = self.into_source();
        Ok(BrakeMachine::of_source(&MachineSource::of_user(catalogue, OF_BUILDER, &text), &keys, wanted)?)
    }
}

/// With a pair of numbers in a unit.
fn with_pair(builder: Builder, key: &str, [first, second]: [f64; 2], unit: &str) -> Builder {
    builder.set(key, &format!("[{}, {}]", with_unit(first, unit), with_unit(second, unit)))
}

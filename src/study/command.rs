//! The commands that make the cam of a design.

#[cfg(feature = "press")]
use crate::domains::press::{machine::exact_on, motion::equation_18::Solver, wedge::LAW_TOLERANCE};
use crate::machine::Machine;
use crate::pipeline::Spec;
use crate::refusal::Refusal;

/// A command that makes a cam, with its defaults.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DesignCommand {
    /// The cam of a motion program.
    Make,
    /// The disc of a press.
    #[cfg(feature = "press")]
    Rotary,
    /// The plate of a press.
    #[cfg(feature = "press")]
    Translating,
    /// The compensating disc of a press.
    #[cfg(feature = "press")]
    Compensator,
}

impl DesignCommand {
    /// Every command.
    pub const ALL: &[Self] = &[
        Self::Make,
        #[cfg(feature = "press")]
        Self::Rotary,
        #[cfg(feature = "press")]
        Self::Translating,
        #[cfg(feature = "press")]
        Self::Compensator,
    ];

    /// Its word on the command line.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Make => "make",
            #[cfg(feature = "press")]
            Self::Rotary => "rotary",
            #[cfg(feature = "press")]
            Self::Translating => "translating",
            #[cfg(feature = "press")]
            Self::Compensator => "compensator",
        }
    }

    /// That of a machine for which none is named.
    #[must_use]
    pub fn usual(machine: &Machine) -> Self {
        #[cfg(feature = "press")]
        if machine.motion().is_none() {
            return Self::Rotary;
        }
        _ = machine;
        Self::Make
    }

    /// The cam of a machine for a speed, or for that of the machine.
    ///
    /// # Errors
    /// [`Refusal`] where the machine has no such cam.
    pub fn spec(self, machine: Machine, rpm: Option<f64>) -> Result<Spec, Refusal> {
        #[cfg(feature = "press")]
        let speed = |machine: &Machine| rpm.map_or_else(|| machine.press().map(|press| press.design_rpm), Ok);
        match self {
            Self::Make => Spec::of_program(machine, rpm)
                .ok_or_else(|| Refusal::new("the base has no motion").remedy("write command = \"rotary\"")),
            #[cfg(feature = "press")]
            Self::Rotary => speed(&machine).map(|rpm| Spec::rotary(machine, rpm)),
            #[cfg(feature = "press")]
            Self::Translating => {
                let balance = exact_on(&machine);
                speed(&machine)
                    .map(|rpm| Spec::translating(machine, rpm, Solver::Ode { tolerance: LAW_TOLERANCE }, balance))
            }
            #[cfg(feature = "press")]
            Self::Compensator => speed(&machine).map(|rpm| Spec::compensator(machine, rpm)),
        }
    }
}

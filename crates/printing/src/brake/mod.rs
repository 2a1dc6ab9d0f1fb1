//! The belt brake of a paper roll: a hinged frame presses a belt onto the roll, and a disc on its shaft holds the tension of the web.

pub mod analysis;
mod builder;
pub mod checks;
mod disc;
mod disc_motion;
pub mod machine;
pub mod mechanics;
mod tension;

pub use builder::{BrakeSettings, BuilderOfBrake};
pub use disc::{KIND, spec};
pub use disc_motion::BrakeDisc;
pub use machine::{BrakeMachine, BrakeOutput};
pub use tension::{RollTension, TensionAsCut, as_written};

use camgen_cams::domain::{Added, Domain};
use camgen_cams::machine::Embedded;
use camgen_kernel::document::cams::{CamKind, OF_A_DISC};

/// The belt brake of a paper roll, as keys name it.
const BRAKE: &str = "brake";
/// The disc that holds its tension.
const BRAKE_CAM: &str = "brake-cam";

/// Belt brakes.
pub const DOMAIN: Domain = Domain {
    sections: &[
        Added {
            after: "shaft.disc",
            entries: &[
                &machine::SECTION,
                &machine::ROLL,
                &machine::WEB,
                &machine::FRAME,
                &machine::ENDS,
                &machine::CAM,
            ],
        },
        Added { after: "limits", entries: &[&machine::limits::SECTION] },
    ],
    read: None,
    cams: &[CamKind::analysis(BRAKE), CamKind::cam(BRAKE_CAM, OF_A_DISC)],
    kinds: &[&KIND],
    analyses: &[&analysis::KIND],
    checks: &[Added {
        after: "",
        entries: &[
            &checks::TENSION,
            &checks::SELF_LOCKING,
            &checks::BELT_RANGE,
            &checks::GRIP,
            &checks::WEB_STRESS,
            &checks::FRAME_REACH,
        ],
    }],
    embedded: &[
        Embedded { name: "roll", command: "brake", toml: include_str!("../../profiles/roll.toml") },
        Embedded { name: "roll-level", command: "brake", toml: include_str!("../../profiles/roll-level.toml") },
    ],
    commands: &[],
};

#[cfg(test)]
mod tests;

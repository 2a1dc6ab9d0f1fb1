//! The shaft under a cam: critical speeds, deflection, twist, unbalance, and the loss of lift.

pub mod analysis;
mod builder;
pub mod checks;
pub mod machine;
pub mod mechanics;

pub use builder::BuilderOfShaft;
pub use machine::{MachineOfShaft, ShaftData, ShaftLimits, ShaftMachine};

use camgen_cams::domain::{Added, Domain};
use camgen_cams::machine::Embedded;
use camgen_kernel::document::cams::CamKind;

/// The shaft under a cam, as keys name it.
pub const SHAFT: &str = "shaft";

/// Shafts.
pub const DOMAIN: Domain = Domain {
    sections: &[
        Added {
            after: "compensator",
            entries: &[&machine::SECTION, &machine::SEGMENT, &machine::SUPPORT, &machine::DISC],
        },
        Added { after: "limits", entries: &[&machine::limits::SECTION] },
    ],
    read: Some(machine::read),
    cams: &[CamKind::analysis(SHAFT)],
    kinds: &[],
    analyses: &[&analysis::KIND, &analysis::trade::KIND],
    checks: &[Added {
        after: "reversals",
        entries: &[&checks::CRITICAL_SPEED, &checks::LIFT_ERROR, &checks::SUPPORT_SLOPE, &checks::UNBALANCE],
    }],
    embedded: &[
        Embedded { name: "dpi-shaft", command: "rotary", toml: include_str!("../../profiles/dpi-shaft.toml") },
        Embedded { name: "press-cylinder", command: "shaft", toml: include_str!("../../profiles/press-cylinder.toml") },
    ],
    commands: &[],
};

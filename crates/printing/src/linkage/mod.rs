//! The linkages that move the bed of a press: a crank and slider, or a drag link before it. What they do, and how they are found.

pub mod analysis;
mod builder;
pub mod checks;
mod dual;
pub mod machine;
pub mod synthesis;

pub use builder::BuilderOfLinkage;
pub use machine::MachineOfLinkage;

use crate::press::cams::OF_BED_MOTION;
use camgen_cams::domain::{Added, Domain};
use camgen_cams::machine::Embedded;
use camgen_kernel::document::cams::CamKind;

/// The linkage that moves a bed, as keys name it.
pub const LINKAGE: &str = "linkage";

/// Linkages.
pub const DOMAIN: Domain = Domain {
    sections: &[
        Added { after: "bed", entries: &[&machine::SECTION] },
        Added { after: "limits", entries: &[&machine::limits::SECTION] },
    ],
    read: Some(machine::read),
    cams: &[CamKind::classed_analysis(LINKAGE, OF_BED_MOTION)],
    kinds: &[],
    analyses: &[&analysis::KIND],
    checks: &[Added {
        after: "closing",
        entries: &[
            &checks::GRASHOF,
            &checks::LINK_RATIO,
            &checks::TRANSMISSION_ANGLE,
            &checks::ROD_ANGLE,
            &checks::DEAD_POINTS,
            &checks::REVERSALS,
        ],
    }],
    embedded: &[
        Embedded {
            name: "dpi-crank-slider",
            command: "rotary",
            toml: include_str!("../../profiles/dpi-crank-slider.toml"),
        },
        Embedded { name: "dpi-six-bar", command: "rotary", toml: include_str!("../../profiles/dpi-six-bar.toml") },
    ],
    commands: &[],
};

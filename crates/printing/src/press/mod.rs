//! The flat-bed press whose bed is reversed by air buffers: the law of their bottoms, the cams that give it, and the residual force.

pub mod analysis;
pub(crate) mod balance;
pub mod bed_motion;
pub mod buffer;
mod builder;
pub mod cams;
pub mod checks;
pub mod columns;
pub mod compensator;
pub mod conoid;
pub mod load;
mod loop_of_air;
pub mod machine;
pub mod motion;
mod picture;
pub mod raised_disc;
pub mod report;
pub mod roller_life;
pub mod rotary;
pub mod scatter;
mod smoother;
mod spec;
pub mod wedge;

pub use builder::{BufferData, BuilderOfPress};
pub use machine::MachineOfPress;
pub use spec::SpecOfPress;

use camgen_cams::domain::Domain;
use camgen_cams::machine::{Catalogue, Embedded};

/// Presses.
pub const DOMAIN: Domain = Domain {
    sections: machine::SECTIONS,
    read: Some(machine::read),
    cams: cams::KINDS,
    kinds: &[&rotary::ROTARY, &compensator::COMPENSATOR, &wedge::KIND, &conoid::KIND],
    analyses: &[
        &analysis::regimes::KIND,
        &analysis::spring::KIND,
        &scatter::analysis::KIND,
        &analysis::drive::KIND,
        &analysis::trade::ROTARY,
        &analysis::trade::CONOID,
        &analysis::trade::TRANSLATING,
    ],
    checks: checks::CHECKS,
    embedded: &[
        Embedded { name: "dpi", command: "rotary", toml: include_str!("../../profiles/dpi.toml") },
        Embedded { name: "dpi-paper", command: "rotary", toml: include_str!("../../profiles/dpi-paper.toml") },
        Embedded { name: "dp", command: "drive", toml: include_str!("../../profiles/dp.toml") },
    ],
    commands: spec::COMMANDS,
};

/// A commented machine file of a press with every key, to start from.
#[must_use]
pub fn template(catalogue: &Catalogue) -> String {
    camgen_cams::machine::template(catalogue, cams::ROTARY, &["bed", "buffer", "design", "follower.roller"])
}

#[cfg(test)]
mod tests;

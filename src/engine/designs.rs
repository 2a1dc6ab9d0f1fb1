//! The designs in the binary of which cams can be made.

use crate::catalogue::catalogue;
use crate::machine::{Embedded, Machine};
use crate::study::DesignCommand;
use serde_json::{Value, json};

/// Those of which a cam can be made, each with its text and the commands that make its cams.
pub(super) fn list() -> Vec<Value> {
    catalogue().embedded.iter().filter_map(design).collect()
}

fn design(embedded: &Embedded) -> Option<Value> {
    let machine = Machine::load(embedded.name, &[]).ok()?.0;
    let commands = commands(&machine);
    if commands.is_empty() {
        return None;
    }
    Some(json!({"name": embedded.name, "title": embedded.title(), "toml": embedded.toml, "commands": commands}))
}

/// The commands that make a cam of a machine.
#[must_use]
pub fn commands(machine: &Machine) -> Vec<&'static str> {
    let makes =
        |command: &&DesignCommand| command.spec(machine.clone(), None).is_ok_and(|spec| spec.assemble().is_ok());
    #[allow(unused_mut, reason = "without a press there is no conoid")]
    let mut all: Vec<&str> = DesignCommand::ALL.iter().filter(makes).map(|command| command.word()).collect();
    #[cfg(feature = "press")]
    if let Some(after) = all.iter().position(|command| *command == crate::domains::press::cams::ROTARY) {
        all.insert(after + 1, crate::domains::press::cams::CONOID);
    }
    all
}

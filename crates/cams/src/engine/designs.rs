//! The designs in the binary of which cams can be made.

use crate::catalogue::{catalogue, commands as all_commands};
use crate::domain::Makes;
use crate::machine::{Embedded, Machine};
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
    let mut words: Vec<&'static str> = Vec::new();
    for command in all_commands() {
        let made = match command.makes {
            Makes::ForOne(spec) => spec(machine.clone(), None).is_ok_and(|spec| spec.assemble().is_ok()),
            Makes::ForSeveral { beside, .. } => words.contains(&beside),
        };
        words.extend(made.then_some(command.word));
    }
    words
}

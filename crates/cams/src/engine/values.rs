//! The values of a design for a page: those of its file, and the defaults of absent keys.

use super::text::{self, GivenKey};
use crate::body::Body;
use crate::machine::Machine;
use camgen_kernel::document::KeyForm;
use camgen_kernel::units;
use serde_json::{Map, Value};
use std::collections::BTreeSet;

/// The values of all keys given in a text, as typed, and the defaults of the other keys that affect its cam.
pub(super) fn values(body: &dyn Body, toml: &str) -> Map<String, Value> {
    let given = text::given(toml);
    // A radius given by its diameter is left out.
    let twins: BTreeSet<String> = given.iter().filter_map(|key| text::twin_of(&key.path)).collect();
    let inputs = body.machine().inputs_with_body(body.kind().keys);
    let defaults = inputs.into_iter().filter(|input| !twins.contains(&input.key));
    let all = defaults.map(|input| (input.key, input.typed)).chain(given.into_iter().map(|key| (key.path, key.typed)));
    all.map(|(path, typed)| (path, Value::from(typed))).collect()
}

/// The values that hold for absent keys without a default: limits, and the radius of a given diameter or the reverse.
pub(super) fn usual(machine: &Machine, toml: &str) -> Map<String, Value> {
    let limits = machine.usual_limits().into_iter().map(|input| (input.key, input.typed));
    let given = text::given(toml);
    let twins = given.iter().filter_map(|key| Some((text::twin_of(&key.path)?, of_twin(key)?)));
    limits.chain(twins).map(|(path, typed)| (path, Value::from(typed))).collect()
}

/// The radius of a typed diameter, or the reverse; `None` for a word.
fn of_twin(given: &GivenKey) -> Option<String> {
    let key = text::key_of(&given.path)?;
    let (KeyForm::Quantity(dimension, _) | KeyForm::WordsOrQuantity(_, dimension, _)) = key.form else { return None };
    let quantity = units::parse(given.typed.trim_start_matches(['Ø', 'ø', '⌀']), dimension).ok()?;
    let times = if key.halved.is_some() { 0.5 } else { 2.0 };
    Some(quantity.in_same_unit(times * quantity.si))
}

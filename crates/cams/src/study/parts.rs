//! The parts of a study file: its base, its command, the keys that vary, how many rows there are, limits and objectives.

use super::keys;
use super::kind::{Constraint, Objective, StudyKind};
use super::parameter::{Parameter, SPEED, Scale, Values, split};
use super::sampling::Sampling;
use crate::catalogue::{catalogue, commands, usual_command};
use crate::domain::DesignCommand;
use crate::machine::{Machine, MachineSource};
use camgen_kernel::document::{FileFault, InputFiles, Reader, TableReader, similar};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The base: an embedded machine, or a file in or below the folder of the study.
pub(super) fn base_of(name: &str, folder: Option<&Path>, files: &InputFiles) -> Result<MachineSource, Box<FileFault>> {
    let fault = |message: String, help: Option<String>| Box::new(FileFault { key: None, message, help, place: None });
    let path = match folder.filter(|folder| folder.join(name).exists()) {
        Some(folder) => {
            let outside = files.outside_fault(folder, name, keys::BASE.key.name);
            outside.map_or(Ok(folder.join(name)), |fault| Err(Box::new(fault)))?
        }
        None if Path::new(name).exists() && !catalogue().names().contains(&name) => {
            let help = "put it in or below the folder of the study file, and give its path from there";
            return Err(fault(format!("there is no base `{name}` in the folder of the study"), Some(help.to_owned())));
        }
        None => PathBuf::from(name),
    };
    let Some(utf8) = path.to_str() else {
        return Err(fault(format!("the path `{}` is not UTF-8", path.display()), None));
    };
    let loaded = MachineSource::load_with(utf8, files);
    loaded.map(MachineSource::with_confined_overrides).map_err(|error| match error.faults.into_iter().next() {
        Some(first) => Box::new(first),
        None => fault(format!("cannot read the base `{name}`"), None),
    })
}

/// The command, where the word is one.
pub(super) fn command(root: &TableReader<'_>, machine: &Machine) -> Option<&'static DesignCommand> {
    let Some(word) = root.get(&keys::COMMAND) else { return Some(usual_command(machine)) };
    let all: Vec<_> = commands().filter(|command| command.is_for_one_speed()).collect();
    let found = all.iter().copied().find(|command| command.word == word);
    if found.is_none() {
        let words: Vec<&str> = all.iter().map(|command| command.word).collect();
        let near =
            similar(&word, words.iter().copied()).map_or(String::new(), |near| format!("did you mean \"{near}\"? "));
        let help = format!("{near}It is one of {}", words.join(", "));
        root.fail(&keys::COMMAND, format!("no command \"{word}\" makes a cam of a study"), Some(help));
    }
    found
}

/// Refuses keys that are given twice: as two parameters, or as a parameter and for all designs.
pub(super) fn once_each(reader: &Reader<'_>, root: &TableReader<'_>, parameters: &[Parameter]) {
    let for_all = root.get(&keys::SET).unwrap_or_default();
    let set: BTreeSet<&str> = for_all.iter().filter_map(|one| one.split('=').next()).map(str::trim).collect();
    let mut seen = BTreeSet::new();
    for (table, parameter) in reader.elements(&keys::PARAMETER).zip(parameters) {
        let key = &parameter.key;
        let again = !seen.insert(key);
        let fixed = set.contains(key.as_str()) || (key == SPEED && root.get(&keys::RPM).is_some());
        if again || fixed {
            let what = if again { "is another parameter already" } else { "is set for all designs already" };
            table.fail(&keys::KEY, format!("{key} {what}"), Some("remove one of both".to_owned()));
        }
    }
}

/// How many rows there are, and how they are sampled.
pub(super) fn spread(
    root: &TableReader<'_>,
    kind: StudyKind,
    parameters: &[Parameter],
) -> Option<(u64, Option<Sampling>)> {
    if parameters.is_empty() {
        let help = "add [[parameter]] with key and values".to_owned();
        root.fail(&keys::KIND, "a study varies at least one key".to_owned(), Some(help));
        return None;
    }
    let rows = root.get(&keys::ROWS);
    let whole = |field: &'static camgen_kernel::document::Field<f64>| match root.get(field) {
        Some(number) if number.fract() != 0.0 => {
            root.fail(field, format!("`{}` must be a whole number: {number}", field.key.name), None);
            None
        }
        _ => Some(()),
    };
    whole(&keys::ROWS)?;
    whole(&keys::SEED)?;
    match (kind, rows) {
        (StudyKind::Sweep, Some(_)) => {
            let help = "leave it out, or write kind = \"monte-carlo\"".to_owned();
            root.fail(&keys::ROWS, "a sweep has a row for every combination of values".to_owned(), Some(help));
            None
        }
        (StudyKind::MonteCarlo, None) => {
            root.fail(
                &keys::KIND,
                "a study of random designs needs their number".to_owned(),
                Some("add rows = 1000".into()),
            );
            None
        }
        (_, Some(rows)) => {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and in range")]
            let rows = rows as u64;
            Some((rows, root.get(&keys::SAMPLING)))
        }
        (_, None) => combinations(root, parameters).map(|rows| (rows, None)),
    }
}

/// The number of all combinations of values.
fn combinations(root: &TableReader<'_>, parameters: &[Parameter]) -> Option<u64> {
    let mut rows = 1_u64;
    for parameter in parameters {
        let Some(count) = parameter.count() else {
            let help = "give steps, or rows and another kind for random designs".to_owned();
            let message = format!("{} has any value of a range, which no list of combinations has", parameter.key);
            root.fail(&keys::KIND, message, Some(help));
            return None;
        };
        rows = rows.saturating_mul(count);
    }
    #[expect(clippy::cast_precision_loss, reason = "a limit")]
    if rows as f64 > keys::MOST_ROWS {
        let message = format!("there are more than {} combinations", keys::MOST_ROWS);
        root.fail(&keys::KIND, message, Some("give fewer steps".into()));
        return None;
    }
    Some(rows)
}

/// The columns, with those that constraints and objectives name.
pub(super) fn limits(
    reader: &Reader<'_>,
    root: &TableReader<'_>,
    kind: StudyKind,
) -> Option<(Vec<String>, Vec<Constraint>, Vec<Objective>)> {
    let mut columns: Vec<String> = root.get(&keys::COLUMNS)?;
    let mut numbers = BTreeMap::new();
    for (number, column) in columns.iter().enumerate() {
        if numbers.insert(column.clone(), number).is_some() {
            root.fail(&keys::COLUMNS, format!("\"{column}\" is given twice"), Some("remove one".into()));
            return None;
        }
    }
    let mut number = |column: String| {
        *numbers.entry(column).or_insert_with_key(|column| {
            columns.push(column.clone());
            columns.len() - 1
        })
    };
    let mut constraints = Vec::new();
    for table in reader.elements(&keys::CONSTRAINT) {
        let (low, high) = (table.get(&keys::AT_LEAST), table.get(&keys::AT_MOST));
        if low.is_none() && high.is_none() {
            table.fail(
                &keys::COLUMN,
                "a constraint needs a limit".into(),
                Some("add at_most = 30 or at_least = 0".into()),
            );
        }
        let within = (low.unwrap_or(f64::NEG_INFINITY), high.unwrap_or(f64::INFINITY));
        if within.0 > within.1 {
            table.fail(&keys::AT_LEAST, format!("no number is at least {} and at most {}", within.0, within.1), None);
        }
        constraints.push(Constraint { column: number(table.get(&keys::COLUMN)?), within });
    }
    let mut objectives = Vec::new();
    for table in reader.elements(&keys::OBJECTIVE) {
        objectives.push(Objective { column: number(table.get(&keys::COLUMN)?), goal: table.get(&keys::GOAL)? });
    }
    if kind == StudyKind::Pareto && objectives.len() < 2 {
        let help = "add [[objective]] with column and goal for each".to_owned();
        root.fail(&keys::KIND, "a front needs at least two objectives".to_owned(), Some(help));
    }
    if kind != StudyKind::Pareto && !objectives.is_empty() {
        let help = "write kind = \"pareto\", or remove [[objective]]".to_owned();
        root.fail(&keys::KIND, "objectives belong to a study of kind pareto".to_owned(), Some(help));
    }
    Some((columns, constraints, objectives))
}

/// A number of a parameter, where it is given; `Err` after a fault: it is not a number, or its unit differs from that of the first one.
fn number(
    table: &TableReader<'_>,
    field: &camgen_kernel::document::Field<String>,
    unit: &mut Option<String>,
) -> Result<Option<f64>, ()> {
    let Some(typed) = table.get(field) else { return Ok(None) };
    let name = field.key.name;
    let Some((number, own)) = split(&typed) else {
        table.fail(field, format!("`{name}` must be a number with the unit of the key: {typed}"), None);
        return Err(());
    };
    if let Some(unit) = unit.as_deref().filter(|unit| *unit != own) {
        let help = Some(format!("write the numbers of a parameter in one unit, {unit}"));
        table.fail(field, format!("`{name}` has another unit: {typed}"), help);
        return Err(());
    }
    *unit = Some(own.to_owned());
    Ok(Some(number))
}

/// A key that varies.
pub(super) fn parameter(table: &TableReader<'_>) -> Option<Parameter> {
    let key = table.get(&keys::KEY)?;
    let mut unit = None;
    let all = [&keys::FROM, &keys::TO, &keys::MEAN, &keys::DEVIATION].map(|field| number(table, field, &mut unit));
    let [Ok(from), Ok(to), Ok(mean), Ok(deviation)] = all else { return None };
    let steps = table.get(&keys::STEPS);
    let fail = |field, message: &str, help: &str| -> Option<Parameter> {
        table.fail(field, message.to_owned(), Some(help.to_owned()));
        None
    };
    if let Some(list) = table.get(&keys::VALUES) {
        if from.or(to).or(mean).or(deviation).or(steps).is_some() {
            return fail(
                &keys::KEY,
                "a list of values is all of a parameter",
                "remove from, to, steps, mean and deviation",
            );
        }
        return listed(table, key, list);
    }
    let values = match (from, to, mean, deviation) {
        (low, high, Some(mean), Some(deviation)) => {
            let within = (low.unwrap_or(f64::NEG_INFINITY), high.unwrap_or(f64::INFINITY));
            if !(deviation > 0.0) {
                return fail(&keys::DEVIATION, "`deviation` must be above 0", "give a standard deviation");
            }
            if !(within.0 < within.1) || steps.is_some() {
                return fail(
                    &keys::KEY,
                    "a normal distribution is cut off at from and to, from below to",
                    "remove steps",
                );
            }
            if table.get(&keys::SCALE) == Some(Scale::Log) {
                return fail(&keys::KEY, "a normal distribution has no scale", "remove scale");
            }
            Values::Normal { mean, deviation, within }
        }
        (Some(from), Some(to), None, None) => {
            let scale = table.get(&keys::SCALE).unwrap_or(Scale::Linear);
            if from == to || (scale == Scale::Log && !(from * to > 0.0)) {
                return fail(
                    &keys::TO,
                    "`from` and `to` must differ, and have one sign on a log scale",
                    "give another end",
                );
            }
            if steps.is_some_and(|steps| steps.fract() != 0.0) {
                return fail(&keys::KEY, "`steps` must be a whole number", "e.g. steps = 11");
            }
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and in range")]
            Values::Range { from, to, steps: steps.map(|steps| steps as u64), scale }
        }
        _ => {
            return fail(&keys::KEY, "a parameter needs its values", "give values; from and to; or mean and deviation");
        }
    };
    Some(Parameter { key, unit: unit.unwrap_or_default(), values, numeric: true })
}

/// A key that has listed values: numbers where all are, in one unit.
fn listed(table: &TableReader<'_>, key: String, list: Vec<String>) -> Option<Parameter> {
    if list.is_empty() {
        table.fail(&keys::KEY, "`values` is empty".into(), Some("give at least one value".into()));
        return None;
    }
    let units: Option<Vec<&str>> = list.iter().map(|typed| split(typed).map(|(_, unit)| unit)).collect();
    let unit = units.and_then(|units| units.iter().all(|unit| *unit == units[0]).then(|| units[0].to_owned()));
    let (numeric, unit) = (unit.is_some(), unit.unwrap_or_default());
    Some(Parameter { key, unit, values: Values::List(list), numeric })
}

//! The study file: TOML to a [`Study`] with every value in range.

use super::command::DesignCommand;
use super::figures::{Plan, paths_of};
use super::keys;
use super::kind::{Constraint, Objective, StudyKind};
use super::parameter::{Parameter, SPEED, Scale, Values, split};
use super::sampling::{self, Sampling};
use crate::document::{FileFault, Reader, TableReader, file, similar};
use crate::machine::{Machine, MachineSource, valid_rpm};
use crate::refusal::Refusal;
use crate::report::sha256;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// Why there is no study.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum StudyError {
    /// Faults of the study file or of its base, each with its place.
    #[error("{}", told(.0))]
    Faults(Vec<FileFault>),
    /// Something that has no place in the file, or a file that cannot be written.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

fn told(faults: &[FileFault]) -> String {
    faults.iter().map(FileFault::to_string).collect::<Vec<_>>().join("\n")
}

/// A study, every value in range.
#[derive(Clone)]
pub struct Study {
    pub(super) name: String,
    pub(super) stem: String,
    pub(super) kind: StudyKind,
    pub(super) base: Arc<MachineSource>,
    pub(super) command: DesignCommand,
    pub(super) rpm: Option<f64>,
    /// Of the outlines, m.
    pub(super) tolerance: f64,
    pub(super) set: Vec<String>,
    pub(super) rows: u64,
    /// Random rows, and how; `None` for every combination.
    pub(super) sampling: Option<Sampling>,
    pub(super) seed: u64,
    pub(super) parameters: Vec<Parameter>,
    pub(super) columns: Vec<String>,
    pub(super) constraints: Vec<Constraint>,
    pub(super) objectives: Vec<Objective>,
    pub(super) plan: Plan,
    pub(super) digest: String,
}

impl fmt::Debug for Study {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Study").field("name", &self.name).field("rows", &self.rows).finish_non_exhaustive()
    }
}

/// Largest study file, bytes.
const LARGEST_FILE: u64 = 1 << 20;

/// The studies in the binary, each with its text.
const EMBEDDED: [(&str, &str); 3] = [
    ("feeder-roller", include_str!("../../profiles/studies/feeder-roller.toml")),
    ("feeder-scatter", include_str!("../../profiles/studies/feeder-scatter.toml")),
    ("lever-pareto", include_str!("../../profiles/studies/lever-pareto.toml")),
];

/// The studies in the binary by their names, each with its text.
#[must_use]
pub fn embedded() -> &'static [(&'static str, &'static str)] {
    &EMBEDDED
}

/// A file that is not that of a study, with what would be right.
fn refused(message: String, help: String) -> StudyError {
    StudyError::Faults(vec![FileFault { key: None, message, help: Some(help), place: None }])
}

impl Study {
    /// Reads an embedded study by its name, or a file; the base is found from the folder of the file.
    ///
    /// # Errors
    /// All faults of the study file, or of its base.
    pub fn load(name_or_path: &str) -> Result<Self, StudyError> {
        if let Some((name, text)) = EMBEDDED.iter().find(|(name, _)| *name == name_or_path) {
            return Self::read(&format!("{name} (embedded)"), text, (None, name));
        }
        let path = Path::new(name_or_path);
        let text = file::text_of(path, LARGEST_FILE).map_err(|why| {
            let names = EMBEDDED.map(|(name, _)| name);
            let near =
                similar(name_or_path, names).map_or(String::new(), |near| format!("did you mean `{near}`? Else "));
            let help = format!("{near}give a path to a TOML file or an embedded study: {}", names.join(", "));
            refused(format!("cannot read the study file `{name_or_path}`: {why}"), help)
        })?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        Self::read(name_or_path, &text, (path.parent(), &stem))
    }

    /// Reads a study from TOML text; `source` names it in messages.
    ///
    /// # Errors
    /// As [`Study::load`].
    pub fn from_toml(source: &str, text: &str) -> Result<Self, StudyError> {
        let stem = Path::new(source).file_stem().unwrap_or_default().to_string_lossy();
        Self::read(source, text, (None, &stem))
    }

    fn read(source: &str, text: &str, (folder, stem): (Option<&Path>, &str)) -> Result<Self, StudyError> {
        let reader = Reader::new(source, text, &[], keys::SECTIONS);
        let study = Self::of(&reader, (text, folder, stem));
        reader.finish().map_err(StudyError::Faults)?;
        match study {
            Ok(Some(study)) => Ok(study),
            // A part is missing only after a fault, so `finish` has returned before.
            Ok(None) => Err(StudyError::Faults(Vec::new())),
            Err(why) => Err(why),
        }
    }

    /// `None` after a fault that was reported.
    fn of(reader: &Reader<'_>, (text, folder, stem): (&str, Option<&Path>, &str)) -> Result<Option<Self>, StudyError> {
        let root = reader.table(&keys::ROOT);
        let parameters: Option<Vec<Parameter>> =
            reader.elements(&keys::PARAMETER).map(|table| parameter(&table)).collect();
        let (Some(parameters), Some(kind), Some(name)) = (parameters, root.get(&keys::KIND), root.get(&keys::NAME))
        else {
            return Ok(None);
        };
        let drawn = spread(&root, kind, &parameters);
        let limits = limits(reader, &root, kind);
        let (Some((rows, sampling)), Some((columns, constraints, objectives))) = (drawn, limits) else {
            return Ok(None);
        };
        if !reader.is_faultless() {
            return Ok(None);
        }
        let base = root.get(&keys::BASE).unwrap_or_default();
        let base = match base_of(&base, folder) {
            Ok(base) => base,
            Err(fault) => {
                root.fail(&keys::BASE, fault.message, fault.help);
                return Ok(None);
            }
        };
        let set = root.get(&keys::SET).unwrap_or_default();
        let machine = Machine::of_source(&base, &set).map_err(|error| StudyError::Faults(error.faults))?;
        let Some(command) = command(&root, &machine) else { return Ok(None) };
        let inputs = machine.inputs(command.word());
        let inputs: Vec<String> = inputs.iter().map(|input| format!("{}={}", input.key, input.value)).collect();
        let digest = sha256(format!("{}\n{text}\n{}", env!("CARGO_PKG_VERSION"), inputs.join("\n")).as_bytes());
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and in range")]
        let seed = root.get(&keys::SEED).unwrap_or(1.0) as u64;
        let study = Self {
            name,
            stem: stem.to_owned(),
            kind,
            base: Arc::new(base),
            command,
            rpm: root.get(&keys::RPM),
            tolerance: root.get(&keys::TOLERANCE).unwrap_or(5e-6),
            set,
            rows,
            sampling,
            seed,
            parameters,
            columns,
            constraints,
            objectives,
            plan: Plan::default(),
            digest,
        };
        study.checked(reader, &root)
    }

    /// With the plan of what its columns need; refuses keys that no value fits, and columns that no design has.
    fn checked(mut self, reader: &Reader<'_>, root: &TableReader<'_>) -> Result<Option<Self>, StudyError> {
        for (number, table) in reader.elements(&keys::PARAMETER).enumerate() {
            if let Some(fault) = self.misfit(number) {
                let key = if fault.message.starts_with("unknown key") { &keys::KEY } else { self.place_of(number) };
                table.fail(key, fault.message, fault.help);
            }
        }
        if !reader.is_faultless() {
            return Ok(None);
        }
        let (plan, known) = self.planned();
        self.plan = plan;
        let unknown: Vec<&String> = match &known {
            Some(known) => self.columns.iter().filter(|column| !known.contains(column)).collect(),
            None => Vec::new(),
        };
        for column in unknown {
            let known = known.as_deref().unwrap_or_default();
            let inside = known.iter().filter(|path| path.starts_with(column.as_str()) && path.len() > column.len());
            let inside: Vec<&str> = inside.take(3).map(String::as_str).collect();
            let help = match (inside.as_slice(), similar(column, known.iter().map(String::as_str))) {
                ([], Some(near)) => format!("did you mean \"{near}\"?"),
                ([], None) => format!("`camgen {} --json` prints the report that has them", self.command.word()),
                (inside, _) => format!("it has several figures, e.g. \"{}\"", inside.join("\", \"")),
            };
            root.fail(&keys::COLUMNS, format!("the report has no figure \"{column}\""), Some(help));
        }
        Ok(reader.is_faultless().then_some(self))
    }

    /// What is wrong with a parameter, where neither its first nor its last value fits its key.
    fn misfit(&self, number: usize) -> Option<FileFault> {
        let parameter = self.parameters.get(number)?;
        let ends = [0.0, 1.0 - f64::EPSILON].map(|share| parameter.at(share).typed);
        let mut found = None;
        for typed in ends {
            if parameter.key == SPEED {
                let why = typed.parse().map_err(|_| "the speed is a bare number, rpm".to_owned()).and_then(valid_rpm);
                let message = why.err()?;
                found = Some(FileFault { key: None, message, help: None, place: None });
                continue;
            }
            let own = format!("{}={typed}", parameter.key);
            let all: Vec<String> = self.set.iter().cloned().chain([own]).collect();
            let faults = Machine::of_source(&self.base, &all).err()?.faults;
            let of_key = |fault: &FileFault| fault.place.as_ref().is_some_and(|place| place.source == "--set");
            found = Some(faults.into_iter().find(of_key)?);
        }
        found
    }

    /// The key that has the values of a parameter.
    fn place_of(&self, number: usize) -> &'static crate::document::Field<String> {
        match self.parameters.get(number).map(|parameter| &parameter.values) {
            Some(Values::Range { .. }) => &keys::FROM,
            Some(Values::Normal { .. }) => &keys::MEAN,
            _ => &keys::KEY,
        }
    }

    /// What the columns need, from the first of a few rows that has a report, and the paths of its figures.
    fn planned(&self) -> (Plan, Option<Vec<String>>) {
        let tried = (0..self.rows.min(ROWS_TRIED)).find_map(|row| self.both_reports(row));
        match tried {
            Some((solved, proven)) => (Plan::of(&self.columns, &solved, &proven), Some(paths_of(&proven))),
            None => (Plan::proving(&self.columns), None),
        }
    }

    /// What it is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What the names of its files begin with.
    #[must_use]
    pub fn stem(&self) -> &str {
        &self.stem
    }

    /// What is studied.
    #[must_use]
    pub fn kind(&self) -> StudyKind {
        self.kind
    }

    /// The number of its designs.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.rows
    }

    /// The keys that vary.
    #[must_use]
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The paths of its figures.
    #[must_use]
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// Its limits.
    #[must_use]
    pub fn constraints(&self) -> &[Constraint] {
        &self.constraints
    }

    /// By what its designs are compared.
    #[must_use]
    pub fn objectives(&self) -> &[Objective] {
        &self.objectives
    }

    /// Whether a column needs the cam to be drawn and proved.
    #[must_use]
    pub fn proves(&self) -> bool {
        self.plan.proves
    }

    /// The SHA-256 of all that determines its rows: its text, its base and the version of camgen.
    #[must_use]
    pub fn digest(&self) -> &str {
        &self.digest
    }

    /// The values of the keys that vary in a design.
    #[must_use]
    pub fn values(&self, row: u64) -> Vec<super::ParameterValue> {
        if let Some(sampling) = self.sampling {
            let share = |number: usize| sampling::share(sampling, self.seed, (row, self.rows), number as u64);
            return self.parameters.iter().enumerate().map(|(number, of)| of.at(share(number))).collect();
        }
        // The last parameter changes from row to row.
        let mut rest = row;
        let level = |parameter: &Parameter| {
            let count = parameter.count().unwrap_or(1).max(1);
            let level = parameter.level(rest % count);
            rest /= count;
            level
        };
        let mut all: Vec<_> = self.parameters.iter().rev().map(level).collect();
        all.reverse();
        all
    }
}

/// Rows of which one must have a report, so that it is known what the columns need.
const ROWS_TRIED: u64 = 16;

/// The base by its embedded name, or from the folder of the study.
fn base_of(name: &str, folder: Option<&Path>) -> Result<MachineSource, Box<FileFault>> {
    let path = folder.map(|folder| folder.join(name)).filter(|path| path.exists());
    let loaded = MachineSource::load(path.as_deref().and_then(Path::to_str).unwrap_or(name));
    let unread = || FileFault { key: None, message: format!("cannot read the base `{name}`"), help: None, place: None };
    loaded.map_err(|error| Box::new(error.faults.into_iter().next().unwrap_or_else(unread)))
}

/// The command, where the word is one.
fn command(root: &TableReader<'_>, machine: &Machine) -> Option<DesignCommand> {
    let Some(word) = root.get(&keys::COMMAND) else { return Some(DesignCommand::usual(machine)) };
    let found = DesignCommand::ALL.iter().copied().find(|command| command.word() == word);
    if found.is_none() {
        let words: Vec<&str> = DesignCommand::ALL.iter().map(|command| command.word()).collect();
        let near =
            similar(&word, words.iter().copied()).map_or(String::new(), |near| format!("did you mean \"{near}\"? "));
        let help = format!("{near}It is one of {}", words.join(", "));
        root.fail(&keys::COMMAND, format!("no command \"{word}\" makes a cam of a study"), Some(help));
    }
    found
}

/// How many rows there are, and how they are sampled.
fn spread(root: &TableReader<'_>, kind: StudyKind, parameters: &[Parameter]) -> Option<(u64, Option<Sampling>)> {
    if parameters.is_empty() {
        let help = "add [[parameter]] with key and values".to_owned();
        root.fail(&keys::KIND, "a study varies at least one key".to_owned(), Some(help));
        return None;
    }
    let rows = root.get(&keys::ROWS);
    let whole = |field: &'static crate::document::Field<f64>| match root.get(field) {
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
fn limits(
    reader: &Reader<'_>,
    root: &TableReader<'_>,
    kind: StudyKind,
) -> Option<(Vec<String>, Vec<Constraint>, Vec<Objective>)> {
    let mut columns: Vec<String> = Vec::new();
    for column in root.get(&keys::COLUMNS)? {
        if columns.contains(&column) {
            root.fail(&keys::COLUMNS, format!("\"{column}\" is given twice"), Some("remove one".into()));
            return None;
        }
        columns.push(column);
    }
    let mut number = |column: String| {
        columns.iter().position(|other| *other == column).unwrap_or_else(|| {
            columns.push(column);
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

/// A number of a parameter, where it is given; `Err` after a fault: it is none, or has another unit than the first one.
fn number(
    table: &TableReader<'_>,
    field: &crate::document::Field<String>,
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
fn parameter(table: &TableReader<'_>) -> Option<Parameter> {
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

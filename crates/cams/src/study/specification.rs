//! The study file: TOML to a [`Study`] with every value in range.

use super::figures::{Plan, figure_at, paths_of};
use super::keys;
use super::kind::{Constraint, Objective, StudyKind};
use super::parameter::{Parameter, SPEED, Values};
use super::parts::{base_of, command, limits, once_each, parameter, spread};
use super::sampling::{self, Sampling};
use crate::domain::DesignCommand;
use crate::machine::{Machine, MachineSource, fitting_stem, valid_rpm};
use crate::report::sha256;
use camgen_kernel::document::{FileFault, InputFiles, MOST_FAULTS, Reader, TableReader, similar};
use camgen_kernel::refusal::Refusal;
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

/// Why there is no study.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum StudyError {
    /// Faults of the study file or of its base, each with its place.
    #[error("{}", message(.0))]
    Faults(Vec<FileFault>),
    /// Something that has no place in the file, or a file that cannot be written.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

fn message(faults: &[FileFault]) -> String {
    faults.iter().map(FileFault::to_string).collect::<Vec<_>>().join("\n")
}

/// A study, every value in range.
#[derive(Clone)]
pub struct Study {
    pub(super) name: String,
    pub(super) stem: String,
    pub(super) kind: StudyKind,
    pub(super) base: Arc<MachineSource>,
    pub(super) command: &'static DesignCommand,
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
const EMBEDDED: [(&str, &str); 4] = [
    ("feeder-roller", include_str!("../../profiles/studies/feeder-roller.toml")),
    ("feeder-as-made", include_str!("../../profiles/studies/feeder-as-made.toml")),
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

/// The text of a study, and where it comes from.
#[derive(Clone, Copy)]
struct StudyText<'a> {
    text: &'a str,
    /// What the names of its files begin with.
    stem: &'a str,
    /// The folder from which its base is found.
    folder: Option<&'a Path>,
    /// By what the base is read.
    files: &'a InputFiles,
}

impl Study {
    /// Reads an embedded study by its name, or a file; the base is found from the folder of the file.
    ///
    /// # Errors
    /// All faults of the study file, or of its base.
    pub fn load(name_or_path: &str) -> Result<Self, StudyError> {
        Self::load_with(name_or_path, &InputFiles::default())
    }

    /// As [`Study::load`], read by `files`, which says in which folders further files may lie, and records what is read.
    ///
    /// # Errors
    /// As [`Study::load`].
    pub fn load_with(name_or_path: &str, files: &InputFiles) -> Result<Self, StudyError> {
        if let Some((name, text)) = EMBEDDED.iter().find(|(name, _)| *name == name_or_path) {
            return Self::read(&format!("{name} (embedded)"), StudyText { text, stem: name, folder: None, files });
        }
        let path = Path::new(name_or_path);
        let text = files.text_of(path, LARGEST_FILE).map_err(|why| {
            let names = EMBEDDED.map(|(name, _)| name);
            let near =
                similar(name_or_path, names).map_or(String::new(), |near| format!("did you mean `{near}`? Else "));
            let help = format!("{near}give a path to a TOML file or an embedded study: {}", names.join(", "));
            refused(format!("cannot read the study file `{name_or_path}`: {why}"), help)
        })?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        Self::read(name_or_path, StudyText { text: &text, stem: &stem, folder: path.parent(), files })
    }

    /// Reads a study from TOML text; `source` names it in messages.
    ///
    /// # Errors
    /// As [`Study::load`].
    pub fn from_toml(source: &str, text: &str) -> Result<Self, StudyError> {
        let stem = Path::new(source).file_stem().unwrap_or_default().to_string_lossy();
        Self::read(source, StudyText { text, stem: &stem, folder: None, files: &InputFiles::default() })
    }

    fn read(source: &str, text: StudyText<'_>) -> Result<Self, StudyError> {
        let reader = Reader::new(source, text.text, &[], keys::SECTIONS);
        let study = Self::from_reader(&reader, text);
        reader.finish().map_err(StudyError::Faults)?;
        match study {
            Ok(Some(study)) => Ok(study),
            // A part is missing only after a fault, so `finish` has returned before.
            Ok(None) => Err(StudyError::Faults(Vec::new())),
            Err(why) => Err(why),
        }
    }

    /// `None` after a fault that was reported.
    fn from_reader(reader: &Reader<'_>, study: StudyText<'_>) -> Result<Option<Self>, StudyError> {
        let StudyText { text, stem, folder, files } = study;
        let root = reader.table(&keys::ROOT);
        let parameters: Option<Vec<Parameter>> =
            reader.elements(&keys::PARAMETER).map(|table| parameter(&table)).collect();
        let (Some(parameters), Some(kind), Some(name)) = (parameters, root.get(&keys::KIND), root.get(&keys::NAME))
        else {
            return Ok(None);
        };
        once_each(reader, &root, &parameters);
        let drawn = spread(&root, kind, &parameters);
        let limits = limits(reader, &root, kind);
        let (Some((rows, sampling)), Some((columns, constraints, objectives))) = (drawn, limits) else {
            return Ok(None);
        };
        if !reader.is_faultless() {
            return Ok(None);
        }
        let base = root.get(&keys::BASE).unwrap_or_default();
        let base = match base_of(&base, folder, files) {
            Ok(base) => base,
            Err(fault) => {
                root.fail(&keys::BASE, fault.message, fault.help);
                return Ok(None);
            }
        };
        let set = root.get(&keys::SET).unwrap_or_default();
        let machine = Machine::of_source(&base, &set).map_err(|error| StudyError::Faults(error.faults))?;
        let Some(command) = command(&root, &machine) else { return Ok(None) };
        let inputs = machine.inputs(command.word);
        let inputs: Vec<String> = inputs.iter().map(|input| format!("{}={}", input.key, input.value)).collect();
        let digest = sha256(format!("{}\n{text}\n{}", env!("CARGO_PKG_VERSION"), inputs.join("\n")).as_bytes());
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and in range")]
        let seed = root.get(&keys::SEED).unwrap_or(1.0) as u64;
        let study = Self {
            name,
            stem: fitting_stem(stem),
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
            if reader.has_most_faults() {
                break;
            }
            if let Some(fault) = self.misfit(number) {
                let key = if self.is_known(number) { self.place_of(number) } else { &keys::KEY };
                table.fail(key, fault.message, fault.help);
            }
        }
        if !reader.is_faultless() {
            return Ok(None);
        }
        let (plan, tried) = self.planned();
        self.plan = plan;
        let known: Option<BTreeSet<String>> = tried.as_ref().map(|tried| paths_of(tried).into_iter().collect());
        if let Some(tried) = &tried {
            self.refuse_words(reader, tried);
        }
        let unknown: Vec<&String> = match &known {
            Some(known) => self.columns.iter().filter(|column| !known.contains(*column)).collect(),
            None => Vec::new(),
        };
        for column in unknown.into_iter().take(MOST_FAULTS) {
            let known = known.as_ref().into_iter().flatten();
            let inside = known.clone().filter(|path| path.starts_with(column.as_str()) && path.len() > column.len());
            let inside: Vec<&str> = inside.take(3).map(String::as_str).collect();
            let help = match (inside.as_slice(), similar(column, known.map(String::as_str))) {
                ([], Some(near)) => format!("did you mean \"{near}\"?"),
                ([], None) => format!("`camgen {} --json` prints the report that has them", self.command.word),
                (inside, _) => format!("it has several figures, e.g. \"{}\"", inside.join("\", \"")),
            };
            root.fail(&keys::COLUMNS, format!("the report has no figure \"{column}\""), Some(help));
        }
        Ok(reader.is_faultless().then_some(self))
    }

    /// Refuses limits and objectives that are words: they have no size.
    fn refuse_words(&self, reader: &Reader<'_>, tried: &Value) {
        let is_word = |column: usize| {
            self.columns.get(column).filter(|path| figure_at(tried, path).is_some_and(Value::is_string))
        };
        let help = Some("take a number, or `passed`, which is 1 or 0".to_owned());
        for (table, constraint) in reader.elements(&keys::CONSTRAINT).zip(&self.constraints) {
            if let Some(path) = is_word(constraint.column) {
                table.fail(&keys::COLUMN, format!("\"{path}\" is a word and has no limits"), help.clone());
            }
        }
        for (table, objective) in reader.elements(&keys::OBJECTIVE).zip(&self.objectives) {
            if let Some(path) = is_word(objective.column) {
                table.fail(&keys::COLUMN, format!("\"{path}\" is a word, and words have no order"), help.clone());
            }
        }
    }

    /// What is wrong with a parameter, where neither its first nor its last value fits its key.
    fn misfit(&self, number: usize) -> Option<FileFault> {
        let parameter = self.parameters.get(number)?;
        let ends = [0.0, 1.0 - f64::EPSILON].map(|share| parameter.value_at(share).typed);
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
            found = Some(
                faults.into_iter().find(|fault| fault.place.as_ref().is_some_and(|place| place.source == "--set"))?,
            );
        }
        found
    }

    /// Whether the base has the key of a parameter.
    fn is_known(&self, number: usize) -> bool {
        let key = self.parameters.get(number).map(|parameter| parameter.key.as_str());
        key.is_some_and(|key| key == SPEED || self.base.catalogue.keys.has_key(key))
    }

    /// The key that has the values of a parameter.
    fn place_of(&self, number: usize) -> &'static camgen_kernel::document::Field<String> {
        match self.parameters.get(number).map(|parameter| &parameter.values) {
            Some(Values::Range { .. }) => &keys::FROM,
            Some(Values::Normal { .. }) => &keys::MEAN,
            _ => &keys::KEY,
        }
    }

    /// What the columns need, from the first of a few rows that has a report, and the paths of its figures.
    fn planned(&self) -> (Plan, Option<Value>) {
        let tried = (0..self.rows.min(ROWS_TRIED)).find_map(|row| self.both_reports(row));
        match tried {
            Some((solved, proven)) => (Plan::new(&self.columns, &solved, &proven), Some(proven)),
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
            let values = self.parameters.iter().enumerate().map(|(number, parameter)| {
                parameter.value_at(sampling::share(sampling, self.seed, (row, self.rows), number as u64))
            });
            return values.collect();
        }
        // The last parameter changes from row to row.
        let mut rest = row;
        let all = self.parameters.iter().rev().map(|parameter| {
            let count = parameter.count().unwrap_or(1).max(1);
            let level = parameter.level(rest % count);
            rest /= count;
            level
        });
        let mut all: Vec<_> = all.collect();
        all.reverse();
        all
    }
}

/// Rows of which one must have a report, so that it is known what the columns need.
const ROWS_TRIED: u64 = 16;

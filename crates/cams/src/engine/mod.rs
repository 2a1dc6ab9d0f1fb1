//! One call for whoever changes a design and looks at what comes of it: the text of a machine file and changes of it, to the changed text, the
//! figures, what a page shows, and the proven files. The live page calls it in the browser (`live/`), `camgen serve` in the program; both get the
//! same bytes. It needs no file, no clock and no thread.
//!
//! A request is JSON ([`EngineRequest`]). An answer is a length of four bytes (little endian), so many bytes of JSON, then the bytes of the files
//! one after the other, as long as the JSON says.

use camgen_kernel::text::{KeyChange, Remedy};
mod design;
mod designs;
mod keys;
mod text;
mod values;

pub use designs::commands;
pub use text::TextChange;

use crate::machine::{FileFault, MachineError};
use crate::pipeline::{Error, FileSet, Writing};
use camgen_kernel::refusal::Refusal;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::Path;

/// Largest request, bytes: a machine file has at most a megabyte.
pub const LARGEST_REQUEST: usize = 4 << 20;

/// What is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Task {
    /// A cam of a text.
    #[default]
    Cam,
    /// Only the changed text.
    Text,
    /// The table of keys.
    Keys,
    /// The designs in the binary.
    Designs,
}

/// What is asked of the engine. Every member has a default.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct EngineRequest {
    /// What is wanted.
    pub task: Task,
    /// What messages call the text, and what the names of files begin with: a name of a file without its ending.
    pub name: String,
    /// The names of files begin with NAME-COMMAND-SPEEDrpm, as those of the command line, and not with the name alone.
    pub usual_names: bool,
    /// The text of the machine file.
    pub toml: String,
    /// The texts of the files that it names, by these names.
    pub files: BTreeMap<String, String>,
    /// Changes of the text, one after the other.
    pub changes: Vec<TextChange>,
    /// The command that makes the cam: `make`, `rotary`, `translating`, `compensator`, `conoid`; empty for the usual one of the file.
    pub command: String,
    /// Speeds, rpm; empty for that of the file.
    pub rpm: Vec<f64>,
    /// Tolerance of the outline, m; `None` for the usual one.
    pub tolerance: Option<f64>,
    /// The formats of the files that are wanted.
    pub formats: Vec<String>,
    /// What a page shows, with so many steps of a turn.
    pub page: Option<u32>,
    /// The report as data.
    pub report: bool,
}

/// A file of an answer.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EngineFile {
    /// Its name.
    pub name: String,
    /// Its bytes.
    pub bytes: Vec<u8>,
}

/// What the engine found.
#[derive(Debug, Clone, Default)]
pub struct EngineAnswer {
    /// What is known, by name.
    pub found: Map<String, Value>,
    /// The files.
    pub files: Vec<EngineFile>,
}

impl EngineAnswer {
    fn say(&mut self, name: &str, value: impl Into<Value>) {
        self.found.insert(name.to_owned(), value.into());
    }

    /// With the faults of a text, so that no cam is made.
    fn refuse(&mut self, error: &Error) {
        let faults = match error {
            Error::Machine(MachineError { faults }) => faults.iter().map(fault).collect(),
            other => vec![
                json!({"message": other.to_string(), "remedies": other.remedies().into_iter().map(changes).collect::<Vec<_>>()}),
            ],
        };
        self.say("faults", faults);
    }

    /// The answer as bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let files: Vec<Value> =
            self.files.iter().map(|file| json!({"name": file.name, "size": file.bytes.len()})).collect();
        let mut found = self.found.clone();
        found.insert("schema".to_owned(), Value::from(1));
        found.insert("files".to_owned(), Value::from(files));
        let head = Value::Object(found).to_string().into_bytes();
        let length = u32::try_from(head.len()).unwrap_or(u32::MAX).to_le_bytes();
        let bytes = self.files.iter().map(|file| file.bytes.as_slice());
        [&length, head.as_slice()].into_iter().chain(bytes).collect::<Vec<_>>().concat()
    }
}

/// The changes of a remedy, which a page can make at a click.
fn changes(remedy: &Remedy) -> Vec<TextChange> {
    let change = |change: &KeyChange| TextChange::Set { key: change.key.to_string(), to: change.value.clone() };
    remedy.changes.iter().map(change).collect()
}

/// A fault with its key, where it is in the text, and what would be right.
fn fault(fault: &FileFault) -> Value {
    json!({
        "key": fault.key,
        "message": fault.message,
        "help": fault.help,
        "line": fault.place.as_ref().map(|place| place.line),
        "remedies": [],
    })
}

/// The text of a request after its changes.
///
/// # Errors
/// [`Refusal`] where it is not TOML, or has not what is to be changed.
pub fn changed_text(toml: &str, changes: &[TextChange]) -> Result<String, Refusal> {
    text::changed(toml, changes)
}

/// The cam of a request as files in memory, to be written into a directory all or none.
///
/// Without a list of formats it writes those that the cam has.
///
/// # Errors
/// As each step of the pipeline; [`Error::Refused`] where a check failed.
pub fn files(request: &EngineRequest, directory: &Path, overwrite: bool) -> Result<FileSet, Error> {
    let toml = text::changed(&request.toml, &request.changes).map_err(Error::Solve)?;
    let formats = (!request.formats.is_empty()).then(|| request.formats.clone());
    let (proven, writing) = design::proven(request, &toml, formats, &mut EngineAnswer::default())?;
    proven.files(&Writing { directory: directory.to_owned(), overwrite, ..writing })
}

/// Answers a request.
///
/// ```
/// # use camgen_cams as camgen;
/// use camgen::engine::{EngineRequest, TextChange, answer};
///
/// let toml = camgen::catalogue::catalogue().embedded.iter().find(|file| file.name == "feeder").map(|file| file.toml.to_owned());
/// let changes = vec![TextChange::Set { key: "cam.base_radius".into(), to: "60 mm".into() }];
/// let request = EngineRequest { name: "feeder".into(), toml: toml.unwrap_or_default(), changes, formats: vec!["dxf".into()], ..EngineRequest::default() };
/// let answer = answer(&request);
/// assert_eq!(answer.found["passed"], true);
/// assert_eq!(answer.files[0].name, "feeder.dxf");
/// ```
#[must_use]
pub fn answer(request: &EngineRequest) -> EngineAnswer {
    let mut answer = EngineAnswer::default();
    match request.task {
        Task::Keys => answer.say("keys", keys::table()),
        Task::Designs => answer.say("designs", designs::list()),
        Task::Text | Task::Cam => match text::changed(&request.toml, &request.changes) {
            Err(why) => {
                answer.say("toml", request.toml.clone());
                answer.say("faults", vec![json!({"message": why.to_string()})]);
            }
            Ok(toml) => {
                answer.say("toml", toml.clone());
                answer.say("given", text::given(&toml).into_iter().map(|key| key.path).collect::<Vec<_>>());
                let made = match request.task {
                    // A text that is not a design yet has no limits.
                    Task::Text => design::machine(request, &toml, &mut answer).map(drop).or(Ok(())),
                    _ => design::made(request, &toml, &mut answer),
                };
                if let Err(error) = made {
                    answer.refuse(&error);
                }
            }
        },
    }
    answer
}

/// Answers a request as bytes with bytes; one that cannot be read with a fault.
#[must_use]
pub fn answer_bytes(request: &[u8]) -> Vec<u8> {
    if request.len() > LARGEST_REQUEST {
        return refused(&format!("a request has at most {LARGEST_REQUEST} bytes"));
    }
    match serde_json::from_slice::<EngineRequest>(request) {
        Ok(request) => answer(&request).to_bytes(),
        Err(why) => refused(&format!("not a request: {why}")),
    }
}

fn refused(why: &str) -> Vec<u8> {
    let mut answer = EngineAnswer::default();
    answer.say("faults", vec![json!({"message": why})]);
    answer.to_bytes()
}

//! What is served: the page of a design, the engine behind it, and the files that it may write.

use super::super::Failure;
use super::super::args::ServeArgs;
use super::super::input_files;
use super::super::put::refuse_inputs;
use super::http::Answer;
use super::target::{MachineFile, plain};
use camgen::catalogue::catalogue;
use camgen::engine::{self, EngineRequest, Task};
use camgen::machine::MachineSource;
use camgen::write::html::live::{self, LiveDesign};
use serde::Deserialize;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Tolerance of outlines by default, m.
const TOLERANCE: f64 = 5e-6;
/// The design that is shown first where none is given.
const FIRST: &str = "feeder";
/// Steps of a turn of the first picture.
const STEPS: u32 = 720;

/// A request to write a machine file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Save {
    /// Which of the designs.
    design: usize,
    toml: String,
    /// The text that the page has seen on the disk.
    before: String,
}

/// A design shown by the page.
struct ServedDesign {
    /// The design at the start of the program.
    design: LiveDesign,
    /// Its file; `None` of an embedded one.
    file: Option<MachineFile>,
}

/// What is served.
pub(super) struct Served {
    token: String,
    /// The designs of the page; the first is shown.
    designs: Vec<ServedDesign>,
    out: PathBuf,
    overwrite: bool,
    /// One request of the engine at a time, so that many of them do not take the whole computer; and one that writes.
    turn: Mutex<()>,
}

impl Served {
    pub(super) fn new(args: &ServeArgs, token: String) -> Result<Self, Failure> {
        let names = if args.files.is_empty() { vec![FIRST.to_owned()] } else { args.files.clone() };
        let designs = names.iter().map(|name| design(name, args)).collect::<Result<Vec<_>, _>>()?;
        for (at, one) in designs.iter().enumerate() {
            let name = &one.design.name;
            if designs.iter().take(at).any(|other| other.design.name == *name) {
                return Err(Failure(format!("two designs are called `{name}`, so their files have the same names")));
            }
        }
        Ok(Self { token, designs, out: args.out.clone(), overwrite: args.overwrite, turn: Mutex::new(()) })
    }

    pub(super) fn token(&self) -> &str {
        &self.token
    }

    /// The page, with the cam of the first design as it is on the disk now; where it has none, with another and what is wrong.
    pub(super) fn page(&self) -> Answer {
        let designs: Vec<LiveDesign> =
            self.designs.iter().map(|one| one.as_it_is().unwrap_or(one.design.clone())).collect();
        let Some(first) = designs.first() else { return Answer::refused(500, "there is no design") };
        let cam = shown(first).or_else(|| shown(&usual()?));
        let Some(cam) = cam else { return Answer::refused(500, "there is no cam to show") };
        let title = cam["title"].as_str().unwrap_or_default().to_owned();
        match live::page((&title, cam), &designs, Some(&self.token)) {
            Ok(page) => Answer::new("text/html; charset=utf-8", page),
            Err(why) => Answer::refused(500, &why.to_string()),
        }
    }

    /// The engine's answer.
    pub(super) fn engine(&self, body: &[u8]) -> Answer {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        Answer::new("application/octet-stream", engine::answer_bytes(body))
    }

    /// The texts of the machine files as they are now, each with those of the files that it names, or why not.
    pub(super) fn files(&self) -> Answer {
        let designs = self.designs.iter().map(|one| match one.as_it_is() {
            Ok(design) => json!({"toml": design.toml, "files": design.files}),
            Err(why) => json!({"fault": why}),
        });
        json_answer(Ok(json!({"designs": designs.collect::<Vec<Value>>()})))
    }

    /// Writes the text of a machine file.
    pub(super) fn save(&self, body: &[u8]) -> Answer {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        json_answer(self.saved(body))
    }

    fn saved(&self, body: &[u8]) -> Result<Value, String> {
        let asked: Save = serde_json::from_slice(body).map_err(|why| format!("not a request: {why}"))?;
        let one = self.designs.get(asked.design).ok_or("there is no machine file to write")?;
        let file = one.file.as_ref().ok_or("there is no machine file to write")?;
        file.write(&asked.toml, &asked.before)?;
        Ok(json!({"written": [one.design.file]}))
    }

    /// Writes the files of a cam, all or none.
    pub(super) fn write(&self, body: &[u8]) -> Answer {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        json_answer(self.written(body))
    }

    fn written(&self, body: &[u8]) -> Result<Value, String> {
        let request: EngineRequest = serde_json::from_slice(body).map_err(|why| format!("not a request: {why}"))?;
        let name = camgen::machine::fault_of_stem(&request.name).map_or(Ok(()), Err);
        name.map_err(|why| format!("the name of the files: {why}"))?;
        let set = engine::files(&request, &self.out, self.overwrite).map_err(|why| why.to_string())?;
        let place = set.open().map_err(|why| why.to_string())?;
        let (report, staged) = set.stage(place).map_err(|why| why.to_string())?;
        refuse_inputs(&staged.targets()).map_err(|why| why.to_string())?;
        staged.commit().map_err(|why| why.to_string())?;
        Ok(json!({"written": report.files}))
    }
}

/// What was done, or why not, as the page shows it.
fn json_answer(done: Result<Value, String>) -> Answer {
    let value = done.unwrap_or_else(|why| json!({"faults": [{"message": why}]}));
    Answer::new("application/json", value.to_string().into_bytes())
}

/// A design by the name of an embedded one or the path of a file.
fn design(name: &str, args: &ServeArgs) -> Result<ServedDesign, Failure> {
    let source = input_files::source(name).map_err(Failure::new)?;
    let is_embedded = catalogue().names().iter().any(|own| own.eq_ignore_ascii_case(name));
    // The page says what is wrong with a design.
    let machine = camgen::Machine::of_source(&source, &[]);
    let commands = machine.as_ref().map(engine::commands).unwrap_or_default();
    let named = (!args.files.is_empty() && (!is_embedded || Path::new(name).exists())).then(|| name.to_owned());
    let file = named.as_deref().map(MachineFile::new).transpose().map_err(Failure::new)?;
    let design = LiveDesign {
        commands: commands.into_iter().map(str::to_owned).collect(),
        rpm: args.rpm.into_iter().collect(),
        tolerance: args.tolerance.unwrap_or(TOLERANCE),
        file: named,
        ..of_source(&source)
    };
    Ok(ServedDesign { design, file })
}

fn of_source(source: &MachineSource) -> LiveDesign {
    let (name, toml) = (source.stem().to_owned(), plain(source.text()));
    LiveDesign { name, toml, files: source.named_texts(&[]), tolerance: TOLERANCE, ..LiveDesign::default() }
}

impl ServedDesign {
    /// The design with the current text of its file.
    fn as_it_is(&self) -> Result<LiveDesign, String> {
        let Some(file) = &self.file else { return Ok(self.design.clone()) };
        let toml = plain(&file.text()?);
        let name = self.design.file.as_deref().unwrap_or_default();
        let files = input_files::source(name).map(|source| source.named_texts(&[])).unwrap_or_default();
        Ok(LiveDesign { toml, files, ..self.design.clone() })
    }
}

/// The design that is shown where there is no other.
fn usual() -> Option<LiveDesign> {
    Some(of_source(&input_files::source(FIRST).ok()?))
}

/// What a page shows of a design, where it has a cam with an outline.
fn shown(design: &LiveDesign) -> Option<Value> {
    let request = EngineRequest {
        task: Task::Cam,
        name: design.name.clone(),
        toml: design.toml.clone(),
        files: design.files.clone(),
        command: design.command.clone(),
        rpm: design.rpm.clone(),
        tolerance: Some(design.tolerance),
        page: Some(STEPS),
        ..EngineRequest::default()
    };
    let answer = engine::answer(&request);
    answer.found.get("cam").filter(|cam| cam["views"].is_array()).cloned()
}

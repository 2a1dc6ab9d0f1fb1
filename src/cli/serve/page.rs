//! What is served: the page of a design, the engine behind it, and the files that it may write.

use super::super::Failure;
use super::super::args::ServeArgs;
use super::http::Answer;
use camgen::document::file;
use camgen::engine::{self, EngineRequest, Task, TextChange};
use camgen::machine::MachineSource;
use camgen::write::html::live::{self, LiveDesign, LiveServer};
use serde_json::{Map, Value, json};
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Tolerance of outlines by default, m.
const TOLERANCE: f64 = 5e-6;
/// The design that is shown first where none is given.
const FIRST: &str = "feeder";
/// Steps of a turn of the first picture.
const STEPS: u32 = 720;
/// Largest machine file, bytes.
const LARGEST_FILE: u64 = 1 << 20;

/// What is served.
pub(super) struct Served {
    server: LiveServer,
    /// The machine file, where it is one of the user's.
    file: Option<PathBuf>,
    design: LiveDesign,
    out: PathBuf,
    overwrite: bool,
    /// One request of the engine at a time, so that many of them do not take the whole computer; and one that writes.
    turn: Mutex<()>,
}

impl Served {
    pub(super) fn new(args: &ServeArgs, token: String) -> Result<Self, Failure> {
        let source = MachineSource::load(args.file.as_deref().unwrap_or(FIRST)).map_err(Failure::new)?;
        let is_embedded =
            |name: &str| camgen::catalogue::catalogue().names().iter().any(|own| own.eq_ignore_ascii_case(name));
        let own = args.file.as_deref().filter(|name| !is_embedded(name) || Path::new(name).exists());
        if let [key, ..] = engine::keys_with_files(source.text()).as_slice() {
            return Err(Failure(format!(
                "serve cannot follow the file that `{key}` names; write its rows as points, or use make"
            )));
        }
        let design = LiveDesign {
            name: source.stem().to_owned(),
            toml: source.text().to_owned(),
            command: String::new(),
            commands: Vec::new(),
            rpm: args.rpm.into_iter().collect(),
            tolerance: args.tolerance.unwrap_or(TOLERANCE),
        };
        // The page says what is wrong with a design; what cannot be a cam at all is refused here.
        let machine = camgen::Machine::of_source(&source, &[]);
        let commands = machine.as_ref().map(engine::commands).unwrap_or_default();
        let design = LiveDesign { commands: commands.into_iter().map(str::to_owned).collect(), ..design };
        Ok(Self {
            server: LiveServer { token, file: own.map(str::to_owned) },
            file: own.map(PathBuf::from),
            design,
            out: args.out.clone(),
            overwrite: args.overwrite,
            turn: Mutex::new(()),
        })
    }

    pub(super) fn token(&self) -> &str {
        &self.server.token
    }

    /// The page, with the cam of the design as it is on the disk now; where it has none, with another and what is wrong.
    pub(super) fn page(&self) -> Answer {
        let toml = self.text().unwrap_or_else(|_| self.design.toml.clone());
        let design = LiveDesign { toml, ..self.design.clone() };
        let cam = shown(&design).or_else(|| shown(&first()?));
        let Some(cam) = cam else { return Answer::refused(500, "there is no cam to show") };
        let title = cam["title"].as_str().unwrap_or_default().to_owned();
        match live::page((&title, cam), &design, Some(&self.server)) {
            Ok(page) => Answer::of("text/html; charset=utf-8", page),
            Err(why) => Answer::refused(500, &why.to_string()),
        }
    }

    /// The engine's answer.
    pub(super) fn engine(&self, body: &[u8]) -> Answer {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        Answer::of("application/octet-stream", engine::answer_bytes(body))
    }

    /// The text of the machine file as it is now.
    fn text(&self) -> Result<String, String> {
        let Some(path) = &self.file else { return Ok(self.design.toml.clone()) };
        file::text_of(path, LARGEST_FILE).map_err(|why| format!("cannot read `{}`: {why}", path.display()))
    }

    pub(super) fn file(&self) -> Answer {
        told(self.text().map(|toml| json!({"toml": toml})))
    }

    /// Writes the text of the machine file.
    pub(super) fn save(&self, body: &[u8]) -> Answer {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        told(self.saved(body))
    }

    fn saved(&self, body: &[u8]) -> Result<Value, String> {
        let asked: Map<String, Value> = serde_json::from_slice(body).map_err(|why| format!("not a request: {why}"))?;
        let path = self.file.as_ref().ok_or("there is no machine file to write")?;
        let text = |name: &str| asked.get(name).and_then(Value::as_str).ok_or(format!("`{name}` is missing"));
        let (toml, before) = (text("toml")?, text("before")?);
        // Any change shows whether it is TOML.
        let change = TextChange::Set { key: "name".into(), to: "checked".into() };
        engine::changed_text(toml, &[change]).map_err(|why| why.to_string())?;
        if self.text()? != before {
            return Err("the file was changed by another program since; it is read again now".into());
        }
        replace(path, toml.as_bytes()).map_err(|why| format!("cannot write `{}`: {why}", path.display()))?;
        Ok(json!({"written": [path.display().to_string()]}))
    }

    /// Writes the files of a cam, all or none.
    pub(super) fn write(&self, body: &[u8]) -> Answer {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        told(self.written(body))
    }

    fn written(&self, body: &[u8]) -> Result<Value, String> {
        let request: EngineRequest = serde_json::from_slice(body).map_err(|why| format!("not a request: {why}"))?;
        let name = camgen::machine::fault_of_stem(&request.name).map_or(Ok(()), Err);
        name.map_err(|why| format!("the name of the files: {why}"))?;
        let set = engine::files(&request, &self.out, self.overwrite).map_err(|why| why.to_string())?;
        let report = set.commit().map_err(|why| why.to_string())?;
        Ok(json!({"written": report.files}))
    }
}

/// What was done, or why not, as the page shows it.
fn told(done: Result<Value, String>) -> Answer {
    let value = done.unwrap_or_else(|why| json!({"faults": [{"message": why}]}));
    Answer::of("application/json", value.to_string().into_bytes())
}

/// The design that is shown where there is no other.
fn first() -> Option<LiveDesign> {
    let source = MachineSource::load(FIRST).ok()?;
    Some(LiveDesign {
        name: FIRST.into(),
        toml: source.text().to_owned(),
        command: String::new(),
        commands: Vec::new(),
        rpm: Vec::new(),
        tolerance: TOLERANCE,
    })
}

/// What a page shows of a design, where it has a cam with an outline.
fn shown(design: &LiveDesign) -> Option<Value> {
    let request = EngineRequest {
        task: Task::Cam,
        name: design.name.clone(),
        toml: design.toml.clone(),
        command: design.command.clone(),
        rpm: design.rpm.clone(),
        tolerance: Some(design.tolerance),
        page: Some(STEPS),
        ..EngineRequest::default()
    };
    let answer = engine::answer(&request);
    answer.found.get("cam").filter(|cam| cam["views"].is_array()).cloned()
}

/// Writes a file next to its place and renames it, so that it is never half written.
fn replace(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    let path = fs::canonicalize(path)?;
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".camgen-new");
    let beside = path.with_file_name(name);
    let mut file = File::options().write(true).create_new(true).open(&beside)?;
    let written = file.write_all(bytes).and_then(|()| file.set_permissions(fs::metadata(&path)?.permissions()));
    let done = written.and_then(|()| file.sync_all()).and_then(|()| fs::rename(&beside, &path));
    if done.is_err() {
        _ = fs::remove_file(&beside);
    }
    done
}

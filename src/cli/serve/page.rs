//! What is served: the page of a design, the engine behind it, and the files that it may write.

use super::super::Failure;
use super::super::args::ServeArgs;
use super::http::Answer;
use camgen::catalogue::catalogue;
use camgen::document::file;
use camgen::engine::{self, EngineRequest, Task, TextChange};
use camgen::machine::MachineSource;
use camgen::write::html::live::{self, LiveDesign};
use serde::Deserialize;
use serde_json::{Value, json};
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

/// What is served.
pub(super) struct Served {
    token: String,
    /// The designs of the page; the first is shown.
    designs: Vec<LiveDesign>,
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
            if designs.iter().take(at).any(|other| other.name == one.name) {
                return Err(Failure(format!(
                    "two designs are called `{}`: their files would have the same names",
                    one.name
                )));
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
            self.designs.iter().map(|design| as_it_is(design).unwrap_or(design.clone())).collect();
        let Some(first) = designs.first() else { return Answer::refused(500, "there is no design") };
        let cam = shown(first).or_else(|| shown(&usual()?));
        let Some(cam) = cam else { return Answer::refused(500, "there is no cam to show") };
        let title = cam["title"].as_str().unwrap_or_default().to_owned();
        match live::page((&title, cam), &designs, Some(&self.token)) {
            Ok(page) => Answer::of("text/html; charset=utf-8", page),
            Err(why) => Answer::refused(500, &why.to_string()),
        }
    }

    /// The engine's answer.
    pub(super) fn engine(&self, body: &[u8]) -> Answer {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        Answer::of("application/octet-stream", engine::answer_bytes(body))
    }

    /// The texts of the machine files as they are now, each with those of the files that it names, or why not.
    pub(super) fn files(&self) -> Answer {
        let of = |design: &LiveDesign| match as_it_is(design) {
            Ok(design) => json!({"toml": design.toml, "files": design.files}),
            Err(why) => json!({"fault": why}),
        };
        json_answer(Ok(json!({"designs": self.designs.iter().map(of).collect::<Vec<Value>>()})))
    }

    /// Writes the text of a machine file.
    pub(super) fn save(&self, body: &[u8]) -> Answer {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        json_answer(self.saved(body))
    }

    fn saved(&self, body: &[u8]) -> Result<Value, String> {
        let asked: Save = serde_json::from_slice(body).map_err(|why| format!("not a request: {why}"))?;
        let design = self.designs.get(asked.design);
        let path = design.and_then(|design| design.file.as_ref()).ok_or("there is no machine file to write")?;
        // Any change shows whether it is TOML.
        let change = TextChange::Set { key: "name".into(), to: "checked".into() };
        engine::changed_text(&asked.toml, &[change]).map_err(|why| why.to_string())?;
        let raw = raw_text(path)?;
        if plain(&raw) != asked.before {
            return Err("the file was changed by another program since; it is read again now".into());
        }
        let protected = fs::metadata(path).is_ok_and(|data| data.permissions().readonly());
        if protected {
            return Err(format!(
                "`{path}` is protected against writing: allow it, or download the TOML under another name"
            ));
        }
        let written = as_before(&plain(&asked.toml), &raw);
        replace(Path::new(path), written.as_bytes()).map_err(|why| format!("cannot write `{path}`: {why}"))?;
        Ok(json!({"written": [path]}))
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
        let report = set.commit().map_err(|why| why.to_string())?;
        Ok(json!({"written": report.files}))
    }
}

/// What was done, or why not, as the page shows it.
fn json_answer(done: Result<Value, String>) -> Answer {
    let value = done.unwrap_or_else(|why| json!({"faults": [{"message": why}]}));
    Answer::of("application/json", value.to_string().into_bytes())
}

/// A design by the name of an embedded one or the path of a file.
fn design(name: &str, args: &ServeArgs) -> Result<LiveDesign, Failure> {
    let source = MachineSource::load(name).map_err(Failure::new)?;
    let is_embedded = catalogue().names().iter().any(|own| own.eq_ignore_ascii_case(name));
    // The page says what is wrong with a design.
    let machine = camgen::Machine::of_source(&source, &[]);
    let commands = machine.as_ref().map(engine::commands).unwrap_or_default();
    Ok(LiveDesign {
        commands: commands.into_iter().map(str::to_owned).collect(),
        rpm: args.rpm.into_iter().collect(),
        tolerance: args.tolerance.unwrap_or(TOLERANCE),
        file: (!args.files.is_empty() && (!is_embedded || Path::new(name).exists())).then(|| name.to_owned()),
        ..of_source(&source)
    })
}

fn of_source(source: &MachineSource) -> LiveDesign {
    let (name, toml) = (source.stem().to_owned(), plain(source.text()));
    LiveDesign { name, toml, files: source.named_texts(&[]), tolerance: TOLERANCE, ..LiveDesign::default() }
}

/// A design with the text that its file has now.
fn as_it_is(design: &LiveDesign) -> Result<LiveDesign, String> {
    let Some(path) = &design.file else { return Ok(design.clone()) };
    let toml = text(path)?;
    let files = MachineSource::load(path).map(|source| source.named_texts(&[])).unwrap_or_default();
    Ok(LiveDesign { toml, files, ..design.clone() })
}

/// The text of a machine file as it is now, as a page has it.
fn text(path: &str) -> Result<String, String> {
    raw_text(path).map(|text| plain(&text))
}

fn raw_text(path: &str) -> Result<String, String> {
    file::text_of(Path::new(path), LARGEST_FILE).map_err(|why| format!("cannot read `{path}`: {why}"))
}

/// The mark that some editors put before UTF-8.
const MARK: char = '\u{feff}';

/// A text with the line ends that a browser knows, without a mark.
fn plain(text: &str) -> String {
    text.strip_prefix(MARK).unwrap_or(text).replace("\r\n", "\n")
}

/// A text with the mark and the line ends of the one that it replaces.
fn as_before(text: &str, before: &str) -> String {
    let ends = before.matches('\n').count();
    let of_windows = 2 * before.matches("\r\n").count() > ends;
    let text = if of_windows { text.replace('\n', "\r\n") } else { text.to_owned() };
    if before.starts_with(MARK) { format!("{MARK}{text}") } else { text }
}

/// The design that is shown where there is no other.
fn usual() -> Option<LiveDesign> {
    Some(of_source(&MachineSource::load(FIRST).ok()?))
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

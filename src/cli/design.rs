//! The design of a file that is checked, when none is given: that of the record next to it, or one whose hash is in the file.

use super::Failure;
use super::args::{CheckArgs, Speed, at_end};
use super::cams::{balance_of, of_program};
use camgen::body::conjugate::COUNTER;
use camgen::body::{RateTolerance, Request};
use camgen::catalogue::catalogue;
use camgen::document::{Input, NamedChoice, shown};
use camgen::domains::press::MachineOfPress;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::cams::{ROTARY, TRANSLATING};
use camgen::domains::press::motion::equation_18::{ExactOn, Solver};
use camgen::domains::press::wedge::LAW_TOLERANCE;
use camgen::machine::Machine;
use camgen::pipeline::Spec;
use camgen::profile::outline::{Fit, SegmentKind, Side};
use camgen::report::Inputs;
use camgen::write::record::{RECORD, RecordedRun, runs};
use std::path::{Path, PathBuf};

/// Most design files that are tried.
const MOST_FILES: usize = 200;
/// Characters of the stem of files that are shown.
const LONGEST_STEM: usize = 80;
/// What the names of the files of a compensating cam have after the stem, and the command that makes it alone.
const COMPENSATOR: &str = "compensator";
/// The cams that are made with others, by their commands, which the names of their files have after the stem.
const MADE_WITH: [&str; 2] = [COMPENSATOR, COUNTER.command];

/// The cam that a file should contain, and how it was found.
pub(super) struct Design {
    pub(super) spec: Spec,
    /// A sentence about where it was found; `None` where the user gave it.
    pub(super) told: Option<String>,
    /// What the file was made from, where it was recorded.
    pub(super) recorded: Option<RecordedRun>,
    /// Whether the cam must be made from just that: nothing was overridden.
    pub(super) exact: bool,
}

impl Design {
    /// A cam that the user named.
    pub(super) fn given(spec: Spec) -> Self {
        Self { spec, told: None, recorded: None, exact: false }
    }

    /// The recorded value of a key, as typed.
    fn input(&self, key: &str) -> Option<&Input> {
        self.recorded.as_ref()?.inputs.iter().find(|input| input.key == key)
    }

    /// The recorded length, m.
    pub(super) fn length(&self, key: &str) -> Option<f64> {
        self.input(key)?.value.parse().ok()
    }

    /// The recorded side of the outline.
    pub(super) fn side(&self) -> Option<Side> {
        let word = &self.input("side")?.value;
        Side::ALL.iter().find(|(name, _)| name == word).map(|(_, side)| *side)
    }
}

fn folder_of(file: &Path) -> PathBuf {
    file.parent().filter(|folder| !folder.as_os_str().is_empty()).map_or_else(|| PathBuf::from("."), Path::to_owned)
}

/// The design of a file; `None` where it is found neither by the record nor by a hash.
pub(super) fn of_file(args: &CheckArgs, bytes: &[u8]) -> Result<Option<Design>, Failure> {
    let hash = Inputs::hash_in(bytes);
    let folder = folder_of(&args.file);
    let name = args.file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let of_cams: Vec<RecordedRun> = runs(&folder).into_iter().filter(|run| !is_study(run)).collect();
    if let Some(run) = run_of(&of_cams, &name, hash.as_deref())
        && let Some(design) = of_run(args, run, &folder)?
    {
        return Ok(Some(design));
    }
    let Some(hash) = hash else { return Ok(None) };
    Ok(by_hash(args, &folder, &hash))
}

/// Whether a run was a study.
fn is_study(run: &RecordedRun) -> bool {
    run.inputs.iter().any(|input| input.key == "command" && input.value == "study")
}

/// The run that a file is of: by its hash; without one by its name, or the only one.
fn run_of(all: &[RecordedRun], name: &str, hash: Option<&str>) -> Option<RecordedRun> {
    if let Some(hash) = hash {
        let mut both = all
            .iter()
            .flat_map(|run| std::iter::once(run.clone()).chain(MADE_WITH.map(|command| with_command(run, command))));
        return both.find(|run| Inputs::of(&run.inputs).hash == hash);
    }
    let named = all.iter().filter(|run| {
        name.strip_prefix(run.stem.as_str()).is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
    });
    let run = named.max_by_key(|run| run.stem.len()).or(match all {
        [only] => Some(only),
        _ => None,
    })?;
    let rest = name.strip_prefix(run.stem.as_str()).and_then(|rest| rest.strip_prefix('-'));
    let other = rest.and_then(|rest| MADE_WITH.into_iter().find(|command| rest.starts_with(command)));
    Some(other.map_or_else(|| run.clone(), |command| with_command(run, command)))
}

/// A run as that of another command, which made its cam along with its own.
fn with_command(run: &RecordedRun, command: &str) -> RecordedRun {
    let mut inputs = run.inputs.clone();
    inputs.iter_mut().filter(|input| input.key == "command").for_each(|input| command.clone_into(&mut input.value));
    RecordedRun { inputs, ..run.clone() }
}

/// The design that was recorded, with what the user overrides; `None` where it cannot be made from the record alone.
fn of_run(args: &CheckArgs, run: RecordedRun, folder: &Path) -> Result<Option<Design>, Failure> {
    let value = |key: &str| run.inputs.iter().find(|input| input.key == key).map(|input| input.value.clone());
    let text = catalogue().keys.text_of(&run.inputs);
    let record = folder.join(RECORD).display().to_string();
    let exact = args.common.set.is_empty() && args.common.rpm.is_empty() && args.common.end.is_none();
    let machine = match Machine::from_toml(&record, &text, &args.common.set) {
        Ok(machine) => at_end(args.common.end, (machine, String::new()))?.0,
        // With an override the fault may be the user's.
        Err(error) if !args.common.set.is_empty() => return Err(Failure::new(error)),
        Err(_) => return Ok(None),
    };
    let speeds: Option<Vec<f64>> = match args.common.rpm.as_slice() {
        [] => value("rpm").and_then(|rpm| rpm.split(", ").map(|rpm| rpm.parse().ok()).collect()),
        given => given.iter().map(|speed| if let Speed::One(rpm) = speed { Some(*rpm) } else { None }).collect(),
    };
    let one = match speeds.as_deref() {
        Some([rpm]) => Some(*rpm),
        _ => None,
    };
    let command = value("command").unwrap_or_default();
    let spec = match command.as_str() {
        "make" => Spec::of_program(machine, one),
        name if name == COUNTER.command => Spec::made_with_program(machine, one, COUNTER.command),
        ROTARY => one.map(|rpm| Spec::rotary(machine, rpm)),
        COMPENSATOR => one.map(|rpm| Spec::compensator(machine, rpm)),
        TRANSLATING => {
            let balance = value("balance");
            let known = ExactOn::ALL.iter().find(|(word, _)| Some(*word) == balance.as_deref());
            let solver = Solver::Ode { tolerance: LAW_TOLERANCE };
            one.zip(known).map(|(rpm, (_, balance))| Spec::translating(machine, rpm, solver, *balance))
        }
        "conoid" => {
            let residual = value("residual").and_then(|limit| limit.parse().ok());
            speeds.map(|speeds| Spec::conoid(machine, speeds, residual))
        }
        _ => None,
    };
    // Anybody may have made the record.
    let stem = shown(&run.stem, LONGEST_STEM);
    let told = format!("found in the record `{record}`: the files {stem}, inputs {}", Inputs::of(&run.inputs).hash);
    Ok(spec.map(|spec| Design { spec, told: Some(told), recorded: Some(run), exact }))
}

/// The requests that a file may have been made with: the named accuracies and the given tolerance, on each side, with arcs and splines.
fn requests(args: &CheckArgs) -> Vec<Request> {
    let accuracy = &args.common.accuracy;
    let given = accuracy.tolerance.map(|tolerance| (tolerance, Some(0.05)));
    let named = [(5e-6, Some(0.05)), (50e-6, None), (0.5e-6, Some(0.01))];
    let mut all = Vec::new();
    for (tolerance, share) in given.into_iter().chain(named) {
        for (_, side) in Side::ALL {
            for (_, laid) in SegmentKind::ALL {
                let rates = [None, share.map(RateTolerance::Share)];
                let fit = Fit { side: *side, laid: *laid, ..Fit::from(tolerance) };
                all.push(Request { rates, ..Request::within(fit) });
            }
        }
    }
    all
}

/// A machine in the binary, or a design file next to the file or in the working directory, whose cam has this hash.
fn by_hash(args: &CheckArgs, folder: &Path, hash: &str) -> Option<Design> {
    let requests = requests(args);
    let is_one =
        |spec: &Spec, kind| requests.iter().any(|request| spec.inputs_hash(kind, request).as_deref() == Some(hash));
    let named = catalogue().names().into_iter().map(str::to_owned);
    for name in named.chain(design_files(folder)) {
        let Ok((machine, _)) = args.machine_of(&name) else { continue };
        for (kind, spec) in specs(args, &machine, &name) {
            if is_one(&spec, kind) {
                let told = format!("found by the hash in the file: {} of {name}, inputs {hash}", kind.0);
                return Some(Design { told: Some(told), ..Design::given(spec) });
            }
        }
    }
    None
}

/// The cams of a machine, each with its command and the kind whose keys have an effect on it.
fn specs(args: &CheckArgs, machine: &Machine, name: &str) -> Vec<((&'static str, &'static str), Spec)> {
    let mut all = Vec::new();
    if let Ok(spec) = of_program(&args.common, (machine.clone(), name)) {
        let (body, rpm) =
            (spec.machine().body(), args.common.one_speed(machine).ok().filter(|_| !args.common.rpm.is_empty()));
        all.push((("make", body), spec));
        let counter = Spec::made_with_program(machine.clone(), rpm, COUNTER.command);
        all.extend(counter.filter(|_| body == COUNTER.keys).map(|spec| ((COUNTER.command, body), spec)));
    }
    if let (Ok(_), Ok(rpm)) = (machine.press(), args.common.one_speed(machine)) {
        let solver = Solver::Ode { tolerance: LAW_TOLERANCE };
        all.push(((ROTARY, ROTARY), Spec::rotary(machine.clone(), rpm)));
        all.push((
            (TRANSLATING, TRANSLATING),
            Spec::translating(machine.clone(), rpm, solver, balance_of(args.balance, machine)),
        ));
        all.push(((COMPENSATOR, ROTARY), Spec::compensator(machine.clone(), rpm)));
    }
    all
}

/// The design files next to a file and in the working directory.
fn design_files(folder: &Path) -> Vec<String> {
    let here = PathBuf::from(".");
    let mut folders = vec![folder.to_owned()];
    folders.extend((folder != here).then_some(here));
    let mut files: Vec<String> = Vec::new();
    for folder in folders {
        let entries = std::fs::read_dir(&folder).into_iter().flatten().flatten().map(|entry| entry.path());
        let designs = entries.filter(|path| path.extension().is_some_and(|ending| ending == "toml"));
        let mut found: Vec<String> = designs.map(|path| path.display().to_string()).collect();
        found.sort();
        files.extend(found);
    }
    files.truncate(MOST_FILES);
    files
}

/// The request for the design, and what is wrong: there is no design.
pub(super) fn asked(file: &Path, bytes: &[u8]) -> Failure {
    let file = file.display();
    let why = match Inputs::hash_in(bytes) {
        Some(hash) => format!(
            "neither the record next to it nor a machine or design file here has the inputs {hash} from which it was made"
        ),
        None => "it does not say from which design it was made, and there is no record of it next to it".to_owned(),
    };
    Failure(format!(
        "which cam should `{file}` be? {why}. Give its design, `camgen check {file} --design FILE`, or a machine, `camgen check {file} dpi \
         --rpm 35`"
    ))
}

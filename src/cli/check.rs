//! `camgen check`: proves a DXF or STEP file, or a program for a milling machine, that may have been edited or written by another program.

use super::args::{CheckArgs, CheckTarget, CommonArgs, ReportFormat};
use super::cams::{balance_of, of_conoid, of_program};
use super::design::{self, Design};
use super::input_files::files;
use super::progress::Progress;
use super::{Failure, Outcome, print, print_painted, text};
use camgen::body::Request;
use camgen::body::conjugate::{COUNTER, MAIN_NAME};
use camgen::document::NamedChoice;
use camgen::domains::press::MachineOfPress;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::motion::equation_18::Solver;
use camgen::domains::press::wedge::LAW_TOLERANCE;
use camgen::machine::{Machine, UNITS_KEY};
use camgen::pipeline::{Cam, Error, ExpectedFile, FileKind, Spec};
use camgen::profile::outline::Fit;
use camgen::reading::LARGEST_FILE;
use camgen::report::{CUTTER_PATH_NOUN, FileVerdict, Report, Section, Speeds};
use camgen::units::LengthUnit;
use camgen::write::json;
use camgen::write::record::{self, RecordedRun};
use std::path::Path;

/// What is wrong with a cutter that changes nothing.
const IDLE_CUTTER: &str = "--cutter-radius and --cutter-diameter have no effect; leave them out";

pub(super) fn run(args: &CheckArgs) -> Result<Outcome, Failure> {
    let bytes = read(&args.file)?;
    let design = design(args, &bytes)?;
    let file = args.file.display().to_string();
    let accuracy = &args.common.accuracy;
    let (rates, strict) = accuracy.demanded();
    let as_recorded = accuracy.tolerance.is_none() && accuracy.accuracy.is_none();
    let tolerance = design.length("tolerance").filter(|_| as_recorded).unwrap_or(accuracy.tolerance());
    let fit = Fit { side: design.side().unwrap_or_default(), ..Fit::from(tolerance) };
    let request = Request { rates, strict, ..Request::within(fit) };
    let recorded_cutter = design.length("cutter-diameter").map(|diameter| 0.5 * diameter).or(design.length("cutter"));
    let expected = ExpectedFile {
        layer: args.layer.as_deref(),
        section: args.section.or_else(|| design.recorded.as_ref().and_then(|run| section_of(&args.file, run))),
        cut: None,
        cutter: args.given_cutter().or(recorded_cutter),
        cutter_is_recorded: args.given_cutter().is_none(),
    };
    let Design { spec, told, recorded, exact } = design;
    let in_units = |spec: Spec| match args.units.or_else(|| recorded_units(&args.file)) {
        Some(units) => spec.in_units(units),
        None => spec,
    };
    let spec = in_units(spec);
    let progress = Progress::of_stages(args.common.report.shows_progress());
    progress.stage("solving");
    let machine = spec.machine().clone();
    // A base radius that is chosen depends on the cutter.
    let idle_cutter = args.given_cutter().filter(|_| machine.cam.base_radius.is_some());
    if idle_cutter.is_some() && matches!(FileKind::of(&bytes), FileKind::Step) {
        return Err(Failure(format!("`{file}` is a solid, not the path of a cutter: {IDLE_CUTTER}")));
    }
    let cam = spec.solve().map_err(Failure::new)?;
    if let Some(run) = recorded.filter(|run| exact && !cam.is_made_from(&run.inputs)) {
        return Err(Failure(format!(
            "the record next to `{file}` does not contain the whole design of {}; give it: `camgen check {file} --design FILE`",
            run.stem
        )));
    }
    progress.stage("rolling on the file");
    let check = |cam: &Cam| cam.check_file(&bytes, &expected, request);
    let checked = match pair(&cam, machine) {
        Some([main, counter]) => of_pair(&args.file, [main, counter].map(in_units), check),
        None => check(&cam),
    };
    let mut report = checked.map_err(|error| match error {
        Error::Read(error) => Failure(format!("`{file}` is {error}")),
        Error::Section(why) => Failure(format!("{why} (--section RPM)")),
        Error::Cutter(why) => Failure(format!("{why} (--cutter-radius RADIUS or --cutter-diameter DIAMETER)")),
        other => Failure::new(other),
    })?;
    drop(progress);
    let is_outline = matches!(FileKind::of(&bytes), FileKind::Dxf) && !report.noun.starts_with(CUTTER_PATH_NOUN);
    if idle_cutter.is_some() && report.passed() && is_outline {
        return Err(Failure(format!(
            "`{file}` holds the outline of this cam itself, not the path of a cutter's centre: {IDLE_CUTTER}"
        )));
    }
    if args.given_cutter().is_some() && is_outline && report.passed() {
        report.notes.push(
            "the file holds the outline itself; the cutter only has an effect on the base radius that is chosen".into(),
        );
    }
    report.sections.push(Section::new("verdict", &FileVerdict::of(&report).key()));
    report.sections.insert(0, Section::new("file", &file));
    if let Some(told) = told {
        report.sections.insert(1, Section::new("design", &told).with_words(vec![told]));
    }
    if args.common.report.json || args.format == ReportFormat::Json {
        let json = json::write(&report).map_err(Failure::new)?;
        print(&String::from_utf8_lossy(&json))?;
    } else if !args.common.report.quiet {
        let page = args.common.report.page();
        let write = if args.common.report.verbose { text::check_report } else { text::check_summary };
        print_painted(&write(&file, &report, page))?;
    }
    Ok(if report.passed() { Outcome::Fine } else { Outcome::CheckFailed })
}

/// The unit in which the run wrote its files that the record next to a file has under the longest part of its name.
fn recorded_units(file: &Path) -> Option<LengthUnit> {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = file.file_name()?.to_str()?;
    let run = record::runs(folder)
        .into_iter()
        .filter(|run| name.strip_prefix(&*run.stem).is_some_and(|rest| rest.starts_with(['.', '-'])))
        .max_by_key(|run| run.stem.len())?;
    let given = run.inputs.iter().find(|input| input.key == UNITS_KEY);
    given.and_then(|input| LengthUnit::named(&input.value))
}

/// The speed that the name of a section's file ends with, in a run of several speeds.
fn section_of(file: &Path, run: &RecordedRun) -> Option<f64> {
    let several = run.inputs.iter().any(|input| input.key == "rpm" && input.value.contains(", "));
    let stem = file.file_stem()?.to_str()?;
    let rest = stem.strip_prefix(run.stem.as_str()).filter(|_| several)?;
    rest.strip_prefix('-')?.split_once("rpm")?.0.parse().ok()
}

/// Both discs of a pair of which a cam is one; `None` where it has no other disc.
fn pair(cam: &Cam, machine: Machine) -> Option<[Spec; 2]> {
    let rpm = if let Speeds::One(rpm) = cam.body().speeds() { Some(rpm) } else { None };
    let main = Spec::of_program(machine.clone(), rpm).filter(|_| machine.body() == COUNTER.keys)?;
    Some([main, Spec::made_with_program(machine, rpm, COUNTER.command)?])
}

/// The report on a file of a pair of discs: for the disc that its name gives, else for the one that it is or comes nearer to.
///
/// Both discs have one bore and one keyway: nothing stops a shop that cuts the same one twice.
fn of_pair(file: &Path, specs: [Spec; 2], check: impl Fn(&Cam) -> Result<Report, Error>) -> Result<Report, Error> {
    let [main, counter] = specs;
    let (main, counter) = (check(&main.solve()?)?, check(&counter.solve()?)?);
    let [off_main, off_counter] = [&main, &counter].map(|report| {
        let outline = report.checks.iter().find(|finding| finding.check == "outline");
        let value = outline.map_or(f64::NAN, |outline| outline.value);
        (!report.passed(), if value.is_nan() { f64::INFINITY } else { value })
    });
    let is_counter = named_disc(file).map_or(off_counter < off_main, |name| name == COUNTER.command);
    let (report, other) = if is_counter { (counter, main) } else { (main, counter) };
    let [name, found] = if is_counter { [COUNTER.command, MAIN_NAME] } else { [MAIN_NAME, COUNTER.command] };
    Ok(if other.passed() && !report.passed() {
        let words = format!("It is the {found} disc of this pair: the name of the file says {name}");
        let others = report.sections.into_iter().filter(|section| section.key != "diagnosis");
        let told = Section::new("diagnosis", &[&words]).with_words(vec![words.clone()]);
        Report { sections: others.chain([told]).collect(), ..report }
    } else {
        report
    })
}

/// The disc of a pair that the name of a file gives: the last of its words that is one of them.
fn named_disc(file: &Path) -> Option<&'static str> {
    let stem = file.file_stem()?.to_str()?;
    stem.rsplit(|letter: char| !letter.is_alphanumeric())
        .find_map(|word| [MAIN_NAME, COUNTER.command].into_iter().find(|disc| word.eq_ignore_ascii_case(disc)))
}

/// The design that is given, that of the file, or, where a flag belongs to a press, the embedded one.
fn design(args: &CheckArgs, bytes: &[u8]) -> Result<Design, Failure> {
    if args.common.machine.is_some() || args.design.is_some() || args.cam.is_some() {
        return spec(args).map(Design::given);
    }
    if let Some(found) = design::of_file(args, bytes)? {
        return Ok(found);
    }
    let CommonArgs { rpm, end, set, .. } = &args.common;
    let machine = args.common.machine_name();
    let of_press = !rpm.is_empty() || end.is_some() || !set.is_empty() || args.section.is_some();
    if !of_press {
        FileKind::readable(bytes).map_err(|error| Failure(format!("`{}` is {error}", args.file.display())))?;
        return Err(design::asked(&args.file, bytes));
    }
    let told = format!(
        "none was given or found: it is compared with the embedded machine {machine}, to which the flags belong"
    );
    Ok(Design { told: Some(told), ..Design::given(spec(args)?) })
}

impl CheckArgs {
    /// The radius of the cutter that the flags give, m.
    fn given_cutter(&self) -> Option<f64> {
        self.cutter_radius.or(self.cutter_diameter)
    }

    /// The machine of a file with the overrides and the given cutter: a size `auto` becomes the one that `make` chooses for this cutter.
    pub(super) fn machine_of(&self, name: &str) -> Result<(Machine, String), Failure> {
        let (mut machine, name) = self.common.machine_of(name)?;
        if let Some(radius) = self.given_cutter() {
            machine.ask_for_cutter(radius);
        }
        Ok((machine, name))
    }
}

/// The cam that the file should contain.
fn spec(args: &CheckArgs) -> Result<Spec, Failure> {
    if args.cam == Some(CheckTarget::Brake) {
        let machine = super::brake::with_disc(args.common.machine_name(), &args.common.set)?;
        if !args.common.rpm.is_empty() || args.common.end.is_some() {
            return Err(Failure(
                "--rpm and --end belong to the cams of a press: the disc of a brake has no speed".into(),
            ));
        }
        return super::brake::of_brake(&machine).map(|(spec, _)| spec);
    }
    if let Some(design) = &args.design {
        let (machine, _) = args.machine_of(design)?;
        return of_program(&args.common, (machine, design));
    }
    let (machine, _) = args.machine_of(args.common.machine_name())?;
    let of_a_program = machine.press().is_err() && machine.motion().is_some();
    match args.cam.unwrap_or(if of_a_program { CheckTarget::Make } else { CheckTarget::Rotary }) {
        CheckTarget::Make => of_program(&args.common, (machine, args.common.machine_name())),
        CheckTarget::Rotary => {
            let rpm = args.common.one_speed(&machine)?;
            Ok(Spec::rotary(machine, rpm))
        }
        CheckTarget::Compensator => {
            let rpm = args.common.one_speed(&machine)?;
            Ok(Spec::compensator(machine, rpm))
        }
        CheckTarget::Translating => {
            let (rpm, solver) = (args.common.one_speed(&machine)?, Solver::Ode { tolerance: LAW_TOLERANCE });
            let balance = balance_of(args.balance, &machine);
            Ok(Spec::translating(machine, rpm, solver, balance))
        }
        CheckTarget::Conoid => of_conoid(&args.common, machine, args.residual),
        CheckTarget::Brake => Err(Failure("the disc of a brake is read from a file with [brake]".into())),
    }
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    files().bytes_of(path, LARGEST_FILE).map_err(|why| Failure(format!("cannot read `{}`: {why}", path.display())))
}

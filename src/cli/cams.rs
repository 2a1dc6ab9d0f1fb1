//! The commands that make a cam: the arguments become a specification, which passes through the pipeline of the library.

use super::args::{
    AccuracyArgs, CommonArgs, ConoidArgs, CutterArgs, DiscArgs, FileArgs, OutlineArgs, OutputArgs, PointsArgs,
    ReportArgs, RotaryArgs, SolverKind, Speed, TranslatingArgs, gauge_follower,
};
use super::input_files::files;
use super::live::{self, LiveSource};
use super::progress::Progress;
use super::put::put_set;
use super::text::{Beside, TriedRemedy, Written};
use super::{Failure, Outcome, print, print_message, print_painted, refusal, text};
use camgen::body::{Gauge, Inspection, Milling, PointCurve, Points, Request};
use camgen::catalogue::catalogue;
use camgen::document::NamedChoice;
use camgen::domains::press::MachineOfPress;
use camgen::domains::press::SpecOfPress;
use camgen::domains::press::machine::exact_on;
use camgen::domains::press::motion::equation_18::{ExactOn, Solver};
use camgen::domains::press::wedge::LAW_TOLERANCE;
use camgen::geometry::lead_in::{LeadIn, LeadInForm};
use camgen::geometry::points::PointInterpolation;
use camgen::machine::Machine;
use camgen::pipeline::{AssemblyDrawing, Cam, FileSet, Judged, ProvenAssembly, Spec, Writing};
use camgen::profile::outline::Fit;
use camgen::report::{Fact, LazyReport, Summary, Topic};
use camgen::text::KeyChange;
use camgen::tool_files::{Format, gauge, gcode, inspection, points, requested, servo};
use camgen::units::{self, Dimension};
use camgen::write::json;
use camgen::write::step::LATEST;
use camgen::write::svg;

/// Stations of the paper's solver by default: its error is then a hundredth of a millimetre.
const STATIONS: u32 = 1800;
/// What is to be cut.
struct CutOrder {
    spec: Spec,
    request: Request,
    /// The machine in the names of files.
    name: String,
}

/// Makes the order of a machine file with overrides.
type Ordered<'a> = dyn Fn(&[String]) -> Result<CutOrder, Failure> + 'a;

pub(super) fn rotary(args: &RotaryArgs) -> Result<Outcome, Failure> {
    let keys = args.compensator.iter().map(|key| format!("compensator.{}", key.trim()));
    let DiscArgs { common, files, cutter } = &args.disc;
    let overrides: Vec<String> = common.set.iter().cloned().chain(keys).collect();
    let order = |overrides: &[String]| {
        let (machine, name) = common.machine_with(common.machine_name(), overrides)?;
        let mut machine = files.to.of_units(machine);
        let rpm = common.one_speed(&machine)?;
        let request = cutter.request(&mut machine, files.request(common)?);
        Ok(CutOrder { spec: Spec::rotary(machine, rpm), request, name })
    };
    cut(&order, overrides, common, files)
}

pub(super) fn translating(args: &TranslatingArgs) -> Result<Outcome, Failure> {
    let (common, files) = (&args.common, &args.files);
    let order = |overrides: &[String]| {
        let (machine, name) = common.machine_with(common.machine_name(), overrides)?;
        let machine = files.to.of_units(machine);
        let rpm = common.one_speed(&machine)?;
        let solver = match (args.solver, args.stations) {
            (SolverKind::Paper, stations) => Solver::Paper { stations: stations.unwrap_or(STATIONS) },
            (SolverKind::Ode, None) => Solver::Ode { tolerance: LAW_TOLERANCE },
            (SolverKind::Ode, Some(_)) => {
                let why = "--stations belongs to --solver paper; the solver ode chooses its own steps";
                return Err(Failure(why.into()));
            }
        };
        let spec = Spec::translating(machine.clone(), rpm, solver, balance_of(args.balance, &machine));
        Ok(CutOrder { spec, request: files.request(common)?, name })
    };
    cut(&order, common.set.clone(), common, files)
}

pub(super) fn conoid(args: &ConoidArgs) -> Result<Outcome, Failure> {
    let (common, files) = (&args.common, &args.files);
    let order = |overrides: &[String]| {
        let (machine, name) = common.machine_with(common.machine_name(), overrides)?;
        let spec = of_conoid(common, files.to.of_units(machine), args.residual)?;
        Ok(CutOrder { spec, request: files.request(common)?, name })
    };
    cut(&order, common.set.clone(), common, files)
}

/// The cam of a motion program.
pub(super) fn make(args: &DiscArgs) -> Result<Outcome, Failure> {
    let DiscArgs { common, files, cutter } = args;
    let Some(file) = &common.machine else { return Err(without_design()) };
    let order = |overrides: &[String]| {
        let (machine, name) = common.machine_with(file, overrides)?;
        if common.end.is_some() {
            let why = "--end belongs to the cams of a press: a motion program has no ends of a stroke";
            return Err(Failure(why.into()));
        }
        let mut machine = files.to.of_units(machine);
        let request = cutter.request(&mut machine, files.request(common)?);
        Ok(CutOrder { spec: of_program(common, (machine, file))?, request, name })
    };
    cut(&order, common.set.clone(), common, files)
}

/// What `make` can start from.
fn without_design() -> Failure {
    let designs = catalogue().embedded.iter().filter(|embedded| embedded.toml.contains("\n[motion]"));
    let listed: Vec<String> =
        designs.map(|embedded| format!("  {:<16} {}\n", embedded.name, embedded.title())).collect();
    let listed = listed.concat();
    Failure(format!(
        "`make` needs a file with a motion: camgen make FILE. Designs to start from:\n{listed}\
         `camgen make feeder` makes one of them, `camgen machines show feeder > my.toml` copies it, and `camgen init --follower roller my.toml` \
         writes a commented file"
    ))
}

/// The disc cam of the motion program of a file of this name.
pub(super) fn of_program(common: &CommonArgs, (machine, name): (Machine, &str)) -> Result<Spec, Failure> {
    let rpm = match common.rpm.as_slice() {
        [] => None,
        _ => Some(common.one_speed(&machine)?),
    };
    Spec::of_program(machine, rpm).ok_or_else(|| {
        let why = format!("{name} has no motion: `make` needs the tables [motion] and [[motion.segment]]");
        Failure(format!("{why}; the cams of a press are made by rotary, translating and conoid"))
    })
}

/// The conoid of a list of speeds, or of a range of them and the residual force between the sections.
pub(super) fn of_conoid(common: &CommonArgs, machine: Machine, residual: Option<f64>) -> Result<Spec, Failure> {
    if let [Speed::Range(from, to)] = common.rpm.as_slice() {
        let Some(limit) = residual else {
            let why = "a range of speeds needs --residual, the largest residual force between the sections, e.g. 2N";
            return Err(Failure(why.into()));
        };
        return Ok(Spec::conoid_within(machine, (*from, *to), limit));
    }
    let speeds = common.rpm.iter().map(|speed| match speed {
        Speed::One(rpm) => Ok(*rpm),
        Speed::Range(..) => Err(Failure("give one range A..B, or a list of speeds".into())),
    });
    let mut speeds: Vec<f64> = speeds.collect::<Result<_, _>>()?;
    if speeds.is_empty() {
        speeds.push(machine.press().map_err(Failure::new)?.design_rpm);
    }
    Ok(Spec::conoid(machine, speeds, residual))
}

impl CutterArgs {
    /// The request with the path of the cutter, which must then fit.
    fn request(&self, machine: &mut Machine, request: Request) -> Request {
        let cutter_radius = self.cutter_diameter.or(self.cutter_radius);
        if let Some(radius) = cutter_radius {
            machine.ask_for_cutter(radius);
        }
        Request { cutter_radius, ..request }
    }
}

impl PointsArgs {
    /// The requested table, if there is one.
    fn requested(&self, formats: Option<&[String]>) -> Result<Option<Points>, Failure> {
        if !formats.is_some_and(|formats| formats.iter().any(|format| format == points::FORMAT)) {
            let given = [
                self.points_of.is_some(),
                self.points_as.is_some(),
                self.points_step.is_some(),
                self.points_between.is_some(),
            ];
            if given.contains(&true) {
                return Err(Failure("the flags --points-… belong to --format points".into()));
            }
            return Ok(None);
        }
        Ok(Some(Points {
            curve: self.points_of.unwrap_or(PointCurve::Profile),
            form: self.points_as,
            step: self.points_step,
            between: self.points_between.unwrap_or(PointInterpolation::Linear),
        }))
    }
}

/// Rows of the table of a cam.
const USUAL_ROWS: u32 = 720;
/// Formats whose rows are as many as the tolerance, or the turn, needs, and those with rows by --samples.
const COUNTED_ELSEWHERE: [&str; 3] = [points::FORMAT, inspection::FORMAT, gauge::FORMAT];
const SAMPLED: [&str; 2] = ["csv", "html"];

/// Radius of the ball of a common probe, m.
const USUAL_BALL_RADIUS: f64 = 1.5e-3;

impl FileArgs {
    /// Refuses --samples where no format has rows by it and one has others.
    fn sampled(&self) -> Result<(), Failure> {
        let asked = |names: &[&str]| self.format.iter().flatten().any(|format| names.contains(&format.as_str()));
        let elsewhere = asked(&COUNTED_ELSEWHERE) || asked(&servo::NAMES);
        if self.samples.is_none() || !elsewhere || asked(&SAMPLED) {
            return Ok(());
        }
        Err(Failure(
            "--samples counts the rows of --format csv: points and tables for a servo drive have as many as --tolerance needs, inspect one for each \
             degree; leave --samples out, or add csv to the formats"
                .into(),
        ))
    }

    fn request(&self, common: &CommonArgs) -> Result<Request, Failure> {
        self.sampled()?;
        let points = self.points.requested(self.format.as_deref())?;
        let milled = self.format.iter().flatten().any(|format| format == gcode::FORMAT);
        if self.controller.is_some() && !milled {
            return Err(Failure("--controller belongs to --format gcode".into()));
        }
        let milling = milled.then_some(Milling { controller: self.controller });
        let formats = requested(self.format.as_deref().unwrap_or_default());
        let inspected = self.format.iter().flatten().any(|format| format == inspection::FORMAT);
        let gauged = self.format.iter().flatten().any(|format| format == gauge::FORMAT);
        if self.ball_diameter.is_some() && !inspected && !gauged {
            return Err(Failure("--ball-diameter belongs to --format inspect and gauge".into()));
        }
        if self.gauge.is_some() && !gauged {
            return Err(Failure("--gauge belongs to --format gauge".into()));
        }
        let ball_radius = self.ball_diameter.unwrap_or(USUAL_BALL_RADIUS);
        let inspection = inspected.then_some(Inspection { ball_radius });
        let asked = self
            .gauge
            .as_deref()
            .map(gauge_follower)
            .transpose()
            .map_err(Failure)?
            .unwrap_or(Gauge::Round(ball_radius));
        let gauge = gauged.then_some(asked);
        Ok(Request { points, milling, formats, inspection, gauge, ..self.outline.request(&common.accuracy)? })
    }
}

impl OutlineArgs {
    /// The tolerances of an outline, its start and the way there.
    pub(super) fn request(&self, accuracy: &AccuracyArgs) -> Result<Request, Failure> {
        let (rates, strict) = accuracy.rates();
        Ok(Request {
            rates,
            strict,
            start: self.start,
            lead_in: self.lead_in.as_deref().map(lead_in).transpose()?,
            ..Request::within(Fit { side: self.side, laid: self.outline, ..Fit::from(accuracy.tolerance()) })
        })
    }
}

/// Largest size of a lead-in, m.
const LARGEST_LEAD_IN: f64 = 1.0;

/// The lead-in of the two words of its flag.
fn lead_in(words: &[String]) -> Result<LeadIn, Failure> {
    let (form, size) = (words.first().map_or("", String::as_str), words.get(1).map_or("5mm", String::as_str));
    let fault = |why: String| {
        Failure(format!("--lead-in {form} {size}: {why}; write --lead-in tangent 5mm or --lead-in arc 5mm"))
    };
    let known = LeadInForm::ALL.iter().find(|(name, _)| name.eq_ignore_ascii_case(form));
    let (_, form) = known.ok_or_else(|| fault("the form is tangent or arc".into()))?;
    let quantity = units::parse(size, Dimension::Length).map_err(|error| fault(error.to_string()))?;
    if !(quantity.si > 0.0 && quantity.si <= LARGEST_LEAD_IN) {
        return Err(fault(format!("the size must be above 0 and at most {}", quantity.in_same_unit(LARGEST_LEAD_IN))));
    }
    Ok(LeadIn { form: *form, size: quantity.si })
}

impl OutputArgs {
    /// The machine with the unit of the flag, where it is given.
    pub(super) fn of_units(&self, machine: Machine) -> Machine {
        match self.units {
            Some(units) => machine.in_units(units),
            None => machine,
        }
    }

    /// What was judged, in the unit of the flag, where it is given.
    pub(super) fn judged(&self, judged: Judged) -> Judged {
        match self.units {
            Some(units) => judged.in_units(units),
            None => judged,
        }
    }

    /// The template of the sheet.
    pub(super) fn template(&self) -> Result<String, Failure> {
        match &self.template {
            None => Ok(svg::TEMPLATE.to_owned()),
            Some(path) => files()
                .text_of(path, LARGEST_TEMPLATE)
                .map_err(|error| Failure(format!("cannot read the template `{}`: {error}", path.display()))),
        }
    }
}

/// Largest template, bytes.
const LARGEST_TEMPLATE: u64 = 1 << 20;

/// The start of the names of the files.
fn stem(args: &CommonArgs, files: &FileArgs, cam: &Cam, machine: &str) -> String {
    let range = if let [Speed::Range(from, to)] = args.rpm.as_slice() { Some([*from, *to]) } else { None };
    files.to.name.clone().unwrap_or_else(|| cam.stem(machine, range))
}

/// The time to write into files, from the environment variable `SOURCE_DATE_EPOCH`: seconds since 1970, UTC. Without it no time is
/// written, so that the same input gives the same bytes.
pub(super) fn source_date() -> Result<Option<u64>, Failure> {
    let Some(text) = std::env::var_os("SOURCE_DATE_EPOCH").filter(|text| !text.is_empty()) else { return Ok(None) };
    match text.to_str().and_then(|text| text.parse().ok()).filter(|seconds| *seconds <= LATEST) {
        Some(seconds) => Ok(Some(seconds)),
        None => Err(Failure(format!(
            "SOURCE_DATE_EPOCH is `{}`: it must be a whole number of seconds since 1970, at most {LATEST}",
            text.display()
        ))),
    }
}

/// Solves, draws, proves, writes and reports.
fn cut(order: &Ordered<'_>, overrides: Vec<String>, common: &CommonArgs, files: &FileArgs) -> Result<Outcome, Failure> {
    let CutOrder { spec, request, name } = order(&overrides)?;
    let source = LiveSource { machine: common.machine_name(), overrides };
    if files.live {
        files.live_fits(common, &request)?;
    }
    let template = files.to.template()?;
    let progress = Progress::of_stages(common.report.shows_progress());
    progress.stage("solving");
    let cams = spec.assemble().map_err(Failure::new)?;
    let cam = cams.first();
    let stem = stem(common, files, cam, &name);
    // A name that was given stays; the usual one follows command and speed.
    let named = files.to.name.as_ref().map(|_| stem.as_str());
    let live =
        if files.live { Some(live::design(&source, (common, cam, named), request.fit.tolerance)?) } else { None };
    let writing = Writing {
        directory: files.to.out.clone(),
        stem,
        live,
        formats: files.format.clone(),
        samples: files.samples.unwrap_or(USUAL_ROWS),
        template,
        created: source_date()?,
        force: files.to.force,
        overwrite: files.to.overwrite,
    };
    let (formats, left_out) = writing.chosen(cam.body()).map_err(Failure::new)?;
    // The flank of a three-dimensional cam is drawn, and proved, only for a format that shows it.
    let request = Request { flank: formats.iter().any(Format::shows_flank), ..request };
    progress.stage("drawing");
    let drawing = cams.draw(request).map_err(Failure::new)?;
    progress.stage("proving");
    let proven = drawing.prove_as(files.outline.dxf_version).map_err(Failure::new)?;
    let remedy = if common.report.is_summary() && !proven.passed() {
        progress.stage("looking for a remedy");
        remedy(&proven, order, &source.overrides)
    } else {
        None
    };
    progress.stage("writing");
    let files = files_of(&proven, &writing, common, &left_out);
    drop(progress);
    match files? {
        Some(files) => put_set(files, |report| show_with(report, &common.report, remedy.as_ref()))?,
        None => show_with(&proven.lazy_report(), &common.report, remedy.as_ref())?,
    }
    Ok(if proven.passed() { Outcome::Fine } else { Outcome::CheckFailed })
}

/// Facts that a remedy may alter at a cost.
const COSTS: [Topic; 3] = [Topic::SIZE, Topic::FORCE, Topic::TORQUE];

/// A change of the machine file that passes every check, with what it costs.
fn remedy(proven: &ProvenAssembly, order: &Ordered<'_>, overrides: &[String]) -> Option<TriedRemedy> {
    let remake = |changes: &[KeyChange]| {
        let changed = changes.iter().map(|change| format!("{}={}", change.key, change.value));
        let overrides: Vec<String> = overrides.iter().cloned().chain(changed).collect();
        let CutOrder { spec, request, .. } = order(&overrides).ok()?;
        spec.assemble().and_then(|cams| cams.draw(request)).and_then(AssemblyDrawing::prove).ok()
    };
    let found = proven.remedy(&remake)?;
    let (before, after) = (proven.report(), found.cams.report());
    let (before, after) = (Summary::of(&before), Summary::of(&after));
    let is_cost = |fact: &&Fact| COSTS.contains(&fact.topic) && !before.facts.contains(fact);
    let inputs = proven.first().body().machine().inputs(proven.first().body().kind().keys);
    let now = |key: &str| inputs.iter().find(|input| input.key == key).map(|input| input.typed.clone());
    Some(TriedRemedy {
        changes: found.changes.iter().map(|change| (change.clone(), now(&change.key))).collect(),
        judged: after.judged,
        costs: after.facts.iter().filter(is_cost).cloned().collect(),
    })
}

/// The checks that another disc fails: the report is that of the first.
fn failures_of_others(proven: &ProvenAssembly) {
    let units = proven.first().body().machine().units();
    for (name, failed) in proven.failures_of_others() {
        for finding in failed {
            let limit = finding.limit_words(units).map_or_else(String::new, |limit| format!(", {limit}"));
            let note = finding.note.as_ref().map_or_else(String::new, |note| format!("; {}", note.in_unit(units)));
            let (check, value) = (&finding.check, finding.shown_value(units));
            let place = finding.place.text().in_unit(units);
            print_message(&format!("the {name} disc fails {check}: {value}{limit}, at {place}{note}"));
        }
    }
}

/// The files of a cam that passed or is forced, unless it is a dry run.
fn files_of(
    proven: &ProvenAssembly,
    writing: &Writing,
    common: &CommonArgs,
    left_out: &[(&str, &str)],
) -> Result<Option<FileSet>, Failure> {
    if let Some(why) = proven.no_outline() {
        print_message(&format!("refused: {why}; there is no outline to write, and --force cannot help"));
        return Ok(None);
    }
    if !proven.passed() && !writing.force {
        if !common.report.is_summary() {
            print_message(refusal(common.report.dry_run));
        }
        failures_of_others(proven);
        return Ok(None);
    }
    for (format, why) in left_out {
        print_message(&format!("no {} file: {why}", format.to_uppercase()));
    }
    let made = proven.files(writing).map_err(Failure::new)?;
    Ok((!common.report.dry_run).then_some(made))
}

/// Prints a report as the arguments say.
pub(super) fn show(report: &LazyReport, args: &ReportArgs) -> Result<(), Failure> {
    show_with(report, args, None)
}

/// Prints a report as the arguments say, with a remedy that was tried.
fn show_with(report: &LazyReport, args: &ReportArgs, remedy: Option<&TriedRemedy>) -> Result<(), Failure> {
    if args.json {
        let bytes = json::write(&**report).map_err(Failure::new)?;
        print(&String::from_utf8_lossy(&bytes))
    } else if args.quiet {
        Ok(())
    } else if args.verbose {
        print_painted(&text::report(report, args.page()))
    } else {
        let written = if args.dry_run { Written::DryRun } else { Written::Listed };
        print_painted(&text::summary(report, Beside { written, remedy }, args.page()))
    }
}

/// The direction of the bed in which the forces of a plate balance: that of a flag, else of the file.
pub(super) fn balance_of(given: Option<ExactOn>, machine: &Machine) -> ExactOn {
    given.unwrap_or_else(|| exact_on(machine))
}

//! The commands that make a cam: what was typed becomes a specification, which walks the pipeline of the library.

use super::args::{
    AccuracyArgs, CommonArgs, ConoidArgs, CutterArgs, DiscArgs, EndOf, FileArgs, LaidArgs, LaidOf, OutArgs, PointsArgs,
    PointsAs, PointsBetween, PointsOf, PointsStep, RotaryArgs, SideOf, SolverKind, Speed, ToldArgs, TranslatingArgs,
};
use super::progress::Progress;
use super::put::put_set;
use super::{Failure, Outcome, print, print_painted, tell, text};
use camgen::body::Request;
use camgen::body::points::{Given, Points};
use camgen::body::wedge::LAW_TOLERANCE;
use camgen::document::file::text_of;
use camgen::geometry::points::{Between, Form, Step};
use camgen::machine::Machine;
use camgen::motion::equation_18::Solver;
use camgen::pipeline::{Cam, FileSet, Proven, Spec, Writing};
use camgen::profile::outline::{Fit, Laid, Side};
use camgen::report::{Speeds, Told};
use camgen::write::json;
use camgen::write::number::names;
use camgen::write::points;
use camgen::write::step::LATEST;
use camgen::write::svg;

/// Stations of the paper's solver by default: its error is then a hundredth of a millimetre.
const STATIONS: u32 = 1800;
/// More speeds than these are named by the first and the last.
const MOST_NAMED: usize = 6;

pub(super) fn rotary(args: &RotaryArgs) -> Result<Outcome, Failure> {
    let keys = args.compensator.iter().map(|key| format!("compensator.{}", key.trim()));
    let args = &args.disc;
    let overrides: Vec<String> = args.common.set.iter().cloned().chain(keys).collect();
    let loaded = Machine::load(&args.common.machine, &overrides).map_err(Failure::new)?;
    let (mut machine, name) = EndOf::of(args.common.end, loaded)?;
    let rpm = args.common.one_speed(&machine)?;
    let request = args.cutter.request(&mut machine, args.files.request(&args.common)?);
    cut(Spec::rotary(machine, rpm), request, &args.common, &args.files, &name)
}

pub(super) fn translating(args: &TranslatingArgs) -> Result<Outcome, Failure> {
    let (machine, name) = args.common.machine()?;
    let rpm = args.common.one_speed(&machine)?;
    let solver = match (args.solver, args.stations) {
        (SolverKind::Paper, stations) => Solver::Paper { stations: stations.unwrap_or(STATIONS) },
        (SolverKind::Ode, None) => Solver::Ode { tolerance: LAW_TOLERANCE },
        (SolverKind::Ode, Some(_)) => {
            return Err(Failure("--stations belongs to --solver paper; the solver ode chooses its own steps".into()));
        }
    };
    let spec = Spec::translating(machine, rpm, solver, args.balance.exact_on());
    cut(spec, args.files.request(&args.common)?, &args.common, &args.files, &name)
}

pub(super) fn conoid(args: &ConoidArgs) -> Result<Outcome, Failure> {
    let (machine, name) = args.common.machine()?;
    let spec = of_conoid(&args.common, machine, args.residual)?;
    cut(spec, args.files.request(&args.common)?, &args.common, &args.files, &name)
}

/// The cam of a motion program.
pub(super) fn make(args: &DiscArgs) -> Result<Outcome, Failure> {
    let (mut machine, name) = args.common.machine()?;
    if args.common.end.is_some() {
        return Err(Failure("--end belongs to the cams of a press: a motion program has no ends of a stroke".into()));
    }
    let request = args.cutter.request(&mut machine, args.files.request(&args.common)?);
    let spec = of_program(&args.common, (machine, &args.common.machine))?;
    cut(spec, request, &args.common, &args.files, &name)
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
    let one = |speed: &Speed| match speed {
        Speed::One(rpm) => Ok(*rpm),
        Speed::Range(..) => Err(Failure("give one range A..B, or a list of speeds".into())),
    };
    let mut speeds: Vec<f64> = common.rpm.iter().map(one).collect::<Result<_, _>>()?;
    if speeds.is_empty() {
        speeds.push(machine.press().map_err(Failure::new)?.design_rpm);
    }
    Ok(Spec::conoid(machine, speeds, residual))
}

impl CutterArgs {
    /// The request with the path of the cutter, which then has to fit.
    fn request(&self, machine: &mut Machine, request: Request) -> Request {
        if let Some(radius) = self.cutter {
            machine.ask_for_cutter(radius);
        }
        Request { cutter: self.cutter, ..request }
    }
}

impl PointsArgs {
    /// The table that was asked for, if one was.
    fn asked(&self, formats: Option<&[String]>) -> Result<Option<Points>, Failure> {
        if !formats.is_some_and(|formats| formats.iter().any(|format| format == points::FORMAT.name)) {
            let told = [
                self.points_of.is_some(),
                self.points_as.is_some(),
                self.points_step.is_some(),
                self.points_between.is_some(),
            ];
            if told.contains(&true) {
                return Err(Failure("the flags --points-… belong to --format points".into()));
            }
            return Ok(None);
        }
        Ok(Some(Points {
            given: match self.points_of {
                None | Some(PointsOf::Profile) => Given::Profile,
                Some(PointsOf::Centre) => Given::Centre,
                Some(PointsOf::Cutter) => Given::Cutter,
            },
            form: self.points_as.map(|form| match form {
                PointsAs::Polar => Form::Polar,
                PointsAs::Xy => Form::Plane,
            }),
            step: self.points_step.map(|step| match step {
                PointsStep::Angle => Step::Angle,
                PointsStep::Chord => Step::Chord,
            }),
            between: match self.points_between {
                None | Some(PointsBetween::Linear) => Between::Linear,
                Some(PointsBetween::Cubic) => Between::Cubic,
            },
        }))
    }
}

impl FileArgs {
    fn request(&self, common: &CommonArgs) -> Result<Request, Failure> {
        let points = self.points.asked(self.format.as_deref())?;
        Ok(Request { points, ..self.laid.request(&common.accuracy) })
    }
}

impl LaidArgs {
    /// What an outline must keep.
    pub(super) fn request(&self, accuracy: &AccuracyArgs) -> Request {
        let side = match self.side {
            SideOf::Both => Side::Both,
            SideOf::Inside => Side::Inside,
            SideOf::Outside => Side::Outside,
        };
        let laid = match self.outline {
            LaidOf::Arcs => Laid::Arcs,
            LaidOf::Spline => Laid::Splines,
        };
        let (rates, strict) = accuracy.rates();
        Request { rates, strict, ..Request::within(Fit { side, laid, ..Fit::from(accuracy.tolerance()) }) }
    }
}

impl OutArgs {
    /// The template of the sheet.
    pub(super) fn template(&self) -> Result<String, Failure> {
        match &self.template {
            None => Ok(svg::TEMPLATE.to_owned()),
            Some(path) => text_of(path, LARGEST_TEMPLATE)
                .map_err(|error| Failure(format!("cannot read the template `{}`: {error}", path.display()))),
        }
    }
}

/// Largest template, bytes.
const LARGEST_TEMPLATE: u64 = 1 << 20;

/// What the names of the files begin with.
fn stem(args: &CommonArgs, files: &FileArgs, cam: &Cam, machine: &str) -> String {
    let command = cam.body().kind().command;
    let speeds = match cam.body().speeds() {
        Speeds::Any(()) => return files.to.name.clone().unwrap_or_else(|| format!("{machine}-{command}")),
        Speeds::One(rpm) => names(&[rpm]).concat(),
        Speeds::Several(speeds) => {
            let sections = names(&speeds);
            match (args.rpm.as_slice(), sections.as_slice()) {
                ([Speed::Range(from, to)], _) => names(&[*from, *to]).join("-"),
                (_, [first, .., last]) if sections.len() > MOST_NAMED => format!("{first}-{last}"),
                _ => sections.join("-"),
            }
        }
    };
    files.to.name.clone().unwrap_or_else(|| format!("{machine}-{command}-{speeds}rpm"))
}

/// The time that files are to bear, of the environment variable `SOURCE_DATE_EPOCH`: seconds since 1970, UTC. Without it they bear
/// none, so that the same input gives the same bytes.
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
fn cut(spec: Spec, request: Request, common: &CommonArgs, files: &FileArgs, machine: &str) -> Result<Outcome, Failure> {
    let template = files.to.template()?;
    let progress = Progress::of_stages(common.told.shows_progress());
    progress.stage("solving");
    let cam = spec.solve().map_err(Failure::new)?;
    let writing = Writing {
        directory: files.to.out.clone(),
        stem: stem(common, files, &cam, machine),
        formats: files.format.clone(),
        samples: files.samples,
        template,
        created: source_date()?,
        force: files.to.force,
        overwrite: files.to.overwrite,
    };
    let (formats, left_out) = writing.chosen(cam.body()).map_err(Failure::new)?;
    // The flank of a three-dimensional cam is drawn, and proved, only for a format that shows it.
    let request = Request { flank: formats.iter().any(|format| format.flank), ..request };
    progress.stage("drawing");
    let drawing = cam.draw(request).map_err(Failure::new)?;
    progress.stage("proving");
    let proven = drawing.prove_as(files.laid.dxf_version).map_err(Failure::new)?;
    progress.stage("writing");
    let files = files_of(&proven, &writing, common, &left_out);
    drop(progress);
    match files? {
        Some(files) => put_set(files, |report| show(report, &common.told))?,
        None => show(&proven.told(), &common.told)?,
    }
    Ok(if proven.passed() { Outcome::Fine } else { Outcome::CheckFailed })
}

/// The files of a cam that passed, or is forced, and are to be written.
fn files_of<'p>(
    proven: &'p Proven<'_>,
    writing: &Writing,
    common: &CommonArgs,
    left_out: &[(&str, &str)],
) -> Result<Option<FileSet<'p>>, Failure> {
    if let Some(why) = proven.no_outline() {
        tell(&format!("refused: {why}; there is no outline to write, and --force cannot help"));
        return Ok(None);
    }
    if !proven.passed() && !writing.force {
        tell("refused: a check failed, nothing was written (--force writes nevertheless; camgen explain CHECK)");
        return Ok(None);
    }
    for (format, why) in left_out {
        tell(&format!("no {} file: {why}", format.to_uppercase()));
    }
    let made = proven.files(writing).map_err(Failure::new)?;
    Ok((!common.told.dry_run).then_some(made))
}

/// Prints a report as it was asked for.
pub(super) fn show(report: &Told<'_>, told: &ToldArgs) -> Result<(), Failure> {
    if told.json {
        let bytes = json::write(&**report).map_err(Failure::new)?;
        print(&String::from_utf8_lossy(&bytes))
    } else if told.quiet {
        Ok(())
    } else {
        print_painted(&text::report(report, told.page()))
    }
}

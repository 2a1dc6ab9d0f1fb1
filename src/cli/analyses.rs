//! The commands that analyse a machine and cut nothing.

use super::args::{
    AnalysisArgs, BrakeArgs, DriveArgs, DriveSolver, EndOf, FrameOf, FreeOf, GoalOf, LawsArgs, LinkageArgs, Order,
    RegimesArgs, ResetOf, ShaftArgs, ShaftSolver, SizeArgs, SpringArgs, WhirlOf,
};
use super::cams::{show, source_date};
use super::progress::Progress;
use super::put::put_set;
use super::{Failure, Outcome, print, tell};
use camgen::analysis::linkage::Goal;
use camgen::analysis::shaft::{Asked, Solver};
use camgen::analysis::{Analysis, brake, drive, laws, linkage, regimes, shaft, size, spring};
use camgen::buffer::regime::Reset;
use camgen::machine::{BrakeMachine, DriveMachine, Machine, ShaftMachine, Wanted};
use camgen::motion::BrakeDisc;
use camgen::pipeline::{Judged, Spec, Writing};
use camgen::report::{Speeds, Told};
use camgen::shaft::Whirl;
use camgen::write::number::names;
use std::sync::Arc;

/// Stations of the paper's shaft, and steps of a sweep, by default.
const STATIONS: usize = 18;
const STEPS: u32 = 10;

/// The speeds of a press that are looked at by default, in sevenths of its design speed: 20, 25, 30 and 35 rpm of the paper's.
const SEVENTHS: [f64; 4] = [4.0, 5.0, 6.0, 7.0];

pub(super) fn regimes(args: &RegimesArgs) -> Result<Outcome, Failure> {
    let (machine, name) = EndOf::of(args.end, args.analysis.machine(&args.machine)?)?;
    let design = machine.press().map_err(Failure::new)?.design_rpm;
    let of_file = machine.regimes();
    let given = if args.rpm.is_empty() { &of_file.speeds } else { &args.rpm };
    let speeds = match given.as_slice() {
        [] => SEVENTHS.map(|sevenths| design * sevenths / 7.0).to_vec(),
        given => given.to_vec(),
    };
    let reset = match args.reset {
        None => of_file.reset.unwrap_or(Reset::End),
        Some(ResetOf::End) => Reset::End,
        Some(ResetOf::Half) => Reset::Half,
        Some(ResetOf::Level) => Reset::Level,
    };
    let analysis = regimes::analysis(&machine, args.cut_for.unwrap_or(design), &speeds, reset).map_err(Failure::new)?;
    written(analysis, &args.analysis, &name)
}

pub(super) fn spring(args: &SpringArgs) -> Result<Outcome, Failure> {
    let (machine, name) = args.analysis.machine(&args.machine)?;
    let of_file: Vec<f64> = machine.spring_stiffness().filter(|_| args.residual.is_none()).into_iter().collect();
    let stiffnesses = if args.stiffness.is_empty() { &of_file } else { &args.stiffness };
    let analysis = spring::analysis(&machine, &args.rpm, stiffnesses, args.residual).map_err(Failure::new)?;
    written(analysis, &args.analysis, &name)
}

pub(super) fn drive(args: &DriveArgs) -> Result<Outcome, Failure> {
    let (machine, name) = DriveMachine::load(&args.machine, &args.analysis.set).map_err(Failure::new)?;
    let solver = match args.solver {
        DriveSolver::Energy => drive::Solver::Energy,
        DriveSolver::Paper => drive::Solver::Paper,
    };
    written(drive::analysis(&machine, solver, args.step).map_err(Failure::new)?, &args.analysis, &name)
}

pub(super) fn linkage(args: &LinkageArgs) -> Result<Outcome, Failure> {
    let (machine, name) = args.analysis.machine(&args.machine)?;
    let rpm = args.rpm.or(machine.design_rpm()).unwrap_or(f64::NAN);
    let (keep, power) = (args.keep.is_some(), args.power_limit);
    let goal = match args.synthesize {
        Some(GoalOf::Least) => Some(Goal::Least { symmetric: keep, power }),
        _ if keep || power.is_some() => {
            return Err(Failure("--keep and --power-limit belong to --synthesize least".into()));
        }
        Some(GoalOf::Equal) => Some(Goal::Equal),
        Some(GoalOf::Symmetric) => Some(Goal::Symmetric),
        None => None,
    };
    written(linkage::analysis(&machine, rpm, goal).map_err(Failure::new)?, &args.analysis, &name)
}

pub(super) fn shaft(args: &ShaftArgs) -> Result<Outcome, Failure> {
    let (machine, name) = ShaftMachine::load(&args.machine, &args.analysis.set).map_err(Failure::new)?;
    let order = match args.order {
        Order::Auto => None,
        Order::Of(order) => Some(order),
    };
    let solver = match (args.solver, args.stations) {
        (ShaftSolver::Exact, Some(_)) => {
            return Err(Failure("--stations belongs to --solver paper; the exact solver has --order".into()));
        }
        (ShaftSolver::Paper, _) if order.is_some() => {
            return Err(Failure("--order belongs to --solver exact; the paper's solver has --stations".into()));
        }
        (ShaftSolver::Exact, None) => Solver::Exact { order },
        (ShaftSolver::Paper, stations) => {
            let stations = stations.map_or(STATIONS, |stations| usize::try_from(stations).unwrap_or(usize::MAX));
            Solver::Paper { stations }
        }
    };
    let asked = Asked {
        rpm: args.rpm.clone(),
        modes: args.modes.map(usize::from),
        whirl: match args.whirl {
            WhirlOf::Forward => Whirl::Forward,
            WhirlOf::Planar => Whirl::Planar,
            WhirlOf::Backward => Whirl::Backward,
        },
        solver,
        sweep: args.sweep,
        steps: args.steps.unwrap_or(STEPS),
        samples: args.samples,
    };
    written(shaft::analysis(&machine, &asked).map_err(Failure::new)?, &args.analysis, &name)
}

pub(super) fn size(args: &SizeArgs) -> Result<Outcome, Failure> {
    let (machine, name) = args.analysis.machine(&args.machine)?;
    let free: Vec<size::Free> = args
        .free
        .iter()
        .map(|free| match free {
            FreeOf::Offset => size::Free::Offset,
            FreeOf::PivotDistance => size::Free::Pivot,
        })
        .collect();
    written(size::analysis(&machine, &free, args.rpm).map_err(Failure::new)?, &args.analysis, &name)
}

pub(super) fn laws(args: &LawsArgs) -> Result<Outcome, Failure> {
    let (machine, name) = match &args.machine {
        Some(machine) => args.analysis.machine(machine).map(|(machine, name)| (Some(machine), name))?,
        None if args.analysis.set.is_empty() => (None, "laws".to_owned()),
        None => return Err(Failure("--set overrides keys of a file: give one".into())),
    };
    let asked = laws::Asked { lift: args.lift, over: args.over, rpm: args.rpm, sort: args.sort.clone() };
    let analysis = laws::analysis(machine.as_ref(), &asked).map_err(Failure::new)?;
    if args.csv == args.svg {
        return written(analysis, &args.analysis, &name);
    }
    // Files as ever, but one of them in place of the report.
    let (format, ending) = if args.csv { ("csv", ".csv") } else { ("svg", ".svg") };
    let judged = Judged::new(analysis);
    let writing = writing(&judged, &args.analysis, &name)?;
    let shown = judged.files(&Writing { formats: Some(vec![format.to_owned()]), ..writing.clone() });
    let shown = shown.map_err(Failure::new)?;
    let files = (!args.analysis.told.dry_run).then(|| judged.files(&writing)).transpose().map_err(Failure::new)?;
    let bytes =
        shown.outputs().iter().find(|output| output.name.ends_with(ending)).map(|output| output.bytes.as_slice());
    let text = String::from_utf8_lossy(bytes.unwrap_or_default());
    match files {
        Some(files) => put_set(files, |_| print(&text))?,
        None => print(&text)?,
    }
    Ok(Outcome::Fine)
}

/// The disc of a brake that was read with it, and its motion.
pub(super) fn of_brake(machine: &BrakeMachine) -> Result<(Spec, Arc<BrakeDisc>), Failure> {
    let disc = Arc::new(machine.brake_disc().map_err(Failure::new)?);
    let spec = Spec::of_brake(machine, Arc::clone(&disc));
    spec.map(|spec| (spec, disc)).ok_or_else(|| Failure("the file describes no disc on the shaft of the frame".into()))
}

pub(super) fn brake(args: &BrakeArgs) -> Result<Outcome, Failure> {
    let wanted = match (args.cam, args.synthesize) {
        (true, _) => Wanted::Disc,
        (false, Some(_)) => Wanted::Frame,
        (false, None) => Wanted::Figures,
    };
    let (machine, name) = BrakeMachine::load(&args.machine, &args.analysis.set, wanted).map_err(Failure::new)?;
    let asked = brake::Asked {
        steps: args.samples,
        goal: args.synthesize.map(|goal| match goal {
            FrameOf::Level => brake::Goal::Level,
            FrameOf::Robust => brake::Goal::Robust,
        }),
        seed: args.seed,
    };
    if !args.cam {
        return written(brake::analysis(&machine, &asked, None).map_err(Failure::new)?, &args.analysis, &name);
    }
    let progress = Progress::of_stages(args.analysis.told.shows_progress());
    progress.stage("solving");
    let (spec, disc) = of_brake(&machine)?;
    let cam = spec.solve().map_err(Failure::new)?;
    progress.stage("drawing");
    let drawing = cam.draw(args.laid.request(&args.accuracy)).map_err(Failure::new)?;
    progress.stage("proving");
    let proven = drawing.prove_as(args.laid.dxf_version).map_err(Failure::new)?;
    drop(progress);
    let held = brake::Held { disc: &disc, as_cut: proven.rolled().and_then(|rolled| rolled.tension.as_ref()) };
    let analysis = brake::analysis(&machine, &asked, Some(&held)).map_err(Failure::new)?;
    judged(&Judged::new(analysis).with_cam(proven), &args.analysis, &name)
}

impl AnalysisArgs {
    fn machine(&self, name: &str) -> Result<(Machine, String), Failure> {
        Machine::load(name, &self.set).map_err(Failure::new)
    }
}

/// Judges, writes and reports.
fn written(analysis: Analysis, args: &AnalysisArgs, machine: &str) -> Result<Outcome, Failure> {
    judged(&Judged::new(analysis), args, machine)
}

/// What is written of a judged analysis, and where.
fn writing(judged: &Judged<'_>, args: &AnalysisArgs, machine: &str) -> Result<Writing, Failure> {
    let analysis = judged.analysis();
    let command = analysis.kind.command;
    let speeds = match &analysis.speeds {
        Speeds::Any(()) => String::new(),
        Speeds::One(rpm) => format!("-{}rpm", names(&[*rpm]).concat()),
        Speeds::Several(speeds) => format!("-{}rpm", names(speeds).join("-")),
    };
    Ok(Writing {
        formats: args.format.clone(),
        template: args.to.template()?,
        force: args.to.force,
        overwrite: args.to.overwrite,
        created: source_date()?,
        ..Writing::to(&args.to.out, args.to.name.clone().unwrap_or_else(|| format!("{machine}-{command}{speeds}")))
    })
}

/// Writes and reports what was judged.
fn judged(judged: &Judged<'_>, args: &AnalysisArgs, machine: &str) -> Result<Outcome, Failure> {
    let writing = writing(judged, args, machine)?;
    let files = if let Some(why) = judged.no_outline() {
        tell(&format!("refused: {why}; there is no outline to write, and --force cannot help"));
        None
    } else if judged.passed() || writing.force {
        Some(judged.files(&writing).map_err(Failure::new)?).filter(|_| !args.told.dry_run)
    } else {
        tell("refused: a check failed, nothing was written (--force writes nevertheless; camgen explain CHECK)");
        None
    };
    match files {
        Some(files) => put_set(files, |report| show(report, &args.told))?,
        None => show(&Told::new(Box::new(|| judged.report())), &args.told)?,
    }
    Ok(if judged.passed() { Outcome::Fine } else { Outcome::CheckFailed })
}

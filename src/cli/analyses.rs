//! The commands that analyse a machine and cut nothing.

use super::args::{
    AnalysisArgs, CompareArgs, DriveArgs, LawsArgs, RegimesArgs, ReportArgs, ScatterArgs, SizeArgs, SpringArgs, at_end,
    machine_of_a_cam, machine_with_free,
};
use super::args::{LinkageArgs, LinkageGoal};
use super::args::{Order, ShaftArgs, ShaftSolver};
use super::cams::{show, source_date};
use super::input_files::{self, files, made_of};
use super::put::put_set;
use super::{Failure, Outcome, print, print_message, refusal};
use camgen::analysis::compare::{self as comparison, ComparisonOptions, measured};
use camgen::analysis::{Analysis, laws, size};
use camgen::domains::linkage::analysis::{self as linkage, DragLinkGoal};
use camgen::domains::press::MachineOfPress;
use camgen::domains::press::analysis::{drive, plain, regimes, spring};
use camgen::domains::press::buffer::regime::Reset;
use camgen::domains::press::buffer::spring_body::SpringShape;
use camgen::domains::press::machine::{DriveMachine, PressCams};
use camgen::domains::press::scatter::analysis as scatter_analysis;
use camgen::domains::press::scatter::monte_carlo::Sampling;
use camgen::domains::shaft::analysis::{self as shaft, CriticalSpeedSolver, ShaftOptions};
use camgen::domains::shaft::machine::ShaftMachine;
use camgen::machine::Machine;
use camgen::pipeline::{Judged, Spec, Writing};

/// Stations of the paper's shaft, and steps of a sweep, by default.
const STATIONS: usize = 18;
const STEPS: u32 = 10;

/// The default speeds for a press, in sevenths of its design speed: 20, 25, 30 and 35 rpm for that of the paper.
const SEVENTHS: [f64; 4] = [4.0, 5.0, 6.0, 7.0];

/// An analysis, and the name of its machine in the names of its files.
type NamedAnalysis = (Analysis, String);

pub(super) fn regimes(args: &RegimesArgs) -> Result<Outcome, Failure> {
    judge_and_write(regimes_of(args, args.analysis.machine(&args.machine)?)?, &args.analysis)
}

/// The regimes of a loaded machine.
pub(crate) fn regimes_of(args: &RegimesArgs, loaded: (Machine, String)) -> Result<NamedAnalysis, Failure> {
    let (machine, name) = at_end(args.end, loaded)?;
    let design = machine.press().map_err(Failure::new)?.design_rpm;
    let of_file = &PressCams::of(&machine).regimes;
    let given = if args.rpm.is_empty() { &of_file.speeds } else { &args.rpm };
    let speeds = match given.as_slice() {
        [] => SEVENTHS.map(|sevenths| design * sevenths / 7.0).to_vec(),
        given => given.to_vec(),
    };
    let reset = args.reset.or(of_file.reset).unwrap_or(Reset::End);
    if args.without_cam {
        return Ok((plain::analysis(&machine, &speeds, reset).map_err(Failure::new)?, name));
    }
    let analysis = regimes::analysis(&machine, args.cut_for.unwrap_or(design), &speeds, reset).map_err(Failure::new)?;
    Ok((analysis, name))
}

pub(super) fn spring(args: &SpringArgs) -> Result<Outcome, Failure> {
    let standard = args.design.then(|| "spring_buffer.body.wire=standard".to_owned());
    let overrides: Vec<String> = args.analysis.set.iter().cloned().chain(standard).collect();
    let loaded = machine_of_a_cam(&args.machine, &overrides)?;
    let (mut analysis, name) = spring_of(args, loaded)?;
    analysis.notes.extend(replaced_wire(args));
    judge_and_write((analysis, name), &args.analysis)
}

/// The wire of the machine file that a design does not take.
fn replaced_wire(args: &SpringArgs) -> Option<String> {
    let given = args.design.then(|| input_files::machine(&args.machine, &args.analysis.set).ok()).flatten()?.0;
    let SpringShape::Wire { wire, .. } = PressCams::of(&given).spring_body?.shape else { return None };
    Some(format!("--design takes a standard wire in the place of `spring_buffer.body.wire`, {:.3} mm", 1e3 * wire))
}

/// The springs of a loaded machine.
pub(crate) fn spring_of(args: &SpringArgs, loaded: (Machine, String)) -> Result<NamedAnalysis, Failure> {
    let (machine, name) = at_end(args.end, loaded)?;
    let of_file: Vec<f64> =
        PressCams::of(&machine).spring_stiffness.filter(|_| args.residual.is_none()).into_iter().collect();
    let stiffnesses = if args.stiffness.is_empty() { &of_file } else { &args.stiffness };
    let analysis = spring::analysis(&machine, &args.rpm, stiffnesses, args.residual).map_err(Failure::new)?;
    Ok((analysis, name))
}

pub(super) fn scatter(args: &ScatterArgs) -> Result<Outcome, Failure> {
    let keys: Vec<&str> = args.vary.iter().map(|varied| varied.split('=').next().unwrap_or_default().trim()).collect();
    let twice = keys.iter().enumerate().find(|(at, key)| keys.iter().take(*at).any(|other| other == *key));
    if let Some((_, key)) = twice {
        return Err(Failure(format!("--vary {key} is given twice")));
    }
    let varied = args.vary.iter().map(|varied| format!("scatter.{}", varied.trim()));
    let overrides: Vec<String> = args.analysis.set.iter().cloned().chain(varied).collect();
    let loaded = machine_of_a_cam(&args.machine, &overrides)?;
    judge_and_write(scatter_of(args, loaded)?, &args.analysis)
}

/// The scatter of a loaded machine.
pub(crate) fn scatter_of(args: &ScatterArgs, loaded: (Machine, String)) -> Result<NamedAnalysis, Failure> {
    let (machine, name) = at_end(args.end, loaded)?;
    let design = machine.press().map_err(Failure::new)?.design_rpm;
    let of_file = PressCams::of(&machine).scatter;
    let sampling = Sampling {
        distribution: args.distribution.unwrap_or(of_file.distribution),
        samples: args.samples.unwrap_or(of_file.samples),
        seed: args.seed.unwrap_or(of_file.seed),
        rule: args.reset.unwrap_or(of_file.rule),
        ..of_file
    };
    let analysis = scatter_analysis::analysis(&machine, args.rpm.unwrap_or(design), &args.fault, &sampling);
    Ok((analysis.map_err(Failure::new)?, name))
}

pub(super) fn drive(args: &DriveArgs) -> Result<Outcome, Failure> {
    let loaded = made_of(&args.machine, |source| DriveMachine::of_source(source, &args.analysis.set))?;
    judge_and_write(drive_of(args, loaded)?, &args.analysis)
}

/// The drive of a loaded machine.
pub(crate) fn drive_of(args: &DriveArgs, (machine, name): (DriveMachine, String)) -> Result<NamedAnalysis, Failure> {
    Ok((drive::analysis(&machine, args.solver, args.step).map_err(Failure::new)?, name))
}

pub(super) fn linkage(args: &LinkageArgs) -> Result<Outcome, Failure> {
    judge_and_write(linkage_of(args, args.analysis.machine(&args.machine)?)?, &args.analysis)
}

/// The linkage of a loaded machine.
pub(crate) fn linkage_of(args: &LinkageArgs, (machine, name): (Machine, String)) -> Result<NamedAnalysis, Failure> {
    let rpm = args.rpm.or(machine.design_rpm()).unwrap_or(f64::NAN);
    let (keep, power) = (args.keep.is_some(), args.power_limit);
    let goal = match args.synthesize {
        Some(LinkageGoal::Least) => Some(DragLinkGoal::Least { symmetric: keep, power }),
        _ if keep || power.is_some() => {
            return Err(Failure("--keep and --power-limit belong to --synthesize least".into()));
        }
        Some(LinkageGoal::Equal) => Some(DragLinkGoal::Equal),
        Some(LinkageGoal::Symmetric) => Some(DragLinkGoal::Symmetric),
        None => None,
    };
    Ok((linkage::analysis(&machine, rpm, goal).map_err(Failure::new)?, name))
}

pub(super) fn shaft(args: &ShaftArgs) -> Result<Outcome, Failure> {
    let loaded = made_of(&args.machine, |source| ShaftMachine::of_source(source, &args.analysis.set))?;
    judge_and_write(shaft_of(args, loaded)?, &args.analysis)
}

/// The shaft of a loaded machine.
pub(crate) fn shaft_of(args: &ShaftArgs, (machine, name): (ShaftMachine, String)) -> Result<NamedAnalysis, Failure> {
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
        (ShaftSolver::Exact, None) => CriticalSpeedSolver::Exact { order },
        (ShaftSolver::Paper, stations) => {
            let stations = stations.map_or(STATIONS, |stations| usize::try_from(stations).unwrap_or(usize::MAX));
            CriticalSpeedSolver::Paper { stations }
        }
    };
    let asked = ShaftOptions {
        rpm: args.rpm.clone(),
        modes: args.modes.map(usize::from),
        whirl: args.whirl,
        solver,
        sweep: args.sweep,
        steps: args.steps.unwrap_or(STEPS),
        samples: args.samples,
    };
    Ok((shaft::analysis(&machine, &asked).map_err(Failure::new)?, name))
}

pub(super) fn size(args: &SizeArgs) -> Result<Outcome, Failure> {
    judge_and_write(size_of(args, args.analysis.machine(&args.machine)?)?, &args.analysis)
}

/// The size of the disc of a loaded machine.
pub(crate) fn size_of(args: &SizeArgs, (machine, name): (Machine, String)) -> Result<NamedAnalysis, Failure> {
    Ok((size::analysis(&machine, &args.free, args.rpm).map_err(Failure::new)?, name))
}

pub(super) fn compare(args: &CompareArgs) -> Result<Outcome, Failure> {
    judge_and_write(compare_of(args, || args.analysis.machine(&args.machine))?, &args.analysis)
}

/// Measured points and the cam of a machine, which is loaded once they are read.
pub(crate) fn compare_of(
    args: &CompareArgs,
    load: impl FnOnce() -> Result<(Machine, String), Failure>,
) -> Result<NamedAnalysis, Failure> {
    let file = args.measured.display();
    let text = files()
        .table_text_of(&args.measured, LARGEST_MEASURED)
        .map_err(|why| Failure(format!("cannot read `{file}`: {why}")))?;
    let wrong = |why: camgen::Refusal| Failure(format!("`{file}`: {why}"));
    let points = measured::read(&text).map_err(wrong)?;
    let ball = measured::stated(&text).ball(args.ball.radius().map(|radius| 1e3 * radius)).map_err(wrong)?;
    let (machine, name) = load()?;
    let spec = Spec::of_program(machine, args.rpm).ok_or_else(|| {
        Failure(format!("{} has no motion: give the file of a cam that `camgen make` cuts", args.machine))
    })?;
    let cam = spec.solve().map_err(Failure::new)?;
    let cuts = cam.body().cuts();
    let names: Vec<&str> = cuts.iter().map(|cut| cut.name).filter(|name| !name.is_empty()).collect();
    let flank = args.flank.as_ref();
    let wanted = cuts.iter().filter(|cut| flank.is_none_or(|name| cut.name.eq_ignore_ascii_case(name)));
    let cut = match wanted.collect::<Vec<_>>()[..] {
        [cut] => cut,
        [] if cuts.is_empty() => {
            return Err(Failure(format!(
                "a {} has no outline in a plane with which points are compared",
                cam.body().kind().noun
            )));
        }
        _ if names.is_empty() => return Err(Failure("--flank is for a body with several flanks".into())),
        _ => return Err(Failure(format!("give --flank {}", names.join(" or --flank ")))),
    };
    let options = ComparisonOptions { ball: 1e-3 * ball.unwrap_or(0.0), fit: args.fit };
    Ok((comparison::analysis(cam.body(), cut, &points, options).map_err(Failure::new)?, name))
}

/// Largest table of measured points, bytes.
const LARGEST_MEASURED: u64 = 16 << 20;

pub(super) fn laws(args: &LawsArgs) -> Result<Outcome, Failure> {
    let (machine, name) = match &args.machine {
        Some(file) => {
            machine_with_free(file, &args.analysis.set, &args.free).map(|(machine, name)| (Some(machine), name))?
        }
        None if !args.free.is_empty() => {
            return Err(Failure("--free chooses a dimension of a cam: give its file".into()));
        }
        None if args.analysis.set.is_empty() => (None, "laws".to_owned()),
        None => return Err(Failure("--set overrides keys of a file: give one".into())),
    };
    let (analysis, name) = laws_of(args, (machine, name))?;
    if args.csv == args.svg {
        return judge_and_write((analysis, name), &args.analysis);
    }
    // Files are written as usual, but one of them is printed instead of the report.
    let (format, ending) = if args.csv { ("csv", ".csv") } else { ("svg", ".svg") };
    let judged = args.analysis.to.judged(Judged::new(analysis));
    let writing = writing(&args.analysis, judged.stem(&name))?;
    let shown = judged.files(&Writing { formats: Some(vec![format.to_owned()]), ..writing.clone() });
    let shown = shown.map_err(Failure::new)?;
    let files = (!args.analysis.report.dry_run).then(|| judged.files(&writing)).transpose().map_err(Failure::new)?;
    let bytes =
        shown.outputs().iter().find(|output| output.name.ends_with(ending)).map(|output| output.bytes.as_slice());
    let text = String::from_utf8_lossy(bytes.unwrap_or_default());
    match files {
        Some(files) => put_set(files, |_| print(&text))?,
        None => print(&text)?,
    }
    Ok(Outcome::Fine)
}

/// The laws, at the numbers of a loaded machine where there is one.
pub(crate) fn laws_of(args: &LawsArgs, (machine, name): (Option<Machine>, String)) -> Result<NamedAnalysis, Failure> {
    let (lift, over, rpm) = (args.lift, args.over, args.rpm);
    let asked = laws::LawsOptions { lift, over, rpm, sort: args.sort.clone(), laws: args.laws.clone() };
    Ok((laws::analysis(machine.as_ref(), &asked).map_err(Failure::new)?, name))
}

impl AnalysisArgs {
    fn machine(&self, name: &str) -> Result<(Machine, String), Failure> {
        machine_of_a_cam(name, &self.set)
    }
}

/// Judges, writes and reports.
fn judge_and_write((analysis, machine): NamedAnalysis, args: &AnalysisArgs) -> Result<Outcome, Failure> {
    write_judged(&args.to.judged(Judged::new(analysis)), args, &machine)
}

/// Judges, writes under a stem of its own and reports.
pub(super) fn judge_and_write_as(analysis: Analysis, args: &AnalysisArgs, stem: String) -> Result<Outcome, Failure> {
    write_as(&args.to.judged(Judged::new(analysis)), args, &writing(args, stem)?)
}

/// Which files of a judged analysis are written, and where.
fn writing(args: &AnalysisArgs, stem: String) -> Result<Writing, Failure> {
    Ok(Writing {
        formats: args.format.clone(),
        template: args.to.template()?,
        force: args.to.force,
        overwrite: args.to.overwrite,
        created: source_date()?,
        ..Writing::to(&args.to.out, args.to.name.clone().unwrap_or(stem))
    })
}

/// Writes and reports what was judged.
pub(super) fn write_judged(judged: &Judged, args: &AnalysisArgs, machine: &str) -> Result<Outcome, Failure> {
    write_as(judged, args, &writing(args, judged.stem(machine))?)
}

fn write_as(judged: &Judged, args: &AnalysisArgs, writing: &Writing) -> Result<Outcome, Failure> {
    write_with(judged, &args.report, writing)
}

/// Writes and reports what was judged, by these flags.
pub(super) fn write_with(judged: &Judged, args: &ReportArgs, writing: &Writing) -> Result<Outcome, Failure> {
    let files = if let Some(why) = judged.no_outline() {
        print_message(&format!("refused: {why}; there is no outline to write, and --force cannot help"));
        None
    } else if judged.passed() || writing.force {
        Some(judged.files(writing).map_err(Failure::new)?).filter(|_| !args.dry_run)
    } else {
        if !args.is_summary() {
            print_message(refusal(args.dry_run));
        }
        None
    };
    match files {
        Some(files) => put_set(files, |report| show(report, args))?,
        None => show(&judged.lazy_report(), args)?,
    }
    Ok(if judged.passed() { Outcome::Fine } else { Outcome::CheckFailed })
}

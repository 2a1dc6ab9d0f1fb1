//! `camgen trade`: speed against accuracy, measured on the user's computer.

use super::analyses::judge_and_write_as;
use super::args::{Speed, TradeArgs, TradeTarget, at_end, machine_with_free};
use super::input_files::made_of;
use super::progress::Progress;
use super::{Failure, Outcome};
use camgen::analysis::Analysis;
use camgen::document::similar;
use camgen::domains::press::MachineOfPress;
use camgen::domains::press::analysis::trade as of_press;
use camgen::domains::press::machine::PressCams;
use camgen::domains::shaft::{analysis::trade as of_shaft, machine::ShaftMachine};
use camgen::machine::Machine;
use camgen::refusal::Refusal;
use camgen::report::Speeds;
use camgen::trade::{self, LeftOver, TradeRun};
use camgen::write::number::names;
use clap::ValueEnum as _;
use std::time::Instant;

/// The default machine of the flags, and those that are measured for it where another is needed.
const PRESS: &str = "dpi";
const PROGRAM: &str = "feeder";
const SHAFT: &str = "press-cylinder";

pub(super) fn run(args: &TradeArgs) -> Result<Outcome, Failure> {
    let (target, file) = args.target();
    let target = target.or_else(|| file.filter(|file| is_shaft_alone(args, file)).map(|_| TradeTarget::Shaft));
    let shown = args.analysis.report.shows_progress();
    let mut bar: Option<Progress> = None;
    let mut progress = |_: usize, steps: usize| {
        let bar = bar.get_or_insert_with(|| {
            let bar = Progress::of_steps(shown, steps);
            bar.stage("measuring");
            bar
        });
        bar.step();
    };
    let start = Instant::now();
    let clock = || start.elapsed();
    let run = TradeRun { clock: &clock, progress: &mut progress };
    let (analysis, name, kind) = match target {
        Some(TradeTarget::Shaft) => {
            args.without_limits()?;
            let (machine, name) = shaft(args, file.unwrap_or(SHAFT))?;
            (of_shaft::analysis(&machine, &clock), name, "shaft")
        }
        target => of_cam(args, (target, file), run)?,
    };
    drop(bar);
    let analysis = analysis.map_err(Failure::new)?;
    let stem = format!("{name}-trade-{kind}{}", speed(&analysis.speeds));
    judge_and_write_as(analysis, &args.analysis, stem)
}

/// An analysis, the name of its machine, and its kind.
type NamedTrade = (Result<Analysis, Refusal>, String, &'static str);

/// The cams of a press, and those of motion programs.
fn of_cam(
    args: &TradeArgs,
    (target, file): (Option<TradeTarget>, Option<&str>),
    run: TradeRun<'_>,
) -> Result<NamedTrade, Failure> {
    let limits = of_press::PressTradeLimits { residual: args.residual, acceleration: args.acceleration };
    let default = if target == Some(TradeTarget::Make) { PROGRAM } else { PRESS };
    let file = file.unwrap_or(default);
    let loaded = machine_with_free(file, &args.analysis.set, &args.free);
    let (machine, name) = at_end(args.end, loaded.map_err(|failure| without_kind(args, failure))?)?;
    let target = target.unwrap_or_else(|| kind_of(&machine));
    if target == TradeTarget::Conoid {
        let (from, to) = match (args.rpm, PressCams::of(&machine).regimes.speeds.as_slice()) {
            (Some(Speed::Range(from, to)), _) => (from, to),
            (None, [from, .., to]) => (*from, *to),
            _ => {
                let why = "a conoid is measured over a range of speeds: give --rpm A..B, e.g. --rpm 20..35";
                return Err(Failure(why.into()));
            }
        };
        if args.acceleration.is_some() {
            return Err(Failure("--acceleration belongs to one outline, not to the sections of a conoid".into()));
        }
        return Ok((of_press::conoid(&machine, from, to, limits, run.clock), name, "conoid"));
    }
    let rpm = match args.rpm {
        None => None,
        Some(Speed::One(rpm)) => Some(rpm),
        Some(Speed::Range(..)) => return Err(Failure("a range of speeds belongs to `camgen trade conoid`".into())),
    };
    if target == TradeTarget::Make {
        if args.residual.is_some() {
            return Err(Failure(
                "--residual belongs to the cams of a press: a motion program balances no force".into(),
            ));
        }
        if machine.program().is_some_and(|program| program.stroke().is_some()) {
            return Err(Failure("trade measures cams that turn, and this motion is that of a plate".into()));
        }
        return Ok((trade::of_program(&machine, rpm, args.acceleration, run), name, "make"));
    }
    let rpm = rpm.map_or_else(|| machine.press().map(|press| press.design_rpm), Ok).map_err(Failure::new)?;
    if target == TradeTarget::Translating {
        return Ok((of_press::translating(&machine, rpm, limits, run), name, "translating"));
    }
    Ok((of_press::rotary(&machine, rpm, limits, others(args, file, rpm), run), name, "rotary"))
}

/// The shaft of a file, with the stem of its files.
fn shaft(args: &TradeArgs, file: &str) -> Result<(ShaftMachine, String), Failure> {
    made_of(file, |source| ShaftMachine::of_source(source, &args.analysis.set))
}

/// What the camshaft of a file leaves, where it has one.
fn others(args: &TradeArgs, file: &str, rpm: f64) -> Vec<LeftOver> {
    if let Ok((machine, _)) = shaft(args, file) {
        return of_shaft::left_by_shaft(&machine, rpm).into_iter().collect();
    }
    _ = (args, file, rpm);
    Vec::new()
}

impl TradeArgs {
    /// Refuses the limits and the speed of a cam for a shaft, of which nothing is cut.
    fn without_limits(&self) -> Result<(), Failure> {
        if self.residual.is_some() || self.acceleration.is_some() {
            return Err(Failure("--residual and --acceleration belong to a cam, not to a shaft".into()));
        }
        if self.rpm.is_some() {
            return Err(Failure("--rpm has no effect on the trade of a shaft; leave it out".into()));
        }
        Ok(())
    }
}

/// The speed, as the stem of the files has it.
fn speed(speeds: &Speeds) -> String {
    if let Speeds::One(rpm) = speeds { format!("-{}rpm", names(&[*rpm]).concat()) } else { String::new() }
}

/// Whether a file describes a shaft without a press.
fn is_shaft_alone(args: &TradeArgs, file: &str) -> bool {
    shaft(args, file).is_ok_and(|(machine, _)| machine.machine().is_none())
}

/// The kind of cam of a file.
fn kind_of(machine: &Machine) -> TradeTarget {
    match machine.press() {
        Err(_) if machine.motion().is_some() => TradeTarget::Make,
        _ => TradeTarget::Rotary,
    }
}

/// Why a file was not read; where a kind was probably meant, that.
fn without_kind(args: &TradeArgs, failure: Failure) -> Failure {
    let kinds: Vec<String> = TradeTarget::value_variants()
        .iter()
        .filter_map(|kind| kind.to_possible_value().map(|value| value.get_name().to_owned()))
        .collect();
    let typed = args.kind.as_deref().filter(|typed| !typed.contains(['.', '/', '\\']));
    match typed.and_then(|typed| similar(typed, kinds.iter().map(String::as_str)).map(|near| (typed, near))) {
        Some((typed, near)) if args.target().0.is_none() => {
            let all = kinds.join(", ");
            Failure(format!("`{typed}` is neither a file nor a kind; did you mean `{near}`? Kinds are {all}"))
        }
        _ => failure,
    }
}

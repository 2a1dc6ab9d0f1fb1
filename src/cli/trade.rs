//! `camgen trade`: speed against accuracy, measured on the user's computer.

use super::analyses::judge_and_write_as;
use super::args::{TradeArgs, TradeTarget, at_end, machine_with_free};
use super::progress::Progress;
use super::{Failure, Outcome};
use camgen::document::similar;
use camgen::domains::press::analysis::trade as of_press;
#[cfg(feature = "shaft")]
use camgen::domains::shaft::{analysis::trade as of_shaft, machine::ShaftMachine};
use camgen::machine::Machine;
use camgen::report::Speeds;
use camgen::trade::{self, TradeRun};
use camgen::write::number::names;
use clap::ValueEnum as _;
use std::time::Instant;

/// The default machine of the flags, and those that are measured for it where another is needed.
const PRESS: &str = "dpi";
const PROGRAM: &str = "feeder";
#[cfg(feature = "shaft")]
const SHAFT: &str = "press-cylinder";

pub(super) fn run(args: &TradeArgs) -> Result<Outcome, Failure> {
    let (target, file) = args.target();
    #[cfg(feature = "shaft")]
    let target = target.or_else(|| file.filter(|file| is_shaft_alone(args, file)).map(|_| TradeTarget::Shaft));
    let shown = args.analysis.report.shows_progress();
    let mut bar: Option<Progress> = None;
    let mut progress = |_: usize, steps: usize| {
        let bar = bar.get_or_insert_with(|| {
            let bar = Progress::of_steps(shown, steps);
            bar.stage("measuring until the order is stable");
            bar
        });
        bar.step();
    };
    let start = Instant::now();
    let clock = || start.elapsed();
    let run = TradeRun { clock: &clock, progress: &mut progress };
    let limits = of_press::PressTradeLimits { residual: args.residual, acceleration: args.acceleration };
    let set = &args.analysis.set;
    let (analysis, name, kind) = match target {
        #[cfg(feature = "shaft")]
        Some(TradeTarget::Shaft) => {
            if args.residual.is_some() || args.acceleration.is_some() {
                return Err(Failure("--residual and --acceleration belong to a cam, not to a shaft".into()));
            }
            let (machine, name) = ShaftMachine::load(file.unwrap_or(SHAFT), set).map_err(Failure::new)?;
            (of_shaft::analysis(&machine, &clock), name, "shaft")
        }
        target => {
            let default = if target == Some(TradeTarget::Make) { PROGRAM } else { PRESS };
            let loaded = machine_with_free(file.unwrap_or(default), set, &args.free);
            let (machine, name) = at_end(args.end, loaded.map_err(|failure| without_kind(args, failure))?)?;
            match target.unwrap_or_else(|| kind_of(&machine)) {
                TradeTarget::Make if args.residual.is_some() => {
                    return Err(Failure(
                        "--residual belongs to the cams of a press: a motion program balances no force".into(),
                    ));
                }
                TradeTarget::Make if machine.program().is_some_and(|program| program.stroke().is_some()) => {
                    return Err(Failure("trade measures cams that turn, and this motion is that of a plate".into()));
                }
                TradeTarget::Make => (trade::of_program(&machine, args.rpm, args.acceleration, run), name, "make"),
                target => {
                    let design = machine.press().map_err(Failure::new)?.design_rpm;
                    let rpm = args.rpm.unwrap_or(design);
                    match target {
                        TradeTarget::Translating => {
                            (of_press::translating(&machine, rpm, limits, run), name, "translating")
                        }
                        _ => (of_press::rotary(&machine, rpm, limits, run), name, "rotary"),
                    }
                }
            }
        }
    };
    drop(bar);
    let analysis = analysis.map_err(Failure::new)?;
    let stem = format!("{name}-trade-{kind}{}", speed(&analysis.speeds));
    judge_and_write_as(analysis, &args.analysis, stem)
}

/// The speed, as the stem of the files has it.
fn speed(speeds: &Speeds) -> String {
    if let Speeds::One(rpm) = speeds { format!("-{}rpm", names(&[*rpm]).concat()) } else { String::new() }
}

/// Whether a file describes a shaft without a press.
#[cfg(feature = "shaft")]
fn is_shaft_alone(args: &TradeArgs, file: &str) -> bool {
    ShaftMachine::load(file, &args.analysis.set).is_ok_and(|(machine, _)| machine.machine().is_none())
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

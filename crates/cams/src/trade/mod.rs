//! Speed against accuracy: every setting of an outline, a table of points or a law, made and measured on this computer.

mod chain;
pub mod measure;
mod report;
mod settings;
pub mod solver;

pub use chain::LeftOver;
pub use measure::TradeRun;
pub use measure::{TradeLaw, TradeLimits, TradeProduct, TradeSetting};
pub use settings::{SettingLadder, flags, ladder, of_disc};

use crate::analysis::{Analysis, Picture};
use crate::body::{Kind, needs_base_circle};
use crate::machine::Machine;
use crate::pipeline::Spec;
use crate::report::{Fact, Section, Speeds, Topic};
use crate::write::number::shortest;
use camgen_kernel::document::{Input, cams};
use camgen_kernel::refusal::Refusal;

/// The command.
pub const COMMAND: &str = "trade";

/// The disc cam of a motion program.
pub const KIND: Kind = Kind { command: COMMAND, noun: "time and accuracy of a disc cam", keys: cams::MAKE };

/// Default largest acceleration error, as a share: the one of `--accuracy standard`.
pub const ACCELERATION: f64 = 0.05;

/// What is measured, and the limits that the advice keeps.
pub struct TradeTask<'a> {
    /// The kind of the analysis.
    pub kind: &'static Kind,
    /// The kind of cam, as the command line names it.
    pub cam: &'static str,
    /// The machine.
    pub machine: &'a Machine,
    /// Its speed, rpm.
    pub rpm: Option<f64>,
    /// The settings that are tried.
    pub settings: SettingLadder,
    /// What the advice keeps.
    pub limits: TradeLimits,
    /// What has an effect besides the machine.
    pub inputs: Vec<Input>,
    /// What the rest of the machine leaves of the balance, whatever the outline.
    pub others: Vec<LeftOver>,
}

/// The disc cam of a motion program over all settings: times of every stage, sizes, and errors of distance, velocity and acceleration. The
/// advice is the setting that costs a shop least of those whose acceleration is off by no more than a share of its largest, 5 % where none is
/// given.
///
/// ```no_run
/// # use camgen_cams as camgen;
/// use camgen::Machine;
/// use camgen::trade::{self, TradeRun};
///
/// let (machine, _) = Machine::load("feeder", &[])?;
/// let start = std::time::Instant::now();
/// let run = TradeRun { clock: &|| start.elapsed(), progress: &mut |done, of| println!("{done} of {of}") };
/// let measured = trade::of_program(&machine, None, Some(0.02), run)?;
/// println!("{}", measured.sections.iter().find(|section| section.key == "advice").ok_or("advice")?.value);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Refusal`] when the machine has no motion, or a setting cannot be made.
pub fn of_program(
    machine: &Machine,
    rpm: Option<f64>,
    acceleration: Option<f64>,
    run: TradeRun<'_>,
) -> Result<Analysis, Refusal> {
    let (own, of_file) = (machine.clone(), machine.motion().and_then(|(_, rpm)| rpm));
    needs_base_circle(machine, "the outline of `camgen trade`")?;
    let settings = of_disc(move || {
        Spec::of_program(own.clone(), rpm).ok_or_else(|| {
            Refusal::new("the machine file has no motion")
                .remedy("`camgen trade make` needs the tables [motion] and [[motion.segment]]")
        })
    })?;
    let limits = TradeLimits { residual: None, acceleration: Some(acceleration.unwrap_or(ACCELERATION)) };
    let (cam, rpm, inputs, others) = ("make", rpm.or(of_file), machine.inputs(cams::MAKE), Vec::new());
    analysis(&TradeTask { kind: &KIND, cam, machine, rpm, settings, limits, inputs, others }, run)
}

/// The flags that ask for the advised setting.
const FLAGS: Topic = Topic::new(10, "flags");

/// Measures a task.
///
/// # Errors
/// [`Refusal`] when a setting cannot be made.
pub fn analysis(task: &TradeTask<'_>, run: TradeRun<'_>) -> Result<Analysis, Refusal> {
    let (laws, settings) = &task.settings;
    let limits = task.limits;
    let measured = measure::measure(laws, settings, limits, run)?;
    let (advised, chosen) = (report::advice(&measured.rows, limits), report::chosen(&measured.rows));
    let chain = chain::left_over(chosen, &task.others);
    let title = report::headline(&measured.rows, limits);
    let advice = chain::not_the_outline(&chain).map_or(advised.clone(), |why| format!("{advised}; {why}"));
    let against = if limits.residual.is_some() { "force" } else { "gap" };
    let speed = task.rpm.map_or(String::new(), |rpm| format!(" at {} rpm", shortest(rpm)));
    let (machine, cam) = (task.machine.name(), if task.cam == "make" { "disc" } else { task.cam });
    let subtitle =
        format!("{machine}: pieces against {against} and acceleration of a {cam} cam{speed}; the front in blue");
    let mut inputs = task.inputs.clone();
    inputs.push(Input::word("command", format!("{COMMAND} {}", task.cam)));
    inputs.extend(task.rpm.map(|rpm| Input::number("rpm", rpm)));
    let limit = |key, limit: Option<f64>| limit.map(|limit| Section::new(key, &limit));
    let mut sections = vec![Section::new("cam", &task.cam)];
    sections.extend(limit("residual_limit_n", limits.residual));
    sections.extend(limit("acceleration_limit", limits.acceleration));
    sections.push(Section::new("rounds", &measured.rounds));
    let summary = report::summary_table(&measured.rows);
    sections.push(Section::new("rows", &measured.rows).with_words(report::words(&measured)).with_table(summary));
    sections.push(Section::new("chain", &chain).with_words(chain.iter().map(LeftOver::words).collect()));
    let flags = chosen.and_then(|row| row.flags.clone()).map(|flags| Fact::new(FLAGS, flags));
    sections.push(
        Section::new("advice", &advice)
            .with_words(report::advice_words(&advice, chosen))
            .with_answer(advised)
            .with_facts(flags),
    );
    sections.extend(chosen.and_then(|row| row.flags.as_ref()).map(|flags| Section::new("flags", flags)));
    Ok(Analysis {
        kind: task.kind,
        variant: "",
        machine: machine.to_owned(),
        speeds: task.rpm.map_or(Speeds::Any(()), Speeds::One),
        inputs,
        sections,
        measures: Vec::new(),
        tables: vec![("", report::table(&measured.rows))],
        notes: measured.missing,
        by: &[],
        along: "pieces",
        picture: Picture::Chart(report::chart_of(&measured.rows, limits, title, subtitle)),
        mechanism: None,
        document: None,
        diagrams: &[],
        not_modelled: Vec::new(),
    })
}

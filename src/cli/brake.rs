//! `camgen brake`: the belt brake of a paper roll, and the disc that holds its tension.

use super::analyses::write_judged;
use super::args::BrakeArgs;
use super::input_files::made_of;
use super::progress::Progress;
use super::{Failure, Outcome};
use camgen::document::NamedChoice;
use camgen::domains::brake::{self, BrakeDisc, BrakeMachine, BrakeOutput, analysis};
use camgen::machine::UNITS_KEY;
use camgen::pipeline::{Judged, ProvenAssembly, Spec};
use std::sync::Arc;

/// The brake of a file, with its disc.
pub(super) fn with_disc(name: &str, set: &[String]) -> Result<BrakeMachine, Failure> {
    loaded(name, set, BrakeOutput::Disc).map(|(machine, _)| machine)
}

/// The brake of a file, with the stem of its files.
pub(super) fn loaded(name: &str, set: &[String], wanted: BrakeOutput) -> Result<(BrakeMachine, String), Failure> {
    made_of(name, |source| BrakeMachine::of_source(source, set, wanted))
}

/// The specification of the disc of a brake, and its motion.
pub(super) fn of_brake(machine: &BrakeMachine) -> Result<(Spec, Arc<BrakeDisc>), Failure> {
    let disc = Arc::new(machine.brake_disc().map_err(Failure::new)?);
    let spec = brake::spec(machine, Arc::clone(&disc));
    spec.map(|spec| (spec, disc)).ok_or_else(|| Failure("the file describes no disc on the shaft of the frame".into()))
}

pub(super) fn run(args: &BrakeArgs) -> Result<Outcome, Failure> {
    let of_flag = args.analysis.to.units.map(|units| format!("{UNITS_KEY}={}", units.word()));
    let set: Vec<String> = args.analysis.set.iter().cloned().chain(of_flag).collect();
    let (machine, name) = loaded(&args.machine, &set, wanted(args))?;
    let progress = Progress::of_stages(args.analysis.report.shows_progress());
    let judged = judged(args, &machine, |stage| progress.stage(stage))?;
    drop(progress);
    write_judged(&args.analysis.to.judged(judged), &args.analysis, &name)
}

/// What of the file is read.
pub(crate) fn wanted(args: &BrakeArgs) -> BrakeOutput {
    match (args.cam, args.synthesize) {
        (true, _) => BrakeOutput::Disc,
        (false, Some(_)) => BrakeOutput::Frame,
        (false, None) => BrakeOutput::Figures,
    }
}

/// The brake of a loaded machine, with its disc where that is asked for.
pub(crate) fn judged(
    args: &BrakeArgs,
    machine: &BrakeMachine,
    stage: impl Fn(&'static str),
) -> Result<Judged, Failure> {
    let request = analysis::BrakeRequest { steps: args.samples, goal: args.synthesize, seed: args.seed };
    if !args.cam {
        return Ok(Judged::new(analysis::analysis(machine, &request, None).map_err(Failure::new)?));
    }
    stage("solving");
    let (spec, disc) = of_brake(machine)?;
    let cam = spec.solve().map_err(Failure::new)?;
    stage("drawing");
    let drawing = cam.draw(args.outline.request(&args.accuracy)?).map_err(Failure::new)?;
    stage("proving");
    let proven = drawing.prove_as(args.outline.dxf_version).map_err(Failure::new)?;
    let as_cut = brake::as_written(&disc, &proven);
    let held = analysis::TensionDisc { disc: &disc, as_cut: as_cut.as_ref() };
    let analysis = analysis::analysis(machine, &request, Some(&held)).map_err(Failure::new)?;
    Ok(ProvenAssembly::from(proven).with_analysis(Judged::new(analysis)))
}

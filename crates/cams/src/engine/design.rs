//! A cam of a text: solved, drawn, proved, as figures, as a page shows it, as files.

use super::{EngineAnswer, EngineFile, EngineRequest, changes, values};
use crate::body::{Accuracy, Body, Request};
use crate::catalogue::{commands, usual_command};
use crate::machine::{Machine, MachineSource, valid_rpm};
use crate::pipeline::{AssemblyDrawing, Error, ProvenAssembly, Spec, Writing};
use crate::report::Finding;
use crate::tool_files::Format;
use crate::verify::WrittenOutline;
use crate::write::{Rendering, html, svg};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::profile::outline::Fit;
use camgen_kernel::refusal::Refusal;
use serde_json::{Map, Value, json};

/// Directory of the files as reports name it.
const DIRECTORY: &str = "output";

/// Largest tolerance, m.
const LARGEST_TOLERANCE: f64 = 1e-3;

/// The name of the design of a request.
fn name(request: &EngineRequest) -> &str {
    if request.name.is_empty() { "design" } else { &request.name }
}

/// The machine of a text; the answer gets the values that hold for absent keys.
pub(super) fn machine(request: &EngineRequest, toml: &str, answer: &mut EngineAnswer) -> Result<Machine, Error> {
    let source = MachineSource::from_toml(&format!("{}.toml", name(request)), toml).with_texts(request.files.clone());
    let machine = Machine::of_source(&source, &[])?;
    answer.say("usual", values::usual(&machine, toml));
    Ok(machine)
}

/// The proven cam of a text and the settings of its files; `None` for `formats` means all that the cam has. The answer gets what is known before the
/// drawing.
pub(super) fn proven(
    request: &EngineRequest,
    toml: &str,
    formats: Option<Vec<String>>,
    answer: &mut EngineAnswer,
) -> Result<(ProvenAssembly, Writing), Error> {
    let assembly = spec(request, machine(request, toml, answer)?)?.assemble()?;
    let body = assembly.first().body();
    let kind = body.kind();
    answer.say("command", kind.command);
    answer.say("kind", kind.keys);
    answer.say("values", values::values(body, toml));
    answer.say("motion", segments(body.machine()));
    let name = name(request);
    let stem = if request.usual_names { assembly.first().stem(name, None) } else { name.to_owned() };
    let writing = Writing { formats, ..Writing::to(DIRECTORY, stem) };
    let (formats, _) = writing.chosen(body)?;
    let drawing = assembly.draw(Request {
        rates: [None, Accuracy::Standard.acceleration()],
        strict: [false; 2],
        flank: formats.iter().any(Format::shows_flank),
        ..Request::within(Fit::from(tolerance(request)?))
    });
    Ok((drawing.and_then(AssemblyDrawing::prove)?, writing))
}

/// Makes what is asked for of a text.
pub(super) fn made(request: &EngineRequest, toml: &str, answer: &mut EngineAnswer) -> Result<(), Error> {
    let (proven, writing) = proven(request, toml, Some(request.formats.clone()), answer)?;
    answer.say("passed", proven.passed());
    answer.say("noOutline", no_outline(&proven));
    answer.say("remedies", of_findings(proven.findings()));
    answer.say("others", others(&proven));
    if request.report {
        answer.say("report", json!(proven.report()));
    }
    if let Some(steps) = request.page {
        answer.say("cam", shown(&proven, steps)?);
    }
    if proven.passed() && !request.formats.is_empty() {
        let files = proven.files(&writing)?;
        let outputs = files.outputs().iter();
        answer.files = outputs.map(|file| EngineFile { name: file.name.clone(), bytes: file.bytes.clone() }).collect();
    }
    Ok(())
}

fn tolerance(request: &EngineRequest) -> Result<f64, Error> {
    let tolerance = request.tolerance.unwrap_or(Accuracy::Standard.tolerance());
    if tolerance > 0.0 && tolerance <= LARGEST_TOLERANCE {
        return Ok(tolerance);
    }
    Err(Error::Draw(Refusal::new("a tolerance must be above 0 and at most 1 mm")))
}

/// The cam that a command makes of a machine.
fn spec(request: &EngineRequest, machine: Machine) -> Result<Spec, Error> {
    let rpm: Vec<f64> = request.rpm.iter().copied().map(valid_rpm).collect::<Result<_, _>>().map_err(refusal)?;
    let command = match commands().find(|command| command.word == request.command) {
        Some(command) => command,
        None if request.command.is_empty() => usual_command(&machine),
        None => return Err(refusal(format!("no command `{}` makes a cam", request.command))),
    };
    command.spec(machine, &rpm).map_err(Error::Solve)
}

fn refusal(why: impl Into<String>) -> Error {
    Error::Solve(Refusal::new(why))
}

/// What would let each check pass that promises it.
fn of_findings(findings: &[Finding]) -> Map<String, Value> {
    let remedies = findings.iter().filter_map(|finding| {
        let remedies: Vec<_> = finding.note.as_ref()?.remedies().into_iter().map(changes).collect();
        (!remedies.is_empty()).then(|| (finding.check.to_string(), json!(remedies)))
    });
    remedies.collect()
}

/// Why a cam has no outline, with the name of a disc that is not the first.
fn no_outline(proven: &ProvenAssembly) -> Option<String> {
    let of_others =
        || proven.others().iter().find_map(|(name, cam)| Some(format!("{name} disc: {}", cam.no_outline()?)));
    proven.first().no_outline().map(str::to_owned).or_else(of_others)
}

/// The other cams of an assembly by their names, with the checks that they fail.
fn others(proven: &ProvenAssembly) -> Vec<Value> {
    let others = proven.others().iter().zip(proven.failures_of_others()).map(|((name, cam), (_, failed))| {
        let (checks, remedies) = (html::checks_of(&failed), of_findings(&failed));
        json!({"name": name, "passed": cam.passed(), "checks": checks, "remedies": remedies})
    });
    others.collect()
}

/// What a page shows; of a cam without an outline its checks alone.
fn shown(proven: &ProvenAssembly, steps: u32) -> Result<Value, Error> {
    let report = proven.lazy_report();
    if proven.no_outline().is_some() {
        return Ok(html::data_without_outline(&report));
    }
    let others: Vec<(&dyn Body, &[WrittenOutline])> =
        proven.others().iter().map(|(_, other)| (other.body(), other.outlines())).collect();
    let rendering = proven.first().rendering(&report, steps.clamp(1, 720), svg::TEMPLATE)?;
    Ok(html::data_of(&Rendering { other_cams: &others, ..rendering }))
}

/// The segments of the motion of a machine: law, cam angles (deg) or travels (mm), and positions (deg or mm), each at its beginning and its end.
fn segments(machine: &Machine) -> Option<Value> {
    let program = machine.program()?;
    let along = |at: f64| if program.stroke().is_some() { MILLIMETRES * at } else { at.to_degrees() };
    let swings = program.quantity() == Quantity::Angle;
    let position = |at: f64| if swings { at.to_degrees() } else { MILLIMETRES * at };
    let segments = program.segments().iter().map(|segment| {
        let ((from, to), (low, high)) = (segment.angles, segment.positions);
        json!({"law": segment.law, "at": [along(from), along(to)], "position": [position(low), position(high)], "whole": segment.whole})
    });
    let segments: Vec<Value> = segments.collect();
    Some(
        json!({"units": [if program.stroke().is_some() { "mm" } else { "deg" }, if swings { "deg" } else { "mm" }], "segments": segments}),
    )
}

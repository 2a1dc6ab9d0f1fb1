//! Programs for a milling machine: the passes of `plan::milling` in the words of a control.
//!
//! Numbers are on the grid of the control already, so that what is written is what was planned. The file is read back by `read`,
//! which shares nothing with this, and refused where the moves are not those of the cam.

mod iso;
mod klartext;
pub(super) mod setup;
mod turned;

use super::blank::Blank;
use super::plan::milling::{self, MillingProgram};
use crate::body::{Body, curves};
use crate::machine::{Controller, Coolant, MillingDirection};
use crate::write::number::short;
use camgen_kernel::document::NamedChoice;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::units::LengthUnit;

/// Seconds in a minute.
const MINUTE: f64 = 60.0;
/// Decimals of feeds and speeds.
const RATE_DECIMALS: usize = 3;
/// Longest comment, characters.
const LONGEST_COMMENT: usize = 70;

/// A program as its file, with these comments at its head.
pub(super) fn write(body: &dyn Body, program: &MillingProgram, marks: &[String]) -> Vec<u8> {
    let mut comments: Vec<String> = marks.to_vec();
    comments.extend(named_control(program.controller));
    comments.extend(head(body, program));
    let comments: Vec<String> = comments.iter().flat_map(|comment| folded(&plain_text(comment))).collect();
    let text = match program.controller {
        Controller::Heidenhain => klartext::write(program, &comments, &name(body)),
        _ => iso::write(program, &comments, &name(body)),
    };
    text.into_bytes()
}

/// The name of a control whose words are those of LinuxCNC: readers know it by this line.
fn named_control(controller: Controller) -> Option<String> {
    let named = matches!(controller, Controller::Grbl | Controller::Mach3);
    named.then(|| format!("control: {}", controller.word()))
}

/// Z of the machine for the tool change and the end, m; `None` for the reference point of FANUC.
fn home(program: &MillingProgram) -> Option<f64> {
    // Just below the end of travel: HEIDENHAIN and grbl stop at the end itself.
    const BELOW: f64 = -1e-3;
    let usual = match program.controller {
        Controller::Fanuc => None,
        Controller::Heidenhain | Controller::Grbl => Some(BELOW),
        Controller::LinuxCnc | Controller::Sinumerik | Controller::Mach3 => Some(0.0),
    };
    program.cutting.home.or(usual)
}

/// A feed, a unit of length per minute.
fn feed(speed: f64, units: LengthUnit) -> String {
    short(units.of_mm(MINUTE * MILLIMETRES * speed), RATE_DECIMALS)
}

/// The machine's name in capitals, digits and underscores.
fn name(body: &dyn Body) -> String {
    let kept = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' };
    let name: String = body.machine().name().chars().map(kept).take(24).collect();
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) { name } else { format!("CAM_{name}") }
}

/// What a comment may have in all of the controls.
fn plain_text(text: &str) -> String {
    let text = text.replace('Ø', "dia. ");
    text.chars().map(|c| if (' '..='~').contains(&c) && !"();%".contains(c) { c } else { ' ' }).collect()
}

/// A comment in lines that fit a block.
fn folded(text: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_ascii_whitespace() {
        match lines.last_mut() {
            Some(line) if line.len() + word.len() < LONGEST_COMMENT => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.chars().take(LONGEST_COMMENT).collect()),
        }
    }
    lines
}

/// What a program is, line by line.
fn head(body: &dyn Body, program: &MillingProgram) -> Vec<String> {
    let (cutting, units) = (&program.cutting, program.units);
    let unit = units.symbol();
    let length = |millimetres: f64| short(units.of_mm(millimetres), 6);
    let depth = program.depths.last().copied().unwrap_or(0.0);
    let sense = match cutting.direction {
        MillingDirection::Climb => "climb milling",
        MillingDirection::Conventional => "conventional milling",
    };
    let path = program.cutter.map_or_else(
        || {
            let least = short(units.of_mm(program.largest_kept().unwrap_or(f64::INFINITY)), 3);
            format!("the profile, on which the control keeps its cutter, of a radius below {least} {unit}, {sense}")
        },
        |radius| {
            format!("path of the centre of a cutter of diameter {} {unit}, {sense}", length(2.0 * MILLIMETRES * radius))
        },
    );
    let axis = program.turned.as_ref().map(|turned| turned.axis);
    let turned = program.turned.iter().flat_map(|turned| turned.rounds.iter().map(|round| round.words.as_str()));
    let finishing = program.passes.iter().filter(|pass| !pass.is_roughing).map(|pass| pass.words.as_str());
    let flanks: Vec<&str> = finishing.chain(turned).collect();
    let count = program.depths.len();
    let passes = if count == 1 { "pass" } else { "passes" };
    let finishing = match (cutting.allowance, cutting.finish_passes) {
        (0.0, 1) => String::new(),
        (0.0, all) => format!(", then {} at full depth without infeed", all - 1),
        (allowance, all) => {
            let allowance = length(MILLIMETRES * allowance);
            format!(" with {allowance} {unit} of stock, then {all} at size and full depth")
        }
    };
    let plate = curves(body).is_some_and(|curves| curves.motion.period().is_none());
    let origin = match axis {
        Some('C') => "X the distance of the wheel from the axis of the shaft, C0 as in the drawing, Y0",
        Some(_) => {
            "X along the axis of A from z = 0 of the drawing, Y0 on it, A0 as in the drawing, A as if the tool went about the cam by the right hand along X"
        }
        None if plate => "X0 Y0 as in the drawing",
        None => "X0 Y0 as in the drawing: the axis of the shaft",
    };
    let face = if axis == Some('A') { "the outside of the cam" } else { "the upper face" };
    let rib = milling::rib_between(body, program.cutter);
    let rib = rib
        .map(|rib| format!("a rib of {} {unit} stands between the passes: clear it before", length(MILLIMETRES * rib)));
    let mut head = vec![
        format!("{}: {}, {}", body.machine().name(), body.kind().noun, flanks.join(", ")),
        path,
        format!("{origin}, Z0 {face}, {} {unit} deep in {count} {passes}{finishing}", length(depth)),
        "bore, keyway and holes are not in this program".to_owned(),
        first_move(program),
    ];
    head.extend(set_by_hand(program));
    head.extend(rib);
    head
}

/// The first move of the tool, which must suit the machine.
fn first_move(program: &MillingProgram) -> String {
    match home(program) {
        None => "the first move takes Z to its reference point, G28; cut.home is another".to_owned(),
        Some(home) => {
            let z = short(program.units.of_mm(MILLIMETRES * home), 6);
            format!("the first move takes Z to {z} {} of the machine, cut.home", program.units.symbol())
        }
    }
}

/// Settings that the operator makes or checks before the start, line by line.
fn set_by_hand(program: &MillingProgram) -> Vec<String> {
    let (cutting, units) = (&program.cutting, program.units);
    let unit = units.symbol();
    let length = |millimetres: f64| short(units.of_mm(millimetres), 3);
    let depth = program.depths.last().copied().unwrap_or(0.0);
    let tool = cutting.tool.map_or_else(|| "the tool".to_owned(), |tool| format!("tool {tool}"));
    let size = match program.cutter {
        Some(radius) => format!("diameter {} {unit}", length(2.0 * MILLIMETRES * radius)),
        None => format!("diameter below {} {unit}", length(2.0 * program.largest_kept().unwrap_or(f64::INFINITY))),
    };
    let reach = length(depth + MILLIMETRES * cutting.clearance);
    let mut lines = vec![format!("set by hand: {tool}, {size}, free length at least {reach} {unit}, and the zero")];
    lines.extend(program.blank.map(|blank| match blank {
        Blank::Round(radius) => {
            format!("blank: diameter {} {unit} about X0 Y0, nothing beside it", length(2.0 * radius))
        }
        Blank::Rectangle(extents) => {
            let ([a, b], [c, d]) = (extents.least.into(), extents.largest.into());
            let [a, b, c, d] = [a, b, c, d].map(length);
            format!("blank: X{a} Y{b} to X{c} Y{d} {unit}, nothing beside it")
        }
    }));
    if let Some(extents) = program.extents() {
        let ([a, b], [c, d]) = (extents.least.into(), extents.largest.into());
        let [a, b, c, d, deep, high] = [a, b, c, d, -depth, MILLIMETRES * cutting.safe_height].map(length);
        lines
            .push(format!("range of the tool's point: X {a} to {c}, Y {b} to {d}, Z {deep} to {high} {unit} and home"));
    }
    if program.controller == Controller::Grbl {
        lines.push("grbl: home the machine before the start, load the tool, and set Z0 of G54 with it".into());
        if cutting.coolant == Coolant::Mist {
            lines.push("grbl: M7 needs a build with ENABLE_M7".into());
        }
    }
    lines
}

/// The operator's tasks at the stop before the first move, as lines; empty if the machine file has tool and spindle speed.
fn by_hand(program: &MillingProgram) -> Vec<String> {
    let cutting = &program.cutting;
    let of_tool = match program.controller {
        Controller::LinuxCnc => "load the cutter as the tool in the spindle: its length is that of the tool table",
        Controller::Fanuc => "load the cutter and set its length with G43 H, or Z0 of G54 with this cutter",
        Controller::Sinumerik => "load the cutter as the tool in the spindle: its length is that of its edge D1",
        Controller::Heidenhain => "load the cutter and call it with TOOL CALL",
        Controller::Grbl | Controller::Mach3 => "load the cutter and set Z0 of G54 with it",
    };
    let kept = program.passes.iter().any(|pass| pass.compensated.is_some());
    let radius = "its radius is that of offset D1";
    let spindle = "start the spindle clockwise";
    let lines = [
        (cutting.tool.is_none(), of_tool),
        (cutting.tool.is_none() && kept && program.controller != Controller::Heidenhain, radius),
        (cutting.spindle.is_none(), spindle),
        (cutting.tool.is_none(), "cut.tool in the machine file does without this stop for the tool"),
        (cutting.spindle.is_none(), "cut.spindle in the machine file does without this stop for the spindle"),
    ];
    let wanted = lines.into_iter().filter(|(is_wanted, _)| *is_wanted);
    wanted.flat_map(|(_, line)| folded(&plain_text(line))).collect()
}

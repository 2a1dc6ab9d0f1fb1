//! The design file: the motion that was found, with the follower and the cam.

use super::model::{ChosenLaw, LawParameter, ModelLaw};
use super::motion::FoundMotion;
use super::positions::Positions;
use super::spline;
use crate::machine::Machine;
use camgen_kernel::motion::Quantity;
use camgen_kernel::motion::laws::SegmentEnd;
use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// Digits behind the point of angles in degrees and of positions in mm or degrees.
const DIGITS: usize = 6;
/// A smaller rotation of the cam is not reported, rad.
const NOT_TURNED: f64 = 1e-6;
/// Positions in a comment are that precise: four digits.
const LISTED: usize = 3;

/// A design before it is written.
#[derive(Debug, Clone)]
pub(super) struct Design<'a> {
    pub(super) name: &'a str,
    /// What it was imported from, for its first line.
    pub(super) source: &'a str,
    pub(super) rpm: Option<f64>,
    /// Dotted keys and values in TOML of everything but the motion.
    pub(super) settings: &'a [(String, String)],
    /// m or rad.
    pub(super) deviation: f64,
    /// Rotation of the cam against its file, rad.
    pub(super) turn: f64,
}

/// A number without trailing zeros.
fn number(value: f64) -> String {
    let text = format!("{value:.DIGITS$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" || text.is_empty() { "0".into() } else { text.into() }
}

fn degrees(angle: f64) -> String {
    format!("{} deg", number(angle.to_degrees()))
}

/// The unit of positions, and one of it, m or rad.
pub(super) fn unit(quantity: Quantity) -> (&'static str, f64) {
    if quantity == Quantity::Angle { ("deg", PI / 180.0) } else { ("mm", 1e-3) }
}

/// Two digits, three of a large number.
fn short(value: f64) -> String {
    let tens = libm::floor(libm::log10(value.abs().max(1e-12)));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a small number of digits")]
    let digits = (1.0 - tens).clamp(0.0, 6.0) as usize;
    if value.abs() < 1e-5 { "0".into() } else { format!("{value:.digits$}") }
}

/// A deviation with its unit.
pub(super) fn told(quantity: Quantity, value: f64) -> String {
    if quantity == Quantity::Angle {
        format!("{} deg", short(value.to_degrees()))
    } else {
        format!("{} um", short(1e6 * value))
    }
}

impl Design<'_> {
    /// The text of the file.
    pub(super) fn text(&self, rows: &Positions, found: &FoundMotion) -> String {
        let mut text = String::new();
        let (unit, size) = unit(rows.quantity);
        let position = |value: f64| format!("{} {unit}", number(value / size));
        let source: String = self.source.chars().filter(|c| !c.is_control()).collect();
        let _ = writeln!(text, "# imported from {source}");
        let turn = libm::remainder(self.turn, TAU);
        if turn.abs() > NOT_TURNED {
            let back = degrees(-turn);
            let _ = writeln!(
                text,
                "# turned by {} against its file, so that the first rise begins at 0 deg: what is at an angle there, as a keyway, is turned \
                 with it; at = \"{back}\" turns it back, and so does --fit none",
                degrees(turn)
            );
        }
        let _ = writeln!(text, "name = {}", quoted(self.name));
        let lines = tables(self.settings);
        text.push_str(lines.first().map_or("", |(_, lines)| lines));
        let _ = writeln!(text, "\n[motion]");
        if let Some(rpm) = self.rpm {
            let _ = writeln!(text, "rpm = {rpm}");
        }
        let lobes = (TAU / rows.fill).round();
        let first = found.model.nodes.first().copied().unwrap_or(0.0);
        let at = first - ((first + 1e-9) / rows.fill).floor() * rows.fill;
        if found.whole {
            let _ = writeln!(text, "start = \"0 {unit}\"");
            if lobes > 1.0 {
                let _ = writeln!(text, "repeat = {lobes}");
            }
            self.whole(&mut text, rows);
        } else {
            let from = found.model.segments.first().map_or(0.0, |segment| found.model.level(segment.from));
            let _ = writeln!(text, "start = \"{}\"", position(from));
            if at.abs() > 1e-12 {
                let _ = writeln!(text, "at = \"{}\"", degrees(at));
            }
            if lobes > 1.0 {
                let _ = writeln!(text, "repeat = {lobes}");
            }
            for index in 0..found.model.segments.len() {
                self.segment(&mut text, rows, found, (index, at - first));
            }
        }
        for (table, lines) in lines.iter().skip(1) {
            let _ = write!(text, "\n[{table}]\n{lines}");
        }
        text
    }

    /// A segment, with its angles moved.
    fn segment(&self, text: &mut String, rows: &Positions, found: &FoundMotion, (index, moved): (usize, f64)) {
        let model = &found.model;
        let (Some(segment), Some(told_of)) = (model.segments.get(index), found.segments.get(index)) else { return };
        let (unit, size) = unit(rows.quantity);
        let position = |value: f64| format!("{} {unit}", number(value / size));
        let (start, end) = (model.start(index), model.end(index));
        let last = index + 1 == model.segments.len();
        let _ = writeln!(text, "\n[[motion.segment]]");
        let name = match segment.law {
            ModelLaw::Dwell => "dwell",
            ModelLaw::Law(law) => law.law.name,
            ModelLaw::Unknown => "spline",
        };
        let comment = comment(rows.quantity, &told_of.fits, segment.law);
        let _ = writeln!(text, "law = \"{name}\"{comment}");
        if !last {
            let _ = writeln!(text, "over = \"{}\"", degrees(rounded(end + moved) - rounded(start + moved)));
        }
        if matches!(segment.law, ModelLaw::Dwell) {
            return;
        }
        let _ = writeln!(text, "to = \"{}\"", position(model.level(segment.to)));
        if told_of.turns {
            let _ = writeln!(text, "end = \"turn\"");
        }
        // A law before a straight line ends with its velocity, as the numbers of the line have it.
        let next = (index + 1) % model.segments.len();
        if model.velocity(next).is_some()
            && let Some(line) = model.segments.get(next)
        {
            let travel = written(model.level(line.to) / size) - written(model.level(line.from) / size);
            let width =
                written((model.end(next) + moved).to_degrees()) - written((model.start(next) + moved).to_degrees());
            let slope = if rows.quantity == Quantity::Angle { "deg/deg" } else { "mm/deg" };
            let _ = writeln!(text, "velocity = \"{} {slope}\"", travel / width);
        }
        match segment.law {
            ModelLaw::Law(ChosenLaw { parameter: LawParameter::Inflection(share), .. }) => {
                let _ = writeln!(text, "inflection = {}", number(share));
            }
            ModelLaw::Law(ChosenLaw { parameter: LawParameter::Line(line), .. }) => {
                let _ = writeln!(text, "line = {}", number(line));
            }
            ModelLaw::Law(ChosenLaw { parameter: LawParameter::Ramp(ramp), .. }) => {
                let _ = writeln!(text, "ramp = {}", number(ramp));
            }
            ModelLaw::Unknown => {
                let (from, to) = ((start, model.level(segment.from)), (end, model.level(segment.to)));
                let points = spline::points(rows, from, to, self.deviation);
                let _ = writeln!(text, "points = [");
                for [angle, value] in points {
                    let _ = writeln!(text, "    [\"{}\", \"{}\"],", degrees(angle + moved), position(value));
                }
                let _ = writeln!(text, "]");
            }
            _ => {}
        }
    }

    /// The whole motion as points of a periodic spline, as few as keep the deviation.
    fn whole(&self, text: &mut String, rows: &Positions) {
        let (unit, size) = unit(rows.quantity);
        let pairs = |points: &[[f64; 2]]| {
            let lines: Vec<String> = points
                .iter()
                .map(|[angle, value]| format!("    [\"{}\", \"{} {unit}\"],", degrees(*angle), number(value / size)))
                .collect();
            format!("points = [\n{}\n]\n", lines.join("\n"))
        };
        let smooth = format!("smooth = \"{} {unit}\"\n", 0.85 * self.deviation / size);
        let first = rows.angles.first().copied().unwrap_or(0.0);
        let all: Vec<[f64; 2]> = (0..rows.len()).map(|at| [rows.angle(at) - first, rows.value(at)]).collect();
        let begin = format!("at = \"{}\"\n", degrees(first));
        let program = |points: &str| {
            let lobes = (TAU / rows.fill).round();
            let head = format!("name = \"rows\"\n[motion]\nstart = \"0 {unit}\"\nrepeat = {lobes}\n{points}");
            let follower = if rows.quantity == Quantity::Angle {
                "[follower.swinging-flat]\npivot_distance = \"100 mm\"\n"
            } else {
                "[follower.flat]\n"
            };
            Machine::from_toml("import", &format!("{head}{follower}[cam]\n"), &[]).ok()
        };
        let kept = pairs(&all);
        let Some(smoothed) = program(&format!("{kept}{smooth}")) else {
            let _ = write!(text, "{kept}{smooth}");
            return;
        };
        let Some(smoothed) = smoothed.program() else { return };
        let mut count = 12.min(rows.len());
        let chosen = loop {
            #[expect(clippy::cast_precision_loss, reason = "few points")]
            let angle = |point: usize| rows.fill * point as f64 / count as f64;
            let chosen: Vec<[f64; 2]> =
                (0..count).map(|point| [angle(point), spline::position(smoothed, angle(point))]).collect();
            let made = program(&pairs(&chosen));
            let off = made.as_ref().and_then(Machine::program).map_or(f64::INFINITY, |program| {
                all.iter().map(|[angle, value]| (spline::position(program, *angle) - value).abs()).fold(0.0, f64::max)
            });
            if off <= self.deviation || count >= rows.len() {
                break chosen;
            }
            count = (count + count / 4 + 1).min(rows.len());
        };
        if first.abs() > 1e-12 {
            text.push_str(&begin);
        }
        text.push_str(&pairs(&chosen));
    }
}

/// An angle as it is written.
fn rounded(angle: f64) -> f64 {
    number(angle.to_degrees()).parse::<f64>().unwrap_or(0.0).to_radians()
}

/// A position in mm or degrees as it is written.
fn written(value: f64) -> f64 {
    number(value).parse().unwrap_or(0.0)
}

/// What was found of the law of a segment, after a #.
fn comment(quantity: Quantity, fits: &[(&'static str, super::model::Left)], law: ModelLaw) -> String {
    let words = told_of(quantity, fits, law);
    if words.is_empty() { String::new() } else { format!("  # {words}") }
}

/// "lambda 0.50, 0.8 um rms; cycloidal would be 14 um".
pub(super) fn told_of(quantity: Quantity, fits: &[(&'static str, super::model::Left)], law: ModelLaw) -> String {
    let rms = |value: f64| told(quantity, value);
    match law {
        ModelLaw::Dwell => String::new(),
        ModelLaw::Unknown => match fits.first() {
            Some((name, left)) => format!("no law follows it: the nearest, {name}, would be {} rms", rms(left.rms)),
            None => "no law follows it".into(),
        },
        ModelLaw::Law(law) => {
            let parameter = match law.parameter {
                LawParameter::Inflection(share) => format!("lambda {share:.LISTED$}, "),
                LawParameter::Line(line) => format!("line {line:.LISTED$}, "),
                LawParameter::Ramp(ramp) => format!("ramp {ramp:.LISTED$}, "),
                LawParameter::Usual => {
                    let lambda = law.curve().and_then(|curve| curve.inflection());
                    lambda.map_or(String::new(), |share| format!("lambda {share:.2}, "))
                }
            };
            let Some(own) = fits.first().map(|(_, left)| left.rms) else {
                return parameter.trim_end_matches(", ").to_owned();
            };
            let next = fits.iter().skip(1).find(|(name, _)| *name != law.law.name);
            let next = next.map_or(String::new(), |(name, left)| format!("; {name} would be {}", rms(left.rms)));
            let turns = if law.ends.contains(&SegmentEnd::Turn) { "with a turn, " } else { "" };
            format!("{turns}{parameter}{} rms{next}", rms(own))
        }
    }
}

/// A text in TOML.
pub(super) fn quoted(text: &str) -> String {
    let escaped: String = text
        .chars()
        .map(|c| match c {
            '"' => "\\\"".to_owned(),
            '\\' => "\\\\".to_owned(),
            c if c.is_control() => format!("\\u{:04x}", u32::from(c)),
            c => c.to_string(),
        })
        .collect();
    format!("\"{escaped}\"")
}

/// The lines of each table of dotted keys, those of no table first, then in the order in which they were given.
fn tables(settings: &[(String, String)]) -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = vec![(String::new(), String::new())];
    for (path, value) in settings {
        // A table without keys.
        if value.is_empty() {
            if !all.iter().any(|(other, _)| other == path) {
                all.push((path.clone(), String::new()));
            }
            continue;
        }
        let (table, key) = path.rsplit_once('.').unwrap_or(("", path));
        let line = format!("{key} = {value}\n");
        match all.iter_mut().find(|(other, _)| other == table) {
            Some((_, lines)) => lines.push_str(&line),
            None => all.push((table.to_owned(), line)),
        }
    }
    all
}

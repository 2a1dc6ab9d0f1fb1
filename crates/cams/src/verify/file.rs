//! What a DXF file must be before a follower can be rolled on it: one closed outline in millimetres, on its layer, readable, not duplicated.

use super::check::{Evidence, FileCheck, place};
use crate::check::{Check, CheckExplanation};
use crate::reading::{Chain, FileUnit, INCHES, OUTLINE_LAYER, OutlinePlace, Reading, StrayEntity, few};
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::contour::Edge;
use camgen_kernel::geometry::nearest_points::nearest_distances;
use camgen_kernel::text::{Length, Text, text};
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

pub(super) const LAYER: FileCheck = FileCheck::on_file(
    "layer",
    "",
    "Whether the layer CAM_PROFILE, or that of --layer, where the outline belongs, exists and is not empty. Without it the only closed contour \
     of the file is taken for the outline, with a warning.",
    CheckExplanation {
        bound: Bound::Exactly,
        formula: "the number of layers CAM_PROFILE that are not empty",
        usual: "1, camgen's own rule: its cut files have the outline on CAM_PROFILE",
        change: "put the outline on layer CAM_PROFILE of the file, or give its layer with --layer",
    },
    |evidence| worst_of(evidence, layer),
);

pub(super) const UNITS: FileCheck = FileCheck::on_file(
    "units",
    "mm",
    "Whether the file is in the unit of the design: millimetres, or inches with --units inch or output.units.",
    CheckExplanation {
        bound: Bound::Exactly,
        formula: "$INSUNITS, or $MEASUREMENT, of a DXF file; the length unit of a STEP file",
        usual: "the unit of the design, camgen's own rule: many programs do not look at the unit that a DXF file states",
        change: "save the file in that unit, or give --units inch where it is to be in inches",
    },
    |evidence| {
        let stated =
            evidence.foreign.first().map(|reading| reading.unit).or(evidence.solid.map(|solid| solid.file.unit))?;
        // A STEP file stays in millimetres, whatever the unit of the others.
        let files = if evidence.solid.is_some() { LengthUnit::Millimetre } else { evidence.body.machine().units() };
        Some(unit(stated, files))
    },
);

pub(super) const READABLE: FileCheck = FileCheck::on_file(
    "readable",
    "",
    "How many entities would or might be cut but are not plain curves in the plane of the drawing, without a width.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "the number of such entities",
        usual: "0, camgen's own rule: what a reader cannot place might be cut",
        change: "delete or explode the entities that are named, and save a plain two-dimensional DXF",
    },
    |evidence| worst_of(evidence, |reading| readable(evidence, reading)),
);

pub(super) const DUPLICATES: FileCheck = FileCheck::on_file(
    "duplicates",
    "",
    "How many segments lie on another one or have no length.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "the number of such segments",
        usual: "0, camgen's own rule: a duplicate would be cut twice",
        change: "delete the segments that are named (OVERKILL in AutoCAD)",
    },
    |evidence| worst_of(evidence, |reading| duplicates(evidence, reading)),
);

pub(super) const CONTOURS: FileCheck = FileCheck::on_file(
    "contours",
    "",
    "How many separate contours lie on the layer of the outline; it must be one that goes round the shaft once.",
    CheckExplanation {
        bound: Bound::Exactly,
        formula: "the number of contours after joining ends",
        usual: "1, camgen's own rule: a cam has one outline",
        change: "keep one contour on the layer of the outline; put the rest on other layers",
    },
    |evidence| worst_of(evidence, contours),
);

pub(super) const CLOSED: FileCheck = FileCheck::on_file(
    "closed",
    "mm",
    "The distance between the two ends of the outline.",
    CheckExplanation {
        bound: Bound::AtMost,
        formula: "the distance of the two ends of the outline",
        usual: "a tenth of the tolerance, camgen's own rule",
        change: "join the ends of the outline",
    },
    |evidence| evidence.foreign.iter().filter_map(|reading| closed(evidence, reading)).reduce(worse),
);

/// Most entities that are listed one by one.
const MOST_LISTED: usize = 5;

/// Ends whose distance is up to so many tolerances were meant to be one, for what is advised.
const LOOSE: f64 = 20.0;

/// Ends nearer than this share of the tolerance count as one: programs round coordinates to four to six decimals.
const JOIN_SHARE: f64 = 0.1;

/// Within this distance (mm) the ends of a file are joined, for a tolerance in mm.
#[must_use]
pub fn join_reach(tolerance_mm: f64) -> f64 {
    JOIN_SHARE * tolerance_mm
}

/// The finding on the outline of a file that is worst, the first of equals.
fn worst_of(evidence: &Evidence<'_>, judge: impl Fn(&Reading) -> Finding) -> Option<Finding> {
    evidence.foreign.iter().map(judge).reduce(worse)
}

/// The finding with the worse verdict, the first of equals.
fn worse(first: Finding, next: Finding) -> Finding {
    if next.verdict.rank() < first.verdict.rank() { next } else { first }
}

#[expect(clippy::cast_precision_loss, reason = "counts of things in a file")]
fn count(check: &Check, found: usize, limit: usize, kept: bool, note: Option<String>) -> Finding {
    Finding { note: note.map(Text::from), ..check.found(found as f64, Some(limit as f64), Verdict::of(kept)) }
}

fn layer(reading: &Reading) -> Finding {
    let layers = few(&reading.layers);
    let OutlinePlace::Layer(name) = &reading.outline else {
        let note = format!(
            "layer {OUTLINE_LAYER} is empty or missing: the only closed contour is taken for the outline; the file's layers are: {layers}"
        );
        return Finding { verdict: Verdict::Warn, ..count(&LAYER, 0, 1, false, Some(note)) };
    };
    let there = reading.layers.iter().any(|layer| layer.eq_ignore_ascii_case(name));
    let note = (!there).then(|| {
        let other = if reading.layers.is_empty() { "" } else { "; --layer NAME checks the outline on another layer" };
        format!("layer {name} is empty or missing; the file's layers are: {layers}{other}")
    });
    count(&LAYER, usize::from(there), 1, there, note)
}

fn unit(stated: FileUnit, files: LengthUnit) -> Finding {
    let (verdict, note) = match stated {
        FileUnit::Millimetres if files == LengthUnit::Inch => {
            let why = "the file is in millimetres, and the design has its files in inches";
            (Verdict::Warn, Some(why.to_owned()))
        }
        FileUnit::Millimetres => (Verdict::Pass, None),
        FileUnit::Other(INCHES) if files == LengthUnit::Inch => {
            (Verdict::Pass, Some("the file is in inches, as its design has it".to_owned()))
        }
        FileUnit::Unstated => (Verdict::Info, Some("the file states no unit; read as millimetres".to_owned())),
        FileUnit::UnstatedEnglish => {
            let why = "the file states no unit, and its $MEASUREMENT = 0 stands for inches; read as millimetres";
            (Verdict::Warn, Some(why.to_owned()))
        }
        FileUnit::Other(INCHES) => {
            let why = "the file is in inches, not in millimetres; the other checks are of its true size; where it is to be in inches, give --units inch";
            (Verdict::Fail, Some(why.to_owned()))
        }
        FileUnit::Other(name) => (
            Verdict::Fail,
            Some(format!("the file is in {name}, not in millimetres; the other checks are of its true size")),
        ),
    };
    let found = UNITS.found(1.0, None, verdict);
    let unit = if verdict == Verdict::Pass && files == LengthUnit::Inch { "in".into() } else { found.unit.clone() };
    Finding { unit, note: note.map(Text::from), ..found }
}

fn readable(evidence: &Evidence<'_>, reading: &Reading) -> Finding {
    let (found, information) = (&reading.unreadable, &reading.information);
    let mut notes = listed(found);
    if !information.is_empty() {
        notes.push(format!("on the layer of the outline, not cut: {}", listed(information).join("; ")));
    }
    notes.extend_from_slice(&reading.remarks);
    if reading.splines > 0 {
        notes.push(format!("{} curves were read as arcs", reading.splines));
    }
    if !reading.hidden.is_empty() {
        notes.push(format!("hidden, so not cut: the entities on layer {}", few(&reading.hidden)));
    }
    let finding = count(&READABLE, found.len(), 0, found.is_empty(), (!notes.is_empty()).then(|| notes.join("; ")));
    let doubtful = found.is_empty() && !information.is_empty();
    let verdict = if doubtful { Verdict::Warn } else { finding.verdict };
    let place = found.first().or(information.first()).map(|stray| place(evidence.body, stray.place));
    Finding { verdict, place: place.unwrap_or_default(), ..finding }
}

/// Each entity in words, up to a limit.
fn listed(strays: &[StrayEntity]) -> Vec<String> {
    let mut words: Vec<String> = strays.iter().take(MOST_LISTED).map(ToString::to_string).collect();
    words.extend((strays.len() > MOST_LISTED).then(|| format!("and {} more", strays.len() - MOST_LISTED)));
    words
}

fn duplicates(evidence: &Evidence<'_>, reading: &Reading) -> Finding {
    let found = reading.duplicates.len() + reading.points.len();
    let first = reading.duplicates.first().or(reading.points.first());
    let note = first.map(|_| {
        format!("{} segments lie on another one, {} have no length", reading.duplicates.len(), reading.points.len())
    });
    let finding = count(&DUPLICATES, found, 0, found == 0, note);
    Finding { place: first.map(|point| place(evidence.body, *point)).unwrap_or_default(), ..finding }
}

fn contours(reading: &Reading) -> Finding {
    let found = reading.chains.len();
    let round = match reading.chains.as_slice() {
        [chain] if chain.closed => chain.contour().turns().abs(),
        _ => 1.0,
    };
    let note = if found > 1 && reading.chains.iter().all(|chain| !chain.closed) {
        Some(format!(
            "the outline is in {found} pieces whose ends do not meet, or there is more than the outline on its layer"
        ))
    } else if found > 1 {
        Some("the outline must be one contour; the rest belongs on other layers".to_owned())
    } else if round == 1.0 {
        None
    } else {
        Some(format!("the outline crosses itself: it turns round {round} times"))
    };
    count(&CONTOURS, found, 1, found == 1 && round == 1.0, note)
}

fn closed(evidence: &Evidence<'_>, reading: &Reading) -> Option<Finding> {
    let limit = Some(join_reach(evidence.tolerance_mm));
    let Some((gap, end)) = widest_gap(&reading.chains) else {
        return Some(CLOSED.found(reading.chains.first()?.gap(), limit, Verdict::Pass));
    };
    let missed = Length::mm(gap);
    let note = if gap <= LOOSE * evidence.tolerance_mm {
        text!(
            "the outline is open: ends that should meet miss each other by up to {}; join them, or save the file with more decimals",
            missed
        )
    } else {
        text!("the outline is open: ends that should meet miss each other by up to {}", missed)
    };
    Some(Finding { place: place(evidence.body, end), note: Some(note), ..CLOSED.found(gap, limit, Verdict::Fail) })
}

/// The largest distance of an open end from the nearest other one, and where; `None` where nothing is open.
fn widest_gap(chains: &[Chain]) -> Option<(f64, Vector2<f64>)> {
    let open = chains.iter().filter(|chain| !chain.closed);
    let ends: Vec<Vector2<f64>> = open
        .flat_map(|chain| chain.edges.first().map(Edge::start).into_iter().chain(chain.edges.last().map(Edge::end)))
        .collect();
    let gaps = nearest_distances(&ends).into_iter().zip(ends);
    gaps.max_by(|a, b| a.0.total_cmp(&b.0))
}

//! What a DXF file must be before a follower can be rolled on it: one closed outline in millimetres, on its layer, readable, not duplicated.

use super::check::{Evidence, FileCheck, place};
use crate::check::{Check, CheckExplanation};
use crate::reading::{
    Chain, FileUnit, INCHES, MANY_UNITS, OUTLINE_LAYER, OutlinePlace, Reading, StrayEntity, UNKNOWN_UNIT, few,
};
use crate::report::{Bound, Finding, Verdict};
use camgen_kernel::geometry::contour::Edge;
use camgen_kernel::geometry::nearest_points::nearest_distances;
use camgen_kernel::text::{Length, Text, text};
use camgen_kernel::units::LengthUnit;
use nalgebra::Vector2;

pub(super) const LAYER: FileCheck = FileCheck::on_file(
    "layer",
    "",
    "Whether the outline lies on layer CAM_PROFILE, or that of --layer, and would be cut. Without that layer the outermost closed contour of the \
     file is taken for the outline, with a warning. The check fails where the outline of the cam lies on a layer that is off or frozen, or \
     where something else is on CAM_PROFILE.",
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
    "Whether the file is in the unit of the design: millimetres, or inches with --units inch or output.units. A file in another known unit \
     passes with a warning, because its lengths are converted; one in several units, or in an unknown one, fails.",
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
    "How many segments lie on another one or have no length. Segments that repeat another one to within 2e-6 mm at both ends and between \
     them are a warning, because the part is the same.",
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

/// Segments nearer than this to one that they repeat are the same, mm: two roundings to six decimals.
const SAME_SEGMENT: f64 = 2e-6;

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
    let warned = |note: String| Finding { verdict: Verdict::Warn, ..count(&LAYER, 0, 1, false, Some(note)) };
    let failed = |note: String| count(&LAYER, 0, 1, false, Some(note));
    match &reading.outline {
        OutlinePlace::OnlyContour => warned(format!(
            "layer {OUTLINE_LAYER} is empty or missing: the only closed contour is taken for the outline; the file's layers are: {layers}"
        )),
        OutlinePlace::Outermost(own) => warned(format!(
            "layer {OUTLINE_LAYER} is empty or missing: the outermost closed contour, on layer {own}, is taken for the outline; the file's \
             layers are: {layers}"
        )),
        OutlinePlace::Hidden(own) => failed(format!(
            "the outline lies on a layer that is off or frozen, so it would not be cut: {own}; switch the layer on"
        )),
        OutlinePlace::Elsewhere(own) => failed(format!(
            "the outline lies on layer {own}, and layer {OUTLINE_LAYER} has something else; put the outline on {OUTLINE_LAYER}, or give \
             its layer with --layer"
        )),
        OutlinePlace::OutermostOn(name) => count(
            &LAYER,
            1,
            1,
            true,
            Some(format!(
                "the outermost closed contour on layer {name} is taken for the outline, the others for holes"
            )),
        ),
        OutlinePlace::Layer(name) => {
            let there = reading.layers.iter().any(|layer| layer.eq_ignore_ascii_case(name));
            let note = (!there).then(|| {
                let other =
                    if reading.layers.is_empty() { "" } else { "; --layer NAME checks the outline on another layer" };
                format!("layer {name} is empty or missing; the file's layers are: {layers}{other}")
            });
            count(&LAYER, usize::from(there), 1, there, note)
        }
    }
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
        FileUnit::Other(name @ (MANY_UNITS | UNKNOWN_UNIT)) => {
            (Verdict::Fail, Some(format!("the file is in {name}: its size is not known; save it in millimetres")))
        }
        FileUnit::Other(name) => (
            Verdict::Warn,
            Some(format!(
                "the file is in {name}, not in millimetres; its lengths are converted, and the other checks are of its true size; a program \
                 that does not read the unit cuts it in the wrong size"
            )),
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
    let (repeated, points) = (reading.duplicates.len(), reading.points.len());
    let found = repeated + points;
    let first = reading.duplicates.first().or(reading.points.first());
    let harmless = found > 0 && points == 0 && reading.duplicates_apart <= SAME_SEGMENT;
    let note = first.map(|_| {
        if harmless {
            format!(
                "{repeated} segments repeat another one exactly: the part is the same, but some programs cut them twice"
            )
        } else if reading.duplicates_apart.is_finite() && reading.duplicates_apart > SAME_SEGMENT {
            let apart = reading.duplicates_apart;
            format!("{repeated} segments lie on another one, up to {apart:.6} mm away from it, {points} have no length")
        } else {
            format!("{repeated} segments lie on another one, {points} have no length")
        }
    });
    let finding = count(&DUPLICATES, found, 0, found == 0, note);
    let verdict = if harmless { Verdict::Warn } else { finding.verdict };
    Finding { verdict, place: first.map(|point| place(evidence.body, *point)).unwrap_or_default(), ..finding }
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

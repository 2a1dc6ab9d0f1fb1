//! What a DXF file must be before it can be rolled on: one closed outline in millimetres, on its layer, readable, once.

use super::{Bound, Check, Evidence, Explained, place};
use crate::geometry::contour::Edge;
use crate::reading::{OUTLINE_LAYER, Reading, Stray, Unit, few};
use crate::report::{Finding, Verdict};

pub(super) const LAYER: Check = Check::on_file(
    "layer",
    "Whether the layer CAM_PROFILE, where the outline belongs, exists and is not empty.",
    Explained {
        bound: Bound::Exactly,
        formula: "the number of layers CAM_PROFILE that hold something",
        usual: "camgen's own rule: its cut files have the outline on CAM_PROFILE",
        change: "put the outline on layer CAM_PROFILE of the file",
    },
    |evidence| Some(layer(evidence.foreign?)),
);

pub(super) const UNITS: Check = Check::on_file(
    "units",
    "Whether the file is in millimetres.",
    Explained {
        bound: Bound::Exactly,
        formula: "$INSUNITS, or $MEASUREMENT, of a DXF file; the length unit of a STEP file",
        usual: "camgen's own rule: its files are in millimetres",
        change: "save the file in millimetres, or scale it",
    },
    |evidence| {
        let told = evidence.foreign.map(|reading| reading.unit).or(evidence.solid.map(|solid| solid.file.unit))?;
        Some(unit(told))
    },
);

pub(super) const READABLE: Check = Check::on_file(
    "readable",
    "How many entities would be cut, or may be, and are not lines of no width in one plane.",
    Explained {
        bound: Bound::AtMost,
        formula: "the number of such entities",
        usual: "camgen's own rule: what a reader cannot place may be cut",
        change: "delete or explode the entities that are named, and save a plain two-dimensional DXF",
    },
    |evidence| Some(readable(evidence, evidence.foreign?)),
);

pub(super) const DUPLICATES: Check = Check::on_file(
    "duplicates",
    "How many segments lie on another one or have no length.",
    Explained {
        bound: Bound::AtMost,
        formula: "the number of such segments",
        usual: "camgen's own rule; shops ask for cut files without duplicates, which would be cut twice",
        change: "delete the segments that are named (OVERKILL in AutoCAD)",
    },
    |evidence| Some(duplicates(evidence, evidence.foreign?)),
);

pub(super) const CONTOURS: Check = Check::on_file(
    "contours",
    "How many separate contours lie on the layer of the outline; it must be one that goes round once.",
    Explained {
        bound: Bound::Exactly,
        formula: "the number of contours after joining ends",
        usual: "camgen's own rule: a cam has one outline",
        change: "keep one contour on CAM_PROFILE; put the rest on other layers",
    },
    |evidence| Some(contours(evidence.foreign?)),
);

pub(super) const CLOSED: Check = Check::on_file(
    "closed",
    "How far apart the ends of the outline are.",
    Explained {
        bound: Bound::AtMost,
        formula: "the distance of the two ends of the outline",
        usual: "camgen's own rule: a tenth of the tolerance",
        change: "join the ends of the outline",
    },
    |evidence| closed(evidence, evidence.foreign?),
);

/// Entities that are told one by one.
const MOST_TOLD: usize = 5;

/// Ends nearer than this share of the tolerance are one: programs round coordinates to four to six decimals.
const JOIN_SHARE: f64 = 0.1;

/// Reach (mm) within which ends of a file are joined, for a tolerance in mm.
#[must_use]
pub fn join_reach(tolerance_mm: f64) -> f64 {
    JOIN_SHARE * tolerance_mm
}

#[expect(clippy::cast_precision_loss, reason = "counts of things in a file")]
fn count(check: &Check, found: usize, limit: usize, kept: bool, note: Option<String>) -> Finding {
    Finding { note, ..check.found(found as f64, Some(limit as f64), "", Verdict::of(kept)) }
}

fn layer(reading: &Reading) -> Finding {
    let there = reading.layers.iter().any(|layer| layer.eq_ignore_ascii_case(OUTLINE_LAYER));
    let layers = few(&reading.layers);
    let note = (!there).then(|| format!("nothing lies on layer {OUTLINE_LAYER}; the file's layers are: {layers}"));
    count(&LAYER, usize::from(there), 1, there, note)
}

fn unit(told: Unit) -> Finding {
    let (verdict, note) = match told {
        Unit::Millimetres => (Verdict::Pass, None),
        Unit::Untold => (Verdict::Info, Some("the file states no unit; read as millimetres".to_owned())),
        Unit::Other(name) => (Verdict::Fail, Some(format!("the file is in {name}, not in millimetres"))),
    };
    Finding { note, ..UNITS.found(1.0, None, "mm", verdict) }
}

fn readable(evidence: &Evidence<'_>, reading: &Reading) -> Finding {
    let (found, information) = (&reading.unreadable, &reading.information);
    let mut notes = told(found);
    if !information.is_empty() {
        notes.push(format!("on the layer of the outline, cutting nothing: {}", told(information).join("; ")));
    }
    notes.extend_from_slice(&reading.remarks);
    if reading.splines > 0 {
        notes.push(format!("{} curves were read as arcs", reading.splines));
    }
    if !reading.hidden.is_empty() {
        notes.push(format!("not seen, so not cut: what is hidden on layer {}", few(&reading.hidden)));
    }
    let finding = count(&READABLE, found.len(), 0, found.is_empty(), (!notes.is_empty()).then(|| notes.join("; ")));
    let doubtful = found.is_empty() && !information.is_empty();
    let verdict = if doubtful { Verdict::Warn } else { finding.verdict };
    let place = found.first().or(information.first()).map(|stray| place(evidence.body, stray.place));
    Finding { verdict, place: place.unwrap_or_default(), ..finding }
}

/// Each entity in words, the first of many.
fn told(strays: &[Stray]) -> Vec<String> {
    let mut words: Vec<String> = strays.iter().take(MOST_TOLD).map(ToString::to_string).collect();
    words.extend((strays.len() > MOST_TOLD).then(|| format!("and {} more", strays.len() - MOST_TOLD)));
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
    let note = if found > 1 {
        Some("the outline must be one contour; the rest belongs on other layers".to_owned())
    } else if round == 1.0 {
        None
    } else {
        Some(format!("the outline crosses itself: it turns round {round} times"))
    };
    count(&CONTOURS, found, 1, found == 1 && round == 1.0, note)
}

fn closed(evidence: &Evidence<'_>, reading: &Reading) -> Option<Finding> {
    let open = reading.chains.iter().filter(|chain| !chain.closed).max_by(|a, b| a.gap().total_cmp(&b.gap()));
    let end = open.and_then(|chain| chain.edges.last()).map(Edge::end);
    let gap = open.or(reading.chains.first())?.gap();
    let found = CLOSED.found(gap, Some(join_reach(evidence.tolerance_mm)), "mm", Verdict::of(open.is_none()));
    Some(Finding {
        place: end.map(|point| place(evidence.body, point)).unwrap_or_default(),
        note: open.map(|_| "the outline is open: its ends do not meet".to_owned()),
        ..found
    })
}

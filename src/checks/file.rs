//! The proof for any DXF file: is it one closed outline in millimetres, tangent, and does it give the law?

use super::rolling::{self, Rolled};
use super::{Finding, Subject, Verdict, place, plate, tangency, verdict};
use crate::cam::{Cam, Place};
use crate::reading::{OUTLINE_LAYER, Reading, Unit};

/// Ends nearer than this share of the tolerance are one: programs round coordinates to four to six decimals.
const JOIN_SHARE: f64 = 0.1;

/// Reach (mm) within which ends of a file are joined, for a tolerance in mm.
#[must_use]
pub fn join_reach(tolerance_mm: f64) -> f64 {
    JOIN_SHARE * tolerance_mm
}

/// Checks what was read from a file against a cam; tolerance in mm. The rolling is `None` when there is no single closed
/// outline to roll on.
#[must_use]
pub fn check(cam: &dyn Cam, reading: &Reading, tolerance_mm: f64) -> (Vec<Finding>, Option<Rolled>) {
    let mut findings = vec![layer(reading), unit(reading), readable(reading), duplicates(cam, reading)];
    findings.push(contours(reading));
    findings.extend(closed(cam, reading, tolerance_mm));
    let [chain] = reading.chains.as_slice() else { return (findings, None) };
    if !chain.closed {
        return (findings, None);
    }
    let found = chain.contour();
    // Which way round another program wrote it does not change the metal.
    let outline = if found.area_and_centroid().0 > 0.0 { found } else { chain.reversed().contour() };
    let rolled = rolling::roll(cam, &outline, tolerance_mm);
    let subject = Subject { cam, outline: Some(&outline), rolled: Some(&rolled), balancing: None, tolerance_mm };
    findings.extend(plate::ends(&subject));
    findings.extend(tangency::check(&subject));
    findings.extend(rolling::check(&subject));
    (findings, Some(rolled))
}

#[expect(clippy::cast_precision_loss, reason = "counts of things in a file")]
fn count(check: &'static str, found: usize, limit: usize, kept: bool, note: Option<String>) -> Finding {
    Finding {
        check,
        value: found as f64,
        limit: Some(limit as f64),
        unit: "",
        place: Place::default(),
        verdict: verdict(kept),
        note,
    }
}

fn layer(reading: &Reading) -> Finding {
    let there = reading.layers.iter().any(|layer| layer.eq_ignore_ascii_case(OUTLINE_LAYER));
    let layers = reading.layers.join(", ");
    let note = (!there).then(|| format!("nothing lies on layer {OUTLINE_LAYER}; the file's layers are: {layers}"));
    count("layer", usize::from(there), 1, there, note)
}

fn unit(reading: &Reading) -> Finding {
    let (verdict, note) = match reading.unit {
        Unit::Millimetres => (Verdict::Pass, None),
        Unit::Untold => (Verdict::Info, Some("the file tells no unit; read as millimetres".to_owned())),
        Unit::Other(name) => (Verdict::Fail, Some(format!("the file is in {name}, not in millimetres ($INSUNITS)"))),
    };
    Finding { check: "units", value: 1.0, limit: None, unit: "mm", place: Place::default(), verdict, note }
}

fn readable(reading: &Reading) -> Finding {
    let found = &reading.unreadable;
    let mut notes = Vec::new();
    if !found.is_empty() {
        notes.push(format!("on the layer of the outline, neither arc nor line: {}", found.join(", ")));
    }
    if reading.splines > 0 {
        notes.push(format!("{} splines were read as chords", reading.splines));
    }
    count("readable", found.len(), 0, found.is_empty(), (!notes.is_empty()).then(|| notes.join("; ")))
}

fn duplicates(cam: &dyn Cam, reading: &Reading) -> Finding {
    let found = reading.duplicates.len() + reading.points.len();
    let first = reading.duplicates.first().or(reading.points.first());
    let note = first.map(|_| {
        format!("{} segments lie on another one, {} have no length", reading.duplicates.len(), reading.points.len())
    });
    let finding = count("duplicates", found, 0, found == 0, note);
    Finding { place: first.map_or_else(Place::default, |point| place(cam, *point)), ..finding }
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
    count("contours", found, 1, found == 1 && round == 1.0, note)
}

fn closed(cam: &dyn Cam, reading: &Reading, tolerance_mm: f64) -> Option<Finding> {
    let open = reading.chains.iter().filter(|chain| !chain.closed).max_by(|a, b| a.gap().total_cmp(&b.gap()));
    let end = open.and_then(|chain| chain.segments.last()).map(|segment| segment.end);
    let gap = open.or(reading.chains.first())?.gap();
    Some(Finding {
        check: "closed",
        value: gap,
        limit: Some(join_reach(tolerance_mm)),
        unit: "mm",
        place: end.map_or_else(Place::default, |point| place(cam, point)),
        verdict: verdict(open.is_none()),
        note: open.map(|_| "the outline is open: its ends do not meet".to_owned()),
    })
}

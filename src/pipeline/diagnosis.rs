//! What would explain an outline that is not this cam: mirrored, turned, shifted, scaled, offset, the motion run the other way
//! round, another section, the cam of another speed or of the other end of the bed's stroke; and what remains then.
//!
//! The outline of the file is compared with camgen's own drawing of the cam, contour with contour. Each change is tried alone, and
//! two together where none alone will do.

use super::Cam;
use crate::body::{Body, Drawn, Request};
use crate::geometry::MILLIMETRES;
use crate::geometry::contour::Contour;
use crate::geometry::likeness::{Free, Likeness, Shape};
use crate::linkage::End;
use crate::machine::{Machine, valid_rpm};
use crate::numeric::extremum;
use crate::report::{Finding, Section, Speeds, Verdict};
use serde::Serialize;
use std::f64::consts::{PI, TAU};
use std::fmt;

/// Checks of the outline: when one of them fails, it is asked why.
const OF_THE_OUTLINE: [&str; 3] = ["outline", "rolling", "rolling_flank"];
/// What remains must be this share of what was found, or less; and two changes must leave that share of what one leaves.
const EXPLAINED: f64 = 0.1;
/// The cam is drawn so much finer than the tolerance, but not finer than this, m.
const FINER: f64 = 0.1;
const FINEST: f64 = 1e-8;
/// Other speeds: from a quarter to four times the cam's own, so many of them, then golden sections to 1e-5 of the speed, with
/// outlines drawn to this, m.
const SPEEDS: f64 = 4.0;
const SPEEDS_TRIED: u32 = 24;
const SPEED_SECTIONS: u32 = 20;
const SPEED_TOLERANCE: f64 = 2e-6;
/// A file in inches that was read as millimetres, or the other way round; and how near a factor must be to be called so.
const INCH: f64 = 25.4;
const NEAR: f64 = 1e-4;
/// Share of half a turn within which it is one.
const HALF_TURN: f64 = 1e-6;

/// How the cam is solved from another machine and for another speed.
pub(super) struct Again(pub(super) Box<Resolve>);

/// `None` where there is no such cam.
type Resolve = dyn Fn(&Machine, f64) -> Option<Box<dyn Body>> + Send + Sync;

impl fmt::Debug for Again {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Again")
    }
}

/// One change of the cam.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Change {
    cause: &'static str,
    value: Option<f64>,
    unit: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    x_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    y_mm: Option<f64>,
    #[serde(skip)]
    words: String,
}

/// Changes that make the file's outline of this cam.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct Explanation {
    /// The changes in a word: "mirrored and turned".
    cause: String,
    /// Of the first change that has one.
    value: Option<f64>,
    unit: &'static str,
    changes: Vec<Change>,
    remaining_mm: f64,
}

impl Explanation {
    fn new(changes: Vec<Change>, remaining_mm: f64) -> Self {
        let causes: Vec<&str> = changes.iter().map(|change| change.cause).collect();
        let valued = changes.iter().find(|change| change.value.is_some()).or(changes.first());
        let (value, unit) = valued.map_or((None, ""), |change| (change.value, change.unit));
        Self { cause: causes.join(" and "), value, unit, changes, remaining_mm }
    }

    /// How many of its changes have a value.
    fn numbers(&self) -> usize {
        self.changes.iter().filter(|change| change.value.is_some()).count()
    }

    fn words(&self) -> String {
        let changes: Vec<&str> = self.changes.iter().map(|change| &*change.words).collect();
        format!("It would be this cam {}: {:.4} mm remain", changes.join(" and "), self.remaining_mm)
    }
}

fn change(cause: &'static str, value: Option<f64>, unit: &'static str, words: String) -> Change {
    Change { cause, value, unit, x_mm: None, y_mm: None, words }
}

fn mirrored() -> Change {
    change("mirrored", None, "", "mirrored about X (the other rotation)".into())
}

/// The changes of a likeness, of those that were free.
fn changes(likeness: &Likeness, free: Free) -> Vec<Change> {
    let mut found = Vec::new();
    if free.scale {
        let times = likeness.scale;
        let why = if (times / INCH - 1.0).abs() < NEAR {
            ": millimetres taken for inches"
        } else if (times * INCH - 1.0).abs() < NEAR {
            ": inches taken for millimetres"
        } else {
            ""
        };
        found.push(change("scaled", Some(times), "1", format!("scaled by {times:.7}{why}")));
    }
    if free.turn {
        let turn = likeness.turn - TAU * (likeness.turn / TAU).round();
        // Half a turn is half a turn either way.
        let degrees = if turn < -PI * (1.0 - HALF_TURN) { turn + TAU } else { turn }.to_degrees();
        found.push(change("turned", Some(degrees), "deg", format!("turned by {degrees:.3}°")));
    }
    if free.shift {
        let (x, y) = (likeness.shift.x, likeness.shift.y);
        let words = format!("shifted by {x:.4} mm along X and {y:.4} mm along Y");
        let shifted = change("shifted", Some(likeness.shift.norm()), "mm", words);
        found.push(Change { x_mm: Some(x), y_mm: Some(y), ..shifted });
    }
    if free.offset {
        let way = if likeness.offset < 0.0 { "inward" } else { "outward" };
        let words = format!("offset {way} by {:.4} mm (another roller, a cutter's radius)", likeness.offset.abs());
        found.push(change("offset", Some(likeness.offset), "mm", words));
    }
    found
}

const NONE: Free = Free { turn: false, shift: false, scale: false, offset: false };
const TURN: Free = Free { turn: true, ..NONE };
const SHIFT: Free = Free { shift: true, ..NONE };
const SCALE: Free = Free { scale: true, ..NONE };
const OFFSET: Free = Free { offset: true, ..NONE };
/// The changes that are sought alone, and those sought together.
const ALONE: [Free; 4] = [TURN, SHIFT, SCALE, OFFSET];
const TOGETHER: [Free; 6] = [
    Free { shift: true, ..TURN },
    Free { scale: true, ..TURN },
    Free { offset: true, ..TURN },
    Free { shift: true, ..SCALE },
    Free { offset: true, ..SHIFT },
    Free { offset: true, ..SCALE },
];

/// The outline of a section (rpm; `None` for a body whose sections are all alike) as drawn to a tolerance, m.
fn drawn(body: &dyn Body, section: Option<f64>, tolerance: f64) -> Option<Contour> {
    let drawn = body.draw(&Request::within(tolerance)).ok()?;
    of_section(&drawn, section).cloned()
}

fn of_section(drawn: &Drawn, section: Option<f64>) -> Option<&Contour> {
    let part = drawn.parts.iter().find(|part| section.is_none() || part.rpm == section || drawn.parts.len() == 1);
    part.map(|part| &part.outline.contour)
}

/// The search for explanations.
struct Search<'a> {
    cam: &'a Cam,
    section: Option<f64>,
    model: Shape,
    mirrored: Shape,
    found: Shape,
    /// Tolerance of the check, m.
    tolerance: f64,
    /// Distance between the outlines as they are, mm.
    distance: f64,
    explanations: Vec<Explanation>,
}

/// Why an outline that failed its check is not this cam: a section of the report; `None` when no check of the outline failed, or
/// there is nothing to compare with.
pub(super) fn of(
    cam: &Cam,
    section: Option<f64>,
    found: Option<&Contour>,
    (checks, tolerance): (&[Finding], f64),
) -> Option<Section> {
    let of_outline = |finding: &&Finding| OF_THE_OUTLINE.contains(&&*finding.check);
    if !checks.iter().filter(of_outline).any(|finding| finding.verdict == Verdict::Fail) {
        return None;
    }
    let fine = (FINER * tolerance).max(FINEST);
    let own = drawn(cam.body(), section, fine).or_else(|| drawn(cam.body(), section, tolerance))?;
    let (model, mirrored) = (Shape::new(&own)?, Shape::new(&own.mirrored_about_x())?);
    let found = Shape::new(found?)?;
    let distance = model.remaining(&found, &Likeness::SAME);
    let mut search = Search { cam, section, model, mirrored, found, tolerance, distance, explanations: Vec::new() };
    search.alone();
    search.other_sections();
    search.reversed();
    search.other_end();
    search.other_speeds();
    search.together();
    Some(search.told())
}

impl Search<'_> {
    /// Notes an explanation, if it is one.
    fn consider(&mut self, changes: Vec<Change>, remaining: f64) {
        if remaining <= EXPLAINED * self.distance {
            self.explanations.push(Explanation::new(changes, remaining));
        }
    }

    fn best(&self) -> f64 {
        self.explanations.iter().map(|found| found.remaining_mm).fold(self.distance, f64::min)
    }

    /// Each change for itself.
    fn alone(&mut self) {
        let remaining = self.mirrored.remaining(&self.found, &Likeness::SAME);
        self.consider(vec![mirrored()], remaining);
        for free in ALONE {
            let likeness = self.model.likeness(&self.found, free);
            let remaining = self.model.remaining(&self.found, &likeness);
            self.consider(changes(&likeness, free), remaining);
        }
    }

    /// Two changes at once, where they leave much less than one.
    fn together(&mut self) {
        let best = self.best();
        // Both outlines may be off by the tolerance.
        if best <= 2.0 * MILLIMETRES * self.tolerance {
            return;
        }
        let mirrored_too = ALONE.map(|free| (true, free));
        for (mirror, free) in mirrored_too.into_iter().chain(TOGETHER.map(|free| (false, free))) {
            let model = if mirror { &self.mirrored } else { &self.model };
            let likeness = model.likeness(&self.found, free);
            let remaining = model.remaining(&self.found, &likeness);
            if remaining <= EXPLAINED * best {
                let first = if mirror { vec![mirrored()] } else { Vec::new() };
                self.consider(first.into_iter().chain(changes(&likeness, free)).collect(), remaining);
            }
        }
    }

    /// The outlines of a conoid's other sections.
    fn other_sections(&mut self) {
        let Some(section) = self.section else { return };
        let Ok(all) = self.cam.body().draw(&Request::within(self.tolerance)) else { return };
        for part in all.parts.iter().filter(|part| part.rpm != Some(section)) {
            let (Some(rpm), Some(other)) = (part.rpm, Shape::new(&part.outline.contour)) else { continue };
            let remaining = other.remaining(&self.found, &Likeness::SAME);
            let words = format!("in its section for {rpm} rpm");
            self.consider(vec![change("section", Some(rpm), "rpm", words)], remaining);
        }
    }

    /// The motion run the other way round on a follower whose path does not go through the shaft; on one whose path does, that is
    /// the mirrored cam.
    fn reversed(&mut self) {
        let opposite = self.cam.body().machine().with_opposite_offset();
        let (Some(machine), Some(rpm)) = (opposite, self.speed()) else { return };
        let other = self.solved(&machine, rpm, FINER * self.tolerance);
        if let Some(other) = other.and_then(|contour| Shape::new(&contour.mirrored_about_x())) {
            let remaining = other.remaining(&self.found, &Likeness::SAME);
            self.consider(
                vec![change("reversed", None, "", "with its motion run the other way round".into())],
                remaining,
            );
        }
    }

    /// The cam of the other end of the bed's stroke.
    fn other_end(&mut self) {
        let machine = self.cam.body().machine();
        let other = machine.end().map(End::other).and_then(|end| machine.clone().at_end(end).ok().zip(Some(end)));
        let (Some((machine, end)), Some(rpm)) = (other, self.speed()) else { return };
        if let Some(shape) = self.solved(&machine, rpm, FINER * self.tolerance).and_then(|own| Shape::new(&own)) {
            let remaining = shape.remaining(&self.found, &Likeness::SAME);
            let words = format!("for the {} end of the stroke (--end {})", end.word(), end.word());
            self.consider(vec![change("end", None, "", words)], remaining);
        }
    }

    /// The cam's one speed, rpm.
    fn speed(&self) -> Option<f64> {
        match self.cam.body().speeds() {
            Speeds::One(rpm) => Some(rpm),
            _ => None,
        }
    }

    fn solved(&self, machine: &Machine, rpm: f64, tolerance: f64) -> Option<Contour> {
        let body = (self.cam.again.as_ref()?.0)(machine, rpm)?;
        drawn(&*body, None, tolerance.max(FINEST))
    }

    /// The cam of another speed.
    fn other_speeds(&mut self) {
        let Some(rpm) = self.speed().filter(|_| self.cam.again.is_some()) else { return };
        let machine = self.cam.body().machine();
        let nearness = |logarithm: f64| {
            let other = valid_rpm(libm::exp(logarithm)).ok();
            let contour = other.and_then(|other| self.solved(machine, other, SPEED_TOLERANCE));
            contour
                .and_then(|contour| Shape::new(&contour))
                .map_or(f64::NEG_INFINITY, |s| -s.mean_distance(&self.found))
        };
        let (own, wide) = (libm::log(rpm), libm::log(SPEEDS));
        let best = extremum::largest_without_slope(nearness, (own - wide, own + wide), SPEEDS_TRIED, SPEED_SECTIONS);
        let other = libm::exp(best.at);
        let outline = self.solved(machine, other, FINER * self.tolerance);
        if let Some(shape) = outline.and_then(|contour| Shape::new(&contour)) {
            let remaining = shape.remaining(&self.found, &Likeness::SAME);
            self.consider(vec![change("speed", Some(other), "rpm", format!("for {other:.3} rpm"))], remaining);
        }
    }

    /// The explanations, best first: within the tolerance the simpler one is the better, and one that fits no number of its own: a
    /// symmetric motion run the other way round is the cam turned by some angle too.
    fn told(mut self) -> Section {
        let worth = |found: &Explanation| found.remaining_mm.max(MILLIMETRES * self.tolerance);
        self.explanations.sort_by(|a, b| {
            let simpler = a.changes.len().cmp(&b.changes.len()).then(a.numbers().cmp(&b.numbers()));
            worth(a).total_cmp(&worth(b)).then(simpler).then(a.remaining_mm.total_cmp(&b.remaining_mm))
        });
        // One that leaves many times more than the best is no explanation beside it.
        let most = self.explanations.first().map_or(0.0, |best| worth(best) / EXPLAINED);
        self.explanations.retain(|found| found.remaining_mm <= most);
        let words = match self.explanations.as_slice() {
            [] => vec![format!(
                "the outline is {:.4} mm off; neither mirrored, turned, shifted, scaled, offset nor at another speed is it this cam",
                self.distance
            )],
            all => all.iter().map(Explanation::words).collect(),
        };
        Section::new("diagnosis", &self.explanations).with_words(words)
    }
}

//! What would explain an outline that is not this cam: mirrored, turned, shifted, scaled, offset, the motion reversed, another
//! section, the cam of another speed or of the other end of the bed's stroke, bulges that a program wrote wrongly; and the distance that
//! remains then.
//!
//! The outline of the file is compared with camgen's own drawing of the cam, contour with contour. Each change is tried alone, two
//! together where a single one is not enough, and a mirror image with two more. A change is a cause only where it leaves no more than the
//! tolerance: one that leaves more would send whoever reads it to the wrong setting.

use super::Cam;
use crate::body::{Body, Request};
use crate::machine::{Machine, valid_rpm};
use crate::report::{Finding, Section, Speeds, Verdict};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::{Contour, Edge, Segment, Vertex};
use camgen_kernel::geometry::registration::{FreeParameters, Registration, RegistrationOutline};
use camgen_kernel::numeric::extremum;
use nalgebra::Vector2;
use serde::Serialize;
use std::f64::consts::{PI, TAU};
use std::fmt;
use std::sync::Arc;

/// Checks of the outline: when one of them fails, it is asked why.
const OF_THE_OUTLINE: [&str; 4] = ["outline", "rolling", "rolling_flank", PROGRAM];
const PROGRAM: &str = "program";
/// What remains must be this share of what was found, or less; and two changes must leave that share of what one leaves. Within the
/// tolerance a larger share is enough: the outline of the file is itself off by as much.
const EXPLAINED: f64 = 0.1;
const EXPLAINED_WITHIN: f64 = 0.5;
/// An outline that is off by less than this many tolerances may be so for a cause that its own errors hide.
const TELLING: f64 = 3.0;
/// A cause may leave the tolerance, which the file may use up, and this share of it: the drawing that the file is compared with is off by
/// [`FINER`], and the fit of a change ends near the best one, not at it.
const FIT_SHARE: f64 = 0.25;
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

/// Solves the cam for another machine and for another speed.
#[derive(Clone)]
pub(super) struct Resolver {
    pub(super) solve: Arc<Resolve>,
    /// The other machines whose cam a file may be.
    pub(super) alternatives: fn(&Machine) -> Vec<Alternative>,
}

/// `None` where there is no such cam.
type Resolve = dyn Fn(&Machine, f64) -> Option<Box<dyn Body>> + Send + Sync;

/// Another machine whose cam a file may be.
#[derive(Debug)]
pub struct Alternative {
    /// What differs, in a word.
    pub cause: &'static str,
    /// The text that follows "it would be this cam".
    pub words: String,
    /// The machine.
    pub machine: Machine,
}

impl fmt::Debug for Resolver {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Resolver")
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
    /// Value of the first change that has one.
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

    /// In words.
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

fn mirrored_about_y() -> Change {
    change("mirrored about Y", None, "", "mirrored about Y (seen from the other side)".into())
}

/// A contour turned by half a turn about the origin.
fn half_turned(contour: &Contour) -> Contour {
    let turned = |edge: Edge| match edge {
        Edge::Segment(Segment { start, end, bulge }) => Edge::Segment(Segment { start: -start, end: -end, bulge }),
        Edge::Cubic(cubic) => Edge::Cubic(cubic.mapped(|point| -point)),
    };
    Contour::from_edges(contour.edges().map(turned))
}

/// The changes of a registration, of those that were free.
fn changes(registration: &Registration, free: FreeParameters) -> Vec<Change> {
    let mut found = Vec::new();
    if free.scale {
        let times = registration.scale;
        let words = if (times / INCH - 1.0).abs() < NEAR {
            "scaled by 25.4 (millimetres taken for inches)".to_owned()
        } else if (times * INCH - 1.0).abs() < NEAR {
            "scaled by 1/25.4 (inches taken for millimetres)".to_owned()
        } else {
            format!("scaled by {times:.7}")
        };
        found.push(change("scaled", Some(times), "1", words));
    }
    if free.turn {
        let turn = registration.turn - TAU * (registration.turn / TAU).round();
        // Half a turn is half a turn either way.
        let degrees = if turn < -PI * (1.0 - HALF_TURN) { turn + TAU } else { turn }.to_degrees();
        found.push(change("turned", Some(degrees), "deg", format!("turned by {degrees:.3}°")));
    }
    if free.shift {
        let (x, y) = (registration.shift.x, registration.shift.y);
        let words = format!("shifted by {x:.4} mm along X and {y:.4} mm along Y");
        let shifted = change("shifted", Some(registration.shift.norm()), "mm", words);
        found.push(Change { x_mm: Some(x), y_mm: Some(y), ..shifted });
    }
    if free.offset {
        let way = if registration.offset < 0.0 { "inward" } else { "outward" };
        let words = format!("offset {way} by {:.4} mm (another roller, a cutter's radius)", registration.offset.abs());
        found.push(change("offset", Some(registration.offset), "mm", words));
    }
    found
}

const NONE: FreeParameters = FreeParameters { turn: false, shift: false, scale: false, offset: false };
const TURN: FreeParameters = FreeParameters { turn: true, ..NONE };
const SHIFT: FreeParameters = FreeParameters { shift: true, ..NONE };
const SCALE: FreeParameters = FreeParameters { scale: true, ..NONE };
const OFFSET: FreeParameters = FreeParameters { offset: true, ..NONE };
/// The changes that are sought alone, and those sought together.
const ALONE: [FreeParameters; 4] = [TURN, SHIFT, SCALE, OFFSET];
const TOGETHER: [FreeParameters; 6] = [
    FreeParameters { shift: true, ..TURN },
    FreeParameters { scale: true, ..TURN },
    FreeParameters { offset: true, ..TURN },
    FreeParameters { shift: true, ..SCALE },
    FreeParameters { offset: true, ..SHIFT },
    FreeParameters { offset: true, ..SCALE },
];

/// The outline of a cut as drawn to a tolerance, m.
pub(super) fn drawn(body: &dyn Body, cut: usize, tolerance: f64) -> Option<Contour> {
    let drawn = body.draw(&Request::within(tolerance)).ok()?;
    drawn.outlines().nth(cut).map(|(.., outline)| outline.contour.clone())
}

/// So many points show an outline well enough.
const ENOUGH: usize = 8;

/// Most straight segments of an outline of which each may be an arc that was lost: a plate has a few, a polyline of chords thousands.
const MOST_LINES: usize = 16;

/// A contour with its bulges as they were before a known fault of a program, each with the cause and with words for the fault.
fn misread_bulges(contour: &Contour) -> Vec<(Contour, &'static str, String)> {
    let Some(segments) = contour.segments() else { return Vec::new() };
    let count = segments.len();
    let with = |bulge: &dyn Fn(usize) -> f64| Contour {
        vertices: segments.iter().enumerate().map(|(i, segment)| Vertex::new(segment.start, bulge(i))).collect(),
    };
    let of = |index: usize| segments.get(index % count).map_or(0.0, |segment| segment.bulge);
    let inverted =
        "with every arc bulged to the other side: all vertices lie on it, and the bulges have the wrong sign";
    let mut mended = vec![(with(&|i| -of(i)), "bulges inverted", inverted.to_owned())];
    // A reversed polyline keeps the bulge of a segment at its other end, with the other sign.
    for (ahead, sign) in [(1, -1.0), (1, 1.0), (count.saturating_sub(1), -1.0), (count.saturating_sub(1), 1.0)] {
        let (kept, to) = (if sign < 0.0 { "inverted and " } else { "" }, if ahead == 1 { "before" } else { "after" });
        let words = format!(
            "with each bulge {kept}at the vertex {to}: all vertices lie on it, and its polyline was reversed without its bulges"
        );
        mended.push((with(&|i| sign * of(i + ahead)), "polyline reversed", words));
    }
    let lines: Vec<usize> = (0..count).filter(|index| of(*index) == 0.0).collect();
    for line in lines.iter().copied().filter(|_| lines.len() <= MOST_LINES) {
        let before = segments.get((line + count.saturating_sub(1)) % count);
        let (Some(before), Some(segment)) = (before, segments.get(line)) else { continue };
        // The arc that goes on in the direction of the segment before turns by twice the angle to its chord.
        let (tangent, chord) = (before.end_tangent(), segment.end - segment.start);
        let bulge = libm::tan(0.5 * libm::atan2(tangent.perp(&chord), tangent.dot(&chord)));
        let last = if line + 1 == count { "the closing segment" } else { "the segment" };
        let words = format!(
            "with {last} from ({:.3}, {:.3}) mm as an arc of bulge {bulge:.6}: it is a straight line in the file, its bulge was lost",
            segment.start.x, segment.start.y
        );
        mended.push((with(&|i| if i == line { bulge } else { of(i) }), "bulge lost", words));
    }
    mended
}

/// Which mirror image of the cam is compared.
#[derive(Debug, Clone, Copy)]
enum Mirror {
    None,
    AboutX,
    AboutY,
}

/// The search for explanations.
struct Search<'a> {
    cam: &'a Cam,
    cut: usize,
    /// Speed of the section, rpm, where there are several.
    section: Option<f64>,
    model: RegistrationOutline,
    mirrored: RegistrationOutline,
    mirrored_about_y: RegistrationOutline,
    found: RegistrationOutline,
    /// The outline of the file as it was read.
    contour: &'a Contour,
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
    (cut, section): (usize, Option<f64>),
    found: Option<&Contour>,
    (checks, tolerance): (&[Finding], f64),
) -> Option<Section> {
    let of_outline = |finding: &&Finding| OF_THE_OUTLINE.contains(&&*finding.check);
    if !checks.iter().filter(of_outline).any(|finding| finding.verdict == Verdict::Fail) {
        return None;
    }
    let fine = (FINER * tolerance).max(FINEST);
    let own = drawn(cam.body(), cut, fine).or_else(|| drawn(cam.body(), cut, tolerance))?;
    let (model, mirrored) = (RegistrationOutline::new(&own)?, RegistrationOutline::new(&own.mirrored_about_x())?);
    let mirrored_about_y = RegistrationOutline::new(&half_turned(&own.mirrored_about_x()))?;
    let contour = found?;
    let found = RegistrationOutline::new(contour)?;
    let distance = model.remaining(&found, &Registration::SAME);
    let mut search = Search {
        cam,
        cut,
        section,
        model,
        mirrored,
        mirrored_about_y,
        found,
        contour,
        tolerance,
        distance,
        explanations: Vec::new(),
    };
    search.alone();
    search.bulges();
    search.straightened();
    search.other_sections();
    search.reversed();
    search.other_machines();
    search.other_speeds();
    search.together();
    // A program may fail by more than what it cuts.
    let unexplained = search.explanations.is_empty() || search.distance <= MILLIMETRES * tolerance;
    let of_program = checks.iter().any(|finding| finding.check == PROGRAM);
    (!(of_program && unexplained)).then(|| search.section())
}

impl Search<'_> {
    /// Notes an explanation, if it is one.
    fn consider(&mut self, changes: Vec<Change>, remaining: f64) {
        let within = (EXPLAINED_WITHIN * self.distance).min(MILLIMETRES * self.tolerance);
        if remaining <= within.max(EXPLAINED * self.distance) {
            self.explanations.push(Explanation::new(changes, remaining));
        }
    }

    fn best(&self) -> f64 {
        self.explanations.iter().map(|found| found.remaining_mm).fold(self.distance, f64::min)
    }

    /// Each change for itself.
    fn alone(&mut self) {
        let remaining = self.mirrored.remaining(&self.found, &Registration::SAME);
        self.consider(vec![mirrored()], remaining);
        let remaining = self.mirrored_about_y.remaining(&self.found, &Registration::SAME);
        self.consider(vec![mirrored_about_y()], remaining);
        for free in ALONE {
            let registration = self.model.registration(&self.found, free);
            let remaining = self.model.remaining(&self.found, &registration);
            self.consider(changes(&registration, free), remaining);
        }
    }

    /// Faults of programs that write polylines: the outline as it would be without them.
    fn bulges(&mut self) {
        for (mended, cause, words) in misread_bulges(self.contour) {
            // Wrong bulges may have turned the sense of what they enclose.
            let mended = if mended.area_and_centroid().0 < 0.0 { mended.reversed() } else { mended };
            if let Some(mended) = RegistrationOutline::new(&mended) {
                let remaining = self.model.remaining(&mended, &Registration::SAME);
                self.consider(vec![change(cause, None, "", words)], remaining);
            }
        }
    }

    /// Straight segments between vertices that lie on the outline: whatever the arcs were, they were lost. Arcs that are left lie on it as well.
    fn straightened(&mut self) {
        let Some(segments) = self.contour.segments() else { return };
        let straight = segments.iter().filter(|segment| segment.bulge == 0.0).count();
        let of_arcs = segments.iter().filter(|segment| segment.bulge != 0.0).map(|arc| arc.point_and_tangent(0.5).0);
        let points: Vec<Vector2<f64>> = segments.iter().map(|segment| segment.start).chain(of_arcs).collect();
        let remaining = self.model.farthest(&points);
        if straight > 0 && points.len() >= ENOUGH && self.explanations.is_empty() {
            let words = format!(
                "with its {straight} straight segments as arcs: all vertices lie on it, and the bulges of its arcs were lost, or chords were \
                 drawn for them"
            );
            self.consider(vec![change("bulges lost", None, "", words)], remaining);
        }
    }

    /// What a cause may leave, mm.
    fn explained(&self) -> f64 {
        (1.0 + FIT_SHARE) * MILLIMETRES * self.tolerance
    }

    /// Two changes at once, where they leave much less than one; a mirror image with two more where that is not enough.
    fn together(&mut self) {
        let best = self.best();
        if best <= self.explained() {
            return;
        }
        // With a turn the two mirror images are one.
        let about_y = |all: &[FreeParameters]| -> Vec<(Mirror, FreeParameters)> {
            all.iter().filter(|free| !free.turn).map(|free| (Mirror::AboutY, *free)).collect()
        };
        self.several(best, &about_y(&ALONE));
        self.several(best, &ALONE.map(|free| (Mirror::AboutX, free)));
        self.several(best, &TOGETHER.map(|free| (Mirror::None, free)));
        if self.best() > self.explained() {
            self.several(best, &about_y(&TOGETHER));
            self.several(best, &TOGETHER.map(|free| (Mirror::AboutX, free)));
        }
    }

    /// Several changes at once, noted where they leave much less than `best`.
    fn several(&mut self, best: f64, all: &[(Mirror, FreeParameters)]) {
        for (mirror, free) in all {
            let (model, first) = match mirror {
                Mirror::None => (&self.model, None),
                Mirror::AboutX => (&self.mirrored, Some(mirrored())),
                Mirror::AboutY => (&self.mirrored_about_y, Some(mirrored_about_y())),
            };
            let registration = model.registration(&self.found, *free);
            let remaining = model.remaining(&self.found, &registration);
            if remaining <= EXPLAINED * best {
                self.consider(first.into_iter().chain(changes(&registration, *free)).collect(), remaining);
            }
        }
    }

    /// The outlines of a conoid's other sections.
    fn other_sections(&mut self) {
        let Some(section) = self.section else { return };
        let Ok(all) = self.cam.body().draw(&Request::within(self.tolerance)) else { return };
        for part in all.parts.iter().filter(|part| part.rpm != Some(section)) {
            let (Some(rpm), Some(other)) = (part.rpm, RegistrationOutline::new(&part.outline.contour)) else {
                continue;
            };
            let remaining = other.remaining(&self.found, &Registration::SAME);
            let words = format!("in its section for {rpm} rpm");
            self.consider(vec![change("section", Some(rpm), "rpm", words)], remaining);
        }
    }

    /// The reversed motion on a follower whose path does not go through the shaft; on one whose path does, that is
    /// the mirrored cam.
    fn reversed(&mut self) {
        let opposite = self.cam.body().machine().with_opposite_offset();
        let (Some(machine), Some(rpm)) = (opposite, self.speed()) else { return };
        let other = self.solved(&machine, rpm, FINER * self.tolerance);
        if let Some(other) = other.and_then(|contour| RegistrationOutline::new(&contour.mirrored_about_x())) {
            let remaining = other.remaining(&self.found, &Registration::SAME);
            self.consider(vec![change("reversed", None, "", "with its motion reversed".into())], remaining);
        }
    }

    /// The cams of other machines that are known to be mistaken for this one.
    fn other_machines(&mut self) {
        let (Some(resolver), Some(rpm)) = (&self.cam.resolver, self.speed()) else { return };
        for Alternative { cause, words, machine } in (resolver.alternatives)(self.cam.body().machine()) {
            if let Some(shape) =
                self.solved(&machine, rpm, FINER * self.tolerance).and_then(|own| RegistrationOutline::new(&own))
            {
                let remaining = shape.remaining(&self.found, &Registration::SAME);
                self.consider(vec![change(cause, None, "", words)], remaining);
            }
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
        let body = (self.cam.resolver.as_ref()?.solve)(machine, rpm)?;
        drawn(&*body, self.cut, tolerance.max(FINEST))
    }

    /// The cam of another speed.
    fn other_speeds(&mut self) {
        let Some(rpm) = self.speed().filter(|_| self.cam.resolver.is_some()) else { return };
        let machine = self.cam.body().machine();
        let nearness = |logarithm: f64| {
            let other = valid_rpm(libm::exp(logarithm)).ok();
            let contour = other.and_then(|other| self.solved(machine, other, SPEED_TOLERANCE));
            contour
                .and_then(|contour| RegistrationOutline::new(&contour))
                .map_or(f64::NEG_INFINITY, |s| -s.mean_distance(&self.found))
        };
        let (own, wide) = (libm::log(rpm), libm::log(SPEEDS));
        let best = extremum::largest_without_slope(nearness, (own - wide, own + wide), SPEEDS_TRIED, SPEED_SECTIONS);
        let other = libm::exp(best.at);
        let outline = self.solved(machine, other, FINER * self.tolerance);
        if let Some(shape) = outline.and_then(|contour| RegistrationOutline::new(&contour)) {
            let remaining = shape.remaining(&self.found, &Registration::SAME);
            self.consider(vec![change("speed", Some(other), "rpm", format!("for {other:.3} rpm"))], remaining);
        }
    }

    /// The explanations, best first: within the tolerance the simpler one is the better, and one that fits no number of its own: a
    /// reversed symmetric motion is also the cam turned by some angle.
    fn section(mut self) -> Section {
        let explained = self.explained();
        self.explanations.retain(|found| found.remaining_mm <= explained);
        let worth = |found: &Explanation| found.remaining_mm.max(MILLIMETRES * self.tolerance);
        self.explanations.sort_by(|a, b| {
            let simpler = a.changes.len().cmp(&b.changes.len()).then(a.numbers().cmp(&b.numbers()));
            worth(a).total_cmp(&worth(b)).then(simpler).then(a.remaining_mm.total_cmp(&b.remaining_mm))
        });
        // One that leaves many times more than the best is not an explanation.
        let most = self.explanations.first().map_or(0.0, |best| worth(best) / EXPLAINED);
        self.explanations.retain(|found| found.remaining_mm <= most);
        let words = match self.explanations.as_slice() {
            [] if self.distance < TELLING * MILLIMETRES * self.tolerance => {
                vec![format!(
                    "the outline is {:.4} mm off, which is too little compared with the tolerance to tell why",
                    self.distance
                )]
            }
            [] => vec![format!(
                "the outline is {:.4} mm off; it is not this cam mirrored, turned, shifted, scaled, offset or for another speed, and its \
                 bulges are not those of this cam inverted, lost or at other vertices",
                self.distance
            )],
            all => all.iter().map(Explanation::words).collect(),
        };
        Section::new("diagnosis", &self.explanations).with_words(words)
    }
}

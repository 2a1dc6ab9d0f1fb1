//! A figure that a check judges, and how the figures of a body are collected.

use super::Check;
use crate::machine::Machine;
use crate::report::{Bound, Fact, Finding, Place, Rolled, Topic, Verdict};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::profile::{Curves, Worst};
use camgen_kernel::text::Text;

/// A figure that a check judges.
#[derive(Debug, Clone)]
pub struct Measure {
    /// The check.
    pub check: &'static Check,
    /// The figure.
    pub value: f64,
    /// The limit, where there is one.
    pub limit: Option<f64>,
    /// Where it is.
    pub place: Place,
    /// A note on it, and a change that would keep the limit.
    pub note: Option<Text>,
    /// The name of the finding for people, where it is another than that of the check.
    pub named: Option<&'static str>,
    /// What a summary says of it among its facts.
    pub fact: Option<Fact>,
    /// What its verdict rests on without having been given.
    pub assumes: Option<Text>,
    /// The data that the check needs and that are missing: why it was not run.
    pub missing: Option<String>,
    /// The verdict of a check that does not judge by its bound alone.
    pub verdict: Option<Verdict>,
}

impl PartialEq for Measure {
    fn eq(&self, other: &Self) -> bool {
        let all = |of: &Self| (of.check.name, of.value, of.limit, of.place, of.verdict);
        all(self) == all(other) && self.note == other.note
    }
}

impl Measure {
    /// With this verdict.
    #[must_use]
    pub fn judged(self, verdict: Verdict) -> Self {
        Self { verdict: Some(verdict), ..self }
    }

    /// Passed or failed.
    #[must_use]
    pub fn kept(self, kept: bool) -> Self {
        self.judged(Verdict::of(kept))
    }

    /// With a note, where there is one.
    #[must_use]
    pub fn noted(self, note: impl Into<Text>) -> Self {
        Self { note: Some(note.into()).filter(|note| !note.is_empty()), ..self }
    }

    /// With a line of a summary.
    #[must_use]
    pub fn with_fact(self, topic: Topic, text: impl Into<Text>) -> Self {
        Self { fact: Some(Fact::new(topic, text)), ..self }
    }

    /// With what its verdict rests on without having been given.
    #[must_use]
    pub fn assuming(self, assumed: impl Into<Text>) -> Self {
        Self { assumes: Some(assumed.into()).filter(|assumed| !assumed.is_empty()), ..self }
    }

    /// At a place.
    #[must_use]
    pub fn placed(self, place: Place) -> Self {
        Self { place, ..self }
    }

    /// At a worst place of a body, with its place along the axis before the note.
    #[must_use]
    pub fn at(self, subject: &Subject<'_>, worst: &Worst) -> Self {
        let (place, along) = (subject.at)(worst);
        let note = Text::joined(along.into_iter().chain(self.note), "; ");
        Self { place, note: (!note.is_empty()).then_some(note), ..self }
    }

    /// The finding of its check.
    #[must_use]
    pub fn finding(&self) -> Finding {
        let value = self.value;
        // What is not a number keeps no limit.
        let kept = |limit: f64| match self.check.explained.bound {
            Bound::AtMost => value <= limit,
            Bound::AtLeast => value >= limit,
            Bound::Above => value > limit,
            Bound::Exactly => value == limit,
        };
        let by_bound = || self.limit.map_or(Verdict::Info, |limit| Verdict::of(kept(limit)));
        let found = self.check.found(value, self.limit, self.verdict.unwrap_or_else(by_bound));
        Finding {
            place: self.place,
            note: self.note.clone(),
            named: self.named,
            fact: self.fact.clone(),
            assumes: self.assumes.clone(),
            missing: self.missing.clone(),
            ..found
        }
    }
}

/// The body of a figure, as far as checks need it.
pub struct Subject<'a> {
    /// Its machine, with the limits.
    pub machine: &'a Machine,
    /// Motion and follower of a cam whose section does not change along its axis.
    pub curves: Option<Curves<'a>>,
    /// Angular speed of its shaft, rad/s, where it is known.
    pub speed: Option<f64>,
    /// A worst place for a report, and words on where it lies along the axis.
    pub at: &'a dyn Fn(&Worst) -> (Place, Option<Text>),
    /// A change of the size with which every limit is kept, tried before it is named; or the reason why there is no such change.
    pub remedy: &'a dyn Fn() -> Option<Text>,
}

impl Subject<'_> {
    /// Whether the forces of a motion program are those without the inertia of a mass that is given, since no speed is.
    pub(super) fn lacks_inertia(&self) -> bool {
        // A body without plane curves, a barrel or a globoid, is that of a program.
        let of_program = self.curves.is_none_or(|curves| curves.motion.program().is_some());
        of_program && self.machine.follower.mass.is_some() && self.speed.is_none()
    }
}

/// The written outline, as far as it is known when figures are taken.
#[derive(Debug, Clone, Copy)]
pub struct AsWritten<'a> {
    /// What rolling on the written outline has shown.
    pub rolled: Option<&'a Rolled>,
    /// The outlines, in the order of the cuts of the body, mm.
    pub outlines: &'a [&'a Contour],
    /// Whether somebody else may have written it.
    pub foreign: bool,
    /// Tolerance of the outline, mm.
    pub tolerance_mm: f64,
    /// Metal between what is cut.
    pub walls: Walls,
    /// Largest length or width of an outline, mm.
    pub size_mm: Option<f64>,
}

/// A thinnest place between what is cut.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wall {
    /// The metal there, mm; negative where the cuts overlap.
    pub distance: f64,
    /// Where it is.
    pub place: Place,
}

/// The thinnest places of what is written.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Walls {
    /// Between outline and bore.
    pub about_bore: Option<Wall>,
    /// Between other holes and anything that is cut.
    pub about_holes: Option<Wall>,
}

/// The measures of a body: of the checks that are wanted, each taken when its turn comes.
pub struct Measures<'a> {
    wanted: &'a dyn Fn(&Check) -> bool,
    written: AsWritten<'a>,
    found: Vec<Measure>,
}

impl<'a> Measures<'a> {
    /// Collects measures of the checks that are wanted.
    #[must_use]
    pub fn new(wanted: &'a dyn Fn(&Check) -> bool, written: AsWritten<'a>) -> Self {
        Self { wanted, written, found: Vec::new() }
    }

    /// Takes a measure if its check is wanted; `None` where the check does not apply.
    pub fn add<M: Into<Option<Measure>>>(&mut self, check: &Check, measure: impl FnOnce(&AsWritten<'_>) -> M) {
        if (self.wanted)(check) {
            self.found.extend(measure(&self.written).into());
        }
    }

    /// The measures taken.
    #[must_use]
    pub fn found(self) -> Vec<Measure> {
        self.found
    }
}

//! Checks of figures: the meaning and the limit of each, and how a figure becomes a finding.
//!
//! A body or an analysis says which figure it is and where; the file of the check has the limit, the verdict and the text. A body of
//! your own brings checks of its own in the same way: a constant, and a [`Measure`] of it among its others.

pub mod contact_stress;
pub mod continuity;
pub mod curvature;
pub mod cutter_radius;
pub mod face_width;
pub mod force_closure;
pub mod guide;
pub mod jump_speed;
pub mod measure;
pub mod noise;
pub mod outlier;
pub mod overshoot;
pub mod pivot_clearance;
pub mod pressure_angle;
pub mod size;
pub mod wall;

pub use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{Length, Text, Value, shown, text};
pub use measure::{AsWritten, Measure, Measures, Subject, Wall, Walls};

use crate::report::{Bound, Finding, Place, Verdict};

/// What a check looks at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CheckScope {
    /// The cam as it was solved: when it is made.
    Cam,
    /// The written outline: ours, or that of any file.
    Outline,
    /// The cam as it was solved, and the written outline of any file.
    Motion,
    /// A file that somebody else may have written.
    File,
    /// A further file of a cam, ours or that of any program: the path of a cutter, a table of points.
    ToolFile,
    /// The measures of an analysis.
    Analysis,
}

impl CheckScope {
    /// Whether it looks at what was written, whose tolerances are filled on purpose, and not at the cam that was designed.
    #[must_use]
    pub fn is_as_cut(self) -> bool {
        matches!(self, Self::Outline | Self::File | Self::ToolFile)
    }
}

/// What a user should know of a check in addition to its meaning.
#[derive(Debug, Clone, Copy)]
pub struct CheckExplanation {
    /// On which side of the limit the value must be.
    pub bound: Bound,
    /// How the value is computed.
    pub formula: &'static str,
    /// The usual limit, and who says so.
    pub usual: &'static str,
    /// What to change when it fails.
    pub change: &'static str,
}

/// A check.
#[derive(Debug)]
pub struct Check {
    /// Its name in reports.
    pub name: &'static str,
    /// What it looks at.
    pub on: CheckScope,
    /// Unit of the value and its limit.
    pub unit: &'static str,
    /// What it means, in a sentence.
    pub about: &'static str,
    /// What `camgen explain` adds.
    pub explained: CheckExplanation,
}

/// A position of a follower in a sentence: m, or rad of a swing.
pub(crate) fn position(value: f64, swings: bool) -> Value {
    if swings { format!("{} deg", shown(value.to_degrees())).into() } else { Length::mm(MILLIMETRES * value).into() }
}

/// The note of a check that could not be run because of missing data.
fn not_run(why: &str) -> Text {
    text!("not run: {}", why)
}

impl Check {
    /// A check of a measure of an analysis.
    #[must_use]
    pub const fn on_analysis(
        name: &'static str,
        unit: &'static str,
        about: &'static str,
        explained: CheckExplanation,
    ) -> Self {
        Self { name, on: CheckScope::Analysis, unit, about, explained }
    }

    /// A measure of it, judged by its bound where there is a limit, at no particular place.
    #[must_use]
    pub fn measure(&'static self, value: f64, limit: Option<f64>) -> Measure {
        Measure {
            check: self,
            value,
            limit,
            place: Place::default(),
            note: None,
            named: None,
            fact: None,
            assumes: None,
            verdict: None,
            missing: None,
        }
    }

    /// A measure that could not be taken because data are missing.
    #[must_use]
    pub fn unknown(&'static self, why: &str) -> Measure {
        let note = Some(not_run(why));
        Measure { note, missing: Some(why.to_owned()), ..self.measure(f64::NAN, None).judged(Verdict::Info) }
    }

    /// A finding of this check at no particular place.
    #[must_use]
    pub fn found(&self, value: f64, limit: Option<f64>, verdict: Verdict) -> Finding {
        Finding {
            check: self.name.into(),
            part: None,
            value,
            limit,
            bound: limit.map(|_| self.explained.bound),
            unit: self.unit.into(),
            place: Place::default(),
            verdict,
            missing: None,
            about: Some(self.about),
            is_as_cut: self.on.is_as_cut(),
            named: None,
            fact: None,
            assumes: None,
            note: None,
        }
    }

    /// A check that could not be run because data are missing.
    #[must_use]
    pub fn not_run(&self, why: &str) -> Finding {
        Finding { note: Some(not_run(why)), missing: Some(why.to_owned()), ..self.found(f64::NAN, None, Verdict::Info) }
    }
}

//! One list of checks, walked for every kind of cam and for a file that somebody else may have written.
//!
//! A check takes what is known and gives value, limit and place, also when it passes. A new check is one file and one line in
//! [`CHECKS`].

mod added_volume;
mod air;
mod balance;
mod between_sections;
mod bore;
mod brake;
mod closing;
mod compensator;
mod contact_stress;
mod continuity;
mod curvature;
mod cutter_path;
mod cutter_radius;
mod cylinder_contact;
mod face_width;
mod felt;
mod felt_sections;
mod file;
mod flank;
mod force_closure;
mod guide;
mod jump_speed;
mod linkage;
mod outline;
mod plate_ends;
mod points;
mod pressure_angle;
mod residual;
pub mod rolling;
mod run_up;
mod shaft;
mod shift;
mod solid;
mod sphere;
mod tangency;
mod vibration;
mod wall;

pub use cutter_path::WrittenPath;
pub use file::join_reach;
pub use points::WrittenPoints;
pub use solid::{WrittenSolid, shell_reach};

use crate::analysis::Measure;
use crate::body::{Body, Drawn};
use crate::geometry::contour::Contour;
use crate::profile::Worst;
use crate::profile::outline::MotionTolerance;
use crate::reading::{Chain, Reading};
use crate::report::{Bound, Finding, Place, Rolled, Verdict, worst_first};
use nalgebra::Vector2;

/// An outline as another program would find it in the written file.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenOutline {
    /// Place of its section along the axis, m; 0 for a plane cam.
    pub z: f64,
    /// The outline, counter-clockwise, mm.
    pub contour: Contour,
    /// What else is cut in the same file, joined.
    pub beside: Vec<Chain>,
}

/// What is known of a cam when it is checked.
#[derive(Clone, Copy)]
pub struct Evidence<'a> {
    /// The solved cam.
    pub body: &'a dyn Body,
    /// Its drawing, when it has one of its own.
    pub drawn: Option<&'a Drawn>,
    /// The outlines as read back, one for each section; none when nothing was drawn.
    pub outlines: &'a [WrittenOutline],
    /// What rolling on the outline has shown, when a plane cam was rolled on.
    pub rolled: Option<&'a Rolled>,
    /// What was read from a file that somebody else may have written.
    pub foreign: Option<&'a Reading>,
    /// The path of a cutter as read back, when one was requested.
    pub cutter_path: Option<&'a WrittenPath>,
    /// The tables of points as read back, when they were requested, or why there are none.
    pub points: Option<&'a Result<Vec<WrittenPoints>, String>>,
    /// Every check of the disc that takes the torque of this one, when there is one.
    pub compensator: Option<&'a [Finding]>,
    /// What was read from a STEP file that somebody else may have written.
    pub solid: Option<&'a WrittenSolid>,
    /// Tolerance of the outline, mm.
    pub tolerance_mm: f64,
    /// What the follower may feel of it.
    pub motion: MotionTolerance,
    /// Whether a cam whose follower feels more is refused, by velocity and by acceleration.
    pub strict: [bool; 2],
}

/// What a check looks at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum On {
    /// The cam as it was solved: when it is made.
    Cam,
    /// The written outline: ours, or that of any file.
    Outline,
    /// The cam as it was solved, and the written outline of any file.
    Motion,
    /// A file that somebody else may have written.
    File,
    /// The measures of an analysis.
    Analysis,
}

/// What a user should know of a check, beside its meaning.
#[derive(Debug, Clone, Copy)]
pub struct Explained {
    /// On which side of the limit the value must be.
    pub bound: Bound,
    /// How the value is made.
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
    pub on: On,
    /// What it means, in a sentence.
    pub about: &'static str,
    /// What `camgen explain` says besides.
    pub explained: Explained,
    /// The check itself; `None` where it does not apply to the cam.
    run: fn(&Evidence<'_>) -> Option<Finding>,
}

impl Check {
    /// A check of a file that was read.
    const fn on_file(
        name: &'static str,
        about: &'static str,
        explained: Explained,
        run: fn(&Evidence<'_>) -> Option<Finding>,
    ) -> Self {
        Self { name, on: On::File, about, explained, run }
    }
}

/// Every check, in the order of the report.
pub const CHECKS: &[Check] = &[
    file::LAYER,
    file::UNITS,
    file::READABLE,
    file::DUPLICATES,
    file::CONTOURS,
    file::CLOSED,
    solid::SOLIDS,
    solid::SHELL,
    solid::WALLS,
    solid::THICKNESS,
    solid::VOLUME,
    solid::HOLES,
    continuity::CHECK,
    pressure_angle::CHECK,
    shift::AXIAL_FORCE,
    curvature::UNDERCUT,
    curvature::MIN_CONVEX_RADIUS,
    face_width::CHECK,
    cutter_radius::CHECK,
    cutter_path::CHECK,
    points::CHECK,
    wall::CHECK,
    plate_ends::ROLLER_CLEARANCE,
    plate_ends::ENDS,
    tangency::CHECK,
    outline::CHECK,
    rolling::CHECK,
    bore::CHECK,
    sphere::ROLLING_FLANK,
    flank::CHECK,
    shift::AXIAL_REACH,
    cylinder_contact::CHECK,
    force_closure::CHECK,
    jump_speed::CHECK,
    guide::CHECK,
    contact_stress::CHECK,
    vibration::CHECK,
    residual::CHECK,
    air::CHECK,
    run_up::CHECK,
    felt::CHECK,
    between_sections::CHECK,
    balance::CHECK,
    compensator::CHECK,
    added_volume::CHECK,
    closing::CHECK,
    linkage::GRASHOF,
    linkage::LINK_RATIO,
    linkage::TRANSMISSION_ANGLE,
    linkage::ROD_ANGLE,
    linkage::DEAD_POINTS,
    linkage::REVERSALS,
    shaft::CRITICAL_SPEED,
    shaft::LIFT_ERROR,
    shaft::SUPPORT_SLOPE,
    shaft::UNBALANCE,
    brake::TENSION,
    brake::SELF_LOCKING,
    brake::BELT_RANGE,
    brake::GRIP,
    brake::WEB_STRESS,
    brake::FRAME_REACH,
];

/// Runs every check that applies: failures first, then warnings, then the rest, each in the order of the list.
#[must_use]
pub fn run(evidence: &Evidence<'_>) -> Vec<Finding> {
    let applies = |check: &&Check| match check.on {
        On::Cam => evidence.foreign.is_none() && evidence.solid.is_none(),
        On::Outline => !evidence.outlines.is_empty(),
        On::Motion => evidence.foreign.is_none() || evidence.rolled.is_some(),
        On::File => evidence.foreign.is_some() || evidence.solid.is_some(),
        On::Analysis => false,
    };
    worst_first(CHECKS.iter().filter(applies).filter_map(|check| (check.run)(evidence)).collect())
}

/// Judges the measures of an analysis, each by its check: failures first.
#[must_use]
pub fn judge(measures: &[Measure]) -> Vec<Finding> {
    let judged = |measure: &Measure| {
        let check = CHECKS.iter().find(|check| check.name == measure.check)?;
        let value = measure.value;
        // What is not a number keeps no limit.
        let kept = |limit: f64| match check.explained.bound {
            Bound::AtMost => value <= limit,
            Bound::AtLeast => value >= limit,
            Bound::Above => value > limit,
            Bound::Exactly => value == limit,
        };
        let verdict = measure.limit.map_or(Verdict::Info, |limit| Verdict::of(kept(limit)));
        let found = check.found(value, measure.limit, measure.unit, verdict);
        Some(Finding { note: measure.note.clone(), ..found })
    };
    worst_first(measures.iter().filter_map(judged).collect())
}

impl Check {
    /// A check of a measure of an analysis.
    const fn on_analysis(name: &'static str, about: &'static str, explained: Explained) -> Self {
        Self { name, on: On::Analysis, about, explained, run: |_| None }
    }

    /// A finding of this check at no particular place.
    fn found(&self, value: f64, limit: Option<f64>, unit: &'static str, verdict: Verdict) -> Finding {
        Finding {
            check: self.name.into(),
            value,
            limit,
            bound: limit.map(|_| self.explained.bound),
            unit: unit.into(),
            place: Place::default(),
            verdict,
            note: None,
        }
    }

    /// A check that could not be run because data are missing.
    fn not_run(&self, unit: &'static str, why: &str) -> Finding {
        Finding { note: Some(format!("not run: {why}")), ..self.found(f64::NAN, None, unit, Verdict::Info) }
    }
}

/// A finding at a worst place, with words about the place and more.
fn at(body: &dyn Body, worst: &Worst, finding: Finding, more: Option<String>) -> Finding {
    let words: Vec<String> = body.along_axis(worst.z).into_iter().chain(more).collect();
    Finding { place: body.place(worst.at), note: (!words.is_empty()).then(|| words.join("; ")), ..finding }
}

/// Where a place of the drawing (mm) lies on the cam.
fn place(body: &dyn Body, point: Vector2<f64>) -> Place {
    body.place(body.parameter_at(point * 1e-3))
}

#[cfg(test)]
mod tests;

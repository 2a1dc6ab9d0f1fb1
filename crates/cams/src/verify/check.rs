//! What a check of a written outline is, the evidence it judges, and how its findings are made.

use super::swept_files::WrittenSwept;
use crate::body::{Body, Cut, Drawn};
use crate::check::{Check, CheckExplanation, CheckScope, Measure};
use crate::reading::step::{SolidForm, StepFile};
use crate::reading::{Chain, Reading};
use crate::report::{Finding, Place, Rolled};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::profile::Worst;
use camgen_kernel::profile::outline::MotionTolerance;
use camgen_kernel::text::Text;
use nalgebra::Vector2;
use std::ops::Deref;

/// An outline as another program would read it from the written file.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenOutline {
    /// Which of the cuts of its body it is.
    pub cut: usize,
    /// Place of its section along the axis, m; 0 for a plane cam.
    pub z: f64,
    /// The outline, counter-clockwise, mm.
    pub contour: Contour,
    /// What else is cut in this file, joined to chains; without its other outlines.
    pub others: Vec<Chain>,
}

/// The path of a cutter's centre as another program would read it from the written file.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenPath {
    /// Along which of the cuts of its body it runs.
    pub cut: usize,
    /// Radius of the cutter, mm.
    pub radius: f64,
    /// How far the middle of the tolerance band lies inwards of the exact profile, mm.
    pub middle: f64,
    /// The path, counter-clockwise, mm, or why there is no path.
    pub contour: Result<Contour, String>,
    /// The lead-ins to its start, as read.
    pub lead_ins: Vec<Chain>,
}

/// The solid of a STEP file as read, and what its boundary was recognised as.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenSolid {
    /// The file.
    pub file: StepFile,
    /// What its boundary was recognised as, without its hub.
    pub form: SolidForm,
    /// The distance of its hub from that of the design, mm; `None` of a design without a hub.
    pub hub: Option<f64>,
}

/// What is known of a cam when it is checked.
#[derive(Clone, Copy)]
pub struct Evidence<'a> {
    /// The solved cam.
    pub body: &'a dyn Body,
    /// Its drawing, when it has one of its own.
    pub drawn: Option<&'a Drawn>,
    /// The outlines as read back, one for each section; empty when nothing was drawn.
    pub outlines: &'a [WrittenOutline],
    /// The result of rolling the follower, one for each outline that it rolls on in its plane.
    pub rolled: &'a [Rolled],
    /// What was read from a file that somebody else may have written, once for each outline that it should hold.
    pub foreign: &'a [Reading],
    /// The paths of a cutter as read back, when one was requested, one for each flank.
    pub cutter_paths: &'a [WrittenPath],
    /// Measures that rest on other cams of its assembly.
    pub of_others: &'a [Measure],
    /// What the judges of other files of the cam found.
    pub of_tool_files: &'a [Finding],
    /// What was read from a STEP file that somebody else may have written.
    pub solid: Option<&'a WrittenSolid>,
    /// What was read of the files of a body with flanks that a roller sweeps in space.
    pub swept: Option<&'a WrittenSwept>,
    /// Tolerance of the outline, mm.
    pub tolerance_mm: f64,
    /// Largest errors of velocity and acceleration that the follower may have on it.
    pub motion: MotionTolerance,
    /// Whether a cam is refused that exceeds them, for velocity and for acceleration.
    pub strict: [bool; 2],
}

impl<'a> Evidence<'a> {
    /// Of a body of which no file was read: a tolerance of its outlines, mm, and the largest errors of its follower.
    #[must_use]
    pub fn without_files(body: &'a dyn Body, tolerance_mm: f64, motion: MotionTolerance) -> Self {
        Self {
            body,
            drawn: None,
            outlines: &[],
            rolled: &[],
            foreign: &[],
            cutter_paths: &[],
            of_others: &[],
            of_tool_files: &[],
            solid: None,
            swept: None,
            tolerance_mm,
            motion,
            strict: [true; 2],
        }
    }

    /// The cut that this outline was written for.
    pub(super) fn cut_of(&self, outline: &WrittenOutline) -> Option<Cut<'a>> {
        self.body.cuts().get(outline.cut).copied()
    }

    /// Of the results of rolling, the one with the largest gap.
    pub(super) fn worst_rolled(&self) -> Option<&'a Rolled> {
        self.rolled.iter().reduce(|worst, next| if next.gap_mm.abs() > worst.gap_mm.abs() { next } else { worst })
    }
}

/// A check of what was written. Unlike a [`Check`] of a figure it reads files.
#[derive(Debug)]
pub struct FileCheck {
    /// What it means.
    pub check: Check,
    /// The check itself; `None` where it does not apply to the cam.
    pub(super) run: fn(&Evidence<'_>) -> Option<Finding>,
}

impl FileCheck {
    /// A check of a file that was read.
    pub(super) const fn on_file(
        name: &'static str,
        unit: &'static str,
        about: &'static str,
        explained: CheckExplanation,
        run: fn(&Evidence<'_>) -> Option<Finding>,
    ) -> Self {
        Self { check: Check { name, on: CheckScope::File, unit, about, explained }, run }
    }
}

impl Deref for FileCheck {
    type Target = Check;

    fn deref(&self) -> &Check {
        &self.check
    }
}

/// A check in the list.
#[derive(Debug)]
pub enum CheckEntry {
    /// A check of what was written.
    File(&'static FileCheck),
    /// A check of a figure that a body or an analysis measures.
    Figure(&'static Check),
}

impl Deref for CheckEntry {
    type Target = Check;

    fn deref(&self) -> &Check {
        match self {
            Self::File(check) => &check.check,
            Self::Figure(check) => check,
        }
    }
}

/// A finding at a worst place, with notes about the place and more.
pub(super) fn at(body: &dyn Body, worst: &Worst, finding: Finding, more: Option<Text>) -> Finding {
    let note = Text::from(body.along_axis(worst.z)).and("; ", more);
    Finding { place: body.place(worst.at), note: Some(note).filter(|note| !note.is_empty()), ..finding }
}

/// The place on the cam of a point of the drawing (mm).
pub(crate) fn place(body: &dyn Body, point: Vector2<f64>) -> Place {
    body.place(body.parameter_at(point * 1e-3))
}

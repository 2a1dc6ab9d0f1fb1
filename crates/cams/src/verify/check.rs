//! What a check of a written outline is, the evidence it judges, and how its findings are made.

use super::swept_files::WrittenSwept;
use crate::body::points::PointTable;
use crate::body::{Body, Cut, Drawn};
use crate::check::{Check, CheckExplanation, CheckScope, Measure};
use crate::reading::gauge::GaugeRows;
use crate::reading::gcode::CutterProgram;
use crate::reading::inspection::{self, ReadPlace};
use crate::reading::servo::ServoRows;
use crate::reading::step::{SolidForm, StepFile};
use crate::reading::table::NumberTable;
use crate::reading::{Chain, Reading};
use crate::report::{Finding, Place, Rolled};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::points::Interpolant;
use camgen_kernel::profile::Worst;
use camgen_kernel::profile::outline::MotionTolerance;
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

/// A table of points as a control would read it from the written file.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenPoints {
    /// The table it was made from: which curve it gives, and approximately where its rows lie on it.
    pub table: PointTable,
    /// Radius of the cutter, m, where a cutter is given.
    pub cutter: Option<f64>,
    /// The curve through the rows as read, by the interpolation that the file states; or why there is no such curve.
    pub curve: Result<Interpolant, String>,
}

/// A program for a milling machine as its control would read it from the written file.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenProgram {
    /// Along which of the cuts of its body its passes run.
    pub cuts: Vec<usize>,
    /// Radius of the cutter whose centre is moved, mm; `None` where the control keeps its cutter on the profile.
    pub cutter: Option<f64>,
    /// Radius of the cutter that the control keeps on the profile, mm, if it is given.
    pub kept: Option<f64>,
    /// How far the middle of the tolerance band lies inwards of the exact profile, mm.
    pub middle: f64,
    /// How deep is cut, mm; `None` where it is not known.
    pub depth: Option<f64>,
    /// What the control does, or why it does nothing.
    pub program: Result<CutterProgram, String>,
}

/// A table for a servo drive as it would be read from the written file.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenServo {
    /// What messages call it.
    pub format: &'static str,
    /// Its rows, or why there are none.
    pub table: Result<ServoRows, String>,
}

/// A list of places for a measuring machine as it would be read from the written file.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenInspection {
    /// On which of the cuts of its body they are.
    pub cut: usize,
    /// Radius of the ball, mm; 0 in a form without it.
    pub ball_radius: f64,
    /// The places, or why there are none.
    pub places: Result<Vec<ReadPlace>, String>,
}

impl WrittenInspection {
    /// A file in any of the forms, of a cut.
    #[must_use]
    pub fn of(cut: usize, bytes: &[u8]) -> Self {
        let places = inspection::read(bytes);
        let first = places.as_ref().ok().and_then(|places| places.first());
        let ball_radius = first.map_or(0.0, |place| (place.ball - place.point).norm());
        Self { cut, ball_radius, places }
    }
}

/// The solid of a STEP file as read, and what its boundary was recognised as.
#[derive(Debug, Clone, PartialEq)]
pub struct WrittenSolid {
    /// The file.
    pub file: StepFile,
    /// What its boundary was recognised as.
    pub form: SolidForm,
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
    /// The tables of points as read back, when they were requested, or why there are none.
    pub points: Option<&'a Result<Vec<WrittenPoints>, String>>,
    /// The programs for a milling machine as read back, when they were requested, or why there are none.
    pub programs: Option<&'a Result<Vec<WrittenProgram>, String>>,
    /// The tables for servo drives as read back, when they were requested, or why there are none.
    pub servo: Option<&'a Result<Vec<WrittenServo>, String>>,
    /// The lists of places for a measuring machine as read back, when they were requested.
    pub inspections: &'a [WrittenInspection],
    /// The lift table of a gauge follower as read back, when it was requested, or why there is none.
    pub gauge: Option<&'a Result<GaugeRows, String>>,
    /// A table of numbers that somebody else may have written, or why there is none.
    pub table: Option<&'a Result<NumberTable, String>>,
    /// Measures that rest on other cams of its assembly.
    pub of_others: &'a [Measure],
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
            points: None,
            programs: None,
            servo: None,
            inspections: &[],
            gauge: None,
            table: None,
            of_others: &[],
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
pub(super) fn at(body: &dyn Body, worst: &Worst, finding: Finding, more: Option<String>) -> Finding {
    let words: Vec<String> = body.along_axis(worst.z).into_iter().chain(more).collect();
    Finding { place: body.place(worst.at), note: (!words.is_empty()).then(|| words.join("; ")), ..finding }
}

/// The place on the cam of a point of the drawing (mm).
pub(super) fn place(body: &dyn Body, point: Vector2<f64>) -> Place {
    body.place(body.parameter_at(point * 1e-3))
}

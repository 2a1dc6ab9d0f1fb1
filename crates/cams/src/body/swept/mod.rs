//! Cams into which rollers sweep grooves with flanks in space.
//!
//! Such a body states where its rollers run (`SweptGeometry`) and what it is called, drawn and measured as (`SweptBody`). Worst places, forces, checks, refusals, the
//! frame of its sheet and its report follow from these here, once: every `SweptBody` is a [`Body`](super::Body). The proof of its files needs only
//! [`SweptFlanks`].

use camgen_kernel::text::Text;
pub(super) mod drawing;
mod figures;
mod flanks;
mod forces;
mod groove;
mod implementation;
mod line;
mod measures;
mod nearest;
pub(super) mod sheet;
mod splines;

pub(super) use figures::{
    integrate_smooth, largest, largest_of_motion, least_fold, pressure_angles, sharpest_curvature,
};
pub use flanks::{FlankMiss, FlankSide, RoundFace, RoundForm, SweptDrawing, SweptFlanks, TurnedCam};
pub(super) use groove::{CELLS, SweptGroove};
pub(super) use line::{LinePoint, RollerLine};
pub(super) use nearest::{Descent, NearestRoller, SeenPoint, miss};
pub(super) use splines::{LONGEST_PATCH, fitted_flanks};

use super::flank_switch::SwitchFigures;
use super::{DrawError, DrawingEvidence, Drawn, Kind};
use crate::check::{Measures, Subject};
use crate::report::Section;
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::table::{AddedColumn, Table};
use camgen_kernel::motion::Jet;
use camgen_kernel::profile::Worst;
use camgen_kernel::refusal::Refusal;
use nalgebra::{Vector2, Vector3};
use std::fmt::Debug;
use std::ops::RangeInclusive;

/// A surface of the turned blank that bounds the flanks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BlankSurface {
    Floor,
    Outside,
}

/// A roller that touches a flank.
pub(crate) struct TouchingRoller<L> {
    pub(crate) roller: i32,
    pub(crate) line: L,
    /// Length of the line of contact along its axis, m.
    pub(crate) length: f64,
}

/// Where the rollers of a cam run and what they touch.
pub(crate) trait SweptGeometry: Debug + Send + Sync {
    /// The centre line of one of its rollers.
    type Line: RollerLine;

    /// Whether the follower comes back in a turn, so that the lift also falls.
    const RETURNS: bool;

    fn groove(&self) -> &SweptGroove;

    /// Heights of the two ends, m.
    fn ends(&self) -> (f64, f64);

    /// Numbers of the rollers that may touch the cam during the turn of the motion.
    fn rollers(&self) -> RangeInclusive<i32> {
        0..=0
    }

    /// The centre line of a roller.
    fn line(&self, lift: &Jet, roller: i32) -> Self::Line;

    /// Whether a roller there can touch the cam.
    fn is_near(&self, _line: &Self::Line) -> bool {
        true
    }

    /// Places along a roller between which it touches the flanks, m.
    fn touched(&self, line: &Self::Line) -> [f64; 2];

    /// The place along a roller at which its force acts, m.
    fn middle(&self, line: &Self::Line) -> f64;

    /// The contact whose point of the flank lies on a surface of the blank; `None` where there is none.
    fn contact_on(&self, line: &Self::Line, flank: FlankSide, surface: BlankSurface) -> Option<LinePoint>;

    /// The rollers that press on a flank.
    fn touching(&self, lift: &Jet, flank: FlankSide) -> Vec<TouchingRoller<Self::Line>>;

    /// Pressure angle at a place along a roller, rad, signed: positive where the lift grows.
    fn pressure_angle(&self, _lift: &Jet, line: &Self::Line, v: f64) -> f64 {
        let (sin, cos) = line.point(v).slope;
        libm::atan2(sin, cos)
    }

    /// Way of a roller along its path for a lift, 1 or m/rad.
    fn way_of_lift(&self) -> f64;

    /// Turn of what carries the roller, about the roller's axis and for a turn of the cam, with its derivative.
    fn carrier_turn(&self, lift: &Jet, line: &Self::Line) -> [f64; 2];

    /// How many rollers share the turns.
    fn roller_count(&self) -> u32 {
        1
    }

    /// The roller that comes nearest to a point, m.
    fn nearest(&self, point: Vector3<f64>) -> NearestRoller;
}

/// What is checked of such a cam.
pub(crate) trait SweptMeasures {
    /// A change of the machine file with which every limit is kept.
    fn remedy(&self) -> Option<Text>;

    /// Least metal, m, and where it varies along the cam its place.
    fn wall(&self) -> (f64, Option<Worst>);

    /// The longest measure of the blank, m.
    fn longest(&self) -> f64;

    /// The measures that only it has.
    fn measure(&self, of: &mut Measures<'_>, subject: &Subject<'_>);
}

/// The words in which bodies with the same rule differ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SweptWords {
    pub(crate) noun: &'static str,
    /// Why a cam whose flanks fold has no drawing.
    pub(crate) folds: &'static str,
    /// What to change where splines miss the flanks.
    pub(crate) smoother: &'static str,
    /// Endings of its tables, and where to look for what a table of points would show.
    pub(crate) tables: &'static [&'static str],
    pub(crate) points: &'static str,
    pub(crate) not_modelled: &'static [&'static str],
}

/// A cam of such rollers: what it is made of, and what is shown of it alone.
pub(crate) trait SweptBody: SweptGeometry + SweptMeasures + SweptFlanks {
    const KIND: &'static Kind;
    const WORDS: SweptWords;

    /// Equal lobes of a turn.
    fn lobes(&self) -> u32 {
        self.groove().motion.lobes()
    }

    /// Half of the width of its groove where that is narrowest, m: the radius of the largest tool that fits.
    fn narrowest_half_width(&self) -> f64 {
        self.groove().widest_tool()
    }

    /// The largest pressure angle of the rollers at a lift, as a table shows it, rad.
    fn steepest(&self, lift: &Jet) -> f64;

    /// Columns that only its table has, at a cam angle of a piece.
    fn added_columns(&self, _at: (usize, f64)) -> Vec<(&'static AddedColumn, f64)> {
        Vec::new()
    }

    /// Its tables, with so many rows over a turn and for a cutter of a radius, m.
    fn tables(&self, samples: u32, cutter: Option<f64>) -> Vec<Table>;

    /// The cam angle of a point of the drawing, m.
    fn angle_of(&self, point: Vector2<f64>) -> f64;

    /// Refuses what has no drawing though its flanks do not fold.
    ///
    /// # Errors
    /// [`DrawError`] with the reason.
    fn refuse_drawing(&self) -> Result<(), DrawError> {
        Ok(())
    }

    /// Its solid, and what else is drawn of it, within a tolerance, mm.
    ///
    /// # Errors
    /// [`Refusal`] when the tolerance is finer than splines of a reasonable size can keep.
    fn drawing(&self, tolerance: f64) -> Result<SweptDrawing, Refusal>;

    /// Its own section of the report.
    fn own_section(&self, found: &DrawingEvidence<'_>, switches: Vec<SwitchFigures>) -> Section;

    /// How its mechanism moves.
    fn moving(&self, drawn: &Drawn, samples: u32) -> MovingMechanism;

    /// Adds what its review sheet shows to a title and the notes of any cam.
    fn fill_sheet(&self, drawn: Option<&SweptDrawing>, view: &mut SheetView);

    /// Adds the views, sizes and tables of its drawing for manufacture.
    fn fill_drawing(&self, drawn: &SweptDrawing, view: &mut SheetView);
}

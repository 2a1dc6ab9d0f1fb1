//! The barrel as a swept body.

use super::{AxisLine, BARREL, Barrel, BarrelLine, BarrelRoller, RollerPath, drawing, mechanism, report, sheet};
use crate::body::flank_switch::SwitchFigures;
use crate::body::swept::{
    BlankSurface, FlankSide, LinePoint, NearestRoller, RollerLine, SweptBody, SweptDrawing, SweptGeometry, SweptGroove,
    SweptWords, TouchingRoller,
};
use crate::body::{DrawingEvidence, Drawn, Kind};
use crate::machine::Machine;
use crate::report::Section;
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::table::{AddedColumn, Table};
use camgen_kernel::motion::Jet;
use camgen_kernel::refusal::Refusal;
use nalgebra::{Vector2, Vector3};

const WORDS: SweptWords = SweptWords {
    noun: "barrel",
    folds: "a flank folds over itself: the roller cannot follow it",
    smoother: "give a coarser --tolerance, a larger cam.outer_radius or a smoother motion",
    tables: &["-sections.csv", "-four-axes.csv"],
    points: "its tables are -sections.csv and -four-axes.csv",
    not_modelled: &[
        "Vibration, friction and the guide of the follower are not computed for a barrel.",
        "The ends of the roller: it is a straight cylinder without a rounded edge.",
    ],
};

/// A cylindrical roller.
impl BarrelRoller for RollerPath {
    type Line = AxisLine;

    const KIND: &'static Kind = &BARREL;
    const WORDS: SweptWords = WORDS;

    fn of_machine(_machine: &Machine, path: RollerPath) -> Result<Self, Refusal> {
        Ok(path)
    }

    fn line(&self, lift: &Jet, _outer: f64) -> AxisLine {
        self.at(lift)
    }

    fn path(&self) -> &RollerPath {
        self
    }
}

/// Both flanks on the outside.
const UPPER_X: AddedColumn = AddedColumn { name: "upper_flank_x_mm", after: "pressure_angle_deg" };
const UPPER_Z: AddedColumn = AddedColumn { name: "upper_flank_z_mm", after: "pressure_angle_deg" };
const LOWER_X: AddedColumn = AddedColumn { name: "lower_flank_x_mm", after: "pressure_angle_deg" };
const LOWER_Z: AddedColumn = AddedColumn { name: "lower_flank_z_mm", after: "pressure_angle_deg" };

impl<R: BarrelRoller> SweptGeometry for Barrel<R> {
    type Line = R::Line;

    const RETURNS: bool = true;

    fn groove(&self) -> &SweptGroove {
        &self.groove
    }

    fn ends(&self) -> (f64, f64) {
        self.ends
    }

    fn line(&self, lift: &Jet, _roller: i32) -> R::Line {
        self.roller.line(lift, self.outer)
    }

    /// From its inner end, which stands so far below the outside as it reaches into the groove, to where it leaves the cylinder.
    fn touched(&self, axis: &R::Line) -> [f64; 2] {
        [self.outer - self.reach, self.outer].map(|from_axis| axis.axis().at_distance(from_axis))
    }

    fn middle(&self, axis: &R::Line) -> f64 {
        let [inner, outer] = self.touched(axis);
        0.5 * (inner + outer)
    }

    fn contact_on(&self, axis: &R::Line, flank: FlankSide, surface: BlankSurface) -> Option<LinePoint> {
        let radius = match surface {
            BlankSurface::Floor => self.floor(),
            BlankSurface::Outside => self.outer,
        };
        axis.on_cylinder(self.groove.signed(flank), radius).map(|found| found.line)
    }

    /// From the roller's inner end, or the floor, to the outer edge of the flank.
    fn touching(&self, lift: &Jet, flank: FlankSide) -> Vec<TouchingRoller<R::Line>> {
        let line = self.roller.line(lift, self.outer);
        let [floor, outside] =
            [BlankSurface::Floor, BlankSurface::Outside].map(|surface| self.contact_on(&line, flank, surface));
        let [inner, _] = self.touched(&line);
        let length = floor.zip(outside).map_or(0.0, |(floor, outside)| outside.v - inner.max(floor.v)).max(0.0);
        vec![TouchingRoller { roller: 0, line, length }]
    }

    fn pressure_angle(&self, lift: &Jet, axis: &R::Line, v: f64) -> f64 {
        self.roller.path().pressure_angle(lift, &axis.point(v))
    }

    fn way_of_lift(&self) -> f64 {
        if let RollerPath::Arm { arm, .. } = self.roller.path() { *arm } else { 1.0 }
    }

    fn carrier_turn(&self, lift: &Jet, _axis: &R::Line) -> [f64; 2] {
        match *self.roller.path() {
            RollerPath::Straight { .. } => [0.0; 2],
            RollerPath::Arm { side, .. } => [side * lift.ds, side * lift.dds],
        }
    }

    fn nearest(&self, point: Vector3<f64>) -> NearestRoller {
        self.nearest_roller(point)
    }
}

impl<R: BarrelRoller> SweptBody for Barrel<R> {
    const KIND: &'static Kind = R::KIND;
    const WORDS: SweptWords = R::WORDS;

    /// On the floor.
    fn narrowest_half_width(&self) -> f64 {
        let taper = self.roller.half_angle(self.outer).map_or(0.0, libm::tan);
        self.groove.widest_tool() - taper * self.depth
    }

    /// At the inner end of the roller or at the outside, signed.
    fn steepest(&self, lift: &Jet) -> f64 {
        let axis = self.roller.line(lift, self.outer);
        let [inner, outer] = self.touched(&axis).map(|v| self.pressure_angle(lift, &axis, v));
        if inner.abs() > outer.abs() { inner } else { outer }
    }

    fn added_columns(&self, at: (usize, f64)) -> Vec<(&'static AddedColumn, f64)> {
        let [upper, lower] = FlankSide::BOTH.map(|side| self.developed_at(Some(side), at).0);
        vec![(&UPPER_X, upper.x), (&UPPER_Z, upper.y), (&LOWER_X, lower.x), (&LOWER_Z, lower.y)]
    }

    fn tables(&self, samples: u32, cutter: Option<f64>) -> Vec<Table> {
        let sections = self.sections_table(samples);
        if self.roller.without_tool().is_some() {
            return vec![sections];
        }
        vec![sections, self.four_axes_table(samples, cutter)]
    }

    /// Of a point of the developed view.
    fn angle_of(&self, point: Vector2<f64>) -> f64 {
        self.groove.sense() * point.x / self.outer
    }

    fn drawing(&self, tolerance: f64) -> Result<SweptDrawing, Refusal> {
        let flanks = self.flanks(tolerance)?;
        Ok(SweptDrawing {
            solid: self.solid(&flanks)?,
            deviation: flanks.deviation,
            developed: self.developed_view(tolerance)?,
            tables: R::WORDS.tables,
        })
    }

    fn own_section(&self, found: &DrawingEvidence<'_>, switches: Vec<SwitchFigures>) -> Section {
        report::section(self, found, switches)
    }

    fn moving(&self, drawn: &Drawn, samples: u32) -> MovingMechanism {
        mechanism::moving(self, drawn, samples)
    }

    fn fill_sheet(&self, drawn: Option<&SweptDrawing>, view: &mut SheetView) {
        sheet::fill(self, drawn, view);
    }

    fn fill_drawing(&self, drawn: &SweptDrawing, view: &mut SheetView) {
        drawing::fill(self, drawn, view);
    }
}

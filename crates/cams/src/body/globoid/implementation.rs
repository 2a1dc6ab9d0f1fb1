//! The globoid as a swept body.

use super::contact::TurretLine;
use super::{GLOBOID, Globoid, drawing, mechanism, report, sheet};
use crate::body::flank_switch::SwitchFigures;
use crate::body::swept::{
    BlankSurface, FlankSide, LinePoint, NearestRoller, RollerLine, SweptBody, SweptDrawing, SweptGeometry, SweptGroove,
    SweptWords, TouchingRoller,
};
use crate::body::{DrawError, DrawingEvidence, Drawn, Kind};
use crate::report::Section;
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::table::Table;
use camgen_kernel::motion::Jet;
use camgen_kernel::refusal::Refusal;
use nalgebra::{Vector2, Vector3};
use std::ops::RangeInclusive;

const WORDS: SweptWords = SweptWords {
    noun: "globoid",
    folds: "a flank folds over itself: the rollers cannot follow it",
    smoother: "give a coarser --tolerance, a larger cam.turret_distance or a smoother motion",
    tables: &["-sections.csv", "-two-axes.csv"],
    points: "its tables are -sections.csv and -two-axes.csv",
    not_modelled: &[
        "Vibration and friction are not computed for a globoid.",
        "The sharing of the force by several rollers: each of those in contact is taken to carry all of it.",
        "The ends of the rollers: they are straight cylinders without a rounded edge.",
        "The lead-in of the grooves: rollers enter them as wide as they are.",
    ],
};

impl SweptGeometry for Globoid {
    type Line = TurretLine;

    /// A turret does not turn back.
    const RETURNS: bool = false;

    fn groove(&self) -> &SweptGroove {
        &self.groove
    }

    fn ends(&self) -> (f64, f64) {
        let (_, height) = self.rim(self.floor);
        (-height, height)
    }

    fn rollers(&self) -> RangeInclusive<i32> {
        self.passing_rollers()
    }

    fn line(&self, lift: &Jet, roller: i32) -> TurretLine {
        self.line_at_lift(lift, -f64::from(roller) * self.turret.pitch())
    }

    fn is_near(&self, line: &TurretLine) -> bool {
        line.angle[0].abs() <= self.end_angle + libm::asin(self.groove.farther() / self.outside)
    }

    fn touched(&self, _line: &TurretLine) -> [f64; 2] {
        [self.outside, self.reached]
    }

    fn middle(&self, _line: &TurretLine) -> f64 {
        self.turret.arm
    }

    /// A centre line meets floor and outside also beyond the ends of the cam, where the flank itself does not.
    fn contact_on(&self, line: &TurretLine, flank: FlankSide, surface: BlankSurface) -> Option<LinePoint> {
        let from_turret = match surface {
            BlankSurface::Floor => self.floor,
            BlankSurface::Outside => self.outside,
        };
        let found = line.at_distance(self.groove.signed(flank), from_turret);
        Some(found.map_or_else(|| line.point(from_turret), |found| found.line))
    }

    /// The rollers that touch over their whole reach; if none, those with centre lines between the ends that touch at all.
    fn touching(&self, lift: &Jet, flank: FlankSide) -> Vec<TouchingRoller<TurretLine>> {
        let touching = |(roller, line)| {
            let length = self.length_of_contact(&line, flank);
            TouchingRoller { roller, line, length }
        };
        let lines = || self.rollers().map(|roller| (roller, self.line(lift, roller)));
        let whole: Vec<_> = lines().filter(|(_, line)| self.touches_wholly(line, flank)).map(touching).collect();
        if !whole.is_empty() {
            return whole;
        }
        let between = lines().filter(|(_, line)| line.angle[0].abs() <= self.end_angle);
        between.map(touching).filter(|touching| touching.length > 0.0).collect()
    }

    fn way_of_lift(&self) -> f64 {
        self.turret.arm
    }

    fn carrier_turn(&self, _lift: &Jet, line: &TurretLine) -> [f64; 2] {
        let (sin, cos) = libm::sincos(line.angle[0]);
        [sin, cos * line.angle[1]]
    }

    fn roller_count(&self) -> u32 {
        self.turret.rollers
    }

    fn nearest(&self, point: Vector3<f64>) -> NearestRoller {
        self.nearest_roller(point)
    }
}

impl SweptBody for Globoid {
    const KIND: &'static Kind = &GLOBOID;
    const WORDS: SweptWords = WORDS;

    fn lobes(&self) -> u32 {
        1
    }

    /// Of the rollers between the ends.
    fn steepest(&self, lift: &Jet) -> f64 {
        let lines = self.rollers().map(|roller| self.line(lift, roller));
        let between = lines.filter(|line| line.angle[0].abs() <= self.end_angle);
        let angles = between.flat_map(|line| self.touched(&line).map(|v| self.pressure_angle(lift, &line, v)));
        angles.fold(0.0, f64::max)
    }

    fn tables(&self, samples: u32, cutter: Option<f64>) -> Vec<Table> {
        vec![self.sections_table(samples), self.two_axes_table(samples, cutter)]
    }

    /// Of a point in the plane across the axis.
    fn angle_of(&self, point: Vector2<f64>) -> f64 {
        libm::atan2(self.groove.sense() * point.y, point.x)
    }

    fn refuse_drawing(&self) -> Result<(), DrawError> {
        if self.thinnest_rib().0 > 0.0 {
            return Ok(());
        }
        Err(DrawError::NoOutline("the grooves of two rollers meet: no rib is left between them".into()))
    }

    fn drawing(&self, tolerance: f64) -> Result<SweptDrawing, Refusal> {
        let found = self.solid(tolerance)?;
        Ok(SweptDrawing { solid: found.solid, deviation: found.deviation, developed: Vec::new(), tables: WORDS.tables })
    }

    fn own_section(&self, found: &DrawingEvidence<'_>, switches: Vec<SwitchFigures>) -> Section {
        report::section(self, found, switches)
    }

    fn moving(&self, _drawn: &Drawn, samples: u32) -> MovingMechanism {
        mechanism::moving(self, samples)
    }

    fn fill_sheet(&self, _drawn: Option<&SweptDrawing>, view: &mut SheetView) {
        sheet::fill(self, view);
    }

    fn fill_drawing(&self, drawn: &SweptDrawing, view: &mut SheetView) {
        drawing::fill(self, drawn, view);
    }
}

//! The globoid as a [`Body`].

use super::{GLOBOID, Globoid, mechanism, report, sheet};
use crate::body::in_groove::GrooveForces;
use crate::body::part;
use crate::body::picture::RIGID;
use crate::body::{Body, Cut, DrawError, DrawingEvidence, Drawn, Kind, Request, SweptDrawing, SweptFlanks};
use crate::check::Measures;
use crate::machine::Machine;
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::report::{Section, Speeds};
use crate::table::{Row, Table, TurnAngles, turned};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::followed;
use camgen_kernel::profile::outline::{OutlineError, SegmentKind, Side};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;

/// What is not modelled of a globoid.
const NOT_MODELLED: &[&str] = &[
    "Vibration and friction are not computed for a globoid.",
    "The sharing of the force by several rollers: each of those in contact is taken to carry all of it.",
    "The ends of the rollers: they are straight cylinders without a rounded edge.",
    "The lead-in of the grooves: rollers enter them as wide as they are.",
];

/// The endings of its tables.
const TABLES: &[&str] = &["-sections.csv", "-two-axes.csv"];

impl Globoid {
    fn row(&self, at: TurnAngles, (piece, angle): (usize, f64)) -> Row {
        let lift = self.motion.jet(piece, angle);
        let steepest = |roller: i32| {
            let line = self.line((piece, angle, 0.0), f64::from(roller));
            let reaches = line.angle[0].abs() <= self.end_angle;
            let slopes = self.touched().map(|v| line.point(v).slope);
            let angle = slopes.into_iter().map(|(sin, cos)| libm::atan2(sin, cos)).fold(0.0, f64::max);
            if reaches { angle } else { 0.0 }
        };
        let steepest = self.rollers().map(steepest).fold(0.0, f64::max);
        Row {
            cam_deg: Some(at.cam_deg),
            at: Some((piece, angle)),
            swing: Some(lift),
            position: self.motion.origin().map(|origin| origin + lift.s),
            pressure_angle_deg: Some(steepest.to_degrees()),
            swings: true,
            force: GrooveForces::of(self).map(|forces| forces.row((piece, angle))),
            ..Row::default()
        }
    }
}

impl Body for Globoid {
    fn kind(&self) -> &'static Kind {
        &GLOBOID
    }

    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn speeds(&self) -> Speeds {
        self.rpm.map_or(Speeds::Any(()), Speeds::One)
    }

    /// None: grooves in space have no outline in a plane.
    fn cuts(&self) -> Vec<Cut<'_>> {
        Vec::new()
    }

    fn swept(&self) -> Option<&dyn SweptFlanks> {
        Some(self)
    }

    fn further_tables(&self, samples: u32, cutter: Option<f64>) -> Vec<Table> {
        vec![self.sections_table(samples), self.two_axes_table(samples, cutter)]
    }

    fn holes_within(&self, _outline: &Contour) -> Vec<Entity> {
        part::bore(&self.machine).into_iter().collect()
    }

    fn shaft_speed(&self) -> Option<f64> {
        self.speed()
    }

    fn largest_rates(&self) -> [f64; 2] {
        followed::largest_rates(&*self.motion)
    }

    /// Of a point in the plane across the axis.
    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        libm::atan2(self.sense() * point.y, point.x)
    }

    fn measures(&self, of: &mut Measures<'_>) {
        self.take_measures(of);
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        if self.least_fold().value <= self.distances[0].max(self.distances[1]) {
            return Err(DrawError::NoOutline("a flank folds over itself: the rollers cannot follow it".into()));
        }
        if !(self.thinnest_rib().0 > 0.0) {
            return Err(DrawError::NoOutline("the grooves of two rollers meet: no rib is left between them".into()));
        }
        let without = |what: &str| Refusal::new(format!("{what} is not drawn for a globoid")).remedy("leave it out");
        if request.lead_in.is_some() || request.start.is_some() {
            return Err(without("a start of the cut").into());
        }
        if request.fit.side != Side::Both || request.fit.laid != SegmentKind::Arcs {
            return Err(without("--side, or an outline of splines,").into());
        }
        if request.points.is_some() {
            return Err(without("a table of points of an outline")
                .remedy("its tables are -sections.csv and -two-axes.csv")
                .into());
        }
        let found = self.solid(MILLIMETRES * request.fit.tolerance)?;
        let swept =
            SweptDrawing { solid: found.solid, deviation: found.deviation, developed: Vec::new(), tables: TABLES };
        Ok(Drawn { swept: Some(Box::new(swept)), ..Drawn::of(Vec::new()) })
    }

    fn height(&self) -> Option<(f64, f64)> {
        let height = MILLIMETRES * self.rim(self.floor).1;
        Some((-height, height))
    }

    fn rows(&self, samples: u32) -> Vec<Row> {
        let row = |index: u32| {
            let at = turned(index, samples, 1);
            self.row(at, self.motion.locate(at.angle))
        };
        (0..samples).map(row).collect()
    }

    fn row_on(&self, piece: usize, parameter: f64) -> Option<Row> {
        let cam_deg = crate::report::degrees(parameter);
        Some(self.row(TurnAngles { cam_deg, angle: parameter, crank_deg: cam_deg }, (piece, parameter)))
    }

    fn leverage(&self) -> f64 {
        self.turret.arm
    }

    fn follower_motion(&self) -> Option<&dyn Motion> {
        Some(&*self.motion)
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        report::sections(self, found)
    }

    fn mechanism(&self, _drawn: &Drawn, samples: u32) -> MovingMechanism {
        mechanism::of(self, samples)
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        [RIGID, NOT_MODELLED].concat()
    }

    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        Ok(sheet::view(self, drawn))
    }
}

//! The barrel as a [`Body`].

use super::{BARREL, Barrel, BarrelCurve, FlankSide, RollerPath, mechanism, report, sheet};
use crate::body::in_groove::GrooveForces;
use crate::body::part;
use crate::body::picture::RIGID;
use crate::body::{Body, Cut, DrawError, DrawingEvidence, Drawn, Kind, Request, SweptDrawing, SweptFlanks};
use crate::check::Measures;
use crate::machine::{Machine, Rotation};
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::report::{Section, Speeds};
use crate::table::{AddedColumn, Row, Table, TurnAngles, turned};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::profile::followed;
use camgen_kernel::profile::outline::{OutlineError, SegmentKind, Side};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;

/// What is not modelled of a barrel.
const NOT_MODELLED: &[&str] = &[
    "Vibration, friction and the guide of the follower are not computed for a barrel.",
    "The ends of the roller: it is a straight cylinder without a rounded edge.",
];

/// The endings of its tables.
const TABLES: &[&str] = &["-sections.csv", "-four-axes.csv"];

/// Both flanks on the outside.
const UPPER_X: AddedColumn = AddedColumn { name: "upper_flank_x_mm", after: "pressure_angle_deg" };
const UPPER_Z: AddedColumn = AddedColumn { name: "upper_flank_z_mm", after: "pressure_angle_deg" };
const LOWER_X: AddedColumn = AddedColumn { name: "lower_flank_x_mm", after: "pressure_angle_deg" };
const LOWER_Z: AddedColumn = AddedColumn { name: "lower_flank_z_mm", after: "pressure_angle_deg" };

impl Barrel {
    fn row(&self, at: TurnAngles, (piece, angle): (usize, f64)) -> Row {
        let lift = self.motion.jet(piece, angle);
        let steepest = self.touched(&self.path.at(&lift)).map(|v| self.path.pressure_angle(&lift, v));
        let steepest = if steepest[0].abs() > steepest[1].abs() { steepest[0] } else { steepest[1] };
        let flank = |side| self.developed_at(BarrelCurve::Flank(side), (piece, angle)).0;
        let (upper, lower) = (flank(FlankSide::Upper), flank(FlankSide::Lower));
        let swings = self.motion.quantity() == Quantity::Angle;
        Row {
            cam_deg: Some(at.cam_deg),
            at: Some((piece, angle)),
            lift: (!swings).then_some(lift),
            swing: swings.then_some(lift),
            position: self.motion.origin().map(|origin| origin + lift.s),
            pressure_angle_deg: Some(steepest.to_degrees()),
            swings,
            force: GrooveForces::of(self).map(|forces| forces.row((piece, angle))),
            added: vec![(&UPPER_X, upper.x), (&UPPER_Z, upper.y), (&LOWER_X, lower.x), (&LOWER_Z, lower.y)],
            ..Row::default()
        }
    }
}

impl Body for Barrel {
    fn kind(&self) -> &'static Kind {
        &BARREL
    }

    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn speeds(&self) -> Speeds {
        self.rpm.map_or(Speeds::Any(()), Speeds::One)
    }

    /// None: a groove in space has no outline in a plane.
    fn cuts(&self) -> Vec<Cut<'_>> {
        Vec::new()
    }

    fn swept(&self) -> Option<&dyn SweptFlanks> {
        Some(self)
    }

    fn further_tables(&self, samples: u32, cutter: Option<f64>) -> Vec<Table> {
        vec![self.sections_table(samples), self.four_axes_table(samples, cutter)]
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

    /// Of a point of the developed view.
    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        self.sense() * point.x / self.outer
    }

    fn measures(&self, of: &mut Measures<'_>) {
        self.take_measures(of);
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        if self.least_fold().value <= self.distances[0].max(self.distances[1]) {
            return Err(DrawError::NoOutline("a flank folds over itself: the roller cannot follow it".into()));
        }
        let without = |what: &str| Refusal::new(format!("{what} is not drawn for a barrel")).remedy("leave it out");
        if request.lead_in.is_some() || request.start.is_some() {
            return Err(without("a start of the cut").into());
        }
        if request.fit.side != Side::Both || request.fit.laid != SegmentKind::Arcs {
            return Err(without("--side, or an outline of splines,").into());
        }
        if request.points.is_some() {
            return Err(without("a table of points of an outline")
                .remedy("its tables are -sections.csv and -four-axes.csv")
                .into());
        }
        let tolerance = MILLIMETRES * request.fit.tolerance;
        let flanks = self.flanks(tolerance)?;
        let swept = SweptDrawing {
            solid: self.solid(&flanks)?,
            deviation: flanks.deviation,
            developed: self.developed_view(tolerance)?,
            tables: TABLES,
        };
        Ok(Drawn { swept: Some(Box::new(swept)), ..Drawn::of(Vec::new()) })
    }

    fn height(&self) -> Option<(f64, f64)> {
        Some((MILLIMETRES * self.ends.0, MILLIMETRES * self.ends.1))
    }

    fn rows(&self, samples: u32) -> Vec<Row> {
        let row = |index: u32| {
            let at = turned(index, samples, self.motion.lobes());
            self.row(at, self.motion.locate(at.angle))
        };
        (0..samples).map(row).collect()
    }

    fn row_on(&self, piece: usize, parameter: f64) -> Option<Row> {
        let cam_deg = crate::report::degrees(parameter);
        let crank_deg = (f64::from(self.motion.lobes()) * cam_deg) % 360.0;
        Some(self.row(TurnAngles { cam_deg, angle: parameter, crank_deg }, (piece, parameter)))
    }

    fn leverage(&self) -> f64 {
        if let RollerPath::Arm { arm, .. } = self.path { arm } else { 1.0 }
    }

    fn follower_motion(&self) -> Option<&dyn Motion> {
        Some(&*self.motion)
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        report::sections(self, found)
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> MovingMechanism {
        mechanism::of(self, drawn, samples)
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        [RIGID, NOT_MODELLED].concat()
    }

    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        Ok(sheet::view(self, drawn))
    }
}

impl Barrel {
    /// Whether it turns clockwise.
    pub(super) fn is_clockwise(&self) -> bool {
        self.machine.cam.rotation == Rotation::Clockwise
    }
}

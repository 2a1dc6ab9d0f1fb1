//! Bodies: the parts that are cut. A body is solved from a machine, finds its worst places, draws itself to a tolerance, and contributes
//! to table, report and sheet.
//!
//! A new body is a folder here with `impl Body` and a line in [`BODIES`].

use camgen_kernel::text::Text;
pub mod balancing;
pub mod barrel;
pub mod closure;
pub mod conjugate;
mod cut;
pub mod disc;
pub mod figures;
mod flank;
pub mod flank_switch;
mod flight;
pub mod globoid;
pub mod groove;
pub mod in_groove;
mod list;
mod load_as_cut;
pub mod loaded;
pub mod mesh;
pub mod motion_diagram;
pub mod part;
pub(crate) mod part_drawing;
pub mod part_features;

pub mod part_shapes;
pub mod part_tolerance;
pub mod picture;
pub mod rib;
pub mod roller_bearing;
pub mod shaft_torque;
pub mod sheet;
mod sizing;
pub(crate) mod start;
pub mod stress;
pub mod surface;
pub mod swept;
mod tapered;
pub mod torque;
pub mod wedge;
mod wishes;
mod worst_places;
pub mod yoke;

pub use cut::{Cut, groove_width};
pub use figures::Figures;
pub use flank::Flank;
pub use list::{BODIES, MADE_WITH, ProgramBody, SolveProgram, of_motion};
pub(crate) use list::{needs_base_circle, sized_disc};
pub use load_as_cut::LoadAsCut;
pub use loaded::{LoadedFollower, ShaftCompliance};
pub use part::{Inertia, Layer, NEGLIGIBLE_MM, Part, PartFlank, Rim, Track};
pub use picture::{Cover, DrivenMechanism, FollowerTrack};
pub use sheet::traces;
pub use sizing::size_limits;
pub use sizing::{broken_limit, no_radius, passing};
pub use surface::Surface;
pub use swept::{RoundFace, SweptDrawing, SweptFlanks};
pub use wishes::{FormatSet, Gauge, Inspection, Milling, PointCurve, Points};
pub use worst_places::WorstPlaces;
pub use worst_places::{STRAIGHT, radius_of};

use crate::check::Measures;
use crate::machine::{Machine, ReadParts};
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::report::{Place, Rolled, Section, Shaft, Speeds, shown};
use crate::table::{Row, Table};
use camgen_kernel::document::{KeySection, NamedChoice, cams};
use camgen_kernel::geometry::boundary::{Boundary, BoundaryStretch};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::lead_in::LeadIn;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::motion::{Jet, Motion, Quantity};
use camgen_kernel::numeric::extremum;
use camgen_kernel::profile::envelope::NoEnvelope;
use camgen_kernel::profile::outline::{Fit, MotionTolerance, Outline, OutlineError};
use camgen_kernel::profile::{Curves, Worst, boundary, extremes, lifts};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;
use std::sync::Arc;

/// Corners that are intended are looked for that many tolerances about their exact places: a drawing within the tolerance cuts
/// an acute one off by up to a few.
pub const CORNER_REACH: f64 = 4.0;

/// A kind of body.
#[derive(Debug, PartialEq, Eq)]
pub struct Kind {
    /// The command that makes it, which is also what file names and the table of keys call it.
    pub command: &'static str,
    /// What messages call it: "rotary cam".
    pub noun: &'static str,
    /// The kind of cam, as keys name it, whose keys have an effect on it.
    pub keys: &'static str,
}

/// Keys that a body adds to a table of a machine file.
#[derive(Debug)]
pub struct BodyKeys {
    /// The keys, in the table that has them.
    pub section: &'static KeySection,
    /// Reads them into a part of the machine.
    pub read: ReadParts,
}

/// The body of a motion, with those that are made for it.
#[derive(Debug)]
pub struct ProgramCams {
    /// The body, and what the names of its files have after the stem; empty of one that is made alone.
    pub first: (&'static str, Arc<dyn Body>),
    /// The others, each with what the names of its files have.
    pub others: Vec<(&'static str, Arc<dyn Body>)>,
}

impl ProgramCams {
    /// A body that is made alone.
    pub(in crate::body) fn alone(body: impl Body + 'static) -> Self {
        Self { first: ("", Arc::new(body)), others: Vec::new() }
    }
}

/// Least tolerance of velocity or acceleration, over the largest of the motion.
const FINEST_RATE: f64 = 1e-6;

/// A requested tolerance of velocity or acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RateTolerance {
    /// Over the largest of the motion.
    Share(f64),
    /// A quantity: m or rad per rad of the shaft or per second, squared where it is an acceleration.
    Rate {
        /// The number.
        value: f64,
        /// In radians, of a follower that swings; else in metres.
        swing: bool,
        /// Per second; else per radian of the shaft.
        by_time: bool,
    },
}

/// The rate of the motion of an order.
fn rate_word(order: usize) -> &'static str {
    if order == 1 { "velocity" } else { "acceleration" }
}

impl RateTolerance {
    /// The tolerance by the angle of the shaft, m or rad, of the velocity (order 1) or the acceleration (order 2) of a body.
    fn by_angle(self, body: &dyn Body, order: usize) -> Result<f64, Refusal> {
        let swings = curves(body).is_some_and(|curves| curves.motion.quantity() == Quantity::Angle);
        let by_travel = curves(body).is_some_and(|curves| curves.motion.is_by_travel());
        match self {
            Self::Share(share) => Ok(share * body.largest_rates().get(order - 1).copied().unwrap_or(0.0)),
            Self::Rate { .. } if by_travel => Err(Refusal::new(format!(
                "the rates of a plate are by its travel: the tolerance of the {} must be a share",
                rate_word(order)
            ))
            .remedy("e.g. 5%")),
            Self::Rate { swing, .. } if swing != swings => {
                let follower = if swings { "swings" } else { "does not swing" };
                let unit = match (swings, order) {
                    (true, 1) => "rad/rad",
                    (true, _) => "rad/rad2",
                    (false, 1) => "mm/rad",
                    (false, _) => "mm/rad2",
                };
                let rate = rate_word(order);
                Err(Refusal::new(format!(
                    "the follower {follower}: the tolerance of its {rate} must be a share or in {unit}"
                )))
            }
            Self::Rate { value, by_time: false, .. } => Ok(value),
            Self::Rate { value, by_time: true, .. } => {
                let speed = body.shaft_speed().ok_or_else(|| {
                    Refusal::new("a tolerance per second needs the speed of the cam")
                        .remedy("give --rpm, or a tolerance per rad or as a share")
                })?;
                Ok(if order == 1 { value / speed } else { value / (speed * speed) })
            }
        }
    }
}

/// Named accuracies, of those that [`trade`](mod@crate::trade) measures. The standard one is the default of the command line and of
/// [`Cam::draw`](crate::Cam::draw).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Accuracy {
    /// 50 µm: for a first look.
    Draft,
    /// 5 µm and 5 % of the acceleration: for milling.
    #[default]
    Standard,
    /// 0.5 µm and 1 % of the acceleration: for grinding.
    Fine,
}

impl NamedChoice for Accuracy {
    const ALL: &'static [(&'static str, Self)] =
        &[("draft", Self::Draft), ("standard", Self::Standard), ("fine", Self::Fine)];
}

impl Accuracy {
    /// Tolerance of the outline, m.
    #[must_use]
    pub fn tolerance(self) -> f64 {
        match self {
            Self::Draft => 50e-6,
            Self::Standard => 5e-6,
            Self::Fine => 0.5e-6,
        }
    }

    /// Largest error of the acceleration as cut, where one is kept.
    #[must_use]
    pub fn acceleration(self) -> Option<RateTolerance> {
        match self {
            Self::Draft => None,
            Self::Standard => Some(RateTolerance::Share(0.05)),
            Self::Fine => Some(RateTolerance::Share(0.01)),
        }
    }
}

/// What a drawing must contain, and how exactly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// How near the outlines keep to the exact curves, and on which side.
    pub fit: Fit,
    /// The flank of a body whose sections differ is needed as a surface.
    pub flank: bool,
    /// Radius of a cutter whose path is needed, m.
    pub cutter_radius: Option<f64>,
    /// The list of places for a measuring machine that is needed.
    pub inspection: Option<Inspection>,
    /// The gauge follower whose lift table is needed.
    pub gauge: Option<Gauge>,
    /// Formats of files that machines run and that have no options: [`tool_files::requested`](crate::tool_files::requested).
    pub formats: FormatSet,
    /// Largest errors of velocity and acceleration as cut, in place of those of `fit`.
    pub rates: [Option<RateTolerance>; 2],
    /// Refuse a cam whose follower has larger errors, of velocity and of acceleration; else they are only reported.
    pub strict: [bool; 2],
    /// The table of points that is needed.
    pub points: Option<Points>,
    /// The program for a milling machine that is needed.
    pub milling: Option<Milling>,
    /// The cam angle at which the cut starts, rad; `None` for the middle of the longest dwell at the lowest lift, or the flattest joint.
    pub start: Option<f64>,
    /// The path of the tool to that start, where one is drawn.
    pub lead_in: Option<LeadIn>,
}

impl Request {
    /// Outlines within a tolerance (m) whose errors of the acceleration are those of [`Accuracy::Standard`]; larger ones are only reported.
    #[must_use]
    pub fn usual(fit: impl Into<Fit>) -> Self {
        let rates = [None, Accuracy::default().acceleration()];
        Self { rates, strict: [true, false], ..Self::within(fit) }
    }

    /// Outlines within a tolerance (m), nothing else: the errors of velocity and acceleration are as they come.
    #[must_use]
    pub fn within(fit: impl Into<Fit>) -> Self {
        Self {
            fit: fit.into(),
            flank: false,
            cutter_radius: None,
            points: None,
            milling: None,
            formats: FormatSet::default(),
            inspection: None,
            gauge: None,
            rates: [None; 2],
            strict: [true; 2],
            start: None,
            lead_in: None,
        }
    }

    /// Without the files that machines run in addition to the outline.
    #[must_use]
    pub fn without_tool_files(self) -> Self {
        let formats = FormatSet::default();
        Self { points: None, milling: None, formats, inspection: None, gauge: None, ..self }
    }

    /// With the tolerances of the motion as numbers for a body.
    ///
    /// # Errors
    /// [`Refusal`] when they do not fit its follower, or need a speed.
    pub fn resolved(self, body: &dyn Body) -> Result<Self, Refusal> {
        let [velocity, acceleration] = self.rates;
        let number = |rate: Option<RateTolerance>, order: usize, own: f64| match rate {
            Some(rate) => {
                let rate = rate.by_angle(body, order)?;
                let largest = body.largest_rates().get(order - 1).copied().unwrap_or(0.0);
                match rate {
                    rate if rate > 0.0 && rate < FINEST_RATE * largest => {
                        let rate = rate_word(order);
                        let what = "needs more arcs than any control reads";
                        Err(Refusal::new(format!(
                            "a tolerance of the {rate} below {FINEST_RATE} of the largest {what}"
                        ))
                        .remedy("give a larger one"))
                    }
                    rate if rate > 0.0 => Ok(rate),
                    _ => Ok(f64::INFINITY),
                }
            }
            None => Ok(own),
        };
        let own = self.fit.motion;
        let motion = MotionTolerance {
            velocity: number(velocity, 1, own.velocity)?,
            acceleration: number(acceleration, 2, own.acceleration)?,
        };
        Ok(Self { fit: Fit { motion, ..self.fit }, ..self })
    }
}

/// A body as drawn, in millimetres.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// What is cut, a part for each section.
    pub parts: Vec<Part>,
    /// The flank of a body whose sections differ, when it was requested.
    pub flank: Option<Flank>,
    /// The path of a cutter, when it was requested, or why the cutter has none: then the check of the cutter's radius fails
    /// too.
    pub cutter_path: Option<Result<Outline, OutlineError>>,
    /// Its paths along the other flanks of a part with several.
    pub other_cutter_paths: Vec<Result<Outline, OutlineError>>,
    /// What is drawn of a body with flanks that a roller sweeps in space, in the place of parts.
    pub swept: Option<Box<SweptDrawing>>,
}

impl Drawn {
    /// Parts alone.
    #[must_use]
    pub fn of(parts: Vec<Part>) -> Self {
        Self { parts, flank: None, cutter_path: None, other_cutter_paths: Vec::new(), swept: None }
    }

    /// The outlines of all parts, each with its part, in the order of the cuts of the body.
    pub fn outlines(&self) -> impl Iterator<Item = (&Part, Layer, &Outline)> {
        self.parts.iter().flat_map(|part| part.outlines().map(move |(layer, outline)| (part, layer, outline)))
    }

    /// The paths of the cutter along every flank.
    pub fn cutter_paths(&self) -> impl Iterator<Item = &Result<Outline, OutlineError>> {
        self.cutter_path.iter().chain(&self.other_cutter_paths)
    }
}

/// Why there is no drawing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// The cam has no outline that could be cut; the checks show which limit it breaks.
    #[error("{0}")]
    NoOutline(String),
    /// The outline, the flank or a table of points cannot be drawn.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

impl From<OutlineError> for DrawError {
    fn from(error: OutlineError) -> Self {
        Self::Refused(error.into())
    }
}

/// A drawing and what rolling on it has shown, for the report.
#[derive(Debug, Clone, Copy)]
pub struct DrawingEvidence<'a> {
    /// The drawing, where it has one.
    pub drawn: Option<&'a Drawn>,
    /// What rolling on the written outlines has shown, of each that a follower rolls on in its plane.
    pub rolled: &'a [Rolled],
    /// Tolerance of the outline, mm.
    pub tolerance_mm: f64,
    /// The figures that are wanted, by their paths in the report: a section with none of them may be left out. `None` for all.
    pub wanted: Option<&'a [String]>,
}

impl DrawingEvidence<'_> {
    /// Whether a section, or a figure of one, is wanted.
    #[must_use]
    pub fn wants(&self, path: &str) -> bool {
        let is_of = |other: &String| {
            other.strip_prefix(path).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        self.wanted.is_none_or(|all| all.iter().any(is_of))
    }
}

/// Radius of the roller of a body, m; `None` under a flat face or a knife edge.
#[must_use]
pub fn radius_of_roller(body: &dyn Body) -> Option<f64> {
    match body.surface() {
        Some(surface) => Some(surface.sphere()[0]),
        None => curves(body)?.roller_radius(),
    }
}

/// The flank that was drawn, if one was.
#[must_use]
pub fn flank_of<'a>(found: &DrawingEvidence<'a>) -> Option<&'a Flank> {
    found.drawn?.flank.as_ref()
}

/// The one of several followers whose angles and forces a row has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RowFollower {
    /// "outer roller".
    pub name: &'static str,
    /// The greatest pressure angle of all its followers, rad.
    pub greatest_pressure_angle: f64,
}

/// A solved cam: what checks, drawings, tables and reports need of it, whatever its kind.
pub trait Body: std::fmt::Debug + Send + Sync {
    /// Its kind.
    fn kind(&self) -> &'static Kind;

    /// The machine it is for.
    fn machine(&self) -> &Machine;

    /// For which speeds it is made.
    fn speeds(&self) -> Speeds;

    /// What is cut: its outlines, in the order of the parts of a drawing.
    fn cuts(&self) -> Vec<Cut<'_>>;

    /// The surface of a body whose sections differ along its axis.
    fn surface(&self) -> Option<&dyn Surface> {
        None
    }

    /// The flanks that a roller sweeps in space, of a body that has no outlines.
    fn swept(&self) -> Option<&dyn SweptFlanks> {
        None
    }

    /// The tables that it has in addition to that of its rows, in the order of [`SweptDrawing::tables`], with so many rows over a turn and, where one
    /// is given, for a cutter of a radius, m.
    fn further_tables(&self, _samples: u32, _cutter: Option<f64>) -> Vec<Table> {
        Vec::new()
    }

    /// The place that belongs to a value of the motion's parameter.
    fn place(&self, parameter: f64) -> Place {
        Place::at_angle(parameter)
    }

    /// Where a worst place lies along the axis, for a reader, where that is informative.
    fn along_axis(&self, _z: f64) -> Option<Text> {
        None
    }

    /// What is cut in addition to an outline (mm): bore and balance holes, counter-clockwise.
    fn holes_within(&self, _outline: &Contour) -> Vec<Entity> {
        Vec::new()
    }

    /// Angular speed of the shaft that gives the time, rad/s, where it is known: of the cam, or of the crank of a plate.
    fn shaft_speed(&self) -> Option<f64> {
        None
    }

    /// That shaft, where it does not turn as fast as the main shaft.
    fn shaft(&self) -> Option<Shaft> {
        None
    }

    /// Largest velocity and acceleration of the motion by the angle of that shaft, m or rad per rad and rad².
    fn largest_rates(&self) -> [f64; 2] {
        let of = |cut: &Cut<'_>| Some(cut.worst?.largest_rates(cut.curves?.motion));
        let larger = |[v, a]: [f64; 2], [w, b]: [f64; 2]| [v.max(w), a.max(b)];
        self.cuts().iter().filter_map(of).fold([0.0; 2], larger)
    }

    /// The parameter at which a point of the drawing (m) lies.
    fn parameter_at(&self, point: Vector2<f64>) -> f64;

    /// Whether a point of the drawing lies within reach (both m) of a corner that its outline is meant to have.
    fn corner_within(&self, _point: Vector2<f64>, _reach: f64) -> bool {
        false
    }

    /// Straight edges of the drawing (m) that no follower touches.
    fn edges(&self) -> Vec<[Vector2<f64>; 2]> {
        Vec::new()
    }

    /// The exact outline of one of its cuts as it lies in the drawing, mm; `None` where it has no exact outline.
    ///
    /// # Errors
    /// [`NoEnvelope`] when the profile folds over itself.
    fn boundary<'a>(&'a self, cut: &Cut<'a>) -> Result<Option<Boundary<'a>>, NoEnvelope> {
        let Some(curves) = cut.curves else { return Ok(None) };
        let stretches = boundary::stretches(curves, cut.is_undercut())?;
        Ok(Some(exact(curves, &if cut.mirrored == [true] { mirrored(&stretches) } else { stretches })))
    }

    /// Takes the figures that checks judge: of each check that applies to it one measure, or one for each of its flanks.
    fn measures(&self, of: &mut Measures<'_>);

    /// What presses the follower on, as far as a written outline shows it; `None` where no force is known.
    fn load(&self) -> Option<&dyn LoadAsCut> {
        None
    }

    /// Draws what is cut.
    ///
    /// # Errors
    /// [`DrawError`] when there is no outline, or it cannot be drawn.
    fn draw(&self, request: &Request) -> Result<Drawn, DrawError>;

    /// Height of the solid, mm: from 0 to the thickness of a plane cam, the ends of a conoid; `None` when none is given.
    fn height(&self) -> Option<(f64, f64)> {
        self.machine().cam.thickness.map(|thickness| (0.0, MILLIMETRES * thickness))
    }

    /// The rows of its point table.
    fn rows(&self, samples: u32) -> Vec<Row>;

    /// The row of its table at a parameter of a piece of its motion, as that piece has it; `None` of a body whose sections differ.
    fn row_on(&self, _piece: usize, _parameter: f64) -> Option<Row> {
        None
    }

    /// The motion of its follower; `None` of a body whose sections differ.
    fn follower_motion(&self) -> Option<&dyn Motion> {
        curves_of(self).map(|curves| curves.motion)
    }

    /// Metres at its follower for a unit of its motion: 1 along a path, the length of the arm of one that swings.
    fn leverage(&self) -> f64 {
        let swinging = curves_of(self).filter(|curves| curves.motion.quantity() == Quantity::Angle);
        swinging.map_or(1.0, |curves| curves.follower.leverage(&Jet::default()).abs())
    }

    /// The follower whose forces and angles a row has, if the cam has several.
    fn row_follower(&self) -> Option<RowFollower> {
        None
    }

    /// The stretches of its motion on which the values of a row are smooth, each with its piece.
    fn smooth_stretches(&self) -> Vec<(usize, (f64, f64))> {
        let pieces = self.follower_motion().map_or(&[][..], |motion| motion.pieces());
        pieces.iter().enumerate().map(|(index, piece)| (index, (piece.start, piece.end))).collect()
    }

    /// What it and its parts contribute to the report.
    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section>;

    /// How its mechanism moves, at so many steps of a turn or of a stroke, with the outlines of a drawing.
    fn mechanism(&self, drawn: &Drawn, samples: u32) -> MovingMechanism;

    /// What is not modelled of it, and why, a sentence each.
    fn not_modelled(&self) -> Vec<&'static str>;

    /// The largest error of the lift along the follower's path that the machine permits, m, and what sets it.
    fn permitted_path_error(&self) -> Option<(f64, &'static str)> {
        None
    }

    /// What its review sheet shows.
    ///
    /// # Errors
    /// [`OutlineError`] when a curve for viewing cannot be drawn.
    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError>;

    /// What its drawing for manufacture shows: the part and nothing else.
    ///
    /// # Errors
    /// [`OutlineError`] when a curve for viewing cannot be drawn.
    fn part_view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        Ok(part_drawing::without_mechanism(self.view(drawn)?))
    }
}

/// Motion and follower that roll on the first cut of a body; `None` where it is cut of a surface.
#[must_use]
pub fn curves(body: &dyn Body) -> Option<Curves<'_>> {
    curves_of(body)
}

/// A lift below this is rounding, m.
const NO_LIFT: f64 = 1e-12;

/// Refuses a tolerance of the outline of a motion (m) within which the follower need not move at all; a machine has checks of what it asks for.
pub(crate) fn finer_than_the_lift(body: &dyn Body, tolerance: f64) -> Result<(), Refusal> {
    let Some(curves) = curves(body).filter(|_| body.kind().command == cams::MAKE) else { return Ok(()) };
    let (_, most) = lifts(curves.motion);
    let travel = match curves.motion.quantity() {
        Quantity::Length => most,
        Quantity::Angle => most * curves.follower.leverage(&Jet::default()),
    };
    // A cam of dwells alone is a circle on purpose.
    if tolerance < travel || travel <= NO_LIFT {
        return Ok(());
    }
    let (tolerance, travel) = (1e6 * tolerance, shown(1e6 * travel));
    let what = format!(
        "the tolerance of {tolerance} um is not below the lift of {travel} um: within it the follower need not move"
    );
    Err(Refusal::new(what).remedy("give a finer --tolerance"))
}

/// [`curves`] of a body whose type is known.
pub(crate) fn curves_of<B: Body + ?Sized>(body: &B) -> Option<Curves<'_>> {
    body.cuts().first()?.curves
}

/// The loop of these stretches of a plane cam, mm.
#[must_use]
pub fn exact<'a>(curves: Curves<'a>, stretches: &[BoundaryStretch]) -> Boundary<'a> {
    let frame = move |piece: usize, parameter: f64| curves.profile(piece, parameter).scaled(MILLIMETRES);
    Boundary::new(Box::new(frame), stretches)
}

/// Mirrored about X and reversed, so that the metal stays on the left.
pub fn mirrored(stretches: &[BoundaryStretch]) -> Vec<BoundaryStretch> {
    stretches.iter().rev().map(BoundaryStretch::mirrored).collect()
}

/// A worst place of a plane cam.
#[must_use]
pub fn plane(found: extremum::Extremum) -> Worst {
    Worst { value: found.value, at: found.at, z: 0.0 }
}

/// Share of the largest inertia below which a residual force is rounding.
pub const ROUNDING_OF_BALANCE: f64 = 1e-12;

/// The largest value over a motion of something that is smooth on its pieces.
pub fn largest(curves: Curves<'_>, value: impl Fn(usize, f64) -> f64) -> Worst {
    plane(extremes::largest_smooth(curves, (&[], 0.0), value))
}

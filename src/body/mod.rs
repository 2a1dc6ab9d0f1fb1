//! Bodies: what is cut. A body is solved from a machine, finds its worst places, draws itself to a tolerance, and contributes
//! to table, report and sheet.
//!
//! A new body is a folder here with `impl Body`, one line in [`KINDS`] and its command.

mod balance;
pub mod balancing;
pub mod conoid;
pub mod disc;
mod loaded;
mod part;
mod picture;
pub mod points;
mod sheet;
mod sizing;
mod stress;
pub mod tension;
pub mod torque;
pub mod wedge;
mod worst_places;

pub(crate) use balance::reversal_of_bed;
pub use balance::{AsCut, Balance, USEFUL};
pub use loaded::{Lowered, Yielding};
pub use part::{Layer, NEGLIGIBLE_MM, Part};
pub use sheet::traces;
use sizing::{broken_limit, no_radius, passing};
pub use worst_places::WorstPlaces;
use worst_places::radius_of;

use crate::follower::Element;
use crate::geometry::boundary::{Boundary, Stretch};
use crate::geometry::contour::Contour;
use crate::geometry::{Entity, MILLIMETRES};
use crate::load::RunUp;
use crate::machine::Machine;
use crate::motion::{BrakeDisc, Jet, Quantity, State};
use crate::numeric::extremum;
use crate::profile::envelope::NoEnvelope;
use crate::profile::outline::{Fit, MotionTolerance, Outline, OutlineError};
use crate::profile::{Contact, Curves, Worst, boundary, envelope, extremes};
use crate::report::mechanism::Mechanism;
use crate::report::sheet::View;
use crate::report::{Place, Rolled, Section, Speeds};
use crate::table::Row;
use conoid::Conoid;
use conoid::flank::{Flank, FlankError};
use nalgebra::Vector2;

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

/// Every kind of body.
pub const KINDS: &[&Kind] =
    &[&disc::ROTARY, &disc::GENERAL, &disc::COMPENSATOR, &disc::BRAKE, &wedge::KIND, &conoid::KIND];

/// Least tolerance of velocity or acceleration, over the largest of the motion.
const FINEST_RATE: f64 = 1e-6;
/// Places that are told of those where motion is lost.
const MOST_LOSSES: usize = 8;

/// A largest error of velocity or acceleration, as it is asked for.
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

/// Why a tolerance of the motion cannot be applied.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RateError {
    /// Per second, and there is no speed.
    #[error("a tolerance per second needs the speed of the cam: give --rpm, or a tolerance per rad or as a share")]
    NoSpeed,
    /// So many arcs would be needed that no control reads them.
    #[error(
        "a tolerance of the {rate} below {FINEST_RATE} of the largest needs arcs without number; give a larger one"
    )]
    TooFine {
        /// "velocity" or "acceleration".
        rate: &'static str,
    },
    /// Metres for a follower that swings, or the other way round.
    #[error("the follower {follower}: the tolerance of its {rate} must be a share or in {unit}")]
    WrongUnit {
        /// What it does.
        follower: &'static str,
        /// "velocity" or "acceleration".
        rate: &'static str,
        /// The unit by the angle.
        unit: &'static str,
    },
}

impl RateTolerance {
    /// By the angle of the shaft, m or rad, of the velocity (order 1) or the acceleration (order 2) of a body.
    fn by_angle(self, body: &dyn Body, order: usize) -> Result<f64, RateError> {
        let swings = body.plane().is_some_and(|curves| curves.motion.quantity() == Quantity::Angle);
        match self {
            Self::Share(share) => Ok(share * body.largest_rates().get(order - 1).copied().unwrap_or(0.0)),
            Self::Rate { swing, .. } if swing != swings => Err(RateError::WrongUnit {
                follower: if swings { "swings" } else { "does not swing" },
                rate: if order == 1 { "velocity" } else { "acceleration" },
                unit: match (swings, order) {
                    (true, 1) => "rad/rad",
                    (true, _) => "rad/rad2",
                    (false, 1) => "mm/rad",
                    (false, _) => "mm/rad2",
                },
            }),
            Self::Rate { value, by_time: false, .. } => Ok(value),
            Self::Rate { value, by_time: true, .. } => {
                let speed = body.shaft_speed().ok_or(RateError::NoSpeed)?;
                Ok(if order == 1 { value / speed } else { value / (speed * speed) })
            }
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
    pub cutter: Option<f64>,
    /// Largest errors of velocity and acceleration as cut, in place of those of `fit`.
    pub rates: [Option<RateTolerance>; 2],
    /// Refuse a cam whose follower feels more, by velocity or by acceleration; else it is told.
    pub strict: [bool; 2],
    /// The table of points that is needed.
    pub points: Option<points::Points>,
}

impl Request {
    /// Outlines within a tolerance (m), nothing else.
    #[must_use]
    pub fn within(fit: impl Into<Fit>) -> Self {
        Self { fit: fit.into(), flank: false, cutter: None, points: None, rates: [None; 2], strict: [true; 2] }
    }

    /// With the tolerances of the motion as numbers for a body.
    ///
    /// # Errors
    /// [`RateError`] when they do not fit its follower, or need a speed.
    pub fn resolved(self, body: &dyn Body) -> Result<Self, RateError> {
        let [velocity, acceleration] = self.rates;
        let number = |rate: Option<RateTolerance>, order: usize, own: f64| match rate {
            Some(rate) => {
                let rate = rate.by_angle(body, order)?;
                let largest = body.largest_rates().get(order - 1).copied().unwrap_or(0.0);
                match rate {
                    rate if rate > 0.0 && rate < FINEST_RATE * largest => {
                        Err(RateError::TooFine { rate: if order == 1 { "velocity" } else { "acceleration" } })
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
}

/// Why there is no drawing.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DrawError {
    /// The cam has no outline that could be cut; the checks show which limit it breaks.
    #[error("{0}")]
    NoOutline(String),
    /// The outline cannot be drawn.
    #[error(transparent)]
    Outline(#[from] OutlineError),
    /// The flank cannot be drawn.
    #[error(transparent)]
    Flank(#[from] FlankError),
    /// There is no such table of points.
    #[error("no table of points: {0}")]
    Points(#[from] points::TableError),
}

/// Why there is no cam.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
    /// Of a disc.
    #[error(transparent)]
    Disc(#[from] disc::DiscError),
    /// Of a plate on the bed.
    #[error(transparent)]
    Wedge(#[from] wedge::WedgeError),
    /// Of a conoid.
    #[error(transparent)]
    Conoid(#[from] conoid::ConoidError),
}

/// What was found of a drawing, for the report.
#[derive(Debug, Clone, Copy)]
pub struct Found<'a> {
    /// The drawing; `None` when there is none.
    pub drawn: Option<&'a Drawn>,
    /// What rolling on the written outline has shown.
    pub rolled: Option<&'a Rolled>,
    /// Tolerance of the outline, mm.
    pub tolerance_mm: f64,
}

/// The flank that was drawn, if one was.
fn flank_of<'a>(found: &Found<'a>) -> Option<&'a Flank> {
    found.drawn?.flank.as_ref()
}

/// A solved cam: what checks, drawings, tables and reports need of it, whatever its kind.
pub trait Body: std::fmt::Debug + Send + Sync {
    /// Its kind.
    fn kind(&self) -> &'static Kind;

    /// The machine it is for.
    fn machine(&self) -> &Machine;

    /// For which speeds it is made.
    fn speeds(&self) -> Speeds;

    /// Motion and follower of a body whose sections are all alike.
    fn plane(&self) -> Option<Curves<'_>>;

    /// The body whose sections differ along its axis, if it is one.
    fn spatial(&self) -> Option<&Conoid> {
        None
    }

    /// The place that belongs to a value of the motion's parameter.
    fn place(&self, parameter: f64) -> Place {
        Place::at_angle(parameter)
    }

    /// Where a worst place lies along the axis, for a reader, where that is informative.
    fn along_axis(&self, _z: f64) -> Option<String> {
        None
    }

    /// What is cut beside an outline (mm): bore and balance holes, counter-clockwise.
    fn holes_within(&self, _outline: &Contour) -> Vec<Entity> {
        Vec::new()
    }

    /// Angular speed of the shaft that gives the time, rad/s, where it is known: of the cam, or of the crank of a plate.
    fn shaft_speed(&self) -> Option<f64> {
        None
    }

    /// Largest velocity and acceleration of the motion by the angle of that shaft, m or rad per rad and rad².
    fn largest_rates(&self) -> [f64; 2] {
        let found = self.plane().zip(self.worst_places());
        found.map_or([0.0; 2], |(curves, worst)| worst.largest_rates(curves.motion))
    }

    /// The parameter at which a point of the drawing (m) lies.
    fn parameter_at(&self, point: Vector2<f64>) -> f64;

    /// Whether a point of the drawing lies within reach (both m) of a corner that its outline is meant to have.
    fn corner_within(&self, _point: Vector2<f64>, _reach: f64) -> bool {
        false
    }

    /// Ways in which the follower meets the drawing: as it is, or with the drawing mirrored about X.
    fn mirrored(&self) -> &'static [bool];

    /// Straight edges of the drawing (m) that no follower touches.
    fn edges(&self) -> Vec<[Vector2<f64>; 2]> {
        Vec::new()
    }

    /// The worst places of a plane cam, kept once they are found.
    fn worst_places(&self) -> Option<&WorstPlaces> {
        None
    }

    /// Largest |pressure angle| where a follower runs, rad.
    fn pressure_angle(&self) -> Worst {
        let [rising, falling] = self.pressure_angles();
        rising.or_larger(falling)
    }

    /// The largest pressure angle, and the largest of the other sign as a positive number, where a follower runs, rad. A body that does
    /// not tell them apart has the largest of both first.
    fn pressure_angles(&self) -> [Worst; 2] {
        let found = self.plane().zip(self.worst_places());
        found.map_or([Worst::NONE; 2], |(curves, worst)| worst.pressure_angles(curves))
    }

    /// Whether the forces of a motion program are told without the inertia of a mass that is given, since no speed is.
    fn lacks_inertia(&self) -> bool {
        let of_program = self.plane().is_some_and(|curves| curves.motion.program().is_some());
        of_program && self.machine().follower.mass.is_some() && self.shaft_speed().is_none()
    }

    /// Smallest convex radius of what the follower draws, m: 0 at a corner, infinite where nothing is convex; negative where a
    /// profile under a face turns back on itself.
    fn least_radius(&self) -> Worst {
        let nowhere = Worst { value: f64::INFINITY, ..Worst::NONE };
        self.plane().zip(self.worst_places()).map_or(nowhere, |(curves, worst)| worst.least_radius(curves))
    }

    /// The same where a follower runs.
    fn least_rolled_radius(&self) -> Worst {
        self.least_radius()
    }

    /// Radius of the largest cutter that fits into the concave parts, m; `None` where nothing is concave.
    fn hollow(&self) -> Option<Worst> {
        let curves = self.plane()?;
        self.worst_places().map_or_else(|| worst_places::hollow(curves), |worst| worst.hollow(curves))
    }

    /// What the follower loses of its motion where the profile is undercut, a sentence each: of many places those where it is most.
    fn lost_motion(&self) -> Vec<String> {
        let Some(curves) = self.plane() else { return Vec::new() };
        let mut losses = match envelope::losses(curves) {
            Err(error) => return vec![format!("{error}, at {}", self.place(error.parameter))],
            Ok(losses) => losses,
        };
        let more = losses.len().saturating_sub(MOST_LOSSES);
        if more > 0 {
            losses.sort_by(|a, b| b.lost.total_cmp(&a.lost));
            losses.truncate(MOST_LOSSES);
            losses.sort_by(|a, b| a.from.total_cmp(&b.from));
        }
        let told = losses.iter().map(|loss| {
            let [from, to, at] = [loss.from, loss.to, loss.lost_at].map(|place| self.place(place));
            let lost = MILLIMETRES * loss.lost;
            // Seven digits, as exactly as it is known.
            let lost = if lost < 1e-4 { format!("{lost:.6e}") } else { format!("{lost:.6}") };
            format!("motion is lost from {from} to {to}, {lost} mm at {at}")
        });
        let others = (more > 0).then(|| format!("and at {more} more places, nowhere more of it"));
        told.chain(others).collect()
    }

    /// Radius of the roller, m; `None` under a flat face or a knife edge.
    fn roller_radius(&self) -> Option<f64> {
        match self.plane()?.element() {
            Element::Roller { radius } => Some(radius).filter(|radius| *radius > 0.0),
            Element::Face => None,
        }
    }

    /// Least metal between the profile and what bounds it inside, m, if anything does; with its place where that is known.
    fn wall(&self) -> Option<(f64, Option<Worst>)>;

    /// Room between two rollers that face each other, m, and where it is least; `None` where there is only one.
    fn roller_clearance(&self) -> Option<Worst> {
        None
    }

    /// Force between follower and cam along the normal, N, at a parameter of a piece where it stands like this; `None` where no force
    /// is known.
    fn contact_force(&self, at: (usize, f64), contact: &Contact) -> Option<f64>;

    /// Force of the cam on the follower along its path, N, or its moment about the pivot of one that swings, N·m, and the torque of the
    /// shaft against it, N·m, at a cam angle; `None` where no force is known.
    fn force_and_torque(&self, angle: f64) -> Option<[f64; 2]> {
        let motion = self.plane()?.motion;
        let (piece, inside) = motion.locate(angle);
        self.force_and_torque_of((piece, inside), motion.jet(piece, inside))
    }

    /// The same at a parameter of a piece whose lift is known.
    fn force_and_torque_of(&self, _at: (usize, f64), _lift: Jet) -> Option<[f64; 2]> {
        None
    }

    /// The second disc that takes its torque, with what it does by its law; `None` where none is described.
    fn compensating(&self) -> Option<Result<(disc::Disc, disc::Compensated), disc::DiscError>> {
        None
    }

    /// The motion of a disc that holds the tension of a belt brake; `None` of any other cam.
    fn brake_disc(&self) -> Option<&BrakeDisc> {
        None
    }

    /// Largest pressure between roller and cam after Hertz, Pa; `None` where thickness, material or forces are not given.
    fn contact_stress(&self) -> Option<Worst>;

    /// Least force that presses the follower onto the cam along its path, N; `None` when the machine file gives
    /// neither mass nor preload of the follower.
    fn least_closing_force(&self) -> Option<Worst> {
        let follower = &self.machine().follower;
        let least = (follower.mass.is_some() || follower.preload.is_some()).then(|| self.largest_lifting_force());
        least.map(|least| Worst { value: -least.value, ..least })
    }

    /// Radius of a crowned roller's rim along its axis, m; `None` of a straight one, and under a face.
    fn crown_radius(&self) -> Option<f64> {
        None
    }

    /// A preload, as a key of the machine file, that keeps the follower on the cam at so many times the speed of the cam.
    fn preload_that_holds(&self, _speed: f64) -> Option<String> {
        None
    }

    /// Speed of the cam at which the follower first leaves it, rad/s, and where, infinite where it never does; or why that is not
    /// known. `None` where nothing tells of it.
    fn jump_speed(&self) -> Option<Result<Worst, String>> {
        None
    }

    /// Least share of the force along the normal that is left along the path beside the friction of the follower's guide, and where; `None`
    /// without a guide.
    fn guide_share(&self) -> Option<Worst> {
        None
    }

    /// The vibration of an elastic train behind the follower; `None` where none is described, or the speed is not known.
    fn vibration(&self) -> Option<&disc::Vibration> {
        None
    }

    /// Largest force that lifts the follower from the cam along its path, N; negative where it is pressed on everywhere.
    fn largest_lifting_force(&self) -> Worst;

    /// Size of the residual force that the force balance leaves, N, with the follower `moved` (m) along its path from where the
    /// motion puts it, touching the cam where its normal is this unit vector out of the metal; 0 without a load.
    fn unbalanced(&self, piece: usize, parameter: f64, moved: f64, normal: Vector2<f64>) -> f64;

    /// The same of a cam that turns, with its press in a state.
    fn unbalanced_in(&self, _state: &State, _moved: f64) -> f64 {
        0.0
    }

    /// The exact outline as it lies in the drawing, mm, of a cut at a place along the axis, m; `None` where there is no cut.
    ///
    /// # Errors
    /// [`NoEnvelope`] when the profile folds over itself.
    fn boundary(&self, _z: f64) -> Result<Option<Boundary<'_>>, NoEnvelope> {
        let Some(curves) = self.plane() else { return Ok(None) };
        let stretches = boundary::stretches(curves, self.least_radius().value <= curves.offset())?;
        Ok(Some(exact(curves, &if self.mirrored() == [true] { mirrored(&stretches) } else { stretches })))
    }

    /// The force balance that the cam is made for; `None` without a load.
    fn balance(&self) -> Option<Balance> {
        None
    }

    /// Largest residual force of the motion itself, N, as if it were cut without error, in the directions in which the forces
    /// are to balance.
    fn residual_of_motion(&self) -> Worst {
        Worst { value: 0.0, ..Worst::NONE }
    }

    /// The same in the direction of the bed in which the forces are not to balance; `None` where they are in all.
    fn residual_unbalanced_way(&self) -> Option<Worst> {
        None
    }

    /// Changes, each of which alone brings the residual force of that direction below what is left without a cam.
    fn remedies_unbalanced_way(&self) -> Vec<String> {
        Vec::new()
    }

    /// What would keep the bottom off the piston where an outline within a tolerance (m) may miss the motion.
    fn as_cut(&self, _tolerance: f64) -> Option<AsCut> {
        None
    }

    /// Least air between piston and bottom while the bottom moves, m; `None` without air.
    fn least_air(&self) -> Option<Worst> {
        None
    }

    /// How much lift the run-up adds; `None` without one.
    fn run_up(&self) -> Option<RunUp> {
        None
    }

    /// Changes, each of which alone keeps the pressure between roller and cam below a limit (Pa) that it exceeds by `largest`.
    fn stress_remedies(&self, _largest: f64, _limit: f64) -> Vec<String> {
        Vec::new()
    }

    /// Parameters at which the residual force may jump: where the air closes and opens.
    fn force_jumps(&self) -> Vec<f64> {
        Vec::new()
    }

    /// A change with which every limit that depends on the size is kept, tried before it is told; or why there is none.
    fn remedy(&self) -> Option<String> {
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

    /// What it and its parts contribute to the report.
    fn sections(&self, found: &Found<'_>) -> Vec<Section>;

    /// How its mechanism moves, at so many steps of a turn or of a stroke, with the outlines of a drawing.
    fn mechanism(&self, drawn: &Drawn, samples: u32) -> Mechanism;

    /// What is not modelled of it, and why, a sentence each.
    fn not_modelled(&self) -> Vec<&'static str>;

    /// What its review sheet shows.
    ///
    /// # Errors
    /// [`OutlineError`] when a curve for viewing cannot be drawn.
    fn view(&self, drawn: &Drawn) -> Result<View, OutlineError>;
}

/// The loop of these stretches of a plane cam, mm.
fn exact<'a>(curves: Curves<'a>, stretches: &[Stretch]) -> Boundary<'a> {
    let frame = move |piece: usize, parameter: f64| curves.profile(piece, parameter).scaled(MILLIMETRES);
    Boundary::new(Box::new(frame), stretches)
}

/// Mirrored about X and run the other way, so that the metal stays on the left.
fn mirrored(stretches: &[Stretch]) -> Vec<Stretch> {
    stretches.iter().rev().map(Stretch::mirrored).collect()
}

/// A worst place of a plane cam.
fn plane(found: extremum::Extremum) -> Worst {
    Worst { value: found.value, at: found.at, z: 0.0 }
}

/// Of the largest inertia, the residual force that is rounding: it need not be told to its last digit.
const ROUNDING_OF_BALANCE: f64 = 1e-12;

/// The largest value over a motion of something that is smooth on its pieces.
fn largest(curves: Curves<'_>, value: impl Fn(usize, f64) -> f64) -> Worst {
    plane(extremes::largest_smooth(curves, (&[], 0.0), value))
}

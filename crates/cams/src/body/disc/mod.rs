//! The disc cam: one section for one speed, under any follower.

mod as_made;
pub(in crate::body) mod delegate;
mod duty;
mod dynamics;
mod figures;
mod forces;
mod jump;
mod keyway_wall;
mod loaded;
mod mechanism;
pub(in crate::body) mod program;
pub mod residual_vibration;
mod roller_life;
mod size;
mod size_figures;
mod steady_vibration;
mod stress_remedies;
mod vibration;
pub use super::roller_bearing::RollerDuty;
pub use super::shaft_torque::ShaftTorque;
pub use duty::{Duty, Purpose};
pub use dynamics::Spin;
pub use vibration::{Movement, Resonance, Vibration};
mod sheet;
mod shop_views;
pub use size::{Binding, FollowerChoice};
mod without_size;
pub use size_figures::{BestPlace, SizeFigures};

use super::figures::with_subject;
use super::part::{Part, point_as_turned};
use super::{
    Body, Cut, DrawError, DrawingEvidence, Drawn, Figures, Kind, Layer, LoadAsCut, ROUNDING_OF_BALANCE, Request,
    WorstPlaces, plane,
};
use crate::check::Measures;
use crate::load::Load;
use crate::machine::{Machine, Rotation};
use crate::report::mechanism::MovingMechanism;
use crate::report::sheet::SheetView;
use crate::report::{CamMeasures, Section, Shaft, Speeds, degrees};
use crate::table::{Row, TurnAngles, turned};
use camgen_kernel::document::cams;
use camgen_kernel::follower::{Element, Follower};
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::{Entity, MILLIMETRES, radius_of_curvature};
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::profile::extremes;
use camgen_kernel::profile::outline::{self, OutlineError};
use camgen_kernel::profile::size::SmallestSize;
use camgen_kernel::profile::{Contact, Curves, Worst, lifts};
use camgen_kernel::refusal::Refusal;
use camgen_kernel::units;
use mechanism::SecondDisc;
use nalgebra::Vector2;
use std::f64::consts::TAU;
use std::sync::{Arc, OnceLock};

/// The disc cam of any motion.
pub const GENERAL: Kind = Kind { command: "make", noun: "disc cam", keys: cams::MAKE };

/// Largest base radius that is tried, m: what a drawing holds.
const LARGEST_BASE: f64 = outline::LARGEST_COORDINATE / MILLIMETRES;

/// What holds a follower on its disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::body) enum Hold {
    /// A force that presses it on.
    Force,
    /// A second flank on the other side of the same roller.
    Flanks,
    /// A second roller of the same follower on another disc.
    Pair {
        /// The force along the normal with which both rollers are pressed on at rest, N.
        preload: f64,
        /// The largest lift of the main disc, m or rad, where this one is the counter disc.
        counter: Option<f64>,
    },
}

/// The role of a disc in its body.
#[derive(Debug, Clone, Copy)]
pub(in crate::body) struct DiscRole {
    pub(in crate::body) kind: &'static Kind,
    pub(in crate::body) hold: Hold,
    /// Check of the parts cut with the disc and sized by it.
    pub(in crate::body) rest: Option<RestOfBody>,
    /// Whether the disc itself is cut; its own limits hold only then.
    pub(in crate::body) is_cut: bool,
}

impl DiscRole {
    /// A disc that is cut by itself.
    pub(in crate::body) fn alone(kind: &'static Kind, hold: Hold) -> Self {
        Self { kind, hold, rest: None, is_cut: true }
    }

    /// A disc with which more is cut.
    pub(in crate::body) fn with(kind: &'static Kind, hold: Hold, rest: RestOfBody) -> Self {
        Self { kind, hold, rest: Some(rest), is_cut: true }
    }
}

/// Finds the first limit that the rest of a body breaks with a disc of this size.
pub(in crate::body) type RestOfBody = fn(&Disc) -> Option<&'static str>;

/// A disc cam.
#[derive(Debug, Clone)]
pub struct Disc {
    machine: Arc<Machine>,
    kind: &'static Kind,
    rpm: Option<f64>,
    /// Angular speed of the cam, rad/s, where it is known.
    speed: Option<f64>,
    motion: Arc<dyn Motion>,
    follower: Arc<dyn Follower>,
    load: Option<Arc<dyn Load>>,
    /// Its duty in its machine.
    duty: Option<Arc<dyn Duty>>,
    /// What holds its follower on it.
    hold: Hold,
    rest: Option<RestOfBody>,
    is_cut: bool,
    /// The disc that sizes this one: the main disc of a counter disc.
    main: Option<Arc<Self>>,
    /// The disc next to it in a pair, with the cam angle by which its motion is later, rad.
    other: Option<(Arc<Self>, f64)>,
    /// Spring, guide, crown and vibration of the follower of a motion program.
    program_follower: forces::ProgramFollower,
    /// The sizes that keep every limit; `None` when none does. Computed on demand where the size is given.
    smallest: OnceLock<Option<SmallestSize>>,
    /// The prime radius of the smallest cam before it is rounded, m, computed on demand.
    exact: OnceLock<f64>,
    /// The chosen position of the follower, where it was to be chosen.
    placed: Option<FollowerChoice>,
    worst: WorstPlaces,
}

impl Disc {
    /// The cam of any motion under the machine's follower, sized; `rpm` is the speed of the cam itself, where it is known.
    ///
    /// # Errors
    /// [`Refusal`] when motion and follower do not fit each other or no radius keeps the limits.
    pub fn of_motion(machine: &Machine, motion: Arc<dyn Motion>, rpm: Option<f64>) -> Result<Self, Refusal> {
        Self::held(machine, motion, rpm, DiscRole::alone(&GENERAL, Hold::Force))
    }

    /// As [`Disc::of_motion`], as a part of a body.
    pub(in crate::body) fn held(
        machine: &Machine,
        motion: Arc<dyn Motion>,
        rpm: Option<f64>,
        role: DiscRole,
    ) -> Result<Self, Refusal> {
        if motion.period().is_none() {
            let what = "the motion is by the travel of a plate, and this cam turns";
            return Err(Refusal::new(what).remedy("camgen make with cam.body = \"wedge\" cuts it as a plate"));
        }
        let speed = rpm.map(units::rad_per_s);
        let program_follower = forces::ProgramFollower::of(machine, &*motion);
        let DiscRole { kind, hold, rest, is_cut } = role;
        Self { kind, rpm, speed, hold, rest, is_cut, program_follower, ..Self::unsized_of(machine, motion) }.sized()
    }

    /// Its speed, rpm, if it is known.
    pub(in crate::body) fn rpm(&self) -> Option<f64> {
        self.rpm
    }

    /// Its motion.
    pub(in crate::body) fn motion(&self) -> &Arc<dyn Motion> {
        &self.motion
    }

    /// Sized by another disc.
    #[must_use]
    pub(in crate::body) fn sized_by(self, main: &Self) -> Self {
        Self { main: Some(Arc::new(main.clone())), ..self }
    }

    /// Whether its motion is that of a program or of anybody's own, and not that of a machine of a domain.
    fn is_of_program(&self) -> bool {
        self.duty.is_none()
    }

    /// Whether its follower is held from both sides: a force may act either way.
    pub(in crate::body) fn is_closed(&self) -> bool {
        self.hold != Hold::Force
    }

    /// The disc under the same roller on the review sheet, for a drawing of the flanks next to it; of the body's discs `steepest` has the worst
    /// pressure angle.
    pub(in crate::body) fn view_within(&self, steepest: &Self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        sheet::view(self, steepest, drawn)
    }

    /// Its cut as one of several of a part.
    pub(in crate::body) fn cut_as(&self, name: &'static str, layer: Layer, mirrored: &'static [bool]) -> Cut<'_> {
        Cut { name, layer, ..Cut::plane(self.curves(), mirrored, &self.worst) }
    }

    /// How its mechanism moves with the follower on a second disc that turns with it, a cam angle (rad) later.
    pub(in crate::body) fn mechanism_with(
        &self,
        (disc, later): (&Self, f64),
        drawn: &Drawn,
        samples: u32,
    ) -> MovingMechanism {
        mechanism::of(self, Some(SecondDisc { disc, later, is_beside: false }), drawn, samples)
    }

    /// With another disc next to it, whose motion is later by a cam angle, rad: its pictures show both.
    #[must_use]
    pub(in crate::body) fn beside(self, other: Arc<Self>, later: f64) -> Self {
        Self { other: Some((other, later)), ..self }
    }

    fn unsized_of(machine: &Machine, motion: Arc<dyn Motion>) -> Self {
        Self {
            follower: Arc::clone(&machine.follower.shape),
            machine: Arc::new(machine.clone()),
            kind: &GENERAL,
            rpm: None,
            speed: None,
            motion,
            load: None,
            duty: None,
            hold: Hold::Force,
            rest: None,
            is_cut: true,
            main: None,
            other: None,
            program_follower: forces::ProgramFollower::default(),
            smallest: OnceLock::new(),
            exact: OnceLock::new(),
            placed: None,
            worst: WorstPlaces::default(),
        }
    }

    /// Motion and follower.
    #[must_use]
    pub fn curves(&self) -> Curves<'_> {
        Curves { motion: &*self.motion, follower: &*self.follower }
    }

    /// Prime radius, m.
    #[must_use]
    pub fn prime_radius(&self) -> f64 {
        self.follower.prime_radius().unwrap_or(f64::NAN)
    }

    /// Base radius R_b, m.
    #[must_use]
    pub fn base_radius(&self) -> f64 {
        self.prime_radius() - self.curves().offset()
    }

    /// The base radius `auto` would take, m: the smallest that passes, in whole millimetres.
    #[must_use]
    pub fn passing_base_radius(&self) -> Option<f64> {
        self.smallest().map(|smallest| smallest.base_radius)
    }

    /// Smallest prime radius that keeps every limit, m; `None` when none does.
    #[must_use]
    pub fn smallest_prime_radius(&self) -> Option<f64> {
        self.smallest().map(|smallest| *self.exact.get_or_init(|| self.before_rounding(smallest).prime_radius))
    }

    /// Largest lift, m or rad.
    #[must_use]
    pub fn max_lift(&self) -> f64 {
        lifts(&*self.motion).1
    }

    /// Largest residual force of the motion itself, N, and where: rounding, or what the motion misses; 0 without a load.
    #[must_use]
    pub fn residual_max(&self) -> Worst {
        let Some(load) = &self.load else { return Worst { value: 0.0, ..Worst::NONE } };
        let limits = (load.acting(), ROUNDING_OF_BALANCE * load.largest());
        let left = |piece: usize, angle: f64| load.residual(piece, angle, 0.0);
        plane(extremes::largest_size(self.curves(), (&limits.0, limits.1), left))
    }

    /// Whether it is made for a force balance.
    #[must_use]
    pub fn is_balanced(&self) -> bool {
        self.load.is_some()
    }

    /// What it is cut higher at a place than the law of its load, m of lift.
    #[must_use]
    pub fn added_lift(&self, piece: usize, angle: f64) -> f64 {
        self.load.as_ref().map_or(0.0, |load| load.added_lift(piece, angle))
    }

    fn row(&self, at: TurnAngles) -> Row {
        let (piece, angle) = self.motion.locate(at.angle);
        self.row_at(at, (piece, angle))
    }

    fn row_at(&self, at: TurnAngles, (piece, angle): (usize, f64)) -> Row {
        let curves = self.curves();
        let state = self.load.as_ref().and_then(|load| load.state_and_lift(piece, angle));
        let (state, lift) =
            state.map_or_else(|| (None, curves.motion.jet(piece, angle)), |(state, lift)| (Some(state), lift));
        let contact = Contact::new(curves.follower, angle, lift);
        let profile = contact.curve.offset_inward(curves.offset());
        Row {
            cam_deg: Some(at.cam_deg),
            at: Some((piece, angle)),
            lift: (self.motion.quantity() == Quantity::Length).then_some(contact.lift),
            swing: (self.motion.quantity() == Quantity::Angle).then_some(contact.lift),
            position: self.motion.origin().map(|origin| origin + contact.lift.s),
            curve: Some(point_as_turned(&self.machine, contact.curve.point * MILLIMETRES)),
            profile: Some(point_as_turned(&self.machine, profile.point * MILLIMETRES)),
            pressure_angle_deg: Some(contact.pressure_angle.to_degrees()),
            curve_radius: Some(radius_of_curvature(contact.curve.curvature)),
            profile_radius: Some(radius_of_curvature(profile.curvature)),
            force: self.force_row((piece, angle), &contact, state.as_deref()),
            added: state.as_ref().map(|state| state.columns(&at)).unwrap_or_default(),
            load: state,
            face: curves.follower.on_face(&contact.lift).map(|face| MILLIMETRES * face.place),
            ..Row::default()
        }
    }
}

impl Disc {
    /// The measures of its section `cam`.
    pub(in crate::body) fn cam_measures(&self, found: &DrawingEvidence<'_>) -> CamMeasures {
        let part = found.drawn.and_then(|drawn| drawn.parts.first());
        let on_face = extremes::places_on_face(self.curves()).map(|places| places.map(|at| MILLIMETRES * at.value));
        let wants_lift = found.wants("cam.max_lift_mm") || found.wants("cam.max_lift_deg");
        let lift =
            |quantity, unit: f64| (wants_lift && self.motion.quantity() == quantity).then(|| unit * self.max_lift());
        let spin = if self.is_of_program() && found.wants("cam.roller_turns") { self.spin() } else { None };
        let smallest = found.wants("cam.smallest_prime_radius_mm").then(|| self.smallest_prime_radius()).flatten();
        CamMeasures {
            prime_radius_mm: Some(MILLIMETRES * self.prime_radius()),
            base_radius_mm: Some(MILLIMETRES * self.base_radius()),
            roller_radius_mm: self.roller_radius().map(|radius| MILLIMETRES * radius),
            max_lift_mm: lift(Quantity::Length, MILLIMETRES),
            max_lift_deg: lift(Quantity::Angle, 1.0_f64.to_degrees()),
            smallest_prime_radius_mm: smallest.map(|radius| MILLIMETRES * radius),
            face_mm: on_face,
            roller_turns: spin.map(|spin| [spin.mean, spin.largest.value]),
            lobes: self.load.as_ref().map(|_| self.motion.lobes()),
            weight: part.map(|part| part.weight(&self.machine)).unwrap_or_default(),
        }
    }
}

impl Body for Disc {
    fn kind(&self) -> &'static Kind {
        self.kind
    }

    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn speeds(&self) -> Speeds {
        self.rpm.map_or(Speeds::Any(()), Speeds::One)
    }

    fn cuts(&self) -> Vec<Cut<'_>> {
        let mirrored: &[bool] = if self.machine.cam.rotation == Rotation::Clockwise { &[false] } else { &[true] };
        vec![Cut::plane(self.curves(), mirrored, &self.worst)]
    }

    fn holes_within(&self, outline: &Contour) -> Vec<Entity> {
        Part::holes_within(&self.machine, outline)
    }

    fn shaft_speed(&self) -> Option<f64> {
        self.speed
    }

    fn shaft(&self) -> Option<Shaft> {
        self.duty.as_ref().and_then(|duty| duty.shaft(self))
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        let angle = libm::atan2(point.y, point.x);
        match self.machine.cam.rotation {
            Rotation::Clockwise => angle,
            Rotation::CounterClockwise => -angle,
        }
    }

    /// Of a profile under a knife edge, where corners are allowed.
    fn corner_within(&self, point: Vector2<f64>, reach: f64) -> bool {
        let edge = self.curves().element() == Element::Roller { radius: 0.0 };
        if !edge || self.machine.limits.continuity >= 1.0 {
            return false;
        }
        let place = |corner: &extremes::Corner| {
            let (piece, angle) = self.motion.locate(corner.at);
            point_as_turned(&self.machine, self.curves().profile(piece, angle).point)
        };
        extremes::corners(self.curves()).iter().any(|corner| (place(corner) - point).norm() <= reach)
    }

    fn measures(&self, of: &mut Measures<'_>) {
        with_subject(self, |subject| self.measured_on(of, subject));
    }

    fn load(&self) -> Option<&dyn LoadAsCut> {
        Some(self)
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        let curves = self.curves();
        let outline = outline::profile(curves, request.fit).map_err(|error| match error {
            OutlineError::Undercut(_) => DrawError::NoOutline(error.to_string()),
            // Cusps of an undercut profile can lie too near each other to be distinguished.
            OutlineError::Fit(_) | OutlineError::Part { .. } if self.least_radius().value <= curves.offset().abs() => {
                DrawError::NoOutline(error.to_string())
            }
            other => other.into(),
        })?;
        let part = Part::turning(&self.machine, outline).with_features(&self.machine)?;
        let cutter_path = |radius: f64| {
            let path = outline::cutter_path(curves, radius, request.fit)?;
            Ok::<_, OutlineError>(Part::turning(&self.machine, path).outline)
        };
        Ok(Drawn { cutter_path: request.cutter_radius.map(cutter_path), ..Drawn::of(vec![part]) })
    }

    /// At 360 i/samples degrees; at a break of the motion the row belongs to the later piece.
    fn rows(&self, samples: u32) -> Vec<Row> {
        (0..samples).map(|i| self.row(turned(i, samples, self.motion.lobes()))).collect()
    }

    fn row_on(&self, piece: usize, parameter: f64) -> Option<Row> {
        let cam_deg = degrees(parameter);
        let crank_deg = (f64::from(self.motion.lobes()) * cam_deg) % 360.0;
        Some(self.row_at(TurnAngles { cam_deg, angle: parameter, crank_deg }, (piece, parameter)))
    }

    /// Forces may jump within a piece, in each lobe.
    fn smooth_stretches(&self) -> Vec<(usize, (f64, f64))> {
        let lobes = self.motion.lobes();
        let acting = self.acting();
        let in_lobe = |lobe: u32| {
            let shift = TAU * f64::from(lobe) / f64::from(lobes);
            acting.iter().map(move |(from, to)| (from + shift, to + shift))
        };
        let mut acting: Vec<_> = (0..lobes).flat_map(in_lobe).collect();
        acting.sort_by(|a, b| a.0.total_cmp(&b.0));
        let of_piece =
            |(index, piece)| extremes::stretches(piece, &acting).into_iter().map(move |range| (index, range));
        self.motion.pieces().iter().enumerate().flat_map(of_piece).collect()
    }

    fn sections(&self, found: &DrawingEvidence<'_>) -> Vec<Section> {
        let part = found.drawn.and_then(|drawn| drawn.parts.first());
        let cam = self.cam_measures(found);
        let outline = part.map(|part| part.measures(found.tolerance_mm, |_| false));
        let duty = self.duty.as_ref();
        let mut sections = vec![cam.section()];
        sections.extend(duty.and_then(|duty| duty.mounting(&self.machine)));
        let wants = |key: &str| found.wants(key);
        sections.extend(wants("size").then(|| self.size_section()).flatten());
        sections.extend(wants("motion").then(|| self.program()).flatten());
        sections.extend(duty.map(|duty| duty.sections(self)).into_iter().flatten());
        sections.push(outline.map_or_else(|| Section::new("outline", &()), |outline| outline.section()));
        sections.push(Section::new("rolling", &found.rolled.first()));
        sections.extend(duty.and_then(|duty| duty.forces(self, found.rolled.first())));
        sections.extend(wants("dynamics").then(|| self.dynamics(found)).flatten());
        sections.extend(wants("as_made").then(|| self.as_made()).flatten());
        sections.extend(wants("roller_bearing").then(|| self.bearing_section()).flatten());
        if wants("vibration") || wants("harmonics") {
            sections.extend(self.vibration_sections());
        }
        sections
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> MovingMechanism {
        let second = self.other.as_ref().map(|(disc, later)| SecondDisc { disc, later: *later, is_beside: true });
        mechanism::of(self, second, drawn, samples)
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        mechanism::not_modelled(self)
    }

    fn permitted_path_error(&self) -> Option<(f64, &'static str)> {
        self.duty.as_ref()?.permitted_path_error(self)
    }

    fn part_view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        Ok(super::part_drawing::of_plane_part(self, drawn, self.view(drawn)?))
    }

    fn view(&self, drawn: &Drawn) -> Result<SheetView, OutlineError> {
        sheet::view(self, self, drawn)
    }
}

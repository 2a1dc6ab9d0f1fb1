//! The disc cam: one section for one speed, under any follower.

mod balance;
mod brake;
mod compensator;
mod dynamics;
mod forces;
mod jump;
mod loaded;
mod mechanism;
mod program;
mod raised;
mod size;
mod size_told;
mod vibration;
pub use compensator::{AtSpeed, Compensated};
pub(in crate::body) use mechanism::of_press;
pub use vibration::{Movement, Resonance, Vibration};
mod sheet;
pub use size::{Binding, Placed};
pub use size_told::{Best, SizeTold};

use super::balance::{AsCut, Balance};
use super::part::{Part, point_as_turned};
use super::{
    Body, DrawError, Drawn, Found, Kind, ROUNDING_OF_BALANCE, Request, WorstPlaces, broken_limit, no_radius, passing,
    plane, reversal_of_bed, stress,
};
use crate::document::cams;
use crate::follower::Follower;
use crate::geometry::contour::Contour;
use crate::geometry::{Entity, MILLIMETRES};
use crate::load::{AirBuffer, Load, RunUp};
use crate::machine::{DiscOfBrakeError, Machine, NoPress, Press, Rotation};
use crate::motion::counter_torque::CounterTorqueError;
use crate::motion::{BrakeDisc, Jet, Motion, MotionError, Quantity, Raised, Reversal, ReversalLaw, State, Transition};
use crate::profile::extremes;
use crate::profile::outline::{self, OutlineError};
use crate::profile::size::{NoRadius, Smallest};
use crate::profile::{Contact, Curves, Worst, lifts};
use crate::report::mechanism::Mechanism;
use crate::report::sheet::View;
use crate::report::{CamMeasures, Forces, Section, Speeds};
use crate::table::{BedRow, Row, Turned, turned};
use nalgebra::Vector2;
use std::sync::{Arc, OnceLock};

/// The disc cam of a press.
pub const ROTARY: Kind = Kind { command: "rotary", noun: "rotary cam", keys: cams::ROTARY };

/// The disc cam of any motion.
pub const GENERAL: Kind = Kind { command: "make", noun: "disc cam", keys: cams::MAKE };

/// The disc that takes the torque of the disc cam of a press.
pub const COMPENSATOR: Kind = Kind { command: "compensator", noun: "compensating cam", keys: cams::ROTARY };

/// The disc that holds the tension of a belt brake.
pub const BRAKE: Kind = Kind { command: "brake-cam", noun: "disc of a belt brake", keys: cams::BRAKE_CAM };

/// Largest base radius that is tried, m: what a drawing holds.
const LARGEST_BASE: f64 = outline::LARGEST_COORDINATE / MILLIMETRES;

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
    /// It is cut for a shaft that gives way.
    raised: bool,
    /// Its motion, where it holds the tension of a belt brake.
    brake: Option<Arc<BrakeDisc>>,
    /// What only the follower of a motion program has.
    own: forces::Own,
    /// The sizes that keep every limit; `None` when none does.
    smallest: Option<Smallest>,
    /// The prime radius of the smallest before it is rounded, m, once it is asked for.
    exact: OnceLock<f64>,
    /// What was chosen of the follower's place, where that is asked for.
    placed: Option<Placed>,
    worst: WorstPlaces,
}

/// Why there is no disc cam.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DiscError {
    /// The machine file describes no press.
    #[error(transparent)]
    NoPress(#[from] NoPress),
    /// The parts of the motion do not fit together.
    #[error("{0}; see transition.width, buffer.lead and cam.cam_turns_per_crank_turn")]
    Motion(#[from] MotionError),
    /// A corner of the pitch curve.
    #[error(
        "a lead without a transition has a corner where the bottom begins to retreat, and no outline guides a follower round it: give \
         transition.kind = \"run-up\", or buffer.lead = \"0 mm\""
    )]
    CornerOfLead,
    /// `auto` found no radius.
    #[error("{0}: relax limits.pressure_angle or limits.min_convex_pitch_radius_over_roller, or give cam.base_radius")]
    Size(#[from] NoRadius),
    /// Every place of the follower breaks the limit of the pressure angle.
    #[error(
        "{path}.{key} = \"auto\": no place of the follower keeps the pressure angle; relax limits.pressure_angle, or give a longer rise"
    )]
    NoPlace {
        /// The follower's table.
        path: &'static str,
        /// Its key.
        key: &'static str,
    },
    /// The place of the follower is to be chosen for a press.
    #[error("{path}.{key} = \"auto\" is chosen for the motion of `camgen make`: give a value")]
    PlaceOfPress {
        /// The follower's table.
        path: &'static str,
        /// Its key.
        key: &'static str,
    },
    /// The follower does not reach the cam.
    #[error(
        "the follower does not reach every lift on a cam of base radius {base_radius_mm} mm; give a smaller cam.base_radius, or another arm"
    )]
    OutOfReach {
        /// The base radius, mm.
        base_radius_mm: f64,
    },
    /// A face on an arm that swings as quickly as the cam turns.
    #[error(
        "the face on its arm turns back on the cam at {cam_deg:.3} deg, where it swings by more than the cam turns; give a smaller swing, \
         a longer rise, or the other follower.swinging-flat.side"
    )]
    FaceTurnsBack {
        /// Where, degrees of cam angle.
        cam_deg: f64,
    },
    /// The machine file describes no compensating cam.
    #[error(
        "the machine file describes no compensating cam: add the table [compensator] with spring_rate and preload, or give \
         --set compensator.spring_rate=100N/mm --set compensator.preload=10kN"
    )]
    NoCompensator,
    /// The shaft that it is to be cut for.
    #[error("the cam is to be cut for its shaft (shaft.compensate): {0}")]
    Shaft(String),
    /// The shaft gives way too much.
    #[error(
        "the cam cannot be cut for its shaft (shaft.compensate): what bending and twist take off the lift grows faster than it can be put \
         on; make the shaft thicker, or put the drive (shaft.drive_at) nearer to the cam"
    )]
    TooSoft,
    /// A cam that is cut for its shaft has no second one.
    #[error("a compensating cam is made for a rigid shaft: set shaft.compensate = false, or leave out [compensator]")]
    CompensatorOnShaft,
    /// A mass that is thrown, which no spring can give back.
    #[error(
        "the velocity of the follower jumps at {cam_deg:.3} deg: with its mass no compensating cam can take that blow; give \
         transition.kind = \"run-up\", or no follower mass"
    )]
    Blow {
        /// Where, degrees of cam angle.
        cam_deg: f64,
    },
    /// There is no disc that holds the tension of a brake.
    #[error(transparent)]
    Brake(#[from] DiscOfBrakeError),
    /// The law of the compensating cam has no solution.
    #[error("no compensating cam: {0}; see compensator.spring_rate and compensator.preload")]
    CounterTorque(#[from] CounterTorqueError),
    /// Lengths as lift for a follower that swings, or the other way round.
    #[error("the motion is {motion}, but the follower takes {follower}")]
    WrongQuantity {
        /// What the motion gives.
        motion: &'static str,
        /// What the follower takes.
        follower: &'static str,
    },
}

impl Disc {
    /// Solves the law of a press at a speed of its main shaft (rpm) and sizes the cam.
    ///
    /// # Errors
    /// [`DiscError`] when the motion cannot be put together or no radius keeps the limits.
    pub fn solve(machine: &Machine, rpm: f64) -> Result<Self, DiscError> {
        Self::of_reversal(machine, rpm, None)?.sized()?.cut_for_its_shaft(machine, rpm)
    }

    /// The disc of a press, its size not yet found, with a cam that may be cut higher than its law.
    fn of_reversal(machine: &Machine, rpm: f64, raised: Option<Arc<Raised>>) -> Result<Self, DiscError> {
        let press = machine.press()?;
        if let Some(place) = machine.follower.place {
            return Err(DiscError::PlaceOfPress { path: machine.follower.path, key: place.key() });
        }
        let is_raised = raised.is_some();
        if press.lead > 0.0 && machine.transition == Transition::None {
            return Err(DiscError::CornerOfLead);
        }
        let law = ReversalLaw {
            bottom_law: press.bottom_law(rpm),
            lever: machine.cam.lever,
            lobes: machine.cam.lobes,
            transition: machine.transition,
        };
        let reversal = Arc::new(Reversal::raised_by(law, raised)?);
        let load: Arc<dyn Load> = Arc::new(AirBuffer::new(press.cylinder(), Arc::clone(&reversal)));
        let disc = Self {
            kind: &ROTARY,
            rpm: Some(rpm),
            speed: Some(Self::speed_of(press, machine, rpm)),
            load: Some(load),
            raised: is_raised,
            ..Self::unsized_of(machine, reversal)
        };
        Ok(disc)
    }

    /// The cam of any motion under the machine's follower, sized; `rpm` is the speed of the cam itself, where it is known.
    ///
    /// # Errors
    /// [`DiscError`] when motion and follower do not fit each other or no radius keeps the limits.
    pub fn of_motion(machine: &Machine, motion: Arc<dyn Motion>, rpm: Option<f64>) -> Result<Self, DiscError> {
        let speed = rpm.map(|rpm| rpm * std::f64::consts::TAU / 60.0);
        let own = forces::Own::of(machine, &*motion);
        Self { rpm, speed, own, ..Self::unsized_of(machine, motion) }.sized()
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
            raised: false,
            brake: None,
            own: forces::Own::default(),
            smallest: None,
            exact: OnceLock::new(),
            placed: None,
            worst: WorstPlaces::default(),
        }
    }

    /// Angular speed of the cam of a press, rad/s.
    fn speed_of(press: &Press, machine: &Machine, rpm: f64) -> f64 {
        press.bed.crank_speed(rpm) / f64::from(machine.cam.lobes)
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
        self.smallest.map(|smallest| smallest.base_radius)
    }

    /// Smallest prime radius that keeps every limit, m; `None` when none does.
    #[must_use]
    pub fn smallest_prime_radius(&self) -> Option<f64> {
        self.smallest.map(|smallest| *self.exact.get_or_init(|| self.before_rounding(smallest).prime_radius))
    }

    /// Largest lift, m or rad.
    #[must_use]
    pub fn max_lift(&self) -> f64 {
        lifts(&*self.motion).1
    }

    /// Largest residual force of the motion itself, N, and where: rounding, or the cost of a blend; 0 without a load.
    #[must_use]
    pub fn residual_max(&self) -> Worst {
        let Some(load) = &self.load else { return Worst { value: 0.0, ..Worst::NONE } };
        let limits = (load.acting(), ROUNDING_OF_BALANCE * load.largest());
        let left = |piece: usize, angle: f64| load.residual(piece, angle, 0.0);
        plane(extremes::largest_size(self.curves(), (&limits.0, limits.1), left))
    }

    fn forces(&self, residual_max_n: f64) -> Option<Forces> {
        let load = self.load.as_ref()?;
        let force = |piece: usize, angle: f64| self.path_force(piece, angle).unwrap_or(f64::NAN);
        Some(Forces {
            inertia_max_n: load.largest(),
            residual_max_n,
            residual_share: residual_max_n / load.largest(),
            residual_fixed_bottom_max_n: load.left_without_cam(),
            by_way: None,
            roller_force_max_n: self.largest_force(force).value,
            torque_max_nm: self.torque_max().map(|torque| torque.value),
        })
    }

    fn row(&self, at: Turned) -> Row {
        let curves = self.curves();
        let (piece, angle) = curves.motion.locate(at.angle);
        let (state, lift) = match &self.load {
            Some(load) => {
                let (state, lift) = load.state_and_lift(piece, angle);
                (Some(state), lift)
            }
            None => (None, curves.motion.jet(piece, angle)),
        };
        let contact = Contact::of(curves.follower, angle, lift);
        let profile = contact.curve.offset_inward(curves.offset());
        let bed = state.map(|state| BedRow {
            crank_deg: Some(at.crank_deg),
            x: MILLIMETRES * state.overrun,
            dx: MILLIMETRES * state.displacement,
        });
        Row {
            cam_deg: Some(at.cam_deg),
            at: Some((piece, angle)),
            lift: (self.motion.quantity() == Quantity::Length).then_some(contact.lift),
            swing: (self.motion.quantity() == Quantity::Angle).then_some(contact.lift),
            position: self.motion.origin().map(|origin| origin + contact.lift.s),
            bed,
            curve: Some(point_as_turned(&self.machine, contact.curve.point * MILLIMETRES)),
            profile: Some(point_as_turned(&self.machine, profile.point * MILLIMETRES)),
            pressure_angle_deg: Some(contact.pressure_angle.to_degrees()),
            curve_radius: Some(MILLIMETRES / contact.curve.curvature),
            profile_radius: Some(MILLIMETRES / profile.curvature),
            force: self.force_row((piece, angle), &contact, state.as_ref()),
            balance: self.load.as_ref().zip(state).map(|(load, state)| load.balance_row(&state)),
            state,
            face: curves.follower.on_face(&contact.lift).map(|face| MILLIMETRES * face.place),
            ..Row::default()
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

    fn plane(&self) -> Option<Curves<'_>> {
        Some(self.curves())
    }

    fn holes_within(&self, outline: &Contour) -> Vec<Entity> {
        Part::holes_within(&self.machine, outline)
    }

    fn shaft_speed(&self) -> Option<f64> {
        self.speed
    }

    fn parameter_at(&self, point: Vector2<f64>) -> f64 {
        let angle = libm::atan2(point.y, point.x);
        match self.machine.cam.rotation {
            Rotation::Clockwise => angle,
            Rotation::CounterClockwise => -angle,
        }
    }

    fn mirrored(&self) -> &'static [bool] {
        match self.machine.cam.rotation {
            Rotation::Clockwise => &[false],
            Rotation::CounterClockwise => &[true],
        }
    }

    fn worst_places(&self) -> Option<&WorstPlaces> {
        Some(&self.worst)
    }

    fn least_rolled_radius(&self) -> Worst {
        self.worst.least_rolled_radius(self.curves())
    }

    fn wall(&self) -> Option<(f64, Option<Worst>)> {
        self.machine.cam.bore_reach().map(|bore| (self.base_radius() - bore, None))
    }

    fn contact_force(&self, at: (usize, f64), contact: &Contact) -> Option<f64> {
        self.normal_force_of(at, contact)
    }

    fn force_and_torque_of(&self, at: (usize, f64), lift: Jet) -> Option<[f64; 2]> {
        self.driving_force_and_torque(at, lift)
    }

    fn compensating(&self) -> Option<Result<(Disc, Compensated), DiscError>> {
        self.machine.compensator().filter(|_| *self.kind == ROTARY)?;
        let both = |second: Disc| self.compensated_by(&second).map(|told| (second, told));
        Some(self.compensating_disc().and_then(both))
    }

    fn brake_disc(&self) -> Option<&BrakeDisc> {
        self.brake.as_deref()
    }

    fn contact_stress(&self) -> Option<Worst> {
        let curves = (self.curves(), &*self.acting());
        match self.crown_radius() {
            Some(crown) => stress::of_crown(self, curves, &self.machine, crown),
            None => stress::of_lines(self, curves, &self.machine),
        }
    }

    fn crown_radius(&self) -> Option<f64> {
        self.own.crown_radius
    }

    fn least_closing_force(&self) -> Option<Worst> {
        self.closing_force()
    }

    fn preload_that_holds(&self, speed: f64) -> Option<String> {
        self.holding(speed)
    }

    fn jump_speed(&self) -> Option<Result<Worst, String>> {
        self.jump()
    }

    fn guide_share(&self) -> Option<Worst> {
        self.least_guide_share()
    }

    fn vibration(&self) -> Option<&Vibration> {
        self.vibrating()
    }

    fn largest_lifting_force(&self) -> Worst {
        self.largest_force(|piece, angle| self.path_force(piece, angle).map_or(f64::NAN, |force| -force))
    }

    fn unbalanced(&self, piece: usize, angle: f64, moved: f64, _: Vector2<f64>) -> f64 {
        self.load.as_ref().map_or(0.0, |load| load.residual(piece, angle, moved).abs())
    }

    fn unbalanced_in(&self, state: &State, moved: f64) -> f64 {
        self.load.as_ref().map_or(0.0, |load| load.residual_in(state, moved).abs())
    }

    fn force_jumps(&self) -> Vec<f64> {
        self.load.iter().flat_map(|load| load.acting()).flat_map(|(from, to)| [from, to]).collect()
    }

    fn balance(&self) -> Option<Balance> {
        let load = self.load.as_ref()?;
        Some(Balance { inertia: load.largest(), without_cam: load.left_without_cam(), mean: false })
    }

    fn residual_of_motion(&self) -> Worst {
        self.residual_max()
    }

    fn as_cut(&self, tolerance: f64) -> Option<AsCut> {
        self.fitting(tolerance)
    }

    fn least_air(&self) -> Option<Worst> {
        self.air()
    }

    fn run_up(&self) -> Option<RunUp> {
        self.ramp()
    }

    fn stress_remedies(&self, largest: f64, limit: f64) -> Vec<String> {
        self.keeping_stress(largest, limit)
    }

    fn remedy(&self) -> Option<String> {
        let Some(base) = self.passing_base_radius() else {
            let largest = (self.follower.prime_radii().1 - self.curves().offset()).min(LARGEST_BASE);
            let of_size = || self.on(largest).and_then(|disc| broken_limit(&disc));
            return Some(no_radius(if self.has_corner() { Some("undercut") } else { of_size() }));
        };
        // A cam that no drawing holds is no remedy.
        (MILLIMETRES * base < outline::LARGEST_COORDINATE).then(|| passing(base))
    }

    fn draw(&self, request: &Request) -> Result<Drawn, DrawError> {
        let curves = self.curves();
        let outline = outline::profile(curves, request.fit).map_err(|error| match error {
            OutlineError::Undercut(_) => DrawError::NoOutline(error.to_string()),
            // Cusps of an undercut profile can lie too near each other to be told apart.
            OutlineError::Fit(_) | OutlineError::Part { .. } if self.least_radius().value <= curves.offset() => {
                DrawError::NoOutline(error.to_string())
            }
            other => DrawError::Outline(other),
        })?;
        let part = Part::turning(&self.machine, outline).balanced(&self.machine);
        let cutter_path = |radius: f64| {
            let path = outline::cutter_path(curves, radius, request.fit)?;
            Ok::<_, OutlineError>(Part::turning(&self.machine, path).outline)
        };
        Ok(Drawn { parts: vec![part], flank: None, cutter_path: request.cutter.map(cutter_path) })
    }

    /// At 360 i/samples degrees; at a break of the motion the row belongs to the later piece.
    fn rows(&self, samples: u32) -> Vec<Row> {
        (0..samples).map(|i| self.row(turned(i, samples, self.motion.lobes()))).collect()
    }

    fn sections(&self, found: &Found<'_>) -> Vec<Section> {
        let part = found.drawn.and_then(|drawn| drawn.parts.first());
        let on_face = extremes::places_on_face(self.curves()).map(|places| places.map(|at| MILLIMETRES * at.value));
        let lift = |quantity, unit: f64| (self.motion.quantity() == quantity).then(|| unit * self.max_lift());
        let spin = if *self.kind == GENERAL { self.spin() } else { None };
        let cam = CamMeasures {
            prime_radius_mm: Some(MILLIMETRES * self.prime_radius()),
            base_radius_mm: Some(MILLIMETRES * self.base_radius()),
            roller_radius_mm: self.roller_radius().map(|radius| MILLIMETRES * radius),
            max_lift_mm: lift(Quantity::Length, MILLIMETRES),
            max_lift_deg: lift(Quantity::Angle, 1.0_f64.to_degrees()),
            smallest_prime_radius_mm: self.smallest_prime_radius().map(|radius| MILLIMETRES * radius),
            face_mm: on_face,
            roller_turns: spin.map(|spin| [spin.mean, spin.largest.value]),
            lobes: self.load.as_ref().map(|_| self.motion.lobes()),
            plate: None,
            weight: part.map(|part| part.weight(&self.machine)).unwrap_or_default(),
        };
        let outline = part.map(|part| part.measures(found.tolerance_mm, |_| false));
        let residual = found.rolled.map_or_else(|| self.residual_max().value, |rolled| rolled.residual_max_n);
        let mut sections = vec![cam.section()];
        sections.extend(self.mounting());
        sections.extend(self.on_its_frame());
        sections.extend(self.size_told());
        sections.extend(self.program());
        if let Some(load) = &self.load {
            sections.push(load.section());
            sections.extend(reversal_of_bed(&self.machine));
            sections.extend(self.cut_higher());
        }
        sections.push(outline.map_or_else(|| Section::new("outline", &()), |outline| outline.section()));
        sections.push(Section::new("rolling", &found.rolled));
        sections.extend(self.forces(residual).map(|forces| forces.section()));
        sections.extend(self.dynamics());
        sections.extend(self.vibration_told());
        sections
    }

    fn mechanism(&self, drawn: &Drawn, samples: u32) -> Mechanism {
        mechanism::of(self, drawn, samples)
    }

    fn not_modelled(&self) -> Vec<&'static str> {
        mechanism::not_modelled(self)
    }

    fn view(&self, drawn: &Drawn) -> Result<View, OutlineError> {
        sheet::view(self, drawn)
    }
}

#[cfg(test)]
mod tests;

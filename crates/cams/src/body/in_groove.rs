//! Forces on the rollers in the groove of a barrel or the grooves of a globoid.
//!
//! What goes with the lift is the force F = m s'' ω² + c s' ω + k s + F0, of an arm or a turret the moment with its inertia; the shaft turns against F s'. One
//! roller carries all of it in the middle of its reach, along the normal: N = F/(l cos α) with its way l for a lift, and on the flank that the sign of F
//! names. The pressure is that of N spread evenly over the reach b, p² = N E* κ/(π b), with the largest reduced curvature κ along it. On that flank the
//! roller turns n = ±|V|/r − the turn of what carries it, for a turn of the cam. Friction is left out.

use super::Body;
use super::flank_switch::{self, FlankSwitch, ForceOverTurn, SwitchFigures, SwitchingRoller};
use super::flight::Flight;
use super::roller_bearing::{self, RollerBearing, RollerDuty, RollingOverTurn};
use super::shaft_torque::{DynamicsFigures, ShaftTorque, TorqueOverTurn};
use super::stress::RollerContact;
use crate::check::contact_stress::{self, ContactKind};
use crate::check::{Measures, Subject};
use crate::load::Pressing;
use crate::report::Section;
use crate::table::ForceRow;
use camgen_kernel::motion::{Jet, Motion};
use camgen_kernel::numeric::extremum::{self, Extremum};
use camgen_kernel::numeric::root;
use camgen_kernel::profile::Worst;

/// Cells of a piece in which forces are searched, the hills that are climbed, and golden sections to a place.
const CELLS: u32 = 48;
const HILLS: usize = 3;
const SECTIONS: u32 = 38;
/// Halvings to the angle at which another roller carries the force.
const HALVINGS: u32 = 48;
/// A force below this share of the largest presses nothing on: where it changes flank the roller crosses the play, and no friction turns it.
const PRESSED: f64 = 0.01;

/// A roller in touch with its groove at a cam angle, in the middle of its reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GrooveContact {
    /// Which of the rollers it is.
    pub(crate) roller: i32,
    /// Length of the line of contact along its axis, m.
    pub(crate) length: f64,
    /// Pressure angle, rad.
    pub(crate) pressure_angle: f64,
    /// Way along its path for a lift, 1 or m/rad.
    pub(crate) leverage: f64,
    /// Largest reduced curvature along the reach, 1/m, on the flank that lifts the follower and on the other.
    pub(crate) curvatures: [f64; 2],
    /// |V|/r and its derivative by the cam angle.
    pub(crate) by_path: [f64; 2],
    /// Turn of what carries the roller, about the roller's axis and for a turn of the cam, with its derivative.
    pub(crate) carrier_turn: [f64; 2],
}

/// A body in whose grooves rollers run, held from both sides.
pub(crate) trait InGroove: Body {
    /// The motion.
    fn motion(&self) -> &dyn Motion;

    /// The speed of the cam, rpm.
    fn rpm(&self) -> Option<f64>;

    /// Radius of a roller, m.
    fn roller(&self) -> f64;

    /// The rollers in touch at a cam angle of a piece, with the flank that lifts the follower or with the other.
    fn contacts(&self, at: (usize, f64), lifting: bool) -> Vec<GrooveContact>;

    /// Share of one roller in the turns of all.
    fn share_of_turns(&self) -> f64 {
        1.0
    }
}

/// The forces on a body's rollers: of a mass at a speed, a preload or a spring.
pub(crate) struct GrooveForces<'a> {
    body: &'a dyn InGroove,
    pressing: Pressing,
}

impl<'a> GrooveForces<'a> {
    /// `None` without a mass and a speed, a preload or a spring: no force is known then.
    pub(crate) fn of(body: &'a dyn InGroove) -> Option<Self> {
        let machine = body.machine();
        let (follower, spring) = (&machine.follower, machine.spring());
        let moves = follower.mass.is_some() && body.shaft_speed().is_some();
        if !moves && follower.preload.is_none() && spring.is_none() {
            return None;
        }
        let spring = spring.unwrap_or_default();
        let pressing = Pressing {
            mass: follower.mass.unwrap_or(0.0),
            damping: spring.damping,
            rate: follower.spring_rate + spring.rate,
            constant: follower.preload.unwrap_or(0.0) + spring.preload + spring.load,
            speed: body.shaft_speed().unwrap_or(0.0),
        };
        Some(Self { body, pressing })
    }

    fn lift(&self, (piece, angle): (usize, f64)) -> Jet {
        self.body.motion().jet(piece, angle)
    }

    /// The force that goes with the lift, N or N·m.
    fn acting(&self, at: (usize, f64)) -> f64 {
        self.pressing.force_at(&self.lift(at))
    }

    /// The rollers that may bear it, each with its force along the normal, N.
    fn bearing(&self, at: (usize, f64)) -> impl Iterator<Item = (GrooveContact, f64)> + use<> {
        let acting = self.acting(at);
        let contacts = self.body.contacts(at, acting >= 0.0);
        contacts
            .into_iter()
            .map(move |contact| (contact, acting.abs() / (contact.leverage * libm::cos(contact.pressure_angle))))
    }

    /// Largest force along the normal of a roller, N.
    fn normal(&self, at: (usize, f64)) -> f64 {
        self.bearing(at).map(|(_, force)| force).fold(0.0, f64::max)
    }

    fn torque(&self, at: (usize, f64)) -> f64 {
        let lift = self.lift(at);
        // Where the follower rests there is no work.
        if lift.ds == 0.0 { 0.0 } else { self.pressing.force_at(&lift) * lift.ds }
    }

    /// Turns of a roller for a turn of the cam.
    fn turns(&self, at: (usize, f64), contact: &GrooveContact) -> f64 {
        self.side(at) * contact.by_path[0] - contact.carrier_turn[0]
    }

    fn side(&self, at: (usize, f64)) -> f64 {
        if self.acting(at) >= 0.0 { 1.0 } else { -1.0 }
    }

    /// The largest of a value over the turn.
    fn largest(&self, value: impl Fn((usize, f64)) -> f64) -> Worst {
        let of = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
            extremum::largest_of_hills(|angle| value((index, angle)), (piece.start, piece.end), CELLS, HILLS, SECTIONS)
        };
        let pieces = self.body.motion().pieces().iter().enumerate();
        let found = pieces.map(of).reduce(|a, b| if b.value > a.value { b } else { a });
        found.map_or(Worst::NONE, |Extremum { value, at, .. }| Worst { value, at, z: 0.0 })
    }

    /// The row of a table.
    pub(crate) fn row(&self, at: (usize, f64)) -> ForceRow {
        let (contact, acting) = (self.bearing(at).next(), self.acting(at));
        let leverage = contact.map_or(f64::NAN, |(contact, _)| contact.leverage);
        ForceRow { path: acting / leverage, torque: self.torque(at), contact: Some(self.normal(at)) }
    }

    /// What the shaft does over a turn.
    pub(crate) fn shaft_torque(&self) -> Option<ShaftTorque> {
        let torque = |piece: usize, angle: f64| self.torque((piece, angle));
        let extremes = [self.largest(|at| self.torque(at)), self.largest(|at| -self.torque(at))];
        // A turret does not come back: a constant moment against it takes work.
        let returns = self.body.machine().cam.track.turret.is_none();
        let gives_back = self.pressing.damping == 0.0 && returns;
        let stretches = self.body.smooth_stretches();
        TorqueOverTurn { torque: &torque, stretches: &stretches, has_kinks: false, gives_back }.shaft(extremes)
    }

    /// The section `dynamics`.
    fn dynamics(&self) -> Option<Section> {
        let least = self.largest(|at| -self.normal(at));
        let torque = self.shaft_torque()?;
        let figures = DynamicsFigures {
            machine: self.body.machine(),
            speed: self.body.shaft_speed(),
            largest_torque: torque.largest,
            torque: Some(torque),
            force: Some([self.largest(|at| self.normal(at)), Worst { value: -least.value, ..least }]),
            jump: None,
            is_closed: true,
        };
        Some(figures.section())
    }

    /// Largest pressure between roller and flank, Pa, and where; `None` where the material is not given.
    pub(crate) fn contact_stress(&self) -> Option<Worst> {
        let machine = self.body.machine();
        let (material, crown) = (machine.cam.material?.class, machine.follower.crown_radius);
        let pressure = |at: (usize, f64)| {
            let lifting = self.acting(at) >= 0.0;
            let of = |(contact, force): (GrooveContact, f64)| {
                let curvature = contact.curvatures[usize::from(!lifting)];
                let contact = RollerContact { curvature, crown, length: Some(contact.length) };
                contact.pressure(force, material).unwrap_or(0.0)
            };
            self.bearing(at).map(of).fold(0.0, f64::max)
        };
        Some(self.largest(pressure))
    }

    /// The stretches of a turn on which load and turns of the rollers are smooth.
    fn smooth_loads(&self) -> Vec<(usize, (f64, f64))> {
        let mut found = Vec::new();
        for (piece, (from, to)) in self.body.smooth_stretches() {
            let force = |angle: f64| self.acting((piece, angle));
            let mut cuts = root::sign_changes(force, (from, to), CELLS);
            cuts.extend(self.changes_of_rollers(piece, (from, to)));
            cuts.retain(|at| from < *at && *at < to);
            cuts.extend([from, to]);
            cuts.sort_by(f64::total_cmp);
            found.extend(cuts.iter().copied().zip(cuts.iter().copied().skip(1)).map(|part| (piece, part)));
        }
        found
    }

    /// Where other rollers come into touch, or leave.
    fn changes_of_rollers(&self, piece: usize, (from, to): (f64, f64)) -> Vec<f64> {
        let rollers = |angle: f64| -> Vec<i32> {
            let lifting = self.acting((piece, angle)) >= 0.0;
            self.body.contacts((piece, angle), lifting).into_iter().map(|contact| contact.roller).collect()
        };
        let place = |cell: u32| from + (to - from) * f64::from(cell) / f64::from(CELLS);
        let change = |cell: u32| {
            let (mut low, mut high) = (place(cell), place(cell + 1));
            let before = rollers(low);
            if rollers(high) == before {
                return None;
            }
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                if rollers(middle) == before { low = middle } else { high = middle }
            }
            Some(high)
        };
        (0..CELLS).filter_map(change).collect()
    }

    /// What the bearing of a roller goes through; `None` where none is given.
    pub(crate) fn roller_duty(&self) -> Option<RollerDuty> {
        let passing = |piece: usize, angle: f64| {
            let at = (piece, angle);
            self.bearing(at).map(|(contact, force)| (force, self.turns(at, &contact))).collect()
        };
        let turns = |at| self.bearing(at).map(|(contact, _)| self.turns(at, &contact).abs()).fold(0.0, f64::max);
        let rolling = RollingOverTurn {
            bearing: self.body.machine().bearing()?,
            rpm: self.body.rpm(),
            stretches: &self.smooth_loads(),
            passing: &passing,
            largest_load: self.largest(|at| self.normal(at)).value,
            fastest: self.largest(turns),
            share: self.body.share_of_turns(),
        };
        Some(rolling.duty())
    }

    /// The largest share of the friction that a roller needs to follow its groove, and where.
    fn roller_slip(&self) -> Option<Worst> {
        let (bearing, speed) = (self.body.machine().bearing()?, self.body.shaft_speed()?);
        let (inertia, radius) = (bearing.inertia?, self.body.roller());
        let pressed = PRESSED * self.largest(|at| self.normal(at)).value;
        let share = |at: (usize, f64)| {
            let of = |(contact, force): (GrooveContact, f64)| {
                let slope = (self.side(at) * contact.by_path[1] - contact.carrier_turn[1]).abs();
                let needed = inertia * speed * speed * slope / (bearing.friction * force * radius);
                if force <= pressed { 0.0 } else { needed }
            };
            self.bearing(at).map(of).fold(0.0, f64::max)
        };
        Some(self.largest(share))
    }

    /// The changes of flank in the order of the cam angle.
    pub(crate) fn flank_switches(&self) -> Option<Vec<FlankSwitch>> {
        let force = |piece: usize, angle: f64| self.acting((piece, angle));
        let largest = self.largest(|at| self.acting(at).abs()).value;
        let stretches = self.body.smooth_stretches();
        let changes = ForceOverTurn { force: &force, largest, stretches: &stretches }.changes()?;
        Some(changes.into_iter().filter_map(|(at, to_lifting)| self.switch(at, to_lifting)).collect())
    }

    fn switch(&self, (piece, start): (usize, f64), to_lifting: bool) -> Option<FlankSwitch> {
        let contact = self.body.contacts((piece, start), to_lifting).into_iter().next()?;
        let clearance = self.body.machine().cam.track.clearance;
        let lift = |angle: f64| self.lift(self.body.motion().locate(angle));
        let play = |angle: f64| {
            let found = self.body.contacts(self.body.motion().locate(angle), to_lifting).into_iter().next();
            let contact = found.unwrap_or(contact);
            clearance / (libm::cos(contact.pressure_angle) * contact.leverage)
        };
        let GrooveContact { by_path: [by_path, _], carrier_turn: [carrier_turn, _], leverage, .. } = contact;
        let flight = Some(Flight { pressing: self.pressing, lift: &lift, play: &play });
        Some(SwitchingRoller { by_path, carrier_turn, leverage, flight }.switch(start, to_lifting))
    }
}

/// Takes what a body has of its bearing, where the file gives one.
fn with_bearing<T>(body: &dyn InGroove, take: impl FnOnce(&RollerBearing<'_>) -> T) -> Option<T> {
    let forces = GrooveForces::of(body);
    let duty = || forces.as_ref()?.roller_duty();
    let slip = || forces.as_ref()?.roller_slip();
    let machine = body.machine();
    let bearing = machine.bearing()?;
    Some(take(&RollerBearing { machine, bearing, rpm: body.rpm(), duty: &duty, slip: &slip }))
}

/// The changes of flank for the report; none where no force is known.
pub(crate) fn switches(body: &dyn InGroove) -> Vec<SwitchFigures> {
    let found = GrooveForces::of(body).and_then(|forces| forces.flank_switches()).unwrap_or_default();
    found.iter().map(|found| SwitchFigures::of(found, ["lower", "upper"])).collect()
}

/// The measures of forces.
pub(crate) fn measured(body: &dyn InGroove, of: &mut Measures<'_>, subject: &Subject<'_>) {
    let forces = GrooveForces::of(body);
    of.add(&contact_stress::CHECK, |_| {
        let Some(forces) = &forces else { return contact_stress::CHECK.unknown("no force on the follower is known") };
        let contact = match body.machine().follower.crown_radius {
            Some(_) => ContactKind::Crown,
            None => ContactKind::Line,
        };
        contact_stress::measure(forces.contact_stress(), contact, |_, _| Vec::new(), subject)
    });
    of.add(&flank_switch::CHECK, |_| {
        flank_switch::measure(forces.as_ref().and_then(GrooveForces::flank_switches), subject)
    });
    with_bearing(body, |bearing| bearing.measured(of, subject));
}

/// The sections of the report on forces.
pub(crate) fn sections(body: &dyn InGroove) -> Vec<Section> {
    let forces = GrooveForces::of(body);
    let dynamics = forces.as_ref().and_then(GrooveForces::dynamics);
    dynamics.into_iter().chain(with_bearing(body, roller_bearing::section).flatten()).collect()
}

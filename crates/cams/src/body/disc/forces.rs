//! Forces between a disc and its follower.
//!
//! What presses the follower on is a force along a straight path, or a moment about the pivot of a follower that swings: the quantity whose
//! work goes with the lift. Over [`Follower::leverage`](camgen_kernel::follower::Follower::leverage) it is the force along the drive of what
//! touches the cam, over the cosine of the pressure angle that along the normal.

use super::{Disc, Hold};
use crate::body::plane;
use crate::load::{Pressing, guide};
use crate::machine::{GuideData, Machine, SpringData};
use crate::table::{ForceRow, LoadState};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Jet, Motion, Piece, Quantity};
use camgen_kernel::numeric::digits::three_digits_up;
use camgen_kernel::numeric::root;
use camgen_kernel::profile::extremes::{self, JumpRange};
use camgen_kernel::profile::{Contact, Worst};
use camgen_kernel::text::KeyChange;
use std::sync::{Arc, OnceLock};

/// Spring, guide, crown and vibration, which only the follower of a motion program has.
#[derive(Debug, Clone, Default)]
pub(super) struct ProgramFollower {
    pub(super) spring: Option<SpringData>,
    pub(super) guide: Option<GuideData>,
    pub(super) crown_radius: Option<f64>,
    /// Where the follower is lowered, under the friction of a guide.
    lowered: Arc<[JumpRange]>,
    pub(super) vibration: Arc<OnceLock<Option<super::Vibration>>>,
    /// The speed at which it first leaves the cam: of mass, spring and motion alone, not of the size of the cam.
    pub(super) jump: Arc<OnceLock<Worst>>,
}

/// Share of the force along the normal that acts along the path without friction.
const ALL: f64 = 1.0;

/// Cells of a piece in which its velocity may change sign once each.
const CELLS: u32 = 64;

/// The ranges in which a motion goes down.
fn lowered(motion: &dyn Motion) -> Vec<JumpRange> {
    let mut ranges: Vec<JumpRange> = Vec::new();
    for (index, piece) in motion.pieces().iter().enumerate().filter(|(_, piece)| !piece.dwell) {
        for (from, to) in between_turns(motion, index, piece) {
            if motion.jet(index, 0.5 * (from + to)).ds < 0.0 {
                match ranges.last_mut() {
                    Some(last) if last.1 >= from => last.1 = to,
                    _ => ranges.push((from, to)),
                }
            }
        }
    }
    ranges
}

/// A piece, cut where its velocity changes sign.
fn between_turns(motion: &dyn Motion, index: usize, piece: &Piece) -> Vec<JumpRange> {
    let velocity = |at: f64| motion.jet(index, at).ds;
    let place = |cell: u32| piece.start + (piece.end - piece.start) * f64::from(cell) / f64::from(CELLS);
    // At its ends it may rest.
    let inside = root::sign_changes(velocity, (place(1), place(CELLS - 1)), CELLS - 2);
    let cuts: Vec<f64> = std::iter::once(piece.start).chain(inside).chain([piece.end]).collect();
    cuts.iter().copied().zip(cuts.iter().copied().skip(1)).collect()
}

/// The force of spring, damping and inertia, and of a load; the lift matters where it is not constant.
fn with_load(pressing: &Pressing, load: f64, lift: impl FnOnce() -> Jet) -> f64 {
    load + if pressing.is_constant() { pressing.constant } else { pressing.force_at(&lift()) }
}

/// Torque of the shaft against a force at a velocity: where the follower rests there is no work, jammed or not.
fn work(force: f64, velocity: f64) -> f64 {
    if velocity == 0.0 { 0.0 } else { force * velocity }
}

impl ProgramFollower {
    pub(super) fn of(machine: &Machine, motion: &dyn Motion) -> Self {
        let (spring, guide) = (machine.spring(), machine.guide());
        let lowered = guide.map_or_else(Vec::new, |_| lowered(motion)).into();
        Self { spring, guide, crown_radius: machine.follower.crown_radius, lowered, ..Self::default() }
    }
}

impl Disc {
    /// The forces on the follower in addition to the load; `None` where no force is known. A roller inside of its cam is pressed on outwards: what
    /// moves, and a spring, act against the lift there.
    pub(in crate::body) fn pressing(&self) -> Option<Pressing> {
        let follower = &self.machine.follower;
        let by_inertia = self.is_of_program() && follower.mass.is_some() && self.speed.is_some();
        if self.load.is_none() && follower.preload.is_none() && self.program_follower.spring.is_none() && !by_inertia {
            return None;
        }
        let (spring, side) = (self.program_follower.spring.unwrap_or_default(), self.curves().metal_side());
        Some(Pressing {
            mass: side * follower.mass.unwrap_or(0.0),
            damping: side * spring.damping,
            rate: side * (follower.spring_rate + spring.rate),
            constant: self.constant(follower.preload.unwrap_or(0.0) + spring.preload + spring.load, spring.rate),
            speed: self.speed.unwrap_or(0.0),
        })
    }

    /// The constant part of the forces, which the counter disc of a pair has to bear the other way: −(F0 + k (h − s)).
    fn constant(&self, constant: f64, rate: f64) -> f64 {
        match self.hold {
            Hold::Pair { counter: Some(top), .. } => -(constant + (self.machine.follower.spring_rate + rate) * top),
            _ => constant,
        }
    }

    /// The force that presses the follower on: the load and, where they are given, spring, preload, damping and the inertia of what moves with
    /// the follower: along a straight path, N; about the pivot of one that swings, N·m. `None` where no force is known.
    #[must_use]
    pub fn acting_force(&self, piece: usize, angle: f64) -> Option<f64> {
        self.acting_force_of((piece, angle), || self.motion.jet(piece, angle))
    }

    /// [`Self::acting_force`] where the lift may be known.
    fn acting_force_of(&self, (piece, angle): (usize, f64), lift: impl FnOnce() -> Jet) -> Option<f64> {
        let pressing = self.pressing()?;
        Some(with_load(&pressing, self.load.as_ref().map_or(0.0, |load| load.pressing(piece, angle)), lift))
    }

    /// [`Self::acting_force`] as a force along the path of the contact, N.
    #[must_use]
    pub fn path_force(&self, piece: usize, angle: f64) -> Option<f64> {
        let acting = self.acting_force(piece, angle)?;
        Some(match self.motion.quantity() {
            Quantity::Length => acting,
            Quantity::Angle => acting / self.follower.leverage(&self.motion.jet(piece, angle)),
        })
    }

    /// The force with which the cam drives the follower: [`Self::acting_force`] with the friction of its guide.
    #[must_use]
    pub fn driving_force(&self, piece: usize, angle: f64) -> Option<f64> {
        self.driving_force_of((piece, angle), || self.motion.jet(piece, angle))
    }

    /// [`Self::driving_force`] where the lift may be known.
    fn driving_force_of(&self, (piece, angle): (usize, f64), lift: impl FnOnce() -> Jet) -> Option<f64> {
        Some(self.driving(self.acting_force_of((piece, angle), lift)?, (piece, angle)))
    }

    /// The force with which the cam drives the follower where this force acts on it.
    fn driving(&self, acting: f64, (piece, angle): (usize, f64)) -> f64 {
        let Some(guide) = self.program_follower.guide.filter(|_| self.touches(acting)) else { return acting };
        let contact = self.curves().contact(piece, angle);
        let share = self.share_borne(&guide, (piece, angle), &contact, acting);
        acting * libm::cos(contact.pressure_angle) / share.max(0.0)
    }

    /// Whether the follower is on the cam under a force.
    fn touches(&self, acting: f64) -> bool {
        acting > 0.0 || self.is_closed()
    }

    /// Torque of the shaft against a driving force at a velocity, N·m: a roller inside of its cam is driven inwards.
    fn work(&self, force: f64, velocity: f64) -> f64 {
        work(self.curves().metal_side() * force, velocity)
    }

    /// Force of the cam on the follower and torque of the shaft, for the load as cut.
    pub(super) fn driving_force_and_torque(&self, at: (usize, f64), lift: Jet) -> Option<[f64; 2]> {
        let driving = self.driving_force_of(at, || lift)?;
        Some([self.curves().metal_side() * driving, self.work(driving, lift.ds)])
    }

    /// Force along the normal, N, with the friction of the guide, on whichever flank it acts; infinite where it jams, 0 where the follower has left
    /// the cam.
    #[must_use]
    pub fn normal_force(&self, piece: usize, angle: f64) -> Option<f64> {
        self.normal_force_of((piece, angle), &self.curves().contact(piece, angle))
    }

    /// [`Self::normal_force`] where the contact is known.
    pub(super) fn normal_force_of(&self, at: (usize, f64), contact: &Contact) -> Option<f64> {
        Some(self.borne(self.signed_normal_force(at, contact)?))
    }

    /// Force along the normal of this contact, N, negative where it lifts the follower from its flank. The follower is `moved` (m) along its path
    /// from where the motion puts it; `speed` and `load` are ratios to those of the design.
    pub(super) fn normal_force_as_made(
        &self,
        (piece, angle): (usize, f64),
        contact: &Contact,
        (moved, [speed, load]): (f64, [f64; 2]),
    ) -> Option<f64> {
        let pressing = self.pressing()?;
        let pressing = Pressing { constant: load * pressing.constant, ..pressing }.at_speed(speed * pressing.speed);
        let of_load = self.load.as_ref().map_or(0.0, |of| load * of.pressing_when(piece, angle, moved));
        let acting = with_load(&pressing, of_load, || contact.lift);
        Some(self.along_normal(acting, (piece, angle), contact))
    }

    /// The residual force of the balance there, N; `None` of a disc that balances nothing.
    pub(super) fn residual_as_made(
        &self,
        (piece, angle): (usize, f64),
        (moved, [speed, load]): (f64, [f64; 2]),
    ) -> Option<f64> {
        self.load.as_ref().map(|of| of.residual_as_made(piece, angle, moved, [speed * speed, load]))
    }

    /// What flanks bear of a force along the normal.
    pub(super) fn borne(&self, along_normal: f64) -> f64 {
        match self.hold {
            Hold::Flanks => along_normal.abs(),
            // Two equally stiff contacts share it until one of them is free.
            Hold::Pair { preload, .. } if along_normal.abs() < 2.0 * preload => preload + 0.5 * along_normal,
            Hold::Force | Hold::Pair { .. } => along_normal.max(0.0),
        }
    }

    /// Force along the normal, N, negative where it lifts the follower from its flank.
    pub(in crate::body) fn signed_normal_force(&self, at: (usize, f64), contact: &Contact) -> Option<f64> {
        let acting = self.acting_force_of(at, || contact.lift)?;
        Some(self.along_normal(acting, at, contact))
    }

    fn along_normal(&self, acting: f64, at: (usize, f64), contact: &Contact) -> f64 {
        let force = acting / self.follower.leverage(&contact.lift);
        let cosine = libm::cos(contact.pressure_angle);
        match self.program_follower.guide.filter(|_| self.touches(acting)) {
            Some(guide) => force / self.share_borne(&guide, at, contact, acting).max(0.0),
            None => force / cosine,
        }
    }

    /// Whether the follower goes down at a place of a piece, under the friction of a guide.
    fn is_lowered(&self, piece: usize, angle: f64) -> bool {
        let Some(piece) = self.motion.pieces().get(piece) else { return false };
        let holds = |(from, to): &JumpRange| (*from..=*to).contains(&angle) && *from < piece.end && *to > piece.start;
        self.program_follower.lowered.iter().any(holds)
    }

    /// Whether the follower moves against the way in which a cam that it presses on with this force drives it: friction then holds it off.
    fn is_helped(&self, (piece, angle): (usize, f64), contact: &Contact, acting: f64) -> bool {
        let outwards = self.curves().metal_side() * acting >= 0.0;
        let lowered = self.is_lowered(piece, angle);
        if outwards { lowered } else { !lowered && contact.lift.ds != 0.0 }
    }

    /// Share of the force along the normal that acts along the path of the follower, after the friction in its guide; not above 0 where
    /// it jams. Where the follower rests friction counts as while it is lifted.
    fn share_borne(&self, guide: &GuideData, at: (usize, f64), contact: &Contact, acting: f64) -> f64 {
        let off_stem = self.follower.on_face(&contact.lift).map_or(0.0, |face| face.place);
        let friction = guide::friction(guide, contact.pressure_angle, off_stem);
        let sign = if self.is_helped(at, contact, acting) { -1.0 } else { 1.0 };
        libm::cos(contact.pressure_angle) - sign * friction
    }

    /// Least share of the force along the normal that is left along the path after the friction of the guide, and where; `None` without
    /// a guide.
    pub(super) fn least_guide_share(&self) -> Option<Worst> {
        let (guide, curves) = (self.program_follower.guide?, self.curves());
        // Where the follower goes down friction helps it off the cam, and nothing jams.
        let share = |piece: usize, angle: f64| {
            let contact = curves.contact(piece, angle);
            let acting = if self.is_closed() { self.acting_force(piece, angle).unwrap_or(1.0) } else { 1.0 };
            let helped = self.is_helped((piece, angle), &contact, acting);
            if helped { -ALL } else { -self.share_borne(&guide, (piece, angle), &contact, acting) }
        };
        let least = self.largest_force(share);
        Some(Worst { value: -least.value, ..least })
    }

    /// The forces of a row of the table, where its load is in a state.
    pub(super) fn force_row(
        &self,
        at: (usize, f64),
        contact: &Contact,
        state: Option<&dyn LoadState>,
    ) -> Option<ForceRow> {
        let of_load = state.map_or(0.0, LoadState::pressing);
        let acting = with_load(&self.pressing()?, of_load, || contact.lift);
        Some(ForceRow {
            path: acting / self.follower.leverage(&contact.lift),
            torque: self.work(self.driving(acting, at), contact.lift.ds),
            // As everywhere, 0 where the follower has left the cam.
            contact: Some(self.borne(self.along_normal(acting, at, contact))),
        })
    }

    /// The ranges at whose ends forces may jump.
    pub fn acting(&self) -> Vec<JumpRange> {
        let load = self.load.iter().flat_map(|load| load.acting());
        load.chain(self.program_follower.lowered.iter().copied()).collect()
    }

    /// The largest of something that is smooth but for the ends of the load.
    pub fn largest_force(&self, value: impl Fn(usize, f64) -> f64) -> Worst {
        plane(extremes::largest_smooth(self.curves(), (&self.acting(), 0.0), value))
    }

    /// Torque of the shaft, N·m; NaN where no force is known.
    pub(super) fn torque(&self, piece: usize, angle: f64) -> f64 {
        let lift = self.motion.jet(piece, angle);
        self.work(self.driving_force_of((piece, angle), || lift).unwrap_or(f64::NAN), lift.ds)
    }

    /// Largest |torque| on the camshaft, N·m, and where; `None` where no force is known.
    #[must_use]
    pub fn torque_max(&self) -> Option<Worst> {
        self.pressing()?;
        let torque = |piece: usize, angle: f64| self.torque(piece, angle);
        Some(plane(extremes::largest_size(self.curves(), (&self.acting(), 0.0), torque)))
    }

    /// As [`Figures::preload_that_holds`](crate::body::Figures::preload_that_holds).
    pub(super) fn holding(&self, speed: f64) -> Option<KeyChange> {
        let pressing = self.pressing().filter(|_| self.is_of_program() && !self.is_closed())?;
        let faster = pressing.at_speed(speed * pressing.speed);
        let missing = self.largest_force(|piece, angle| -faster.force_at(&self.motion.jet(piece, angle))).value;
        let follower = &self.machine.follower;
        Some(match self.motion.quantity() {
            Quantity::Length => {
                let needed = (follower.preload.unwrap_or(0.0) + missing).ceil() + 1.0;
                KeyChange::new(format!("{}.preload", follower.path), format!("{needed} N"))
            }
            Quantity::Angle => {
                let needed = self.program_follower.spring.map_or(0.0, |spring| spring.preload) + missing;
                KeyChange::new("spring.preload", format!("{} N*m", three_digits_up(needed.max(1.0 / MILLIMETRES))))
            }
        })
    }
}

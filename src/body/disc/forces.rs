//! Forces between a disc and its follower.
//!
//! What presses the follower on is a force along a straight path, or a moment about the pivot of a follower that swings: the quantity whose
//! work goes with the lift. Over [`Follower::leverage`](crate::follower::Follower::leverage) it is the force along the drive of what
//! touches the cam, over the cosine of the pressure angle that along the normal.

use super::{Disc, GENERAL};
use crate::body::{Body, plane};
use crate::geometry::MILLIMETRES;
use crate::load::{Pressing, guide};
use crate::machine::{GuideData, Machine, SpringData};
use crate::motion::{Jet, Motion, Piece, Quantity, State};
use crate::numeric::digits::three_digits_up;
use crate::numeric::root;
use crate::profile::extremes::{self, Acting};
use crate::profile::{Contact, Worst};
use crate::table::ForceRow;
use std::sync::{Arc, OnceLock};

/// What only the follower of a motion program has.
#[derive(Debug, Clone, Default)]
pub(super) struct Own {
    pub(super) spring: Option<SpringData>,
    pub(super) guide: Option<GuideData>,
    pub(super) crown_radius: Option<f64>,
    /// Where the follower is lowered, under the friction of a guide.
    lowered: Arc<[Acting]>,
    pub(super) vibration: Arc<OnceLock<Option<super::Vibration>>>,
    /// The speed at which it first leaves the cam: of mass, spring and motion alone, not of the size of the cam.
    pub(super) jump: Arc<OnceLock<Worst>>,
}

/// Of the force along the normal, what is borne along the path without any friction.
const ALL: f64 = 1.0;

/// Cells of a piece in which its velocity may change sign once each.
const CELLS: u32 = 64;

/// The ranges in which a motion goes down.
fn lowered(motion: &dyn Motion) -> Vec<Acting> {
    let mut ranges: Vec<Acting> = Vec::new();
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
fn between_turns(motion: &dyn Motion, index: usize, piece: &Piece) -> Vec<Acting> {
    let velocity = |at: f64| motion.jet(index, at).ds;
    let place = |cell: u32| piece.start + (piece.end - piece.start) * f64::from(cell) / f64::from(CELLS);
    let mut cuts = vec![piece.start];
    for cell in 1..CELLS - 1 {
        if velocity(place(cell)) * velocity(place(cell + 1)) < 0.0 {
            cuts.extend(root::bracketed(velocity, place(cell), place(cell + 1), 0.0));
        }
    }
    cuts.push(piece.end);
    cuts.iter().copied().zip(cuts.iter().copied().skip(1)).collect()
}

/// What presses on beside a load and with it; the lift matters where that is not constant.
fn with_load(pressing: &Pressing, load: f64, lift: impl FnOnce() -> Jet) -> f64 {
    load + if pressing.is_constant() { pressing.constant } else { pressing.at(&lift()) }
}

/// Torque of the shaft against a force at a velocity: where the follower rests there is no work, jammed or not.
fn work(force: f64, velocity: f64) -> f64 {
    if velocity == 0.0 { 0.0 } else { force * velocity }
}

impl Own {
    pub(super) fn of(machine: &Machine, motion: &dyn Motion) -> Self {
        let (spring, guide) = (machine.spring(), machine.guide());
        let lowered = guide.map_or_else(Vec::new, |_| lowered(motion)).into();
        Self { spring, guide, crown_radius: machine.follower.crown_radius, lowered, ..Self::default() }
    }
}

impl Disc {
    /// What presses the follower on beside the load; `None` where no force is known.
    pub(super) fn pressing(&self) -> Option<Pressing> {
        let follower = &self.machine.follower;
        let by_inertia = *self.kind == GENERAL && follower.mass.is_some() && self.speed.is_some();
        if self.load.is_none() && follower.preload.is_none() && self.own.spring.is_none() && !by_inertia {
            return None;
        }
        let spring = self.own.spring.unwrap_or_default();
        Some(Pressing {
            mass: follower.mass.unwrap_or(0.0),
            damping: spring.damping,
            rate: follower.spring_rate + spring.rate,
            constant: follower.preload.unwrap_or(0.0) + spring.preload + spring.load,
            speed: self.speed.unwrap_or(0.0),
        })
    }

    /// What presses the follower on, the load's and, where they are given, spring, preload, damping and the inertia of what moves with
    /// the follower: along a straight path, N; about the pivot of one that swings, N·m. `None` where no force is known.
    #[must_use]
    pub fn acting_force(&self, piece: usize, angle: f64) -> Option<f64> {
        self.acting_force_of((piece, angle), || self.motion.jet(piece, angle))
    }

    /// The same where the lift may be known.
    fn acting_force_of(&self, (piece, angle): (usize, f64), lift: impl FnOnce() -> Jet) -> Option<f64> {
        let pressing = self.pressing()?;
        Some(with_load(&pressing, self.load.as_ref().map_or(0.0, |load| load.pressing(piece, angle)), lift))
    }

    /// The same as a force along the path of what touches the cam, N.
    #[must_use]
    pub fn path_force(&self, piece: usize, angle: f64) -> Option<f64> {
        let acting = self.acting_force(piece, angle)?;
        Some(match self.motion.quantity() {
            Quantity::Length => acting,
            Quantity::Angle => acting / self.follower.leverage(&self.motion.jet(piece, angle)),
        })
    }

    /// What the cam drives the follower with: as [`Self::acting_force`], with the friction of its guide.
    #[must_use]
    pub fn driving_force(&self, piece: usize, angle: f64) -> Option<f64> {
        self.driving_force_of((piece, angle), || self.motion.jet(piece, angle))
    }

    /// The same where the lift may be known.
    fn driving_force_of(&self, (piece, angle): (usize, f64), lift: impl FnOnce() -> Jet) -> Option<f64> {
        Some(self.driving(self.acting_force_of((piece, angle), lift)?, (piece, angle)))
    }

    /// What the cam drives the follower with where this force acts on it.
    fn driving(&self, acting: f64, (piece, angle): (usize, f64)) -> f64 {
        let Some(guide) = self.own.guide.filter(|_| acting > 0.0) else { return acting };
        let contact = self.curves().contact(piece, angle);
        acting * libm::cos(contact.pressure_angle) / self.share_borne(&guide, (piece, angle), &contact).max(0.0)
    }

    /// As [`Body::force_and_torque_of`].
    pub(super) fn driving_force_and_torque(&self, at: (usize, f64), lift: Jet) -> Option<[f64; 2]> {
        let driving = self.driving_force_of(at, || lift)?;
        Some([driving, work(driving, lift.ds)])
    }

    /// Force along the normal, N, with the friction of the guide; infinite where it jams, 0 where the follower has left the cam.
    #[must_use]
    pub fn normal_force(&self, piece: usize, angle: f64) -> Option<f64> {
        self.normal_force_of((piece, angle), &self.curves().contact(piece, angle))
    }

    /// The same where the follower's place is known.
    pub(super) fn normal_force_of(&self, at: (usize, f64), contact: &Contact) -> Option<f64> {
        let acting = self.acting_force_of(at, || contact.lift)?;
        Some(self.along_normal(acting, at, contact).max(0.0))
    }

    fn along_normal(&self, acting: f64, at: (usize, f64), contact: &Contact) -> f64 {
        let force = acting / self.follower.leverage(&contact.lift);
        let cosine = libm::cos(contact.pressure_angle);
        match self.own.guide.filter(|_| acting > 0.0) {
            Some(guide) => force / self.share_borne(&guide, at, contact).max(0.0),
            None => force / cosine,
        }
    }

    /// Whether the follower goes down at a place of a piece, under the friction of a guide.
    fn is_lowered(&self, piece: usize, angle: f64) -> bool {
        let Some(piece) = self.motion.pieces().get(piece) else { return false };
        let holds = |(from, to): &Acting| (*from..=*to).contains(&angle) && *from < piece.end && *to > piece.start;
        self.own.lowered.iter().any(holds)
    }

    /// What of the force along the normal the follower bears along its path beside the friction in its guide, as a share; not above 0 where
    /// it jams. Where the follower rests friction counts as while it is lifted.
    fn share_borne(&self, guide: &GuideData, (piece, angle): (usize, f64), contact: &Contact) -> f64 {
        let beside = self.follower.on_face(&contact.lift).map_or(0.0, |face| face.place);
        let friction = guide::friction(guide, contact.pressure_angle, beside);
        let sign = if self.is_lowered(piece, angle) { -1.0 } else { 1.0 };
        libm::cos(contact.pressure_angle) - sign * friction
    }

    /// As [`Body::guide_share`].
    pub(super) fn least_guide_share(&self) -> Option<Worst> {
        let (guide, curves) = (self.own.guide?, self.curves());
        // Where the follower goes down friction helps it off the cam, and nothing jams.
        let share = |piece: usize, angle: f64| {
            let borne = || self.share_borne(&guide, (piece, angle), &curves.contact(piece, angle));
            if self.is_lowered(piece, angle) { -ALL } else { -borne() }
        };
        let least = self.largest_force(share);
        Some(Worst { value: -least.value, ..least })
    }

    /// The forces of a row of the table, where its load is in a state.
    pub(super) fn force_row(&self, at: (usize, f64), contact: &Contact, state: Option<&State>) -> Option<ForceRow> {
        let of_load = self.load.as_ref().zip(state).map_or(0.0, |(load, state)| load.pressing_in(state));
        let acting = with_load(&self.pressing()?, of_load, || contact.lift);
        Some(ForceRow {
            path: acting / self.follower.leverage(&contact.lift),
            torque: work(self.driving(acting, at), contact.lift.ds),
            contact: Some(self.along_normal(acting, at, contact)),
        })
    }

    /// The ranges at whose ends forces may jump.
    pub(super) fn acting(&self) -> Vec<Acting> {
        let load = self.load.iter().flat_map(|load| load.acting());
        load.chain(self.own.lowered.iter().copied()).collect()
    }

    /// The largest of something that is smooth but for the ends of the load.
    pub(super) fn largest_force(&self, value: impl Fn(usize, f64) -> f64) -> Worst {
        plane(extremes::largest_smooth(self.curves(), (&self.acting(), 0.0), value))
    }

    /// Torque of the shaft, N·m; NaN where no force is known.
    pub(super) fn torque(&self, piece: usize, angle: f64) -> f64 {
        let lift = self.motion.jet(piece, angle);
        work(self.driving_force_of((piece, angle), || lift).unwrap_or(f64::NAN), lift.ds)
    }

    /// Largest |torque| on the camshaft, N·m, and where; `None` where no force is known.
    #[must_use]
    pub fn torque_max(&self) -> Option<Worst> {
        self.pressing()?;
        let torque = |piece: usize, angle: f64| self.torque(piece, angle);
        Some(plane(extremes::largest_size(self.curves(), (&self.acting(), 0.0), torque)))
    }

    /// As [`Body::least_closing_force`]: of a motion program wherever a force is known.
    pub(super) fn closing_force(&self) -> Option<Worst> {
        let follower = &self.machine.follower;
        let described = follower.mass.is_some() || follower.preload.is_some();
        let known = if *self.kind == GENERAL { self.pressing().is_some() } else { described };
        let least = known.then(|| self.largest_lifting_force());
        least.map(|least| Worst { value: -least.value, ..least })
    }

    /// As [`Body::preload_that_holds`].
    pub(super) fn holding(&self, speed: f64) -> Option<String> {
        let pressing = self.pressing().filter(|_| *self.kind == GENERAL)?;
        let faster = pressing.at_speed(speed * pressing.speed);
        let missing = self.largest_force(|piece, angle| -faster.at(&self.motion.jet(piece, angle))).value;
        let follower = &self.machine.follower;
        Some(match self.motion.quantity() {
            Quantity::Length => {
                let needed = (follower.preload.unwrap_or(0.0) + missing).ceil() + 1.0;
                format!("{}.preload = \"{needed} N\"", follower.path)
            }
            Quantity::Angle => {
                let needed = self.own.spring.map_or(0.0, |spring| spring.preload) + missing;
                format!("spring.preload = \"{} N*m\"", three_digits_up(needed.max(1.0 / MILLIMETRES)))
            }
        })
    }
}

//! How a disc cam and its follower move.

use super::Disc;
use crate::body::picture::{FollowerPose, RIGID, Scene, SecondContact};
use crate::body::{Body, Drawn};
use crate::report::mechanism::MovingMechanism;
use crate::table::turned;
use camgen_kernel::follower::Carrier;
use camgen_kernel::profile::Curves;
use nalgebra::Vector2;
use std::f64::consts::TAU;

const WITH_LOAD: &[&str] =
    &["Friction between roller and cam, in bearings and guides: forces and torque are without it."];
const WITHIN: &[&str] = &["The play of the roller between its flanks: it runs on the path of the motion."];
const WITH_GUIDE: &[&str] =
    &["Friction between roller and cam and in bearings: forces and torque are with that of the guide only."];
const WITHOUT_FORCES: &[&str] = &[
    "Forces and torque: the file gives no preload of the follower, so that no force is known.",
    "Friction: no force is known.",
];
const AT_REST: &[&str] = &["Inertia and damping: without motion.rpm or --rpm there is no speed."];
const WITHOUT_MASS: &[&str] = &["Inertia: the file gives no mass or inertia of the follower."];
const WITHOUT_VIBRATION: &[&str] = &["Vibration behind the follower: the file has no table [vibration]."];

/// Places of the profile of a second disc.
const PROFILE: u32 = 720;

/// A disc whose follower is another roller, or face, of the same follower.
#[derive(Clone, Copy)]
pub(in crate::body) struct SecondDisc<'a> {
    pub(in crate::body) disc: &'a Disc,
    /// The cam angle (rad) by which its motion is later.
    pub(in crate::body) later: f64,
    /// Whether it is a disc of its own, next to the first.
    pub(in crate::body) is_beside: bool,
}

impl SecondDisc<'_> {
    fn profile(&self) -> Vec<Vector2<f64>> {
        let curves = self.disc.curves();
        let at = |index: u32| {
            let (piece, angle) = curves.motion.locate(TAU * f64::from(index) / f64::from(PROFILE));
            let curve = curves.touch(piece, angle).curve;
            curve.point - curve.outward() * curves.offset()
        };
        if self.is_beside { (0..=PROFILE).map(at).collect() } else { Vec::new() }
    }
}

/// The mechanism of a disc as it moves; with a second disc that turns with it the roller or face on that as well.
pub(super) fn of(disc: &Disc, second: Option<SecondDisc<'_>>, drawn: &Drawn, samples: u32) -> MovingMechanism {
    let Some(part) = drawn.parts.first() else { return MovingMechanism::default() };
    let curves = disc.curves();
    let lobes = disc.motion.lobes();
    let place = |index: u32| {
        let (at, wrapped) = (turned(index, samples, lobes), index >= samples);
        let cam_deg = if wrapped { 360.0 } else { at.cam_deg };
        (if wrapped { 0.0 } else { at.angle }, cam_deg)
    };
    let places = |curves: Curves<'_>, later: f64| {
        let pose = |(angle, cam_deg): (f64, f64)| {
            let (piece, there) = curves.motion.locate(angle + later);
            let touch = curves.touch(piece, there);
            FollowerPose { angle: there - later, cam_deg, curve: touch.curve.point, outward: touch.curve.outward() }
        };
        (0..=samples).map(place).map(pose).collect()
    };
    let carrier = disc.follower.carrier();
    let on_an_arm = matches!(carrier, Carrier::Arm { .. });
    let behind = disc.duty.as_ref().filter(|_| !on_an_arm).and_then(|duty| duty.driven_mechanism(disc, samples));
    let spring = behind.is_none() && disc.pressing().is_some_and(|pressing| pressing.rate > 0.0);
    let mut notes = behind.as_ref().map_or_else(Vec::new, |behind| behind.notes());
    notes.extend(spring.then(|| "The spring is a symbol: its place and size are not those of the machine.".to_owned()));
    let scene = Scene {
        machine: &disc.machine,
        element: curves.element(),
        carrier,
        part,
        places: places(curves, 0.0),
        second: second.map(|second| SecondContact {
            element: second.disc.curves().element(),
            places: places(second.disc.curves(), second.later),
            profile: second.profile(),
        }),
        behind,
        shaft_speed: disc.shaft_speed(),
        rpm: None,
        spring,
    };
    MovingMechanism { views: vec![scene.view(|_, _| ())], notes, solid: None }
}

/// What is not modelled of a disc.
pub(super) fn not_modelled(disc: &Disc) -> Vec<&'static str> {
    if disc.load.is_some() {
        let of_machine = disc.duty.as_ref().map_or(&[][..], |duty| duty.not_modelled(&disc.machine));
        return [RIGID, of_machine, WITH_LOAD].concat();
    }
    let Some(pressing) = disc.pressing() else { return [RIGID, WITHOUT_FORCES].concat() };
    let mut all = vec![
        RIGID,
        if disc.hold == super::Hold::Flanks { WITHIN } else { &[] },
        if disc.program_follower.guide.is_some() { WITH_GUIDE } else { WITH_LOAD },
    ];
    if disc.is_of_program() {
        all.extend((pressing.speed == 0.0).then_some(AT_REST));
        all.extend((pressing.mass == 0.0).then_some(WITHOUT_MASS));
        all.extend(disc.machine.vibration().is_none().then_some(WITHOUT_VIBRATION));
    }
    all.concat()
}

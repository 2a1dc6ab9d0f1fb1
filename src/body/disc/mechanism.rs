//! How a disc cam and its follower move.

use super::Disc;
use crate::body::picture::press::{Buffer, Stand};
use crate::body::picture::{Placed, RIGID, Scene, of_its_press};
use crate::body::{Body, Drawn};
use crate::follower::Carrier;
use crate::machine::Machine;
use crate::report::mechanism::Mechanism;
use crate::table::turned;
use std::f64::consts::TAU;

const WITH_LOAD: &[&str] =
    &["Friction between roller and cam, in bearings and guides: forces and torque are without it."];
const WITH_GUIDE: &[&str] =
    &["Friction between roller and cam and in bearings: forces and torque are with that of the guide only."];
const WITHOUT_FORCES: &[&str] = &[
    "Forces and torque: the file gives no preload of the follower, so that no force is known.",
    "Friction: without forces there is none.",
];
const AT_REST: &[&str] = &["Inertia and damping: without motion.rpm or --rpm nothing moves by the time."];
const WITHOUT_MASS: &[&str] = &["Inertia: the file gives no mass or inertia of the follower."];
const WITHOUT_VIBRATION: &[&str] = &["Vibration behind the follower: the file has no table [vibration]."];

/// Of a disc.
pub(super) fn of(disc: &Disc, drawn: &Drawn, samples: u32) -> Mechanism {
    let Some(part) = drawn.parts.first() else { return Mechanism::default() };
    let curves = disc.curves();
    let lobes = disc.motion.lobes();
    let place = |index: u32| {
        let (at, wrapped) = (turned(index, samples, lobes), index >= samples);
        let cam_deg = if wrapped { 360.0 } else { at.cam_deg };
        let (piece, angle) = curves.motion.locate(if wrapped { 0.0 } else { at.angle });
        let touch = curves.touch(piece, angle);
        let stand = disc.load.as_ref().map(|load| {
            let state = load.state(piece, angle);
            let crank = f64::from(lobes) * if wrapped { TAU } else { at.angle };
            Stand { crank, overrun: load.place(crank), bottom: state.displacement, ratio: state.pressure_ratio }
        });
        Placed { angle, cam_deg, curve: touch.curve.point, outward: touch.curve.outward(), stand }
    };
    let press = disc.machine.press().ok().zip(disc.rpm).filter(|_| disc.load.is_some());
    let carrier = disc.follower.carrier();
    let scene = Scene {
        machine: &disc.machine,
        element: curves.element(),
        carrier,
        part,
        places: (0..=samples).map(place).collect(),
        buffer: press
            .filter(|_| !matches!(carrier, Carrier::Arm { .. }))
            .map(|(press, rpm)| Buffer::new(&press.cylinder(), &press.bottom_law(rpm))),
        shaft_speed: disc.shaft_speed(),
        rpm: None,
    };
    let notes = scene.buffer.map_or_else(Vec::new, |_| of_press(&disc.machine));
    Mechanism { views: vec![scene.view(|_, _| ())], notes, solid: None }
}

/// What is simplified in the picture of a press.
pub(in crate::body) fn of_press(machine: &Machine) -> Vec<String> {
    if machine.end().is_some() {
        return vec![
            "Cam, roller, bottom, air column and overrun are to one scale; rods, lever and bed are a scheme.".into(),
            "One cylinder of the pair is shown. The linkage that moves the bed is not: `camgen linkage` shows it."
                .into(),
        ];
    }
    vec![
        "Cam, roller, bottom, air column and overrun are to one scale; rods, lever and bed are a scheme.".into(),
        "One cylinder of the pair is shown; between its reversals the bed leaves the picture.".into(),
    ]
}

/// Of a disc.
pub(super) fn not_modelled(disc: &Disc) -> Vec<&'static str> {
    if disc.load.is_some() {
        return [RIGID, of_its_press(&disc.machine), WITH_LOAD].concat();
    }
    let Some(pressing) = disc.pressing() else { return [RIGID, WITHOUT_FORCES].concat() };
    let mut all = vec![RIGID, if disc.own.guide.is_some() { WITH_GUIDE } else { WITH_LOAD }];
    if *disc.kind == super::GENERAL {
        all.extend((pressing.speed == 0.0).then_some(AT_REST));
        all.extend((pressing.mass == 0.0).then_some(WITHOUT_MASS));
        all.extend(disc.machine.vibration().is_none().then_some(WITHOUT_VIBRATION));
    }
    all.concat()
}

//! How a conoid moves at each of its speeds, and its surface as rings about the axis.

use super::{Conoid, SectionCut};
use crate::press::MachineOfPress;
use crate::press::picture::{BufferPicture, PressPicture, press_poses, simplifications};
use camgen_cams::body::picture::{Cover, FollowerPose, Scene};
use camgen_cams::body::{Body, Drawn, Part};
use camgen_cams::machine::Rotation;
use camgen_cams::report::mechanism::{MechanismView, MovingMechanism, RigidPart, RingSolid, line, rectangle};
use camgen_cams::report::sheet::rounded;
use camgen_cams::table::turned;
use camgen_kernel::follower::{Carrier, Element};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::Motion;
use camgen_kernel::numeric::parallel;
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// What is not modelled of a conoid.
pub(super) const NOT_MODELLED: &[&str] = &[
    "Friction between roller and cam, in bearings and guides: forces and torque are without it.",
    "The shift along the axis while the speed changes: each speed is shown in steady operation.",
];

/// Points of a ring of the surface, and rings between its ends.
const RING: u32 = 120;
const RINGS: u32 = 28;

/// The mechanism of a conoid as it moves.
pub(super) fn build(conoid: &Conoid, drawn: &Drawn, samples: u32) -> MovingMechanism {
    let shown: Vec<(SectionCut<'_>, &Part)> = conoid.sections_cut().into_iter().zip(&drawn.parts).collect();
    let views = parallel::map(&shown, |(cut, part)| view(conoid, *cut, part, samples));
    let mut notes = simplifications(conoid.machine.end().is_some());
    notes.push(
        "The roller is a sphere; it is shown in the plane of its centre, which may be a little off the section.".into(),
    );
    MovingMechanism { views, notes, solid: Some(solid(conoid)) }
}

fn view(conoid: &Conoid, cut: SectionCut<'_>, part: &Part, samples: u32) -> MechanismView {
    let SectionCut { rpm, z, section } = cut;
    let lobes = conoid.lobes.max(1);
    let mut places = Vec::new();
    for index in 0..=samples {
        let (at, wrapped) = (turned(index, samples, lobes), index >= samples);
        let cam_deg = if wrapped { 360.0 } else { at.cam_deg };
        let (piece, angle) = section.locate(if wrapped { 0.0 } else { at.angle });
        let contact = conoid.contact(piece, angle, z);
        let (curve, outward) = (contact.centre.xy(), contact.normal.xy().normalize());
        places.push(FollowerPose { angle, cam_deg, curve, outward });
    }
    let behind = PressPicture {
        buffer: BufferPicture::new(&conoid.cylinder, &section.law().bottom_law),
        poses: press_poses(section, &section.law().bottom_law, lobes, samples),
        lever: conoid.lever,
        under_a_linkage: conoid.machine.end().is_some(),
    };
    let scene = Scene {
        second: None,
        machine: &conoid.machine,
        element: Element::Roller { radius: conoid.roller.radius },
        carrier: Carrier::Straight,
        part,
        places,
        behind: Some(Box::new(behind)),
        shaft_speed: Some(conoid.press.bed.crank_speed(rpm) / f64::from(lobes)),
        rpm: Some(rpm),
        spring: false,
    };
    scene.view(|parts, cover| parts.extend(axial(conoid, cut, cover)))
}

/// The cam from its side, with the axial positions of the sections and of the roller.
fn axial(conoid: &Conoid, cut: SectionCut<'_>, cover: &mut Cover) -> Vec<RigidPart> {
    let (low, high) = conoid.ends();
    let radius = MILLIMETRES * conoid.roller.radius;
    let top = cover.0.least.y - 1.4 * radius;
    let bottom = top - 1.2 * radius;
    let ends = (from_middle(conoid, low), from_middle(conoid, high));
    let mut shapes = vec![rectangle(ends, (bottom, top))];
    for section in conoid.sections_cut() {
        let x = from_middle(conoid, section.z);
        shapes.push(line((x, bottom), (x, top)));
    }
    let below = bottom - 1.6 * radius;
    cover.add(ends, (below, top + radius));
    let words = format!("along the axis: {} rpm at z = {} mm", rounded(cut.rpm), rounded(MILLIMETRES * cut.z));
    let x = from_middle(conoid, cut.z);
    let roller = rectangle((x - 0.08 * radius, x + 0.08 * radius), (bottom, top + 0.5 * radius));
    vec![
        RigidPart::new("ghost", shapes),
        RigidPart::new("bottom", vec![roller]).named(words, 0.0, bottom - 0.25 * radius),
    ]
}

/// Position along the axis from the middle of the cam, mm.
fn from_middle(conoid: &Conoid, z: f64) -> f64 {
    let (low, high) = conoid.ends();
    MILLIMETRES * (z - 0.5 * (low + high))
}

/// The surface as rings.
fn solid(conoid: &Conoid) -> RingSolid {
    let (low, high) = conoid.ends();
    let mirror = if conoid.machine().cam.rotation == Rotation::CounterClockwise { -1.0 } else { 1.0 };
    let places: Vec<f64> = (0..=RINGS).map(|i| low + (high - low) * f64::from(i) / f64::from(RINGS)).collect();
    let rings = parallel::map(&places, |z| {
        let slice = conoid.slice(*z);
        let mut ring = Vec::new();
        for i in 0..RING {
            let (piece, angle) = slice.locate(TAU * f64::from(i) / f64::from(RING));
            let point = conoid.cut(piece, angle, *z).map_or_else(Vector2::zeros, |(frame, _)| frame.point);
            ring.push(Vector2::new(point.x, mirror * point.y) * MILLIMETRES);
        }
        (MILLIMETRES * z, ring)
    });
    RingSolid {
        rings,
        bore: conoid.machine.cam.bore_radius.map(|radius| MILLIMETRES * radius),
        roller: MILLIMETRES * conoid.roller.radius,
        sections: conoid.sections_cut().iter().map(|cut| (cut.rpm, MILLIMETRES * cut.z)).collect(),
    }
}

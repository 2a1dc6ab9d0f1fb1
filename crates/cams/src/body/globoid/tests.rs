use super::{End, FlankCurve, Globoid};
use crate::body::in_groove::{GrooveForces, InGroove};
use crate::body::swept::{FlankSide, RollerLine, SweptFlanks};
use crate::machine::Machine;
use crate::pipeline::{Cam, Spec};
use nalgebra::Vector3;

fn globoid(overrides: &[&str]) -> (Globoid, Cam) {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let machine = Machine::load("indexer", &overrides).expect("valid").0;
    let (motion, rpm) = machine.motion().expect("a motion");
    let found = Globoid::of(&machine, &motion, rpm).expect("a globoid");
    (found, Spec::of_program(machine, None).expect("a motion").solve().expect("a cam"))
}

/// Points of a flank at a known distance from it are found there, in either sense of rotation.
#[test]
fn a_point_is_as_far_from_the_flank_as_it_was_moved() {
    for rotation in ["cw", "ccw"] {
        let (globoid, _) = globoid(&[&format!("cam.rotation={rotation}")]);
        let sense = globoid.groove.sense();
        for i in 0..40 {
            for flank in FlankSide::BOTH {
                let from = globoid.outside + (globoid.floor - globoid.outside) * f64::from(i % 5) / 4.0;
                let curve = FlankCurve { flank, roller: 0.0, from_turret: from };
                let [enters, leaves] =
                    [End::Bottom, End::Top].map(|end| globoid.passes(curve, end).expect("it passes"));
                let angle = enters + (leaves - enters) * (f64::from(i) + 0.5) / 40.0;
                let found = globoid.edge(curve, angle).expect("a point");
                let line = globoid.line_at(angle, 0.0);
                // The normal by which the place was found, into the metal: from the centre line outwards.
                let (s, c) = libm::sincos(line.angle[0]);
                let along = Vector3::new(-c, 0.0, s);
                let centre = Vector3::new(line.distance, 0.0, 0.0);
                let v = (found.place - centre).dot(&along);
                let inwards = (found.place - centre - along * v).normalize();
                let (sin, cos) = libm::sincos(angle);
                let turned = |v: Vector3<f64>| Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z);
                for off in [0.0, 0.003, -0.002] {
                    let moved = turned(found.place) * 1e3 + turned(inwards) * off;
                    let miss = globoid.miss(Vector3::new(moved.x, sense * moved.y, moved.z));
                    assert!((miss.value - off).abs() < 1e-7, "{rotation} {i} {flank:?} {off}: {miss:?}");
                    let due = -turned(inwards);
                    let due = Vector3::new(due.x, sense * due.y, due.z);
                    assert!((miss.outward - due).norm() < 1e-6, "{rotation} {i} {flank:?}: {miss:?}");
                }
            }
        }
    }
}

/// Drawn, written, read back: every check passes, and the volume is that of the integral.
#[test]
fn a_globoid_is_proved_on_its_file() {
    for overrides in [
        &[][..],
        &["cam.rotation=ccw", "cam.rests_on=groove"],
        &["cam.rollers=16", "cam.advance=2", "follower.roller.radius=7 mm"],
    ] {
        let (_, cam) = globoid(overrides);
        let proven = cam.draw(5e-6).expect("a drawing").prove().expect("a proof");
        for finding in proven.findings() {
            assert_ne!(finding.verdict, crate::report::Verdict::Fail, "{overrides:?}: {finding:?}");
        }
        for name in ["flank_surface", "solid_shell", "solid_volume", "groove_width", "meshing"] {
            assert!(proven.findings().iter().any(|finding| finding.check == name), "{name}");
        }
    }
}

/// The force along the normal turns the cam as the torque says; the turret is moved on against its load by the work of the shaft.
#[test]
fn the_normal_force_turns_the_cam_by_the_torque() {
    let (globoid, _) = globoid(&["cam.turret_inertia=0.4 kg*m2", "spring.load=15 N*m"]);
    let forces = GrooveForces::of(&globoid).expect("an inertia and a speed");
    for i in 0..60 {
        let (piece, angle) = globoid.groove.motion.locate(0.1 * f64::from(i) + 0.01);
        let row = forces.row((piece, angle));
        let contacts = globoid.contacts((piece, angle), row.path >= 0.0);
        assert!(!contacts.is_empty(), "{i}");
        for contact in contacts {
            let axis = globoid.line_in(piece, angle, 0.0, f64::from(contact.roller));
            let line = axis.point(globoid.turret.arm);
            let force = row.path.abs() / libm::cos(contact.pressure_angle);
            assert!(force <= row.contact.expect("in touch") * (1.0 + 1e-12));
            let turned = row.path.signum() * force * line.slope.0 * axis.run(line.v);
            assert!((turned - row.torque).abs() < 1e-9 * (1.0 + row.torque.abs()), "{i}: {turned} {row:?}");
        }
    }
    let torque = forces.shaft_torque().expect("it turns");
    let work = 15.0 * globoid.turret.index() / std::f64::consts::TAU;
    assert!((torque.mean - work).abs() < 1e-9, "{torque:?} {work}");
}

/// The turns of a roller, by a sum over the turns of the cam in which it passes, and the load on its bearing.
#[test]
fn a_roller_is_loaded_while_it_passes() {
    let (globoid, _) = globoid(&["cam.turret_inertia=0.4 kg*m2", "follower.roller.bearing.dynamic_rating=20 kN"]);
    let forces = GrooveForces::of(&globoid).expect("an inertia and a speed");
    let duty = forces.roller_duty().expect("a bearing");
    let (count, exponent) = (20_000, 10.0 / 3.0);
    let (mut worn, mut turns) = (0.0, 0.0);
    for i in 0..count {
        let at = globoid.groove.motion.locate(std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(count));
        let path = forces.row(at).path;
        for contact in globoid.contacts(at, path >= 0.0) {
            let sign = if path >= 0.0 { 1.0 } else { -1.0 };
            let n = (sign * contact.by_path[0] - contact.carrier_turn[0]).abs() / f64::from(count);
            worn += n * libm::pow(path.abs() / libm::cos(contact.pressure_angle), exponent);
            turns += n;
        }
    }
    // The midpoint rule errs by a cell wherever another roller comes into touch.
    assert!((8.0 * duty.mean_turns / turns - 1.0).abs() < 1e-3, "{duty:?} {turns}");
    assert!((duty.equivalent_load / libm::pow(worn / turns, 1.0 / exponent) - 1.0).abs() < 1e-3, "{duty:?}");
}

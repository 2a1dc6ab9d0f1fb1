use super::{End, Flank, Globoid};
use crate::body::swept::SweptFlanks;
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
        let sense = globoid.sense();
        for i in 0..40 {
            for flank in Flank::BOTH {
                let from = globoid.outside + (globoid.floor - globoid.outside) * f64::from(i % 5) / 4.0;
                let [enters, leaves] =
                    [End::Bottom, End::Top].map(|end| globoid.passes(flank, end, (from, 0.0)).expect("it passes"));
                let angle = enters + (leaves - enters) * (f64::from(i) + 0.5) / 40.0;
                let found = globoid.edge(flank, from, (angle, 0.0)).expect("a point");
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

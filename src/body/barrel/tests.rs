use super::{Barrel, FlankSide};
use crate::body::swept::SweptFlanks;
use crate::machine::Machine;
use crate::pipeline::{Cam, Spec};
use nalgebra::Vector3;

fn barrel(overrides: &[&str]) -> (Barrel, Cam) {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let machine = Machine::load("barrel", &overrides).expect("valid").0;
    let (motion, rpm) = machine.motion().expect("a motion");
    let found = Barrel::of(&machine, &motion, rpm).expect("a barrel");
    (found, Spec::of_program(machine, None).expect("a motion").solve().expect("a cam"))
}

/// Points of a flank at a known distance from it are found there, in either sense of rotation.
#[test]
fn a_point_is_as_far_from_the_flank_as_it_was_moved() {
    for rotation in ["cw", "ccw"] {
        let (barrel, _) = barrel(&[&format!("cam.rotation={rotation}")]);
        let sense = barrel.sense();
        for i in 0..40 {
            let (piece, angle) = barrel.motion.locate(0.157 * f64::from(i) + 0.01);
            let radius = barrel.floor() + barrel.depth * f64::from(i % 5) / 4.0;
            for side in [FlankSide::Upper, FlankSide::Lower] {
                let found = barrel.edge(side, radius, (piece, angle)).expect("a point");
                let (sin, cos) = libm::sincos(angle + found.ahead);
                let (tilt, lean) = found.line.slope;
                let up = if side == FlankSide::Upper { 1.0 } else { -1.0 };
                let (back, along) = libm::sincos(angle);
                // Into the metal, away from the roller.
                let inwards = Vector3::new(back * tilt, -along * tilt, lean) * up;
                let point = Vector3::new(radius * cos, radius * sin, found.height) * 1e3;
                for off in [0.0, 0.003, -0.002] {
                    let moved = point + inwards * off;
                    let miss = barrel.miss(Vector3::new(moved.x, sense * moved.y, moved.z));
                    assert!((miss.value - off).abs() < 1e-7, "{rotation} {i} {side:?} {off}: {miss:?}");
                    let outward = Vector3::new(-inwards.x, -sense * inwards.y, -inwards.z);
                    assert!((miss.outward - outward).norm() < 1e-6, "{rotation} {i} {side:?}: {miss:?}");
                }
            }
        }
    }
}

/// Drawn, written, read back: every check passes, and the volume is that of the integral.
#[test]
fn a_barrel_is_proved_on_its_files() {
    for overrides in [&[][..], &["cam.rotation=ccw", "follower.roller.offset=3 mm"]] {
        let (_, cam) = barrel(overrides);
        let proven = cam.draw(5e-6).expect("a drawing").prove().expect("a proof");
        for finding in proven.findings() {
            assert_ne!(finding.verdict, crate::report::Verdict::Fail, "{overrides:?}: {finding:?}");
        }
        for name in ["unrolled", "flank_surface", "solid_shell", "solid_volume", "groove_width", "plane_offset_error"] {
            assert!(proven.findings().iter().any(|finding| finding.check == name), "{name}");
        }
    }
}

/// The largest radius of the limits: R ≥ max s'/tan α at the inner end of the roller.
#[test]
fn the_automatic_radius_keeps_the_pressure_angle() {
    let (barrel, _) = barrel(&["cam.outer_radius=auto", "cam.bore_radius=5 mm"]);
    let steepest = barrel.largest(|jet| jet.ds.abs()).value;
    let least = steepest / 30.0_f64.to_radians().tan() + barrel.reach;
    assert!(barrel.outer >= least && barrel.outer < least + 1.001e-3, "{} {least}", barrel.outer);
}

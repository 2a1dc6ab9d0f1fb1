use super::TaperedRoller;
use crate::body::barrel::{Barrel, BarrelLine};
use crate::body::in_groove::{GrooveForces, InGroove};
use crate::body::swept::{FlankSide, RollerLine, SweptFlanks, SweptGeometry};
use crate::machine::Machine;
use crate::pipeline::{Cam, Spec};
use crate::report::Verdict;
use nalgebra::Vector3;

const BODY: &str = "cam.body=tapered-barrel";

fn machine(overrides: &[&str]) -> Machine {
    let overrides: Vec<String> = [BODY].iter().chain(overrides).map(|text| (*text).to_owned()).collect();
    Machine::load("barrel", &overrides).expect("valid").0
}

fn barrel(overrides: &[&str]) -> Barrel<TaperedRoller> {
    let machine = machine(overrides);
    let (motion, rpm) = machine.motion().expect("a motion");
    Barrel::of(&machine, &motion, rpm).expect("a barrel")
}

fn cam(overrides: &[&str]) -> Cam {
    Spec::of_program(machine(overrides), None).expect("a motion").solve().expect("a cam")
}

/// Points of a flank at a known distance along its normal are found there, in either sense of rotation.
#[test]
fn a_point_is_as_far_from_the_flank_as_it_was_moved() {
    for (rotation, roller) in [
        ("cw", ["cam.roller_half_angle=12 deg", "follower.roller.radius=10 mm"]),
        ("ccw", ["cam.roller_half_angle=12 deg", "follower.roller.radius=10 mm"]),
        ("cw", ["cam.roller_half_angle=auto", "follower.roller.radius=64 mm"]),
    ] {
        let barrel = barrel(&[&format!("cam.rotation={rotation}"), roller[0], roller[1]]);
        let (groove, sense) = (barrel.groove(), barrel.groove().sense());
        for i in 0..40 {
            let (piece, angle) = groove.motion.locate(0.157 * f64::from(i) + 0.01);
            let line = barrel.line(&groove.motion.jet(piece, angle), 0);
            let v = 0.054 + 0.011 * f64::from(i % 5) / 4.0;
            for side in FlankSide::BOTH {
                let found = line.offset(v, groove.signed(side));
                let (tilt, lean) = found.line.slope;
                let (sin, cos) = libm::sincos(angle);
                let turned = |p: Vector3<f64>| Vector3::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos, p.z);
                let height = line.axis().along[0];
                let point = turned(Vector3::new(v, -found.distance * tilt, height + found.distance * lean)) * 1e3;
                // Into the metal, away from the roller.
                let inwards = turned(Vector3::new(-found.widening, -tilt, lean)).normalize() * found.distance.signum();
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
fn a_tapered_groove_is_proved_on_its_files() {
    for overrides in [&[][..], &["cam.rotation=ccw", "cam.roller_half_angle=15 deg"]] {
        let proven = cam(overrides).draw(5e-6).expect("a drawing").prove().expect("a proof");
        for finding in proven.findings() {
            assert_ne!(finding.verdict, Verdict::Fail, "{overrides:?}: {finding:?}");
        }
        for name in ["unrolled", "flank_surface", "solid_shell", "solid_volume", "groove_width", "plane_offset_error"] {
            assert!(proven.findings().iter().any(|finding| finding.check == name), "{name}");
        }
    }
}

/// The force along the normal of the cone turns the cam as the torque says.
#[test]
fn the_normal_force_turns_the_cam_by_the_torque() {
    let barrel = barrel(&["follower.roller.mass=5 kg", "spring.rate=3 N/mm"]);
    let forces = GrooveForces::of(&barrel).expect("a mass and a speed");
    let groove = barrel.groove();
    for i in 0..40 {
        let (piece, angle) = groove.motion.locate(0.157 * f64::from(i) + 0.01);
        let row = forces.row((piece, angle));
        let line = barrel.line(&groove.motion.jet(piece, angle), 0);
        let middle = barrel.middle(&line);
        let (sin, _) = line.point(middle).slope;
        let lever = middle + line.taper * line.radius_at(middle, line.radius);
        let turned = row.path.signum() * row.contact.expect("in touch") * sin * lever / line.slant();
        assert!((turned - row.torque).abs() < 1e-9 * (1.0 + row.torque.abs()), "{i}: {turned} {row:?}");
    }
}

/// A cone that points at the axis of the cam rolls without sliding while it rests: at every place by the radius there over that of the roller.
#[test]
fn the_usual_cone_does_not_slide_at_rest() {
    let barrel = barrel(&[]);
    let motion = &barrel.groove().motion;
    let (piece, angle) = motion.locate(150.0_f64.to_radians());
    let line = barrel.line(&motion.jet(piece, angle), 0);
    for v in [0.054, 0.060, 0.065] {
        let turns = line.point(v).speed / line.radius_at(v, 0.010);
        assert!((turns - 6.5).abs() < 1e-12, "{v}: {turns}");
    }
    let contact = barrel.contacts((piece, angle), true).pop().expect("a contact");
    let half_angle = (10.0_f64 / 65.0).atan();
    assert!(
        (contact.by_path[0] - 6.5).abs() < 1e-12 && (contact.pressure_angle - half_angle).abs() < 1e-12,
        "{contact:?}"
    );
    // A cylinder and a flank that rises outwards: 1/ρ across the cone, less what the flank is convex round the cam.
    let (rho, v) = (line.radius_at(0.0595, 0.010), 0.0595);
    let due = half_angle.cos() / rho + half_angle.sin() / v;
    let found = line.curvature_under(&line.point(v), 0.010, rho);
    assert!((found / due - 1.0).abs() < 1e-12, "{found} {due}");
}

#[test]
fn what_a_cone_cannot_do_is_refused() {
    for (overrides, what) in [
        (&["follower.roller.offset=3 mm"][..], "must point at that of the cam"),
        (&["cam.roller_half_angle=45 deg"], "ends in a point"),
        (&["cam.roller_height=13 mm"], "reaches"),
    ] {
        let overrides: Vec<String> = [BODY].iter().chain(overrides).map(|text| (*text).to_owned()).collect();
        let refused = match Machine::load("barrel", &overrides) {
            Ok((machine, _)) => {
                let (motion, rpm) = machine.motion().expect("a motion");
                Barrel::<TaperedRoller>::of(&machine, &motion, rpm).expect_err("refused").to_string()
            }
            Err(refused) => refused.to_string(),
        };
        assert!(refused.contains(what), "{refused}");
    }
}

/// A roller as wide as the cam is drawn and proved, a wider one is refused in whatever cylinder is found.
#[test]
fn a_wide_roller_is_proved_or_refused() {
    let wide = ["limits.pressure_angle=40 deg", "limits.min_convex_radius=1 mm", "follower.roller.radius=70 mm"];
    let with = |outer: &str| {
        let overrides = [wide.as_slice(), &[outer]].concat();
        let machine = machine(&overrides);
        let (motion, rpm) = machine.motion().expect("a motion");
        Barrel::<TaperedRoller>::of(&machine, &motion, rpm)
    };
    assert!(with("cam.outer_radius=69 mm").expect_err("46 deg").what.contains("45.41"));
    let found = with("cam.outer_radius=auto").expect("a barrel");
    let line = found.line(&found.groove().motion.jet(0, 0.0), 0);
    assert!(line.taper <= 1.0 && line.outer >= 0.07, "{line:?}");
    let solved = cam(&[wide.as_slice(), &["cam.outer_radius=72 mm"]].concat());
    let proven = solved.draw(5e-6).expect("a drawing").prove().expect("a proof");
    for name in ["flank_surface", "groove_width"] {
        let found = proven.findings().iter().find(|finding| finding.check == name).expect("a check");
        assert_eq!(found.verdict, Verdict::Pass, "{found:?}");
    }
}

/// The largest tool is as wide as the floor, not as the outside.
#[test]
fn a_cutter_goes_down_to_the_floor() {
    let barrel = barrel(&["cam.roller_half_angle=30 deg"]);
    let floor = 10.015e-3 - 12e-3 * libm::tan(30_f64.to_radians());
    assert!((crate::body::swept::SweptBody::narrowest_half_width(&barrel) - floor).abs() < 1e-12);
}

use super::RollerPath;
use crate::body::in_groove::GrooveForces;
use crate::body::swept::{FlankSide, RollerLine, SweptFlanks, SweptGeometry, largest, pressure_angles};
use crate::machine::Machine;
use crate::pipeline::{Cam, Spec};
use nalgebra::Vector3;

type Barrel = super::Barrel<RollerPath>;

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
        let sense = barrel.groove.sense();
        for i in 0..40 {
            let (piece, angle) = barrel.groove.motion.locate(0.157 * f64::from(i) + 0.01);
            let radius = barrel.floor() + barrel.depth * f64::from(i % 5) / 4.0;
            for side in FlankSide::BOTH {
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
    let steepest = largest(&barrel, |jet, _| jet.ds.abs()).value;
    let least = steepest / 30.0_f64.to_radians().tan() + barrel.reach;
    assert!(barrel.outer >= least && barrel.outer < least + 1.001e-3, "{} {least}", barrel.outer);
}

/// The force along the normal turns the cam as the torque says, on a straight path with an offset and on an arm; over a turn the shaft gives back what it
/// took.
#[test]
fn the_normal_force_turns_the_cam_by_the_torque() {
    const ARM: &str = r#"name = "Arm"
motion = { rpm = 150, start = "0 deg", segment = [
    { law = "cycloidal", over = "150 deg", to = "18 deg" },
    { law = "cycloidal", over = "150 deg", to = "0 deg" },
    { law = "dwell" },
] }
follower.swinging-roller = { radius = "10 mm", arm = "120 mm", pivot_distance = "118 mm", inertia = "0.08 kg*m2" }
spring.damping = "2 N*m*s/rad"
cam = { body = "barrel", outer_radius = "65 mm", groove_depth = "12 mm", clearance = "0.03 mm" }
"#;
    let arm = Machine::from_toml("arm.toml", ARM, &[]).expect("valid");
    let (motion, rpm) = arm.motion().expect("a motion");
    let arm = Barrel::of(&arm, &motion, rpm).expect("a barrel");
    let straight = barrel(&["follower.roller.mass=5 kg", "follower.roller.offset=4 mm", "spring.rate=3 N/mm"]).0;
    for barrel in [straight, arm] {
        let forces = GrooveForces::of(&barrel).expect("a mass and a speed");
        for i in 0..40 {
            let (piece, angle) = barrel.groove.motion.locate(0.157 * f64::from(i) + 0.01);
            let row = forces.row((piece, angle));
            let axis = barrel.axis(piece, angle);
            let middle = 0.5 * barrel.touched(&axis).iter().sum::<f64>();
            let (sin, _) = axis.point(middle).slope;
            let lift = barrel.groove.motion.jet(piece, angle);
            let sign = row.path.signum();
            let turned = sign * row.contact.expect("in touch") * sin * middle;
            assert!((turned - row.torque).abs() < 1e-9 * (1.0 + row.torque.abs()), "{i}: {turned} {row:?} {lift:?}");
        }
        let torque = forces.shaft_torque().expect("it turns");
        let damped = barrel.groove.machine.spring().is_some_and(|spring| spring.damping > 0.0);
        assert!(if damped { torque.mean > 0.1 } else { torque.mean.abs() < 1e-12 }, "{torque:?}");
    }
}

/// Pressure and life by their formulas, the life by a sum over the turn.
#[test]
fn pressure_and_life_are_those_of_the_formulas() {
    let (barrel, _) = barrel(&["follower.roller.mass=8 kg", "follower.roller.bearing.dynamic_rating=20 kN"]);
    let forces = GrooveForces::of(&barrel).expect("a mass and a speed");
    let stress = forces.contact_stress().expect("a material");
    let at = barrel.groove.motion.locate(stress.at);
    let axis = barrel.axis(at.0, at.1);
    let [inner, outer] = barrel.touched(&axis);
    let row = forces.row(at);
    let side = if row.path > 0.0 { -barrel.groove.distances[1] } else { barrel.groove.distances[0] };
    let sharpest = [inner, outer].map(|v| axis.reduced_curvature(&axis.point(v), side)).into_iter().fold(0.0, f64::max);
    // Of the clearance, 1.5 µm a side of 10 mm, the pressure takes the roller.
    let curvature = sharpest - side.abs().recip() + barrel.groove.roller.recip();
    let modulus = 210e9 / (2.0 * (1.0 - 0.3 * 0.3));
    // The contact line is off the roller's axis by the sine of the pressure angle, and ends there at the cylinder.
    let lift = barrel.groove.motion.jet(at.0, at.1);
    let beside = |v: f64| side * libm::sin(barrel.pressure_angle(&lift, &axis, v));
    let leaves = (0..50).fold(outer, |v, _| (barrel.outer.powi(2) - beside(v).powi(2)).sqrt());
    let length = leaves - inner;
    let due = (row.contact.expect("in touch") * modulus * curvature / (std::f64::consts::PI * length)).sqrt();
    assert!((stress.value / due - 1.0).abs() < 1e-9, "{stress:?} {due}");
    // Mean over the turns of the roller; the midpoint rule has kinks at the changes of flank.
    let (count, exponent) = (40_000, 10.0 / 3.0);
    let (mut worn, mut turns) = (0.0, 0.0);
    for i in 0..count {
        let angle = std::f64::consts::TAU * (f64::from(i) + 0.5) / f64::from(count);
        let at = barrel.groove.motion.locate(angle);
        let line = barrel.axis(at.0, at.1).point(0.5 * (inner + outer));
        let n = line.speed / barrel.groove.roller / f64::from(count);
        worn += n * libm::pow(forces.row(at).contact.expect("in touch"), exponent);
        turns += n;
    }
    let load = libm::pow(worn / turns, 1.0 / exponent);
    let duty = forces.roller_duty().expect("a bearing");
    assert!((duty.equivalent_load / load - 1.0).abs() < 1e-6, "{duty:?} {load}");
    assert!((duty.mean_turns / turns - 1.0).abs() < 1e-7, "{duty:?} {turns}");
    let life = libm::pow(20e3 / load, exponent) * 1e6 / (60.0 * 150.0 * turns);
    assert!((duty.life.expect("a speed") / life - 1.0).abs() < 1e-5, "{duty:?} {life}");
}

/// A roller with an offset reaches as far below the outside as one that points at it, so that its end runs nearer to the axis along its own.
#[test]
fn a_roller_beside_the_axis_runs_nearer_to_it() {
    let (barrel, _) = barrel(&["follower.roller.offset=38mm"]);
    let steepest = pressure_angles(&barrel)[0].value.to_degrees();
    let v = (54.0_f64 * 54.0 - 38.0 * 38.0).sqrt();
    let due = (31.020_9_f64 / v).atan().to_degrees();
    assert!((steepest - due).abs() < 1e-3, "{steepest} {due}");
}

/// A large barrel has arcs that are nearly lines.
#[test]
fn the_developed_view_of_a_large_barrel_joins() {
    for outer in ["600 mm", "900 mm"] {
        let (_, cam) = barrel(&[&format!("cam.outer_radius={outer}")]);
        let proven = cam.draw(5e-6).expect("drawn").prove().expect("proved");
        let found = proven.findings().iter().find(|finding| finding.check == "unrolled").expect("checked");
        assert_eq!(found.verdict, crate::report::Verdict::Pass, "{outer}: {found:?}");
    }
}

use crate::press::MachineOfPress;
use crate::press::rotary::{RotaryCam, rotary};
use camgen_cams::body::disc::Disc;
use camgen_cams::body::{Body, ROUNDING_OF_BALANCE};
use camgen_cams::load::Load;
use camgen_cams::machine::Machine;
use camgen_kernel::profile::{Curves, extremes};

fn cam(name: &str, overrides: &[&str]) -> RotaryCam {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load(name, &overrides).expect("valid").0;
    rotary(&machine, machine.press().expect("a press").design_rpm).expect("a cam")
}

fn disc(name: &str, overrides: &[&str]) -> Disc {
    cam(name, overrides).disc
}

#[test]
fn the_reference_cams_have_the_reference_radii() {
    let dpi = disc("dpi", &["transition.kind=none"]);
    let prime = dpi.smallest_prime_radius().expect("a radius");
    assert!((prime - 0.098_98).abs() < 5e-6, "{prime}");
    assert_eq!(dpi.base_radius(), 0.069);
    assert!((dpi.max_lift() - 0.082_42).abs() < 5e-6);
    let dwell = prime + dpi.max_lift();
    assert!((dwell - 0.1814).abs() < 5e-5, "dwell at {dwell}");

    // At 5 at a pitch radius of 200 mm has 71.1° without transition; 30° needs 1015 mm.
    let paper = disc("dpi-paper", &["transition.kind=none", "cam.base_radius=170mm"]);
    let worst = extremes::pressure_angle(paper.curves());
    assert!((worst.value.to_degrees() - 71.1).abs() < 0.05, "{}", worst.value.to_degrees());
    let passing = paper.smallest_prime_radius().expect("a radius");
    assert!((passing - 1.015).abs() < 1e-3, "{passing}");
}

/// The solved radius is the smallest: it passes, and a hair less does not.
#[test]
fn the_solved_radius_is_the_smallest_that_passes() {
    for overrides in [
        vec![],
        vec!["follower.roller.offset=15mm"],
        vec!["follower.roller.offset=-15mm"],
        vec!["limits.pressure_angle=60deg"],
        vec!["limits.pressure_angle=60deg", "limits.min_convex_pitch_radius_over_roller=3"],
        vec!["buffer.column=return", "cam.lever=0.2", "limits.contact_stress=5000MPa"],
    ] {
        let cam = disc("dpi", &overrides);
        let prime = cam.smallest_prime_radius().expect("a radius");
        let limits = cam.machine().limits;
        let passes = |prime: f64| {
            let follower = cam.curves().follower.sized(prime).expect("in reach");
            let curves = Curves { motion: cam.curves().motion, follower: &*follower };
            let convex = limits.min_convex_pitch_radius_over_roller * curves.offset();
            extremes::pressure_angle(curves).value <= limits.pressure_angle.expect("a limit")
                && extremes::convex_curvature(curves).value * convex <= 1.0
        };
        assert!(passes(prime), "{overrides:?}");
        assert!(!passes(prime * (1.0 - 1e-9)), "{overrides:?}");
        assert!(passes(cam.prime_radius()), "{overrides:?}");
    }
}

#[test]
fn a_run_up_leaves_no_residual_and_a_blend_its_own() {
    let exact = cam("dpi", &[]);
    let inertia = exact.buffer.largest();
    assert!(exact.disc.residual_max().value < 1e-13 * inertia, "{:?}", exact.disc.residual_max());
    assert!((exact.buffer.residual_without_cam() / inertia - 0.150).abs() < 5e-4);
    let blend = cam("dpi", &["transition.kind=blend", "transition.width=30deg"]);
    let share = blend.disc.residual_max().value / blend.buffer.largest();
    assert!((share - 0.002_094_2).abs() < 1e-6, "{share}");
}

/// What a narrow blend leaves, on both sides of the start of the reversal, against a hundred thousand places of the blend: told
/// is at least as much, and no more than a scan that fine can miss.
#[test]
fn a_narrow_blend_is_told_to_rounding() {
    for width in [0.05_f64, 1.0, 30.0] {
        for column in ["return", "matched", "200 mm", "400 mm"] {
            for pressure in [1.2, 2.0, 5.0] {
                let blend = cam(
                    "dpi",
                    &[
                        "transition.kind=blend",
                        &format!("transition.width={width}deg"),
                        &format!("buffer.column={column}"),
                        &format!("buffer.end_pressure={pressure}at"),
                        "cam.base_radius=1500mm",
                    ],
                );
                let load = &blend.buffer;
                let half = 0.5 * width.to_radians();
                let left = |i: u32| {
                    let (piece, angle) = blend.disc.curves().motion.locate(half * f64::from(i) / 1e5);
                    load.residual(piece, angle, 0.0).abs()
                };
                let scan = (0..=100_000).map(left).fold(0.0, f64::max);
                let told = blend.disc.residual_max().value;
                let what = format!("{width}° {column} {pressure} at: {told} {scan}");
                // Between places the top rises by the square of 1e-5 of the blend; the rest is rounding of the inertia.
                let rounding = ROUNDING_OF_BALANCE * load.largest();
                let bounds = scan * (1.0 - 1e-9) - rounding..=scan * (1.0 + 1e-7) + rounding;
                assert!(bounds.contains(&told), "{what}");
            }
        }
    }
}

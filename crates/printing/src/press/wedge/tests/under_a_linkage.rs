//! The plate of a press whose bed a crank-slider moves.

use super::*;
use crate::press::bed_motion::{End, StrokeEnd};

/// The plate of the embedded press on a crank-slider, at an end of its stroke.
fn on_a_slider(end: End, overrides: &[&str]) -> (Wedge, StrokeEnd) {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load("dpi-crank-slider", &overrides).expect("valid").0.at_end(end).expect("two ends");
    let of = machine.press().expect("a press").stroke_end.expect("a linkage");
    (Wedge::solve(&machine, 35.0, ODE, ExactOn::Braking).expect("a plate"), of)
}

const ODE: Solver = Solver::Ode { tolerance: LAW_TOLERANCE };

/// Slope, second and third derivative by differences that are exact to the sixth, fifth and fourth order.
fn differences(f: impl Fn(f64) -> f64, at: f64, h: f64) -> [f64; 3] {
    let odd = |n: f64| f(at + n * h) - f(at - n * h);
    let even = |n: f64| f(at + n * h) + f(at - n * h) - 2.0 * f(at);
    [
        (45.0 * odd(1.0) - 9.0 * odd(2.0) + odd(3.0)) / (60.0 * h),
        (270.0 * even(1.0) - 27.0 * even(2.0) + 2.0 * even(3.0)) / (180.0 * h * h),
        (8.0 * odd(2.0) - 13.0 * odd(1.0) - odd(3.0)) / (8.0 * h * h * h),
    ]
}

/// Lift by the crank and the inertia of what moves with the roller, over run-up and reversal, against differences in the angle of the
/// crank with the bed as the linkage has it.
#[test]
fn a_linkage_moves_the_roller_in_its_own_time() {
    for end in [End::Outer, End::Inner] {
        let (plate, of) = on_a_slider(end, &["buffer.column=return", "follower.roller.mass=40 kg"]);
        let (massless, _) = on_a_slider(end, &["buffer.column=return"]);
        let law = |crank: f64| {
            let (piece, x) = plate.motion.locate(of.at(crank).x[0]);
            plate.motion.jet(piece, x).s
        };
        let psi = |crank: f64| libm::asin((law(crank) + plate.motion.lowest()) / plate.data.bottom_arm);
        let (half, mut seen) = (0.02, 0);
        for i in 0..60 {
            let crank = -0.34 + (of.dead() + 0.30) * f64::from(i) / 60.0;
            let (piece, x) = plate.motion.locate(of.at(crank).x[0]);
            let span = plate.motion.pieces()[piece];
            let breaks = [span.start, span.end];
            // Across a break there is no third derivative.
            if breaks.iter().any(|place| of.at(crank - half).x[0] < *place && of.at(crank + half).x[0] > *place) {
                continue;
            }
            seen += 1;
            let jet = plate.by_crank(x, plate.motion.jet(piece, x));
            let h = half / 3.0;
            for (got, want) in [jet.ds, jet.dds, jet.ddds].into_iter().zip(differences(law, crank, h)) {
                assert!((got - want).abs() < 2e-5, "{end:?} at {crank}: {got} is not {want}");
            }
            let pushed = plate.path_force(piece, x) - massless.path_force(piece, x);
            let [_, second, _] = differences(psi, crank, h);
            let want = 40.0 * plate.data.roller_arm * plate.crank_speed * plate.crank_speed * second;
            assert!((pushed - want).abs() < 0.01, "{end:?} at {crank}: {pushed} is not {want}");
        }
        assert!(seen > 40, "{seen}");
    }
}

#[test]
fn the_forces_balance_under_a_linkage() {
    for end in [End::Outer, End::Inner] {
        for column in ["buffer.column=matched", "buffer.column=return"] {
            let (plate, of) = on_a_slider(end, &[column]);
            let inertia = plate.inertia_max();
            let largest = 978.2 * plate.crank_speed * plate.crank_speed * of.largest_deceleration().value;
            assert!((inertia / largest - 1.0).abs() < 1e-12, "{inertia} {largest}");
            assert!(plate.residual_max(BedDirection::Braking).value < 1e-11 * inertia);
            let fixed = plate.residual_fixed_bottom();
            let left = |i: u32| {
                let x = plate.stroke() * f64::from(i) / 500.0;
                let row = plate.balance_row(x, plate.motion.bottom(plate.motion.locate(x).0, x).s);
                (row.inertia - row.air_fixed_bottom).abs()
            };
            let found = (0..=500).map(left).fold(0.0, f64::max);
            assert!(found <= fixed * (1.0 + 1e-12) && found > 0.999 * fixed, "{found} {fixed}");
        }
    }
}

#[test]
fn a_bed_with_two_decelerations_at_a_place_has_no_plate() {
    for (name, overrides, told) in [
        ("dpi-six-bar", vec![], "a six-bar"),
        ("dpi-crank-slider", vec!["linkage.offset_ratio=0.1".to_owned()], "an offset"),
    ] {
        for end in [End::Outer, End::Inner] {
            for exact_on in [ExactOn::Braking, ExactOn::Return, ExactOn::Mean] {
                let machine = Machine::load(name, &overrides).expect("valid").0.at_end(end).expect("two ends");
                let error = Wedge::solve(&machine, 35.0, ODE, exact_on).expect_err("refused");
                assert!(
                    error.what.contains("does not mirror its outward stroke") && error.what.contains(told),
                    "{error}"
                );
            }
        }
    }
}

use super::*;
use crate::body::Body as _;
use crate::linkage::{End, StrokeEnd};
use crate::motion::equation_18::Solver;

fn plate(overrides: &[&str]) -> Wedge {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load("dpi", &overrides).expect("valid").0;
    Wedge::solve(&machine, 35.0, Solver::Ode { tolerance: LAW_TOLERANCE }, ExactOn::Braking).expect("a plate")
}

/// The slope of the pitch curve is tan α of (21), and the pressure angle 90° − (θ − α).
#[test]
fn the_pitch_curve_has_the_slope_of_the_velocity_plan() {
    for overrides in [vec![], vec!["buffer.column=return", "translating.delta=75deg", "translating.bottom_arm=200mm"]] {
        let plate = plate(&overrides);
        let curves = plate.curves();
        for (piece, span) in curves.motion.pieces().iter().enumerate() {
            for i in 0..=20 {
                let x = span.start + (span.end - span.start) * f64::from(i) / 20.0;
                let bottom = plate.motion.bottom(piece, x);
                let alpha = plate.mechanism().slope_angle(bottom.s, bottom.ds);
                let contact = curves.contact(piece, x);
                let tangent = contact.curve.tangent;
                assert!((libm::atan2(-tangent.y, tangent.x) - alpha).abs() < 1e-14, "{x}");
                let theta = plate.data.delta + plate.mechanism().psi(bottom.s);
                let pressure = std::f64::consts::FRAC_PI_2 - (theta - alpha);
                assert!((contact.pressure_angle.abs() - pressure.abs()).abs() < 1e-14, "{x}");
            }
        }
    }
}

#[test]
fn the_plate_has_its_height() {
    for overrides in [vec![], vec!["buffer.column=return"], vec!["transition.kind=none"]] {
        let plate = plate(&overrides);
        let half = |piece: usize, x: f64| -plate.curves().profile(piece, x).point.y;
        let highest = largest(plate.curves(), half).value;
        assert!((2.0 * highest - 0.12).abs() < 1e-12 && plate.height == 0.12, "{highest}");
        assert!(plate.thinnest > 0.01 && plate.thinnest < 0.12, "{}", plate.thinnest);
    }
}

/// What the law leaves on the way it balances is rounding; an exact normal and no error of lift leave the same.
#[test]
fn the_forces_balance_while_the_bed_is_braked() {
    let plate = plate(&["buffer.column=return"]);
    assert!(plate.residual_max(Way::Braking).value < 1e-9 * plate.inertia_max());
    assert!(plate.residual_max(Way::Return).value > 0.01 * plate.inertia_max());
    for i in 1..=18 {
        let (piece, x) = plate.motion.locate(0.01 * f64::from(i));
        let normal = plate.curves().contact(piece, x).curve.outward();
        let left = plate.unbalanced(piece, x, 0.0, normal);
        assert!(left < 1e-8 * plate.inertia_max(), "{x}: {left}");
        let (bottom, slope) = (plate.motion.bottom(piece, x).s, plate.motion.bottom(piece, x).ds);
        // (16) from its own terms: m a = 2 p F + 2 R sin(α+ρ)/cos ρ.
        let alpha = plate.mechanism().slope_angle(bottom, slope);
        let rho = plate.data.friction_angle;
        let unit = plate.cylinder.unit_force();
        let wedge = 2.0 * plate.roller_force(piece, x, Way::Braking) * libm::sin(alpha + rho) / libm::cos(rho);
        let sides = plate.mechanism().load(x) * unit - (plate.mechanism().air(x, bottom) * unit + wedge);
        if slope != 0.0 {
            assert!(sides.abs() < 1e-9 * plate.inertia_max(), "{x}: {sides}");
        }
    }
}

/// Flanks beside the exact ones end on the ends of the plate, and a concave corner keeps its arc, however large the tolerance is
/// against the roller; before, the ends moved along the flank and counted as kinks.
#[test]
fn a_plate_on_either_side_of_a_wide_band_has_its_ends_and_no_kinks() {
    use crate::body::Request;
    use crate::pipeline::Spec;
    use crate::profile::outline::{Fit, Side};
    use crate::report::Verdict;
    let corner = ["buffer.column=return", "transition.kind=none"];
    for (side, tolerance, roller, overrides) in [
        (Side::Inside, 1e-3, "30mm", &[][..]),
        (Side::Inside, 1e-3, "0.4mm", &[]),
        (Side::Inside, 1e-3, "0.4mm", &corner),
        (Side::Inside, 0.31e-3, "2mm", &corner),
        (Side::Outside, 1e-3, "30mm", &[]),
        (Side::Outside, 1e-3, "0.4mm", &[]),
        (Side::Outside, 1e-3, "0.4mm", &corner),
        (Side::Outside, 0.7e-3, "0.07mm", &corner),
        (Side::Outside, 5e-6, "2um", &corner),
        (Side::Outside, 5e-6, "3um", &["buffer.column=return"]),
    ] {
        let name = format!("{side:?} {tolerance} {roller} {overrides:?}");
        let set: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let set = [set, vec![format!("translating.roller_radius={roller}")]].concat();
        let machine = Machine::load("dpi", &set).expect("valid").0;
        let spec = Spec::translating(machine, 35.0, Solver::Ode { tolerance: LAW_TOLERANCE }, ExactOn::Braking);
        let cam = spec.solve().expect("a plate");
        let proven =
            cam.draw(Request::within(Fit { side, ..Fit::from(tolerance) })).expect("drawn").prove().expect("proved");
        for check in ["tangency", "rolling", "ends"] {
            let found = proven.findings().iter().find(|f| f.check == check).expect("checked");
            assert_eq!(found.verdict, Verdict::Pass, "{name}: {found:?}");
        }
        // The corners of the two ends and nothing else.
        let outline = &proven.drawn().expect("drawn").parts[0].outline;
        let kinks = outline.contour.tangent_breaks().into_iter().filter(|turn| turn.abs() > 1e-9);
        assert_eq!(kinks.filter(|turn| *turn > 1.0).count(), 4, "{name}");
        assert!(outline.deviation <= 1e3 * tolerance, "{name}: {}", outline.deviation);
    }
}

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
            assert!(plate.residual_max(Way::Braking).value < 1e-11 * inertia);
            let fixed = plate.residual_fixed_bottom();
            let left = plate.rows(500).into_iter().filter_map(|row| row.balance);
            let found = left.map(|row| (row.inertia - row.air_fixed_bottom).abs()).fold(0.0, f64::max);
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
                assert!(matches!(error, WedgeError::Unsymmetric { .. }) && error.to_string().contains(told), "{error}");
            }
        }
    }
}

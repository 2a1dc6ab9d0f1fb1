use super::*;
use crate::press::SpecOfPress;
use crate::press::motion::equation_18::Solver;
use camgen_cams::body::LoadAsCut as _;

mod under_a_linkage;

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
    assert!(plate.residual_max(BedDirection::Braking).value < 1e-9 * plate.inertia_max());
    assert!(plate.residual_max(BedDirection::Return).value > 0.01 * plate.inertia_max());
    for i in 1..=18 {
        let (piece, x) = plate.motion.locate(0.01 * f64::from(i));
        let normal = plate.curves().contact(piece, x).curve.outward();
        let left = plate.unbalanced((piece, x), 0.0, normal);
        assert!(left < 1e-8 * plate.inertia_max(), "{x}: {left}");
        let (bottom, slope) = (plate.motion.bottom(piece, x).s, plate.motion.bottom(piece, x).ds);
        // (16) from its own terms: m a = 2 p F + 2 R sin(α+ρ)/cos ρ.
        let alpha = plate.mechanism().slope_angle(bottom, slope);
        let rho = plate.data.friction_angle;
        let unit = plate.cylinder.unit_force();
        let wedge = 2.0 * plate.roller_force(piece, x, BedDirection::Braking) * libm::sin(alpha + rho) / libm::cos(rho);
        let sides = plate.mechanism().load(x) * unit - (plate.mechanism().air(x, bottom) * unit + wedge);
        if slope != 0.0 {
            assert!(sides.abs() < 1e-9 * plate.inertia_max(), "{x}: {sides}");
        }
    }
}

/// Flanks offset from the exact ones end on the ends of the plate, and a concave corner keeps its arc, however large the tolerance is
/// against the roller; before, the ends moved along the flank and counted as kinks.
#[test]
fn a_plate_on_either_side_of_a_wide_band_has_its_ends_and_no_kinks() {
    use camgen_cams::body::Request;
    use camgen_cams::pipeline::Spec;
    use camgen_cams::report::Verdict;
    use camgen_kernel::profile::outline::{Fit, Side};
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

/// By 34-digit arithmetic, outside of the project: with friction the plate that levels both directions leaves half of what one that is exact while braking leaves on
/// the return; a longer column helps more.
#[test]
fn a_plate_that_levels_both_directions() {
    let solved = |sets: &[&str]| {
        let overrides: Vec<String> = sets.iter().map(|&text| text.to_owned()).collect();
        let machine = Machine::load("dpi", &overrides).expect("valid").0;
        let exact_on = crate::press::machine::exact_on(&machine);
        Wedge::solve(&machine, 35.0, Solver::Ode { tolerance: LAW_TOLERANCE }, exact_on).expect("a plate")
    };
    let left =
        |plate: &Wedge| [BedDirection::Braking, BedDirection::Return].map(|way| plate.residual_max(way).value.abs());
    let level = solved(&["translating.balance=level"]);
    for force in left(&level) {
        assert!((force / 3_389.722_094 - 1.0).abs() < 1e-9, "{force}");
    }
    let (x, displacement) = level.largest_displacement();
    assert!(x == 0.18 && (1e3 * displacement + 46.161_929).abs() < 1e-6, "{displacement} at {x}");
    for (column, braking, levelled) in [("matched", 6_260.7, 3_389.7), ("364.5 mm", 3_999.9, 2_062.7)] {
        let column = format!("buffer.column={column}");
        let [on_way_in, back] = left(&solved(&[&column]));
        assert!(on_way_in < 1e-3 && (back - braking).abs() < 0.06, "{column}: {on_way_in} {back}");
        let [on_way_in, back] = left(&solved(&[&column, "translating.balance=level"]));
        assert!((on_way_in - levelled).abs() < 0.06 && (back - levelled).abs() < 0.06, "{column}: {on_way_in} {back}");
    }
}

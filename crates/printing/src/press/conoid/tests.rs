use super::*;
use crate::press::SpecOfPress;
use crate::press::rotary;
use camgen_cams::body::surface::SpatialContact;
use nalgebra::Vector3;

fn conoid(speeds: &[f64], overrides: &[&str]) -> Conoid {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    Conoid::solve(&Machine::load("dpi", &overrides).expect("valid").0, speeds).expect("a conoid")
}

#[test]
fn equal_speeds_are_the_rotary_cam() {
    let disc = rotary::disc(&Machine::load("dpi", &[]).expect("valid").0, 35.0).expect("a cam");
    for speeds in [&[35.0][..], &[35.0, 35.0, 35.0]] {
        let prism = conoid(speeds, &[]);
        assert_eq!(prism.base_radius(), disc.base_radius());
        for (piece, span) in disc.curves().motion.pieces().iter().enumerate() {
            for i in 0..=12 {
                let angle = span.start + (span.end - span.start) * f64::from(i) / 12.0;
                let (cut, zeta) = prism.cut(piece, angle, 0.05).expect("smooth");
                let exact = disc.curves().profile(piece, angle);
                assert!((cut.point - exact.point).norm() < 1e-15 && (zeta - 0.05).abs() < 1e-15);
                assert!((cut.curvature / exact.curvature - 1.0).abs() < 1e-12);
                let slope = (cut.curvature_slope - exact.curvature_slope).abs();
                assert!(slope < 1e-9 * (1.0 + exact.curvature_slope.abs()), "{cut:?} {exact:?}");
                let (sharp, blunt) = prism.principal_curvatures(piece, angle, 0.05);
                let plane = disc.curves().contact(piece, angle).curve.curvature;
                assert!((sharp - plane.max(0.0)).abs() < 1e-11 && (blunt - plane.min(0.0)).abs() < 1e-11);
            }
        }
    }
}

/// Two speeds: straight lines along the axis, so that the lift is known everywhere.
#[test]
fn two_speeds_are_a_ruled_surface() {
    let pair = conoid(&[20.0, 35.0], &["conoid.mode=fixed"]);
    for i in 0..=36 {
        let (piece, angle) = pair.slice(0.0).locate(f64::from(10 * i).to_radians());
        let [slow, fast] = [0, 1].map(|j| pair.sections[j].bottom(piece, angle).s - pair.lowest());
        for share in [0.0, 0.3, 1.0] {
            let z = 0.12 * share;
            let lift = pair.lift(piece, angle, z);
            assert!((lift[0][0] - (slow + (fast - slow) * share)).abs() < 1e-15);
            assert!((lift[0][1] - (fast - slow) / 0.12).abs() < 1e-14 && lift[0][2].abs() < 1e-12);
            let contact = pair.contact(piece, angle, z);
            assert!(((contact.point - contact.centre).norm() - 0.03).abs() < 1e-16);
        }
    }
}

/// A cut is where the spheres touch it, has the derivatives it says it has, and lies across the normal.
#[test]
fn a_cut_has_its_derivatives() {
    let h = 1e-4;
    for overrides in [vec![], vec!["follower.roller.offset=20mm", "conoid.shift=square", "conoid.axial_travel=60mm"]] {
        let cam = conoid(&[20.0, 25.0, 30.0, 35.0], &overrides);
        for (piece, span) in cam.pieces().iter().enumerate() {
            for i in 1..12 {
                let angle = span.start + (span.end - span.start) * f64::from(i) / 12.0;
                for z in [0.0, 0.013, 0.033, 0.06] {
                    let cut = |n: f64| cam.cut(piece, angle + n * h, z).expect("smooth").0;
                    let (here, zeta) = cam.cut(piece, angle, z).expect("smooth");
                    let contact = cam.contact(piece, angle, zeta);
                    assert!((contact.point.z - z).abs() < 1e-15);
                    assert!((contact.point.xy() - here.point).norm() < 1e-15);
                    assert!(here.tangent.dot(&contact.normal.xy()).abs() < 1e-14);
                    let first =
                        ((cut(1.0).point - cut(-1.0).point) * 8.0 - (cut(2.0).point - cut(-2.0).point)) / (12.0 * h);
                    assert!((first - here.tangent * here.speed).norm() < 1e-10, "{angle} {z}: {first} {here:?}");
                    let turn = |n: f64| here.tangent.perp(&cut(n).tangent);
                    let bend = (8.0 * (turn(1.0) - turn(-1.0)) - (turn(2.0) - turn(-2.0))) / (12.0 * h * here.speed);
                    assert!((bend - here.curvature).abs() < 1e-8, "{angle} {z}: {bend} {here:?}");
                    let k = |n: f64| cut(n).curvature;
                    let slope = (8.0 * (k(1.0) - k(-1.0)) - (k(2.0) - k(-2.0))) / (12.0 * h * here.speed);
                    assert!((slope - here.curvature_slope).abs() < 1e-5 * (1.0 + slope.abs()), "{slope} {here:?}");
                }
            }
        }
    }
}

/// Principal curvatures against the turn of the normal along the surface, by central differences.
#[test]
fn principal_curvatures_belong_to_the_surface() {
    let cam = conoid(&[20.0, 25.0, 30.0, 35.0], &["conoid.axial_travel=40mm"]);
    let h = 1e-5;
    for degrees in [5.0_f64, 60.0, 88.0, 130.0] {
        let (piece, angle) = cam.slice(0.0).locate(degrees.to_radians());
        let z = 0.017;
        let at = |a: f64, b: f64| cam.contact(piece, angle + a * h, z + b * h);
        let by = |f: fn(&SpatialContact) -> Vector3<f64>| {
            [(f(&at(1.0, 0.0)) - f(&at(-1.0, 0.0))) / (2.0 * h), (f(&at(0.0, 1.0)) - f(&at(0.0, -1.0))) / (2.0 * h)]
        };
        let ([pu, pv], [nu, nv]) = (by(|c| c.centre), by(|c| c.normal));
        let first = nalgebra::Matrix2::new(pu.dot(&pu), pu.dot(&pv), pu.dot(&pv), pv.dot(&pv));
        let second = nalgebra::Matrix2::new(pu.dot(&nu), pu.dot(&nv), pv.dot(&nu), pv.dot(&nv));
        let shape = first.try_inverse().expect("regular") * second;
        let (mean, gauss) = (0.5 * shape.trace(), shape.determinant());
        let apart = (mean * mean - gauss).sqrt();
        let (sharp, blunt) = cam.principal_curvatures(piece, angle, z);
        assert!(
            (sharp - mean - apart).abs() < 1e-5 && (blunt - mean + apart).abs() < 1e-5,
            "{degrees}: {sharp} {mean} {apart}"
        );
    }
}

#[test]
fn the_adjusted_sections_end_where_the_design_does() {
    let cam = conoid(&[20.0, 25.0, 30.0, 35.0], &[]);
    for (section, slope) in cam.sections.iter().zip([0.694, 0.779, 0.881, 1.0]) {
        let end = section.law().bottom_law.displacement(0.5 * std::f64::consts::PI);
        assert!((end + 0.082_42).abs() < 5e-6, "{end}");
        assert!((section.law().bottom_law.start_slope() + 1.0 - slope).abs() < 5e-4);
    }
    let fixed = conoid(&[20.0, 25.0, 30.0, 35.0], &["conoid.mode=fixed"]);
    for (section, slope) in fixed.sections.iter().zip([0.327, 0.510, 0.735, 1.0]) {
        assert!((section.law().bottom_law.start_slope() + 1.0 - slope).abs() < 5e-4);
    }
}

/// Wherever the roller stands it touches the flank and not its edge, and a whole millimetre less would not do.
#[test]
fn the_contact_stays_on_the_flank() {
    for (speeds, overrides, expected) in [
        (&[20.0, 25.0, 30.0, 35.0][..], &[][..], Some(0.003)),
        (&[35.0], &[], Some(0.0)),
        (&[20.0, 35.0], &["conoid.mode=fixed", "conoid.axial_travel=40mm"], None),
        (&[20.0, 27.0, 35.0], &["conoid.shift=square", "follower.roller.offset=20mm", "cam.base_radius=150mm"], None),
        (&[10.0, 20.0, 35.0, 45.0], &["conoid.axial_travel=60mm", "transition.kind=blend"], None),
    ] {
        let cam = conoid(speeds, overrides);
        let (low, high) = cam.ends();
        let mut beyond = f64::NEG_INFINITY;
        for (piece, span) in cam.pieces().iter().enumerate() {
            for i in 0..=2000 {
                let angle = span.start + (span.end - span.start) * f64::from(i) / 2000.0;
                for z in [0.0, cam.data.axial_travel] {
                    let touching = cam.contact(piece, angle, z).point.z;
                    assert!((low..=high).contains(&touching), "{overrides:?}: {touching} at {angle}");
                    beyond = beyond.max(touching - cam.data.axial_travel).max(-touching);
                }
            }
        }
        assert!(cam.overhang() < beyond.max(0.0) + 1.001e-3, "{overrides:?}: {} for {beyond}", cam.overhang());
        assert!(expected.is_none_or(|expected| cam.overhang() == expected), "{}", cam.overhang());
        // What is reported is the largest there is: a dense grid finds nothing above it, and hardly less.
        let above = cam.reach().value - beyond;
        assert!((-1e-15..1e-5 * beyond.abs().max(1e-3)).contains(&above), "{:?} {beyond}", cam.reach());
    }
}

/// Speeds far apart: splines in the axial position leave 1815 N, straight strips 1626 N, splines in the speed less than
/// either; and the named speeds keep the limit when they are applied.
#[test]
fn no_surface_is_worse_than_straight_strips() {
    let speeds = [5.0, 10.0, 20.0, 40.0, 80.0];
    let machine = Machine::load("dpi", &[]).expect("valid").0;
    let by_place = Conoid::unsized_of(&machine, &speeds).expect("a conoid");
    assert!(by_place.is_worse_than_strips() && by_place.residual_between().force > 1800.0);
    let cam = conoid(&speeds, &[]);
    assert!(cam.interpolates_speed() && cam.residual_between().force < 0.5 * cam.residual_of_strips().force);
    assert!(cam.smallest_prime_radius.is_some());
    for limit in [200.0, 20.0] {
        let named = cam.speeds_within(limit).expect("speeds");
        assert!(conoid(&named, &[]).residual_between().force <= limit, "{named:?}");
    }
}

/// The weights of splines in the speed have the derivatives they say they have, also beyond the ends.
#[test]
fn weights_in_the_speed_have_their_derivatives() {
    let cam = conoid(&[5.0, 10.0, 20.0, 40.0, 80.0], &[]);
    let h = 1e-5;
    for z in [-0.007, 0.003, 0.019, 0.1, 0.127] {
        let (before, here, after) = (cam.weights_at(z - h), cam.weights_at(z), cam.weights_at(z + h));
        for ((before, here), after) in before.iter().zip(&here).zip(&after) {
            for order in 0..3 {
                let slope = (after[order] - before[order]) / (2.0 * h);
                // Central differences miss by h²/6 of the derivative three orders up, which grows by 1/(4 mm) an order.
                assert!((slope - here[order + 1]).abs() < 1e-4 * (1.0 + here[order + 1].abs()), "{z} {order}");
            }
        }
    }
}

/// The law from strip to strip is the sum of all laws with their weights, but for the roundings of that sum; also where the slopes come
/// from series, which miss theirs by 1e-15 of the largest derivative, times 4/27 of a strip.
#[test]
fn strips_are_the_sum_of_all_sections() {
    let many: Vec<f64> = (0..30).map(|i| 20.0 + 0.5 * f64::from(i)).collect();
    let cases: [(&[f64], &[&str]); 5] = [
        (&many, &[]),
        (&many, &["conoid.mode=fixed", "conoid.shift=square"]),
        (&many[..12], &["transition.kind=blend"]),
        (&[5.0, 10.0, 20.0, 40.0, 80.0], &[]),
        (&[30.0, 35.0], &[]),
    ];
    for (speeds, overrides) in cases {
        let cam = conoid(speeds, overrides);
        let ((low, high), strip) = (cam.ends(), cam.positions[1] - cam.positions[0]);
        for (piece, span) in cam.pieces().iter().enumerate() {
            for angle in (0..=16).map(|i| span.start + (span.end - span.start) * f64::from(i) / 16.0) {
                let lift = |section: &Reversal| {
                    let jet = section.bottom(piece, angle);
                    [jet.s - cam.lowest(), jet.ds, jet.dds, jet.ddds]
                };
                let lifts: Vec<[f64; 4]> = cam.sections.iter().map(lift).collect();
                for z in (0..=37).map(|j| low + (high - low) * f64::from(j) / 37.0) {
                    let weights = cam.weights_at(z);
                    let near = cam.lift_of(&cam.lifts(piece, angle), z);
                    let all = cam.lift_of(&cam.all_lifts(piece, angle), z);
                    for (m, n) in (0..16).map(|index| (index / 4, index % 4)) {
                        let sum: f64 = lifts.iter().zip(&weights).map(|(lift, weight)| lift[m] * weight[n]).sum();
                        let sizes: f64 = weights.iter().map(|weight| weight[n].abs()).sum();
                        // What cancels in straight strips leaves the roundings of the lift over powers of their width.
                        let of_strip = strip.powi(-i32::try_from(n).expect("small"));
                        let rounding = 1e-14 * sizes.max(of_strip) * LARGEST[m];
                        let missed = [near[m][n] - sum, all[m][n] - sum];
                        assert!(
                            missed.iter().all(|missed| missed.abs() <= rounding),
                            "{m} {n} {missed:?} {rounding:e}"
                        );
                    }
                }
            }
        }
    }
}

/// Sizes that the lift of this press and its derivatives reach, m.
const LARGEST: [f64; 4] = [0.1, 0.3, 0.5, 5.0];

/// A heavier forme in thin air at another speed is the section of its v: by the gas law itself, with the air of that press.
#[test]
fn one_place_along_the_axis_for_speed_forme_and_weather() {
    let cam = conoid(&[20.0, 25.0, 30.0, 35.0], &["conoid.shift=v"]);
    let square = conoid(&[20.0, 25.0, 30.0, 35.0], &["conoid.shift=square"]);
    assert_eq!(cam.positions, square.positions);
    for (section, rpm) in cam.sections.iter().zip([20.0_f64, 25.0, 30.0, 35.0]) {
        let law = section.law().bottom_law;
        for (mass, ambient) in [(1.0, 1.0), (1.2, 1.0), (0.9, 0.93), (1.1, 1.05)] {
            // The speed at which this forme in this weather has the v of the section.
            let n = rpm * libm::sqrt(ambient / mass);
            let p0 = ambient * cam.press.ambient_pressure;
            let omega = cam.press.bed.crank_speed(n);
            for degrees in [5.0_f64, 30.0, 60.0, 90.0] {
                let x = 0.18 * libm::sin(degrees.to_radians());
                let inertia = mass * cam.press.bed.mass * omega * omega * x;
                let bottom = law.displacement(degrees.to_radians());
                let air = p0 * (libm::pow(law.column() / (law.column() - x - bottom), 1.35) - 1.0);
                let left = inertia - 2.0 * cam.cylinder.piston_area * air;
                assert!(left.abs() < 1e-9 * inertia, "{rpm} rpm, {mass}, {ambient}: {left} of {inertia}");
            }
        }
    }
    let told = wheel::section(&cam).expect("a wheel");
    let (first, last) = (&told.value["settings"][0], &told.value["settings"][12]);
    assert_eq!((first["z_mm"].as_f64(), last["z_mm"].as_f64()), (Some(0.0), Some(120.0)));
    assert!((first["v"].as_f64().expect("v") - 16.0 / 49.0).abs() < 1e-15);
    assert!((last["mass_kg"].as_f64().expect("a mass") - 978.2).abs() < 1e-9);
    assert!(wheel::section(&square).is_none());
}

/// A sphere touches in a point: the pressure of the default conoid would be the end of a line contact, and is a warning here.
#[test]
fn the_life_of_a_point_contact_is_a_warning() {
    let sets = ["cam.hardness=600".to_owned()];
    let machine = Machine::load("dpi", &sets).expect("valid").0;
    let spec = camgen_cams::Spec::conoid(machine, vec![20.0, 25.0, 30.0, 35.0], None);
    let proven = spec.solve().and_then(|cam| cam.draw(50e-6)?.prove()).expect("proven");
    let found = proven.findings().iter().find(|found| found.check == "contact_life").expect("a check");
    assert_eq!(found.verdict, camgen_cams::report::Verdict::Warn);
    assert!((found.value - 4.18).abs() < 0.01, "{found:?}");
}

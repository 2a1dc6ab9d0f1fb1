//! What the core makes of a motion with a piece on which no follower runs: the disc of a brake.

mod followed;

use super::BrakeDisc;
use super::disc_motion::tests::disc;
use camgen_cams::body::{RateTolerance, Request};
use camgen_cams::pipeline::Spec;
use camgen_cams::report::{Finding, Verdict, passed};
use camgen_kernel::follower::{Follower, TranslatingRoller};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::points::{Interpolant, MotionErrors, PointCoordinates, PointInterpolation};
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::interpolated::FollowerOnTable;
use camgen_kernel::profile::size::{CLOSING_OVER_ROLLER, SizeLimits, smallest};
use camgen_kernel::profile::{Curves, extremes};

#[test]
fn nothing_is_felt_where_no_follower_runs() {
    let (motion, follower) = (disc(), TranslatingRoller::new(0.05, 0.0, 0.01));
    let curves = Curves { motion: &motion, follower: &follower };
    let row = |i: u32| {
        let (piece, angle) = motion.locate(f64::from(i).to_radians());
        let point = curves.touch(piece, angle).curve.point * MILLIMETRES;
        [point.x, point.y]
    };
    let rows: Vec<[f64; 2]> = (0..=360).map(row).collect();
    let curve = Interpolant::new(&rows, PointCoordinates::Plane, PointInterpolation::Cubic, true);
    let felt = FollowerOnTable::new(curves, 0.0).errors(&curve, [true; 2], [f64::INFINITY; 2]);
    let working = motion.pieces()[0].end.to_degrees();
    for (degrees, errors) in felt.iter().enumerate() {
        let degrees = f64::from(u32::try_from(degrees).expect("few"));
        let rolled = degrees < working;
        assert!(errors.iter().all(|error| error.is_finite() && (*error > 0.0) == rolled), "{degrees}: {errors:?}");
    }
}

/// The disc of a brake, and a centred roller on the smallest one that keeps a pressure angle.
fn rolled(roller: f64, pressure_angle: f64) -> (BrakeDisc, TranslatingRoller) {
    let motion = disc();
    let required = SizeLimits { pressure_angles: [pressure_angle; 2], convex_radius: roller, least: 1e-3 + roller };
    let follower = TranslatingRoller::new(0.1, 0.0, roller);
    let prime_radius = smallest(&motion, &follower, &required).expect("a radius").prime_radius;
    (motion, TranslatingRoller::new(prime_radius, 0.0, roller))
}

/// max(|y'|/tan 30° − y) of the law, counted from its own zero, which lies above the lowest point of the disc.
#[test]
fn where_no_follower_runs_the_pressure_angle_may_be_larger() {
    let limit = 30.0_f64.to_radians();
    let (motion, follower) = rolled(1e-3, limit);
    let prime_radius = follower.prime_radius().expect("sized") - motion.origin().expect("an origin");
    assert!((1e3 * prime_radius - 44.327_659_755_76).abs() < 1e-9, "{prime_radius}");
    let curves = Curves { motion: &motion, follower: &follower };
    let [working, closing] = [0, 1].map(|index| {
        let piece = motion.pieces()[index];
        let lean = |i: u32| {
            let at = piece.start + (piece.end - piece.start) * f64::from(i) / 1000.0;
            curves.contact(index, at).pressure_angle.abs()
        };
        (0..=1000).map(lean).fold(0.0, f64::max)
    });
    assert!(working <= limit * (1.0 + 1e-12) && closing > 1.5 * limit, "{working} {closing}");
}

/// Under a large roller the closing stretch is the sharper one; a convex radius of twice that of the roller is not asked of it.
#[test]
fn where_no_follower_runs_there_is_no_undercut_and_no_more_is_asked() {
    let roller = 0.08;
    let (motion, follower) = rolled(roller, 80.0_f64.to_radians());
    let curves = Curves { motion: &motion, follower: &follower };
    let radius = |piece: usize| 1.0 / extremes::convex_curvature_on(curves, |own| own == piece).value;
    assert!((radius(1) / (CLOSING_OVER_ROLLER * roller) - 1.0).abs() < 1e-12, "{}", radius(1));
    assert!(radius(0) > roller, "{}", radius(0));

    let required =
        SizeLimits { pressure_angles: [80.0_f64.to_radians(); 2], convex_radius: 2.0 * roller, least: roller };
    let prime_radius = smallest(&motion, &follower, &required).expect("a radius").prime_radius;
    let follower = TranslatingRoller::new(prime_radius, 0.0, roller);
    let curves = Curves { motion: &motion, follower: &follower };
    let radius = |piece: usize| 1.0 / extremes::convex_curvature_on(curves, |own| own == piece).value;
    assert!((radius(0) / (2.0 * roller) - 1.0).abs() < 1e-12, "{}", radius(0));
    assert!(radius(1) < 1.9 * roller, "{}", radius(1));
}

/// The disc of a brake turns less than a turn to and fro, and a quintic on which no roller runs closes it.
fn findings(keys: &[(&str, &str)]) -> Vec<Finding> {
    let builder = keys.iter().fold(Spec::builder("brake"), |builder, (key, value)| builder.set(key, value));
    let spec = builder.motion(disc()).expect("in range");
    let cam = spec.solve().expect("a cam");
    let request = Request { rates: [None, Some(RateTolerance::Share(0.05))], ..Request::within(5e-6) };
    cam.draw(request).expect("drawn").prove().expect("proved").findings().to_vec()
}

/// Its pressure angle is 49° where no roller runs, and its lift by far the quickest.
#[test]
fn where_no_follower_runs_only_the_outline_is_checked() {
    let radius = ("follower.roller.radius", "10 mm");
    for rotation in ["cw", "ccw"] {
        let findings = findings(&[radius, ("cam.rotation", rotation)]);
        assert!(passed(&findings), "{findings:?}");
        assert!(of(&findings, "pressure_angle").value > 29.0, "{findings:?}");
        for check in ["tangency", "outline", "rolling", "undercut", "min_convex_radius", "acceleration"] {
            assert_eq!(of(&findings, check).verdict, Verdict::Pass, "{check}: {findings:?}");
        }
    }
}

#[test]
fn an_undercut_is_found_where_no_follower_runs() {
    let large = [
        ("follower.roller.radius", "80 mm"),
        ("cam.base_radius", "20 mm"),
        ("limits.min_convex_pitch_radius_over_roller", "1"),
        ("limits.pressure_angle", "80 deg"),
    ];
    let findings = findings(&large);
    let undercut = of(&findings, "undercut");
    assert_eq!(undercut.verdict, Verdict::Fail, "{findings:?}");
    let closing = disc().holding().total_angle().to_degrees();
    assert!(undercut.place.cam_deg.is_some_and(|degrees| degrees > closing + 10.0), "{undercut:?}");
    assert_eq!(of(&findings, "min_convex_radius").verdict, Verdict::Pass, "{findings:?}");
}

fn of<'f>(findings: &'f [Finding], check: &str) -> &'f Finding {
    findings.iter().find(|finding| finding.check == check).unwrap_or_else(|| panic!("no {check}"))
}

//! The contract of every follower, and goldens: computed with 40 digits by numerical differentiation of one point or line, by another
//! program.

use super::*;
use crate::motion::Motion;
use crate::motion::laws::named;
use crate::motion::program::Program;
use crate::profile::Curves;
use std::f64::consts::TAU;

/// Every follower that camgen has: the contract below walks this list.
fn followers() -> Vec<Box<dyn Follower>> {
    let crank = BellCrank {
        roller_arm: 0.3,
        bottom_arm: 0.2,
        delta: 1.3,
        lowest: -0.05,
        axis_distance: 0.06,
        roller_radius: 0.02,
    };
    vec![
        Box::new(TranslatingRoller::new(0.1, 0.0, 0.02)),
        Box::new(TranslatingRoller::new(0.1, -0.03, 0.02)),
        Box::new(crank),
        FlatFace::new(1.0).sized(0.15).expect("any size"),
        FlatFace::tilted(1.0, 0.3, 0.01).sized(0.15).expect("any size"),
        Box::new(TranslatingRoller::new(0.1, 0.02, 0.0)),
        SwingingRoller::new(0.11, 0.14, 0.016, 1.0).sized(0.08).expect("in reach"),
        SwingingRoller::new(0.11, 0.14, 0.016, -1.0).sized(0.08).expect("in reach"),
        SwingingFlat::new(0.3, 0.03, 1.0).sized(0.1).expect("in reach"),
        SwingingFlat::new(0.3, -0.02, -1.0).sized(0.1).expect("in reach"),
    ]
}

/// A follower that claims to be symmetric gives the mirrored curve for the mirrored motion; of the others some do not.
#[test]
fn a_symmetric_follower_has_a_mirror() {
    let lift = Jet { s: 0.013, ds: 0.021, dds: -0.034, ddds: 0.055 };
    let differs = |follower: &dyn Follower| {
        let (there, back) = (follower.touch(0.7, &lift).curve, follower.touch(-0.7, &lift.mirrored()).curve);
        let pairs = [
            (there.point - Vector2::new(back.point.x, -back.point.y)).norm(),
            (there.tangent + Vector2::new(back.tangent.x, -back.tangent.y)).norm(),
            (there.speed - back.speed).abs(),
            (there.curvature - back.curvature).abs(),
            (there.curvature_slope + back.curvature_slope).abs(),
        ];
        pairs.into_iter().fold(0.0, f64::max)
    };
    let symmetric = followers().into_iter().filter(|follower| follower.is_symmetric());
    let differences: Vec<f64> = symmetric.map(|follower| differs(follower.as_ref())).collect();
    assert!(differences.len() == 2 && differences.iter().all(|off| *off < 1e-11), "{differences:?}");
    let others = followers().into_iter().filter(|follower| !follower.is_symmetric());
    assert!(others.map(|follower| differs(follower.as_ref())).fold(0.0, f64::max) > 1e-3);
}

/// Tangent, curvature and slope of the curvature against central differences of the points, and the inverse.
#[test]
fn a_curve_point_belongs_to_its_curve() {
    let lift = |angle: f64| Jet {
        s: 0.02 * (1.0 + libm::sin(2.0 * angle)),
        ds: 0.04 * libm::cos(2.0 * angle),
        dds: -0.08 * libm::sin(2.0 * angle),
        ddds: -0.16 * libm::cos(2.0 * angle),
    };
    let h = 1e-3;
    for follower in followers() {
        for i in 0..60 {
            let angle = 0.1 * f64::from(i);
            let at = |n: f64| follower.touch(angle + n * h, &lift(angle + n * h));
            let difference = |f: &dyn Fn(&Touch) -> Vector2<f64>| {
                ((f(&at(1.0)) - f(&at(-1.0))) * 8.0 - (f(&at(2.0)) - f(&at(-2.0)))) / (12.0 * h)
            };
            let here = at(0.0);
            let curve = here.curve;
            assert!((curve.tangent * curve.speed - difference(&|t| t.curve.point)).norm() < 1e-10, "{follower:?}");
            let turn = difference(&|t| t.curve.tangent);
            assert!((curve.tangent.perp(&turn) - curve.curvature * curve.speed).abs() < 1e-9, "{follower:?}");
            let bend = difference(&|t| Vector2::new(t.curve.curvature, 0.0)).x;
            assert!((bend - curve.curvature_slope * curve.speed).abs() < 1e-7 * (1.0 + bend.abs()), "{follower:?}");
            let back = follower.parameter_of(curve.point, curve.outward()) - angle;
            assert!((back - (back / TAU).round() * TAU).abs() < 1e-14, "{follower:?}: {back}");
            let turn = difference(&|t| t.drive);
            assert!((here.drive.perp(&turn) - here.drive_turn).abs() < 1e-11, "{follower:?}");
        }
    }
}

/// A follower made for another size has that size and the same element.
#[test]
fn a_follower_is_made_for_a_size() {
    for follower in followers() {
        let Some(prime) = follower.prime_radius() else { continue };
        let larger = follower.sized(2.0 * prime).expect("larger is always in reach");
        assert_eq!(larger.prime_radius(), Some(2.0 * prime));
        assert_eq!(larger.element(), follower.element());
        assert!((larger.touch(0.3, &Jet::default()).curve.point.norm() - 2.0 * prime).abs() < 1e-15);
    }
    assert!(TranslatingRoller::new(0.1, 0.05, 0.02).sized(0.04).is_none(), "the roller misses the cam");
}

/// Up by the modified sine in 120°, at rest for 30°, down by 3-4-5 in 150°, at rest for 60°.
fn up_and_down(quantity: Quantity, top: f64) -> Program {
    let segments =
        [(named("modified-sine"), 120.0, top), (None, 30.0, top), (named("3-4-5"), 150.0, 0.0), (None, 60.0, 0.0)];
    Program::new(quantity, 0.0, &segments.map(|(law, over, to): (_, f64, f64)| (law, over.to_radians(), to)))
        .expect("a program")
}

fn lifting() -> Program {
    up_and_down(Quantity::Length, 0.03)
}

fn swinging(degrees: f64) -> Program {
    up_and_down(Quantity::Angle, degrees.to_radians())
}

/// At a cam angle in degrees: point of the follower's curve and of the profile, mm, pressure angle, degrees, and radius of curvature of
/// the follower's curve, mm.
fn found(motion: &dyn Motion, follower: &dyn Follower, degrees: f64) -> [f64; 6] {
    let curves = Curves { motion, follower };
    let (piece, angle) = motion.locate(degrees.to_radians());
    let (contact, profile) = (curves.contact(piece, angle), curves.profile(piece, angle));
    let (curve, profile) = (contact.curve.point * 1e3, profile.point * 1e3);
    let radius = 1e3 / contact.curve.curvature;
    [curve.x, curve.y, profile.x, profile.y, contact.pressure_angle.to_degrees(), radius]
}

fn are(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 3e-12 * (1.0 + expected.abs()), "{found} {expected}");
    }
}

#[test]
fn a_translating_roller_is_where_it_was_computed() {
    let (motion, roller) = (lifting(), TranslatingRoller::new(0.07, 0.012, 0.015));
    let at_50 = [
        41.993_507_854_746_99,
        68.714_599_773_852_85,
        30.739_243_155_658_68,
        58.797_870_167_634_14,
        8.615_011_986_549_948,
        90.901_056_241_369_35,
    ];
    are(&found(&motion, &roller, 50.0), &at_50);
    let at_230 = [
        -43.576_669_884_973_78,
        -70.601_338_811_034_37,
        -38.960_396_518_116_96,
        -56.329_337_542_731_17,
        -22.076_218_952_039_9,
        84.793_657_019_562_36,
    ];
    are(&found(&motion, &roller, 230.0), &at_230);
}

#[test]
fn a_swinging_roller_is_where_it_was_computed() {
    let motion = swinging(20.0);
    let of_side = |side: f64| SwingingRoller::new(0.11, 0.14, 0.016, side).sized(0.08).expect("in reach");
    let trailing = [
        97.781_301_184_517_65,
        44.059_380_756_133_53,
        82.022_122_709_903_49,
        41.293_825_874_150_99,
        24.068_852_314_687_92,
        87.694_178_715_655_87,
    ];
    are(&found(&motion, &*of_side(1.0), 75.0), &trailing);
    let leading = [
        -7.182_799_046_242_997,
        -103.626_121_976_129_2,
        -9.888_444_372_619_773,
        -87.856_547_366_525_53,
        -21.978_132_399_867_23,
        92.124_351_257_734_28,
    ];
    are(&found(&motion, &*of_side(-1.0), 215.0), &leading);
}

#[test]
fn a_flat_face_is_where_it_was_computed_square_and_tilted() {
    let motion = lifting();
    let of_tilt = |degrees: f64| {
        let [.., x, y, alpha, radius] = found(&motion, &FlatFace::tilted(0.06, degrees.to_radians(), 0.0), 50.0);
        [x, y, alpha, radius]
    };
    are(&of_tilt(0.0), &[26.989_809_529_931_04, 69.602_841_690_508_89, 0.0, 83.598_235_767_284_7]);
    are(&of_tilt(10.0), &[14.728_947_655_015_13, 72.909_000_778_204_42, -10.0, 83.239_725_541_031_97]);
}

#[test]
fn a_swinging_face_is_where_it_was_computed() {
    let motion = swinging(12.0);
    let at = |face_offset: f64, side: f64, degrees: f64| {
        let face = SwingingFlat::new(0.15, face_offset, side).sized(0.05).expect("in reach");
        let (piece, angle) = motion.locate(degrees.to_radians());
        let lever = face.on_face(&motion.jet(piece, angle)).expect("a face").place;
        let [.., x, y, alpha, radius] = found(&motion, &*face, degrees);
        [x, y, radius, 1e3 * lever, alpha]
    };
    let trailing = [
        60.324_486_921_784_97,
        41.822_198_095_016_13,
        55.971_948_672_315_98,
        111.020_364_480_945_3,
        -4.121_544_264_176_188,
    ];
    are(&at(0.008, 1.0, 80.0), &trailing);
    let leading = [
        -4.563_653_147_721_173,
        -70.295_849_536_474_63,
        61.842_792_293_363_05,
        119.200_766_735_255_3,
        -2.881_565_225_022_397,
    ];
    are(&at(-0.006, -1.0, 215.0), &leading);
}

#[test]
fn a_knife_edge_is_where_it_was_computed() {
    let [x, y, profile_x, profile_y, alpha, radius] = found(&lifting(), &TranslatingRoller::new(0.04, 0.0, 0.0), 100.0);
    are(&[x, y], &[profile_x, profile_y]);
    let expected = [-11.930_860_889_067_39, 67.663_274_452_555_85, 7.940_699_950_371_053, 44.737_763_306_118_32];
    are(&[x, y, alpha, radius], &expected);
}

/// Under s = e (1 − cos θ) the face has p = R_b + e cos δ − e cos δ cos(β − δ): that of a circle about −e cos δ (cos δ, sin δ).
#[test]
fn a_harmonic_lift_under_a_face_is_an_exact_circle() {
    let (eccentricity, base) = (0.012, 0.04);
    for tilt in [0.0, 0.3, -0.5] {
        let (face, cos) = (FlatFace::tilted(base, tilt, 0.005), libm::cos(tilt));
        let centre = Vector2::new(cos, libm::sin(tilt)) * (-eccentricity * cos);
        for i in 0..72 {
            let angle = f64::from(5 * i).to_radians();
            let (sin, cosine) = (eccentricity * libm::sin(angle), eccentricity * libm::cos(angle));
            let lift = Jet { s: eccentricity - cosine, ds: sin, dds: cosine, ddds: -sin };
            let curve = face.touch(angle, &lift).curve;
            let radius = base + eccentricity * cos;
            assert!(((curve.point - centre).norm() - radius).abs() < 3e-17, "{tilt} {angle}");
            assert!((curve.curvature * radius - 1.0).abs() < 1e-14 && curve.curvature_slope.abs() < 1e-11, "{curve:?}");
        }
    }
}

/// Where a face is touched, from its definition: the stem is a line parallel to the path at its distance from the shaft, a pivot a point.
#[test]
fn a_face_is_touched_where_its_stem_or_pivot_says() {
    let lift = Jet { s: 0.01, ds: 0.02, dds: -0.01, ddds: 0.0 };
    for (tilt, offset) in [(0.0, 0.0), (0.0, 0.01), (0.4, 0.0), (-0.3, -0.02)] {
        let face = FlatFace::tilted(0.05, tilt, offset);
        let curve = face.touch(0.0, &lift).curve;
        // At the angle 0 the stem is the line y = offset, and the face runs along the tangent.
        let place = face.on_face(&lift).expect("a face").place;
        let foot = curve.point - curve.tangent * place;
        assert!((foot.y - offset).abs() < 1e-16, "{tilt} {offset}: {foot:?}");
        assert!(
            (face.on_face(&Jet::default()).expect("a face").place
                - (0.05 * libm::tan(tilt) - offset / libm::cos(tilt)))
            .abs()
                < 1e-16
        );
    }
    for (face_offset, side) in [(0.0, 1.0), (0.02, -1.0), (-0.01, 1.0)] {
        let face = SwingingFlat::new(0.2, face_offset, side).sized(0.05).expect("in reach");
        let touch = face.touch(0.0, &lift);
        let touched = face.on_face(&lift).expect("a face");
        let away = touch.curve.point - Vector2::new(0.2, 0.0);
        assert!((away.dot(&touch.curve.tangent) + side * touched.place).abs() < 1e-16, "{touched:?}");
        assert!((away.dot(&touch.curve.outward()) + face_offset).abs() < 1e-16, "{touched:?}");
        // The contact as a point of the arm moves as far as the leverage says, and along the drive.
        let turned = Vector2::new(-away.y, away.x) * side;
        assert!((turned - touch.drive * face.leverage(&lift)).norm() < 1e-16, "{turned:?}");
        assert!((turned.dot(&touch.curve.outward()) - touched.along_normal).abs() < 1e-16, "{touched:?}");
    }
    assert!(TranslatingRoller::new(0.1, 0.0, 0.02).on_face(&lift).is_none());
}

/// A face reports what it cannot reach.
#[test]
fn a_face_on_an_arm_has_a_reach() {
    let face = SwingingFlat::new(0.15, 0.01, 1.0);
    assert!(face.sized(0.141).is_none() && face.sized(0.139).is_some());
    let near = face.sized(0.13).expect("in reach");
    assert!(near.reach().1 < 0.4 && near.reach().0 > -1.3, "{:?}", near.reach());
    assert!(near.parameter_of(Vector2::new(0.2, 0.0), Vector2::new(1.0, 0.0)).is_nan(), "it never gets there");
}

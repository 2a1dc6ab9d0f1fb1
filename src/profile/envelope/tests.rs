use super::*;
use crate::body::disc::Disc;
use crate::machine::Machine;
use crate::profile::outline;

fn rotary(overrides: &[String]) -> Disc {
    let machine = Machine::load("dpi", overrides).expect("valid").0;
    Disc::solve(&machine, machine.press().expect("a press").design_rpm).expect("a cam")
}

/// A roller on the prime radius of the default cam, which is 99 mm.
fn with_roller(millimetres: f64) -> Disc {
    let set = |key: &str, value: f64| format!("{key}={value}mm");
    rotary(&[
        set("follower.roller.radius", millimetres),
        set("cam.base_radius", 99.0 - millimetres),
        set("cam.bore_radius", 1.0),
    ])
}

/// Radius of the roller, the two cam angles of the crossing (degrees) and the lift lost (mm), from the closed law (10) with its
/// run-up in 50 digits: Newton for the double point, golden sections for the loss. The pitch curve's least radius is
/// 66.523 885 130 629 380 327 mm, at the start of the reversal.
const SLIGHT: [[f64; 4]; 7] = [
    [66.5239, -3.701_501_672_347_1e-6, 1.218_771_894_272e-5, 3.386_244_778_266_5e-19],
    [66.525, -2.775_280_586_728e-4, 9.137_972_833_709_9e-4, 1.427_237_873_330_4e-13],
    [66.53, -1.522_155_304_987_8e-3, 5.011_815_153_238_6e-3, 2.354_574_468_012_7e-11],
    [66.6, -0.018_940_264_511_582, 0.062_348_563_168_758, 4.530_354_336_514_7e-8],
    [67.0, -0.118_239_422_629_42, 0.388_759_903_370_96, 1.094_124_134_294_3e-5],
    [68.0, -0.364_885_804_574_24, 1.196_599_447_001_2, 3.157_630_317_917_4e-4],
    [70.0, -0.852_506_435_975_49, 2.785_322_813_982_4, 3.886_372_096_788_4e-3],
];

#[test]
fn a_slight_undercut_is_the_exact_one() {
    for [roller, from, to, lost] in SLIGHT {
        let cam = with_roller(roller);
        let losses = losses(cam.curves()).unwrap_or_else(|error| panic!("{roller}: {error}"));
        // The law runs back as it came: 180° mirrors the start.
        let [first, last] = losses.as_slice() else { panic!("{roller}: {losses:?}") };
        for (found, exact) in [
            ((first.from.to_degrees(), first.to.to_degrees()), (from, to)),
            ((180.0 - last.to.to_degrees(), 180.0 - last.from.to_degrees()), (from, to)),
        ] {
            // Rounding of an angle of half a turn, and the exact speed's own rounding of 1e-16 over its size in the fold.
            let within = 1e-12 + 1e-7 * (to - from) + 1e-15 / (to - from);
            assert!((found.0 - exact.0).abs() < within, "{roller}: {found:?} {exact:?}");
            assert!((found.1 - exact.1).abs() < within, "{roller}: {found:?} {exact:?}");
        }
        // A millionth, or 1e-9 mm; the rounding of coordinates is 1e-14 mm.
        for loss in [first, last] {
            assert!((1e3 * loss.lost - lost).abs() < 1e-6 * lost + 1e-13, "{roller}: {loss:?} {lost:e}");
        }
    }
}

/// From the critical radius on, over fourteen decades: an envelope, and an outline of it that turns round once.
#[test]
fn every_slight_undercut_has_an_outline() {
    for exponent in -13..=0 {
        for digit in [1.0, 3.7] {
            let roller = 66.523_885_130_629_38 + digit * libm::pow(10.0, f64::from(exponent));
            let cam = with_roller(roller);
            let losses = losses(cam.curves()).unwrap_or_else(|error| panic!("{roller}: {error}"));
            assert!(losses.len() == 2 || exponent < -12, "{roller}: {losses:?}");
            let tolerance = if digit == 1.0 { 5e-6 } else { 5e-7 };
            let drawn = outline::profile(cam.curves(), tolerance).unwrap_or_else(|e| panic!("{roller}: {e}"));
            assert_eq!(drawn.contour.turns(), 1.0, "{roller}");
            assert!(drawn.deviation <= 1e3 * tolerance);
        }
    }
}

/// The follower's curve of a flat face is its profile: one that is pressed by a law a little too quick for its base circle.
#[test]
fn a_slight_undercut_under_a_face_has_an_outline() {
    use crate::follower::FlatFace;
    use crate::motion::{Jet, Motion, Piece};
    /// Lift a (1 − cos 3θ): ρ = R + a + 8 a cos 3θ, least R − 7 a at cos 3θ = −1.
    #[derive(Debug)]
    struct ThreeLobes(f64);
    impl Motion for ThreeLobes {
        fn pieces(&self) -> &[Piece] {
            const WHOLE: [Piece; 1] = [Piece { start: 0.0, end: std::f64::consts::TAU, dwell: false }];
            &WHOLE
        }
        fn jet(&self, _: usize, angle: f64) -> Jet {
            let (sin, cos) = (libm::sin(3.0 * angle), libm::cos(3.0 * angle));
            let a = self.0;
            Jet { s: a * (1.0 - cos), ds: 3.0 * a * sin, dds: 9.0 * a * cos, ddds: -27.0 * a * sin }
        }
    }
    let a = 0.003;
    for below in [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3] {
        let curves = Curves { motion: &ThreeLobes(a), follower: &FlatFace::new(7.0 * a - below) };
        let losses = losses(curves).unwrap_or_else(|error| panic!("{below}: {error}"));
        assert_eq!(losses.len(), 3, "{below}: {losses:?}");
        for loss in &losses {
            // Symmetric about the third of a turn, where the face is at the height R + 2 a over the shaft; the edge lies on
            // that line at p cos τ − p' sin τ with p' cos τ + p sin τ = 0: bisected for τ in (0, 60°).
            let support = |t: f64| (7.0 * a - below + a * (1.0 + libm::cos(3.0 * t)), -3.0 * a * libm::sin(3.0 * t));
            let across = |t: f64| support(t).0 * libm::sin(t) + support(t).1 * libm::cos(t);
            let (mut low, mut high) = (1e-3 * below.sqrt() / a.sqrt(), 1.0);
            for _ in 0..200 {
                let middle = 0.5 * (low + high);
                if across(middle) < 0.0 { low = middle } else { high = middle }
            }
            let (p, slope) = support(low);
            let lost = 7.0 * a - below + 2.0 * a - (p * libm::cos(low) - slope * libm::sin(low));
            assert!((loss.lost - lost).abs() < 1e-6 * lost + 1e-15, "{below}: {loss:?} {lost:e}");
        }
        let drawn = outline::profile(curves, 5e-6).unwrap_or_else(|error| panic!("{below}: {error}"));
        assert_eq!(drawn.contour.turns(), 1.0);
    }
}

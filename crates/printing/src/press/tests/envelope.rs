//! Undercut of the disc of a press that is hardly too small.

use crate::press::{MachineOfPress, rotary};
use camgen_cams::body::disc::Disc;
use camgen_cams::machine::Machine;
use camgen_kernel::profile::envelope::losses;
use camgen_kernel::profile::outline;

fn disc(overrides: &[String]) -> Disc {
    let machine = Machine::load("dpi", overrides).expect("valid").0;
    rotary::disc(&machine, machine.press().expect("a press").design_rpm).expect("a cam")
}

/// A roller on the prime radius of the default cam, which is 99 mm.
fn with_roller(millimetres: f64) -> Disc {
    let set = |key: &str, value: f64| format!("{key}={value}mm");
    disc(&[
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

//! Numbers that two programs, sharing nothing, gave to 40 digits.

use super::super::exact::{Statics, response};
use super::super::paper::first_critical;
use super::super::unbalance::{self, Unbalance};
use super::*;

/// The tolerance of the specification; rounding is 1e-14 here.
const EXACT: f64 = 1e-11;

/// Of the iteration, which stops at 1e-13 of ω².
const PAPER: f64 = 1e-9;

/// 1. (jπ)² √(EJ/(ρA L⁴)).
#[test]
fn uniform_beam_on_rigid_ends() {
    let rpm = [6_093.347_682_792_889, 24_373.390_731_171_56, 54_840.129_145_136_00];
    runs(&uniform(rigid(&[0.0, 1.0]), Beam::Euler), Whirl::Planar, &rpm, EXACT);
}

/// 2. The closed quadratic of a pinned Timoshenko beam.
#[test]
fn uniform_timoshenko_beam_whirls() {
    let shaft = uniform(rigid(&[0.0, 1.0]), Beam::Timoshenko);
    runs(&shaft, Whirl::Planar, &[6_074.972_073_783_426, 24_084.263_018_374_47], EXACT);
    runs(&shaft, Whirl::Forward, &[6_084.263_364_012_018, 24_228.021_887_631_80], EXACT);
    runs(&shaft, Whirl::Backward, &[6_065.722_966_187_317, 23_942.973_904_639_04], EXACT);
}

/// 3. λ³(tan λ/2 + tanh λ/2) = 2κ and λ³(coth λ/2 − cot λ/2) = 2κ.
#[test]
fn uniform_beam_on_springs() {
    let shaft = uniform(springs(&[0.0, 1.0], 1e7), Beam::Euler);
    runs(&shaft, Whirl::Planar, &[5_413.510_214_810_984, 15_716.195_449_184_23, 26_276.558_857_374_83], EXACT);
    let modes = found(&shaft, Whirl::Planar, 1).modes;
    let shape = &modes[0].shape;
    close(shape.evaluate(0.0)[0] / shape.evaluate(0.5)[0], 0.173_431_520_255_0, EXACT);
    // The largest is in the middle.
    close(shape.evaluate(0.5)[0], 1.0, 1e-13);
}

/// 4. The first two near √(2k/M) and √(6k/M), the third near the free beam's.
#[test]
fn uniform_beam_on_soft_springs() {
    let shaft = uniform(springs(&[0.0, 1.0], 1e3), Beam::Euler);
    runs(&shaft, Whirl::Planar, &[108.762_814_275_420_3, 188.403_605_193_163_2, 13_814.648_518_670_83], EXACT);
}

/// 5. (coth p − cot p)/2 = (1 + cos q cosh q)/(sin q cosh q − cos q sinh q), p = 0.6β, q = 0.4β.
#[test]
fn overhang() {
    let shaft = uniform(rigid(&[0.0, 0.6]), Beam::Euler);
    runs(&shaft, Whirl::Planar, &[7_421.034_148_463_497, 22_739.659_219_787_35, 63_598.764_063_954_08], EXACT);
    let modes = found(&shaft, Whirl::Planar, 1).modes;
    let shape = &modes[0].shape;
    close(shape.evaluate(0.3)[0] / shape.evaluate(1.0)[0], -0.205_799_224_095, EXACT);
    close(shape.evaluate(1.0)[0], 1.0, 1e-14);
}

/// 6. The second is tan λ = tanh λ on half of the length.
#[test]
fn three_supports() {
    let rpm = [24_373.390_731_171_56, 38_075.888_054_039_92];
    runs(&uniform(rigid(&[0.0, 0.5, 1.0]), Beam::Euler), Whirl::Planar, &rpm, EXACT);
}

/// 7. √(k_total/m), and m U Ω²/(k_total − m Ω²).
#[test]
fn disc_on_a_massless_shaft_and_its_unbalance() {
    let with = |beam| {
        let heavy = ShaftDisc { unbalance: [0.006, -0.008], ..disc(0.3, 50.0, 0.0, 0.0) };
        shaft(&[massless(0.6)], springs(&[0.0, 0.6], 5e7), &[heavy], beam)
    };
    runs(&with(Beam::Euler), Whirl::Planar, &[3_178.483_229_711_536], EXACT);
    runs(&with(Beam::Timoshenko), Whirl::Planar, &[3_163.905_671_237_357], EXACT);
    let turning = response(&with(Beam::Euler), 1500.0 / RPM).expect("below the critical speed");
    let [x, y] = turning.deflection_at(0.3);
    close(x, 0.6 * 5.730_472_467_761_001e-5, EXACT);
    close(y, -0.8 * 5.730_472_467_761_001e-5, EXACT);
    for [x, y] in &turning.support_forces {
        close(*x, 0.6 * 158.718_490_193_701_6, EXACT);
        close(*y, -0.8 * 158.718_490_193_701_6, EXACT);
    }
}

/// 8. C = a²b²/(3EJl) + (b/l)²/k1 + (a/l)²/k2, and ab/(κGAl).
#[test]
fn compliance_and_slopes() {
    let supports = || vec![Support { at: 0.0, stiffness: Some(3e7) }, Support { at: 0.6, stiffness: Some(8e7) }];
    let euler = shaft(&[massless(0.6)], supports(), &[disc(0.2, 50.0, 0.0, 0.0)], Beam::Euler);
    let statics = Statics::new(&euler, 0.2).expect("on the shaft");
    close(statics.own_compliance(), 1.509_380_470_619_220e-7, EXACT);
    close(statics.compliance(0.2), 1.509_380_470_619_220e-7, EXACT);
    close(statics.curve.evaluate(0.0)[1], 8.119_970_533_962_716e-7, EXACT);
    close(statics.curve.evaluate(0.6)[1], -7.037_643_093_836_840e-7, EXACT);
    close(statics.reactions[0], 2.0 / 3.0, EXACT);
    close(statics.reactions[1], 1.0 / 3.0, EXACT);
    let timoshenko = shaft(&[massless(0.6)], supports(), &[], Beam::Timoshenko);
    close(Statics::new(&timoshenko, 0.2).expect("on the shaft").own_compliance(), 1.524_201_248_388_624e-7, EXACT);
    runs(&euler, Whirl::Planar, &[3_476.058_018_584_551], EXACT);
}

/// 9. Two discs.
#[test]
fn two_discs() {
    let discs = [disc(0.2, 30.0, 0.0, 0.0), disc(0.45, 20.0, 0.0, 0.0)];
    let shaft = shaft(&[massless(0.6)], rigid(&[0.0, 0.6]), &discs, Beam::Euler);
    runs(&shaft, Whirl::Planar, &[4_066.455_187_663_764, 14_301.239_036_417_13], EXACT);
}

/// 10. In forward whirl a thin disc's turning is no mass: its second speed does not exist.
#[test]
fn overhung_disc_with_its_gyroscopic_moment() {
    let shaft = shaft(&[massless(0.6)], rigid(&[0.0, 0.4]), &[disc(0.55, 20.0, 0.15, 0.28)], Beam::Euler);
    runs(&shaft, Whirl::Planar, &[4_474.324_778_571_339, 22_398.617_923_587_52], EXACT);
    runs(&shaft, Whirl::Forward, &[6_627.450_147_882_450], EXACT);
    assert_eq!(modes(&shaft, Whirl::Forward, 2, None), Err(ShaftError::NoSuchMode { asked: 2, exist: 1 }));
    runs(&shaft, Whirl::Backward, &[3_504.878_889_263_391, 16_888.345_801_613_84], EXACT);
}

/// 11.
#[test]
fn reference_cylinder() {
    for (stiffness, rpm) in [
        (None, [13_585.076_737_683_1, 38_598.137_458_366_6, 152_868.700_635_786]),
        (Some(1e9), [9_618.040_174_964_64, 25_152.413_948_500_9, 111_123.768_975_142]),
        (Some(1e8), [4_087.454_354_634_90, 9_929.739_445_417_90, 88_071.052_271_054_0]),
    ] {
        runs(&cylinder(stiffness, Beam::Euler), Whirl::Planar, &rpm, EXACT);
    }
}

/// 12.
#[test]
fn reference_cylinder_with_shear() {
    for (stiffness, forward, planar) in [
        (None, 12_509.278_239_698_3, 12_481.281_960_830_6),
        (Some(1e9), 9_213.269_309_052_77, 9_207.225_635_194_39),
        (Some(1e8), 4_055.024_500_711_58, 4_054.926_214_810_53),
    ] {
        let shaft = cylinder(stiffness, Beam::Timoshenko);
        runs(&shaft, Whirl::Forward, &[forward], EXACT);
        runs(&shaft, Whirl::Planar, &[planar], EXACT);
    }
}

/// 13.
#[test]
fn the_example_shaft() {
    let (euler, timoshenko) = (shaft_a(Beam::Euler), shaft_a(Beam::Timoshenko));
    runs(&euler, Whirl::Planar, &[31_037.880_663_505_9], EXACT);
    runs(&timoshenko, Whirl::Forward, &[30_074.149_373_331_1, 248_100.536_441_864], EXACT);
    runs(&timoshenko, Whirl::Planar, &[30_009.122_515_091_7, 63_981.661_539_705_5], EXACT);
    runs(&timoshenko, Whirl::Backward, &[29_944.346_627_911_5], EXACT);
    close(Statics::new(&euler, 0.15).expect("on the shaft").own_compliance(), 6.694_265_515_355_378e-9, EXACT);
    let statics = Statics::new(&timoshenko, 0.15).expect("on the shaft");
    close(statics.own_compliance(), 7.173_360_879_693_742e-9, EXACT);
    close(statics.curve.evaluate(0.02)[1], 6.639_146_585_543_739e-8, EXACT);
    close(timoshenko.twist_compliance(0.0, 0.15), 3.449_726_742_384_2e-6, EXACT);
    close(timoshenko.twist_compliance(0.15, 0.0), 3.449_726_742_384_2e-6, EXACT);
}

/// 15. A rocking mode below the symmetric one; the paper's start finds it because it leans.
#[test]
fn soft_supports_far_within() {
    let shaft = shaft(&[steel(1.6, 0.05)], springs(&[0.6, 1.0], 1e5), &[], Beam::Euler);
    runs(&shaft, Whirl::Planar, &[371.449_434_091_129, 850.028_486_664_154, 5_457.943_761_300_62], EXACT);
    by_stations(&shaft, 18, 371.981_729_116);
    by_stations(&shaft, 180, 371.455_285_322);
}

#[track_caller]
fn by_stations(shaft: &Shaft, stations: usize, rpm: f64) {
    let found = first_critical(shaft, stations).expect("converges");
    close(found.speed * RPM, rpm, PAPER);
    assert!((2..100).contains(&found.rounds), "{found:?}");
}

/// 16.
#[test]
fn the_papers_method() {
    by_stations(&uniform(rigid(&[0.0, 1.0]), Beam::Euler), 18, 6_124.417_378_818_762);
    by_stations(&uniform(rigid(&[0.0, 1.0]), Beam::Euler), 180, 6_093.657_052_784_936);
    by_stations(&uniform(springs(&[0.0, 1.0], 1e7), Beam::Euler), 18, 5_433.901_564_815);
    by_stations(&uniform(rigid(&[0.0, 0.6]), Beam::Euler), 18, 7_451.661_545_744);
    by_stations(&cylinder(Some(1e9), Beam::Euler), 36, 9_629.206_696_326);
    by_stations(&shaft_a(Beam::Euler), 18, 31_095.440_148_69);
}

/// The paper's law of error on a uniform beam: [(2N/π) tan(π/2N)]².
#[test]
fn stations_err_by_their_law() {
    let shaft = uniform(rigid(&[0.0, 1.0]), Beam::Timoshenko);
    let exact = 6_093.347_682_792_889;
    for stations in [2, 3, 9, 18, 36, 180, 1800] {
        let n = f64::from(u32::try_from(stations).expect("small"));
        let factor = 2.0 * n / PI * libm::tan(0.5 * PI / n);
        by_stations(&shaft, stations, exact * factor * factor);
    }
}

fn polar([x, y]: [f64; 2]) -> (f64, f64) {
    (libm::hypot(x, y), libm::atan2(y, x).to_degrees())
}

/// 17, in g·mm.
#[test]
fn unbalance_in_planes_and_grades() {
    let at = |at, size: f64, deg: f64| {
        let angle = deg.to_radians();
        Unbalance { at, vector: [size * libm::cos(angle), size * libm::sin(angle)] }
    };
    let both = [at(0.1, 300.0, 0.0), at(0.4, 200.0, 120.0)];
    let [a, b] = unbalance::split(&both, 0.0, 0.5).expect("apart");
    for (got, (size, deg)) in [
        (a, (222.710_574_513, 8.948_275_56)),
        (b, (140.0, 98.213_210_7)),
        (unbalance::resultant(&both), (264.575_131_106, 40.893_394_6)),
    ] {
        // As many digits as the specification prints.
        close(polar(got).0, size, 1e-11);
        close(polar(got).1, deg, 1e-8);
    }
    let permissible = unbalance::permissible(16.0, 12.079_353_059_648_724, 105.0 / RPM);
    close(permissible * 1e6, 17_577.039_989, 1e-10);
    assert_eq!(unbalance::grade_of(0.3549), Some(630.0));
    assert_eq!(unbalance::grade_of(0.0063), Some(6.3));
    assert_eq!(unbalance::grade_of(0.0), Some(0.4));
    assert_eq!(unbalance::grade_of(4.1), None);
}

/// Two weights at the told angles leave nothing.
#[test]
fn correction_weights_cancel() {
    let unbalance = [3e-4, -2e-4];
    let [p, q] = unbalance::correction(unbalance, 2.5e-4).expect("heavy enough");
    for (part, trig) in unbalance.iter().zip([libm::cos as fn(f64) -> f64, libm::sin]) {
        assert!((part + 2.5e-4 * (trig(p) + trig(q))).abs() < 1e-18);
    }
    // Just heavy enough: both opposite.
    let [p, q] = unbalance::correction([0.0, 2.0], 1.0).expect("heavy enough");
    assert!((p - 1.5 * PI).abs() < 1e-15 && (q - 1.5 * PI).abs() < 1e-15);
}

#[test]
fn shares_of_bearings_are_kept_in_their_range() {
    let of = |centre| unbalance::shares(centre, 1.0, 2.0).expect("apart");
    assert_eq!(of(1.5), [0.5, 0.5]);
    assert_eq!(of(1.25), [0.7, 0.3]);
    assert_eq!(of(1.0), [0.7, 0.3]);
    assert_eq!(of(2.125), [0.3, 1.125]);
    assert_eq!(of(3.0), [0.3, 1.3]);
}

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
    let rpm = [6093.347682792889, 24373.39073117156, 54840.12914513600];
    runs(&uniform(rigid(&[0.0, 1.0]), Beam::Euler), Whirl::Planar, &rpm, EXACT);
}

/// 2. The closed quadratic of a pinned Timoshenko beam.
#[test]
fn uniform_timoshenko_beam_whirls() {
    let shaft = uniform(rigid(&[0.0, 1.0]), Beam::Timoshenko);
    runs(&shaft, Whirl::Planar, &[6074.972073783426, 24084.26301837447], EXACT);
    runs(&shaft, Whirl::Forward, &[6084.263364012018, 24228.02188763180], EXACT);
    runs(&shaft, Whirl::Backward, &[6065.722966187317, 23942.97390463904], EXACT);
}

/// 3. λ³(tan λ/2 + tanh λ/2) = 2κ and λ³(coth λ/2 − cot λ/2) = 2κ.
#[test]
fn uniform_beam_on_springs() {
    let shaft = uniform(springs(&[0.0, 1.0], 1e7), Beam::Euler);
    runs(&shaft, Whirl::Planar, &[5413.510214810984, 15716.19544918423, 26276.55885737483], EXACT);
    let modes = found(&shaft, Whirl::Planar, 1).modes;
    let shape = &modes[0].shape;
    close(shape.at(0.0)[0] / shape.at(0.5)[0], 0.1734315202550, EXACT);
    // The largest is in the middle.
    close(shape.at(0.5)[0], 1.0, 1e-13);
}

/// 4. The first two near √(2k/M) and √(6k/M), the third near the free beam's.
#[test]
fn uniform_beam_on_soft_springs() {
    let shaft = uniform(springs(&[0.0, 1.0], 1e3), Beam::Euler);
    runs(&shaft, Whirl::Planar, &[108.7628142754203, 188.4036051931632, 13814.64851867083], EXACT);
}

/// 5. (coth p − cot p)/2 = (1 + cos q cosh q)/(sin q cosh q − cos q sinh q), p = 0.6β, q = 0.4β.
#[test]
fn overhang() {
    let shaft = uniform(rigid(&[0.0, 0.6]), Beam::Euler);
    runs(&shaft, Whirl::Planar, &[7421.034148463497, 22739.65921978735, 63598.76406395408], EXACT);
    let modes = found(&shaft, Whirl::Planar, 1).modes;
    let shape = &modes[0].shape;
    close(shape.at(0.3)[0] / shape.at(1.0)[0], -0.205799224095, EXACT);
    close(shape.at(1.0)[0], 1.0, 1e-14);
}

/// 6. The second is tan λ = tanh λ on half of the length.
#[test]
fn three_supports() {
    let rpm = [24373.39073117156, 38075.88805403992];
    runs(&uniform(rigid(&[0.0, 0.5, 1.0]), Beam::Euler), Whirl::Planar, &rpm, EXACT);
}

/// 7. √(k_total/m), and m U Ω²/(k_total − m Ω²).
#[test]
fn disc_on_a_massless_shaft_and_its_unbalance() {
    let with = |beam| {
        let heavy = Disc { unbalance: [0.006, -0.008], ..disc(0.3, 50.0, 0.0, 0.0) };
        shaft(&[massless(0.6)], springs(&[0.0, 0.6], 5e7), &[heavy], beam)
    };
    runs(&with(Beam::Euler), Whirl::Planar, &[3178.483229711536], EXACT);
    runs(&with(Beam::Timoshenko), Whirl::Planar, &[3163.905671237357], EXACT);
    let turning = response(&with(Beam::Euler), 1500.0 / RPM).expect("below the critical speed");
    let [x, y] = turning.deflection_at(0.3);
    close(x, 0.6 * 5.730472467761001e-5, EXACT);
    close(y, -0.8 * 5.730472467761001e-5, EXACT);
    for [x, y] in &turning.support_forces {
        close(*x, 0.6 * 158.7184901937016, EXACT);
        close(*y, -0.8 * 158.7184901937016, EXACT);
    }
}

/// 8. C = a²b²/(3EJl) + (b/l)²/k1 + (a/l)²/k2, and ab/(κGAl).
#[test]
fn compliance_and_slopes() {
    let supports = || vec![Support { at: 0.0, stiffness: Some(3e7) }, Support { at: 0.6, stiffness: Some(8e7) }];
    let euler = shaft(&[massless(0.6)], supports(), &[disc(0.2, 50.0, 0.0, 0.0)], Beam::Euler);
    let statics = Statics::new(&euler, 0.2).expect("on the shaft");
    close(statics.own(), 1.509380470619220e-7, EXACT);
    close(statics.compliance(0.2), 1.509380470619220e-7, EXACT);
    close(statics.curve.at(0.0)[1], 8.119970533962716e-7, EXACT);
    close(statics.curve.at(0.6)[1], -7.037643093836840e-7, EXACT);
    close(statics.reactions[0], 2.0 / 3.0, EXACT);
    close(statics.reactions[1], 1.0 / 3.0, EXACT);
    let timoshenko = shaft(&[massless(0.6)], supports(), &[], Beam::Timoshenko);
    close(Statics::new(&timoshenko, 0.2).expect("on the shaft").own(), 1.524201248388624e-7, EXACT);
    runs(&euler, Whirl::Planar, &[3476.058018584551], EXACT);
}

/// 9. Two discs.
#[test]
fn two_discs() {
    let discs = [disc(0.2, 30.0, 0.0, 0.0), disc(0.45, 20.0, 0.0, 0.0)];
    let shaft = shaft(&[massless(0.6)], rigid(&[0.0, 0.6]), &discs, Beam::Euler);
    runs(&shaft, Whirl::Planar, &[4066.455187663764, 14301.23903641713], EXACT);
}

/// 10. In forward whirl a thin disc's turning is no mass: its second speed does not exist.
#[test]
fn overhung_disc_with_its_gyroscopic_moment() {
    let shaft = shaft(&[massless(0.6)], rigid(&[0.0, 0.4]), &[disc(0.55, 20.0, 0.15, 0.28)], Beam::Euler);
    runs(&shaft, Whirl::Planar, &[4474.324778571339, 22398.61792358752], EXACT);
    runs(&shaft, Whirl::Forward, &[6627.450147882450], EXACT);
    assert_eq!(modes(&shaft, Whirl::Forward, 2, None), Err(ShaftError::NoSuchMode { asked: 2, exist: 1 }));
    runs(&shaft, Whirl::Backward, &[3504.878889263391, 16888.34580161384], EXACT);
}

/// 11.
#[test]
fn reference_cylinder() {
    for (stiffness, rpm) in [
        (None, [13585.0767376831, 38598.1374583666, 152868.700635786]),
        (Some(1e9), [9618.04017496464, 25152.4139485009, 111123.768975142]),
        (Some(1e8), [4087.45435463490, 9929.73944541790, 88071.0522710540]),
    ] {
        runs(&cylinder(stiffness, Beam::Euler), Whirl::Planar, &rpm, EXACT);
    }
}

/// 12.
#[test]
fn reference_cylinder_with_shear() {
    for (stiffness, forward, planar) in [
        (None, 12509.2782396983, 12481.2819608306),
        (Some(1e9), 9213.26930905277, 9207.22563519439),
        (Some(1e8), 4055.02450071158, 4054.92621481053),
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
    runs(&euler, Whirl::Planar, &[31037.8806635059], EXACT);
    runs(&timoshenko, Whirl::Forward, &[30074.1493733311, 248100.536441864], EXACT);
    runs(&timoshenko, Whirl::Planar, &[30009.1225150917, 63981.6615397055], EXACT);
    runs(&timoshenko, Whirl::Backward, &[29944.3466279115], EXACT);
    close(Statics::new(&euler, 0.15).expect("on the shaft").own(), 6.694265515355378e-9, EXACT);
    let statics = Statics::new(&timoshenko, 0.15).expect("on the shaft");
    close(statics.own(), 7.173360879693742e-9, EXACT);
    close(statics.curve.at(0.02)[1], 6.639146585543739e-8, EXACT);
    close(timoshenko.twist_compliance(0.0, 0.15), 3.4497267423842e-6, EXACT);
    close(timoshenko.twist_compliance(0.15, 0.0), 3.4497267423842e-6, EXACT);
}

/// 15. A rocking mode below the symmetric one; the paper's start finds it because it leans.
#[test]
fn soft_supports_far_within() {
    let shaft = shaft(&[steel(1.6, 0.05)], springs(&[0.6, 1.0], 1e5), &[], Beam::Euler);
    runs(&shaft, Whirl::Planar, &[371.449434091129, 850.028486664154, 5457.94376130062], EXACT);
    by_stations(&shaft, 18, 371.981729116);
    by_stations(&shaft, 180, 371.455285322);
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
    by_stations(&uniform(rigid(&[0.0, 1.0]), Beam::Euler), 18, 6124.417378818762);
    by_stations(&uniform(rigid(&[0.0, 1.0]), Beam::Euler), 180, 6093.657052784936);
    by_stations(&uniform(springs(&[0.0, 1.0], 1e7), Beam::Euler), 18, 5433.901564815);
    by_stations(&uniform(rigid(&[0.0, 0.6]), Beam::Euler), 18, 7451.661545744);
    by_stations(&cylinder(Some(1e9), Beam::Euler), 36, 9629.206696326);
    by_stations(&shaft_a(Beam::Euler), 18, 31095.44014869);
}

/// The paper's law of error on a uniform beam: [(2N/π) tan(π/2N)]².
#[test]
fn stations_err_by_their_law() {
    let shaft = uniform(rigid(&[0.0, 1.0]), Beam::Timoshenko);
    let exact = 6093.347682792889;
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
    let [a, b] = unbalance::split(&both, [0.0, 0.5]).expect("apart");
    for (got, (size, deg)) in [
        (a, (222.710574513, 8.94827556)),
        (b, (140.0, 98.2132107)),
        (unbalance::resultant(&both), (264.575131106, 40.8933946)),
    ] {
        // As many digits as the specification prints.
        close(polar(got).0, size, 1e-11);
        close(polar(got).1, deg, 1e-8);
    }
    let permissible = unbalance::permissible(16.0, 12.079353059648724, 105.0 / RPM);
    close(permissible * 1e6, 17577.039989, 1e-10);
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
    let of = |centre| unbalance::shares(centre, [1.0, 2.0]).expect("apart");
    assert_eq!(of(1.5), [0.5, 0.5]);
    assert_eq!(of(1.25), [0.7, 0.3]);
    assert_eq!(of(1.0), [0.7, 0.3]);
    assert_eq!(of(2.125), [0.3, 1.125]);
    assert_eq!(of(3.0), [0.3, 1.3]);
}

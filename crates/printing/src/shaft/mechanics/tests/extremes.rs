//! Grooves, slivers, supports next to each other, diameters 1 : 1000, soft springs, long runs of waves: against an Euler beam by
//! its dynamic stiffness and against closed forms, which share nothing with the method.

use super::super::exact::Statics;
use super::*;
use camgen_kernel::numeric::root;

/// cosh, sinh, cos, sin of βx combined to the four Krylov functions S, T, U, V.
fn krylov(z: f64) -> [f64; 4] {
    // U and V cancel for small z: their series.
    let series = |first: f64, from: f64| {
        let (mut term, mut sum, mut n) = (first, 0.0, from);
        for _ in 0..8 {
            sum += term;
            term *= z.powi(4) / ((n + 1.0) * (n + 2.0) * (n + 3.0) * (n + 4.0));
            n += 4.0;
        }
        sum
    };
    if z < 2.0 {
        return [series(1.0, 0.0), series(z, 1.0), series(0.5 * z * z, 2.0), series(z * z * z / 6.0, 3.0)];
    }
    let (c, s, ch, sh) = (libm::cos(z), libm::sin(z), libm::cosh(z), libm::sinh(z));
    [0.5 * (ch + c), 0.5 * (sh + s), 0.5 * (ch - c), 0.5 * (sh - s)]
}

/// y, y′, M, Q at the right end of a piece from those at its left one: EJ y″ = M, M′ = −Q, Q′ = −ω² ρA y.
fn carried([y, turn, m, q]: [f64; 4], segment: &ShaftSegment, omega: f64) -> [f64; 4] {
    let bending = segment.modulus * segment.second_moment();
    let beta = (segment.density * segment.area() * omega * omega / bending).sqrt().sqrt();
    let [s, t, u, v] = krylov(beta * segment.length);
    // y = y₀ S + y₀′ T/β + M₀ U/(EJ β²) − Q₀ V/(EJ β³), and S′ = βV, T′ = βS, U′ = βT, V′ = βU.
    let (a, b, c, d) = (y, turn / beta, m / (bending * beta * beta), -q / (bending * beta * beta * beta));
    [
        a * s + b * t + c * u + d * v,
        beta * (a * v + b * s + c * t + d * u),
        bending * beta * beta * (a * u + b * v + c * s + d * t),
        -bending * beta * beta * beta * (a * t + b * u + c * v + d * s),
    ]
}

/// The determinant of an Euler beam on springs at its ends, by transfer from the left: 0 at a critical speed.
fn determinant(segments: &[ShaftSegment], stiffness: f64, omega: f64) -> f64 {
    // Left end: M = 0, Q = −k y with Q′ = −load and the force of the support −k y on the beam: Q(0+) = k y.
    let end = |start: [f64; 4]| segments.iter().fold(start, |state, segment| carried(state, segment, omega));
    let [by_y, by_turn] = [end([1.0, 0.0, 0.0, stiffness]), end([0.0, 1.0, 0.0, 0.0])];
    // Right end: M = 0, Q = −k y.
    let rest = |[y, _, m, q]: [f64; 4]| [m, q + stiffness * y];
    let ([m1, q1], [m2, q2]) = (rest(by_y), rest(by_turn));
    m1 * q2 - m2 * q1
}

/// The transfer finds a sign change within this part of the speed told, and nowhere further: its own rounding is 1e-9 or so.
#[track_caller]
fn transfer_agrees(segments: &[ShaftSegment], stiffness: f64, count: usize, tolerance: f64) {
    let length: f64 = segments.iter().map(|s| s.length).sum();
    let shaft = shaft(segments, springs(&[0.0, length], stiffness), &[], Beam::Euler);
    for speed in speeds(&shaft, Whirl::Planar, count) {
        let of = |omega: f64| determinant(segments, stiffness, omega);
        let got = root::bracketed(of, 0.999 * speed, 1.001 * speed, 0.0).expect("a root of the determinant");
        close(got, speed, tolerance);
    }
}

#[test]
fn the_transfer_is_right() {
    transfer_agrees(&[steel(1.0, 0.05)], 1e7, 4, 1e-11);
    transfer_agrees(&[steel(0.255, 0.16), steel(0.857, 0.416), steel(0.255, 0.16)], 1e9, 3, 1e-11);
}

#[test]
fn grooves_slivers_and_thin_ends() {
    let grooves = [steel(0.3, 0.05), steel(1e-3, 0.04), steel(0.4, 0.05), steel(5e-4, 0.03), steel(0.2985, 0.05)];
    transfer_agrees(&grooves, 1e8, 3, 1e-10);
    transfer_agrees(&[steel(0.5, 0.05), steel(1e-6, 0.01), steel(0.5, 0.05)], 1e8, 3, 1e-10);
    transfer_agrees(&[steel(0.2, 0.02), steel(0.6, 0.2), steel(0.2, 0.01)], 1e7, 3, 1e-9);
}

/// Diameters 1 : 1000: two wires of 0.2 m hold a rigid body of ∅1 × 0.01: the body on two clamped wires, k = 2·3EJ/l³ with its
/// ends pinned and its turning held by symmetry.
#[test]
fn a_thick_disc_on_wires() {
    let wire = ShaftSegment { density: 0.0, ..steel(0.2, 0.001) };
    let body = steel(0.01, 1.0);
    let shaft = shaft(&[wire, body, wire], rigid(&[0.0, 0.41]), &[], Beam::Euler);
    let bending = wire.modulus * wire.second_moment();
    let stiffness = 6.0 * bending / 0.2_f64.powi(3);
    // The body bends 1e-12 times as much as the wires.
    close(speeds(&shaft, Whirl::Planar, 1)[0], (stiffness / body.mass()).sqrt(), 1e-11);
    let compliance = Statics::new(&shaft, 0.205).expect("on it").own_compliance();
    close(compliance, 1.0 / stiffness, 1e-11);
}

/// Supports 1 mm apart clamp: against a clamped and pinned beam, tan λ = tanh λ, to what the millimetre leaves.
#[test]
fn supports_next_to_each_other_clamp() {
    let lambda = 3.926_602_312_047_919;
    let clamped = |length: f64| {
        let s = steel(length, 0.05);
        lambda * lambda / (length * length) * (s.modulus * s.second_moment() / (s.density * s.area())).sqrt()
    };
    // A continuous beam over a first span of d: a clamp with the flexibility d/(3EJ), −d/l of the speed by Rayleigh.
    for (apart, order) in [(1e-3, 2e-3), (1e-4, 2e-4), (1e-5, 2e-5)] {
        let shaft = shaft(&[steel(1.0 + apart, 0.05)], rigid(&[0.0, apart, 1.0 + apart]), &[], Beam::Euler);
        let speed = speeds(&shaft, Whirl::Planar, 1)[0];
        assert!(speed < clamped(1.0), "{speed}");
        close(speed, clamped(1.0), order);
    }
    // The same in any order of the supports.
    let of = |places: &[f64]| speeds(&uniform(rigid(places), Beam::Timoshenko), Whirl::Forward, 3);
    for (a, b) in of(&[0.3, 0.301, 1.0]).iter().zip(of(&[1.0, 0.3, 0.301])) {
        close(*a, b, 1e-12);
    }
}

/// On 1 N/m a shaft is a rigid body: √(2k/M) and √(6k/M), the bending being 1e-7 of it; the third mode is the free beam's.
#[test]
fn soft_springs() {
    let shaft = uniform(springs(&[0.0, 1.0], 1.0), Beam::Euler);
    let mass = shaft.mass();
    let got = speeds(&shaft, Whirl::Planar, 3);
    close(got[0], (2.0 / mass).sqrt(), 1e-6);
    close(got[1], (6.0 / mass).sqrt(), 1e-6);
    close(got[2] * RPM, 13_812.935_301_281_26, 1e-6);
    // And by the transfer, the third to what its matrix leaves: ε (ω_3/ω_1)².
    transfer_agrees(&[steel(1.0, 0.05)], 1.0, 3, 1e-8);
}

/// Many modes on one panel: it is cut, and every one is j² times the first.
#[test]
fn thirty_modes_of_one_panel() {
    let shaft = uniform(rigid(&[0.0, 1.0]), Beam::Euler);
    let all = found(&shaft, Whirl::Planar, 30);
    assert!(all.panels > 1, "{}", all.panels);
    for (mode, j) in all.modes.iter().zip(1_u32..) {
        // ε (ω_j/ω_1)², 2e-10 at the thirtieth.
        let j = f64::from(j);
        close(mode.speed * RPM, 6_093.347_682_792_889 * j * j, 1e-13 + 4.0 * f64::EPSILON * j.powi(4));
        // sin jπx: its crests are equal, and it leaves the left end upward.
        close(mode.shape.evaluate(0.5 / j)[0], 1.0, 1e-8);
    }
}

/// A shaft stubby enough that shear waves, not those of bending, set the order: thirty-two panels or one, the same speeds.
#[test]
fn stubby_shafts() {
    let one = shaft(&[steel(0.1, 0.3)], rigid(&[0.0, 0.1]), &[], Beam::Timoshenko);
    let marks: Vec<ShaftDisc> = (1..8_u32).map(|k| disc(0.0125 * f64::from(k), 0.0, 0.0, 0.0)).collect();
    let many = one.with_discs(marks).expect("in order");
    for whirl in [Whirl::Planar, Whirl::Backward, Whirl::Forward] {
        for (a, b) in speeds(&one, whirl, 4).iter().zip(speeds(&many, whirl, 4)) {
            close(*a, b, 1e-12);
        }
    }
}

/// A fixed order climbs the ladder of §6: five polynomials a panel are 1e-12 from the speed of the reference cylinder, three 3e-6.
#[test]
fn the_ladder_of_orders() {
    let shaft = cylinder(None, Beam::Euler);
    for (order, error) in [(3, 2.6e-6), (4, 2.9e-7), (5, 1.4e-12)] {
        let got = modes(&shaft, Whirl::Planar, 1, Some(order)).expect("modes").modes[0].speed * RPM;
        let off = got / 13_585.076_737_683_1 - 1.0;
        assert!(off > 0.5 * error && off < 1.5 * error, "order {order}: {off:e}");
    }
    assert!(found(&shaft, Whirl::Planar, 1).order >= 7);
}

/// A beam with a short heavy piece among massless ones has few loads at first: every mode requested is found, by any cut.
#[test]
fn one_heavy_panel_among_many() {
    let thin = |k: u32| massless_of(0.02 + 0.001 * f64::from(k));
    let mut segments: Vec<ShaftSegment> = (0..6).map(thin).collect();
    segments.push(steel(0.5, 0.05));
    segments.extend((6..12).map(thin));
    let length: f64 = segments.iter().map(|s| s.length).sum();
    let whole = shaft(&segments, rigid(&[0.0, length]), &[], Beam::Euler);
    let marks: Vec<ShaftDisc> = (1..6_u32).map(|k| disc(0.3 + 0.08 * f64::from(k), 0.0, 0.0, 0.0)).collect();
    let cut = whole.with_discs(marks).expect("in order");
    let (got, want) = (speeds(&whole, Whirl::Planar, 8), speeds(&cut, Whirl::Planar, 8));
    for (a, b) in got.iter().zip(&want) {
        close(*a, *b, 1e-13 + 50.0 * f64::EPSILON * (b / want[0]).powi(2));
    }
}

fn massless_of(diameter: f64) -> ShaftSegment {
    ShaftSegment { density: 0.0, ..steel(0.05, diameter) }
}

/// A third support so soft that it is none, or so stiff that it is rigid; and whichever two hold the shaft first.
#[test]
fn a_third_support_from_nothing_to_rigid() {
    let of = |middle: Option<f64>| {
        let supports = vec![rigid(&[0.0])[0], Support { at: 0.4, stiffness: middle }, springs(&[1.0], 1e8)[0]];
        speeds(&uniform(supports, Beam::Timoshenko), Whirl::Forward, 2)
    };
    let two = vec![rigid(&[0.0])[0], springs(&[1.0], 1e8)[0]];
    let two = speeds(&uniform(two, Beam::Timoshenko), Whirl::Forward, 2);
    // The bent shaft has 7e5 N/m in the middle, against 1e-3 and 1e17.
    for (a, b) in of(Some(1e-3)).iter().zip(&two) {
        close(*a, *b, 1e-8);
    }
    for (a, b) in of(Some(1e17)).iter().zip(of(None)) {
        close(*a, b, 1e-9);
    }
    // Rigid ones at 0 and 0.4, a breath of a spring at the far end: an overhang.
    let breath = |far: &[Support]| {
        let supports = [rigid(&[0.0, 0.4]), far.to_vec()].concat();
        speeds(&uniform(supports, Beam::Euler), Whirl::Planar, 2)
    };
    for (a, b) in breath(&springs(&[1.0], 1e-4)).iter().zip(breath(&[])) {
        close(*a, b, 1e-8);
    }
}

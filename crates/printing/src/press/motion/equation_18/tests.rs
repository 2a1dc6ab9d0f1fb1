//! Equation (18) under a linkage, against the energy of the bed, an integration in the crank angle, and the yoke.

use super::*;
use crate::press::bed_motion::{End, Linkage, Slider, StrokeEnd};
use crate::press::buffer::bottom_law::{BottomLaw, ColumnRule};
use crate::press::buffer::crank_law::{CrankLaw, LinkageLaw};
use crate::press::buffer::place_law::PlaceLaw;
use std::f64::consts::FRAC_PI_2;

const RADIUS: f64 = 0.18;
const EXPONENT: f64 = 1.35;
const TOLERANCE: Solver = Solver::Ode { tolerance: 1e-15 };

fn end(rod_ratio: f64, end: End) -> StrokeEnd {
    let slider = Slider { rod_ratio, offset_ratio: 0.0 };
    StrokeEnd::new(Linkage::CrankSlider(slider), RADIUS, end).expect("two reversals")
}

/// The law of a press that compresses to `q` times the ambient pressure.
fn law(end: &StrokeEnd, q: f64, column: ColumnRule) -> PlaceLaw {
    let loading = (q - 1.0) / end.largest_deceleration().value;
    PlaceLaw::new(CrankLaw::Linkage(LinkageLaw::new(loading, EXPONENT, *end, column, 0.0))).expect("in line")
}

fn mechanism(bottom_law: &PlaceLaw, friction_deg: f64, efficiency: f64, exact_on: ExactOn) -> Mechanism {
    Mechanism {
        bottom_law: *bottom_law,
        bottom_arm: 0.3,
        arm_ratio: 1.0,
        delta: FRAC_PI_2,
        friction_angle: friction_deg.to_radians(),
        efficiency,
        model: EfficiencyModel::Consistent,
        exact_on,
    }
}

fn solved(mechanism: &Mechanism) -> Solution {
    Solution::new(mechanism, 1e-15).unwrap_or_else(|wall| panic!("{wall}: {mechanism:?}"))
}

fn ends() -> impl Iterator<Item = StrokeEnd> {
    [1.6, 3.0, 5.0].into_iter().flat_map(|rod_ratio| [end(rod_ratio, End::Outer), end(rod_ratio, End::Inner)])
}

/// Without friction no work is lost: what the bed has lost is in the air, A (x'_a² − x'²)/2 = L/(k−1) [(1 − z/L)^(1−k) − 1] − z with
/// z = x + Δx. That closed form knows neither a(x) nor the differential equation.
#[test]
fn without_friction_the_energy_of_the_bed_is_in_the_air() {
    for of in ends() {
        for column in [ColumnRule::Matched, ColumnRule::Return, ColumnRule::Length(0.4)] {
            let law = law(&of, 2.0, column);
            let solution = solved(&mechanism(&law, 0.0, 1.0, ExactOn::Braking));
            let (length, first) = (law.column(), of.at(0.0).x[1]);
            for i in 4..=40 {
                let [x, speed, ..] = of.at(of.dead() * f64::from(i) / 40.0).x;
                let lost = 0.5 * law.loading() * (first - speed) * (first + speed);
                let z = x + solution.value(x);
                let stored = length / (EXPONENT - 1.0) * libm::expm1((1.0 - EXPONENT) * libm::log1p(-z / length)) - z;
                // d stored/dz is the air force over 2 p0 F.
                let air = libm::expm1(-EXPONENT * libm::log1p(-z / length));
                let off = (stored - lost) / air;
                assert!(off.abs() < 1e-12, "{:?} {column:?} at {x}: {off} m", of.end());
            }
        }
    }
}

/// The slope of (18) as theory has it, by α.
fn slope(mechanism: &Mechanism, decelerated: f64, x: f64, bottom: f64) -> f64 {
    let psi = mechanism.psi(bottom);
    let (theta, arms) = (mechanism.delta + psi, mechanism.arm_ratio * libm::cos(psi));
    let driven = mechanism.bottom_law.loading() * decelerated / mechanism.air(x, bottom) - 1.0;
    let of = |eta: f64| {
        let k = eta / arms * driven;
        let alpha = libm::atan2(k * libm::sin(theta), 1.0 + k * libm::cos(theta)) - mechanism.friction_angle;
        arms * libm::sin(alpha) / libm::sin(theta - alpha)
    };
    let (up, down) = (of(mechanism.efficiency), of(1.0 / mechanism.efficiency));
    if up > 0.0 {
        up
    } else if down < 0.0 {
        down
    } else {
        0.0
    }
}

/// Classical Runge and Kutta in the crank angle, the bed by the crank angle: from a place of the solution to its end.
#[test]
fn an_integration_in_the_crank_angle_has_the_same_bottom() {
    for of in ends() {
        for (column, friction, efficiency) in
            [(ColumnRule::Matched, 3.0, 1.0), (ColumnRule::Return, 6.0, 1.0), (ColumnRule::Matched, 4.0, 0.9)]
        {
            let mechanism = mechanism(&law(&of, 2.0, column), friction, efficiency, ExactOn::Braking);
            let solution = solved(&mechanism);
            // A turn of the bottom is a kink of the slope, which costs the integration its order there.
            let near = if solution.breaks.is_empty() { 1e-11 } else { 1e-8 };
            let by_angle = |crank: f64, bottom: f64| {
                let bed = of.at(crank);
                slope(&mechanism, bed.deceleration()[0], bed.x[0], bottom) * bed.x[1]
            };
            let (from, steps) = (0.2 * of.dead(), 4000);
            let h = (of.dead() - from) / f64::from(steps);
            let mut bottom = solution.value(of.at(from).x[0]);
            for i in 0..steps {
                let at = from + h * f64::from(i);
                let k1 = by_angle(at, bottom);
                let k2 = by_angle(at + 0.5 * h, bottom + 0.5 * h * k1);
                let k3 = by_angle(at + 0.5 * h, bottom + 0.5 * h * k2);
                let k4 = by_angle(at + h, bottom + h * k3);
                bottom += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
                let want = solution.value(of.at(at + h).x[0]);
                assert!((bottom - want).abs() < near, "{:?} {column:?} {friction}: {bottom} is not {want}", of.end());
            }
        }
    }
}

/// What the solution leaves of (18), as it stands, on the way it is solved for; the mean leaves two opposite halves.
#[test]
fn the_forces_balance_on_the_way_they_are_to() {
    for of in ends() {
        for column in [ColumnRule::Matched, ColumnRule::Return] {
            for exact_on in [ExactOn::Braking, ExactOn::Return, ExactOn::Mean] {
                let mechanism = mechanism(&law(&of, 2.0, column), 3.0, 0.95, exact_on);
                let solution = solved(&mechanism);
                let stroke = mechanism.bottom_law.stroke();
                for i in 1..=60 {
                    let x = stroke * f64::from(i) / 60.0;
                    let [bottom, first, ..] = solution.at(x, false);
                    let of_way =
                        |way: BedDirection| mechanism.residual_on(solution.trend(x, false), x, bottom, first, way);
                    let (braking, back) = (of_way(BedDirection::Braking), of_way(BedDirection::Return));
                    let left = match exact_on {
                        ExactOn::Braking => braking,
                        ExactOn::Return => back,
                        ExactOn::Mean if first == 0.0 => continue,
                        ExactOn::Mean => braking + back,
                    };
                    // A a is 1 where it is largest.
                    assert!(left.abs() < 1e-12, "{:?} {column:?} {exact_on:?} at {x}: {left}", of.end());
                }
            }
        }
    }
}

#[test]
fn a_long_rod_has_the_plate_of_a_yoke() {
    for column in [ColumnRule::Matched, ColumnRule::Return] {
        let yoke = BottomLaw::new(1.0 / RADIUS, EXPONENT, RADIUS, column, 0.0);
        let yoke = solved(&mechanism(&yoke.into(), 3.0, 0.95, ExactOn::Braking));
        for which in [End::Outer, End::Inner] {
            let long = solved(&mechanism(&law(&end(1e6, which), 2.0, column), 3.0, 0.95, ExactOn::Braking));
            for i in 0..=40 {
                let x = 0.9999 * RADIUS * f64::from(i) / 40.0;
                let (got, want) = (long.at(x, false), yoke.at(x, false));
                assert!((got[0] - want[0]).abs() < 1e-6, "{which:?} at {x}: {got:?} is not {want:?}");
                assert!((got[1] - want[1]).abs() < 1e-4, "{which:?} at {x}: {got:?} is not {want:?}");
            }
        }
    }
}

/// The paper's own method goes to the same bottom as its steps get smaller.
#[test]
fn stations_meet_the_solution_of_a_linkage() {
    let mechanism = mechanism(&law(&end(3.0, End::Outer), 2.0, ColumnRule::Matched), 3.0, 0.95, ExactOn::Braking);
    let solution = solved(&mechanism);
    let stroke = mechanism.bottom_law.stroke();
    let off = |count: u32| {
        let stations = Stations::new(&mechanism, count).expect("no wall");
        (stations.at(stroke)[0] - solution.value(stroke)).abs()
    };
    let (coarse, fine) = (off(200), off(400));
    assert!(fine < 1e-4 && (coarse / fine - 2.0).abs() < 0.1, "{coarse} {fine}");
}

/// The run-up takes the way that the bed of the linkage has in its crank angle, and ends with the law's slope and curvature.
#[test]
fn a_run_up_lies_along_the_way_of_the_bed() {
    for of in ends() {
        let mechanism = mechanism(&law(&of, 2.0, ColumnRule::Return), 3.0, 0.95, ExactOn::Braking);
        let motion = |transition: Transition| WedgeMotion::new(mechanism, TOLERANCE, transition, 0.03);
        let width = 0.3;
        let run_up = motion(Transition::RunUp { width }).expect("it fits");
        let ramp = run_up.pieces()[1];
        assert_eq!((ramp.start, ramp.end), (of.at(-width).x[0], 0.0));
        let (before, after) = (run_up.bottom(1, 0.0), run_up.bottom(2, 0.0));
        assert!((before.ds - after.ds).abs() < 1e-13 && (before.dds - after.dds).abs() < 1e-10);
        let blend = motion(Transition::Blend { width }).expect("it fits");
        let round = blend.pieces()[1];
        assert_eq!((round.start, round.end), (of.at(-0.5 * width).x[0], of.at(0.5 * width).x[0]));
        for i in 0..=20 {
            let crank = -width + (of.dead() + width) * f64::from(i) / 20.0;
            let [x, speed, slowing, ..] = of.at(crank).x;
            let (first, second) = run_up.pace(x);
            assert!((first - speed).abs() < 1e-7 && (second - slowing).abs() < 1e-13, "{crank}");
        }
        let wide = motion(Transition::RunUp { width: mechanism.bottom_law.before() });
        assert!(wide.expect_err("too wide").what.ends_with("begins before the other end of the stroke"));
        let wide = motion(Transition::Blend { width: 2.0 * of.dead() + 1e-6 });
        assert!(wide.expect_err("too wide").what.ends_with("reaches past the end of the stroke"));
    }
}

/// The force of a roller on a flank at α is the lever's P C cos ρ over sin(θ−α∓ρ), and what the lever loses, by angles.
#[test]
fn the_force_on_the_flank_is_that_of_the_triangle() {
    let mechanism = mechanism(&law(&end(3.0, End::Outer), 2.0, ColumnRule::Return), 6.0, 0.9, ExactOn::Braking);
    let rho = mechanism.friction_angle;
    for (x, bottom) in [(0.02, 0.01), (0.05, -0.02)] {
        let psi = mechanism.psi(bottom);
        let (theta, arms) = (mechanism.delta + psi, mechanism.arm_ratio * libm::cos(psi));
        for alpha in [-0.3, -0.05, 0.1, 0.4] {
            let slope = arms * libm::sin(alpha) / libm::sin(theta - alpha);
            assert!((mechanism.slope_angle(bottom, slope) - alpha).abs() < 1e-14, "{alpha}");
            let side = Mechanism::trend_of(slope);
            // What is braked and rises, or falls on the way back, costs the lever's losses; else they help.
            let (braking, returning) = if alpha > 0.0 { (0.9, 1.0 / 0.9) } else { (1.0 / 0.9, 0.9) };
            for (way, turned, eta) in [(BedDirection::Braking, -rho, braking), (BedDirection::Return, rho, returning)] {
                let lever = mechanism.air(x, bottom) * arms * libm::cos(rho);
                let want = lever / (eta * libm::sin(theta - alpha + turned));
                let got = mechanism.normal_force(side, way, x, bottom, slope);
                assert!((got / want - 1.0).abs() < 1e-13, "{way:?} {alpha}: {got} is not {want}");
            }
        }
    }
}

/// The looser the tolerance, the fewer steps are reported.
#[test]
fn more_digits_take_more_steps() {
    let mechanism = mechanism(&law(&end(3.0, End::Outer), 2.0, ColumnRule::Matched), 3.0, 1.0, ExactOn::Braking);
    let of = |tolerance: f64| Solution::new(&mechanism, tolerance).expect("no wall").steps();
    assert!(1 < of(1e-6) && of(1e-6) < of(1e-15), "{} {}", of(1e-6), of(1e-15));
}

/// A few long steps under a short column: the place where the forces balance lies close before the end of the air, and is found.
#[test]
fn a_station_lies_within_the_column() {
    let (mut tried, mut close) = (0, 0);
    for column in [0.2, 0.21, 0.23, 0.26, 0.3, 0.4] {
        for q in [2.0, 5.0, 40.0, 1000.0] {
            let law = law(&end(3.0, End::Outer), q, ColumnRule::Length(column));
            let mechanism = mechanism(&law, 0.0, 1.0, ExactOn::Braking);
            for count in [1, 2, 3, 5] {
                let Ok(stations) = Stations::new(&mechanism, count) else { continue };
                tried += 1;
                let places: Vec<(f64, f64)> =
                    stations.overruns.iter().copied().zip(stations.bottoms.iter().copied()).collect();
                for pair in places.windows(2) {
                    let [(x0, y0), (x, y)] = pair else { unreachable!("two") };
                    let slope = (y - y0) / (x - x0);
                    let trend = Mechanism::trend_of(slope);
                    let left = mechanism.residual_on(trend, *x, *y, slope, BedDirection::Braking);
                    close += u32::from(x + y > 0.8 * law.column());
                    assert!(x + y < law.column() && left.abs() < 1e-9 * q, "{column} {q} {count} at {x}: {y}, {left}");
                }
            }
        }
    }
    assert!(tried > 20 && close > 5, "{tried} {close}");
}

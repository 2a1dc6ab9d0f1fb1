//! Equation (18): the numbers of the reference plate, error control, extremes, walls, the paper's own method.

use crate::common::random::Random;
use camgen::domains::press::buffer::bottom_law::{BottomLaw, ColumnRule};
use camgen::domains::press::motion::Transition;
use camgen::domains::press::motion::equation_18::{
    BedDirection, EfficiencyModel, ExactOn, Mechanism, Solution, Solver, Stations, Trend, WedgeMotion,
};
use camgen::motion::Motion;
use std::f64::consts::FRAC_PI_2;

fn mechanism(column: ColumnRule, model: EfficiencyModel) -> Mechanism {
    Mechanism {
        bottom_law: BottomLaw::new(1.0 / 0.18, 1.35, 0.18, column, 0.0).into(),
        bottom_arm: 0.3,
        arm_ratio: 1.0,
        delta: FRAC_PI_2,
        friction_angle: 3.0_f64.to_radians(),
        efficiency: 0.95,
        model,
        exact_on: ExactOn::Braking,
    }
}

fn ode(mechanism: &Mechanism, tolerance: f64) -> Solution {
    Solution::new(mechanism, tolerance).unwrap_or_else(|wall| panic!("{wall}: {mechanism:?}"))
}

/// The table of the issue, computed by other programs: digits as printed there.
#[test]
fn the_reference_plate_has_the_reference_motion() {
    use EfficiencyModel::{Consistent, Printed};
    for (column, model, slope, bottoms) in [
        (ColumnRule::Matched, Printed, -0.026_505_77, [-1.135_938_7, -6.924_763_0, -23.751_947_7, -49.214_115_2]),
        (ColumnRule::Matched, Consistent, -0.025_180_94, [-1.151_334_7, -7.199_936_8, -24.872_067_8, -51.537_927_9]),
        (ColumnRule::Return, Printed, 0.319_416_84, [5.799_992_8, 13.928_231_9, 17.788_708_6, 12.323_414_9]),
        (ColumnRule::Return, Consistent, 0.319_416_84, [5.799_992_8, 13.928_231_9, 17.811_421_9, 12.109_540_5]),
    ] {
        let solution = ode(&mechanism(column, model), 1e-15);
        assert!((solution.at(0.0, false)[1] - slope).abs() < 6e-9, "{}", solution.at(0.0, false)[1]);
        for (x, bottom) in [0.02, 0.06, 0.12, 0.18].into_iter().zip(bottoms) {
            let got = 1e3 * solution.value(x);
            assert!((got - bottom).abs() < 6e-8, "{column:?} {model:?} at {x}: {got} is not {bottom}");
        }
    }
}

/// The legal domain of the issue.
fn extreme(random: &mut Random) -> Mechanism {
    let q = 1.0 + random.log_between(1e-4, 49.0);
    let column = if random.next() < 0.4 {
        ColumnRule::Matched
    } else if random.next() < 0.6 {
        ColumnRule::Return
    } else {
        ColumnRule::Length(0.18 * random.log_between(0.5, 20.0))
    };
    let arm_ratio = random.log_between(0.1, 10.0);
    let pick = |random: &mut Random, low: f64, high: f64| match random.next() {
        edge if edge < 0.15 => low,
        edge if edge < 0.3 => high,
        _ => random.between(low, high),
    };
    let (friction, efficiency) = (pick(random, 0.0, 20.0).to_radians(), pick(random, 0.3, 1.0));
    let delta = pick(random, 30.0, 150.0).to_radians();
    let exact_on = [ExactOn::Braking, ExactOn::Return, ExactOn::Mean]
        [usize::from(random.next() < 0.5) + usize::from(random.next() < 0.3)];
    let model = if random.next() < 0.7 { EfficiencyModel::Consistent } else { EfficiencyModel::Printed };
    Mechanism {
        bottom_law: BottomLaw::new((q - 1.0) / 0.18, 1.35, 0.18, column, 0.0).into(),
        bottom_arm: 0.3 * arm_ratio,
        arm_ratio,
        delta,
        friction_angle: friction,
        efficiency,
        model,
        exact_on,
    }
}

/// How a wall begins whose cause is not known.
const UNNAMED: &str = "equation (18) could not be continued";

/// Over the whole legal domain: the balance holds to rounding along the motion, or a wall has been named.
#[test]
fn extremes_balance_or_name_their_wall() {
    let mut random = Random(7);
    let (mut solved, mut walls, mut worst) = (0, std::collections::BTreeMap::new(), 0.0_f64);
    for case in 0..4000 {
        let mechanism = extreme(&mut random);
        if case % 10 == 0 {
            // The paper's own method too: numbers, or a wall with a name.
            match Stations::new(&mechanism, 60) {
                Ok(stations) => assert!(stations.bottoms.iter().all(|bottom| bottom.is_finite()), "{case}"),
                Err(wall) => assert!(!wall.what.starts_with(UNNAMED), "{case}: {wall} {mechanism:?}"),
            }
        }
        match Solution::new(&mechanism, 1e-15) {
            Err(wall) => {
                assert!(!wall.what.starts_with(UNNAMED), "{case}: {wall} {mechanism:?}");
                let text = wall.to_string();
                assert!(!text.contains("NaN") && text.contains("would avoid it"), "{text}");
                *walls.entry(text.split(' ').take(4).collect::<Vec<_>>().join(" ")).or_insert(0) += 1;
            }
            Ok(solution) => {
                solved += 1;
                let load = mechanism.bottom_law.loading() * 0.18;
                for i in 1..=60 {
                    let x = 0.18 * f64::from(i) / 60.0;
                    let [bottom, slope, second, third] = solution.at(x, false);
                    assert!(second.is_finite() && third.is_finite(), "{case}: {mechanism:?}");
                    let residual = |way| mechanism.residual(x, bottom, slope, way) / load;
                    let residual = match mechanism.exact_on {
                        ExactOn::Braking => residual(BedDirection::Braking),
                        ExactOn::Return => residual(BedDirection::Return),
                        ExactOn::Mean if slope == 0.0 => 0.0,
                        ExactOn::Mean => 0.5 * (residual(BedDirection::Braking) + residual(BedDirection::Return)),
                    };
                    // The slope satisfies the equation to rounding; what a rounding of it means in force grows where the
                    // flank is steep, the roller moves along the bed or the arm stands upright.
                    let psi = mechanism.psi(bottom);
                    let sine = libm::sin(mechanism.delta + psi);
                    let sensitivity = (1.0 + slope * slope) / (sine * libm::cos(psi));
                    worst = worst.max(residual.abs() / sensitivity);
                    assert!(residual.abs() < 1e-9 * sensitivity, "{case} at {x}: {residual:e} {slope} {mechanism:?}");
                }
            }
        }
    }
    assert!(solved > 1500, "{solved} solved, {walls:?}, worst {worst:e}");
    println!("{solved} solved, worst residual {worst:e} of P_max; walls: {walls:?}");
}

/// Δx at 20, 60, 120 and 180 mm, m, to twenty digits, by mpmath's Taylor integrator with 40-digit arithmetic from
/// equation (18) as theory states it, with α by the arc tangent.
const TRUTH: [(ColumnRule, EfficiencyModel, [f64; 4]); 3] = [
    (
        ColumnRule::Matched,
        EfficiencyModel::Printed,
        [
            -0.001_135_938_659_406_059_83,
            -0.006_924_763_005_329_394_82,
            -0.023_751_947_719_118_265_9,
            -0.049_214_115_163_350_484_2,
        ],
    ),
    (
        ColumnRule::Return,
        EfficiencyModel::Printed,
        [
            0.005_799_992_801_971_533_97,
            0.013_928_231_898_042_982_9,
            0.017_788_708_584_882_602_6,
            0.012_323_414_910_064_123_1,
        ],
    ),
    (
        ColumnRule::Matched,
        EfficiencyModel::Consistent,
        [
            -0.001_151_334_682_344_414_69,
            -0.007_199_936_775_176_629_55,
            -0.024_872_067_833_320_616_8,
            -0.051_537_927_939_430_784_2,
        ],
    ),
];

#[test]
fn the_error_stays_below_ten_tolerances() {
    for (column, model, truth) in TRUTH {
        for decade in -12..=-3 {
            let tolerance = 1e-3 * libm::pow(10.0, f64::from(decade));
            let solution = ode(&mechanism(column, model), tolerance);
            for (x, bottom) in [0.02, 0.06, 0.12, 0.18].into_iter().zip(truth) {
                let error = (solution.value(x) - bottom).abs();
                assert!(error <= 10.0 * tolerance, "{column:?} {model:?} 1e{decade} mm at {x}: {error:e}");
            }
        }
    }
}

/// Between 1e-3 and 1e-12 mm over random mechanisms, against the solution to 1e-13 mm.
#[test]
fn the_error_stays_below_ten_tolerances_everywhere() {
    let mut random = Random(11);
    for case in 0..150 {
        let mechanism = extreme(&mut random);
        let Ok(fine) = Solution::new(&mechanism, 1e-16) else { continue };
        for decade in [-3, -6, -9, -11] {
            let tolerance = 1e-3 * libm::pow(10.0, f64::from(decade));
            let coarse = ode(&mechanism, tolerance);
            for i in 0..=90 {
                let x = 0.002 * f64::from(i);
                let error = (coarse.value(x) - fine.value(x)).abs();
                assert!(error <= 10.0 * tolerance, "{case} 1e{decade} mm at {x}: {error:e} {mechanism:?}");
            }
        }
    }
}

/// The error of the stations falls as 1/N: 17.7 mm/N with the `return` column.
#[test]
fn stations_converge_to_the_differential_equation() {
    let mechanism = mechanism(ColumnRule::Return, EfficiencyModel::Printed);
    let truth = ode(&mechanism, 1e-15);
    println!("     N   largest error, mm   times N");
    for count in [18, 180, 1800] {
        let stations = Stations::new(&mechanism, count).expect("no wall");
        let pairs = stations.overruns.iter().zip(&stations.bottoms);
        let error = pairs.map(|(x, bottom)| 1e3 * (truth.value(*x) - bottom).abs()).fold(0.0, f64::max);
        println!("{count:>6}   {error:.9}         {:.3}", error * f64::from(count));
        assert!((error * f64::from(count) - 17.7).abs() < 0.15, "{count}: {error}");
    }
}

/// The stations keep to both models, stick where the lever sticks, and follow the other balances.
#[test]
fn stations_agree_in_every_mode() {
    for column in [ColumnRule::Matched, ColumnRule::Return] {
        for model in [EfficiencyModel::Consistent, EfficiencyModel::Printed] {
            for exact_on in [ExactOn::Braking, ExactOn::Return, ExactOn::Mean] {
                let mechanism = Mechanism { exact_on, ..mechanism(column, model) };
                let truth = ode(&mechanism, 1e-14);
                let stations = Stations::new(&mechanism, 2000).expect("no wall");
                let pairs = stations.overruns.iter().zip(&stations.bottoms);
                let error = pairs.map(|(x, bottom)| (truth.value(*x) - bottom).abs()).fold(0.0, f64::max);
                assert!(error < 1.2e-5, "{column:?} {model:?} {exact_on:?}: {error:e}");
            }
        }
    }
}

/// Without friction and loss (18) is P d(x + Δx) = A x dx: the work of the air is that of the inertia, whatever the
/// lever. With s = x + Δx:  L/(k−1) ((L/(L−s))^(k−1) − 1) − s = A x²/2.
#[test]
fn no_friction_and_no_loss_conserves_energy() {
    for column in [ColumnRule::Matched, ColumnRule::Return, ColumnRule::Length(0.3)] {
        for exact_on in [ExactOn::Braking, ExactOn::Return, ExactOn::Mean] {
            let free = Mechanism {
                friction_angle: 0.0,
                efficiency: 1.0,
                exact_on,
                arm_ratio: 0.7,
                delta: 1.1,
                ..mechanism(column, EfficiencyModel::Consistent)
            };
            let solution = ode(&free, 1e-15);
            assert!(solution.breaks.is_empty());
            let (length, k, a) = (free.bottom_law.column(), 1.35, free.bottom_law.loading());
            for i in 1..=90 {
                let x = 0.002 * f64::from(i);
                let s = x + solution.value(x);
                let air = length / (k - 1.0) * libm::expm1(-(k - 1.0) * libm::log1p(-s / length)) - s;
                let inertia = 0.5 * a * x * x;
                assert!((air / inertia - 1.0).abs() < 1e-13 + 1e-16 / inertia, "{x}: {air} {inertia}");
            }
        }
    }
}

/// With `return` and `consistent` the lever rises, sticks and falls; slopes are 0 at both breaks.
#[test]
fn a_sticking_lever_is_published() {
    let solution = ode(&mechanism(ColumnRule::Return, EfficiencyModel::Consistent), 1e-15);
    let [stick, fall] = solution.breaks.as_slice() else { panic!("{:?}", solution.breaks) };
    assert_eq!((stick.then, fall.then), (Trend::Stuck, Trend::Falling));
    assert!(solution.at(stick.x, true)[1].abs() < 1e-15 && solution.at(fall.x, false)[1].abs() < 1e-15);
    let middle = 0.5 * (stick.x + fall.x);
    assert_eq!(solution.at(middle, false)[1], 0.0);
    assert!(stick.x > 0.09 && fall.x - stick.x > 0.001, "{:?}", solution.breaks);
    // Without friction the lever only passes through: one break, where the efficiency changes sides.
    let smooth = Mechanism { friction_angle: 0.0, ..mechanism(ColumnRule::Return, EfficiencyModel::Consistent) };
    let solution = ode(&smooth, 1e-15);
    let sides: Vec<Trend> = solution.breaks.iter().map(|b| b.then).collect();
    assert_eq!(sides, [Trend::Falling]);
}

/// The compromise levels the two directions at every x, and its worst is less than the worst of either exact one.
#[test]
fn the_mean_levels_the_two_directions() {
    for column in [ColumnRule::Matched, ColumnRule::Return] {
        let worst = |exact_on: ExactOn| {
            let mechanism = Mechanism { exact_on, ..mechanism(column, EfficiencyModel::Consistent) };
            let solution = ode(&mechanism, 1e-15);
            let mut worst = 0.0_f64;
            for i in 1..=180 {
                let x = 0.001 * f64::from(i);
                let [bottom, slope, ..] = solution.at(x, false);
                let (braking, back) = (
                    mechanism.residual(x, bottom, slope, BedDirection::Braking),
                    mechanism.residual(x, bottom, slope, BedDirection::Return),
                );
                if exact_on == ExactOn::Mean && slope != 0.0 {
                    assert!((braking + back).abs() < 1e-12, "{x}: {braking} {back}");
                }
                worst = worst.max(braking.abs()).max(back.abs());
            }
            worst
        };
        let (braking, back, mean) = (worst(ExactOn::Braking), worst(ExactOn::Return), worst(ExactOn::Mean));
        assert!(mean < 0.7 * braking.min(back), "{column:?}: {braking} {back} {mean}");
    }
}

/// Walls by name, each with a machine that runs into it.
#[test]
fn walls_are_named() {
    let base = mechanism(ColumnRule::Matched, EfficiencyModel::Printed);
    let short = Mechanism { bottom_arm: 0.03, arm_ratio: 0.1, friction_angle: 0.0, ..base };
    let steep = Mechanism { bottom_arm: 0.03, arm_ratio: 0.1, ..base };
    let stops = |mechanism: &Mechanism, wall: &str| {
        let found = Solution::new(mechanism, 1e-12).expect_err(wall).what;
        assert!(found.starts_with(wall), "{found}");
    };
    stops(&steep, "the slope of the bottom grows without bound");
    stops(&short, "the bottom's arm is used up");
    let flat = Mechanism { bottom_arm: 0.06, arm_ratio: 0.2, delta: 0.55, friction_angle: 0.0, ..base };
    stops(&flat, "the roller moves along the bed's line");
    let none = Mechanism { delta: 0.3, friction_angle: 0.34, ..base };
    stops(&none, "equation (18) has no starting slope");
    let used = Mechanism {
        bottom_law: BottomLaw::new(9.0 / 0.18, 1.35, 0.18, ColumnRule::Matched, 0.0).into(),
        efficiency: 0.3,
        model: EfficiencyModel::Consistent,
        exact_on: ExactOn::Return,
        ..base
    };
    stops(&used, "the air column is used up");
    // What jams or ends for the differential equation does so for the stations, and without friction nothing jams.
    for (delta, column) in [(95.0_f64, ColumnRule::Return), (135.0, ColumnRule::Return), (135.0, ColumnRule::Matched)] {
        let free = Mechanism {
            friction_angle: 0.0,
            delta: delta.to_radians(),
            ..mechanism(column, EfficiencyModel::Consistent)
        };
        let (truth, stations) = (ode(&free, 1e-12), Stations::new(&free, 2000).expect("nothing jams"));
        let error = truth.value(0.18) - stations.bottoms[2000];
        assert!(error.abs() < 2e-5, "{delta} {column:?}: {error}");
    }
    let stopped = |mechanism: &Mechanism| Stations::new(mechanism, 2000).expect_err("a wall").what;
    assert!(stopped(&short).starts_with("the bottom's arm is used up"), "{}", stopped(&short));
    assert!(stopped(&flat).starts_with("the roller moves along the bed's line"), "{}", stopped(&flat));
    for wall in [Stations::new(&short, 100), Stations::new(&none, 100)] {
        let wall = wall.expect_err("a wall");
        assert!(wall.to_string().contains("would avoid it"), "{wall}");
    }
}

/// Value, slope and curvature are continuous from the flat through the run-up into the motion.
#[test]
fn the_run_in_is_smooth() {
    let width = 20.0_f64.to_radians();
    for column in [ColumnRule::Matched, ColumnRule::Return] {
        for transition in [Transition::RunUp { width }, Transition::Blend { width }] {
            let mechanism = mechanism(column, EfficiencyModel::Consistent);
            let law = WedgeMotion::new(mechanism, Solver::Ode { tolerance: 1e-15 }, transition, 0.03).expect("a law");
            assert!(law.slope_jump() == 0.0);
            for (i, pair) in law.pieces().windows(2).enumerate() {
                let (a, b) = (law.jet(i, pair[0].end), law.jet(i + 1, pair[1].start));
                assert!(
                    (a.s - b.s).abs() < 1e-15 && (a.ds - b.ds).abs() < 1e-13,
                    "{column:?} {transition:?} {a:?} {b:?}"
                );
                let slips = pair[1].start > 0.01;
                assert!(slips || (a.dds - b.dds).abs() < 1e-9, "{column:?} {transition:?} {a:?} {b:?}");
            }
        }
    }
    let mechanism = mechanism(ColumnRule::Return, EfficiencyModel::Printed);
    let sharp = WedgeMotion::new(mechanism, Solver::Ode { tolerance: 1e-15 }, Transition::None, 0.03).expect("a law");
    assert!((sharp.slope_jump() - 0.319_416_84).abs() < 1e-8);
}

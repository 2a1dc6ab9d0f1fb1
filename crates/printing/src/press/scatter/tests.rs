//! Figures found with 34 digits outside of the project.

use super::fault::{Fault, FrozenBuffer};
use super::losses::{BedWay, Losses, LossyReversal};
use super::monte_carlo::{self, CUSTOMARY, Distribution, Sampling, number, percentile};
use super::parameter::{HalfWidths, Parameter};
use super::propagation::{self, Corners};
use super::reset::ScrewRule;
use super::settings::{self, FixedBottom};
use crate::press::MachineOfPress;
use crate::press::SpecOfPress;
use crate::press::machine::PressCams;
use crate::press::rotary::rotary;
use camgen_cams::body::disc::Disc;
use camgen_cams::load::Load;
use camgen_cams::machine::Machine;
use camgen_cams::pipeline::Spec;

mod linkages;

fn cam(name: &str) -> FrozenBuffer {
    let machine = Machine::load(name, &[]).expect("valid").0;
    let press = machine.press().expect("a press");
    let law = *press.bottom_law(35.0).of_yoke().expect("a yoke");
    FrozenBuffer::of_cam(&law, &press.cylinder())
}

/// Digits of the printed figures.
fn near(got: f64, golden: f64, what: &str) {
    assert!((got - golden).abs() < 1e-9 * golden.abs(), "{what}: {got} is not {golden}");
}

fn fault(changes: &[(Parameter, f64)]) -> Fault {
    changes.iter().fold(Fault::none(1.35), |fault, (parameter, by)| parameter.changed(fault, *by))
}

const DEFAULTS: HalfWidths = [0.05, 0.03, 0.05, 0.01, 1e-3, 2e-4, 0.01, 0.01, 0.1 * std::f64::consts::PI / 180.0, 1e-4];

fn end(cam: &FrozenBuffer, fault: &Fault) -> (f64, f64) {
    let column = cam.end_reset(fault).expect("a column");
    (1e3 * column, cam.worst(&fault.with_column(column)).expect("it fits").value)
}

#[test]
fn a_machine_that_differs_and_both_settings_of_the_screw() {
    use Parameter::{Exponent, Mass};
    let cases = [
        ("dpi", Exponent, -1_107.169_837, [6.891_746_120, -49.789_305_24], [7.129_964_709, 36.343_014_07]),
        ("dpi", Mass, 1_064.402_785, [-6.390_795_147, 119.728_344_3], [-6.901_680_472, 89.638_032_16]),
        ("dpi-paper", Exponent, -1_634.423_728, [4.994_859_430, -124.335_825_4], [5.304_490_384, 94.042_436_00]),
        ("dpi-paper", Mass, 1_064.402_785, [-3.186_037_711, 187.955_779_1], [-3.608_338_297, 148.737_960_4]),
    ];
    for (name, parameter, built, at_end, level) in cases {
        let (cam, fault) = (cam(name), fault(&[(parameter, 0.05)]));
        near(cam.worst(&fault).expect("it fits").value, built, "as built");
        let (column, left) = end(&cam, &fault);
        near(column, at_end[0], "end column");
        near(left, at_end[1], "after end");
        let column = cam.level_reset(&fault).expect("a column");
        near(1e3 * column, level[0], "level column");
        near(cam.worst(&fault.with_column(column)).expect("it fits").value.abs(), level[1], "after level");
    }
}

#[test]
fn what_the_other_parameters_leave() {
    use Parameter::{AirLost, Ambient, Closing, Speed};
    let cases = [
        ("dpi", Ambient, -0.03, 638.641_670_7, 70.866_868_56),
        ("dpi", Speed, 0.01, 427.889_919_4, 47.109_278_04),
        ("dpi", AirLost, 0.01, 573.769_454_6, 286.884_727_3),
        ("dpi", Closing, 0.01, -425.761_113_8, -212.880_556_9),
        ("dpi-paper", Ambient, -0.03, 638.641_670_7, 111.565_295_3),
        ("dpi-paper", Speed, 0.01, 427.889_919_4, 74.284_696_47),
        ("dpi-paper", AirLost, 0.01, 358.605_909_1, 104.152_381_0),
        ("dpi-paper", Closing, 0.01, -266.100_696_1, -76.672_566_62),
    ];
    for (name, parameter, by, built, after) in cases {
        let (cam, fault) = (cam(name), fault(&[(parameter, by)]));
        let load = cam.end_load();
        near(cam.residual(&fault, load, cam.end_length()), built, name);
        near(end(&cam, &fault).1, after, name);
    }
}

#[test]
fn sensitivities_and_what_the_screw_leaves_of_them() {
    use Parameter::{Column, Exponent, Lead, Mass};
    for (name, column, lead, exponent, variable) in [
        ("dpi", 158_722.229_0, 395_256.181_1, 1_032.798_543, 2_309.190_474),
        ("dpi-paper", 318_882.243_1, 457_874.634_0, 2_580.111_603, 3_652.460_459),
    ] {
        let cam = cam(name);
        near(propagation::sensitivity(&cam, Column), column, name);
        near(propagation::sensitivity(&cam, Lead), lead, name);
        // r_i − r_L r_i(r)/r_L(r), by the forces to first order on a fine scan.
        let half = std::f64::consts::FRAC_PI_2;
        let left = |parameter: Parameter| {
            let share = parameter.first_order(&cam, half) / Column.first_order(&cam, half);
            (0..=20_000)
                .map(|i| half * f64::from(i) / 20_000.0)
                .map(|at| (parameter.first_order(&cam, at) - share * Column.first_order(&cam, at)).abs())
                .fold(0.0, f64::max)
        };
        for (got, golden) in [(left(Exponent), exponent), (left(Mass), variable)] {
            assert!((got / golden - 1.0).abs() < 1e-7, "{name}: {got} {golden}");
        }
    }
}

#[test]
fn several_differences_at_once() {
    use Parameter::{AirLost, Closing, Column, Exponent, Mass};
    let mixed = fault(&[(Exponent, 0.05), (Mass, 0.02), (Column, 4.15e-3)]);
    let [least, largest] = cam("dpi").extremes(&mixed).expect("it fits");
    near(1e3 * largest.at, 10.403_937_13, "the place on dpi");
    near(largest.value, 0.222_023_573_6, "dpi");
    near(1e3 * least.at, 124.079_365_6, "the other place on dpi");
    near(least.value, -6.487_319_835, "dpi");
    let [least, _] = cam("dpi-paper").extremes(&mixed).expect("it fits");
    near(1e3 * least.at, 53.516_450_34, "the place on dpi-paper");
    near(least.value, -10.784_722_43, "dpi-paper");
    let all = fault(&[(AirLost, 0.01), (Closing, 0.01), (Mass, 0.05), (Exponent, 0.05)]);
    for (name, column, port, left) in [
        ("dpi", 0.970_654_423_7, 0.716_939_586_9, 65.845_280_16),
        ("dpi-paper", 2.429_872_350, 0.766_650_894_1, 58.701_073_28),
    ] {
        let cam = cam(name);
        let [longer, early] = cam.reset_of_column_and_port(&all).expect("a column");
        near(1e3 * longer, column, name);
        near(1e3 * early, port, name);
        let set = Fault { column: longer, lead: early, ..all };
        near(cam.worst(&set).expect("it fits").value.abs(), left, name);
        for load in [0.0, cam.end_load()] {
            assert!(cam.residual(&set, load, cam.length(load)).abs() < 1e-9, "nothing is left at either end");
        }
    }
}

#[test]
fn a_phase_error_is_worst_between_the_ends() {
    for (name, force, degrees) in [("dpi", 40.550_586_91, 47.562_512), ("dpi-paper", 41.545_122_42, 54.865_559)] {
        let found = cam(name).largest_phase_force();
        near(found.value * 0.1_f64.to_radians(), force, name);
        assert!((found.at.to_degrees() - degrees).abs() < 1e-6, "{name}: {}", found.at.to_degrees());
    }
}

#[test]
fn worst_case_bound_and_deviation() {
    for (name, weak, strong, bound, deviation) in [
        ("dpi", 4_328.512_267, -3_961.416_635, 4_460.136_598, 1_034.744_104),
        ("dpi-paper", 4_548.714_798, -4_558.286_959, 4_750.794_000, 1_218.092_284),
    ] {
        let cam = cam(name);
        let [least, most] = Corners::new(&cam, &DEFAULTS).worst(&cam).expect("it fits");
        near(most.value, weak, name);
        near(least.value, strong, name);
        near(propagation::linear_bound(&cam, &DEFAULTS), bound, name);
        let of = propagation::variance(&cam, &DEFAULTS, Distribution::Uniform);
        near(of.sqrt(), deviation, name);
    }
}

fn sampling(samples: u32, rule: ScrewRule) -> Sampling {
    Sampling { half_widths: DEFAULTS, distribution: Distribution::Uniform, samples, seed: 1, rule }
}

#[test]
fn percentiles_of_twenty_thousand_presses() {
    assert_eq!((number(1, 0, 0), number(1, 1, 0)), (0.566_561_575_172_281, 0.645_334_640_219_506_2));
    let first = monte_carlo::draw(&cam("dpi"), &sampling(1, ScrewRule::End), 0.0).expect("drawn");
    near(first.as_built[0], 855.718_772_844, "sample 0");
    near(first.reset[0], 242.187_401_817, "sample 0 after its reset");
    for (name, built, reset, fixed) in [
        (
            "dpi",
            [741.752_658_5, 2_050.933_968, 2_544.237_214],
            [187.471_066_5, 418.206_080_0, 486.634_040_8],
            3_657.763_304,
        ),
        (
            "dpi-paper",
            [876.395_802_9, 2_310.876_826, 2_812.611_219],
            [128.313_017_8, 337.204_765_0, 425.836_687_3],
            7_766.446_583,
        ),
    ] {
        let drawn = monte_carlo::draw(&cam(name), &sampling(20_000, ScrewRule::End), 0.0).expect("drawn");
        for (index, q) in [0.5, 0.95, 0.99].into_iter().enumerate() {
            near(percentile(&drawn.as_built, q).expect("samples")[0], built[index], name);
            near(percentile(&drawn.reset, q).expect("samples")[0], reset[index], name);
        }
        near(percentile(&drawn.fixed, 0.95).expect("samples")[0], fixed, name);
    }
}

#[test]
fn the_setting_for_a_lighter_forme_and_the_useful_range() {
    for (name, column, left, fixed, of_fixed, useful) in [
        ("dpi", 279.278_936_8, 285.103_236_5, 482.353_236_2, 1_674.526_566, 0.400_827_876_9),
        ("dpi-paper", 277.409_964_4, 491.146_933_0, 257.788_026_1, 4_473.082_741, 0.278_694_191_8),
    ] {
        let cam = cam(name);
        let setting = FixedBottom::new(&cam).setting(0.8, ScrewRule::Level).expect("a setting");
        near(1e3 * (cam.column + setting.column), column, name);
        near(setting.residual.value.abs(), left, name);
        near(1e3 * setting.fixed_column, fixed, name);
        near(setting.fixed_residual, of_fixed, name);
        near(settings::useful(&cam, ScrewRule::Level).least.expect("a lower end"), useful, name);
    }
}

/// By `end` the residual at the end of the stroke is 0 and the fixed bottom's column is by (7); without a reset both columns stay.
#[test]
fn settings_follow_the_rule_of_the_screw() {
    // What a fixed bottom leaves, computed from its stationary point by a program of its own. Where the air is compressed to five times its pressure, a column
    // that balances the end lets the middle bulge by more than the present one leaves at the end.
    for (name, left_by_none, left_by_end) in
        [("dpi", 4_257.611_138_089, 2_165.931_900_948), ("dpi-paper", 4_498.781_941_194, 5_146.066_519_506)]
    {
        let cam = cam(name);
        let rivals = FixedBottom::new(&cam);
        let end_of = |setting: &settings::Setting| {
            let fault = Fault { square: 0.8, ..Fault::none(1.35) }.with_column(setting.column);
            cam.residual(&fault, cam.end_load(), cam.end_length())
        };
        let [none, end, level] = [ScrewRule::None, ScrewRule::End, ScrewRule::Level]
            .map(|rule| rivals.setting(0.8, rule).expect("a setting"));
        assert!(end_of(&end).abs() < 1e-6 && none.column == 0.0, "{name}: {end:?} {none:?}");
        let worse = |setting: &settings::Setting| setting.residual.value.abs() > level.residual.value.abs();
        assert!(worse(&none) && worse(&end), "{name}: {none:?} {end:?} {level:?}");
        let by_7 = cam.path.stroke() / (1.0 - libm::pow(1.0 + 0.8 * cam.end_load(), -1.0 / 1.35));
        near(end.fixed_column, by_7, "column by (7)");
        near(none.fixed_column, cam.with_fixed_bottom().column, "column without a reset");
        near(none.fixed_residual, left_by_none, "fixed bottom without a reset");
        near(end.fixed_residual, left_by_end, "fixed bottom by the end");
        assert!(level.fixed_residual < left_by_none.min(left_by_end), "{name}: {level:?}");
    }
}

/// The report of a cam and `camgen scatter` agree: P95 found by bounds equals P95 of all presses, to the last digit.
#[test]
fn p95_by_bounds_is_that_of_the_draws() {
    let level = ["buffer.balance=level", "buffer.expansion_exponent=1.40"].map(str::to_owned);
    let levelling = super::analysis::cam_of(&Machine::load("dpi", &level).expect("valid").0, 35.0).expect("a cam").0;
    let linkage = Machine::load("dpi-six-bar", &[]).expect("valid").0;
    let linkage = super::analysis::cam_of(&linkage, 35.0).expect("a cam").0;
    for cam in [cam("dpi"), cam("dpi-paper"), levelling, linkage] {
        for (rule, distribution, friction) in [
            (ScrewRule::End, Distribution::Uniform, 0.0),
            (ScrewRule::Level, Distribution::Normal, 0.0),
            (ScrewRule::None, Distribution::Triangular, 480.0),
        ] {
            for samples in [20, 39, 700] {
                let sampling = Sampling { distribution, ..sampling(samples, rule) };
                let drawn = monte_carlo::draw(&cam, &sampling, friction).expect("drawn");
                let left = monte_carlo::left_in_practice(&cam, &sampling, friction).expect("drawn").expect("enough");
                let of = |sorted: &[f64]| percentile(sorted, 0.95).expect("samples")[0];
                assert_eq!(
                    [left.as_built, left.reset, left.fixed],
                    [&drawn.as_built, &drawn.reset, &drawn.fixed].map(|sorted| of(sorted))
                );
            }
        }
        assert_eq!(monte_carlo::left_in_practice(&cam, &sampling(19, ScrewRule::End), 0.0).expect("drawn"), None);
    }
}

#[test]
fn air_that_does_not_come_back_as_it_went() {
    let reversal =
        |name: &str, losses: &Losses| LossyReversal::new(&cam(name), &Fault::none(1.35), losses).expect("a reversal");
    let expands = Losses { expansion_exponent: Some(1.40), ..Losses::NONE };
    for (name, back, at, work) in
        [("dpi", 539.554_092_5, 0.0, 35.927_003_65), ("dpi-paper", 355.994_071_4, 39.282_479_61, 55.379_502_99)]
    {
        let of = reversal(name, &expands);
        near(of.worst(BedWay::Back).value, back, name);
        // The place of a flat top is known to the root of the rounding.
        assert!((1e3 * of.worst(BedWay::Back).at - at).abs() < 1e-4, "{name}: {:?}", of.worst(BedWay::Back));
        assert!(of.worst(BedWay::In).value.abs() < 1e-9, "exact on the way in");
        near(of.work_lost(), work, name);
    }
    let leaks = Losses { leak: 0.01, ..Losses::NONE };
    for (name, left, back, work) in [
        ("dpi", 0.980_677_775_8, 814.988_203_1, 61.786_015_62),
        ("dpi-paper", 0.980_370_637_3, 475.808_326_8, 45.429_681_45),
    ] {
        let of = reversal(name, &leaks);
        near(of.air_left(), left, name);
        near(of.worst(BedWay::Back).value, back, name);
        near(of.work_lost(), work, name);
    }
    let both = reversal("dpi", &Losses { leak: 0.01, ..expands });
    near(both.worst(BedWay::Back).value, 1_141.129_188, "leak and expansion");
    near(both.work_lost(), 97.600_365_46, "leak and expansion");
}

/// A cam of the matched column that levels the loop of 1.35 and 1.40.
/// A fixed bottom without losses leaves (9); in air with a loop the printed equation of its way back; friction of the bed is added to both.
#[test]
fn a_fixed_bottom_in_the_same_losses() {
    for (name, plain) in [("dpi", 3_185.746), ("dpi-paper", 7_155.125_152_580_8)] {
        let cam = cam(name);
        let of = |losses: Losses| {
            let reversal = LossyReversal::new(&cam, &Fault::none(1.35), &losses).expect("possible");
            let fixed = reversal.with_fixed_bottom().expect("possible");
            [BedWay::In, BedWay::Back].map(|way| fixed.worst(way).value)
        };
        let [on_way_in, back] = of(Losses { expansion_exponent: Some(1.40), ..Losses::NONE });
        assert!((on_way_in / plain - 1.0).abs() < 1e-6 && back > on_way_in, "{name}: {on_way_in} {back}");
        let column = cam.with_fixed_bottom().column;
        let scanned = (0..=20_000).map(|i| {
            let x = cam.path.stroke() * f64::from(i) / 20_000.0;
            let (end, length) = (1.0 - cam.path.stroke() / column, 1.0 - x / column);
            cam.unit_force * (cam.path.loading() * x - libm::pow(end, -1.35) * libm::pow(end / length, 1.40) + 1.0)
        });
        assert!((back / scanned.fold(0.0, f64::max) - 1.0).abs() < 1e-6, "{name}: {back}");
        let train = Losses { train_stiffness: Some(1e8), play: 1e-4, ..Losses::NONE };
        let [none, _] = of(train);
        assert!((none / plain - 1.0).abs() < 1e-6, "no train moves a fixed bottom: {none}");
        let [less, more] = of(Losses { bed_friction: 100.0, ..Losses::NONE });
        assert!((less - (on_way_in - 100.0)).abs() < 1e-3 && (more - (on_way_in + 100.0)).abs() < 1e-3);
    }
}

fn levelled(name: &str) -> Machine {
    let sets = ["buffer.balance=level", "buffer.expansion_exponent=1.40", "buffer.column=matched"].map(str::to_owned);
    Machine::load(name, &sets).expect("valid").0
}

#[test]
fn a_cam_that_levels_both_ways_leaves_half_of_the_loop() {
    for (name, column, lead, half) in [
        ("dpi", 249.749_633_6, 2.306_349_143, 268.303_004_8),
        ("dpi-paper", 63.177_515_76, 1.335_435_437, 177.997_035_7),
    ] {
        let machine = levelled(name);
        let (cam, _) = super::analysis::cam_of(&machine, 35.0).expect("a cam");
        let law = machine.press().expect("a press").rotary_law(35.0).expect("a law");
        near(1e3 * law.column(), column, "the column");
        near(1e3 * law.lead(), lead, "the lead");
        near(cam.unit_force * law.half_loop().expect("a loop").value, half, "half of the loop");
        let reversal =
            LossyReversal::new(&cam, &Fault::none(1.35), &PressCams::of(&machine).losses).expect("a reversal");
        near(reversal.worst(BedWay::In).value, -half, "in");
        near(reversal.worst(BedWay::Back).value, half, "back");
        near(reversal.largest_half_loop().value, half, "half of the loop");
        for degrees in [0.0_f64, 3.0, 30.0, 77.0, 90.0] {
            let [mean, _] = reversal.mean_and_half_loop(degrees.to_radians());
            assert!(mean.abs() < 1e-9, "{name}: {mean} at {degrees}");
        }
        // The disc, its residual force by the pressure of each direction, as it is cut and read back.
        let cut = rotary(&machine, 35.0).expect("a disc");
        near(cut.disc.residual_max().value, half, "the motion");
        assert!((cut.buffer.residual(0, 0.0, 0.0).abs()) < half);
        let proven = Spec::rotary(machine, 35.0).solve().and_then(|cam| cam.draw(5e-6)?.prove()).expect("proven");
        let failed = |found: &&camgen_cams::report::Finding| found.verdict == camgen_cams::report::Verdict::Fail;
        let failed: Vec<&str> = proven.findings().iter().filter(failed).map(|found| &*found.check).collect();
        assert!(name != "dpi" || failed.is_empty(), "{failed:?}");
    }
}

/// The mean of both ways in presses that differ: its extremes against a scan, each effect against a difference of presses.
#[test]
fn presses_that_differ_under_a_cam_that_levels() {
    let (cam, _) = super::analysis::cam_of(&levelled("dpi"), 35.0).expect("a cam");
    let differs = fault(&[(Parameter::Mass, 0.04), (Parameter::Exponent, 0.02), (Parameter::Lead, 3e-4)]);
    let [least, largest] = cam.extremes(&differs).expect("it fits");
    let at = |fault: &Fault, degrees: f64| {
        let load = cam.end_load() * degrees.to_radians().sin();
        cam.residual(fault, load, cam.length(load))
    };
    let scanned: Vec<f64> = (0..=9000).map(|step| at(&differs, f64::from(step) / 100.0)).collect();
    let (low, high) = scanned.iter().fold((f64::MAX, f64::MIN), |(low, high), at| (low.min(*at), high.max(*at)));
    assert!(
        (least.value - low).abs() < 1e-3 && (largest.value - high).abs() < 1e-3,
        "{least:?} {low} {largest:?} {high}"
    );
    for parameter in Parameter::ALL {
        if matches!(parameter, Parameter::Phase | Parameter::Screw) {
            continue;
        }
        for degrees in [0.0, 20.0, 60.0, 90.0] {
            let h = 1e-6;
            let of = |by: f64| at(&parameter.changed(Fault::none(1.35), by), degrees);
            let (quotient, effect) = ((of(h) - of(-h)) / (2.0 * h), parameter.first_order(&cam, degrees.to_radians()));
            // Air gets lost only, and the press of a lower exponent has the wider loop: quotients of both sides are rounded at 1e-10/h.
            assert!(
                (quotient - effect).abs() < 1e-6 * effect.abs() + 1e-3,
                "{parameter:?} at {degrees}: {quotient} {effect}"
            );
        }
    }
    for rule in [ScrewRule::End, ScrewRule::Level] {
        let left = cam.worst(&differs.with_column(cam.setting(&differs, rule).expect("a column"))).expect("it fits");
        assert!(left.value.abs() < cam.worst(&differs).expect("it fits").value.abs());
    }
    let [column, lead] = cam.reset_of_column_and_port(&differs).expect("a column");
    let set = Fault { column, lead, ..differs };
    assert!(at(&set, 0.0).abs() < 1e-6 && at(&set, 90.0).abs() < 1e-6);
}

#[test]
fn what_cannot_be_levelled_is_refused() {
    let of = |sets: &[&str]| {
        let sets: Vec<String> =
            sets.iter().map(|&set| set.to_owned()).chain(["buffer.balance=level".to_owned()]).collect();
        match Machine::load("dpi", &sets) {
            Err(error) => error.to_string(),
            Ok((machine, _)) => {
                let cam = rotary(&machine, 35.0).and_then(|cam| cam.compensating_disc());
                cam.err().map(|why| why.to_string()).expect("refused")
            }
        }
    };
    for (sets, why) in [
        (&[][..], "no lead for this loop"),
        (&["buffer.expansion_exponent=1.35"], "no lead for this loop"),
        (&["buffer.expansion_exponent=1.30"], "expansion exponent below the compression's"),
        (&["buffer.expansion_exponent=1.4", "buffer.lead=1 mm"], "has a lead of its own"),
        (&["buffer.expansion_exponent=1.4", "transition.kind=blend"], "a blend closes the air"),
        (
            &["buffer.expansion_exponent=1.4", "cam.train_stiffness=1e8 N/m", "cam.compensate_train=true"],
            "cut for its train",
        ),
        (
            &["buffer.expansion_exponent=1.4", "compensator.spring_rate=100 N/mm", "compensator.preload=10 kN"],
            "air with a loop",
        ),
    ] {
        let said = of(sets);
        assert!(said.contains(why), "{sets:?}: {said}");
    }
}

#[test]
fn friction_play_and_a_train_that_gives_way() {
    for name in ["dpi", "dpi-paper"] {
        let cam = cam(name);
        let of = |losses: Losses| LossyReversal::new(&cam, &Fault::none(1.35), &losses).expect("a reversal");
        let bed_friction = 0.05 * 978.2 * 9.80665;
        for (piston_friction, largest) in [(0.0, 479.643_251_5), (0.02, 905.404_365_3)] {
            let of = of(Losses { piston_friction, bed_friction, ..Losses::NONE });
            near(of.worst(BedWay::In).value, -largest, name);
            near(of.worst(BedWay::Back).value, largest, name);
            near(of.largest_half_loop().value, largest, name);
        }
        let [alone, with_play] =
            if name == "dpi" { [83.668_287_80, 122.872_857_1] } else { [96.722_723_13, 141.947_853_4] };
        for (play, left) in [(0.0, alone), (1e-4, with_play)] {
            let of = of(Losses { train_stiffness: Some(1e8), play, ..Losses::NONE });
            near(of.residual(BedWay::In, std::f64::consts::FRAC_PI_2), left, name);
        }
    }
}

/// Cut for its train, a cam leaves nothing at its own speed, and its matched column is shorter; the disc rises by m ω² x/c more.
#[test]
fn a_cam_that_is_cut_for_its_train_leaves_nothing() {
    let train = ["cam.train_stiffness=1e8 N/m", "cam.compensate_train=true", "cam.play=0.1 mm"].map(str::to_owned);
    let machine = Machine::load("dpi", &train).expect("valid").0;
    let (cam, _) = super::analysis::cam_of(&machine, 35.0).expect("a cam");
    near(1e3 * cam.column, 242.712_611_2, "the matched column");
    let losses = PressCams::of(&machine).losses;
    let reversal = LossyReversal::new(&cam, &Fault::none(1.35), &losses).expect("a reversal");
    for way in [BedWay::In, BedWay::Back] {
        assert!(reversal.worst(way).value.abs() < 1e-8, "{way:?}: {:?}", reversal.worst(way));
    }
    // Not cut for it, the same column leaves what the train takes.
    let uncut = Losses { is_compensated: false, ..losses };
    let reversal = LossyReversal::new(&cam, &Fault::none(1.35), &uncut).expect("a reversal");
    assert!(reversal.worst(BedWay::In).value > 100.0);
    let disc = rotary(&machine, 35.0).expect("a disc").disc;
    let plain = Machine::load("dpi", &["buffer.column=242.712611192 mm".to_owned()]).expect("valid").0;
    let plain = rotary(&plain, 35.0).expect("a disc").disc;
    let share = 978.2 * (35.0 * 3.0 * std::f64::consts::PI / 30.0_f64).powi(2) / 1e8;
    let lift = |disc: &Disc, angle: f64| {
        let motion = disc.curves().motion;
        let (piece, inside) = motion.locate(angle);
        motion.jet(piece, inside).s
    };
    let from_start = |disc: &Disc, angle: f64| lift(disc, angle) - lift(disc, 0.0);
    for degrees in [20.0_f64, 60.0, 90.0, 140.0] {
        let angle = degrees.to_radians();
        let higher = from_start(&disc, angle) - from_start(&plain, angle);
        let wanted = share * 0.18 * libm::sin(angle);
        assert!((higher - wanted).abs() < 1e-9, "{degrees}: {higher} {wanted}");
    }
    assert!(disc.residual_max().value < 1e-6, "{:?}", disc.residual_max());
    for wrong in [&["cam.compensate_train=true"][..], &["cam.compensate_train=true", "cam.train_stiffness=1e5 N/m"]] {
        let sets: Vec<String> = wrong.iter().map(|&set| set.to_owned()).collect();
        let why = match Machine::load("dpi", &sets) {
            Err(error) => error.to_string(),
            Ok((machine, _)) => rotary(&machine, 35.0).err().map(|why| why.to_string()).expect("refused"),
        };
        assert!(why.contains("unknown stiffness") || why.contains("train too soft"), "{why}");
    }
}

/// Not only where the air is balanced in both directions: without a word the losses would be left out.
#[test]
fn air_that_would_give_work_is_refused_where_it_is_given() {
    let sets = ["buffer.expansion_exponent=1.25".to_owned()];
    let said = Machine::load("dpi", &sets).expect_err("refused").to_string();
    assert!(said.contains("1.25 is below 1.35") && said.contains("give 1.35 or more"), "{said}");
    assert!(said.contains("buffer.expansion_exponent"), "{said}");
}

#[test]
fn losses_that_cannot_be_are_refused() {
    let of =
        |losses: Losses| LossyReversal::new(&cam("dpi"), &Fault::none(1.35), &losses).err().map(|why| why.to_string());
    let gives_work = of(Losses { expansion_exponent: Some(1.3), ..Losses::NONE }).expect("refused");
    assert!(gives_work.starts_with("expansion exponent below the compression's"), "{gives_work}");
    let soft = of(Losses { train_stiffness: Some(1e5), ..Losses::NONE }).expect("refused");
    assert!(soft.starts_with("train too soft"), "{soft}");
    let used_up = cam("dpi").extremes(&fault(&[(Parameter::Column, -0.2)])).expect_err("no air").to_string();
    assert!(used_up.starts_with("column used up"), "{used_up}");
    let no_column = cam("dpi").end_reset(&Fault { closing: 2.0, ..fault(&[(Parameter::Mass, -0.9)]) });
    assert!(no_column.expect_err("none").to_string().starts_with("no column balances the end"));
}

#[test]
fn a_file_without_the_table_has_its_defaults() {
    let of = |sets: &[String]| PressCams::of(&Machine::load("dpi", sets).expect("valid").0).scatter;
    assert_eq!(of(&[]), CUSTOMARY);
    assert_eq!(of(&["scatter.seed=1".to_owned()]), CUSTOMARY);
    assert_eq!(of(&["scatter.mass=8 %".to_owned()]).half_widths[2], 0.08);
    assert_eq!(of(&["scatter.mass=0.08".to_owned()]).half_widths[2], 0.08);
}

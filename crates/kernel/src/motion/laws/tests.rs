//! The contract of every law, and its numbers against arithmetic of 60 digits, tables and closed forms.

use super::law::LawFamily;
use super::*;
use std::f64::consts::{PI, TAU};

/// Values by 60-digit arithmetic, made by another program from textbook formulas and by integrating accelerations.
const REFERENCE: &str = include_str!("reference.txt");

fn law(name: &str) -> &'static Law {
    named(name).unwrap_or_else(|| panic!("no law {name}"))
}

fn solved(name: &str, task: &LawTask) -> LawCurve {
    law(name).solve(task).unwrap_or_else(|error| panic!("{name} {task:?}: {error}"))
}

fn between_rests(name: &str) -> LawCurve {
    solved(name, &LawTask::default())
}

fn moving(velocity: f64) -> SegmentEnd {
    SegmentEnd::Moving { velocity }
}

fn values(curve: &LawCurve, x: f64) -> Values {
    curve.values_at(curve.part_of(x), x)
}

#[track_caller]
fn near(found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance, "{found} is not {wanted}, by {:e}", (found - wanted).abs());
}

/// The task of a law for the contract: between rests where it can.
fn usual(law: &Law) -> LawTask {
    let tasks = [
        LawTask::default(),
        LawTask::between(SegmentEnd::Rest, SegmentEnd::Turn),
        LawTask::between(moving(1.0), moving(1.0)),
    ];
    tasks.into_iter().find(|task| law.serves(task.from, task.to)).expect("a law serves something")
}

/// The largest size of each derivative, on a grid.
fn sizes(curve: &LawCurve) -> Values {
    let mut sizes = [0.0; 4];
    for part in 0..curve.parts() {
        let (low, high) = curve.range_of(part);
        for i in 0..=64 {
            let at = curve.values_at(part, low + (high - low) * f64::from(i) / 64.0);
            for (size, value) in sizes.iter_mut().zip(at) {
                *size = f64::max(*size, value.abs());
            }
        }
    }
    sizes
}

fn jumps(curve: &LawCurve, part: usize, order: u32) -> bool {
    curve.jumps_by(part, order) > 1e-9 * size_of(curve, order)
}

fn end_of(text: &str) -> SegmentEnd {
    match text.split_once(' ') {
        Some(("G", velocity)) => moving(velocity.parse().expect("a velocity")),
        _ if text == "R" => SegmentEnd::Rest,
        _ => SegmentEnd::Turn,
    }
}

/// Every line: 1e-14 of the peak of each derivative; and near an end the relative digits of s.
fn against_reference(text: &str) -> usize {
    let mut count = 0;
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let fields: Vec<&str> = line.split('|').collect();
        let [name, from, to, inflection, x, exact] = fields[..] else { panic!("{line}") };
        let inflection = inflection.parse().map_or(Inflection::Smooth, Inflection::At);
        let task = LawTask { from: end_of(from), to: end_of(to), inflection, ..LawTask::default() };
        let curve = solved(name, &task);
        let x: f64 = x.parse().expect("a place");
        let exact: Vec<f64> = exact.split(' ').map(|value| value.parse().expect("a value")).collect();
        for (order, ((found, exact), size)) in values(&curve, x).iter().zip(&exact).zip(sizes(&curve)).enumerate() {
            let off = (found - exact).abs() / size.max(f64::MIN_POSITIVE);
            assert!(off <= 1e-14, "{line}: derivative {order} is {found}, {off:e} of {size} off");
        }
        let off = (values(&curve, x)[0] / exact[0] - 1.0).abs();
        assert!(off < 1e-13, "{line}: s is off by {off:e} of itself");
        count += 1;
    }
    count
}

#[test]
fn values_keep_their_digits() {
    assert!(against_reference(REFERENCE) >= 5 * LAWS.len());
}

#[test]
fn names_and_aliases_are_found_in_any_case() {
    let mut names: Vec<&str> = LAWS.iter().flat_map(|law| law.aliases.iter().copied().chain([law.name])).collect();
    for name in &names {
        assert!(named(&name.to_uppercase()).is_some(), "{name}");
    }
    names.sort_unstable();
    let all = names.len();
    names.dedup();
    assert_eq!(names.len(), all);
    assert_eq!(law("Bestehorn").name, "cycloidal");
    assert!(named("no such law").is_none());
}

/// Ends met, as many derivatives 0 there as it says, antisymmetric about the middle where it leads from rest to rest, and a
/// grid of derivatives each that of the one before.
#[test]
fn every_law_keeps_the_contract() {
    for law in LAWS {
        let curve = solved(law.name, &usual(law));
        let last = curve.parts() - 1;
        let (start, end) = (curve.values_at(0, 0.0), curve.values_at(last, 1.0));
        assert!(start[0] == 0.0 && end[0] == 1.0, "{}: {start:?} {end:?}", law.name);
        let peak = |order: u32| size_of(&curve, order);
        if law.serves_rests() {
            let rests = |order: &u32| {
                [curve.derivative(0, 0.0, *order), curve.derivative(last, 1.0, *order)]
                    .iter()
                    .all(|value| value.abs() <= 1e-12 * peak(*order))
                    && curve.first_jump(*order).is_none()
            };
            let continuous = u32::try_from((1..6).take_while(rests).count()).expect("few");
            assert_eq!(continuous, law.continuity, "{}", law.name);
        }
        for i in 0..=50 {
            let x = f64::from(i) / 50.0;
            if law.serves_rests() && curve.joints().iter().all(|joint| (x - joint).abs() > 1e-9) {
                let (here, mirrored) = (values(&curve, x), values(&curve, 1.0 - x));
                for (a, b) in [(here[0], 1.0 - mirrored[0]), (here[1], mirrored[1]), (here[2], -mirrored[2])] {
                    near(a, b, 1e-12);
                }
            }
        }
        derivatives_belong_to_each_other(law.name, &curve);
    }
}

fn size_of(curve: &LawCurve, order: u32) -> f64 {
    let places = (0..curve.parts()).flat_map(|part| {
        let (low, high) = curve.range_of(part);
        (0..=13).map(move |i| (part, low + (high - low) * f64::from(i) / 13.0))
    });
    places.map(|(part, x)| curve.derivative(part, x, order).abs()).fold(0.0, f64::max)
}

/// Each derivative up to the sixth against the central difference of the one before, of fourth order in the step h: its error
/// is h⁴/30 of the fifth derivative, and rounding over the step.
fn derivatives_belong_to_each_other(name: &str, curve: &LawCurve) {
    for part in 0..curve.parts() {
        let (low, high) = curve.range_of(part);
        let h = (high - low) / 256.0;
        for (i, order) in (0..=20).flat_map(|i| (0..6).map(move |order| (i, order))) {
            let x = (low + (high - low) * f64::from(i) / 20.0).clamp(low + 2.0 * h, high - 2.0 * h);
            let at = |n: f64| curve.derivative(part, x + n * h, order);
            let by_difference = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * h);
            let exact = curve.derivative(part, x, order + 1);
            let allowed = 2.0 * h.powi(4) / 30.0 * size_of(curve, order + 5) + 1e-14 * size_of(curve, order) / h;
            assert!((exact - by_difference).abs() <= allowed, "{name} at {x}, order {order}: {exact} {by_difference}");
        }
    }
}

/// Peaks as tables of laws give them: Cv, Ca, Cj, C(va), ∫a², η.
#[test]
fn peaks_are_those_of_the_tables() {
    let inf = f64::INFINITY;
    let (cv20, cv33) = ("modified-sine-cv20", "modified-sine-cv33");
    let (cv50, cv66) = ("modified-sine-cv50", "modified-sine-cv66");
    let sine = 4.0 + PI;
    let trapezoid = 2.0 + PI;
    let sine_line = 1.0 / PI + 0.5;
    let none = f64::NAN;
    #[rustfmt::skip]
    let table = [
        ("parabola", [2.0, 4.0, inf, 8.0, 16.0, 1.0]),
        ("cubic", [1.5, 6.0, 12.0, 3.464_102, 12.0, 0.667]),
        ("harmonic", [PI / 2.0, PI * PI / 2.0, 15.503_138, 3.875_785, 12.176, 0.811]),
        ("double-harmonic", [2.040_524, 9.869_604, 42.413_720, 9.894_847, 24.352, none]),
        ("cycloidal", [2.0, TAU, 4.0 * PI * PI, 8.162_097, 19.739, 0.887]),
        ("modified-sine", [4.0 * PI / sine, 4.0 * PI * PI / sine, 16.0 * PI.powi(3) / sine, 5.457_753, 15.279, 0.834]),
        ("modified-trapezoid", [2.0, 8.0 * PI / trapezoid, 32.0 * PI * PI / trapezoid, 8.089_981, 17.920, 0.967]),
        (cv20, [1.527_539, 5.998_630, 94.226, 5.141, 14.393, none]),
        (cv33, [1.404_087, 6.616_604, 124.72, 5.213, 14.593, none]),
        (cv50, [1.275_258, 8.012_683, 201.38, 5.733, 16.051, none]),
        (cv66, [1.168_083, 11.008_926, 415.03, 7.215, 20.199, none]),
        ("cycloidal-cv50", [4.0 / 3.0, 8.0 * PI / 3.0, 105.275_780, 7.255_197, 17.546, 0.521]),
        ("parabola-line", [2.0 / 1.5, 4.0 / 0.75, inf, 7.111, 14.222, 0.75]),
        ("sine-line", [1.0 / sine_line, PI / (0.5 * sine_line), 48.243_848, 4.691_528, 14.739, 0.521]),
        ("3-4-5", [1.875, 10.0 / 3.0_f64.sqrt(), 60.0, 6.694_269, 120.0 / 7.0, 0.823]),
        ("4-5-6-7", [35.0 / 16.0, 84.0 * 5.0_f64.sqrt() / 25.0, 52.5, 10.750_226, 25.455, 0.655]),
        ("5-6-7-8-9", [315.0 / 128.0, 9.371_976, 78.75, 15.435_936, 35.245, 0.482]),
        ("gutman-1-3", [2.0, 5.130_199, 59.217_626, 8.124_858, 18.043, 0.929]),
        ("freudenstein-1-3", [2.0, 5.385_587, 50.757_965, 7.917_472, 18.581, 0.924]),
        ("freudenstein-1-3-5", [2.0, 5.060_283, 59.615_060, 7.850_057, 18.078, 0.941]),
        ("s-curve", [2.0, 16.0 / 3.0, 128.0 / 3.0, 8.888_889, 18.963, 1.0]),
        ("constant-jerk", [2.0, 8.0, 32.0, 8.709_297, 21.333, 1.0]),
    ];
    // What is printed with decimals is rounded there; the rest is a closed form.
    let digits = |value: f64| match value.to_string().split_once('.').map_or(0, |(_, decimals)| decimals.len()) {
        decimals @ 2..=6 => 0.501 * 0.1_f64.powi(i32::try_from(decimals).expect("few")),
        _ => 1e-13 * value,
    };
    for (name, row) in table {
        let curve = solved(name, &usual(law(name)));
        let peaks = curve.peaks();
        let sizes = [&peaks.velocity, &peaks.acceleration, &peaks.jerk, &peaks.torque].map(|peak| peak.value);
        let found = sizes.into_iter().chain([peaks.square, curve.efficiency().expect("no end moves")]);
        for (column, (found, wanted)) in found.zip(row).enumerate() {
            let right = wanted.is_nan() || found == wanted || (found - wanted).abs() <= digits(wanted);
            assert!(right, "{name}, column {column}: {found} is not {wanted}");
        }
    }
}

/// Published and independent values: x, s, s', s'', s''' as far as they are known.
#[test]
fn known_values() {
    #[rustfmt::skip]
    let between_rests_at: [(&str, f64, &[f64]); 9] = [
        ("modified-sine", 0.1, &[0.010_697_212_791_433_88, 0.303_964_009_083_588_9, 5.257_399_593_740_826, 21.466_284_939_537_8]),
        ("modified-trapezoid", 0.3, &[0.160_590_348_672_676, 1.244_406_188_140_663, 4.888_123_762_813_258, 0.0]),
        ("4-5-6-7", 0.3, &[0.126_036, 1.296_54, 7.4088, -8.82]),
        ("triple-harmonic", 0.2, &[0.025_816_114_040_066_18, 0.551_228_757_031_315_7, 8.107_558_743_536_343, 49.655_489_291_700_54]),
        ("freudenstein-1-3-5", 0.15, &[0.027_738_831_997_708_06, 0.495_119_650_536_421_8, 4.984_299_122_654_49, 4.182_629_660_733_969]),
        ("gutman-1-3", 0.15, &[0.028_263_770_861_257_98, 0.508_392_358_244_253_5, 5.129_555_531_306_581, 0.634_788_620_903_982]),
        ("freudenstein-1-3", 0.15, &[0.025_253_988_906_381_29, 0.467_173_382_299_942_1, 5.109_690_457_453_158, 10.307_664_205_524_35]),
        ("3-4-5", 0.5, &[0.5, 1.875]),
        ("cubic", 0.5, &[0.5, 1.5]),
    ];
    for (name, x, wanted) in between_rests_at {
        let curve = between_rests(name);
        for ((found, wanted), size) in values(&curve, x).iter().zip(wanted).zip(sizes(&curve)) {
            near(*found, *wanted, 1e-14 * size);
        }
    }
    let double = solved("double-harmonic", &LawTask::between(SegmentEnd::Rest, SegmentEnd::Turn));
    let wanted = [0.002_969_894_442_375_21, 0.077_726_147_851_252_09, 1.496_336_999_803_818, 18.046_327_244_078_2];
    for (found, wanted) in values(&double, 0.15).into_iter().zip(wanted) {
        near(found, wanted, 1e-13);
    }
    near(double.values_at(0, 1.0)[2], -PI * PI, 1e-14);
    let mirrored = solved("double-harmonic", &LawTask::between(SegmentEnd::Turn, SegmentEnd::Rest));
    near(values(&mirrored, 0.85)[0], 1.0 - wanted[0], 1e-15);
    for (name, peaks) in [("s-curve", [2.0, 16.0 / 3.0, 128.0 / 3.0]), ("constant-jerk", [2.0, 8.0, 32.0])] {
        let found = between_rests(name).peaks();
        for (found, wanted) in [found.velocity, found.acceleration, found.jerk].into_iter().zip(peaks) {
            near(found.value, wanted, 1e-13 * wanted);
        }
    }
}

#[test]
fn known_values_of_scca() {
    let parameters = Parameters { fractions: Some([0.15, 0.25, 0.35, 0.25]), ..Parameters::default() };
    let curve = solved("scca", &LawTask { parameters, ..LawTask::default() });
    let wanted = [0.198_564_718_847_599_4, 1.393_383_782_482_947, 3.343_326_940_716_362, -37.630_888_832_982_18];
    for (found, wanted) in values(&curve, 0.3).into_iter().zip(wanted) {
        near(found, wanted, 1e-14 * 100.0);
    }
    let peaks = curve.peaks();
    near(peaks.velocity.value, 1.523_718_389_209_69, 1e-14);
    near(peaks.acceleration.value, 5.362_280_073_786_791, 1e-14);
    near(peaks.jerk.value, 112.307_331_241_996_8, 1e-12);
}

#[test]
fn known_values_with_an_inflection_and_moving_ends() {
    let at = |task: &LawTask, name: &str, x: f64, wanted: [f64; 3]| {
        let curve = solved(name, task);
        for (found, wanted) in values(&curve, x).into_iter().zip(wanted) {
            near(found, wanted, 1e-14 * wanted.abs().max(1.0));
        }
        curve
    };
    let earlier = LawTask { inflection: Inflection::At(0.4), ..LawTask::default() };
    at(&earlier, "modified-sine", 0.7, [0.859_385_818_462_471_7, 1.099_752_116_221_107, -3.989_459_378_434_157]);
    let moves = LawTask { inflection: Inflection::At(0.45), ..LawTask::between(moving(0.3), moving(0.8)) };
    let wanted = [0.591_856_404_528_360_7, 1.260_583_206_127_209, -0.807_286_543_590_667_3];
    let curve = at(&moves, "modified-sine", 0.6, wanted);
    near(values(&curve, 0.45)[1], 1.322_831_439_030_352, 1e-14);
    let wanted = [0.447_900_923_204_049_8, 1.654_349_868_192_62, 0.683_128_568_486_425_7];
    let curve = at(&LawTask::between(SegmentEnd::Rest, SegmentEnd::Turn), "modified-sine", 0.5, wanted);
    let inflection = curve.inflection().expect("of two halves");
    near(inflection, 2.0 / (2.0 + 3.0_f64.sqrt()), 1e-15);
    near(values(&curve, inflection)[1], 1.666_631_626_593_466, 1e-14);
    near(curve.values_at(curve.parts() - 1, 1.0)[2], -5.640_874_221_901_089, 1e-14);
    assert!(!jumps(&curve, 2, 3) && jumps(&curve, 2, 5), "the jerk is continuous");
    let wanted = [0.209_180_792_563_121_2, 1.185_410_196_624_968, 3.585_398_597_689_867];
    at(&LawTask::between(moving(0.4), moving(0.4)), "cycloidal", 0.3, wanted);
}

/// 30 mm up in 100° to a turn and down in 140° from it: the acceleration at the turn is one.
#[test]
fn an_inflection_matches_the_acceleration_at_a_turn() {
    let up = solved("modified-sine", &LawTask::between(SegmentEnd::Rest, SegmentEnd::Turn));
    let (rise, fall) = (100.0_f64.to_radians(), 140.0_f64.to_radians());
    let at_turn = 30.0 * up.values_at(up.parts() - 1, 1.0)[2] / (rise * rise);
    near(at_turn, -55.553_693_145_823_35, 1e-13);
    let inflection = Inflection::Match { acceleration: at_turn * fall * fall / -30.0 };
    let down = solved("modified-sine", &LawTask { inflection, ..LawTask::between(SegmentEnd::Turn, SegmentEnd::Rest) });
    near(down.inflection().expect("of two halves"), 0.242_903_536_761_422_9, 1e-14);
    near(-30.0 * down.values_at(0, 0.0)[2] / (fall * fall), at_turn, 1e-12);
    let too_slow = LawTask {
        inflection: Inflection::Match { acceleration: -0.1 },
        ..LawTask::between(SegmentEnd::Rest, SegmentEnd::Turn)
    };
    let error = law("cycloidal").solve(&too_slow).expect_err("too slow");
    assert!(error.refusal.what.starts_with("no inflection of cycloidal gives an acceleration of -0.1"), "{error}");
    let no_turn = LawTask { inflection: Inflection::Match { acceleration: -5.0 }, ..LawTask::default() };
    let error = law("cycloidal").solve(&no_turn).expect_err("no turn");
    assert_eq!(error.refusal.what, "an inflection that matches an acceleration needs a turn at one end");
}

#[test]
fn a_polynomial_keeps_given_conditions() {
    let curve = polynomial::hermite(&[0.0, 0.2, 0.0], &[1.0, 0.0, -6.0]);
    for (found, wanted) in values(&curve, 0.4).into_iter().zip([0.286_336, 1.3968, 2.784, -13.2]) {
        near(found, wanted, 1e-14 * wanted.abs().max(1.0));
    }
    // Lists of every length; a bump without travel; values that are not 0 and 1.
    let conditions = [3.0, -0.7, 2.5, 40.0, -90.0];
    let others = [3.0, 1.1, -4.0, 7.0, 200.0];
    for (n, m) in (1..=5).flat_map(|n| (1..=5).map(move |m| (n, m))) {
        let curve = polynomial::hermite(&conditions[..n], &others[..m]);
        let at_ends = conditions[..n].iter().map(|value| (0.0, value)).zip(0..);
        let at_ends = at_ends.chain(others[..m].iter().map(|value| (1.0, value)).zip(0..));
        for ((x, wanted), order) in at_ends {
            near(curve.derivative(0, x, order), *wanted, 1e-11 * wanted.abs());
        }
        assert_eq!(curve.derivative(0, 0.3, u32::try_from(n + m).expect("few")), 0.0);
    }
    assert_eq!(polynomial::hermite(&[], &[1.0]).values_at(0, 1.0)[0], 1.0);
}

/// Numbers in [0, 1) that repeat: Weyl's sequence of the golden ratio.
fn spread(index: u32) -> f64 {
    (f64::from(index) * 0.618_033_988_749_894_8).fract()
}

/// Ends and inflections of every kind: the ends are met, and at every joint value, velocity and, of laws without a jump of
/// their own, acceleration are continuous; at the inflection that is 0.
#[test]
fn random_tasks_are_kept() {
    let (mut solved, mut turned) = (0, 0);
    for case in 0..600 {
        let u = |n: u32| spread(11 * case + n);
        let end = |n: u32| match u(n) {
            rest if rest < 0.33 => SegmentEnd::Rest,
            turn if turn < 0.66 => SegmentEnd::Turn,
            _ => moving(3.0 * u(n + 1) - 1.0),
        };
        let index = usize::try_from(case).expect("few") % LAWS.len();
        let law = &LAWS[index];
        let at = Inflection::At(0.1 + 0.8 * u(4));
        let of_halves = matches!(law.shape, LawFamily::Halves(_));
        let inflection = if of_halves && u(5) > 0.3 { at } else { Inflection::Smooth };
        let from = end(0);
        let to = if u(6) < 0.3 { from } else { end(2) };
        let task = LawTask { from, to, inflection, ..LawTask::default() };
        let curve = match law.solve(&task) {
            Ok(curve) => curve,
            Err(error) if error.refusal.what.starts_with(&format!("{} cannot ", law.name)) => continue,
            Err(error) => panic!("{} {task:?}: {error}", law.name),
        };
        (solved, turned) = (solved + 1, turned + u32::from(task.to == SegmentEnd::Turn));
        let about = format!("{} {task:?}", law.name);
        let (last, sizes) = (curve.parts() - 1, sizes(&curve));
        let ends = [(curve.values_at(0, 0.0), 0.0, task.from), (curve.values_at(last, 1.0), 1.0, task.to)];
        for ([s, velocity, acceleration, _], value, end) in ends {
            assert_eq!(s, value, "{about}");
            assert!((velocity - end.velocity()).abs() <= 1e-14 * sizes[1], "{about}: {velocity}");
            let free = end == SegmentEnd::Turn || law.continuity < 2;
            assert!(free || acceleration.abs() <= 1e-13 * sizes[2], "{about}: {acceleration}");
        }
        for (part, joint) in (1..=last).zip(curve.joints()) {
            let (left, right) = (curve.values_at(part - 1, *joint), curve.values_at(part, *joint));
            let orders = if law.continuity < 2 { 2 } else { 3 };
            for order in 0..orders {
                assert!(
                    (left[order] - right[order]).abs() <= 1e-14 * sizes[order],
                    "{about} at {joint}, {order}: {left:?} {right:?}"
                );
            }
        }
        let peaks = curve.peaks();
        for (peak, size) in [peaks.velocity, peaks.acceleration].into_iter().zip(&sizes[1..]) {
            assert!(peak.value >= *size * (1.0 - 1e-14) && (0.0..=1.0).contains(&peak.at), "{about}: {peaks:?}");
        }
        assert!(curve.joints().is_sorted() && curve.joints().iter().all(|x| 0.0 < *x && *x < 1.0), "{about}");
        if let (Some(inflection), 2) = (curve.inflection(), law.continuity) {
            assert!(values(&curve, inflection)[2].abs() <= 1e-13 * sizes[2], "{about}");
            let middle = values(&curve, inflection)[1];
            assert_eq!(curve.humps(), (middle - task.from.velocity()) * (middle - task.to.velocity()) < 0.0, "{about}");
        }
    }
    assert!(solved > 200 && turned > 40, "{solved} {turned}");
}

#[test]
fn joints_are_where_a_derivative_jumps() {
    let joints = |name: &str| between_rests(name).joints().to_vec();
    for name in ["cycloidal", "harmonic", "3-4-5", "cubic", "gutman-1-3", "triple-harmonic", "freudenstein-1-3-5"] {
        assert!(joints(name).is_empty(), "{name}");
    }
    assert_eq!(joints("modified-sine"), [0.125, 0.875]);
    assert_eq!(joints("modified-trapezoid"), [0.125, 0.375, 0.625, 0.875]);
    assert_eq!(joints("constant-jerk"), [0.25, 0.75]);
    assert_eq!(joints("parabola"), [0.5]);
    assert_eq!(joints("cycloidal-cv50"), [0.25, 0.75]);
    assert_eq!(joints("parabola-line"), [0.25, 0.75]);
    let sum: f64 = joints("modified-sine-cv33").iter().sum();
    near(sum, 2.0, 1e-15);
    for law in LAWS.iter().filter(|law| law.serves_rests()) {
        let curve = between_rests(law.name);
        for part in 1..curve.parts() {
            assert!((0..8).any(|order| jumps(&curve, part, order)), "{} at {part}", law.name);
        }
    }
    // What jumps no sooner than in the fourth derivative stays in one group.
    let groups = |name: &str, order: u32| between_rests(name).smooth_to(order).len();
    assert_eq!((groups("modified-sine", 3), groups("modified-sine", 4)), (1, 3));
    assert_eq!((groups("s-curve", 2), groups("s-curve", 3)), (1, 5));
    assert_eq!((groups("parabola", 1), groups("parabola", 2)), (1, 2));
    assert_eq!(between_rests("parabola").smooth_to(3), [0..1, 1..2]);
}

#[test]
fn what_cannot_be_solved_is_refused() {
    let error = |name: &str, task: LawTask| law(name).solve(&task).expect_err(name);
    let turn = error("gutman-1-3", LawTask::between(SegmentEnd::Rest, SegmentEnd::Turn)).to_string();
    assert!(turn.starts_with("gutman-1-3 cannot end at a turn; laws that can: cycloidal, modified-sine, "), "{turn}");
    assert!(turn.ends_with("double-harmonic"), "{turn}");
    let moves = error("double-harmonic", LawTask::between(moving(0.4), SegmentEnd::Rest)).to_string();
    assert!(moves.contains("cannot start at 0.4 times the segment's mean velocity; laws that can: "), "{moves}");
    assert!(error("line", LawTask::default()).to_string().contains("cannot start and end at rest"));
    let both = error("3-4-5", LawTask::between(moving(0.4), SegmentEnd::Turn)).to_string();
    assert!(both.contains("cannot start at 0.4 times the segment's mean velocity and end at a turn"), "{both}");
    let at = |at: f64| LawTask { inflection: Inflection::At(at), ..LawTask::default() };
    let inflection = error("3-4-5", at(0.4));
    assert_eq!(
        (inflection.input, &*inflection.refusal.what),
        ("inflection", "the inflection of 3-4-5 cannot be chosen")
    );
    for outside in [0.0, 1.0, -0.3, f64::NAN] {
        let text = error("cycloidal", at(outside)).to_string();
        assert_eq!(text, format!("inflection must be at least 0.000001 and at most 0.999999, not {outside}"));
    }
    let infinite = LawTask::between(moving(f64::INFINITY), SegmentEnd::Rest);
    assert_eq!(error("cycloidal", infinite).refusal.what, "a velocity must be a finite number, not inf");
    let usual = Parameters::default();
    #[rustfmt::skip]
    let wrong = [
        ("scca", Parameters { fractions: Some([0.3, 0.3, 0.3, 0.3]), ..usual }),
        ("scca", Parameters { fractions: Some([-0.2, 0.6, 0.3, 0.3]), ..usual }),
        ("scca", Parameters { fractions: Some([0.0, 0.0, 0.0, 1.0]), ..usual }),
        ("scca", Parameters { fractions: Some([1e-200, 0.5, 0.5, 0.0]), ..usual }),
        ("scca", Parameters { fractions: Some([f64::NAN; 4]), ..usual }),
        ("sine-line", Parameters { line: Some(1.0), ..usual }),
        ("s-curve", Parameters { ramp: Some(0.6), ..usual }),
        ("triple-harmonic", Parameters { amplitudes: Some([1.0, 0.0, -3.0]), ..usual }),
        ("triple-harmonic", Parameters { amplitudes: Some([f64::INFINITY, 0.0, 0.0]), ..usual }),
    ];
    for (name, parameters) in wrong {
        let error = error(name, LawTask { parameters, ..LawTask::default() });
        assert!(error.refusal.what.starts_with(&format!("{} must be ", error.input)), "{name}: {error}");
    }
}

/// Amplitudes are scaled to the travel; fractions make other laws.
#[test]
fn parameters_make_other_laws() {
    let with = |name: &str, parameters: Parameters, x: f64| {
        values(&solved(name, &LawTask { parameters, ..LawTask::default() }), x)
    };
    let usual = Parameters::default();
    let triple = with("triple-harmonic", Parameters { amplitudes: Some([0.3, 0.0, 0.0]), ..usual }, 0.2);
    let scca = with("scca", Parameters { fractions: Some([0.25, 0.0, 0.75, 0.0]), ..usual }, 0.2);
    let line = with("parabola-line", Parameters { line: Some(0.0), ..usual }, 0.2);
    let ramp = with("s-curve", Parameters { ramp: Some(0.5), ..usual }, 0.2);
    let like = [("cycloidal", triple), ("modified-sine", scca), ("parabola", line), ("constant-jerk", ramp)];
    for (name, found) in like {
        for (found, wanted) in found.into_iter().zip(values(&between_rests(name), 0.2)) {
            near(found, wanted, 1e-14 * 40.0);
        }
    }
}

/// A law with acceleration of one sign on both sides of the inflection says so.
#[test]
fn two_humps_are_told() {
    let one_way = LawTask::between(SegmentEnd::Rest, moving(2.0));
    assert!(solved("modified-sine", &LawTask { inflection: Inflection::At(0.5), ..one_way }).humps());
    assert!(!solved("modified-sine", &LawTask::between(SegmentEnd::Rest, moving(0.5))).humps());
}

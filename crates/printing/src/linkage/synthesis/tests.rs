//! Golden syntheses, slopes by the links against integrals, and designs at least as good as those printed.

use super::*;
use crate::press::bed_motion::tests::{Random, close, six_bar};
use crate::press::bed_motion::{Characteristics, characteristics, compared};
use camgen_kernel::numeric::quadrature;

fn slider(rod_ratio: f64) -> Slider {
    Slider { rod_ratio, offset_ratio: 0.0 }
}

fn links(linkage: &Linkage) -> DragLink {
    linkage.drag_link().expect("a six-bar")
}

#[track_caller]
fn is_equal(figures: &Characteristics) {
    assert!((figures.acceleration_ratio - 1.0).abs() < 1e-11, "{figures:?}");
}

#[track_caller]
fn is_symmetric(figures: &Characteristics) {
    assert!((figures.time_ratio - 1.0).abs() < 1e-11, "{figures:?}");
}

#[test]
fn golden_equal() {
    let given = DragLink { base: 0.0, coupler: 1.0, follower: 1.1, turn: PI, branch: Branch::Leading };
    let three = equal(given, slider(3.0)).expect("there is one");
    close(links(&three).base, 0.162_383_340_656_47, 1e-13);
    let figures = characteristics(&three);
    close(figures.acceleration(), 5.016_901_073_051, 1e-12);
    close(figures.power.value, 5.975_143_736_601_4, 1e-13);
    close(figures.forward_angle.to_degrees(), 191.181_126_228_83, 1e-13);
    is_equal(&figures);
    let five = equal(given, slider(5.0)).expect("there is one");
    close(links(&five).base, 0.106_945_502_866_882, 1e-12);
    let figures = characteristics(&five);
    close(figures.acceleration(), 4.912_497_210_496_5, 1e-13);
    close(figures.power.value, 4.926_102_761_143_3, 1e-13);
}

/// The paper: "for any λ5, λ6 there is a λ1 with K_c = 1". Not for these links.
#[test]
fn not_every_pair_of_links_is_equal() {
    let given = DragLink { base: 0.0, coupler: 1.5, follower: 0.8, turn: PI, branch: Branch::Leading };
    let error = equal(given, slider(3.0)).expect_err("there is none");
    let numbers: Vec<f64> = error.what.split([' ', ')']).filter_map(|word| word.parse().ok()).collect();
    let [least, least_base, largest] = numbers[..] else { panic!("{error}") };
    assert!(error.what.starts_with("no base makes both largest accelerations equal: their ratio runs from"), "{error}");
    assert!((least - 1.072_44).abs() < 5.1e-6 && (least_base - 0.141_58).abs() < 5.1e-6, "{error}");
    assert!(largest >= 1.911_519, "{error}");
}

#[test]
fn golden_symmetric() {
    let found = symmetric(1.2, 1.2, Branch::Leading, slider(3.6)).expect("there is one");
    close(links(&found).base, 0.129_266_520_845_729_1, 1e-11);
    close(links(&found).turn.to_degrees(), 139.400_883_408_465_1, 1e-11);
    let figures = characteristics(&found);
    close(figures.acceleration(), 4.785_071_733_815_2, 1e-11);
    close(figures.power.value, 4.190_559_826_403_5, 1e-11);
    is_equal(&figures);
    is_symmetric(&figures);
    let beside = compared(&found);
    assert!((beside.acceleration + 0.241_137_01).abs() < 5.1e-9, "{beside:?}");
    assert!((beside.power + 0.168_663_38).abs() < 5.1e-9 && (beside.speed - 0.147_937_69).abs() < 5.1e-9, "{beside:?}");
    let trailing = symmetric(1.2, 1.2, Branch::Trailing, slider(3.6)).expect("its mirror image");
    assert_eq!((links(&trailing).base, links(&trailing).turn), (links(&found).base, -links(&found).turn));
    let offset = Slider { rod_ratio: 4.0, offset_ratio: 0.2 };
    for branch in [Branch::Leading, Branch::Trailing] {
        let figures = characteristics(&symmetric(1.0, 1.1, branch, offset).expect("there is one"));
        is_equal(&figures);
        is_symmetric(&figures);
    }
}

#[test]
fn golden_centric() {
    let three = centric(0.6, 3.0).expect("there is one");
    close(links(&three).base, 0.102_184_020_615_013_6, 1e-12);
    close(links(&three).coupler, 0.806_499_580_947_845, 1e-13);
    let figures = characteristics(&three);
    close(figures.acceleration(), 4.554_830_706_734_38, 1e-12);
    close(figures.power.value, 4.520_330_941_088_22, 1e-12);
    is_symmetric(&figures);
    let five = centric(0.6, 5.0).expect("there is one");
    close(links(&five).base, 0.060_608_739_239_083_72, 1e-12);
    close(characteristics(&five).acceleration(), 4.787_495_437_031_47, 1e-12);
    let [near, far] = three.transmission_angles().expect("a drag link");
    close(near, far, 1e-13);
    assert_eq!(
        centric(1.0, 3.0).expect_err("out of range").to_string(),
        "the follower ratio is 1; it must be between 0 and 1"
    );
}

/// Each value is the integral of its slope along a line of links.
#[test]
fn slopes_by_the_links_are_those_of_the_values() {
    let mut random = Random(13);
    let slider = Slider { rod_ratio: 3.0, offset_ratio: 0.1 };
    for _ in 0..20 {
        let way = [(); 4].map(|()| random.between(-0.004, 0.004));
        let at = |share: f64| {
            let link = DragLink {
                base: 0.12 + share * way[0],
                coupler: 1.0 + share * way[1],
                follower: 1.1 + share * way[2],
                turn: 2.6 + share * way[3],
                branch: Branch::Leading,
            };
            let local = local(&link, &slider);
            // The two peaks of power change places; their sum does not.
            let power = local.power.iter().fold(Dual::constant(0.0), |sum, next| sum + *next);
            [top(&local.outward), top(&local.inward), power, local.forward]
        };
        let along = |dual: Dual| dual.slope.iter().zip(way).map(|(slope, way)| slope * way).sum::<f64>();
        for (n, (before, behind)) in at(0.0).into_iter().zip(at(1.0)).enumerate() {
            let sum = quadrature::integrate(|share| at(share).get(n).map_or(0.0, |dual| along(*dual)), (0.0, 1.0), 1);
            let miss = behind.value - before.value - sum;
            assert!(miss.abs() < 1e-12, "{n}: {sum} {miss}");
        }
    }
}

fn limits(power: Option<f64>, symmetric: bool, link_ratio: f64) -> SynthesisLimits {
    SynthesisLimits { transmission_angle: 45.0_f64.to_radians(), link_ratio, power, symmetric }
}

/// Printed C, none worse by more than 1e-6, every limit kept.
#[test]
fn least_is_not_worse_than_what_is_known() {
    let cases = [
        (3.0, limits(None, true, 0.5), 4.412_629_278_534),
        (3.0, limits(None, false, 0.5), 4.409_315_4),
        (5.0, limits(None, true, 0.5), 4.719_418_350_581),
        (5.0, limits(None, false, 0.5), 4.719_103),
        (3.6, limits(None, true, 0.5), 4.535_935),
        (3.0, limits(Some(0.831), true, 0.5), 4.494_300),
        (3.0, limits(Some(0.831), false, 0.5), 4.478_935),
        (3.6, limits(Some(0.831), false, 0.5), 4.736_428),
        (3.0, limits(None, true, 1.0), 4.694_888),
    ];
    let mut worse = Vec::new();
    for (rod, limits, known) in cases {
        let found = match least(slider(rod), limits) {
            Ok(found) => found,
            Err(error) => {
                worse.push(format!("{rod} {limits:?}: {error}"));
                continue;
            }
        };
        let (figures, link) = (characteristics(&found), links(&found));
        let got = figures.acceleration();
        if got > known + 1.0e-6 {
            worse.push(format!("{rod} {limits:?}: {got}, not {known}"));
        }
        assert!(link.transmission_angles().iter().all(|mu| *mu > limits.transmission_angle - 1e-7));
        assert!(link.coupler.min(link.follower) >= limits.link_ratio - 1e-12);
        if limits.symmetric {
            assert!((figures.forward_angle - PI).abs() < 2e-8, "{figures:?}");
        }
        if let Some(share) = limits.power {
            assert!(compared(&found).power < share - 1.0 + 2e-8);
        }
    }
    assert!(worse.is_empty(), "{}", worse.join("\n"));
}

#[test]
fn least_at_a_corner_of_its_limits_has_the_links_known() {
    let link = links(&least(slider(5.0), limits(None, true, 0.5)).expect("there is one"));
    close(link.base, 0.053_595_262_691_27, 1e-8);
    close(link.coupler, 0.5, 1e-12);
    close(link.follower, 0.638_949_998_602_7, 1e-8);
    close(link.turn.to_degrees(), 212.852_064_392, 1e-8);
    assert!(least(slider(5.0), SynthesisLimits { transmission_angle: 1.6, ..limits(None, true, 0.5) }).is_err());
    let told = least(slider(5.0), limits(Some(0.5), true, 0.5)).expect_err("too little power").to_string();
    assert!(told.contains("nearest"), "{told}");
    let known = six_bar([0.053_595, 0.5, 0.638_95], 212.852_1, 5.0, 0.0);
    assert!((characteristics(&known).acceleration() - 4.719_418).abs() < 1e-4);
}

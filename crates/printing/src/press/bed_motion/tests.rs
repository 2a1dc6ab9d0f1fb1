//! Golden numbers (of 30 to 50 digits), the identities of the kinematics, and derivatives against integrals.

use super::*;

/// SplitMix64 (G. L. Steele et al. 2014), for mechanisms by chance.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// In [low, high).
    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        let bits = u32::try_from((z ^ (z >> 31)) >> 32).expect("32 bits");
        low + (high - low) * (f64::from(bits) / 4_294_967_296.0)
    }

    /// A six-bar that turns, well away from where it locks.
    pub(crate) fn six_bar(&mut self) -> (DragLink, Slider) {
        let offset_ratio = self.between(-0.8, 0.8);
        let slider = Slider { rod_ratio: 1.0 + offset_ratio.abs() + self.between(0.2, 6.0), offset_ratio };
        loop {
            let branch = if self.between(0.0, 1.0) < 0.5 { Branch::Leading } else { Branch::Trailing };
            let drag_link = DragLink {
                base: self.between(0.0, 0.9),
                coupler: self.between(0.2, 3.0),
                follower: self.between(0.2, 3.0),
                turn: self.between(-PI, PI),
                branch,
            };
            if drag_link.check().is_ok() && drag_link.transmission_angles().iter().all(|mu| *mu > 0.2) {
                return (drag_link, slider);
            }
        }
    }
}

pub(crate) fn six_bar(links: [f64; 3], turn_deg: f64, rod_ratio: f64, offset_ratio: f64) -> Linkage {
    let [base, coupler, follower] = links;
    let drag_link = DragLink { base, coupler, follower, turn: turn_deg.to_radians(), branch: Branch::Leading };
    Linkage::six_bar(drag_link, Slider { rod_ratio, offset_ratio }).expect("it turns")
}

/// Relative.
#[track_caller]
pub(crate) fn close(got: f64, want: f64, tolerance: f64) {
    assert!((got / want - 1.0).abs() < tolerance, "{got} is not {want}");
}

#[test]
fn golden_crank_sliders() {
    let of = |rod, offset| characteristics(&Linkage::crank_slider(rod, offset).expect("turns"));
    let three = of(3.0, 0.0);
    close(three.outer_acceleration.value, 6.579_736_267_392_9, 2e-14);
    close(three.inner_acceleration.value, 3.442_149_715_325_7, 2e-14);
    let place = three.inner_acceleration.at.to_degrees();
    let off = (place - 137.612_518_827_59).abs().min((place - (360.0 - 137.612_518_827_59)).abs());
    assert!(off < 1e-10, "{place}");
    close(three.acceleration_ratio, 1.911_519_489_723_9, 2e-13);
    close(three.power.value, 5.364_673_487_464_8, 2e-14);
    let five = of(5.0, 0.0);
    close(five.outer_acceleration.value, 5.921_762_640_653_6, 2e-14);
    close(five.inner_acceleration.value, 3.947_841_760_435_7, 2e-14);
    close(five.power.value, 4.638_366_075_615_2, 2e-14);
    let between = of(3.6, 0.0);
    close(between.outer_acceleration.value, 6.305_580_589_584_9, 2e-14);
    close(between.inner_acceleration.value, 3.571_280_221_370_1, 2e-14);
    close(between.power.value, 5.040_749_697_578_1, 2e-14);
    let offset = of(4.0, 0.3);
    close(offset.stroke, 2.006_029_574_067_3, 3e-14);
    close(offset.outer_acceleration.value, 6.165_078_972_307_2, 2e-14);
    close(offset.inner_acceleration.value, 3.782_409_594_088_8, 2e-14);
    close(offset.power.value, 5.088_035_884_646_9, 2e-14);
    close(offset.forward_angle.to_degrees(), 182.299_357_709_75, 2e-13);
    close(offset.time_ratio, 1.025_879_002_800_6, 2e-13);
}

#[test]
fn golden_six_bars() {
    let g = six_bar([0.15, 1.0, 1.1], 150.0, 3.0, 0.1);
    let theta = 40.0_f64.to_radians();
    let crank = g.crank(theta);
    close(crank.angle, 1.840_031_499_347_474, 1e-15);
    close(crank.first, 1.074_452_375_875_315, 2e-15);
    close(crank.second, -0.199_818_909_857_317_2, 3e-14);
    let want = [
        2.551_895_509_244_78,
        0.936_902_532_502_508_6,
        0.511_963_897_168_740_3,
        -1.151_260_932_951_917,
        -1.067_269_995_667_966,
        3.610_219_073_115_795,
    ];
    for (got, want) in g.position(theta).into_iter().zip(want) {
        close(got, want, 3e-14);
    }
    let figures = characteristics(&g);
    close(figures.outer_acceleration.value, 4.773_888_310_500_60, 3e-14);
    close(figures.outer_acceleration.at.to_degrees(), 159.377_522_785_569, 1e-13);
    close(figures.inner_acceleration.value, 4.718_195_952_537_78, 3e-14);
    close(figures.inner_acceleration.at.to_degrees(), 353.633_117_915_612, 1e-13);
    close(figures.power.value, 4.559_917_798_569_74, 3e-14);
    close(figures.forward_angle.to_degrees(), 181.756_642_566_234, 3e-14);
    let [near, far] = g.transmission_angles().expect("a drag link");
    close(near.to_degrees(), 47.457_542_346_649_2, 3e-14);
    close(far.to_degrees(), 66.208_529_054_528_9, 3e-14);
    let rational = characteristics(&six_bar([0.1, 0.8, 0.6], 180.0, 3.0, 0.0));
    close(rational.outer_acceleration.value, 4.596_204_416_582_2, 1e-13);
    close(rational.inner_acceleration.value, 4.519_792_585_881_9, 1e-13);
    close(rational.power.value, 4.467_893_312_283_2, 1e-13);
    close(rational.forward_angle.to_degrees(), 179.793_695_453_01, 1e-13);
    assert_eq!(rational.zeros.len(), 2);
}

/// The paper's figure 2, recomputed: K_c over the base.
#[test]
fn acceleration_ratios_over_the_base() {
    let wanted = [
        (3.0, [1.911_519, 1.568_521, 1.279_756, 1.047_955, 0.879_799]),
        (5.0, [1.5, 1.242_716, 1.026_536, 0.856_397, 0.741_916]),
    ];
    for (rod, ratios) in wanted {
        for (base, want) in [0.0, 0.05, 0.1, 0.15, 0.2].into_iter().zip(ratios) {
            let got = characteristics(&six_bar([base, 1.0, 1.1], 180.0, rod, 0.0)).acceleration_ratio;
            assert!((got - want).abs() < 5.1e-7, "{rod} {base}: {got}");
        }
    }
}

#[test]
fn a_yoke_is_harmonic_and_the_limit_of_long_rods() {
    let yoke = characteristics(&Linkage::Yoke);
    for got in [yoke.outer_acceleration.value, yoke.inner_acceleration.value] {
        close(got, 0.5 * PI * PI, 1e-15);
    }
    close(yoke.power.value, PI * PI * PI / 8.0, 1e-15);
    close(yoke.velocity.value, FRAC_PI_2, 1e-15);
    assert_eq!((yoke.outer, yoke.inner, yoke.zeros.len()), (0.0, PI, 2));
    assert_eq!(compared(&Linkage::Yoke), LinkageComparison { acceleration: 0.0, power: 0.0, speed: 0.0 });
    let long = Linkage::crank_slider(1e6, 0.0).expect("turns");
    for degrees in 0..360 {
        let theta = f64::from(degrees).to_radians();
        let (mut far, near) = (long.position(theta), Linkage::Yoke.position(theta));
        far[0] -= 1e6;
        // −sin² β/(2 λ5) and its derivatives, of which the fifth is 8/λ5 at most; λ5 itself is kept to 1e-10.
        for (far, near) in far.into_iter().zip(near) {
            assert!((far - near).abs() < 8.5e-6, "{degrees}°: {far} {near}");
        }
    }
}

/// λ6 = 0: C⁺ = (π²/2)(1 + 1/λ5) always; C⁻ = (π²/2)(1 − 1/λ5) and K_c = (λ5 + 1)/(λ5 − 1) from λ5 = (3 + √21)/2.
#[test]
fn closed_forms_of_a_centric_crank_slider() {
    let mut random = Random(3);
    let limit = 0.5 * (3.0 + 21.0_f64.sqrt());
    for _ in 0..300 {
        let rod = random.between(1.3, 12.0);
        let figures = characteristics(&Linkage::crank_slider(rod, 0.0).expect("turns"));
        close(figures.outer_acceleration.value, 0.5 * PI * PI * (1.0 + 1.0 / rod), 3e-14);
        let inner = 0.5 * PI * PI * (1.0 - 1.0 / rod);
        if rod > limit {
            close(figures.inner_acceleration.value, inner, 1e-13);
            close(figures.acceleration_ratio, (rod + 1.0) / (rod - 1.0), 1e-13);
        } else {
            assert!(figures.inner_acceleration.value >= inner, "{rod}");
        }
    }
}

/// 10 000 mechanisms: loops close, slopes at the base are 1/(1 ∓ λ1), dead points are at rest with the stroke between them,
/// the series of ψ is that of two derivatives in closed form, and the mirror image moves alike.
#[test]
fn identities_hold_for_mechanisms_by_chance() {
    let mut random = Random(1997);
    for _ in 0..10_000 {
        let (drag_link, slider) = random.six_bar();
        let linkage = Linkage::six_bar(drag_link, slider).expect("turns");
        let told = || format!("{linkage:?}");
        let worst = drag_link.transmission_angles().into_iter().fold(FRAC_PI_2, f64::min);
        let loose = 1.0 / libm::pow(libm::sin(worst), 4.0) / (1.0 - drag_link.base).powi(2);
        assert!((linkage.crank(0.0).first * (1.0 - drag_link.base) - 1.0).abs() < 1e-14 * loose, "{}", told());
        assert!((linkage.crank(PI).first * (1.0 + drag_link.base) - 1.0).abs() < 1e-14 * loose, "{}", told());
        let theta = random.between(-7.0, 7.0);
        identities_at(&linkage, drag_link, slider, theta, loose);
        let [outer, inner] = linkage.dead_points();
        let ([top, top1, top2, ..], [low, low1, ..]) = (linkage.position(outer), linkage.position(inner));
        assert!(top1.abs() < 1e-14 * loose && low1.abs() < 1e-14 * loose, "{}: {top1} {low1}", told());
        assert!((top - low - linkage.stroke()).abs() < 1e-14 * (1.0 + slider.rod_ratio), "{}", told());
        let first = linkage.crank(outer).first;
        let beta = slider.dead_points()[0];
        let want = -(slider.rod_ratio + 1.0) / (slider.rod_ratio * libm::cos(beta)) * first * first;
        assert!((top2 / want - 1.0).abs() < 1e-12 * loose, "{}: {top2} {want}", told());
        let mirrored = Linkage::SixBar(
            DragLink {
                turn: -drag_link.turn,
                branch: if drag_link.branch == Branch::Leading { Branch::Trailing } else { Branch::Leading },
                ..drag_link
            },
            Slider { offset_ratio: -slider.offset_ratio, ..slider },
        );
        let (x, y) = (linkage.position(theta), mirrored.position(-theta));
        assert_eq!((x[0], x[1], x[2], x[5]), (y[0], -y[1], y[2], -y[5]), "{}", told());
    }
}

fn identities_at(linkage: &Linkage, drag_link: DragLink, slider: Slider, theta: f64, loose: f64) {
    let distance = |a: [f64; 2], b: [f64; 2]| libm::hypot(a[0] - b[0], a[1] - b[1]);
    let pose = Pose { base_angle: 0.4, crank_ratio: 0.7 };
    let joints = linkage.joints(theta, pose);
    let places = joints.drag_link.expect("a drag link");
    let lengths = [
        (distance(places.shaft, [0.0; 2]), drag_link.base / 0.7),
        (distance(places.shaft, places.driving), 1.0 / 0.7),
        (distance(places.driving, places.driven), drag_link.coupler / 0.7),
        (distance(places.driven, [0.0; 2]), drag_link.follower / 0.7),
        (distance(joints.crank, joints.slider), slider.rod_ratio),
    ];
    assert!(lengths.iter().all(|(got, want)| (got - want).abs() < 1e-13 * loose), "{linkage:?}: {lengths:?}");
    let x = linkage.position(theta)[0];
    assert_eq!(joints.slider, [x, slider.offset_ratio]);
    assert!(linkage.rod_angle(theta).abs() <= linkage.largest_rod_angle() * (1.0 + 1e-14));
    close(linkage.rod_angle(linkage.steepest_rod()).abs(), linkage.largest_rod_angle(), 1e-6);
    // Law of cosines at B.
    let mu = drag_link.transmission_angle(theta);
    let [near, far] = drag_link.transmission_angles();
    assert!(mu >= near.min(far) - 1e-12 && mu <= FRAC_PI_2);
    // ψ' = r·A'/(r·B_ψ) and ψ'' with r = B − A.
    let crank = linkage.crank(theta);
    let (c, s) = (libm::cos(theta), libm::sin(theta));
    let (cp, sp) = (libm::cos(crank.angle), libm::sin(crank.angle));
    let l = drag_link.follower;
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let r = [drag_link.base + l * cp - c, l * sp - s];
    let (slope, arm) = ([-l * sp, l * cp], [-s, c]);
    let first = dot(r, arm) / dot(r, slope);
    let q = [first * slope[0] - arm[0], first * slope[1] - arm[1]];
    let turned = [-l * first * first * cp + c, -l * first * first * sp + s];
    let second = -(dot(r, turned) + dot(q, q)) / dot(r, slope);
    assert!((crank.first - first).abs() < 1e-13 * loose, "{linkage:?} {theta}: {} {first}", crank.first);
    assert!((crank.second - second).abs() < 1e-12 * loose, "{linkage:?} {theta}: {} {second}", crank.second);
}

/// Each derivative is the integral of the next: Gauss of eight points in panels over a stretch.
#[test]
fn derivatives_are_integrals_of_the_next() {
    let mut random = Random(5);
    for _ in 0..500 {
        let (drag_link, slider) = random.six_bar();
        let linkage = Linkage::SixBar(drag_link, slider);
        let low = random.between(-4.0, 4.0);
        let high = low + 0.5;
        let (before, behind) = (linkage.position(low), linkage.position(high));
        for n in 0..5 {
            let sum =
                camgen_kernel::numeric::quadrature::integrate(|theta| linkage.position(theta)[n + 1], (low, high), 16);
            let size = 1.0 + before[n + 1].abs().max(behind[n + 1].abs());
            let miss = behind[n] - before[n] - sum;
            assert!(miss.abs() < 1e-9 * size, "{linkage:?} {n}: {miss}");
        }
    }
}

#[test]
fn figures_bound_what_a_turn_shows() {
    let mut random = Random(7);
    for _ in 0..100 {
        let (drag_link, slider) = random.six_bar();
        let linkage = Linkage::SixBar(drag_link, slider);
        let figures = characteristics(&linkage);
        assert!(figures.zeros.len() >= 2 && figures.zeros.len().is_multiple_of(2), "{linkage:?}");
        let normal = PI * PI / figures.stroke;
        for step in 0..720 {
            let m = linkage.position(f64::from(step) * TAU / 720.0);
            let bounds = [
                (-normal * m[2], figures.outer_acceleration.value),
                (normal * m[2], figures.inner_acceleration.value),
                (PI * normal / figures.stroke * (m[1] * m[2]).abs(), figures.power.value),
                (PI / figures.stroke * m[1].abs(), figures.velocity.value),
            ];
            assert!(bounds.iter().all(|(at, most)| *at <= most * (1.0 + 1e-12)), "{linkage:?} {step}: {bounds:?}");
        }
        for zero in &figures.zeros {
            assert!(linkage.position(*zero)[2].abs() < 1e-9, "{linkage:?} {zero}");
        }
    }
}

#[test]
fn refusals_tell_what_would_pass() {
    let error = Linkage::crank_slider(1.2, -0.4).expect_err("too short");
    assert_eq!(error.what, "the rod is 1.2 cranks long and its line passes -0.4 cranks from the shaft");
    let remedy = format!("the rod ratio must be above 1.4, or the offset ratio within ±{}", 1.2 - 1.0);
    assert_eq!(error.remedy.map(|own| own.to_string()), Some(remedy));
    assert!(Linkage::crank_slider(1.400_001, -0.4).is_ok() && Linkage::crank_slider(1.2, 0.199_999).is_ok());
    assert!(Linkage::crank_slider(f64::NAN, 0.0).is_err() && Linkage::crank_slider(3.0, f64::INFINITY).is_err());
    let drag_link = |base, coupler, follower| DragLink { base, coupler, follower, turn: 0.0, branch: Branch::Leading };
    let what = |base, coupler, follower| drag_link(base, coupler, follower).check().expect_err("does not turn").what;
    assert_eq!(what(1.0, 2.0, 2.0), "the base is 1 driving cranks long, and must be shorter than the crank");
    assert_eq!(what(-0.1, 2.0, 2.0), "the base ratio is -0.1");
    assert_eq!(what(0.3, 2.0, 1.2), "coupler 2 and follower 1.2 differ by 1 − the base 0.3 or more");
    assert_eq!(what(0.3, 0.6, 0.7), "coupler 0.6 and follower 0.7 do not reach over 1 + the base 0.3");
    let mut random = Random(11);
    for _ in 0..2000 {
        let bad = drag_link(random.between(0.0, 1.2), random.between(0.1, 2.5), random.between(0.1, 2.5));
        if bad.check().is_ok() {
            continue;
        }
        let remedies = bad.remedies();
        let ways: [(Passing, &dyn Fn(f64) -> DragLink); 3] = [
            (remedies.base, &|base| DragLink { base, ..bad }),
            (remedies.coupler, &|coupler| DragLink { coupler, ..bad }),
            (remedies.follower, &|follower| DragLink { follower, ..bad }),
        ];
        for (passing, mended) in ways {
            let width = passing.below - passing.above;
            if width > 1e-9 {
                for value in [passing.above + 1e-6 * width, passing.below - 1e-6 * width] {
                    assert!(mended(value).check().is_ok(), "{bad:?} {passing:?}");
                }
                assert!(mended(passing.below + 1e-6 * width).check().is_err(), "{bad:?} {passing:?}");
            } else {
                assert!(passing.to_string().contains("no length"), "{passing}");
            }
        }
    }
}

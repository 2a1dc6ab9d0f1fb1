//! The general balance against 50-digit arithmetic, against the yoke's own form, and against the energy of the bed.

use super::*;
use crate::press::bed_motion::tests as linkage;
use crate::press::bed_motion::{Branch, DragLink, End, Linkage, Slider};
use crate::press::buffer::tests::Random;
use crate::press::buffer::{Bed, Cylinder};
use camgen_kernel::numeric::quadrature;

const MASS: f64 = 978.2;
const RADIUS: f64 = 0.18;
const AMBIENT: f64 = 98_066.5;

fn bed() -> Bed {
    Bed { mass: MASS, crank_radius: RADIUS, crank_turns_per_main_shaft_turn: 3.0 }
}

/// A crank-slider, or a six-bar, of any size.
fn random_linkage(random: &mut Random, mechanisms: &mut linkage::Random) -> Linkage {
    let (drag_link, slider) = mechanisms.six_bar();
    if random.between(0.0, 1.0) < 0.3 { Linkage::CrankSlider(slider) } else { Linkage::SixBar(drag_link, slider) }
}

fn crank_slider(rod_ratio: f64) -> Linkage {
    Linkage::CrankSlider(Slider { rod_ratio, offset_ratio: 0.0 })
}

/// The law of the embedded press with this linkage, end and column, at 2 at.
fn law(linkage: Linkage, end: End, column: ColumnRule) -> (Cylinder, LinkageLaw) {
    let end = StrokeEnd::new(linkage, RADIUS, end).expect("two reversals");
    let cylinder = Cylinder::sized_for(&bed(), end.largest_deceleration().value, 35.0, 1.35, AMBIENT, 2.0 * AMBIENT);
    (cylinder, LinkageLaw::new(cylinder.loading(35.0), 1.35, end, column, 0.0))
}

/// All digits that the reference prints, 15, and a few ulp.
fn close(got: f64, want: f64) {
    assert!((got / want - 1.0).abs() < 4e-14, "{got} is not {want}");
}

/// linkage.md, golden number 12.
#[test]
fn a_crank_slider_has_the_known_law() {
    let (cylinder, outer) = law(crank_slider(4.0), End::Outer, ColumnRule::Matched);
    close((outer.end.start() - 2.0 * PI).to_degrees(), -76.720_977_918_614_6);
    let start = outer.end.at(0.0);
    close(start.x[1], 0.185_558_885_732_065);
    close(start.deceleration()[1], 0.218_515_568_173_733);
    close(cylinder.piston_area, 0.135_673_597_064_531);
    close(bed().inertia(35.0, outer.end.largest_deceleration().value), 26_610.069_613_057_6);
    close(outer.column, 0.257_938_196_404_855);
    close(outer.at(outer.end.dead())[0], -0.056_713_528_289_802_4);
    let quarter = outer.at(0.25 * outer.end.angle());
    let known = [-0.030_659_610_924_042_1, -0.065_044_916_398_151_5, 0.022_213_954_035_397_4, 0.321_753_566_873_049];
    for (got, want) in quarter.into_iter().zip(known) {
        close(got, want);
    }
    let (_, back) = law(crank_slider(4.0), End::Outer, ColumnRule::Return);
    close(back.column, 0.399_168_399_349_59);
    let (x, largest) = CrankLaw::Linkage(back).largest_displacement();
    close(largest, 0.018_511_219_768_44);
    assert!(back.at(back.end.dead())[0].abs() < 1e-16, "back at the dead point");
    // Its place, −53.3814207574012°, through the overrun there: flat, so that half of the digits are left.
    let angle = (-53.381_420_757_401_2_f64).to_radians() + 2.0 * PI - back.end.start();
    assert!((back.end.at(angle).x[0] - x).abs() < 1e-9);
    let (_, inner) = law(crank_slider(4.0), End::Inner, ColumnRule::Matched);
    close(inner.column, 0.154_762_917_842_913);
    close(inner.at(inner.end.dead())[0], -0.137_558_916_059_21);
}

/// linkage.md, golden number 13.
#[test]
fn a_six_bar_has_the_known_law() {
    let drag_link =
        DragLink { base: 0.13, coupler: 1.2, follower: 1.2, turn: 140.0_f64.to_radians(), branch: Branch::Leading };
    let six_bar = Linkage::SixBar(drag_link, Slider { rod_ratio: 3.6, offset_ratio: 0.0 });
    let (_, law) = law(six_bar, End::Outer, ColumnRule::Matched);
    let end = &law.end;
    close(end.start().to_degrees(), 62.624_565_756_755);
    close((end.start() + end.dead()).to_degrees(), 154.979_203_576_958);
    close((end.start() + end.angle()).to_degrees(), 244.015_475_432_253);
    close(end.largest_deceleration().value, 0.174_151_047_874_375);
    close(law.column, 0.212_884_276_613_628);
    close(end.overrun_at_end(), 0.007_165_985_446_415_74);
    let after = end.at(end.angle());
    let at_end = law.loading * law.column * after.deceleration()[1] / (1.35 * after.x[1]);
    close(at_end, 1.003_102_370_831_29);
    let quarter = 0.25 * end.angle();
    let bed = end.at(quarter);
    close(bed.x[0], 0.129_873_831_771_46);
    close(bed.deceleration()[0], 0.125_762_888_146_477);
    close(law.at(quarter)[0], -0.059_313_020_226_145_9);
    close(law.at(quarter)[1], -0.090_573_756_001_912_3);
    close(law.at(3.0 * quarter)[0], -0.061_868_827_924_745_4);
    close(law.at(3.0 * quarter)[1], 0.086_168_282_552_840_5);
}

/// The yoke through the general form is the yoke in its own, to a few ulp of the column.
#[test]
fn the_general_form_of_a_yoke_is_its_own_form() {
    for end in [End::Outer, End::Inner] {
        for column in [ColumnRule::Matched, ColumnRule::Return, ColumnRule::Length(0.3)] {
            let (cylinder, general) = law(Linkage::Yoke, end, column);
            let yoke = BottomLaw::new(cylinder.loading(35.0), 1.35, RADIUS, column, 0.0);
            let own = CrankLaw::Yoke(yoke);
            for i in 0..=720 {
                let angle = PI * f64::from(i) / 720.0;
                let (x, x1) = (RADIUS * libm::sin(angle), RADIUS * libm::cos(angle));
                let bottom = yoke.bottom(x, RADIUS - x);
                let by_crank = [bottom.value, bottom.slope * x1, bottom.second * x1 * x1 - bottom.slope * x];
                let (bed, _, found) = general.travels(angle);
                for (got, want) in found.into_iter().zip(by_crank).chain(bed.into_iter().zip([x, x1, -x])) {
                    assert!((got - want).abs() < 2e-15, "{end:?} {column:?} at {angle}: {got} {want}");
                }
                let fixed = CrankLaw::Linkage(general).air_of_fixed_bottom(angle);
                assert!((fixed - own.air_of_fixed_bottom(angle)).abs() < 1e-14, "{fixed}");
            }
            let general = CrankLaw::Linkage(general);
            close(general.column(), own.column());
            close(general.residual_of_fixed_bottom().value, own.residual_of_fixed_bottom().value);
            let (left, right) = (general.largest_displacement().1, own.largest_displacement().1);
            assert!((left - right).abs() < 1e-15, "{left} {right}");
        }
        let (cylinder, general) = law(Linkage::Yoke, end, ColumnRule::Matched);
        // press.md: the column of least torque, by a flat top, so that half of the digits are left.
        let least = least_torque_column(cylinder.loading(35.0), 1.35, &general.end);
        let own = crate::press::buffer::camshaft::least_torque_column(cylinder.loading(35.0), 1.35, RADIUS);
        assert!((least / own - 1.0).abs() < 1e-7, "{least} {own}");
    }
}

/// A long rod meets the yoke: the first term that the rod adds is r/(4 λ5) in 2θ, whose sixth derivative, the highest that the fourth
/// of the law has, is 16 r/λ5; the law multiplies it by at most κ and a slope of order 1.
#[test]
fn a_long_rod_meets_the_yoke() {
    let (cylinder, yoke) = law(Linkage::Yoke, End::Outer, ColumnRule::Matched);
    assert!(cylinder.piston_area > 0.0);
    for rod in [1e2, 1e4, 1e6] {
        for end in [End::Outer, End::Inner] {
            let (_, long) = law(crank_slider(rod), end, ColumnRule::Matched);
            close(long.end.largest_deceleration().value, RADIUS * (1.0 + end_sign(end) / rod));
            for share in [0.1, 0.3, 0.5, 0.9] {
                let (a, b) = (yoke.at(share * PI), long.at(share * long.end.angle()));
                for (yoke, long) in a.into_iter().zip(b) {
                    assert!((yoke - long).abs() < 16.0 / rod, "{rod} {end:?} at {share}: {yoke} {long}");
                }
            }
        }
    }
}

fn end_sign(end: End) -> f64 {
    if end == End::Outer { 1.0 } else { -1.0 }
}

/// Each derivative against the central difference of the one before, of fourth order in the step: h⁴/30 of a derivative five orders
/// on, and rounding over h.
#[test]
fn derivatives_belong_to_their_values() {
    let (mut random, mut mechanisms) = (Random(17), linkage::Random(17));
    let h = 1e-4;
    for _ in 0..200 {
        let linkage = random_linkage(&mut random, &mut mechanisms);
        let end = if random.between(0.0, 1.0) < 0.5 { End::Outer } else { End::Inner };
        let Some(end) = StrokeEnd::new(linkage, RADIUS, end) else { continue };
        let loading = random.of_size(0.1, 100.0) / end.largest_deceleration().value;
        for column in [ColumnRule::Matched, ColumnRule::Return, ColumnRule::Length(0.3)] {
            let law = LinkageLaw::new(loading, 1.35, end, column, 0.01);
            for i in 1..20 {
                let angle = end.angle() * f64::from(i) / 20.0;
                let at = |n: f64| law.at(angle + n * h);
                let here = law.at(angle);
                let scale: f64 = here.iter().map(|value| value.abs()).sum::<f64>() * (1.0 + loading);
                for order in 0..4 {
                    let by_difference =
                        (8.0 * (at(1.0)[order] - at(-1.0)[order]) - (at(2.0)[order] - at(-2.0)[order])) / (12.0 * h);
                    let error = (here[order + 1] - by_difference).abs();
                    assert!(
                        error < 1e-6 * scale,
                        "{linkage:?} {column:?} at {angle}, order {order}: {error} of {scale}"
                    );
                }
            }
        }
    }
}

/// First principles: over the braking half of 200 random mechanisms the work of the air, from the pressure of the gas that the bottom
/// encloses, is the kinetic energy of the bed. Nothing of the law but Δx is used; Gauss's rule over 24 panels is exact to rounding.
#[test]
fn the_work_of_the_air_is_the_energy_of_the_bed() {
    let (mut random, mut mechanisms) = (Random(2026), linkage::Random(2026));
    let mut worst = 0.0_f64;
    let mut count = 0;
    while count < 200 {
        let linkage = random_linkage(&mut random, &mut mechanisms);
        let end = if count % 2 == 0 { End::Outer } else { End::Inner };
        let Some(end) = StrokeEnd::new(linkage, random.of_size(0.02, 0.5), end) else { continue };
        count += 1;
        let rpm = random.of_size(5.0, 80.0);
        let (k, q) = (random.between(1.0, 1.67), random.of_size(1.2, 12.0));
        let cylinder = Cylinder::sized_for(&bed(), end.largest_deceleration().value, rpm, k, AMBIENT, q * AMBIENT);
        let lead = if count % 3 == 0 { 0.01 } else { 0.0 };
        let column = match count % 4 {
            0 => ColumnRule::Return,
            1 => ColumnRule::Length(random.between(1.2, 3.0) * end.stroke()),
            _ => ColumnRule::Matched,
        };
        let law = LinkageLaw::new(cylinder.loading(rpm), k, end, column, lead);
        let work = |angle: f64| {
            let (bed, bottom) = (end.at(angle), law.at(angle)[0]);
            let air = law.column - lead - bed.x[0] - bottom;
            2.0 * AMBIENT * cylinder.piston_area * libm::expm1(k * libm::log(law.column / air)) * bed.x[1]
        };
        for (from, to) in [(0.0, end.dead()), (end.dead(), end.angle())] {
            let done = quadrature::integrate(work, (from, to), 24);
            let omega = bed().crank_speed(rpm);
            let energy = |angle: f64| 0.5 * MASS * (omega * end.at(angle).x[1]).powi(2);
            let error = (done - (energy(from) - energy(to))).abs() / energy(from).max(energy(to));
            assert!(error < 1e-12, "{linkage:?} {column:?}: {error}");
            worst = worst.max(error);
        }
    }
    assert!(worst > 0.0, "something was measured");
}

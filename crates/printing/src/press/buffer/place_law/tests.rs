//! The bed by its place against the bed by the crank angle, which shares no formula with it.

use super::*;
use crate::press::bed_motion::{Branch, DragLink, End, Linkage, Slider};
use crate::press::buffer::bottom_law::ColumnRule;
use crate::press::buffer::crank_law::LinkageLaw;

const RADIUS: f64 = 0.18;

fn law(linkage: Linkage, end: End) -> Option<PlaceLaw> {
    let end = StrokeEnd::new(linkage, RADIUS, end)?;
    let loading = 1.0 / end.largest_deceleration().value;
    PlaceLaw::new(CrankLaw::Linkage(LinkageLaw::new(loading, 1.35, end, ColumnRule::Matched, 0.0)))
}

fn in_line(rod_ratio: f64, end: End) -> PlaceLaw {
    let slider = Slider { rod_ratio, offset_ratio: 0.0 };
    law(Linkage::CrankSlider(slider), end).expect("a mirrored way back")
}

#[test]
fn the_bed_by_its_place_is_the_bed_by_the_crank_angle() {
    for rod_ratio in [1.3, 2.0, 3.0, 3.8, 5.0, 40.0] {
        for end in [End::Outer, End::Inner] {
            let law = in_line(rod_ratio, end);
            let of = match law.by_crank() {
                CrankLaw::Linkage(law) => law.end,
                CrankLaw::Yoke(_) => panic!("a linkage"),
            };
            let (first, scale) = (-0.999 * law.before(), of.largest_deceleration().value.max(RADIUS));
            for i in 0..=400 {
                let crank = first + (law.dead() - first) * f64::from(i) / 400.0;
                let [x, speed, second, third, ..] = of.at(crank).x;
                // At a dead point the speed is a root of the place.
                let near = 1e-13 * scale * (1.0 + rod_ratio);
                let [by_place, slowing, jerk] = law.pace(x);
                let name = format!("{rod_ratio} {end:?} at {crank}");
                assert!((law.overrun(crank) - x).abs() == 0.0, "{name}");
                assert!((slowing - second).abs() < near, "{name}: {slowing} is not {second}");
                assert!(
                    (by_place * by_place - speed * speed).abs() < near * scale,
                    "{name}: {by_place} is not {speed}"
                );
                assert!(
                    (law.in_line().expect("a slider").slope(x) * speed + third).abs() < 10.0 * near,
                    "{name}: {jerk}"
                );
                if x <= 0.0 {
                    assert!((law.crank_before(x) - crank).abs() < 1e-7, "{name}");
                }
            }
            // a is x times something at the start, to the last digit.
            let (tiny, ratio) = (1e-12, of.start_ratio());
            assert!((law.deceleration(tiny) / tiny / ratio - 1.0).abs() < 1e-10, "{rod_ratio} {end:?}");
            assert_eq!((law.deceleration(0.0), law.pace(law.stroke())[0]), (0.0, 0.0));
            assert_eq!(law.crank_before(-2.1 * RADIUS), -law.before());
        }
    }
}

#[test]
fn a_long_rod_is_a_yoke() {
    for end in [End::Outer, End::Inner] {
        let law = in_line(1e6, end);
        for i in 0..=50 {
            let x = RADIUS * f64::from(i) / 50.0;
            assert!((law.deceleration(x) - x).abs() < 2e-6 * RADIUS);
            // Near the dead point the speed is a root of the place.
            let square = law.pace(x)[0] * law.pace(x)[0];
            assert!((square - (RADIUS - x) * (RADIUS + x)).abs() < 4e-6 * RADIUS * RADIUS, "{x}");
        }
    }
}

#[test]
fn a_bed_whose_way_back_is_another_has_no_law_by_place() {
    let offset = Slider { rod_ratio: 3.0, offset_ratio: 0.1 };
    assert!(law(Linkage::CrankSlider(offset), End::Outer).is_none());
    let links =
        DragLink { base: 0.1, coupler: 0.8, follower: 0.6, turn: std::f64::consts::PI, branch: Branch::Leading };
    let slider = Slider { rod_ratio: 3.0, offset_ratio: 0.0 };
    assert!(law(Linkage::SixBar(links, slider), End::Inner).is_none());
}

#[test]
fn the_fixed_bottom_by_place_is_that_by_the_crank_angle() {
    let law = in_line(3.0, End::Inner);
    for i in 0..=20 {
        let crank = law.dead() * f64::from(i) / 20.0;
        let (got, want) = (law.air_of_fixed_bottom(law.overrun(crank)), law.by_crank().air_of_fixed_bottom(crank));
        assert!((got - want).abs() < 1e-13, "{got} is not {want}");
    }
}

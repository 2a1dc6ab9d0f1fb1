//! Presses under a linkage: against the air by its own lengths, and step by step.

use super::super::fault::{Fault, FrozenBuffer};
use super::super::losses::{BedWay, Losses, LossyReversal};
use super::super::monte_carlo;
use super::super::parameter::Parameter;
use super::super::reset::ScrewRule;
use super::super::settings::{self, FixedBottom};
use super::{cam, sampling};
use crate::press::MachineOfPress;
use crate::press::bed_motion::End;
use crate::press::buffer::crank_law::{CrankLaw, LinkageLaw};
use camgen_cams::machine::Machine;

/// The cam of a press under a linkage, with its law.
fn under_a_linkage(name: &str, overrides: &[&str]) -> (FrozenBuffer, LinkageLaw) {
    let (inner, overrides): (Vec<&str>, Vec<&str>) = overrides.iter().partition(|&&one| one == "inner");
    let overrides: Vec<String> = overrides.into_iter().map(str::to_owned).collect();
    let machine = Machine::load(name, &overrides).expect("valid").0;
    let end = if inner.is_empty() { End::Outer } else { End::Inner };
    let machine = machine.at_end(end).expect("a linkage");
    let press = machine.press().expect("a press");
    let CrankLaw::Linkage(law) = press.bottom_law(35.0) else { panic!("a linkage") };
    (FrozenBuffer::of_law(&CrankLaw::Linkage(law), &press.cylinder()), law)
}

const LINKAGES: [(&str, &[&str]); 4] = [
    ("dpi-crank-slider", &[]),
    ("dpi-crank-slider", &["linkage.offset_ratio=0.1"]),
    ("dpi-six-bar", &[]),
    ("dpi-six-bar", &["inner"]),
];

/// The air of a press under a linkage that differs, by its own lengths: L + ΔL − Δe − (x + Δx), the bottom where the cam has it at φ + Δ.
fn by_lengths(cam: &FrozenBuffer, law: &LinkageLaw, fault: &Fault, crank: f64, column: Option<f64>) -> f64 {
    let bed = law.end.at(crank);
    let bottom = if column.is_some() { 0.0 } else { law.at(crank + fault.phase)[0] };
    let own = column.unwrap_or(law.column);
    let length = own + fault.column - fault.lead - bed.x[0] - bottom;
    let pressure = fault.closing * libm::pow(fault.air * (own + fault.column) / length, fault.exponent);
    cam.unit_force * (fault.square * law.loading * -bed.x[2] - fault.ambient * (pressure - 1.0))
}

#[test]
fn presses_that_differ_under_a_linkage() {
    use Parameter::{AirLost, Ambient, Closing, Column, Exponent, Lead, Mass, Speed};
    for (name, overrides) in LINKAGES {
        let (cam, law) = under_a_linkage(name, overrides);
        let angles = || (0..=20_000).map(|i| law.end.angle() * f64::from(i) / 20_000.0);
        let scan = |fault: &Fault| {
            angles()
                .map(|at| by_lengths(&cam, &law, fault, at, None))
                .fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a })
        };
        for (parameter, by) in [
            (Exponent, 0.05),
            (Ambient, -0.03),
            (Mass, 0.05),
            (Speed, -0.01),
            (Column, 1e-3),
            (Lead, 2e-4),
            (AirLost, 0.01),
            (Closing, 0.01),
        ] {
            let fault = parameter.changed(Fault::none(1.35), by);
            let worst = cam.worst(&fault).expect("it fits").value;
            assert!((worst / scan(&fault) - 1.0).abs() < 1e-6, "{name} {parameter:?}: {worst} {}", scan(&fault));
            // Both settings of the screw: nothing at the dead point, and the least largest force.
            let end = fault.with_column(cam.end_reset(&fault).expect("a column"));
            let dead = by_lengths(&cam, &law, &end, law.end.dead(), None);
            assert!(dead.abs() < 1e-6, "{name} {parameter:?}: {dead}");
            let level = cam.level_reset(&fault).expect("a column");
            let left = |column: f64| scan(&fault.with_column(column)).abs();
            let found = left(level);
            assert!(found <= left(level + 1e-5) + 1e-3 && found <= left(level - 1e-5) + 1e-3, "{name} {parameter:?}");
            // A small share of it, to first order.
            let small = parameter.changed(Fault::none(1.35), 1e-6 * by);
            for at in angles().step_by(2000) {
                let effect = 1e-6 * by * parameter.first_order(&cam, at);
                let moved =
                    by_lengths(&cam, &law, &small, at, None) - by_lengths(&cam, &law, &Fault::none(1.35), at, None);
                assert!(
                    (effect - moved).abs() < 1e-5 * effect.abs() + 1e-7,
                    "{name} {parameter:?} {at}: {effect} {moved}"
                );
            }
        }
        let ahead = Fault { phase: 1e-6, ..Fault::none(1.35) };
        for at in angles().step_by(1777) {
            let (by_cam, moved) = (1e-6 * cam.phase_force(at)[0], by_lengths(&cam, &law, &ahead, at, None));
            assert!((by_cam - moved).abs() < 1e-4 * by_cam.abs() + 1e-6, "{name} {at}: {by_cam} {moved}");
        }
        let largest = cam.largest_phase_force().value;
        let scanned = angles().map(|at| cam.phase_force(at)[0].abs()).fold(0.0, f64::max);
        assert!((largest / scanned - 1.0).abs() < 1e-6, "{name}: {largest} {scanned}");
    }
}

/// Drawn presses under a linkage by the lengths of their air, and a fixed bottom with its setting by a scan.
#[test]
fn drawn_presses_and_settings_under_a_linkage() {
    for (name, overrides) in LINKAGES {
        let (cam, law) = under_a_linkage(name, overrides);
        let sampling = sampling(200, ScrewRule::End);
        let drawn = monte_carlo::draw(&cam, &sampling, 0.0).expect("possible");
        let angles: Vec<f64> = (0..=1440).map(|i| law.end.angle() * f64::from(i) / 1440.0).collect();
        let largest = |fault: &Fault, column: Option<f64>| {
            // The phase counts to first order, which the test above holds against the bottom ahead.
            let still = Fault { phase: 0.0, ..*fault };
            let of = |at: &f64| by_lengths(&cam, &law, &still, *at, column) + fault.phase * cam.phase_force(*at)[0];
            angles.iter().map(|at| of(at).abs()).fold(0.0, f64::max)
        };
        let fixed = cam.with_fixed_bottom().column;
        let (mut built, mut after, mut bottoms) = (Vec::new(), Vec::new(), Vec::new());
        for sample in 0..200 {
            let (fault, screw) = sampling.press(1.35, sample);
            built.push(largest(&fault, None));
            let still = Fault { phase: 0.0, ..fault };
            let column = cam.end_reset(&still).expect("a column") + screw;
            after.push(largest(&fault.with_column(column), None));
            let of_fixed = cam.with_fixed_bottom().end_reset(&still).expect("a column") + screw;
            bottoms.push(largest(&still.with_column(of_fixed), Some(fixed)));
        }
        for (got, mut want) in [(drawn.as_built, built), (drawn.reset, after), (drawn.fixed, bottoms)] {
            want.sort_by(f64::total_cmp);
            for (got, want) in got.iter().zip(&want) {
                // Stations of a degree miss a top by less.
                assert!((got / want - 1.0).abs() < 4e-3, "{name}: {got} {want}");
            }
        }
        let fixed = FixedBottom::new(&cam);
        let column = fixed.column(0.7, ScrewRule::Level);
        let left = fixed.left(column, 0.7);
        let v = Fault { square: 0.7, ..Fault::none(1.35) };
        assert!((largest(&v, Some(column)) / left - 1.0).abs() < 5e-5, "{name}: {left}");
        assert!(left <= largest(&v, Some(column + 1e-5)) + 0.1 && left <= largest(&v, Some(column - 1e-5)) + 0.1);
        // Where both leave as much the range ends; where there is no such speed the cam leaves less down to the slowest.
        let least = settings::useful(&cam, ScrewRule::Level).least;
        let setting = fixed.setting(least.unwrap_or(0.02), ScrewRule::Level).expect("possible");
        let share = setting.residual.value.abs() / setting.fixed_residual;
        assert!(
            if least.is_some() { (share - 1.0).abs() < 1e-6 } else { share < 1.0 },
            "{name}: {least:?} {setting:?}"
        );
    }
}

/// Under a short rod the air is shortest before and after the dead point. The largest force is found there, and every speed of the useful range has a setting.
#[test]
fn air_that_is_shortest_beside_the_dead_point() {
    for rod in ["1.5", "2", "2.5", "2.8", "3"] {
        let rod = format!("linkage.rod_ratio={rod}");
        for offset in ["linkage.offset_ratio=0", "linkage.offset_ratio=0.2"] {
            let (cam, _) = under_a_linkage("dpi-crank-slider", &["inner", &rod, offset]);
            let settings::VariableRange { least, most } = settings::useful(&cam, ScrewRule::Level);
            assert!(least.is_none_or(|least| least < 1.0) && most.is_none_or(|most| most > 1.0), "{rod} {offset}");
            for variable in [0.2, 0.7, 1.3, 4.0] {
                let setting = FixedBottom::new(&cam).setting(variable, ScrewRule::Level).expect("possible");
                assert!(setting.residual.value.is_finite() && setting.fixed_residual.is_finite(), "{rod} {setting:?}");
            }
        }
    }
}

/// Losses under linkages: air on two exponents by its own lengths, and a rod so long that it is nearly a yoke.
#[test]
fn losses_under_a_linkage() {
    let losses = Losses { expansion_exponent: Some(1.40), bed_friction: 50.0, ..Losses::NONE };
    let twice: (&str, &[&str]) = ("dpi-crank-slider", &["inner", "linkage.rod_ratio=1.5"]);
    for (name, overrides) in LINKAGES.into_iter().chain([twice]) {
        let (cam, law) = under_a_linkage(name, overrides);
        let reversal = LossyReversal::new(&cam, &Fault::none(1.35), &losses).expect("possible");
        // Step by step: the gas is compressed on the one exponent and expands on the other, wherever that is.
        let length = |crank: f64| 1.0 - (law.end.at(crank).x[0] + law.at(crank)[0]) / law.column;
        let (mut pressure, mut before) = (1.0, length(0.0));
        let mut scanned = [0.0_f64; 2];
        for i in 1..=40_000 {
            let crank = law.end.angle() * f64::from(i) / 40_000.0;
            let now = length(crank);
            pressure *= libm::pow(before / now, if now < before { 1.35 } else { 1.40 });
            before = now;
            let way = usize::from(crank > law.end.dead());
            let friction = if way == 0 { -50.0 } else { 50.0 };
            let left = cam.unit_force * (law.loading * -law.end.at(crank).x[2] - pressure + 1.0) + friction;
            if left.abs() > scanned[way].abs() {
                scanned[way] = left;
            }
        }
        for (way, scanned) in [BedWay::In, BedWay::Back].into_iter().zip(scanned) {
            let found = reversal.worst(way).value;
            assert!((found - scanned).abs() < 1e-4 * scanned.abs() + 0.05, "{name} {way:?}: {found} {scanned}");
        }
        if overrides == ["inner", "linkage.rod_ratio=1.5"] {
            // The air is shortest before and after the dead point, and already loses between.
            assert!((reversal.worst(BedWay::In).value - 364.0).abs() < 5.0, "{:?}", reversal.worst(BedWay::In));
        }
        assert!(reversal.work_lost() > 0.0);
    }
    let long = ["linkage.rod_ratio=100000", "linkage.offset_ratio=0"];
    let (near, _) = under_a_linkage("dpi-crank-slider", &long);
    let yoke = cam("dpi");
    let losses = Losses { leak: 0.01, train_stiffness: Some(1e8), play: 1e-4, ..losses };
    let [of_yoke, of_linkage] =
        [&yoke, &near].map(|cam| LossyReversal::new(cam, &Fault::none(1.35), &losses).expect("possible"));
    for (got, want) in [
        (of_linkage.worst(BedWay::In).value / near.unit_force, of_yoke.worst(BedWay::In).value / yoke.unit_force),
        (of_linkage.worst(BedWay::Back).value / near.unit_force, of_yoke.worst(BedWay::Back).value / yoke.unit_force),
        (of_linkage.air_left(), of_yoke.air_left()),
        (of_linkage.largest_half_loop().value / near.unit_force, of_yoke.largest_half_loop().value / yoke.unit_force),
    ] {
        assert!((got / want - 1.0).abs() < 1e-3, "{got} {want}");
    }
}

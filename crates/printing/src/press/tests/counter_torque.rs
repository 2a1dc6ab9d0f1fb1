//! The law of a compensating cam at the numbers of the paper.

use crate::press::MachineOfPress;
use crate::press::buffer::bottom_law::{BottomLaw, ColumnRule};
use crate::press::buffer::{Bed, Cylinder, camshaft};
use crate::press::rotary::rotary;
use camgen_cams::machine::Machine;
use camgen_kernel::motion::Jet;
use camgen_kernel::motion::counter_torque::{CounterTorque, WorkJet};
use camgen_kernel::numeric::extremum;
use std::f64::consts::FRAC_PI_2;

/// 100 N/mm and 10 kN for one of the two machines of the press.
fn machine(q: f64, column: ColumnRule) -> (BottomLaw, Cylinder, CounterTorque) {
    let bed = Bed { mass: 978.2, crank_radius: 0.18, crank_turns_per_main_shaft_turn: 3.0 };
    let cylinder = Cylinder::sized(&bed, 35.0, 1.35, 98_066.5, q * 98_066.5);
    let law = BottomLaw::new(cylinder.loading(35.0), 1.35, 0.18, column, 0.0);
    let energy_max = camshaft::largest_work(&law, &cylinder).value;
    (law, cylinder, CounterTorque::new(1e5, 1e4, energy_max).expect("preload and rate are positive"))
}

fn jet_at(degrees: f64, (law, cylinder, disc): &(BottomLaw, Cylinder, CounterTorque)) -> Jet {
    let work = camshaft::work(law, cylinder, degrees.to_radians());
    let work = WorkJet {
        energy: work.value,
        torque: work.torque,
        torque_slope: work.torque_slope,
        torque_second: work.torque_second,
    };
    let jet = disc.jet(work);
    assert!((disc.spring_torque(jet) + work.torque).abs() < 1e-12);
    jet
}

/// Relative; a handful of roundings.
fn close(got: f64, want: f64) {
    assert!((got / want - 1.0).abs() < 2e-14, "{got} is not {want}");
}

#[test]
fn golden_numbers() {
    let matched = machine(2.0, ColumnRule::Matched);
    for (degrees, lift) in [
        (10.0, 0.982_327_851_304_808_177),
        (30.0, 16.856_008_771_649_496_5),
        (60.0, 58.531_113_360_097_157_9),
        (90.0, 77.965_519_078_930_342_7),
    ] {
        close(1e3 * jet_at(degrees, &matched).s, lift);
    }
    let jet = jet_at(30.0, &matched);
    close(1e3 * jet.ds, 71.888_357_896_597_821_8);
    close(1e3 * jet.dds, 109.238_165_370_897_997);
    close(1e3 * jet.ddds, -478.613_585_087_834_990);
    let start = jet_at(0.0, &matched);
    assert_eq!((start.s, start.ds, start.dds), (0.0, 0.0, 0.0));
    close(1e3 * start.ddds, 1_334.051_489_934_620_47);
    let returning = machine(5.0, ColumnRule::Return);
    for (degrees, lift) in
        [(0.0, 10.594_681_872_600_720_5), (30.0, 5.961_641_229_831_062_82), (90.0, 70.321_730_781_434_801_2)]
    {
        close(1e3 * jet_at(degrees, &returning).s, lift);
    }
    close(1e3 * jet_at(0.0, &returning).dds, -1_127.588_445_571_74);
}

/// Air that expands by 1.40 where it was compressed by 1.35, in closed form: P = P_r (W_r/W)^1.40 on the way back. The difference from the
/// law acts on the bottom, whose slope by the overrun is found by differences; the camshaft turns as fast as the crank.
#[test]
fn losses_leave_their_share_of_the_torque() {
    let sets = ["buffer.expansion_exponent=1.40", "compensator.spring_rate=100 N/mm", "compensator.preload=10 kN"];
    let (machine, _) = Machine::load("dpi", &sets.map(str::to_owned)).expect("a machine");
    let cam = rotary(&machine, 35.0).expect("a cam");
    let second = cam.compensating_disc().expect("a second disc");
    let found = cam.compensated_by(&second).expect("figures").in_losses.expect("losses");
    let press = machine.press().expect("a press");
    let (law, cylinder, r) = (press.bottom_law(35.0), press.cylinder(), press.bed.crank_radius);
    let law = *law.of_yoke().expect("a yoke");
    let length = |x: f64| (law.column - law.lead - x - law.displacement(x)) / law.column;
    let beyond = |x: f64| {
        let (turned, here) = (length(r), length(x));
        libm::pow(turned, -1.35) * libm::pow(turned / here, 1.40) - libm::pow(here, -1.35)
    };
    let torque = |at: f64| {
        let (x, small) = (r * libm::sin(at), 1e-6 * r);
        let slope = (law.displacement(x + small) - law.displacement(x - small)) / (2.0 * small);
        (cylinder.unit_force() * beyond(x) * slope * r * libm::cos(at)).abs()
    };
    let wanted = extremum::largest_without_slope(torque, (1e-4, FRAC_PI_2 - 1e-4), 200, 30).value;
    // The largest of 720 places of a piece.
    assert!((found / wanted - 1.0).abs() < 1e-4, "{found} {wanted}");
    let lossless =
        Machine::load("dpi", &sets[1..].iter().map(|&set| set.to_owned()).collect::<Vec<_>>()).expect("one").0;
    let cam = rotary(&lossless, 35.0).expect("a cam");
    assert_eq!(cam.compensated_by(&cam.compensating_disc().expect("a disc")).expect("figures").in_losses, None);
}

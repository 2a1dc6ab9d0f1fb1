//! The disc that holds the web tension of a belt brake (`brake::holding`): the counter-torque law while the roll runs down, and
//! a quintic over the rest of the turn.
//!
//! Θ = 0 is the full roll. The working stretch ends at the smallest radius; after it the quintic meets lift, slope and curvature at
//! both ends. No roller runs on it: it only closes the outline. It may dip below the lowest point of the working stretch, where the
//! law's lift is 0; lifts are counted from the lowest point of both.

use crate::brake::mechanics::{DiscWork, TensionHolding};
use camgen_kernel::motion::counter_torque::{CounterTorque, WorkJet};
use camgen_kernel::motion::{Jet, Motion, Piece};
use camgen_kernel::numeric::chebyshev_series::{ChebyshevSeries, SeriesGroup};
use camgen_kernel::numeric::extremum;
use camgen_kernel::refusal::Refusal;
use std::f64::consts::TAU;

/// Cells in which extrema are searched, of the work and of the quintic: a handful.
const CELLS: u32 = 64;

/// Terms of the series of the torque that are tried, and the share of its largest term that is rounding: the moment is a difference of
/// moments ten times its size.
const TERMS: [u32; 4] = [24, 48, 96, 192];
const ROUNDING: f64 = 1e-14;

/// Work, torque and two derivatives on the disc over the working stretch as sums of Chebyshev polynomials; `None` if the torque series does
/// not converge to rounding, near a limit of the frame.
fn series_of(holding: &TensionHolding) -> Option<SeriesGroup<4>> {
    let range = (0.0, holding.total_angle());
    let torque = TERMS.into_iter().find_map(|terms| {
        let places = ChebyshevSeries::points(range, terms);
        let torques: Vec<f64> = places.into_iter().map_while(|angle| holding.torque(angle).ok()).collect();
        let whole = u32::try_from(torques.len()).is_ok_and(|found| found == terms);
        let series = ChebyshevSeries::through(range, &torques, ROUNDING);
        (whole && 4 * series.terms() <= 3 * torques.len()).then_some(series)
    })?;
    let slope = torque.derivative();
    Some(SeriesGroup::new([&torque.integral(), &torque, &slope, &slope.derivative()]))
}

/// The motion of the roller on the disc of a brake.
#[derive(Debug, Clone)]
pub struct BrakeDisc {
    holding: TensionHolding,
    /// Its work as a series, where that is exact to rounding; otherwise each value is solved for.
    series: Option<SeriesGroup<4>>,
    law: CounterTorque,
    /// Coefficients of the closing stretch by its share t = 0…1.
    closing: Quintic,
    /// Lift of the law at the lowest point of the disc, m, at most 0.
    lowest: f64,
    /// Work of the disc between its least and its largest, J.
    stored: f64,
    pieces: [Piece; 2],
}

/// Coefficients of the powers of t = 0…1.
#[derive(Debug, Clone, Copy)]
struct Quintic([f64; 6]);

/// The quintic over a length that meets two jets.
fn quintic(from: Jet, to: Jet, length: f64) -> Quintic {
    let (slope, bend) = (from.ds * length, from.dds * length * length);
    let rise = to.s - from.s - slope - 0.5 * bend;
    let steepening = to.ds * length - slope - bend;
    let bending = to.dds * length * length - bend;
    Quintic([
        from.s,
        slope,
        0.5 * bend,
        10.0 * rise - 4.0 * steepening + 0.5 * bending,
        -15.0 * rise + 7.0 * steepening - bending,
        6.0 * rise - 3.0 * steepening + 0.5 * bending,
    ])
}

impl Quintic {
    /// Value and derivatives with respect to the angle, of which `length` is t = 1.
    fn jet(&self, t: f64, length: f64) -> Jet {
        let [c0, c1, c2, c3, c4, c5] = self.0;
        let n = 1.0 / length;
        Jet {
            s: c0 + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5)))),
            ds: n * (c1 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5)))),
            dds: n * n * (2.0 * c2 + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5))),
            ddds: n * n * n * (6.0 * c3 + t * (24.0 * c4 + t * 60.0 * c5)),
        }
    }
}

/// The work of the disc at an angle of the working stretch; NaN beyond a limit of the frame that was not found before.
fn work(holding: &TensionHolding, series: Option<&SeriesGroup<4>>, angle: f64) -> WorkJet {
    if let Some(series) = series {
        let [energy, torque, torque_slope, torque_second] = series.values_at(angle);
        return WorkJet { energy, torque, torque_slope, torque_second };
    }
    let nothing = DiscWork { energy: f64::NAN, torque: f64::NAN, torque_slope: f64::NAN, torque_second: f64::NAN };
    let hold = holding.at(angle).unwrap_or(nothing);
    WorkJet {
        energy: hold.energy,
        torque: hold.torque,
        torque_slope: hold.torque_slope,
        torque_second: hold.torque_second,
    }
}

/// The largest work over the roll for a sign of 1, the least for −1, J.
fn extreme_energy(holding: &TensionHolding, series: Option<&SeriesGroup<4>>, sign: f64) -> f64 {
    let found = extremum::largest(
        |angle| sign * work(holding, series, angle).energy,
        |angle| sign * work(holding, series, angle).torque,
        (0.0, holding.total_angle()),
        CELLS,
    );
    sign * found.value
}

impl BrakeDisc {
    /// The motion with a spring rate (N/m) and the force of the spring where the law's lift is 0 (N).
    ///
    /// # Errors
    /// As [`CounterTorque::new`]; the largest work is NaN where the frame reaches a limit of its movement that was not found before.
    pub fn new(holding: TensionHolding, rate: f64, preload: f64) -> Result<Self, Refusal> {
        let total = holding.total_angle();
        let series = series_of(&holding);
        let most = extreme_energy(&holding, series.as_ref(), 1.0);
        let least = extreme_energy(&holding, series.as_ref(), -1.0);
        let law = CounterTorque::new(rate, preload, most)?;
        let pieces = [Piece { start: 0.0, end: total, dwell: false }, Piece { start: total, end: TAU, dwell: false }];
        let mut disc =
            Self { holding, series, law, closing: Quintic([0.0; 6]), lowest: 0.0, stored: most - least, pieces };
        let length = TAU - total;
        disc.closing = quintic(disc.working(total), disc.working(0.0), length);
        let deepest = extremum::largest(
            |t| -disc.closing.jet(t, length).s,
            |t| -disc.closing.jet(t, length).ds,
            (0.0, 1.0),
            CELLS,
        );
        disc.lowest = -deepest.value.max(0.0);
        Ok(disc)
    }

    /// The jet of the law at an angle of the working stretch, the lift counted as in the law.
    fn working(&self, angle: f64) -> Jet {
        self.law.jet(work(&self.holding, self.series.as_ref(), angle))
    }

    /// The tension that the disc holds, and its work.
    #[must_use]
    pub fn holding(&self) -> &TensionHolding {
        &self.holding
    }

    /// The law of its spring; its lift is the motion's lift plus [`Motion::origin`].
    #[must_use]
    pub fn law(&self) -> &CounterTorque {
        &self.law
    }

    /// Work of the disc between its least and its largest over the roll, J: what the spring takes up or gives.
    #[must_use]
    pub fn stored(&self) -> f64 {
        self.stored
    }
}

impl Motion for BrakeDisc {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn jet(&self, piece: usize, parameter: f64) -> Jet {
        let [_, closing] = self.pieces;
        let jet = if piece == 0 {
            self.working(parameter)
        } else {
            let length = closing.end - closing.start;
            self.closing.jet((parameter - closing.start) / length, length)
        };
        Jet { s: jet.s - self.lowest, ..jet }
    }

    fn is_rolled(&self, piece: usize) -> bool {
        piece == 0
    }

    fn origin(&self) -> Option<f64> {
        Some(self.lowest)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::brake::mechanics::{Brake, BrakeFrame, PaperRoll, RollRotation};

    /// `roll` of the brake's tests: i = 10, 20 N/mm, 1 kN.
    pub(in crate::brake) fn disc() -> BrakeDisc {
        let frame = BrakeFrame {
            pivot: [-1.1, 0.55],
            right_pulley: [0.5, 0.45],
            left_pulley: [-0.55, 0.45],
            centre_of_gravity: [0.1, 0.55],
            pulley_radius: 0.06,
        };
        let roll = PaperRoll { largest_radius: 0.6, smallest_radius: 0.05 };
        let brake = Brake::new(frame, roll, 0.25, RollRotation::Clockwise).expect("reaches");
        let weight = brake.at(0.6).map(|full| brake.weight_for(300.0, &full)).expect("in the roll");
        let holding = TensionHolding::new(brake, weight, 300.0, 10.0).expect("less than a turn");
        BrakeDisc::new(holding, 20e3, 1e3).expect("a spring")
    }

    /// Relative; the torque is a difference of moments ten times its size.
    #[track_caller]
    fn close(got: f64, want: f64) {
        assert!((got / want - 1.0).abs() < 4e-13, "{got} is not {want}: {:e}", got / want - 1.0);
    }

    /// The jet at a radius, mm, in millimetres of the law.
    fn at(disc: &BrakeDisc, radius: f64) -> (f64, f64) {
        let angle = disc.holding().angle_at(1e-3 * radius).expect("in the roll");
        let jet = disc.jet(0, angle);
        (1e3 * (jet.s + disc.origin().expect("an origin")), 1e3 * jet.ds)
    }

    #[test]
    fn golden_numbers() {
        let disc = disc();
        for (radius, lift) in [
            (600.0, 44.195_521_558_500_347_3),
            (500.0, 42.565_064_291_569_122_9),
            (300.0, 32.204_779_577_963_880_1),
            (100.0, 9.485_016_589_868_837_78),
        ] {
            close(at(&disc, radius).0, lift);
        }
        close(at(&disc, 300.0).1, -8.968_112_863_641_717_39);
        close(at(&disc, 50.0).1, -25.592_586_292_534_162_2);
        close(disc.stored(), 63.727_962_816_779_037_0);
        // A radial roller's pressure angle is at 30° the most on a prime circle of max(|y'|/tan 30° − y).
        let working = disc.pieces()[0];
        let radius = |step: u32| {
            let jet = disc.jet(0, working.end * f64::from(step) / 500.0);
            3.0_f64.sqrt() * jet.ds.abs() - jet.s - disc.lowest
        };
        close(1e3 * (0..=500).map(radius).fold(0.0, f64::max), 44.327_659_755_76);
    }

    #[test]
    fn the_spring_holds_the_tension() {
        let disc = disc();
        for radius in [0.6, 0.52, 0.3, 0.11, 0.05] {
            let pose = disc.holding().brake().at(radius).expect("in the roll");
            let jet = disc.jet(0, disc.holding().angle_at(radius).expect("in the roll"));
            let torque = -disc.law().spring_torque(Jet { s: jet.s + disc.lowest, ..jet });
            let tension = disc.holding().tension_with(torque, &pose, 0.25).expect("slips");
            assert!((tension - 300.0).abs() < 1e-10, "{tension}");
        }
    }

    /// The series against the values that are solved for one by one: each derivative loses the square of the terms.
    #[test]
    fn the_series_tells_the_work() {
        let disc = disc();
        let series = disc.series.as_ref().expect("no wall is near");
        let end = disc.holding.total_angle();
        for i in 0..=97 {
            let angle = end * f64::from(i) / 97.0;
            let (hold, by_series) =
                (disc.holding.at(angle).expect("in the roll"), work(&disc.holding, Some(series), angle));
            for (one, other, scale, tolerance) in [
                (hold.energy, by_series.energy, 64.0, 1e-13),
                (hold.torque, by_series.torque, 26.0, 1e-13),
                (hold.torque_slope, by_series.torque_slope, 9.5, 2e-11),
                (hold.torque_second, by_series.torque_second, 10.0, 4e-9),
            ] {
                assert!((one - other).abs() < tolerance * scale, "{angle}: {hold:?} {by_series:?}");
            }
        }
    }

    #[test]
    fn the_closing_stretch_meets_both_ends() {
        let disc = disc();
        let [working, closing] = disc.pieces;
        assert_eq!((working.end, closing.end), (closing.start, TAU));
        for (before, after) in [
            (disc.jet(0, working.end), disc.jet(1, closing.start)),
            (disc.jet(1, closing.end), disc.jet(0, working.start)),
        ] {
            for (one, other) in [(before.s, after.s), (before.ds, after.ds), (before.dds, after.dds)] {
                assert!((one - other).abs() < 1e-14, "{before:?} {after:?}");
            }
        }
        assert!(disc.lowest < 0.0 && disc.origin() == Some(disc.lowest));
    }

    #[test]
    fn a_spring_without_preload_is_refused() {
        let holding = disc().holding;
        let error = BrakeDisc::new(holding, 20e3, 0.0).expect_err("no preload");
        assert_eq!(error.what, "the preload of the counter-torque spring is 0 N");
    }
}

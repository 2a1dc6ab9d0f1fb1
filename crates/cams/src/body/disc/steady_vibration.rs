//! The steady vibration of a load behind an elastic train, exact for any number of waves of the lift.
//!
//! The deviation z = x − y of the load from the follower, differentiated with respect to the cam angle, obeys z'' + 2ζκ z' + κ² z = −(y'' + 2ζκ y') if the
//! damping acts against the frame; if it acts against the follower, the right side is −y''. κ = natural frequency / frequency of the cam. A step of the
//! follower's velocity steps z' by the opposite amount. Over a short cell the solution is the free vibration plus an integral of the exact motion
//! (Duhamel); after one turn it repeats.

use crate::machine::DampingAgainst;
use camgen_kernel::motion::Motion;
use camgen_kernel::numeric::extremum::Extremum;
use camgen_kernel::numeric::{quadrature, root};

/// Cells for a radian of the free vibration, and least cells of a piece.
const CELLS_PER_RADIAN: f64 = 1.0;
const LEAST_CELLS: u32 = 32;
/// Most cells of a piece: beyond, a cell has more than a radian of the free vibration, and Gauss' rule less than 1e-9.
const MOST_CELLS: u32 = 1 << 16;
/// A determinant below this is that of an undamped resonance.
const AT_RESONANCE: f64 = 1e-12;

/// A load on an undamped or damped spring.
#[derive(Debug, Clone, Copy)]
pub(super) struct ElasticTrain {
    /// Natural frequency over that of the cam.
    pub(super) frequency: f64,
    /// Share of the critical damping, below 1.
    pub(super) damping: f64,
    pub(super) against: DampingAgainst,
}

/// Deviation and its rate.
type State = [f64; 2];

impl ElasticTrain {
    /// Of a free vibration after an angle: the deviation from a unit deviation and from a unit rate, and their rates.
    fn free(self, angle: f64) -> [State; 2] {
        let (decay, pace) =
            (self.damping * self.frequency, self.frequency * (1.0 - self.damping * self.damping).sqrt());
        let (sin, cos) = libm::sincos(pace * angle);
        let (fade, sine) = (libm::exp(-decay * angle), sin / pace);
        let from_rate = [fade * sine, fade * (cos - decay * sine)];
        [[fade * (cos + decay * sine), -self.frequency * self.frequency * from_rate[0]], from_rate]
    }

    /// The state after an angle from a state on, with this motion from an angle of a piece on.
    fn after(self, state: State, motion: &dyn Motion, (piece, from, to): (usize, f64, f64)) -> State {
        let [of_value, of_rate] = self.free(to - from);
        let drag = match self.against {
            DampingAgainst::Frame => 2.0 * self.damping * self.frequency,
            DampingAgainst::Follower => 0.0,
        };
        let driven = |order: usize| {
            let push = |at: f64| {
                let lift = motion.jet(piece, at);
                -(lift.dds + drag * lift.ds) * self.free(to - at)[1][order]
            };
            quadrature::integrate(push, (from, to), 1)
        };
        [0, 1].map(|order| state[0] * of_value[order] + state[1] * of_rate[order] + driven(order))
    }

    /// Cells of each piece of the first lobe, in their order: the piece and its ends.
    fn cells(self, motion: &dyn Motion) -> Vec<(usize, f64, f64)> {
        let of_piece = |(index, piece): (usize, &camgen_kernel::motion::Piece)| {
            let wanted = (CELLS_PER_RADIAN * self.frequency * (piece.end - piece.start)).ceil();
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between its bounds")]
            let count = (wanted.min(f64::from(MOST_CELLS)) as u32).max(LEAST_CELLS);
            let (start, width) = (piece.start, piece.end - piece.start);
            let end = piece.end;
            let place = move |cell: u32| {
                if cell == count { end } else { start + width * (f64::from(cell) / f64::from(count)) }
            };
            (0..count).map(move |cell| (index, place(cell), place(cell + 1))).collect::<Vec<_>>()
        };
        motion.distinct().iter().enumerate().flat_map(of_piece).collect()
    }

    /// The largest deviation when nothing changes from lobe to lobe, m or rad, and where; infinite at an undamped resonance.
    pub(super) fn largest_deviation(self, motion: &dyn Motion) -> Extremum {
        let (pieces, cells) = (motion.distinct(), self.cells(motion));
        let velocity = |index: usize, at: f64| motion.jet(index, at).ds;
        let before = |index: usize| index.checked_sub(1).unwrap_or(pieces.len().saturating_sub(1));
        // What the velocity of the follower gains where a piece begins, the deviation loses.
        let lost = |index: usize| {
            let (here, last) = (pieces.get(index), pieces.get(before(index)));
            here.zip(last).map_or(0.0, |(here, last)| velocity(index, here.start) - velocity(before(index), last.end))
        };
        let entered = |state: State, index: usize, at: f64| {
            let begins = pieces.get(index).is_some_and(|piece| piece.start == at);
            if begins { [state[0], state[1] - lost(index)] } else { state }
        };
        let step = |state: State, &(index, from, to): &(usize, f64, f64)| {
            self.after(entered(state, index, from), motion, (index, from, to))
        };
        let driven = cells.iter().fold([0.0; 2], step);
        let whole = pieces.iter().map(|piece| piece.end - piece.start).sum();
        let Some(mut state) = self.returning(driven, whole) else { return Extremum { at: 0.0, value: f64::INFINITY } };
        let mut best = Extremum { at: 0.0, value: f64::NEG_INFINITY };
        let mut take = |at: f64, value: f64| {
            if value.abs() > best.value {
                best = Extremum { at, value: value.abs() };
            }
        };
        for cell in &cells {
            let &(index, from, to) = cell;
            let first = entered(state, index, from);
            take(from, first[0]);
            state = step(state, cell);
            if (first[1] < 0.0) != (state[1] < 0.0) {
                let rate = |at: f64| self.after(first, motion, (index, from, at))[1];
                if let Ok(at) = root::bracketed(rate, from, to, 0.0) {
                    take(at, self.after(first, motion, (index, from, at))[0]);
                }
            }
        }
        best
    }

    /// The state that comes back after an angle in which one at rest would be driven to this state; `None` at an undamped resonance.
    fn returning(self, [value, rate]: State, angle: f64) -> Option<State> {
        let [of_value, of_rate] = self.free(angle);
        let rows = [[1.0 - of_value[0], -of_rate[0]], [-of_value[1], 1.0 - of_rate[1]]];
        let determinant = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
        if determinant.abs() < AT_RESONANCE {
            return None;
        }
        let first = (value * rows[1][1] - rate * rows[0][1]) / determinant;
        Some([first, (rate * rows[0][0] - value * rows[1][0]) / determinant])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::motion::laws::named;
    use camgen_kernel::motion::program::Program;
    use camgen_kernel::motion::{Jet, Piece, Quantity};
    use std::f64::consts::TAU;

    #[derive(Debug)]
    struct Wave;

    impl Motion for Wave {
        fn pieces(&self) -> &[Piece] {
            &[Piece { start: 0.0, end: TAU, dwell: false }]
        }

        fn jet(&self, _: usize, angle: f64) -> Jet {
            let (sin, cos) = libm::sincos(3.0 * angle);
            Jet { s: 1.0 - cos, ds: 3.0 * sin, dds: 9.0 * cos, ddds: -27.0 * sin }
        }
    }

    /// Of one wave the deviation is |H − 1| times its amplitude, H = 1/(1 − q² + 2iζq).
    #[test]
    fn one_wave_deviates_as_known() {
        for (frequency, damping) in [(40.25, 0.0), (40.5, 0.1), (2.2, 0.3), (0.7, 0.02), (1500.25, 0.0)] {
            let ratio = 3.0 / frequency;
            let (re, im) = (1.0 - ratio * ratio, 2.0 * damping * ratio);
            let known = libm::hypot(re - 1.0, im) / libm::hypot(re, im);
            let against = DampingAgainst::Frame;
            let found = ElasticTrain { frequency, damping, against }.largest_deviation(&Wave).value;
            assert!((found / known - 1.0).abs() < 1e-9, "{frequency} {damping}: {found} {known}");
            // Against the follower H = (1 + 2iζq)/(1 − q² + 2iζq).
            let known = ratio * ratio / libm::hypot(re, im);
            let against = DampingAgainst::Follower;
            let found = ElasticTrain { frequency, damping, against }.largest_deviation(&Wave).value;
            assert!((found / known - 1.0).abs() < 1e-9, "{frequency} {damping}: {found} {known}");
        }
        let against = DampingAgainst::Frame;
        assert_eq!(
            ElasticTrain { frequency: 3.0, damping: 0.0, against }.largest_deviation(&Wave).value,
            f64::INFINITY
        );
    }

    /// With jumps of velocity and acceleration the series of waves comes near, the more waves are summed up.
    #[test]
    fn jumps_are_counted_in_full() {
        let segments = [(named("parabola"), 1.5, 0.02), (None, 1.0, 0.02), (named("line"), 2.0, 0.0), (None, 0.0, 0.0)];
        let program = Program::new(Quantity::Length, 0.0, &segments).expect("a program");
        let (frequency, damping) = (7.3, 0.05);
        let found = ElasticTrain { frequency, damping, against: DampingAgainst::Frame }.largest_deviation(&program);
        let waves = program.harmonics(20_000).waves;
        let at = |angle: f64| {
            let term = |(order, [a, b]): (u32, &[f64; 2])| {
                let (k, ratio) = (f64::from(order), f64::from(order) / frequency);
                let (re, im) = (1.0 - ratio * ratio, 2.0 * damping * ratio);
                let square = re * re + im * im;
                let (gain, lag) = (re / square - 1.0, -im / square);
                let (sin, cos) = libm::sincos(k * angle);
                gain * (a * cos + b * sin) + lag * (b * cos - a * sin)
            };
            (1_u32..).zip(&waves).map(term).sum::<f64>()
        };
        // The waves beyond fall with the square of their order: 0.02/(2π 20 000).
        assert!((at(found.at).abs() - found.value).abs() < 1e-6, "{found:?} {}", at(found.at));
        let largest = (0..400).map(|i| at(f64::from(i) * TAU / 400.0).abs()).fold(0.0, f64::max);
        assert!(largest < found.value + 1e-6, "{largest} {found:?}");
    }
}

//! The counter-torque law: a second disc on the same shaft presses a spring so that its torque is the opposite of a given one.
//!
//! With E the work that the shaft gives elsewhere by the cam angle θ, T = dE/dθ, a spring of rate `c_s` with the travel y and the
//! preload `c_s` y0 keeps ½ `c_s` (y0 + y)² + E = ½ `c_s` y0² + `E_max`, so that
//!
//! ```text
//! y = D/(y0 + √(y0² + D)),  D = 2 (E_max − E)/c_s,  Y = y0 + y = √(y0² + D)
//! c_s Y y' = −T,  c_s (Y y'' + y'²) = −T',  c_s (Y y''' + 3 y' y'') = −T''
//! ```
//!
//! Without preload y is no smooth function of θ where E is largest: y0 must be above 0. The mass of the second follower is left
//! out of the law.

use super::{Jet, Motion, Piece};
use crate::numeric::extremum;
use crate::refusal::Refusal;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Cells in which the extrema of the work in a piece are searched: a handful a piece.
const CELLS: u32 = 64;

/// Work given elsewhere and its derivatives by the cam angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WorkJet {
    /// E, J.
    pub energy: f64,
    /// T = dE/dθ, N·m.
    pub torque: f64,
    /// dT/dθ, N·m/rad.
    pub torque_slope: f64,
    /// d²T/dθ², N·m/rad².
    pub torque_second: f64,
}

impl WorkJet {
    /// The jet by θ = ratio · φ of a jet by φ.
    #[must_use]
    pub fn by_angle_times(self, ratio: f64) -> Self {
        let n = 1.0 / ratio;
        Self {
            energy: self.energy,
            torque: self.torque * n,
            torque_slope: self.torque_slope * n * n,
            torque_second: self.torque_second * n * n * n,
        }
    }
}

impl std::ops::Add for WorkJet {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            energy: self.energy + other.energy,
            torque: self.torque + other.torque,
            torque_slope: self.torque_slope + other.torque_slope,
            torque_second: self.torque_second + other.torque_second,
        }
    }
}

/// What asks a torque of a shaft, over one turn of the cam.
pub trait Work: std::fmt::Debug + Send + Sync {
    /// The pieces on which it is smooth, as [`Motion::pieces`]; a dwell is where nothing is given and nothing taken.
    fn pieces(&self) -> &[Piece];

    /// Equal lobes of a turn.
    fn lobes(&self) -> u32 {
        1
    }

    /// Work and torque at an angle of a piece.
    fn work_at(&self, piece: usize, angle: f64) -> WorkJet;
}

/// The law for one spring and one largest work.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CounterTorque {
    rate: f64,
    /// y0, m.
    preloaded: f64,
    energy_max: f64,
}

impl CounterTorque {
    /// The law for a spring rate `c_s` (N/m), the force of the spring where the lift is 0 (N) and the largest work (J), where the
    /// lift is 0.
    ///
    /// # Errors
    /// [`Refusal`] unless rate and preload are finite and above 0, and the work is finite.
    pub fn new(rate: f64, preload: f64, energy_max: f64) -> Result<Self, Refusal> {
        if !(rate > 0.0 && rate.is_finite()) {
            return Err(Refusal::new(format!("the rate of the counter-torque spring is {rate} N/m"))
                .remedy("it must be above 0"));
        }
        if !(preload > 0.0 && preload.is_finite()) {
            return Err(Refusal::new(format!("the preload of the counter-torque spring is {preload} N"))
                .remedy("it must be above 0"));
        }
        if !energy_max.is_finite() {
            return Err(Refusal::new(format!("the largest work is {energy_max} J, which is not a finite number")));
        }
        Ok(Self { rate, preloaded: preload / rate, energy_max })
    }

    /// Lift of the second follower, m, with three derivatives by the cam angle. A work above the largest is taken as the largest.
    #[must_use]
    pub fn jet(&self, work: WorkJet) -> Jet {
        let lack = (2.0 * (self.energy_max - work.energy) / self.rate).max(0.0);
        let length = (self.preloaded * self.preloaded + lack).sqrt();
        let by_force = -1.0 / (self.rate * length);
        let ds = by_force * work.torque;
        let dds = by_force * (work.torque_slope + self.rate * ds * ds);
        let ddds = by_force * (work.torque_second + 3.0 * self.rate * ds * dds);
        Jet { s: lack / (self.preloaded + length), ds, dds, ddds }
    }

    /// Force of the spring at a lift, N.
    #[must_use]
    pub fn spring_force(&self, lift: f64) -> f64 {
        self.rate * (self.preloaded + lift)
    }

    /// Force of the spring where the lift is 0, N.
    #[must_use]
    pub fn preload(&self) -> f64 {
        self.rate * self.preloaded
    }

    /// Rate of the spring, N/m.
    #[must_use]
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Torque of the spring, N·m by the cam angle, at a jet of this law: the opposite of the work's.
    #[must_use]
    pub fn spring_torque(&self, jet: Jet) -> f64 {
        self.spring_force(jet.s) * jet.ds
    }
}

/// The motion of a follower by this law against some work on its shaft.
#[derive(Debug, Clone)]
pub struct CounterMotion {
    work: Arc<dyn Work>,
    law: CounterTorque,
    /// Work between its least and its largest, J.
    stored: f64,
    pieces: Vec<Piece>,
}

impl CounterMotion {
    /// The motion with a spring rate (N/m) and the force of the spring where the lift is 0 (N).
    ///
    /// # Errors
    /// As [`CounterTorque::new`].
    pub fn new(work: Arc<dyn Work>, rate: f64, preload: f64) -> Result<Self, Refusal> {
        let pieces = work.pieces().to_vec();
        let distinct = pieces.len() / usize::try_from(work.lobes().max(1)).unwrap_or(1);
        let [most, least] = [1.0, -1.0].map(|sign| {
            let extremes = pieces.iter().take(distinct.max(1)).enumerate().map(|(index, piece)| {
                let cells = if piece.dwell { 1 } else { CELLS };
                let extreme = extremum::largest(
                    |angle| sign * work.work_at(index, angle).energy,
                    |angle| sign * work.work_at(index, angle).torque,
                    (piece.start, piece.end),
                    cells,
                );
                extreme.value
            });
            sign * extremes.fold(f64::NEG_INFINITY, f64::max)
        });
        Ok(Self { law: CounterTorque::new(rate, preload, most)?, stored: most - least, pieces, work })
    }

    /// The law of its spring.
    #[must_use]
    pub fn law(&self) -> &CounterTorque {
        &self.law
    }

    /// Work between its least and its largest, J: what the spring takes up and gives back.
    #[must_use]
    pub fn stored(&self) -> f64 {
        self.stored
    }
}

impl Motion for CounterMotion {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn lobes(&self) -> u32 {
        self.work.lobes()
    }

    fn jet(&self, piece: usize, angle: f64) -> Jet {
        let lift = self.law.jet(self.work.work_at(piece, angle));
        if self.pieces.get(piece).is_some_and(|piece| piece.dwell) { Jet { s: lift.s, ..Jet::default() } } else { lift }
    }
}

/// The pieces of a turn with those next to each other on which nothing is given or taken made one: for each the piece it is made of
/// and how far its angle is shifted from that, rad.
#[must_use]
pub fn merged(pieces: &[Piece], rests: &[bool]) -> Vec<(Piece, usize, f64)> {
    let own: Vec<_> = pieces.iter().zip(rests.iter().copied().chain(std::iter::repeat(false))).enumerate().collect();
    // A turn that begins within a rest would cut it in two.
    let first = own.iter().position(|(_, (_, rests))| !rests).unwrap_or(0);
    let mut all: Vec<(Piece, usize, f64)> = Vec::new();
    for (step, (index, (piece, rests))) in own.iter().cycle().skip(first).take(own.len()).enumerate() {
        let shift = if first + step < pieces.len() { 0.0 } else { TAU };
        match all.last_mut() {
            Some((last, ..)) if last.dwell && *rests => last.end = piece.end + shift,
            _ => {
                let start = all.last().map_or(piece.start, |(last, ..)| last.end);
                all.push((Piece { start, end: piece.end + shift, dwell: *rests }, *index, shift));
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    /// A spring pressed by a source of any kind: E = −sin² θ. Each derivative is the difference quotient of the one before, to
    /// h²/6 of the derivative two orders beyond, which stays below a hundred, and 1e-16/h.
    #[test]
    fn derivatives_belong_to_their_values() {
        let disc = CounterTorque::new(3.0, 1.5, 0.0).expect("positive");
        let jet = |angle: f64| {
            let (s, c) = (libm::sin(2.0 * angle), libm::cos(2.0 * angle));
            let energy = -libm::sin(angle) * libm::sin(angle);
            disc.jet(WorkJet { energy, torque: -s, torque_slope: -2.0 * c, torque_second: 4.0 * s })
        };
        let h = 1e-5;
        for i in 0..60 {
            let angle = 0.1 * f64::from(i);
            let difference = |f: fn(Jet) -> f64| (f(jet(angle + h)) - f(jet(angle - h))) / (2.0 * h);
            let at = jet(angle);
            assert!((at.ds - difference(|j| j.s)).abs() < 1e-8);
            assert!((at.dds - difference(|j| j.ds)).abs() < 1e-8);
            assert!((at.ddds - difference(|j| j.dds)).abs() < 1e-8);
            let kept = 1.5 * (0.5 + at.s) * (0.5 + at.s) - libm::sin(angle) * libm::sin(angle);
            assert!((kept - 0.375).abs() < 4e-15, "energy of spring and source");
        }
        let by_half = WorkJet { energy: 1.0, torque: 2.0, torque_slope: 4.0, torque_second: 8.0 }.by_angle_times(2.0);
        assert_eq!(by_half, WorkJet { energy: 1.0, torque: 1.0, torque_slope: 1.0, torque_second: 1.0 });
    }

    #[test]
    fn refuses_a_spring_without_preload_or_rate() {
        for preload in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = CounterTorque::new(1e5, preload, 0.0).expect_err("no preload");
            assert!(error.what.starts_with("the preload of the counter-torque spring is"), "{error}");
        }
        let what = |made: Result<CounterTorque, Refusal>| made.expect_err("refused").what;
        assert_eq!(what(CounterTorque::new(0.0, 1.0, 0.0)), "the rate of the counter-torque spring is 0 N/m");
        assert!(what(CounterTorque::new(1.0, 1.0, f64::NAN)).starts_with("the largest work is NaN J"));
    }
}

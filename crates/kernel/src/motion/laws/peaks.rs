//! The largest velocity, acceleration, jerk and torque of a curve, and how near it comes to what is possible.

use super::curve::LawCurve;
use crate::numeric::extremum::{self, Extremum, ValueAndSlope};
use crate::numeric::quadrature;

/// Panels of a part over which the square is integrated: 1e-16 of ten half waves.
const PANELS: u32 = 8;
/// A smaller share of the peak is rounding.
const ROUNDING: f64 = 1e-9;

/// Value and slope of something by s, s', …, s⁗.
type CurveQuantity = fn(&[f64; 5]) -> (f64, f64);

const VELOCITY: CurveQuantity = |s| (s[1], s[2]);
const ACCELERATION: CurveQuantity = |s| (s[2], s[3]);
const JERK: CurveQuantity = |s| (s[3], s[4]);

/// The peaks of a curve, as sizes, each with its place x; in units of travel and width of the segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawPeaks {
    /// max |s'|: Cv.
    pub velocity: Extremum,
    /// max |s''|: Ca.
    pub acceleration: Extremum,
    /// max |s'''|: Cj; infinite where s'' jumps inside. A jump of s'' at the ends depends on the neighbours.
    pub jerk: Extremum,
    /// max |s' s''|: the torque of inertia, C(va).
    pub torque: Extremum,
    /// ∫ s''² dx: the heat in a drive.
    pub square: f64,
}

impl LawCurve {
    /// The peaks, to rounding.
    #[must_use]
    pub fn peaks(&self) -> LawPeaks {
        let squares = (0..self.parts()).map(|part| {
            quadrature::integrate(
                |x| self.derivative(part, x, 2) * self.derivative(part, x, 2),
                self.range_of(part),
                PANELS,
            )
        });
        let torque: CurveQuantity = |s| (s[1] * s[2], s[2] * s[2] + s[1] * s[3]);
        let [velocity, acceleration, jerk, torque] = self.largest([VELOCITY, ACCELERATION, JERK, torque]);
        LawPeaks { velocity, acceleration, jerk: self.or_jump(jerk), torque, square: squares.sum() }
    }

    /// The peaks of velocity, acceleration and jerk only.
    #[must_use]
    pub fn peak_rates(&self) -> [Extremum; 3] {
        let [velocity, acceleration, jerk] = self.largest([VELOCITY, ACCELERATION, JERK]);
        [velocity, acceleration, self.or_jump(jerk)]
    }

    /// The peak of the jerk; infinite where the acceleration jumps inside.
    fn or_jump(&self, jerk: Extremum) -> Extremum {
        self.first_jump(2).map_or(jerk, |part| Extremum { at: self.range_of(part).0, value: f64::INFINITY })
    }

    /// The least peak acceleration possible over this curve's: of laws between rests with the same peak jerk, or with any where
    /// the acceleration jumps. `None` where an end moves.
    ///
    /// With |s'''| ≤ Cj the least of all peaks has the law whose jerk is ±Cj or 0 in ramps of a/2 of the width,
    /// Cj = 8/(a (1 − a)): Ca = 4/(1 − a). That is 4 without a limit of jerk.
    #[must_use]
    pub fn efficiency(&self) -> Option<f64> {
        self.efficiency_of(&self.peaks())
    }

    /// The efficiency of a curve whose peaks are known.
    #[must_use]
    pub fn efficiency_of(&self, peaks: &LawPeaks) -> Option<f64> {
        let last = self.parts().saturating_sub(1);
        let ends = [self.values_at(0, 0.0), self.values_at(last, 1.0)];
        let [moves, accelerates] = [(1, peaks.velocity), (2, peaks.acceleration)]
            .map(|(order, peak)| ends.iter().any(|end: &[f64; 4]| end[order].abs() > ROUNDING * peak.value));
        if moves {
            return None;
        }
        let jumps = peaks.jerk.value.is_infinite() || accelerates;
        // No law has a jerk below 32: less is rounding.
        let share = if jumps { 0.0 } else { (1.0 - 32.0 / peaks.jerk.value).max(0.0).sqrt() };
        let ramp = if jumps { 0.0 } else { 0.5 * (1.0 - share) };
        Some(4.0 / (1.0 - ramp) / peaks.acceleration.value)
    }

    /// The largest sizes of functions of s, s', …, s⁗, which give their values and slopes.
    fn largest<const N: usize>(&self, of: [CurveQuantity; N]) -> [Extremum; N] {
        let all = |part: usize, x: f64| {
            let [s, first, second, third] = self.values_at(part, x);
            [s, first, second, third, self.derivative(part, x, 4)]
        };
        let parts = (0..self.parts()).map(|part| {
            let places = extremum::between_cells(self.range_of(part), self.cells(part));
            places.map(|x| (x, all(part, x))).collect()
        });
        let parts: Vec<Vec<(f64, [f64; 5])>> = parts.collect();
        of.map(|f| {
            let nothing = Extremum { at: 0.0, value: f64::NEG_INFINITY };
            let (mut rising, mut falling) = (Vec::with_capacity(parts.len()), Vec::with_capacity(parts.len()));
            for part in &parts {
                let places = part.iter().map(|(at, s)| {
                    let (value, slope) = f(s);
                    ValueAndSlope { at: *at, value, slope }
                });
                let places: Vec<ValueAndSlope> = places.collect();
                falling.push(places.iter().map(|place| place.negative()).collect::<Vec<_>>());
                rising.push(places);
            }
            let known = rising
                .iter()
                .zip(&falling)
                .fold(nothing, |best, (rising, falling)| extremum::highest(extremum::highest(best, rising), falling));
            rising.iter().zip(&falling).enumerate().fold(known, |best, (part, (rising, falling))| {
                let best = extremum::beyond(best, rising, |x| f(&all(part, x)));
                extremum::beyond(best, falling, |x| {
                    let (value, slope) = f(&all(part, x));
                    (-value, -slope)
                })
            })
        })
    }
}

//! Splines as curves: quintic of least jerk, or cubic of least acceleration, through knots from x = 0 to x = 1.

use super::bernstein::Bernstein;
use super::curve::{CurvePart, LawCurve};
use crate::numeric::least_jerk::{self, NodeInterval};
use crate::numeric::spline::Spline;

/// Stretches that are treated as one, in a spline with few knots; with many knots, as many as give [`MOST_GROUPS`].
const TOGETHER: usize = 4;
const MOST_GROUPS: usize = 16;

/// How a spline goes on at its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SplineEnds {
    /// Like at its other end.
    Periodic,
    /// As the inner knots determine: the outermost three stretches at either end are one polynomial.
    Free,
    /// Velocity and acceleration 0.
    Rest,
}

/// The curve of polynomials with given derivatives, the value first, at each knot.
#[must_use]
pub fn chain<const N: usize>(knots: &[f64], nodes: &[[f64; N]]) -> LawCurve {
    let pairs = knots.iter().zip(knots.iter().skip(1)).zip(nodes.iter().zip(nodes.iter().skip(1)));
    let parts = pairs.map(|((from, to), (first, last))| {
        let width = to - from;
        let [first, last] = [first, last].map(|node| {
            let mut power = 1.0;
            node.map(|value| {
                let scaled = value * power;
                power *= width;
                scaled
            })
        });
        CurvePart::Stretch { range: (*from, width), polynomial: Bernstein::hermite(&first, &last) }
    });
    let parts: Vec<CurvePart> = parts.collect();
    let together = TOGETHER.max(parts.len().div_ceil(MOST_GROUPS));
    let joints = knots.get(1..knots.len().saturating_sub(1)).unwrap_or_default().to_vec();
    LawCurve::of_many(joints, parts, together)
}

/// Sums of the sizes of the factors with which six values at equal steps make the velocity and the acceleration at the first of them
/// (137/60 + 5 + 5 + 10/3 + 5/4 + 1/5 and 15/4 + 77/6 + 107/6 + 13 + 61/12 + 5/6): errors of the values grow by as much, over the step and
/// its square.
const OF_FIRST: f64 = 17.1;
const OF_SECOND: f64 = 53.4;

/// Velocity and acceleration at the knots of the spline of [`SplineEnds::Free`] through values that are wrong by up to an error: an end whose velocity the error explains begins
/// with velocity 0, and with acceleration 0 where it explains that too. Rounding is no impact.
#[must_use]
pub fn states_of_rounded(knots: &[f64], values: &[f64], error: f64) -> Vec<[f64; 2]> {
    let mut states = least_jerk::not_a_knot(knots, values);
    let last = states.len().saturating_sub(1);
    let knot = |at: usize| knots.get(at).copied().unwrap_or(0.0);
    let mut given = vec![[None; 2]; states.len()];
    let mut changed = false;
    for (end, width) in [(0, knot(1) - knot(0)), (last, knot(last) - knot(last.saturating_sub(1)))] {
        let (Some(state), Some(given)) = (states.get(end), given.get_mut(end)) else { continue };
        let (velocity, acceleration) = (OF_FIRST * error / width, OF_SECOND * error / (width * width));
        let [v, a] = *state;
        let rests = v != 0.0 && v.abs() <= velocity;
        let new = if rests { [0.0, if a.abs() <= acceleration { 0.0 } else { a }] } else { [v, a] };
        (*given, changed) = (new.map(Some), changed || rests);
    }
    if changed {
        let pairs = knots.iter().zip(knots.iter().skip(1)).zip(values.iter().zip(values.iter().skip(1)));
        let intervals: Vec<NodeInterval> =
            pairs.map(|((x0, x1), (y0, y1))| Some((x1 - x0, y1 - y0))).chain([None]).collect();
        states = least_jerk::least_jerk(&intervals, &given);
    }
    states
}

/// The quintic spline of least ∫(s''')² through values at knots, which run from 0 to 1.
#[must_use]
pub fn quintic(knots: &[f64], values: &[f64], ends: SplineEnds) -> LawCurve {
    let states = states(knots, values, ends);
    let nodes: Vec<[f64; 3]> = values.iter().zip(states).map(|(value, [v, a])| [*value, v, a]).collect();
    chain(knots, &nodes)
}

/// Velocity and acceleration at the knots of that spline.
#[must_use]
pub fn states(knots: &[f64], values: &[f64], ends: SplineEnds) -> Vec<[f64; 2]> {
    let pairs = knots.iter().zip(knots.iter().skip(1)).zip(values.iter().zip(values.iter().skip(1)));
    let mut intervals: Vec<NodeInterval> = pairs.map(|((x0, x1), (y0, y1))| Some((x1 - x0, y1 - y0))).collect();
    match ends {
        SplineEnds::Free => least_jerk::not_a_knot(knots, values),
        SplineEnds::Periodic => {
            let mut states = least_jerk::least_jerk(&intervals, &vec![[None; 2]; intervals.len()]);
            states.extend(states.first().copied());
            states
        }
        SplineEnds::Rest => {
            let mut given = vec![[None; 2]; values.len()];
            for end in [0, values.len().saturating_sub(1)] {
                if let Some(given) = given.get_mut(end) {
                    *given = [Some(0.0); 2];
                }
            }
            intervals.push(None);
            least_jerk::least_jerk(&intervals, &given)
        }
    }
}

/// The periodic cubic spline of least ∫(s'')²; three intervals or more.
#[must_use]
pub fn cubic(knots: &[f64], values: &[f64]) -> LawCurve {
    let spline = Spline::periodic(knots, values);
    let first = spline.cubics().first().map(|[_, slope, ..]| *slope);
    of_cubics(knots, values, &spline, first.unwrap_or(0.0))
}

/// The cubic spline of least ∫(s'')² that begins and ends with velocity 0.
#[must_use]
pub fn cubic_at_rest(knots: &[f64], values: &[f64]) -> LawCurve {
    of_cubics(knots, values, &Spline::clamped(knots, values, (0.0, 0.0)), 0.0)
}

/// The curve of a cubic spline with this slope at its end.
fn of_cubics(knots: &[f64], values: &[f64], spline: &Spline, last: f64) -> LawCurve {
    let slopes = spline.cubics().iter().map(|[_, slope, ..]| *slope).chain([last]);
    let nodes: Vec<[f64; 2]> = values.iter().zip(slopes).map(|(value, slope)| [*value, slope]).collect();
    chain(knots, &nodes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Values of 40-digit arithmetic at 100°, by the radian.
    #[test]
    fn a_periodic_spline_is_the_known_one() {
        let knots = [0.0, 60.0, 130.0, 200.0, 290.0, 360.0].map(|degrees: f64| degrees / 360.0);
        let curve = quintic(&knots, &[0.0, 12.0, 25.0, 18.0, 4.0, 0.0], SplineEnds::Periodic);
        let x = 100.0 / 360.0;
        let found = curve.values_at(curve.part_of(x), x);
        let known = [21.632_151_819_059_75, 10.504_873_044_522_27, -13.619_313_166_588_42, -14.696_224_865_491_6];
        for ((order, found), known) in (0..).zip(found).zip(known) {
            let by_angle = (0..order).fold(found, |value, _| value / TAU);
            assert!((by_angle - known).abs() < 1e-12, "{order}: {by_angle}");
        }
        for order in 0..5 {
            assert_eq!(curve.first_jump(order), None, "{order}");
            let (first, last) = (curve.derivative(0, 0.0, order), curve.derivative(4, 1.0, order));
            assert!((first - last).abs() < 1e-10 * (1.0 + first.abs()), "{order}: {first} {last}");
        }
        assert!(curve.first_jump(5).is_some());
    }

    #[test]
    fn ends_are_as_they_are_asked_for() {
        let knots: Vec<f64> = (0..=10).map(|index| f64::from(index) / 10.0).collect();
        let f = |x: f64| x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
        let values: Vec<f64> = knots.iter().map(|x| f(*x)).collect();
        for ends in [SplineEnds::Free, SplineEnds::Rest] {
            let curve = quintic(&knots, &values, ends);
            for index in 0..=200 {
                let x = f64::from(index) / 200.0;
                let [s, v, a, j] = curve.values_at(curve.part_of(x), x);
                let known = [f(x), 30.0 * x * x * (1.0 - x) * (1.0 - x), 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x)];
                for (found, known) in [s, v, a].iter().zip(known) {
                    assert!((found - known).abs() < 1e-10, "{ends:?} at {x}: {found} {known}");
                }
                assert!((j - (60.0 - 360.0 * x + 360.0 * x * x)).abs() < 1e-8, "{ends:?} at {x}: {j}");
            }
        }
    }

    #[test]
    fn a_cubic_has_a_continuous_acceleration() {
        let knots = [0.0, 0.2, 0.3, 0.7, 1.0];
        let curve = cubic(&knots, &[1.0, 2.0, 0.0, 3.0, 1.0]);
        assert_eq!((curve.first_jump(2), curve.first_jump(3)), (None, Some(1)));
        let (first, last) = (curve.derivative(0, 0.0, 2), curve.derivative(3, 1.0, 2));
        assert!((first - last).abs() < 1e-11 * first.abs(), "{first} {last}");
    }
}

//! Rows inside of a segment: the points of a spline, the shares of a table.

use super::nodes::{Nodes, RowRun};
use super::{RowFigures, RowOutlier, RowShape, RowWishes, smoothing};
use crate::document::TableReader;
use crate::motion::laws::spline::{self, SplineEnds};
use crate::motion::laws::{LawCurve, LawError};
use crate::motion::program::keys::{BETWEEN_ROWS, SMOOTH_ROWS, SPLINE, TABULATED};
use crate::numeric::bounded_jerk::NotMonotonic;
use crate::numeric::least_jerk::NodeConstraint;
use crate::numeric::scatter::median;
use crate::units::Dimension;

/// Shares with a last digit above this are a choice of numbers, not rounding.
const MOST_ROUNDING: f64 = 5e-3;

/// The points of a spline between the ends of its segment.
#[derive(Debug, Clone, PartialEq)]
pub struct SplineRows {
    /// Angle from the start of the segment, rad, and position.
    pub points: Vec<[f64; 2]>,
    /// Step to which the positions are rounded, m or rad.
    pub rounding: f64,
    /// How the curve goes through them or near them.
    pub wishes: RowWishes,
}

impl RowWishes {
    /// The wishes of a segment, whose rows are rounded to a step, each dimension of `smooth` with the size of the unit of the rows.
    pub(in crate::motion::program) fn of_segment(
        segment: &TableReader<'_>,
        rounding: f64,
        dimensions: &[(Dimension, f64)],
    ) -> Option<Self> {
        let shape = if segment.has(&BETWEEN_ROWS) { segment.get(&BETWEEN_ROWS)? } else { RowShape::Natural };
        Some(Self { shape, cubic: false, smooth: smoothing(segment, &SMOOTH_ROWS, rounding, dimensions).ok()? })
    }
}

/// Refuses the keys of rows in a segment of another law.
pub(in crate::motion::program) fn refuse_keys(segment: &TableReader<'_>, law: &str) -> Option<()> {
    let message =
        |name: &str| format!("`{name}` applies only to the laws \"{SPLINE}\" and \"{TABULATED}\", not to {law}");
    let help = || Some("remove it".to_owned());
    let (shape, smooth) = (segment.has(&BETWEEN_ROWS), segment.has(&SMOOTH_ROWS));
    if shape {
        segment.fail(&BETWEEN_ROWS, message("shape"), help());
    }
    if smooth {
        segment.fail(&SMOOTH_ROWS, message("smooth"), help());
    }
    (!shape && !smooth).then_some(())
}

/// Rows of a segment without rests, rounded to a step, with what is given at its ends.
fn run<'a>(knots: &'a [f64], values: &'a [f64], rounding: f64, ends: [NodeConstraint; 2]) -> RowRun<'a> {
    let mut widths: Vec<f64> = knots.iter().zip(knots.iter().skip(1)).map(|(from, to)| to - from).collect();
    RowRun {
        knots,
        values,
        dwells: vec![false; widths.len()],
        ends: Some(ends),
        spacing: median(&mut widths),
        rounding,
    }
}

/// The states at both ends, given.
fn ends_of(found: &Nodes) -> [NodeConstraint; 2] {
    [found.states.first(), found.states.last()].map(|state| state.copied().unwrap_or_default().map(Some))
}

impl SplineRows {
    /// The smoothed positions on shares of the segment, and the intervals that rest; what is given at its ends is by the share.
    pub(in crate::motion::program) fn smoothed(
        &self,
        knots: &[f64],
        values: &[f64],
        ends: [NodeConstraint; 2],
    ) -> (Vec<f64>, Vec<bool>) {
        let rows = run(knots, values, self.rounding, ends);
        match rows.nodes(RowShape::Natural, self.wishes.smooth.unwrap_or(0.0)) {
            Ok(found) => (found.values, found.dwells),
            Err(_) => (values.to_vec(), rows.dwells),
        }
    }

    /// The curve over shares of the segment, and its figures by the share: `typed` are the positions of the points, `values` those that it
    /// passes, with the states of least jerk by the share.
    ///
    /// # Errors
    /// A state at an end that contradicts `shape`.
    pub(in crate::motion::program) fn curve(
        &self,
        knots: &[f64],
        typed: &[f64],
        values: Vec<f64>,
        dwells: Vec<bool>,
        states: Vec<[f64; 2]>,
    ) -> Result<(LawCurve, RowFigures), LawError> {
        let mut found = Nodes { values, states, dwells };
        let ends = ends_of(&found);
        if self.wishes.shape == RowShape::Monotonic {
            let rows = RowRun { dwells: found.dwells.clone(), ..run(knots, &found.values, self.rounding, ends) };
            let monotonic = rows.nodes(RowShape::Monotonic, 0.0);
            found = monotonic.map_err(|at| contradiction(knots, &found, at))?;
        }
        let mut figures = run(knots, typed, self.rounding, ends).figures(&found, self.wishes, &[]);
        // The start of the segment is not one of the given points.
        figures.outlier = figures.outlier.map(|outlier| RowOutlier { row: outlier.row.saturating_sub(1), ..outlier });
        Ok((spline::chain(knots, &found.jets()), figures))
    }
}

/// Whether a monotonic curve over an interval of a rise can begin with a velocity and an acceleration, all by the share of the interval and in
/// the direction of the rise.
fn allowed(rise: f64, [v, a]: [f64; 2]) -> bool {
    v >= 0.0 && v + 0.25 * a >= 0.0 && 2.0 * v + 0.25 * a < 5.0 * rise
}

/// The state between two intervals, as width and rise, each of them where a curve is to be monotonic on it: the one given, or, where one of
/// them does not allow it, the same velocity without acceleration as far as both do.
pub(in crate::motion::program) fn between(intervals: [Option<(f64, f64)>; 2], state: [f64; 2]) -> [f64; 2] {
    let [before, after] = intervals;
    // Seen from the node into the interval, a velocity before it has the sign of the rise, too.
    let allows = |interval: Option<(f64, f64)>, inward: f64, [v, a]: [f64; 2]| {
        interval.is_none_or(|(width, rise)| {
            let up = if rise < 0.0 { -1.0 } else { 1.0 };
            allowed(rise.abs(), [up * v * width, inward * up * a * width * width])
        })
    };
    if allows(before, -1.0, state) && allows(after, 1.0, state) {
        return state;
    }
    let slopes = || intervals.into_iter().flatten().map(|(width, rise)| rise / width);
    let (low, high) = slopes().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| (low.min(s), high.max(s)));
    if low > 0.0 {
        [state[0].clamp(0.0, low), 0.0]
    } else if high < 0.0 {
        [state[0].clamp(high, 0.0), 0.0]
    } else {
        [0.0; 2]
    }
}

/// Why a state at an end of a segment contradicts a monotonic curve.
fn contradiction(knots: &[f64], found: &Nodes, NotMonotonic { interval }: NotMonotonic) -> LawError {
    let [width, rise] = [knots, &found.values].map(|list| {
        let [from, to] = [interval, interval + 1].map(|at| list.get(at).copied().unwrap_or(0.0));
        to - from
    });
    let up = if rise < 0.0 { -1.0 } else { 1.0 };
    // Seen from the end into the segment.
    let state = |node: usize, inward: f64| {
        let (_, [v, a]) = found.node(node);
        [up * v * width, inward * up * a * width * width]
    };
    let last = interval + 2 == knots.len();
    let first = interval == 0 && !(last && allowed(rise.abs(), state(0, 1.0)));
    let (does, point) = if first { ("begins", "first") } else { ("ends", "last") };
    let [v, a] = if first { state(0, 1.0) } else { state(interval + 1, -1.0) };
    let how = if rise == 0.0 {
        format!("{does} moving, but its {point} point is at the same position")
    } else if v < 0.0 {
        format!("{does} with a velocity that leads out of the range between that end and its {point} point")
    } else if v + 0.25 * a < 0.0 {
        format!("{does} with an acceleration that leads out of the range between that end and its {point} point")
    } else {
        let most = 2.5 - 0.125 * a / rise.abs();
        format!(
            "{does} with {:.4} times the mean velocity between that end and its {point} point, and with its acceleration less than {:.4} times is \
             possible",
            v / rise.abs(),
            most.max(0.0)
        )
    };
    LawError::new("shape", format!("shape = \"monotonic\" contradicts the state at an end: the segment {how}"))
        .remedy("remove `shape`, or give a state at that end, or points, that allow it")
}

/// The curve of a table of shares, and its figures in shares.
pub(in crate::motion::program) fn tabulated(
    knots: &[f64],
    values: &[f64],
    ends: SplineEnds,
    wishes: RowWishes,
) -> (LawCurve, RowFigures) {
    let rounding = super::rounding::step(values);
    let error = 0.5 * rounding;
    let seen = error > 0.0 && error < MOST_ROUNDING;
    let states = if ends == SplineEnds::Free && seen {
        spline::states_of_rounded(knots, values, error)
    } else {
        spline::states(knots, values, ends)
    };
    let mut found = Nodes { values: values.to_vec(), states, dwells: vec![false; knots.len().saturating_sub(1)] };
    let given = rests_of(knots, values, ends, wishes.smooth.unwrap_or(error).max(if seen { error } else { 0.0 }));
    let rows = run(knots, values, rounding, given);
    let smooth = wishes.smooth.unwrap_or(0.0);
    if smooth > 0.0
        && let Ok(smoothed) = rows.nodes(RowShape::Natural, smooth)
    {
        found = smoothed;
    }
    if wishes.shape == RowShape::Monotonic {
        // The table determines its ends: where theirs contradict the shape, they give way.
        let with = |ends: [NodeConstraint; 2]| {
            let rows = RowRun { dwells: found.dwells.clone(), ..run(knots, &found.values, rounding, ends) };
            rows.nodes(RowShape::Monotonic, 0.0)
        };
        let free = if ends == SplineEnds::Rest { [[Some(0.0); 2]; 2] } else { [[None; 2]; 2] };
        found = with(ends_of(&found)).or_else(|_| with(free)).unwrap_or(found);
    }
    let figures = rows.figures(&found, wishes, &[]);
    (spline::chain(knots, &found.jets()), figures)
}

/// What is given at the ends of a table whose values are wrong by up to an error: rest where that is asked for, or explains them.
fn rests_of(knots: &[f64], values: &[f64], ends: SplineEnds, error: f64) -> [NodeConstraint; 2] {
    if ends == SplineEnds::Rest {
        return [[Some(0.0); 2]; 2];
    }
    let states = spline::states_of_rounded(knots, values, error);
    [states.first(), states.last()].map(|state| {
        let [v, a] = state.copied().unwrap_or([1.0; 2]);
        let rests = v == 0.0;
        [rests.then_some(0.0), (rests && a == 0.0).then_some(0.0)]
    })
}

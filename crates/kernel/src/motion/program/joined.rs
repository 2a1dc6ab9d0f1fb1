//! Segments that are joined into splines of least jerk: those with the law spline, and polynomials that meet at a state to be found.
//!
//! All of a program are solved at once, in one ring of nodes: a chain of joined segments is clamped where it ends by the states that are
//! given there, and a program of nothing else closes.

use super::rows::{self, RowFigures, RowShape};
use super::{EndState, Mover, SegmentSpec};
use crate::motion::laws::LawCurve;
use crate::motion::laws::LawError;
use crate::motion::laws::spline;
use crate::numeric::least_jerk::{NodeConstraint, NodeInterval, least_jerk};

/// A node of the ring: angle and position, measured from the start of its segment.
type RingNode = [f64; 2];

/// A segment with its nodes, the first at its start.
struct SegmentNodes {
    joined: bool,
    nodes: Vec<RingNode>,
    /// Positions that the curve passes in their place, with the one at its end, and the intervals that rest.
    passed: (Vec<f64>, Vec<bool>),
    /// Which node of the ring is its first.
    first: usize,
    /// Where it starts.
    from: f64,
}

/// A curve with positions measured from its start, and the figures of its rows by the share.
type JoinedCurve = (LawCurve, Option<RowFigures>);

/// Steps with every state known, and the curves of those that are joined.
type JoinedSegments = (Vec<SegmentSpec>, Vec<Option<JoinedCurve>>);

/// The given parts of a state.
fn given(state: &EndState) -> NodeConstraint {
    let acceleration = if state.turns { state.turning } else { (!state.free[1]).then_some(state.acceleration) };
    [(!state.free[0]).then_some(state.velocity), acceleration]
}

impl SegmentNodes {
    /// The nodes of a segment, between a state at its start and one at its end.
    fn new(step: &SegmentSpec, joined: bool, first: usize, from: f64, ends: [NodeConstraint; 2]) -> Self {
        let rows = if let Mover::Spline(rows) = &step.mover { Some(rows) } else { None };
        let inner: &[RingNode] = rows.map_or(&[], |rows| &rows.points);
        let nodes: Vec<RingNode> =
            std::iter::once([0.0; 2]).chain(inner.iter().map(|[angle, position]| [*angle, *position - from])).collect();
        let mut all = Self { joined, nodes, passed: (Vec::new(), Vec::new()), first, from };
        let typed = all.typed(step);
        all.passed = if let Some(rows) = rows.filter(|rows| rows.wishes.smooth.is_some()) {
            let width = step.over;
            let by_share = ends.map(|[v, a]| [v.map(|v| v * width), a.map(|a| a * width * width)]);
            rows.smoothed(&all.knots(width), &typed, by_share)
        } else {
            let intervals = typed.len().saturating_sub(1);
            (typed, vec![false; intervals])
        };
        all
    }

    /// The angles of the nodes and of the end as shares of a width.
    fn knots(&self, width: f64) -> Vec<f64> {
        self.nodes.iter().map(|[angle, _]| angle / width).chain([1.0]).collect()
    }

    /// The positions of the nodes and of the end as typed.
    fn typed(&self, step: &SegmentSpec) -> Vec<f64> {
        self.nodes.iter().map(|[_, position]| *position).chain([step.to - self.from]).collect()
    }

    /// From each node to the next one or the end.
    fn intervals<'a>(&'a self, step: &SegmentSpec) -> impl Iterator<Item = NodeInterval> + 'a {
        let next = self.nodes.iter().map(|[angle, _]| *angle).skip(1).chain([step.over]);
        let angles = self.nodes.iter().map(|[angle, _]| *angle).zip(next);
        let values = self.passed.0.iter().zip(self.passed.0.iter().skip(1));
        angles.zip(values).map(|((from, to), (a, b))| self.joined.then_some((to - from, b - a)))
    }

    /// What is given at its nodes behind the first: rest at either end of an interval that rests.
    fn inner_given(&self) -> impl Iterator<Item = NodeConstraint> + '_ {
        let rests = &self.passed.1;
        rests.iter().zip(rests.iter().skip(1)).map(|(before, after)| [(*before || *after).then_some(0.0); 2])
    }

    /// The curve through the nodes with their velocities and accelerations.
    fn curve(&self, step: &SegmentSpec, state: impl Fn(usize) -> [f64; 2]) -> Result<JoinedCurve, LawError> {
        let (width, knots) = (step.over, self.knots(step.over));
        let states = (0..knots.len()).map(|node| {
            let [velocity, acceleration] = state(node);
            [velocity * width, acceleration * width * width]
        });
        let states: Vec<[f64; 2]> = states.collect();
        if let Mover::Spline(rows) = &step.mover {
            let (values, dwells) = self.passed.clone();
            let (curve, figures) = rows.curve(&knots, &self.typed(step), values, dwells, states)?;
            return Ok((curve, Some(figures)));
        }
        let jets: Vec<[f64; 3]> = self.passed.0.iter().zip(states).map(|(value, [v, a])| [*value, v, a]).collect();
        Ok((spline::chain(&knots, &jets), None))
    }
}

/// The steps with every state known, and the curves of those that are joined, with positions measured from their starts.
///
/// Where rows are smoothed, each segment is so by itself; the ring then goes through the smoothed positions.
///
/// # Errors
/// The segment whose states contradict the shape of its rows.
pub(super) fn solve(start: f64, steps: &[SegmentSpec]) -> Result<JoinedSegments, (usize, LawError)> {
    let (mut all_nodes, mut first) = (Vec::with_capacity(steps.len()), 0);
    let mut all_given: Vec<NodeConstraint> = Vec::new();
    let mut intervals: Vec<NodeInterval> = Vec::new();
    let mut from = start;
    for (index, step) in steps.iter().enumerate() {
        let (begin, joined) = (before(steps, index), is_joined(steps, index));
        let begin = given(&if step.free_start { begin.without_acceleration() } else { begin });
        let segment = SegmentNodes::new(step, joined, first, from, [begin, given(&step.end)]);
        intervals.extend(segment.intervals(step));
        all_given.push(begin);
        all_given.extend(segment.inner_given());
        (first, from) = (first + segment.nodes.len(), step.to);
        all_nodes.push(segment);
    }
    if !all_nodes.iter().any(|segment| segment.joined) {
        return Ok((steps.to_vec(), vec![None; steps.len()]));
    }
    let mut states = least_jerk(&intervals, &all_given);
    if fit_found_states(steps, &all_nodes, &intervals, &states, &mut all_given) {
        states = least_jerk(&intervals, &all_given);
    }
    let state = |node: usize| states.get(node % states.len().max(1)).copied().unwrap_or_default();
    let known = steps.iter().zip(&all_nodes).map(|(step, segment)| {
        let [velocity, acceleration] = state(segment.first + segment.nodes.len());
        let end = if step.end.is_found() {
            EndState { velocity, acceleration, free: [false; 2], ..step.end }
        } else {
            step.end
        };
        SegmentSpec { end, ..step.clone() }
    });
    let curves = steps.iter().zip(&all_nodes).enumerate().map(|(index, (step, segment))| {
        let curve = segment.joined.then(|| segment.curve(step, |node| state(segment.first + node)));
        curve.transpose().map_err(|error| (index, error))
    });
    Ok((known.collect(), curves.collect::<Result<_, _>>()?))
}

/// Gives the states that are found next to a monotonic spline where these do not allow them; whether there is such a one.
fn fit_found_states(
    steps: &[SegmentSpec],
    all_nodes: &[SegmentNodes],
    intervals: &[NodeInterval],
    states: &[[f64; 2]],
    all_given: &mut [NodeConstraint],
) -> bool {
    let mut changed = false;
    for ((step, following), segment) in steps.iter().zip(steps.iter().cycle().skip(1)).zip(all_nodes) {
        let end = &step.end;
        if !(end.free == [true; 2] || (end.turns && end.turning.is_none())) {
            continue;
        }
        let last = segment.first + segment.nodes.len() - 1;
        let node = (last + 1) % states.len().max(1);
        let Some(state) = states.get(node) else { continue };
        let monotonic = [(step, last), (following, node)].map(|(step, at)| match &step.mover {
            Mover::Spline(rows) if rows.wishes.shape == RowShape::Monotonic => intervals.get(at).copied().flatten(),
            _ => None,
        });
        let kept = rows::segment::between(monotonic, *state);
        if kept != *state
            && let Some(given) = all_given.get_mut(node)
        {
            (*given, changed) = (kept.map(Some), true);
        }
    }
    changed
}

/// The state at the start of a segment.
fn before(steps: &[SegmentSpec], index: usize) -> EndState {
    let before = index.checked_sub(1).unwrap_or(steps.len().saturating_sub(1));
    steps.get(before).map_or_else(EndState::default, |step| step.end)
}

/// Whether a segment is part of a spline.
fn is_joined(steps: &[SegmentSpec], index: usize) -> bool {
    let free = EndState::is_found;
    steps.get(index).is_some_and(|step| match &step.mover {
        Mover::Spline(_) => true,
        Mover::Polynomial => free(&before(steps, index)) || free(&step.end),
        _ => false,
    })
}

/// A state can be found only between polynomials and splines, and no jerk may be given next to these.
pub(super) fn check(steps: &[SegmentSpec]) -> Result<(), (usize, LawError)> {
    for (index, (step, next)) in steps.iter().zip(steps.iter().cycle().skip(1)).enumerate() {
        let other = [step, next].into_iter().find(|step| !matches!(step.mover, Mover::Polynomial | Mover::Spline(_)));
        if let Some(other) = other.filter(|_| step.end.is_found()) {
            let law = other.mover.name();
            let what = format!(
                "\"auto\" finds the state of least jerk between two polynomials or splines, but {law} is neither"
            );
            return Err((index, LawError::new("velocity", what).remedy("give the state")));
        }
        let following = (index + 1) % steps.len();
        if next.free_start && is_joined(steps, index) && is_joined(steps, following) {
            let what = "between two splines there is one acceleration, which cannot be free on one side";
            return Err((following, LawError::new("start", what).remedy("remove `start`")));
        }
        let adjacent = [index, following];
        if step.end.jerk.is_some() && adjacent.into_iter().any(|index| is_joined(steps, index)) {
            let what = "next to a spline or an \"auto\" state the jerk cannot be given";
            return Err((index, LawError::new("jerk", what).remedy("remove `jerk`")));
        }
    }
    Ok(())
}

//! Segments that are joined into splines of least jerk: those with the law spline, and polynomials that meet at a state to be found.
//!
//! All of a program are solved at once, in one ring of nodes: a chain of joined segments is clamped where it ends by the states that are
//! given there, and a program of nothing else closes.

use super::{Mover, State, Step, StepError};
use crate::motion::laws::Curve;
use crate::motion::laws::spline;
use crate::numeric::least_jerk::{Given, Interval, least_jerk};

/// A node of the ring: angle behind the start of its segment, and position behind that.
type Node = [f64; 2];

/// A segment with the nodes on its way, the first at its start.
struct Way {
    joined: bool,
    nodes: Vec<Node>,
    /// Which node of the ring is its first.
    first: usize,
    /// Where it starts.
    from: f64,
}

/// Steps with every state known, and the curves of those that are joined.
type Solved = (Vec<Step>, Vec<Option<Curve>>);

/// What is given of a state.
fn given(state: &State) -> Given {
    let acceleration = (!state.free[1] && !state.turns).then_some(state.acceleration);
    [(!state.free[0]).then_some(state.velocity), acceleration]
}

/// The steps with every state known, and the curves of those that are joined, by the position behind their starts.
pub(super) fn solved(start: f64, steps: &[Step]) -> Result<Solved, (usize, StepError)> {
    check(steps)?;
    let (mut ways, mut first) = (Vec::with_capacity(steps.len()), 0);
    let mut all_given: Vec<Given> = Vec::new();
    let mut intervals: Vec<Interval> = Vec::new();
    let mut from = start;
    for (index, step) in steps.iter().enumerate() {
        let (begin, joined) = (before(steps, index), is_joined(steps, index));
        let inner: &[Node] = if let Mover::Spline(points) = &step.mover { points } else { &[] };
        let nodes: Vec<Node> =
            std::iter::once([0.0; 2]).chain(inner.iter().map(|[angle, position]| [*angle, position - from])).collect();
        let next = nodes.iter().copied().skip(1).chain([[step.over, step.to - from]]);
        intervals.extend(nodes.iter().zip(next).map(|(a, b)| joined.then_some((b[0] - a[0], b[1] - a[1]))));
        all_given.push(given(&begin));
        all_given.extend(inner.iter().map(|_| [None; 2]));
        let count = nodes.len();
        ways.push(Way { joined, nodes, first, from });
        (first, from) = (first + count, step.to);
    }
    if !ways.iter().any(|way| way.joined) {
        return Ok((steps.to_vec(), vec![None; steps.len()]));
    }
    let states = least_jerk(&intervals, &all_given);
    let state = |node: usize| states.get(node % states.len().max(1)).copied().unwrap_or_default();
    let known = steps.iter().zip(&ways).map(|(step, way)| {
        let [velocity, acceleration] = state(way.first + way.nodes.len());
        let end = if step.end.free.contains(&true) {
            State { velocity, acceleration, free: [false; 2], ..step.end }
        } else {
            step.end
        };
        Step { end, ..step.clone() }
    });
    let curves = steps.iter().zip(&ways).map(|(step, way)| {
        let all = way.nodes.iter().copied().chain([[step.over, step.to - way.from]]);
        way.joined.then(|| curve(step.over, &all.collect::<Vec<_>>(), |node| state(way.first + node)))
    });
    Ok((known.collect(), curves.collect()))
}

/// The state in which a segment begins.
fn before(steps: &[Step], index: usize) -> State {
    let before = index.checked_sub(1).unwrap_or(steps.len().saturating_sub(1));
    steps.get(before).map_or_else(State::default, |step| step.end)
}

/// Whether a segment is part of a spline.
fn is_joined(steps: &[Step], index: usize) -> bool {
    let free = |state: &State| state.free.contains(&true);
    steps.get(index).is_some_and(|step| match &step.mover {
        Mover::Spline(_) => true,
        Mover::Polynomial => free(&before(steps, index)) || free(&step.end),
        _ => false,
    })
}

/// The curve through nodes with their velocities and accelerations.
fn curve(width: f64, nodes: &[Node], state: impl Fn(usize) -> [f64; 2]) -> Curve {
    let knots: Vec<f64> = nodes
        .iter()
        .enumerate()
        .map(|(node, [angle, _])| if node + 1 == nodes.len() { 1.0 } else { angle / width })
        .collect();
    let jets: Vec<[f64; 3]> = nodes
        .iter()
        .enumerate()
        .map(|(node, [_, position])| {
            let [velocity, acceleration] = state(node);
            [*position, velocity * width, acceleration * width * width]
        })
        .collect();
    spline::chain(&knots, &jets)
}

/// A state is found only between polynomials and splines, and beside these no jerk is given.
fn check(steps: &[Step]) -> Result<(), (usize, StepError)> {
    let smooth = |step: &Step| matches!(step.mover, Mover::Polynomial | Mover::Spline(_));
    for (index, (step, next)) in steps.iter().zip(steps.iter().cycle().skip(1)).enumerate() {
        let other = [step, next].into_iter().find(|step| !smooth(step));
        if let Some(other) = other.filter(|_| step.end.free.contains(&true)) {
            return Err((index, StepError::NothingToJoin { law: other.mover.name() }));
        }
        let beside = [index, (index + 1) % steps.len()];
        if step.end.jerk.is_some() && beside.into_iter().any(|index| is_joined(steps, index)) {
            return Err((index, StepError::JerkOfSpline));
        }
    }
    Ok(())
}

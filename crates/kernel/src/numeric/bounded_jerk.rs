//! Quintic splines of least ∫(s''')² under bounds: near given values (smoothing), or never outside of the values of two neighbours
//! (monotonic).
//!
//! Smoothing: C. H. Reinsch, "Smoothing by spline functions", Numer. Math. 10 (1967), with a bound on each deviation instead of one on
//! the sum of their squares, since rounding is bounded.
//!
//! Monotonic: a quintic between two nodes grows where the Bernstein coefficients of its slope are not negative; with these sufficient
//! conditions, which are linear, a continuous second derivative is always possible, and the spline of least ∫(s''')² among them is a
//! quadratic program (W. Heß, J. W. Schmidt, "Positive quartic, monotone quintic C²-spline interpolation in one and two dimensions",
//! J. Comput. Appl. Math. 55 (1994); the exact conditions are those of G. Ulrich, L. T. Watson, "Positivity conditions for quartic
//! polynomials", SIAM J. Sci. Comput. 15 (1994)).

use super::bounded::{self, Bound, QuadraticForm};
use super::least_jerk::{NodeConstraint, NodeInterval, forms, least_jerk};

/// Three unknowns at each of two nodes that are two places apart.
const BAND: usize = 9;
/// Share of the straight slope with which the search of a monotonic spline begins.
const BEGINNING: f64 = 0.25;
/// Spans of second differences grow by this part of themselves.
const FINER: usize = 8;
/// By how much given states may break a condition by rounding, as a share of the largest rise.
const TAKEN: f64 = 1e-12;

/// What is given of a node: by how much its value changes, its velocity, its acceleration.
pub type Given = [Option<f64>; 3];

/// A value that stays.
pub const STAYS: Option<f64> = Some(0.0);

/// An interval on which no monotonic spline has the states that are given at its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NotMonotonic {
    /// The interval.
    pub interval: usize,
}

/// Velocity (1) or acceleration (2) of a node, and its factor.
type Term = ((usize, usize), f64);

/// The unknowns of a ring of nodes in an order in which the ring is a band.
struct Unknowns {
    /// Of each node: value, velocity, acceleration.
    of_node: Vec<[Option<usize>; 3]>,
    given: Vec<Given>,
    count: usize,
    /// The mean width of the intervals.
    width: f64,
    /// The unit of the values.
    size: f64,
}

impl Unknowns {
    fn new(intervals: &[NodeInterval], given: &[Given], size: f64) -> Self {
        let nodes = given.len();
        let mut of_node = vec![[None; 3]; nodes];
        let mut count = 0;
        // 0, n − 1, 1, n − 2, …
        for place in 0..nodes {
            let node = if place % 2 == 0 { place / 2 } else { nodes - 1 - place / 2 };
            let (Some(slots), Some(given)) = (of_node.get_mut(node), given.get(node)) else { continue };
            for (slot, given) in slots.iter_mut().zip(given) {
                if given.is_none() {
                    *slot = Some(count);
                    count += 1;
                }
            }
        }
        let widths: Vec<f64> = intervals.iter().flatten().map(|(width, _)| *width).collect();
        let width = widths.iter().sum::<f64>() / f64::from(u32::try_from(widths.len().max(1)).unwrap_or(u32::MAX));
        Self { of_node, given: given.to_vec(), count, width, size }
    }

    fn unknown(&self, node: usize, which: usize) -> Option<usize> {
        self.of_node.get(node).and_then(|slots| slots.get(which)).copied().flatten()
    }

    /// What is given of a node, in units of the unknowns; 0 of an unknown.
    fn known(&self, node: usize, which: usize) -> f64 {
        let given = self.given.get(node).and_then(|given| given.get(which)).copied().flatten();
        given.map_or(0.0, |value| value / self.unit(which))
    }

    /// What an unknown is in units of the caller: value, velocity, acceleration.
    fn unit(&self, which: usize) -> f64 {
        match which {
            0 => self.size,
            1 => self.size / self.width,
            _ => self.size / self.width / self.width,
        }
    }

    /// ∫(s''')² over all intervals, over a constant.
    fn form(&self, intervals: &[NodeInterval]) -> QuadraticForm<BAND> {
        let mut form = QuadraticForm::zero(self.count);
        let nodes = self.of_node.len();
        for (node, interval) in intervals.iter().enumerate().take(nodes) {
            let Some((width, rise)) = *interval else { continue };
            let next = (node + 1) % nodes;
            for (weight, [v0, a0, v1, a1], per_rise) in forms(width / self.width, 1.0) {
                let all = [
                    (node, 0, -per_rise),
                    (node, 1, v0),
                    (node, 2, a0),
                    (next, 0, per_rise),
                    (next, 1, v1),
                    (next, 2, a1),
                ];
                let terms: Vec<(usize, f64)> = all
                    .into_iter()
                    .filter_map(|(node, which, factor)| self.unknown(node, which).map(|unknown| (unknown, factor)))
                    .collect();
                let known: f64 = all.into_iter().map(|(node, which, factor)| factor * self.known(node, which)).sum();
                form.add_square(weight, &terms, per_rise * rise / self.size + known);
            }
        }
        form
    }

    /// What was found, of each node.
    fn found(&self, values: &[f64]) -> Vec<[f64; 3]> {
        let nodes = (0..self.of_node.len()).map(|node| {
            [0, 1, 2].map(|which| {
                let given = self.given.get(node).and_then(|given| given.get(which)).copied().flatten();
                let found = self.unknown(node, which).and_then(|unknown| values.get(unknown)).copied();
                given.unwrap_or_else(|| found.unwrap_or(0.0) * self.unit(which))
            })
        });
        nodes.collect()
    }
}

/// By how much the value of each node of a ring is changed, less than `most`, with velocity and acceleration there: the spline of least
/// ∫(s''')² within these bounds, and with no more acceleration than the values show, where that is possible. Interval k leads from node k to the next; what is given stays.
#[must_use]
pub fn smoothed(intervals: &[NodeInterval], given: &[Given], most: f64) -> Vec<[f64; 3]> {
    let states: Vec<NodeConstraint> = given.iter().map(|[_, v, a]| [*v, *a]).collect();
    let through = least_jerk(intervals, &states);
    if !(most > 0.0) || given.iter().all(|[value, ..]| value.is_some()) {
        return through.iter().map(|[v, a]| [0.0, *v, *a]).collect();
    }
    let unknowns = Unknowns::new(intervals, given, most);
    let mut start = vec![0.0; unknowns.count];
    let mut bounds = Vec::new();
    for (node, state) in through.iter().enumerate() {
        for (which, value) in [(1, state[0]), (2, state[1])] {
            if let Some(slot) = unknowns.unknown(node, which).and_then(|unknown| start.get_mut(unknown)) {
                *slot = value / unknowns.unit(which);
            }
        }
        if let Some(unknown) = unknowns.unknown(node, 0) {
            bounds.extend([1.0, -1.0].map(|sign| Bound { terms: vec![(unknown, sign)], most: 1.0 }));
        }
    }
    let form = unknowns.form(intervals);
    let found = bounded::least(&form, &bounds, start);
    let all = unknowns.found(&found);
    let largest = all.iter().map(|[_, _, acceleration]| acceleration.abs()).fold(0.0, f64::max);
    let steepest = given.iter().filter_map(|[_, _, a]| *a).map(f64::abs).fold(0.0, f64::max);
    let enough = enough(intervals, most).map(|enough| enough.max(steepest));
    let Some(enough) = enough.filter(|enough| *enough < largest) else { return all };
    for unknown in (0..given.len()).filter_map(|node| unknowns.unknown(node, 2)) {
        let most = enough / unknowns.unit(2);
        bounds.extend([1.0, -1.0].map(|sign| Bound { terms: vec![(unknown, sign)], most }));
    }
    bounded::least_from_outside(&form, &bounds, found).map_or(all, |found| unknowns.found(&found))
}

/// The acceleration that values show which may be wrong by `most`: that of the second difference from which most is left when all three are as
/// wrong as possible, with half of that error. `None` where rest explains all. A law needs no more, but least jerk does next to a jump of the
/// acceleration, as a truncated Fourier series would.
fn enough(intervals: &[NodeInterval], most: f64) -> Option<f64> {
    let (mut places, mut values) = (vec![0.0], vec![0.0]);
    let (mut place, mut value) = (0.0, 0.0);
    // A ring goes on, a chain ends.
    for (width, rise) in intervals.iter().chain(intervals).map_while(|interval| *interval) {
        (place, value) = (place + width, value + rise);
        places.push(place);
        values.push(value);
    }
    let (mut least, mut shown) = (0.0, None);
    let mut by = 1;
    while 2 * by < intervals.len() {
        for at in 0..intervals.len() {
            let places = [at, at + by, at + 2 * by].map(|node| places.get(node).copied());
            let values = [at, at + by, at + 2 * by].map(|node| values.get(node).copied());
            let ([Some(x0), Some(x1), Some(x2)], [Some(y0), Some(y1), Some(y2)]) = (places, values) else { break };
            let (before, after, mean) = (x1 - x0, x2 - x1, 0.5 * (x2 - x0));
            let bend = ((y2 - y1) / after - (y1 - y0) / before).abs() / mean;
            let off = 2.0 * most * (1.0 / before + 1.0 / after) / mean;
            if bend - off > least {
                (least, shown) = (bend - off, Some(bend + 0.5 * off));
            }
        }
        by += 1 + by / FINER;
    }
    shown
}

fn interval(intervals: &[NodeInterval], index: usize) -> NodeInterval {
    intervals.get(index).copied().flatten()
}

/// What is given at the nodes of a monotonic spline: it is constant where the values of both ends are equal, and its velocity is 0 at an
/// extreme.
fn given_of_monotonic(given: &[Given], all_intervals: &[NodeInterval]) -> Result<Vec<Given>, NotMonotonic> {
    let nodes = given.len();
    let mut all: Vec<Given> = given.iter().map(|[_, v, a]| [STAYS, *v, *a]).collect();
    for (node, slot) in all.iter_mut().enumerate() {
        let intervals = [(node + nodes - 1) % nodes, node];
        let [before, after] = intervals.map(|index| interval(all_intervals, index));
        let [flat_before, flat_after] = [before, after].map(|interval| interval.is_some_and(|(_, rise)| rise == 0.0));
        let turns = before.zip(after).is_some_and(|((_, a), (_, b))| (a > 0.0) != (b > 0.0));
        let [_, v, a] = slot;
        let rests = flat_before || flat_after;
        let [moves, accelerates] = [*v, *a].map(|given| given.is_some_and(|given| given != 0.0));
        if ((rests || turns) && moves) || (rests && accelerates) {
            let interval = if flat_after || before.is_none() { intervals[1] } else { intervals[0] };
            return Err(NotMonotonic { interval });
        }
        if rests {
            *slot = [STAYS; 3];
        } else if turns {
            *v = Some(0.0);
        }
    }
    Ok(all)
}

/// Velocity and acceleration at each node of a ring, so that the spline lies between the values of both ends on every interval: where they
/// are equal it is constant, where a value is larger or smaller than both of its neighbours it is an extreme. Interval k leads from node k
/// to the next; what is given stays.
///
/// # Errors
/// The interval on which a given state leads out of the range of both ends, or faster through it than the conditions allow.
pub fn monotonic(intervals: &[NodeInterval], given: &[Given]) -> Result<Vec<[f64; 2]>, NotMonotonic> {
    let nodes = given.len();
    let given = given_of_monotonic(given, intervals)?;
    let size = intervals.iter().flatten().map(|(_, rise)| rise.abs()).fold(0.0, f64::max);
    if !(size > 0.0) {
        return Ok(vec![[0.0; 2]; nodes]);
    }
    let unknowns = Unknowns::new(intervals, &given, size);
    let start = unknowns.inside(intervals);
    let mut bounds = Vec::new();
    for node in 0..nodes {
        let Some(interval) = interval(intervals, node).filter(|(_, rise)| *rise != 0.0) else { continue };
        for bound in unknowns.conditions(node, interval.0, interval.1) {
            let kept = if bound.terms.is_empty() { bound.most >= -TAKEN } else { bound.sum(&start) < bound.most };
            if !kept {
                return Err(NotMonotonic { interval: node });
            }
            if !bound.terms.is_empty() {
                bounds.push(bound);
            }
        }
    }
    let found = unknowns.found(&bounded::least(&unknowns.form(intervals), &bounds, start));
    Ok(found.into_iter().map(|[_, v, a]| [v, a]).collect())
}

impl Unknowns {
    /// Unknowns strictly inside of the conditions of a monotonic spline, where there are such.
    fn inside(&self, intervals: &[NodeInterval]) -> Vec<f64> {
        let nodes = self.given.len();
        let mut start = vec![0.0; self.count];
        for node in 0..nodes {
            let before = (node + nodes - 1) % nodes;
            let Some((_, leads)) = interval(intervals, node).or(interval(intervals, before)) else { continue };
            let around = [before, node].into_iter().filter_map(|index| self.free_rise(intervals, index));
            if let Some(slot) = self.unknown(node, 1).and_then(|unknown| start.get_mut(unknown)) {
                let slope = around.map(|(width, rise)| rise / width).fold(f64::INFINITY, f64::min);
                *slot = BEGINNING * leads.signum() * slope / self.unit(1);
            } else if let Some(slot) = self.unknown(node, 2).and_then(|unknown| start.get_mut(unknown))
                && self.known(node, 1) == 0.0
            {
                // At an extreme, and at the end of a rest, the acceleration points to where the next interval leads, or from where the
                // last one comes.
                let sign = if interval(intervals, node).is_some() { leads.signum() } else { -leads.signum() };
                let bend = around.map(|(width, rise)| rise / width / width).fold(f64::INFINITY, f64::min);
                *slot = BEGINNING * sign * bend / self.unit(2);
            }
        }
        start
    }

    /// Width of an interval and the part of its rise, without sign, that the given states do not take.
    fn free_rise(&self, intervals: &[NodeInterval], index: usize) -> NodeInterval {
        let (width, rise) = interval(intervals, index)?;
        let (next, h) = ((index + 1) % self.given.len(), width / self.width);
        let [v0, a0, v1, a1] =
            [(index, 1), (index, 2), (next, 1), (next, 2)].map(|(node, which)| self.known(node, which));
        let taken = rise.signum() * (0.4 * h * (v0 + v1) + 0.05 * h * h * (a0 - a1)) * self.size;
        Some((width, rise.abs() - taken.max(0.0)))
    }

    /// The sufficient conditions of an interval; those of given states alone have no unknowns.
    fn conditions(&self, node: usize, width: f64, rise: f64) -> Vec<Bound> {
        let (h, next, up) = (width / self.width, (node + 1) % self.given.len(), rise.signum());
        let (v0, a0, v1, a1) = ((node, 1), (node, 2), (next, 1), (next, 2));
        // Five times the differences of neighbouring coefficients: V₀, V₀ + A₀/4, 5 D − 2 (V₀ + V₁) + (A₁ − A₀)/4, V₁ − A₁/4, V₁, with
        // V = v h, A = a h² and the rise D.
        let rows: [(&[Term], f64); 5] = [
            (&[(v0, -h)], 0.0),
            (&[(v0, -h), (a0, -0.25 * h * h)], 0.0),
            (&[(v0, 2.0 * h), (v1, 2.0 * h), (a0, 0.25 * h * h), (a1, -0.25 * h * h)], 5.0 * rise.abs() / self.size),
            (&[(v1, -h), (a1, 0.25 * h * h)], 0.0),
            (&[(v1, -h)], 0.0),
        ];
        let bounds = rows.into_iter().map(|(terms, most)| Bound {
            terms: terms
                .iter()
                .filter_map(|((node, which), factor)| self.unknown(*node, *which).map(|unknown| (unknown, up * factor)))
                .collect(),
            most: most
                - terms.iter().map(|((node, which), factor)| up * factor * self.known(*node, *which)).sum::<f64>(),
        });
        bounds.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn intervals(knots: &[f64], values: &[f64]) -> Vec<NodeInterval> {
        knots.windows(2).zip(values.windows(2)).map(|(x, y)| Some((x[1] - x[0], y[1] - y[0]))).collect()
    }

    /// A value between two nodes, by Hermite's quintic.
    fn between(width: f64, [y0, v0, a0]: [f64; 3], [y1, v1, a1]: [f64; 3], t: f64) -> f64 {
        let (h, d) = (width, y1 - y0);
        let b = [
            0.0,
            v0 * h / 5.0,
            0.4 * v0 * h + a0 * h * h / 20.0,
            d - 0.4 * v1 * h + a1 * h * h / 20.0,
            d - v1 * h / 5.0,
            d,
        ];
        let weights = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];
        let terms = (0..6).zip(b.iter().zip(weights)).map(|(k, (b, w))| w * b * t.powi(k) * (1.0 - t).powi(5 - k));
        y0 + terms.sum::<f64>()
    }

    /// Rows of a sine rounded to a hundredth: within half of that of each, and nearer to the sine between them than the spline through them.
    #[test]
    fn rounding_is_smoothed_within_its_bound() {
        for count in [40_u32, 360, 2000] {
            let step = std::f64::consts::TAU / f64::from(count);
            let knots: Vec<f64> = (0..=count).map(|i| f64::from(i) * step).collect();
            let values: Vec<f64> = knots.iter().map(|x| (100.0 * x.sin()).round() / 100.0).collect();
            let ring = intervals(&knots, &values);
            let found = smoothed(&ring, &vec![[None; 3]; ring.len()], 0.005);
            let peak = found.iter().map(|state| state[2].abs()).fold(0.0, f64::max);
            assert!((0.95..1.05).contains(&peak), "{count}: {peak}");
            let through = least_jerk(&ring, &vec![[None; 2]; ring.len()]);
            let rough = through.iter().map(|state| state[1].abs()).fold(0.0, f64::max);
            assert!(count == 40 || rough > 1.5, "{count}: {rough}");
            for [off, ..] in found {
                assert!(off.abs() < 0.005, "{count}: {off}");
            }
        }
    }

    /// Rows of a parabola, whose acceleration jumps: that of the curve overshoots it by less than 10 %, in a ring and in a chain.
    #[test]
    fn a_jump_of_the_acceleration_is_hardly_overshot() {
        let law = |x: f64| if x < 0.5 { 2.0 * x * x } else { 1.0 - 2.0 * (1.0 - x) * (1.0 - x) };
        let lift = |x: f64| match x {
            x if x < 0.1 => 0.0,
            x if x < 0.4 => law((x - 0.1) / 0.3),
            x if x < 0.6 => 1.0,
            x if x < 0.9 => law((0.9 - x) / 0.3),
            _ => 0.0,
        };
        let knots: Vec<f64> = (0..=360).map(|i| f64::from(i) / 360.0).collect();
        for grain in [1e-3, 2.5e-3] {
            let values: Vec<f64> = knots.iter().map(|x| (lift(*x) / grain).round() * grain).collect();
            let ring = intervals(&knots, &values);
            let mut chain = ring.clone();
            chain.push(None);
            let mut given: Vec<Given> = vec![[None; 3]; chain.len()];
            (given[0], given[360]) = ([STAYS; 3], [STAYS; 3]);
            for (intervals, given) in [(&ring, vec![[None; 3]; 360]), (&chain, given)] {
                let found = smoothed(intervals, &given, 0.5 * grain);
                let peak = found.iter().map(|state| state[2].abs()).fold(0.0, f64::max) * 0.3 * 0.3 / 4.0;
                assert!((0.97..1.1).contains(&peak), "{grain}: {peak}");
                assert!(found.iter().all(|[off, ..]| off.abs() < 0.5 * grain), "{grain}");
            }
        }
    }

    /// States that are given at the ends of a chain are kept, by smoothing and by a monotonic spline, or named where they cannot be.
    #[test]
    fn given_states_are_kept() {
        let knots: Vec<f64> = (0..=10).map(|i| f64::from(i) * 0.1).collect();
        let values: Vec<f64> = knots.iter().map(|x| (100.0 * x * x).round() / 100.0 + 0.5 * x).collect();
        let mut chain = intervals(&knots, &values);
        chain.push(None);
        let ends = |v0: f64, a0: f64, v1: f64, a1: f64| {
            let mut given: Vec<Given> = vec![[None; 3]; knots.len()];
            (given[0], given[10]) = ([STAYS, Some(v0), Some(a0)], [STAYS, Some(v1), Some(a1)]);
            given
        };
        let smooth = smoothed(&chain, &ends(0.7, -1.0, 2.6, 3.0), 0.005);
        assert_eq!((smooth[0], smooth[10]), ([0.0, 0.7, -1.0], [0.0, 2.6, 3.0]));
        assert!(smooth.iter().all(|[off, ..]| off.abs() < 0.005), "{smooth:?}");
        // The optimum is stationary where no bound acts: with loose bounds the states are those of least jerk through the found values.
        let moved: Vec<f64> = values.iter().zip(&smooth).map(|(value, [off, ..])| value + off).collect();
        let mut through = intervals(&knots, &moved);
        through.push(None);
        let given: Vec<NodeConstraint> = ends(0.7, -1.0, 2.6, 3.0).iter().map(|[_, v, a]| [*v, *a]).collect();
        for (found, known) in smooth.iter().zip(least_jerk(&through, &given)) {
            assert!((found[1] - known[0]).abs() < 1e-3 && (found[2] - known[1]).abs() < 1e-1, "{found:?} {known:?}");
        }
        let kept = monotonic(&chain, &ends(0.7, 0.5, 2.6, 3.0)).expect("possible");
        assert_eq!((kept[0], kept[10]), ([0.7, 0.5], [2.6, 3.0]));
        for node in 0..10 {
            for part in 0..=50 {
                let t = f64::from(part) / 50.0;
                let state = |at: usize| [values[at], kept[at][0], kept[at][1]];
                let found = between(0.1, state(node), state(node + 1), t);
                assert!(found >= values[node] - 1e-12 && found <= values[node + 1] + 1e-12, "{node} at {t}: {found}");
            }
        }
        for (given, interval) in [
            (ends(-0.1, 0.0, 2.6, 3.0), 0),
            (ends(0.7, -100.0, 2.6, 3.0), 0),
            (ends(9.0, 0.0, 2.6, 3.0), 0),
            (ends(0.7, 0.0, 2.6, 300.0), 9),
            (ends(0.7, 0.0, -0.1, 0.0), 9),
        ] {
            assert_eq!(monotonic(&chain, &given), Err(NotMonotonic { interval }), "{given:?}");
        }
    }

    /// Values with rests, a step, a spike and uneven widths: the spline never leaves its neighbours; rows of a smooth monotone curve keep it.
    #[test]
    fn a_monotonic_spline_never_leaves_its_neighbours() {
        let uneven: Vec<f64> = vec![0.0, 0.1, 0.25, 0.3, 0.31, 0.5, 0.8, 0.9, 1.0];
        for values in [
            vec![0.0, 0.0, 1.0, 4.0, 9.0, 9.0, 3.0, 2.9, 0.0],
            vec![0.0, 5.0, 5.1, 5.2, 9.0, 1.0, 1.1, 0.9, 0.0],
            vec![1.0, 2.0, 1.0, 2.0, 1.0, 2.0, 1.0, 7.0, 1.0],
        ] {
            let ring = intervals(&uneven, &values);
            let states = monotonic(&ring, &vec![[None; 3]; ring.len()]).expect("possible");
            for (node, pair) in values.windows(2).enumerate() {
                let width = uneven[node + 1] - uneven[node];
                let state = |at: usize, value: f64| [value, states[at % ring.len()][0], states[at % ring.len()][1]];
                let (low, high) = (pair[0].min(pair[1]), pair[0].max(pair[1]));
                for part in 0..=50 {
                    let t = f64::from(part) / 50.0;
                    let found = between(width, state(node, pair[0]), state(node + 1, pair[1]), t);
                    assert!(found >= low - 1e-12 && found <= high + 1e-12, "{node} at {t}: {found} of {pair:?}");
                }
            }
        }
        // A quarter of a sine with a free end is kept: no bound acts.
        let knots: Vec<f64> = (0..=20).map(|i| f64::from(i) * 0.07).collect();
        let values: Vec<f64> = knots.iter().map(|x| x.sin()).collect();
        let mut chain = intervals(&knots, &values);
        chain.push(None);
        let found = monotonic(&chain, &vec![[None; 3]; chain.len()]).expect("possible");
        let natural = least_jerk(&chain, &vec![[None; 2]; chain.len()]);
        for (a, b) in found.iter().zip(&natural) {
            assert!((a[0] - b[0]).abs() < 1e-5 && (a[1] - b[1]).abs() < 1e-3, "{a:?} {b:?}");
        }
    }
}

//! The worst places between those at which the follower was rolled: by the cubics through gaps and lift errors and their slopes, by
//! the space a roller leaves free between its feet, by parabolas through the residual forces, and by bisection where there is no slope.

use super::{BESIDE, ROUNDING, RollSample, RolledFlank};
use camgen_kernel::follower::Element;
use camgen_kernel::geometry::contour::Edge;
use camgen_kernel::numeric::{extremum, root};
use nalgebra::Vector2;

/// Between two places a maximum is looked for while it may exceed the largest found by more than this, mm.
const SLACK: f64 = 1e-10;
/// A maximum may be higher than the cubic by this share of what the cubic rises above its ends.
const DOUBT: f64 = 0.25;
/// The foot jumps where it moves this many times farther than the roller's centre.
const JUMP: f64 = 4.0;
/// Sine of the turn between two edges that counts as a corner, and how near to it a foot counts as at the corner, mm.
const CORNER: f64 = 1e-6;
const AT_CORNER: f64 = 1e-6;
/// Accuracy of the place that is as far from one foot as from another, over the distance between the places.
const EQUALLY_FAR: f64 = 1e-9;
/// Halvings between two places, and places in all that are refined.
const DEEPEST: u32 = 30;
const MOST_CLOSER: usize = 4000;
/// Worst places of a value without slope that are refined, and golden sections there: the value at a maximum is exact
/// to the square of the remaining step, 1e-8.
const CLOSER_LOOKS: usize = 8;
const CLOSER_SECTIONS: u32 = 19;
/// Parabolas to the top of a peak of the residual force, and the least step, over the width of the remaining range.
const PEAK_STEPS: u32 = 12;
/// Peaks that come this close to the largest are solved whatever the parabola predicts, and this many at most.
const CLOSE: f64 = 0.95;
const MOST_PEAKS: usize = 32;
/// Pairs of places whose larger force is nearly the largest get one more place between them.
const NEARLY: f64 = 0.1;
const LEAST_STEP: f64 = 1e-6;

/// The edges at whose end the outline has a corner, in their order.
pub(super) fn corners(edges: &[Edge]) -> Vec<usize> {
    let next = edges.iter().cycle().skip(1);
    let is_corner = |(before, next): (&Edge, &Edge)| {
        let (before, next) = (before.end_tangent(), next.start_tangent());
        before.perp(&next).abs() > CORNER || before.dot(&next) < 0.0
    };
    edges.iter().zip(next).enumerate().filter(|(_, pair)| is_corner(*pair)).map(|(index, _)| index).collect()
}

impl RolledFlank<'_> {
    /// The largest gap and lift error between the places: additional samples that are higher than those of the places, each where the
    /// cubic through two neighbours and their slopes is highest.
    pub(super) fn solved(&self, samples: &[RollSample]) -> Vec<RollSample> {
        let gap = |s: &RollSample| (s.gap, s.gap_slope);
        let lift = |s: &RollSample| (s.lift_error.unwrap_or(f64::NAN), s.lift_slope);
        let mut found: Vec<RollSample> = Vec::new();
        for (value, sags) in [(&gap as &dyn Fn(&RollSample) -> (f64, f64), true), (&lift, false)] {
            let promise_of = |pair: (&RollSample, &RollSample), best: f64| {
                let sag = if sags { self.sag(pair, best) } else { None };
                let promises = [bound_by_cubic(pair, value), bound_at_jump(pair, value), sag];
                promises.into_iter().flatten().max_by(|a, b| a.0.total_cmp(&b.0))
            };
            let mut best = samples.iter().map(|s| value(s).0.abs()).fold(0.0, f64::max);
            let pairs = samples.windows(2).enumerate().filter_map(|(index, pair)| match pair {
                [a, b] if a.piece == b.piece => Some((promise_of((a, b), best)?, [index, index + 1], DEEPEST)),
                _ => None,
            });
            let mut cells: Vec<RankedSpan> = pairs.filter(|((promise, _), ..)| *promise > best + SLACK).collect();
            // The most promising is last, from where it is taken.
            cells.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
            let mut left = MOST_CLOSER;
            while let Some(((promised, at), [from, to], depth)) = cells.pop() {
                if promised <= best + SLACK || left == 0 {
                    continue;
                }
                left -= 1;
                let of = |index: usize| samples.get(index).or_else(|| found.get(index - samples.len())).copied();
                let [Some(a), Some(b)] = [from, to].map(of) else { continue };
                let between = self.sample(a.piece, at);
                best = best.max(value(&between).0.abs());
                if depth > 0 {
                    let new = samples.len() + found.len();
                    let halves = [((a, between), [from, new]), ((between, b), [new, to])];
                    let promise = |((a, b), ends): ((RollSample, RollSample), [usize; 2])| {
                        Some((promise_of((&a, &b), best)?, ends, depth - 1))
                    };
                    cells.extend(halves.into_iter().filter_map(promise));
                }
                found.push(between);
            }
        }
        found
    }

    /// How far a roller may hang over the outline between the feet of two samples, mm, and where: it is no farther from the outline than
    /// from the nearer of the two. `None` where the outline runs smoothly from one to the other, or where less than `best` can result.
    fn sag(&self, (a, b): (&RollSample, &RollSample), best: f64) -> Option<(f64, f64)> {
        if !self.may_hang_over(a, b) {
            return None;
        }
        // From a fixed foot the distance grows with its slope at first, and by the square of the travel over it.
        let (way, rise) = ((b.centre - a.centre).norm(), a.gap_slope * (b.parameter - a.parameter));
        if a.foot == b.foot || a.gap + rise.max(0.0) + way * way / self.radius <= best {
            return None;
        }
        let centre = |at: f64| self.curves.touch(a.piece, at).curve.point * 1e3;
        let farther = |at: f64| {
            let centre = centre(at);
            (centre - a.foot).norm() - (centre - b.foot).norm()
        };
        let precision = EQUALLY_FAR * (b.parameter - a.parameter);
        let at = root::bracketed(farther, a.parameter, b.parameter, precision).ok()?;
        let promise = (centre(at) - a.foot).norm() - self.radius;
        (at > a.parameter && at < b.parameter).then_some((promise.max(0.0), at))
    }

    /// Whether there may be something between the feet of two samples of a roller that it does not reach: they are on edges that
    /// are not neighbours, or one is at a corner, or a corner is between them.
    fn may_hang_over(&self, a: &RollSample, b: &RollSample) -> bool {
        if matches!(self.curves.element(), Element::Face) {
            return false;
        }
        let edges = self.tree.edges();
        let n = edges.len().max(1);
        let after = |edge: usize| (edge + 1) % n;
        let ends_in_corner = |edge: usize| self.corners.binary_search(&edge).is_ok();
        let at_corner = |sample: &RollSample| {
            let Some(own) = edges.get(sample.edge) else { return false };
            let stands = |end: Vector2<f64>| (sample.foot - end).abs().max() < AT_CORNER;
            stands(own.start()) && ends_in_corner((sample.edge + n - 1) % n)
                || stands(own.end()) && ends_in_corner(sample.edge)
        };
        let apart = if a.edge == b.edge {
            false
        } else if after(a.edge) == b.edge {
            ends_in_corner(a.edge)
        } else if after(b.edge) == a.edge {
            ends_in_corner(b.edge)
        } else {
            true
        };
        apart || !self.corners.is_empty() && (at_corner(a) || at_corner(b))
    }

    /// Refined samples about the worst value of a quantity that has no slope.
    pub(super) fn closer(
        &self,
        samples: &[RollSample],
        value: impl Fn(&RollSample) -> f64,
        between: impl Fn(usize, f64) -> f64,
    ) -> Vec<RollSample> {
        let n = samples.len();
        let size = |index: usize| samples.get(index % n).map_or(0.0, &value);
        let mut peaks: Vec<usize> =
            (0..n).filter(|&i| size(i) > 0.0 && size(i) >= size(i + n - 1) && size(i) >= size(i + 1)).collect();
        peaks.sort_by(|&a, &b| size(b).total_cmp(&size(a)));
        peaks.truncate(CLOSER_LOOKS);
        let look = |&peak: &usize| {
            let own = samples.get(peak)?;
            // Within its own piece.
            let at = |other: Option<&RollSample>| {
                other.filter(|other| other.piece == own.piece).map_or(own.parameter, |o| o.parameter)
            };
            let range = (at(peak.checked_sub(1).and_then(|before| samples.get(before))), at(samples.get(peak + 1)));
            let worst = extremum::largest_without_slope(|p| between(own.piece, p), range, 2, CLOSER_SECTIONS);
            Some(self.sample(own.piece, worst.at))
        };
        peaks.iter().filter_map(look).collect()
    }

    /// The largest residual force between the places: every local maximum of the samples that may exceed the largest found, by
    /// the parabola through it and its neighbours, is solved by parabolas.
    pub(super) fn worst_residual(&self, samples: &[RollSample]) -> Vec<RollSample> {
        let mut best = samples.iter().map(|s| s.residual).fold(0.0, f64::max);
        if best == 0.0 {
            // No air force that could be left.
            return Vec::new();
        }
        let highest =
            |[a, b, c]: [&RollSample; 3]| a.piece == c.piece && b.residual >= a.residual && b.residual >= c.residual;
        // For each peak: how high it may be, the index of its first place, and that of its middle among the inserted places.
        let mut peaks: Vec<(f64, usize, Option<usize>)> = Vec::new();
        for (index, three) in samples.windows(3).enumerate() {
            let [a, b, c] = three else { continue };
            if highest([a, b, c]) {
                peaks.push((top_of(&[*a, *b, *c]).1, index, None));
            }
        }
        // Next to an end of a piece, or a jump, the highest place may lie between the last two: one is inserted there.
        let mut middles: Vec<RollSample> = Vec::new();
        for (index, pair) in samples.windows(2).enumerate() {
            let [a, b] = pair else { continue };
            let near = a.piece == b.piece && a.residual.max(b.residual) >= (1.0 - NEARLY) * best;
            let width = b.parameter - a.parameter;
            if near && width > 4.0 * BESIDE {
                let middle = self.sample(a.piece, a.parameter + 0.5 * width);
                if highest([a, &middle, b]) {
                    peaks.push((top_of(&[*a, middle, *b]).1, index, Some(middles.len())));
                    middles.push(middle);
                }
            }
        }
        peaks.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut found = Vec::new();
        for (top, first, middle) in peaks {
            let three = match middle {
                Some(middle) => [samples.get(first), middles.get(middle), samples.get(first + 1)],
                None => [samples.get(first), samples.get(first + 1), samples.get(first + 2)],
            };
            let [Some(a), Some(b), Some(c)] = three else { continue };
            let three = [*a, *b, *c];
            let [_, middle, _] = three;
            // Between places that are far apart a parabola is not reliable.
            if top + DOUBT * (top - middle.residual) <= best && (top <= CLOSE * best || found.len() > MOST_PEAKS) {
                continue;
            }
            let solved = self.peak(three);
            best = best.max(solved.residual);
            found.push(solved);
        }
        found
    }

    /// The top of a local maximum of the residual force within its neighbours.
    fn peak(&self, mut three: [RollSample; 3]) -> RollSample {
        for _ in 0..PEAK_STEPS {
            let [a, b, c] = three;
            let (at, _) = top_of(&three);
            let reach = c.parameter - a.parameter;
            // Where the parabola gives no place, the longer side is halved.
            let halved = if b.parameter - a.parameter > c.parameter - b.parameter { a } else { c };
            let at = if (at - b.parameter).abs() > LEAST_STEP * reach && at > a.parameter && at < c.parameter {
                at
            } else {
                b.parameter + 0.1 * (halved.parameter - b.parameter)
            };
            let new = self.sample(b.piece, at);
            let gain = (new.residual - b.residual).abs();
            three = match (new.residual > b.residual, at < b.parameter) {
                (true, true) => [a, new, b],
                (true, false) => [b, new, c],
                (false, true) => [new, b, c],
                (false, false) => [a, b, new],
            };
            if gain <= ROUNDING * b.residual {
                break;
            }
        }
        let [_, top, _] = three;
        top
    }
}

/// Where the parabola through the residual forces of three samples is highest, and how high; the middle sample where it has no top.
pub(super) fn top_of([a, b, c]: &[RollSample; 3]) -> (f64, f64) {
    let (left, right) = (a.parameter - b.parameter, c.parameter - b.parameter);
    let (fall, rise) = ((a.residual - b.residual) / left, (c.residual - b.residual) / right);
    // r(x) = b + s x + k x², x from the middle one.
    let bend = (rise - fall) / (right - left);
    let slope = fall - bend * left;
    let x = -0.5 * slope / bend;
    if bend < 0.0 && x > left && x < right {
        (b.parameter + x, b.residual - 0.25 * slope * slope / bend)
    } else {
        (b.parameter, b.residual)
    }
}

/// How high a value may rise between two samples and where, their indices (those of later samples follow the first ones), and how often
/// the range between may still be halved.
type RankedSpan = ((f64, f64), [usize; 2], u32);

/// How high the size of a value may rise between two samples, and where: by the cubic through its values and slopes, with an allowance
/// for its error; `None` where it does not rise above them.
pub(super) fn bound_by_cubic(
    (a, b): (&RollSample, &RollSample),
    value: &dyn Fn(&RollSample) -> (f64, f64),
) -> Option<(f64, f64)> {
    let width = b.parameter - a.parameter;
    let ((low, rise), (high, fall)) = (value(a), value(b));
    let (rise, fall) = (rise * width, fall * width);
    // v(x) = low + rise x + c x² + d x³, x from 0 to 1; its slope is 0 where rise + 2 c x + 3 d x² = 0.
    let (c, d) = (3.0 * (high - low) - 2.0 * rise - fall, rise + fall - 2.0 * (high - low));
    let root = (c * c - 3.0 * d * rise).sqrt();
    let turn = -(c + root.copysign(c));
    let ends = low.abs().max(high.abs());
    let of = |x: f64| (x > 0.0 && x < 1.0).then(|| ((low + x * (rise + x * (c + x * d))).abs(), x));
    let tops = [turn / (3.0 * d), rise / turn].into_iter().filter_map(of);
    let (top, x) = tops.max_by(|a, b| a.0.total_cmp(&b.0))?;
    let at = a.parameter + x * width;
    (at > a.parameter && at < b.parameter).then_some((top + DOUBT * (top - ends).max(0.0), at))
}

/// How high the size of a value may rise where the foot jumps from one part of the outline to another, as it does where motion is lost: the
/// value follows one part before the jump and the other after it, and may be as high as the crossing of both tangents.
pub(super) fn bound_at_jump(
    (a, b): (&RollSample, &RollSample),
    value: &dyn Fn(&RollSample) -> (f64, f64),
) -> Option<(f64, f64)> {
    if (a.foot - b.foot).norm() <= JUMP * (a.centre - b.centre).norm() {
        return None;
    }
    let width = b.parameter - a.parameter;
    let ((low, rise), (high, fall)) = (value(a), value(b));
    let sense = if low + high < 0.0 { -1.0 } else { 1.0 };
    let x = (high - low - fall * width) / (rise - fall);
    let top = sense * (low + rise * x);
    let at = a.parameter + x.clamp(0.1 * width, 0.9 * width);
    (x > 0.0 && x < width && at > a.parameter && at < b.parameter).then_some((top, at))
}

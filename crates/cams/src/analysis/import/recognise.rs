//! Laws recognised in a stretch between two plateaus: every law that serves its ends is fitted to the positions, and the one that leaves least is it.

use super::model::{ChosenLaw, Fixed, LawParameter, Left, Model, ModelLaw, ModelSegment};
use super::plateaus::Plateau;
use super::positions::Positions;
use camgen_kernel::motion::laws::{LAWS, LINE, Law, LawCurve, SegmentEnd};

/// Most positions of a stretch with which laws are compared, and of its dwells, as a share of it.
const COMPARED: usize = 160;
const OF_DWELLS: f64 = 0.25;
/// Laws whose rms is within this share of the best one are told apart by what is usual.
const ALIKE: f64 = 0.02;
/// Laws that leave no more than so many times the least may be it, where that leaves no more than so many times the least over whole degrees.
const NEARLY: f64 = 1.1;
const ROUND: f64 = 1.1;
/// A law with a parameter of its own must leave this much less than one without.
const WORTH: f64 = 0.8;
/// Shares of the travel by which the place of a law is guessed, and inflections with which it is tried.
const LOW: f64 = 0.1;
const HIGH: f64 = 0.9;
const INFLECTIONS: [f64; 7] = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8];

/// Least shares of the width and of the travel of a stretch that a straight line has, and of the line that is sure to be straight.
const LEAST_LINE: f64 = 0.12;
const SURE: f64 = 0.8;
/// Times that a model with a line is fitted on, since its laws change with the line.
const REFINED: usize = 4;
/// Starts of a line that are tried.
const LINE_STARTS: usize = 48;

/// A stretch of positions between the middles of two plateaus.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    pub(super) first: usize,
    pub(super) end: usize,
    pub(super) levels: [f64; 2],
}

/// A law with its place, as it was fitted to a stretch.
#[derive(Debug, Clone)]
pub(super) struct FittedLaw {
    pub(super) law: ChosenLaw,
    pub(super) nodes: [f64; 2],
    pub(super) left: Left,
}

impl FittedLaw {
    fn is_usual(&self) -> bool {
        self.law.parameter == LawParameter::Usual
    }
}

impl Stretch {
    /// Between two plateaus that follow each other.
    pub(super) fn between(rows: &Positions, before: &Plateau, after: &Plateau) -> Self {
        let width = OF_DWELLS * (rows.angle(after.first) - rows.angle(before.last));
        let (from, to) = (rows.angle(before.last) - width, rows.angle(after.first) + width);
        let first = (before.middle()..before.last).find(|at| rows.angle(*at) >= from).unwrap_or(before.last);
        let last = (after.first..=after.middle()).rev().find(|at| rows.angle(*at) <= to).unwrap_or(after.first);
        Self { first, end: last + 1, levels: [before.level, after.level] }
    }

    fn every(&self) -> usize {
        (self.end - self.first).div_ceil(COMPARED).max(1)
    }

    /// The angle at which the motion first passes a share of the travel.
    fn passes(&self, rows: &Positions, share: f64) -> Option<f64> {
        let [from, to] = self.levels;
        let level = |at: usize| (rows.value(at) - from) / (to - from);
        let at = (self.first..self.end).find(|at| level(*at) >= share)?;
        let before = at.checked_sub(1).filter(|_| at > self.first)?;
        let (a, b) = (level(before), level(at));
        Some(rows.angle(before) + (rows.angle(at) - rows.angle(before)) * (share - a) / (b - a))
    }

    /// Every law that serves these ends, fitted, the best first.
    pub(super) fn fitted(
        &self,
        rows: &Positions,
        ends: [SegmentEnd; 2],
        laws: &[&'static Law],
        deviation: f64,
    ) -> Vec<FittedLaw> {
        let Some(passed) = self.passes(rows, LOW).zip(self.passes(rows, 0.5)).zip(self.passes(rows, HIGH)) else {
            return Vec::new();
        };
        let ((low, middle), high) = passed;
        let serving = || laws.iter().filter(|law| law.serves(ends[0], ends[1]));
        let plain = serving()
            .filter_map(|law| self.fit(rows, ChosenLaw { law, ends, parameter: LawParameter::Usual }, [low, high]));
        let mut all: Vec<FittedLaw> = plain.collect();
        sort(&mut all);
        if all.first().is_none_or(|best| best.left.largest > deviation) {
            let free = serving().filter_map(|law| {
                let starts = parameters(law, ends);
                // The start that passes the middle where the positions do.
                let start = starts.into_iter().min_by(|a, b| {
                    let miss = |parameter: &LawParameter| {
                        let chosen = ChosenLaw { law, ends, parameter: *parameter };
                        chosen.curve().map_or(f64::INFINITY, |curve| {
                            let [a, b, c] = [LOW, 0.5, HIGH].map(|share| inverse(&curve, share));
                            ((b - a) / (c - a) - (middle - low) / (high - low)).abs()
                        })
                    };
                    miss(a).total_cmp(&miss(b))
                })?;
                self.fit(rows, ChosenLaw { law, ends, parameter: start }, [low, high])
            });
            all.extend(free);
            sort(&mut all);
        }
        self.prefer_round(rows, &mut all);
        all
    }

    /// Of laws that leave nearly as little the one that does so over a whole number of degrees: designers take those, and a wrong law is seldom right
    /// over one.
    fn prefer_round(&self, rows: &Positions, all: &mut Vec<FittedLaw>) {
        let Some(least) = all.first().map(|best| best.left.rms) else { return };
        let rounded = |fit: &FittedLaw| {
            let [start, end] = fit.nodes;
            let width = ((end - start).to_degrees()).round().to_radians();
            let mut model = Model {
                nodes: vec![start, start + width],
                levels: self.levels.to_vec(),
                segments: vec![ModelSegment { law: ModelLaw::Law(fit.law), from: 0, to: 1 }],
                fill: None,
                shift: [0.0; 2],
            };
            let together = Fixed { together: true, shift: true, ..Fixed::default() };
            model.fit(rows, (self.first, self.end, self.every()), together);
            model.left(rows, (self.first, self.end)).rms
        };
        let near: Vec<(usize, f64)> = all
            .iter()
            .enumerate()
            .filter(|(_, fit)| fit.left.rms <= NEARLY * least)
            .map(|(at, fit)| (at, rounded(fit) * if fit.is_usual() { WORTH } else { 1.0 }))
            .collect();
        let Some((at, rms)) = near.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1)).filter(|_| near.len() > 1) else {
            return;
        };
        if rms <= ROUND * least && at > 0 {
            let best = all.remove(at);
            all.insert(0, best);
        }
    }

    /// A stretch as a law from a rest to a straight line, the line, and a law to a rest, each side as it leaves least; the whole model.
    pub(super) fn with_line(&self, rows: &Positions, laws: &[&'static Law], deviation: f64) -> Option<(Model, Left)> {
        let line = laws.iter().find(|law| law.name == LINE)?;
        let (first, last) = self.straight(rows, deviation)?;
        let (x0, y0, x1, y1) = (rows.angle(first), rows.value(first), rows.angle(last), rows.value(last));
        let (low, high) = (self.passes(rows, 0.02)?, self.passes(rows, 0.98)?);
        let moving = SegmentEnd::Moving { velocity: 1.0 };
        let sides = |ends: [SegmentEnd; 2]| {
            let all = laws.iter().filter(move |law| law.name != LINE && law.serves(ends[0], ends[1]));
            all.map(move |law| ChosenLaw { law, ends, parameter: LawParameter::Usual }).collect::<Vec<_>>()
        };
        let (before, after) = (sides([SegmentEnd::Rest, moving]), sides([moving, SegmentEnd::Rest]));
        let model = |up: ChosenLaw, down: ChosenLaw| {
            let middle = ChosenLaw::line(line);
            let segments = [up, middle, down].into_iter().enumerate();
            let start = low - 0.25 * (x0 - low).max(0.02 * (high - low));
            let end = high + 0.25 * (high - x1).max(0.02 * (high - low));
            Model {
                nodes: vec![start, x0.max(start + 0.01 * (end - start)), x1.min(end - 0.01 * (end - start)), end],
                levels: vec![self.levels[0], y0, y1, self.levels[1]],
                segments: segments
                    .map(|(at, law)| ModelSegment { law: ModelLaw::Law(law), from: at, to: at + 1 })
                    .collect(),
                fill: None,
                shift: [0.0; 2],
            }
        };
        let fitted = |mut model: Model| {
            model.fit(rows, (self.first, self.end, self.every()), Fixed { shift: true, ..Fixed::default() });
            let left = model.left(rows, (self.first, self.end));
            left.rms.is_finite().then_some((model, left))
        };
        let least = |all: Vec<(Model, Left)>| all.into_iter().min_by(|a, b| a.1.rms.total_cmp(&b.1.rms));
        // One side with the other one's usual law, then the other with the best of it.
        let usual = *after.first()?;
        let (best, _) = least(before.iter().filter_map(|up| fitted(model(*up, usual))).collect())?;
        let ModelLaw::Law(up) = best.segments.first()?.law else { return None };
        let (best, left) = least(after.iter().filter_map(|down| fitted(model(up, *down))).collect())?;
        let ModelLaw::Law(down) = best.segments.last()?.law else { return None };
        // The first side again, now that the other is known.
        let again = least(before.iter().filter_map(|up| fitted(model(*up, down))).collect());
        let (mut best, _) = again.filter(|again| again.1.rms < left.rms).unwrap_or((best, left));
        for _ in 0..REFINED {
            best.fit(rows, (self.first, self.end, 1), Fixed { shift: true, ..Fixed::default() });
        }
        let left = best.left(rows, (self.first, self.end));
        Some((best, left))
    }

    /// The longest part of the stretch that is a straight line within the deviation, where it is long enough.
    fn straight(&self, rows: &Positions, deviation: f64) -> Option<(usize, usize)> {
        let every = (self.end - self.first).div_ceil(LINE_STARTS).max(1);
        let is_straight = |first: usize, last: usize| {
            let (x0, y0) = (rows.angle(first), rows.value(first));
            let slope = (rows.value(last) - y0) / (rows.angle(last) - x0);
            (first..=last).all(|at| (rows.value(at) - y0 - slope * (rows.angle(at) - x0)).abs() <= deviation)
        };
        let travel = (self.levels[1] - self.levels[0]).abs();
        let width = self.passes(rows, HIGH)? - self.passes(rows, LOW)?;
        let mut best: Option<(usize, usize)> = None;
        for first in (self.first..self.end).step_by(every) {
            let mut last = best.map_or(first + 2, |(a, b)| first + (b - a) + 1);
            while last < self.end && is_straight(first, last) {
                best = Some((first, last));
                last += every;
            }
        }
        let (first, last) = best?;
        let long = rows.angle(last) - rows.angle(first) >= LEAST_LINE * width
            && (rows.value(last) - rows.value(first)).abs() >= LEAST_LINE * travel;
        #[expect(
            clippy::cast_precision_loss,
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "few positions"
        )]
        let margin = (0.5 * (1.0 - SURE) * (last - first) as f64) as usize;
        long.then_some((first + margin, last - margin))
    }

    /// A law fitted from where it passes two shares of the travel.
    fn fit(&self, rows: &Positions, law: ChosenLaw, [low, high]: [f64; 2]) -> Option<FittedLaw> {
        let curve = law.curve()?;
        let [a, b] = [LOW, HIGH].map(|share| inverse(&curve, share));
        let width = (high - low) / (b - a);
        let start = low - a * width;
        let mut model = Model {
            nodes: vec![start, start + width],
            levels: self.levels.to_vec(),
            segments: vec![ModelSegment { law: ModelLaw::Law(law), from: 0, to: 1 }],
            fill: None,
            shift: [0.0; 2],
        };
        let known = Fixed { shift: true, ..Fixed::default() };
        model.fit(rows, (self.first, self.end, self.every()), known);
        let left = model.left(rows, (self.first, self.end));
        let ModelLaw::Law(law) = model.segments.first()?.law else { return None };
        let nodes = model.nodes.try_into().ok()?;
        left.rms.is_finite().then_some(FittedLaw { law, nodes, left })
    }
}

/// The best first; of those that are alike the usual one, in the order of the list of laws.
fn sort(all: &mut [FittedLaw]) {
    let place = |found: &FittedLaw| LAWS.iter().position(|law| law.name == found.law.law.name).unwrap_or(0);
    let weighed = |found: &FittedLaw| if found.is_usual() { WORTH * found.left.rms } else { found.left.rms };
    all.sort_by(|a, b| weighed(a).total_cmp(&weighed(b)));
    let Some(least) = all.first().map(weighed) else { return };
    let alike = all.partition_point(|found| weighed(found) <= (1.0 + ALIKE) * least);
    if let Some(alike) = all.get_mut(..alike) {
        alike.sort_by_key(|found| (!found.is_usual(), place(found)));
    }
}

/// The parameters from which a law with one of its own is fitted.
fn parameters(law: &'static Law, ends: [SegmentEnd; 2]) -> Vec<LawParameter> {
    let mut all = match law.name {
        "parabola-line" | "sine-line" => [0.1, 0.3, 0.5, 0.7].map(LawParameter::Line).to_vec(),
        "s-curve" => [0.1, 0.2, 0.3, 0.4].map(LawParameter::Ramp).to_vec(),
        _ => Vec::new(),
    };
    let at = |share: f64| ChosenLaw { law, ends, parameter: LawParameter::Inflection(share) };
    if all.is_empty() && at(0.4).curve().is_some() {
        all = INFLECTIONS.map(LawParameter::Inflection).to_vec();
    }
    all
}

/// Where a curve that rises passes a share of the travel, by bisection.
fn inverse(curve: &LawCurve, share: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if curve.values_at(curve.part_of(middle), middle)[0] < share {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

//! A motion of dwells and laws between nodes, fitted to positions by least squares: nodes, levels, inflections and, where asked for, the centre.
//!
//! Between two nodes a and b a law goes from one level to another, s = L₀ + (L₁ − L₀) f((θ − a)/(b − a)). Its derivatives by levels and nodes follow
//! from f and f'; those by the parameter of a law from a second curve near it. Gauss and Newton's steps, damped where they overshoot (Marquardt 1963).

use super::positions::Positions;
use camgen_kernel::motion::laws::{Inflection, LINE, Law, LawCurve, LawTask, Parameters, SegmentEnd};
use nalgebra::{DMatrix, DVector};

/// Steps of a fit, the least relative gain, and the damping: at first, least and most.
const STEPS: usize = 40;
const SETTLED: f64 = 1e-9;
const DAMPING: f64 = 1e-4;
const LEAST_DAMPING: f64 = 1e-12;
const MOST_DAMPING: f64 = 1e6;
/// Narrowest segment, as a share of the filling.
const NARROWEST: f64 = 1e-4;
/// A change of the parameter of a law, with which its slope is measured.
const CHANGE: f64 = 1e-5;

/// The parameter of a law that is found with it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum LawParameter {
    /// As the law has it by itself.
    Usual,
    Inflection(f64),
    Line(f64),
    Ramp(f64),
}

impl LawParameter {
    pub(super) fn value(self) -> Option<f64> {
        match self {
            Self::Usual => None,
            Self::Inflection(value) | Self::Line(value) | Self::Ramp(value) => Some(value),
        }
    }

    /// The same with another value, within its range.
    pub(super) fn with(self, value: f64) -> Self {
        match self {
            Self::Usual => self,
            Self::Inflection(_) => Self::Inflection(value.clamp(0.02, 0.98)),
            Self::Line(_) => Self::Line(value.clamp(0.0, 0.98)),
            Self::Ramp(_) => Self::Ramp(value.clamp(0.01, 0.5)),
        }
    }
}

/// A law between two kinds of ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct ChosenLaw {
    pub(super) law: &'static Law,
    pub(super) ends: [SegmentEnd; 2],
    pub(super) parameter: LawParameter,
}

impl ChosenLaw {
    /// A straight line.
    pub(super) fn line(law: &'static Law) -> Self {
        let moving = SegmentEnd::Moving { velocity: 1.0 };
        Self { law, ends: [moving; 2], parameter: LawParameter::Usual }
    }

    /// Whether it begins and ends in motion.
    pub(super) fn is_line(&self) -> bool {
        self.law.name == LINE
    }

    pub(super) fn curve(&self) -> Option<LawCurve> {
        if self.is_line() {
            return Some(LawCurve::line());
        }
        let mut task = LawTask::between(self.ends[0], self.ends[1]);
        match self.parameter {
            LawParameter::Usual => {}
            LawParameter::Inflection(share) => task.inflection = Inflection::At(share),
            LawParameter::Line(line) => task.parameters = Parameters { line: Some(line), ..Parameters::default() },
            LawParameter::Ramp(ramp) => task.parameters = Parameters { ramp: Some(ramp), ..Parameters::default() },
        }
        self.law.solve(&task).ok()
    }
}

/// How a segment between two nodes moves.
#[derive(Debug, Clone, Copy)]
pub(super) enum ModelLaw {
    Dwell,
    Law(ChosenLaw),
    /// Not fitted: its positions are left out.
    Unknown,
}

/// A segment from a level to another, by their indices.
#[derive(Debug, Clone, Copy)]
pub(super) struct ModelSegment {
    pub(super) law: ModelLaw,
    pub(super) from: usize,
    pub(super) to: usize,
}

/// Nodes, levels and the segments between them. Of a whole filling there are as many segments as nodes; of a part of it one fewer, and before the first
/// node and behind the last one the follower rests.
#[derive(Debug, Clone)]
pub(super) struct Model {
    /// rad, growing.
    pub(super) nodes: Vec<f64>,
    /// m or rad.
    pub(super) levels: Vec<f64>,
    pub(super) segments: Vec<ModelSegment>,
    /// Of a whole filling, rad.
    pub(super) fill: Option<f64>,
    /// Shift of the centre, m.
    pub(super) shift: [f64; 2],
}

/// Which parameters stay as they are.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Fixed {
    pub(super) nodes: bool,
    /// All nodes move together.
    pub(super) together: bool,
    pub(super) levels: bool,
    pub(super) parameters: bool,
    pub(super) shift: bool,
}

/// What a fit leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Left {
    /// Root of the mean square, and largest size, m or rad.
    pub(super) rms: f64,
    pub(super) largest: f64,
    pub(super) count: usize,
}

/// The curve of a segment, and one of a changed parameter.
type SegmentCurves = Option<(LawCurve, Option<LawCurve>)>;

impl Model {
    /// Last node of a segment.
    pub(super) fn end(&self, segment: usize) -> f64 {
        match (self.nodes.get(segment + 1), self.fill) {
            (Some(node), _) => *node,
            (None, Some(fill)) => self.nodes.first().copied().unwrap_or(0.0) + fill,
            (None, None) => self.nodes.last().copied().unwrap_or(0.0),
        }
    }

    pub(super) fn start(&self, segment: usize) -> f64 {
        self.nodes.get(segment).copied().unwrap_or(0.0)
    }

    pub(super) fn level(&self, index: usize) -> f64 {
        self.levels.get(index).copied().unwrap_or(0.0)
    }

    /// Moves an angle into the filling that begins at the first node.
    fn inside(&self, angle: f64) -> f64 {
        match (self.fill, self.nodes.first()) {
            (Some(fill), Some(first)) => first + (angle - first).rem_euclid(fill),
            _ => angle,
        }
    }

    /// The parameters in a row: nodes, levels, those of laws, the shift.
    fn sizes(&self) -> [usize; 4] {
        let of_laws = self.parameters().count();
        [self.nodes.len(), self.levels.len(), of_laws, 2]
    }

    /// The segments whose law has a parameter that is found.
    fn parameters(&self) -> impl Iterator<Item = usize> + '_ {
        let found =
            |segment: &ModelSegment| matches!(segment.law, ModelLaw::Law(law) if law.parameter.value().is_some());
        self.segments.iter().enumerate().filter(move |(_, segment)| found(segment)).map(|(index, _)| index)
    }

    /// Velocity of a straight line, by the angle; `None` of another segment.
    pub(super) fn velocity(&self, index: usize) -> Option<f64> {
        let segment = self.segments.get(index)?;
        let travel = self.level(segment.to) - self.level(segment.from);
        let is_line = matches!(segment.law, ModelLaw::Law(law) if law.is_line());
        is_line.then(|| travel / (self.end(index) - self.start(index)))
    }

    /// The law of a segment with the velocities of the straight lines next to it.
    fn with_velocities(&self, index: usize, law: ChosenLaw) -> ChosenLaw {
        let Some(segment) = self.segments.get(index) else { return law };
        let count = self.segments.len();
        let per_travel = (self.end(index) - self.start(index)) / (self.level(segment.to) - self.level(segment.from));
        let moving = |end: SegmentEnd, neighbour: Option<usize>| match (end, neighbour.and_then(|at| self.velocity(at)))
        {
            (SegmentEnd::Moving { .. }, Some(velocity)) => SegmentEnd::Moving { velocity: velocity * per_travel },
            _ => end,
        };
        let before = if index > 0 { Some(index - 1) } else { self.fill.and(count.checked_sub(1)) };
        let after = if index + 1 < count { Some(index + 1) } else { self.fill.map(|_| 0) };
        ChosenLaw { ends: [moving(law.ends[0], before), moving(law.ends[1], after)], ..law }
    }

    fn curves(&self) -> Vec<SegmentCurves> {
        let of = |(index, segment): (usize, &ModelSegment)| {
            let ModelLaw::Law(law) = segment.law else { return None };
            let law = if law.is_line() { law } else { self.with_velocities(index, law) };
            let near = law.parameter.value().and_then(|value| {
                let change = if value > 0.4 { -CHANGE } else { CHANGE };
                ChosenLaw { parameter: law.parameter.with(value + change), ..law }.curve()
            });
            Some((law.curve()?, near))
        };
        self.segments.iter().enumerate().map(of).collect()
    }

    /// The position at an angle with its derivatives, a row of parameters; `None` in a segment that is not fitted.
    fn at(&self, angle: f64, curves: &[SegmentCurves], slopes: &mut Vec<(usize, f64)>) -> Option<f64> {
        slopes.clear();
        let [nodes, levels, ..] = self.sizes();
        let angle = self.inside(angle);
        let after = self.nodes.partition_point(|node| *node <= angle);
        let rests = |level: usize, slopes: &mut Vec<(usize, f64)>| {
            slopes.push((nodes + level, 1.0));
            Some(self.level(level))
        };
        let Some(index) = after.checked_sub(1) else { return rests(self.segments.first()?.from, slopes) };
        let Some(segment) = self.segments.get(index) else { return rests(self.segments.last()?.to, slopes) };
        let law = match segment.law {
            ModelLaw::Dwell => return rests(segment.from, slopes),
            ModelLaw::Unknown => return None,
            ModelLaw::Law(law) => law,
        };
        let (curve, near) = curves.get(index)?.as_ref()?;
        let (start, end) = (self.start(index), self.end(index));
        let width = end - start;
        let x = ((angle - start) / width).clamp(0.0, 1.0);
        let [share, slope, ..] = curve.values_at(curve.part_of(x), x);
        let (from, to) = (self.level(segment.from), self.level(segment.to));
        let travel = to - from;
        slopes.push((index, travel * slope * (x - 1.0) / width));
        slopes.push(((index + 1) % nodes.max(1), -travel * slope * x / width));
        slopes.push((nodes + segment.from, 1.0 - share));
        slopes.push((nodes + segment.to, share));
        if let (Some(near), Some(value)) = (near, law.parameter.value()) {
            let changed = near.values_at(near.part_of(x), x)[0];
            let change = if value > 0.4 { -CHANGE } else { CHANGE };
            let own = self.parameters().take_while(|other| *other < index).count();
            slopes.push((nodes + levels + own, travel * (changed - share) / change));
        }
        Some(from + travel * share)
    }

    /// What it leaves of the positions between two indices.
    pub(super) fn left(&self, rows: &Positions, (first, end): (usize, usize)) -> Left {
        let (curves, mut slopes) = (self.curves(), Vec::new());
        let (mut sum, mut largest, mut count) = (0.0, 0.0_f64, 0_usize);
        for at in first..end {
            let Some(value) = self.at(rows.angle(at), &curves, &mut slopes) else { continue };
            let off = rows.value(at) + shifted(rows, at, self.shift) - value;
            sum += off * off;
            largest = largest.max(off.abs());
            count += 1;
        }
        #[expect(clippy::cast_precision_loss, reason = "few positions")]
        let mean = sum / count.max(1) as f64;
        Left { rms: mean.sqrt(), largest, count }
    }

    /// What it leaves at most of the positions in each segment.
    pub(super) fn largest(&self, rows: &Positions) -> Vec<f64> {
        let (curves, mut slopes) = (self.curves(), Vec::new());
        let mut all = vec![0.0_f64; self.segments.len()];
        for at in 0..rows.len() {
            let Some(value) = self.at(rows.angle(at), &curves, &mut slopes) else { continue };
            let index = self.nodes.partition_point(|node| *node <= self.inside(rows.angle(at))).saturating_sub(1);
            if let Some(largest) = all.get_mut(index) {
                *largest = largest.max((rows.value(at) + shifted(rows, at, self.shift) - value).abs());
            }
        }
        all
    }

    /// Fits to every so many of the positions between two indices.
    pub(super) fn fit(&mut self, rows: &Positions, (first, end, every): (usize, usize, usize), fixed: Fixed) {
        let mut damping = DAMPING;
        let Some(mut sum) = self.squares(rows, (first, end, every)) else { return };
        for _ in 0..STEPS {
            let (matrix, right, free) = self.equations(rows, (first, end, every), fixed);
            let mut better = false;
            while damping <= MOST_DAMPING {
                let mut damped = matrix.clone();
                for diagonal in 0..damped.nrows() {
                    damped[(diagonal, diagonal)] *= 1.0 + damping;
                }
                let moved = damped.cholesky().map(|found| self.moved(&found.solve(&right), &free));
                if let Some((moved, next)) = moved.flatten().and_then(|moved| {
                    let next = moved.squares(rows, (first, end, every))?;
                    Some((moved, next))
                }) && next < sum
                {
                    let gain = (sum - next) / sum;
                    (*self, sum, better) = (moved, next, gain > SETTLED);
                    damping = (0.1 * damping).max(LEAST_DAMPING);
                    break;
                }
                damping *= 10.0;
            }
            if !better {
                break;
            }
        }
    }

    fn squares(&self, rows: &Positions, (first, end, every): (usize, usize, usize)) -> Option<f64> {
        let (curves, mut slopes) = (self.curves(), Vec::new());
        let mut sum = 0.0;
        for at in (first..end).step_by(every.max(1)) {
            let Some(value) = self.at(rows.angle(at), &curves, &mut slopes) else { continue };
            let off = rows.value(at) + shifted(rows, at, self.shift) - value;
            sum += off * off;
        }
        (sum.is_finite() && sum > 0.0).then_some(sum)
    }

    /// Normal equations of the free parameters, and which these are.
    fn equations(
        &self,
        rows: &Positions,
        (first, end, every): (usize, usize, usize),
        fixed: Fixed,
    ) -> (DMatrix<f64>, DVector<f64>, Vec<Option<usize>>) {
        let [nodes, levels, laws, _] = self.sizes();
        let centre = !fixed.shift && !rows.by_shift.is_empty();
        let mut count = 0;
        let mut next = |free: bool| {
            count += usize::from(free);
            free.then(|| count - 1)
        };
        let mut free: Vec<Option<usize>> = Vec::new();
        if fixed.together {
            let one = next(true);
            free.extend((0..nodes).map(|_| one));
        } else {
            free.extend((0..nodes).map(|_| next(!fixed.nodes)));
        }
        free.extend((0..levels).map(|_| next(!fixed.levels)));
        free.extend((0..laws).map(|_| next(!fixed.parameters)));
        free.extend((0..2).map(|_| next(centre)));
        let (mut matrix, mut right) = (DMatrix::zeros(count, count), DVector::zeros(count));
        let (curves, mut slopes) = (self.curves(), Vec::new());
        let changed = self.changed();
        let mut row: Vec<(usize, f64)> = Vec::new();
        for at in (first..end).step_by(every.max(1)) {
            let Some(value) = self.at(rows.angle(at), &curves, &mut slopes) else { continue };
            let off = rows.value(at) + shifted(rows, at, self.shift) - value;
            if !changed.is_empty() {
                let size = 1.0 / CHANGE;
                let by = |(model, curves): &(Self, Vec<SegmentCurves>)| {
                    model.at(rows.angle(at), curves, &mut Vec::new()).map_or(0.0, |other| (other - value) * size)
                };
                slopes = changed.iter().map(by).enumerate().collect();
            }
            if let Some(by) = rows.by_shift.get(at % rows.len().max(1)).filter(|_| centre) {
                slopes.extend([(nodes + levels + laws, -by[0]), (nodes + levels + laws + 1, -by[1])]);
            }
            row.clear();
            row.extend(slopes.iter().filter_map(|(index, slope)| Some((free.get(*index).copied().flatten()?, *slope))));
            for (i, a) in &row {
                right[*i] += a * off;
                for (j, b) in &row {
                    matrix[(*i, *j)] += a * b;
                }
            }
        }
        for diagonal in 0..count {
            matrix[(diagonal, diagonal)] += 1e-30;
        }
        (matrix, right, free)
    }

    /// The model with each of its parameters changed a little, where a straight line in it makes the laws beside it depend on them.
    fn changed(&self) -> Vec<(Self, Vec<SegmentCurves>)> {
        if !(0..self.segments.len()).any(|segment| self.velocity(segment).is_some()) {
            return Vec::new();
        }
        let [nodes, levels, laws, _] = self.sizes();
        let of = |index: usize| {
            let step = DVector::from_element(1, CHANGE);
            let free: Vec<Option<usize>> = (0..nodes + levels + laws).map(|own| (own == index).then_some(0)).collect();
            let model = self.moved(&step, &free).unwrap_or_else(|| self.clone());
            let curves = model.curves();
            (model, curves)
        };
        (0..nodes + levels + laws).map(of).collect()
    }

    /// The model after a step; `None` where its nodes would no longer follow each other.
    fn moved(&self, step: &DVector<f64>, free: &[Option<usize>]) -> Option<Self> {
        let by = |index: usize| free.get(index).copied().flatten().and_then(|at| step.get(at)).copied().unwrap_or(0.0);
        let [nodes, levels, laws, _] = self.sizes();
        let mut moved = self.clone();
        for (index, node) in moved.nodes.iter_mut().enumerate() {
            *node += by(index);
        }
        for (index, level) in moved.levels.iter_mut().enumerate() {
            *level += by(nodes + index);
        }
        let of_laws: Vec<usize> = self.parameters().collect();
        for (own, segment) in of_laws.into_iter().enumerate() {
            if let Some(ModelSegment { law: ModelLaw::Law(law), .. }) = moved.segments.get_mut(segment)
                && let Some(value) = law.parameter.value()
            {
                law.parameter = law.parameter.with(value + by(nodes + levels + own));
            }
        }
        moved.shift = [0, 1].map(|axis| self.shift[axis] + by(nodes + levels + laws + axis));
        let least = NARROWEST * self.fill.unwrap_or(1.0);
        let follows = (0..moved.segments.len()).all(|segment| moved.end(segment) - moved.start(segment) >= least);
        follows.then_some(moved)
    }
}

/// What a shift of the centre adds to a position.
fn shifted(rows: &Positions, at: usize, shift: [f64; 2]) -> f64 {
    let by = rows.by_shift.get(at % rows.len().max(1)).copied().unwrap_or_default();
    by[0] * shift[0] + by[1] * shift[1]
}

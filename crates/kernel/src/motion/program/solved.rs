//! The curve of every segment: laws by themselves, splines and polynomials from the states that these leave at a turn, then laws that match a
//! neighbour there.

use super::rows::RowFigures;
use super::{EndState, Mover, SegmentSpec, joined, optimum};
use crate::motion::laws::{self, Inflection, LawCurve, LawError, LawTask, polynomial};

/// A travel below this share of the largest position counts as 0: a law has nothing to scale.
const NO_TRAVEL: f64 = 1e-12;

/// A curve (`None` for a dwell) and its factor.
type ScaledCurve = (Option<LawCurve>, f64);

/// Segments that follow each other in a ring, with the curves that are known.
struct Ring {
    steps: Vec<SegmentSpec>,
    curves: Vec<Option<ScaledCurve>>,
    start: f64,
    /// The largest position.
    size: f64,
}

/// Steps with every state known.
pub(super) struct SolvedSegments {
    pub(super) steps: Vec<SegmentSpec>,
    /// The curve of each.
    pub(super) curves: Vec<ScaledCurve>,
    /// Figures by the share of the rows of splines.
    pub(super) rows: Vec<Option<RowFigures>>,
}

/// The steps with every state known, and the curve of each.
pub(super) fn solve(start: f64, steps: &[SegmentSpec]) -> Result<SolvedSegments, (usize, LawError)> {
    optimum::check(steps)?;
    joined::check(steps)?;
    let size = steps.iter().map(|step| step.to.abs()).fold(start.abs(), f64::max);
    let mut ring = Ring { steps: steps.to_vec(), curves: vec![None; steps.len()], start, size };
    let all = 0..steps.len();
    let (matching, alone): (Vec<usize>, Vec<usize>) =
        all.clone().filter(|index| ring.stands_alone(*index)).partition(|index| ring.may_match(*index));
    for index in alone {
        ring.solve_one(index, None)?;
    }
    for index in matching {
        ring.solve_matching_if_possible(index)?;
    }
    ring.meet_at_turns();
    let (steps, joined) = joined::solve(start, &ring.steps)?;
    ring.steps = steps;
    let mut rows = vec![None; ring.steps.len()];
    for ((slot, rows), joined) in ring.curves.iter_mut().zip(&mut rows).zip(joined) {
        if let Some((curve, figures)) = joined {
            (*slot, *rows) = (Some((Some(curve), 1.0)), figures);
        }
    }
    for index in all.clone() {
        ring.meet_at_turns();
        if ring.curve(index).is_none() && matches!(ring.mover(index), Some(Mover::Polynomial)) {
            ring.solve_one(index, None)?;
        }
    }
    // Two that match do not know each other.
    let known: Vec<Option<[f64; 2]>> = ring.known();
    for index in all.filter(|index| matches!(ring.mover(*index), Some(Mover::Matching(..)))).collect::<Vec<_>>() {
        let [before, after] = [ring.before(index), ring.after(index)].map(|at| known.get(at).copied().flatten());
        ring.solve_one(index, Some([before.map(|[_, last]| last), after.map(|[first, _]| first)]))?;
    }
    Ok(SolvedSegments { steps: ring.steps, curves: ring.curves.into_iter().flatten().collect(), rows })
}

impl Ring {
    fn before(&self, index: usize) -> usize {
        index.checked_sub(1).unwrap_or(self.steps.len().saturating_sub(1))
    }

    fn after(&self, index: usize) -> usize {
        if index + 1 < self.steps.len() { index + 1 } else { 0 }
    }

    fn mover(&self, index: usize) -> Option<&Mover> {
        self.steps.get(index).map(|step| &step.mover)
    }

    fn curve(&self, index: usize) -> Option<&ScaledCurve> {
        self.curves.get(index).and_then(Option::as_ref)
    }

    /// Whether the curve of a segment follows from the given states alone.
    fn stands_alone(&self, index: usize) -> bool {
        !matches!(self.mover(index), Some(Mover::Polynomial | Mover::Spline(_) | Mover::Matching(..)))
    }

    /// Whether a law whose inflection is not given ends in a turn before a curve that has an acceleration of its own there.
    fn may_match(&self, index: usize) -> bool {
        let turns = self.steps.get(index).is_some_and(|step| step.end.turns);
        turns
            && matches!(self.mover(index), Some(Mover::Law(_, None, _)))
            && matches!(self.mover(self.after(index)), Some(Mover::Own(..)))
    }

    /// Such a law with that acceleration, or as it is where it has no inflection for it.
    fn solve_matching_if_possible(&mut self, index: usize) -> Result<(), (usize, LawError)> {
        let given = self.mover(index).cloned();
        let first = self.accelerations(self.after(index)).map(|[first, _]| first);
        if let (Some(Mover::Law(law, _, parameters)), Some(step)) = (given.clone(), self.steps.get_mut(index)) {
            step.mover = Mover::Matching(law, parameters);
        }
        if self.solve_one(index, Some([None, first])).is_ok() {
            return Ok(());
        }
        if let (Some(given), Some(step)) = (given, self.steps.get_mut(index)) {
            step.mover = given;
        }
        self.solve_one(index, None)
    }

    /// Accelerations at both ends of a curve that is known, by the cam angle; of a dwell and a straight line, which have none to go on
    /// from, `None`.
    fn accelerations(&self, index: usize) -> Option<[f64; 2]> {
        if matches!(self.mover(index), Some(Mover::Law(law, ..)) if law.name == laws::LINE) {
            return None;
        }
        let ((curve, travel), step) = self.curve(index).zip(self.steps.get(index))?;
        Some(accelerations(curve.as_ref()?, *travel, step.over))
    }

    /// Accelerations at both ends of each curve that is known; 0 of a dwell.
    fn known(&self) -> Vec<Option<[f64; 2]>> {
        let known = self.curves.iter().zip(&self.steps).map(|(known, step)| {
            let (curve, travel) = known.as_ref()?;
            Some(curve.as_ref().map_or([0.0; 2], |curve| accelerations(curve, *travel, step.over)))
        });
        known.collect()
    }

    /// Gives each turn the acceleration of the curve before it, or else of that behind it.
    fn meet_at_turns(&mut self) {
        for index in 0..self.steps.len() {
            let last = self.accelerations(index).map(|[_, last]| last);
            let turning = last.or_else(|| self.accelerations(self.after(index)).map(|[first, _]| first));
            if let Some(step) = self.steps.get_mut(index).filter(|step| step.end.turns && step.end.turning.is_none()) {
                step.end.turning = turning;
            }
        }
    }

    /// Solves a segment; with the accelerations of the neighbours at its ends where it is to match one.
    fn solve_one(&mut self, index: usize, neighbours: Option<[Option<f64>; 2]>) -> Result<(), (usize, LawError)> {
        let Some(step) = self.steps.get(index) else { return Ok(()) };
        let before = self.steps.get(self.before(index));
        let from = if index == 0 { self.start } else { before.map_or(self.start, |step| step.to) };
        let begin = before.map_or_else(EndState::default, |step| step.end);
        let begin = if step.free_start { begin.without_acceleration() } else { begin };
        let made = segment(step, from, begin, self.size, neighbours).map_err(|error| (index, error))?;
        if let Some(slot) = self.curves.get_mut(index) {
            *slot = Some(made);
        }
        Ok(())
    }
}

/// Accelerations of a curve at both ends, by the cam angle.
fn accelerations(curve: &LawCurve, travel: f64, width: f64) -> [f64; 2] {
    let scale = travel / (width * width);
    [curve.derivative(0, 0.0, 2) * scale, curve.derivative(curve.parts().saturating_sub(1), 1.0, 2) * scale]
}

/// The curve of a segment from a position and a state on, and its factor; with the accelerations of the neighbours at its
/// ends where it is to match one.
fn segment(
    step: &SegmentSpec,
    from: f64,
    begin: EndState,
    size: f64,
    neighbours: Option<[Option<f64>; 2]>,
) -> Result<ScaledCurve, LawError> {
    let (travel, width) = (step.to - from, step.over);
    if !matches!(step.mover, Mover::Dwell | Mover::Polynomial | Mover::Spline(_)) && !(travel.abs() > NO_TRAVEL * size)
    {
        let law = if step.mover.optimum().is_some() { "a polynomial with `minimise`" } else { step.mover.name() };
        return Err(LawError::new("law", format!("the segment ends where it begins, but {law} needs some travel"))
            .remedy("law = \"dwell\" or \"polynomial\" does not"));
    }
    let (law, inflection, parameters) = match &step.mover {
        Mover::Dwell => return Ok((None, 0.0)),
        Mover::Own(_, curve, _) | Mover::Optimum(_, curve) => return Ok((Some(curve.clone()), travel)),
        Mover::Polynomial | Mover::Spline(_) => {
            let (first, last) = (begin.conditions(0.0, width), step.end.conditions(travel, width));
            return Ok((Some(polynomial::hermite(&first, &last)), 1.0));
        }
        Mover::Law(law, inflection, parameters) => (*law, inflection.unwrap_or_default(), *parameters),
        Mover::Matching(law, parameters) => {
            let [before, after] = neighbours.unwrap_or_default();
            let wanted = if step.end.turns { after } else { before.filter(|_| begin.turns) };
            let Some(wanted) = wanted else {
                let what = "inflection = \"match\" takes the acceleration from a neighbour on the other side of a \
                            turn, which is missing or \
                            is matched itself";
                let error = LawError::new("inflection", what);
                return Err(error.remedy("give a number, or a turn at one end next to another law"));
            };
            let acceleration = wanted * width * width / travel;
            (*law, Inflection::Match { acceleration }, *parameters)
        }
    };
    if law.name == laws::LINE {
        // Whatever came before: a jump of the velocity is reported for the whole program.
        return Ok((Some(LawCurve::line()), travel));
    }
    let ends = begin.end(travel, width).zip(step.end.end(travel, width));
    let (from, to) = ends.ok_or_else(|| {
        LawError::new("law", format!("{} cannot begin or end with an acceleration", law.name))
            .remedy("law = \"polynomial\" can, or end = \"turn\" with velocity 0")
    })?;
    Ok((Some(law.solve(&LawTask { from, to, inflection, parameters })?), travel))
}

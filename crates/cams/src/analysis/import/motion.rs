//! The motion that is found in positions: its dwells, the law of each rise and return, and round numbers where the positions allow them.

use super::model::{ChosenLaw, Fixed, Left, Model, ModelLaw, ModelSegment};
use super::plateaus::{Plateau, plateaus};
use super::positions::Positions;
use super::recognise::{FittedLaw, Stretch};
use super::round;
use super::sought::Sought;
use camgen_kernel::motion::laws::SegmentEnd;
use camgen_kernel::refusal::Refusal;

/// Turns that may be rests are tried in all combinations up to this many; a turn must leave this much less than a rest.
const COMBINED: u32 = 6;
const WORTH: f64 = 0.85;
/// Most rises and returns to which laws are fitted: more are reversals in the noise of the positions.
pub(super) const MOST_STRETCHES: usize = 100;
/// A dwell narrower than so many usual spacings, where the motion turns back, is none.
const NARROW: f64 = 1.0;
/// A rest of a spline shorter than this share of the filling may be none.
const SHORT: f64 = 15.0 / 360.0;

/// A segment as it was found.
#[derive(Debug, Clone)]
pub(super) struct FoundSegment {
    /// The laws that were fitted, the best first, with what each leaves; empty of a dwell.
    pub(super) fits: Vec<(&'static str, Left)>,
    /// It ends where the motion turns back with an acceleration.
    pub(super) turns: bool,
    /// The stretch of which it is a law.
    stretch: Option<usize>,
}

/// The motion.
#[derive(Debug, Clone)]
pub(super) struct FoundMotion {
    /// Nodes from the end of the lowest rest on.
    pub(super) model: Model,
    /// As many as the model has.
    pub(super) segments: Vec<FoundSegment>,
    /// No law was found, and nothing rests.
    pub(super) whole: bool,
    /// Number of rises and returns, if too many to fit laws.
    pub(super) unsought: Option<usize>,
}

/// A stretch with the fits for each kind of its ends, by rest and turn.
struct Candidates {
    fits: [[Vec<FittedLaw>; 2]; 2],
    /// A law, a straight line and a law, where no single law was found.
    line: Option<(Model, Left)>,
    spline: bool,
    deviation: f64,
}

const ENDS: [SegmentEnd; 2] = [SegmentEnd::Rest, SegmentEnd::Turn];

impl Candidates {
    fn best(&self, ends: [usize; 2]) -> Option<&FittedLaw> {
        let fits = self.all(ends);
        let within = fits.iter().find(|fit| fit.left.largest <= self.deviation);
        within.or(fits.first().filter(|_| !self.spline))
    }

    fn all(&self, [from, to]: [usize; 2]) -> &[FittedLaw] {
        self.fits.get(from).and_then(|fits| fits.get(to)).map_or(&[], Vec::as_slice)
    }

    fn cost(&self, [from, to]: [usize; 2]) -> f64 {
        let fits = self.all([from, to]);
        let within = fits.iter().find(|fit| fit.left.largest <= self.deviation);
        let line = self.line.as_ref().filter(|_| [from, to] == [0, 0]).map(|(_, left)| left.rms);
        line.or(within.or(fits.first()).map(|fit| fit.left.rms)).unwrap_or(1.0)
    }
}

/// The motion of positions.
///
/// # Errors
/// [`Refusal`] if only laws are allowed and there are too many rises and returns.
pub(super) fn found(rows: &Positions, sought: &Sought<'_>) -> Result<FoundMotion, Refusal> {
    let mut all = plateaus(rows, sought.deviation);
    if all.len() > MOST_STRETCHES {
        return without_laws(rows, all.len(), sought);
    }
    // From the lowest rest on.
    let lowest = (0..all.len()).min_by(|a, b| level(&all, *a).total_cmp(&level(&all, *b))).unwrap_or(0);
    all.rotate_left(lowest);
    let count = all.len();
    for at in count - lowest.min(count)..count {
        if let Some(plateau) = all.get_mut(at) {
            (plateau.first, plateau.last) = (plateau.first + rows.len(), plateau.last + rows.len());
        }
    }
    let stretches = stretches(rows, &all, sought);
    let kinds = kinds(&all, &stretches);
    let mut banned = vec![false; all.len()];
    // A law whose numbers are shared with its neighbours may leave more than by itself: then it is none.
    loop {
        let found = joined(rows, &all, &stretches, (&kinds, &banned), sought);
        let over = found.over(rows, sought.deviation);
        let next: Vec<bool> = banned.iter().enumerate().map(|(at, own)| *own || over.contains(&at)).collect();
        if !sought.spline || found.whole || next == banned {
            return Ok(found);
        }
        banned = next;
    }
}

/// A motion of too many rises and returns: a spline, if allowed.
fn without_laws(rows: &Positions, stretches: usize, sought: &Sought<'_>) -> Result<FoundMotion, Refusal> {
    if sought.spline {
        let whole = FoundMotion::whole(rows, rows.range().0, Vec::new());
        return Ok(FoundMotion { unsought: Some(stretches), ..whole });
    }
    let what = format!("{stretches} rises and returns: laws are fitted to at most {MOST_STRETCHES}");
    Err(Refusal::new(what)
        .remedy("give a larger --deviation, above the noise of the positions, or add spline to --law"))
}

impl FoundMotion {
    /// The whole motion without a law.
    pub(super) fn whole(rows: &Positions, level: f64, fits: Vec<(&'static str, Left)>) -> Self {
        let segments = vec![ModelSegment { law: ModelLaw::Unknown, from: 0, to: 0 }];
        let nodes = vec![rows.angle(0)];
        let model = Model { nodes, levels: vec![level], segments, fill: Some(rows.fill), shift: [0.0; 2] };
        Self { model, segments: vec![FoundSegment { fits, turns: false, stretch: None }], whole: true, unsought: None }
    }

    /// The stretches whose laws leave more than a deviation.
    fn over(&self, rows: &Positions, deviation: f64) -> Vec<usize> {
        let largest = self.model.largest(rows);
        let of = |(at, segment): (usize, &FoundSegment)| {
            segment.stretch.filter(|_| largest.get(at).is_some_and(|largest| *largest > deviation))
        };
        self.segments.iter().enumerate().filter_map(of).collect()
    }
}

fn level(all: &[Plateau], at: usize) -> f64 {
    all.get(at % all.len().max(1)).map_or(0.0, |plateau| plateau.level)
}

/// The fits of every stretch.
fn stretches(rows: &Positions, all: &[Plateau], sought: &Sought<'_>) -> Vec<Candidates> {
    let of = |at: usize| {
        let before = all.get(at)?;
        let wrapped = all.first().map(|first| Plateau {
            first: first.first + rows.len(),
            last: first.last + rows.len(),
            ..*first
        });
        let after = all.get(at + 1).copied().or(wrapped)?;
        let stretch = Stretch::between(rows, before, &after);
        let tried = |kind: usize, plateau: &Plateau| kind == 0 || plateau.turns;
        let fits = [0, 1].map(|from| {
            [0, 1].map(|to| {
                if !tried(from, before) || !tried(to, &after) {
                    return Vec::new();
                }
                let ends = [from, to].map(|kind| ENDS.get(kind).copied().unwrap_or_default());
                stretch.fitted(rows, ends, sought.laws, sought.deviation)
            })
        });
        let within = fits.iter().flatten().flatten().any(|fit: &FittedLaw| fit.left.largest <= sought.deviation);
        let rests = before.level != after.level && !within;
        let line = rests.then(|| stretch.with_line(rows, sought.laws, sought.deviation)).flatten();
        let line = line.filter(|(_, left)| left.largest <= sought.deviation);
        Some(Candidates { fits, line, spline: sought.spline, deviation: sought.deviation })
    };
    (0..all.len()).filter_map(of).collect()
}

/// Whether each plateau is a rest, 0, or a turn, 1: as leaves least.
fn kinds(all: &[Plateau], stretches: &[Candidates]) -> Vec<usize> {
    let open: Vec<usize> = (0..all.len()).filter(|at| all.get(*at).is_some_and(|plateau| plateau.turns)).collect();
    let mut best = vec![0; all.len()];
    let cost = |kinds: &[usize]| {
        let kind = |at: usize| kinds.get(at % kinds.len().max(1)).copied().unwrap_or(0);
        let sum: f64 =
            stretches.iter().enumerate().map(|(at, stretch)| stretch.cost([kind(at), kind(at + 1)]).powi(2)).sum();
        let turns = kinds.iter().filter(|kind| **kind == 1).count();
        sum.sqrt() * if turns > 0 { 1.0 / WORTH } else { 1.0 }
    };
    let mut least = cost(&best);
    let bits = u32::try_from(open.len()).unwrap_or(u32::MAX);
    let tries: Vec<Vec<usize>> = if bits <= COMBINED {
        (1..1_usize << bits)
            .map(|mask| {
                let mut kinds = vec![0; all.len()];
                for (bit, at) in open.iter().enumerate() {
                    if let Some(kind) = kinds.get_mut(*at) {
                        *kind = mask >> bit & 1;
                    }
                }
                kinds
            })
            .collect()
    } else {
        let turning: Vec<usize> = (0..all.len()).map(|at| usize::from(open.contains(&at))).collect();
        vec![turning]
    };
    for kinds in tries {
        let next = cost(&kinds);
        if next < least {
            (best, least) = (kinds, next);
        }
    }
    best
}

/// A plateau as nodes: where the motion arrives and where it leaves, one where both are.
#[derive(Debug, Clone, Copy)]
struct PlateauNodes {
    arrives: f64,
    leaves: f64,
    merged: bool,
    turns: bool,
    level: f64,
}

/// The nodes of a plateau between two stretches, whose fits may not be theirs.
fn nodes(rows: &Positions, plateau: &Plateau, [before, after]: [Option<(f64, bool)>; 2], turns: bool) -> PlateauNodes {
    let (first, last) = (rows.angle(plateau.first), rows.angle(plateau.last));
    // A spline begins no later than the positions have left the plateau.
    let leaves = after.map_or(last, |(at, known)| if known { at } else { at.clamp(first, last) });
    let arrives = before.map_or(first, |(at, known)| if known { at } else { at.clamp(first, last) });
    let narrow = leaves - arrives < NARROW * rows.spacing();
    let merged = turns || (plateau.turns && narrow) || leaves <= arrives;
    let middle = 0.5 * (arrives + leaves);
    let (arrives, leaves) = if merged { (middle, middle) } else { (arrives, leaves) };
    PlateauNodes { arrives, leaves, merged, turns, level: plateau.level }
}

/// A plateau as nodes, from the stretches to either side: first and last node of each, and whether they are those of a law.
fn place(
    rows: &Positions,
    (at, plateau): (usize, &Plateau),
    count: usize,
    fitted: &impl Fn(usize) -> Option<(f64, f64, bool)>,
    turns: bool,
) -> PlateauNodes {
    let back = if at == 0 { rows.fill } else { 0.0 };
    let arrives = fitted((at + count - 1) % count).map(|(_, end, known)| (end - back, known));
    let leaves = fitted(at).map(|(start, _, known)| (start, known));
    nodes(rows, plateau, [arrives, leaves], turns)
}

/// The model of all segments, fitted together and made round.
fn joined(
    rows: &Positions,
    all: &[Plateau],
    stretches: &[Candidates],
    (kinds, banned): (&[usize], &[bool]),
    sought: &Sought<'_>,
) -> FoundMotion {
    let count = all.len();
    let kind = |at: usize| kinds.get(at % count.max(1)).copied().unwrap_or(0);
    let is_banned = |at: usize| banned.get(at).copied().unwrap_or(false);
    let best = |at: usize| {
        let stretch = stretches.get(at).filter(|_| !is_banned(at));
        stretch.and_then(|stretch| stretch.best([kind(at), kind(at + 1)]))
    };
    let any =
        |at: usize| best(at).or(stretches.get(at).and_then(|stretch| stretch.all([kind(at), kind(at + 1)]).first()));
    let line = |at: usize| {
        let own = stretches.get(at).filter(|_| [kind(at), kind(at + 1)] == [0, 0] && !is_banned(at));
        own.and_then(|stretch| stretch.line.as_ref()).map(|(model, _)| model)
    };
    let fitted = |at: usize| {
        let of_line = line(at).and_then(|model| Some((*model.nodes.first()?, *model.nodes.last()?, true)));
        of_line.or_else(|| any(at).map(|fit| (fit.nodes[0], fit.nodes[1], best(at).is_some())))
    };
    let mut places: Vec<PlateauNodes> =
        all.iter().enumerate().map(|(at, plateau)| place(rows, (at, plateau), count, &fitted, kind(at) == 1)).collect();
    let known: Vec<bool> = (0..count).map(|at| best(at).is_some() || line(at).is_some()).collect();
    let mut unknown = spread(&known, &places);
    pass_through(rows, all, &unknown, &mut places);
    if places.is_empty() || (unknown.contains(&true) && places.iter().all(|place| place.merged)) {
        let fits = (0..count).filter_map(any).map(|fit| (fit.law.law.name, fit.left)).collect();
        return FoundMotion::whole(rows, level(all, 0), fits);
    }
    let first = beginning(rows, &mut places, &mut unknown);
    let (mut model, mut segments) = assembled(rows, &places, &unknown, |at| {
        let at = (at + first) % count;
        let fits = stretches.get(at).map_or(&[][..], |stretch| stretch.all([kind(at), kind(at + 1)]));
        let law = match line(at) {
            Some(model) => StretchLaw::Line(model),
            None => best(at).map_or(StretchLaw::Unknown, |fit| StretchLaw::One(fit.law)),
        };
        (law, fits.iter().map(|fit| (fit.law.law.name, fit.left)).collect(), at)
    });
    if (0..model.segments.len()).any(|at| model.end(at) <= model.start(at)) {
        return FoundMotion::whole(rows, level(all, 0), Vec::new());
    }
    let once = Fixed { shift: true, ..Fixed::default() };
    model.fit(rows, (0, rows.len(), 1), once);
    if !rows.by_shift.is_empty() {
        model.fit(rows, (0, rows.len(), 1), Fixed::default());
    }
    round::rounded(&mut model, rows, sought);
    let first = model.nodes.first().copied().unwrap_or(0.0);
    let turns = ((first + 1e-9) / rows.fill).floor() * rows.fill;
    model.nodes.iter_mut().for_each(|node| *node -= turns);
    own_first(&model, &mut segments);
    FoundMotion { model, segments, whole: false, unsought: None }
}

/// Puts the law that was chosen before the others that were fitted.
fn own_first(model: &Model, segments: &mut [FoundSegment]) {
    for (segment, told) in model.segments.iter().zip(segments) {
        let ModelLaw::Law(law) = segment.law else { continue };
        if let Some(own) = told.fits.iter().find(|(name, _)| *name == law.law.name).copied() {
            told.fits.retain(|(name, _)| *name != law.law.name);
            told.fits.insert(0, own);
        }
    }
}

/// Which stretches are not those of a law: those without one, and their neighbours where the motion passes between them without a rest.
fn spread(known: &[bool], places: &[PlateauNodes]) -> Vec<bool> {
    let count = known.len();
    let mut unknown: Vec<bool> = known.iter().map(|known| !known).collect();
    loop {
        let before = unknown.clone();
        for (at, place) in places.iter().enumerate() {
            let (left, right) = ((at + count - 1) % count, at);
            let of = |at: usize| before.get(at).copied().unwrap_or(false);
            if place.turns && (of(left) || of(right)) {
                for side in [left, right] {
                    if let Some(unknown) = unknown.get_mut(side) {
                        *unknown = true;
                    }
                }
            }
        }
        if before == unknown {
            return unknown;
        }
    }
}

/// A short rest between two stretches without a law may be none: the spline goes through it.
fn pass_through(rows: &Positions, all: &[Plateau], unknown: &[bool], places: &mut [PlateauNodes]) {
    let count = places.len();
    let is_unknown = |at: usize| unknown.get(at % count.max(1)).copied().unwrap_or(false);
    for (at, (place, plateau)) in places.iter_mut().zip(all).enumerate() {
        let width = rows.angle(plateau.last) - rows.angle(plateau.first);
        if is_unknown(at) && is_unknown(at + count - 1) && (plateau.turns || width <= SHORT * rows.fill) {
            let middle = 0.5 * (place.arrives + place.leaves);
            (place.arrives, place.leaves, place.merged) = (middle, middle, true);
        }
    }
}

/// Turns the plateaus so that no spline goes on through the first one; by how many.
fn beginning(rows: &Positions, places: &mut [PlateauNodes], unknown: &mut [bool]) -> usize {
    let count = places.len();
    let is_unknown = |at: usize| unknown.get(at % count.max(1)).copied().unwrap_or(false);
    let goes_on =
        |at: &usize| places.get(*at).is_some_and(|place| place.merged) && is_unknown(*at) && is_unknown(at + count - 1);
    let first = (0..count).find(|at| !goes_on(at)).unwrap_or(0);
    places.rotate_left(first);
    unknown.rotate_left(first);
    for place in places.iter_mut().skip(count - first) {
        (place.arrives, place.leaves) = (place.arrives + rows.fill, place.leaves + rows.fill);
    }
    first
}

/// What was found of a stretch.
#[derive(Clone, Copy)]
enum StretchLaw<'a> {
    Unknown,
    One(ChosenLaw),
    /// A law, a straight line and a law.
    Line(&'a Model),
}

/// The model: from each plateau a stretch, then the dwell of the next one.
fn assembled<'a>(
    rows: &Positions,
    places: &[PlateauNodes],
    unknown: &[bool],
    law: impl Fn(usize) -> (StretchLaw<'a>, Vec<(&'static str, Left)>, usize),
) -> (Model, Vec<FoundSegment>) {
    let count = places.len();
    let is_unknown = |at: usize| unknown.get(at % count.max(1)).copied().unwrap_or(false);
    let levels: Vec<f64> = places.iter().map(|place| place.level).collect();
    let mut model = Model { nodes: Vec::new(), levels, segments: Vec::new(), fill: Some(rows.fill), shift: [0.0; 2] };
    let mut segments: Vec<FoundSegment> = Vec::new();
    for (at, place) in places.iter().enumerate() {
        let (chosen, fits, own_index) = law(at);
        let next = (at + 1) % count;
        let after = places.get(next).copied().unwrap_or(*place);
        // A spline goes on through a place where the motion only turns back.
        let goes_on = at > 0 && place.merged && is_unknown(at) && is_unknown(at - 1);
        if goes_on {
            if let Some(last) = model.segments.last_mut() {
                last.to = next;
            }
            if let Some(last) = segments.last_mut() {
                last.fits.extend(fits);
                last.turns = after.turns;
            }
        } else {
            let chosen = if is_unknown(at) { StretchLaw::Unknown } else { chosen };
            model.nodes.push(place.leaves);
            let told = FoundSegment { fits, turns: after.turns, stretch: Some(own_index) };
            push_stretch((&mut model, &mut segments), chosen, (at, next), told);
        }
        if !after.merged {
            let back = if next == 0 { rows.fill } else { 0.0 };
            model.nodes.push(after.arrives + back);
            model.segments.push(ModelSegment { law: ModelLaw::Dwell, from: next, to: next });
            segments.push(FoundSegment { fits: Vec::new(), turns: false, stretch: None });
        }
    }
    (model, segments)
}

/// A model moved by whole fillings so that it begins near an angle.
fn moved_turns(model: &Model, near: f64, fill: f64) -> Model {
    let by = model.nodes.first().map_or(0.0, |first| ((near - first) / fill).round() * fill);
    Model { nodes: model.nodes.iter().map(|node| node + by).collect(), ..model.clone() }
}

/// Adds the segments of a stretch between two levels to a model whose last node is its first.
fn push_stretch(
    (model, segments): (&mut Model, &mut Vec<FoundSegment>),
    chosen: StretchLaw<'_>,
    (from, to): (usize, usize),
    told: FoundSegment,
) {
    match chosen {
        StretchLaw::Line(own) => {
            let (near, fill) = (model.nodes.last().copied().unwrap_or(0.0), model.fill.unwrap_or(1.0));
            let (fitted, first) = (moved_turns(own, near, fill), model.levels.len());
            model.nodes.extend(fitted.nodes.iter().skip(1).take(2));
            model.levels.extend(fitted.levels.iter().skip(1).take(2));
            let ends = [(from, first), (first, first + 1), (first + 1, to)];
            for (own, (from, to)) in fitted.segments.iter().zip(ends) {
                model.segments.push(ModelSegment { law: own.law, from, to });
                segments.push(FoundSegment { fits: Vec::new(), turns: false, stretch: told.stretch });
            }
        }
        StretchLaw::One(law) => {
            model.segments.push(ModelSegment { law: ModelLaw::Law(law), from, to });
            segments.push(told);
        }
        StretchLaw::Unknown => {
            model.segments.push(ModelSegment { law: ModelLaw::Unknown, from, to });
            segments.push(FoundSegment { stretch: None, ..told });
        }
    }
}

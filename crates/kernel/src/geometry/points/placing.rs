//! Where the points of a table lie, and how many: tables are tried and their errors bounded until the fewest points remain
//! that keep the tolerance, and the errors allowed for the follower's motion.
//!
//! **Equal angles.** The error falls with the square (linear) or the fourth power (cubic) of the number of points, so that each
//! trial shows how many are missing or superfluous; the last trials halve the range between too few and enough. A corner is not at a
//! multiple of the step: it gets a row of its own. Where the curvature jumps the error depends on how near an even place happens to
//! lie: where few points are enough, all smaller numbers are tried, too.
//!
//! **Equal error.** The curve is divided at its corners and where circles about the shaft begin and end. In each section the error of
//! an interval, taken to the power 1/2 or 1/4, is an additive measure, and equal parts of it have equal errors: points are placed
//! at equal parts of the measure of the previous trial, so many that each part is that of the tolerance (C. de Boor, Good
//! approximation by splines with variable knots II, 1973). Where that does not converge, intervals with too large an error are halved.
//!
//! **Velocity and acceleration** have errors like heading and curvature: by the third and the second power of a cubic interval, the first
//! of a chord. The measure of an interval is the largest of the three, each over its limit. A cubic spline cannot follow a
//! jump of the acceleration by more than half of it: where the jump is larger than the limit, one spline ends and another begins.

use super::deviation::deviations;
use super::{
    ExactPath, Interpolant, MotionLimit, PointCoordinates, PointInterpolation, PointRows, PointStep, PointTableSpec,
    PointsError, not_around, too_many,
};
use crate::refusal::Refusal;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Most points of a table.
pub(super) const MOST_POINTS: usize = 1_000_000;
/// Most points where velocity or acceleration count: judging this many takes seconds.
const MOST_WITH_MOTION: usize = 20_000;
/// A step of the acceleration above this share of its limit ends a spline: a spline misses half of it and oscillates nearby.
const LEAST_STEP: f64 = 0.5;
/// A break of the curve this near to the start, as a share of its length, is at the start.
const AT_START: f64 = 1e-9;
/// Fewest intervals at equal angles, and those tried first.
const FEWEST: usize = 4;
const FIRST: usize = 16;
/// Tables of more points are not minimised to the last point, but to this share of them.
const EXACTLY: usize = 2000;
const NEARLY: f64 = 0.005;
/// An error below this share of the tolerance need not be refined.
const NEGLIGIBLE: f64 = 0.02;
/// Decimals of a row, in a power of ten: as in a DXF file.
const DECIMALS: f64 = 1e12;
/// An even place nearer to a corner than this share of the step is the corner.
const AT_CORNER: f64 = 1e-3;
/// All numbers of points up to this are tried; a jump of the jerk matters to the acceleration as one of the curvature does to the
/// distance, so that with it more depends on where an even place happens to lie.
const ALL_TRIED: usize = 256;
const ALL_WITH_MOTION: usize = 512;
/// Rounds in which points are moved; then their number grows by a share each round; then intervals are halved; rounds in all.
const SETTLED: u32 = 6;
const GROWN: u32 = 40;
const ROUNDS: u32 = 70;
/// Share of the mean density of points that is kept everywhere, so that no interval spans a range that was never examined.
const LEAST_DENSITY: f64 = 0.01;
/// The measure of an interval of which only a failure is known.
const LOST: f64 = 4.0;
/// Intervals with which a section that is not a circle begins.
const FIRST_OF_SECTION: usize = 8;

/// The required table, and all limits that it must keep.
#[derive(Clone, Copy)]
struct PlacingGoal<'g, 'a> {
    path: &'g ExactPath<'a>,
    wish: &'g PointTableSpec,
    motion: Option<MotionLimit<'g>>,
}

/// The table with the fewest points that keeps the tolerance and the limits of the follower's motion, or nearly the fewest.
///
/// # Errors
/// [`PointsError`] when the curve has no such table.
pub fn place(
    path: &ExactPath<'_>,
    wish: &PointTableSpec,
    motion: Option<MotionLimit<'_>>,
) -> Result<PointRows, PointsError> {
    if wish.form == PointCoordinates::Polar || wish.step == PointStep::Angle {
        path.check_goes_round()?;
    }
    let placed = |motion| {
        let goal = PlacingGoal { path, wish, motion };
        match wish.step {
            PointStep::Angle => by_angle(&goal),
            PointStep::Chord => by_error(&goal),
        }
    };
    let motion = motion.filter(|motion| motion.wanted() != [false; 2]);
    let found = placed(motion);
    let Some(motion) = motion.filter(|_| found.is_err()) else {
        return Ok(closer(path, wish, found?)?);
    };
    // The distance may need more points than are tried for the motion, whose limits may then be kept as well.
    let alone = placed(None)?;
    let curve = Interpolant::new(&alone.rows, wish.form, wish.between, path.is_closed());
    if motion.keeps(&motion.errors(&curve, true), curve.count()) {
        Ok(closer(path, wish, alone)?)
    } else {
        Err(PointsError::TooManyForMotion { most: MOST_WITH_MOTION })
    }
}

/// A table with its exact bounds of the distance, which are left coarse during the trials.
fn closer(path: &ExactPath<'_>, wish: &PointTableSpec, rows: PointRows) -> Result<PointRows, Refusal> {
    if rows.error > 2.0 * NEGLIGIBLE * wish.tolerance {
        return Ok(rows);
    }
    let curve = Interpolant::new(&rows.rows, wish.form, wish.between, path.is_closed());
    let errors = deviations(path, &curve, &rows.places, 0.0, f64::INFINITY)?;
    Ok(PointRows { error: errors.into_iter().fold(0.0, f64::max), ..rows })
}

impl PlacingGoal<'_, '_> {
    /// Most intervals that are tried.
    fn most(&self) -> usize {
        if self.motion.is_some() { MOST_WITH_MOTION } else { MOST_POINTS }
    }

    /// The factor by which an interval is to be divided to keep all limits, by its distance and its errors of motion.
    fn part(&self, distance: f64, motion: [f64; 2]) -> f64 {
        let own = times_divided(distance / self.wish.tolerance, self.wish.between.order());
        let Some(MotionLimit { allowed, .. }) = self.motion else { return own };
        let [heading, curvature] = self.wish.between.orders();
        own.max(times_divided(motion[0] / allowed[0], heading)).max(times_divided(motion[1] / allowed[1], curvature))
    }

    /// The breaks of the curve at which rows are required: the one at its start, and the others, in order.
    fn breaks(&self, start: f64) -> (BreakKind, Vec<RowPlace>) {
        let path = self.path;
        let jumps =
            self.motion.filter(|motion| self.wish.between == PointInterpolation::Cubic && motion.keeps_acceleration());
        let jumps = jumps.map_or_else(Vec::new, |motion| {
            let mut jumps = path.jumps();
            jumps.retain(|(_, at)| motion.motion.step(at) > LEAST_STEP * motion.allowed[1]);
            jumps
        });
        let corners = path.joints(false).0.into_iter().map(|place| (place, BreakKind::Corner));
        let all = corners.chain(jumps.into_iter().map(|(place, _)| (place, BreakKind::Jump)));
        let near = AT_START * path.length();
        let (mut at_start, mut spots) = (BreakKind::Plain, Vec::new());
        for (place, kind) in all {
            let place = if place < start - near { place + path.length() } else { place };
            if path.is_closed() && ((place - start).abs() <= near || (place - start - path.length()).abs() <= near) {
                at_start = kind;
                continue;
            }
            let point = path.point(path.place(place)).map_or([f64::NAN; 2], |point| point.point.into());
            let degrees = rounded(around(libm::atan2(point[1], point[0])).to_degrees());
            spots.push(RowPlace { place, degrees, kind });
        }
        spots.sort_by(|a, b| a.place.total_cmp(&b.place));
        (at_start, spots)
    }
}

/// A value as it is written.
fn rounded(value: f64) -> f64 {
    (value * DECIMALS).round() / DECIMALS + 0.0
}

/// A table that is tried.
struct TableTrial {
    rows: Vec<[f64; 2]>,
    places: Vec<f64>,
    corners: usize,
    jumps: usize,
    /// A bound of the distance of each interval, mm.
    errors: Vec<f64>,
    /// The factor by which each interval would have to be divided.
    parts: Vec<f64>,
    keeps: bool,
}

impl TableTrial {
    fn new(goal: &PlacingGoal<'_, '_>, spots: &[RowPlace], limit: f64) -> Result<Self, Refusal> {
        let (path, wish) = (goal.path, goal.wish);
        let twice = wish.between == PointInterpolation::Cubic;
        let (mut rows, mut places) = (Vec::with_capacity(spots.len()), Vec::with_capacity(spots.len()));
        let (mut corners, mut jumps) = (0, 0);
        let last = spots.len().saturating_sub(1);
        for (index, spot) in spots.iter().enumerate() {
            let (row, place) = spot.row(path, wish.form);
            corners += usize::from(spot.kind == BreakKind::Corner && index < last);
            jumps += usize::from(spot.kind == BreakKind::Jump && index < last);
            let times = if spot.kind != BreakKind::Plain && twice && index < last { 2 } else { 1 };
            rows.extend(std::iter::repeat_n(row, times));
            places.extend(std::iter::repeat_n(place, times));
        }
        let broken = spots.first().is_some_and(|spot| spot.kind != BreakKind::Plain);
        if let (true, Some(first), Some(last)) = (broken && path.is_closed(), rows.first().copied(), rows.last_mut()) {
            // This is the first point again, despite rounding after a turn.
            *last = if wish.form == PointCoordinates::Polar { [last[0], first[1]] } else { first };
        }
        let curve = Interpolant::new(&rows, wish.form, wish.between, path.is_closed());
        let errors = deviations(path, &curve, &places, NEGLIGIBLE * wish.tolerance, limit)?;
        // After an interval that is too far off the rest is unknown, and its motion need not be examined.
        let whole = errors.len() == curve.count() && errors.iter().all(|error| *error <= limit);
        let motion = goal.motion.filter(|_| whole).map(|motion| motion.errors(&curve, limit.is_finite()));
        let near = errors.iter().all(|error| *error <= wish.tolerance);
        let smooth = goal.motion.zip(motion.as_deref()).is_none_or(|(motion, all)| motion.keeps(all, curve.count()));
        let keeps = near && whole && smooth;
        let motion = motion.unwrap_or_default().into_iter().chain(std::iter::repeat([0.0; 2]));
        let parts = errors.iter().zip(motion).map(|(error, motion)| goal.part(*error, motion)).collect();
        Ok(Self { rows, places, corners, jumps, errors, parts, keeps })
    }

    /// The factor by which the number of its intervals would have to be multiplied.
    fn missing(&self) -> f64 {
        self.parts.iter().copied().fold(0.0, f64::max)
    }

    fn into_rows(self) -> PointRows {
        let error = self.errors.iter().copied().fold(0.0, f64::max);
        let spans = self.places.iter().zip(self.places.iter().skip(1));
        let intervals = spans.filter(|(from, to)| from < to).count();
        let Self { rows, places, corners, jumps, .. } = self;
        PointRows { rows, places, corners, jumps, intervals, error }
    }
}

/// A place where a row is required.
#[derive(Debug, Clone, Copy)]
struct RowPlace {
    /// Length from the start of the curve, mm.
    place: f64,
    /// Its required angle about the shaft, degrees; NaN where any angle is allowed.
    degrees: f64,
    kind: BreakKind,
}

/// What is discontinuous at a place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum BreakKind {
    /// Nothing is.
    Plain,
    /// The heading.
    Corner,
    /// The acceleration, by more than its limit.
    Jump,
}

impl RowPlace {
    fn row(&self, path: &ExactPath<'_>, form: PointCoordinates) -> ([f64; 2], f64) {
        let point = path.point(path.place(self.place)).map_or([f64::NAN; 2], |point| point.point.into());
        let [x, y] = point;
        if form == PointCoordinates::Plane {
            return ([rounded(x), rounded(y)], self.place);
        }
        let degrees =
            if self.degrees.is_nan() { rounded(around(libm::atan2(y, x)).to_degrees()) } else { self.degrees };
        if self.kind != BreakKind::Plain {
            return ([degrees, rounded(libm::hypot(x, y))], self.place);
        }
        // The radius belongs to the angle as it is written.
        match path.on_ray(degrees.to_radians()) {
            Some((place, radius)) => {
                let turns = ((self.place - place) / path.length()).round();
                ([degrees, rounded(radius)], place + turns * path.length())
            }
            None => ([degrees, f64::NAN], self.place),
        }
    }
}

/// An angle in [0, 2π), rad.
fn around(angle: f64) -> f64 {
    if angle < 0.0 { angle + TAU } else { angle }
}

/// How far from the least number of points a number may be: by none while there are few.
fn nearly(count: usize) -> usize {
    if count <= EXACTLY { 1 } else { scaled(count, NEARLY).max(1) }
}

/// Into how many parts an interval must be divided whose error, of an order, is this share of what is allowed.
fn times_divided(share: f64, order: f64) -> f64 {
    if share.is_finite() { libm::pow(share, 1.0 / order) } else { LOST }
}

/// The places at equal angles from a place at which something may break, and the breaks between them.
fn even(
    path: &ExactPath<'_>,
    count: usize,
    start: f64,
    at_start: BreakKind,
    breaks: &[RowPlace],
) -> Option<Vec<RowPlace>> {
    #[expect(clippy::cast_precision_loss, reason = "at most a million")]
    let degrees = |index: usize| rounded(360.0 * index as f64 / count as f64);
    let near = AT_CORNER * degrees(1);
    let mut spots = Vec::with_capacity(count + breaks.len() + 1);
    spots.push(RowPlace { place: start, degrees: 0.0, kind: at_start });
    let mut next = breaks.iter().peekable();
    for index in 1..count {
        let angle = degrees(index);
        while let Some(corner) = next.next_if(|corner| corner.degrees < angle + near) {
            spots.push(*corner);
        }
        if breaks.iter().any(|corner| (corner.degrees - angle).abs() <= near) {
            continue;
        }
        let (place, _) = path.on_ray(angle.to_radians())?;
        let place = if place < start { place + path.length() } else { place };
        spots.push(RowPlace { place, degrees: angle, kind: BreakKind::Plain });
    }
    spots.extend(next);
    spots.push(RowPlace { place: start + path.length(), degrees: 360.0, kind: at_start });
    Some(spots)
}

fn by_angle(goal: &PlacingGoal<'_, '_>) -> Result<PointRows, Refusal> {
    let (path, wish, most) = (goal.path, goal.wish, goal.most());
    let start = path.on_ray(0.0).ok_or_else(|| not_around(0.0))?.0;
    let (at_start, breaks) = goal.breaks(start);
    let trial = |count: usize, limit: f64| {
        let spots = even(path, count, start, at_start, &breaks).ok_or_else(|| not_around(0.0))?;
        TableTrial::new(goal, &spots, limit)
    };
    let (mut too_few, mut enough): (usize, Option<(usize, TableTrial)>) = (FEWEST - 1, None);
    let mut count = FIRST;
    loop {
        // A curve that departs does not show how many points it needs.
        let tried = trial(count, f64::INFINITY).ok();
        let missing = tried.as_ref().map_or(2.0, TableTrial::missing);
        match tried {
            Some(tried) if tried.keeps => enough = Some((count, tried)),
            _ => too_few = too_few.max(count),
        }
        count = match &enough {
            Some((count, _)) if count - too_few <= nearly(*count) => break,
            Some((most, _)) => {
                let wanted = scaled(count, missing).clamp(too_few + 1, most - 1);
                let middle = too_few + (most - too_few) / 2;
                // The law of the error first; then halves, so that each trial leaves at most half.
                if (most - too_few) > most / 16 { wanted } else { middle }
            }
            None if count >= most || missing > doubt(count) * ratio(most, count) => {
                return Err(too_many(wish.tolerance, most));
            }
            None => scaled(count, missing.clamp(1.02, 16.0)).clamp(count + 1, most),
        };
    }
    let (count, found) = enough.ok_or_else(|| too_many(wish.tolerance, most))?;
    let all = if goal.motion.is_some() { ALL_WITH_MOTION } else { ALL_TRIED };
    let fewer = if count <= all {
        (FEWEST..count).find_map(|count| trial(count, wish.tolerance).ok().filter(|trial| trial.keeps))
    } else {
        None
    };
    Ok(fewer.unwrap_or(found).into_rows())
}

/// By how much an estimate from this many points may be too large: few points show less of the law of the error.
fn doubt(count: usize) -> f64 {
    if count < EXACTLY { 8.0 } else { 1.1 }
}

#[expect(clippy::cast_precision_loss, reason = "at most a million")]
fn ratio(a: usize, b: usize) -> f64 {
    a as f64 / b as f64
}

/// A count times a factor, rounded up, at most a million and one.
fn scaled(count: usize, factor: f64) -> usize {
    let most = ratio(MOST_POINTS + 1, 1);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and a million")]
    let scaled = (ratio(count, 1) * factor).ceil().clamp(0.0, most) as usize;
    scaled
}

/// A part of the curve between two places with required rows.
struct PlacingSection {
    from: RowPlace,
    to: RowPlace,
    /// Fewest intervals.
    fewest: usize,
    /// Places between its ends.
    inner: Vec<f64>,
}

impl PlacingSection {
    fn evenly(&mut self, count: usize) {
        let length = self.to.place - self.from.place;
        self.inner = (1..count).map(|index| self.from.place + length * ratio(index, count)).collect();
    }

    /// Halves the intervals that are to be divided.
    fn halve(&mut self, parts: &[f64]) {
        let ends = self.inner.iter().copied().chain([self.to.place]);
        let (mut inner, mut from) = (Vec::with_capacity(2 * parts.len()), self.from.place);
        for (to, part) in ends.zip(parts) {
            if !(*part <= 1.0) {
                inner.push(0.5 * (from + to));
            }
            inner.push(to);
            from = to;
        }
        inner.pop();
        self.inner = inner;
    }

    /// Places this many intervals at equal parts of a measure, given for the present ones.
    fn by_parts(&mut self, measure: &[f64], count: usize) {
        let knots: Vec<f64> =
            std::iter::once(self.from.place).chain(self.inner.iter().copied()).chain([self.to.place]).collect();
        let total: f64 = measure.iter().sum();
        let mut inner = Vec::with_capacity(count);
        let (mut so_far, mut next) = (0.0, 1);
        for ((from, to), part) in knots.iter().zip(knots.iter().skip(1)).zip(measure) {
            while next < count && total * ratio(next, count) <= so_far + part {
                let share = ((total * ratio(next, count) - so_far) / part).clamp(0.0, 1.0);
                inner.push(from + share * (to - from));
                next += 1;
            }
            so_far += part;
        }
        if inner.len() + 1 == count && total > 0.0 {
            self.inner = inner;
        } else {
            self.evenly(count);
        }
    }
}

/// Divides the curve into sections.
fn sections(goal: &PlacingGoal<'_, '_>) -> Vec<PlacingSection> {
    let (path, wish) = (goal.path, goal.wish);
    let start = if path.is_closed() { path.on_ray(0.0).map_or(0.0, |(place, _)| place) } else { 0.0 };
    let end = start + path.length();
    let (at_start, breaks) = goal.breaks(start);
    let mut spots = vec![RowPlace { place: start, degrees: 0.0, kind: at_start }];
    spots.extend(breaks);
    for joint in path.joints(wish.between == PointInterpolation::Cubic).1 {
        let place = if joint < start { joint + path.length() } else { joint };
        spots.push(RowPlace { place, degrees: f64::NAN, kind: BreakKind::Plain });
    }
    spots.push(RowPlace { place: end, degrees: 360.0, kind: at_start });
    spots.sort_by(|a, b| a.place.total_cmp(&b.place));
    // A joint at the start is the start.
    let near = 1e-9 * path.length();
    spots.dedup_by(|later, earlier| {
        let same = later.place - earlier.place <= near;
        if same && earlier.degrees.is_nan() && earlier.kind == BreakKind::Plain {
            *earlier = *later;
        }
        same
    });
    let pairs = spots.iter().zip(spots.iter().skip(1));
    let sections = pairs.map(|(from, to)| {
        let turn = TAU * (to.place - from.place) / path.length();
        // On a plate nothing rotates.
        let quarters = if path.is_closed() { scaled(1, turn / FRAC_PI_2).max(1) } else { 1 };
        let mut section = PlacingSection { from: *from, to: *to, fewest: quarters, inner: Vec::new() };
        let first = if wish.between == PointInterpolation::Cubic || quarters > 1 { quarters } else { 1 };
        section.evenly(first.max(FIRST_OF_SECTION));
        section
    });
    sections.collect()
}

fn by_error(goal: &PlacingGoal<'_, '_>) -> Result<PointRows, Refusal> {
    let mut sections = sections(goal);
    let mut best: Option<TableTrial> = None;
    let mut last = too_many(goal.wish.tolerance, goal.most());
    let mut more = 1.0;
    for round in 0..ROUNDS {
        let total: usize = sections.iter().map(|section| section.inner.len() + 1).sum();
        if total > goal.most() {
            break;
        }
        let trial = match TableTrial::new(goal, &spots(&sections), f64::INFINITY) {
            Ok(trial) => trial,
            Err(error) => {
                last = error;
                for section in &mut sections {
                    section.evenly(2 * (section.inner.len() + 1));
                }
                continue;
            }
        };
        let kept = trial.keeps;
        let fewer = best.as_ref().is_none_or(|best| trial.rows.len() < best.rows.len());
        let mut parts = measured(&trial);
        if kept && fewer {
            best = Some(trial);
        } else if kept || (best.is_some() && round >= SETTLED) {
            break;
        }
        more *= if round >= SETTLED { 1.0 + NEARLY } else { 1.0 };
        let mut changed = false;
        for section in &mut sections {
            let present = section.inner.len() + 1;
            let own: Vec<f64> = parts.by_ref().take(present).collect();
            if round >= GROWN && !kept {
                section.halve(&own);
                changed = true;
                continue;
            }
            let wanted = scaled(1, more * own.iter().sum::<f64>()).max(section.fewest).min(8 * present);
            changed |= wanted != present || !kept;
            section.by_parts(&with_least(section, &own, goal.wish.between), wanted);
        }
        if !changed {
            break;
        }
    }
    best.map(TableTrial::into_rows).ok_or(last)
}

/// The measures of the intervals that have a length, in order.
fn measured(trial: &TableTrial) -> impl Iterator<Item = f64> + use<> {
    let spans = trial.places.iter().zip(trial.places.iter().skip(1)).map(|(from, to)| from < to);
    let parts: Vec<f64> = spans.zip(&trial.parts).filter(|(long, _)| *long).map(|(_, part)| *part).collect();
    parts.into_iter()
}

/// A measure whose density is nowhere below a share of its mean, and without jumps for a spline, whose intervals affect their
/// neighbours.
fn with_least(section: &PlacingSection, parts: &[f64], between: PointInterpolation) -> Vec<f64> {
    let knots = std::iter::once(section.from.place).chain(section.inner.iter().copied()).chain([section.to.place]);
    let knots: Vec<f64> = knots.collect();
    let widths: Vec<f64> = knots.iter().zip(knots.iter().skip(1)).map(|(from, to)| to - from).collect();
    let (length, total): (f64, f64) = (widths.iter().sum(), parts.iter().sum());
    let floor = (LEAST_DENSITY * total / length).max(f64::MIN_POSITIVE);
    let density: Vec<f64> = parts.iter().zip(&widths).map(|(part, width)| part / width + floor).collect();
    let smoothed = density.iter().enumerate().map(|(index, here)| {
        let [left, right] = [index.checked_sub(1), Some(index + 1)]
            .map(|index| *index.and_then(|index| density.get(index)).unwrap_or(here));
        if between == PointInterpolation::Cubic { 0.25 * (left + 2.0 * here + right) } else { *here }
    });
    smoothed.zip(&widths).map(|(density, width)| density * width).collect()
}

fn spots(sections: &[PlacingSection]) -> Vec<RowPlace> {
    let mut spots: Vec<RowPlace> = Vec::new();
    for section in sections {
        spots.push(section.from);
        spots.extend(section.inner.iter().map(|place| RowPlace {
            place: *place,
            degrees: f64::NAN,
            kind: BreakKind::Plain,
        }));
    }
    spots.extend(sections.last().map(|section| section.to));
    spots
}

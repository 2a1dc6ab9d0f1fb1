//! Where the points of a table stand, and how many: tables are tried and their errors bounded until the fewest points are left
//! that keep the tolerance.
//!
//! **Equal angles.** The error falls with the square (linear) or the fourth power (cubic) of the number of points, so that each
//! trial says how many are missing or too many; the last trials halve what is left between too few and enough. A corner is no
//! multiple of the step: it gets a row of its own. Where the curvature jumps the error depends on how near an even place happens to
//! lie: where few points are enough, all smaller numbers are tried, too.
//!
//! **Equal error.** The curve is cut at its corners and where circles about the shaft begin and end. In each section the error of
//! an interval, taken to the power 1/2 or 1/4, is a measure that adds up, and equal parts of it have equal errors: points are put
//! at equal parts of what the trial before measured, so many that each part is that of the tolerance (C. de Boor, Good
//! approximation by splines with variable knots II, 1973). Where that does not settle, intervals that err too much are halved.

use super::deviation::deviations;
use super::{Between, Form, Interpolant, Path, PointsError, Rows, Step, Wish};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Most points of a table.
pub(super) const MOST_POINTS: usize = 1_000_000;
/// Fewest intervals at equal angles, and those tried first.
const FEWEST: usize = 4;
const FIRST: usize = 16;
/// Tables of more points are not searched to the last one, but to this share of them.
const EXACTLY: usize = 2000;
const NEARLY: f64 = 0.005;
/// An error below this share of the tolerance need not be told closer.
const NEGLIGIBLE: f64 = 0.02;
/// Decimals of a row, in a power of ten: as in a DXF file.
const DECIMALS: f64 = 1e12;
/// An even place nearer to a corner than this share of the step is the corner.
const AT_CORNER: f64 = 1e-3;
/// All numbers of points up to this are tried.
const ALL_TRIED: usize = 256;
/// Rounds in which points are moved; then their number grows by a share each round; then intervals are halved; rounds in all.
const SETTLED: u32 = 6;
const GROWN: u32 = 40;
const ROUNDS: u32 = 70;
/// Share of the mean density of points that is kept everywhere, so that no interval spans what was never looked at.
const LEAST_DENSITY: f64 = 0.01;
/// Intervals with which a section that is no circle begins.
const FIRST_OF_SECTION: usize = 8;

/// The table with the fewest points that keeps what is wished, or nearly so.
///
/// # Errors
/// [`PointsError`] when the curve has no such table.
pub fn place(path: &Path<'_>, wish: &Wish) -> Result<Rows, PointsError> {
    if wish.form == Form::Polar || wish.step == Step::Angle {
        path.goes_round()?;
    }
    match wish.step {
        Step::Angle => by_angle(path, wish),
        Step::Chord => by_error(path, wish),
    }
}

/// A value as it is written.
fn rounded(value: f64) -> f64 {
    (value * DECIMALS).round() / DECIMALS + 0.0
}

/// A table that is tried.
struct Trial {
    rows: Vec<[f64; 2]>,
    places: Vec<f64>,
    corners: usize,
    /// A bound of the error of each interval, mm.
    errors: Vec<f64>,
}

impl Trial {
    /// Tolerances of more than the distance would be measured here, each as a share of its own limit.
    fn of(path: &Path<'_>, wish: &Wish, spots: &[Spot], limit: f64) -> Result<Self, PointsError> {
        let twice = wish.between == Between::Cubic;
        let (mut rows, mut places) = (Vec::with_capacity(spots.len()), Vec::with_capacity(spots.len()));
        let mut corners = 0;
        let last = spots.len().saturating_sub(1);
        for (index, spot) in spots.iter().enumerate() {
            let (row, place) = spot.row(path, wish.form);
            // A corner where the table starts is a row already.
            if !twice && rows.last() == Some(&row) {
                continue;
            }
            corners += usize::from(spot.corner);
            let times = if spot.corner && twice && index > 0 && index < last { 2 } else { 1 };
            rows.extend(std::iter::repeat_n(row, times));
            places.extend(std::iter::repeat_n(place, times));
        }
        let curve = Interpolant::new(&rows, wish.form, wish.between, path.is_closed());
        let errors = deviations(path, &curve, &places, (NEGLIGIBLE * wish.tolerance, limit))?;
        Ok(Self { rows, places, corners, errors })
    }

    fn worst(&self) -> f64 {
        self.errors.iter().copied().fold(0.0, |worst, next| if next > worst || next.is_nan() { next } else { worst })
    }

    fn into_rows(self) -> Rows {
        let error = self.worst();
        let spans = self.places.iter().zip(self.places.iter().skip(1));
        let intervals = spans.filter(|(from, to)| from < to).count();
        Rows { rows: self.rows, places: self.places, corners: self.corners, intervals, error }
    }
}

/// A place where a row is to stand.
#[derive(Debug, Clone, Copy)]
struct Spot {
    /// Length from the start of the curve, mm.
    place: f64,
    /// The angle about the shaft that it is to have, degrees; NaN where any will do.
    degrees: f64,
    corner: bool,
}

impl Spot {
    fn row(&self, path: &Path<'_>, form: Form) -> ([f64; 2], f64) {
        let point = path.point(path.place(self.place)).map_or([f64::NAN; 2], |point| point.point.into());
        let [x, y] = point;
        if form == Form::Plane {
            return ([rounded(x), rounded(y)], self.place);
        }
        let degrees =
            if self.degrees.is_nan() { rounded(around(libm::atan2(y, x)).to_degrees()) } else { self.degrees };
        if self.corner {
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

/// The corners of a closed curve beyond a place, in order: lengths and angles.
fn corners_from(path: &Path<'_>, start: f64) -> Vec<Spot> {
    let (corners, _) = path.joints(false);
    let spot = |place: f64| {
        let place = if place < start { place + path.length() } else { place };
        let point = path.point(path.place(place)).map_or([f64::NAN; 2], |point| point.point.into());
        Spot { place, degrees: rounded(around(libm::atan2(point[1], point[0])).to_degrees()), corner: true }
    };
    let mut spots: Vec<Spot> = corners.into_iter().map(spot).collect();
    spots.sort_by(|a, b| a.place.total_cmp(&b.place));
    spots
}

/// The places at equal angles, and the corners between them.
fn even(path: &Path<'_>, count: usize, corners: &[Spot]) -> Option<Vec<Spot>> {
    let (first, _) = path.on_ray(0.0)?;
    #[expect(clippy::cast_precision_loss, reason = "at most a million")]
    let degrees = |index: usize| rounded(360.0 * index as f64 / count as f64);
    let near = AT_CORNER * degrees(1);
    let mut spots = Vec::with_capacity(count + corners.len() + 1);
    let mut next = corners.iter().peekable();
    for index in 0..=count {
        let angle = degrees(index);
        while let Some(corner) = next.next_if(|corner| corner.degrees < angle + near) {
            spots.push(*corner);
        }
        let at_corner = corners.iter().any(|corner| (corner.degrees - angle).abs() <= near);
        let outermost = index == 0 || index == count;
        if at_corner && !outermost {
            continue;
        }
        let place = match index {
            0 => first,
            index if index == count => first + path.length(),
            _ => {
                let (place, _) = path.on_ray(angle.to_radians())?;
                if place < first { place + path.length() } else { place }
            }
        };
        spots.push(Spot { place, degrees: angle, corner: false });
    }
    Some(spots)
}

fn by_angle(path: &Path<'_>, wish: &Wish) -> Result<Rows, PointsError> {
    let too_many = PointsError::TooMany { tolerance_mm: wish.tolerance, most: MOST_POINTS };
    let start = path.on_ray(0.0).ok_or(PointsError::NotAround { polar_deg: 0.0 })?.0;
    let corners = corners_from(path, start);
    let trial = |count: usize, limit: f64| {
        let spots = even(path, count, &corners).ok_or(PointsError::NotAround { polar_deg: 0.0 })?;
        Trial::of(path, wish, &spots, limit)
    };
    let (mut too_few, mut enough): (usize, Option<(usize, Trial)>) = (FEWEST - 1, None);
    let mut count = FIRST;
    loop {
        // A curve that goes astray tells nothing of how many points it lacks.
        let tried = trial(count, f64::INFINITY).ok();
        let worst = tried.as_ref().map_or(f64::INFINITY, Trial::worst);
        let missing = missing(worst, wish);
        match tried {
            Some(tried) if worst <= wish.tolerance => enough = Some((count, tried)),
            _ => too_few = too_few.max(count),
        }
        let least_apart = |count: usize| if count <= EXACTLY { 1 } else { scaled(count, NEARLY).max(1) };
        count = match &enough {
            Some((count, _)) if count - too_few <= least_apart(*count) => break,
            Some((most, _)) => {
                let wanted = scaled(count, missing).clamp(too_few + 1, most - 1);
                let middle = too_few + (most - too_few) / 2;
                // The law of the error first; then halves, so that each trial leaves no more than half.
                if (most - too_few) > most / 16 { wanted } else { middle }
            }
            None if count >= MOST_POINTS || missing > doubt(count) * ratio(MOST_POINTS, count) => {
                return Err(too_many);
            }
            None => scaled(count, missing.clamp(1.02, 16.0)).clamp(count + 1, MOST_POINTS),
        };
    }
    let (count, found) = enough.ok_or(too_many)?;
    let keeps = |count: usize| trial(count, wish.tolerance).ok().filter(|trial| trial.worst() <= wish.tolerance);
    let fewer = if count <= ALL_TRIED { (FEWEST..count).find_map(keeps) } else { None };
    Ok(fewer.unwrap_or(found).into_rows())
}

/// How far above the truth an estimate from so many points may be: few points see less of the law of the error.
fn doubt(count: usize) -> f64 {
    if count < EXACTLY { 8.0 } else { 1.1 }
}

/// What the number of points is to be multiplied by where this is the error, mm.
fn missing(error: f64, wish: &Wish) -> f64 {
    if error.is_finite() { libm::pow(error / wish.tolerance, 1.0 / wish.between.order()) } else { 2.0 }
}

#[expect(clippy::cast_precision_loss, reason = "at most a million")]
fn ratio(a: usize, b: usize) -> f64 {
    a as f64 / b as f64
}

/// A count times a factor, rounded up, not above a million and one.
fn scaled(count: usize, factor: f64) -> usize {
    let most = ratio(MOST_POINTS + 1, 1);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and a million")]
    let scaled = (ratio(count, 1) * factor).ceil().clamp(0.0, most) as usize;
    scaled
}

/// A part of the curve between two places that have a row whatever the rest.
struct Section {
    from: Spot,
    to: Spot,
    /// Fewest intervals.
    fewest: usize,
    /// Places between its ends.
    inner: Vec<f64>,
}

impl Section {
    fn evenly(&mut self, count: usize) {
        let length = self.to.place - self.from.place;
        self.inner = (1..count).map(|index| self.from.place + length * ratio(index, count)).collect();
    }

    /// Halves the intervals whose errors are above a limit.
    fn halve(&mut self, errors: &[f64], limit: f64) {
        let ends = self.inner.iter().copied().chain([self.to.place]);
        let (mut inner, mut from) = (Vec::with_capacity(2 * errors.len()), self.from.place);
        for (to, error) in ends.zip(errors) {
            if !(*error <= limit) {
                inner.push(0.5 * (from + to));
            }
            inner.push(to);
            from = to;
        }
        inner.pop();
        self.inner = inner;
    }

    /// Puts so many intervals at equal parts of a measure, given for the present ones.
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

/// The curve in sections.
fn sections(path: &Path<'_>, wish: &Wish) -> Vec<Section> {
    let start = if path.is_closed() { path.on_ray(0.0).map_or(0.0, |(place, _)| place) } else { 0.0 };
    let end = start + path.length();
    let any = |place: f64| Spot { place, degrees: f64::NAN, corner: false };
    let beyond = |place: f64| if place < start { place + path.length() } else { place };
    let mut spots = vec![Spot { degrees: 0.0, ..any(start) }];
    spots.extend(corners_from(path, start));
    spots.extend(path.joints(wish.between == Between::Cubic).1.into_iter().map(beyond).map(any));
    spots.push(Spot { degrees: 360.0, ..any(end) });
    spots.sort_by(|a, b| a.place.total_cmp(&b.place));
    // A joint at the start is the start.
    let near = 1e-9 * path.length();
    spots.dedup_by(|later, earlier| {
        let same = later.place - earlier.place <= near;
        if same && earlier.degrees.is_nan() {
            *earlier = *later;
        }
        same
    });
    let pairs = spots.iter().zip(spots.iter().skip(1));
    pairs
        .map(|(from, to)| {
            let turn = TAU * (to.place - from.place) / path.length();
            // On a plate nothing turns round.
            let quarters = if path.is_closed() { scaled(1, turn / FRAC_PI_2).max(1) } else { 1 };
            let mut section = Section { from: *from, to: *to, fewest: quarters, inner: Vec::new() };
            let first = if wish.between == Between::Cubic || quarters > 1 { quarters } else { 1 };
            section.evenly(first.max(FIRST_OF_SECTION));
            section
        })
        .collect()
}

fn by_error(path: &Path<'_>, wish: &Wish) -> Result<Rows, PointsError> {
    let mut sections = sections(path, wish);
    let order = 1.0 / wish.between.order();
    let mut best: Option<Trial> = None;
    let mut last = PointsError::TooMany { tolerance_mm: wish.tolerance, most: MOST_POINTS };
    let mut more = 1.0;
    for round in 0..ROUNDS {
        let total: usize = sections.iter().map(|section| section.inner.len() + 1).sum();
        if total > MOST_POINTS {
            break;
        }
        let trial = match Trial::of(path, wish, &spots(&sections), f64::INFINITY) {
            Ok(trial) => trial,
            Err(astray) => {
                last = astray;
                for section in &mut sections {
                    section.evenly(2 * (section.inner.len() + 1));
                }
                continue;
            }
        };
        let kept = trial.worst() <= wish.tolerance;
        let fewer = best.as_ref().is_none_or(|best| trial.rows.len() < best.rows.len());
        let mut errors = measured(&trial);
        if kept && fewer {
            best = Some(trial);
        } else if kept || (best.is_some() && round >= SETTLED) {
            break;
        }
        more *= if round >= SETTLED { 1.0 + NEARLY } else { 1.0 };
        let mut changed = false;
        for section in &mut sections {
            let present = section.inner.len() + 1;
            let own: Vec<f64> = errors.by_ref().take(present).collect();
            if round >= GROWN && !kept {
                section.halve(&own, wish.tolerance);
                changed = true;
                continue;
            }
            let parts: Vec<f64> = own.iter().map(|error| libm::pow(error / wish.tolerance, order)).collect();
            let wanted = scaled(1, more * parts.iter().sum::<f64>()).max(section.fewest).min(8 * present);
            changed |= wanted != present || !kept;
            section.by_parts(&with_least(section, &parts, wish.between), wanted);
        }
        if !changed {
            break;
        }
    }
    best.map(Trial::into_rows).ok_or(last)
}

/// The errors of the intervals that have a length, in order.
fn measured(trial: &Trial) -> impl Iterator<Item = f64> + use<> {
    let spans = trial.places.iter().zip(trial.places.iter().skip(1)).map(|(from, to)| from < to);
    let errors: Vec<f64> = spans.zip(&trial.errors).filter(|(long, _)| *long).map(|(_, error)| *error).collect();
    errors.into_iter()
}

/// A measure whose density is nowhere below a share of its mean, and without jumps for a spline, whose intervals act on their
/// neighbours.
fn with_least(section: &Section, parts: &[f64], between: Between) -> Vec<f64> {
    let knots = std::iter::once(section.from.place).chain(section.inner.iter().copied()).chain([section.to.place]);
    let knots: Vec<f64> = knots.collect();
    let widths: Vec<f64> = knots.iter().zip(knots.iter().skip(1)).map(|(from, to)| to - from).collect();
    let (length, total): (f64, f64) = (widths.iter().sum(), parts.iter().sum());
    let floor = (LEAST_DENSITY * total / length).max(f64::MIN_POSITIVE);
    let density: Vec<f64> = parts.iter().zip(&widths).map(|(part, width)| part / width + floor).collect();
    let smooth = |index: usize| {
        let at = |index: usize| density.get(index).copied();
        let here = at(index).unwrap_or(floor);
        let (left, right) = (index.checked_sub(1).and_then(at).unwrap_or(here), at(index + 1).unwrap_or(here));
        if between == Between::Cubic { 0.25 * (left + 2.0 * here + right) } else { here }
    };
    widths.iter().enumerate().map(|(index, width)| smooth(index) * width).collect()
}

fn spots(sections: &[Section]) -> Vec<Spot> {
    let mut spots: Vec<Spot> = Vec::new();
    for section in sections {
        spots.push(section.from);
        spots.extend(section.inner.iter().map(|place| Spot { place: *place, degrees: f64::NAN, corner: false }));
    }
    spots.extend(sections.last().map(|section| section.to));
    spots
}

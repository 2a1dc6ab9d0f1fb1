//! The largest errors of a follower's motion on a chain.

use super::{ContactStretch, FollowerOnChain, LiftAtPlace};
use crate::numeric::{extremum, root};
use crate::profile::Worst;

/// Least parts into which a stretch is divided to find its largest error, and cells of the motion that a part may span.
const LEAST_PARTS: f64 = 2.0;
const CELLS_OF_PART: f64 = 2.0;
/// Places on most stretches.
const PLACES: usize = 3;
/// The error of the acceleration counts as straight within this share of its size; elsewhere the parts are halved.
const NEARLY_STRAIGHT: f64 = 0.1;
/// An error that changes by less than this share of itself at a joint is continuous there.
const CONTINUOUS: f64 = 1e-3;
/// Golden sections where an error is largest within a stretch.
const SECTIONS: u32 = 22;
/// Accuracy of the place of the largest velocity error, in parts: its value is accurate to the square.
const ROOT: f64 = 1e-5;
/// Only places whose error is this near to the largest one are refined.
const NEAR: f64 = 0.7;

/// The largest errors of a follower's motion on a chain, by the angle of the shaft: m or rad per rad, and per rad².
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorsOnChain {
    /// Largest error of the velocity.
    pub velocity: Worst,
    /// Largest error of the acceleration.
    pub acceleration: Worst,
    /// The largest step of the acceleration as cut.
    pub step: Worst,
    /// The largest step of the velocity as cut, at a kink of the chain.
    pub velocity_step: Worst,
}

impl ErrorsOnChain {
    /// No error at all.
    pub const NONE: Self =
        Self { velocity: Worst::NONE, acceleration: Worst::NONE, step: Worst::NONE, velocity_step: Worst::NONE };

    /// The larger of each.
    #[must_use]
    pub fn or_larger(self, next: Self) -> Self {
        Self {
            velocity: self.velocity.or_larger(next.velocity),
            acceleration: self.acceleration.or_larger(next.acceleration),
            step: self.step.or_larger(next.step),
            velocity_step: self.velocity_step.or_larger(next.velocity_step),
        }
    }
}

/// The errors at a place of the motion, by the angle of the shaft.
#[derive(Debug, Clone, Copy)]
struct PlaceErrors {
    at: f64,
    velocity: f64,
    acceleration: f64,
    /// The acceleration as cut.
    cut: f64,
    /// The jerk of the motion, by the parameter, used in place of the derivative of the error, from which it differs by a quantity that
    /// hardly changes along an arc.
    jerk: f64,
}

/// The largest size of the acceleration error on the parabola through three evenly spaced places, if it is highest between them.
fn top([left, middle, right]: [&PlaceErrors; 3]) -> Option<f64> {
    let (slope, bend) = (
        0.5 * (right.acceleration - left.acceleration),
        left.acceleration - 2.0 * middle.acceleration + right.acceleration,
    );
    let top = middle.acceleration - 0.5 * slope * slope / bend;
    (slope.abs() < bend.abs() && top * bend < 0.0).then_some(top.abs())
}

impl FollowerOnChain<'_> {
    /// The errors at a place of a stretch, and the lift of the motion there, which may be known.
    fn off(&self, stretch: &ContactStretch, at: f64, known: Option<LiftAtPlace>) -> Option<(PlaceErrors, LiftAtPlace)> {
        let inside = at + stretch.shift;
        let (first, second) = self.curves.motion.pace(inside);
        let (cut, law) = self.cut_at_known_lift(stretch, at, known)?;
        let off = PlaceErrors {
            at,
            velocity: (cut.ds - law.ds) * first,
            acceleration: (cut.dds - law.dds) * first * first + (cut.ds - law.ds) * second,
            cut: cut.dds * first * first + cut.ds * second,
            jerk: law.ddds * first * first,
        };
        Some((off, ((stretch.piece, inside), law)))
    }

    /// The errors at places of a stretch, as near to each other as the motion requires, and nearer where the error of the acceleration
    /// curves; none where the follower does not run. `known` is the lift at the start, and on return that at the end.
    fn places_off(&self, stretch: &ContactStretch, known: &mut Option<LiftAtPlace>) -> Vec<PlaceErrors> {
        let places = self.evenly(stretch, known).unwrap_or_default();
        let largest = places.iter().map(|off| off.acceleration.abs()).fold(0.0, f64::max);
        let is_bent = places.windows(3).any(|three| {
            let [left, middle, right] = three else { return false };
            let straight = 0.5 * (left.acceleration + right.acceleration);
            (middle.acceleration - straight).abs() > NEARLY_STRAIGHT * largest
        });
        // Three places of a wave may lie on a line, but then their slopes show it: the chord of a cubic deviates by an eighth.
        let swings = places.windows(2).any(|two| {
            let [left, right] = two else { return false };
            0.125 * ((right.jerk - left.jerk) * (right.at - left.at)).abs() > NEARLY_STRAIGHT * largest
        });
        if !(is_bent || swings) {
            return places;
        }
        let mut halved = Vec::with_capacity(2 * places.len());
        for (index, place) in places.iter().enumerate() {
            halved.push(*place);
            let next = places.get(index + 1);
            halved.extend(next.and_then(|next| Some(self.off(stretch, 0.5 * (place.at + next.at), None)?.0)));
        }
        halved
    }

    fn evenly(&self, stretch: &ContactStretch, known: &mut Option<LiftAtPlace>) -> Option<Vec<PlaceErrors>> {
        let last = known.take();
        if !self.is_rolled(stretch) {
            return None;
        }
        let piece = self.curves.motion.pieces().get(stretch.piece)?;
        let length = stretch.to - stretch.from;
        let cells = f64::from(self.curves.motion.cells(stretch.piece)) * (length / (piece.end - piece.start));
        let parts = (cells / CELLS_OF_PART).ceil().max(LEAST_PARTS);
        let (start, mut lift) = self.off(stretch, stretch.from, last)?;
        let mut places = Vec::with_capacity(PLACES);
        places.push(start);
        let mut part = 1.0;
        while part <= parts {
            let (off, here) = self.off(stretch, stretch.from + length * (part / parts), None)?;
            places.push(off);
            lift = here;
            part += 1.0;
        }
        *known = Some(lift);
        Some(places)
    }

    /// The largest errors where the follower runs, by the angle of the shaft that gives the time.
    ///
    /// Along a segment the error of the velocity is largest where that of the acceleration, its derivative, is 0, or at an end.
    #[must_use]
    pub fn errors(&self) -> ErrorsOnChain {
        let mut known = None;
        let all: Vec<(&ContactStretch, Vec<PlaceErrors>)> =
            self.stretches.iter().map(|stretch| (stretch, self.places_off(stretch, &mut known))).collect();
        let mut errors = ErrorsOnChain::NONE;
        for (stretch, places) in &all {
            for off in places {
                errors.velocity = errors.velocity.or_larger(worst(stretch, off.at, off.velocity));
                errors.acceleration = errors.acceleration.or_larger(worst(stretch, off.at, off.acceleration));
            }
        }
        for (stretch, places) in &all {
            for pair in places.windows(2) {
                let [low, high] = pair else { continue };
                errors.velocity = errors.velocity.or_larger(self.largest_velocity(stretch, low, high, errors.velocity));
            }
            for three in places.windows(3) {
                let [left, middle, right] = three else { continue };
                if top([left, middle, right]).is_some_and(|top| top > NEAR * errors.acceleration.value) {
                    let found = self.largest_acceleration(stretch, left.at, right.at);
                    errors.acceleration = errors.acceleration.or_larger(found);
                }
            }
        }
        let next = all.iter().cycle().skip(1).take(all.len().saturating_sub(usize::from(!self.closed)));
        for ((before, left), (after, right)) in all.iter().zip(next) {
            let ([.., low, last], [first, high, ..]) = (left.as_slice(), right.as_slice()) else { continue };
            errors.step = errors.step.or_larger(worst(before, last.at, first.cut - last.cut));
            let step = worst(before, last.at, first.velocity - last.velocity);
            errors.velocity_step = errors.velocity_step.or_larger(step);
            // A smooth curve over the joint may be highest on either side of it.
            let size = last.acceleration.abs();
            if (first.acceleration - last.acceleration).abs() < CONTINUOUS * size
                && size > NEAR * errors.acceleration.value
                && size > low.acceleration.abs().max(high.acceleration.abs())
            {
                let found = self.largest_acceleration(before, low.at, last.at);
                errors.acceleration = errors.acceleration.or_larger(found);
                let found = self.largest_acceleration(after, first.at, high.at);
                errors.acceleration = errors.acceleration.or_larger(found);
            }
        }
        errors
    }

    fn value(&self, stretch: &ContactStretch, at: f64, of: impl Fn(&PlaceErrors) -> f64) -> f64 {
        self.off(stretch, at, None).map_or(0.0, |(off, _)| of(&off))
    }

    /// The velocity error where the acceleration error is 0 between two places, if it may come near to the largest one.
    fn largest_velocity(
        &self,
        stretch: &ContactStretch,
        low: &PlaceErrors,
        high: &PlaceErrors,
        largest: Worst,
    ) -> Worst {
        let (left, right) = (low.acceleration, high.acceleration);
        if !(left * right < 0.0) {
            return Worst::NONE;
        }
        // Where the acceleration error is linear between two places, this is the largest error of the velocity between them.
        let way = left / (left - right) * (high.at - low.at) / self.curves.motion.pace(low.at + stretch.shift).0;
        if (low.velocity + 0.5 * left * way).abs() <= NEAR * largest.value {
            return Worst::NONE;
        }
        let found = root::bracketed(
            |at| self.value(stretch, at, |off| off.acceleration),
            low.at,
            high.at,
            ROOT * (high.at - low.at),
        );
        found.map_or(Worst::NONE, |at| worst(stretch, at, self.value(stretch, at, |off| off.velocity)))
    }

    /// The largest error of the acceleration within a range with one maximum.
    fn largest_acceleration(&self, stretch: &ContactStretch, low: f64, high: f64) -> Worst {
        let found = extremum::largest_without_slope(
            |at| self.value(stretch, at, |off| off.acceleration).abs(),
            (low, high),
            2,
            SECTIONS,
        );
        worst(stretch, found.at, found.value)
    }
}

fn worst(stretch: &ContactStretch, at: f64, value: f64) -> Worst {
    Worst { value: value.abs(), at: at + stretch.shift, z: 0.0 }
}

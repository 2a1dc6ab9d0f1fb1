//! The smallest prime radius that keeps every limit, solved.

use super::outline::LARGEST_COORDINATE;
use super::{Curves, extremes, lifts};
use crate::follower::{Element, Follower, FollowerPlacement};
use crate::geometry::MILLIMETRES;
use crate::motion::{Jet, Motion};
use crate::numeric::extremum::{self, Extremum};
use crate::numeric::root;

/// Whole millimetres an automatic base radius is rounded up to, m; a millionth of a step is rounding noise.
pub const BASE_STEP: f64 = 1e-3;
const BASE_STEP_NOISE: f64 = 1e-6;

/// Least convex radius of a roller's curve where it only closes the outline, over the radius of the roller: without a margin the
/// profile has a cusp there, and rounding would decide whether that is an undercut.
pub const CLOSING_OVER_ROLLER: f64 = 1.05;

/// The limits that a radius must keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SizeLimits {
    /// Largest pressure angles where it is positive and where it is negative, rad; infinite where there is no limit.
    pub pressure_angles: [f64; 2],
    /// Smallest convex radius of the follower's curve where the follower runs, m.
    pub convex_radius: f64,
    /// Least prime radius of the search, m.
    pub least: f64,
}

/// The base radius that `auto` chooses for the smallest one, m: the next whole millimetre.
#[must_use]
pub fn rounded_up(base_radius: f64) -> f64 {
    rounded_up_to(base_radius, 1.0 / BASE_STEP)
}

/// The next multiple of a fraction of a metre, apart from rounding noise. A quotient keeps "69 mm" the number nearest to 0.069.
fn rounded_up_to(radius: f64, steps_per_metre: f64) -> f64 {
    (radius * steps_per_metre - BASE_STEP_NOISE).ceil() / steps_per_metre
}

/// The largest radius that is looked for, m: no drawing holds a larger one.
const LARGEST: f64 = LARGEST_COORDINATE / MILLIMETRES;

/// Growth from one radius to the next under a follower of limited reach: a passing range of radii may lie between two that fail.
const GROWTH_IN_REACH: f64 = 1.01;
/// Where the reach of a follower ends below this, m, steps are small.
const FAR: f64 = 1e3;
/// Halvings of the search for the lower end of a range that passes.
const HALVINGS: u32 = 60;
/// Finer steps, of a tenth each, in which a base radius is rounded where the whole millimetre does not pass: to 1 nm.
const FINER_STEPS: i32 = 6;

/// Points of a curve that may be the sharpest one after another while the radius grows, and below which excess, a share, rounding decides.
const SHARPEST_POINTS: u32 = 16;
const SHARPNESS_NOISE: f64 = 1e-12;
/// A radius larger than the one that the pressure angle requires in closed form by more than this share keeps it.
const PRESSURE_NOISE: f64 = 1e-9;

/// Rounds of solving each limit in turn. A limit may be violated again by the radius that another one needs only where it
/// is not monotone in the radius; each round then starts above the last.
const ROUNDS: u32 = 8;

/// No radius keeps the limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("no base radius keeps the limits")]
pub struct NoRadius;

/// The largest lift that a follower of limited reach has to follow, m or rad; other followers can follow every lift.
#[must_use]
pub fn largest_lift_in_reach(motion: &dyn Motion, follower: &dyn Follower) -> f64 {
    if follower.reach().1.is_finite() { lifts(motion).1 } else { 0.0 }
}

/// The smallest size of a disc that keeps every limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmallestSize {
    /// Prime radius, m.
    pub prime_radius: f64,
    /// The base radius that `auto` chooses for it, m.
    pub base_radius: f64,
}

/// The problem to solve: by how much a disc of a prime radius violates the limits.
struct SizeProblem<'a> {
    motion: &'a dyn Motion,
    follower: &'a dyn Follower,
    required: &'a SizeLimits,
    /// The largest lift that has to be in reach.
    top: f64,
    /// Samples that are examined first where sizes are tried one by one.
    sampled: Option<SizeSamples>,
}

/// Places at which a size is examined first: nearly all sizes that fail clearly violate a limit at one of them.
struct SizeSamples {
    /// Cam angle and lift.
    lifts: Vec<(f64, Jet)>,
    /// The place of the follower, for a roller with a chosen place.
    place: Option<(FollowerPlacement, f64)>,
}

/// By how much a pressure angle is clearly too large, rad, or a profile too sharp, as a share: nearer to its limit it is solved, so that
/// sizes are compared consistently there.
const CLEARLY: f64 = 0.03;
/// Steps of a piece at which a size is examined first.
const SAMPLES: u32 = 24;

/// The lifts of a motion under a follower of limited reach, whose sizes are tried one by one.
fn sampled(motion: &dyn Motion, follower: &dyn Follower) -> Option<SizeSamples> {
    if follower.prime_radii().1.is_infinite() {
        return None;
    }
    let pieces = motion.distinct().iter().enumerate().filter(|(index, _)| motion.is_rolled(*index));
    let lifts = pieces.flat_map(|(index, piece)| {
        let steps = if piece.dwell { 1 } else { SAMPLES };
        (0..=steps).map(move |step| {
            let at = piece.start + (piece.end - piece.start) * f64::from(step) / f64::from(steps);
            (at, motion.jet(index, at))
        })
    });
    Some(SizeSamples {
        lifts: lifts.collect(),
        place: follower.place().map(|place| (place, place.chosen_by(follower))),
    })
}

impl SizeProblem<'_> {
    /// A quantity of the disc with a radius; NaN, which does not pass, where the follower does not reach.
    fn excess_at(&self, radius: f64, excess: impl Fn(Curves<'_>) -> f64) -> f64 {
        let follower = self.sized(radius);
        follower.map_or(f64::NAN, |follower| excess(Curves { motion: self.motion, follower: &*follower }))
    }

    /// The follower on a prime radius, m, if it reaches the largest lift.
    fn sized(&self, radius: f64) -> Option<Box<dyn Follower>> {
        self.follower.sized(radius).filter(|follower| self.top <= follower.reach().1)
    }

    fn pressure(&self, radius: f64) -> f64 {
        if self.required.pressure_angles.iter().all(|limit| limit.is_infinite()) {
            return self.excess_at(radius, |_| f64::NEG_INFINITY);
        }
        self.excess_at(radius, |curves| {
            let [rising, falling] = extremes::pressure_angles(curves);
            let [most, least] = self.required.pressure_angles;
            worse(rising.value - most, falling.value - least)
        })
    }

    /// By how much the curve is too sharp, and where most.
    fn sharpest(&self, radius: f64) -> Extremum {
        let Some(follower) = self.sized(radius) else { return Extremum { at: f64::NAN, value: f64::NAN } };
        let curves = Curves { motion: self.motion, follower: &*follower };
        match curves.element() {
            Element::Roller { radius: roller } => self.sharpest_under_roller(curves, roller),
            // The profile under a face must not turn back on itself, nor have an edge.
            Element::Face => {
                let least = extremes::least_radius(curves);
                Extremum { at: least.at, value: (self.required.convex_radius - least.value) / radius }
            }
        }
    }

    fn sharpest_under_roller(&self, curves: Curves<'_>, roller: f64) -> Extremum {
        let rolled = sharpest(curves, true, self.required.convex_radius);
        if curves.motion.is_rolled_throughout() {
            return rolled;
        }
        let closing = sharpest(curves, false, CLOSING_OVER_ROLLER * roller);
        if rolled.value > closing.value || rolled.value.is_nan() { rolled } else { closing }
    }

    /// By how much the curve is too sharp at a cam angle of a piece.
    fn sharpness_at(&self, radius: f64, piece: usize, angle: f64) -> f64 {
        self.excess_at(radius, |curves| match curves.element() {
            Element::Roller { radius: roller } => {
                let rolled = curves.motion.is_rolled(piece);
                let least = if rolled { self.required.convex_radius } else { CLOSING_OVER_ROLLER * roller };
                curves.metal_side() * curves.touch(piece, angle).curve.curvature * least - 1.0
            }
            Element::Face => (self.required.convex_radius - curves.face_radius(piece, angle).0) / radius,
        })
    }

    fn curvature(&self, radius: f64) -> f64 {
        self.sharpest(radius).value
    }

    /// The first radius from `low` on at which the curve is nowhere too sharp. Every point is less sharp on a larger radius, so the radius that the sharpest
    /// point needs is a lower bound; from there the next point is looked for, which takes a few searches along the curve in place of one for each step of a
    /// root.
    fn first_not_too_sharp(&self, low: f64) -> Result<f64, NoRadius> {
        let passes_everywhere = self.required.convex_radius == 0.0 && self.motion.is_rolled_throughout();
        if passes_everywhere && self.excess_at(low, |_| 0.0) == 0.0 {
            return Ok(low);
        }
        let mut radius = low;
        for _ in 0..SHARPEST_POINTS {
            let sharpest = self.sharpest(radius);
            if sharpest.value <= 0.0 {
                return Ok(radius);
            }
            if sharpest.value < SHARPNESS_NOISE {
                if let Ok(passing) = passing_just_above(radius, |radius| self.curvature(radius)) {
                    return Ok(passing);
                }
                break;
            }
            match self.needed_at(sharpest.at, radius) {
                Some(needed) if needed > radius => radius = needed,
                _ => break,
            }
        }
        first_at_or_above(radius, |radius| self.curvature(radius))
    }

    /// The radius from `low` on that a cam angle needs, on each piece that ends or lies there.
    fn needed_at(&self, angle: f64, low: f64) -> Option<f64> {
        let pieces = self.motion.distinct().iter().enumerate();
        let holding = pieces.filter(|(_, piece)| piece.start <= angle && angle <= piece.end);
        holding
            .filter_map(|(index, _)| first_at_or_above(low, |radius| self.sharpness_at(radius, index, angle)).ok())
            .reduce(f64::max)
    }

    /// The worse of both limits; only one where that is clearly violated at one of the sampled lifts.
    fn either(&self, radius: f64) -> f64 {
        self.sampled_pressure(radius)
            .filter(|excess| *excess > CLEARLY)
            .or_else(|| self.sampled_sharpness(radius).filter(|excess| *excess > CLEARLY))
            .unwrap_or_else(|| worse(self.pressure(radius), self.curvature(radius)))
    }

    /// By how much the pressure angle is too large at the sampled lifts.
    fn sampled_pressure(&self, radius: f64) -> Option<f64> {
        let SizeSamples { lifts, place } = self.sampled.as_ref()?;
        let (place, choice) = place.as_ref()?;
        let shaft = place.shaft(*choice, radius)?;
        let [most, least] = self.required.pressure_angles;
        Some(
            lifts
                .iter()
                .map(|(_, lift)| {
                    let angle = place.pressure_angle(lift, shaft);
                    (angle - most).max(-angle - least)
                })
                .fold(f64::NEG_INFINITY, f64::max),
        )
    }

    /// By how much the profile under a face is too sharp at the sampled lifts.
    fn sampled_sharpness(&self, radius: f64) -> Option<f64> {
        if self.follower.element() != Element::Face {
            return None;
        }
        let follower = self.sized(radius)?;
        let curves = Curves { motion: self.motion, follower: &*follower };
        let least = self.sampled.as_ref()?.lifts.iter().map(|(at, lift)| curves.face_radius_of(*at, lift).0);
        Some((self.required.convex_radius - least.fold(f64::INFINITY, f64::min)) / radius)
    }

    /// The prime radius that the pressure angle alone requires under a roller on a straight path with its offset: tan α = (s' − ε)/(u0 + s)
    /// gives the least u0 of every lift. `None` under other followers, and without a limit.
    fn by_pressure_angle(&self) -> Option<f64> {
        let place = self.follower.place().filter(|place| matches!(place, FollowerPlacement::Offset { .. }))?;
        let offset = place.chosen_by(self.follower);
        let [most, least] = self.required.pressure_angles;
        let limits = [(most, false), (least, true)].into_iter().filter(|(limit, _)| limit.is_finite());
        let heights = limits.map(|(limit, falling)| {
            let pieces = self.motion.distinct().iter().enumerate().filter(|(index, _)| self.motion.is_rolled(*index));
            let heights = pieces.map(|(index, piece)| {
                let height = extremum::largest_with_slope(
                    |at| {
                        let plane = place.condition(&self.motion.jet(index, at), limit, falling);
                        let over = plane.normal.x;
                        ((plane.least - plane.normal.y * offset) / over, plane.least_slope / over)
                    },
                    (piece.start, piece.end),
                    self.motion.cells(index),
                );
                height.value
            });
            heights.fold(0.0, f64::max)
        });
        let height = heights.reduce(f64::max)?;
        Some(libm::hypot(height, offset)).filter(|radius| radius.is_finite())
    }
}

/// The larger of two excesses; NaN where one is NaN.
fn worse(one: f64, other: f64) -> f64 {
    if one > other || one.is_nan() { one } else { other }
}

/// The smallest size (m) at which the disc made by the follower keeps every limit.
///
/// # Errors
/// [`NoRadius`] when no radius up to 1 km, or in reach of the follower, does.
pub fn smallest(motion: &dyn Motion, follower: &dyn Follower, required: &SizeLimits) -> Result<SmallestSize, NoRadius> {
    let top = largest_lift_in_reach(motion, follower);
    let sizing = SizeProblem { motion, follower, required, top, sampled: sampled(motion, follower) };
    let offset = follower.element().offset();
    let largest = follower.prime_radii().1;
    if largest.is_finite() {
        let prime_radius = first_in_reach(required.least, largest, |radius| sizing.either(radius))?;
        let base_radius = rounded_in_reach(prime_radius - offset, |base| sizing.either(base + offset) <= 0.0);
        Ok(SmallestSize { prime_radius, base_radius })
    } else {
        let prime_radius = first_of_falling(required.least, &sizing)?;
        Ok(SmallestSize { prime_radius, base_radius: rounded_up(prime_radius - offset) })
    }
}

/// The sharpest convex curvature where a follower runs, or where none does, times a radius that it must allow, less 1.
fn sharpest(curves: Curves<'_>, rolled: bool, least_radius: f64) -> Extremum {
    let sharpest = extremes::convex_curvature_on(curves, |piece| curves.motion.is_rolled(piece) == rolled);
    Extremum { at: sharpest.at, value: sharpest.value * least_radius - 1.0 }
}

/// Both the pressure angle and the curvature fall as the radius grows under a follower that reaches everywhere, so each limit
/// is a root in the radius.
fn first_of_falling(least: f64, sizing: &SizeProblem<'_>) -> Result<f64, NoRadius> {
    let by_angle = sizing.by_pressure_angle();
    let mut radius = by_angle.map_or(least, |by_angle| by_angle.max(least));
    if !(radius <= LARGEST) {
        return Err(NoRadius);
    }
    for _ in 0..ROUNDS {
        let sharp_enough = sizing.first_not_too_sharp(radius)?;
        if by_angle.is_some_and(|by_angle| sharp_enough > by_angle * (1.0 + PRESSURE_NOISE)) {
            return Ok(sharp_enough);
        }
        radius = match passing_just_above(sharp_enough, |radius| sizing.pressure(radius)) {
            Ok(passing) => passing,
            Err(failing) => first_at_or_above(failing, |radius| sizing.pressure(radius))?,
        };
        if radius == sharp_enough {
            return Ok(radius);
        }
    }
    Err(NoRadius)
}

/// Ulps by which a radius in closed form may miss the side that passes.
const ULPS: u32 = 64;

/// A radius that should just pass, moved to the passing side.
fn just_above(radius: f64, excess: impl Fn(f64) -> f64) -> f64 {
    passing_just_above(radius, excess).unwrap_or_else(|missed| missed)
}

/// A radius that should just pass; the radius itself as an error where none so near passes.
fn passing_just_above(radius: f64, excess: impl Fn(f64) -> f64) -> Result<f64, f64> {
    let grown = (0..=ULPS.ilog2()).map(|power| radius * (1.0 + f64::from(1_u32 << power) * f64::EPSILON));
    std::iter::once(radius).chain(grown).find(|radius| excess(*radius) <= 0.0).ok_or(radius)
}

/// The first radius from `low` on at which `excess` is not positive.
fn first_at_or_above(low: f64, excess: impl Fn(f64) -> f64) -> Result<f64, NoRadius> {
    // A NaN does not pass: the curve does not exist at this radius.
    if excess(low) <= 0.0 {
        return Ok(low);
    }
    let (mut failing, mut passing) = (low, 2.0 * low);
    while failing < LARGEST {
        if excess(passing) <= 0.0 {
            let mut radius = root::bracketed(&excess, failing, passing, 0.0).map_err(|_| NoRadius)?;
            // The root is known to one ulp; take the side that passes.
            while excess(radius) > 0.0 && radius < passing {
                radius *= 1.0 + 4.0 * f64::EPSILON;
            }
            return Ok(radius.min(passing));
        }
        (failing, passing) = (passing, 2.0 * passing);
    }
    Err(NoRadius)
}

/// The first radius at which an excess is not positive that may fall and grow again: every radius in steps of a hundredth is tried, and
/// between three of which the middle one is the best, the best of all.
fn first_in_reach(least: f64, largest: f64, excess: impl Fn(f64) -> f64) -> Result<f64, NoRadius> {
    let first = (least, excess(least));
    let (mut before, mut here) = (first, first);
    loop {
        if here.1 <= 0.0 {
            return Ok(first_not_positive(before.0, here.0, &excess));
        }
        if here.0 >= largest {
            return Err(NoRadius);
        }
        let radius = (GROWTH_IN_REACH * here.0).min(largest);
        let next = (radius, excess(radius));
        // The best of three; a radius out of reach is worse than any other.
        let is_best = !here.1.is_nan() && [before.1, next.1].iter().all(|other| here.1 <= *other || other.is_nan());
        if is_best && (next.1 > 0.0 || next.1.is_nan()) {
            let best = extremum::largest_without_slope(
                |radius| Some(-excess(radius)).filter(|room| !room.is_nan()).unwrap_or(f64::NEG_INFINITY),
                (before.0, next.0),
                1,
                extremum::TO_ROUNDING,
            )
            .at;
            if excess(best) <= 0.0 {
                return Ok(first_not_positive(before.0, best, &excess));
            }
        }
        (before, here) = (here, next);
    }
}

/// The first radius above a failing one at which the limits are kept, growing up to `largest` (m); `None`
/// when none is found.
pub fn first_that_keeps(failing: f64, largest: f64, keeps: impl Fn(f64) -> bool) -> Option<f64> {
    let growth = if largest < FAR { GROWTH_IN_REACH } else { 2.0 };
    let mut below = failing;
    while below < largest {
        let next = (growth * below).min(largest);
        if keeps(next) {
            return Some(first_passing(below, next, keeps));
        }
        below = next;
    }
    None
}

/// Where an excess falls to 0 between a radius that fails, or has this excess, and one that passes: on the passing side.
fn first_not_positive(failing: f64, passing: f64, excess: impl Fn(f64) -> f64) -> f64 {
    let root = root::bracketed(&excess, failing, passing, 0.0).map(|radius| just_above(radius, &excess));
    match root {
        Ok(radius) if excess(radius) <= 0.0 => radius,
        // The follower does not reach everywhere in between.
        _ => first_passing(failing, passing, |radius| excess(radius) <= 0.0),
    }
}

/// The first radius that passes between one that fails, or is the only one, and one that passes.
pub fn first_passing(mut failing: f64, mut passing: f64, passes: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (failing + passing);
        *(if passes(middle) { &mut passing } else { &mut failing }) = middle;
    }
    passing
}

/// A base radius within reach in whole millimetres, where that passes too; otherwise in the coarsest finer step that does.
fn rounded_in_reach(base_radius: f64, passes: impl Fn(f64) -> bool) -> f64 {
    let tried = (0..=FINER_STEPS).map(|finer| rounded_up_to(base_radius, 10.0_f64.powi(finer) / BASE_STEP));
    let mut passing = tried.filter(|base| passes(*base));
    passing.next().unwrap_or(base_radius)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::follower::SwingingRoller;
    use crate::motion::Quantity;
    use crate::motion::laws::LAWS;
    use crate::motion::program::Program;
    use std::f64::consts::TAU;

    /// Numbers in [0, 1) that repeat: Weyl's sequence of the golden ratio.
    fn spread(index: u32) -> f64 {
        (f64::from(index) * 0.618_033_988_749_894_8).fract()
    }

    /// Under a lever the pressure angle falls and grows again with the radius. No radius on a grid twenty times finer than
    /// the search's own that passes is smaller, and what is solved passes.
    #[test]
    fn under_a_lever_no_smaller_radius_passes() {
        let (mut found, mut none) = (0, 0);
        for case in 0..20 {
            let u = |n: u32| spread(7 * case + n);
            let (arm, pivot) = (0.05 + 0.1 * u(0), 0.05 + 0.15 * u(1));
            let law = LAWS.get(usize::try_from(case).expect("few") % LAWS.len()).filter(|law| law.serves_rests());
            let swing = (5.0 + 25.0 * u(2)).to_radians();
            let rise = TAU * (0.15 + 0.3 * u(3));
            let fall = TAU * (0.15 + 0.3 * u(4));
            let program = Program::new(
                Quantity::Angle,
                0.0,
                &[(law, rise, swing), (None, 0.3, swing), (law, fall, 0.0), (None, 0.0, 0.0)],
            );
            // Laws that cannot begin and end at rest are skipped.
            let Ok(program) = program else { continue };
            let follower = SwingingRoller::new(arm, pivot, 0.008, if case % 2 == 0 { 1.0 } else { -1.0 });
            let required = SizeLimits {
                pressure_angles: [(20.0 + 30.0 * u(5)).to_radians(); 2],
                convex_radius: 0.01,
                least: 0.02_f64.max(follower.prime_radii().0),
            };
            let sizing = SizeProblem {
                motion: &program,
                follower: &follower,
                required: &required,
                top: lifts(&program).1,
                sampled: None,
            };
            let solved = smallest(&program, &follower, &required);
            let mut grid = required.least;
            let end = solved.map_or(follower.prime_radii().1, |smallest| smallest.prime_radius * (1.0 - 1e-9));
            while grid < end {
                assert!(!(sizing.either(grid) <= 0.0), "case {case}: {grid} passes before {solved:?}");
                grid *= 1.0 + (GROWTH_IN_REACH - 1.0) / 20.0;
            }
            match solved {
                Ok(SmallestSize { prime_radius, base_radius }) => {
                    found += 1;
                    assert!(
                        sizing.either(prime_radius) <= 0.0 && sizing.either(base_radius + 0.008) <= 0.0,
                        "case {case}"
                    );
                    assert!(base_radius + 0.008 >= prime_radius, "case {case}");
                }
                Err(NoRadius) => none += 1,
            }
        }
        assert!(found > 5 && none > 1, "{found} found, {none} not");
    }
}

//! The smallest prime radius that keeps every limit, solved.

use super::{Curves, extremes, lifts};
use crate::follower::{Element, Follower, Place};
use crate::machine::{CamData, Limits};
use crate::motion::{Jet, Motion, Piece};
use crate::numeric::{extremum, root};

/// Whole millimetres an automatic base radius is rounded up to, m; a millionth of a step is rounding noise.
const BASE_STEP: f64 = 1e-3;
const BASE_STEP_NOISE: f64 = 1e-6;

/// Smallest radius of curvature that an automatic size leaves under a flat face, m: a sharper place is an edge.
const LEAST_FACE_RADIUS: f64 = 1e-3;

/// Least convex radius of a roller's curve where it only closes the outline, over the radius of the roller: with nothing to spare the
/// profile comes to a cusp there, and whether that is an undercut is left to rounding.
const CLOSING_OVER_ROLLER: f64 = 1.05;

/// What a radius must keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Required {
    /// Largest pressure angles where it is positive and where it is negative, rad; infinite where there is no limit.
    pub pressure_angles: [f64; 2],
    /// Smallest convex radius of the follower's curve where the follower runs, m.
    pub convex_radius: f64,
    /// Prime radius below which nothing is tried, m.
    pub least: f64,
}

impl Required {
    /// What the limits of a machine file and the bore require of a disc under a follower.
    #[must_use]
    pub fn of(limits: &Limits, cam: &CamData, follower: &dyn Follower) -> Self {
        let offset = follower.element().offset();
        // Without a limit for the wall there must still be some.
        let wall = if limits.wall > 0.0 { limits.wall } else { BASE_STEP };
        let least_base = cam.bore_reach().map_or(BASE_STEP, |reach| reach + wall);
        Self {
            pressure_angles: limits.pressure_angles(),
            convex_radius: limits.convex_radius(offset).max(match follower.element() {
                Element::Roller { radius } => radius,
                Element::Face => LEAST_FACE_RADIUS,
            }),
            least: (least_base + offset).max(follower.prime_radii().0),
        }
    }
}

/// The base radius that `auto` makes of the smallest one, m: the next whole millimetre.
#[must_use]
pub fn rounded_up(base_radius: f64) -> f64 {
    rounded_up_to(base_radius, 1.0 / BASE_STEP)
}

/// The next of so many steps to a metre, but for rounding noise. A quotient keeps "69 mm" the number nearest to 0.069.
fn rounded_up_to(radius: f64, steps_per_metre: f64) -> f64 {
    (radius * steps_per_metre - BASE_STEP_NOISE).ceil() / steps_per_metre
}

/// Doublings from the least radius before giving up: 1 µm to 1e9 m.
const DOUBLINGS: u32 = 50;

/// Growth from one radius to the next under a follower of limited reach: a range of radii may pass between two that do not.
const GROWTH_IN_REACH: f64 = 1.01;
/// Where the reach of a follower ends below this, m, steps are small.
const FAR: f64 = 1e3;
/// Halvings of the search for the lower end of a range that passes.
const HALVINGS: u32 = 60;
/// Finer steps, of a tenth each, in which a base radius is rounded where the whole millimetre does not pass: to 1 nm.
const FINER_STEPS: i32 = 6;

/// Rounds of solving each limit in turn. A limit may be broken again by the radius that another one needs only where it
/// is not monotone in the radius; each round then starts above the last.
const ROUNDS: u32 = 8;

/// No radius keeps the limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("no base radius keeps the limits")]
pub struct NoRadius;

/// The largest lift that a follower of limited reach has to follow, m or rad; any other can follow every lift.
#[must_use]
pub fn largest_lift_in_reach(motion: &dyn Motion, follower: &dyn Follower) -> f64 {
    if follower.reach().1.is_finite() { lifts(motion).1 } else { 0.0 }
}

/// The smallest size of a disc that keeps every limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smallest {
    /// Prime radius, m.
    pub prime_radius: f64,
    /// The base radius that `auto` makes of it, m.
    pub base_radius: f64,
}

/// What is solved for: by how much a disc of a prime radius breaks the limits.
struct Sizing<'a> {
    motion: &'a dyn Motion,
    follower: &'a dyn Follower,
    required: &'a Required,
    /// The largest lift that has to be in reach.
    top: f64,
    /// What is looked at first where sizes are tried one by one.
    sampled: Option<Sampled>,
}

/// Places at which a size is looked at first: nearly all that do not pass are clearly broken at one of them.
struct Sampled {
    /// Cam angle and lift.
    lifts: Vec<(f64, Jet)>,
    /// The follower's place where it has one.
    place: Option<(Place, f64)>,
}

/// By how much a pressure angle is clearly too large, rad, or a profile too sharp, as a share: nearer to its limit it is solved, so that
/// sizes are compared alike there.
const CLEARLY: f64 = 0.03;
/// Steps of a piece at which a size is looked at first.
const SAMPLES: u32 = 24;

/// The lifts of a motion under a follower of limited reach, whose sizes are tried one by one.
fn sampled(motion: &dyn Motion, follower: &dyn Follower) -> Option<Sampled> {
    if follower.prime_radii().1.is_infinite() {
        return None;
    }
    let pieces = motion.distinct().iter().enumerate().filter(|(index, _)| motion.is_rolled(*index));
    let lifts = pieces.flat_map(|(index, piece)| {
        let steps = if piece.dwell { 1 } else { SAMPLES };
        let at = move |step: u32| piece.start + (piece.end - piece.start) * f64::from(step) / f64::from(steps);
        (0..=steps).map(move |step| (at(step), motion.jet(index, at(step))))
    });
    Some(Sampled { lifts: lifts.collect(), place: follower.place().map(|place| (place, place.of(follower))) })
}

impl Sizing<'_> {
    /// A quantity of the disc of a radius; NaN, which does not pass, where the follower does not reach.
    fn at(&self, radius: f64, excess: impl Fn(Curves<'_>) -> f64) -> f64 {
        let follower = self.follower.sized(radius).filter(|follower| self.top <= follower.reach().1);
        follower.map_or(f64::NAN, |follower| excess(Curves { motion: self.motion, follower: &*follower }))
    }

    fn pressure(&self, radius: f64) -> f64 {
        if self.required.pressure_angles.iter().all(|limit| limit.is_infinite()) {
            return self.at(radius, |_| f64::NEG_INFINITY);
        }
        self.at(radius, |curves| {
            let [rising, falling] = extremes::pressure_angles(curves);
            let [most, least] = self.required.pressure_angles;
            worse(rising.value - most, falling.value - least)
        })
    }

    fn curvature(&self, radius: f64) -> f64 {
        self.at(radius, |curves| match curves.element() {
            Element::Roller { radius: roller } => self.too_sharp(curves, roller),
            // The profile under a face must not turn back on itself, nor come to an edge.
            Element::Face => (self.required.convex_radius - extremes::least_radius(curves).value) / radius,
        })
    }

    /// By how much the curve of a roller is too sharp.
    fn too_sharp(&self, curves: Curves<'_>, roller: f64) -> f64 {
        let motion = curves.motion;
        let sharpest =
            |rolled: bool| extremes::convex_curvature_on(curves, |piece| motion.is_rolled(piece) == rolled).value;
        let excess = sharpest(true) * self.required.convex_radius - 1.0;
        if motion.is_rolled_throughout() {
            return excess;
        }
        worse(excess, sharpest(false) * CLOSING_OVER_ROLLER * roller - 1.0)
    }

    /// The worse of both limits; of one alone where that is clearly broken at one of the lifts that are looked at first.
    fn either(&self, radius: f64) -> f64 {
        let clearly = |excess: Option<f64>| excess.filter(|excess| *excess > CLEARLY);
        clearly(self.sampled_pressure(radius))
            .or_else(|| clearly(self.sampled_sharpness(radius)))
            .unwrap_or_else(|| worse(self.pressure(radius), self.curvature(radius)))
    }

    /// By how much the pressure angle is too large at the lifts that are looked at first.
    fn sampled_pressure(&self, radius: f64) -> Option<f64> {
        let Sampled { lifts, place } = self.sampled.as_ref()?;
        let (place, choice) = place.as_ref()?;
        let shaft = place.shaft(*choice, radius)?;
        let [most, least] = self.required.pressure_angles;
        let excess = |(_, lift): &(f64, Jet)| {
            let angle = place.pressure_angle(lift, shaft);
            (angle - most).max(-angle - least)
        };
        Some(lifts.iter().map(excess).fold(f64::NEG_INFINITY, f64::max))
    }

    /// By how much the profile under a face is too sharp at the lifts that are looked at first.
    fn sampled_sharpness(&self, radius: f64) -> Option<f64> {
        if self.follower.element() != Element::Face {
            return None;
        }
        let follower = self.follower.sized(radius).filter(|follower| self.top <= follower.reach().1)?;
        let curves = Curves { motion: self.motion, follower: &*follower };
        let least = self.sampled.as_ref()?.lifts.iter().map(|(at, lift)| curves.face_radius_of(*at, lift).0);
        Some((self.required.convex_radius - least.fold(f64::INFINITY, f64::min)) / radius)
    }

    /// The prime radius that the pressure angle alone asks for under a roller on a straight path with its offset: tan α = (s' − ε)/(u0 + s)
    /// gives the least u0 of every lift. `None` under other followers, and without a limit.
    fn by_pressure_angle(&self) -> Option<f64> {
        let place = self.follower.place().filter(|place| matches!(place, Place::Offset { .. }))?;
        let offset = place.of(self.follower);
        let least_height = |(limit, falling): (f64, bool)| {
            let of_piece = |(index, piece): (usize, &Piece)| {
                let height = |at: f64| {
                    let plane = place.condition(&self.motion.jet(index, at), limit, falling);
                    let over = plane.normal.x;
                    ((plane.least - plane.normal.y * offset) / over, plane.least_slope / over)
                };
                let cells = self.motion.cells(index);
                extremum::largest_with_slope(height, (piece.start, piece.end), cells).value
            };
            let pieces = self.motion.distinct().iter().enumerate().filter(|(index, _)| self.motion.is_rolled(*index));
            pieces.map(of_piece).fold(0.0, f64::max)
        };
        let [most, least] = self.required.pressure_angles;
        let limits = [(most, false), (least, true)].into_iter().filter(|(limit, _)| limit.is_finite());
        let height = limits.map(least_height).reduce(f64::max)?;
        Some(libm::hypot(height, offset)).filter(|radius| radius.is_finite())
    }
}

/// The larger of two excesses; NaN where one is.
fn worse(one: f64, other: f64) -> f64 {
    if one > other || one.is_nan() { one } else { other }
}

/// The smallest size (m) at which the disc made by the follower keeps every limit.
///
/// # Errors
/// [`NoRadius`] when no radius up to 1e9 m, or in reach of the follower, does.
pub fn smallest(motion: &dyn Motion, follower: &dyn Follower, required: &Required) -> Result<Smallest, NoRadius> {
    let top = largest_lift_in_reach(motion, follower);
    let sizing = Sizing { motion, follower, required, top, sampled: sampled(motion, follower) };
    let offset = follower.element().offset();
    let largest = follower.prime_radii().1;
    if largest.is_finite() {
        let prime_radius = first_in_reach(required.least, largest, |radius| sizing.either(radius))?;
        let base_radius = rounded_in_reach(prime_radius - offset, |base| sizing.either(base + offset) <= 0.0);
        Ok(Smallest { prime_radius, base_radius })
    } else {
        let prime_radius = first_of_falling(required.least, &sizing)?;
        Ok(Smallest { prime_radius, base_radius: rounded_up(prime_radius - offset) })
    }
}

/// Both the pressure angle and the curvature fall as the radius grows under a follower that reaches everywhere, so each limit
/// is a root in the radius.
fn first_of_falling(least: f64, sizing: &Sizing<'_>) -> Result<f64, NoRadius> {
    let (pressure, curvature) = (|radius: f64| sizing.pressure(radius), |radius: f64| sizing.curvature(radius));
    let limits: [&dyn Fn(f64) -> f64; 2] = [&pressure, &curvature];
    let by_angle = sizing.by_pressure_angle().map(|by_angle| passing_just_above(by_angle, pressure));
    let mut radius = by_angle.map_or(least, |by_angle| by_angle.unwrap_or_else(|missed| missed).max(least));
    // The radius at which each limit was seen to be kept last.
    let mut kept = [by_angle.and_then(Result::ok), None];
    for _ in 0..ROUNDS {
        for (limit, kept) in limits.iter().zip(&mut kept) {
            if *kept != Some(radius) {
                radius = first_at_or_above(radius, limit)?;
                *kept = Some(radius);
            }
        }
        if kept.iter().all(|kept| *kept == Some(radius)) {
            return Ok(radius);
        }
    }
    Err(NoRadius)
}

/// Ulps by which a radius in closed form may miss the side that passes.
const ULPS: u32 = 64;

/// A radius that should just pass, on the side that does.
fn just_above(radius: f64, excess: impl Fn(f64) -> f64) -> f64 {
    passing_just_above(radius, excess).unwrap_or_else(|missed| missed)
}

/// The same; the radius itself as an error where none so near passes.
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
    for _ in 0..DOUBLINGS {
        if excess(passing) <= 0.0 {
            let mut radius = root::bracketed(&excess, failing, passing, 0.0).map_err(|_| NoRadius)?;
            // The root is known to an ulp; take the side that passes.
            while excess(radius) > 0.0 && radius < passing {
                radius *= 1.0 + 4.0 * f64::EPSILON;
            }
            return Ok(radius.min(passing));
        }
        (failing, passing) = (passing, 2.0 * passing);
    }
    Err(NoRadius)
}

/// The same for an excess that may fall and grow again: every radius in steps of a hundredth is tried, and between three of
/// which the middle one is the best, the best of all.
fn first_in_reach(least: f64, largest: f64, excess: impl Fn(f64) -> f64) -> Result<f64, NoRadius> {
    let passes = |radius: f64| excess(radius) <= 0.0;
    let at = |radius: f64| (radius, excess(radius));
    let (mut before, mut here) = (at(least), at(least));
    loop {
        if here.1 <= 0.0 {
            return Ok(first_not_positive(before.0, here.0, &excess));
        }
        if here.0 >= largest {
            return Err(NoRadius);
        }
        let next = at((GROWTH_IN_REACH * here.0).min(largest));
        // The best of three; a radius out of reach is worse than any other.
        let better = |one: f64, other: f64| one <= other || other.is_nan();
        let is_best = !here.1.is_nan() && better(here.1, before.1) && better(here.1, next.1);
        if is_best && (next.1 > 0.0 || next.1.is_nan()) {
            let room = |radius: f64| Some(-excess(radius)).filter(|room| !room.is_nan()).unwrap_or(f64::NEG_INFINITY);
            let best = extremum::largest_without_slope(room, (before.0, next.0), 1, extremum::TO_ROUNDING).at;
            if passes(best) {
                return Ok(first_not_positive(before.0, best, &excess));
            }
        }
        (before, here) = (here, next);
    }
}

/// The first radius above one that does not keep the limits at which they are kept, growing as far as `largest` (m); `None`
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

/// Where an excess falls to 0 between a radius that does not pass, or is the same, and one that does: on the side that passes.
fn first_not_positive(failing: f64, passing: f64, excess: impl Fn(f64) -> f64) -> f64 {
    let root = root::bracketed(&excess, failing, passing, 0.0).map(|radius| just_above(radius, &excess));
    match root {
        Ok(radius) if excess(radius) <= 0.0 => radius,
        // The follower does not reach everywhere between.
        _ => first_passing(failing, passing, |radius| excess(radius) <= 0.0),
    }
}

/// The first radius that passes between one that does not, or is the same, and one that does.
pub fn first_passing(mut failing: f64, mut passing: f64, passes: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (failing + passing);
        *(if passes(middle) { &mut passing } else { &mut failing }) = middle;
    }
    passing
}

/// A base radius in reach in whole millimetres, where that passes too; else in the coarsest finer step that does.
fn rounded_in_reach(base_radius: f64, passes: impl Fn(f64) -> bool) -> f64 {
    let tried = (0..=FINER_STEPS).map(|finer| rounded_up_to(base_radius, 10.0_f64.powi(finer) / BASE_STEP));
    let mut passing = tried.filter(|base| passes(*base));
    passing.next().unwrap_or(base_radius)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::follower::{SwingingRoller, TranslatingRoller};
    use crate::motion::brake_disc::{self, BrakeDisc};
    use crate::motion::laws::LAWS;
    use crate::motion::program::Program;
    use crate::motion::{Motion, Quantity};
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
            let follower = SwingingRoller::new(arm, pivot, 0.008, if case % 2 == 0 { 1.0 } else { -1.0 });
            let required = Required {
                pressure_angles: [(20.0 + 30.0 * u(5)).to_radians(); 2],
                convex_radius: 0.01,
                least: 0.02_f64.max(follower.prime_radii().0),
            };
            let sizing = Sizing {
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
                Ok(Smallest { prime_radius, base_radius }) => {
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

    /// The disc of a brake, and a centred roller on the smallest one that keeps a pressure angle.
    fn of_brake(roller: f64, pressure_angle: f64) -> (BrakeDisc, TranslatingRoller) {
        let motion = brake_disc::tests::disc();
        let required = Required { pressure_angles: [pressure_angle; 2], convex_radius: roller, least: 1e-3 + roller };
        let follower = TranslatingRoller::new(0.1, 0.0, roller);
        let prime_radius = smallest(&motion, &follower, &required).expect("a radius").prime_radius;
        (motion, TranslatingRoller::new(prime_radius, 0.0, roller))
    }

    /// max(|y'|/tan 30° − y) of the law, counted from its own zero, which lies above the lowest point of the disc.
    #[test]
    fn where_no_follower_runs_the_pressure_angle_may_be_larger() {
        let limit = 30.0_f64.to_radians();
        let (motion, follower) = of_brake(1e-3, limit);
        let prime_radius = follower.prime_radius().expect("sized") - motion.origin().expect("an origin");
        assert!((1e3 * prime_radius - 44.327_659_755_76).abs() < 1e-9, "{prime_radius}");
        let curves = Curves { motion: &motion, follower: &follower };
        let [working, closing] = [0, 1].map(|index| {
            let piece = motion.pieces()[index];
            let lean = |i: u32| {
                let at = piece.start + (piece.end - piece.start) * f64::from(i) / 1000.0;
                curves.contact(index, at).pressure_angle.abs()
            };
            (0..=1000).map(lean).fold(0.0, f64::max)
        });
        assert!(working <= limit * (1.0 + 1e-12) && closing > 1.5 * limit, "{working} {closing}");
    }

    /// Under a large roller the closing stretch is the sharper one; a convex radius of twice that of the roller is not asked of it.
    #[test]
    fn where_no_follower_runs_there_is_no_undercut_and_no_more_is_asked() {
        let roller = 0.08;
        let (motion, follower) = of_brake(roller, 80.0_f64.to_radians());
        let curves = Curves { motion: &motion, follower: &follower };
        let radius = |piece: usize| 1.0 / extremes::convex_curvature_on(curves, |own| own == piece).value;
        assert!((radius(1) / (CLOSING_OVER_ROLLER * roller) - 1.0).abs() < 1e-12, "{}", radius(1));
        assert!(radius(0) > roller, "{}", radius(0));

        let required =
            Required { pressure_angles: [80.0_f64.to_radians(); 2], convex_radius: 2.0 * roller, least: roller };
        let prime_radius = smallest(&motion, &follower, &required).expect("a radius").prime_radius;
        let follower = TranslatingRoller::new(prime_radius, 0.0, roller);
        let curves = Curves { motion: &motion, follower: &follower };
        let radius = |piece: usize| 1.0 / extremes::convex_curvature_on(curves, |own| own == piece).value;
        assert!((radius(0) / (2.0 * roller) - 1.0).abs() < 1e-12, "{}", radius(0));
        assert!(radius(1) < 1.9 * roller, "{}", radius(1));
    }
}

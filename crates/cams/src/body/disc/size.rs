//! The size of a disc, and the position of its follower, where these are to be chosen.

use super::{Disc, LARGEST_BASE};
use crate::body::size_limits;
use crate::body::{Figures, WorstPlaces, broken_limit};
use crate::check::contact_stress;
use crate::machine::Machine;
use camgen_kernel::follower::{Follower, FollowerPlacement};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::program::Program;
use camgen_kernel::numeric::extremum::{self, TO_ROUNDING};
use camgen_kernel::profile::placing::{self, SmallestShaftPlace};
use camgen_kernel::profile::size::{self, SizeLimits, SmallestSize};
use camgen_kernel::profile::{Curves, Worst, extremes};
use camgen_kernel::refusal::{Refusal, WorkBound};
use std::cell::Cell;
use std::sync::{Arc, OnceLock};

/// Half millimetres, in which an offset or a pivot distance is chosen, m.
const CHOICE_STEP: f64 = 0.5e-3;
/// Places tried, and golden sections between the best of them, where more than the pressure angle matters.
const PLACES: u32 = 24;
/// Segments of a motion whose follower is placed: the cam is sized some hundred times.
const PLACED_SEGMENTS: WorkBound =
    WorkBound { what: "segments of a motion whose follower has a free place", most: 200 };
/// Valleys of the size over the place that are followed to their ground.
const VALLEYS: usize = 3;
/// By how much a prime radius is larger than another one, as a share, before it is held to be.
const LARGER: f64 = 1e-9;
/// A radius in reach is looked for in whole millimetres, of large ones in shares of this.
const FINE_STEPS: f64 = 1000.0;
/// A prime radius from which sizes are tried, m.
pub(super) const LEAST_PRIME: f64 = 1e-4;
/// By how much a cam is made smaller to see which limit it then breaks, as a share.
const JUST_BELOW: f64 = 1e-6;

/// The chosen position of a follower.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FollowerChoice {
    /// The dimension that is to be chosen.
    pub place: FollowerPlacement,
    /// The best choice and the prime radius of the cam with it, m.
    pub best: (f64, f64),
    /// The choice, in half millimetres where that passes, m.
    pub chosen: f64,
}

/// Why a cam is not smaller.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Binding {
    /// The limit that a smaller one breaks, as `limits` of the machine file calls it; `bore` for the metal about the bore, `reach` where
    /// the follower would not reach.
    pub limit: &'static str,
    /// Place where it is broken.
    pub at: Option<Worst>,
}

impl Disc {
    pub(super) fn sized(mut self) -> Result<Self, Refusal> {
        let (motion, follower) = (self.motion.quantity(), self.follower.quantity());
        if motion != follower {
            let (motion, follower) = (motion.words(), follower.words());
            return Err(Refusal::new(format!("the motion is {motion}, but the follower takes {follower}")));
        }
        if let Some(place) = self.machine.follower.place {
            let placed = self.best_place(place)?;
            (self.follower, self.placed) = (place.follower(placed.chosen), Some(placed));
        }
        // How quickly a face turns on the cam does not depend on the size.
        if let Some(turn) = extremes::least_turn(self.curves()).filter(|turn| !(turn.value > 0.0)) {
            let what = "the face on its arm, which swings by more than the cam turns, turns back on the cam";
            return Err(Refusal::new(what)
                .at(format!("{:.3} deg", turn.at.to_degrees()))
                .remedy("give a smaller swing, a longer rise, or the other follower.swinging-flat.side"));
        }
        let offset = self.follower.element().offset();
        let required = self.required();
        let base = if let Some(base) = self.machine.cam.base_radius {
            base
        } else {
            let by_shape = size::smallest(&*self.motion, &*self.follower, &required);
            // Its worst places are known.
            if let Some((smallest, disc)) = by_shape.ok().and_then(|smallest| self.keeping_all(smallest)) {
                return Ok(Self { smallest: OnceLock::from(Some(smallest)), ..disc });
            }
            // A limit that no radius keeps: its check says so.
            self.smallest = OnceLock::from(None);
            by_shape.map_err(|_| self.without_radius())?.base_radius
        };
        let top = size::largest_lift_in_reach(&*self.motion, &*self.follower);
        let sized = self.follower.sized(base + offset).filter(|follower| top <= follower.reach().1);
        let out_of_reach = || {
            let what =
                format!("the follower does not reach every lift on a cam of base radius {} mm", MILLIMETRES * base);
            let refusal = Refusal::new(what);
            match self.largest_in_reach(base) {
                Some(base) => {
                    refusal.remedy(format!("cam.base_radius = \"{base} mm\" is in reach, or give another arm"))
                }
                None => refusal.remedy("give another arm or a smaller swing"),
            }
        };
        self.follower = sized.ok_or_else(out_of_reach)?.into();
        Ok(self)
    }

    /// The sizes that keep every limit; `None` when none does.
    pub(super) fn smallest(&self) -> Option<SmallestSize> {
        let found = || {
            let by_shape = size::smallest(&*self.motion, &*self.follower, &self.required()).ok()?;
            self.keeping_all(by_shape).map(|(smallest, _)| smallest)
        };
        *self.smallest.get_or_init(found)
    }

    /// What its limits and its bore require of its size; where a keyway stands under a lobe it does not matter.
    pub(super) fn required(&self) -> SizeLimits {
        let cam = &self.machine.cam;
        let required = size_limits(&self.machine.limits, (cam, cam.bore_radius), &*self.follower);
        if self.is_cut {
            required
        } else {
            SizeLimits { pressure_angles: [f64::INFINITY; 2], convex_radius: 0.0, ..required }
        }
    }

    /// Whether more than pressure angle, curvature and bore determines its size.
    fn is_limited_by_more(&self) -> bool {
        let Machine { limits, cam, .. } = &*self.machine;
        limits.cutter_radius.is_some()
            || cam.keyway.is_some()
            || contact_stress::largest_allowed(&self.machine, self.touching()).is_some()
            || self.rest.is_some()
    }

    /// The first limit that the rest of its body breaks with a disc of this size.
    pub(super) fn broken_by_rest(&self) -> Option<&'static str> {
        self.rest.and_then(|rest| rest(self))
    }

    /// The first limit broken by the disc itself, if it is cut.
    fn broken_itself(&self) -> Option<&'static str> {
        if self.is_cut { broken_limit(self) } else { None }
    }

    /// The first limit broken by the disc, or by the rest of its body.
    pub(super) fn broken(&self) -> Option<&'static str> {
        self.broken_itself().or_else(|| self.broken_by_rest())
    }

    /// The same cam on another base radius (m), if the follower reaches it.
    pub(in crate::body) fn on(&self, base_radius: f64) -> Option<Self> {
        let top = size::largest_lift_in_reach(&*self.motion, &*self.follower);
        let follower = self.follower.sized(base_radius + self.follower.element().offset())?;
        let reached = top <= follower.reach().1;
        reached.then(|| Self { follower: follower.into(), worst: WorstPlaces::default(), ..self.clone() })
    }

    /// The largest base radius below one that is out of reach, in whole millimetres, mm.
    fn largest_in_reach(&self, base_radius: f64) -> Option<f64> {
        let mut base = (MILLIMETRES * base_radius).ceil() - 1.0;
        while base >= 1.0 {
            if self.on(base / MILLIMETRES).is_some() {
                return Some(base);
            }
            base -= (base / FINE_STEPS).floor().max(1.0);
        }
        None
    }

    /// The same cam with another choice of its follower's place, m, not yet sized.
    #[must_use]
    pub fn placed_at(&self, place: FollowerPlacement, chosen: f64) -> Self {
        let follower = place.follower(chosen);
        Self {
            follower,
            smallest: OnceLock::new(),
            exact: OnceLock::new(),
            worst: WorstPlaces::default(),
            ..self.clone()
        }
    }

    /// From the smallest size that keeps pressure angle and curvature to the smallest that keeps every limit depending on it, each
    /// as its check measures it, and the cam on its base radius; `None` when no size in reach does. The prime radius is the least of
    /// all once [`Self::before_rounding`] has seen it.
    fn keeping_all(&self, smallest: SmallestSize) -> Option<(SmallestSize, Self)> {
        let offset = self.follower.element().offset();
        let cornered = Cell::new(false);
        let kept = |disc: &Self| {
            let broken = disc.broken();
            cornered.set(cornered.get() || broken.is_some_and(|limit| disc.has_corner_that_breaks(limit)));
            broken.is_none()
        };
        let disc = self.on(smallest.base_radius);
        if let Some(disc) = disc.as_ref().filter(|disc| kept(disc)) {
            return Some((smallest, disc.clone()));
        }
        // A larger cam has the corner, too, until it is too small to be seen.
        if cornered.get() || disc.is_some_and(|disc| disc.has_corner()) {
            return None;
        }
        let keeps = |base: f64| self.on(base).is_some_and(|disc| kept(&disc));
        let largest = (self.follower.prime_radii().1 - offset).min(LARGEST_BASE);
        let prime_radius = size::first_that_keeps(smallest.base_radius, largest, keeps)? + offset;
        let rounded = size::rounded_up(prime_radius - offset);
        let base_radius = if keeps(rounded) { rounded } else { prime_radius - offset };
        if cornered.get() {
            return None;
        }
        Some((SmallestSize { prime_radius, base_radius }, self.on(base_radius)?))
    }

    /// A size that keeps every limit when it is rounded: as small as it does, where more than pressure angle and curvature matters.
    pub(super) fn before_rounding(&self, smallest: SmallestSize) -> SmallestSize {
        let keeps = |base: f64| self.on(base).is_some_and(|disc| disc.broken().is_none());
        let offset = self.follower.element().offset();
        if !self.is_limited_by_more() || keeps(smallest.prime_radius - offset) {
            return smallest;
        }
        let exact = size::first_passing(smallest.prime_radius - offset, smallest.base_radius, keeps);
        SmallestSize { prime_radius: exact + offset, ..smallest }
    }

    /// Whether its profile has an edge at any size, because the velocity of the follower drops.
    pub(super) fn has_corner(&self) -> bool {
        let curves = self.curves();
        extremes::fold(curves).is_some() || extremes::corners(curves).iter().any(|corner| corner.turn > 0.0)
    }

    /// Whether a limit is broken because of a corner that the profile has at any size: an edge, or a place as hollow as the follower's
    /// element, which no cutter of the limit can cut, because the velocity grows at once.
    fn has_corner_that_breaks(&self, limit: &str) -> bool {
        let (curves, cutter) = (self.curves(), self.machine.limits.cutter_radius.unwrap_or(0.0));
        match limit {
            "undercut" => self.has_corner(),
            "cutter_radius" => {
                curves.offset() < cutter && extremes::corners(curves).iter().any(|corner| corner.turn < 0.0)
            }
            _ => false,
        }
    }

    /// The smallest size with a choice of its follower's place; `least` is a prime radius (m) below which none passes.
    #[must_use]
    pub fn smallest_at(&self, place: FollowerPlacement, chosen: f64, least: f64) -> Option<SmallestSize> {
        let disc = self.placed_at(place, chosen);
        let required = disc.required();
        let required = SizeLimits { least: required.least.max(least), ..required };
        let by_shape = size::smallest(&*disc.motion, &*disc.follower, &required).ok()?;
        let (smallest, disc) = disc.keeping_all(by_shape)?;
        Some(disc.before_rounding(smallest))
    }

    /// The smallest prime radius with that choice by the pressure angle alone, m.
    #[must_use]
    pub fn smallest_inclined_at(&self, place: FollowerPlacement, chosen: f64, least: f64) -> Option<f64> {
        let disc = self.placed_at(place, chosen);
        let least = disc.follower.prime_radii().0.max(LEAST_PRIME).max(least);
        let required = SizeLimits { convex_radius: 0.0, least, ..disc.required() };
        size::smallest(&*disc.motion, &*disc.follower, &required).ok().map(|smallest| smallest.prime_radius)
    }

    /// The same cam on another prime radius (m), whatever limits it breaks, if the follower reaches it.
    #[must_use]
    pub fn of_prime_radius(&self, prime_radius: f64) -> Option<Self> {
        self.on(prime_radius - self.follower.element().offset())
    }

    /// The smallest cam by the pressure angle alone over every place of its follower.
    ///
    /// # Errors
    /// [`Refusal`] when no place keeps it.
    pub fn nearest(&self, place: FollowerPlacement) -> Result<SmallestShaftPlace, Refusal> {
        let limits = self.machine.limits.pressure_angles();
        placing::nearest(&*self.motion, place, limits).ok_or_else(|| {
            let (path, key) = (self.machine.follower.path, place.key());
            Refusal::new(format!("{path}.{key} = \"auto\": no place of the follower keeps the pressure angle"))
                .remedy("relax limits.pressure_angle, or give a longer rise")
        })
    }

    /// The place of the smallest cam, or with a given base radius of that with the least pressure angle for its limit.
    fn best_place(&self, place: FollowerPlacement) -> Result<FollowerChoice, Refusal> {
        PLACED_SEGMENTS.allow(self.motion.program().map_or(1, Program::segment_count))?;
        let offset = self.follower.element().offset();
        if let Some(base) = self.machine.cam.base_radius {
            let prime_radius = base + offset;
            let best = self.least_inclined(place, prime_radius);
            let chosen = better(place, best, |choice| self.inclination(place, choice, prime_radius));
            return Ok(FollowerChoice { place, best: (best, prime_radius), chosen: chosen.unwrap_or(best) });
        }
        let nearest = self.nearest(place)?;
        let least = nearest.prime_radius * (1.0 - LARGER);
        let size = |choice: f64| self.smallest_at(place, choice, least);
        let best = self
            .best_of(place, &nearest, size)
            .ok_or_else(|| self.placed_at(place, place.chosen(nearest.shaft)).without_radius())?;
        let chosen = better(place, best.0, |choice| size(choice).map(|smallest| smallest.base_radius));
        Ok(FollowerChoice { place, best, chosen: chosen.unwrap_or(best.0) })
    }

    /// The choice with the smallest prime radius, and that radius; from the one that the pressure angle alone requires, which is the best
    /// where nothing else matters.
    fn best_of(
        &self,
        place: FollowerPlacement,
        nearest: &SmallestShaftPlace,
        size: impl Fn(f64) -> Option<SmallestSize> + Sync,
    ) -> Option<(f64, f64)> {
        let ideal = place.chosen(nearest.shaft);
        if self.keeps_but_rounding(place, ideal, nearest.prime_radius) {
            return Some((ideal, nearest.prime_radius));
        }
        let prime = |choice: f64| size(choice).map_or(f64::INFINITY, |smallest| smallest.prime_radius);
        let mut best = (ideal, prime(ideal));
        // No better place is farther than the size of a cam that is known.
        let (mut searched, mut width) = (0.0, if best.1.is_finite() { best.1 } else { 4.0 * nearest.prime_radius });
        while searched < width && width < LARGEST_BASE {
            let (least, most) = place.choices(width);
            let range = ((ideal - width).max(least), (ideal + width).min(most));
            let found =
                extremum::largest_of_hills_in_parallel(|choice| -prime(choice), range, PLACES, VALLEYS, TO_ROUNDING);
            if -found.value < best.1 {
                best = (found.at, -found.value);
            }
            searched = width;
            width = if best.1.is_finite() { best.1 } else { 4.0 * width };
        }
        if !best.1.is_finite() {
            return None;
        }
        // Where the bore or a limit of the curvature determines the size, many places may have it: that with the least pressure angle is
        // taken.
        let flattest = self.least_inclined(place, best.1);
        if prime(flattest) <= best.1 * (1.0 + LARGER) { Some((flattest, best.1)) } else { Some(best) }
    }

    /// Whether a size that the pressure angle alone requires keeps every other limit.
    fn keeps_but_rounding(&self, place: FollowerPlacement, choice: f64, prime_radius: f64) -> bool {
        let of_more = self.is_limited_by_more();
        let disc = self.placed_at(place, choice).of_prime_radius(prime_radius * (1.0 + LARGER));
        disc.is_some_and(|disc| {
            prime_radius >= disc.required().least
                && disc.least_rolled_radius().value >= disc.required().convex_radius
                && disc.broken().is_none_or(|limit| !of_more && limit.starts_with("pressure_angle"))
        })
    }

    /// The choice with the least pressure angle over its limit on a cam of a prime radius, m.
    fn least_inclined(&self, place: FollowerPlacement, prime_radius: f64) -> f64 {
        let inclined = |choice: f64| -self.inclination(place, choice, prime_radius).unwrap_or(f64::INFINITY);
        extremum::largest_without_slope(inclined, place.choices(prime_radius), PLACES, TO_ROUNDING).at
    }

    /// Largest pressure angle over its limit with a choice on a cam of a prime radius, m; `None` where the follower does not reach.
    fn inclination(&self, place: FollowerPlacement, choice: f64, prime_radius: f64) -> Option<f64> {
        let follower = place.follower(choice).sized(prime_radius)?;
        let top = size::largest_lift_in_reach(&*self.motion, &*follower);
        let curves = Curves { motion: &*self.motion, follower: &*follower };
        let worst = || extremes::pressure_angles(curves).into_iter().zip(self.machine.limits.pressure_angles());
        (top <= follower.reach().1)
            .then(|| worst().map(|(angle, limit)| angle.value / limit).fold(f64::NEG_INFINITY, f64::max))
    }

    /// Why a cam with its follower in its place is not smaller than the smallest; `None` where none passes.
    #[must_use]
    pub fn binding(&self) -> Option<Binding> {
        let offset = self.follower.element().offset();
        let below = self.smallest_prime_radius()? * (1.0 - JUST_BELOW) - offset;
        let Some(smaller) = self.on(below) else { return Some(Binding { limit: "reach", at: None }) };
        // The radius that is kept under a face without a given limit is not the limit of a check.
        let sharp = || smaller.least_rolled_radius().value < self.required().convex_radius * (1.0 - LARGER);
        let own = smaller.broken_itself();
        if let (None, Some(limit)) = (own, smaller.broken_by_rest()) {
            return Some(Binding { limit, at: None });
        }
        let limit = own.unwrap_or_else(|| if sharp() { "min_convex_radius" } else { "bore" });
        let at = match limit {
            "pressure_angle" | "pressure_angle_return" => Some(smaller.most_inclined()),
            "undercut" | "min_convex_pitch_radius_over_roller" | "min_convex_radius" => {
                Some(smaller.least_rolled_radius())
            }
            "contact_stress" => smaller.contact_stress(),
            "cutter_radius" => smaller.min_concave_radius(),
            _ => None,
        };
        Some(Binding { limit, at })
    }

    /// The place of its largest pressure angle over its limit.
    fn most_inclined(&self) -> Worst {
        let [rising, falling] = self.pressure_angles();
        let [of_rising, of_falling] = self.machine.limits.pressure_angles();
        if falling.value / of_falling > rising.value / of_rising { falling } else { rising }
    }

    /// The chosen position of its follower, where it was to be chosen.
    #[must_use]
    pub fn placed(&self) -> Option<FollowerChoice> {
        self.placed
    }

    /// Its follower.
    #[must_use]
    pub fn follower(&self) -> &Arc<dyn Follower> {
        &self.follower
    }
}

/// The better of the two half millimetres about a choice; `None` where neither passes.
fn better(place: FollowerPlacement, best: f64, value: impl Fn(f64) -> Option<f64>) -> Option<f64> {
    let steps = (best / CHOICE_STEP).floor();
    let least = if matches!(place, FollowerPlacement::Pivot { .. }) { 0.0 } else { f64::NEG_INFINITY };
    let both = [steps, steps + 1.0].map(|steps| steps * CHOICE_STEP + 0.0);
    let passing = both.into_iter().filter(|choice| *choice > least);
    let valued = passing.filter_map(|choice| Some((choice, value(choice)?)));
    valued
        .min_by(|a, b| a.1.total_cmp(&b.1).then((a.0 - best).abs().total_cmp(&(b.0 - best).abs())))
        .map(|(choice, _)| choice)
}

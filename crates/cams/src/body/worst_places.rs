//! Worst places of a plane cam, kept once they are found.

use super::plane;
use camgen_kernel::follower::Element;
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::{Curves, Worst, extremes, followed};
use std::sync::OnceLock;

/// A smaller curvature, 1/m, is the rounding of a straight flank: a radius of a thousand kilometres.
pub const STRAIGHT: f64 = 1e-6;

/// Worst places of a plane cam, searched once, on demand.
#[derive(Debug, Clone, Default)]
pub struct WorstPlaces {
    pressure_angles: OnceLock<[Worst; 2]>,
    least_radius: OnceLock<Worst>,
    least_rolled_radius: OnceLock<Worst>,
    largest_rates: OnceLock<[f64; 2]>,
    min_concave_radius: OnceLock<Option<Worst>>,
}

impl WorstPlaces {
    /// The largest pressure angles, where it is positive and where it is negative.
    pub fn pressure_angles(&self, curves: Curves<'_>) -> [Worst; 2] {
        *self.pressure_angles.get_or_init(|| extremes::pressure_angles(curves).map(plane))
    }

    pub(crate) fn largest_rates(&self, motion: &dyn Motion) -> [f64; 2] {
        *self.largest_rates.get_or_init(|| followed::largest_rates(motion))
    }

    /// The smallest concave radius of the profile, where it has one.
    pub fn min_concave_radius(&self, curves: Curves<'_>) -> Option<Worst> {
        *self.min_concave_radius.get_or_init(|| min_concave_radius(curves))
    }

    /// The smallest convex radius of the follower's curve.
    pub fn least_radius(&self, curves: Curves<'_>) -> Worst {
        *self.least_radius.get_or_init(|| least_radius_on(curves, |_| true))
    }

    pub(crate) fn least_rolled_radius(&self, curves: Curves<'_>) -> Worst {
        if curves.motion.is_rolled_throughout() {
            return self.least_radius(curves);
        }
        *self.least_rolled_radius.get_or_init(|| least_radius_on(curves, |piece| curves.motion.is_rolled(piece)))
    }
}

/// Smallest convex radius of what the follower draws on the pieces that are searched, m, as [`Figures::least_radius`](super::Figures::least_radius); a corner stands
/// between two pieces, and counts with either.
fn least_radius_on(curves: Curves<'_>, searched: impl Fn(usize) -> bool) -> Worst {
    let smooth = match curves.element() {
        Element::Roller { .. } => None,
        Element::Face => Some(plane(extremes::least_radius_on(curves, &searched))),
    };
    // A fold is worse than a corner.
    let between = smooth.and_then(|_| extremes::fold(curves)).map(plane);
    let folds = [smooth.filter(|least| least.value < 0.0), between].into_iter().flatten();
    if let Some(folded) = folds.min_by(|a, b| a.value.total_cmp(&b.value)) {
        return folded;
    }
    match extremes::corners(curves).iter().find(|corner| curves.metal_side() * corner.turn > 0.0) {
        Some(corner) => Worst { value: 0.0, at: corner.at, z: 0.0 },
        None => smooth.unwrap_or_else(|| radius_of(plane(extremes::convex_curvature_on(curves, &searched)))),
    }
}

/// The most hollow place of the profile, as [`Figures::min_concave_radius`](super::Figures::min_concave_radius).
pub(crate) fn min_concave_radius(curves: Curves<'_>) -> Option<Worst> {
    // At a concave corner of the pitch curve the profile is an arc of the roller's own radius.
    if let Some(corner) = extremes::corners(curves).into_iter().find(|corner| curves.metal_side() * corner.turn < 0.0) {
        return Some(Worst { value: curves.offset().abs(), at: corner.at, z: 0.0 });
    }
    let smooth = extremes::concave_profile_curvature(curves);
    (smooth.value > STRAIGHT).then(|| Worst { value: 1.0 / smooth.value, at: smooth.at, z: 0.0 })
}

/// The radius of the largest convex curvature; infinite where nothing is convex.
#[must_use]
pub fn radius_of(sharpest: Worst) -> Worst {
    Worst { value: if sharpest.value > 0.0 { 1.0 / sharpest.value } else { f64::INFINITY }, ..sharpest }
}

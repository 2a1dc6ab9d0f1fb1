//! The sharpest convex place: of the profile (undercut) and of the pitch curve (contact stress).

use super::{Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::report::Bound;
use camgen_kernel::follower::Element;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::Text;

/// The check.
pub const UNDERCUT: Check = Check {
    name: "undercut",
    on: CheckScope::Cam,
    unit: "mm",
    about: "How much the smallest convex radius of the pitch curve exceeds the roller's radius. Where it does not, the profile \
            folds over itself: metal that one position of the roller needs is cut away for another, and motion is lost.",
    explained: CheckExplanation {
        bound: Bound::Above,
        formula: "ρ − r, of the pitch curve's radius of curvature ρ where it is convex and the roller's radius r",
        usual: "ρ > r (every textbook on cams, for instance R. L. Norton, Design of Machinery)",
        change: "a smaller roller, a larger `cam.base_radius`, or a smoother law of motion",
    },
};

/// The check.
pub const MIN_CONVEX_RADIUS: Check = Check {
    name: "min_convex_radius",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The smallest convex radius of the pitch curve, or of the profile under a flat face. Customary is two to three times the \
            roller's radius; below, the contact stress rises steeply.",
    explained: CheckExplanation {
        bound: Bound::AtLeast,
        formula: "ρ = (x'² + y'²)^(3/2)/(x'y'' − y'x'') of the pitch curve where it is convex",
        usual: "2 to 3 times the roller's radius (R. L. Norton, Design of Machinery); camgen requires 2",
        change: "a smaller roller, a larger `cam.base_radius`, or another `limits.min_convex_pitch_radius_over_roller` or \
                 `limits.min_convex_radius`",
    },
};

/// Rounding of a radius that was solved to be the limit, as a share of it; what a search over a surface leaves, too.
const ROUNDING: f64 = 1e-9;

/// Measure of the smallest convex radius of what the follower draws, m, over the radius of its roller, m; with the sentences that name the motion
/// which is lost.
#[must_use]
pub fn undercut(least: &Worst, roller: f64, lost: impl FnOnce() -> Vec<Text>, subject: &Subject<'_>) -> Measure {
    let left = least.value - roller;
    let edge = subject.curves.is_some_and(|curves| curves.element() == Element::Roller { radius: 0.0 });
    // A knife edge follows a corner of the profile without losing motion; whether one is wanted `continuity` says.
    if edge && left >= 0.0 {
        let corner = (left == 0.0).then(|| Text::from("a corner, round which a knife edge loses no motion"));
        return UNDERCUT.measure(1e3 * left, Some(0.0)).kept(true).noted(corner).at(subject, least);
    }
    let kept = left > 0.0;
    let note = if kept { None } else { Some(Text::joined(lost().into_iter().chain((subject.remedy)()), "; ")) };
    UNDERCUT.measure(1e3 * left, Some(0.0)).kept(kept).noted(note).at(subject, least)
}

/// Measure of the smallest convex radius where a follower runs; `None` under a face for which no limit is given.
#[must_use]
pub fn min_convex_radius(least: &Worst, roller: Option<f64>, subject: &Subject<'_>) -> Option<Measure> {
    let limits = subject.machine.limits;
    // Under a face the follower's curve is the profile, and only a given radius is a limit.
    let roller = roller.or_else(|| limits.min_convex_radius.map(|_| 0.0))?;
    let limit = limits.convex_radius(roller);
    let kept = least.value >= limit * (1.0 - ROUNDING);
    let note = if kept { None } else { (subject.remedy)() };
    // The profile is sharper than the pitch curve by the radius of the roller.
    let named = (roller > 0.0).then_some("pitch curve radius");
    let measure = Measure { named, ..MIN_CONVEX_RADIUS.measure(1e3 * least.value, Some(1e3 * limit)) };
    Some(measure.kept(kept).noted(note).at(subject, least))
}

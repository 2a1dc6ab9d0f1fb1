//! The sharpest convex place: of the profile (undercut) and of the pitch curve (contact stress).

use super::{Bound, Check, Evidence, Explained, On, at};
use crate::report::{Finding, Verdict};

pub(super) const UNDERCUT: Check = Check {
    name: "undercut",
    on: On::Cam,
    about: "How much the smallest convex radius of the pitch curve exceeds the roller's radius. Where it does not, the profile \
            folds over itself: metal that one position of the roller needs is cut away for another, and motion is lost.",
    explained: Explained {
        bound: Bound::Above,
        formula: "ρ − r, of the pitch curve's radius of curvature ρ where it is convex and the roller's radius r",
        usual: "ρ > r (every textbook on cams, for instance R. L. Norton, Design of Machinery)",
        change: "a smaller roller, a larger `cam.base_radius`, or a smoother law of motion",
    },
    run: undercut,
};

pub(super) const MIN_CONVEX_RADIUS: Check = Check {
    name: "min_convex_radius",
    on: On::Cam,
    about: "The smallest convex radius of the pitch curve, or of the profile under a flat face. Customary is two to three times the \
            roller's radius; below, the contact stress rises steeply.",
    explained: Explained {
        bound: Bound::AtLeast,
        formula: "ρ = (x'² + y'²)^(3/2)/(x'y'' − y'x'') of the pitch curve where it is convex",
        usual: "2 to 3 times the roller's radius (R. L. Norton, Design of Machinery); camgen asks for 2",
        change: "a smaller roller, a larger `cam.base_radius`, or another `limits.min_convex_pitch_radius_over_roller` or \
                 `limits.min_convex_radius`",
    },
    run: min_convex_radius,
};

/// Rounding of a radius that was solved to be the limit, as a share of it; what a search over a surface leaves, too.
const ROUNDING: f64 = 1e-9;

fn undercut(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let least = body.least_radius();
    let left = least.value - body.roller_radius().unwrap_or(0.0);
    let kept = left > 0.0;
    let found = UNDERCUT.found(1e3 * left, Some(0.0), "mm", Verdict::of(kept));
    let lost = || body.lost_motion().into_iter().chain(body.remedy()).collect::<Vec<String>>().join("; ");
    let note = (!kept).then(lost).filter(|words| !words.is_empty());
    Some(at(body, &least, found, note))
}

fn min_convex_radius(evidence: &Evidence<'_>) -> Option<Finding> {
    let body = evidence.body;
    let least = body.least_rolled_radius();
    let limits = body.machine().limits;
    // Under a face the follower's curve is the profile, and only what is asked for is a limit.
    let roller = body.roller_radius().or_else(|| limits.min_convex_radius.map(|_| 0.0))?;
    let limit = limits.convex_radius(roller);
    let kept = least.value >= limit * (1.0 - ROUNDING);
    let found = MIN_CONVEX_RADIUS.found(1e3 * least.value, Some(1e3 * limit), "mm", Verdict::of(kept));
    Some(at(body, &least, found, if kept { None } else { body.remedy() }))
}

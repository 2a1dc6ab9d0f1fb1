//! The metal left between what is cut: profile, bore with keyway and holes, or the two flanks of a plate.

use super::{AsWritten, Check, CheckExplanation, CheckScope, Measure, Subject};
use crate::machine::Machine;
use crate::report::Bound;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::Text;

/// The check.
pub const CHECK: Check = Check {
    name: "wall",
    on: CheckScope::Cam,
    unit: "mm",
    about: "The smallest thickness of metal between what is cut: the profile as written, the bore with its keyway and holes, or between the two flanks \
            of a plate.",
    explained: CheckExplanation {
        bound: Bound::AtLeast,
        formula: "the least distance between the profile and what is cut inside it, and between holes",
        usual: "the larger of 3 mm and 0.15 of the bore's radius (camgen's own rule; the hub of ANSI/ASME B29.1 has 3.2 mm and a sixth of the bore's \
                diameter), and 1 mm about balance holes; `limits.wall` where it is given",
        change: "a larger `cam.base_radius`, a smaller `cam.bore_radius`, or a higher `translating.plate_height`",
    },
};

/// Rounding of a base radius that was sized for this wall must not fail.
const ROUNDING: f64 = 1e-9;
/// Least metal about balance holes where no limit is given, mm.
const ABOUT_HOLES: f64 = 1.0;

/// Measure of the thinnest wall, m, with its place where that is known: of the exact cam, and of what is written where that is known.
#[must_use]
pub fn measure((exact, place): (f64, Option<Worst>), written: &AsWritten<'_>, subject: &Subject<'_>) -> Measure {
    let Machine { limits, cam, .. } = subject.machine;
    let limit = limits.least_wall(cam.bore_radius);
    let within = limit - 1e-3 * written.tolerance_mm;
    let about_holes = limits.wall.map_or(ABOUT_HOLES, |wall| 1e3 * wall);
    let customary = limits.wall.is_none().then(|| Text::from("the customary limit"));
    if let Some(holes) = written.walls.about_holes.filter(|wall| wall.distance < about_holes - written.tolerance_mm) {
        let note = Text::from(if subject.machine.holes.is_empty() {
            "about a balance hole; a narrower cam.balance leaves more"
        } else {
            "about a hole; another circle or angle in cam.holes, a smaller diameter, or a narrower cam.balance leaves more"
        });
        return CHECK.measure(holes.distance, Some(about_holes)).kept(false).noted(note).placed(holes.place);
    }
    // Of a cam whose sections differ the thinnest place may lie between those that are written.
    let as_cut = written.walls.about_bore.filter(|wall| subject.curves.is_some() || wall.distance < 1e3 * exact);
    let wall = as_cut.map_or(exact, |wall| 1e-3 * wall.distance);
    let by_size = exact > 0.0 && exact >= limit * (1.0 - ROUNDING);
    let kept = by_size && wall > 0.0 && wall >= within;
    let remedy = if kept { None } else { (subject.remedy)() };
    let cut = (by_size && !kept)
        .then(|| Text::from("the outline as written comes nearer than the exact profile: a finer --tolerance"));
    let note = Text::joined(customary.into_iter().chain(cut.or(remedy)), "; ");
    let measure = CHECK.measure(1e3 * wall, Some(1e3 * limit)).kept(kept);
    let measure = measure.noted(note);
    match (as_cut, place) {
        (Some(wall), _) => measure.placed(wall.place),
        (None, Some(worst)) => measure.at(subject, &worst),
        (None, None) => measure,
    }
}

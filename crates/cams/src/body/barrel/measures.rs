//! What is checked of a barrel as it was solved.

use super::Barrel;
use crate::body::{Body, in_groove};
use crate::check::continuity::RunMotion;
use crate::check::{
    Check, CheckExplanation, CheckScope, Measures, Subject, continuity, curvature, cutter_radius, pressure_angle, size,
    wall,
};
use crate::report::{Bound, Place, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::Worst;

/// The check.
pub const PLANE_OFFSET: Check = Check {
    name: "plane_offset_error",
    on: CheckScope::Cam,
    unit: "mm",
    about: "How far the exact flanks of a barrel are from the offset of its unrolled centre line, which drawings customarily show: on the cylinder of the outside \
            and on that of the floor. Reported only.",
    explained: CheckExplanation {
        bound: Bound::AtMost,
        formula: "max |distance of the flank from the unrolled centre line − radius of the flank| on a cylinder",
        usual: "no limit: the drawings of camgen have the exact flanks",
        change: "nothing: a larger `cam.outer_radius` makes it smaller",
    },
};

impl Barrel {
    /// A change of the outer radius with which every limit is kept.
    fn remedy(&self) -> Option<String> {
        let outer = self.smallest_outer().ok()?;
        (outer > self.outer)
            .then(|| format!("cam.outer_radius = \"{} mm\" keeps every limit", shown(MILLIMETRES * outer)))
    }

    /// Least metal: about the bore, and between the groove and the ends, m.
    pub(super) fn wall(&self) -> f64 {
        let bore = self.machine.cam.bore_reach().map_or(f64::INFINITY, |bore| self.floor() - bore);
        let heights = |sign: f64| self.largest(|jet| sign * self.path.at(jet).along[0]).value;
        let above = self.ends.1 - heights(1.0) - self.distances[0];
        let below = -self.ends.0 - heights(-1.0) - self.distances[1];
        bore.min(above).min(below)
    }

    pub(super) fn take_measures(&self, of: &mut Measures<'_>) {
        let at = |worst: &Worst| -> (Place, Option<String>) { (self.place(worst.at), None) };
        let remedy = || self.remedy();
        let subject = Subject { machine: &self.machine, curves: None, speed: self.speed(), at: &at, remedy: &remedy };
        let run = || [RunMotion { motion: &*self.motion, z: 0.0, speed: self.speed() }];
        of.add(&continuity::CHECK, |_| continuity::measure(&run(), || None, &subject));
        of.add(&pressure_angle::CHECK, |_| pressure_angle::measure(self.signed_pressure_angles(), &subject));
        let widest = self.distances[0].max(self.distances[1]);
        of.add(&curvature::UNDERCUT, |_| curvature::undercut(&self.least_fold(), widest, Vec::new, &subject));
        of.add(&curvature::MIN_CONVEX_RADIUS, |_| {
            curvature::min_convex_radius(&self.least_radius(), Some(self.roller), &subject)
        });
        let half = 0.5 * self.distances.iter().sum::<f64>();
        let widest_cutter = Worst { value: half, at: 0.0, z: 0.0 };
        of.add(&cutter_radius::CHECK, |_| cutter_radius::measure(Some(widest_cutter), Some(half), &subject));
        of.add(&wall::CHECK, |written| wall::measure((self.wall(), None), written, &subject));
        let longest = MILLIMETRES * (2.0 * self.outer).max(self.ends.1 - self.ends.0);
        of.add(&size::CHECK, |_| size::CHECK.measure(longest, Some(MILLIMETRES * self.machine.limits.largest_size())));
        in_groove::measured(self, of, &subject);
        of.add(&PLANE_OFFSET, |_| {
            let [outside, floor] = [self.outer, self.floor()].map(|radius| self.offset_error(radius));
            let radial = self.radial_error(self.floor());
            let note = format!(
                "on the outside {} mm, on the floor {} mm; walls drawn radially from the outside would miss by {} mm there",
                shown(MILLIMETRES * outside.value),
                shown(MILLIMETRES * floor.value),
                shown(MILLIMETRES * radial.value)
            );
            let worst = if floor.value > outside.value { floor } else { outside };
            PLANE_OFFSET.measure(MILLIMETRES * worst.value, None).noted(note).at(&subject, &worst)
        });
    }
}

//! What is checked of a barrel as it was solved.

use super::{Barrel, BarrelRoller};
use crate::body::swept::SweptMeasures;
use crate::check::{Check, CheckExplanation, CheckScope, Measures, Subject, curvature};
use crate::report::{Bound, shown};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{KeyChange, Length, Remedy, Text, text};

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

impl<R: BarrelRoller> SweptMeasures for Barrel<R> {
    /// A change of the outer radius with which every limit is kept.
    fn remedy(&self) -> Option<Text> {
        let outer = self.smallest_outer().ok()?;
        (outer > self.outer)
            .then(|| KeyChange::new("cam.outer_radius", format!("{} mm", shown(MILLIMETRES * outer))))
            .map(|change| text!("{} keeps every limit", Remedy::new([change])))
    }

    /// Least metal: about the bore, and between the groove and the ends, m.
    fn wall(&self) -> (f64, Option<Worst>) {
        let bore = self.groove.machine.cam.bore_reach().map_or(f64::INFINITY, |bore| self.floor() - bore);
        let ([top, bottom], [up, down]) = (self.roller_heights(), self.groove.distances);
        let (above, below) = (self.ends.1 - top - up, -self.ends.0 - bottom - down);
        (bore.min(above).min(below), None)
    }

    fn longest(&self) -> f64 {
        (2.0 * self.outer).max(self.ends.1 - self.ends.0)
    }

    fn measure(&self, of: &mut Measures<'_>, subject: &Subject<'_>) {
        of.add(&curvature::MIN_CONVEX_RADIUS, |_| {
            curvature::min_convex_radius(&self.least_radius(), Some(self.groove.roller), subject)
        });
        of.add(&PLANE_OFFSET, |_| {
            let [outside, floor] = [self.outer, self.floor()].map(|radius| self.offset_error(radius));
            let radial = self.radial_error(self.floor());
            let note = text!(
                "on the outside {}, on the floor {}; walls drawn radially from the outside would miss by {} there",
                Length::mm(MILLIMETRES * outside.value),
                Length::mm(MILLIMETRES * floor.value),
                Length::mm(MILLIMETRES * radial.value)
            );
            let worst = if floor.value > outside.value { floor } else { outside };
            PLANE_OFFSET.measure(MILLIMETRES * worst.value, None).noted(note).at(subject, &worst)
        });
    }
}

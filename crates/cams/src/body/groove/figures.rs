//! The figures of a groove or a ring that checks judge: those of the disc under the same roller, and those of the outer flank.

use super::{Groove, RING};
use crate::body::disc::delegate::figures_of_its_disc;
use crate::body::{Body, Figures, flank_switch, stress};
use crate::check::{Measures, Subject, curvature};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::{Contact, Worst};
use camgen_kernel::text::Text;

impl Figures for Groove {
    figures_of_its_disc!(disc, sized: disc);

    fn pressure_angles(&self) -> [Worst; 2] {
        self.disc.pressure_angles()
    }

    fn least_radius(&self) -> Worst {
        self.disc.least_radius()
    }

    fn least_rolled_radius(&self) -> Worst {
        self.disc.least_rolled_radius()
    }

    /// Of all flanks, and no wider than the groove.
    fn min_concave_radius(&self) -> Option<Worst> {
        let flanks = self.flanks.iter();
        let hollow = flanks.filter_map(|flank| flank.worst.min_concave_radius(self.curves_of(flank)));
        let half = self.width().map(|width| Worst { value: 0.5 * width, at: 0.0, z: 0.0 });
        hollow.chain(half).min_by(|a, b| a.value.total_cmp(&b.value))
    }

    /// About the bore, and outside of the outer flank.
    fn wall(&self) -> Option<(f64, Option<Worst>)> {
        let outside = (self.blank_radius - self.reach(), None);
        let about_bore = self.disc.wall().filter(|(wall, _)| *wall < outside.0);
        Some(about_bore.unwrap_or(outside))
    }

    /// Of a groove on whichever flank the roller is.
    fn contact_stress(&self) -> Option<Worst> {
        if *self.kind == RING {
            return self.disc.contact_stress();
        }
        let crown = self.machine().follower.crown_radius;
        let of = |(flank, sign): (usize, f64)| {
            // Both flanks have the path and the pressure angle of the roller.
            let force = move |at: (usize, f64), contact: &Contact| {
                self.disc.signed_normal_force(at, contact).map(|force| (sign * force).max(0.0))
            };
            stress::largest(&force, (self.curves(flank)?, &self.disc.acting()), self.machine(), crown)
        };
        [(0, 1.0), (1, -1.0)].into_iter().filter_map(of).reduce(Worst::or_larger)
    }

    fn blank_width(&self) -> f64 {
        2.0 * MILLIMETRES * self.blank_radius
    }

    fn is_form_closed(&self) -> bool {
        *self.kind != RING
    }
}

impl Groove {
    /// The measures that only a groove has: of its outer flank, and where the force changes flank.
    pub(super) fn measured_outside(&self, of: &mut Measures<'_>, subject: &Subject<'_>) {
        let (Some((curves, worst)), true) = (self.outer(), self.flanks.len() > 1) else { return };
        let (least, radius) = (worst.least_radius(curves), curves.offset().abs());
        of.add(&curvature::UNDERCUT, |_| {
            let measure = curvature::undercut(&least, radius, Vec::new, subject);
            let note = Text::from("the outer flank").and("; ", measure.note.clone().unwrap_or_default());
            measure.noted(note)
        });
        of.add(&flank_switch::CHECK, |_| flank_switch::measure(self.flank_switches(), subject));
    }
}

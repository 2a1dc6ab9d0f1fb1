//! The figures of a rib that checks judge: the worse of its two flanks.

use super::Rib;
use crate::body::disc::delegate::figures_of_its_disc;
use crate::body::{Figures, largest};
use crate::check::{Measures, Subject, curvature};
use camgen_kernel::profile::Worst;
use camgen_kernel::text::Text;

impl Figures for Rib {
    figures_of_its_disc!(outer, sized: middle);

    fn pressure_angles(&self) -> [Worst; 2] {
        let ([a, b], [c, d]) = (self.outer.pressure_angles(), self.inner.pressure_angles());
        [a.or_larger(c), b.or_larger(d)]
    }

    fn least_radius(&self) -> Worst {
        self.outer.least_radius()
    }

    fn least_rolled_radius(&self) -> Worst {
        self.outer.least_rolled_radius()
    }

    fn min_concave_radius(&self) -> Option<Worst> {
        let hollow = self.outer.min_concave_radius().into_iter().chain(self.inner.min_concave_radius());
        hollow.min_by(|a, b| a.value.total_cmp(&b.value))
    }

    fn wall(&self) -> Option<(f64, Option<Worst>)> {
        let thinnest = largest(self.outer.curves(), |piece, at| -self.thickness(piece, at));
        Some((-thinnest.value, Some(Worst { value: -thinnest.value, ..thinnest })))
    }

    /// Of the outer roller where the force presses it on, of the inner one where it would lift it off.
    fn contact_stress(&self) -> Option<Worst> {
        let found = self.outer.contact_stress().into_iter().chain(self.inner.contact_stress());
        found.reduce(Worst::or_larger)
    }

    fn is_form_closed(&self) -> bool {
        true
    }
}

/// Steps to the foot of a point on the other flank.
const FOOT_STEPS: u32 = 8;

impl Rib {
    /// Distance of a point of the outer flank from the inner one, m: by Newton's method from the place where the inner roller is at that angle.
    fn thickness(&self, piece: usize, at: f64) -> f64 {
        let (outer, inner) = (self.outer.curves(), self.inner.curves());
        let from = outer.profile(piece, at).point;
        let (mut angle, mut least) = (at, f64::INFINITY);
        for _ in 0..FOOT_STEPS {
            let (piece, inside) = inner.motion.locate(angle);
            let foot = inner.profile(piece, inside);
            let gap = from - foot.point;
            least = least.min(gap.norm());
            let bend = 1.0 + foot.curvature * gap.dot(&foot.outward());
            angle += gap.dot(&foot.tangent) / (foot.speed * bend);
        }
        least
    }

    /// The measures of the flank under the inner roller.
    pub(super) fn measured_inside(&self, of: &mut Measures<'_>, subject: &Subject<'_>) {
        let least = self.inner.least_radius();
        let radius = self.inner.curves().offset().abs();
        of.add(&curvature::UNDERCUT, |_| {
            let measure = curvature::undercut(&least, radius, Vec::new, subject);
            let note = Text::from("the inner flank").and("; ", measure.note.clone().unwrap_or_default());
            measure.noted(note)
        });
    }
}

//! What would keep the contact stress of a disc below its limit.

use super::Disc;
use crate::body::Figures;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::text::{KeyChange, Remedy};

/// A base radius so many times as large is looked at to lower a stress.
const LARGEST_GROWTH: f64 = 4.0;

impl Disc {
    /// A thickness, and a base radius, that keep a limit of the contact stress.
    pub(super) fn keeping_stress(&self, largest: f64, limit: f64) -> Vec<Remedy> {
        // Under a crown the thickness does not matter.
        let straight = self.program_follower.crown_radius.is_none();
        let thickness = straight.then(|| crate::body::stress::length_for(&self.machine, largest, limit)).flatten();
        // A counter disc has no base radius of its own; a yoke gets it from its breadth.
        let free = self.main.is_none() && self.machine.cam.track.breadth.is_none();
        let sized = free.then(|| self.base_for_stress(limit)).flatten();
        let base = sized.map(|base| Remedy::new([KeyChange::new("cam.base_radius", format!("{base} mm"))]));
        thickness.into_iter().chain(base).collect()
    }

    /// The smallest larger base radius, in whole mm, with which the disc keeps a limit of the contact stress and the rest of its body every limit.
    fn base_for_stress(&self, limit: f64) -> Option<f64> {
        let keeps = |base_mm: f64| {
            let follower = self.follower.sized(base_mm / MILLIMETRES + self.curves().offset())?;
            let grown = Self { follower: follower.into(), worst: crate::body::WorstPlaces::default(), ..self.clone() };
            let kept = grown.contact_stress()?.value <= limit;
            Some(kept && grown.broken_by_rest().is_none())
        };
        let mut failing = (MILLIMETRES * self.base_radius()).floor();
        let mut passing = (LARGEST_GROWTH * MILLIMETRES * self.base_radius()).ceil();
        if !keeps(passing)? {
            return None;
        }
        while passing - failing > 1.0 {
            let middle = (0.5 * (failing + passing)).floor();
            *(if keeps(middle) == Some(true) { &mut passing } else { &mut failing }) = middle;
        }
        Some(passing)
    }
}

//! What would keep the contact stress of a disc below its limit.

use super::Disc;
use crate::body::Figures;
use crate::geometry::MILLIMETRES;

/// A base radius so many times as large is looked at to lower a stress.
const LARGEST_GROWTH: f64 = 4.0;

impl Disc {
    /// A thickness, and a base radius, that keep a limit of the contact stress.
    pub(super) fn keeping_stress(&self, largest: f64, limit: f64) -> Vec<String> {
        // Under a crown the thickness does not matter.
        let straight = self.program_follower.crown_radius.is_none();
        let thickness = straight.then(|| crate::body::stress::thickness_for(&self.machine, largest, limit)).flatten();
        let base = self.base_for_stress(limit).map(|base| format!("cam.base_radius = \"{base} mm\""));
        thickness.into_iter().chain(base).collect()
    }

    /// The smallest base radius above this one, in whole millimetres, that keeps a limit of the contact stress, mm.
    fn base_for_stress(&self, limit: f64) -> Option<f64> {
        let keeps = |base_mm: f64| {
            let follower = self.follower.sized(base_mm / MILLIMETRES + self.curves().offset())?;
            let grown = Self { follower: follower.into(), worst: crate::body::WorstPlaces::default(), ..self.clone() };
            grown.contact_stress().map(|worst| worst.value <= limit)
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

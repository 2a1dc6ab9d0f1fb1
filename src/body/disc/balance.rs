//! What the verdicts on a disc cam of a press rest on: air, run-up, what may be missed, and what would keep a stress.

use super::Disc;
use crate::body::balance::{AsCut, allowed_error, fitting_speed};
use crate::geometry::MILLIMETRES;
use crate::load::RunUp;
use crate::numeric::digits::three_digits_down;
use crate::profile::Worst;

/// Largest pressure angle at which an error along the normal is still told along the path, rad.
const STEEPEST: f64 = 1.4;
/// A base radius so many times as large is looked at to lower a stress.
const LARGEST_GROWTH: f64 = 4.0;

impl Disc {
    /// Where the bottom stays off the piston: as [`crate::body::Body::as_cut`].
    pub(super) fn fitting(&self, tolerance: f64) -> Option<AsCut> {
        let (load, press) = (self.load.as_ref()?, self.machine.press().ok()?);
        let cylinder = press.cylinder();
        let allowed = |rpm: f64| allowed_error(&cylinder, &press.bottom_law(rpm));
        // Along the path an error is larger than along the normal.
        let lean = crate::body::Body::pressure_angle(self).value;
        let lean = self.machine.limits.pressure_angle.map_or(lean, |limit| lean.max(limit)).min(STEEPEST);
        let per_tolerance = 1.0 / (self.machine.cam.lever * libm::cos(lean));
        let rpm = self.rpm?;
        load.least_air()?;
        Some(AsCut {
            speed: fitting_speed(allowed, rpm, tolerance * per_tolerance),
            tolerance: 1e-6 * three_digits_down(1e6 * allowed(rpm) / per_tolerance),
        })
    }

    /// The run-up of the press's motion.
    pub(super) fn ramp(&self) -> Option<RunUp> {
        self.load.as_ref()?.run_up()
    }

    /// A thickness, and a base radius, that keep a limit of the contact stress.
    pub(super) fn keeping_stress(&self, largest: f64, limit: f64) -> Vec<String> {
        // Under a crown the thickness does not matter.
        let straight = self.own.crown_radius.is_none();
        let thickness = straight.then(|| super::stress::thickness_for(&self.machine, largest, limit)).flatten();
        let base = self.base_for_stress(limit).map(|base| format!("cam.base_radius = \"{base} mm\""));
        thickness.into_iter().chain(base).collect()
    }

    /// The smallest base radius above this one, in whole millimetres, that keeps a limit of the contact stress, mm.
    fn base_for_stress(&self, limit: f64) -> Option<f64> {
        let keeps = |base_mm: f64| {
            let follower = self.follower.sized(base_mm / MILLIMETRES + self.curves().offset())?;
            let grown = Self { follower: follower.into(), worst: crate::body::WorstPlaces::default(), ..self.clone() };
            crate::body::Body::contact_stress(&grown).map(|worst| worst.value <= limit)
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

    /// Least air: as [`crate::body::Body::least_air`].
    pub(super) fn air(&self) -> Option<Worst> {
        self.load.as_ref()?.least_air()
    }
}

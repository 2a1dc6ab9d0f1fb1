//! What the verdicts on a conoid rest on: the force balance over all its speeds, air, run-up, and a roller for a stress.

use super::between::{self, Residual};
use super::{Conoid, bottom_law_at};
use crate::press::load::{AirBuffer, Balance, RunUp};
use camgen_cams::body::Figures;
use camgen_kernel::follower::TranslatingRoller;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{KeyChange, Remedy};
use std::sync::Arc;

/// Trial rollers / given roller, to lower a stress.
const LARGER_ROLLERS: [f64; 5] = [1.1, 1.25, 1.5, 2.0, 3.0];

impl Conoid {
    /// The inertia of the fastest section, and the residual without a cam at the speed with the largest residual of the cam.
    pub(super) fn forces_balanced(&self) -> Balance {
        let law = bottom_law_at(&self.press, &self.data, self.largest_residual().rpm);
        let fastest = self.speeds.last().copied().unwrap_or(0.0);
        let without_cam = self.cylinder.residual_fixed_bottom(&law);
        Balance { inertia: self.press.largest_inertia(fastest), without_cam, mean: false }
    }

    /// Least air: of the sections, and of the speed between them at which the forces balance worst.
    pub(super) fn air(&self) -> Worst {
        let speeds = self.speeds.iter().copied().chain([self.largest_residual().rpm]);
        let mut least = Worst::NONE;
        for rpm in speeds {
            let (air, at) = between::air_at(self, rpm);
            least = least.or_larger(Worst { value: -air, at, z: self.position(rpm) });
        }
        Worst { value: -least.value, ..least }
    }

    /// The longest run-up of the sections.
    pub(super) fn ramp(&self) -> Option<RunUp> {
        let sections = self.sections.iter().map(|section| AirBuffer::new(self.cylinder, Arc::new(section.clone())));
        let ramps = sections.filter_map(|section| section.run_up());
        ramps.reduce(|best, next| if next.travel > best.travel { next } else { best })
    }

    /// The most that is left at any speed: between the sections, or of a single one.
    pub(super) fn largest_residual(&self) -> Residual {
        let between = self.residual_between();
        if self.speeds.first() == self.speeds.last() { between::at_sections(self) } else { between }
    }

    /// A larger roller that lowers a contact stress to a limit, as a key of the machine file; the cam is solved for it.
    pub(super) fn roller_for_stress(&self, stress: f64, limit: f64) -> Option<Remedy> {
        // By Hertz a pressure of spheres falls with the power 2/3 of their radii: smaller rollers are not tried.
        LARGER_ROLLERS
            .into_iter()
            .filter(|factor| factor * factor * limit.powi(3) >= stress.powi(3))
            .map(|factor| (factor * MILLIMETRES * self.roller.radius).ceil())
            .find(|radius| self.stress_with_roller(radius / MILLIMETRES).is_some_and(|stress| stress.value <= limit))
            .map(|radius| Remedy::new([KeyChange::new("follower.roller.radius", format!("{radius} mm"))]))
    }

    /// The contact stress of the cam solved for a roller of another radius, m.
    fn stress_with_roller(&self, radius: f64) -> Option<Worst> {
        let speeds: Vec<f64> = self.sections_cut().iter().map(|cut| cut.rpm).collect();
        let mut machine = (*self.machine).clone();
        if let Some(roller) = &mut machine.follower.roller {
            roller.radius = radius;
            machine.follower.shape = Arc::new(TranslatingRoller::new(1.0 + roller.offset.abs(), roller.offset, radius));
        }
        Conoid::solve(&machine, &speeds).ok()?.contact_stress()
    }
}

//! The figures of a plate that checks judge.

use super::Wedge;
use crate::body::{Figures, stress};
use crate::check::contact_stress::ContactKind;
use camgen_kernel::motion::Motion;
use camgen_kernel::profile::{Contact, Worst};
use camgen_kernel::text::{Remedy, Text};

impl Figures for Wedge {
    fn pressure_angles(&self) -> [Worst; 2] {
        self.worst.pressure_angles(self.curves())
    }

    fn least_radius(&self) -> Worst {
        self.worst.least_radius(self.curves())
    }

    fn least_rolled_radius(&self) -> Worst {
        self.worst.least_rolled_radius(self.curves())
    }

    fn min_concave_radius(&self) -> Option<Worst> {
        self.worst.min_concave_radius(self.curves())
    }

    fn roller_radius(&self) -> Option<f64> {
        self.curves().roller_radius()
    }

    /// Between flank and back.
    fn wall(&self) -> Option<(f64, Option<Worst>)> {
        let (thinnest, at) = self.thinnest;
        Some((thinnest, Some(Worst { value: thinnest, at, z: 0.0 })))
    }

    /// Of the forces at rest.
    fn contact_stress(&self) -> Option<Worst> {
        let force = |_: (usize, f64), contact: &Contact| {
            Some((self.pressing(contact.lift.s)? / libm::cos(contact.pressure_angle)).max(0.0))
        };
        stress::largest(&force, (self.curves(), &[]), &self.machine, self.machine.follower.crown_radius)
    }

    fn touching(&self) -> ContactKind {
        if self.machine.follower.crown_radius.is_some() { ContactKind::Crown } else { ContactKind::Line }
    }

    fn stress_remedies(&self, largest: f64, limit: f64) -> Vec<Remedy> {
        let along_a_line = self.machine.follower.crown_radius.is_none();
        along_a_line.then(|| stress::length_for(&self.machine, largest, limit)).flatten().into_iter().collect()
    }

    fn largest_lifting_force(&self) -> Worst {
        self.largest(|piece, x| self.pressing(self.motion.jet(piece, x).s).map_or(f64::NAN, |force| -force))
    }

    fn least_closing_force(&self) -> Option<Worst> {
        self.pressing(0.0)?;
        let least = self.largest_lifting_force();
        Some(Worst { value: -least.value, ..least })
    }

    fn remedy(&self) -> Option<Text> {
        self.longer_stroke()
    }
}

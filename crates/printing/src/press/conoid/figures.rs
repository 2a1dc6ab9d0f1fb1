//! The figures of a conoid that checks judge.

use super::{Conoid, bottom_law_at};
use crate::press::load::{Balance, ColumnAtSpeed, ForceBalanced, RunUp};
use crate::press::smoother::smoother;
use camgen_cams::body::{Figures, STRAIGHT, broken_limit, no_radius, passing, radius_of, stress};
use camgen_cams::check::contact_stress::ContactKind;
use camgen_cams::check::continuity::RunMotion;
use camgen_kernel::profile::size::rounded_up;
use camgen_kernel::profile::{Worst, extremes};
use camgen_kernel::text::{Remedy, Text};

impl Figures for Conoid {
    /// The angle between the roller's path and the normal of the section, over every position of the roller.
    fn pressure_angles(&self) -> [Worst; 2] {
        let largest = self.worst(|conoid, place| {
            let (height, slope) = conoid.height_and_slope(&place.partials);
            libm::atan2(slope, height).abs()
        });
        [largest, Worst::NONE]
    }

    /// By the principal curvatures of the pitch surface.
    fn least_radius(&self) -> Worst {
        for z in &self.positions {
            let corners = extremes::corners(self.plane_of(&self.slice(*z)));
            if let Some(corner) = corners.iter().find(|corner| corner.turn > 0.0) {
                return Worst { value: 0.0, at: corner.at, z: *z };
            }
        }
        radius_of(self.sharpest_smooth())
    }

    /// The largest ball that fits into the concave parts of the cam's surface.
    fn min_concave_radius(&self) -> Option<Worst> {
        let min_concave_radius = self.worst_of_metal(|conoid, partials| -conoid.curvatures_of(partials).1);
        (min_concave_radius.value > STRAIGHT)
            .then(|| Worst { value: 1.0 / min_concave_radius.value + self.roller.radius, ..min_concave_radius })
    }

    fn roller_radius(&self) -> Option<f64> {
        Some(self.roller.radius)
    }

    /// Of every section.
    fn run_motions(&self) -> Vec<RunMotion<'_>> {
        self.all_sections()
            .map(|cut| RunMotion {
                motion: cut.section,
                z: cut.z,
                speed: Some(self.press.bed.crank_speed(cut.rpm) / f64::from(self.lobes.max(1))),
            })
            .collect()
    }

    /// Metal between the bore and the nearest point of the surface.
    fn wall(&self) -> Option<(f64, Option<Worst>)> {
        let bore = self.machine.cam.bore_reach()?;
        let nearest = self.smallest_radius();
        Some((nearest.value - bore, Some(nearest)))
    }

    /// Largest pressure of the sphere of the roller on the surface, at the speed of each section.
    fn contact_stress(&self) -> Option<Worst> {
        let material = self.machine.cam.material?.class;
        let radius = self.roller.radius;
        // The cube of the pressure is smooth where the force vanishes.
        let cubed = self.worst_of_sections(|cut, piece, angle| {
            let contact = self.contact(piece, angle, cut.z);
            let path = contact.normal.x * libm::cos(angle) + contact.normal.y * libm::sin(angle);
            let force = self.path_force(cut.section, cut.rpm, piece, angle).max(0.0) / path;
            // The cam's own surface lies a roller's radius inside the pitch surface.
            let (first, second) = self.principal_curvatures(piece, angle, cut.z);
            let [first, second] = [first, second].map(|curvature| curvature / (1.0 - curvature * radius));
            let stress = stress::of_sphere(force, radius, (first, second), material);
            stress * stress * stress
        });
        Some(Worst { value: libm::cbrt(cubed.value), ..cubed })
    }

    fn largest_lifting_force(&self) -> Worst {
        self.worst_of_sections(|cut, piece, angle| -self.path_force(cut.section, cut.rpm, piece, angle))
    }

    fn touching(&self) -> ContactKind {
        ContactKind::Sphere
    }

    fn stress_remedies(&self, stress: f64, limit: f64) -> Vec<Remedy> {
        self.roller_for_stress(stress, limit).into_iter().collect()
    }

    fn smoother(&self) -> Option<Text> {
        smoother(&self.machine, |press| self.speeds.iter().map(|rpm| bottom_law_at(press, &self.data, *rpm)).collect())
    }

    fn remedy(&self) -> Option<Text> {
        let base = rounded_up(self.smallest_prime_radius? - self.roller.radius);
        let mut other = self.clone();
        other.resize(base + self.roller.radius);
        Some(if broken_limit(&other).is_none() { passing(base) } else { no_radius(None, false).into() })
    }
}

impl ForceBalanced for Conoid {
    fn balance(&self) -> Balance {
        self.forces_balanced()
    }

    fn residual_of_motion(&self) -> Worst {
        let left = self.largest_residual();
        Worst { value: left.force, at: left.angle, z: self.position(left.rpm) }
    }

    fn least_air(&self) -> Option<Worst> {
        Some(self.air())
    }

    fn columns(&self) -> Vec<ColumnAtSpeed> {
        self.all_sections()
            .map(|cut| ColumnAtSpeed { length: cut.section.law().bottom_law.column(), rpm: cut.rpm })
            .collect()
    }

    fn run_up(&self) -> Option<RunUp> {
        self.ramp()
    }
}

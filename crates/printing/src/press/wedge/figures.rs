//! The figures of a plate that checks judge, and its load as an outline shows it.

use super::Wedge;
use crate::press::load::{Balance, ColumnAtSpeed, ForceBalanced, RunUp};
use crate::press::motion::equation_18::ExactOn;
use camgen_cams::body::{Figures, LoadAsCut, stress};
use camgen_kernel::profile::Worst;
use camgen_kernel::text::{Remedy, Text};
use nalgebra::Vector2;

impl Figures for Wedge {
    fn pressure_angles(&self) -> [Worst; 2] {
        self.worst.pressure_angles(self.curves())
    }

    fn least_radius(&self) -> Worst {
        self.worst.least_radius(self.curves())
    }

    fn min_concave_radius(&self) -> Option<Worst> {
        self.worst.min_concave_radius(self.curves())
    }

    fn roller_radius(&self) -> Option<f64> {
        self.curves().roller_radius()
    }

    fn wall(&self) -> Option<(f64, Option<Worst>)> {
        Some((self.thinnest, None))
    }

    fn contact_stress(&self) -> Option<Worst> {
        stress::largest(
            &|(piece, x), _| Some(self.normal_force(piece, x)),
            (self.curves(), &self.acting()),
            &self.machine,
            None,
        )
    }

    fn stress_remedies(&self, largest: f64, limit: f64) -> Vec<Remedy> {
        stress::length_for(&self.machine, largest, limit).into_iter().collect()
    }

    fn largest_lifting_force(&self) -> Worst {
        self.largest_force(|piece, x| -self.path_force(piece, x))
    }
}

impl ForceBalanced for Wedge {
    fn balance(&self) -> Balance {
        let mean = self.mechanism().exact_on == ExactOn::Mean;
        Balance { inertia: self.inertia_max(), without_cam: self.residual_fixed_bottom(), mean }
    }

    fn residual_of_motion(&self) -> Worst {
        let residuals = self.balanced_directions().iter().map(|way| self.residual_max(*way));
        residuals.fold(Worst::NONE, Worst::or_larger)
    }

    fn residual_of_other_direction(&self) -> Option<Worst> {
        self.other_direction().map(|way| self.residual_max(way))
    }

    fn remedies_of_other_way(&self) -> Vec<Remedy> {
        self.worth_while()
    }

    fn remedy_of_mean(&self) -> Option<Text> {
        self.longer_column()
    }

    fn least_air(&self) -> Option<Worst> {
        Some(self.air())
    }

    fn columns(&self) -> Vec<ColumnAtSpeed> {
        vec![ColumnAtSpeed { length: self.mechanism().bottom_law.column(), rpm: self.rpm }]
    }

    fn run_up(&self) -> Option<RunUp> {
        self.ramp()
    }
}

impl LoadAsCut for Wedge {
    /// In the directions in which the forces are to balance. The roller moves on its arm l1, the bottom on l2; the slope is
    /// taken from the flank at the contact, dΔx/dx = C σ with tan α of the normal.
    fn unbalanced(&self, (piece, x): (usize, f64), moved: f64, normal: Vector2<f64>) -> f64 {
        if x < 0.0 {
            return 0.0;
        }
        let law = self.motion.bottom(piece, x);
        let mechanism = self.mechanism();
        let sine = law.s / self.data.bottom_arm;
        let bottom = law.s + moved * mechanism.arm_ratio * ((1.0 - sine) * (1.0 + sine)).sqrt();
        let theta = self.data.delta + mechanism.psi(bottom);
        // Out of the lower flank the normal is (−sin α, −cos α).
        let (sin_alpha, cos_alpha) = (-normal.x, -normal.y);
        let beyond = libm::sin(theta) * cos_alpha - libm::cos(theta) * sin_alpha;
        let sigma = sin_alpha / beyond;
        let cos_psi = libm::cos(theta - self.data.delta);
        let (side, slope) = (self.motion.trend(piece, x), mechanism.arm_ratio * cos_psi * sigma);
        let forces = self
            .balanced_directions()
            .iter()
            .map(|way| (self.cylinder.unit_force() * mechanism.residual_on(side, x, bottom, slope, *way)).abs());
        forces.fold(0.0, f64::max)
    }
}

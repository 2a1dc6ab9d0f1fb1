//! The barrel as a solid.

use super::Barrel;
use super::flank::Flanks;
use crate::body::part;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::solid::CheckedSolid;
use camgen_kernel::geometry::solid::grooved_cylinder::GroovedCylinder;
use camgen_kernel::geometry::{Entity, MILLIMETRES};
use camgen_kernel::refusal::Refusal;

impl Barrel {
    /// The bore as a contour with the metal on its left.
    pub(super) fn holes(&self) -> Vec<Contour> {
        part::bore(&self.machine).iter().map(|bore: &Entity| bore.contour().reversed()).collect()
    }

    /// The solid with these flanks.
    ///
    /// # Errors
    /// [`Refusal`] when a check of it fails: a fault of camgen.
    pub(super) fn solid(&self, flanks: &Flanks) -> Result<CheckedSolid, Refusal> {
        let holes = self.holes();
        let ends = (MILLIMETRES * self.ends.0, MILLIMETRES * self.ends.1);
        let drilled: f64 = holes.iter().map(|hole| hole.area_and_centroid().0).sum();
        let cylinder = GroovedCylinder {
            upper: &flanks.upper,
            lower: &flanks.lower,
            seams: &flanks.seams,
            radii: (MILLIMETRES * self.outer, MILLIMETRES * self.floor()),
            ends,
            holes: &holes,
        };
        cylinder.solid(self.volume() + drilled * (ends.1 - ends.0))
    }
}

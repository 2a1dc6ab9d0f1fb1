//! The solid of a barrel, its flanks as bicubic spline patches: u the cam angle, v the radius of the cylinder on which a point lies.
//!
//! Points and slopes by the cam angle are exact, so that two patches meet smoothly and the rims lie on their cylinders within what the splines miss.
//! That is kept far below the tolerance: a flank that misses everywhere to one side would change the volume.

use super::{Barrel, BarrelRoller};
use crate::body::swept::{CELLS, FlankSide, LONGEST_PATCH, SweptBody, fitted_flanks};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::patch_fit::FlankStretch;
use camgen_kernel::geometry::solid::grooved_cylinder::GroovedCylinder;
use camgen_kernel::geometry::solid::{CheckedSolid, SplineSurface};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector3;
use truck_modeling::Point3;

/// A stretch of the cam angle within a piece of the motion.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stretch {
    piece: usize,
    start: f64,
    end: f64,
}

/// Both flanks, patch by patch in the order of the cam angle, with the patches at whose start both are level.
#[derive(Debug, Clone)]
pub(super) struct Flanks {
    pub(super) upper: Vec<SplineSurface>,
    pub(super) lower: Vec<SplineSurface>,
    pub(super) seams: Vec<usize>,
    /// Largest distance from the exact flanks between the nodes, mm.
    pub(super) deviation: f64,
}

impl<R: BarrelRoller> Barrel<R> {
    /// How many patches both flanks have.
    pub(super) fn patches(&self) -> usize {
        2 * self.stretches().len()
    }

    /// The stretches of the turn: pieces, parted where the roller turns round, none longer than a twelfth of a turn.
    fn stretches(&self) -> Vec<Stretch> {
        let mut stretches = Vec::new();
        for (index, piece) in self.groove.motion.pieces().iter().enumerate() {
            let slope = |angle: f64| self.groove.motion.jet(index, angle).ds;
            let (start, end) = (piece.start, piece.end);
            let margin = 1e-6 * (end - start);
            let turns = if piece.dwell {
                Vec::new()
            } else {
                camgen_kernel::numeric::root::sign_changes(slope, (start + margin, end - margin), CELLS)
            };
            let mut joints = vec![start];
            joints.extend(turns);
            joints.push(end);
            for (from, to) in joints.iter().zip(joints.iter().skip(1)) {
                let count = ((to - from) / LONGEST_PATCH - 1e-9).ceil().max(1.0);
                let mut i = 0.0;
                while i < count {
                    let place = |share: f64| if share == count { *to } else { from + (to - from) * share / count };
                    stretches.push(Stretch { piece: index, start: place(i), end: place(i + 1.0) });
                    i += 1.0;
                }
            }
        }
        stretches
    }

    /// Point (mm) and derivative by the cam angle of a flank on the cylinder of a radius, mm.
    fn flank_at(&self, flank: FlankSide, radius: f64, (piece, angle): (usize, f64)) -> [Vector3<f64>; 2] {
        let Some(found) = self.edge(flank, radius / MILLIMETRES, (piece, angle)) else {
            return [Vector3::repeat(f64::NAN); 2];
        };
        let (sin, cos) = libm::sincos(angle + found.ahead);
        let [turn, rise] = found.by_angle;
        let point = Vector3::new(radius * cos, radius * sin, MILLIMETRES * found.height);
        [point, Vector3::new(-radius * sin * turn, radius * cos * turn, MILLIMETRES * rise)]
    }

    /// Both flanks within a tolerance, mm.
    ///
    /// # Errors
    /// [`Refusal`] when the tolerance is finer than splines of a reasonable size can keep.
    pub(super) fn flanks(&self, tolerance: f64) -> Result<Flanks, Refusal> {
        let stretches = self.stretches();
        let both: Vec<FlankStretch<'_>> = FlankSide::BOTH
            .into_iter()
            .flat_map(|side| stretches.iter().map(move |stretch| (side, *stretch)))
            .map(|(side, stretch)| FlankStretch {
                along: (stretch.start, stretch.end),
                place: Box::new(move |angle, radius| self.flank_at(side, radius, (stretch.piece, angle))),
            })
            .collect();
        let radii = (MILLIMETRES * self.floor(), MILLIMETRES * self.outer);
        let (mut upper, deviation) = fitted_flanks(&both, radii, tolerance, Self::WORDS)?;
        let lower = upper.split_off(stretches.len());
        let is_level = |(_, stretch): &(usize, &Stretch)| self.is_level(stretch.piece, stretch.start);
        let seams = stretches.iter().enumerate().filter(is_level).map(|(index, _)| index).collect();
        let flanks = Flanks { upper, lower, seams, deviation };
        Ok(if self.groove.sense() > 0.0 { flanks } else { flanks.mirrored() })
    }

    /// The solid with these flanks.
    ///
    /// # Errors
    /// [`Refusal`] when a check of it fails: a fault of camgen.
    pub(super) fn solid(&self, flanks: &Flanks) -> Result<CheckedSolid, Refusal> {
        let holes = self.groove.holes();
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

impl Flanks {
    /// Mirrored about X, and in the order of the angle of the drawing again.
    fn mirrored(self) -> Self {
        let turned = |patches: Vec<SplineSurface>| -> Vec<SplineSurface> {
            let mirror = |patch: SplineSurface| SplineSurface {
                u: patch.u.iter().rev().map(|u| -u).collect(),
                v: patch.v,
                controls: patch
                    .controls
                    .into_iter()
                    .rev()
                    .map(|row| row.into_iter().map(|p| Point3::new(p.x, -p.y, p.z)).collect())
                    .collect(),
            };
            patches.into_iter().rev().map(mirror).collect()
        };
        let count = self.upper.len();
        let mut seams: Vec<usize> = self.seams.iter().map(|seam| (count - seam) % count).collect();
        seams.sort_unstable();
        Self { upper: turned(self.upper), lower: turned(self.lower), seams, deviation: self.deviation }
    }
}

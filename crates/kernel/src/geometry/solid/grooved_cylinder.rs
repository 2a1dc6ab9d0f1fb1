//! A cylinder with a groove all round its outside: two flanks of spline patches, the floor between them, and what is left of the cylinder above and
//! below.

use super::flank_strip::ShellFlank;
use super::{
    CheckedSolid, FaceSurface, ShellBuilder, SplineSurface, TruckBoundary, backward, check_closed, forward, swept,
};
use crate::geometry::contour::Contour;
use crate::refusal::Refusal;
use truck_modeling::Point3;

/// A cylinder about the z axis with a groove, mm.
#[derive(Debug, Clone, Copy)]
pub struct GroovedCylinder<'a> {
    /// The flank whose metal lies above, in the order of the angle: u the angle, v outwards.
    pub upper: &'a [SplineSurface],
    /// The flank whose metal lies below, patch by patch under the other.
    pub lower: &'a [SplineSurface],
    /// Patches at whose start floor and outside are divided: there both flanks are level.
    pub seams: &'a [usize],
    /// Radii of the outside and of the floor.
    pub radii: (f64, f64),
    /// Heights of the ends.
    pub ends: (f64, f64),
    /// Holes from end to end, clockwise.
    pub holes: &'a [Contour],
}

/// Largest difference of the volume from the one expected, as a share of it: what splines within their tolerance may miss.
const VOLUME_TOLERANCE: f64 = 1e-5;

impl GroovedCylinder<'_> {
    /// The solid, if it is closed and has the volume that is expected, mm³.
    ///
    /// # Errors
    /// [`Refusal`] when a check fails, which would be a fault of camgen.
    pub fn solid(&self, expected: f64) -> Result<CheckedSolid, Refusal> {
        let boundary = self.boundary();
        check_closed(&boundary)?;
        let volume = self.volume(&boundary);
        if !((volume / expected - 1.0).abs() <= VOLUME_TOLERANCE) {
            let what = format!("the solid encloses {volume} mm³ instead of {expected} mm³");
            return Err(Refusal::new(what).remedy(super::REPORT));
        }
        Ok(CheckedSolid { boundary, volume })
    }

    /// By the divergence of (0, 0, z): the ends and the flanks; all other faces are upright.
    fn volume(&self, boundary: &TruckBoundary) -> f64 {
        let mut volume: f64 = self.upper.iter().map(SplineSurface::lifted_volume).sum::<f64>()
            - self.lower.iter().map(SplineSurface::lifted_volume).sum::<f64>();
        for shell in &boundary.boundaries {
            for face in &shell.faces {
                let FaceSurface::Plane { origin, normal, .. } = &face.surface else { continue };
                if normal.z != 0.0 {
                    let area: f64 = face.boundaries.iter().flatten().map(|used| swept(shell, *used)).sum();
                    volume += origin.z * area;
                }
            }
        }
        volume
    }

    fn boundary(&self) -> TruckBoundary {
        let mut walls = ShellBuilder::new(self.ends);
        // The rims of the outside come first among those of the ends.
        let (under, above) = (walls.under.len(), walls.above.len());
        let upper = ShellFlank::add(&mut walls, self.upper, 1.0, true);
        let lower = ShellFlank::add(&mut walls, self.lower, -1.0, true);
        let (top, bottom) = self.outside(&mut walls, &upper, &lower);
        walls.above.insert(above, top.iter().map(|edge| forward(*edge)).collect());
        walls.under.insert(under, bottom.iter().rev().map(|edge| backward(*edge)).collect());
        for hole in self.holes {
            walls.over(hole);
        }
        walls.capped()
    }

    /// What is left of the outside above and below the groove, and its floor; the edges of the two ends.
    fn outside(&self, walls: &mut ShellBuilder, upper: &ShellFlank, lower: &ShellFlank) -> (Vec<usize>, Vec<usize>) {
        let (radius, floor) = self.radii;
        let (low, high) = self.ends;
        let n = self.seams.len();
        let mut seams = Vec::new();
        for seam in self.seams {
            let ends = [(upper.outer(*seam), high), (lower.outer(*seam), low)];
            let [(top, up), (bottom, down)] = ends.map(|(vertex, z)| {
                let place = walls.place(vertex);
                let end = walls.add_vertex(Point3::new(place.x, place.y, z));
                (end, walls.add_line(vertex, end))
            });
            let across = walls.add_line(lower.floor(*seam), upper.floor(*seam));
            seams.push(Seam { patch: *seam, top, bottom, up, down, across });
        }
        let (mut tops, mut bottoms) = (Vec::new(), Vec::new());
        for (i, seam) in seams.iter().enumerate() {
            let Some(next) = seams.get((i + 1) % n) else { continue };
            let top = walls.add_arc((seam.top, next.top), (radius, high));
            let bottom = walls.add_arc((seam.bottom, next.bottom), (radius, low));
            let (from, to) = (seam.patch, next.patch);
            let mut above: Vec<_> = upper.outer_edges(from, to).map(forward).collect();
            above.extend([forward(next.up), backward(top), backward(seam.up)]);
            let mut below = vec![forward(bottom), backward(next.down)];
            below.extend(lower.outer_edges(from, to).rev().map(backward));
            below.push(forward(seam.down));
            let mut ground: Vec<_> = lower.floor_edges(from, to).map(forward).collect();
            ground.push(forward(next.across));
            ground.extend(upper.floor_edges(from, to).rev().map(backward));
            ground.push(backward(seam.across));
            for (run, radius) in [(above, radius), (below, radius), (ground, floor)] {
                let surface = FaceSurface::Cylinder { origin: Point3::new(0.0, 0.0, low), radius };
                walls.add_face(run, surface, false);
            }
            tops.push(top);
            bottoms.push(bottom);
        }
        (tops, bottoms)
    }
}

/// Where floor and outside are divided: the vertices at the ends, the edges to them, and the edge across the floor.
struct Seam {
    patch: usize,
    top: usize,
    bottom: usize,
    up: usize,
    down: usize,
    across: usize,
}

/// Abscissae and weights of Gauss' rule with five points on [0, 1], exact to the ninth power (Abramowitz & Stegun, table 25.4).
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

impl SplineSurface {
    /// ∬ z (x_u y_v − y_u x_v) du dv, mm³, exactly.
    #[must_use]
    pub fn lifted_volume(&self) -> f64 {
        let mut volume = 0.0;
        for (u, width) in spans(&self.u) {
            for (v, height) in spans(&self.v) {
                for (a, wa) in GAUSS {
                    for (b, wb) in GAUSS {
                        let [p, by_u, by_v] = self.point_and_slopes(u + a * width, v + b * height);
                        volume += p.z * (by_u.x * by_v.y - by_u.y * by_v.x) * wa * wb * width * height;
                    }
                }
            }
        }
        volume
    }
}

/// The spans of a knot vector with their widths.
fn spans(knots: &[f64]) -> impl Iterator<Item = (f64, f64)> {
    knots.iter().zip(knots.iter().skip(1)).filter(|(a, b)| a < b).map(|(a, b)| (*a, b - a))
}

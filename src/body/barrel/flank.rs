//! The flanks of a barrel as bicubic spline patches: u the cam angle, v the radius of the cylinder on which a point lies.
//!
//! Points and slopes by the cam angle are exact, so that two patches meet smoothly and the rims lie on their cylinders within what the splines miss.
//! That is kept far below the tolerance: a flank that misses everywhere to one side would change the volume.

use super::{Barrel, FlankSide};
use crate::geometry::MILLIMETRES;
use crate::geometry::solid::SplineSurface;
use crate::numeric::extremum::larger;
use crate::numeric::parallel;
use crate::numeric::spline::{Spline, bspline_knots};
use crate::refusal::Refusal;
use nalgebra::Vector3;
use truck_modeling::Point3;

/// Longest patch, rad.
const LONGEST: f64 = std::f64::consts::PI / 6.0;
/// Spans of a patch along the angle and outwards to begin with, and how often either is doubled.
const SPANS: u32 = 4;
const RINGS: u32 = 3;
const DOUBLINGS: u32 = 4;
/// Share of the tolerance that the splines may miss.
const SHARE: f64 = 0.02;

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

impl Barrel {
    /// How many patches both flanks have.
    pub(super) fn patches(&self) -> usize {
        2 * self.stretches().len()
    }

    /// The stretches of the turn: pieces, parted where the roller turns round, none longer than a twelfth of a turn.
    fn stretches(&self) -> Vec<Stretch> {
        let mut stretches = Vec::new();
        for (index, piece) in self.motion.pieces().iter().enumerate() {
            let slope = |angle: f64| self.motion.jet(index, angle).ds;
            let (start, end) = (piece.start, piece.end);
            let margin = 1e-6 * (end - start);
            let turns = if piece.dwell {
                Vec::new()
            } else {
                crate::numeric::root::sign_changes(slope, (start + margin, end - margin), super::CELLS)
            };
            let mut joints = vec![start];
            joints.extend(turns);
            joints.push(end);
            for (from, to) in joints.iter().zip(joints.iter().skip(1)) {
                let count = ((to - from) / LONGEST - 1e-9).ceil().max(1.0);
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
    fn flank_at(&self, flank: FlankSide, radius: f64, (piece, angle): (usize, f64)) -> (Vector3<f64>, Vector3<f64>) {
        let Some(found) = self.edge(flank, radius / MILLIMETRES, (piece, angle)) else {
            return (Vector3::repeat(f64::NAN), Vector3::repeat(f64::NAN));
        };
        let (sin, cos) = libm::sincos(angle + found.ahead);
        let [turn, rise] = found.by_angle;
        let point = Vector3::new(radius * cos, radius * sin, MILLIMETRES * found.height);
        (point, Vector3::new(-radius * sin * turn, radius * cos * turn, MILLIMETRES * rise))
    }

    /// Both flanks within a tolerance, mm.
    ///
    /// # Errors
    /// [`Refusal`] when the tolerance is finer than splines of a reasonable size can keep.
    pub(super) fn flanks(&self, tolerance: f64) -> Result<Flanks, Refusal> {
        let stretches = self.stretches();
        let both: Vec<(FlankSide, Stretch)> = [FlankSide::Upper, FlankSide::Lower]
            .iter()
            .flat_map(|side| stretches.iter().map(|s| (*side, *s)))
            .collect();
        let mut rings = RINGS;
        let mut found = f64::INFINITY;
        for _ in 0..DOUBLINGS {
            let fitted: Vec<(SplineSurface, [f64; 2])> =
                parallel::map(&both, |(side, stretch)| self.patch_within((*side, *stretch), rings, SHARE * tolerance));
            let [along, outwards] =
                fitted.iter().fold([0.0_f64; 2], |[a, b], (_, [c, d])| [larger(a, *c), larger(b, *d)]);
            found = larger(along, outwards);
            if found <= SHARE * tolerance {
                let mut upper: Vec<SplineSurface> = fitted.into_iter().map(|(patch, _)| patch).collect();
                let lower = upper.split_off(stretches.len());
                let is_level = |(_, stretch): &(usize, &Stretch)| self.is_level(stretch.piece, stretch.start);
                let seams = stretches.iter().enumerate().filter(is_level).map(|(index, _)| index).collect();
                let flanks = Flanks { upper, lower, seams, deviation: found };
                return Ok(if self.sense() > 0.0 { flanks } else { flanks.mirrored() });
            }
            rings *= 2;
        }
        let what = format!("the flanks of the barrel miss by {found:.2e} mm, with {rings} rings of splines");
        Err(Refusal::new(what).remedy("give a coarser --tolerance, a larger cam.outer_radius or a smoother motion"))
    }

    /// A patch with as many spans along the angle as it needs, and what it misses along the angle and outwards, mm.
    fn patch_within(&self, of: (FlankSide, Stretch), rings: u32, allowed: f64) -> (SplineSurface, [f64; 2]) {
        let mut spans = SPANS;
        loop {
            let patch = self.patch(of, (spans, rings));
            let missed = self.missed(of, &patch, (spans, rings));
            if !(missed[0] > allowed) || spans >= SPANS << DOUBLINGS {
                return (patch, missed);
            }
            spans *= 2;
        }
    }

    fn ring(&self, i: f64, rings: u32) -> f64 {
        let (floor, outer) = (MILLIMETRES * self.floor(), MILLIMETRES * self.outer);
        if i == f64::from(rings) { outer } else { floor + (outer - floor) * i / f64::from(rings) }
    }

    fn patch(&self, (side, stretch): (FlankSide, Stretch), (spans, rings): (u32, u32)) -> SplineSurface {
        let angles: Vec<f64> = (0..=spans).map(|i| stretch.at(f64::from(i), spans)).collect();
        let radii: Vec<f64> = (0..=rings).map(|i| self.ring(f64::from(i), rings)).collect();
        let columns: Vec<Vec<(Vector3<f64>, Vector3<f64>)>> = angles
            .iter()
            .map(|angle| radii.iter().map(|radius| self.flank_at(side, *radius, (stretch.piece, *angle))).collect())
            .collect();
        let count = radii.len() + 2;
        let mut controls = vec![vec![Point3::new(0.0, 0.0, 0.0); count]; angles.len() + 2];
        for axis in 0..3 {
            let outwards = |values: Vec<f64>| Spline::not_a_knot(&radii, &values).controls();
            let component = |vector: &Vector3<f64>| vector.get(axis).copied().unwrap_or(f64::NAN);
            let points: Vec<Vec<f64>> =
                columns.iter().map(|column| outwards(column.iter().map(|(p, _)| component(p)).collect())).collect();
            let slopes = |column: Option<&Vec<(Vector3<f64>, Vector3<f64>)>>| {
                outwards(column.into_iter().flatten().map(|(_, slope)| component(slope)).collect())
            };
            let (first, last) = (slopes(columns.first()), slopes(columns.last()));
            for v in 0..count {
                let at = |list: &Vec<f64>| list.get(v).copied().unwrap_or(f64::NAN);
                let row: Vec<f64> = points.iter().map(at).collect();
                let along = Spline::clamped(&angles, &row, (at(&first), at(&last))).controls();
                for (u, value) in along.into_iter().enumerate() {
                    if let Some(point) = controls.get_mut(u).and_then(|row| row.get_mut(v)) {
                        match axis {
                            0 => point.x = value,
                            1 => point.y = value,
                            _ => point.z = value,
                        }
                    }
                }
            }
        }
        SplineSurface { u: bspline_knots(&angles), v: bspline_knots(&radii), controls }
    }

    /// What a patch misses at the middles of its spans, along the angle on the rings, and between the rings, mm.
    fn missed(
        &self,
        (side, stretch): (FlankSide, Stretch),
        patch: &SplineSurface,
        (spans, rings): (u32, u32),
    ) -> [f64; 2] {
        let off = |i: f64, j: f64| {
            let (angle, radius) = (stretch.at(i, spans), self.ring(j, rings));
            let (exact, _) = self.flank_at(side, radius, (stretch.piece, angle));
            (patch.at(angle, radius)[0] - exact).norm()
        };
        let mut missed = [0.0_f64; 2];
        for i in 0..spans {
            for j in 0..=rings {
                missed[0] = larger(missed[0], off(f64::from(i) + 0.5, f64::from(j)));
            }
        }
        for i in 0..=spans {
            for j in 0..rings {
                missed[1] = larger(missed[1], off(f64::from(i), f64::from(j) + 0.5));
            }
        }
        missed
    }
}

impl Stretch {
    fn at(&self, i: f64, spans: u32) -> f64 {
        if i == f64::from(spans) { self.end } else { self.start + (self.end - self.start) * i / f64::from(spans) }
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

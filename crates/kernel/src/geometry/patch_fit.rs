//! Bicubic spline patches through exact places of a flank, with exact slopes along their first parameter, so that two patches that follow each other
//! meet smoothly.

use super::solid::SplineSurface;
use crate::numeric::extremum::larger;
use crate::numeric::parallel;
use crate::numeric::spline::{Spline, bspline_knots};
use nalgebra::Vector3;
use truck_modeling::Point3;

/// Spans of a patch along its first and its second parameter to begin with, and how often either is doubled.
const SPANS: u32 = 4;
const RINGS: u32 = 3;
const DOUBLINGS: u32 = 4;

/// A part of a flank over a range of its first parameter, along which it is smooth.
pub struct FlankStretch<'a> {
    /// The range.
    pub along: (f64, f64),
    /// Point (mm) and derivative by the first parameter at a value of both.
    pub place: Box<dyn Fn(f64, f64) -> [Vector3<f64>; 2] + Send + Sync + 'a>,
}

/// The patches of stretches over a common range of the second parameter, and what they miss of the exact flanks between their nodes at most, mm, which is
/// within what is allowed.
///
/// # Errors
/// What they miss with the largest number of spans, and that number across.
pub fn fitted(
    stretches: &[FlankStretch<'_>],
    across: (f64, f64),
    allowed: f64,
) -> Result<(Vec<SplineSurface>, f64), (f64, u32)> {
    let mut rings = RINGS;
    let mut found = f64::INFINITY;
    for _ in 0..DOUBLINGS {
        let all: Vec<(SplineSurface, [f64; 2])> =
            parallel::map(stretches, |stretch| stretch.within(across, rings, allowed));
        let [along, outwards] = all.iter().fold([0.0_f64; 2], |[a, b], (_, [c, d])| [larger(a, *c), larger(b, *d)]);
        found = larger(along, outwards);
        if found <= allowed {
            return Ok((all.into_iter().map(|(patch, _)| patch).collect(), found));
        }
        rings *= 2;
    }
    Err((found, rings))
}

/// The value of a parameter at a share of its range, its ends exactly.
fn parameter_at((start, end): (f64, f64), i: f64, of: u32) -> f64 {
    if i == f64::from(of) { end } else { start + (end - start) * i / f64::from(of) }
}

impl FlankStretch<'_> {
    /// A patch with as many spans along as it needs, and what it misses along and across, mm.
    fn within(&self, across: (f64, f64), rings: u32, allowed: f64) -> (SplineSurface, [f64; 2]) {
        let mut spans = SPANS;
        loop {
            let patch = self.patch(spans, across, rings);
            let missed = self.missed(&patch, spans, across, rings);
            if !(missed[0] > allowed) || spans >= SPANS << DOUBLINGS {
                return (patch, missed);
            }
            spans *= 2;
        }
    }

    fn patch(&self, spans: u32, across: (f64, f64), rings: u32) -> SplineSurface {
        let alongs: Vec<f64> = (0..=spans).map(|i| parameter_at(self.along, f64::from(i), spans)).collect();
        let acrosses: Vec<f64> = (0..=rings).map(|j| parameter_at(across, f64::from(j), rings)).collect();
        let columns: Vec<Vec<[Vector3<f64>; 2]>> =
            alongs.iter().map(|u| acrosses.iter().map(|v| (self.place)(*u, *v)).collect()).collect();
        let count = acrosses.len() + 2;
        let mut controls = vec![vec![Point3::new(0.0, 0.0, 0.0); count]; alongs.len() + 2];
        for axis in 0..3 {
            let points = columns.iter().map(|column| column.iter().map(|[point, _]| point[axis]).collect::<Vec<_>>());
            let points: Vec<Vec<f64>> =
                points.map(|values| Spline::not_a_knot(&acrosses, &values).controls()).collect();
            let [first, last] = [columns.first(), columns.last()].map(|column| {
                let slopes: Vec<f64> = column.into_iter().flatten().map(|[_, slope]| slope[axis]).collect();
                Spline::not_a_knot(&acrosses, &slopes).controls()
            });
            for v in 0..count {
                let row: Vec<f64> = points.iter().map(|column| column[v]).collect();
                let along = Spline::clamped(&alongs, &row, (first[v], last[v])).controls();
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
        SplineSurface { u: bspline_knots(&alongs), v: bspline_knots(&acrosses), controls }
    }

    /// What a patch misses at the middles of its spans, along on the rings, and between the rings, mm.
    fn missed(&self, patch: &SplineSurface, spans: u32, across: (f64, f64), rings: u32) -> [f64; 2] {
        let along = (0..spans).flat_map(|i| (0..=rings).map(move |j| (f64::from(i) + 0.5, f64::from(j))));
        let between = (0..=spans).flat_map(|i| (0..rings).map(move |j| (f64::from(i), f64::from(j) + 0.5)));
        let off = |(i, j): (f64, f64)| {
            let (u, v) = (parameter_at(self.along, i, spans), parameter_at(across, j, rings));
            (patch.point_and_slopes(u, v)[0] - (self.place)(u, v)[0]).norm()
        };
        [along.map(off).fold(0.0, larger), between.map(off).fold(0.0, larger)]
    }
}

//! Points of a spline surface, and the distance from it.

use super::SplineSurface;
use crate::numeric::spline::bspline_basis;
use nalgebra::Vector3;

/// Steps to the nearest point of a patch.
const FOOT_STEPS: usize = 12;
/// By how much a step to a foot would have to come nearer to be made, mm.
const SETTLED: f64 = 1e-11;

impl SplineSurface {
    /// Point and derivatives by both parameters.
    #[must_use]
    pub fn point_and_slopes(&self, u: f64, v: f64) -> [Vector3<f64>; 3] {
        let (first_u, basis_u, slopes_u) = bspline_basis(&self.u, u);
        let (first_v, basis_v, slopes_v) = bspline_basis(&self.v, v);
        let mut sums = [Vector3::zeros(); 3];
        for (row, (bu, du)) in self.controls.iter().skip(first_u).zip(basis_u.iter().zip(slopes_u)) {
            for (p, (bv, dv)) in row.iter().skip(first_v).zip(basis_v.iter().zip(slopes_v)) {
                let p = Vector3::new(p.x, p.y, p.z);
                let [point, by_u, by_v] = &mut sums;
                *point += p * (bu * bv);
                *by_u += p * (du * bv);
                *by_v += p * (bu * dv);
            }
        }
        sums
    }

    /// First and last value of either parameter.
    #[must_use]
    pub fn range(&self) -> [(f64, f64); 2] {
        [&self.u, &self.v]
            .map(|knots| (knots.first().copied().unwrap_or(f64::NAN), knots.last().copied().unwrap_or(f64::NAN)))
    }

    /// Distance of a point from the patch near the parameters (u, v), the foot kept within the patch.
    ///
    /// Gauss and Newton's step, halved until the distance falls: near a sharp place the whole step overshoots.
    #[must_use]
    pub fn distance(&self, from: &Vector3<f64>, (mut u, mut v): (f64, f64)) -> f64 {
        let [(u0, u1), (v0, v1)] = self.range();
        let mut place = self.point_and_slopes(u, v);
        let mut nearest = (from - place[0]).norm();
        for _ in 0..FOOT_STEPS {
            let [point, by_u, by_v] = place;
            let gap = from - point;
            let (e, f, g) = (by_u.dot(&by_u), by_u.dot(&by_v), by_v.dot(&by_v));
            let (a, b) = (gap.dot(&by_u), gap.dot(&by_v));
            let determinant = e * g - f * f;
            let mut step = ((g * a - f * b) / determinant, (e * b - f * a) / determinant);
            // A step comes nearer at most by its square over twice the distance.
            if (by_u * step.0 + by_v * step.1).norm_squared() <= SETTLED * nearest {
                break;
            }
            let before = nearest;
            for _ in 0..FOOT_STEPS {
                let next = ((u + step.0).clamp(u0, u1), (v + step.1).clamp(v0, v1));
                let there = self.point_and_slopes(next.0, next.1);
                let found = (from - there[0]).norm();
                if found < nearest {
                    (nearest, place, u, v) = (found, there, next.0, next.1);
                    break;
                }
                step = (0.5 * step.0, 0.5 * step.1);
            }
            // Where no part of the step came nearer, the next one would be the same.
            if nearest == before {
                break;
            }
        }
        nearest
    }
}

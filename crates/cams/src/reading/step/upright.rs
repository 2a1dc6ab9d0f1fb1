//! Walls over splines: edges that are level cubic curves, and surfaces that such curves sweep upwards.
//!
//! An edge lies on a wall where each of its polynomials is close to a part of the wall's curve: the part between the places nearest to
//! its ends. Two Bézier curves are nowhere farther apart than their control points. Where the two are parametrised differently, or
//! have their knots at different places, the edge is divided until they are close enough or a place of it is found to be too far.

use super::{StepBoundary, StepCurve, StepEdge, StepSurface};
use camgen_kernel::geometry::contour::{self, Cubic};
use camgen_kernel::geometry::edge_tree::EdgeTree;
use camgen_kernel::geometry::nurbs;
use nalgebra::{Vector2, Vector3, Vector4};
use std::cell::Cell;

/// Most polynomials of walls that parts of edges are compared with, in a whole solid: thousands of times what a cam has, and
/// a matter of seconds.
pub(super) const WORK: usize = 20_000_000;
/// Splines of a degree above 3, which programs write where they have cut a wall, are approximated by cubic curves within this
/// share of the reach; others are cubic curves already.
const CUBIC_SHARE: f64 = 0.01;
/// A part is not divided nearer to its ends than this share of its parameter.
const INSIDE: f64 = 1e-6;

/// A boundary in which upright spline edges are replaced by lines: programs write such edges where they have cut a wall. Their control
/// points are above one another within `reach` (mm), and only rise or only fall.
pub(super) fn with_lines_for_splines(boundary: &StepBoundary, reach: f64) -> StepBoundary {
    let mut straight = boundary.clone();
    for edge in &mut straight.edges {
        let StepCurve::Spline(curve) = &edge.curve else { continue };
        let places: Vec<Vector3<f64>> = curve.controls.iter().map(|control| control.xyz() / control.w).collect();
        let (Some(first), Some(last)) = (places.first(), places.last()) else { continue };
        let up = last.z - first.z;
        let goes_on = |pair: &[Vector3<f64>]| matches!(pair, [a, b] if (b.z - a.z) * up >= 0.0);
        let stands = places.iter().all(|place| (place.xy() - first.xy()).norm() <= reach);
        if stands && up.abs() > reach && places.windows(2).all(goes_on) {
            edge.curve = StepCurve::Line { origin: *first, direction: Vector3::z() * up.signum() };
        }
    }
    straight
}

/// A level edge, from its first vertex to its last.
pub(super) struct LevelEdge {
    /// Its polynomials, seen from above.
    pub(super) cubics: Vec<Cubic>,
    /// Largest distance of its ends from the vertices, mm.
    pub(super) off: f64,
}

impl LevelEdge {
    /// A spline edge between the places of its vertices, which may lie within it; places within `reach` (mm) count as one.
    pub(super) fn of(edge: &StepEdge, [start, end]: [Vector3<f64>; 2], reach: f64) -> Result<Self, &'static str> {
        let StepCurve::Spline(curve) = &edge.curve else { return Err("not a spline") };
        let cubics = curve.cubics(CUBIC_SHARE * reach).ok_or("rational, or too rough")?;
        let heights = || cubics.iter().flatten().flat_map(|point| [point.z - start.z, point.z - end.z]);
        if !heights().all(|off| off.abs() <= reach) {
            return Err("not level");
        }
        let flat = cubics.iter().map(|points| Cubic { points: points.map(|point| point.xy()) });
        let mut cubics: Vec<Cubic> = flat.collect();
        if !cubics.iter().all(|cubic| contour::Edge::Cubic(*cubic).is_finite()) {
            return Err("not finite");
        }
        if !edge.forward {
            cubics = cubics.iter().rev().map(Cubic::reversed).collect();
        }
        let (cubics, missed) = trimmed(&cubics, start.xy(), end.xy(), reach).ok_or("run against its vertices")?;
        Ok(Self { cubics, off: missed })
    }

    /// The edge in the sense in which it is run.
    pub(super) fn run(&self, forward: bool) -> Vec<Cubic> {
        if forward { self.cubics.clone() } else { self.cubics.iter().rev().map(Cubic::reversed).collect() }
    }
}

/// A chain between the places nearest to two points, and the largest distance of these from it; `None` where they come in the opposite
/// order. An end of the chain that is within `reach` of its point coincides with it.
fn trimmed(cubics: &[Cubic], start: Vector2<f64>, end: Vector2<f64>, reach: f64) -> Option<(Vec<Cubic>, f64)> {
    let near = |index: usize, t: f64, point: Vector2<f64>| {
        cubics.get(index).map_or(f64::INFINITY, |cubic| (cubic.derivatives(t)[0] - point).norm())
    };
    let nearest = |point: Vector2<f64>, (at, t): (usize, f64)| -> (usize, f64, f64) {
        let own = (at, t, near(at, t, point));
        if own.2 <= reach {
            return own;
        }
        let places = cubics.iter().map(|cubic| cubic.nearest_parameter(point)).enumerate();
        places.map(|(i, t)| (i, t, near(i, t, point))).min_by(|a, b| a.2.total_cmp(&b.2)).unwrap_or(own)
    };
    let (first, from, off) = nearest(start, (0, 0.0));
    let (last, to, missed) = nearest(end, (cubics.len().checked_sub(1)?, 1.0));
    if (last, to) <= (first, from) {
        return None;
    }
    let part = |(index, cubic): (usize, &Cubic)| {
        let (low, high) = (if index == first { from } else { 0.0 }, if index == last { to } else { 1.0 });
        let whole = low == 0.0 && high == 1.0;
        (low < high).then(|| if whole { *cubic } else { cubic.part(low, high) })
    };
    let within = cubics.iter().enumerate().take(last + 1).skip(first);
    Some((within.filter_map(part).collect(), off.max(missed)))
}

/// A surface that a level curve sweeps upwards.
pub(super) struct SweptSurface {
    curve: EdgeTree,
    /// 1 where the surface's own normal is to the right of the curve, −1 where it is to the left.
    side: f64,
    /// Its lower and upper end, mm.
    heights: (f64, f64),
}

impl SweptSurface {
    /// The surface, where it is such a surface within `reach` (mm) as far as `size` (mm) from the origin.
    pub(super) fn of(surface: &StepSurface, reach: f64, size: f64) -> Option<Self> {
        match surface {
            StepSurface::Spline(patch) => {
                let turned = || nurbs::NurbsSurface {
                    u: patch.v.clone(),
                    v: patch.u.clone(),
                    controls: transposed(&patch.controls),
                };
                // Upwards along its second parameter, or along its first.
                Self::up(patch, 1.0, reach).or_else(|| Self::up(&turned(), -1.0, reach))
            }
            StepSurface::Swept { curve, direction } if direction.xy().norm() * size <= reach => {
                Self::over(curve, CUBIC_SHARE * reach, direction.z.signum(), (f64::NEG_INFINITY, f64::INFINITY))
            }
            _ => None,
        }
    }

    fn over(curve: &nurbs::NurbsCurve, within: f64, side: f64, heights: (f64, f64)) -> Option<Self> {
        let flat = curve.cubics(within)?.into_iter().map(|points| Cubic { points: points.map(|point| point.xy()) });
        let edges: Vec<contour::Edge> = flat.map(contour::Edge::Cubic).collect();
        edges.iter().all(contour::Edge::is_finite).then(|| Self { curve: EdgeTree::along(edges), side, heights })
    }

    /// A patch whose control points are above one another along its second parameter, in level rows that only rise or only fall.
    /// Whatever its knots, it is then the curve of the first control point of each row, at heights that only rise or fall.
    fn up(patch: &nurbs::NurbsSurface, side: f64, reach: f64) -> Option<Self> {
        let weight = patch.controls.first()?.first()?.w;
        let places: Vec<Vec<Vector3<f64>>> =
            patch.controls.iter().map(|row| row.iter().map(|control| control.xyz() / control.w).collect()).collect();
        let levels = places.first()?;
        let stands = |row: &Vec<Vector3<f64>>| {
            let foot = row.first().map(Vector3::xy).unwrap_or_default();
            row.iter().zip(levels).all(|(p, level)| (p.xy() - foot).norm() <= reach && (p.z - level.z).abs() <= reach)
        };
        let plain = patch.controls.iter().flatten().all(|control| control.w == weight);
        let rises = levels.windows(2).all(|pair| matches!(pair, [a, b] if a.z <= b.z));
        let falls = levels.windows(2).all(|pair| matches!(pair, [a, b] if a.z >= b.z));
        if !(plain && (rises || falls) && places.iter().all(stands)) {
            return None;
        }
        let ((first, _), (from, to)) = (patch.u.range(), patch.v.range());
        let (from, to) = (patch.point_and_slopes(first, from)[0].z, patch.point_and_slopes(first, to)[0].z);
        let controls = patch.controls.iter().filter_map(|row| row.first().copied()).collect();
        let curve = nurbs::NurbsCurve { knots: patch.u.clone(), controls };
        ((to - from).abs() > reach).then_some(())?;
        Self::over(&curve, CUBIC_SHARE * reach, side * (to - from).signum(), (from.min(to), from.max(to)))
    }

    /// How far places of these heights are above or below it, mm.
    fn beyond(&self, heights: [f64; 2]) -> f64 {
        heights.map(|z| (self.heights.0 - z).max(z - self.heights.1)).into_iter().fold(0.0, f64::max)
    }

    /// Largest distance of a straight edge from it, mm: only upright ones lie on it.
    pub(super) fn off_line(&self, [start, end]: [Vector3<f64>; 2]) -> f64 {
        let near = self.curve.nearest_segment(start.xy()).map_or(f64::INFINITY, |(_, nearest)| nearest.left.abs());
        near + (end.xy() - start.xy()).norm() + self.beyond([start.z, end.z])
    }

    /// Largest distance of a level edge from it, mm: within `within`, or as far as was found, and infinite where that is unknown;
    /// `work` is the remaining work that may be spent on it.
    pub(super) fn off_level(&self, edge: &LevelEdge, ends: [Vector3<f64>; 2], within: f64, work: &Cell<usize>) -> f64 {
        let mut most = self.beyond(ends.map(|end| end.z));
        let mut open = edge.cubics.clone();
        while let Some(part) = open.pop() {
            // In the worst case, where all lie over one another, the search examines each.
            let Some(left) = work.get().checked_sub(self.curve.edges().len()) else { return f64::INFINITY };
            work.set(left);
            let middle = part.derivatives(0.5)[0];
            let Some((index, nearest)) = self.curve.nearest_segment(middle) else { return f64::INFINITY };
            let Some(contour::Edge::Cubic(own)) = self.curve.edges().get(index) else { return f64::INFINITY };
            let away = nearest.left.abs();
            if !(away <= within) {
                return away;
            }
            let hull = part.points.iter().map(|point| (point - middle).norm()).fold(0.0, f64::max);
            let bound = distance_bound(&part, own).min(away + hull);
            if bound <= within {
                most = most.max(bound);
            } else {
                let (first, last) = part.split(knot_of(&part, own, within).unwrap_or(0.5));
                open.extend([last, first]);
            }
        }
        most
    }

    /// Its normal at the place nearest to a point.
    pub(super) fn normal(&self, place: Vector2<f64>) -> Option<Vector3<f64>> {
        let (_, nearest) = self.curve.nearest_segment(place)?;
        Some(Vector3::new(nearest.tangent.y, -nearest.tangent.x, 0.0) * self.side)
    }
}

fn transposed(rows: &[Vec<Vector4<f64>>]) -> Vec<Vec<Vector4<f64>>> {
    let columns = rows.first().map_or(0, Vec::len);
    (0..columns).map(|column| rows.iter().filter_map(|row| row.get(column).copied()).collect()).collect()
}

/// A bound for the distance of a curve from the part of another between the places nearest to its ends.
fn distance_bound(part: &Cubic, own: &Cubic) -> f64 {
    let [start, .., end] = part.points;
    let other = own.part(own.nearest_parameter(start), own.nearest_parameter(end));
    part.points.iter().zip(other.points).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

/// The parameter within a curve at which it passes an end of another, as near as `within` (mm).
fn knot_of(part: &Cubic, own: &Cubic, within: f64) -> Option<f64> {
    let [start, .., end] = own.points;
    [start, end].into_iter().find_map(|knot| {
        let t = part.nearest_parameter(knot);
        let inside = (INSIDE..=1.0 - INSIDE).contains(&t);
        (inside && (part.derivatives(t)[0] - knot).norm() <= within).then_some(t)
    })
}

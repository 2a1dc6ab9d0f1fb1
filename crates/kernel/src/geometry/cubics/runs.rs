//! The edges of a chain as few curves: cubic curves that join smoothly become one spline.

use super::CubicBSpline;
use crate::geometry::contour::{Contour, Cubic, Edge, Segment};
use nalgebra::Vector2;

/// Two cubic curves become one spline where their tangents are parallel to this, rad, and their second derivatives agree to this
/// share of the adjacent legs: far above rounding, far below the difference between the two sides of a break of the law.
const PARALLEL: f64 = 1e-9;
const SMOOTH: f64 = 1e-9;

/// A part of a chain that is one curve.
#[derive(Debug, Clone, PartialEq)]
pub enum CurveRun {
    /// An arc or a line.
    Segment(Segment),
    /// Cubic curves in a row, twice continuously differentiable.
    Spline(CubicBSpline),
}

/// The parts of a chain in order.
#[must_use]
pub fn runs(contour: &Contour) -> Vec<CurveRun> {
    let mut found = Vec::new();
    let mut row: Vec<(Cubic, f64)> = Vec::new();
    for edge in contour.edges() {
        match edge {
            Edge::Segment(segment) => {
                found.extend(joined(&std::mem::take(&mut row)).map(CurveRun::Spline));
                found.push(CurveRun::Segment(segment));
            }
            Edge::Cubic(cubic) => {
                let width = row.last().and_then(|(before, width)| goes_on(before, *width, &cubic));
                if width.is_none() {
                    found.extend(joined(&std::mem::take(&mut row)).map(CurveRun::Spline));
                }
                row.push((cubic, width.unwrap_or_else(|| cubic.legs().map(|leg| leg.norm()).iter().sum())));
            }
        }
    }
    found.extend(joined(&row).map(CurveRun::Spline));
    found
}

/// The width of the span of a cubic curve that follows another of a given width, where they form one spline.
fn goes_on(before: &Cubic, width: f64, after: &Cubic) -> Option<f64> {
    let ([_, a, b], [c, d, _]) = (before.legs(), after.legs());
    let (arrives, leaves) = (b.norm(), c.norm());
    // With equal tangents and equal speeds.
    let next = width * leaves / arrives;
    let parallel = b.dot(&c) > 0.0 && b.perp(&c).abs() <= PARALLEL * arrives * leaves;
    let off = (b - a) * (next / width) - (d - c) * (width / next);
    (parallel && next.is_finite() && off.norm() <= SMOOTH * (arrives + leaves)).then_some(next)
}

/// The spline of cubic curves with the widths of their spans: its control points are the blossoms at three knots in a row
/// (L. Ramshaw, 1987), of which the first two bound one of the curves.
fn joined(row: &[(Cubic, f64)]) -> Option<CubicBSpline> {
    let ((first, _), (last, _)) = (row.first()?, row.last()?);
    let mut controls: Vec<Vector2<f64>> = first.points.iter().take(2).copied().collect();
    for ((cubic, width), (_, next)) in row.iter().zip(row.iter().skip(1)) {
        let [_, b, c, _] = cubic.points;
        controls.push(b + (c - b) * ((width + next) / width));
    }
    controls.extend(last.points.iter().skip(2));
    let ends = row.iter().scan(0.0, |end, (_, width)| {
        *end += width;
        Some(*end)
    });
    let inner: Vec<f64> = ends.collect();
    let end = inner.last().copied()?;
    let mut knots = vec![0.0; 4];
    knots.extend(inner.iter().take(inner.len() - 1));
    knots.extend([end; 4]);
    Some(CubicBSpline { knots, controls })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::{Bend, Vertex};

    /// A spline between two lines is found again, and a kink or a jump of the curvature parts it.
    #[test]
    fn a_spline_is_found_again() {
        let at = |x: f64, y: f64| Vector2::new(x, y);
        let spline = CubicBSpline {
            knots: vec![0.0, 0.0, 0.0, 0.0, 3.0, 5.0, 9.0, 12.0, 12.0, 12.0, 12.0],
            controls: vec![
                at(0.0, 0.0),
                at(1.0, 0.1),
                at(3.0, 0.5),
                at(6.0, 2.0),
                at(8.0, 3.0),
                at(9.0, 5.0),
                at(9.0, 6.0),
            ],
        };
        let pieces = spline.pieces();
        let mut vertices: Vec<Vertex> =
            pieces.iter().map(|p| Vertex { point: p[0], bend: Bend::Cubic([p[1], p[2]]) }).collect();
        vertices.push(Vertex::new(at(9.0, 6.0), 0.0));
        vertices.push(Vertex::new(at(0.0, 6.0), 0.2));
        let contour = Contour { vertices };
        let found = runs(&contour);
        assert_eq!(found.len(), 3);
        let CurveRun::Spline(again) = &found[0] else { panic!("a spline: {found:?}") };
        let factor = again.knots[10] / 12.0;
        for (a, b) in again.knots.iter().zip(&spline.knots) {
            assert!((a - b * factor).abs() < 1e-12, "{again:?}");
        }
        for (a, b) in again.controls.iter().zip(&spline.controls) {
            assert!((a - b).norm() < 1e-12, "{again:?}");
        }
        let mut bent = contour;
        bent.vertices[1].bend = Bend::Cubic([pieces[1][1], pieces[1][2] + at(0.0, 1e-4)]);
        assert_eq!(runs(&bent).len(), 5, "before and behind the one that was bent");
    }
}

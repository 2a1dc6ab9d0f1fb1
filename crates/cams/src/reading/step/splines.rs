//! Splines that are lines, circles, planes and upright cylinders: programs that know nothing but splines write these for them.
//!
//! A carrier is replaced only where it is the simple shape to a tenth of the reach: lines and planes by their control points, which hold the
//! whole of them, circles and cylinders by points so close that a rational polynomial of a low degree cannot leave the shape between them.
//! Everything else stays as it is.

use super::{StepBoundary, StepCurve, StepSurface};
use camgen_kernel::geometry::nurbs::{Knots, NurbsCurve, NurbsSurface};
use nalgebra::{Vector3, Vector4};

/// Shapes coincide within this share of the reach.
const SHARE: f64 = 0.1;
/// Points on each span of a spline: more than twice as many as a rational polynomial of the highest degree has coefficients.
const POINTS: u32 = 32;
const HIGHEST_DEGREE: usize = 7;
/// Most spans of a spline that may be a circle: programs write one for each quarter.
const MOST_SPANS: usize = 64;
/// Weights that differ by less than this share are equal: the spline is a polynomial, and no circle.
const EQUAL_WEIGHTS: f64 = 1e-9;

/// A boundary with the simple shapes in place of the splines that are nothing else.
pub(super) fn with_plain_shapes(boundary: &StepBoundary, reach: f64) -> StepBoundary {
    let within = SHARE * reach;
    let mut plain = boundary.clone();
    for edge in &mut plain.edges {
        if let StepCurve::Spline(curve) = &edge.curve
            && let Some(shape) = line(curve, within).or_else(|| circle(curve, within))
        {
            edge.curve = shape;
        }
    }
    for face in &mut plain.faces {
        if let StepSurface::Spline(patch) = &face.surface
            && let Some((surface, same)) = plane(patch, within).or_else(|| cylinder(patch, within))
        {
            face.surface = surface;
            face.same_sense = face.same_sense == same;
        }
    }
    plain
}

/// The place of a control point.
fn place(control: &Vector4<f64>) -> Vector3<f64> {
    control.xyz() / control.w
}

fn is_rational<'a>(mut controls: impl Iterator<Item = &'a Vector4<f64>>) -> bool {
    let Some(first) = controls.next() else { return false };
    controls.any(|control| (control.w / first.w - 1.0).abs() > EQUAL_WEIGHTS)
}

/// Parameters on every span of a spline; `None` where it has too many, or too high a degree.
fn parameters(knots: &Knots) -> Option<Vec<f64>> {
    let spans = knots.spans();
    if spans.len() > MOST_SPANS || knots.degree > HIGHEST_DEGREE {
        return None;
    }
    let share = |i: u32| f64::from(i) / f64::from(POINTS);
    Some(spans.into_iter().flat_map(|(from, to)| (0..=POINTS).map(move |i| from + (to - from) * share(i))).collect())
}

/// A spline of the first degree whose control points lie in a row.
fn line(curve: &NurbsCurve, within: f64) -> Option<StepCurve> {
    let places: Vec<Vector3<f64>> = curve.controls.iter().map(place).collect();
    let (first, last) = (places.first()?, places.last()?);
    let direction = (last - first).try_normalize(within)?;
    let lies_on = |place: &Vector3<f64>| (place - first).cross(&direction).norm() <= within;
    let goes_on = |pair: &[Vector3<f64>]| matches!(pair, [a, b] if (b - a).dot(&direction) >= 0.0);
    let is_line = places.iter().all(lies_on) && places.windows(2).all(goes_on);
    is_line.then_some(StepCurve::Line { origin: *first, direction })
}

/// The circle through three points: centre, axis (about which they follow each other counter-clockwise) and radius.
fn through([a, b, c]: [Vector3<f64>; 3]) -> Option<(Vector3<f64>, Vector3<f64>, f64)> {
    let (p, q) = (b - a, c - a);
    let normal = p.cross(&q);
    let square = normal.norm_squared();
    let away = (p * q.norm_squared() - q * p.norm_squared()).cross(&normal) / (-2.0 * square);
    let axis = normal.try_normalize(0.0).filter(|axis| axis.iter().all(|value| value.is_finite()))?;
    let centre = a + away;
    Some((centre, axis, away.norm())).filter(|(centre, ..)| centre.iter().all(|value| value.is_finite()))
}

/// A rational spline that is an arc of a circle.
fn circle(curve: &NurbsCurve, within: f64) -> Option<StepCurve> {
    if !is_rational(curve.controls.iter()) {
        return None;
    }
    let all = parameters(&curve.knots)?;
    let (first, last) = curve.knots.range();
    let at = |t: f64| curve.point_and_slope(t).0;
    let third = (last - first) / 3.0;
    let (centre, axis, radius) = through([at(first), at(first + third), at(first + 2.0 * third)])?;
    let is_on = |t: f64| {
        let away = at(t) - centre;
        let height = away.dot(&axis);
        (away.norm() - radius).abs() <= within && height.abs() <= within
    };
    all.into_iter().all(is_on).then_some(StepCurve::Circle { centre, axis, radius })
}

/// A surface whose control points lie in a plane, and whether the plane's normal is the surface's.
fn plane(patch: &NurbsSurface, within: f64) -> Option<(StepSurface, bool)> {
    let [origin, along_u, along_v] = middle(patch);
    let normal = along_u.cross(&along_v).try_normalize(0.0)?;
    let is_on = |control: &Vector4<f64>| (place(control) - origin).dot(&normal).abs() <= within;
    let is_plane = patch.controls.iter().flatten().all(is_on);
    is_plane.then_some((StepSurface::Plane { origin, normal }, true))
}

/// Point and slopes in the middle of a surface.
fn middle(patch: &NurbsSurface) -> [Vector3<f64>; 3] {
    let ((u0, u1), (v0, v1)) = (patch.u.range(), patch.v.range());
    patch.point_and_slopes(0.5 * (u0 + u1), 0.5 * (v0 + v1))
}

/// A rational surface that is an upright cylinder, and whether its normal points away from the axis, as that of the surface.
fn cylinder(patch: &NurbsSurface, within: f64) -> Option<(StepSurface, bool)> {
    if !is_rational(patch.controls.iter().flatten()) {
        return None;
    }
    let (all_u, all_v) = (parameters(&patch.u)?, parameters(&patch.v)?);
    let ((u0, u1), (v0, v1)) = (patch.u.range(), patch.v.range());
    let flat = |u: f64, v: f64| {
        let point = patch.point_and_slopes(u, v)[0];
        Vector3::new(point.x, point.y, 0.0)
    };
    let thirds = |from: f64, to: f64| [from, from + (to - from) / 3.0, from + 2.0 * (to - from) / 3.0];
    let (half_u, half_v) = (0.5 * (u0 + u1), 0.5 * (v0 + v1));
    let stands = |along: Vector3<f64>| along.xy().norm() <= along.z.abs();
    let [point, along_u, along_v] = middle(patch);
    // One parameter goes round, the other up.
    let points =
        if stands(along_v) { thirds(u0, u1).map(|u| flat(u, half_v)) } else { thirds(v0, v1).map(|v| flat(half_u, v)) };
    let (centre, _, radius) = through(points)?;
    let is_on = |u: f64, v: f64| ((flat(u, v) - centre).norm() - radius).abs() <= within;
    if !all_u.iter().all(|u| all_v.iter().all(|v| is_on(*u, *v))) {
        return None;
    }
    let outwards = along_u.cross(&along_v).dot(&(Vector3::new(point.x, point.y, 0.0) - centre)) > 0.0;
    Some((StepSurface::Cylinder { origin: centre, axis: Vector3::z(), radius }, outwards))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_1_SQRT_2;

    fn quarter(height: f64, bent: f64) -> Vec<Vector4<f64>> {
        let control = |x: f64, y: f64, w: f64| Vector4::new(x * w, y * w, height * w, w);
        vec![control(5.0, 0.0, 1.0), control(5.0 + bent, 5.0, FRAC_1_SQRT_2), control(0.0, 5.0, 1.0)]
    }

    fn knots(degree: usize) -> Knots {
        Knots { degree, values: [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat() }
    }

    #[test]
    fn an_exact_quarter_is_a_circle_and_a_bent_one_is_not() {
        let curve = |bent: f64| NurbsCurve { knots: knots(2), controls: quarter(2.0, bent) };
        let Some(StepCurve::Circle { centre, axis, radius }) = circle(&curve(0.0), 1e-9) else { panic!("no circle") };
        assert!((centre - Vector3::new(0.0, 0.0, 2.0)).norm() < 1e-12 && (radius - 5.0).abs() < 1e-12);
        assert!((axis - Vector3::z()).norm() < 1e-12);
        assert_eq!(circle(&curve(1e-6), 1e-9), None);
    }

    #[test]
    fn a_wall_over_a_quarter_is_a_cylinder_with_its_sense() {
        let wall = |bent: f64| NurbsSurface {
            u: knots(1),
            v: knots(2),
            controls: vec![quarter(0.0, 0.0), quarter(7.0, bent)],
        };
        let Some((StepSurface::Cylinder { radius, .. }, outwards)) = cylinder(&wall(0.0), 1e-9) else {
            panic!("no cylinder")
        };
        // Upwards times round points to the axis.
        assert!((radius - 5.0).abs() < 1e-12 && !outwards);
        assert_eq!(cylinder(&wall(1e-6), 1e-9), None);
        assert_eq!(plane(&wall(0.0), 1e-9), None);
    }

    #[test]
    fn a_spline_along_a_line_is_a_line() {
        let controls = vec![Vector4::new(1.0, 2.0, 3.0, 1.0), Vector4::new(1.0, 2.0, 9.0, 1.0)];
        let up = NurbsCurve { knots: knots(1), controls };
        assert!(matches!(line(&up, 1e-9), Some(StepCurve::Line { direction, .. }) if direction == Vector3::z()));
        assert_eq!(line(&NurbsCurve { knots: knots(2), controls: quarter(0.0, 0.0) }, 1e-9), None);
    }
}

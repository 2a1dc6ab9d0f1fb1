use super::*;
use crate::geometry::boundary::BoundaryStretch;
use crate::geometry::contour::Vertex;
use std::f64::consts::TAU;

const RADIUS: f64 = 45.0;

/// A circle about (12, 0) as an exact outline of eight stretches, by the angle.
fn circle() -> Boundary<'static> {
    let frame = |_: usize, angle: f64| {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        CurvePoint {
            point: Vector2::new(12.0 + RADIUS * cos, RADIUS * sin),
            tangent: Vector2::new(-sin, cos),
            speed: RADIUS,
            curvature: 1.0 / RADIUS,
            curvature_slope: 0.0,
        }
    };
    let stretch = |i: u32| BoundaryStretch::of_curve(0, TAU * f64::from(i) / 8.0, TAU * f64::from(i + 1) / 8.0);
    Boundary::new(Box::new(frame), &(0..8).map(stretch).collect::<Vec<_>>())
}

/// A chain about the same centre: radius and angle of the vertices, bulge by the share of the arc that a circle would have.
fn chain(count: u32, radius: impl Fn(f64) -> f64, bulge: impl Fn(u32) -> f64) -> Contour {
    let vertex = |i: u32| {
        let angle = TAU * (f64::from(i) + 0.3) / f64::from(count);
        let own = libm::tan(0.25 * TAU / f64::from(count));
        let point = Vector2::new(12.0 + radius(angle) * libm::cos(angle), radius(angle) * libm::sin(angle));
        Vertex::new(point, own * bulge(i))
    };
    Contour { vertices: (0..count).map(vertex).collect() }
}

#[test]
fn circles_in_closed_form() {
    for count in [2, 3, 4, 7, 36, 1000] {
        for away in [-0.3, -1e-3, 0.0, 2e-6, 0.4] {
            let same = chain(count, |_| RADIUS + away, |_| 1.0);
            let found = follow(&same, &circle()).unwrap_or_else(|lost| panic!("{count} {away}: {lost:?}"));
            assert!((found.distance - f64::abs(away)).abs() < 1e-12, "{count} {away}: {found:?}");
        }
        if count > 6 {
            // Chords lie inside by their sagitta.
            let chords = chain(count, |_| RADIUS, |_| 0.0);
            let found = follow(&chords, &circle()).expect("it follows");
            let sagitta = RADIUS * (1.0 - libm::cos(0.5 * TAU / f64::from(count)));
            assert!((found.distance - sagitta).abs() < 1e-9, "{count}: {found:?} {sagitta}");
        }
    }
}

/// The lower of two parabolas, by many places: both fall, their tops inside, at an end, and where they cross.
#[test]
fn the_highest_place_is_that_of_the_lower_parabola() {
    for (a, b, bend) in [
        ((0.0, 0.25), (-1.0, -3.0), -0.5),
        ((0.0, 0.25), (0.02, -0.3), -0.2),
        ((-1.0, 3.0), (0.0, -0.25), -0.5),
        ((0.0, 1.0), (0.0, -1.0), 0.0),
        ((0.3, -0.2), (0.1, -0.3), 0.4),
        ((0.0, -0.5), (0.0, 0.5), 0.8),
    ] {
        let length = 2.0;
        let lower = |x: f64| {
            let y = length - x;
            let (from_a, from_b) = (a.0 + a.1 * x + 0.5 * bend * x * x, b.0 - b.1 * y + 0.5 * bend * y * y);
            from_a.min(from_b)
        };
        let scan = (0..=200_000).map(|i| lower(length * f64::from(i) / 2e5)).fold(f64::NEG_INFINITY, f64::max);
        let found = highest(a, b, length, bend);
        assert!((found - scan).abs() < 2e-5, "{a:?} {b:?} {bend}: {found} {scan}");
    }
}

/// A point over a circle, on its normal.
fn over(angle: f64, off: f64) -> ChainFoot {
    let (sin, cos) = libm::sincos(angle);
    let foot = CurvePoint {
        point: Vector2::new(RADIUS * cos, RADIUS * sin),
        tangent: Vector2::new(-sin, cos),
        speed: RADIUS,
        curvature: 1.0 / RADIUS,
        curvature_slope: 0.0,
    };
    let point = Vector2::new((RADIUS + off) * cos, (RADIUS + off) * sin);
    ChainFoot { length: RADIUS * angle, point, foot, parameter: angle, off, sine: 0.0 }
}

/// What d'' may be between two points on the circle itself, of an arc of its own curvature: also where the arc has left the circle by as
/// much as these very bounds let it.
#[test]
fn the_bend_holds_where_it_leads() {
    let kappa = 1.0 / RADIUS;
    for length in [0.1, 1.0, 4.0] {
        let (low, high) = bend((kappa, kappa), &over(0.0, 0.0), &over(length / RADIUS, 0.0), length).expect("near");
        let turned = 0.5 * length * low.abs().max(high.abs());
        let off = 0.5 * length * turned;
        // −(k − κ/(1 + κ d)) at Δ = 0.
        for d in [-off, off] {
            let own = kappa / (1.0 + kappa * d) - kappa;
            assert!(low <= own && own <= high, "{length}: {own} is not in {low} … {high}");
        }
    }
}

/// Near a corner nothing of the outline lies beyond the reported distance, seen from either side of it.
#[test]
fn a_sliver_is_seen_as_a_whole() {
    for off in [-0.2, 0.0, 1e-3, 0.2] {
        for to in [1e-4, 1e-3, 2e-3] {
            let (node, corner) = (over(0.0, off), over(to, 0.0).point);
            let reported = farthest_of_sliver(&node, corner);
            let points = (0..=100).map(|i| (over(to * f64::from(i) / 100.0, 0.0).point - node.point).norm());
            let farthest = points.fold(0.0, f64::max);
            assert!(
                farthest <= reported && reported <= farthest + 1e-3 * to * RADIUS,
                "{off} {to}: {reported} {farthest}"
            );
        }
    }
}

use super::*;
use crate::geometry::boundary::Stretch;
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
    let stretch = |i: u32| Stretch::of_curve(0, (TAU * f64::from(i) / 8.0, TAU * f64::from(i + 1) / 8.0));
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

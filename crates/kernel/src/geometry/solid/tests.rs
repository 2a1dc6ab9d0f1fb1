use super::stacked::{Wall, stacked};
use super::*;
use crate::geometry::contour::Vertex;

/// A ring of arcs, 30 mm high: an eccentric circle in four arcs about a bore in two.
fn ring() -> CheckedSolid {
    let arcs = |centre: f64, radius: f64, sense: f64, count: u32| {
        let at = |i: u32| sense * std::f64::consts::TAU * f64::from(i) / f64::from(count);
        let bulge = sense * libm::tan(std::f64::consts::TAU / f64::from(count) / 4.0);
        let vertex =
            |i: u32| Vertex::new(Vector2::new(centre + radius * libm::cos(at(i)), radius * libm::sin(at(i))), bulge);
        Contour { vertices: (0..count).map(vertex).collect() }
    };
    let walls = [arcs(8.0, 60.0, 1.0, 4), arcs(0.0, 12.5, -1.0, 2)].map(|contour| Wall::through(contour, 0.0, 30.0));
    let solid = stacked(&walls).expect("a solid");
    let area = std::f64::consts::PI * (60.0 * 60.0 - 12.5 * 12.5);
    assert!((solid.volume / (30.0 * area) - 1.0).abs() < 1e-12);
    solid
}

/// Faults planted in the boundary are caught before anything is written.
#[test]
fn a_broken_boundary_is_not_closed_or_not_the_volume() {
    let good = ring();
    let closed = |boundary: &TruckBoundary| check_closed(boundary).is_ok();
    assert!(closed(&good.boundary));

    let mut dropped = good.boundary.clone();
    dropped.boundaries[0].faces.pop();
    assert!(!closed(&dropped));

    let mut flipped = good.boundary.clone();
    flipped.boundaries[0].faces[3].orientation = !flipped.boundaries[0].faces[3].orientation;
    assert!(!closed(&flipped));

    let mut sense = good.boundary.clone();
    for edge in &mut sense.boundaries[0].edges {
        if let EdgeCurve::Circle { clockwise, .. } = &mut edge.curve {
            *clockwise = true;
        }
    }
    assert!((enclosed_volume(&sense) / good.volume - 1.0).abs() > 0.1);

    let mut moved = good.boundary.clone();
    moved.boundaries[0].vertices[5].0.x += 1e-6;
    assert!(largest_gap(&moved) > 1e-7);
}

/// The sagitta of a chord c with a bulge b is b c/2, its radius c (1/b + b)/4.
#[test]
fn an_arc_is_a_line_where_no_reader_sees_the_difference() {
    for (bulge, straight) in [(1e-8, true), (-1e-8, true), (2.2e-8, false), (1e-7, false), (0.01, false)] {
        let (start, end) = (Vector2::new(3.0, 4.0), Vector2::new(63.0, 84.0));
        let carried = edges(&Edge::Segment(Segment { start, end, bulge }));
        assert!(
            matches!(carried[..], [Edge::Segment(line)] if (line.bulge == 0.0) == straight),
            "{bulge}: {carried:?}"
        );
    }
}

use super::*;
use crate::body::disc::Disc;
use crate::body::{Body, Request};
use crate::machine::Machine;

fn boundary(overrides: &[&str]) -> CheckedSolid {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load("dpi", &overrides).expect("valid").0;
    let disc = Disc::solve(&machine, 35.0).expect("a cam");
    let drawn = disc.draw(&Request::within(5e-6)).expect("an outline");
    drawn.parts[0].solid(30.0).expect("a solid")
}

#[test]
fn cams_with_every_kind_of_hole_are_closed_solids() {
    let keyway = ["cam.keyway.width=8mm", "cam.keyway.depth=3.3mm", "cam.keyway.angle=90deg"];
    let light = ["cam.lever=0.15", "cam.base_radius=90mm", "cam.balance=40mm .. 85mm"];
    let concave = ["buffer.column=return", "transition.kind=none", "cam.rotation=ccw"];
    for overrides in [&[][..], &keyway, &light, &concave, &[&light[..], &keyway].concat()] {
        let solid = boundary(overrides);
        assert!(largest_gap(&solid.boundary) < 1e-9, "{overrides:?}: {}", largest_gap(&solid.boundary));
        let shell = &solid.boundary.boundaries[0];
        // Euler's formula with h holes: V − E + F − (L − F) = 2 − 2h.
        let loops: usize = shell.faces.iter().map(|face| face.boundaries.len()).sum();
        let holes = (loops - shell.faces.len()) / 2;
        let euler = shell.vertices.len() + 2 * shell.faces.len() + 2 * holes;
        assert_eq!(euler, 2 + shell.edges.len() + loops, "{overrides:?}");
    }
}

/// Faults planted in the boundary are caught before anything is written.
#[test]
fn a_broken_boundary_is_not_closed_or_not_the_volume() {
    let good = boundary(&[]);
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

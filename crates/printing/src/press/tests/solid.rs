//! Solids of the discs of a press.

use crate::press::rotary;
use camgen_cams::body::{Body, Request};
use camgen_cams::machine::Machine;
use camgen_kernel::geometry::solid::{CheckedSolid, largest_gap};

fn boundary(overrides: &[&str]) -> CheckedSolid {
    let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
    let machine = Machine::load("dpi", &overrides).expect("valid").0;
    let disc = rotary::disc(&machine, 35.0).expect("a cam");
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

//! What the follower of a conoid feels of its written sections, to first order.
//!
//! The cut of a section is touched by rollers that stand at different places along the axis, and the file of one section says
//! nothing of the flank between them. What follows from it is what its own heading and curvature miss of the exact cut:
//! δs' = (ℓ/cos α) δheading and δs'' = −(ℓ²/cos α) δκ, ℓ the speed of the cut and α the angle between its normal and the roller's path.

use super::WrittenOutline;
use crate::body::Body;
use crate::body::conoid::{BESIDE, Conoid, Missed};
use crate::geometry::MILLIMETRES;
use crate::geometry::contour::Edge;
use crate::machine::Rotation;
use crate::numeric::parallel;
use crate::profile::Worst;
use crate::report::Felt;

/// Places on each edge, both ends among them.
const PLACES: u32 = 5;
/// What the follower feels of the sections; `None` where a section has no such place.
pub(super) fn felt(conoid: &Conoid, outlines: &[WrittenOutline]) -> Option<Felt> {
    let turned = conoid.machine().cam.rotation == Rotation::CounterClockwise;
    let of_section = |section: &WrittenOutline| {
        let contour = if turned { section.contour.mirrored_about_x() } else { section.contour.clone() };
        let edges: Vec<Edge> = contour.edges().collect();
        let off =
            |edge: &Edge| (0..PLACES).map(|place| off(conoid, section.z, edge, place)).collect::<Option<Vec<Missed>>>();
        let all: Option<Vec<Vec<Missed>>> = edges.iter().map(off).collect();
        all.map(|all| (section.z, all))
    };
    let all: Option<Vec<(f64, Vec<Vec<Missed>>)>> = parallel::map(outlines, of_section).into_iter().collect();
    let (mut velocity, mut acceleration, mut step) = (Worst::NONE, Worst::NONE, Worst::NONE);
    for (z, edges) in &all? {
        let next = edges.iter().cycle().skip(1);
        for (edge, next) in edges.iter().zip(next) {
            for off in edge {
                velocity = velocity.or_larger(Worst { value: off.velocity.abs(), at: off.at, z: *z });
                acceleration = acceleration.or_larger(Worst { value: off.acceleration.abs(), at: off.at, z: *z });
            }
            if let (Some(before), Some(after)) = (edge.last(), next.first()) {
                let jump = (after.acceleration - before.acceleration).abs();
                step = step.or_larger(Worst { value: jump, at: before.at, z: *z });
            }
        }
    }
    let [_, largest] = conoid.largest_rates();
    let told = |worst: Worst| (MILLIMETRES * worst.value.max(0.0), conoid.place(worst.at));
    Some(Felt {
        swings: false,
        velocity_error: told(velocity),
        acceleration_error: told(acceleration),
        acceleration_step: told(step),
        acceleration_of_motion: MILLIMETRES * largest,
        // Every section has a speed of its own.
        shaft_speed: None,
        mass: None,
    })
}

/// What an edge misses of the exact cut at one of its places.
fn off(conoid: &Conoid, z: f64, edge: &Edge, place: u32) -> Option<Missed> {
    let share = f64::from(place) / f64::from(PLACES - 1);
    let (point, tangent) = edge.at(share);
    // At its ends an edge belongs to the piece of the law on its own side.
    let inwards = if place == 0 {
        BESIDE
    } else if place + 1 == PLACES {
        -BESIDE
    } else {
        0.0
    };
    conoid.missed(z, (point / MILLIMETRES, tangent, MILLIMETRES * edge.curvature(share)), inwards)
}

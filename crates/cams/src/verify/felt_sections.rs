//! The motion of a conoid's follower on its written sections, to first order.
//!
//! The cut of a section is touched by rollers at different places along the axis, and the file of one section does not contain
//! the flank between them. What can be derived from it is by how much its own heading and curvature miss the exact cut:
//! δs' = (ℓ/cos α) δheading and δs'' = −(ℓ²/cos α) δκ, ℓ the speed of the cut and α the angle between its normal and the roller's path.

use super::check::{Evidence, WrittenOutline};
use crate::body::surface::{BESIDE, RateErrors, Surface};
use crate::report::AsCutError;
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::geometry::contour::Edge;
use camgen_kernel::numeric::parallel;
use camgen_kernel::profile::Worst;

/// Places on each edge, including both ends.
const PLACES: u32 = 5;
/// The errors of motion on the sections; `None` where a section has no such place.
pub(super) fn of_sections(evidence: &Evidence<'_>, surface: &dyn Surface) -> Option<AsCutError> {
    let (body, cuts) = (evidence.body, evidence.body.cuts());
    let of_section = |section: &WrittenOutline| {
        let turned = cuts.get(section.cut).is_some_and(|cut| cut.mirrored == [true]);
        let contour = if turned { section.contour.mirrored_about_x() } else { section.contour.clone() };
        let edges: Vec<Edge> = contour.edges().collect();
        let off = |edge: &Edge| {
            (0..PLACES).map(|place| off(surface, section.z, edge, place)).collect::<Option<Vec<RateErrors>>>()
        };
        let all: Option<Vec<Vec<RateErrors>>> = edges.iter().map(off).collect();
        all.map(|all| (section.z, all))
    };
    let all: Option<Vec<(f64, Vec<Vec<RateErrors>>)>> =
        parallel::map(evidence.outlines, of_section).into_iter().collect();
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
    let [_, largest] = body.largest_rates();
    let placed = |worst: Worst| (MILLIMETRES * worst.value.max(0.0), body.place(worst.at));
    Some(AsCutError {
        by_travel: false,
        swings: false,
        velocity_error: placed(velocity),
        acceleration_error: placed(acceleration),
        acceleration_step: placed(step),
        velocity_step: None,
        acceleration_of_motion: MILLIMETRES * largest,
        // Every section has a speed of its own.
        shaft_speed: None,
        mass: None,
    })
}

/// By how much an edge misses the exact cut at one of its places.
fn off(surface: &dyn Surface, z: f64, edge: &Edge, place: u32) -> Option<RateErrors> {
    let share = f64::from(place) / f64::from(PLACES - 1);
    let (point, tangent) = edge.point_and_tangent(share);
    // At its ends an edge belongs to the piece of the law on its own side.
    let inwards = if place == 0 {
        BESIDE
    } else if place + 1 == PLACES {
        -BESIDE
    } else {
        0.0
    };
    surface.rate_errors(z, (point / MILLIMETRES, tangent, MILLIMETRES * edge.curvature(share)), inwards)
}

//! How a radius is found that the checks will pass.

use super::Figures;
use crate::check::contact_stress;
use crate::machine::{CamData, Limits};
use camgen_kernel::follower::{Element, Follower};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::profile::size::{BASE_STEP, SizeLimits};
use camgen_kernel::text::{KeyChange, Remedy, Text, text};

/// Smallest radius of curvature that an automatic size allows under a flat face, m: a sharper place is an edge.
const LEAST_FACE_RADIUS: f64 = 1e-3;

/// What the limits of a machine file and a bore that reaches so far (m) require of a disc under a follower.
#[must_use]
pub fn size_limits(limits: &Limits, (cam, reach): (&CamData, Option<f64>), follower: &dyn Follower) -> SizeLimits {
    let offset = follower.element().offset();
    // Where no wall is asked for there must still be one.
    let wall = Some(limits.least_wall(cam.bore_radius)).filter(|wall| *wall > 0.0).unwrap_or(BASE_STEP);
    let least_base = reach.map_or(BASE_STEP, |reach| reach + wall);
    SizeLimits {
        pressure_angles: limits.pressure_angles(),
        convex_radius: limits.convex_radius(offset.abs()).max(match follower.element() {
            Element::Roller { radius } => radius.abs(),
            Element::Face if limits.min_convex_radius.is_some() => 0.0,
            Element::Face => LEAST_FACE_RADIUS,
        }),
        least: (least_base + offset).max(follower.prime_radii().0),
    }
}

/// The first limit depending on the base radius that a turning cam breaks, as `limits` of the machine file calls it. Checks judge;
/// this is how a radius is found that they will pass.
pub fn broken_limit(body: &impl Figures) -> Option<&'static str> {
    let limits = body.machine().limits;
    let (least, roller) = (body.least_radius().value, body.roller_radius().unwrap_or(0.0));
    // A surface searched for its sharpest place is sized to a billionth.
    let convex = limits.convex_radius(roller) * (1.0 - SIZED_TO);
    let kept = |limit: Option<f64>, keeps: &dyn Fn(f64) -> bool| limit.is_none_or(keeps);
    let angles = || body.pressure_angles().into_iter().zip(limits.pressure_angles());
    let inclined = |of: usize| angles().nth(of).is_some_and(|(worst, limit)| worst.value > limit * (1.0 + 1e-12));
    let least_wall = limits.least_wall(body.machine().cam.bore_radius);
    let knife_edge = super::curves_of(body).is_some_and(|curves| curves.element() == Element::Roller { radius: 0.0 });
    let allowed = contact_stress::largest_allowed(body.machine(), body.touching());
    // The limit that requires more.
    let by_profile = limits.convex_radius(roller) > limits.min_convex_pitch_radius_over_roller * roller;
    let of_convex = if by_profile { "min_convex_radius" } else { "min_convex_pitch_radius_over_roller" };
    let of_return = if limits.pressure_angle_return.is_some() { "pressure_angle_return" } else { "pressure_angle" };
    let checks: [(&'static str, &dyn Fn() -> bool); 7] = [
        ("pressure_angle", &|| !inclined(0)),
        (of_return, &|| !inclined(1)),
        ("undercut", &|| least > roller || knife_edge && least >= roller),
        (of_convex, &|| body.least_rolled_radius().value >= convex),
        ("wall", &|| body.wall().is_none_or(|(wall, _)| wall > 0.0 && wall >= least_wall * (1.0 - SIZED_TO))),
        ("cutter_radius", &|| {
            kept(limits.cutter_radius, &|limit| {
                body.min_concave_radius()
                    .is_none_or(|min_concave_radius| limit <= min_concave_radius.value * (1.0 + 1e-12))
            })
        }),
        ("contact_stress", &|| kept(allowed, &|limit| !body.exceeds_stress(limit))),
    ];
    checks.iter().find(|(_, keeps)| !keeps()).map(|(name, _)| *name)
}

/// How exactly a size keeps a limit that it was solved for, as a share.
const SIZED_TO: f64 = 1e-9;

/// The message where no base radius keeps every limit, with the limit that a huge cam still breaks; of a motion program or of another motion.
#[must_use]
pub fn no_radius(binding: Option<&'static str>, of_program: bool) -> String {
    match binding {
        Some("undercut") if of_program => {
            "no base radius would pass: the velocity of the follower jumps; avoid that by other states or laws of the segments that meet there"
                .into()
        }
        Some("undercut") => {
            "no base radius would pass: the velocity of the follower jumps; avoid that by another transition.kind, such as \"run-up\""
                .into()
        }
        Some(check) => format!("no base radius would pass: {} fails at any", check.replace('_', " ")),
        None => "no base radius that would pass was found".into(),
    }
}

/// The sentence of a remedy: a base radius (m) in millimetres, without the noise of the last digits.
#[must_use]
pub fn passing(base_radius: f64) -> Text {
    const PER_METRE: f64 = 1e12;
    let picometres = (PER_METRE * base_radius - 1e-3).ceil();
    let typed = format!("{} mm", picometres / (PER_METRE / MILLIMETRES));
    let remedy = Remedy::new([KeyChange::new("cam.base_radius", typed)]).named("a base radius of");
    text!("{} would pass", remedy)
}

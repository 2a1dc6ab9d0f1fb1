//! The web tension of a belt brake whose disc is as cut.

use super::Body;
use crate::geometry::contour::Contour;
use crate::motion::{BrakeDisc, Jet, Motion};
use crate::profile::followed::Followed;
use crate::report::TensionAsCut;

/// Places of a stretch of an outline at which the tension is looked at.
const PLACES: u32 = 8;
/// How far within a stretch its first and last place lie, as a share of it.
const INSET: f64 = 1e-6;

/// Web tension, N, where the follower of a disc stands as this jet says, counted as in the motion.
fn tension(disc: &BrakeDisc, angle: f64, jet: Jet) -> Option<[f64; 2]> {
    let holding = disc.holding();
    let stand = holding.stand_at(angle).ok()?;
    let of_law = Jet { s: jet.s + disc.origin().unwrap_or(0.0), ..jet };
    let torque = -disc.law().spring_torque(of_law);
    let tension = holding.tension_with(torque, &stand, holding.brake().friction()).ok()?;
    Some([stand.radius, tension])
}

/// The tension with the disc of a brake on an outline, mm, its follower where the outline puts it: the spring's force there times the
/// slope that the outline has. `None` for another body, or where the follower is not in touch.
#[must_use]
pub fn as_cut(body: &dyn Body, outline: &Contour) -> Option<TensionAsCut> {
    let (disc, curves) = (body.brake_disc()?, body.plane()?);
    let followed = Followed::on(curves, outline, body.mirrored());
    let end = disc.holding().total_angle();
    let mut points = Vec::new();
    for (from, to) in followed.ranges() {
        let inset = INSET * (to - from);
        for place in 0..=PLACES {
            let at = from + inset + (to - from - 2.0 * inset) * f64::from(place) / f64::from(PLACES);
            let (piece, angle) = disc.locate(at);
            if piece == 0 && angle <= end {
                points.push(tension(disc, angle, followed.at(at)?)?);
            }
        }
    }
    // The ends of the roll themselves.
    for angle in [0.0, end] {
        points.push(tension(disc, angle, followed.at(angle)?)?);
    }
    points.sort_by(|a, b| b[0].total_cmp(&a[0]));
    let tension = |point: &&[f64; 2]| point[1];
    let least = points.iter().min_by(|a, b| tension(a).total_cmp(&tension(b))).copied()?;
    let largest = points.iter().max_by(|a, b| tension(a).total_cmp(&tension(b))).copied()?;
    Some(TensionAsCut { least, largest, points })
}

//! The web tension of a belt brake whose disc is as cut.

use super::Body;
use crate::geometry::contour::Contour;
use crate::motion::{BrakeDisc, Jet, Motion};
use crate::numeric::extremum;
use crate::profile::followed::Followed;
use crate::report::TensionAsCut;

/// Places of a stretch of an outline at which the tension is looked at.
const PLACES: u32 = 8;
/// How far within a stretch its first and last place lie, as a share of it.
const INSET: f64 = 1e-6;
/// Golden sections about an extreme: its value is then right to a millionth of what it stands out by.
const SECTIONS: u32 = 10;
/// Only places that come so near to the furthest from the wanted tension are looked at closer.
const NEAR: f64 = 0.7;

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
///
/// Along a segment of the outline the tension is smooth: it is looked at in a few places, and closer about each that stands out.
#[must_use]
pub fn as_cut(body: &dyn Body, outline: &Contour) -> Option<TensionAsCut> {
    let (disc, curves) = (body.brake_disc()?, body.plane()?);
    let followed = Followed::on(curves, outline, body.mirrored());
    let end = disc.holding().total_angle();
    let at = |angle: f64| tension(disc, angle, followed.at(angle)?);
    let mut points = vec![at(0.0)?, at(end)?];
    let mut peaks = Vec::new();
    let turn = curves.motion.period().unwrap_or(f64::INFINITY);
    for (from, to) in followed.ranges() {
        // The chain of the outline may begin anywhere in the turn.
        let shift = turn * (from / turn + INSET).floor();
        let (from, to) = ((from - shift).max(0.0), (to - shift).min(end));
        if !(to > from) {
            continue;
        }
        let inset = INSET * (to - from);
        let place = |i: u32| from + inset + (to - from - 2.0 * inset) * f64::from(i) / f64::from(PLACES);
        let found: Vec<[f64; 2]> = (0..=PLACES).map(|i| at(place(i))).collect::<Option<_>>()?;
        let of_three = |(index, three): (u32, &[[f64; 2]])| Peak::of(three, (place(index), place(index + 2)));
        peaks.extend((0..).zip(found.windows(3)).filter_map(of_three));
        points.extend(found);
    }
    // Only what may be the largest or the least is looked at closer.
    let wanted = disc.holding().tension();
    let furthest = |sign: f64| points.iter().map(|[_, p]| sign * (p - wanted)).fold(0.0, f64::max);
    let (above, below) = (furthest(1.0), furthest(-1.0));
    let may_be = |peak: &&Peak| {
        let off = peak.about - wanted;
        off > NEAR * above || -off > NEAR * below
    };
    let exact: Vec<[f64; 2]> = peaks.iter().filter(may_be).filter_map(|peak| peak.exact(&at)).collect();
    points.extend(exact);
    points.sort_by(|a, b| b[0].total_cmp(&a[0]));
    let tension = |point: &&[f64; 2]| point[1];
    let least = points.iter().min_by(|a, b| tension(a).total_cmp(&tension(b))).copied()?;
    let largest = points.iter().max_by(|a, b| tension(a).total_cmp(&tension(b))).copied()?;
    Some(TensionAsCut { least, largest, points })
}

/// An extreme between the outer of three neighbouring places.
struct Peak {
    range: (f64, f64),
    /// 1 of a largest tension, −1 of a least.
    sign: f64,
    /// The tension there by the parabola through the three, N.
    about: f64,
}

impl Peak {
    /// Where the parabola through three places has its extreme between them.
    fn of(three: &[[f64; 2]], range: (f64, f64)) -> Option<Self> {
        let &[[_, before], [_, middle], [_, after]] = three else { return None };
        let (slope, bend) = (0.5 * (after - before), before - 2.0 * middle + after);
        let inside = slope.abs() < bend.abs();
        inside.then(|| Self { range, sign: -bend.signum(), about: middle - 0.5 * slope * slope / bend })
    }

    fn exact(&self, at: &impl Fn(f64) -> Option<[f64; 2]>) -> Option<[f64; 2]> {
        let value = |angle: f64| at(angle).map_or(f64::NEG_INFINITY, |[_, tension]| self.sign * tension);
        at(extremum::largest_without_slope(value, self.range, 2, SECTIONS).at)
    }
}

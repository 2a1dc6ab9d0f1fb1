//! The web tension of a belt brake whose disc is as cut.

use super::BrakeDisc;
use camgen_cams::body::curves;
use camgen_cams::machine::{Machine, Rotation};
use camgen_cams::pipeline::Proven;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::motion::{Jet, Motion};
use camgen_kernel::numeric::extremum;
use camgen_kernel::profile::Curves;
use camgen_kernel::profile::followed::FollowerOnChain;

/// Places of a stretch of an outline at which the tension is evaluated.
const PLACES: u32 = 8;
/// How far within a stretch its first and last place lie, as a share of it.
const INSET: f64 = 1e-6;
/// Golden sections about an extreme: its value is then exact to a millionth of its height.
const SECTIONS: u32 = 10;
/// Only places with at least this share of the largest deviation from the wanted tension are refined.
const NEAR: f64 = 0.7;

/// The web tension over the roll with the outline of a brake's disc as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct TensionAsCut {
    /// Radius of the roll, m, and the least tension, N.
    pub least: [f64; 2],
    /// Radius of the roll, m, and the largest tension, N.
    pub largest: [f64; 2],
    /// Radius of the roll, m, and tension, N, from the full roll on.
    pub points: Vec<[f64; 2]>,
}

/// Radius, m, and web tension, N, with the follower of a disc at this jet, measured as in the motion.
fn tension(disc: &BrakeDisc, angle: f64, jet: Jet) -> Option<[f64; 2]> {
    let holding = disc.holding();
    let pose = holding.stand_at(angle).ok()?;
    let of_law = Jet { s: jet.s + disc.origin().unwrap_or(0.0), ..jet };
    let torque = -disc.law().spring_torque(of_law);
    let tension = holding.tension_with(torque, &pose, holding.brake().friction()).ok()?;
    Some([pose.radius, tension])
}

/// The tension with the disc of a brake on an outline, mm, its follower on the outline: the force of the spring there times the
/// slope of the outline. `None` where the follower does not touch.
///
/// Along a segment of the outline the tension is smooth: it is evaluated at a few places and refined about each extreme.
#[must_use]
pub(super) fn as_cut(
    disc: &BrakeDisc,
    (curves, mirrored): (Curves<'_>, bool),
    outline: &Contour,
) -> Option<TensionAsCut> {
    let followed = FollowerOnChain::on(curves, outline, &[mirrored]);
    let end = disc.holding().total_angle();
    let at = |angle: f64| tension(disc, angle, followed.jet_at(angle)?);
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
        let of_three = |(index, three): (u32, &[[f64; 2]])| TensionPeak::of(three, (place(index), place(index + 2)));
        peaks.extend((0..).zip(found.windows(3)).filter_map(of_three));
        points.extend(found);
    }
    // Only what may be the largest or the least is refined.
    let wanted = disc.holding().tension();
    let furthest = |sign: f64| points.iter().map(|[_, p]| sign * (p - wanted)).fold(0.0, f64::max);
    let (above, below) = (furthest(1.0), furthest(-1.0));
    let may_be = |peak: &&TensionPeak| {
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

/// The tension with the disc of a brake as it was written.
#[must_use]
pub fn as_written(disc: &BrakeDisc, cam: &Proven) -> Option<TensionAsCut> {
    let (body, outline) = (cam.body(), cam.outlines().first()?);
    as_cut(disc, (curves(body)?, is_mirrored(body.machine())), &outline.contour)
}

/// Whether the drawing of a disc of this machine is mirrored.
pub(super) fn is_mirrored(machine: &Machine) -> bool {
    machine.cam.rotation == Rotation::CounterClockwise
}

/// An extreme between the outer of three neighbouring places.
struct TensionPeak {
    range: (f64, f64),
    /// 1 for a largest tension, −1 for a least.
    sign: f64,
    /// The tension there by the parabola through the three, N.
    about: f64,
}

impl TensionPeak {
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

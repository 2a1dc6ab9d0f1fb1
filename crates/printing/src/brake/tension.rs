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

/// Angles of a stretch of an outline at which the tension is evaluated.
const PLACES: u32 = 8;
/// Distance of the first and last angle from the ends of a stretch, as a share of it.
const INSET: f64 = 1e-6;
/// Golden sections about an extreme: its value is then exact to a millionth of its height.
const SECTIONS: u32 = 10;
/// Only peaks with at least this share of the largest deviation from the wanted tension are refined.
const NEAR: f64 = 0.7;

/// The web tension at a radius of the roll.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RollTension {
    /// Radius of the roll, m.
    pub radius: f64,
    /// Web tension, N.
    pub tension: f64,
}

/// The web tension over the roll with the outline of a brake's disc as it is written.
#[derive(Debug, Clone, PartialEq)]
pub struct TensionAsCut {
    /// Least tension.
    pub least: RollTension,
    /// Largest tension.
    pub largest: RollTension,
    /// From the full roll on.
    pub points: Vec<RollTension>,
}

/// The disc of a brake with its follower on an outline.
struct FollowedDisc<'a> {
    disc: &'a BrakeDisc,
    followed: FollowerOnChain<'a>,
}

impl FollowedDisc<'_> {
    /// The tension at a cam angle: the spring's force there times the slope of the outline. `None` without contact.
    fn tension_at(&self, angle: f64) -> Option<RollTension> {
        let jet = self.followed.jet_at(angle)?;
        let holding = self.disc.holding();
        let pose = holding.stand_at(angle).ok()?;
        let of_law = Jet { s: jet.s + self.disc.origin().unwrap_or(0.0), ..jet };
        let torque = -self.disc.law().spring_torque(of_law);
        let tension = holding.tension_with(torque, &pose, holding.brake().friction()).ok()?;
        Some(RollTension { radius: pose.radius, tension })
    }
}

/// The tension with the disc of a brake on an outline, mm, its follower on the outline. `None` where the follower does not touch.
///
/// Along a segment of the outline the tension is smooth: it is evaluated at a few angles and refined about each extreme.
#[must_use]
pub(super) fn as_cut(disc: &BrakeDisc, curves: Curves<'_>, mirrored: bool, outline: &Contour) -> Option<TensionAsCut> {
    let cut = FollowedDisc { disc, followed: FollowerOnChain::on(curves, outline, &[mirrored]) };
    let end = disc.holding().total_angle();
    let mut points = vec![cut.tension_at(0.0)?, cut.tension_at(end)?];
    let mut peaks = Vec::new();
    let turn = curves.motion.period().unwrap_or(f64::INFINITY);
    for (from, to) in cut.followed.ranges() {
        // The chain of the outline may begin anywhere in the turn.
        let shift = turn * (from / turn + INSET).floor();
        let (from, to) = ((from - shift).max(0.0), (to - shift).min(end));
        if !(to > from) {
            continue;
        }
        let inset = INSET * (to - from);
        let angles: Vec<f64> =
            (0..=PLACES).map(|i| from + inset + (to - from - 2.0 * inset) * f64::from(i) / f64::from(PLACES)).collect();
        let found: Vec<RollTension> = angles.iter().map(|angle| cut.tension_at(*angle)).collect::<Option<_>>()?;
        peaks.extend(angles.windows(3).zip(found.windows(3)).filter_map(|(angles, three)| peak(angles, three)));
        points.extend(found);
    }
    // Only what may be the largest or the least is refined.
    let wanted = disc.holding().tension();
    let above = points.iter().map(|point| point.tension - wanted).fold(0.0, f64::max);
    let below = points.iter().map(|point| wanted - point.tension).fold(0.0, f64::max);
    for peak in peaks {
        let off = peak.about - wanted;
        if off > NEAR * above || -off > NEAR * below {
            points.extend(peak.refined(&cut));
        }
    }
    points.sort_by(|a, b| b.radius.total_cmp(&a.radius));
    let least = points.iter().min_by(|a, b| a.tension.total_cmp(&b.tension)).copied()?;
    let largest = points.iter().max_by(|a, b| a.tension.total_cmp(&b.tension)).copied()?;
    Some(TensionAsCut { least, largest, points })
}

/// The tension with the disc of a brake as it was written.
#[must_use]
pub fn as_written(disc: &BrakeDisc, cam: &Proven) -> Option<TensionAsCut> {
    let (body, outline) = (cam.body(), cam.outlines().first()?);
    as_cut(disc, curves(body)?, is_mirrored(body.machine()), &outline.contour)
}

/// Whether the drawing of a disc of this machine is mirrored.
pub(super) fn is_mirrored(machine: &Machine) -> bool {
    machine.cam.rotation == Rotation::CounterClockwise
}

/// An extreme between the outer of three neighbouring angles.
struct TensionPeak {
    range: (f64, f64),
    /// 1 for a largest tension, −1 for a least.
    sign: f64,
    /// The tension by the parabola through the three, N.
    about: f64,
}

/// The extreme between three neighbouring angles of the parabola through their tensions.
fn peak(angles: &[f64], three: &[RollTension]) -> Option<TensionPeak> {
    let (&[from, _, to], [before, middle, after]) = (angles, three) else { return None };
    let (before, middle, after) = (before.tension, middle.tension, after.tension);
    let (slope, bend) = (0.5 * (after - before), before - 2.0 * middle + after);
    let about = middle - 0.5 * slope * slope / bend;
    (slope.abs() < bend.abs()).then_some(TensionPeak { range: (from, to), sign: -bend.signum(), about })
}

impl TensionPeak {
    fn refined(&self, cut: &FollowedDisc<'_>) -> Option<RollTension> {
        let found = extremum::largest_without_slope(
            |angle| cut.tension_at(angle).map_or(f64::NEG_INFINITY, |point| self.sign * point.tension),
            self.range,
            2,
            SECTIONS,
        );
        cut.tension_at(found.at)
    }
}

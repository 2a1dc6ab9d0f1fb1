//! Conjugate discs: a pair on one shaft whose two rollers, on one follower, hold each other on their discs.
//!
//! The counter disc is that of the same kind of follower with the lift h − s. On a straight path its roller lies on the other side of the shaft, so
//! that its motion is half a turn later: u₂ = distance − u with the offset −ε. On an arm it is turned by the included angle Γ about the same pivot:
//! ψ₂ = Γ − ψ, on the other side. Both discs are drawn in one frame, with one keyway.

mod motion;
mod report;

use super::disc::{Disc, DiscRole, Hold};
use super::{Body, Kind, ProgramCams, broken_limit, passing};
use crate::machine::{CounterData, FollowerData, Machine};
use crate::report::shown;
use camgen_kernel::document::cams;
use camgen_kernel::follower::{Follower, FollowerPlacement, SwingingRoller, TranslatingRoller};
use camgen_kernel::geometry::MILLIMETRES;
use camgen_kernel::motion::{Motion, Quantity};
use camgen_kernel::profile::lifts;
use camgen_kernel::profile::size::{first_that_keeps, rounded_up};
use camgen_kernel::refusal::Refusal;
use camgen_kernel::text::{KeyChange, Remedy, Text, text};
pub(in crate::body) use motion::CounterMotion;
pub(crate) use report::{section, spacing};
use std::f64::consts::PI;
use std::sync::Arc;

/// The main disc of a pair.
pub const MAIN: Kind = Kind { command: cams::MAKE, noun: "conjugate cam", keys: cams::CONJUGATE };
/// The counter disc, whose files are named by its command.
pub const COUNTER: Kind = Kind { command: "counter", noun: "counter cam", keys: cams::CONJUGATE };
/// What the names of the files of the main disc have after the stem.
pub const MAIN_NAME: &str = "main";

/// The main disc of a motion, sized for both discs; `rpm` is the cam speed, if known.
///
/// # Errors
/// [`Refusal`] when motion and follower do not fit each other, or no radius keeps the limits.
pub(in crate::body) fn main(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<Disc, Refusal> {
    let hold = Hold::Pair { preload: machine.cam.track.counter.preload, counter: None };
    Disc::held(machine, Arc::clone(motion), rpm, DiscRole::with(&MAIN, hold, broken_by_counter))
}

/// The first limit that the counter disc of `main` breaks.
fn broken_by_counter(main: &Disc) -> Option<&'static str> {
    counter(main, &main.machine().cam.track.counter).map_or(Some("reach"), |counter| broken_limit(&counter))
}

/// Both discs of a motion.
///
/// # Errors
/// As [`main`], or [`Refusal`] when the counter roller would not reach its disc.
pub(super) fn pair(machine: &Machine, motion: &Arc<dyn Motion>, rpm: Option<f64>) -> Result<ProgramCams, Refusal> {
    let first = main(machine, motion, rpm)?;
    let counter = counter(&first, &machine.cam.track.counter).map_err(|refusal| refusal.remedy(reached(&first)))?;
    let counter = Arc::new(counter);
    // The roller of a straight path lies on the other side of the shaft.
    let later = if motion.quantity() == Quantity::Length { PI } else { 0.0 };
    let first = first.beside(Arc::clone(&counter), later);
    Ok(ProgramCams { first: (MAIN_NAME, Arc::new(first)), others: vec![(COUNTER.command, counter)] })
}

/// The counter disc of a main one.
///
/// # Errors
/// [`Refusal`] when its roller would not reach it.
fn counter(main: &Disc, data: &CounterData) -> Result<Disc, Refusal> {
    let machine = main.machine();
    let top = lifts(&**main.motion()).1;
    let (shape, prime_radius, turn) = follower(main, data, top)?;
    let base = prime_radius - shape.element().offset();
    if !(base > 0.0) || shape.sized(prime_radius).is_none() {
        let what = format!("the counter disc would have a base radius of {:.3} mm", MILLIMETRES * base);
        return Err(Refusal::new(what));
    }
    let place: Option<FollowerPlacement> = None;
    let own = FollowerData { shape, place, ..machine.follower.clone() };
    let own = machine.with_follower(own).with_base_radius(base);
    let motion = Arc::new(CounterMotion::new(Arc::clone(main.motion()), top, turn));
    let hold = Hold::Pair { preload: data.preload, counter: Some(top) };
    let found = Disc::held(&own, motion, main.rpm(), DiscRole::alone(&COUNTER, hold))?;
    Ok(found.sized_by(main))
}

/// Largest roller spacing tried / least spacing.
const LARGEST_SPACING: f64 = 8.0;

/// The least roller spacing with which the counter disc keeps every limit, as a key of the machine file.
fn passing_spacing(main: &Disc) -> Option<KeyChange> {
    let top = lifts(&**main.motion()).1;
    let data = main.machine().cam.track.counter;
    let keeps = |data: &CounterData| counter(main, data).is_ok_and(|counter| broken_limit(&counter).is_none());
    let least = lowest(&**main.follower())? + top;
    let largest = LARGEST_SPACING * least;
    if main.motion().quantity() == Quantity::Length {
        let with = |distance: f64| CounterData { distance: Some(distance), ..data };
        let found = first_that_keeps(least, largest, |distance| keeps(&with(distance)))?;
        let distance = rounded_up(found);
        let passing = keeps(&with(distance)).then_some(MILLIMETRES * distance)?;
        return Some(KeyChange::new("cam.counter.distance", format!("{} mm", shown(passing))));
    }
    let with = |angle: f64| CounterData { included_angle: Some(angle), ..data };
    let found = first_that_keeps(least, largest.min(PI), |angle| keeps(&with(angle)))?;
    let degrees = (TENTHS * found.to_degrees()).ceil() / TENTHS;
    let change = KeyChange::new("cam.counter.included_angle", format!("{degrees} deg"));
    keeps(&with(degrees.to_radians())).then_some(change)
}

/// Angles in remedies are rounded up to 1 / this, deg.
const TENTHS: f64 = 10.0;

/// A change with which the counter roller reaches its disc.
fn reached(main: &Disc) -> Text {
    let spacing = passing_spacing(main).map(|spacing| text!("{} would pass", Remedy::new([spacing])));
    spacing.unwrap_or_else(|| match (main.follower().place(), main.motion().quantity()) {
        (None, _) => "give [follower.roller] or [follower.swinging-roller]".into(),
        (_, Quantity::Length) => "give a larger cam.counter.distance".into(),
        (_, Quantity::Angle) => "give a larger cam.counter.included_angle, or another arm".into(),
    })
}

/// A base radius of the main disc, or a roller spacing, with which the counter disc keeps every limit.
pub(in crate::body) fn remedy_of_counter(main: &Disc) -> Option<Text> {
    let spacing = passing_spacing(main).map(|spacing| text!("{} would pass", Remedy::new([spacing])));
    let base = main.passing_base_radius().map(passing);
    base.or(spacing)
}

/// The roller of the counter disc, its prime radius, m, and by how much its motion is later, rad.
fn follower(main: &Disc, data: &CounterData, top: f64) -> Result<(Arc<dyn Follower>, f64, f64), Refusal> {
    let shape = main.follower();
    let unknown = || Refusal::new("conjugate discs need rollers");
    let (place, prime) = shape.place().zip(shape.prime_radius()).ok_or_else(unknown)?;
    match place {
        FollowerPlacement::Offset { radius } => {
            let offset = place.chosen_by(&**shape);
            let height = height(prime, offset);
            let distance = data.distance.unwrap_or(2.0 * height + top);
            let own = distance - height - top;
            if !(own > 0.0) {
                let what = "the two rollers are nearer to each other than the shaft permits";
                return Err(Refusal::new(what));
            }
            let own_prime = libm::hypot(own, offset);
            let roller = TranslatingRoller::new(own_prime, -offset, data.radius.unwrap_or(radius));
            Ok((Arc::new(roller), own_prime, PI))
        }
        FollowerPlacement::Pivot { arm, radius, side } => {
            let pivot = place.chosen_by(&**shape);
            let start = angle(pivot, arm, prime);
            let included = data.included_angle.unwrap_or(2.0 * start + top);
            let (own, own_arm) = (included - start - top, data.arm.unwrap_or(arm));
            if !(own > 0.0 && own < PI) {
                let what = "the arm of the counter roller would lie on the line of shaft and pivot";
                return Err(Refusal::new(what));
            }
            let own_prime = (pivot * pivot + own_arm * own_arm - 2.0 * pivot * own_arm * libm::cos(own)).sqrt();
            let roller = SwingingRoller::new(own_arm, pivot, data.radius.unwrap_or(radius), -side);
            Ok((Arc::new(roller), own_prime, 0.0))
        }
    }
}

/// The height of a roller over the shaft where it is lowest, from its prime radius and the offset of its path, m.
fn height(prime: f64, offset: f64) -> f64 {
    ((prime - offset) * (prime + offset)).sqrt()
}

/// The angle of an arm from the line between pivot and shaft where its roller is lowest, rad.
fn angle(pivot: f64, arm: f64, prime: f64) -> f64 {
    libm::acos((pivot * pivot + arm * arm - prime * prime) / (2.0 * pivot * arm))
}

/// Where the roller of a disc is lowest: its height over the shaft, m, or the angle of its arm, rad; `None` of a follower without a roller.
fn lowest(follower: &dyn Follower) -> Option<f64> {
    let (place, prime) = follower.place().zip(follower.prime_radius())?;
    Some(match place {
        FollowerPlacement::Offset { .. } => height(prime, place.chosen_by(follower)),
        FollowerPlacement::Pivot { arm, .. } => angle(place.chosen_by(follower), arm, prime),
    })
}

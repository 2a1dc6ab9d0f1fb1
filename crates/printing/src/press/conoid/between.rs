//! The residual force of a conoid at the speeds between its sections, and the fewest sections that keep it under a limit.

use super::{Conoid, Interpolation, bottom_law_at};
use crate::press::MachineOfPress;
use crate::press::buffer::crank_law::CrankLaw;
use crate::press::motion::ReversalState;
use camgen_cams::body::ROUNDING_OF_BALANCE;
use camgen_cams::machine::Machine;
use camgen_kernel::motion::Motion;
use camgen_kernel::numeric::{extremum, parallel};
use camgen_kernel::profile::extremes;
use camgen_kernel::refusal::Refusal;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Trial speeds between two sections, and golden sections at the worst: the residual of a strip is a smooth hump or two
/// across it, whose top is reported to 1e-9 when its position is known to a millionth of the strip.
const SPEEDS: u32 = 12;
const SPEED_SECTIONS: u32 = 24;

/// Roundings that a pressure ratio is taken to have, of itself and of the lengths it is made of: the lift of a section between others is a
/// sum of all of them.
const ROUNDINGS: f64 = 16.0;

/// Most sections that are tried.
pub const MOST_SECTIONS: u32 = 65;

/// The largest residual force between the sections.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Residual {
    /// |inertia − air|, N.
    pub force: f64,
    /// Speed, rpm.
    pub rpm: f64,
    /// Cam angle, rad.
    pub angle: f64,
}

/// The largest |inertia − air| over all speeds from the slowest to the fastest section, the column being what the mode
/// makes it at each.
#[must_use]
pub fn residual(conoid: &Conoid, interpolation: Interpolation) -> Residual {
    let pairs = conoid.speeds.iter().copied().zip(conoid.speeds.iter().skip(1).copied());
    let pairs: Vec<(f64, f64)> = pairs.filter(|(low, high)| low < high).collect();
    let worst: Vec<Residual> = parallel::map(&pairs, |strip| {
        let known = AngleCache::default();
        let worst = extremum::largest_without_slope(
            |rpm| at_speed(conoid, rpm, interpolation, &known).force,
            *strip,
            SPEEDS,
            SPEED_SECTIONS,
        );
        at_speed(conoid, worst.at, interpolation, &known)
    });
    let none = Residual { force: 0.0, rpm: conoid.speeds.first().copied().unwrap_or(0.0), angle: 0.0 };
    worst.into_iter().fold(none, |best, next| if next.force > best.force { next } else { best })
}

/// States of the sections at the cam angles of the search, which are the same at every speed.
#[derive(Default)]
struct AngleCache {
    /// By piece and the bits of the angle.
    angles: RefCell<BTreeMap<(usize, u64), Rc<SectionsAtAngle>>>,
}

/// The sections at one cam angle: the state of the first and the bottoms of all, where they are requested.
struct SectionsAtAngle {
    state: ReversalState,
    bottoms: Vec<f64>,
}

impl AngleCache {
    fn sections_at(
        &self,
        conoid: &Conoid,
        interpolation: Interpolation,
        piece: usize,
        angle: f64,
    ) -> Option<Rc<SectionsAtAngle>> {
        let section = conoid.sections.first()?;
        let mut angles = self.angles.borrow_mut();
        let known = angles.entry((piece, angle.to_bits())).or_insert_with(|| {
            let state = section.state(piece, angle);
            let all = state.reversing && interpolation == Interpolation::Smooth;
            let bottoms = if all { conoid.bottoms(piece, angle).collect() } else { Vec::new() };
            Rc::new(SectionsAtAngle { state, bottoms })
        });
        Some(Rc::clone(known))
    }
}

/// The largest residual at one speed.
fn at_speed(conoid: &Conoid, rpm: f64, interpolation: Interpolation, known: &AngleCache) -> Residual {
    let bottom_law = bottom_law_at(&conoid.press, &conoid.data, rpm);
    let z = conoid.position(rpm);
    let Some(section) = conoid.sections.first() else { return Residual { force: f64::NAN, rpm, angle: 0.0 } };
    let (unit, slice) = (conoid.cylinder.unit_force(), conoid.slice(z));
    let negligible = unit * rounding_of_balance(&bottom_law);
    let worst = extremes::largest_size_of_motion(section, (&conoid.acting(), negligible), |piece, angle| {
        let Some(sections) = known.sections_at(conoid, interpolation, piece, angle) else { return 0.0 };
        let state = &sections.state;
        if !state.reversing {
            return 0.0;
        }
        let bottom = match interpolation {
            Interpolation::Smooth => slice.displacement_of(sections.bottoms.iter().copied()),
            Interpolation::Straight => conoid.displacement(piece, angle, z, interpolation),
        };
        let left = bottom_law.loading() * state.deceleration - (bottom_law.pressure_ratio(state.crank, bottom) - 1.0);
        // A bottom that is beyond the piston leaves no air.
        if left.is_nan() { f64::NEG_INFINITY } else { unit * left }
    });
    Residual { force: worst.value.max(0.0), rpm, angle: worst.at }
}

/// Rounding of the pressure ratio: a share of the largest inertia; where that is small compared with the air itself, what the
/// ratio, (air/air left)^k in small differences of lengths as long as the column, is rounded to.
fn rounding_of_balance(bottom_law: &CrankLaw) -> f64 {
    let largest = bottom_law.largest_deceleration();
    let inertia = bottom_law.loading() * largest;
    let lengths = 1.0 + bottom_law.exponent() * bottom_law.column() / bottom_law.air_left(largest);
    (ROUNDING_OF_BALANCE * inertia).max(ROUNDINGS * f64::EPSILON * (1.0 + inertia) * lengths)
}

/// The largest residual of the sections at their own speeds.
pub(super) fn at_sections(conoid: &Conoid) -> Residual {
    let all =
        parallel::map(&conoid.speeds, |rpm| at_speed(conoid, *rpm, Interpolation::Smooth, &AngleCache::default()));
    let none = Residual { force: 0.0, rpm: conoid.speeds.first().copied().unwrap_or(0.0), angle: 0.0 };
    all.into_iter().fold(none, |best, next| if next.force > best.force { next } else { best })
}

/// Least air at one speed, m, and the cam angle where it is.
pub(super) fn air_at(conoid: &Conoid, rpm: f64) -> (f64, f64) {
    let bottom_law = bottom_law_at(&conoid.press, &conoid.data, rpm);
    let z = conoid.position(rpm);
    let Some(section) = conoid.sections.first() else { return (f64::NAN, 0.0) };
    let least = extremes::largest_of_motion(section, (&conoid.acting(), 0.0), |piece, angle| {
        let state = section.state(piece, angle);
        let bottom = conoid.displacement(piece, angle, z, Interpolation::Smooth);
        if !state.reversing {
            // The piston is no nearer than at the start of the stroke.
            return bottom - bottom_law.column();
        }
        bottom - bottom_law.displacement(state.crank) - bottom_law.air_left(state.deceleration)
    });
    (-least.value, least.at)
}

/// Angles of a reversal at which the middle of a strip is tried before its largest residual is searched.
const TRIED: u32 = 16;
/// Share of the largest inertia that is the rounding of the balance.
const ROUNDING: f64 = 1e-9;
/// No number of sections reduces the residual force that the transition leaves at the speed of a section: the factor up to which a residual counts as equal to that.
const NEARLY: f64 = 1.05;

/// Whether more than a residual force (N) is found in the middle of a strip: a look that mostly spares the search.
fn exceeds(conoid: &Conoid, limit: f64) -> bool {
    let Some(section) = conoid.sections.first() else { return false };
    let pairs = conoid.speeds.iter().zip(conoid.speeds.iter().skip(1));
    // The strips at the ends are mostly the worst.
    pairs.rev().any(|(low, high)| {
        let rpm = 0.5 * (low + high);
        let bottom_law = bottom_law_at(&conoid.press, &conoid.data, rpm);
        let z = conoid.position(rpm);
        (1..TRIED).any(|i| {
            let crank = bottom_law.angle() * f64::from(i) / f64::from(TRIED);
            let (piece, angle) = section.locate(crank / f64::from(conoid.lobes));
            let state = section.state(piece, angle);
            let bottom = conoid.displacement(piece, angle, z, Interpolation::Smooth);
            let air = bottom_law.pressure_ratio(state.crank, bottom) - 1.0;
            conoid.cylinder.unit_force() * (bottom_law.loading() * state.deceleration - air).abs() > limit
        })
    })
}

/// The conoid, its size not yet found, with the fewest speeds out of `spaced` between two that leaves no more than a residual
/// force (N), or no more than the transition itself leaves; `None` when even [`MOST_SECTIONS`] leave more. And whether it is no more
/// than that force.
fn with_fewest(
    machine: &Machine,
    limit: f64,
    spaced: impl Fn(u32) -> Vec<f64>,
) -> Result<Option<(Conoid, bool)>, Refusal> {
    let ends = Conoid::unsized_of(machine, &spaced(2))?;
    let known = AngleCache::default();
    let at_ends = ends.speeds.iter().map(|rpm| at_speed(&ends, *rpm, Interpolation::Smooth, &known).force);
    let own = at_ends.fold(0.0, f64::max);
    let reachable = if own > limit { own * NEARLY } else { limit };
    for count in 2..=MOST_SECTIONS {
        // The size does not change the law: it is found once, when the count is known.
        let conoid = Conoid::unsized_of(machine, &spaced(count))?;
        if !exceeds(&conoid, reachable) && conoid.residual_between().force <= reachable {
            return Ok(Some((conoid, own <= limit)));
        }
    }
    Ok(None)
}

/// Evenly spaced speeds from one to another, `count` of them.
fn evenly(first: f64, last: f64, count: u32) -> Vec<f64> {
    let inner = (0..count - 1).map(|i| first + (last - first) * (f64::from(i) / f64::from(count - 1)));
    inner.chain([last]).collect()
}

/// The conoid with the fewest evenly spaced speeds between two that leaves no more than a residual force
/// (N), or, when the transition itself leaves more, no more than that.
///
/// # Errors
/// [`Refusal`] when a conoid cannot be made, the force lies in the rounding of the balance, or [`MOST_SECTIONS`] leave more.
pub fn fewest(machine: &Machine, from: f64, to: f64, limit: f64) -> Result<Conoid, Refusal> {
    let least = ROUNDING * machine.press()?.largest_inertia(to);
    if limit < least {
        let what = format!("a residual force of {limit:e} N lies in the rounding of the balance");
        return Err(Refusal::new(what).remedy(format!("give a --residual of at least {least:.1e} N")));
    }
    let Some((conoid, _)) = with_fewest(machine, limit, |count| evenly(from, to, count))? else {
        return Err(Refusal::new(format!(
            "{MOST_SECTIONS} evenly spaced sections from {from} to {to} rpm leave more than {limit} N between them"
        ))
        .remedy("give a larger --residual, or a narrower range of speeds in --rpm"));
    };
    conoid.interpolated()
}

/// Thousandths of a rpm: no shop sets a speed more finely.
const PER_RPM: f64 = 1e3;

impl Conoid {
    /// The fewest evenly spaced speeds from the slowest to the fastest, rounded to be typed, that leave no more than a residual
    /// force (N) between them; `None` when no number of sections does.
    #[must_use]
    pub fn speeds_within(&self, limit: f64) -> Option<Vec<f64>> {
        let (slowest, fastest) = (*self.speeds.first()?, *self.speeds.last()?);
        let found = with_fewest(&self.machine, limit, |count| {
            let mut speeds = evenly(slowest, fastest, count);
            for rpm in &mut speeds {
                *rpm = (PER_RPM * *rpm).round() / PER_RPM;
            }
            if let [first, .., last] = speeds.as_mut_slice() {
                (*first, *last) = (slowest, fastest);
            }
            speeds
        });
        let (conoid, kept) = found.ok()??;
        kept.then_some(conoid.speeds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::units::KILOGRAM_FORCE;

    fn conoid(count: u32, overrides: &[&str]) -> Conoid {
        let overrides: Vec<String> = overrides.iter().map(|&text| text.to_owned()).collect();
        let machine = Machine::load("dpi", &overrides).expect("valid").0;
        let speeds: Vec<f64> = (0..count).map(|i| 20.0 + 15.0 * f64::from(i) / f64::from(count - 1)).collect();
        Conoid::unsized_of(&machine, &speeds).expect("a conoid")
    }

    /// q = 2, 20–35 rpm, `fixed` with L by (7) of the design speed, linear in n, in kgf: known figures.
    #[test]
    fn straight_strips_leave_what_is_known_and_splines_far_less() {
        let overrides = ["conoid.mode=fixed", "buffer.column=return", "transition.kind=none"];
        for (count, known) in [(2, 33.2), (3, 13.6), (4, 6.8), (5, 4.0), (9, 1.1)] {
            let conoid = conoid(count, &overrides);
            let straight = residual(&conoid, Interpolation::Straight).force / KILOGRAM_FORCE;
            assert!((straight - known).abs() < 0.08, "{count}: {straight}");
            let smooth = residual(&conoid, Interpolation::Smooth).force / KILOGRAM_FORCE;
            match count {
                2 => assert!((smooth - straight).abs() < 1e-9),
                5 => assert!(smooth < 0.1 * straight && (smooth - 0.11).abs() < 0.01, "{smooth}"),
                _ => assert!(smooth < straight),
            }
        }
    }

    #[test]
    fn what_no_sections_leave_is_refused() {
        let machine = Machine::load("dpi", &[]).expect("valid").0;
        let fine = fewest(&machine, 25.0, 45.0, 1e-9).expect_err("too fine");
        assert!(fine.what.ends_with("lies in the rounding of the balance"), "{fine}");
        let wide = fewest(&machine, 1.0, 1e4, 10.0).expect_err("too wide");
        assert!(wide.what.starts_with(&format!("{MOST_SECTIONS} evenly spaced sections")), "{wide}");
    }

    #[test]
    fn as_few_sections_as_keep_the_limit() {
        let machine = Machine::load("dpi", &[]).expect("valid").0;
        let found = fewest(&machine, 20.0, 35.0, 2.0).expect("a conoid");
        let left = found.residual_between();
        let count = u32::try_from(found.speeds.len()).expect("small");
        assert!(left.force <= 2.0 && residual(&conoid(count - 1, &[]), Interpolation::Smooth).force > 2.0, "{count}");
    }
}

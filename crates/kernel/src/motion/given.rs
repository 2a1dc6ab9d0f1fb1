//! Checks a motion given by code: its pieces cover the turn, its lift is continuous and 0 at its lowest point, and its derivatives
//! match its lift.

use super::{Jet, Motion};
use crate::refusal::Refusal;
use std::f64::consts::TAU;

/// Fewest samples of a piece.
const PLACES: u32 = 48;
/// Steps of the finite difference as shares of a piece, large ones for rounded values, small ones for fast changes. One must agree.
const STEPS: [f64; 4] = [3e-3, 3e-4, 3e-5, 3e-6];
/// Largest difference between a given derivative and its finite difference / largest derivative of that order.
const AGREES: f64 = 1e-4;
/// A derivative below this multiple of lift range / widthⁿ of the piece is rounding error, n its order.
const ROUNDING: f64 = 1e-7;
/// Largest step of the lift, and largest |lowest lift|, as shares of the range.
const CLOSED: f64 = 1e-6;
const LOWEST: f64 = 1e-4;
const NAMES: [&str; 3] = ["velocity", "acceleration", "jerk"];

/// Checks a motion given by code.
///
/// # Errors
/// [`Refusal`] with the angle of the contradiction.
pub fn check(motion: &dyn Motion) -> Result<(), Refusal> {
    pieces_follow(motion)?;
    let all: Vec<Vec<(f64, Jet)>> = (0..motion.pieces().len()).map(|piece| samples(motion, piece)).collect();
    if let Some((at, _)) = all.iter().flatten().find(|(_, jet)| !values(jet).iter().all(|value| value.is_finite())) {
        return Err(refused(motion, "the lift or a derivative is not finite", *at));
    }
    let lifts = all.iter().flatten().map(|(_, jet)| jet.s);
    let (low, high) = lifts.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| (low.min(s), high.max(s)));
    let range = high - low;
    if low.abs() > LOWEST * range {
        let what = format!("the lift at the lowest point is {low:.6e}, not 0");
        return Err(Refusal::new(what).remedy("subtract the lowest value; `Motion::origin` is the position at lift 0"));
    }
    continuous(motion, &all, range)?;
    derivatives_belong(motion, &all, range)
}

fn values(jet: &Jet) -> [f64; 4] {
    [jet.s, jet.ds, jet.dds, jet.ddds]
}

fn refused(motion: &dyn Motion, what: &str, at: f64) -> Refusal {
    let place = if motion.is_by_travel() { format!("x = {at:.6} m") } else { format!("{:.4} deg", at.to_degrees()) };
    Refusal::new(format!("the motion given by code: {what}")).at(place)
}

fn pieces_follow(motion: &dyn Motion) -> Result<(), Refusal> {
    let pieces = motion.pieces();
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else {
        return Err(Refusal::new("the motion given by code has no pieces").remedy("one piece over the whole turn"));
    };
    if let Some(piece) = pieces.iter().find(|piece| !(piece.start < piece.end && (piece.end - piece.start).is_finite()))
    {
        return Err(refused(motion, "a piece ends before it begins", piece.start));
    }
    if let Some([_, next]) = pieces.array_windows().find(|[a, b]| a.end != b.start) {
        return Err(refused(motion, "a piece does not begin where the one before it ends", next.start));
    }
    let width = last.end - first.start;
    if motion.period().is_some_and(|period| (width - period).abs() > CLOSED * period) || first.start.abs() > TAU {
        let what = format!("its pieces cover {:.6} deg, but a turn has 360", width.to_degrees());
        return Err(refused(motion, &what, first.start).remedy("begin within a turn of 0 and cover exactly one"));
    }
    Ok(())
}

/// Samples of a piece: argument and jet, both ends included.
fn samples(motion: &dyn Motion, piece: usize) -> Vec<(f64, Jet)> {
    let Some(own) = motion.pieces().get(piece) else { return Vec::new() };
    let count = PLACES.max(motion.cells(piece).saturating_mul(2)).min(20 * PLACES);
    let inner = (0..count).map(|index| own.start + (own.end - own.start) * f64::from(index) / f64::from(count));
    inner.chain([own.end]).map(|at| (at, motion.jet(piece, at))).collect()
}

fn continuous(motion: &dyn Motion, all: &[Vec<(f64, Jet)>], range: f64) -> Result<(), Refusal> {
    let closing = motion.period().and(all.first());
    for (before, after) in all.iter().zip(all.iter().skip(1).chain(closing)) {
        let (Some((at, from)), Some((_, to))) = (before.last(), after.first()) else { continue };
        if (to.s - from.s).abs() > CLOSED * range {
            let what = format!("the lift jumps from {:.6e} to {:.6e}", from.s, to.s);
            return Err(refused(motion, &what, *at).remedy("a lift is continuous over the turn"));
        }
    }
    Ok(())
}

fn derivatives_belong(motion: &dyn Motion, all: &[Vec<(f64, Jet)>], range: f64) -> Result<(), Refusal> {
    for (piece, samples) in all.iter().enumerate() {
        let Some(own) = motion.pieces().get(piece) else { continue };
        let width = own.end - own.start;
        for (order, name) in (1..).zip(NAMES) {
            let largest = samples.iter().map(|(_, jet)| values(jet)[order].abs()).fold(0.0, f64::max);
            let scale = AGREES * largest + ROUNDING * range / power(width, order);
            for (at, jet) in samples {
                let given = values(jet)[order];
                let found = STEPS.map(|step| difference(motion, piece, *at, step * width, order));
                if !found.iter().any(|found| found.is_none_or(|found| (found - given).abs() <= scale)) {
                    let by = found.last().copied().flatten().unwrap_or(f64::NAN);
                    let what = format!("its {name} is {given:.6e}, but the finite difference is {by:.6e}");
                    return Err(refused(motion, &what, *at)
                        .remedy("give the exact derivatives per radian, and end a piece where one of them jumps"));
                }
            }
        }
    }
    Ok(())
}

fn power(width: f64, order: usize) -> f64 {
    (0..order).map(|_| width).product()
}

/// Finite difference of the next lower derivative; `None` near the ends of a piece.
fn difference(motion: &dyn Motion, piece: usize, at: f64, step: f64, order: usize) -> Option<f64> {
    let own = motion.pieces().get(piece)?;
    if at - 2.0 * step < own.start || at + 2.0 * step > own.end {
        return None;
    }
    let [after, before, two_after, two_before] =
        [1.0, -1.0, 2.0, -2.0].map(|by| values(&motion.jet(piece, at + by * step))[order - 1]);
    Some((8.0 * (after - before) - (two_after - two_before)) / (12.0 * step))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{EccentricCircle, Piece};

    /// A harmonic with a changed jet.
    #[derive(Debug)]
    struct Changed(fn(Jet) -> Jet);

    impl Motion for Changed {
        fn pieces(&self) -> &[Piece] {
            &[Piece { start: 0.0, end: TAU, dwell: false }]
        }

        fn jet(&self, _piece: usize, angle: f64) -> Jet {
            let (sin, cos) = (libm::sin(angle), libm::cos(angle));
            (self.0)(Jet { s: 1.0 - cos, ds: sin, dds: cos, ddds: -sin }.scaled(0.01))
        }
    }

    type Change = fn(Jet) -> Jet;

    #[test]
    fn a_motion_that_contradicts_itself_is_refused() {
        assert_eq!(check(&Changed(|jet| jet)), Ok(()));
        assert_eq!(check(&EccentricCircle::new(0.01, 0.05)), Ok(()));
        let changes: [(Change, &str); 6] = [
            (|jet| Jet { s: jet.s + 0.002, ..jet }, "lowest"),
            (|jet| Jet { s: jet.s - 0.002, ..jet }, "lowest"),
            (|jet| Jet { ds: -jet.ds, ..jet }, "velocity"),
            (|jet| Jet { dds: 1.01 * jet.dds, ..jet }, "acceleration"),
            (|jet| Jet { ddds: jet.ddds.to_degrees(), ..jet }, "jerk"),
            (|jet| Jet { ds: f64::NAN, ..jet }, "finite"),
        ];
        for (change, part) in changes {
            let why = check(&Changed(change)).expect_err(part).to_string();
            assert!(why.contains(part), "{part}: {why}");
        }
    }
}

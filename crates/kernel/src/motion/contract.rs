//! What every motion keeps: tests that the core and the domains run over their own motions.

use super::{Jet, Motion};
use std::f64::consts::TAU;

/// A motion and its name.
pub type Named = (String, Box<dyn Motion>);

/// Whether motions keep the contract; how many of their pieces repeat another in its mirror.
#[must_use]
pub fn kept_by(motions: &[Named]) -> usize {
    pieces_cover_one_turn_and_every_angle_is_found(motions);
    any_angle_ends_in_a_piece(motions);
    lift_is_never_below_zero_and_touches_it(motions);
    derivatives_belong_to_their_values(motions);
    pieces_repeat_what_they_say(motions)
}

fn pieces_cover_one_turn_and_every_angle_is_found(motions: &[Named]) {
    for (name, law) in motions {
        let pieces = law.pieces();
        let turn = pieces[pieces.len() - 1].end - pieces[0].start;
        assert!((turn - TAU).abs() < 1e-14, "{name}: {turn}");
        for pair in pieces.windows(2) {
            assert_eq!(pair[0].end, pair[1].start, "{name}");
            assert!(pair[0].start < pair[0].end, "{name}");
        }
        for i in 0..720 {
            let angle = f64::from(i).to_radians() * 0.5;
            let (index, inside) = law.locate(angle);
            assert!(pieces[index].start <= inside && inside <= pieces[index].end, "{name} at {angle}");
        }
    }
}

/// Infinite, huge and undefined angles are located too, in no time.
fn any_angle_ends_in_a_piece(motions: &[Named]) {
    for (name, law) in motions {
        for angle in [1e300, -1e300, 1e18, -1e9, f64::INFINITY, f64::NEG_INFINITY, f64::NAN, 5e-324] {
            let (index, inside) = law.locate(angle);
            let piece = law.pieces()[index];
            assert!(piece.start <= inside && inside <= piece.end, "{name} at {angle}: {inside}");
        }
    }
}

/// A piece that repeats another is as long, and has its lift and derivatives turned or in the mirror, but for the rounding of the angle.
fn pieces_repeat_what_they_say(motions: &[Named]) -> usize {
    let mut mirrored = 0;
    for (name, law) in motions {
        for (index, piece) in law.pieces().iter().enumerate() {
            let (other, in_mirror) = law.repeats(index);
            let own = law.pieces()[other];
            assert!(other <= index && law.repeats(other) == (other, false), "{name}: {index} repeats {other}");
            assert!((piece.end - piece.start - (own.end - own.start)).abs() < 1e-12, "{name}: {index}");
            mirrored += usize::from(in_mirror);
            for i in 0..=50 {
                let along = (piece.end - piece.start) * f64::from(i) / 50.0;
                let jet = law.jet(index, piece.start + along);
                let wanted = if in_mirror {
                    law.jet(other, own.end - along).mirrored()
                } else {
                    law.jet(other, own.start + along)
                };
                let pairs = [(jet.s, wanted.s), (jet.ds, wanted.ds), (jet.dds, wanted.dds), (jet.ddds, wanted.ddds)];
                for (own, wanted) in pairs {
                    assert!((own - wanted).abs() < 1e-10 * (1.0 + wanted.abs()), "{name}: {index} at {along}");
                }
            }
        }
    }
    mirrored
}

fn lift_is_never_below_zero_and_touches_it(motions: &[Named]) {
    for (name, law) in motions {
        let mut least = f64::INFINITY;
        for (index, piece) in law.pieces().iter().enumerate() {
            for i in 0..=1000 {
                let angle = piece.start + (piece.end - piece.start) * f64::from(i) / 1000.0;
                least = least.min(law.jet(index, angle).s);
            }
        }
        assert!((-1e-16..1e-6).contains(&least), "{name}: {least}");
    }
}

/// Each derivative against the central difference of the one before, fourth order in the step; the tolerance is
/// the rounding of the difference (1e-16 of the size over the step) plus its truncation.
fn derivatives_belong_to_their_values(motions: &[Named]) {
    let h = 2.5e-4;
    for (name, law) in motions {
        for (index, piece) in law.pieces().iter().enumerate() {
            for i in 1..40 {
                let angle = piece.start + (piece.end - piece.start) * f64::from(i) / 40.0;
                if angle - 2.0 * h < piece.start || angle + 2.0 * h > piece.end {
                    continue;
                }
                let at = |n: f64| law.jet(index, angle + n * h);
                let difference =
                    |f: fn(Jet) -> f64| (8.0 * (f(at(1.0)) - f(at(-1.0))) - (f(at(2.0)) - f(at(-2.0)))) / (12.0 * h);
                let jet = at(0.0);
                for (order, exact, by_difference) in [
                    (1, jet.ds, difference(|j| j.s)),
                    (2, jet.dds, difference(|j| j.ds)),
                    (3, jet.ddds, difference(|j| j.dds)),
                ] {
                    assert!(
                        (exact - by_difference).abs() < 1e-9 * (1.0 + exact.abs()),
                        "{name} at {angle}, order {order}: {exact} {by_difference}"
                    );
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::{EccentricCircle, Quantity, laws, program};

    #[test]
    fn the_motions_of_the_core_keep_the_contract() {
        let mut motions: Vec<Named> = vec![("eccentric".into(), Box::new(EccentricCircle::new(0.01, 0.05)))];
        // Laws that are analytic on each of their pieces, as the differences ask.
        for name in ["cycloidal", "s-curve", "parabola-line"] {
            let law = laws::named(name);
            let segments = [(law, 2.0, 1e-4), (None, 1.0, 1e-4), (law, 3.0, 0.0), (None, 0.0, 0.0)];
            motions.push((
                name.into(),
                Box::new(program::Program::new(Quantity::Length, 0.0, &segments).expect("a program")),
            ));
        }
        _ = kept_by(&motions);
    }
}

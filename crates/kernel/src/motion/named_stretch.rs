//! The stretches of a motion that people have names for.

use super::Motion;

/// A lift that changes by less than this share of the largest is level.
const LEVEL: f64 = 1e-9;

/// A stretch of a motion with a name: one or more of its pieces.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedStretch {
    /// First value of the motion's parameter.
    pub from: f64,
    /// Last value; the next stretch starts here.
    pub to: f64,
    /// Its name.
    pub name: String,
}

/// Dwells and movements of a motion that has no better names: neighbouring pieces of one kind are one stretch.
pub(super) fn by_lift<M: Motion + ?Sized>(motion: &M) -> Vec<NamedStretch> {
    // Whether it is at rest, and whether a follower runs on it.
    let mut found: Vec<(NamedStretch, [f64; 2], (bool, bool))> = Vec::new();
    for (index, piece) in motion.pieces().iter().enumerate() {
        let [from, to] = [piece.start, piece.end].map(|at| motion.jet(index, at).s);
        let kind = (piece.dwell, motion.is_rolled(index));
        if let Some((stretch, lifts, _)) = found.last_mut().filter(|(.., known)| *known == kind) {
            stretch.to = piece.end;
            lifts[1] = to;
        } else {
            let stretch = NamedStretch { from: piece.start, to: piece.end, name: String::new() };
            found.push((stretch, [from, to], kind));
        }
    }
    let most = found.iter().flat_map(|(_, lifts, _)| lifts).fold(0.0_f64, |most, lift| most.max(lift.abs()));
    let named = found.into_iter().map(|(stretch, [from, to], (dwell, rolled))| {
        let name = match to - from {
            _ if !rolled => "no follower",
            _ if dwell => "dwell",
            travel if travel > LEVEL * most => "rise",
            travel if travel < -LEVEL * most => "return",
            _ => "movement",
        };
        NamedStretch { name: name.into(), ..stretch }
    });
    named.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::Quantity;
    use crate::motion::program::Program;
    use crate::motion::{EccentricCircle, laws};

    #[test]
    fn stretches_cover_the_range_and_are_named() {
        let segments = [
            (laws::named("parabola"), 1.5, 0.02),
            (None, 1.0, 0.02),
            (laws::named("3-4-5"), 2.0, 0.0),
            (None, 0.0, 0.0),
        ];
        let program = Program::new(Quantity::Length, 0.0, &segments).expect("a program");
        let named =
            |stretches: Vec<NamedStretch>| stretches.into_iter().map(|stretch| stretch.name).collect::<Vec<_>>();
        assert_eq!(named(by_lift(&program)), ["rise", "dwell", "return", "dwell"]);
        assert_eq!(named(program.named_stretches()), ["parabola", "dwell", "3-4-5", "dwell"]);
        for stretches in [by_lift(&program), program.named_stretches()] {
            assert!(stretches.windows(2).all(|two| two[0].to == two[1].from), "{stretches:?}");
            assert_eq!((stretches[0].from, stretches[3].to), program.range());
        }
        assert_eq!(named(EccentricCircle::new(0.005, 0.04).named_stretches()), ["movement"]);
    }
}

//! A program with another law.

use super::Program;
use crate::motion::laws::{Law, LawTask};

impl Program {
    /// The program with a law, with its default parameters, on every segment from rest to rest; segments that
    /// already have this law stay as they are. `None` where there is no such segment, or the law does not lead from rest to rest.
    #[must_use]
    pub fn with_law(&self, law: &'static Law) -> Option<Self> {
        let curve = law.serves_rests().then(|| law.solve(&LawTask::default()).ok()).flatten()?;
        let mut other = Self::empty(self.quantity, self.lobes);
        (other.rpm, other.stroke) = (self.rpm, self.stroke);
        let last = self.sources.len().checked_sub(1).and_then(|last| self.pieces.get(last))?.end;
        let starts = self.segments.iter().skip(1).map(|segment| segment.start);
        let mut changed = false;
        for (segment, end) in self.segments.iter().zip(starts.chain([last])) {
            let mut segment = segment.clone();
            let (travel, rests) = (segment.to - segment.from, segment.ends.iter().all(super::EndState::rests));
            if segment.curve.is_some() && rests && travel != 0.0 {
                changed = true;
                if segment.name != law.name {
                    (segment.curve, segment.travel, segment.name) = (Some(curve.clone()), travel, law.name);
                    segment.optimum = None;
                }
            }
            other.add(segment, end);
        }
        let whole = std::f64::consts::TAU / f64::from(self.lobes);
        other.repeat(whole);
        changed.then(|| other.with_lowest())
    }

    /// Travel (m or rad) and cam angle (rad) of the segment from rest to rest with the largest travel; `None` without such a segment.
    #[must_use]
    pub fn largest_rise(&self) -> Option<(f64, f64)> {
        let rests = self.segments.iter().filter(|segment| segment.ends.iter().all(super::EndState::rests));
        let moves = rests.map(|segment| ((segment.to - segment.from).abs(), segment.width));
        moves.filter(|(travel, _)| *travel > 0.0).reduce(|best, next| if next.0 > best.0 { next } else { best })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::laws::named;
    use crate::motion::{Motion, Quantity};

    #[test]
    fn only_segments_between_rests_change() {
        let deg = |degrees: f64| degrees.to_radians();
        let segments = |law: &str| {
            let law = named(law);
            [(law, deg(120.0), 0.03), (None, deg(30.0), 0.03), (law, deg(150.0), 0.0), (None, deg(60.0), 0.0)]
        };
        let of = |law: &str| Program::new(Quantity::Length, 0.0, &segments(law)).expect("a program");
        let changed = of("cycloidal").with_law(named("3-4-5").expect("a law")).expect("a program");
        let wanted = of("3-4-5");
        for index in 0..wanted.pieces().len() {
            let piece = wanted.pieces()[index];
            assert_eq!(piece, changed.pieces()[index]);
            for share in 0..=8 {
                let at = piece.start + (piece.end - piece.start) * f64::from(share) / 8.0;
                assert_eq!(wanted.jet(index, at), changed.jet(index, at));
            }
        }
        assert!(of("cycloidal").with_law(named("double-harmonic").expect("a law")).is_none());
        assert_eq!(of("cycloidal").largest_rise(), Some((0.03, deg(120.0))));
    }
}

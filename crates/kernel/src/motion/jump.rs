//! Jumps of a motion from one of its pieces to the next.

use super::{Jet, Motion};

/// A jump of less than this share of the largest is rounding.
const ROUNDING: f64 = 1e-9;
/// Steps of a piece at which the size of a rate is looked at.
const STEPS: u32 = 8;

/// A jump of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// 1 of the velocity, 2 of the acceleration, 3 of the jerk.
    pub order: u32,
    /// Its size, m or rad per unit of the motion's parameter to the order.
    pub by: f64,
    /// At which value of the parameter, rad of a motion over a turn.
    pub at: f64,
}

fn rates(jet: Jet) -> [f64; 3] {
    [jet.ds, jet.dds, jet.ddds]
}

/// The largest jump of the lowest derivative that jumps up to the jerk, where a follower runs on both sides of it; `None` without a
/// jump.
#[must_use]
pub fn largest(motion: &dyn Motion) -> Option<Jump> {
    if let Some(program) = motion.program() {
        return program.jump();
    }
    let mut sizes = [0.0; 3];
    for (index, piece) in motion.distinct().iter().enumerate().filter(|(index, _)| motion.is_rolled(*index)) {
        for step in 0..=STEPS {
            let at = piece.start + (piece.end - piece.start) * f64::from(step) / f64::from(STEPS);
            for (size, rate) in sizes.iter_mut().zip(rates(motion.jet(index, at))) {
                *size = rate.abs().max(*size);
            }
        }
    }
    largest_above(motion, sizes)
}

/// That jump, of a motion whose velocity, acceleration and jerk have these sizes where it is not at an end of a piece.
pub(super) fn largest_above(motion: &dyn Motion, sizes: [f64; 3]) -> Option<Jump> {
    let pieces = motion.distinct();
    let end_rates = pieces.iter().enumerate().map(|(index, piece)| {
        let (start, end) = (piece.start, piece.end);
        motion.is_rolled(index).then(|| (rates(motion.jet(index, start)), rates(motion.jet(index, end)), end))
    });
    let all: Vec<_> = end_rates.collect();
    // A cam that is run over once and back ends where its last piece does.
    let joints = if motion.period().is_some() { all.len() } else { all.len().saturating_sub(1) };
    (0..3_usize).zip(1_u32..).find_map(|(order, derivative)| {
        let at_ends = all.iter().flatten().flat_map(|(start, end, _)| [start[order].abs(), end[order].abs()]);
        let size = at_ends.chain(sizes.get(order).copied()).fold(0.0, f64::max);
        let pairs = all.iter().zip(all.iter().cycle().skip(1)).take(joints);
        let jumps = pairs.filter_map(|(before, after)| {
            let ((_, end, at), (start, ..)) = (before.as_ref()?, after.as_ref()?);
            Some(Jump { order: derivative, by: (start[order] - end[order]).abs(), at: *at })
        });
        let worst = jumps.max_by(|a, b| a.by.total_cmp(&b.by))?;
        (worst.by > ROUNDING * size).then_some(worst)
    })
}

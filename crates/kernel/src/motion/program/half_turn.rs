//! The second half of a turn that is the first one upside down, as between the two faces of a yoke: s(θ + π) = h − s(θ).

use super::context::WHOLE_TURN;
use super::keys::{OVER, REPEAT, UNTIL};
use super::{EndState, Mover, SegmentSpec};
use crate::document::{LengthOrAngle, TableReader};

/// Reports an even number of lobes.
pub(super) fn refuse_even(table: &TableReader<'_>, lobes: u32) {
    if lobes.is_multiple_of(2) {
        let message = format!("a yoke needs an odd number of lobes: with {lobes} both faces would rise together");
        table.fail(&REPEAT, message, None);
    }
}

/// Whether segments from a cam angle on are meant to cover one half of a turn or lobe, rad, and not the whole: their angles do not exceed it,
/// and leave something to a last segment without one.
pub(super) fn is_covered(segments: &[TableReader<'_>], at: f64, half: f64) -> bool {
    let covered = segments.iter().fold(0.0, |sum, segment| match (segment.get(&UNTIL), segment.get(&OVER)) {
        (Some(LengthOrAngle::Angle(until)), _) => until - at,
        (_, Some(LengthOrAngle::Angle(over))) => sum + over,
        _ => sum,
    });
    let open = segments.last().is_some_and(|last| !last.has(&OVER) && !last.has(&UNTIL));
    covered < half - WHOLE_TURN || (covered <= half + WHOLE_TURN && !open)
}

/// Adds the second half to the segments of the first, which begin at a position, m or rad.
pub(super) fn completed(steps: &mut Vec<SegmentSpec>, start: f64) {
    let sum = start + steps.last().map_or(start, |step| step.to);
    let second: Vec<SegmentSpec> = steps.iter().map(|step| step.upside_down(sum)).collect();
    steps.extend(second);
}

impl SegmentSpec {
    /// The same segment with the positions `sum − s`.
    fn upside_down(&self, sum: f64) -> Self {
        let mut mover = self.mover.clone();
        if let Mover::Spline(rows) = &mut mover {
            for [_, position] in &mut rows.points {
                *position = sum - *position;
            }
        }
        let EndState { velocity, acceleration, jerk, turning, .. } = self.end;
        let end = EndState {
            velocity: -velocity,
            acceleration: -acceleration,
            jerk: jerk.map(|jerk| -jerk),
            turning: turning.map(|turning| -turning),
            ..self.end
        };
        Self { mover, end, to: sum - self.to, ..self.clone() }
    }
}

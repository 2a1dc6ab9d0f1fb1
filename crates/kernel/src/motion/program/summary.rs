//! Figures of the segments of a program.

use super::{EndState, Program};
use crate::motion::jump::{self, Jump};
use crate::motion::laws::optimum::Optimum;
use crate::numeric::extremum;

/// How a segment begins or ends (VDI 2143).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EndClass {
    /// R: velocity and acceleration 0.
    Rest,
    /// G: a velocity without acceleration.
    Velocity,
    /// U: velocity 0 with an acceleration.
    Turn,
    /// B: velocity and acceleration.
    Motion,
}

impl EndClass {
    fn from_state(state: &EndState) -> Self {
        match (state.turns, state.velocity == 0.0, state.acceleration == 0.0) {
            (true, ..) | (_, true, false) => Self::Turn,
            (false, true, true) => Self::Rest,
            (false, false, true) => Self::Velocity,
            (false, false, false) => Self::Motion,
        }
    }

    /// Its letter.
    #[must_use]
    pub fn letter(self) -> char {
        match self {
            Self::Rest => 'R',
            Self::Velocity => 'G',
            Self::Turn => 'U',
            Self::Motion => 'B',
        }
    }
}

/// A segment of a program; m or rad, by the cam angle in rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SegmentSummary {
    /// The name of its law.
    pub law: &'static str,
    /// How it begins and ends.
    pub classes: [EndClass; 2],
    /// First and last cam angle.
    pub angles: (f64, f64),
    /// First and last position.
    pub positions: (f64, f64),
    /// How far the position leaves the range between its ends; 0 for a motion that is given as a whole.
    pub overshoot: f64,
    /// Smallest and largest position.
    pub range: (f64, f64),
    /// It is the whole motion, given without segments.
    pub whole: bool,
    /// Largest sizes of velocity, acceleration and jerk, each with its cam angle; an acceleration that jumps has an infinite jerk.
    pub peaks: [(f64, f64); 3],
    /// Whether its acceleration keeps one sign in two humps.
    pub humps: bool,
    /// The optimum of its polynomial, where it has one.
    pub optimum: Option<Optimum>,
}

/// An overshoot of less than this share of the travel is rounding.
const ROUNDING: f64 = 1e-9;

impl Program {
    /// Its segments, of the first lobe.
    #[must_use]
    pub fn segments(&self) -> &[SegmentSummary] {
        self.summaries.get_or_init(|| self.segments.iter().map(summary).collect())
    }

    /// The largest jump of the lowest derivative that jumps up to the jerk; `None` without a jump.
    #[must_use]
    pub fn jump(&self) -> Option<Jump> {
        jump::largest_above(
            self,
            [0, 1, 2].map(|order| {
                let peaks = self.segments().iter().map(|segment| segment.peaks.get(order).map_or(0.0, |peak| peak.0));
                peaks.filter(|peak| peak.is_finite()).fold(0.0, f64::max)
            }),
        )
    }
}

/// Smallest and largest position of a segment.
pub(super) fn range(segment: &super::ProgramSegment) -> (f64, f64) {
    let Some(curve) = &segment.curve else { return (segment.from, segment.from) };
    let ranges = (0..curve.parts()).map(|part| {
        let [top, low] = extremum::largest_of_both_signs(
            |x| {
                let [value, slope, bend, _] = curve.values_at(part, x).map(|value| segment.travel * value);
                [segment.from + value, slope, bend]
            },
            curve.range_of(part),
            curve.cells(part),
        );
        (-low.value, top.value)
    });
    ranges.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, top), (l, t)| (low.min(l), top.max(t)))
}

fn summary(segment: &super::ProgramSegment) -> SegmentSummary {
    let [begin, end] = &segment.ends;
    let angles = (segment.start, segment.start + segment.width);
    let positions = (segment.from, if segment.curve.is_some() { segment.to } else { segment.from });
    let rest = SegmentSummary {
        law: segment.name,
        classes: [EndClass::from_state(begin), EndClass::from_state(end)],
        angles,
        positions,
        overshoot: 0.0,
        range: (positions.0, positions.0),
        whole: segment.whole,
        peaks: [(0.0, angles.0); 3],
        humps: false,
        optimum: segment.optimum,
    };
    let Some(curve) = &segment.curve else { return rest };
    let [velocity, acceleration, jerk] = curve.peak_rates();
    let (travel, width) = (segment.travel.abs(), segment.width);
    let peaks = [(velocity, 1), (acceleration, 2), (jerk, 3)]
        .map(|(found, power)| (found.value * travel / width.powi(power), segment.start + found.at * width));
    let (low, top) = range(segment);
    let (least, most) = (positions.0.min(positions.1), positions.0.max(positions.1));
    let over = (top - most).max(least - low).max(0.0);
    let rounding = ROUNDING * (top - low) + 8.0 * f64::EPSILON * most.abs().max(least.abs());
    SegmentSummary {
        // Rounding at the ends is not an overshoot.
        overshoot: if !segment.whole && over > rounding { over } else { 0.0 },
        range: (low, top),
        peaks,
        humps: curve.humps(),
        ..rest
    }
}

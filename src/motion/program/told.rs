//! What a program tells of its segments.

use super::{Program, State};
use crate::motion::Motion;
use crate::motion::laws::optimum::Optimum;
use crate::numeric::extremum;

/// How a segment begins or ends (VDI 2143).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Class {
    /// R: velocity and acceleration 0.
    Rest,
    /// G: a velocity without acceleration.
    Velocity,
    /// U: velocity 0 with an acceleration.
    Turn,
    /// B: velocity and acceleration.
    Motion,
}

impl Class {
    fn of(state: &State) -> Self {
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
pub struct SegmentTold {
    /// What its law is called.
    pub law: &'static str,
    /// How it begins and ends.
    pub classes: [Class; 2],
    /// First and last cam angle.
    pub angles: (f64, f64),
    /// First and last position.
    pub positions: (f64, f64),
    /// By how much the position leaves the range between its ends; 0 of a motion that is given in one.
    pub overshoot: f64,
    /// Smallest and largest position.
    pub range: (f64, f64),
    /// It is the whole motion, given in one.
    pub whole: bool,
    /// Largest sizes of velocity, acceleration and jerk, each with its cam angle; an acceleration that jumps has an infinite jerk.
    pub peaks: [(f64, f64); 3],
    /// Whether its acceleration keeps one sign in two humps.
    pub humps: bool,
    /// What its polynomial makes least, where it does.
    pub optimum: Option<Optimum>,
}

/// A jump of less than this share of the largest is rounding.
const ROUNDING: f64 = 1e-9;

/// A jump of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jump {
    /// 1 of the velocity, 2 of the acceleration, 3 of the jerk.
    pub order: u32,
    /// By how much, m or rad per rad to the order.
    pub by: f64,
    /// At which cam angle, rad.
    pub at: f64,
}

impl Program {
    /// Its segments, of the first lobe.
    #[must_use]
    pub fn segments(&self) -> &[SegmentTold] {
        self.told.get_or_init(|| self.segments.iter().map(told).collect())
    }

    /// The largest jump of the lowest derivative that jumps up to the jerk; `None` where none does.
    #[must_use]
    pub fn jump(&self) -> Option<Jump> {
        let pieces = self.distinct();
        let count = pieces.len();
        let of = |jet: crate::motion::Jet| [jet.ds, jet.dds, jet.ddds];
        let ends = |index: usize| {
            let piece = pieces.get(index)?;
            Some((of(self.jet(index, piece.start)), of(self.jet(index, piece.end)), piece.end))
        };
        let all: Vec<_> = (0..count).filter_map(ends).collect();
        let segments = self.segments();
        (0..3_usize).zip(1_u32..).find_map(|(order, derivative)| {
            let value = |all: &[f64; 3]| all.get(order).copied().unwrap_or(0.0);
            let largest = all.iter().flat_map(|(start, end, _)| [value(start).abs(), value(end).abs()]);
            // A dwell between other pieces says nothing of the size.
            let peaks = segments.iter().map(|segment| segment.peaks.get(order).map_or(0.0, |peak| peak.0));
            let size = largest.chain(peaks.filter(|peak| peak.is_finite())).fold(0.0, f64::max);
            let next = all.iter().cycle().skip(1);
            let jumps = all.iter().zip(next).map(|((_, end, at), (start, ..))| Jump {
                order: derivative,
                by: (value(start) - value(end)).abs(),
                at: *at,
            });
            let worst = jumps.max_by(|a, b| a.by.total_cmp(&b.by))?;
            (worst.by > ROUNDING * size).then_some(worst)
        })
    }
}

/// Least and largest position of a segment.
pub(super) fn range(segment: &super::Segment) -> (f64, f64) {
    let Some(curve) = &segment.curve else { return (segment.from, segment.from) };
    let ranges = (0..curve.parts()).map(|part| {
        let all = |x: f64| {
            let [value, slope, bend, _] = curve.at(part, x).map(|value| segment.travel * value);
            [segment.from + value, slope, bend]
        };
        let [top, low] = extremum::both_ways_with_bend(all, curve.range_of(part), curve.cells(part));
        (-low.value, top.value)
    });
    ranges.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, top), (l, t)| (low.min(l), top.max(t)))
}

fn told(segment: &super::Segment) -> SegmentTold {
    let [begin, end] = &segment.ends;
    let angles = (segment.start, segment.start + segment.width);
    let positions = (segment.from, if segment.curve.is_some() { segment.to } else { segment.from });
    let rest = SegmentTold {
        law: segment.name,
        classes: [Class::of(begin), Class::of(end)],
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
    let place = |found: extremum::Extremum, power: i32| {
        (found.value * travel / width.powi(power), segment.start + found.at * width)
    };
    let (low, top) = range(segment);
    let (least, most) = (positions.0.min(positions.1), positions.0.max(positions.1));
    let over = (top - most).max(least - low).max(0.0);
    let rounding = ROUNDING * (top - low) + 8.0 * f64::EPSILON * most.abs().max(least.abs());
    SegmentTold {
        // Rounding at the ends is no overshoot.
        overshoot: if !segment.whole && over > rounding { over } else { 0.0 },
        range: (low, top),
        peaks: [place(velocity, 1), place(acceleration, 2), place(jerk, 3)],
        humps: curve.humps(),
        ..rest
    }
}

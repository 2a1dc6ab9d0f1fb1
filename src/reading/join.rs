//! Loose segments joined end to end into chains.

use crate::geometry::contour::{Contour, Segment, Vertex};
use nalgebra::Vector2;
use std::collections::BTreeMap;

/// Segments, each starting where the one before ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Its segments, one at the least.
    pub segments: Vec<Segment>,
    /// The last ends where the first starts.
    pub closed: bool,
}

impl Chain {
    /// The chain as a contour, for a closed one.
    #[must_use]
    pub fn contour(&self) -> Contour {
        Contour { vertices: self.segments.iter().map(|s| Vertex { point: s.start, bulge: s.bulge }).collect() }
    }

    /// The gap between its ends, mm.
    #[must_use]
    pub fn gap(&self) -> f64 {
        match (self.segments.first(), self.segments.last()) {
            (Some(first), Some(last)) => (last.end - first.start).norm(),
            _ => 0.0,
        }
    }

    /// The same chain run the other way.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let segments = self.segments.iter().rev().map(|segment| reversed(*segment)).collect();
        Self { segments, closed: self.closed }
    }
}

fn reversed(segment: Segment) -> Segment {
    Segment { start: segment.end, end: segment.start, bulge: -segment.bulge }
}

/// A segment no longer than this has no length, mm: readers drop it, whatever reach its ends are joined with.
const NO_LENGTH: f64 = 1e-6;

/// Ends of two segments that are one lie nearer than this share of the segment.
const SAME_SHARE: f64 = 0.1;

pub(super) struct Joined {
    pub(super) chains: Vec<Chain>,
    pub(super) duplicates: Vec<Vector2<f64>>,
    pub(super) points: Vec<Vector2<f64>>,
}

/// Places seen through a grid whose cells are wider than the reach, so that only neighbouring cells are looked at.
struct Grid {
    cell: f64,
    places: BTreeMap<(i64, i64), Vec<usize>>,
}

impl Grid {
    fn new(reach: f64) -> Self {
        Self { cell: 2.0 * reach, places: BTreeMap::new() }
    }

    #[expect(clippy::cast_possible_truncation, reason = "a saturated cell still finds its own")]
    fn cell(&self, place: Vector2<f64>) -> (i64, i64) {
        ((place.x / self.cell).floor() as i64, (place.y / self.cell).floor() as i64)
    }

    fn insert(&mut self, place: Vector2<f64>, index: usize) {
        let cell = self.cell(place);
        self.places.entry(cell).or_default().push(index);
    }

    fn near(&self, place: Vector2<f64>) -> impl Iterator<Item = usize> + '_ {
        let (x, y) = self.cell(place);
        (-1..=1)
            .flat_map(move |dx| (-1..=1).map(move |dy| (x.saturating_add(dx), y.saturating_add(dy))))
            .filter_map(|cell| self.places.get(&cell))
            .flatten()
            .copied()
    }
}

/// Takes out segments without length and segments that lie on another, then joins the pieces end to end.
pub(super) fn join(pieces: Vec<Vec<Segment>>, others: &[Segment], reach: f64) -> Joined {
    let (mut duplicates, mut points) = (Vec::new(), Vec::new());
    let mut kept: Vec<Segment> = Vec::new();
    let mut by_middle = Grid::new(reach);
    let mut chains: Vec<Chain> = Vec::new();
    for piece in pieces {
        let mut segments: Vec<Segment> = Vec::new();
        for segment in piece {
            if (segment.end - segment.start).norm() <= reach.min(NO_LENGTH) {
                points.push(segment.start);
                continue;
            }
            let middle = segment.middle();
            if by_middle.near(middle).filter_map(|index| kept.get(index)).any(|other| same(&segment, other, reach)) {
                duplicates.push(middle);
                // What follows is no longer joined to what was before.
                chains.extend(started(std::mem::take(&mut segments)));
                continue;
            }
            by_middle.insert(middle, kept.len());
            kept.push(segment);
            segments.push(segment);
        }
        chains.extend(started(segments));
    }
    // The outline must not be repeated elsewhere.
    for other in others {
        if by_middle.near(other.middle()).filter_map(|index| kept.get(index)).any(|s| same(s, other, reach)) {
            duplicates.push(other.middle());
        }
    }
    let mut chains = joined(chains, reach);
    for chain in &mut chains {
        chain.closed = chain.gap() <= reach && (chain.segments.len() > 1);
    }
    Joined { chains, duplicates, points }
}

/// Whether two segments are one, within the reach but never beyond a tenth of their length.
fn same(a: &Segment, b: &Segment, reach: f64) -> bool {
    let reach = reach.min(SAME_SHARE * (a.end - a.start).norm());
    let close = |a: Vector2<f64>, b: Vector2<f64>| (a - b).norm() <= reach;
    close(a.middle(), b.middle())
        && (close(a.start, b.start) && close(a.end, b.end) || close(a.start, b.end) && close(a.end, b.start))
}

fn started(segments: Vec<Segment>) -> Option<Chain> {
    (!segments.is_empty()).then_some(Chain { segments, closed: false })
}

/// Joins chains as long as an end of one meets an end of another that is still free.
fn joined(chains: Vec<Chain>, reach: f64) -> Vec<Chain> {
    let mut by_end = Grid::new(reach);
    for (index, chain) in chains.iter().enumerate() {
        if let (Some(first), Some(last)) = (chain.segments.first(), chain.segments.last()) {
            by_end.insert(first.start, index);
            by_end.insert(last.end, index);
        }
    }
    let mut free: Vec<Option<Chain>> = chains.into_iter().map(Some).collect();
    let mut found = Vec::new();
    for index in 0..free.len() {
        let Some(mut chain) = free.get_mut(index).and_then(Option::take) else { continue };
        // Forwards as far as it goes, then the other way round, once.
        for _ in 0..2 {
            while chain.gap() > reach {
                let Some(end) = chain.segments.last().map(|s| s.end) else { break };
                let next = by_end.near(end).find_map(|other| {
                    let candidate = free.get(other)?.as_ref()?;
                    let starts = candidate.segments.first().is_some_and(|s| (s.start - end).norm() <= reach);
                    let ends = candidate.segments.last().is_some_and(|s| (s.end - end).norm() <= reach);
                    (starts || ends).then_some((other, starts))
                });
                let Some((other, forwards)) = next else { break };
                let Some(taken) = free.get_mut(other).and_then(Option::take) else { break };
                chain.segments.extend(if forwards { taken.segments } else { taken.reversed().segments });
            }
            chain = chain.reversed();
        }
        found.push(chain);
    }
    found
}

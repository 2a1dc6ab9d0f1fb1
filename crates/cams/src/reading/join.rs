//! Loose edges joined end to end into chains.

use super::EntitySource;
use super::limits::{WorkCount, check_length};
use super::walk::EntityCut;
use camgen_kernel::geometry::contour::{Contour, Edge};
use camgen_kernel::refusal::Refusal;
use nalgebra::Vector2;
use std::collections::{BTreeMap, BTreeSet};

/// Edges, each starting where the one before ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Its edges, at least one.
    pub edges: Vec<Edge>,
    /// Whether the last ends where the first starts.
    pub closed: bool,
    /// The entities it is made of.
    pub sources: Vec<EntitySource>,
}

impl Chain {
    /// A closed contour as a chain without sources.
    #[must_use]
    pub fn of(contour: &Contour) -> Self {
        Self { edges: contour.edges().collect(), closed: true, sources: Vec::new() }
    }

    /// The chain as a contour, for a closed one.
    #[must_use]
    pub fn contour(&self) -> Contour {
        Contour::from_edges(self.edges.iter().copied())
    }

    /// The gap between its ends, mm.
    #[must_use]
    pub fn gap(&self) -> f64 {
        match (self.edges.first(), self.edges.last()) {
            (Some(first), Some(last)) => (last.end() - first.start()).norm(),
            _ => 0.0,
        }
    }

    /// The chain in the opposite direction.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let edges = self.edges.iter().rev().map(Edge::reversed).collect();
        Self { edges, closed: self.closed, sources: self.sources.clone() }
    }

    /// The contour of a closed chain with its inside on the left.
    #[must_use]
    pub fn counter_clockwise(&self) -> Contour {
        let found = self.contour();
        // The direction in which a program wrote it does not change the part.
        if found.area_and_centroid().0 > 0.0 { found } else { self.reversed().contour() }
    }

    /// Whether all of it is on a layer, whose name is the same in capitals.
    #[must_use]
    pub fn on_layer(&self, layer: &str) -> bool {
        !self.sources.is_empty() && self.sources.iter().all(|source| source.on_layer(layer))
    }

    /// Whether a part of it is on the layer of the holes.
    pub(super) fn touches_bore(&self) -> bool {
        self.sources.iter().any(EntitySource::on_bore)
    }

    /// The layers that it is on: `0`, or `0, HOLES`.
    #[must_use]
    pub fn layers(&self) -> String {
        let mut names: Vec<String> = Vec::new();
        for source in self.sources.iter().filter(|source| !source.layer.is_empty()) {
            if !names.contains(&source.layer) {
                names.push(source.layer.clone());
            }
        }
        super::few(&names)
    }

    /// Refuses a chain with so many segments on top of each other that measuring it would take too long.
    pub(super) fn check_length(&self) -> Result<(), Refusal> {
        let ends = || self.edges.iter().flat_map(|edge| [edge.start(), edge.end()]);
        let (low, high) = ends().fold(
            (Vector2::repeat(f64::INFINITY), Vector2::repeat(f64::NEG_INFINITY)),
            |(low, high): (Vector2<f64>, Vector2<f64>), end| (low.inf(&end), high.sup(&end)),
        );
        check_length(self.edges.len(), self.edges.iter().map(Edge::length).sum(), (high - low).norm())
    }

    /// What it is made of and where, for a message: "CIRCLE on layer BORE".
    #[must_use]
    pub fn names(&self) -> String {
        let names: Vec<String> = self.sources.iter().take(MOST_NAMES).map(ToString::to_string).collect();
        let more = if self.sources.len() > MOST_NAMES { " and more" } else { "" };
        format!("{}{more}", names.join(", "))
    }
}

/// Sources of a chain that a message names.
const MOST_NAMES: usize = 3;

/// A segment no longer than this counts as without length, mm: readers drop it, whatever the joining distance.
const NO_LENGTH: f64 = 1e-6;

/// Two ends count as one, and a chain counts as closed, where they are nearer than this share of its length.
const SAME_SHARE: f64 = 0.1;

pub(super) struct JoinedChains {
    /// The chains on the layer of the outline.
    pub(super) outline: Vec<Chain>,
    /// The chains on all other layers.
    pub(super) others: Vec<Chain>,
    pub(super) duplicates: Vec<Vector2<f64>>,
    /// Largest distance of a duplicate from what it repeats, mm; infinite where an entity repeats a part of itself.
    pub(super) duplicates_apart: f64,
    pub(super) points: Vec<Vector2<f64>>,
}

/// Width of a cell of the grid over the reach.
const CELL: f64 = 4.0;
/// Ends near an end beyond which no nearer one is looked for.
const MANY: usize = 1000;
/// Number of edges near a middle that are examined before a smaller group is looked for.
const FEW: usize = 8;

/// Places in a grid whose cells are wider than the reach, so that at most four cells are examined.
struct PlaceGrid {
    reach: f64,
    places: BTreeMap<(i64, i64), Vec<usize>>,
}

impl PlaceGrid {
    fn new(reach: f64) -> Self {
        Self { reach, places: BTreeMap::new() }
    }

    #[expect(clippy::cast_possible_truncation, reason = "a saturated cell still finds its own")]
    fn cell(&self, place: Vector2<f64>) -> (i64, i64) {
        let cell = CELL * self.reach;
        ((place.x / cell).floor() as i64, (place.y / cell).floor() as i64)
    }

    fn insert(&mut self, place: Vector2<f64>, index: usize) {
        let cell = self.cell(place);
        self.places.entry(cell).or_default().push(index);
    }

    /// The cells that come within reach of a place.
    fn about(&self, place: Vector2<f64>) -> impl Iterator<Item = (i64, i64)> + use<> {
        let corner = Vector2::new(self.reach, self.reach);
        let (low, high) = (self.cell(place - corner), self.cell(place + corner));
        (low.0..=high.0).flat_map(move |x| (low.1..=high.1).map(move |y| (x, y)))
    }

    /// The lists of the cells about a place, and their total length.
    fn near(&self, place: Vector2<f64>) -> (Vec<&[usize]>, usize) {
        let lists: Vec<&[usize]> =
            self.about(place).filter_map(|cell| self.places.get(&cell)).map(Vec::as_slice).collect();
        let count = lists.iter().map(|list| list.len()).sum();
        (lists, count)
    }

    /// The item nearest to a place, no farther away than the reach, and its distance; places no farther away than
    /// [`NO_LENGTH`] are equally near. Items that are gone are removed for good. `looked` counts the examined items.
    fn nearest(
        &mut self,
        place: Vector2<f64>,
        gone: impl Fn(usize) -> bool,
        away: impl Fn(usize) -> f64,
        looked: &mut usize,
    ) -> Option<(f64, usize)> {
        let mut nearest: Option<(f64, usize)> = None;
        let mut met = 0;
        for cell in self.about(place) {
            let Some(list) = self.places.get_mut(&cell) else { continue };
            let mut index = 0;
            while let Some(candidate) = list.get(index).copied() {
                if gone(candidate) {
                    list.swap_remove(index);
                    continue;
                }
                index += 1;
                *looked += 1;
                let distance = away(candidate);
                if distance > self.reach {
                    continue;
                }
                if nearest.is_none_or(|(least, _)| distance < least) {
                    nearest = Some((distance, candidate));
                }
                met += 1;
                if distance <= NO_LENGTH || met >= MANY {
                    return nearest;
                }
            }
        }
        nearest
    }
}

/// Segments that were kept, found by their middles and by their ends: of many segments that share one of these few share another.
struct EdgeIndex {
    edges: Vec<Edge>,
    /// Of each the entity that it belongs to.
    entities: Vec<usize>,
    by_middle: PlaceGrid,
    /// By start, and by end, once too many have a middle in common.
    by_ends: Option<[PlaceGrid; 2]>,
    reach: f64,
}

impl EdgeIndex {
    fn new(reach: f64) -> Self {
        Self { edges: Vec::new(), entities: Vec::new(), by_middle: PlaceGrid::new(reach), by_ends: None, reach }
    }

    /// How far an edge of an entity is from the one that it repeats, mm, infinite where both belong to that entity; `None` where it
    /// repeats none.
    fn repeats(&mut self, edge: &Edge, entity: usize, effort: &mut WorkCount) -> Result<Option<f64>, Refusal> {
        let (start, end) = (edge.start(), edge.end());
        let middles = self.by_middle.near(edge.middle());
        let mut found = |(lists, count): &(Vec<&[usize]>, usize)| {
            effort.compared(*count)?;
            let all = lists.iter().flat_map(|list| list.iter()).copied();
            let mut all = all.filter_map(|index| Some((self.edges.get(index)?, self.entities.get(index)?)));
            let repeated = all.find(|(other, _)| same(edge, other, self.reach));
            Ok(repeated.map(|(other, of)| if *of == entity { f64::INFINITY } else { apart(edge, other) }))
        };
        if middles.1 <= FEW {
            return found(&middles);
        }
        let [by_start, by_end] = self.by_ends.get_or_insert_with(|| ends_of(&self.edges, self.reach));
        // A duplicate of a segment starts where this one starts or ends.
        let (there, back) = (by_start.near(start), by_end.near(start));
        if middles.1 <= there.1 + back.1 {
            return found(&middles);
        }
        let (forth, round) = (by_end.near(end), by_start.near(end));
        let (first, then) = if there.1 + back.1 <= forth.1 + round.1 { (&there, &back) } else { (&forth, &round) };
        match found(first)? {
            Some(apart) => Ok(Some(apart)),
            None => found(then),
        }
    }

    fn add(&mut self, edge: Edge, entity: usize) {
        let index = self.edges.len();
        self.by_middle.insert(edge.middle(), index);
        if let Some([by_start, by_end]) = &mut self.by_ends {
            by_start.insert(edge.start(), index);
            by_end.insert(edge.end(), index);
        }
        self.edges.push(edge);
        self.entities.push(entity);
    }
}

/// Edges by their starts, and by their ends.
fn ends_of(edges: &[Edge], reach: f64) -> [PlaceGrid; 2] {
    let mut grids = [PlaceGrid::new(reach), PlaceGrid::new(reach)];
    let [by_start, by_end] = &mut grids;
    for (index, edge) in edges.iter().enumerate() {
        by_start.insert(edge.start(), index);
        by_end.insert(edge.end(), index);
    }
    grids
}

/// Segments in a row with the indices of their sources, and their total length, mm.
struct EdgeLink {
    edges: Vec<Edge>,
    sources: BTreeSet<usize>,
    length: f64,
}

impl EdgeLink {
    fn of(edges: Vec<Edge>, source: usize) -> Option<Self> {
        let length = edges.iter().map(Edge::length).sum();
        (!edges.is_empty()).then(|| Self { edges, sources: BTreeSet::from([source]), length })
    }

    fn ends(&self) -> Option<(Vector2<f64>, Vector2<f64>)> {
        Some((self.edges.first()?.start(), self.edges.last()?.end()))
    }

    /// The distance of its ends where it may be closed by itself: a few short edges within the reach are not a loop.
    fn gap(&self, reach: f64) -> Option<f64> {
        let (start, end) = self.ends().filter(|_| self.edges.len() > 1)?;
        let gap = (end - start).norm();
        (gap <= reach.min(SAME_SHARE * self.length)).then_some(gap)
    }

    fn open(&self, reach: f64) -> bool {
        self.gap(reach).is_none()
    }

    fn reverse(&mut self) {
        self.edges.reverse();
        for edge in &mut self.edges {
            *edge = edge.reversed();
        }
    }
}

/// Takes out edges without length and edges that lie on another one, then joins the rest end to end: the outline, and
/// everything else that would be cut.
///
/// # Errors
/// [`Refusal`] where too many segments lie within the reach of each other.
pub(super) fn join(
    cuts: Vec<EntityCut>,
    (sources, layer): (&[EntitySource], &str),
    reach: f64,
    effort: &mut WorkCount,
) -> Result<JoinedChains, Refusal> {
    let (mut duplicates, mut duplicates_apart, mut points) = (Vec::new(), 0.0_f64, Vec::new());
    let mut known = EdgeIndex::new(reach);
    let (mut outline, mut others) = (Vec::new(), Vec::new());
    let on_outline = |cut: &EntityCut| sources.get(cut.source).is_some_and(|source| source.on_layer(layer));
    // The outline first: what repeats it belongs to the rest.
    let (first, then): (Vec<EntityCut>, Vec<EntityCut>) = cuts.into_iter().partition(on_outline);
    let mut entity = 0;
    for (cuts, links) in [(first, &mut outline), (then, &mut others)] {
        for EntityCut { edges: all, source, .. } in cuts {
            entity += 1;
            let mut edges: Vec<Edge> = Vec::with_capacity(all.len());
            for edge in all {
                if (edge.end() - edge.start()).norm() <= reach.min(NO_LENGTH) {
                    points.push(edge.start());
                } else if let Some(apart) = known.repeats(&edge, entity, effort)? {
                    duplicates.push(edge.middle());
                    duplicates_apart = duplicates_apart.max(apart);
                    // From here on nothing is joined to what came before.
                    links.extend(EdgeLink::of(std::mem::take(&mut edges), source));
                } else {
                    known.add(edge, entity);
                    edges.push(edge);
                }
            }
            links.extend(EdgeLink::of(edges, source));
        }
    }
    let mut chains = |links| -> Result<Vec<Chain>, Refusal> {
        Ok(joined(links, reach, effort)?.into_iter().map(|link| chain(link, sources, reach)).collect())
    };
    Ok(JoinedChains { outline: chains(outline)?, others: chains(others)?, duplicates, duplicates_apart, points })
}

fn chain(link: EdgeLink, sources: &[EntitySource], reach: f64) -> Chain {
    let closed = !link.open(reach);
    let sources = link.sources.iter().filter_map(|index| sources.get(*index)).cloned().collect();
    Chain { edges: link.edges, closed, sources }
}

/// Whether two edges coincide, within the reach but never beyond a tenth of their length.
fn same(a: &Edge, b: &Edge, reach: f64) -> bool {
    let reach = reach.min(SAME_SHARE * (a.end() - a.start()).norm());
    let close = |a: Vector2<f64>, b: Vector2<f64>| (a - b).norm() <= reach;
    // Three points distinguish arcs and lines, a cubic curve needs more.
    let between = |a: &Edge, b: &Edge| {
        [0.25, 0.75].iter().all(|share| close(a.point_and_tangent(*share).0, b.point_and_tangent(*share).0))
    };
    let ends = close(a.start(), b.start()) && close(a.end(), b.end())
        || close(a.start(), b.end()) && close(a.end(), b.start());
    close(a.middle(), b.middle())
        && (ends && (a.segment().is_some() && b.segment().is_some() || between(a, b) || between(a, &b.reversed())))
}

/// Largest distance between two edges that coincide, mm, at their ends and at places between them.
fn apart(a: &Edge, b: &Edge) -> f64 {
    let between = |b: &Edge| {
        let at = |share: f64| (a.point_and_tangent(share).0 - b.point_and_tangent(share).0).norm();
        [0.0, 0.25, 0.5, 0.75, 1.0].into_iter().map(at).fold(0.0, f64::max)
    };
    between(b).min(between(&b.reversed()))
}

/// Joins links as long as an end of one meets a free end of another, the nearest first: among edges shorter
/// than the reach this is the one that follows. A chain whose ends meet goes on where a free end is nearer than its own.
fn joined(links: Vec<EdgeLink>, reach: f64, effort: &mut WorkCount) -> Result<Vec<EdgeLink>, Refusal> {
    // Coinciding ends are found at once, however many others are within reach.
    let mut by_end = [PlaceGrid::new(reach.min(NO_LENGTH)), PlaceGrid::new(reach)];
    for (index, link) in links.iter().enumerate() {
        // A link that is closed by itself is not joined to anything.
        if let Some((start, end)) = link.ends().filter(|_| link.open(reach)) {
            for grid in &mut by_end {
                grid.insert(start, index);
                grid.insert(end, index);
            }
        }
    }
    let ends: Vec<Option<(Vector2<f64>, Vector2<f64>)>> = links.iter().map(EdgeLink::ends).collect();
    let mut free: Vec<Option<EdgeLink>> = links.into_iter().map(Some).collect();
    let mut found = Vec::new();
    for index in 0..free.len() {
        let Some(mut link) = free.get_mut(index).and_then(Option::take) else { continue };
        let alone = !link.open(reach);
        // Forwards as far as possible, then backwards, once.
        for _ in 0..2 {
            while let Some((_, end)) = link.ends().filter(|_| !alone) {
                let gap = link.gap(reach);
                if gap.is_some_and(|gap| gap <= NO_LENGTH) {
                    break;
                }
                let gone = |other: usize| free.get(other).is_none_or(Option::is_none);
                let away = |other: usize| {
                    let ends = ends.get(other).copied().flatten();
                    ends.map_or(f64::INFINITY, |(a, b)| (a - end).norm().min((b - end).norm()))
                };
                let mut looked = 0;
                let nearest = by_end.iter_mut().find_map(|grid| grid.nearest(end, gone, away, &mut looked));
                effort.compared(looked)?;
                let Some((_, other)) = nearest.filter(|(distance, _)| gap.is_none_or(|gap| *distance < gap)) else {
                    break;
                };
                let Some(mut taken) = free.get_mut(other).and_then(Option::take) else { break };
                if taken.ends().is_some_and(|(start, last)| (last - end).norm() < (start - end).norm()) {
                    taken.reverse();
                }
                link.length += taken.length;
                link.edges.extend(taken.edges);
                link.sources.extend(taken.sources);
            }
            link.reverse();
        }
        found.push(link);
    }
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::geometry::contour::Segment;

    /// A round of segments, some of them far shorter than the reach, in any order and either direction.
    #[test]
    fn segments_shorter_than_the_reach_are_joined_in_a_row() {
        let lengths = |i: u32| if i % 50 < 20 { 1e-3 } else { 0.05 };
        let total: f64 = (0..1000).map(lengths).sum();
        let mut place = 0.0;
        let mut ring: Vec<Edge> = Vec::new();
        let at = |along: f64| {
            let angle = std::f64::consts::TAU * along / total;
            Vector2::new(9.0 * libm::cos(angle), 9.0 * libm::sin(angle))
        };
        for i in 0..1000 {
            // Ends that were rounded.
            let rounding = 1e-9 * f64::from(i % 3);
            let (start, end) = (at(place), at(place + lengths(i)).add_scalar(rounding));
            ring.push(Edge::Segment(Segment { start, end, bulge: 0.0 }));
            place += lengths(i);
        }
        // 389 has no factor in common with 1000.
        let mixed = (0..1000).map(|i| (i * 389 + 7) % 1000).filter_map(|i| ring.get(i).copied());
        let turned = mixed.enumerate().map(|(i, s)| if i % 3 == 0 { s.reversed() } else { s });
        let links = || turned.clone().filter_map(|segment| EdgeLink::of(vec![segment], 0)).collect::<Vec<_>>();
        let found = joined(links(), 4e-3, &mut WorkCount::default()).expect("few");
        assert_eq!(found.len(), 1);
        assert!(found.iter().all(|link| !link.open(4e-3) && link.edges.len() == 1000));
        for (a, b) in found.iter().flat_map(|link| link.edges.iter().zip(link.edges.iter().skip(1))) {
            assert!((b.start() - a.end()).norm() < 1e-8, "{a:?} {b:?}");
        }
    }
}

//! A true section through a part that is stacked of plane layers: what the cutting plane meets, and the edges that are seen behind it.

use super::contour::{Contour, Edge, Extents};
use nalgebra::Vector2;

/// Halvings of a part: below the resolution of its parameter.
const HALVINGS: u32 = 52;
/// Places nearer to each other than this, mm, are one.
const SAME: f64 = 1e-7;
/// How far beside a place, mm, the surfaces on either side of it are looked at.
const BESIDE: f64 = 1e-5;
/// Surfaces on either side of a place that lie farther behind each other than this, mm, have an edge between them.
const STEP: f64 = 0.1;
/// A joint that turns by more than this, rad, is an edge.
const SHARP: f64 = 0.09;
/// A sharp edge that lies farther behind the surface in front than this, mm, is hidden.
const IN_FRONT: f64 = 0.01;

/// A layer of a part: the rims that bound its metal, by their places in the list of all, and its heights, mm.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionLayer {
    /// Places of its rims in the list of all.
    pub rims: Vec<usize>,
    /// Where it begins, mm; layers follow each other without a gap.
    pub low: f64,
    /// Where it ends, mm.
    pub high: f64,
}

/// An edge that is seen: of the cut surface, or behind it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionEdge {
    /// One end: along the cutting line and in height, mm.
    pub from: Vector2<f64>,
    /// The other end.
    pub to: Vector2<f64>,
    /// The rim that the plane cuts there.
    pub rim: Option<usize>,
}

/// A section through the origin. Its coordinates are the way along the cutting line and the height, mm.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Section {
    /// The cut surface, as rectangles.
    pub cut: Vec<Extents>,
    /// All edges that are seen.
    pub edges: Vec<SectionEdge>,
}

/// What is in front at a place of a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Front {
    /// Nothing, the plane of the section, or a surface so far behind it (negative, mm).
    Nothing,
    Cut,
    Behind(f64),
}

impl Front {
    fn differs(self, other: Self, step: f64) -> bool {
        match (self, other) {
            (Self::Behind(one), Self::Behind(two)) => (one - two).abs() > step,
            (one, two) => one != two,
        }
    }
}

/// A place along the cutting line where what is in front may change.
#[derive(Debug, Clone, Copy)]
struct Break {
    along: f64,
    rim: usize,
    /// How far behind the plane a sharp edge stands there, mm.
    sharp: Option<f64>,
}

/// The section along a direction (a unit vector) through the origin, of a part that is seen from the left of that direction: what lies to the left is
/// cut away.
///
/// ```
/// # use camgen_kernel as camgen;
/// use camgen::geometry::section::{SectionLayer, section};
/// use camgen::{Contour, Vector2};
///
/// // A ring of Ø40 and Ø20, 6 mm high.
/// let rims = [Contour::circle(Vector2::zeros(), 20.0), Contour::circle(Vector2::zeros(), 10.0)];
/// let layer = SectionLayer { rims: vec![0, 1], low: 0.0, high: 6.0 };
/// let found = section(&rims, &[layer], Vector2::x());
/// let cut: Vec<[f64; 2]> = found.cut.iter().map(|field| [field.least.x.round(), field.largest.x.round()]).collect();
/// assert_eq!(cut, [[-20.0, -10.0], [10.0, 20.0]]);
/// ```
#[must_use]
pub fn section(rims: &[Contour], layers: &[SectionLayer], along: Vector2<f64>) -> Section {
    let breaks = breaks(rims, along);
    let mut found = Section::default();
    let fronts: Vec<Vec<Front>> = layers.iter().map(|layer| fronts_between(rims, layer, &breaks, along)).collect();
    for (layer, fronts) in layers.iter().zip(&fronts) {
        for (ends, front) in breaks.windows(2).zip(fronts) {
            if let ([from, to], Front::Cut) = (ends, front) {
                let least = Vector2::new(from.along, layer.low);
                join(&mut found.cut, Extents { least, largest: Vector2::new(to.along, layer.high) });
            }
        }
        for place in &breaks {
            found.edges.extend(upright_edge(rims, layer, place, along));
        }
    }
    let nothing = vec![Front::Nothing; breaks.len().saturating_sub(1)];
    let below = std::iter::once(&nothing).chain(&fronts);
    let above = fronts.iter().chain(std::iter::once(&nothing));
    let heights = layers.iter().map(|layer| layer.low).chain(layers.last().map(|layer| layer.high));
    for ((below, above), height) in below.zip(above).zip(heights) {
        level_edges(&breaks, (below, above), height, &mut found.edges);
    }
    found
}

/// Adds a rectangle to the last one where it continues it.
fn join(cut: &mut Vec<Extents>, next: Extents) {
    match cut.last_mut() {
        Some(last) if last.largest.x == next.least.x && last.least.y == next.least.y => last.largest.x = next.largest.x,
        _ => cut.push(next),
    }
}

/// What is in front between neighbouring places.
fn fronts_between(rims: &[Contour], layer: &SectionLayer, breaks: &[Break], along: Vector2<f64>) -> Vec<Front> {
    let middles = breaks.windows(2).filter_map(|ends| match ends {
        [from, to] => Some(0.5 * (from.along + to.along)),
        _ => None,
    });
    middles.map(|place| front(rims, layer, place, along)).collect()
}

/// The edge across a layer at a place, where one is seen.
fn upright_edge(rims: &[Contour], layer: &SectionLayer, place: &Break, along: Vector2<f64>) -> Option<SectionEdge> {
    if !layer.rims.contains(&place.rim) {
        return None;
    }
    let [left, right] = [-BESIDE, BESIDE].map(|beside| front(rims, layer, place.along + beside, along));
    let is_cut = (left == Front::Cut) != (right == Front::Cut);
    let is_seen = |behind: f64| {
        [left, right].iter().any(|front| matches!(front, Front::Behind(front) if (front - behind).abs() < IN_FRONT))
    };
    let edge = left.differs(right, STEP) || place.sharp.is_some_and(is_seen);
    edge.then(|| SectionEdge {
        from: Vector2::new(place.along, layer.low),
        to: Vector2::new(place.along, layer.high),
        rim: is_cut.then_some(place.rim),
    })
}

/// The edges along a height, where what is in front above it is another than below.
fn level_edges(breaks: &[Break], (below, above): (&[Front], &[Front]), height: f64, edges: &mut Vec<SectionEdge>) {
    let mut open: Option<SectionEdge> = None;
    for (ends, (below, above)) in breaks.windows(2).zip(below.iter().zip(above)) {
        let [from, to] = ends else { continue };
        let end = Vector2::new(to.along, height);
        if !below.differs(*above, SAME) {
            edges.extend(open.take());
            continue;
        }
        let start = Vector2::new(from.along, height);
        open.get_or_insert(SectionEdge { from: start, to: end, rim: None }).to = end;
    }
    edges.extend(open);
}

/// What is in front of a layer at a place along the cutting line.
fn front(rims: &[Contour], layer: &SectionLayer, place: f64, along: Vector2<f64>) -> Front {
    let away = Vector2::new(-along.y, along.x);
    let own = layer.rims.iter().filter_map(|index| rims.get(*index));
    let mut crossings: Vec<f64> = own.flat_map(|rim| crossings(rim, along * place, away)).collect();
    crossings.sort_by(f64::total_cmp);
    let mut nearest = Front::Nothing;
    for metal in crossings.chunks_exact(2) {
        match metal {
            [low, high] if *low <= 0.0 && *high >= 0.0 => return Front::Cut,
            [_, high] if *high < 0.0 => nearest = Front::Behind(*high),
            _ => {}
        }
    }
    nearest
}

/// Where a contour crosses the line through a point along a direction (a unit vector): how far from the point.
#[must_use]
pub fn crossings(contour: &Contour, origin: Vector2<f64>, along: Vector2<f64>) -> Vec<f64> {
    let beside = |point: Vector2<f64>| along.perp(&(point - origin));
    // An edge does not reach farther from its start than its length.
    let near = contour.edges().filter(|edge| beside(edge.start()).abs() <= edge.length() + SAME);
    let places = near.flat_map(|edge| {
        // Between the places where it runs along the line it crosses the line once at most.
        let turns = changes(&edge, &WHOLE, |edge, share| along.perp(&edge.point_and_tangent(share).1));
        let ends: Vec<f64> = std::iter::once(0.0).chain(turns).chain([1.0]).collect();
        let shares = changes(&edge, &ends, |edge, share| beside(at(edge, share)));
        shares.into_iter().map(move |share| along.dot(&(at(&edge, share) - origin)))
    });
    places.collect()
}

/// A point of an edge; its ends to the last digit, which it shares with its neighbours.
fn at(edge: &Edge, share: f64) -> Vector2<f64> {
    if share == 0.0 {
        edge.start()
    } else if share == 1.0 {
        edge.end()
    } else {
        edge.point_and_tangent(share).0
    }
}

/// The ends of the parts of an edge that are looked at one by one.
const WHOLE: [f64; 9] = [0.0, 0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0];

/// The shares of an edge at which a value changes its sign, with one change at most between two of the ends.
fn changes(edge: &Edge, ends: &[f64], value: impl Fn(&Edge, f64) -> f64) -> Vec<f64> {
    let mut found = Vec::new();
    for part in ends.windows(2) {
        let &[mut from, mut to] = part else { continue };
        let is_positive = value(edge, from) >= 0.0;
        if is_positive == (value(edge, to) >= 0.0) {
            continue;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (from + to);
            if (value(edge, middle) >= 0.0) == is_positive { from = middle } else { to = middle }
        }
        found.push(0.5 * (from + to));
    }
    found
}

/// The places along the cutting line where what is in front may change, in order.
fn breaks(rims: &[Contour], along: Vector2<f64>) -> Vec<Break> {
    let away = Vector2::new(-along.y, along.x);
    let mut found: Vec<Break> = Vec::new();
    for (rim, contour) in rims.iter().enumerate() {
        let place = |along| Break { along, rim, sharp: None };
        found.extend(crossings(contour, Vector2::zeros(), along).into_iter().map(place));
        let edges: Vec<Edge> = contour.edges().collect();
        let before = edges.iter().cycle().skip(edges.len().saturating_sub(1));
        for (edge, before) in edges.iter().zip(before) {
            for share in changes(edge, &WHOLE, |edge, share| along.dot(&edge.point_and_tangent(share).1)) {
                let point = at(edge, share);
                if away.dot(&point) < 0.0 {
                    found.push(place(along.dot(&point)));
                }
            }
            let [arrives, leaves] = [before.point_and_tangent(1.0).1, edge.point_and_tangent(0.0).1];
            let behind = away.dot(&edge.start());
            let turn = libm::atan2(arrives.perp(&leaves), arrives.dot(&leaves));
            let turns_back = (along.dot(&arrives) >= 0.0) != (along.dot(&leaves) >= 0.0);
            if behind < 0.0 && (turn.abs() > SHARP || turns_back) {
                let sharp = (turn.abs() > SHARP).then_some(behind);
                found.push(Break { sharp, ..place(along.dot(&edge.start())) });
            }
        }
    }
    found.sort_by(|one, other| one.along.total_cmp(&other.along));
    found.dedup_by(|next, before| {
        let is_same = next.along - before.along < SAME && next.rim == before.rim;
        if is_same {
            before.sharp = before.sharp.or(next.sharp);
        }
        is_same
    });
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cut_of(found: &Section) -> Vec<[f64; 4]> {
        found.cut.iter().map(|field| [field.least.x, field.largest.x, field.least.y, field.largest.y]).collect()
    }

    fn has_edge(found: &Section, from: [f64; 2], to: [f64; 2]) -> bool {
        let near = |point: Vector2<f64>, [x, y]: [f64; 2]| (point - Vector2::new(x, y)).norm() < 1e-6;
        found.edges.iter().any(|edge| near(edge.from, from) && near(edge.to, to))
    }

    /// An eccentric disc: the half behind the plane is wider than the cut, by the closed form of the circle.
    #[test]
    fn the_half_behind_the_plane_is_seen_beside_the_cut() {
        let (low, radius) = (-5.0, 13.0);
        let rims = [Contour::circle(Vector2::new(1.0, low), radius)];
        let layer = SectionLayer { rims: vec![0], low: 2.0, high: 7.0 };
        let half = (radius * radius - low * low).sqrt();
        let behind = section(&rims, std::slice::from_ref(&layer), Vector2::x());
        assert_eq!(cut_of(&behind).len(), 1);
        for (found, known) in cut_of(&behind)[0].iter().zip([1.0 - half, 1.0 + half, 2.0, 7.0]) {
            assert!((found - known).abs() < 1e-11, "{found} {known}");
        }
        assert!(has_edge(&behind, [1.0 - radius, 2.0], [1.0 - radius, 7.0]), "{:?}", behind.edges);
        assert!(has_edge(&behind, [1.0 + half, 2.0], [1.0 + half, 7.0]), "{:?}", behind.edges);
        // Seen from the other side the narrower half is left, and lies behind the cut.
        let narrow = section(&rims, &[layer], -Vector2::x());
        assert_eq!(narrow.edges.len(), 4, "{:?}", narrow.edges);
    }

    /// A pocket in a plate: its floor, its walls where the plane cuts them, and the far wall's upper edge across the opening.
    #[test]
    fn a_pocket_shows_its_floor_and_its_walls() {
        let circle = |radius: f64| Contour::circle(Vector2::zeros(), radius);
        let rims = [circle(50.0), circle(40.0).reversed(), circle(30.0), circle(10.0).reversed()];
        let layers = [
            SectionLayer { rims: vec![0, 3], low: 0.0, high: 12.0 },
            SectionLayer { rims: vec![0, 1, 2, 3], low: 12.0, high: 20.0 },
        ];
        let found = section(&rims, &layers, Vector2::y());
        let ends = [[10.0, 30.0], [40.0, 50.0]];
        for (field, [from, to]) in found.cut.iter().rev().zip(ends.iter().rev()) {
            assert!((field.least.x - from).abs() < 1e-9 && (field.largest.x - to).abs() < 1e-9, "{field:?}");
        }
        assert_eq!(found.cut.len(), 6);
        assert!(has_edge(&found, [-50.0, 20.0], [50.0, 20.0]), "{:?}", found.edges);
        assert!(has_edge(&found, [30.0, 12.0], [40.0, 12.0]), "{:?}", found.edges);
        let wall = found.edges.iter().find(|edge| (edge.from.x - 30.0).abs() < 1e-9 && edge.from.y == 12.0);
        assert!(found.edges.iter().any(|edge| edge.rim == Some(2)) && wall.is_some(), "{:?}", found.edges);
    }

    /// A keyway: its side is an edge behind the plane, where it meets the bore.
    #[test]
    fn the_side_of_a_keyway_is_an_edge() {
        use crate::geometry::contour::Vertex;
        let (radius, half, deep) = (12.0_f64, 4.0, 15.3);
        let meet = (radius * radius - half * half).sqrt();
        let corner = |x: f64, y: f64, bulge: f64| Vertex::new(Vector2::new(x, y), bulge);
        let sweep = std::f64::consts::TAU - 2.0 * libm::asin(half / radius);
        let bore = Contour {
            vertices: vec![
                corner(meet, half, libm::tan(0.25 * sweep)),
                corner(meet, -half, 0.0),
                corner(deep, -half, 0.0),
                corner(deep, half, 0.0),
            ],
        };
        let rims = [Contour::circle(Vector2::zeros(), 30.0), bore.reversed()];
        let found = section(&rims, &[SectionLayer { rims: vec![0, 1], low: 0.0, high: 5.0 }], Vector2::x());
        assert!(has_edge(&found, [meet, 0.0], [meet, 5.0]), "{:?}", found.edges);
        assert!(has_edge(&found, [deep, 0.0], [deep, 5.0]) && has_edge(&found, [-radius, 0.0], [-radius, 5.0]));
    }
}

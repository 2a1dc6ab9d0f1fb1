//! A closed chain of circular arcs, lines and cubic curves in the drawing plane, millimetres: what a shop cuts.
//!
//! A vertex carries the edge that leaves it: the bulge of an arc, tan(sweep/4), positive where it turns left and 0 for a straight
//! line, or the inner control points of a cubic Bézier curve. The last edge ends in the first vertex.

pub use super::cubic::Cubic;
pub use super::edge::{Bend, Edge};
pub(crate) use super::segment::sweep_minus_sine;
pub use super::segment::{Extents, NearestOnSegment, Segment};

use crate::numeric::quadrature;
use nalgebra::Vector2;

/// Panels of Gauss's rule on an edge.
const PANELS: u32 = 4;

/// A vertex and how the chain leaves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertex {
    /// Place, mm.
    pub point: Vector2<f64>,
    /// The edge to the next one.
    pub bend: Bend,
}

impl Vertex {
    /// A vertex from which an arc of this bulge starts; 0 is a straight line.
    #[must_use]
    pub fn new(point: Vector2<f64>, bulge: f64) -> Self {
        Self { point, bend: Bend::Arc(bulge) }
    }

    /// The edge from here to a point, mm.
    #[must_use]
    pub fn to(&self, end: Vector2<f64>) -> Edge {
        match self.bend {
            Bend::Arc(bulge) => Edge::Segment(Segment { start: self.point, end, bulge }),
            Bend::Cubic([leaves, arrives]) => Edge::Cubic(Cubic { points: [self.point, leaves, arrives, end] }),
        }
    }

    /// The bulge of the edge that starts here, where that is an arc or a line.
    #[must_use]
    pub fn bulge(&self) -> Option<f64> {
        match self.bend {
            Bend::Arc(bulge) => Some(bulge),
            Bend::Cubic(_) => None,
        }
    }
}

/// A closed chain.
///
/// ```
/// # use camgen_kernel as camgen;
/// use camgen::{Contour, Vector2, Vertex};
///
/// // A slot of 30 mm by 10 mm with round ends: two lines and two half circles.
/// let vertex = |x: f64, y: f64, bulge: f64| Vertex::new(Vector2::new(x, y), bulge);
/// let slot = Contour { vertices: vec![vertex(0.0, 0.0, 0.0), vertex(20.0, 0.0, 1.0), vertex(20.0, 10.0, 0.0), vertex(0.0, 10.0, 1.0)] };
/// assert_eq!((slot.lines(), slot.arcs()), (2, 2));
/// let (area, centroid) = slot.area_and_centroid();
/// assert!((area - (200.0 + 25.0 * std::f64::consts::PI)).abs() < 1e-9 && (centroid.x - 10.0).abs() < 1e-9);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Contour {
    /// Its vertices, at least two.
    pub vertices: Vec<Vertex>,
}

impl Contour {
    /// The contour with all of its lengths multiplied, about the origin.
    #[must_use]
    pub fn scaled(&self, scale: f64) -> Self {
        let vertices = self.vertices.iter().map(|vertex| {
            let bend = match vertex.bend {
                Bend::Arc(bulge) => Bend::Arc(bulge),
                Bend::Cubic([leaves, arrives]) => Bend::Cubic([leaves * scale, arrives * scale]),
            };
            Vertex { point: vertex.point * scale, bend }
        });
        Self { vertices: vertices.collect() }
    }

    /// The contour at another place, mm.
    #[must_use]
    pub fn moved(&self, by: Vector2<f64>) -> Self {
        let vertices = self.vertices.iter().map(|vertex| Vertex { point: vertex.point + by, ..*vertex });
        Self { vertices: vertices.collect() }
    }

    /// A full circle, counter-clockwise, as two half arcs.
    #[must_use]
    pub fn circle(centre: Vector2<f64>, radius: f64) -> Self {
        let right = Vector2::new(radius, 0.0);
        Self { vertices: vec![Vertex::new(centre + right, 1.0), Vertex::new(centre - right, 1.0)] }
    }

    /// The chain of these edges, each starting where the one before ends.
    #[must_use]
    pub fn from_edges(edges: impl IntoIterator<Item = Edge>) -> Self {
        Self { vertices: edges.into_iter().map(|edge| Vertex { point: edge.start(), bend: edge.bend() }).collect() }
    }

    /// The edges in order.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + '_ {
        let ends = self.vertices.iter().skip(1).chain(self.vertices.first());
        self.vertices.iter().zip(ends).map(|(a, b)| a.to(b.point))
    }

    /// The edges in order, provided that all of them are arcs or lines.
    #[must_use]
    pub fn segments(&self) -> Option<Vec<Segment>> {
        self.edges().map(|edge| edge.segment()).collect()
    }

    /// How many of its edges are arcs.
    #[must_use]
    pub fn arcs(&self) -> usize {
        self.vertices.iter().filter(|vertex| vertex.bulge().is_some_and(|bulge| bulge != 0.0)).count()
    }

    /// How many of its edges are straight lines.
    #[must_use]
    pub fn lines(&self) -> usize {
        self.vertices.iter().filter(|vertex| vertex.bulge() == Some(0.0)).count()
    }

    /// How many of its edges are cubic curves.
    #[must_use]
    pub fn cubics(&self) -> usize {
        self.vertices.iter().filter(|vertex| vertex.bulge().is_none()).count()
    }

    /// Enclosed area, mm², positive counter-clockwise, and its centroid, mm.
    #[must_use]
    pub fn area_and_centroid(&self) -> (f64, Vector2<f64>) {
        let (area, moment) = self
            .edges()
            .map(|edge| edge.area_and_moments())
            .fold((0.0, Vector2::zeros()), |sum, next| (sum.0 + next.0, sum.1 + next.1));
        (area, moment / area)
    }

    /// Polar second moment of the enclosed area about the origin, mm⁴, positive counter-clockwise: ¼ ∮ r² (x dy − y dx), by Gauss's rule
    /// on each edge, which is exact to rounding for arcs up to half a turn.
    #[must_use]
    pub fn polar_moment(&self) -> f64 {
        let moments = self.edges().map(|edge| {
            let across = |share: f64| {
                let (point, direction) = edge.point_and_tangent(share);
                let speed = match edge {
                    Edge::Segment(segment) => segment.length(),
                    Edge::Cubic(cubic) => cubic.derivatives(share)[1].norm(),
                };
                point.norm_squared() * point.perp(&direction) * speed
            };
            0.25 * quadrature::integrate(across, (0.0, 1.0), PANELS)
        });
        moments.sum()
    }

    /// Length of the whole chain, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| edge.length()).sum()
    }

    /// How often the chain turns round: 1 for a simple one run counter-clockwise, −1 clockwise.
    #[must_use]
    pub fn turns(&self) -> f64 {
        let swept: f64 = self.edges().map(|edge| edge.turning()).sum();
        let kinks: f64 = self.tangent_breaks().iter().sum();
        ((swept + kinks) / std::f64::consts::TAU).round()
    }

    /// Turn of the tangent at the start of each segment, rad: 0 where the chain is smooth.
    #[must_use]
    pub fn tangent_breaks(&self) -> Vec<f64> {
        let edges: Vec<Edge> = self.edges().collect();
        let before = edges.iter().cycle().skip(edges.len().saturating_sub(1));
        let breaks = before.zip(&edges).map(|(before, after)| {
            let (a, b) = (before.end_tangent(), after.start_tangent());
            libm::atan2(a.perp(&b), a.dot(&b))
        });
        breaks.collect()
    }

    /// Exact extents, including the bulging of arcs.
    #[must_use]
    pub fn extents(&self) -> Extents {
        let first = self.vertices.first().map_or_else(Vector2::zeros, |v| v.point);
        let start = Extents { least: first, largest: first };
        self.edges().fold(start, |extents, edge| extents.with(&edge.extents()))
    }

    /// The chain in the opposite sense.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let edges: Vec<Edge> = self.edges().collect();
        Self::from_edges(edges.iter().rev().map(Edge::reversed))
    }

    /// Mirrored about the X axis and reversed, so that it keeps its sense; starts with the mirror image of the
    /// same edge.
    #[must_use]
    pub fn mirrored_about_x(&self) -> Self {
        let edges: Vec<Edge> = self.edges().collect();
        // Mirrored, edge i runs from vertex i + 1 to i; the first stays the first and the others follow in turn.
        let order = edges.first().into_iter().chain(edges.iter().skip(1).rev());
        Self::from_edges(order.map(Edge::mirrored_about_x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn a_circle_has_the_measures_of_a_circle() {
        let centre = Vector2::new(3.0, -2.0);
        let circle = Contour::circle(centre, 5.0);
        let (area, centroid) = circle.area_and_centroid();
        assert!((area - 25.0 * PI).abs() < 1e-13);
        assert!((centroid - centre).norm() < 1e-14);
        assert_eq!((circle.turns(), circle.reversed().turns()), (1.0, -1.0));
        let twice = Contour { vertices: [&circle.vertices[..], &circle.vertices[..]].concat() };
        assert_eq!(twice.turns(), 2.0);
        assert!((circle.length() - 10.0 * PI).abs() < 1e-13);
        assert!(circle.tangent_breaks().iter().all(|turn| turn.abs() < 1e-15));
        let extents = circle.extents();
        assert!((extents.least - Vector2::new(-2.0, -7.0)).norm() < 1e-14);
        assert!((extents.largest - Vector2::new(8.0, 3.0)).norm() < 1e-14);
    }

    /// The distance from places near the centre of an arc is the radius, less their distance from the centre to its side.
    #[test]
    fn an_arc_is_its_radius_from_its_centre() {
        let arc = Segment {
            start: Vector2::new(335.226_644_976_63, -40.517_138_248_16),
            end: Vector2::new(333.019_936_248_02, -26.603_447_175_485),
            bulge: -0.119_060_786_373,
        };
        let middle = arc.middle() - arc.centre();
        let (along, across) = (middle.normalize(), Vector2::new(-middle.y, middle.x).normalize());
        for step in [0.0, 1e-13, 1e-10, 1e-7, 1e-5, 1e-3, 0.1, 0.3] {
            for place in [along * step, along * -step, across * step, across * -step] {
                let nearest = arc.nearest(arc.centre() + place);
                // The chord sees 27° of the circle: the ends are nearer than the arc only from places beyond its centre.
                let ends = (arc.start - arc.centre() - place).norm().min((arc.end - arc.centre() - place).norm());
                let on_circle = arc.radius().abs() - place.norm();
                let exact = if place.dot(&along) > 0.5 * place.norm() { on_circle } else { ends };
                // Twelve decimals of the ends leave 1e-11 mm of the radius; rounding is a thousandth of that.
                assert!((nearest.left.abs() - exact).abs() < 1e-11, "{place:?}: {nearest:?} {exact}");
            }
        }
    }

    /// A slot: two lines and two half circles; measures in closed form.
    #[test]
    fn a_slot_has_the_measures_of_a_slot() {
        let at = |x: f64, y: f64, bulge: f64| Vertex::new(Vector2::new(x, y), bulge);
        let slot =
            Contour { vertices: vec![at(0.0, -1.0, 0.0), at(4.0, -1.0, 1.0), at(4.0, 1.0, 0.0), at(0.0, 1.0, 1.0)] };
        let (area, centroid) = slot.area_and_centroid();
        assert!((area - (8.0 + PI)).abs() < 1e-14);
        assert!((centroid - Vector2::new(2.0, 0.0)).norm() < 1e-14);
        assert!(slot.tangent_breaks().iter().all(|turn| turn.abs() < 1e-15));
        assert!((slot.extents().size() - Vector2::new(6.0, 2.0)).norm() < 1e-14);
        let quarter =
            Segment { start: Vector2::new(1.0, 0.0), end: Vector2::new(0.0, 1.0), bulge: libm::tan(PI / 8.0) };
        let (area, moment) = quarter.area_and_moments();
        assert!((area - PI / 4.0).abs() < 1e-15, "{area}");
        assert!((moment - Vector2::new(1.0, 1.0) / 3.0).norm() < 1e-15, "{moment}");
        assert!((quarter.middle().norm() - 1.0).abs() < 1e-15);
        assert!((quarter.centre()).norm() < 1e-15 && (quarter.radius() - 1.0).abs() < 1e-15);
    }

    #[test]
    fn the_nearest_point_is_the_nearest_of_many() {
        let at = |x: f64, y: f64| Vector2::new(x, y);
        for bulge in [0.0, 1e-7, 0.2, -0.2, 0.9, -1.7] {
            let segment = Segment { start: at(1.0, 2.0), end: at(5.0, 3.0), bulge };
            assert!((segment.point_and_tangent(1.0).0 - segment.end).norm() < 1e-13);
            assert!((segment.point_and_tangent(1.0).1 - segment.end_tangent()).norm() < 1e-13);
            assert!((segment.point_and_tangent(0.5).0 - segment.middle()).norm() < 1e-13);
            for (x, y) in [(3.0, 0.0), (0.0, 0.0), (9.0, 9.0), (3.0, 2.4), (2.0, 7.0), (4.0, -3.0)] {
                let nearest = segment.nearest(at(x, y));
                let scan = (0..=20_000)
                    .map(|i| (segment.point_and_tangent(f64::from(i) / 2e4).0 - at(x, y)).norm())
                    .fold(f64::INFINITY, f64::min);
                assert!((nearest.left.abs() - scan).abs() < 1e-6, "{bulge} ({x}, {y}): {nearest:?} {scan}");
                assert!(((nearest.foot - at(x, y)).norm() - nearest.left.abs()).abs() < 1e-8, "{bulge}: {nearest:?}");
            }
        }
        let left = Segment { start: at(0.0, 0.0), end: at(2.0, 0.0), bulge: 0.0 };
        assert_eq!(left.nearest(at(1.0, 3.0)).left, 3.0);
        assert_eq!(left.nearest(at(1.0, -3.0)).left, -3.0);
    }

    #[test]
    fn mirroring_twice_is_nothing_and_once_keeps_the_sense() {
        let at = |x: f64, y: f64, bulge: f64| Vertex::new(Vector2::new(x, y), bulge);
        let chain =
            Contour { vertices: vec![at(0.0, 0.0, 0.1), at(4.0, 0.0, 0.0), at(4.0, 3.0, -0.2), at(1.0, 5.0, 0.3)] };
        let mirrored = chain.mirrored_about_x();
        assert_eq!(mirrored.mirrored_about_x(), chain);
        let ((a, ca), (b, cb)) = (chain.area_and_centroid(), mirrored.area_and_centroid());
        assert!((a - b).abs() < 1e-13 && (ca.x - cb.x).abs() < 1e-13 && (ca.y + cb.y).abs() < 1e-13);
        assert_eq!(mirrored.vertices[0].bulge(), Some(0.1), "the first segment stays the first");
    }
}

//! Where a closed chain starts: a control begins to cut there, and leaves its mark.

use super::contour::{Contour, Vertex};
use super::edge::Edge;
use super::segment::Segment;
use nalgebra::Vector2;

/// A place nearer to a vertex than this is that vertex, mm: no control is given a shorter edge for the sake of a start.
const SHORTEST: f64 = 1e-3;
/// Largest turn of a joint that is no corner, rad.
const SMOOTH: f64 = 1e-4;

impl Contour {
    /// The same chain, started at its place nearest to a point (mm). An edge is divided there unless one of its ends is that place.
    #[must_use]
    pub fn started_near(&self, point: Vector2<f64>) -> Self {
        let mut edges: Vec<Edge> = self.edges().collect();
        let feet = edges.iter().map(|edge| edge.nearest(point).foot).enumerate();
        let nearest = feet.min_by(|(_, a), (_, b)| (a - point).norm().total_cmp(&(b - point).norm()));
        let Some((index, foot)) = nearest else { return self.clone() };
        let edge = edges[index];
        let first = if (edge.start() - foot).norm() < SHORTEST {
            index
        } else {
            if !((edge.end() - foot).norm() < SHORTEST) {
                let (before, after) = edge.divided_near(foot);
                edges.splice(index..=index, [before, after]);
            }
            index + 1
        };
        let count = edges.len();
        edges.rotate_left(first % count);
        Self::from_edges(edges)
    }

    /// The same chain, started at the joint without a corner where it is flattest: a tool that enters there leaves the least mark. Of
    /// joints inside of a spline none is taken.
    #[must_use]
    pub fn started_where_flattest(&self) -> Self {
        let edges: Vec<Edge> = self.edges().collect();
        let count = edges.len();
        let turns = self.tangent_breaks();
        let joints = (0..count).filter(|index| turns[*index].abs() <= SMOOTH).filter_map(|index| {
            let (before, after) = (edges[(index + count - 1) % count], edges[index]);
            let inside = matches!((before, after), (Edge::Cubic(_), Edge::Cubic(_)));
            (!inside).then(|| (index, before.curvature(1.0).abs().max(after.curvature(0.0).abs())))
        });
        let Some((flattest, _)) = joints.min_by(|(_, a), (_, b)| a.total_cmp(b)) else { return self.clone() };
        let mut vertices: Vec<Vertex> = self.vertices.clone();
        vertices.rotate_left(flattest);
        Self { vertices }
    }
}

impl Edge {
    /// Its two parts on either side of one of its points, mm.
    fn divided_near(&self, point: Vector2<f64>) -> (Self, Self) {
        match self {
            Edge::Segment(whole) => {
                let share = whole.share_of(point);
                let at = whole.point_and_tangent(share).0;
                let quarter_sweep = libm::atan(whole.bulge);
                let before = Segment { start: whole.start, end: at, bulge: libm::tan(quarter_sweep * share) };
                let after = Segment { start: at, end: whole.end, bulge: libm::tan(quarter_sweep * (1.0 - share)) };
                (Edge::Segment(before), Edge::Segment(after))
            }
            Edge::Cubic(cubic) => {
                let (before, after) = cubic.split(cubic.nearest_parameter(point));
                (Edge::Cubic(before), Edge::Cubic(after))
            }
        }
    }
}

impl Segment {
    /// The share of the sweep, or of the length of a line, at one of its points.
    fn share_of(&self, point: Vector2<f64>) -> f64 {
        let (chord, tangent) = (point - self.start, self.start_tangent());
        if self.bulge == 0.0 {
            return chord.dot(&tangent) / self.length();
        }
        // The chord to a point turns by half of the sweep up to it.
        2.0 * libm::atan2(tangent.perp(&chord), tangent.dot(&chord)) / self.sweep()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::Bend;
    use std::f64::consts::{FRAC_PI_2, PI};

    /// Two half circles of 10 mm about (0, 0) and (40, 0), and the two lines between them.
    fn slot() -> Contour {
        let at = |x: f64, y: f64, bulge: f64| Vertex::new(Vector2::new(x, y), bulge);
        Contour { vertices: vec![at(0.0, -10.0, 0.0), at(40.0, -10.0, 1.0), at(40.0, 10.0, 0.0), at(0.0, 10.0, 1.0)] }
    }

    fn alike(a: &Contour, b: &Contour) {
        assert!((a.length() - b.length()).abs() < 1e-12 * a.length());
        let ((area, centroid), (other, there)) = (a.area_and_centroid(), b.area_and_centroid());
        assert!((area - other).abs() < 1e-11 * area && (centroid - there).norm() < 1e-11);
    }

    #[test]
    fn an_arc_a_line_and_a_spline_are_divided_at_the_place() {
        let far = Vector2::new(60.0 * (0.3f64).cos() + 40.0, 60.0 * (0.3f64).sin());
        let started = slot().started_near(far);
        let start = started.vertices[0].point - Vector2::new(40.0, 0.0);
        assert!((start - Vector2::new((0.3f64).cos(), (0.3f64).sin()) * 10.0).norm() < 1e-12);
        assert_eq!((started.arcs(), started.lines()), (3, 2));
        let sweeps: f64 = 4.0 * started.vertices[0].bulge().map_or(f64::NAN, f64::atan);
        assert!((sweeps - (FRAC_PI_2 - 0.3)).abs() < 1e-12);
        alike(&started, &slot());

        let on_line = slot().started_near(Vector2::new(13.0, -400.0));
        assert!((on_line.vertices[0].point - Vector2::new(13.0, -10.0)).norm() < 1e-12);
        assert_eq!((on_line.arcs(), on_line.lines()), (2, 3));

        let mut splined = slot();
        splined.vertices[0].bend = Bend::Cubic([Vector2::new(10.0, -12.0), Vector2::new(30.0, -12.0)]);
        let started = splined.started_near(Vector2::new(20.0, -400.0));
        assert!((started.vertices[0].point - Vector2::new(20.0, -11.5)).norm() < 1e-12);
        assert_eq!(started.cubics(), 2);
        alike(&started, &splined);
    }

    #[test]
    fn a_place_at_a_vertex_divides_nothing() {
        let started = slot().started_near(Vector2::new(40.0, 11.0));
        assert_eq!(started.vertices[0], slot().vertices[2]);
        assert_eq!(started.vertices.len(), 4);
        // The end of the last edge is the first vertex.
        assert_eq!(slot().started_near(Vector2::new(-1e-5, -10.0)), slot());
    }

    #[test]
    fn the_flattest_joint_has_no_corner_and_lies_in_no_spline() {
        let vertex = |angle: f64, radius: f64, to: f64| {
            Vertex::new(Vector2::new(angle.cos(), angle.sin()) * radius, (0.25 * (to - angle)).tan())
        };
        // A circle in four arcs, of which one is replaced by a line with two corners.
        let mut circle = Contour {
            vertices: (0..4).map(|i| f64::from(i) * FRAC_PI_2).map(|at| vertex(at, 5.0, at + FRAC_PI_2)).collect(),
        };
        circle.vertices[3].bend = Bend::Arc(0.0);
        let started = circle.started_where_flattest();
        assert!((started.vertices[0].point - Vector2::new(0.0, 5.0)).norm() < 1e-12, "{:?}", started.vertices[0]);
        assert_eq!(slot().started_where_flattest().vertices[0], slot().vertices[0]);
        assert!((slot().started_where_flattest().turns() - 1.0).abs() < PI * 1e-9);
    }
}

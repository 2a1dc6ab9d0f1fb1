//! One edge of a chain: an arc, a line or a cubic curve.

use super::cubic::Cubic;
use super::segment::{Extents, NearestOnSegment, Segment};
use nalgebra::Vector2;

/// The kind of an edge from a vertex to the next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bend {
    /// As an arc: tan(sweep/4), positive where it turns left; 0 is a straight line.
    Arc(f64),
    /// As a cubic Bézier curve with these two inner control points, mm.
    Cubic([Vector2<f64>; 2]),
}

/// An edge, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Edge {
    /// An arc or a line.
    Segment(Segment),
    /// A cubic curve.
    Cubic(Cubic),
}

impl Edge {
    /// Start, mm.
    #[must_use]
    pub fn start(&self) -> Vector2<f64> {
        match self {
            Edge::Segment(segment) => segment.start,
            Edge::Cubic(cubic) => cubic.points[0],
        }
    }

    /// End, mm.
    #[must_use]
    pub fn end(&self) -> Vector2<f64> {
        match self {
            Edge::Segment(segment) => segment.end,
            Edge::Cubic(cubic) => cubic.points[3],
        }
    }

    /// The shape of the edge between them.
    #[must_use]
    pub fn bend(&self) -> Bend {
        match self {
            Edge::Segment(segment) => Bend::Arc(segment.bulge),
            Edge::Cubic(Cubic { points: [_, leaves, arrives, _] }) => Bend::Cubic([*leaves, *arrives]),
        }
    }

    /// The arc or line, if it is one.
    #[must_use]
    pub fn segment(&self) -> Option<Segment> {
        match self {
            Edge::Segment(segment) => Some(*segment),
            Edge::Cubic(_) => None,
        }
    }

    /// Point and unit tangent at a share of the parameter, 0 the start, 1 the end: for an arc the share of its sweep.
    #[must_use]
    pub fn point_and_tangent(&self, share: f64) -> (Vector2<f64>, Vector2<f64>) {
        match self {
            Edge::Segment(segment) => segment.point_and_tangent(share),
            Edge::Cubic(cubic) => cubic.point_and_tangent(share),
        }
    }

    /// The point in the middle of the parameter, mm.
    #[must_use]
    pub fn middle(&self) -> Vector2<f64> {
        match self {
            Edge::Segment(segment) => segment.middle(),
            Edge::Cubic(cubic) => cubic.derivatives(0.5)[0],
        }
    }

    /// Its two parts on either side of the middle of the parameter.
    #[must_use]
    pub fn halves(&self) -> (Self, Self) {
        match self {
            Edge::Segment(whole) => {
                let (middle, bulge) = (whole.middle(), whole.bulge / (1.0 + (1.0 + whole.bulge * whole.bulge).sqrt()));
                (
                    Edge::Segment(Segment { start: whole.start, end: middle, bulge }),
                    Edge::Segment(Segment { start: middle, end: whole.end, bulge }),
                )
            }
            Edge::Cubic(cubic) => {
                let (first, last) = cubic.split(0.5);
                (Edge::Cubic(first), Edge::Cubic(last))
            }
        }
    }

    /// Length, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        match self {
            Edge::Segment(segment) => segment.length(),
            Edge::Cubic(cubic) => cubic.length(),
        }
    }

    /// By how much it turns left from its start to its end, rad.
    #[must_use]
    pub fn turning(&self) -> f64 {
        match self {
            Edge::Segment(segment) => segment.sweep(),
            Edge::Cubic(cubic) => cubic.turning(),
        }
    }

    /// Curvature at a share of the parameter, 1/mm, positive where it turns left.
    #[must_use]
    pub fn curvature(&self, share: f64) -> f64 {
        match self {
            Edge::Segment(segment) if segment.bulge == 0.0 => 0.0,
            Edge::Segment(segment) => 1.0 / segment.radius(),
            Edge::Cubic(cubic) => cubic.curvature(share),
        }
    }

    /// Unit tangent at the start.
    #[must_use]
    pub fn start_tangent(&self) -> Vector2<f64> {
        match self {
            Edge::Segment(segment) => segment.start_tangent(),
            Edge::Cubic(cubic) => cubic.start_tangent(),
        }
    }

    /// Unit tangent at the end.
    #[must_use]
    pub fn end_tangent(&self) -> Vector2<f64> {
        match self {
            Edge::Segment(segment) => segment.end_tangent(),
            Edge::Cubic(cubic) => cubic.end_tangent(),
        }
    }

    /// Exact extents.
    #[must_use]
    pub fn extents(&self) -> Extents {
        match self {
            Edge::Segment(segment) => segment.extents(),
            Edge::Cubic(cubic) => cubic.extents(),
        }
    }

    /// How far it reaches in a direction (a unit vector) from the origin, mm.
    #[must_use]
    pub fn farthest(&self, direction: Vector2<f64>) -> f64 {
        match self {
            Edge::Segment(segment) => segment.farthest(direction),
            Edge::Cubic(cubic) => cubic.farthest(direction),
        }
    }

    /// Its point nearest to a given one.
    #[must_use]
    pub fn nearest(&self, point: Vector2<f64>) -> NearestOnSegment {
        match self {
            Edge::Segment(segment) => segment.nearest(point),
            Edge::Cubic(cubic) => cubic.nearest(point),
        }
    }

    /// Area between the edge and the origin, mm², and its first moments ∫x dA, ∫y dA, mm³, signed.
    #[must_use]
    pub fn area_and_moments(&self) -> (f64, Vector2<f64>) {
        match self {
            Edge::Segment(segment) => segment.area_and_moments(),
            Edge::Cubic(cubic) => cubic.area_and_moments(),
        }
    }

    /// The edge in the opposite sense.
    #[must_use]
    pub fn reversed(&self) -> Self {
        match self {
            Edge::Segment(s) => Edge::Segment(Segment { start: s.end, end: s.start, bulge: -s.bulge }),
            Edge::Cubic(cubic) => Edge::Cubic(cubic.reversed()),
        }
    }

    /// Mirrored about the X axis and reversed: the same side stays on its left.
    #[must_use]
    pub fn mirrored_about_x(&self) -> Self {
        match self {
            Edge::Segment(segment) => Edge::Segment(segment.mirrored_about_x()),
            Edge::Cubic(cubic) => Edge::Cubic(cubic.reversed().mapped(|point| Vector2::new(point.x, -point.y))),
        }
    }

    /// Whether all its numbers are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        // So that distances are finite too.
        match self {
            Edge::Segment(s) => {
                [s.start, s.end].iter().all(|point| point.norm_squared().is_finite()) && s.bulge.is_finite()
            }
            Edge::Cubic(cubic) => cubic.points.iter().all(|point| point.norm_squared().is_finite()),
        }
    }
}

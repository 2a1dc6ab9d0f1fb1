//! The blank that a program presumes: the bounding circle about the shaft, or the bounding rectangle of a plate, with a margin.
//!
//! Planner and judge build it each from its own paths; only the shape is shared.

use camgen_kernel::geometry::contour::{Edge, Extents, Segment};
use nalgebra::Vector2;

/// Points of an edge at which its distance from the shaft is taken: between them an arc of a cam rises by micrometres.
const SAMPLES: u32 = 8;

/// A blank seen along Z, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Blank {
    /// A round one about the shaft, of this radius.
    Round(f64),
    /// A rectangular one.
    Rectangle(Extents),
}

impl Blank {
    /// The blank of paths that lie `off` outside of what they leave, with a margin; `is_plate` for a rectangle.
    pub(super) fn around(edges: impl Iterator<Item = Edge>, (off, margin): (f64, f64), is_plate: bool) -> Option<Self> {
        let grown = margin - off;
        if is_plate {
            let extents = edges.map(|edge| edge.extents()).reduce(|all, next| all.with(&next))?;
            let by = Vector2::new(grown, grown);
            return Some(Self::Rectangle(Extents { least: extents.least - by, largest: extents.largest + by }));
        }
        let far = |edge: Edge| {
            let along = (0..=SAMPLES).map(|index| f64::from(index) / f64::from(SAMPLES));
            along.map(|share| edge.point_and_tangent(share).0.norm()).fold(0.0, f64::max)
        };
        edges.map(far).reduce(f64::max).map(|radius| Self::Round(radius + grown))
    }

    /// How far a point lies outside, mm; below 0 inside.
    pub(super) fn outside(&self, point: Vector2<f64>) -> f64 {
        match self {
            Self::Round(radius) => point.norm() - radius,
            Self::Rectangle(extents) => {
                let [x, y] =
                    [0, 1].map(|axis| (extents.least[axis] - point[axis]).max(point[axis] - extents.largest[axis]));
                if x > 0.0 && y > 0.0 { libm::hypot(x, y) } else { x.max(y) }
            }
        }
    }

    /// The nearest point in a direction (a unit vector) from a point that lies at least `off` outside, found by steps of the distance that lacks.
    pub(super) fn way_out(&self, from: Vector2<f64>, direction: Vector2<f64>, off: f64) -> Option<Segment> {
        const MOST_STEPS: usize = 400;
        let mut at = from;
        for _ in 0..MOST_STEPS {
            let lacks = off - self.outside(at);
            if lacks <= 0.0 {
                return Some(Segment { start: at, end: from, bulge: 0.0 });
            }
            // No point of a step as long as the lack is farther outside than `off`.
            at += direction * lacks.max(0.01);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use camgen_kernel::geometry::contour::Contour;

    #[test]
    fn blanks_hold_their_outline_with_the_margin() {
        let contour = Contour::circle(Vector2::new(5.0, 0.0), 20.0);
        let round = Blank::around(contour.edges(), (4.0, 3.0), false).expect("round");
        assert!((round.outside(Vector2::new(24.0, 0.0))).abs() < 1e-9, "{round:?}");
        let plate = Blank::around(contour.edges(), (0.0, 3.0), true).expect("a rectangle");
        assert!((plate.outside(Vector2::new(31.0, 27.0)) - 5.0).abs() < 1e-9, "{plate:?}");
        let way = round.way_out(Vector2::new(20.0, 1.0), Vector2::x(), 6.0).expect("a way");
        assert!(
            round.outside(way.start) >= 6.0 && round.outside(way.start) < 6.1 && way.end == Vector2::new(20.0, 1.0)
        );
        assert_eq!(round.way_out(Vector2::zeros(), Vector2::zeros(), 1.0), None);
    }
}

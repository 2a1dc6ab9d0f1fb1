//! Shapes as path data of SVG: arcs are arcs, or cubics for a PDF; y is flipped once, in the coordinates.

use super::number::short;
#[cfg(feature = "html")]
use crate::report::sheet::SheetShape;
#[cfg(feature = "html")]
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::{Contour, Edge, Segment};
use nalgebra::Vector2;

/// Largest sweep of one arc, rad: the direction of a half circle is ambiguous within rounding.
const LONGEST_SWEEP: f64 = 3.0;
/// Largest sweep of one cubic, rad.
const CUBIC_SWEEP: f64 = std::f64::consts::FRAC_PI_4;

/// Path data with this many decimals of a millimetre. The data of the crate svg are in single precision.
#[derive(Debug, Clone, Copy)]
pub(super) struct PathData {
    pub(super) decimals: usize,
    /// Arcs as cubics: what converts arcs for a PDF does so with the sine and cosine of the system, and its bytes would differ from one system to the next.
    pub(super) cubics: bool,
}

impl PathData {
    pub(super) fn number(self, value: f64) -> String {
        short(value, self.decimals)
    }

    fn place(self, point: Vector2<f64>) -> String {
        format!("{},{}", self.number(point.x), self.number(-point.y))
    }

    /// Places, separated by a sign or a blank.
    pub(super) fn places(self, points: &[Vector2<f64>], between: &str) -> String {
        points.iter().map(|point| self.place(*point)).collect::<Vec<_>>().join(between)
    }

    /// A shape; nothing for a text.
    #[cfg(feature = "html")]
    pub(super) fn shape(self, shape: &SheetShape) -> String {
        match shape {
            SheetShape::Entity(Entity::Polyline(contour)) => self.contour(contour),
            SheetShape::Entity(Entity::Circle(centre, radius)) => self.contour(&Contour::circle(*centre, *radius)),
            SheetShape::Entity(Entity::Segment(segment)) => self.open_arc(segment),
            SheetShape::Line(a, b) => self.chain(&[*a, *b]),
            SheetShape::Path(points) => self.chain(points),
            SheetShape::Arc(start, end, bulge) => self.open_arc(&Segment { start: *start, end: *end, bulge: *bulge }),
            SheetShape::Triangle(corners) => self.chain(corners) + "Z",
            SheetShape::Area(corners) => self.chain(corners) + "Z",
            SheetShape::Text { .. } => String::new(),
        }
    }

    pub(super) fn contour(self, contour: &Contour) -> String {
        let first = contour.vertices.first().map(|first| self.place(first.point)).unwrap_or_default();
        let edges = contour.edges().map(|edge| self.edge(&edge));
        format!("M{} Z", std::iter::once(first).chain(edges).collect::<Vec<_>>().join(" "))
    }

    pub(super) fn open_arc(self, segment: &Segment) -> String {
        format!("M{} {}", self.place(segment.start), self.arc(segment))
    }

    #[cfg(feature = "html")]
    fn chain(self, points: &[Vector2<f64>]) -> String {
        format!("M{}", self.places(points, "L"))
    }

    fn edge(self, edge: &Edge) -> String {
        match edge {
            Edge::Segment(segment) => self.arc(segment),
            Edge::Cubic(cubic) => {
                let [_, rest @ ..] = &cubic.points;
                format!("C{}", self.places(rest, " "))
            }
        }
    }

    /// A line, an arc, or the two halves of a long arc.
    fn arc(self, segment: &Segment) -> String {
        if segment.bulge == 0.0 {
            return format!("L{}", self.place(segment.end));
        }
        if self.cubics {
            return self.as_cubics(segment);
        }
        let radius = self.number(segment.radius().abs());
        // A left turn upwards is a right turn (sweep flag 0) once y points down.
        let sweep = u8::from(segment.bulge < 0.0);
        let middle = (segment.sweep().abs() > LONGEST_SWEEP).then(|| segment.middle());
        let to = |point| format!("A{radius},{radius} 0 0 {sweep} {}", self.place(point));
        middle.into_iter().chain([segment.end]).map(to).collect::<Vec<_>>().join(" ")
    }

    /// An arc as equal cubics.
    fn as_cubics(self, segment: &Segment) -> String {
        let cubics = segment.cubics(CUBIC_SWEEP);
        cubics.iter().map(|points| format!("C{}", self.places(points, " "))).collect::<Vec<_>>().join(" ")
    }
}

//! The exact outline of a cam: a closed loop of smooth stretches, millimetres, the metal on the left.
//!
//! A stretch is a range of a curve that is a function of a parameter, or an exact arc or line. Between two
//! stretches the heading is continuous, or the loop has a corner there.

use super::CurvePoint;
use super::contour::Segment;
use nalgebra::Vector2;

/// A turn between two stretches beyond this is a corner, rad: far above rounding, far below what is visible.
const LEAST_CORNER: f64 = 1e-6;

/// Ends of two stretches farther apart than this are joined by a straight line, mm: the profile under a face whose velocity
/// jumps. Crossings of a profile with itself are solved to rounding.
const LEAST_GAP: f64 = 1e-7;

/// A stretch that begins at most this far behind the end of the one before it is not joined to it, mm: a corner of the motion too small to
/// count, 1e-7 rad, sets the profile under a roller of 100 mm back by as much. A line would run against the profile.
const LEAST_STEP_BACK: f64 = 1e-5;

/// A stretch of a curve turns by no more than a third of a half turn, so that the normals at its ends show what lies before and behind
/// them: the least cosine between its ends and its middle. Where this would miss a turn, its curvature is high.
const LEAST_COSINE: f64 = 0.5;
const MOST_TURN: f64 = 4.0;
/// Halvings of a stretch that turns more.
const HALVINGS: u32 = 16;

/// The point of a curve at a parameter of one of its pieces, mm.
pub type PieceCurve<'a> = dyn Fn(usize, f64) -> CurvePoint + 'a;

#[derive(Debug, Clone, Copy)]
enum StretchKind {
    /// A piece of the curve.
    Curve { piece: usize },
    /// The mirror image of a piece about X, in the opposite sense: its parameter is that of the piece, negated.
    Mirrored { piece: usize },
    /// An arc or a line, by its own length.
    Segment(Segment),
}

/// A smooth part of the loop.
#[derive(Debug, Clone, Copy)]
pub struct BoundaryStretch {
    kind: StretchKind,
    /// First value of its parameter.
    pub from: f64,
    /// Last value.
    pub to: f64,
}

impl BoundaryStretch {
    /// A range of a piece of the curve.
    #[must_use]
    pub fn of_curve(piece: usize, from: f64, to: f64) -> Self {
        Self { kind: StretchKind::Curve { piece }, from, to }
    }

    /// An arc or a line.
    #[must_use]
    pub fn of_segment(segment: Segment) -> Self {
        Self { kind: StretchKind::Segment(segment), from: 0.0, to: segment.length() }
    }

    /// Whether the next one is the same piece of the curve, from where this one ends.
    fn goes_on(&self, next: &Self) -> bool {
        let same = match (&self.kind, &next.kind) {
            (StretchKind::Curve { piece: a }, StretchKind::Curve { piece: b })
            | (StretchKind::Mirrored { piece: a }, StretchKind::Mirrored { piece: b }) => a == b,
            _ => false,
        };
        same && self.to == next.from
    }

    /// Its mirror image about X, in the opposite sense.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        match self.kind {
            StretchKind::Curve { piece } => {
                Self { kind: StretchKind::Mirrored { piece }, from: -self.to, to: -self.from }
            }
            StretchKind::Mirrored { piece } => {
                Self { kind: StretchKind::Curve { piece }, from: -self.to, to: -self.from }
            }
            StretchKind::Segment(segment) => Self::of_segment(segment.mirrored_about_x()),
        }
    }
}

/// The loop.
pub struct Boundary<'a> {
    frame: Box<PieceCurve<'a>>,
    stretches: Vec<BoundaryStretch>,
    /// Both ends of each stretch.
    ends: Vec<[CurvePoint; 2]>,
}

impl<'a> Boundary<'a> {
    /// The loop of these stretches, in order; gaps between them are closed by straight lines.
    #[must_use]
    pub fn new(frame: Box<PieceCurve<'a>>, stretches: &[BoundaryStretch]) -> Self {
        Self::joined(frame, stretches, true)
    }

    /// These stretches as a path that does not close: from the first stretch to the last.
    #[must_use]
    pub fn open(frame: Box<PieceCurve<'a>>, stretches: &[BoundaryStretch]) -> Self {
        Self::joined(frame, stretches, false)
    }

    fn joined(frame: Box<PieceCurve<'a>>, stretches: &[BoundaryStretch], closed: bool) -> Self {
        let mut boundary = Self { frame, stretches: Vec::new(), ends: Vec::new() };
        let mut ends: Vec<[CurvePoint; 2]> = Vec::new();
        let mut parts: Vec<BoundaryStretch> = Vec::with_capacity(stretches.len());
        for stretch in stretches {
            // A range that continues the one before starts with the same point.
            let start = match (parts.last().filter(|before| before.goes_on(stretch)), ends.last()) {
                (Some(_), Some(last)) => last[1],
                _ => boundary.on(stretch, stretch.from),
            };
            boundary.turning_little(*stretch, [start, boundary.on(stretch, stretch.to)], HALVINGS, &mut |part, own| {
                parts.push(part);
                ends.push(own);
            });
        }
        let next = ends.iter().skip(1).chain(ends.first());
        for (index, ((stretch, own), next)) in parts.iter().zip(&ends).zip(next).enumerate() {
            boundary.stretches.push(*stretch);
            boundary.ends.push(*own);
            let (start, end) = (own[1].point, next[0].point);
            let last = index + 1 == parts.len();
            let gap = end - start;
            let back = gap.dot(&own[1].tangent) < 0.0 && gap.norm() <= LEAST_STEP_BACK;
            if (closed || !last) && gap.norm() > LEAST_GAP && !back {
                let line = BoundaryStretch::of_segment(Segment { start, end, bulge: 0.0 });
                boundary.ends.push([boundary.on(&line, line.from), boundary.on(&line, line.to)]);
                boundary.stretches.push(line);
            }
        }
        boundary
    }

    /// Adds a stretch with its ends, halved until it turns little.
    fn turning_little(
        &self,
        stretch: BoundaryStretch,
        ends: [CurvePoint; 2],
        halvings: u32,
        add: &mut impl FnMut(BoundaryStretch, [CurvePoint; 2]),
    ) {
        if matches!(stretch.kind, StretchKind::Segment(_)) {
            return add(stretch, ends);
        }
        let halfway = 0.5 * (stretch.from + stretch.to);
        let middle = self.on(&stretch, halfway);
        let [at_middle, at_start, at_end] =
            [middle, ends[0], ends[1]].map(|point| (point.speed * point.curvature).abs());
        let most = at_middle.max(at_start).max(at_end);
        let [first, between, last] = [ends[0], middle, ends[1]].map(|point| point.tangent);
        let cosines = [first.dot(&between), between.dot(&last), first.dot(&last)];
        let little =
            most * (stretch.to - stretch.from) <= MOST_TURN && cosines.iter().all(|cosine| *cosine > LEAST_COSINE);
        if little || halvings == 0 || !(stretch.from < halfway && halfway < stretch.to) {
            return add(stretch, ends);
        }
        let [start, end] = ends;
        self.turning_little(BoundaryStretch { to: halfway, ..stretch }, [start, middle], halvings - 1, add);
        self.turning_little(BoundaryStretch { from: halfway, ..stretch }, [middle, end], halvings - 1, add);
    }

    /// Its stretches in order.
    #[must_use]
    pub fn stretches(&self) -> &[BoundaryStretch] {
        &self.stretches
    }

    /// The two ends of a stretch; the index counts on round the loop.
    #[must_use]
    pub fn ends(&self, index: usize) -> Option<&[CurvePoint; 2]> {
        self.ends.get(index % self.ends.len().max(1))
    }

    /// Whether the loop has a corner where a stretch starts.
    #[must_use]
    pub fn starts_at_corner(&self, index: usize) -> bool {
        let before = self.ends(index + self.ends.len() - 1).map(|ends| ends[1].tangent);
        let after = self.ends(index).map(|ends| ends[0].tangent);
        // Where a direction is not a number, a corner is assumed.
        !before.zip(after).is_some_and(|(a, b)| a.dot(&b) > 0.0 && a.perp(&b).abs() <= LEAST_CORNER)
    }

    /// The point of the loop at a parameter of a stretch; the index counts on round the loop.
    #[must_use]
    pub fn point_at(&self, index: usize, parameter: f64) -> Option<CurvePoint> {
        Some(self.on(self.stretches.get(index % self.stretches.len().max(1))?, parameter))
    }

    fn on(&self, stretch: &BoundaryStretch, parameter: f64) -> CurvePoint {
        match &stretch.kind {
            StretchKind::Curve { piece } => (self.frame)(*piece, parameter),
            StretchKind::Mirrored { piece } => {
                let there = (self.frame)(*piece, -parameter);
                CurvePoint {
                    point: Vector2::new(there.point.x, -there.point.y),
                    tangent: Vector2::new(-there.tangent.x, there.tangent.y),
                    curvature_slope: -there.curvature_slope,
                    ..there
                }
            }
            StretchKind::Segment(segment) => {
                let (point, tangent) = segment.point_and_tangent(parameter / stretch.to);
                let curvature = if segment.bulge == 0.0 { 0.0 } else { 1.0 / segment.radius() };
                CurvePoint { point, tangent, speed: 1.0, curvature, curvature_slope: 0.0 }
            }
        }
    }
}

impl std::fmt::Debug for Boundary<'_> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("Boundary").field("stretches", &self.stretches).finish_non_exhaustive()
    }
}

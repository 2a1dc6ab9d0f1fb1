//! The part as a solid: its face extruded, with exact planes, cylinders and, over cubic curves, spline surfaces; no booleans.
//!
//! Every contour runs with the metal on its left, the outline counter-clockwise, holes clockwise, so that one rule makes
//! all side faces: the outward normal lies to the right. A line sweeps a plane, a cubic curve a spline surface; an arc sweeps a cylinder, whose own
//! normal points away from its axis: out of the metal where the contour turns left, into it where it turns right, and
//! there the face is the cylinder's other side. Both end faces are one plane each with the holes as inner wires.

pub mod axial_section;
mod flank_strip;
pub mod globoid;
pub mod grooved_cylinder;
mod spline_surface;
pub mod stacked;

use super::contour::{Contour, Cubic, Edge, Segment, sweep_minus_sine};
use crate::refusal::Refusal;
use nalgebra::Vector2;
use truck_modeling::{InnerSpace, Point3, Vector3};
use truck_topology::compress::{CompressedEdge, CompressedEdgeIndex, CompressedFace, CompressedShell, CompressedSolid};

/// A cubic B-spline curve: either end knot four times.
#[derive(Debug, Clone, PartialEq)]
pub struct SplineCurve {
    /// Its knots.
    pub knots: Vec<f64>,
    /// Its control points.
    pub controls: Vec<Point3>,
}

/// A bicubic B-spline surface.
#[derive(Debug, Clone, PartialEq)]
pub struct SplineSurface {
    /// Knots of its first parameter.
    pub u: Vec<f64>,
    /// Knots of its second parameter.
    pub v: Vec<f64>,
    /// Control points, a row for each of the first parameter.
    pub controls: Vec<Vec<Point3>>,
}

/// The curve that carries an edge, mm.
#[derive(Debug, Clone, PartialEq)]
pub enum EdgeCurve {
    /// A straight line from a point along a unit vector.
    Line {
        /// A point of it.
        origin: Point3,
        /// Its direction.
        direction: Vector3,
    },
    /// A circle in a plane of constant z.
    Circle {
        /// Its centre.
        centre: Point3,
        /// Its radius.
        radius: f64,
        /// The edge runs clockwise, seen from above.
        clockwise: bool,
    },
    /// A spline from its first to its last control point.
    Spline(SplineCurve),
}

/// The surface that carries a face, mm.
#[derive(Debug, Clone, PartialEq)]
pub enum FaceSurface {
    /// A plane.
    Plane {
        /// A point of it.
        origin: Point3,
        /// Its unit normal.
        normal: Vector3,
        /// A unit vector in it.
        along: Vector3,
    },
    /// A cylinder whose axis is parallel to z.
    Cylinder {
        /// A point of the axis.
        origin: Point3,
        /// Its radius.
        radius: f64,
    },
    /// A cone about the axis z, widening upwards or downwards.
    Cone {
        /// Height of a place of it, and its radius there.
        at: (f64, f64),
        /// Its half angle, rad: positive where it widens upwards.
        angle: f64,
    },
    /// A torus about the axis z, its middle at z = 0.
    Torus {
        /// Radius of the circle in the middle of its tube.
        major: f64,
        /// Radius of the tube.
        minor: f64,
    },
    /// A spline surface whose normal, first by second parameter, points out of the metal.
    Spline(SplineSurface),
}

/// A vertex, mm: a type of its own, for which the writer can implement its format.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolidVertex(pub Point3);

/// The boundary of a solid: vertices, edges and faces by index, as truck exchanges them.
pub type TruckBoundary = CompressedSolid<SolidVertex, EdgeCurve, FaceSurface>;

/// One shell of it.
pub type TruckShell = CompressedShell<SolidVertex, EdgeCurve, FaceSurface>;

/// A solid that has been checked.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckedSolid {
    /// Its boundary.
    pub boundary: TruckBoundary,
    /// Its volume, mm³.
    pub volume: f64,
}

/// Longest sweep of one cylinder face, rad.
const LONGEST_SWEEP: f64 = std::f64::consts::PI * (1.0 + 1e-9);

/// An arc with a larger radius, mm, and a smaller sagitta, mm, is written as a line: the last digit of a centre 1e9 mm away is
/// 1e-7 mm, and a solid states an uncertainty of 1e-6 mm.
const LARGEST_RADIUS: f64 = 1e9;
const STRAIGHT: f64 = 1e-6;

/// The remedy of a fault of camgen.
const REPORT: &str = "please report this";

/// Largest relative difference of the two volumes: rounding of a few hundred terms.
const VOLUME_TOLERANCE: f64 = 1e-11;

/// A boundary, if it encloses the volume of the drawing, mm³.
fn as_drawn(boundary: TruckBoundary, expected: f64) -> Result<CheckedSolid, Refusal> {
    let volume = enclosed_volume(&boundary);
    if !((volume / expected - 1.0).abs() <= VOLUME_TOLERANCE) {
        return Err(Refusal::new(format!("the solid encloses {volume} mm³ instead of {expected} mm³")).remedy(REPORT));
    }
    Ok(CheckedSolid { boundary, volume })
}

/// Refuses a boundary that is not one closed shell by the rules of truck.
fn check_closed(boundary: &TruckBoundary) -> Result<(), Refusal> {
    let closed = truck_topology::Solid::extract(boundary.clone());
    closed.map(drop).map_err(|fault| not_closed(fault.to_string().trim_end_matches('.')))
}

/// That a solid has no closed boundary.
#[must_use]
pub fn not_closed(why: &str) -> Refusal {
    Refusal::new(format!("the solid is not closed: {why}")).remedy(REPORT)
}

fn at_height(point: Vector2<f64>, z: f64) -> Point3 {
    // A negative zero becomes zero.
    Point3::new(point.x + 0.0, point.y + 0.0, z)
}

fn forward(index: usize) -> CompressedEdgeIndex {
    CompressedEdgeIndex { index, orientation: true }
}

fn backward(index: usize) -> CompressedEdgeIndex {
    CompressedEdgeIndex { index, orientation: false }
}

/// A shell under construction between two planes.
struct ShellBuilder {
    shell: TruckShell,
    /// Heights of the planes.
    ends: (f64, f64),
    under: Vec<Vec<CompressedEdgeIndex>>,
    above: Vec<Vec<CompressedEdgeIndex>>,
}

impl ShellBuilder {
    fn new(ends: (f64, f64)) -> Self {
        let shell = TruckShell { vertices: Vec::new(), edges: Vec::new(), faces: Vec::new() };
        Self { shell, ends, under: Vec::new(), above: Vec::new() }
    }

    /// Vertices 2i below and 2i + 1 above, edges 3i below, 3i + 1 above, 3i + 2 upright at the start of side i of a ring
    /// of n sides.
    fn vertex(&self, n: usize, i: usize, top: usize) -> usize {
        self.shell.vertices.len() + 2 * (i % n) + top
    }

    fn edge(&self, n: usize, i: usize, kind: usize) -> usize {
        self.shell.edges.len() + 3 * (i % n) + kind
    }

    /// The walls over a contour with the metal on its left.
    fn over(&mut self, contour: &Contour) {
        let sides: Vec<Edge> = contour.edges().flat_map(|edge| edges(&edge)).collect();
        let n = sides.len();
        let (low, high) = self.ends;
        let (mut vertices, mut edges, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        for (i, edge) in sides.iter().enumerate() {
            for (top, z) in [(0, low), (1, high)] {
                vertices.push(SolidVertex(at_height(edge.start(), z)));
                let ends = (self.vertex(n, i, top), self.vertex(n, i + 1, top));
                edges.push(CompressedEdge { vertices: ends, curve: carrier(edge, z) });
            }
            let upright = EdgeCurve::Line { origin: at_height(edge.start(), low), direction: Vector3::unit_z() };
            edges.push(CompressedEdge { vertices: (self.vertex(n, i, 0), self.vertex(n, i, 1)), curve: upright });
            let around = [self.edge(n, i, 0), self.edge(n, i + 1, 2), self.edge(n, i, 1), self.edge(n, i, 2)];
            faces.push(side(edge, low, high, around));
        }
        self.close(n, vertices, edges, faces);
    }

    /// The patches of a flank that closes on itself, counter-clockwise, u along it and v up it.
    fn flank(&mut self, patches: &[SplineSurface]) {
        let n = patches.len();
        let (mut vertices, mut edges, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        for (i, patch) in patches.iter().enumerate() {
            let first = patch.controls.first().cloned().unwrap_or_default();
            for (top, controls) in [(0, patch.first_column()), (1, patch.last_column())] {
                vertices.extend(controls.first().copied().map(SolidVertex));
                let ends = (self.vertex(n, i, top), self.vertex(n, i + 1, top));
                let curve = EdgeCurve::Spline(SplineCurve { knots: patch.u.clone(), controls });
                edges.push(CompressedEdge { vertices: ends, curve });
            }
            let upright = EdgeCurve::Spline(SplineCurve { knots: patch.v.clone(), controls: first });
            edges.push(CompressedEdge { vertices: (self.vertex(n, i, 0), self.vertex(n, i, 1)), curve: upright });
            let outward = vec![
                forward(self.edge(n, i, 0)),
                forward(self.edge(n, i + 1, 2)),
                backward(self.edge(n, i, 1)),
                backward(self.edge(n, i, 2)),
            ];
            let surface = FaceSurface::Spline(patch.clone());
            faces.push(CompressedFace { boundaries: vec![outward], orientation: true, surface });
        }
        self.close(n, vertices, edges, faces);
    }

    fn close(
        &mut self,
        n: usize,
        vertices: Vec<SolidVertex>,
        edges: Vec<CompressedEdge<EdgeCurve>>,
        faces: Vec<CompressedFace<FaceSurface>>,
    ) {
        self.under.push((0..n).rev().map(|i| backward(self.edge(n, i, 0))).collect());
        self.above.push((0..n).map(|i| forward(self.edge(n, i, 1))).collect());
        self.shell.vertices.extend(vertices);
        self.shell.edges.extend(edges);
        self.shell.faces.extend(faces);
    }

    /// Adds a level face with its loops.
    fn level(&mut self, boundaries: Vec<Vec<CompressedEdgeIndex>>, z: f64, normal: Vector3) {
        let surface = FaceSurface::Plane { origin: Point3::new(0.0, 0.0, z), normal, along: Vector3::unit_x() };
        self.shell.faces.push(CompressedFace { boundaries, orientation: true, surface });
    }

    /// Adds the end faces.
    fn capped(mut self) -> TruckBoundary {
        let (low, high) = self.ends;
        let (under, above) = (std::mem::take(&mut self.under), std::mem::take(&mut self.above));
        self.level(under, low, -Vector3::unit_z());
        self.level(above, high, Vector3::unit_z());
        CompressedSolid { boundaries: vec![self.shell] }
    }
}

/// A flank of spline patches with straight holes (clockwise) between two planes (mm), checked as [`stacked`](stacked::stacked); `area` is
/// the area of the holes and `volume` the volume that the flank encloses.
///
/// # Errors
/// [`Refusal`] when the boundary is not closed.
pub fn flank_solid(
    patches: &[SplineSurface],
    holes: &[Contour],
    ends: (f64, f64),
    volume: f64,
) -> Result<CheckedSolid, Refusal> {
    let mut walls = ShellBuilder::new(ends);
    walls.flank(patches);
    for hole in holes {
        walls.over(hole);
    }
    let boundary = walls.capped();
    check_closed(&boundary)?;
    // Clockwise: their area is negative.
    let drilled: f64 = holes.iter().map(|hole| hole.area_and_centroid().0).sum();
    Ok(CheckedSolid { boundary, volume: volume + drilled * (ends.1 - ends.0) })
}

/// An edge as it is carried: a long arc as two, as some readers cannot determine the inside of a cylinder face that is
/// almost closed, and an arc as a line where it differs from one by less than the solid's uncertainty and its centre would be too far
/// away.
fn edges(edge: &Edge) -> Vec<Edge> {
    let Edge::Segment(segment) = edge else { return vec![*edge] };
    let sagitta = 0.5 * (segment.end - segment.start).norm() * segment.bulge.abs();
    if segment.radius().abs() > LARGEST_RADIUS && sagitta < STRAIGHT {
        return vec![Edge::Segment(Segment { bulge: 0.0, ..*segment })];
    }
    if segment.sweep().abs() <= LONGEST_SWEEP {
        return vec![*edge];
    }
    let (middle, bulge) = (segment.middle(), libm::tan(0.125 * segment.sweep()));
    [Segment { end: middle, bulge, ..*segment }, Segment { start: middle, bulge, ..*segment }]
        .map(Edge::Segment)
        .to_vec()
}

fn carrier(edge: &Edge, z: f64) -> EdgeCurve {
    match edge {
        Edge::Segment(segment) if segment.bulge == 0.0 => {
            let direction = segment.start_tangent();
            let direction = Vector3::new(direction.x + 0.0, direction.y + 0.0, 0.0);
            EdgeCurve::Line { origin: at_height(segment.start, z), direction }
        }
        Edge::Segment(segment) => EdgeCurve::Circle {
            centre: at_height(segment.centre(), z),
            radius: segment.radius().abs(),
            clockwise: segment.bulge < 0.0,
        },
        Edge::Cubic(cubic) => EdgeCurve::Spline(SplineCurve {
            knots: SPAN.to_vec(),
            controls: cubic.points.iter().map(|point| at_height(*point, z)).collect(),
        }),
    }
}

/// Knots of a spline that is one polynomial.
const SPAN: [f64; 8] = [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];

/// The side face over an edge, between two heights; edges: below, upright at its end, above, upright at its start.
fn side(edge: &Edge, low: f64, high: f64, [below, end, above, start]: [usize; 4]) -> CompressedFace<FaceSurface> {
    // Counter-clockwise about the normal to the right of the edge.
    let outward = vec![forward(below), forward(end), backward(above), backward(start)];
    let segment = match edge {
        Edge::Segment(segment) => segment,
        Edge::Cubic(cubic) => {
            // Raised to degree 3 in height too, in which it is straight.
            let heights = [low, low + (high - low) / 3.0, low + (high - low) * (2.0 / 3.0), high];
            let controls =
                cubic.points.iter().map(|point| heights.iter().map(|z| at_height(*point, *z)).collect()).collect();
            let surface = FaceSurface::Spline(SplineSurface { u: SPAN.to_vec(), v: SPAN.to_vec(), controls });
            return CompressedFace { boundaries: vec![outward], orientation: true, surface };
        }
    };
    if segment.bulge == 0.0 {
        let tangent = segment.start_tangent();
        let along = Vector3::new(tangent.x + 0.0, tangent.y + 0.0, 0.0);
        let normal = Vector3::new(tangent.y + 0.0, -tangent.x + 0.0, 0.0);
        let surface = FaceSurface::Plane { origin: at_height(segment.start, low), normal, along };
        return CompressedFace { boundaries: vec![outward], orientation: true, surface };
    }
    let surface = FaceSurface::Cylinder { origin: at_height(segment.centre(), low), radius: segment.radius().abs() };
    if segment.bulge > 0.0 {
        CompressedFace { boundaries: vec![outward], orientation: true, surface }
    } else {
        // Loops run counter-clockwise about the normal of the surface, which here points into the metal.
        let inward = vec![forward(start), forward(above), backward(end), backward(below)];
        CompressedFace { boundaries: vec![inward], orientation: false, surface }
    }
}

/// Volume within the boundary, mm³, by the divergence of (0, 0, z): the end faces only. Their area comes from the
/// vertices and the edges' own circles.
#[must_use]
pub fn enclosed_volume(boundary: &TruckBoundary) -> f64 {
    let mut volume = 0.0;
    for shell in &boundary.boundaries {
        for face in &shell.faces {
            let FaceSurface::Plane { origin, normal, .. } = &face.surface else { continue };
            if normal.z == 0.0 {
                continue;
            }
            // Counter-clockwise about the normal; seen from above that is reversed under a downward one, and so is the
            // normal: both signs cancel in z n_z × area about n.
            let area: f64 = face.boundaries.iter().flatten().map(|used| swept(shell, *used)).sum();
            volume += origin.z * area;
        }
    }
    volume
}

fn swept(shell: &TruckShell, used: CompressedEdgeIndex) -> f64 {
    let Some(edge) = shell.edges.get(used.index) else { return f64::NAN };
    let (Some(SolidVertex(a)), Some(SolidVertex(b))) =
        (shell.vertices.get(edge.vertices.0), shell.vertices.get(edge.vertices.1))
    else {
        return f64::NAN;
    };
    let area = match &edge.curve {
        // A flank of several spans has a volume of its own.
        EdgeCurve::Spline(spline) => match spline.controls.as_slice() {
            [a, b, c, d] => Cubic { points: [a, b, c, d].map(|p| Vector2::new(p.x, p.y)) }.area_and_moments().0,
            _ => return f64::NAN,
        },
        EdgeCurve::Line { .. } => 0.5 * (a.x * b.y - a.y * b.x),
        EdgeCurve::Circle { centre, radius, clockwise } => {
            // Under the chord a triangle with the origin, over it R²/2 (θ − sin θ); θ from the circle's centre, seen
            // from the chord, so that a nearly straight arc keeps its digits.
            let (radius, side) = (*radius, if *clockwise { -1.0 } else { 1.0 });
            let (dx, dy) = (b.x - a.x, b.y - a.y);
            let chord = (dx * dx + dy * dy).sqrt();
            let (mx, my) = (0.5 * (a.x + b.x) - centre.x, 0.5 * (a.y + b.y) - centre.y);
            let away = side * (mx * dy - my * dx) / chord;
            let turn = 2.0 * libm::atan2(0.5 * chord, away);
            0.5 * (a.x * b.y - a.y * b.x) + side * 0.5 * radius * radius * sweep_minus_sine(turn)
        }
    };
    if used.orientation { area } else { -area }
}

/// Largest distance of a vertex from the carriers of its edges, mm.
#[must_use]
pub fn largest_gap(boundary: &TruckBoundary) -> f64 {
    let mut worst = 0.0_f64;
    for shell in &boundary.boundaries {
        for edge in &shell.edges {
            for vertex in [edge.vertices.0, edge.vertices.1] {
                let Some(SolidVertex(point)) = shell.vertices.get(vertex) else { return f64::INFINITY };
                worst = worst.max(match &edge.curve {
                    EdgeCurve::Line { origin, direction } => (point - origin).cross(*direction).magnitude(),
                    EdgeCurve::Spline(spline) => {
                        let ends = [spline.controls.first(), spline.controls.last()];
                        ends.iter().flatten().map(|end| (point - **end).magnitude()).fold(f64::INFINITY, f64::min)
                    }
                    EdgeCurve::Circle { centre, radius, .. } => {
                        let away = point - centre;
                        (away.magnitude() - radius).abs().max(away.z.abs())
                    }
                });
            }
        }
    }
    worst
}

#[cfg(test)]
mod tests;

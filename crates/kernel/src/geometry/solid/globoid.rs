//! A globoid: a round blank with a hollow outside, conical ends, and grooves that run from one end to the other. Its floor and its outside are parts of two tori.

use super::flank_strip::ShellFlank;
use super::{
    CheckedSolid, EdgeCurve, FaceSurface, ShellBuilder, SolidVertex, SplineCurve, SplineSurface, TruckBoundary,
    backward, check_closed, forward,
};
use crate::geometry::contour::Contour;
use crate::numeric::spline::{Spline, bspline_knots};
use crate::refusal::Refusal;
use std::f64::consts::{PI, TAU};
use truck_modeling::{Point3, Vector3};
use truck_topology::compress::CompressedEdgeIndex;

/// A groove: both of its flanks in the order of the cam angle, u along it and v from the floor to the outside.
#[derive(Debug, Clone)]
pub struct GlobeGroove {
    /// The flank whose metal lies above.
    pub upper: Vec<SplineSurface>,
    /// The flank whose metal lies below.
    pub lower: Vec<SplineSurface>,
}

/// A globoid about the z axis, mm, whose grooves rise with a growing polar angle.
#[derive(Debug, Clone, Copy)]
pub struct GrooveGloboid<'a> {
    /// The grooves, each below the one before; above the first lies the last, a turn later.
    pub grooves: &'a [GlobeGroove],
    /// For the rib above each groove, the patches of its upper flank, and of the lower flank of the groove above, that begin at one cam angle: there it is divided.
    pub ribs: &'a [Vec<(usize, usize)>],
    /// The same for each groove: the patches of its upper and of its lower flank.
    pub floors: &'a [Vec<(usize, usize)>],
    /// Distance of the circle in the middle of the tubes of outside and floor from the axis, and the radii of these tubes.
    pub tubes: (f64, [f64; 2]),
    /// Half the angle about that circle over which it reaches, rad.
    pub end_angle: f64,
    /// Holes from end to end, clockwise.
    pub holes: &'a [Contour],
    /// Whether it is made as its mirror image about the plane of x and z.
    pub mirrored: bool,
}

/// Longest span of a spline in place of an arc of a tube, rad: it misses the arc by r h⁴/384.
const ARC_SPAN: f64 = PI / 180.0;

/// The edges of an end about the part of a strip.
struct Opening {
    /// Counter-clockwise, from the flank above to the flank below the strip.
    arcs: Vec<usize>,
}

/// A strip between two flanks on a torus: the flank below it, that above it, and the stations at which it is divided.
struct Strip<'s> {
    below: &'s ShellFlank,
    above: &'s ShellFlank,
    seams: Vec<(usize, usize)>,
    outside: bool,
    /// At the lower and at the upper end.
    openings: [Opening; 2],
}

impl GrooveGloboid<'_> {
    /// The solid, if it is closed, with the volume that its drawing has, mm³.
    ///
    /// # Errors
    /// [`Refusal`] when it is not closed, which would be a fault of camgen.
    pub fn solid(&self, volume: f64) -> Result<CheckedSolid, Refusal> {
        let boundary = if self.mirrored { mirrored(self.boundary()) } else { self.boundary() };
        check_closed(&boundary)?;
        Ok(CheckedSolid { boundary, volume })
    }

    /// Radius and height of a circle of an end (−1 below, 1 above) on the outside or on the floor.
    fn rim(&self, end: f64, outside: bool) -> (f64, f64) {
        let (distance, [outer, floor]) = self.tubes;
        let tube = if outside { outer } else { floor };
        let (sin, cos) = libm::sincos(self.end_angle);
        (distance - tube * cos, end * tube * sin)
    }

    fn boundary(&self) -> TruckBoundary {
        let height = self.rim(1.0, false).1;
        let mut walls = ShellBuilder::new((-height, height));
        let flanks = self.grooves.iter().map(|groove| {
            let upper = ShellFlank::add(&mut walls, &groove.upper, 1.0, false);
            (upper, ShellFlank::add(&mut walls, &groove.lower, -1.0, false))
        });
        let flanks: Vec<(ShellFlank, ShellFlank)> = flanks.collect();
        let (mut bottom, mut top) = (Vec::new(), Vec::new());
        let count = flanks.len().max(1);
        for (index, (upper, lower)) in flanks.iter().enumerate() {
            let Some((_, above)) = flanks.get((index + count - 1) % count) else { continue };
            let ribs = self.ribs.get(index).cloned().unwrap_or_default();
            let floors = self.floors.get(index).cloned().unwrap_or_default();
            let openings = [-1.0, 1.0].map(|end| self.end_of_rib(&mut walls, upper, above, end));
            let [low, high] = openings;
            for (rim, end) in [(&mut bottom, &low), (&mut top, &high)] {
                rim.extend(end.1.iter().copied());
            }
            let rib = Strip { below: upper, above, seams: ribs, outside: true, openings: [low.0, high.0] };
            self.strip(&mut walls, &rib);
            let openings = [-1.0, 1.0].map(|end| self.end_of_groove(&mut walls, lower, upper, end));
            for (rim, end) in [&mut bottom, &mut top].into_iter().zip(&openings) {
                rim.extend(end.arcs.iter().copied());
            }
            let seams = floors.into_iter().map(|(upper, lower)| (lower, upper)).collect();
            self.strip(&mut walls, &Strip { below: lower, above: upper, seams, outside: false, openings });
        }
        walls.above.push(top.iter().map(|edge| forward(*edge)).collect());
        walls.under.push(bottom.iter().rev().map(|edge| backward(*edge)).collect());
        for hole in self.holes {
            walls.over(hole);
        }
        walls.capped()
    }

    /// The station of a flank at an end.
    fn station(flank: &ShellFlank, end: f64) -> usize {
        if end > 0.0 { flank.last() } else { 0 }
    }

    /// The conical end of the rib between a flank below and a flank above it, in two faces: its edges along the outside, and those along the floor.
    fn end_of_rib(
        &self,
        walls: &mut ShellBuilder,
        below: &ShellFlank,
        above: &ShellFlank,
        end: f64,
    ) -> (Opening, Vec<usize>) {
        let (from, to) = (Self::station(above, end), Self::station(below, end));
        let outer = Self::arcs_in_two(walls, (above.outer(from), below.outer(to)), self.rim(end, true), None);
        let middle = polar(walls.place(outer.middle));
        let floor = Self::arcs_in_two(walls, (above.floor(from), below.floor(to)), self.rim(end, false), Some(middle));
        let line = walls.add_line(outer.middle, floor.middle);
        let ((radius, z), (inner, inner_z)) = (self.rim(end, true), self.rim(end, false));
        let cone = FaceSurface::Cone { at: (z, radius), angle: libm::atan((inner - radius) / (inner_z - z)) };
        let sides = [above.outwards(from), below.outwards(to)];
        // Outwards runs an edge of a flank from the floor to the outside.
        let parts = [
            [forward(outer.arcs[0]), forward(line), backward(floor.arcs[0]), forward(sides[0])],
            [forward(outer.arcs[1]), backward(sides[1]), backward(floor.arcs[1]), backward(line)],
        ];
        for part in parts {
            let run = if end > 0.0 { part.to_vec() } else { part.iter().rev().map(|used| turned(*used)).collect() };
            walls.add_face(run, cone.clone(), false);
        }
        (Opening { arcs: outer.arcs.to_vec() }, floor.arcs.to_vec())
    }

    /// The edge across the floor of a groove at an end.
    fn end_of_groove(&self, walls: &mut ShellBuilder, below: &ShellFlank, above: &ShellFlank, end: f64) -> Opening {
        let (from, to) = (Self::station(above, end), Self::station(below, end));
        Opening { arcs: vec![walls.add_arc((above.floor(from), below.floor(to)), self.rim(end, false))] }
    }

    /// An arc counter-clockwise from one vertex to another, divided at a polar angle, else in the middle.
    fn arcs_in_two(
        walls: &mut ShellBuilder,
        (from, to): (usize, usize),
        (radius, z): (f64, f64),
        divided: Option<f64>,
    ) -> TwoArcs {
        let start = polar(walls.place(from));
        let sweep = (polar(walls.place(to)) - start).rem_euclid(TAU);
        let (sin, cos) = libm::sincos(divided.unwrap_or(start + 0.5 * sweep));
        let middle = walls.add_vertex(Point3::new(radius * cos, radius * sin, z));
        let arcs = [(from, middle), (middle, to)].map(|ends| walls.add_arc(ends, (radius, z)));
        TwoArcs { arcs, middle }
    }

    /// The faces of a strip on its torus.
    fn strip(&self, walls: &mut ShellBuilder, strip: &Strip<'_>) {
        let (major, [outer, floor]) = self.tubes;
        let minor = if strip.outside { outer } else { floor };
        let vertex =
            |flank: &ShellFlank, station| if strip.outside { flank.outer(station) } else { flank.floor(station) };
        let edges = |flank: &ShellFlank, from: usize, to: usize| -> Vec<usize> {
            if strip.outside { flank.outer_edges(from, to).collect() } else { flank.floor_edges(from, to).collect() }
        };
        let across = strip.seams.iter().map(|(below, above)| {
            let ends = (vertex(strip.below, *below), vertex(strip.above, *above));
            let curve = tube_line([walls.place(ends.0), walls.place(ends.1)], major, minor);
            walls.add_spline(ends.0, ends.1, curve)
        });
        let across: Vec<usize> = across.collect();
        let [low, high] = &strip.openings;
        let mut from = (0, 0);
        for index in 0..=strip.seams.len() {
            let to = strip.seams.get(index).copied().unwrap_or((strip.below.last(), strip.above.last()));
            let mut run: Vec<CompressedEdgeIndex> = edges(strip.below, from.0, to.0).into_iter().map(forward).collect();
            match across.get(index) {
                Some(edge) => run.push(forward(*edge)),
                None => run.extend(high.arcs.iter().rev().map(|edge| backward(*edge))),
            }
            run.extend(edges(strip.above, from.1, to.1).into_iter().rev().map(backward));
            match index.checked_sub(1).and_then(|before| across.get(before)) {
                Some(edge) => run.push(backward(*edge)),
                None => run.extend(low.arcs.iter().map(|edge| forward(*edge))),
            }
            walls.add_face(run, FaceSurface::Torus { major, minor }, true);
            from = to;
        }
    }
}

/// An arc in two parts with the vertex between them.
struct TwoArcs {
    arcs: [usize; 2],
    middle: usize,
}

/// An angle between −π and π.
fn signed_turn(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

fn polar(place: Point3) -> f64 {
    libm::atan2(place.y, place.x)
}

fn turned(used: CompressedEdgeIndex) -> CompressedEdgeIndex {
    CompressedEdgeIndex { index: used.index, orientation: !used.orientation }
}

/// A line on a torus between two places, along which the polar angle and that about the tube grow evenly: at one polar angle the arc of the tube.
fn tube_line([from, to]: [Point3; 2], major: f64, minor: f64) -> SplineCurve {
    let [start, end] = [from, to].map(|place| libm::atan2(place.z, major - libm::hypot(place.x, place.y)));
    let (first, turn) = (polar(from), signed_turn(polar(to) - polar(from)));
    let mut spans = 2.0;
    while (end - start).abs().max(turn.abs()) / spans > ARC_SPAN {
        spans *= 2.0;
    }
    let mut shares = Vec::new();
    let mut i = 0.0;
    while i <= spans {
        shares.push(i / spans);
        i += 1.0;
    }
    // Place and slope by the share of the way.
    let along = |share: f64| {
        let (s, c) = libm::sincos(start + (end - start) * share);
        let (sin, cos) = libm::sincos(first + turn * share);
        let (radius, by) = (major - minor * c, minor * s * (end - start));
        let place = [radius * cos, radius * sin, minor * s];
        (place, [by * cos - radius * sin * turn, by * sin + radius * cos * turn, minor * c * (end - start)])
    };
    let [x, y, z] = [0, 1, 2].map(|axis| {
        let values: Vec<f64> = shares.iter().map(|share| along(*share).0[axis]).collect();
        Spline::clamped(&shares, &values, (along(0.0).1[axis], along(1.0).1[axis])).controls()
    });
    let mut controls: Vec<Point3> = x.into_iter().zip(y).zip(z).map(|((x, y), z)| Point3::new(x, y, z)).collect();
    // The ends are the vertices themselves.
    if let [first, .., last] = controls.as_mut_slice() {
        (*first, *last) = (from, to);
    }
    SplineCurve { knots: bspline_knots(&shares), controls }
}

/// The mirror image about the plane of x and z.
fn mirrored(mut boundary: TruckBoundary) -> TruckBoundary {
    for shell in &mut boundary.boundaries {
        for vertex in &mut shell.vertices {
            *vertex = SolidVertex(flip(vertex.0));
        }
        for edge in &mut shell.edges {
            match &mut edge.curve {
                EdgeCurve::Line { origin, direction } => {
                    *origin = flip(*origin);
                    *direction = Vector3::new(direction.x, -direction.y + 0.0, direction.z);
                }
                EdgeCurve::Circle { centre, clockwise, .. } => (*centre, *clockwise) = (flip(*centre), !*clockwise),
                EdgeCurve::Spline(spline) => spline.controls.iter_mut().for_each(|control| *control = flip(*control)),
            }
        }
        for face in &mut shell.faces {
            match &mut face.surface {
                FaceSurface::Plane { origin, normal, along } => {
                    *origin = flip(*origin);
                    *normal = Vector3::new(normal.x, -normal.y + 0.0, normal.z);
                    *along = Vector3::new(along.x, -along.y + 0.0, along.z);
                }
                FaceSurface::Cylinder { origin, .. } => *origin = flip(*origin),
                FaceSurface::Cone { .. } | FaceSurface::Torus { .. } => {}
                FaceSurface::Spline(spline) => {
                    let mut patch = spline.transposed();
                    patch.controls.iter_mut().flatten().for_each(|control| *control = flip(*control));
                    *spline = patch;
                }
            }
            for run in &mut face.boundaries {
                *run = run.iter().rev().map(|used| turned(*used)).collect();
            }
        }
    }
    boundary
}

fn flip(point: Point3) -> Point3 {
    Point3::new(point.x, -point.y + 0.0, point.z)
}

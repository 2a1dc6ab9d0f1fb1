//! A part of plane layers as a solid: upright walls, and the level faces between them.

use super::{CheckedSolid, ShellBuilder, TruckBoundary, as_drawn, check_closed};
use crate::geometry::contour::Contour;
use crate::geometry::section::crossings;
use crate::refusal::Refusal;
use nalgebra::Vector2;
use truck_modeling::Vector3;
use truck_topology::compress::{CompressedEdgeIndex, CompressedSolid};

/// An upright wall over a contour that has the metal on its left.
///
/// A wall ends at a level face that lies on its left, the top of a disc, or, if it stands on wider metal, at one that lies on its right: the face round a
/// hub, the floor round a land.
#[derive(Debug, Clone, PartialEq)]
pub struct Wall {
    /// The contour: counter-clockwise with the metal inside, clockwise round a hole.
    pub contour: Contour,
    /// Height of its lower end, mm.
    pub low: f64,
    /// Height of its upper end, mm.
    pub high: f64,
    /// Whether the metal goes on below its lower end and is wider there.
    pub stands_on_metal: bool,
    /// Whether the metal goes on above its upper end and is wider there.
    pub carries_metal: bool,
}

impl Wall {
    /// A wall between two ends of the part.
    #[must_use]
    pub fn through(contour: Contour, low: f64, high: f64) -> Self {
        Self { contour, low, high, stands_on_metal: false, carries_metal: false }
    }

    fn area(&self) -> f64 {
        self.contour.area_and_centroid().0
    }
}

/// The solid that walls bound, checked: closed by the rules of truck, and with the volume of the drawing. Level faces are found by the heights at which
/// walls end.
///
/// ```
/// # use camgen_kernel as camgen;
/// use camgen::geometry::solid::stacked::{Wall, stacked};
/// use camgen::{Contour, Vector2};
/// use std::f64::consts::PI;
///
/// // A disc of Ø80 × 10 mm with a bore of Ø20 and, below it, a hub of Ø40 × 15 mm.
/// let circle = |radius| Contour::circle(Vector2::zeros(), radius);
/// let hub = Wall { carries_metal: true, ..Wall::through(circle(20.0), -15.0, 0.0) };
/// let bore = Wall::through(circle(10.0).reversed(), -15.0, 10.0);
/// let solid = stacked(&[Wall::through(circle(40.0), 0.0, 10.0), hub, bore])?;
/// let exact = PI * ((1600.0 - 100.0) * 10.0 + (400.0 - 100.0) * 15.0);
/// assert!((solid.volume / exact - 1.0).abs() < 1e-12);
/// # Ok::<(), camgen::refusal::Refusal>(())
/// ```
///
/// # Errors
/// [`Refusal`] when a check fails; all would be faults of camgen.
pub fn stacked(walls: &[Wall]) -> Result<CheckedSolid, Refusal> {
    let boundary = boundary(walls);
    check_closed(&boundary)?;
    as_drawn(boundary, walls.iter().map(|wall| wall.area() * (wall.high - wall.low)).sum())
}

/// A closed run of edges of a level face.
struct LevelLoop<'a> {
    height: f64,
    /// Whether the face looks up.
    is_up: bool,
    /// Whether it is the outermost of its face.
    is_outer: bool,
    contour: &'a Contour,
    edges: Vec<CompressedEdgeIndex>,
}

fn boundary(walls: &[Wall]) -> TruckBoundary {
    let mut shell = ShellBuilder::new((0.0, 0.0));
    let mut loops = Vec::with_capacity(2 * walls.len());
    for wall in walls {
        shell.ends = (wall.low, wall.high);
        shell.over(&wall.contour);
        let is_outer = wall.area() > 0.0;
        let ends = [
            (shell.under.pop(), wall.low, wall.stands_on_metal, false),
            (shell.above.pop(), wall.high, wall.carries_metal, true),
        ];
        for (edges, height, is_step, is_top) in ends {
            loops.extend(edges.map(|edges| LevelLoop {
                height,
                is_up: is_top != is_step,
                is_outer: is_outer != is_step,
                contour: &wall.contour,
                edges,
            }));
        }
    }
    add_level_faces(&mut shell, loops);
    CompressedSolid { boundaries: vec![shell.shell] }
}

/// Adds the level faces from the lowest to the highest, each with the loops that lie directly within its outer one.
fn add_level_faces(shell: &mut ShellBuilder, mut loops: Vec<LevelLoop<'_>>) {
    loops.sort_by(|a, b| a.height.total_cmp(&b.height).then(a.is_up.cmp(&b.is_up)));
    let (outer, inner): (Vec<LevelLoop<'_>>, Vec<LevelLoop<'_>>) = loops.into_iter().partition(|found| found.is_outer);
    let mut within: Vec<Vec<Vec<CompressedEdgeIndex>>> = vec![Vec::new(); outer.len()];
    for found in inner {
        let around = outer.iter().enumerate().filter(|(_, outer)| found.is_in(outer));
        let smallest = around.min_by(|a, b| a.1.area().total_cmp(&b.1.area())).map(|(index, _)| index);
        if let Some(loops) = smallest.and_then(|index| within.get_mut(index)) {
            loops.push(found.edges);
        }
    }
    for (outer, within) in outer.into_iter().zip(within) {
        let normal = if outer.is_up { Vector3::unit_z() } else { -Vector3::unit_z() };
        let boundaries = std::iter::once(outer.edges).chain(within).collect();
        shell.level(boundaries, outer.height, normal);
    }
}

impl LevelLoop<'_> {
    fn area(&self) -> f64 {
        self.contour.area_and_centroid().0.abs()
    }

    /// Whether it lies within the outer loop of a face of its height and side.
    fn is_in(&self, outer: &Self) -> bool {
        let is_level = self.height == outer.height && self.is_up == outer.is_up;
        let point = self.contour.edges().next().map(|edge| edge.point_and_tangent(0.5).0);
        is_level && point.is_some_and(|point| encloses(outer.contour, point))
    }
}

/// Whether a point lies inside a contour.
fn encloses(contour: &Contour, point: Vector2<f64>) -> bool {
    let beyond = crossings(contour, point, Vector2::x()).into_iter().filter(|distance| *distance > 0.0);
    beyond.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn circle(radius: f64) -> Contour {
        Contour::circle(Vector2::zeros(), radius)
    }

    fn hole(x: f64, radius: f64) -> Contour {
        Contour::circle(Vector2::new(x, 0.0), radius).reversed()
    }

    /// A plate with a groove, hubs on both sides, and holes within the hub, on the land and outside the groove: the volume by closed form, and the numbers
    /// of level faces and of loops.
    #[test]
    fn a_groove_with_two_hubs() {
        let (thickness, depth, back, front) = (12.0, 5.0, 20.0, 8.0);
        let stands = |contour, low, high| Wall { stands_on_metal: true, ..Wall::through(contour, low, high) };
        let walls = [
            Wall::through(circle(60.0), 0.0, thickness),
            Wall::through(circle(6.0).reversed(), -back, thickness + front),
            Wall::through(hole(12.0, 2.0), -back, thickness + front),
            Wall::through(hole(28.0, 3.0), 0.0, thickness),
            Wall::through(hole(55.0, 2.5), 0.0, thickness),
            stands(circle(35.0), thickness - depth, thickness),
            stands(circle(45.0).reversed(), thickness - depth, thickness),
            Wall { carries_metal: true, ..Wall::through(circle(18.0), -back, 0.0) },
            stands(circle(18.0), thickness, thickness + front),
        ];
        let solid = stacked(&walls).expect("a solid");
        let through = 3600.0 - 36.0 - 4.0 - 9.0 - 6.25;
        let groove = (45.0 * 45.0 - 35.0 * 35.0) * depth;
        let hubs = (18.0 * 18.0 - 36.0 - 4.0) * (back + front);
        let exact = PI * (through * thickness - groove + hubs);
        assert!((solid.volume / exact - 1.0).abs() < 1e-12, "{} {exact}", solid.volume);
        let faces = &solid.boundary.boundaries[0].faces;
        let is_level = |surface: &super::super::FaceSurface| matches!(surface, super::super::FaceSurface::Plane { normal, .. } if normal.z.abs() > 0.5);
        let loops: Vec<usize> =
            faces.iter().filter(|face| is_level(&face.surface)).map(|face| face.boundaries.len()).collect();
        // Back of the hub, back of the plate, floor, outer land, inner land, front of the hub.
        assert_eq!(loops, [3, 4, 2, 3, 3, 3]);
    }
}

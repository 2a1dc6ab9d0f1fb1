//! Whether a boundary is closed, which is a matter of its topology alone.
//!
//! The rules are those of truck-topology, which the tests ask as well; on the indices of a boundary they take a tenth of the time. A loop of
//! a face goes on from edge to edge, comes back to its start and passes no vertex twice, nor one of another loop of the face. Every edge
//! lies between two faces, which use it in opposite directions. About every vertex the faces of a shell are one fan, and all of it hangs
//! together.

use super::{Boundary, Shell, SolidError};
use truck_topology::compress::CompressedEdgeIndex;

/// Refuses a boundary that is not closed.
pub(super) fn check(boundary: &Boundary) -> Result<(), SolidError> {
    let closed = boundary.boundaries.iter().try_for_each(of_shell);
    closed.map_err(|fault| SolidError::NotClosed(fault.into()))
}

/// What is wrong with a shell.
type Fault = &'static str;

fn of_shell(shell: &Shell) -> Result<(), Fault> {
    if shell.faces.is_empty() {
        return Err("a shell has no face");
    }
    let known = |vertex: usize| vertex < shell.vertices.len();
    if !shell
        .edges
        .iter()
        .all(|edge| edge.vertices.0 != edge.vertices.1 && known(edge.vertices.0) && known(edge.vertices.1))
    {
        return Err("an edge does not lead from one vertex to another");
    }
    let (follows, vertices) = followers(shell)?;
    if fans(&follows) != vertices {
        return Err("the faces about a vertex are more than one fan");
    }
    if joints(shell) + 1 != vertices {
        return Err("a shell does not hang together");
    }
    Ok(())
}

/// No face, and no use of an edge.
const NONE: usize = usize::MAX;

/// Of each use of an edge the one behind it in its loop, seen from outside, and the number of vertices that are passed. Edge i is used by two
/// faces: by one from its first vertex to its second, use 2i, by the other back, use 2i + 1.
fn followers(shell: &Shell) -> Result<(Vec<usize>, usize), Fault> {
    let mut follows = vec![NONE; 2 * shell.edges.len()];
    // The last face that has passed a vertex.
    let mut passed = vec![NONE; shell.vertices.len()];
    for (number, face) in shell.faces.iter().enumerate() {
        let of = |used: &CompressedEdgeIndex| 2 * used.index + usize::from(used.orientation != face.orientation);
        for ring in &face.boundaries {
            let Some(mut before) = ring.last() else { return Err("a face has an empty loop") };
            for used in ring {
                let (at, end) = (ends(shell, used)?.0, ends(shell, before)?.1);
                if at != end {
                    return Err("a loop of a face does not go on from edge to edge");
                }
                if passed.get_mut(at).is_none_or(|last| std::mem::replace(last, number) == number) {
                    return Err("a face passes a vertex twice");
                }
                let (first, second) = if face.orientation { (before, used) } else { (used, before) };
                if follows.get_mut(of(first)).is_none_or(|next| std::mem::replace(next, of(second)) != NONE) {
                    return Err("two faces use an edge in the same direction");
                }
                before = used;
            }
        }
    }
    if follows.contains(&NONE) {
        return Err("an edge does not lie between two faces");
    }
    Ok((follows, passed.iter().filter(|face| **face != NONE).count()))
}

/// The vertices that a face goes from and to along an edge.
fn ends(shell: &Shell, used: &CompressedEdgeIndex) -> Result<(usize, usize), Fault> {
    let (start, end) = shell.edges.get(used.index).ok_or("a face has an edge that is not there")?.vertices;
    Ok(if used.orientation { (start, end) } else { (end, start) })
}

/// The fans of faces about all vertices: from a use that ends at one to the use behind it, which the next face has the other way.
fn fans(follows: &[usize]) -> usize {
    let mut seen = vec![false; follows.len()];
    let mut fan = |start: usize| {
        let mut at = start;
        let mut new = false;
        while let (Some(seen @ false), Some(next)) = (seen.get_mut(at), follows.get(at)) {
            (*seen, new, at) = (true, true, next ^ 1);
        }
        new
    };
    (0..follows.len()).filter(|start| fan(*start)).count()
}

/// The edges, and steps from one loop of a face to its next, that join parts of a shell which did not hang together before: one less than
/// there are vertices where all of it does.
fn joints(shell: &Shell) -> usize {
    let mut towards: Vec<usize> = (0..shell.vertices.len()).collect();
    let mut joins = |a: usize, b: usize| {
        let (a, b) = (first_of(&mut towards, a), first_of(&mut towards, b));
        towards.get_mut(a).is_some_and(|towards| std::mem::replace(towards, b) != b)
    };
    let along_edges = shell.edges.iter().filter(|edge| joins(edge.vertices.0, edge.vertices.1)).count();
    let starts = |rings: &[Vec<CompressedEdgeIndex>]| {
        let start = |ring: &Vec<CompressedEdgeIndex>| Some(ends(shell, ring.first()?).ok()?.0);
        Some((start(rings.first()?)?, start(rings.get(1)?)?))
    };
    let between_loops = shell.faces.iter().flat_map(|face| face.boundaries.windows(2).filter_map(starts));
    along_edges + between_loops.filter(|(a, b)| joins(*a, *b)).count()
}

/// The vertex that stands for all that hang together with one.
fn first_of(towards: &mut [usize], vertex: usize) -> usize {
    let mut at = vertex;
    while let Some(next) = towards.get(at).copied().filter(|next| *next != at) {
        // The way there is halved for those who come next.
        let after = towards.get(next).copied().unwrap_or(next);
        if let Some(towards) = towards.get_mut(at) {
            *towards = after;
        }
        at = after;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::contour::Contour;
    use crate::geometry::solid::extruded;
    use nalgebra::Vector2;

    /// Asks truck, which indexes without a look.
    fn is_closed(boundary: &Boundary) -> bool {
        truck_topology::Solid::extract(boundary.clone()).is_ok()
    }

    fn ring() -> Boundary {
        let outline = Contour::circle(Vector2::zeros(), 50.0);
        let hole = Contour::circle(Vector2::zeros(), 10.0).reversed();
        extruded(&[outline, hole], 20.0)
    }

    /// Every fault that a change of one index or one direction can make is one by both.
    #[test]
    fn what_truck_refuses_is_refused() {
        let good = ring();
        assert!(check(&good).is_ok() && is_closed(&good));
        let mut broken = Vec::new();
        let shell = &good.boundaries[0];
        let mut changed = |change: &dyn Fn(&mut Shell)| {
            let mut boundary = good.clone();
            change(&mut boundary.boundaries[0]);
            broken.push(boundary);
        };
        for face in 0..shell.faces.len() {
            changed(&|shell| drop(shell.faces.remove(face)));
            changed(&|shell| shell.faces.push(shell.faces[face].clone()));
            changed(&|shell| shell.faces[face].orientation = !shell.faces[face].orientation);
            for ring in 0..shell.faces[face].boundaries.len() {
                changed(&|shell| drop(shell.faces[face].boundaries.remove(ring)));
                changed(&|shell| shell.faces[face].boundaries[ring].clear());
                changed(&|shell| shell.faces[face].boundaries[ring].reverse());
                for used in 0..shell.faces[face].boundaries[ring].len() {
                    changed(&|shell| _ = shell.faces[face].boundaries[ring].remove(used));
                    changed(&|shell| shell.faces[face].boundaries[ring][used].orientation ^= true);
                    for edge in 0..shell.edges.len() {
                        changed(&|shell| shell.faces[face].boundaries[ring][used].index = edge);
                    }
                }
            }
        }
        for edge in 0..shell.edges.len() {
            for vertex in 0..shell.vertices.len() {
                changed(&|shell| shell.edges[edge].vertices.0 = vertex);
                changed(&|shell| shell.edges[edge].vertices.1 = vertex);
            }
        }
        for boundary in broken {
            assert_eq!(check(&boundary).is_ok(), is_closed(&boundary), "{:?} {boundary:?}", check(&boundary));
        }
    }

    /// Two solids that touch in a vertex, or not at all, are no single shell.
    #[test]
    fn what_does_not_hang_together_in_faces_is_refused() {
        let one = ring();
        let both = |joined: Option<usize>| {
            let mut both = one.clone();
            let shell = &mut both.boundaries[0];
            let (vertices, edges) = (shell.vertices.len(), shell.edges.len());
            let vertex = |vertex: usize| if Some(vertex) == joined { vertex } else { vertex + vertices };
            let other = one.boundaries[0].clone();
            shell.vertices.extend(other.vertices);
            shell.edges.extend(other.edges.into_iter().map(|mut edge| {
                edge.vertices = (vertex(edge.vertices.0), vertex(edge.vertices.1));
                edge
            }));
            shell.faces.extend(other.faces.into_iter().map(|mut face| {
                face.boundaries.iter_mut().flatten().for_each(|used| used.index += edges);
                face
            }));
            both
        };
        for (joined, told) in [(None, "hang together"), (Some(0), "one fan")] {
            let boundary = both(joined);
            assert!(!is_closed(&boundary));
            let fault = check(&boundary).expect_err("two solids").to_string();
            assert!(fault.contains(told), "{fault}");
        }
    }
}

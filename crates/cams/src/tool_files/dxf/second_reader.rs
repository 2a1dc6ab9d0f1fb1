//! The second reader of a cut file: the dxf crate, which shares no code with `reading`.

use crate::body::Layer;
use camgen_kernel::geometry::Entity;
use camgen_kernel::geometry::contour::Contour;
use camgen_kernel::geometry::cubics::{CurveRun, runs};
use dxf::entities::EntityType;
use nalgebra::Vector2;

/// Rounding of a coordinate to twelve decimals, and of a bulge, mm.
const ROUNDING: f64 = 1e-11;

/// How the file represents one thing that was drawn.
enum ExpectedEntity<'a> {
    Entity(&'a Entity),
    /// A part of an outline with splines, which is written curve by curve.
    Run(CurveRun),
}

/// Whether the dxf crate finds these entities in the bytes, in their order and on their layers, and no others.
pub(super) fn holds(bytes: &[u8], drawn: &[(Layer, Entity)]) -> bool {
    let Ok(drawing) = dxf::Drawing::load(&mut &*bytes) else { return false };
    let found: Vec<_> = drawing.entities().collect();
    let mut expected = Vec::new();
    for (layer, entity) in drawn {
        match entity {
            Entity::Polyline(contour) if contour.cubics() > 0 => {
                expected.extend(runs(contour).into_iter().map(|run| (layer, ExpectedEntity::Run(run))));
            }
            Entity::Segment(segment) => expected.push((layer, ExpectedEntity::Run(CurveRun::Segment(*segment)))),
            Entity::Polyline(_) | Entity::Circle(..) => expected.push((layer, ExpectedEntity::Entity(entity))),
        }
    }
    expected.len() == found.len()
        && expected.iter().zip(found).all(|((layer, expected), found)| {
            let same = match expected {
                ExpectedEntity::Entity(entity) => same_entity(entity, &found.specific),
                ExpectedEntity::Run(run) => same_run(run, &found.specific),
            };
            same && found.common.layer == layer.name()
        })
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING
}

fn at(point: Vector2<f64>, found: &dxf::Point) -> bool {
    near(point.x, found.x) && near(point.y, found.y)
}

fn same_chain(contour: &Contour, closed: bool, found: &mut dyn Iterator<Item = [f64; 3]>) -> bool {
    let all = contour.vertices.iter().all(|v| {
        let bulge = v.bulge().unwrap_or(f64::NAN);
        found.next().is_some_and(|[x, y, b]| near(v.point.x, x) && near(v.point.y, y) && near(bulge, b))
    });
    all && closed && found.next().is_none()
}

fn same_entity(entity: &Entity, found: &EntityType) -> bool {
    match (entity, found) {
        (Entity::Polyline(contour), EntityType::LwPolyline(line)) => {
            same_chain(contour, line.is_closed(), &mut line.vertices.iter().map(|v| [v.x, v.y, v.bulge]))
        }
        (Entity::Polyline(contour), EntityType::Polyline(line)) => {
            let mut vertices = line.vertices().map(|v| [v.location.x, v.location.y, v.bulge]);
            same_chain(contour, line.is_closed(), &mut vertices)
        }
        (Entity::Circle(centre, radius), EntityType::Circle(circle)) => {
            at(*centre, &circle.center) && near(*radius, circle.radius)
        }
        _ => false,
    }
}

fn same_run(run: &CurveRun, found: &EntityType) -> bool {
    match (run, found) {
        (CurveRun::Segment(segment), EntityType::Line(line)) => {
            at(segment.start, &line.p1) && at(segment.end, &line.p2)
        }
        (CurveRun::Segment(segment), EntityType::Arc(arc)) => {
            let (from, to) = segment.angles();
            let angles = near(from, arc.start_angle) && near(to, arc.end_angle);
            at(segment.centre(), &arc.center) && near(segment.radius().abs(), arc.radius) && angles
        }
        (CurveRun::Spline(spline), EntityType::Spline(found)) => {
            found.degree_of_curve == 3
                && found.weight_values.is_empty()
                && spline.knots.len() == found.knot_values.len()
                && spline.controls.len() == found.control_points.len()
                && spline.knots.iter().zip(&found.knot_values).all(|(a, b)| near(*a, *b))
                && spline.controls.iter().zip(&found.control_points).all(|(a, b)| at(*a, b))
        }
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::super::write::{Version, write};
    use super::*;
    use camgen_kernel::geometry::contour::Bend;

    /// A chain of the dxf crate is the one that was drawn when it has every vertex, no other, and is closed.
    #[test]
    fn a_chain_is_the_same_with_all_of_it() {
        let circle = Contour::circle(Vector2::new(3.0, 4.0), 50.0);
        let rows = |contour: &Contour| -> Vec<[f64; 3]> {
            contour.vertices.iter().map(|v| [v.point.x, v.point.y, v.bulge().expect("an arc")]).collect()
        };
        let all = rows(&circle);
        let same = |closed: bool, found: &[[f64; 3]]| same_chain(&circle, closed, &mut found.iter().copied());
        assert!(same(true, &all));
        assert!(!same(false, &all), "open");
        assert!(!same(true, &[&all[..], &all[..1]].concat()), "one more");
        assert!(!same(true, &all[1..]), "one less");
    }

    #[test]
    fn the_second_reader_misses_nothing_and_finds_nothing_more() {
        let drawn = [
            (Layer::CamProfile, Entity::Polyline(Contour::circle(Vector2::new(3.0, 4.0), 50.0))),
            (Layer::Bore, Entity::Circle(Vector2::new(1.0, 2.0), 5.0)),
        ];
        for (name, version) in Version::ALL {
            let bytes = write(&drawn, version);
            assert!(holds(&bytes, &drawn), "{name}");
            assert!(!holds(&bytes, &drawn[..1]), "{name}: one more than drawn");
            let mut moved = drawn.clone();
            moved[1].1 = Entity::Circle(Vector2::new(1.0, 2.0 + 1e-10), 5.0);
            assert!(!holds(&bytes, &moved), "{name}: moved");
            moved[1] = (Layer::CutterPath, drawn[1].1.clone());
            assert!(!holds(&bytes, &moved), "{name}: another layer");
            let Entity::Polyline(mut chain) = drawn[0].1.clone() else { unreachable!("a polyline") };
            chain.vertices[0].bend = Bend::Arc(1.0 + 1e-9);
            assert!(!holds(&bytes, &[(Layer::CamProfile, Entity::Polyline(chain)), drawn[1].clone()]), "{name}: bent");
        }
    }
}

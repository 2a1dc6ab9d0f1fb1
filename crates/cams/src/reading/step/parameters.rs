//! Whether entities have the parameters of ISO 10303-42 and -41, no less and no more: other readers leave out an entity that has not, or
//! take it for something else.

use super::exchange::{ExchangeData, StepInstance};
use super::shape::ShapeFault;

/// Most entities that are reported one by one.
const MOST_REPORTED: usize = 20;

/// Parameters of entities that stand alone.
const ALONE: [(&str, usize); 34] = [
    ("ADVANCED_FACE", 4),
    ("AXIS2_PLACEMENT_3D", 4),
    ("B_SPLINE_CURVE_WITH_KNOTS", 9),
    ("B_SPLINE_SURFACE_WITH_KNOTS", 13),
    ("CARTESIAN_POINT", 2),
    ("CIRCLE", 3),
    ("CLOSED_SHELL", 2),
    ("CONICAL_SURFACE", 4),
    ("CONVERSION_BASED_UNIT", 3),
    ("CYLINDRICAL_SURFACE", 3),
    ("DIRECTION", 2),
    ("EDGE_CURVE", 5),
    ("EDGE_LOOP", 2),
    ("FACE_BOUND", 3),
    ("FACE_OUTER_BOUND", 3),
    ("FACE_SURFACE", 4),
    ("INTERSECTION_CURVE", 4),
    ("ITEM_DEFINED_TRANSFORMATION", 4),
    ("LENGTH_MEASURE_WITH_UNIT", 2),
    ("LINE", 3),
    ("MANIFOLD_SOLID_BREP", 2),
    ("MEASURE_WITH_UNIT", 2),
    ("ORIENTED_EDGE", 5),
    ("PLANE", 2),
    ("SEAM_CURVE", 4),
    ("SI_UNIT", 3),
    ("SURFACE_CURVE", 4),
    ("SURFACE_OF_LINEAR_EXTRUSION", 3),
    ("TOROIDAL_SURFACE", 4),
    ("VECTOR", 3),
    ("VERTEX_POINT", 2),
    ("ADVANCED_BREP_SHAPE_REPRESENTATION", 3),
    ("MANIFOLD_SURFACE_SHAPE_REPRESENTATION", 3),
    ("SHAPE_REPRESENTATION", 3),
];

/// Parameters of parts of complex entities: their own, without those of the part that they extend.
const PARTS: [(&str, usize); 11] = [
    ("B_SPLINE_CURVE", 5),
    ("B_SPLINE_CURVE_WITH_KNOTS", 3),
    ("B_SPLINE_SURFACE", 7),
    ("B_SPLINE_SURFACE_WITH_KNOTS", 5),
    ("CONVERSION_BASED_UNIT", 2),
    ("GLOBAL_UNIT_ASSIGNED_CONTEXT", 1),
    ("LENGTH_UNIT", 0),
    ("NAMED_UNIT", 1),
    ("RATIONAL_B_SPLINE_CURVE", 1),
    ("RATIONAL_B_SPLINE_SURFACE", 1),
    ("SI_UNIT", 2),
];

/// The shapes that are never a part of a complex entity.
const NEVER_PARTS: [&str; 23] = [
    "ADVANCED_FACE",
    "AXIS2_PLACEMENT_3D",
    "CARTESIAN_POINT",
    "CIRCLE",
    "CLOSED_SHELL",
    "CONICAL_SURFACE",
    "CYLINDRICAL_SURFACE",
    "DIRECTION",
    "EDGE_CURVE",
    "EDGE_LOOP",
    "FACE_BOUND",
    "FACE_OUTER_BOUND",
    "FACE_SURFACE",
    "INTERSECTION_CURVE",
    "LINE",
    "MANIFOLD_SOLID_BREP",
    "ORIENTED_EDGE",
    "PLANE",
    "SEAM_CURVE",
    "SURFACE_CURVE",
    "TOROIDAL_SURFACE",
    "VECTOR",
    "VERTEX_POINT",
];

fn count_of(counts: &[(&str, usize)], keyword: &str) -> Option<usize> {
    counts.iter().find(|(known, _)| *known == keyword).map(|(_, count)| *count)
}

/// What is wrong with the parameters of an entity.
fn fault(instance: &StepInstance) -> Option<ShapeFault> {
    let counts = |counts: &[(&str, usize)]| {
        let wrong = |(keyword, values): &(String, Vec<_>)| {
            count_of(counts, keyword).filter(|count| *count != values.len()).map(|count| {
                instance.fault(&format!("has {} parameters in {keyword}, which has {count}", values.len()))
            })
        };
        instance.parts.iter().find_map(wrong)
    };
    if instance.parts.len() == 1 {
        return counts(&ALONE);
    }
    let alone = instance.parts.iter().find(|(keyword, _)| NEVER_PARTS.contains(&keyword.as_str()));
    let part = |keyword: &str| instance.fault(&format!("has {keyword} as a part, which stands alone"));
    alone.map(|(keyword, _)| part(keyword)).or_else(|| counts(&PARTS))
}

/// The faults of all entities, a sentence each.
pub(super) fn faults(exchange: &ExchangeData) -> Vec<ShapeFault> {
    exchange.instances.values().filter_map(fault).take(MOST_REPORTED).collect()
}

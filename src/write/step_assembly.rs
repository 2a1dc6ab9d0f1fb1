//! Several solids as one STEP file: an assembly of named products, each at its place along the axis.

use super::step::{escaped, real, solid_entities, time_stamp};
use crate::geometry::solid::CheckedSolid;

/// A solid of an assembly: its name, and how far it is moved along the axis, mm.
#[derive(Debug, Clone)]
pub struct PlacedSolid {
    /// What its product is called.
    pub name: String,
    /// The solid.
    pub solid: CheckedSolid,
    /// How far along the axis it is moved.
    pub z: f64,
}

/// Entities of the frame of an assembly before those of its parts.
const FRAME: usize = 21;

/// The solids under a product name, with the time of making where known, and a remark in the description of the file.
#[must_use]
pub fn write(solids: &[PlacedSolid], product: &str, created: Option<u64>, remark: &str) -> Vec<u8> {
    let (name, time, version) = (escaped(product), time_stamp(created), env!("CARGO_PKG_VERSION"));
    let remark = if remark.is_empty() { String::new() } else { format!(", '{}'", escaped(remark)) };
    let mut next = FRAME;
    let (mut parts, mut places) = (String::new(), Vec::new());
    for placed in solids {
        let (text, after, place) = part(placed, next);
        parts.push_str(&text);
        places.push(format!("#{place}"));
        next = after;
    }
    let items = std::iter::once("#16".to_owned()).chain(places).collect::<Vec<_>>().join(", ");
    format!(
        "ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('{name}'{remark}), '2;1');
FILE_NAME('{name}', '{time}', (''), (''), 'camgen {version}', 'camgen', '');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));
ENDSEC;
DATA;
#1 = APPLICATION_PROTOCOL_DEFINITION('international standard', 'automotive_design', 2000, #2);
#2 = APPLICATION_CONTEXT('core data for automotive mechanical design processes');
#3 = SHAPE_DEFINITION_REPRESENTATION(#4, #10);
#4 = PRODUCT_DEFINITION_SHAPE('', '', #5);
#5 = PRODUCT_DEFINITION('design', '', #6, #9);
#6 = PRODUCT_DEFINITION_FORMATION('', '', #7);
#7 = PRODUCT('{name}', '{name}', '', (#8));
#8 = PRODUCT_CONTEXT('', #2, 'mechanical');
#9 = PRODUCT_DEFINITION_CONTEXT('part definition', #2, 'design');
#10 = SHAPE_REPRESENTATION('{name}', ({items}), #11);
#11 = (GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#15)) GLOBAL_UNIT_ASSIGNED_CONTEXT((#12, #13, #14)) REPRESENTATION_CONTEXT('', '3D'));
#12 = (LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI., .METRE.));
#13 = (NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($, .RADIAN.));
#14 = (NAMED_UNIT(*) SI_UNIT($, .STERADIAN.) SOLID_ANGLE_UNIT());
#15 = UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-06), #12, 'distance_accuracy_value', 'confusion accuracy');
#16 = AXIS2_PLACEMENT_3D('', #17, #18, #19);
#17 = CARTESIAN_POINT('', (0., 0., 0.));
#18 = DIRECTION('', (0., 0., 1.));
#19 = DIRECTION('', (1., 0., 0.));
#20 = PRODUCT_RELATED_PRODUCT_CATEGORY('assembly', '', (#7));
{parts}ENDSEC;
END-ISO-10303-21;
"
    )
    .into_bytes()
}

/// The entities of a part from a number on, the number after them, and that of its place in the assembly.
fn part(placed: &PlacedSolid, from: usize) -> (String, usize, usize) {
    let (name, z) = (escaped(&placed.name), real(placed.z));
    let n = |step: usize| from + step;
    let first = n(18);
    let (data, count) = solid_entities(&placed.solid, first);
    let [product, formation, definition, shape] = [0, 1, 2, 3].map(n);
    let (representation, related) = (n(5), n(10));
    let text = format!(
        "#{product} = PRODUCT('{name}', '{name}', '', (#8));
#{formation} = PRODUCT_DEFINITION_FORMATION('', '', #{product});
#{definition} = PRODUCT_DEFINITION('design', '', #{formation}, #9);
#{shape} = PRODUCT_DEFINITION_SHAPE('', '', #{definition});
#{} = SHAPE_DEFINITION_REPRESENTATION(#{shape}, #{representation});
#{representation} = ADVANCED_BREP_SHAPE_REPRESENTATION('{name}', (#16, #{first}), #11);
#{} = PRODUCT_RELATED_PRODUCT_CATEGORY('part', '', (#{product}));
#{} = NEXT_ASSEMBLY_USAGE_OCCURRENCE('{name}', '{name}', '', #5, #{definition}, $);
#{} = PRODUCT_DEFINITION_SHAPE('', '', #{});
#{} = CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#{related}, #{});
#{related} = (REPRESENTATION_RELATIONSHIP('', '', #{representation}, #10) REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#{}) SHAPE_REPRESENTATION_RELATIONSHIP());
#{} = ITEM_DEFINED_TRANSFORMATION('', '', #16, #{});
#{} = AXIS2_PLACEMENT_3D('', #{}, #18, #19);
#{} = CARTESIAN_POINT('', (0., 0., {z}));
{data}",
        n(4),
        n(6),
        n(7),
        n(8),
        n(7),
        n(9),
        n(8),
        n(11),
        n(11),
        n(12),
        n(12),
        n(13),
        n(13),
    );
    (text, first + count, n(12))
}

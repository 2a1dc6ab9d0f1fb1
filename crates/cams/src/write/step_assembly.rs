//! Several solids as one STEP file: an assembly of named products, each at its place along the axis.

use super::step::{escaped, exchange_file, real, solid_entities};
use camgen_kernel::geometry::solid::CheckedSolid;

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
    let mut next = FRAME;
    let (mut parts, mut places) = (String::new(), Vec::new());
    for placed in solids {
        let (text, after, place) = part(placed, next);
        parts.push_str(&text);
        places.push(format!("#{place}"));
        next = after;
    }
    let items = std::iter::once("#16".to_owned()).chain(places).collect::<Vec<_>>().join(", ");
    let shape = format!("SHAPE_REPRESENTATION('{}', ({items}), #11)", escaped(product));
    let frame = "#16 = AXIS2_PLACEMENT_3D('', #17, #18, #19);
#17 = CARTESIAN_POINT('', (0., 0., 0.));
#18 = DIRECTION('', (0., 0., 1.));
#19 = DIRECTION('', (1., 0., 0.));
#20 = PRODUCT_RELATED_PRODUCT_CATEGORY('assembly', '', (#7));
";
    exchange_file((product, created, remark), &shape, &format!("{frame}{parts}"))
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

//! Reads a STEP file (ISO 10303-21, with the shapes of ISO 10303-42) back into the boundary of its solid: faces, edges and
//! vertices as they stand in the file, in millimetres.
//!
//! There is no kernel here that repairs anything: what does not fit is kept and reported. AP203, AP214 and AP242 have the same
//! shapes. Curves that lie on surfaces a second time, in their parameters, are left out: the curve in space counts.

mod exchange;
mod form;
mod runs;
mod shape;
mod upright;

pub use exchange::StepError;
pub use form::{Flank, Form, form};
pub use runs::Loop;

use super::Unit;
use crate::geometry::nurbs;
use exchange::{Exchange, Instance, Value};
use nalgebra::Vector3;
use shape::{Fault, Shapes, references};

/// The carrier of an edge, mm.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    /// A straight line through a point along a unit vector.
    Line {
        /// A point of it.
        origin: Vector3<f64>,
        /// Its direction.
        direction: Vector3<f64>,
    },
    /// A circle, counter-clockwise about its axis.
    Circle {
        /// Its centre.
        centre: Vector3<f64>,
        /// Its axis, a unit vector.
        axis: Vector3<f64>,
        /// Its radius.
        radius: f64,
    },
    /// A B-spline.
    Spline(nurbs::Curve),
    /// Anything else: its line in the file and what it is called there.
    Other(String),
}

/// The carrier of a face, mm.
#[derive(Debug, Clone, PartialEq)]
pub enum Surface {
    /// A plane.
    Plane {
        /// A point of it.
        origin: Vector3<f64>,
        /// Its unit normal.
        normal: Vector3<f64>,
    },
    /// A cylinder; its normal points away from its axis.
    Cylinder {
        /// A point of its axis.
        origin: Vector3<f64>,
        /// Its axis, a unit vector.
        axis: Vector3<f64>,
        /// Its radius.
        radius: f64,
    },
    /// A B-spline surface; its normal is that of its first by its second parameter.
    Spline(nurbs::Surface),
    /// What a B-spline sweeps along a unit vector, both ways; its normal is that of the curve by the vector.
    Swept {
        /// The curve.
        curve: nurbs::Curve,
        /// The unit vector.
        direction: Vector3<f64>,
    },
    /// Anything else: its line in the file and what it is called there.
    Other(String),
}

/// An edge.
#[derive(Debug, Clone, PartialEq)]
pub struct Edge {
    /// Its first vertex.
    pub start: usize,
    /// Its last vertex.
    pub end: usize,
    /// Its carrier.
    pub curve: Curve,
    /// It runs along its carrier, not against it.
    pub forward: bool,
    /// Its line in the file.
    pub line: usize,
}

/// A face.
#[derive(Debug, Clone, PartialEq)]
pub struct Face {
    /// Its carrier.
    pub surface: Surface,
    /// Its normal, out of the metal, is that of its carrier.
    pub same_sense: bool,
    /// Its bounds, each of edges with the sense in which they are run: counter-clockwise about the normal out of the metal.
    pub loops: Vec<Vec<(usize, bool)>>,
    /// Its line in the file.
    pub line: usize,
}

/// The boundary of a solid.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Boundary {
    /// Places of the vertices, mm.
    pub vertices: Vec<Vector3<f64>>,
    /// The edges.
    pub edges: Vec<Edge>,
    /// The faces.
    pub faces: Vec<Face>,
}

/// What was read of a STEP file.
#[derive(Debug, Clone, PartialEq)]
pub struct StepFile {
    /// The unit it is in; the boundary has been converted to millimetres.
    pub unit: Unit,
    /// Everything in it that is a body, by its line and name.
    pub bodies: Vec<String>,
    /// What is wrong with it, a sentence each.
    pub faults: Vec<String>,
    /// The boundary of the first solid with one closed shell; empty where there is none.
    pub boundary: Boundary,
}

/// What is a body, besides the solid with one closed shell.
const BODIES: [&str; 21] = [
    "BREP_WITH_VOIDS",
    "FACETED_BREP",
    "CSG_SOLID",
    "EXTRUDED_AREA_SOLID",
    "REVOLVED_AREA_SOLID",
    "EXTRUDED_FACE_SOLID",
    "REVOLVED_FACE_SOLID",
    "SWEPT_DISK_SOLID",
    "SURFACE_CURVE_SWEPT_AREA_SOLID",
    "HALF_SPACE_SOLID",
    "BOXED_HALF_SPACE",
    "SOLID_REPLICA",
    "BLOCK",
    "RIGHT_CIRCULAR_CYLINDER",
    "SHELL_BASED_SURFACE_MODEL",
    "FACE_BASED_SURFACE_MODEL",
    "GEOMETRIC_SET",
    "TESSELLATED_SOLID",
    "TESSELLATED_SHELL",
    "TRIANGULATED_FACE",
    "COMPLEX_TRIANGULATED_FACE",
];
const SOLID: &str = "MANIFOLD_SOLID_BREP";

/// Whether bytes are those of a STEP file, by what they begin with.
#[must_use]
pub fn is_step(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.trim_ascii_start().get(..12).is_some_and(|start| start.eq_ignore_ascii_case(b"ISO-10303-21"))
}

/// Reads a STEP file.
///
/// # Errors
/// [`StepError`] where the bytes are no exchange structure.
pub fn read(bytes: &[u8]) -> Result<StepFile, StepError> {
    let exchange = exchange::read(bytes)?;
    let all = || exchange.instances.iter();
    let mut bodies: Vec<(usize, String)> = Vec::new();
    for (_, instance) in all() {
        let body = |(keyword, _): &(String, Vec<Value>)| keyword == SOLID || BODIES.contains(&keyword.as_str());
        if instance.parts.iter().any(body) {
            bodies.push((instance.line, instance.kind()));
        }
    }
    bodies.sort();
    let mut faults = Vec::new();
    let solid = all().find(|(_, instance)| instance.part(SOLID).is_some());
    let (unit, boundary) = match solid {
        None => (Unit::Untold, Boundary::default()),
        Some((number, instance)) => {
            let (unit, scale) = unit_of(&exchange, *number).unwrap_or_else(|fault| {
                faults.push(fault);
                (Unit::Untold, 1.0)
            });
            (unit, boundary(&exchange, instance, scale, &mut faults))
        }
    };
    faults.extend(placements(&exchange));
    let of_shell = boundary.faces.len();
    let is_face = |instance: &Instance| instance.part("ADVANCED_FACE").or(instance.part("FACE_SURFACE")).is_some();
    let count = all().filter(|(_, instance)| is_face(instance)).count();
    if count > of_shell && faults.is_empty() {
        faults.push(format!("{} faces lie outside of the shell of the solid", count - of_shell));
    }
    let bodies = bodies.into_iter().map(|(line, kind)| format!("line {line}: {kind}")).collect();
    Ok(StepFile { unit, bodies, faults, boundary })
}

/// The boundary of a solid with one closed shell.
fn boundary(exchange: &Exchange, solid: &Instance, scale: f64, faults: &mut Vec<Fault>) -> Boundary {
    let mut shapes = Shapes::new(exchange, scale);
    let mut faces = Vec::new();
    let mut read = || -> Result<(), Fault> {
        let values = solid.part(SOLID).unwrap_or_default();
        let Some(Value::Reference(shell)) = values.get(1) else { return Err(solid.fault("without a shell")) };
        let shell = shapes.instance(*shell)?;
        let values = shell.part("CLOSED_SHELL").ok_or_else(|| shell.fault("where CLOSED_SHELL is due"))?;
        let listed = references(values.get(1)).ok_or_else(|| shell.fault("without faces"))?;
        let mut seen = std::collections::BTreeSet::new();
        for number in listed {
            if !seen.insert(number) {
                return Err(shell.fault(&format!("with #{number} twice")));
            }
            faces.push(shapes.face(number)?);
        }
        Ok(())
    };
    if let Err(fault) = read() {
        faults.push(fault);
    }
    Boundary { vertices: shapes.places, edges: shapes.run, faces }
}

/// The unit of length of the representation that has an item, and its millimetres.
fn unit_of(exchange: &Exchange, item: u64) -> Result<(Unit, f64), Fault> {
    let holds = |values: &[Value]| references(values.get(1)).is_some_and(|items| items.contains(&item));
    let of = |instance: &Instance| -> Option<u64> {
        let (_, values) =
            instance.parts.iter().find(|(keyword, values)| keyword.ends_with("REPRESENTATION") && holds(values))?;
        match values.get(2) {
            Some(Value::Reference(context)) => Some(*context),
            _ => None,
        }
    };
    let shapes = Shapes::new(exchange, 1.0);
    let none = || "the solid is in no representation with a unit of length".to_owned();
    let context = shapes.instance(exchange.instances.values().find_map(of).ok_or_else(none)?)?;
    let units = context.part("GLOBAL_UNIT_ASSIGNED_CONTEXT").and_then(|values| references(values.first()));
    for number in units.ok_or_else(none)? {
        let unit = shapes.instance(number)?;
        if unit.part("LENGTH_UNIT").is_some() {
            return Ok(match metres(&shapes, unit, 0)? {
                1e-3 => (Unit::Millimetres, 1.0),
                1.0 => (Unit::Other("metres"), 1e3),
                0.01 => (Unit::Other("centimetres"), 10.0),
                other if (other - 0.0254).abs() < 1e-9 => (Unit::Other("inches"), 25.4),
                other => (Unit::Other("another unit than millimetres"), 1e3 * other),
            });
        }
    }
    Err(none())
}

/// Metres in a unit of length.
fn metres(shapes: &Shapes<'_>, unit: &Instance, depth: usize) -> Result<f64, Fault> {
    if let Some(values) = unit.part("SI_UNIT") {
        let (prefix, name) = match values {
            [.., Value::Nothing, Value::Name(name)] => ("", name),
            [.., Value::Name(prefix), Value::Name(name)] => (prefix.as_str(), name),
            _ => return Err(unit.fault("without a name")),
        };
        let known = [
            ("", 1.0),
            ("MILLI", 1e-3),
            ("CENTI", 0.01),
            ("DECI", 0.1),
            ("MICRO", 1e-6),
            ("NANO", 1e-9),
            ("KILO", 1e3),
        ];
        let factor = known.iter().find(|(known, _)| *known == prefix && name == "METRE");
        return factor.map(|(_, factor)| *factor).ok_or_else(|| unit.fault("that is no unit of length"));
    }
    let values = unit.part("CONVERSION_BASED_UNIT").filter(|_| depth < 4);
    let values = values.ok_or_else(|| unit.fault("that is not understood"))?;
    let Some(Value::Reference(measure)) = values.get(1) else { return Err(unit.fault("without a factor")) };
    let measure = shapes.instance(*measure)?;
    let parts = ["LENGTH_MEASURE_WITH_UNIT", "MEASURE_WITH_UNIT"];
    let values = parts.iter().find_map(|keyword| measure.part(keyword));
    let factor = values.and_then(|values| values.first()).and_then(shape::number);
    match (factor, values) {
        (Some(factor), Some([_, Value::Reference(base)])) if factor > 0.0 => {
            Ok(factor * metres(shapes, shapes.instance(*base)?, depth + 1)?)
        }
        _ => Err(measure.fault("without a factor above 0")),
    }
}

/// What moves or repeats bodies: only placements that move nothing are read.
fn placements(exchange: &Exchange) -> Vec<Fault> {
    let shapes = Shapes::new(exchange, 1.0);
    let same = |first: Option<&Value>, second: Option<&Value>| match (first, second) {
        (Some(Value::Reference(a)), Some(Value::Reference(b))) => shapes.alike(*a, *b),
        _ => false,
    };
    let mut faults = Vec::new();
    let mut uses = 0;
    for instance in exchange.instances.values() {
        let moved = |values: &[Value]| !same(values.get(2), values.get(3));
        if instance.part("ITEM_DEFINED_TRANSFORMATION").is_some_and(moved) {
            faults.push(instance.fault("moves the solid: write it where it lies, without an assembly"));
        }
        if instance.part("MAPPED_ITEM").is_some() {
            faults.push(instance.fault("places the solid again: write it where it lies, without an assembly"));
        }
        uses += usize::from(instance.part("NEXT_ASSEMBLY_USAGE_OCCURRENCE").is_some());
    }
    if uses > 1 {
        faults.push(format!("an assembly of {uses} parts; write the cam alone"));
    }
    faults
}

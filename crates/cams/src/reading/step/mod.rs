//! Reads a STEP file (ISO 10303-21, with the shapes of ISO 10303-42) back into the boundary of its solid: faces, edges and
//! vertices as they are in the file, in millimetres.
//!
//! Nothing is repaired: what does not fit is kept and reported. AP203, AP214 and AP242 have the same
//! shapes. Curves that are repeated in the parameters of surfaces are left out: the curve in space counts.

mod exchange;
mod form;
mod hub;
mod parameters;
mod placement;
mod runs;
mod shape;
mod splines;
mod upright;

pub use form::{FlankShape, SolidForm, form};
pub use hub::HubShape;
pub use placement::StepPlacement;
pub use runs::FaceLoop;

use super::FileUnit;
use camgen_kernel::geometry::nurbs;
use camgen_kernel::refusal::Refusal;
use exchange::{ExchangeData, StepInstance, StepValue};
use nalgebra::Vector3;
use shape::{ShapeFault, ShapeReader, references};

/// The curve that carries an edge, mm.
#[derive(Debug, Clone, PartialEq)]
pub enum StepCurve {
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
    Spline(nurbs::NurbsCurve),
    /// Anything else: its line and its name in the file.
    Other(String),
}

/// The surface that carries a face, mm.
#[derive(Debug, Clone, PartialEq)]
pub enum StepSurface {
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
    /// A cone; its normal points away from its axis.
    Cone {
        /// A point of its axis.
        origin: Vector3<f64>,
        /// Its axis, a unit vector, along which it widens.
        axis: Vector3<f64>,
        /// Its radius at that point.
        radius: f64,
        /// How much wider it is a length farther along the axis, over that length.
        slope: f64,
    },
    /// A torus; its normal points away from the circle in the middle of its tube.
    Torus {
        /// Its centre.
        origin: Vector3<f64>,
        /// Its axis, a unit vector.
        axis: Vector3<f64>,
        /// Radius of the circle in the middle of its tube.
        major: f64,
        /// Radius of the tube.
        minor: f64,
    },
    /// A B-spline surface; its normal is the derivative by the first parameter times that by the second.
    Spline(nurbs::NurbsSurface),
    /// A surface swept from a B-spline along a unit vector, in both directions; its normal is the curve's tangent times the vector.
    Swept {
        /// The curve.
        curve: nurbs::NurbsCurve,
        /// The unit vector.
        direction: Vector3<f64>,
    },
    /// Anything else: its line and its name in the file.
    Other(String),
}

/// An edge.
#[derive(Debug, Clone, PartialEq)]
pub struct StepEdge {
    /// Its first vertex.
    pub start: usize,
    /// Its last vertex.
    pub end: usize,
    /// Its carrier.
    pub curve: StepCurve,
    /// Whether it runs along its carrier, not against it.
    pub forward: bool,
    /// Its line in the file.
    pub line: usize,
}

/// A face.
#[derive(Debug, Clone, PartialEq)]
pub struct StepFace {
    /// Its carrier.
    pub surface: StepSurface,
    /// Whether its normal, out of the metal, is that of its carrier.
    pub same_sense: bool,
    /// Its bounds, each a list of edges with the sense in which they are run: counter-clockwise about the normal out of the metal.
    pub loops: Vec<Vec<(usize, bool)>>,
    /// Its line in the file.
    pub line: usize,
}

/// The boundary of a solid.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StepBoundary {
    /// Places of the vertices, mm.
    pub vertices: Vec<Vector3<f64>>,
    /// The edges.
    pub edges: Vec<StepEdge>,
    /// The faces.
    pub faces: Vec<StepFace>,
}

/// The result of reading a STEP file.
#[derive(Debug, Clone, PartialEq)]
pub struct StepFile {
    /// Its unit; the boundary has been converted to millimetres.
    pub unit: FileUnit,
    /// Every body in it, by its line and name.
    pub bodies: Vec<String>,
    /// Its faults, a sentence each.
    pub faults: Vec<String>,
    /// The boundary of the first solid with one closed shell, where it lies; empty without such a solid.
    pub boundary: StepBoundary,
    /// The placement that moves or turns the solid, where there is one.
    pub placement: Option<StepPlacement>,
}

/// The other entities that are bodies, apart from the solid with one closed shell.
const BODIES: [&str; 33] = [
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
    "SPHERE",
    "TORUS",
    "ELLIPSOID",
    "RIGHT_CIRCULAR_CONE",
    "RIGHT_ANGULAR_WEDGE",
    "FACETED_PRIMITIVE",
    "BOOLEAN_RESULT",
    "SWEPT_FACE_SOLID",
    "CONNECTED_FACE_SET",
    "GEOMETRIC_CURVE_SET",
    "EDGE_BASED_WIREFRAME_MODEL",
    "SHELL_BASED_WIREFRAME_MODEL",
];
/// Most points that are reported one by one.
const MOST_FAR: usize = 20;
/// Largest coordinate of a point of a file, in its unit: nothing that is cut is as large.
const LARGEST_COORDINATE: f64 = 1e9;
const SOLID: &str = "MANIFOLD_SOLID_BREP";

/// Whether bytes are those of a STEP file, by their beginning.
#[must_use]
pub fn is_step(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    bytes.trim_ascii_start().get(..12).is_some_and(|start| start.eq_ignore_ascii_case(b"ISO-10303-21"))
}

/// Reads a STEP file.
///
/// # Errors
/// [`Refusal`] where the bytes are not an exchange structure.
pub fn read(bytes: &[u8]) -> Result<StepFile, Refusal> {
    let exchange = exchange::read(bytes)?;
    let all = || exchange.instances.iter();
    let mut bodies: Vec<(usize, String)> = Vec::new();
    for (_, instance) in all() {
        let body = |(keyword, _): &(String, Vec<StepValue>)| keyword == SOLID || BODIES.contains(&keyword.as_str());
        if instance.parts.iter().any(body) {
            bodies.push((instance.line, instance.kind()));
        }
    }
    bodies.sort();
    let mut faults = Vec::new();
    let solid = all().find(|(_, instance)| instance.part(SOLID).is_some());
    let mut placement = None;
    let (unit, boundary) = match solid {
        None => (FileUnit::Unstated, StepBoundary::default()),
        Some((number, instance)) => {
            let (unit, scale, angle) = unit_of(&exchange, *number).unwrap_or_else(|fault| {
                faults.push(fault);
                (FileUnit::Unstated, 1.0, None)
            });
            let read = boundary(&exchange, instance, (scale, angle), &mut faults);
            let frame = placement::of_solid(&exchange, *number, scale, &mut faults);
            let placed = match frame {
                None => read,
                Some(frame) => {
                    let (found, placed) = StepPlacement::apply(frame, read);
                    placement = Some(found);
                    placed
                }
            };
            (unit, placed)
        }
    };
    faults.extend(parameters::faults(&exchange));
    faults.extend(placements(&exchange));
    faults.extend(far_points(&exchange));
    let of_shell = boundary.faces.len();
    let is_face = |instance: &StepInstance| instance.part("ADVANCED_FACE").or(instance.part("FACE_SURFACE")).is_some();
    let count = all().filter(|(_, instance)| is_face(instance)).count();
    if count > of_shell && faults.is_empty() {
        faults.push(format!("{} faces do not belong to the shell of the solid", count - of_shell));
    }
    let bodies = bodies.into_iter().map(|(line, kind)| format!("line {line}: {kind}")).collect();
    Ok(StepFile { unit, bodies, faults, boundary, placement })
}

/// The boundary of a solid with one closed shell.
fn boundary(
    exchange: &ExchangeData,
    solid: &StepInstance,
    (scale, angle): (f64, Option<f64>),
    faults: &mut Vec<ShapeFault>,
) -> StepBoundary {
    let mut shapes = ShapeReader::new(exchange, scale).with_angle(angle);
    let mut faces = Vec::new();
    let mut read = || -> Result<(), ShapeFault> {
        let values = solid.part(SOLID).unwrap_or_default();
        let Some(StepValue::Reference(shell)) = values.get(1) else { return Err(solid.fault("without a shell")) };
        let shell = shapes.instance(*shell)?;
        let values = shell.part("CLOSED_SHELL").ok_or_else(|| shell.fault("in place of CLOSED_SHELL"))?;
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
    StepBoundary { vertices: shapes.places, edges: shapes.run, faces }
}

/// The unit of length of the representation that contains an item, its millimetres, and the radians of its unit of angle where that is known.
fn unit_of(exchange: &ExchangeData, item: u64) -> Result<(FileUnit, f64, Option<f64>), ShapeFault> {
    let holds = |values: &[StepValue]| references(values.get(1)).is_some_and(|items| items.contains(&item));
    let of = |instance: &StepInstance| -> Option<u64> {
        let (_, values) =
            instance.parts.iter().find(|(keyword, values)| keyword.ends_with("REPRESENTATION") && holds(values))?;
        match values.get(2) {
            Some(StepValue::Reference(context)) => Some(*context),
            _ => None,
        }
    };
    let shapes = ShapeReader::new(exchange, 1.0);
    let none = || "the solid does not belong to a representation with a unit of length".to_owned();
    let context = shapes.instance(exchange.instances.values().find_map(of).ok_or_else(none)?)?;
    let units = context.part("GLOBAL_UNIT_ASSIGNED_CONTEXT").and_then(|values| references(values.first()));
    let units: Vec<&StepInstance> =
        units.ok_or_else(none)?.iter().map(|number| shapes.instance(*number)).collect::<Result<_, _>>()?;
    let mut angles = units.iter().filter(|unit| unit.part("PLANE_ANGLE_UNIT").is_some());
    let angle = match (angles.next(), angles.next()) {
        (Some(unit), None) => radians(&shapes, unit),
        _ => None,
    };
    let mut lengths = units.into_iter().filter(|unit| unit.part("LENGTH_UNIT").is_some());
    let unit = lengths.next().ok_or_else(none)?;
    if let Some(other) = lengths.next() {
        return Err(other.fault("is a second unit of length of the solid"));
    }
    Ok(match metres(&shapes, unit, 0)? {
        1e-3 => (FileUnit::Millimetres, 1.0, angle),
        1.0 => (FileUnit::Other("metres"), 1e3, angle),
        0.01 => (FileUnit::Other("centimetres"), 10.0, angle),
        other if (other - 0.0254).abs() < 1e-9 => (FileUnit::Other("inches"), 25.4, angle),
        other => (FileUnit::Other("another unit than millimetres"), 1e3 * other, angle),
    })
}

/// Radians in a unit of angle: the radian itself, or what is stated as a multiple of it.
fn radians(shapes: &ShapeReader<'_>, unit: &StepInstance) -> Option<f64> {
    if let Some(values) = unit.part("SI_UNIT") {
        return matches!(values, [.., StepValue::Nothing, StepValue::Name(name)] if name == "RADIAN").then_some(1.0);
    }
    let Some(StepValue::Reference(measure)) = unit.part("CONVERSION_BASED_UNIT")?.get(1) else { return None };
    let measure = shapes.instance(*measure).ok()?;
    let values = measure.part("PLANE_ANGLE_MEASURE_WITH_UNIT").or_else(|| measure.part("MEASURE_WITH_UNIT"))?;
    let Some(StepValue::Reference(base)) = values.get(1) else { return None };
    let base = shapes.instance(*base).ok()?.part("SI_UNIT")?;
    let of_radians = matches!(base, [.., StepValue::Nothing, StepValue::Name(name)] if name == "RADIAN");
    shape::measure(values.first()?).filter(|factor| of_radians && *factor > 0.0)
}

/// Metres in a unit of length.
fn metres(shapes: &ShapeReader<'_>, unit: &StepInstance, depth: usize) -> Result<f64, ShapeFault> {
    if let Some(values) = unit.part("SI_UNIT") {
        let (prefix, name) = match values {
            [.., StepValue::Nothing, StepValue::Name(name)] => ("", name),
            [.., StepValue::Name(prefix), StepValue::Name(name)] => (prefix.as_str(), name),
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
        return factor.map(|(_, factor)| *factor).ok_or_else(|| unit.fault("that is not a unit of length"));
    }
    let values = unit.part("CONVERSION_BASED_UNIT").filter(|_| depth < 4);
    let values = values.ok_or_else(|| unit.fault("that camgen does not know"))?;
    let Some(StepValue::Reference(measure)) = values.get(1) else { return Err(unit.fault("without a factor")) };
    let measure = shapes.instance(*measure)?;
    let parts = ["LENGTH_MEASURE_WITH_UNIT", "MEASURE_WITH_UNIT"];
    let values = parts.iter().find_map(|keyword| measure.part(keyword));
    let factor = values.and_then(|values| values.first()).and_then(shape::measure);
    match (factor, values) {
        (Some(factor), Some([_, StepValue::Reference(base)])) if factor > 0.0 => {
            Ok(factor * metres(shapes, shapes.instance(*base)?, depth + 1)?)
        }
        _ => Err(measure.fault("without a factor above 0")),
    }
}

/// Entities that move or repeat bodies: only placements without a motion are accepted.
fn placements(exchange: &ExchangeData) -> Vec<ShapeFault> {
    let shapes = ShapeReader::new(exchange, 1.0);
    let same = |first: Option<&StepValue>, second: Option<&StepValue>| match (first, second) {
        (Some(StepValue::Reference(a)), Some(StepValue::Reference(b))) => shapes.equal_placements(*a, *b),
        _ => false,
    };
    let mut faults = Vec::new();
    let mut uses = 0;
    for instance in exchange.instances.values() {
        let moved = |values: &[StepValue]| !same(values.get(2), values.get(3));
        if instance.part("ITEM_DEFINED_TRANSFORMATION").is_some_and(moved) {
            faults.push(instance.fault("moves the solid: write the solid in its place, without an assembly"));
        }
        if instance.parts.iter().any(|(keyword, _)| keyword.starts_with("CARTESIAN_TRANSFORMATION_OPERATOR")) {
            faults.push(instance.fault("transforms a part of the file: write the solid in its place, at its size"));
        }
        if instance.part("MAPPED_ITEM").is_some() {
            faults.push(
                instance.fault("places the solid again: write the solid once, in its place, without an assembly"),
            );
        }
        uses += usize::from(instance.part("NEXT_ASSEMBLY_USAGE_OCCURRENCE").is_some());
    }
    if uses > 1 {
        faults.push(format!("an assembly of {uses} parts; write the cam alone"));
    }
    faults
}

/// Points of the file that are too far away for anything that is cut, whether they belong to the solid or not: other programs may use them.
fn far_points(exchange: &ExchangeData) -> Vec<ShapeFault> {
    let far = |instance: &&StepInstance| {
        let values = instance.part("CARTESIAN_POINT").and_then(|values| match values.get(1) {
            Some(StepValue::List(values)) => Some(values),
            _ => None,
        });
        values.into_iter().flatten().filter_map(shape::number).any(|value| !(value.abs() <= LARGEST_COORDINATE))
    };
    let points = exchange.instances.values().filter(far);
    points.take(MOST_FAR).map(|point| point.fault("lies farther away than anything that is cut")).collect()
}

//! Interprets instances: places, directions, curves, surfaces, edges, faces (ISO 10303-42), in millimetres.

use super::exchange::{ExchangeData, StepInstance, StepValue};
use super::{StepCurve, StepEdge, StepFace, StepSurface};
use camgen_kernel::geometry::nurbs::{self, Knots, weighted};
use nalgebra::{Matrix3, Vector3, Vector4};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// Why an instance is not valid, with its line.
pub(super) type ShapeFault = String;

/// Origin and axis of a plane, cylinder or circle.
pub(super) struct AxisPlacement {
    pub(super) origin: Vector3<f64>,
    pub(super) axis: Vector3<f64>,
}

/// A control net with its knots; a curve has a single row.
struct ControlNet {
    degrees: Vec<usize>,
    rows: Vec<Vec<Vector3<f64>>>,
    knots: Vec<Vec<f64>>,
    weights: Option<Vec<Vec<f64>>>,
}

/// Reads shapes out of a file's instances.
pub(super) struct ShapeReader<'a> {
    pub(super) exchange: &'a ExchangeData,
    /// Millimetres in the file's unit of length.
    pub(super) scale: f64,
    /// Radians in the file's unit of angle, where that is known.
    angle: Option<f64>,
    vertices: BTreeMap<u64, usize>,
    edges: BTreeMap<u64, usize>,
    /// Control points that may still be read.
    controls: Cell<usize>,
    pub(super) places: Vec<Vector3<f64>>,
    pub(super) run: Vec<StepEdge>,
}

/// No cam has more control points than these: a file may refer to one curve as often as it likes.
const MOST_CONTROLS: usize = 1_000_000;
/// No cam has more knots than these; a multiplicity must not fill the memory.
const MOST_KNOTS: usize = 1_000_000;
/// The shortest vector that is read, mm.
const SHORTEST_VECTOR: f64 = 1e-6;

fn list(value: Option<&StepValue>) -> Option<&[StepValue]> {
    match value {
        Some(StepValue::List(values)) => Some(values),
        _ => None,
    }
}

/// A number without a type: others leave out one that has a type where none belongs.
pub(super) fn number(value: &StepValue) -> Option<f64> {
    match value {
        StepValue::Number(value) => Some(*value),
        _ => None,
    }
}

/// A number with a type, as `LENGTH_MEASURE(25.4)`, or without.
pub(super) fn measure(value: &StepValue) -> Option<f64> {
    match value {
        StepValue::Typed(_, values) => values.first().filter(|_| values.len() == 1).and_then(number),
        value => number(value),
    }
}

fn numbers(value: Option<&StepValue>) -> Option<Vec<f64>> {
    list(value)?.iter().map(number).collect()
}

/// A count or a degree.
fn whole(value: f64) -> Option<usize> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be small and whole")]
    let found = ((0.0..=1e6).contains(&value) && value.fract() == 0.0).then_some(value as usize);
    found
}

pub(super) fn references(value: Option<&StepValue>) -> Option<Vec<u64>> {
    let one = |value: &StepValue| match value {
        StepValue::Reference(number) => Some(*number),
        _ => None,
    };
    list(value)?.iter().map(one).collect()
}

pub(super) fn truth(value: Option<&StepValue>) -> Option<bool> {
    match value {
        Some(StepValue::Name(name)) if name == "T" => Some(true),
        Some(StepValue::Name(name)) if name == "F" => Some(false),
        _ => None,
    }
}

/// A reference among the parameters.
fn referred(instance: &StepInstance, values: &[StepValue], index: usize) -> Result<u64, ShapeFault> {
    match values.get(index) {
        Some(StepValue::Reference(number)) => Ok(*number),
        _ => Err(instance.fault(&format!("without a reference as its parameter {}", index + 1))),
    }
}

impl StepInstance {
    /// The parameters of a part.
    pub(super) fn part(&self, keyword: &str) -> Option<&[StepValue]> {
        self.parts.iter().find(|(found, _)| found == keyword).map(|(_, values)| values.as_slice())
    }

    /// Its kind, for a message.
    pub(super) fn kind(&self) -> String {
        self.parts.iter().map(|(keyword, _)| keyword.as_str()).collect::<Vec<_>>().join(" ")
    }

    /// A fault of this instance.
    pub(super) fn fault(&self, what: &str) -> ShapeFault {
        format!("line {}: {} {what}", self.line, self.kind())
    }
}

impl<'a> ShapeReader<'a> {
    pub(super) fn new(exchange: &'a ExchangeData, scale: f64) -> Self {
        let (vertices, edges) = (BTreeMap::new(), BTreeMap::new());
        let controls = Cell::new(MOST_CONTROLS);
        Self { exchange, scale, angle: None, vertices, edges, controls, places: Vec::new(), run: Vec::new() }
    }

    /// With the radians in the file's unit of angle.
    pub(super) fn with_angle(self, angle: Option<f64>) -> Self {
        Self { angle, ..self }
    }

    pub(super) fn instance(&self, number: u64) -> Result<&'a StepInstance, ShapeFault> {
        self.exchange.instances.get(&number).ok_or_else(|| format!("#{number} is referred to but missing"))
    }

    /// The parameters of an instance of a kind, and the instance.
    fn of(&self, number: u64, keyword: &str) -> Result<(&'a StepInstance, &'a [StepValue]), ShapeFault> {
        let instance = self.instance(number)?;
        let values = instance.part(keyword).ok_or_else(|| instance.fault(&format!("in place of {keyword}")))?;
        Ok((instance, values))
    }

    fn triple(&self, number: u64, keyword: &str) -> Result<Vector3<f64>, ShapeFault> {
        let (instance, values) = self.of(number, keyword)?;
        match numbers(values.get(1)).as_deref() {
            Some([x, y, z]) => Ok(Vector3::new(*x, *y, *z)),
            _ => Err(instance.fault("without three coordinates")),
        }
    }

    pub(super) fn point(&self, number: u64) -> Result<Vector3<f64>, ShapeFault> {
        Ok(self.triple(number, "CARTESIAN_POINT")? * self.scale)
    }

    fn direction(&self, number: u64) -> Result<Vector3<f64>, ShapeFault> {
        let found = self.triple(number, "DIRECTION")?;
        if found.norm() > 0.0 && found.norm().is_finite() {
            Ok(found.normalize())
        } else {
            Err(self.instance(number)?.fault("without a length"))
        }
    }

    pub(super) fn placement(&self, number: u64) -> Result<AxisPlacement, ShapeFault> {
        let (instance, values) = self.of(number, "AXIS2_PLACEMENT_3D")?;
        let Some(StepValue::Reference(origin)) = values.get(1) else { return Err(instance.fault("without a place")) };
        let axis = match values.get(2) {
            Some(StepValue::Reference(axis)) => self.direction(*axis)?,
            _ => Vector3::z(),
        };
        // It decides nothing of a plane or a circle, but other programs stop at one that is none.
        if let Some(StepValue::Reference(along)) = values.get(3) {
            self.direction(*along)?;
        }
        Ok(AxisPlacement { origin: self.point(*origin)?, axis })
    }

    /// Origin and axes, in columns, of a placement: its first axis is the part of the given direction across the third (ISO 10303-42,
    /// `build_axes`).
    pub(super) fn frame(&self, number: u64) -> Result<(Vector3<f64>, Matrix3<f64>), ShapeFault> {
        let (instance, values) = self.of(number, "AXIS2_PLACEMENT_3D")?;
        let AxisPlacement { origin, axis } = self.placement(number)?;
        let along = match values.get(3) {
            Some(StepValue::Reference(along)) => self.direction(*along)?,
            // Along X, or along Y where the axis is X (`first_proj_axis`).
            _ if axis.cross(&Vector3::x()).norm() == 0.0 => Vector3::y(),
            _ => Vector3::x(),
        };
        let first = along - axis * along.dot(&axis);
        if !(first.norm() > 0.0) {
            return Err(instance.fault("whose two directions are parallel"));
        }
        let first = first.normalize();
        Ok((origin, Matrix3::from_columns(&[first, axis.cross(&first), axis])))
    }

    /// Whether two placements are equal.
    pub(super) fn equal_placements(&self, first: u64, second: u64) -> bool {
        matches!((self.frame(first), self.frame(second)), (Ok(a), Ok(b)) if a == b)
    }

    fn length(&self, instance: &StepInstance, values: &[StepValue], index: usize) -> Result<f64, ShapeFault> {
        let found = values.get(index).and_then(number).map(|length| length * self.scale);
        found.filter(|length| *length > 0.0).ok_or_else(|| instance.fault("without a length above 0"))
    }

    pub(super) fn surface(&self, number: u64) -> Result<StepSurface, ShapeFault> {
        let instance = self.instance(number)?;
        if let Some(values) = instance.part("PLANE") {
            let AxisPlacement { origin, axis } = self.placement(referred(instance, values, 1)?)?;
            return Ok(StepSurface::Plane { origin, normal: axis });
        }
        if let Some(values) = instance.part("CYLINDRICAL_SURFACE") {
            let AxisPlacement { origin, axis } = self.placement(referred(instance, values, 1)?)?;
            return Ok(StepSurface::Cylinder { origin, axis, radius: self.length(instance, values, 2)? });
        }
        if let Some(values) = instance.part("CONICAL_SURFACE") {
            let AxisPlacement { origin, axis } = self.placement(referred(instance, values, 1)?)?;
            let angle = values.get(3).and_then(self::number).zip(self.angle).map(|(angle, unit)| angle * unit);
            let angle = angle.filter(|angle| *angle > 0.0 && *angle < FRAC_PI_2);
            let angle = angle.ok_or_else(|| instance.fault("without an angle between 0 and 90 deg in a known unit"))?;
            let radius = self.length(instance, values, 2)?;
            return Ok(StepSurface::Cone { origin, axis, radius, slope: libm::tan(angle) });
        }
        if let Some(values) = instance.part("TOROIDAL_SURFACE") {
            let AxisPlacement { origin, axis } = self.placement(referred(instance, values, 1)?)?;
            let (major, minor) = (self.length(instance, values, 2)?, self.length(instance, values, 3)?);
            return Ok(StepSurface::Torus { origin, axis, major, minor });
        }
        if instance.parts.iter().any(|(keyword, _)| keyword.starts_with("B_SPLINE_SURFACE")) {
            return self.spline_surface(instance).map(StepSurface::Spline);
        }
        if let Some(values) = instance.part("SURFACE_OF_LINEAR_EXTRUSION") {
            let (curve, vector) = (self.curve(referred(instance, values, 1)?, 0)?, referred(instance, values, 2)?);
            let along = self.vector(vector)?;
            match curve {
                StepCurve::Spline(curve) => return Ok(StepSurface::Swept { curve, direction: along }),
                StepCurve::Line { origin, direction } if direction.cross(&along).norm() > 0.0 => {
                    return Ok(StepSurface::Plane { origin, normal: direction.cross(&along).normalize() });
                }
                _ => {}
            }
        }
        Ok(StepSurface::Other(format!("line {}: {}", instance.line, instance.kind())))
    }

    /// The direction of a vector; others leave out what lies along a vector that is too short.
    fn vector(&self, number: u64) -> Result<Vector3<f64>, ShapeFault> {
        let (of, values) = self.of(number, "VECTOR")?;
        if self.length(of, values, 2)? < SHORTEST_VECTOR {
            return Err(of.fault(&format!("is shorter than {SHORTEST_VECTOR} mm")));
        }
        self.direction(referred(of, values, 1)?)
    }

    /// The basic curve of an edge: the additional data of a curve on a surface or a seam are left out.
    fn curve(&self, number: u64, depth: usize) -> Result<StepCurve, ShapeFault> {
        let instance = self.instance(number)?;
        for wrapped in ["SURFACE_CURVE", "SEAM_CURVE", "INTERSECTION_CURVE"] {
            if let Some(values) = instance.part(wrapped).filter(|_| depth < 4) {
                return self.curve(referred(instance, values, 1)?, depth + 1);
            }
        }
        if let Some(values) = instance.part("LINE") {
            let (origin, vector) = (referred(instance, values, 1)?, referred(instance, values, 2)?);
            return Ok(StepCurve::Line { origin: self.point(origin)?, direction: self.vector(vector)? });
        }
        if let Some(values) = instance.part("CIRCLE") {
            let AxisPlacement { origin, axis } = self.placement(referred(instance, values, 1)?)?;
            return Ok(StepCurve::Circle { centre: origin, axis, radius: self.length(instance, values, 2)? });
        }
        if instance.parts.iter().any(|(keyword, _)| keyword.starts_with("B_SPLINE_CURVE")) {
            let net = self.net(instance, "B_SPLINE_CURVE", false)?;
            let curve = Self::spline_curve(&net);
            return curve.map(straight).ok_or_else(|| instance.fault("whose knots do not fit its points"));
        }
        Ok(StepCurve::Other(format!("line {}: {}", instance.line, instance.kind())))
    }

    /// The net of a B-spline: in one entity, or in the parts of a complex one, with weights where it is rational.
    fn net(&self, instance: &StepInstance, base: &str, surface: bool) -> Result<ControlNet, ShapeFault> {
        let bad = || instance.fault("that is not complete");
        let count = if surface { 2 } else { 1 };
        let with_knots = format!("{base}_WITH_KNOTS");
        let knotted = instance.part(&with_knots).ok_or_else(|| instance.fault("without knots is not read"))?;
        // In a simple entity a name and the parameters of the base come first.
        let split = if surface { 8 } else { 6 };
        let (own, knotted) = if let Some(own) = instance.part(base) {
            (own, knotted)
        } else {
            (knotted.get(1..split).ok_or_else(bad)?, knotted.get(split..).ok_or_else(bad)?)
        };
        let degrees: Option<Vec<usize>> = own.iter().take(count).map(|value| number(value).and_then(whole)).collect();
        let row = |value: &StepValue| -> Result<Vec<Vector3<f64>>, ShapeFault> {
            let single = references(Some(value)).ok_or_else(bad)?;
            let left = self.controls.get().checked_sub(single.len());
            self.controls
                .set(left.ok_or_else(|| instance.fault("exceeds the number of control points that a cam can have"))?);
            single.iter().map(|number| self.point(*number)).collect()
        };
        let points = own.get(count).ok_or_else(bad)?;
        let rows = if surface {
            list(Some(points)).ok_or_else(bad)?.iter().map(row).collect::<Result<Vec<_>, _>>()?
        } else {
            vec![row(points)?]
        };
        let mut knots = Vec::new();
        for index in 0..count {
            let (counts, values) = (numbers(knotted.get(index)), numbers(knotted.get(count + index)));
            knots.push(full(&counts.ok_or_else(bad)?, &values.ok_or_else(bad)?).ok_or_else(bad)?);
        }
        let rational = format!("RATIONAL_{base}");
        let weights = match instance.part(&rational) {
            None => None,
            Some(values) if surface => {
                let rows = list(values.first()).ok_or_else(bad)?.iter().map(|row| numbers(Some(row)));
                Some(rows.collect::<Option<Vec<_>>>().ok_or_else(bad)?)
            }
            Some(values) => Some(vec![numbers(values.first()).ok_or_else(bad)?]),
        };
        let above = |weights: &Vec<Vec<f64>>| weights.iter().flatten().all(|weight| *weight > 0.0);
        if weights.as_ref().is_some_and(|weights| !above(weights)) {
            return Err(instance.fault("with a weight that is not above 0"));
        }
        Ok(ControlNet { degrees: degrees.ok_or_else(bad)?, rows, knots, weights })
    }

    fn spline_curve(net: &ControlNet) -> Option<nurbs::NurbsCurve> {
        let controls = net.weighted()?.into_iter().next()?;
        let knots = Knots { degree: *net.degrees.first()?, values: net.knots.first()?.clone() };
        knots.fit_controls(controls.len()).then_some(nurbs::NurbsCurve { knots, controls })
    }

    fn spline_surface(&self, instance: &StepInstance) -> Result<nurbs::NurbsSurface, ShapeFault> {
        let net = self.net(instance, "B_SPLINE_SURFACE", true)?;
        let misfit = || instance.fault("whose knots do not fit its points");
        let controls = net.weighted().ok_or_else(misfit)?;
        let (mut degrees, mut knots) = (net.degrees.into_iter(), net.knots.into_iter());
        let mut next = || Some(Knots { degree: degrees.next()?, values: knots.next()? });
        let (Some(u), Some(v)) = (next(), next()) else { return Err(misfit()) };
        if u.fit_controls(controls.len()) && controls.iter().all(|row| v.fit_controls(row.len())) {
            Ok(nurbs::NurbsSurface { u, v, controls })
        } else {
            Err(misfit())
        }
    }

    fn vertex(&mut self, number: u64) -> Result<usize, ShapeFault> {
        if let Some(index) = self.vertices.get(&number) {
            return Ok(*index);
        }
        let (instance, values) = self.of(number, "VERTEX_POINT")?;
        let place = self.point(referred(instance, values, 1)?)?;
        self.places.push(place);
        self.vertices.insert(number, self.places.len() - 1);
        Ok(self.places.len() - 1)
    }

    fn edge(&mut self, number: u64) -> Result<usize, ShapeFault> {
        if let Some(index) = self.edges.get(&number) {
            return Ok(*index);
        }
        let (instance, values) = self.of(number, "EDGE_CURVE")?;
        let ends = (referred(instance, values, 1)?, referred(instance, values, 2)?);
        let curve = self.curve(referred(instance, values, 3)?, 0)?;
        let forward = truth(values.get(4)).ok_or_else(|| instance.fault("without a sense"))?;
        let edge =
            StepEdge { start: self.vertex(ends.0)?, end: self.vertex(ends.1)?, curve, forward, line: instance.line };
        self.run.push(edge);
        self.edges.insert(number, self.run.len() - 1);
        Ok(self.run.len() - 1)
    }

    /// The edges of a bound in the order in which they are run, each with its sense.
    fn bound(&mut self, number: u64) -> Result<Vec<(usize, bool)>, ShapeFault> {
        let instance = self.instance(number)?;
        let values = instance.part("FACE_OUTER_BOUND").or(instance.part("FACE_BOUND"));
        let values = values.ok_or_else(|| instance.fault("in place of FACE_BOUND"))?;
        let along = truth(values.get(2)).ok_or_else(|| instance.fault("without a sense"))?;
        let (round, values) = self.of(referred(instance, values, 1)?, "EDGE_LOOP")?;
        let mut edges = Vec::new();
        for number in references(values.get(1)).ok_or_else(|| round.fault("without edges"))? {
            let (instance, values) = self.of(number, "ORIENTED_EDGE")?;
            let forward = truth(values.get(4)).ok_or_else(|| instance.fault("without a sense"))?;
            edges.push((self.edge(referred(instance, values, 3)?)?, forward == along));
        }
        if !along {
            edges.reverse();
        }
        Ok(edges)
    }

    pub(super) fn face(&mut self, number: u64) -> Result<StepFace, ShapeFault> {
        let instance = self.instance(number)?;
        let values = instance.part("ADVANCED_FACE").or(instance.part("FACE_SURFACE"));
        let values = values.ok_or_else(|| instance.fault("in place of ADVANCED_FACE"))?;
        let mut loops = Vec::new();
        for bound in references(values.get(1)).ok_or_else(|| instance.fault("without bounds"))? {
            loops.push(self.bound(bound)?);
        }
        let surface = self.surface(referred(instance, values, 2)?)?;
        let same_sense = truth(values.get(3)).ok_or_else(|| instance.fault("without a sense"))?;
        Ok(StepFace { surface, same_sense, loops, line: instance.line })
    }
}

impl ControlNet {
    /// The points with their weights; `None` where their counts differ.
    fn weighted(&self) -> Option<Vec<Vec<Vector4<f64>>>> {
        let Some(weights) = &self.weights else {
            return Some(self.rows.iter().map(|row| row.iter().map(|point| weighted(*point, 1.0)).collect()).collect());
        };
        let fits =
            weights.len() == self.rows.len() && weights.iter().zip(&self.rows).all(|(w, row)| w.len() == row.len());
        let row = |(row, weights): (&Vec<Vector3<f64>>, &Vec<f64>)| {
            row.iter().zip(weights).map(|(point, weight)| weighted(*point, *weight)).collect()
        };
        fits.then(|| self.rows.iter().zip(weights).map(row).collect())
    }
}

/// A spline of the first degree between two points is a line: some programs write edges that they have divided like this.
fn straight(curve: nurbs::NurbsCurve) -> StepCurve {
    match curve.controls.as_slice() {
        [first, last] if (last.xyz() / last.w - first.xyz() / first.w).norm() > 0.0 => {
            let (first, last) = (first.xyz() / first.w, last.xyz() / last.w);
            StepCurve::Line { origin: first, direction: (last - first).normalize() }
        }
        _ => StepCurve::Spline(curve),
    }
}

/// A knot vector from values and multiplicities.
fn full(counts: &[f64], values: &[f64]) -> Option<Vec<f64>> {
    if counts.len() != values.len() {
        return None;
    }
    let mut knots = Vec::new();
    for (count, value) in counts.iter().zip(values) {
        let count = whole(*count).filter(|count| count + knots.len() <= MOST_KNOTS)?;
        knots.extend(std::iter::repeat_n(*value, count));
    }
    Some(knots)
}

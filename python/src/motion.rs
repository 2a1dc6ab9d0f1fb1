//! `camgen.Motion` and `camgen.Law`: motions of a file, of laws, of samples, and of a function of Python.
//!
//! A function is asked for its values and derivatives once, when the motion is made. Between these places the motion is the polynomial of
//! degree 7 with the same lift and the same three derivatives at both ends; places are added until that agrees with the function between
//! them. So a motion never calls Python again, and a derivative that does not belong to the function is found, and told.

use crate::cam::of_word;
use crate::cli::args::parse;
use crate::errors::{option, refused};
use crate::options::quantity;
use crate::table;
use camgen::motion::laws::spline;
use camgen::motion::laws::{LAWS, LawCurve, LawTask};
use camgen::motion::program::rows::RowShape;
use camgen::numeric::extremum;
use camgen::units::{self, Dimension};
use camgen::{Jet, Piece, Program, Quantity, SampleCurve, Smooth};
use numpy::PyArray2;
use pyo3::prelude::*;
use pyo3::types::PyList;
use std::f64::consts::TAU;
use std::ops::Range;
use std::sync::Arc;

/// Lift and its three derivatives are continuous on a piece.
const SMOOTH: u32 = 3;
/// Cells of a piece of a curve in which its extremes are told apart, for each of its parts, and at least.
const CELLS: (u32, u32) = (4, 32);
/// Intervals of a stretch of a function to begin with, and the most.
const INTERVALS: (u16, usize) = (16, 4096);
/// Largest difference between a function and its polynomials, over the largest value of each derivative, or over the travel: the last is the
/// least accurate.
const AGREE: [f64; 4] = [1e-12, 1e-10, 1e-8, 1e-6];
/// Where a function is compared with the polynomial of an interval.
const COMPARED: [f64; 2] = [0.31, 0.73];
/// So far inside of a break a function is asked for its values there, rad: it has two at the break itself.
const INSIDE: f64 = 2e-12;
/// Largest share of a turn by which the ends of a motion may miss a turn, and its lift may jump from its end to its start.
const CLOSED: f64 = 1e-9;
/// What the derivatives are called.
const NAMES: [&str; 4] = ["the lift", "the velocity", "the acceleration", "the jerk"];

/// A curve over a stretch of the turn.
#[derive(Debug)]
struct Stretch {
    curve: LawCurve,
    start: f64,
    width: f64,
}

/// Values and derivatives by the angle, of a place of the curve.
fn by_angle([s, ds, dds, ddds]: [f64; 4], width: f64) -> Jet {
    let w = 1.0 / width;
    Jet { s, ds: ds * w, dds: dds * w * w, ddds: ddds * w * w * w }
}

/// A motion of curves over one turn.
#[derive(Debug)]
struct CurveMotion {
    quantity: Quantity,
    pieces: Vec<Piece>,
    /// The stretch of each piece, and the parts of its curve.
    sources: Vec<(usize, Range<usize>)>,
    stretches: Vec<Stretch>,
    lowest: f64,
}

impl CurveMotion {
    fn new(quantity: Quantity, stretches: Vec<Stretch>) -> Self {
        let (mut pieces, mut sources) = (Vec::new(), Vec::new());
        for (index, stretch) in stretches.iter().enumerate() {
            let groups = stretch.curve.smooth_to(SMOOTH);
            for parts in groups {
                let at = |x: f64| stretch.start + x * stretch.width;
                let (from, _) = stretch.curve.range_of(parts.start);
                let (_, to) = stretch.curve.range_of(parts.end - 1);
                let rests = parts.clone().all(|part| {
                    let (from, to) = stretch.curve.range_of(part);
                    [0.2, 0.5, 0.8].iter().all(|share| {
                        let [_, v, a, j] = stretch.curve.values_at(part, from + share * (to - from));
                        v == 0.0 && a == 0.0 && j == 0.0
                    })
                });
                let end = if to == 1.0 {
                    stretches.get(index + 1).map_or(stretch.start + stretch.width, |next| next.start)
                } else {
                    at(to)
                };
                pieces.push(Piece { start: at(from), end, dwell: rests });
                sources.push((index, parts));
            }
        }
        let mut motion = Self { quantity, pieces, sources, stretches, lowest: 0.0 };
        let lowest = |index: usize| {
            let piece = motion.pieces[index];
            let lift = |angle: f64| -camgen::Motion::jet(&motion, index, angle).s;
            let slope = |angle: f64| -camgen::Motion::jet(&motion, index, angle).ds;
            let cells = camgen::Motion::cells(&motion, index);
            -extremum::largest(lift, slope, (piece.start, piece.end), cells).value
        };
        let lowest = (0..motion.pieces.len()).map(lowest).fold(f64::INFINITY, f64::min);
        motion.lowest = lowest;
        motion
    }
}

impl camgen::Motion for CurveMotion {
    fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    fn jet(&self, piece: usize, angle: f64) -> Jet {
        let Some((stretch, parts)) = self.sources.get(piece) else { return Jet::default() };
        let Some(stretch) = self.stretches.get(*stretch) else { return Jet::default() };
        let x = ((angle - stretch.start) / stretch.width).clamp(0.0, 1.0);
        let part = stretch.curve.part_of(x).clamp(parts.start, parts.end - 1);
        let jet = by_angle(stretch.curve.values_at(part, x), stretch.width);
        Jet { s: jet.s - self.lowest, ..jet }
    }

    fn quantity(&self) -> Quantity {
        self.quantity
    }

    fn origin(&self) -> Option<f64> {
        Some(self.lowest)
    }

    fn cells(&self, piece: usize) -> u32 {
        let parts = self.sources.get(piece).map_or(1, |(_, parts)| u32::try_from(parts.len()).unwrap_or(u32::MAX));
        let dwells = self.pieces.get(piece).is_some_and(|piece| piece.dwell);
        if dwells { 1 } else { CELLS.0.saturating_mul(parts).max(CELLS.1) }
    }
}

/// A function of Python with its derivatives.
struct Function<'a, 'py>(&'a Bound<'py, PyAny>);

impl Function<'_, '_> {
    /// Lift and derivatives at places.
    fn at(&self, places: &[f64]) -> PyResult<Vec<[f64; 4]>> {
        let py = self.0.py();
        let numpy = py.import("numpy")?;
        let theta = table::array(py, places.to_vec());
        let values = self.0.call1((&theta,))?;
        let four: Vec<Bound<'_, PyAny>> = values.try_iter()?.collect::<PyResult<_>>()?;
        if four.len() != 4 {
            let why = format!("must return the lift and three derivatives, and returned {} values", four.len());
            return Err(option("function", why, Some("return s, ds, dds, ddds by the angle in radians".into())));
        }
        let mut found = vec![[0.0; 4]; places.len()];
        for (order, values) in four.iter().enumerate() {
            let full = numpy.call_method1("broadcast_to", (values, (places.len(),)))?;
            for ((found, value), place) in found.iter_mut().zip(table::numbers(&full)?).zip(places) {
                if !value.is_finite() {
                    let why = format!("{} at {place} rad is {value}", NAMES[order]);
                    return Err(option("function", why, None));
                }
                found[order] = value;
            }
        }
        Ok(found)
    }

    /// The curve over a stretch, which begins and ends at a break where that is stated.
    fn stretch(&self, (start, end): (f64, f64), breaks: [bool; 2]) -> PyResult<Stretch> {
        let [inside_first, inside_last] = breaks.map(|breaks| if breaks { INSIDE } else { 0.0 });
        let asked =
            Asked { function: self, start, width: end - start, ends: [start + inside_first, end - inside_last] };
        let mut knots: Vec<f64> = (0..=INTERVALS.0).map(|at| f64::from(at) / f64::from(INTERVALS.0)).collect();
        let mut nodes = asked.at(&knots)?;
        let mut open: Vec<bool> = vec![true; knots.len() - 1];
        loop {
            let curve = spline::chain(&knots, &nodes);
            let wrong = asked.disagreements(&curve, (&knots, &nodes), &open)?;
            let Some(first) = wrong.first() else { return Ok(Stretch { curve, start, width: asked.width }) };
            if knots.len() > INTERVALS.1 {
                return Err(asked.told(first));
            }
            let halved: Vec<usize> =
                (0..open.len()).filter(|at| wrong.iter().any(|wrong| wrong.interval == *at)).collect();
            let middles: Vec<f64> = halved.iter().map(|at| 0.5 * (knots[*at] + knots[*at + 1])).collect();
            let values = asked.at(&middles)?;
            open.fill(false);
            for ((at, x), value) in halved.iter().zip(middles).zip(values).rev() {
                knots.insert(at + 1, x);
                nodes.insert(at + 1, value);
                open[*at] = true;
                open.insert(at + 1, true);
            }
        }
    }
}

/// A function over a stretch, whose places run from 0 to 1 and whose derivatives are by these.
struct Asked<'a, 'f, 'py> {
    function: &'a Function<'f, 'py>,
    start: f64,
    width: f64,
    /// Where it is asked at its ends.
    ends: [f64; 2],
}

/// Where a function and the polynomial between its neighbours differ.
struct Disagreement {
    interval: usize,
    order: usize,
    x: f64,
    given: f64,
    found: f64,
}

impl Asked<'_, '_, '_> {
    fn angle(&self, x: f64) -> f64 {
        match x {
            0.0 => self.ends[0],
            1.0 => self.ends[1],
            x => self.start + x * self.width,
        }
    }

    fn at(&self, places: &[f64]) -> PyResult<Vec<[f64; 4]>> {
        let mut found = self.function.at(&places.iter().map(|x| self.angle(*x)).collect::<Vec<_>>())?;
        for (x, [s, ds, dds, ddds]) in places.iter().zip(&mut found) {
            // From just inside to the end itself.
            let step = match *x {
                0.0 => self.start - self.ends[0],
                1.0 => self.start + self.width - self.ends[1],
                _ => 0.0,
            };
            (*s, *ds, *dds) = (*s + step * *ds, *ds + step * *dds, *dds + step * *ddds);
        }
        let scaled = |jet: [f64; 4]| {
            let mut power = 1.0;
            jet.map(|value| {
                let scaled = value * power;
                power *= self.width;
                scaled
            })
        };
        Ok(found.into_iter().map(scaled).collect())
    }

    /// Within the intervals that are open.
    fn disagreements(
        &self,
        curve: &LawCurve,
        (knots, nodes): (&[f64], &[[f64; 4]]),
        open: &[bool],
    ) -> PyResult<Vec<Disagreement>> {
        let within = |at: usize| COMPARED.map(|share| (at, knots[at] + share * (knots[at + 1] - knots[at])));
        let places: Vec<(usize, f64)> = (0..open.len()).filter(|at| open[*at]).flat_map(within).collect();
        let given = self.at(&places.iter().map(|(_, x)| *x).collect::<Vec<_>>())?;
        let lowest = nodes.iter().map(|node| node[0]).fold(f64::INFINITY, f64::min);
        let mut largest = [f64::MIN_POSITIVE; 4];
        for node in nodes.iter().chain(&given) {
            for (order, largest) in largest.iter_mut().enumerate() {
                let value = if order == 0 { node[0] - lowest } else { node[order] };
                *largest = largest.max(value.abs());
            }
        }
        let scale = |order: usize| largest[order].max(largest[0]);
        let compared = |((interval, x), given): (&(usize, f64), &[f64; 4])| {
            let found = curve.values_at(curve.part_of(*x), *x);
            let is_off = |order: &usize| (found[*order] - given[*order]).abs() > AGREE[*order] * scale(*order);
            let order = (0..4).find(is_off)?;
            Some(Disagreement { interval: *interval, order, x: *x, given: given[order], found: found[order] })
        };
        Ok(places.iter().zip(&given).filter_map(compared).collect())
    }

    fn told(&self, wrong: &Disagreement) -> PyErr {
        let power: f64 = (0..wrong.order).map(|_| self.width).product();
        let why = format!(
            "{} and the other derivatives do not belong together at {:.4} deg: it returns {:.9e} there, the curve through its neighbours \
             has {:.9e}",
            NAMES[wrong.order],
            self.angle(wrong.x).to_degrees(),
            wrong.given / power,
            wrong.found / power
        );
        let remedy = "give exact derivatives by the angle in radians, and the angles where one of them jumps as breaks";
        option("function", why, Some(remedy.into()))
    }
}

/// A motion of a follower over one turn of the cam.
#[pyclass(frozen, module = "camgen")]
#[derive(Debug)]
pub(crate) struct Motion(pub(crate) Arc<dyn camgen::Motion>);

/// The law of a segment; `None` for a dwell.
fn law_of(given: Option<String>) -> PyResult<Option<&'static camgen::Law>> {
    match given.filter(|name| name != "dwell") {
        None => Ok(None),
        Some(name) => parse::law(&name).map(Some).map_err(|why| option("law", why, None)),
    }
}

/// A position: m, or rad of a swing.
fn position(given: &Bound<'_, PyAny>, quantity_of: Quantity) -> PyResult<f64> {
    let (dimension, unit) = match quantity_of {
        Quantity::Angle => (Dimension::Angle, "rad"),
        Quantity::Length => (Dimension::Length, "m"),
    };
    let parse = |text: &str| units::parse(text, dimension).map(|found| found.si).map_err(|error| error.to_string());
    Ok(quantity("position", Some(given), unit, parse)?.unwrap_or(0.0))
}

/// How a curve goes from sample to sample.
fn shape_of(name: &str) -> PyResult<RowShape> {
    match name {
        "natural" => Ok(RowShape::Natural),
        "monotonic" => Ok(RowShape::Monotonic),
        other => Err(option("shape", format!("no such word {other:?}; one of natural, monotonic"), None)),
    }
}

/// By how much a curve may leave samples.
fn smooth_of(given: &Bound<'_, PyAny>, of: Quantity) -> PyResult<Smooth> {
    if given.extract::<String>().is_ok_and(|word| word.trim().eq_ignore_ascii_case("auto")) {
        return Ok(Smooth::Auto);
    }
    Ok(Smooth::By(position(given, of)?))
}

#[pymethods]
impl Motion {
    /// Segments of law, cam angle and end position; the last takes what is left of the turn.
    #[staticmethod]
    #[pyo3(signature = (segments, *, start=None, quantity="length"))]
    fn program(segments: &Bound<'_, PyList>, start: Option<&Bound<'_, PyAny>>, quantity: &str) -> PyResult<Self> {
        let of = of_word(quantity)?;
        let mut all: Vec<(Option<&'static camgen::Law>, f64, f64)> = Vec::new();
        let mut turned = 0.0;
        for segment in segments.iter() {
            let (law, over, to): (Option<String>, Bound<'_, PyAny>, Bound<'_, PyAny>) =
                segment.extract().map_err(|_| {
                    option(
                        "segments",
                        "each is a law (or None), an angle and a position",
                        Some("(\"cycloidal\", \"90deg\", \"20mm\")".into()),
                    )
                })?;
            let over = crate::options::quantity("over", Some(&over), "rad", parse::segment_angle)?.unwrap_or(0.0);
            turned += over;
            all.push((law_of(law)?, over, position(&to, of)?));
        }
        if (turned - TAU).abs() > CLOSED * TAU {
            let why = format!("they take {:.6} deg, and a turn has 360", turned.to_degrees());
            return Err(option("segments", why, Some("give the last what is left of the turn".into())));
        }
        let start = start.map(|start| position(start, of)).transpose()?.unwrap_or(0.0);
        let program =
            Program::new(of, start, &all).map_err(|why| option("segments", why.what.clone(), why.remedy_words()))?;
        Ok(Self(Arc::new(program)))
    }

    /// A function of the angle with its derivatives.
    #[staticmethod]
    #[pyo3(signature = (function, *, breaks=None, quantity="length"))]
    fn from_function(function: &Bound<'_, PyAny>, breaks: Option<&Bound<'_, PyAny>>, quantity: &str) -> PyResult<Self> {
        let quantity = of_word(quantity)?;
        let inner = breaks.map(table::numbers).transpose()?.unwrap_or_default();
        let ordered = inner.iter().zip(inner.iter().skip(1)).all(|(a, b)| a < b);
        if !ordered || inner.iter().any(|at| !(0.0..TAU).contains(at)) {
            return Err(option("breaks", "must grow, from 0 and below a turn (rad)", None));
        }
        let at_start = inner.first() == Some(&0.0);
        let ends = std::iter::once(0.0).chain(inner.into_iter().filter(|at| *at > 0.0)).chain([TAU]);
        let ends: Vec<f64> = ends.collect();
        let asked = Function(function);
        let is_break = |at: f64| at_start || (at > 0.0 && at < TAU);
        let of = |(from, to): (&f64, &f64)| asked.stretch((*from, *to), [is_break(*from), is_break(*to)]);
        let stretches: Vec<Stretch> = ends.iter().zip(ends.iter().skip(1)).map(of).collect::<PyResult<_>>()?;
        closed(&stretches)?;
        Ok(Self(Arc::new(CurveMotion::new(quantity, stretches))))
    }

    /// The closed curve of least jerk through samples, or near them.
    #[staticmethod]
    #[pyo3(signature = (theta, lift, *, quantity="length", shape="natural", smooth=None, degree=5))]
    fn from_samples(
        theta: &Bound<'_, PyAny>,
        lift: &Bound<'_, PyAny>,
        quantity: &str,
        shape: &str,
        smooth: Option<&Bound<'_, PyAny>>,
        degree: u8,
    ) -> PyResult<Self> {
        let of = of_word(quantity)?;
        let (theta, lift) = (table::numbers(theta)?, table::numbers(lift)?);
        let curve =
            SampleCurve { shape: shape_of(shape)?, degree, smooth: smooth.map(|by| smooth_of(by, of)).transpose()? };
        let program = Program::through(of, &theta, &lift, curve)
            .map_err(|why| option("lift", why.what.clone(), why.remedy_words()))?;
        Ok(Self(Arc::new(program)))
    }

    #[getter]
    fn quantity(&self) -> &'static str {
        if self.0.quantity() == Quantity::Angle { "angle" } else { "length" }
    }

    /// First and last angle of its pieces.
    #[getter]
    fn pieces<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let rows: Vec<[f64; 2]> = self.0.pieces().iter().map(|piece| [piece.start, piece.end]).collect();
        table::rows(py, &rows)
    }

    /// Lift, velocity, acceleration and jerk at angles: a row of each.
    fn __call__<'py>(&self, py: Python<'py>, theta: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let places = table::numbers(theta)?;
        let jets: Vec<Jet> = places
            .iter()
            .map(|place| {
                let (piece, angle) = self.0.locate(*place);
                self.0.jet(piece, angle)
            })
            .collect();
        Ok(table::four(py, jets.iter().map(|jet| [jet.s, jet.ds, jet.dds, jet.ddds])))
    }

    fn __repr__(&self) -> String {
        format!("<camgen.Motion, {}, {} pieces>", self.quantity(), self.0.pieces().len())
    }
}

/// Refuses stretches whose lift jumps from one to the next.
fn closed(stretches: &[Stretch]) -> PyResult<()> {
    let ends = |stretch: &Stretch| {
        let last = stretch.curve.parts() - 1;
        (stretch.curve.values_at(0, 0.0)[0], stretch.curve.values_at(last, 1.0)[0])
    };
    let all: Vec<(f64, f64)> = stretches.iter().map(ends).collect();
    let values = || {
        all.iter()
            .flat_map(|(from, to)| [*from, *to])
            .chain(stretches.iter().map(|one| one.curve.values_at(one.curve.part_of(0.5), 0.5)[0]))
    };
    let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
    for (index, (_, to)) in all.iter().enumerate() {
        let next = (index + 1) % all.len();
        let from = all[next].0;
        if (to - from).abs() > CLOSED * range {
            let place = stretches[next].start.to_degrees();
            let why = format!("the lift jumps from {to} to {from} at {place:.3} deg");
            return Err(option("function", why, Some("a lift is continuous over the turn".into())));
        }
    }
    Ok(())
}

/// A law of motion between two rests.
#[pyclass(frozen, module = "camgen")]
#[derive(Debug)]
pub(crate) struct Law(&'static camgen::Law);

#[pymethods]
impl Law {
    #[getter]
    fn name(&self) -> &'static str {
        self.0.name
    }

    #[getter]
    fn aliases(&self) -> Vec<&'static str> {
        self.0.aliases.to_vec()
    }

    #[getter]
    fn formula(&self) -> &'static str {
        self.0.formula
    }

    #[getter]
    fn continuity(&self) -> u32 {
        self.0.continuity
    }

    /// Lift, velocity, acceleration and jerk between two rests, over travel and width 1: a row of each.
    fn __call__<'py>(&self, py: Python<'py>, x: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let places = table::numbers(x)?;
        if places.iter().any(|x| !(0.0..=1.0).contains(x)) {
            return Err(option("x", "must be from 0 to 1", None));
        }
        let curve = self.0.solve(&LawTask::default()).map_err(|error| refused("SolveError", &error.refusal))?;
        Ok(table::four(py, places.iter().map(|x| curve.values_at(curve.part_of(*x), *x))))
    }

    fn __repr__(&self) -> String {
        format!("<camgen.Law {}>", self.0.name)
    }
}

/// Every law.
#[pyfunction]
pub(crate) fn laws() -> Vec<Law> {
    LAWS.iter().map(Law).collect()
}

/// The law of a name.
#[pyfunction]
pub(crate) fn law(name: &str) -> PyResult<Law> {
    parse::law(name).map(Law).map_err(|why| option("name", why, None))
}

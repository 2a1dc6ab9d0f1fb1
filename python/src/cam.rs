//! `camgen.Cam`, `Drawing` and `Proven`: the steps from a solved cam to its files.

use crate::cli::args::parse;
use crate::errors::{ok, option};
use crate::options::{quantity, texts, word};
use crate::table;
use camgen::body::{self, DrawingEvidence, Inspection, Milling, Points, RateTolerance};
use camgen::check::{AsWritten, Measures, Walls};
use camgen::geometry::contour::{Bend, Contour};
use camgen::geometry::lead_in::LeadIn;
use camgen::geometry::points::PointInterpolation;
use camgen::motion::Quantity;
use camgen::pipeline::{Assembly, AssemblyDrawing, ExpectedFile, FileSet, ProvenAssembly, Writing};
use camgen::profile::outline::Fit;
use camgen::report::{Finding, Report, Speeds};
use camgen::tool_files::{Format, dxf, gcode, inspection, points, requested};
use camgen::verify;
use camgen::write::{csv, json};
use camgen::{Accuracy, Request, Side};
use numpy::ndarray::Array3;
use numpy::{IntoPyArray, PyArray2, PyArray3};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};

/// Millimetres in a metre.
const MILLIMETRES: f64 = 1e3;
/// Radius of the ball of a common probe, m, as on the command line.
const USUAL_BALL_RADIUS: f64 = 1.5e-3;

/// Helpers for what is written.
pub(crate) mod written {
    use crate::errors::option;
    use camgen::machine::fault_of_stem;
    use pyo3::prelude::*;

    /// The given start of the names of files, where it can be one.
    pub(crate) fn stem(given: Option<String>, own: &str) -> PyResult<String> {
        let Some(stem) = given else { return Ok(own.to_owned()) };
        fault_of_stem(&stem).map_or(Ok(stem), |why| Err(option("name", why, None)))
    }

    /// A page in a frame of a notebook.
    pub(crate) fn framed(py: Python<'_>, page: &[u8]) -> PyResult<String> {
        let text = String::from_utf8_lossy(page);
        py.import("camgen._shown")?.getattr("framed")?.call1((text,))?.extract()
    }
}

/// A report as the dictionary of its JSON.
pub(crate) fn report<'py>(py: Python<'py>, report: &Report) -> PyResult<Bound<'py, PyAny>> {
    let bytes = json::write(report).map_err(|why| crate::errors::told("FilesError", why))?;
    py.import("json")?.call_method1("loads", (PyBytes::new(py, &bytes),))
}

/// Findings as a tuple of `camgen.Finding`.
pub(crate) fn findings<'py>(py: Python<'py>, found: &[Finding]) -> PyResult<Bound<'py, PyAny>> {
    let class = py.import("camgen._findings")?.getattr("Finding")?;
    let one = |found: &Finding| {
        let arguments = PyDict::new(py);
        arguments.set_item("check", &*found.check)?;
        arguments.set_item("value", found.value)?;
        arguments.set_item("limit", found.limit)?;
        arguments.set_item("bound", found.bound.map(camgen::report::Bound::words))?;
        arguments.set_item("unit", &*found.unit)?;
        arguments.set_item("cam_deg", found.place.cam_deg)?;
        arguments.set_item("x_mm", found.place.x_mm)?;
        arguments.set_item("verdict", found.verdict.word().to_lowercase())?;
        arguments.set_item("about", found.about)?;
        arguments.set_item("note", found.note.as_ref().map(ToString::to_string))?;
        class.call((), Some(&arguments))
    };
    let all = found.iter().map(one).collect::<PyResult<Vec<_>>>()?;
    Ok(pyo3::types::PyTuple::new(py, all)?.into_any())
}

/// A solved cam: exact curves, nothing drawn yet; with those that are made with it.
#[pyclass(frozen, module = "camgen")]
#[derive(Debug)]
pub(crate) struct Cam {
    pub(crate) assembly: Assembly,
    pub(crate) stem: String,
    /// Of the path that its drawing has, m.
    pub(crate) cutter_radius: Option<f64>,
}

/// What `Cam.draw` is asked for.
struct Asked {
    request: Request,
    formats: Option<Vec<String>>,
    samples: u32,
    version: dxf::Version,
}

impl Cam {
    fn body(&self) -> &dyn camgen::body::Body {
        self.assembly.first().body()
    }

    /// The finding of one check, measured before anything is drawn.
    fn measured(&self, name: &str) -> Option<Finding> {
        let wanted = |check: &camgen::check::Check| check.name == name;
        let tolerance_mm = MILLIMETRES * Accuracy::default().tolerance();
        let walls = Walls::default();
        let written = AsWritten { rolled: None, outlines: &[], foreign: false, tolerance_mm, walls, size_mm: None };
        let mut measures = Measures::new(&wanted, written);
        self.body().measures(&mut measures);
        verify::judge(&measures.found()).into_iter().next()
    }

    /// The sections of its report as far as they need no drawing.
    fn sections(&self, py: Python<'_>) -> Vec<camgen::report::Section> {
        let tolerance_mm = MILLIMETRES * Accuracy::default().tolerance();
        let none = DrawingEvidence { drawn: None, rolled: &[], tolerance_mm, wanted: None };
        py.detach(|| self.body().sections(&none))
    }

    fn section<'py>(&self, py: Python<'py>, keys: &[&str]) -> PyResult<Bound<'py, PyDict>> {
        let loads = py.import("json")?.getattr("loads")?;
        let all = PyDict::new(py);
        for section in self.sections(py).iter().filter(|section| keys.is_empty() || keys.contains(&&*section.key)) {
            if section.value.is_null() {
                continue;
            }
            let value = loads.call1((section.value.to_string(),))?;
            match value.cast::<PyDict>() {
                Ok(values) if !keys.is_empty() => all.update(values.as_mapping())?,
                _ => all.set_item(&*section.key, value)?,
            }
        }
        Ok(all)
    }
}

#[pymethods]
impl Cam {
    #[getter]
    fn kind(&self) -> &'static str {
        self.body().kind().command
    }

    #[getter]
    fn name(&self) -> &str {
        self.body().machine().name()
    }

    #[getter]
    fn stem(&self) -> &str {
        &self.stem
    }

    #[getter]
    fn rpm(&self) -> Option<Vec<f64>> {
        match self.body().speeds() {
            Speeds::One(rpm) => Some(vec![rpm]),
            Speeds::Several(all) => Some(all),
            Speeds::Any(()) => None,
        }
    }

    #[getter]
    fn pressure_angle_deg(&self, py: Python<'_>) -> Option<f64> {
        py.detach(|| self.measured("pressure_angle")).map(|found| found.value)
    }

    #[getter]
    fn pressure_angle(&self, py: Python<'_>) -> Option<f64> {
        self.pressure_angle_deg(py).map(f64::to_radians)
    }

    #[getter]
    fn prime_radius_mm(&self) -> Option<f64> {
        body::curves(self.body())?.follower.prime_radius().map(|radius| MILLIMETRES * radius)
    }

    #[getter]
    fn base_radius_mm(&self) -> Option<f64> {
        let curves = body::curves(self.body())?;
        curves.follower.prime_radius().map(|radius| MILLIMETRES * (radius - curves.offset()))
    }

    /// The finding of one check, as far as it needs no drawing.
    fn finding<'py>(&self, py: Python<'py>, check: &str) -> PyResult<Option<Bound<'py, PyAny>>> {
        let found = py.detach(|| self.measured(check));
        found.map(|found| findings(py, std::slice::from_ref(&found))?.get_item(0)).transpose()
    }

    /// The figures of the report as far as they need no drawing, by its sections.
    fn figures<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.section(py, &[])
    }

    /// The figures of the forces.
    fn forces<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.section(py, &["force", "dynamics"])
    }

    /// The row of the table at each place of the motion.
    fn curves<'py>(&self, py: Python<'py>, theta: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        let places = table::numbers(theta)?;
        if let Some(place) = places.iter().find(|place| !place.is_finite()) {
            return Err(option("theta", format!("must be finite: {place}"), None));
        }
        let made = || {
            let motion = body::curves(self.body())?.motion;
            let row = |place: &f64| {
                let (piece, parameter) = motion.locate(*place);
                self.body().row_on(piece, parameter)
            };
            Some(camgen::Table::from_rows(&places.iter().map(row).collect::<Option<Vec<_>>>()?))
        };
        let made = py.detach(made).ok_or_else(|| {
            let why = format!("a {} has no curves in one plane", self.body().kind().noun);
            option("theta", why, Some("cam.table(samples) has its sections".into()))
        })?;
        table::of(py, &made)
    }

    #[pyo3(signature = (samples=720))]
    fn table<'py>(&self, py: Python<'py>, samples: u32) -> PyResult<Bound<'py, PyAny>> {
        let samples = rows(samples)?;
        let other = self.assembly.others().first().map(|(_, other)| other.body());
        let made = py.detach(|| csv::table(self.body(), other, &[], samples));
        table::of(py, &made)
    }

    /// Whether a file is this cam: its report.
    #[pyo3(signature = (file, tolerance=None, *, section_rpm=None, layer=None, cutter_diameter=None))]
    fn check<'py>(
        &self,
        py: Python<'py>,
        file: &Bound<'py, PyAny>,
        tolerance: Option<&Bound<'py, PyAny>>,
        section_rpm: Option<f64>,
        layer: Option<&str>,
        cutter_diameter: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let bytes: Vec<u8> = match file.cast::<PyBytes>() {
            Ok(bytes) => bytes.as_bytes().to_vec(),
            Err(_) => {
                let path = crate::options::path("file", file)?;
                py.detach(|| camgen::document::file::bytes_of(&path, camgen::reading::LARGEST_FILE)).map_err(|why| {
                    crate::errors::told("ReadError", format!("cannot read `{}`: {why}", path.display()))
                })?
            }
        };
        let tolerance = quantity("tolerance", tolerance, "m", parse::tolerance)?;
        let cutter = quantity("cutter_diameter", cutter_diameter, "m", parse::cutter_diameter)?.or(self.cutter_radius);
        let expected = ExpectedFile { layer, section: section_rpm, cut: None, cutter, cutter_is_recorded: false };
        let request = Request::within(tolerance.unwrap_or(Accuracy::default().tolerance()));
        let found = ok(py.detach(|| self.assembly.first().check_file(&bytes, &expected, request)))?;
        report(py, &found)
    }

    #[pyo3(signature = (tolerance=None, *, accuracy=None, tolerance_velocity=None, tolerance_acceleration=None, side="both",
                        outline="arcs", start=None, lead_in=None, formats=None, samples=720, dxf_version="r2000",
                        controller=None, ball_diameter=None, points_of=None, points_as=None, points_step=None,
                        points_between=None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn draw(
        &self,
        py: Python<'_>,
        tolerance: Option<&Bound<'_, PyAny>>,
        accuracy: Option<&str>,
        tolerance_velocity: Option<&Bound<'_, PyAny>>,
        tolerance_acceleration: Option<&Bound<'_, PyAny>>,
        side: &str,
        outline: &str,
        start: Option<&Bound<'_, PyAny>>,
        lead_in: Option<&Bound<'_, PyAny>>,
        formats: Option<&Bound<'_, PyAny>>,
        samples: u32,
        dxf_version: &str,
        controller: Option<&str>,
        ball_diameter: Option<&Bound<'_, PyAny>>,
        points_of: Option<&str>,
        points_as: Option<&str>,
        points_step: Option<&str>,
        points_between: Option<&str>,
    ) -> PyResult<Drawing> {
        let named: Accuracy = word("accuracy", accuracy)?.unwrap_or_default();
        let own = quantity("tolerance", tolerance, "m", parse::tolerance)?;
        if own.is_some() && accuracy.is_some() {
            return Err(option("accuracy", "names a tolerance, which is given as well", None));
        }
        let fit = Fit {
            side: word::<Side>("side", Some(side))?.unwrap_or_default(),
            laid: word("outline", Some(outline))?.unwrap_or_default(),
            ..Fit::from(own.unwrap_or(named.tolerance()))
        };
        let velocity = rate("tolerance_velocity", tolerance_velocity, parse::velocity_error)?;
        let acceleration = rate("tolerance_acceleration", tolerance_acceleration, parse::acceleration_error)?;
        let formats = formats.filter(|formats| !formats.is_none()).map(|formats| texts(Some(formats))).transpose()?;
        let request = Request {
            rates: [velocity.unwrap_or(None), acceleration.unwrap_or(named.acceleration())],
            strict: [velocity.is_some(), acceleration.is_some()],
            cutter_radius: self.cutter_radius,
            start: quantity("start", start, "rad", parse::start)?,
            lead_in: lead_in.map(self::lead_in).transpose()?,
            ..Request::within(fit)
        };
        let points = [points_of, points_as, points_step, points_between];
        let request = with_tables(request, formats.as_deref(), (controller, ball_diameter, points))?;
        let version = parse::dxf_version(dxf_version).map_err(|why| option("dxf_version", why, None))?;
        self.drawn(py, Asked { request, formats, samples: rows(samples)?, version })
    }

    fn __repr__(&self) -> String {
        let radius = self.base_radius_mm().map_or(String::new(), |radius| format!(", base radius {radius} mm"));
        format!("<camgen.Cam {:?}, {}{}{radius}>", self.name(), self.body().kind().noun, self.body().speeds())
    }

    #[pyo3(signature = (samples=720))]
    fn plot<'py>(slf: &Bound<'py, Self>, samples: u32) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("camgen._plot")?.call_method1("cam", (slf, samples))
    }
}

impl Cam {
    fn drawn(&self, py: Python<'_>, asked: Asked) -> PyResult<Drawing> {
        let Asked { request, formats, samples, version } = asked;
        let writing = Writing { formats, samples, ..Writing::to("output", &self.stem) };
        let (chosen, _) = ok(writing.chosen(self.body()))?;
        // The flank of a three-dimensional cam is drawn, and proved, only for a format that shows it.
        let request = Request { flank: chosen.iter().any(Format::shows_flank), ..request };
        let drawing = ok(py.detach(|| self.assembly.draw(request)))?;
        Ok(Drawing { drawing, writing, version })
    }
}

/// What is drawn for some formats only, with its options: the control of a program, the ball of a probe, and curve, form, step and
/// interpolation of a table of points.
fn with_tables(
    request: Request,
    formats: Option<&[String]>,
    (controller, ball, points): (Option<&str>, Option<&Bound<'_, PyAny>>, [Option<&str>; 4]),
) -> PyResult<Request> {
    let has = |name: &str| formats.into_iter().flatten().any(|format| format == name);
    let ball = quantity("ball_diameter", ball, "m", parse::cutter_diameter)?;
    for (parameter, given, format) in [
        ("controller", controller.is_some(), gcode::FORMAT),
        ("ball_diameter", ball.is_some(), inspection::FORMAT),
        ("points_of", points.iter().any(Option::is_some), points::FORMAT),
    ] {
        if given && !has(format) {
            let remedy = format!("formats=[{format:?}]");
            return Err(option(parameter, format!("belongs to the format {format}"), Some(remedy)));
        }
    }
    let [curve, form, step, between] = points;
    let points = has(points::FORMAT).then_some(Points {
        curve: word("points_of", curve)?.unwrap_or(body::PointCurve::Profile),
        form: word("points_as", form)?,
        step: word("points_step", step)?,
        between: word("points_between", between)?.unwrap_or(PointInterpolation::Linear),
    });
    let ball_radius = ball.unwrap_or(USUAL_BALL_RADIUS);
    Ok(Request {
        milling: has(gcode::FORMAT).then_some(Milling { controller: word("controller", controller)? }),
        formats: requested(formats.unwrap_or_default()),
        inspection: has(inspection::FORMAT).then_some(Inspection { ball_radius }),
        points,
        ..request
    })
}

/// Rows of a table.
fn rows(samples: u32) -> PyResult<u32> {
    parse::samples(&samples.to_string()).map_err(|why| option("samples", why, None))
}

/// A tolerance of velocity or acceleration: a number is a share.
fn rate(
    parameter: &str,
    given: Option<&Bound<'_, PyAny>>,
    parse: fn(&str) -> Result<parse::RateLimit, String>,
) -> PyResult<Option<Option<RateTolerance>>> {
    let Some(given) = given.filter(|given| !given.is_none()) else { return Ok(None) };
    if let Ok(share) = given.extract::<f64>() {
        return if share > 0.0 && share <= 1.0 {
            Ok(Some(Some(RateTolerance::Share(share))))
        } else {
            Err(option(parameter, format!("a share is above 0 and at most 1: {share}"), Some("\"5%\" or 0.05".into())))
        };
    }
    let text: String = given.extract()?;
    match parse(&text).map_err(|why| option(parameter, why, None))? {
        parse::RateLimit::Any => Ok(Some(None)),
        parse::RateLimit::Within(rate) => Ok(Some(Some(rate))),
    }
}

/// The path of the tool to the start: a form, or a form and a size.
fn lead_in(given: &Bound<'_, PyAny>) -> PyResult<LeadIn> {
    let (form, size): (String, Option<Bound<'_, PyAny>>) = match given.extract::<String>() {
        Ok(form) => (form, None),
        Err(_) => {
            let (form, size): (String, Bound<'_, PyAny>) = given.extract().map_err(|_| {
                option("lead_in", "must be a form, or a form and a size", Some("(\"arc\", \"5mm\")".into()))
            })?;
            (form, Some(size))
        }
    };
    let form = word("lead_in", Some(&form))?.ok_or_else(|| option("lead_in", "must be a form", None))?;
    let size = quantity("lead_in", size.as_ref(), "m", parse::cutter_radius)?.unwrap_or(0.005);
    Ok(LeadIn { form, size })
}

/// A cam as drawn to a tolerance, not yet proved.
#[pyclass(frozen, module = "camgen")]
#[derive(Debug)]
pub(crate) struct Drawing {
    drawing: AssemblyDrawing,
    writing: Writing,
    version: dxf::Version,
}

#[pymethods]
impl Drawing {
    fn prove(&self, py: Python<'_>) -> PyResult<Proven> {
        let drawing = self.drawing.clone();
        let proven = ok(py.detach(|| drawing.prove_as(self.version)))?;
        Ok(Proven { proven, writing: self.writing.clone() })
    }

    fn __repr__(&self) -> String {
        format!("<camgen.Drawing {}>", self.writing.stem)
    }
}

/// A cam whose cut files were written to memory, read back and checked.
#[pyclass(frozen, module = "camgen")]
#[derive(Debug)]
pub(crate) struct Proven {
    proven: ProvenAssembly,
    writing: Writing,
}

impl Proven {
    /// The files of formats in memory, also of a cam that breaks a limit.
    fn made(&self, py: Python<'_>, formats: Option<Vec<String>>) -> PyResult<FileSet> {
        let formats = formats.or_else(|| self.writing.formats.clone());
        let writing = Writing { formats, force: true, ..self.writing.clone() };
        ok(py.detach(|| self.proven.files(&writing)))
    }

    fn contours(&self) -> impl Iterator<Item = &Contour> {
        self.proven.first().outlines().iter().map(|outline| &outline.contour)
    }
}

/// A chain as rows of x, y and bulge; the bulge of a cubic curve is NaN.
fn bulges<'py>(py: Python<'py>, contour: &Contour) -> Bound<'py, PyArray2<f64>> {
    let row = |vertex: &camgen::Vertex| [vertex.point.x, vertex.point.y, vertex.bulge().unwrap_or(f64::NAN)];
    table::rows(py, &contour.vertices.iter().map(row).collect::<Vec<_>>())
}

#[pymethods]
impl Proven {
    #[getter]
    fn passed(&self) -> bool {
        self.proven.passed()
    }

    #[getter]
    fn no_outline(&self) -> Option<&str> {
        self.proven.no_outline()
    }

    #[getter]
    fn findings<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        findings(py, self.proven.findings())
    }

    #[getter]
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        report(py, &py.detach(|| self.proven.report()))
    }

    #[getter]
    fn outline<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let first = self.contours().next().ok_or_else(|| {
            let why = self.no_outline().unwrap_or("it is cut in space");
            crate::errors::told("RefusedError", format!("there is no outline: {why}"))
        })?;
        Ok(bulges(py, first))
    }

    #[getter]
    fn outlines<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        PyList::new(py, self.contours().map(|contour| bulges(py, contour)).collect::<Vec<_>>())
    }

    /// The cubic curves of a spline outline by their four control points.
    #[getter]
    fn cubics<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let edges: Vec<_> = self.contours().next().into_iter().flat_map(Contour::edges).collect();
        let cubics: Vec<_> = edges.iter().filter(|edge| matches!(edge.bend(), Bend::Cubic(_))).collect();
        let mut points = Array3::<f64>::zeros((cubics.len(), 4, 2));
        for (index, edge) in cubics.iter().enumerate() {
            let Bend::Cubic([leaves, arrives]) = edge.bend() else { continue };
            for (at, point) in [edge.start(), leaves, arrives, edge.end()].into_iter().enumerate() {
                points[[index, at, 0]] = point.x;
                points[[index, at, 1]] = point.y;
            }
        }
        Ok(points.into_pyarray(py))
    }

    #[getter]
    fn area_mm2(&self) -> Option<f64> {
        let drawn = self.proven.first().drawn()?;
        drawn.parts.first().map(|part| part.area_and_moment().0)
    }

    #[pyo3(signature = (samples=None))]
    fn table<'py>(&self, py: Python<'py>, samples: Option<u32>) -> PyResult<Bound<'py, PyAny>> {
        let samples = rows(samples.unwrap_or(self.writing.samples))?;
        let made = py.detach(|| self.proven.table(samples));
        table::of(py, &made)
    }

    /// The bytes of a file by its ending.
    fn bytes<'py>(&self, py: Python<'py>, ending: &str) -> PyResult<Bound<'py, PyBytes>> {
        // One format alone is made alone; the name of a table or a program tells no format.
        let format = ending.strip_prefix('.').filter(|name| parse::format(name).is_ok());
        let asked = format.map(|name| vec![name.to_owned()]);
        let files = self.made(py, asked)?;
        let bytes = files.bytes(ending).ok_or_else(|| {
            let names: Vec<&str> = files.outputs().iter().map(|file| file.name.as_str()).collect();
            option("ending", format!("no file ends with {ending:?}; there are {}", names.join(", ")), None)
        })?;
        Ok(PyBytes::new(py, bytes))
    }

    /// Every file by its name.
    #[pyo3(signature = (formats=None))]
    fn files<'py>(&self, py: Python<'py>, formats: Option<&Bound<'py, PyAny>>) -> PyResult<Bound<'py, PyDict>> {
        let formats = formats.map(|formats| texts(Some(formats))).transpose()?;
        let all = PyDict::new(py);
        for file in self.made(py, formats)?.outputs() {
            all.set_item(&file.name, PyBytes::new(py, &file.bytes))?;
        }
        Ok(all)
    }

    #[pyo3(signature = (directory, *, formats=None, name=None, force=false, overwrite=false))]
    fn write<'py>(
        &self,
        py: Python<'py>,
        directory: &Bound<'py, PyAny>,
        formats: Option<&Bound<'py, PyAny>>,
        name: Option<String>,
        force: bool,
        overwrite: bool,
    ) -> PyResult<Bound<'py, PyAny>> {
        let directory = crate::options::path("directory", directory)?;
        let asked = formats.map(|formats| texts(Some(formats))).transpose()?;
        let stem = written::stem(name, &self.writing.stem)?;
        let formats = asked.or_else(|| self.writing.formats.clone());
        let writing = Writing { directory, stem, formats, force, overwrite, ..self.writing.clone() };
        let done = ok(py.detach(|| self.proven.files(&writing)?.commit()))?;
        report(py, &done)
    }

    fn __repr__(&self) -> String {
        let failed: Vec<&str> = camgen::report::failed(self.proven.findings());
        let verdict = match (self.passed(), failed.is_empty()) {
            (true, _) => "passed".to_owned(),
            (false, true) => "FAILED".to_owned(),
            (false, false) => format!("FAILED: {}", failed.join(", ")),
        };
        format!("<camgen.Proven {}, {verdict}>", self.writing.stem)
    }

    fn _repr_html_(&self, py: Python<'_>) -> PyResult<Option<String>> {
        if self.no_outline().is_some() {
            return Ok(None);
        }
        written::framed(py, self.bytes(py, ".html")?.as_bytes()).map(Some)
    }

    fn _repr_svg_(&self, py: Python<'_>) -> PyResult<Option<String>> {
        if self.no_outline().is_some() {
            return Ok(None);
        }
        Ok(Some(String::from_utf8_lossy(self.bytes(py, ".svg")?.as_bytes()).into_owned()))
    }

    fn plot<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("camgen._plot")?.call_method1("proven", (slf,))
    }

    fn to_build123d<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("camgen._solids")?.call_method1("to_build123d", (slf,))
    }

    fn to_cadquery<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("camgen._solids")?.call_method1("to_cadquery", (slf,))
    }
}

/// The quantity of a word.
pub(crate) fn of_word(given: &str) -> PyResult<Quantity> {
    match given {
        "length" => Ok(Quantity::Length),
        "angle" => Ok(Quantity::Angle),
        other => Err(option("quantity", format!("no such word {other:?}; one of length, angle"), None)),
    }
}

//! `camgen.Study`: the rows of a study file, any stretch of them by itself.

use crate::errors::{of_study, option};
use camgen::study::{self, Journal, StudyFiles};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;

/// A study file, every value in range.
#[pyclass(frozen, module = "camgen")]
#[derive(Debug)]
pub(crate) struct Study(study::Study);

#[pymethods]
impl Study {
    #[staticmethod]
    fn load(py: Python<'_>, name_or_path: &Bound<'_, PyAny>) -> PyResult<Self> {
        let path: String = py.import("os")?.call_method1("fspath", (name_or_path,))?.extract()?;
        py.detach(|| study::Study::load(&path)).map(Self).map_err(|error| of_study(&error))
    }

    #[staticmethod]
    #[pyo3(signature = (text, *, name="study"))]
    fn from_toml(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        py.detach(|| study::Study::from_toml(name, text)).map(Self).map_err(|error| of_study(&error))
    }

    #[getter]
    fn name(&self) -> &str {
        self.0.name()
    }

    #[getter]
    fn stem(&self) -> &str {
        self.0.stem()
    }

    #[getter]
    fn kind(&self) -> &'static str {
        self.0.kind().word()
    }

    #[getter]
    fn digest(&self) -> &str {
        self.0.digest()
    }

    #[getter]
    fn proves(&self) -> bool {
        self.0.proves()
    }

    #[getter]
    fn header<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, self.0.header().as_bytes())
    }

    fn __len__(&self) -> usize {
        usize::try_from(self.0.count()).unwrap_or(usize::MAX)
    }

    /// The overrides of a design, and its speed where one is given.
    fn design(&self, row: u64) -> PyResult<(Vec<String>, Option<f64>)> {
        if row >= self.0.count() {
            return Err(option("row", format!("the study has {} designs, counted from 0", self.0.count()), None));
        }
        Ok(self.0.overrides(&self.0.values(row)))
    }

    /// The lines of a stretch of rows.
    fn rows<'py>(&self, py: Python<'py>, start: u64, end: u64) -> PyResult<Bound<'py, PyBytes>> {
        if start > end || end > self.0.count() {
            return Err(option("end", format!("the study has {} designs", self.0.count()), None));
        }
        Ok(PyBytes::new(py, &py.detach(|| self.0.rows(start, end))))
    }

    /// Puts stretches of rows, in their order, together to the files of the command; returns the summary as JSON, and the files.
    #[pyo3(signature = (stretches, out, *, name=None, page=false, overwrite=false))]
    fn collect(
        &self,
        py: Python<'_>,
        stretches: &Bound<'_, PyAny>,
        out: PathBuf,
        name: Option<String>,
        page: bool,
        overwrite: bool,
    ) -> PyResult<(String, Vec<PathBuf>)> {
        let stem = crate::cam::written::stem(name, self.0.stem())?;
        let files = StudyFiles { page, parquet: false, overwrite, restart: true };
        let mut journal = Journal::open(&self.0, &out, &stem, files).map_err(|error| of_study(&error))?;
        for stretch in stretches.try_iter()? {
            let stretch = stretch?;
            let bytes = stretch.cast::<PyBytes>()?.as_bytes();
            let first = bytes.split(|byte| *byte == b',').next().unwrap_or_default();
            if !bytes.is_empty() && *first != *journal.done().to_string().as_bytes() {
                let first = String::from_utf8_lossy(first);
                let why = format!("row {} is missing: a stretch begins with row {first}", journal.done());
                return Err(option("stretches", why, Some("give every row once, in order".into())));
            }
            let lines = bytes.split(|byte| *byte == b'\n').skip(1).count() as u64;
            py.detach(|| journal.add(journal.done() + lines, bytes)).map_err(|error| of_study(&error))?;
        }
        if journal.done() != self.0.count() {
            let why = format!("{} of {} rows were given", journal.done(), self.0.count());
            return Err(option("stretches", why, Some("give every row once, in order".into())));
        }
        let (_, json, written) = py.detach(|| journal.finish(&self.0, files)).map_err(|error| of_study(&error))?;
        Ok((json.to_string(), written))
    }

    fn __repr__(&self) -> String {
        format!("<camgen.Study {:?}, {} designs>", self.0.name(), self.0.count())
    }
}

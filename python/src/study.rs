//! `camgen.Study`: the rows of a study file, any stretch of them by itself.

use crate::errors::{of_study, option, told};
use camgen::study::{self, Journal, StudyError, StudyFiles};
use camgen::write::files::{Output, write_all, write_beside_others};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;

/// Puts the files of a complete study in place; its summary as JSON, and the files.
fn put(journal: &Journal, study: &study::Study) -> Result<(String, Vec<PathBuf>), StudyError> {
    let summary = journal.summary(study)?;
    let (complete, staged) = journal.stage(journal.reopened()?, study, summary)?;
    staged.commit()?;
    Ok((complete.json.to_string(), complete.written))
}

/// Writes a file whole into a folder, made if missing. Unless it is written `alone`, other processes write other files there at the same time.
#[pyfunction]
#[pyo3(signature = (folder, name, data, alone=false))]
pub(crate) fn write_shard(
    py: Python<'_>,
    folder: &Bound<'_, PyAny>,
    name: String,
    data: &[u8],
    alone: bool,
) -> PyResult<()> {
    let folder = crate::options::path("folder", folder)?;
    let output = Output { name, bytes: data.to_vec() };
    let written =
        py.detach(|| if alone { write_all(&folder, &[output]) } else { write_beside_others(&folder, &output) });
    written.map_err(|error| told("FilesError", error))
}

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

    /// What the names of its files begin with, if a name is given or not.
    #[pyo3(signature = (name=None))]
    fn file_stem(&self, name: Option<String>) -> PyResult<String> {
        crate::cam::written::stem(name, self.0.stem())
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
        out: &Bound<'_, PyAny>,
        name: Option<String>,
        page: bool,
        overwrite: bool,
    ) -> PyResult<(String, Vec<PathBuf>)> {
        let out = crate::options::path("out", out)?;
        let stem = crate::cam::written::stem(name, self.0.stem())?;
        let files = StudyFiles { page, parquet: false, overwrite, restart: true };
        let journal = py.detach(|| Journal::open(&self.0, &out, &stem, files));
        let mut journal = journal.map_err(|error| of_study(&error))?;
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
        py.detach(|| put(&journal, &self.0)).map_err(|error| of_study(&error))
    }

    fn __repr__(&self) -> String {
        format!("<camgen.Study {:?}, {} designs>", self.0.name(), self.0.count())
    }
}

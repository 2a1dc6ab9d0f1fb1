//! Tables and curves as arrays of numpy, with one copy.

use camgen::Table;
use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// A `camgen.Table` of a table: an array with a row for each column.
pub(crate) fn of<'py>(py: Python<'py>, table: &Table) -> PyResult<Bound<'py, PyAny>> {
    let (columns, rows) = (table.columns.len(), table.rows.len());
    let mut values = Array2::<f64>::zeros((columns, rows));
    for (at, row) in table.rows.iter().enumerate() {
        for (column, value) in row.iter().enumerate() {
            values[[column, at]] = *value;
        }
    }
    let names = PyTuple::new(py, &table.columns)?;
    let words = table.words.as_ref().map(|(name, words)| (*name, words.clone()));
    py.import("camgen._table")?.getattr("Table")?.call1((names, values.into_pyarray(py), words))
}

/// An array of rows of a fixed number of columns.
pub(crate) fn rows<'py, const N: usize>(py: Python<'py>, rows: &[[f64; N]]) -> Bound<'py, PyArray2<f64>> {
    Array2::from_shape_fn((rows.len(), N), |(row, column)| rows[row][column]).into_pyarray(py)
}

/// What may be an array of numbers, as a list.
pub(crate) fn numbers(given: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    let numpy = given.py().import("numpy")?;
    let array = numpy.call_method1("ravel", (numpy.call_method1("asarray", (given, "float64"))?,))?;
    let array = numpy.call_method1("ascontiguousarray", (array,))?;
    let array: PyReadonlyArray1<'_, f64> = array.extract()?;
    Ok(array.as_slice()?.to_vec())
}

/// An array of numbers.
pub(crate) fn array<'py>(py: Python<'py>, numbers: Vec<f64>) -> Bound<'py, PyArray1<f64>> {
    numbers.into_pyarray(py)
}

/// Four rows of values and derivatives.
pub(crate) fn four<'py>(py: Python<'py>, places: impl ExactSizeIterator<Item = [f64; 4]>) -> Bound<'py, PyArray2<f64>> {
    let mut all = Array2::<f64>::zeros((4, places.len()));
    for (at, values) in places.enumerate() {
        for (order, value) in values.into_iter().enumerate() {
            all[[order, at]] = value + 0.0;
        }
    }
    all.into_pyarray(py)
}

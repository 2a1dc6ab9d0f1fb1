//! Values of parameters: a number is in SI units, a text has its unit.

use crate::errors::option;
use camgen::document::{NamedChoice, similar};
use camgen::write::number::{shortest, with_unit};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyList, PyTuple};
use std::path::PathBuf;

/// A quantity: a number in the SI unit, or a text with a unit that `parse` reads.
pub(crate) fn quantity<T>(
    parameter: &str,
    given: Option<&Bound<'_, PyAny>>,
    unit: &str,
    parse: impl Fn(&str) -> Result<T, String>,
) -> PyResult<Option<T>> {
    let Some(given) = given.filter(|given| !given.is_none()) else { return Ok(None) };
    let text = match given.extract::<f64>() {
        Ok(number) => with_unit(number, unit),
        Err(_) => text_of(parameter, given)?,
    };
    parse(&text).map(Some).map_err(|why| option(parameter, why, None))
}

fn text_of(parameter: &str, given: &Bound<'_, PyAny>) -> PyResult<String> {
    given.extract().map_err(|_| option(parameter, "must be a number or a text", None))
}

/// A path: a text, bytes, or an object with one. A text that is no name of a file on this system is refused.
pub(crate) fn path(parameter: &str, given: &Bound<'_, PyAny>) -> PyResult<PathBuf> {
    let os = given.py().import("os")?;
    let found = os.call_method1("fspath", (given,))?;
    // The conversion itself panics at such a text.
    if os.call_method1("fsencode", (&found,)).is_err() {
        return Err(option(parameter, "the path has characters that no name of a file has here", None));
    }
    os.call_method1("fsdecode", (&found,))?.extract()
}

/// One of the words of a choice.
pub(crate) fn word<T: NamedChoice>(parameter: &str, given: Option<&str>) -> PyResult<Option<T>> {
    let Some(given) = given else { return Ok(None) };
    T::named(given).map(Some).ok_or_else(|| {
        let known: Vec<&str> = T::ALL.iter().map(|(word, _)| *word).collect();
        let near = similar(given, known.iter().copied()).map(|word| format!("did you mean {word:?}?"));
        option(parameter, format!("no such word {given:?}; one of {}", known.join(", ")), near)
    })
}

/// A text, or several.
pub(crate) fn texts(given: Option<&Bound<'_, PyAny>>) -> PyResult<Vec<String>> {
    match given.filter(|given| !given.is_none()) {
        None => Ok(Vec::new()),
        Some(given) => match given.extract::<String>() {
            Ok(text) => Ok(text.split(',').map(|part| part.trim().to_owned()).collect()),
            Err(_) => given.try_iter()?.map(|item| item?.extract()).collect(),
        },
    }
}

/// A value as after `--set`.
fn typed(given: &Bound<'_, PyAny>) -> PyResult<String> {
    if let Ok(truth) = given.cast::<PyBool>() {
        return Ok(truth.is_true().to_string());
    }
    if given.is_instance_of::<PyList>() || given.is_instance_of::<PyTuple>() {
        let items: Vec<String> = given.try_iter()?.map(|item| typed(&item?)).collect::<PyResult<_>>()?;
        return Ok(format!("[{}]", items.join(", ")));
    }
    match given.extract::<String>() {
        Ok(text) => Ok(text),
        Err(_) => {
            Ok(shortest(given.extract::<f64>().map_err(|_| {
                option("overrides", "a value must be a text, a number, a truth or a list of these", None)
            })?))
        }
    }
}

/// The overrides of a machine, each `key=value`.
pub(crate) fn overrides(given: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<String>> {
    let pair = |(key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>)| {
        let key: String = key.extract()?;
        if key.contains('=') {
            return Err(option("overrides", format!("a key has no `=`: {key:?}"), None));
        }
        Ok(format!("{key}={}", typed(&value)?))
    };
    given.into_iter().flat_map(PyDictMethods::iter).map(pair).collect()
}

/// Flags of the command line of keyword arguments: `cut_for=30` is `--cut-for 30`, a truth is a flag without a value.
pub(crate) fn flags(given: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<String>> {
    let mut all = Vec::new();
    for (key, value) in given.into_iter().flat_map(PyDictMethods::iter) {
        let flag = format!("--{}", key.extract::<String>()?.replace('_', "-"));
        if value.is_none() {
            continue;
        }
        if let Ok(truth) = value.cast::<PyBool>() {
            all.extend(truth.is_true().then_some(flag));
            continue;
        }
        if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
            let items: Vec<String> = value.try_iter()?.map(|item| typed(&item?)).collect::<PyResult<_>>()?;
            all.push(format!("{flag}={}", items.join(",")));
        } else {
            all.push(format!("{flag}={}", typed(&value)?));
        }
    }
    Ok(all)
}

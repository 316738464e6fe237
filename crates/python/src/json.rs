//! JSON of the library as Python values, and values that can be pickled.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::Value as Json;

/// A JSON value as dictionaries, lists, strings and numbers.
pub fn dict<'py>(py: Python<'py>, json: &Json) -> PyResult<Bound<'py, PyAny>> {
    text(py, &json.to_string())
}

/// A JSON text as dictionaries, lists, strings and numbers.
pub fn text<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (text,))
}

/// How pickle makes a value again: `pushplan.CLASS.parse` of the text of its file.
pub fn unpickled<'py>(py: Python<'py>, class: &str, json: &Json) -> PyResult<Bound<'py, PyAny>> {
    let parse = py.import("pushplan")?.getattr(class)?.getattr("parse")?;
    let text =
        serde_json::to_string(json).map_err(|error| PyValueError::new_err(error.to_string()));
    Ok((parse, (text?,)).into_pyobject(py)?.into_any())
}

/// What pickle kept: an object.
pub fn kept(text: &str) -> PyResult<Json> {
    serde_json::from_str(text).map_err(damaged)
}

/// That pickle kept something else.
pub fn damaged(error: serde_json::Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

//! Conversion of the library's JSON to Python values, and pickling.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::Value as Json;

/// Converts a JSON value to dictionaries, lists, strings and numbers.
pub fn dict<'py>(py: Python<'py>, json: &Json) -> PyResult<Bound<'py, PyAny>> {
    text(py, &json.to_string())
}

/// Parses a JSON text to dictionaries, lists, strings and numbers.
pub fn text<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (text,))
}

/// Returns the reconstruction for pickle: `pushplan.CLASS.parse` with the text of the value's file.
pub fn unpickled<'py>(py: Python<'py>, class: &str, json: &Json) -> PyResult<Bound<'py, PyAny>> {
    let parse = py.import("pushplan")?.getattr(class)?.getattr("parse")?;
    let text =
        serde_json::to_string(json).map_err(|error| PyValueError::new_err(error.to_string()));
    Ok((parse, (text?,)).into_pyobject(py)?.into_any())
}

/// Parses the JSON object stored by pickle.
pub fn kept(text: &str) -> PyResult<Json> {
    serde_json::from_str(text).map_err(damaged)
}

/// Converts the error of damaged pickle data.
pub fn damaged(error: serde_json::Error) -> PyErr {
    PyValueError::new_err(error.to_string())
}

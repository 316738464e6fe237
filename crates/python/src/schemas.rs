//! JSON schemas of the files, which also apply to mappings.

use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::json::dict;

/// The JSON schema (draft 2020-12) of tool files and of what `Tool.from_dict` takes.
#[pyfunction]
pub fn tool_schema(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    dict(py, &pushplan::asset::tool_schema())
}

/// The JSON schema (draft 2020-12) of task files and of what `Task.from_dict` takes.
#[pyfunction]
pub fn task_schema(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    dict(py, &pushplan::asset::task_schema())
}

/// The JSON schema (draft 2020-12) of recordings and of what `Recording.from_dict` takes.
#[pyfunction]
pub fn recording_schema(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    dict(py, &pushplan::asset::recording_schema())
}

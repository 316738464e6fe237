//! JSON schemas of files and mappings.

use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::json::dict;

/// Returns the JSON schema (draft 2020-12) of tool files and of mappings for `Tool.from_dict`.
///
/// Examples
/// --------
/// >>> keys = pushplan.tool_schema()["properties"]
#[pyfunction]
pub fn tool_schema(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    dict(py, &pushplan::files::tool_schema())
}

/// Returns the JSON schema (draft 2020-12) of task files and of mappings for `Task.from_dict`.
///
/// Examples
/// --------
/// >>> keys = pushplan.task_schema()["properties"]
#[pyfunction]
pub fn task_schema(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    dict(py, &pushplan::files::task_schema())
}

/// Returns the JSON schema (draft 2020-12) of recordings and of mappings for `Recording.from_dict`.
///
/// Examples
/// --------
/// >>> keys = pushplan.recording_schema()["properties"]
#[pyfunction]
pub fn recording_schema(py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
    dict(py, &pushplan::files::recording_schema())
}

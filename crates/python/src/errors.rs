//! Conversion of library errors to the exceptions of `pushplan.errors`.

use pushplan::files::Faults;
use pushplan::models::ModelError;
use pushplan::{SolveError, Warning};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// Creates the exception `name` of `pushplan.errors` with `arguments`.
fn raise<'py>(py: Python<'py>, name: &str, arguments: impl pyo3::call::PyCallArgs<'py>) -> PyErr {
    let made = py
        .import("pushplan.errors")
        .and_then(|module| module.getattr(name))
        .and_then(|class| class.call1(arguments));
    made.map_or_else(|error| error, PyErr::from_value)
}

/// Converts faults of a file or text; for a mapping, `keys` holds the key of every line of its
/// text.
pub fn files(py: Python<'_>, faults: &Faults, keys: Option<&[String]>) -> PyErr {
    let fault = |fault: &pushplan::files::Fault| -> PyResult<Py<PyAny>> {
        let class = py.import("pushplan.errors")?.getattr("Fault")?;
        let (line, column, key) = match keys {
            None => (fault.place.map(|at| at.line), fault.place.map(|at| at.column), None),
            Some(keys) => {
                let line = fault.place.map_or(0, |at| at.line.saturating_sub(1));
                (None, None, keys.get(line).cloned().filter(|_| fault.place.is_some()))
            }
        };
        let made = class.call1((&fault.file, line, column, key, &fault.message, &fault.advice))?;
        Ok(made.unbind())
    };
    let faults: PyResult<Vec<Py<PyAny>>> = faults.0.iter().map(fault).collect();
    match faults.and_then(|faults| PyTuple::new(py, faults)) {
        Ok(faults) => raise(py, "FileError", (faults,)),
        Err(error) => error,
    }
}

/// Converts the error of a task that cannot be attempted.
pub fn solve(py: Python<'_>, error: &SolveError) -> PyErr {
    match error {
        SolveError::Tools(faults) => files(py, faults, None),
        SolveError::BadTask { .. } => raise(py, "TaskError", (error.to_string(),)),
        SolveError::Refused { warnings, .. } => refused(py, &error.to_string(), warnings),
        SolveError::Model(error) => model(py, error),
    }
}

/// Converts the refusal of a model.
pub fn refused(py: Python<'_>, message: &str, warnings: &[Warning]) -> PyErr {
    let warnings: Vec<String> = warnings.iter().map(Warning::to_string).collect();
    match PyTuple::new(py, warnings) {
        Ok(warnings) => raise(py, "RefusedError", (message, warnings)),
        Err(error) => error,
    }
}

/// Converts the error of a model that cannot be created.
pub fn model(py: Python<'_>, error: &ModelError) -> PyErr {
    raise(py, "ModelError", (error.to_string(),))
}

/// Converts the error of a text that names no model.
pub fn spec(py: Python<'_>, error: &pushplan::models::SpecError) -> PyErr {
    raise(py, "ModelError", (error.to_string(),))
}

/// Converts the error of pushes that cannot be executed.
pub fn action(py: Python<'_>, message: &str) -> PyErr {
    raise(py, "ActionError", (message,))
}

/// Converts the unknown name of a tool.
pub fn unknown_tool(py: Python<'_>, message: &str) -> PyErr {
    raise(py, "UnknownToolError", (message,))
}

//! Entry point of the command, called from Python.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs a command line, the program's name first, and gives its exit code. From here on Ctrl-C is the
/// command's.
#[pyfunction]
pub fn main(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| pushplan_command::run(arguments))
}

//! Entry point of the command, called from Python.

use std::ffi::OsString;

use pyo3::prelude::*;

/// Runs a command line and returns its exit code. The first argument is the program's name. Ctrl-C
/// is then handled by the command.
#[pyfunction]
pub fn main(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
    py.detach(|| pushplan_command::run(arguments))
}

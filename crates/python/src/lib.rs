//! Python package `pushplan`: the library with NumPy arrays, exceptions and notebook support.
//!
//! This is a thin layer; all computation, decisions and texts are in the library. Arguments are
//! converted to the library's types (`mapping`, `arguments`, `wanted`, `push`, `arrays`). Long work
//! runs without the GIL, stops at Ctrl-C and reports its progress (`work`, `progress`). Results
//! become attributes with units. The Python side, `crates/python/pushplan`, holds the code that is
//! simpler in Python: exceptions, types of files, the Gymnasium environments.

use pyo3::prelude::*;

mod arguments;
mod arrays;
mod belief;
mod command;
mod design;
mod errors;
mod formats;
mod json;
mod mapping;
mod moved;
mod page;
mod plan;
mod plan_file;
mod predict;
mod progress;
mod push;
mod rollouts;
mod run;
mod schemas;
mod solution;
mod solve;
mod table_fit;
mod task;
mod task_poses;
mod tool;
mod trajectory;
mod verdict;
mod verify;
mod wanted;
mod work;
mod world;

#[pymodule]
mod _native {
    use pyo3::prelude::*;

    #[pymodule_export]
    use super::belief::{PyBelief, PyRecording, infer};
    #[pymodule_export]
    use super::command::main;
    #[pymodule_export]
    use super::design::{PyDesign, design};
    #[pymodule_export]
    use super::formats::{allow_files_in, export_mcap, export_mjcf, import_task, import_tool};
    #[pymodule_export]
    use super::plan::PyPlan;
    #[pymodule_export]
    use super::predict::predict;
    #[pymodule_export]
    use super::push::PyPush;
    #[pymodule_export]
    use super::rollouts::{Rollouts, rollout};
    #[pymodule_export]
    use super::run::{PyRun, run};
    #[pymodule_export]
    use super::schemas::{recording_schema, task_schema, tool_schema};
    #[pymodule_export]
    use super::solution::PySolution;
    #[pymodule_export]
    use super::solve::{solve, solve_all};
    #[pymodule_export]
    use super::table_fit::{PyTableFit, fit};
    #[pymodule_export]
    use super::task::PyTask;
    #[pymodule_export]
    use super::tool::{PyTool, PyToolLibrary};
    #[pymodule_export]
    use super::trajectory::PyTrajectory;
    #[pymodule_export]
    use super::verdict::{PyReplay, PyVerdict};
    #[pymodule_export]
    use super::verify::verify;
    #[pymodule_export]
    use super::world::PyMotion;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        pushplan_arm::install();
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}

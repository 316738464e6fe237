//! Tools and tool libraries.

use std::path::PathBuf;
use std::sync::Arc;

use pushplan::files::Faults;
use pushplan::{Tool, ToolLibrary};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::arguments::found;
use crate::json::{dict, unpickled};
use crate::mapping::Text;
use crate::wanted::no_constructor;
use crate::{errors, wanted};

/// Rigid tool of upright solids, which the end effector holds at its grip.
///
/// Instances come from `Tool.load`, `Tool.parse`, `Tool.from_dict` and `ToolLibrary`. Two tools are
/// equal if all their values are equal.
#[pyclass(name = "Tool", module = "pushplan", frozen, eq)]
#[derive(PartialEq)]
pub struct PyTool(pub Arc<Tool>);

#[pymethods]
impl PyTool {
    #[new]
    #[pyo3(signature = (*_arguments, **_named))]
    fn new(_arguments: &Bound<'_, PyAny>, _named: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        Err(no_constructor(
            "Tool",
            "read a file with `Tool.load(path)`, take one from `ToolLibrary.shipped()[name]`, or \
             build one with `Tool.from_dict(mapping)`",
        ))
    }

    /// Reads a tool file (YAML).
    ///
    /// Parameters
    /// ----------
    /// path : str or path-like
    ///     Tool file.
    ///
    /// Returns
    /// -------
    /// Tool
    ///     Tool of the file.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the file is unreadable or invalid; it lists all faults.
    ///
    /// Examples
    /// --------
    /// >>> tool = pushplan.Tool.load("my-hook.yaml")
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        read(py, Tool::load(path))
    }

    /// Reads the text of a tool file.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     Content of the file (YAML).
    /// name : str, default "tool"
    ///     File name in error messages.
    ///
    /// Returns
    /// -------
    /// Tool
    ///     Tool of the text.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the text is invalid; it lists all faults.
    ///
    /// Examples
    /// --------
    /// >>> part = "{name: bar, size: [0.2, 0.04, 0.05], position: [0.1, 0]}"
    /// >>> tool = pushplan.Tool.parse(f"{{name: rod, friction: 0.4, parts: [{part}]}}")
    #[staticmethod]
    #[pyo3(signature = (text, name = "tool"))]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        read(py, Tool::parse(text, name))
    }

    /// Builds a tool from a mapping with the keys of a tool file.
    ///
    /// Parameters
    /// ----------
    /// mapping : pushplan.files.ToolFile
    ///     Mapping with lengths in metres and angles in degrees. NumPy arrays count as lists.
    ///
    /// Returns
    /// -------
    /// Tool
    ///     Tool of the mapping.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If a value is invalid; it lists all faults with their keys.
    /// TypeError
    ///     If the mapping contains other types than a file.
    ///
    /// Examples
    /// --------
    /// >>> bar = {"name": "bar", "size": [0.2, 0.04, 0.05], "position": [0.1, 0]}
    /// >>> tool = pushplan.Tool.from_dict({"name": "rod", "friction": 0.4, "parts": [bar]})
    #[staticmethod]
    fn from_dict(py: Python<'_>, mapping: &Bound<'_, PyAny>) -> PyResult<Self> {
        Ok(Self(Arc::new(Text::of(mapping)?.read(py, "tool", Tool::parse)?)))
    }

    /// Name of the tool, unique in a library.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Description for people, one line; may be empty.
    #[getter]
    fn description(&self) -> &str {
        &self.0.description
    }

    /// Friction value; the friction coefficient of a pair is the mean of its two values.
    #[getter]
    fn friction(&self) -> f64 {
        self.0.friction
    }

    /// Pose of the end effector in the tool frame: x and y in metres, heading in radians.
    #[getter]
    fn grip(&self) -> (f64, f64, f64) {
        let grip = self.0.grip;
        (grip.position.x, grip.position.y, grip.heading)
    }

    /// Returns the tool with the keys of a tool file, for `Tool.from_dict`.
    ///
    /// Examples
    /// --------
    /// >>> copy = {**tool.to_dict(), "name": "smooth-hook", "friction": 0.2}
    /// >>> tools = pushplan.ToolLibrary.shipped().with_tool(pushplan.Tool.from_dict(copy))
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        dict(py, &self.0.to_json())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        unpickled(py, "Tool", &self.0.to_json())
    }

    fn __repr__(&self) -> String {
        format!("<Tool {}>", self.0.name)
    }
}

fn read(py: Python<'_>, tool: Result<Tool, Faults>) -> PyResult<PyTool> {
    let tool = tool.map_err(|faults| errors::files(py, &faults, None))?;
    Ok(PyTool(Arc::new(tool)))
}

/// Collection of tools with unique names, sorted by name.
///
/// `library[name]` returns a tool, and `name in library` checks for one.
#[pyclass(name = "ToolLibrary", module = "pushplan", frozen)]
pub struct PyToolLibrary(pub ToolLibrary);

#[pymethods]
impl PyToolLibrary {
    #[new]
    #[pyo3(signature = (*_arguments, **_named))]
    fn new(_arguments: &Bound<'_, PyAny>, _named: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        Err(no_constructor(
            "ToolLibrary",
            "use `ToolLibrary.shipped()`, `ToolLibrary.load(folder)` or `ToolLibrary.of(tools)`",
        ))
    }

    /// Returns the tools shipped with the package.
    ///
    /// Examples
    /// --------
    /// >>> hook = pushplan.ToolLibrary.shipped()["hook"]
    #[staticmethod]
    fn shipped(py: Python<'_>) -> PyResult<Self> {
        library(py, ToolLibrary::embedded())
    }

    /// Reads every tool file (`.yaml`, `.yml`) of a folder.
    ///
    /// Parameters
    /// ----------
    /// folder : str or path-like
    ///     Folder with one file or more.
    ///
    /// Returns
    /// -------
    /// ToolLibrary
    ///     Tools of the folder.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If a file is unreadable or invalid; it lists all faults of all files.
    ///
    /// Examples
    /// --------
    /// >>> tools = pushplan.ToolLibrary.load("my-tools")
    #[staticmethod]
    fn load(py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        library(py, ToolLibrary::load(folder))
    }

    /// Returns a library of the given tools.
    ///
    /// Parameters
    /// ----------
    /// tools : sequence of Tool
    ///     Tools with different names.
    ///
    /// Returns
    /// -------
    /// ToolLibrary
    ///     Library of these tools only.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If two tools have the same name.
    ///
    /// Examples
    /// --------
    /// >>> shipped = pushplan.ToolLibrary.shipped()
    /// >>> few = pushplan.ToolLibrary.of([shipped["hook"], shipped["stick"]])
    #[staticmethod]
    fn of(
        py: Python<'_>,
        #[pyo3(from_py_with = wanted::list_of_tools)] tools: Vec<Py<PyTool>>,
    ) -> PyResult<Self> {
        let add = |library: ToolLibrary, tool: &Py<PyTool>| library.with(tool.get().0.clone());
        library(py, tools.iter().try_fold(ToolLibrary::default(), add))
    }

    /// Returns a library that also contains a tool, in place of a tool of the same name.
    ///
    /// Parameters
    /// ----------
    /// tool : Tool
    ///     Tool to add.
    ///
    /// Returns
    /// -------
    /// ToolLibrary
    ///     New library; this one does not change.
    ///
    /// Examples
    /// --------
    /// >>> tools = pushplan.ToolLibrary.shipped().with_tool(tool)
    /// >>> solution = pushplan.solve(task, tools, effort="draft")
    fn with_tool(
        &self,
        py: Python<'_>,
        #[pyo3(from_py_with = wanted::tool)] tool: Py<PyTool>,
    ) -> PyResult<Self> {
        let tool = &tool.get().0;
        let others = self.all().filter(|other| other.name != tool.name);
        let add = |library: ToolLibrary, tool: &Arc<Tool>| library.with(Arc::clone(tool));
        library(py, others.chain([tool]).try_fold(ToolLibrary::default(), add))
    }

    /// Returns a library that also contains the tools of a folder, in place of tools of the same
    /// names.
    ///
    /// Parameters
    /// ----------
    /// folder : str or path-like
    ///     Folder with one tool file or more.
    ///
    /// Returns
    /// -------
    /// ToolLibrary
    ///     New library; this one does not change.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If a file is invalid, or two files have a tool of the same name.
    ///
    /// Examples
    /// --------
    /// >>> tools = pushplan.ToolLibrary.shipped().with_folder("my-tools")
    fn with_folder(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Self> {
        library(py, self.0.clone().with_folder(folder))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let of = py.import("pushplan")?.getattr("ToolLibrary")?.getattr("of")?;
        let tools = self.all().map(|tool| Py::new(py, PyTool(Arc::clone(tool))));
        let tools: Vec<Py<PyTool>> = tools.collect::<PyResult<_>>()?;
        Ok((of, (tools,)).into_pyobject(py)?.into_any())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.all().eq(other.all())
    }

    /// Names of the tools that push, sorted. Tools with a blade are found by their names.
    #[getter]
    fn names(&self) -> Vec<&str> {
        self.0.iter().map(|tool| tool.name.as_str()).collect()
    }

    fn __getitem__(&self, py: Python<'_>, name: &str) -> PyResult<PyTool> {
        let found = self.0.get(name).cloned().map(PyTool);
        found.ok_or_else(|| errors::unknown_tool(py, &unknown(name, &self.0)))
    }

    fn __contains__(&self, name: &str) -> bool {
        self.0.get(name).is_some()
    }

    fn __len__(&self) -> usize {
        self.0.len()
    }

    fn __repr__(&self) -> String {
        format!("<ToolLibrary {}>", self.names().join(", "))
    }
}

impl PyToolLibrary {
    /// Iterates over all tools, tools with a blade last.
    fn all(&self) -> impl Iterator<Item = &Arc<Tool>> {
        self.0.iter().chain(self.0.blades())
    }
}

fn library(py: Python<'_>, library: Result<ToolLibrary, Faults>) -> PyResult<PyToolLibrary> {
    library.map(PyToolLibrary).map_err(|faults| errors::files(py, &faults, None))
}

/// Returns the caller's tools, or the tools shipped with the package.
pub fn given(py: Python<'_>, tools: Option<&Py<PyToolLibrary>>) -> PyResult<ToolLibrary> {
    match tools {
        Some(tools) => Ok(tools.get().0.clone()),
        None => Ok(PyToolLibrary::shipped(py)?.0),
    }
}

/// Returns a tool, given directly or by its name in `tools`.
pub fn tool(
    py: Python<'_>,
    tool: &Bound<'_, PyAny>,
    tools: Option<&Py<PyToolLibrary>>,
) -> PyResult<Arc<Tool>> {
    if let Ok(tool) = tool.cast::<PyTool>() {
        return Ok(tool.get().0.clone());
    }
    let Ok(name) = tool.extract::<String>() else {
        return Err(PyTypeError::new_err(format!(
            "`tool` must be a `pushplan.Tool` or the name of one, found {}; build one with \
             `pushplan.Tool.from_dict`",
            found(tool)
        )));
    };
    let library = given(py, tools)?;
    let found = library.get(&name).cloned();
    found.ok_or_else(|| errors::unknown_tool(py, &unknown(&name, &library)))
}

fn unknown(name: &str, library: &ToolLibrary) -> String {
    let names: Vec<&str> = library.iter().map(|tool| tool.name.as_str()).collect();
    format!("no tool is called `{name}`; use one of {}", names.join(", "))
}

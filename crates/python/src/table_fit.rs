//! Table fits from pushes recorded on a table.

use std::path::PathBuf;

use pushplan::TableFit;
use pushplan::models::{Network, Prior};
use pushplan::progress::NoProgress;
use pushplan_act::fit::{Basis, FitSettings, HeadSettings, learn};
use pushplan_act::judge::Trial;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::belief::PyRecording;
use crate::{arguments, errors, json, wanted, work};

/// Table fit: friction, support and a change of the network's last layer, from recordings of one
/// table. It is an argument of `solve` and `run`, and a result of `fit` and `run`.
#[pyclass(name = "TableFit", module = "pushplan", frozen)]
pub struct PyTableFit(pub TableFit);

#[pymethods]
impl PyTableFit {
    /// Reads a table fit.
    ///
    /// Parameters
    /// ----------
    /// path : str or path-like
    ///     File that `save` or the command `pushplan fit --save-fit` wrote.
    ///
    /// Returns
    /// -------
    /// TableFit
    ///     Table fit of the file.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the file is unreadable or invalid.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        TableFit::load(path).map(Self).map_err(|faults| errors::files(py, &faults, None))
    }

    /// Writes the table fit (JSON).
    ///
    /// The file is replaced as a whole, so that no partial file remains after an error.
    ///
    /// Parameters
    /// ----------
    /// path : str or path-like
    ///     File to write, in an existing folder.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the file cannot be written.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.0.write(path).map_err(|faults| errors::files(py, &faults, None))
    }

    /// Restores a table fit from the text that pickle stores.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Self> {
        serde_json::from_str(text).map(Self).map_err(json::damaged)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let kept = serde_json::to_value(&self.0);
        let kept = kept.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        json::unpickled(py, "TableFit", &kept)
    }

    /// Number of recorded pushes of the fit.
    #[getter]
    fn pushes(&self) -> usize {
        self.0.pushes
    }

    /// Names of the pushed objects.
    #[getter]
    fn objects(&self) -> Vec<&str> {
        self.0.objects.iter().map(|object| object.name.as_str()).collect()
    }

    /// Friction coefficient of tool and objects; `None` if the recordings do not determine it.
    #[getter]
    fn friction(&self) -> Option<f64> {
        self.0.friction
    }

    /// Support of the objects as a share of the corners' distance; `None` if the recordings do not
    /// determine it.
    #[getter]
    fn support(&self) -> Option<f64> {
        self.0.support
    }

    /// Scale of the residual errors, metres.
    #[getter]
    fn noise(&self) -> f64 {
        self.0.noise
    }

    /// Whether the fit changes the network's last layer.
    #[getter]
    fn changes_network(&self) -> bool {
        self.0.head.iter().any(|value| *value != 0.0)
    }

    /// Returns the table fit with the keys of its file.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::text(py, &self.0.to_json())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.0 == other.0
    }

    fn __repr__(&self) -> String {
        format!("<TableFit of {} pushes of {}>", self.0.pushes, self.objects().join(", "))
    }
}

/// Fits friction, support and the network's last layer to recorded pushes.
///
/// Fifty or more pushes of one object give the best results.
///
/// Parameters
/// ----------
/// recordings : sequence of Recording
///     Recordings of one table.
/// threads : int, default 0
///     Number of worker threads; 0 means one per core.
///
/// Returns
/// -------
/// TableFit
///     Fit for `solve` and `run`.
///
/// Raises
/// ------
/// TypeError or ValueError
///     If an argument is invalid, or no object moves in the recordings.
///
/// Examples
/// --------
/// >>> recordings = [pushplan.Recording.load("pushes.json")]
/// >>> solution = pushplan.solve(task, fit=pushplan.fit(recordings), effort="draft")
#[pyfunction]
#[pyo3(signature = (recordings, *, threads = 0))]
pub fn fit(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::recordings)] recordings: Vec<Py<PyRecording>>,
    #[pyo3(from_py_with = arguments::threads)] threads: usize,
) -> PyResult<PyTableFit> {
    let network = Network::shipped().map_err(|error| errors::model(py, &error))?;
    let trials: Vec<Trial> =
        recordings.iter().map(|one| Trial::of_recording(&one.get().0)).collect();
    let learnt = work::run(py, threads, |_| {
        let settings = FitSettings::default();
        let found = pushplan_act::fit::fit(&Prior::default(), &trials, &settings, &NoProgress)?;
        Some(learn(&network, &trials, &Basis::from(&found), &HeadSettings::default()))
    })?;
    match learnt {
        Some(Ok(fit)) => Ok(PyTableFit(fit)),
        Some(Err(error)) => Err(PyRuntimeError::new_err(error.to_string())),
        None => Err(PyValueError::new_err(
            "no object moves in `recordings`; pass recordings of pushes that move an object",
        )),
    }
}

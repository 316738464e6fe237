//! Table fits, learnt from pushes recorded on a table.

use std::path::PathBuf;

use pushplan::TableFit;
use pushplan::effect::{EffectModels, Network, Prior};
use pushplan::progress::NoProgress;
use pushplan_act::fit::{Basis, FitSettings, HeadSettings, learn};
use pushplan_act::judge::Trial;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::belief::PyRecording;
use crate::{arguments, errors, json, work};

/// What recordings of one table taught: how things rub and rest, and a change of the network's last
/// layer. `solve` and `run` take it.
#[pyclass(name = "TableFit", module = "pushplan", frozen)]
pub struct PyTableFit(pub TableFit);

#[pymethods]
impl PyTableFit {
    /// Reads a file that `save` or `pushplan fit --save-fit` wrote. Raises `FileError`.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        TableFit::load(path).map(Self).map_err(|faults| errors::files(py, &faults, None))
    }

    /// Writes the file; a partial one is never left behind.
    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        self.0.write(path).map_err(|faults| errors::files(py, &faults, None))
    }

    /// Reads what pickle keeps.
    #[staticmethod]
    fn parse(text: &str) -> PyResult<Self> {
        serde_json::from_str(text).map(Self).map_err(json::damaged)
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let kept = serde_json::to_value(&self.0);
        let kept = kept.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
        json::unpickled(py, "TableFit", &kept)
    }

    /// Number of pushes that taught it.
    #[getter]
    fn pushes(&self) -> usize {
        self.0.pushes
    }

    /// Names of the objects that were pushed.
    #[getter]
    fn objects(&self) -> Vec<&str> {
        self.0.objects.iter().map(|object| object.name.as_str()).collect()
    }

    /// Coefficient of friction of tool and objects, where recordings tell it.
    #[getter]
    fn friction(&self) -> Option<f64> {
        self.0.friction
    }

    /// Share of the corners' distance at which objects rest, where recordings tell it.
    #[getter]
    fn support(&self) -> Option<f64> {
        self.0.support
    }

    /// Width of what nothing explains, metres.
    #[getter]
    fn noise(&self) -> f64 {
        self.0.noise
    }

    /// Whether the network's last layer was changed.
    #[getter]
    fn changes_network(&self) -> bool {
        self.0.head.iter().any(|value| *value != 0.0)
    }

    /// The keys of its file.
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

/// Learns from recorded pushes, best fifty or more of one object, how it rests on the table and rubs on
/// the pusher, and lets the shipped network learn what these numbers leave.
#[pyfunction]
#[pyo3(signature = (recordings, *, threads = 0))]
pub fn fit(
    py: Python<'_>,
    recordings: Vec<Py<PyRecording>>,
    threads: usize,
) -> PyResult<PyTableFit> {
    let weights = EffectModels::weights().map_err(|error| errors::model(py, &error))?;
    let network = Network::new(weights);
    let trials: Vec<Trial> =
        recordings.iter().map(|one| Trial::of_recording(&one.get().0)).collect();
    let learnt = work::run(py, arguments::threads(threads)?, |_| {
        let settings = FitSettings::default();
        let found = pushplan_act::fit::fit(&Prior::default(), &trials, &settings, &NoProgress)?;
        Some(learn(&network, &trials, &Basis::from(&found), &HeadSettings::default()))
    })?;
    match learnt {
        Some(Ok(fit)) => Ok(PyTableFit(fit)),
        Some(Err(error)) => Err(PyRuntimeError::new_err(error.to_string())),
        None => Err(PyValueError::new_err("nothing moves in these recordings")),
    }
}

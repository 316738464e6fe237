//! Recordings, and beliefs about joints inferred from them.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyArray3};
use pushplan::progress::Progress;
use pushplan::recording::Recording;
use pushplan::{
    scene::{Span, Velocity},
    task::Noise,
};
use pushplan_act::belief::{Belief, BeliefRegulator, BeliefSettings};
use pushplan_report::belief_document;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::mapping::Text;
use crate::{arguments, arrays, errors, json, work};

/// What happened on a table: a scene and the poses of pusher and objects frame by frame.
#[pyclass(name = "Recording", module = "pushplan", frozen)]
pub struct PyRecording(pub Recording);

#[pymethods]
impl PyRecording {
    /// Reads a recording (YAML, or JSON if the file's name ends so). Raises `FileError` with all its
    /// faults.
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Recording::load(path).map(Self).map_err(|faults| errors::files(py, &faults, None))
    }

    /// Reads the text of a recording; `name` names it in faults, and means JSON if it ends in
    /// `.json`.
    #[staticmethod]
    #[pyo3(signature = (text, name = "recording"))]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        Recording::parse(text, name).map(Self).map_err(|faults| errors::files(py, &faults, None))
    }

    /// Builds a recording from a mapping with the keys of a recording file; arrays are taken as
    /// lists.
    #[staticmethod]
    fn from_dict(py: Python<'_>, mapping: &Bound<'_, PyAny>) -> PyResult<Self> {
        Text::of(mapping)?.read(py, "recording", Recording::parse).map(Self)
    }

    /// Its name.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Names of the objects; arrays of poses are in this order.
    #[getter]
    fn objects(&self) -> Vec<&str> {
        self.0.scene.objects.iter().map(|object| object.name.as_str()).collect()
    }

    /// Time of every frame since the first, seconds: `[frames]`.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_vec(py, self.0.frames.iter().map(|frame| frame.time).collect())
    }

    /// Poses of the objects, `[frames, objects, 3]`: x and y in metres, heading in radians.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray3<f64>>> {
        let poses = self.0.frames.iter().flat_map(|frame| &frame.poses);
        let shape = [self.0.frames.len(), self.0.scene.objects.len(), 3];
        arrays::array(py, poses.flat_map(arrays::numbers).collect(), shape)
    }

    /// Velocities of the objects in the first frame, `[objects, 3]`: x and y in m/s, turn in rad/s.
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let numbers = |own: &Velocity| [own.linear.x, own.linear.y, own.angular];
        let velocities = &self.0.velocities;
        arrays::array(py, velocities.iter().flat_map(numbers).collect(), [velocities.len(), 3])
    }

    fn __len__(&self) -> usize {
        self.0.frames.len()
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let parse = py.get_type::<Self>().getattr("parse")?;
        // Long recordings exceed the size limit of YAML texts, so JSON is used.
        let words = (self.0.to_json().to_string(), "recording.json");
        Ok((parse, words).into_pyobject(py)?.into_any())
    }

    fn __repr__(&self) -> String {
        format!("<Recording {} of {} frames>", self.0.name, self.0.frames.len())
    }
}

/// Which objects are joined, by which joints, and how sure that is.
#[pyclass(name = "Belief", module = "pushplan", frozen)]
pub struct PyBelief {
    name: String,
    objects: Vec<String>,
    ranges: Vec<Span>,
    belief: Belief,
}

#[pymethods]
impl PyBelief {
    /// The types of joints, in the order of `probabilities`.
    #[classattr]
    #[allow(non_upper_case_globals)] // an attribute in Python
    const joint_types: (&'static str, &'static str, &'static str, &'static str) =
        ("none", "fixed", "revolute", "prismatic");

    /// Pairs of objects that stood within 3 cm of each other at the start, by name; others are taken
    /// to be free of each other.
    #[getter]
    fn pairs(&self) -> Vec<(String, String)> {
        let name = |object: usize| self.objects[object].clone();
        self.belief.pairs().map(|[a, b]| (name(a), name(b))).collect()
    }

    /// Probabilities of `joint_types` for every pair: `[pairs, 4]`.
    #[getter]
    fn probabilities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows = self.belief.probabilities();
        let shape = [rows.len(), 4];
        arrays::array(py, rows.into_iter().flatten().collect(), shape)
    }

    /// The scene as it is believed to be at the end, with the likeliest joints: the keys of a task
    /// file's `scene`.
    fn scene<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let situation = self.belief.situation();
        let mut scene = (*situation.scene).clone();
        scene.joints = situation.physics.joints.clone();
        json::dict(py, &scene.to_json())
    }

    /// Everything, in the keys of `pushplan infer --json`.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        json::text(py, &self.document().to_json())
    }

    fn __str__(&self) -> String {
        self.document().to_text()
    }

    fn __repr__(&self) -> String {
        format!("<Belief from {} about {} pairs>", self.name, self.belief.pairs().len())
    }
}

impl PyBelief {
    fn document(&self) -> pushplan_report::Document {
        let names: Vec<&str> = self.objects.iter().map(String::as_str).collect();
        belief_document(&self.name, &self.belief, &names, &self.ranges)
    }
}

/// Returns the belief regulator shipped with the package.
pub fn shipped_regulator() -> PyResult<BeliefRegulator> {
    BeliefRegulator::shipped()
        .map_err(|error| PyRuntimeError::new_err(format!("the shipped regulator: {error}")))
}

/// Infers from a recording which objects are joined, and by which joints.
///
/// `model` rolls hypotheses out; `noise` (metres) and `heading_noise` (radians) are the standard
/// deviations of what was recorded. Joints that the recording states are ignored. With
/// `mass_ranges`, pairs of kilograms, lightest first, it also tells which of them every mass is in,
/// of objects that another object touched; masses that the recording states are then ignored.
#[pyfunction]
#[pyo3(signature = (
    recording, *, model = "prior", noise = 1e-3, heading_noise = 0.01, mass_ranges = None, threads = 0
))]
pub fn infer(
    py: Python<'_>,
    recording: &PyRecording,
    model: &str,
    noise: f64,
    heading_noise: f64,
    mass_ranges: Option<Vec<(f64, f64)>>,
    threads: usize,
) -> PyResult<PyBelief> {
    if ![noise, heading_noise].iter().all(|value| (0.0..=0.5).contains(value)) {
        return Err(PyValueError::new_err("`noise` and `heading_noise` are 0 to 0.5"));
    }
    let mass_ranges = mass_ranges.unwrap_or_default();
    let sound = |(low, high): &(f64, f64)| 1e-3 <= *low && low < high && *high <= 1e3;
    if !mass_ranges.iter().all(sound) {
        return Err(PyValueError::new_err(
            "`mass_ranges` are pairs that rise, from 0.001 kg to 1000 kg: (0.2, 0.5)",
        ));
    }
    let ranges: Vec<Span> = mass_ranges.iter().map(|(low, high)| Span::new(*low, *high)).collect();
    let model = arguments::model(py, model, Default::default())?;
    let regulator = shipped_regulator()?;
    let recording = &recording.0;
    let settings = BeliefSettings::new(Noise { position: noise, heading: heading_noise });
    let belief = work::run(py, arguments::threads(threads)?, |cancel| {
        let (tool, lift) = (recording.tool.clone(), recording.lift);
        let mut belief = Belief::new(&recording.scene, tool, lift, settings)
            .moving(&recording.velocities)
            .with_mass_ranges(&ranges)
            .regulated(regulator);
        for observation in recording.observations() {
            if cancel.cancelled() {
                break;
            }
            belief.update(&model, observation);
        }
        belief.finish(&model);
        belief
    })?;
    let objects = recording.scene.objects.iter().map(|object| object.name.clone()).collect();
    Ok(PyBelief { name: recording.name.clone(), objects, ranges, belief })
}

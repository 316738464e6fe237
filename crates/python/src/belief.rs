//! Recordings, and beliefs about joints from recordings.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyArray3};
use pushplan::Noise;
use pushplan::progress::Progress;
use pushplan::recordings::Recording;
use pushplan::scenes::{Span, Velocity};
use pushplan_act::belief::{Belief, BeliefRegulator, BeliefSettings};
use pushplan_report::belief_document;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyAny;

use crate::mapping::Text;
use crate::{arguments, arrays, errors, json, wanted, work};

/// Recording of one scene: poses of pusher and objects, frame by frame.
#[pyclass(name = "Recording", module = "pushplan", frozen)]
pub struct PyRecording(pub Recording);

#[pymethods]
impl PyRecording {
    #[new]
    #[pyo3(signature = (*_arguments, **_named))]
    fn new(_arguments: &Bound<'_, PyAny>, _named: Option<&Bound<'_, PyAny>>) -> PyResult<Self> {
        let remedy = "read a file with `Recording.load(path)`, or a log with `pushplan.logs`";
        Err(wanted::no_constructor("Recording", remedy))
    }

    /// Reads a recording file (YAML, or JSON if the name ends in `.json`).
    ///
    /// Parameters
    /// ----------
    /// path : str or path-like
    ///     Recording file.
    ///
    /// Returns
    /// -------
    /// Recording
    ///     Recording of the file.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the file is unreadable or invalid; it lists all faults.
    ///
    /// Examples
    /// --------
    /// >>> recording = pushplan.Recording.load("pushes.json")
    #[staticmethod]
    fn load(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        Recording::load(path).map(Self).map_err(|faults| errors::files(py, &faults, None))
    }

    /// Reads the text of a recording file.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     Content of the file (YAML, or JSON if `name` ends in `.json`).
    /// name : str, default "recording"
    ///     File name in error messages.
    ///
    /// Returns
    /// -------
    /// Recording
    ///     Recording of the text.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the text is invalid; it lists all faults.
    #[staticmethod]
    #[pyo3(signature = (text, name = "recording"))]
    fn parse(py: Python<'_>, text: &str, name: &str) -> PyResult<Self> {
        Recording::parse(text, name).map(Self).map_err(|faults| errors::files(py, &faults, None))
    }

    /// Builds a recording from a mapping with the keys of a recording file.
    ///
    /// Parameters
    /// ----------
    /// mapping : dict
    ///     Mapping with the keys of `recording_schema`. NumPy arrays count as lists.
    ///
    /// Returns
    /// -------
    /// Recording
    ///     Recording of the mapping.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If a value is invalid; it lists all faults with their keys.
    /// TypeError
    ///     If the mapping contains other types than a file.
    #[staticmethod]
    fn from_dict(py: Python<'_>, mapping: &Bound<'_, PyAny>) -> PyResult<Self> {
        Text::of(mapping)?.read(py, "recording", Recording::parse).map(Self)
    }

    /// Name of the recording.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Names of the objects, in the order of arrays of poses.
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

    /// Velocities of the objects in the first frame, `[objects, 3]`: x and y in m/s, rotation in
    /// rad/s.
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

/// Belief about joints between objects: probabilities of the joint types of every pair.
#[pyclass(name = "Belief", module = "pushplan", frozen)]
pub struct PyBelief {
    name: String,
    objects: Vec<String>,
    ranges: Vec<Span>,
    belief: Belief,
}

#[pymethods]
impl PyBelief {
    /// Types of joints, in the order of the columns of `probabilities`.
    #[classattr]
    #[allow(non_upper_case_globals)] // an attribute in Python
    const joint_types: (&'static str, &'static str, &'static str, &'static str) =
        ("none", "fixed", "revolute", "prismatic");

    /// Pairs of objects within 3 cm of each other at the start, by name. Other pairs are assumed to
    /// have no joint.
    #[getter]
    fn pairs(&self) -> Vec<(String, String)> {
        let name = |object: usize| self.objects[object].clone();
        self.belief.pairs().map(|[a, b]| (name(a), name(b))).collect()
    }

    /// Probabilities of `joint_types` for every pair of `pairs`: `[pairs, 4]`.
    #[getter]
    fn probabilities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let rows = self.belief.probabilities();
        let shape = [rows.len(), 4];
        arrays::array(py, rows.into_iter().flatten().collect(), shape)
    }

    /// Returns the final scene with the most probable joints, with the keys of `scene` in a task
    /// file.
    fn scene<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let situation = self.belief.situation();
        let mut scene = (*situation.scene).clone();
        scene.joints = situation.physics.joints.clone();
        json::dict(py, &scene.to_json())
    }

    /// Returns the belief with the keys of `pushplan infer --json`.
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
    BeliefRegulator::shipped().map_err(|error| {
        PyRuntimeError::new_err(format!("cannot read the shipped regulator: {error}"))
    })
}

/// Infers joints between objects, and optionally ranges of their masses, from a recording.
///
/// Joints that the recording states are ignored.
///
/// Parameters
/// ----------
/// recording : Recording
///     Recorded pushes.
/// model : str, default "prior"
///     Effect model that predicts every hypothesis; "prior" is the analytic model.
/// noise : float, default 0.001
///     Standard deviation of the recorded positions, metres, 0 to 0.5.
/// heading_noise : float, default 0.01
///     Standard deviation of the recorded headings, radians, 0 to 0.5.
/// mass_ranges : sequence of tuple of float, optional
///     Candidate ranges of masses, kg, lightest first, such as `[(0.2, 0.5), (1, 2)]`. The belief
///     then states the range of every object that another object touched, and stated masses are
///     ignored.
/// threads : int, default 0
///     Number of worker threads; 0 means one per core.
///
/// Returns
/// -------
/// Belief
///     Probabilities of the joint types of every pair, and of the mass ranges.
///
/// Raises
/// ------
/// ModelError
///     If `model` is not the name of an effect model.
/// TypeError or ValueError
///     If another argument has an invalid type or value.
///
/// Examples
/// --------
/// >>> belief = pushplan.infer(pushplan.Recording.load("pushes.json"))
/// >>> print(belief.pairs, belief.probabilities)
#[pyfunction]
#[pyo3(signature = (
    recording, *, model = "prior", noise = 1e-3, heading_noise = 0.01, mass_ranges = None,
    threads = 0
))]
pub fn infer(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::recording)] recording: Py<PyRecording>,
    model: &str,
    noise: f64,
    heading_noise: f64,
    mass_ranges: Option<Vec<(f64, f64)>>,
    #[pyo3(from_py_with = arguments::threads)] threads: usize,
) -> PyResult<PyBelief> {
    if ![noise, heading_noise].iter().all(|value| (0.0..=0.5).contains(value)) {
        let message = format!(
            "`noise` (metres) and `heading_noise` (radians) must be 0 to 0.5, found {noise} and \
             {heading_noise}"
        );
        return Err(PyValueError::new_err(message));
    }
    let mass_ranges = mass_ranges.unwrap_or_default();
    let sound = |(low, high): &(f64, f64)| 1e-3 <= *low && low < high && *high <= 1e3;
    if !mass_ranges.iter().all(sound) {
        return Err(PyValueError::new_err(
            "`mass_ranges` must be pairs of rising masses, 0.001 to 1000 kg, such as \
             (0.2, 0.5)",
        ));
    }
    let ranges: Vec<Span> = mass_ranges.iter().map(|(low, high)| Span::new(*low, *high)).collect();
    let model = arguments::model(py, model, Default::default())?;
    let regulator = shipped_regulator()?;
    let recording = &recording.get().0;
    let settings = BeliefSettings::new(Noise { position: noise, heading: heading_noise });
    let belief = work::run(py, threads, |cancel| {
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

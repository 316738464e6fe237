//! Conversion of names and numbers in arguments.

use std::fmt::Display;
use std::ops::RangeInclusive;
use std::time::Duration;

use pushplan::models::{EffectModels, Engine, Fallback, OutOfRange};
use pushplan::{Effort, ModelSpec, PlanStatus, TableFit};
use pushplan_design::DesignSettings;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt};

use crate::errors;

/// Returns the effort with this name.
pub fn effort(word: &str) -> PyResult<Effort> {
    one_of("effort", word, &Effort::ALL)
}

/// Returns the word for the status of a solution.
pub fn status(status: PlanStatus) -> &'static str {
    match status {
        PlanStatus::Solved => "solved",
        PlanStatus::Fragile => "fragile",
        PlanStatus::Partial => "partial",
        PlanStatus::NoPlan => "no_plan",
        PlanStatus::FailedVerification => "failed_verification",
    }
}

/// Returns the action for predictions outside a model's validity range.
pub fn out_of_range(word: &str) -> PyResult<OutOfRange> {
    one_of("out_of_range", word, &[OutOfRange::Warn, OutOfRange::Simulate, OutOfRange::Refuse])
}

fn one_of<T: Display + Copy>(what: &str, word: &str, all: &[T]) -> PyResult<T> {
    all.iter().find(|one| one.to_string() == word).copied().ok_or_else(|| {
        let words: Vec<String> =
            all.iter().map(|one| format!("{one:?}", one = one.to_string())).collect();
        PyValueError::new_err(format!("{what}: unknown value {word:?}; use {}", words.join(", ")))
    })
}

/// Parses the name of an effect model.
pub fn spec(py: Python<'_>, text: &str) -> PyResult<ModelSpec> {
    text.parse().map_err(|error| errors::spec(py, &error))
}

/// Returns the effect model with this name.
pub fn model(py: Python<'_>, text: &str, out_of_range: OutOfRange) -> PyResult<Fallback> {
    fitted(py, &spec(py, text)?, out_of_range, None)
}

/// Returns the effect model, adapted to a table fit if given.
pub fn fitted(
    py: Python<'_>,
    spec: &ModelSpec,
    out_of_range: OutOfRange,
    fit: Option<&TableFit>,
) -> PyResult<Fallback> {
    let model = EffectModels::fitted(spec, fit);
    Ok(model.map_err(|error| errors::model(py, &error))?.out_of_range(out_of_range))
}

/// Converts a time limit in seconds.
pub fn time_limit(given: &Bound<'_, PyAny>) -> PyResult<Option<Duration>> {
    let Some(seconds) = optional("time_limit", given, number)? else { return Ok(None) };
    match Duration::try_from_secs_f64(seconds) {
        Ok(limit) if !limit.is_zero() => Ok(Some(limit)),
        _ => {
            let message = format!("`time_limit` must be above 0 seconds, found {seconds}");
            Err(PyValueError::new_err(message))
        }
    }
}

/// Converts the required share of successful replays.
pub fn robustness(given: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
    optional("robustness", given, share)
}

/// Converts the required share of successful belief samples.
pub fn min_success(given: &Bound<'_, PyAny>) -> PyResult<f64> {
    share("min_success", given)
}

fn share(name: &str, given: &Bound<'_, PyAny>) -> PyResult<f64> {
    let share = number(name, given)?;
    if (0.0..=1.0).contains(&share) {
        return Ok(share);
    }
    let message = format!("`{name}` must be a share from 0 to 1, found {share}; 75 % is 0.75");
    Err(PyValueError::new_err(message))
}

/// Converts a rotation of the end effector.
pub fn grip_yaw(given: &Bound<'_, PyAny>) -> PyResult<Option<f64>> {
    let yaw = optional("grip_yaw", given, number)?;
    yaw.map(|yaw| angle("grip_yaw", yaw)).transpose()
}

/// Converts a number of worker threads.
pub fn threads(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(whole("threads", given, 0..=1024, "; 0 means one per core")? as usize)
}

/// Converts a seed.
pub fn seed(given: &Bound<'_, PyAny>) -> PyResult<u64> {
    whole("seed", given, 0..=u64::MAX, "; any of them gives a reproducible result")
}

/// Converts a number of perturbed replays.
pub fn replays(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(whole("replays", given, 0..=100_000, " in each engine")? as usize)
}

/// Converts a number of perturbed replays; `None` stands for the effort's.
pub fn maybe_replays(given: &Bound<'_, PyAny>) -> PyResult<Option<usize>> {
    if given.is_none() { Ok(None) } else { replays(given).map(Some) }
}

/// Converts a maximum number of pushes of a run.
pub fn max_pushes(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(whole("max_pushes", given, 0..=1000, "")? as usize)
}

/// Converts a maximum number of exploratory pushes.
pub fn max_probes(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(whole("max_probes", given, 0..=1000, "; 0 forbids exploratory pushes")? as usize)
}

/// Converts a number of belief samples.
pub fn samples(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(whole("samples", given, 1..=1000, "")? as usize)
}

/// Converts a number of tools that a design screens.
pub fn candidates(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(whole("candidates", given, 1..=1_000_000, "")? as usize)
}

/// Converts a number of parts of a designed tool.
pub fn parts(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(whole("parts", given, 1..=DesignSettings::MOST_PARTS as u64, "")? as usize)
}

/// Converts the index of a frame.
pub fn frame(given: &Bound<'_, PyAny>) -> PyResult<usize> {
    Ok(whole("frame", given, 0..=u32::MAX.into(), ", counted from the start")? as usize)
}

/// Checks an angle in radians. An angle beyond two revolutions is an error, because it is likely in
/// degrees; headings that count revolutions may be beyond one.
pub fn angle(name: &str, radians: f64) -> PyResult<f64> {
    if radians.abs() <= 2.0 * std::f64::consts::TAU {
        return Ok(radians);
    }
    Err(PyValueError::new_err(format!(
        "`{name}` must be an angle from -4 pi to 4 pi radians, found {radians}; convert degrees \
         with `math.radians`"
    )))
}

/// Converts a number.
pub fn number(name: &str, given: &Bound<'_, PyAny>) -> PyResult<f64> {
    given.extract().map_err(|_| {
        PyTypeError::new_err(format!("`{name}` must be a number, found {}", found(given)))
    })
}

/// Describes a value in an error message: its type, and a short text as it is.
pub fn found(given: &Bound<'_, PyAny>) -> String {
    let kind = given.get_type().name().map_or("an object".to_owned(), |name| name.to_string());
    match given.extract::<String>() {
        Ok(text) if text.chars().count() <= 60 => format!("the text {text:?}"),
        _ if given.is_none() => "None".to_owned(),
        _ if given.is_instance_of::<PyFloat>() || given.is_instance_of::<PyInt>() => {
            format!("{given}")
        }
        _ => format!("a value of the type {kind}"),
    }
}

fn optional<T>(
    name: &str,
    given: &Bound<'_, PyAny>,
    convert: fn(&str, &Bound<'_, PyAny>) -> PyResult<T>,
) -> PyResult<Option<T>> {
    if given.is_none() { Ok(None) } else { convert(name, given).map(Some) }
}

/// Converts a whole number within a range; `more` ends the error message.
fn whole(
    name: &str,
    given: &Bound<'_, PyAny>,
    range: RangeInclusive<u64>,
    more: &str,
) -> PyResult<u64> {
    let number: PyResult<u64> = given.extract();
    if let Some(number) = number.as_ref().ok().filter(|number| range.contains(number)) {
        return Ok(*number);
    }
    let message = format!(
        "`{name}` must be a whole number from {} to {}, found {}{more}",
        range.start(),
        range.end(),
        found(given)
    );
    // A number beyond the range of the type is not of a wrong type.
    match number.is_ok() || given.is_instance_of::<PyInt>() || given.extract::<i64>().is_ok() {
        true => Err(PyValueError::new_err(message)),
        false => Err(PyTypeError::new_err(message)),
    }
}

/// Returns the name of an engine.
pub fn engine(engine: Engine) -> &'static str {
    match engine {
        Engine::Planar => "planar",
        Engine::Spatial => "3d",
        Engine::Upright => "3d-upright",
    }
}

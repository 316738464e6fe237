//! Conversion of names and numbers in arguments.

use std::fmt::Display;
use std::time::Duration;

use pushplan::models::{EffectModels, Engine, Fallback, OutOfRange};
use pushplan::{Effort, ModelSpec, PlanStatus, TableFit};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

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
pub fn limit(seconds: Option<f64>) -> PyResult<Option<Duration>> {
    let limit = |seconds: f64| match Duration::try_from_secs_f64(seconds) {
        Ok(limit) if !limit.is_zero() => Ok(limit),
        _ => {
            let message = format!("`time_limit` must be above 0 seconds, found {seconds}");
            Err(PyValueError::new_err(message))
        }
    };
    seconds.map(limit).transpose()
}

/// Checks a number of worker threads.
pub fn threads(threads: usize) -> PyResult<usize> {
    match threads {
        0..=1024 => Ok(threads),
        _ => {
            let message =
                format!("`threads` must be at most 1024, found {threads}; 0 means one per core");
            Err(PyValueError::new_err(message))
        }
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

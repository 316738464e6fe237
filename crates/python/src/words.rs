//! Words and numbers of arguments.

use std::fmt::Display;
use std::time::Duration;

use pushplan::effect::{EffectModels, Outside, Routed};
use pushplan::scene::{Engine, TableFit};
use pushplan::{Effort, ModelSpec, Models, PlanStatus};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors;

/// The effort of this name.
pub fn effort(word: &str) -> PyResult<Effort> {
    one_of("effort", word, &Effort::ALL)
}

/// The word for how solving ended.
pub fn status(status: PlanStatus) -> &'static str {
    match status {
        PlanStatus::Solved => "solved",
        PlanStatus::Fragile => "fragile",
        PlanStatus::Partial => "partial",
        PlanStatus::NoPlan => "no_plan",
        PlanStatus::FailedVerification => "failed_verification",
    }
}

/// What to do where a model should not be trusted.
pub fn outside(word: &str) -> PyResult<Outside> {
    one_of("outside", word, &[Outside::Warn, Outside::Simulate, Outside::Refuse])
}

fn one_of<T: Display + Copy>(what: &str, word: &str, all: &[T]) -> PyResult<T> {
    all.iter().find(|one| one.to_string() == word).copied().ok_or_else(|| {
        let words: Vec<String> =
            all.iter().map(|one| format!("{one:?}", one = one.to_string())).collect();
        PyValueError::new_err(format!("{what}: {word:?} is not known; use {}", words.join(", ")))
    })
}

/// What a text names as an effect model.
pub fn spec(py: Python<'_>, text: &str) -> PyResult<ModelSpec> {
    text.parse().map_err(|error| errors::spec(py, &error))
}

/// What a text names as the effect models of a planner.
pub fn models(py: Python<'_>, text: &str) -> PyResult<Models> {
    text.parse().map_err(|error| errors::spec(py, &error))
}

/// The effect model of this name.
pub fn model(py: Python<'_>, text: &str, outside: Outside) -> PyResult<Routed> {
    fitted(py, &spec(py, text)?, outside, None)
}

/// The same with what was learnt about a table.
pub fn fitted(
    py: Python<'_>,
    spec: &ModelSpec,
    outside: Outside,
    fit: Option<&TableFit>,
) -> PyResult<Routed> {
    let model = EffectModels::fitted(spec, fit);
    Ok(model.map_err(|error| errors::model(py, &error))?.outside(outside))
}

/// A time limit in seconds.
pub fn limit(seconds: Option<f64>) -> PyResult<Option<Duration>> {
    let limit = |seconds: f64| match Duration::try_from_secs_f64(seconds) {
        Ok(limit) if !limit.is_zero() => Ok(limit),
        _ => Err(PyValueError::new_err("`time_limit` is a number of seconds above 0")),
    };
    seconds.map(limit).transpose()
}

/// A number of worker threads.
pub fn threads(threads: usize) -> PyResult<usize> {
    match threads {
        0..=1024 => Ok(threads),
        _ => Err(PyValueError::new_err("`threads` is at most 1024; 0 means one for each core")),
    }
}

/// What an engine is called.
pub fn engine(engine: Engine) -> &'static str {
    match engine {
        Engine::Planar => "planar",
        Engine::Spatial => "3d",
        Engine::Upright => "3d-upright",
    }
}

//! Verification of plans.

use std::sync::Arc;
use std::time::Duration;

use pushplan::Situation;
use pushplan::outcomes::VerifySettings;
use pushplan::progress::Until;
use pushplan::{Task, Verifier};
use pyo3::prelude::*;

use crate::plan::PyPlan;
use crate::task::PyTask;
use crate::verdict::PyVerdict;
use crate::{arguments, wanted, work};

/// Verifies a plan by nominal and perturbed replays in the 2-D and the 3-D engine.
///
/// Perturbed replays have small errors of starts, frictions, support and contact height. The
/// verifier adds replays until the verdict is clear.
///
/// Parameters
/// ----------
/// plan : Plan
///     Plan to verify.
/// replays : int, default 8
///     Minimum number of perturbed replays in each engine, at most 100000.
/// seed : int, default 0
///     Seed of the perturbations.
/// robustness : float, optional
///     Minimum share of the perturbed replays that must reach the goal, 0 to 1; by default the
///     task's.
/// time_limit : float, optional
///     Maximum duration, seconds. Replays that are unfinished then do not pass.
/// threads : int, default 0
///     Number of worker threads; 0 means one per core.
///
/// Returns
/// -------
/// Verdict
///     Verdict with all replays.
///
/// Raises
/// ------
/// TypeError or ValueError
///     If an argument has an invalid value.
///
/// Examples
/// --------
/// >>> verdict = pushplan.verify(solution.best, replays=32)
/// >>> print(verdict.passed, verdict.robustness)
#[pyfunction]
#[pyo3(signature = (plan, *, replays = 8, seed = 0, robustness = None, time_limit = None,
                    threads = 0))]
pub fn verify(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::plan)] plan: Py<PyPlan>,
    #[pyo3(from_py_with = arguments::replays)] replays: usize,
    #[pyo3(from_py_with = arguments::seed)] seed: u64,
    #[pyo3(from_py_with = arguments::robustness)] robustness: Option<f64>,
    #[pyo3(from_py_with = arguments::time_limit)] time_limit: Option<Duration>,
    #[pyo3(from_py_with = arguments::threads)] threads: usize,
) -> PyResult<PyVerdict> {
    let mut file = plan.get().file.clone();
    let task = PyTask { task: Arc::new(file.task.clone()), source: None };
    file.task = Task::clone(&*task.robust(robustness));
    let settings = VerifySettings { replays, seed };
    let verdict = work::run(py, threads, |watch| {
        let until = Until::new(watch, time_limit);
        let situation = Situation::stated(&file.task.scene);
        let verifier = Verifier::new(settings)
            .with_progress(&until)
            .until_clear()
            .moving(file.joints.as_ref());
        verifier.verify(&file.task, &situation, &file.tools, &file.plan)
    })?;
    Ok(PyVerdict { file, verdict })
}

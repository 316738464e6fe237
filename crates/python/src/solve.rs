//! Functions that solve tasks.

use std::sync::Arc;
use std::time::Duration;

use pushplan::progress::{Count, Progress, Quiet};
use pushplan::{Planner, Solution, SolveError, TableFit, Task, ToolLibrary};
use pushplan_report::TaskSource;
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::progress::{Observer, Watch};
use crate::solution::PySolution;
use crate::table_fit::PyTableFit;
use crate::task::PyTask;
use crate::tool::{PyToolLibrary, given};
use crate::{arguments, errors, wanted, work};

/// Chooses a tool and pushes that solve a task, and verifies the plans.
///
/// Parameters
/// ----------
/// task : Task
///     Task to solve.
/// tools : ToolLibrary, optional
///     Tools to choose from; by default the tools shipped with the package.
/// effort : {"draft", "standard", "thorough"}, default "standard"
///     Size of the search.
/// model : str, optional
///     Effect model, such as "network", "prior" (the analytic model), "planar" or "3d". By default
///     the model of the effort.
/// out_of_range : {"warn", "simulate", "refuse"}, default "warn"
///     Action outside the model's validity range: add a warning, simulate in 2-D instead, or raise
///     `RefusedError`.
/// seed : int, default 0
///     Seed of the samples of refinement and of the perturbations.
/// replays : int, optional
///     Minimum number of perturbed replays of the winning plan in each engine, at most 100000; by
///     default the effort's. The planner adds replays until the verdict is clear.
/// robustness : float, optional
///     Minimum share of the perturbed replays that must reach the goal, 0 to 1; by default the
///     task's.
/// time_limit : float, optional
///     Maximum duration, seconds. The planner then returns the best plans found so far.
/// fit : TableFit, optional
///     Table fit from pushes recorded on this table.
/// threads : int, default 0
///     Number of worker threads, at most 1024; 0 means one per core. No result depends on it.
/// progress : bool or callable, optional
///     Function that is called with a `Progress` while the planner works, or True for a line on
///     stderr, if that is a terminal. Progress changes no result.
///
/// Returns
/// -------
/// Solution
///     Status and ranked plans. A missing plan is not an error, see `Solution.status`.
///
/// Raises
/// ------
/// FileError
///     If the task names a tool that `tools` lacks.
/// TaskError
///     If a value of the task is invalid.
/// ModelError
///     If `model` is not the name of an effect model.
/// RefusedError
///     If `out_of_range` is "refuse" and the task is outside the model's validity range.
/// TypeError or ValueError
///     If another argument has an invalid type or value.
///
/// Examples
/// --------
/// >>> task = pushplan.Task.example("pull-back-behind-wall")
/// >>> solution = pushplan.solve(task, effort="draft", progress=True)
/// >>> print(solution.status, solution.best)
#[pyfunction]
#[pyo3(signature = (task, tools = None, *, effort = "standard", model = None,
                    out_of_range = "warn", seed = 0, replays = None, robustness = None,
                    time_limit = None, fit = None, threads = 0, progress = None))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn solve(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::task)] task: Py<PyTask>,
    #[pyo3(from_py_with = wanted::tools)] tools: Option<Py<PyToolLibrary>>,
    effort: &str,
    model: Option<&str>,
    out_of_range: &str,
    #[pyo3(from_py_with = arguments::seed)] seed: u64,
    #[pyo3(from_py_with = arguments::maybe_replays)] replays: Option<usize>,
    #[pyo3(from_py_with = arguments::robustness)] robustness: Option<f64>,
    #[pyo3(from_py_with = arguments::time_limit)] time_limit: Option<Duration>,
    #[pyo3(from_py_with = wanted::fit)] fit: Option<Py<PyTableFit>>,
    #[pyo3(from_py_with = arguments::threads)] threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<PySolution> {
    let fit = fit.as_ref().map(|fit| &fit.get().0);
    let asked = Asked { effort, model, out_of_range, seed, replays, time_limit, fit };
    let planner = asked.planner(py)?;
    let library = given(py, tools.as_ref())?;
    let (task, observer) = (task.get(), Observer::of(py, progress)?);
    let stated = stated(task.robust(robustness), fit);
    let solved =
        work::follow(py, threads, &observer, |watch| planner.solve_with(&stated, &library, watch))?;
    solution(py, stated, task.source(), solved, &planner)
}

/// Returns the task with the table properties of `fit`.
pub fn stated(task: Arc<Task>, fit: Option<&TableFit>) -> Arc<Task> {
    let Some(fit) = fit else { return task };
    let mut task = Task::clone(&task);
    fit.state(&mut task.scene);
    Arc::new(task)
}

/// Solves several tasks in parallel, with the results of `solve` for each task.
///
/// Parameters
/// ----------
/// tasks : sequence of Task
///     Tasks to solve.
/// tools, effort, model, out_of_range, seed, replays, robustness, time_limit, fit, threads
///     Options for every task, see `solve`.
/// progress : bool or callable, optional
///     Receiver of the number of solved tasks, see `solve`.
///
/// Returns
/// -------
/// list of Solution
///     Solutions in the order of the tasks.
///
/// Raises
/// ------
/// PushplanError, TypeError or ValueError
///     For the first task that `solve` would reject, or an invalid argument.
///
/// Examples
/// --------
/// >>> tasks = [task.at(task.start + [0.01 * k, 0.0, 0.0]) for k in range(3)]
/// >>> solutions = pushplan.solve_all(tasks, effort="draft", progress=True)
/// >>> print(sum(solution.solved for solution in solutions))
#[pyfunction]
#[pyo3(signature = (tasks, tools = None, *, effort = "standard", model = None,
                    out_of_range = "warn", seed = 0, replays = None, robustness = None,
                    time_limit = None, fit = None, threads = 0, progress = None))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn solve_all(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::tasks)] tasks: Vec<Py<PyTask>>,
    #[pyo3(from_py_with = wanted::tools)] tools: Option<Py<PyToolLibrary>>,
    effort: &str,
    model: Option<&str>,
    out_of_range: &str,
    #[pyo3(from_py_with = arguments::seed)] seed: u64,
    #[pyo3(from_py_with = arguments::maybe_replays)] replays: Option<usize>,
    #[pyo3(from_py_with = arguments::robustness)] robustness: Option<f64>,
    #[pyo3(from_py_with = arguments::time_limit)] time_limit: Option<Duration>,
    #[pyo3(from_py_with = wanted::fit)] fit: Option<Py<PyTableFit>>,
    #[pyo3(from_py_with = arguments::threads)] threads: usize,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Vec<PySolution>> {
    let fit = fit.as_ref().map(|fit| &fit.get().0);
    let asked = Asked { effort, model, out_of_range, seed, replays, time_limit, fit };
    let planner = asked.planner(py)?;
    let library = given(py, tools.as_ref())?;
    let observer = Observer::of(py, progress)?;
    let stated: Vec<Arc<Task>> =
        tasks.iter().map(|task| stated(task.get().robust(robustness), fit)).collect();
    let solved = work::follow(py, threads, &observer, |watch| {
        solve_each(&planner, &stated, &library, watch)
    })?;
    let results = stated.into_iter().zip(&tasks).zip(solved);
    results
        .map(|((stated, task), solved)| solution(py, stated, task.get().source(), solved, &planner))
        .collect()
}

fn solve_each(
    planner: &Planner,
    tasks: &[Arc<Task>],
    library: &ToolLibrary,
    watch: &Watch,
) -> Vec<Result<Solution, SolveError>> {
    watch.stage("tasks");
    let count = Count::new(watch, 0, tasks.len());
    let solve = |task: &Arc<Task>| {
        let solved = planner.solve_with(task, library, &Quiet(watch));
        count.one();
        solved
    };
    // After a cancellation the results are discarded.
    tasks.par_iter().map(|task| (!watch.cancelled()).then(|| solve(task))).while_some().collect()
}

/// Arguments of `solve` as given by the caller.
pub struct Asked<'a> {
    pub effort: &'a str,
    pub model: Option<&'a str>,
    pub out_of_range: &'a str,
    pub seed: u64,
    pub replays: Option<usize>,
    pub time_limit: Option<Duration>,
    pub fit: Option<&'a TableFit>,
}

impl Asked<'_> {
    pub fn planner(&self, py: Python<'_>) -> PyResult<Planner> {
        let effort = arguments::effort(self.effort)?;
        let model = match self.model {
            Some(text) => arguments::spec(py, text)?,
            None => effort.model(),
        };
        let planner =
            Planner::fitted(&model, self.fit).map_err(|error| errors::model(py, &error))?;
        let out_of_range = arguments::out_of_range(self.out_of_range)?;
        let settings = match self.replays {
            Some(count) => effort.settings().replaying(count),
            None => effort.settings(),
        };
        let builder = planner.settings(settings).seed(self.seed).out_of_range(out_of_range);
        Ok(match self.time_limit {
            Some(limit) => builder.time_limit(limit).build(),
            None => builder.build(),
        })
    }
}

fn solution(
    py: Python<'_>,
    task: Arc<Task>,
    source: TaskSource,
    solved: Result<Solution, SolveError>,
    planner: &Planner,
) -> PyResult<PySolution> {
    let solution = solved.map_err(|error| errors::solve(py, &error))?;
    Ok(PySolution { task, source, solution, fit: planner.fit().cloned() })
}

//! Functions that solve tasks, and predict and verify plans.

use std::sync::Arc;

use pushplan::files::PlanFile;
use pushplan::models::{Fallback, ModelKind};
use pushplan::outcomes::VerifySettings;
use pushplan::progress::{Cancel, Until};
use pushplan::{
    EffectModel, Job, Planner, Pose, Record, Simulator, Situation, Solution, SolveError, TableFit,
    Task, ToolLibrary, Trajectory, Verifier, Warning,
};
use pushplan_report::TaskSource;
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::plan::PyPlan;
use crate::solution::PySolution;
use crate::table_fit::PyTableFit;
use crate::task::PyTask;
use crate::tool::{PyToolLibrary, given};
use crate::trajectory::PyTrajectory;
use crate::verdict::PyVerdict;
use crate::{arguments, errors, work};

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
///     Minimum number of perturbed replays of the winning plan in each engine; by default the
///     effort's. The planner adds replays until the verdict is clear.
/// robustness : float, optional
///     Minimum share of the perturbed replays that must reach the goal, 0 to 1; by default the
///     task's.
/// time_limit : float, optional
///     Maximum duration, seconds. The planner then returns the best plans found so far.
/// fit : TableFit, optional
///     Table fit from pushes recorded on this table.
/// threads : int, default 0
///     Number of worker threads, at most 1024; 0 means one per core. No result depends on it.
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
/// ValueError
///     If another argument has an invalid value.
///
/// Examples
/// --------
/// >>> task = pushplan.Task.example("pull-back-behind-wall")
/// >>> solution = pushplan.solve(task, effort="draft")
/// >>> print(solution.status, solution.best)
#[pyfunction]
#[pyo3(signature = (task, tools = None, *, effort = "standard", model = None,
                    out_of_range = "warn", seed = 0, replays = None, robustness = None,
                    time_limit = None, fit = None, threads = 0))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn solve(
    py: Python<'_>,
    task: &PyTask,
    tools: Option<Py<PyToolLibrary>>,
    effort: &str,
    model: Option<&str>,
    out_of_range: &str,
    seed: u64,
    replays: Option<usize>,
    robustness: Option<f64>,
    time_limit: Option<f64>,
    fit: Option<Py<PyTableFit>>,
    threads: usize,
) -> PyResult<PySolution> {
    let fit = fit.as_ref().map(|fit| &fit.get().0);
    let asked = Asked { effort, model, out_of_range, seed, replays, time_limit, fit };
    let planner = asked.planner(py)?;
    let library = given(py, tools.as_ref())?;
    let stated = stated(task.robust(robustness)?, fit);
    let threads = arguments::threads(threads)?;
    let solved = work::run(py, threads, |cancel| planner.solve_with(&stated, &library, cancel))?;
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
///
/// Returns
/// -------
/// list of Solution
///     Solutions in the order of the tasks.
///
/// Raises
/// ------
/// PushplanError or ValueError
///     For the first task that `solve` would reject.
#[pyfunction]
#[pyo3(signature = (tasks, tools = None, *, effort = "standard", model = None,
                    out_of_range = "warn", seed = 0, replays = None, robustness = None,
                    time_limit = None, fit = None, threads = 0))]
#[allow(clippy::too_many_arguments)] // keywords in Python
pub fn solve_all(
    py: Python<'_>,
    tasks: Vec<Py<PyTask>>,
    tools: Option<Py<PyToolLibrary>>,
    effort: &str,
    model: Option<&str>,
    out_of_range: &str,
    seed: u64,
    replays: Option<usize>,
    robustness: Option<f64>,
    time_limit: Option<f64>,
    fit: Option<Py<PyTableFit>>,
    threads: usize,
) -> PyResult<Vec<PySolution>> {
    let fit = fit.as_ref().map(|fit| &fit.get().0);
    let asked = Asked { effort, model, out_of_range, seed, replays, time_limit, fit };
    let planner = asked.planner(py)?;
    let library = given(py, tools.as_ref())?;
    let stated: PyResult<Vec<Arc<Task>>> =
        tasks.iter().map(|task| Ok(stated(task.get().robust(robustness)?, fit))).collect();
    let stated = stated?;
    let threads = arguments::threads(threads)?;
    let solved = work::run(py, threads, |cancel| solve_each(&planner, &stated, &library, cancel))?;
    let results = stated.into_iter().zip(&tasks).zip(solved);
    results
        .map(|((stated, task), solved)| solution(py, stated, task.get().source(), solved, &planner))
        .collect()
}

fn solve_each(
    planner: &Planner,
    tasks: &[Arc<Task>],
    library: &ToolLibrary,
    cancel: &Cancel,
) -> Vec<Result<Solution, SolveError>> {
    tasks.par_iter().map(|task| planner.solve_with(task, library, cancel)).collect()
}

/// Arguments of `solve` as given by the caller.
pub struct Asked<'a> {
    pub effort: &'a str,
    pub model: Option<&'a str>,
    pub out_of_range: &'a str,
    pub seed: u64,
    pub replays: Option<usize>,
    pub time_limit: Option<f64>,
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
        Ok(match arguments::limit(self.time_limit)? {
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

/// Predicts the motion of the objects under a plan, frame by frame.
///
/// Parameters
/// ----------
/// plan : Plan
///     Plan to predict. A table fit of the plan applies if `model` is the plan's own model.
/// model : str, default "network"
///     Effect model, such as "network", "prior" (the analytic model), "planar" or "3d".
/// out_of_range : {"warn", "simulate", "refuse"}, default "warn"
///     Action outside the model's validity range, see `solve`.
/// threads : int, default 0
///     Number of worker threads; 0 means one per core.
///
/// Returns
/// -------
/// Trajectory
///     Predicted motion, with the warnings of the model.
///
/// Raises
/// ------
/// ModelError
///     If `model` is not the name of an effect model.
/// RefusedError
///     If `out_of_range` is "refuse" and the plan is outside the model's validity range.
/// ValueError
///     If `out_of_range` or `threads` has an invalid value.
#[pyfunction]
#[pyo3(signature = (plan, model = "network", *, out_of_range = "warn", threads = 0))]
pub fn predict(
    py: Python<'_>,
    plan: &PyPlan,
    model: &str,
    out_of_range: &str,
    threads: usize,
) -> PyResult<PyTrajectory> {
    let file = &plan.file;
    let spec = arguments::spec(py, model)?;
    // The fit applies only to the network that made the plan.
    let fit = file.fit.as_ref().filter(|_| file.model.as_ref() == Some(&spec));
    let model = arguments::fitted(py, &spec, arguments::out_of_range(out_of_range)?, fit)?;
    let trajectory = work::run(py, arguments::threads(threads)?, |_| predicted(&model, file))?;
    if trajectory.warnings.contains(&Warning::Refused) {
        let message = format!(
            "`out_of_range` is \"refuse\", and the plan is outside the validity range of the model \
             `{}`; use another model, or `out_of_range=\"simulate\"`",
            trajectory.by
        );
        return Err(errors::refused(py, &message, &trajectory.warnings));
    }
    Ok(PyTrajectory::new(&Arc::new(file.task.clone()), trajectory))
}

/// Predicts a plan with a model; the trajectory includes the warnings.
pub fn predicted(model: &Fallback, file: &PlanFile) -> Trajectory {
    let scene = &file.task.scene;
    let motions = file.plan.motions(&file.tools).unwrap_or_default();
    let jobs: Vec<Job> = match &motions[..] {
        [] => {
            let home = Pose { position: file.task.robot.home, heading: 0.0 };
            let tool = file.tools.first().map_or(home, |tool| tool.pose(home));
            return Trajectory::standing(ModelKind::Still.into(), tool, scene.start());
        }
        // Steps after a lever-up can be simulated only in 3-D.
        [_, _, ..] if file.plan.levers() => {
            return Simulator::spatial().run_plan(scene, &motions, Record::Frames);
        }
        motions => motions.iter().map(|motion| Job::stated(scene, motion.clone())).collect(),
    };
    let mut trajectory = model.in_turn(scene, &jobs, Record::Frames).unwrap_or_else(|| {
        Trajectory::standing(model.spec().clone(), Pose::default(), scene.start())
    });
    for warning in jobs.iter().flat_map(|job| model.trust(scene, job).warnings()) {
        if !trajectory.warnings.contains(&warning) {
            trajectory.warnings.push(warning);
        }
    }
    trajectory
}

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
/// ValueError
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
    plan: &PyPlan,
    replays: usize,
    seed: u64,
    robustness: Option<f64>,
    time_limit: Option<f64>,
    threads: usize,
) -> PyResult<PyVerdict> {
    if replays > 100_000 {
        let message = format!("`replays` must be at most 100000, found {replays}");
        return Err(pyo3::exceptions::PyValueError::new_err(message));
    }
    let mut file = plan.file.clone();
    let task = PyTask { task: Arc::new(file.task.clone()), source: None };
    file.task = Task::clone(&*task.robust(robustness)?);
    let settings = VerifySettings { replays, seed };
    let limit = arguments::limit(time_limit)?;
    let verdict = work::run(py, arguments::threads(threads)?, |cancel| {
        let until = Until::new(cancel, limit);
        let situation = Situation::stated(&file.task.scene);
        let verifier = Verifier::new(settings)
            .with_progress(&until)
            .until_clear()
            .moving(file.joints.as_ref());
        verifier.verify(&file.task, &situation, &file.tools, &file.plan)
    })?;
    Ok(PyVerdict { file, verdict })
}

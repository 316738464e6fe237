//! Solving, predicting and verifying.

use std::sync::Arc;

use pushplan::asset::PlanFile;
use pushplan::effect::{EffectModel, Fallback};
use pushplan::progress::{Cancel, Until};
use pushplan::verify::VerifySettings;
use pushplan::{
    Job, Planner, Pose, Record, Simulator, Solution, SolveError, Task, ToolLibrary, Trajectory,
    Verifier,
};
use pushplan::{
    outcome::Warning,
    scene::{ModelKind, Situation, TableFit},
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

/// Chooses a tool and pushes for a task and verifies them.
///
/// `tools` are those to choose from, by default the ones that come with the package; `effort` is
/// "draft", "standard" or "thorough"; `model` predicts effects, or two with ">" between them do, the
/// first screening and the second deciding, by default those of the effort; `out_of_range` says what to do where it should not be trusted: "warn", "simulate" or "refuse";
/// `seed` is that of refinement's samples and of the disturbances; `replays` is the number of
/// disturbed replays of the winning plan in each engine, by default that of the effort; `robustness` is the share of the
/// disturbed replays that must reach the goal, by default the task's; `time_limit` is in seconds, and
/// the best plan so far is returned then; `fit` is what pushes recorded on this table taught the
/// network; `threads` is a number of worker threads, 0 one for each
/// core, and changes no result.
#[pyfunction]
#[pyo3(signature = (task, tools = None, *, effort = "standard", model = None, out_of_range = "warn",
                    seed = 0, replays = None, robustness = None, time_limit = None, fit = None,
                    threads = 0))]
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

/// Solves tasks side by side, with the results of `solve`, in the order of the tasks. Raises for the
/// first task that cannot be tried.
#[pyfunction]
#[pyo3(signature = (tasks, tools = None, *, effort = "standard", model = None, out_of_range = "warn",
                    seed = 0, replays = None, robustness = None, time_limit = None, fit = None,
                    threads = 0))]
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

/// Options of solving, in words.
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
        let models = match self.model {
            Some(text) => arguments::models(py, text)?,
            None => effort.models(),
        };
        let planner =
            Planner::fitted(&models, self.fit).map_err(|error| errors::model(py, &error))?;
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

/// What `model` predicts for a plan, frame by frame: "network", "prior", "planar", "3d" and so on.
/// A network knows what the plan says of its table. Raises `RefusedError` where the model should not be
/// trusted and `out_of_range` is "refuse".
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
        let message = format!("{} gives no prediction for this plan", trajectory.by);
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

/// Replays a plan in both engines, as written and `replays` times in each with starts and
/// frictions slightly off.
///
/// `robustness` is the share of the disturbed replays that must reach the goal, by default the
/// task's; `time_limit` is in seconds, and replays that are not over then do not pass.
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
        let message = "`replays` is at most 100000";
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

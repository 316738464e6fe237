//! Predictions of plans by one effect model.

use std::sync::Arc;

use pushplan::files::PlanFile;
use pushplan::models::{Fallback, ModelKind};
use pushplan::{EffectModel, Job, Pose, Record, Simulator, Trajectory, Warning};
use pyo3::prelude::*;

use crate::plan::PyPlan;
use crate::trajectory::PyTrajectory;
use crate::{arguments, errors, wanted, work};

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
/// TypeError or ValueError
///     If another argument has an invalid value.
///
/// Examples
/// --------
/// >>> trajectory = pushplan.predict(plan, "3d")
/// >>> print(trajectory.poses.shape, trajectory.reached)
#[pyfunction]
#[pyo3(signature = (plan, model = "network", *, out_of_range = "warn", threads = 0))]
pub fn predict(
    py: Python<'_>,
    #[pyo3(from_py_with = wanted::plan)] plan: Py<PyPlan>,
    model: &str,
    out_of_range: &str,
    #[pyo3(from_py_with = arguments::threads)] threads: usize,
) -> PyResult<PyTrajectory> {
    let file = &plan.get().file;
    let spec = arguments::spec(py, model)?;
    // The fit applies only to the network that made the plan.
    let fit = file.fit.as_ref().filter(|_| file.model.as_ref() == Some(&spec));
    let model = arguments::fitted(py, &spec, arguments::out_of_range(out_of_range)?, fit)?;
    let trajectory = work::run(py, threads, |_| predicted(&model, file))?;
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

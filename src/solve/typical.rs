//! Typical push of a task, known before any search.

use std::sync::Arc;

use crate::effect::EffectModel;
use crate::geometry::Pose;
use crate::{
    scene::{Situation, State, Tool},
    task::{Job, Push, Task, ToolMotion},
};

/// Returns a push of the goal's object towards the goal by the tool's first part. It represents the
/// pushes for which the model will be used.
pub(super) fn typical(task: &Task, start: &State, tool: &Arc<Tool>) -> ToolMotion {
    let (rules, goal) = (&task.pushes, &task.goals[0]);
    let object = start.poses[goal.object].position;
    let way = goal.place(start) - object;
    let part = tool.part_pose(0, &tool.pose(Pose::default()));
    let push = Push {
        start: object - part.position,
        direction: way.y.atan2(way.x),
        length: rules.length,
        speed: rules.speed,
    };
    ToolMotion::pushes(Arc::clone(tool), rules.lift, 0.0, &[push], true)
}

/// Returns the 95th percentile of an effect model's error on pushes like this one, metres, if it
/// was measured.
pub(super) fn error_p95(model: &dyn EffectModel, situation: &Situation, job: &Job) -> Option<f64> {
    model.trust(&situation.scene, job).error().map(|error| error.p95)
}

//! Benefit of the closed loop over planning once, on tasks with unknown scenes.

use std::time::Instant;

use pushplan::internals::asset::ToolLibrary;
use pushplan::internals::geometry::wrap_angle;
use pushplan::internals::progress::NoProgress;
use pushplan::internals::solve::{Planner, SolveError};
use pushplan::internals::{
    scene::{Scene, Situation, State},
    task::{Goal, Task, Truth},
};
use pushplan_act::act::{ActError, End, RunSettings, Runner, SimulatedWorld, Trace, Why, World};
use pushplan_bench::store::Measured;
use serde::{Deserialize, Serialize};

use super::random::{HiddenWorld, RandomError, RandomSuite, TaskKind};

/// The result of a task with an unknown scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClosedRecord {
    /// Kind of the task.
    pub kind: TaskKind,
    /// End of the run; `None` if the world became unusable.
    pub end: Option<End>,
    /// True final state of the object after the loop.
    pub closed: Left,
    /// Number of pushes of the loop.
    pub pushes: usize,
    /// Number of exploratory pushes among them.
    pub probes: usize,
    /// Final state after a plan for the initial guesses, executed without observations.
    pub once: Left,
    /// Final state after a plan with full knowledge.
    pub known: Left,
}

/// The final state of the goal's object.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Left {
    /// Whether the object is at the goal.
    pub reached: bool,
    /// Distance from the goal, metres.
    pub error: f64,
}

impl Left {
    fn of(goal: &Goal, state: &State, sound: bool) -> Self {
        Self { reached: sound && goal.reached(state), error: goal.error(state) }
    }
}

impl RandomSuite {
    /// Runs task `index` with everything hidden in a `world` of this kind in a loop with
    /// `settings`, and plans it once.
    ///
    /// # Errors
    /// Returns an error if the task cannot be made or the planner refuses it.
    pub fn run_hidden(
        &self,
        planner: &Planner,
        library: &ToolLibrary,
        (settings, world): (RunSettings, HiddenWorld),
        index: usize,
    ) -> Result<Measured<ClosedRecord>, RandomError> {
        let hidden = self.hidden(index)?.in_world(world);
        let goal = hidden.task.goals[0].clone();
        let began = Instant::now();
        let mut trace =
            Trace::new(hidden.task.clone(), settings, String::new(), Some(hidden.truth.clone()));
        let mut world =
            SimulatedWorld::new(hidden.truth.clone()).pushed_with(hidden.task.robot.max_force);
        let runner = Runner::new(planner, library);
        let ran = runner.run_with(&mut trace, &mut world, &mut |_| Ok(()), &NoProgress);
        let seconds = began.elapsed().as_secs_f64();
        if let Err(ActError::Solve(error)) = ran {
            return Err(RandomError::Solve(error));
        }
        let probes = trace.steps.iter().filter(|step| step.why == Why::Probe).count();
        let record = ClosedRecord {
            kind: hidden.kind,
            end: trace.end,
            closed: Left::of(&goal, world.state(), trace.end.is_some()),
            pushes: trace.pushes(),
            probes,
            once: once(planner, library, &hidden.task, &hidden.truth)?,
            known: once(planner, library, &hidden.known, &hidden.truth)?,
        };
        Ok(Measured { record, seconds: [("closed".to_owned(), seconds)].into_iter().collect() })
    }
}

/// Plans once for the observation at the start, and executes the plan to its end.
fn once(
    planner: &Planner,
    library: &ToolLibrary,
    task: &Task,
    truth: &Truth,
) -> Result<Left, SolveError> {
    let mut world = SimulatedWorld::new(truth.clone()).pushed_with(task.robot.max_force);
    let mut start = task.scene.start();
    if let Ok(look) = world.look() {
        for (pose, sight) in start.poses.iter_mut().zip(&look.seen) {
            let Some(sight) = sight else { continue };
            pose.position = sight.position;
            let turn = sight.heading.map_or(0.0, |seen| wrap_angle(seen - pose.heading));
            pose.heading += turn;
        }
    }
    let mut scene: Scene = task.scene.clone();
    scene.joints = pushplan_act::belief::carried(&task.scene.joints, &task.scene, &start);
    for (object, pose) in scene.objects.iter_mut().zip(&start.poses) {
        object.pose = *pose;
    }
    let solution = planner.solve_from(&Situation::stated(&scene), task, library, &NoProgress)?;
    let best = solution.best().filter(|best| !best.plan.is_empty());
    let sound = best.is_none_or(|best| world.act(&best.plan.motion(best.tool())).is_ok());
    Ok(Left::of(&task.goals[0], world.state(), sound))
}

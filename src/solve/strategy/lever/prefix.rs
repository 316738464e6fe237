//! First steps of a plan, and the state that they leave.

use std::sync::Arc;

use crate::asset::ToolLibrary;
use crate::geometry::Pose3;
use crate::outcome::{Outcome, Record, Trajectory};
use crate::progress::{Instant, NoProgress};
use crate::scene::{Situation, Tool};
use crate::sim::LeverSimulator;
use crate::solve::SolveError;
use crate::solve::attempts::Attempt;
use crate::solve::blackboard::Blackboard;
use crate::solve::lever_batch::LeverPlan;
use crate::task::{Plan, Task};

/// First steps of a plan, with their tools.
#[derive(Default)]
pub(super) struct Prefix {
    pub plan: Plan,
    pub tools: Vec<Arc<Tool>>,
}

impl Prefix {
    /// Returns the tools of the prefix and `more`, each once.
    pub fn with(&self, more: &[Arc<Tool>]) -> Vec<Arc<Tool>> {
        let mut tools = self.tools.clone();
        for tool in more {
            if !tools.iter().any(|known| known.name == tool.name) {
                tools.push(Arc::clone(tool));
            }
        }
        tools
    }

    /// Returns the poses of all objects after the nominal prefix.
    pub fn rests(&self, task: &Task) -> Option<Vec<Pose3>> {
        simulated(LeverSimulator::FINE, task, &self.plan, &self.tools)?.outcome().space.clone()
    }
}

/// Returns the poses of all objects at the start.
pub(super) fn start(task: &Task) -> Vec<Pose3> {
    task.scene.plates().map(|plate| plate.start()).collect()
}

/// Returns the remaining pushing task once all objects rest at `rests`, if it can be stated.
pub(super) fn pushing_task(task: &Task, rests: &[Pose3], library: &ToolLibrary) -> Option<Task> {
    let left = task.after(rests)?;
    Some(Task { tools: task.pushers(library), ..left })
}

/// Returns `prefix` with the pushes that bring the object from `rests` to its place. Returns `None`
/// if no such pushes are found.
pub(super) fn pushed(
    board: &mut Blackboard,
    library: &ToolLibrary,
    prefix: &Prefix,
    rests: &[Pose3],
) -> Result<Option<LeverPlan>, SolveError> {
    let query = board.query;
    let began = Instant::now();
    board.reporter.stage("pushes");
    let Some(left) = pushing_task(query.task, rests, library) else { return Ok(None) };
    let pushed = query.planner.solve_with(&left, library, query.progress)?;
    board.timing.refinement += began.elapsed().as_secs_f64();
    let Some(best) = pushed.best() else { return Ok(None) };
    let plan = prefix.plan.clone().then(best.plan.clone());
    let tools = prefix.with(&best.tools);
    Ok(coarse(query.task, &plan, &tools).map(|trajectory| {
        let outcome = Outcome::judge(&query.task.scene, query.task, &trajectory);
        let attempt = Attempt::simulated(plan, tools, (trajectory, outcome));
        LeverPlan { attempt, kind: (0, 0, 0, 0), promising: true }
    }))
}

/// Simulates a plan as written at coarse resolution.
pub(super) fn coarse(task: &Task, plan: &Plan, tools: &[Arc<Tool>]) -> Option<Trajectory> {
    simulated(LeverSimulator::COARSE, task, plan, tools)
}

/// Simulates a plan as written.
fn simulated(
    engine: LeverSimulator,
    task: &Task,
    plan: &Plan,
    tools: &[Arc<Tool>],
) -> Option<Trajectory> {
    let motions = plan.motions(tools)?;
    let watched = (Record::Outcome, &NoProgress as _);
    Some(engine.run_all(&Situation::stated(&task.scene), &task.scene, &motions, watched))
}

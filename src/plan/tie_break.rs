//! Which of several plans that are as good is preferred: stated here, once.
//!
//! Among plans with the same verdict and robustness, in this order: fewer pushes, as longer plans are only
//! looked for where no shorter one is safe; the cheaper tool; less moved besides what has a goal; the simpler
//! tool; the smaller error. Errors well inside the tolerance are no reason to prefer one: models differ by
//! as much.

use std::cmp::Ordering;
use std::sync::Arc;

use crate::scene::{JointKind, Situation, Tool};

use super::{Evaluation, Refined, Workspace};

/// Predictions within this share of the tolerance are equally near: a quarter, where half is still well
/// inside in another engine.
pub const NEAR: f64 = 0.25;

/// What is moved by so much is counted, metres: less is what models differ by.
const COUNTED: f64 = 0.01;

/// What a plan costs besides its pushes; compared in this order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cost {
    /// Returns the number of tool changes.
    changes: usize,
    /// What its tools cost in the task, in thousandths.
    tools: u64,
    /// By how much all that has no goal is moved, in whole units of [`COUNTED`].
    moved: usize,
    /// Pieces of the tools, flush parts taken together: a bar in four parts is a bar.
    pieces: usize,
}

impl Cost {
    /// Of a plan as it is predicted.
    pub fn of(plan: &Evaluation, workspace: &Workspace, situation: &Situation) -> Self {
        // What is one with an object that has a goal moves with it.
        let rigid = situation.physics.groups(|joint| joint.kind == JointKind::Fixed);
        let goals: Vec<usize> =
            workspace.task.goals.iter().map(|goal| rigid[goal.object]).collect();
        let before = &situation.start.poses;
        let others =
            situation.scene.things().map(|(k, _)| k).filter(|k| !goals.contains(&rigid[*k]));
        let ways = others.map(|k| (plan.outcome.poses[k].position - before[k].position).norm());
        let moved = (ways.sum::<f64>() / COUNTED).round() as usize;
        let tools = plan.tools(workspace);
        let cost = |tool: &Arc<Tool>| workspace.task.tool_costs.get(&tool.name).copied();
        let cost: f64 = tools.iter().filter_map(cost).sum();
        Self {
            changes: plan.candidate.tool_changes(),
            tools: (1e3 * cost).round() as u64,
            moved,
            pieces: tools.iter().map(|tool| tool.outline().len()).sum(),
        }
    }
}

/// Compares refined plans of one length, the preferred one being less: by predicted score on the worst
/// support, and near ones by their cost.
pub fn preferred(
    a: &Refined,
    b: &Refined,
    workspace: &Workspace,
    situation: &Situation,
) -> Ordering {
    let far = |one: &Refined| if one.worst <= NEAR { 0.0 } else { one.worst };
    let cost = |one: &Refined| Cost::of(&one.best, workspace, situation);
    let near = far(a).total_cmp(&far(b)).then_with(|| cost(a).cmp(&cost(b)));
    near.then(a.worst.total_cmp(&b.worst))
}

/// Sorts refined plans as they are verified: the preferred one, next to it the nearest, which most likely
/// works, and then the others as they are [`preferred`]. Equal ones keep their order.
pub fn in_order(refined: &mut [Refined], workspace: &Workspace, situation: &Situation) {
    refined.sort_by(|a, b| preferred(a, b, workspace, situation));
    let nearest = (0..refined.len()).min_by(|a, b| refined[*a].worst.total_cmp(&refined[*b].worst));
    if let Some(nearest) = nearest.filter(|nearest| *nearest > 1) {
        refined[1..=nearest].rotate_right(1);
    }
}

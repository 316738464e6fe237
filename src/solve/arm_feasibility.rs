//! Feasibility of plans for a robot arm: an infeasible plan is not verified.

use crate::plan::Evaluation;
use crate::scene::{ArmFault, JointTrajectory};
use crate::verify;

use super::RankedPlan;
use super::query::Query;

/// Returns the reason why the task's arm, if any, cannot execute a plan, with objects at their
/// predicted poses.
pub(super) fn arm_fault(query: &Query, evaluation: &Evaluation) -> Option<ArmFault> {
    let (task, workspace) = (query.task, query.workspace());
    let arm = task.arm.as_deref()?;
    let (tools, plan) = (evaluation.tools(&workspace), evaluation.plan(&workspace));
    // Between pushes, the objects are assumed near their start poses.
    let mut states = vec![query.situation.start.clone(); plan.steps.len()];
    states.push(evaluation.outcome.clone());
    let scene = &*query.situation.scene;
    arm.follow(task, scene, &tools[0], &plan, &states).err().map(|(_, fault)| fault)
}

/// Returns the joint trajectory for a plan, if the task has an arm.
pub(super) fn joints(query: &Query, ranked: &RankedPlan) -> Option<JointTrajectory> {
    if ranked.plan.is_empty() {
        return None;
    }
    let evidence = ranked.verdict.as_ref().map_or(&[][..], |verdict| &verdict.evidence);
    let (task, situation) = (query.task, query.situation);
    verify::joints(task, situation, &ranked.tools[0], &ranked.plan, evidence)?.ok()
}

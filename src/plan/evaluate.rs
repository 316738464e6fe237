//! Evaluation of candidates: pushes are placed one after another, and each is rolled out from the
//! state left by the previous one.

use std::sync::Arc;

use crate::effect::Job;
use crate::{
    outcome::{Record, Spread},
    scene::{State, Tool},
    task::{Plan, Push, PushRules, PushStep, Step, ToolMotion},
};

use super::rollouts::single_push;
use super::score::{behind, final_score, is_behind};
use super::{Candidate, CandidatePush, Infeasible, Margins, Rollouts, Workspace};

/// Candidate with placed pushes and a predicted outcome.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// The candidate.
    pub candidate: Candidate,
    /// Pushes as motions of the end effector.
    pub pushes: Vec<Push>,
    /// Margins by which each push satisfies the rules.
    pub margins: Vec<Margins>,
    /// Predicted state at rest.
    pub outcome: State,
    /// Expected error of the final pose of the goal's object after the last push, if the model
    /// estimates it.
    pub spread: Option<Spread>,
    /// Predicted error in units of the tolerance. It is infinite if the outcome is invalid, and
    /// behind all others (see [`super::is_behind`]) if the motion was blocked.
    pub score: f64,
}

impl Evaluation {
    /// Returns `true` if every push satisfies every rule.
    pub fn is_feasible(&self) -> bool {
        self.margins.iter().all(|margins| margins.violation().is_none())
    }

    /// Returns `true` if the outcome is valid and the motion was not blocked.
    pub fn is_sound(&self) -> bool {
        self.score.is_finite() && !is_behind(self.score)
    }

    /// Returns the tools in the order of their first use.
    pub fn tools(&self, workspace: &Workspace) -> Vec<Arc<Tool>> {
        let mut used: Vec<usize> = Vec::new();
        for push in &self.candidate.pushes {
            if !used.contains(&push.tool) {
                used.push(push.tool);
            }
        }
        // Without pushes, one tool has to stand still.
        let none = if used.is_empty() { workspace.tools.first() } else { None };
        let used = used.into_iter().map(|tool| &workspace.tools[tool]);
        used.chain(none).map(Arc::clone).collect()
    }

    /// Returns the plan with these pushes.
    pub fn plan(&self, workspace: &Workspace) -> Plan {
        let PushRules { form, lift, .. } = workspace.task.pushes;
        let step = |(planned, push): (&CandidatePush, &Push)| {
            let tool = workspace.tools[planned.tool].name.clone();
            Step::Push(PushStep { tool, grip_yaw: planned.grip_yaw, form, lift, push: *push })
        };
        Plan { steps: self.candidate.pushes.iter().zip(&self.pushes).map(step).collect() }
    }

    /// Returns the tool motions in order.
    pub fn motions(&self, workspace: &Workspace) -> Vec<ToolMotion> {
        self.plan(workspace).slides(&self.tools(workspace)).unwrap_or_default()
    }
}

/// Places and rolls out every candidate, in batches over all of them.
///
/// A placed candidate of n pushes costs n rollouts of one push each; a chained candidate costs one
/// rollout of the whole motion. Results are in the order of the candidates.
///
/// # Errors
/// Returns, for each candidate, the reason why a push could not be placed. A violation of reach or
/// clearance is a negative margin and no error, so that refinement can still learn from the
/// outcome.
pub fn evaluate(
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    candidates: &[Candidate],
) -> Vec<Result<Evaluation, Infeasible>> {
    let start = rollouts.situation().start.clone();
    let mut results: Vec<Result<Evaluation, Infeasible>> = candidates
        .iter()
        .map(|candidate| {
            Ok(Evaluation {
                candidate: candidate.clone(),
                pushes: Vec::with_capacity(candidate.pushes.len()),
                margins: Vec::with_capacity(candidate.pushes.len()),
                outcome: start.clone(),
                spread: None,
                score: workspace.task.score(&start),
            })
        })
        .collect();
    let longest = candidates.iter().map(|c| c.pushes.len()).max().unwrap_or(0);
    if workspace.is_placed() {
        for stage in 0..longest {
            advance(workspace, rollouts, &mut results, stage);
        }
    } else {
        for stage in 0..longest {
            for result in &mut results {
                add_push(workspace, result, stage);
            }
        }
        run(workspace, rollouts, &mut results, |evaluation, workspace| {
            evaluation.motions(workspace).pop()
        });
    }
    results
}

/// Places and rolls out the push with index `stage` of every candidate.
fn advance(
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    results: &mut [Result<Evaluation, Infeasible>],
    stage: usize,
) {
    for result in results.iter_mut() {
        add_push(workspace, result, stage);
    }
    run(workspace, rollouts, results, |evaluation, workspace| {
        let push = evaluation.pushes.get(stage)?;
        let planned = &evaluation.candidate.pushes[stage];
        Some(single_push(
            &workspace.tools[planned.tool],
            workspace.task.pushes.lift,
            planned.grip_yaw,
            push,
        ))
    });
}

fn add_push(workspace: &Workspace, result: &mut Result<Evaluation, Infeasible>, stage: usize) {
    let Ok(evaluation) = result else { return };
    let Some(planned) = evaluation.candidate.pushes.get(stage).copied() else { return };
    let previous = evaluation.pushes.last().map(Push::end);
    match workspace.place(&evaluation.outcome, &planned, previous) {
        Ok(placement) => {
            let push = Push {
                start: placement.start,
                direction: planned.direction,
                length: planned.length,
                speed: workspace.task.pushes.speed,
            };
            let set_down = (workspace.is_placed() || stage == 0).then_some(placement);
            let pushed = (&evaluation.outcome, planned.object);
            let margins = workspace.margins(planned.grip(), pushed, &push, set_down);
            evaluation.pushes.push(push);
            evaluation.margins.push(margins);
        }
        Err(reason) => *result = Err(reason),
    }
}

/// Rolls out the motion of every candidate that has one from its current outcome, and stores the
/// new outcome.
fn run(
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    results: &mut [Result<Evaluation, Infeasible>],
    motion: impl Fn(&Evaluation, &Workspace) -> Option<ToolMotion>,
) {
    let (indices, jobs): (Vec<usize>, Vec<Job>) = results
        .iter()
        .enumerate()
        .filter_map(|(k, result)| {
            let evaluation = result.as_ref().ok()?;
            let motion = motion(evaluation, workspace)?;
            Some((k, rollouts.job(motion, evaluation.outcome.clone())))
        })
        .unzip();
    let trajectories = rollouts.run(&jobs, Record::Outcome);
    for (k, trajectory) in indices.into_iter().zip(trajectories) {
        if let (Ok(evaluation), Some(frame)) = (&mut results[k], trajectory.frames.last()) {
            // An invalid push invalidates all later ones.
            if evaluation.score.is_finite() {
                let score = final_score(workspace.task, &trajectory);
                let blocked = is_behind(evaluation.score);
                evaluation.score = if blocked { behind(score) } else { score };
            }
            evaluation.outcome = frame.state.clone();
            let own = workspace.task.goals.iter();
            let own = own.filter_map(|goal| trajectory.spreads.get(goal.object).copied());
            let own = own.max_by(|a, b| a.within_90().position.total_cmp(&b.within_90().position));
            evaluation.spread = match (evaluation.spread, own) {
                // Errors of consecutive pushes add up.
                (Some(mut before), Some(own)) => {
                    before += own;
                    Some(before)
                }
                (before, own) => own.or(before),
            };
        }
    }
}

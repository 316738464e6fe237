//! What a candidate really does: its pushes placed one after another, each rolled out from where
//! the last one left the objects.

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

/// A candidate with its pushes placed and its outcome predicted.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// The candidate.
    pub candidate: Candidate,
    /// Its pushes, as the end effector makes them.
    pub pushes: Vec<Push>,
    /// Margins by which each push keeps the rules.
    pub margins: Vec<Margins>,
    /// Predicted state at rest.
    pub outcome: State,
    /// How far off the end of the goal's object is expected to be after the last push, if the model
    /// says so.
    pub spread: Option<Spread>,
    /// Predicted error in units of the tolerance; infinite if the outcome cannot count, and behind
    /// all others (see [`super::is_behind`]) if something could not pass on the way.
    pub score: f64,
}

impl Evaluation {
    /// Whether every push keeps every rule.
    pub fn is_feasible(&self) -> bool {
        self.margins.iter().all(|margins| margins.broken().is_none())
    }

    /// Whether the outcome counts, and nothing is in the way.
    pub fn is_sound(&self) -> bool {
        self.score.is_finite() && !is_behind(self.score)
    }

    /// Its tools, each once, in the order in which they are used.
    pub fn tools(&self, workspace: &Workspace) -> Vec<Arc<Tool>> {
        let mut used: Vec<usize> = Vec::new();
        for push in &self.candidate.pushes {
            if !used.contains(&push.tool) {
                used.push(push.tool);
            }
        }
        // Where nothing is pushed some tool has to stand still.
        let none = if used.is_empty() { workspace.tools.first() } else { None };
        let used = used.into_iter().map(|tool| &workspace.tools[tool]);
        used.chain(none).map(Arc::clone).collect()
    }

    /// The plan to make its pushes.
    pub fn plan(&self, workspace: &Workspace) -> Plan {
        let PushRules { form, lift, .. } = workspace.task.pushes;
        let step = |(planned, push): (&CandidatePush, &Push)| {
            let tool = workspace.tools[planned.tool].name.clone();
            Step::Push(PushStep { tool, grip_yaw: planned.grip_yaw, form, lift, push: *push })
        };
        Plan { steps: self.candidate.pushes.iter().zip(&self.pushes).map(step).collect() }
    }

    /// Returns the motions of its tools in order.
    pub fn motions(&self, workspace: &Workspace) -> Vec<ToolMotion> {
        self.plan(workspace).slides(&self.tools(workspace)).unwrap_or_default()
    }
}

/// Places and rolls out every candidate, in batches over all of them.
///
/// A placed candidate of n pushes costs n rollouts of one push each; a chained one costs one of
/// the whole motion. The answer's order is that of the candidates.
///
/// # Errors
/// Per candidate: why a push could not be placed. Broken reach or clearance is not an error here
/// but a negative margin, so that refinement can still learn from the outcome.
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

/// Places push number `stage` of every candidate and rolls it out.
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
        Ok(start) => {
            let push = Push {
                start,
                direction: planned.direction,
                length: planned.length,
                speed: workspace.task.pushes.speed,
            };
            let set_down = (workspace.is_placed() || stage == 0).then_some(planned.room);
            let pushed = (&evaluation.outcome, planned.object);
            let margins = workspace.margins(planned.grip(), pushed, &push, set_down);
            evaluation.pushes.push(push);
            evaluation.margins.push(margins);
        }
        Err(reason) => *result = Err(reason),
    }
}

/// Rolls out the motion of every candidate that has one, from its outcome so far, and keeps the
/// new one.
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
            // A push that could not count spoils those after it.
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
                // Errors of one push go on into the next.
                (Some(mut before), Some(own)) => {
                    before += own;
                    Some(before)
                }
                (before, own) => own.or(before),
            };
        }
    }
}

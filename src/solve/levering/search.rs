//! One lever-up: search with the model, coarse simulation of the best, verification in batches.

use std::collections::HashMap;
use std::sync::Arc;

use rayon::prelude::*;

use crate::plan::lever::{LeverCandidate, LeverSearch, ScoredLever, merit};
use crate::sim::LeverSimulator;
use crate::solve::{RankedPlan, Refinement};
use crate::watch::{Unwatched, Watch};
use crate::{
    outcome::{Outcome, Record, Trajectory},
    scene::{LeverScene, Scene, Situation, Tool},
    task::{Job, LeverMotion, LeverStep, Motion, Plan, Step, Task},
};

use super::doubt::doubted;
use super::steps::{Made, Steps};

/// What a candidate costs in rank whose coarse replays with small errors all miss the goal.
const DOUBTED: f64 = 2.0;

/// A candidate after coarse simulation.
pub(super) struct Simulated {
    pub scored: ScoredLever,
    pub trajectory: Trajectory,
    pub outcome: Outcome,
    merit: f64,
}

impl Steps<'_> {
    /// What comes of jobs by the model, or by coarse simulation where it leaves out something that
    /// matters.
    fn predict(&self, scene: &Scene, jobs: &[Job]) -> Vec<Trajectory> {
        let model = self.planner.screen();
        if jobs.iter().all(|job| model.takes(scene, job)) {
            model.rollout(scene, jobs, Record::Outcome)
        } else {
            let coarse = |job: &Job| simulated(scene, job.motion.clone());
            jobs.par_iter().map(coarse).collect()
        }
    }

    /// The best lever-ups of `task` after coarse simulation, best first.
    pub(super) fn look(&mut self, task: &Task, tools: &[Arc<Tool>]) -> Vec<Simulated> {
        let situation = Situation::stated(&task.scene);
        let search = LeverSearch { task, situation: &situation, tools };
        let predict = |jobs: &[Job]| self.predict(&task.scene, jobs);
        let (scored, found) = search.run(&predict, &|| self.until.cancelled());
        self.statistics.search = found;
        let chosen = self.choose(scored);
        self.statistics.simulated += chosen.len();
        self.simulate(task, tools, chosen)
    }

    /// How many lever-ups of `task` reach its goal by prediction.
    pub(super) fn promising(&self, task: &Task, tools: &[Arc<Tool>]) -> usize {
        let situation = Situation::stated(&task.scene);
        let search = LeverSearch { task, situation: &situation, tools };
        let predict = |jobs: &[Job]| self.predict(&task.scene, jobs);
        search.run(&predict, &|| self.until.cancelled()).1.promising
    }

    /// The best of different kinds: no more than an eighth of one while there are others.
    fn choose(&self, scored: Vec<ScoredLever>) -> Vec<ScoredLever> {
        let wanted = self.settings.simulated;
        let kinds: Vec<Kind> = scored.iter().map(|found| kind(&found.candidate)).collect();
        let all: Vec<usize> = (0..scored.len()).collect();
        let chosen = mixed(&all, &kinds, &[], wanted.div_ceil(8), wanted);
        let mut scored: Vec<Option<ScoredLever>> = scored.into_iter().map(Some).collect();
        chosen.into_iter().filter_map(|k| scored[k].take()).collect()
    }

    /// Coarse simulation, as planned and with small errors, and the ranking that follows.
    fn simulate(
        &self,
        task: &Task,
        tools: &[Arc<Tool>],
        chosen: Vec<ScoredLever>,
    ) -> Vec<Simulated> {
        let (doubts, engine) = (self.settings.doubts, LeverSimulator::COARSE);
        let mut simulated: Vec<Simulated> = chosen
            .into_par_iter()
            .map(|scored| {
                let (lever, tool) = (scored.candidate.lever, &tools[scored.candidate.tool]);
                let motion = [Motion::Lever(LeverMotion::new(Arc::clone(tool), lever, None))];
                let planned = LeverScene::with(&task.scene, tool);
                let run = |really: &LeverScene| {
                    let watched = (Record::Outcome, &Unwatched as _);
                    let trajectory = engine.run_all((really, &planned), None, &motion, watched);
                    let scene = Scene { obstacles: really.blocks.clone(), ..task.scene.clone() };
                    let outcome = Outcome::judge(&scene, task, &trajectory);
                    (trajectory, outcome)
                };
                let (trajectory, outcome) = run(&planned);
                let mut merit = merit(&task.goals[0], &outcome, &trajectory) + 1.0 - scored.company;
                if outcome.reached && doubts > 0 {
                    let missed = (0..doubts)
                        .filter(|&draw| !run(&doubted(&planned, lever.plate, draw)).1.reached);
                    merit += DOUBTED * missed.count() as f64 / doubts as f64;
                } else if !outcome.reached {
                    merit += DOUBTED;
                }
                Simulated { scored, trajectory, outcome, merit }
            })
            .collect();
        // Stable: the search decides between equals.
        simulated.sort_by(|a, b| a.merit.total_cmp(&b.merit));
        simulated
    }

    /// Verifies in batches those that reach the goal so far, until one passes; all of them ranked.
    /// Each comes after what was `made` before.
    pub(super) fn confirm(
        &mut self,
        task: &Task,
        tools: &[Arc<Tool>],
        made: &Made,
        simulated: Vec<Simulated>,
    ) -> Vec<RankedPlan> {
        let kinds: Vec<Kind> =
            simulated.iter().map(|found| kind(&found.scored.candidate)).collect();
        let ranked = |Simulated { scored, trajectory, outcome, .. }| {
            let tool = &tools[scored.candidate.tool];
            let lever = scored.candidate.lever;
            let expected = (!made.plan.is_empty()).then(|| task.scene.objects[lever.plate].pose);
            let step = Step::LeverUp(LeverStep { tool: tool.name.clone(), lever, expected });
            let plan = made.plan.clone().then(Plan { steps: vec![step] });
            self.ranked(plan, &made.with(std::slice::from_ref(tool)), trajectory, outcome)
        };
        let mut plans: Vec<RankedPlan> = simulated.into_iter().map(ranked).collect();
        let mut hopeful: Vec<usize> =
            (0..plans.len()).filter(|&k| plans[k].outcome.reached).collect();
        let mut tried: Vec<usize> = Vec::new();
        let at_once = self.settings.verified_at_once.max(1);
        for round in 1..=self.settings.verify_batches {
            // What failed does so for a reason that its kind shares.
            let batch = mixed(&hopeful, &kinds, &tried, 2 * round, at_once);
            if batch.is_empty() || self.until.cancelled() {
                break;
            }
            hopeful.retain(|k| !batch.contains(k));
            tried.extend(&batch);
            // The goal is that of this lever-up: what pushes are to bring comes later.
            let goal = Task { goals: task.goals.clone(), ..self.task.clone() };
            let verdicts: Vec<_> = batch
                .par_iter()
                .map(|&k| self.verify(&goal, &plans[k].plan, &plans[k].tools))
                .collect();
            self.statistics.verified += batch.len();
            for (&k, verdict) in batch.iter().zip(verdicts) {
                plans[k].verdict = Some(verdict);
            }
            let passed = |k: &usize| plans[*k].verdict.as_ref().is_some_and(|v| v.passed);
            if batch.iter().any(passed) {
                break;
            }
        }
        rank(&mut plans);
        plans
    }

    /// A plan that was not refined.
    pub(super) fn ranked(
        &self,
        plan: Plan,
        tools: &[Arc<Tool>],
        predicted: Trajectory,
        outcome: Outcome,
    ) -> RankedPlan {
        let error = outcome.error;
        let refinement =
            Refinement { before: error, after: error, aimed_at: None, rounds: Vec::new() };
        let tools = tools.to_vec();
        RankedPlan { plan, tools, predicted, outcome, verdict: None, refinement, joints: None }
    }
}

/// A motion in coarse simulation.
fn simulated(scene: &Scene, motion: Motion) -> Trajectory {
    let planned = LeverScene::with(scene, motion.tool());
    let watched = (Record::Outcome, &Unwatched as _);
    LeverSimulator::COARSE.run_all((&planned, &planned), None, &[motion], watched)
}

/// Orders plans: those that work by how often; then those that were tried, then the rest.
pub(super) fn rank(plans: &mut [RankedPlan]) {
    let grade = |plan: &RankedPlan| match &plan.verdict {
        Some(verdict) if verdict.works() => 2.0 + verdict.robustness.unwrap_or(0.0),
        Some(_) => 1.0,
        None => 0.0,
    };
    plans.sort_by(|a, b| grade(b).total_cmp(&grade(a)));
}

/// What candidates that are likely to fail together have in common: tool, edge, axis and turn.
type Kind = (usize, usize, usize, usize);

fn kind(candidate: &LeverCandidate) -> Kind {
    let [_, _, axis, turn] = candidate.cell;
    (candidate.tool, candidate.lever.place.edge, axis, turn)
}

/// The first `wanted` of `from`, with at most so many of a kind, those `tried` included, while there
/// are others.
fn mixed(
    from: &[usize],
    kinds: &[Kind],
    tried: &[usize],
    most: usize,
    wanted: usize,
) -> Vec<usize> {
    let mut counts: HashMap<Kind, usize> = HashMap::new();
    for &k in tried {
        *counts.entry(kinds[k]).or_default() += 1;
    }
    let (mut first, mut later) = (Vec::new(), Vec::new());
    for &k in from {
        let count = counts.entry(kinds[k]).or_default();
        *count += 1;
        if *count <= most { first.push(k) } else { later.push(k) }
    }
    first.extend(later);
    first.truncate(wanted);
    first
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_are_of_different_kinds_while_there_are_some() {
        let kinds = [0, 0, 0, 1, 0, 2].map(|turn| (0, 0, 0, turn));
        let all = [0, 1, 2, 3, 4, 5];
        assert_eq!(mixed(&all, &kinds, &[], 2, 4), [0, 1, 3, 5]);
        assert_eq!(mixed(&[2, 4, 5], &kinds, &[0, 1, 3], 2, 2), [5, 2]);
        assert_eq!(mixed(&all, &kinds, &[], 1, 9), [0, 3, 5, 1, 2, 4]);
    }
}

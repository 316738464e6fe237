//! The planner of lever-ups, and of pushes that follow.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::asset::ToolLibrary;
use crate::effect::{LeverModel, LeverTrust, SimulatedLevers};
use crate::plan::lever::{LeverCandidate, LeverSearch, ScoredLever, merit};
use crate::scene::{LeverJob, LeverOutcome, LeverPlan, LeverScene, LeverTrajectory, Task, Tool};
use crate::sim::LeverSimulator;
use crate::solve::{Effort, PlanStatus, SolveError};
use crate::verify::{LeverVerifier, VerifySettings};
use crate::watch::{Until, Unwatched, Watch};

use super::check::check;
use super::doubt::doubted;
use super::{LeverSettings, LeverSolution, LeverStatistics, RankedLever};

/// What a candidate costs in rank whose coarse replays with small errors all miss the goal.
const DOUBTED: f64 = 2.0;

/// Finds lever-ups for tasks of levering, with one model and one effort.
pub struct LeverPlanner {
    model: Arc<dyn LeverModel>,
    pub(super) effort: Effort,
    pub(super) settings: LeverSettings,
    pub(super) seed: u64,
    time_limit: Option<Duration>,
}

/// A candidate after coarse simulation.
struct Simulated {
    scored: ScoredLever,
    outcome: LeverOutcome,
    merit: f64,
}

impl LeverPlanner {
    /// A planner that searches with `model`.
    pub fn new(model: impl LeverModel + 'static, effort: Effort) -> Self {
        let settings = LeverSettings::for_effort(effort);
        Self { model: Arc::new(model), effort, settings, seed: 0, time_limit: None }
    }

    /// The same with budgets one by one. Pushes that follow are still planned with the effort.
    #[must_use]
    pub fn with_settings(self, settings: LeverSettings) -> Self {
        Self { settings, ..self }
    }

    /// The same with another seed of the disturbances than 0.
    #[must_use]
    pub fn seeded(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// The same, stopping after this time with the best plan so far.
    #[must_use]
    pub fn within(self, limit: Option<Duration>) -> Self {
        Self { time_limit: limit, ..self }
    }

    /// The budgets.
    pub fn settings(&self) -> &LeverSettings {
        &self.settings
    }

    /// The model.
    pub fn model(&self) -> &dyn LeverModel {
        &*self.model
    }

    /// Solves a task with the tools that it allows. Runs on the current rayon pool; the result is
    /// the same for any number of threads.
    ///
    /// # Errors
    /// [`SolveError`] for bad input only.
    pub fn solve(&self, task: &Task, library: &ToolLibrary) -> Result<LeverSolution, SolveError> {
        self.solve_with(task, library, &Unwatched)
    }

    /// [`LeverPlanner::solve`], telling `watch` what it does; stopped by it, the best plan so far
    /// comes back.
    ///
    /// # Errors
    /// [`SolveError`] for bad input only.
    pub fn solve_with(
        &self,
        task: &Task,
        library: &ToolLibrary,
        watch: &dyn Watch,
    ) -> Result<LeverSolution, SolveError> {
        let tools = task.blades(library)?;
        check(task, &tools)?;
        let until = Until::new(watch, self.time_limit);
        let lever_up = self.lever_up(task, &tools, &until);
        if task.pushes.max_count == 0 || lever_up.status == PlanStatus::Solved || until.cancelled()
        {
            return Ok(lever_up);
        }
        self.with_follow_up(task, library, lever_up, &until)
    }

    /// Solves a task by a lever-up alone.
    pub(super) fn lever_up(
        &self,
        task: &Task,
        tools: &[Arc<Tool>],
        until: &Until,
    ) -> LeverSolution {
        let mut statistics = LeverStatistics::default();
        let began = Instant::now();
        until.stage("searching");
        let scenes: Vec<Arc<LeverScene>> =
            tools.iter().map(|tool| Arc::new(LeverScene::with(&task.scene, tool))).collect();
        let search = LeverSearch { task, scenes: &scenes };
        let (scored, found) = search.run(&|jobs| self.predict(jobs), &|| until.cancelled());
        statistics.search = found;
        statistics.timing.search = began.elapsed().as_secs_f64();
        let simulating = Instant::now();
        until.stage("simulating");
        let simulated = self.simulate(task, &scenes, self.choose(scored));
        statistics.simulated = simulated.len();
        statistics.timing.simulation = simulating.elapsed().as_secs_f64();
        let verifying = Instant::now();
        until.stage("verifying");
        let plans = self.verify(task, tools, simulated, until);
        statistics.verified = plans.iter().filter(|plan| plan.verdict.is_some()).count();
        statistics.timing.verification = verifying.elapsed().as_secs_f64();
        statistics.timing.total = began.elapsed().as_secs_f64();
        LeverSolution { status: status(&plans), stopped: until.cancelled(), plans, statistics }
    }

    /// What comes of jobs by the model, or by coarse simulation where that leaves out something
    /// that matters.
    fn predict(&self, jobs: &[LeverJob]) -> Vec<LeverTrajectory> {
        let foreign = |job: &LeverJob| self.model.trust(job) == LeverTrust::NotMine;
        if jobs.iter().any(foreign) {
            SimulatedLevers { simulator: LeverSimulator::COARSE }.rollout(jobs)
        } else {
            self.model.rollout(jobs)
        }
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
        scenes: &[Arc<LeverScene>],
        chosen: Vec<ScoredLever>,
    ) -> Vec<Simulated> {
        let doubts = self.settings.doubts;
        let engine = LeverSimulator::COARSE;
        let mut simulated: Vec<Simulated> = chosen
            .into_par_iter()
            .map(|scored| {
                let (lever, scene) = (scored.candidate.lever, &scenes[scored.candidate.tool]);
                let job = LeverJob { scene: Arc::clone(scene), lever };
                let trajectory = engine.run(&job);
                let outcome = task.goal.judge_lever(scene, &lever, &trajectory);
                let mut merit = merit(&task.goal, &outcome, &trajectory) + 1.0 - scored.company;
                if outcome.reached && doubts > 0 {
                    let missed = (0..doubts).filter(|&draw| {
                        let really = Arc::new(doubted(scene, lever.plate, draw));
                        let job = LeverJob { scene: really, lever };
                        let trajectory = engine.run_as_planned(&job, scene);
                        !task.goal.judge_lever(&job.scene, &lever, &trajectory).reached
                    });
                    merit += DOUBTED * missed.count() as f64 / doubts as f64;
                } else if !outcome.reached {
                    merit += DOUBTED;
                }
                Simulated { scored, outcome, merit }
            })
            .collect();
        // Stable: the search decides between equals.
        simulated.sort_by(|a, b| a.merit.total_cmp(&b.merit));
        simulated
    }

    /// Verifies in batches those that reach the goal so far, until one passes; all of them ranked.
    fn verify(
        &self,
        task: &Task,
        tools: &[Arc<Tool>],
        simulated: Vec<Simulated>,
        watch: &dyn Watch,
    ) -> Vec<RankedLever> {
        let by = SimulatedLevers { simulator: LeverSimulator::COARSE }.name();
        let kinds: Vec<Kind> =
            simulated.iter().map(|found| kind(&found.scored.candidate)).collect();
        let mut plans: Vec<RankedLever> = simulated
            .into_iter()
            .map(|Simulated { scored, outcome, merit }| {
                let tool = Arc::clone(&tools[scored.candidate.tool]);
                let lever = scored.candidate.lever;
                let plan = LeverPlan { tool: tool.name.clone(), lever, follow_up: None };
                let (by, pushed) = (by.clone(), None);
                RankedLever { plan, tool, predicted: outcome, by, merit, verdict: None, pushed }
            })
            .collect();
        let settings = VerifySettings { disturbed: self.settings.disturbed, seed: self.seed };
        let verifier = LeverVerifier::new(settings);
        let mut hopeful: Vec<usize> =
            (0..plans.len()).filter(|&k| plans[k].predicted.reached).collect();
        let mut tried: Vec<usize> = Vec::new();
        let at_once = self.settings.verified_at_once.max(1);
        for round in 1..=self.settings.verify_batches {
            // What failed does so for a reason that its kind shares.
            let batch = mixed(&hopeful, &kinds, &tried, 2 * round, at_once);
            if batch.is_empty() || watch.cancelled() {
                break;
            }
            hopeful.retain(|k| !batch.contains(k));
            tried.extend(&batch);
            let verdicts: Vec<_> = batch
                .par_iter()
                .map(|&k| {
                    let RankedLever { plan, tool, .. } = &plans[k];
                    let nominal = verifier.nominal(task, tool, plan);
                    match nominal.passed {
                        true => verifier.disturb(task, tool, plan, nominal),
                        false => nominal,
                    }
                })
                .collect();
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
}

/// Orders plans: those that work by how often; then those that were tried, then the rest.
pub(super) fn rank(plans: &mut [RankedLever]) {
    let grade = |plan: &RankedLever| match &plan.verdict {
        Some(verdict) if verdict.works() => 2.0 + verdict.robustness.unwrap_or(0.0),
        Some(_) => 1.0,
        None => 0.0,
    };
    plans.sort_by(|a, b| grade(b).total_cmp(&grade(a)));
}

/// How solving ended, by its plans.
pub(super) fn status(plans: &[RankedLever]) -> PlanStatus {
    let verdicts = || plans.iter().filter_map(|plan| plan.verdict.as_ref());
    if verdicts().any(|verdict| verdict.passed) {
        PlanStatus::Solved
    } else if verdicts().any(|verdict| verdict.works()) {
        PlanStatus::Fragile
    } else if verdicts().next().is_some() {
        PlanStatus::FailedVerification
    } else {
        PlanStatus::NoPlan
    }
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

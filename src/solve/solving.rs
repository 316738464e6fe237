//! One task being solved: the loop over lengths of plans.

use std::sync::Arc;
use std::time::Instant;

use rayon::prelude::*;

use crate::plan::{
    Candidate, Evaluation, RefineSettings, Refined, Rollouts, Search, Workspace, refine,
};
use crate::scene::{Goal, Job, Plan, Situation, Task, Tool, Verdict};
use crate::verify::{Verifier, VerifySettings};
use crate::watch::Watch;

use super::planner::typical;
use super::rank::{is_worth_verifying, sort};
use super::reconsider::Way;
use super::{PlanStatus, Planner, RankedPlan, Refinement, Solution, Statistics};

/// The stand-off of later pushes grows by the model's error, but by no more than this, metres:
/// a longer approach costs reach and time.
const MOST_LATER_STAND_OFF: f64 = 0.02;

/// At most this many plans come back: what a reader looks at.
const REPORTED: usize = 8;

/// A plan that was refined, and verified where it was worth that.
pub(super) struct Tried {
    pub plan: Plan,
    pub tool: Arc<Tool>,
    /// What the plan was made from; `None` for the plan without pushes.
    pub candidate: Option<Candidate>,
    /// What it was refined towards: the task's goal, or one beside it.
    pub aim: Goal,
    pub refinement: Refinement,
    pub score: f64,
    pub verdict: Option<Verdict>,
}

pub(super) struct Solving<'a> {
    pub planner: &'a Planner,
    pub task: &'a Task,
    pub situation: &'a Situation,
    pub workspace: Workspace<'a>,
    pub rollouts: Rollouts<'a>,
    verifier: Verifier,
    watch: &'a dyn Watch,
    pub statistics: Statistics,
    pub tried: Vec<Tried>,
    /// What replays have shown not to work.
    pub refuted: Vec<Way>,
}

impl<'a> Solving<'a> {
    pub fn new(
        planner: &'a Planner,
        task: &'a Task,
        situation: &'a Situation,
        tools: &'a [Arc<Tool>],
        watch: &'a dyn Watch,
    ) -> Self {
        let (model, settings) = (planner.model(), planner.settings());
        let errors = tools.iter().map(|tool| {
            let job = Job::new(situation, typical(task, &situation.start, tool));
            error_p95(planner, situation, &job).unwrap_or(f64::INFINITY)
        });
        let later_stand_off = errors.fold(0.0, f64::max).min(MOST_LATER_STAND_OFF);
        let verify = VerifySettings { disturbed: settings.disturbed, seed: planner.seed() };
        Self {
            planner,
            task,
            situation,
            workspace: Workspace { task, tools, later_stand_off },
            rollouts: Rollouts::new(model, situation.clone()),
            verifier: Verifier::new(verify),
            watch,
            statistics: Statistics::default(),
            tried: Vec::new(),
            refuted: Vec::new(),
        }
    }

    pub fn run(mut self) -> Solution {
        let began = Instant::now();
        let nothing = self.without_pushes();
        let reached = self.task.goal.reached(&self.situation.start);
        self.tried.push(nothing);
        let mut winner = reached.then_some(0);
        let mut search =
            Search::new(self.workspace, self.situation, self.planner.settings().search());
        while winner.is_none() && search.can_deepen() {
            winner = self.attempt(&mut search);
        }
        if let Some(index) = winner {
            let since = Instant::now();
            let Tried { plan, tool, verdict, .. } = &mut self.tried[index];
            let verdict = verdict.get_or_insert_with(|| {
                self.verifier.nominal(self.task, self.situation, tool, plan)
            });
            self.verifier.disturb(self.task, self.situation, tool, plan, verdict);
            self.statistics.timing.verification += since.elapsed().as_secs_f64();
        }
        let status = match winner {
            Some(_) => PlanStatus::Solved,
            None if self.tried.iter().any(|tried| tried.verdict.is_some()) => {
                PlanStatus::FailedVerification
            }
            None => PlanStatus::NoPlan,
        };
        self.statistics.search = search.statistics().clone();
        self.statistics.depth = search.depth();
        self.report(status, winner, began)
    }

    /// Searches, refines and verifies plans of one push more; the index of the first that
    /// passes.
    fn attempt(&mut self, search: &mut Search) -> Option<usize> {
        let settings = *self.planner.settings();
        let pushes = search.depth() + 1;
        let began = Instant::now();
        self.tell("search", pushes);
        let found = search.deepen(&mut self.rollouts, self.watch);
        self.statistics.timing.search += began.elapsed().as_secs_f64();

        let began = Instant::now();
        let candidates = self.choose(&found, settings.refined, &[]);
        let first = self.tried.len();
        let mut queue = self.refined(&candidates, self.task.goal, pushes);
        self.statistics.timing.refinement += began.elapsed().as_secs_f64();

        let (mut passed, mut failed) = (None, Vec::new());
        let at_once = settings.verified_at_once.max(1);
        for batch in 0..settings.verify_batches {
            if batch > 0 {
                let began = Instant::now();
                self.reconsider(&mut queue, &failed, &found, (first, pushes));
                self.statistics.timing.refinement += began.elapsed().as_secs_f64();
            }
            let indices: Vec<usize> = queue.drain(..queue.len().min(at_once)).collect();
            if indices.is_empty() {
                break;
            }
            let began = Instant::now();
            let left = settings.verify_batches * at_once;
            self.tell("verify", pushes);
            self.watch.progress((batch * at_once) as u64, left as u64);
            passed = self.verify(&indices);
            self.statistics.timing.verification += began.elapsed().as_secs_f64();
            if passed.is_some() {
                break;
            }
            failed = indices;
        }
        passed
    }

    /// Says what is done to plans of so many pushes.
    fn tell(&self, stage: &str, pushes: usize) {
        let s = if pushes == 1 { "" } else { "es" };
        self.watch.stage(&format!("{stage}, plans of {pushes} push{s}"));
    }

    /// Refines candidates towards `aim`, the task's goal or one beside it, keeps what came out, and
    /// gives the indices of what is worth verifying, best first.
    pub(super) fn refined(
        &mut self,
        candidates: &[Candidate],
        aim: Goal,
        pushes: usize,
    ) -> Vec<usize> {
        let task = Task { goal: aim, ..self.task.clone() };
        let settings = *self.planner.settings();
        self.tell("refine", pushes);
        let refine_settings = RefineSettings {
            rounds: settings.refine_rounds,
            extra: settings.refine_extra,
            // Another stream for every length, so that no two share their samples.
            seed: self.planner.seed().wrapping_mul(0x9E37_79B9).wrapping_add(pushes as u64) << 16,
            enough: settings.verified_at_once,
        };
        let mut refined = refine(
            &Workspace { task: &task, ..self.workspace },
            &mut self.rollouts,
            candidates,
            refine_settings,
            &mut self.statistics.refinement,
            self.watch,
        );
        sort(&mut refined);
        let mut worth = Vec::new();
        for refined in refined {
            let tool = &self.workspace.tools[refined.best.candidate.tool];
            let motion = self.plan(tool, &refined.best).motion(tool);
            let error = error_p95(self.planner, self.situation, &Job::new(self.situation, motion));
            if is_worth_verifying(&self.situation.scene, &aim, &refined.best, error) {
                worth.push(self.tried.len());
            }
            let tried = self.tried(refined, aim);
            self.tried.push(tried);
        }
        worth
    }

    /// Verifies plans in parallel; the first that passes.
    fn verify(&mut self, indices: &[usize]) -> Option<usize> {
        let verdicts: Vec<Verdict> = indices
            .par_iter()
            .map(|&k| {
                let Tried { tool, plan, .. } = &self.tried[k];
                self.verifier.nominal(self.task, self.situation, tool, plan)
            })
            .collect();
        self.statistics.verified += indices.len();
        let passed = verdicts.iter().position(|verdict| verdict.passed).map(|k| indices[k]);
        for (&k, verdict) in indices.iter().zip(verdicts) {
            self.tried[k].verdict = Some(verdict);
        }
        passed
    }

    fn tried(&self, refined: Refined, aim: Goal) -> Tried {
        let error = |evaluation: &Evaluation| self.task.goal.error(&evaluation.outcome);
        let Refined { before, best, rounds } = refined;
        let tool = Arc::clone(&self.workspace.tools[best.candidate.tool]);
        Tried {
            refinement: Refinement {
                before: error(&before),
                after: error(&best),
                aimed_at: (aim != self.task.goal).then_some(aim.position),
                rounds,
            },
            aim,
            // Of our goal, whatever goal it was refined towards.
            score: if best.score.is_finite() {
                self.task.goal.score(&best.outcome)
            } else {
                best.score
            },
            verdict: None,
            plan: self.plan(&tool, &best),
            tool,
            candidate: Some(best.candidate),
        }
    }

    fn plan(&self, tool: &Tool, evaluation: &Evaluation) -> Plan {
        Plan {
            tool: tool.name.clone(),
            grip_yaw: evaluation.candidate.grip_yaw,
            form: self.task.pushes.form,
            lift: self.task.pushes.lift,
            pushes: evaluation.pushes.clone(),
        }
    }

    /// Doing nothing, which is a plan too.
    fn without_pushes(&self) -> Tried {
        let (start, rules) = (&self.situation.start, &self.task.pushes);
        let error = self.task.goal.error(start);
        let tool = Arc::clone(&self.workspace.tools[0]);
        Tried {
            plan: Plan {
                tool: tool.name.clone(),
                grip_yaw: rules.grip_yaws.first().copied().unwrap_or_default(),
                form: rules.form,
                lift: rules.lift,
                pushes: Vec::new(),
            },
            tool,
            candidate: None,
            aim: self.task.goal,
            refinement: Refinement {
                before: error,
                after: error,
                aimed_at: None,
                rounds: Vec::new(),
            },
            score: self.task.goal.score(start),
            verdict: None,
        }
    }

    fn report(mut self, status: PlanStatus, winner: Option<usize>, began: Instant) -> Solution {
        // The winner; then those that passed, are untried, have failed - or, where none passed,
        // the evidence first.
        let rank = |index: usize, tried: &Tried| match (&tried.verdict, status) {
            _ if Some(index) == winner => 0,
            (Some(verdict), PlanStatus::Solved) => {
                if verdict.passed {
                    1
                } else {
                    3
                }
            }
            (Some(_), _) => 1,
            (None, _) => 2,
        };
        let mut order: Vec<(usize, Tried)> = std::mem::take(&mut self.tried)
            .into_iter()
            .enumerate()
            .map(|(index, tried)| (rank(index, &tried), tried))
            .collect();
        order.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.score.total_cmp(&b.1.score)));
        order.truncate(REPORTED);
        let plans: Vec<(&Plan, &Arc<Tool>)> =
            order.iter().map(|(_, t)| (&t.plan, &t.tool)).collect();
        let predictions = self.planner.predict_all(self.task, self.situation, &plans);
        self.statistics.rollouts = self.rollouts.used() + plans.len();
        let warnings = predictions.first().map(|p| p.warnings.clone()).unwrap_or_default();
        let plans = order
            .into_iter()
            .zip(predictions)
            .map(|((_, tried), prediction)| RankedPlan {
                plan: tried.plan,
                tool: tried.tool,
                predicted: prediction.trajectory,
                outcome: prediction.outcome,
                verdict: tried.verdict,
                refinement: tried.refinement,
            })
            .collect();
        self.statistics.timing.total = began.elapsed().as_secs_f64();
        Solution { status, plans, statistics: self.statistics, warnings }
    }
}

/// 95th percentile of the effect model's error on pushes like this one, metres, if it was measured.
fn error_p95(planner: &Planner, situation: &Situation, job: &Job) -> Option<f64> {
    planner.model().trust(&situation.scene, job).error().map(|error| error.p95)
}

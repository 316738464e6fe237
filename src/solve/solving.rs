//! One task being solved: the loop over lengths of plans.

use std::sync::Arc;

use rayon::prelude::*;

use crate::plan::{
    Candidate, FOUND_RADIUS, REFINABLE, RefineSettings, Refined, Rollouts, ScoredPush, Search,
    SearchResult, Workspace, alone, bare, in_order, is_behind, refine,
};
use crate::verify::{Verifier, VerifySettings};
use crate::watch::{Instant, Watch};
use crate::{
    outcome::Verdict,
    scene::{ArmFault, Situation, Tool},
    task::{Goal, Job, Task},
};

use super::attempts::{Attempt, after};
use super::grade::{Class, Grade};
use super::progress::Milestone;
use super::rank::is_worth_verifying;
use super::retry::PushPattern;
use super::typical::{error_p95, typical};
use super::{PlanStatus, Planner, Solution, Statistics};

/// Later pushes get room for the model's error, but no more than this, metres: a longer approach
/// costs reach and time.
const MOST_ROOM_FOR_MODEL: f64 = 0.02;

/// Rollouts that a refinement gets, times the objects on the table. A push into a crowd costs up to
/// a hundred times one of a single object, and its outcome is not smooth enough for late rounds to
/// gain much; with up to four objects the rounds end first.
pub(super) const REFINE_WORK: usize = 20_000;

/// Sets the samples of the model that decides apart from those of the one that screens.
const DECIDING: u64 = 1 << 15;

/// Trust radius, in steps, for what was refined with another model: its optimum is off by as much as
/// the two differ.
pub(super) const SCREENED_RADIUS: f64 = 1.0;

/// How many of the plans that were replayed together and work are replayed with disturbances, best
/// first: the others miss by more.
const DISTURBED_AT_ONCE: usize = 3;

/// Of the plans of one length that may be verified, the share that is replayed with disturbances, at
/// most: where so many work and none is safe, the task is a fragile one, and these replays are most
/// of its cost.
const DISTURBED_SHARE: f64 = 0.375;

/// Plans of more pushes are not searched for, only made after legs: they cost more with every push.
const LONGEST: usize = 8;

pub(super) struct Solving<'a> {
    pub planner: &'a Planner,
    pub task: &'a Task,
    pub situation: &'a Situation,
    pub workspace: Workspace<'a>,
    /// Of the model that screens.
    pub rollouts: Rollouts<'a>,
    /// Of the one that decides, if that is another.
    pub deciding: Option<Rollouts<'a>>,
    pub verifier: Verifier<'a>,
    pub watch: &'a dyn Watch,
    pub statistics: Statistics,
    /// What the search made of every way to push.
    pub candidates: Vec<ScoredPush>,
    pub tried: Vec<Attempt>,
    /// Plans that were replayed with disturbances.
    disturbed: usize,
    /// What the arm cannot do, of the first plan that was not verified for that.
    pub unable: Option<ArmFault>,
    /// What replays have shown not to work.
    pub refuted: Vec<PushPattern>,
    /// The best plan that was replayed with disturbances.
    pub best: Option<(Grade, usize)>,
    /// What was told of the best plan so far.
    pub known: Option<Milestone>,
    /// Where nothing is to be verified: whether any plan would be worth it. The search ends with the first.
    pub promising: Option<bool>,
}

impl<'a> Solving<'a> {
    pub fn new(
        planner: &'a Planner,
        task: &'a Task,
        situation: &'a Situation,
        tools: &'a [Arc<Tool>],
        watch: &'a dyn Watch,
    ) -> Self {
        let settings = planner.settings();
        let rollouts = |model| Rollouts::new(model, situation.clone());
        let verify = VerifySettings { disturbed: settings.disturbed, seed: planner.seed() };
        Self {
            planner,
            task,
            situation,
            workspace: Workspace { task, tools },
            rollouts: rollouts(planner.screen()),
            deciding: planner.is_screened().then(|| rollouts(planner.model())),
            verifier: Verifier::new(verify).watched(watch),
            watch,
            statistics: Statistics::default(),
            candidates: Vec::new(),
            tried: Vec::new(),
            disturbed: 0,
            unable: None,
            refuted: Vec::new(),
            best: None,
            known: None,
            promising: None,
        }
    }

    pub fn run(mut self) -> Solution {
        let began = Instant::now();
        let nothing = self.without_pushes();
        self.tried.push(nothing);
        if self.task.reached(&self.situation.start) {
            self.verify(&[0]);
        }
        let search = self.search();
        self.settle(Class::Fragile);
        let status = match self.best {
            Some((grade, _)) if grade.class > Class::Fails => grade.class.status(),
            _ if self.tried.iter().any(|tried| tried.verdict.is_some()) => {
                PlanStatus::FailedVerification
            }
            _ => PlanStatus::NoPlan,
        };
        let best = self.best.filter(|(grade, _)| grade.class > Class::Fails).map(|(_, k)| k);
        self.statistics.search = search.statistics().clone();
        self.candidates = search.scored().to_vec();
        self.statistics.depth = search.depth();
        self.ranked(status, best, began)
    }

    /// The search before anything is looked at.
    pub(super) fn prepared(&self) -> Search<'a> {
        let errors = self.workspace.tools.iter().map(|tool| {
            let start = &self.situation.start;
            let job = Job::new(self.situation, typical(self.task, start, tool));
            error_p95(self.planner.screen(), self.situation, &job).unwrap_or(f64::INFINITY)
        });
        let error = errors.fold(0.0, f64::max).min(MOST_ROOM_FOR_MODEL);
        let settings = self.planner.settings().search(error);
        Search::new(self.workspace, self.situation, settings)
    }

    /// Looks at plans of one push, then of one more, until one is good enough.
    pub(super) fn search(&mut self) -> Search<'a> {
        let mut search = self.prepared();
        let without = alone(self.task, self.situation).filter(|_| self.workspace.is_placed());
        let mut clearings = None;
        while self.goes_on(search.depth()) && search.can_deepen() && search.depth() < LONGEST {
            self.attempt(&mut search);
            if let Some(without) = &without {
                self.clear_the_way(&mut clearings, without, &search);
            }
            self.carry(&search);
        }
        self.change_grips(&search);
        search
    }

    /// Whether plans of more than `depth` pushes are looked at: longer ones are no better than one that
    /// passes, but one push more is better than an end near the edge of the tolerance.
    pub(super) fn goes_on(&self, depth: usize) -> bool {
        let wanted = self.best.is_none_or(|(grade, k)| match grade.class {
            Class::Fails | Class::Fragile => true,
            Class::Edge => depth <= self.tried[k].plan.steps.len(),
            Class::Passes | Class::Safe => false,
        });
        wanted && self.promising != Some(true) && !self.watch.cancelled()
    }

    /// Searches, refines and verifies plans of one push more, until one is safe; where the best works, but
    /// not nearly always, hardens them.
    pub(super) fn attempt(&mut self, search: &mut Search) {
        let pushes = search.depth() + 1;
        let began = Instant::now();
        self.tell("search", pushes);
        let mut found = search.deepen(&mut self.rollouts, self.watch);
        // A plan that leaves one of several goals behind is no candidate yet.
        if self.task.goals.len() > 1 {
            found.retain(|one| bare(one.score) <= REFINABLE);
        }
        self.statistics.timing.search += began.elapsed().as_secs_f64();
        self.tell_found(&found);
        self.try_out(&found, pushes);
        self.settle(Class::Edge);
        self.harden(&found, pushes);
    }

    /// Refines and verifies what was found of this many pushes, until a plan is safe.
    pub(super) fn try_out(&mut self, found: &[SearchResult], pushes: usize) {
        let settings = *self.planner.settings();
        let began = Instant::now();
        let at_once = self.at_once();
        let most = settings.verified_at_once.max(1) * settings.verify_batches;
        let candidates = self.choose(found, settings.refined, &[]);
        let most_disturbed = (DISTURBED_SHARE * most as f64).ceil() as usize;
        let before = self.disturbed;
        let first = self.tried.len();
        let goals = self.task.goals.clone();
        let mut queue = self.refined(&candidates, &goals, pushes);
        self.statistics.timing.refinement += began.elapsed().as_secs_f64();
        self.tell_refined(&queue);

        let mut failed = Vec::new();
        for batch in 0..most.div_ceil(at_once) {
            if batch > 0 {
                let began = Instant::now();
                self.reconsider(&mut queue, &failed, found, (first, pushes));
                self.statistics.timing.refinement += began.elapsed().as_secs_f64();
            }
            let indices: Vec<usize> = queue.drain(..queue.len().min(at_once)).collect();
            let Some(&leader) = indices.first() else { break };
            if self.watch.cancelled() {
                break;
            }
            let began = Instant::now();
            self.tell("verify", pushes);
            self.watch.progress((batch * at_once) as u64, most as u64);
            self.verify(&indices);
            self.statistics.timing.verification += began.elapsed().as_secs_f64();
            self.tell_replayed();
            let safe = self.best.is_some_and(|(grade, _)| grade.class == Class::Safe);
            let enough = self.disturbed - before >= most_disturbed;
            // Where even the most promising plan leads through a wall, a few tries are enough.
            if self.promising.is_some() || safe || enough || is_behind(self.tried[leader].score) {
                break;
            }
            failed = indices;
        }
    }

    /// Plans verified together.
    pub(super) fn at_once(&self) -> usize {
        self.planner.settings().at_once(self.situation.scene.objects.len())
    }

    /// Refines candidates that the search found towards `aims`, the task's goals or some next to them,
    /// keeps the results, and returns the indices of those worth verifying, best first. Where one
    /// model screens and another decides, the last rounds are the other's.
    pub(super) fn refined(
        &mut self,
        candidates: &[Candidate],
        aims: &[Goal],
        pushes: usize,
    ) -> Vec<usize> {
        self.tell("refine", pushes);
        let settings = *self.planner.settings();
        let last = if self.deciding.is_some() { settings.decided_rounds } else { 0 };
        let all = self.refine_settings(pushes);
        let task = self.task.aiming(aims);
        let screened = refine(
            &Workspace { task: &task, ..self.workspace },
            &mut self.rollouts,
            candidates,
            RefineSettings { rounds: settings.refine_rounds.saturating_sub(last), ..all },
            &mut self.statistics.refinement,
            self.watch,
        );
        let refined = match self.deciding {
            Some(_) => {
                let candidates: Vec<Candidate> =
                    screened.iter().map(|one| one.best.candidate.clone()).collect();
                let decided = self.decided(&candidates, aims, pushes);
                decided.into_iter().map(|one| after(&screened[one.index], one)).collect()
            }
            None => screened,
        };
        self.worth_verifying(refined, aims)
    }

    /// Where the model that decides says candidates end, the best of them refined by it.
    pub(super) fn decided(
        &mut self,
        candidates: &[Candidate],
        aims: &[Goal],
        pushes: usize,
    ) -> Vec<Refined> {
        let settings = *self.planner.settings();
        let all = self.refine_settings(pushes);
        let task = self.task.aiming(aims);
        let Some(rollouts) = &mut self.deciding else { return Vec::new() };
        refine(
            &Workspace { task: &task, ..self.workspace },
            rollouts,
            candidates,
            RefineSettings {
                rounds: settings.decided_rounds.min(settings.refine_rounds),
                seed: all.seed ^ DECIDING,
                short_list: settings.short_list,
                radius: SCREENED_RADIUS,
                ..all
            },
            &mut self.statistics.refinement,
            self.watch,
        )
    }

    pub(super) fn refine_settings(&self, pushes: usize) -> RefineSettings {
        let settings = self.planner.settings();
        RefineSettings {
            rounds: settings.refine_rounds,
            extra: settings.refine_extra,
            // Each length has a stream of its own, so that no two share samples.
            seed: self.planner.seed().wrapping_mul(0x9E37_79B9).wrapping_add(pushes as u64) << 16,
            enough: self.at_once(),
            rollouts: REFINE_WORK / self.situation.scene.objects.len().max(1),
            short_list: usize::MAX,
            radius: FOUND_RADIUS,
        }
    }

    /// Keeps what was refined towards `aims`; the indices of those worth verifying, best first.
    pub(super) fn worth_verifying(
        &mut self,
        mut refined: Vec<Refined>,
        aims: &[Goal],
    ) -> Vec<usize> {
        in_order(&mut refined, &self.workspace, self.situation);
        let aimed = self.task.aiming(aims);
        let mut worth = Vec::new();
        for refined in refined {
            // What the network says of this very push, or else what was measured of many.
            let spread = refined.best.spread.map(|spread| spread.within_90().position);
            let error = spread.or_else(|| {
                let motions = refined.best.motions(&self.workspace);
                let jobs = Job::sequence(self.situation, &motions).into_iter();
                let errors = jobs.map(|job| error_p95(self.planner.model(), self.situation, &job));
                errors.collect::<Option<Vec<f64>>>().map(|all| all.into_iter().fold(0.0, f64::max))
            });
            if is_worth_verifying(&aimed, &refined.best, error) && self.is_for_arm(&refined.best) {
                worth.push(self.tried.len());
            }
            let tried = self.tried(refined, aims);
            self.tried.push(tried);
        }
        worth
    }

    /// Replays plans as written, in parallel, and the best of those that work with disturbances,
    /// until one is safe. Keeps the best.
    fn verify(&mut self, indices: &[usize]) {
        if let Some(promising) = &mut self.promising {
            *promising = true;
            return;
        }
        let verdicts: Vec<Verdict> = indices
            .par_iter()
            .map(|&k| {
                let Attempt { tools, plan, .. } = &self.tried[k];
                self.verifier.nominal(self.task, self.situation, tools, plan)
            })
            .collect();
        self.statistics.verified += indices.len();
        let mut working = Vec::new();
        for (&k, verdict) in indices.iter().zip(verdicts) {
            if verdict.was_stopped() {
                continue;
            }
            let grade = Grade::of(self.task, &verdict);
            if verdict.works() {
                working.push((grade, k));
            }
            self.tried[k].verdict = Some(verdict);
        }
        // Stable, so equal ones keep the order of their predictions.
        let cost = |k: usize| self.tried[k].cost;
        working.sort_by(|a, b| a.0.before(&b.0, cost(a.1).cmp(&cost(b.1))));
        for (_, k) in working.into_iter().take(DISTURBED_AT_ONCE) {
            self.disturbed += 1;
            if self.disturb(k) == Class::Safe || self.watch.cancelled() {
                break;
            }
        }
        self.best = self.best_of_all();
    }
}

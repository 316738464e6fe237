//! Verification of attempts: in 2-D first, then in 3-D if necessary. The best attempt is replayed
//! until its share of successes is clear.

use rayon::prelude::*;

use crate::outcome::Verdict;
use crate::plan::is_behind;
use crate::task::Task;
use crate::verify::{Verifier, VerifySettings};

use super::attempts::{Attempt, Attempts, Replays};
use super::grade::{Class, Grade};
use super::query::Query;

/// Maximum number of plans of one batch that are replayed with perturbations, best first. The other
/// plans have larger errors.
const PERTURBED_AT_ONCE: usize = 3;

/// Replays of attempts, and their counts.
pub(super) struct Verification<'a> {
    query: Query<'a>,
    verifier: Verifier<'a>,
    /// Number of replayed plans.
    pub verified: usize,
    /// Number of plans replayed with perturbations.
    pub perturbed: usize,
    /// Whether a plan is worth verifying, in a solution without verification; such a solution ends
    /// with the first such plan. `None` if plans are verified.
    pub promising: Option<bool>,
}

impl<'a> Verification<'a> {
    /// Creates the verification with counts of zero. Every plan has `perturbed` replays with
    /// perturbations.
    pub fn new(query: Query<'a>, perturbed: usize) -> Self {
        let settings = VerifySettings { replays: perturbed, seed: query.planner.seed() };
        let verifier = Verifier::new(settings).with_progress(query.progress);
        Self { query, verifier, verified: 0, perturbed: 0, promising: None }
    }

    /// Replays plans as written in parallel, and then the best working plans with perturbations
    /// until one is safe. Stores the best attempt.
    pub fn verify(&mut self, attempts: &mut Attempts, indices: &[usize]) {
        if let Some(promising) = &mut self.promising {
            *promising |= indices.iter().any(|&k| !is_behind(attempts.list[k].score));
            return;
        }
        let Query { task, situation, progress, .. } = self.query;
        let verdicts: Vec<Verdict> = indices
            .par_iter()
            .map(|&k| {
                let Attempt { tools, plan, .. } = &attempts.list[k];
                self.verifier.nominal(task, situation, tools, plan)
            })
            .collect();
        self.verified += indices.len();
        let mut working = Vec::new();
        for (&k, verdict) in indices.iter().zip(verdicts) {
            if verdict.was_stopped() {
                continue;
            }
            if verdict.nominal_ok() {
                working.push((Grade::of(&verdict), k));
            }
            attempts.list[k].verdict = Some(verdict);
        }
        // The sort is stable, so that ties keep the order of their predictions.
        let cost = |k: usize| attempts.list[k].cost;
        working.sort_by(|a, b| a.0.before(&b.0, cost(a.1).cmp(&cost(b.1))));
        for (_, k) in working.into_iter().take(PERTURBED_AT_ONCE) {
            self.perturbed += 1;
            if self.perturb(&mut attempts.list[k]) == Class::Safe || progress.cancelled() {
                break;
            }
        }
        self.keep_best(attempts);
    }

    /// Replays the best plan with further perturbations until its success rate is clear, as
    /// `verify` does. This applies only if its class is at least `least`. If the plan works less
    /// often than estimated, another plan may become the best. While fragile plans are not
    /// accepted, a plan that fails with one support model is dropped early. After a stop the
    /// missing replays fail, so that a plan whose rate is still unclear is not called solved.
    pub fn settle(&self, attempts: &mut Attempts, least: Class) {
        let wanted = self.query.settings.replays > 0;
        while let Some((grade, k)) = attempts.best
            && wanted
            && grade.class >= least
            && attempts.list[k].replays != Replays::Settled
        {
            let verifier = self.verifier.clone().until_clear();
            let seeking = least > Class::Fragile;
            let verifier = if seeking { verifier.giving_up() } else { verifier };
            let attempt = &mut attempts.list[k];
            if self.replay(attempt, &verifier, Replays::Settled) < least {
                attempt.replays = Replays::InBoth;
            }
            self.keep_best(attempts);
        }
    }

    /// Replays a plan for the goal of `task`: as written, and with perturbations if it passes.
    pub fn verdict(&self, task: &Task, attempt: &Attempt) -> Verdict {
        let (situation, tools, plan) = (self.query.situation, &attempt.tools, &attempt.plan);
        let nominal = self.verifier.nominal(task, situation, tools, plan);
        match nominal.passed {
            true => self.verifier.perturb(task, situation, tools, plan, nominal),
            false => nominal,
        }
    }

    /// Replays a plan with perturbations and returns its class. A plan that is not safe in 2-D is
    /// not replayed in 3-D, because its class cannot rise (see [`Self::keep_best`]).
    fn perturb(&self, attempt: &mut Attempt) -> Class {
        match self.replay(attempt, &self.verifier.clone().in_plane(), Replays::InPlane) {
            Class::Safe => self.complete(attempt),
            class => class,
        }
    }

    /// Replays a plan with perturbations in 3-D also.
    fn complete(&self, attempt: &mut Attempt) -> Class {
        self.replay(attempt, &self.verifier, Replays::InBoth)
    }

    fn replay(&self, attempt: &mut Attempt, verifier: &Verifier, replays: Replays) -> Class {
        let Query { task, situation, .. } = self.query;
        attempt.replays = replays;
        let Some(verdict) = attempt.verdict.take() else { return Class::Fails };
        let verdict = verifier.perturb(task, situation, &attempt.tools, &attempt.plan, verdict);
        let class = Grade::of(&verdict).class;
        attempt.verdict = Some(verdict);
        class
    }

    /// Stores the best attempt of those replayed with perturbations. Only this attempt must also
    /// have been replayed in 3-D.
    fn keep_best(&self, attempts: &mut Attempts) {
        attempts.best = loop {
            match attempts.graded_best() {
                Some((_, k)) if attempts.list[k].replays == Replays::InPlane => {
                    self.complete(&mut attempts.list[k]);
                }
                best => break best,
            }
        };
    }
}

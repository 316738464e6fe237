//! Attempts: plans from refined candidates or simulated lever-ups, and the plan without steps.

use std::cmp::Ordering;
use std::sync::Arc;

use crate::outcome::{Outcome, Trajectory, Verdict, Warning};
use crate::plan::{Candidate, Cost, Refined, SearchResult, bare, behind, is_behind};
use crate::scene::{ArmFault, Tool};
use crate::task::{Goal, Plan};

use super::Refinement;
use super::grade::{Class, Grade};
use super::pattern::PushPattern;
use super::query::Query;
use super::rank::distinct;

/// Number of plans that need too much force after which no further plan is tried.
const HEAVY: usize = 8;

/// Factor by which the force of a plan exceeds the limit clearly: another plan may need less.
const CLEARLY: f64 = 1.2;

/// Plan, verified if that was worthwhile.
pub(super) struct Attempt {
    pub plan: Plan,
    /// Tools of the plan, each once; the plan without steps has the first tool.
    pub tools: Vec<Arc<Tool>>,
    /// Source of a plan of pushes; `None` for the plan without steps and for lever-ups.
    pub candidate: Option<Candidate>,
    /// Goals of the refinement: the task's goals, or shifted ones.
    pub aims: Vec<Goal>,
    pub refinement: Refinement,
    /// Predicted error in units of the tolerance; 0 for a plan with a `prediction`.
    pub score: f64,
    /// Tie-break among plans with equally near ends.
    pub cost: Cost,
    /// Coarse simulation of a plan that leaves the plane. Other plans are predicted when they are
    /// reported.
    pub prediction: Option<(Trajectory, Outcome)>,
    pub verdict: Option<Verdict>,
    pub replays: Replays,
}

/// Extent of a plan's perturbed replays.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Replays {
    None,
    /// Replays in 2-D only.
    InPlane,
    InBoth,
    /// Replays until the share of successes is clear.
    Settled,
}

/// Attempts so far, in order.
#[derive(Default)]
pub(super) struct Attempts {
    pub list: Vec<Attempt>,
    /// Best attempt that was replayed with perturbations.
    pub best: Option<(Grade, usize)>,
    /// Patterns of plans whose replays missed the goal by a large distance.
    pub refuted: Vec<PushPattern>,
    /// Fault of the first plan that was not verified because the arm cannot execute it.
    pub arm_fault: Option<ArmFault>,
}

impl Attempt {
    /// Creates an attempt from a candidate refined towards `aims`.
    pub fn refined(query: &Query, refined: Refined, aims: &[Goal]) -> Self {
        let Refined { best, off: [before, after], rounds, .. } = refined;
        let (task, workspace) = (query.task, query.workspace());
        Self {
            refinement: Refinement {
                before,
                after,
                aimed_at: aims[0]
                    .position()
                    .filter(|_| !query.goals().iter().eq(aims) && !aims[0].is_relation()),
                rounds: rounds.into_iter().skip(1).map(bare).collect(),
            },
            aims: aims.to_vec(),
            // The score is relative to the task's goals and not to `aims`.
            score: match best.score {
                score if is_behind(score) => behind(task.score(&best.outcome)),
                score if score.is_finite() => task.score(&best.outcome),
                score => score,
            },
            cost: Cost::of(&best, &workspace, query.situation),
            prediction: None,
            verdict: None,
            replays: Replays::None,
            plan: best.plan(&workspace),
            tools: best.tools(&workspace),
            candidate: Some(best.candidate),
        }
    }

    /// Creates the attempt without steps.
    pub fn idle(query: &Query) -> Self {
        let start = &query.situation.start;
        let score = query.task.score(start);
        let tools = query.tools.iter().take(1).cloned().collect();
        let error = query.task.goals[0].error(start);
        Self { score, aims: query.goals(), ..Self::new(Plan::default(), tools, error) }
    }

    /// Creates an attempt from a plan that was simulated and not refined.
    pub fn simulated(
        plan: Plan,
        tools: Vec<Arc<Tool>>,
        (trajectory, outcome): (Trajectory, Outcome),
    ) -> Self {
        let error = outcome.error();
        Self { prediction: Some((trajectory, outcome)), ..Self::new(plan, tools, error) }
    }

    fn new(plan: Plan, tools: Vec<Arc<Tool>>, error: f64) -> Self {
        Self {
            plan,
            tools,
            candidate: None,
            aims: Vec::new(),
            refinement: Refinement {
                before: error,
                after: error,
                aimed_at: None,
                rounds: Vec::new(),
            },
            score: 0.0,
            cost: Cost::default(),
            prediction: None,
            verdict: None,
            replays: Replays::None,
        }
    }

    /// Returns the strength of the evidence that the plan works: 2 plus its robustness if it works
    /// as written, 1 if it fails, and 0 if it was not verified.
    pub fn evidence(&self) -> f64 {
        match &self.verdict {
            Some(verdict) if verdict.nominal_ok() => 2.0 + verdict.robustness.unwrap_or(0.0),
            Some(_) => 1.0,
            None => 0.0,
        }
    }

    /// Returns `true` if the plan works as written.
    pub fn nominal_ok(&self) -> bool {
        self.verdict.as_ref().is_some_and(Verdict::nominal_ok)
    }
}

impl Attempts {
    /// Stores an attempt and returns its index.
    pub fn push(&mut self, attempt: Attempt) -> usize {
        self.list.push(attempt);
        self.list.len() - 1
    }

    /// Returns `true` if any attempt was verified that was predicted to work. A plan whose motion
    /// is blocked in the prediction was only tried in case the prediction is wrong.
    pub fn any_refuted(&self) -> bool {
        self.list.iter().any(|attempt| attempt.verdict.is_some() && !is_behind(attempt.score))
    }

    /// Returns `true` if all of several verified plans need clearly more force than the robot has,
    /// so that further plans are not worth their replays.
    pub fn all_too_heavy(&self) -> bool {
        let is_heavy = |warning: &Warning| match warning {
            Warning::TooMuchForce { object: None, needed, limit } => *needed > CLEARLY * limit,
            _ => false,
        };
        let verdicts = || self.list.iter().filter_map(|attempt| attempt.verdict.as_ref());
        let heavy = |verdict: &Verdict| {
            verdict.evidence.iter().any(|evidence| evidence.warnings.iter().any(is_heavy))
        };
        verdicts().count() >= HEAVY && verdicts().all(heavy)
    }

    /// Returns the class of the best attempt, [`Class::Fails`] if there is none.
    pub fn best_class(&self) -> Class {
        self.best.map_or(Class::Fails, |(grade, _)| grade.class)
    }

    /// Returns `true` if the best attempt works as written.
    pub fn nominal_ok(&self) -> bool {
        self.best_class() > Class::Fails
    }

    /// Returns the best of the attempts that were replayed with perturbations. Ties go to the
    /// first. A plan with more pushes must be clearly better.
    pub fn graded_best(&self) -> Option<(Grade, usize)> {
        let graded = self.list.iter().enumerate().filter_map(|(k, attempt)| {
            let replayed = attempt.verdict.as_ref().filter(|_| attempt.replays != Replays::None);
            Some((Grade::of(replayed?), k))
        });
        let pushes = |k: usize| self.list[k].plan.steps.len();
        let better = |best: (Grade, usize), next: (Grade, usize)| {
            let order = next.0.compare(&best.0);
            let same = next.0.is_as_good_as(&best.0);
            let is_better = match pushes(next.1).cmp(&pushes(best.1)) {
                Ordering::Greater => order.is_gt() && !same,
                Ordering::Less => order.is_gt() || same,
                Ordering::Equal => order.is_gt(),
            };
            if is_better { next } else { best }
        };
        graded.reduce(better)
    }

    /// Returns `true` if a candidate begins like a refuted plan.
    pub fn is_refuted(&self, candidate: &Candidate) -> bool {
        self.refuted.iter().any(|pattern| pattern.begins(candidate))
    }

    /// Chooses up to `count` candidates of different kinds to refine, best first. Candidates that
    /// begin like a refuted plan, or are variants of one of `known`, are skipped while there are
    /// others.
    pub fn choose(
        &self,
        found: &[SearchResult],
        count: usize,
        known: &[&Candidate],
        most_behind: usize,
    ) -> Vec<Candidate> {
        let others: Vec<SearchResult> = found
            .iter()
            .filter(|one| !self.is_refuted(&one.candidate))
            .filter(|one| !known.iter().any(|known| one.candidate.is_variant_of(known)))
            .cloned()
            .collect();
        if others.is_empty() && known.is_empty() {
            distinct(found, count, most_behind)
        } else {
            distinct(&others, count, most_behind)
        }
    }
}

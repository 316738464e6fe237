//! Plans that were tried: from refined candidates, and doing nothing.

use std::sync::Arc;

use crate::plan::{Candidate, Cost, Refined, bare, behind, is_behind};
use crate::{
    outcome::Verdict,
    scene::Tool,
    task::{Goal, Plan},
};

use super::Refinement;
use super::solving::Solving;

/// A plan that was refined, and verified where it was worth that.
pub(super) struct Attempt {
    pub plan: Plan,
    /// Those that it names, each once; of doing nothing the first one.
    pub tools: Vec<Arc<Tool>>,
    /// What the plan was made from; `None` for the plan without pushes.
    pub candidate: Option<Candidate>,
    /// What it was refined towards: the task's goals, or some next to them.
    pub aims: Vec<Goal>,
    pub refinement: Refinement,
    pub score: f64,
    /// What is compared where it is as near as another.
    pub cost: Cost,
    pub verdict: Option<Verdict>,
    pub disturbed: Perturbed,
}

/// How a plan was replayed with disturbances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Perturbed {
    No,
    /// In the planar engine alone.
    InPlane,
    InBoth,
    /// Until it was clear how often it works.
    Settled,
}

impl Solving<'_> {
    /// What was made of a candidate that was refined towards `aims`.
    pub(super) fn tried(&self, refined: Refined, aims: &[Goal]) -> Attempt {
        let Refined { best, off: [before, after], rounds, .. } = refined;
        Attempt {
            refinement: Refinement {
                before,
                after,
                aimed_at: (!self.task.goals.iter().eq(aims) && !aims[0].is_relation())
                    .then(|| aims[0].position),
                rounds: rounds.into_iter().skip(1).map(bare).collect(),
            },
            aims: aims.to_vec(),
            // Of our goals, whatever it was refined towards.
            score: match best.score {
                score if is_behind(score) => behind(self.task.score(&best.outcome)),
                score if score.is_finite() => self.task.score(&best.outcome),
                score => score,
            },
            cost: Cost::of(&best, &self.workspace, self.situation),
            verdict: None,
            disturbed: Perturbed::No,
            plan: best.plan(&self.workspace),
            tools: best.tools(&self.workspace),
            candidate: Some(best.candidate),
        }
    }

    /// Doing nothing, which is a plan too.
    pub(super) fn without_pushes(&self) -> Attempt {
        let start = &self.situation.start;
        let error = self.task.goals[0].error(start);
        Attempt {
            plan: Plan::default(),
            tools: self.workspace.tools.iter().take(1).cloned().collect(),
            candidate: None,
            aims: self.task.goals.clone(),
            refinement: Refinement {
                before: error,
                after: error,
                aimed_at: None,
                rounds: Vec::new(),
            },
            score: self.task.score(start),
            cost: Cost::default(),
            verdict: None,
            disturbed: Perturbed::No,
        }
    }
}

/// What the model that decides made of a candidate after the one that screens had refined it.
pub(super) fn after(screened: &Refined, decided: Refined) -> Refined {
    let mut rounds = screened.rounds.clone();
    rounds.extend(decided.rounds);
    Refined { off: [screened.off[0], decided.off[1]], rounds, ..decided }
}

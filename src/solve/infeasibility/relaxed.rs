//! Relaxed tasks and the plans that work in them.

use std::sync::Arc;

use rayon::prelude::*;

use crate::asset::ToolLibrary;
use crate::outcome::{Verdict, Warning};
use crate::plan::{Search, is_behind};
use crate::progress::Progress;
use crate::scene::Tool;
use crate::solve::blackboard::Blackboard;
use crate::solve::planner::{Planner, stated};
use crate::solve::query::Query;
use crate::solve::refinement::refined;
use crate::task::{Plan, Task};
use crate::verify::{Verifier, VerifySettings};

use super::{Cause, Hints};

/// Maximum number of plans of one length that are replayed, nearest first.
const REPLAYED: usize = 4;

/// Task without a plan, and the means to search for the cause.
pub(super) struct Case<'a> {
    /// Planner of a coarse search.
    pub planner: &'a Planner,
    pub task: &'a Task,
    /// Tools that the task allows.
    pub tools: &'a [Arc<Tool>],
    pub library: &'a ToolLibrary,
    pub hints: &'a Hints,
    pub progress: &'a dyn Progress,
}

/// Task with one limit relaxed.
pub(super) struct Relaxed<'a> {
    pub task: Task,
    pub tools: Vec<Arc<Tool>>,
    pub explain: Explain<'a>,
}

/// Function that returns the cause from plans that work in a relaxed task, or `None` if the limit
/// does not matter for them.
type Explain<'a> = Box<dyn Fn(&[Way]) -> Option<Cause> + Send + Sync + 'a>;

/// Plan that works as written.
pub(super) struct Way {
    pub plan: Plan,
    pub tools: Vec<Arc<Tool>>,
    pub verdict: Verdict,
}

impl<'a> Case<'a> {
    /// Returns a copy of the task that `change` relaxes, or `None` if it changes nothing.
    pub fn relaxed(
        &self,
        change: impl FnOnce(&mut Task),
        explain: impl Fn(&[Way]) -> Option<Cause> + Send + Sync + 'a,
    ) -> Option<Relaxed<'a>> {
        let mut task = self.task.clone();
        change(&mut task);
        let tools = self.tools.to_vec();
        (task != *self.task).then(|| Relaxed { task, tools, explain: Box::new(explain) })
    }

    /// Returns plans of `task` that work as written, with as few pushes as possible.
    pub fn ways(&self, task: &Task, tools: &[Arc<Tool>]) -> Vec<Way> {
        let situation = &stated(task);
        let settings = *self.planner.settings();
        let (planner, progress) = (self.planner, self.progress);
        let query = Query { planner, task, situation, tools, progress, settings };
        let goals = query.goals();
        let search = Search::new(query.workspace(), situation, settings.search(0.0));
        let mut board = Blackboard::for_pushes(query, search);
        while let Some(search) = board.search.as_mut().filter(|search| search.can_deepen())
            && !query.progress.cancelled()
        {
            let found = search.deepen(&mut board.refiner.rollouts, query.progress);
            let depth = search.depth();
            let chosen = board.attempts.choose(&found, settings.refined, &[], query.at_once());
            let first = board.attempts.list.len();
            refined(&mut board, &chosen, &goals, depth);
            let attempts = board.attempts.list[first..].iter();
            let mut near: Vec<_> =
                attempts.filter(|one| one.score <= 1.0 && !is_behind(one.score)).collect();
            near.sort_by(|a, b| a.score.total_cmp(&b.score));
            near.truncate(REPLAYED);
            let ways: Vec<Way> = near
                .into_par_iter()
                .filter_map(|one| {
                    let (plan, tools) = (one.plan.clone(), one.tools.clone());
                    let verdict = replayed(task, &plan, &tools);
                    verdict.nominal_ok().then_some(Way { plan, tools, verdict })
                })
                .collect();
            if !ways.is_empty() {
                return ways;
            }
        }
        Vec::new()
    }
}

/// Replays a plan as written in both engines.
pub(super) fn replayed(task: &Task, plan: &Plan, tools: &[Arc<Tool>]) -> Verdict {
    let verifier = Verifier::new(VerifySettings { replays: 0, seed: 0 });
    verifier.nominal(task, &stated(task), tools, plan)
}

/// Returns the bodies with which the hand or the handle collides in a verdict.
pub(super) fn met_by_hand(verdict: &Verdict) -> Vec<String> {
    distinct(verdict.forbidden.iter().filter_map(|warning| match warning {
        Warning::HandThrough { obstacle, .. } => Some(obstacle.clone()),
        _ => None,
    }))
}

/// Returns the bodies that make a verdict fail.
pub(super) fn culprits(verdict: &Verdict) -> Vec<String> {
    let replayed = verdict.evidence.iter().flat_map(|evidence| &evidence.warnings);
    distinct(verdict.forbidden.iter().chain(replayed).filter_map(|warning| match warning {
        Warning::ThroughObstacle { obstacle, .. }
        | Warning::HandThrough { obstacle, .. }
        | Warning::NoWay { obstacle, .. }
        | Warning::NotLifted { obstacle, .. } => Some(obstacle.clone()),
        Warning::Jammed { against, .. } => Some(against.clone()),
        Warning::NotKept { object, .. } | Warning::SetDownOn { object, .. } => Some(object.clone()),
        Warning::KeptOut { region, .. } => Some(region.clone()),
        _ => None,
    }))
}

/// Returns names without repetitions.
pub(super) fn distinct(names: impl Iterator<Item = String>) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for name in names {
        if !found.contains(&name) {
            found.push(name);
        }
    }
    found
}

//! Pushes that follow a lever-up. The object is levered until it lies on the table as the goal
//! requires, and is then pushed to its place. For tasks without lever-ups, only pushes are planned.

use std::collections::VecDeque;

use crate::asset::ToolLibrary;
use crate::solve::SolveError;
use crate::solve::attempts::Attempt;
use crate::solve::blackboard::Blackboard;
use crate::solve::grade::Class;
use crate::solve::lever_batch::{LeverPlan, verify_in_groups};
use crate::solve::solving::{Batch, Strategy};
use crate::task::Task;

use super::prefix::{Prefix, pushed, pushing_task, start};
use super::search::lever_ups;

/// Strategy that follows lever-ups of a task by pushes, best first, until a plan passes.
pub(in crate::solve::strategy) struct FollowUp<'a> {
    /// Task after the prefix.
    task: Task,
    prefix: Prefix,
    library: &'a ToolLibrary,
    /// Lever-ups that meet the goal except for its place, once searched.
    levered: Option<VecDeque<Attempt>>,
    followed: usize,
}

impl<'a> FollowUp<'a> {
    /// Creates the strategy for lever-ups of the task from its start.
    pub fn new(task: Task, library: &'a ToolLibrary) -> Self {
        Self::after(Prefix::default(), task, library)
    }

    /// Creates the strategy for lever-ups after `prefix`, which leads to the start of `task`.
    pub(super) fn after(prefix: Prefix, task: Task, library: &'a ToolLibrary) -> Self {
        Self { task, prefix, library, levered: None, followed: 0 }
    }

    /// Searches and verifies lever-ups without regard to the goal's place, which is left to pushes.
    fn levered(&self, board: &mut Blackboard<'a>) -> VecDeque<Attempt> {
        let goal = self.task.goals[0].clone().anywhere();
        let lifted = Task { goals: vec![goal.clone()], ..self.task.clone() };
        let mut plans = lever_ups(board, &lifted, &self.prefix);
        let goal = Task { goals: vec![goal], ..board.query.task.clone() };
        verify_in_groups(board, &goal, &mut plans);
        let mut levered: Vec<Attempt> = plans.into_iter().map(|plan| plan.attempt).collect();
        // The sort is stable, so that ties keep the order of the search.
        levered.sort_by(|a, b| b.evidence().total_cmp(&a.evidence()));
        let reaches = |attempt: &Attempt| attempt.prediction.as_ref().is_some_and(|p| p.1.reached);
        levered.into_iter().filter(reaches).collect()
    }
}

impl<'a> Strategy<'a> for FollowUp<'a> {
    fn name(&self) -> &'static str {
        "follow up"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        let batch = |plan: LeverPlan| Batch::Levers(vec![plan]);
        if board.attempts.best_class() > Class::Fragile || board.query.progress.cancelled() {
            return Ok(None);
        }
        if self.levered.is_none() && self.task.levers.is_none() {
            self.levered = Some(VecDeque::new());
            let rests = start(&self.task);
            return Ok(pushed(board, self.library, &self.prefix, &rests)?.map(batch));
        }
        let mut levered = match self.levered.take() {
            Some(levered) => levered,
            None => self.levered(board),
        };
        let most = board.query.settings.levers.followed;
        while let Some(attempt) = levered.pop_front().filter(|_| self.followed < most) {
            let prefix = Prefix { plan: attempt.plan, tools: attempt.tools };
            let Some(rests) = prefix.rests(board.query.task) else { continue };
            if pushing_task(board.query.task, &rests, self.library).is_none() {
                continue;
            }
            self.followed += 1;
            if let Some(levers) = &mut board.levers {
                levers.followed += 1;
            }
            if let Some(plan) = pushed(board, self.library, &prefix, &rests)? {
                self.levered = Some(levered);
                return Ok(Some(batch(plan)));
            }
            if board.query.progress.cancelled() {
                break;
            }
        }
        self.levered = Some(VecDeque::new());
        Ok(None)
    }
}

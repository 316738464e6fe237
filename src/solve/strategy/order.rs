//! Order of the strategies.

use crate::asset::ToolLibrary;
use crate::scene::Situation;
use crate::solve::query::Query;
use crate::solve::solving::Strategy;
use crate::task::Task;

use super::change_tool::ChangeTool;
use super::clear::Clear;
use super::escalate::{Remaining, SameLength};
use super::fine_offsets::FineOffsets;
use super::harden::Harden;
use super::lever::{FollowUp, InTurn, LeverUp, MakeRoom};
use super::push::Push;
use super::transport::Transport;

/// Strategies in order of precedence: the first one with a next step has the turn.
type Strategies<'a> = Vec<Box<dyn Strategy<'a> + 'a>>;

/// Returns the strategies for pushing tasks. `alone` is the task without the possible obstructions,
/// if there are any.
///
/// Plans that work nearly always are first searched among the existing results, then with all
/// budgets, then with an obstruction cleared, then after legs of transport. Only then may plans be
/// a push longer. If no plan works, all budgets follow for every number of pushes. Tool changes are
/// next, if no plan with one grip is even predicted to reach the goal. Fine lateral offsets come
/// last.
pub(in crate::solve) fn for_pushes<'a>(alone: Option<&'a (Task, Situation)>) -> Strategies<'a> {
    vec![
        Box::new(Harden),
        Box::new(SameLength),
        Box::new(Clear::new(alone)),
        Box::new(Transport::default()),
        Box::new(Push),
        Box::new(Remaining),
        Box::new(ChangeTool::default()),
        Box::new(FineOffsets::default()),
    ]
}

/// Returns the strategies for tasks that leave the plane: a single lever-up, then pushes after one,
/// then pushes that make room for one. Several goals are met in consecutive stages, each by these
/// strategies.
pub(in crate::solve) fn for_levers<'a>(
    query: Query<'a>,
    library: &'a ToolLibrary,
) -> Strategies<'a> {
    let (levers, pushes) = (query.task.levers.is_some(), query.task.pushes.max_count > 0);
    let mut strategies: Strategies = Vec::new();
    let [goal] = &query.task.goals[..] else {
        return vec![Box::new(InTurn::new(query.task, library))];
    };
    if levers {
        strategies.push(Box::new(LeverUp::default()));
    }
    if pushes {
        strategies.push(Box::new(FollowUp::new(query.task.clone(), library)));
    }
    if levers && pushes {
        strategies.push(Box::new(MakeRoom::new(library)));
    }
    if pushes && levers && goal.is_pose() {
        strategies.push(Box::new(InTurn::new(query.task, library)));
    }
    strategies
}

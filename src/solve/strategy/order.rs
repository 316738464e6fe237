//! The order of the strategies.

use crate::asset::ToolLibrary;
use crate::scene::Situation;
use crate::solve::query::Query;
use crate::solve::solving::Strategy;
use crate::task::Task;

use super::change_tool::ChangeTool;
use super::clear::Clear;
use super::harden::Harden;
use super::lever::{FollowUp, InTurn, LeverUp, MakeRoom};
use super::push::Push;
use super::transport::Transport;

/// Strategies in order of precedence: of those that have something to try, the first has its turn.
type Strategies<'a> = Vec<Box<dyn Strategy<'a> + 'a>>;

/// Returns the strategies for tasks of pushing; `alone` is the task without all that may be in the way,
/// where that makes a difference.
///
/// Plans that nearly always work are looked for first among what is at hand, then with an obstruction
/// cleared, then after legs of transport; only then may plans be a push longer. Tools change last,
/// where no plan with one grip is even predicted to reach the goal.
pub(in crate::solve) fn for_pushes<'a>(alone: Option<&'a (Task, Situation)>) -> Strategies<'a> {
    vec![
        Box::new(Harden),
        Box::new(Clear::new(alone)),
        Box::new(Transport::default()),
        Box::new(Push),
        Box::new(ChangeTool::default()),
    ]
}

/// Returns the strategies for tasks that leave the plane: a lever-up alone, then pushes that follow one,
/// then pushes to where one can be made. Several goals are met in turn, each by these.
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

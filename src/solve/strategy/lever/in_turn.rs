//! Several goals, one stage for each: a lever-up for what leaves the plane, pushes for all else.

use std::collections::VecDeque;

use crate::asset::ToolLibrary;
use crate::geometry::Pose3;
use crate::outcome::{Outcome, Verdict};
use crate::solve::SolveError;
use crate::solve::attempts::Attempt;
use crate::solve::blackboard::Blackboard;
use crate::solve::lever_batch::LeverPlan;
use crate::solve::solving::{Batch, Strategy};
use crate::task::{Goal, Plan, Step, Task};

use super::prefix::{Prefix, coarse, pushing_task, start};

/// Distance by which later pushes may move an object whose goal is reached, metres: as far as objects that
/// a task keeps may be moved by default.
const KEPT: f64 = 0.005;

/// The goals that one part of a plan meets.
#[derive(Clone)]
enum Stage {
    /// The object of this goal is levered.
    Lever(Goal),
    /// The objects of these are pushed.
    Push(Vec<Goal>),
}

/// Tries the stages in different orders, until a plan passes.
pub(in crate::solve::strategy) struct InTurn<'a> {
    library: &'a ToolLibrary,
    orders: VecDeque<Vec<Stage>>,
}

impl<'a> InTurn<'a> {
    pub fn new(task: &Task, library: &'a ToolLibrary) -> Self {
        Self { library, orders: orders(task) }
    }

    /// Plans the stages of an order, each from where the last one leaves everything.
    fn plan(
        &self,
        board: &mut Blackboard<'a>,
        order: &[Stage],
    ) -> Result<Option<Prefix>, SolveError> {
        let task = board.query.task;
        let (mut prefix, mut rests) = (Prefix::default(), start(task));
        let mut met: Vec<usize> = Vec::new();
        for stage in order {
            board.progress.stage("stages");
            let (planned, goals) = match stage {
                Stage::Lever(goal) => (self.levered(board, goal, (&prefix, &rests))?, vec![goal]),
                Stage::Push(goals) => {
                    (self.pushed(board, goals, (&met, &rests))?, goals.iter().collect())
                }
            };
            let Some(next) = planned else { return Ok(None) };
            met.extend(goals.into_iter().map(|goal| goal.object));
            if next.plan.is_empty() {
                continue;
            }
            let tools = prefix.with(&next.tools);
            prefix = Prefix { plan: prefix.plan.then(next.plan), tools };
            match prefix.rests(task) {
                Some(found) => rests = found,
                None => return Ok(None),
            }
        }
        Ok((!prefix.plan.is_empty()).then_some(prefix))
    }

    /// Plans a lever-up, with pushes that it needs, for one goal.
    fn levered(
        &self,
        board: &mut Blackboard<'a>,
        goal: &Goal,
        (before, rests): (&Prefix, &[Pose3]),
    ) -> Result<Option<Prefix>, SolveError> {
        let task = board.query.task;
        let begun = !before.plan.is_empty();
        let Some(moved) = (if begun { task.moved_to(rests) } else { Some(task.clone()) }) else {
            return Ok(None);
        };
        let alone = Task { goals: vec![goal.clone()], ..moved };
        let found = solved(board, &alone, self.library)?;
        Ok(found.map(|mut found| {
            for step in found.plan.steps.iter_mut().filter(|_| begun) {
                if let Step::LeverUp(step) = step {
                    let expected = alone.scene.objects[step.lever.plate].pose;
                    step.expected.get_or_insert(expected);
                }
            }
            found
        }))
    }

    /// Plans pushes for some goals; the objects of those that are `met` stay where they are.
    fn pushed(
        &self,
        board: &mut Blackboard<'a>,
        goals: &[Goal],
        (met, rests): (&[usize], &[Pose3]),
    ) -> Result<Option<Prefix>, SolveError> {
        let mut task = Task { goals: goals.to_vec(), ..board.query.task.clone() };
        for &object in met {
            task.scene.objects[object].keep.get_or_insert(KEPT);
        }
        match pushing_task(&task, rests, self.library) {
            Some(left) => solved(board, &left, self.library),
            None => Ok(None),
        }
    }
}

impl<'a> Strategy<'a> for InTurn<'a> {
    fn name(&self) -> &'static str {
        "in turn"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        while !board.attempts.list.iter().any(Attempt::works)
            && !board.query.watch.cancelled()
            && let Some(order) = self.orders.pop_front()
        {
            let Some(Prefix { plan, tools }) = self.plan(board, &order)? else { continue };
            let task = board.query.task;
            let Some(trajectory) = coarse(task, &plan, &tools) else { continue };
            let outcome = Outcome::judge(&task.scene, task, &trajectory);
            let attempt = Attempt::simulated(plan, tools, (trajectory, outcome));
            let plan = LeverPlan { attempt, kind: (0, 0, 0, 0), promising: true };
            return Ok(Some(Batch::Levers(vec![plan])));
        }
        Ok(None)
    }
}

/// Returns a plan that works for a task of some of the goals; one without steps where nothing is to be
/// done.
fn solved(
    board: &mut Blackboard,
    task: &Task,
    library: &ToolLibrary,
) -> Result<Option<Prefix>, SolveError> {
    if task.reached(&task.scene.start()) {
        return Ok(Some(Prefix { plan: Plan::default(), tools: Vec::new() }));
    }
    let query = board.query;
    let solution = query.planner.solve_with(task, library, query.watch)?;
    board.timing.search += solution.statistics.timing.total;
    if let (Some(all), Some(own)) = (&mut board.levers, &solution.statistics.levers) {
        all.search = own.search.clone();
        all.simulated += own.simulated;
        all.followed += own.followed;
    }
    let best = solution.best().filter(|best| best.verdict.as_ref().is_some_and(Verdict::works));
    Ok(best.map(|best| Prefix { plan: best.plan.clone(), tools: best.tools.clone() }))
}

/// Returns the orders of the stages that are tried: lever-ups first, which need the room that they find, or
/// pushes first, and of several lever-ups either first.
fn orders(task: &Task) -> VecDeque<Vec<Stage>> {
    let (lifted, flat): (Vec<Goal>, Vec<Goal>) =
        task.goals.iter().cloned().partition(|goal| !goal.is_pose());
    let pushes = |goals: Vec<Goal>| (!goals.is_empty()).then_some(Stage::Push(goals));
    let mut orders = VecDeque::new();
    let mut add = |levers: &[Goal], flat: &[Goal]| {
        let levers: Vec<Stage> = levers.iter().cloned().map(Stage::Lever).collect();
        let pushes = pushes(flat.to_vec());
        orders.push_back(levers.iter().cloned().chain(pushes.clone()).collect::<Vec<_>>());
        if pushes.is_some() && !levers.is_empty() {
            orders.push_back(pushes.into_iter().chain(levers).collect());
        }
    };
    add(&lifted, &flat);
    if lifted.len() > 1 {
        let reversed: Vec<Goal> = lifted.iter().rev().cloned().collect();
        add(&reversed, &flat);
    }
    // Of several goals in the plane one may be for the blade.
    if lifted.is_empty() && flat.len() > 1 {
        let levered = task.levered().object;
        let (blade, others): (Vec<Goal>, Vec<Goal>) =
            flat.into_iter().partition(|goal| goal.object == levered);
        add(&blade, &others);
    }
    orders
}

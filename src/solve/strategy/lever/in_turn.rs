//! Stages for several goals: a lever-up for each goal that leaves the plane, and pushes for all
//! others.

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

/// Distance by which later pushes may move an object whose goal is reached, metres: the default for
/// objects that must stay.
const KEPT: f64 = 0.005;

/// Goals that one part of a plan meets.
#[derive(Clone)]
enum Stage {
    /// Lever-up of the goal's object.
    Lever(Goal),
    /// Pushes of the goals' objects.
    Push(Vec<Goal>),
}

/// Strategy that tries the stages in different orders, until a plan passes.
pub(in crate::solve::strategy) struct InTurn<'a> {
    library: &'a ToolLibrary,
    orders: VecDeque<Vec<Stage>>,
}

impl<'a> InTurn<'a> {
    pub fn new(task: &Task, library: &'a ToolLibrary) -> Self {
        Self { library, orders: orders(task) }
    }

    /// Plans the stages of an order, each from the state left by the previous one.
    fn plan(
        &self,
        board: &mut Blackboard<'a>,
        order: &[Stage],
    ) -> Result<Option<Prefix>, SolveError> {
        let task = board.query.task;
        let (mut prefix, mut rests) = (Prefix::default(), start(task));
        let mut met: Vec<usize> = Vec::new();
        for stage in order {
            board.reporter.stage("stages");
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

    /// Plans a lever-up for one goal, with the pushes that it needs.
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

    /// Plans pushes for some goals; the objects in `met` must stay in place.
    fn pushed(
        &self,
        board: &mut Blackboard<'a>,
        goals: &[Goal],
        (met, rests): (&[usize], &[Pose3]),
    ) -> Result<Option<Prefix>, SolveError> {
        let mut task = Task { goals: goals.to_vec(), ..board.query.task.clone() };
        for &object in met {
            let own = &mut task.scene.objects[object];
            if own.keep.is_none() {
                own.keep = Some(KEPT);
                own.kept_from = rests.get(object).map(Pose3::from_above);
            }
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
        while !board.attempts.list.iter().any(Attempt::nominal_ok)
            && !board.query.progress.cancelled()
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

/// Returns a working plan for a task with some of the goals. The plan has no steps if these goals
/// are already met.
fn solved(
    board: &mut Blackboard,
    task: &Task,
    library: &ToolLibrary,
) -> Result<Option<Prefix>, SolveError> {
    if task.reached(&task.scene.start()) {
        return Ok(Some(Prefix { plan: Plan::default(), tools: Vec::new() }));
    }
    let query = board.query;
    let solution = query.planner.solve_with(task, library, query.progress)?;
    board.timing.search += solution.statistics.timing.total;
    if let (Some(all), Some(own)) = (&mut board.levers, &solution.statistics.levers) {
        all.search = own.search.clone();
        all.simulated += own.simulated;
        all.followed += own.followed;
    }
    let best =
        solution.best().filter(|best| best.verdict.as_ref().is_some_and(Verdict::nominal_ok));
    Ok(best.map(|best| Prefix { plan: best.plan.clone(), tools: best.tools.clone() }))
}

/// Returns the orders of the stages to try: lever-ups first, or pushes first to make room for them.
/// The reversed order of several lever-ups is also tried.
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
    // One of several planar goals may need the blade.
    if lifted.is_empty() && flat.len() > 1 {
        let levered = task.levered().object;
        let (blade, others): (Vec<Goal>, Vec<Goal>) =
            flat.into_iter().partition(|goal| goal.object == levered);
        add(&blade, &others);
    }
    orders
}

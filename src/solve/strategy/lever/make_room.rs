//! Pushes that bring the object to a place where it can be levered.

use std::f64::consts::TAU;

use crate::asset::ToolLibrary;
use crate::geometry::{Solid, Vector};
use crate::outcome::Verdict;
use crate::scene::Obstacle;
use crate::solve::SolveError;
use crate::solve::attempts::Attempt;
use crate::solve::blackboard::Blackboard;
use crate::solve::solving::{Batch, Strategy};
use crate::task::{Goal, Task};

use super::follow_up::FollowUp;
use super::prefix::{Prefix, pushing_task, start};
use super::search::{lever_ups, promising};

/// Distances by which the object is pushed, metres.
const AWAY: [f64; 3] = [0.08, 0.14, 0.2];

/// Number of directions in which the object is pushed.
const DIRECTIONS: usize = 8;

/// Maximum error of the push, metres: the blade is planned for the pose in the nominal replay.
const NEAR: f64 = 0.01;

/// Strategy that tries places next to the object, nearest first, until a plan works.
pub(in crate::solve::strategy) struct MakeRoom<'a> {
    library: &'a ToolLibrary,
    /// Untried displacements of the object.
    displacements: Box<dyn Iterator<Item = Vector>>,
    pushed: usize,
    /// Last push, and the task after it whose lever-ups were tried.
    last: Option<(Prefix, Task)>,
    follow_up: Option<FollowUp<'a>>,
}

impl<'a> MakeRoom<'a> {
    pub fn new(library: &'a ToolLibrary) -> Self {
        let turn = |k| TAU * k as f64 / DIRECTIONS as f64;
        let displacement =
            move |away: f64, k| away * Vector::new(f64::cos(turn(k)), f64::sin(turn(k)));
        let all = AWAY.into_iter();
        let all = all.flat_map(move |away| (0..DIRECTIONS).map(move |k| displacement(away, k)));
        Self { library, displacements: Box::new(all), pushed: 0, last: None, follow_up: None }
    }

    /// Pushes the object to the next place from which it can be levered.
    fn push(&mut self, board: &mut Blackboard) -> Result<Option<(Prefix, Task)>, SolveError> {
        let query = board.query;
        let most = query.settings.levers.followed;
        let (task, goal) = (query.task, query.task.goals[0].object);
        while self.pushed < most
            && !query.progress.cancelled()
            && let Some(displacement) = self.displacements.next()
        {
            let place = task.scene.objects[goal].pose.position + displacement;
            let mut there = task.clone();
            there.goals[0] = there.goals[0].clone().anywhere();
            there.scene.objects[goal].pose.position = place;
            there.scene.place_parts();
            if !is_free(&there) || promising(board, &there) == 0 {
                continue;
            }
            self.pushed += 1;
            board.reporter.stage("pushes");
            let towards = Task { goals: vec![Goal::new(goal, place.into(), NEAR)], ..task.clone() };
            let Some(left) = pushing_task(&towards, &start(task), self.library) else { continue };
            let solution = query.planner.solve_with(&left, self.library, query.progress)?;
            let Some(best) = solution.best().filter(|best| !best.plan.is_empty()) else { continue };
            if !best.verdict.as_ref().is_some_and(Verdict::nominal_ok) {
                continue;
            }
            let prefix = Prefix { plan: best.plan.clone(), tools: best.tools.clone() };
            let Some(rests) = prefix.rests(task) else { continue };
            if let Some(moved) = task.moved_to(&rests) {
                return Ok(Some((prefix, moved)));
            }
        }
        Ok(None)
    }
}

impl<'a> Strategy<'a> for MakeRoom<'a> {
    fn name(&self) -> &'static str {
        "make room"
    }

    fn next(&mut self, board: &mut Blackboard<'a>) -> Result<Option<Batch>, SolveError> {
        if let Some(follow_up) = &mut self.follow_up
            && let Some(batch) = follow_up.next(board)?
        {
            return Ok(Some(batch));
        }
        self.follow_up = None;
        if board.attempts.list.iter().any(Attempt::nominal_ok) || board.query.progress.cancelled() {
            return Ok(None);
        }
        if let Some((prefix, moved)) =
            self.last.take().filter(|(_, task)| task.goals[0].has_place())
        {
            let mut follow_up = FollowUp::after(prefix, moved, self.library);
            let batch = follow_up.next(board)?;
            self.follow_up = Some(follow_up);
            if batch.is_some() {
                return Ok(batch);
            }
        }
        let Some((prefix, moved)) = self.push(board)? else { return Ok(None) };
        let plans = lever_ups(board, &moved, &prefix);
        self.last = Some((prefix, moved));
        Ok(Some(Batch::Levers(plans)))
    }
}

/// Returns `true` if the goal's object has room at its position.
fn is_free(task: &Task) -> bool {
    let (scene, own) = (&task.scene, task.plate());
    let others = scene.plates().enumerate().filter(|(k, _)| *k != task.goals[0].object);
    let others = others.flat_map(|(_, plate)| plate.solids());
    let others: Vec<Solid> = others.chain(scene.obstacles.iter().map(Obstacle::solid)).collect();
    let clear = |solid: &Solid| others.iter().all(|other| solid.depth(other) <= 0.0);
    own.solids().iter().all(clear) && task.robot.reaches(own.pose.position)
}

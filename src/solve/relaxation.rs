//! Relaxation of single limits of a task without a plan, to find the limit that is the cause.

use std::f64::consts::TAU;
use std::sync::Arc;

use rayon::prelude::*;

use crate::asset::ToolLibrary;
use crate::geometry::Pose;
use crate::geometry::distance_to_origin;
use crate::plan::{Search, is_behind};
use crate::progress::{Progress, Quiet};
use crate::{
    scene::{JointKind, Obstacle, Robot, Tool},
    task::{Demand, Directions, Plan, Task, ToolChoice},
};

use super::blackboard::Blackboard;
use super::infeasibility::Cause;
use super::planner::{Planner, stated};
use super::query::Query;
use super::refinement::refined;

/// Number of additional pushes in a relaxed task.
const MORE_PUSHES: usize = 2;

/// Factor of lengths and reaches in a relaxed task.
const LONGER: f64 = 4.0;

/// Number of directions of a relaxed task; half of it for grip yaws.
const WAYS: usize = 16;

/// Step to which reported limits are rounded up, metres.
const STEP: f64 = 0.01;

/// Maximum number of obstacles removed, one at a time, to find the one that is the cause.
const OBSTACLES: usize = 8;

/// Task with one limit relaxed, and the cause if it has a plan.
struct Wider<'a> {
    task: Task,
    tools: Vec<Arc<Tool>>,
    cause: Explanation<'a>,
}

/// Function that returns the cause from plans of a relaxed task.
type Explanation<'a> = Box<dyn Fn(&[Way]) -> Cause + Send + Sync + 'a>;

/// Plan that is predicted to reach the goal.
struct Way {
    plan: Plan,
    tool: String,
}

/// Returns the cause that prevents a plan for `task`. Each limit is relaxed separately, and the
/// first relaxation with a plan that is predicted to reach the goal is the cause. Only the
/// screening model is used, and nothing is verified.
pub(super) fn cause(
    planner: &Planner,
    task: &Task,
    library: &ToolLibrary,
    progress: &dyn Progress,
) -> Option<Cause> {
    let tools = task.tools(library).ok()?;
    let first_look = planner.first_look();
    let progress = &Quiet(progress);
    let found = wider(task, &tools, library).into_par_iter().find_map_first(|wider| {
        let (task, situation) = (&wider.task, &stated(&wider.task));
        let tools = &wider.tools;
        let ways = ways(Query { planner: &first_look, task, situation, tools, progress });
        (!ways.is_empty()).then(|| (wider.cause)(&ways))
    });
    (!progress.cancelled()).then(|| found.unwrap_or(Cause::Several))
}

/// Returns plans that are predicted to reach the goal, with as few pushes as possible.
fn ways(query: Query) -> Vec<Way> {
    let (settings, goals) = (query.planner.settings(), query.goals());
    let search = Search::new(query.workspace(), query.situation, settings.search(0.0));
    let mut board = Blackboard::for_pushes(query, search);
    while let Some(search) = board.search.as_mut().filter(|search| search.can_deepen())
        && !query.progress.cancelled()
    {
        let found = search.deepen(&mut board.refiner.screening, query.progress);
        let depth = search.depth();
        let chosen = board.attempts.choose(&found, settings.refined, &[], query.at_once());
        refined(&mut board, &chosen, &goals, depth);
        let attempts = board.attempts.list.iter();
        let reach = attempts.filter(|one| one.score <= 1.0 && !is_behind(one.score));
        let ways: Vec<Way> = reach
            .map(|one| Way { plan: one.plan.clone(), tool: one.plan.tool().to_owned() })
            .collect();
        if !ways.is_empty() {
            return ways;
        }
    }
    Vec::new()
}

/// Returns the tasks with one limit relaxed: first limits that are free to relax, and obstacles
/// last.
fn wider<'a>(task: &'a Task, tools: &[Arc<Tool>], library: &ToolLibrary) -> Vec<Wider<'a>> {
    let mut all: Vec<Wider> = Vec::new();
    let mut add = |change: &dyn Fn(&mut Task), cause: Explanation<'a>| {
        let mut wider = task.clone();
        change(&mut wider);
        if wider != *task {
            all.push(Wider { task: wider, tools: tools.to_vec(), cause });
        }
    };
    let (rules, robot) = (&task.pushes, &task.robot);
    add(
        &|task| task.pushes.max_count += MORE_PUSHES,
        Box::new(|ways| Cause::Pushes {
            allowed: rules.max_count,
            needed: ways.iter().map(|way| way.plan.pushes().len()).min().unwrap_or_default(),
        }),
    );
    add(
        &|task| task.pushes.length *= LONGER,
        Box::new(|ways| Cause::Length {
            allowed: rules.length,
            needed: least(ways, |way| {
                way.plan.pushes().iter().map(|push| push.length).fold(0.0, f64::max)
            }),
        }),
    );
    add(&|task| task.pushes.directions = Directions::Count(WAYS), Box::new(|_| Cause::Directions));
    add(
        &|task| task.pushes.grip_yaws = Directions::Count(WAYS / 2).headings(),
        Box::new(|ways| Cause::GripYaws {
            needed: ways.first().and_then(|way| way.plan.push_steps().next()).map_or(0.0, |step| {
                let turn = step.grip_yaw.rem_euclid(TAU);
                if turn > 0.5 * TAU { turn - TAU } else { turn }
            }),
        }),
    );
    add(
        &|task| task.robot.reach_max *= LONGER,
        Box::new(|ways| Cause::Far {
            allowed: robot.reach_max,
            needed: least(ways, |way| {
                let pushes = way.plan.pushes();
                let ends = pushes.iter().flat_map(|push| [push.start.norm(), push.end().norm()]);
                ends.fold(0.0, f64::max)
            }),
        }),
    );
    add(
        &|task| task.robot.reach_min = 0.0,
        Box::new(|ways| Cause::Near {
            allowed: robot.reach_min,
            needed: -least(ways, |way| {
                let pushes = way.plan.pushes();
                let near = pushes.iter().map(|push| distance_to_origin(push.start, push.end()));
                -near.fold(f64::INFINITY, f64::min)
            }),
        }),
    );
    for (index, pose) in joined(task) {
        add(
            &|task| {
                let goal = &mut task.goals[0];
                let heading = goal.heading().map_or(0.0, |facing| facing.heading);
                let position = goal.position().unwrap_or_default();
                let there = Pose { position, heading } * pose;
                goal.object = index;
                goal.set_position(there.position);
                let facing = goal.demands.iter_mut().filter_map(Demand::facing_mut);
                facing.for_each(|facing| facing.heading = there.heading);
            },
            Box::new(move |_| Cause::Joined { needed: task.scene.objects[index].name.clone() }),
        );
    }
    add(
        &|task| {
            task.scene.objects.iter_mut().for_each(|object| object.keep = None);
            task.scene.keep_out.clear();
        },
        Box::new(|_| Cause::Kept),
    );
    add(&|task| task.robot.hand = None, Box::new(|_| Cause::Hand));
    for obstacle in nearest(task) {
        let name = &obstacle.name;
        add(
            &|task| task.scene.obstacles.retain(|other| other.name != *name),
            Box::new(move |_| match name.as_str() {
                name if name.starts_with(Robot::BASE) => Cause::Base,
                _ => Cause::Obstacle { name: name.clone() },
            }),
        );
    }
    let others = Task { tools: ToolChoice::All, ..task.clone() };
    if let (true, Ok(tools)) = (others != *task, others.tools(library)) {
        let cause = |ways: &[Way]| Cause::Tool {
            needed: ways.first().map(|way| way.tool.clone()).unwrap_or_default(),
        };
        // The relaxed tools follow the limits of robot and pushes, and precede the obstacles.
        let at = all.len().min(4);
        all.insert(at, Wider { task: others, tools, cause: Box::new(cause) });
    }
    all
}

/// Returns the obstacles nearest to the goal and to its object.
fn nearest(task: &Task) -> Vec<&Obstacle> {
    let from = task.scene.objects[task.goals[0].object].pose.position;
    let goal = task.goals[0].place(&task.scene.start());
    let far = |obstacle: &Obstacle| {
        let at = obstacle.pose.position;
        (at - goal).norm().min((at - from).norm())
    };
    let mut obstacles: Vec<&Obstacle> = task.scene.obstacles.iter().collect();
    obstacles.sort_by(|a, b| far(a).total_cmp(&far(b)));
    obstacles.truncate(OBSTACLES);
    obstacles
}

/// Returns the smallest value that one of the plans needs, rounded up to whole steps.
fn least(ways: &[Way], of: impl Fn(&Way) -> f64) -> f64 {
    let least = ways.iter().map(of).fold(f64::INFINITY, f64::min);
    (least / STEP).ceil() * STEP
}

/// Returns objects that are rigidly joined to the goal's object, with their poses relative to it.
fn joined(task: &Task) -> Vec<(usize, Pose)> {
    if task.goals[0].is_relation() {
        return Vec::new();
    }
    let mut found = vec![task.goals[0].object];
    let mut next = 0;
    while let Some(&one) = found.get(next) {
        let fixed = task.scene.joints.iter().filter(|joint| joint.kind == JointKind::Fixed);
        let of_one = fixed.filter(|joint| joint.between.contains(&one));
        let others: Vec<usize> = of_one.flat_map(|joint| joint.between).collect();
        others.into_iter().for_each(|other| {
            if !found.contains(&other) {
                found.push(other)
            }
        });
        next += 1;
    }
    let poses = &task.scene.objects;
    let from = poses[task.goals[0].object].pose.inverse();
    found.into_iter().skip(1).map(|index| (index, from * poses[index].pose)).collect()
}

//! Distances that no tool and no push can bridge, from upper bounds and without a search.

use std::sync::Arc;

use crate::geometry::{Pose, Vector};
use crate::scene::{GRAVITY, Obstacle, Situation, Tool};
use crate::task::Task;

use super::Cause;

/// Room for rounding, stand-off and contacts, metres.
const ROOM: f64 = 0.02;

/// Reach beyond the farther of object and goal that suffices for any tool, metres.
const BEHIND: f64 = 0.1;

/// Factor of the free slide after a push: an elastic impact doubles the speed.
const REBOUND: f64 = 4.0;

/// Ratio of the longest push of refinement to the task's length.
const LONGEST: f64 = 1.5;

/// Returns a cause if a goal is farther away than any tool and push can bring its object. Such a
/// task needs no search.
pub(in crate::solve) fn beyond(
    task: &Task,
    situation: &Situation,
    tools: &[Arc<Tool>],
) -> Option<Cause> {
    let Situation { scene, start, physics } = situation;
    // Guessed frictions bound no distance.
    if task.unknown.any() || task.pushes.max_count == 0 {
        return None;
    }
    let free = |k: usize| {
        scene.mount(k).is_none() && scene.joints.iter().all(|joint| !joint.between.contains(&k))
    };
    task.goals.iter().find_map(|goal| {
        let (k, wanted) = (goal.object, goal.position()?);
        if goal.is_relation()
            || goal.relative().is_some()
            || goal.reached(start)
            || !free(k)
            || scene.objects[k].may_fall
        {
            return None;
        }
        let friction = physics.support_friction(k);
        let slide = REBOUND * task.pushes.speed.powi(2) / (2.0 * friction * GRAVITY);
        let beside = ROOM + goal.tolerance() + slide;
        let possible = tool_reach(task, tools) + others(situation, k) + width(situation, k) / 2.0;
        let distance = wanted.norm();
        if distance > possible + beside {
            let subject = format!("the goal of `{}`", scene.objects[k].name);
            let (needed, length) = suffices(task, situation, k, wanted);
            return Some(Cause::Beyond { subject, distance, possible, needed, length });
        }
        let distance = (wanted - start.poses[k].position).norm();
        let pushed = task.pushes.max_count as f64 * (LONGEST * task.pushes.length + slide);
        // A body in the way may turn a short push into a longer way.
        let empty = scene.obstacles.iter().all(Obstacle::is_robot);
        let alone = empty && scene.things().count() == 1;
        let (allowed, length) = (task.pushes.max_count, task.pushes.length);
        let needed = sufficient_length(task, distance);
        let far = alone && distance > pushed + ROOM + goal.tolerance();
        far.then_some(Cause::TooFewPushes { distance, allowed, length, needed })
    })
}

/// Returns a cause if a tool can touch neither the goal's object nor any object on its way. The
/// search of such a task makes no rollout.
pub(in crate::solve) fn out_of_reach(
    task: &Task,
    situation: &Situation,
    tools: &[Arc<Tool>],
) -> Option<Cause> {
    let Situation { scene, start, .. } = situation;
    task.goals.iter().find_map(|goal| {
        let k = scene.thing(goal.object);
        let jointed = scene.joints.iter().any(|joint| joint.between.contains(&k));
        if jointed || goal.reached(start) {
            return None;
        }
        let solids = scene.parts_of(k).chain([k]);
        let near = solids.map(|k| {
            start.poses[k].position.norm() - scene.objects[k].shape.footprint().bounding_radius()
        });
        let distance = near.fold(f64::INFINITY, f64::min);
        let possible = tool_reach(task, tools) + others(situation, k);
        let (needed, length) = suffices(task, situation, k, goal.place(start));
        let subject = format!("`{}`", scene.objects[k].name);
        (distance > possible + ROOM).then_some(Cause::Beyond {
            subject,
            distance,
            possible,
            needed,
            length,
        })
    })
}

/// Returns the largest distance of a tool's points from the base, metres.
fn tool_reach(task: &Task, tools: &[Arc<Tool>]) -> f64 {
    let reach = |tool: &Arc<Tool>| {
        let held = tool.pose(Pose::default());
        let parts = tool.parts().iter().enumerate();
        let far = parts.map(|(k, part)| {
            tool.part_pose(k, &held).position.norm() + part.footprint().bounding_radius()
        });
        far.fold(0.0, f64::max)
    };
    task.robot.reach_max + tools.iter().map(reach).fold(0.0, f64::max)
}

/// Returns the width of all objects but `k`, which may push it in a row, metres.
fn others(situation: &Situation, k: usize) -> f64 {
    let things = situation.scene.things().map(|(other, _)| other);
    things.filter(|other| *other != k).map(|other| width(situation, other)).sum()
}

/// Returns the largest width of an object with its parts, metres.
fn width(situation: &Situation, k: usize) -> f64 {
    let objects = &situation.scene.objects;
    let own = |k: usize| objects[k].shape.footprint().bounding_radius();
    let place = |k: usize| objects[k].whole.map_or(0.0, |whole| whole.place.position.norm());
    let solids = situation.scene.parts_of(k).chain([k]);
    2.0 * solids.map(|k| place(k) + own(k)).fold(0.0, f64::max)
}

/// Returns a reach that suffices for pushes of object `k` to a place, metres, and a length of
/// pushes that suffices if the task's length does not.
fn suffices(task: &Task, situation: &Situation, k: usize, to: Vector) -> (f64, Option<f64>) {
    let from = situation.start.poses[k].position;
    let reach = from.norm().max(to.norm()) + width(situation, k) / 2.0 + BEHIND;
    let length = sufficient_length(task, (to - from).norm());
    (reach, (length > task.pushes.length).then_some(length))
}

/// Returns a length of the allowed number of pushes for a way, metres.
fn sufficient_length(task: &Task, distance: f64) -> f64 {
    distance / task.pushes.max_count.max(1) as f64 + ROOM
}

//! Bodies that obstruct a plan: all are removed, and the rule book names the ones that the plan
//! found then would meet.

use crate::plan::alone;
use crate::scene::{Robot, Scene};
use crate::solve::planner::stated;
use crate::task::Task;

use super::Cause;
use super::enclosed::Walls;
use super::relaxed::{Case, Way, culprits, distinct, replayed};

/// Distance from the robot at which removed objects are placed, metres: no push reaches them.
const FAR_AWAY: f64 = 1e3;

/// Displacement of an object in a replay beyond which it obstructs the plan, metres.
const MOVED: f64 = 5e-3;

/// Maximum number of rounds in which a plan meets further bodies.
const ROUNDS: usize = 8;

/// Maximum number of bodies for which the removal of each alone is tried.
const SINGLE: usize = 6;

/// Returns the bodies whose removal leads to a plan; a single one if it suffices.
pub(super) fn obstructed(case: &Case, walls: Option<&Walls>) -> Option<Cause> {
    let mut empty = case.task.clone();
    // A push that cleared an object is available.
    empty.pushes.max_count += 1;
    let mut open = match alone(&empty, &stated(&empty)) {
        Some((mut task, situation)) => {
            let poses = situation.start.poses.iter();
            task.scene.objects.iter_mut().zip(poses).for_each(|(one, pose)| one.pose = *pose);
            task
        }
        None => case.task.clone(),
    };
    open.scene.obstacles.clear();
    open.scene.keep_out.clear();
    if open == *case.task {
        return None;
    }
    let ways = case.ways(&open, case.tools);
    let works = |names: &Vec<String>| {
        !names.is_empty() && !case.ways(&without(case.task, names), case.tools).is_empty()
    };
    let mut sets: Vec<Vec<String>> = ways.iter().map(|way| met(case.task, way)).collect();
    sets.sort_by_key(Vec::len);
    sets.dedup();
    let mut names = sets.into_iter().find(works)?;
    let (movable, fixed): (Vec<String>, Vec<String>) =
        names.iter().cloned().partition(|name| is_movable(case.task, name));
    if !fixed.is_empty() && works(&movable) {
        names = movable;
    }
    if (2..=SINGLE).contains(&names.len())
        && let Some(one) = names.iter().map(|name| vec![name.clone()]).find(works)
    {
        names = one;
    }
    Some(explained(case.task, names, walls))
}

/// Returns the bodies that a plan meets, one round of replays after another.
fn met(task: &Task, way: &Way) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for _ in 0..ROUNDS {
        let left = without(task, &names);
        let verdict = replayed(&left, &way.plan, &way.tools);
        if verdict.nominal_ok() {
            break;
        }
        let moved = verdict.evidence.iter().flat_map(|evidence| {
            let ends = evidence.outcome.state.poses.iter();
            let both = left.scene.objects.iter().zip(ends).enumerate();
            both.filter(|(_, (one, end))| (end.position - one.pose.position).norm() > MOVED)
                .map(|(k, _)| left.scene.objects[left.scene.thing(k)].name.clone())
        });
        let culprits = culprits(&verdict);
        let all = culprits.iter().cloned().chain(moved);
        let found = distinct(all.filter(|name| is_removable(task, name)));
        let before = names.len();
        names = distinct(names.into_iter().chain(found));
        if names.len() == before {
            break;
        }
    }
    names
}

/// Returns `true` if a name is an obstacle, a region, or an object that no goal names.
fn is_removable(task: &Task, name: &str) -> bool {
    let Scene { objects, obstacles, keep_out, .. } = &task.scene;
    let named = |k: usize| task.goals.iter().any(|goal| goal.objects().any(|own| own == k));
    obstacles.iter().any(|one| one.name == name)
        || keep_out.iter().any(|one| one.name == name)
        || objects.iter().enumerate().any(|(k, one)| {
            one.name == name && !one.is_part() && !named(k) && !is_jointed(&task.scene, k)
        })
}

/// Returns `true` if a name is an object that may be pushed aside.
fn is_movable(task: &Task, name: &str) -> bool {
    task.scene.objects.iter().any(|one| one.name == name && one.keep.is_none())
}

/// Returns `true` if an object has a joint.
fn is_jointed(scene: &Scene, k: usize) -> bool {
    scene.mount(k).is_some() || scene.joints.iter().any(|joint| joint.between.contains(&k))
}

/// Returns the task without the bodies with these names. Objects are moved far away, so that the
/// indices of the others stay.
fn without(task: &Task, names: &[String]) -> Task {
    let mut task = task.clone();
    let scene = &mut task.scene;
    scene.obstacles.retain(|one| !names.contains(&one.name));
    scene.keep_out.retain(|one| !names.contains(&one.name));
    for k in 0..scene.objects.len() {
        let thing = scene.thing(k);
        if names.contains(&scene.objects[thing].name) {
            let object = &mut scene.objects[k];
            object.pose.position.x -= FAR_AWAY * (thing + 1) as f64;
            object.keep = None;
            object.kept_from = None;
            scene.table_top = None;
        }
    }
    task
}

/// Returns the cause for a set of bodies.
fn explained(task: &Task, names: Vec<String>, walls: Option<&Walls>) -> Cause {
    let is_region = |name: &String| task.scene.keep_out.iter().any(|one| one.name == *name);
    let is_kept = |name: &String| {
        task.scene.objects.iter().any(|one| one.name == *name && one.keep.is_some())
    };
    if names.iter().all(|name| name.starts_with(Robot::BASE)) {
        return Cause::Base;
    }
    if let Some(Walls { subject, by }) = walls {
        return Cause::Enclosed { subject: subject.clone(), by: by.clone(), open: names };
    }
    if names.iter().all(|name| is_region(name) || is_kept(name)) {
        return Cause::Kept { names };
    }
    match names.iter().all(|name| is_movable(task, name)) {
        true => Cause::Clear { objects: names, allowed: task.pushes.max_count },
        false => Cause::Obstructed { names },
    }
}

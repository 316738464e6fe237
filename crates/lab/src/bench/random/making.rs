//! Plans that define goals: random pushes that a task allows, and their outcomes.

use std::f64::consts::FRAC_PI_8;
use std::sync::Arc;

use pushplan::internals::geometry::Vector;
use pushplan::internals::plan::{
    Candidate, CandidatePush, Evaluation, Rollouts, Start, Workspace, evaluate,
};
use pushplan::internals::{
    scene::{Span, Tool},
    task::{Plan, Push, PushStep, Step, Task},
};
use rand::Rng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

use super::kind::{Rules, TaskKind};
use super::one_push::{TRAVEL, WAYS};

/// Additional stand-off of pushes after the first in plans that define goals, metres. The object is
/// not exactly at its predicted pose, and the tool must not be placed on top of it.
const LATER_ROOM: f64 = 0.01;

/// Number of first pushes that are drawn before a table is given up: most tools do not suit most
/// directions.
const DRAWS: usize = 60;

/// Largest deviation of an obstructed object's pushes from its straight path, radians, and
/// additional length of these pushes, metres.
const STRAIGHT: f64 = 0.1;
const STRAY: f64 = 0.015;

/// Returns the search workspace of a task with these tools.
pub(super) fn workspace<'a>(task: &'a Task, tools: &'a [Arc<Tool>]) -> Workspace<'a> {
    Workspace { task, tools }
}

/// Draws a candidate of a kind in which the first push of every object is feasible from the start.
/// Returns `None` if none was found.
pub(super) fn random_candidate(
    rng: &mut Pcg64,
    workspace: &Workspace,
    kind: TaskKind,
) -> Option<Candidate> {
    let mut made = Candidate::default();
    for object in meant_for(rng, workspace.task, kind) {
        let further = pushes_of(rng, workspace, kind, (object, made.pushes.len()))?;
        made.pushes.extend(further.pushes);
    }
    (kind != TaskKind::TwoTools || made.tool_changes() > 0).then_some(made)
}

/// Returns the objects that the pushes of a plan move, in order.
fn meant_for(rng: &mut Pcg64, task: &Task, kind: TaskKind) -> Vec<usize> {
    let mut objects: Vec<usize> = (1..=kind.aside()).collect();
    objects.shuffle(rng);
    objects.extend(task.goals.iter().map(|goal| goal.object));
    objects
}

/// Draws pushes of an object with one tool, which follow `before` pushes of others. Returns `None`
/// if no first push was found that is feasible from the start.
fn pushes_of(
    rng: &mut Pcg64,
    workspace: &Workspace,
    kind: TaskKind,
    (object, before): (usize, usize),
) -> Option<Candidate> {
    let Rules { made_with: [least, most], travel, .. } = kind.rules();
    let task = workspace.task;
    let at = task.scene.objects[object].pose.position;
    let angle = |way: Vector| way.y.atan2(way.x);
    // Obstructing objects are cleared in any direction; the goal's object is pushed as straight as
    // possible.
    let is_aside = kind.aside() > 0 && object != task.goals[0].object;
    let straight = kind.aside() > 0 && !is_aside;
    (0..DRAWS).find_map(|_| {
        let pushes = if is_aside { 1 } else { rng.random_range(least..=most) };
        let way = task.goals[0].place(&task.scene.start()) - at;
        let travel = match straight {
            true => {
                let each = way.norm() / pushes as f64 + LATER_ROOM;
                Span::new(each, (each + STRAY).min(travel.high))
            }
            false => travel,
        };
        if travel.low >= travel.high {
            return None;
        }
        let pushed = ((object, before), pushes, travel);
        let candidate = draw(rng, workspace, pushed, |rng, index, last| match straight {
            true => angle(way) + rng.random_range(-STRAIGHT..=STRAIGHT),
            false => {
                let left = rng.random::<bool>();
                let (middle, half) = kind.directions(angle(at), before + index, last, left);
                let wanted = middle + rng.random_range(-half..=half);
                near_a_way(rng, wanted)
            }
        });
        first_push(workspace, &candidate).map(|_| candidate)
    })
}

/// Draws a feasible plan of one push in any direction. Returns `None` if none was found.
pub(super) fn random_plan(rng: &mut Pcg64, task: &Task, tools: &[Arc<Tool>]) -> Option<Plan> {
    /// Number of tries, enough for any table with a feasible push.
    const TRIES: usize = 2000;
    let workspace = workspace(task, tools);
    (0..TRIES).find_map(|_| {
        let candidate =
            draw(rng, &workspace, ((task.goals[0].object, 0), 1, TRAVEL), |rng, _, _| {
                std::f64::consts::TAU / WAYS as f64 * f64::from(rng.random_range(0..WAYS as u32))
            });
        let push = first_push(&workspace, &candidate)?;
        Some(plan(&workspace, &candidate, vec![push]))
    })
}

/// Rolls out the candidate in the model of `rollouts`. Returns `None` if it breaks a rule.
pub(super) fn carried_out(
    workspace: &Workspace,
    rollouts: &mut Rollouts,
    candidate: &Candidate,
) -> Option<Evaluation> {
    let made = evaluate(workspace, rollouts, std::slice::from_ref(candidate)).pop()?.ok()?;
    (made.is_feasible() && made.is_sound()).then_some(made)
}

/// Returns `true` if the tool keeps clear of the obstacles on these pushes.
pub(super) fn keeps_clear(workspace: &Workspace, candidate: &Candidate, pushes: &[Push]) -> bool {
    let start = workspace.task.scene.start();
    let object = workspace.task.goals[0].object;
    pushes.iter().zip(&candidate.pushes).all(|(push, planned)| {
        let margins = workspace.margins(planned.grip(), (&start, object), push, None);
        margins.violation().is_none()
    })
}

/// Converts a candidate's pushes to a plan.
pub(super) fn plan(workspace: &Workspace, candidate: &Candidate, pushes: Vec<Push>) -> Plan {
    let rules = &workspace.task.pushes;
    let step = |(push, planned): (Push, &CandidatePush)| {
        let tool = workspace.tools[planned.tool].name.clone();
        let (grip_yaw, form, lift) = (planned.grip_yaw, rules.form, rules.lift);
        Step::Push(PushStep { tool, grip_yaw, form, lift, push })
    };
    Plan { steps: pushes.into_iter().zip(&candidate.pushes).map(step).collect() }
}

/// Draws a tool, a grip, and pushes of an object with random faces, offsets and lengths. `direct`
/// returns their directions, given the number of earlier pushes and the direction of the last.
fn draw(
    rng: &mut Pcg64,
    workspace: &Workspace,
    ((object, before), pushes, travel): ((usize, usize), usize, Span),
    direct: impl Fn(&mut Pcg64, usize, f64) -> f64,
) -> Candidate {
    let Workspace { task, tools, .. } = *workspace;
    let tool = rng.random_range(0..tools.len());
    let yaws = &task.pushes.grip_yaws;
    let grip_yaw = yaws[rng.random_range(0..yaws.len())];
    let start = task.scene.start();
    let mut candidate = Candidate::default();
    let mut last = 0.0;
    for index in 0..pushes {
        let direction = direct(rng, index, last);
        let part = rng.random_range(0..tools[tool].parts().len());
        let span = workspace.offset_span((tool, grip_yaw), (&start, object), part, direction);
        let offset = rng.random_range(-span..=span);
        let length = rng.random_range(travel.low..travel.high);
        let start = Start::Placed { part, offset };
        let room = if before + index > 0 { LATER_ROOM } else { 0.0 };
        let push = CandidatePush { tool, grip_yaw, object, start, direction, length, room };
        candidate.pushes.push(push);
        last = direction;
    }
    candidate
}

/// Returns the first push, if it is feasible from the start.
fn first_push(workspace: &Workspace, candidate: &Candidate) -> Option<Push> {
    let (start, planned) = (workspace.task.scene.start(), candidate.pushes.first()?);
    let placement = workspace.place(&start, planned, None).ok()?;
    let push = Push {
        start: placement.start,
        direction: planned.direction,
        length: planned.length,
        speed: workspace.task.pushes.speed,
    };
    workspace
        .margins(planned.grip(), (&start, planned.object), &push, Some(placement))
        .violation()
        .is_none()
        .then_some(push)
}

/// Draws a direction near `wanted` that refinement can reach from a direction of the search. Every
/// direction is reachable, because the search directions are twice as far apart.
fn near_a_way(rng: &mut Pcg64, wanted: f64) -> f64 {
    let spacing = std::f64::consts::TAU / WAYS as f64;
    (wanted / spacing).round() * spacing + rng.random_range(-FRAC_PI_8..FRAC_PI_8)
}

//! Replays plans in space: everything in one world, each step where the one before left things,
//! disturbed or not, as if nobody looked in between.
//!
//! Of the planner's rules for blades none is used: what is checked here is written apart, on fewer
//! looks.

use std::sync::Arc;

use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

use crate::geometry::{Pose, Solid, Vector, Vector3, wrap_angle};
use crate::{
    outcome::{LeverFault, Warning},
    scene::{LeverScene, Obstacle, Robot, Scene, Tool},
    task::{LeverRules, LeverStep, LeverUp, Pivot, Plan, PushStep, Step, Task, ToolChoice},
};

use super::rules::{in_the_way, is_within_reach};

/// Largest shift of everything that is seen against where the blade goes, along each axis, metres.
const SHIFT: f64 = 0.5e-3;

/// Largest turn of it, about the object, radians (one degree).
const TURN: f64 = std::f64::consts::PI / 180.0;

/// Largest relative change of every friction value.
const FRICTION: f64 = 0.1;

/// Slack for rounding, metres and radians.
const SLACK: f64 = 1e-5;

/// A blade may touch and scratch what is fixed by so much, metres.
const SCRATCH: f64 = 3e-4;

/// Looks at the blade during the turn.
const LOOKS: usize = 48;

/// The scene as it really is: all of it a little aside of where it was seen, rubbing a little
/// otherwise. What lies in a pocket lies aside with its pocket.
pub(super) fn disturbed(scene: &LeverScene, about: usize, seed: u64, draw: usize) -> LeverScene {
    let mut random = Pcg64::new(u128::from(seed), draw as u128);
    // A fresh stream's first numbers resemble those of its neighbours.
    let mut random = Pcg64::seed_from_u64(random.random());
    let mut within = |range: f64| random.random_range(-range..=range);
    let (shift, turn) = (Vector::new(within(SHIFT), within(SHIFT)), within(TURN));
    let about = scene.plates[about].pose.position;
    let moved = |pose: &mut Pose| {
        let arm = Pose { position: pose.position - about, ..*pose };
        *pose = Pose { position: about + shift, heading: turn } * arm;
    };
    let mut scene = scene.clone();
    scene.plates.iter_mut().for_each(|plate| moved(&mut plate.pose));
    scene.blocks.iter_mut().for_each(|block| moved(&mut block.pose));
    let own = scene.plates.iter_mut().map(|plate| &mut plate.friction);
    let fixed = scene.blocks.iter_mut().map(|block| &mut block.friction);
    let others = [&mut scene.table_friction, &mut scene.blade.friction];
    for friction in own.chain(fixed).chain(others) {
        *friction *= 1.0 + random.random_range(-FRICTION..=FRICTION);
    }
    scene
}

/// Why a plan cannot even be replayed: it names what is not there, or takes too long.
pub(super) fn unplayable(scene: &Scene, tools: &[Arc<Tool>], plan: &Plan) -> Option<Warning> {
    let mut span = 0.0;
    for (step, one) in plan.steps.iter().enumerate() {
        let fault = |fault: LeverFault| Some(Warning::CannotLever { step, fault });
        let Some(tool) = tools.iter().find(|tool| tool.name == one.tool()) else {
            return Some(Warning::ForbiddenTool { tool: one.tool().to_owned() });
        };
        match one {
            Step::Push(step) if tool.pushes() => span += step.push.length / step.push.speed,
            Step::Push(_) => return Some(Warning::ForbiddenTool { tool: one.tool().to_owned() }),
            Step::LeverUp(_) if tool.blade().is_none() => return fault(LeverFault::NoBlade),
            Step::LeverUp(LeverStep { lever, expected, .. }) => {
                if let Some(what) = nonsense(scene, lever, *expected) {
                    return fault(LeverFault::ForbiddenLever { what: what.to_owned() });
                }
                span += lever.duration();
            }
        }
        // A NaN is too long as well.
        let in_time = span <= LeverUp::LONGEST;
        if !in_time {
            return fault(LeverFault::TooLong);
        }
    }
    None
}

/// What of a lever-up makes no sense.
fn nonsense(scene: &Scene, lever: &LeverUp, expected: Option<Pose>) -> Option<&'static str> {
    let corners = scene.edges(lever.plate);
    if corners == 0 {
        return Some("object");
    }
    let on_edge = (0.0..=1.0).contains(&lever.place.fraction);
    if lever.place.edge >= corners || !on_edge || !expected.is_none_or(|pose| pose.is_finite()) {
        return Some("place");
    }
    let numbers = [lever.depth, lever.pivot, lever.angle, lever.speed, lever.hold, lever.retreat];
    let moves = lever.speed > 0.0 && lever.angle > 0.0 && lever.hold >= 0.0 && lever.retreat >= 0.0;
    (!moves || !numbers.iter().all(|v| v.is_finite())).then_some("motion")
}

/// Everything that is wrong with a plan that can be replayed, before anything moves.
pub(super) fn broken_rules(
    task: &Task,
    scene: &Scene,
    tools: &[Arc<Tool>],
    plan: &Plan,
) -> Vec<Warning> {
    let mut found = Vec::new();
    if let ToolChoice::Named(names) = &task.tools {
        let foreign =
            plan.tools().into_iter().filter(|tool| !names.iter().any(|name| name == tool));
        found.extend(foreign.map(|tool| Warning::ForbiddenTool { tool: tool.to_owned() }));
    }
    let allowed = task.pushes.max_count;
    let rows = plan.steps.chunk_by(|a, b| matches!((a, b), (Step::Push(_), Step::Push(_))));
    let rows = rows.filter(|row| matches!(row[0], Step::Push(_))).map(<[Step]>::len);
    found.extend(
        rows.filter(|row| *row > allowed).map(|pushes| Warning::TooManyPushes { pushes, allowed }),
    );
    // A tool that is driven goes through what is fixed without a trace.
    let obstacles = scene.obstacles.iter().map(Obstacle::grounded).collect();
    let fixed = Scene { obstacles, ..scene.clone() };
    for (index, step) in plan.steps.iter().enumerate() {
        let Some(tool) = tools.iter().find(|tool| tool.name == step.tool()) else { continue };
        match step {
            Step::Push(step) => found.extend(broken_by_push(task, &fixed, tool, (index, step))),
            Step::LeverUp(step) => {
                let fault = |fault| Warning::CannotLever { step: index, fault };
                found.extend(broken_by_lever(task, scene, tool, step).into_iter().map(fault));
            }
        }
    }
    found
}

/// What a push does that the task does not allow or no robot can do.
fn broken_by_push(
    task: &Task,
    fixed: &Scene,
    tool: &Tool,
    (push, step): (usize, &PushStep),
) -> Vec<Warning> {
    let mut found = Vec::new();
    let same = |yaw: &f64| wrap_angle(yaw - step.grip_yaw).abs() <= SLACK;
    if !task.pushes.grip_yaws.iter().any(same) {
        found.push(Warning::ForbiddenYaw { yaw: step.grip_yaw });
    }
    if !is_within_reach(&task.robot, &step.push) {
        found.push(Warning::OutOfReach { push });
    }
    let met = in_the_way(fixed, tool, step, true);
    found.extend(met.map(|obstacle| Warning::ThroughObstacle { push, obstacle }));
    found
}

/// What a lever-up does that the task does not allow or no robot can do.
fn broken_by_lever(task: &Task, scene: &Scene, tool: &Tool, step: &LeverStep) -> Vec<LeverFault> {
    let (lever, rules) = (&step.lever, task.lever_rules());
    let mut seen = LeverScene::with(scene, tool);
    if let Some(expected) = step.expected {
        seen.plates[lever.plate].pose = expected;
    }
    let plate = &seen.plates[lever.plate];
    let corners = plate.corners();
    let mut found = Vec::new();
    let pivot = rules.pivots.iter().any(|pivot| match pivot {
        Pivot::Auto => lever.pivot > 0.0,
        Pivot::At(distance) => (distance - lever.pivot).abs() <= SLACK,
    });
    let within = |value: f64, [low, high]: [f64; 2]| value >= low - SLACK && value <= high + SLACK;
    for (allowed, what) in [
        (task.levers.is_some(), "motion"),
        (lever.plate == task.goals[0].object, "object"),
        (within(lever.depth, rules.depth), "depth"),
        (within(lever.angle, rules.angle), "angle"),
        (pivot, "pivot"),
    ] {
        if !allowed {
            found.push(LeverFault::ForbiddenLever { what: what.to_owned() });
        }
    }
    let next = corners[(lever.place.edge + 1) % corners.len()];
    let side = (next - corners[lever.place.edge]).norm();
    if side * lever.place.fraction.min(1.0 - lever.place.fraction) < LeverRules::CORNER - SLACK {
        found.push(LeverFault::NearCorner);
    }
    if seen.blade.thickness > plate.clearance + SLACK {
        found.push(LeverFault::TooThick);
    }
    found.extend(on_the_way(&task.robot, &seen, lever));
    found
}

/// What the blade does on its way that no robot can do.
fn on_the_way(robot: &Robot, scene: &LeverScene, lever: &LeverUp) -> Vec<LeverFault> {
    let blocks: Vec<(&str, Solid)> =
        scene.blocks.iter().map(|block| (block.name.as_str(), block.solid())).collect();
    let blade = &scene.blade;
    let mut found: Vec<LeverFault> = Vec::new();
    let mut note = |fault: LeverFault| {
        if !found.contains(&fault) {
            found.push(fault);
        }
    };
    // In from behind, then the turn and the way back.
    let (lying, span) = (lever.blade(scene, 0.0), lever.duration());
    let coming = (0..LOOKS).map(|k| {
        let mut pose = lying;
        let left = lever.retreat * (1.0 - k as f64 / LOOKS as f64);
        pose.position -= pose.rotation * Vector3::x() * left;
        pose
    });
    let going = (0..=2 * LOOKS).map(|k| lever.blade(scene, span * k as f64 / (2 * LOOKS) as f64));
    for pose in coming.chain(going) {
        let grip = pose.point(Vector3::new(-0.5 * blade.length, 0.0, 0.0)).xy().norm();
        if grip < robot.reach_min - SLACK || grip > robot.reach_max + SLACK {
            note(LeverFault::OutOfReach);
        }
        let solid = Solid::cuboid([blade.length, blade.width, blade.thickness], &pose);
        if solid.lowest() < -SCRATCH {
            note(LeverFault::BelowTable);
        }
        for (name, block) in &blocks {
            if block.depth(&solid) > SCRATCH {
                note(LeverFault::Meets { body: (*name).to_owned() });
            }
            if robot.hand.is_some() && block.depth(&blade.fingers(&pose)) > SCRATCH {
                note(LeverFault::HandMeets { body: (*name).to_owned() });
            }
        }
    }
    found
}

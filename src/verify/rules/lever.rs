//! Rules of lever-ups: the task's ranges, the clearance below the edge, and the path of the blade.

use crate::geometry::{Pose, Solid, Vector, Vector3, cross};
use crate::outcome::LeverFault;
use crate::scene::{Blade, Obstacle, Plate, Region, Robot, Scene, Tool};
use crate::task::{LeverRules, LeverStep, LeverUp, Pivot, Plan, Task, lever_frame};

use super::{SLACK, reach};

/// Depth to which a blade may touch and scratch a body, metres.
pub(super) const SCRATCH: f64 = 3e-4;

/// Largest distance of an axis that follows from the plate from the support line, relative to the
/// distance of that line from the edge.
const BESIDE_LINE: f64 = 0.2;

/// Number of poses at which the blade is checked during the rotation.
const LOOKS: usize = 48;

/// Returns the value of a lever-up that is invalid in the scene, so that the lever-up cannot even
/// be replayed.
pub(super) fn nonsense(scene: &Scene, step: &LeverStep) -> Option<LeverFault> {
    nonsensical(scene, &step.lever, step.expected)
        .map(|what| LeverFault::ForbiddenLever { what: what.to_owned() })
}

fn nonsensical(scene: &Scene, lever: &LeverUp, expected: Option<Pose>) -> Option<&'static str> {
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

/// Returns the faults of a lever-up.
pub(super) fn faults(task: &Task, scene: &Scene, tool: &Tool, step: &LeverStep) -> Vec<LeverFault> {
    if let Some(fault) = nonsense(scene, step) {
        return vec![fault];
    }
    let lever = &step.lever;
    let (plate, blade) = (expected_plate(scene, step), tool.blade().unwrap_or_default());
    let corners = plate.corners();
    let mut found = outside_of_rules(task, &plate, lever);
    found.extend(task.arm.as_ref().map(|_| LeverFault::ByArm));
    if !is_below(corners, lever) {
        found.push(LeverFault::TooDeep);
    }
    // An axis above the blade would press its tip down.
    if (0.0..=lever.depth).contains(&lever.pivot) {
        found.push(LeverFault::NoSupport);
    }
    let next = corners[(lever.place.edge + 1) % corners.len()];
    let side = (next - corners[lever.place.edge]).norm();
    if side * lever.place.fraction.min(1.0 - lever.place.fraction) < LeverRules::CORNER - SLACK {
        found.push(LeverFault::NearCorner);
    }
    if blade.thickness > plate.clearance + SLACK {
        found.push(LeverFault::TooThick);
    }
    found.extend(on_the_way(&task.robot, scene, (&plate, &blade), lever));
    found
}

/// Returns a fault if step `index` levers its object more often than the task has goals for it.
pub(super) fn repeated(
    task: &Task,
    plan: &Plan,
    (index, step): (usize, &LeverStep),
) -> Option<LeverFault> {
    let own = step.lever.plate;
    let before = plan.first(index).lever_steps().filter(|one| one.lever.plate == own).count();
    let goals = task.goals.iter().filter(|goal| goal.movers().contains(&own)).count();
    let what = "second lever-up of an object".to_owned();
    (before > 0 && before >= goals).then_some(LeverFault::ForbiddenLever { what })
}

/// Returns the levered object at the pose to which the blade goes.
pub(super) fn expected_plate(scene: &Scene, step: &LeverStep) -> Plate {
    let plate = Plate::of(scene, step.lever.plate);
    Plate { pose: step.expected.unwrap_or(plate.pose), ..plate }
}

/// Returns `true` if the tip of the blade lies below the plate.
fn is_below(corners: &[Vector], lever: &LeverUp) -> bool {
    let tip = lever_frame(corners, lever.place).point(Vector::new(lever.depth, 0.0));
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).all(|(from, to)| cross(to - from, tip - from) > 0.0)
}

/// Returns the values of a lever-up that the task does not allow.
fn outside_of_rules(task: &Task, plate: &Plate, lever: &LeverUp) -> Vec<LeverFault> {
    let rules = task.lever_rules();
    let same = |one: f64, other: f64| (one - other).abs() <= SLACK;
    let pivot = rules.pivots.iter().any(|pivot| match pivot {
        Pivot::Auto => plate
            .auto_pivot(lever.place)
            .is_some_and(|line| (lever.pivot - line).abs() <= BESIDE_LINE * line + SLACK),
        Pivot::At(distance) => same(*distance, lever.pivot),
    });
    let within = |value: f64, [low, high]: [f64; 2]| value >= low - SLACK && value <= high + SLACK;
    let allowed = [
        (task.levers.is_some(), "motion"),
        (task.has_goal(lever.plate), "object"),
        (within(lever.depth, rules.depth), "depth"),
        (within(lever.angle, rules.angle), "angle"),
        (pivot, "pivot"),
        (same(lever.speed, rules.speed), "speed"),
        (same(lever.hold, rules.hold), "hold"),
        (same(lever.retreat, rules.retreat), "retreat"),
    ];
    let forbidden = allowed.into_iter().filter(|(allowed, _)| !allowed);
    forbidden.map(|(_, what)| LeverFault::ForbiddenLever { what: what.to_owned() }).collect()
}

/// Returns the faults of the blade's motion, each once.
fn on_the_way(
    robot: &Robot,
    scene: &Scene,
    (plate, blade): (&Plate, &Blade),
    lever: &LeverUp,
) -> Vec<LeverFault> {
    let solid = |block: &'_ Obstacle| (block.name.clone(), block.solid(), [true; 2]);
    let column =
        |region: &Region| (region.name.clone(), region.column(), [region.tool, region.hand]);
    let blocks: Vec<(String, Solid, [bool; 2])> =
        scene.obstacles.iter().map(solid).chain(scene.keep_out.iter().map(column)).collect();
    let at = |time: f64| lever.blade_on(plate, blade, time);
    let mut found: Vec<LeverFault> = Vec::new();
    let mut note = |fault: LeverFault| {
        if !found.contains(&fault) {
            found.push(fault);
        }
    };
    // The blade approaches from behind, then rotates and retreats.
    let (lying, span) = (at(0.0), lever.duration());
    let coming = (0..LOOKS).map(|k| {
        let mut pose = lying;
        let left = lever.retreat * (1.0 - k as f64 / LOOKS as f64);
        pose.position -= pose.rotation * Vector3::x() * left;
        pose
    });
    let going = (0..=2 * LOOKS).map(|k| at(span * k as f64 / (2 * LOOKS) as f64));
    for pose in coming.chain(going) {
        reach::blade_out_of_reach(robot, blade, &pose).into_iter().for_each(&mut note);
        let solid = blade.swept(&pose, 0.0);
        if solid.lowest() < -SCRATCH {
            note(LeverFault::BelowTable);
        }
        for (name, block, [by_tool, by_hand]) in &blocks {
            if *by_tool && block.depth(&solid) > SCRATCH {
                note(LeverFault::Meets { body: name.clone() });
            }
            let held = robot.hand.is_some() && *by_hand;
            if held && block.depth(&blade.fingers(&pose, 0.0)) > SCRATCH {
                note(LeverFault::HandMeets { body: name.clone() });
            }
        }
    }
    found
}

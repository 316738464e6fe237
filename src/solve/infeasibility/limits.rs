//! Relaxations of single limits, one function for each.

use std::f64::consts::TAU;

use crate::geometry::{Pose, distance_to_origin};
use crate::outcome::Warning;
use crate::plan::{HAND_CLEARANCE, Infeasible};
use crate::scene::{Engine, JointKind};
use crate::task::{Demand, Directions, PushRules, Task, ToolChoice};

use super::relaxed::{Case, Relaxed, Way, culprits, distinct, met_by_hand, replayed};
use super::{Cause, Hints};

/// Number of additional pushes in a relaxed task.
const MORE_PUSHES: usize = 2;

/// Factor of lengths and reaches in a relaxed task.
const LONGER: f64 = 4.0;

/// Number of directions of a relaxed task; half of it for grip yaws.
const WAYS: usize = 16;

/// Step to which reported limits are rounded up, metres.
const STEP: f64 = 0.01;

/// Height of a tool above a solid that it passes over, metres.
const ABOVE: f64 = 0.005;

/// Factor of a force between the nominal replays and the advice: frictions differ by a tenth, and
/// another plan may press a little harder.
const FORCE_MARGIN: f64 = 1.25;

/// Finder of a cause: a function that returns the relaxed tasks of one limit.
struct Finder {
    relaxed: for<'a> fn(&'a Case<'a>) -> Vec<Relaxed<'a>>,
    hinted: fn(&Hints) -> Hinted,
}

/// Likelihood of a cause.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Hinted {
    /// Pushes or plans failed at this limit.
    Likely,
    Possible,
    /// No push or plan met this limit.
    Excluded,
}

/// Finders in the order of their causes among equally likely ones.
const FINDERS: [Finder; 13] = [
    Finder { relaxed: force, hinted: |hints| by(hints.failed(is_force), false) },
    Finder {
        relaxed: hand,
        hinted: |hints| {
            let often = hints.often(Infeasible::Hand) || hints.failed(is_hand);
            by(often, hints.any(Infeasible::Hand))
        },
    },
    Finder { relaxed: kept, hinted: |hints| by(hints.failed(is_kept), true) },
    Finder { relaxed: tool, hinted: |_| Hinted::Possible },
    Finder { relaxed: far, hinted: |hints| by(false, hints.any(Infeasible::Reach)) },
    Finder { relaxed: length, hinted: |_| Hinted::Possible },
    Finder { relaxed: lift, hinted: |_| Hinted::Possible },
    Finder { relaxed: directions, hinted: |_| Hinted::Possible },
    Finder { relaxed: grip_yaws, hinted: |_| Hinted::Possible },
    Finder { relaxed: pushes, hinted: |_| Hinted::Possible },
    Finder { relaxed: near, hinted: |hints| by(false, hints.any(Infeasible::Reach)) },
    Finder { relaxed: joined, hinted: |_| Hinted::Possible },
    Finder {
        relaxed: travel,
        hinted: |hints| {
            let often = hints.often(Infeasible::NoWay) || hints.failed(is_way);
            by(often, hints.any(Infeasible::NoWay))
        },
    },
];

/// Returns the tasks with one limit relaxed, likely causes first.
pub(super) fn limits<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let mut finders: Vec<(Hinted, &Finder)> =
        FINDERS.iter().map(|finder| ((finder.hinted)(case.hints), finder)).collect();
    finders.retain(|(hinted, _)| *hinted != Hinted::Excluded);
    finders.sort_by_key(|(hinted, _)| *hinted);
    finders.into_iter().flat_map(|(_, finder)| (finder.relaxed)(case)).collect()
}

fn by(likely: bool, possible: bool) -> Hinted {
    match (likely, possible) {
        (true, _) => Hinted::Likely,
        (_, true) => Hinted::Possible,
        _ => Hinted::Excluded,
    }
}

fn is_force(warning: &Warning) -> bool {
    matches!(warning, Warning::TooMuchForce { .. })
}

fn is_hand(warning: &Warning) -> bool {
    matches!(warning, Warning::HandThrough { .. })
}

fn is_kept(warning: &Warning) -> bool {
    matches!(warning, Warning::NotKept { .. } | Warning::KeptOut { .. })
}

fn is_way(warning: &Warning) -> bool {
    matches!(warning, Warning::NoWay { .. } | Warning::NotLifted { .. })
}

fn pushes<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let allowed = case.task.pushes.max_count;
    let explain = move |ways: &[Way]| {
        let needed = ways.iter().map(|way| way.plan.pushes().len()).min()?;
        (needed > allowed).then_some(Cause::Pushes { allowed, needed })
    };
    case.relaxed(|task| task.pushes.max_count += MORE_PUSHES, explain).into_iter().collect()
}

fn length<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let allowed = case.task.pushes.length;
    let explain = move |ways: &[Way]| {
        let longest =
            |way: &Way| way.plan.pushes().iter().map(|push| push.length).fold(0.0, f64::max);
        let needed = least(ways, longest);
        (needed > allowed).then_some(Cause::Length { allowed, needed })
    };
    case.relaxed(|task| task.pushes.length *= LONGER, explain).into_iter().collect()
}

fn directions<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let change = |task: &mut Task| {
        // Many stated directions are not replaced by fewer.
        if task.pushes.directions.headings().len() < WAYS {
            task.pushes.directions = Directions::Count(WAYS);
        }
    };
    let explain = |_: &[Way]| Some(Cause::Directions { needed: WAYS });
    case.relaxed(change, explain).into_iter().collect()
}

fn grip_yaws<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let explain = |ways: &[Way]| {
        let turn = ways.first()?.plan.push_steps().next()?.grip_yaw.rem_euclid(TAU);
        let needed = if turn > 0.5 * TAU { turn - TAU } else { turn };
        Some(Cause::GripYaws { needed })
    };
    let all = Directions::Count(WAYS / 2).headings();
    case.relaxed(|task| task.pushes.grip_yaws = all, explain).into_iter().collect()
}

fn tool<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let others = Task { tools: ToolChoice::All, ..case.task.clone() };
    let Some(tools) = others.tools(case.library).ok().filter(|_| others != *case.task) else {
        return Vec::new();
    };
    let explain = |ways: &[Way]| Some(Cause::Tool { needed: ways.first()?.plan.tool().to_owned() });
    vec![Relaxed { task: others, tools, explain: Box::new(explain) }]
}

fn far<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let allowed = case.task.robot.reach_max;
    let explain = move |ways: &[Way]| {
        let needed = least(ways, |way| {
            let pushes = way.plan.pushes();
            let ends = pushes.iter().flat_map(|push| [push.start.norm(), push.end().norm()]);
            ends.fold(0.0, f64::max)
        });
        (needed > allowed).then_some(Cause::Far { allowed, needed })
    };
    case.relaxed(|task| task.robot.reach_max *= LONGER, explain).into_iter().collect()
}

fn near<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let allowed = case.task.robot.reach_min;
    let explain = move |ways: &[Way]| {
        let needed = -least(ways, |way| {
            let pushes = way.plan.pushes();
            let near = pushes.iter().map(|push| distance_to_origin(push.start, push.end()));
            -near.fold(f64::INFINITY, f64::min)
        });
        (needed < allowed).then_some(Cause::Near { allowed, needed })
    };
    case.relaxed(|task| task.robot.reach_min = 0.0, explain).into_iter().collect()
}

fn joined<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let of = |(index, pose): (usize, Pose)| {
        let change = |task: &mut Task| {
            let goal = &mut task.goals[0];
            let heading = goal.heading().map_or(0.0, |facing| facing.heading);
            let position = goal.position().unwrap_or_default();
            let there = Pose { position, heading } * pose;
            goal.object = index;
            goal.set_position(there.position);
            let facing = goal.demands.iter_mut().filter_map(Demand::facing_mut);
            facing.for_each(|facing| facing.heading = there.heading);
        };
        let needed = case.task.scene.objects[index].name.clone();
        case.relaxed(change, move |_| Some(Cause::Joined { needed: needed.clone() }))
    };
    rigidly_joined(case.task).into_iter().filter_map(of).collect()
}

fn force<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    // Largest lasting force of the gentlest plan in both engines, newtons, with a margin.
    let needed = |ways: &[Way]| {
        let lasting = |way: &Way| {
            let both = Engine::ALL.into_iter().filter_map(|engine| way.verdict.nominal(engine));
            both.filter_map(|one| one.force).map(|force| force.lasting).fold(0.0, f64::max)
        };
        (FORCE_MARGIN * ways.iter().map(lasting).fold(f64::INFINITY, f64::min)).ceil()
    };
    let robot = case.task.robot.max_force.and_then(|allowed| {
        let explain = move |ways: &[Way]| {
            let needed = needed(ways);
            (needed > allowed).then_some(Cause::Force { object: None, allowed, needed })
        };
        case.relaxed(|task| task.robot.max_force = None, explain)
    });
    let objects = case.task.scene.objects.iter().enumerate();
    let fragile = objects.filter_map(|(k, object)| {
        let (allowed, object) = (object.max_force?, Some(object.name.clone()));
        let explain = move |ways: &[Way]| {
            let (object, needed) = (object.clone(), needed(ways));
            (needed > allowed).then_some(Cause::Force { object, allowed, needed })
        };
        case.relaxed(|task| task.scene.objects[k].max_force = None, explain)
    });
    robot.into_iter().chain(fragile).collect()
}

fn lift<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let (scene, allowed) = (&case.task.scene, case.task.pushes.lift);
    let solids = case.task.goals.iter().flat_map(|goal| {
        let thing = scene.thing(goal.object);
        scene.parts_of(thing).chain([thing]).map(|k| scene.objects[k].top())
    });
    let tops: Vec<f64> = solids.collect();
    let highest = tops.iter().copied().fold(0.0, f64::max);
    let above = tops.iter().map(|top| top + ABOVE);
    let mut lifts: Vec<f64> =
        above.filter(|lift| *lift > allowed && *lift < highest - ABOVE).collect();
    lifts.sort_by(f64::total_cmp);
    lifts.dedup();
    lifts.extend((allowed > PushRules::LIFT).then_some(PushRules::LIFT));
    let at = |needed: f64| {
        let explain = move |_: &[Way]| Some(Cause::Lift { allowed, needed });
        case.relaxed(|task| task.pushes.lift = needed, explain)
    };
    lifts.into_iter().filter_map(at).collect()
}

fn kept<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let change = |task: &mut Task| {
        task.scene.objects.iter_mut().for_each(|object| object.keep = None);
        task.scene.keep_out.clear();
    };
    let explain = |ways: &[Way]| {
        let way = ways.first()?;
        let scene = &case.task.scene;
        let stays = |name: &String| {
            scene.objects.iter().any(|one| one.keep.is_some() && one.name == *name)
                || scene.keep_out.iter().any(|region| region.name == *name)
        };
        let met = culprits(&replayed(case.task, &way.plan, &way.tools));
        Some(Cause::Kept { names: distinct(met.into_iter().filter(stays)) })
    };
    case.relaxed(change, explain).into_iter().collect()
}

fn hand<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let explain = |ways: &[Way]| {
        // The planner keeps the hand clear of bodies, the rule book does not.
        let mut wider = case.task.clone();
        wider.robot.hand.iter_mut().for_each(|hand| hand.radius += HAND_CLEARANCE);
        let meets = |way: &Way| met_by_hand(&replayed(&wider, &way.plan, &way.tools));
        Some(Cause::Hand { meets: distinct(ways.iter().take(1).flat_map(meets)) })
    };
    case.relaxed(|task| task.robot.hand = None, explain).into_iter().collect()
}

fn travel<'a>(case: &'a Case<'a>) -> Vec<Relaxed<'a>> {
    let (scene, allowed) = (&case.task.scene, case.task.robot.travel);
    let obstacles = scene.obstacles.iter().filter(|obstacle| !obstacle.is_robot());
    let obstacles = obstacles.map(|obstacle| obstacle.z + obstacle.size[2]);
    let highest = obstacles.chain(scene.objects.iter().map(|object| object.top()));
    let needed = ((highest.fold(0.0, f64::max) + ABOVE) / STEP).ceil() * STEP;
    if needed <= allowed {
        return Vec::new();
    }
    let explain = move |_: &[Way]| Some(Cause::Travel { allowed, needed });
    case.relaxed(|task| task.robot.travel = needed, explain).into_iter().collect()
}

/// Returns the smallest value that one of the plans needs, rounded up to whole steps.
fn least(ways: &[Way], of: impl Fn(&Way) -> f64) -> f64 {
    let least = ways.iter().map(of).fold(f64::INFINITY, f64::min);
    (least / STEP).ceil() * STEP
}

/// Returns objects that are rigidly joined to the goal's object, with their poses relative to it.
fn rigidly_joined(task: &Task) -> Vec<(usize, Pose)> {
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

//! Conversion of a model to a scene, with the goals stated in the file.

use crate::diagnostic::{Effect, Ledger, lines};
use crate::model::Model;
use pushplan::asset::Faults;
use pushplan::geometry::Vector;
use pushplan::{
    scene::{Joint, JointKind, Robot, Scene, Unknowns, WorldJoint},
    task::{Goal, Task},
};

use super::frictions::frictions;
use super::groups::{beyond, free, freed, judged, listed, massless, solid_bodies};
use super::joints::{joints, mounts};
use super::lowered::make_way;
use super::names::{Names, same};
use super::objects::{Draft, drafts, placed};
use super::slices::sliced;
use super::statics::{empty, statics};
use super::wanted::{Imported, Wanted};

/// Default reach of the robot, metres; the maximum grows to include every object.
const REACH: [f64; 2] = [0.1, 0.9];

/// Tolerance of the placeholder goal, metres.
const TOLERANCE: f64 = 0.02;

/// Imported scene, with a task around it.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedScene {
    /// Task with the imported scene; the robot, the tools and usually the goal are placeholders.
    pub task: Task,
    /// Whether the goal is from the file; otherwise it is the start of the first object.
    pub has_goal: bool,
}

/// Converts a model to objects and obstacles on a table.
///
/// # Errors
/// Returns a fault for every element that pushplan cannot express, with its place in `file`.
pub fn objects(
    model: &Model,
    file: &str,
    wanted: &Wanted,
) -> Result<Imported<ImportedScene>, Faults> {
    let mut ledger = Ledger::new(file, &model.files, model.strict);
    let freed = freed(model, wanted, &mut ledger);
    let model = &freed;
    let roots = free(model, wanted, &mut ledger);
    beyond(model, &roots, wanted, &mut ledger);
    judged(model, &roots, wanted, &mut ledger);
    if roots.is_empty() && wanted.bodies.is_empty() && ledger.count() == 0 {
        let advice = match &solid_bodies(model)[..] {
            [] => "objects must be free (<freejoint/>, or a floating joint of the world); `--as \
                   tool` imports a tool"
                .to_owned(),
            names => format!(
                "--free {} makes it free (bodies with solids: {}); `--as tool` imports a tool",
                names[0],
                listed(names)
            ),
        };
        ledger.fault_of_file("no body of the file moves freely", advice);
    }
    let assumed = wanted.density.is_none() && !ledger.is_strict() && massless(model, &roots);
    let wanted = &match assumed {
        true => Wanted { density: Some(Wanted::DENSITY), ..wanted.clone() },
        false => wanted.clone(),
    };
    let mut ledger = ledger.sound()?;
    let mut model = model.clone();
    sliced(&mut model, &roots, wanted, &mut ledger);
    let model = &model;
    let mut names = Names::default();
    let (mut found, mut hung) = (Vec::new(), Vec::new());
    for root in roots {
        let (bodies, joints) = drafts(model, root, wanted, &mut names, &mut ledger);
        found.extend(bodies);
        hung.extend(joints);
    }
    found.sort_by_key(|draft| draft.body);
    if assumed {
        let mass = |draft: &Draft<'_>| {
            let parts = draft.parts.iter().map(|(part, _)| part.mass).sum::<f64>();
            format!("`{}` {:.3} kg", draft.object.name, draft.object.mass + parts)
        };
        let masses: Vec<String> = found.iter().map(mass).collect();
        let note = format!(
            "masses are not stated; with {} kg/m^3 they are {}, and the task calls them unknown \
             (--density gives another value)",
            Wanted::DENSITY,
            listed(&masses.iter().map(String::as_str).collect::<Vec<_>>())
        );
        ledger.note_of_file(Effect::Strong, note);
    }
    make_way(model, &mut found, &mut ledger);
    let joints = joints(model, &found, &hung, &mut ledger);
    let mounts = mounts(model, &found, &mut ledger);
    let mut ledger = ledger.sound()?;
    let statics = statics(model, &found, wanted, &mut names, &mut ledger);
    let Some(statics) = statics else {
        return Err(ledger.finish(None::<()>).err().unwrap_or_default());
    };
    let frictions = frictions(model, &found, &statics, &mut ledger);
    let moved = |mut object: pushplan::scene::Object| {
        object.pose.position += wanted.shift;
        object
    };
    let scene = Scene {
        objects: found.iter().map(|draft| moved(draft.object.clone())).collect(),
        joints: joints
            .into_iter()
            .map(|joint| Joint { kind: shifted(joint.kind, wanted.shift), ..joint })
            .collect(),
        mounts: mounts
            .into_iter()
            .map(|mount| WorldJoint { kind: shifted(mount.kind, wanted.shift), ..mount })
            .collect(),
        frictions,
        ..empty(&statics, wanted.shift)
    };
    let scene = placed(scene, &found);
    let goals = model.goals.iter().filter_map(|(body, numbers)| {
        let object = found.iter().position(|draft| same(body, model.name_of(draft.body)))?;
        goal(&scene, object, numbers, wanted.shift)
    });
    let mut goals: std::collections::VecDeque<Goal> = goals.collect();
    let has_goal = !goals.is_empty();
    let first = scene.objects.first().map_or(Vector::zeros(), |object| object.pose.position);
    let goal = goals.pop_front();
    let goal = goal.unwrap_or_else(|| Goal::new(0, [first.x, first.y], TOLERANCE));
    let farthest =
        scene.objects.iter().map(|object| object.pose.position.norm()).fold(0.0, f64::max);
    let most = REACH[1].max(((farthest + 0.3) * 10.0).ceil() / 10.0);
    let name = wanted.name.clone().unwrap_or_else(|| super::tool::name(model, file));
    let task = Task::new(name, scene, Robot::reaching(REACH[0], most), goal);
    let task = goals.into_iter().fold(task, Task::and);
    let task = task.with_unknowns(Unknowns { masses: assumed, ..Unknowns::NONE });
    // Rules that span several bodies, such as overlaps, are checked by the task reader.
    let read = task.to_yaml().and_then(|text| Task::parse(&text, file));
    let task = match read {
        Ok(task) => Some(task),
        Err(mut faults) => {
            // Without a goal in the file, the placeholder goal is at the object, so the fault
            // concerns the object.
            for fault in faults.0.iter_mut().filter(|_| !has_goal) {
                if let Some((name, within)) = fault.message.split_once(" would overlap ") {
                    let name = name.trim_start_matches("at the goal ");
                    fault.message = format!("{name} overlaps {within}");
                    fault.advice =
                        "move one of them, or select other bodies with --body".to_owned();
                }
            }
            ledger.adopt("task", faults);
            None
        }
    };
    let (value, notes) = ledger.finish(task.map(|task| ImportedScene { task, has_goal }))?;
    Ok(Imported { value, notes: lines(notes) })
}

fn shifted(kind: JointKind, shift: Vector) -> JointKind {
    match kind {
        JointKind::Revolute { at, limits } => JointKind::Revolute { at: at + shift, limits },
        kind => kind,
    }
}

/// Tolerance above which an exported goal has no position, metres.
const ANYWHERE: f64 = 1e6;

/// Reads a goal in the form of `pushplan export`: x, y, tolerance, heading, heading tolerance,
/// order of symmetry.
fn goal(scene: &Scene, object: usize, numbers: &[f64], shift: Vector) -> Option<Goal> {
    let [x, y, tolerance, heading @ ..] = numbers else { return None };
    let goal = match *tolerance < ANYWHERE {
        true => Goal::new(object, [x + shift.x, y + shift.y], *tolerance),
        false if heading.is_empty() => return None,
        false => Goal::of(object),
    };
    let goal = match heading {
        [heading, within, alike, ..] => {
            goal.facing(*heading, *within).alike((*alike as usize).max(1))
        }
        [heading, within] => goal.facing(*heading, *within).looking_alike(scene),
        _ => goal,
    };
    Some(goal.within_limits(scene))
}

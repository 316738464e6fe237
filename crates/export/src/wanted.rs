//! MJCF of a plan's goals, which `replay.py` evaluates.

use serde_json::{Value as Json, json};

use pushplan::asset::PlanFile;
use pushplan::{
    scene::Engine,
    task::{Demand, Goal, Task},
};

use super::strokes::numeric;
use super::xml::Xml;

/// Tolerance of a goal without a position, metres.
const ANYWHERE: f64 = 1e6;

/// Returns a goal in numbers if it is a position in the world, a heading, or both.
fn pose_and_tolerance(goal: &Goal) -> Option<Vec<f64>> {
    let mut values = vec![0.0, 0.0, ANYWHERE];
    let mut heading = Vec::new();
    for demand in &goal.demands {
        match demand {
            Demand::Place(place) if place.relative.is_none() => {
                values = vec![place.position.x, place.position.y, place.tolerance];
            }
            Demand::Heading(own) if own.relative.is_none() => {
                heading = vec![own.heading, own.tolerance, own.symmetry as f64];
            }
            _ => return None,
        }
    }
    values.extend(heading);
    Some(values)
}

/// Writes the goals, and the result of our own replay.
pub(super) fn wanted(xml: &mut Xml, file: &PlanFile) {
    let scene = &file.task.scene;
    checks(xml, &file.task);
    for goal in &file.task.goals {
        let name = &scene.objects[goal.object].name;
        let Some(values) = pose_and_tolerance(goal) else {
            let words = [("name", format!("words of object/{name}")), ("data", goal.words(scene))];
            xml.leaf("text", &words);
            continue;
        };
        xml.comment(
            "Goal with a position, a heading or both: x, y, tolerance; if required, heading, its \
             tolerance, and the number of equivalent headings per rotation.",
        );
        numeric(xml, &format!("goal of object/{name}"), &values);
    }
    for object in scene.objects.iter().filter(|object| object.may_fall) {
        numeric(xml, &format!("may fall of object/{}", object.name), &[1.0]);
    }
    if let Some(evidence) = file.verdict.as_ref().and_then(|v| v.nominal(Engine::Spatial)) {
        xml.comment("Final pose in pushplan's own 3-D replay: x, y, heading.");
        for (object, pose) in scene.objects.iter().zip(&evidence.outcome.state.poses) {
            let values = [pose.position.x, pose.position.y, pose.heading];
            numeric(xml, &format!("3-D replay of object/{}", object.name), &values);
        }
    }
}

/// Writes the goals as JSON: names of their objects, and the checks evaluated by scripts.
pub(super) fn checks(xml: &mut Xml, task: &Task) {
    let goals = task.goals.iter().map(|goal| {
        json!({"object": task.scene.objects[goal.object].name, "check": goal.check(&task.scene)})
    });
    let data = Json::Array(goals.collect()).to_string();
    xml.leaf("text", &[("name", "goals".to_owned()), ("data", data)]);
}

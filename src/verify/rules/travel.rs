//! Rules of a lifted tool: it can be lifted after every push, and travels from home to the first
//! step, between steps, and back without a collision.

use std::sync::Arc;

use crate::geometry::{Footprint, Pose, clearance};
use crate::outcome::Warning;
use crate::scene::{Scene, State, Tool};
use crate::task::{BlockedLeg, Plan, Task, ToolMotion};

use super::SLACK;

/// Returns the pushes after which the tool cannot be lifted, and the first leg of its travel
/// without a path. `states` are the states before the first step and after each step.
pub(in crate::verify) fn travel_faults(
    (task, scene): (&Task, &Scene),
    library: &[Arc<Tool>],
    plan: &Plan,
    states: &[State],
) -> Vec<Warning> {
    let mut found = not_lifted(scene, library, plan, states);
    let blocked = task.legs(scene, library, plan, states).err();
    found.extend(blocked.map(|BlockedLeg { from, to, obstacle }| {
        let push = to.or(from).unwrap_or_default();
        Warning::NoWay { push, back: to.is_none(), obstacle }
    }));
    found
}

/// Returns the pushes after which something hangs above a part of the tool.
fn not_lifted(scene: &Scene, library: &[Arc<Tool>], plan: &Plan, states: &[State]) -> Vec<Warning> {
    let mut found = Vec::new();
    let mut step = 0;
    for motion in plan.motions(library).unwrap_or_default() {
        let slide = motion.slide();
        for stroke in 0..slide.strokes.len() {
            let state = states.get(step + stroke + 1).or(states.last());
            let above = above_tool((scene, state), slide, stroke);
            let push = step + stroke;
            found.extend(above.map(|obstacle| Warning::NotLifted { push, obstacle }));
        }
        step += slide.strokes.len().max(1);
    }
    found
}

/// Returns the name of a body above the tool where it is lifted after a stroke.
fn above_tool(
    (scene, state): (&Scene, Option<&State>),
    motion: &ToolMotion,
    index: usize,
) -> Option<String> {
    let stroke = motion.strokes.get(index).filter(|stroke| stroke.settle)?;
    let at = motion.retreat(scene, index).map_or(stroke.to, |back| back.to);
    let parts = motion.tool.parts().iter();
    let parts = parts.map(|part| (part.footprint(), part.pose, part.shape.height()));
    parts.chain(motion.tool.handle()).find_map(|(shape, pose, height)| {
        hanging((scene, state), (&shape, &(at * pose)), motion.lift + height)
    })
}

/// Returns the name of an obstacle or object that is over an outline, entirely above `top` metres.
fn hanging(
    (scene, state): (&Scene, Option<&State>),
    own: (&Footprint, &Pose),
    top: f64,
) -> Option<String> {
    let over = |shape: &Footprint, pose: &Pose| clearance(own, (shape, pose), SLACK) <= 0.0;
    let fixed = scene.above(top).find(|fixed| over(&fixed.footprint, &fixed.pose));
    let object = || {
        let objects = scene.objects.iter().zip(&state?.poses).enumerate();
        let mut raised = objects.filter(|(k, (object, _))| {
            object.z >= top && state.is_some_and(|state| !scene.has_left(*k, state))
        });
        let found = raised.find(|(_, (object, pose))| over(&object.shape.footprint(), pose));
        found.map(|(k, _)| scene.thing_name(k).to_owned())
    };
    fixed.map(|fixed| fixed.name.to_owned()).or_else(object)
}

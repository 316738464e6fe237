//! Rule for the hand in a replay: hand and handle pass through no object at any frame, and neither
//! do the fingers behind a blade.
//!
//! The engines simulate the tool alone, so an object in the way of the hand stays where it is.

use std::sync::Arc;

use crate::geometry::{Pose, clearance};
use crate::outcome::{Frame, Warning};
use crate::scene::{Object, Scene, State, Tool};
use crate::task::{Plan, Step, Task};

use super::{SLACK, blade, push, tools};

/// Returns the first object that the hand passes through in the frames of a replay, or while the
/// tool is set down. The frames count pushes and lever-ups as the plan does.
pub(in crate::verify) fn hand_meets(
    asked: (&Task, &Scene),
    library: &[Arc<Tool>],
    plan: &Plan,
    frames: &[Frame],
) -> Option<Warning> {
    let levering = plan.steps.iter().enumerate().find_map(|(index, one)| {
        let Step::LeverUp(step) = one else { return None };
        let blade = tools::named(library, one)?.blade()?;
        let fault = blade::met((&asked.0.robot, asked.1), &blade, (index, step), frames)?;
        Some(Warning::CannotLever { step: index, fault })
    });
    levering.or_else(|| pushing(asked, library, plan, frames))
}

/// Returns the first object that the hand or handle passes through during pushes.
fn pushing(
    (task, scene): (&Task, &Scene),
    library: &[Arc<Tool>],
    plan: &Plan,
    frames: &[Frame],
) -> Option<Warning> {
    let (mut before, mut begun) = (frames.first()?, None);
    for frame in &frames[1..] {
        let last = std::mem::replace(&mut before, frame);
        let index = frame.stroke;
        let Some(Step::Push(step)) = plan.steps.get(index) else { continue };
        let tool = tools::named(library, &plan.steps[index])?;
        let met = |at: &Pose, state: &State, descends: bool| {
            let carried = task.robot.carried(tool, step.lift);
            carried.into_iter().flatten().find_map(|carried| {
                let own = (&carried.footprint, &(*at * carried.pose));
                let meets = |(object, pose): &(&Object, &Pose)| {
                    let high = match descends {
                        true => carried.span[0] < object.top(),
                        false => object.meets(carried.span),
                    };
                    high && clearance(own, (&object.shape.footprint(), pose), SLACK) <= 0.0
                };
                let objects = scene.objects.iter().zip(&state.poses).enumerate();
                let mut on_table = objects.filter(|(k, _)| !scene.has_left(*k, state));
                let found = on_table.find(|(_, one)| meets(one));
                found.map(|(k, _)| scene.thing_name(k).to_owned())
            })
        };
        let start = tool.pose(Pose { position: step.push.start, heading: step.grip_yaw });
        let comes_down = begun != Some(index) && push::comes_down(plan, index);
        begun = Some(index);
        let on_the_way_down = if comes_down { met(&start, &last.state, true) } else { None };
        if let Some(obstacle) = on_the_way_down.or_else(|| met(&frame.tool, &frame.state, false)) {
            return Some(Warning::HandThrough { push: index, obstacle });
        }
    }
    None
}

//! Rules of clearance: fixed bodies that the tool, handle and hand must avoid during a push.

use crate::geometry::{Footprint, Pose, clearance, swept_clearance};
use crate::outcome::Warning;
use crate::scene::{Fixed, Mover, Scene, Tool};
use crate::task::{PushStep, Task};

use super::SLACK;

/// Returns the fixed bodies that the tool and hand pass through during a push, or during its
/// descent if the tool `comes_down` from above.
pub(super) fn collisions(
    (task, scene): (&Task, &Scene),
    tool: &Tool,
    (push, step): (usize, &PushStep),
    comes_down: bool,
) -> Vec<Warning> {
    let ends = [step.push.start, step.push.end()]
        .map(|position| tool.pose(Pose { position, heading: step.grip_yaw }));
    let by_tool = tool.parts().iter().enumerate().find_map(|(k, part)| {
        let span = [step.lift, step.lift + part.shape.height()];
        let ends = ends.map(|at| tool.part_pose(k, &at));
        obstruction(scene, Mover::Tool, (&part.footprint(), ends, span), comes_down)
    });
    let carried = task.robot.carried(tool, step.lift);
    let by_hand = carried.into_iter().flatten().find_map(|carried| {
        let ends = ends.map(|at| at * carried.pose);
        obstruction(scene, Mover::Hand, (&carried.footprint, ends, carried.span), comes_down)
    });
    let tool = by_tool.map(|obstacle| Warning::ThroughObstacle { push, obstacle });
    let hand = by_hand.map(|obstacle| Warning::HandThrough { push, obstacle });
    tool.into_iter().chain(hand).collect()
}

/// Returns the name of the fixed body that a mover hits during its motion or its descent.
fn obstruction(
    scene: &Scene,
    mover: Mover,
    (shape, [from, to], span): (&Footprint, [Pose; 2], [f64; 2]),
    comes_down: bool,
) -> Option<String> {
    let on_the_way = |fixed: &Fixed| {
        let still = (&fixed.footprint, &fixed.pose);
        swept_clearance(shape, &from, &to, still, SLACK) <= 0.0
    };
    let on_the_way_down = |fixed: &Fixed| {
        comes_down && clearance((shape, &from), (&fixed.footprint, &fixed.pose), SLACK) <= 0.0
    };
    let mut fixed = scene.fixed(mover, span);
    let found = fixed.find(on_the_way).or_else(|| scene.above(span[1]).find(on_the_way_down));
    found.map(|fixed| fixed.name.to_owned())
}

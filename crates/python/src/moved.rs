//! Change of a task's initial poses, for planning from an intermediate state.

use pushplan::scenes::Span;
use pushplan::{Joint, JointKind, Object, Pose, State, Task};

/// Returns the task with these initial poses. Joints move along: anchors and axes move with the
/// first object of each joint, and limits count from the new poses.
pub fn moved(task: &Task, poses: &[Pose]) -> Task {
    let mut task = task.clone();
    let scene = task.scene.moved_to(&State::at_rest(poses.to_vec()));
    let before = std::mem::replace(&mut task.scene, scene).objects;
    for joint in &mut task.scene.joints {
        joint.kind = followed(joint, &before, &task.scene.objects);
    }
    task
}

fn followed(joint: &Joint, before: &[Object], now: &[Object]) -> JointKind {
    let [first, second] = joint.frames(before);
    let [a, b] = joint.between;
    let (first, second) = (now[a].pose * first, now[b].pose * second);
    match joint.kind {
        JointKind::Fixed => JointKind::Fixed,
        JointKind::Revolute { limits, .. } => {
            let turned = second.heading - first.heading;
            JointKind::Revolute { at: first.position, limits: from(limits, turned) }
        }
        JointKind::Prismatic { limits, .. } => {
            let axis = first.vector([1.0, 0.0].into());
            let slid = (second.position - first.position).dot(&axis);
            JointKind::Prismatic { axis, limits: from(limits, slid) }
        }
    }
}

/// Returns limits relative to the displacement `come` of a joint. A joint at its limit may be
/// slightly past it, because the joints of an engine are compliant; the limit is then zero.
fn from(limits: Option<Span>, come: f64) -> Option<Span> {
    let Span { low, high } = limits?;
    Some(Span { low: (low - come).min(0.0), high: (high - come).max(0.0) })
}

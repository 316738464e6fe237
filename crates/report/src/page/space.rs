//! Page data of 3-D plans: strokes, and replays in which every body has six degrees of freedom.

use std::sync::Arc;

use pushplan::geometry::{Pose3, Vector3};
use pushplan::{
    outcome::{Frame, Trajectory},
    scene::{Plate, Tool},
    task::{Plan, Step, Task},
};

use super::data::{Layer, Measure, Replay, Stroke, fine, length, pose};
use super::replay::{differences, packed};

/// Returns a stroke for each step, with the tool's index on the page.
pub fn strokes(plan: &Plan, tools: &[Arc<Tool>], index: &dyn Fn(&str) -> usize) -> Vec<Stroke> {
    let stroke = |(k, step): (usize, &Step)| {
        let ends = match (step, tools.iter().find(|tool| tool.name == step.tool())) {
            (Step::Push(step), Some(tool)) => {
                let motion = Plan { steps: vec![Step::Push(step.clone())] }.motion(tool);
                motion.strokes.first().map(|stroke| [pose(&stroke.from), pose(&stroke.to)])
            }
            _ => None,
        };
        let [from, to] = ends.unwrap_or([[0; 3]; 2]);
        Stroke { tool: index(step.tool()), from, to, lowered: k == 0 }
    };
    plan.steps.iter().enumerate().map(stroke).collect()
}

/// Returns the quantity plotted over time.
pub fn measure(plan: &Plan) -> Measure {
    match plan.levers() {
        true => Measure { name: "Edge raised", axis: "edge raised, mm" },
        false => Measure { name: "Goal error", axis: "goal error, mm" },
    }
}

/// Returns the packed 3-D trajectory; `reached` states whether it reaches the goal. Returns `None`
/// if no frame is finite.
pub fn replay(
    layer: Layer,
    task: &Task,
    (plan, tools): (&Plan, &[Arc<Tool>]),
    trajectory: &Trajectory,
    reached: bool,
) -> Option<Replay> {
    let sound = |frame: &&Frame| frame.state.is_finite();
    let frames: Vec<&Frame> = trajectory.frames.iter().filter(sound).collect();
    let objects = frames.first().map(|_| task.scene.things().count())?;
    let at = |frame: &Frame, k: usize| match &frame.state.space {
        Some(space) => space[k],
        None => Pose3::upright(frame.state.poses[k], task.scene.objects[k].z),
    };
    let mut strokes = Vec::new();
    for (k, frame) in frames.iter().enumerate() {
        while strokes.len() <= frame.stroke {
            strokes.push(k);
        }
    }
    let tool = |frame: &Frame| match (plan.steps.get(frame.stroke), frame.blade) {
        (_, Some(blade)) => blade,
        (Some(Step::Push(step)), None) => Pose3::upright(frame.tool, step.lift),
        // An unused tool is stored below the table, out of sight.
        _ => Pose3::upright(frame.tool, -1.0),
    };
    let edge = edge(task, plan, tools);
    let height = |frame: &Frame| match edge {
        Some((object, edge)) => at(frame, object).point(edge).z,
        None => task.levered().error(&frame.state),
    };
    let before = edge.map_or(0.0, |_| height(frames[0]));
    Some(Replay {
        layer,
        by: trajectory.by.to_string(),
        reached,
        time: differences(frames.iter().map(|frame| fine(frame.time))),
        strokes,
        tool: columns(frames.iter().map(|frame| tool(frame))),
        objects: (0..objects).map(|k| columns(frames.iter().map(|frame| at(frame, k)))).collect(),
        graph: Vec::new(),
        measure: frames.iter().map(|frame| length(height(frame) - before)).collect(),
    })
}

/// Returns the first levered object, and the lever point in its frame.
fn edge(task: &Task, plan: &Plan, tools: &[Arc<Tool>]) -> Option<(usize, Vector3)> {
    let step = plan.lever_steps().next()?;
    let tool = tools.iter().find(|tool| tool.name == step.tool)?;
    tool.blade()?;
    let plate = Plate::of(&task.scene, step.lever.plate);
    let point = step.lever.frame_on(&plate).position;
    Some((step.lever.plate, plate.start().local_point(point)))
}

/// Returns the columns of 3-D poses: x, y, zero instead of a heading, z, and the quaternion of the
/// rotation.
fn columns(poses: impl Iterator<Item = Pose3>) -> Vec<Vec<i64>> {
    let mut last = [0.0; 4];
    let rows: Vec<[i64; 8]> = poses
        .map(|pose| {
            let mut turn = pose.quaternion();
            // A rotation has two quaternions. The one nearer to the previous quaternion is used,
            // because interpolated frames would spin otherwise.
            if turn.iter().zip(last).map(|(a, b)| a * b).sum::<f64>() < 0.0 {
                turn = turn.map(|part| -part);
            }
            last = turn;
            let [x, y, z] = [pose.position.x, pose.position.y, pose.position.z].map(length);
            let [a, b, c, d] = turn.map(fine);
            [x, y, 0, z, a, b, c, d]
        })
        .collect();
    (0..8).map(|column| packed(rows.iter().map(|row| row[column]))).collect()
}

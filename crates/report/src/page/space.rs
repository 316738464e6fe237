//! Page data of 3-D plans: strokes, and replays in which every body has six degrees of freedom.

use std::sync::Arc;

use pushplan::geometry::Pose3;
use pushplan::{
    outcome::{Frame, Trajectory},
    scene::{Plate, Tool},
    task::{LeverStep, Lift, Plan, Step, Task, lever_frame},
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
    plan: &Plan,
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
    let measured: Vec<f64> = match plan.levers() {
        true => raised(task, plan, &frames, &trajectory.lifts, &at),
        false => frames.iter().map(|frame| task.levered().error(&frame.state)).collect(),
    };
    Some(Replay {
        layer,
        by: trajectory.by.to_string(),
        reached,
        time: differences(frames.iter().map(|frame| fine(frame.time))),
        strokes,
        tool: columns(frames.iter().map(|frame| tool(frame))),
        objects: (0..objects).map(|k| columns(frames.iter().map(|frame| at(frame, k)))).collect(),
        graph: Vec::new(),
        measure: measured.into_iter().map(length).collect(),
    })
}

/// Returns the height (metres) to which the edge of the lever-up in progress, or of the last one,
/// is raised in every frame. From the end of the rotation on, it is the height that tables state.
fn raised(
    task: &Task,
    plan: &Plan,
    frames: &[&Frame],
    lifts: &[Lift],
    at: &dyn Fn(&Frame, usize) -> Pose3,
) -> Vec<f64> {
    let mut heights = vec![0.0; frames.len()];
    for ((index, step), k) in lever_steps(plan).zip(0..) {
        let Some(first) = frames.iter().position(|frame| frame.stroke == index) else { break };
        let plate = Plate::of(&task.scene, step.lever.plate);
        let edge = lever_frame(plate.corners(), step.lever.place).position;
        // The frame at the change of steps is the rest before the lever-up.
        let start = at(frames[first.saturating_sub(1)], step.lever.plate);
        let end = frames[first].time + step.lever.turn_time();
        let mut last = 0.0;
        for (height, frame) in heights.iter_mut().zip(frames).skip(first) {
            if frame.stroke == index && frame.time < end {
                last = Lift::height(&start, &at(frame, step.lever.plate), edge);
            } else if let Some(lift) = lifts.get(k) {
                last = lift.raised;
            }
            *height = last;
        }
    }
    heights
}

fn lever_steps(plan: &Plan) -> impl Iterator<Item = (usize, &LeverStep)> {
    plan.steps.iter().enumerate().filter_map(|(k, step)| match step {
        Step::LeverUp(step) => Some((k, step)),
        Step::Push(_) => None,
    })
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

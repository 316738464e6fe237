//! The page of a lever-up: what was replayed in 3-D, and the drawing of it where a browser has none.

use crate::geometry::Pose3;
use crate::report::lever::words::{goal_line, plan_line};
use crate::scene::{self, LeverMotion, LeverPlan, Obstacle, Plate, Slab, Task};

use super::data::{
    Body, Data, File, Goal, Layer, Measure, Outline, Plan, Replay, Stage, Standing, Stroke, Tool,
    fine, length, point, pose,
};
use super::html::{self, PageView};
use super::recipe::Recipe;
use super::replay::{differences, packed};

/// A lever-up that was replayed.
pub struct ReplayedLever<'a> {
    /// The task.
    pub task: &'a Task,
    /// The tool.
    pub tool: &'a scene::Tool,
    /// The plan.
    pub plan: &'a LeverPlan,
    /// What happened.
    pub motion: &'a LeverMotion,
    /// Whether it works, where that was judged.
    pub passed: Option<bool>,
    /// What came of it, in a line.
    pub line: &'a str,
    /// A drawing of it, as SVG.
    pub drawing: &'a str,
}

/// The page in 3-D; `recipe` makes it again.
pub fn lever_page(lever: &ReplayedLever, recipe: Recipe) -> String {
    let ReplayedLever { task, tool, plan, .. } = *lever;
    let standing = match lever.passed {
        Some(true) => Standing::Passed,
        Some(false) => Standing::Failed,
        None => Standing::Open,
    };
    // The blade moves from the first frame to the last.
    let stroke = Stroke { tool: 0, from: [0; 3], to: [0; 3], lowered: true };
    let plan = Plan {
        tool: 0,
        name: plan_line(task, plan),
        standing,
        verdict: lever.line.to_owned(),
        cells: Vec::new(),
        strokes: vec![stroke],
        lift: 0,
        replays: vec![replay(lever)],
        ends: Vec::new(),
        command: recipe.command,
        python: recipe.python,
        file: serde_json::Value::Null,
    };
    let goal = Goal {
        object: task.goal.object,
        at: [0; 2],
        tolerance: 0,
        heading: None,
        alike: 1,
        words: goal_line(task),
    };
    let data = Data {
        task: task.name.clone(),
        description: task.description.clone(),
        headline: lever.line.to_owned(),
        stage: Stage {
            objects: task.scene.objects.iter().map(|object| plate(&Plate::of(object))).collect(),
            obstacles: task.scene.obstacles.iter().map(block).collect(),
            table: None,
            reach: Vec::new(),
            goal: Some(goal),
        },
        measure: Some(Measure { name: "Edge raised", axis: "edge raised, mm" }),
        tools: vec![blade(tool)],
        plans: vec![plan],
        columns: Vec::new(),
        choice: Vec::new(),
        candidates: None,
        run: None,
        warnings: Vec::new(),
        file: File { schema_version: 0, task: serde_json::Value::Null },
        drawing: Some(lever.drawing.to_owned()),
    };
    html::page(&data, PageView::Solid)
}

/// How a plate stands at the start, all its slabs in its frame.
fn plate(plate: &Plate) -> Body {
    let part = |slab: &Slab| Body {
        name: String::new(),
        shape: Outline::Polygon(slab.corners.iter().map(|corner| point(*corner)).collect()),
        height: length(slab.height),
        under: length(slab.bottom),
        more: Vec::new(),
        at: [0; 3],
    };
    let mut parts = plate.slabs.iter().map(part);
    // A plate has at least one.
    let first = parts.next().unwrap_or_else(|| cuboid([0.0; 3], 0.0));
    let more = parts.collect();
    Body { name: plate.name.clone(), at: pose(&plate.pose), more, ..first }
}

fn block(block: &Obstacle) -> Body {
    let name = block.name.clone();
    Body { name, at: pose(&block.pose), ..cuboid(block.size, block.z) }
}

/// The blade about its centre.
fn blade(tool: &scene::Tool) -> Tool {
    let blade = tool.blade().unwrap_or_default();
    let part = cuboid([blade.length, blade.width, blade.thickness], -0.5 * blade.thickness);
    let parts = vec![Body { name: "blade".to_owned(), ..part }];
    Tool { name: tool.name.clone(), parts, grip: [0; 3], file: serde_json::Value::Null }
}

fn cuboid([x, y, z]: [f64; 3], under: f64) -> Body {
    let (right, left) = (length(0.5 * x), length(0.5 * y));
    Body {
        name: String::new(),
        shape: Outline::Polygon(vec![
            [right, left],
            [-right, left],
            [-right, -left],
            [right, -left],
        ]),
        height: length(z),
        under: length(under),
        more: Vec::new(),
        at: [0; 3],
    }
}

/// Blade and plates frame by frame, and how high the edge is at the lever point.
fn replay(lever: &ReplayedLever) -> Replay {
    let frames = &lever.motion.frames;
    let scene = scene::LeverScene::with(&lever.task.scene, lever.tool);
    let up = &lever.plan.lever;
    let edge = scene.plates[up.plate].start().local_point(up.frame(&scene).position);
    let height = |plates: &[Pose3]| plates[up.plate].point(edge).z;
    let before = frames.first().map_or(0.0, |first| height(&first.plates));
    Replay {
        layer: Layer::Spatial,
        by: "3-D simulation".to_owned(),
        reached: lever.passed.unwrap_or(false),
        time: differences(frames.iter().map(|frame| fine(frame.time))),
        strokes: vec![0],
        tool: columns(frames.iter().map(|frame| frame.blade)),
        objects: (0..scene.plates.len())
            .map(|k| columns(frames.iter().map(|frame| frame.plates[k])))
            .collect(),
        measure: frames.iter().map(|frame| length(height(&frame.plates) - before)).collect(),
    }
}

/// Columns of poses in space: x and y, no heading, z, and the quaternion of the turn.
fn columns(poses: impl Iterator<Item = Pose3>) -> Vec<Vec<i64>> {
    let mut last = [0.0; 4];
    let rows: Vec<[i64; 8]> = poses
        .map(|pose| {
            let mut turn = pose.quaternion();
            // The same turn has two; the nearer one keeps what is drawn between frames from
            // whirling around.
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

//! The table with what stands on it, and the tools.

use serde_json::Value as Json;

use crate::geometry::{Footprint, Shape, Vector};
use crate::report::plan_text::goal_line;
use crate::scene::{self, Scene, Task};

use super::data::{Body, Goal, Outline, Stage, Tool, fine, length, point, pose};

/// Scene, reach and goal of a task.
pub fn stage(task: &Task) -> Stage {
    let goal = &task.goal;
    Stage {
        reach: [task.robot.reach_min, task.robot.reach_max].map(length).to_vec(),
        goal: Some(Goal {
            object: goal.object,
            at: point(goal.position),
            tolerance: length(goal.tolerance),
            heading: goal.heading.map(|(heading, tolerance)| [fine(heading), fine(tolerance)]),
            alike: goal.alike,
            words: goal_line(task),
        }),
        ..table(&task.scene)
    }
}

/// What stands on a table, with nothing to be done.
pub fn table(scene: &Scene) -> Stage {
    let objects = scene.objects.iter().map(|object| Body {
        name: object.name.clone(),
        shape: outline(&object.shape),
        height: length(object.shape.height()),
        under: 0,
        more: Vec::new(),
        at: pose(&object.pose),
    });
    let obstacles = scene.obstacles.iter().map(|obstacle| Body {
        name: obstacle.name.clone(),
        shape: outline(&obstacle.shape()),
        height: length(obstacle.size[2]),
        under: 0,
        more: Vec::new(),
        at: pose(&obstacle.pose),
    });
    Stage {
        objects: objects.collect(),
        obstacles: obstacles.collect(),
        table: scene.table_top.map(|top| [point(top.middle), top.size.map(length)]),
        reach: Vec::new(),
        goal: None,
    }
}

/// A tool as it is drawn, and as in its file.
pub fn tool(tool: &scene::Tool, file: Json) -> Tool {
    let parts = tool.parts().iter().map(|part| Body {
        name: part.name.clone(),
        shape: outline(&part.shape),
        height: length(part.shape.height()),
        under: 0,
        more: Vec::new(),
        at: pose(&part.pose),
    });
    Tool { name: tool.name.clone(), parts: parts.collect(), grip: pose(&tool.grip), file }
}

fn outline(shape: &Shape) -> Outline {
    match shape.footprint() {
        Footprint::Disc { radius } => Outline::Disc(length(radius)),
        Footprint::Rectangle { half } => {
            let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
            let corner = |(x, y): (f64, f64)| point(Vector::new(x * half.x, y * half.y));
            Outline::Polygon(corners.map(corner).to_vec())
        }
        Footprint::Polygon(polygon) => {
            Outline::Polygon(polygon.corners().iter().map(|corner| point(*corner)).collect())
        }
    }
}

//! Tasks of levering and tools with blades written back in the keys of their files.

use serde_json::{Value as Json, json};

use crate::asset::saved::emit::{degrees, pushes};
use crate::geometry::{Pose, Vector};
use crate::scene::{
    Blade, Goal, LeverRules, Object, Obstacle, Pivot, Plate, Slab, Task, Tool, ToolChoice,
};

/// A task as in a task file.
pub(in crate::asset) fn lever_task(task: &Task, rules: &LeverRules) -> Json {
    let mut fields = json!({
        "name": task.name,
        "description": task.description,
        "scene": {
            "table": {"friction": task.scene.table_friction},
            "objects": task.scene.objects.iter().map(plate).collect::<Vec<_>>(),
            "obstacles": task.scene.obstacles.iter().map(block).collect::<Vec<_>>(),
        },
        "robot": {"reach": {"min": task.robot.reach_min, "max": task.robot.reach_max}},
        "tools": match &task.tools {
            ToolChoice::All => json!("all"),
            ToolChoice::Named(names) => json!(names),
        },
        "levers": levers(rules),
        "goal": goal(&task.goal, task),
        "robustness": task.robustness,
    });
    if task.pushes.max_count > 0 {
        fields["pushes"] = pushes(&task.pushes);
    }
    fields
}

/// A tool as in a tool file.
pub(in crate::asset) fn blade_tool(tool: &Tool, blade: &Blade) -> Json {
    json!({
        "name": tool.name,
        "description": tool.description,
        "friction": blade.friction,
        "blade": {"length": blade.length, "width": blade.width, "thickness": blade.thickness},
    })
}

fn plate(object: &Object) -> Json {
    let plate = Plate::of(object);
    let parts = plate.slabs[1..]
        .iter()
        .map(|slab| json!({"shape": solid(slab), "position": [0.0, 0.0, slab.bottom]}));
    let fields = json!({
        "name": plate.name,
        "shape": solid(&plate.slabs[0]),
        "parts": parts.collect::<Vec<_>>(),
        "mass": plate.mass,
        "friction": plate.friction,
        "clearance": plate.clearance,
        "z": plate.z,
    });
    posed(fields, &plate.pose, None)
}

/// Corners about the frame's own origin, so that nothing is shifted when they are read back.
fn solid(slab: &Slab) -> Json {
    let corners: Vec<_> = slab.corners.iter().map(|corner| vector(*corner)).collect();
    json!({"prism": {"corners": corners, "height": slab.height, "origin": [0.0, 0.0]}})
}

fn block(block: &Obstacle) -> Json {
    let fields = json!({"name": block.name, "size": block.size, "friction": block.friction});
    posed(fields, &block.pose, Some(block.z))
}

fn posed(mut fields: Json, pose: &Pose, z: Option<f64>) -> Json {
    let [x, y] = vector(pose.position);
    fields["position"] = z.map_or(json!([x, y]), |z| json!([x, y, z]));
    fields["yaw_deg"] = json!(degrees(pose.heading));
    fields
}

fn levers(rules: &LeverRules) -> Json {
    let pivot = |pivot: &Pivot| match pivot {
        Pivot::Auto => json!("auto"),
        Pivot::At(distance) => json!(distance),
    };
    json!({
        "depth": rules.depth,
        "angle_deg": rules.angle.map(degrees),
        "pivot": rules.pivots.iter().map(pivot).collect::<Vec<_>>(),
        "speed": rules.speed,
        "hold": rules.hold,
        "retreat": rules.retreat,
    })
}

fn goal(goal: &Goal, task: &Task) -> Json {
    let mut json = json!({"object": task.scene.objects[goal.object].name});
    if let Some(block) = goal.outside {
        json["outside"] = json!(task.scene.obstacles[block].name);
    }
    if let Some(height) = goal.raised {
        json["raised"] = json!(height);
    }
    if let Some(flipped) = goal.flipped {
        json["flipped"] = json!(flipped);
    }
    if goal.has_place() {
        json["position"] = json!(vector(goal.position));
        json["tolerance"] = json!(goal.tolerance);
    }
    json
}

fn vector(vector: Vector) -> [f64; 2] {
    [vector.x, vector.y]
}

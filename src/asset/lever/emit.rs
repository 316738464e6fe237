//! Tasks of levering and tools with blades written back in the keys of their files.

use serde_json::{Value as Json, json};

use crate::asset::fault::{Fault, Faults};
use crate::asset::saved::emit::{degrees, pushes};
use crate::geometry::{Pose, Vector};
use crate::scene::{
    BladeTool, Block, LeverGoal, LeverRules, LeverTask, Pivot, Plate, Slab, ToolChoice,
};

impl LeverTask {
    /// The task in the keys of its file: what [`LeverTask::to_yaml`] writes.
    pub fn to_json(&self) -> Json {
        lever_task(self)
    }

    /// The task as a YAML file that [`LeverTask::parse`] reads back, the same to the bit if its
    /// angles came from a file or are round in degrees.
    ///
    /// # Errors
    /// If the task holds what no file can.
    pub fn to_yaml(&self) -> Result<String, Faults> {
        serde_yaml::to_string(&lever_task(self)).map_err(|error| {
            let message = format!("the task cannot be written as YAML: {error}");
            Fault::of_file(&self.name, message, "check its numbers").into()
        })
    }
}

/// A task as in a task file.
pub(in crate::asset) fn lever_task(task: &LeverTask) -> Json {
    let mut fields = json!({
        "name": task.name,
        "description": task.description,
        "scene": {
            "table": {"friction": task.table_friction},
            "objects": task.plates.iter().map(plate).collect::<Vec<_>>(),
            "obstacles": task.blocks.iter().map(block).collect::<Vec<_>>(),
        },
        "robot": {"reach": {"min": task.robot.reach_min, "max": task.robot.reach_max}},
        "tools": match &task.tools {
            ToolChoice::All => json!("all"),
            ToolChoice::Named(names) => json!(names),
        },
        "levers": levers(&task.levers),
        "goal": goal(&task.goal, task),
        "robustness": task.robustness,
    });
    if let Some(rules) = &task.pushes {
        fields["pushes"] = pushes(rules);
    }
    fields
}

/// A tool as in a tool file.
pub(in crate::asset) fn blade_tool(tool: &BladeTool) -> Json {
    let blade = &tool.blade;
    json!({
        "name": tool.name,
        "description": tool.description,
        "friction": blade.friction,
        "blade": {"length": blade.length, "width": blade.width, "thickness": blade.thickness},
    })
}

fn plate(plate: &Plate) -> Json {
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

fn block(block: &Block) -> Json {
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

fn goal(goal: &LeverGoal, task: &LeverTask) -> Json {
    let mut json = json!({"object": task.plates[goal.plate].name});
    if let Some(block) = goal.outside {
        json["outside"] = json!(task.blocks[block].name);
    }
    if let Some(height) = goal.raised {
        json["raised"] = json!(height);
    }
    if let Some(flipped) = goal.flipped {
        json["flipped"] = json!(flipped);
    }
    if let Some((at, tolerance)) = goal.place {
        json["position"] = json!(vector(at));
        json["tolerance"] = json!(tolerance);
    }
    json
}

fn vector(vector: Vector) -> [f64; 2] {
    [vector.x, vector.y]
}

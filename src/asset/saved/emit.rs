//! Conversion of tasks and tools to the keys of their files.

use serde_json::{Value as Json, json};

use super::things;
use crate::asset::put::{degrees, posed, shape, vector};
use crate::asset::task::{
    WORLD, emitted_goals, emitted_levers, emitted_object, emitted_obstacle, emitted_tools,
    name_of_surface,
};
use crate::geometry::Shape;
use crate::{
    scene::{
        Blade, DisjointSets, Hand, Joint, JointKind, Object, Obstacle, PairFriction, Robot, Scene,
        Span, TableTop, Tool, WorldJoint,
    },
    task::{Directions, Offsets, PushForm, PushRules, Task},
};

/// Maximum number of pairs of parts in a tool file.
const MAX_NAMED: usize = 64;

/// Returns a task as in a task file.
pub(in crate::asset) fn task(task: &Task) -> Json {
    let mut robot = match &task.arm {
        Some(arm) => json!({"arm": arm.to_json()}),
        None => json!({"reach": {"min": task.robot.reach_min, "max": task.robot.reach_max}}),
    };
    if let Some(force) = task.robot.max_force {
        robot["max_force"] = json!(force);
    }
    if task.arm.is_none() {
        robot["home"] = json!(vector(task.robot.home));
        robot["hand"] = match task.robot.hand {
            Some(Hand { radius, from: None }) => json!({"radius": radius}),
            Some(Hand { radius, from: Some(from) }) => json!({"radius": radius, "from": from}),
            None => json!("none"),
        };
        robot["base"] = match task.robot.base {
            half if half > 0.0 => json!(half),
            _ => json!("none"),
        };
    }
    if task.robot.travel != Robot::TRAVEL {
        robot["travel"] = json!(task.robot.travel);
    }
    let mut fields = json!({
        "name": task.name,
        "description": task.description,
        "scene": scene(&task.scene),
        "robot": robot,
        "tools": emitted_tools(task),
        "goal": emitted_goals(&task.goals, &task.scene),
        "robustness": task.robustness,
    });
    if task.pushes.max_count > 0 {
        fields["pushes"] = pushes(&task.pushes);
    }
    if let Some(rules) = &task.levers {
        fields["levers"] = emitted_levers(rules);
    }
    let kept = task.scene.objects.iter().filter(|object| object.keep.is_some());
    let kept: Vec<&Object> = kept.collect();
    if let Some(within) = kept.first().and_then(|object| object.keep) {
        let names: Vec<&String> = kept.iter().map(|object| &object.name).collect();
        fields["keep"] = json!({"objects": names, "within": within});
    }
    if !task.scene.keep_out.is_empty() {
        let regions = task.scene.keep_out.iter();
        let regions = regions.map(|region| posed(crate::asset::task::region(region), &region.pose));
        fields["keep_out"] = regions.collect();
    }
    if task.unknown.any() {
        let unknown = task.unknown.words().into_iter().filter(|(_, unknown)| *unknown);
        fields["unknown"] = unknown.map(|(word, _)| word).collect();
    }
    fields
}

/// Returns a tool as in a tool file.
pub(in crate::asset) fn tool(tool: &Tool) -> Json {
    if let Some(Blade { length, width, thickness, .. }) = tool.blade() {
        return json!({
            "name": tool.name,
            "description": tool.description,
            "friction": tool.friction,
            "blade": {"length": length, "width": width, "thickness": thickness},
        });
    }
    let parts: Vec<Json> = tool
        .parts()
        .iter()
        .map(|part| {
            let fields = match part.shape {
                Shape::Cuboid { size } => json!({"name": part.name, "size": size}),
                other => json!({"name": part.name, "shape": shape(&other)}),
            };
            posed(fields, &part.pose)
        })
        .collect();
    // Every joint is written, including joints of touching parts, because stating them is harmless.
    // If there are more than a file may have, only the joints that hold the parts together are
    // written.
    let mut held = DisjointSets::new(tool.parts().len());
    let all = tool.joints().len() <= MAX_NAMED;
    let kept = tool.joints().iter().filter(|pair| held.join(**pair) || all);
    let joints: Vec<Json> = kept.map(|pair| json!(pair.map(|k| &tool.parts()[k].name))).collect();
    json!({
        "name": tool.name,
        "description": tool.description,
        "grip": posed(json!({}), &tool.grip),
        "friction": tool.friction,
        "parts": parts,
        "joints": joints,
    })
}

/// Returns a scene as in a task file.
pub(in crate::asset) fn scene(scene: &Scene) -> Json {
    let object = |(index, object): (usize, &Object)| {
        let (mass, parts) = things::parts(scene, index);
        let mut fields = emitted_object(object);
        fields["mass"] = json!(mass);
        if !parts.is_empty() {
            fields["parts"] = json!(parts);
        }
        fields
    };
    let joint = |joint: &Joint| {
        let mut fields = joined(joint.between.map(|k| scene.objects[k].name.as_str()), &joint.kind);
        if joint.guessed {
            fields["guessed"] = json!(true);
        }
        fields
    };
    let mount =
        |mount: &WorldJoint| joined([&scene.objects[mount.object].name, WORLD], &mount.kind);
    let joints = scene.joints.iter().filter(|joint| !scene.is_seam(joint)).map(joint);
    let mut table = json!({"friction": scene.table_friction});
    if let Some(TableTop { size, middle }) = scene.table_top {
        table["size"] = json!(size);
        table["position"] = json!(vector(middle));
    }
    let mut fields = json!({
        "table": table,
        "objects": scene.things().map(object).collect::<Vec<_>>(),
        "joints": joints.chain(scene.mounts.iter().map(mount)).collect::<Vec<_>>(),
        "obstacles": scene
            .obstacles
            .iter()
            .filter(is_stated)
            .map(emitted_obstacle)
            .collect::<Vec<_>>(),
    });
    if !scene.frictions.is_empty() {
        let friction = |pair: &PairFriction| {
            let with = name_of_surface(pair.with, &scene.objects, &scene.obstacles);
            json!({
                "between": [&scene.objects[pair.object].name, &with],
                "coefficient": pair.coefficient,
            })
        };
        fields["frictions"] =
            scene.frictions.iter().filter(|pair| scene.is_of_things(pair)).map(friction).collect();
    }
    if let Some(share) = scene.push_height {
        fields["push_height"] = json!(share);
    }
    fields
}

/// Returns a joint as in a task file.
fn joined(between: [&str; 2], kind: &JointKind) -> Json {
    let mut fields = match *kind {
        JointKind::Fixed => json!({"between": between, "kind": "fixed"}),
        JointKind::Revolute { at, .. } => {
            json!({"between": between, "kind": "revolute", "at": vector(at)})
        }
        JointKind::Prismatic { axis, .. } => {
            json!({"between": between, "kind": "prismatic", "axis": vector(axis)})
        }
    };
    match *kind {
        JointKind::Revolute { limits: Some(Span { low, high }), .. } => {
            fields["limits_deg"] = json!([degrees(low), degrees(high)]);
        }
        JointKind::Prismatic { limits: Some(Span { low, high }), .. } => {
            fields["limits"] = json!([low, high]);
        }
        _ => {}
    }
    fields
}

/// Returns `true` if an obstacle is listed in the file; the robot's own column follows from other
/// keys.
fn is_stated(obstacle: &&Obstacle) -> bool {
    !obstacle.is_robot()
}

/// Returns the allowed pushes as in a task file.
pub(in crate::asset) fn pushes(rules: &PushRules) -> Json {
    let angles = |list: &[f64]| list.iter().map(|angle| degrees(*angle)).collect::<Vec<_>>();
    let mut pushes = json!({
        "form": match rules.form {
            PushForm::Placed => "placed",
            PushForm::Chained => "chained",
        },
        "directions": match &rules.directions {
            Directions::Principal => json!("principal"),
            Directions::Count(count) => json!(count),
            Directions::List(list) => json!(angles(list)),
        },
        "grip_yaws_deg": angles(&rules.grip_yaws),
        "length": rules.length,
        "speed": rules.speed,
        "max_count": rules.max_count,
        "lift": rules.lift,
    });
    if let Offsets::List(offsets) = &rules.offsets {
        pushes["offsets"] = json!(offsets);
    }
    if let Some(changes) = rules.tool_changes {
        pushes["tool_changes"] = json!(changes);
    }
    pushes
}

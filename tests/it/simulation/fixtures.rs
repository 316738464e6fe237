//! Scenes and motions that the simulation tests share.

use std::sync::Arc;

use pushplan::geometry::{Pose, Shape, Vector};
use pushplan::scene::{Object, Part, Push, Scene, Tool, ToolMotion};
use pushplan::sim::Simulator;

/// A cylinder of 10 cm diameter and height at the origin.
pub fn can() -> Object {
    Object {
        name: "can".into(),
        shape: Shape::Cylinder { radius: 0.05, height: 0.1 },
        mass: 0.4,
        friction: 0.4,
        pose: Pose::default(),
    }
}

/// A cuboid of 10 x 6 x 5 cm at the origin.
pub fn brick() -> Object {
    Object {
        name: "brick".into(),
        shape: Shape::Cuboid { size: [0.10, 0.06, 0.05] },
        mass: 0.4,
        friction: 0.4,
        pose: Pose::default(),
    }
}

/// A table of friction 0.5 with these objects.
pub fn table(objects: Vec<Object>) -> Scene {
    Scene { table_friction: 0.5, objects, ..Scene::default() }
}

/// A bar of 2 x 20 x 5 cm across x, its front face at the end effector.
pub fn bar() -> Arc<Tool> {
    let part = Part::cuboid("bar", [0.02, 0.2, 0.05], Pose::new(-0.01, 0.0, 0.0));
    let tool = Tool::assemble("bar".into(), String::new(), Pose::default(), 0.4, vec![part], &[]);
    Arc::new(tool.expect("one part is one piece"))
}

/// One settled straight push of the bar, its face across the direction of motion.
pub fn push(start: Vector, direction: f64, length: f64, speed: f64) -> ToolMotion {
    ToolMotion::pushes(bar(), 0.002, direction, &[Push { start, direction, length, speed }], true)
}

/// Both engines at their default step.
pub fn engines() -> [Simulator; 2] {
    [Simulator::planar(), Simulator::spatial()]
}

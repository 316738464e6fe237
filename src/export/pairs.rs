//! What may touch what, and how it rubs.

use crate::scene::{Physics, Scene, Tool};

use super::mjcf::foot_name;

/// Two geoms that may touch.
pub(super) struct Pair {
    /// Their names.
    pub geoms: [String; 2],
    /// Their coefficient of friction.
    pub friction: f64,
}

/// Every pair of which at least one can move by itself.
pub(super) fn pairs(scene: &Scene, tool: &Tool) -> Vec<Pair> {
    let rigid = Physics::stated(scene).rigid_groups().of;
    let mut pairs = Vec::new();
    for (index, object) in scene.objects.iter().enumerate() {
        let mut add = |geom: String, with: String, friction: f64| {
            let friction = Scene::pair_friction(object.friction, friction);
            pairs.push(Pair { geoms: [geom, with], friction });
        };
        let own = || format!("object/{}", object.name);
        if !object.shape.is_cylinder() {
            add(own(), "table".into(), scene.table_friction);
        }
        for foot in 0..object.feet().count {
            add(foot_name(object, foot), "table".into(), scene.table_friction);
        }
        for obstacle in &scene.obstacles {
            add(own(), format!("obstacle/{}", obstacle.name), obstacle.friction);
        }
        for piece in &tool.outline {
            add(own(), format!("tool/{}", piece.name), tool.friction);
        }
        for (other, body) in scene.objects.iter().enumerate().skip(index + 1) {
            if rigid[index] != rigid[other] {
                add(own(), format!("object/{}", body.name), body.friction);
            }
        }
    }
    pairs
}

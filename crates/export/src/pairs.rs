//! Contact pairs and their friction.

use pushplan::scene::{Physics, Scene, Surface, Tool};

use super::mjcf::{feet, foot_name};
use super::xml::{Xml, numbers};

/// Pair of geoms that may touch.
pub(super) struct Pair {
    /// Names of the geoms.
    pub geoms: [String; 2],
    /// Coefficient of friction.
    pub friction: f64,
    /// Distance below which the geoms press against each other, metres.
    pub margin: f64,
}

impl Pair {
    /// Writes the pair as an element.
    pub fn write(self, xml: &mut Xml) {
        let [a, b] = self.geoms;
        let friction = numbers(&[self.friction, self.friction]);
        let mut attributes = vec![("geom1", a), ("geom2", b), ("friction", friction)];
        if self.margin > 0.0 {
            attributes.push(("margin", numbers(&[self.margin])));
        }
        xml.leaf("pair", &attributes);
    }
}

/// Returns all pairs of which at least one can move freely; the names of a tool's solids begin with
/// its prefix.
pub(super) fn pairs(scene: &Scene, tools: &[(&str, &Tool)]) -> Vec<Pair> {
    let physics = Physics::stated(scene);
    let rigid = physics.rigid_groups().of;
    let mut pairs = Vec::new();
    for (index, object) in scene.objects.iter().enumerate() {
        let mut add = |geom: String, with: String, surface: Surface, friction: f64| {
            let friction = physics.friction(index, surface, friction);
            pairs.push(Pair { geoms: [geom, with], friction, margin: 0.0 });
        };
        let own = || format!("object/{}", object.name);
        let touches = !object.shape.is_cylinder() || scene.table_top.is_some();
        if touches && scene.mount(index).is_none() {
            add(own(), "table".into(), Surface::Table, scene.table_friction);
        }
        let stands = scene.mount(index).is_none();
        for foot in (0..feet(scene, index).count).filter(|_| stands) {
            add(foot_name(object, foot), "table".into(), Surface::Table, scene.table_friction);
        }
        for (k, obstacle) in scene.obstacles.iter().enumerate() {
            let name = format!("obstacle/{}", obstacle.name);
            add(own(), name, Surface::Obstacle(k), obstacle.friction);
        }
        for (prefix, tool) in tools {
            for piece in tool.outline() {
                add(own(), format!("{prefix}{}", piece.name), Surface::Tool, tool.friction);
            }
        }
        for (other, body) in scene.objects.iter().enumerate().skip(index + 1) {
            if rigid[index] != rigid[other] {
                add(own(), format!("object/{}", body.name), Surface::Object(other), body.friction);
            }
        }
    }
    pairs
}

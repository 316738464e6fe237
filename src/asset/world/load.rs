//! Reading of a world file together with its task.

use std::path::Path;

use crate::asset::diagnostic::{Faults, did_you_mean};
use crate::asset::node::Node;
use crate::asset::read_text;
use crate::asset::strict::{Ledger, check};
use crate::asset::take::{angle_of, name_of, number_or, position, unique_names};
use crate::asset::task::support_of;
use crate::asset::text::Source;
use crate::{
    scene::{Engine, Scene, Support, carries},
    task::{Noise, Task, Truth},
};

use super::joints;
use super::spec::WORLD;

/// Reads a world file; missing values are taken from `task`.
///
/// # Errors
/// Returns all faults of the file, each with its place.
pub fn load_world(path: impl AsRef<Path>, task: &Task) -> Result<Truth, Faults> {
    let (file, text) = read_text(path.as_ref())?;
    let source = Source::of(&file, &text);
    let mut root = Node::parse(source)?;
    let mut ledger = Ledger::new(source);
    check(&mut root, &WORLD, &mut ledger);
    rules(&root, task, &mut ledger);
    let truth = truth(&root, task);
    ledger.finish(truth)
}

/// Checks a world file as far as possible without its task.
pub(in crate::asset) fn check_world(text: &str, file: &str) -> Result<(), Faults> {
    let source = Source::of(file, text);
    let mut root = Node::parse(source)?;
    let mut ledger = Ledger::new(source);
    check(&mut root, &WORLD, &mut ledger);
    unique_names(items(&root, "objects"), "objects", &mut ledger);
    ledger.finish(Some(()))
}

fn items<'a>(root: &'a Node, key: &str) -> &'a [Node] {
    root.get(key).map(Node::items).unwrap_or_default()
}

/// Reports faults in references to the task or within the file.
fn rules(root: &Node, task: &Task, ledger: &mut Ledger) {
    let objects = items(root, "objects");
    unique_names(objects, "objects", ledger);
    let joints = items(root, "joints");
    let names = || task.scene.things().map(|(_, object)| object.name.as_str());
    let named = objects.iter().filter_map(|object| object.get("name"));
    for node in named.chain(joints::names(joints, &task.scene)) {
        if let Some(name) = node.text().filter(|name| !names().any(|known| known == *name)) {
            let message = format!("the task has no object `{name}`");
            ledger.fault(node, message, did_you_mean(name, names()));
        }
    }
    for object in objects {
        if let Some(Support::Points(points)) = support_of(object)
            && carries(&points).is_none()
        {
            let node = object.get("support").unwrap_or(object);
            let message =
                "the object would topple: its centre is not inside the polygon of these points";
            ledger.fault(node, message, "the points are in the object's own frame");
        }
    }
    joints::check(joints, &task.scene, ledger);
}

fn truth(root: &Node, task: &Task) -> Option<Truth> {
    let mut scene: Scene = task.scene.clone();
    for node in items(root, "objects") {
        let index = scene.object(name_of(node)?)?;
        let mass = number_or(node, "mass", scene.mass(index))?;
        scene.weigh(index, mass);
        let parts: Vec<usize> = scene.parts_of(index).collect();
        for solid in parts.into_iter().chain([index]) {
            let friction = &mut scene.objects[solid].friction;
            *friction = number_or(node, "friction", *friction)?;
        }
        let object = &mut scene.objects[index];
        if node.get("support").is_some() {
            object.support = support_of(node)?;
        }
        if node.get("position").is_some() {
            object.pose.position = position(node)?;
        }
        if let Some(yaw) = node.get("yaw_deg") {
            object.pose.heading = angle_of(yaw)?;
        }
        scene.place_parts();
    }
    scene.table_friction = number_or(root, "table_friction", scene.table_friction)?;
    if root.get("joints").is_some() {
        joints::replace(items(root, "joints"), &mut scene)?;
    }
    let noise = match root.get("noise") {
        Some(noise) => Noise {
            position: number_or(noise, "position", Truth::NOISE.position)?,
            heading: noise.get("heading_deg").map_or(Some(Truth::NOISE.heading), angle_of)?,
        },
        None => Truth::NOISE,
    };
    Some(Truth {
        scene,
        engine: match root.get("engine").map(Node::text) {
            None | Some(Some("planar")) => Engine::Planar,
            Some(Some(_)) => Engine::Spatial,
            Some(None) => return None,
        },
        noise,
        headings: root.get("headings").map_or(Some(true), Node::switch)?,
        seed: number_or(root, "seed", 0.0)? as u64,
    })
}

//! Joints of a world file: between objects, and of objects to the world or to an obstacle.
//!
//! Joints between objects replace all of the task's. A joint to the world replaces the task's joint
//! of its object: a stuck door is `fixed`, and another hinge, a shorter travel or a spring is
//! stated.

use crate::asset::node::Node;
use crate::asset::spec::{Key, MOST_BODIES, Range, Value};
use crate::asset::strict::Ledger;
use crate::asset::task::{JOINT_KEYS, WORLD, joint_of, mount_of};
use crate::scene::{DisjointSets, JointKind, Scene, Span, WorldJoint};

/// Specification of the joints of a world.
pub(super) const JOINTS: Value =
    Value::List { of: &JOINT, items: "joints", min: 0, max: MOST_BODIES };

const JOINT: Value = Value::Map(&[
    JOINT_KEYS[0],
    JOINT_KEYS[1],
    JOINT_KEYS[2],
    JOINT_KEYS[3],
    JOINT_KEYS[4],
    JOINT_KEYS[5],
    JOINT_KEYS[6],
    Key::optional(
        "spring",
        Value::Number(Range {
            what: "a stiffness in N/m, or N m per radian",
            low: 0.0,
            high: 1e4,
            advice: "a door closer has 5 N m per radian: 5",
        }),
        "Stiffness of a damped spring that pulls an object joined to the world back to its start, \
         N/m, or N m per radian of a revolute joint; default 0.",
    ),
]);

/// Reports faults in the joints of a world.
pub(super) fn check(joints: &[Node], scene: &Scene, ledger: &mut Ledger) {
    let world = scene.objects.len();
    let mut sets = DisjointSets::new(world + 1);
    let stated = |object: usize| joints.iter().any(|node| moved_by(node, scene) == Some(object));
    for mount in scene.mounts.iter().filter(|mount| !stated(mount.object)) {
        sets.join([mount.object, world]);
    }
    for node in joints {
        if !has_needed(node, ledger) {
            continue;
        }
        let to_world = moving(node, scene).is_some();
        let read = match moving(node, scene) {
            Some(name) => mount_of(node, name, &scene.objects)
                .map(|mount| ([mount.object, world], mount.kind)),
            None => joint_of(node, &scene.objects).map(|joint| (joint.between, joint.kind)),
        };
        let Some((pair, kind)) = read else {
            let axis = node.get("axis").filter(|axis| !axis.items().is_empty());
            if axis.is_some() && node.get("kind").is_some() {
                let advice = "write a direction, such as [1, 0] for +x";
                ledger.fault(node, "this joint cannot be read", advice);
            }
            continue;
        };
        if pair[0] == pair[1] || !sets.join(pair) {
            let message = match to_world {
                true => "this object is joined to the world twice, maybe through another object",
                false => "this joint closes a loop, which the simulator does not support",
            };
            ledger.fault(node, message, "remove one joint of the loop");
        }
        if let Some(spring) = node.get("spring")
            && !(to_world && kind != JointKind::Fixed)
        {
            let advice = "remove it; only a revolute or prismatic joint to `world` has a spring";
            ledger.fault(spring, "this joint cannot have a spring", advice);
        }
        let broken = |span: Span| span.low > 0.0 || span.high < 0.0 || span.low >= span.high;
        if kind.limits().is_some_and(broken) {
            let advice = "limits are relative to the poses at the start: they must contain 0";
            ledger.fault(node, "the start violates these limits", advice);
        }
    }
}

/// Returns the names of objects in the joints; `world` and obstacles are left out.
pub(super) fn names<'a>(joints: &'a [Node], scene: &Scene) -> Vec<&'a Node> {
    let named = |node: &'a Node| match moving(node, scene) {
        Some(object) => vec![object],
        None => node.get("between").map(|ends| ends.items().iter().collect()).unwrap_or_default(),
    };
    joints.iter().flat_map(named).collect()
}

/// Replaces the joints of a scene by stated ones; `None` if one is faulty.
pub(super) fn replace(joints: &[Node], scene: &mut Scene) -> Option<()> {
    let (mut between, mut mounts): (Vec<_>, Vec<WorldJoint>) =
        (scene.seams().collect(), Vec::new());
    for node in joints {
        match moving(node, scene) {
            Some(name) => {
                let mount = mount_of(node, name, &scene.objects)?;
                let spring = node.get("spring").map_or(Some(0.0), Node::number)?;
                mounts.push(WorldJoint { spring, ..mount });
            }
            None => between.push(joint_of(node, &scene.objects)?),
        }
    }
    scene.mounts.retain(|mount| mounts.iter().all(|new| new.object != mount.object));
    scene.mounts.extend(mounts);
    scene.joints = between;
    Some(())
}

/// Returns the name of the object if the other end of the joint is the world or an obstacle.
fn moving<'a>(joint: &'a Node, scene: &Scene) -> Option<&'a Node> {
    let fixed = |node: &Node| {
        let Some(name) = node.text() else { return false };
        let object = scene.things().any(|(_, object)| object.name == name);
        !object && (name == WORLD || scene.obstacles.iter().any(|fixed| fixed.name == name))
    };
    match joint.get("between")?.items() {
        [object, other] if fixed(other) && !fixed(object) => Some(object),
        [other, object] if fixed(other) && !fixed(object) => Some(object),
        _ => None,
    }
}

/// Returns the index of the object that a joint holds to the world.
fn moved_by(joint: &Node, scene: &Scene) -> Option<usize> {
    scene.object(moving(joint, scene)?.text()?)
}

/// Returns `true` if the joint has the key that its kind needs, and reports it otherwise.
fn has_needed(joint: &Node, ledger: &mut Ledger) -> bool {
    let kind = joint.get("kind").and_then(Node::text);
    let needed = match kind {
        Some("revolute") => "at",
        Some("prismatic") => "axis",
        _ => return true,
    };
    if joint.get(needed).is_some() {
        return true;
    }
    let message = format!("a {} joint needs `{needed}`", kind.unwrap_or_default());
    ledger.fault(joint, message, format!("add `{needed}: [x, y]`"));
    false
}

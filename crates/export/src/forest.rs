//! Jointed objects as trees, in which every object is attached to its parent.

use pushplan::scene::{DisjointSets, Joint, JointKind, Scene};

use super::ExportError;

/// Object in its tree.
pub(super) struct Node<'a> {
    /// Index in the scene.
    pub object: usize,
    /// Parent object and joint; `None` for a root.
    pub parent: Option<(usize, &'a Joint)>,
    /// Attached objects.
    pub children: Vec<Node<'a>>,
}

/// Returns the trees of a scene, each rooted at its first object, or at an object with a world
/// joint.
///
/// Fixed joints may close loops, because one rigid body may have any number of them.
///
/// # Errors
/// Returns [`ExportError::JointLoop`] if another joint closes a loop.
pub(super) fn forest(scene: &Scene) -> Result<Vec<Node<'_>>, ExportError> {
    let count = scene.objects.len();
    let (fixed, free): (Vec<&Joint>, Vec<&Joint>) =
        scene.joints.iter().partition(|joint| joint.kind == JointKind::Fixed);
    // Fixed joints come first, so that only they may close a loop.
    let mut trees = DisjointSets::new(count);
    let mut kept = Vec::new();
    for joint in fixed.into_iter().chain(free) {
        if trees.join(joint.between) {
            kept.push(joint);
        } else if joint.kind != JointKind::Fixed {
            let between = joint.between.map(|object| scene.objects[object].name.clone());
            return Err(ExportError::JointLoop { between });
        }
    }
    // An object with a world joint is the root of its tree.
    let held = |tree: usize| {
        let mut mounts = scene.mounts.iter().map(|mount| mount.object);
        mounts.find(|&object| trees.lowest(object) == tree).unwrap_or(tree)
    };
    let roots = (0..count).filter(|&object| trees.lowest(object) == object).map(held);
    Ok(roots.map(|object| grow(object, None, &kept)).collect())
}

fn grow<'a>(object: usize, parent: Option<(usize, &'a Joint)>, joints: &[&'a Joint]) -> Node<'a> {
    let mut children = Vec::new();
    for joint in joints {
        let other = match joint.between {
            [a, b] if a == object => b,
            [a, b] if b == object => a,
            _ => continue,
        };
        if parent.is_none_or(|(up, _)| up != other) {
            children.push(grow(other, Some((object, joint)), joints));
        }
    }
    Node { object, parent, children }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::geometry::{Pose, Vector};
    use pushplan::scene::Object;

    fn scene(joints: &[(usize, usize, JointKind)]) -> Scene {
        let object = |k: usize| Object {
            mass: 1.0,
            friction: 0.4,
            pose: Pose::new(0.1 * k as f64, 0.0, 0.0),
            ..Object::cylinder(format!("o{k}"), 0.05, 0.1)
        };
        let joint = |&(a, b, kind): &(usize, usize, JointKind)| Joint {
            between: [a, b],
            kind,
            guessed: false,
        };
        Scene {
            objects: (0..5).map(object).collect(),
            joints: joints.iter().map(joint).collect(),
            ..Scene::default()
        }
    }

    fn shape(node: &Node<'_>) -> String {
        let children: Vec<String> = node.children.iter().map(shape).collect();
        format!("{}({})", node.object, children.join(" "))
    }

    const PIN: JointKind = JointKind::Revolute { at: Vector::new(0.0, 0.0), limits: None };

    #[test]
    fn every_object_is_on_one_tree_and_loops_of_fixed_joints_do_no_harm() {
        let fixed = JointKind::Fixed;
        let scene = scene(&[(3, 2, PIN), (0, 2, fixed), (2, 4, fixed), (4, 0, fixed)]);
        let trees = forest(&scene).expect("trees");
        let shapes: Vec<String> = trees.iter().map(shape).collect();
        assert_eq!(shapes, ["0(2(4() 3()))", "1()"]);
    }

    #[test]
    fn a_loop_that_could_move_is_refused() {
        let scene = scene(&[(0, 1, PIN), (1, 2, JointKind::Fixed), (0, 2, JointKind::Fixed)]);
        let error = forest(&scene).err().expect("a loop");
        assert_eq!(error, ExportError::JointLoop { between: ["o0".into(), "o1".into()] });
    }
}

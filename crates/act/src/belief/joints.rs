//! Construction of physics from pair beliefs.

use pushplan::{
    geometry::{Pose, Vector},
    scene::{DisjointSets, Joint, JointKind, Physics, Scene, Span, State},
};

use super::pair::{JointType, PairBelief};

/// Returns the most probable physics, with anchors and axes for the poses of `state`.
///
/// Joints close no loop; of the joints in a loop, the more probable ones are kept.
pub(super) fn likeliest(scene: &Scene, pairs: &[PairBelief], state: &State) -> Physics {
    let types: Vec<JointType> = pairs.iter().map(PairBelief::likeliest).collect();
    of_types(scene, pairs, state, &types)
}

/// Returns the physics in which pairs have joints of these `types`, at their most probable
/// geometry.
///
/// Joints close no loop; of the joints in a loop, the more probable ones are kept.
pub(super) fn of_types(
    scene: &Scene,
    pairs: &[PairBelief],
    state: &State,
    types: &[JointType],
) -> Physics {
    let mut physics = Physics::stated(scene);
    let mut order: Vec<(&PairBelief, JointType)> =
        pairs.iter().zip(types.iter().copied()).collect();
    order.sort_by(|a, b| b.0.rank().total_cmp(&a.0.rank()));
    let mut sets = DisjointSets::new(scene.objects.len());
    for (pair, kind) in order {
        if kind != JointType::None && sets.join(pair.between) {
            physics.joints.extend(pair.joint(kind, poses(state, pair.between)));
        }
    }
    physics.joints.sort_by_key(|joint| joint.between);
    physics
}

/// Returns `physics` with the joint of one pair changed.
///
/// If this closes a loop, the least probable joint in the loop is removed.
pub(super) fn with(
    physics: &Physics,
    pairs: &[PairBelief],
    (pair, kind): (&PairBelief, JointType),
    state: &State,
) -> Physics {
    let mut physics = physics.clone();
    physics.joints.retain(|joint| joint.between != pair.between);
    let Some(joint) = pair.joint(kind, poses(state, pair.between)) else { return physics };
    let joined = |between: [usize; 2]| {
        let of = pairs.iter().find(|pair| pair.between == between);
        of.map_or(f64::INFINITY, PairBelief::joined)
    };
    let weakest = path(&physics.joints, pair.between).into_iter().min_by(|&one, &other| {
        let of = |k: usize| joined(physics.joints[k].between);
        of(one).total_cmp(&of(other))
    });
    if let Some(weakest) = weakest {
        physics.joints.remove(weakest);
    }
    physics.joints.push(joint);
    physics.joints.sort_by_key(|joint| joint.between);
    physics
}

/// Moves known joints from the poses stated in `scene` to the poses in `state`.
pub fn carried(joints: &[Joint], scene: &Scene, state: &State) -> Vec<Joint> {
    let now = |joint: &Joint| {
        if joint.between.iter().all(|&k| state.poses[k] == scene.objects[k].pose) {
            return joint.clone();
        }
        let frames = joint.frames(&scene.objects);
        let [first, second] = [0, 1].map(|k| state.poses[joint.between[k]] * frames[k]);
        let left = |limits: Option<Span>, gone: f64| {
            // An observed pose may exceed a limit slightly; the initial pose never does.
            limits.map(|span| Span::new((span.low - gone).min(0.0), (span.high - gone).max(0.0)))
        };
        let kind = match joint.kind {
            JointKind::Fixed => JointKind::Fixed,
            JointKind::Revolute { limits, .. } => JointKind::Revolute {
                at: 0.5 * (first.position + second.position),
                limits: left(limits, second.heading - first.heading),
            },
            JointKind::Prismatic { limits, .. } => {
                let axis = first.vector(Vector::x());
                let gone = axis.dot(&(second.position - first.position));
                JointKind::Prismatic { axis, limits: left(limits, gone) }
            }
        };
        Joint { kind, ..joint.clone() }
    };
    joints.iter().map(now).collect()
}

fn poses(state: &State, between: [usize; 2]) -> [&Pose; 2] {
    between.map(|k| &state.poses[k])
}

/// Returns the indices of the joints on the path between two objects, which is unique because
/// joints close no loop. The result is empty without a path.
fn path(joints: &[Joint], [from, to]: [usize; 2]) -> Vec<usize> {
    let mut ways: Vec<(usize, Vec<usize>)> = vec![(from, Vec::new())];
    while let Some((at, way)) = ways.pop() {
        if at == to {
            return way;
        }
        for (k, joint) in joints.iter().enumerate().filter(|(k, _)| !way.contains(k)) {
            let [a, b] = joint.between;
            if a == at || b == at {
                ways.push((a + b - at, [&way[..], &[k]].concat()));
            }
        }
    }
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pushplan::scene::Object;

    #[test]
    fn known_joints_go_with_their_objects_and_use_up_their_limits() {
        let can = |name: &str, x| Object::cylinder(name, 0.04, 0.1).at(x, 0.0, 0.0);
        let limits = Some(Span::new(-0.5, 0.5));
        let (at, axis) = (Vector::new(0.05, 0.0), Vector::y());
        let scene = Scene::new([can("a", 0.0), can("b", 0.1), can("c", 0.2)])
            .with_joint([0, 1], JointKind::Revolute { at, limits })
            .with_joint([1, 2], JointKind::Prismatic { axis, limits });
        assert_eq!(carried(&scene.joints, &scene, &scene.start()), scene.joints);
        // The first object turned left and carried the others; the second turned a further 0.2 rad.
        let turned = Pose::new(0.3, 0.1, 0.4);
        let hinge = Pose { position: turned.point(at), heading: 0.6 };
        let mut state = scene.start();
        state.poses[0] = turned;
        state.poses[1] = hinge * Pose::new(0.05, 0.0, 0.0);
        state.poses[2] = hinge * Pose::new(0.15, 0.1, 0.0);
        let joints = carried(&scene.joints, &scene, &state);
        let JointKind::Revolute { at: now, limits: Some(left) } = joints[0].kind else { panic!() };
        assert!((now - hinge.position).norm() < 1e-12);
        assert!((left.low + 0.7).abs() < 1e-12 && (left.high - 0.3).abs() < 1e-12, "{left:?}");
        let JointKind::Prismatic { axis, limits: Some(left) } = joints[1].kind else { panic!() };
        assert!((axis - hinge.vector(Vector::y())).norm() < 1e-12);
        assert!((left.low + 0.6).abs() < 1e-12 && (left.high - 0.4).abs() < 1e-12, "{left:?}");
    }

    #[test]
    fn the_way_between_two_objects_is_found_and_no_other() {
        let joint = |a, b| Joint::new([a, b], JointKind::Fixed);
        let joints = [joint(0, 1), joint(1, 2), joint(1, 3), joint(4, 5)];
        assert_eq!(path(&joints, [0, 3]), [0, 2]);
        assert_eq!(path(&joints, [3, 0]), [2, 0]);
        assert!(path(&joints, [0, 5]).is_empty());
    }
}

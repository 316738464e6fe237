//! Physics from what is believed of pairs.

use crate::{
    geometry::Pose,
    scene::{DisjointSets, Joint, Physics, Scene, State},
};

use super::pair::{JointType, PairBelief};

/// The likeliest physics, with anchors and axes where they are in `state`. Joints close no loop;
/// where they would, the likelier ones stay.
pub(super) fn likeliest(scene: &Scene, pairs: &[PairBelief], state: &State) -> Physics {
    let types: Vec<JointType> = pairs.iter().map(PairBelief::likeliest).collect();
    of_types(scene, pairs, state, &types)
}

/// Physics in which pairs are joined as `types` say, where their joints would most likely be. Joints
/// close no loop; where they would, the likelier ones stay.
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

/// `physics` with one of `pairs` joined in another way; where that closed a loop, the joint in it
/// that is least likely gives way.
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

fn poses(state: &State, between: [usize; 2]) -> [&Pose; 2] {
    between.map(|k| &state.poses[k])
}

/// Indices of the joints, which close no loop, on the way between two objects; none if there is no
/// way.
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
    use crate::scene::JointKind;

    #[test]
    fn the_way_between_two_objects_is_found_and_no_other() {
        let joint = |a, b| Joint::new([a, b], JointKind::Fixed);
        let joints = [joint(0, 1), joint(1, 2), joint(1, 3), joint(4, 5)];
        assert_eq!(path(&joints, [0, 3]), [0, 2]);
        assert_eq!(path(&joints, [3, 0]), [2, 0]);
        assert!(path(&joints, [0, 5]).is_empty());
    }
}

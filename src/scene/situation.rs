//! The present state of a scene, with a belief about it.

use std::sync::Arc;

use crate::geometry::{Pose, Vector};

use super::{GRAVITY, JointKind, Physics, Scene, State};

/// The start of planning. Planning again from an intermediate state or under another belief is the
/// same call with another situation.
#[derive(Clone, Debug, PartialEq)]
pub struct Situation {
    /// Scene.
    pub scene: Arc<Scene>,
    /// Poses and velocities of all objects.
    pub start: State,
    /// Belief about the objects.
    pub physics: Arc<Physics>,
}

impl Situation {
    /// Returns the scene as stated, at rest.
    pub fn stated(scene: &Scene) -> Self {
        let physics = Arc::new(Physics::stated(scene));
        Self { start: scene.start(), physics, scene: Arc::new(scene.clone()) }
    }

    /// Moves everything visible as one: a rotation by `turn` radians about a point, and a
    /// translation, metres. The result is a situation seen from a slightly different viewpoint.
    pub fn moved_as_one(&self, about: Vector, shift: Vector, turn: f64) -> Self {
        let by = Pose { position: about + shift, heading: turn };
        let moved = |pose: &mut Pose| {
            let arm = Pose { position: pose.position - about, ..*pose };
            *pose = by * arm;
        };
        let carried = |kind: &mut JointKind| match kind {
            JointKind::Fixed => {}
            JointKind::Revolute { at, .. } => *at = by.point(*at - about),
            JointKind::Prismatic { axis, .. } => *axis = by.vector(*axis),
        };
        let mut situation = self.clone();
        let scene = Arc::make_mut(&mut situation.scene);
        for object in &mut scene.objects {
            moved(&mut object.pose);
            object.kept_from.iter_mut().for_each(moved);
        }
        scene.obstacles.iter_mut().for_each(|obstacle| moved(&mut obstacle.pose));
        scene.mounts.iter_mut().for_each(|mount| carried(&mut mount.kind));
        scene.joints.iter_mut().for_each(|joint| carried(&mut joint.kind));
        let physics = Arc::make_mut(&mut situation.physics);
        physics.joints.iter_mut().for_each(|joint| carried(&mut joint.kind));
        situation.start.poses.iter_mut().for_each(moved);
        situation
    }

    /// Returns the resting state after `state` without any further contact.
    ///
    /// Sliding under the ellipsoidal limit surface decelerates at about mu g along the generalised
    /// velocity s = sqrt(v^2 + c^2 omega^2). It lasts s / (mu g) and covers half the distance that
    /// the present speeds would cover in that time. Exact without spin; a comparison of the stops
    /// of a push, never a result.
    pub fn coasted(&self, state: &State) -> State {
        let mut rest = state.clone();
        for k in 0..self.scene.objects.len() {
            let velocity = state.velocities[k];
            let c = self.physics.feet[k].mean_radius;
            let s = velocity.linear.norm().hypot(c * velocity.angular);
            let braking = self.physics.support_friction(k) * GRAVITY;
            if s > 0.0 && braking > 0.0 {
                let time = 0.5 * s / braking;
                rest.poses[k].position += velocity.linear * time;
                rest.poses[k].heading += velocity.angular * time;
            }
            rest.velocities[k] = Default::default();
        }
        rest
    }
}

//! Groups of objects that move as one rigid body.
//!
//! Objects that fixed joints connect become one body with a solid for each of them, because
//! separate bodies bend. In a row of twelve, pushed at its middle at 0.21 m/s, joints yielded by
//! 0.95 mm and 0.56 degrees each in either engine at 1/240 s. In a row of alternately light and
//! heavy ones (1 : 10) they yielded by 4 mm and 2.3 degrees. A single body does not bend at all and
//! costs less. Every object keeps its own mass and its own friction with the table.

use crate::geometry::{Pose, Vector, cross};
use crate::scene::{Joint, JointKind, Physics, Scene, State, Velocity};

/// A rigid body at its start.
pub(super) struct Group {
    /// Indices of its objects, in order.
    pub objects: Vec<usize>,
    /// Pose of a single object; otherwise the centre of mass, with heading zero.
    pub pose: Pose,
    /// Velocity of the centre of mass.
    pub velocity: Velocity,
}

impl Group {
    /// Returns the bodies of a scene in `state` under `physics`, in the order of their first
    /// objects.
    pub fn of(scene: &Scene, state: &State, physics: &Physics) -> Vec<Group> {
        let members = physics.rigid_groups().members.into_iter();
        members.map(|objects| Self::at(scene, state, &physics.masses, objects)).collect()
    }

    fn at(scene: &Scene, state: &State, masses: &[f64], objects: Vec<usize>) -> Group {
        if let [only] = objects[..] {
            return Group { objects, pose: state.poses[only], velocity: state.velocities[only] };
        }
        let sum = |value: &dyn Fn(usize) -> Vector| -> Vector {
            objects.iter().map(|&index| masses[index] * value(index)).sum()
        };
        let mass: f64 = objects.iter().map(|&index| masses[index]).sum();
        let centre = sum(&|index| state.poses[index].position) / mass;
        let linear = sum(&|index| state.velocities[index].linear) / mass;
        // The angular velocity with the objects' angular momentum about the centre.
        let (mut momentum, mut inertia) = (0.0, 0.0);
        for &index in &objects {
            let arm = state.poses[index].position - centre;
            let velocity = state.velocities[index];
            let own = scene.objects[index].shape.footprint().gyration_radius().powi(2);
            momentum += masses[index] * (own * velocity.angular + cross(arm, velocity.linear));
            inertia += masses[index] * (own + arm.norm_squared());
        }
        let velocity = Velocity { linear, angular: momentum / inertia };
        Group { objects, pose: Pose { position: centre, heading: 0.0 }, velocity }
    }
}

/// Returns `true` if a group rests on the table by itself: no joint holds it, and it is nowhere
/// near the edge.
pub(super) fn stands(scene: &Scene, state: &State, physics: &Physics, group: &Group) -> bool {
    let joined = |object: usize| {
        let moves = |joint: &&Joint| joint.kind != JointKind::Fixed;
        let mut joints = physics.joints.iter().filter(moves);
        joints.any(|joint| joint.between.contains(&object)) || scene.mount(object).is_some()
    };
    let inside = |object: usize| {
        let radius = scene.objects[object].shape.footprint().bounding_radius();
        let position = state.poses[object].position;
        scene.table_top.is_none_or(|top| top.holds_within(position, -radius))
    };
    group.objects.iter().all(|&object| !joined(object) && inside(object))
}

/// An object on its body.
pub(super) struct Member {
    /// Index of the body.
    pub body: usize,
    /// The object's pose in the body's frame.
    pub local: Pose,
    /// The object's pose when the world was built.
    pub start: Pose,
    /// Vector from the body's centre to the object's, in world axes when the world was built.
    arm: Vector,
}

impl Member {
    /// Returns object `index` in `state` as a member of its group; bodies are numbered as `groups`.
    pub fn of(groups: &[Group], state: &State, index: usize) -> Self {
        // Every object is in exactly one group.
        let body = groups.iter().position(|group| group.objects.contains(&index)).unwrap_or(0);
        let (group, start) = (&groups[body], state.poses[index]);
        // A single object has exactly the pose of its body.
        let (local, arm) = match group.objects[..] {
            [_] => (Pose::default(), Vector::zeros()),
            _ => (group.pose.inverse() * start, start.position - group.pose.position),
        };
        Self { body, local, start, arm }
    }

    /// Returns the vector from the body's centre to the object's after a rotation of the body by
    /// `turned` radians.
    pub fn arm(&self, turned: f64) -> Vector {
        Pose { position: Vector::zeros(), heading: turned }.vector(self.arm)
    }

    /// Returns the object's pose after a translation and rotation of its body.
    pub fn pose(&self, moved: Vector, turned: f64) -> Pose {
        let swung = if turned == 0.0 { Vector::zeros() } else { self.arm(turned) - self.arm };
        Pose {
            position: self.start.position + (moved + swung),
            heading: self.start.heading + turned,
        }
    }

    /// Returns the object's velocity for the velocity of its body, rotated by `turned` radians.
    pub fn velocity(&self, body: Velocity, turned: f64) -> Velocity {
        Velocity { linear: body.at(self.arm(turned)), ..body }
    }
}

#[cfg(test)]
mod tests;

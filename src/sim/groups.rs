//! Which objects move as one rigid body.
//!
//! Objects that fixed joints hold together become one body with a solid for each of them. As
//! separate bodies a row of twelve bends: pushed at its middle at 0.21 m/s its joints gave way by
//! 0.95 mm and 0.56 degrees each in either engine at 1/240 s, and a row of light and heavy ones
//! in turn (1 : 10) by 4 mm and 2.3 degrees; one body does not bend at all and costs less. Every
//! object keeps its own mass and its own friction with the table.

use crate::geometry::{Pose, Vector, cross};
use crate::scene::{Physics, Scene, State, Velocity};

/// One rigid body, as it starts.
pub(super) struct Group {
    /// Indices of its objects, in order.
    pub objects: Vec<usize>,
    /// A single object's own pose; the centre of mass, unturned, of several.
    pub pose: Pose,
    /// Velocity of the centre of mass.
    pub velocity: Velocity,
}

impl Group {
    /// The bodies of a scene in `state` under `physics`, in the order of their first objects.
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
        // The turning that has the objects' angular momentum about the centre.
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

/// An object on its body.
pub(super) struct Member {
    /// Index of the body.
    pub body: usize,
    /// The object's pose in the body's frame.
    pub local: Pose,
    /// The object's pose when the world was built.
    pub start: Pose,
    /// From the body's centre to the object's, in world axes when the world was built.
    arm: Vector,
}

impl Member {
    /// Object `index` in `state` on its one of `groups`, whose bodies are numbered in order.
    pub fn of(groups: &[Group], state: &State, index: usize) -> Self {
        // Every object is in one group.
        let body = groups.iter().position(|group| group.objects.contains(&index)).unwrap_or(0);
        let (group, start) = (&groups[body], state.poses[index]);
        // A single object is its body, to the bit.
        let (local, arm) = match group.objects[..] {
            [_] => (Pose::default(), Vector::zeros()),
            _ => (group.pose.inverse() * start, start.position - group.pose.position),
        };
        Self { body, local, start, arm }
    }

    /// From the body's centre to the object's after the body has turned by `turned` radians.
    pub fn arm(&self, turned: f64) -> Vector {
        Pose { position: Vector::zeros(), heading: turned }.vector(self.arm)
    }

    /// The object's pose after its body has moved and turned.
    pub fn pose(&self, moved: Vector, turned: f64) -> Pose {
        let swung = if turned == 0.0 { Vector::zeros() } else { self.arm(turned) - self.arm };
        Pose {
            position: self.start.position + (moved + swung),
            heading: self.start.heading + turned,
        }
    }

    /// The object's velocity when its body has `body`'s, having turned by `turned` radians.
    pub fn velocity(&self, body: Velocity, turned: f64) -> Velocity {
        Velocity { linear: body.at(self.arm(turned)), ..body }
    }
}

#[cfg(test)]
mod tests;

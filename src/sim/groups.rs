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
mod tests {
    use super::*;
    use crate::geometry::Shape;
    use crate::scene::{Joint, JointKind, Object};

    fn scene() -> (Scene, State) {
        let shape = Shape::Cylinder { radius: 0.05, height: 0.1 };
        let object = |k: usize| {
            Object::new(format!("o{k}"), shape).mass(1.0 + k as f64).at(0.1 * k as f64, 0.0, 0.3)
        };
        let joint = |a, b, kind| Joint::new([a, b], kind);
        let pin = JointKind::Revolute { at: Vector::zeros(), limits: None };
        let joints = vec![
            joint(3, 2, JointKind::Fixed),
            joint(1, 2, pin),
            joint(0, 3, JointKind::Fixed),
            joint(0, 2, JointKind::Fixed),
        ];
        let objects: Vec<Object> = (0..5).map(object).collect();
        let scene = Scene { joints, ..Scene::new(objects) };
        let state = scene.start();
        (scene, state)
    }

    #[test]
    fn fixed_joints_make_groups_and_loops_of_them_do_no_harm() {
        let (scene, state) = scene();
        let groups = Group::of(&scene, &state, &Physics::stated(&scene));
        let objects: Vec<Vec<usize>> = groups.iter().map(|group| group.objects.clone()).collect();
        assert_eq!(objects, [vec![0, 2, 3], vec![1], vec![4]]);
        assert_eq!(groups[1].pose, scene.objects[1].pose);
        assert!((groups[0].pose.position.x - (0.6 + 1.2) / 8.0).abs() < 1e-15);
    }

    #[test]
    fn a_turning_group_gives_its_objects_their_velocities_back() {
        let (scene, mut state) = scene();
        let about = Velocity { linear: Vector::new(0.1, -0.2), angular: 0.7 };
        for (pose, velocity) in state.poses.iter().zip(&mut state.velocities) {
            *velocity = Velocity { linear: about.at(pose.position), ..about };
        }
        let groups = Group::of(&scene, &state, &Physics::stated(&scene));
        for index in 0..5 {
            let member = Member::of(&groups, &state, index);
            let velocity = member.velocity(groups[member.body].velocity, 0.0);
            assert!((velocity.linear - state.velocities[index].linear).norm() < 1e-14);
            assert!((velocity.angular - 0.7).abs() < 1e-14);
            assert_eq!(member.pose(Vector::zeros(), 0.0), state.poses[index]);
        }
    }
}

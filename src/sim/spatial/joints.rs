//! Joints in the 3-D engine, between objects and to the world.

use std::f64::consts::FRAC_PI_2;

use rapier3d_f64::prelude::{
    GenericJointBuilder, JointAxesMask, JointAxis, MotorModel, PhysicsWorld, Pose3,
    RigidBodyBuilder, RigidBodyHandle, Rotation,
};

use crate::geometry::Pose;
use crate::scene::{Joint, JointKind, Scene};
use crate::sim::joint_limits::{spring, within, zero};

use super::place::{LOCAL, to_rapier};

/// An object as an anchor of joints on its body.
pub(in crate::sim) struct Anchored {
    pub body: RigidBodyHandle,
    /// The object's pose in the body's frame.
    pub local: Pose,
    /// Height of the body's frame above the table, metres.
    pub height: f64,
}

impl Anchored {
    /// Returns a frame of the object, on the table, in the frame of its body.
    fn frame(&self, at: Pose, axis: Rotation) -> Pose3 {
        turned(to_rapier(&(self.local * at), &LOCAL, -self.height), axis)
    }
}

/// Adds all joints of a scene between the bodies of its objects, and to the world. Fixed joints
/// inside a body need none.
pub(in crate::sim) fn add_joints(
    world: &mut PhysicsWorld,
    scene: &Scene,
    (joints, frame): (&[Joint], &Pose),
    objects: &[Anchored],
) {
    for joint in joints {
        let [first, second] = joint.between.map(|object| &objects[object]);
        if first.body == second.body {
            continue;
        }
        let (axes, free, axis) = form(&joint.kind);
        let [at_first, at_second] = joint.frames(&scene.objects);
        let mut built = GenericJointBuilder::new(axes)
            .local_frame1(first.frame(at_first * zero(&joint.kind), axis))
            .local_frame2(second.frame(at_second, axis));
        // The frames coincide at the stated poses of the objects, which therefore are the zero.
        if let Some(limits) = within(&joint.kind) {
            built = built.limits(free, limits);
        }
        world.insert_impulse_joint(first.body, second.body, built);
    }
    for mount in &scene.mounts {
        let (axes, free, axis) = form(&mount.kind);
        let object = &objects[mount.object];
        // The vertical direction stays free, so that the object rests on the table and has
        // friction.
        let upwards = match mount.kind {
            JointKind::Fixed | JointKind::Prismatic { .. } => JointAxesMask::LIN_Z,
            JointKind::Revolute { .. } => JointAxesMask::LIN_X,
        };
        let [fixed, own] = mount.frames(&scene.objects);
        let fixed = to_rapier(&(fixed * zero(&mount.kind)), frame, 0.0);
        let mut built = GenericJointBuilder::new(axes.difference(upwards))
            .local_frame1(turned(fixed, axis))
            .local_frame2(object.frame(own, axis));
        if let Some(limits) = within(&mount.kind) {
            built = built.limits(free, limits);
        }
        if let Some((rest, stiffness, damping)) = spring(mount) {
            built = built.motor_model(free, MotorModel::ForceBased);
            built = built.motor_position(free, rest, stiffness, damping);
        }
        let fixed = world.insert_body(RigidBodyBuilder::fixed());
        world.insert_impulse_joint(fixed, object.body, built);
    }
}

/// Returns the axes that a joint locks, the free axis, and the rotation of its frame.
fn form(kind: &JointKind) -> (JointAxesMask, JointAxis, Rotation) {
    match kind {
        JointKind::Fixed => (JointAxesMask::LOCKED_FIXED_AXES, JointAxis::LinX, Rotation::IDENTITY),
        JointKind::Prismatic { .. } => {
            (JointAxesMask::LOCKED_PRISMATIC_AXES, JointAxis::LinX, Rotation::IDENTITY)
        }
        JointKind::Revolute { .. } => {
            // rapier's axis is the frame's x axis; this rotation makes it vertical.
            let upright = Rotation::from_rotation_y(-FRAC_PI_2);
            (JointAxesMask::LOCKED_REVOLUTE_AXES, JointAxis::AngX, upright)
        }
    }
}

fn turned(frame: Pose3, axis: Rotation) -> Pose3 {
    Pose3::from_parts(frame.translation, frame.rotation * axis)
}

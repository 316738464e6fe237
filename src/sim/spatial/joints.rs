//! Joints in the 3-D engine, between objects and to the world.

use std::f64::consts::FRAC_PI_2;

use rapier3d_f64::prelude::{
    GenericJointBuilder, JointAxesMask, JointAxis, Pose3, RigidBodyBuilder, Rotation,
};

use crate::geometry::Pose;
use crate::scene::{JointKind, Physics, Scene};
use crate::sim::stops::{within, zero};

use super::{LOCAL, SpatialWorld, to_rapier};

impl<const TIPS: bool> SpatialWorld<TIPS> {
    pub(super) fn add_joints(&mut self, scene: &Scene, physics: &Physics) {
        let form = |kind: &JointKind| match kind {
            // Its objects are one body.
            JointKind::Fixed => None,
            JointKind::Prismatic { .. } => {
                Some((JointAxesMask::LOCKED_PRISMATIC_AXES, JointAxis::LinX, Rotation::IDENTITY))
            }
            JointKind::Revolute { .. } => {
                // rapier turns about the frame's x axis; this makes it the vertical.
                let upright = Rotation::from_rotation_y(-FRAC_PI_2);
                Some((JointAxesMask::LOCKED_REVOLUTE_AXES, JointAxis::AngX, upright))
            }
        };
        for joint in &physics.joints {
            let Some((axes, free, axis)) = form(&joint.kind) else { continue };
            let frame = |object: usize, at: Pose| {
                let (member, _) = &self.objects[object];
                let below = -self.bodies[member.body].first_position.z;
                let frame = to_rapier(&(member.local * at), &LOCAL, below);
                Pose3::from_parts(frame.translation, frame.rotation * axis)
            };
            let ([first, second], [at_first, at_second]) =
                (joint.between, joint.frames(&scene.objects));
            let mut built = GenericJointBuilder::new(axes)
                .local_frame1(frame(first, at_first * zero(&joint.kind)))
                .local_frame2(frame(second, at_second));
            // The frames coincide where the scene states its objects, so zero is there.
            if let Some(limits) = within(&joint.kind) {
                built = built.limits(free, limits);
            }
            let [first, second] =
                [first, second].map(|object| self.bodies[self.objects[object].0.body].handle);
            self.world.insert_impulse_joint(first, second, built);
        }
        for mount in &scene.mounts {
            let Some((axes, free, axis)) = form(&mount.kind) else { continue };
            let (member, _) = &self.objects[mount.object];
            let body = &self.bodies[member.body];
            let turned = |frame: Pose3| Pose3::from_parts(frame.translation, frame.rotation * axis);
            // It stands on the table all the same, and rubs.
            let upwards = match mount.kind {
                JointKind::Prismatic { .. } => JointAxesMask::LIN_Z,
                _ => JointAxesMask::LIN_X,
            };
            let axes = axes.difference(upwards);
            let [world, own] = mount.frames(&scene.objects);
            let own = to_rapier(&(member.local * own), &LOCAL, -body.first_position.z);
            let mut built = GenericJointBuilder::new(axes)
                .local_frame1(turned(to_rapier(&(world * zero(&mount.kind)), &self.frame, 0.0)))
                .local_frame2(turned(own));
            if let Some(limits) = within(&mount.kind) {
                built = built.limits(free, limits);
            }
            let handle = body.handle;
            let fixed = self.world.insert_body(RigidBodyBuilder::fixed());
            self.world.insert_impulse_joint(fixed, handle, built);
        }
    }
}

//! Joints in the planar engine, between objects and to the world.

use rapier2d_f64::prelude::{
    GenericJointBuilder, JointAxesMask, JointAxis, MotorModel, RigidBodyBuilder,
};

use crate::geometry::Vector;
use crate::scene::{JointKind, Physics, Scene};
use crate::sim::joint_limits::{spring, within, zero};

use super::{PlanarWorld, to_rapier};

impl PlanarWorld {
    pub(super) fn add_joints(&mut self, scene: &Scene, physics: &Physics) {
        let form = |kind: &JointKind| match kind {
            // The joined objects are one body.
            JointKind::Fixed => None,
            JointKind::Revolute { .. } => {
                Some((JointAxesMask::LOCKED_REVOLUTE_AXES, JointAxis::AngX))
            }
            JointKind::Prismatic { .. } => {
                Some((JointAxesMask::LOCKED_PRISMATIC_AXES, JointAxis::LinX))
            }
        };
        for joint in &physics.joints {
            let Some((axes, free)) = form(&joint.kind) else { continue };
            let [first, second] = joint.between.map(|index| &self.objects[index].0);
            let [at_first, at_second] = joint.frames(&scene.objects);
            let mut built = GenericJointBuilder::new(axes)
                .local_frame1(to_rapier(
                    &(first.local * at_first * zero(&joint.kind)),
                    Vector::zeros(),
                ))
                .local_frame2(to_rapier(&(second.local * at_second), Vector::zeros()));
            // The frames coincide at the stated poses of the objects, so the zero is there or
            // before it.
            if let Some(limits) = within(&joint.kind) {
                built = built.limits(free, limits);
            }
            let [first, second] = [first, second].map(|member| self.bodies[member.body].handle);
            self.world.insert_impulse_joint(first, second, built);
        }
        for mount in &scene.mounts {
            let (axes, free) = match form(&mount.kind) {
                Some((axes, free)) => (axes, Some(free)),
                None => (JointAxesMask::LOCKED_FIXED_AXES, None),
            };
            let member = &self.objects[mount.object].0;
            let [world, own] = mount.frames(&scene.objects);
            let mut built = GenericJointBuilder::new(axes)
                .local_frame1(to_rapier(&(world * zero(&mount.kind)), self.origin))
                .local_frame2(to_rapier(&(member.local * own), Vector::zeros()));
            if let (Some(free), Some(limits)) = (free, within(&mount.kind)) {
                built = built.limits(free, limits);
            }
            if let (Some(free), Some((rest, stiffness, damping))) = (free, spring(mount)) {
                built = built.motor_model(free, MotorModel::ForceBased);
                built = built.motor_position(free, rest, stiffness, damping);
            }
            let fixed = self.world.insert_body(RigidBodyBuilder::fixed());
            self.world.insert_impulse_joint(fixed, self.bodies[member.body].handle, built);
        }
    }
}

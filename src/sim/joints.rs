//! Where a joint sits on its two objects, for either engine.

use crate::geometry::Pose;
use crate::scene::{Joint, JointKind, Scene};

/// The joint's own frame, seen from each of the two objects.
///
/// A revolute joint turns about the frame's vertical; a prismatic one slides along its x axis.
pub(super) struct JointFrames {
    /// In the frame of the first object.
    pub(super) first: Pose,
    /// In the frame of the second object.
    pub(super) second: Pose,
}

impl JointFrames {
    /// The frames of `joint`, from the poses that the scene states (not from where the objects
    /// are now, which may have turned or slid since).
    pub(super) fn new(scene: &Scene, joint: &Joint) -> Self {
        let [first, second] = joint.between.map(|index| scene.objects[index].pose);
        let world = match joint.kind {
            JointKind::Fixed => first,
            JointKind::Revolute { at, .. } => Pose { position: at, heading: 0.0 },
            JointKind::Prismatic { axis, .. } => {
                Pose { position: first.position, heading: axis.y.atan2(axis.x) }
            }
        };
        Self { first: first.inverse() * world, second: second.inverse() * world }
    }
}

/// Whether the two objects of a joint also touch each other: those of a fixed joint cannot move
/// against each other, and revolute neighbours without contact fold through each other.
pub(super) fn neighbours_touch(kind: &JointKind) -> bool {
    !matches!(kind, JointKind::Fixed)
}

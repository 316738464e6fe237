//! Joints to the world: doors, drawers, lids, sliders.

use serde::{Deserialize, Serialize};

use crate::geometry::Pose;

use super::serde_planar::planar_only;
use super::{JointKind, Object, Span, is_zero};

/// A revolute or prismatic joint between an object and the world.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorldJoint {
    /// Index into [`Scene::objects`](super::Scene::objects).
    pub object: usize,
    /// Motion that it allows; angles and lengths count from the start of the object.
    pub kind: JointKind,
    /// Stiffness of a damped spring that pulls the object back to its start, N/m, or N m per radian
    /// of a revolute joint. Only the engines simulate springs, so only hidden worlds have them.
    #[serde(with = "planar_only", default, skip_serializing_if = "is_zero")]
    pub spring: f64,
}

impl WorldJoint {
    /// Ratio of damping and stiffness of a spring, seconds: the time in which the object returns.
    pub const RETURN: f64 = 0.1;

    /// Creates a joint without a spring.
    pub fn new(object: usize, kind: JointKind) -> Self {
        Self { object, kind, spring: 0.0 }
    }

    /// Returns the joint's frame in the world and relative to the object. A revolute joint rotates
    /// about the frame's origin; a prismatic joint slides along its x axis.
    pub fn frames(&self, objects: &[Object]) -> [Pose; 2] {
        let start = objects[self.object].pose;
        let world = match self.kind {
            JointKind::Fixed => start,
            JointKind::Revolute { at, .. } => Pose { position: at, heading: 0.0 },
            JointKind::Prismatic { axis, .. } => {
                Pose { position: start.position, heading: axis.y.atan2(axis.x) }
            }
        };
        [world, start.inverse() * world]
    }

    /// Returns the range of rotations (radians) or translations (metres) against the start, or
    /// `None` without limits.
    pub fn limits(&self) -> Option<Span> {
        self.kind.limits()
    }

    /// Returns the rotation (radians) or translation (metres) of the object from `start` to `now`.
    pub fn come(&self, start: &Pose, now: &Pose) -> f64 {
        match self.kind {
            JointKind::Fixed => 0.0,
            // Headings are not wrapped, so they count full turns.
            JointKind::Revolute { .. } => now.heading - start.heading,
            JointKind::Prismatic { axis, .. } => axis.dot(&(now.position - start.position)),
        }
    }

    /// Returns the joint for an object that starts at `now` instead of at `start`.
    pub fn carried(&self, start: &Pose, now: &Pose) -> Self {
        let come = self.come(start, now);
        // An observed pose may be slightly beyond a limit; a start may not.
        let left = |limits: Option<Span>| {
            limits.map(|span| Span::new((span.low - come).min(0.0), (span.high - come).max(0.0)))
        };
        let kind = match self.kind {
            JointKind::Fixed => JointKind::Fixed,
            JointKind::Revolute { at, limits } => JointKind::Revolute { at, limits: left(limits) },
            JointKind::Prismatic { axis, limits } => {
                JointKind::Prismatic { axis, limits: left(limits) }
            }
        };
        Self { kind, ..*self }
    }

    /// Returns the pose of the object after this rotation (radians) or translation (metres) from
    /// `start`.
    pub fn pose(&self, start: &Pose, come: f64) -> Pose {
        match self.kind {
            JointKind::Fixed => *start,
            JointKind::Revolute { at, .. } => {
                let turn = Pose { position: Default::default(), heading: come };
                Pose {
                    position: at + turn.vector(start.position - at),
                    heading: start.heading + come,
                }
            }
            JointKind::Prismatic { axis, .. } => {
                Pose { position: start.position + come * axis, ..*start }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Vector;

    #[test]
    fn a_door_keeps_its_hinge_and_its_limits_wherever_it_starts_from() {
        let limits = Some(Span::new(0.0, 1.5));
        let at = Vector::new(0.4, 0.1);
        let door = WorldJoint::new(0, JointKind::Revolute { at, limits });
        let start = Pose::new(0.6, 0.1, 0.3);
        let open = door.pose(&start, 1.0);
        assert!((open.position - at).norm() - 0.2 < 1e-12 && open.heading == 1.3);
        assert!((door.come(&start, &open) - 1.0).abs() < 1e-12);
        let left = door.carried(&start, &open).limits().expect("limits");
        assert!((left.low + 1.0).abs() < 1e-12 && (left.high - 0.5).abs() < 1e-12);
        let drawer = WorldJoint::new(0, JointKind::Prismatic { axis: Vector::x(), limits: None });
        assert_eq!(drawer.come(&start, &drawer.pose(&start, 0.25)), 0.25);
    }
}

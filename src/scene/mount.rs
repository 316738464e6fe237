//! Joints to the world: doors, drawers, lids, sliders.

use serde::{Deserialize, Serialize};

use crate::geometry::Pose;

use super::{JointKind, Object, Span};

/// How an object may move against the world: a revolute or a prismatic joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mount {
    /// Index into [`Scene::objects`](super::Scene::objects).
    pub object: usize,
    /// What it allows. Turns and shifts are those of the object, from the start.
    pub kind: JointKind,
}

impl Mount {
    /// The joint's frame in the world, and as seen from the object. A revolute joint turns about the
    /// frame's origin; a prismatic one slides along its x axis.
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

    /// The range of turns (radians) or shifts (metres) against the start, where limited.
    pub fn limits(&self) -> Option<Span> {
        self.kind.limits()
    }

    /// How far the object has turned (radians) or slid (metres) from `start` to `now`.
    pub fn come(&self, start: &Pose, now: &Pose) -> f64 {
        match self.kind {
            JointKind::Fixed => 0.0,
            // Turns are counted.
            JointKind::Revolute { .. } => now.heading - start.heading,
            JointKind::Prismatic { axis, .. } => axis.dot(&(now.position - start.position)),
        }
    }

    /// The same joint where the object starts at `now` instead of at `start`.
    pub fn carried(&self, start: &Pose, now: &Pose) -> Self {
        let come = self.come(start, now);
        // What was seen may be a little beyond a limit; the start never is.
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

    /// Where the object is when it has come this far (radians or metres) from `start`.
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
        let door = Mount { object: 0, kind: JointKind::Revolute { at, limits } };
        let start = Pose::new(0.6, 0.1, 0.3);
        let open = door.pose(&start, 1.0);
        assert!((open.position - at).norm() - 0.2 < 1e-12 && open.heading == 1.3);
        assert!((door.come(&start, &open) - 1.0).abs() < 1e-12);
        let left = door.carried(&start, &open).limits().expect("limits");
        assert!((left.low + 1.0).abs() < 1e-12 && (left.high - 0.5).abs() < 1e-12);
        let drawer =
            Mount { object: 0, kind: JointKind::Prismatic { axis: Vector::x(), limits: None } };
        assert_eq!(drawer.come(&start, &drawer.pose(&start, 0.25)), 0.25);
    }
}

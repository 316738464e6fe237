//! Joints between objects.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector, wrap_angle};

use super::{Object, Span};

/// The relative motion that a joint allows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// No relative motion: the objects move as one body.
    Fixed,
    /// Rotation about a vertical axis through `at` (world frame at the start, metres).
    Revolute {
        /// Position of the axis.
        at: Vector,
        /// Range of rotations of the second object against the first, radians from the start;
        /// `None` if not limited.
        limits: Option<Span>,
    },
    /// Translation along `axis` (unit vector, world frame at the start).
    Prismatic {
        /// Sliding direction.
        axis: Vector,
        /// Range of translations of the second object against the first, metres along the axis from
        /// the start; `None` if not limited.
        limits: Option<Span>,
    },
}

impl JointKind {
    /// Returns the range of rotations (radians) or translations (metres) against the start, or
    /// `None` without limits.
    pub fn limits(&self) -> Option<Span> {
        match *self {
            JointKind::Fixed => None,
            JointKind::Revolute { limits, .. } | JointKind::Prismatic { limits, .. } => limits,
        }
    }

    /// Returns the range of rotations against the start, radians, or `None` without limits and for
    /// other joints.
    pub fn turns(&self) -> Option<Span> {
        self.limits().filter(|_| matches!(self, JointKind::Revolute { .. }))
    }

    /// Returns the rotation about which angles are unwrapped, radians: the middle of limits beyond
    /// half a turn, otherwise zero.
    pub fn middle(&self) -> f64 {
        match *self {
            JointKind::Revolute { limits: Some(Span { low, high }), .. }
                if low < -PI || high > PI =>
            {
                0.5 * (low + high)
            }
            _ => 0.0,
        }
    }
}

/// A joint between two objects.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// Indices of the two objects in [`super::Scene::objects`].
    pub between: [usize; 2],
    /// Relative motion that it allows.
    pub kind: JointKind,
    /// Whether only the type is known, and the anchor or axis is a guess from the start poses.
    #[serde(default)]
    pub guessed: bool,
}

impl Joint {
    /// Creates a joint between two objects, by index, with a known anchor or axis.
    pub fn new(between: [usize; 2], kind: JointKind) -> Self {
        Self { between, kind, guessed: false }
    }

    /// Returns the joint's frame relative to each of its two objects. The two frames coincide at
    /// the poses that the scene states, not at later poses. A revolute joint rotates about the
    /// origin of the frames; a prismatic joint slides along their x axis.
    pub fn frames(&self, objects: &[Object]) -> [Pose; 2] {
        let [first, second] = self.between.map(|index| objects[index].pose);
        let world = match self.kind {
            JointKind::Fixed => first,
            JointKind::Revolute { at, .. } => Pose { position: at, heading: 0.0 },
            JointKind::Prismatic { axis, .. } => {
                Pose { position: first.position, heading: axis.y.atan2(axis.x) }
            }
        };
        [first.inverse() * world, second.inverse() * world]
    }

    /// Returns the range of rotations (radians) or translations (metres) against the start, or
    /// `None` without limits.
    pub fn limits(&self) -> Option<Span> {
        self.kind.limits()
    }

    /// Returns the joint for objects that start as in `now` instead of as in `before`.
    pub fn carried(&self, before: &[Object], now: &[Object]) -> Self {
        let [first, second] = self.frames(before);
        let [here, there] = self.between.map(|index| now[index].pose);
        let world = here * first;
        let come = world.inverse() * (there * second);
        let left = |limits: Option<Span>, come: f64| {
            limits.map(|span| Span::new((span.low - come).min(0.0), (span.high - come).max(0.0)))
        };
        let kind = match self.kind {
            JointKind::Fixed => JointKind::Fixed,
            JointKind::Revolute { limits, .. } => {
                let middle = self.kind.middle();
                let turn = middle + wrap_angle(come.heading - middle);
                JointKind::Revolute { at: world.position, limits: left(limits, turn) }
            }
            JointKind::Prismatic { limits, .. } => JointKind::Prismatic {
                axis: world.vector(Vector::x()),
                limits: left(limits, come.position.x),
            },
        };
        Self { kind, ..self.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_carried_joint_keeps_its_axis_and_what_is_left_of_its_limits() {
        let limits = Some(Span::new(-1.0, 1.0));
        let at = Vector::new(0.1, 0.0);
        let before = [0.0, 0.2].map(|x| Object::cuboid("half", [0.1, 0.1, 0.1]).at(x, 0.0, 0.0));
        let mut now = before.clone();
        let moved = Pose::new(0.5, 0.3, 0.7);
        let turn = Pose { position: at, heading: 0.4 } * Pose::new(0.1, 0.0, 0.0);
        now[0].pose = moved * before[0].pose;
        now[1].pose = moved * turn;
        let hinge = Joint::new([0, 1], JointKind::Revolute { at, limits }).carried(&before, &now);
        let JointKind::Revolute { at: there, limits: Some(left) } = hinge.kind else {
            panic!("{hinge:?}")
        };
        assert!((there - moved.point(at)).norm() < 1e-12);
        assert!((left.low + 1.4).abs() < 1e-12 && (left.high - 0.6).abs() < 1e-12, "{left:?}");
        let slide = JointKind::Prismatic { axis: Vector::x(), limits };
        now[1].pose = moved * Pose::new(0.25, 0.0, 0.0);
        let slide = Joint::new([0, 1], slide).carried(&before, &now);
        let JointKind::Prismatic { axis, limits: Some(left) } = slide.kind else {
            panic!("{slide:?}")
        };
        assert!((axis - moved.vector(Vector::x())).norm() < 1e-12);
        assert!((left.high - 0.95).abs() < 1e-12, "{left:?}");
    }
}

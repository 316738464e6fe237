//! Joints between objects: how two of them may move against each other.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::geometry::{Pose, Vector, wrap_angle};

use super::{Object, Span};

/// How two joined objects may move against each other.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// Nothing: they move as one body.
    Fixed,
    /// Turn about a vertical axis through `at` (world frame at the start, metres).
    Revolute {
        /// Where the axis stands.
        at: Vector,
        /// Turns of the second object against the first, radians from the start, where limited.
        limits: Option<Span>,
    },
    /// Slide along `axis` (unit vector, world frame at the start).
    Prismatic {
        /// Direction of sliding.
        axis: Vector,
        /// Shifts of the second object against the first, metres along the axis from the
        /// start, where limited.
        limits: Option<Span>,
    },
}

impl JointKind {
    /// The range of turns (radians) or shifts (metres) against the start, where limited.
    pub fn limits(&self) -> Option<Span> {
        match *self {
            JointKind::Fixed => None,
            JointKind::Revolute { limits, .. } | JointKind::Prismatic { limits, .. } => limits,
        }
    }

    /// The range of turns against the start, radians, where it turns and is limited.
    pub fn turns(&self) -> Option<Span> {
        self.limits().filter(|_| matches!(self, JointKind::Revolute { .. }))
    }

    /// Turns are told from those a full turn away by being nearest to this one, radians: the middle of
    /// limits that go beyond half a turn, else none.
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
    /// What it allows.
    pub kind: JointKind,
    /// Whether only the type is known and the anchor or axis is a guess from the start poses.
    #[serde(default)]
    pub guessed: bool,
}

impl Joint {
    /// A joint between two objects, by index, its anchor or axis known.
    pub fn new(between: [usize; 2], kind: JointKind) -> Self {
        Self { between, kind, guessed: false }
    }

    /// The joint's own frame as seen from each of its two objects. At the poses that the scene
    /// states (not where the objects have moved since) the two coincide. A revolute joint turns
    /// about the frames' origin; a prismatic one slides along their x axis.
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

    /// The range of turns (radians) or shifts (metres) against the start, where limited.
    pub fn limits(&self) -> Option<Span> {
        self.kind.limits()
    }

    /// Returns the joint where its objects start as in `now` instead of as in `before`.
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

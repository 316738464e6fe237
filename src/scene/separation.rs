//! Separation of the two sides of a joint.

use crate::geometry::{Pose, Vector, wrap_angle};

use super::{JointKind, Span};

/// Poses of a joint's frame on each of its two objects. The two coincide at the stated poses of the
/// objects, see [`super::Joint::frames`].
#[derive(Clone, Copy, Debug)]
pub struct Separation {
    /// Frames on the first and on the second object, world frame.
    pub ends: [Pose; 2],
}

/// Violation of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Misfit {
    /// Offset of the second end against the first, along the first's axes, metres.
    pub offset: Vector,
    /// Rotation of the second end against the first, radians.
    pub turn: f64,
}

impl Separation {
    /// Returns the separation of a joint with these `frames` between objects at these `poses`.
    pub fn of(frames: &[Pose; 2], poses: [Pose; 2]) -> Self {
        Self { ends: [poses[0] * frames[0], poses[1] * frames[1]] }
    }

    /// Returns the vector from the first end to the second, world frame, metres.
    pub fn apart(&self) -> Vector {
        self.ends[1].position - self.ends[0].position
    }

    /// Returns the vector from the first end to the second along the first end's axes, metres; a
    /// prismatic joint slides along x.
    pub fn seen(&self) -> Vector {
        self.ends[0].local_vector(self.apart())
    }

    /// Returns the rotation of the second end against the first, radians, unwrapped to within half
    /// a turn of the [middle](JointKind::middle) of the allowed rotations.
    pub fn turned(&self, kind: &JointKind) -> f64 {
        let middle = kind.middle();
        middle + wrap_angle(self.ends[1].heading - self.ends[0].heading - middle)
    }

    /// Returns the motion that a joint of this kind does not allow, `limits` included.
    pub fn misfit(&self, kind: &JointKind, limits: Option<Span>) -> Misfit {
        let beyond =
            |value: f64| limits.map_or(0.0, |limits| value - value.clamp(limits.low, limits.high));
        let (seen, turned) = (self.seen(), self.turned(kind));
        match kind {
            JointKind::Fixed => Misfit { offset: seen, turn: turned },
            JointKind::Revolute { .. } => Misfit { offset: seen, turn: beyond(turned) },
            JointKind::Prismatic { .. } => {
                Misfit { offset: Vector::new(beyond(seen.x), seen.y), turn: turned }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_kind_allows_what_it_is_named_for() {
        let frames = [Pose::new(0.1, 0.0, 0.5), Pose::new(-0.1, 0.0, 0.3)];
        let first = Pose::new(0.4, -0.2, 1.0);
        // The second object has slid by 4 cm along the axis, is 1 cm off it and rotated by 0.2.
        let second = first * frames[0] * Pose::new(0.04, 0.01, 0.2) * frames[1].inverse();
        let separation = Separation::of(&frames, [first, second]);
        let close = |misfit: Misfit, x: f64, y: f64, turn: f64| {
            (misfit.offset - Vector::new(x, y)).norm() < 1e-12 && (misfit.turn - turn).abs() < 1e-12
        };
        let limits = Some(Span::new(-0.15, 0.03));
        let (at, axis) = (Vector::zeros(), Vector::x());
        let misfit = |kind, limits| separation.misfit(&kind, limits);
        assert!(close(misfit(JointKind::Fixed, None), 0.04, 0.01, 0.2));
        let revolute = JointKind::Revolute { at, limits };
        assert!(close(misfit(revolute, None), 0.04, 0.01, 0.0));
        assert!(close(misfit(revolute, limits), 0.04, 0.01, 0.17));
        // Limits beyond half a turn: the same heading is a rotation of 0.2, 17 degrees short of the
        // allowed range.
        let wide = |low, high| JointKind::Revolute { at, limits: Some(Span::new(low, high)) };
        for (low, high, beyond) in [(-0.1, 4.4, 0.0), (-6.1, -0.2, 0.0), (-0.1, 0.1, 0.1)] {
            let kind = wide(low, high);
            assert!(close(misfit(kind, kind.limits()), 0.04, 0.01, beyond), "{low} {high}");
        }
        let prismatic = JointKind::Prismatic { axis, limits };
        assert!(close(misfit(prismatic, None), 0.0, 0.01, 0.2));
        assert!(close(misfit(prismatic, limits), 0.01, 0.01, 0.2));
        assert!(
            (separation.apart() - (first * frames[0]).vector(separation.seen())).norm() < 1e-12
        );
    }
}

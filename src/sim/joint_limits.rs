//! Limits and springs of joints as the engines need them: relative to a zero from which no rotation
//! exceeds half a turn.

use crate::geometry::Pose;
use crate::scene::{JointKind, WorldJoint};

/// Returns the zero of an engine's joint, relative to the first frame of a joint of this kind.
pub(super) fn zero(kind: &JointKind) -> Pose {
    Pose { heading: kind.middle(), ..Pose::default() }
}

/// Returns the limits relative to that zero, lower and upper, radians or metres.
pub(super) fn within(kind: &JointKind) -> Option<[f64; 2]> {
    kind.limits().map(|span| [span.low, span.high].map(|limit| limit - kind.middle()))
}

/// Returns the rest position of a joint's spring relative to that zero, its stiffness and its
/// damping, in units of radians or metres; `None` for a joint without a spring.
pub(super) fn spring(mount: &WorldJoint) -> Option<(f64, f64, f64)> {
    let springy = mount.spring > 0.0 && mount.kind != JointKind::Fixed;
    springy.then(|| (-mount.kind.middle(), mount.spring, mount.spring * WorldJoint::RETURN))
}

//! Limits of joints as engines take them: about a zero from which no turn is more than half a one.

use crate::geometry::Pose;
use crate::scene::JointKind;

/// Where an engine's joint has its zero, as seen from the first frame of a joint of this kind.
pub(super) fn zero(kind: &JointKind) -> Pose {
    Pose { heading: kind.middle(), ..Pose::default() }
}

/// The limits from there, lower and upper, radians or metres.
pub(super) fn within(kind: &JointKind) -> Option<[f64; 2]> {
    kind.limits().map(|span| [span.low, span.high].map(|limit| limit - kind.middle()))
}

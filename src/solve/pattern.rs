//! Patterns of pushes that replays have refuted.

use crate::geometry::wrap_angle;
use crate::plan::{Candidate, CandidatePush};

/// Difference of directions up to which pushes move the object alike with any tool, radians.
const SAME_DIRECTION: f64 = 0.26;

/// Difference of lengths up to which pushes move the object alike with any tool, metres.
const SAME_LENGTH: f64 = 0.02;

/// Objects, directions and lengths of the pushes of a plan.
pub(super) struct PushPattern(Vec<(usize, f64, f64)>);

impl PushPattern {
    /// Returns the pattern of `pushes`.
    pub fn of(pushes: &[CandidatePush]) -> Self {
        Self(pushes.iter().map(|push| (push.object, push.direction, push.length)).collect())
    }

    /// Returns `true` if a candidate begins with this pattern. Its further pushes then start from a
    /// refuted prediction.
    pub fn begins(&self, candidate: &Candidate) -> bool {
        self.0.len() <= candidate.pushes.len()
            && self.0.iter().zip(&candidate.pushes).all(|(&(object, direction, length), push)| {
                push.object == object
                    && wrap_angle(push.direction - direction).abs() <= SAME_DIRECTION
                    && (push.length - length).abs() <= SAME_LENGTH
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Start;

    fn candidate(pushes: &[(f64, f64)]) -> Candidate {
        let push = |&(direction, length): &(f64, f64)| CandidatePush {
            tool: 0,
            grip_yaw: 0.0,
            object: 0,
            start: Start::Placed { part: 0, offset: 0.0 },
            direction,
            length,
            room: 0.0,
        };
        Candidate { pushes: pushes.iter().map(push).collect() }
    }

    #[test]
    fn prefixes_of_refuted_plans_are_recognised_by_directions_and_lengths() {
        let pattern = PushPattern::of(&candidate(&[(3.1, 0.2), (1.5, 0.1)]).pushes);
        // Directions wrap around, and further pushes do not matter.
        assert!(pattern.begins(&candidate(&[(-3.1, 0.21), (1.4, 0.09), (0.0, 0.3)])));
        assert!(!pattern.begins(&candidate(&[(3.1, 0.2)])));
        assert!(!pattern.begins(&candidate(&[(3.1, 0.2), (1.9, 0.1)])));
        assert!(!pattern.begins(&candidate(&[(3.1, 0.25), (1.5, 0.1)])));
    }
}

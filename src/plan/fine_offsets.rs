//! Fine lateral offsets: pushes between coarse offsets that fail by a few millimetres.
//!
//! A window between two obstructions may be narrower than the distance of the coarse offsets. The
//! offsets between two neighbours are therefore tried too if both are infeasible for reasons that
//! depend on the offset. Next to a feasible offset, refinement finds the others.

use super::{CandidatePush, Infeasible, Start};

/// Distance of fine offsets, metres: smaller than the range of refinement, and than any window with
/// the required clearance.
const FINE: f64 = 0.004;

/// Maximum number of fine offsets between two coarse ones.
const MOST: usize = 24;

/// Returns the pushes between infeasible neighbours of `tried`, which lists the offsets of every
/// face in ascending order, with the reasons why pushes cannot be made.
pub(super) fn between(tried: &[(CandidatePush, Option<Infeasible>)]) -> Vec<CandidatePush> {
    let misses = |reason: Option<Infeasible>| reason.is_some_and(depends_on_offset);
    let pairs = tried.windows(2).filter(|pair| pair.iter().all(|(_, reason)| misses(*reason)));
    pairs.flat_map(|pair| offsets(&pair[0].0, &pair[1].0)).collect()
}

/// Returns `true` if a push may become feasible a few millimetres beside.
fn depends_on_offset(reason: Infeasible) -> bool {
    match reason {
        Infeasible::OtherPartFirst
        | Infeasible::OnObject
        | Infeasible::Obstacle
        | Infeasible::Hand
        | Infeasible::NoRoom => true,
        Infeasible::NoContact | Infeasible::NoWay | Infeasible::Topples | Infeasible::Reach => {
            false
        }
    }
}

/// Returns copies of a push with the offsets between two neighbours; none if they differ in
/// anything else.
fn offsets(from: &CandidatePush, to: &CandidatePush) -> Vec<CandidatePush> {
    let (Start::Placed { part, offset: low }, Start::Placed { offset: high, .. }) =
        (from.start, to.start)
    else {
        return Vec::new();
    };
    let same = CandidatePush { start: from.start, ..*to } == *from;
    let is_same_face = matches!(to.start, Start::Placed { part: other, .. } if other == part);
    if !(same && is_same_face && low < high) {
        return Vec::new();
    }
    let count = (((high - low) / FINE).ceil() as usize).clamp(1, MOST);
    let share = |k: usize| low + (high - low) * k as f64 / count as f64;
    let at = |offset: f64| CandidatePush { start: Start::Placed { part, offset }, ..*from };
    (1..count).map(|k| at(share(k))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn push(part: usize, offset: f64) -> CandidatePush {
        let start = Start::Placed { part, offset };
        CandidatePush {
            tool: 0,
            grip_yaw: 0.0,
            object: 0,
            start,
            direction: 0.0,
            length: 0.2,
            room: 0.0,
        }
    }

    #[test]
    fn offsets_are_added_between_pushes_that_fail_because_of_their_offset() {
        let tried = |part, offset, reason| (push(part, offset), Some(reason));
        let all = [
            tried(0, -0.02, Infeasible::Reach),
            tried(0, 0.0, Infeasible::OnObject),
            tried(0, 0.02, Infeasible::OtherPartFirst),
            // Another face begins.
            tried(1, -0.02, Infeasible::Obstacle),
            tried(1, 0.28, Infeasible::Obstacle),
        ];
        let found: Vec<(usize, f64)> = between(&all)
            .iter()
            .filter_map(|push| match push.start {
                Start::Placed { part, offset } => Some((part, offset)),
                Start::Chained => None,
            })
            .collect();
        let first: Vec<f64> = found.iter().filter(|one| one.0 == 0).map(|one| one.1).collect();
        let expected = [0.004, 0.008, 0.012, 0.016];
        assert_eq!(first.len(), expected.len());
        assert!(first.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{first:?}");
        assert_eq!(found.len() - first.len(), MOST - 1);
        assert!(between(&all[..2]).is_empty());
    }
}

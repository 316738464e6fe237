//! Which lone frames are solved side by side.

use super::{
    super::{
        frame::{Frame, FrameProblem},
        points::{Contact, Scenery},
        tally::Tally,
    },
    forces::MOST,
    frames::{Frames, is_wide},
    solution::Effort,
};

/// Frames side by side. With AVX2 a vector holds as many numbers; with eight, more of which wait,
/// a push takes 5 to 17 % longer.
pub(super) const LANES: usize = 4;

/// The same where vectors hold as many, as with AVX-512: a push takes a sixth less than with four.
pub(super) const WIDE: usize = 8;

/// Fewer frames than this take less time one by one.
const FEW: usize = 3;

/// A frame that waits to be solved. In this order lanes wait the least for each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Waiting {
    pub contacts: usize,
    /// Of the frame before.
    pub effort: Effort,
    pub place: usize,
}

/// Whether a frame is one that is solved here.
pub fn is_lone(scenery: &Scenery, contacts: &[Contact]) -> bool {
    let bodies = scenery.bodies;
    bodies.objects.len() == 1 && bodies.mounts.is_empty() && contacts.len() <= MOST
}

/// Solves the frames that are `waiting`: leaves the solution with each, if its forces were found.
pub fn solve_each(
    problems: &[Option<FrameProblem>],
    frames: &mut [Frame],
    mut waiting: &[Waiting],
    tally: &mut Tally,
) {
    while !waiting.is_empty() {
        waiting = match waiting.len() {
            0..FEW => solve_first::<1>(problems, frames, waiting, tally),
            count if count > LANES && is_wide() => {
                solve_first::<WIDE>(problems, frames, waiting, tally)
            }
            _ => solve_first::<LANES>(problems, frames, waiting, tally),
        };
    }
}

/// Solves the first N; returns the others.
pub(super) fn solve_first<'a, const N: usize>(
    problems: &[Option<FrameProblem>],
    frames: &mut [Frame],
    waiting: &'a [Waiting],
    tally: &mut Tally,
) -> &'a [Waiting] {
    let (now, later) = waiting.split_at(waiting.len().min(N));
    let mut lanes = Frames::<N>::default();
    for (k, &Waiting { place, .. }) in now.iter().enumerate() {
        if let Some(problem) = problems[place] {
            lanes.set(k, frames[place].scenery(problem), &frames[place].contacts);
        }
    }
    for (solution, &Waiting { place, .. }) in lanes.solve(tally).into_iter().zip(now) {
        frames[place].lone = solution;
    }
    later
}

//! Results of a search, and their kinds.

use super::Candidate;

/// A candidate as the search scored it.
#[derive(Clone, Debug)]
pub struct SearchResult {
    /// The candidate, its last push cut to the best stop.
    pub candidate: Candidate,
    /// Predicted error in units of the tolerance at that stop, estimated where the tool stops
    /// early; behind all others where something could not pass (see [`super::is_behind`]).
    pub score: f64,
}

/// Returns the indices of the best of `found` of different kinds, at most `count`, in order.
/// `found` is sorted, best first; variants of one another (see [`Candidate::is_variant_of`]) are
/// of one kind.
pub fn kinds(found: &[SearchResult], count: usize) -> Vec<usize> {
    let mut kinds: Vec<usize> = Vec::new();
    for (k, one) in found.iter().enumerate() {
        if kinds.len() == count {
            break;
        }
        if !kinds.iter().any(|&kind| one.candidate.is_variant_of(&found[kind].candidate)) {
            kinds.push(k);
        }
    }
    kinds
}

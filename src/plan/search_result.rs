//! Results of a search, and their kinds.

use super::Candidate;

/// Candidate with its score from the search.
#[derive(Clone, Debug, PartialEq)]
pub struct SearchResult {
    /// The candidate, with its last push ended at the best stop.
    pub candidate: Candidate,
    /// Predicted error in units of the tolerance at that stop, estimated if the tool stops early.
    /// The score is behind all others if the motion was blocked (see [`super::is_behind`]).
    pub score: f64,
}

/// Returns the indices of the best of `found` of different kinds, at most `count`, in order.
/// `found` must be sorted, best first. Variants of each other (see [`Candidate::is_variant_of`])
/// are of one kind.
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

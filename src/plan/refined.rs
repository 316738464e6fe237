//! A candidate after its refinement.

use super::Evaluation;

/// A candidate after its refinement.
#[derive(Clone, Debug)]
pub struct Refined {
    /// Index among the candidates.
    pub index: usize,
    /// The best evaluation of all rounds.
    pub best: Evaluation,
    /// Distances of the middle of its ends on plausible supports from the goal, before and now,
    /// metres.
    pub off: [f64; 2],
    /// Score on the support on which it ends farthest from the goal.
    pub worst: f64,
    /// Score of the middle of all its ends, before and after every round; it never rises.
    pub rounds: Vec<f64>,
}

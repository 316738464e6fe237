//! Candidates after their refinement.

use super::Evaluation;

/// Candidate after its refinement.
#[derive(Clone, Debug)]
pub struct Refined {
    /// Index among the candidates.
    pub index: usize,
    /// Best evaluation of all rounds.
    pub best: Evaluation,
    /// Distances from the goal to the centre of the final poses over plausible support models,
    /// before refinement and now, metres.
    pub off: [f64; 2],
    /// Score for the worst support model.
    pub worst: f64,
    /// Score of the centre of the final poses, before and after every round; it never rises.
    pub rounds: Vec<f64>,
}

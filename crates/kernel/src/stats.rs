//! Counters of the work of the frame solver.

use serde::{Deserialize, Serialize};

/// Counters of the work of solving the equations of frames.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SolverStats {
    /// Number of systems solved: two for each piece of a frame, for displacements and for
    /// velocities.
    pub systems: u64,
    /// Number of contacts and joint limits in these systems.
    pub constraints: u64,
    /// Number of iterations, each of which updates the weights of the support points.
    pub updates: u64,
    /// Number of times that the resistance of an object was computed.
    pub weighed: u64,
    /// Number of active sets tried.
    pub rounds: u64,
    /// Number of linear equations in these sets.
    pub rows: u64,
    /// Number of updates without a consistent active set; their solutions were approximated by
    /// iteration.
    pub approached: u64,
    /// Floating-point operations on support points and linear equations: the unavoidable work of
    /// the method.
    pub operations: u64,
}

impl SolverStats {
    /// Adds the counts of `other`.
    pub fn add(&mut self, other: &SolverStats) {
        self.systems += other.systems;
        self.constraints += other.constraints;
        self.updates += other.updates;
        self.weighed += other.weighed;
        self.rounds += other.rounds;
        self.rows += other.rows;
        self.approached += other.approached;
        self.operations += other.operations;
    }

    /// Counts the resistance of an object with `points` support points. Each point takes two
    /// products and a sum for the velocity along either axis, the norm of the velocity, a quotient,
    /// and five sums of products.
    #[inline(always)]
    pub fn weigh(&mut self, points: usize) {
        self.weighed += 1;
        self.operations += 24 * points as u64;
    }

    /// Counts `n` linear equations: filled in from four products of three numbers each, eliminated,
    /// and solved backwards.
    #[inline(always)]
    pub fn solve(&mut self, n: usize) {
        let n = n as u64;
        self.rows += n;
        self.operations += 24 * n * n + 2 * n * n * n / 3 + 2 * n * n;
    }
}

//! What solving frames took, counted.

use serde::{Deserialize, Serialize};

/// Counts of the work on many frames' equations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Systems solved: two a piece of a frame, for displacements and for velocities.
    pub systems: u64,
    /// Contacts and limits in them.
    pub constraints: u64,
    /// Updates of their weights.
    pub updates: u64,
    /// Objects whose resistance was taken anew in them.
    pub weighed: u64,
    /// Sets of contacts that were tried.
    pub rounds: u64,
    /// Linear equations in these.
    pub rows: u64,
    /// Updates in which no set was right, so that the answer was approached by iteration.
    pub approached: u64,
    /// Floating-point operations of points that drag and of linear equations: the unavoidable work
    /// of the method.
    pub operations: u64,
}

impl Tally {
    /// Adds another's numbers.
    pub fn add(&mut self, other: &Tally) {
        self.systems += other.systems;
        self.constraints += other.constraints;
        self.updates += other.updates;
        self.weighed += other.weighed;
        self.rounds += other.rounds;
        self.rows += other.rows;
        self.approached += other.approached;
        self.operations += other.operations;
    }

    /// Counts an object with this many points under it: two products and a sum for the speed along
    /// either axis, their length, a quotient, and five sums of products.
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

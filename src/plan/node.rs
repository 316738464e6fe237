//! Nodes from which a search continues.

use crate::geometry::Vector;
use crate::scene::State;

use super::Candidate;

/// State after a sequence of pushes.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// Pushes so far; `None` at the start.
    pub candidate: Option<Candidate>,
    /// State after the pushes; in the chained form, objects may still move.
    pub state: State,
    /// Position of the end effector after the last push.
    pub end: Option<Vector>,
    /// Alternative states due to small errors at the start, see `uncertainty`.
    pub others: Vec<State>,
    /// Position uncertainty of the object for the next push, metres.
    pub room: f64,
}

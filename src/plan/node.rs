//! A state that a search continues from.

use crate::geometry::Vector;
use crate::scene::State;

use super::Candidate;

/// A state that a sequence of pushes leads to.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// The pushes so far; none at the start.
    pub candidate: Option<Candidate>,
    /// Where everything is then; still moving in the chained form.
    pub state: State,
    /// Where the end effector is then.
    pub end: Option<Vector>,
    /// Where small errors at the start lead instead, see `uncertainty`.
    pub others: Vec<State>,
    /// Room for where the object may be, metres.
    pub room: f64,
}

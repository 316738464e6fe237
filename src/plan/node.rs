//! A state that a search continues from.

use crate::geometry::Vector;
use crate::scene::State;

use super::Candidate;

/// A state that a sequence of pushes leads to.
#[derive(Clone, Debug)]
pub(super) struct Node {
    /// The pushes so far; none at the start.
    pub candidate: Option<Candidate>,
    /// State then; still moving in the chained form.
    pub state: State,
    /// End effector's position then.
    pub end: Option<Vector>,
    /// States that small errors at the start lead to instead, see `uncertainty`.
    pub others: Vec<State>,
    /// Room for where the object may be, metres.
    pub room: f64,
}

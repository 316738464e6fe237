//! The frames of one object that nothing is joined to, in at most two contacts: what [`super::prior`]
//! makes of them, to the last bit, without lists and with several frames side by side.
//!
//! Most frames of a search are of one pushed object, and each of its updates is one chain of quotients
//! and roots that the processor waits for. The chains of other candidates fill that waiting. Nothing in
//! a frame depends on those next to it, so a result is the same bits with any number of them.

mod forces;
mod frames;
mod lanes;
mod object;
mod solution;
#[cfg(test)]
mod tests;
mod touching;
mod waiting;

pub(super) use solution::LoneSolution;
pub(super) use waiting::{Waiting, is_lone, solve_each};

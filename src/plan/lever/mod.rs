//! Candidates of lever-ups, and their parallel search.
//!
//! Every place of the outline, depth, axis and turn that the rules of a task allow is looked at;
//! what no robot can do is refused with a reason, the rest is predicted by a model and ranked.
//! Nothing is simulated and nothing is verified here.

mod candidate;
mod room;
mod search;

pub use candidate::{LeverCandidate, LeverGrid};
pub use room::LeverRoom;
pub use search::{LeverSearch, LeverSearchStatistics, ScoredLever, merit};

//! Candidates of lever-ups, and their parallel search.
//!
//! Lever-ups are enumerated over every lever point, depth, axis and angle that a task's rules
//! allow. Infeasible ones are rejected with a reason; the rest are predicted by a model and ranked.
//! This module neither simulates nor verifies.

mod candidate;
mod room;
mod search;

pub use candidate::{LeverCandidate, LeverGrid};
pub use room::LeverRoom;
pub use search::{LeverSearch, LeverSearchStatistics, ScoredLever, merit};

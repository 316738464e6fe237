//! Candidates, parallel search and QP refinement. Verifies nothing.
//!
//! [`Search`] enumerates pushes, rolls them out with an effect model and keeps a beam over
//! sequences; [`refine()`] then moves offsets, directions and lengths of the best candidates with a
//! quadratic programme on a fitted linear model. [`Workspace`] says what a task allows. [`lever`]
//! does the same for lever-ups, without a refinement.

mod beam;
mod candidate;
mod carry;
mod corridor;
mod enumerate;
mod evaluate;
mod field;
mod found;
mod harden;
mod infeasible;
pub mod lever;
mod linear;
mod misses;
mod parameters;
mod preference;
mod qp;
mod refine;
mod rollouts;
mod score;
mod scored;
mod search;
mod spread;
mod statistics;
mod supports;
mod workspace;

pub use candidate::{Candidate, CandidatePush, Start};
pub use carry::{Carrying, FollowSettings, Followed, Leg, Things, follow};
pub use corridor::{Corridor, alone};
pub use evaluate::{Evaluation, evaluate};
pub use field::Field;
pub use found::{Found, kinds};
pub use harden::{HardenSettings, harden};
pub use infeasible::Infeasible;
pub use preference::{Cost, NEAR, in_order, preferred};
pub use qp::{QpProblem, QpSolution, QpSolver, QpStatus};
pub use refine::{FOUND_RADIUS, REFINABLE, RefineSettings, Refined, refine};
pub use rollouts::Rollouts;
pub use score::{bare, behind, is_behind};
pub use scored::ScoredPush;
pub use search::{Search, SearchSettings};
pub use spread::Spread;
pub use statistics::{RefineStatistics, SearchStatistics};
pub use workspace::{
    HAND_CLEARANCE, MIN_LENGTH, Margins, OBSTACLE_CLEARANCE, SET_DOWN_CLEARANCE, STAND_OFF,
    Workspace, distance_to_origin,
};

//! Candidates, parallel search and QP refinement. This module verifies nothing.
//!
//! [`Search`] enumerates pushes, rolls them out with an effect model and keeps a beam over
//! sequences. [`refine()`] then varies offsets, directions and lengths of the best candidates by a
//! quadratic programme on a fitted linear model. [`Workspace`] states the limits of a task.
//! [`lever`] enumerates and ranks lever-ups, without a refinement.

mod beam;
mod candidate;
mod cost_to_go;
mod enumerate;
mod evaluate;
mod fine_offsets;
mod goal_errors;
mod harden;
mod infeasible;
pub mod lever;
mod linear;
mod node;
mod parameters;
mod placement;
mod qp;
mod reached;
mod refine;
mod refined;
mod rollouts;
mod score;
mod scored;
mod search;
mod search_result;
mod set_down;
mod statistics;
mod supports;
mod swept_region;
mod tie_break;
mod transport;
mod uncertainty;
mod workspace;

pub use candidate::{Candidate, CandidatePush, Start};
pub use cost_to_go::CostToGo;
pub use evaluate::{Evaluation, evaluate};
pub use harden::{HardenSettings, harden};
pub use infeasible::Infeasible;
pub use placement::{Placement, STAND_OFF};
pub use qp::{QpProblem, QpSolution, QpSolver, QpStatus};
pub use refine::{REFINABLE, RefineSettings, refine};
pub use refined::Refined;
pub use rollouts::Rollouts;
pub use score::{bare, behind, is_behind};
pub use scored::ScoredPush;
pub use search::{Search, SearchSettings};
pub use search_result::{SearchResult, kinds};
pub use statistics::{RefineStatistics, SearchStatistics};
pub use swept_region::{SweptRegion, alone};
pub use tie_break::{Cost, NEAR, in_order, preferred};
pub use transport::{Follow, FollowSettings, Followed, Groups, Leg, Transport, find_legs};
pub use uncertainty::Uncertainty;
pub use workspace::{
    HAND_CLEARANCE, MIN_LENGTH, Margins, OBSTACLE_CLEARANCE, SET_DOWN_CLEARANCE, Workspace,
};

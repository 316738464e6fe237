//! Results of motions: trajectories, outcomes judged by goals, warnings and verdicts.
//!
//! Quantities are in SI units and radians. This module neither simulates nor plans.

mod fallen;
mod in_turn;
mod lever;
mod object_rules;
mod push_fault;
mod range_warnings;
mod result;
mod squeeze;
mod step_moves;
mod step_states;
mod trajectory;
mod verdict;
mod warning;

pub use crate::task::{Ending, Lift};
pub use in_turn::in_turn;
pub use lever::{LEVER_FRAMES, LeverFault, LeverTrajectory, LeverWarning, has_slipped};
pub use object_rules::ObjectRules;
pub use push_fault::PushFault;
pub use result::{Miss, Outcome};
pub use squeeze::squeeze;
pub use step_moves::{MovedObject, StepMoves, step_moves};
pub use step_states::step_states;
pub use trajectory::{Contact, Force, Frame, Record, Spread, Trajectory};
pub use verdict::{Evidence, Perturbation, Reason, Verdict, never_on};
pub use warning::{SHOWN_WARNINGS, Warning, warning_lines};

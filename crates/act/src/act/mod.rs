//! Closed loop: plan under the belief, push, observe, update the belief, plan again.
//!
//! A [`Runner`] does this in any [`World`], a robot's table or a [`SimulatedWorld`] with a hidden
//! ground truth. It records every step in a [`Trace`], from which an interrupted run resumes.
//!
//! ```
//! use pushplan::{Effort, Planner, Task, ToolLibrary};
//! use pushplan_act::{End, Runner, SimulatedWorld, hidden};
//!
//! let library = ToolLibrary::embedded()?;
//! let text = include_str!("../../../../tasks/hidden-hinge.yaml");
//! let task = Task::parse(text, "hidden-hinge.yaml")?;
//! let planner = Planner::for_effort(Effort::Draft)?.build();
//! // A robot's table would stand here.
//! let truth = hidden(&task, &library, 1)?;
//! let mut world = SimulatedWorld::new(truth);
//! let trace = Runner::new(&planner, &library).run(&task, &mut world)?;
//! assert_eq!(trace.end, Some(End::Reached));
//! assert!(task.goals[0].reached(world.state()));
//! # Ok::<(), pushplan::Error>(())
//! ```
//!
//! Planning, prediction and inference are in `solve`, `effect` and `belief`.
//!
//! # Observations
//!
//! Observations of a camera are incomplete and may be wrong:
//!
//! | observation | treatment |
//! |---|---|
//! | an object is not observed | the others are used; up to three observations at rest |
//! | an object is not at its position in the task at first | the observed position is used |
//! | an object is still not observed | predicted pose; [`ActError::Lost`] for a goal's object |
//! | an instant is missing | the next observation covers the motion since the last one |
//! | late, out of order | sorted by time within one motion |
//! | from before the motion, or without a finite time | discarded |
//! | NaN or infinity | treated as not observed |
//! | two objects confused during a push | swapped back |
//! | like objects in each other's places at first | [`ActError::Ambiguous`] |
//! | a rule for objects is broken | [`End::RuleBroken`] |
//! | an object far from any possible position | discarded unless a second observation agrees |
//! | another number of objects | [`ActError::Objects`] |
//!
//! If a robot stops a push early, [`World::stopped`] returns where, and the observations cover the
//! shorter motion. Every treatment leaves a [`Note`] in the trace, except temporary occlusion and
//! missing instants.

mod decide;
mod error;
mod gather;
mod judge;
mod learning;
mod probe;
mod rules;
mod runner;
mod settings;
mod simulated;
mod trace;
mod world;

pub use error::ActError;
pub use gather::Note;
pub use judge::Chance;
pub use probe::{Probe, ProbeRule, choose_probe};
pub use runner::Runner;
pub use settings::RunSettings;
pub use simulated::{SimulatedWorld, hidden, really};
pub use trace::{End, Step, TRACE_VERSION, Trace, Why};
pub use world::{Look, Stop, World, WorldError, WorldState};

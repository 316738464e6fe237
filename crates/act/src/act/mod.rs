//! The closed loop: plan under what is believed, push, look, believe, plan again.
//!
//! A [`Runner`] does that in any [`World`], a robot's table or a [`SimulatedWorld`] with a hidden
//! truth, and writes down everything in a [`Trace`], from which it can go on after an interruption.
//!
//! ```
//! use pushplan::{Effort, Planner, Task, ToolLibrary};
//! use pushplan_act::{RunSettings, Runner, SimulatedWorld, Trace, hidden};
//!
//! let library = ToolLibrary::embedded()?;
//! let task = Task::parse(include_str!("../../../../tasks/hidden-hinge.yaml"), "hidden-hinge.yaml")?;
//! let planner = Planner::for_effort(Effort::Draft)?.build();
//! // A robot's table would stand here.
//! let truth = hidden(&task, &library, 1)?;
//! let mut world = SimulatedWorld::new(truth);
//! let mut trace = Trace::new(task, RunSettings::default(), "draft".into(), None);
//! let runner = Runner::new(&planner, &library);
//! runner.run(&mut trace, &mut world, &mut |_| Ok(()), &pushplan::internals::watch::Unwatched)?;
//! assert!(trace.task.goals[0].reached(world.state()));
//! # Ok::<(), pushplan::Error>(())
//! ```
//!
//! Nothing is planned, predicted or inferred here; that is for `solve`, `effect` and `belief`.
//!
//! # What is seen
//!
//! A camera reports what it happens to see, not what a filter would like:
//!
//! | what is reported | what is done |
//! |---|---|
//! | an object is not seen | the others tell what they can; at rest the table is looked at again, up to three times |
//! | an object stands elsewhere at the first look than the task states it | taken to be where it is seen |
//! | still not seen at rest | taken to be where it was predicted; of the goal's object [`ActError::Lost`] |
//! | an instant is missing | the next one tells of the motion since the last |
//! | late, out of order | put in order by its time, within one motion |
//! | from before the motion, or without a finite time | left out |
//! | NaN or infinity | that object was not seen |
//! | two objects in each other's places | swapped back |
//! | an object far from anywhere it can be | not seen; believed where a second look at rest agrees |
//! | another number of objects | [`ActError::Objects`]: this is another table |
//!
//! Where a robot cannot go on with a push it says so ([`World::stopped`]), and what was seen is of the push
//! as far as it was made. All of this, except objects that are not seen for a while and missing instants, leaves a [`Note`] in the trace.

mod decide;
mod error;
mod gather;
mod judge;
mod learning;
mod probe;
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

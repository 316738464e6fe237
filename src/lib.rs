//! Chooses a tool and pushes that bring an object on a table to a goal, and shows that the plan
//! works.
//!
//! # The problem
//!
//! Given a scene with its physics `θ` (masses, frictions, joints), a set of tools `T` and a goal
//! pose `g` for one object,
//!
//! ```text
//! minimise    d( f_θ(x₀, τ, u), g )        over tools τ ∈ T and pushes u = (u₁ … u_n), n ≤ N
//! subject to  reach       the end effector stays between its smallest and largest distance
//!             clearance   the tool meets no obstacle, and comes down on nothing
//!             verified    a replay in a 3-D engine ends within the tolerance of g, at rest
//! ```
//!
//! where `x₀` is the initial state, `d` the distance of the object from the goal in units of its
//! tolerance, and `f_θ` the state at rest after the pushes `u`. The distance counts the position,
//! and the heading if the goal states one. A push has a start, a direction, a length and a speed.
//! The shortest plan that passes is taken.
//!
//! If a [`Task`] allows it, a flat object is levered up, turned over or lifted out of a confined
//! place. A lever-up is a [`Step`] of a [`Plan`] like a push, and a plan may push, lever and push
//! again.
//!
//! `f` is an [`EffectModel`]: a closed-form model of contacts (the analytic model), that model
//! corrected by a trained network, or a physics engine, each slower and more exact than the one
//! before. A [`Planner`] searches candidates with it, refines the best by small quadratic
//! programmes and replays them in 3-D with code that is independent of the search. Not finding a
//! plan is an answer, [`PlanStatus`], and not an error.
//!
//! # Example
//!
//! A can behind a wall is pulled 17 cm towards the robot. The task and the tools come with the
//! library:
//!
//! ```
//! use pushplan::{Effort, PlanStatus, Planner, Task, ToolLibrary};
//!
//! fn main() -> Result<(), pushplan::Error> {
//!     let library = ToolLibrary::embedded()?;
//!     let task = Task::example("pull-back-behind-wall")?;
//!     let planner = Planner::for_effort(Effort::Standard)?.build();
//!     let solution = planner.solve(&task, &library)?;
//!     assert_eq!(solution.status, PlanStatus::Solved);
//!     if let Some(best) = solution.best() {
//!         println!("use the {}: error {:.1} mm", best.plan.tool(), 1000.0 * best.outcome.error());
//!     }
//!     Ok(())
//! }
//! ```
//!
//! Lengths are metres, angles radians, masses kilograms and times seconds throughout. The table is
//! the plane z = 0 with z up, and x points forward from the robot's base at the origin.
//!
//! # Dependencies
//!
//! None of the dependencies needs a C compiler. CI counts them, at most 120, with `cargo tree -p
//! pushplan -e normal,build --prefix none --no-dedupe | sort -u | wc -l`.
//!
//! # Crates that build on it
//!
//! This crate plans and verifies; it reads and writes the files of tasks, tools, plans and
//! recordings. The crates below extend it, and it depends on none of them:
//!
//! | crate | adds |
//! |---|---|
//! | `pushplan-arm` | robot arms: call `pushplan_arm::install()`, and tasks may name a URDF |
//! | `pushplan-act` | the closed loop, beliefs about objects, fits from recordings |
//! | `pushplan-bench` | tool selection and task suites, kept and resumed |
//! | `pushplan-design` | proposals of tools for a task |
//! | `pushplan-report` | pages, pictures, tables |
//! | `pushplan-import` | MJCF, URDF and meshes in |
//! | `pushplan-export` | MJCF, MCAP and joint trajectories out |
//! | `pushplan-command` | the command `pushplan` |
//!
//! Only the items of this crate that this page lists are meant to stay stable.
//!
//! # Internals
//!
//! The module [`internals`] opens the planning pipeline, one module for each step, without promises
//! of stability.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod error;
pub mod internals;

#[doc(hidden)]
pub mod asset;
#[doc(hidden)]
pub mod checksum;
#[doc(hidden)]
pub mod contact;
#[doc(hidden)]
pub mod decimals;
#[doc(hidden)]
pub mod effect;
#[doc(hidden)]
pub mod geometry;
#[doc(hidden)]
pub mod graph;
#[doc(hidden)]
pub mod network;
#[doc(hidden)]
pub mod outcome;
#[doc(hidden)]
pub mod plain_file;
#[doc(hidden)]
pub mod plan;
#[doc(hidden)]
pub mod progress;
#[doc(hidden)]
pub mod recording;
#[doc(hidden)]
pub mod rollout;
#[doc(hidden)]
pub mod scene;
#[doc(hidden)]
pub mod seeded;
#[doc(hidden)]
pub mod sim;
#[doc(hidden)]
pub mod solve;
#[doc(hidden)]
pub mod task;
#[doc(hidden)]
pub mod verify;

pub use asset::ToolLibrary;
pub use effect::{EffectModel, Simulated, Trust};
pub use error::Error;
pub use geometry::{ConvexPolygon, PolygonError, Pose, Shape, Vector};
pub use outcome::{Outcome, Record, Trajectory, Verdict, Warning};
pub use scene::{
    Blade, Body, Joint, JointKind, ModelSpec, Object, ObservedPose, Obstacle, Part, Physics, Robot,
    Scene, Situation, State, TableFit, Tool, Unknowns,
};
pub use sim::Simulator;
pub use solve::{Effort, PlanStatus, Planner, RankedPlan, Solution, SolveError};
pub use task::{
    Coverage, Edge, Fall, Gap, Goal, Job, LeverRules, LeverStep, LeverUp, Motion, Noise, Pivot,
    Place, Plan, Push, PushForm, PushRules, PushStep, Step, Task, ToolMotion, Truth,
};
pub use verify::Verifier;

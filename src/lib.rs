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
//! The types that most programs need are listed below. The rest of the public interface is grouped
//! by subject:
//!
//! | module | content |
//! |---|---|
//! | [`shapes`] | solids and points in the plane and in space |
//! | [`scenes`] | supports, surfaces, regions, joints and the robot's hand |
//! | [`goals`] | criteria of goals |
//! | [`motions`] | strokes, arms, and the legs of a carried tool |
//! | [`models`] | effect models and their settings |
//! | [`planning`] | budgets, predictions, statistics, causes, plans by hand |
//! | [`outcomes`] | frames, contacts, forces, evidence and faults |
//! | [`recordings`] | recorded motion |
//! | [`files`] | files of plans and trajectories, faults with places, JSON schemas |
//! | [`progress`] | progress and cancellation |
//!
//! Only these modules and the items of this page are meant to stay stable.
//!
//! # Internals
//!
//! The module [`internals`] opens the planning pipeline, one module for each step, without promises
//! of stability.
#![deny(unsafe_code)]
#![warn(missing_docs)]

mod error;
pub mod internals;
pub mod progress;

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

/// Solids and points in the plane and in space.
pub mod shapes {
    pub use crate::geometry::{
        ContactPoint, Extent, Footprint, Pose3, Rim, Solid, SupportEdge, Vector3, centroid,
        convex_hull, wrap_angle,
    };
}

/// Parts of scenes: supports, surfaces, regions, joints, the robot's hand and its arm.
pub mod scenes {
    pub use crate::scene::{
        Annulus, ArmFault, Carried, Fixed, Hand, JointPoint, JointTrajectory, LeverScene, Mover,
        PairFriction, Piece, Plate, Quantity, Region, RigidGroups, Slab, Span, Support, Surface,
        TableTop, ToolError, Velocity, Weight, Whole, WorldJoint,
    };
    pub use crate::sim::Arm;
}

/// Criteria of goals, each a kind of [`Demand`](goals::Demand).
pub mod goals {
    pub use crate::task::demand::{
        Area, AtPlace, Check, Coverage, Demand, Edge, End, Ending, Facing, Fall, Flipped, Gap,
        Group, InArea, Kind, Lift, Mark, OutOfArea, Outside, Quantity, Raised, ShownGoal, Swing,
    };
    pub use crate::task::{Aspect, ToolChoice};
}

/// Rules and motions of pushes and lever-ups, observations, arms, and the legs of a carried tool.
pub mod motions {
    pub use crate::task::{
        ArmReader, ArmRefusal, ArmSource, BlockedLeg, Directions, Followed, FrameStep, LeverMotion,
        Observation, Offsets, ReachablePositions, RobotArm, StatedArm, Stroke, TravelLeg,
        read_arms_with,
    };
}

/// Effect models, the words that name them, and their fits to a table.
pub mod models {
    pub use crate::effect::{
        EffectModels, Fallback, ModelError, Network, OutOfRange, Prior, Quantiles, Simulated,
        Still, Trust,
    };
    pub use crate::network::{ParameterError, WeightsError};
    pub use crate::scene::{
        Assumptions, Engine, FittedObject, HeadSpread, JointBelief, ModelKind, ModelPart, Narrowed,
        Rate, SpecError, Stride,
    };
}

/// Budgets, predictions, statistics and causes of missing plans; plans made by hand.
pub mod planning {
    pub use crate::plan::lever::LeverSearchStatistics;
    pub use crate::plan::{
        Infeasible, QpProblem, QpStatus, RefineStatistics, ScoredPush, SearchSettings,
        SearchStatistics, Start,
    };
    pub use crate::solve::{
        ActionError, Approach, Cause, LeverActionError, LeverSettings, LeverStatistics,
        ManualLever, ManualPlace, ManualPlan, ManualPush, ManualStart, Partial, PlannerBuilder,
        Prediction, Refinement, Settings, Statistics, TaskFault, Timing, manual_lever, manual_plan,
    };
}

/// Parts of trajectories and verdicts: frames, contacts, forces, evidence and faults.
pub mod outcomes {
    pub use crate::outcome::{
        Contact, Evidence, Force, Frame, LeverFault, Miss, MovedObject, Perturbation, PushFault,
        Reason, Spread, StepMoves, step_moves, warning_lines,
    };
    pub use crate::verify::{VerifySettings, rule_violations};
}

/// Recorded motion of a tool and objects.
pub mod recordings {
    pub use crate::recording::{Instant, Moving, RecordedFrame, Recording, Replay};
}

/// Files of plans, trajectories and recordings, faults with places, and JSON schemas.
pub mod files {
    pub use crate::asset::{
        Fault, Faults, Kind, Place, PlanFile, TrajectoryFile, check, load_example, load_task,
        load_world, plan_schema, recording_schema, recordings_in, task_schema, tool_schema,
        trajectory_schema, world_schema, write_atomic,
    };
}

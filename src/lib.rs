//! `pushplan` chooses a tool and pushes that bring objects on a table to goals, and shows that
//! the plan works.
//!
//! The modules form one line; each imports only from those before it:
//!
//! ```text
//! geometry ─ scene ─ asset
//!              ├─ sim ──────────────────────────────── effect ─ plan ─ verify ─ solve ─ bench ─ report ─ cli
//!              └─ contact ─ graph ─ network ─ rollout ─┘
//!                  dataset ─ train ─ (weights in models/)
//! ```
//!
//! # Example
//!
//! ```
//! use pushplan::asset::ToolLibrary;
//! use pushplan::scene::Task;
//! use pushplan::solve::{Effort, PlanStatus, Planner};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let library = ToolLibrary::embedded()?;
//! let task = Task::load("tasks/pull-back.yaml")?;
//! let planner = Planner::for_effort(Effort::Standard)?.build();
//! let solution = planner.solve(&task, &library)?;
//! assert_eq!(solution.status, PlanStatus::Solved);
//! println!("use the {}", solution.plans[0].plan.tool);
//! # Ok(())
//! # }
//! ```
#![deny(unsafe_code)]
#![warn(missing_docs)]

pub mod asset;
pub mod bench;
#[cfg(feature = "cli")]
pub mod cli;
pub mod contact;
pub mod dataset;
pub mod effect;
pub mod geometry;
pub mod graph;
pub mod judge;
pub mod network;
pub mod plan;
pub mod recording;
pub mod report;
pub mod rollout;
pub mod scene;
pub mod sim;
pub mod solve;
pub mod store;
#[cfg(feature = "train")]
pub mod train;
pub mod verify;
pub mod watch;

//! Tests of the measurements, and of the library where they need its suites, in one binary.

mod command;
mod crowd_errors;
mod evaluation;
mod extremes;
mod images;
mod joints_bench;
mod lever_models;
mod lever_parts;
mod parts_training;
mod published;
mod random_tasks;
mod shards;
mod shipped_network;
mod steps;
mod symmetry;
mod tradeoff;
mod trivial;

// Fixtures shared with other tests.
#[path = "../../../../tests/it/fixtures.rs"]
#[allow(dead_code)]
mod fixtures;
#[path = "../../../../tests/it/pages.rs"]
mod pages;
#[path = "../../../../tests/it/program.rs"]
mod program;
#[path = "../../../../tests/it/recorded_pushes.rs"]
mod recorded_pushes;
#[path = "../../../../tests/it/sharding.rs"]
#[allow(dead_code)]
mod sharding;
#[path = "../../../learn/tests/it/until.rs"]
mod until;

/// Paths of the repository and of the program.
const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
const PROGRAM: &str = env!("CARGO_BIN_EXE_pushplan-lab");
